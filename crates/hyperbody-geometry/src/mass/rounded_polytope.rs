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
//! cone from there on (see [`orthant`](super::orthant)); of cones too narrow for that it is the volume that their sections
//! add up to (see [`ConeCuts`]). Nothing is approximated but integrals of analytic functions, to 1e-12.

use hyperbody_math::{Matrix, Vector, scalar};

use super::MassProperties;
use super::boundary::{Moments, of_polytope, symmetric};
use super::normals::{Normals, angle_between, orthogonal_part};
use super::orthant::ConeShares;
use crate::error::GeometryErrorKind::Flat;
use crate::section::ConeCuts;
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

/// What the normal cones of all vertices may miss of all directions, in parts of them: more is noise.
const MAX_MISSED: f64 = 1e-8;

/// The same where they are measured by their sections. What is missed is missed of a ball within the body.
const MAX_MISSED_BY_SECTIONS: f64 = 2e-7;

/// What facets that are joined may change of the mass, in parts of it.
const MAX_MOVED: f64 = 1e-6;

/// Up to so many dimensions facets are joined only if they move by less than that. Beyond, to measure all cones by their sections could take
/// minutes: they are joined however far that moves them, and the mass of a thin and uneven body can be off by as many parts as it is uneven.
const MAX_MEASURED: usize = 4;

/// Directions along which cones are measured by their sections, until one does: irrational, so that no lattice is met.
const PHASES: [f64; 3] = [0.0, 1.0, 2.0];

/// The properties of the rounded polytope at unit density.
///
/// Where noise has split facets, or the body is thin and uneven, normal cones are too narrow for sums over their simplicial parts. That
/// shows, for the cones of all vertices together are all directions. Then facets are joined, if that moves them by noise only; of a thin
/// body it can move parts that count. The cones of what is left are measured by their sections, which may be narrow.
///
/// # Errors
/// `BadCount` if its normal cones fall into more simplicial ones than [`MAX_CONE_WORK`](crate::tolerances::MAX_CONE_WORK) allows;
/// `Flat` if they cannot be measured.
pub(super) fn properties<const N: usize>(polytope: &Polytope<N>, radius: f64) -> Result<MassProperties<N>> {
    if let Some(properties) = by_shares(polytope, radius)? {
        return Ok(properties);
    }
    for joined in polytope.with_joined_facets() {
        if N <= MAX_MEASURED && moved(polytope, &joined, radius) > MAX_MOVED {
            break;
        }
        if let Some(properties) = by_shares(&joined, radius)? {
            return Ok(properties);
        }
    }
    let by_sections = if N <= MAX_MEASURED { by_sections(polytope, radius) } else { None };
    by_sections.ok_or_else(|| {
        GeometryError::new(
            Flat,
            "facets of a rounded polytope are so nearly parallel, or the whole is so thin, that the directions of its corners cannot be \
             measured: give its vertices with more digits, leave out those that hardly stand out, or use the polytope without rounding",
        )
    })
}

/// The properties by shares of simplicial cones; `None` if the normal cones do not make up all directions.
fn by_shares<const N: usize>(polytope: &Polytope<N>, radius: f64) -> Result<Option<MassProperties<N>>> {
    let lattice = polytope.face_lattice();
    let normals = Normals::new(polytope, &lattice);
    normals.check_work()?;
    let mut shares = ConeShares::default();
    let solid_angle = |rank: usize, face: usize, excess: f64| normals.shared_angle(rank, face, excess, &mut shares);
    Ok(normals.rounded(radius, MAX_MISSED, solid_angle))
}

/// The same by the sections of the cones across a direction.
fn by_sections<const N: usize>(polytope: &Polytope<N>, radius: f64) -> Option<MassProperties<N>> {
    let lattice = polytope.face_lattice();
    let normals = Normals::new(polytope, &lattice);
    PHASES.into_iter().find_map(|phase| {
        let direction = Vector::from_fn(|i| scalar::sin(phase + 1.7 * (i as f64 + 1.0))).normalize_or_zero();
        let mut cuts = ConeCuts::new(&normals, direction)?;
        normals.rounded(radius, MAX_MISSED_BY_SECTIONS, |rank, face, _| cuts.solid_angle(rank, face))
    })
}

/// By what part of it the mass can change at most where facets are joined. If no vertex is farther than δ from the planes that it is
/// taken for, and a ball of radius ρ fits in, all lies between the body and itself made larger by 1 + δ/ρ.
fn moved<const N: usize>(polytope: &Polytope<N>, joined: &Polytope<N>, radius: f64) -> f64 {
    let middle = joined.vertex_mean();
    let (mut ball, mut distance) = (f64::INFINITY, 0.0_f64);
    for facet in joined.facets() {
        let above = |v: Vector<N>| facet.normal.dot(v) - facet.offset;
        let outmost = polytope.vertices().iter().map(|&v| above(v)).fold(0.0, f64::max);
        let inmost =
            facet.vertices.as_slice().iter().map(|&v| above(joined.vertices()[v as usize])).fold(0.0, f64::min);
        distance = distance.max(outmost - inmost);
        ball = ball.min(-above(middle));
    }
    N as f64 * distance / (ball + radius)
}

impl<const N: usize> Normals<'_, N> {
    /// The properties, with solid angles of cones of three dimensions and more by rank and face, and what Girard's excess says of them;
    /// `None` if the cones of all vertices miss more than so much of all directions.
    fn rounded(
        &self,
        radius: f64,
        may_miss: f64,
        mut solid_angle: impl FnMut(usize, usize, f64) -> f64,
    ) -> Option<MassProperties<N>> {
        let (polytope, lattice) = (self.polytope, self.lattice);
        let reference = polytope.vertex_mean();
        let core = of_polytope(polytope);
        let arm = core.centre - reference;
        let mut total = Moments {
            volume: core.mass,
            first: arm * core.mass,
            second: core.second_moments + Matrix::outer(arm, arm) * core.mass,
        };
        let mut above: Vec<Cone<N>> = Vec::new();
        for rank in (0..N).rev() {
            let cones: Vec<Cone<N>> =
                (0..lattice.faces(rank).len()).map(|face| self.cone(rank, face, &above, &mut solid_angle)).collect();
            for (face, cone) in cones.iter().enumerate() {
                let moments = face_moments(polytope, lattice, rank, face, reference);
                add_rounded_face(&mut total, &moments, cone, N - rank, radius);
            }
            above = cones;
        }
        let angle = above.iter().map(|cone| cone.angle).sum::<f64>() / unit_sphere(N);
        let first = above.iter().fold(Vector::ZERO, |sum, cone| sum + cone.first);
        let positive = above.iter().all(|cone| cone.angle >= -may_miss);
        let whole = (angle - 1.0).abs() < may_miss && first.max_abs() < may_miss && positive;
        whole.then(|| total.properties(reference))
    }

    /// The normal cone of a face, from those of all faces one rank higher.
    fn cone(
        &self,
        rank: usize,
        face: usize,
        above: &[Cone<N>],
        solid_angle: &mut impl FnMut(usize, usize, f64) -> f64,
    ) -> Cone<N> {
        let m = N - rank;
        if m == 1 {
            let normal = self.facet_normal(face as u32);
            return Cone { angle: 1.0, first: normal, second: Matrix::outer(normal, normal) };
        }
        let (basis, towards) = self.directions(rank, face);
        let cofaces = &self.cofaces[rank][face];
        let angle = match m {
            2 => angle_between(self.facet_normal(cofaces[0]), self.facet_normal(cofaces[1])),
            3 => solid_angle(rank, face, self.girard(face, rank, &towards)),
            _ => solid_angle(rank, face, 0.0),
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
            let mut solid_angle =
                |rank: usize, face: usize, excess: f64| normals.shared_angle(rank, face, excess, &mut shares);
            let mut above = Vec::new();
            for rank in (0..N).rev() {
                let faces = 0..lattice.faces(rank).len();
                above = faces.map(|face| normals.cone(rank, face, &above, &mut solid_angle)).collect();
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
