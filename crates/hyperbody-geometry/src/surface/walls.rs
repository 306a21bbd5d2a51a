//! Walls between convex pieces: where the faces of two pieces lie on each other from opposite sides, there is no surface.
//!
//! Pieces do not meet face to face: a wall of one may lie on parts of several others. So the polygons that lie on a polygon from the other
//! side are taken away from it one by one; what a convex polygon leaves of a convex polygon is, side by side, what lies beyond each side.

use hyperbody_math::Vector;

use super::{Polygon, Surface};

/// Lengths below this, in parts of the size of the surface, are none.
const TOLERANCE: f64 = 1e-9;

/// A polygon in its plane.
struct Face {
    corners: Vec<Vector<3>>,
    normal: Vector<3>,
    offset: f64,
    /// The plane's normal and offset in one number, negative of that of the same plane from the other side.
    key: f64,
}

impl Face {
    /// `None` of what has no area.
    fn new(corners: Vec<Vector<3>>, size: f64) -> Option<Self> {
        let (&first, rest) = corners.split_first()?;
        let doubled =
            rest.windows(2).fold(Vector::ZERO, |sum: Vector<3>, pair| sum + cross(pair[0] - first, pair[1] - first));
        let normal = doubled.try_normalize()?;
        let offset = corners.iter().map(|c| c.dot(normal)).sum::<f64>() / corners.len() as f64;
        // Directions that no body is likely to be symmetric about.
        let key = normal.dot(Vector([0.61, 0.35, 0.71])) + offset / size * 0.83;
        Some(Self { corners, normal, offset, key })
    }

    /// Whether another one lies in the same plane and faces the other way.
    fn is_opposite(&self, other: &Self, tolerance: f64) -> bool {
        self.normal.dot(other.normal) < 0.0
            && other.corners.iter().all(|c| (c.dot(self.normal) - self.offset).abs() <= tolerance)
    }
}

impl Surface {
    /// The surface without the walls between pieces: without what of each polygon has another polygon on it that faces the other way.
    /// Of pieces that fill a body without overlapping that leaves the body's surface; what is left of a polygon that is partly covered is
    /// several, with the same source. Pieces that overlap keep the faces that lie within others.
    #[must_use]
    pub fn without_walls(&self) -> Self {
        let size = self.vertices.iter().map(|v| v.max_abs()).fold(0.0, f64::max);
        let tolerance = TOLERANCE * size;
        let place = |corners: &[u32]| corners.iter().map(|&c| self.vertices[c as usize]).collect::<Vec<_>>();
        let mut faces: Vec<Face> = self.polygons().filter_map(|(corners, _)| Face::new(place(corners), size)).collect();
        faces.sort_by(|a, b| a.key.total_cmp(&b.key));
        let mut open = Self::new();
        let mut new_number = vec![u32::MAX; self.vertices.len()];
        for (corners, source) in self.polygons() {
            let Some(face) = Face::new(place(corners), size) else { continue };
            match uncovered(&face, &faces, tolerance) {
                None => open.add_polygon_of(self, corners, source, &mut new_number),
                Some(parts) => parts.iter().for_each(|part| open.add_new_polygon(part, source)),
            }
        }
        open
    }

    fn add_polygon_of(&mut self, other: &Self, corners: &[u32], source: u32, new_number: &mut [u32]) {
        for &corner in corners {
            let number = &mut new_number[corner as usize];
            if *number == u32::MAX {
                *number = self.vertices.len() as u32;
                self.vertices.push(other.vertices[corner as usize]);
            }
            self.corners.push(*number);
        }
        self.polygons.push(Polygon { end: self.corners.len() as u32, source });
    }

    fn add_new_polygon(&mut self, corners: &[Vector<3>], source: u32) {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(corners);
        self.corners.extend(first..self.vertices.len() as u32);
        self.polygons.push(Polygon { end: self.corners.len() as u32, source });
    }
}

/// How far keys of the same plane may be apart: normals of faces a thousandth of the body wide are that good.
const SAME_KEY: f64 = 1e-6;

/// What is left of a face beside the faces on its other side; `None` if there are none.
fn uncovered(face: &Face, faces: &[Face], tolerance: f64) -> Option<Vec<Vec<Vector<3>>>> {
    let first = faces.partition_point(|other| other.key < -face.key - SAME_KEY);
    let near = faces[first..].iter().take_while(|other| other.key <= SAME_KEY - face.key);
    let mut parts = vec![face.corners.clone()];
    let mut is_covered = false;
    for other in near.filter(|other| face.is_opposite(other, tolerance)) {
        let mut left = Vec::with_capacity(parts.len());
        for part in parts {
            match beside(&part, &other.corners, other.normal, tolerance) {
                Some(rest) => {
                    is_covered = true;
                    left.extend(rest);
                }
                None => left.push(part),
            }
        }
        parts = left;
    }
    is_covered.then_some(parts)
}

/// What a convex polygon leaves of another one in the same plane, as convex polygons; `None` if they do not overlap. `normal` is that of the
/// polygon that is taken away.
fn beside(whole: &[Vector<3>], taken: &[Vector<3>], normal: Vector<3>, tolerance: f64) -> Option<Vec<Vec<Vector<3>>>> {
    let mut within = whole.to_vec();
    let mut parts = Vec::new();
    for (k, &from) in taken.iter().enumerate() {
        let to = taken[(k + 1) % taken.len()];
        let Some(outward) = cross(to - from, normal).try_normalize() else { continue };
        let heights: Vec<f64> = within.iter().map(|&c| outward.dot(c - from)).collect();
        if heights.iter().all(|&h| h <= tolerance) {
            continue;
        }
        if heights.iter().all(|&h| h >= -tolerance) {
            return None;
        }
        parts.push(half(&within, &heights, tolerance));
        let below: Vec<f64> = heights.iter().map(|h| -h).collect();
        within = half(&within, &below, tolerance);
    }
    Some(parts)
}

/// The part of a polygon with heights above zero, some of which are.
fn half(corners: &[Vector<3>], heights: &[f64], tolerance: f64) -> Vec<Vector<3>> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (k, &corner) in corners.iter().enumerate() {
        let next = (k + 1) % corners.len();
        if heights[k] >= -tolerance {
            kept.push(corner);
        }
        if heights[k].min(heights[next]) < -tolerance && heights[k].max(heights[next]) > tolerance {
            kept.push(corner.lerp(corners[next], heights[k] / (heights[k] - heights[next])));
        }
    }
    kept
}

fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}
