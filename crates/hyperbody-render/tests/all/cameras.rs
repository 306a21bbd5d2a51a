//! Where cameras stand, and what they have in view.

use std::f64::consts::FRAC_PI_2;

use crate::common::{SIDE, count, covered_from, differing, far_camera, heap, settings, world_of};
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::{BodyDef, BodyKind, Shape, World};
use hyperbody_render::{
    Bodies, Camera, Settings, Slice, Viewpoint, frame_all, frame_bodies, frame_from, render, strips_share,
};

/// Where a point is in a square picture: from −1 to 1 across and upwards.
fn in_picture(camera: &Camera, point: Vector<3>) -> [f64; 2] {
    let cross = |a: Vector<3>, b: Vector<3>| {
        Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    };
    let forward = (camera.target - camera.eye).try_normalize().unwrap();
    let right = cross(forward, camera.up).try_normalize().unwrap();
    let from_eye = point - camera.eye;
    let scale = (0.5 * camera.field_of_view).tan() * from_eye.dot(forward);
    [right, cross(right, forward)].map(|direction| from_eye.dot(direction) / scale)
}

/// One camera has all moments in view, and the bodies fill the picture from edge to edge one way at least.
fn everything_is_in_view<const N: usize>() {
    let (slice, mut world) = (Slice::<N>::natural(), heap::<N>());
    let mut sights = vec![(Bodies::of(&world), slice)];
    let mut points: Vec<Vector<3>> = Vec::new();
    for _ in 0..2 {
        let moving = world.bodies().filter(|(_, body)| body.kind() == BodyKind::Dynamic);
        points.extend(moving.map(|(_, body)| Slice::seen(slice.coordinates(body.position()))));
        (0..60).for_each(|_| world.step());
        sights.push((Bodies::of(&world), slice));
    }
    let camera = frame_all(&sights, 1.0);
    let places: Vec<[f64; 2]> = points.iter().map(|&point| in_picture(&camera, point)).collect();
    let reach = |axis: usize| places.iter().map(|place| place[axis].abs()).fold(0.0, f64::max);
    assert!(reach(0) < 0.95 && reach(1) < 0.95, "{places:?} in {N}D");
    assert!(reach(0).max(reach(1)) > 0.5, "{places:?} in {N}D");
}

#[test]
fn a_film_has_everything_in_view() {
    everything_is_in_view::<2>();
    everything_is_in_view::<3>();
}

#[test]
fn a_camera_makes_room_at_the_right_edge() {
    let camera = far_camera();
    // A quarter of the width is taken: the middle of the rest is at three eighths, which is −1/4 of the way to the edge.
    let place = in_picture(&camera.with_room(0.25, 1.0), camera.target);
    assert!((place[0] + 0.25).abs() < 1e-9 && place[1].abs() < 1e-9, "{place:?}");
    assert_eq!(strips_share(3, 1280, 720), 0.0, "three dimensions have nothing to hide");
    for dimension in 4..=6 {
        assert!((strips_share(dimension, 1280, 720) - strips_share(dimension, 640, 360)).abs() < 1e-6);
        assert!(strips_share(dimension, 1280, 720) > strips_share(dimension - 1, 1280, 720));
    }
}

/// In a picture higher than wide the strips leave three quarters of the width to the bodies, and where that is too little for
/// them there are none; in wide ones they are as wide as ever. What is drawn differs from the picture without strips there alone.
#[test]
fn strips_of_high_pictures_leave_room_for_the_bodies() {
    fn check<const N: usize>() {
        let bodies = Bodies::of(&heap::<N>());
        let slice = Slice::<N>::natural();
        for (width, height) in [(405, 720), (200, 800), (120, 400), (50, 300), (30, 300)] {
            let share = strips_share(N, width, height);
            assert!((0.0..=0.2501).contains(&share), "{share} of {width} × {height} in {N}D");
            assert_eq!(share > 0.0, width / (N as u32 - 3) >= 60, "{share} of {width} × {height} in {N}D");
            let camera = frame_bodies(&bodies, &slice, f64::from(width) / f64::from(height));
            let draw = |strip: bool| {
                let settings = Settings { width, height, strip, ..settings() };
                render(&bodies, &slice, Some(&camera), &settings, &|_| ()).unwrap()
            };
            let other = differing(&draw(true), &draw(false));
            let columns = other.iter().enumerate().filter(|(_, differs)| **differs).map(|(at, _)| at as u32 % width);
            let first = columns.min().unwrap_or(width);
            let free = (1.0 - share) * f64::from(width);
            assert!(
                f64::from(first) > free - 2.0 && f64::from(first) < free + 0.1 * f64::from(width),
                "{first}, {free}"
            );
        }
        for (width, height) in [(720, 720), (640, 360), (1280, 720), (100, 90)] {
            let usual = (20.0 + 106.0 * (N as f64 - 3.0)) * f64::from(height) / 720.0 / f64::from(width);
            assert!((strips_share(N, width, height) - usual).abs() < 1e-6, "{width} × {height} in {N}D");
        }
    }
    check::<4>();
    check::<5>();
    check::<6>();
}

#[test]
fn a_body_that_flew_away_and_a_single_one_make_good_pictures() {
    let mut world = heap::<4>();
    let slice = Slice::natural();
    let before = frame_bodies(&Bodies::of(&world), &slice, 1.5);
    let lost = BodyDef::new(Shape::ball(0.5).unwrap()).position([1e4, 3.0, 0.0, 0.0]);
    world.add_body(lost).unwrap();
    let after = frame_bodies(&Bodies::of(&world), &slice, 1.5);
    let (near, far) = (before.eye.distance(before.target), after.eye.distance(after.target));
    assert!((near / far - 1.0).abs() < 0.2, "{near} m without it and {far} m with it");
    let alone = world_of(Shape::<4>::ball(0.5).unwrap(), Pose::IDENTITY);
    let camera = frame_bodies(&Bodies::of(&alone), &slice, 1.5);
    let share = 0.5 / camera.eye.distance(camera.target) / (0.5 * camera.field_of_view).tan();
    assert!((0.3..0.8).contains(&share), "the ball takes up {share} of the picture's height");
}

/// From straight above and below the picture is that from nearby, not a turned one.
#[test]
fn a_view_along_the_vertical_is_the_limit_of_steep_ones() {
    let world = world_of(Shape::<3>::cuboid([0.4, 0.4, 1.2]).unwrap(), Pose::from_translation(Vector([0.5, 0.0, 0.2])));
    for azimuth in [0.0, 0.7, -2.0, 3.0] {
        for vertical in [FRAC_PI_2, -FRAC_PI_2] {
            let view = |elevation: f64| {
                let camera = Camera::around(Vector::ZERO, Vector::unit(1), 8.0, azimuth, elevation);
                covered_from(&world, &Slice::natural(), &camera)
            };
            let (steep, along) = (view(vertical * (1.0 - 1e-4)), view(vertical));
            let apart = steep.iter().zip(&along).filter(|(a, b)| a != b).count();
            assert!(count(&along) > 1000, "the box is in view");
            assert!(apart < 40, "{apart} pixels differ from azimuth {azimuth}, elevation {vertical}");
        }
    }
}

/// From anywhere, at any angle of view, everything is in view and fills the picture one way at least.
fn any_viewpoint_has_everything_in_view<const N: usize>() {
    let (slice, world) = (Slice::<N>::natural(), heap::<N>());
    let bodies = Bodies::of(&world);
    let moving = world.bodies().filter(|(_, body)| body.kind() == BodyKind::Dynamic);
    let points: Vec<Vector<3>> =
        moving.map(|(_, body)| Slice::seen(slice.coordinates(body.centre_of_mass()))).collect();
    for (azimuth, elevation) in [(0.0, 0.0), (1.5, 0.2), (-2.5, 0.9), (0.6, FRAC_PI_2), (3.0, -0.4)] {
        for field_of_view in [0.1, 0.6, 1.8] {
            let viewpoint = Viewpoint { azimuth, elevation, field_of_view, target: None };
            let camera = frame_from(&[(bodies.clone(), slice)], 1.0, &viewpoint);
            assert_eq!(camera.field_of_view, field_of_view);
            let places: Vec<[f64; 2]> = points.iter().map(|&point| in_picture(&camera, point)).collect();
            let reach = |axis: usize| places.iter().map(|place| place[axis].abs()).fold(0.0, f64::max);
            assert!(reach(0) < 0.97 && reach(1) < 0.97, "{viewpoint:?} in {N}D: {places:?}");
            assert!(reach(0).max(reach(1)) > 0.25, "{viewpoint:?} in {N}D: {places:?}");
            let target = Vector([0.5, 1.0, -0.3]);
            let camera = frame_from(&[(bodies.clone(), slice)], 1.0, &Viewpoint { target: Some(target), ..viewpoint });
            assert_eq!(camera.target, target);
            let out = points.iter().map(|&point| in_picture(&camera, point)).any(|[x, y]| x.abs().max(y.abs()) > 1.0);
            assert!(!out, "{viewpoint:?} about {target:?} in {N}D");
        }
    }
    let natural = frame_from(&[(bodies.clone(), slice)], 1.5, &Viewpoint::natural(N));
    assert_eq!(natural, frame_bodies(&bodies, &slice, 1.5));
}

#[test]
fn cameras_are_framed_from_any_viewpoint() {
    any_viewpoint_has_everything_in_view::<2>();
    any_viewpoint_has_everything_in_view::<3>();
}

/// A camera that has all in view may still draw nothing: every built-in scene against the same view without its bodies.
#[test]
fn every_built_in_scene_shows_its_bodies() {
    for scene in hyperbody_scene::BUILT_IN {
        let world = hyperbody_scene::AnyWorld::new(&hyperbody_scene::built_in(scene.name).unwrap(), 1).unwrap();
        let share = hyperbody_scene::visit_dimension(world.dimension(), ShareOfBodies(&world)).unwrap();
        assert!(share > 0.01, "{}: bodies cover {share} of the picture", scene.name);
    }
}

struct ShareOfBodies<'a>(&'a hyperbody_scene::AnyWorld);

impl hyperbody_scene::DimensionVisitor for ShareOfBodies<'_> {
    type Output = f64;

    fn visit<const N: usize>(self) -> f64
    where
        hyperbody::math::Dim<N>: hyperbody::math::EvenAlgebra,
    {
        let (world, slice) = (self.0.get::<N>().unwrap(), Slice::natural());
        let mut bare =
            World::<N>::new(hyperbody::prelude::WorldDef { gravity: world.gravity(), ..Default::default() }).unwrap();
        let is_plane = |shape: &Shape<N>| {
            shape.pieces().iter().any(|(_, piece)| matches!(piece, hyperbody::geometry::shape::Piece::HalfSpace { .. }))
        };
        for (_, body) in world.bodies().filter(|(_, body)| is_plane(body.shape())) {
            let pose = body.pose();
            let fixed = BodyDef::fixed(body.shape().clone()).position(pose.translation).rotation(pose.rotation);
            bare.add_body(fixed).unwrap();
        }
        let camera = frame_bodies(&Bodies::of(world), &slice, 1.0);
        // Of some scenes in 5D the natural slice shows ghosts alone.
        let settings = Settings { ghosts: true, ..settings() };
        let draw = |world: &World<N>| render(&Bodies::of(world), &slice, Some(&camera), &settings, &|_| ()).unwrap();
        count(&differing(&draw(world), &draw(&bare))) as f64 / f64::from(SIDE * SIDE)
    }
}
