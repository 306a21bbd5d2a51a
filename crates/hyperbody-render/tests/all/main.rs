//! Every integration test of hyperbody-render in one program: engine code generic in the dimension is compiled once for all of them.

mod areas;
mod beside;
mod cameras;
mod common;
mod scales;
mod sections;
