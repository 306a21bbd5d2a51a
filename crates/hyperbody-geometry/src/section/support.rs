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

use super::SliceFrame;
use crate::{Convex, Polytope};

/// A bounded convex body in its own frame.
pub trait SupportMap<const N: usize>: std::fmt::Debug + Send + Sync {
    /// A point of the body farthest in `direction`, which is not zero and may have any length.
    fn support(&self, direction: Vector<N>) -> Vector<N>;
}

impl<const N: usize> SupportMap<N> for Convex<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        self.core.support(direction) + direction.normalize_or_zero() * self.radius
    }
}

impl<const N: usize> SupportMap<N> for Polytope<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        self.vertices()[self.support_vertex(direction)]
    }
}

/// Most steps of one search: the error of a smooth body falls by 4 at each, that of a polytope to zero.
const MAX_STEPS: usize = 100;

/// Gap between the bounds, in parts of the distance of the bracketing points, at which the search ends.
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
        let normal = self.frame.normal();
        let mut bracket = self.ends.map(|end| (end, self.frame.height(end)));
        // The first direction is `along` itself: where the body is widest, one step is enough.
        let mut across = along;
        for _ in 0..MAX_STEPS {
            let point = self.body.support(across);
            let height = self.frame.height(point);
            let gap = across.dot(point - bracket[0].0).min(across.dot(point - bracket[1].0));
            bracket[usize::from(height > 0.0)] = (point, height);
            let chord = bracket[1].0 - bracket[0].0;
            let (run, rise) = (chord.dot(along), bracket[1].1 - bracket[0].1);
            let length = chord.norm();
            // Across the chord, in the plane of `along` and the normal, and outward because rise > 0.
            let next = along * rise - normal * run;
            if rise <= RELATIVE_GAP * length || (across != along && gap <= RELATIVE_GAP * length) {
                break;
            }
            across = next.normalize_or_zero();
        }
        let [(below, low), (above, high)] = bracket;
        let rise = high - low;
        if rise > 0.0 { below.lerp(above, -low / rise) } else { below }
    }
}

/// The same as seen from the hyperplane; a type of its own, because a struct cannot say `N − 1`.
#[derive(Clone, Debug)]
pub(super) struct InHyperplane<const N: usize, const M: usize>(pub(super) SupportOfSection<N>);

impl<const N: usize, const M: usize> SupportMap<M> for InHyperplane<N, M> {
    fn support(&self, direction: Vector<M>) -> Vector<M> {
        let along = self.0.frame.direction_to_space(direction).normalize_or_zero();
        self.0.frame.to_slice(self.0.farthest(along))
    }
}
