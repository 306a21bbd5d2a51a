//! Pictures of one body against the same picture without it.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::{BodyDef, Shape, World, WorldDef};
use hyperbody_render::{Bodies, Camera, Image, Settings, Slice, render};

/// Pixels across and down.
pub const SIDE: u32 = 200;

pub fn settings() -> Settings {
    Settings {
        width: SIDE,
        height: SIDE,
        light_rays: 1,
        edge_samples: 1,
        ghosts: false,
        strip: false,
        threads: 1,
        ..Settings::default()
    }
}

/// A world without gravity that holds one body.
pub fn world_of<const N: usize>(shape: Shape<N>, pose: Pose<N>) -> World<N> {
    let mut world = World::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    world.add_body(BodyDef::new(shape).position(pose.translation).rotation(pose.rotation)).unwrap();
    world
}

/// From so far away that a picture is 4 m wide and nearly without perspective.
pub fn far_camera() -> Camera {
    let distance = 1e4;
    Camera {
        eye: Vector([0.0, 0.0, distance]),
        target: Vector::ZERO,
        up: Vector::unit(1),
        field_of_view: 2.0 * hyperbody::math::scalar::atan2(2.0, distance),
    }
}

/// Metres per pixel of [`far_camera`].
pub const PIXEL: f64 = 4.0 / SIDE as f64;

/// For each pixel whether the body covers it.
pub fn covered<const N: usize>(world: &World<N>, slice: &Slice<N>) -> Vec<bool> {
    let empty = World::<N>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    let draw = |world: &World<N>| render(&Bodies::of(world), slice, Some(&far_camera()), &settings(), &|_| ()).unwrap();
    let (with, without): (Image, Image) = (draw(world), draw(&empty));
    with.bytes().chunks(3).zip(without.bytes().chunks(3)).map(|(a, b)| a != b).collect()
}
