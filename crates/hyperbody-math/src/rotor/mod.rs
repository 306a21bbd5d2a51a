//! Rotors: rotations as even multivectors, 2^(N−1) numbers side by side.
//!
//! **Convention.** A rotor R turns a vector x into x' = R x R~, with R~ its reverse. The turn by θ that takes axis i
//! towards axis j is **R = cos(θ/2) − sin(θ/2) e_i e_j**: mind the minus sign. The product `a * b` turns by `b` first,
//! then by `a`, as with matrices. R and −R are the same rotation.
//!
//! **Coefficients** stand by grade, and within a grade in lexicographic order of the axes: the scalar, the planes, the
//! 4-vectors, the 6-vector. In 4D: 1, xy, xz, xw, yz, yw, zw, xyzw. In 3D these are the quaternion
//! w + x i + y j + z k as (w, −z, y, −x).
//!
//! **Not every even multivector is a rotor.** It has to be a *unit versor*: R R~ = 1, and R x R~ again a vector. In 2D
//! and 3D that is one condition (length one); in 4D it is two, in 5D six, in 6D seventeen, so dividing by the length
//! does not repair a rotor from 4D up: see [`Rotor::repair`].
//!
//! Rotors interpolate, serialise and teach; the simulation steps the matrix, [`crate::Rotation`], because from four
//! dimensions up it composes as cheaply and turns vectors far more cheaply.

mod blades;
mod convert;
mod error;
mod exponential;
mod repair;

pub use error::{RotorError, RotorErrorKind};

use std::fmt::Debug;
use std::ops::{Mul, Neg, Range};

use crate::{Bivector, Vector, planes, scalar};
use blades::Blades;

/// The number of dimensions as a type, to hang [`EvenAlgebra`] on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dim<const N: usize>;

mod sealed {
    pub trait Sealed {}
}

/// The dimensions that have rotors here: `Dim<2>` to `Dim<6>`. It exists because Rust cannot yet write `[f64; 2^(N−1)]`.
///
/// Code generic over `N` says `where Dim<N>: EvenAlgebra`.
pub trait EvenAlgebra: sealed::Sealed {
    /// `[f64; 2^(N−1)]`.
    type Coefficients: Copy + Debug + PartialEq + AsRef<[f64]> + AsMut<[f64]> + Send + Sync + 'static;
    /// All coefficients zero.
    const ZERO: Self::Coefficients;
    /// The scalar one.
    const ONE: Self::Coefficients;
}

const fn scalar_array<const M: usize>(value: f64) -> [f64; M] {
    let mut array = [0.0; M];
    array[0] = value;
    array
}

macro_rules! even_algebra {
    ($($n:literal)*) => {$(
        impl sealed::Sealed for Dim<$n> {}
        impl EvenAlgebra for Dim<$n> {
            type Coefficients = [f64; 1 << ($n - 1)];
            const ZERO: Self::Coefficients = scalar_array(0.0);
            const ONE: Self::Coefficients = scalar_array(1.0);
        }
    )*};
}
even_algebra!(2 3 4 5 6);

/// A rotation of `N`-dimensional space as a unit versor; see the [module](self) for the convention.
///
/// Exactly 2^(N−1) contiguous `f64`.
///
/// ```
/// use hyperbody_math::{Rotor, Vector};
///
/// // A quarter turn from x to w, then one from x to y.
/// let rotor = Rotor::<4>::in_plane(0, 1, 90f64.to_radians()) * Rotor::in_plane(0, 3, 90f64.to_radians());
/// let turned = rotor.rotate(Vector([0.0, 0.0, 0.0, 1.0])); // w → −x → −y
/// assert!((turned - Vector([0.0, -1.0, 0.0, 0.0])).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Rotor<const N: usize>
where
    Dim<N>: EvenAlgebra,
{
    /// A unit versor to rounding.
    coefficients: Coefficients<N>,
}

type Coefficients<const N: usize> = <Dim<N> as EvenAlgebra>::Coefficients;

impl<const N: usize> Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    /// No rotation: the scalar one.
    pub const IDENTITY: Self = Self { coefficients: <Dim<N> as EvenAlgebra>::ONE };

    /// Number of coefficients: 2^(N−1).
    pub const COUNT: usize = Blades::<N>::COUNT;

    /// The turn by `angle_rad` that takes axis i towards axis j. A turn by 2π is −1, by 4π is 1.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn in_plane(i: usize, j: usize, angle_rad: f64) -> Self {
        assert!(i != j && i < N && j < N, "a plane needs two different axes below {N}, got ({i}, {j})");
        let (sin, cos) = scalar::sin_cos(0.5 * angle_rad);
        Self::from_plane_half_angle(i, j, cos, sin)
    }

    /// cos − sin e_i e_j.
    fn from_plane_half_angle(i: usize, j: usize, cos: f64, sin: f64) -> Self {
        let mut rotor = Self::IDENTITY;
        let coefficients = rotor.coefficients.as_mut();
        coefficients[0] = cos;
        coefficients[1 + planes::index(N, i.min(j), i.max(j))] = if i < j { -sin } else { sin };
        rotor
    }

    /// The coefficients by grade, and within a grade in lexicographic order of the axes.
    #[inline]
    #[must_use]
    pub fn coefficients(&self) -> &[f64] {
        self.coefficients.as_ref()
    }

    /// The coefficients as an array: `[f64; 8]` in 4D.
    #[inline]
    #[must_use]
    pub fn to_array(&self) -> Coefficients<N> {
        self.coefficients
    }

    /// The names of the coefficients in their order: `"1"`, then axes, as `"xy"` or `"xyzw"`.
    pub fn coefficient_names() -> impl Iterator<Item = String> {
        (0..Self::COUNT).map(|slot| {
            if slot == 0 {
                return "1".to_owned();
            }
            (0..N)
                .filter(|axis| Blades::<N>::AXES[slot] >> axis & 1 == 1)
                .map(|axis| planes::AXIS_NAMES[axis])
                .collect()
        })
    }

    /// The scalar coefficient: the product of the cosines of half the angles.
    #[inline]
    #[must_use]
    pub fn scalar_part(&self) -> f64 {
        self.coefficients()[0]
    }

    /// The plane coefficients. For a turn by θ in one plane this is **minus** sin(θ/2) times the plane.
    #[must_use]
    pub fn bivector_part(&self) -> Bivector<N> {
        let mut b = Bivector::ZERO;
        for (p, (i, j)) in planes::all(N).enumerate() {
            b.set(i, j, self.coefficients()[1 + p]);
        }
        b
    }

    /// The reverse R~, which is the inverse rotation: the signs of planes and of the 6-vector change.
    #[inline]
    #[must_use]
    pub fn reverse(&self) -> Self {
        Self { coefficients: reverse::<N>(&self.coefficients) }
    }

    /// Sum of the products of the coefficients: the scalar part of `self` times the reverse of `other`. One for equal
    /// rotors, minus one for opposite ones, and cos(θ/2) for rotors that differ by a turn by θ in one plane.
    #[inline]
    #[must_use]
    pub fn dot(&self, other: &Self) -> f64 {
        self.coefficients().iter().zip(other.coefficients()).fold(0.0, |sum, (a, b)| sum + a * b)
    }

    /// Root of the sum of the squares of the coefficients; one to rounding. From 4D up this alone does not make a rotor
    /// valid: see [`Rotor::defect`].
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }

    /// Of `self` and −`self`, which are the same rotation, the one nearer to `reference`: keeps a series of rotors
    /// continuous in sign. A tie gives `self`.
    #[must_use]
    pub fn aligned_with(&self, reference: &Self) -> Self {
        if self.dot(reference) < 0.0 { -*self } else { *self }
    }

    /// The turned vector, R x R~, directly from the coefficients.
    #[inline]
    #[must_use]
    pub fn rotate(&self, v: Vector<N>) -> Vector<N> {
        sandwich_vector(&self.coefficients, v)
    }

    /// The vector that this rotation would turn into `v`: R~ v R.
    #[inline]
    #[must_use]
    pub fn inverse_rotate(&self, v: Vector<N>) -> Vector<N> {
        self.reverse().rotate(v)
    }

    /// The turned bivector, R B R~, directly from the coefficients.
    #[inline]
    #[must_use]
    pub fn rotate_bivector(&self, b: &Bivector<N>) -> Bivector<N> {
        let plane_slots = 1..1 + planes::count(N);
        let mut even = <Dim<N> as EvenAlgebra>::ZERO;
        for (slot, value) in plane_slots.clone().zip(b.planes()) {
            even.as_mut()[slot] = value;
        }
        let right = multiply::<N>(&even, plane_slots.clone(), &reverse::<N>(&self.coefficients), 0..Self::COUNT);
        let turned = multiply::<N>(&self.coefficients, 0..Self::COUNT, &right, plane_slots);
        Self { coefficients: turned }.bivector_part()
    }

    /// The bivector that this rotation would turn into `b`: R~ B R.
    #[inline]
    #[must_use]
    pub fn inverse_rotate_bivector(&self, b: &Bivector<N>) -> Bivector<N> {
        self.reverse().rotate_bivector(b)
    }
}

/// The part with slots in `columns` of the geometric product of the part of x with slots in `rows`, and y.
#[inline]
fn multiply<const N: usize>(
    x: &Coefficients<N>,
    rows: Range<usize>,
    y: &Coefficients<N>,
    columns: Range<usize>,
) -> Coefficients<N>
where
    Dim<N>: EvenAlgebra,
{
    let mut product = <Dim<N> as EvenAlgebra>::ZERO;
    let (x, y, out) = (x.as_ref(), y.as_ref(), product.as_mut());
    for a in rows {
        for k in columns.clone() {
            let (b, sign) = Blades::<N>::GATHER[a][k];
            out[k] += sign * x[a] * y[usize::from(b)];
        }
    }
    product
}

/// Reverses the order of the factors of every blade: k(k−1)/2 swaps for k axes.
#[inline]
fn reverse<const N: usize>(x: &Coefficients<N>) -> Coefficients<N>
where
    Dim<N>: EvenAlgebra,
{
    let mut result = *x;
    for (slot, c) in result.as_mut().iter_mut().enumerate() {
        if Blades::<N>::grade(slot) % 4 == 2 {
            *c = -*c;
        }
    }
    result
}

/// The vector part of M v M~ for any even multivector M.
///
/// A vector times e_0 is even: v e_0 = v_0 − Σ v_k e_0 e_k, in the first N slots. So with M^ = e_0 M~ e_0, which is M~ with
/// the sign of every blade that holds axis 0 changed, (M v M~) e_0 = M (v e_0) M^ is a product of even multivectors.
#[inline]
fn sandwich_vector<const N: usize>(m: &Coefficients<N>, v: Vector<N>) -> Vector<N>
where
    Dim<N>: EvenAlgebra,
{
    let turned = multiply::<N>(m, 0..Blades::<N>::COUNT, &times_mirrored_reverse::<N>(m, v), 0..N);
    Vector::from_fn(|k| if k == 0 { turned.as_ref()[0] } else { -turned.as_ref()[k] })
}

/// v M~ e_0 = (v e_0) M^; see [`sandwich_vector`].
#[inline]
fn times_mirrored_reverse<const N: usize>(m: &Coefficients<N>, v: Vector<N>) -> Coefficients<N>
where
    Dim<N>: EvenAlgebra,
{
    let mut mirrored = reverse::<N>(m);
    for (slot, c) in mirrored.as_mut().iter_mut().enumerate() {
        if Blades::<N>::AXES[slot] & 1 == 1 {
            *c = -*c;
        }
    }
    let mut even = <Dim<N> as EvenAlgebra>::ZERO;
    for k in 0..N {
        even.as_mut()[k] = if k == 0 { v[0] } else { -v[k] };
    }
    multiply::<N>(&even, 0..N, &mirrored, 0..Blades::<N>::COUNT)
}

impl<const N: usize> Default for Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl<const N: usize> Mul for Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    type Output = Self;
    /// The geometric product: the rotation by `other` followed by `self`.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let all = 0..Self::COUNT;
        Self { coefficients: multiply::<N>(&self.coefficients, all.clone(), &other.coefficients, all) }
    }
}

impl<const N: usize> Neg for Rotor<N>
where
    Dim<N>: EvenAlgebra,
{
    type Output = Self;
    /// The same rotation with the opposite sign.
    #[inline]
    fn neg(mut self) -> Self {
        for c in self.coefficients.as_mut() {
            *c = -*c;
        }
        self
    }
}
