//! The contact patch of two cores along a given normal, for every pair with facets and every `N`.
//!
//! Reference facet F (normal f, offset c_f) and incident facet G are the facets of the two cores most aligned with the
//! normal n. Both are projected along n and intersected: every facet that shares a ridge with F (normal m, offset c_m)
//! bounds the projection of F by
//!
//! ```text
//! s·x ≤ c_m (f·n) − c_f (m·n),   s = m (f·n) − f (m·n),   s·n = 0,
//! ```
//!
//! the combination of the two planes that does not change along n, which holds whenever f·n > 0. G's vertices are cut by
//! these in `N` coordinates; no basis of the tangent space is needed. A vertex p left has separation (f·p − c_f)/(f·n).
//! Facet against facet, edge against edge, vertex contacts and everything between them are the same code.

use hyperbody_geometry::Convex;
use hyperbody_math::{Pose, Vector};

use crate::clip::{Clipper, feature_hash};
use crate::faces::{Faces, NO_FACET};
use crate::limits;
use crate::manifold::{ContactPoint, Manifold, max_points};
use crate::reduce::{Candidate, Reducer};

/// Constraints that the usual clipper has room for, in words of 64.
const SMALL: usize = 2;

/// The same for shapes with hundreds of facets around one: 2048 constraints, beyond which only the witness is kept.
const LARGE: usize = 32;

/// Working memory of the patch builder.
#[derive(Clone, Debug, Default)]
pub(crate) struct PatchScratch<const N: usize> {
    small: Clipper<N, SMALL>,
    large: Clipper<N, LARGE>,
    pub(crate) reducer: Reducer<N>,
    /// Most vertices left after cutting a patch.
    pub(crate) most_vertices: u32,
}

/// What is left of the previous step's patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PatchMemory {
    pub(crate) reference_is_b: bool,
    /// The facets of a and b that met.
    pub(crate) facets: [u32; 2],
    pub(crate) ids: [u32; crate::MAX_POINTS],
    pub(crate) len: u32,
}

impl Default for PatchMemory {
    fn default() -> Self {
        Self { reference_is_b: false, facets: [NO_FACET; 2], ids: [0; crate::MAX_POINTS], len: 0 }
    }
}

impl PatchMemory {
    pub(crate) fn previous_ids(&self) -> &[u32] {
        &self.ids[..self.len as usize]
    }

    /// Notes the ids of a finished manifold.
    pub(crate) fn remember<const N: usize>(&mut self, manifold: &Manifold<N>) {
        self.len = manifold.points().len() as u32;
        for (slot, point) in self.ids.iter_mut().zip(manifold.points()) {
            *slot = point.id;
        }
    }
}

/// One of the two shapes.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a, const N: usize> {
    pub(crate) faces: Faces<'a, N>,
    pub(crate) world_from_core: &'a Pose<N>,
    pub(crate) radius: f64,
    /// Radius of a ball about the core's origin that holds it.
    pub(crate) extent: f64,
}

impl<'a, const N: usize> Side<'a, N> {
    pub(crate) fn new(shape: &'a Convex<N>, world_from_core: &'a Pose<N>) -> Self {
        Self {
            faces: Faces::of(&shape.core),
            world_from_core,
            radius: shape.radius,
            extent: shape.core.bounding_radius(),
        }
    }
}

/// The direction to build a patch along: unit, in a's frame, from a to b.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Along<const N: usize> {
    /// Or along the normal of the reference facet, if that is the same to [`limits::SNAP_ANGLE_SQ`].
    Nearly(Vector<N>),
    Exactly(Vector<N>),
}

/// Fills `out` with the patch of two cores along a normal, leaving out points farther apart than `margin`. Returns the least core separation over the patch, or `None` if the projections of the
/// facets do not meet or no core has facets.
#[expect(clippy::too_many_arguments, reason = "two sides, how they lie, and the memory of three lifetimes")]
pub(crate) fn build<const N: usize>(
    a: &Side<'_, N>,
    b: &Side<'_, N>,
    a_from_b: &Pose<N>,
    along: Along<N>,
    margin: f64,
    memory: &mut PatchMemory,
    scratch: &mut PatchScratch<N>,
    out: &mut Manifold<N>,
) -> Option<f64> {
    let (Along::Nearly(normal) | Along::Exactly(normal)) = along;
    let exact = matches!(along, Along::Exactly(_));
    let facet_a = a.faces.facet_toward(normal, memory.facets[0]);
    let facet_b = b.faces.facet_toward(-a_from_b.rotation.inverse_rotate(normal), memory.facets[1]);
    memory.facets = [facet_a, facet_b].map(|facet| facet.map_or(NO_FACET, |(facet, _)| facet as u32));
    let reference_is_b = match (facet_a, facet_b) {
        (Some((_, cosine_a)), Some((_, cosine_b))) => {
            let preference = if memory.reference_is_b { -1.0 } else { 1.0 } * limits::REFERENCE_PREFERENCE;
            cosine_b > cosine_a + preference
        }
        (facet_a, _) => facet_a.is_none(),
    };
    memory.reference_is_b = reference_is_b;
    let incident_facet = |facet: Option<(usize, f64)>| facet.map_or(0, |(facet, _)| facet);
    let plan = if reference_is_b {
        Plan {
            reference: b,
            incident: a,
            reference_from_incident: a_from_b.inverse(),
            normal: -a_from_b.rotation.inverse_rotate(normal),
            facet: facet_b?.0,
            incident_facet: incident_facet(facet_a),
            reference_parity: 1,
            exact,
            margin,
        }
    } else {
        Plan {
            reference: a,
            incident: b,
            reference_from_incident: *a_from_b,
            normal,
            facet: facet_a?.0,
            incident_facet: incident_facet(facet_b),
            reference_parity: 0,
            exact,
            margin,
        }
    };
    let PatchScratch { small, large, reducer, most_vertices } = scratch;
    let constraints =
        plan.incident.faces.neighbour_count(plan.incident_facet) + plan.reference.faces.neighbour_count(plan.facet);
    let (least, vertices) = if constraints <= 64 * SMALL {
        (plan.clip(small, reducer), small.vertices.len())
    } else {
        (plan.clip(large, reducer), large.vertices.len())
    };
    let least = least?;
    *most_vertices = (*most_vertices).max(vertices as u32);
    reducer.reduce(max_points(N), memory.previous_ids(), a.extent.min(b.extent));
    let sign = if reference_is_b { -1.0 } else { 1.0 };
    let world = plan.reference.world_from_core;
    out.normal = world.rotation.rotate(plan.snapped_normal().0) * sign;
    for candidate in &reducer.candidates {
        let position = world.transform_point(candidate.position);
        out.push(ContactPoint { position, separation: candidate.separation, id: candidate.id });
    }
    Some(least)
}

/// Who is clipped against whom, all in the frame of the reference core.
struct Plan<'a, const N: usize> {
    reference: &'a Side<'a, N>,
    incident: &'a Side<'a, N>,
    reference_from_incident: Pose<N>,
    /// Unit, from the reference to the incident core.
    normal: Vector<N>,
    facet: usize,
    incident_facet: usize,
    /// 0 if the reference is shape a, 1 if it is b.
    reference_parity: u32,
    /// Whether the normal is to be kept to the bit.
    exact: bool,
    margin: f64,
}

impl<const N: usize> Plan<'_, N> {
    /// The normal, or the reference facet's where they are the same to rounding; and the cosine between them.
    fn snapped_normal(&self) -> (Vector<N>, f64) {
        let (facet_normal, _) = self.reference.faces.plane(self.facet);
        // The reference facet is the end of its shape along its own normal: only the incident shape swings.
        let swing = (self.incident.extent / self.reference.extent).max(1.0);
        let same = (facet_normal - self.normal).norm_sq() * (swing * swing) <= limits::SNAP_ANGLE_SQ;
        if same && !self.exact { (facet_normal, 1.0) } else { (self.normal, facet_normal.dot(self.normal)) }
    }

    /// Clips and leaves the candidates in the reducer. The least core separation, or `None` if nothing is left.
    fn clip<const W: usize>(&self, clipper: &mut Clipper<N, W>, reducer: &mut Reducer<N>) -> Option<f64> {
        let faces = &self.reference.faces;
        let (facet_normal, facet_offset) = faces.plane(self.facet);
        let (normal, cosine) = self.snapped_normal();
        if cosine <= 0.0 || cosine.is_nan() {
            return None;
        }
        self.incident.faces.load_facet(self.incident_facet, &self.reference_from_incident, clipper);
        let tolerance = limits::ON_PLANE * (self.reference.extent + self.incident.extent);
        let mut left = true;
        faces.for_each_neighbour(self.facet, |feature, other_normal, other_offset| {
            let slope = other_normal.dot(normal);
            let side = other_normal * cosine - facet_normal * slope;
            let length_sq = side.norm_sq();
            if left && length_sq > limits::PARALLEL_SQ {
                let scale = 1.0 / length_sq.sqrt();
                let offset = (other_offset * cosine - facet_offset * slope) * scale;
                left = clipper.cut(side * scale, offset, tolerance, feature as u32);
            }
        });
        if !left {
            return None;
        }
        self.collect(clipper, reducer, normal, (facet_normal / cosine, facet_offset / cosine))
    }

    /// Turns clipped vertices into candidates midway between the two surfaces.
    fn collect<const W: usize>(
        &self,
        clipper: &Clipper<N, W>,
        reducer: &mut Reducer<N>,
        normal: Vector<N>,
        (height_gradient, height_offset): (Vector<N>, f64),
    ) -> Option<f64> {
        let rounding = self.reference.radius + self.incident.radius;
        let lean = 0.5 * (self.reference.radius - self.incident.radius);
        let incident_parity = 1 - self.reference_parity;
        let both_facets = feature_hash(self.facet as u32, self.reference_parity)
            .wrapping_add(feature_hash(self.incident_facet as u32, incident_parity));
        let mut least = f64::INFINITY;
        reducer.candidates.clear();
        for (index, vertex) in clipper.vertices.iter().enumerate() {
            let gap = vertex.point.dot(height_gradient) - height_offset;
            least = least.min(gap);
            if gap - rounding <= self.margin {
                reducer.candidates.push(Candidate {
                    position: vertex.point - normal * (0.5 * gap - lean),
                    separation: gap - rounding,
                    id: clipper.feature_id(index, incident_parity).wrapping_add(both_facets),
                    class: None,
                    known: false,
                });
            }
        }
        if let Faces::Box(_) = self.reference.faces
            && 1 << (N - 2) == max_points(N)
            && reducer.candidates.len() > max_points(N)
        {
            classify(self.facet / 2, &mut reducer.candidates);
        }
        Some(least)
    }
}

/// Puts the corner of each orthant of a box's facet (`across` is the axis along its normal) into the class of even or odd
/// corners. Rounding may leave several vertices where two planes nearly coincide; one an orthant is enough.
fn classify<const N: usize>(across: usize, candidates: &mut [Candidate<N>]) {
    let (mut lower, mut upper) = (candidates[0].position, candidates[0].position);
    for candidate in candidates.iter() {
        (lower, upper) = (lower.min(candidate.position), upper.max(candidate.position));
    }
    let middle = (lower + upper) * 0.5;
    let along = |axis: usize| axis != across;
    let mut corners = [None; 32];
    for (index, candidate) in candidates.iter().enumerate() {
        let offset = candidate.position - middle;
        let orthant =
            (0..N).filter(|&axis| along(axis)).fold(0, |bits, axis| bits << 1 | usize::from(offset[axis] < 0.0));
        let distance = (0..N).filter(|&axis| along(axis)).map(|axis| offset[axis].abs()).sum::<f64>();
        let corner: &mut Option<(usize, f64)> = &mut corners[orthant];
        if corner.is_none_or(|(_, most)| distance > most) {
            *corner = Some((index, distance));
        }
    }
    for (orthant, corner) in corners.iter().enumerate() {
        if let Some((index, _)) = corner {
            candidates[*index].class = Some(orthant.count_ones() % 2 == 1);
        }
    }
}
