//! The torque-free body in `N` dimensions: how it tumbles, exactly and step by step.
//!
//! | module | holds |
//! |---|---|
//! | [`plane_splitting`] | the step that the world uses: exact turns in coordinate planes |

pub mod plane_splitting;

pub use plane_splitting::free_rotation_step;
