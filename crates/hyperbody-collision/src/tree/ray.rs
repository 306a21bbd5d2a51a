//! Rays and boxes through the tree, and what is near, nearest boxes first.

use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

use super::{DynamicTree, NONE, State};
use crate::limits::RAY_BOX_SLACK;
use crate::ray::Ray;

/// Working memory of [`DynamicTree::cast_ray`] and its kin, to be kept so that nothing is allocated once it has grown. Its contents
/// never influence a result.
#[derive(Clone, Debug, Default)]
pub struct RayStack {
    /// Nodes still to be looked at, and where the ray enters their boxes.
    pub(super) entries: Vec<(f64, u32)>,
}

/// A ray, prepared for many boxes.
struct Slabs<const N: usize> {
    origin: Vector<N>,
    /// Reciprocals of the direction; ±∞ along the boxes.
    inverse: Vector<N>,
}

impl<const N: usize> Slabs<N> {
    fn new(ray: &Ray<N>) -> Self {
        Self { origin: ray.origin, inverse: Vector(ray.direction.0.map(|component| 1.0 / component)) }
    }

    /// Where the ray enters a box, 0 from inside, ∞ if it misses it up to `max_fraction`. Where a ray runs in a face of
    /// the box, 0·∞ is NaN, which no comparison takes: the face does not exclude it.
    #[inline]
    fn entry(&self, aabb: &Aabb<N>, max_fraction: f64) -> f64 {
        let (mut near, mut far) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let inverse = self.inverse.0[i];
            let lower = (aabb.lower.0[i] - self.origin.0[i]) * inverse;
            let upper = (aabb.upper.0[i] - self.origin.0[i]) * inverse;
            let backwards = inverse < 0.0;
            near[i] = if backwards { upper } else { lower };
            far[i] = if backwards { lower } else { upper };
        }
        let (mut enter, mut exit) = (0.0, max_fraction);
        for i in 0..N {
            enter = if near[i] > enter { near[i] } else { enter };
            exit = if far[i] < exit { far[i] } else { exit };
        }
        if enter <= exit * (1.0 + RAY_BOX_SLACK) { enter } else { f64::INFINITY }
    }
}

impl<const N: usize> DynamicTree<N> {
    /// Calls `visit` with the caller's number of every box that the ray meets, roughly from near to far, and with the
    /// largest fraction that is still of interest. It answers with the largest fraction of interest from then on, or
    /// `None` to end the search. Boxes that the ray meets only beyond it are left out; boxes that begin exactly there are
    /// not, so that ties can be decided by number.
    ///
    /// Rays that are not [valid](Ray::is_valid) meet nothing.
    pub fn cast_ray(&self, ray: &Ray<N>, stack: &mut RayStack, visit: impl FnMut(u32, f64) -> Option<f64>) {
        if ray.is_valid() {
            let slabs = Slabs::new(ray);
            self.near_first(ray.max_fraction, stack, |aabb, reach| slabs.entry(aabb, reach), visit);
        }
    }

    /// The same for a box of the given half-extents whose centre goes along the ray.
    pub fn cast_box(
        &self,
        ray: &Ray<N>,
        half_extents: Vector<N>,
        stack: &mut RayStack,
        visit: impl FnMut(u32, f64) -> Option<f64>,
    ) {
        if ray.is_valid() {
            let slabs = Slabs::new(ray);
            let grown = |aabb: &Aabb<N>| Aabb { lower: aabb.lower - half_extents, upper: aabb.upper + half_extents };
            self.near_first(ray.max_fraction, stack, |aabb, reach| slabs.entry(&grown(aabb), reach), visit);
        }
    }

    /// Calls `visit` with the caller's number of every box that is at most `reach` away from `aabb`, roughly from near to
    /// far, and with the largest distance that is still of interest, which its answer can reduce as with
    /// [`DynamicTree::cast_ray`].
    pub fn visit_near(
        &self,
        aabb: &Aabb<N>,
        reach: f64,
        stack: &mut RayStack,
        visit: impl FnMut(u32, f64) -> Option<f64>,
    ) {
        let distance = |other: &Aabb<N>, reach: f64| {
            let mut sum = 0.0;
            for i in 0..N {
                let apart = (aabb.lower.0[i] - other.upper.0[i]).max(other.lower.0[i] - aabb.upper.0[i]).max(0.0);
                sum += apart * apart;
            }
            let distance = sum.sqrt();
            if distance <= reach * (1.0 + RAY_BOX_SLACK) { distance } else { f64::INFINITY }
        };
        self.near_first(reach, stack, distance, visit);
    }

    /// Visits leaves roughly in the order of `entry`, which tells how far away a box begins, ∞ beyond the reach.
    #[inline]
    fn near_first(
        &self,
        mut reach: f64,
        stack: &mut RayStack,
        entry: impl Fn(&Aabb<N>, f64) -> f64,
        mut visit: impl FnMut(u32, f64) -> Option<f64>,
    ) {
        if self.root == NONE {
            return;
        }
        let entries = &mut stack.entries;
        entries.clear();
        let (mut begins, mut index) = (entry(&self.nodes[self.root as usize].aabb, reach), self.root);
        // Every node is looked at once, from its only parent.
        loop {
            if begins <= reach * (1.0 + RAY_BOX_SLACK) && begins < f64::INFINITY {
                let node = &self.nodes[index as usize];
                if node.state == State::Inner {
                    let [first, second] = node.children;
                    let enter_first = entry(&self.nodes[first as usize].aabb, reach);
                    let enter_second = entry(&self.nodes[second as usize].aabb, reach);
                    let far = if enter_second < enter_first {
                        (begins, index) = (enter_second, second);
                        (enter_first, first)
                    } else {
                        (begins, index) = (enter_first, first);
                        (enter_second, second)
                    };
                    if far.0 < f64::INFINITY {
                        entries.push(far);
                    }
                    continue;
                }
                match visit(node.user, reach) {
                    Some(next) => reach = if next < reach { next } else { reach },
                    None => return,
                }
            }
            let Some(next) = entries.pop() else { return };
            (begins, index) = next;
        }
    }
}
