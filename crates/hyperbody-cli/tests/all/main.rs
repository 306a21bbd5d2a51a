//! Every integration test of hyperbody-cli in one program: engine code generic in the dimension is compiled once for all of them.

mod bad_input;
mod common;
mod inspect_regular;
mod play;
mod recording;
mod render;
mod render_arguments;
mod render_failures;
mod render_limits;
mod results;
mod slice;
mod spin;
mod spin_reports;
