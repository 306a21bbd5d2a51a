//! Exponential, logarithm and interpolation of rotors, by the invariant planes of [`crate::invariant`]: turns in
//! orthogonal planes commute, so exp Σ −½ θ_k P_k is the product of cos(θ_k/2) − sin(θ_k/2) P_k, good at any size of the
//! angles. A power series with halving and squaring loses the unit length in proportion to the angle, and the closed form
//! by two quaternions ends at 4D.

use super::{Dim, EvenAlgebra, Rotor};
use crate::{Bivector, InvariantPlanes, scalar};

impl<const N: usize> Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    /// The rotor reached after one unit of time at the constant angular velocity `b`, the same rotation as
    /// [`crate::Rotation::exp`]: in terms of the algebra e^(−b/2). Simple, double and isoclinic rotations, zero and angles of
    /// any size are all exact to the rounding of `b`. Turns by 2π give −1. NaN if a number is not finite.
    #[must_use]
    pub fn exp(b: &Bivector<N>) -> Self {
        Self::from_planes(&b.invariant_planes())
    }

    /// The angular velocity, in radians per unit of time, that reaches this rotor, sign included, in one unit of time by
    /// the shortest way: `Rotor::exp(&r.log())` is r. `Rotor::exp(&b).log()` is b as long as the two largest turns of `b`
    /// add up to less than 2π (one alone: to less than 2π).
    ///
    /// Where they add up to 2π there are several shortest ways, as for −1; rounding decides, the same way every time.
    ///
    /// A rotor and its negative are the same rotation and have different logarithms. For the shortest way between the
    /// rotations take [`crate::Rotation::log`], or the logarithm of the one whose scalar part is positive.
    #[must_use]
    pub fn log(&self) -> Bivector<N> {
        let mut planes = self.to_rotation().invariant_planes();
        if Self::from_planes(&planes).dot(self) < 0.0 {
            // The other sign; shortest with the longer way round in the plane that has the furthest to go.
            planes = planes.other_way_round();
        }
        planes.to_bivector()
    }

    /// The rotor at parameter `t` on the shortest way, at constant angular velocity, from the rotation `self` (t = 0) to
    /// the rotation `other` (t = 1; the result is then `other` or −`other`, whichever continues from `self`). Beyond 0 and
    /// 1 the motion goes on.
    #[must_use]
    pub fn slerp(&self, other: &Self, t: f64) -> Self {
        let difference = (self.reverse() * *other).to_rotation();
        *self * Self::exp(&(difference.log() * t))
    }

    /// The product of the turns of each plane by its value in radians.
    fn from_planes(planes: &InvariantPlanes<N>) -> Self {
        let mut rotor = Self::IDENTITY;
        for (k, &angle_rad) in planes.values().iter().enumerate() {
            let (sin, cos) = scalar::sin_cos(0.5 * angle_rad);
            let mut turn = Self::IDENTITY;
            let coefficients = turn.coefficients.as_mut();
            coefficients[0] = cos;
            for (p, value) in planes.plane(k).planes().enumerate() {
                coefficients[1 + p] = -sin * value;
            }
            rotor = rotor * turn;
        }
        rotor
    }
}
