//! A player that does to a world whatever can be done between steps, in random order, and knows what must come of it.

use std::collections::{BTreeMap, BTreeSet};

use hyperbody_dynamics::{
    BodyDef, BodyHandle, BodyKind, Groups, JointDef, JointHandle, Rewind, Snapshot, World, WorldDef, WorldError,
    WorldErrorKind,
};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Pose, Vector};

use super::dice::Dice;
use super::joints::Ends;
use super::tally::{OPERATIONS, Operation, Tally};

/// Most bodies at once.
const CROWD: usize = 40;

/// Steps that can be taken back.
const PAST: usize = 12;

/// What a player has, to compare with the world and to go back to.
#[derive(Clone)]
struct Owned {
    bodies: Vec<BodyHandle>,
    joints: Vec<JointHandle>,
    hash: u64,
}

pub(crate) struct Player<const N: usize> {
    dice: Dice,
    world: World<N>,
    bodies: Vec<BodyHandle>,
    joints: Vec<JointHandle>,
    gone_bodies: BTreeSet<BodyHandle>,
    gone_joints: BTreeSet<JointHandle>,
    saved: Option<(Snapshot<N>, Owned)>,
    past: Rewind<N>,
    /// By step, what was had when it was recorded.
    before: BTreeMap<u64, Owned>,
    tally: Tally,
}

/// Plays a world from its making to the removal of its last body.
pub(crate) fn play<const N: usize>(seed: u64, operations: usize) -> Tally {
    let mut player = Player::<N>::new(seed);
    for number in 0..operations {
        player.act();
        if number % 16 == 0 {
            player.check();
        }
    }
    player.check();
    player.leave();
    player.tally
}

impl<const N: usize> Player<N> {
    fn new(seed: u64) -> Self {
        let mut world = World::new(WorldDef::default()).expect("in range");
        let floor = Shape::half_space(Vector::unit(1), 0.0).expect("a floor");
        let floor = world.add_body(BodyDef::fixed(floor)).expect("valid");
        Self {
            dice: Dice(seed),
            world,
            bodies: vec![floor],
            joints: Vec::new(),
            gone_bodies: BTreeSet::new(),
            gone_joints: BTreeSet::new(),
            saved: None,
            past: Rewind::new(PAST, 1 << 26),
            before: BTreeMap::new(),
            tally: Tally::default(),
        }
    }

    fn act(&mut self) {
        let mut ticket = self.dice.below(OPERATIONS.iter().map(|(_, _, weight)| weight).sum());
        let drawn = OPERATIONS.iter().find(|(_, _, weight)| {
            let here = ticket < *weight;
            ticket = ticket.saturating_sub(*weight);
            here
        });
        let operation = drawn.map_or(Operation::Step, |(operation, ..)| *operation);
        let done = match operation {
            Operation::AddBody => self.add_body(),
            Operation::RemoveBody => self.remove_body(),
            Operation::AddJoint => self.add_joint(),
            Operation::ChangeJoint => self.change_joint(),
            Operation::RemoveJoint => self.remove_joint(),
            Operation::Teleport => self.teleport(),
            Operation::Push => self.push(),
            Operation::Lead => self.lead(),
            Operation::Wake => self.wake(),
            Operation::ChangeShape => self.change_shape(),
            Operation::ChangeBody => self.change_body(),
            Operation::Filter => self.filter(),
            Operation::Gravity => self.world.set_gravity(self.dice.vector::<N>(10.0)).map(|()| true).expect("finite"),
            Operation::Save => self.save(|snapshot| snapshot),
            Operation::SaveBytes => {
                self.save(|snapshot| Snapshot::from_bytes(&snapshot.to_bytes()).expect("what was written is read"))
            }
            Operation::Load => self.load(),
            Operation::GoBack => self.go_back(),
            Operation::Step => self.step(),
        };
        self.tally.count(operation, done);
        let now = [self.bodies.len(), self.joints.len(), self.world.pair_count()];
        self.tally.most = std::array::from_fn(|k| self.tally.most[k].max(now[k]));
    }

    fn any_body(&mut self) -> Option<BodyHandle> {
        (!self.bodies.is_empty()).then(|| self.bodies[self.dice.below(self.bodies.len())])
    }

    fn any_joint(&mut self) -> Option<JointHandle> {
        (!self.joints.is_empty()).then(|| self.joints[self.dice.below(self.joints.len())])
    }

    fn kind(&self, handle: BodyHandle) -> BodyKind {
        self.world.body(handle).expect("alive").kind()
    }

    fn is_endless(&self, handle: BodyHandle) -> bool {
        matches!(self.world.body(handle).expect("alive").shape(), Shape::HalfSpace { .. })
    }

    /// Whether an impulse moves it; the world, which is `None`, is moved by nothing.
    fn moves(&self, handle: Option<BodyHandle>) -> bool {
        handle.is_some_and(|handle| self.kind(handle) == BodyKind::Dynamic)
    }

    fn add_body(&mut self) -> bool {
        if self.bodies.len() >= CROWD {
            return false;
        }
        let pose = self.dice.pose();
        let def = BodyDef::new(self.dice.shape()).kind(self.dice.kind());
        let def = def.position(pose.translation).rotation(pose.rotation);
        let spin = Bivector::from_fn(|_, _| self.dice.between(-1.0, 1.0));
        let def = def.velocity(self.dice.vector::<N>(1.0)).angular_velocity(spin);
        let body = self.world.add_body(def).expect("valid");
        // After going back, handles of the future that is no longer are given again.
        self.gone_bodies.remove(&body);
        self.bodies.push(body);
        true
    }

    fn remove_body(&mut self) -> bool {
        if self.bodies.len() < 2 {
            return false;
        }
        let at = self.dice.below(self.bodies.len());
        let body = self.bodies.swap_remove(at);
        let tied: Vec<JointHandle> = self.ties(body).map(|(joint, _)| joint).collect();
        self.world.remove_body(body).expect("alive");
        self.gone_bodies.insert(body);
        self.joints.retain(|joint| !tied.contains(joint));
        self.gone_joints.extend(tied);
        true
    }

    /// The joints of a body, and what is at their other ends.
    fn ties(&self, body: BodyHandle) -> impl Iterator<Item = (JointHandle, Option<BodyHandle>)> {
        self.world.joints().filter_map(move |(handle, joint)| {
            let def = joint.def();
            (def.a == Some(body)).then_some((handle, Some(def.b))).or((def.b == body).then_some((handle, def.a)))
        })
    }

    /// Some joint of these bodies as they lie.
    fn joint_def(&mut self, a: Option<BodyHandle>, b: BodyHandle) -> JointDef<N> {
        let pose = |body| self.world.body(body).expect("alive").pose();
        let poses = [a.map_or(Pose::IDENTITY, pose), pose(b)];
        self.dice.joint(Ends { a, b, poses })
    }

    fn add_joint(&mut self) -> bool {
        let (Some(a), Some(b)) = (self.any_body(), self.any_body()) else { return false };
        let a = (self.dice.below(4) > 0).then_some(a);
        let good = a != Some(b) && (self.moves(a) || self.moves(Some(b)));
        let def = self.joint_def(a, b);
        let result = self.world.add_joint(def);
        expect(result.as_ref(), good, "a joint of one body, or of two that nothing moves");
        let Ok(joint) = result else { return false };
        self.gone_joints.remove(&joint);
        self.joints.push(joint);
        true
    }

    fn change_joint(&mut self) -> bool {
        let Some(joint) = self.any_joint() else { return false };
        let (a, b) = self.world.joint_bodies(joint).expect("alive");
        if self.dice.below(3) == 0 {
            self.world.set_joint_target(joint, self.dice.vector::<N>(0.5)).expect("finite");
        } else {
            let def = self.joint_def(a, b);
            self.world.set_joint(joint, def).expect("between the same bodies");
        }
        true
    }

    fn remove_joint(&mut self) -> bool {
        let Some(joint) = self.any_joint() else { return false };
        self.joints.retain(|other| *other != joint);
        self.world.remove_joint(joint).expect("alive");
        self.gone_joints.insert(joint);
        true
    }

    fn teleport(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        let pose = self.dice.pose();
        if self.is_endless(handle) {
            // The floor may move up and down a little, or nothing would stay above it.
            let floor = Pose::from_translation(Vector::unit(1) * self.dice.between(-0.2, 0.0));
            self.world.body_mut(handle).expect("alive").set_pose(floor).expect("finite");
        } else {
            self.world.body_mut(handle).expect("alive").set_pose(pose).expect("finite");
        }
        true
    }

    fn push(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        let (push, choice) = (self.dice.vector::<N>(1.0), self.dice.below(7));
        let spin = Bivector::from_fn(|_, _| self.dice.between(-2.0, 2.0));
        let (kind, mass, centre) = {
            let body = self.world.body(handle).expect("alive");
            (body.kind(), body.mass(), body.position())
        };
        // By mass, or the light ones would be off to where there are no numbers.
        let at = centre + self.dice.vector::<N>(0.3);
        let mut body = self.world.body_mut(handle).expect("alive");
        let (result, good) = match choice {
            0 => (body.set_velocity(push * 3.0), kind != BodyKind::Static),
            1 => (body.set_angular_velocity(spin), kind != BodyKind::Static),
            2 => (body.apply_impulse_at(push * mass, at), kind == BodyKind::Dynamic),
            3 => (body.apply_force(push * (100.0 * mass)), kind == BodyKind::Dynamic),
            4 => (body.set_steady_force(push * (5.0 * mass), spin * (0.1 * mass)), kind == BodyKind::Dynamic),
            5 => (body.set_surface_velocity(push), true),
            _ => (body.set_gravity_scale(push[0]), true),
        };
        expect(result.as_ref(), good, "a push of what does not move");
        result.is_ok()
    }

    fn lead(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        let body = self.world.body(handle).expect("alive");
        let good = body.kind() == BodyKind::Kinematic && !body.is_quarantined();
        let near = Pose::new(body.rotation(), body.position() + self.dice.vector::<N>(0.1));
        let result = self.world.move_kinematic(handle, near);
        expect(result.as_ref(), good, "a way for what is not kinematic");
        result.is_ok()
    }

    fn wake(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        self.world.body_mut(handle).expect("alive").wake();
        true
    }

    fn change_shape(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        let shape = self.dice.shape();
        // What pushes a heavy body would throw one that is ten thousand times lighter.
        self.world.body_mut(handle).expect("alive").clear_forces();
        self.world.set_shape(handle, shape).expect("any kind of body can have it");
        true
    }

    /// Another kind, and now and then a sensor or another material.
    fn change_body(&mut self) -> bool {
        let Some(handle) = self.any_body() else { return false };
        let mut def = self.world.body(handle).expect("alive").def().kind(self.dice.kind());
        def.mass = None;
        def.sensor = self.dice.below(6) == 0;
        def.material.friction = self.dice.between(0.0, 1.0);
        let endless = matches!(def.shape, Shape::HalfSpace { .. }) && def.kind != BodyKind::Static;
        self.world.body_mut(handle).expect("alive").clear_forces();
        let idle = def.kind != BodyKind::Dynamic && self.ties(handle).any(|(_, other)| !self.moves(other));
        let result = self.world.set_body(handle, def);
        expect(result.as_ref(), !endless && !idle, "a floor that moves, or a joint with nothing to do");
        result.is_ok()
    }

    fn filter(&mut self) -> bool {
        let (Some(a), Some(b)) = (self.any_body(), self.any_body()) else { return false };
        let choice = self.dice.below(4);
        if choice == 3 {
            let result = self.world.set_collision(a, b, self.dice.below(2) == 0);
            expect(result.as_ref(), a != b, "a body that does not collide with itself");
            return result.is_ok();
        }
        let side = (self.dice.below(2) == 0).then_some(Vector::unit(1));
        let on = self.dice.below(2) == 0;
        let mut body = self.world.body_mut(a).expect("alive");
        match choice {
            0 => body.set_groups(if on { Groups::ALL } else { Groups::NONE }),
            1 => body.set_sensor(on),
            _ => body.set_one_way(side).expect("a direction"),
        }
        true
    }

    fn owned(&self) -> Owned {
        Owned { bodies: self.bodies.clone(), joints: self.joints.clone(), hash: self.world.state_hash() }
    }

    fn save(&mut self, carry: impl Fn(Snapshot<N>) -> Snapshot<N>) -> bool {
        self.saved = Some((carry(self.world.snapshot()), self.owned()));
        true
    }

    fn load(&mut self) -> bool {
        let Some((snapshot, owned)) = self.saved.clone() else { return false };
        self.world.restore(&snapshot);
        self.take_back(owned);
        // What was recorded belongs to another history.
        self.past.clear();
        self.before.clear();
        true
    }

    fn go_back(&mut self) -> bool {
        let steps = self.dice.below(PAST + 4) as u64;
        let there = self.world.step_count().checked_sub(steps);
        let held = there.filter(|step| self.past.steps().is_some_and(|(first, last)| (first..=last).contains(step)));
        match (self.past.back(&mut self.world, steps), held) {
            (Ok(()), Some(step)) => {
                self.take_back(self.before[&step].clone());
                self.before.retain(|&at, _| at <= step);
            }
            (Err(error), None) => assert_eq!(error.kind(), WorldErrorKind::NotHeld),
            (result, held) => panic!("back by {steps} came to {result:?}, though {held:?} was held"),
        }
        held.is_some()
    }

    /// The world went back to where one had this. What came later is gone.
    fn take_back(&mut self, owned: Owned) {
        assert_eq!(self.world.state_hash(), owned.hash, "the state is another one than it was then");
        self.gone_bodies.extend(&self.bodies);
        self.gone_joints.extend(&self.joints);
        (self.bodies, self.joints) = (owned.bodies, owned.joints);
        self.bodies.iter().for_each(|body| _ = self.gone_bodies.remove(body));
        self.joints.iter().for_each(|joint| _ = self.gone_joints.remove(joint));
    }

    fn step(&mut self) -> bool {
        self.past.record(&self.world).expect("room");
        self.before.insert(self.world.step_count(), self.owned());
        if self.before.len() > 2 * PAST {
            self.before.pop_first();
        }
        self.world.step();
        for broken in self.world.events().broken_joints() {
            self.joints.retain(|joint| *joint != broken.joint);
            self.gone_joints.insert(broken.joint);
        }
        true
    }

    /// That the world has what it must have, and takes no handle of what is gone.
    fn check(&mut self) {
        assert_eq!(self.world.body_count(), self.bodies.len());
        assert_eq!(self.world.joint_count(), self.joints.len());
        assert!(self.bodies.iter().all(|&body| self.world.body(body).is_some()));
        assert!(self.joints.iter().all(|&joint| self.world.joint(joint).is_some()));
        for &body in &self.gone_bodies {
            let shape = Shape::ball(0.1).expect("a ball");
            let calls = [
                self.world.body(body).is_none() && self.world.body_mut(body).is_none(),
                is_stale(self.world.remove_body(body)),
                is_stale(self.world.set_shape(body, shape)),
                is_stale(self.world.move_kinematic(body, Pose::IDENTITY)),
                is_stale(self.world.add_joint(JointDef::mouse(body, Vector::ZERO, Vector::ZERO, 1.0))),
            ];
            self.tally.stale_tried += calls.len() as u64;
            self.tally.stale_refused += calls.iter().map(|&refused| u64::from(refused)).sum::<u64>();
        }
        for &joint in &self.gone_joints {
            let calls = [
                self.world.joint(joint).is_none() && self.world.joint_bodies(joint).is_none(),
                is_stale(self.world.remove_joint(joint)),
                is_stale(self.world.set_joint_target(joint, Vector::ZERO)),
            ];
            self.tally.stale_tried += calls.len() as u64;
            self.tally.stale_refused += calls.iter().map(|&refused| u64::from(refused)).sum::<u64>();
        }
        for (handle, body) in self.world.bodies() {
            assert!(body.is_quarantined() || body.position().is_finite(), "{handle:?} is at {:?}", body.position());
        }
    }

    /// Removes everything; what is left of it then has leaked. Bytes that are read again are checked throughout: every
    /// index is that of something, every list agrees with the others.
    fn leave(&mut self) {
        let whole = Snapshot::<N>::from_bytes(&self.world.snapshot().to_bytes());
        assert!(whole.is_ok(), "the state does not agree with itself: {whole:?}");
        self.tally.quarantined += self.world.quarantined().len() as u64;
        for body in std::mem::take(&mut self.bodies) {
            self.world.remove_body(body).expect("alive");
        }
        self.tally.pairs_leaked += self.world.pair_count() as u64;
        assert_eq!((self.world.body_count(), self.world.joint_count()), (0, 0));
        self.world.step();
        self.world.step();
        assert!(self.world.events().contacts().is_empty(), "an empty world still tells of touches");
    }
}

fn is_stale<T>(result: Result<T, WorldError>) -> bool {
    result.is_err_and(|error| error.kind() == WorldErrorKind::StaleHandle)
}

/// That a call was taken if it is good, and refused for the right reason if not.
fn expect<T>(result: Result<T, &WorldError>, good: bool, what: &str) {
    match result {
        Ok(_) => assert!(good, "{what} was taken"),
        Err(error) => {
            let kinds = [WorldErrorKind::NotAllowed, WorldErrorKind::BadShape];
            assert!(!good && kinds.contains(&error.kind()), "{error}");
        }
    }
}
