//! What is drawn of joints: marks at anchors, rods to bodies that lie apart.

use hyperbody_wasm::Playground;
use serde_json::{Value, json};

use crate::{ask, steps, with};

/// A playground with a scene of these bodies and joints, without gravity.
fn with_joints(dimension: usize, bodies: Value, joints: Value) -> Playground {
    let scene = json!({
        "format": "hyperbody-scene", "version": 1, "name": "test", "dimension": dimension,
        "gravity": vec![0.0; dimension], "bodies": bodies, "joints": joints,
    });
    let mut playground = Playground::new();
    let reply = ask(&mut playground, json!({ "type": "load", "text": scene.to_string() }));
    assert_eq!(reply["loaded"], true, "{reply}");
    playground
}

/// Rods and marks of the present: each end and each mark is where it is drawn, and how far off the slice.
fn drawn(playground: &mut Playground) -> (Vec<[[f32; 4]; 2]>, Vec<[f32; 4]>) {
    playground.draw();
    let four = |numbers: &[f32]| -> [f32; 4] { std::array::from_fn(|k| numbers[k]) };
    let rods = playground.buffers().joint_rods.chunks_exact(8).map(|rod| [four(&rod[..4]), four(&rod[4..])]).collect();
    (rods, playground.buffers().joint_marks.chunks_exact(4).map(four).collect())
}

fn near(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

fn ball(name: &str, position: [f64; 4]) -> Value {
    json!({ "name": name, "shape": { "ball": { "radius": 0.5 } }, "position": position })
}

#[test]
fn a_rod_leads_from_an_anchor_that_lies_apart_to_the_surface_of_its_body() {
    let joint = json!([{ "ball": { "b": "bob", "anchor_a": [0, 3, 0, 0.25], "anchor_b": [0, 2, 0, 0.25] } }]);
    let mut playground = with_joints(4, json!([ball("bob", [0.0, 1.0, 0.0, 0.0])]), joint);
    let (rods, marks) = drawn(&mut playground);
    assert_eq!(
        (rods.len(), marks.len()),
        (1, 1),
        "one rod, and one mark for anchors that coincide: {rods:?} {marks:?}"
    );
    assert!(near(marks[0], [0.0, 3.0, 0.0, 0.25]), "{marks:?}");
    let [from, foot] = rods[0];
    assert!(near(from, marks[0]), "{rods:?}");
    // The foot lies half a metre from the middle, in world and slice alike: the slice is at home.
    let length = (foot[0].powi(2) + (foot[1] - 1.0).powi(2) + foot[2].powi(2) + foot[3].powi(2)).sqrt();
    assert!((length - 0.5).abs() < 1e-6, "{rods:?}");
}

#[test]
fn rods_follow_their_bodies_and_the_slice() {
    let joint = json!([{ "ball": { "b": "bob", "anchor_a": [0, 3, 0, 0], "anchor_b": [0, 2, 0, 0] } }]);
    let mut bob = ball("bob", [0.0, 1.0, 0.0, 0.0]);
    bob["velocity"] = json!([0, 0, 0, 1.0]);
    let mut playground = with_joints(4, json!([bob]), joint);
    steps(&mut playground, 60);
    let (rods, marks) = drawn(&mut playground);
    assert!(rods[0][1][3] > 0.1, "the foot has left along w: {rods:?}");
    assert!(marks[0][3].abs() < 1e-3, "the anchor has not: {marks:?}");
    let slice =
        json!({ "type": "slice", "origin": [0, 1, 0, -0.5], "axes": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] });
    ask(&mut playground, slice);
    let (_, marks) = drawn(&mut playground);
    assert!((marks[0][1] - 2.0).abs() < 1e-3 && (marks[0][3] - 0.5).abs() < 1e-3, "{marks:?}");
    // Of an earlier moment, the rods of that moment.
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 1.0 }));
    let (rods, _) = drawn(&mut playground);
    assert!((rods[0][1][3] - 0.5).abs() < 1e-3, "{rods:?}");
}

#[test]
fn what_holds_a_distance_is_a_rod_what_touches_leads_inside_and_what_only_turns_is_not_drawn() {
    let bodies = || {
        json!([
            ball("left", [-1.0, 0.0, 0.0, 0.0]),
            ball("right", [1.0, 0.0, 0.0, 0.0]),
            { "name": "floor", "kind": "static", "shape": { "half_space": { "normal": [0, 1, 0, 0], "offset": -2 } } },
        ])
    };
    let rope = json!({ "rope": { "a": "left", "b": "right", "length": 2.0 } });
    let (rods, marks) = drawn(&mut with_joints(4, bodies(), json!([rope])));
    assert_eq!((rods.len(), marks.len()), (1, 2), "{rods:?} {marks:?}");
    assert!(near(rods[0][0], [-1.0, 0.0, 0.0, 0.0]) && near(rods[0][1], [1.0, 0.0, 0.0, 0.0]), "{rods:?}");
    let gear = json!({ "gear": { "a": "left", "b": "right", "plane": "xy", "teeth": [10, 10] } });
    let motor = json!({ "motor": { "b": "left", "plane": "xy", "speed": 1.0, "max_force": 1.0 } });
    let (rods, marks) = drawn(&mut with_joints(4, bodies(), json!([gear, motor])));
    assert_eq!((rods.len(), marks.len()), (0, 0), "{rods:?} {marks:?}");
    // On the surface of the left ball, which it leads into, and apart from the right one, whose surface it leads to; in the
    // middle of a body, and along the floor, there is a mark alone.
    let touching = json!([
        { "ball": { "a": "left", "b": "right", "anchor_a": [0.5, 0, 0, 0], "anchor_b": [-1.5, 0, 0, 0] } },
        { "ball": { "a": "floor", "b": "left", "anchor_a": [-1, 0, 0, 0], "anchor_b": [0, 0, 0, 0] } },
    ]);
    let (rods, marks) = drawn(&mut with_joints(4, bodies(), touching));
    assert_eq!((rods.len(), marks.len()), (2, 2), "{rods:?} {marks:?}");
    assert!(near(rods[0][0], [-0.5, 0.0, 0.0, 0.0]) && near(rods[0][1], [-1.0, 0.0, 0.0, 0.0]), "{rods:?}");
    assert!(near(rods[1][0], [-0.5, 0.0, 0.0, 0.0]) && near(rods[1][1], [0.5, 0.0, 0.0, 0.0]), "{rods:?}");
}

#[test]
fn joints_go_with_their_bodies_and_come_back_with_them() {
    let mut playground = with("pendulum4d");
    let (rods, marks) = drawn(&mut playground);
    assert_eq!((rods.len(), marks.len()), (3, 2), "the hook, which is fixed, has none: {rods:?} {marks:?}");
    ask(&mut playground, json!({ "type": "remove", "body": 2 }));
    assert_eq!(drawn(&mut playground).1.len(), 1);
    ask(&mut playground, json!({ "type": "undo" }));
    assert_eq!(drawn(&mut playground).1.len(), 2);
    // A gyroscope hangs by the end of a stem that is no body.
    assert_eq!(drawn(&mut with("gyroscope3d")).0.len(), 1);
}
