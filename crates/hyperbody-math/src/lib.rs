//! Linear and geometric algebra in `N` dimensions, `N` = 2..=6, written once for every `N`.
//!
//! | module | holds |
//! |---|---|
//! | [`vector`] | points and directions |
//! | [`matrix`] | square matrices, determinants, solving |
//! | [`eigen`] | eigenvalues and eigenvectors of symmetric matrices |
//! | [`bivector`] | oriented planes: angular velocity, angular momentum, torque |
//! | [`givens`] | turns in one coordinate plane |
//! | [`rotation`] | orthogonal matrices of determinant one |
//! | [`rotor`] | rotations as even multivectors: 8 numbers in 4D |
//! | [`invariant`] | the planes that a bivector or rotation turns independently |
//! | [`pose`] | a rotation followed by a translation |
//! | [`planes`] | the order of the coordinate planes and the names of the axes |
//! | [`scalar`] | the only door to transcendental functions, the same bits on every platform |
//!
//! Conventions: axes are x y z w v u; planes are axis pairs (i, j), i < j, in lexicographic order; a positive angle in
//! plane (i, j) turns axis i towards axis j.

pub mod bivector;
pub mod eigen;
pub mod givens;
pub mod invariant;
pub mod matrix;
mod order;
pub mod planes;
mod polar;
pub mod pose;
pub mod rotation;
pub mod rotor;
pub mod scalar;
pub mod vector;

pub use bivector::Bivector;
pub use eigen::symmetric_eigen;
pub use givens::Givens;
pub use invariant::InvariantPlanes;
pub use matrix::Matrix;
pub use pose::Pose;
pub use rotation::Rotation;
pub use rotor::{Dim, EvenAlgebra, Rotor, RotorError, RotorErrorKind};
pub use vector::Vector;
