//! Seeded random numbers and points that several tests share.

#![allow(dead_code, unreachable_pub, reason = "each test file uses some of these")]

use hyperbody_math::{Bivector, Rotation, Vector, planes};

/// SplitMix64 (Steele, Lea, Flood, 2014).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    /// Uniform in [−1, 1).
    pub fn symmetric(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        0.5 * (self.symmetric() + 1.0)
    }

    /// Uniform in the cube [−1, 1)^N.
    pub fn vector<const N: usize>(&mut self) -> Vector<N> {
        Vector::from_fn(|_| self.symmetric())
    }

    /// Uniform on the unit sphere.
    pub fn direction<const N: usize>(&mut self) -> Vector<N> {
        loop {
            let v: Vector<N> = self.vector();
            if (0.01..1.0).contains(&v.norm_sq()) {
                return v.normalize_or_zero();
            }
        }
    }

    pub fn rotation<const N: usize>(&mut self) -> Rotation<N> {
        let mut b = Bivector::ZERO;
        for (i, j) in planes::all(N) {
            b += Bivector::wedge(Vector::unit(i), Vector::unit(j)) * (3.0 * self.symmetric());
        }
        Rotation::exp(&b)
    }

    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }

    pub fn points<const N: usize>(&mut self, count: usize) -> Vec<Vector<N>> {
        (0..count).map(|_| self.vector()).collect()
    }

    pub fn sphere_points<const N: usize>(&mut self, count: usize) -> Vec<Vector<N>> {
        (0..count).map(|_| self.direction()).collect()
    }
}

/// All points with coordinates 0, 1, …, side − 1.
pub fn grid<const N: usize>(side: usize) -> Vec<Vector<N>> {
    (0..side.pow(N as u32)).map(|k| Vector::from_fn(|i| (k / side.pow(i as u32) % side) as f64)).collect()
}

/// Corners of the cube [−1, 1]^N.
pub fn cube<const N: usize>() -> Vec<Vector<N>> {
    grid(2).into_iter().map(|p| p * 2.0 - Vector::splat(1.0)).collect()
}

/// ±1 on each axis.
pub fn cross_polytope<const N: usize>() -> Vec<Vector<N>> {
    (0..2 * N).map(|i| Vector::unit(i / 2) * if i % 2 == 0 { 1.0 } else { -1.0 }).collect()
}

/// vol{x in [0, 1]^N : a·x = c} for unit a > 0, as the (N−1)-th difference of a truncated power (G. Pólya, 1913).
pub fn slab_of_cube<const N: usize>(a: Vector<N>, c: f64) -> f64 {
    let mut sum = 0.0;
    for corner in 0..1_u32 << N {
        let reach: f64 = (0..N).filter(|axis| corner >> axis & 1 == 1).map(|axis| a[axis]).sum();
        let sign = if corner.count_ones() % 2 == 0 { 1.0 } else { -1.0 };
        sum += sign * f64::max(c - reach, 0.0).powi(N as i32 - 1);
    }
    let factorial: f64 = (1..N).map(|k| k as f64).product();
    sum / (factorial * a.iter().product::<f64>())
}
