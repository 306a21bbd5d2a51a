//! A scene and the same one many times as large are one picture: no length of the look is fixed but that of the grid's meshes,
//! which are powers of ten.

use crate::common::{count, settings};
use hyperbody::math::{Rotation, Vector};
use hyperbody::prelude::{BodyDef, Shape, World, WorldDef};
use hyperbody_render::{Bodies, Image, Settings, Slice, render};

/// A ball and a box of this size on a floor, drawn by the camera that is chosen for them.
fn picture<const N: usize>(size: f64) -> Image {
    let mut world = World::<N>::new(WorldDef::default()).unwrap();
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
    let ball = Shape::ball(size).unwrap();
    world.add_body(BodyDef::new(ball).mass(1.0).position(Vector::unit(1) * size)).unwrap();
    let cuboid = Shape::cuboid([0.5 * size; N]).unwrap();
    let beside = Vector::unit(1) * (0.8 * size) + Vector::unit(0) * (2.0 * size);
    world.add_body(BodyDef::new(cuboid).mass(1.0).position(beside).rotation(Rotation::in_plane(0, 1, 0.3))).unwrap();
    let settings = Settings { width: 120, height: 80, edge_samples: 4, light_rays: 2, ..settings() };
    render(&Bodies::of(&world), &Slice::natural(), None, &settings, &|_| ()).unwrap()
}

fn check<const N: usize>() {
    let small = picture::<N>(3.0);
    for tens in [10.0, 100.0, 1e3, 1e5] {
        let large = picture::<N>(3.0 * tens);
        // Rounding decides which of two surfaces is seen at an edge, and whether a ray of light just passes.
        let apart = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12);
        let other: Vec<bool> = small.bytes().chunks(3).zip(large.bytes().chunks(3)).map(apart).collect();
        assert!(
            count(&other) < 40,
            "{} of {} pixels differ {tens} times as large, in {N}D",
            count(&other),
            other.len()
        );
    }
}

#[test]
fn large_scenes_look_like_small_ones() {
    check::<2>();
    check::<3>();
    check::<4>();
    check::<5>();
    check::<6>();
}
