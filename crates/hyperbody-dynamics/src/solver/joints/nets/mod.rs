//! Nets: ball joints that hang together in so many loops that their factors would cost far more than a sweep.
//!
//! They are swept, eight joints side by side, in single precision. A sweep settles at once what neighbours have to do with each other, and only
//! slowly what a whole net has to agree on. Two things follow from that.
//!
//! *What the sweeps leave out must not come back as energy.* Impulses are carried from substep to substep. Let a substep's sweeps bring those of
//! one mode nearer to what they should be by the share c, and springs draw a gap back by the share β of it. With impulse u, rate v and gap g in the same
//! units, u ← u − c (v + u + β g), v ← v + u, g ← g + v: to leading order z³ + c z² + c z + c β, which grows if β > c. A net has modes
//! without end that hardly move anything (a flat net of crosses has more conditions than motions), and of those c is small. Springs that give way
//! give them all at least the c that belongs to their compliance; and so the compliance that springs have to have, and with it what a net gives under its
//! load, is as much smaller as sweeps are better. So they are accelerated (`chebyshev`): four sweeps forth and back do what thirty would.
//! Springs that are as soft in each direction as K is (E. Catto, "Soft Constraints", 2011) give slow modes the same c whatever the arms.
//!
//! *Tangents are enough.* Both passes mend one impulse, at first order: a net that swings loses energy, and does not ring.
//!
//! Nets are of plain ball joints between bodies whose moments are the same in all planes, such as balls and cubes, and the immovable. There the
//! turn of a body is one exponential, K has a closed inverse, and arms in world axes are all that sweeps need. All other joints are solved
//! together with whatever hangs on them, as far as that can be paid (`cluster`).
//!
//! Tried: chains of a net solved exactly in turn, which is no better than joints; impulses that are drawn on slowly until the gap is gone, which
//! swings up; gaps mended as places, beside velocities, which is safe but as slow as plain sweeps.
//!
//! | file | holds |
//! |---|---|
//! | `plan` | which joints are swept side by side |
//! | `layout` | where numbers stand |
//! | `place` | where anchors are within the step, and how joints answer |
//! | `sweep` | the passes |
//! | `chebyshev` | their acceleration |
//! | `pairing` | both bodies of eight joints |

mod chebyshev;
mod layout;
mod pairing;
mod place;
mod plan;
mod sweep;

use hyperbody_math::{Bivector, Vector};

use super::Moving;
use super::place::Moment;
use crate::JointHandle;
use crate::body::Body;
use crate::handle::Arena;
use crate::joint::Joint;
use crate::solver::SolverInput;
use crate::solver::bodies::{Sizes, SolverBody};
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::Processor;
use crate::solver::softness::Softness;
use chebyshev::Chebyshev;
use layout::{Ground, Swept};
use pairing::vectors;
use place::Refresh;
use plan::Block;
pub(super) use plan::NetPlan;
use sweep::{Move, Numbers, Settle};

/// Sweeps forth and back before each move.
const FORTH_AND_BACK: usize = 4;

/// All nets of a step, and buffers kept from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Nets {
    /// By joint: its slot in the world.
    slots: Vec<u32>,
    /// By body: its row of the solver.
    rows: Vec<u32>,
    swept: Vec<Lanes>,
    ground: Vec<Lanes>,
    impulses: Vec<Lanes>,
    velocities: Vec<Lanes>,
    displacements: Vec<Lanes>,
    chebyshev: Chebyshev,
}

/// Whether impulses turn a body by the same moment in all planes, or not at all.
pub(super) fn is_even<const N: usize>(body: &SolverBody<N>) -> bool {
    body.frame.is_none()
}

impl Nets {
    /// Takes the joints of the plan. `slots` and `rows` tell where its joints and bodies are.
    pub(super) fn collect<const N: usize>(
        &mut self,
        plan: &NetPlan,
        input: &SolverInput<'_, N>,
        bodies: &[SolverBody<N>],
        (slots, rows): (&[u32], &[u32]),
    ) {
        self.slots.clear();
        self.slots.extend(plan.joints.iter().map(|&joint| slots[joint as usize]));
        self.rows.clear();
        self.rows.extend(plan.bodies.iter().map(|&body| rows[body as usize]));
        let blocks = plan.blocks.len();
        self.swept.clear();
        self.swept.resize(blocks * Swept::<N>::LEN, Lanes::ZERO);
        self.ground.clear();
        self.ground.resize(blocks * Ground::<N>::LEN, Lanes::ZERO);
        self.impulses.clear();
        self.impulses.resize(blocks * N, Lanes::ZERO);
        let of_bodies = self.rows.len() * vectors::<N>();
        self.velocities.clear();
        self.velocities.resize(of_bodies, Lanes::ZERO);
        self.displacements.clear();
        self.displacements.resize(of_bodies, Lanes::ZERO);
        for (index, block) in plan.blocks.iter().enumerate() {
            for (lane, &joint) in block.joints.iter().enumerate().filter(|(_, joint)| **joint != Block::EMPTY) {
                let Some(joint) = input.joints.at(self.slots[joint as usize]) else { continue };
                let ends = [
                    End::new(input.bodies.at(joint.body_a), joint.arm_a, bodies),
                    End::new(input.bodies.at(joint.body_b), joint.arm_b, bodies),
                ];
                let numbers = Fill {
                    lane,
                    swept: &mut self.swept[index * Swept::<N>::LEN..],
                    ground: &mut self.ground[index * Ground::<N>::LEN..],
                };
                numbers.fill(&ends);
                for (lanes, [moving, settling]) in self.impulses[index * N..].iter_mut().zip(&joint.impulses) {
                    lanes.0[lane] = (moving + settling) as Real;
                }
            }
        }
    }

    /// Looks where everything is now.
    pub(super) fn refresh<const N: usize>(&mut self, plan: &NetPlan, moving: &Moving<'_, N>, moment: &Moment) {
        let displacement = |row: usize| row * Sizes::<N>::STATE + Sizes::<N>::VELOCITY;
        copy::<N>(&mut self.displacements, &self.rows, |row| &moving.state[displacement(row)..]);
        let (swept, ground) = (self.swept.as_mut_slice(), self.ground.as_mut_slice());
        let displacements = self.displacements.as_slice();
        moving.processor.run(Refresh::<N> { blocks: &plan.blocks, swept, ground, displacements, moment });
    }

    /// Solves before positions move. `h` is the length of a substep, s.
    pub(super) fn before_move<const N: usize>(
        &mut self,
        plan: &NetPlan,
        moving: &mut Moving<'_, N>,
        soft: Softness,
        h: f64,
    ) {
        self.solve(plan, moving, |numbers, processor| processor.run(Move::<N> { numbers, soft, h }));
    }

    /// Solves after positions have moved.
    pub(super) fn after_move<const N: usize>(&mut self, plan: &NetPlan, moving: &mut Moving<'_, N>) {
        self.solve(plan, moving, |numbers, processor| processor.run(Settle::<N> { numbers }));
    }

    fn solve<const N: usize>(
        &mut self,
        plan: &NetPlan,
        moving: &mut Moving<'_, N>,
        pass: impl FnOnce(Numbers<'_>, Processor),
    ) {
        copy::<N>(&mut self.velocities, &self.rows, |row| &moving.state[row * Sizes::<N>::STATE..]);
        let Self { swept, ground, impulses, velocities, chebyshev, .. } = self;
        pass(Numbers { plan, swept, ground, impulses, velocities, chebyshev }, moving.processor);
        let velocities = self.velocities.chunks_exact(vectors::<N>());
        for (velocity, &row) in velocities.zip(&self.rows).skip(1) {
            let at = row as usize * Sizes::<N>::STATE;
            let state = &mut moving.state[at..at + Sizes::<N>::VELOCITY];
            for (state, lanes) in state.chunks_mut(WIDTH).zip(velocity) {
                state.copy_from_slice(&lanes.0[..state.len()]);
            }
        }
    }

    /// Hands the impulses back to the joints of the world.
    pub(super) fn store<const N: usize>(&self, plan: &NetPlan, joints: &mut Arena<Joint<N>, JointHandle>) {
        for (index, block) in plan.blocks.iter().enumerate() {
            let ground = &self.ground[index * Ground::<N>::LEN..(index + 1) * Ground::<N>::LEN];
            let impulses = &self.impulses[index * N..(index + 1) * N];
            for (lane, &joint) in block.joints.iter().enumerate().filter(|(_, joint)| **joint != Block::EMPTY) {
                let Some(joint) = joints.at_mut(self.slots[joint as usize]) else { continue };
                let of = |at: usize| f64::from(ground[at].0[lane]);
                joint.step_impulse = Vector::from_fn(|i| of(Ground::<N>::STEP_IMPULSE + i));
                let mut twist = (Ground::<N>::STEP_TWIST..).map(of);
                joint.step_twist = Bivector::from_fn(|_, _| twist.next().unwrap_or(0.0));
                for (stored, impulse) in joint.impulses.iter_mut().zip(impulses) {
                    *stored = [f64::from(impulse.0[lane]), 0.0];
                }
                let sound = joint.impulses.iter().flatten().all(|impulse| impulse.is_finite());
                if !(sound && joint.step_impulse.is_finite() && joint.step_twist.is_finite()) {
                    joint.let_go();
                }
            }
        }
    }
}

/// Takes numbers of bodies together, by the solver's rows.
fn copy<'a, const N: usize>(of_bodies: &mut [Lanes], rows: &[u32], from: impl Fn(usize) -> &'a [Real]) {
    for (lanes, &row) in of_bodies.chunks_exact_mut(vectors::<N>()).zip(rows).skip(1) {
        let from = &from(row as usize)[..Sizes::<N>::VELOCITY];
        for (lanes, from) in lanes.iter_mut().zip(from.chunks(WIDTH)) {
            lanes.0[..from.len()].copy_from_slice(from);
        }
    }
}

/// Where a joint holds a body, and what that does without impulses.
struct End<const N: usize> {
    centre: Vector<N>,
    offset: Vector<N>,
    velocity: Vector<N>,
    acceleration: Vector<N>,
    spin: Bivector<N>,
    spin_up: Bivector<N>,
    inverse_sqrt_mass: f64,
    inverse_sqrt_moment: f64,
}

impl<const N: usize> End<N> {
    /// `arm` is in the frame of the body, or of the world where there is none.
    fn new(body: Option<&Body<N>>, arm: Vector<N>, bodies: &[SolverBody<N>]) -> Self {
        let (centre, offset) = body.map_or((Vector::ZERO, arm), |body| (body.centre, body.rotation.rotate(arm)));
        let still = Self {
            centre,
            offset,
            velocity: Vector::ZERO,
            acceleration: Vector::ZERO,
            spin: Bivector::ZERO,
            spin_up: Bivector::ZERO,
            inverse_sqrt_mass: 0.0,
            inverse_sqrt_moment: 0.0,
        };
        match body.map_or(0, |body| body.solver_index as usize) {
            0 => still,
            row => {
                let body = &bodies[row];
                Self {
                    velocity: body.velocity,
                    acceleration: body.acceleration,
                    spin: body.angular_velocity,
                    spin_up: body.angular_acceleration,
                    inverse_sqrt_mass: body.inverse_sqrt_mass,
                    inverse_sqrt_moment: body.inverse_sqrt_moments[0],
                    ..still
                }
            }
        }
    }
}

/// One lane of a block.
struct Fill<'a> {
    lane: usize,
    swept: &'a mut [Lanes],
    ground: &'a mut [Lanes],
}

impl Fill<'_> {
    fn fill<const N: usize>(mut self, [a, b]: &[End<N>; 2]) {
        self.swept[Swept::<N>::MASS_A].0[self.lane] = a.inverse_sqrt_mass as Real;
        self.swept[Swept::<N>::MASS_B].0[self.lane] = b.inverse_sqrt_mass as Real;
        self.note(Ground::<N>::LIGHTNESS_A, a.inverse_sqrt_moment);
        self.note(Ground::<N>::LIGHTNESS_B, b.inverse_sqrt_moment);
        let both = a.inverse_sqrt_mass > 0.0 && b.inverse_sqrt_mass > 0.0;
        self.note(Ground::<N>::SHARE, if both { 0.5 } else { 0.0 });
        self.note_vector(Ground::<N>::OFFSET_A, a.offset);
        self.note_vector(Ground::<N>::OFFSET_B, b.offset);
        self.note_vector(Ground::<N>::START, (b.centre + b.offset) - (a.centre + a.offset));
        self.note_vector(Ground::<N>::VELOCITY, b.velocity - a.velocity);
        self.note_vector(Ground::<N>::ACCELERATION, b.acceleration - a.acceleration);
        self.note_planes(Ground::<N>::SPIN_A, &a.spin);
        self.note_planes(Ground::<N>::SPIN_B, &b.spin);
        self.note_planes(Ground::<N>::SPIN_UP_A, &a.spin_up);
        self.note_planes(Ground::<N>::SPIN_UP_B, &b.spin_up);
    }

    fn note(&mut self, at: usize, value: f64) {
        self.ground[at].0[self.lane] = value as Real;
    }

    fn note_vector<const N: usize>(&mut self, at: usize, vector: Vector<N>) {
        for i in 0..N {
            self.note(at + i, vector[i]);
        }
    }

    fn note_planes<const N: usize>(&mut self, at: usize, planes: &Bivector<N>) {
        for (k, plane) in planes.planes().enumerate() {
            self.note(at + k, plane);
        }
    }
}
