//! The two bodies of each contact of a block, gathered from the solver's state into lanes, and put back.

use super::Block;
use super::layout::Layout;
use crate::solver::bodies::{MAX_STATE, Sizes};
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::Machine;
use crate::solver::wide::{Wide, transpose, transpose_halves};

/// The states of both bodies of a block's contacts, one contact a lane, and the header's numbers that every row needs.
pub(super) struct Pairing<const N: usize, M: Machine> {
    /// [`Sizes::STATE`] numbers in use.
    a: [Wide<M>; MAX_STATE],
    b: [Wide<M>; MAX_STATE],
    mass_a: Wide<M>,
    mass_b: Wide<M>,
    pub(super) machine: M,
}

/// Which part of the state is measured: where it starts.
type Part = usize;

/// Where the states of bodies are read, and where they are put.
pub(crate) enum States<'a> {
    InPlace(&'a mut [Real]),
    /// Read here, as other threads do, and put aside in the order of blocks; see [`put_in_place`].
    Aside {
        read: &'a [Real],
        put: std::slice::IterMut<'a, Lanes>,
    },
}

impl States<'_> {
    #[inline(always)]
    pub(super) fn read(&self) -> &[Real] {
        match self {
            Self::InPlace(state) => state,
            Self::Aside { read, .. } => read,
        }
    }
}

/// Numbers of half a vector: what is left over at the end of a state is often no more.
const HALF: usize = WIDTH / 2;

/// Whether the numbers from `at` up to `count` fit half a vector: transposing that takes a third of the work.
#[inline(always)]
const fn is_half(at: usize, count: usize) -> bool {
    count - at <= HALF
}

/// Vectors that hold the velocities of one side of a block: of two bodies each where half a vector is enough.
const fn side_len<const N: usize>() -> usize {
    Sizes::<N>::VELOCITY.next_multiple_of(HALF)
}

/// Vectors that a block puts aside.
pub(super) const fn put_len<const N: usize>() -> usize {
    2 * side_len::<N>()
}

/// Puts the states of some blocks in place that were put aside.
pub(super) fn put_in_place<const N: usize>(blocks: &[Block], put: &[Lanes], state: &mut [Real]) {
    let mut sides = put.chunks_exact(side_len::<N>());
    for block in blocks {
        for bodies in [&block.bodies_a, &block.bodies_b] {
            let Some(mut rest) = sides.next() else { return };
            for at in (0..Sizes::<N>::VELOCITY).step_by(WIDTH) {
                let half = is_half(at, Sizes::<N>::VELOCITY);
                let (rows, others) = rest.split_at(if half { HALF } else { WIDTH });
                for (k, row) in rows.iter().enumerate() {
                    put_row::<N>(state, bodies, (k, at), *row, half);
                }
                rest = others;
            }
        }
    }
    state[..Sizes::<N>::VELOCITY].fill(0.0);
}

/// Puts a row of a block in place: the numbers from `at` on of body k, or of bodies k and k + 4 a half each, see
/// [`Machine::transpose_halves`].
#[inline(always)]
fn put_row<const N: usize>(
    state: &mut [Real],
    bodies: &[u32; WIDTH],
    (k, at): (usize, usize),
    row: Lanes,
    halves: bool,
) {
    if halves {
        let (vectors, _) = state.as_chunks_mut::<HALF>();
        let (parts, _) = row.0.as_chunks::<HALF>();
        vectors[place::<N, HALF>(bodies[k], at)] = parts[0];
        vectors[place::<N, HALF>(bodies[k + HALF], at)] = parts[1];
    } else {
        let (vectors, _) = state.as_chunks_mut::<WIDTH>();
        vectors[place::<N, WIDTH>(bodies[k], at)] = row.0;
    }
}

/// Which vector of `LEN` numbers holds number `at` of a body.
#[inline(always)]
fn place<const N: usize, const LEN: usize>(body: u32, at: usize) -> usize {
    body as usize * (Sizes::<N>::STATE / LEN) + at / LEN
}

impl<const N: usize, M: Machine> Pairing<N, M> {
    const VELOCITY: Part = 0;
    const DISPLACEMENT: Part = Sizes::<N>::VELOCITY;

    #[inline(always)]
    pub(super) fn gather(machine: M, block: &Block, rows: &[Lanes], state: &[Real]) -> Self {
        Self::gather_part(machine, block, rows, state, 2 * Sizes::<N>::VELOCITY)
    }

    /// Gathers the first `count` numbers of the states, and what else is in their vectors.
    #[inline(always)]
    pub(super) fn gather_part(machine: M, block: &Block, rows: &[Lanes], state: &[Real], count: usize) -> Self {
        Self {
            a: Self::gather_side(machine, &block.bodies_a, state, count),
            b: Self::gather_side(machine, &block.bodies_b, state, count),
            mass_a: rows[Layout::<N>::INVERSE_SQRT_MASS_A].on(machine),
            mass_b: rows[Layout::<N>::INVERSE_SQRT_MASS_B].on(machine),
            machine,
        }
    }

    #[inline(always)]
    fn gather_side(machine: M, bodies: &[u32; WIDTH], state: &[Real], count: usize) -> [Wide<M>; MAX_STATE] {
        let mut gathered = [Wide::zero(machine); MAX_STATE];
        for at in (0..count).step_by(WIDTH) {
            if is_half(at, count) {
                let mut rows = [Wide::zero(machine); HALF];
                let (halves, _) = state.as_chunks::<HALF>();
                for (row, (low, high)) in rows.iter_mut().zip(bodies[..HALF].iter().zip(&bodies[HALF..])) {
                    let mut both = Lanes::ZERO;
                    let (parts, _) = both.0.as_chunks_mut::<HALF>();
                    parts[0] = halves[place::<N, HALF>(*low, at)];
                    parts[1] = halves[place::<N, HALF>(*high, at)];
                    *row = both.on(machine);
                }
                gathered[at..at + HALF].copy_from_slice(&transpose_halves(machine, &rows));
            } else {
                let mut rows = [Wide::zero(machine); WIDTH];
                let (vectors, _) = state.as_chunks::<WIDTH>();
                for (row, body) in rows.iter_mut().zip(bodies) {
                    *row = Lanes(vectors[place::<N, WIDTH>(*body, at)]).on(machine);
                }
                gathered[at..at + WIDTH].copy_from_slice(&transpose(machine, &rows));
            }
        }
        gathered
    }

    #[inline(always)]
    pub(super) fn scatter(&self, block: &Block, states: &mut States<'_>) {
        Self::scatter_side(&self.a, &block.bodies_a, states);
        Self::scatter_side(&self.b, &block.bodies_b, states);
        if let States::InPlace(state) = states {
            // Row 0 stands for all bodies that no impulse moves; infinite impulses must not make it anything but zero.
            state[..Sizes::<N>::VELOCITY].fill(0.0);
        }
    }

    /// Displacements that share a vector with velocities are put back as they were.
    #[inline(always)]
    fn scatter_side(values: &[Wide<M>; MAX_STATE], bodies: &[u32; WIDTH], states: &mut States<'_>) {
        let machine = values[0].machine();
        for at in (0..Sizes::<N>::VELOCITY).step_by(WIDTH) {
            if is_half(at, Sizes::<N>::VELOCITY) {
                let mut columns = [values[at]; HALF];
                columns.copy_from_slice(&values[at..at + HALF]);
                Self::put_rows(&transpose_halves(machine, &columns), bodies, at, states);
            } else {
                let mut columns = [values[at]; WIDTH];
                columns.copy_from_slice(&values[at..at + WIDTH]);
                Self::put_rows(&transpose(machine, &columns), bodies, at, states);
            }
        }
    }

    #[inline(always)]
    fn put_rows<const LEN: usize>(rows: &[Wide<M>; LEN], bodies: &[u32; WIDTH], at: usize, states: &mut States<'_>) {
        match states {
            States::InPlace(state) => {
                for (k, row) in rows.iter().enumerate() {
                    put_row::<N>(state, bodies, (k, at), row.lanes(), LEN == HALF);
                }
            }
            States::Aside { put, .. } => {
                // The rows end first: nothing is taken from `put` in vain.
                for (row, lanes) in rows.iter().zip(put) {
                    *lanes = row.lanes();
                }
            }
        }
    }

    /// Relative velocity of b against a along `direction`, linear part.
    #[inline(always)]
    pub(super) fn measure_linear(&self, direction: &[Lanes]) -> Wide<M> {
        self.linear_of(Self::VELOCITY, direction)
    }

    /// The same, angular part, by the row's two arms.
    #[inline(always)]
    pub(super) fn measure_angular(&self, arms: &[Lanes]) -> Wide<M> {
        self.angular_of(Self::VELOCITY, arms)
    }

    /// What b has been displaced by against a along `direction`, linear part.
    #[inline(always)]
    pub(super) fn moved_linear(&self, direction: &[Lanes]) -> Wide<M> {
        self.linear_of(Self::DISPLACEMENT, direction)
    }

    /// The same, angular part, by the row's two arms.
    #[inline(always)]
    pub(super) fn moved_angular(&self, arms: &[Lanes]) -> Wide<M> {
        self.angular_of(Self::DISPLACEMENT, arms)
    }

    #[inline(always)]
    fn linear_of(&self, part: Part, direction: &[Lanes]) -> Wide<M> {
        let mut sum = Wide::zero(self.machine);
        for i in 0..N {
            sum += (self.b[part + i] * self.mass_b - self.a[part + i] * self.mass_a) * direction[i];
        }
        sum
    }

    #[inline(always)]
    fn angular_of(&self, part: Part, arms: &[Lanes]) -> Wide<M> {
        let mut sum_a = Wide::zero(self.machine);
        let mut sum_b = Wide::zero(self.machine);
        for k in 0..Sizes::<N>::K {
            sum_a += self.a[part + N + k] * arms[k];
            sum_b += self.b[part + N + k] * arms[Sizes::<N>::K + k];
        }
        sum_b - sum_a
    }

    /// What b's centre has been displaced by against a's.
    #[inline(always)]
    pub(super) fn between_centres(&self) -> [Wide<M>; N] {
        self.centres(Self::DISPLACEMENT)
    }

    /// What impulses have changed of the velocity of b's centre against a's.
    #[inline(always)]
    pub(super) fn velocity_between_centres(&self) -> [Wide<M>; N] {
        self.centres(Self::VELOCITY)
    }

    #[inline(always)]
    fn centres(&self, part: Part) -> [Wide<M>; N] {
        let mut between = [Wide::zero(self.machine); N];
        for (i, value) in between.iter_mut().enumerate() {
            *value = self.b[part + i] * self.mass_b - self.a[part + i] * self.mass_a;
        }
        between
    }

    /// What spins change of the velocity of b against a at a point that lies from both centres along `direction`, by the
    /// scaled distances `arm_a` and `arm_b`.
    #[inline(always)]
    pub(super) fn turning(&self, direction: &[Wide<M>; N], arm_a: Lanes, arm_b: Lanes) -> [Wide<M>; N] {
        let (arm_a, arm_b) = (arm_a.on(self.machine), arm_b.on(self.machine));
        let mut velocity = [Wide::zero(self.machine); N];
        let mut k = N;
        for i in 0..N {
            for j in i + 1..N {
                let spin = self.b[k] * arm_b - self.a[k] * arm_a;
                velocity[j] += spin * direction[i];
                velocity[i] -= spin * direction[j];
                k += 1;
            }
        }
        velocity
    }

    /// Applies an impulse on b to the velocities of both centres.
    #[inline(always)]
    pub(super) fn push(&mut self, impulse: &[Wide<M>; N]) {
        for (i, impulse) in impulse.iter().enumerate() {
            self.a[i] -= *impulse * self.mass_a;
            self.b[i] += *impulse * self.mass_b;
        }
    }

    /// Applies an impulse on b to the spins of both bodies: the counterpart of [`Pairing::turning`].
    #[inline(always)]
    pub(super) fn spin(&mut self, direction: &[Wide<M>; N], impulse: &[Wide<M>; N], arm_a: Lanes, arm_b: Lanes) {
        let (arm_a, arm_b) = (arm_a.on(self.machine), arm_b.on(self.machine));
        let mut k = N;
        for i in 0..N {
            for j in i + 1..N {
                let wedge = direction[i] * impulse[j] - direction[j] * impulse[i];
                self.a[k] -= wedge * arm_a;
                self.b[k] += wedge * arm_b;
                k += 1;
            }
        }
    }

    #[inline(always)]
    pub(super) fn apply_linear(&mut self, direction: &[Lanes], impulse: Wide<M>) {
        let (a, b) = (impulse * self.mass_a, impulse * self.mass_b);
        for i in 0..N {
            self.a[i] -= a * direction[i];
            self.b[i] += b * direction[i];
        }
    }

    #[inline(always)]
    pub(super) fn apply_angular(&mut self, arms: &[Lanes], impulse: Wide<M>) {
        for k in 0..Sizes::<N>::K {
            self.a[N + k] -= impulse * arms[k];
            self.b[N + k] += impulse * arms[Sizes::<N>::K + k];
        }
    }
}
