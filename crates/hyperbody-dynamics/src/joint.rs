//! What ties two bodies together.

use hyperbody_math::Vector;

use crate::{BodyHandle, WorldError};

/// A joint as the user defines it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointDef<const N: usize> {
    /// Keeps one point of `a` on one point of `b`; all N(N−1)/2 turns stay free.
    Ball {
        /// First body.
        a: BodyHandle,
        /// Second body, another one.
        b: BodyHandle,
        /// The point in the frame of `a`, m.
        anchor_a: Vector<N>,
        /// The point in the frame of `b`, m.
        anchor_b: Vector<N>,
    },
}

/// A joint as the world keeps it.
#[derive(Clone, Debug)]
pub(crate) struct Joint<const N: usize> {
    /// Slots of the bodies.
    pub(crate) body_a: u32,
    pub(crate) body_b: u32,
    /// Anchors relative to the centres of mass, body frames.
    pub(crate) arm_a: Vector<N>,
    pub(crate) arm_b: Vector<N>,
    /// Accumulated impulse of one substep on `b`, world frame, N·s; warm-starts the next.
    pub(crate) impulse: Vector<N>,
}

impl<const N: usize> JointDef<N> {
    /// The two bodies.
    #[must_use]
    pub fn bodies(&self) -> (BodyHandle, BodyHandle) {
        match self {
            Self::Ball { a, b, .. } => (*a, *b),
        }
    }

    pub(crate) fn validate(&self) -> Result<(), WorldError> {
        match self {
            Self::Ball { anchor_a, anchor_b, .. } => {
                for (name, anchor) in [("anchor_a", anchor_a), ("anchor_b", anchor_b)] {
                    if !anchor.is_finite() {
                        return Err(WorldError::bad_number(format!("{name} is {:?}; it must be finite", anchor.0)));
                    }
                }
                Ok(())
            }
        }
    }
}
