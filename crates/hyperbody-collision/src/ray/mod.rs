//! Rays against shapes: where a half-line first meets a solid, in any dimension.
//!
//! A ray is origin + t·direction for 0 ≤ t ≤ `max_fraction`; the direction has any length. Every shape is a closed solid
//! and has its own method:
//!
//! | shape | method |
//! |---|---|
//! | half-space | one division |
//! | box, polytope | clip the ray against the slabs or facets (Cyrus and Beck 1978) |
//! | ball, capsule | a quadratic from the point of closest approach, where nothing cancels (Haines et al. 2019) |
//! | rounded box, rounded polytope | Newton's method on the distance to the core, which is convex along the ray |
//!
//! A ray that starts inside a solid hits it at once: at fraction 0, with `inside` set and no normal. Origins on the
//! surface count as inside, also of a ray that leaves or runs along it, unless the ray goes in through it, which is an
//! ordinary hit at fraction 0.
//!
//! Tried and dropped: fixed-step conservative advancement, which needs some thirty distances for a ray that passes close
//! by; Newton's method needs three to five and never steps over the surface.

mod flat;
mod round;
mod rounded;

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, Shape};
use hyperbody_math::{Pose, Vector};

use crate::limits::{FARTHEST, RAY_LENGTHS};

/// The points origin + t·direction with 0 ≤ t ≤ `max_fraction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<const N: usize> {
    /// Where it starts, m. Coordinates within ±[`FARTHEST`].
    pub origin: Vector<N>,
    /// Where it goes; fractions count in its length. Of any length, the largest component within [`RAY_LENGTHS`]: from
    /// 1e-200 to 1e200.
    pub direction: Vector<N>,
    /// How far it goes, in lengths of the direction; ≥ 0, may be infinite.
    pub max_fraction: f64,
}

/// Where a ray first meets a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit<const N: usize> {
    /// The point is origin + fraction·direction.
    pub fraction: f64,
    /// The point.
    pub point: Vector<N>,
    /// Outward unit normal of the surface there; zero if `inside`.
    pub normal: Vector<N>,
    /// The facet of a polytope; of a box 2·axis, plus 1 on the positive side. `None` on round surfaces (rounded edges
    /// included), half-spaces, and if `inside`.
    pub facet: Option<u32>,
    /// Which part of a compound; 0 for every other shape.
    pub part: u32,
    /// The ray starts inside the solid: the fraction is 0 and there is no normal.
    pub inside: bool,
}

impl<const N: usize> Ray<N> {
    /// A ray without end.
    #[must_use]
    pub fn new(origin: impl Into<Vector<N>>, direction: impl Into<Vector<N>>) -> Self {
        Self { origin: origin.into(), direction: direction.into(), max_fraction: f64::INFINITY }
    }

    /// The segment from one point (fraction 0) to another (fraction 1).
    #[must_use]
    pub fn between(from: impl Into<Vector<N>>, to: impl Into<Vector<N>>) -> Self {
        let from = from.into();
        Self { origin: from, direction: to.into() - from, max_fraction: 1.0 }
    }

    /// The same ray up to another fraction.
    #[must_use]
    pub fn up_to(mut self, max_fraction: f64) -> Self {
        self.max_fraction = max_fraction;
        self
    }

    /// origin + fraction·direction.
    #[inline]
    #[must_use]
    pub fn at(&self, fraction: f64) -> Vector<N> {
        self.origin + self.direction * fraction
    }

    /// Whether the numbers make a ray: origin and direction within their ranges, which leaves out a direction of zero and
    /// numbers that are not finite, and the end not negative or NaN. Casts of any other ray hit nothing.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.origin.max_abs() <= FARTHEST && RAY_LENGTHS.contains(&self.direction.max_abs()) && self.max_fraction >= 0.0
    }

    /// The same ray with a direction whose squares are ordinary numbers, and what the fractions of `self` have to be
    /// multiplied by to be those of the new ray: a power of two, so that nothing is rounded, and 1 for ordinary directions.
    /// `None` for rays that are not valid.
    #[must_use]
    pub fn evened(&self) -> Option<(Self, f64)> {
        if !self.is_valid() {
            return None;
        }
        let largest = self.direction.max_abs();
        if (1e-60..=1e60).contains(&largest) {
            return Some((*self, 1.0));
        }
        // The power of two below: the same exponent, and no digits.
        let scale = f64::from_bits(largest.to_bits() & 0x7ff0_0000_0000_0000);
        let direction = Vector(self.direction.0.map(|component| component / scale));
        Some((Self { origin: self.origin, direction, max_fraction: self.max_fraction * scale }, scale))
    }

    /// The same ray as seen from a frame.
    #[inline]
    #[must_use]
    pub fn seen_from(&self, world_from_frame: &Pose<N>) -> Self {
        Self {
            origin: world_from_frame.inverse_transform_point(self.origin),
            direction: world_from_frame.rotation.inverse_rotate(self.direction),
            max_fraction: self.max_fraction,
        }
    }
}

impl<const N: usize> RayHit<N> {
    /// A hit at the origin of a ray that starts inside.
    pub(crate) fn inside(ray: &Ray<N>) -> Self {
        Self { fraction: 0.0, point: ray.origin, normal: Vector::ZERO, facet: None, part: 0, inside: true }
    }

    pub(crate) fn outside(ray: &Ray<N>, fraction: f64, normal: Vector<N>, facet: Option<u32>) -> Self {
        Self { fraction, point: ray.at(fraction), normal, facet, part: 0, inside: false }
    }

    /// The same hit, found by a ray seen from a frame, in the frame of the ray itself.
    #[inline]
    #[must_use]
    pub fn in_world(&self, world_from_frame: &Pose<N>) -> Self {
        Self {
            point: world_from_frame.transform_point(self.point),
            normal: world_from_frame.rotation.rotate(self.normal),
            ..*self
        }
    }
}

/// The first hit of a ray on a piece, both in the frame of the piece. Rays that are not [valid](Ray::is_valid) are the
/// caller's business: they may give a hit that makes no sense, but no panic; so may directions that are
/// not [evened](Ray::evened).
#[inline]
#[must_use]
pub fn cast_on_piece<const N: usize>(ray: &Ray<N>, piece: &Piece<N>) -> Option<RayHit<N>> {
    match piece {
        Piece::HalfSpace { normal, offset } => flat::half_space(ray, *normal, *offset),
        Piece::Convex(Convex { core, radius }) => match core {
            Core::Point => round::ball(ray, *radius),
            Core::Segment { half } => round::capsule(ray, *half, *radius),
            Core::Box { half_extents } if *radius == 0.0 => flat::cuboid(ray, half_extents),
            Core::Polytope(polytope) if *radius == 0.0 => flat::polytope(ray, polytope),
            Core::Box { half_extents } => rounded::cuboid(ray, half_extents, *radius),
            Core::Polytope(polytope) => rounded::polytope(ray, core, polytope, *radius),
        },
    }
}

/// The first hit of a ray on a shape at `world_from_shape`. Of a compound's parts that are hit at the same fraction the
/// first one counts. Rays that are not [valid](Ray::is_valid) hit nothing.
///
/// ```
/// use hyperbody_collision::ray::{Ray, cast};
/// use hyperbody_geometry::Shape;
/// use hyperbody_math::Pose;
/// let tesseract = Shape::<4>::cuboid([0.5; 4])?;
/// let ray = Ray::new([-2.0, 0.1, 0.2, 0.3], [1.0, 0.0, 0.0, 0.0]);
/// let hit = cast(&ray, &tesseract, &Pose::IDENTITY).expect("it goes right through");
/// assert_eq!((hit.fraction, hit.normal.0), (1.5, [-1.0, 0.0, 0.0, 0.0]));
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
#[must_use]
pub fn cast<const N: usize>(ray: &Ray<N>, shape: &Shape<N>, world_from_shape: &Pose<N>) -> Option<RayHit<N>> {
    let (mut ray, scale) = ray.evened()?;
    let mut first: Option<RayHit<N>> = None;
    for (index, (shape_from_piece, piece)) in shape.pieces().iter().enumerate() {
        let world_from_piece = *world_from_shape * *shape_from_piece;
        let Some(hit) = cast_on_piece(&ray.seen_from(&world_from_piece), piece) else { continue };
        if first.is_none_or(|best| hit.fraction < best.fraction) {
            ray.max_fraction = hit.fraction;
            first = Some(RayHit { part: index as u32, ..hit.in_world(&world_from_piece) });
        }
    }
    first.map(|hit| RayHit { fraction: hit.fraction / scale, ..hit })
}
