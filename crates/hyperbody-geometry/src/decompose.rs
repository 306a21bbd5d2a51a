//! Convex cells of a solid that is not convex, in any dimension.
//!
//! The hull of the solid is cut by the hyperplane of a piece of its surface that passes through the inside of a cell, and so on
//! in both halves until no surface passes through any cell: a binary space partition (H. Fuchs, Z. Kedem, B. Naylor, 1980).
//! Then each cell is all inside or all outside, which the winding number of the surface around its middle tells. Nothing of
//! this knows the dimension, and every step works on convex polytopes, where hulls are robust. Neighbouring cells whose
//! union is convex are joined again, because a partition cuts more than it has to.
//!
//! Decompositions that only come close to the solid (as K. Mamou's V-HACD does in 3D) make fewer pieces, but other bodies.

use hyperbody_math::{Matrix, Vector};

use crate::error::GeometryErrorKind::{BadCount, BadMesh};
use crate::hull::plane::Hyperplane;
use crate::mass::MassProperties;
use crate::order;
use crate::tolerances::{MAX_CELLS, MAX_CUTTING_WORK, MAX_JOINED_CELLS};
use crate::{GeometryError, Polytope, Result};

/// Lengths below this, in parts of the size of the solid, are none.
const TOLERANCE: f64 = 1e-9;

/// Depth in tolerances from which nothing is doubtful.
const CLEARLY: f64 = 1e3;

/// Steps of the search for a point of a wall that is clearly within a cell.
const SEARCH_STEPS: usize = 40;

/// How many corners and facets of a cell are looked at in half a microsecond.
const LOOKS: usize = 150;

/// How many pieces of surface are tried for the one whose hyperplane cuts the fewest others.
const CANDIDATES: usize = 8;

/// Convex polytopes that fill the solid bounded by `surface` without overlapping: simplices of `N` points with neighbours
/// oriented alike, such as [`OffFile::boundary`](crate::OffFile::boundary) gives. Regions around which the surface winds
/// more than once count once.
///
/// # Errors
/// `BadMesh` or as [`MassProperties::of_closed_boundary`] if the surface is not closed; `BadCount` if more than
/// [`MAX_CELLS`] cells are needed, or cutting them would take minutes; as [`Polytope::from_points`] if the solid is flat.
pub fn convex_cells<const N: usize>(points: &[Vector<N>], surface: &[[u32; N]]) -> Result<Vec<Polytope<N>>> {
    let whole = MassProperties::of_closed_boundary(points, surface)?;
    let used: Vec<Vector<N>> = surface.iter().flatten().map(|&v| points[v as usize]).collect();
    let hull = Polytope::from_points(&used)?;
    let size = hull.translated(-hull.vertex_mean()).bounding_radius();
    let tolerance = TOLERANCE * size;
    let pieces: Vec<[Vector<N>; N]> = surface.iter().map(|simplex| simplex.map(|v| points[v as usize])).collect();
    let all: Vec<Wall<N>> = pieces.iter().filter_map(|corners| Wall::new(*corners)).collect();
    let (mut cells, mut simple) = (Vec::new(), true);
    for cell in partition(hull, &all, tolerance)? {
        let winding = winding_number(&pieces, cell.vertex_mean())?;
        simple &= winding == 0 || winding == 1;
        if winding != 0 {
            cells.push(cell);
        }
    }
    let cells = join(cells, tolerance);
    let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    // Surfaces that wind more than once bound more than they fill.
    if cells.is_empty() || content > whole.mass * (1.0 + 1e-6) {
        return Err(GeometryError::new(
            BadMesh,
            "the surface crosses itself in a way that leaves no clear inside".to_string(),
        ));
    }
    if simple && content < whole.mass * (1.0 - 1e-6) {
        let message =
            "parts of the solid are too thin to be told from its surface: use a simpler mesh, or a thicker one";
        return Err(GeometryError::new(BadMesh, message.to_string()));
    }
    Ok(cells)
}

/// A cell that is cut further.
struct Uncut<const N: usize> {
    cell: Polytope<N>,
    /// The walls that pass through it.
    crossing: Vec<usize>,
    /// In how many hyperplanes they lie: each of them has to be one of the cuts.
    planes: usize,
    /// Which side of each cut it is on, so that cells come in the same order in whatever order they are cut.
    sides: Vec<u32>,
}

/// Cuts a polytope by hyperplanes of walls until none passes through any cell. What is cut most comes first, so that a surface that takes
/// too many cuts is known early, by the hyperplanes that are still to come.
fn partition<const N: usize>(hull: Polytope<N>, all: &[Wall<N>], tolerance: f64) -> Result<Vec<Polytope<N>>> {
    let mut done: Vec<(Vec<u32>, Polytope<N>)> = Vec::new();
    let mut waiting: Vec<Uncut<N>> = Vec::new();
    let mut halves = vec![(hull, (0..all.len()).collect::<Vec<usize>>(), Vec::new())];
    let (mut cuts, mut planes_left, mut work) = (0, 0, 0);
    loop {
        for (cell, near, sides) in halves.drain(..) {
            work += effort(&cell);
            let mut passing = |&wall: &usize| work <= MAX_CUTTING_WORK && all[wall].passes(&cell, tolerance, &mut work);
            let crossing: Vec<usize> = near.into_iter().filter(&mut passing).collect();
            if work > MAX_CUTTING_WORK {
                return Err(too_long::<N>(cuts, (cuts + planes_left).max(1)));
            }
            if crossing.is_empty() {
                done.push((sides, cell));
                continue;
            }
            let planes = count_planes(all, &crossing, tolerance);
            planes_left += planes;
            waiting.push(Uncut { cell, crossing, planes, sides });
        }
        if cuts + planes_left > MAX_CELLS {
            let message = format!(
                "the solid takes {} cuts or more to come apart into convex cells, and {MAX_CELLS} is the limit: use a simpler \
                 mesh (of some 1000 triangles), or several meshes as parts of a compound",
                cuts + planes_left
            );
            return Err(GeometryError::new(BadCount, message));
        }
        let Some(most) = (0..waiting.len()).max_by_key(|&index| waiting[index].planes) else { break };
        let Uncut { cell, crossing, planes, sides } = waiting.swap_remove(most);
        planes_left -= planes;
        cuts += 1;
        let Some(plane) = best_plane(all, &crossing, tolerance) else { continue };
        for (side, plane) in [(1, plane), (0, plane.flipped())] {
            if let Some(half) = clip(&cell, &plane, tolerance) {
                halves.push((half, crossing.clone(), [&sides[..], &[side]].concat()));
            }
        }
    }
    let order = order::of_lists(&done.iter().map(|(sides, _)| &sides[..]).collect::<Vec<_>>());
    let mut cells: Vec<Option<Polytope<N>>> = done.into_iter().map(|(_, cell)| Some(cell)).collect();
    Ok(order.into_iter().filter_map(|place| cells[place].take()).collect())
}

/// What it takes to make the hull of a polytope, roughly, in half microseconds. From four dimensions on every vertex has to do with
/// most of the facets on the way.
fn effort<const N: usize>(polytope: &Polytope<N>) -> usize {
    match N {
        2 | 3 => 6 * polytope.facets().iter().map(|facet| facet.vertices.len()).sum::<usize>(),
        _ => polytope.vertices().len() * polytope.facets().len(),
    }
}

fn too_long<const N: usize>(cuts: usize, needed: usize) -> GeometryError {
    let message = format!(
        "the solid takes too long to come apart into convex cells: {cuts} cuts are made of {needed} or more, and in {N} dimensions each \
         is that much work; use a simpler mesh, or several meshes as parts of a compound"
    );
    GeometryError::new(BadCount, message)
}

/// In how many hyperplanes walls lie, at least; counted until there are too many.
fn count_planes<const N: usize>(all: &[Wall<N>], walls: &[usize], tolerance: f64) -> usize {
    let mut planes: Vec<&Hyperplane<N>> = Vec::new();
    for &wall in walls {
        // Twice as wide as walls are told apart elsewhere: rather too few than too many.
        let lies_in =
            |plane: &&&Hyperplane<N>| all[wall].corners.iter().all(|&c| plane.distance(c).abs() <= 2.0 * tolerance);
        if !planes.iter().rev().any(|plane| lies_in(&plane)) {
            planes.push(&all[wall].plane);
        }
        if planes.len() > MAX_CELLS {
            break;
        }
    }
    planes.len()
}

/// A simplex of the surface.
pub(crate) struct Wall<const N: usize> {
    corners: [Vector<N>; N],
    plane: Hyperplane<N>,
    /// Through each side of the simplex along the normal; the simplex is below all of them.
    sides: Vec<Hyperplane<N>>,
}

impl<const N: usize> Wall<N> {
    /// `None` if it has no area.
    pub(crate) fn new(corners: [Vector<N>; N]) -> Option<Self> {
        let plane = Hyperplane::through(&corners)?;
        let size = corners.iter().map(|c| c.distance(corners[0])).fold(0.0, f64::max);
        let mut sides = Vec::with_capacity(N);
        for opposite in 0..N {
            // The corner itself moves to stand over another one.
            let mut through = corners;
            through[opposite] = corners[(opposite + 1) % N] + plane.normal * size;
            let side = Hyperplane::through(&through)?;
            sides.push(if side.distance(corners[opposite]) > 0.0 { side.flipped() } else { side });
        }
        Some(Self { corners, plane, sides })
    }

    /// Whether a point is on the wall or closer to it than `margin`; near sharp corners it may be a little farther.
    pub(crate) fn is_near(&self, point: Vector<N>, margin: f64) -> bool {
        self.plane.distance(point).abs() <= margin && self.sides.iter().all(|side| side.distance(point) <= margin)
    }

    /// Whether the wall passes through the inside of a cell; the effort of finding out is added to `work`.
    fn passes(&self, cell: &Polytope<N>, tolerance: f64, work: &mut usize) -> bool {
        *work += (cell.vertices().len() + cell.facets().len()) / LOOKS;
        let outside =
            |normal: Vector<N>, offset: f64| self.corners.iter().all(|c| normal.dot(*c) - offset > -tolerance);
        if !divides(&self.plane, cell, tolerance) || cell.facets().iter().any(|f| outside(f.normal, f.offset)) {
            return false;
        }
        let beyond = |side: &Hyperplane<N>| cell.vertices().iter().all(|&v| side.distance(v) > -tolerance);
        if self.sides.iter().any(beyond) {
            return false;
        }
        if self.is_clearly_within(cell, CLEARLY * tolerance) {
            return true;
        }
        let mut rest = cell.clone();
        for side in &self.sides {
            match clip(&rest, side, tolerance) {
                Some(clipped) => {
                    *work += effort(&clipped);
                    rest = clipped;
                }
                None => return false,
            }
        }
        divides(&self.plane, &rest, tolerance)
    }

    /// Whether a point of the wall is found that is deeper than `depth` within the cell and within the wall, which spares making hulls:
    /// from the middle of the wall, away from whatever is nearest, again and again (S. Agmon, T. Motzkin, 1954). False may mean that
    /// there is none.
    fn is_clearly_within(&self, cell: &Polytope<N>, depth: f64) -> bool {
        let mut point = self.corners.iter().fold(Vector::ZERO, |sum, &c| sum + c) / N as f64;
        let size = self.corners[0].distance(point);
        for _ in 0..SEARCH_STEPS {
            let facets = cell.facets().iter().map(|f| (f.offset - f.normal.dot(point), f.normal));
            let sides = self.sides.iter().map(|side| (-side.distance(point), side.normal));
            let Some((least, outward)) = facets.chain(sides).min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
            if least > depth {
                return true;
            }
            // Within the hyperplane of the wall, and a little farther than to the edge.
            let along = outward - self.plane.normal * self.plane.normal.dot(outward);
            let length_sq = along.norm_sq();
            if length_sq < 1e-12 {
                return false;
            }
            point -= along * ((1.2 * (depth - least) + 0.01 * size) / length_sq);
        }
        false
    }
}

/// Whether a polytope has points clearly on both sides.
fn divides<const N: usize>(plane: &Hyperplane<N>, cell: &Polytope<N>, tolerance: f64) -> bool {
    let heights = || cell.vertices().iter().map(|&v| plane.distance(v));
    heights().any(|h| h > tolerance) && heights().any(|h| h < -tolerance)
}

/// Of a few hyperplanes the one that cuts the fewest other walls.
fn best_plane<const N: usize>(all: &[Wall<N>], crossing: &[usize], tolerance: f64) -> Option<Hyperplane<N>> {
    let step = crossing.len().div_ceil(CANDIDATES).max(1);
    let cost = |plane: &Hyperplane<N>| {
        let cut = |&&wall: &&usize| {
            let heights = || all[wall].corners.iter().map(|&c| plane.distance(c));
            heights().any(|h| h > tolerance) && heights().any(|h| h < -tolerance)
        };
        crossing.iter().filter(cut).count()
    };
    crossing.iter().step_by(step).map(|&wall| all[wall].plane).min_by_key(cost)
}

/// The part of a polytope below a hyperplane; `None` if it is flat or empty.
pub(crate) fn clip<const N: usize>(cell: &Polytope<N>, plane: &Hyperplane<N>, tolerance: f64) -> Option<Polytope<N>> {
    let heights: Vec<f64> = cell.vertices().iter().map(|&v| plane.distance(v)).collect();
    if heights.iter().all(|&h| h <= tolerance) {
        return heights.iter().any(|&h| h < -tolerance).then(|| cell.clone());
    }
    let mut kept: Vec<Vector<N>> = Vec::new();
    for (vertex, &height) in heights.iter().enumerate() {
        let point = cell.vertices()[vertex];
        if height <= tolerance {
            kept.push(point);
        }
        for &other in cell.neighbours_of_vertex(vertex) {
            let other_height = heights[other as usize];
            if height < -tolerance && other_height > tolerance {
                kept.push(point.lerp(cell.vertices()[other as usize], height / (height - other_height)));
            }
        }
    }
    if heights.iter().any(|&h| h < -tolerance) { Polytope::from_points(&kept).ok() } else { None }
}

/// How a ray goes past a simplex.
pub(crate) enum Crossing {
    Away,
    /// With the sign of the simplex as seen along the ray.
    Through(i32),
    /// So close to the edge that another ray has to tell.
    Edge,
}

impl Crossing {
    pub(crate) fn of<const N: usize>(corners: &[Vector<N>; N], point: Vector<N>, direction: Vector<N>) -> Self {
        let m = Matrix::from_columns(corners.map(|c| c - point));
        // p + t·direction = Σ w_i c_i with Σ w_i = 1: the weights divided by t.
        let Some(weights) = m.solve(direction) else { return Self::Away };
        let least = weights.iter().fold(f64::INFINITY, f64::min);
        if least.abs() <= 1e-9 * weights.max_abs() {
            Self::Edge
        } else if least > 0.0 {
            Self::Through(if m.determinant() > 0.0 { 1 } else { -1 })
        } else {
            Self::Away
        }
    }
}

/// How often the surface winds around a point that is not on it: signed crossings of a ray.
pub(crate) fn winding_number<const N: usize>(pieces: &[[Vector<N>; N]], point: Vector<N>) -> Result<i32> {
    // Directions that no mesh is likely to be aligned with; where a ray meets an edge, the next one is taken.
    for attempt in 1..=16 {
        let direction = Vector::from_fn(|axis| {
            let turn = f64::from(attempt) * 0.618_033_988_749_895 + axis as f64 * 0.754_877_666_246_693;
            turn.fract() - 0.5
        });
        let mut winding = Some(0);
        for corners in pieces {
            match Crossing::of(corners, point, direction) {
                Crossing::Away => {}
                Crossing::Through(sign) => winding = winding.map(|count| count + sign),
                Crossing::Edge => {
                    winding = None;
                    break;
                }
            }
        }
        if let Some(winding) = winding {
            return Ok(winding);
        }
    }
    Err(GeometryError::new(BadMesh, format!("the surface passes through {:?}, where a cell should be", point.0)))
}

/// Joins cells whose union is convex, as long as there are few enough to try all pairs.
fn join<const N: usize>(mut cells: Vec<Polytope<N>>, tolerance: f64) -> Vec<Polytope<N>> {
    if cells.len() > MAX_JOINED_CELLS {
        return cells;
    }
    let mut contents: Vec<f64> = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).collect();
    let mut first = 0;
    while first < cells.len() {
        let union = (first + 1..cells.len()).find_map(|second| {
            // Cells that share a facet share corners there, to rounding; other pairs need no hull.
            let near = tolerance * 10.0;
            let shares = |v: &Vector<N>| cells[second].vertices().iter().any(|w| v.distance(*w) <= near);
            if !cells[first].vertices().iter().any(shares) {
                return None;
            }
            let points = [cells[first].vertices(), cells[second].vertices()].concat();
            let hull = Polytope::from_points(&points).ok()?;
            let content = MassProperties::of_polytope(&hull).mass;
            let sum = contents[first] + contents[second];
            (content <= sum * (1.0 + 1e-9)).then_some((second, hull, content))
        });
        match union {
            Some((second, hull, content)) => {
                (cells[first], contents[first]) = (hull, content);
                cells.remove(second);
                contents.remove(second);
                // The larger cell may now fit one that the smaller did not.
                first = 0;
            }
            None => first += 1,
        }
    }
    cells
}
