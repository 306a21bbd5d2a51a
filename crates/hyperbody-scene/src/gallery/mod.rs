//! The built-in scenes: small worlds worth looking at, which also serve the tests and the benchmarks. Every one says in
//! a sentence what to see.

mod bounces;
mod compounds;
mod friction;
mod games;
mod joints;
mod machines;
mod mixer;
mod piles;
mod random;
mod spins;
mod stacks;
mod stage;

use crate::error::nearest;
use crate::model::Scene;
pub(crate) use random::Random;

/// A scene that the crate brings along.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// What it is called.
    pub name: &'static str,
    build: fn() -> Scene,
}

impl BuiltIn {
    /// The scene; the same bits every time and everywhere.
    #[must_use]
    pub fn scene(&self) -> Scene {
        let mut scene = (self.build)();
        self.name.clone_into(&mut scene.name);
        scene
    }
}

/// All built-in scenes, by dimension.
pub const BUILT_IN: [BuiltIn; 33] = [
    BuiltIn { name: "pyramid2d", build: stacks::pyramid_2d },
    BuiltIn { name: "bounce2d", build: bounces::restitution_2d },
    BuiltIn { name: "cradle2d", build: joints::cradle_2d },
    BuiltIn { name: "pyramid3d", build: stacks::pyramid_3d },
    BuiltIn { name: "ramp3d", build: friction::ramp_3d },
    BuiltIn { name: "wing_nut3d", build: spins::wing_nut_3d },
    BuiltIn { name: "dominoes3d", build: games::dominoes_3d },
    BuiltIn { name: "chain3d", build: joints::chain_3d },
    BuiltIn { name: "seesaw3d", build: machines::seesaw_3d },
    BuiltIn { name: "gyroscope3d", build: machines::gyroscope_3d },
    BuiltIn { name: "car3d", build: machines::car_3d },
    BuiltIn { name: "stack4d", build: stacks::stack_4d },
    BuiltIn { name: "pyramid4d", build: stacks::pyramid_4d },
    BuiltIn { name: "pit4d", build: piles::tesseracts_4d },
    BuiltIn { name: "dice4d", build: piles::dice_4d },
    BuiltIn { name: "dice_pit4d", build: piles::round_dice_4d },
    BuiltIn { name: "balls4d", build: piles::balls_4d },
    BuiltIn { name: "capsules4d", build: piles::capsules_4d },
    BuiltIn { name: "rounded4d", build: piles::rounded_4d },
    BuiltIn { name: "ells4d", build: compounds::ells_4d },
    BuiltIn { name: "ramp4d", build: friction::ramp_4d },
    BuiltIn { name: "tumble4d", build: spins::tumble_4d },
    BuiltIn { name: "bowling4d", build: games::bowling_4d },
    BuiltIn { name: "pendulum4d", build: joints::pendulum_4d },
    BuiltIn { name: "door4d", build: machines::door_4d },
    BuiltIn { name: "wrecking_ball4d", build: machines::wrecking_ball_4d },
    BuiltIn { name: "conveyor4d", build: machines::conveyor_4d },
    BuiltIn { name: "mixer4d", build: mixer::mixer_4d },
    BuiltIn { name: "embedded4d", build: stacks::embedded_4d },
    BuiltIn { name: "stack5d", build: stacks::stack_5d },
    BuiltIn { name: "clouds5d", build: bounces::clouds_5d },
    BuiltIn { name: "balls5d", build: piles::balls_5d },
    BuiltIn { name: "balls6d", build: piles::balls_6d },
];

/// The built-in scene of this name.
///
/// # Errors
/// If there is none; the error is the nearest name that there is.
pub fn built_in(name: &str) -> Result<Scene, &'static str> {
    BUILT_IN
        .iter()
        .find(|scene| scene.name == name)
        .map(BuiltIn::scene)
        .ok_or_else(|| nearest(name, BUILT_IN.iter().map(|scene| scene.name)).unwrap_or_default())
}
