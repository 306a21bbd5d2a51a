//! What can be wrong with the coefficients of a rotor.

use std::error::Error;
use std::fmt;

/// Why numbers are not the coefficients of a rotor: the message gives the value, the limit and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorError {
    kind: RotorErrorKind,
    message: String,
}

/// The kinds of [`RotorError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RotorErrorKind {
    /// Not 2^(N−1) numbers.
    WrongCount,
    /// A number is infinite or not a number.
    NotFinite,
    /// The numbers are too far from a unit versor, or nearest to none.
    NotAVersor,
}

impl RotorError {
    /// The kind, for programs.
    #[must_use]
    pub fn kind(&self) -> RotorErrorKind {
        self.kind
    }

    pub(super) fn wrong_count(dimension: usize, given: usize, expected: usize) -> Self {
        let message = format!(
            "a rotor in {dimension} dimensions has {expected} numbers (the scalar, the planes, the 4-vectors, …), got {given}"
        );
        Self { kind: RotorErrorKind::WrongCount, message }
    }

    pub(super) fn not_finite(slot: usize, value: f64) -> Self {
        let message = format!("number {} of the rotor is {value}; every number must be finite", slot + 1);
        Self { kind: RotorErrorKind::NotFinite, message }
    }

    pub(super) fn not_a_versor(dimension: usize, length: f64, defect: f64, limit: f64) -> Self {
        let mut message = format!(
            "the numbers are not a rotor: R R~ or R x R~ is off by {defect:.3e}, and at most {limit:.0e} is accepted"
        );
        if (length - 1.0).abs() > limit {
            message += &format!("; their length is {length}, divide them by it");
        } else if dimension > 3 {
            message +=
                "; their length is one, but a rotor has to meet more conditions: give plane turns or a matrix instead";
        }
        Self { kind: RotorErrorKind::NotAVersor, message }
    }

    pub(super) fn no_nearest(dimension: usize) -> Self {
        let message = format!(
            "no rotor in {dimension} dimensions is nearest to these numbers: all of them, or one of the parts that have to \
             be normalised separately, are zero; give plane turns or a matrix instead"
        );
        Self { kind: RotorErrorKind::NotAVersor, message }
    }
}

impl fmt::Display for RotorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for RotorError {}
