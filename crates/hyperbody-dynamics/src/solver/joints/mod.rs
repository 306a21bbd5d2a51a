//! Joints as constraint rows.
//!
//! A joint is a list of scalar rows (`joint/rows.rs`): a coordinate of its second frame in the first, and what becomes of
//! it. A row measures its coordinate's rate by a direction and a lever on each body: u·(v_b − v_a) + B_b·ω_b − B_a·ω_a,
//! with u = 0 for turns.
//!
//! Joints that hang together are solved together, by factors of their linear system (`cluster`, `factor`): a chain of a hundred
//! links is as firm as one joint. Limits and motors are rows of that system too, as long as they press and are not at their
//! strength. Nets of ball joints for which that would be dear are swept, by a method of their own (`nets`). What else is too large is swept
//! joint by joint, as in engines that know no other way; its joints are softer, because a sweep over springs is stable up to a stiffness only.
//!
//! # What the substep does, and why it keeps energy
//!
//! The obvious way, to make the velocity tangent to the constraint where the bodies are and then move, is of first order: a
//! pendulum leaves its circle along the tangent, is turned onto the tangent of the next place, and loses the share (ωh)² of
//! its energy each substep, five to ten percents a second at the usual steps. Here positions and velocities have one
//! pass each, as in the method RATTLE (H. C. Andersen, 1983), which is symplectic and of second order:
//!
//! 1. *Moving pass*, with the rows of the place q before the move: J(q) v h + c = −(share of the gap), where c is what the
//!    coordinate changes beyond its tangent, found by evaluating it where the bodies would be (`next` in `place.rs`). So the
//!    bodies go along the chord and arrive on the constraint.
//! 2. *Settling pass*, with rows made anew at the place after the move: J(q') v = 0.
//!
//! Half of what holds a body on its curve is applied in each pass, so each has impulses of its own that start the next.
//! Gravity enters whole before the move; that is the symmetric method up to a change of variables that does not grow.
//! What is left of the gap is drawn in by a stiff spring, which does lose energy, in proportion to how fast the load varies. Where joints are swept,
//! what they are expected to do beyond their tangents leads astray: there both passes mend one impulse, at first order.
//!
//! | file | holds |
//! |---|---|
//! | `members` | which joints there are in a step |
//! | `nets` | nets of ball joints |
//! | `place` | where jointed bodies are, and will be, within the step |
//! | `geometry` | coordinates of a joint and their levers |
//! | `coupled` | where teeth and threads press |
//! | `cluster`, `elimination`, `fronts` | which joints are solved together, in which order, and as which matrices |
//! | `factor`, `panel` | factors of a cluster's system, and the arithmetic on them |
//! | `block` | factors of a joint's own part |
//! | `ahead` | what coordinates do beyond their tangents |
//! | `give` | what rows give way, and how fast they draw back |
//! | `aim` | what each row wants, and the impulses it may have |
//! | `solve` | the passes |
//! | `tension` | light bodies under great loads |

mod ahead;
mod aim;
mod block;
mod cluster;
mod coupled;
mod elimination;
mod factor;
mod fronts;
mod geometry;
mod give;
mod members;
mod nets;
mod panel;
mod place;
#[cfg(test)]
mod rank;

mod solve;
mod tension;

use hyperbody_math::{Bivector, Matrix, Vector};

use super::bodies::{MAX_PLANES, SolverBody};
use super::gyro::Gyro;
use super::machine::Processor;
use super::softness::Softness;
use super::{Real, SolverInput};
use crate::Tuning;
use crate::body::Body;
use crate::handle::Arena;
use crate::joint::{Coupling, Joint, RowSpec};
use cluster::{Plan, number};
use factor::Scratch;
use members::Members;
use nets::Nets;
pub(crate) use place::Moment;
use place::Place;
pub(crate) use solve::Pass;
pub(crate) use tension::Tension;

/// One scalar row of a joint, at the present place.
#[derive(Clone, Copy, Debug)]
struct Row<const N: usize> {
    spec: RowSpec,
    /// Unit direction in the world; zero for turns.
    direction: Vector<N>,
    /// The plane in which a turn is measured, unit, world.
    plane: Bivector<N>,
    /// Levers over √I in the bodies' solver frames.
    arm_a: [f64; MAX_PLANES],
    arm_b: [f64; MAX_PLANES],
    /// Rate of the coordinate by base velocities, m/s or rad/s.
    base: f64,
    /// What forces add to it in a second.
    acceleration: f64,
    /// The coordinate, m or rad.
    value: f64,
    /// Its rate when it was last looked at, impulses included.
    rate: f64,
    /// What it changes beyond its tangent within the substep, over h.
    curve: f64,
    /// What an impulse changes the rate by, 1/kg or 1/(kg·m²).
    response: f64,
    /// What the row gives way, as soft springs do, beside its response.
    compliance: f64,
    /// What the spring of held rows asks for beside, m/s or rad/s.
    drawn: f64,
    /// Whether it gets an impulse of the system that is factored.
    engaged: bool,
    /// Whether it was taken out because it came to the end of its range.
    stopped: bool,
    /// Impulses of this substep before and after the move, N·s or N·m·s.
    impulse: f64,
    settle: f64,
}

/// One joint of the step.
#[derive(Clone, Debug)]
struct JointRows<const N: usize> {
    slot: u32,
    /// Places of its bodies.
    a: usize,
    b: usize,
    /// Anchors from the centres of mass, and axes of the frames, at the start of the step in world axes.
    offset_a: Vector<N>,
    offset_b: Vector<N>,
    frame_a: Matrix<N>,
    frame_b: Matrix<N>,
    groups: [u8; N],
    /// What is coupled, and what that holds.
    coupling: Option<(Coupling, f64)>,
    /// Its rows; those that are held stand first.
    first: usize,
    held: usize,
    end: usize,
    /// First of what its rows have to do with each other: the lower triangle of K, row by row.
    own: usize,
    /// Spring of the held rows.
    soft: Softness,
    /// The same for whatever does not give way by intent: limits, and all of joints that are not soft.
    rigid: Softness,
    /// Whether that is the spring of a soft joint.
    is_soft: bool,
    /// Whether it is solved together with all joints around it.
    exact: bool,
    /// Whether both bodies move: what keeps a point on a point then acts midway between them.
    meets_midway: bool,
    /// Most impulse a substep of soft joints, N·s and N·m·s.
    max_impulse: f64,
    max_twist: f64,
    /// Sums over the step, on b.
    step_impulse: Vector<N>,
    step_twist: Bivector<N>,
    /// Axes of the first frame, now.
    axes: Matrix<N>,
}

/// All joints of a step, and buffers kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joints<const N: usize> {
    places: Vec<Place<N>>,
    /// By solver row: the place, or [`NONE`].
    place_of: Vec<u32>,
    joints: Vec<JointRows<N>>,
    rows: Vec<Row<N>>,
    /// What the rows of each joint have to do with each other.
    own: Vec<f64>,
    members: Members,
    plan: Plan,
    nets: Nets,
    /// Factors of all clusters, and room for what their making and solving needs.
    factors: Vec<f64>,
    scratch: Scratch,
    unknowns: Vec<f64>,
    creeping: Vec<u32>,
}

const NONE: u32 = u32::MAX;

/// How much stiffer joints are where they are solved exactly: the uppermost joint of a chain of a hundred links, with a hundred times
/// a link's mass at its end, gives 4 mm.
const EXACT_STIFFNESS: f64 = 2.5;

impl<const N: usize> Joints<N> {
    /// Takes the joints of the world that have something to do.
    pub(crate) fn collect(&mut self, input: &SolverInput<'_, N>, bodies: &[SolverBody<N>], gyros: &[Gyro<N>], h: f64) {
        self.places.clear();
        self.place_of.clear();
        self.place_of.resize(bodies.len(), NONE);
        self.joints.clear();
        self.rows.clear();
        self.members.find(input, bodies);
        self.plan.update(&self.members.links, self.members.rows.len(), input.tuning.joint_budget);
        let (mut own, mut swept) = (0, 0);
        for index in 0..self.members.slots.len() {
            if self.plan.nets.joints.get(swept) == Some(&number(index)) {
                swept += 1;
                continue;
            }
            let slot = self.members.slots[index];
            let Some(joint) = input.joints.at(slot) else { continue };
            let Some(b) = input.bodies.at(joint.body_b) else { continue };
            let a = input.bodies.at(joint.body_a);
            let (place_a, place_b) = (self.place(a, gyros), self.place(Some(b), gyros));
            let first = self.rows.len();
            self.rows.extend(joint.rows.iter().zip(&joint.impulses).map(|(&spec, &impulses)| Row::new(spec, impulses)));
            self.joints.push(JointRows::new(slot, joint, (a, place_a), (b, place_b), (first, own), h));
            own += block::len(joint.rows.len());
        }
        self.own.clear();
        self.own.resize(own, 0.0);
        self.factors.resize(self.plan.values as usize, 0.0);
        for cluster in &self.plan.clusters {
            for node in self.plan.nodes_of(cluster) {
                self.joints[node.joint as usize].exact = cluster.whole;
            }
        }
        self.spread_stiffness(input.tuning, h);
        self.nets.collect(&self.plan.nets, input, bodies, (&self.members.slots, &self.members.rows));
    }

    /// A system that is solved exactly can be as stiff as one likes; a sweep over its parts cannot.
    fn spread_stiffness(&mut self, tuning: &Tuning, h: f64) {
        let exact = Softness::uncapped(EXACT_STIFFNESS * tuning.joint_hz, tuning.joint_damping_ratio, h);
        self.nets.soften(tuning, h);
        let swept = Softness::new(tuning.joint_hz, tuning.joint_damping_ratio, h);
        for joint in &mut self.joints {
            joint.rigid = if joint.exact { exact } else { swept };
            if !joint.is_soft {
                joint.soft = joint.rigid;
            }
        }
    }

    /// Slots of bodies that a motor or a spring was moving at the end of the step, however slowly.
    pub(crate) fn creeping(&self) -> &[u32] {
        &self.creeping
    }

    /// Which bodies that rotate freely have joints.
    pub(crate) fn jointed_gyros(&self) -> impl Iterator<Item = usize> {
        self.places.iter().filter_map(|place| place.gyro)
    }

    /// The place of a body; of what no impulse moves, a new one.
    fn place(&mut self, body: Option<&Body<N>>, gyros: &[Gyro<N>]) -> usize {
        let row = body.map_or(0, |body| body.solver_index as usize);
        if row != 0 && self.place_of[row] != NONE {
            return self.place_of[row] as usize;
        }
        let place = self.places.len();
        if row != 0 {
            #[expect(clippy::cast_possible_truncation, reason = "fewer places than bodies")]
            let number = place as u32;
            self.place_of[row] = number;
        }
        let gyro = gyros.binary_search_by_key(&row, |gyro| gyro.body).ok().filter(|_| row != 0);
        self.places.push(Place::new(row, gyro, body.map_or(Vector::ZERO, |body| body.centre)));
        place
    }

    /// Hands the impulses back to the joints of the world.
    pub(crate) fn store(&mut self, joints: &mut Arena<Joint<N>, crate::JointHandle>, h: f64) {
        self.creeping.clear();
        for rows in &self.joints {
            let Some(joint) = joints.at_mut(rows.slot) else { continue };
            if self.rows[rows.first..rows.end].iter().any(|row| rows.creeps(row, h)) {
                self.creeping.extend([joint.body_a, joint.body_b]);
            }
            for (stored, row) in joint.impulses.iter_mut().zip(&self.rows[rows.first..rows.end]) {
                *stored = [row.impulse, row.settle];
            }
            joint.step_impulse = rows.step_impulse;
            joint.step_twist = rows.step_twist;
            let sound = joint.impulses.iter().flatten().all(|impulse| impulse.is_finite());
            if !(sound && rows.step_impulse.is_finite() && rows.step_twist.is_finite()) {
                // When the body that is no number comes back, nothing of it may start the next step.
                joint.let_go();
            }
        }
        self.nets.store(&self.plan.nets, joints);
    }
}

impl<const N: usize> Row<N> {
    fn new(spec: RowSpec, [impulse, settle]: [f64; 2]) -> Self {
        Self {
            spec,
            direction: Vector::ZERO,
            plane: Bivector::ZERO,
            arm_a: [0.0; MAX_PLANES],
            arm_b: [0.0; MAX_PLANES],
            base: 0.0,
            acceleration: 0.0,
            value: 0.0,
            rate: 0.0,
            curve: 0.0,
            response: 0.0,
            compliance: 0.0,
            drawn: 0.0,
            engaged: true,
            stopped: false,
            impulse,
            settle,
        }
    }
}

impl<const N: usize> JointRows<N> {
    fn new(
        slot: u32,
        joint: &Joint<N>,
        (body_a, a): (Option<&Body<N>>, usize),
        (body_b, b): (&Body<N>, usize),
        (first, own): (usize, usize),
        h: f64,
    ) -> Self {
        let (frame_a, frame_b) = joint.frames();
        let (offset_a, frame_a) = match body_a {
            None => (joint.arm_a, frame_a),
            Some(body) => (body.rotation.rotate(joint.arm_a), body.rotation * frame_a),
        };
        let def = &joint.def;
        Self {
            slot,
            a,
            b,
            offset_a,
            offset_b: body_b.rotation.rotate(joint.arm_b),
            frame_a: *frame_a.matrix(),
            frame_b: *(body_b.rotation * frame_b).matrix(),
            groups: joint.groups,
            coupling: def.coupling.map(|coupling| (coupling, def.phase.unwrap_or(0.0))),
            first,
            held: first + joint.held,
            end: first + joint.rows.len(),
            own,
            soft: def.softness.map_or(Softness::RIGID, |(hz, damping_ratio)| Softness::new(hz, damping_ratio, h)),
            rigid: Softness::RIGID,
            is_soft: def.softness.is_some(),
            exact: false,
            meets_midway: body_b.is_moving() && body_a.is_some_and(Body::is_moving),
            max_impulse: def.max_force * h,
            max_twist: def.max_torque * h,
            step_impulse: Vector::ZERO,
            step_twist: Bivector::ZERO,
            axes: Matrix::IDENTITY,
        }
    }
}

/// What the passes work on.
pub(crate) struct Moving<'a, const N: usize> {
    pub(crate) bodies: &'a [SolverBody<N>],
    pub(crate) gyros: &'a [Gyro<N>],
    pub(crate) state: &'a mut [Real],
    pub(crate) processor: Processor,
}
