//! Two rounded cores: which method for which pair, and what comes of it.

use hyperbody_geometry::{Convex, Core};
use hyperbody_math::{Pose, Vector};

use crate::box_sat::{BoxAxis, BoxPair, BoxSeparation, Feature};
use crate::difference::Difference;
use crate::manifold::{ContactPoint, Manifold};
use crate::narrow::{PairCache, Scratch};
use crate::patch::Side;
use crate::round::{self, Segment, Witness};
use crate::{general, limits, overlap};

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

    /// Two boxes without rounding: separating axes. The best facet normal is right where its patch can be shown to be;
    /// that spares the mixed axes. Where the axes cannot tell the distance (vertex against vertex and the like, within
    /// the margin), the distance search decides.
    fn boxes(
        &self,
        half_a: &Vector<N>,
        half_b: &Vector<N>,
        cache: &mut PairCache<N>,
        scratch: &mut Scratch<N>,
        out: &mut Manifold<N>,
    ) {
        let a_from_b = self.world_from_a.relative(self.world_from_b);
        let boxes = BoxPair::new(half_a, half_b, &a_from_b);
        let difference = Difference::new(&self.a.core, &self.b.core, &a_from_b);
        let facet = boxes.best_facet(cache.feature);
        let was_mixed = cache.feature == Feature::Mixed;
        if self.done_with(&facet, cache) {
            return;
        }
        let mut tried_facet = false;
        if !was_mixed && self.shows(&facet, &difference, cache, scratch, out) {
            let enough = overlap::worth_leaving_facet(-facet.separation, boxes.thickness, cache.feature);
            // A patch point proves the distance; a depth needs the bound.
            if facet.separation > 0.0 || overlap::least_possible_depth(&difference, self.world_from_a, out) >= enough {
                return;
            }
            tried_facet = true;
        }
        let BoxSeparation { best, least, .. } = boxes.best_of_all(facet, self.margin, cache.feature);
        if self.done_with(&best, cache) {
            out.clear();
            return;
        }
        if tried_facet && best.feature != Feature::Mixed {
            (cache.normal, cache.feature) = (best.normal, best.feature);
            return;
        }
        if self.shows(&best, &difference, cache, scratch, out)
            || (least.normal != best.normal && self.shows(&least, &difference, cache, scratch, out))
        {
            return;
        }
        general::search(self, &difference, false, cache, scratch, out);
    }

    /// Notes an axis; whether it separates by more than the margin, or is no number.
    fn done_with(&self, axis: &BoxAxis<N>, cache: &mut PairCache<N>) -> bool {
        if axis.separation <= self.margin && axis.separation.is_finite() {
            return false;
        }
        (cache.normal, cache.feature) = (axis.normal, Feature::None);
        true
    }

    /// Builds the patch along an axis; whether it is as deep as the axis says.
    fn shows(
        &self,
        axis: &BoxAxis<N>,
        difference: &Difference<'_, N>,
        cache: &mut PairCache<N>,
        scratch: &mut Scratch<N>,
        out: &mut Manifold<N>,
    ) -> bool {
        (cache.normal, cache.feature) = (axis.normal, axis.feature);
        let shown = general::build(self, difference, axis.normal, cache, scratch, out);
        let tolerance = general::patch_tolerance(difference, axis.separation);
        shown.is_some_and(|shown| shown <= axis.separation + tolerance)
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
