//! Balls against balls, the commonest pair of all: the geometry is one distance, and the general way around it (poses, caches,
//! patches, matching of points) would cost ten times as much.

use hyperbody_collision::ContactPoint;
use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};

use crate::body::Body;
use crate::narrow_phase::{AFTER_IMPACT, Update, meet_first};
use crate::pairs::{Pair, PairRole, Touch};
use crate::wandering::share_of_b;
use crate::world::Collider;

/// Radius of a piece that is a ball, m.
pub(crate) fn ball<const N: usize>(piece: &Piece<N>) -> Option<f64> {
    match piece {
        Piece::Convex(convex) if matches!(convex.core, Core::Point) => Some(convex.radius),
        _ => None,
    }
}

/// Whether the pieces of a body are one ball about its centre of mass.
pub(crate) fn is_ball<const N: usize>(pieces: &[(Pose<N>, Piece<N>)], centre: Vector<N>) -> bool {
    matches!(pieces, [(pose, piece)] if ball(piece).is_some() && pose.translation == centre)
}

impl<const N: usize> Update<'_, N> {
    /// Brings a pair of two balls up to date; `false` if it is another pair and the general way has to be gone. `way` is how
    /// far both have come, `closing` how far they come closer within the step at most.
    pub(crate) fn balls(
        &self,
        pair: &mut Pair<N>,
        (a, body_a): (&Collider<N>, &Body<N>),
        (b, body_b): (&Collider<N>, &Body<N>),
        way: f64,
        closing: f64,
    ) -> bool {
        if !(body_a.is_ball && body_b.is_ball && pair.role == PairRole::Solid) {
            return false;
        }
        let (Some(radius_a), Some(radius_b)) = (ball(&a.piece), ball(&b.piece)) else { return false };
        let between = b.world_from_collider.translation - a.world_from_collider.translation;
        let distance = between.norm();
        // Coincident centres leave the direction open.
        if !(distance > 0.0 && distance.is_finite()) {
            return false;
        }
        if !pair.round {
            pair.round = true;
            pair.search.a_from_b = None;
        }
        let gap = distance - (radius_a + radius_b);
        let far = gap > self.margin + AFTER_IMPACT * closing;
        if far || gap > self.margin && !self.balls_meet(between, body_a, body_b, radius_a + radius_b) {
            // Both may come as far as this before there is a contact to make.
            pair.holds_until = if far { way + (gap - self.margin) } else { f64::NEG_INFINITY };
            if let Some(contact) = &mut pair.contact {
                contact.clear();
            }
            pair.summarize();
            return true;
        }
        let normal = between * (1.0 / distance);
        let contact = pair.contact.get_or_insert_with(|| Box::new(meet_first((a, body_a), (b, body_b), 1)));
        let position = a.world_from_collider.translation + normal * (radius_a + 0.5 * gap);
        let point = ContactPoint { position, separation: gap, id: 0 };
        contact.normal = normal;
        match contact.touches.as_mut_slice() {
            [touch] => {
                touch.point = point;
                touch.step_impulse = 0.0;
            }
            _ => {
                contact.touches.clear();
                contact.touches.push(Touch::new(point));
                contact.share_of_b = share_of_b(a, b, normal);
            }
        }
        pair.holds_until = f64::NEG_INFINITY;
        pair.summarize();
        true
    }
    /// Whether two balls that move on as they do come within the margin of each other before the step ends.
    fn balls_meet(&self, between: Vector<N>, a: &Body<N>, b: &Body<N>, radii: f64) -> bool {
        let motion = (b.velocity - a.velocity) * self.dt;
        let nearest = (-between.dot(motion) / motion.norm_sq().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (between + motion * nearest).norm() <= radii + self.margin
    }
}
