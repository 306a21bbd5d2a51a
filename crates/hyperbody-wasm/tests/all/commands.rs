//! Freeze, turn, gravity, and values that make no sense.

use serde_json::json;

use crate::{answer, ask, numbers, refusal, report, selected, steps, with, with_bodies};

#[test]
fn frozen_bodies_stay_and_thawed_ones_fall() {
    let mut playground = with_bodies(4, json!([{ "shape": { "ball": { "radius": 0.5 } }, "position": [0, 5, 0, 0] }]));
    ask(&mut playground, json!({ "type": "gravity", "vector": [0, -9.81, 0, 0] }));
    answer(&mut playground, json!({ "type": "freeze", "body": 0, "on": true }));
    steps(&mut playground, 60);
    let told = selected(&mut playground, 0);
    assert!((numbers(&told["position"])[1] - 5.0).abs() < 0.01, "{told}");
    assert_eq!(told["frozen"], true);
    answer(&mut playground, json!({ "type": "freeze", "body": 0, "on": false }));
    steps(&mut playground, 60);
    let height = numbers(&selected(&mut playground, 0)["position"])[1];
    assert!((height - (5.0 - 0.5 * 9.81)).abs() < 0.15, "{height}");
}

#[test]
fn turns_are_about_the_centre_and_both_ways_of_saying_a_plane_agree() {
    for dimension in 2..=6 {
        let half: Vec<f64> = (0..dimension).map(|i| 0.3 + 0.1 * i as f64).collect();
        let body = json!([{ "shape": { "box": { "half_extents": half } } }]);
        let (mut by_name, mut by_directions) = (with_bodies(dimension, body.clone()), with_bodies(dimension, body));
        let plane = ["xy", "xz", "xw", "xv", "xu"][dimension - 2];
        let unit = |k: usize| (0..dimension).map(|i| if i == k { 2.0 } else { 0.0 }).collect::<Vec<_>>();
        answer(&mut by_name, json!({ "type": "turn", "body": 0, "plane": plane, "angle": 0.3 }));
        let directions = [unit(0), unit(dimension - 1)];
        answer(&mut by_directions, json!({ "type": "turn", "body": 0, "plane": directions, "angle": 0.3 }));
        let (a, b) = (selected(&mut by_name, 0), selected(&mut by_directions, 0));
        for row in 0..dimension {
            let (a, b) = (numbers(&a["rotation"][row]), numbers(&b["rotation"][row]));
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12), "{dimension}D: {a:?} and {b:?}");
        }
        let row = numbers(&a["rotation"][dimension - 1]);
        assert!((row[0] - 0.3_f64.sin()).abs() < 1e-12, "x turns towards the last axis");
        assert!(numbers(&a["position"]).iter().all(|c| c.abs() < 1e-12));
        assert_eq!(a["rotor"].as_array().map(Vec::len), Some(1 << (dimension - 1)));
    }
}

#[test]
fn nonsense_is_refused_with_a_reason_and_changes_nothing() {
    let mut playground = with("stack4d");
    let hash = answer(&mut playground, json!({ "type": "hash" }));
    for message in [
        json!({ "type": "remove", "body": 99 }),
        json!({ "type": "turn", "body": 1, "plane": "xq", "angle": 1.0 }),
        json!({ "type": "turn", "body": 1, "plane": [[1, 0, 0, 0], [2, 0, 0, 0]], "angle": 1.0 }),
        json!({ "type": "spawn", "shape": { "ball": { "radius": -1 } }, "position": [0, 0, 0, 0] }),
        json!({ "type": "spawn", "shape": { "bal": { "radius": 1 } }, "position": [0, 0, 0, 0] }),
        json!({ "type": "spawn", "shape": { "ball": { "radius": 1 } }, "position": [0, 0] }),
        json!({ "type": "grab", "hand": 0 }),
        json!({ "type": "grab", "hand": 0, "body": 1, "point": [0] }),
        json!({ "type": "pick", "origin": [0], "direction": [1, 0, 0] }),
        json!({ "type": "freeze", "body": 0, "on": true }),
        json!({ "type": "gravity", "vector": [1, 2] }),
    ] {
        let refused = refusal(&mut playground, message.clone());
        assert!(refused["message"].as_str().is_some_and(|m| m.len() > 10), "{message}: {refused}");
    }
    // Slices that make no frame leave the one that is.
    let before = report(&mut playground)["slice"].clone();
    for axes in
        [json!([[1, 0, 0, 0]]), json!([[1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]]), json!([[0, 0], [1, 1], [0, 1]])]
    {
        ask(&mut playground, json!({ "type": "slice", "origin": [0, 0, 0, 0], "axes": axes }));
        assert_eq!(report(&mut playground)["slice"], before);
    }
    assert_eq!(answer(&mut playground, json!({ "type": "hash" })), hash);
}

#[test]
fn names_of_new_bodies_are_free_ones() {
    let mut playground = with("stack4d");
    for _ in 0..3 {
        let spawn = json!({ "type": "spawn", "shape": { "ball": { "radius": 0.2 } }, "position": [5, 5, 0, 0] });
        answer(&mut playground, spawn);
    }
    let text = answer(&mut playground, json!({ "type": "sceneText" }))["text"].clone();
    assert_eq!(ask(&mut playground, json!({ "type": "load", "text": text }))["loaded"], true);
}

#[test]
fn the_off_direction_is_right_handed_and_smooth() {
    let mut playground = with("stack5d");
    let mut last: Option<Vec<f64>> = None;
    for step in 0..=90 {
        let angle = f64::from(step).to_radians();
        let axes = json!([[1, 0, 0, 0, 0], [0, 1, 0, 0, 0], [0, 0, angle.cos(), angle.sin(), 0]]);
        ask(&mut playground, json!({ "type": "slice", "origin": [0, 0, 0, 0, 0], "axes": axes }));
        let off = numbers(&report(&mut playground)["slice"]["off"][0]);
        if let Some(last) = &last {
            let turned: f64 = off.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            assert!(turned < 0.02, "the off direction jumps by {turned} at {step}°");
        }
        last = Some(off);
    }
    let mut four = with("stack4d");
    ask(
        &mut four,
        json!({ "type": "slice", "origin": [0, 0, 0, 0], "axes": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]] }),
    );
    assert_eq!(numbers(&report(&mut four)["slice"]["off"][0]), [0.0, 0.0, -1.0, 0.0]);
}

#[test]
fn refusals_that_a_page_has_words_for_carry_their_code() {
    let mut playground = with("stack4d");
    let code = |playground: &mut _, message| refusal(playground, message)["code"].as_str().map(str::to_owned);
    let mut expect = |message, wanted: &str| assert_eq!(code(&mut playground, message).as_deref(), Some(wanted));
    expect(json!({ "type": "remove", "body": 99 }), "gone");
    expect(json!({ "type": "freeze", "body": 0, "on": true }), "immovable");
    expect(json!({ "type": "grab", "hand": 0, "body": 0, "point": [0, 0, 0, 0] }), "immovable");
    answer(&mut playground, json!({ "type": "freeze", "body": 1, "on": true }));
    let grab = json!({ "type": "grab", "hand": 0, "body": 1, "point": [0, 0.5, 0, 0] });
    assert_eq!(refusal(&mut playground, grab)["code"], "frozen");
    ask(
        &mut playground,
        json!({ "type": "slice", "origin": [0, 0, 0, 50], "axes": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]] }),
    );
    assert_eq!(refusal(&mut playground, json!({ "type": "export", "format": "stl" }))["code"], "nothing");
    steps(&mut playground, 5);
    ask(&mut playground, json!({ "type": "scrub", "secondsBack": 0.05 }));
    assert_eq!(refusal(&mut playground, json!({ "type": "remove", "body": 1 }))["code"], "past");
}

#[test]
fn bodies_that_were_removed_make_room_for_others() {
    let mut playground = with_bodies(2, json!([{ "shape": { "ball": { "radius": 0.5 } } }]));
    let spawn = json!({ "type": "spawn", "shape": { "ball": { "radius": 0.1 } }, "position": [9, 9] });
    // More in all than may be there at once.
    for _ in 0..4200 {
        let body = answer(&mut playground, spawn.clone())["body"].clone();
        answer(&mut playground, json!({ "type": "remove", "body": body }));
    }
}
