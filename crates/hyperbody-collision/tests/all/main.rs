//! Every integration test of hyperbody-collision in one program: engine code generic in the dimension is compiled once for all of them.

#[macro_use]
mod common;

mod degenerate;
mod detectors;
mod fuzz;
mod manifolds;
mod persistence;
mod queries;
mod ray_shapes;
mod shape_casts;
mod tree;
mod tree_rays;
mod tree_upkeep;
