//! The narrow phase: the contacts of one pair of pieces.

use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core};
use hyperbody_math::{Pose, Vector};

use crate::box_sat::{Feature, separate_boxes};
use crate::half_space;
use crate::manifold::{ContactPoint, Manifold};
use crate::patch::{self, PatchMemory, PatchScratch, Side};
use crate::round::{self, Segment, Witness};

/// What is worth keeping of a pair from one step to the next. Start with the default; give the same cache to the same
/// pair in the same order. Results with and without a history differ only within the tolerances of [`crate::limits`].
#[derive(Clone, Debug, Default)]
pub struct PairCache<const N: usize> {
    /// Unit, in a's frame, from a to b; zero if nothing is known.
    normal: Vector<N>,
    feature: Feature,
    patch: PatchMemory,
}

/// Working memory of [`collide`], to be kept so that nothing is allocated once it has grown. One per thread; its
/// contents never influence a result.
#[derive(Clone, Debug, Default)]
pub struct Scratch<const N: usize> {
    patch: PatchScratch<N>,
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
            Pair { a, b, world_from_a, world_from_b, margin }.collide(cache, scratch, out);
        }
    }
    cache.patch.remember(out);
    if out.is_empty() {
        out.normal = Vector::ZERO;
    }
}

/// Whether every number of the pose is finite: a sum of products with zero is zero only then.
#[inline]
fn is_finite<const N: usize>(pose: &Pose<N>) -> bool {
    let mut sum = 0.0;
    for i in 0..N {
        sum += pose.translation[i] * 0.0;
        for j in 0..N {
            sum += pose.rotation.matrix()[i][j] * 0.0;
        }
    }
    sum == 0.0
}

fn plane_in_world<const N: usize>(world_from_piece: &Pose<N>, normal: Vector<N>, offset: f64) -> (Vector<N>, f64) {
    let normal = world_from_piece.rotation.rotate(normal);
    (normal, offset + normal.dot(world_from_piece.translation))
}

/// Two rounded cores in the world.
struct Pair<'a, const N: usize> {
    a: &'a Convex<N>,
    b: &'a Convex<N>,
    world_from_a: &'a Pose<N>,
    world_from_b: &'a Pose<N>,
    margin: f64,
}

impl<const N: usize> Pair<'_, N> {
    fn collide(&self, cache: &mut PairCache<N>, scratch: &mut Scratch<N>, out: &mut Manifold<N>) {
        let rounding = self.a.radius + self.b.radius;
        if self.apart(cache) {
            return;
        }
        match (&self.a.core, &self.b.core) {
            (Core::Box { half_extents: half_a }, Core::Box { half_extents: half_b }) if rounding == 0.0 => {
                self.boxes(half_a, half_b, cache, scratch, out);
            }
            (Core::Box { half_extents }, Core::Point) => {
                let point = self.world_from_a.inverse_transform_point(self.world_from_b.translation);
                let witness = round::box_and_point(half_extents, point).transformed(self.world_from_a);
                self.single(&witness, cache, out);
            }
            (Core::Point, Core::Box { half_extents }) => {
                let point = self.world_from_b.inverse_transform_point(self.world_from_a.translation);
                let witness = round::box_and_point(half_extents, point).transformed(self.world_from_b);
                self.single(&witness.flipped(), cache, out);
            }
            (core_a, core_b) => {
                if let (Some(half_a), Some(half_b)) = (round::as_segment(core_a), round::as_segment(core_b)) {
                    self.segments(half_a, half_b, cache, out);
                }
            }
        }
    }

    /// Whether the direction that separated the pair in the previous step still does.
    fn apart(&self, cache: &PairCache<N>) -> bool {
        if cache.normal == Vector::ZERO {
            return false;
        }
        let normal = self.world_from_a.rotation.rotate(cache.normal);
        let centres = (self.world_from_b.translation - self.world_from_a.translation).dot(normal);
        let toward_a = -self.world_from_b.rotation.inverse_rotate(normal);
        let reach_a = self.a.core.support(cache.normal).dot(cache.normal) + self.a.radius;
        let reach_b = self.b.core.support(toward_a).dot(toward_a) + self.b.radius;
        centres - reach_a - reach_b > self.margin
    }

    fn sides(&self) -> (Side<'_, N>, Side<'_, N>) {
        (Side::new(self.a, self.world_from_a), Side::new(self.b, self.world_from_b))
    }

    /// Two boxes without rounding.
    fn boxes(
        &self,
        half_a: &Vector<N>,
        half_b: &Vector<N>,
        cache: &mut PairCache<N>,
        scratch: &mut Scratch<N>,
        out: &mut Manifold<N>,
    ) {
        let a_from_b = self.world_from_a.relative(self.world_from_b);
        let best = separate_boxes(half_a, half_b, &a_from_b, self.margin, cache.feature);
        cache.normal = best.normal;
        cache.feature = best.feature;
        if best.separation > self.margin || !best.separation.is_finite() {
            return;
        }
        let (a, b) = self.sides();
        let memory = &mut cache.patch;
        patch::build(&a, &b, &a_from_b, best.normal, self.margin, memory, &mut scratch.patch, out);
    }

    /// Two cores that are points or segments: balls and capsules.
    fn segments(&self, half_a: Vector<N>, half_b: Vector<N>, cache: &mut PairCache<N>, out: &mut Manifold<N>) {
        let segment = |pose: &Pose<N>, half| Segment { middle: pose.translation, half: pose.rotation.rotate(half) };
        let (a, b) = (segment(self.world_from_a, half_a), segment(self.world_from_b, half_b));
        let wish = self.world_from_a.rotation.rotate(cache.normal);
        let witness = round::segments(&a, &b, wish);
        self.single(&witness, cache, out);
        let Some(stretch) = round::side_by_side(&a, &b) else { return };
        if out.is_empty() {
            return;
        }
        let single = *out;
        out.clear();
        out.normal = single.normal;
        let mut least = f64::INFINITY;
        for (end, (on_a, on_b)) in round::ends(&a, &b, stretch).into_iter().enumerate() {
            let separation = (on_b - on_a).dot(witness.normal);
            least = least.min(separation);
            self.push(&Witness { on_a, on_b, separation, ..witness }, end as u32 + 1, out);
        }
        // Both ends rise from where the segments are closest: only the closest point tells the depth.
        if least > witness.separation + crate::limits::EQUAL_DEPTH * (half_a.norm() + half_b.norm()) {
            *out = single;
        }
    }

    /// One contact point at the witness.
    fn single(&self, witness: &Witness<N>, cache: &mut PairCache<N>, out: &mut Manifold<N>) {
        cache.normal = self.world_from_a.rotation.inverse_rotate(witness.normal);
        self.push(witness, 0, out);
    }

    /// Adds a witness given in the world if it is within the margin.
    fn push(&self, witness: &Witness<N>, id: u32, out: &mut Manifold<N>) {
        let separation = witness.separation - self.a.radius - self.b.radius;
        if separation <= self.margin {
            out.normal = witness.normal;
            let lean = witness.normal * (0.5 * (self.a.radius - self.b.radius));
            let position = (witness.on_a + witness.on_b) * 0.5 + lean;
            out.push(ContactPoint { position, separation, id });
        }
    }
}

impl<const N: usize> Witness<N> {
    fn transformed(&self, target_from_here: &Pose<N>) -> Self {
        Self {
            normal: target_from_here.rotation.rotate(self.normal),
            on_a: target_from_here.transform_point(self.on_a),
            on_b: target_from_here.transform_point(self.on_b),
            separation: self.separation,
        }
    }

    fn flipped(&self) -> Self {
        Self { normal: -self.normal, on_a: self.on_b, on_b: self.on_a, separation: self.separation }
    }
}
