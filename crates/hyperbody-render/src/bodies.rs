//! The bodies of a world as pictures need them. Where they are comes apart from what they are, so that one and the same picture is
//! made of a world that steps and of a recording of it.

use hyperbody::geometry::shape::Piece;
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::{BodyKind, Shape, World};

use crate::error::RenderError;
use crate::slice::Slice;
use crate::stage::{SlicePlane, slice_plane};

/// What is to be seen: bodies, where they are, and which way is down.
#[derive(Clone, Debug)]
pub struct Bodies<const N: usize> {
    pub(crate) gravity: Vector<N>,
    pub(crate) all: Vec<Shown<N>>,
}

/// One body.
#[derive(Clone, Debug)]
pub(crate) struct Shown<const N: usize> {
    pub(crate) kind: BodyKind,
    pub(crate) shape: Shape<N>,
    /// Centre of mass in the frame of the body, m.
    centre_in_body: Vector<N>,
    pub(crate) pose: Pose<N>,
    /// Red, green and blue in sRGB, 0..=1, if they are not left to the picture.
    pub(crate) colour: Option<[f64; 3]>,
}

impl<const N: usize> Shown<N> {
    /// Centre of mass in the world, m.
    pub(crate) fn centre(&self) -> Vector<N> {
        self.pose.transform_point(self.centre_in_body)
    }
}

impl<const N: usize> Bodies<N> {
    /// The bodies of a world where they are now.
    #[must_use]
    pub fn of(world: &World<N>) -> Self {
        let shown = |body: hyperbody::prelude::BodyRef<'_, N>| Shown {
            kind: body.kind(),
            shape: body.shape().clone(),
            centre_in_body: body.pose().inverse_transform_point(body.centre_of_mass()),
            pose: body.pose(),
            colour: None,
        };
        Self { gravity: world.gravity(), all: world.bodies().map(|(_, body)| shown(body)).collect() }
    }

    /// Gives bodies colours of their own, in the order of [`World::bodies`]: red, green and blue in sRGB, 0..=1, or `None` for
    /// one that the picture chooses.
    #[must_use]
    pub fn coloured(mut self, colours: impl IntoIterator<Item = Option<[f64; 3]>>) -> Self {
        for (body, colour) in self.all.iter_mut().zip(colours) {
            body.colour = colour;
        }
        self
    }

    /// Puts the bodies where they are at another moment, in the order of [`World::bodies`].
    ///
    /// # Errors
    /// If there are not as many poses as bodies.
    pub fn place(&mut self, poses: &[Pose<N>]) -> Result<(), RenderError> {
        if poses.len() != self.all.len() {
            let message = format!("{} poses are given for {} bodies; give each its own", poses.len(), self.all.len());
            return Err(RenderError::new(message));
        }
        for (body, pose) in self.all.iter_mut().zip(poses) {
            body.pose = *pose;
        }
        Ok(())
    }

    /// The half-spaces, by their numbers in the order of [`World::bodies`], that hold the whole slice: whose boundary runs
    /// along it, on the far side. A picture of the slice cannot show them, for there is nothing to be seen inside a solid,
    /// and leaves them out.
    #[must_use]
    pub fn half_spaces_around(&self, slice: &Slice<N>) -> Vec<usize> {
        let holds = |body: &Shown<N>| {
            let body_from_slice = body.pose.relative(slice.pose());
            body.shape.pieces().iter().any(|(body_from_piece, piece)| match piece {
                Piece::HalfSpace { normal, offset } => {
                    let plane = slice_plane(*normal, *offset, &(body_from_piece.inverse() * body_from_slice));
                    matches!(plane, SlicePlane::Along { height } if height <= 0.0)
                }
                Piece::Convex(_) => false,
            })
        };
        self.all.iter().enumerate().filter(|(_, body)| holds(body)).map(|(index, _)| index).collect()
    }
}
