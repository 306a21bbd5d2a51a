//! Rays against single shapes of every kind: the first hit against a search for the root of the signed distance, which
//! is convex along a line.

use std::sync::Arc;

use crate::common::{Random, piece};
use hyperbody_collision::point;
use hyperbody_collision::ray::{Ray, cast, cast_on_piece};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, FaceLattice, Polytope, Shape};
use hyperbody_math::{Pose, Vector};

/// A function that is negative inside, zero on the surface, positive outside, and convex.
struct Outside<'a, const N: usize> {
    piece: &'a Piece<N>,
    lattice: Option<FaceLattice>,
}

impl<'a, const N: usize> Outside<'a, N> {
    fn new(piece: &'a Piece<N>) -> Self {
        let lattice = match piece {
            Piece::Convex(Convex { core: Core::Polytope(polytope), radius }) if *radius > 0.0 => {
                Some(polytope.face_lattice())
            }
            _ => None,
        };
        Self { piece, lattice }
    }

    fn at(&self, p: Vector<N>) -> f64 {
        match self.piece {
            Piece::HalfSpace { normal, offset } => normal.dot(p) - offset,
            Piece::Convex(Convex { core, radius }) => match core {
                Core::Point => p.norm() - radius,
                Core::Segment { half } => p.distance(*half * (p.dot(*half) / half.norm_sq()).clamp(-1.0, 1.0)) - radius,
                Core::Box { half_extents } => {
                    let out = p.abs() - *half_extents;
                    let outside = out.max(Vector::ZERO).norm();
                    let inside = out.iter().fold(f64::NEG_INFINITY, f64::max).min(0.0);
                    outside + inside - radius
                }
                Core::Polytope(polytope) => {
                    let deepest =
                        polytope.facets().iter().map(|f| f.normal.dot(p) - f.offset).fold(f64::NEG_INFINITY, f64::max);
                    match &self.lattice {
                        Some(lattice) if deepest > 0.0 => nearest_face(polytope, lattice, p) - radius,
                        _ => deepest - radius,
                    }
                }
            },
        }
    }
}

/// Distance to the nearest of all faces whose perpendicular from the point has its foot in the polytope.
fn nearest_face<const N: usize>(polytope: &Polytope<N>, lattice: &FaceLattice, p: Vector<N>) -> f64 {
    let size = polytope.bounding_radius();
    let mut least = f64::INFINITY;
    for rank in 0..N {
        for face in lattice.faces(rank) {
            let base = polytope.vertices()[face.vertices[0] as usize];
            let mut basis: Vec<Vector<N>> = Vec::new();
            for &v in &face.vertices[1..] {
                let edge = polytope.vertices()[v as usize] - base;
                let rest = basis.iter().fold(edge, |rest, &b| rest - b * b.dot(rest));
                let rest = basis.iter().fold(rest, |rest, &b| rest - b * b.dot(rest));
                if basis.len() < rank && rest.norm() > 1e-6 * edge.norm() {
                    basis.push(rest / rest.norm());
                }
            }
            let foot = basis.iter().fold(base, |foot, &b| foot + b * b.dot(p - base));
            if polytope.facets().iter().all(|f| f.normal.dot(foot) - f.offset <= 1e-9 * size) {
                least = least.min(p.distance(foot));
            }
        }
    }
    least
}

/// The first root along the ray, by the minimum of the convex function and bisection before it: `Err(least)` if the
/// least value along the ray is so close to zero that rounding decides, `Ok(None)` if there is no root.
fn root<const N: usize>(outside: &Outside<'_, N>, ray: &Ray<N>, tolerance: f64) -> Result<Option<f64>, f64> {
    let f = |t: f64| outside.at(ray.at(t));
    let (mut low, mut high) = (0.0, ray.max_fraction);
    for _ in 0..130 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if f(a) <= f(b) {
            high = b;
        } else {
            low = a;
        }
    }
    let least = f(low).min(f(high)).min(f(ray.max_fraction));
    if f(0.0).abs() < tolerance || least.abs() < tolerance {
        return Err(least);
    }
    if f(0.0) < 0.0 {
        return Ok(Some(0.0));
    }
    if least > 0.0 {
        return Ok(None);
    }
    let (mut before, mut after) = (0.0, if f(low) < 0.0 { low } else { high });
    if f(after) > 0.0 {
        after = ray.max_fraction;
    }
    for _ in 0..200 {
        let middle = 0.5 * (before + after);
        if f(middle) > 0.0 {
            before = middle;
        } else {
            after = middle;
        }
    }
    Ok(Some(0.5 * (before + after)))
}

fn polytope<const N: usize>(random: &mut Random) -> Shape<N> {
    let points: Vec<Vector<N>> = if random.below(2) == 0 {
        (0..N)
            .flat_map(|i| [Vector::unit(i) * random.range(0.4, 1.0), Vector::unit(i) * -random.range(0.4, 1.0)])
            .collect()
    } else {
        (0..N + 2).map(|_| random.direction::<N>()).collect()
    };
    Polytope::from_points(&points)
        .and_then(|polytope| Shape::polytope(Arc::new(polytope)))
        .unwrap_or_else(|_| Shape::cuboid(Vector::splat(0.5)).expect("a box"))
}

fn shape<const N: usize>(random: &mut Random, kind: usize) -> Shape<N> {
    let cuboid = |random: &mut Random| Shape::cuboid(Vector::from_fn(|_| random.log_range(0.1, 1.0)));
    match kind {
        0 => Shape::ball(random.log_range(0.01, 2.0)),
        1 => cuboid(random),
        2 => Shape::capsule(random.range(0.01, 1.0), random.range(0.05, 1.0), random.below(N)),
        3 => Shape::half_space(random.direction::<N>(), random.range(-1.0, 1.0)),
        4 => Ok(polytope(random)),
        5 => cuboid(random).and_then(|core| Shape::rounded(core, random.range(0.01, 0.5))),
        _ => Shape::rounded(polytope(random), random.range(0.01, 0.5)),
    }
    .expect("lengths in range")
}

/// A ray at the shape: near or far, along an axis or not, past it, or from inside.
fn ray<const N: usize>(random: &mut Random) -> Ray<N> {
    let far = if random.below(8) == 0 { 100.0 } else { 3.0 };
    let reach = if random.below(4) == 0 { 0.5 } else { far };
    let origin = random.vector::<N>(reach);
    let target = random.vector::<N>(1.0);
    let mut direction = (target - origin) * random.log_range(0.1, 10.0);
    if random.below(4) == 0 {
        let axis = random.below(N);
        direction = Vector::unit(axis) * if origin[axis] > 0.0 { -2.0 } else { 2.0 };
    }
    Ray::new(origin, direction).up_to(random.range(0.5, 3.0) * (origin.norm() + 1.0) / direction.norm())
}

fn hits_are_first_roots<const N: usize>() {
    let mut random = Random(77 + N as u64);
    let (mut hits, mut misses, mut skipped) = (0, 0, 0);
    for round in 0..60 * 7 {
        let kind = round % 7;
        let piece = piece(shape::<N>(&mut random, kind));
        let outside = Outside::new(&piece);
        for _ in 0..if kind == 6 { 2 } else { 12 } {
            let ray = ray::<N>(&mut random);
            let tolerance = 1e-9 * (1.0 + ray.origin.norm());
            let hit = cast_on_piece(&ray, &piece);
            let expected = match root(&outside, &ray, tolerance) {
                Ok(expected) => expected,
                Err(_) => {
                    skipped += 1;
                    continue;
                }
            };
            assert_eq!(hit.is_some(), expected.is_some(), "{ray:?} on {piece:?}: {hit:?} against {expected:?}");
            let (Some(hit), Some(expected)) = (hit, expected) else {
                misses += 1;
                continue;
            };
            hits += 1;
            let speed = ray.direction.norm();
            // Where the ray nearly grazes, the root itself is as uncertain as the square root of rounding.
            let depth = -hit.normal.dot(ray.direction) / speed;
            let slack = tolerance * 1e-3 / if hit.inside { 1.0 } else { depth.max(1e-6) };
            let error = (hit.fraction - expected).abs() * speed;
            assert!(error <= slack, "{ray:?} on {piece:?}: {hit:?} against {expected}, {error:e} m apart");
            assert_eq!(hit.inside, point::contains(&piece, ray.origin));
            if hit.inside {
                assert_eq!((hit.fraction, hit.point, hit.normal), (0.0, ray.origin, Vector::ZERO));
                continue;
            }
            assert!((hit.normal.norm() - 1.0).abs() < 1e-12, "{hit:?}");
            assert!(outside.at(hit.point).abs() < 1e-12 * (1.0 + ray.origin.norm()), "{hit:?} is off the surface");
            assert!(hit.normal.dot(ray.direction) <= 0.0, "{hit:?} is met from behind");
            // The normal points where the surface falls away: a step out is out by as much.
            let step = 1e-4;
            assert!((outside.at(hit.point + hit.normal * step) - step).abs() < 1e-9, "{hit:?} on {piece:?}");
        }
    }
    assert!(hits > 900 && misses > 600 && skipped < 60, "{hits} hits, {misses} misses, {skipped} skipped in {N}D");
}

#[test]
fn hits_are_the_first_roots_of_the_distance() {
    for_every_dimension!(hits_are_first_roots);
}

fn facets_are_named<const N: usize>() {
    let mut random = Random(5);
    let half = Vector::from_fn(|i| 0.3 + 0.1 * i as f64);
    let cuboid = Shape::<N>::cuboid(half).expect("a box");
    let rounded = Shape::rounded(cuboid.clone(), 0.1).expect("a rounded box");
    for axis in 0..N {
        for positive in [false, true] {
            let sign = if positive { 1.0 } else { -1.0 };
            let mut from = Vector::from_fn(|i| half[i] * random.range(-0.9, 0.9));
            from[axis] = sign * 5.0;
            let ray = Ray::new(from, Vector::unit(axis) * -sign);
            for shape in [&cuboid, &rounded] {
                let hit = cast(&ray, shape, &Pose::IDENTITY).expect("straight at it");
                assert_eq!(hit.facet, Some(2 * axis as u32 + u32::from(positive)));
                assert_eq!(hit.normal, Vector::unit(axis) * sign);
            }
        }
    }
    let Shape::Polytope(polytope) = polytope::<N>(&mut random) else { panic!("not a polytope") };
    let shape = Shape::polytope(Arc::clone(&polytope)).expect("a polytope");
    for (index, facet) in polytope.facets().iter().enumerate() {
        let middle = facet.vertices.iter().fold(Vector::ZERO, |sum, &v| sum + polytope.vertices()[v as usize])
            / facet.vertices.len() as f64;
        let ray = Ray::between(middle + facet.normal, middle - facet.normal);
        let hit = cast(&ray, &shape, &Pose::IDENTITY).expect("straight at it");
        assert_eq!(hit.facet, Some(index as u32));
        assert!((hit.fraction - 0.5).abs() < 1e-12);
    }
}

#[test]
fn facets_are_named_by_number() {
    for_every_dimension!(facets_are_named);
}

fn compounds_give_first_part<const N: usize>() {
    let mut random = Random(9);
    for _ in 0..40 {
        let parts: Vec<(Pose<N>, Shape<N>)> =
            (0..5).map(|i| (random.pose(1.0), shape::<N>(&mut random, [0, 1, 2, 4, 5][i]))).collect();
        let compound = Shape::compound(parts.clone()).expect("convex parts");
        let pose = random.pose(1.0);
        for _ in 0..10 {
            let ray = ray::<N>(&mut random);
            let found = cast(&ray, &compound, &pose);
            let alone = parts.iter().map(|(part_pose, part)| cast(&ray, part, &(pose * *part_pose)));
            let first = alone
                .enumerate()
                .filter_map(|(part, hit)| hit.map(|hit| (part, hit)))
                .reduce(|best, next| if next.1.fraction < best.1.fraction { next } else { best });
            assert_eq!(found.map(|hit| hit.part as usize), first.map(|(part, _)| part));
            if let (Some(found), Some((_, first))) = (found, first) {
                assert!((found.fraction - first.fraction).abs() <= 1e-12 * first.fraction);
                assert!(found.point.distance(first.point) < 1e-10);
            }
        }
    }
}

#[test]
fn a_compound_is_hit_where_its_first_part_is() {
    for_every_dimension!(compounds_give_first_part);
}

fn special_rays<const N: usize>() {
    let cuboid = Shape::<N>::cuboid([0.5; N]).expect("a box");
    let along = Vector::unit(0);
    let cast = |ray: &Ray<N>, shape: &Shape<N>| cast(ray, shape, &Pose::IDENTITY);
    // In the face itself: the solid is closed.
    let mut from = Vector::unit(0) * -2.0;
    from[1] = 0.5;
    assert_eq!(cast(&Ray::new(from, along), &cuboid).expect("it grazes").fraction, 1.5);
    // On the surface: going in hits there, going out starts inside.
    let surface = Vector::unit(0) * -0.5;
    let hit = cast(&Ray::new(surface, along), &cuboid).expect("it goes in");
    assert_eq!((hit.fraction, hit.inside, hit.normal), (0.0, false, -along));
    assert!(cast(&Ray::new(surface, -along), &cuboid).expect("closed").inside);
    // Too short, and just long enough.
    let ray = Ray::new(Vector::unit(0) * -2.0, along);
    assert!(cast(&ray.up_to(1.499), &cuboid).is_none());
    assert_eq!(cast(&ray.up_to(1.5), &cuboid).expect("it ends there").fraction, 1.5);
    // Not rays at all.
    for bad in [
        Ray::new(Vector::splat(f64::NAN), along),
        Ray::new(Vector::ZERO, Vector::ZERO),
        Ray::new(Vector::ZERO, Vector::splat(f64::INFINITY)),
        Ray::new(Vector::ZERO, along).up_to(f64::NAN),
        Ray::new(Vector::ZERO, along).up_to(-1.0),
    ] {
        assert_eq!(cast(&bad, &cuboid), None, "{bad:?}");
    }
    // A small ball from very far away.
    let ball = Shape::ball(0.01).expect("a ball");
    let hit = cast(&Ray::new(Vector::unit(0) * -1e6, along), &ball).expect("straight at it");
    assert!((hit.fraction - (1e6 - 0.01)).abs() < 1e-9 && (hit.point + along * 0.01).norm() < 1e-15);
}

#[test]
fn special_rays_have_exact_answers() {
    for_every_dimension!(special_rays);
}
