//! Bodies: how they are defined, what the world keeps of them, how they are read and pushed.

mod access;
mod def;
mod redefine;
mod state;

pub use access::{BodyMut, BodyRef};
pub use def::{BodyDef, BodyKind};
pub(crate) use redefine::prepare;
pub(crate) use state::{Body, Inertia, check_mass};
