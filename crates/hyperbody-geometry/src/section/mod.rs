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
//! | `approximate` | [`approximate()`]: polytopes for curved bodies, with a bound on the error |

mod approximate;
mod cut;
mod fallback;
mod frame;
mod polytope;
mod solid;
mod support;

pub use approximate::{MAX_APPROXIMATION_VERTICES, approximate};
pub use cut::SectionScratch;
pub use frame::SliceFrame;
pub use polytope::SectionPolytope;
pub use solid::Solid;
pub use support::SupportMap;
