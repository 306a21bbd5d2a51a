//! Rays, points and boxes against a world, by the tree and by trying every body.

use crate::common::{Random, material};
use hyperbody_collision::point;
use hyperbody_collision::ray::{Ray, cast};
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyHit, QueryFilter, QueryScratch, World, WorldDef};
use hyperbody_geometry::{Aabb, Shape};
use hyperbody_math::{Pose, Vector};

pub(crate) fn cube<const N: usize>(half_extent: f64) -> Shape<N> {
    Shape::cuboid([half_extent; N]).unwrap()
}

/// Bodies of every kind in a heap, in motion, some of them just moved by hand or removed.
pub(crate) fn world<const N: usize>(random: &mut Random, threads: usize) -> World<N> {
    let mut world = World::new(WorldDef { threads, ..WorldDef::default() }).unwrap();
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
    let mut handles = Vec::new();
    for index in 0..60 {
        let shape = match index % 5 {
            0 => Shape::ball(0.5).unwrap(),
            1 => Shape::capsule(0.4, 0.3, index % N).unwrap(),
            2 => Shape::rounded(cube(0.3), 0.2).unwrap(),
            3 => Shape::compound(vec![
                (Pose::from_translation(Vector::unit(0) * 0.4), cube(0.3)),
                (Pose::from_translation(Vector::unit(1) * 0.4), Shape::ball(0.3).unwrap()),
            ])
            .unwrap(),
            _ => cube(0.5),
        };
        let position = random.vector::<N>(2.5) + Vector::unit(1) * 4.0;
        let def = BodyDef::new(shape).position(position).rotation(random.rotation(3.0)).velocity(random.vector(8.0));
        handles.push(world.add_body(def.material(material(0.5, 0.5))).unwrap());
    }
    for _ in 0..20 {
        world.step();
    }
    world.remove_body(handles[7]).unwrap();
    // Far out of their boxes, and not yet seen by a step.
    for &handle in &handles[10..15] {
        let pose = Pose::new(random.rotation(3.0), random.vector::<N>(3.0) + Vector::unit(1) * 3.0);
        world.body_mut(handle).unwrap().set_pose(pose).unwrap();
    }
    world
}

/// A ray at one of the targets, roughly.
fn ray<const N: usize>(random: &mut Random, targets: &[Vector<N>]) -> Ray<N> {
    let from = random.vector::<N>(5.0) + Vector::unit(1) * 3.0;
    let to = targets[random.bits() as usize % targets.len()] + random.vector(0.5);
    Ray::between(from, to).up_to(random.between(0.5, 3.0))
}

pub(crate) fn centres<const N: usize>(world: &World<N>) -> Vec<Vector<N>> {
    world.bodies().map(|(_, body)| body.centre_of_mass()).collect()
}

/// Every hit by trying all bodies, sorted as the queries sort.
fn all_hits<const N: usize>(world: &World<N>, ray: &Ray<N>) -> Vec<BodyHit<N>> {
    let hits = world
        .bodies()
        .filter_map(|(body, found)| Some(BodyHit { body, hit: cast(ray, found.shape(), &found.pose())? }));
    let mut hits: Vec<_> = hits.collect();
    hits.sort_by(|a, b| a.hit.fraction.total_cmp(&b.hit.fraction).then(a.body.cmp(&b.body)));
    hits
}

fn rays_agree<const N: usize>() {
    let mut random = Random(40 + N as u64);
    let world = world::<N>(&mut random, 2);
    let queries = world.queries();
    let (mut scratch, mut found) = (QueryScratch::default(), Vec::new());
    let rays: Vec<Ray<N>> = (0..2000).map(|_| ray(&mut random, &centres(&world))).collect();
    let mut batch = Vec::new();
    queries.ray_casts(&rays, &QueryFilter::ALL, &mut batch);
    let mut several = 0;
    for (ray, in_batch) in rays.iter().zip(&batch) {
        let expected = all_hits(&world, ray);
        let first = queries.ray_cast(ray, &mut scratch, &QueryFilter::ALL);
        assert_eq!(first, *in_batch, "a batch answers as single rays do");
        assert_eq!(
            first.map(|hit| (hit.body, hit.hit.fraction)),
            expected.first().map(|hit| (hit.body, hit.hit.fraction))
        );
        if let (Some(first), Some(expected)) = (first, expected.first()) {
            assert_eq!(
                (first.hit.part, first.hit.inside, first.hit.facet),
                (expected.hit.part, expected.hit.inside, expected.hit.facet)
            );
            assert!(first.hit.point.distance(expected.hit.point) < 1e-12 && first.hit.normal == expected.hit.normal);
        }
        assert_eq!(queries.ray_meets_any(ray, &mut scratch, &QueryFilter::ALL), !expected.is_empty());
        // All hits list the parts of a compound one by one; each body's first one must be the same.
        queries.ray_cast_all(ray, &mut scratch, &QueryFilter::ALL, &mut found);
        assert!(found.is_sorted_by(|a, b| a.hit.fraction <= b.hit.fraction));
        let mut bodies: Vec<(BodyHandle, f64)> = Vec::new();
        for hit in &found {
            if bodies.iter().all(|(body, _)| *body != hit.body) {
                bodies.push((hit.body, hit.hit.fraction));
            }
        }
        bodies.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        assert_eq!(bodies, expected.iter().map(|hit| (hit.body, hit.hit.fraction)).collect::<Vec<_>>());
        several += usize::from(expected.len() > 1);
        // What the filter keeps out does not stop the ray.
        if let Some(blocked) = first {
            let beyond = queries.ray_cast(ray, &mut scratch, &QueryFilter::new().excluding(blocked.body));
            let next = expected.iter().find(|hit| hit.body != blocked.body);
            assert_eq!(beyond.map(|hit| hit.body), next.map(|hit| hit.body));
        }
    }
    assert!(several > 200, "only {several} rays in {N}D meet more than one body");
    assert_eq!(world.ray_cast(&rays[0]), batch[0]);
}

#[test]
fn rays_meet_what_trying_every_body_finds() {
    rays_agree::<2>();
    rays_agree::<3>();
    rays_agree::<4>();
    rays_agree::<5>();
    rays_agree::<6>();
}

fn points_and_boxes_agree<const N: usize>() {
    let mut random = Random(90 + N as u64);
    let world = world::<N>(&mut random, 1);
    let queries = world.queries();
    let (mut scratch, mut found) = (QueryScratch::default(), Vec::new());
    let expected = |is_in: &dyn Fn(&Shape<N>, &Pose<N>) -> bool| -> Vec<BodyHandle> {
        world.bodies().filter(|(_, body)| is_in(body.shape(), &body.pose())).map(|(handle, _)| handle).collect()
    };
    let centres = centres(&world);
    let (mut in_bodies, mut box_hits) = (0, 0);
    for round in 0..1000 {
        let target = centres[1 + round % (centres.len() - 1)] + random.vector(0.4);
        queries.bodies_at(target, &mut scratch, &QueryFilter::ALL, &mut found);
        let holds = |shape: &Shape<N>, pose: &Pose<N>| {
            shape
                .pieces()
                .iter()
                .any(|(inner, piece)| point::contains(piece, (*pose * *inner).inverse_transform_point(target)))
        };
        assert_eq!(found, expected(&holds));
        in_bodies += found.len();

        let aabb = Aabb::from_centre(target, random.vector::<N>(0.8).abs());
        queries.bodies_in(&aabb, &mut scratch, &QueryFilter::ALL, &mut found);
        let meets = |shape: &Shape<N>, pose: &Pose<N>| {
            shape.pieces().iter().any(|(inner, piece)| point::overlaps_aabb(piece, &(*pose * *inner), &aabb))
        };
        assert_eq!(found, expected(&meets));
        box_hits += found.len();
        // A ray from the point is inside of the same bodies that hold it.
        let mut hits = Vec::new();
        queries.ray_cast_all(&Ray::new(target, Vector::unit(0)).up_to(0.0), &mut scratch, &QueryFilter::ALL, &mut hits);
        let mut holding: Vec<BodyHandle> = hits.iter().filter(|hit| hit.hit.inside).map(|hit| hit.body).collect();
        holding.sort_unstable();
        holding.dedup();
        queries.bodies_at(target, &mut scratch, &QueryFilter::ALL, &mut found);
        assert_eq!(found, holding);
    }
    assert!(in_bodies > 300 && box_hits > 1000, "{in_bodies} points and {box_hits} boxes in {N}D");
}

#[test]
fn points_and_boxes_meet_what_trying_every_body_finds() {
    points_and_boxes_agree::<2>();
    points_and_boxes_agree::<3>();
    points_and_boxes_agree::<4>();
    points_and_boxes_agree::<5>();
    points_and_boxes_agree::<6>();
}

/// Points sampled in a box settle whether it meets a body, as far as samples can.
fn boxes_meet_what_their_points_meet<const N: usize>() {
    let mut random = Random(7 + N as u64);
    let world = world::<N>(&mut random, 1);
    let queries = world.queries();
    let (mut scratch, mut found, mut holding) = (QueryScratch::default(), Vec::new(), Vec::new());
    for _ in 0..200 {
        let aabb = Aabb::from_centre(random.vector::<N>(2.0) + Vector::unit(1) * 2.0, random.vector::<N>(0.5).abs());
        queries.bodies_in(&aabb, &mut scratch, &QueryFilter::ALL, &mut found);
        for _ in 0..50 {
            let point = Vector::from_fn(|i| random.between(aabb.lower[i], aabb.upper[i]));
            queries.bodies_at(point, &mut scratch, &QueryFilter::ALL, &mut holding);
            assert!(
                holding.iter().all(|body| found.contains(body)),
                "{point:?} lies in {holding:?}, the box in {found:?}"
            );
        }
    }
}

#[test]
fn a_box_meets_every_body_that_holds_one_of_its_points() {
    boxes_meet_what_their_points_meet::<2>();
    boxes_meet_what_their_points_meet::<4>();
    boxes_meet_what_their_points_meet::<6>();
}

#[test]
fn asking_changes_nothing() {
    let mut random = Random(1);
    let mut asked = world::<4>(&mut random, 1);
    let mut left = world::<4>(&mut Random(1), 1);
    for _ in 0..60 {
        let _ = asked.ray_cast(&ray(&mut random, &centres(&asked)));
        asked.step();
        left.step();
        assert_eq!(asked.state_hash(), left.state_hash());
    }
    assert_eq!(asked.ray_cast(&Ray::new(Vector::splat(f64::NAN), Vector::unit(0))), None);
}
