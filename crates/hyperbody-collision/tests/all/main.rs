//! Every integration test of hyperbody-collision in one program: engine code generic in the dimension is compiled once for all of them.

#[macro_use]
mod common;

mod degenerate;
mod fuzz;
mod manifolds;
mod persistence;
mod ray_shapes;
mod tree;
mod tree_rays;
