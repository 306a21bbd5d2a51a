//! The torque-free body in `N` dimensions: how it tumbles, exactly and step by step.
//!
//! | module | holds |
//! |---|---|
//! | [`top`] | [`FreeTop`]: the body as its principal second moments, Euler's equation |
//! | [`state`] | [`TopState`]: attitude and momentum; how signs and orientations are meant |
//! | [`spin`] | spins in words |
//! | [`components`] | Euler's equation plane by plane: which planes drive which |
//! | [`method`] | [`Method`]: the integrators by name |
//! | [`plane_splitting`], [`splitting`] | exact turns in coordinate planes: the step of the world, and orders 2, 4, 6 |
//! | [`midpoint`] | the implicit midpoint rule on rotations |
//! | [`engine_steps`] | what engines usually do, for comparison |
//! | [`exact`], [`three_axes`], [`elliptic`] | closed forms |
//! | [`invariants`] | what is conserved, and the drift of a run |
//! | [`run`](mod@run) | recorded runs with error control on request |
//! | [`flips`] | when a spin turns over |
//! | [`principal_rotation`], [`stability`](mod@stability) | steady rotations and whether disturbances of them grow |
//! | [`growth`], `growth_fit` | growth rates, measured |
//! | [`sweep`] | maps of stability |
//!
//! ```
//! use hyperbody_dynamics::free_top::{FreeTop, Method, RunPlan, TopState, parse_spin, run, stability};
//! use hyperbody_math::{Rotation, Vector};
//!
//! let top = FreeTop::new(Vector([4.0, 3.0, 2.0, 1.0]))?;
//! let spin = parse_spin("xz=1, xy=0.001")?;
//! let judged = stability(&top, &spin)?;
//! assert_eq!(judged.verdict.stable(), Some(false));
//! assert!((judged.growth_rate - 0.169031).abs() < 1e-6);
//!
//! let start = TopState::from_spin(&top, Rotation::IDENTITY, &spin)?;
//! let plan = RunPlan::new(Method::Splitting4, 60.0, 1.0 / 240.0)?;
//! let record = run(&top, &start, &plan, &mut |_, _| {})?;
//! assert!(record.drift.energy < 1e-12);
//! # Ok::<(), hyperbody_dynamics::free_top::FreeTopError>(())
//! ```

pub mod components;
pub mod elliptic;
pub mod engine_steps;
pub mod error;
pub mod exact;
pub mod flips;
pub mod growth;
mod growth_fit;
pub mod invariants;
pub mod method;
pub mod midpoint;
pub mod plane_splitting;
pub mod principal_rotation;
pub mod run;
pub mod spin;
pub mod splitting;
pub mod stability;
mod stability_text;
pub mod state;
pub mod sweep;
pub mod three_axes;
pub mod top;

pub use components::plane_equations;
pub use error::{FreeTopError, FreeTopErrorKind, Result};
pub use exact::ExactMotion;
pub use flips::{FlipDetector, Flips};
pub use growth::{linearised_growth_rate, perturbed_run};
pub use invariants::{Drift, DriftMeter, Invariants};
pub use method::Method;
pub use plane_splitting::free_rotation_step;
pub use principal_rotation::PrincipalRotation;
pub use run::{RunPlan, TopRun, run};
pub use spin::{parse_spin, spin_to_text};
pub use stability::{Stability, Verdict, stability};
pub use state::TopState;
pub use sweep::{MapRange, StabilityMap, map_moments, map_spins};
pub use top::FreeTop;
