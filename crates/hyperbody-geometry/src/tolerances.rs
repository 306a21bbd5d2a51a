//! Every limit and tolerance of this crate, each with its reason.

/// Smallest length of a shape, in metres. In six dimensions the second moments of a body of this size are about
/// 1e-48 kg·m² at unit density: small, but far from underflow (1e-308), also after the divisions of the solver.
pub const MIN_LENGTH: f64 = 1e-6;

/// Largest length or coordinate of a shape, in metres. A position of this size is still resolved to 1e-10 m, which is
/// what contacts of metre-sized bodies need; and (10⁶)⁸ is far from overflow.
pub const MAX_LENGTH: f64 = 1e6;

/// Most parts of a compound. Every part is a leaf of the broad phase; beyond this the input is a mistake.
pub const MAX_PARTS: usize = 1 << 20;
