//! What a page may ask, and what it is told: the Rust side of web/src/engine/protocol.ts, where every message is described.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A message of the page. Its `id`, if it has one, is the worker's business.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "type", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum Message {
    /// Replaces the scene.
    Load {
        /// Scene JSON.
        text: String,
    },
    /// Replaces the scene by one that is built in.
    LoadBuiltin {
        /// Which.
        name: String,
    },
    /// The scene as it was loaded.
    Reset {},
    /// Takes back the last change.
    Undo {},
    /// What a ray in the slice meets.
    Pick {
        /// Slice point.
        origin: Vec<f64>,
        /// Slice direction.
        direction: Vec<f64>,
    },
    /// Takes hold of a body.
    Grab {
        /// Which hand.
        hand: u32,
        /// Body and point in the world, or …
        body: Option<u32>,
        /// See `body`.
        point: Option<Vec<f64>>,
        /// … a ray in the slice.
        origin: Option<Vec<f64>>,
        /// See `origin`.
        direction: Option<Vec<f64>>,
    },
    /// Adds a body.
    Spawn {
        /// As in the scene format.
        shape: Value,
        /// In the world, m.
        position: Vec<f64>,
        /// m/s.
        velocity: Option<Vec<f64>>,
        /// Made different from other names.
        name: Option<String>,
        /// Dynamic unless given.
        kind: Option<Kind>,
    },
    /// Removes a body.
    Remove {
        /// Which.
        body: u32,
    },
    /// Makes a body immovable, or lets it move.
    Freeze {
        /// Which.
        body: u32,
        /// Whether it is to be held.
        on: bool,
    },
    /// Turns a body about its centre.
    Turn {
        /// Which.
        body: u32,
        /// In which plane.
        plane: Plane,
        /// rad.
        angle: f64,
    },
    /// The slice as a file.
    Export {
        /// "stl" or "glb".
        format: Format,
    },
    /// The running scene as text.
    SceneText {},
    /// The state hash.
    Hash {},
    /// What is drawn.
    Slice {
        /// Of the world.
        origin: Vec<f64>,
        /// Of the world.
        axes: Vec<Vec<f64>>,
        /// Of the world.
        off: Option<Vec<Vec<f64>>>,
    },
    /// Whether ghosts are drawn, and how far off the slice, m.
    Ghosts {
        /// Whether.
        on: bool,
        /// m.
        reach: f64,
    },
    /// Whether wireframes are drawn.
    Wires {
        /// Whether.
        on: bool,
    },
    /// Shows an earlier moment.
    Scrub {
        /// s.
        seconds_back: f64,
    },
    /// Goes on from the moment that is shown.
    ResumeHere {},
    /// Sets gravity, m/s².
    Gravity {
        /// In the world.
        vector: Vec<f64>,
    },
    /// Where a hand is.
    MoveHand {
        /// Which.
        hand: u32,
        /// In the world, m.
        point: Vec<f64>,
        /// Rows of the hand's attitude.
        rotation: Option<Vec<Vec<f64>>>,
        /// Angles to turn by.
        planes: Option<std::collections::BTreeMap<String, f64>>,
    },
    /// Lets go.
    Release {
        /// Which.
        hand: u32,
    },
    /// The body that frames tell of.
    Select {
        /// Which, if any.
        body: Option<u32>,
    },
}

/// How a body takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Kind {
    /// Moved by forces.
    Dynamic,
    /// Never moves.
    Static,
    /// Moves at its own velocity.
    Kinematic,
}

/// A plane of the world.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Plane {
    /// Such as "xw".
    Name(String),
    /// From the first direction towards the second.
    Directions([Vec<f64>; 2]),
}

/// A file format for slices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Format {
    /// Binary STL.
    Stl,
    /// Binary glTF.
    Glb,
}

/// A message that was not obeyed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Refusal {
    /// What is wrong, and what would be right.
    pub message: String,
    /// What it is about, where a page may have words of its own for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<&'static str>,
    /// Of the scene's text, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// See `line`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
}

impl Refusal {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: None, line: None, column: None }
    }

    /// One that a page may say in words of its own.
    pub(crate) fn about(code: &'static str, message: impl Into<String>) -> Self {
        Self { code: Some(code), ..Self::new(message) }
    }
}

impl<E: std::error::Error> From<E> for Refusal {
    fn from(error: E) -> Self {
        Self::new(error.to_string())
    }
}

/// What a message comes to.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Reply {
    /// For messages that are answered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<Value>,
    /// Why not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<Refusal>,
    /// The list of bodies, where it is new.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<SceneDescription>,
    /// Whether the scene is another one.
    pub loaded: bool,
}

/// A body, as far as it stays the same.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BodyDescription {
    /// Its number.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// How it takes part.
    pub kind: Kind,
    /// Key of its shape in the scene format.
    pub shape: &'static str,
    /// Whether it is a half-space.
    pub endless: bool,
    /// Counts bodies that are not endless.
    pub colour_index: u32,
    /// Given by the scene.
    pub colour: Option<[f64; 3]>,
    /// kg; 0 where nothing moves it.
    pub mass: f64,
    /// About the centre of mass, m.
    pub radius: f64,
}

/// A scene, as far as it stays the same.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SceneDescription {
    /// Name of the built-in scene.
    pub builtin: Option<String>,
    /// For people.
    pub title: String,
    /// 2..=6.
    pub dimension: usize,
    /// What to see.
    pub sentence: String,
    /// m/s².
    pub gravity: Vec<f64>,
    /// s.
    pub dt: f64,
    /// All bodies.
    pub bodies: Vec<BodyDescription>,
    /// Middle of what can move, m.
    pub middle: Vec<f64>,
    /// Its radius, m.
    pub extent: f64,
}

/// What a frame tells beside its arrays; the names are those of the protocol.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// s.
    pub time: f64,
    /// Steps since the start.
    pub step: u64,
    /// What was drawn: `origin`, `axes`, `off`.
    pub slice: Value,
    /// The selected body.
    pub selected: Option<Value>,
    /// What struck what.
    pub impacts: Vec<Value>,
    /// What is held.
    pub hands: Vec<Value>,
    /// Bodies that were stopped.
    pub quarantined: Vec<u32>,
    /// `seconds`, `secondsBack`, `undo`.
    pub history: Value,
    /// J.
    pub energy: Value,
}
