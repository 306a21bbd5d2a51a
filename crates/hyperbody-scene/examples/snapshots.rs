//! From a snapshot every built-in scene has the same future to the bit, in the same world and in a new one:
//! `cargo run --release -p hyperbody-scene --example snapshots`.

use std::process::ExitCode;

use hyperbody_scene::{AnyWorld, BUILT_IN, Scene, SceneError};

/// Before the snapshot: long enough that most scenes have met their floor.
const BEFORE: usize = 60;

/// After it.
const AFTER: usize = 300;

fn run(world: &mut AnyWorld, steps: usize) -> u64 {
    for _ in 0..steps {
        world.step();
    }
    world.state_hash()
}

/// The hashes after the first run, after going back in the same world, and in a new world on two threads.
fn hashes(scene: &Scene) -> Result<[u64; 3], SceneError> {
    let mut world = AnyWorld::new(scene, 1)?;
    run(&mut world, BEFORE);
    let snapshot = world.snapshot();
    let first = run(&mut world, AFTER);
    world.restore(&snapshot)?;
    let again = run(&mut world, AFTER);
    let mut other = AnyWorld::new(scene, 2)?;
    other.restore(&snapshot)?;
    Ok([first, again, run(&mut other, AFTER)])
}

fn main() -> Result<ExitCode, SceneError> {
    let mut wrong = 0;
    for built_in in BUILT_IN {
        let [first, again, other] = hashes(&built_in.scene())?;
        if first != again || first != other {
            println!("{}: {first:016x}, restored {again:016x}, in a new world {other:016x}", built_in.name);
            wrong += 1;
        }
    }
    println!("{} scenes, {AFTER} steps from a snapshot after {BEFORE}: {wrong} differ", BUILT_IN.len());
    Ok(if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
