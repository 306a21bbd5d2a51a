//! Steady rotations in principal planes: simple, double, and in 6D triple.
//!
//! A spin whose planes are principal and mutually orthogonal drives no plane, so it is steady whatever its rates. In a
//! general spin the most energetic such part is what a disturbed run is a disturbance of.

use hyperbody_math::{Bivector, planes};

use super::error::{FreeTopError, FreeTopErrorKind, Result};

/// A turn in one principal plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalTurn {
    /// First axis of the plane.
    pub i: usize,
    /// Second axis, above the first.
    pub j: usize,
    /// In rad/s, not zero.
    pub rate: f64,
}

/// A steady rotation in mutually orthogonal principal planes.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipalRotation<const N: usize> {
    turns: Vec<PrincipalTurn>,
}

impl<const N: usize> PrincipalRotation<N> {
    /// The rotation with the rates of `spin` in rad/s.
    ///
    /// # Errors
    /// If the spin is not finite or two of its planes share an axis: such a spin is not steady.
    pub fn new(spin: &Bivector<N>) -> Result<Self> {
        let (rotation, remainder) = Self::nearest(spin)?;
        if remainder > 0.0 {
            return Err(FreeTopError::new(
                FreeTopErrorKind::Spin,
                "two planes of the spin share an axis; a steady rotation takes planes without common axes, such as \
                 xy and zw",
            ));
        }
        Ok(rotation)
    }

    /// The rotation in principal planes that holds most of `spin`, and the fraction of |ω| that lies outside it.
    ///
    /// # Errors
    /// If the spin is not finite.
    pub fn nearest(spin: &Bivector<N>) -> Result<(Self, f64)> {
        if !spin.is_finite() {
            return Err(FreeTopError::new(FreeTopErrorKind::Spin, "the spin is not finite"));
        }
        // Scaled, so that squares neither overflow nor vanish.
        let scale = spin.planes().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
        if scale == 0.0 {
            return Ok((Self { turns: Vec::new() }, 0.0));
        }
        let scaled = *spin * (1.0 / scale);
        let (held, chosen) = best_matching(&scaled, &mut [false; N]);
        let turns = chosen
            .into_iter()
            .filter(|&(i, j)| spin.get(i, j) != 0.0)
            .map(|(i, j)| PrincipalTurn { i, j, rate: spin.get(i, j) })
            .collect::<Vec<_>>();
        let outside: f64 = planes::all(N)
            .filter(|&(i, j)| !turns.iter().any(|turn| (turn.i, turn.j) == (i, j)))
            .map(|(i, j)| scaled.get(i, j) * scaled.get(i, j))
            .sum();
        Ok((Self { turns }, (outside / (held + outside)).sqrt()))
    }

    /// The turns, by first axis.
    #[must_use]
    pub fn turns(&self) -> &[PrincipalTurn] {
        &self.turns
    }

    /// The spin in the body frame, in rad/s.
    #[must_use]
    pub fn spin(&self) -> Bivector<N> {
        let mut spin = Bivector::ZERO;
        for turn in &self.turns {
            spin.set(turn.i, turn.j, turn.rate);
        }
        spin
    }

    /// The axes that no turn uses.
    #[must_use]
    pub fn idle_axes(&self) -> Vec<usize> {
        (0..N).filter(|&axis| !self.turns.iter().any(|turn| turn.i == axis || turn.j == axis)).collect()
    }

    /// Names of the planes: `"xy"`, `"xy and zw"`.
    #[must_use]
    pub fn to_text(&self) -> String {
        let names: Vec<String> = self.turns.iter().map(|turn| planes::name(turn.i, turn.j)).collect();
        names.join(" and ")
    }
}

/// The disjoint planes among the unused axes with the largest sum of squares, by trying all of them (15 in 6D).
fn best_matching<const N: usize>(spin: &Bivector<N>, used: &mut [bool; N]) -> (f64, Vec<(usize, usize)>) {
    let Some(first) = used.iter().position(|&u| !u) else {
        return (0.0, Vec::new());
    };
    used[first] = true;
    // The first free axis stays alone, or meets one of the others.
    let mut best = best_matching(spin, used);
    for second in first + 1..N {
        if used[second] {
            continue;
        }
        used[second] = true;
        let (rest, mut planes) = best_matching(spin, used);
        let sum = rest + spin.get(first, second) * spin.get(first, second);
        if sum > best.0 {
            planes.insert(0, (first, second));
            best = (sum, planes);
        }
        used[second] = false;
    }
    used[first] = false;
    best
}
