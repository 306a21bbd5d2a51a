//! Bodies from OFF files that are not convex: a channel falls, lies, and holds a ball in its hollow.

use hyperbody_scene::{AnyWorld, Body, BodyKind, Scene, ShapeSpec};

/// The profile of a channel: walls 0.2 thick and 1 high around a hollow 1 wide, standing on y = 0.
const PROFILE: [[f64; 2]; 8] =
    [[-0.7, 0.0], [0.7, 0.0], [0.7, 1.0], [0.5, 1.0], [0.5, 0.2], [-0.5, 0.2], [-0.5, 1.0], [-0.7, 1.0]];

const FLOOR_OF_HOLLOW: f64 = 0.2;

/// The profile times a segment: an OFF file in three dimensions.
fn channel_3d() -> String {
    let mut text = String::from("OFF\n16 10 24\n");
    for [x, y] in PROFILE {
        text += &format!("{x} {y} -1\n{x} {y} 1\n");
    }
    for end in [0, 1] {
        text += "8";
        (0..8).for_each(|u| text += &format!(" {}", 2 * u + end));
        text.push('\n');
    }
    for u in 0..8 {
        let next = (u + 1) % 8;
        text += &format!("4 {} {} {} {}\n", 2 * u, 2 * next, 2 * next + 1, 2 * u + 1);
    }
    text
}

/// The profile times a square: cells are the profile times the square's sides, and the profile's sides times the square.
pub(crate) fn channel_4d() -> String {
    let square = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    let vertex = |u: usize, k: usize| 4 * (u % 8) + k % 4;
    let mut text = String::from("4OFF\n32 44 64 12\n");
    for [x, y] in PROFILE {
        for [z, w] in square {
            text += &format!("{x} {y} {z} {w}\n");
        }
    }
    let mut face = |corners: Vec<usize>| {
        let words: Vec<String> = corners.iter().map(ToString::to_string).collect();
        text += &format!("{} {}\n", corners.len(), words.join(" "));
    };
    // Faces 0 to 3: profiles; 4 to 35: side by side; 36 to 43: squares.
    (0..4).for_each(|k| face((0..8).map(|u| vertex(u, k)).collect()));
    for u in 0..8 {
        for k in 0..4 {
            face(vec![vertex(u, k), vertex(u + 1, k), vertex(u + 1, k + 1), vertex(u, k + 1)]);
        }
    }
    (0..8).for_each(|u| face((0..4).map(|k| vertex(u, k)).collect()));
    let side = |u: usize, k: usize| 4 + 4 * (u % 8) + k % 4;
    (0..4).for_each(|k| face([k, (k + 1) % 4].into_iter().chain((0..8).map(|u| side(u, k))).collect()));
    (0..8).for_each(|u| face([36 + u, 36 + (u + 1) % 8].into_iter().chain((0..4).map(|k| side(u, k))).collect()));
    text
}

fn a_channel_holds_a_ball(dimension: usize, file: String) {
    let mut scene = Scene::new("channel", dimension);
    let point = |x: f64, y: f64| (0..dimension).map(|i| [x, y].get(i).copied().unwrap_or(0.0)).collect::<Vec<f64>>();
    let mut floor = Body::new(ShapeSpec::HalfSpace { normal: point(0.0, 1.0), offset: 0.0 });
    floor.kind = BodyKind::Static;
    scene.bodies.push(floor);
    scene.files.insert("channel.off".to_owned(), file);
    let channel = ShapeSpec::Mesh { file: "channel.off".to_owned() };
    scene.bodies.push(Body::new(channel).named("channel").at(point(0.0, 0.4)));
    let radius = 0.25;
    // Into the hollow, and towards its wall.
    let ball = Body::new(ShapeSpec::ball(radius)).named("ball").at(point(0.0, 2.0)).moving(point(0.6, 0.0));
    scene.bodies.push(ball);
    let mut world = AnyWorld::new(&scene, 1).expect("the channel can be built");
    let mut deepest: f64 = 0.0;
    while world.time() < 6.0 {
        world.step();
        deepest = deepest.max(world.measure_penetration());
    }
    let states = world.body_states();
    let (channel, ball) = (&states[1], &states[2]);
    let heights = (channel.position[1], ball.position[1]);
    println!(
        "{dimension}D: the channel lies at {:.4}, the ball in it at {:.4}; overlap {deepest:.1e} m",
        heights.0, heights.1
    );
    assert!(heights.0.abs() < 0.005, "{dimension}D: the channel lies at {}", heights.0);
    assert!((heights.1 - FLOOR_OF_HOLLOW - radius).abs() < 0.01, "{dimension}D: the ball lies at {}", heights.1);
    let inside = (ball.position[0] - channel.position[0]).abs();
    assert!(inside < 0.5 - radius + 0.005, "{dimension}D: the ball is {inside} m off the middle of the hollow");
    assert!(deepest < 0.02, "{dimension}D: overlap of {deepest} m");
    // The ball is free to roll from wall to wall.
    let speed = channel.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
    assert!(channel.sleeping || speed < 0.02, "{dimension}D: the channel moves at {speed} m/s");
}

#[test]
fn channels_from_files_lie_and_hold_a_ball() {
    a_channel_holds_a_ball(3, channel_3d());
    a_channel_holds_a_ball(4, channel_4d());
}
