//! Every integration test of hyperbody-scene in one program: engine code generic in the dimension is compiled once for all of them.

mod gallery;
mod gallery_sentences;
mod hostile_recordings;
mod hostile_text;
mod mesh_bodies;
mod mesh_convexity;
mod recording;
mod round_trip;
mod shapes_rest;
