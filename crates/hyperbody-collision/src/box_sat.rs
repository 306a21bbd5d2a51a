//! Separating axes of two boxes in `N` dimensions.
//!
//! A facet of the Minkowski difference of two polytopes is the sum of a face of dimension m_a of A and one of dimension
//! m_b of B with m_a + m_b = N − 1, so its normal is the dual of (m_a axes of A) ∧ (m_b axes of B): C(2N, N−1) directions
//! for two boxes (Vandermonde), 4, 15, 56, 210 and 792 for N = 2..=6.
//!
//! No exterior algebra is needed to find them. Written in A's axes, a direction orthogonal to m_a of them lives in the
//! other m_b + 1, where it is the generalised cross product of m_b columns of C = R_Aᵀ R_B. As the smaller of m_a and
//! m_b is at most 2 for N ≤ 6, every axis is, in one of the two frames, a coordinate axis, a perpendicular of a
//! 2-vector or a cross product of two 3-vectors.
//!
//! Known in 3D from Gottschalk, Lin and Manocha (1996); "edge × edge" is the family (1, 1) of it.

use hyperbody_math::{Matrix, Pose, Vector};

use crate::limits;

/// Which axis separates best: what the next step should prefer among equals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Feature {
    /// None known.
    #[default]
    None,
    /// A facet normal of a.
    FacetOfA,
    /// A facet normal of b.
    FacetOfB,
    /// A direction of lower faces of both.
    Mixed,
}

/// One separating axis of two boxes.
#[derive(Clone, Copy, Debug)]
pub struct BoxAxis<const N: usize> {
    /// Unit, in a's frame, from a to b.
    pub normal: Vector<N>,
    /// Along the normal; minus the depth if the boxes overlap. For disjoint boxes a lower bound on their distance.
    pub separation: f64,
    /// Where the normal comes from.
    pub feature: Feature,
}

/// The best separating axes of two boxes.
#[derive(Clone, Copy, Debug)]
pub struct BoxSeparation<const N: usize> {
    /// The one to build a contact on.
    pub best: BoxAxis<N>,
    /// The one with the greatest separation; the same unless a facet normal was preferred to it.
    pub least: BoxAxis<N>,
    /// Number of axes looked at: all of them unless one separated by more than was asked.
    pub axes_tried: u32,
}

/// Number of axes in `n` dimensions: C(2n, n−1).
#[must_use]
pub const fn axis_count(n: u32) -> u32 {
    let mut count = 1;
    let mut k = 0;
    while k < n - 1 {
        count = count * (2 * n - k) / (k + 1);
        k += 1;
    }
    count
}

/// The two boxes as one of them sees them.
struct Frame<const N: usize> {
    /// Entry (i, j): own axis i dot foreign axis j.
    cosines: [[f64; N]; N],
    /// From the own centre to the foreign one.
    offset: [f64; N],
    own: [f64; N],
    foreign: [f64; N],
}

/// The best axis of one family so far: its unit direction in the frame it was found in.
#[derive(Clone, Copy)]
struct Best<const N: usize> {
    separation: f64,
    direction: Vector<N>,
}

impl<const N: usize> Best<N> {
    const NONE: Self = Self { separation: f64::NEG_INFINITY, direction: Vector::ZERO };
}

/// The axis with the greatest separation (the least depth) of two boxes with half-extents `half_a`, `half_b`, b being
/// placed by `a_from_b`. Facet normals are preferred to mixed axes, a's to b's, and `previous` to the others, each by a
/// small tolerance ([`limits::FACET_PREFERENCE_RELATIVE`], [`limits::FACET_PREFERENCE_ABSOLUTE`],
/// [`limits::HYSTERESIS`]). Stops at the first axis that separates by more than `stop_above`.
#[must_use]
pub fn separate_boxes<const N: usize>(
    half_a: &Vector<N>,
    half_b: &Vector<N>,
    a_from_b: &Pose<N>,
    stop_above: f64,
    previous: Feature,
) -> BoxSeparation<N> {
    let pair = BoxPair::new(half_a, half_b, a_from_b);
    let facet = pair.best_facet(previous);
    let facets = 2 * N as u32;
    if facet.separation > stop_above {
        return BoxSeparation { best: facet, least: facet, axes_tried: facets };
    }
    let mut separation = pair.best_of_all(facet, stop_above, previous);
    separation.axes_tried += facets;
    separation
}

/// Two boxes as both of them see them.
pub(crate) struct BoxPair<const N: usize> {
    from_a: Frame<N>,
    from_b: Frame<N>,
    /// The least half-extent of both.
    pub(crate) thickness: f64,
}

impl<const N: usize> BoxPair<N> {
    pub(crate) fn new(half_a: &Vector<N>, half_b: &Vector<N>, a_from_b: &Pose<N>) -> Self {
        let cosines = a_from_b.rotation.matrix();
        let from_b = -cosines.transpose_mul(a_from_b.translation);
        let least = |half: &Vector<N>| half.iter().fold(f64::INFINITY, f64::min);
        Self {
            from_a: Frame { cosines: cosines.0, offset: a_from_b.translation.0, own: half_a.0, foreign: half_b.0 },
            from_b: Frame { cosines: cosines.transpose().0, offset: from_b.0, own: half_b.0, foreign: half_a.0 },
            thickness: least(half_a).min(least(half_b)),
        }
    }

    /// What b's frame calls a direction towards a, in a's frame and towards b.
    fn to_a(&self, direction: Vector<N>) -> Vector<N> {
        -(Matrix(self.from_a.cosines) * direction)
    }

    fn bonus(&self, feature: Feature, previous: Feature) -> f64 {
        if feature == previous { limits::HYSTERESIS * self.thickness } else { 0.0 }
    }

    /// The facet normal of either box with the greatest separation.
    pub(crate) fn best_facet(&self, previous: Feature) -> BoxAxis<N> {
        let (a, b) = (self.from_a.facets(), self.from_b.facets());
        let preference = limits::HYSTERESIS * self.thickness;
        let prefer_b = b.separation + self.bonus(Feature::FacetOfB, previous)
            > a.separation + self.bonus(Feature::FacetOfA, previous) + preference;
        if prefer_b {
            BoxAxis { normal: self.to_a(b.direction), separation: b.separation, feature: Feature::FacetOfB }
        } else {
            BoxAxis { normal: a.direction, separation: a.separation, feature: Feature::FacetOfA }
        }
    }

    /// The best axis of all, the best facet normal being known.
    pub(crate) fn best_of_all(&self, facet: BoxAxis<N>, stop_above: f64, previous: Feature) -> BoxSeparation<N> {
        let mut axes_tried = 0;
        let mixed = self.best_mixed(stop_above, &mut axes_tried);
        let allowance = limits::FACET_PREFERENCE_RELATIVE * facet.separation.abs()
            + limits::FACET_PREFERENCE_ABSOLUTE * self.thickness;
        let least = if mixed.separation > facet.separation { mixed } else { facet };
        let leaves = mixed.separation + self.bonus(Feature::Mixed, previous) > facet.separation + allowance;
        BoxSeparation { best: if leaves { mixed } else { facet }, least, axes_tried }
    }

    /// The axis with the greatest separation that is not a facet normal.
    fn best_mixed(&self, stop_above: f64, tried: &mut u32) -> BoxAxis<N> {
        let mut best = BoxAxis { normal: Vector::ZERO, separation: f64::NEG_INFINITY, feature: Feature::Mixed };
        for (frame, is_b) in [(&self.from_a, false), (&self.from_b, true)] {
            let mut found = Best { separation: best.separation, ..Best::NONE };
            // (N − 1 − k) own axes and k foreign ones; the middle family of odd N is counted once.
            let counted = |k: usize| if is_b { 2 * k < N - 1 } else { 2 * k < N };
            if counted(1) {
                frame.one_foreign(&mut found, stop_above, tried);
            }
            if counted(2) && found.separation <= stop_above {
                frame.two_foreign(&mut found, stop_above, tried);
            }
            if found.separation > best.separation {
                best.separation = found.separation;
                best.normal = if is_b { self.to_a(found.direction) } else { found.direction };
            }
            if best.separation > stop_above {
                break;
            }
        }
        best
    }
}

impl<const N: usize> Frame<N> {
    /// The best own facet normal.
    #[inline]
    fn facets(&self) -> Best<N> {
        let mut best = Best::NONE;
        let mut along = 0;
        for i in 0..N {
            let mut radius = self.own[i];
            for k in 0..N {
                radius += self.foreign[k] * self.cosines[i][k].abs();
            }
            let separation = self.offset[i].abs() - radius;
            if separation > best.separation {
                best.separation = separation;
                along = i;
            }
        }
        best.direction[along] = if self.offset[along] < 0.0 { -1.0 } else { 1.0 };
        best
    }

    /// Axes orthogonal to one foreign axis and all but two own ones.
    #[inline]
    fn one_foreign(&self, best: &mut Best<N>, stop_above: f64, tried: &mut u32) {
        for p in 0..N {
            for q in p + 1..N {
                let (row_p, row_q) = (&self.cosines[p], &self.cosines[q]);
                for j in 0..N {
                    let (x, y) = (row_q[j], -row_p[j]);
                    let mut radius = self.own[p] * x.abs() + self.own[q] * y.abs();
                    for k in 0..N {
                        radius += self.foreign[k] * (x * row_p[k] + y * row_q[k]).abs();
                    }
                    let along = x * self.offset[p] + y * self.offset[q];
                    let length_sq = x * x + y * y;
                    if let Some(scale) = improves(best, along, radius, length_sq) {
                        best.direction = Vector::ZERO;
                        best.direction[p] = x * scale;
                        best.direction[q] = y * scale;
                    }
                }
                *tried += N as u32;
                if best.separation > stop_above {
                    return;
                }
            }
        }
    }

    /// Axes orthogonal to two foreign axes and all but three own ones.
    #[inline]
    fn two_foreign(&self, best: &mut Best<N>, stop_above: f64, tried: &mut u32) {
        for p in 0..N {
            for q in p + 1..N {
                for r in q + 1..N {
                    self.cross_products([p, q, r], best, tried);
                    if best.separation > stop_above {
                        return;
                    }
                }
            }
        }
    }

    /// The axes of [`Frame::two_foreign`] that live in three given own coordinates.
    #[inline]
    fn cross_products(&self, [p, q, r]: [usize; 3], best: &mut Best<N>, tried: &mut u32) {
        let (row_p, row_q, row_r) = (&self.cosines[p], &self.cosines[q], &self.cosines[r]);
        for j in 0..N {
            for l in j + 1..N {
                let x = row_q[j] * row_r[l] - row_r[j] * row_q[l];
                let y = row_r[j] * row_p[l] - row_p[j] * row_r[l];
                let z = row_p[j] * row_q[l] - row_q[j] * row_p[l];
                let mut radius = self.own[p] * x.abs() + self.own[q] * y.abs() + self.own[r] * z.abs();
                for k in 0..N {
                    radius += self.foreign[k] * (x * row_p[k] + y * row_q[k] + z * row_r[k]).abs();
                }
                let along = x * self.offset[p] + y * self.offset[q] + z * self.offset[r];
                let length_sq = x * x + y * y + z * z;
                if let Some(scale) = improves(best, along, radius, length_sq) {
                    best.direction = Vector::ZERO;
                    best.direction[p] = x * scale;
                    best.direction[q] = y * scale;
                    best.direction[r] = z * scale;
                }
                *tried += 1;
            }
        }
    }
}

/// Takes note of an axis of the given squared length if it separates better; returns the factor that makes it a unit
/// vector on which the offset is positive. Axes of parallel directions have no length and are skipped: facet normals
/// or other mixed axes bound the same faces.
#[inline]
fn improves<const N: usize>(best: &mut Best<N>, along: f64, radius: f64, length_sq: f64) -> Option<f64> {
    let gap = along.abs() - radius;
    let scale = 1.0 / length_sq.sqrt();
    let separation = gap * scale;
    if length_sq > limits::PARALLEL_SQ && separation > best.separation {
        best.separation = separation;
        return Some(if along < 0.0 { -scale } else { scale });
    }
    None
}
