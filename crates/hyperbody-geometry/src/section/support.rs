//! Sections of convex bodies that are known by their support function alone.
//!
//! The farthest point of K ∩ H in a direction u of H follows from the shadow of K on the plane of u and the normal n: a
//! convex set whose upper boundary is wanted at height 0 over H. Two points of K, one below H and one above, bracket it; the
//! chord between them meets H in a point of K ∩ H, and the farthest point of K across the chord replaces one of the two or
//! shows that there is nothing beyond. The shadow of a polytope ends after as many steps as it has edges there; on a smooth
//! one the chord halves and the error falls to a quarter at each step. This is the dual form of
//! h_{K∩H}(u) = min over λ of h_K(u + λn) − λc (R. T. Rockafellar, "Convex Analysis", 1970, §16).

use std::sync::Arc;

use hyperbody_math::Vector;

use super::{SectionFunction, SliceFrame, density, measure};
use crate::{Convex, Core, Polytope};

/// A bounded convex body in its own frame.
pub trait SupportMap<const N: usize>: std::fmt::Debug + Send + Sync {
    /// A point of the body farthest in `direction`, which is not zero and may have any length.
    fn support(&self, direction: Vector<N>) -> Vector<N>;

    /// The volume of the section by the hyperplane of all points p with normal·p = offset, in m^(N−1), to within about
    /// `tolerance`, in m^(N−1) too. The normal is a unit vector. Bodies with a formula of their own use it.
    fn section_volume(&self, normal: Vector<N>, offset: f64, tolerance: f64) -> f64 {
        measure::section_by_support(self, normal, offset, tolerance)
    }

    /// The volume in m^N, to within about `tolerance`, in m^N.
    fn volume(&self, tolerance: f64) -> f64 {
        measure::volume_by_support(self, tolerance)
    }
}

impl<const N: usize> SupportMap<N> for Convex<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        self.core.support(direction) + direction.normalize_or_zero() * self.radius
    }

    fn section_volume(&self, normal: Vector<N>, offset: f64, tolerance: f64) -> f64 {
        match &self.core {
            Core::Point => density::of_ball(N, self.radius, offset),
            Core::Segment { half } => density::of_capsule(*half, self.radius, normal, offset, tolerance),
            Core::Box { .. } | Core::Polytope(_) => match SectionFunction::of_convex(self, normal) {
                Some(function) => function.at(offset),
                None => measure::section_by_support(self, normal, offset, tolerance),
            },
        }
    }
}

impl<const N: usize> SupportMap<N> for Polytope<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        self.vertices()[self.support_vertex(direction)]
    }
}

/// Most steps of one search: the error of a smooth body falls by 4 at each, that of a polytope to zero.
const MAX_STEPS: usize = 100;

/// Gap between the bounds, in parts of the extent of the body, at which the search ends.
const RELATIVE_GAP: f64 = 1e-14;

/// The section of a body by a hyperplane, in the coordinates of the frame. `M` is `N − 1`.
#[derive(Clone, Debug)]
pub(super) struct SupportOfSection<const N: usize> {
    body: Arc<dyn SupportMap<N>>,
    frame: SliceFrame<N>,
    /// Farthest points of the body below and above the hyperplane.
    ends: [Vector<N>; 2],
}

impl<const N: usize> SupportOfSection<N> {
    /// `None` if the hyperplane does not cut the inside of the body.
    pub(super) fn new(body: &Arc<dyn SupportMap<N>>, frame: &SliceFrame<N>) -> Option<Self> {
        let normal = frame.normal();
        let ends = [body.support(-normal), body.support(normal)];
        let [below, above] = ends.map(|end| frame.height(end));
        let cuts = below < 0.0 && above > 0.0 && (above - below).is_finite();
        cuts.then(|| Self { body: Arc::clone(body), frame: *frame, ends })
    }

    /// The point of the section farthest along the unit vector `along` in the hyperplane, as a point of space.
    fn farthest(&self, along: Vector<N>) -> Vector<N> {
        let height = |point| self.frame.height(point);
        let support = |direction| self.body.support(direction);
        farthest_at_height(support, height, self.frame.normal(), self.ends, along, RELATIVE_GAP)
    }
}

/// A farthest point of the body on one side of the hyperplane.
#[derive(Clone, Copy)]
struct End<const N: usize> {
    point: Vector<N>,
    height: f64,
    /// The direction in which it is the farthest, and its height as the next guess sees it.
    direction: Vector<N>,
    weight: f64,
}

/// The point at height zero farthest along the unit vector `along`, which is orthogonal to the unit `normal` of the
/// hyperplane, of the body with the given support function. `ends` are its farthest points below and above, and `relative_gap` is
/// what may be left between the bounds, in parts of their distance.
///
/// Two guesses take turns. Across the chord: exact on flat parts, and a bound on what is left. Between the directions of the two
/// ends, in proportion to their heights (the method "Illinois" of M. Dowell and P. Jarratt, 1971): fast on curved parts.
pub(super) fn farthest_at_height<const N: usize>(
    support: impl Fn(Vector<N>) -> Vector<N>,
    height: impl Fn(Vector<N>) -> f64,
    normal: Vector<N>,
    ends: [Vector<N>; 2],
    along: Vector<N>,
    relative_gap: f64,
) -> Vector<N> {
    let [low, high] = ends.map(&height);
    let mut bracket = [
        End { point: ends[0], height: low, direction: -normal, weight: low },
        End { point: ends[1], height: high, direction: normal, weight: high },
    ];
    let enough = relative_gap * ends[0].distance(ends[1]);
    // The first direction is `along` itself: where the body is widest, one step is enough.
    let mut across = along;
    let mut by_chord = false;
    let mut last_side = None;
    for step in 0..MAX_STEPS {
        let point = support(across);
        let above = height(point);
        let gap = across.dot(point - bracket[0].point).min(across.dot(point - bracket[1].point));
        let side = usize::from(above > 0.0);
        bracket[side] = End { point, height: above, direction: across, weight: above };
        if last_side == Some(side) {
            bracket[1 - side].weight *= 0.5;
        }
        last_side = Some(side);
        let chord = bracket[1].point - bracket[0].point;
        let (run, rise) = (chord.dot(along), bracket[1].height - bracket[0].height);
        let done = above.abs() <= enough || (by_chord && gap <= enough);
        if done || rise <= enough {
            break;
        }
        by_chord = step % CHORD_EVERY < 2;
        let [below, above] = &bracket;
        // Across the chord, in the plane of `along` and the normal, and outward because rise > 0.
        let next = if by_chord {
            along * rise - normal * run
        } else {
            below.direction * above.weight - above.direction * below.weight
        };
        across = next.normalize_or_zero();
    }
    let [below, above] = bracket;
    let rise = above.height - below.height;
    if rise > 0.0 { below.point.lerp(above.point, -below.height / rise) } else { below.point }
}

/// Of so many guesses two are across the chord.
const CHORD_EVERY: usize = 5;

/// The same as seen from the hyperplane; a type of its own, because a struct cannot say `N − 1`.
#[derive(Clone, Debug)]
pub(super) struct InHyperplane<const N: usize, const M: usize>(pub(super) SupportOfSection<N>);

impl<const N: usize, const M: usize> SupportMap<M> for InHyperplane<N, M> {
    fn support(&self, direction: Vector<M>) -> Vector<M> {
        let along = self.0.frame.direction_to_space(direction).normalize_or_zero();
        self.0.frame.to_slice(self.0.farthest(along))
    }

    fn volume(&self, tolerance: f64) -> f64 {
        let SupportOfSection { body, frame, .. } = &self.0;
        body.section_volume(frame.normal(), frame.offset(), tolerance)
    }
}

/// The shadow of a body on a hyperplane: as far in every direction of the hyperplane as the body.
#[derive(Clone, Debug)]
pub(crate) struct InShadow<const N: usize, const M: usize> {
    body: Arc<dyn SupportMap<N>>,
    frame: SliceFrame<N>,
}

impl<const N: usize, const M: usize> InShadow<N, M> {
    pub(crate) const fn new(body: Arc<dyn SupportMap<N>>, frame: SliceFrame<N>) -> Self {
        Self { body, frame }
    }
}

impl<const N: usize, const M: usize> SupportMap<M> for InShadow<N, M> {
    fn support(&self, direction: Vector<M>) -> Vector<M> {
        self.frame.to_slice(self.body.support(self.frame.direction_to_space(direction)))
    }
}
