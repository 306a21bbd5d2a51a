//! Shapes against a world, at rest and in motion, by the tree and by trying every body.

use crate::common::Random;
use crate::queries::{centres, cube, world};
use hyperbody_collision::query::{self, Motion};
use hyperbody_collision::ray::{Ray, cast};
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, Groups, QueryFilter, QueryScratch, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Vector};

/// Shapes of every kind that queries are asked with.
fn probe<const N: usize>(random: &mut Random, index: usize) -> (Shape<N>, Pose<N>) {
    let shape = match index % 4 {
        0 => Shape::ball(random.between(0.05, 0.8)).unwrap(),
        1 => Shape::capsule(0.6, 0.2, index % N).unwrap(),
        2 => Shape::compound(vec![
            (Pose::from_translation(Vector::unit(0) * 0.5), cube(0.2)),
            (Pose::from_translation(Vector::unit(1) * -0.5), Shape::ball(0.2).unwrap()),
        ])
        .unwrap(),
        _ => cube(random.between(0.1, 0.6)),
    };
    let position = random.vector::<N>(3.0) + Vector::unit(1) * 3.0;
    (shape, Pose::new(random.rotation(3.0), position))
}

fn shapes_agree<const N: usize>() {
    let mut random = Random(60 + N as u64);
    let world = world::<N>(&mut random, 1);
    let queries = world.queries();
    let (mut scratch, mut found, mut near) = (QueryScratch::default(), Vec::new(), Vec::new());
    let (mut touching, mut apart) = (0, 0);
    let targets = centres(&world);
    for index in 0..150 {
        let (shape, mut pose) = probe(&mut random, index);
        pose.translation = targets[1 + index % (targets.len() - 1)] + random.vector(0.8);
        let filter = if index % 5 == 0 { QueryFilter::new().only_dynamic() } else { QueryFilter::ALL };
        let seen = |kind: BodyKind| index % 5 != 0 || kind == BodyKind::Dynamic;
        let bodies = || world.bodies().filter(|(_, body)| seen(body.kind()));
        queries.bodies_touching(&shape, &pose, &mut scratch, &filter, &mut found);
        let expected: Vec<BodyHandle> = bodies()
            .filter(|(_, body)| query::overlap(&shape, &pose, body.shape(), &body.pose()))
            .map(|(handle, _)| handle)
            .collect();
        assert_eq!(found, expected);
        touching += found.len();

        // Sorted by distance, and then by body.
        let mut all: Vec<(f64, BodyHandle)> = bodies()
            .map(|(handle, body)| {
                let separation = query::separation(&shape, &pose, body.shape(), &body.pose()).unwrap();
                (separation.distance, handle)
            })
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let nearest = queries.nearest_to_shape(&shape, &pose, f64::INFINITY, &mut scratch, &filter).unwrap();
        assert!((nearest.separation.distance - all[0].0).abs() < 1e-9, "{nearest:?}, {:?}", all[0]);
        queries.bodies_near(&shape, &pose, 0.5, &mut scratch, &filter, &mut near);
        let within: Vec<f64> = all.iter().map(|found| found.0).take_while(|&distance| distance <= 0.5).collect();
        assert_eq!(near.len(), within.len());
        assert!(near.iter().zip(&within).all(|(found, distance)| (found.separation.distance - distance).abs() < 1e-9));
        apart += within.iter().filter(|&&distance| distance > 0.0).count();
        let too_far = queries.nearest_to_shape(&shape, &pose, 0.5, &mut scratch, &filter);
        assert_eq!(too_far.is_some(), !within.is_empty());
        // A point: the ball of no size.
        let point = pose.translation;
        let projected = queries.nearest_to_point(point, f64::INFINITY, &mut scratch, &filter).unwrap();
        let least = bodies()
            .map(|(_, body)| query::project(point, body.shape(), &body.pose()).unwrap().distance)
            .fold(f64::INFINITY, f64::min);
        assert!((projected.projection.distance - least).abs() < 1e-9, "{projected:?}, {least}");
    }
    assert!(touching > 20 && apart > 20, "{touching} touching and {apart} near in {N}D");
}

#[test]
fn shapes_at_rest_meet_what_trying_every_body_finds() {
    shapes_agree::<2>();
    shapes_agree::<3>();
    shapes_agree::<4>();
    shapes_agree::<5>();
    shapes_agree::<6>();
}

fn casts_agree<const N: usize>() {
    let mut random = Random(70 + N as u64);
    let world = world::<N>(&mut random, 2);
    let queries = world.queries();
    let mut scratch = QueryScratch::default();
    let targets = centres(&world);
    let (mut hits, mut misses) = (0, 0);
    let shape = cube::<N>(0.3);
    let mut motions = Vec::new();
    for index in 0..120 {
        let (mut other, mut pose) = probe::<N>(&mut random, index);
        if index % 3 == 0 {
            other = shape.clone();
        }
        pose.translation += random.vector(4.0) + Vector::unit(1) * 4.0;
        let target = targets[1 + random.bits() as usize % (targets.len() - 1)];
        let mut motion = Motion::linear(pose, (target - pose.translation) * random.between(0.6, 1.3));
        if index % 2 == 0 {
            let spin = Bivector::from_fn(|_, _| random.between(-3.0, 3.0));
            motion = motion.turning(spin, random.vector::<N>(0.2));
        }
        let found = queries.shape_cast(&other, &motion, 1.0, 0.0, &mut scratch, &QueryFilter::ALL);
        let expected = world
            .bodies()
            .filter_map(|(_, body)| query::shape_cast(&other, &motion, body.shape(), &body.pose(), 1.0, 0.0))
            .map(|hit| hit.time)
            .reduce(f64::min);
        assert_eq!(found.is_some(), expected.is_some(), "{found:?} {expected:?}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((found.hit.time - expected).abs() < 1e-7, "{found:?} {expected}");
            // The hit is on the body that it names.
            let body = world.body(found.body).unwrap();
            let again = query::shape_cast(&other, &motion, body.shape(), &body.pose(), 1.0, 0.0).unwrap();
            assert!((again.time - found.hit.time).abs() < 1e-7, "{found:?} {again:?}");
            hits += 1;
        } else {
            misses += 1;
        }
        if index % 3 == 0 {
            motions.push(motion);
        }
    }
    assert!(hits > 20 && misses > 0, "{hits} hits and {misses} misses in {N}D");
    let mut batch = Vec::new();
    queries.shape_casts(&shape, &motions.repeat(4), 1.0, 0.0, &QueryFilter::ALL, &mut batch);
    for (motion, in_batch) in motions.repeat(4).iter().zip(&batch) {
        let single = queries.shape_cast(&shape, motion, 1.0, 0.0, &mut scratch, &QueryFilter::ALL);
        assert_eq!(single, *in_batch, "a batch answers as single casts do");
    }
}

#[test]
fn shapes_in_motion_meet_what_trying_every_body_finds() {
    casts_agree::<2>();
    casts_agree::<3>();
    casts_agree::<4>();
    casts_agree::<5>();
    casts_agree::<6>();
}

#[test]
fn batches_answer_as_single_questions_on_any_number_of_threads() {
    let mut answers = Vec::new();
    for threads in [1, 2, 3] {
        let world = world::<4>(&mut Random(5), threads);
        let mut random = Random(6);
        let queries = world.queries();
        let points: Vec<Vector<4>> = (0..300).map(|_| random.vector::<4>(3.0) + Vector::unit(1) * 2.0).collect();
        let poses: Vec<Pose<4>> = points.iter().map(|&point| Pose::new(random.rotation(3.0), point)).collect();
        let (mut nearest, mut holding, mut touching) = (Vec::new(), Vec::new(), Vec::new());
        queries.nearest_to_points(&points, 1.0, &QueryFilter::ALL, &mut nearest);
        queries.bodies_at_each(&points, &QueryFilter::ALL, &mut holding);
        queries.bodies_touching_each(&cube(0.4), &poses, &QueryFilter::ALL, &mut touching);
        let (mut scratch, mut single) = (QueryScratch::default(), Vec::new());
        for (index, point) in points.iter().enumerate() {
            assert_eq!(nearest[index], queries.nearest_to_point(*point, 1.0, &mut scratch, &QueryFilter::ALL));
            queries.bodies_at(*point, &mut scratch, &QueryFilter::ALL, &mut single);
            assert_eq!(holding[index], single);
            queries.bodies_touching(&cube(0.4), &poses[index], &mut scratch, &QueryFilter::ALL, &mut single);
            assert_eq!(touching[index], single);
        }
        answers.push((nearest, holding, touching));
    }
    assert!(answers.iter().all(|answer| *answer == answers[0]));
}

#[test]
fn filters_leave_out_what_they_say() {
    let mut world = World::<3>::new(WorldDef::default()).unwrap();
    let kinds = [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic];
    let bodies = kinds.map(|kind| {
        let mut def = BodyDef::new(cube(0.5)).position([2.0 * f64::from(kind as u8), 0.0, 0.0]);
        def.kind = kind;
        def.sensor = kind == BodyKind::Kinematic;
        def.groups = Groups::new(if kind == BodyKind::Static { 1 } else { 2 }, u32::MAX);
        world.add_body(def).unwrap()
    });
    let [fixed, led, loose] = bodies;
    let queries = world.queries();
    let everything = Shape::ball(20.0).unwrap();
    let seen = |filter: QueryFilter<'_>| {
        let mut found = Vec::new();
        queries.bodies_touching(&everything, &Pose::IDENTITY, &mut QueryScratch::default(), &filter, &mut found);
        found
    };
    assert_eq!(seen(QueryFilter::ALL), bodies);
    assert_eq!(seen(QueryFilter::new().only_dynamic()), [loose]);
    assert_eq!(seen(QueryFilter::new().only_fixed()), [fixed]);
    assert_eq!(seen(QueryFilter::new().without_dynamic()), [fixed, led]);
    assert_eq!(seen(QueryFilter::new().without_fixed().excluding(led)), [loose]);
    assert_eq!(seen(QueryFilter::new().without_sensors()), [fixed, loose]);
    assert_eq!(seen(QueryFilter::new().groups(Groups::new(4, 1))), [fixed]);
    assert_eq!(seen(QueryFilter::new().groups(Groups::NONE)), []);
    assert_eq!(seen(QueryFilter::new().satisfying(&|body| body != fixed)), [led, loose]);
}

/// Ten thousand bodies: what rays and boxes meet there, by the tree and by trying every one.
fn ten_thousand_bodies<const N: usize>() {
    let mut random = Random(100 + N as u64);
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    let reach = 60.0 / N as f64;
    for index in 0..10_000 {
        let shape = if index % 2 == 0 { cube(0.4) } else { Shape::ball(0.5).unwrap() };
        let def = BodyDef::fixed(shape).position(random.vector::<N>(reach)).rotation(random.rotation(2.0));
        world.add_body(def).unwrap();
    }
    let (queries, centres) = (world.queries(), centres(&world));
    let (mut scratch, mut found) = (QueryScratch::default(), Vec::new());
    let (mut hits, mut touching) = (0, 0);
    for _ in 0..40 {
        let target = centres[random.bits() as usize % centres.len()] + random.vector(0.4);
        let ray = Ray::between(random.vector::<N>(1.2 * reach), target).up_to(1.5);
        let first = queries.ray_cast(&ray, &mut scratch, &QueryFilter::ALL);
        let expected = world
            .bodies()
            .filter_map(|(body, found)| Some((cast(&ray, found.shape(), &found.pose())?.fraction, body)))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        assert_eq!(first.map(|hit| (hit.hit.fraction, hit.body)), expected);
        hits += usize::from(first.is_some());
        let pose = Pose::new(random.rotation(3.0), random.vector::<N>(reach));
        let shape = cube::<N>(random.between(0.5, 3.0));
        queries.bodies_touching(&shape, &pose, &mut scratch, &QueryFilter::ALL, &mut found);
        let expected: Vec<BodyHandle> = world
            .bodies()
            .filter(|(_, body)| query::overlap(&shape, &pose, body.shape(), &body.pose()))
            .map(|(body, _)| body)
            .collect();
        assert_eq!(found, expected);
        touching += found.len();
    }
    assert!(hits > 5 && touching > 20, "{hits} rays hit, {touching} bodies touched in {N}D");
}

#[test]
fn rays_and_overlaps_among_ten_thousand_bodies_are_those_of_brute_force() {
    ten_thousand_bodies::<2>();
    ten_thousand_bodies::<3>();
    ten_thousand_bodies::<4>();
    ten_thousand_bodies::<5>();
    ten_thousand_bodies::<6>();
}
