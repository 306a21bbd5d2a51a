//! Sections: the intersection of a shape with a hyperplane, one dimension down.
//!
//! | module | holds |
//! |---|---|
//! | `frame` | [`SliceFrame`]: a hyperplane with coordinates on it |
//! | `polytope` | [`SectionPolytope`]: what is cut and what comes out |
//! | `cut` | the exact cut of a polytope, by combinatorics |
//! | `fallback` | the same for polytopes from files of few digits |

mod cut;
mod fallback;
mod frame;
mod polytope;

pub use cut::SectionScratch;
pub use frame::SliceFrame;
pub use polytope::SectionPolytope;
