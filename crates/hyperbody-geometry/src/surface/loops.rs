//! Closed lines in a plane, and the regions that they bound.
//!
//! A set of directed edges of which as many enter every corner as leave it falls apart into closed lines without a corner twice. Regions lie to
//! the left of those around them (they face up) or to the right (down); which lines are outlines and which are rims of holes is told by
//! how often the other lines wind around them.

use std::collections::BTreeMap;

use hyperbody_math::Vector;

use super::seams::wedge;

/// Pairs each that opens with one that closes, so that no pairs cross: of things around a point with angles and numbers, going down by
/// angle from each that opens to the next that closes. As many open as close.
pub(super) fn pairs_around(mut around: Vec<(f64, bool, usize)>) -> Vec<(usize, usize)> {
    around.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
    let mut pairs = Vec::with_capacity(around.len() / 2);
    let (mut open, mut early) = (Vec::new(), Vec::new());
    for &(_, opens, number) in &around {
        if opens {
            open.push(number);
        } else if let Some(partner) = open.pop() {
            pairs.push((partner, number));
        } else {
            early.push(number);
        }
    }
    // Once more around for those that close before anything has opened.
    pairs.extend(early.into_iter().filter_map(|number| Some((open.pop()?, number))));
    pairs
}

/// Directed edges as closed lines that cross neither themselves nor each other.
pub(super) fn closed_lines(edges: &[[u32; 2]], place: &impl Fn(u32) -> Vector<2>) -> Vec<Vec<u32>> {
    let mut around: BTreeMap<u32, Vec<(f64, bool, usize)>> = BTreeMap::new();
    for (number, &[from, to]) in edges.iter().enumerate() {
        let way = place(to) - place(from);
        let angle = |v: Vector<2>| hyperbody_math::scalar::atan2(v[1], v[0]);
        around.entry(from).or_default().push((angle(way), false, number));
        around.entry(to).or_default().push((angle(-way), true, number));
    }
    let mut next = vec![usize::MAX; edges.len()];
    for at_corner in around.into_values() {
        for (entering, leaving) in pairs_around(at_corner) {
            next[entering] = leaving;
        }
    }
    let mut lines = Vec::new();
    let mut seen = vec![false; edges.len()];
    for first in 0..edges.len() {
        let (mut line, mut edge) = (Vec::new(), first);
        while edge != usize::MAX && !seen[edge] {
            seen[edge] = true;
            line.push(edges[edge][0]);
            edge = next[edge];
        }
        add_simple(&line, &mut lines);
    }
    lines
}

/// Takes a closed line apart at the corners where it comes by twice.
fn add_simple(line: &[u32], lines: &mut Vec<Vec<u32>>) {
    let mut way: Vec<u32> = Vec::new();
    let mut position: BTreeMap<u32, usize> = BTreeMap::new();
    for &corner in line {
        if let Some(&start) = position.get(&corner) {
            let loop_ = way.split_off(start);
            position.retain(|_, place| *place < start);
            lines.push(loop_);
        }
        position.insert(corner, way.len());
        way.push(corner);
    }
    if !way.is_empty() {
        lines.push(way);
    }
}

/// What one outline and the rims within it bound.
pub(super) struct Region {
    /// Counterclockwise.
    pub(super) outline: Vec<u32>,
    /// Clockwise.
    pub(super) holes: Vec<Vec<u32>>,
    /// Whether the lines went the way they go here; otherwise against it.
    pub(super) faces_up: bool,
}

/// A closed line, with what tells where it is.
struct Line {
    corners: Vec<u32>,
    points: Vec<Vector<2>>,
    low: Vector<2>,
    high: Vector<2>,
    area: f64,
    /// A point inside of it, by its longest side.
    inside: Vector<2>,
}

/// How far inside, in parts of that side.
const INSIDE: f64 = 1e-6;

impl Line {
    fn new(corners: Vec<u32>, place: &impl Fn(u32) -> Vector<2>) -> Self {
        let points: Vec<Vector<2>> = corners.iter().map(|&c| place(c)).collect();
        let side = |k: usize| (points[k], points[(k + 1) % points.len()]);
        let area = (0..points.len()).map(|k| wedge(side(k).0 - points[0], side(k).1 - points[0])).sum::<f64>() * 0.5;
        let (mut inside, mut longest) = (points[0], 0.0);
        for (from, to) in (0..points.len()).map(side) {
            if from.distance(to) > longest {
                longest = from.distance(to);
                let left = Vector([from[1] - to[1], to[0] - from[0]]);
                inside = from.lerp(to, 0.5) + left * (INSIDE * area.signum());
            }
        }
        let low = points.iter().fold(points[0], |low, &p| low.min(p));
        let high = points.iter().fold(points[0], |high, &p| high.max(p));
        Self { corners, points, low, high, area, inside }
    }

    /// How often the line goes around a point, counterclockwise.
    fn winding(&self, point: Vector<2>) -> i32 {
        if (0..2).any(|axis| point[axis] < self.low[axis] || point[axis] > self.high[axis]) {
            return 0;
        }
        let mut winding = 0;
        for (k, &from) in self.points.iter().enumerate() {
            let to = self.points[(k + 1) % self.points.len()];
            let left = wedge(to - from, point - from) > 0.0;
            if from[1] <= point[1] && to[1] > point[1] && left {
                winding += 1;
            } else if from[1] > point[1] && to[1] <= point[1] && !left {
                winding -= 1;
            }
        }
        winding
    }
}

/// The regions that closed lines bound: such that the outlines and rims are the lines, each once.
pub(super) fn regions(lines: Vec<Vec<u32>>, place: &impl Fn(u32) -> Vector<2>) -> Vec<Region> {
    let lines: Vec<Line> = lines.into_iter().map(|corners| Line::new(corners, place)).collect();
    let around = |k: usize| {
        let others = lines.iter().enumerate().filter(|&(other, _)| other != k);
        others.map(|(_, line)| line.winding(lines[k].inside)).sum::<i32>()
    };
    // Beyond a rim there is what the line itself takes away.
    let is_rim = |k: usize| if lines[k].area < 0.0 { around(k) > 0 } else { around(k) < 0 };
    let rims: Vec<bool> = (0..lines.len()).map(is_rim).collect();
    let outline_of = |rim: usize| {
        let holds =
            |&k: &usize| !rims[k] && lines[k].area * lines[rim].area < 0.0 && lines[k].winding(lines[rim].inside) != 0;
        let least = |a: &usize, b: &usize| lines[*a].area.abs().total_cmp(&lines[*b].area.abs());
        (0..lines.len()).filter(holds).min_by(least)
    };
    let parents: Vec<Option<usize>> = (0..lines.len()).map(|k| if rims[k] { outline_of(k) } else { None }).collect();
    let turned = |k: usize, turn: bool| {
        let mut corners = lines[k].corners.clone();
        if turn {
            corners.reverse();
        }
        corners
    };
    let region = |k: usize| {
        let faces_up = lines[k].area >= 0.0;
        let own = (0..lines.len()).filter(|&hole| parents[hole] == Some(k));
        Region { outline: turned(k, !faces_up), holes: own.map(|hole| turned(hole, !faces_up)).collect(), faces_up }
    };
    (0..lines.len()).filter(|&k| parents[k].is_none()).map(region).collect()
}
