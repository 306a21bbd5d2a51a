//! Contact ids that stay while the same features touch: what warm starting lives on.

use std::sync::Arc;

use crate::common::{Random, piece};
use hyperbody_collision::{Manifold, PairCache, Scratch, collide};
use hyperbody_geometry::regular::{Regular, Size};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Polytope, Shape};
use hyperbody_math::{Pose, Rotation, Vector};

/// A pair followed through time with one history.
struct Followed<'a, const N: usize> {
    a: &'a Piece<N>,
    b: &'a Piece<N>,
    cache: PairCache<N>,
    scratch: Scratch<N>,
}

impl<'a, const N: usize> Followed<'a, N> {
    fn new(a: &'a Piece<N>, b: &'a Piece<N>) -> Self {
        Self { a, b, cache: PairCache::default(), scratch: Scratch::default() }
    }

    fn at(&mut self, pose: &Pose<N>) -> Manifold<N> {
        let mut out = Manifold::EMPTY;
        let Self { a, b, cache, scratch } = self;
        collide(a, &Pose::IDENTITY, b, pose, 0.02, cache, scratch, &mut out);
        out
    }
}

fn ids<const N: usize>(manifold: &Manifold<N>) -> Vec<u32> {
    let mut ids: Vec<u32> = manifold.points().iter().map(|point| point.id).collect();
    ids.sort_unstable();
    ids
}

fn cuboid<const N: usize>(half: f64) -> Piece<N> {
    piece(Shape::cuboid(Vector::splat(half)).expect("a box"))
}

fn regular<const N: usize>(kind: Regular, radius: f64) -> Piece<N> {
    let solid = kind.polytope(Size::Circumradius(radius)).expect("a regular polytope");
    piece(Shape::polytope(Arc::new(solid)).expect("a solid"))
}

/// A cube slides and turns on a larger box, sinking and rising by a hair, tilting by a hair either way.
fn a_cube_keeps_its_corners<const N: usize>() {
    let (ground, cube) = (cuboid::<N>(3.0), cuboid(0.5));
    let polytope = regular::<N>(Regular::Cube, 0.5 * (N as f64).sqrt());
    for body in [&cube, &polytope] {
        let mut pair = Followed::new(&ground, body);
        let mut first = None;
        for step in 0..120 {
            let time = f64::from(step) * 0.01;
            let mut pose = Pose::from_translation(Vector::splat(0.3 * time));
            pose.translation[1] = 3.5 + 2e-4 * if step % 3 == 0 { 1.0 } else { -1.0 };
            let tilt = 1e-4 * if step % 2 == 0 { 1.0 } else { -1.0 };
            pose.rotation = Rotation::in_plane(0, 1, tilt);
            if N > 2 {
                pose.rotation = Rotation::in_plane(0, 2, 0.5 * time) * pose.rotation;
            }
            let found = ids(&pair.at(&pose));
            let expected = first.get_or_insert_with(|| found.clone());
            assert_eq!(&found, expected, "N = {N}: step {step} touches with the same corners");
        }
    }
}

#[test]
fn corners_of_a_cube_on_a_box() {
    for_every_dimension!(a_cube_keeps_its_corners);
}

fn random_solid<const N: usize>(random: &mut Random) -> Piece<N> {
    match random.below(4) {
        0 => cuboid(random.range(0.3, 0.7)),
        1 => regular(Regular::Simplex, random.range(0.5, 1.0)),
        2 => regular(Regular::CrossPolytope, random.range(0.5, 1.0)),
        _ => {
            let points: Vec<Vector<N>> = (0..2 * N + 4).map(|_| random.direction::<N>() * 0.8).collect();
            let solid = Polytope::from_points(&points).expect("points on a sphere span it");
            piece(Shape::polytope(Arc::new(solid)).expect("a solid"))
        }
    }
}

/// Shallow contacts in random positions, moved by less than a thousandth of the depth: nothing may change but by ties
/// that happen to lie within the motion.
fn small_motions_keep_ids<const N: usize>() {
    let mut random = Random(5 + N as u64);
    let (mut steps, mut changes) = (0, 0);
    let mut drift = 0.0_f64;
    for _ in 0..60 {
        let (a, b) = (random_solid::<N>(&mut random), random_solid::<N>(&mut random));
        let direction = random.direction::<N>();
        let rotation = random.rotation(2.0);
        let mut pair = Followed::new(&a, &b);
        // Come close until the two overlap by a millimetre or so.
        let mut distance = 4.0;
        for _ in 0..200 {
            let found = pair.at(&Pose::new(rotation, direction * distance));
            let depth = -found.least_separation().unwrap_or(1.0);
            if depth > 5e-4 {
                break;
            }
            distance -= if depth < -0.02 { 0.015 } else { (depth.abs() * 0.5).max(5e-4) };
        }
        let mut before = pair.at(&Pose::new(rotation, direction * distance));
        for _ in 0..20 {
            let pose = Pose::new(rotation * random.rotation(1e-7), direction * distance + random.vector(1e-7));
            let now = pair.at(&pose);
            steps += 1;
            changes += u32::from(ids(&now) != ids(&before));
            drift = drift.max((now.normal - before.normal).norm());
            before = now;
        }
    }
    assert!(changes * 100 <= steps, "N = {N}: {changes} of {steps} steps changed ids");
    assert!(drift < 1e-4, "N = {N}: a normal turned by {drift} while the bodies hardly moved");
}

#[test]
fn contacts_at_rest_keep_their_ids() {
    for_every_dimension!(small_motions_keep_ids);
}

/// The same history gives the same bits, whatever the working memory held before.
fn histories_repeat<const N: usize>() {
    let mut random = Random(77);
    let (a, b) = (random_solid::<N>(&mut random), random_solid::<N>(&mut random));
    let poses: Vec<Pose<N>> = (0..50).map(|_| Pose::new(random.rotation(0.3), random.vector(0.5))).collect();
    let mut used = Scratch::default();
    let mut run = |fresh: bool| {
        let mut cache = PairCache::default();
        let mut results = Vec::new();
        for pose in &poses {
            let mut out = Manifold::EMPTY;
            let mut own = Scratch::default();
            let scratch = if fresh { &mut own } else { &mut used };
            collide(&a, &Pose::IDENTITY, &b, pose, 0.02, &mut cache, scratch, &mut out);
            results.push(out);
        }
        results
    };
    let first = run(true);
    assert_eq!(first, run(false));
    assert_eq!(first, run(false));
}

#[test]
fn the_same_history_gives_the_same_bits() {
    for_every_dimension!(histories_repeat);
}
