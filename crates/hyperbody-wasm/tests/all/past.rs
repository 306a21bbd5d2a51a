//! The past: scrubbing shows it, resuming goes on from it, undo takes changes back.

use serde_json::json;

use crate::{answer, ask, numbers, refusal, report, selected, steps, with};

#[test]
fn scrubbing_shows_the_past_and_resuming_goes_on_from_it() {
    let mut playground = with("pyramid4d");
    steps(&mut playground, 30);
    let then = selected(&mut playground, 2)["position"].clone();
    let hash = answer(&mut playground, json!({ "type": "hash" }));
    steps(&mut playground, 60);
    let now = selected(&mut playground, 2)["position"].clone();
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 1.0 }));
    let told = report(&mut playground);
    assert_eq!(told["step"], 30);
    assert_eq!(told["history"]["secondsBack"], 1.0);
    assert_eq!(selected(&mut playground, 2)["position"], then);
    playground.step();
    assert_eq!(report(&mut playground)["step"], 30, "the past stands still");
    let refused = refusal(&mut playground, json!({ "type": "remove", "body": 2 }));
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("earlier moment")), "{refused}");
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 0.0 }));
    assert_eq!(selected(&mut playground, 2)["position"], now);
    assert_ne!(answer(&mut playground, json!({ "type": "hash" })), hash);
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 1.0 }));
    ask(&mut playground, json!({ "type": "resumeHere" }));
    let told = report(&mut playground);
    assert_eq!((told["step"].as_u64(), told["history"]["secondsBack"].as_f64()), (Some(30), Some(0.0)));
    assert_eq!(selected(&mut playground, 2)["position"], then);
    steps(&mut playground, 1);
    assert_eq!(report(&mut playground)["step"], 31);
}

#[test]
fn undo_brings_back_what_was_removed_and_takes_away_what_was_added() {
    let mut playground = with("dice4d");
    steps(&mut playground, 10);
    let before = selected(&mut playground, 4);
    answer(&mut playground, json!({ "type": "remove", "body": 4 }));
    assert!(selected(&mut playground, 4).is_null());
    let spawn =
        json!({ "type": "spawn", "shape": { "ball": { "radius": 0.3 } }, "position": [0, 9, 0, 0], "name": "new" });
    let new = answer(&mut playground, spawn)["body"].as_u64().unwrap_or(0) as u32;
    steps(&mut playground, 5);
    assert_eq!(selected(&mut playground, new)["name"], "new");
    assert_eq!(answer(&mut playground, json!({ "type": "undo" }))["undone"], "spawn");
    assert!(selected(&mut playground, new).is_null());
    assert_eq!(answer(&mut playground, json!({ "type": "undo" }))["undone"], "remove");
    let after = selected(&mut playground, 4);
    assert_eq!(after["position"], before["position"]);
    assert_eq!(after["rotation"], before["rotation"]);
    let (v, w) = (numbers(&before["velocity"]), numbers(&after["velocity"]));
    assert!(v.iter().zip(&w).all(|(a, b)| (a - b).abs() < 1e-12));
    assert!(answer(&mut playground, json!({ "type": "undo" }))["undone"].is_null());
    steps(&mut playground, 5);
}

#[test]
fn joints_come_back_with_their_bodies() {
    let mut playground = with("pendulum4d");
    steps(&mut playground, 20);
    let text = |playground: &mut hyperbody_wasm::Playground| {
        answer(playground, json!({ "type": "sceneText" }))["text"].as_str().unwrap_or("").to_owned()
    };
    let joints = text(&mut playground).matches("\"ball\": {\"a\"").count();
    let reply = ask(&mut playground, json!({ "type": "remove", "body": 1 }));
    assert!(reply["scene"]["bodies"].is_array(), "{reply}");
    answer(&mut playground, json!({ "type": "undo" }));
    assert_eq!(text(&mut playground).matches("\"ball\": {\"a\"").count(), joints);
    steps(&mut playground, 20);
}

#[test]
fn panels_tell_of_the_moment_that_is_shown_alone() {
    let mut playground = with("tumble4d");
    let ids = 0..4;
    let tell = |playground: &mut hyperbody_wasm::Playground| {
        let bodies: Vec<_> = ids.clone().map(|id| selected(playground, id)).collect();
        let told = report(playground);
        (bodies, told["energy"].clone(), told["time"].clone())
    };
    ask(&mut playground, json!({ "type": "gravity", "vector": [0.0, -3.0, 0.0, 1.0] }));
    steps(&mut playground, 20);
    let then = tell(&mut playground);
    steps(&mut playground, 60);
    assert_ne!(tell(&mut playground).1, then.1, "the world falls");
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 1.0 }));
    assert_eq!(tell(&mut playground), then);
}
