//! Regular polytopes of any Schläfli symbol, star polytopes included, as surfaces.
//!
//! A symbol {p, q, …} of whole numbers or fractions says at which angles the mirrors of the symmetry group stand: neighbours at
//! π/p, π/q, …, others at right angles. The vertex lies on all mirrors but the first; the face of rank k that belongs to it is
//! what the first k mirrors make of it; and all the other faces are images of those (H. S. M. Coxeter, "Regular Polytopes", §5
//! and §14). So one procedure makes the pentagram {5/2}, the four star polyhedra of J. Kepler and L. Poinsot, the ten
//! star polychora of L. Schläfli and E. Hess, and the convex ones.
//!
//! **Which solid is meant.** The facets of a star polytope cross each other. Its surface is a closed oriented surface all the same,
//! and winds around every point beside it a whole number of times: around the middle of a pentagram twice. Volume and moments
//! of the surface ([`MassProperties::of_closed_boundary`](crate::MassProperties::of_closed_boundary)) count each region
//! as often as the surface winds around it, which is Cayley's density and the usual meaning of the volume of a star polytope. As
//! a body to collide with or to cut, a star is the set of all points that the surface winds around at all, each once ([`cells`]).

mod cells;
mod envelope;
mod group;

pub use cells::cells;

use std::collections::BTreeMap;

use hyperbody_math::scalar;

use crate::error::GeometryErrorKind::{BadCount, BadNumber, UnknownName};
use crate::regular::Size;
use crate::tolerances::{MAX_LENGTH, MIN_LENGTH};
use crate::{GeometryError, OffFile, Result};

/// One entry of a symbol: p/d stands for p sides that go around d times.
pub type Fraction = (u32, u32);

/// Names and symbols of the star polyhedra and star polychora.
pub const NAMES: [(&str, &str); 14] = [
    ("small stellated dodecahedron", "{5/2,5}"),
    ("great dodecahedron", "{5,5/2}"),
    ("great stellated dodecahedron", "{5/2,3}"),
    ("great icosahedron", "{3,5/2}"),
    ("small stellated 120-cell", "{5/2,5,3}"),
    ("icosahedral 120-cell", "{3,5,5/2}"),
    ("great 120-cell", "{5,5/2,5}"),
    ("grand 120-cell", "{5,3,5/2}"),
    ("great stellated 120-cell", "{5/2,3,5}"),
    ("grand stellated 120-cell", "{5/2,5,5/2}"),
    ("great grand 120-cell", "{5,5/2,3}"),
    ("great icosahedral 120-cell", "{3,5/2,5}"),
    ("grand 600-cell", "{3,3,5/2}"),
    ("great grand stellated 120-cell", "{5/2,3,3}"),
];

/// Other names of star polygons that are the only one with so many vertices.
const POLYGONS: [(&str, &str); 3] = [("pentagram", "{5/2}"), ("octagram", "{8/3}"), ("decagram", "{10/3}")];

/// Most vertices: the great grand stellated 120-cell has 600. A symbol whose mirrors make more stands for no polytope, or for one
/// that [`regular`](crate::regular) makes better.
const MAX_VERTICES: usize = 1200;

/// Most faces of one rank: 120-cell and 600-cell have 1200.
const MAX_FACES: usize = 4800;

/// Points of the unit sphere closer than this are one.
const SAME: f64 = 1e-9;

/// The entries of a symbol such as `"{5/2,5}"`, or of the name of a star polytope such as `"great icosahedron"` or `"pentagram"`.
///
/// # Errors
/// `UnknownName` if it is neither.
pub fn symbol(name: &str) -> Result<Vec<Fraction>> {
    let plain = |text: &str| text.to_lowercase().replace(['-', '_'], " ");
    let named = NAMES.iter().chain(&POLYGONS).find(|(known, _)| plain(known) == plain(name.trim()));
    let text = named.map_or(name, |(_, symbol)| symbol);
    let inner = text.trim().strip_prefix('{').and_then(|rest| rest.strip_suffix('}')).unwrap_or("");
    let entry = |part: &str| {
        let (p, d) = part.split_once('/').unwrap_or((part, "1"));
        let (p, d): (u32, u32) = (p.trim().parse().ok()?, d.trim().parse().ok()?);
        (d >= 1 && p > 2 * d && p <= 100).then_some((p, d))
    };
    if let Some(whole) = inner.split(',').find_map(|part| part.trim().strip_suffix("/1")) {
        let message = format!("\"{name}\": {whole}/1 is the whole number {whole}: write {whole}");
        return Err(GeometryError::new(UnknownName, message));
    }
    let entries: Option<Vec<Fraction>> = inner.split(',').map(entry).collect();
    if let Some(&(p, d)) = entries.iter().flatten().find(|&&(p, d)| !in_lowest_terms(p, d)) {
        return Err(not_in_lowest_terms(name, p, d));
    }
    entries.ok_or_else(|| {
        let known: Vec<String> = NAMES.iter().map(|(name, symbol)| format!("{name} {symbol}")).collect();
        GeometryError::new(
            UnknownName,
            format!(
                "\"{name}\" is no star polytope: give a symbol such as {{5/2,5}}, with entries above 2 in lowest terms, or one of {}",
                known.join(", ")
            ),
        )
    })
}

/// {6/2} is two triangles, not one polygon.
fn not_in_lowest_terms(name: &str, p: u32, d: u32) -> GeometryError {
    let copies = (2..=d).rev().find(|n| p.is_multiple_of(*n) && d.is_multiple_of(*n)).unwrap_or(1);
    let (p_each, d_each) = (p / copies, d / copies);
    let each = if d_each == 1 { p_each.to_string() } else { format!("{p_each}/{d_each}") };
    let message = format!(
        "\"{name}\": {p}/{d} is not in lowest terms: {{{p}/{d}}} is {copies} polygons {{{each}}} turned against each other, a compound and no \
         regular polytope; give {{{each}}}, or put turned copies of it into a \"compound\""
    );
    GeometryError::new(UnknownName, message)
}

fn in_lowest_terms(p: u32, d: u32) -> bool {
    (2..=d).all(|divisor| !p.is_multiple_of(divisor) || !d.is_multiple_of(divisor))
}

/// The surface of the regular polytope with this symbol, in one dimension more than the symbol has entries: vertices, polygons
/// in order around them, and all faces of higher rank up to the facets.
///
/// # Errors
/// `UnknownName` if the symbol stands for no finite polytope; `BadCount` if it has no entries, more than five, or leads to
/// more than 1200 vertices; `BadNumber` if the size is no length.
///
/// ```
/// use hyperbody_geometry::regular::Size;
/// use hyperbody_geometry::{MassProperties, star};
/// let file = star::surface(&star::symbol("great icosahedron")?, Size::Edge(1.0))?;
/// assert_eq!((file.vertex_count(), file.edge_count(), file.elements(2).len()), (12, 30, 20));
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
pub fn surface(symbol: &[Fraction], size: Size) -> Result<OffFile> {
    let dimension = symbol.len() + 1;
    if !(2..=6).contains(&dimension) {
        return Err(GeometryError::new(
            BadCount,
            format!("a symbol of {} entries: it needs 1 to 5, one less than dimensions", symbol.len()),
        ));
    }
    let mirrors = mirrors(symbol).ok_or_else(|| endless(symbol))?;
    let mut vertices = vec![first_vertex(&mirrors)];
    let turns = orbit(&mut vertices, &mirrors).ok_or_else(|| endless(symbol))?;
    let mut elements = vec![polygons(&turns).ok_or_else(|| endless(symbol))?];
    if dimension > 2 {
        let mut below = Images::of(&elements[0], &turns);
        for rank in 3..dimension {
            let faces = below.faces_above(rank).ok_or_else(|| endless(symbol))?;
            below = Images::of(&faces, &below.turns);
            elements.push(faces);
        }
    }
    let edge = distance(&vertices[0], &vertices[turns[0][0] as usize]);
    let (what, wanted, factor) = match size {
        Size::Circumradius(radius) => ("circumradius", radius, radius),
        Size::Edge(length) => ("edge", length, length / edge),
    };
    if !(MIN_LENGTH..=MAX_LENGTH).contains(&wanted) {
        let message = format!(
            "the {what} of a star polytope is {wanted}: it must be a number of metres between {MIN_LENGTH:e} and {MAX_LENGTH:e}"
        );
        return Err(GeometryError::new(BadNumber, message));
    }
    let coordinates = vertices.iter().flatten().map(|c| c * factor).collect();
    Ok(OffFile::from_elements(dimension, coordinates, elements))
}

fn endless(symbol: &[Fraction]) -> GeometryError {
    let entry = |&(p, d): &Fraction| if d == 1 { p.to_string() } else { format!("{p}/{d}") };
    let text: Vec<String> = symbol.iter().map(entry).collect();
    if let Some(space) = tiled_by(symbol) {
        let message = format!("{{{}}} is a tiling of {space}, not a polytope", text.join(","));
        return GeometryError::new(UnknownName, message);
    }
    GeometryError::new(
        UnknownName,
        format!(
            "{{{}}} is no finite regular polytope, or one of more than {MAX_VERTICES} vertices; star polytopes are those of {}",
            text.join(","),
            NAMES.map(|(_, symbol)| symbol).join(", ")
        ),
    )
}

/// What a symbol of whole numbers tiles, if it stands for no polytope: its mirrors fit into no sphere then. What is left of the last
/// normal beside the others is nothing where they are parallel to one line, as those of a flat space, and its square is negative
/// where they are those of a hyperbolic one.
pub(crate) fn tiled_by(symbol: &[Fraction]) -> Option<&'static str> {
    if symbol.len() < 2 || symbol.iter().any(|&(p, d)| d != 1 || p < 3) {
        return None;
    }
    // The Gram determinants of the first k mirrors, D_k = D_(k−1) − cos²(π/p) D_(k−2).
    let (mut before, mut last) = (1.0, 1.0);
    for (position, &(p, _)) in symbol.iter().enumerate() {
        let cos = scalar::cos(std::f64::consts::PI / f64::from(p));
        (before, last) = (last, last - cos * cos * before);
        let flat = last.abs() < 1e-9;
        if flat && position + 1 == symbol.len() {
            return Some(if symbol.len() == 2 { "the plane" } else { "flat space" });
        }
        if flat || last < 0.0 {
            return Some(if symbol.len() == 2 { "the hyperbolic plane" } else { "hyperbolic space" });
        }
    }
    None
}

/// Unit normals of mirrors at the angles of the symbol, each with zeros after its own coordinate: the Cholesky factor of their
/// products. `None` if they do not fit into Euclidean space.
fn mirrors(symbol: &[Fraction]) -> Option<Vec<Vec<f64>>> {
    let dimension = symbol.len() + 1;
    let product = |i: usize, j: usize| {
        if i == j {
            return 1.0;
        }
        if i.abs_diff(j) > 1 {
            return 0.0;
        }
        let (p, d) = symbol[i.min(j)];
        -scalar::cos(std::f64::consts::PI * f64::from(d) / f64::from(p))
    };
    let mut normals = vec![vec![0.0; dimension]; dimension];
    for i in 0..dimension {
        for j in 0..=i {
            let rest = product(i, j) - (0..j).map(|k| normals[i][k] * normals[j][k]).sum::<f64>();
            if i == j {
                if rest < 1e-9 {
                    return None;
                }
                normals[i][i] = rest.sqrt();
            } else {
                normals[i][j] = rest / normals[j][j];
            }
        }
    }
    Some(normals)
}

/// The point of the unit sphere on all mirrors but the first.
fn first_vertex(mirrors: &[Vec<f64>]) -> Vec<f64> {
    let mut point = vec![0.0; mirrors.len()];
    point[0] = 1.0;
    for i in 1..mirrors.len() {
        let sum: f64 = (0..i).map(|k| mirrors[i][k] * point[k]).sum();
        point[i] = -sum / mirrors[i][i];
    }
    let length = point.iter().map(|c| c * c).sum::<f64>().sqrt();
    point.iter().map(|c| c / length).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// For each mirror, where it takes each vertex, edge or face.
type Turns = Vec<Vec<u32>>;

/// Adds all images of the first vertex. `None` if there are too many.
fn orbit(vertices: &mut Vec<Vec<f64>>, mirrors: &[Vec<f64>]) -> Option<Turns> {
    let mut turns: Turns = vec![Vec::new(); mirrors.len()];
    let mut next = 0;
    while next < vertices.len() {
        for (mirror, turn) in mirrors.iter().zip(&mut turns) {
            let from = &vertices[next];
            let height: f64 = mirror.iter().zip(from).map(|(a, b)| a * b).sum();
            let image: Vec<f64> = from.iter().zip(mirror).map(|(c, m)| c - 2.0 * height * m).collect();
            let known = vertices.iter().position(|v| distance(v, &image) < SAME);
            turn.push(known.unwrap_or(vertices.len()) as u32);
            if known.is_none() {
                vertices.push(image);
            }
        }
        next += 1;
        if vertices.len() > MAX_VERTICES {
            return None;
        }
    }
    Some(turns)
}

/// The images of a list of numbers under the mirrors, without those that are the same set.
fn images(first: Vec<u32>, turns: &Turns) -> Option<Vec<Vec<u32>>> {
    let key = |list: &[u32]| {
        let mut sorted = list.to_vec();
        sorted.sort_unstable();
        sorted
    };
    let mut known = BTreeMap::from([(key(&first), ())]);
    let mut lists = vec![first];
    let mut next = 0;
    while next < lists.len() {
        for turn in turns {
            let image: Vec<u32> = lists[next].iter().map(|&number| turn[number as usize]).collect();
            if known.insert(key(&image), ()).is_none() {
                lists.push(image);
            }
        }
        next += 1;
        if lists.len() > MAX_FACES {
            return None;
        }
    }
    Some(lists)
}

/// The polygons: the first two mirrors make a rotation, which takes the first vertex around the first polygon.
fn polygons(turns: &Turns) -> Option<Vec<Vec<u32>>> {
    let mut cycle = vec![0];
    for _ in 0..MAX_VERTICES {
        let last = cycle[cycle.len() - 1];
        let next = turns[0][turns[1][last as usize] as usize];
        if next == 0 {
            break;
        }
        cycle.push(next);
    }
    images(cycle, turns)
}

/// The faces of one rank, and where the mirrors take them.
struct Images {
    turns: Turns,
}

impl Images {
    fn of(faces: &[Vec<u32>], turns_below: &Turns) -> Self {
        let key = |list: &mut dyn Iterator<Item = u32>| {
            let mut sorted: Vec<u32> = list.collect();
            sorted.sort_unstable();
            sorted
        };
        let numbers: BTreeMap<Vec<u32>, u32> =
            faces.iter().enumerate().map(|(number, face)| (key(&mut face.iter().copied()), number as u32)).collect();
        let turn = |below: &Vec<u32>| {
            let image = |face: &Vec<u32>| {
                numbers.get(&key(&mut face.iter().map(|&part| below[part as usize]))).copied().unwrap_or(0)
            };
            faces.iter().map(image).collect()
        };
        Self { turns: turns_below.iter().map(turn).collect() }
    }

    /// The faces of rank `rank`, of which the first consists of the images of the first face of one rank less under the first
    /// `rank` mirrors.
    fn faces_above(&self, rank: usize) -> Option<Vec<Vec<u32>>> {
        let mut first = vec![0];
        let mut next = 0;
        while next < first.len() {
            for turn in &self.turns[..rank] {
                let image = turn[first[next] as usize];
                if !first.contains(&image) {
                    first.push(image);
                }
            }
            next += 1;
        }
        images(first, &self.turns)
    }
}
