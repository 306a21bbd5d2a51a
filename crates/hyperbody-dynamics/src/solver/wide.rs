//! Arithmetic on lanes: one number of several contacts, in registers.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::lanes::{Lanes, Real, WIDTH};
use super::machine::Machine;

/// Lanes in registers of a machine.
#[derive(Clone, Copy)]
pub(crate) struct Wide<M: Machine> {
    vector: M::Vector,
    machine: M,
}

impl Lanes {
    /// In registers.
    #[inline(always)]
    pub(crate) fn on<M: Machine>(self, machine: M) -> Wide<M> {
        Wide { vector: machine.load(self), machine }
    }
}

impl<M: Machine> Wide<M> {
    #[inline(always)]
    pub(crate) fn splat(machine: M, value: Real) -> Self {
        Self { vector: machine.splat(value), machine }
    }

    #[inline(always)]
    pub(crate) fn zero(machine: M) -> Self {
        Self::splat(machine, 0.0)
    }

    #[inline(always)]
    pub(crate) fn machine(self) -> M {
        self.machine
    }

    /// As they stand in memory.
    #[inline(always)]
    pub(crate) fn lanes(self) -> Lanes {
        self.machine.store(self.vector)
    }

    #[inline(always)]
    fn with(self, vector: M::Vector) -> Self {
        Self { vector, ..self }
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.machine.max(self.vector, other.vector))
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(self.machine.min(self.vector, other.vector))
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self.machine.sqrt(self.vector))
    }

    #[inline(always)]
    pub(crate) fn div(self, other: Self) -> Self {
        self.with(self.machine.div(self.vector, other.vector))
    }

    /// In double precision.
    #[inline(always)]
    pub(crate) fn doubles(self) -> Doubles<M> {
        Doubles { vectors: self.machine.widen(self.vector), machine: self.machine }
    }

    /// Lane by lane: `positive` where `self` > 0, else `otherwise`.
    #[inline(always)]
    pub(crate) fn select_positive(self, positive: Self, otherwise: Self) -> Self {
        self.with(self.machine.select_positive(self.vector, positive.vector, otherwise.vector))
    }

    #[inline(always)]
    pub(crate) fn all_positive(self) -> bool {
        self.machine.all_positive(self.vector)
    }
}

/// Of eight rows of numbers, lane i of vector j becomes lane j of vector i.
#[inline(always)]
pub(crate) fn transpose<M: Machine>(machine: M, rows: &[Wide<M>; WIDTH]) -> [Wide<M>; WIDTH] {
    let mut vectors = [rows[0].vector; WIDTH];
    for (vector, row) in vectors.iter_mut().zip(rows) {
        *vector = row.vector;
    }
    let columns = machine.transpose(vectors);
    let mut result = *rows;
    for (result, vector) in result.iter_mut().zip(columns) {
        result.vector = vector;
    }
    result
}

/// See [`Machine::transpose_halves`].
#[inline(always)]
pub(crate) fn transpose_halves<M: Machine>(machine: M, rows: &[Wide<M>; WIDTH / 2]) -> [Wide<M>; WIDTH / 2] {
    let mut vectors = [rows[0].vector; WIDTH / 2];
    for (vector, row) in vectors.iter_mut().zip(rows) {
        *vector = row.vector;
    }
    let columns = machine.transpose_halves(vectors);
    let mut result = *rows;
    for (result, vector) in result.iter_mut().zip(columns) {
        result.vector = vector;
    }
    result
}

impl<M: Machine> Add for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.machine.add(self.vector, other.vector))
    }
}

impl<M: Machine> Sub for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.machine.sub(self.vector, other.vector))
    }
}

impl<M: Machine> Mul for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.machine.mul(self.vector, other.vector))
    }
}

impl<M: Machine> Neg for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.machine.neg(self.vector))
    }
}

impl<M: Machine> AddAssign for Wide<M> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<M: Machine> SubAssign for Wide<M> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// Lanes in registers, in double precision.
#[derive(Clone, Copy)]
pub(crate) struct Doubles<M: Machine> {
    vectors: M::Doubles,
    machine: M,
}

impl<M: Machine> Doubles<M> {
    #[inline(always)]
    pub(crate) fn of(machine: M, values: [f64; WIDTH]) -> Self {
        Self { vectors: machine.load_doubles(values), machine }
    }

    #[inline(always)]
    pub(crate) fn splat(machine: M, value: Real) -> Self {
        Wide::splat(machine, value).doubles()
    }

    /// As they stand in memory.
    #[inline(always)]
    pub(crate) fn values(self) -> [f64; WIDTH] {
        self.machine.store_doubles(self.vectors)
    }

    #[inline(always)]
    pub(crate) fn zero(machine: M) -> Self {
        Self::splat(machine, 0.0)
    }

    #[inline(always)]
    pub(crate) fn machine(self) -> M {
        self.machine
    }

    #[inline(always)]
    fn with(self, vectors: M::Doubles) -> Self {
        Self { vectors, ..self }
    }

    /// In single precision, as they stand in memory.
    #[inline(always)]
    pub(crate) fn lanes(self) -> Lanes {
        self.machine.store(self.machine.narrow(self.vectors))
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.machine.max_doubles(self.vectors, other.vectors))
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self.machine.sqrt_doubles(self.vectors))
    }

    /// 1 over it where it is > 0, else 0.
    #[inline(always)]
    pub(crate) fn inverse_or_zero(self) -> Self {
        self.with(self.machine.inverse_or_zero(self.vectors))
    }
}

impl<M: Machine> Add for Doubles<M> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.machine.add_doubles(self.vectors, other.vectors))
    }
}

impl<M: Machine> Sub for Doubles<M> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.machine.sub_doubles(self.vectors, other.vectors))
    }
}

impl<M: Machine> Mul for Doubles<M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.machine.mul_doubles(self.vectors, other.vectors))
    }
}

impl<M: Machine> AddAssign for Doubles<M> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<M: Machine> SubAssign for Doubles<M> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

// Operands that stand in memory.

impl<M: Machine> Add<Lanes> for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Lanes) -> Self {
        self + other.on(self.machine)
    }
}

impl<M: Machine> Sub<Lanes> for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Lanes) -> Self {
        self - other.on(self.machine)
    }
}

impl<M: Machine> Mul<Lanes> for Wide<M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Lanes) -> Self {
        self * other.on(self.machine)
    }
}

impl<M: Machine> AddAssign<Lanes> for Wide<M> {
    #[inline(always)]
    fn add_assign(&mut self, other: Lanes) {
        *self = *self + other;
    }
}
