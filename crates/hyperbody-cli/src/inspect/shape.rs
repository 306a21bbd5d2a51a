//! Mass properties and face counts of one shape.

use hyperbody::geometry::{FaceLattice, MassProperties};
use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::Shape;
use hyperbody_scene::{DimensionVisitor, ShapeFile, visit_dimension};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{labelled, number, numbers};

#[derive(Serialize)]
pub(super) struct Report {
    pub(super) dimension: usize,
    /// Numbers of vertices, edges, …, facets; empty for shapes that are round or made of parts.
    pub(super) faces: Vec<usize>,
    pub(super) volume: f64,
    pub(super) centroid: Vec<f64>,
    /// About the centroid, at unit density.
    pub(super) second_moments: Vec<Vec<f64>>,
    /// Per unit mass, descending.
    pub(super) principal_moments: Vec<f64>,
    pub(super) convex: bool,
    pub(super) closed: bool,
}

pub(super) fn report(file: &ShapeFile) -> Result<Report, Failure> {
    visit_dimension(file.dimension, Visit(file))
        .unwrap_or_else(|| Err(Failure::Input(format!("there are no shapes of {} dimensions", file.dimension))))
}

struct Visit<'a>(&'a ShapeFile);

impl DimensionVisitor for Visit<'_> {
    type Output = Result<Report, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        if let Some((faces, mass)) = self.0.mesh::<N>()? {
            return Ok(of_mass(faces, &mass, false, self.0.closed));
        }
        let shape = self.0.build::<N>()?;
        let mass = shape.mass_properties(1.0).map_err(|error| Failure::Input(error.to_string()))?;
        let convex = !matches!(&shape, Shape::Compound { parts } if parts.len() > 1);
        Ok(of_mass(face_counts(&shape), &mass, convex, self.0.closed))
    }
}

fn of_mass<const N: usize>(faces: Vec<usize>, mass: &MassProperties<N>, convex: bool, closed: bool) -> Report {
    let (principal, _) = mass.principal();
    Report {
        dimension: N,
        faces,
        volume: mass.mass,
        centroid: mass.centre.iter().collect(),
        second_moments: (0..N).map(|row| mass.second_moments.row(row).iter().collect()).collect(),
        principal_moments: principal.iter().map(|moment| moment / mass.mass).collect(),
        convex,
        closed,
    }
}

fn face_counts<const N: usize>(shape: &Shape<N>) -> Vec<usize> {
    match shape {
        Shape::Polytope(polytope) => FaceLattice::new(polytope).face_counts(),
        Shape::Box { .. } => cube_face_counts(N),
        _ => Vec::new(),
    }
}

/// A cube of `n` dimensions has 2^(n−k) · C(n, k) faces of rank k: choose the axes along which the face extends, and a
/// side for every other one.
fn cube_face_counts(n: usize) -> Vec<usize> {
    let mut counts = Vec::with_capacity(n);
    let mut binomial = 1;
    for rank in 0..n {
        counts.push(binomial << (n - rank));
        binomial = binomial * (n - rank) / (rank + 1);
    }
    counts
}

pub(super) fn as_text(report: &Report, name: &str) -> String {
    let mut lines = Vec::new();
    if !report.faces.is_empty() {
        let names = ["vertices", "edges", "faces", "cells", "4-faces", "5-faces"];
        let counts: Vec<String> =
            report.faces.iter().zip(names).map(|(count, name)| format!("{count} {name}")).collect();
        lines.push(("faces", counts.join(", ")));
    }
    lines.push(("volume", format!("{} m^{}", number(report.volume), report.dimension)));
    lines.push(("centroid", format!("{} m", numbers(&report.centroid))));
    lines.push(("principal moments", format!("{} m²", numbers(&report.principal_moments))));
    // J of the paper, and what most books do not mean by the word.
    let meaning = "second moments J along the principal axes, ∫x² about the centroid, per unit mass";
    lines.push(("", meaning.to_owned()));
    let inertia = "the moment of inertia in the plane of axes i and j is (J_i + J_j) times the mass";
    lines.push(("", inertia.to_owned()));
    for (index, row) in report.second_moments.iter().enumerate() {
        lines.push((if index == 0 { "second moments" } else { "" }, numbers(row)));
    }
    let yes_or_no = |value| (if value { "yes" } else { "no" }).to_owned();
    lines.push(("convex", yes_or_no(report.convex)));
    lines.push(("closed", yes_or_no(report.closed)));
    format!("{name}: a shape of {} dimensions\n\n{}", report.dimension, labelled(lines))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubes_have_their_faces() {
        assert_eq!(cube_face_counts(2), [4, 4]);
        assert_eq!(cube_face_counts(3), [8, 12, 6]);
        assert_eq!(cube_face_counts(4), [16, 32, 24, 8]);
        assert_eq!(cube_face_counts(6), [64, 192, 240, 160, 60, 12]);
    }
}
