//! Every integration test of hyperbody-render in one program: engine code generic in the dimension is compiled once for all of them.

mod common;
mod sections;
