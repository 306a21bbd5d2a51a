//! Shared by the tests of this crate.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use hyperbody_dynamics::{BodyDef, BodyHandle, Material, World, WorldDef};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Matrix, Rotation, Vector};

/// Tests of checks that are written once for every dimension.
macro_rules! in_all_dimensions {
    ($($name:ident: $check:ident;)*) => { $(
        #[test]
        fn $name() {
            $check::<2>();
            $check::<3>();
            $check::<4>();
            $check::<5>();
            $check::<6>();
        }
    )* };
}
pub(crate) use in_all_dimensions;

pub const GRAVITY: f64 = 9.81;

/// A small generator with a fixed algorithm (SplitMix64, S. Vigna, 2015): the same scenes for ever.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn rotation<const N: usize>(&mut self, largest: f64) -> Rotation<N> {
        let mut turn = Bivector::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                turn.set(i, j, self.between(-largest, largest));
            }
        }
        Rotation::exp(&turn)
    }

    pub fn vector<const N: usize>(&mut self, largest: f64) -> Vector<N> {
        Vector::from_fn(|_| self.between(-largest, largest))
    }
}

pub fn world<const N: usize>(gravity: Vector<N>) -> World<N> {
    World::new(WorldDef { gravity, sleeping: false, ..WorldDef::default() }).unwrap()
}

pub fn down<const N: usize>() -> Vector<N> {
    Vector::unit(1) * -GRAVITY
}

/// Gravity as on an incline of `angle` that falls towards +x, with the incline itself lying at y = 0.
pub fn incline_gravity<const N: usize>(angle: f64) -> Vector<N> {
    Vector::unit(0) * (GRAVITY * angle.sin()) - Vector::unit(1) * (GRAVITY * angle.cos())
}

pub fn material(friction: f64, restitution: f64) -> Material {
    Material { friction, restitution, ..Material::default() }
}

pub fn ball<const N: usize>(radius: f64) -> Shape<N> {
    Shape::ball(radius).unwrap()
}

pub fn cuboid<const N: usize>(half_extents: Vector<N>) -> Shape<N> {
    Shape::cuboid(half_extents).unwrap()
}

pub fn add_floor<const N: usize>(world: &mut World<N>, material: Material) -> BodyHandle {
    let floor = Shape::half_space(Vector::unit(1), 0.0).unwrap();
    world.add_body(BodyDef::fixed(floor).material(material)).unwrap()
}

pub fn run<const N: usize>(world: &mut World<N>, seconds: f64) {
    let steps = (seconds / world.dt()).round() as usize;
    for _ in 0..steps {
        world.step();
    }
}

#[track_caller]
pub fn assert_close(what: &str, got: f64, expected: f64, relative: f64) {
    let error = (got - expected).abs();
    assert!(
        error <= relative * expected.abs(),
        "{what}: got {got}, expected {expected}, off by {error} (allowed {relative} of it)"
    );
}

/// The paper's response matrix of one body: K = 1/m + [r]⋆ᵀ I⁻¹ [r]⋆, for an isotropic or axis-aligned body with moments
/// J_i + J_j in the frame `rotation`.
pub fn response<const N: usize>(mass: f64, moments: Vector<N>, rotation: Rotation<N>, r: Vector<N>) -> Matrix<N> {
    let mut k = Matrix::from_diagonal(Vector::splat(1.0 / mass));
    for axis in 0..N {
        let torque = rotation.inverse_rotate_bivector(&Bivector::wedge(r, Vector::unit(axis)));
        let spin = rotation.rotate_bivector(&torque.scale_planes(|i, j| 1.0 / (moments[i] + moments[j])));
        let u = spin.act_on(r);
        for row in 0..N {
            k[row][axis] += u[row];
        }
    }
    k
}

/// Complete elliptic integral K of modulus k, by the arithmetic–geometric mean (C. F. Gauss).
pub fn elliptic_k(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}
