//! Queries at the limits of what can be asked: bodies in no group, half-spaces, lengths near the ends of what numbers hold,
//! and numbers that mean nothing.

use std::sync::Arc;

use crate::common::{Random, in_all_dimensions};
use crate::queries::{centres, cube, world};
use hyperbody_collision::limits::FARTHEST;
use hyperbody_collision::query::Motion;
use hyperbody_collision::ray::Ray;
use hyperbody_dynamics::{BodyDef, Groups, QueryFilter, QueryScratch, World, WorldDef};
use hyperbody_geometry::{Aabb, Shape, regular};
use hyperbody_math::{Pose, Vector};

const EVERY: QueryFilter<'_> = QueryFilter::ALL;

fn empty<const N: usize>() -> World<N> {
    World::new(WorldDef::default()).unwrap()
}

fn all_means_all<const N: usize>() {
    let mut world = empty::<N>();
    let ghost = world.add_body(BodyDef::fixed(cube(0.5)).groups(Groups::NONE)).unwrap();
    let mut def = BodyDef::fixed(cube(0.5)).position(Vector::unit(0) * 3.0);
    def.sensor = true;
    let sensor = world.add_body(def).unwrap();
    let ray = Ray::new(Vector::unit(0) * -3.0, Vector::unit(0));
    assert_eq!(world.ray_cast(&ray).map(|hit| hit.body), Some(ghost), "the short form, too");
    let queries = world.queries();
    let (mut scratch, mut hits, mut near) = (QueryScratch::default(), Vec::new(), Vec::new());
    let mut seen = |filter: QueryFilter<'_>| {
        queries.ray_cast_all(&ray, &mut scratch, &filter, &mut hits);
        hits.iter().map(|hit| hit.body).collect::<Vec<_>>()
    };
    assert_eq!(seen(EVERY), [ghost, sensor]);
    assert_eq!(seen(QueryFilter::new().groups(Groups::ALL)), [sensor]);
    assert_eq!(seen(EVERY.without_sensors()), [ghost]);
    let ball = Shape::ball(0.1).unwrap();
    queries.bodies_near(&ball, &Pose::IDENTITY, 10.0, &mut QueryScratch::default(), &EVERY, &mut near);
    assert_eq!(near.iter().map(|found| found.body).collect::<Vec<_>>(), [ghost, sensor]);
}

/// Half-spaces against half-spaces: those that face away from each other exactly have a distance, all others overlap for ever.
fn half_spaces<const N: usize>() {
    let mut world = empty::<N>();
    let up = Vector::<N>::unit(1);
    let slope = (up + Vector::unit(0)) * std::f64::consts::FRAC_1_SQRT_2;
    let mut add = |normal: Vector<N>, offset: f64| {
        world.add_body(BodyDef::fixed(Shape::half_space(normal, offset).unwrap())).unwrap()
    };
    let (floor, ceiling, ramp) = (add(up, 0.0), add(-up, -3.0), add(slope, 1.0));
    let queries = world.queries();
    let (mut scratch, mut near, mut touching) = (QueryScratch::default(), Vec::new(), Vec::new());
    let probe = Shape::half_space(up, 0.0).unwrap();
    let at = |height: f64| Pose::from_translation(up * height);
    let mut near_at = |height: f64, within: f64| {
        queries.bodies_near(&probe, &at(height), within, &mut scratch, &EVERY, &mut near);
        queries.bodies_touching(&probe, &at(height), &mut scratch, &EVERY, &mut touching);
        let overlapping: Vec<_> = near.iter().filter(|found| found.separation.distance <= 0.0).collect();
        let mut bodies: Vec<_> = overlapping.iter().map(|found| found.body).collect();
        bodies.sort_unstable();
        assert_eq!(bodies, touching, "what overlaps is near");
        let nearest = queries.nearest_to_shape(&probe, &at(height), within, &mut scratch, &EVERY);
        assert_eq!(nearest, near.first().copied());
        near.iter().map(|found| (found.body, found.separation.distance)).collect::<Vec<_>>()
    };
    let never_free = f64::NEG_INFINITY;
    assert_eq!(near_at(2.0, 0.5), [(floor, never_free), (ramp, never_free)]);
    assert_eq!(near_at(2.0, 1.0), [(floor, never_free), (ramp, never_free), (ceiling, 1.0)]);
    assert_eq!(near_at(3.5, 0.0), [(floor, never_free), (ramp, never_free), (ceiling, -0.5)]);
    // The way out of an overlap that has one: along the normal.
    let only = |body| body == ceiling;
    let filter = QueryFilter::new().satisfying(&only);
    let found = queries.nearest_to_shape(&probe, &at(3.5), 0.0, &mut scratch, &filter).unwrap().separation;
    assert_eq!((found.normal, found.on_a, found.on_b), (up, up * 3.5, up * 3.0));
    // A half-space is no shape to cast.
    let motion = Motion::linear(at(-9.0), up);
    assert_eq!(queries.shape_cast(&probe, &motion, 100.0, 0.0, &mut scratch, &EVERY), None);
}

/// A direction a million million times longer gives the same hit at a fraction that much smaller.
fn any_length<const N: usize>() {
    let mut random = Random(300 + N as u64);
    let world = world::<N>(&mut random, 1);
    let queries = world.queries();
    let (mut scratch, mut all, mut all_scaled) = (QueryScratch::default(), Vec::new(), Vec::new());
    let targets = centres(&world);
    let mut met = 0;
    for target in targets.iter().skip(1) {
        let origin = random.vector::<N>(6.0) + Vector::unit(1) * 3.0;
        let direction = *target + random.vector(0.3) - origin;
        let ray = Ray::new(origin, direction).up_to(2.0);
        let expected = queries.ray_cast(&ray, &mut scratch, &EVERY);
        queries.ray_cast_all(&ray, &mut scratch, &EVERY, &mut all);
        met += usize::from(expected.is_some());
        // Powers of two, so that nothing is rounded: about 1e-199, 1e-170, 1e-90, 1e90 and 1e199.
        for exponent in [-661, -565, -299, 299, 659] {
            let length = 2.0_f64.powi(exponent);
            let scaled = Ray::new(origin, direction * length).up_to(2.0 / length);
            let mut found = queries.ray_cast(&scaled, &mut scratch, &EVERY);
            if let Some(found) = &mut found {
                found.hit.fraction *= length;
            }
            match (&found, &expected) {
                (Some(found), Some(expected)) => {
                    assert_eq!((found.body, found.hit.facet), (expected.body, expected.hit.facet));
                    assert!((found.hit.fraction - expected.hit.fraction).abs() < 1e-13, "{found:?} {expected:?}");
                    assert!(found.hit.point.distance(expected.hit.point) < 1e-12, "{found:?} {expected:?}");
                }
                _ => assert_eq!(found, expected),
            }
            queries.ray_cast_all(&scaled, &mut scratch, &EVERY, &mut all_scaled);
            assert_eq!(all_scaled.len(), all.len());
            assert_eq!(queries.ray_meets_any(&scaled, &mut scratch, &EVERY), expected.is_some());
        }
    }
    assert!(met > 20, "{met} rays met something in {N}D");
}

/// From as far away as can be asked, distances are right to rounding; from farther away nothing is found.
fn as_far_as_can_be<const N: usize>() {
    let mut world = empty::<N>();
    world.add_body(BodyDef::fixed(cube(0.5))).unwrap();
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), -1.0).unwrap())).unwrap();
    let queries = world.queries();
    let mut scratch = QueryScratch::default();
    let simplex = regular::polytope("simplex", regular::Size::Circumradius(1.0)).unwrap();
    let simplex = Shape::polytope(Arc::new(simplex)).unwrap();
    let probes = [Shape::ball(0.5).unwrap(), cube(0.5), simplex, Shape::rounded(cube(0.4), 0.1).unwrap()];
    for far in [1e15, 1e22, FARTHEST] {
        let sideways = Vector::unit(0) * far;
        for probe in &probes {
            let pose = Pose::from_translation(sideways + Vector::unit(1) * far);
            let filter = QueryFilter::new().only_fixed();
            let nearest = queries.nearest_to_shape(probe, &pose, f64::INFINITY, &mut scratch, &filter).unwrap();
            assert!((nearest.separation.distance / far - 1.0).abs() < 1e-14, "{far}: {nearest:?}");
        }
        let point = queries.nearest_to_point(sideways, f64::INFINITY, &mut scratch, &EVERY).unwrap();
        assert_eq!(point.projection.distance, 1.0, "the floor is everywhere");
        let ray = Ray::new(sideways, -Vector::unit(0));
        let hit = queries.ray_cast(&ray, &mut scratch, &EVERY).unwrap();
        assert!((hit.hit.fraction / far - 1.0).abs() < 1e-14);
        let mut found = Vec::new();
        let around = Aabb { lower: Vector::splat(-far), upper: Vector::splat(far) };
        queries.bodies_in(&around, &mut scratch, &EVERY, &mut found);
        assert_eq!(found.len(), 2, "the box is {far} wide");
    }
    let beyond = Vector::unit(0) * (2.0 * FARTHEST);
    for pose in [beyond, Vector::unit(0) * 1e200, Vector::splat(f64::NAN)].map(Pose::from_translation) {
        let point = pose.translation;
        let infinite = f64::INFINITY;
        assert_eq!(queries.nearest_to_shape(&probes[0], &pose, infinite, &mut scratch, &EVERY), None);
        assert_eq!(queries.nearest_to_point(point, infinite, &mut scratch, &EVERY), None);
        assert_eq!(queries.ray_cast(&Ray::new(point, -Vector::unit(0)), &mut scratch, &EVERY), None);
        let motion = Motion::linear(pose, -point);
        assert_eq!(queries.shape_cast(&probes[0], &motion, 2.0, 0.0, &mut scratch, &EVERY), None);
        let mut found = Vec::new();
        queries.bodies_touching(&probes[0], &pose, &mut scratch, &EVERY, &mut found);
        assert_eq!(found, []);
        queries.bodies_at(point, &mut scratch, &EVERY, &mut found);
        assert_eq!(found, []);
    }
}

fn numbers_that_mean_nothing<const N: usize>() {
    let mut world = empty::<N>();
    world.add_body(BodyDef::fixed(cube(0.5))).unwrap();
    let queries = world.queries();
    let mut scratch = QueryScratch::default();
    let from = Vector::<N>::unit(0) * -3.0;
    let ray = Ray::new(from, Vector::unit(0));
    assert!(queries.ray_cast(&ray, &mut scratch, &EVERY).is_some());
    for bad in [
        ray.up_to(-1.0),
        ray.up_to(f64::NAN),
        Ray::new(from, Vector::ZERO),
        Ray::new(from, Vector::unit(0) * 1e-201),
        Ray::new(from, Vector::unit(0) * f64::INFINITY),
        Ray::new(from, Vector::unit(0) * f64::NAN),
    ] {
        assert!(!bad.is_valid());
        assert_eq!(queries.ray_cast(&bad, &mut scratch, &EVERY), None);
        assert!(!queries.ray_meets_any(&bad, &mut scratch, &EVERY));
    }
    let (ball, pose) = (Shape::ball(0.5).unwrap(), Pose::from_translation(from));
    for bad in [-1.0, f64::NAN] {
        assert_eq!(queries.nearest_to_shape(&ball, &pose, bad, &mut scratch, &EVERY), None);
        assert_eq!(queries.nearest_to_point(from, bad, &mut scratch, &EVERY), None);
    }
    let motion = Motion::linear(pose, Vector::unit(0));
    assert!(queries.shape_cast(&ball, &motion, 10.0, 0.5, &mut scratch, &EVERY).is_some());
    for (max_time, margin) in [(10.0, f64::INFINITY), (10.0, f64::NAN), (10.0, -0.1), (-1.0, 0.0), (f64::NAN, 0.0)] {
        assert_eq!(queries.shape_cast(&ball, &motion, max_time, margin, &mut scratch, &EVERY), None);
    }
    // The widest margin that can be asked for is an ordinary number: they are within it from the start.
    let hit = queries.shape_cast(&ball, &motion, 10.0, FARTHEST, &mut scratch, &EVERY).unwrap().hit;
    assert!(hit.inside && hit.time == 0.0 && hit.gap.is_finite(), "{hit:?}");
}

/// Starts in and on a body.
fn starts<const N: usize>() {
    let mut world = empty::<N>();
    world.add_body(BodyDef::fixed(cube(0.5))).unwrap();
    let queries = world.queries();
    let mut scratch = QueryScratch::default();
    let x = Vector::<N>::unit(0);
    let mut cast = |origin: Vector<N>, direction: Vector<N>| {
        let hit = queries.ray_cast(&Ray::new(origin, direction), &mut scratch, &EVERY)?.hit;
        Some((hit.fraction, hit.inside, hit.normal))
    };
    let held = Some((0.0, true, Vector::ZERO));
    assert_eq!(cast(x * 0.2, x), held);
    assert_eq!(cast(x * 0.5, x), held, "it leaves through the surface on which it starts");
    assert_eq!(cast(x * 0.5, Vector::unit(1)), held, "it runs along the surface");
    assert_eq!(cast(x * 0.5, -x), Some((0.0, false, x)), "it goes in");
    assert_eq!(cast(x * 0.75, x), None);
    // A shape that overlaps at the start, and one that touches and goes away.
    let ball = Shape::ball(0.5).unwrap();
    let mut met = |at: f64, speed: f64| {
        let motion = Motion::linear(Pose::from_translation(x * at), x * speed);
        queries.shape_cast(&ball, &motion, 10.0, 0.0, &mut scratch, &EVERY).map(|met| met.hit)
    };
    let hit = met(0.75, 1.0).unwrap();
    assert!(hit.inside && hit.time == 0.0 && (hit.gap + 0.25).abs() < 1e-9, "{hit:?}");
    assert_eq!(met(1.0, 1.0), None);
    assert!(met(1.0, -1.0).is_some_and(|hit| hit.time == 0.0 && !hit.inside));
}

in_all_dimensions! {
    the_widest_filter_sees_bodies_in_no_group_and_sensors: all_means_all;
    half_spaces_find_the_half_spaces_that_they_overlap: half_spaces;
    directions_may_have_any_length: any_length;
    distances_are_right_as_far_as_can_be_asked: as_far_as_can_be;
    what_means_nothing_meets_nothing: numbers_that_mean_nothing;
    starts_in_and_on_bodies_are_as_documented: starts;
}
