//! One short program for each thing that the engine does, in 4D: `cargo run --release -p hyperbody --example tour [NAME…]`.
//!
//! Each is a file of its own beside this one, to be read and taken from; each checks what it claims.

mod bodies;
mod contacts;
mod filters;
mod joints;
mod queries;
mod sections;
mod state;

use hyperbody::prelude::*;

/// What a program ends with.
type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Name, what it shows, program.
type Stop = (&'static str, &'static str, fn() -> Outcome);

const STOPS: [Stop; 7] = [
    ("bodies", "kinds of bodies, forces, conveyors, led platforms, rest, growth", bodies::run),
    ("contacts", "materials, what touched and how hard, one's own rules", contacts::run),
    ("filters", "who meets whom: groups, pairs, sensors, one-way floors", filters::run),
    ("joints", "a door with a motor, a spring, a rope, a hand, what breaks, gears", joints::run),
    ("queries", "rays, moving shapes, what is near", queries::run),
    ("sections", "the slice through w = 0 of a body of four dimensions", sections::run),
    ("state", "going back, trying what would happen, the same bits", state::run),
];

/// A world with the ground y ≤ 0.
fn world_with_ground() -> Result<(World<4>, BodyHandle), Box<dyn std::error::Error>> {
    let mut world = World::new(WorldDef::default())?;
    let ground = world.add_body(BodyDef::fixed(Shape::half_space([0.0, 1.0, 0.0, 0.0], 0.0)?))?;
    Ok((world, ground))
}

fn step_for(world: &mut World<4>, seconds: f64) {
    for _ in 0..(seconds / world.dt()).round() as u32 {
        world.step();
    }
}

/// Fails with a sentence unless what it says is so.
fn claim(holds: bool, what: &str) -> Outcome {
    println!("  {what}");
    if holds { Ok(()) } else { Err(format!("this is not so: {what}").into()) }
}

fn main() -> Outcome {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    if let Some(unknown) = wanted.iter().find(|name| STOPS.iter().all(|(stop, ..)| stop != name)) {
        let names: Vec<&str> = STOPS.iter().map(|(name, ..)| *name).collect();
        return Err(format!("there is no `{unknown}`; there are {}", names.join(", ")).into());
    }
    for (name, what, run) in STOPS {
        if wanted.is_empty() || wanted.iter().any(|stop| stop == name) {
            println!("{name}: {what}");
            run()?;
        }
    }
    Ok(())
}
