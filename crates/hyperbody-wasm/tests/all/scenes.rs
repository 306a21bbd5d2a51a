//! Loading: every built-in scene runs, and broken text names its line.

use hyperbody_scene::{AnyWorld, BUILT_IN, built_in};
use hyperbody_wasm::Playground;
use serde_json::json;

use crate::{answer, ask, numbers, refusal, report, selected, steps, with};

#[test]
fn built_in_scenes_run_to_the_bit_as_the_program_runs_them() {
    for name in ["pyramid2d", "ramp3d", "dice4d", "capsules4d", "stack5d"] {
        let mut playground = with(name);
        let mut world = AnyWorld::new(&built_in(name).expect("there is one"), 1).expect("it is sound");
        for _ in 0..60 {
            playground.step();
            world.step();
            if world.step_count().is_multiple_of(10) {
                // To look must not change anything.
                playground.draw();
                playground.report();
            }
        }
        let told = answer(&mut playground, json!({ "type": "hash" }));
        assert_eq!(told["hash"], format!("{:016x}", world.state_hash()), "{name}");
        assert_eq!(told["step"], 60);
    }
}

#[test]
fn every_built_in_scene_is_drawn() {
    let told = Playground::builtins();
    assert_eq!(told.as_array().map(Vec::len), Some(BUILT_IN.len()));
    for scene in BUILT_IN {
        let mut playground = with(scene.name);
        ask(&mut playground, json!({ "type": "ghosts", "on": true, "reach": 2.0 }));
        ask(&mut playground, json!({ "type": "wires", "on": true }));
        steps(&mut playground, 5);
        playground.draw();
        let drawn = playground.buffers();
        let nothing = drawn.surface_positions.is_empty() && drawn.ghost_positions.is_empty();
        assert!(!nothing, "{}: neither a section nor a ghost near the home slice", scene.name);
        assert_eq!(drawn.surface_positions.len(), drawn.surface_normals.len());
        assert_eq!(drawn.surface_positions.len(), 3 * drawn.surface_cells.len());
        let sound = |list: &[f32]| list.iter().all(|number| number.is_finite());
        assert!(sound(&drawn.surface_positions) && sound(&drawn.ghost_positions) && sound(&drawn.wire_positions));
        for normal in drawn.surface_normals.chunks_exact(3) {
            let length: f32 = normal.iter().map(|c| c * c).sum();
            assert!((length - 1.0).abs() < 1e-4, "{}: a normal of squared length {length}", scene.name);
        }
        let counts: u32 = drawn.surface_ranges.chunks_exact(3).map(|range| range[2]).sum();
        assert_eq!(counts as usize, drawn.surface_cells.len(), "ranges cover all corners");
        assert_eq!(drawn.wire_off.len() * 3, drawn.wire_positions.len());
    }
}

#[test]
fn errors_name_the_line_and_the_running_scene_goes_on() {
    let mut playground = with("stack4d");
    steps(&mut playground, 3);
    let text = "{\n \"format\": \"hyperbody-scene\", \"version\": 1,\n \"dimension\": 4,\n \"bodies\": [\n  {\"shape\": {\"ball\": {\"radius\": 1}}},\n  {\"shape\":\n    {\"ball\": {\"radius\": -1}}}\n ]\n}";
    let refused = refusal(&mut playground, json!({ "type": "load", "text": text }));
    assert_eq!(refused["line"], 7, "{refused}");
    let broken = text.replace("\"dimension\": 4,", "\"dimension\": 4,,");
    let refused = refusal(&mut playground, json!({ "type": "load", "text": broken }));
    assert_eq!(refused["line"], 3, "{refused}");
    let unknown = text.replace("\"dimension\"", "\"dimensoin\"");
    let refused = refusal(&mut playground, json!({ "type": "load", "text": unknown }));
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("dimension")), "{refused}");
    assert_eq!(refused["line"], 3, "{refused}");
    // Also where the key stands in the middle of an object that begins lines before.
    let deep = text.replace("\n    {\"ball\"", "\n    {\"bal\"");
    let refused = refusal(&mut playground, json!({ "type": "load", "text": deep }));
    assert_eq!(refused["line"], 7, "{refused}");
    let nine = text.replace("4", "9");
    let refused = refusal(&mut playground, json!({ "type": "load", "text": nine }));
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("dimension")), "{refused}");
    assert_eq!(report(&mut playground)["step"], 3);
    let refused = refusal(&mut playground, json!({ "type": "loadBuiltin", "name": "stak4d" }));
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("stack4d")), "{refused}");
}

#[test]
fn the_running_scene_as_text_goes_on_from_there() {
    let mut playground = with("dice4d");
    steps(&mut playground, 20);
    let text = answer(&mut playground, json!({ "type": "sceneText" }))["text"].clone();
    let before = numbers(&selected(&mut playground, 3)["position"]);
    let mut copy = Playground::new();
    let reply = ask(&mut copy, json!({ "type": "load", "text": text }));
    assert_eq!(reply["loaded"], true, "{reply}");
    let after = numbers(&selected(&mut copy, 3)["position"]);
    for (a, b) in before.iter().zip(&after) {
        assert!((a - b).abs() < 1e-12, "{before:?} and {after:?}");
    }
    answer(&mut playground, json!({ "type": "reset" }));
    assert_eq!(report(&mut playground)["step"], 0);
}
