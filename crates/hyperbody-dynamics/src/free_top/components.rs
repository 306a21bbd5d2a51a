//! Euler's equation plane by plane: which planes drive which.
//!
//! dω_ij/dt = r_ij Σ_k ω_ik ω_jk, r_ij = (J_i − J_j)/(J_i + J_j), with k over the other axes. In 4D, {i,j,k,m} = {1,2,3,4},
//!
//! I_ij dω_ij/dt = (I_ik − I_jk) ω_ik ω_jk + (I_im − I_jm) ω_im ω_jm:
//!
//! each plane is driven by the four planes that share an axis with it, in two pairs, and never by its orthogonal
//! complement (k, m) (M. ten Bosch, 2020, where positive spins turn the other way, which exchanges the moments in each
//! bracket). In 3D one pair is left, the familiar I₁ω̇₁ = (I₂ − I₃)ω₂ω₃.

use std::fmt::Write as _;

use hyperbody_math::{Bivector, planes};

use super::top::FreeTop;

/// How two planes drive a third: `coefficient` times the product of their spins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// The two driving planes, each with ascending axes.
    pub planes: [(usize, usize); 2],
    /// (I_ik − I_jk)/I_ij up to the sign that the ascending order of axes brings; no unit.
    pub coefficient: f64,
    /// What this pair adds to dω/dt, in rad/s².
    pub rate: f64,
}

/// The equation of one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneEquation {
    /// The plane (i, j), i < j.
    pub plane: (usize, usize),
    /// Its moment of inertia J_i + J_j in kg·m².
    pub moment: f64,
    /// The pairs of planes that drive it, one for each other axis.
    pub drives: Vec<Drive>,
    /// The planes that share no axis with it and so never drive it.
    pub never_driven_by: Vec<(usize, usize)>,
    /// dω_ij/dt, the sum of the drives, in rad/s².
    pub rate: f64,
}

/// The equations of all planes in lexicographic order, with their values at `spin` (body frame, rad/s).
#[must_use]
pub fn plane_equations<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Vec<PlaneEquation> {
    planes::all(N).map(|(i, j)| plane_equation(top, spin, i, j)).collect()
}

fn plane_equation<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>, i: usize, j: usize) -> PlaneEquation {
    let drives: Vec<Drive> = (0..N)
        .filter(|&k| k != i && k != j)
        .map(|k| {
            let ordered = [(i.min(k), i.max(k)), (j.min(k), j.max(k))];
            // ω_ik ω_jk in ascending names changes sign once if k lies between i and j.
            let sign = if (k < i) == (k < j) { 1.0 } else { -1.0 };
            let coefficient = sign * top.asymmetry(i, j);
            let [(a, b), (c, d)] = ordered;
            Drive { planes: ordered, coefficient, rate: coefficient * spin.get(a, b) * spin.get(c, d) }
        })
        .collect();
    let shares_axis = |(a, b): (usize, usize)| a == i || a == j || b == i || b == j;
    PlaneEquation {
        plane: (i, j),
        moment: top.plane_moment(i, j),
        rate: drives.iter().map(|drive| drive.rate).sum(),
        drives,
        never_driven_by: planes::all(N).filter(|&plane| !shares_axis(plane)).collect(),
    }
}

impl PlaneEquation {
    /// The equation in words: `"dω_xy/dt = 0.142857 ω_xz ω_yz + 0.142857 ω_xw ω_yw, never driven by zw"`.
    #[must_use]
    pub fn to_text(&self) -> String {
        let name = |(i, j): (usize, usize)| planes::name(i, j);
        let mut text = format!("dω_{}/dt =", name(self.plane));
        for (index, drive) in self.drives.iter().enumerate() {
            let sign = match (drive.coefficient < 0.0, index) {
                (true, _) => " −",
                (false, 0) => "",
                (false, _) => " +",
            };
            let [first, second] = drive.planes.map(name);
            // Writing to a string cannot fail.
            let _ = write!(text, "{sign} {:.6} ω_{first} ω_{second}", drive.coefficient.abs());
        }
        if self.drives.is_empty() {
            text.push_str(" 0");
        }
        if !self.never_driven_by.is_empty() {
            let names: Vec<String> = self.never_driven_by.iter().copied().map(name).collect();
            let _ = write!(text, ", never driven by {}", names.join(" "));
        }
        text
    }
}
