//! GJK and the penetration search behind it, without the shortcuts that pairs with closed forms take elsewhere.

use hyperbody_geometry::Convex;
use hyperbody_math::Pose;

use crate::difference::Difference;
use crate::narrow::{Scratch, is_finite};
use crate::query::{Separation, separation_by_difference};

/// Distance or depth of two convex pieces by their Minkowski difference alone. The distance search takes at most
/// [`crate::limits::MAX_GJK_TURNS`] turns; it ends on its own because each turn brings the simplex strictly closer and the
/// difference has finitely many. `None` for poses that are not finite.
#[must_use]
pub fn by_minkowski_difference<const N: usize>(
    a: &Convex<N>,
    world_from_a: &Pose<N>,
    b: &Convex<N>,
    world_from_b: &Pose<N>,
    scratch: &mut Scratch<N>,
) -> Option<Separation<N>> {
    if !(is_finite(world_from_a) && is_finite(world_from_b)) {
        return None;
    }
    let a_from_b = world_from_a.relative(world_from_b);
    let difference = Difference::new(&a.core, &b.core, &a_from_b);
    Some(separation_by_difference(&difference, world_from_a, a.radius, b.radius, scratch))
}
