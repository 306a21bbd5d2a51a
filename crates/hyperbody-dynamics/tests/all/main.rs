//! Every integration test of hyperbody-dynamics in one program: engine code generic in the dimension is compiled once for all of them.

mod bullets;
mod common;
mod contact_table;
mod events;
mod filters;
mod free_top_common;
mod free_top_elliptic;
mod free_top_equations;
mod free_top_exact;
mod free_top_proportional;
mod free_top_runs;
mod free_top_stability;
mod free_top_step;
mod joint_hand;
mod joint_kinds;
mod joint_loads;
mod materials;
mod queries;
mod queries_shapes;
mod random_operations;
mod robustness;
mod seams;
mod snapshot;
mod stacks_and_piles;
mod steering;
mod symmetry;
