//! Every tolerance and every bound on a loop of this crate, each with its reason.
//!
//! Tolerances are pure numbers; where they compare lengths they are multiplied by the size of the shapes at hand, so
//! that a scene in millimetres behaves as one in kilometres.

/// Squared length, relative to that of its factors, below which the product of two directions counts as none: the
/// directions are parallel to 1e-7, and what is left has at least nine correct digits above it.
pub const PARALLEL_SQ: f64 = 1e-14;

/// How much shallower, in parts of the depth, a mixed axis (edge against edge and its kin) has to be than the best
/// facet normal to be preferred. Near-parallel edges span axes close to a facet normal that change abruptly from step
/// to step; a facet gives a patch that stays. The reported depth is at most this much above the least one.
pub const FACET_PREFERENCE_RELATIVE: f64 = 0.05;

/// The absolute part of the same preference, in parts of the smaller shape's least half-extent: keeps the facet when
/// the depth is near zero and a relative comparison means nothing.
pub const FACET_PREFERENCE_ABSOLUTE: f64 = 1e-3;

/// How much better, in the same unit, an axis has to be than the one that won in the previous step.
pub const HYSTERESIS: f64 = 5e-4;

/// A direction this close to a facet's normal (an angle of 1e-6, squared) *is* that normal, which moves no point of the
/// other shape by more than a millionth of its size. Where the other shape is the larger one the angle is smaller by as
/// much, so that it is a millionth of the smaller shape's size.
pub const SNAP_ANGLE_SQ: f64 = 1e-12;

/// How much better aligned with the normal b's facet has to be than a's to serve as the reference, so that the choice
/// does not flicker between two parallel facets.
pub const REFERENCE_PREFERENCE: f64 = 1e-3;

/// Distance from a clipping plane, in parts of the size of the shapes, within which a vertex lies on it: a few
/// hundred roundings of a coordinate.
pub const ON_PLANE: f64 = 1e-12;

/// Separation beyond the least one, in parts of the size of the shapes, up to which a point of a patch is as deep as
/// the deepest when points are chosen.
pub const EQUAL_DEPTH: f64 = 1e-4;

/// Height below the farthest vertex, in parts of the polytope's size, up to which another is as far when the facet of
/// the previous step is to be kept: a fraction of [`SHOWS`].
pub const SAME_HEIGHT: f64 = 1e-5;

/// How much less deep than its normal says a patch may be and still show the contact, in parts of the size of the
/// smaller shape; to this comes [`FACET_PREFERENCE_RELATIVE`] of the depth. A patch that falls short is completed by
/// the closest or deepest points.
pub const SHOWS: f64 = 5e-5;

/// How much larger a distance has to be (as a factor on its square) to displace a point that was chosen in the
/// previous step.
pub const COHERENCE_GAIN: f64 = 1.1;

/// A column this short, in parts of its original length, after taking away what earlier columns explain is dependent
/// on them: flat boxes of 1e-3 by 1e3 stay a million times above it.
pub const DEPENDENT: f64 = 1e-12;

/// Distance of two cores, in parts of their size, below which they touch and the direction between their closest
/// points is mostly rounding.
pub const TOUCHING: f64 = 1e-9;

/// Relative gap between the upper and the lower bound on a distance at which the search ends. The angle of the normal
/// is then right to the root of it.
pub const GJK_RELATIVE_GAP: f64 = 1e-14;

/// The absolute part of the same, in parts of the shapes' size: a few roundings of a vertex.
pub const GJK_ABSOLUTE_GAP: f64 = 1e-15;

/// Gap between the same bounds, in parts of the shapes' size, above which the search turns on, up to as many times as
/// there are dimensions, though rounding hides that it comes closer: a thousand roundings of a vertex.
pub const GJK_STALL_GAP: f64 = 1e-12;

/// How much less than the distance of two cores, in parts of their size, the direction between their closest points may
/// certify before a better one is looked for.
pub const CERTIFIED: f64 = 1e-10;

/// How far, in parts of their size, cores are pushed into each other to find that direction.
pub const PUSH: f64 = 1e-6;

/// Bound on the turns of the distance search. The most seen over the fuzzing is less than a third of it.
pub const MAX_GJK_TURNS: u32 = 128;

/// Two vertices or planes closer than this, in parts of the shapes' size, are one when the difference of two shapes is
/// filled from inside.
pub const EPA_GAP: f64 = 1e-10;

/// Ratio of the least to the largest pivot below which N points span no hyperplane worth the name.
pub const FLAT_SIMPLEX: f64 = 1e-9;

/// Bound on the vertices that the penetration search adds.
pub const MAX_EPA_VERTICES: usize = 512;

/// Bound on the facets that the penetration search makes: about a megabyte of them.
pub const MAX_EPA_FACETS: usize = 16_384;

/// Bound on the turns of the descent that takes over where the penetration search ends at its bounds.
pub const MAX_DESCENT_TURNS: u32 = 32;

/// From how many facets of the penetration search that ended at its bounds descents start.
pub const DESCENT_STARTS: u32 = 24;

/// Up to how many pairs of faces a query looks at, where the penetration search ended at its bounds, for the depth by
/// separating axes: tens of milliseconds.
pub const MAX_FACE_PAIRS: u64 = 20_000;

/// Up to how many facets of a polytope its faces are listed for that.
pub const MAX_AXES_FACETS: usize = 256;

/// The same of its vertices: products of polygons have few facets and many faces between.
pub const MAX_AXES_VERTICES: usize = 256;

/// How often in a row a normal that won before, and is still the best in its neighbourhood, may win again without a
/// full search: because no way out can be shorter than [`RECHECK_FRACTION`] of its depth, or because the overlap is
/// [`SHALLOW`], so that no way out can be shorter by more than that.
pub const RECHECK_AFTER: u32 = 16;

/// See [`RECHECK_AFTER`].
pub const RECHECK_FRACTION: f64 = 0.5;

/// See [`RECHECK_AFTER`]; in parts of the lesser inner radius of the shapes.
pub const SHALLOW: f64 = 0.05;

/// How far apart sideways two capsules' axes may be at the ends of their common stretch, in parts of the sum of their
/// radii, to touch at both ends: beyond, the round surfaces fall away from each other.
pub const ASIDE: f64 = 0.02;

/// Gap to a rounded solid at which a ray has arrived, in parts of the solid's size: a few roundings of a point.
pub const RAY_GAP: f64 = 1e-15;

/// Bound on the turns of a ray against a rounded solid. A grazing ray halves its distance each turn, so this covers
/// every bit of a number.
pub const MAX_RAY_TURNS: u32 = 64;

/// Largest coordinate in a query, m. Squares and products of such lengths are far from the largest numbers, so that nothing
/// overflows on the way to an answer.
pub const FARTHEST: f64 = 1e30;

/// Least and greatest largest component of a ray's direction: fractions up to [`FARTHEST`] metres away are numbers.
pub const RAY_LENGTHS: std::ops::RangeInclusive<f64> = 1e-200..=1e200;

/// Slack when a ray is clipped against the boxes of the tree, relative: three roundings each way (T. Ize, "Robust BVH
/// ray traversal", 2013).
pub const RAY_BOX_SLACK: f64 = 1e-15;

/// Gap at which a moving shape has arrived, in parts of the size of both shapes: twice [`TOUCHING`], within which the
/// distance search cannot tell touching from overlap.
pub const CAST_GAP: f64 = 2e-9;

/// Bound on the turns of a shape cast. Without turning it takes as many as a ray; each radian that a shape turns closely
/// past another costs a few.
pub const MAX_CAST_TURNS: u32 = 1024;
