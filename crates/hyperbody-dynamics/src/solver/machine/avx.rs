//! Registers of eight numbers of single, and of four of double precision, by the instructions of AVX2.

use std::arch::x86_64::{__m256, __m256d, _CMP_GT_OQ};

use pulp::x86::V3;

use super::{DoubleLanes, Lanes, Machine, Pass, Real, WIDTH};

/// Lanes of a register in double precision.
const HALF: usize = WIDTH / 2;

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

    #[inline]
    pub(crate) fn run(self, pass: impl Pass) {
        pulp::Simd::vectorize(self.0, OnAvx { pass, avx: self });
    }
}

impl Machine for Avx {
    const UNROLLS: bool = true;

    type Vector = __m256;
    /// Lanes 0 to 3, and 4 to 7.
    type Doubles = (__m256d, __m256d);
    type Part = __m256d;
    const PARTS: usize = WIDTH / HALF;

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
    fn transpose_halves(self, [a, b, c, d]: [__m256; WIDTH / 2]) -> [__m256; WIDTH / 2] {
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

    #[inline(always)]
    fn transpose(self, rows: [__m256; WIDTH]) -> [__m256; WIDTH] {
        let [a, b, c, d, e, f, g, h] = rows;
        let (first, second) = (self.transpose_halves([a, b, c, d]), self.transpose_halves([e, f, g, h]));
        let mut columns = [first[0]; WIDTH];
        for i in 0..WIDTH / 2 {
            columns[i] = self.0.avx._mm256_permute2f128_ps::<0x20>(first[i], second[i]);
            columns[i + WIDTH / 2] = self.0.avx._mm256_permute2f128_ps::<0x31>(first[i], second[i]);
        }
        columns
    }

    #[inline(always)]
    fn load_doubles(self, values: [f64; WIDTH]) -> Self::Doubles {
        let [a, b, c, d, e, f, g, h] = values;
        (pulp::cast([a, b, c, d]), pulp::cast([e, f, g, h]))
    }

    #[inline(always)]
    fn store_doubles(self, (low, high): Self::Doubles) -> [f64; WIDTH] {
        let ([a, b, c, d], [e, f, g, h]): ([f64; 4], [f64; 4]) = (pulp::cast(low), pulp::cast(high));
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    fn widen(self, a: __m256) -> Self::Doubles {
        let avx = self.0.avx;
        let (low, high) = (avx._mm256_extractf128_ps::<0>(a), avx._mm256_extractf128_ps::<1>(a));
        (avx._mm256_cvtps_pd(low), avx._mm256_cvtps_pd(high))
    }

    #[inline(always)]
    fn narrow(self, (low, high): Self::Doubles) -> __m256 {
        let avx = self.0.avx;
        avx._mm256_set_m128(avx._mm256_cvtpd_ps(high), avx._mm256_cvtpd_ps(low))
    }

    #[inline(always)]
    fn add_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles {
        (self.add_part(a.0, b.0), self.add_part(a.1, b.1))
    }

    #[inline(always)]
    fn sub_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles {
        (self.sub_part(a.0, b.0), self.sub_part(a.1, b.1))
    }

    #[inline(always)]
    fn mul_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles {
        (self.mul_part(a.0, b.0), self.mul_part(a.1, b.1))
    }

    #[inline(always)]
    fn sqrt_doubles(self, a: Self::Doubles) -> Self::Doubles {
        (self.0.avx._mm256_sqrt_pd(a.0), self.0.avx._mm256_sqrt_pd(a.1))
    }

    #[inline(always)]
    fn max_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles {
        (self.max_part(a.0, b.0), self.max_part(a.1, b.1))
    }

    #[inline(always)]
    fn inverse_or_zero(self, (low, high): Self::Doubles) -> Self::Doubles {
        (self.inverse_or_zero_part(low), self.inverse_or_zero_part(high))
    }

    #[inline(always)]
    fn load_part(self, lanes: &DoubleLanes, part: usize) -> __m256d {
        pulp::cast(lanes.0.as_chunks::<HALF>().0[part % Self::PARTS])
    }

    #[inline(always)]
    fn store_part(self, a: __m256d, lanes: &mut Lanes, part: usize) {
        lanes.0.as_chunks_mut::<HALF>().0[part % Self::PARTS] = pulp::cast(self.0.avx._mm256_cvtpd_ps(a));
    }

    #[inline(always)]
    fn splat_part(self, value: f64) -> __m256d {
        self.0.avx._mm256_set1_pd(value)
    }

    #[inline(always)]
    fn add_part(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_add_pd(a, b)
    }

    #[inline(always)]
    fn sub_part(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_sub_pd(a, b)
    }

    #[inline(always)]
    fn mul_part(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_mul_pd(a, b)
    }

    #[inline(always)]
    fn max_part(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_max_pd(a, b)
    }

    #[inline(always)]
    fn inverse_or_zero_part(self, a: __m256d) -> __m256d {
        let avx = self.0.avx;
        let mask = avx._mm256_cmp_pd::<_CMP_GT_OQ>(a, avx._mm256_setzero_pd());
        avx._mm256_and_pd(avx._mm256_div_pd(avx._mm256_set1_pd(1.0), a), mask)
    }

    #[inline(always)]
    fn select_positive_part(self, of: __m256d, positive: __m256d, otherwise: __m256d) -> __m256d {
        let avx = self.0.avx;
        let mask = avx._mm256_cmp_pd::<_CMP_GT_OQ>(of, avx._mm256_setzero_pd());
        avx._mm256_blendv_pd(otherwise, positive, mask)
    }
}
