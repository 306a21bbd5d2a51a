//! Pictures of one body against the same picture without it.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use hyperbody::geometry::Polytope;
use hyperbody::geometry::section::{SectionPolytope, SliceFrame};
use hyperbody::math::{Bivector, Pose, Rotation, Vector};
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
    covered_from(world, slice, &far_camera())
}

/// As [`covered`], by another camera.
pub fn covered_from<const N: usize>(world: &World<N>, slice: &Slice<N>, camera: &Camera) -> Vec<bool> {
    let empty = World::<N>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    let draw = |world: &World<N>| render(&Bodies::of(world), slice, Some(camera), &settings(), &|_| ()).unwrap();
    differing(&draw(world), &draw(&empty))
}

/// For each pixel whether two pictures differ.
pub fn differing(a: &Image, b: &Image) -> Vec<bool> {
    a.bytes().chunks(3).zip(b.bytes().chunks(3)).map(|(a, b)| a != b).collect()
}

/// How many there are.
pub fn count(pixels: &[bool]) -> usize {
    pixels.iter().filter(|&&pixel| pixel).count()
}

/// A rotation in every plane, by the same rule in every dimension.
pub fn turned<const N: usize>(scale: f64) -> Rotation<N> {
    let mut turn = Bivector::ZERO;
    for i in 0..N {
        for j in i + 1..N {
            turn.set(i, j, scale * (0.7 + 0.31 * i as f64 - 0.23 * j as f64));
        }
    }
    Rotation::exp(&turn)
}

/// Area and perimeter of the shadow of a solid along its third axis.
pub fn shadow(section: &SectionPolytope<3>) -> [f64; 2] {
    let points: Vec<Vector<2>> = section.vertices().iter().map(|v| Vector([v[0], v[1]])).collect();
    area_and_perimeter(&points)
}

/// Area and perimeter of the convex hull of points.
pub fn area_and_perimeter(points: &[Vector<2>]) -> [f64; 2] {
    let hull = Polytope::from_points(points).unwrap();
    // Shoelace formula over the edges, which come with outward normals.
    hull.facets().iter().fold([0.0; 2], |[area, perimeter], edge| {
        let [a, b] = [edge.vertices[0], edge.vertices[1]].map(|v| hull.vertices()[v as usize]);
        [area + 0.5 * edge.offset * a.distance(b), perimeter + a.distance(b)]
    })
}

/// Cuts by the hyperplane in which the last coordinate is zero.
pub fn cut<const N: usize, const M: usize>(polytope: &SectionPolytope<N>) -> SectionPolytope<M> {
    polytope.section(&SliceFrame::new(Pose::IDENTITY))
}

/// Boxes and balls in a heap on a floor.
pub fn heap<const N: usize>() -> World<N> {
    let mut world = World::new(WorldDef::default()).unwrap();
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
    for index in 0..12 {
        let shape = if index % 2 == 0 { Shape::cuboid([0.5; N]) } else { Shape::ball(0.6) };
        let position = Vector::from_fn(|i| match i {
            1 => 0.6 + 0.5 * f64::from(index),
            _ => 0.4 * f64::from((index * (i as i32 + 2)) % 5) - 0.8,
        });
        world
            .add_body(BodyDef::new(shape.unwrap()).position(position).rotation(turned(0.1 * f64::from(index))))
            .unwrap();
    }
    for _ in 0..20 {
        world.step();
    }
    world
}
