//! The built-in scenes show what their sentences say.

use hyperbody_scene::{AnyWorld, BodyState, built_in};

struct Run {
    world: AnyWorld,
    start: Vec<BodyState>,
}

impl Run {
    fn new(name: &str) -> Self {
        let world = AnyWorld::new(&built_in(name).expect("a built-in scene"), 1).expect("a good scene");
        Self { start: world.body_states(), world }
    }

    fn until(&mut self, seconds: f64) -> Vec<BodyState> {
        while self.world.time() < seconds - 0.5 * self.world.dt() {
            self.world.step();
        }
        self.world.body_states()
    }
}

fn named<'a>(states: &'a [BodyState], name: &str) -> &'a BodyState {
    states.iter().find(|body| body.name == name).unwrap_or_else(|| panic!("no body is called {name}"))
}

/// How far a body moved on the axes but y, m.
fn sideways(before: &BodyState, after: &BodyState) -> f64 {
    let apart = before.position.iter().zip(&after.position).enumerate();
    apart.filter(|(axis, _)| *axis != 1).map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn stacks_and_pyramids_stand() {
    for name in ["stack4d", "stack5d", "pyramid2d", "pyramid3d", "pyramid4d"] {
        let mut run = Run::new(name);
        let end = run.until(4.0);
        for (before, after) in run.start.iter().zip(&end).skip(1) {
            assert!(sideways(before, after) < 0.01, "{name}: {} moved {} m", after.name, sideways(before, after));
            assert!((before.position[1] - after.position[1]).abs() < 0.05, "{name}: {} sank", after.name);
            assert!(after.sleeping, "{name}: {} is not at rest", after.name);
        }
    }
}

#[test]
fn friction_decides_what_slides() {
    for name in ["ramp3d", "ramp4d"] {
        let mut run = Run::new(name);
        let end = run.until(5.0);
        for (friction, slides) in [("0.1", true), ("0.3", true), ("0.45", true), ("0.5", false), ("0.8", false)] {
            let cube = format!("friction {friction}");
            let distance = sideways(named(&run.start, &cube), named(&end, &cube));
            let as_told = if slides { distance > 0.3 } else { distance < 0.02 };
            assert!(as_told, "{name}: {cube} moved {distance} m");
        }
    }
}

#[test]
fn balls_bounce_as_their_restitution_says() {
    let mut run = Run::new("bounce2d");
    // They fall 3.6 m and are back at the height e²·3.6 m at the time (1 + e)·√(2·3.6/g).
    for (index, restitution) in [0.0, 0.2, 0.4, 0.6, 0.8, 1.0].into_iter().enumerate() {
        let fall = (7.2_f64 / 9.81).sqrt();
        let body = &run.until(fall * (1.0 + restitution))[index + 1];
        let height = body.position[1] - 0.4;
        let expected = 3.6 * restitution * restitution;
        assert!((height - expected).abs() < 0.1 + 0.06 * expected, "{}: {height} m, expected {expected}", body.name);
    }
}

#[test]
fn the_far_ball_of_the_cradle_takes_over() {
    let mut run = Run::new("cradle2d");
    let rightmost =
        |states: &[BodyState]| named(states, "ball 4").position[0] - named(&run.start, "ball 4").position[0];
    let (mut farthest, mut others): (f64, f64) = (0.0, 0.0);
    let mut world = AnyWorld::new(&built_in("cradle2d").expect("a built-in scene"), 1).expect("a good scene");
    // From the first blow to the time when the far ball hangs highest.
    for step in 0..480 {
        world.step();
        let states = world.body_states();
        farthest = farthest.max(rightmost(&states));
        if (280..420).contains(&step) {
            for (before, after) in run.start.iter().zip(&states).take(5).skip(2) {
                others = others.max(sideways(before, after));
            }
        }
    }
    // The first ball started 2.3 m out.
    assert!(farthest > 2.0 && others < 0.3, "the far ball got {farthest} m out, the middle ones {others} m");
    let back = run.until(4.0);
    assert!(named(&back, "ball 0").position[0] < named(&run.start, "ball 1").position[0] - 2.0, "and back again");
}

#[test]
fn every_domino_falls_one_after_the_other() {
    let mut run = Run::new("dominoes3d");
    let fallen = |states: &[BodyState]| {
        states.iter().filter(|body| body.name.starts_with("domino") && body.position[1] < 0.4).count()
    };
    let halfway = fallen(&run.until(4.0));
    assert!((3..27).contains(&halfway), "{halfway} of 30 after 4 s");
    assert_eq!(fallen(&run.until(12.0)), 30);
}

#[test]
fn the_handle_turns_over_and_the_box_tumbles() {
    let mut run = Run::new("wing_nut3d");
    let stem: Vec<f64> = (1..=300).map(|k| run.until(f64::from(k) * 0.1)[0].rotation[1][1]).collect();
    let turns = stem.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    assert!(turns >= 5, "the stem turned over {turns} times in 30 s");

    // In the planes in which it does not spin at first.
    let astray = |body: &BodyState, spin: [&str; 2]| {
        let rates = body.angular_velocity.0.iter().filter(|(plane, _)| !spin.contains(&plane.as_str()));
        rates.map(|(_, rate)| rate * rate).sum::<f64>().sqrt()
    };
    let mut run = Run::new("tumble4d");
    let (mut tumbling, mut steady): (f64, f64) = (0.0, 0.0);
    for k in 1..=100 {
        let states = run.until(f64::from(k) * 0.1);
        tumbling = tumbling.max(astray(named(&states, "tumbling"), ["xz", "yw"]));
        steady = steady.max(astray(named(&states, "steady"), ["xy", "zw"]));
    }
    assert!(tumbling > 2.0 && steady < 0.5, "tumbling {tumbling}, steady {steady} rad/s");
}

#[test]
fn what_falls_into_a_pit_stays_there_and_comes_to_rest() {
    for name in ["pit4d", "dice4d", "rounded4d", "ells4d"] {
        let mut run = Run::new(name);
        let energy = run.world.energy().total();
        let end = run.until(8.0);
        assert!(run.world.energy().total() < energy, "{name} gained energy");
        let asleep = end.iter().filter(|body| body.sleeping).count();
        let (walls, bodies) = (7, end.len() - 7);
        assert!(asleep * 10 >= bodies * 9, "{name}: {asleep} of {bodies} bodies are at rest");
        for (before, after) in run.start.iter().zip(&end).skip(walls) {
            assert!(after.position[1] > 0.0 && sideways(before, after) < 7.0, "{name}: {} left the pit", after.name);
        }
    }
}

#[test]
fn a_hundred_round_dice_settle_within_15_seconds() {
    let mut run = Run::new("dice_pit4d");
    let end = run.until(15.0);
    let dice = &end[7..];
    assert_eq!(dice.len(), 100);
    let awake: Vec<&str> = dice.iter().filter(|die| !die.sleeping).map(|die| die.name.as_str()).collect();
    assert!(awake.is_empty(), "after 15 s {awake:?} still move");
    for (before, after) in run.start.iter().zip(&end).skip(7) {
        assert!(after.position[1] > 0.4 && sideways(before, after) < 4.0, "{} left the pit", after.name);
    }
    let overlap = run.world.measure_penetration();
    println!("100 dice of 120 and 600 cells at rest; deepest overlap {overlap:.2e} m");
    assert!(overlap < 0.02, "dice overlap by {overlap} m");
}

#[test]
fn an_embedded_scene_stays_in_its_space() {
    let mut run = Run::new("embedded4d");
    for body in run.until(3.0) {
        assert!(body.position[3].abs() < 0.02, "{} is at w = {}", body.name, body.position[3]);
    }
}

#[test]
fn clouds_without_gravity_keep_their_momentum() {
    let mut run = Run::new("clouds5d");
    let before = run.world.momentum();
    let end = run.until(3.0);
    for (axis, (a, b)) in before.iter().zip(run.world.momentum()).enumerate() {
        assert!((a - b).abs() < 1e-5, "axis {axis}: {a} became {b} kg m/s");
    }
    let scattered = end.iter().filter(|body| body.velocity[1].abs() > 0.3).count();
    assert!(scattered > 8, "only {scattered} cubes were thrown off their way");
}

/// Largest and least of what a body shows of itself during a scene.
fn range(run: &mut Run, name: &str, seconds: f64, of: impl Fn(&BodyState) -> f64) -> (f64, f64) {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    while run.world.time() < seconds {
        run.world.step();
        let states = run.world.body_states();
        let value = of(named(&states, name));
        (least, greatest) = (least.min(value), greatest.max(value));
    }
    (least, greatest)
}

#[test]
fn the_seesaw_throws() {
    let mut run = Run::new("seesaw3d");
    let (_, highest) = range(&mut run, "light", 3.0, |body| body.position[1]);
    assert!(highest > 2.0, "the light cube rose to {highest} m only");
}

#[test]
fn the_gyroscope_goes_round_and_does_not_fall() {
    let mut run = Run::new("gyroscope3d");
    let mut angle = 0.0;
    let mut last: f64 = 0.0;
    while run.world.time() < 6.0 {
        run.world.step();
        let states = run.world.body_states();
        let disc = named(&states, "disc");
        assert!((disc.position[1] - 2.0).abs() < 0.12, "the disc is at {} m", disc.position[1]);
        let now = disc.position[2].atan2(disc.position[0]);
        let turn = now - last;
        angle += turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        last = now;
    }
    // Steady precession of a fast top: Ω = m g r / L with L = ½ m R² ω, to first order in Ω/ω.
    let expected = 9.81 * 0.6 / (0.5 * 0.25 * 60.0) * 6.0;
    assert!((angle.abs() / expected - 1.0).abs() < 0.05, "it went round by {angle} rad, not {expected}");
}

#[test]
fn the_car_drives_over_its_bumps() {
    let end = Run::new("car3d").until(9.0);
    let chassis = named(&end, "chassis");
    assert!(chassis.position[0] > 11.5, "the car came to x = {} m", chassis.position[0]);
    // Bumps turn it by some degrees, to either side.
    let strayed = chassis.position[2].abs() / chassis.position[0];
    assert!((chassis.position[1] - 0.65).abs() < 0.15 && strayed < 0.1, "it ended at {:?}", chassis.position);
}

#[test]
fn the_door_opens_to_its_limit_and_turns_in_its_plane_alone() {
    let mut run = Run::new("door4d");
    let (least, _) = range(&mut run, "door", 2.5, |body| body.rotation[0][0]);
    let limit = 100.0_f64.to_radians().cos();
    assert!(least < 0.3 && least > limit - 0.02, "the cosine of its angle came down to {least}");
    let states = run.world.body_states();
    let door = named(&states, "door");
    assert!((door.rotation[1][1] - 1.0).abs() < 1e-3 && (door.rotation[3][3] - 1.0).abs() < 1e-3);
}

#[test]
fn the_wrecking_ball_goes_through_the_wall() {
    let mut run = Run::new("wrecking_ball4d");
    let end = run.until(4.0);
    let moved = run
        .start
        .iter()
        .zip(&end)
        .filter(|(before, after)| before.name.starts_with("brick") && sideways(before, after) > 1.0);
    assert!(moved.count() >= 8, "the wall stands");
}

/// The carrier goes once around while the sun goes (48 + 12)/12 = 5 times; what the whisks reach moves, what lies beside them does not.
#[test]
fn the_mixer_stirs_what_its_blades_reach() {
    let mut run = Run::new("mixer4d");
    let end = run.until(10.0);
    let carrier = named(&end, "carrier");
    let turning = carrier.angular_velocity.0.iter().map(|(_, rate)| rate * rate).sum::<f64>().sqrt();
    assert!((turning - 4.0 / 5.0).abs() < 0.01, "the carrier turns at {turning} rad/s");
    let moved = |within: bool| {
        let small = |body: &BodyState| body.name.starts_with("ball") || body.name.starts_with("tesseract");
        let pairs = run.start.iter().zip(&end).filter(|(before, _)| small(before));
        let beside = pairs.filter(|(before, _)| (before.position[3].abs() < 0.1) == within);
        let (count, far) = beside
            .fold((0, 0), |(count, far), (before, after)| (count + 1, far + i32::from(sideways(before, after) > 0.5)));
        f64::from(far) / f64::from(count)
    };
    let (reached, beside) = (moved(true), moved(false));
    assert!(reached > 0.5 && beside < 0.1, "{reached} of those that are reached moved, {beside} of those beside");
}

#[test]
fn the_conveyors_carry_along_x_and_then_along_w() {
    let end = Run::new("conveyor4d").until(9.0);
    for index in 0..6 {
        let parcel = named(&end, &format!("parcel {index}"));
        assert!(parcel.position[3] > 1.0 && parcel.position[0] > 3.5, "{} ended at {:?}", parcel.name, parcel.position);
    }
}
