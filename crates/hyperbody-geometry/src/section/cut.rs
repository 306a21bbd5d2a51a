//! The cut of a polytope by a hyperplane, by combinatorics: coordinates only decide on which side each vertex is.
//!
//! The faces of P ∩ H are the non-empty F ∩ H, and each has a smallest such F. So the faces of rank r of a section are
//! the faces of rank r + 1 of the body with vertices on both sides, and its faces of rank r that lie in H. Which face
//! bounds which is inherited. Hyperplanes through vertices, along edges and in facets need nothing further.

use hyperbody_math::Vector;

use super::fallback;
use super::{SectionPolytope, SliceFrame};

/// Working memory of cuts, to be kept so that nothing is allocated once it has grown. Its contents never influence a
/// result.
#[derive(Clone, Debug, Default)]
pub struct SectionScratch {
    /// Signed distances of the vertices from the hyperplane.
    pub(super) heights: Vec<f64>,
    /// For each rank and face, on which sides it has vertices: bits [`BELOW`], [`WITHIN`], [`ABOVE`].
    pub(super) sides: Vec<Vec<u8>>,
    /// For each rank and face its number in the section; meaningless where it has none.
    numbers: Vec<Vec<u32>>,
    /// How many facets of the section each ridge is in.
    uses: Vec<u32>,
}

pub(super) const BELOW: u8 = 1;
pub(super) const WITHIN: u8 = 2;
pub(super) const ABOVE: u8 = 4;

#[inline]
pub(super) fn crosses(side: u8) -> bool {
    side & (BELOW | ABOVE) == BELOW | ABOVE
}

impl<const N: usize> SectionPolytope<N> {
    /// The intersection with the hyperplane of `frame`, in its coordinates, into `out`, whatever that held before; `M` has
    /// to be `N − 1`. `false` if it is empty, which is found at the cost of one distance where the body is far away.
    ///
    /// Vertices are in the hyperplane if they are there to rounding, or as closely as the facets of the body are flat.
    /// A hyperplane that touches the body in a facet gives that facet; one that touches it in less gives nothing.
    pub fn section_into<const M: usize>(
        &self,
        frame: &SliceFrame<N>,
        scratch: &mut SectionScratch,
        out: &mut SectionPolytope<M>,
    ) -> bool {
        const { assert!(M + 1 == N, "a section has one dimension less than the body") };
        out.clear();
        out.tolerance = self.tolerance;
        let distance = frame.height(self.centre).abs();
        if self.is_empty() || distance.is_nan() || distance > self.radius + self.tolerance {
            return false;
        }
        if !self.find_heights(frame, scratch, self.tolerance) {
            return false;
        }
        // Where facets are uneven, rounding can put vertices in the hyperplane that no flat polytope has there together.
        self.find_sides(scratch);
        self.write(frame, scratch, out);
        if !out.is_polytope(&mut scratch.uses) {
            self.find_heights(frame, scratch, 0.0);
            self.find_sides(scratch);
            self.write(frame, scratch, out);
            if !out.is_polytope(&mut scratch.uses) {
                fallback::hull_of_section(self, frame, scratch, out);
            }
        }
        out.measure();
        !out.is_empty()
    }

    /// The intersection with the hyperplane of `frame`, in its coordinates; see [`SectionPolytope::section_into`].
    #[must_use]
    pub fn section<const M: usize>(&self, frame: &SliceFrame<N>) -> SectionPolytope<M> {
        let mut out = SectionPolytope::new();
        self.section_into(frame, &mut SectionScratch::default(), &mut out);
        out
    }

    /// Heights and sides of the vertices. With tolerance zero, vertices in the hyperplane count as above it. `false` if
    /// all are strictly on one side, or too few for a facet touch.
    fn find_heights(&self, frame: &SliceFrame<N>, scratch: &mut SectionScratch, tolerance: f64) -> bool {
        let SectionScratch { heights, sides, .. } = scratch;
        sides.resize_with(N, Vec::new);
        heights.clear();
        sides[0].clear();
        let normal = frame.normal();
        let offset = normal.dot(frame.space_from_slice().translation);
        let mut seen = 0;
        let mut touching = 0;
        for vertex in &self.vertices {
            let height = normal.dot(*vertex) - offset;
            let side = if height > tolerance || (tolerance == 0.0 && height == 0.0) {
                ABOVE
            } else if height < -tolerance {
                BELOW
            } else {
                touching += 1;
                WITHIN
            };
            seen |= side;
            heights.push(height);
            sides[0].push(side);
        }
        crosses(seen) || touching >= N
    }

    /// On which sides the faces of rank 1 and higher have vertices.
    fn find_sides(&self, scratch: &mut SectionScratch) {
        for (index, faces) in self.ranks.iter().enumerate() {
            let (below, above) = scratch.sides.split_at_mut(index + 1);
            let (below, sides) = (&below[index], &mut above[0]);
            sides.clear();
            sides.extend(faces.iter().map(|parts| parts.iter().fold(0, |side, &part| side | below[part as usize])));
        }
    }

    /// Writes down the faces of the section, given the sides of all faces.
    fn write<const M: usize>(&self, frame: &SliceFrame<N>, scratch: &mut SectionScratch, out: &mut SectionPolytope<M>) {
        out.clear();
        let SectionScratch { heights, sides, numbers, .. } = scratch;
        numbers.resize_with(N, Vec::new);
        for (rank, numbers) in numbers.iter_mut().enumerate() {
            numbers.clear();
            numbers.resize(sides[rank].len(), u32::MAX);
        }
        let body_crosses = sides[0].iter().fold(0, |all, &side| all | side);
        let flush = !crosses(body_crosses);
        if flush && !sides[N - 1].contains(&WITHIN) {
            return;
        }
        // Rank 0 of the section: vertices within, and edges that cross.
        for (vertex, &side) in sides[0].iter().enumerate() {
            if side == WITHIN {
                numbers[0][vertex] = out.vertices.len() as u32;
                out.vertices.push(frame.to_slice(self.vertices[vertex]));
            }
        }
        for (edge, ends) in self.ranks[0].iter().enumerate() {
            if crosses(sides[1][edge]) {
                numbers[1][edge] = out.vertices.len() as u32;
                out.vertices.push(frame.to_slice(self.crossing_point(ends, heights)));
            }
        }
        for rank in 1..M {
            let faces = &mut out.ranks[rank - 1];
            for (face, parts) in self.ranks[rank - 1].iter().enumerate() {
                if sides[rank][face] == WITHIN {
                    numbers[rank][face] = faces.len() as u32;
                    parts.iter().for_each(|&part| faces.add(numbers[rank - 1][part as usize]));
                    faces.finish();
                }
            }
            for (face, parts) in self.ranks[rank].iter().enumerate() {
                if crosses(sides[rank + 1][face]) {
                    numbers[rank + 1][face] = faces.len() as u32;
                    for &part in parts {
                        let part = part as usize;
                        if crosses(sides[rank][part]) {
                            faces.add(numbers[rank][part]);
                        } else if sides[rank][part] & WITHIN != 0 {
                            // Two of the sides of the cut face meet in a face of the hyperplane.
                            let corners = self.ranks[rank - 1].get(part).iter().map(|&corner| corner as usize);
                            for corner in corners.filter(|&corner| sides[rank - 1][corner] == WITHIN) {
                                faces.add_once(numbers[rank - 1][corner]);
                            }
                        }
                    }
                    faces.finish();
                }
            }
        }
        self.write_sources(sides, numbers, out);
    }

    /// The point where an edge meets the hyperplane; the same whichever way round the edge stands.
    #[inline]
    pub(super) fn crossing_point(&self, ends: &[u32], heights: &[f64]) -> Vector<N> {
        let (a, b) = (ends[0].min(ends[1]) as usize, ends[0].max(ends[1]) as usize);
        self.vertices[a].lerp(self.vertices[b], heights[a] / (heights[a] - heights[b]))
    }

    /// Which facet of the body each facet of the section comes from.
    fn write_sources<const M: usize>(&self, sides: &[Vec<u8>], numbers: &[Vec<u32>], out: &mut SectionPolytope<M>) {
        let count = out.ranks.last().map_or(out.vertices.len(), super::polytope::Faces::len);
        out.facet_sources.resize(count, u32::MAX);
        let facets = &self.ranks[N - 2];
        for (facet, ridges) in facets.iter().enumerate() {
            let source = self.facet_sources[facet];
            if crosses(sides[N - 1][facet]) {
                out.facet_sources[numbers[N - 1][facet] as usize] = source;
            } else if sides[N - 1][facet] != WITHIN {
                for &ridge in ridges {
                    if sides[N - 2][ridge as usize] == WITHIN {
                        let known = &mut out.facet_sources[numbers[N - 2][ridge as usize] as usize];
                        *known = source.min(*known);
                    }
                }
            }
        }
    }

    /// Whether the faces close up: edges have two ends, polygons are cycles, and each ridge is in two facets.
    fn is_polytope(&self, uses: &mut Vec<u32>) -> bool {
        if self.is_empty() {
            return true;
        }
        if N == 1 {
            return self.vertices.len() == 2;
        }
        let edges = self.ranks[0].iter().all(|ends| ends.len() == 2 && ends[0] != ends[1]);
        let polygons = self.ranks.get(1).is_none_or(|faces| faces.iter().all(|sides| self.is_cycle(sides)));
        let higher =
            self.ranks.iter().enumerate().skip(2).all(|(index, faces)| faces.iter().all(|p| p.len() > index + 1));
        if !(edges && polygons && higher) {
            return false;
        }
        let ridges = if N == 2 { self.vertices.len() } else { self.ranks[N - 3].len() };
        uses.clear();
        uses.resize(ridges, 0);
        for facet in self.ranks[N - 2].iter() {
            facet.iter().for_each(|&ridge| uses[ridge as usize] += 1);
        }
        uses.iter().all(|&count| count == 2)
    }

    /// Whether each end of these edges is one of exactly two of them.
    fn is_cycle(&self, sides: &[u32]) -> bool {
        let ends = || sides.iter().flat_map(|&side| self.ranks[0].get(side as usize));
        sides.len() > 2 && ends().all(|end| ends().filter(|&other| other == end).count() == 2)
    }
}
