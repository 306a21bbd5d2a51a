//! Round sections: balls, capsules, and whatever is known by its support function.
//!
//! A section of a ball is a ball. That of a capsule is the union of balls along a segment whose radius √(r² − h²) shrinks with
//! the distance h of their centres from the slice; its support function has a closed form. Every round body is drawn as the
//! image of a fixed triangulation of the sphere under the support map: a direction goes to the point of the body that
//! lies farthest that way, and is the normal there.

use hyperbody::math::{Vector, scalar};

use crate::mesh::{Mesh, cross};

/// Where a body is smooth, its triangles are tilted against the directions of their corners by at most this, in spacings.
const MOST_SPACINGS: f64 = 1.6;

/// Triangles with sides this much longer than usual may bridge a flat part.
const LONG_SIDES: f64 = 2.5;

/// What a flat part may stand out over its triangle, in parts of the triangle's side: rounding.
const FLAT_GAP: f64 = 1e-6;

/// A triangulated unit sphere: an icosahedron, each triangle divided into four some times.
#[derive(Clone, Debug)]
pub(crate) struct Sphere {
    pub(crate) directions: Vec<Vector<3>>,
    triangles: Vec<[u32; 3]>,
    /// Angle between neighbouring directions, rad.
    spacing: f64,
}

impl Sphere {
    /// 20·4^`divisions` triangles.
    pub(crate) fn new(divisions: u32) -> Self {
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        let mut directions = Vec::new();
        for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
            directions.extend([Vector([0.0, a, b]), Vector([a, b, 0.0]), Vector([b, 0.0, a])]);
        }
        directions.iter_mut().for_each(|d: &mut Vector<3>| *d = d.normalize_or_zero());
        let mut triangles = icosahedron(&directions);
        for _ in 0..divisions {
            triangles = divided(&triangles, &mut directions);
        }
        let spacing = 1.1072 / f64::from(1 << divisions);
        Self { directions, triangles, spacing }
    }

    /// Adds a ball.
    pub(crate) fn add_ball(&self, centre: Vector<3>, radius: f64, cell: u16, mesh: &mut Mesh) {
        for triangle in &self.triangles {
            let normals = triangle.map(|corner| self.directions[corner as usize]);
            mesh.triangle(normals.map(|direction| centre + direction * radius), normals, cell);
        }
    }

    /// Adds the body with this support function. Triangles on a flat part or along an edge of the body get their own normal.
    ///
    /// Around a flat part many directions go to points of its rim, and triangles of such points may come out turned over. They
    /// lie upon others of the same part and are left out: the inside of the body must not be seen on its outside.
    pub(crate) fn add_body(&self, mut support: impl FnMut(Vector<3>) -> Vector<3>, cell: u16, mesh: &mut Mesh) {
        let points: Vec<Vector<3>> = self.directions.iter().copied().map(&mut support).collect();
        let middle = points.iter().fold(Vector::ZERO, |sum, &point| sum + point) / points.len() as f64;
        // Of the smaller half of all triangles: those on the roundings, whatever the size of the flats.
        let mut sides: Vec<f64> = self.triangles.iter().map(|triangle| longest_side(&points, triangle)).collect();
        sides.sort_unstable_by(f64::total_cmp);
        let usual = sides.get(sides.len() / 2).copied().unwrap_or(0.0);
        let least_cosine = 1.0 - 0.5 * (MOST_SPACINGS * self.spacing).powi(2);
        for triangle in &self.triangles {
            let corners = triangle.map(|corner| points[corner as usize]);
            let flat = cross(corners[1] - corners[0], corners[2] - corners[0]);
            let Some(flat) = flat.try_normalize() else { continue };
            let round = triangle.map(|corner| self.directions[corner as usize]);
            if flat.dot(corners[0] - middle) <= 0.0 {
                continue;
            }
            let long = longest_side(&points, triangle);
            let gap = |point: Vector<3>| (point - corners[0]).dot(flat);
            let mut is_flat = || long > LONG_SIDES * usual && gap(support(flat)) < FLAT_GAP * long;
            let is_edge = round.iter().any(|direction| direction.dot(flat) < least_cosine);
            mesh.triangle(corners, if is_edge || is_flat() { [flat; 3] } else { round }, cell);
        }
    }
}

fn longest_side(points: &[Vector<3>], [a, b, c]: &[u32; 3]) -> f64 {
    let at = |corner: u32| points[corner as usize];
    at(*a).distance(at(*b)).max(at(*b).distance(at(*c))).max(at(*c).distance(at(*a)))
}

/// The triangles of three mutually nearest directions, counterclockwise from outside.
fn icosahedron(directions: &[Vector<3>]) -> Vec<[u32; 3]> {
    let near = |a: usize, b: usize| directions[a].dot(directions[b]) > 0.4;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let [p, q, r] = [a, b, c].map(|corner| directions[corner]);
                    let outward = cross(q - p, r - p).dot(p) > 0.0;
                    let corners = if outward { [a, b, c] } else { [a, c, b] };
                    triangles.push(corners.map(|corner| corner as u32));
                }
            }
        }
    }
    triangles
}

fn divided(triangles: &[[u32; 3]], directions: &mut Vec<Vector<3>>) -> Vec<[u32; 3]> {
    let mut middles: std::collections::BTreeMap<(u32, u32), u32> = std::collections::BTreeMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            directions.push((directions[a as usize] + directions[b as usize]).normalize_or_zero());
            directions.len() as u32 - 1
        })
    };
    let mut finer = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    finer
}

/// Corners of a drawn circle.
const CIRCLE: usize = 48;

/// Directions of the plane, evenly around.
pub(crate) fn circle() -> impl Iterator<Item = Vector<2>> {
    (0..CIRCLE).map(|index| {
        let (sin, cos) = scalar::sin_cos(std::f64::consts::TAU * index as f64 / CIRCLE as f64);
        Vector([cos, sin])
    })
}

/// Adds a flat body by its support function.
pub(crate) fn add_flat(support: impl FnMut(Vector<2>) -> Vector<2>, cell: u16, mesh: &mut Mesh) {
    let corners: Vec<Vector<2>> = circle().map(support).collect();
    mesh.add_polygon(&corners, cell);
}

/// The section of a capsule: balls about `middle` + s·`along` for |s| ≤ 1 with radius √(radius² − |off + s·`off_along`|²).
/// The vectors hold the coordinates that are drawn; what lies off the slice enters by three dot products.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CapsuleSection<const K: usize> {
    pub(crate) middle: Vector<K>,
    pub(crate) along: Vector<K>,
    /// radius² − |off|², off · off_along, |off_along|².
    pub(crate) room: f64,
    pub(crate) slope: f64,
    pub(crate) rise_sq: f64,
}

impl<const K: usize> CapsuleSection<K> {
    /// Where the balls have a radius: a range of s, or `None` if the slice misses all.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        // room − 2 s slope − s² rise² ≥ 0
        if self.rise_sq <= 1e-18 {
            return (self.room > 0.0).then_some((-1.0, 1.0));
        }
        let centre = -self.slope / self.rise_sq;
        let reach_sq = (self.room + self.slope * self.slope / self.rise_sq) / self.rise_sq;
        let reach = if reach_sq > 0.0 { reach_sq.sqrt() } else { return None };
        let (low, high) = ((centre - reach).max(-1.0), (centre + reach).min(1.0));
        (low < high).then_some((low, high))
    }

    /// The point farthest along the unit vector `direction`.
    pub(crate) fn support(&self, direction: Vector<K>, (low, high): (f64, f64)) -> Vector<K> {
        let gain = self.along.dot(direction);
        let s = if self.rise_sq <= 1e-18 {
            if gain >= 0.0 { high } else { low }
        } else {
            // The greatest of gain·s + √(A − B t²), t = s − centre.
            let centre = -self.slope / self.rise_sq;
            let a = self.room + self.slope * self.slope / self.rise_sq;
            let b = self.rise_sq;
            centre + gain * (a.max(0.0) / (b * (b + gain * gain))).sqrt()
        };
        let s = s.clamp(low, high);
        let radius_sq = self.room - s * (2.0 * self.slope + s * self.rise_sq);
        self.middle + self.along * s + direction * radius_sq.max(0.0).sqrt()
    }
}
