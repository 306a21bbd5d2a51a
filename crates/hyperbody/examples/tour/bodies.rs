//! Bodies: dynamic, static and kinematic ones, and what drives them.

use hyperbody::prelude::*;

use crate::{Outcome, claim, step_for, world_with_ground};

pub(crate) fn run() -> Outcome {
    let (mut world, _) = world_with_ground()?;

    // A tesseract of 16 kg, pushed for one step, and one that a steady force holds up.
    let tesseract = || Ok::<_, GeometryError>(BodyDef::new(Shape::cuboid([0.5; 4])?).mass(16.0));
    let pushed = world.add_body(tesseract()?.position([0.0, 0.5, 0.0, 0.0]))?;
    world.body_mut(pushed).ok_or("it is there")?.apply_impulse([0.0, 0.0, 0.0, 48.0])?;
    let floating = world.add_body(tesseract()?.position([5.0, 3.0, 0.0, 0.0]))?;
    let weight = -world.gravity() * 16.0;
    world.body_mut(floating).ok_or("it is there")?.set_steady_force(weight, Bivector::ZERO)?;

    // A belt that carries along w, and a platform that is led along z with a passenger on it.
    let belt = BodyDef::fixed(Shape::cuboid([1.0, 0.1, 1.0, 4.0])?).position([-4.0, 0.1, 0.0, 0.0]);
    world.add_body(belt.surface_velocity([0.0, 0.0, 0.0, 1.0]))?;
    let carried = world.add_body(tesseract()?.position([-4.0, 0.7, 0.0, -2.0]))?;
    let platform = BodyDef::new(Shape::cuboid([1.0, 0.1, 1.0, 1.0])?).kind(BodyKind::Kinematic);
    let platform = world.add_body(platform.position([10.0, 2.0, 0.0, 0.0]))?;
    let passenger = world.add_body(tesseract()?.position([10.0, 2.6, 0.0, 0.0]))?;
    for step in 1..=120 {
        let along = 0.01 * f64::from(step);
        world.move_kinematic(platform, Pose::from_translation(Vector([10.0, 2.0, along, 0.0])))?;
        world.step();
    }

    let place = |handle| world.body(handle).map(|body: BodyRef<'_, 4>| body.position()).ok_or("it is there");
    claim(place(pushed)?[3] > 0.5, "a push along w moved the first tesseract out of the slice w = 0")?;
    claim((place(floating)?[1] - 3.0).abs() < 1e-6, "a steady force of its weight holds the second one in the air")?;
    claim(place(carried)?[3] > -1.0, "the belt carries the third one along w")?;
    claim((place(passenger)?[2] - 1.2).abs() < 0.1, "the platform carries its passenger along z")?;

    step_for(&mut world, 3.0);
    claim(world.body(pushed).is_some_and(|body| body.is_sleeping()), "what rests falls asleep")?;
    world.body_mut(pushed).ok_or("it is there")?.wake();

    // It grows to twice its size in all four directions, in place, and keeps its handle.
    world.set_shape(pushed, Shape::cuboid([1.0; 4])?)?;
    step_for(&mut world, 4.0);
    let grown = world.body(pushed).ok_or("it is there")?;
    claim(
        (grown.position()[1] - 1.0).abs() < 0.01 && grown.mass() > 15.9,
        "a body that grows is pushed up, and rests",
    )?;
    world.remove_body(floating)?;
    claim(world.body(floating).is_none(), "the handle of a body that was removed is refused")
}
