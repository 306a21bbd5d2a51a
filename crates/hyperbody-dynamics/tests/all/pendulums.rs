//! Pendulums of every sort in every coordinate plane of every dimension against the exact period,
//! T = 4 K(sin(θ₀/2)) √(I/(m g d)), at the default step of 1/60 s, with I the moment about the pivot in the plane of the swing (J. L. Lagrange, A.-M. Legendre).
//!
//! `cargo test --release -p hyperbody-dynamics --test all pendulums -- --nocapture` prints the worst error of each dimension.

use crate::common::*;
use hyperbody_dynamics::{BodyDef, BodyHandle, Freedom, JointDef, World, WorldDef};
use hyperbody_math::{Pose, Rotation, Vector, planes};

in_all_dimensions! {
    pendulums_swing_with_the_exact_period: every_plane;
}

/// From the pivot to the centre of mass, m.
const LENGTH: f64 = 0.8;

const AMPLITUDES: [f64; 2] = [1.0, 2.0];

/// Largest relative error of a period.
const TOLERANCE: f64 = 0.005;

/// Swings in the plane of two axes, gravity pulling against the first.
struct Swing<const N: usize> {
    vertical: usize,
    across: usize,
    amplitude: f64,
}

impl<const N: usize> Swing<N> {
    fn hanging(&self) -> Vector<N> {
        Vector::unit(self.vertical) * -LENGTH
    }

    /// The period with this moment about the pivot for each kg, m².
    fn exact(&self, moment: f64) -> f64 {
        4.0 * elliptic_k((self.amplitude / 2.0).sin()) * (moment / (GRAVITY * LENGTH)).sqrt()
    }

    /// A bob held by what `tie` makes, turned aside by the amplitude, and its period over three swings.
    fn period(&self, bob: BodyDef<N>, tie: impl Fn(BodyHandle) -> JointDef<N>) -> f64 {
        let gravity = Vector::unit(self.vertical) * -GRAVITY;
        let def = WorldDef { gravity, sleeping: false, ..WorldDef::default() };
        let mut world = World::<N>::new(def).unwrap();
        let aside = Rotation::in_plane(self.vertical, self.across, -self.amplitude);
        let bob = world.add_body(bob.rotation(aside).position(aside.rotate(self.hanging()))).unwrap();
        world.add_joint(tie(bob)).unwrap();
        measured_period(&mut world, bob, self.across, 3)
    }
}

/// Mean time between every second zero of a coordinate, interpolated within steps.
fn measured_period<const N: usize>(world: &mut World<N>, body: BodyHandle, axis: usize, periods: usize) -> f64 {
    let mut zeros = Vec::new();
    let mut last = world.body(body).unwrap().position()[axis];
    for _ in 0..100_000 {
        world.step();
        let now = world.body(body).unwrap().position()[axis];
        if last * now < 0.0 {
            zeros.push(world.time() - world.dt() * now / (now - last));
        }
        last = now;
        if zeros.len() > 2 * periods {
            return (zeros[2 * periods] - zeros[0]) / periods as f64;
        }
    }
    panic!("the pendulum does not swing");
}

/// Keeps `kept` of the axes that do not swing point by point; the rest may turn. With all of them it is the hinge.
fn axle<const N: usize>(swing: &Swing<N>, bob: BodyHandle, kept: usize) -> JointDef<N> {
    let still = (0..N).filter(|&axis| axis != swing.vertical && axis != swing.across).take(kept);
    let still: Vec<usize> = still.collect();
    let def = JointDef::weld(None, bob, Pose::IDENTITY, Pose::from_translation(-swing.hanging()));
    let free = planes::all(N).filter(|(i, j)| !still.contains(i) && !still.contains(j));
    free.fold(def, |def, (i, j)| def.plane(i, j, Freedom::FREE))
}

/// Point masses on rods, and boxes without two equal sides on ball joints, on axles of every sort up to the hinge.
fn every_plane<const N: usize>() {
    let half = Vector::<N>::from_fn(|i| 0.1 + 0.05 * i as f64);
    let mean = |i: usize| half[i] * half[i] / 3.0;
    let (mut worst, mut count) = ((0.0_f64, String::new()), 0);
    for (vertical, across) in (0..N * N).map(|k| (k / N, k % N)).filter(|(i, j)| i != j) {
        for amplitude in AMPLITUDES {
            let swing = Swing::<N> { vertical, across, amplitude };
            let mut check = |name: String, period: f64, moment: f64| {
                let error = (period / swing.exact(moment) - 1.0).abs();
                let what = format!("{name} in plane ({vertical}, {across}) from {amplitude} rad");
                assert!(error < TOLERANCE, "{N}D, {what}: the period is off by {:.3} %", 100.0 * error);
                if error > worst.0 {
                    worst = (error, what);
                }
                count += 1;
            };
            let point = || BodyDef::new(ball(0.05));
            let rod = |bob| JointDef::distance(None, bob, Vector::ZERO, Vector::ZERO, LENGTH);
            check("point mass on a rod".into(), swing.period(point(), rod), LENGTH * LENGTH);
            let moment = mean(vertical) + mean(across) + LENGTH * LENGTH;
            let bob = || BodyDef::new(cuboid(half));
            let tie = |bob| JointDef::ball(None, bob, Vector::ZERO, -swing.hanging());
            check("box on a ball joint".into(), swing.period(bob(), tie), moment);
            for kept in 1..=N - 2 {
                let name = if kept == N - 2 { "box on a hinge".into() } else { format!("box on an axle of {kept}") };
                check(name, swing.period(bob(), |bob| axle(&swing, bob, kept)), moment);
            }
        }
    }
    println!("{N}D: {count} pendulums, the worst period off by {:.4} %: {}", 100.0 * worst.0, worst.1);
}
