//! Stability of steady rotations in principal planes: eigenvalues in closed form for every dimension.
//!
//! Linearised about turns in disjoint planes, a disturbance falls apart into blocks. Each turning plane (i, j) with rate a
//! and each idle axis k couple the two planes (i, k), (j, k): λ² = −a² r_ik r_jk. Each pair of turning planes (i, j), a and
//! (k, l), b couples the four planes between them: λ² = μ with μ² + Tμ + D = 0,
//!
//! T = a²(r_ik r_jk + r_il r_jl) + b²(r_ik r_il + r_jk r_jl), D = r_ik r_jl r_il r_jk (a² − b²)².
//!
//! All other eigenvalues are zero: changing the rates leads to a neighbouring steady rotation. A rotation is stable if all
//! μ are real, negative and different, T > 0, D > 0, T² > 4D: then every disturbance oscillates. With J₁ > J₂ > J₃ > J₄
//! this says: in {12 | 34} always, in {13 | 24} never, in {14 | 23} if and only if the inner turn is fast enough, see
//! [`inner_turn_threshold`]; with b = 0 that a simple rotation is stable if no moment lies between those of its plane.
//!
//! Where J_i J_j = J_k J_l, as in boxes whose edges are in proportion, T² = 4D at all rates and the two μ are one,
//! −T/2 = r_ik r_il (a² − b²): unstable if that is positive, and if it is negative stable, for the eigenvectors are complete.
//! T² − 4D is therefore never taken as that difference: with Δ = J_i J_j − J_k J_l, u = a² − b², P the bracket of a² in T,
//!
//! e = r_ik + r_jl = 2Δ/((J_i + J_k)(J_j + J_l)), f = r_il + r_jk = 2Δ/((J_i + J_l)(J_j + J_k)),
//! T = uP + b²ef, T² − 4D = u²(e r_jk − f r_jl)² + 2uP b²ef + b⁴e²f²,
//!
//! where ef ≥ 0, and for |a| ≥ |b| terms of opposite signs meet only about a threshold.
//!
//! On the edges (equal moments, a threshold met to rounding) a double eigenvalue decides by its eigenvectors: if they are
//! complete the disturbance stays bounded, if not it grows in proportion to time, and the verdict is left open. Isoclinic
//! turns, a² = b², are open too: every isoclinic spin in the four axes, principal or not, is steady, so the disturbance
//! that tilts it neither oscillates nor grows, and the linear problem cannot tell (P. Birtea, I. Caşu, T. Ratiu and
//! M. Turhan, 2012).

use hyperbody_math::{Bivector, planes};

use super::error::Result;
use super::principal_rotation::{PrincipalRotation, PrincipalTurn};
use super::stability_text;
use super::top::FreeTop;

/// Relative width within which a sign or a coincidence counts as rounding.
const ROUNDING: f64 = 1e-12;

/// Fraction of a spin that may lie outside the principal planes for it to count as a disturbed steady rotation.
pub const MAX_DISTURBANCE: f64 = 0.2;

/// What becomes of a small disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// It oscillates.
    Stable,
    /// It grows exponentially.
    Unstable,
    /// The linear problem cannot tell: isoclinic turns, or growth in proportion to time.
    Open,
}

impl Verdict {
    /// True, false, or `None` if open.
    #[must_use]
    pub const fn stable(self) -> Option<bool> {
        match self {
            Self::Stable => Some(true),
            Self::Unstable => Some(false),
            Self::Open => None,
        }
    }
}

/// An eigenvalue of the linearised motion, in 1/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Rate of growth, or of decay if negative.
    pub real: f64,
    /// Angular frequency.
    pub imaginary: f64,
}

/// The part of the linear problem that couples one turning plane with an idle axis or with another turning plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// The turning plane.
    pub turn: PrincipalTurn,
    /// What it is coupled with.
    pub partner: Partner,
    /// T: minus the sum of the two λ² (for an idle axis −λ²), in 1/s².
    pub t: f64,
    /// D: the product of the two λ² (for an idle axis 0), in 1/s⁴.
    pub d: f64,
    /// T² − 4D in 1/s⁴, without the rounding of that difference: negative if the λ² are complex, zero if they are one.
    pub discriminant: f64,
    /// Largest real part of the block's eigenvalues, in 1/s.
    pub growth_rate: f64,
    /// What kind of block it is.
    pub kind: BlockKind,
}

/// What a turning plane is coupled with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// An axis in no turning plane.
    IdleAxis(usize),
    /// Another turning plane.
    Turn(PrincipalTurn),
}

/// How the disturbances of a block behave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlockKind {
    /// They oscillate or stand still.
    Oscillating,
    /// They grow exponentially without oscillating.
    Growing,
    /// They grow exponentially while oscillating.
    GrowingOscillation,
    /// a² = b².
    Isoclinic,
    /// They grow in proportion to time.
    Drifting,
}

/// The stability of a steady rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability<const N: usize> {
    /// The rotation that was judged.
    pub rotation: PrincipalRotation<N>,
    /// Fraction of the spin that lies outside that rotation.
    pub disturbance: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// Largest real part of an eigenvalue in 1/s: disturbances grow e-fold in its inverse. Zero unless unstable.
    pub growth_rate: f64,
    /// All N(N−1)/2 eigenvalues, in the order of the blocks, then the zeros.
    pub eigenvalues: Vec<Eigenvalue>,
    /// The blocks.
    pub blocks: Vec<Block>,
    /// A sentence that says why.
    pub why: String,
}

/// Stability of the steady rotation nearest to `spin` (body frame, rad/s). Where more than [`MAX_DISTURBANCE`] of the
/// spin lies outside principal planes the verdict is open: there is no steady rotation to judge.
///
/// # Errors
/// If the spin is not finite.
pub fn stability<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Result<Stability<N>> {
    let (rotation, disturbance) = PrincipalRotation::nearest(spin)?;
    let blocks = blocks_of(top, &rotation);
    let growth_rate = blocks.iter().map(|block| block.growth_rate).fold(0.0, f64::max);
    let grows = |block: &Block| matches!(block.kind, BlockKind::Growing | BlockKind::GrowingOscillation);
    let judged = disturbance <= MAX_DISTURBANCE && !rotation.turns().is_empty();
    let verdict = if judged && blocks.iter().any(grows) {
        Verdict::Unstable
    } else if judged && blocks.iter().all(|block| block.kind == BlockKind::Oscillating) {
        Verdict::Stable
    } else {
        Verdict::Open
    };
    let mut eigenvalues: Vec<Eigenvalue> = blocks.iter().flat_map(block_eigenvalues).collect();
    eigenvalues.resize(planes::count(N), Eigenvalue { real: 0.0, imaginary: 0.0 });
    let mut result = Stability { rotation, disturbance, verdict, growth_rate, eigenvalues, blocks, why: String::new() };
    result.why = stability_text::why(top, &result);
    Ok(result)
}

/// Verdict and largest real part of an eigenvalue in 1/s of a steady rotation, without the reasons: for maps.
#[must_use]
pub fn verdict_and_growth<const N: usize>(top: &FreeTop<N>, rotation: &PrincipalRotation<N>) -> (Verdict, f64) {
    let mut verdict = if rotation.turns().is_empty() { Verdict::Open } else { Verdict::Stable };
    let mut growth_rate = 0.0_f64;
    for block in blocks_of(top, rotation) {
        growth_rate = growth_rate.max(block.growth_rate);
        verdict = match block.kind {
            BlockKind::Growing | BlockKind::GrowingOscillation => Verdict::Unstable,
            BlockKind::Isoclinic | BlockKind::Drifting if verdict == Verdict::Stable => Verdict::Open,
            _ => verdict,
        };
    }
    (verdict, growth_rate)
}

/// For moments J₁ ≥ J₂ ≥ J₃ ≥ J₄ and turns a in plane (1, 4), b in (2, 3): the |b/a| above which the double rotation is
/// stable, (√(r12 r24) + √(r13 r34))/(√(r12 r13) + √(r24 r34)). From zero to one, and one exactly where J₁J₄ = J₂J₃.
#[must_use]
pub fn inner_turn_threshold(moments: [f64; 4]) -> f64 {
    let r = |i: usize, j: usize| (moments[i] - moments[j]) / (moments[i] + moments[j]);
    let (r12, r13, r24, r34) = (r(0, 1), r(0, 2), r(1, 3), r(2, 3));
    ((r12 * r24).sqrt() + (r13 * r34).sqrt()) / ((r12 * r13).sqrt() + (r24 * r34).sqrt())
}

fn blocks_of<const N: usize>(top: &FreeTop<N>, rotation: &PrincipalRotation<N>) -> Vec<Block> {
    let turns = rotation.turns();
    let mut blocks = Vec::new();
    for (index, &turn) in turns.iter().enumerate() {
        for axis in rotation.idle_axes() {
            blocks.push(idle_block(top, turn, axis));
        }
        for &other in &turns[index + 1..] {
            blocks.push(pair_block(top, turn, other));
        }
    }
    blocks
}

fn idle_block<const N: usize>(top: &FreeTop<N>, turn: PrincipalTurn, axis: usize) -> Block {
    let (r_ik, r_jk) = (top.asymmetry(turn.i, axis), top.asymmetry(turn.j, axis));
    let product = r_ik * r_jk;
    let kind = if product > 0.0 || (r_ik == 0.0 && r_jk == 0.0) {
        BlockKind::Oscillating
    } else if product < 0.0 {
        BlockKind::Growing
    } else {
        BlockKind::Drifting
    };
    let growth_rate = if product < 0.0 { turn.rate.abs() * (-product).sqrt() } else { 0.0 };
    let t = turn.rate * turn.rate * product;
    Block { turn, partner: Partner::IdleAxis(axis), t, d: 0.0, discriminant: t * t, growth_rate, kind }
}

fn pair_block<const N: usize>(top: &FreeTop<N>, first: PrincipalTurn, second: PrincipalTurn) -> Block {
    // The faster turn has the rate a of the formulas.
    let (fast, slow) = if first.rate.abs() >= second.rate.abs() { (first, second) } else { (second, first) };
    let asymmetries = [
        top.asymmetry(fast.i, slow.i),
        top.asymmetry(fast.i, slow.j),
        top.asymmetry(fast.j, slow.i),
        top.asymmetry(fast.j, slow.j),
    ];
    // Rates and asymmetries relative to the largest: T and D of the order of one, and the result scales back.
    let coupling = asymmetries.iter().fold(0.0, |largest: f64, r| largest.max(r.abs()));
    let partner = Partner::Turn(second);
    if coupling == 0.0 {
        let kind = BlockKind::Oscillating;
        return Block { turn: first, partner, t: 0.0, d: 0.0, discriminant: 0.0, growth_rate: 0.0, kind };
    }
    let rate = fast.rate.abs();
    let (a, b) = (fast.rate / rate, slow.rate / rate);
    let r = asymmetries.map(|asymmetry| asymmetry / coupling);
    let sums = opposite_sums(top, fast, slow).map(|sum| sum / coupling);
    let coefficients = pair_coefficients(r, sums, a, b);
    let kind = pair_kind(r, a, b, coefficients);
    let PairCoefficients { t, d, discriminant } = coefficients;
    let scale = rate * coupling;
    let growth_rate = match kind {
        BlockKind::Growing | BlockKind::GrowingOscillation => {
            scale * block_roots(t, d, discriminant).iter().map(|root| root.real).fold(0.0, f64::max)
        }
        _ => 0.0,
    };
    let scale_sq = scale * scale;
    let (t, d, discriminant) = (t * scale_sq, d * scale_sq * scale_sq, discriminant * scale_sq * scale_sq);
    Block { turn: first, partner, t, d, discriminant, growth_rate, kind }
}

/// e = r_ik + r_jl and f = r_il + r_jk, exactly zero together where J_i J_j = J_k J_l.
fn opposite_sums<const N: usize>(top: &FreeTop<N>, first: PrincipalTurn, second: PrincipalTurn) -> [f64; 2] {
    let moments = top.principal_moments();
    let largest = [first.i, first.j, second.i, second.j].iter().fold(0.0, |most: f64, &axis| most.max(moments[axis]));
    let [i, j, k, l] = [first.i, first.j, second.i, second.j].map(|axis| moments[axis] / largest);
    let twice_delta = 2.0 * (i * j - k * l);
    [twice_delta / ((i + k) * (j + l)), twice_delta / ((i + l) * (j + k))]
}

/// T, D and T² − 4D; the last exactly zero if it is zero to rounding.
#[derive(Clone, Copy, Debug)]
struct PairCoefficients {
    t: f64,
    d: f64,
    discriminant: f64,
}

/// For r_ik, r_il, r_jk, r_jl, the sums e and f and the rates |a| ≥ |b|.
fn pair_coefficients([r_ik, r_il, r_jk, r_jl]: [f64; 4], [e, f]: [f64; 2], a: f64, b: f64) -> PairCoefficients {
    let difference = (a - b) * (a + b);
    let product = r_ik * r_jk + r_il * r_jl;
    let from_sums = b * b * e * f;
    let t = difference * product + from_sums;
    let d = r_ik * r_jl * r_il * r_jk * difference * difference;
    let from_difference = difference * (e * r_jk - f * r_jl);
    let apart = from_difference * from_difference + 2.0 * difference * product * from_sums + from_sums * from_sums;
    // With D ≤ 0 the plain difference loses nothing.
    let exact = if d > 0.0 { apart } else { t * t - 4.0 * d };
    let edge = ROUNDING * (t * t).max(4.0 * d.abs());
    PairCoefficients { t, d, discriminant: if exact.abs() <= edge { 0.0 } else { exact } }
}

fn pair_kind(r: [f64; 4], a: f64, b: f64, coefficients: PairCoefficients) -> BlockKind {
    let PairCoefficients { t, d, discriminant } = coefficients;
    if ((a - b) * (a + b)).abs() <= ROUNDING {
        return BlockKind::Isoclinic;
    }
    // The sign of D is that of a product, exact; so D = 0 means equal moments.
    if d < 0.0 || (d == 0.0 && t < -ROUNDING) || (d > 0.0 && t < 0.0 && discriminant >= 0.0) {
        BlockKind::Growing
    } else if discriminant < 0.0 {
        BlockKind::GrowingOscillation
    } else if (d > 0.0 && discriminant > 0.0) || stays_bounded(&pair_generator(r, a, b), t, d) {
        BlockKind::Oscillating
    } else {
        BlockKind::Drifting
    }
}

/// d/dt of the disturbances (ω_ik, ω_il, ω_jk, ω_jl) as a matrix.
fn pair_generator([r_ik, r_il, r_jk, r_jl]: [f64; 4], a: f64, b: f64) -> [[f64; 4]; 4] {
    [
        [0.0, r_ik * b, -r_ik * a, 0.0],
        [-r_il * b, 0.0, 0.0, -r_il * a],
        [r_jk * a, 0.0, 0.0, r_jk * b],
        [0.0, r_jl * a, -r_jl * b, 0.0],
    ]
}

/// Whether a block on an edge, where eigenvalues coincide, has complete eigenvectors: with λ² = −T/2 twice that is
/// A² = −T/2, with λ² = 0 and −T it is A³ = −TA.
fn stays_bounded(generator: &[[f64; 4]; 4], t: f64, d: f64) -> bool {
    let square = multiply(generator, generator);
    let cube = multiply(&square, generator);
    let mut defect = 0.0_f64;
    for i in 0..4 {
        for j in 0..4 {
            let of_zero = cube[i][j] + t * generator[i][j];
            let of_double = square[i][j] + if i == j { 0.5 * t } else { 0.0 };
            defect = defect.max(if d == 0.0 { of_zero } else { of_double }.abs());
        }
    }
    // Within the width of the edge rounding moves the defect by its square root; a Jordan block has one of order one.
    t > 0.0 && defect <= 10.0 * ROUNDING.sqrt()
}

fn multiply(a: &[[f64; 4]; 4], b: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let mut product = [[0.0; 4]; 4];
    for i in 0..4 {
        for k in 0..4 {
            for j in 0..4 {
                product[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    product
}

/// The four roots λ of λ⁴ + Tλ² + D = 0, with T² − 4D.
fn block_roots(t: f64, d: f64, discriminant: f64) -> [Eigenvalue; 4] {
    let pair = |real: f64, imaginary: f64| Eigenvalue { real, imaginary };
    if discriminant >= 0.0 {
        // The root of larger size first, the other from the product: no cancellation.
        let larger = -0.5 * (t + discriminant.sqrt().copysign(t));
        let smaller = if larger == 0.0 { 0.0 } else { d / larger };
        let [(a, b), (c, e)] = [larger, smaller].map(|mu| {
            let root = mu.abs().sqrt();
            if mu > 0.0 { (pair(root, 0.0), pair(-root, 0.0)) } else { (pair(0.0, root), pair(0.0, -root)) }
        });
        return [a, b, c, e];
    }
    // μ = (−T ± i√(4D − T²))/2, |μ| = √D: the square root by half angles.
    let size = d.sqrt();
    let real = (0.5 * (size - 0.5 * t)).max(0.0).sqrt();
    let imaginary = (0.5 * (size + 0.5 * t)).max(0.0).sqrt();
    [pair(real, imaginary), pair(real, -imaginary), pair(-real, imaginary), pair(-real, -imaginary)]
}

fn block_eigenvalues(block: &Block) -> Vec<Eigenvalue> {
    match block.partner {
        Partner::Turn(_) => block_roots(block.t, block.d, block.discriminant).to_vec(),
        Partner::IdleAxis(_) => {
            let root = block.t.abs().sqrt();
            let values = [root, -root];
            values
                .map(|value| {
                    if block.t < 0.0 {
                        Eigenvalue { real: value, imaginary: 0.0 }
                    } else {
                        Eigenvalue { real: 0.0, imaginary: value }
                    }
                })
                .to_vec()
        }
    }
}
