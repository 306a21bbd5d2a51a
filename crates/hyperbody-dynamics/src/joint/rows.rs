//! A joint as the world keeps it: its definition taken apart into scalar rows.

use std::f64::consts::TAU;
use std::mem::discriminant;

use hyperbody_math::{Bivector, Rotation, Vector, planes};

use super::{JointDef, Motor, Spring};

/// In place of a body's slot: the world.
pub(crate) const WORLD: u32 = u32::MAX;

/// What a row measures of the second frame against the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coordinate {
    /// Translation along an axis of the world: for joints that lock all of them, which axes does not matter.
    Point(u8),
    /// Translation along an axis of the first frame.
    Slide(u8),
    /// How far a locked plane is off.
    Turn(u8, u8),
    /// The angle of a free plane.
    Angle(u8, u8),
    /// The angle from an axis of the first frame to the same of the second.
    Swing(u8),
    /// The distance of the anchors.
    Length,
    /// What the coupling of the joint holds, m.
    Coupled,
}

/// What becomes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Role {
    /// Held at a value, together with all others that are held.
    Held(f64),
    AtLeast(f64),
    AtMost(f64),
    Driven(Motor),
    Sprung(Spring),
    /// Drawn to the target of a spring from one side of it alone.
    Elastic(Spring, Bound),
}

impl Role {
    /// Whether it drives its coordinate, and may drive it against limits.
    pub(crate) fn drives(&self) -> bool {
        matches!(self, Self::Driven(_) | Self::Sprung(_))
    }
}

/// Which end of what is allowed a bound is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bound {
    Least,
    Greatest,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RowSpec {
    pub(crate) coordinate: Coordinate,
    pub(crate) role: Role,
    /// Angles count from half a turn below this to half a turn above, rad: what lies beyond limits is beyond the nearer one.
    pub(crate) middle: f64,
}

impl RowSpec {
    pub(crate) const fn new(coordinate: Coordinate, role: Role) -> Self {
        Self { coordinate, role, middle: 0.0 }
    }
}

/// A joint as the world keeps it.
#[derive(Clone, Debug)]
pub(crate) struct Joint<const N: usize> {
    pub(crate) def: JointDef<N>,
    /// Slots of the bodies; [`WORLD`] for the first of joints with the world.
    pub(crate) body_a: u32,
    pub(crate) body_b: u32,
    /// Anchors relative to the centres of mass, body frames; the first in the world for joints with the world.
    pub(crate) arm_a: Vector<N>,
    pub(crate) arm_b: Vector<N>,
    /// Rows, those that are held first.
    pub(crate) rows: Vec<RowSpec>,
    pub(crate) held: usize,
    /// Whether it holds a point on a point, rigidly, and nothing else.
    pub(crate) plain: bool,
    /// Group of each axis: planes within one are free.
    pub(crate) groups: [u8; N],
    /// Impulses of each row in the last substep, before and after positions moved: they warm-start the next.
    pub(crate) impulses: Vec<[f64; 2]>,
    /// Impulse on `b` over the last step, world axes, N·s, and its turning part about the anchor, N·m·s.
    pub(crate) step_impulse: Vector<N>,
    pub(crate) step_twist: Bivector<N>,
}

impl<const N: usize> Joint<N> {
    /// From a valid definition. Centres of mass in the frames of the bodies.
    pub(crate) fn new(
        def: JointDef<N>,
        groups: [u8; N],
        (body_a, centre_a): (u32, Vector<N>),
        (body_b, centre_b): (u32, Vector<N>),
    ) -> Self {
        let mut rows = held_rows(&def);
        let held = rows.len();
        rows.extend(other_rows(&def));
        let point = |row: &RowSpec| matches!((row.coordinate, row.role), (Coordinate::Point(_), Role::Held(_)));
        Self {
            plain: def.softness.is_none() && rows.len() == N && rows.iter().all(point),
            body_a,
            body_b,
            arm_a: def.frame_a.translation - centre_a,
            arm_b: def.frame_b.translation - centre_b,
            impulses: vec![[0.0; 2]; rows.len()],
            rows,
            held,
            groups,
            step_impulse: Vector::ZERO,
            step_twist: Bivector::ZERO,
            def,
        }
    }

    /// Starts from the impulses of what it was, where a row does the same as one did.
    pub(crate) fn go_on_from(&mut self, old: &Self) {
        (self.step_impulse, self.step_twist) = (old.step_impulse, old.step_twist);
        if self.def.coupling != old.def.coupling || self.groups != old.groups {
            return;
        }
        for (row, impulses) in self.rows.iter().zip(&mut self.impulses) {
            let same = |other: &RowSpec| {
                row.coordinate == other.coordinate && discriminant(&row.role) == discriminant(&other.role)
            };
            if let Some(index) = old.rows.iter().position(same) {
                *impulses = old.impulses[index];
            }
        }
    }

    /// Forgets what it bore.
    pub(crate) fn let_go(&mut self) {
        self.impulses.fill([0.0; 2]);
        (self.step_impulse, self.step_twist) = (Vector::ZERO, Bivector::ZERO);
    }

    /// Attitudes of the frames on their bodies.
    pub(crate) fn frames(&self) -> (Rotation<N>, Rotation<N>) {
        (self.def.frame_a.rotation, self.def.frame_b.rotation)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "axes are fewer than seven")]
fn held_rows<const N: usize>(def: &JointDef<N>) -> Vec<RowSpec> {
    let all = def.axes.iter().all(|axis| axis.locked);
    let mut rows = Vec::new();
    let mut hold = |coordinate, value| rows.push(RowSpec::new(coordinate, Role::Held(value)));
    for axis in (0..N).filter(|&axis| def.axes[axis].locked) {
        hold(if all { Coordinate::Point(axis as u8) } else { Coordinate::Slide(axis as u8) }, 0.0);
    }
    for (k, (i, j)) in planes::all(N).enumerate() {
        if def.planes[k].locked {
            hold(Coordinate::Turn(i as u8, j as u8), 0.0);
        }
    }
    if let Some((least, greatest)) = def.distance
        && least >= greatest
    {
        hold(Coordinate::Length, least);
    }
    if def.coupling.is_some() {
        hold(Coordinate::Coupled, 0.0);
    }
    rows
}

#[expect(clippy::cast_possible_truncation, reason = "axes are fewer than seven")]
fn other_rows<const N: usize>(def: &JointDef<N>) -> Vec<RowSpec> {
    let axes = def.axes.iter().enumerate().map(|(axis, freedom)| (Coordinate::Slide(axis as u8), freedom));
    let planes =
        planes::all(N).zip(&def.planes).map(|((i, j), freedom)| (Coordinate::Angle(i as u8, j as u8), freedom));
    let mut rows = Vec::new();
    for (coordinate, freedom) in axes.chain(planes) {
        let angle = matches!(coordinate, Coordinate::Angle(..));
        let mut add = |role, middle| rows.push(RowSpec { coordinate, role, middle });
        freedom.spring.into_iter().for_each(|spring| add(Role::Sprung(spring), spring.target));
        freedom.motor.into_iter().for_each(|motor| add(Role::Driven(motor), 0.0));
        if let Some((low, high)) = freedom.limits.filter(|(low, high)| !angle || high - low < WHOLE_TURN) {
            add(Role::AtLeast(low), 0.5 * (low + high));
            add(Role::AtMost(high), 0.5 * (low + high));
        }
    }
    if let Some((axis, angle)) = def.cone {
        rows.push(RowSpec::new(Coordinate::Swing(axis), Role::AtMost(angle)));
    }
    rows.extend(
        def.distance.filter(|(least, greatest)| least < greatest).into_iter().flat_map(|range| bounds(def, range)),
    );
    rows
}

/// Limits of an angle that are farther apart, rad, limit nothing.
const WHOLE_TURN: f64 = TAU * (1.0 - 1e-9);

/// The least and the greatest distance.
fn bounds<const N: usize>(def: &JointDef<N>, (least, greatest): (f64, f64)) -> impl Iterator<Item = RowSpec> {
    let ends = [(least, Bound::Least, least > 0.0), (greatest, Bound::Greatest, greatest.is_finite())];
    let (softness, max_force) = (def.softness, def.max_force);
    ends.into_iter().filter(|(.., binds)| *binds).map(move |(target, bound, _)| {
        let role = match (softness, bound) {
            (Some((hz, damping_ratio)), bound) => Role::Elastic(Spring { target, hz, damping_ratio, max_force }, bound),
            (None, Bound::Least) => Role::AtLeast(target),
            (None, Bound::Greatest) => Role::AtMost(target),
        };
        RowSpec::new(Coordinate::Length, role)
    })
}
