//! The section of a polytope whose facets are too uneven for combinatorics: the hull of where its edges cross.
//!
//! Polytopes from files of few digits have facets that are flat to a ten-thousandth only, and a hyperplane almost along
//! such a facet can cross it several times. The points are right all the same, and their hull is a polytope.

use super::cut::crosses;
use super::{SectionPolytope, SectionScratch, SliceFrame};
use crate::Polytope;

/// Fills `out` with the hull of the points where edges cross; leaves it empty if they have none. The sides in `scratch`
/// are those without vertices in the hyperplane.
pub(super) fn hull_of_section<const N: usize, const M: usize>(
    body: &SectionPolytope<N>,
    frame: &SliceFrame<N>,
    scratch: &SectionScratch,
    out: &mut SectionPolytope<M>,
) {
    out.clear();
    let mut edges = Vec::new();
    let mut points = Vec::new();
    for (edge, ends) in body.ranks[0].iter().enumerate() {
        if crosses(scratch.sides[1][edge]) {
            edges.push(edge as u32);
            points.push(frame.to_slice::<M>(body.crossing_point(ends, &scratch.heights)));
        }
    }
    let relative = (body.tolerance / body.radius.max(f64::MIN_POSITIVE)).clamp(1e-10, 1e-3);
    let Ok((hull, used)) = crate::hull::convex_hull_within(&points, relative) else {
        return;
    };
    let edges: Vec<u32> = used.iter().map(|&point| edges[point as usize]).collect();
    *out = SectionPolytope { tolerance: body.tolerance, ..SectionPolytope::from_polytope(&hull) };
    let edges_of_facets = edges_of_facets(body);
    out.facet_sources = sources(&hull, &edges, &edges_of_facets, &body.facet_sources);
}

/// Ascending edges of each facet.
fn edges_of_facets<const N: usize>(body: &SectionPolytope<N>) -> Vec<Vec<u32>> {
    let gather = |facet: usize| {
        let mut parts = vec![facet as u32];
        for faces in body.ranks[1..].iter().rev() {
            parts = parts.iter().flat_map(|&part| faces.get(part as usize)).copied().collect();
            parts.sort_unstable();
            parts.dedup();
        }
        parts
    };
    (0..body.facet_sources.len()).map(gather).collect()
}

/// For each facet of the hull the source of the body's facet that most of its vertices were cut from.
fn sources<const M: usize>(
    hull: &Polytope<M>,
    edges: &[u32],
    edges_of_facets: &[Vec<u32>],
    facet_sources: &[u32],
) -> Vec<u32> {
    let votes = |facet: &crate::polytope::Facet<M>, body_facet: &[u32]| {
        facet.vertices.iter().filter(|&&v| body_facet.binary_search(&edges[v as usize]).is_ok()).count()
    };
    let best = |facet: &crate::polytope::Facet<M>| {
        let counts = edges_of_facets.iter().map(|edges| votes(facet, edges));
        let (index, _) =
            counts.enumerate().fold((0, 0), |best, (i, count)| if count > best.1 { (i, count) } else { best });
        facet_sources.get(index).copied().unwrap_or(0)
    };
    hull.facets().iter().map(best).collect()
}
