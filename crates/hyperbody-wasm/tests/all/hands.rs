//! Hands: what is held follows, turns, and flies when let go.

use hyperbody_wasm::Playground;
use serde_json::json;

use crate::{answer, ask, numbers, refusal, report, selected, steps, with, with_bodies};

#[test]
fn a_held_body_follows_in_every_dimension_and_keeps_its_motion() {
    for dimension in 2..=6 {
        let mut playground = with_bodies(dimension, json!([{ "name": "a", "shape": { "ball": { "radius": 0.5 } } }]));
        let mut target = vec![0.0; dimension];
        answer(&mut playground, json!({ "type": "grab", "hand": 0, "body": 0, "point": target }));
        for step in 1..=60 {
            target[dimension - 1] = f64::from(step) / 60.0;
            ask(&mut playground, json!({ "type": "moveHand", "hand": 0, "point": target }));
            playground.step();
        }
        let held = report(&mut playground)["hands"].clone();
        assert_eq!(held[0]["body"], 0);
        let told = selected(&mut playground, 0);
        let (position, velocity) = (numbers(&told["position"]), numbers(&told["velocity"]));
        assert!((position[dimension - 1] - 1.0).abs() < 0.15, "{dimension}D: at {position:?}");
        assert!((velocity[dimension - 1] - 1.0).abs() < 0.1, "{dimension}D: moves by {velocity:?}");
        ask(&mut playground, json!({ "type": "release", "hand": 0 }));
        steps(&mut playground, 60);
        let told = selected(&mut playground, 0);
        let after = numbers(&told["position"]);
        assert!((after[dimension - 1] - position[dimension - 1] - velocity[dimension - 1]).abs() < 1e-6, "{after:?}");
    }
}

#[test]
fn a_hand_that_turns_turns_the_body_by_its_own_change() {
    let mut playground = with_bodies(4, json!([{ "shape": { "box": { "half_extents": [0.5, 0.4, 0.3, 0.2] } } }]));
    answer(&mut playground, json!({ "type": "grab", "hand": 1, "body": 0, "point": [0.0, 0.0, 0.0, 0.0] }));
    let attitude = |angle: f64| {
        let (s, c) = angle.sin_cos();
        // In the plane xw, from x towards w.
        json!([[c, 0.0, 0.0, -s], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [s, 0.0, 0.0, c]])
    };
    for step in 0..=90 {
        let angle = 1.0 + f64::from(step.min(60)) / 60.0 * 0.7;
        let message = json!({ "type": "moveHand", "hand": 1, "point": [0, 0, 0, 0], "rotation": attitude(angle) });
        ask(&mut playground, message);
        playground.step();
    }
    let rotation = selected(&mut playground, 0)["rotation"].clone();
    let angle = numbers(&rotation[3])[0].atan2(numbers(&rotation[0])[0]);
    assert!((angle - 0.7).abs() < 0.02, "turned by {angle}");
}

#[test]
fn rays_find_what_they_meet_and_refuse_what_cannot_be_held() {
    let mut playground = with("stack4d");
    let down = json!({ "type": "pick", "origin": [0.0, 20.0, 0.0], "direction": [0.0, -1.0, 0.0] });
    let hit = answer(&mut playground, down);
    assert!(hit["body"].as_u64().is_some_and(|body| body > 0), "{hit}");
    assert!(
        answer(&mut playground, json!({ "type": "pick", "origin": [0.0, 20.0, 0.0], "direction": [0.0, 1.0, 0.0] }))
            .is_null()
    );
    let ground = json!({ "type": "grab", "hand": 0, "origin": [50.0, 5.0, 0.0], "direction": [0.0, -1.0, 0.0] });
    let refused = refusal(&mut playground, ground);
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("cannot be moved")), "{refused}");
    let top = json!({ "type": "grab", "hand": 0, "origin": [0.1, 20.0, 0.1], "direction": [0.0, -1.0, 0.0] });
    let held = answer(&mut playground, top.clone());
    assert_eq!(held["body"], hit["body"]);
    // The same hand again: it lets go first.
    answer(&mut playground, top);
    assert_eq!(report(&mut playground)["hands"].as_array().map(Vec::len), Some(1));
}

#[test]
fn what_a_hand_lets_fall_is_told_as_an_impact_once() {
    let scene = json!([
        { "name": "ground", "kind": "static", "shape": { "half_space": { "normal": [0, 1, 0, 0], "offset": 0 } } },
        { "name": "a", "shape": { "ball": { "radius": 0.5 } }, "position": [0, 0.52, 0, 0], "velocity": [0, -3, 0, 0] }
    ]);
    let mut playground = with_bodies(4, scene);
    let mut found = Vec::new();
    for _ in 0..30 {
        playground.step();
        found.extend(report(&mut playground)["impacts"].as_array().cloned().unwrap_or_default());
    }
    assert_eq!(found.len(), 1, "{found:?}");
    let mass = selected(&mut playground, 1)["mass"].as_f64().unwrap_or(0.0);
    let impulse = found[0]["impulse"].as_f64().unwrap_or(0.0);
    assert!((impulse / (3.0 * mass) - 1.0).abs() < 0.1, "{impulse} N·s stop {mass} kg at 3 m/s");
}

/// Three balls side by side, three metres apart, and where a hand takes hold of each.
fn three_balls() -> (Playground, impl Fn(&mut Playground, u32)) {
    let ball = |x: i32| json!({ "shape": { "ball": { "radius": 0.5 } }, "position": [x, 0, 0, 0] });
    let playground = with_bodies(4, json!([ball(-3), ball(0), ball(3)]));
    let grab = |playground: &mut Playground, body: u32| {
        let x = 3 * (body as i32 - 1);
        let message = json!({ "type": "grab", "hand": 10 + body, "body": body, "point": [x, 0, 0, 0] });
        answer(playground, message);
    };
    (playground, grab)
}

fn held(playground: &mut Playground) -> Vec<u64> {
    let told = report(playground)["hands"].clone();
    told.as_array().into_iter().flatten().filter_map(|hand| hand["body"].as_u64()).collect()
}

#[test]
fn freezing_and_undo_open_the_hands_that_they_concern_and_no_others() {
    let (mut playground, grab) = three_balls();
    grab(&mut playground, 0);
    steps(&mut playground, 2);
    grab(&mut playground, 1);
    steps(&mut playground, 2);
    answer(&mut playground, json!({ "type": "freeze", "body": 2, "on": true }));
    assert_eq!(held(&mut playground), [0, 1], "a third body was frozen");
    // They still pull: the world that freezing made is another one.
    ask(&mut playground, json!({ "type": "moveHand", "hand": 10, "point": [-3, 1, 0, 0] }));
    steps(&mut playground, 60);
    assert!((numbers(&selected(&mut playground, 0)["position"])[1] - 1.0).abs() < 0.05);
    assert_eq!(answer(&mut playground, json!({ "type": "undo" }))["undone"], "freeze");
    assert_eq!(held(&mut playground), [0, 1]);
    // Back to before the second grab: only the first hand held something then.
    assert_eq!(answer(&mut playground, json!({ "type": "undo" }))["undone"], "grab");
    assert_eq!(held(&mut playground), [0]);
    answer(&mut playground, json!({ "type": "freeze", "body": 0, "on": true }));
    assert_eq!(held(&mut playground), [0_u64; 0]);
}

#[test]
fn what_is_held_tells_of_its_impacts_among_many_stronger_ones() {
    let mut bodies = vec![
        json!({ "kind": "static", "shape": { "half_space": { "normal": [0, 1, 0, 0], "offset": 0 } } }),
        json!({ "shape": { "ball": { "radius": 0.5 } }, "position": [0, 0.52, 0, 0], "velocity": [0, -1.5, 0, 0] }),
    ];
    bodies.extend((1..=60).map(|k| {
        let shape = json!({ "ball": { "radius": 0.5 } });
        json!({ "shape": shape, "position": [2 * k, 0.52, 0, 0], "velocity": [0, -9, 0, 0], "mass": 50 })
    }));
    let mut playground = with_bodies(4, json!(bodies));
    answer(&mut playground, json!({ "type": "grab", "hand": 7, "body": 1, "point": [0, 0.52, 0, 0] }));
    ask(&mut playground, json!({ "type": "moveHand", "hand": 7, "point": [0, 0.3, 0, 0] }));
    steps(&mut playground, 4);
    let told = report(&mut playground)["impacts"].clone();
    let of_held = told.as_array().into_iter().flatten().filter(|impact| impact["hands"] == json!([7])).count();
    assert_eq!(of_held, 1, "{told}");
}
