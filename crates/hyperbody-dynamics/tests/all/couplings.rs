//! Gears, racks and screws: exact ratios however long they run, the accelerations of mechanics, momenta kept where nothing
//! outside acts, forces that are reported and break.

use std::f64::consts::{PI, TAU};

use crate::common::{assert_close, ball, cuboid, in_all_dimensions, world};
use hyperbody_dynamics::{
    BodyDef, BodyHandle, Coupling, Groups, JointDef, JointHandle, Snapshot, World, WorldDef, WorldErrorKind,
};
use hyperbody_math::{Bivector, Pose, Vector};

in_all_dimensions! {
    gears_keep_their_ratio_for_minutes: gears;
    a_gear_train_in_empty_space_keeps_its_momenta: planetary;
    a_rack_falls_as_its_wheel_lets_it: rack;
    a_weight_on_a_screw_falls_as_it_turns: screw;
}

/// A plane in which wheels turn, not the first one from 3D on.
const fn plane<const N: usize>() -> (usize, usize) {
    (if N > 2 { 1 } else { 0 }, N - 1)
}

fn wheel<const N: usize>(world: &mut World<N>, at: Vector<N>) -> BodyHandle {
    world.add_body(BodyDef::new(ball(0.3)).position(at).groups(Groups::NONE)).unwrap()
}

fn hinged<const N: usize>(world: &mut World<N>, body: BodyHandle) -> JointHandle {
    let place = Pose::from_translation(world.body(body).unwrap().position());
    world.add_joint(JointDef::hinge(None, body, place, Pose::IDENTITY, plane::<N>())).unwrap()
}

/// Moment of a ball in any plane, kg·m².
fn moment<const N: usize>(world: &World<N>, body: BodyHandle) -> f64 {
    2.0 * world.body(body).unwrap().principal_moments()[0]
}

/// Angles that are counted beyond half a turn.
struct Counter {
    body: BodyHandle,
    angle: f64,
    last: f64,
}

impl Counter {
    fn new(body: BodyHandle) -> Self {
        Self { body, angle: 0.0, last: 0.0 }
    }

    /// Looks how the body has turned in the plane, seen from `base`.
    fn look<const N: usize>(&mut self, world: &World<N>, base: Option<BodyHandle>) -> f64 {
        let (i, j) = plane::<N>();
        let body = world.body(self.body).unwrap().rotation();
        let seen = base.map_or(body, |base| world.body(base).unwrap().rotation().inverse() * body);
        let now = seen.matrix()[j][i].atan2(seen.matrix()[i][i]);
        let change = now - self.last;
        self.angle += change - TAU * (change / TAU).round();
        self.last = now;
        self.angle
    }
}

/// A driven wheel, one that it drives, and a ring around that, with a brake: after two minutes the angles fit the teeth, and
/// the tooth carries what the brake takes.
fn gears<const N: usize>() {
    let mut world = world::<N>(Vector::ZERO);
    let (i, j) = plane::<N>();
    let first = wheel(&mut world, Vector::ZERO);
    let second = wheel(&mut world, Vector::unit(i) * 0.6 + Vector::unit(j) * 0.8);
    let ring = wheel(&mut world, Vector::unit(i) * 0.6 + Vector::unit(j) * 0.4);
    let drive = hinged(&mut world, first);
    let def = world.joint(drive).unwrap().def().clone().motor(i, j, 7.0, 5.0);
    world.set_joint(drive, def).unwrap();
    hinged(&mut world, second);
    let brake = hinged(&mut world, ring);
    let torque = 0.3;
    let def = world.joint(brake).unwrap().def().clone().motor(i, j, 0.0, torque);
    world.set_joint(brake, def).unwrap();
    let at = Pose::IDENTITY;
    world.add_joint(JointDef::gear(first, second, at, at, (i, j), (12, 30))).unwrap();
    let inner = world.add_joint(JointDef::gear(second, ring, at, at, (i, j), (-30, 70))).unwrap();
    let mut angles = [first, second, ring].map(Counter::new);
    let mut worst: f64 = 0.0;
    for _ in 0..7200 {
        world.step();
        let [a, b, c] = angles.each_mut().map(|counter| counter.look(&world, None));
        worst = worst.max((12.0 * a + 30.0 * b).abs() / 12.0).max((30.0 * b - 70.0 * c).abs() / 30.0);
    }
    let turned = angles[0].angle;
    assert!(turned > 700.0, "{N}D: the first wheel turned by {turned} rad only");
    // Of the first wheel's angle: half a milliradian of play under load, and no more after a hundred turns than after one.
    assert!(worst < 2e-3, "{N}D: off by {worst} rad in {turned}");
    // The ring has a radius of 70/40 of the distance of 0.4 m.
    let force = world.joint(inner).unwrap().force().norm();
    assert_close(&format!("{N}D: force on the tooth"), force, torque / (0.4 * 70.0 / 40.0), 0.01);
}

/// A carrier with two wheels that mesh, adrift: the wheels are turned against each other by the teeth and take the carrier along.
fn planetary<const N: usize>() {
    let mut world = world::<N>(Vector::ZERO);
    let (i, j) = plane::<N>();
    let bar = cuboid(Vector::from_fn(|k| if k == i { 0.6 } else { 0.1 }));
    let drift = Vector::unit(0) * 0.3;
    let carrier = world.add_body(BodyDef::new(bar).groups(Groups::NONE).velocity(drift)).unwrap();
    let ends = [-0.5, 0.5].map(|x| Vector::<N>::unit(i) * x);
    let spins = [9.0, 2.0];
    let wheels = [0, 1].map(|k| {
        let spin = Bivector::plane(i, j, spins[k]);
        let def = BodyDef::new(ball(0.3)).position(ends[k]).groups(Groups::NONE).velocity(drift).angular_velocity(spin);
        let wheel = world.add_body(def).unwrap();
        let hinge = JointDef::hinge(carrier, wheel, Pose::from_translation(ends[k]), Pose::IDENTITY, (i, j));
        world.add_joint(hinge).unwrap();
        wheel
    });
    let gear = JointDef::gear(wheels[0], wheels[1], Pose::IDENTITY, Pose::IDENTITY, (i, j), (20, 30));
    world.add_joint(gear).unwrap();
    let (momentum, spin) = (world.momentum(), world.angular_momentum());
    let mut angles = wheels.map(Counter::new);
    let mut settled = None;
    for step in 0..3600 {
        world.step();
        let [a, b] = angles.each_mut().map(|counter| counter.look(&world, Some(carrier)));
        let off = a / 30.0 + b / 20.0;
        // The first steps stop the unlike speeds.
        let start = *settled.get_or_insert(off);
        assert!(
            (off - start).abs() < 2e-4 || step < 10,
            "{N}D: {off} tooth radians off at step {step}, {start} at first"
        );
    }
    let (size, spin_size) = (momentum.norm(), spin.norm());
    let (off, spin_off) = ((world.momentum() - momentum).norm(), (world.angular_momentum() - spin).norm());
    assert!(off < 2e-6 * size, "{N}D: momentum off by {off} of {size}");
    assert!(spin_off < 2e-6 * spin_size, "{N}D: angular momentum off by {spin_off} of {spin_size}");
    let carried = world.body(carrier).unwrap().angular_velocity().get(i, j);
    assert!(carried.abs() > 0.05, "{N}D: the teeth press on the carrier, which turns at {carried} rad/s");
}

/// A rack on a slider, hung on a wheel: a = g/(1 + I/(m r²)).
fn rack<const N: usize>() {
    let (i, j) = plane::<N>();
    let mut world =
        World::<N>::new(WorldDef { gravity: Vector::unit(i) * -9.81, sleeping: false, ..WorldDef::default() }).unwrap();
    for radius in [0.25, -0.25] {
        let pinion = wheel(&mut world, Vector::ZERO);
        hinged(&mut world, pinion);
        let beside = Vector::unit(j) * -radius;
        let bar = BodyDef::new(cuboid(Vector::splat(0.2))).position(beside).groups(Groups::NONE);
        let bar = world.add_body(bar).unwrap();
        let place = Pose::from_translation(beside);
        world.add_joint(JointDef::slider(None, bar, place, Pose::IDENTITY, i)).unwrap();
        let rack = JointDef::rack(pinion, bar, Pose::IDENTITY, Pose::IDENTITY, (i, j), radius);
        let rack = world.add_joint(rack).unwrap();
        let mut angle = Counter::new(pinion);
        for _ in 0..120 {
            world.step();
            angle.look(&world, None);
        }
        let mass = world.body(bar).unwrap().mass();
        let inertia = moment(&world, pinion) / (radius * radius);
        let acceleration = 9.81 * mass / (mass + inertia);
        let fallen = -world.body(bar).unwrap().position()[i];
        assert_close(&format!("{N}D: fall of the rack"), fallen, 0.5 * acceleration * 4.0, 0.01);
        // The wheel rolls on the rack: what has gone down beside it has turned it.
        assert!((angle.angle * radius + fallen).abs() < 2e-3, "{N}D: {} rad for {fallen} m", angle.angle);
        let force = world.joint(rack).unwrap().force().norm();
        assert_close(&format!("{N}D: force on the teeth"), force, acceleration * inertia, 0.01);
        world.remove_body(pinion).unwrap();
        world.remove_body(bar).unwrap();
    }
}

/// A nut runs down a thread: m g lead/τ turns I + m (lead/τ)², so that a = g/(1 + I (τ/lead)²/m). In 2D there is no axis across.
fn screw<const N: usize>() {
    if N == 2 {
        return;
    }
    let (i, j) = plane::<N>();
    for lead in [0.5, -1.5] {
        let mut world =
            World::<N>::new(WorldDef { gravity: Vector::unit(0) * -9.81, sleeping: false, ..WorldDef::default() })
                .unwrap();
        let nut = wheel(&mut world, Vector::ZERO);
        let def = JointDef::screw(None, nut, Pose::IDENTITY, Pose::IDENTITY, (i, j), 0, lead);
        let joint = world.add_joint(def).unwrap();
        let mut angle = Counter::new(nut);
        for _ in 0..180 {
            world.step();
            angle.look(&world, None);
        }
        let body = world.body(nut).unwrap();
        let arm: f64 = lead / TAU;
        let acceleration = 9.81 / (1.0 + moment(&world, nut) / (body.mass() * arm * arm));
        let fallen = -body.position()[0];
        assert_close(&format!("{N}D, lead {lead}: fall"), fallen, 0.5 * acceleration * 9.0, 0.015);
        let off = angle.angle * lead / TAU + fallen;
        assert!(off.abs() < 2e-3, "{N}D: {off} m off the thread after {} rad", angle.angle);
        let torque = world.joint(joint).unwrap().torque().get(i, j);
        let expected = -moment(&world, nut) * acceleration / arm;
        assert_close(&format!("{N}D, lead {lead}: torque of the thread"), torque, expected, 0.02);
    }
}

/// A nut on a fine thread that is struck along it does not jump over turns: what the blow asks of a substep is most of a turn.
#[test]
fn a_struck_nut_stays_on_its_thread() {
    let lead = 0.005;
    let mut world = world::<3>(Vector::ZERO);
    let nut = wheel(&mut world, Vector::ZERO);
    let (i, j) = plane::<3>();
    world.add_joint(JointDef::screw(None, nut, Pose::IDENTITY, Pose::IDENTITY, (i, j), 0, lead)).unwrap();
    world.body_mut(nut).unwrap().set_velocity(Vector::unit(0)).unwrap();
    let mut turned = Counter::new(nut);
    for _ in 0..60 {
        world.step();
        turned.look(&world, None);
    }
    let (at, angle) = (world.body(nut).unwrap().position()[0], turned.look(&world, None));
    let (mass, moment) = (world.body(nut).unwrap().mass(), moment(&world, nut));
    let per_metre = TAU / lead;
    let speed = mass / (mass + moment * per_metre * per_metre);
    assert!((at - lead * angle / TAU).abs() < 1e-5, "at {at} m after {angle} rad");
    assert!(
        (angle / (speed * per_metre) - 1.0).abs() < 0.05,
        "{angle} rad in a second, {} expected",
        speed * per_metre
    );
}

/// Wheels that come to lie at one place mesh nowhere, which makes no number of anything; such joints cannot be added.
#[test]
fn wheels_at_one_place_stay_numbers() {
    let mut world = world::<4>(Vector::ZERO);
    let (a, b) = (wheel(&mut world, Vector::ZERO), wheel(&mut world, Vector::unit(1)));
    let (i, j) = plane::<4>();
    let def = JointDef::gear(a, b, Pose::IDENTITY, Pose::IDENTITY, (i, j), (10, 20));
    let gear = world.add_joint(def.clone()).unwrap();
    let mut def = def;
    def.phase = world.joint(gear).unwrap().def().phase;
    world.body_mut(b).unwrap().set_pose(Pose::from_translation(Vector::unit(0) * 1e-9)).unwrap();
    for _ in 0..10 {
        world.step();
    }
    assert!(world.quarantined().is_empty() && world.energy().kinetic.is_finite());
    world.remove_joint(gear).unwrap();
    assert_eq!(world.add_joint(def).unwrap_err().kind(), WorldErrorKind::NotAllowed);
}

/// A gear whose second wheel is held fast breaks at its strength, and not before.
#[test]
fn teeth_break() {
    let bears = f64::INFINITY;
    for (force, torque, breaks) in [(1.0, bears, true), (100.0, bears, false), (bears, 3.0, true), (bears, 5.0, false)]
    {
        let mut world = world::<4>(Vector::ZERO);
        let (i, j) = plane::<4>();
        let (a, b) = (wheel(&mut world, Vector::ZERO), wheel(&mut world, Vector::unit(i)));
        let drive = hinged(&mut world, a);
        let def = world.joint(drive).unwrap().def().clone().motor(i, j, 5.0, 4.0);
        world.set_joint(drive, def).unwrap();
        let place = Pose::from_translation(Vector::unit(i));
        world.add_joint(JointDef::weld(None, b, place, Pose::IDENTITY)).unwrap();
        let gear = JointDef::gear(a, b, Pose::IDENTITY, Pose::IDENTITY, (i, j), (10, 10));
        let gear = world.add_joint(gear.break_at(force, torque)).unwrap();
        for _ in 0..60 {
            world.step();
        }
        let broken = world.joint(gear).is_none();
        assert_eq!(broken, breaks, "4 N·m on half a metre are 8 N, and it bears {force} N and {torque} N·m");
        if let Some(gear) = world.joint(gear) {
            assert_close("force", gear.force().norm(), 8.0, 0.01);
            // What the weld keeps from turning: the tooth pushes at half a metre from the second wheel's anchor.
            assert_close("torque", gear.torque().norm(), 4.0, 0.01);
        }
    }
}

/// Any place of the wheels is one where the teeth mesh; bytes bring the coupling back, and the same future.
#[test]
fn couplings_are_saved() {
    let mut world = world::<4>(Vector::unit(0) * -9.81);
    let (i, j) = plane::<4>();
    let (a, b) = (wheel(&mut world, Vector::ZERO), wheel(&mut world, Vector::unit(i)));
    let turned = Pose::new(hyperbody_math::Rotation::in_plane(i, j, 0.37), Vector::unit(i));
    world.body_mut(b).unwrap().set_pose(turned).unwrap();
    for body in [a, b] {
        let pose = world.body(body).unwrap().pose();
        world.add_joint(JointDef::hinge(None, body, pose, Pose::IDENTITY, (i, j)).motor(i, j, 2.0, 0.2)).unwrap();
    }
    let gear = world.add_joint(JointDef::gear(a, b, Pose::IDENTITY, Pose::IDENTITY, (i, j), (9, 31))).unwrap();
    let def = world.joint(gear).unwrap().def().clone();
    assert!(def.phase.is_some_and(f64::is_finite), "the definition says from then on what is held");
    let slide = BodyDef::new(ball(0.2)).position(Vector::unit(3) * 3.0).groups(Groups::NONE);
    let slide = world.add_body(slide).unwrap();
    let place = Pose::from_translation(Vector::unit(3) * 3.0);
    world.add_joint(JointDef::screw(None, slide, place, Pose::IDENTITY, (i, j), 0, 0.4)).unwrap();
    world.add_joint(JointDef::rack(a, slide, Pose::IDENTITY, Pose::IDENTITY, (i, j), 0.1).break_at(1e3, 1e3)).unwrap();
    (0..50).for_each(|_| world.step());
    let snapshot = Snapshot::<4>::from_bytes(&world.snapshot().to_bytes()).unwrap();
    let mut other = World::<4>::new(WorldDef::default()).unwrap();
    other.restore(&snapshot);
    assert_eq!(other.joint(gear).unwrap().def(), &def);
    for _ in 0..100 {
        world.step();
        other.step();
        assert_eq!(world.state_hash(), other.state_hash());
    }
}

#[test]
fn couplings_that_make_no_sense_are_refused_with_reasons() {
    let mut world = world::<4>(Vector::ZERO);
    let (a, b) = (wheel(&mut world, Vector::ZERO), wheel(&mut world, Vector::unit(0)));
    let at = Pose::IDENTITY;
    let gear = |teeth| JointDef::gear(a, b, at, at, (0, 1), teeth);
    let screw = |lead| JointDef::screw(a, b, at, at, (0, 1), 2, lead);
    let mut locked = screw(1.0);
    locked.axes[2] = hyperbody_dynamics::Freedom::LOCKED;
    let mut no_plane = gear((1, 2));
    no_plane.coupling = Some(Coupling::Gear { plane: (1, 4), teeth: (1, 2) });
    let mut along = screw(1.0);
    along.coupling = Some(Coupling::Screw { plane: (0, 1), along: 1, lead: 1.0 });
    let concentric = JointDef::gear(a, b, at, Pose::from_translation(-Vector::unit(0)), (0, 1), (1, 2));
    let mut phase = gear((1, 2));
    phase.phase = Some(f64::NAN);
    let cases = [
        (gear((0, 3)), "1 to 1000"),
        (gear((5, -5)), "not as many"),
        (gear((5, 2000)), "1 to 1000"),
        (JointDef::rack(a, b, at, at, (0, 1), 0.0), "radius"),
        (screw(f64::INFINITY), "lead"),
        (screw(PI * 1e9), "lead"),
        (locked, "JointDef::screw"),
        (no_plane, "two different ones below 4"),
        (along, "across its plane"),
        (concentric, "must lie apart"),
        (phase, "phase"),
    ];
    for (def, hint) in cases {
        let error = world.add_joint(def).unwrap_err();
        assert!(error.to_string().contains(hint), "{error} does not say \"{hint}\"");
        assert!(matches!(error.kind(), WorldErrorKind::BadNumber | WorldErrorKind::NotAllowed));
    }
    assert_eq!(world.joint_count(), 0);
}
