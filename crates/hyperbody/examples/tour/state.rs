//! The state: going back to it, to the bit, by so many steps, and saving it.

use hyperbody::prelude::*;

use crate::{Outcome, claim, step_for, world_with_ground};

pub(crate) fn run() -> Outcome {
    let (mut world, _) = world_with_ground()?;
    let mut bodies = Vec::new();
    for index in 0..5 {
        let turn = Rotation::in_plane(0, 3, 0.3 * f64::from(index));
        let body = BodyDef::new(Shape::cuboid([0.4; 4])?).position([0.0, 1.0 + 1.1 * f64::from(index), 0.0, 0.0]);
        bodies.push(world.add_body(body.rotation(turn))?);
    }
    step_for(&mut world, 0.5);

    let snapshot = world.snapshot();
    step_for(&mut world, 2.0);
    let first = world.state_hash();
    world.restore(&snapshot);
    claim(world.state_hash() != first, "the world is back at half a second")?;
    step_for(&mut world, 2.0);
    claim(world.state_hash() == first, "and goes through the same two seconds again, to the bit")?;

    roll_back(&mut world, bodies[0])?;
    world.restore(&snapshot);
    step_for(&mut world, 2.0);

    // A save game: bytes, from which another process goes on as this one did. What was changed on the way is refused.
    let mut saved = snapshot.to_bytes();
    println!("  five tesseracts and the ground are saved in {} bytes", saved.len());
    let mut loaded = World::<4>::new(WorldDef::default())?;
    loaded.restore(&Snapshot::from_bytes(&saved)?);
    step_for(&mut loaded, 2.0);
    claim(loaded.state_hash() == first, "a saved world goes the same way")?;
    saved[100] ^= 1;
    claim(Snapshot::<4>::from_bytes(&saved).is_err(), "and a broken file says so")?;

    // The future, tried in another world: what would happen if there were less gravity.
    let mut other = World::<4>::new(WorldDef { threads: 2, ..WorldDef::default() })?;
    other.restore(&snapshot);
    other.set_gravity([0.0, -1.6, 0.0, 0.0])?;
    step_for(&mut other, 2.0);
    let height = |world: &World<4>| world.bodies().map(|(_, body)| body.position()[1]).fold(0.0, f64::max);
    claim(height(&other) > height(&world), "on the moon the pile would still be higher")
}

/// Rollback, as games on a network do it: what another player did arrives six steps late.
fn roll_back(world: &mut World<4>, pushed: BodyHandle) -> Outcome {
    let push = |world: &mut World<4>| -> Outcome {
        Ok(world.body_mut(pushed).ok_or("it is there")?.apply_impulse([0.0, 0.0, 0.0, 8.0])?)
    };
    let mut elsewhere = World::<4>::new(WorldDef::default())?;
    elsewhere.restore(&world.snapshot());

    // The last half second, in at most 8 MB.
    let mut past = Rewind::new(30, 8 << 20);
    for step in 0..60 {
        if step == 54 {
            push(&mut elsewhere)?;
        }
        elsewhere.step();
        past.record(world)?;
        world.step();
    }
    claim(world.state_hash() != elsewhere.state_hash(), "a push that is not known yet leads two worlds apart")?;
    past.back(world, 6)?;
    push(world)?;
    (0..6).for_each(|_| world.step());
    claim(
        world.state_hash() == elsewhere.state_hash(),
        "six steps back, the push, six steps on: they are the same again",
    )?;

    println!("  {} moments take {} kB", past.len(), past.memory() / 1000);
    let refused = past.back(world, 60).err().ok_or("it was given up")?;
    println!("  {refused}");
    claim(world.state_hash() == elsewhere.state_hash(), "what the past no longer holds is refused, and nothing changes")
}
