//! Rotations of a scene.

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::{Matrix, Rotation, Rotor};

use super::{Result, plane, vector};
use crate::error::SceneError;
use crate::model::RotationSpec;

/// Most turns of one rotation.
const MAX_TURNS: usize = 1000;

pub(super) fn rotation<const N: usize>(spec: &RotationSpec, path: &str) -> Result<Rotation<N>>
where
    Dim<N>: EvenAlgebra,
{
    match spec {
        RotationSpec::Turns(turns) => {
            if turns.len() > MAX_TURNS {
                let message = format!("has {} turns; at most {MAX_TURNS} are allowed", turns.len());
                return Err(SceneError::value(path, message));
            }
            let mut rotation = Rotation::IDENTITY;
            for (index, turn) in turns.iter().enumerate() {
                let place = format!("{path}[{index}]");
                let (i, j) = plane::<N>(&turn.plane, &format!("{place}.plane"))?;
                let angle = turn.angle.radians();
                if !angle.is_finite() {
                    return Err(SceneError::value(place, format!("the angle is {angle}; it has to be finite")));
                }
                rotation = Rotation::in_plane(i, j, angle) * rotation;
            }
            Ok(rotation)
        }
        RotationSpec::Rotor(numbers) => rotor(numbers, &format!("{path}.rotor")),
        RotationSpec::Matrix(rows) => matrix(rows, &format!("{path}.matrix")),
    }
}

fn matrix<const N: usize>(rows: &[Vec<f64>], path: &str) -> Result<Rotation<N>> {
    if rows.len() != N {
        let message = format!("has {}, expected {N} rows of {N} numbers", super::counted(rows.len(), "row"));
        return Err(SceneError::value(path, message));
    }
    let mut matrix = Matrix::ZERO;
    for (index, row) in rows.iter().enumerate() {
        matrix.0[index] = vector::<N>(row, &format!("{path}[{index}]"))?.0;
    }
    if let Some(rotation) = Rotation::from_matrix(matrix) {
        return Ok(rotation);
    }
    let defect = (matrix.transpose() * matrix - Matrix::IDENTITY).max_abs();
    let message = if defect <= Rotation::<N>::ORTHOGONALITY_TOLERANCE {
        "is a reflection: its determinant is −1; change the sign of one row to get a rotation".to_owned()
    } else {
        format!(
            "is not orthogonal: its rows differ from perpendicular unit vectors by {defect:.1e}, at most {:.0e} is repaired; \
             give more digits",
            Rotation::<N>::ORTHOGONALITY_TOLERANCE
        )
    };
    Err(SceneError::value(path, message))
}

fn rotor<const N: usize>(numbers: &[f64], path: &str) -> Result<Rotation<N>>
where
    Dim<N>: EvenAlgebra,
{
    let rotor = Rotor::<N>::from_coefficients(numbers);
    rotor.map(|rotor| rotor.to_rotation()).map_err(|error| SceneError::value(path, error.to_string()))
}
