//! From a snapshot every built-in scene has the same future to the bit: in the same world, and by way of bytes in a new one.
//! `cargo run --release -p hyperbody-scene --example snapshots`.

use std::process::ExitCode;

use hyperbody_scene::{AnySnapshot, AnyWorld, BUILT_IN, Scene, SceneError};

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

/// What became of a scene.
struct Outcome {
    /// Hashes after the first run, after going back in the same world, and from bytes in a new world on two threads.
    hashes: [u64; 3],
    /// Length of the bytes.
    size: usize,
    /// Whether what was read from them is written as the same ones.
    same_bytes: bool,
}

fn outcome(scene: &Scene) -> Result<Outcome, SceneError> {
    let mut world = AnyWorld::new(scene, 1)?;
    run(&mut world, BEFORE);
    let snapshot = world.snapshot();
    let first = run(&mut world, AFTER);
    world.restore(&snapshot)?;
    let again = run(&mut world, AFTER);
    let bytes = snapshot.to_bytes();
    let read = AnySnapshot::from_bytes(&bytes)?;
    let mut other = AnyWorld::new(scene, 2)?;
    other.restore(&read)?;
    let hashes = [first, again, run(&mut other, AFTER)];
    Ok(Outcome { hashes, size: bytes.len(), same_bytes: read.to_bytes() == bytes })
}

fn main() -> Result<ExitCode, SceneError> {
    let (mut wrong, mut largest) = (0, (0, ""));
    for built_in in BUILT_IN {
        let Outcome { hashes: [first, again, other], size, same_bytes } = outcome(&built_in.scene())?;
        if first != again || first != other || !same_bytes {
            let bytes = if same_bytes { "same" } else { "other" };
            println!("{}: {first:016x}, restored {again:016x}, from {bytes} bytes {other:016x}", built_in.name);
            wrong += 1;
        }
        largest = largest.max((size, built_in.name));
    }
    let (scenes, (size, name)) = (BUILT_IN.len(), largest);
    println!("{scenes} scenes, {AFTER} steps from a snapshot after {BEFORE}: {wrong} differ");
    println!("as bytes the largest is that of {name}: {} kB", size / 1000);
    Ok(if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
