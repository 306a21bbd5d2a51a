//! Walls between convex pieces: where the faces of two pieces lie on each other from opposite sides, there is no surface.
//!
//! The surface of a piece is closed: each side of a polygon is gone along once in either direction. So it is of all pieces together, and stays
//! so when corners are made one, edges are cut at the corners on them (see `seams`), and the sides of all polygons in one plane are added up,
//! where opposite ones cancel. What is left in a plane goes around what is left of its polygons: walls are nothing, parts of one face are
//! one, and nothing had to be cut from anything. It is filled with convex polygons (`loops`, `ears`) whose sides add up to the same, so
//! that the new surface is closed whatever rounding does to it. Last, sheets that only touch are told apart (`sheets`).
//!
//! Taking polygons away from each other one by one, as was done before, leaves corners in the middle of sides.

use hyperbody_math::Vector;

use super::loops::{closed_lines, regions};
use super::seams::{Edges, Places, sides, wedge};
use super::sheets::{Facet, told_apart};
use super::{Polygon, Surface, cross, ears};

/// Lengths below this, in parts of the size of the surface, are none.
const TOLERANCE: f64 = 1e-9;

/// How far keys of the same plane may be apart: normals of faces a thousandth of the body wide are that good.
const SAME_KEY: f64 = 1e-6;

/// A polygon with corners that others share.
struct Face {
    corners: Vec<u32>,
    source: u32,
    normal: Vector<3>,
    offset: f64,
    area: f64,
    /// The plane's normal and offset in one number, negative of that of the same plane from the other side.
    key: f64,
}

impl Face {
    /// `None` of what has less than three corners.
    fn new(mut corners: Vec<u32>, source: u32, places: &Places, size: f64) -> Option<Self> {
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            return None;
        }
        let first = places.at(corners[0]);
        let doubled = corners[1..].windows(2).fold(Vector::ZERO, |sum: Vector<3>, pair| {
            sum + cross(places.at(pair[0]) - first, places.at(pair[1]) - first)
        });
        // What has no area still has sides, in some plane or other.
        let normal = doubled.try_normalize().unwrap_or(Vector::unit(0));
        let offset = corners.iter().map(|&c| places.at(c).dot(normal)).sum::<f64>() / corners.len() as f64;
        // Directions that no body is likely to be symmetric about.
        let key = normal.dot(Vector([0.61, 0.35, 0.71])) + offset / size * 0.83;
        Some(Self { corners, source, normal, offset, area: 0.5 * doubled.norm(), key })
    }

    fn holds_in_plane(&self, other: &Self, places: &Places) -> bool {
        other.corners.iter().all(|&c| (places.at(c).dot(self.normal) - self.offset).abs() <= places.tolerance())
    }
}

/// Faces by the plane that they are in, from whichever side; the largest of a plane first.
fn by_plane(faces: &[Face], places: &Places) -> Vec<Vec<usize>> {
    let mut by_key: Vec<usize> = (0..faces.len()).collect();
    by_key.sort_by(|&a, &b| faces[a].key.total_cmp(&faces[b].key));
    let mut by_area: Vec<usize> = (0..faces.len()).collect();
    by_area.sort_by(|&a, &b| faces[b].area.total_cmp(&faces[a].area));
    let mut taken = vec![false; faces.len()];
    let mut planes = Vec::new();
    for first in by_area {
        if taken[first] {
            continue;
        }
        taken[first] = true;
        let mut plane = vec![first];
        for key in [faces[first].key, -faces[first].key] {
            let start = by_key.partition_point(|&other| faces[other].key < key - SAME_KEY);
            for &other in by_key[start..].iter().take_while(|&&other| faces[other].key <= key + SAME_KEY) {
                if !taken[other] && faces[first].holds_in_plane(&faces[other], places) {
                    taken[other] = true;
                    plane.push(other);
                }
            }
        }
        planes.push(plane);
    }
    planes
}

/// Coordinates in the plane of a face, such that the face goes around counterclockwise.
fn flat(normal: Vector<3>) -> impl Fn(Vector<3>) -> Vector<2> {
    let right = normal.orthonormal_complement()[0];
    let up = cross(normal, right);
    move |point| Vector([point.dot(right), point.dot(up)])
}

/// The sides of faces, added up: those left over, as often as they are.
fn added_up(faces: &[Face], plane: &[usize], edges: &Edges) -> Vec<[u32; 2]> {
    let mut parts: Vec<([u32; 2], i32)> = Vec::new();
    for &face in plane {
        edges.for_each_part(&faces[face].corners, |[a, b]| {
            parts.push(if a < b { ([a, b], 1) } else { ([b, a], -1) });
        });
    }
    parts.sort_unstable();
    let mut left = Vec::new();
    for same in parts.chunk_by(|a, b| a.0 == b.0) {
        let [a, b] = same[0].0;
        let sum: i32 = same.iter().map(|part| part.1).sum();
        let side = if sum > 0 { [a, b] } else { [b, a] };
        left.extend((0..sum.abs()).map(|_| side));
    }
    left
}

/// Leaves out corners in the middle of straight lines where no other line ends.
fn straightened(lines: &mut [Vec<[u32; 2]>], places: &Places) {
    let mut beside: Vec<Vec<u32>> = vec![Vec::new(); places.count()];
    for &[a, b] in lines.iter().flatten() {
        for [corner, other] in [[a, b], [b, a]] {
            if !beside[corner as usize].contains(&other) {
                beside[corner as usize].push(other);
            }
        }
    }
    // Where a corner that is left out leads on to, from one of its two neighbours to the other.
    let mut through: Vec<Option<[u32; 2]>> = vec![None; places.count()];
    let before = beside.clone();
    for corner in 0..places.count() as u32 {
        let [a, b] = beside[corner as usize][..] else { continue };
        let (point, from, along) = (places.at(corner), places.at(a), places.at(b) - places.at(a));
        let share = (point - from).dot(along) / along.norm_sq();
        let straight = share > 0.0 && share < 1.0 && (point - from - along * share).norm() <= places.tolerance();
        if !straight || beside[a as usize].contains(&b) {
            continue;
        }
        for (end, other) in [(a, b), (b, a)] {
            beside[end as usize].iter_mut().filter(|c| **c == corner).for_each(|c| *c = other);
        }
        through[corner as usize] = Some([before[corner as usize][0], before[corner as usize][1]]);
    }
    for sides in lines {
        sides.retain(|[from, _]| through[*from as usize].is_none());
        for [from, to] in sides {
            let mut last = *from;
            while let Some([a, b]) = through[*to as usize] {
                (last, *to) = (*to, if a == last { b } else { a });
            }
        }
    }
}

impl Surface {
    /// The longest side of the box around all vertices.
    fn extent(&self) -> f64 {
        let low = self.vertices.iter().fold(Vector::splat(f64::INFINITY), |low: Vector<3>, &v| low.min(v));
        let high = self.vertices.iter().fold(Vector::splat(f64::NEG_INFINITY), |high: Vector<3>, &v| high.max(v));
        if self.vertices.is_empty() { 0.0 } else { (high - low).max_abs() }
    }

    /// The surface without the walls between pieces: without what of each polygon has another polygon on it that faces the other way.
    /// Of pieces that fill a body without overlapping that leaves the body's surface. Parts of one face are joined, also those of
    /// several pieces, to convex polygons; each has the smallest of the sources that it could have.
    ///
    /// Every side of a polygon is a side of exactly one other, in the other direction. Where the body touches itself along an edge or
    /// in a corner, polygons have corners of their own, at the same place. Pieces that overlap keep the faces that lie within others.
    #[must_use]
    pub fn without_walls(&self) -> Self {
        let size = self.vertices.iter().map(|v| v.max_abs()).fold(0.0, f64::max);
        let mut places = Places::new(self.extent(), self.vertices.len(), TOLERANCE * size);
        let numbers: Vec<u32> = self.vertices.iter().map(|&v| places.number(v)).collect();
        let shared = |corners: &[u32]| corners.iter().map(|&c| numbers[c as usize]).collect();
        let faces = self.polygons().filter_map(|(c, source)| Face::new(shared(c), source, &places, size));
        let faces: Vec<Face> = faces.collect();
        let planes = by_plane(&faces, &places);
        let mut edges = Edges::new(faces.iter().map(|face| &face.corners[..]));
        for plane in planes.iter().filter(|plane| plane.len() > 1) {
            let corners = plane.iter().map(|&face| &faces[face].corners[..]);
            edges.cross(corners, &mut places, flat(faces[plane[0]].normal));
        }
        edges.cut(&places);
        let mut lines: Vec<Vec<[u32; 2]>> = planes.iter().map(|plane| added_up(&faces, plane, &edges)).collect();
        straightened(&mut lines, &places);
        let mut facets = Vec::new();
        for (plane, sides) in planes.iter().zip(&lines) {
            fill(sides, plane, &faces, &places, &mut facets);
        }
        // Files have groups of faces with one source.
        facets.sort_by_key(|facet| facet.source);
        let all: Vec<Vector<3>> = (0..places.count() as u32).map(|corner| places.at(corner)).collect();
        let mut open = Self { vertices: told_apart(&mut facets, &all), ..Self::default() };
        for facet in facets {
            open.corners.extend(facet.corners);
            open.polygons.push(Polygon { end: open.corners.len() as u32, source: facet.source });
        }
        open
    }
}

/// Fills what the lines in a plane go around with polygons.
fn fill(edges: &[[u32; 2]], plane: &[usize], faces: &[Face], places: &Places, facets: &mut Vec<Facet>) {
    let normal = faces[plane[0]].normal;
    let in_plane = flat(normal);
    let place = |corner: u32| in_plane(places.at(corner));
    for region in regions(closed_lines(edges, &place), &place) {
        let line = ears::tied(&region, &place);
        let triangles = ears::triangles(&line, &place, places.tolerance());
        let source = source(&triangles, region.faces_up, plane, faces, &place);
        for mut corners in ears::joined(&triangles, &place, places.tolerance()) {
            if !region.faces_up {
                // The first corner is one to fan out from.
                corners[1..].reverse();
            }
            let normal = if region.faces_up { normal } else { -normal };
            facets.push(Facet { corners, source, normal });
        }
    }
}

/// The smallest source of a face of the plane that holds the middle of the largest triangle.
fn source(
    triangles: &[[u32; 3]],
    faces_up: bool,
    plane: &[usize],
    faces: &[Face],
    place: &impl Fn(u32) -> Vector<2>,
) -> u32 {
    let area = |t: &&[u32; 3]| wedge(place(t[1]) - place(t[0]), place(t[2]) - place(t[0]));
    let largest = triangles.iter().max_by(|a, b| area(a).total_cmp(&area(b)));
    let middle = largest.map_or(Vector::ZERO, |t| t.iter().fold(Vector::ZERO, |sum, &c| sum + place(c)) / 3.0);
    let normal = faces[plane[0]].normal;
    let alike = |face: &&Face| (face.normal.dot(normal) > 0.0) == faces_up;
    let holds = |face: &&Face| {
        let turn = if faces_up { 1.0 } else { -1.0 };
        let inside = |[a, b]: [u32; 2]| turn * wedge(place(b) - place(a), middle - place(a)) >= 0.0;
        sides(&face.corners).all(inside)
    };
    let own = || plane.iter().map(|&face| &faces[face]).filter(alike);
    let source = own().filter(holds).map(|face| face.source).min();
    source.or_else(|| own().map(|face| face.source).min()).unwrap_or(faces[plane[0]].source)
}
