//! The playground's engine, natively: messages in, replies and arrays out, as the page sees them.

mod commands;
mod hands;
mod joints;
mod past;
mod scenes;
mod sections;

use hyperbody_wasm::{Playground, Reply};
use serde_json::{Value, json};

/// A playground with a built-in scene.
fn with(name: &str) -> Playground {
    let mut playground = Playground::new();
    let reply = ask(&mut playground, json!({ "type": "loadBuiltin", "name": name }));
    assert_eq!(reply["loaded"], true, "{reply}");
    playground
}

/// A playground with a scene of these bodies, without gravity.
fn with_bodies(dimension: usize, bodies: Value) -> Playground {
    let scene = json!({
        "format": "hyperbody-scene", "version": 1, "name": "test", "dimension": dimension,
        "gravity": vec![0.0; dimension], "bodies": bodies,
    });
    let mut playground = Playground::new();
    let reply = ask(&mut playground, json!({ "type": "load", "text": scene.to_string() }));
    assert_eq!(reply["loaded"], true, "{reply}");
    playground
}

/// Sends a message as the worker does.
fn ask(playground: &mut Playground, message: Value) -> Value {
    let text = playground.handle_text(&message.to_string());
    serde_json::from_str(&text).expect("replies are JSON")
}

/// The answer to a message that must not be refused.
fn answer(playground: &mut Playground, message: Value) -> Value {
    let reply = ask(playground, message.clone());
    assert!(reply.get("refused").is_none(), "{message} was refused: {reply}");
    reply["answer"].clone()
}

/// The refusal of a message.
fn refusal(playground: &mut Playground, message: Value) -> Value {
    let reply = ask(playground, message.clone());
    assert!(reply.get("refused").is_some(), "{message} was obeyed: {reply}");
    reply["refused"].clone()
}

/// The report of the frame, as JSON.
fn report(playground: &mut Playground) -> Value {
    serde_json::to_value(playground.report()).expect("reports are JSON")
}

/// What the panel tells of a body.
fn selected(playground: &mut Playground, body: u32) -> Value {
    ask(playground, json!({ "type": "select", "body": body }));
    report(playground)["selected"].clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("numbers")).collect()
}

fn steps(playground: &mut Playground, count: usize) {
    (0..count).for_each(|_| playground.step());
}

#[test]
fn a_playground_without_a_scene_refuses_and_draws_nothing() {
    let mut playground = Playground::new();
    playground.step();
    playground.draw();
    assert!(playground.buffers().surface_positions.is_empty());
    assert!(playground.report().is_none());
    let refused = refusal(&mut playground, json!({ "type": "undo" }));
    assert_eq!(refused["message"], "no scene is loaded");
    let reply: Reply = Playground::new().handle(hyperbody_wasm::Message::Reset {});
    assert!(reply.refused.is_some());
    let nonsense = playground.handle_text("{\"type\":\"dance\"}");
    assert!(nonsense.contains("does not understand"), "{nonsense}");
}
