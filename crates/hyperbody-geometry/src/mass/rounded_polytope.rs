//! Polytopes rounded by a radius r: all points at most r away.
//!
//! Each of these points is x + y in exactly one way with x the nearest point of the polytope and y orthogonal to the
//! face F that x is inside of, in the normal cone C of F, |y| ≤ r. So moments are sums over faces (J. Steiner, 1840):
//!
//! ∫ (x + y)(x + y)ᵀ = ∫_F x xᵀ · |C| + ∫_F x (∫_C y)ᵀ + (…)ᵀ + |F| · ∫_C y yᵀ.
//!
//! With the direction u and m the dimension of C, what is needed of a cone are σ = ∫ 1 du, a = ∫ u du and
//! B = ∫ u uᵀ du. The divergence theorem on C ∩ ball gives the last two from the cones of the faces G around F, which
//! are the facets of C; ν is the direction from F into G, outward from C, and Π projects on the span of C:
//!
//! a = −Σ_G ν σ_G / (m − 1),   B = (Π σ − Σ_G ν a_Gᵀ) / m.
//!
//! The solid angle σ itself is an angle for m = 2, Girard's excess for m = 3, and a sum over a triangulation of the
//! cone from there on (see [`orthant`](super::orthant)). Nothing is approximated but integrals of analytic functions,
//! to 1e-12.

use hyperbody_math::{Matrix, Vector, scalar};

use super::MassProperties;
use super::boundary::{Moments, of_polytope, symmetric};
use super::orthant::ConeShares;
use crate::error::GeometryErrorKind::{BadCount, Flat};
use crate::tolerances::MAX_CONE_WORK;
use crate::volume::{factorial, unit_sphere};
use crate::{FaceLattice, GeometryError, Polytope, Result};

/// Moments over the directions of a normal cone.
#[derive(Clone, Copy)]
struct Cone<const N: usize> {
    /// σ.
    angle: f64,
    /// a.
    first: Vector<N>,
    /// B.
    second: Matrix<N>,
}

/// What the cones of one rank need to know of the lattice and of the ranks above.
pub(crate) struct Normals<'a, const N: usize> {
    polytope: &'a Polytope<N>,
    lattice: &'a FaceLattice,
    /// By rank and face: the faces one rank higher around it.
    cofaces: Vec<Vec<Vec<u32>>>,
    /// By rank and face: the facets around it, ascending.
    facets: Vec<Vec<Vec<u32>>>,
}

/// What the normal cones of all vertices may miss of all directions, in parts of them: more is noise.
const MAX_MISSED: f64 = 1e-8;

/// The properties of the rounded polytope at unit density.
///
/// Normal cones of vertices whose facets differ in direction by what noise makes of one are too narrow to be measured. That shows,
/// for the cones of all vertices together are all directions; then facets that noise has split are joined.
///
/// # Errors
/// `BadCount` if its normal cones fall into more simplicial ones than [`MAX_CONE_WORK`] allows; `Flat` if they cannot be measured.
pub(super) fn properties<const N: usize>(polytope: &Polytope<N>, radius: f64) -> Result<MassProperties<N>> {
    if let Some(properties) = measured(polytope, radius)? {
        return Ok(properties);
    }
    for joined in polytope.with_joined_facets() {
        if let Some(properties) = measured(&joined, radius)? {
            return Ok(properties);
        }
    }
    Err(GeometryError::new(
        Flat,
        "facets of a rounded polytope are so nearly parallel, or the whole is so thin, that the directions of its corners cannot be \
         measured: give its vertices with more digits, leave out those that hardly stand out, or use the polytope without rounding",
    ))
}

/// The same; `None` if the normal cones do not make up all directions.
fn measured<const N: usize>(polytope: &Polytope<N>, radius: f64) -> Result<Option<MassProperties<N>>> {
    let lattice = polytope.face_lattice();
    let normals = Normals::new(polytope, &lattice);
    let work = normals.work();
    if work > MAX_CONE_WORK {
        return Err(GeometryError::new(
            BadCount,
            format!(
                "a rounded polytope with {} facets in {N} dimensions takes {work} units of work for its solid angles; the \
                 limit is {MAX_CONE_WORK}: use fewer vertices, or the polytope without rounding",
                polytope.facets().len()
            ),
        ));
    }
    let reference = polytope.vertex_mean();
    let core = of_polytope(polytope);
    let arm = core.centre - reference;
    let mut total = Moments {
        volume: core.mass,
        first: arm * core.mass,
        second: core.second_moments + Matrix::outer(arm, arm) * core.mass,
    };
    let mut shares = ConeShares::default();
    let mut above: Vec<Cone<N>> = Vec::new();
    for rank in (0..N).rev() {
        let cones: Vec<Cone<N>> =
            (0..lattice.faces(rank).len()).map(|face| normals.cone(rank, face, &above, &mut shares)).collect();
        for (face, cone) in cones.iter().enumerate() {
            let moments = face_moments(polytope, &lattice, rank, face, reference);
            add_rounded_face(&mut total, &moments, cone, N - rank, radius);
        }
        above = cones;
    }
    let angle = above.iter().map(|cone| cone.angle).sum::<f64>() / unit_sphere(N);
    let first = above.iter().fold(Vector::ZERO, |sum, cone| sum + cone.first);
    let positive = above.iter().all(|cone| cone.angle >= -MAX_MISSED);
    let whole = (angle - 1.0).abs() < MAX_MISSED && first.max_abs() < MAX_MISSED && positive;
    Ok(whole.then(|| total.properties(reference)))
}

/// Adds the points nearest to a face, whose normal cone has dimension m.
fn add_rounded_face<const N: usize>(total: &mut Moments<N>, face: &Moments<N>, cone: &Cone<N>, m: usize, radius: f64) {
    let power = |k: usize| radius.powi(k as i32) / k as f64;
    let (content, first, second) = (cone.angle * power(m), cone.first * power(m + 1), cone.second * power(m + 2));
    let mixed = Matrix::outer(face.first, first);
    total.volume += face.volume * content;
    total.first += face.first * content + first * face.volume;
    total.second += face.second * content + mixed + mixed.transpose() + second * face.volume;
}

/// Content and moments of a face in its own dimension, about the reference point.
fn face_moments<const N: usize>(
    polytope: &Polytope<N>,
    lattice: &FaceLattice,
    rank: usize,
    face: usize,
    reference: Vector<N>,
) -> Moments<N> {
    let mut moments = Moments::ZERO;
    for simplex in lattice.triangulation(rank, face) {
        let corners: Vec<Vector<N>> = simplex.iter().map(|&v| polytope.vertices()[v as usize] - reference).collect();
        moments.add_simplex(simplex_content(&corners), &corners);
    }
    moments
}

/// The content of a simplex in its own dimension.
pub(crate) fn simplex_content<const N: usize>(corners: &[Vector<N>]) -> f64 {
    let mut content = 1.0 / factorial(corners.len() - 1);
    let mut basis: Vec<Vector<N>> = Vec::with_capacity(corners.len());
    for &corner in &corners[1..] {
        let height = orthogonal_part(corner - corners[0], &basis);
        content *= height.norm();
        basis.push(height.normalize_or_zero());
    }
    content
}

impl<'a, const N: usize> Normals<'a, N> {
    pub(crate) fn new(polytope: &'a Polytope<N>, lattice: &'a FaceLattice) -> Self {
        let cofaces: Vec<Vec<Vec<u32>>> = (0..N - 1).map(|rank| lattice.cofaces(rank)).collect();
        let mut facets: Vec<Vec<Vec<u32>>> = vec![(0..lattice.faces(N - 1).len() as u32).map(|f| vec![f]).collect()];
        for around in cofaces.iter().rev() {
            let above = &facets[facets.len() - 1];
            let of_face = |cofaces: &Vec<u32>| {
                let mut list: Vec<u32> = cofaces.iter().flat_map(|&c| above[c as usize].iter().copied()).collect();
                list.sort_unstable();
                list.dedup();
                list
            };
            facets.push(around.iter().map(of_face).collect());
        }
        facets.reverse();
        Self { polytope, lattice, cofaces, facets }
    }

    pub(crate) const fn lattice(&self) -> &'a FaceLattice {
        self.lattice
    }

    /// The faces one rank higher around a face: their normal cones are the facets of its own.
    pub(crate) fn cofaces(&self, rank: usize, face: usize) -> &[u32] {
        &self.cofaces[rank][face]
    }

    pub(crate) fn facet_normal(&self, facet: u32) -> Vector<N> {
        self.polytope.facets()[facet as usize].normal
    }

    /// The normal cone of a face, from those of all faces one rank higher.
    fn cone(&self, rank: usize, face: usize, above: &[Cone<N>], shares: &mut ConeShares) -> Cone<N> {
        let m = N - rank;
        if m == 1 {
            let normal = self.facet_normal(face as u32);
            return Cone { angle: 1.0, first: normal, second: Matrix::outer(normal, normal) };
        }
        let (basis, towards) = self.directions(rank, face);
        let cofaces = &self.cofaces[rank][face];
        let angle = match m {
            2 => angle_between(self.facet_normal(cofaces[0]), self.facet_normal(cofaces[1])),
            3 => self.girard(face, rank, &towards),
            _ => {
                let cones = self.triangulation(rank, face);
                let normals = |cone: &Vec<u32>| cone.iter().map(|&f| self.facet_normal(f)).collect::<Vec<_>>();
                let share: f64 = cones.iter().map(|cone| shares.share(&normals(cone))).sum();
                share * unit_sphere(m)
            }
        };
        let projection = basis.iter().fold(Matrix::IDENTITY, |p, &b| p - Matrix::outer(b, b));
        let mut cone = Cone { angle, first: Vector::ZERO, second: projection * angle };
        for (&coface, &direction) in cofaces.iter().zip(&towards) {
            let side = &above[coface as usize];
            cone.first -= direction * (side.angle / (m - 1) as f64);
            cone.second += Matrix::outer(direction, side.first) * -1.0;
        }
        cone.second = symmetric(&(cone.second * (1.0 / m as f64)));
        cone
    }

    /// An orthonormal basis of the face's own directions, and for each coface the unit vector orthogonal to the face
    /// that points into it.
    pub(crate) fn directions(&self, rank: usize, face: usize) -> (Vec<Vector<N>>, Vec<Vector<N>>) {
        let vertices = self.polytope.vertices();
        let own = &self.lattice.faces(rank)[face].vertices;
        let base = vertices[own[0] as usize];
        let mut basis: Vec<Vector<N>> = Vec::with_capacity(rank);
        for _ in 0..rank {
            // The vertex farthest from the flat so far keeps the basis accurate.
            let heights = own.iter().map(|&v| orthogonal_part(vertices[v as usize] - base, &basis));
            let best = heights.fold(Vector::ZERO, |best, h| if h.norm_sq() > best.norm_sq() { h } else { best });
            basis.push(best.normalize_or_zero());
        }
        let towards = self.cofaces[rank][face].iter().map(|&coface| {
            let others = &self.lattice.faces(rank + 1)[coface as usize].vertices;
            let heights = others.iter().map(|&v| orthogonal_part(vertices[v as usize] - base, &basis));
            heights
                .fold(Vector::ZERO, |best, h| if h.norm_sq() > best.norm_sq() { h } else { best })
                .normalize_or_zero()
        });
        let towards = towards.collect();
        (basis, towards)
    }

    /// Solid angle of a cone of dimension three: 2π less the outer angles between neighbouring sides.
    fn girard(&self, face: usize, rank: usize, towards: &[Vector<N>]) -> f64 {
        let cofaces = &self.cofaces[rank][face];
        let mut angle = 2.0 * std::f64::consts::PI;
        for (i, &a) in cofaces.iter().enumerate() {
            for (j, &b) in cofaces.iter().enumerate().skip(i + 1) {
                let (facets_a, facets_b) = (&self.facets[rank + 1][a as usize], &self.facets[rank + 1][b as usize]);
                if facets_a.iter().any(|f| facets_b.contains(f)) {
                    angle -= angle_between(towards[i], towards[j]);
                }
            }
        }
        angle
    }

    /// The normal cone cut into simplicial cones, each as facets whose normals are its edges: those of the cofaces
    /// that are not in the first facet, joined to it.
    fn triangulation(&self, rank: usize, face: usize) -> Vec<Vec<u32>> {
        let facets = &self.facets[rank][face];
        if facets.len() == N - rank {
            return vec![facets.clone()];
        }
        let mut cones = Vec::new();
        for &coface in &self.cofaces[rank][face] {
            if !self.facets[rank + 1][coface as usize].contains(&facets[0]) {
                for mut cone in self.triangulation(rank + 1, coface as usize) {
                    cone.push(facets[0]);
                    cones.push(cone);
                }
            }
        }
        cones
    }
}

impl<const N: usize> Normals<'_, N> {
    /// The simplicial cones of all triangulations, each counted by what its solid angle costs.
    fn work(&self) -> u64 {
        let mut counts = vec![1_u64; self.lattice.faces(N - 1).len()];
        let mut work = 0_u64;
        for rank in (0..N - 1).rev() {
            let count = |face: usize| {
                let facets = &self.facets[rank][face];
                if facets.len() == N - rank {
                    return 1;
                }
                let parts = self.cofaces[rank][face].iter().map(|&c| c as usize);
                let opposite = parts.filter(|&c| !self.facets[rank + 1][c].contains(&facets[0]));
                opposite.fold(0_u64, |sum, c| sum.saturating_add(counts[c]))
            };
            counts = (0..self.lattice.faces(rank).len()).map(count).collect();
            // In tens of microseconds: elementary up to three dimensions, one integral for four and five, then two.
            let cost = [0, 0, 0, 0, 1, 4].get(N - rank).copied().unwrap_or(100);
            work = counts.iter().fold(work, |sum, &c| sum.saturating_add(c.saturating_mul(cost)));
        }
        work
    }
}

/// What is left of `v` without its parts along orthonormal vectors; taken away twice, so that nothing is left of them.
pub(crate) fn orthogonal_part<const N: usize>(mut v: Vector<N>, basis: &[Vector<N>]) -> Vector<N> {
    for _ in 0..2 {
        for &b in basis {
            v -= b * b.dot(v);
        }
    }
    v
}

/// The angle between unit vectors in [0, π], accurate also where it is small or close to π (W. Kahan).
fn angle_between<const N: usize>(a: Vector<N>, b: Vector<N>) -> f64 {
    2.0 * scalar::atan2((a - b).norm(), (a + b).norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every direction is in the normal cone of exactly one vertex, however sharp or blunt the corners are.
    fn check<const N: usize>() {
        let mut state = 12_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
        };
        for (count, squash) in [(N + 1, 1.0), (N + 2, 1.0), (N + 4, 1.0), (N + 2, 0.05)] {
            let mut points: Vec<Vector<N>> = (0..count).map(|_| Vector::from_fn(|_| next())).collect();
            points.iter_mut().for_each(|p| p[0] *= squash);
            let polytope = Polytope::from_points(&points).unwrap();
            let lattice = polytope.face_lattice();
            let normals = Normals::new(&polytope, &lattice);
            let mut shares = ConeShares::default();
            let mut above = Vec::new();
            for rank in (0..N).rev() {
                let faces = 0..lattice.faces(rank).len();
                above = faces.map(|face| normals.cone(rank, face, &above, &mut shares)).collect();
            }
            let angle: f64 = above.iter().map(|cone| cone.angle).sum::<f64>() / unit_sphere(N);
            let first = above.iter().fold(Vector::ZERO, |sum, cone| sum + cone.first);
            let second = above.iter().fold(Matrix::ZERO, |sum, cone| sum + cone.second) * (1.0 / unit_sphere(N));
            let mean = Matrix::IDENTITY * (1.0 / N as f64);
            assert!((angle - 1.0).abs() < 1e-11, "{angle}");
            assert!(first.max_abs() < 1e-14, "{first:?}");
            assert!((second - mean).max_abs() < 1e-11, "{second:?}");
        }
    }

    #[test]
    fn normal_cones_of_the_vertices_fill_all_directions() {
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
    }
}
