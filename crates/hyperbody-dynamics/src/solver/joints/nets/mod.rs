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
//! load, is as much smaller as sweeps are better. So they are accelerated (`chebyshev`): three sweeps forth and back do what thirteen would.
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
//! Functions of passes are inlined where that is what gives them the machine's instructions. In a browser all code has them, and the module is
//! lighter without.
//!
//! | file | holds |
//! |---|---|
//! | `plan` | which joints are swept side by side |
//! | `layout` | where numbers stand |
//! | `place` | where anchors are within the step, and how joints answer |
//! | `sweep` | the passes |
//! | `chebyshev` | their acceleration |
//! | `pairing` | both bodies of eight joints |

#[cfg(test)]
mod bits;
mod chebyshev;
mod layout;
mod pairing;
mod place;
mod plan;
mod sweep;

use hyperbody_math::{Bivector, Vector};

use super::Moving;
use super::place::Moment;
use crate::body::Body;
use crate::handle::Arena;
use crate::joint::Joint;
use crate::solver::SolverInput;
use crate::solver::bodies::{Sizes, SolverBody};
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::Processor;
use crate::solver::softness::Softness;
use crate::{JointHandle, Tuning};
use chebyshev::Chebyshev;
use layout::{Ground, Swept};
use pairing::vectors;
use place::Refresh;
use plan::Block;
pub(super) use plan::NetPlan;
use sweep::{Move, Numbers, Settle};

/// Sweeps forth and back before each move.
const FORTH_AND_BACK: usize = 3;

/// How much stiffer the joints of nets are than [`Tuning::joint_hz`] says.
const STIFFNESS: f64 = 2.1;

/// The share β of a gap that a substep draws back at most, in parts of what springs give way: so many sweeps bear β = 0.4 with 0.02 no more.
const MOST_DRAWN: f64 = 11.0;

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
    soft: Softness,
}

/// Whether impulses turn a body by the same moment in all planes, or not at all.
pub(super) fn is_even<const N: usize>(body: &SolverBody<N>) -> bool {
    body.frame.is_none()
}

impl Nets {
    /// Finds the springs of the joints. `h` is the length of a substep, s.
    pub(super) fn soften(&mut self, tuning: &Tuning, h: f64) {
        self.soft = Softness::uncapped(STIFFNESS * tuning.joint_hz, tuning.joint_damping_ratio, h);
        self.soft.bias_rate = self.soft.bias_rate.min(MOST_DRAWN * self.soft.compliance() / h);
    }

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
        self.swept.resize(blocks * Swept::<N>::LEN, Lanes::ZERO);
        self.ground.resize(blocks * Ground::<N>::LEN, Lanes::ZERO);
        self.impulses.resize(blocks * N, Lanes::ZERO);
        for of_bodies in [&mut self.velocities, &mut self.displacements] {
            of_bodies.clear();
            of_bodies.resize(self.rows.len() * vectors::<N>(), Lanes::ZERO);
        }
        let swept = self.swept.chunks_exact_mut(Swept::<N>::LEN).zip(self.ground.chunks_exact_mut(Ground::<N>::LEN));
        for ((block, impulses), (swept, ground)) in plan.blocks.iter().zip(self.impulses.chunks_exact_mut(N)).zip(swept)
        {
            ground[Ground::<N>::SPIN_UP_A..].fill(Lanes::ZERO);
            for (lane, &joint) in block.joints.iter().enumerate() {
                let joint = self.slots.get(joint as usize).and_then(|&slot| input.joints.at(slot));
                let numbers = Fill { lane, swept, ground };
                let Some(joint) = joint else {
                    numbers.fill::<N>(&[End::NOTHING, End::NOTHING]);
                    impulses.iter_mut().for_each(|lanes| lanes.0[lane] = 0.0);
                    continue;
                };
                numbers.fill(&[
                    End::new(input.bodies.at(joint.body_a), joint.arm_a, bodies),
                    End::new(input.bodies.at(joint.body_b), joint.arm_b, bodies),
                ]);
                for (lanes, [moving, settling]) in impulses.iter_mut().zip(&joint.impulses) {
                    lanes.0[lane] = (moving + settling) as Real;
                }
            }
        }
    }

    /// Looks where everything is now.
    pub(super) fn refresh<const N: usize>(&mut self, plan: &NetPlan, moving: &Moving<'_, N>, moment: &Moment) {
        gather::<N>(&mut self.displacements, &self.rows, moving.state, Sizes::<N>::VELOCITY);
        let (swept, ground) = (self.swept.as_mut_slice(), self.ground.as_mut_slice());
        let displacements = self.displacements.as_slice();
        moving.processor.run(Refresh::<N> { blocks: &plan.blocks, swept, ground, displacements, moment });
    }

    /// Solves before positions move. `h` is the length of a substep, s.
    pub(super) fn before_move<const N: usize>(&mut self, plan: &NetPlan, moving: &mut Moving<'_, N>, h: f64) {
        let soft = self.soft;
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
        gather::<N>(&mut self.velocities, &self.rows, moving.state, 0);
        let Self { swept, ground, impulses, velocities, chebyshev, .. } = self;
        pass(Numbers { plan, swept, ground, impulses, velocities, chebyshev }, moving.processor);
        scatter::<N>(&self.velocities, &self.rows, moving.state);
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

/// Takes numbers of bodies together: those that stand `first` in their rows of the solver's state.
fn gather<const N: usize>(of_bodies: &mut [Lanes], rows: &[u32], state: &[Real], first: usize) {
    for (lanes, &row) in of_bodies.chunks_exact_mut(vectors::<N>()).zip(rows).skip(1) {
        let from = &state[row as usize * Sizes::<N>::STATE + first..][..Sizes::<N>::VELOCITY];
        for i in 0..Sizes::<N>::VELOCITY {
            lanes[i / WIDTH].0[i % WIDTH] = from[i];
        }
    }
}

/// Puts velocities back.
fn scatter<const N: usize>(velocities: &[Lanes], rows: &[u32], state: &mut [Real]) {
    for (lanes, &row) in velocities.chunks_exact(vectors::<N>()).zip(rows).skip(1) {
        let to = &mut state[row as usize * Sizes::<N>::STATE..][..Sizes::<N>::VELOCITY];
        for i in 0..Sizes::<N>::VELOCITY {
            to[i] = lanes[i / WIDTH].0[i % WIDTH];
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
    spins_up: bool,
    inverse_sqrt_mass: f64,
    inverse_sqrt_moment: f64,
}

impl<const N: usize> End<N> {
    const NOTHING: Self = Self {
        centre: Vector::ZERO,
        offset: Vector::ZERO,
        velocity: Vector::ZERO,
        acceleration: Vector::ZERO,
        spin: Bivector::ZERO,
        spin_up: Bivector::ZERO,
        spins_up: false,
        inverse_sqrt_mass: 0.0,
        inverse_sqrt_moment: 0.0,
    };

    /// `arm` is in the frame of the body, or of the world where there is none.
    #[inline]
    fn new(body: Option<&Body<N>>, arm: Vector<N>, bodies: &[SolverBody<N>]) -> Self {
        let (centre, offset) = body.map_or((Vector::ZERO, arm), |body| (body.centre, body.rotation.rotate(arm)));
        let still = Self { centre, offset, ..Self::NOTHING };
        match body.map_or(0, |body| body.solver_index as usize) {
            0 => still,
            row => {
                let body = &bodies[row];
                Self {
                    velocity: body.velocity,
                    acceleration: body.acceleration,
                    spin: body.angular_velocity,
                    spin_up: body.angular_acceleration,
                    spins_up: body.spins_up,
                    inverse_sqrt_mass: body.inverse_sqrt_mass,
                    inverse_sqrt_moment: body.inverse_sqrt_moments[0],
                    ..still
                }
            }
        }
    }
}

/// One lane of a block. The remainders by the width spare checks.
struct Fill<'a> {
    lane: usize,
    swept: &'a mut [Lanes],
    ground: &'a mut [Lanes],
}

impl Fill<'_> {
    #[inline]
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
        if a.spins_up {
            self.note_planes(Ground::<N>::SPIN_UP_A, &a.spin_up);
        }
        if b.spins_up {
            self.note_planes(Ground::<N>::SPIN_UP_B, &b.spin_up);
        }
    }

    #[inline]
    fn note(&mut self, at: usize, value: f64) {
        self.ground[at].0[self.lane % WIDTH] = value as Real;
    }

    #[inline]
    fn note_vector<const N: usize>(&mut self, at: usize, vector: Vector<N>) {
        for i in 0..N {
            self.note(at + i, vector[i]);
        }
    }

    #[inline]
    fn note_planes<const N: usize>(&mut self, mut at: usize, planes: &Bivector<N>) {
        for i in 0..N {
            for j in i + 1..N {
                self.note(at, planes.get(i, j));
                at += 1;
            }
        }
    }
}
