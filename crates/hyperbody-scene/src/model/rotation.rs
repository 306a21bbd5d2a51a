//! The three ways in which a scene says how a body is turned.

/// A rotation as a file gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum RotationSpec {
    /// Turns in planes, applied in order; none: not turned.
    Turns(Vec<Turn>),
    /// The 2^(n−1) numbers of a unit rotor: scalar, planes, 4-vectors, …
    Rotor(Vec<f64>),
    /// The rows of an orthogonal matrix of determinant one.
    Matrix(Vec<Vec<f64>>),
}

/// A turn in one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// Two axes, such as "xw": a positive angle turns the first towards the second.
    pub plane: String,
    /// How far.
    pub angle: Angle,
}

/// An angle in the unit that the file uses, so that writing it back changes no bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// `angle_deg`.
    Degrees(f64),
    /// `angle`.
    Radians(f64),
}

impl Angle {
    /// The angle in radians.
    #[must_use]
    pub fn radians(self) -> f64 {
        match self {
            Self::Degrees(value) => value.to_radians(),
            Self::Radians(value) => value,
        }
    }
}

impl RotationSpec {
    /// Appends a turn; a rotor or matrix is replaced by it.
    pub(crate) fn push(&mut self, plane: &str, angle_deg: f64) {
        let turn = Turn { plane: plane.to_owned(), angle: Angle::Degrees(angle_deg) };
        match self {
            Self::Turns(turns) => turns.push(turn),
            Self::Rotor(_) | Self::Matrix(_) => *self = Self::Turns(vec![turn]),
        }
    }

    /// Whether this is the rotation that a file need not mention.
    #[must_use]
    pub fn is_none(&self) -> bool {
        matches!(self, Self::Turns(turns) if turns.is_empty())
    }
}

impl Default for RotationSpec {
    fn default() -> Self {
        Self::Turns(Vec::new())
    }
}
