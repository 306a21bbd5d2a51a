//! The vector instructions of a processor: passes over contacts are compiled for each kind and chosen at run time.
//!
//! Lane by lane all kinds do the same IEEE operations, none of them fused, so the bits of results do not depend on the machine.

use super::lanes::{Lanes, Real, WIDTH};

/// A kind of processor: a token that its instructions are there.
pub(crate) trait Machine: Copy {
    /// [`WIDTH`] numbers in registers.
    type Vector: Copy;

    fn load(self, lanes: Lanes) -> Self::Vector;
    fn store(self, vector: Self::Vector) -> Lanes;
    fn splat(self, value: Real) -> Self::Vector;
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn div(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn sqrt(self, a: Self::Vector) -> Self::Vector;
    /// a where a > b, else b.
    fn max(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// a where a < b, else b.
    fn min(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn neg(self, a: Self::Vector) -> Self::Vector;
    /// `positive` where `of` > 0, else `otherwise`.
    fn select_positive(self, of: Self::Vector, positive: Self::Vector, otherwise: Self::Vector) -> Self::Vector;
    /// Whether every lane is > 0.
    fn all_positive(self, a: Self::Vector) -> bool;
    /// Lane i of vector j becomes lane j of vector i.
    fn transpose(self, rows: [Self::Vector; WIDTH]) -> [Self::Vector; WIDTH];
}

/// Work that is compiled anew for every kind. `run` and all that it calls must be `#[inline(always)]`: a function of its
/// own (the body of a closure is one) is compiled once, without the instructions.
pub(crate) trait Pass {
    fn run<M: Machine>(self, machine: M);
}

/// What this machine has; found once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Processor {
    #[cfg(target_arch = "x86_64")]
    avx: Option<avx::Avx>,
}

impl Processor {
    pub(crate) fn of_this_machine() -> Self {
        Self {
            #[cfg(target_arch = "x86_64")]
            avx: avx::Avx::of_this_machine(),
        }
    }

    /// Runs `pass` with the widest instructions there are.
    #[inline]
    pub(crate) fn run(self, pass: impl Pass) {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx) = self.avx {
            return avx.run(pass);
        }
        pass.run(Plain);
    }
}

/// Any processor: plain loops, which the compiler makes into what vector instructions the target always has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plain;

#[inline(always)]
fn zip(a: Lanes, b: Lanes, f: impl Fn(Real, Real) -> Real) -> Lanes {
    let mut result = [0.0; WIDTH];
    for lane in 0..WIDTH {
        result[lane] = f(a.0[lane], b.0[lane]);
    }
    Lanes(result)
}

impl Machine for Plain {
    type Vector = Lanes;

    #[inline(always)]
    fn load(self, lanes: Lanes) -> Lanes {
        lanes
    }

    #[inline(always)]
    fn store(self, vector: Lanes) -> Lanes {
        vector
    }

    #[inline(always)]
    fn splat(self, value: Real) -> Lanes {
        Lanes::splat(value)
    }

    #[inline(always)]
    fn add(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn sqrt(self, a: Lanes) -> Lanes {
        zip(a, a, |a, _| a.sqrt())
    }

    #[inline(always)]
    fn max(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn neg(self, a: Lanes) -> Lanes {
        zip(a, a, |a, _| -a)
    }

    #[inline(always)]
    fn select_positive(self, of: Lanes, positive: Lanes, otherwise: Lanes) -> Lanes {
        let mut result = [0.0; WIDTH];
        for lane in 0..WIDTH {
            result[lane] = if of.0[lane] > 0.0 { positive.0[lane] } else { otherwise.0[lane] };
        }
        Lanes(result)
    }

    #[inline(always)]
    fn all_positive(self, a: Lanes) -> bool {
        a.0.iter().all(|value| *value > 0.0)
    }

    #[inline(always)]
    fn transpose(self, rows: [Lanes; WIDTH]) -> [Lanes; WIDTH] {
        let mut columns = [Lanes::ZERO; WIDTH];
        for (j, row) in rows.iter().enumerate() {
            for (column, value) in columns.iter_mut().zip(row.0) {
                column.0[j] = value;
            }
        }
        columns
    }
}

#[cfg(target_arch = "x86_64")]
mod avx {
    use std::arch::x86_64::{__m256, _CMP_GT_OQ};

    use pulp::x86::V3;

    use super::{Lanes, Machine, Pass, Real, WIDTH};

    /// Registers of eight numbers: most machines since 2015.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Avx(V3);

    struct OnAvx<P> {
        pass: P,
        avx: Avx,
    }

    impl<P: Pass> pulp::WithSimd for OnAvx<P> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _: S) {
            self.pass.run(self.avx);
        }
    }

    impl Avx {
        pub(crate) fn of_this_machine() -> Option<Self> {
            V3::try_new().map(Self)
        }

        /// Of four rows: their numbers 0 and 4 in one vector, 1 and 5, 2 and 6, 3 and 7 in the next ones.
        #[inline(always)]
        fn fours(self, [a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
            let avx = self.0.avx;
            let (low_ab, high_ab) = (avx._mm256_unpacklo_ps(a, b), avx._mm256_unpackhi_ps(a, b));
            let (low_cd, high_cd) = (avx._mm256_unpacklo_ps(c, d), avx._mm256_unpackhi_ps(c, d));
            [
                avx._mm256_shuffle_ps::<0b01_00_01_00>(low_ab, low_cd),
                avx._mm256_shuffle_ps::<0b11_10_11_10>(low_ab, low_cd),
                avx._mm256_shuffle_ps::<0b01_00_01_00>(high_ab, high_cd),
                avx._mm256_shuffle_ps::<0b11_10_11_10>(high_ab, high_cd),
            ]
        }

        #[inline]
        pub(crate) fn run(self, pass: impl Pass) {
            pulp::Simd::vectorize(self.0, OnAvx { pass, avx: self });
        }
    }

    impl Machine for Avx {
        type Vector = __m256;

        #[inline(always)]
        fn load(self, lanes: Lanes) -> __m256 {
            pulp::cast(lanes.0)
        }

        #[inline(always)]
        fn store(self, vector: __m256) -> Lanes {
            Lanes(pulp::cast(vector))
        }

        #[inline(always)]
        fn splat(self, value: Real) -> __m256 {
            self.0.avx._mm256_set1_ps(value)
        }

        #[inline(always)]
        fn add(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_add_ps(a, b)
        }

        #[inline(always)]
        fn sub(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_sub_ps(a, b)
        }

        #[inline(always)]
        fn mul(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_mul_ps(a, b)
        }

        #[inline(always)]
        fn div(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_div_ps(a, b)
        }

        #[inline(always)]
        fn sqrt(self, a: __m256) -> __m256 {
            self.0.avx._mm256_sqrt_ps(a)
        }

        #[inline(always)]
        fn max(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_max_ps(a, b)
        }

        #[inline(always)]
        fn min(self, a: __m256, b: __m256) -> __m256 {
            self.0.avx._mm256_min_ps(a, b)
        }

        #[inline(always)]
        fn neg(self, a: __m256) -> __m256 {
            self.0.avx._mm256_xor_ps(a, self.splat(-0.0))
        }

        #[inline(always)]
        fn select_positive(self, of: __m256, positive: __m256, otherwise: __m256) -> __m256 {
            let mask = self.0.avx._mm256_cmp_ps::<_CMP_GT_OQ>(of, self.splat(0.0));
            self.0.avx._mm256_blendv_ps(otherwise, positive, mask)
        }

        #[inline(always)]
        fn all_positive(self, a: __m256) -> bool {
            let mask = self.0.avx._mm256_cmp_ps::<_CMP_GT_OQ>(a, self.splat(0.0));
            self.0.avx._mm256_movemask_ps(mask) == 0xff
        }

        #[inline(always)]
        fn transpose(self, rows: [__m256; WIDTH]) -> [__m256; WIDTH] {
            let (first, second) =
                (self.fours([rows[0], rows[1], rows[2], rows[3]]), self.fours([rows[4], rows[5], rows[6], rows[7]]));
            let mut columns = [first[0]; WIDTH];
            for i in 0..WIDTH / 2 {
                columns[i] = self.0.avx._mm256_permute2f128_ps::<0x20>(first[i], second[i]);
                columns[i + WIDTH / 2] = self.0.avx._mm256_permute2f128_ps::<0x31>(first[i], second[i]);
            }
            columns
        }
    }
}
