//! How the cost of a settled step grows with the number of tesseracts in a pit:
//! `cargo run --release -p hyperbody-dynamics --example pile_growth [ACROSS LAYERS]…`, two to five minutes as it stands.
//!
//! Each pile falls for seven seconds; then the fastest of the steps that follow is taken, which other work on the machine
//! disturbs least.

mod common;

use std::time::Instant;

use common::Random;
use hyperbody_dynamics::{BodyDef, World, WorldDef, WorldError};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

const N: usize = 4;
const SPACING: f64 = 1.9;
const SETTLING_STEPS: usize = 420;
const TIMED_STEPS: usize = 40;

/// Layers of `across`³ turned tesseracts with edges of 1 m over a pit.
fn pile(across: usize, layers: usize) -> Result<World<N>, WorldError> {
    let mut random = Random(2020);
    let mut world = World::<N>::new(WorldDef { sleeping: false, ..WorldDef::default() })?;
    let half_width = 0.5 * SPACING * across as f64 + 0.9;
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0)?))?;
    let sideways = [0, 2, 3];
    for axis in sideways {
        for wall in [Vector::unit(axis), -Vector::unit(axis)] {
            world.add_body(BodyDef::fixed(Shape::half_space(wall, -half_width)?))?;
        }
    }
    for layer in 0..layers {
        let shift = if layer % 2 == 1 { 0.25 } else { -0.25 };
        for index in 0..across.pow(3) {
            let mut cell = index;
            let mut position = Vector::unit(1) * (1.3 + SPACING * layer as f64);
            for axis in sideways {
                let column = (cell % across) as f64 - 0.5 * (across as f64 - 1.0);
                position.0[axis] = SPACING * (column + shift) + 0.05 * random.next();
                cell /= across;
            }
            let mut turn = Bivector::ZERO;
            for i in 0..N {
                for j in i + 1..N {
                    turn.set(i, j, 0.35 * random.next());
                }
            }
            world.add_body(BodyDef::new(Shape::cuboid([0.5; N])?).position(position).rotation(Rotation::exp(&turn)))?;
        }
    }
    Ok(world)
}

fn measure(across: usize, layers: usize) -> Result<(), WorldError> {
    let mut world = pile(across, layers)?;
    (0..SETTLING_STEPS).for_each(|_| world.step());
    let mut fastest = f64::INFINITY;
    for _ in 0..TIMED_STEPS {
        let start = Instant::now();
        world.step();
        fastest = fastest.min(start.elapsed().as_secs_f64());
    }
    let (bodies, points) =
        (layers * across.pow(3), world.contacts().map(|contact| contact.points().count()).sum::<usize>());
    println!(
        "{bodies:6} {points:8} {:10.2} {:12.2} {:12.3}",
        fastest * 1e3,
        fastest * 1e6 / bodies as f64,
        fastest * 1e6 / points as f64
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<Vec<usize>, _>>()?;
    println!("bodies   points    ms/step      µs/body     µs/point");
    let given: Vec<(usize, usize)> = arguments.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
    let piles = if given.is_empty() { vec![(5, 1), (5, 4), (5, 8), (8, 8)] } else { given };
    for (across, layers) in piles {
        measure(across, layers)?;
    }
    Ok(())
}
