//! Every integration test of hyperbody-math in one program: engine code generic in the dimension is compiled once for all of them.

mod common;

mod bivector;
mod eigen;
mod exponential;
mod invariant;
mod repair;
mod rotor;
