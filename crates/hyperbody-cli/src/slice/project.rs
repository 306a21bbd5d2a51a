//! `hyperbody slice --project`: the whole shape dropped along the normals, instead of what a hyperplane cuts out of it.

use std::fmt::Write;

use hyperbody::geometry::projection::{Projection, Wireframe};
use hyperbody::geometry::{SectionPolytope, SliceFrame, Solid, Surface};
use hyperbody::math::Vector;

use super::{Pieces, Plane, Written, check_written, frame_and_rest, usual_tolerance};
use crate::failure::Failure;

/// A piece as it is seen on the way down.
pub(super) enum Seen<const N: usize> {
    Wire(Wireframe<N>),
    /// What a curved piece covers.
    Curved(Solid<N>),
}

/// How the first look is taken: along the normal, or towards an eye at this distance.
#[derive(Clone, Copy)]
pub(super) struct Eye(pub(super) Option<f64>);

impl Eye {
    fn projection<const N: usize>(self, frame: SliceFrame<N>) -> Result<Projection<N>, Failure> {
        match self.0 {
            None => Ok(Projection::parallel(frame)),
            Some(distance) => {
                Projection::perspective(frame, distance).map_err(|error| Failure::Input(format!("--eye: {error}")))
            }
        }
    }

    fn shadow<const N: usize, const M: usize>(
        self,
        solid: &Solid<N>,
        frame: &SliceFrame<N>,
    ) -> Result<Seen<M>, Failure> {
        if self.0.is_some() {
            let message = "--eye needs a shape of polytopes: curved shapes are projected in parallel only";
            return Err(Failure::Input(message.to_owned()));
        }
        let shadow = solid.shadow::<M>(frame);
        shadow.map(Seen::Curved).ok_or_else(|| Failure::Input("a half-space covers everything".to_owned()))
    }
}

/// Projects along the first normal; the others follow in the coordinates of its hyperplane.
pub(super) fn first<const N: usize, const M: usize>(
    pieces: &Pieces<N>,
    planes: &[Plane],
    eye: Eye,
) -> Result<(Vec<Seen<M>>, Vec<Plane>), Failure> {
    let (frame, rest) = frame_and_rest::<N, M>(planes)?;
    let projection = eye.projection(frame)?;
    let look = |(_, solid): &(u32, Solid<N>)| match solid {
        Solid::Polytope(polytope) => polytope.project::<M>(&projection).map(Seen::Wire).map_err(refuse),
        curved => eye.shadow(curved, &frame),
    };
    Ok((pieces.iter().map(look).collect::<Result<_, _>>()?, rest))
}

/// The same from one dimension to the next.
pub(super) fn next<const N: usize, const M: usize>(
    pieces: &[Seen<N>],
    planes: &[Plane],
    eye: Eye,
) -> Result<(Vec<Seen<M>>, Vec<Plane>), Failure> {
    let (frame, rest) = frame_and_rest::<N, M>(planes)?;
    let projection = eye.projection(frame)?;
    let look = |piece: &Seen<N>| match piece {
        Seen::Wire(wire) => wire.project::<M>(&projection).map(Seen::Wire).map_err(refuse),
        Seen::Curved(solid) => eye.shadow(solid, &frame),
    };
    Ok((pieces.iter().map(look).collect::<Result<_, _>>()?, rest))
}

fn refuse(error: hyperbody::prelude::GeometryError) -> Failure {
    Failure::Input(error.to_string())
}

/// The outlines of all pieces as surfaces, and their volume.
pub(super) fn outlines(pieces: &[Seen<3>], tolerance: Option<f64>) -> Result<Written, Failure> {
    let curved = pieces.iter().filter_map(|piece| if let Seen::Curved(solid) = piece { Some(solid) } else { None });
    let tolerance = tolerance.unwrap_or_else(|| usual_tolerance(curved));
    let mut surface = Surface::new();
    let mut volume = 0.0;
    let mut boxes = Vec::with_capacity(pieces.len());
    for (number, piece) in pieces.iter().enumerate() {
        let polytope = match piece {
            Seen::Wire(wire) => Some(SectionPolytope::from_polytope(&wire.outline().map_err(refuse)?)),
            Seen::Curved(solid) => solid.to_polytope(tolerance).map_err(refuse)?,
        };
        let Some(polytope) = polytope else { continue };
        volume += polytope.mass_properties().mass;
        boxes.push(bounds(polytope.vertices()));
        surface.add_polytope(&polytope.with_source(0), number as u32);
    }
    check_written(&surface)?;
    let overlapping = some_overlap(boxes);
    Ok(Written { surface, volume, enclosed: volume, pieces: pieces.len(), overlapping })
}

/// Whether two of the boxes overlap, by a sweep along x.
fn some_overlap(mut boxes: Vec<([f64; 3], [f64; 3])>) -> bool {
    boxes.sort_unstable_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    boxes.iter().enumerate().any(|(index, (low, high))| {
        let met =
            |other: &&([f64; 3], [f64; 3])| (1..3).all(|axis| low[axis] < other.1[axis] && other.0[axis] < high[axis]);
        boxes[index + 1..].iter().take_while(|other| other.0[0] < high[0]).any(|other| met(&other))
    })
}

/// The least and greatest coordinates.
fn bounds(points: &[Vector<3>]) -> ([f64; 3], [f64; 3]) {
    let reach = |worst: f64, better: fn(f64, f64) -> f64| {
        std::array::from_fn(|axis| points.iter().map(|point| point[axis]).fold(worst, better))
    };
    (reach(f64::INFINITY, f64::min), reach(f64::NEG_INFINITY, f64::max))
}

/// All edges and faces of the polytopes as an OBJ file: lines and polygons, those behind others included. `None` if a piece is
/// curved, which has no edges.
pub(super) fn wires_as_obj(pieces: &[Seen<3>]) -> Option<String> {
    let mut text = String::from("# the projection of all edges (l) and faces (f)\n");
    let mut first = 1;
    for piece in pieces {
        let Seen::Wire(wire) = piece else { return None };
        for v in wire.vertices() {
            let _ = writeln!(text, "v {} {} {}", v[0], v[1], v[2]);
        }
        for [a, b] in wire.edges() {
            let _ = writeln!(text, "l {} {}", first + a, first + b);
        }
        for corners in wire.polygons() {
            let words: Vec<String> = corners.iter().map(|corner| (first + corner).to_string()).collect();
            let _ = writeln!(text, "f {}", words.join(" "));
        }
        first += wire.vertices().len() as u32;
    }
    Some(text)
}
