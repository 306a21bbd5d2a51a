//! Sections: the intersection of a shape with a hyperplane, one dimension down.
//!
//! [`Shape::solids`](crate::Shape::solids) gives the convex pieces of a shape, [`Solid::section`] cuts one, and the result can
//! be cut again. Where a slice is made every frame, [`SectionPolytope::section_into`] cuts polytopes without allocating.
//!
//! | module | holds |
//! |---|---|
//! | `frame` | [`SliceFrame`]: a hyperplane with coordinates on it |
//! | `solid` | [`Solid`]: what is cut, and what is left |
//! | `polytope` | [`SectionPolytope`]: a polytope as flat tables |
//! | `cut` | the exact cut of a polytope, by combinatorics |
//! | `fallback` | the same for polytopes from files of few digits |
//! | `support` | [`SupportMap`]: sections of curved bodies |
//! | `measure` | volumes of sections of curved bodies, to a given tolerance |
//! | `rounded_polytope`, `cone_cut` | those of rounded polytopes, to rounding |
//! | `density` | the same in closed form, or as one integral: polytopes, balls, capsules, products |
//! | `approximate` | [`approximate()`]: polytopes for curved bodies, with a bound on the error |

mod approximate;
mod cone_cut;
mod cut;
pub(crate) mod density;
mod fallback;
mod frame;
mod measure;
mod panels;
mod polytope;
mod rounded_polytope;
mod solid;
mod support;

pub use approximate::{MAX_APPROXIMATION_VERTICES, approximate};
pub(crate) use cone_cut::ConeCuts;
pub use cut::SectionScratch;
pub use frame::SliceFrame;
pub use polytope::SectionPolytope;
pub(crate) use rounded_polytope::SectionFunction;
pub use solid::{Solid, cut_pieces};
pub(crate) use support::InShadow;
pub use support::SupportMap;
