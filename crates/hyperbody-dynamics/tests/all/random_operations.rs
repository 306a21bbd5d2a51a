//! Everything that may be done to a world between steps, in random order: nothing panics, nothing leaks, every handle of what is
//! gone is refused, and snapshots bring back what was.

use super::common::{Random, ball, cuboid};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, Freedom, JointDef, JointHandle, Snapshot, World, WorldDef, WorldErrorKind,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Vector};

struct Player<const N: usize> {
    random: Random,
    world: World<N>,
    bodies: Vec<BodyHandle>,
    joints: Vec<JointHandle>,
    gone_bodies: Vec<BodyHandle>,
    gone_joints: Vec<JointHandle>,
    saved: Option<(Snapshot<N>, Vec<BodyHandle>, Vec<JointHandle>)>,
}

impl<const N: usize> Player<N> {
    fn new(seed: u64) -> Self {
        let mut player = Self {
            random: Random(seed),
            world: World::new(WorldDef::default()).unwrap(),
            bodies: Vec::new(),
            joints: Vec::new(),
            gone_bodies: Vec::new(),
            gone_joints: Vec::new(),
            saved: None,
        };
        let floor = Shape::half_space(Vector::unit(1), 0.0).unwrap();
        player.bodies.push(player.world.add_body(BodyDef::fixed(floor)).unwrap());
        player
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.bits() % count as u64) as usize
    }

    fn any_body(&mut self) -> Option<BodyHandle> {
        if self.bodies.is_empty() {
            return None;
        }
        let at = self.below(self.bodies.len());
        Some(self.bodies[at])
    }

    fn pose(&mut self) -> Pose<N> {
        let place = self.random.vector::<N>(2.0) + Vector::unit(1) * 2.5;
        Pose::new(self.random.rotation(3.0), place)
    }

    fn add_body(&mut self) {
        let size = self.random.between(0.1, 0.5);
        let shape = match self.below(4) {
            0 => ball(size),
            1 => Shape::capsule(size, 0.5 * size, self.below(N)).unwrap(),
            2 => cuboid(Vector::from_fn(|i| size * (1.0 + 0.2 * i as f64))),
            _ => cuboid(Vector::splat(size)),
        };
        let pose = self.pose();
        let kind = [BodyKind::Dynamic, BodyKind::Dynamic, BodyKind::Dynamic, BodyKind::Static, BodyKind::Kinematic];
        let kind = kind[self.below(5)];
        let def = BodyDef::new(shape).kind(kind).position(pose.translation).rotation(pose.rotation);
        let spin = Bivector::from_fn(|_, _| self.random.between(-1.0, 1.0));
        let def = def.velocity(self.random.vector::<N>(1.0)).angular_velocity(spin);
        self.bodies.push(self.world.add_body(def).unwrap());
    }

    fn remove_body(&mut self) {
        if self.bodies.len() < 2 {
            return;
        }
        let at = self.below(self.bodies.len());
        let body = self.bodies.swap_remove(at);
        let tied = self.world.joints().filter(|(_, joint)| joint.def().a == Some(body) || joint.def().b == body);
        let tied: Vec<JointHandle> = tied.map(|(handle, _)| handle).collect();
        self.world.remove_body(body).unwrap();
        self.gone_bodies.push(body);
        self.joints.retain(|joint| !tied.contains(joint));
        self.gone_joints.extend(tied);
    }

    fn add_joint(&mut self) {
        let (Some(a), Some(b)) = (self.any_body(), self.any_body()) else { return };
        let a = if self.below(4) == 0 { None } else { Some(a) };
        let frames = (Pose::from_translation(self.random.vector(0.3)), Pose::from_translation(self.random.vector(0.3)));
        let (i, j) = (0, 1 + self.below(N - 1));
        let def = match self.below(8) {
            0 => JointDef::ball(a, b, frames.0.translation, frames.1.translation),
            1 => JointDef::hinge(a, b, frames.0, frames.1, (i, j)).angle_limits(i, j, -0.5, 0.7),
            2 => JointDef::hinge(a, b, frames.0, frames.1, (i, j)).motor(i, j, 3.0, 5.0),
            3 => JointDef::slider(a, b, frames.0, frames.1, i)
                .axis(i, Freedom { limits: Some((-0.2, 0.4)), ..Freedom::FREE }),
            4 => JointDef::axle(a, b, frames.0, frames.1, self.below(N)).break_at(200.0, 50.0),
            5 => JointDef::rope(a, b, frames.0.translation, frames.1.translation, 1.0),
            6 => JointDef::mouse(b, frames.1.translation, self.random.vector::<N>(2.0), 50.0),
            _ => JointDef::weld(a, b, frames.0, frames.1).softness(3.0, 0.5),
        };
        let moves = |handle: Option<BodyHandle>| {
            handle.and_then(|handle| self.world.body(handle)).is_some_and(|body| body.kind() == BodyKind::Dynamic)
        };
        let good = def.a != Some(def.b) && (moves(def.a) || moves(Some(def.b)));
        match self.world.add_joint(def) {
            Ok(joint) => {
                assert!(good, "a joint of one body, or of two that nothing moves, was taken");
                self.joints.push(joint);
            }
            Err(error) => assert!(!good && error.kind() == WorldErrorKind::NotAllowed, "{error}"),
        }
    }

    fn remove_joint(&mut self) {
        if !self.joints.is_empty() {
            let at = self.below(self.joints.len());
            let joint = self.joints.swap_remove(at);
            self.world.remove_joint(joint).unwrap();
            self.gone_joints.push(joint);
        }
    }

    fn push_around(&mut self) {
        let Some(handle) = self.any_body() else { return };
        let (pose, impulse) = (self.pose(), self.random.vector::<N>(1.0));
        let choice = self.below(6);
        let half_space = matches!(self.world.body(handle).unwrap().shape(), Shape::HalfSpace { .. });
        let mut body = self.world.body_mut(handle).unwrap();
        let kind = body.as_ref().kind();
        let result = match choice {
            0 if !half_space => body.set_pose(pose),
            1 => body.set_velocity(impulse * 3.0),
            2 => body.apply_impulse_at(impulse, pose.translation),
            3 => body.set_gravity_scale(impulse[0]),
            4 => body.apply_force(impulse * 100.0),
            _ => {
                body.wake();
                Ok(())
            }
        };
        if let Err(error) = result {
            assert!(kind != BodyKind::Dynamic && error.kind() == WorldErrorKind::NotAllowed, "{error}");
        }
    }

    fn save_or_load(&mut self) {
        match self.saved.take() {
            Some((snapshot, bodies, joints)) if self.below(2) == 0 => {
                self.world.restore(&snapshot);
                // What came later is gone as if it had never been: the handles may be given again.
                self.gone_bodies.clear();
                self.gone_joints.clear();
                (self.bodies, self.joints) = (bodies, joints);
            }
            _ => {
                // Every second one goes through bytes.
                let mut snapshot = self.world.snapshot();
                if self.below(2) == 0 {
                    snapshot = Snapshot::from_bytes(&snapshot.to_bytes()).unwrap();
                }
                self.saved = Some((snapshot, self.bodies.clone(), self.joints.clone()));
            }
        }
    }

    fn step(&mut self) {
        self.world.step();
        for broken in self.world.events().broken_joints() {
            self.joints.retain(|joint| *joint != broken.joint);
            self.gone_joints.push(broken.joint);
        }
    }

    fn play(&mut self) {
        match self.below(24) {
            0..=3 if self.bodies.len() < 40 => self.add_body(),
            4 | 5 => self.remove_body(),
            6..=8 => self.add_joint(),
            9 => self.remove_joint(),
            10..=12 => self.push_around(),
            13 => self.save_or_load(),
            14 => self.world.set_gravity(self.random.vector::<N>(10.0)).unwrap(),
            _ => self.step(),
        }
    }

    fn check(&mut self) {
        assert_eq!(self.world.body_count(), self.bodies.len());
        assert_eq!(self.world.joint_count(), self.joints.len());
        assert!(self.bodies.iter().all(|&body| self.world.body(body).is_some()));
        assert!(self.joints.iter().all(|&joint| self.world.joint(joint).is_some()));
        for &body in &self.gone_bodies {
            assert!(self.world.body(body).is_none() && self.world.body_mut(body).is_none());
            assert_eq!(self.world.remove_body(body).unwrap_err().kind(), WorldErrorKind::StaleHandle);
            let joint = JointDef::mouse(body, Vector::ZERO, Vector::ZERO, 1.0);
            assert_eq!(self.world.add_joint(joint).unwrap_err().kind(), WorldErrorKind::StaleHandle);
        }
        for &joint in &self.gone_joints {
            assert!(self.world.joint(joint).is_none());
            assert_eq!(self.world.remove_joint(joint).unwrap_err().kind(), WorldErrorKind::StaleHandle);
        }
        for (handle, body) in self.world.bodies() {
            assert!(body.is_quarantined() || body.position().is_finite(), "{handle:?} is at {:?}", body.position());
        }
    }

    fn empty(&mut self) {
        for body in std::mem::take(&mut self.bodies) {
            self.world.remove_body(body).unwrap();
        }
        assert_eq!((self.world.body_count(), self.world.joint_count(), self.world.pair_count()), (0, 0, 0));
        self.world.step();
        self.world.step();
        assert!(self.world.events().contacts().is_empty(), "an empty world still tells of touches");
    }
}

fn play<const N: usize>(seeds: std::ops::Range<u64>, operations: usize) {
    for seed in seeds {
        let mut player = Player::<N>::new(seed);
        for operation in 0..operations {
            player.play();
            if operation % 16 == 0 {
                player.check();
            }
        }
        player.check();
        player.empty();
    }
}

#[test]
fn random_operations() {
    play::<2>(0..4, 400);
    play::<3>(0..4, 400);
    play::<4>(0..4, 300);
    play::<6>(0..1, 100);
}

#[test]
#[ignore = "minutes: 100 seeds of 10,000 operations; run it in release"]
fn many_random_operations() {
    play::<2>(100..140, 10_000);
    play::<3>(100..130, 10_000);
    play::<4>(100..130, 10_000);
}
