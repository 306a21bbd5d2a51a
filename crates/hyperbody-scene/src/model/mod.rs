//! What a scene file says, as plain data with a dimension known at run time only.

mod body;
mod joint;
mod rotation;
mod scene;
mod shape;

pub use body::{Body, BodyKind};
pub use joint::{Joint, JointCone, JointKind, JointLimits, JointMotor, JointSpring};
pub use rotation::{Angle, RotationSpec, Turn};
pub(crate) use scene::Beside;
pub use scene::{DEFAULT_DT, DEFAULT_SUBSTEPS, NamedMaterial, Scene, default_gravity};
pub use shape::{Factor, Part, PolytopeSpec, ShapeSpec, Size};
