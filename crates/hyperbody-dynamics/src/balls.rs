//! Balls against balls, the commonest pair of all, and on half-spaces: the geometry is one distance, and the general way around it
//! (poses, caches, patches, matching of points) would cost ten times as much.

use hyperbody_collision::ContactPoint;
use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::{Pose, Vector};

use crate::body::Body;
use crate::narrow_phase::{AFTER_IMPACT, Update, meet_first};
use crate::pairs::{Pair, PairRole, Summary, Touch, Touches};
use crate::wandering::share_of_b;
use crate::world::Collider;

/// What contacts of balls are made from, by the slot of the collider. Bodies and colliders hold the same, but are tens of times as
/// large, and pairs meet them in no order that a cache could keep up with. Made anew in each step for the colliders that
/// [`Motion::plain`](crate::world::Motion::plain) marks.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Plain<const N: usize> {
    Ball(Ball<N>),
    /// normal·p ≤ offset, world frame.
    HalfSpace {
        normal: Vector<N>,
        offset: f64,
    },
    /// Has never been either.
    Other,
}

/// A ball as it is at the start of the step, world frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball<const N: usize> {
    /// m and m/s.
    centre: Vector<N>,
    velocity: Vector<N>,
    /// Speed of its surface by its spin, m/s.
    spin: f64,
    /// m.
    radius: f64,
}

impl<const N: usize> Plain<N> {
    /// Becomes a collider at the pose that it has in this step; whether that is plain.
    pub(crate) fn take(&mut self, collider: &Collider<N>, body: &Body<N>) -> bool {
        let pose = &collider.world_from_collider;
        *self = match &collider.piece {
            _ if body.quarantined => return false,
            Piece::HalfSpace { normal, offset } => {
                let normal = pose.rotation.rotate(*normal);
                Self::HalfSpace { normal, offset: offset + normal.dot(pose.translation) }
            }
            Piece::Convex(convex) if body.is_ball => Self::Ball(Ball {
                centre: pose.translation,
                velocity: body.velocity,
                spin: body.surface_speed_by_spin(),
                radius: convex.radius,
            }),
            Piece::Convex(_) => return false,
        };
        true
    }
}

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
    /// Brings a pair of plain shapes up to date; `false` if the general way has to be gone. `way` is how far both have come.
    pub(crate) fn plain(&self, pair: &mut Pair<N>, way: f64) -> bool {
        if pair.role != PairRole::Solid {
            return false;
        }
        match (&self.plain[pair.collider_a as usize], &self.plain[pair.collider_b as usize]) {
            (Plain::Ball(a), Plain::Ball(b)) => self.balls(pair, a, b, way),
            (Plain::Ball(ball), &Plain::HalfSpace { normal, offset }) => {
                self.ball_lies(pair, ball, normal, offset, -1.0)
            }
            (&Plain::HalfSpace { normal, offset }, Plain::Ball(ball)) => {
                self.ball_lies(pair, ball, normal, offset, 1.0)
            }
            _ => false,
        }
    }

    fn balls(&self, pair: &mut Pair<N>, a: &Ball<N>, b: &Ball<N>, way: f64) -> bool {
        let between = b.centre - a.centre;
        let distance = between.norm();
        // Coincident centres leave the direction open.
        if !(distance > 0.0 && distance.is_finite()) {
            return false;
        }
        if !pair.round {
            pair.round = true;
            pair.search.a_from_b = None;
        }
        let gap = distance - (a.radius + b.radius);
        let closing = self.dt * ((b.velocity - a.velocity).norm() + a.spin + b.spin);
        let far = gap > self.margin + AFTER_IMPACT * closing;
        if far || gap > self.margin && !self.balls_meet(a, b) {
            // Both may come as far as this before there is a contact to make.
            pair.holds_until = if far { way + (gap - self.margin) } else { f64::NEG_INFINITY };
            if pair.points > 0
                && let Some(contact) = &mut pair.contact
            {
                contact.clear();
            }
            pair.note(&Summary::default());
            return true;
        }
        let normal = between * (1.0 / distance);
        if pair.points != 1 {
            let Some([(a, body_a), (b, body_b)]) = self.sides(pair) else { return false };
            let contact = pair.contact.get_or_insert_with(|| Box::new(meet_first((a, body_a), (b, body_b), 0)));
            contact.share_of_b = share_of_b(a, b, normal);
            contact.clear();
        }
        let position = a.centre + normal * (a.radius + 0.5 * gap);
        touch(pair, normal, ContactPoint { position, separation: gap, id: 0 });
        pair.holds_until = f64::NEG_INFINITY;
        true
    }

    /// A ball that lay on a half-space in the last step, too; `sign` is that of the contact's normal along the half-space's.
    fn ball_lies(&self, pair: &mut Pair<N>, ball: &Ball<N>, normal: Vector<N>, offset: f64, sign: f64) -> bool {
        let separation = ball.centre.dot(normal) - offset - ball.radius;
        if !(pair.points == 1 && separation <= self.margin && separation.is_finite()) {
            return false;
        }
        let position = ball.centre - normal * ball.radius - normal * (0.5 * separation);
        touch(pair, normal * sign, ContactPoint { position, separation, id: 0 });
        true
    }

    /// Whether two balls that move on as they do come within the margin of each other before the step ends.
    fn balls_meet(&self, a: &Ball<N>, b: &Ball<N>) -> bool {
        let between = b.centre - a.centre;
        let motion = (b.velocity - a.velocity) * self.dt;
        let nearest = (-between.dot(motion) / motion.norm_sq().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (between + motion * nearest).norm() <= a.radius + b.radius + self.margin
    }
}

/// Sets the only point of a contact, with the impulse that it has.
fn touch<const N: usize>(pair: &mut Pair<N>, normal: Vector<N>, point: ContactPoint<N>) {
    let Some(contact) = &mut pair.contact else { return };
    let mut summary = Summary::default();
    summary.count(point.separation);
    contact.normal = normal;
    contact.touches = Touches::Alone(Touch {
        normal_impulse: contact.touches.first().map_or(0.0, |touch| touch.normal_impulse),
        ..Touch::new(point)
    });
    pair.note(&summary);
}
