//! The way of a body within one step, and when a core first meets a piece on it.

use hyperbody_collision::{Manifold, PairCache, Scratch, collide};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Convex, Core};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use crate::body::Body;
use crate::world::Collider;

/// How a body moves within the step: its centre of mass straight on, its attitude by one turn.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<const N: usize> {
    pub(crate) slot: u32,
    /// Part of the step after which it stands still.
    pub(crate) end: f64,
    centre: Vector<N>,
    rotation: Rotation<N>,
    way: Vector<N>,
    turn: Bivector<N>,
    body_from_centre: Vector<N>,
    /// Where what carries it has brought it.
    carried_to: Option<(Vector<N>, Rotation<N>)>,
}

impl<const N: usize> Sweep<N> {
    pub(crate) fn new(
        slot: u32,
        (centre, rotation): (Vector<N>, Rotation<N>),
        (last_centre, last_rotation): (Vector<N>, Rotation<N>),
        body: &Body<N>,
    ) -> Self {
        Self {
            slot,
            end: 1.0,
            centre,
            rotation,
            way: last_centre - centre,
            turn: (last_rotation * rotation.inverse()).log(),
            body_from_centre: body.centre_in_body,
            carried_to: None,
        }
    }

    pub(crate) fn is_carried(&self) -> bool {
        self.carried_to.is_some()
    }

    /// Centre of mass and attitude after a part of the step.
    fn at(&self, time: f64) -> (Vector<N>, Rotation<N>) {
        let time = time.min(self.end);
        (self.centre + self.way * time, Rotation::exp(&(self.turn * time)) * self.rotation)
    }

    /// Centre of mass and attitude at the end of the step.
    pub(crate) fn place(&self) -> (Vector<N>, Rotation<N>) {
        self.carried_to.unwrap_or_else(|| self.at(1.0))
    }

    fn world_from_body(&self, (centre, rotation): (Vector<N>, Rotation<N>)) -> Pose<N> {
        Pose::new(rotation, centre - rotation.rotate(self.body_from_centre))
    }

    pub(crate) fn pose_of(&self, collider: &Collider<N>, time: f64) -> Pose<N> {
        self.world_from_body(self.at(time)) * collider.body_from_collider
    }

    /// How far the arcs of a collider's points stand off the boxes at both ends, m; at most.
    pub(crate) fn bulge(&self, collider: &Collider<N>) -> f64 {
        let arm = (collider.body_from_collider.translation - self.body_from_centre).norm() + collider.reach;
        (0.125 * self.turn.norm_sq()).min(1.0) * arm
    }

    /// From a time on it goes with another body, as if stuck to it.
    pub(crate) fn carry(&mut self, time: f64, carrier: &Self) -> bool {
        if self.is_carried() {
            return false;
        }
        let carrier_from_body =
            carrier.world_from_body(carrier.at(time)).relative(&self.world_from_body(self.at(time)));
        let last = carrier.world_from_body(carrier.at(1.0)) * carrier_from_body;
        self.carried_to = Some((last.transform_point(self.body_from_centre), last.rotation));
        true
    }
}

/// A collider on the way of its body; one without a way stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swept<'a, const N: usize> {
    collider: &'a Collider<N>,
    sweep: Option<&'a Sweep<N>>,
}

impl<'a, const N: usize> Swept<'a, N> {
    pub(crate) fn new(collider: &'a Collider<N>, sweep: Option<&'a Sweep<N>>) -> Self {
        Self { collider, sweep }
    }

    fn pose(&self, time: f64) -> Pose<N> {
        self.sweep.map_or(self.collider.world_from_collider, |sweep| sweep.pose_of(self.collider, time))
    }

    fn way(&self, time: f64) -> Vector<N> {
        self.sweep.filter(|sweep| time < sweep.end).map_or(Vector::ZERO, |sweep| sweep.way)
    }

    /// Angle by which it turns in all of the step, rad; at most.
    fn turn(&self, time: f64) -> f64 {
        self.sweep.filter(|sweep| time < sweep.end).map_or(0.0, |sweep| sweep.turn.norm())
    }

    fn centre_of_mass(&self, time: f64) -> Vector<N> {
        self.sweep.map_or(self.collider.world_from_collider.translation, |sweep| sweep.at(time).0)
    }
}

/// Turns of a search. Each is exact for straight ways and flat faces; what is left is arcs and round surfaces.
const TURNS: usize = 48;

/// Part of a core's radius within which it has arrived, and was there from the start.
const ARRIVED: f64 = 0.1;
const INSIDE: f64 = 0.05;

/// Part of the step after which the core of `a` has come to `b`, and the two are to be stopped: where they touched first, or
/// if they touched at the start, where the core arrives. `None` if it never comes there, or has been there from the start.
pub(crate) fn time_of_impact<const N: usize>(
    a: &Swept<'_, N>,
    b: &Swept<'_, N>,
    margin: f64,
    scratch: &mut Scratch<N>,
) -> Option<f64> {
    let core = a.collider.core;
    let middle = |time: f64| a.pose(time).transform_point(core.centre);
    let seen = |time: f64| b.pose(time).inverse_transform_point(middle(time));
    // Contacts hold what has moved this little.
    if seen(0.0).distance(seen(1.0)) <= core.radius {
        return None;
    }
    let ball = Piece::Convex(Convex { core: Core::Point, radius: core.radius });
    let aside = (middle(0.0) - a.centre_of_mass(0.0)).norm();
    let mut search = Search { a, b, arm: aside, piece: &ball, at: core.centre, scratch };
    let (near, inside) = (ARRIVED * core.radius, INSIDE * core.radius);
    let arrives = search.first_time(near, inside)?;
    let mut search =
        Search { a, b, arm: aside + a.collider.reach, piece: &a.collider.piece, at: Vector::ZERO, scratch };
    let touches = search.first_time(0.25 * margin, 0.25 * margin);
    Some(touches.map_or(arrives, |touches| touches.min(arrives)))
}

/// Search for the first time at which a piece that moves with `a` comes near `b`.
struct Search<'s, 'a, const N: usize> {
    a: &'s Swept<'a, N>,
    b: &'s Swept<'a, N>,
    /// Largest distance of a point of the piece from the centre of mass of `a`, m.
    arm: f64,
    piece: &'s Piece<N>,
    /// Where the piece's frame lies in that of the collider of `a`.
    at: Vector<N>,
    scratch: &'s mut Scratch<N>,
}

impl<const N: usize> Search<'_, '_, N> {
    /// Advances by as much as brings the two together at the fastest that they can approach along the normal between their
    /// closest points: conservative advancement (B. Mirtich, 1996). `None` if they never come within `near`, or were within
    /// `inside` from the start.
    fn first_time(&mut self, near: f64, inside: f64) -> Option<f64> {
        let mut time = 0.0;
        let mut cache = PairCache::default();
        let mut manifold = Manifold::EMPTY;
        for turn in 0..TURNS {
            let (way_a, way_b) = (self.a.way(time), self.b.way(time));
            let (turn_a, turn_b) = (self.a.turn(time), self.b.turn(time));
            let apart = (self.a.centre_of_mass(time) - self.b.centre_of_mass(time)).norm() + self.arm;
            let way = way_a - way_b;
            // By turning: points of a about its centre; a's place as seen from b, and the normal with it.
            let by_turning = turn_a * self.arm + turn_b * (apart + 2.0 * way.norm());
            let left = 1.0 - time;
            let reach = near + left * (way.norm() + by_turning);
            let (pose, other) = (self.a.pose(time), self.b.pose(time));
            let pose = Pose::new(pose.rotation, pose.transform_point(self.at));
            let piece = &self.b.collider.piece;
            collide(self.piece, &pose, piece, &other, reach, &mut cache, self.scratch, &mut manifold);
            let distance = manifold.least_separation()?;
            if turn == 0 && distance <= inside {
                return None;
            }
            if distance <= 1.25 * near {
                return Some(time);
            }
            let closing = way.dot(manifold.normal).max(0.0) + by_turning;
            if closing * left <= distance - near {
                return None;
            }
            time += (distance - near) / closing;
        }
        Some(time)
    }
}
