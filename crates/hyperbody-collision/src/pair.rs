//! Two rounded cores: which method for which pair, and what comes of it.

use hyperbody_geometry::{Convex, Core};
use hyperbody_math::{Pose, Vector};

use crate::box_sat::{BoxSeparation, Feature, separate_boxes};
use crate::difference::Difference;
use crate::manifold::{ContactPoint, Manifold};
use crate::narrow::{PairCache, Scratch};
use crate::patch::{self, Side};
use crate::round::{self, Segment, Witness};
use crate::{general, limits};

/// Two rounded cores in the world.
pub(crate) struct Pair<'a, const N: usize> {
    pub(crate) a: &'a Convex<N>,
    pub(crate) b: &'a Convex<N>,
    pub(crate) world_from_a: &'a Pose<N>,
    pub(crate) world_from_b: &'a Pose<N>,
    pub(crate) margin: f64,
    /// Sum of the radii.
    pub(crate) rounding: f64,
}

impl<'a, const N: usize> Pair<'a, N> {
    pub(crate) fn new(
        a: &'a Convex<N>,
        world_from_a: &'a Pose<N>,
        b: &'a Convex<N>,
        world_from_b: &'a Pose<N>,
        margin: f64,
    ) -> Self {
        Self { a, b, world_from_a, world_from_b, margin, rounding: a.radius + b.radius }
    }

    pub(crate) fn collide(&self, cache: &mut PairCache<N>, scratch: &mut Scratch<N>, out: &mut Manifold<N>) {
        if self.apart(cache) {
            cache.feature = Feature::None;
            return;
        }
        match (&self.a.core, &self.b.core) {
            (Core::Box { half_extents: half_a }, Core::Box { half_extents: half_b }) if self.rounding == 0.0 => {
                self.boxes(half_a, half_b, cache, scratch, out);
            }
            (Core::Point | Core::Segment { .. }, Core::Point | Core::Segment { .. }) => self.segments(cache, out),
            (core, Core::Point) => {
                let point = self.world_from_a.inverse_transform_point(self.world_from_b.translation);
                match round::nearest_known(core, point) {
                    Some(witness) => self.single(&witness.transformed(self.world_from_a), cache, out),
                    None => general::collide(self, cache, scratch, out),
                }
            }
            (Core::Point, core) => {
                let point = self.world_from_b.inverse_transform_point(self.world_from_a.translation);
                match round::nearest_known(core, point) {
                    Some(witness) => self.single(&witness.transformed(self.world_from_b).flipped(), cache, out),
                    None => general::collide(self, cache, scratch, out),
                }
            }
            _ => general::collide(self, cache, scratch, out),
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
        let reach_a = self.a.core.support(cache.normal).dot(cache.normal);
        let reach_b = self.b.core.support(toward_a).dot(toward_a);
        centres - reach_a - reach_b - self.rounding > self.margin
    }

    pub(crate) fn sides(&self) -> (Side<'_, N>, Side<'_, N>) {
        (Side::new(self.a, self.world_from_a), Side::new(self.b, self.world_from_b))
    }

    /// Two boxes without rounding: separating axes. Where these cannot tell the distance (vertex against vertex and
    /// the like, within the margin), the distance search decides.
    fn boxes(
        &self,
        half_a: &Vector<N>,
        half_b: &Vector<N>,
        cache: &mut PairCache<N>,
        scratch: &mut Scratch<N>,
        out: &mut Manifold<N>,
    ) {
        let a_from_b = self.world_from_a.relative(self.world_from_b);
        let BoxSeparation { best, least, .. } = separate_boxes(half_a, half_b, &a_from_b, self.margin, cache.feature);
        cache.normal = best.normal;
        if best.separation > self.margin || !best.separation.is_finite() {
            cache.feature = Feature::None;
            return;
        }
        let (a, b) = self.sides();
        let tolerance =
            limits::EQUAL_DEPTH * a.extent.min(b.extent) + limits::FACET_PREFERENCE_RELATIVE * best.separation.abs();
        for axis in [best, least] {
            (cache.normal, cache.feature) = (axis.normal, axis.feature);
            let (memory, scratch) = (&mut cache.patch, &mut scratch.patch);
            out.clear();
            let shown = patch::build(&a, &b, &a_from_b, axis.normal, self.margin, memory, scratch, out);
            if shown.is_some_and(|shown| shown <= axis.separation + tolerance) {
                return;
            }
            if least.normal == best.normal {
                break;
            }
        }
        out.clear();
        let difference = Difference::new(&self.a.core, &self.b.core, &a_from_b);
        general::collide_known(self, &difference, cache, scratch, out);
    }

    /// Two cores that are points or segments: balls and capsules.
    fn segments(&self, cache: &mut PairCache<N>, out: &mut Manifold<N>) {
        let segment = |core: &Core<N>, pose: &Pose<N>| {
            let half = if let Core::Segment { half } = core { pose.rotation.rotate(*half) } else { Vector::ZERO };
            Segment { middle: pose.translation, half }
        };
        let (a, b) = (segment(&self.a.core, self.world_from_a), segment(&self.b.core, self.world_from_b));
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
        let (mut least, mut aside) = (f64::INFINITY, 0.0_f64);
        for (end, (on_a, on_b)) in round::ends(&a, &b, stretch).into_iter().enumerate() {
            let separation = (on_b - on_a).dot(witness.normal);
            least = least.min(separation);
            aside = aside.max((on_b - on_a - witness.normal * separation).norm());
            self.push(&Witness { on_a, on_b, separation, ..witness }, end as u32 + 1, out);
        }
        // Where both ends rise from the closest points, or pass beside each other, only those tell the depth.
        let rises = least > witness.separation + limits::EQUAL_DEPTH * (a.half.norm() + b.half.norm());
        if rises || aside > limits::ASIDE * self.rounding {
            *out = single;
        }
    }

    /// One contact point at a witness given in the world.
    pub(crate) fn single(&self, witness: &Witness<N>, cache: &mut PairCache<N>, out: &mut Manifold<N>) {
        cache.normal = self.world_from_a.rotation.inverse_rotate(witness.normal);
        self.push(witness, 0, out);
    }

    /// Adds a witness given in the world if it is within the margin.
    pub(crate) fn push(&self, witness: &Witness<N>, id: u32, out: &mut Manifold<N>) {
        let separation = witness.separation - self.rounding;
        if separation <= self.margin {
            out.normal = witness.normal;
            let lean = witness.normal * (0.5 * (self.a.radius - self.b.radius));
            let position = (witness.on_a + witness.on_b) * 0.5 + lean;
            out.push(ContactPoint { position, separation, id });
        }
    }
}
