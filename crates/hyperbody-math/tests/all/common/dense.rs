//! The oracle: multivectors with all 2^N coefficients and the geometric product by its definition. A basis blade is the
//! list of its axes; a product of two blades joins the lists, sorts them by swaps of neighbours (each swap a sign, as
//! e_i e_j = −e_j e_i) and drops equal neighbours (e_i e_i = 1).

use std::ops::{Add, Mul, Sub};

use hyperbody_math::{Bivector, Vector, planes};

/// Coefficient of the blade whose axes are the bits that are set in the index.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense<const N: usize>(pub Vec<f64>);

fn axes(blade: usize) -> Vec<usize> {
    (0..usize::BITS as usize).filter(|axis| blade & (1 << axis) != 0).collect()
}

fn blade_product(a: usize, b: usize) -> (f64, usize) {
    let mut list = axes(a);
    list.extend(axes(b));
    let mut sign = 1.0;
    // Bubble sort.
    for end in (1..list.len()).rev() {
        for k in 0..end {
            if list[k] > list[k + 1] {
                list.swap(k, k + 1);
                sign = -sign;
            }
        }
    }
    let mut blade = 0;
    let mut k = 0;
    while k < list.len() {
        if k + 1 < list.len() && list[k] == list[k + 1] {
            k += 2;
        } else {
            blade |= 1 << list[k];
            k += 1;
        }
    }
    (sign, blade)
}

impl<const N: usize> Dense<N> {
    pub fn zero() -> Self {
        Self(vec![0.0; 1 << N])
    }

    pub fn scalar(value: f64) -> Self {
        let mut m = Self::zero();
        m.0[0] = value;
        m
    }

    pub fn vector(v: Vector<N>) -> Self {
        let mut m = Self::zero();
        for axis in 0..N {
            m.0[1 << axis] = v[axis];
        }
        m
    }

    pub fn bivector(b: &Bivector<N>) -> Self {
        let mut m = Self::zero();
        for (i, j) in planes::all(N) {
            m.0[1 << i | 1 << j] = b.get(i, j);
        }
        m
    }

    /// The even multivector with coefficients by grade, and within a grade in lexicographic order of the axis lists.
    pub fn even(coefficients: &[f64]) -> Self {
        let mut blades: Vec<usize> = (0..1 << N).filter(|blade: &usize| blade.count_ones().is_multiple_of(2)).collect();
        blades.sort_by_key(|&blade| (blade.count_ones(), axes(blade)));
        assert_eq!(blades.len(), coefficients.len());
        let mut m = Self::zero();
        for (blade, &value) in blades.into_iter().zip(coefficients) {
            m.0[blade] = value;
        }
        m
    }

    pub fn to_vector(&self) -> Vector<N> {
        Vector::from_fn(|axis| self.0[1 << axis])
    }

    pub fn to_bivector(&self) -> Bivector<N> {
        let values: Vec<f64> = planes::all(N).map(|(i, j)| self.0[1 << i | 1 << j]).collect();
        Bivector::from_planes(&values).expect("as many numbers as planes")
    }

    pub fn grade(&self, grade: u32) -> Self {
        let keep = |(blade, &value): (usize, &f64)| if blade.count_ones() == grade { value } else { 0.0 };
        Self(self.0.iter().enumerate().map(keep).collect())
    }

    /// Products of vectors in reverse order: the sign of a k-vector is (−1)^(k(k−1)/2).
    pub fn reverse(&self) -> Self {
        let flip = |(blade, &value): (usize, &f64)| {
            let k = usize::try_from(blade.count_ones()).expect("at most six");
            if k * k.saturating_sub(1) / 2 % 2 == 0 { value } else { -value }
        };
        Self(self.0.iter().enumerate().map(flip).collect())
    }

    pub fn max_abs(&self) -> f64 {
        self.0.iter().fold(0.0, |largest, c| if c.is_nan() || c.abs() > largest { c.abs() } else { largest })
    }

    /// The exponential by its power series, after halving the argument until the series converges fast.
    pub fn exp(&self) -> Self {
        let mut halvings = 0;
        let mut factor = 1.0;
        while self.max_abs() * factor * 16.0 > 1.0 {
            factor *= 0.5;
            halvings += 1;
        }
        let argument = self * factor;
        let mut term = Self::scalar(1.0);
        let mut sum = Self::scalar(1.0);
        for k in 1..=40 {
            term = &(&term * &argument) * (1.0 / f64::from(k));
            sum = &sum + &term;
        }
        for _ in 0..halvings {
            sum = &sum * &sum;
        }
        sum
    }
}

impl<const N: usize> Mul for &Dense<N> {
    type Output = Dense<N>;
    fn mul(self, other: Self) -> Dense<N> {
        let mut product = Dense::zero();
        for a in (0..1 << N).filter(|&a| self.0[a] != 0.0) {
            for b in (0..1 << N).filter(|&b| other.0[b] != 0.0) {
                let (sign, blade) = blade_product(a, b);
                product.0[blade] += sign * self.0[a] * other.0[b];
            }
        }
        product
    }
}

impl<const N: usize> Mul<f64> for &Dense<N> {
    type Output = Dense<N>;
    fn mul(self, factor: f64) -> Dense<N> {
        Dense(self.0.iter().map(|c| c * factor).collect())
    }
}

impl<const N: usize> Add for &Dense<N> {
    type Output = Dense<N>;
    fn add(self, other: Self) -> Dense<N> {
        Dense(self.0.iter().zip(&other.0).map(|(a, b)| a + b).collect())
    }
}

impl<const N: usize> Sub for &Dense<N> {
    type Output = Dense<N>;
    fn sub(self, other: Self) -> Dense<N> {
        Dense(self.0.iter().zip(&other.0).map(|(a, b)| a - b).collect())
    }
}
