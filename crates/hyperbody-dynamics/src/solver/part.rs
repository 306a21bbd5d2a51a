//! Numbers of as many contacts as one register holds in double precision.
//!
//! What is long, and done once a step, is done for one part of the lanes after the other: on eight at once its code would be twice as
//! long with vector instructions, eight times without, and have too few registers.

use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

use super::lanes::{DoubleLanes, Lanes};
use super::machine::Machine;

/// Which lanes, on which machine.
#[derive(Clone, Copy)]
pub(crate) struct Place<M: Machine> {
    machine: M,
    part: usize,
}

/// Lanes in a register of a machine.
#[derive(Clone, Copy)]
pub(crate) struct Part<M: Machine> {
    vector: M::Part,
    place: Place<M>,
}

impl<M: Machine> Place<M> {
    /// All lanes, part by part.
    #[inline(always)]
    pub(crate) fn all(machine: M) -> impl Iterator<Item = Self> {
        (0..M::PARTS).map(move |part| Self { machine, part })
    }

    #[inline(always)]
    pub(crate) fn splat(self, value: f64) -> Part<M> {
        Part { vector: self.machine.splat_part(value), place: self }
    }

    #[inline(always)]
    pub(crate) fn zero(self) -> Part<M> {
        self.splat(0.0)
    }
}

impl DoubleLanes {
    /// In a register.
    #[inline(always)]
    pub(crate) fn at<M: Machine>(&self, place: Place<M>) -> Part<M> {
        Part { vector: place.machine.load_part(self, place.part), place }
    }
}

impl<M: Machine> Part<M> {
    #[inline(always)]
    pub(crate) fn place(self) -> Place<M> {
        self.place
    }

    #[inline(always)]
    fn with(self, vector: M::Part) -> Self {
        Self { vector, ..self }
    }

    /// In single precision, into its lanes.
    #[inline(always)]
    pub(crate) fn store(self, lanes: &mut Lanes) {
        self.place.machine.store_part(self.vector, lanes, self.place.part);
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.place.machine.max_part(self.vector, other.vector))
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.max(self.place.zero() - self)
    }

    /// 1 over it where it is > 0, else 0.
    #[inline(always)]
    pub(crate) fn inverse_or_zero(self) -> Self {
        self.with(self.place.machine.inverse_or_zero_part(self.vector))
    }

    /// Lane by lane: `positive` where `self` > 0, else `otherwise`.
    #[inline(always)]
    pub(crate) fn select_positive(self, positive: Self, otherwise: Self) -> Self {
        self.with(self.place.machine.select_positive_part(self.vector, positive.vector, otherwise.vector))
    }
}

impl<M: Machine> Add for Part<M> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.place.machine.add_part(self.vector, other.vector))
    }
}

impl<M: Machine> Sub for Part<M> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.place.machine.sub_part(self.vector, other.vector))
    }
}

impl<M: Machine> Mul for Part<M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.place.machine.mul_part(self.vector, other.vector))
    }
}

impl<M: Machine> AddAssign for Part<M> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<M: Machine> SubAssign for Part<M> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
