//! Arithmetic on fronts: symmetric matrices factored as A = (A D⁻¹) D (A D⁻¹)ᵀ column by column, in vectors.
//!
//! Columns keep A below the diagonal and 1/D on it; what stands above the diagonal is never read. Every number takes the same
//! operations in the same order on every machine.

use super::cluster::{Cluster, Node, Plan};
use super::fronts::{Front, SIDE_BY_SIDE};
use crate::solver::lanes::WIDTH;
use crate::solver::machine::{Machine, Pass};
use crate::solver::wide::Doubles;

/// Share of a row's response that must be left when the rows of its joint before it are accounted for: a row that is all but a
/// combination of others is left out, as its impulse would be anything.
pub(super) const INDEPENDENT: f64 = 1e-9;

/// Eliminates the own unknowns of a front.
pub(super) struct Eliminate<'a> {
    pub(super) front: &'a Front,
    pub(super) nodes: &'a [Node],
    /// Own columns.
    pub(super) panel: &'a mut [f64],
    /// Columns of the unknowns around.
    pub(super) update: &'a mut [f64],
    pub(super) weights: &'a mut Vec<[f64; SIDE_BY_SIDE]>,
}

impl Pass for Eliminate<'_> {
    #[inline(always)]
    fn run<M: Machine>(mut self, machine: M) {
        self.weights.clear();
        self.weights.resize(self.front.own(), [0.0; SIDE_BY_SIDE]);
        for node in self.nodes {
            let first = (node.unknowns - self.front.first) as usize;
            for column in first..first + node.rows as usize {
                self.factor_column(machine, column, first);
            }
        }
        self.subtract_from_update(machine);
    }
}

impl Eliminate<'_> {
    /// Subtracts from a column what the columns before it have to do with it. Its joint begins at column `first`.
    #[inline(always)]
    fn factor_column<M: Machine>(&mut self, machine: M, column: usize, first: usize) {
        let (own, stride) = (self.front.own(), self.front.stride());
        let (before, from) = self.panel.split_at_mut(column * stride);
        let (of_own, below) = from[..stride].split_at_mut(own);
        let mut whole = 0.0;
        for ((k, earlier), weight) in before.chunks_exact(stride).enumerate().zip(self.weights.iter_mut()) {
            weight[0] = earlier[column] * earlier[k];
            if k >= first {
                whole += weight[0] * earlier[column];
            }
            for (value, earlier) in of_own[column..].iter_mut().zip(&earlier[column..own]) {
                *value -= earlier * weight[0];
            }
        }
        let (vectors, _) = below.as_chunks_mut::<WIDTH>();
        for (at, vector) in vectors.iter_mut().enumerate() {
            let mut sum = Doubles::of(machine, *vector);
            let start = own + at * WIDTH;
            for (earlier, weight) in before.chunks_exact(stride).zip(self.weights.iter()) {
                sum -= eight(machine, &earlier[start..]) * Doubles::of(machine, [weight[0]; WIDTH]);
            }
            *vector = sum.values();
        }
        let rest = of_own[column];
        whole += rest;
        of_own[column] = if rest > INDEPENDENT * whole { 1.0 / rest } else { 0.0 };
    }

    /// Subtracts A D⁻¹ Aᵀ, a few columns side by side.
    #[inline(always)]
    fn subtract_from_update<M: Machine>(&mut self, machine: M) {
        let (own, stride) = (self.front.own(), self.front.stride());
        let height = self.front.update_stride();
        let columns = self.update.chunks_exact_mut(SIDE_BY_SIDE * height.max(1));
        for (four, columns) in columns.enumerate() {
            let first = four * SIDE_BY_SIDE;
            for ((k, earlier), weights) in self.panel.chunks_exact(stride).enumerate().zip(self.weights.iter_mut()) {
                for (weight, value) in weights.iter_mut().zip(&earlier[own + first..]) {
                    *weight = value * earlier[k];
                }
            }
            let (vectors, _) = columns.as_chunks_mut::<WIDTH>();
            let in_column = height / WIDTH;
            for at in first / WIDTH..in_column {
                let mut sums = [Doubles::zero(machine); SIDE_BY_SIDE];
                for (column, sum) in sums.iter_mut().enumerate() {
                    *sum = Doubles::of(machine, vectors[column * in_column + at]);
                }
                let start = own + at * WIDTH;
                for (earlier, weights) in self.panel.chunks_exact(stride).zip(self.weights.iter()) {
                    let earlier = eight(machine, &earlier[start..]);
                    for (sum, weight) in sums.iter_mut().zip(weights) {
                        *sum -= earlier * Doubles::of(machine, [*weight; WIDTH]);
                    }
                }
                for (column, sum) in sums.iter().enumerate() {
                    vectors[column * in_column + at] = sum.values();
                }
            }
        }
    }
}

/// Solves K x = y in place.
pub(super) struct Solve<'a> {
    pub(super) plan: &'a Plan,
    pub(super) cluster: &'a Cluster,
    pub(super) values: &'a [f64],
    pub(super) y: &'a mut [f64],
    /// Room for the part of one front.
    pub(super) part: &'a mut Vec<f64>,
}

impl Pass for Solve<'_> {
    #[inline(always)]
    fn run<M: Machine>(self, machine: M) {
        let Self { plan, cluster, values, y, part } = self;
        let fronts = plan.fronts_of(cluster);
        for front in fronts {
            let own = front.first as usize..front.first as usize + front.own();
            part.clear();
            part.extend_from_slice(&y[own.clone()]);
            part.resize(front.stride(), 0.0);
            forwards(machine, front, &values[front.panel()], part);
            y[own].copy_from_slice(&part[..front.own()]);
            for (&unknown, part) in plan.around(front).iter().zip(&part[front.own()..]) {
                y[unknown as usize] += part;
            }
        }
        for front in fronts.iter().rev() {
            let own = front.first as usize..front.first as usize + front.own();
            part.clear();
            part.extend_from_slice(&y[own.clone()]);
            part.extend(plan.around(front).iter().map(|&unknown| y[unknown as usize]));
            part.resize(front.stride(), 0.0);
            backwards(machine, front, &values[front.panel()], part);
            y[own].copy_from_slice(&part[..front.own()]);
        }
    }
}

/// Own unknowns become those of the diagonal system, the others what those take from them.
#[inline(always)]
fn forwards<M: Machine>(machine: M, front: &Front, panel: &[f64], part: &mut [f64]) {
    let (own, below) = part.split_at_mut(front.own());
    let (below, _) = below.as_chunks_mut::<WIDTH>();
    for (k, column) in panel.chunks_exact(front.stride()).enumerate() {
        let (of_own, of_below) = column.split_at(own.len());
        let weight = own[k] * of_own[k];
        own[k] = weight;
        for (value, column) in own[k + 1..].iter_mut().zip(&of_own[k + 1..]) {
            *value -= column * weight;
        }
        let (of_below, _) = of_below.as_chunks::<WIDTH>();
        let weight = Doubles::of(machine, [weight; WIDTH]);
        for (value, column) in below.iter_mut().zip(of_below) {
            *value = (Doubles::of(machine, *value) - Doubles::of(machine, *column) * weight).values();
        }
    }
}

/// Own unknowns become the solution, where the others are.
#[inline(always)]
fn backwards<M: Machine>(machine: M, front: &Front, panel: &[f64], part: &mut [f64]) {
    let (own, below) = part.split_at_mut(front.own());
    let (below, _) = below.as_chunks::<WIDTH>();
    for (k, column) in panel.chunks_exact(front.stride()).enumerate().rev() {
        let (of_own, of_below) = column.split_at(own.len());
        let (of_below, _) = of_below.as_chunks::<WIDTH>();
        let mut strands = Doubles::zero(machine);
        for (value, column) in below.iter().zip(of_below) {
            strands += Doubles::of(machine, *value) * Doubles::of(machine, *column);
        }
        let [a, b, c, d, e, f, g, h] = strands.values();
        let mut sum = ((a + b) + (c + d)) + ((e + f) + (g + h));
        for (value, column) in own[k + 1..].iter().zip(&of_own[k + 1..]) {
            sum += value * column;
        }
        own[k] -= sum * of_own[k];
    }
}

#[inline(always)]
fn eight<M: Machine>(machine: M, values: &[f64]) -> Doubles<M> {
    let mut eight = [0.0; WIDTH];
    eight.copy_from_slice(&values[..WIDTH]);
    Doubles::of(machine, eight)
}
