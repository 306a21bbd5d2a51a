//! Several contacts side by side: one number of each, as it stands in memory. Arithmetic on them is [`super::wide`]'s.

/// The scalar of the solver's rows. Velocities enter the rows as *changes* since the start of the step and gaps as
/// distances of neighbouring surfaces: both small, so that seven digits of them are more than of the whole.
pub(crate) type Real = f32;

/// Contacts side by side: one 256-bit register of `Real`.
pub(crate) const WIDTH: usize = 8;

/// One number of each of `WIDTH` contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Lanes(pub(crate) [Real; WIDTH]);

/// The same in double precision, as it stands in memory. Starts a line of cache, so that no load meets two.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct DoubleLanes(pub(crate) [f64; WIDTH]);

impl DoubleLanes {
    pub(crate) const ZERO: Self = Self::splat(0.0);

    #[inline(always)]
    pub(crate) const fn splat(value: f64) -> Self {
        Self([value; WIDTH])
    }
}

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; WIDTH]);

    #[inline(always)]
    pub(crate) const fn splat(value: Real) -> Self {
        Self([value; WIDTH])
    }
}
