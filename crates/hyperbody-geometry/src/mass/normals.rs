//! The normal cones of the faces of a polytope, as the lattice of faces gives them: the cone of a face is spanned by the normals of the
//! facets around it, and its own facets are the cones of the faces one rank higher.

use hyperbody_math::{Vector, scalar};

use super::orthant::ConeShares;
use crate::error::GeometryErrorKind::BadCount;
use crate::tolerances::MAX_CONE_WORK;
use crate::volume::unit_sphere;
use crate::{FaceLattice, GeometryError, Polytope, Result};

/// What the cones of one rank need to know of the lattice and of the ranks above.
pub(crate) struct Normals<'a, const N: usize> {
    pub(super) polytope: &'a Polytope<N>,
    pub(super) lattice: &'a FaceLattice,
    /// By rank and face: the faces one rank higher around it.
    pub(super) cofaces: Vec<Vec<Vec<u32>>>,
    /// By rank and face: the facets around it, ascending.
    facets: Vec<Vec<Vec<u32>>>,
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
    pub(super) fn girard(&self, face: usize, rank: usize, towards: &[Vector<N>]) -> f64 {
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

    /// The solid angle of the normal cone of a face by Girard's excess, and beyond three dimensions by shares of simplicial cones.
    pub(super) fn shared_angle(&self, rank: usize, face: usize, excess: f64, shares: &mut ConeShares) -> f64 {
        let m = N - rank;
        if m <= 3 {
            return excess;
        }
        let cones = self.triangulation(rank, face);
        let normals = |cone: &Vec<u32>| cone.iter().map(|&f| self.facet_normal(f)).collect::<Vec<_>>();
        let share: f64 = cones.iter().map(|cone| shares.share(&normals(cone))).sum();
        share * unit_sphere(m)
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
    /// # Errors
    /// `BadCount` if the cones fall into more simplicial ones than [`MAX_CONE_WORK`] allows.
    pub(super) fn check_work(&self) -> Result<()> {
        let work = self.work();
        if work > MAX_CONE_WORK {
            return Err(GeometryError::new(
                BadCount,
                format!(
                    "a rounded polytope with {} facets in {N} dimensions takes {work} units of work for its solid angles; the \
                     limit is {MAX_CONE_WORK}: use fewer vertices, or the polytope without rounding",
                    self.polytope.facets().len()
                ),
            ));
        }
        Ok(())
    }

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
pub(super) fn angle_between<const N: usize>(a: Vector<N>, b: Vector<N>) -> f64 {
    2.0 * scalar::atan2((a - b).norm(), (a + b).norm())
}
