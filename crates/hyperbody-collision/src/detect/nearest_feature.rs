//! A ball against a polytope by the nearest face, down the ranks of its boundary.
//!
//! The point of a face F nearest to p is the foot q of the perpendicular on F's affine hull, if q lies in F. If not, it lies
//! on a face of F one rank lower whose hyperplane within that hull separates q from F: the facet hands over to its ridges,
//! these to theirs, down to the vertices. Starting from every facet that p is in front of, the nearest of all feet is the
//! nearest point of the polytope; |p − q| bounds what a face can still give, so that most are never looked at.
//!
//! On a shared boundary several faces are equally near. The face named is the one of lowest rank that holds the point, and
//! of these the lowest number: the tie is resolved the same way from every side.
//!
//! The greedy form of the walk, from the facet that p is farthest in front of straight down, is wrong for flat polytopes:
//! the nearest face need not bound that facet.

use hyperbody_geometry::{FaceLattice, Polytope};
use hyperbody_math::{Pose, Vector};

use crate::query::Separation;

/// Distance from a boundary, in parts of the polytope's size, within which a point is on it.
const ON_BOUNDARY: f64 = 1e-12;

/// A polytope prepared for the question which of its faces is nearest to a point.
#[derive(Clone, Debug)]
pub struct NearestFeatures<const N: usize> {
    facets: Vec<(Vector<N>, f64)>,
    /// By rank and number.
    faces: Vec<Vec<Flat<N>>>,
    size: f64,
}

/// The affine hull of a face, and how its boundary cuts the face out of it.
#[derive(Clone, Debug)]
struct Flat<const N: usize> {
    base: Vector<N>,
    /// Orthonormal, as many as the rank.
    basis: Vec<Vector<N>>,
    /// Number, outward unit normal within the hull, and offset of each face one rank lower.
    sides: Vec<(u32, Vector<N>, f64)>,
}

/// The face of a polytope nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestFeature<const N: usize> {
    /// Dimension of the face: 0 for a vertex, N − 1 for a facet.
    pub rank: u32,
    /// Its number among those of its rank in the [`FaceLattice`].
    pub face: u32,
    /// The nearest point of the polytope's surface.
    pub point: Vector<N>,
    /// Distance to it; negative inside, where the nearest face is a facet.
    pub distance: f64,
    /// Outward unit normal there: from the nearest point to the given one outside, that of the facet inside and on it.
    pub normal: Vector<N>,
}

/// What the walk knows so far.
struct Walk<const N: usize> {
    point: Vector<N>,
    best_sq: f64,
    best: Option<(usize, u32, Vector<N>)>,
    seen: Vec<Vec<bool>>,
}

impl<const N: usize> NearestFeatures<N> {
    /// Prepares a polytope: its face lattice, and a frame for every face.
    #[must_use]
    pub fn new(polytope: &Polytope<N>) -> Self {
        let lattice = polytope.face_lattice();
        let faces = (0..N)
            .map(|rank| (0..lattice.faces(rank).len()).map(|face| flat(polytope, &lattice, rank, face)).collect())
            .collect();
        let facets = polytope.facets().iter().map(|facet| (facet.normal, facet.offset)).collect();
        Self { facets, faces, size: polytope.bounding_radius() }
    }

    /// The face nearest to a point in the frame of the polytope. `None` if a number is not finite.
    #[must_use]
    pub fn nearest(&self, point: Vector<N>) -> Option<NearestFeature<N>> {
        if !point.is_finite() {
            return None;
        }
        let heights = self.facets.iter().map(|(normal, offset)| normal.dot(point) - offset);
        let (facet, height) = heights.clone().enumerate().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
        if height <= 0.0 {
            let normal = self.facets[facet].0;
            let foot = point - normal * height;
            return Some(NearestFeature {
                rank: N as u32 - 1,
                face: facet as u32,
                point: foot,
                distance: height,
                normal,
            });
        }
        let seen = self.faces.iter().map(|faces| vec![false; faces.len()]).collect();
        let mut walk = Walk { point, best_sq: f64::INFINITY, best: None, seen };
        for (index, height) in heights.enumerate() {
            if height > 0.0 {
                self.descend(N - 1, index, &mut walk);
            }
        }
        let (rank, face, foot) = self.resolve(walk.best?);
        let distance = point.distance(foot);
        let normal = (point - foot).try_normalize().unwrap_or(self.facets[facet].0);
        Some(NearestFeature { rank, face, point: foot, distance, normal })
    }

    /// Distance or depth of the polytope (a) at `world_from_polytope` and a ball (b). `None` if a number is not finite.
    #[must_use]
    pub fn ball(&self, world_from_polytope: &Pose<N>, centre: Vector<N>, radius: f64) -> Option<Separation<N>> {
        let near = self.nearest(world_from_polytope.inverse_transform_point(centre))?;
        let normal = world_from_polytope.rotation.rotate(near.normal);
        Some(Separation {
            distance: near.distance - radius,
            normal,
            on_a: world_from_polytope.transform_point(near.point),
            on_b: centre - normal * radius,
            part_a: 0,
            part_b: 0,
        })
    }

    /// Looks at a face and what bounds it. A face is entered once, so this ends.
    fn descend(&self, rank: usize, face: usize, walk: &mut Walk<N>) {
        if std::mem::replace(&mut walk.seen[rank][face], true) {
            return;
        }
        let flat = &self.faces[rank][face];
        let mut foot = flat.base;
        for &direction in &flat.basis {
            foot += direction * direction.dot(walk.point - flat.base);
        }
        let distance_sq = (walk.point - foot).norm_sq();
        if distance_sq > walk.best_sq {
            return;
        }
        let mut inside = true;
        for &(side, outward, offset) in &flat.sides {
            if outward.dot(foot) > offset {
                inside = false;
                self.descend(rank - 1, side as usize, walk);
            }
        }
        if inside && distance_sq < walk.best_sq {
            walk.best_sq = distance_sq;
            walk.best = Some((rank, face as u32, foot));
        }
    }

    /// The face of lowest rank that holds the foot.
    fn resolve(&self, (mut rank, mut face, foot): (usize, u32, Vector<N>)) -> (u32, u32, Vector<N>) {
        let close = ON_BOUNDARY * self.size;
        while rank > 0 {
            let sides = &self.faces[rank][face as usize].sides;
            let Some(side) = sides.iter().find(|(_, outward, offset)| outward.dot(foot) >= offset - close) else {
                break;
            };
            (rank, face) = (rank - 1, side.0);
        }
        (rank as u32, face, foot)
    }
}

/// The hull of a face by orthogonalising its edges, and its sides by what of a side's vertex lies across the side.
fn flat<const N: usize>(polytope: &Polytope<N>, lattice: &FaceLattice, rank: usize, face: usize) -> Flat<N> {
    let vertex = |v: u32| polytope.vertices()[v as usize];
    let face = &lattice.faces(rank)[face];
    let base = vertex(face.vertices[0]);
    let basis = span(face.vertices.iter().map(|&v| vertex(v) - base), rank);
    let mean = |vertices: &[u32]| {
        vertices.iter().fold(Vector::ZERO, |sum, &v| sum + vertex(v)) * (1.0 / vertices.len() as f64)
    };
    let centre = mean(&face.vertices);
    let mut sides = Vec::with_capacity(face.boundary.len());
    for &side in &face.boundary {
        let vertices = &lattice.faces(rank - 1)[side as usize].vertices;
        let on_side = vertex(vertices[0]);
        let along = span(vertices.iter().map(|&v| vertex(v) - on_side), rank - 1);
        let outward = across(&along, across(&along, on_side - centre)).normalize_or_zero();
        sides.push((side, outward, outward.dot(on_side)));
    }
    Flat { base, basis, sides }
}

/// What of `v` is orthogonal to an orthonormal basis.
fn across<const N: usize>(basis: &[Vector<N>], v: Vector<N>) -> Vector<N> {
    basis.iter().fold(v, |rest, &direction| rest - direction * direction.dot(rest))
}

/// An orthonormal basis of `dimension` vectors for what the edges span, the longest rest first, so that no short one
/// decides a direction.
pub(super) fn span<const N: usize>(edges: impl Iterator<Item = Vector<N>>, dimension: usize) -> Vec<Vector<N>> {
    let mut rests: Vec<Vector<N>> = edges.collect();
    let mut basis: Vec<Vector<N>> = Vec::with_capacity(dimension);
    while basis.len() < dimension {
        let longest =
            rests.iter().copied().fold(Vector::ZERO, |best, v| if v.norm_sq() > best.norm_sq() { v } else { best });
        let Some(direction) = across(&basis, longest).try_normalize() else { break };
        basis.push(direction);
        for rest in &mut rests {
            *rest -= direction * direction.dot(*rest);
        }
    }
    basis
}
