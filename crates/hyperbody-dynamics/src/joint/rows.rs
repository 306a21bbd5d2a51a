//! A joint as the world keeps it: its definition taken apart into scalar rows.

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
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RowSpec {
    pub(crate) coordinate: Coordinate,
    pub(crate) role: Role,
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
        Self {
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

    /// Attitudes of the frames on their bodies.
    pub(crate) fn frames(&self) -> (Rotation<N>, Rotation<N>) {
        (self.def.frame_a.rotation, self.def.frame_b.rotation)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "axes are fewer than seven")]
fn held_rows<const N: usize>(def: &JointDef<N>) -> Vec<RowSpec> {
    let all = def.axes.iter().all(|axis| axis.locked);
    let mut rows = Vec::new();
    let mut hold = |coordinate, value| rows.push(RowSpec { coordinate, role: Role::Held(value) });
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
        let mut add = |role| rows.push(RowSpec { coordinate, role });
        freedom.spring.into_iter().for_each(|spring| add(Role::Sprung(spring)));
        freedom.motor.into_iter().for_each(|motor| add(Role::Driven(motor)));
        if let Some((low, high)) = freedom.limits {
            add(Role::AtLeast(low));
            add(Role::AtMost(high));
        }
    }
    if let Some((least, greatest)) = def.distance.filter(|(least, greatest)| least < greatest) {
        if least > 0.0 {
            rows.push(RowSpec { coordinate: Coordinate::Length, role: Role::AtLeast(least) });
        }
        if greatest.is_finite() {
            rows.push(RowSpec { coordinate: Coordinate::Length, role: Role::AtMost(greatest) });
        }
    }
    rows
}
