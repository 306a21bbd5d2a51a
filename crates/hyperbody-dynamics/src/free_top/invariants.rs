//! Everything that free motion conserves, and how far a run drifts from it.
//!
//! Energy H = ½ Σ M_ij²/(J_i + J_j); |M|²; the momentum in the world frame, R M Rᵀ; in 4D the Pfaffian
//! M12 M34 − M13 M24 + M14 M23; and in every dimension Manakov's integrals f_i = Σ_{j≠i} M_ij²/(J_i² − J_j²), which add
//! up to zero, so N − 1 of them count (S. Manakov, 1976). In 3D they say no more than H and |M|²; from 4D on they are what
//! makes the free top integrable.
//!
//! Where moments are equal, f_i has no meaning alone: the axes of equal moment then share the sum of their f_i without
//! the terms between them, which stays conserved, and the momentum components between them are conserved one by one.

use hyperbody_math::{Bivector, Vector, planes};

use super::state::TopState;
use super::top::FreeTop;

/// The conserved quantities of one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<const N: usize> {
    /// Kinetic energy in joules.
    pub energy: f64,
    /// |M|², the sum over planes of the squares, in (kg·m²/s)².
    pub momentum_sq: f64,
    /// R M Rᵀ, in kg·m²/s.
    pub momentum_in_world: Bivector<N>,
    /// M12 M34 − M13 M24 + M14 M23 in (kg·m²/s)²; `None` outside 4D.
    pub pfaffian: Option<f64>,
    /// Manakov's f_i by axis, in 1/s² (axes of equal moment share one value).
    pub manakov: Vector<N>,
}

impl<const N: usize> Invariants<N> {
    /// The conserved quantities of `state`.
    #[must_use]
    pub fn of(top: &FreeTop<N>, state: &TopState<N>) -> Self {
        let momentum = &state.momentum_in_body;
        Self {
            energy: energy(top, momentum),
            momentum_sq: momentum.norm_sq(),
            momentum_in_world: state.momentum_in_world(),
            pfaffian: pfaffian_4d(momentum),
            manakov: manakov(top, momentum),
        }
    }
}

/// Kinetic energy ½ Σ M_ij²/(J_i + J_j) in joules of a momentum in the body frame.
#[must_use]
pub fn energy<const N: usize>(top: &FreeTop<N>, momentum: &Bivector<N>) -> f64 {
    0.5 * momentum.dot(&top.spin_from_momentum(momentum))
}

/// M12 M34 − M13 M24 + M14 M23, half of M ∧ M; `None` outside 4D, where the determinant has no such root (odd N) or the
/// root is of third degree (6D).
#[must_use]
pub fn pfaffian_4d<const N: usize>(momentum: &Bivector<N>) -> Option<f64> {
    (N == 4).then(|| {
        momentum.get(0, 1) * momentum.get(2, 3) - momentum.get(0, 2) * momentum.get(1, 3)
            + momentum.get(0, 3) * momentum.get(1, 2)
    })
}

/// Manakov's integrals f_i = Σ_j M_ij²/(J_i² − J_j²) by axis, in 1/s². Axes whose moments are equal to the bit share the
/// sum of theirs.
#[must_use]
pub fn manakov<const N: usize>(top: &FreeTop<N>, momentum: &Bivector<N>) -> Vector<N> {
    manakov_sum(top, momentum, |term| term)
}

fn manakov_sum<const N: usize>(top: &FreeTop<N>, momentum: &Bivector<N>, map: impl Fn(f64) -> f64) -> Vector<N> {
    let moments = top.principal_moments();
    let of_axis = Vector::<N>::from_fn(|i| {
        let others = (0..N).filter(|&j| moments[j] != moments[i]);
        // The difference of squares in factors keeps close moments accurate.
        others
            .map(|j| {
                let divisor = (moments[i] - moments[j]) * (moments[i] + moments[j]);
                map(momentum.get(i, j) * momentum.get(i, j) / divisor)
            })
            .sum()
    });
    Vector::from_fn(|i| (0..N).filter(|&j| moments[j] == moments[i]).map(|j| of_axis[j]).sum())
}

/// Largest deviations from the start over a run, relative to the size that each quantity had at the start.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Drift {
    /// Of the energy, relative to it.
    pub energy: f64,
    /// Of |M|², relative to it.
    pub momentum_sq: f64,
    /// Of R M Rᵀ: norm of the difference over the norm.
    pub momentum_in_world: f64,
    /// Of the Pfaffian, relative to ½|M|², the largest value it can have; `None` outside 4D.
    pub pfaffian: Option<f64>,
    /// The largest over the axes of the change of Manakov's f_i, relative to the sum of the absolute values of the terms
    /// of f_i at the start (f_i itself may start at zero), or to the mean of those sums where that is larger.
    pub manakov: f64,
}

/// Follows a run and keeps the largest deviations.
#[derive(Clone, Debug)]
pub struct DriftMeter<const N: usize> {
    start: Invariants<N>,
    manakov_scale: Vector<N>,
    drift: Drift,
}

impl<const N: usize> DriftMeter<N> {
    /// A meter that compares with the quantities of `state`.
    #[must_use]
    pub fn new(top: &FreeTop<N>, state: &TopState<N>) -> Self {
        let sizes = manakov_sum(top, &state.momentum_in_body, f64::abs);
        let mean = sizes.iter().sum::<f64>() / N as f64;
        Self {
            start: Invariants::of(top, state),
            manakov_scale: Vector::from_fn(|i| sizes[i].max(mean)),
            drift: Drift { pfaffian: (N == 4).then_some(0.0), ..Drift::default() },
        }
    }

    /// Takes a later state into account.
    pub fn observe(&mut self, now: &Invariants<N>) {
        let (start, drift) = (&self.start, &mut self.drift);
        drift.energy = drift.energy.max(relative(now.energy - start.energy, start.energy));
        drift.momentum_sq = drift.momentum_sq.max(relative(now.momentum_sq - start.momentum_sq, start.momentum_sq));
        let turned = (now.momentum_in_world - start.momentum_in_world).norm();
        drift.momentum_in_world = drift.momentum_in_world.max(relative(turned, start.momentum_in_world.norm()));
        if let (Some(largest), Some(now), Some(then)) = (&mut drift.pfaffian, now.pfaffian, start.pfaffian) {
            *largest = largest.max(relative(now - then, 0.5 * start.momentum_sq));
        }
        for axis in 0..N {
            let change = now.manakov[axis] - start.manakov[axis];
            drift.manakov = drift.manakov.max(relative(change, self.manakov_scale[axis]));
        }
    }

    /// The largest deviations so far.
    #[must_use]
    pub fn drift(&self) -> Drift {
        self.drift
    }
}

/// |change|/scale; a quantity without size, such as the energy of a body at rest, must not change at all.
fn relative(change: f64, scale: f64) -> f64 {
    if change == 0.0 { 0.0 } else { change.abs() / scale }
}

/// Names of what [`Drift`] measures beside the quantities themselves: the planes whose momentum is conserved one by one
/// because their two axes have equal moments.
#[must_use]
pub fn conserved_planes<const N: usize>(top: &FreeTop<N>) -> Vec<(usize, usize)> {
    let moments = top.principal_moments();
    planes::all(N).filter(|&(i, j)| moments[i] == moments[j]).collect()
}
