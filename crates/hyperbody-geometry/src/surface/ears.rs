//! A region of the plane as convex polygons: holes are tied to the outline, ears are cut off (G. H. Meisters, 1975), and triangles are joined
//! while that leaves them convex (S. Hertel, K. Mehlhorn, 1983).
//!
//! Whatever rounding does, the sides of all polygons add up to the outline and the rims: each triangle takes its two sides and leaves the
//! third to the rest. A region that is next to nothing gets triangles that are next to nothing.

use std::collections::{BTreeMap, BinaryHeap};

use hyperbody_math::Vector;

use super::loops::Region;
use super::seams::{sides, wedge};

/// A corner of a line, ordered by how near it is.
struct Nearby {
    distance: f64,
    position: usize,
}

impl PartialEq for Nearby {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Nearby {}

impl PartialOrd for Nearby {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Nearby {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        other.distance.total_cmp(&self.distance).then(other.position.cmp(&self.position))
    }
}

/// The outline with the rims of all holes tied to it, so that it goes around all of the region at once.
pub(super) fn tied(region: &Region, place: &impl Fn(u32) -> Vector<2>) -> Vec<u32> {
    let mut line = region.outline.clone();
    // From right to left: whatever is to the right of a hole belongs to the line already, so that it is seen from there.
    let rightmost = |hole: &[u32]| {
        let x = |k: &usize| place(hole[*k])[0];
        (0..hole.len()).max_by(|a, b| x(a).total_cmp(&x(b))).unwrap_or(0)
    };
    let mut holes: Vec<(f64, usize, &[u32])> = Vec::with_capacity(region.holes.len());
    for hole in &region.holes {
        let first = rightmost(hole);
        holes.push((place(hole[first])[0], first, hole));
    }
    holes.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (k, &(_, first, hole)) in holes.iter().enumerate() {
        let touched = hole.iter().position(|corner| line.contains(corner));
        let start = touched.unwrap_or(first);
        let rim = || hole[start..].iter().chain(&hole[..start]).copied();
        let waiting: Vec<&[u32]> = holes[k..].iter().map(|&(_, _, hole)| hole).collect();
        let at = seen_from(hole[start], &line, &waiting, place);
        let mut ties: Vec<u32> = rim().collect();
        if line[at] == hole[start] {
            ties.rotate_left(1);
        } else {
            ties.extend([hole[start], line[at]]);
        }
        line.splice(at + 1..at + 1, ties);
    }
    line
}

/// The position of the nearest corner of a line that is seen from a corner of a hole.
fn seen_from(from: u32, line: &[u32], waiting: &[&[u32]], place: &impl Fn(u32) -> Vector<2>) -> usize {
    let eye = place(from);
    let nearby = |position: usize| Nearby { distance: place(line[position]).distance(eye), position };
    let mut heap: BinaryHeap<Nearby> = (0..line.len()).map(nearby).collect();
    let mut nearest = None;
    while let Some(Nearby { position, .. }) = heap.pop() {
        nearest = nearest.or(Some(position));
        let to = line[position];
        let [before, after] = [line.len() - 1, 1].map(|step| place(line[(position + step) % line.len()]));
        let blocks = |[a, b]: [u32; 2]| {
            let apart = ![a, b].contains(&from) && ![a, b].contains(&to);
            apart && meet([eye, place(to)], [place(a), place(b)])
        };
        let in_corner = to == from || in_corner(before, place(to), after, eye);
        if in_corner && !sides(line).any(blocks) && !waiting.iter().any(|hole| sides(hole).any(blocks)) {
            return position;
        }
    }
    nearest.unwrap_or(0)
}

/// Whether a point lies to the left of the line that comes to a corner and goes on.
fn in_corner(before: Vector<2>, corner: Vector<2>, after: Vector<2>, point: Vector<2>) -> bool {
    let first = wedge(corner - before, point - corner) > 0.0;
    let second = wedge(after - corner, point - corner) > 0.0;
    if wedge(corner - before, after - corner) >= 0.0 { first && second } else { first || second }
}

/// Whether two segments have a point in common.
fn meet([a, b]: [Vector<2>; 2], [c, d]: [Vector<2>; 2]) -> bool {
    let beside = |from: Vector<2>, to: Vector<2>, p: Vector<2>, q: Vector<2>| {
        let (first, second) = (wedge(to - from, p - from), wedge(to - from, q - from));
        first > 0.0 && second > 0.0 || first < 0.0 && second < 0.0
    };
    let apart =
        (0..2).any(|axis| a[axis].max(b[axis]) < c[axis].min(d[axis]) || c[axis].max(d[axis]) < a[axis].min(b[axis]));
    !apart && !beside(a, b, c, d) && !beside(c, d, a, b)
}

/// How carefully an ear is chosen.
#[derive(Clone, Copy, PartialEq)]
enum Care {
    /// It is a triangle, and holds no other corner, not at its rim either.
    Full,
    /// It turns left, and no other corner is inside of it.
    Some,
    /// Any corner: only rounding leads here.
    None,
}

/// A line of corners, with what is left of it.
struct Rest<'a> {
    corners: &'a [u32],
    points: Vec<Vector<2>>,
    next: Vec<usize>,
    last: Vec<usize>,
    tolerance: f64,
}

impl Rest<'_> {
    /// The corners before, at and after a position.
    fn ear(&self, at: usize) -> [usize; 3] {
        [self.last[at], at, self.next[at]]
    }

    fn is_ear(&self, at: usize, care: Care) -> bool {
        let ear = self.ear(at);
        let [a, b, c] = ear.map(|k| self.corners[k]);
        // A tie there and back is nothing.
        if care == Care::None || a == c || a == b || b == c {
            return true;
        }
        let points = ear.map(|k| self.points[k]);
        let margin = if care == Care::Full { self.tolerance } else { -self.tolerance };
        if height(points) <= margin.max(0.0) {
            return false;
        }
        let mut other = self.next[ear[2]];
        while other != ear[0] {
            if ![a, b, c].contains(&self.corners[other]) && holds(points, self.points[other], margin) {
                return false;
            }
            other = self.next[other];
        }
        true
    }
}

/// Twice the area of a triangle over its longest side; negative if it goes clockwise.
fn height([a, b, c]: [Vector<2>; 3]) -> f64 {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    wedge(b - a, c - a) / longest.max(f64::MIN_POSITIVE)
}

/// Whether a point is in a triangle, or at most `margin` beside it.
fn holds([a, b, c]: [Vector<2>; 3], point: Vector<2>, margin: f64) -> bool {
    [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| wedge(q - p, point - p) >= -margin * p.distance(q))
}

/// A line as triangles.
pub(super) fn triangles(line: &[u32], place: &impl Fn(u32) -> Vector<2>, tolerance: f64) -> Vec<[u32; 3]> {
    let count = line.len();
    let mut rest = Rest {
        corners: line,
        points: line.iter().map(|&c| place(c)).collect(),
        next: (0..count).map(|k| (k + 1) % count).collect(),
        last: (0..count).map(|k| (k + count - 1) % count).collect(),
        tolerance,
    };
    let mut found = Vec::with_capacity(count.saturating_sub(2));
    let (mut at, mut tried, mut care, mut left) = (0, 0, Care::Full, count);
    while left > 2 {
        if left == 3 || rest.is_ear(at, care) {
            let [before, _, after] = rest.ear(at);
            let ear = rest.ear(at).map(|k| line[k]);
            if ear[0] != ear[1] && ear[1] != ear[2] && ear[2] != ear[0] {
                found.push(ear);
            }
            (rest.next[before], rest.last[after]) = (after, before);
            // From the corner after next, so that ears are not all of one corner.
            (at, tried, care, left) = (rest.next[after], 0, Care::Full, left - 1);
            continue;
        }
        at = rest.next[at];
        tried += 1;
        if tried >= left {
            tried = 0;
            care = if care == Care::Full { Care::Some } else { Care::None };
        }
    }
    found
}

/// Triangles joined to convex polygons, each beginning at a corner from which the triangles to its sides have areas.
pub(super) fn joined(triangles: &[[u32; 3]], place: &impl Fn(u32) -> Vector<2>, tolerance: f64) -> Vec<Vec<u32>> {
    let mut polygons: Vec<Vec<u32>> = triangles.iter().map(|t| t.to_vec()).collect();
    let mut owner: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for (number, polygon) in polygons.iter().enumerate() {
        owner.extend(sides(polygon).map(|side| (side, number)));
    }
    let shared: Vec<[u32; 2]> = owner.keys().filter(|[a, b]| a < b && owner.contains_key(&[*b, *a])).copied().collect();
    for [a, b] in shared {
        let (first, second) = (owner[&[a, b]], owner[&[b, a]]);
        if first == second {
            continue;
        }
        let Some(union) = union(&polygons[first], &polygons[second], [a, b], place, tolerance) else { continue };
        for side in sides(&polygons[second]) {
            if let Some(number) = owner.get_mut(&side).filter(|number| **number == second) {
                *number = first;
            }
        }
        polygons[first] = union;
        polygons[second].clear();
    }
    polygons.retain(|polygon| !polygon.is_empty());
    polygons
}

/// Two polygons as one, without the side a–b of the first; `None` unless that is convex.
fn union(
    first: &[u32],
    second: &[u32],
    [a, b]: [u32; 2],
    place: &impl Fn(u32) -> Vector<2>,
    tolerance: f64,
) -> Option<Vec<u32>> {
    let from = |polygon: &[u32], corner: u32, other: u32| -> Option<Vec<u32>> {
        let start = sides(polygon).position(|side| side == [other, corner])?;
        let mut turned = polygon.to_vec();
        turned.rotate_left((start + 1) % polygon.len());
        Some(turned)
    };
    // b … a, and then from a to b along the other one.
    let mut corners = from(first, b, a)?;
    let rest = from(second, a, b)?;
    corners.extend(&rest[1..rest.len() - 1]);
    let mut own = corners.clone();
    own.sort_unstable();
    if own.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    let count = corners.len();
    let at = |k: usize| place(corners[k % count]);
    let convex = (0..count).all(|k| height([at(k), at(k + 1), at(k + 2)]) >= -tolerance);
    let fans = |start: usize| (1..count - 1).all(|k| height([at(start), at(start + k), at(start + k + 1)]) > tolerance);
    let start = (0..count).find(|&start| fans(start)).filter(|_| convex)?;
    corners.rotate_left(start);
    Some(corners)
}
