//! The table of joints and free motions in the documentation, from the rank of each joint's rows.

use hyperbody_math::{Bivector, Matrix, Pose, Rotation, Vector, planes};

use super::place::Place;
use super::{JointRows, Row};
use crate::joint::{Joint, JointDef};
use crate::solver::bodies::SolverBody;
use crate::solver::softness::Softness;
use crate::{BodyHandle, joint::WORLD};

const BODY: BodyHandle = BodyHandle { index: 0, generation: 0 };

/// Rows of a matrix as its Gaussian elimination leaves them other than zero.
fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
        else {
            break;
        };
        if rows[pivot][column].abs() < 1e-9 {
            continue;
        }
        rows.swap(rank, pivot);
        let lead = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let factor = row[column] / lead[column];
            row.iter_mut().zip(&lead).for_each(|(entry, lead)| *entry -= factor * lead);
        }
        rank += 1;
    }
    rank
}

/// Places of both bodies that the joint allows: both turned alike, and b moved and turned in what is free.
fn places<const N: usize>(def: &JointDef<N>, seed: f64) -> [Place<N>; 2] {
    let number = |k: usize| (seed * (k as f64 + 1.3)).sin();
    let both = Rotation::<N>::exp(&Bivector::from_fn(|i, j| number(7 * i + j)));
    let mut free = Bivector::ZERO;
    for (k, (i, j)) in planes::all(N).enumerate().filter(|&(k, _)| !def.planes[k].locked) {
        free.set(i, j, 0.8 * number(20 + k));
    }
    let moved = Vector::from_fn(|i| if def.axes[i].locked { 0.0 } else { number(40 + i) });
    let turned = def.frame_a * Pose::new(Rotation::exp(&free), moved) * def.frame_b.inverse();
    let mut places = [Place::new(0, None, Vector::ZERO), Place::new(1, None, both.rotate(turned.translation))];
    places[0].now.turn = *both.matrix();
    places[1].now.turn = *(both * turned.rotation).matrix();
    places
}

/// Free translations, turns, and both together: N less the rank of the held rows, as seen by the translations and turns of b about its anchor.
/// Soft joints, whose rows are springs, hold nothing.
fn free_motions<const N: usize>(def: &JointDef<N>) -> (usize, usize, usize) {
    let at_rest = free_motions_at(def, 0.0);
    for turned in 1..5 {
        assert_eq!(free_motions_at(def, f64::from(turned)), at_rest, "it depends on where the bodies are");
    }
    at_rest
}

fn free_motions_at<const N: usize>(def: &JointDef<N>, seed: f64) -> (usize, usize, usize) {
    let joint = Joint::new(def.clone(), def.groups().expect("closed"), (WORLD, Vector::ZERO), (0, Vector::ZERO));
    let body = SolverBody::with_unit_moments(1.0);
    let world = SolverBody { inverse_sqrt_mass: 0.0, ..body };
    let [a, b] = places(def, seed);
    let mut rows: Vec<Row<N>> = joint.rows.iter().map(|&spec| Row::new(spec, [0.0; 2])).collect();
    let matrix = |rotation: Rotation<N>| *rotation.matrix();
    let rows_of = JointRows {
        slot: 0,
        a: 0,
        b: 1,
        offset_a: joint.arm_a,
        offset_b: joint.arm_b,
        frame_a: matrix(joint.frames().0),
        frame_b: matrix(joint.frames().1),
        groups: joint.groups,
        coupling: def.coupling.map(|coupling| (coupling, 0.0)),
        first: 0,
        held: joint.held,
        end: joint.rows.len(),
        own: 0,
        soft: Softness::RIGID,
        rigid: Softness::RIGID,
        is_soft: false,
        exact: false,
        meets_midway: false,
        max_impulse: f64::INFINITY,
        max_twist: f64::INFINITY,
        step_impulse: Vector::ZERO,
        step_twist: Bivector::ZERO,
        axes: Matrix::IDENTITY,
    };
    let geometry = rows_of.geometry(&a.now, &b.now, &rows);
    rows.iter_mut().for_each(|row| geometry.fill(row, &a, &b, &[world, body]));
    let held = if def.softness.is_some() { &[][..] } else { &rows[..joint.held] };
    let linear = held.iter().map(|row| row.direction.iter().collect()).collect();
    let angular = held.iter().map(|row| row.arm_b[..planes::count(N)].to_vec()).collect();
    let both =
        held.iter().map(|row| row.direction.iter().chain(row.arm_b[..planes::count(N)].iter().copied()).collect());
    let (translations, turns) = (rank(linear), rank(angular));
    assert_eq!(rank(both.collect()), held.len(), "the rows depend on each other");
    (N - translations, planes::count(N) - turns, N + planes::count(N) - held.len())
}

fn check<const N: usize>() {
    let frame: Pose<N> =
        Pose::new(Rotation::exp(&Bivector::from_fn(|i, j| 0.3 * i as f64 - 0.2 * j as f64)), Vector::ZERO);
    let turns = |n: usize| n * n.saturating_sub(1) / 2;
    let sideways: Vec<(usize, usize)> = (0..N - 1).map(|i| (i, N - 1)).collect();
    let expected: [(&str, JointDef<N>, (usize, usize)); 12] = [
        ("free", JointDef::free(None, BODY), (N, turns(N))),
        ("ball", JointDef::ball(None, BODY, Vector::ZERO, Vector::ZERO), (0, turns(N))),
        ("hinge", JointDef::hinge(None, BODY, frame, frame, (0, 1)), (0, 1)),
        ("axle of a line", JointDef::axle(None, BODY, frame, frame, 1), (0, turns(N - 1))),
        ("axle of a plane", JointDef::axle(None, BODY, frame, frame, 2), (0, turns(N - 2))),
        ("weld", JointDef::weld(None, BODY, frame, frame), (0, 0)),
        ("slider", JointDef::slider(None, BODY, frame, frame, 1), (1, 0)),
        ("rod", JointDef::distance(None, BODY, Vector::unit(0), Vector::ZERO, 1.0), (N - 1, turns(N))),
        ("rope", JointDef::rope(None, BODY, Vector::unit(0), Vector::ZERO, 1.0), (N, turns(N))),
        ("mouse", JointDef::mouse(BODY, Vector::ZERO, Vector::ZERO, 1.0), (N, turns(N))),
        ("grip", JointDef::grip(BODY, frame, frame, 1.0, 1.0), (N, turns(N))),
        ("lock", JointDef::lock(BODY, Pose::IDENTITY, &[N - 1], &sideways), (N - 1, turns(N - 1))),
    ];
    let page = include_str!("../../joint/mod.rs");
    for (name, def, free) in expected {
        let (translations, turns, _) = free_motions(&def);
        assert_eq!((translations, turns), free, "{name} in {N}D");
        assert_eq!(def.free_motions(), free, "what {name} in {N}D says of itself");
        let row = match name {
            "free" => "no joint",
            "axle of a line" => "axle that keeps a line",
            "axle of a plane" => "axle that keeps a plane",
            "rod" => "distance",
            "rope" | "mouse" | "grip" => "slack rope, mouse, grip",
            "lock" => "lock of an axis and its planes",
            other => other,
        };
        let line = page.lines().find(|line| line.starts_with(&format!("//! | {row} |"))).expect("a row of the table");
        let cell = line.split('|').nth(N).map(str::trim);
        assert_eq!(cell, Some(format!("{} + {}", free.0, free.1).as_str()), "the table's {row} in {N}D");
    }
    check_couplings::<N>(page);
}

/// One row each, which depends on none of the others that the joint holds.
fn check_couplings<const N: usize>(page: &str) {
    let (frame, beside) = (Pose::<N>::IDENTITY, Pose::from_translation(Vector::unit(0) * -1.5));
    let mut defs = vec![
        ("gear", JointDef::gear(None, BODY, beside, frame, (0, 1), (12, 30)), N + planes::count(N) - 1),
        ("rack", JointDef::rack(None, BODY, beside, frame, (0, 1), 0.4), N + planes::count(N) - 1),
    ];
    if N > 2 {
        defs.push(("screw", JointDef::screw(None, BODY, frame, frame, (0, 1), N - 1, 0.1), 1));
    }
    for (name, def, free) in defs {
        for turned in 0..5 {
            assert_eq!(free_motions_at(&def, f64::from(turned)).2, free, "{name} in {N}D");
        }
        let line = page.lines().find(|line| line.starts_with(&format!("//! | {name} |"))).expect("a row of the table");
        assert_eq!(
            line.split('|').nth(N).map(str::trim),
            Some(free.to_string().as_str()),
            "the table's {name} in {N}D"
        );
    }
}

#[test]
fn the_table_of_free_motions_is_the_rank_of_the_rows() {
    check::<2>();
    check::<3>();
    check::<4>();
    check::<5>();
    check::<6>();
}
