//! Joints of every kind, in frames that lie anyhow or as the bodies do.

use hyperbody_dynamics::{BodyHandle, Freedom, JointDef, Motor, Spring};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use super::dice::Dice;

/// What a joint is to tie: bodies, and where they are.
#[derive(Clone, Copy)]
pub(crate) struct Ends<const N: usize> {
    pub(crate) a: Option<BodyHandle>,
    pub(crate) b: BodyHandle,
    /// The first is that of the world where there is no body.
    pub(crate) poses: [Pose<N>; 2],
}

impl Dice {
    /// A joint that can be added, whatever else ties the same bodies: many of them contradict each other.
    pub(crate) fn joint<const N: usize>(&mut self, ends: Ends<N>) -> JointDef<N> {
        let Ends { a, b, poses } = ends;
        let (frame_a, frame_b) = self.frames(&poses);
        let (p, q) = (frame_a.translation, frame_b.translation);
        let (i, j) = (0, 1 + self.below(N - 1));
        let def = match self.below(18) {
            0 => JointDef::ball(a, b, p, q),
            1 => JointDef::hinge(a, b, frame_a, frame_b, (i, j)).angle_limits(i, j, -0.5, 0.7),
            2 => JointDef::hinge(a, b, frame_a, frame_b, (i, j)).motor(i, j, 3.0, self.strength()),
            3 => JointDef::slider(a, b, frame_a, frame_b, i).axis(i, self.freedom()),
            4 => JointDef::axle(a, b, frame_a, frame_b, self.below(N)).break_at(200.0, 50.0),
            5 => JointDef::rope(a, b, p, q, self.between(0.0, 1.0)),
            6 => JointDef::distance(a, b, p, q, self.between(0.01, 1.0)),
            7 => JointDef::weld(a, b, frame_a, frame_b),
            8 => JointDef::weld(a, b, frame_a, frame_b).softness(self.between(0.5, 5.0), self.between(0.0, 2.0)),
            9 => {
                let angle = Freedom { spring: Some(self.spring()), ..self.freedom() };
                JointDef::hinge(a, b, frame_a, frame_b, (i, j)).plane(i, j, angle)
            }
            10 => self.gear(&ends, (i, j)),
            11 => self.rack(&ends, (i, j)),
            12 if N > 2 => {
                let along = (1..N).find(|&axis| axis != j).expect("a third one");
                JointDef::screw(a, b, frame_a, frame_b, (i, j), along, self.between(0.05, 0.5))
            }
            13 if a.is_none() => JointDef::mouse(b, q, self.vector::<N>(2.0), 50.0),
            15 if a.is_none() => JointDef::grip(b, frame_b, frame_a, self.strength(), self.strength()),
            14 => JointDef::ball(a, b, p, q).cone(self.below(N), self.between(0.1, 3.0)),
            16 if a.is_none() => JointDef::lock(b, poses[1], &[self.below(N)], &[]),
            _ => JointDef::axle(a, b, frame_a, frame_b, 0).motor(i, j, -2.0, self.strength()),
        };
        def.collide(self.below(3) == 0)
    }

    /// Frames on both bodies: at the same place of the world half of the time, else anyhow.
    fn frames<const N: usize>(&mut self, poses: &[Pose<N>; 2]) -> (Pose<N>, Pose<N>) {
        if self.below(2) == 0 {
            let place = Pose::new(self.turn(1.0), poses[1].translation + self.vector::<N>(0.3));
            return (poses[0].inverse() * place, poses[1].inverse() * place);
        }
        (Pose::new(self.turn(0.6), self.vector(0.3)), Pose::new(self.turn(0.6), self.vector(0.3)))
    }

    /// Wheels that lie in one plane at whatever distance.
    fn gear<const N: usize>(&mut self, ends: &Ends<N>, (i, j): (usize, usize)) -> JointDef<N> {
        let first = Pose::new(self.turn(1.0), ends.poses[0].translation);
        let off = Vector::unit(i) * self.between(0.1, 1.0) + Vector::unit(j) * self.between(0.1, 1.0);
        let second = Pose::new(first.rotation, first.transform_point(off));
        let teeth = [(12, 30), (20, 20), (-40, 10), (7, 100)][self.below(4)];
        let frames = (ends.poses[0].inverse() * first, ends.poses[1].inverse() * second);
        JointDef::gear(ends.a, ends.b, frames.0, frames.1, (i, j), teeth)
    }

    fn rack<const N: usize>(&mut self, ends: &Ends<N>, (i, j): (usize, usize)) -> JointDef<N> {
        let wheel = Pose::new(self.turn(1.0), ends.poses[0].translation);
        let radius = self.between(0.1, 0.5);
        let rack = Pose::new(wheel.rotation, wheel.transform_point(Vector::unit(j) * -radius));
        let frames = (ends.poses[0].inverse() * wheel, ends.poses[1].inverse() * rack);
        JointDef::rack(ends.a, ends.b, frames.0, frames.1, (i, j), radius)
    }

    fn turn<const N: usize>(&mut self, largest: f64) -> Rotation<N> {
        Rotation::exp(&Bivector::from_fn(|_, _| self.between(-largest, largest)))
    }

    /// Limits, a motor, both, or a spring.
    fn freedom(&mut self) -> Freedom {
        let limits = (self.below(3) > 0).then(|| (self.between(-0.4, 0.0), self.between(0.1, 0.5)));
        let motor = (self.below(2) == 0).then(|| Motor { speed: self.between(-3.0, 3.0), max_force: self.strength() });
        let spring = (self.below(3) == 0).then(|| self.spring());
        Freedom { limits, motor, spring, ..Freedom::FREE }
    }

    fn spring(&mut self) -> Spring {
        let (target, hz, damping_ratio) = (self.between(-0.5, 0.5), self.between(0.5, 5.0), self.between(0.0, 2.0));
        Spring { target, hz, damping_ratio, max_force: self.strength() }
    }

    /// N or N·m; now and then without end.
    fn strength(&mut self) -> f64 {
        [5.0, 500.0, 5e4, f64::INFINITY][self.below(4)]
    }
}
