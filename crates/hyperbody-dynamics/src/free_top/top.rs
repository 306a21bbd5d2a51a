//! The body: its principal second moments, and what they make of spin and momentum.
//!
//! With P = ∫ρ x xᵀ dV = diag(J_1, …, J_N) in principal axes, the angular momentum is L = PΩ + ΩP, so plane (i, j) has
//! the moment of inertia I_ij = J_i + J_j: N numbers hold the whole inertia of a body in any dimension.
//!
//! What does not generalise from 3D: a moment belongs to a plane, not to an axis. In 3D there are as many planes as axes
//! and the three moments of inertia are free within triangle inequalities; from 4D on the N(N−1)/2 moments are bound to
//! each other, since only N of them can be chosen.

use hyperbody_geometry::{MassProperties, Shape};
use hyperbody_math::{Bivector, Rotation, Vector, planes};

use super::error::{FreeTopError, FreeTopErrorKind, Result, rounded, shown};

/// Largest relative contradiction between given moments of inertia that counts as rounding.
const MOMENT_TOLERANCE: f64 = 1e-9;

/// Relative difference up to which computed moments count as equal: those of polytopes come out to about 1e-13, and a
/// difference that small would turn a ball-like body over in 10¹² turns.
const EQUAL_COMPUTED: f64 = 1e-12;

/// Second moment below which a direction counts as flat, relative to the largest.
const FLAT: f64 = 1e-14;

/// A torque-free rigid body in its principal frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeTop<const N: usize> {
    principal_moments: Vector<N>,
    /// 1/(J_i + J_j) for i ≠ j, symmetric; zero on the diagonal.
    inverse_inertia: [[f64; N]; N],
}

impl<const N: usize> FreeTop<N> {
    /// The body with the principal second moments J_i ≥ 0 in kg·m² (or m², per unit mass), one for each axis in any
    /// order; at most one of them may be zero (a flat body).
    ///
    /// # Errors
    /// If a moment is negative or not finite, or if two are zero: a body without extent along both axes of a plane has
    /// no inertia in it. So has one whose moments are too large or too small to be added and inverted.
    pub fn new(principal_moments: Vector<N>) -> Result<Self> {
        for (axis, moment) in principal_moments.iter().enumerate() {
            if !(moment >= 0.0 && moment.is_finite()) {
                return Err(bad_moments(format!(
                    "the second moment of axis {name} is {}; it is ∫ρ {name}² dV and must be finite and not negative",
                    shown(moment),
                    name = planes::AXIS_NAMES[axis],
                )));
            }
        }
        let mut inverse_inertia = [[0.0; N]; N];
        for (i, j) in planes::all(N) {
            let inertia = principal_moments[i] + principal_moments[j];
            let inverse = 1.0 / inertia;
            if !(inertia.is_finite() && inverse.is_finite()) {
                return Err(bad_moments(format!(
                    "the moment of inertia of plane {} is J_i + J_j = {}; it and its inverse must be finite, \
                     so at most one second moment may be zero",
                    planes::name(i, j),
                    shown(inertia)
                )));
            }
            inverse_inertia[i][j] = inverse;
            inverse_inertia[j][i] = inverse;
        }
        Ok(Self { principal_moments, inverse_inertia })
    }

    /// The body whose planes have the given moments of inertia I_ij in kg·m², in lexicographic order of the planes:
    /// in 3D xy, xz, yz, which are the usual moments about the axes z, y, x.
    ///
    /// In the plane there is one moment for two axes; it is split evenly, which is all that the motion can see.
    ///
    /// # Errors
    /// If there is not one number for each plane, or if they belong to no body: second moments J_i ≥ 0 with
    /// I_ij = J_i + J_j exist in 3D only if no moment exceeds the sum of the other two (the triangle inequalities), and
    /// from 4D on only if I_ij + I_kl is the same for all three ways to pair any four axes.
    pub fn from_plane_moments(plane_moments: &[f64]) -> Result<Self> {
        let Some(inertia) = Bivector::<N>::from_planes(plane_moments) else {
            return Err(bad_moments(format!(
                "{} moments of inertia were given, but {N} dimensions have {} planes; give one for each plane",
                plane_moments.len(),
                planes::count(N)
            )));
        };
        if let Some(bad) = plane_moments.iter().find(|m| !(m.is_finite() && **m > 0.0)) {
            return Err(bad_moments(format!("a moment of inertia is {}; it must be finite and positive", shown(*bad))));
        }
        let largest = plane_moments.iter().fold(0.0, |a: f64, &b| a.max(b));
        let total = plane_moments.iter().sum::<f64>() / (N as f64 - 1.0);
        let mut moments = Vector::splat(0.5 * total);
        if N > 2 {
            for i in 0..N {
                let sum: f64 = (0..N).filter(|&j| j != i).map(|j| inertia.get(i.min(j), i.max(j))).sum();
                moments[i] = (sum - total) / (N as f64 - 2.0);
            }
        }
        for (i, j) in planes::all(N) {
            let given = inertia.get(i, j);
            if (moments[i] + moments[j] - given).abs() > MOMENT_TOLERANCE * largest {
                return Err(bad_moments(format!(
                    "the moment of inertia of plane {} is {}, but the other planes leave it {}: in {N} \
                     dimensions the moments I_ij = J_i + J_j depend on {N} numbers; give second moments instead",
                    planes::name(i, j),
                    shown(given),
                    rounded(moments[i] + moments[j])
                )));
            }
        }
        for axis in 0..N {
            if moments[axis] < -MOMENT_TOLERANCE * largest {
                return Err(bad_moments(format!(
                    "these moments of inertia leave axis {} a second moment of {}, which must not be negative: \
                     in 3D this is the triangle inequality, no moment may exceed the sum of the other two",
                    planes::AXIS_NAMES[axis],
                    rounded(moments[axis])
                )));
            }
            moments[axis] = moments[axis].max(0.0);
        }
        Self::new(join_equal(&moments))
    }

    /// The body with the given mass properties, per unit mass: moments J_i in m² in descending order, which is what
    /// tables list, those that differ by rounding alone made equal, and the attitude `body_from_principal` of the principal
    /// axes. The motion does not depend on the mass; momenta and energies are those of one kilogram.
    ///
    /// # Errors
    /// If the mass is not positive, and as [`FreeTop::new`].
    pub fn from_mass_properties(properties: &MassProperties<N>) -> Result<(Self, Rotation<N>)> {
        if !(properties.mass > 0.0 && properties.mass.is_finite()) {
            return Err(bad_moments(format!("the mass is {} kg; it must be finite and positive", properties.mass)));
        }
        let (moments, body_from_principal) = properties.scaled(1.0 / properties.mass).principal();
        // A flat direction comes out of the diagonalisation as zero up to rounding of the largest moment.
        let floor = FLAT * moments.max_abs();
        let cleaned = Vector::from_fn(|i| if moments[i].abs() < floor { 0.0 } else { moments[i] });
        Ok((Self::new(join_equal(&cleaned))?, body_from_principal))
    }

    /// The body of a shape of even density, as [`FreeTop::from_mass_properties`].
    ///
    /// # Errors
    /// If the shape has no mass properties, as a half-space has none.
    pub fn from_shape(shape: &Shape<N>) -> Result<(Self, Rotation<N>)> {
        let properties = shape.mass_properties(1.0).map_err(|error| bad_moments(error.to_string()))?;
        Self::from_mass_properties(&properties)
    }

    /// J_i in kg·m², by axis.
    #[inline]
    #[must_use]
    pub fn principal_moments(&self) -> &Vector<N> {
        &self.principal_moments
    }

    /// 1/(J_i + J_j).
    #[inline]
    pub(crate) fn inverse_inertia(&self) -> &[[f64; N]; N] {
        &self.inverse_inertia
    }

    /// Moment of inertia I_ij = J_i + J_j of a plane in kg·m².
    ///
    /// # Panics
    /// If an axis is not below `N`.
    #[must_use]
    pub fn plane_moment(&self, i: usize, j: usize) -> f64 {
        self.principal_moments[i] + self.principal_moments[j]
    }

    /// r_ij = (J_i − J_j)/(J_i + J_j), the only way in which the shape of the body enters its free motion.
    ///
    /// # Panics
    /// If an axis is not below `N`.
    #[must_use]
    pub fn asymmetry(&self, i: usize, j: usize) -> f64 {
        (self.principal_moments[i] - self.principal_moments[j]) * self.inverse_inertia[i][j]
    }

    /// Angular momentum of a spin, both in the body frame: kg·m²/s of rad/s.
    #[inline]
    #[must_use]
    pub fn momentum_from_spin(&self, spin: &Bivector<N>) -> Bivector<N> {
        spin.scale_planes(|i, j| self.principal_moments[i] + self.principal_moments[j])
    }

    /// Spin of an angular momentum, both in the body frame: rad/s of kg·m²/s.
    #[inline]
    #[must_use]
    pub fn spin_from_momentum(&self, momentum: &Bivector<N>) -> Bivector<N> {
        momentum.scale_planes(|i, j| self.inverse_inertia[i][j])
    }

    /// Rate of change of the momentum in the body frame in kg·m²/s², Euler's equation:
    /// dM_ij/dt = (J_i − J_j) Σ_k ω_ik ω_jk.
    #[inline]
    #[must_use]
    pub fn momentum_rate(&self, momentum: &Bivector<N>) -> Bivector<N> {
        let spin = self.spin_from_momentum(momentum).to_matrix();
        Bivector::from_fn(|i, j| (self.principal_moments[i] - self.principal_moments[j]) * spin.row(i).dot(spin.row(j)))
    }

    /// Rate of change of the spin in the body frame in rad/s²: dω_ij/dt = r_ij Σ_k ω_ik ω_jk.
    #[must_use]
    pub fn spin_rate(&self, spin: &Bivector<N>) -> Bivector<N> {
        let omega = spin.to_matrix();
        Bivector::from_fn(|i, j| self.asymmetry(i, j) * omega.row(i).dot(omega.row(j)))
    }
}

/// Moments that are equal up to rounding, made equal: whether they are decides what is stable and what is conserved.
fn join_equal<const N: usize>(moments: &Vector<N>) -> Vector<N> {
    let width = EQUAL_COMPUTED * moments.max_abs();
    let mut order: [usize; N] = std::array::from_fn(|axis| axis);
    order.sort_by(|&a, &b| moments[a].total_cmp(&moments[b]));
    let mut joined = *moments;
    let mut rest = &order[..];
    while let Some(&first) = rest.first() {
        let count = rest.iter().take_while(|&&axis| moments[axis] - moments[first] <= width).count();
        let (equal, above) = rest.split_at(count);
        // A moment that stands alone keeps its bits.
        if count > 1 {
            let mean = equal.iter().map(|&axis| moments[axis]).sum::<f64>() / count as f64;
            equal.iter().for_each(|&axis| joined[axis] = mean);
        }
        rest = above;
    }
    joined
}

fn bad_moments(message: String) -> FreeTopError {
    FreeTopError::new(FreeTopErrorKind::Moments, message)
}
