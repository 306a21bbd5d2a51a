//! Every limit and tolerance of this crate, each with its reason.

/// Smallest length of a shape, in metres. In six dimensions the second moments of a body of this size are about
/// 1e-48 kg·m² at unit density: small, but far from underflow (1e-308), also after the divisions of the solver.
pub const MIN_LENGTH: f64 = 1e-6;

/// Largest length or coordinate of a shape, in metres. A position of this size is still resolved to 1e-10 m, which is
/// what contacts of metre-sized bodies need; and (10⁶)⁸ is far from overflow.
pub const MAX_LENGTH: f64 = 1e6;

/// Smallest density, in kg/m^N. Bodies of any allowed size then have masses and moments far above underflow, and so have
/// their inverses below overflow.
pub const MIN_DENSITY: f64 = 1e-30;

/// Largest density, in kg/m^N, for the same reason; nuclear matter has 1e17 in three dimensions.
pub const MAX_DENSITY: f64 = 1e30;

/// Most parts of a compound. Every part is a leaf of the broad phase; beyond this the input is a mistake.
pub const MAX_PARTS: usize = 1 << 20;

/// Points closer than this to a hyperplane lie in it when a hull is made, relative to the half-width of the point set.
/// Coordinates in closed form are off by 1e-16 and planes through them by 1e-14 or so; a feature that is meant is
/// larger than 1e-10 of the body.
pub const HULL_TOLERANCE: f64 = 1e-10;

/// Tolerances tried, each this many times the one before, when rounding makes the facets contradict each other.
pub(crate) const HULL_TOLERANCE_GROWTH: f64 = 10.0;

/// Largest tolerance that is tried without having been asked for: the precision of coordinates stored with seven digits. A
/// hyperplane much thicker than the coordinates are precise swallows facets that are meant.
pub(crate) const MAX_GROWN_TOLERANCE: f64 = 1.001e-7;

/// How often a hull is tried at most.
pub(crate) const HULL_ATTEMPTS: u32 = 4;

/// Points that lie this close to a flat of lower dimension have no hull, relative to the half-width of the point set:
/// thinner bodies could not be told from the errors of their own facets.
pub const FLATNESS: f64 = 1e-8;

/// Vertices this close to a hyperplane lie in it when a polytope is cut, in parts of its size and distance from the origin:
/// hundreds of times what rounding does to a vertex and a frame, and far below anything that can be seen or held.
pub const SECTION_TOLERANCE: f64 = 1e-12;

/// Most cuts when a solid is cut into convex cells: every cell is a piece that collides on its own.
pub const MAX_CELLS: usize = 4096;

/// Most work for cutting a solid into convex cells, in about half microseconds: ten seconds.
pub(crate) const MAX_CUTTING_WORK: usize = 20_000_000;

/// Most work for telling which pieces of a surface lie within others, in looks at a box: some seconds.
pub(crate) const MAX_NESTING_WORK: usize = 500_000_000;

/// Tolerances of hulls (in parts of half the extent) by which facets are joined that coordinates of few digits have split: from
/// what ten digits leave to what four do.
pub(crate) const JOINING_TOLERANCES: [f64; 5] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// Most cells among which pairs are sought that can be joined: all pairs are tried, each with a hull.
pub(crate) const MAX_JOINED_CELLS: usize = 128;

/// Most points of a hull: their indices and distances must fit into memory without a second thought.
pub const MAX_HULL_POINTS: usize = 1 << 22;

/// Most simplices a hull may have at any time. In six dimensions the facets of a hull can outnumber its points by the
/// square; this bounds them to about 100 MB.
pub const MAX_HULL_SIMPLICES: usize = 1 << 19;

/// From this number of vertices on, the support of a polytope is found by climbing along edges; below it, looking at
/// all vertices is faster.
pub(crate) const MIN_CLIMBING_VERTICES: usize = 48;

/// Most vertices of a regular polygon: with more, its corners would be too close to straight for the hull.
pub const MAX_POLYGON: usize = 10_000;

/// How far a curved factor of a product, by its dimension, may be from the polytope that contacts see in its place, in parts
/// of its radius. In the plane that is a 32-gon; in more dimensions the number of facets would grow too fast for that.
pub(crate) const FACETING: [f64; 5] = [0.0, 0.0, 0.005, 0.01, 0.03];

/// Where a product would have too many vertices, its curved factors are taken this many times coarser, again and again.
pub(crate) const COARSENING: f64 = 1.25;

/// Beyond this many times nothing is gained any more.
pub(crate) const MOST_COARSER: f64 = 60.0;

/// How far such a polytope may be from the factor at most, in parts of its radius: a ball still has dozens of facets.
pub(crate) const COARSEST: f64 = 0.3;

/// Most vertices of a product: finding the edges takes time with the square of it, seconds here.
pub const MAX_PRODUCT_VERTICES: usize = 4096;

/// Most convex pieces of a product: more than the largest star has cells, and each is a polytope of its own that collides.
pub const MAX_PRODUCT_PIECES: usize = 1 << 16;

/// Most work for the solid angles of a rounded polytope, in tens of microseconds: about ten seconds. All regular
/// polytopes stay far below; hulls of many random points in five and six dimensions do not.
pub(crate) const MAX_CONE_WORK: u64 = 1_000_000;
