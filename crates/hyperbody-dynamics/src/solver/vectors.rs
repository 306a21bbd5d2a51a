//! Vectors and bivectors of several contacts side by side, in registers.
//!
//! Lane by lane they do what those of [`hyperbody_math`] do, in the same order, so that bits are the same; only zeros of a bivector's
//! diagonal are not multiplied.

use std::ops::{Add, Mul, Sub};

use super::bodies::{PlaneNumbers, Sizes};
use super::lanes::{DoubleLanes, Lanes};
use super::machine::Machine;
use super::part::{Part, Place};

/// A vector of each contact.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<const N: usize, M: Machine>(pub(crate) [Part<M>; N]);

/// A bivector of each contact, by planes.
#[derive(Clone, Copy)]
pub(crate) struct Bivectors<const N: usize, M: Machine>(PlaneNumbers<N, Part<M>>);

impl<const N: usize, M: Machine> Vectors<N, M> {
    #[inline(always)]
    pub(crate) fn zero(place: Place<M>) -> Self {
        Self([place.zero(); N])
    }

    /// From memory.
    #[inline(always)]
    pub(crate) fn load(place: Place<M>, lanes: &[DoubleLanes; N]) -> Self {
        let mut vectors = Self::zero(place);
        for i in 0..N {
            vectors.0[i] = lanes[i].at(place);
        }
        vectors
    }

    /// In single precision, into the first rows.
    #[inline(always)]
    pub(crate) fn store(&self, rows: &mut [Lanes]) {
        for (row, value) in rows[..N].iter_mut().zip(&self.0) {
            value.store(row);
        }
    }

    #[inline(always)]
    fn place(&self) -> Place<M> {
        self.0[0].place()
    }

    #[inline(always)]
    pub(crate) fn dot(&self, other: &Self) -> Part<M> {
        let mut sum = self.place().zero();
        for i in 0..N {
            sum += self.0[i] * other.0[i];
        }
        sum
    }

    /// In the frames with these axes, which are rows by the axes of this one.
    #[inline(always)]
    pub(crate) fn in_frame(&self, axes: &[[DoubleLanes; N]; N]) -> Self {
        let place = self.place();
        let mut seen = Self::zero(place);
        for (value, row) in self.0.iter().zip(axes) {
            for (seen, number) in seen.0.iter_mut().zip(row) {
                *seen += number.at(place) * *value;
            }
        }
        seen
    }

    /// [`hyperbody_math::Vector::orthonormal_complement`].
    #[inline(always)]
    pub(crate) fn orthonormal_complement(&self) -> [Self; N] {
        let place = self.place();
        let (zero, one) = (place.zero(), place.splat(1.0));
        let (mut axis, mut component, mut largest) = (zero, self.0[0], self.0[0].abs());
        for i in 1..N {
            let size = self.0[i].abs();
            let longer = size - largest;
            axis = longer.select_positive(place.splat(i as f64), axis);
            component = longer.select_positive(self.0[i], component);
            largest = size.max(largest);
        }
        let sign = (zero - component).select_positive(zero - one, one);
        let mut u = *self;
        for i in 0..N {
            let off = axis - place.splat(i as f64);
            u.0[i] = (off * off).select_positive(u.0[i], u.0[i] + sign);
        }
        let inverse = u.dot(&u).inverse_or_zero();
        let factor = inverse + inverse;
        let mut basis = [Self::zero(place); N];
        for slot in 0..N - 1 {
            let is_before = axis - place.splat(slot as f64);
            let along = factor * is_before.select_positive(u.0[slot], u.0[slot + 1]);
            for i in 0..N {
                let unit = if i == slot {
                    is_before.select_positive(one, zero)
                } else if i == slot + 1 {
                    is_before.select_positive(zero, one)
                } else {
                    zero
                };
                basis[slot].0[i] = unit - u.0[i] * along;
            }
        }
        basis
    }
}

impl<const N: usize, M: Machine> Bivectors<N, M> {
    #[inline(always)]
    pub(crate) fn zero(place: Place<M>) -> Self {
        Self(PlaneNumbers::splat(place.zero()))
    }

    /// From memory.
    #[inline(always)]
    pub(crate) fn load(place: Place<M>, lanes: &PlaneNumbers<N, DoubleLanes>) -> Self {
        let mut planes = Self::zero(place);
        for k in 0..Sizes::<N>::K {
            planes.0[k] = lanes[k].at(place);
        }
        planes
    }

    /// From memory, if it is there.
    #[inline(always)]
    pub(crate) fn load_or_zero(place: Place<M>, lanes: Option<&PlaneNumbers<N, DoubleLanes>>) -> Self {
        match lanes {
            Some(lanes) => Self::load(place, lanes),
            None => Self::zero(place),
        }
    }

    #[inline(always)]
    pub(crate) fn wedge(a: &Vectors<N, M>, b: &Vectors<N, M>) -> Self {
        let mut wedge = Self::zero(a.place());
        let mut k = 0;
        for i in 0..N {
            for j in i + 1..N {
                wedge.0[k] = a.0[i] * b.0[j] - a.0[j] * b.0[i];
                k += 1;
            }
        }
        wedge
    }

    #[inline(always)]
    pub(crate) fn dot(&self, other: &Self) -> Part<M> {
        let mut sum = self.0[0].place().zero();
        for k in 0..Sizes::<N>::K {
            sum += self.0[k] * other.0[k];
        }
        sum
    }

    /// The contraction with a vector: of an angular velocity, how a point at that offset moves.
    #[inline(always)]
    pub(crate) fn act_on(&self, r: &Vectors<N, M>) -> Vectors<N, M> {
        let mut result = Vectors::zero(r.place());
        let mut k = 0;
        for i in 0..N {
            for j in i + 1..N {
                result.0[j] += self.0[k] * r.0[i];
                result.0[i] -= self.0[k] * r.0[j];
                k += 1;
            }
        }
        result
    }

    /// Times a number a plane, in single precision, into the first rows.
    #[inline(always)]
    pub(crate) fn store_scaled(&self, scales: &PlaneNumbers<N, DoubleLanes>, rows: &mut [Lanes]) {
        let rows = &mut rows[..Sizes::<N>::K];
        for k in 0..Sizes::<N>::K {
            (self.0[k] * scales[k].at(self.0[k].place())).store(&mut rows[k]);
        }
    }
}

impl<const N: usize, M: Machine> Add for Vectors<N, M> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for i in 0..N {
            self.0[i] += other.0[i];
        }
        self
    }
}

impl<const N: usize, M: Machine> Sub for Vectors<N, M> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for i in 0..N {
            self.0[i] -= other.0[i];
        }
        self
    }
}

impl<const N: usize, M: Machine> Mul<Part<M>> for Vectors<N, M> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, factor: Part<M>) -> Self {
        for i in 0..N {
            self.0[i] = self.0[i] * factor;
        }
        self
    }
}

impl<const N: usize, M: Machine> Sub for Bivectors<N, M> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for k in 0..Sizes::<N>::K {
            self.0[k] -= other.0[k];
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use hyperbody_math::{Bivector, Vector};

    use super::*;
    use crate::solver::lanes::WIDTH;
    use crate::solver::machine::{Pass, Plain, Processor};

    struct Everything<'a, const N: usize> {
        units: &'a [Vector<N>; WIDTH],
        others: &'a [Vector<N>; WIDTH],
    }

    fn side_by_side<const N: usize>(vectors: &[Vector<N>; WIDTH]) -> [DoubleLanes; N] {
        std::array::from_fn(|i| DoubleLanes(vectors.map(|vector| vector[i])))
    }

    fn assert_same<const N: usize, M: Machine>(found: &Vectors<N, M>, expected: impl Fn(usize) -> Vector<N>) {
        let expected = Vectors::load(found.place(), &side_by_side(&std::array::from_fn(expected)));
        let mut difference = [Lanes::ZERO; N];
        (*found - expected).store(&mut difference);
        assert_eq!(difference, [Lanes::ZERO; N], "in {N}D");
    }

    impl<const N: usize> Pass for Everything<'_, N> {
        #[inline(always)]
        fn run<M: Machine>(self, machine: M) {
            let Self { units, others } = self;
            let plane = |lane: usize| Bivector::wedge(units[lane], others[lane]);
            for place in Place::all(machine) {
                let u = Vectors::load(place, &side_by_side(units));
                let v = Vectors::load(place, &side_by_side(others));
                for (slot, tangent) in u.orthonormal_complement().iter().enumerate() {
                    assert_same(tangent, |lane| units[lane].orthonormal_complement()[slot]);
                }
                let (wedge, sum) = (Bivectors::wedge(&u, &v), u + v);
                assert_same(&wedge.act_on(&sum), |lane| plane(lane).act_on(units[lane] + others[lane]));
                assert_same(&(u * v.dot(&u)), |lane| units[lane] * others[lane].dot(units[lane]));
                assert_same(&(v * wedge.dot(&wedge)), |lane| others[lane] * plane(lane).dot(&plane(lane)));
            }
        }
    }

    fn check<const N: usize>() {
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64) / ((1_u64 << 53) as f64) * 2.0 - 1.0
        };
        for trial in 0..20 {
            let mut units: [Vector<N>; WIDTH] =
                std::array::from_fn(|_| Vector::from_fn(|_| random()).normalize_or_zero());
            // Axes, and components of equal size.
            units[trial % WIDTH] = Vector::unit(trial % N);
            units[(trial + 1) % WIDTH] = -Vector::unit((trial + 1) % N);
            units[(trial + 2) % WIDTH] =
                Vector::from_fn(|i| if i == trial % N { -1.0 } else { 1.0 }).normalize_or_zero();
            let others = std::array::from_fn(|_| Vector::from_fn(|_| random()));
            Processor::of_this_machine().run(Everything { units: &units, others: &others });
            Everything { units: &units, others: &others }.run(Plain);
        }
    }

    #[test]
    fn lanes_do_what_vectors_do() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }
}
