//! Random shapes of every kind and size, and pairs of them anywhere between deep and apart.

use hyperbody_collision::detect::SeparatingAxes;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Regular, Size};
use hyperbody_geometry::shape::Piece;
use hyperbody_geometry::{Core, Polytope, Shape};
use hyperbody_math::{Pose, Rotation, Vector};
use std::cell::OnceCell;
use std::sync::Arc;

use super::oracle::{Truth, convex};
use super::{Random, piece};

pub fn random_size(random: &mut Random, spread: f64) -> f64 {
    random.log_range(1.0 / spread, spread)
}

fn random_polytope<const N: usize>(random: &mut Random, size: f64) -> Option<Polytope<N>> {
    let kind = random.below(4);
    let mut points: Vec<Vector<N>> = Vec::new();
    match kind {
        // A regular polytope.
        3 => {
            let regular = match random.below(if N == 4 { 4 } else { 3 }) {
                0 => Regular::Simplex,
                1 => Regular::CrossPolytope,
                2 => Regular::Cube,
                _ => Regular::Cell24,
            };
            let solid = regular.polytope::<N>(Size::Circumradius(size)).ok()?;
            points.extend_from_slice(solid.vertices());
        }
        // A few points on a sphere.
        0 => points.extend((0..N + 1 + random.below(N + 4)).map(|_| random.direction::<N>() * size)),
        // A cross-polytope stretched along its axes.
        1 => {
            for axis in 0..N {
                let reach = size * random.range(0.3, 1.0);
                points.extend([Vector::unit(axis) * reach, -Vector::unit(axis) * reach]);
            }
        }
        // A grid: many points, many coplanar.
        _ => points.extend((0..3 * N).map(|_| Vector::from_fn(|_| size * (random.below(3) as f64 - 1.0)))),
    }
    if random.below(6) == 0 {
        let axis = random.below(N);
        points.iter_mut().for_each(|p| p[axis] *= 1e-2);
    }
    Polytope::from_points(&points).ok()
}

/// A factor on `K` axes from `first` on.
fn random_factor<const K: usize>(random: &mut Random, first: usize, size: f64) -> Option<Factor> {
    let axes: [usize; K] = std::array::from_fn(|i| first + i);
    let size = size * random.range(0.1, 1.0);
    let polytope = random_polytope::<K>(random, size)?;
    Factor::new(axes, &Shape::polytope(Arc::new(polytope)).ok()?).ok()
}

/// A pyramid, a cone, or a product of segments, polygons, solids and now and then a disc.
fn random_product<const N: usize>(random: &mut Random, size: f64) -> Option<Shape<N>> {
    // The polytopes of discs have dozens of vertices, which the independent methods pay for.
    let mut discs = usize::from(N < 5 && random.below(16) == 0);
    let mut disc = |random: &mut Random, first: usize| {
        if discs == 0 {
            return random_factor::<2>(random, first, size);
        }
        discs -= 1;
        Factor::new([first, first + 1], &Shape::<2>::ball(size * random.range(0.1, 1.0)).ok()?).ok()
    };
    if N < 5 && random.below(4) == 0 {
        let base = match N {
            2 => Factor::segment(0, size).ok()?,
            3 => disc(random, 0)?,
            _ => random_factor::<3>(random, 0, size)?,
        };
        return Shape::pyramid(base, size * random.range(0.3, 2.0)).ok();
    }
    let mut factors = Vec::new();
    let mut first = 0;
    while first < N {
        let dimensions = 1 + random.below((N - first).min(N - 1).min(3));
        factors.push(match dimensions {
            1 => Factor::segment(first, size * random.range(0.1, 1.0)).ok()?,
            2 => disc(random, first)?,
            _ => random_factor::<3>(random, first, size)?,
        });
        first += dimensions;
    }
    Shape::product(factors).ok()
}

fn random_piece<const N: usize>(random: &mut Random, size: f64) -> Piece<N> {
    let cuboid = |random: &mut Random| {
        let flat = random.below(6) == 0;
        let half = Vector::from_fn(|_| size * if flat { random.log_range(1e-3, 1.0) } else { random.range(0.2, 1.0) });
        Shape::cuboid(half).expect("half-extents in range")
    };
    let polytope = |random: &mut Random| {
        // A hull can fail on a draw of coplanar points; a box never does.
        match random_polytope(random, size) {
            Some(polytope) => Shape::polytope(Arc::new(polytope)).expect("a solid polytope"),
            None => cuboid(random),
        }
    };
    let shape = match random.below(9) {
        0 => Shape::ball(size),
        1 => Shape::capsule(size * random.range(0.1, 1.0), size * random.range(0.05, 1.0), random.below(N)),
        2 => {
            let core = if random.below(2) == 0 { cuboid(random) } else { polytope(random) };
            Shape::rounded(core, size * random.range(0.01, 0.3))
        }
        3..=5 => Ok(cuboid(random)),
        6 => Ok(random_product(random, size).unwrap_or_else(|| cuboid(random))),
        _ => Ok(polytope(random)),
    };
    piece(shape.expect("lengths in range"))
}

pub fn random_rotation<const N: usize>(random: &mut Random) -> Rotation<N> {
    match random.below(5) {
        0 => Rotation::IDENTITY,
        1 => Rotation::in_plane(0, 1, std::f64::consts::FRAC_PI_2),
        2 => random.rotation(1e-4),
        _ => random.rotation(3.0),
    }
}

/// Places b so that the pair is anywhere between deep and apart, with a liking for the exact coincidences.
fn place<const N: usize>(random: &mut Random, a: &Piece<N>, b: &Piece<N>, small: f64) -> (Pose<N>, Pose<N>) {
    let mut pose_a = Pose::new(random_rotation(random), random.vector(1.0));
    if random.below(3) == 0 {
        pose_a = Pose::IDENTITY;
    }
    let mut pose_b = Pose::new(random_rotation(random), pose_a.translation);
    match random.below(8) {
        // Identical poses, and the same place with another rotation.
        0 => return (pose_a, pose_a),
        1 => return (pose_a, pose_b),
        _ => {}
    }
    if random.below(3) == 0 {
        pose_b.rotation = pose_a.rotation;
    }
    // Off to a side, then along a direction until the gap along it is as drawn.
    let n = if random.below(3) == 0 {
        pose_a.rotation.rotate(Vector::unit(random.below(N)))
    } else {
        random.direction::<N>()
    };
    let reach = convex(a).bounding_radius().min(convex(b).bounding_radius());
    if random.below(2) == 0 {
        pose_b.translation += random.vector(0.5 * reach);
    }
    let truth = Truth::new(convex(a), &pose_a, convex(b), &pose_b);
    let gap = match random.below(5) {
        0 => 0.0,
        1 => random.range(-1e-2, 1e-2) * small,
        2 => -random.log_range(1e-9, 1e-3) * small,
        _ => random.range(-1.0, 0.1) * small,
    };
    pose_b.translation += n * (gap - truth.separation(n) + truth.rounding);
    (pose_a, pose_b)
}

/// A drawn pair.
pub struct Pair<const N: usize> {
    pub a: Piece<N>,
    pub b: Piece<N>,
    pub pose_a: Pose<N>,
    pub pose_b: Pose<N>,
    /// Says which draw it is and what was drawn.
    pub name: String,
    /// The lesser bounding radius.
    pub small: f64,
    /// For whatever else the draw decides.
    pub random: Random,
}

/// Consecutive pairs that are of the same two shapes, each time placed anew: making a polytope of six dimensions costs more
/// than all that is asked of it.
pub const PLACEMENTS: u64 = 4;

/// The two shapes of [`PLACEMENTS`] pairs.
pub struct Shapes<const N: usize> {
    group: u64,
    pub a: Piece<N>,
    pub b: Piece<N>,
    pub axes: [OnceCell<SeparatingAxes<N>>; 2],
}

impl<const N: usize> Shapes<N> {
    /// Those of the pair of the given number: what was drawn last, if that is them.
    pub fn of(last: Option<Self>, seed: u64, index: u64, spread: f64) -> Self {
        let group = index / PLACEMENTS;
        if let Some(same) = last.filter(|last| last.group == group) {
            return same;
        }
        let mut random = Random(!seed.wrapping_mul(0x9e37_79b9).wrapping_add(group));
        let size_a = random_size(&mut random, spread);
        let size_b = if random.below(2) == 0 { size_a } else { random_size(&mut random, spread) };
        let a = random_piece::<N>(&mut random, size_a);
        let b = if random.below(6) == 0 { a.clone() } else { random_piece::<N>(&mut random, size_b) };
        Self { group, a, b, axes: Default::default() }
    }
}

/// What places the pair of the given number.
pub fn placing(seed: u64, index: u64) -> Random {
    Random(seed.wrapping_mul(0x9e37_79b9).wrapping_add(index))
}

/// The pair of the given number: the same for ever.
pub fn draw<const N: usize>(seed: u64, index: u64, spread: f64) -> Pair<N> {
    draw_of(&Shapes::of(None, seed, index, spread), seed, index)
}

/// The same, of its shapes.
pub fn draw_of<const N: usize>(shapes: &Shapes<N>, seed: u64, index: u64) -> Pair<N> {
    let mut random = placing(seed, index);
    let (a, b) = (shapes.a.clone(), shapes.b.clone());
    let small = convex(&a).bounding_radius().min(convex(&b).bounding_radius());
    let (pose_a, pose_b) = place(&mut random, &a, &b, small);
    let name = format!("N = {N}, seed {seed}, pair {index}, {} and {}", kind(&a), kind(&b));
    Pair { a, b, pose_a, pose_b, name, small, random }
}

/// What a piece is, in words.
pub fn kind<const N: usize>(piece: &Piece<N>) -> String {
    let core = match &convex(piece).core {
        Core::Point => "point".to_owned(),
        Core::Segment { half } => format!("segment {:?}", half.0),
        Core::Box { half_extents } => format!("box {:?}", half_extents.0),
        Core::Polytope(polytope) => {
            format!("polytope of {} vertices, {} facets", polytope.vertices().len(), polytope.facets().len())
        }
    };
    format!("{core} rounded by {}", convex(piece).radius)
}
