//! Contacts: materials, events for sound and haptics, and a hook that changes single contacts.

use hyperbody::prelude::*;

use crate::{Outcome, claim, step_for, world_with_ground};

pub(crate) fn run() -> Outcome {
    let (mut world, ground) = world_with_ground()?;
    let ball = Shape::ball(0.25)?;
    let rubber = Material { restitution: 0.8, ..Material::default() };
    let bouncing = BodyDef::new(ball.clone()).position([0.0, 2.0, 0.0, 0.0]).material(rubber);
    let bouncing = world.add_body(bouncing)?;

    let (mut hardest, mut met) = (0.0_f64, 0);
    for _ in 0..60 {
        world.step();
        for event in world.events().contacts().iter().filter(|event| event.phase == ContactPhase::Begin) {
            let (a, b) = event.bodies;
            if a == ground && b == bouncing || a == bouncing && b == ground {
                (hardest, met) = (hardest.max(event.impulse), met + 1);
            }
        }
    }
    println!("  the ball met the ground {met} times, with {hardest:.3} N·s at most");
    claim(met >= 1 && hardest > 0.0, "contacts are told with their impulses after each step")?;

    // What resists rolling brings a ball to rest; the other one goes on for ever.
    let felt = Material { rolling_resistance: 0.02, ..Material::default() };
    let rolling = |material, w| {
        BodyDef::new(ball.clone()).position([-5.0, 0.25, 0.0, w]).velocity([2.0, 0.0, 0.0, 0.0]).material(material)
    };
    let on_felt = world.add_body(rolling(felt, 2.0))?;
    let on_stone = world.add_body(rolling(Material::default(), 4.0))?;

    // Here half of the floor is ice: friction by place, which no material says.
    let slab = Shape::cuboid([0.5, 0.25, 0.5, 0.5])?;
    let sliding = |z| {
        let body = BodyDef::new(slab.clone()).position([5.0, 0.25, z, 0.0]).velocity([2.0, 0.0, 0.0, 0.0]);
        body.contact_hook(true)
    };
    let on_ice = world.add_body(sliding(6.0))?;
    let on_floor = world.add_body(sliding(-6.0))?;
    world.set_contact_hook(|contact: &mut HookedContact<'_, 4>| {
        if contact.points().iter().all(|point| point.position[2] > 0.0) {
            contact.set_friction(0.0);
        }
    });
    step_for(&mut world, 4.0);
    let speed = |handle| world.body(handle).map(|body: BodyRef<'_, 4>| body.velocity().norm()).ok_or("it is there");
    claim(speed(on_felt)? < 0.01 && speed(on_stone)? > 1.0, "resistance to rolling stops one ball, and not the other")?;
    claim(speed(on_ice)? > 1.99 && speed(on_floor)? < 0.01, "the hook makes ice of half the floor")
}
