//! Shapes of `N`-dimensional bodies: what they are, their supports, and their mass properties.
//!
//! | module | holds |
//! |---|---|
//! | [`shape`] | [`Shape`]: everything a body can be made of |
//! | [`convex`] | [`Convex`]: a core rounded by a radius, the form in which collision sees every convex shape |
//! | [`polytope`] | [`Polytope`]: vertices, facets and their incidences |
//! | [`face_lattice`] | [`FaceLattice`]: the faces of a polytope of all ranks |
//! | [`hull`] | the convex hull of points |
//! | [`product`] | [`Product`](product::Product): products of shapes of lower dimension |
//! | [`regular`] | the regular polytopes by name |
//! | [`off`] | OFF files |
//! | [`section`] | [`SectionPolytope`]: sections by hyperplanes |
//! | [`projection`] | [`Projection`]: bodies seen along an axis, in parallel or in perspective |
//! | [`pyramid`] | [`Pyramid`](pyramid::Pyramid): pyramids and cones over shapes of one dimension less |
//! | [`star`] | the regular star polytopes, and any other, from a Schläfli symbol |
//! | [`decompose`] | [`convex_cells`](decompose::convex_cells): convex cells of solids that are not convex |
//! | [`mass`] | [`MassProperties`]: volume, centre, second moments, principal frame |
//! | [`volume`] | volumes of balls |
//! | [`bytes`] | numbers and shapes as bytes, for states that are stored |
//! | [`aabb`] | [`Aabb`]: axis-aligned boxes |
//! | [`surface`] | [`Surface`]: sections in three dimensions, as polygons and as STL, OBJ, OFF and GLB files |
//! | [`tolerances`] | every limit and tolerance, with its reason |
//! | [`error`] | [`GeometryError`] |

pub mod aabb;
pub mod bytes;
pub mod convex;
pub mod decompose;
pub mod error;
pub mod face_lattice;
pub mod hull;
mod incidence;
pub mod mass;
pub mod off;
mod order;
pub mod polytope;
pub mod product;
pub mod projection;
pub mod pyramid;
mod quadrature;
pub mod regular;
mod round_parts;
pub mod section;
pub mod shape;
pub mod star;
pub mod surface;
pub mod tolerances;
pub mod volume;

pub use aabb::Aabb;
pub use convex::{Convex, Core};
pub use error::{GeometryError, GeometryErrorKind, Result};
pub use face_lattice::{Face, FaceLattice};
pub use mass::MassProperties;
pub use off::OffFile;
pub use polytope::Polytope;
pub use projection::{Projection, Wireframe};
pub use round_parts::TurnedToward;
pub use section::{SectionPolytope, SectionScratch, SliceFrame, Solid, SupportMap, cut_pieces};
pub use shape::{Piece, Shape};
pub use surface::Surface;
