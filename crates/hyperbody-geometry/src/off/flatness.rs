//! Faces have to be flat: what a face that is not encloses depends on how it is divided into simplices, which no file says.

use hyperbody_math::Vector;

use super::OffFile;
use crate::error::GeometryErrorKind::BadMesh;
use crate::{GeometryError, Result};

/// Distance from flat that is passed over, in parts of half the extent: what coordinates of four digits leave.
const UNEVEN: f64 = 1e-4;

/// Units of the last place of rounded coordinates by which a corner may be off the flat through others, for each √N: half a unit
/// for itself, and more for the corners that carry the flat beyond them.
const UNITS: f64 = 2.0;

impl OffFile {
    /// Checks that every listed face of rank 2 to `N` − 1 lies in a flat of its rank, to 1e-4 of half the extent, or to what
    /// coordinates of fewer digits leave. Files of another dimension than `N` have no faces to check.
    ///
    /// # Errors
    /// `BadMesh` with the line and number of the face, and how far which corner is off.
    pub fn check_flat<const N: usize>(&self) -> Result<()> {
        let points = self.vertices::<N>().unwrap_or_default();
        let rounding = self.last_place().map_or(0.0, |unit| UNITS * unit * (N as f64).sqrt());
        let limit = rounding.max(UNEVEN * self.half_extent().0);
        let mut faces: Vec<Vec<u32>> = Vec::new();
        for rank in 2..N {
            faces = if rank == 2 { self.elements(2).to_vec() } else { self.gathered(rank, &faces) };
            for (index, corners) in faces.iter().enumerate().filter(|(_, corners)| corners.len() > rank + 1) {
                let Some(bump) = bump(&points, corners, rank).filter(|bump| bump.1 > limit) else { continue };
                return Err(self.not_flat(rank, index, bump, limit));
            }
        }
        Ok(())
    }

    /// The vertices of the facets, ascending from rank 3 on; in the plane those of the edges. Empty if the file lists none.
    #[must_use]
    pub fn facet_vertices(&self) -> Vec<Vec<u32>> {
        if self.dimension == 2 {
            let ends = |cycle: &Vec<u32>, k: usize| vec![cycle[k], cycle[(k + 1) % cycle.len()]];
            return self.elements(2).iter().flat_map(|cycle| (0..cycle.len()).map(move |k| ends(cycle, k))).collect();
        }
        (3..self.dimension).fold(self.elements(2).to_vec(), |below, rank| self.gathered(rank, &below))
    }

    /// The vertices of each face of a rank, from those of the rank below.
    fn gathered(&self, rank: usize, below: &[Vec<u32>]) -> Vec<Vec<u32>> {
        let gather = |parts: &Vec<u32>| {
            let mut vertices: Vec<u32> =
                parts.iter().filter_map(|&part| below.get(part as usize)).flatten().copied().collect();
            vertices.sort_unstable();
            vertices.dedup();
            vertices
        };
        self.elements(rank).iter().map(gather).collect()
    }

    fn not_flat(&self, rank: usize, index: usize, (corner, off): (u32, f64), limit: f64) -> GeometryError {
        let line = self.lines.get(rank - 2).and_then(|lines| lines.get(index));
        let place = line.map_or(String::new(), |line| format!("OFF, line {line}: "));
        let (flat, remedy) = if rank == 2 {
            ("plane", "divide it into triangles")
        } else {
            ("flat of its dimension", "divide it into simplices")
        };
        let message = format!(
            "{place}face {index} of rank {rank} is not flat: vertex {corner} lies {off:.3e} m off the {flat} through others of it, \
             and up to {limit:.1e} m is passed over; {remedy}, or correct its corners"
        );
        GeometryError::new(BadMesh, message)
    }
}

/// The corner farthest off the flat of dimension `rank` that is spanned by the farthest corners, and how far it is off.
fn bump<const N: usize>(points: &[Vector<N>], corners: &[u32], rank: usize) -> Option<(u32, f64)> {
    let at = |corner: u32| points.get(corner as usize).copied();
    let first = at(*corners.first()?)?;
    let mut rest: Vec<(u32, Vector<N>)> = corners.iter().filter_map(|&c| Some((c, at(c)? - first))).collect();
    let farthest =
        |rest: &[(u32, Vector<N>)]| rest.iter().copied().max_by(|a, b| a.1.norm_sq().total_cmp(&b.1.norm_sq()));
    for _ in 0..rank {
        // What lies in a flat of lower dimension lies in this one too.
        let along = farthest(&rest)?.1.try_normalize()?;
        rest.iter_mut().for_each(|(_, arm)| *arm -= along * along.dot(*arm));
    }
    farthest(&rest).map(|(corner, arm)| (corner, arm.norm()))
}
