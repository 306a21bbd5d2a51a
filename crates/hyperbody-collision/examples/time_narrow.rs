//! Nanoseconds per pair of the narrow phase, on one thread: `cargo run --release -p hyperbody-collision --example
//! time_narrow`.

use std::hint::black_box;
use std::time::Instant;

use hyperbody_collision::{Manifold, PairCache, Scratch, collide};
use hyperbody_geometry::Shape;
use hyperbody_geometry::regular::{self, Size};
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Bivector, Pose, Rotation, Vector};
use std::sync::Arc;

/// Times one pair in a steady state, with its history and without: the second body sways by a micrometre so that no
/// call repeats the last.
fn time<const N: usize>(name: &str, a: &Piece<N>, b: &Piece<N>, rotation: Rotation<N>, height: f64) {
    let (mut cache, mut scratch, mut out) = (PairCache::default(), Scratch::default(), Manifold::EMPTY);
    let rounds = 5_000_u32;
    let mut best = [f64::INFINITY; 2];
    let mut searches = [0; 2];
    for turn in 0..10 {
        let forget = turn % 2 == 1;
        let before = scratch.effort();
        let start = Instant::now();
        for round in 0..rounds {
            if forget {
                cache = PairCache::default();
            }
            let mut centre = Vector::splat(0.17);
            centre[1] = height + 1e-6 * f64::from(round % 7);
            let pose = Pose::new(rotation, centre);
            collide(a, &Pose::IDENTITY, b, &pose, 0.02, &mut cache, &mut scratch, &mut out);
            black_box(&out);
        }
        let each = start.elapsed().as_secs_f64() * 1e9 / f64::from(rounds);
        best[turn % 2] = best[turn % 2].min(each);
        let after = scratch.effort();
        if !forget {
            searches = [after.gjk_runs - before.gjk_runs, after.epa_runs - before.epa_runs];
        }
    }
    let depth = out.least_separation().unwrap_or(f64::NAN);
    println!(
        "{N}D  {name:<34} {:>9.0} ns, {:>9.0} ns without history  {:>2} points {depth:>9.4}, {:>3} % distance, {:>3} % penetration searches",
        best[0],
        best[1],
        out.points().len(),
        100 * searches[0] / u64::from(rounds),
        100 * searches[1] / u64::from(rounds)
    );
}

fn tilt<const N: usize>(angle: f64) -> Rotation<N> {
    let mut planes = Bivector::ZERO;
    for i in 0..N {
        for j in i + 1..N {
            planes.set(i, j, angle * (1.0 + 0.1 * (i + 2 * j) as f64));
        }
    }
    Rotation::exp(&planes)
}

fn boxes<const N: usize>() {
    let cuboid = |half: f64| {
        let shape = Shape::<N>::cuboid(Vector::splat(half)).expect("a positive half-extent");
        shape.pieces().remove(0).1
    };
    let (large, small) = (cuboid(1.0), cuboid(0.5));
    time("box on box, aligned", &large, &small, Rotation::IDENTITY, 1.499);
    time("box on box, turned by the normal", &large, &small, tilt_around_normal(0.3), 1.499);
    time("box on box, tilted by 0.001", &large, &small, tilt(1e-3), 1.499);
    time("box in box, tilted by 0.3", &large, &small, tilt(0.3), 1.5);
    time("box over box, apart", &large, &small, tilt(0.3), 2.4);
    // The same as polytopes: the distance and penetration searches instead of separating axes.
    let polytope = |size: f64| {
        let cube = regular::polytope::<N>("cube", Size::Edge(2.0 * size)).expect("a cube");
        Shape::polytope(Arc::new(cube)).expect("a solid").pieces().remove(0).1
    };
    let (large, small) = (polytope(1.0), polytope(0.5));
    time("cube on cube by search, turned", &large, &small, tilt_around_normal(0.3), 1.499);
    time("cube in cube by search, tilted 0.3", &large, &small, tilt(0.3), 1.5);
}

/// Turns every plane without axis 1, the contact's normal.
fn tilt_around_normal<const N: usize>(angle: f64) -> Rotation<N> {
    let mut planes = Bivector::ZERO;
    for i in (0..N).filter(|&i| i != 1) {
        for j in (i + 1..N).filter(|&j| j != 1) {
            planes.set(i, j, angle * (1.0 + 0.1 * (i + 2 * j) as f64));
        }
    }
    Rotation::exp(&planes)
}

/// Regular polytopes of circumradius 0.7: facet on facet of a large box, and two of them in any position.
fn polytopes<const N: usize>(name: &str) {
    let polytope = |size: f64| {
        let polytope = regular::polytope::<N>(name, Size::Circumradius(size)).expect("a regular polytope");
        Shape::polytope(Arc::new(polytope)).expect("a solid").pieces().remove(0).1
    };
    let die = polytope(0.7);
    let ground = Shape::cuboid(Vector::splat(1.0)).expect("a box").pieces().remove(0).1;
    for (label, turn, depth) in [("on a box, vertex down", 0.3, 0.002), ("on a box, apart by 5 mm", 0.3, -0.005)] {
        let height = height_above(&ground, &die, tilt(turn), depth);
        time(&format!("{name} {label}"), &ground, &die, tilt(turn), height);
    }
    for (label, turn, depth) in [
        ("pair, 2 mm deep", 0.3, 0.002),
        ("pair, 2 mm deep, turned", 0.9, 0.002),
        ("pair, 5 mm apart", 0.9, -0.005),
        ("pair, 0.3 deep", 0.9, 0.3),
    ] {
        let height = height_above(&die, &die, tilt(turn), depth);
        time(&format!("{name} {label}"), &die, &die, tilt(turn), height);
    }
}

/// The height at which b overlaps a by about the given depth: by halving.
fn height_above<const N: usize>(a: &Piece<N>, b: &Piece<N>, rotation: Rotation<N>, depth: f64) -> f64 {
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let mut centre = Vector::splat(0.17);
        centre[1] = middle;
        let mut out = Manifold::EMPTY;
        let pose = Pose::new(rotation, centre);
        collide(a, &Pose::IDENTITY, b, &pose, 10.0, &mut PairCache::default(), &mut Scratch::default(), &mut out);
        if out.least_separation().is_some_and(|separation| separation < -depth) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn main() {
    boxes::<2>();
    boxes::<3>();
    boxes::<4>();
    boxes::<5>();
    boxes::<6>();
    polytopes::<3>("dodecahedron");
    polytopes::<4>("5-cell");
    polytopes::<4>("16-cell");
    polytopes::<4>("24-cell");
    polytopes::<4>("120-cell");
    polytopes::<4>("600-cell");
    polytopes::<5>("simplex");
    polytopes::<5>("cross-polytope");
    polytopes::<6>("simplex");
    polytopes::<6>("cross-polytope");
}
