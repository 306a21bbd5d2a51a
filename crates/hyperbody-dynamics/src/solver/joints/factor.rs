//! Numbers of a cluster's linear system: its factors, front by front (`fronts`), and the solution by them.

use super::cluster::{Cluster, Coupling, Plan};
use super::fronts::{Front, SIDE_BY_SIDE};
use super::panel::{Eliminate, Solve};
use super::place::Place;
use super::{JointRows, Row};
use crate::solver::bodies::SolverBody;
use crate::solver::lanes::WIDTH;
use crate::solver::machine::Processor;

/// What the numbers are made from.
pub(super) struct Parts<'a, const N: usize> {
    pub(super) joints: &'a [JointRows<N>],
    pub(super) rows: &'a [Row<N>],
    pub(super) own: &'a [f64],
    pub(super) places: &'a [Place<N>],
    pub(super) bodies: &'a [SolverBody<N>],
}

/// Room for the making of factors and for solving, kept from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// What fronts change of the ones behind them.
    updates: Vec<f64>,
    weights: Vec<[f64; SIDE_BY_SIDE]>,
    part: Vec<f64>,
}

/// Writes the factors of a cluster at the present place. Rows that are not engaged get no impulse.
pub(super) fn factorize<const N: usize>(
    plan: &Plan,
    cluster: &Cluster,
    parts: &Parts<'_, N>,
    (values, scratch): (&mut [f64], &mut Scratch),
    processor: Processor,
) {
    scratch.updates.resize(plan.updates as usize, 0.0);
    for front in plan.fronts_of(cluster) {
        let panel = &mut values[front.panel()];
        clear(panel, front.stride());
        clear(&mut scratch.updates[front.update()], front.update_stride());
        parts.put_joints(plan, front, panel);
        for coupling in plan.couplings_of(front) {
            parts.put_coupling(plan, front, coupling, panel);
        }
        for child in plan.children_of(front) {
            take_update(child, plan.rows_in_next(child), front, panel, &mut scratch.updates);
        }
        let update = &mut scratch.updates[front.update()];
        let (nodes, weights) = (plan.nodes_in(front), &mut scratch.weights);
        processor.run(Eliminate { front, nodes, panel, update, weights });
    }
}

/// Writes zeros from the diagonal on, in whole vectors.
fn clear(columns: &mut [f64], height: usize) {
    for (k, column) in columns.chunks_exact_mut(height.max(1)).enumerate() {
        column[(k / WIDTH * WIDTH).min(height)..].fill(0.0);
    }
}

/// Solves K x = y in place.
pub(super) fn solve(
    plan: &Plan,
    cluster: &Cluster,
    (values, scratch): (&[f64], &mut Scratch),
    y: &mut [f64],
    processor: Processor,
) {
    processor.run(Solve { plan, cluster, values, y, part: &mut scratch.part });
}

/// Adds the update of a front to the next one, whose rows `into` are.
fn take_update(child: &Front, into: &[u32], front: &Front, panel: &mut [f64], updates: &mut [f64]) {
    if into.is_empty() {
        return;
    }
    let [from, to] = updates.get_disjoint_mut([child.update(), front.update()]).expect("rooms of updates are disjoint");
    let (own, stride, height) = (front.own(), front.stride(), front.update_stride());
    for (j, column) in from.chunks_exact(child.update_stride()).take(into.len()).enumerate() {
        let (rows, values) = (&into[j..], &column[j..]);
        match (into[j] as usize).checked_sub(own) {
            None => add(&mut panel[into[j] as usize * stride..][..stride], rows, values, 0),
            Some(around) => add(&mut to[around * height..][..height], rows, values, own),
        }
    }
}

/// Adds numbers to a column that begins at row `first`.
fn add(column: &mut [f64], rows: &[u32], values: &[f64], first: usize) {
    for (&row, value) in rows.iter().zip(values) {
        column[row as usize - first] += value;
    }
}

impl<const N: usize> Parts<'_, N> {
    /// What the rows of each joint have to do with each other.
    fn put_joints(&self, plan: &Plan, front: &Front, panel: &mut [f64]) {
        for node in plan.nodes_in(front) {
            let joint = &self.joints[node.joint as usize];
            let rows = &self.rows[joint.first..joint.end];
            let held = joint.held - joint.first;
            let mut own = self.own[joint.own..].iter();
            let first = (node.unknowns - front.first) as usize;
            for i in 0..rows.len() {
                let given = if i < held && !joint.exact { 1.0 + joint.soft.compliance() } else { 1.0 };
                for j in 0..=i {
                    let own = own.next().copied().unwrap_or(0.0);
                    let value = &mut panel[(first + j) * front.stride() + first + i];
                    if rows[i].engaged && rows[j].engaged {
                        *value = own * given;
                        if i == j {
                            *value += rows[i].compliance;
                        }
                    } else if i == j {
                        *value = 1.0;
                    }
                }
            }
        }
    }

    fn put_coupling(&self, plan: &Plan, front: &Front, coupling: &Coupling, panel: &mut [f64]) {
        let joint = |node: u32| &self.joints[plan.nodes[node as usize].joint as usize];
        let (later, earlier) = (joint(coupling.later), joint(coupling.earlier));
        let shared = if coupling.second[0] { later.b } else { later.a };
        let body = &self.bodies[self.places[shared].row];
        let inverse_mass = body.inverse_sqrt_mass * body.inverse_sqrt_mass;
        let (later, earlier) = (&self.rows[later.first..later.end], &self.rows[earlier.first..earlier.end]);
        let sign = if coupling.second[0] == coupling.second[1] { 1.0 } else { -1.0 };
        for (j, other) in earlier.iter().enumerate() {
            let other_arm = if coupling.second[1] { &other.arm_b } else { &other.arm_a };
            let start = (coupling.column as usize + j) * front.stride() + coupling.row as usize;
            for (value, row) in panel[start..].iter_mut().zip(later) {
                let arm = if coupling.second[0] { &row.arm_b } else { &row.arm_a };
                if row.engaged && other.engaged {
                    let mut sum = inverse_mass * row.direction.dot(other.direction);
                    for k in 0..hyperbody_math::planes::count(N) {
                        sum += arm[k] * other_arm[k];
                    }
                    *value += sign * sum;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use hyperbody_math::{Bivector, Matrix, Vector};

    use super::*;
    use crate::joint::{Coordinate, Role, RowSpec};
    use crate::solver::joints::cluster::Link;
    use crate::solver::joints::geometry::response;
    use crate::solver::softness::Softness;

    const N: usize = 3;
    const SPEC: RowSpec = RowSpec::new(Coordinate::Length, Role::Held(0.0));

    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 40) as f64 / f64::from(1 << 24) - 0.5
    }

    /// What two rows of two joints have to do with each other, body by body.
    fn answer(one: (&JointRows<N>, &Row<N>), other: (&JointRows<N>, &Row<N>), bodies: &[SolverBody<N>]) -> f64 {
        let sides = |joint: &JointRows<N>| [(joint.a, -1.0), (joint.b, 1.0)];
        let arm = |row: &Row<N>, sign: f64| if sign > 0.0 { row.arm_b } else { row.arm_a };
        let mut sum = 0.0;
        for (body, sign) in sides(one.0) {
            for (same, other_sign) in sides(other.0) {
                if body == same && bodies[body].inverse_sqrt_mass > 0.0 {
                    let mass = bodies[body].inverse_sqrt_mass * bodies[body].inverse_sqrt_mass;
                    let (arm, other_arm) = (arm(one.1, sign), arm(other.1, other_sign));
                    let turns: f64 = (0..N).map(|k| arm[k] * other_arm[k]).sum();
                    sum += sign * other_sign * (mass * one.1.direction.dot(other.1.direction) + turns);
                }
            }
        }
        sum
    }

    /// Pairs of a square net of which two corners are held.
    fn net(side: usize) -> Vec<(usize, usize)> {
        let body = |i: usize, j: usize| 1 + i * side + j;
        let mut pairs = vec![(0, body(0, 0)), (body(side - 1, side - 1), 0)];
        for i in 0..side {
            for j in 0..side {
                pairs.extend((i + 1 < side).then(|| (body(i, j), body(i + 1, j))));
                pairs.extend((j + 1 < side).then(|| (body(i, j + 1), body(i, j))));
            }
        }
        pairs
    }

    /// Chains, stars, loops, nets and twice the same pair: the solution put back into the whole matrix gives the right side.
    #[test]
    fn solutions_of_clusters_fit_the_whole_matrix() {
        let nets = [net(3), net(7), net(12)];
        let shapes: [&[(usize, usize)]; 8] = [
            &nets[0],
            &nets[1],
            &nets[2],
            &[(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)],
            &[(1, 2), (1, 3), (1, 4), (1, 5), (0, 5), (5, 6), (5, 7)],
            &[(1, 2), (2, 3), (3, 4), (4, 1), (4, 5)],
            &[(0, 1), (1, 2), (2, 1), (2, 0), (2, 3), (3, 1)],
            &[(1, 2), (2, 3), (4, 5), (5, 6), (1, 4), (2, 5), (3, 6), (6, 7), (7, 8), (3, 8)],
        ];
        let mut seed = 11;
        for shape in shapes {
            let bodies: Vec<_> = (0..150)
                .map(|k| SolverBody::with_unit_moments(if k == 0 { 0.0 } else { 1.0 + random(&mut seed) }))
                .collect();
            let places: Vec<_> = (0..150).map(|k| Place::<N>::new(k, None, Vector::ZERO)).collect();
            let (mut joints, mut rows, mut links) = (Vec::new(), Vec::new(), Vec::new());
            for (index, &(a, b)) in shape.iter().enumerate() {
                let first = rows.len();
                for _ in 0..=(index % 3) {
                    let mut row = Row::new(SPEC, [0.0; 2]);
                    row.direction = Vector::from_fn(|_| random(&mut seed));
                    let mut arm =
                        |body: usize| std::array::from_fn(|k| if k < N && body > 0 { random(&mut seed) } else { 0.0 });
                    (row.arm_a, row.arm_b) = (arm(a), arm(b));
                    row.compliance = 0.01;
                    row.engaged = rows.len() != 4;
                    rows.push(row);
                }
                joints.push(JointRows {
                    slot: 0,
                    a,
                    b,
                    offset_a: Vector::ZERO,
                    offset_b: Vector::ZERO,
                    frame_a: Matrix::IDENTITY,
                    frame_b: Matrix::IDENTITY,
                    groups: [0; N],
                    coupling: None,
                    first,
                    held: rows.len(),
                    end: rows.len(),
                    own: 0,
                    soft: Softness::RIGID,
                    rigid: Softness::RIGID,
                    is_soft: false,
                    exact: true,
                    meets_midway: false,
                    max_impulse: 0.0,
                    max_twist: 0.0,
                    step_impulse: Vector::ZERO,
                    step_twist: Bivector::ZERO,
                    axes: Matrix::IDENTITY,
                });
                let size = (rows.len() - first) as u32;
                let bodies = [a, b].map(|body| if body == 0 { 0 } else { body as u32 + 1 });
                links.push(Link {
                    joint: index as u32,
                    apart: false,
                    bounded: false,
                    plain: false,
                    bodies,
                    rows: size,
                });
            }
            let mut plan = Plan::default();
            plan.update(&links, bodies.len() + 1, 1e7);
            assert_eq!(plan.clusters.iter().map(|cluster| cluster.unknowns as usize).sum::<usize>(), rows.len());
            assert!(plan.clusters.iter().all(|cluster| cluster.whole));
            let mut own = Vec::new();
            for joint in &mut joints {
                joint.own = own.len();
                for i in joint.first..joint.end {
                    for j in joint.first..=i {
                        own.push(response(&rows[i], &rows[j], &bodies[joint.a], &bodies[joint.b]));
                    }
                }
            }
            let parts = Parts { joints: &joints, rows: &rows, own: &own, places: &places, bodies: &bodies };
            let mut values = vec![f64::NAN; plan.values as usize];
            let (mut scratch, processor) = (Scratch::default(), Processor::of_this_machine());
            let mut solution = vec![0.0; rows.len()];
            let right: Vec<f64> = (0..rows.len()).map(|_| random(&mut seed)).collect();
            for cluster in &plan.clusters {
                factorize(&plan, cluster, &parts, (&mut values, &mut scratch), processor);
                let mut y = vec![0.0; cluster.unknowns as usize];
                for node in plan.nodes_of(cluster) {
                    let joint = &joints[node.joint as usize];
                    node.of(&mut y).copy_from_slice(&right[joint.first..joint.end]);
                    for (y, row) in node.of(&mut y).iter_mut().zip(&rows[joint.first..joint.end]) {
                        *y *= f64::from(u8::from(row.engaged));
                    }
                }
                solve(&plan, cluster, (&values, &mut scratch), &mut y, processor);
                for node in plan.nodes_of(cluster) {
                    let joint = &joints[node.joint as usize];
                    solution[joint.first..joint.end].copy_from_slice(node.of(&mut y));
                }
            }
            for (i, joint) in joints.iter().enumerate() {
                for r in joint.first..joint.end {
                    if !rows[r].engaged {
                        assert_eq!(solution[r], 0.0);
                        continue;
                    }
                    let mut sum = rows[r].compliance * solution[r];
                    for other in &joints {
                        for s in other.first..other.end {
                            sum += answer((joint, &rows[r]), (other, &rows[s]), &bodies) * solution[s];
                        }
                    }
                    assert!((sum - right[r]).abs() < 1e-9, "joint {i}, row {r}: {sum} in place of {}", right[r]);
                }
            }
        }
    }
}
