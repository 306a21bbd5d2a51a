//! How many of fast bodies get through thin ones, by dimension, kind of bullet and kind of wall:
//! `cargo run --release -p hyperbody-dynamics --example bullets [SHOTS] [DIMENSION]…`, 1,000 shots of each as it stands.
//!
//! Every bullet flies at 500 m/s and 60 steps a second, from a random place in a random direction with a random attitude and
//! spin, at a wall 1 cm thick. What is counted is the centres of pieces that come out on the other side.

mod common;

use std::sync::Arc;

use common::Random;
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, World, WorldDef};
use hyperbody_geometry::{Polytope, Shape, regular};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

const SPEED: f64 = 500.0;
const THICKNESS: f64 = 0.01;
/// Half the width of walls, m: a bullet that is stopped does not reach the edge while it is watched.
const WIDTH: f64 = 300.0;
const STEPS: usize = 24;

type Error = Box<dyn std::error::Error>;

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (0.5 + 0.5 * self.next())
    }

    fn planes<const N: usize>(&mut self, largest: f64) -> Bivector<N> {
        let mut b = Bivector::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                b.set(i, j, largest * self.next());
            }
        }
        b
    }

    /// Uniform in directions that are at most sixty degrees off the first axis.
    fn forward<const N: usize>(&mut self) -> Vector<N> {
        for _ in 0..10_000 {
            let v = Vector::<N>::from_fn(|_| self.next());
            let length = v.norm();
            if length <= 1.0 && v[0] > 0.5 * length {
                return v * (1.0 / length);
            }
        }
        Vector::unit(0)
    }
}

#[derive(Clone, Copy, Debug)]
enum Bullet {
    Box,
    Plate,
    Ball,
    Capsule,
    Hull,
    Regular,
    Compound,
}

#[derive(Clone, Copy, Debug)]
enum Wall {
    Box,
    Hull,
    Heavy,
    Blade,
}

const BULLETS: [Bullet; 7] =
    [Bullet::Box, Bullet::Plate, Bullet::Ball, Bullet::Capsule, Bullet::Hull, Bullet::Regular, Bullet::Compound];
const WALLS: [Wall; 4] = [Wall::Box, Wall::Hull, Wall::Heavy, Wall::Blade];

fn bullet<const N: usize>(kind: Bullet, random: &mut Random) -> Result<Shape<N>, Error> {
    let size = random.between(0.05, 0.3);
    Ok(match kind {
        Bullet::Box => Shape::cuboid(Vector::from_fn(|_| size * random.between(0.5, 1.5)))?,
        Bullet::Plate => Shape::cuboid(Vector::from_fn(|axis| if axis == 1 { 0.01 } else { size }))?,
        Bullet::Ball => Shape::ball(size)?,
        Bullet::Capsule => Shape::capsule(size, 0.3 * size, 1)?,
        Bullet::Hull => {
            let points: Vec<Vector<N>> = (0..4 * N + 4).map(|_| Vector::from_fn(|_| size * random.next())).collect();
            Shape::polytope(Arc::new(Polytope::from_points(&points)?))?
        }
        Bullet::Regular => {
            let name = if N == 4 { "24-cell" } else { "cross-polytope" };
            Shape::polytope(Arc::new(regular::polytope(name, regular::Size::Circumradius(size))?))?
        }
        Bullet::Compound => {
            let end = |side: f64| Pose::from_translation(Vector::unit(1) * (side * 1.5 * size));
            Shape::compound(vec![(end(1.0), Shape::ball(0.5 * size)?), (end(-1.0), Shape::cuboid([0.5 * size; N])?)])?
        }
    })
}

/// Half the width of a wall, m.
fn width(kind: Wall) -> f64 {
    match kind {
        Wall::Blade => 10.0,
        Wall::Box | Wall::Hull | Wall::Heavy => WIDTH,
    }
}

/// The wall stands across the first axis; its centre is the origin.
fn add_wall<const N: usize>(world: &mut World<N>, kind: Wall, random: &mut Random) -> Result<BodyHandle, Error> {
    let half = Vector::from_fn(|axis| if axis == 0 { 0.5 * THICKNESS } else { width(kind) });
    let def = match kind {
        Wall::Box => BodyDef::fixed(Shape::cuboid(half)?),
        Wall::Hull => {
            // Both faces are cross-polytopes, one turned against the other by its size.
            let mut points = Vec::new();
            for axis in 1..N {
                for (side, far) in [(-1.0, 1.0), (1.0, 1.1)] {
                    let reach = 4.0 * WIDTH * far;
                    points.push(Vector::unit(0) * (side * 0.5 * THICKNESS) + Vector::unit(axis) * reach);
                    points.push(Vector::unit(0) * (side * 0.5 * THICKNESS) - Vector::unit(axis) * reach);
                }
            }
            BodyDef::fixed(Shape::polytope(Arc::new(Polytope::from_points(&points)?))?)
        }
        Wall::Heavy => BodyDef::new(Shape::cuboid(half)?).mass(1e6),
        Wall::Blade => BodyDef::new(Shape::cuboid(half)?)
            .kind(BodyKind::Kinematic)
            .angular_velocity(blade_spin(random.between(2.0, 15.0))),
    };
    Ok(world.add_body(def)?)
}

/// The blade turns so that it comes towards the bullets, which lie on the side of +y.
fn blade_spin<const N: usize>(rate: f64) -> Bivector<N> {
    let mut spin = Bivector::ZERO;
    spin.set(0, 1, rate);
    spin
}

/// Whether the middle of every piece is on the near side of the wall, or beside it.
fn held<const N: usize>(world: &World<N>, wall: BodyHandle, bullet: BodyHandle, width: f64) -> bool {
    let (Some(wall), Some(bullet)) = (world.body(wall), world.body(bullet)) else { return false };
    let pieces = bullet.shape().pieces();
    let middle = |pose: &Pose<N>| bullet.pose().transform_point(pose.translation);
    pieces.iter().all(|(pose, _)| {
        let middle = if pieces.len() == 1 { bullet.centre_of_mass() } else { middle(pose) };
        let seen = wall.pose().inverse_transform_point(middle);
        let beside = (1..N).any(|axis| seen[axis].abs() > width);
        beside || seen[0] < 0.0
    })
}

fn shoot<const N: usize>(kind: Bullet, wall: Wall, random: &mut Random) -> Result<bool, Error> {
    let def = WorldDef { gravity: Vector::ZERO, sleeping: false, ..WorldDef::default() };
    let mut world = World::<N>::new(def)?;
    let wall_body = add_wall(&mut world, wall, random)?;
    let direction = random.forward::<N>();
    let (velocity, start) = match wall {
        Wall::Blade => (direction * (0.02 * SPEED), Vector::unit(1) * random.between(1.0, 8.0) - Vector::unit(0) * 2.0),
        Wall::Box | Wall::Hull | Wall::Heavy => (direction * SPEED, direction * -random.between(2.0, 12.0)),
    };
    let def = BodyDef::new(bullet(kind, random)?)
        .mass(1.0)
        .position(start)
        .rotation(Rotation::exp(&random.planes(3.0)))
        .velocity(velocity)
        .angular_velocity(random.planes(100.0));
    let shot = world.add_body(def)?;
    let turn = match wall {
        // A quarter of a turn: beyond, the other half of the blade comes.
        Wall::Blade => STEPS / 4,
        Wall::Box | Wall::Hull | Wall::Heavy => STEPS,
    };
    for _ in 0..turn {
        world.step();
    }
    Ok(held(&world, wall_body, shot, width(wall)))
}

fn table<const N: usize>(shots: usize) -> Result<(), Error> {
    for wall in WALLS {
        let mut counts = String::new();
        for kind in BULLETS {
            let mut random = Random(1 + N as u64);
            let mut through = 0;
            for _ in 0..shots {
                through += usize::from(!shoot::<N>(kind, wall, &mut random)?);
            }
            counts += &format!("{through:10}");
        }
        println!("{N}D {:8}{counts}", format!("{wall:?}"));
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    let arguments = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<Vec<usize>, _>>()?;
    let shots = arguments.first().copied().unwrap_or(1000);
    let dimensions = if arguments.len() > 1 { &arguments[1..] } else { &[2, 3, 4, 5, 6] };
    let head: String = BULLETS.iter().map(|kind| format!("{:>10}", format!("{kind:?}"))).collect();
    println!("got through, of {shots}\n   wall    {head}");
    for &n in dimensions {
        match n {
            2 => table::<2>(shots)?,
            3 => table::<3>(shots)?,
            4 => table::<4>(shots)?,
            5 => table::<5>(shots)?,
            6 => table::<6>(shots)?,
            _ => return Err(format!("dimension {n} is not between 2 and 6").into()),
        }
    }
    Ok(())
}
