//! What joints make possible: doors, seesaws, cars, wrecking balls, tops, conveyors.

use super::stage::{floor, material, scene};
use crate::model::{Body, Joint, JointKind, Scene, ShapeSpec};

fn hinge(a: Option<&str>, b: &str, plane: &str) -> Joint {
    let kind = JointKind::Hinge { plane: plane.to_owned() };
    match a {
        Some(a) => Joint::new(kind, a, b),
        None => Joint::with_world(kind, b),
    }
}

pub(super) fn seesaw_3d() -> Scene {
    let mut scene = scene(3, "A heavy cube lands on one end of a seesaw and throws the light one off the other end.");
    scene.bodies.push(floor(3));
    scene.bodies.push(Body::new(ShapeSpec::cuboid([3.0, 0.1, 0.4])).named("plank").at([0.0, 0.8, 0.0]).weighing(4.0));
    scene.joints.push(hinge(None, "plank", "xy").anchored([0.0, 0.8, 0.0], []).limited_deg(-14.0, 14.0));
    scene.bodies.push(Body::new(ShapeSpec::cube(3, 0.25)).named("light").at([-2.6, 1.2, 0.0]).weighing(1.0));
    scene.bodies.push(Body::new(ShapeSpec::cube(3, 0.35)).named("heavy").at([2.6, 4.0, 0.0]).weighing(12.0));
    scene
}

pub(super) fn gyroscope_3d() -> Scene {
    let mut scene = scene(
        3,
        "A spinning disc held by the end of its stem does not fall: its weight turns it sideways, round and round the pivot.",
    );
    scene.sleeping = false;
    scene.dt = 1.0 / 240.0;
    scene.bodies.push(Body::new(ShapeSpec::cuboid([0.1, 1.0, 0.1])).named("post").fixed().at([0.0, 1.0, 0.0]));
    let disc = ShapeSpec::product([(ShapeSpec::ball(0.5), "yz"), (ShapeSpec::cube(1, 0.05), "x")]);
    scene.bodies.push(Body::new(disc).named("disc").at([0.6, 2.0, 0.0]).spinning("yz", 60.0).weighing(2.0));
    let joint = Joint::new(JointKind::Ball, "post", "disc").anchored([0.0, 1.0, 0.0], [-0.6, 0.0, 0.0]);
    scene.joints.push(joint);
    scene
}

pub(super) fn car_3d() -> Scene {
    let mut scene = scene(3, "A car with motors in its rear wheels drives over three bumps.");
    scene.materials.push(material("tyre", 1.0, 0.0));
    scene.bodies.push(floor(3).made_of("tyre"));
    for bump in 0..3 {
        let x = 5.0 + 2.5 * f64::from(bump);
        let log = ShapeSpec::capsule(3.0, 0.25, "z");
        scene.bodies.push(Body::new(log).named(format!("bump {bump}")).fixed().at([x, -0.1, 0.0]).made_of("tyre"));
    }
    scene
        .bodies
        .push(Body::new(ShapeSpec::cuboid([1.2, 0.2, 0.5])).named("chassis").at([0.0, 0.7, 0.0]).weighing(30.0));
    for (x, axle) in [(-0.8, "rear"), (0.8, "front")] {
        for (z, side) in [(-0.75, "left"), (0.75, "right")] {
            let name = format!("{axle} {side} wheel");
            let wheel = Body::new(ShapeSpec::ball(0.4)).named(&name).at([x, 0.45, z]).made_of("tyre").weighing(3.0);
            scene.bodies.push(wheel);
            let joint = hinge(Some("chassis"), &name, "xy").anchored([x, -0.25, z], []);
            scene.joints.push(if axle == "rear" { joint.driven(-10.0, 40.0) } else { joint });
        }
    }
    scene
}

pub(super) fn door_4d() -> Scene {
    let mut scene = scene(
        4,
        "A door in four dimensions hangs on a hinge that is a plane, y and w, and turns in xz alone; a ball knocks it open, as \
         far as its limit.",
    );
    scene.bodies.push(floor(4));
    let leaf = ShapeSpec::cuboid([0.9, 1.0, 0.05, 1.0]);
    scene.bodies.push(Body::new(leaf).named("door").at([0.0, 1.1, 0.0, 0.0]).weighing(6.0));
    let mut joint = hinge(None, "door", "xz").anchored([-0.95, 1.1, 0.0, 0.0], [-0.95, 0.0, 0.0, 0.0]);
    joint = joint.limited_deg(-100.0, 100.0).sprung(0.0, 0.1, 0.5);
    scene.joints.push(joint);
    let ball = Body::new(ShapeSpec::ball(0.3)).named("ball").at([0.5, 0.6, -3.0, 0.4]).weighing(3.0);
    scene.bodies.push(ball.moving([0.0, 2.5, 6.0, 0.0]));
    scene
}

pub(super) fn wrecking_ball_4d() -> Scene {
    let mut scene =
        scene(4, "A heavy ball on a rope swings along w, out of sight, and comes back through a wall of tesseracts.");
    scene.bodies.push(floor(4));
    for row in 0..4 {
        for column in 0..4 {
            for depth in 0..2 {
                let position =
                    [(f64::from(column) - 1.5) * 1.02, 0.5 + f64::from(row), 0.0, (f64::from(depth) - 0.3) * 1.02];
                let brick = Body::new(ShapeSpec::cube(4, 0.5)).named(format!("brick {row} {column} {depth}"));
                scene.bodies.push(brick.at(position));
            }
        }
    }
    let (sin, cos) = hyperbody::math::scalar::sin_cos(1.1);
    let length = 7.0;
    let ball = Body::new(ShapeSpec::ball(0.8)).named("ball").at([0.0, 9.5 - length * cos, 0.0, length * sin]);
    scene.bodies.push(ball.weighing(40.0));
    scene.joints.push(Joint::with_world(JointKind::Rope { length }, "ball").anchored([0.0, 9.5, 0.0, 0.0], []));
    scene
}

pub(super) fn conveyor_4d() -> Scene {
    let mut scene =
        scene(4, "A belt that runs along x hands six tesseracts to one that runs along w, which carries them off.");
    scene.bodies.push(floor(4));
    let belt = |name: &str, at: [f64; 4], half: [f64; 4], along: usize| {
        let mut belt = Body::new(ShapeSpec::cuboid(half)).named(name).fixed().at(at);
        belt.surface_velocity = vec![0.0; 4];
        belt.surface_velocity[along] = 1.5;
        belt
    };
    scene.bodies.push(belt("first belt", [0.0, 1.75, 0.0, 0.0], [4.0, 0.25, 1.0, 1.0], 0));
    scene.bodies.push(belt("second belt", [5.2, 0.95, 0.0, 3.0], [1.1, 0.25, 1.0, 4.5], 3));
    for index in 0..6 {
        let x = -3.5 + 1.1 * f64::from(index);
        scene.bodies.push(Body::new(ShapeSpec::cube(4, 0.3)).named(format!("parcel {index}")).at([x, 2.35, 0.0, 0.0]));
    }
    scene
}
