//! Snapshots of worlds of any dimension as bytes: save games.

use std::any::Any;

use hyperbody::dynamics::snapshot::bytes::dimension_of;
use hyperbody::dynamics::{Snapshot, SnapshotError};
use hyperbody::math::{Dim, EvenAlgebra};

use crate::dimension::{DimensionVisitor, visit_dimension};
use crate::error::SceneError;
use crate::world::AnySnapshot;

struct Write<'a>(&'a dyn Any);

impl DimensionVisitor for Write<'_> {
    type Output = Option<Vec<u8>>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        self.0.downcast_ref::<Snapshot<N>>().map(Snapshot::to_bytes)
    }
}

struct Read<'a>(&'a [u8]);

impl DimensionVisitor for Read<'_> {
    type Output = Result<Box<dyn Any + Send>, SnapshotError>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        Ok(Box::new(Snapshot::<N>::from_bytes(self.0)?))
    }
}

impl AnySnapshot {
    /// The snapshot as bytes; see [`Snapshot::to_bytes`].
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        visit_dimension(self.dimension, Write(self.state.as_ref())).flatten().unwrap_or_default()
    }

    /// A snapshot from the bytes of [`AnySnapshot::to_bytes`], which may come from anywhere; see [`Snapshot::from_bytes`].
    ///
    /// # Errors
    /// If they are no snapshot of this version, incomplete, changed, or hold a state that cannot be.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SceneError> {
        let refused = |error: SnapshotError| SceneError::value("snapshot", error.to_string());
        let dimension = dimension_of(bytes).map_err(refused)?;
        let read = visit_dimension(dimension, Read(bytes));
        let other = || SceneError::value("snapshot", format!("of {dimension} dimensions; there are worlds of 2 to 6"));
        Ok(Self { dimension, state: read.ok_or_else(other)?.map_err(refused)? })
    }
}
