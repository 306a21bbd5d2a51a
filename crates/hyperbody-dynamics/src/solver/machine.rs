//! The vector instructions of a processor: passes over contacts are compiled for each kind and chosen at run time.
//!
//! Lane by lane all kinds do the same IEEE operations, none of them fused, so the bits of results do not depend on the machine.

#[cfg(target_arch = "x86_64")]
mod avx;

use super::lanes::{DoubleLanes, Lanes, Real, WIDTH};

/// A kind of processor: a token that its instructions are there.
pub(crate) trait Machine: Copy {
    /// Whether the same code for several lengths is worth its weight.
    const UNROLLS: bool;

    /// [`WIDTH`] numbers in registers.
    type Vector: Copy;
    /// The same in double precision.
    type Doubles: Copy;
    /// Of the same, those of one register.
    type Part: Copy;
    /// Registers that the same takes.
    const PARTS: usize;

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
    /// Of four rows, of which row i holds four numbers of contact i and four of contact i + 4: their numbers 0 and 4 in one
    /// vector, 1 and 5, 2 and 6, 3 and 7 in the next ones, so that vector j holds number j of each contact. Its own inverse.
    fn transpose_halves(self, rows: [Self::Vector; WIDTH / 2]) -> [Self::Vector; WIDTH / 2];

    fn load_doubles(self, values: [f64; WIDTH]) -> Self::Doubles;
    fn store_doubles(self, a: Self::Doubles) -> [f64; WIDTH];
    fn widen(self, a: Self::Vector) -> Self::Doubles;
    /// Rounded to the nearest.
    fn narrow(self, a: Self::Doubles) -> Self::Vector;
    fn add_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    fn sub_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    fn mul_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    fn sqrt_doubles(self, a: Self::Doubles) -> Self::Doubles;
    /// a where a > b, else b.
    fn max_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    /// 1/a where a > 0, else 0.
    fn inverse_or_zero(self, a: Self::Doubles) -> Self::Doubles;

    fn load_part(self, lanes: &DoubleLanes, part: usize) -> Self::Part;
    /// Rounded to the nearest.
    fn store_part(self, a: Self::Part, lanes: &mut Lanes, part: usize);
    fn splat_part(self, value: f64) -> Self::Part;
    fn add_part(self, a: Self::Part, b: Self::Part) -> Self::Part;
    fn sub_part(self, a: Self::Part, b: Self::Part) -> Self::Part;
    fn mul_part(self, a: Self::Part, b: Self::Part) -> Self::Part;
    /// a where a > b, else b.
    fn max_part(self, a: Self::Part, b: Self::Part) -> Self::Part;
    /// 1/a where a > 0, else 0.
    fn inverse_or_zero_part(self, a: Self::Part) -> Self::Part;
    /// `positive` where `of` > 0, else `otherwise`.
    fn select_positive_part(self, of: Self::Part, positive: Self::Part, otherwise: Self::Part) -> Self::Part;
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

#[inline(always)]
fn zip_doubles(a: [f64; WIDTH], b: [f64; WIDTH], f: impl Fn(f64, f64) -> f64) -> [f64; WIDTH] {
    let mut result = [0.0; WIDTH];
    for lane in 0..WIDTH {
        result[lane] = f(a[lane], b[lane]);
    }
    result
}

impl Machine for Plain {
    /// Old processors, and browsers, whose module has to be small.
    const UNROLLS: bool = false;

    type Vector = Lanes;
    type Doubles = [f64; WIDTH];
    /// One by one: what takes parts is long, and has to be small.
    type Part = f64;
    const PARTS: usize = WIDTH;

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

    #[inline(always)]
    fn transpose_halves(self, rows: [Lanes; WIDTH / 2]) -> [Lanes; WIDTH / 2] {
        let mut columns = [Lanes::ZERO; WIDTH / 2];
        for (j, row) in rows.iter().enumerate() {
            for (i, column) in columns.iter_mut().enumerate() {
                column.0[j] = row.0[i];
                column.0[j + WIDTH / 2] = row.0[i + WIDTH / 2];
            }
        }
        columns
    }

    #[inline(always)]
    fn load_doubles(self, values: [f64; WIDTH]) -> [f64; WIDTH] {
        values
    }

    #[inline(always)]
    fn store_doubles(self, a: [f64; WIDTH]) -> [f64; WIDTH] {
        a
    }

    #[inline(always)]
    fn widen(self, a: Lanes) -> [f64; WIDTH] {
        a.0.map(f64::from)
    }

    #[inline(always)]
    fn narrow(self, a: [f64; WIDTH]) -> Lanes {
        Lanes(a.map(|value| value as Real))
    }

    #[inline(always)]
    fn add_doubles(self, a: [f64; WIDTH], b: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub_doubles(self, a: [f64; WIDTH], b: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul_doubles(self, a: [f64; WIDTH], b: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn sqrt_doubles(self, a: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, a, |a, _| a.sqrt())
    }

    #[inline(always)]
    fn max_doubles(self, a: [f64; WIDTH], b: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, b, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn inverse_or_zero(self, a: [f64; WIDTH]) -> [f64; WIDTH] {
        zip_doubles(a, a, |a, _| if a > 0.0 { 1.0 / a } else { 0.0 })
    }

    #[inline(always)]
    fn load_part(self, lanes: &DoubleLanes, part: usize) -> f64 {
        lanes.0[part % WIDTH]
    }

    #[inline(always)]
    fn store_part(self, a: f64, lanes: &mut Lanes, part: usize) {
        lanes.0[part % WIDTH] = a as Real;
    }

    #[inline(always)]
    fn splat_part(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn add_part(self, a: f64, b: f64) -> f64 {
        a + b
    }

    #[inline(always)]
    fn sub_part(self, a: f64, b: f64) -> f64 {
        a - b
    }

    #[inline(always)]
    fn mul_part(self, a: f64, b: f64) -> f64 {
        a * b
    }

    #[inline(always)]
    fn max_part(self, a: f64, b: f64) -> f64 {
        if a > b { a } else { b }
    }

    #[inline(always)]
    fn inverse_or_zero_part(self, a: f64) -> f64 {
        if a > 0.0 { 1.0 / a } else { 0.0 }
    }

    #[inline(always)]
    fn select_positive_part(self, of: f64, positive: f64, otherwise: f64) -> f64 {
        if of > 0.0 { positive } else { otherwise }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::part::Place;
    use crate::solver::wide::{Wide, transpose, transpose_halves};

    /// All operations on some numbers, one after the other.
    struct Everything<'a> {
        numbers: &'a [Lanes],
        results: &'a mut Vec<Lanes>,
    }

    impl Pass for Everything<'_> {
        #[inline(always)]
        fn run<M: Machine>(self, machine: M) {
            let Self { numbers, results } = self;
            for pair in numbers.windows(2) {
                let (a, b) = (pair[0].on(machine), pair[1].on(machine));
                for value in [a + b, a - b, a * b, a.div(b), a.max(b), a.min(b), -a, (a * a).sqrt()] {
                    results.push(value.lanes());
                }
                results.push(a.select_positive(a, b).lanes());
                let positive = if a.all_positive() { 1.0 } else { 0.0 };
                results.push(Wide::splat(machine, positive).lanes());
                let (x, y) = (a.doubles(), b.doubles());
                for value in [x + y, x - y, x * y, x.max(y), (x * x).sqrt(), x.inverse_or_zero()] {
                    results.push(value.lanes());
                }
                let [a, b] = [pair[0], pair[1]].map(|lanes| DoubleLanes(lanes.0.map(f64::from)));
                let mut chosen = Lanes::ZERO;
                for place in Place::all(machine) {
                    let (a, b) = (a.at(place), b.at(place));
                    a.select_positive(b, a.abs().inverse_or_zero()).store(&mut chosen);
                }
                results.push(chosen);
            }
            for four in numbers.windows(WIDTH / 2) {
                let mut rows = [Wide::zero(machine); WIDTH / 2];
                for (row, lanes) in rows.iter_mut().zip(four) {
                    *row = lanes.on(machine);
                }
                results.extend(transpose_halves(machine, &rows).map(Wide::lanes));
            }
            for eight in numbers.windows(WIDTH) {
                let mut rows = [Wide::zero(machine); WIDTH];
                for (row, lanes) in rows.iter_mut().zip(eight) {
                    *row = lanes.on(machine);
                }
                results.extend(transpose(machine, &rows).map(Wide::lanes));
            }
        }
    }

    /// Whatever instructions this machine has, they do what plain loops do, to the bit.
    #[test]
    fn machines_agree_to_the_bit() {
        let mut state = 11_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = ((state >> 40) as Real) / ((1_u64 << 24) as Real) * 2.0 - 1.0;
            if state.is_multiple_of(7) { 0.0 } else { value }
        };
        let mut numbers: Vec<Lanes> = (0..200).map(|_| Lanes(std::array::from_fn(|_| random()))).collect();
        numbers.push(Lanes::splat(0.5));
        numbers.push(Lanes([0.0, -0.0, Real::MIN_POSITIVE, 1e-40, Real::MAX, -Real::MAX, 1.0, -1.0]));
        let (mut plain, mut fast) = (Vec::new(), Vec::new());
        Everything { numbers: &numbers, results: &mut plain }.run(Plain);
        Processor::of_this_machine().run(Everything { numbers: &numbers, results: &mut fast });
        assert_eq!(plain.len(), fast.len());
        // What is no number has a sign that machines choose as they like, and never gets this far.
        let bits = |lanes: &Lanes| lanes.0.map(|value| if value.is_nan() { 0 } else { value.to_bits() });
        for (index, (a, b)) in plain.iter().zip(&fast).enumerate() {
            assert_eq!(bits(a), bits(b), "result {index}: {a:?} and {b:?}");
        }
        // Rows become columns.
        let first = &plain[plain.len() - WIDTH * (numbers.len() - WIDTH + 1)..][..WIDTH];
        for (i, column) in first.iter().enumerate() {
            for (j, value) in column.0.iter().enumerate() {
                assert_eq!(value.to_bits(), numbers[j].0[i].to_bits());
            }
        }
    }
}
