//! Contacts and joints become impulses: soft constraints in substeps.
//!
//! A step is divided into substeps of length h; each integrates velocities, applies the impulses of the last substep
//! again (warm start), solves all rows once with overlap pushed apart softly, integrates positions, and solves once more
//! without the push, so that the push leaves no speed behind (E. Catto, "Solver2D", 2024; the form that Box2D and Rapier
//! use too). Contact rows are made once a step, and gaps follow linearly within it.
//!
//! | file | holds |
//! |---|---|
//! | `coming` | what is asked of memory ahead of time |
//! | `bodies` | the scaled velocities that rows work on |
//! | `collect` | what of the world is solved, and its return |
//! | `colours` | which contacts are solved side by side |
//! | `contacts` | contact rows and the passes over them |
//! | `division` | which parts of a large world are solved at the same time |
//! | `manifolds` | rows made of contacts, and impulses stored in them |
//! | `pressed` | what contacts have done to each body, for warm starts |
//! | `joints` | joint rows |
//! | `turning` | gaps of bodies that turn far within the step |
//! | `gyro` | free rotation of anisotropic bodies within the step |
//! | `softness` | soft coefficients |
//! | `lanes`, `wide`, `machine` | several contacts side by side: in memory, in registers; the processor's instructions |
//! | `part`, `vectors` | as many contacts as a register holds in double precision; vectors of them |

pub(crate) mod bodies;
mod collect;
mod colours;
mod coming;
mod contacts;
mod division;
pub(crate) mod gyro;
mod joints;
mod lanes;
mod machine;
mod manifolds;
mod part;
mod pressed;
mod softness;
mod turning;
mod vectors;
mod wide;

use std::sync::Mutex;

use hyperbody_math::Vector;

use crate::body::Body;
use crate::handle::Arena;
use crate::joint::Joint;
use crate::pairs::Pairs;
use crate::threads::{Pool, halves};
use crate::{BodyHandle, JointHandle, Tuning};
use bodies::{Sizes, SolverBody};
use collect::{Collected, Seat, Taken};
use colours::{ActiveContact, Colours};
use contacts::{Bounce, ContactRows, PassTimes, Sweep, WarmStart};
use division::{Division, Stretch};
use gyro::Gyro;
use joints::{Joints, Moment, Moving, Pass, Tension};
use lanes::Lanes;
pub(crate) use lanes::Real;
use machine::Processor;
use pressed::Pressed;
use turning::Turning;

/// Buffers of the solver, kept from step to step so that a settled step allocates nothing.
pub(crate) struct Solver<const N: usize> {
    /// Row 0 is not used by any body.
    pub(crate) bodies: Vec<SolverBody<N>>,
    /// [`Sizes::STATE`] numbers a body: scaled change of velocity, scaled displacement by it.
    pub(crate) state: Vec<Real>,
    pub(crate) gyros: Vec<Gyro<N>>,
    damped: Vec<Damped>,
    /// Room for collecting the bodies of each part.
    collected: Vec<Collected<N>>,
    /// Rows of each part.
    counts: Vec<usize>,
    /// By slot of the body.
    seats: Vec<Option<Seat>>,
    taken: Vec<Taken<N>>,
    active: Vec<ActiveContact>,
    division: Division,
    /// Of each part and cut.
    colours: Vec<Colours>,
    /// Room for states that threads put aside.
    aside: Mutex<Vec<Lanes>>,
    contacts: ContactRows<N>,
    joints: Joints<N>,
    tension: Tension,
    turning: Turning<N>,
    pressed: Pressed,
    processor: Processor,
}

/// A body whose velocity dies away.
#[derive(Clone, Copy, Debug)]
struct Damped {
    body: usize,
    /// Factors on velocity and angular velocity a substep.
    linear: f64,
    angular: f64,
}

/// What the solver takes from the world.
pub(crate) struct SolverInput<'a, const N: usize> {
    pub(crate) bodies: &'a mut Arena<Body<N>, BodyHandle>,
    pub(crate) pairs: &'a mut Pairs<N>,
    pub(crate) joints: &'a mut Arena<Joint<N>, JointHandle>,
    pub(crate) gravity: Vector<N>,
    pub(crate) tuning: &'a Tuning,
    pub(crate) dt: f64,
    pub(crate) substeps: u32,
    pub(crate) pool: Option<&'a Pool>,
}

impl<const N: usize> Solver<N> {
    pub(crate) fn new() -> Self {
        Self {
            bodies: Vec::new(),
            state: Vec::new(),
            gyros: Vec::new(),
            damped: Vec::new(),
            collected: Vec::new(),
            counts: Vec::new(),
            seats: Vec::new(),
            taken: Vec::new(),
            active: Vec::new(),
            division: Division::default(),
            colours: Vec::new(),
            aside: Mutex::default(),
            contacts: ContactRows::default(),
            joints: Joints::default(),
            tension: Tension::default(),
            turning: Turning::default(),
            pressed: Pressed::default(),
            processor: Processor::of_this_machine(),
        }
    }

    /// Solves one step; the results stand in `state` and `gyros` for the integration.
    pub(crate) fn solve(&mut self, input: &mut SolverInput<'_, N>) {
        let h = input.dt / f64::from(input.substeps);
        self.collect_bodies(input, h);
        self.collect_contacts(input.pairs, input.pool);
        self.make_rows(input.tuning, h, input.pool);
        self.joints.collect(input, &self.bodies, &self.gyros, h);
        self.joints.jointed_gyros().for_each(|gyro| self.gyros[gyro].keep_up());
        self.run_substeps(input, h);
        self.store_impulses(input.pool);
        self.give_back_contacts(input.pairs);
        self.joints.store(input.joints, h);
    }

    fn run_substeps(&mut self, input: &SolverInput<'_, N>, h: f64) {
        let tuning = input.tuning;
        let processor = self.processor;
        self.turning.clear(&self.bodies, input.dt);
        self.pressed.clear::<N>(self.bodies.len());
        self.refresh_joints(&Moment::new(0, 0, h));
        for substep in 0..input.substeps {
            let mut times = pass_times(substep, h, tuning);
            self.damp(h * f64::from(substep + 1));
            self.joints.kick(h);
            self.warm_start_joints(Pass::Move, h);
            if substep == 0 {
                let (contacts, division) = (&mut self.contacts, &self.division);
                let start = |_, contacts: Stretch<'_, N>| processor.run(WarmStart::<N> { contacts });
                let pass = |state: &mut [Real]| division.each::<N>(contacts.whole(state), input.pool, &start);
                self.pressed.watch::<N>(processor, &mut self.state, input.pool, pass);
            } else {
                self.pressed.warm_start::<N>(processor, &mut self.state, input.pool);
            }
            self.solve_joints(Pass::Move, substep, h);
            self.solve_contacts(&times, input.pool);
            self.move_bodies(h, h * f64::from(substep + 1), input.pool);
            times = PassTimes { push: false, ..after_move(times, substep, h) };
            let rows = (&mut self.contacts, self.active.as_slice());
            self.turning.refresh(&self.bodies, &self.state, &times, rows);
            self.refresh_joints(&Moment::new(substep + 1, substep + 1, h));
            self.warm_start_joints(Pass::Settle, h);
            self.solve_joints(Pass::Settle, substep, h);
            self.solve_contacts(&times, input.pool);
            if substep + 1 == input.substeps {
                let bounce = |_, contacts: Stretch<'_, N>| processor.run(Bounce::<N> { contacts, times: &times });
                self.division.each::<N>(self.contacts.whole(&mut self.state), input.pool, &bounce);
            }
        }
    }

    fn solve_contacts(&mut self, times: &PassTimes, pool: Option<&Pool>) {
        let (division, colours) = (&self.division, self.colours.as_slice());
        let sweep = Sweep { processor: self.processor, times, division, colours, aside: &self.aside };
        let contacts = &mut self.contacts;
        let pass = |state: &mut [Real]| sweep.run::<N>(contacts.whole(state), pool);
        self.pressed.watch::<N>(self.processor, &mut self.state, pool, pass);
    }

    fn refresh_joints(&mut self, moment: &Moment) {
        let moving =
            Moving { bodies: &self.bodies, gyros: &self.gyros, state: &mut self.state, processor: self.processor };
        self.joints.refresh(&moving, moment);
    }

    fn warm_start_joints(&mut self, pass: Pass, h: f64) {
        let mut moving =
            Moving { bodies: &self.bodies, gyros: &self.gyros, state: &mut self.state, processor: self.processor };
        self.joints.warm_start(&mut moving, pass, h);
    }

    fn solve_joints(&mut self, pass: Pass, substep: u32, h: f64) {
        let mut moving =
            Moving { bodies: &self.bodies, gyros: &self.gyros, state: &mut self.state, processor: self.processor };
        let moment = Moment::new(substep, substep + 1, h);
        if matches!(pass, Pass::Move) {
            self.joints.look_ahead(&moving, &moment);
        }
        self.joints.solve(&mut moving, pass, &moment);
        if matches!(pass, Pass::Settle) {
            self.joints.add_up();
        }
    }

    /// Lets the velocities of damped bodies die away: v' = v/(1 + h·rate), base part included.
    fn damp(&mut self, elapsed: f64) {
        for damped in &self.damped {
            let body = &self.bodies[damped.body];
            let row = damped.body * Sizes::<N>::STATE;
            let state = &mut self.state[row..row + Sizes::<N>::VELOCITY];
            for i in 0..N {
                let base = (body.velocity[i] + body.acceleration[i] * elapsed) / body.inverse_sqrt_mass;
                let whole = base + f64::from(state[i]);
                state[i] += (whole * (damped.linear - 1.0)) as Real;
            }
            let base = body.scaled_velocity(&(body.angular_velocity + body.angular_acceleration * elapsed));
            for k in 0..Sizes::<N>::K {
                state[N + k] += (base[k] + state[N + k]) * (damped.angular - 1.0) as Real;
            }
        }
    }

    /// Displaces all bodies by their changes of velocity, and turns anisotropic ones.
    fn move_bodies(&mut self, h: f64, elapsed: f64, pool: Option<&Pool>) {
        let step = h as Real;
        halves(&mut self.state, Sizes::<N>::STATE, pool, &|state| {
            for row in state.chunks_exact_mut(Sizes::<N>::STATE) {
                let (velocity, displacement) = row.split_at_mut(Sizes::<N>::VELOCITY);
                for (d, v) in displacement.iter_mut().zip(velocity) {
                    *d += step * *v;
                }
            }
        });
        for gyro in &mut self.gyros {
            gyro.turn(&self.bodies[gyro.body], &mut self.state, h, elapsed);
        }
    }

    /// Slots of bodies that joints were moving at the end of the step, however slowly.
    pub(crate) fn creeping(&self) -> &[u32] {
        self.joints.creeping()
    }
}

/// Times of the pass before positions move in a substep.
fn pass_times(substep: u32, h: f64, tuning: &Tuning) -> PassTimes {
    let k = f64::from(substep);
    PassTimes {
        elapsed: (h * (k + 1.0)) as Real,
        moved: (h * k) as Real,
        moved_sq: (h * h * k * (k + 1.0) * 0.5) as Real,
        inverse_h: (1.0 / h) as Real,
        push: true,
        slop: tuning.slop as Real,
        push_out_speed: tuning.push_out_speed as Real,
        restitution_threshold: tuning.restitution_threshold as Real,
    }
}

/// Times of the pass after positions moved.
fn after_move(times: PassTimes, substep: u32, h: f64) -> PassTimes {
    let k = f64::from(substep + 1);
    PassTimes { moved: (h * k) as Real, moved_sq: (h * h * k * (k + 1.0) * 0.5) as Real, ..times }
}
