//! Who meets whom: groups, single pairs, sensors, and floors that let through from below.

use hyperbody::prelude::*;

use crate::{Outcome, claim, step_for, world_with_ground};

const GROUND: u32 = 1 << 0;

pub(crate) fn run() -> Outcome {
    let (mut world, ground) = world_with_ground()?;
    let ball = |x: f64| Ok::<_, GeometryError>(BodyDef::new(Shape::ball(0.3)?).position([x, 1.0, 0.0, 0.0]));

    // A ghost meets everything but what is ground; another pair has its collision switched off.
    world.body_mut(ground).ok_or("it is there")?.set_groups(Groups::new(GROUND, u32::MAX));
    let ghost = world.add_body(ball(0.0)?.groups(Groups::new(!GROUND, !GROUND)))?;
    let unheld = world.add_body(ball(2.0)?)?;
    world.set_collision(ground, unheld, false)?;
    let held = world.add_body(ball(4.0)?)?;

    // A sensor notices and does not push.
    let gate = BodyDef::fixed(Shape::cuboid([0.5, 0.2, 0.5, 0.5])?).position([4.0, 0.6, 0.0, 0.0]).sensor(true);
    let gate = world.add_body(gate)?;

    // A platform that is passed from below, and holds from above.
    let platform = BodyDef::fixed(Shape::cuboid([1.0, 0.1, 1.0, 1.0])?).position([8.0, 1.5, 0.0, 0.0]);
    world.add_body(platform.one_way([0.0, 1.0, 0.0, 0.0]))?;
    let jumping = world.add_body(ball(8.0)?.velocity([0.0, 6.0, 0.0, 0.0]))?;

    let mut noticed = Vec::new();
    for _ in 0..150 {
        world.step();
        noticed.extend(world.events().sensors().iter().filter(|event| event.sensor == gate).map(|event| event.phase));
    }
    let height = |handle| world.body(handle).map(|body: BodyRef<'_, 4>| body.position()[1]).ok_or("it is there");
    claim(height(ghost)? < -1.0, "the ghost falls through the ground")?;
    claim(height(unheld)? < -1.0, "so does the one whose pair with it is switched off")?;
    claim((height(held)? - 0.3).abs() < 0.01, "the third one lies on it")?;
    claim(noticed.first() == Some(&SensorPhase::Enter), "the sensor noticed it on its way")?;
    claim((height(jumping)? - 1.9).abs() < 0.01, "the fourth jumped through the platform, and stands on it")?;

    // What is changed takes effect at once, and wakes what lay there.
    world.body_mut(held).ok_or("it is there")?.set_groups(Groups::NONE);
    step_for(&mut world, 1.0);
    let fell = world.body(held).is_some_and(|body| body.position()[1] < -1.0);
    claim(fell, "groups can be changed at any time")
}
