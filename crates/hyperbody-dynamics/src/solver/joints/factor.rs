//! Numbers of a cluster's linear system: block factors K = L D Lᵀ in the order of the plan, D with a block for each joint.
//!
//! What a joint has to do with all later ones is one matrix A with a row for each of its own rows, so that the loops run along
//! the later ones, of which there are many. Its place takes A K⁻¹ when the joint is eliminated.

use super::cluster::{Cluster, Node, Plan};
use super::place::Place;
use super::{JointRows, Row, block};
use crate::solver::bodies::SolverBody;

/// What the numbers are made from.
pub(super) struct Parts<'a, const N: usize> {
    pub(super) joints: &'a [JointRows<N>],
    pub(super) rows: &'a [Row<N>],
    pub(super) own: &'a [f64],
    pub(super) places: &'a [Place<N>],
    pub(super) bodies: &'a [SolverBody<N>],
}

/// Writes the factors of a cluster at the present place. Rows that are not engaged get no impulse.
pub(super) fn factorize<const N: usize>(
    plan: &Plan,
    cluster: &Cluster,
    parts: &Parts<'_, N>,
    values: &mut [f64],
    scratch: &mut Vec<f64>,
) {
    values[cluster.values.start as usize..cluster.values.end as usize].fill(0.0);
    assemble(plan, cluster, parts, values);
    for node in plan.nodes_of(cluster) {
        let (rows, later) = (node.rows as usize, node.later as usize);
        let (triangle, rest) = values[node.diagonal as usize..].split_at_mut(block::len(rows));
        block::factorize(triangle, rows);
        // A K⁻¹ takes the place of A, which is still needed; behind it a row of the product.
        scratch.clear();
        scratch.extend_from_slice(&rest[..rows * later]);
        scratch.resize((rows + 1) * later, 0.0);
        block::solve_columns(triangle, rows, &mut rest[..rows * later], later);
        eliminate(plan, node, values, scratch);
    }
}

/// Subtracts A K⁻¹ Aᵀ from what the later joints have to do with each other; `scratch` holds A and room for a row.
fn eliminate(plan: &Plan, node: &Node, values: &mut [f64], scratch: &mut [f64]) {
    let (rows, later) = (node.rows as usize, node.later as usize);
    let (a, product) = scratch.split_at_mut(rows * later);
    let blocks = plan.blocks_of(node);
    for (q, earlier) in blocks.iter().enumerate() {
        let first = earlier.column as usize;
        let other = &plan.nodes[earlier.node as usize];
        for j in 0..other.rows as usize {
            let product = &mut product[first..];
            product.fill(0.0);
            for k in 0..rows {
                let factor = values[node.matrix() + k * later + first + j];
                for (sum, a) in product.iter_mut().zip(&a[k * later + first..(k + 1) * later]) {
                    *sum += factor * a;
                }
            }
            let height = other.rows as usize;
            for i in j..height {
                values[other.diagonal as usize + block::len(i) + j] -= product[i];
            }
            for (p, last) in blocks.iter().enumerate().skip(q + 1) {
                let width = plan.nodes[last.node as usize].rows as usize;
                let target = plan.target(node, p, q) + j * other.later as usize;
                let from = last.column as usize - first;
                for (value, product) in values[target..target + width].iter_mut().zip(&product[from..from + width]) {
                    *value -= product;
                }
            }
        }
    }
}

fn assemble<const N: usize>(plan: &Plan, cluster: &Cluster, parts: &Parts<'_, N>, values: &mut [f64]) {
    for node in plan.nodes_of(cluster) {
        let joint = &parts.joints[node.joint as usize];
        let rows = &parts.rows[joint.first..joint.end];
        let held = joint.held - joint.first;
        let mut own = parts.own[joint.own..].iter();
        let mut at = node.diagonal as usize;
        for i in 0..rows.len() {
            let given = if i < held && !joint.exact { 1.0 + joint.soft.compliance() } else { 1.0 };
            for j in 0..=i {
                let own = own.next().copied().unwrap_or(0.0);
                if rows[i].engaged && rows[j].engaged {
                    values[at] = own * given;
                    if i == j {
                        values[at] += rows[i].compliance;
                    }
                } else if i == j {
                    values[at] = 1.0;
                }
                at += 1;
            }
        }
    }
    for coupling in &plan.couplings[cluster.couplings.start as usize..cluster.couplings.end as usize] {
        let body = &parts.bodies[parts.places[coupling.body as usize - 1].row];
        let inverse_mass = body.inverse_sqrt_mass * body.inverse_sqrt_mass;
        let of = |node: u32| {
            let joint = &parts.joints[plan.nodes[node as usize].joint as usize];
            &parts.rows[joint.first..joint.end]
        };
        let (later, earlier) = (of(coupling.later), of(coupling.earlier));
        let sign = if coupling.second[0] == coupling.second[1] { 1.0 } else { -1.0 };
        let stride = plan.nodes[coupling.earlier as usize].later as usize;
        for (j, other) in earlier.iter().enumerate() {
            let other_arm = if coupling.second[1] { &other.arm_b } else { &other.arm_a };
            let target = &mut values[coupling.offset as usize + j * stride..][..later.len()];
            for (value, row) in target.iter_mut().zip(later) {
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

/// Solves K x = y in place.
pub(super) fn solve(plan: &Plan, cluster: &Cluster, values: &[f64], y: &mut [f64], scratch: &mut Vec<f64>) {
    let nodes = plan.nodes_of(cluster);
    for node in nodes {
        let (rows, later, mine) = (node.rows as usize, node.later as usize, node.unknowns as usize);
        scratch.clear();
        scratch.resize(later, 0.0);
        for (k, &y) in y[mine..mine + rows].iter().enumerate() {
            let of_row = &values[node.matrix() + k * later..][..later];
            for (sum, value) in scratch.iter_mut().zip(of_row) {
                *sum += value * y;
            }
        }
        for block in plan.blocks_of(node) {
            let other = &plan.nodes[block.node as usize];
            for (y, sum) in other.of(y).iter_mut().zip(&scratch[block.column as usize..]) {
                *y -= sum;
            }
        }
        block::solve(&values[node.diagonal as usize..][..block::len(rows)], rows, &mut y[mine..mine + rows]);
    }
    for node in nodes.iter().rev() {
        let (rows, later, mine) = (node.rows as usize, node.later as usize, node.unknowns as usize);
        scratch.clear();
        for block in plan.blocks_of(node) {
            scratch.extend_from_slice(plan.nodes[block.node as usize].of(y));
        }
        for k in 0..rows {
            y[mine + k] -= dot(&values[node.matrix() + k * later..][..later], scratch);
        }
    }
}

/// Sums of products, in four strands, so that they can be vectors.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut strands = [0.0; 4];
    let (in_fours, rest) = (a.chunks_exact(4), a.chunks_exact(4).remainder());
    for (a, b) in in_fours.zip(b.chunks_exact(4)) {
        for k in 0..4 {
            strands[k] += a[k] * b[k];
        }
    }
    let left: f64 = rest.iter().zip(&b[a.len() - rest.len()..]).map(|(a, b)| a * b).sum();
    (strands[0] + strands[1]) + (strands[2] + strands[3]) + left
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
    const SPEC: RowSpec = RowSpec { coordinate: Coordinate::Length, role: Role::Held(0.0) };

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

    /// Chains, stars, loops and twice the same pair: the solution put back into the whole matrix gives the right side.
    #[test]
    fn solutions_of_clusters_fit_the_whole_matrix() {
        let shapes: [&[(usize, usize)]; 5] = [
            &[(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)],
            &[(1, 2), (1, 3), (1, 4), (1, 5), (0, 5), (5, 6), (5, 7)],
            &[(1, 2), (2, 3), (3, 4), (4, 1), (4, 5)],
            &[(0, 1), (1, 2), (2, 1), (2, 0), (2, 3), (3, 1)],
            &[(1, 2), (2, 3), (4, 5), (5, 6), (1, 4), (2, 5), (3, 6), (6, 7), (7, 8), (3, 8)],
        ];
        let mut seed = 11;
        for shape in shapes {
            let bodies: Vec<_> = (0..9)
                .map(|k| SolverBody::with_unit_moments(if k == 0 { 0.0 } else { 1.0 + random(&mut seed) }))
                .collect();
            let places: Vec<_> = (0..9).map(|k| Place::<N>::new(k, None, Vector::ZERO)).collect();
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
                    first,
                    held: rows.len(),
                    end: rows.len(),
                    own: 0,
                    soft: Softness::RIGID,
                    is_soft: false,
                    exact: true,
                    max_impulse: 0.0,
                    max_twist: 0.0,
                    step_impulse: Vector::ZERO,
                    step_twist: Bivector::ZERO,
                    axes: Matrix::IDENTITY,
                });
                let size = (rows.len() - first) as u32;
                let bodies = [a, b].map(|body| if body == 0 { 0 } else { body as u32 + 1 });
                links.push(Link { joint: index as u32, apart: false, bounded: false, bodies, rows: size });
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
            let mut solution = vec![0.0; rows.len()];
            let right: Vec<f64> = (0..rows.len()).map(|_| random(&mut seed)).collect();
            for cluster in &plan.clusters {
                factorize(&plan, cluster, &parts, &mut values, &mut Vec::new());
                let mut y = vec![0.0; cluster.unknowns as usize];
                for node in plan.nodes_of(cluster) {
                    let joint = &joints[node.joint as usize];
                    node.of(&mut y).copy_from_slice(&right[joint.first..joint.end]);
                    for (y, row) in node.of(&mut y).iter_mut().zip(&rows[joint.first..joint.end]) {
                        *y *= f64::from(u8::from(row.engaged));
                    }
                }
                solve(&plan, cluster, &values, &mut y, &mut Vec::new());
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
