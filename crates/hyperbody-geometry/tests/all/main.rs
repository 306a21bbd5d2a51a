//! Every integration test of hyperbody-geometry in one program: engine code generic in the dimension is compiled once for all of them.

mod closed_sections;
mod common;
mod hull;
mod hull_noise;
mod mass;
mod meshes;
mod off;
mod pieces;
mod products;
mod products_of_pieces;
mod projections;
mod pyramids;
mod regular;
mod rounded;
mod second_hull;
mod section_table;
mod section_volumes;
mod sections;
mod sections_curved;
mod shapes;
mod stars;
mod surfaces;
