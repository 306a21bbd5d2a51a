//! Rays through the tree, nearest boxes first.

use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

use super::{DynamicTree, NONE, State};
use crate::limits::RAY_BOX_SLACK;
use crate::ray::Ray;

/// Working memory of [`DynamicTree::cast_ray`], to be kept so that nothing is allocated once it has grown. Its contents
/// never influence a result.
#[derive(Clone, Debug, Default)]
pub struct RayStack {
    /// Nodes still to be looked at, and where the ray enters their boxes.
    entries: Vec<(f64, u32)>,
}

/// A ray, prepared for many boxes.
struct Slabs<const N: usize> {
    origin: Vector<N>,
    /// Reciprocals of the direction; ±∞ along the boxes.
    inverse: Vector<N>,
}

impl<const N: usize> Slabs<N> {
    /// Where the ray enters a box, 0 from inside, ∞ if it misses it up to `max_fraction`. Where a ray runs in a face of
    /// the box, 0·∞ is NaN, which no comparison takes: the face does not exclude it.
    #[inline]
    fn entry(&self, aabb: &Aabb<N>, max_fraction: f64) -> f64 {
        let (mut enter, mut exit) = (0.0, max_fraction);
        for i in 0..N {
            let inverse = self.inverse.0[i];
            let backwards = inverse < 0.0;
            let (near, far) =
                if backwards { (aabb.upper.0[i], aabb.lower.0[i]) } else { (aabb.lower.0[i], aabb.upper.0[i]) };
            let near = (near - self.origin.0[i]) * inverse;
            let far = (far - self.origin.0[i]) * inverse;
            enter = if near > enter { near } else { enter };
            exit = if far < exit { far } else { exit };
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
    pub fn cast_ray(&self, ray: &Ray<N>, stack: &mut RayStack, mut visit: impl FnMut(u32, f64) -> Option<f64>) {
        if self.root == NONE || !ray.is_valid() {
            return;
        }
        let slabs = Slabs { origin: ray.origin, inverse: Vector(ray.direction.0.map(|component| 1.0 / component)) };
        let mut reach = ray.max_fraction;
        let entries = &mut stack.entries;
        entries.clear();
        let entry = slabs.entry(&self.nodes[self.root as usize].aabb, reach);
        if entry < f64::INFINITY {
            entries.push((entry, self.root));
        }
        // Every node is pushed at most once, by its only parent.
        while let Some((entry, index)) = entries.pop() {
            if entry > reach * (1.0 + RAY_BOX_SLACK) {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.state == State::Leaf {
                match visit(node.user, reach) {
                    Some(next) => reach = if next < reach { next } else { reach },
                    None => return,
                }
                continue;
            }
            let [first, second] = node.children;
            let [enter_first, enter_second] =
                node.children.map(|child| slabs.entry(&self.nodes[child as usize].aabb, reach));
            let (near, far) = if enter_second < enter_first {
                ((enter_second, second), (enter_first, first))
            } else {
                ((enter_first, first), (enter_second, second))
            };
            if far.0 < f64::INFINITY {
                entries.push(far);
            }
            if near.0 < f64::INFINITY {
                entries.push(near);
            }
        }
    }
}
