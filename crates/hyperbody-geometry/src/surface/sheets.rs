//! Where a body touches itself or another one along an edge or in a corner, the surface is told apart into sheets that pass each other by: each has
//! corners of its own there, so that every edge bounds two polygons.

use std::collections::BTreeMap;

use hyperbody_math::Vector;

use super::loops::pairs_around;
use super::seams::sides;

/// A polygon on its way out.
pub(super) struct Facet {
    pub(super) corners: Vec<u32>,
    pub(super) source: u32,
    /// Outward.
    pub(super) normal: Vector<3>,
}

/// A side of a polygon: the polygon and the position of its first corner.
type Side = (usize, usize);

/// Sides that go along one edge, both ways.
fn by_edge(facets: &[Facet]) -> BTreeMap<[u32; 2], Vec<(Side, bool)>> {
    let mut edges: BTreeMap<[u32; 2], Vec<(Side, bool)>> = BTreeMap::new();
    for (number, facet) in facets.iter().enumerate() {
        for (k, [a, b]) in sides(&facet.corners).enumerate() {
            edges.entry([a.min(b), a.max(b)]).or_default().push(((number, k), a < b));
        }
    }
    edges
}

/// Sides that meet each other: those of the same edge with only body between them.
fn meeting(facets: &[Facet], places: &[Vector<3>]) -> Vec<(Side, Side)> {
    let mut meeting = Vec::new();
    for ([a, b], along) in by_edge(facets) {
        if let [(first, true), (second, false)] | [(second, false), (first, true)] = along[..] {
            meeting.push((first, second));
            continue;
        }
        let edge = places[b as usize] - places[a as usize];
        let Some(edge) = edge.try_normalize() else { continue };
        let right = edge.orthonormal_complement()[0];
        let up = super::cross(edge, right);
        let angle = |&((facet, _), forward): &(Side, bool)| {
            let into = super::cross(facets[facet].normal, if forward { edge } else { -edge });
            hyperbody_math::scalar::atan2(into.dot(up), into.dot(right))
        };
        // Turning against the angle from a polygon that goes along the edge leads into the body.
        let around = along.iter().enumerate().map(|(number, side)| (angle(side), side.1, number)).collect();
        meeting.extend(pairs_around(around).into_iter().map(|(f, s)| (along[f].0, along[s].0)));
    }
    meeting
}

/// Gives corners at which polygons do not hang together by edges numbers of their own, and the places of all numbers.
pub(super) fn told_apart(facets: &mut [Facet], places: &[Vector<3>]) -> Vec<Vector<3>> {
    let meeting = meeting(facets, places);
    let starts: Vec<usize> = facets
        .iter()
        .scan(0, |sum, facet| {
            *sum += facet.corners.len();
            Some(*sum - facet.corners.len())
        })
        .collect();
    let total = facets.iter().map(|facet| facet.corners.len()).sum();
    let mut sheets = Sheets { above: (0..total).collect() };
    let corner = |(facet, k): Side, step: usize| starts[facet] + (k + step) % facets[facet].corners.len();
    for &(first, second) in &meeting {
        sheets.join(corner(first, 0), corner(second, 1));
        sheets.join(corner(first, 1), corner(second, 0));
    }
    let mut numbers: BTreeMap<usize, u32> = BTreeMap::new();
    let mut new_places = Vec::new();
    for (facet, start) in facets.iter_mut().zip(&starts) {
        for (k, corner) in facet.corners.iter_mut().enumerate() {
            let place = places[*corner as usize];
            *corner = *numbers.entry(sheets.top(start + k)).or_insert_with(|| {
                new_places.push(place);
                new_places.len() as u32 - 1
            });
        }
    }
    split_doubled(facets, &meeting, &mut new_places);
    new_places
}

/// Sheets that part along an edge and meet again at both of its ends get corners of their own in its middle.
fn split_doubled(facets: &mut [Facet], meeting: &[(Side, Side)], places: &mut Vec<Vector<3>>) {
    let doubled: Vec<[u32; 2]> =
        by_edge(facets).into_iter().filter(|(_, along)| along.len() > 2).map(|(edge, _)| edge).collect();
    if doubled.is_empty() {
        return;
    }
    let mut middles: BTreeMap<Side, u32> = BTreeMap::new();
    for &(first, second) in meeting {
        let [a, b] = [0, 1].map(|step| {
            let corners = &facets[first.0].corners;
            corners[(first.1 + step) % corners.len()]
        });
        if doubled.binary_search(&[a.min(b), a.max(b)]).is_ok() {
            let middle = places[a as usize].lerp(places[b as usize], 0.5);
            middles.extend([(first, places.len() as u32), (second, places.len() as u32)]);
            places.push(middle);
        }
    }
    for (number, facet) in facets.iter_mut().enumerate() {
        let mut corners = Vec::with_capacity(facet.corners.len() + 1);
        for (k, &corner) in facet.corners.iter().enumerate() {
            corners.push(corner);
            corners.extend(middles.get(&(number, k)));
        }
        // Triangles fan out from the first corner, which must not have the new one on its own side.
        if let Some(&middle) = corners.iter().find(|corner| !facet.corners.contains(corner)) {
            let start = corners.iter().position(|&corner| corner == middle).unwrap_or(0);
            corners.rotate_left(start);
        }
        facet.corners = corners;
    }
}

/// Corners of polygons that belong together (R. E. Tarjan, 1975).
struct Sheets {
    above: Vec<usize>,
}

impl Sheets {
    fn top(&mut self, mut corner: usize) -> usize {
        while self.above[corner] != corner {
            self.above[corner] = self.above[self.above[corner]];
            corner = self.above[corner];
        }
        corner
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.top(a), self.top(b));
        self.above[a.max(b)] = a.min(b);
    }
}
