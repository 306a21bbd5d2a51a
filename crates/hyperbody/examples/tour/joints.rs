//! Joints: what they keep, and what drives them.

use std::f64::consts::FRAC_PI_2;

use hyperbody::prelude::*;

use crate::{Outcome, claim, step_for, world_with_ground};

pub(crate) fn run() -> Outcome {
    let (mut world, _) = world_with_ground()?;
    let at = |x: f64, y: f64| Pose::from_translation(Vector([x, y, 0.0, 0.0]));
    let cube =
        |x: f64, y: f64| Ok::<_, GeometryError>(BodyDef::new(Shape::cuboid([0.25; 4])?).position([x, y, 0.0, 0.0]));

    // A door that turns in the plane xw alone, the two-dimensional space across it stays; a motor opens it to a right angle.
    let door = BodyDef::new(Shape::cuboid([0.5, 1.0, 0.5, 0.05])?).position([0.5, 2.0, 0.0, 0.0]);
    let door = world.add_body(door)?;
    let hinge = JointDef::hinge(None, door, at(0.0, 2.0), at(-0.5, 0.0), (0, 3));
    let hinge = hinge.angle_limits(0, 3, 0.0, FRAC_PI_2).motor(0, 3, 1.0, 50.0);
    claim(hinge.free_motions() == (0, 1), "a hinge has one free plane, in every dimension")?;
    world.add_joint(hinge)?;

    // A weight on a spring along y that swings at 1 Hz, one on a rope, and one that breaks what holds it.
    let mut slider = JointDef::slider(None, world.add_body(cube(3.0, 3.0)?)?, at(3.0, 3.0), Pose::IDENTITY, 1);
    slider.axes[1].spring = Some(Spring { target: 0.0, hz: 1.0, damping_ratio: 0.5, max_force: f64::INFINITY });
    let slider = world.add_joint(slider)?;
    let roped = world.add_body(cube(6.0, 4.0)?)?;
    world.add_joint(JointDef::rope(None, roped, [6.0, 5.0, 0.0, 0.0], [0.0; 4], 2.0))?;
    let heavy = world.add_body(cube(9.0, 3.0)?.mass(100.0))?;
    let weak = JointDef::ball(None, heavy, [9.0, 3.0, 0.0, 0.0], [0.0; 4]).break_at(500.0, f64::INFINITY);
    let weak = world.add_joint(weak)?;

    // A hand: a spring that drags a point of a body, with a strength of its own.
    let dragged = world.add_body(cube(12.0, 1.0)?)?;
    let hand = world.add_joint(JointDef::mouse(dragged, [0.0; 4], [12.0, 1.0, 0.0, 0.0], 200.0))?;
    world.set_joint_target(hand, [12.0, 2.0, 0.0, 1.5])?;

    world.step();
    let broken: Vec<_> = world.events().broken_joints().iter().map(|broken| broken.joint).collect();
    claim(broken == [weak], "a joint that holds 500 N breaks under 100 kg, and says so")?;
    step_for(&mut world, 4.0);

    let body = |handle| world.body(handle).ok_or("it is there");
    let axis = body(door)?.rotation().rotate(Vector::unit(0));
    claim((axis[3].abs() - 1.0).abs() < 0.01, "the motor opened the door into w, to its limit")?;
    claim((body(roped)?.position()[1] - 3.0).abs() < 0.05, "the rope is taut at two metres")?;
    let along = world.joint(slider).ok_or("it is there")?.force()[1].abs();
    claim(along > 0.0, "joints tell the force that they hold with")?;
    claim(
        (body(dragged)?.position() - Vector([12.0, 2.0, 0.0, 1.5])).norm() < 0.05,
        "the hand carried its body along w",
    )?;
    gears()
}

/// Two wheels that mesh, in the plane zw, on a carrier that floats: what the teeth press, the carrier takes.
fn gears() -> Outcome {
    let mut world = World::<4>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() })?;
    let place = |z: f64| Pose::from_translation(Vector([0.0, 0.0, z, 0.0]));
    let carrier = world.add_body(BodyDef::new(Shape::cuboid([0.1, 0.1, 0.6, 0.1])?).groups(Groups::NONE))?;
    let mut wheel = |z: f64, spin: f64| -> Result<BodyHandle, WorldError> {
        let wheel = BodyDef::new(Shape::ball(0.3)?).position([0.0, 0.0, z, 0.0]).groups(Groups::NONE);
        let wheel = world.add_body(wheel.angular_velocity(Bivector::plane(2, 3, spin)))?;
        world.add_joint(JointDef::hinge(carrier, wheel, place(z), Pose::IDENTITY, (2, 3)))?;
        Ok(wheel)
    };
    let (small, large) = (wheel(-0.5, 9.0)?, wheel(0.5, 0.0)?);
    world.add_joint(JointDef::gear(small, large, Pose::IDENTITY, Pose::IDENTITY, (2, 3), (20, 30)))?;
    let spin = world.angular_momentum();
    step_for(&mut world, 60.0);
    let rate = |body| Ok::<_, &str>(world.body(body).ok_or("it is there")?.angular_velocity().get(2, 3));
    let (small, large, carrier) = (rate(small)?, rate(large)?, rate(carrier)?);
    let off = 20.0 * (small - carrier) + 30.0 * (large - carrier);
    claim(off.abs() < 1e-3, "after a minute, wheels of 20 and 30 teeth turn against their carrier as 30 to −20")?;
    claim((world.angular_momentum() - spin).norm() < 1e-5 * spin.norm(), "and have the angular momentum they had")
}
