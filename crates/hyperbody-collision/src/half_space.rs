//! Rounded cores against half-spaces: every vertex near the plane, then the few that hold.

use hyperbody_geometry::{Convex, Core};
use hyperbody_math::{Pose, Vector};

use crate::difference::inner_radius;
use crate::faces::{Faces, NO_FACET};
use crate::limits;
use crate::manifold::{ContactPoint, Manifold, max_points};
use crate::patch::PatchMemory;
use crate::reduce::{Candidate, Reducer};

/// Fills `out` with the contact of a convex shape and the half-space normal·p ≤ offset (world frame, unit normal). The
/// manifold's normal points from the half-space to the shape.
pub(crate) fn collide<const N: usize>(
    shape: &Convex<N>,
    world_from_shape: &Pose<N>,
    (normal, offset): (Vector<N>, f64),
    margin: f64,
    memory: &PatchMemory,
    reducer: &mut Reducer<N>,
    out: &mut Manifold<N>,
) {
    let rotation = &world_from_shape.rotation;
    let toward_plane = rotation.inverse_rotate(-normal);
    // Separation of the shape's surface if its core were the origin alone.
    let height = world_from_shape.translation.dot(normal) - offset - shape.radius;
    let extent = shape.core.bounding_radius();
    if height - extent > margin {
        return;
    }
    reducer.candidates.clear();
    let mut gather = |point: Vector<N>, id: u32| {
        let separation = height - point.dot(toward_plane);
        if separation <= margin {
            reducer.candidates.push(Candidate { position: point, separation, id, class: None, known: false });
        }
    };
    match &shape.core {
        Core::Point => gather(Vector::ZERO, 0),
        Core::Segment { half } => {
            gather(*half, 0);
            gather(-*half, 1);
        }
        Core::Box { half_extents } => {
            for corner in 0..1_u32 << N {
                let sign = |axis: usize| if corner >> axis & 1 == 0 { half_extents[axis] } else { -half_extents[axis] };
                gather(Vector::from_fn(sign), corner);
            }
        }
        Core::Polytope(polytope) if polytope.stands_for_round() => {
            let seen = polytope.turned_toward(toward_plane);
            let facet = Faces::Polytope(polytope).facet_toward(toward_plane, NO_FACET).map(|(facet, _)| facet);
            // What is round has no facets: it is met where its lowest vertices are, and nowhere else.
            let round = facet.filter(|&facet| seen.is_round(facet));
            for (index, vertex) in seen.vertices().enumerate() {
                if round.is_none_or(|facet| seen.meets(index, facet)) {
                    gather(vertex, index as u32);
                }
            }
            if round.is_none() {
                keep_lowest(&Faces::Polytope(polytope), toward_plane, extent, LOWEST_OF_ROUND * extent, reducer);
            }
        }
        Core::Polytope(polytope) => {
            for (index, &vertex) in polytope.vertices().iter().enumerate() {
                gather(vertex, index as u32);
            }
        }
    }
    if !matches!(&shape.core, Core::Polytope(polytope) if polytope.stands_for_round()) {
        let near = (NEARLY_LOWEST * extent).min(0.5 * inner_radius(&shape.core, Vector::ZERO).max(0.0));
        keep_lowest(&Faces::of(&shape.core), toward_plane, extent, near, reducer);
    }
    if let (Core::Box { .. }, true) = (&shape.core, 1 << (N - 2) == max_points(N)) {
        classify_corners(toward_plane.axis_of_max_abs(), toward_plane, reducer);
    }
    reducer.reduce(max_points(N), memory.previous_ids(), extent);
    out.normal = normal;
    for candidate in &reducer.candidates {
        // From the vertex to its surface point, and half way on to the plane.
        let on_surface = world_from_shape.transform_point(candidate.position) - normal * shape.radius;
        let position = on_surface - normal * (0.5 * candidate.separation);
        out.push(ContactPoint { position, separation: candidate.separation, id: candidate.id });
    }
}

/// Marks the even and odd corners of a box's facet along `axis` that looks in a direction.
fn classify_corners<const N: usize>(axis: usize, direction: Vector<N>, reducer: &mut Reducer<N>) {
    let negative = u32::from(direction[axis] < 0.0);
    for candidate in &mut reducer.candidates {
        if candidate.id >> axis & 1 == negative {
            candidate.class = Some(candidate.id.count_ones() % 2 == 1);
        }
    }
}

/// Drops vertices that are within reach only because the shape has sunk deep: what is kept belongs to the lowest facet
/// or is as deep as the deepest to within `near`. Without this, spread would be sought between the bottom and the top of a box.
fn keep_lowest<const N: usize>(
    faces: &Faces<'_, N>,
    toward_plane: Vector<N>,
    extent: f64,
    near: f64,
    reducer: &mut Reducer<N>,
) {
    let Some((facet, _)) = faces.facet_toward(toward_plane, NO_FACET) else { return };
    let (facet_normal, facet_offset) = faces.plane(facet);
    let least = reducer.candidates.iter().map(|candidate| candidate.separation).fold(f64::INFINITY, f64::min);
    reducer.candidates.retain(|candidate| {
        let on_facet = facet_offset - facet_normal.dot(candidate.position) <= limits::EQUAL_DEPTH * extent;
        on_facet || candidate.separation <= least + near
    });
}

/// Height above the deepest vertex, in parts of the shape's size, up to which vertices off the lowest facet count; but no
/// more than a quarter of a flat shape's thickness, whose top does not help to hold it.
const NEARLY_LOWEST: f64 = 0.02;

/// The same for the faceted form of a curved shape, of which only the lowest points are the shape's own: its other vertices are
/// where some polytope has them, and would be stumbled over.
const LOWEST_OF_ROUND: f64 = 1e-3;
