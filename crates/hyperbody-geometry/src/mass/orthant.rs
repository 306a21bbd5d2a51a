//! Solid angles of simplicial cones in any dimension.
//!
//! A normal vector y with independent components points into a cone with the probability that is the cone's share of
//! the full angle. For a simplicial cone these are the y with all coordinates positive in the basis of its edges, so it
//! is the probability that m correlated normal variables are all positive. In two and three dimensions that is a sum
//! of angles; from there on R. L. Plackett's reduction (Biometrika 41, 1954; for volumes of spherical simplices it is
//! L. Schläfli's formula). One variable y_i is first made independent of the others, P = ½ P(the others positive), and
//! then tied to them again by correlations t r_ij, t = 0 … 1:
//!
//! dP/dt = Σ_j r_ij / (2π √(1 − t² r_ij²)) · P(the other m − 2 positive | y_i = y_j = 0).
//!
//! That is one integral of elementary functions for m = 4 and 5, and one of such integrals for m = 6. Cubature on the
//! sphere was dropped: far more points for far fewer digits.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use hyperbody_math::{Matrix, Vector, scalar};

use super::normals::orthogonal_part;
use crate::quadrature::integrate;

/// How far the two rules of [`integrate`] may be apart on an interval; a probability is then good to 1e-13 or so.
const TOLERANCE: f64 = 1e-11;

/// Shares of the full angle that cones take in their spans. Where they are integrals, they are remembered: the cones of
/// a regular polytope are congruent in their thousands.
#[derive(Default)]
pub(super) struct ConeShares {
    known: BTreeMap<Vec<i64>, f64>,
}

impl ConeShares {
    /// The share of the cone with these m unit edges.
    pub(super) fn share<const N: usize>(&mut self, edges: &[Vector<N>]) -> f64 {
        let m = edges.len();
        // Coordinate i in the basis of the edges grows along what edge i has orthogonal to all others. (By way of the
        // inverse Gram matrix, the condition of a narrow cone would count twice.)
        let mut r = Matrix::<N>::IDENTITY;
        let mut heights = [Vector::ZERO; N];
        for i in 0..m {
            let mut basis: Vec<Vector<N>> = Vec::with_capacity(m);
            for j in (0..m).filter(|&j| j != i) {
                basis.push(orthogonal_part(edges[j], &basis).normalize_or_zero());
            }
            heights[i] = orthogonal_part(edges[i], &basis).normalize_or_zero();
            for j in 0..i {
                r[i][j] = heights[i].dot(heights[j]);
                r[j][i] = r[i][j];
            }
        }
        if m < 4 {
            return probability(&r, m);
        }
        *self.known.entry(congruence_class(&r, m)).or_insert_with(|| probability(&r, m))
    }
}

/// The same list for all orders of the same variables, and for correlations that differ by rounding only: the least
/// one over all orders.
fn congruence_class<const N: usize>(r: &Matrix<N>, m: usize) -> Vec<i64> {
    // Not halfway between simple fractions, so that rounding does not separate equal ones.
    let rounded = |x: f64| (x * 1e12 + 0.37).floor() as i64;
    let mut best: Vec<i64> = Vec::new();
    let mut order: Vec<usize> = (0..m).collect();
    loop {
        let list: Vec<i64> =
            (0..m).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| rounded(r[order[i]][order[j]])).collect();
        if best.is_empty() || list < best {
            best = list;
        }
        // The next permutation in lexicographic order.
        let Some(rise) = (1..m).rev().find(|&i| order[i - 1] < order[i]) else {
            return best;
        };
        let Some(larger) = (rise..m).rev().find(|&i| order[i] > order[rise - 1]) else {
            return best;
        };
        order.swap(rise - 1, larger);
        order[rise..].reverse();
    }
}

/// The probability that normal variables with these correlations (leading m×m block) are all positive.
fn probability<const N: usize>(r: &Matrix<N>, m: usize) -> f64 {
    match m {
        0 => 1.0,
        1 => 0.5,
        2 => 0.25 + asin(r[0][1]) / (2.0 * PI),
        3 => 0.125 + (asin(r[0][1]) + asin(r[0][2]) + asin(r[1][2])) / (4.0 * PI),
        _ => {
            let Some((freed, branch)) = most_independent(r, m) else {
                return 0.0;
            };
            // t = t* − s² turns square roots at t* into analytic functions.
            let (from, to) = ((branch - 1.0).max(0.0).sqrt(), branch.sqrt());
            let integral = integrate(TOLERANCE, |x| {
                let s = from + (to - from) * x;
                2.0 * s * derivative(r, m, freed, branch - s * s)
            });
            0.5 * probability(&without(r, m, freed), m - 1) + (to - from) * integral
        }
    }
}

/// The variable that can be freed with the smoothest integrand, and the t* ≥ 1 on its path where the correlations turn
/// singular and the integrand has a branch point: t*² = 1/(1 − 1/(r⁻¹)_ii).
fn most_independent<const N: usize>(r: &Matrix<N>, m: usize) -> Option<(usize, f64)> {
    let block = Matrix::<N>::from_fn(|i, j| if i < m && j < m { r[i][j] } else { f64::from(u8::from(i == j)) });
    let inverse = block.try_inverse()?;
    let freed = (0..m).min_by(|&i, &j| inverse[i][i].total_cmp(&inverse[j][j]))?;
    // Beyond 2 it is too far away to matter.
    let dependence = (1.0 - 1.0 / inverse[freed][freed]).clamp(0.25, 1.0);
    Some((freed, 1.0 / dependence.sqrt()))
}

/// dP/dt where the correlations of one variable are t times what they will be.
fn derivative<const N: usize>(r: &Matrix<N>, m: usize, freed: usize, t: f64) -> f64 {
    let mut partly = *r;
    for i in (0..m).filter(|&i| i != freed) {
        partly[freed][i] *= t;
        partly[i][freed] *= t;
    }
    let mut sum = 0.0;
    for other in (0..m).filter(|&i| i != freed && r[freed][i] != 0.0) {
        let c = partly[freed][other];
        let root = ((1.0 - c) * (1.0 + c)).max(f64::MIN_POSITIVE).sqrt();
        sum += r[freed][other] / root * probability(&conditional(&partly, m, freed, other), m - 2);
    }
    sum / (2.0 * PI)
}

/// Correlations of the other variables, in order, where variables i and j are zero.
fn conditional<const N: usize>(r: &Matrix<N>, m: usize, i: usize, j: usize) -> Matrix<N> {
    let others: [usize; N] = others_than(m, [i, j]);
    let c = r[i][j];
    let scale = 1.0 / ((1.0 - c) * (1.0 + c)).max(f64::MIN_POSITIVE);
    let mut covariance = Matrix::IDENTITY;
    for a in 0..m - 2 {
        for b in 0..m - 2 {
            let (k, l) = (others[a], others[b]);
            let product = r[k][i] * r[l][i] + r[k][j] * r[l][j] - c * (r[k][i] * r[l][j] + r[k][j] * r[l][i]);
            covariance[a][b] = r[k][l] - scale * product;
        }
    }
    correlations(&covariance, m - 2)
}

/// Correlations of the other variables, in order.
fn without<const N: usize>(r: &Matrix<N>, m: usize, freed: usize) -> Matrix<N> {
    let others: [usize; N] = others_than(m, [freed, freed]);
    let mut rest = Matrix::IDENTITY;
    for a in 0..m - 1 {
        for b in 0..m - 1 {
            rest[a][b] = r[others[a]][others[b]];
        }
    }
    rest
}

/// The indices below m that are not among these, in order, and zeros.
fn others_than<const N: usize>(m: usize, left_out: [usize; 2]) -> [usize; N] {
    let mut others = [0; N];
    for (slot, k) in (0..m).filter(|k| !left_out.contains(k)).enumerate() {
        others[slot] = k;
    }
    others
}

fn correlations<const N: usize>(covariance: &Matrix<N>, m: usize) -> Matrix<N> {
    let mut r = Matrix::IDENTITY;
    for i in 0..m {
        for j in (0..m).filter(|&j| j != i) {
            let scale = (covariance[i][i] * covariance[j][j]).max(f64::MIN_POSITIVE).sqrt();
            r[i][j] = (covariance[i][j] / scale).clamp(-1.0, 1.0);
        }
    }
    r
}

fn asin(sine: f64) -> f64 {
    scalar::atan2(sine, ((1.0 - sine) * (1.0 + sine)).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All correlations 1/2, as of x_i − x_0 with independent x: P is the chance 1/(m + 1) that x_0 is the smallest.
    fn check<const N: usize>() {
        let equal = |value: f64| Matrix::<N>::from_fn(|i, j| if i == j { 1.0 } else { value });
        let expected = 1.0 / (N as f64 + 1.0);
        assert!((probability(&equal(0.5), N) / expected - 1.0).abs() < 1e-12);
        assert!((probability(&Matrix::<N>::IDENTITY, N) - 0.5_f64.powi(N as i32)).abs() < 1e-15);
        // Fully dependent variables: P = 1/2 for equal ones, approached like the square root of 1 − r.
        if N < 6 {
            let nearly = probability(&equal(1.0 - 1e-8), N);
            assert!((0.4995..0.5).contains(&nearly), "{nearly}");
        }
        // Independent blocks multiply.
        let blocks = Matrix::<N>::from_fn(|i, j| {
            if i == j {
                1.0
            } else if i < 2 && j < 2 {
                -0.7
            } else {
                0.0
            }
        });
        let product = probability(&blocks, 2) * 0.5_f64.powi(N as i32 - 2);
        assert!((probability(&blocks, N) / product - 1.0).abs() < 1e-12);
    }

    #[test]
    fn known_cones_have_their_share() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }

    /// The N + 1 cones over the facets of any simplex around the origin fill the space.
    fn fans<const N: usize>() {
        let mut edges: Vec<Vector<N>> = (0..N).map(Vector::unit).collect();
        edges.push(Vector::from_fn(|i| -1.0 - 0.4 * i as f64).normalize_or_zero());
        for tilt in [0.0, 0.3, -0.2] {
            edges[0][N - 1] = tilt;
            let total: f64 = (0..=N)
                .map(|skip| {
                    let cone: Vec<Vector<N>> =
                        (0..=N).filter(|&i| i != skip).map(|i| edges[i].normalize_or_zero()).collect();
                    ConeShares::default().share(&cone)
                })
                .sum();
            assert!((total - 1.0).abs() < 1e-12, "{total}");
        }
    }

    #[test]
    fn cones_of_a_fan_add_up_to_everything() {
        fans::<2>();
        fans::<3>();
        fans::<4>();
        fans::<5>();
        fans::<6>();
    }
}
