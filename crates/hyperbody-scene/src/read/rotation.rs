//! Rotations: plane turns, a rotor, or a matrix.

use super::Result;
use super::cursor::{At, Fields};
use crate::error::SceneError;
use crate::json::Json;
use crate::model::{Angle, RotationSpec, Turn};

pub(super) fn rotation(at: &At<'_>) -> Result<RotationSpec> {
    let forms = "a list of turns such as [{\"plane\": \"xy\", \"angle_deg\": 30}], or {\"rotor\": [numbers]}, or \
                 {\"matrix\": [rows]}";
    if matches!(at.json, Json::List(_)) {
        return Ok(RotationSpec::Turns(at.list(forms)?.iter().map(turn).collect::<Result<_>>()?));
    }
    let fields = at.fields(forms, &["rotor", "matrix"])?;
    match (fields.optional("rotor"), fields.optional("matrix")) {
        (Some(rotor), None) => Ok(RotationSpec::Rotor(rotor.numbers()?)),
        (None, Some(matrix)) => Ok(RotationSpec::Matrix(matrix.rows()?)),
        _ => Err(SceneError::structure(fields.path(), "needs one of \"rotor\" and \"matrix\"")),
    }
}

fn turn(at: &At<'_>) -> Result<Turn> {
    let fields =
        at.fields("a turn such as {\"plane\": \"xy\", \"angle_deg\": 30}", &["plane", "angle_deg", "angle"])?;
    Ok(Turn { plane: fields.required("plane")?.text()?, angle: angle(&fields)? })
}

/// In degrees or in radians.
pub(super) fn angle(fields: &Fields<'_>) -> Result<Angle> {
    Ok(match (fields.optional("angle_deg"), fields.optional("angle")) {
        (Some(angle), None) => Angle::Degrees(angle.number()?),
        (None, Some(angle)) => Angle::Radians(angle.number()?),
        _ => {
            let message = "needs one of \"angle_deg\" (degrees) and \"angle\" (radians)";
            return Err(SceneError::structure(fields.path(), message));
        }
    })
}
