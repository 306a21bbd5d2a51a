//! Pyramids over shapes of one dimension less: over polytopes ordinary pyramids, over curved shapes cones.
//!
//! With the base B of K = N − 1 dimensions in the hyperplane z = −h/2 and the apex over its origin at z = h/2, a point is
//! (s·b, h/2 − s·h) with b in B and s from 0 to 1, and the volume element is h s^K. Volume, centre and second moments are those of
//! the base times ∫s^K, ∫s^(K+1) and ∫s^(K+2); sections are one integral over s of those of the base.

use std::sync::Arc;

use hyperbody_math::{Matrix, Pose, Vector};

use crate::error::GeometryErrorKind::{BadCount, Unsupported};
use crate::mass::MassProperties;
use crate::product::pieces::{FactorPiece, in_place};
use crate::product::{ConvexFactor, Factor};
use crate::quadrature::integrate_between;
use crate::section::SupportMap;
use crate::shape::check_length;
use crate::{GeometryError, Polytope, Result, Shape};

/// A pyramid over a curved base: a cone. Contacts see a pyramid over a polytope close to the base, while support, mass and
/// sections are exact.
#[derive(Clone, Debug)]
pub struct Pyramid<const N: usize> {
    base: ConvexFactor,
    /// The axis of the height.
    up: usize,
    height: f64,
    faceted: Arc<Polytope<N>>,
}

impl<const N: usize> Pyramid<N> {
    /// The polytope that contacts see.
    #[must_use]
    pub fn faceted(&self) -> &Arc<Polytope<N>> {
        &self.faceted
    }

    /// How far the surface of that polytope is from that of the pyramid at most, in metres.
    #[must_use]
    pub fn faceting(&self) -> f64 {
        self.base.faceting()
    }

    /// Base and height, to be stored.
    pub(crate) fn definition(&self) -> (&ConvexFactor, f64) {
        (&self.base, self.height)
    }

    fn apex(&self) -> Vector<N> {
        Vector::unit(self.up) * (0.5 * self.height)
    }

    /// Mass properties at unit density.
    pub(crate) fn unit_properties(&self) -> MassProperties<N> {
        let (h, n) = (self.height, N as f64);
        let volume = self.base.volume() * h / n;
        // Means of s and s² over the volume.
        let (mean, mean_sq) = (n / (n + 1.0), n / (n + 2.0));
        let (base_centre, base_second) = self.base.placed_moments::<N>();
        let centre = base_centre * mean + Vector::unit(self.up) * (0.5 * h - mean * h);
        let mut raw = (base_second + Matrix::outer(base_centre, base_centre)) * mean_sq;
        let tilt = base_centre * (0.5 * h * mean - h * mean_sq);
        for axis in 0..N {
            raw[axis][self.up] += tilt[axis];
            raw[self.up][axis] += tilt[axis];
        }
        raw[self.up][self.up] += h * h * (0.25 - mean + mean_sq);
        MassProperties { mass: volume, centre, second_moments: (raw - Matrix::outer(centre, centre)) * volume }
    }
}

impl<const N: usize> SupportMap<N> for Pyramid<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        let mut point = Vector::unit(self.up) * (-0.5 * self.height);
        self.base.support(direction, &mut point);
        if point.dot(direction) > self.apex().dot(direction) { point } else { self.apex() }
    }

    /// ∫ h s^(K−1)/α · S((c/s + n_z h)/α) ds, where S is the section function of the base along its part of the normal, of length
    /// α, and c the offset less that of the apex.
    fn section_volume(&self, normal: Vector<N>, offset: f64, tolerance: f64) -> f64 {
        let (h, rise) = (self.height, normal[self.up]);
        let from_apex = offset - self.apex().dot(normal);
        let powers = N as i32 - 2;
        let Some(term) = self.base.term(normal) else {
            let s = -from_apex / (rise * h);
            return if (0.0..=1.0).contains(&s) { s.powi(powers + 1) * self.base.volume() } else { 0.0 };
        };
        let at = |s: f64| (from_apex / s + rise * h) / term.weight;
        // Where the base begins and ends to be met.
        let mut breaks = vec![0.0, 1.0];
        breaks.extend(term.range.iter().map(|end| from_apex / (term.weight * end - rise * h)));
        breaks.retain(|s| (0.0..=1.0).contains(s));
        breaks.sort_unstable_by(f64::total_cmp);
        let met = |pair: &&[f64]| {
            let middle = at(0.5 * (pair[0] + pair[1]));
            pair[1] > pair[0] && middle > term.range[0] && middle < term.range[1]
        };
        let scale = h / term.weight;
        let part = |pair: &[f64]| {
            integrate_between(pair[0], pair[1], tolerance, |s| {
                if s > 0.0 { scale * s.powi(powers) * (term.section)(at(s), 0.1 * tolerance / scale) } else { 0.0 }
            })
        };
        breaks.windows(2).filter(met).map(part).sum()
    }
}

impl<const N: usize> Shape<N> {
    /// The pyramid over a base of `N − 1` dimensions, `height` metres high along the one axis that the base does not have: the
    /// base lies at −height/2 there and the apex, over the origin of the base, at height/2. A polytope if the base is one, and
    /// otherwise a [`Shape::Pyramid`], a cone. A base of several pieces makes a compound of the pyramids over them.
    ///
    /// # Errors
    /// `BadCount` if the base has not all axes but one; `BadNumber` if the height is no length; `Unsupported` if a curved part of the
    /// base stands beside the origin; otherwise as [`Polytope::from_points`].
    ///
    /// ```
    /// use hyperbody_geometry::Shape;
    /// use hyperbody_geometry::product::Factor;
    /// let disc = Factor::new([0, 2], &Shape::<2>::ball(0.5)?)?;
    /// let cone = Shape::<3>::pyramid(disc, 1.2)?;
    /// let volume = cone.mass_properties(1.0)?.mass;
    /// assert!((volume - std::f64::consts::PI * 0.25 * 1.2 / 3.0).abs() < 1e-12);
    /// # Ok::<(), hyperbody_geometry::GeometryError>(())
    /// ```
    pub fn pyramid(base: Factor, height: f64) -> Result<Self> {
        let height = check_length("the height of a pyramid", height)?;
        let mut axes = base.axes().to_vec();
        axes.sort_unstable();
        axes.dedup();
        let missing: Vec<usize> = (0..N).filter(|axis| !axes.contains(axis)).collect();
        let ([up], true) = (&missing[..], axes.iter().all(|&axis| axis < N)) else {
            return Err(GeometryError::new(
                BadCount,
                format!("the base of a pyramid has the axes {axes:?}: it needs all but one of the {N}"),
            ));
        };
        in_place(base.pieces().iter().map(|piece| over_piece(piece, *up, height)).collect::<Result<_>>()?)
    }
}

/// The pyramid over one piece of the base, and where it stands. A flat piece lies where it stands, because all have one apex.
fn over_piece<const N: usize>(piece: &FactorPiece, up: usize, height: f64) -> Result<(Pose<N>, Shape<N>)> {
    let pose = piece.pose::<N>();
    if piece.convex.is_flat() {
        let vertices = piece.convex.faceted_vertices::<N>();
        let placed = vertices.into_iter().map(|vertex| pose.transform_point(vertex)).collect();
        return Ok((Pose::IDENTITY, Shape::polytope(Arc::new(over_points(placed, up, height)?))?));
    }
    if !piece.is_centred() {
        let message =
            "a curved part of the base of a pyramid stands beside the origin, over which the apex is: move it there";
        return Err(GeometryError::new(Unsupported, message));
    }
    let base = piece.convex.clone();
    let points = base.faceted_vertices::<N>();
    let count = points.len();
    let mut polytope = over_points(points, up, height)?;
    if polytope.vertices().len() == count + 1 {
        polytope = polytope.standing_for(base.round_part(1, count).into_iter().collect());
    }
    Ok((pose, Shape::Pyramid(Arc::new(Pyramid { base, up, height, faceted: Arc::new(polytope) }))))
}

/// The pyramid over the hull of points.
fn over_points<const N: usize>(mut points: Vec<Vector<N>>, up: usize, height: f64) -> Result<Polytope<N>> {
    points.iter_mut().for_each(|point| point[up] = -0.5 * height);
    points.push(Vector::unit(up) * (0.5 * height));
    Polytope::from_points(&points)
}
