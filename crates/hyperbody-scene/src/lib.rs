//! The scene format, the built-in gallery, and worlds whose dimension is known at run time only.
//!
//! A scene goes from text to a [`Scene`], plain data whose keys and types are right, and from there to an [`AnyWorld`],
//! where every value is checked. Whatever is wrong, one line says where, what, and what would be right.
//!
//! | module | holds |
//! |---|---|
//! | `model` | [`Scene`], [`Body`], [`ShapeSpec`], …: what a file says |
//! | `json`, `read`, `write` | text to [`Scene`] and back |
//! | `build` | [`Scene`] to world |
//! | `world` | [`AnyWorld`]: a world of two to six dimensions |
//! | `shape_file` | [`ShapeFile`]: a shape in a file of its own |
//! | `definitions` | worlds and bodies for programs that change a running world |
//! | `dimension` | [`visit_dimension`]: the one `match` that turns a number into a type |
//! | `gallery` | the built-in scenes |
//! | `carry` | [`Scene::carry_files`]: a scene without the files beside it |
//! | [`recording`] | simulations as files: write, replay |
//! | `jitter` | [`Scene::jitter`]: another history of the same scene |
//! | `error` | [`SceneError`] |
//!
//! The format is described in docs/scene-format.md.

mod build;
mod carry;
mod definitions;
mod dimension;
mod error;
mod gallery;
mod jitter;
mod json;
mod model;
mod off;
mod read;
pub mod recording;
mod saved;
mod shape_file;
mod world;
mod write;

pub use build::{MAX_BODIES, MAX_JOINTS, MAX_VERTICES};
pub use dimension::{DIMENSIONS, DimensionVisitor, visit_dimension};
pub use error::{ErrorKind, SceneError, meant, nearest};
pub use gallery::{BUILT_IN, BuiltIn, built_in};
pub use jitter::JITTER;
pub use model::{
    Angle, Body, BodyKind, DEFAULT_DT, DEFAULT_SUBSTEPS, Factor, Joint, JointCone, JointKind, JointLimits, JointMotor,
    JointSpring, NamedMaterial, Part, PolytopeSpec, RotationSpec, Scene, ShapeSpec, Size, Turn, default_gravity,
};
pub use read::{FORMAT, MAX_FILE_BYTES, VERSION};
pub use shape_file::ShapeFile;
pub use world::{AnySnapshot, AnyWorld, BodyState, Planes};
