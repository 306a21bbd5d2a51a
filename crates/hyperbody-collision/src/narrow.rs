//! The narrow phase: the contacts of one pair of pieces.

use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};

use crate::box_sat::Feature;
use crate::gjk::Seeds;
use crate::half_space;
use crate::inner_hull::InnerHull;
use crate::manifold::Manifold;
use crate::pair::Pair;
use crate::patch::{PatchMemory, PatchScratch};

/// What is worth keeping of a pair from one step to the next. Start with the default; give the same cache to the same
/// pair in the same order. Results with and without a history differ only within the tolerances of [`crate::limits`].
#[derive(Clone, Debug, Default)]
pub struct PairCache<const N: usize> {
    /// Unit, in a's frame, from a to b; zero if nothing is known.
    pub(crate) normal: Vector<N>,
    /// Where the normal of an overlap came from; `None` while the pair is disjoint.
    pub(crate) feature: Feature,
    /// Number of the facet that the normal came from.
    pub(crate) facet: u32,
    /// Steps since the way out of an overlap was last confirmed by the full search.
    pub(crate) unconfirmed: u32,
    /// Vertices that made up the closest points or the facet of the difference.
    pub(crate) seeds: Seeds,
    pub(crate) patch: PatchMemory,
}

/// Working memory of [`collide`], to be kept so that nothing is allocated once it has grown. One per thread; its
/// contents never influence a result.
#[derive(Clone, Debug, Default)]
pub struct Scratch<const N: usize> {
    pub(crate) patch: PatchScratch<N>,
    pub(crate) hull: InnerHull<N>,
    pub(crate) effort: Effort,
}

impl<const N: usize> Scratch<N> {
    /// The most that any call with this scratch has taken.
    #[must_use]
    pub fn effort(&self) -> Effort {
        Effort { patch_vertices: self.patch.most_vertices, ..self.effort }
    }
}

/// Largest numbers of turns seen, to be held against the bounds in [`crate::limits`], and how often each method ran.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Turns of one distance search, at most [`crate::limits::MAX_GJK_TURNS`].
    pub gjk_turns: u32,
    /// Vertices of one penetration search, at most [`crate::limits::MAX_EPA_VERTICES`] and the first simplex.
    pub epa_vertices: u32,
    /// Facets of one penetration search, about [`crate::limits::MAX_EPA_FACETS`] at most.
    pub epa_facets: u32,
    /// Vertices of one patch before it was reduced.
    pub patch_vertices: u32,
    /// Turns of one shape cast, at most [`crate::limits::MAX_CAST_TURNS`].
    pub cast_turns: u32,
    /// Turns of one descent of the depth, at most [`crate::limits::MAX_DESCENT_TURNS`].
    pub descent_turns: u32,
    /// Distance searches run.
    pub gjk_runs: u64,
    /// Penetration searches run.
    pub epa_runs: u64,
    /// Penetration searches that ended at their bounds.
    pub epa_unfinished: u64,
    /// Contacts held by the closest or deepest points because the facets' projections did not show them.
    pub witness_points: u64,
}

impl Effort {
    /// The larger of each maximum, the sum of each count.
    #[must_use]
    pub fn merged(&self, other: &Self) -> Self {
        Self {
            gjk_turns: self.gjk_turns.max(other.gjk_turns),
            epa_vertices: self.epa_vertices.max(other.epa_vertices),
            epa_facets: self.epa_facets.max(other.epa_facets),
            patch_vertices: self.patch_vertices.max(other.patch_vertices),
            cast_turns: self.cast_turns.max(other.cast_turns),
            descent_turns: self.descent_turns.max(other.descent_turns),
            gjk_runs: self.gjk_runs + other.gjk_runs,
            epa_runs: self.epa_runs + other.epa_runs,
            epa_unfinished: self.epa_unfinished + other.epa_unfinished,
            witness_points: self.witness_points + other.witness_points,
        }
    }
}

/// Finds the contacts of piece `a` at `world_from_a` with piece `b` at `world_from_b` and puts them into `out`, whatever
/// it held before. Points up to `margin` (≥ 0, in metres) apart are reported too. The normal points from a to b.
///
/// Never panics: poses that are not finite, and two half-spaces, give no contact.
#[expect(clippy::too_many_arguments, reason = "two pieces with their poses, the caller's memory and the result")]
pub fn collide<const N: usize>(
    a: &Piece<N>,
    world_from_a: &Pose<N>,
    b: &Piece<N>,
    world_from_b: &Pose<N>,
    margin: f64,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    out.clear();
    if !(is_finite(world_from_a) && is_finite(world_from_b)) {
        *cache = PairCache::default();
        return;
    }
    match (a, b) {
        (Piece::HalfSpace { .. }, Piece::HalfSpace { .. }) => {}
        (Piece::Convex(shape), Piece::HalfSpace { normal, offset }) => {
            let plane = plane_in_world(world_from_b, *normal, *offset);
            let reducer = &mut scratch.patch.reducer;
            half_space::collide(shape, world_from_a, plane, margin, &cache.patch, reducer, out);
            out.normal = -out.normal;
        }
        (Piece::HalfSpace { normal, offset }, Piece::Convex(shape)) => {
            let plane = plane_in_world(world_from_a, *normal, *offset);
            let reducer = &mut scratch.patch.reducer;
            half_space::collide(shape, world_from_b, plane, margin, &cache.patch, reducer, out);
        }
        (Piece::Convex(a), Piece::Convex(b)) => {
            Pair::new(a, world_from_a, b, world_from_b, margin).collide(cache, scratch, out);
        }
    }
    cache.patch.remember(out);
    if out.is_empty() {
        out.normal = Vector::ZERO;
    }
}

/// Whether every number of the pose is finite: a sum of products with zero is zero only then.
#[inline]
pub(crate) fn is_finite<const N: usize>(pose: &Pose<N>) -> bool {
    let mut sum = 0.0;
    for i in 0..N {
        sum += pose.translation[i] * 0.0;
        for j in 0..N {
            sum += pose.rotation.matrix()[i][j] * 0.0;
        }
    }
    sum == 0.0
}

pub(crate) fn plane_in_world<const N: usize>(
    world_from_piece: &Pose<N>,
    normal: Vector<N>,
    offset: f64,
) -> (Vector<N>, f64) {
    let normal = world_from_piece.rotation.rotate(normal);
    (normal, offset + normal.dot(world_from_piece.translation))
}
