//! Contacts and joints become impulses: soft constraints in substeps.
//!
//! A step is divided into substeps of length h; each integrates velocities, applies the impulses of the last substep
//! again (warm start), solves all rows once with overlap pushed apart softly, integrates positions, and solves once more
//! without the push, so that the push leaves no speed behind (E. Catto, "Solver2D", 2024; the form that Box2D and Rapier
//! use too). Contact rows are made once a step, and gaps follow linearly within it.
//!
//! | file | holds |
//! |---|---|
//! | `bodies` | the scaled velocities that rows work on |
//! | `colours` | which contacts are solved side by side |
//! | `contacts` | contact rows and the passes over them |
//! | `pressed` | what contacts have done to each body, for warm starts |
//! | `joints` | joint rows |
//! | `turning` | gaps of bodies that turn far within the step |
//! | `gyro` | free rotation of anisotropic bodies within the step |
//! | `softness` | soft coefficients |
//! | `lanes`, `wide`, `machine` | several contacts side by side: in memory, in registers; the processor's instructions |
//! | `part`, `vectors` | as many contacts as a register holds in double precision; vectors of them |

pub(crate) mod bodies;
mod colours;
mod coming;
mod contacts;
pub(crate) mod gyro;
mod joints;
mod lanes;
mod machine;
mod part;
mod pressed;
mod softness;
mod turning;
mod vectors;
mod wide;

use hyperbody_math::Vector;

use crate::BodyKind;
use crate::body::Body;
use crate::handle::Arena;
use crate::joint::Joint;
use crate::pairs::{Contact, Meeting, Pairs};
use crate::threads::Pool;
use crate::vetting::shortened;
use crate::{BodyHandle, JointHandle, Tuning};
use bodies::{Sizes, SolverBody};
use colours::{ActiveContact, Colours, Group};
use coming::{Coming, Errand};
use contacts::{Block, Bounce, ContactRows, Gathered, Layout, PassTimes, Prepare, Springs, Sweep, WarmStart};
use gyro::Gyro;
use joints::{Joints, Moment, Moving, Pass, Tension};
use lanes::Lanes;
pub(crate) use lanes::Real;
use machine::Processor;
use pressed::Pressed;
use softness::Softness;
use turning::Turning;

/// Buffers of the solver, kept from step to step so that a settled step allocates nothing.
pub(crate) struct Solver<const N: usize> {
    /// Row 0 is not used by any body.
    pub(crate) bodies: Vec<SolverBody<N>>,
    /// [`Sizes::STATE`] numbers a body: scaled change of velocity, scaled displacement by it.
    pub(crate) state: Vec<Real>,
    pub(crate) gyros: Vec<Gyro<N>>,
    damped: Vec<Damped>,
    active: Vec<ActiveContact>,
    colours: Colours,
    contacts: ContactRows,
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
            active: Vec::new(),
            colours: Colours::default(),
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
        self.collect_contacts(input);
        self.make_rows(input, h);
        self.joints.collect(input, &self.bodies, &self.gyros, h);
        self.joints.jointed_gyros().for_each(|gyro| self.gyros[gyro].keep_up());
        self.run_substeps(input, h);
        self.store_impulses(input);
    }

    fn collect_bodies(&mut self, input: &mut SolverInput<'_, N>, h: f64) {
        self.bodies.clear();
        // Row 0 belongs to no one: whoever is not moved by impulses points at it.
        self.bodies.push(SolverBody::RESTING);
        self.gyros.clear();
        self.damped.clear();
        self.tension.find(input.joints, input.bodies.slot_count(), h);
        for slot in 0..input.bodies.slot_count() {
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = slot as u32;
            let Some(body) = input.bodies.at_mut(slot) else { continue };
            body.solver_index = 0;
            if !body.is_moving() {
                let runs = body.surface_velocity != Vector::ZERO && body.kind == BodyKind::Static;
                if (body.kind == BodyKind::Kinematic || runs) && !body.quarantined {
                    self.push_body(body, SolverBody::immovable);
                }
                continue;
            }
            let added_moment = self.tension.added(slot, body.inertia.smallest_plane_moment());
            self.push_body(body, |body| SolverBody::dynamic(slot, body, input.gravity, added_moment));
            let row = self.bodies.len() - 1;
            let steepest = input.tuning.max_speed / input.dt;
            self.bodies[row].acceleration = shortened(self.bodies[row].acceleration, steepest);
            if let Some(frame) = self.bodies[row].frame {
                let inertia = &body.inertia;
                self.gyros.push(Gyro::new(row, frame, inertia.moments, body, added_moment, input.dt));
            }
            if body.linear_damping > 0.0 || body.angular_damping > 0.0 {
                let factor = |rate: f64| 1.0 / (1.0 + h * rate);
                let (linear, angular) = (factor(body.linear_damping), factor(body.angular_damping));
                self.damped.push(Damped { body: row, linear, angular });
            }
        }
        self.state.clear();
        self.state.resize(self.bodies.len() * Sizes::<N>::STATE, 0.0);
    }

    fn push_body(&mut self, body: &mut Body<N>, make: impl Fn(&Body<N>) -> SolverBody<N>) {
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
        let row = self.bodies.len() as u32;
        body.solver_index = row;
        self.bodies.push(make(body));
    }

    /// Pairs with points and at least one body that impulses move, in the order of their slots.
    fn collect_contacts(&mut self, input: &SolverInput<'_, N>) {
        self.active.clear();
        for (slot, pair) in input.pairs.contacts() {
            let (Some(a), Some(b)) = (input.bodies.at(pair.body_a), input.bodies.at(pair.body_b)) else { continue };
            let moves = [a.is_moving(), b.is_moving()];
            if moves != [false; 2] {
                self.active.push(ActiveContact {
                    pair: slot,
                    body_a: a.solver_index,
                    body_b: b.solver_index,
                    moves,
                    surface: pair.surface(),
                    points: pair.points,
                    round: pair.points == 1 && !pair.resists && (a.is_ball || !moves[0]) && (b.is_ball || !moves[1]),
                });
            }
        }
        self.colours.assign(&self.active, self.bodies.len());
    }

    fn make_rows(&mut self, input: &SolverInput<'_, N>, h: f64) {
        let tuning = input.tuning;
        self.contacts.allocate::<N>(&self.colours.groups, &self.active);
        let springs = Springs {
            soft: Softness::new(tuning.contact_hz, tuning.contact_damping_ratio, h),
            stiff: Softness::new(2.0 * tuning.contact_hz, tuning.contact_damping_ratio, h),
        };
        let (bodies, active, pairs) = (&self.bodies, &self.active, &*input.pairs);
        let processor = self.processor;
        let nothing = Contact::NONE;
        let fill = |block: &Block, rows: &mut [Lanes], gathered: &mut Gathered<N>| {
            gathered.start();
            for (lane, &index) in block.contacts.iter().enumerate() {
                // No index is that of an empty lane.
                let found = active.get(index as usize).and_then(|active| {
                    let contact = pairs.get(active.pair)?.contact.as_deref()?;
                    Some((contact, (&bodies[active.body_a as usize], &bodies[active.body_b as usize])))
                });
                let (contact, sides) = found.unwrap_or((&nothing, (&bodies[0], &bodies[0])));
                gathered.fill(block, lane, contact, sides);
            }
            processor.run(Prepare { block, rows, gathered, springs: &springs });
        };
        let coming = |blocks: &[Block], index: usize| {
            let coming = Coming { blocks, active, bodies, errand: Errand::Fill };
            coming.fetch(index, pairs);
        };
        let (blocks, rows) = (self.contacts.blocks.as_slice(), self.contacts.rows.as_mut_slice());
        match input.pool {
            Some(pool) => pool.install(|| fill_blocks(blocks, rows, &fill, &coming)),
            None => fill_in_turn(blocks, rows, &fill, &coming),
        }
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
                let contacts = &mut self.contacts;
                let pass = |state: &mut [Real]| processor.run(WarmStart::<N> { contacts, state });
                self.pressed.watch::<N>(processor, &mut self.state, pass);
            } else {
                self.pressed.warm_start::<N>(processor, &mut self.state);
            }
            self.solve_joints(Pass::Move, substep, h);
            self.solve_contacts(&times, input.pool);
            self.move_bodies(h, h * f64::from(substep + 1));
            times = PassTimes { push: false, ..after_move(times, substep, h) };
            let rows = (&mut self.contacts, self.active.as_slice());
            self.turning.refresh(&self.bodies, &self.state, &times, rows, input.pairs);
            self.refresh_joints(&Moment::new(substep + 1, substep + 1, h));
            self.warm_start_joints(Pass::Settle, h);
            self.solve_joints(Pass::Settle, substep, h);
            self.solve_contacts(&times, input.pool);
            if substep + 1 == input.substeps {
                processor.run(Bounce::<N> { contacts: &mut self.contacts, state: &mut self.state, times: &times });
            }
        }
    }

    fn solve_contacts(&mut self, times: &PassTimes, pool: Option<&Pool>) {
        let sweep = Sweep { processor: self.processor, times };
        let (contacts, ends) = (&mut self.contacts, self.colours.ends.as_slice());
        self.pressed.watch::<N>(self.processor, &mut self.state, |state| sweep.run::<N>(contacts, ends, state, pool));
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
    fn move_bodies(&mut self, h: f64, elapsed: f64) {
        let step = h as Real;
        for row in self.state.chunks_exact_mut(Sizes::<N>::STATE) {
            let (velocity, displacement) = row.split_at_mut(Sizes::<N>::VELOCITY);
            for (d, v) in displacement.iter_mut().zip(velocity) {
                *d += step * *v;
            }
        }
        for gyro in &mut self.gyros {
            gyro.turn(&self.bodies[gyro.body], &mut self.state, h, elapsed);
        }
    }

    /// Slots of bodies that joints were moving at the end of the step, however slowly.
    pub(crate) fn creeping(&self) -> &[u32] {
        self.joints.creeping()
    }

    /// Impulses to start the next step from; and from the spins what contacts added to the angular momentum.
    fn store_impulses(&mut self, input: &mut SolverInput<'_, N>) {
        let blocks = self.contacts.blocks.as_slice();
        let coming = Coming { blocks, active: &self.active, bodies: &self.bodies, errand: Errand::Store };
        for (index, block) in self.contacts.blocks.iter().enumerate() {
            coming.fetch(index, input.pairs);
            coming.fetch_rows(index, &self.contacts.rows);
            let rows = &self.contacts.rows[block.start..block.start + Layout::<N>::block_len(block)];
            for (lane, &index) in block.contacts.iter().enumerate() {
                if index == Group::EMPTY {
                    continue;
                }
                let pair = input.pairs.get_mut(self.active[index as usize].pair);
                if let Some(pair) = pair
                    && let Some(contact) = pair.contact.as_deref_mut()
                {
                    contacts::store(block, rows, lane, contact);
                    let meeting = Meeting::of(contact);
                    // Written where it changes: of most pairs a step only reads.
                    if pair.meeting != meeting {
                        pair.meeting = meeting;
                    }
                    let (a, b) = (block.bodies_a[lane] as usize, block.bodies_b[lane] as usize);
                    if a != 0 && b != 0 {
                        let excess = contacts::excess::<N>(block, rows, lane);
                        let share = contact.share_of_b;
                        for (body, share) in [(a, share - 1.0), (b, -share)] {
                            let spin = &mut self.state[body * Sizes::<N>::STATE + N..];
                            if block.round {
                                self.bodies[body].add_spin_of_ball(spin, &excess, share);
                            } else {
                                self.bodies[body].add_spin(spin, &excess, share);
                            }
                        }
                    }
                }
            }
        }
        self.joints.store(input.joints, input.dt / f64::from(input.substeps));
    }
}

/// Blocks below which another thread is not worth its while.
const FEW_BLOCKS: usize = 16;

/// Fills the rows of consecutive blocks, halves of them side by side.
fn fill_blocks<const N: usize>(
    blocks: &[Block],
    rows: &mut [Lanes],
    fill: &(impl Fn(&Block, &mut [Lanes], &mut Gathered<N>) + Sync),
    coming: &(impl Fn(&[Block], usize) + Sync),
) {
    if blocks.len() <= FEW_BLOCKS {
        fill_in_turn(blocks, rows, fill, coming);
        return;
    }
    let (first, second) = blocks.split_at(blocks.len() / 2);
    let (rows_of_first, rows_of_second) = rows.split_at_mut(second[0].start - first[0].start);
    rayon::join(
        || fill_blocks(first, rows_of_first, fill, coming),
        || fill_blocks(second, rows_of_second, fill, coming),
    );
}

fn fill_in_turn<const N: usize>(
    blocks: &[Block],
    rows: &mut [Lanes],
    fill: &impl Fn(&Block, &mut [Lanes], &mut Gathered<N>),
    coming: &impl Fn(&[Block], usize),
) {
    let mut gathered = Gathered::ZERO;
    let start = blocks.first().map_or(0, |block| block.start);
    for (index, block) in blocks.iter().enumerate() {
        let end = blocks.get(index + 1).map_or(start + rows.len(), |next| next.start);
        let rows = &mut rows[block.start - start..end - start];
        coming(blocks, index);
        fill(block, rows, &mut gathered);
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
