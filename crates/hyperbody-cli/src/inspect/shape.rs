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
    /// What the file lists, if that is not the same: flat neighbours are joined to one face.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) faces_in_file: Option<Vec<usize>>,
    pub(super) volume: f64,
    pub(super) centroid: Vec<f64>,
    /// About the centroid, at unit density.
    pub(super) second_moments: Vec<Vec<f64>>,
    /// Per unit mass, descending.
    pub(super) principal_moments: Vec<f64>,
    pub(super) convex: bool,
    pub(super) closed: bool,
    /// What a body of this shape has, if that is not the same: of a surface that crosses itself it is the union of what the surface
    /// winds around, each region once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) body: Option<Body>,
}

/// Mass properties of a body at unit density.
#[derive(Serialize)]
pub(super) struct Body {
    pub(super) volume: f64,
    pub(super) centroid: Vec<f64>,
    pub(super) second_moments: Vec<Vec<f64>>,
    pub(super) principal_moments: Vec<f64>,
}

impl Body {
    fn new<const N: usize>(mass: &MassProperties<N>) -> Self {
        let (principal, _) = mass.principal();
        Self {
            volume: mass.mass,
            centroid: mass.centre.iter().collect(),
            second_moments: (0..N).map(|row| mass.second_moments.row(row).iter().collect()).collect(),
            principal_moments: principal.iter().map(|moment| moment / mass.mass).collect(),
        }
    }
}

/// Volumes that differ by less, in parts of them, are the same.
const SAME_VOLUME: f64 = 1e-9;

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
            let mut report = of_mass(faces, &mass, false, self.0.closed);
            // A surface that cannot be made a body, for want of room, is weighed all the same.
            let body = self.0.build::<N>().ok().and_then(|shape| shape.mass_properties(1.0).ok());
            report.body =
                body.filter(|body| (body.mass / mass.mass - 1.0).abs() > SAME_VOLUME).map(|body| Body::new(&body));
            return Ok(report);
        }
        let shape = self.0.build::<N>()?;
        let mass = shape.mass_properties(1.0).map_err(|error| Failure::Input(error.to_string()))?;
        let convex = !matches!(&shape, Shape::Compound { parts } if parts.len() > 1);
        let mut report = of_mass(face_counts(&shape), &mass, convex, self.0.closed);
        report.faces_in_file = self.0.listed_faces()?.filter(|listed| *listed != report.faces);
        Ok(report)
    }
}

fn of_mass<const N: usize>(faces: Vec<usize>, mass: &MassProperties<N>, convex: bool, closed: bool) -> Report {
    let Body { volume, centroid, second_moments, principal_moments } = Body::new(mass);
    Report {
        dimension: N,
        faces,
        volume,
        centroid,
        second_moments,
        principal_moments,
        convex,
        closed,
        faces_in_file: None,
        body: None,
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
        let counted = |counts: &[usize]| {
            let words: Vec<String> = counts.iter().zip(names).map(|(count, name)| format!("{count} {name}")).collect();
            words.join(", ")
        };
        lines.push(("faces", counted(&report.faces)));
        if let Some(listed) = &report.faces_in_file {
            let why = "flat neighbours are joined, and vertices that no face needs are left out";
            lines.push(("in the file", format!("{}: {why}", counted(listed))));
        }
    }
    let counted =
        if report.body.is_some() { ", regions counted as often as the surface winds around them" } else { "" };
    lines.push(("volume", format!("{} m^{}{counted}", number(report.volume), report.dimension)));
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
    if let Some(body) = &report.body {
        let volume = format!("{} m^{}, each region once", number(body.volume), report.dimension);
        lines.push(("as a body: volume", volume));
        lines.push(("centroid", format!("{} m", numbers(&body.centroid))));
        lines.push(("principal moments", format!("{} m²", numbers(&body.principal_moments))));
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
