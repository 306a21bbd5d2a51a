//! Numbers of bodies, eight bodies side by side, and what an impulse between two bodies does to them.

use crate::solver::bodies::{MAX_STATE, Sizes};
use crate::solver::lanes::{Lanes, WIDTH};
use crate::solver::machine::Machine;
use crate::solver::wide::{Wide, transpose};

/// Most numbers of a velocity, in whole vectors: 21 in 6D.
const MAX: usize = MAX_STATE / 2;

/// Vectors of a body: a velocity or a displacement.
pub(super) const fn vectors<const N: usize>() -> usize {
    Sizes::<N>::VELOCITY.div_ceil(WIDTH)
}

/// A scaled velocity or displacement of one body a lane, linear part first.
#[derive(Clone, Copy)]
pub(super) struct Side<M: Machine>([Wide<M>; MAX]);

impl<M: Machine> Side<M> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn gather<const N: usize>(machine: M, of_bodies: &[Lanes], bodies: &[u32; WIDTH]) -> Self {
        let mut gathered = [Wide::zero(machine); MAX];
        for at in 0..vectors::<N>() {
            let mut rows = [Wide::zero(machine); WIDTH];
            for (row, body) in rows.iter_mut().zip(bodies) {
                *row = of_bodies[*body as usize * vectors::<N>() + at].on(machine);
            }
            let columns = transpose(machine, &rows);
            let used = WIDTH.min(Sizes::<N>::VELOCITY - at * WIDTH);
            gathered[at * WIDTH..at * WIDTH + used].copy_from_slice(&columns[..used]);
        }
        Self(gathered)
    }

    /// Body 0 stands for all that no impulse moves, and stays zero whatever is put there.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn scatter<const N: usize>(&self, of_bodies: &mut [Lanes], bodies: &[u32; WIDTH]) {
        for at in 0..vectors::<N>() {
            let mut columns = [self.0[0]; WIDTH];
            columns.copy_from_slice(&self.0[at * WIDTH..(at + 1) * WIDTH]);
            for (body, row) in bodies.iter().zip(transpose(columns[0].machine(), &columns)) {
                of_bodies[*body as usize * vectors::<N>() + at] = row.lanes();
            }
            of_bodies[at] = Lanes::ZERO;
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn linear(&self, i: usize) -> Wide<M> {
        self.0[i]
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn angular<const N: usize>(&self, k: usize) -> Wide<M> {
        self.0[N + k]
    }

    /// Adds an impulse.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn push<const N: usize>(&mut self, impulse: &[Wide<M>; N], arm: &[Wide<M>; N], mass: Wide<M>) {
        let mut k = N;
        for i in 0..N {
            self.0[i] += impulse[i] * mass;
            for j in i + 1..N {
                self.0[k] += arm[i] * impulse[j] - arm[j] * impulse[i];
                k += 1;
            }
        }
    }

    /// The velocity at the end of an arm.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn velocity<const N: usize>(&self, arm: &[Wide<M>; N], mass: Wide<M>) -> [Wide<M>; N] {
        let mut velocity = act(&self.0[N..], arm);
        for i in 0..N {
            velocity[i] += self.0[i] * mass;
        }
        velocity
    }
}

/// What planes make of a vector: the velocity at an offset of an angular velocity.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn act<const N: usize, M: Machine>(planes: &[Wide<M>], r: &[Wide<M>; N]) -> [Wide<M>; N] {
    let mut result = *r;
    for j in 1..N {
        result[j] = planes[j - 1] * r[0];
    }
    result[0] = -(planes[0] * r[1]);
    for j in 2..N {
        result[0] -= planes[j - 1] * r[j];
    }
    let mut k = N - 1;
    for i in 1..N {
        for j in i + 1..N {
            result[j] += planes[k] * r[i];
            result[i] -= planes[k] * r[j];
            k += 1;
        }
    }
    result
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn load<const N: usize, M: Machine>(machine: M, lanes: &[Lanes], at: usize) -> [Wide<M>; N] {
    let mut vector = [Wide::zero(machine); N];
    for (value, lanes) in vector.iter_mut().zip(&lanes[at..at + N]) {
        *value = lanes.on(machine);
    }
    vector
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn put<const N: usize, M: Machine>(lanes: &mut [Lanes], at: usize, vector: &[Wide<M>; N]) {
    for (lanes, value) in lanes[at..at + N].iter_mut().zip(vector) {
        *lanes = value.lanes();
    }
}

#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn dot<const N: usize, M: Machine>(a: &[Wide<M>; N], b: &[Wide<M>; N]) -> Wide<M> {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum += a[i] * b[i];
    }
    sum
}
