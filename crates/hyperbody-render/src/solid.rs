//! A convex piece of a body as the slice sees it: a map from slice coordinates to the frame of the piece, and bounds.
//!
//! A ray in the slice is a ray of the world, so the exact ray query of the piece answers for its section, whatever the
//! dimension; only the bounds are found in three dimensions.

use hyperbody::collision::point;
use hyperbody::collision::query::pieces_overlap;
use hyperbody::collision::ray::{Ray, RayHit, cast_on_piece};
use hyperbody::geometry::shape::Piece;
use hyperbody::geometry::{Aabb, Convex, Core};
use hyperbody::math::{Pose, Vector};

use crate::slice::Slice;

/// A convex piece in slice coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Solid<const N: usize> {
    /// Number of the body, for colours.
    pub(crate) body: u32,
    pub(crate) part: u32,
    pub(crate) piece: Piece<N>,
    /// Images of the three seen directions in the frame of the piece.
    seen: [Vector<N>; 3],
    /// The slice's point in the frame of the piece.
    origin: Vector<N>,
    /// In two dimensions bodies are tiles, which reach this far along the third direction of the picture to both sides.
    half_thickness: f64,
}

/// Thickness of tiles, in parts of their size.
const TILE: f64 = 0.5;

/// Steps of a search for a bound. Each shrinks the interval by 0.62; a bound that is a little loose costs time only.
const BOUND_STEPS: u32 = 16;

impl<const N: usize> Solid<N> {
    /// The piece at a pose seen from slice coordinates.
    pub(crate) fn new(body: u32, part: u32, piece: Piece<N>, piece_from_slice: &Pose<N>) -> Self {
        let matrix = piece_from_slice.rotation.matrix();
        let column = |k: usize| if k < N { Vector::from_fn(|i| matrix[i][k]) } else { Vector::ZERO };
        let half_thickness = match &piece {
            Piece::Convex(convex) => TILE * convex.bounding_radius(),
            Piece::HalfSpace { .. } => f64::INFINITY,
        };
        let seen = [column(0), column(1), column(2)];
        Self { body, part, piece, seen, origin: piece_from_slice.translation, half_thickness }
    }

    /// A point of the slice in the frame of the piece.
    #[inline]
    pub(crate) fn local_point(&self, point: Vector<3>) -> Vector<N> {
        self.origin + self.local_direction(point)
    }

    #[inline]
    fn local_direction(&self, direction: Vector<3>) -> Vector<N> {
        self.seen[0] * direction[0] + self.seen[1] * direction[1] + self.seen[2] * direction[2]
    }

    /// A normal of the frame of the piece as seen in the slice, by a ray along `direction`: its part along the seen
    /// directions, of any length. Tiles are seen from both sides.
    #[inline]
    pub(crate) fn seen_normal(&self, normal: Vector<N>, direction: Vector<3>) -> Vector<3> {
        if N == 2 && normal == Vector::ZERO {
            return Vector::unit(2) * if direction[2] > 0.0 { -1.0 } else { 1.0 };
        }
        Vector([self.seen[0].dot(normal), self.seen[1].dot(normal), self.seen[2].dot(normal)])
    }

    /// The first hit of a ray in the slice, in the frame of the piece.
    #[inline]
    pub(crate) fn cast(&self, ray: &Ray<3>, reach: f64) -> Option<RayHit<N>> {
        let local = Ray {
            origin: self.local_point(ray.origin),
            direction: self.local_direction(ray.direction),
            max_fraction: reach,
        };
        if N == 2 { self.cast_on_tile(ray, &local) } else { cast_on_piece(&local, &self.piece) }
    }

    /// The first hit on a tile: its rim, where the ray is in the tile's thickness there, or its face, whose normal is
    /// given as zero, for it has none in the plane.
    fn cast_on_tile(&self, ray: &Ray<3>, local: &Ray<N>) -> Option<RayHit<N>> {
        let (height, rise) = (ray.origin[2], ray.direction[2]);
        let face = self.half_thickness * if height < 0.0 { -1.0 } else { 1.0 };
        let to_face = (face - height) / rise;
        if height.abs() > self.half_thickness && to_face >= 0.0 && to_face <= local.max_fraction {
            let point = local.at(to_face);
            if point::contains(&self.piece, point) {
                return Some(RayHit {
                    fraction: to_face,
                    point,
                    normal: Vector::ZERO,
                    facet: None,
                    part: 0,
                    inside: false,
                });
            }
        }
        let rim = cast_on_piece(local, &self.piece)?;
        ((height + rim.fraction * rise).abs() <= self.half_thickness).then_some(rim)
    }
}

/// How far a piece reaches along a direction of slice coordinates.
fn reach<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>, direction: Vector<N>) -> f64 {
    let local = piece_from_slice.rotation.rotate(direction);
    convex.core.support(local).dot(local) + convex.radius * direction.norm() - local.dot(piece_from_slice.translation)
}

/// The interval that a piece takes up along slice coordinate `k`.
pub(crate) fn extent<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>, k: usize) -> [f64; 2] {
    let axis = Vector::unit(k);
    [-reach(convex, piece_from_slice, -axis), reach(convex, piece_from_slice, axis)]
}

/// A box in slice coordinates around the section of a piece; `None` if the slice does not cut it.
///
/// On the section the hidden coordinates y_h are zero, so that y_k = y_k + λ·y_h ≤ the reach along e_k + λ·e_h for every
/// λ: the least of these bounds, which are convex in λ, is the tight one (Lagrange duality), and any λ gives a valid one.
/// With several hidden directions the descent may stop short of it, so there a miss is found by [`lies_beside`].
pub(crate) fn section_bounds<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>) -> Option<Aabb<3>> {
    for hidden in Slice::<N>::SEEN..N {
        let [low, high] = extent(convex, piece_from_slice, hidden);
        if low > 0.0 || high < 0.0 {
            return None;
        }
    }
    if N > Slice::<N>::SEEN + 1 && lies_beside(convex, piece_from_slice) {
        return None;
    }
    let (mut lower, mut upper) = (Vector::ZERO, Vector::ZERO);
    for k in 0..Slice::<N>::SEEN {
        upper[k] = least_reach(convex, piece_from_slice, Vector::unit(k));
        lower[k] = -least_reach(convex, piece_from_slice, -Vector::unit(k));
        if lower[k] > upper[k] {
            return None;
        }
    }
    if N == 2 {
        upper[2] = TILE * convex.bounding_radius();
        lower[2] = -upper[2];
    }
    let margin = 1e-9 * (1.0 + upper.max_abs().max(lower.max_abs()));
    Some(Aabb { lower, upper }.grown(margin))
}

/// Whether the slice misses a piece: whether its shadow along the seen directions, a convex set of the hidden coordinates,
/// leaves out the origin. By the nearest point of the shadow (J. von Neumann's algorithm, in G. B. Dantzig, 1992): each turn
/// moves towards the extreme point against the nearest one known, until that extreme point proves the separation.
fn lies_beside<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>) -> bool {
    let hide = |y: Vector<N>| Vector::<N>::from_fn(|i| if i < Slice::<N>::SEEN { 0.0 } else { y[i] });
    let mut nearest = hide(piece_from_slice.inverse_transform_point(Vector::ZERO));
    for _ in 0..SHADOW_STEPS {
        let length = nearest.norm();
        if length <= 1e-12 * convex.bounding_radius() {
            return false;
        }
        let against = piece_from_slice.rotation.rotate(nearest * (-1.0 / length));
        let extreme = convex.core.support(against) + against * convex.radius;
        let extreme = hide(piece_from_slice.inverse_transform_point(extreme));
        if extreme.dot(nearest) > 0.0 {
            return true;
        }
        let along = extreme - nearest;
        let share = -nearest.dot(along) / along.norm_sq().max(f64::MIN_POSITIVE);
        nearest += along * share.clamp(0.0, 1.0);
    }
    is_apart_from_slab(convex, piece_from_slice)
}

/// Turns of the search for the nearest point of a shadow; a miss by a hundredth of the size takes fewer.
const SHADOW_STEPS: usize = 256;

/// Half the thickness of the slab that stands for the slice where a miss is narrow, in radii of the piece.
const SLAB: f64 = 1e-9;

/// Whether a piece misses the part of the slice around it, by the engine's own search for the distance of two bodies: slower
/// than the search for a shadow's nearest point, and right for narrow misses too.
fn is_apart_from_slab<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>) -> bool {
    let radius = convex.bounding_radius();
    let half_extents = Vector::from_fn(|i| radius * if i < Slice::<N>::SEEN { 2.0 } else { SLAB });
    let slab = Piece::Convex(Convex { core: Core::Box { half_extents }, radius: 0.0 });
    let slice_from_piece = piece_from_slice.inverse();
    let middle = slice_from_piece.translation;
    let beside = Pose::from_translation(Vector::from_fn(|i| if i < Slice::<N>::SEEN { middle[i] } else { 0.0 }));
    !pieces_overlap(&Piece::Convex(convex.clone()), &slice_from_piece, &slab, &beside)
}

/// The least reach along `axis` + λ·(hidden directions), one λ after the other.
fn least_reach<const N: usize>(convex: &Convex<N>, piece_from_slice: &Pose<N>, axis: Vector<N>) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut direction = axis;
    let mut least = reach(convex, piece_from_slice, direction);
    let rounds = if N > 4 { 2 } else { 1 };
    for hidden in (0..rounds).flat_map(|_| Slice::<N>::SEEN..N) {
        // λ = s/(1 − s²) takes all real values for s in (−1, 1).
        let mut at = |s: f64| {
            let mut trial = direction;
            trial[hidden] = s / (1.0 - s * s);
            let here = reach(convex, piece_from_slice, trial);
            if here < least {
                least = here;
                direction = trial;
            }
            here
        };
        let (mut low, mut high) = (-0.97, 0.97);
        let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
        let (mut at_a, mut at_b) = (at(a), at(b));
        for _ in 0..BOUND_STEPS {
            if at_a <= at_b {
                (high, b, at_b) = (b, a, at_a);
                a = high - golden * (high - low);
                at_a = at(a);
            } else {
                (low, a, at_a) = (a, b, at_b);
                b = low + golden * (high - low);
                at_b = at(b);
            }
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use hyperbody::geometry::Shape;
    use hyperbody::math::{Bivector, Rotation};

    use super::*;

    /// A cube of 5D turned by an eighth in its hidden plane, beside the slice along the hidden diagonal: each hidden coordinate
    /// alone, and each bound along one of them, lets it be cut.
    #[test]
    fn what_lies_beside_the_slice_is_not_cut() {
        let half = 0.5;
        let Piece::Convex(cube) = Shape::<5>::cuboid([half; 5]).unwrap().pieces()[0].1.clone() else {
            panic!("a cube")
        };
        for fraction in [0.3, 0.45, 0.55, 0.75, 0.95] {
            let middle = fraction * 2.0_f64.sqrt() * half;
            let place = Vector([0.1, 0.2, 0.0, middle, middle]);
            let slice_from_piece = Pose::new(Rotation::in_plane(3, 4, std::f64::consts::FRAC_PI_4), place);
            let cut = section_bounds(&cube, &slice_from_piece.inverse()).is_some();
            // Its face looks along the diagonal, at the distance √2·middle − half.
            assert_eq!(cut, 2.0_f64.sqrt() * middle < half, "{fraction}");
        }
    }

    /// A narrow hit and a narrow miss of a cube at any angle in 5D, against the support in every hidden direction.
    #[test]
    fn narrow_misses_are_told_from_narrow_hits() {
        let Piece::Convex(cube) = Shape::<5>::cuboid([0.5, 0.4, 0.3, 0.6, 0.2]).unwrap().pieces()[0].1.clone() else {
            panic!("a cuboid")
        };
        let mut agree = 0;
        for number in 0..40 {
            let mut turn = Bivector::ZERO;
            for (i, j) in (0..5).flat_map(|i| (i + 1..5).map(move |j| (i, j))) {
                turn.set(i, j, (f64::from(number) * 1.7 + i as f64 * 0.9 + j as f64 * 2.3).sin());
            }
            let turned = Rotation::exp(&turn);
            let toward = f64::from(number) * 0.61;
            let direction = |angle: f64| Vector([0.0, 0.0, 0.0, angle.cos(), angle.sin()]);
            // Pushed out along `toward`, the shadow leaves the origin out from the distance on at which, for some hidden
            // direction n, the nearest point along n has passed it.
            let reach = |angle: f64| {
                let local = turned.inverse_rotate(-direction(angle));
                cube.core.support(local).dot(local) / (angle - toward).cos()
            };
            let angles = (-149_999..150_000).map(|step| toward + f64::from(step) * 1e-5);
            let leaving = angles.map(reach).fold(f64::INFINITY, f64::min);
            for (share, cut) in [(1.0 - 1e-4, true), (1.0 + 1e-4, false)] {
                let place = Vector([0.1, 0.2, 0.0, 0.0, 0.0]) + direction(toward) * (leaving * share);
                let piece_from_slice = Pose::new(turned, place).inverse();
                let found = !lies_beside(&cube, &piece_from_slice);
                assert_eq!(found, cut, "turn {number}, at {share} of the distance");
                agree += usize::from(is_apart_from_slab(&cube, &piece_from_slice) != cut);
            }
        }
        assert_eq!(agree, 80, "the slab tells the same");
    }
}
