//! The engine of the playground: a scene that runs, cut into triangles for a page to draw.
//!
//! Thin: the physics is that of `hyperbody`, sections are those of `hyperbody::geometry`. What is added here is what a person at
//! a page needs: hands, a past to go back to, ghosts of what lies off the slice, and messages in JSON. All of it is plain
//! Rust and runs natively, where it is tested; `bindings` is the layer that JavaScript sees.
//!
//! | module | holds |
//! |---|---|
//! | `playground` | [`Playground`]: the scene that runs, whatever its dimension |
//! | `message` | [`Message`] and what they come to |
//! | `running` | a scene of N dimensions: world, bodies, past |
//! | `commands` | what a page can do to it |
//! | `report` | what a frame tells in words and numbers |
//! | `draw`, `drawable` | the picture of a moment, and what is drawn of a shape |
//! | `cut`, `round` | sections of polytopes, and of round bodies |
//! | `mesh`, `frame` | triangles of one body, and of all |
//! | `view` | [`View`]: the slice |
//! | `joints` | joints, as rods and marks |
//! | `hands`, `history`, `impacts` | springs to hold by, the past, what strikes what |
//! | `locate` | the line of a scene's text in which an error lies |
//! | `bindings` | [`Engine`]: the JavaScript side |

mod bindings;
mod commands;
mod cut;
mod draw;
mod drawable;
mod frame;
mod hands;
mod history;
mod impacts;
mod joints;
mod locate;
mod mesh;
mod message;
mod playground;
mod report;
mod round;
mod running;
mod view;

pub use bindings::Engine;
pub use frame::Buffers;
pub use mesh::Mesh;
pub use message::{BodyDescription, Format, Kind, Message, Plane, Refusal, Reply, Report, SceneDescription};
pub use playground::Playground;
pub use view::View;
