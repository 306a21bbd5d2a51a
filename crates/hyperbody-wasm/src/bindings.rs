//! The playground as JavaScript sees it: text in and out, and addresses of arrays.

use wasm_bindgen::prelude::wasm_bindgen;

use crate::Playground;

/// A world for a worker. See web/src/engine/protocol.ts for the messages.
#[wasm_bindgen]
#[derive(Default)]
pub struct Engine(Playground);

#[wasm_bindgen]
impl Engine {
    /// One without a scene.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The version of the engine.
    #[must_use]
    pub fn version() -> String {
        env!("CARGO_PKG_VERSION").to_owned()
    }

    /// The built-in scenes, as JSON.
    #[must_use]
    pub fn builtins() -> String {
        Playground::builtins().to_string()
    }

    /// Obeys a message in JSON; the reply, in JSON, has `answer`, `refused`, `scene` and `loaded`.
    pub fn handle(&mut self, message: &str) -> String {
        self.0.handle_text(message)
    }

    /// One step.
    pub fn step(&mut self) {
        self.0.step();
    }

    /// Cuts everything with the slice, and returns address and length of each array of the frame; they are good until the
    /// next call of anything.
    pub fn draw(&mut self) -> Vec<usize> {
        self.0.draw();
        self.0.buffers().layout()
    }

    /// What the frame tells beside its arrays, as JSON; "null" without a scene.
    pub fn report(&mut self) -> String {
        serde_json::to_string(&self.0.report()).unwrap_or_default()
    }

    /// The file that the last export made.
    #[must_use]
    pub fn file(&self) -> Vec<u8> {
        self.0.file().to_vec()
    }
}
