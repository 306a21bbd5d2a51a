//! What games do to a world between two steps: wild numbers, teleports, sudden speeds, sleepers that are disturbed. None of
//! it may harm other bodies, go unnoticed, or make contacts where nothing touches.

use crate::common::*;
use hyperbody_dynamics::{BodyDef, BodyHandle, BodyKind, JointDef, POSITION_LIMIT, Tuning, World, WorldDef};
use hyperbody_geometry::{Shape, regular};
use hyperbody_math::{Bivector, Pose, Vector};

fn height<const N: usize>(world: &World<N>, body: BodyHandle) -> f64 {
    world.body(body).unwrap().position()[1]
}

fn resting_cube<const N: usize>(world: &mut World<N>) -> BodyHandle {
    world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5)).unwrap()
}

/// A world with sleeping on, a floor, and a cube that has fallen asleep on it.
fn with_sleeper<const N: usize>() -> (World<N>, BodyHandle) {
    let mut world = World::<N>::new(WorldDef { gravity: down(), ..WorldDef::default() }).unwrap();
    add_floor(&mut world, material(0.5, 0.0));
    let cube = resting_cube(&mut world);
    run(&mut world, 2.0);
    assert!(world.body(cube).unwrap().is_sleeping());
    (world, cube)
}

fn wild_numbers<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    let calm = resting_cube(&mut world);
    let place = |x: f64| Vector::unit(1) * 0.5 + Vector::unit(0) * x;
    let wild = [
        BodyDef::new(cuboid(Vector::splat(0.5))).position(place(3.0)).velocity(Vector::splat(1e300)),
        BodyDef::new(cuboid(Vector::splat(0.5)))
            .position(place(-3.0) + Vector::unit(1) * 20.0)
            .angular_velocity(Bivector::plane(0, 1, 1e300)),
        BodyDef::new(ball(0.5)).position(place(6.0)).velocity(Vector::splat(1e308)),
        BodyDef::new(ball(0.5)).kind(BodyKind::Kinematic).position(place(9.0)).velocity(Vector::unit(1) * 1e300),
    ];
    for def in wild {
        world.add_body(def).unwrap();
    }
    let pushed = world.add_body(BodyDef::new(ball(0.5)).position(place(-6.0))).unwrap();
    world.body_mut(pushed).unwrap().apply_force(Vector::unit(0) * -1e200).unwrap();
    world.body_mut(pushed).unwrap().apply_torque(Bivector::plane(0, 1, 1e200)).unwrap();
    for _ in 0..60 {
        world.step();
        for (_, body) in world.bodies() {
            assert!(body.velocity().norm() <= 1.001 * Tuning::default().max_speed);
            assert!(body.angular_velocity().norm() <= 1.001 * Tuning::default().max_spin);
        }
    }
    assert!(world.quarantined().is_empty(), "finite numbers are brought within limits");
    let calm = world.body(calm).unwrap();
    assert!((calm.position() - place(0.0)).norm() < 1e-3, "the calm cube moved to {:?}", calm.position());
}

/// A light ball lies against a cube and is pushed beyond all numbers: it alone is put aside.
#[test]
fn a_push_beyond_all_numbers_harms_no_neighbour() {
    let mut world = world(down::<4>());
    add_floor(&mut world, material(0.5, 0.0));
    let cube = resting_cube(&mut world);
    let light = BodyDef::new(ball(0.3)).position(Vector::unit(1) * 0.3 - Vector::unit(0) * 0.8).mass(1e-12);
    let light = world.add_body(light).unwrap();
    run(&mut world, 0.2);
    world.body_mut(light).unwrap().apply_force(Vector::unit(0) * 1e300).unwrap();
    run(&mut world, 0.5);
    assert_eq!(world.quarantined(), [light]);
    assert!((height(&world, cube) - 0.5).abs() < 2e-3);
}

#[test]
fn wild_but_finite_numbers_are_brought_within_limits() {
    wild_numbers::<2>();
    wild_numbers::<3>();
    wild_numbers::<4>();
    wild_numbers::<6>();
}

#[test]
fn places_out_of_bounds_are_refused() {
    let mut world = world(down::<4>());
    let far = Vector::unit(2) * (2.0 * POSITION_LIMIT);
    let refused = world.add_body(BodyDef::new(ball(0.5)).position(far)).unwrap_err();
    assert!(refused.to_string().contains("1e15"), "{refused}");
    let body = world.add_body(BodyDef::new(ball(0.5))).unwrap();
    assert!(world.body_mut(body).unwrap().set_pose(Pose::from_translation(far)).is_err());
    let slow = WorldDef::<4> { dt: 1.0, ..WorldDef::default() };
    assert!(World::new(slow).err().unwrap().to_string().contains("25 substeps"));
}

fn sleeper_is_hit<const N: usize>() {
    let (mut world, cube) = with_sleeper::<N>();
    let mass = world.body(cube).unwrap().mass();
    let shot = BodyDef::new(ball(0.3)).position(Vector::unit(1) * 0.5 - Vector::unit(0) * 1.4).mass(mass);
    world.add_body(shot.velocity(Vector::unit(0) * 40.0).gravity_scale(0.0)).unwrap();
    for _ in 0..3 {
        world.step();
    }
    let speed = world.body(cube).unwrap().velocity()[0];
    assert!((15.0..=25.0).contains(&speed), "half of 40 m/s goes over when nothing bounces, not {speed} m/s, in {N}D");
}

#[test]
fn a_fast_body_wakes_the_sleeper_that_it_hits() {
    sleeper_is_hit::<2>();
    sleeper_is_hit::<4>();
    sleeper_is_hit::<5>();
}

/// A box rests 3 cm from a wall, so that their pair is known and empty; then it is shot at the wall.
fn sudden_speed<const N: usize>() {
    let mut world = world(Vector::<N>::ZERO);
    let wall = Vector::from_fn(|axis| if axis == 0 { 0.05 } else { 2.0 });
    world.add_body(BodyDef::fixed(cuboid(wall)).position(Vector::unit(0) * 0.58)).unwrap();
    let cube = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5)))).unwrap();
    run(&mut world, 0.2);
    world.body_mut(cube).unwrap().set_velocity(Vector::unit(0) * 100.0).unwrap();
    for _ in 0..10 {
        world.step();
    }
    let x = world.body(cube).unwrap().position()[0];
    assert!((0.0..0.06).contains(&x), "the box stops at the wall, not at {x} m, in {N}D");
}

#[test]
fn a_speed_set_beside_a_wall_does_not_tunnel() {
    sudden_speed::<2>();
    sudden_speed::<3>();
    sudden_speed::<4>();
    sudden_speed::<5>();
    sudden_speed::<6>();
}

/// Balls shot obliquely over the edge of a thin wall: those whose path meets it are stopped.
fn oblique_shot<const N: usize>(speed_along: f64, start: f64) {
    let mut world = world(Vector::<N>::ZERO);
    let wall = Vector::from_fn(|axis| if axis == 0 { 0.05 } else { 2.0 });
    world.add_body(BodyDef::fixed(cuboid(wall))).unwrap();
    let position = Vector::unit(0) * -start + Vector::unit(1) * start;
    let shot = BodyDef::new(ball(0.05)).position(position);
    let shot =
        world.add_body(shot.velocity(Vector::unit(0) * speed_along - Vector::unit(1) * (0.5 * speed_along))).unwrap();
    for _ in 0..6 {
        world.step();
    }
    let x = world.body(shot).unwrap().position()[0];
    assert!(x < 0.0, "a ball at {speed_along} m/s goes through to {x} m in {N}D");
}

#[test]
fn oblique_shots_do_not_pass_thin_walls() {
    for (speed, start) in [(400.0, 3.0), (150.0, 2.6), (60.0, 3.5), (250.0, 3.8), (90.0, 2.4)] {
        oblique_shot::<2>(speed, start);
        oblique_shot::<3>(speed, start);
        oblique_shot::<4>(speed, start);
        oblique_shot::<6>(speed, start);
    }
}

/// A simplex that lands on a corner at ten metres a second slams its others down: none goes deep into the floor.
fn slam<const N: usize>() {
    let mut random = Random(12);
    let mut deepest: f64 = 0.0;
    for _ in 0..20 {
        let mut world = world(down::<N>());
        add_floor(&mut world, material(0.5, 0.0));
        let simplex = regular::polytope::<N>("simplex", regular::Size::Circumradius(0.7)).unwrap();
        let simplex = Shape::polytope(std::sync::Arc::new(simplex)).unwrap();
        let def = BodyDef::new(simplex).position(Vector::unit(1) * 1.0).rotation(random.rotation(2.0));
        world.add_body(def.velocity(Vector::unit(1) * -10.0)).unwrap();
        for _ in 0..60 {
            world.step();
            deepest = deepest.max(world.max_penetration());
        }
    }
    println!("{N}D: {deepest} m");
    assert!(deepest < 0.01, "a corner goes {deepest} m into the floor in {N}D");
}

#[test]
fn corners_that_slam_down_do_not_go_deep() {
    slam::<2>();
    slam::<3>();
    slam::<4>();
    slam::<5>();
}

/// A plate, thin against the margin of contacts, and a pillar as slender as a pencil, stay as they were put.
fn thin_things_rest<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    let plate = Vector::from_fn(|axis| if axis == 1 { 0.005 } else { 0.5 });
    let plate = world.add_body(BodyDef::new(cuboid(plate)).position(Vector::unit(1) * 0.005)).unwrap();
    let pillar = Vector::from_fn(|axis| if axis == 1 { 0.5 } else { 0.02 });
    let place = Vector::unit(1) * 0.5 + Vector::unit(0) * 3.0;
    let pillar = world.add_body(BodyDef::new(cuboid(pillar)).position(place)).unwrap();
    run(&mut world, 5.0);
    for (name, body) in [("the plate", plate), ("the pillar", pillar)] {
        let up = world.body(body).unwrap().rotation().rotate(Vector::unit(1));
        let tilt = (up - Vector::unit(1)).norm();
        assert!(tilt < 2e-3, "{name} leans by {tilt} rad after 5 s in {N}D");
    }
}

#[test]
fn thin_plates_and_slender_pillars_stay_put() {
    thin_things_rest::<2>();
    thin_things_rest::<3>();
    thin_things_rest::<4>();
    thin_things_rest::<5>();
    thin_things_rest::<6>();
}

fn support_is_taken_away<const N: usize>() {
    let mut world = World::<N>::new(WorldDef { gravity: down(), ..WorldDef::default() }).unwrap();
    let slab = BodyDef::fixed(cuboid(Vector::from_fn(|axis| if axis == 1 { 0.1 } else { 2.0 })));
    let slab = world.add_body(slab.position(Vector::unit(1) * -0.1)).unwrap();
    let cube = resting_cube(&mut world);
    run(&mut world, 2.0);
    assert!(world.body(cube).unwrap().is_sleeping());
    world.body_mut(slab).unwrap().set_pose(Pose::from_translation(Vector::unit(1) * -50.0)).unwrap();
    run(&mut world, 1.0);
    assert!(height(&world, cube) < -3.0, "it falls when its support is gone");
}

#[test]
fn a_sleeper_falls_when_its_static_support_is_moved_away() {
    support_is_taken_away::<2>();
    support_is_taken_away::<4>();
}

#[test]
fn removing_one_body_does_not_wake_all_that_share_its_ground() {
    let (mut world, cube) = with_sleeper::<4>();
    let other = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5 + Vector::unit(0) * 5.0);
    let other = world.add_body(other).unwrap();
    world.step();
    world.remove_body(other).unwrap();
    world.step();
    assert!(world.body(cube).unwrap().is_sleeping());
}

#[test]
fn a_static_body_put_into_a_sleeper_pushes_it_out() {
    let (mut world, cube) = with_sleeper::<4>();
    let post = BodyDef::fixed(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.5 + Vector::unit(0) * 0.8);
    world.add_body(post).unwrap();
    run(&mut world, 2.0);
    let x = world.body(cube).unwrap().position()[0];
    assert!((-0.3..-0.15).contains(&x), "pushed out by the overlap of 0.2 m, to {x} m");
}

/// Two bodies pass each other on a diagonal, near but never touching; spinning ones as well. Nothing may change their course.
fn flyby<const N: usize>() {
    let mut random = Random(5);
    for trial in 0..60 {
        let mut world = world(Vector::<N>::ZERO);
        let speed = random.between(20.0, 400.0);
        let spin = if trial % 2 == 0 { 0.0 } else { random.between(10.0, 60.0) };
        let other =
            world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).angular_velocity(Bivector::plane(0, 1, spin)));
        let other = other.unwrap();
        // Bounding balls of both, and 0.2 m.
        let clear = (0.5 * (N as f64).sqrt() + 0.3) + 0.2;
        let start = Vector::unit(1) * clear - Vector::unit(0) * random.between(0.1, 0.2) * speed;
        let ball = world.add_body(BodyDef::new(ball(0.3)).position(start).velocity(Vector::unit(0) * speed)).unwrap();
        run(&mut world, 0.4);
        let (ball, other) = (world.body(ball).unwrap(), world.body(other).unwrap());
        assert!(
            (ball.velocity() - Vector::unit(0) * speed).norm() < 1e-9,
            "deflected to {:?} in {N}D",
            ball.velocity()
        );
        assert_eq!(other.velocity(), Vector::ZERO);
    }
}

#[test]
fn bodies_that_pass_each_other_do_not_feel_it() {
    flyby::<2>();
    flyby::<3>();
    flyby::<4>();
    flyby::<6>();
}

/// A rod on a ball joint whirls at half a radian a step: its anchor stays within a twentieth of the arm.
#[test]
fn a_joint_follows_fast_turns() {
    let mut world = world(Vector::<4>::ZERO);
    let pivot = world.add_body(BodyDef::fixed(ball(0.1))).unwrap();
    let rod = BodyDef::new(cuboid(Vector([0.5, 0.05, 0.05, 0.05]))).position(Vector::unit(0) * 0.5);
    let spin = 30.0;
    let rod = rod.velocity(Vector::unit(1) * (0.5 * spin)).angular_velocity(Bivector::plane(0, 1, spin));
    let rod = world.add_body(rod).unwrap();
    let anchor_b = Vector::unit(0) * -0.5;
    world.add_joint(JointDef::ball(pivot, rod, Vector::ZERO, anchor_b)).unwrap();
    let before = world.energy().kinetic;
    for _ in 0..240 {
        world.step();
        let anchor = world.body(rod).unwrap().pose().transform_point(anchor_b);
        assert!(anchor.norm() < 0.025, "the anchor is {} m from its pivot", anchor.norm());
    }
    // The law of the pivot is of first order in the turn a substep, an eighth of a radian here: energy is lost, never won.
    assert!(world.energy().kinetic <= before, "the whirl gained energy");
}

fn weak_gravity<const N: usize>(g: f64) {
    let def = WorldDef { gravity: Vector::unit(1) * -g, ..WorldDef::default() };
    let mut world = World::<N>::new(def).unwrap();
    let pair = [1.0, 2.0].map(|y| world.add_body(BodyDef::new(ball(0.5)).position(Vector::unit(1) * y)).unwrap());
    run(&mut world, 8.0);
    let fallen = 1.0 - height(&world, pair[0]);
    let exact = 0.5 * g * 64.0;
    assert!((fallen / exact - 1.0).abs() < 0.01, "fell {fallen} m of {exact} m at {g} m/s²");
}

#[test]
fn nothing_falls_asleep_in_mid_air() {
    weak_gravity::<3>(0.05);
    weak_gravity::<4>(0.001);
    weak_gravity::<5>(0.08);
}

#[test]
fn a_body_let_out_of_quarantine_where_it_was_rests_as_before() {
    let mut world = world(down::<4>());
    add_floor(&mut world, material(0.5, 0.0));
    let cube = resting_cube(&mut world);
    run(&mut world, 1.0);
    let pose = world.body(cube).unwrap().pose();
    for _ in 0..2 {
        world.body_mut(cube).unwrap().apply_force(Vector::unit(0) * 1e308).unwrap();
    }
    world.step();
    assert_eq!(world.quarantined(), [cube]);
    run(&mut world, 0.5);
    assert_eq!(world.contacts().count(), 0, "what is in quarantine touches nothing");
    world.body_mut(cube).unwrap().set_pose(pose).unwrap();
    for _ in 0..60 {
        world.step();
        assert!((height(&world, cube) - pose.translation[1]).abs() < 1e-3, "it dips to {}", height(&world, cube));
    }
    assert!(world.quarantined().is_empty());
}

#[test]
fn a_joint_of_a_body_in_quarantine_bears_nothing() {
    let mut world = world(down::<4>());
    let bob = world.add_body(BodyDef::new(ball(0.2)).position(Vector::unit(1) * -1.0)).unwrap();
    let rope = world.add_joint(JointDef::rope(None, bob, Vector::ZERO, Vector::ZERO, 1.0)).unwrap();
    run(&mut world, 1.0);
    assert!(world.joint(rope).unwrap().force().norm() > 0.0);
    for _ in 0..2 {
        world.body_mut(bob).unwrap().apply_force(Vector::unit(0) * 1e308).unwrap();
    }
    for _ in 0..3 {
        world.step();
        assert_eq!(world.quarantined(), [bob]);
        assert_eq!(world.joint(rope).unwrap().force().norm(), 0.0);
        let bytes = world.snapshot().to_bytes();
        assert!(
            hyperbody_dynamics::Snapshot::<4>::from_bytes(&bytes).is_ok(),
            "what is in quarantine can be written and read"
        );
    }
}

#[test]
fn a_slow_platform_carries_its_rider_without_a_jerk() {
    let mut world = World::<4>::new(WorldDef { gravity: down(), ..WorldDef::default() }).unwrap();
    let slab = cuboid(Vector::from_fn(|axis| if axis == 1 { 0.1 } else { 2.0 }));
    let platform = BodyDef::new(slab).kind(BodyKind::Kinematic).position(Vector::unit(1) * -0.1);
    world.add_body(platform.velocity(Vector::unit(0) * 0.02)).unwrap();
    let cube = resting_cube(&mut world);
    run(&mut world, 2.0);
    let mut last = world.body(cube).unwrap().position()[0];
    for _ in 0..600 {
        world.step();
        let x = world.body(cube).unwrap().position()[0];
        assert!((x - last - 0.02 / 60.0).abs() < 1e-5, "it moved {} m in a step", x - last);
        last = x;
    }
}

/// What contacts report is what the bodies got: the weight while at rest, the momentum when something lands.
fn impulses<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.0));
    let def = BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 1.0);
    let cube = world.add_body(def).unwrap();
    let mass = world.body(cube).unwrap().mass();
    let mut sum = 0.0;
    for step in 1..=120 {
        let before = world.body(cube).unwrap().velocity()[1];
        world.step();
        let change = mass * (world.body(cube).unwrap().velocity()[1] - before + GRAVITY / 60.0);
        let reported: f64 =
            world.contacts().flat_map(|contact| contact.points().map(|(_, _, j)| j).collect::<Vec<_>>()).sum();
        sum += reported;
        assert!((reported - change).abs() < 1e-4 * mass, "step {step} in {N}D: reported {reported}, felt {change}");
    }
    assert!((sum - mass * GRAVITY * 2.0).abs() < 1e-2 * mass, "all that gravity gave, {sum}");
}

#[test]
fn contacts_report_the_impulses_that_bodies_feel() {
    impulses::<2>();
    impulses::<3>();
    impulses::<4>();
    impulses::<5>();
    impulses::<6>();
}

/// A box that lands flat and bounces goes straight back up.
fn flat_landing<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.5, 0.9));
    let extents = Vector::from_fn(|axis| 0.3 + 0.1 * axis as f64);
    let def = BodyDef::new(cuboid(extents)).position(Vector::unit(1) * 3.0).material(material(0.5, 0.9));
    let body = world.add_body(def).unwrap();
    let mut falling = 0.0;
    for _ in 0..120 {
        let before = world.body(body).unwrap().velocity()[1];
        world.step();
        let after = world.body(body).unwrap().velocity()[1];
        if before < -1.0 && after > 0.0 {
            falling = before;
            assert!((after / -before - 0.9).abs() < 0.05, "bounces from {before} to {after} m/s in {N}D");
            break;
        }
    }
    assert!(falling < -1.0, "it lands");
    let spin = world.body(body).unwrap().angular_velocity().norm();
    assert!(spin < 1e-4, "landing flat leaves a spin of {spin} rad/s in {N}D");
}

#[test]
fn a_flat_landing_gives_no_spin() {
    flat_landing::<2>();
    flat_landing::<3>();
    flat_landing::<4>();
    flat_landing::<5>();
    flat_landing::<6>();
}

/// A ball that gives back all of its speed keeps nearly all of its energy, bounce after bounce.
fn lossless_bounces<const N: usize>() {
    let mut world = world(down::<N>());
    add_floor(&mut world, material(0.0, 1.0));
    let def = BodyDef::new(ball(0.5)).position(Vector::unit(1) * 3.0).material(material(0.0, 1.0));
    world.add_body(def).unwrap();
    let start = world.energy().total();
    run(&mut world, 20.0);
    let ground = world.bodies().nth(1).unwrap().1.mass() * GRAVITY * 0.5;
    let kept = (world.energy().total() - ground) / (start - ground);
    println!("{N}D keeps {kept} of the energy through fourteen bounces");
    // Touches fall between steps, which costs a percent or two a bounce at 60 Hz.
    assert!((0.8..=1.02).contains(&kept), "{kept} of the energy is left after 20 s in {N}D");
}

#[test]
fn a_ball_of_restitution_one_keeps_bouncing() {
    lossless_bounces::<2>();
    lossless_bounces::<3>();
    lossless_bounces::<4>();
    lossless_bounces::<6>();
}

#[test]
fn shapes_may_be_static_half_spaces_only() {
    let half_space = Shape::<3>::half_space(Vector::unit(1), 0.0).unwrap();
    let mut world = world(down::<3>());
    assert!(world.add_body(BodyDef::new(half_space).kind(BodyKind::Kinematic)).is_err());
}

/// After a journey on which small steps would be lost, contacts follow as before.
#[test]
fn a_body_back_from_afar_falls_off_a_table() {
    let mut world = world(down::<3>());
    let table = BodyDef::fixed(cuboid(Vector([1.0, 0.5, 1.0]))).material(material(0.0, 0.0));
    world.add_body(table).unwrap();
    let half = Vector::splat(0.2);
    let slider = world.add_body(BodyDef::new(cuboid(half)).material(material(0.0, 0.0))).unwrap();
    world.body_mut(slider).unwrap().set_pose(Pose::from_translation(Vector::unit(0) * 1e15)).unwrap();
    world.step();
    let start = Vector([0.5, 0.7, 0.0]);
    world.body_mut(slider).unwrap().set_pose(Pose::from_translation(start)).unwrap();
    world.body_mut(slider).unwrap().set_velocity(Vector::unit(0) * 0.4).unwrap();
    run(&mut world, 3.0);
    let place = world.body(slider).unwrap().position();
    assert!(place[1] < -1.0, "it hangs at {place:?}");
}

/// A floor that is put elsewhere is met, even where no contact is ever carried along.
#[test]
fn a_floor_lifted_into_a_resting_body_is_felt() {
    let tuning = Tuning { recycle_distance: 0.0, ..Tuning::default() };
    let def = WorldDef { gravity: Vector::<3>::ZERO, sleeping: false, tuning, ..WorldDef::default() };
    let mut world = World::new(def).unwrap();
    let floor = add_floor(&mut world, material(0.5, 0.0));
    let cube = world.add_body(BodyDef::new(cuboid(Vector::splat(0.5))).position(Vector::unit(1) * 0.51)).unwrap();
    run(&mut world, 0.2);
    world.body_mut(floor).unwrap().set_pose(Pose::from_translation(Vector::unit(1) * 0.1)).unwrap();
    run(&mut world, 1.0);
    let place = world.body(cube).unwrap().position()[1];
    assert!(place > 0.59, "the cube stands {} m in the floor", 0.6 - place);
}
