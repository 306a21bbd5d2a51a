//! The normal rows of one manifold, solved together.
//!
//! The points of a patch all press on the same two bodies: few of their impulses are independent, and sweeps over them
//! converge slowly and unevenly, so that a box that lands flat is turned a little by the order of its corners. So a
//! manifold's rows are solved as what they are, a small linear complementarity problem w = q + Kλ, λ ≥ 0, w ≥ 0, λᵀw = 0,
//! by block pivoting (J. J. Júdice and F. M. Pires, 1994): guess which points press, solve for their impulses, move
//! points that pull or that are pushed into to the other side, and repeat; if that goes in circles, one point at a time,
//! which in exact arithmetic it cannot (K. G. Murty, 1974). What is left after a bounded number of turns, sweeps in the space of the points do.
//!
//! Softness is what makes K definite: γ stands on the diagonal. Rigid rows have a small proximal term there, s(λ − held):
//! among the many equal answers of a patch it picks the one nearest to what the points held, which soft rows keep even.

use crate::solver::lanes::{Lanes, Real};
use crate::solver::machine::Machine;
use crate::solver::wide::Wide;

/// Most points of a manifold.
const MAX: usize = hyperbody_collision::MAX_POINTS;

/// Turns that move all wrong points at once. A flat patch takes one, an edge that lands two or three.
const BLOCK_TURNS: usize = 4;

/// Turns, of all, before sweeps take over: the later ones move one point each, which cannot go in circles.
const PIVOT_TURNS: usize = 16;

/// Sweeps where pivoting did not settle.
const SWEEPS: usize = 6;

/// Approach that a point without impulse may have, in parts of the largest speed that a point of the same contact takes
/// away: a hundred roundings.
const SLACK: Real = 1e-5;

/// The problem of one block of contacts of at most `P` points, lane by lane, and room to solve it in. One of a few points that is made
/// where it is solved, by a count that the compiler knows, stands in registers.
#[derive(Clone, Debug)]
pub(crate) struct NormalProblem<const P: usize = MAX> {
    /// Velocity that each row should lose: at the present impulses, bias included.
    pub(crate) excess: [Lanes; P],
    /// Impulses held at the start.
    pub(crate) held: [Lanes; P],
    /// γ: share of the impulse that counts as velocity; zero in rigid rows.
    pub(crate) softness: [Lanes; P],
    /// One where a point may press.
    pub(crate) allowed: [Lanes; P],
    /// The solution.
    pub(crate) impulse: [Lanes; P],
    free: [Lanes; P],
    velocity: [Lanes; P],
    active: [Lanes; P],
    /// Upper triangle.
    factor: [[Lanes; P]; P],
}

impl<const P: usize> Default for NormalProblem<P> {
    #[inline(always)]
    fn default() -> Self {
        let zero = [Lanes::ZERO; P];
        Self {
            excess: zero,
            held: zero,
            softness: zero,
            allowed: zero,
            impulse: zero,
            free: zero,
            velocity: zero,
            active: zero,
            factor: [zero; P],
        }
    }
}

/// Place of (i, j), i ≤ j, in the upper triangle of a symmetric `count`×`count` matrix by rows.
#[inline(always)]
pub(crate) const fn upper(count: usize, i: usize, j: usize) -> usize {
    i * count - i * (i + 1) / 2 + j
}

impl<const P: usize> NormalProblem<P> {
    /// Solves for `impulse`, `count` points. `k` is the response matrix of the rows, upper triangle by rows; `stiffener` what
    /// rigid rows have on its diagonal.
    #[inline(always)]
    pub(crate) fn solve<M: Machine>(&mut self, machine: M, k: &[Lanes], count: usize, stiffener: Lanes) {
        let count = count.min(P);
        let k = &k[..count * (count + 1) / 2];
        let stiffener = stiffener.on(machine);
        let slack = self.set_up(machine, k, count);
        let mut settled = Wide::zero(machine);
        for turn in 0..PIVOT_TURNS {
            self.factorize(machine, k, count, stiffener);
            self.substitute(machine, count, stiffener);
            settled = self.pivot(k, count, stiffener, slack, turn < BLOCK_TURNS);
            if settled.all_positive() {
                return;
            }
        }
        self.sweep(k, count, stiffener, settled);
    }

    /// The velocities without this manifold's impulses, and the first guess at the points that press; returns the
    /// approach that counts as none.
    #[inline(always)]
    fn set_up<M: Machine>(&mut self, machine: M, k: &[Lanes], count: usize) -> Wide<M> {
        let (zero, one) = (Wide::zero(machine), Wide::splat(machine, 1.0));
        let mut largest = zero;
        for i in 0..count {
            self.impulse[i] = (-self.held[i].on(machine)).lanes();
        }
        self.free[..count].copy_from_slice(&self.excess[..count]);
        add_product(machine, k, &self.impulse[..count], &mut self.free[..count]);
        for i in 0..count {
            let (held, excess) = (self.held[i].on(machine), self.excess[i].on(machine));
            let load = (held * k[upper(count, i, i)]).max(-excess);
            let allowed = self.allowed[i].on(machine);
            largest = largest.max(allowed * load);
            let presses = held.select_positive(one, (-excess).select_positive(one, zero));
            self.active[i] = (presses * allowed).lanes();
        }
        largest * Wide::splat(machine, SLACK)
    }

    /// U with K + Γ = UᵀDU on the active points, identity on the others; the diagonal holds 1/D.
    #[inline(always)]
    fn factorize<M: Machine>(&mut self, machine: M, k: &[Lanes], count: usize, stiffener: Wide<M>) {
        let one = Wide::splat(machine, 1.0);
        let mut responses = k;
        for i in 0..count {
            let (response, below) = responses.split_at(count - i);
            responses = below;
            let active = self.active[i].on(machine);
            let softness = self.softness[i].on(machine);
            let diagonal = softness.select_positive(softness, stiffener) + response[0];
            self.factor[i][i] = active.select_positive(diagonal, one).lanes();
            for j in i + 1..count {
                self.factor[i][j] = (active * self.active[j] * response[j - i]).lanes();
            }
        }
        for p in 0..count {
            let inverse = one.div(self.factor[p][p].on(machine));
            self.factor[p][p] = inverse.lanes();
            for i in p + 1..count {
                let scaled = inverse * self.factor[p][i];
                for j in i..count {
                    self.factor[i][j] = (self.factor[i][j].on(machine) - scaled * self.factor[p][j]).lanes();
                }
            }
            for i in p + 1..count {
                self.factor[p][i] = (inverse * self.factor[p][i]).lanes();
            }
        }
    }

    /// Impulses that stop the active points. A rigid row's stiffener is taken against the impulse it held.
    #[inline(always)]
    fn substitute<M: Machine>(&mut self, machine: M, count: usize, stiffener: Wide<M>) {
        let zero = Wide::zero(machine);
        for i in 0..count {
            let rigid = self.softness[i].on(machine).select_positive(zero, stiffener * self.held[i]);
            self.impulse[i] = ((rigid - self.free[i]) * self.active[i]).lanes();
        }
        for p in 0..count {
            let known = self.impulse[p].on(machine);
            for i in p + 1..count {
                self.impulse[i] = (self.impulse[i].on(machine) - known * self.factor[p][i]).lanes();
            }
        }
        for p in (0..count).rev() {
            let mut value = self.impulse[p].on(machine) * self.factor[p][p];
            for i in p + 1..count {
                value -= self.factor[p][i].on(machine) * self.impulse[i];
            }
            self.impulse[p] = value.lanes();
        }
    }

    /// Moves points, all or the first, to the side on which they belong; returns one in the lanes where all stood right.
    #[inline(always)]
    fn pivot<M: Machine>(
        &mut self,
        k: &[Lanes],
        count: usize,
        stiffener: Wide<M>,
        slack: Wide<M>,
        all: bool,
    ) -> Wide<M> {
        let machine = slack.machine();
        let (zero, one) = (Wide::zero(machine), Wide::splat(machine, 1.0));
        // Where all points press, as at rest, nothing is left that could approach.
        let mut doubtful = zero;
        for i in 0..count {
            let pulls = (-self.impulse[i].on(machine)).select_positive(one, zero);
            doubtful += self.active[i].on(machine).select_positive(pulls, self.allowed[i].on(machine));
        }
        if (Wide::splat(machine, 0.5) - doubtful).all_positive() {
            return one;
        }
        for i in 0..count {
            // The same proximal term as in the active rows, so that one problem is solved.
            let proximal = self.softness[i].on(machine).select_positive(zero, stiffener * self.held[i]);
            self.velocity[i] = (self.free[i].on(machine) - proximal + slack).lanes();
        }
        add_product(machine, k, &self.impulse[..count], &mut self.velocity[..count]);
        let mut settled = one;
        for i in 0..count {
            let active = self.active[i].on(machine);
            let pulls = (-self.impulse[i].on(machine)).select_positive(one, zero);
            let approaches = (-self.velocity[i].on(machine)).select_positive(self.allowed[i].on(machine), zero);
            let wrong = active.select_positive(pulls, approaches);
            let moves = if all { wrong } else { wrong * settled };
            self.active[i] = moves.select_positive(one - active, active).lanes();
            settled = wrong.select_positive(zero, settled);
        }
        settled
    }

    /// Projected Gauss–Seidel sweeps in the lanes that are not settled.
    #[inline(always)]
    fn sweep<M: Machine>(&mut self, k: &[Lanes], count: usize, stiffener: Wide<M>, settled: Wide<M>) {
        let machine = settled.machine();
        let zero = Wide::zero(machine);
        let solved = self.impulse;
        self.impulse[..count].copy_from_slice(&self.held[..count]);
        for _ in 0..SWEEPS {
            for i in 0..count {
                let softness = self.softness[i].on(machine);
                let impulse = self.impulse[i].on(machine);
                let mut velocity = self.free[i].on(machine) + softness * impulse;
                for j in 0..count {
                    let at = if i <= j { upper(count, i, j) } else { upper(count, j, i) };
                    velocity += k[at].on(machine) * self.impulse[j];
                }
                let diagonal = softness.select_positive(softness, stiffener) + k[upper(count, i, i)];
                let change = velocity.div(diagonal);
                self.impulse[i] = ((impulse - change).max(zero) * self.allowed[i]).lanes();
            }
        }
        for i in 0..count {
            self.impulse[i] = settled.select_positive(solved[i].on(machine), self.impulse[i].on(machine)).lanes();
        }
    }
}

/// Adds K x to `sum`; K symmetric, upper triangle by rows.
#[inline(always)]
fn add_product<M: Machine>(machine: M, k: &[Lanes], x: &[Lanes], sum: &mut [Lanes]) {
    let count = x.len();
    let mut rest = k;
    for i in 0..count {
        let (row, below) = rest.split_at(count - i);
        rest = below;
        let own = x[i].on(machine);
        let mut total = own * row[0];
        for ((entry, other), out) in row[1..].iter().zip(&x[i + 1..]).zip(&mut sum[i + 1..count]) {
            let entry = entry.on(machine);
            total += entry * *other;
            *out = (out.on(machine) + entry * own).lanes();
        }
        sum[i] = (sum[i].on(machine) + total).lanes();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::lanes::WIDTH;
    use crate::solver::machine::Plain;

    /// Random responses of few degrees of freedom, as rigid bodies have, against the conditions of complementarity.
    #[test]
    fn solutions_press_and_neither_pull_nor_let_approach() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as Real) / ((1_u64 << 24) as Real) * 2.0 - 1.0
        };
        let mut unsettled = 0;
        for trial in 0..2000 {
            let count = 1 + trial % 16;
            let freedoms = 4;
            let rows: Vec<[Real; 4]> = (0..count).map(|_| [1.0, random(), random(), random()]).collect();
            let mut k = vec![Lanes::ZERO; count * (count + 1) / 2];
            for i in 0..count {
                for j in i..count {
                    let product = (0..freedoms).map(|f| rows[i][f] * rows[j][f]).sum();
                    k[upper(count, i, j)] = Lanes::splat(product);
                }
            }
            let mut problem = <NormalProblem>::default();
            // Velocities that rigid motion can have, so that a solution without force elsewhere exists.
            let motion = [random() - 0.5, random(), random(), random()];
            for i in 0..count {
                let excess: Real = (0..freedoms).map(|f| rows[i][f] * motion[f]).sum();
                problem.excess[i] = Lanes([excess; WIDTH]);
                problem.allowed[i] = Lanes::splat(1.0);
            }
            problem.solve(Plain, &k, count, Lanes::splat(1e-3));
            let mut worst: Real = 0.0;
            for i in 0..count {
                let impulse = problem.impulse[i].0[trial % WIDTH];
                let mut velocity = problem.excess[i].0[0];
                for j in 0..count {
                    velocity += k[upper(count, i.min(j), i.max(j))].0[0] * problem.impulse[j].0[0];
                }
                assert!(impulse >= 0.0, "point {i} pulls with {impulse} in trial {trial}");
                worst = worst.max(-velocity).max(impulse * velocity);
            }
            // Sweeps, which take over where pivoting goes in circles, only come near.
            assert!(worst < 0.5, "trial {trial} leaves {worst}");
            unsettled += usize::from(worst > 0.01);
        }
        assert!(unsettled < 40, "{unsettled} of 2000 problems are not solved");
    }

    /// What stands in the other lanes does not change a bit of a lane, warm starts and soft rows included.
    #[test]
    fn lanes_do_not_touch_each_other() {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as Real) / ((1_u64 << 24) as Real) * 2.0 - 1.0
        };
        let count = 8;
        for trial in 0..200 {
            let mut k = vec![Lanes::ZERO; count * (count + 1) / 2];
            let mut problem = <NormalProblem>::default();
            let mut fill = |lane: usize, points: usize, k: &mut [Lanes], problem: &mut NormalProblem| {
                let rows: Vec<[Real; 3]> = (0..points).map(|_| [1.0, random(), random()]).collect();
                for i in 0..count {
                    for j in i..count {
                        let inside = j < points;
                        let product = if inside { (0..3).map(|f| rows[i][f] * rows[j][f]).sum() } else { 0.0 };
                        k[upper(count, i, j)].0[lane] = product;
                    }
                    let inside = i < points;
                    problem.excess[i].0[lane] = random();
                    problem.held[i].0[lane] = if inside { random().max(0.0) } else { 0.0 };
                    problem.softness[i].0[lane] = if random() > 0.0 { 0.05 } else { 0.0 };
                    problem.allowed[i].0[lane] = if inside { 1.0 } else { 0.0 };
                }
            };
            for lane in 0..WIDTH {
                fill(lane, 1 + (trial + lane) % count, &mut k, &mut problem);
            }
            let mut alone = problem.clone();
            let mut k_alone = k.clone();
            for lane in 1..WIDTH {
                fill(lane, 1 + (trial + 3 * lane) % count, &mut k_alone, &mut alone);
            }
            problem.solve(Plain, &k, count, Lanes::splat(1e-4));
            alone.solve(Plain, &k_alone, count, Lanes::splat(1e-4));
            for i in 0..count {
                assert_eq!(
                    problem.impulse[i].0[0].to_bits(),
                    alone.impulse[i].0[0].to_bits(),
                    "point {i}, trial {trial}"
                );
            }
        }
    }
}
