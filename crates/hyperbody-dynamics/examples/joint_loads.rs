//! Nets and chains under load: how far apart their anchors come, and what a step costs. Run with `--release`. Ends with status 1
//! if one is farther apart at the end than it may be.

use std::process::ExitCode;
use std::time::Instant;

use hyperbody_dynamics::{BodyDef, BodyHandle, JointDef, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::Vector;

/// A grid of balls of radius 0.25, jointed to their neighbours half way, hung by its four corners.
fn net(side: usize) -> World<3> {
    let mut world = World::new(WorldDef { sleeping: false, ..WorldDef::default() }).expect("in range");
    let mut bodies: Vec<BodyHandle> = Vec::new();
    for i in 0..side {
        for j in 0..side {
            let ball = Shape::ball(0.25).expect("a ball");
            let corner = (i == 0 || i == side - 1) && (j == 0 || j == side - 1);
            let def = if corner { BodyDef::fixed(ball) } else { BodyDef::new(ball) };
            let me = world.add_body(def.position([i as f64, 20.0, j as f64])).expect("valid");
            for (neighbour, axis) in
                [(i > 0).then(|| (bodies[(i - 1) * side + j], 0)), (j > 0).then(|| (bodies[i * side + j - 1], 2))]
                    .into_iter()
                    .flatten()
            {
                let half = Vector::unit(axis) * 0.5;
                // Two of the corners' joints tie what cannot move; they do not exist here.
                let _ = world.add_joint(JointDef::ball(neighbour, me, half, -half));
            }
            bodies.push(me);
        }
    }
    world
}

/// Links of a metre, and a ball of `ratio` links' mass at the end; starts level and swings down.
fn chain(links: usize, ratio: f64, level: bool) -> World<3> {
    let mut world = World::new(WorldDef { sleeping: false, ..WorldDef::default() }).expect("in range");
    let along = if level { Vector::unit(0) } else { -Vector::unit(1) };
    let mut last = None;
    for k in 0..=links {
        let shape = Shape::ball(if k == links { 0.5 } else { 0.25 }).expect("a ball");
        let mass = if k == links { ratio } else { 1.0 };
        let body = BodyDef::new(shape).mass(mass).position(along * (k as f64 + 0.5));
        let body = world.add_body(body).expect("valid");
        let from = if last.is_some() { along * 0.5 } else { Vector::ZERO };
        world.add_joint(JointDef::ball(last, body, from, along * -0.5)).expect("valid");
        last = Some(body);
    }
    world
}

fn anchor_error(world: &World<3>) -> f64 {
    let mut largest: f64 = 0.0;
    for (_, joint) in world.joints() {
        let def = joint.def();
        let place = |body: Option<BodyHandle>, anchor| match body.and_then(|handle| world.body(handle)) {
            Some(body) => body.pose().transform_point(anchor),
            None => anchor,
        };
        let gap = place(Some(def.b), def.frame_b.translation) - place(def.a, def.frame_a.translation);
        largest = largest.max(gap.norm());
    }
    largest
}

/// Whether the anchors end at most 5 cm apart, and never were half a metre apart.
fn report(name: &str, mut world: World<3>, seconds: f64) -> bool {
    let (mut largest, mut fastest): (f64, f64) = (0.0, 0.0);
    let mut times = Vec::new();
    for step in 0..(seconds * 60.0) as usize {
        let start = Instant::now();
        world.step();
        times.push(start.elapsed().as_secs_f64() * 1e3);
        largest = largest.max(anchor_error(&world));
        if step + 1 == (seconds * 60.0) as usize {
            fastest = world.bodies().map(|(_, body)| body.velocity().norm()).fold(0.0, f64::max);
        }
    }
    times.sort_by(f64::total_cmp);
    let (at_end, median) = (anchor_error(&world), times[times.len() / 2]);
    println!(
        "{name}: anchors at the end {at_end:.4} m apart, at most {largest:.4} m; fastest body {fastest:.3} m/s; {median:.3} ms a step"
    );
    at_end <= 0.05 && largest <= 0.5
}

fn main() -> ExitCode {
    let held = [
        report("net of 20 × 20", net(20), 25.0),
        report("hanging chain of 100, 100 times a link at its end", chain(100, 100.0, false), 20.0),
        report("swinging chain of 100, 100 times a link at its end", chain(100, 100.0, true), 30.0),
        report("swinging chain of 12, equal masses", chain(12, 1.0, true), 10.0),
    ];
    if held == [true; 4] { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
