//! Distance and depth of two shapes with the points that show them.
//!
//! Disjoint cores: the distance search of [`crate::gjk`]. Cores that overlap: the penetration search of [`crate::epa`],
//! to the end, so that the depth is the least there is; contacts of the simulation may prefer a facet that is nearly as
//! good. Balls and capsules among each other, and balls against boxes, have closed forms. Rounding a core by r moves its
//! surface by r along every normal, so that radii are subtracted at the end.

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core, Shape};
use hyperbody_math::{Pose, Vector};

use crate::difference::Difference;
use crate::gjk::{self, Proximity, Seeds};
use crate::narrow::{Scratch, plane_in_world};
use crate::query::half_spaces::half_spaces;
use crate::query::in_range;
use crate::query::unsure::{shallower_by_axes, shallower_by_facet, sharpened};
use crate::round::{self, Segment, Witness};
use crate::{general, limits};

/// How two shapes lie to each other, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation<const N: usize> {
    /// m; positive between disjoint shapes. Of overlapping ones minus the depth: the shortest way by which one can be
    /// moved so that they only touch. −∞ where there is no such way, which is so of two half-spaces alone.
    pub distance: f64,
    /// Unit, from a to b: moving b along it by −`distance` makes overlapping shapes touch.
    pub normal: Vector<N>,
    /// The point of a nearest to b, or deepest in it; of half-spaces at a distance of −∞, which have none, that of a's
    /// surface nearest to the origin.
    pub on_a: Vector<N>,
    /// The point of b nearest to a, or deepest in it: `on_a` + `distance`·`normal`, to rounding; at −∞ as for a.
    pub on_b: Vector<N>,
    /// Which part of a compound a; 0 for every other shape.
    pub part_a: u32,
    /// Which part of a compound b.
    pub part_b: u32,
}

/// What [`closest`] finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closest<const N: usize> {
    /// Farther apart than was asked.
    Apart,
    /// Disjoint, or touching at one point at rounding's mercy; the distance is not negative.
    Near(Separation<N>),
    /// They have a point in common.
    Overlapping,
}

impl<const N: usize> Separation<N> {
    /// The same with a and b exchanged.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self {
            distance: self.distance,
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            part_a: self.part_b,
            part_b: self.part_a,
        }
    }

    /// From closest points of two cores in the world.
    pub(super) fn of_cores(witness: &Witness<N>, radius_a: f64, radius_b: f64) -> Self {
        Self {
            distance: witness.separation - radius_a - radius_b,
            normal: witness.normal,
            on_a: witness.on_a + witness.normal * radius_a,
            on_b: witness.on_b - witness.normal * radius_b,
            part_a: 0,
            part_b: 0,
        }
    }
}

/// Whether two shapes have a point in common.
#[must_use]
pub fn overlap<const N: usize>(a: &Shape<N>, world_from_a: &Pose<N>, b: &Shape<N>, world_from_b: &Pose<N>) -> bool {
    let parts_b = b.pieces();
    a.pieces().iter().any(|(inner_a, piece_a)| {
        let pose_a = *world_from_a * *inner_a;
        parts_b.iter().any(|(inner_b, piece_b)| pieces_overlap(piece_a, &pose_a, piece_b, &(*world_from_b * *inner_b)))
    })
}

/// The closest points of two shapes that are at most `up_to` (m, ≥ 0, may be infinite) apart. Two half-spaces overlap
/// unless they face away from each other exactly.
#[must_use]
pub fn closest<const N: usize>(
    a: &Shape<N>,
    world_from_a: &Pose<N>,
    b: &Shape<N>,
    world_from_b: &Pose<N>,
    up_to: f64,
) -> Closest<N> {
    let parts_b = b.pieces();
    let mut best: Option<Separation<N>> = None;
    for (part_a, (inner_a, piece_a)) in a.pieces().iter().enumerate() {
        let pose_a = *world_from_a * *inner_a;
        for (part_b, (inner_b, piece_b)) in parts_b.iter().enumerate() {
            let reach = best.map_or(up_to, |best| best.distance);
            match closest_of_pieces(piece_a, &pose_a, piece_b, &(*world_from_b * *inner_b), reach) {
                Closest::Overlapping => return Closest::Overlapping,
                Closest::Near(found) if best.is_none_or(|best| found.distance < best.distance) => {
                    best = Some(Separation { part_a: part_a as u32, part_b: part_b as u32, ..found });
                }
                Closest::Near(_) | Closest::Apart => {}
            }
        }
    }
    best.map_or(Closest::Apart, Closest::Near)
}

/// Distance or depth of two shapes. Of compounds it is that of the two parts that are closest, or deepest in each other:
/// moving b by it frees these two, but maybe not the others. Depths of polytopes whose Minkowski difference has tens of
/// thousands of facets around the way out, in five and six dimensions, may be those of a way out that is the shortest only
/// among its neighbours ([`crate::limits::MAX_EPA_FACETS`]), unless their pairs of faces are few enough for separating axes
/// ([`crate::limits::MAX_FACE_PAIRS`]). Two half-spaces that
/// do not face away from each other exactly are freed by no way: their distance is −∞. `None` for poses that are not finite,
/// or beyond [`crate::limits::FARTHEST`].
///
/// ```
/// use hyperbody_collision::query::separation;
/// use hyperbody_geometry::Shape;
/// use hyperbody_math::{Pose, Vector};
/// let tesseract = Shape::<4>::cuboid([0.5; 4])?;
/// let beside = Pose::from_translation(Vector([1.25, 0.1, 0.0, 0.0]));
/// let found = separation(&tesseract, &Pose::IDENTITY, &tesseract, &beside).expect("both are bounded");
/// assert!((found.distance - 0.25).abs() < 1e-12 && (found.normal[0] - 1.0).abs() < 1e-12);
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
#[must_use]
pub fn separation<const N: usize>(
    a: &Shape<N>,
    world_from_a: &Pose<N>,
    b: &Shape<N>,
    world_from_b: &Pose<N>,
) -> Option<Separation<N>> {
    let mut scratch = Scratch::default();
    let parts_b = b.pieces();
    let mut best: Option<Separation<N>> = None;
    for (part_a, (inner_a, piece_a)) in a.pieces().iter().enumerate() {
        let pose_a = *world_from_a * *inner_a;
        for (part_b, (inner_b, piece_b)) in parts_b.iter().enumerate() {
            let pose_b = *world_from_b * *inner_b;
            let Some(found) = separation_of_pieces(piece_a, &pose_a, piece_b, &pose_b, &mut scratch) else { continue };
            if best.is_none_or(|best| found.distance < best.distance) {
                best = Some(Separation { part_a: part_a as u32, part_b: part_b as u32, ..found });
            }
        }
    }
    best
}

/// [`overlap`] of two pieces.
#[must_use]
pub fn pieces_overlap<const N: usize>(
    a: &Piece<N>,
    world_from_a: &Pose<N>,
    b: &Piece<N>,
    world_from_b: &Pose<N>,
) -> bool {
    if !(in_range(world_from_a) && in_range(world_from_b)) {
        return false;
    }
    match (a, b) {
        (Piece::Convex(a), Piece::Convex(b)) => {
            !matches!(closest_convex(a, world_from_a, b, world_from_b, 0.0), Closest::Apart)
        }
        _ => matches!(closest_of_pieces(a, world_from_a, b, world_from_b, 0.0), Closest::Overlapping),
    }
}

/// [`closest`] of two pieces.
#[must_use]
pub fn closest_of_pieces<const N: usize>(
    a: &Piece<N>,
    world_from_a: &Pose<N>,
    b: &Piece<N>,
    world_from_b: &Pose<N>,
    up_to: f64,
) -> Closest<N> {
    if !(in_range(world_from_a) && in_range(world_from_b)) {
        return Closest::Apart;
    }
    let judged = |found: Separation<N>| {
        if found.distance <= 0.0 {
            Closest::Overlapping
        } else if found.distance <= up_to {
            Closest::Near(found)
        } else {
            Closest::Apart
        }
    };
    match (a, b) {
        (Piece::Convex(a), Piece::Convex(b)) => closest_convex(a, world_from_a, b, world_from_b, up_to),
        (Piece::Convex(a), Piece::HalfSpace { normal, offset }) => {
            judged(to_half_space(a, world_from_a, plane_in_world(world_from_b, *normal, *offset)))
        }
        (Piece::HalfSpace { normal, offset }, Piece::Convex(b)) => {
            judged(to_half_space(b, world_from_b, plane_in_world(world_from_a, *normal, *offset)).flipped())
        }
        (Piece::HalfSpace { normal: a, offset: offset_a }, Piece::HalfSpace { normal: b, offset: offset_b }) => judged(
            half_spaces(plane_in_world(world_from_a, *a, *offset_a), plane_in_world(world_from_b, *b, *offset_b)),
        ),
    }
}

/// [`separation`] of two pieces.
#[must_use]
pub fn separation_of_pieces<const N: usize>(
    a: &Piece<N>,
    world_from_a: &Pose<N>,
    b: &Piece<N>,
    world_from_b: &Pose<N>,
    scratch: &mut Scratch<N>,
) -> Option<Separation<N>> {
    if !(in_range(world_from_a) && in_range(world_from_b)) {
        return None;
    }
    match (a, b) {
        (Piece::Convex(a), Piece::Convex(b)) => Some(separate_convex(a, world_from_a, b, world_from_b, scratch)),
        (Piece::Convex(a), Piece::HalfSpace { normal, offset }) => {
            Some(to_half_space(a, world_from_a, plane_in_world(world_from_b, *normal, *offset)))
        }
        (Piece::HalfSpace { normal, offset }, Piece::Convex(b)) => {
            Some(to_half_space(b, world_from_b, plane_in_world(world_from_a, *normal, *offset)).flipped())
        }
        (Piece::HalfSpace { normal: a, offset: offset_a }, Piece::HalfSpace { normal: b, offset: offset_b }) => {
            Some(half_spaces(plane_in_world(world_from_a, *a, *offset_a), plane_in_world(world_from_b, *b, *offset_b)))
        }
    }
}

/// A convex piece against the half-space (outward unit normal, offset) in the world; a is the piece.
pub(super) fn to_half_space<const N: usize>(
    convex: &Convex<N>,
    world_from_convex: &Pose<N>,
    (outward, offset): (Vector<N>, f64),
) -> Separation<N> {
    let deepest = convex.core.support(-world_from_convex.rotation.inverse_rotate(outward));
    let on_a = world_from_convex.transform_point(deepest) - outward * convex.radius;
    let distance = outward.dot(on_a) - offset;
    Separation { distance, normal: -outward, on_a, on_b: on_a - outward * distance, part_a: 0, part_b: 0 }
}

/// Closest points of two cores in the world where there is a closed form for them.
fn known<const N: usize>(
    a: &Core<N>,
    world_from_a: &Pose<N>,
    b: &Core<N>,
    world_from_b: &Pose<N>,
) -> Option<Witness<N>> {
    let segment = |core: &Core<N>, pose: &Pose<N>| {
        let half = if let Core::Segment { half } = core { pose.rotation.rotate(*half) } else { Vector::ZERO };
        Segment { middle: pose.translation, half }
    };
    match (a, b) {
        (Core::Point | Core::Segment { .. }, Core::Point | Core::Segment { .. }) => {
            Some(round::segments(&segment(a, world_from_a), &segment(b, world_from_b), Vector::ZERO))
        }
        (core, Core::Point) => {
            let point = world_from_a.inverse_transform_point(world_from_b.translation);
            round::nearest_known(core, point).map(|witness| witness.transformed(world_from_a))
        }
        (Core::Point, core) => {
            let point = world_from_b.inverse_transform_point(world_from_a.translation);
            round::nearest_known(core, point).map(|witness| witness.transformed(world_from_b).flipped())
        }
        _ => None,
    }
}

fn closest_convex<const N: usize>(
    a: &Convex<N>,
    world_from_a: &Pose<N>,
    b: &Convex<N>,
    world_from_b: &Pose<N>,
    up_to: f64,
) -> Closest<N> {
    let rounding = a.radius + b.radius;
    let (witness, overlapping) = match known(&a.core, world_from_a, &b.core, world_from_b) {
        Some(witness) => (witness, witness.separation <= rounding),
        None => {
            let a_from_b = world_from_a.relative(world_from_b);
            let difference = Difference::new(&a.core, &b.core, &a_from_b);
            match gjk::closest(&difference, &Seeds::default(), a_from_b.translation, up_to + rounding, &mut 0) {
                Proximity::Apart { .. } => return Closest::Apart,
                Proximity::Overlap(_) => return Closest::Overlapping,
                Proximity::Near(near) => {
                    let [on_a, on_b] = near.simplex.witnesses(&difference);
                    let witness = Witness { normal: near.normal, on_a, on_b, separation: near.distance };
                    (witness.transformed(world_from_a), near.distance <= rounding)
                }
            }
        }
    };
    if overlapping {
        Closest::Overlapping
    } else if witness.separation > up_to + rounding {
        Closest::Apart
    } else {
        Closest::Near(Separation::of_cores(&witness, a.radius, b.radius))
    }
}

fn separate_convex<const N: usize>(
    a: &Convex<N>,
    world_from_a: &Pose<N>,
    b: &Convex<N>,
    world_from_b: &Pose<N>,
    scratch: &mut Scratch<N>,
) -> Separation<N> {
    if let Some(witness) = known(&a.core, world_from_a, &b.core, world_from_b) {
        return Separation::of_cores(&witness, a.radius, b.radius);
    }
    let a_from_b = world_from_a.relative(world_from_b);
    let difference = Difference::new(&a.core, &b.core, &a_from_b);
    separation_by_difference(&difference, world_from_a, a.radius, b.radius, scratch)
}

/// Distance or depth of two rounded cores by their Minkowski difference alone, in the world.
pub(crate) fn separation_by_difference<const N: usize>(
    difference: &Difference<'_, N>,
    world_from_a: &Pose<N>,
    radius_a: f64,
    radius_b: f64,
    scratch: &mut Scratch<N>,
) -> Separation<N> {
    let witness = by_difference(difference, scratch).transformed(world_from_a);
    Separation::of_cores(&witness, radius_a, radius_b)
}

/// Closest or deepest points of two cores, in a's frame, by the Minkowski difference alone.
fn by_difference<const N: usize>(difference: &Difference<'_, N>, scratch: &mut Scratch<N>) -> Witness<N> {
    let mut turns = 0;
    let toward_b = difference.a_from_b.translation;
    let proximity = gjk::closest(difference, &Seeds::default(), toward_b, f64::INFINITY, &mut turns);
    scratch.effort.gjk_runs += 1;
    scratch.effort.gjk_turns = scratch.effort.gjk_turns.max(turns);
    match proximity {
        Proximity::Near(near) => {
            let [on_a, on_b] = near.simplex.witnesses(difference);
            let witness = Witness { normal: near.normal, on_a, on_b, separation: near.distance };
            let uncertain = near.distance + difference.reach(near.normal) > limits::CERTIFIED * difference.scale;
            if uncertain { sharpened(difference, witness, scratch) } else { witness }
        }
        Proximity::Overlap(simplex) => {
            let found = general::penetrate(difference, &simplex, f64::INFINITY, scratch);
            let witness = general::deepest(difference, &found);
            if found.points.is_none() {
                return witness;
            }
            let by_facet = shallower_by_facet(difference, witness, &mut scratch.effort.descent_turns);
            shallower_by_axes(difference, by_facet)
        }
        // Nothing is farther away than infinity.
        Proximity::Apart { normal } => {
            let [on_a, on_b] = difference.vertices(difference.support(normal).key);
            Witness { normal, on_a, on_b, separation: -difference.reach(normal) }
        }
    }
}
