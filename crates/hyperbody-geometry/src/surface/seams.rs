//! Corners and edges that the polygons of a surface share: corners nearly at one place become one, and an edge is cut at every
//! corner on it, so that polygons that meet along a line have the same edges there.

use std::collections::BTreeMap;

use hyperbody_math::Vector;

/// Corners, to be found by where they are.
pub(super) struct Places {
    points: Vec<Vector<3>>,
    /// Points this close to each other are one.
    tolerance: f64,
    /// Corners by the cube of this width that they are in.
    cubes: BTreeMap<[i64; 3], Vec<u32>>,
    width: f64,
}

impl Places {
    /// None yet; `count` of them are expected in a space of so many metres.
    pub(super) fn new(size: f64, count: usize, tolerance: f64) -> Self {
        // About one corner a cube.
        let width = (size / (count.max(1) as f64).cbrt()).max(8.0 * tolerance).max(f64::MIN_POSITIVE);
        Self { points: Vec::new(), tolerance, cubes: BTreeMap::new(), width }
    }

    pub(super) const fn tolerance(&self) -> f64 {
        self.tolerance
    }

    pub(super) fn at(&self, corner: u32) -> Vector<3> {
        self.points[corner as usize]
    }

    pub(super) const fn count(&self) -> usize {
        self.points.len()
    }

    /// The number of the corner at a point, a new one if there is none.
    pub(super) fn number(&mut self, point: Vector<3>) -> u32 {
        let mut found: Option<(f64, u32)> = None;
        self.for_each_near(point, point, |corner, place| {
            let distance = place.distance(point);
            if distance <= self.tolerance && found.is_none_or(|best| (distance, corner) < best) {
                found = Some((distance, corner));
            }
        });
        if let Some((_, corner)) = found {
            return corner;
        }
        let corner = self.points.len() as u32;
        self.points.push(point);
        self.cubes.entry(self.cube(point)).or_default().push(corner);
        corner
    }

    fn cube(&self, point: Vector<3>) -> [i64; 3] {
        point.0.map(|c| (c / self.width).floor() as i64)
    }

    /// All corners in the cubes of a box, and a tolerance around it.
    fn for_each_near(&self, from: Vector<3>, to: Vector<3>, mut f: impl FnMut(u32, Vector<3>)) {
        let margin = Vector::splat(self.tolerance);
        let (low, high) = (self.cube(from.min(to) - margin), self.cube(from.max(to) + margin));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for (_, corners) in self.cubes.range([x, y, low[2]]..=[x, y, high[2]]) {
                    corners.iter().for_each(|&corner| f(corner, self.at(corner)));
                }
            }
        }
    }

    /// The corners on an edge and not at its ends.
    fn on_edge(&self, [a, b]: [u32; 2], on: &mut Vec<u32>) {
        let (from, to) = (self.at(a), self.at(b));
        let along = to - from;
        let steps = (along.norm() / self.width).ceil().max(1.0);
        for step in 0..steps as usize {
            let [start, end] = [step as f64, step as f64 + 1.0].map(|k| from + along * (k / steps));
            self.for_each_near(start, end, |corner, place| {
                let share = (place - from).dot(along) / along.norm_sq();
                let off = (place - from - along * share).norm();
                if corner != a && corner != b && share > 0.0 && share < 1.0 && off <= self.tolerance {
                    on.push(corner);
                }
            });
        }
    }
}

/// Edges, each with the corners on it.
pub(super) struct Edges {
    /// Ascending, the smaller corner first.
    ends: Vec<[u32; 2]>,
    /// In order from the first end to the second.
    on: Vec<Vec<u32>>,
}

impl Edges {
    /// The edges of all polygons.
    pub(super) fn new<'a>(polygons: impl Iterator<Item = &'a [u32]>) -> Self {
        let mut ends: Vec<[u32; 2]> = polygons.flat_map(sides).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        ends.sort_unstable();
        ends.dedup();
        Self { on: vec![Vec::new(); ends.len()], ends }
    }

    fn index(&self, [a, b]: [u32; 2]) -> Option<usize> {
        self.ends.binary_search(&[a.min(b), a.max(b)]).ok()
    }

    /// Puts a corner where edges of polygons in one plane cross each other. `flat` gives coordinates in that plane.
    pub(super) fn cross<'a>(
        &mut self,
        polygons: impl Iterator<Item = &'a [u32]>,
        places: &mut Places,
        flat: impl Fn(Vector<3>) -> Vector<2>,
    ) {
        let mut within: Vec<usize> = polygons.flat_map(sides).filter_map(|side| self.index(side)).collect();
        within.sort_unstable();
        within.dedup();
        let mut ranges: Vec<(Vector<2>, Vector<2>, usize)> = within
            .iter()
            .map(|&edge| {
                let [a, b] = self.ends[edge].map(|corner| flat(places.at(corner)));
                (a.min(b), a.max(b), edge)
            })
            .collect();
        ranges.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.2.cmp(&b.2)));
        for (k, &(low, high, edge)) in ranges.iter().enumerate() {
            for &(other_low, other_high, other) in ranges[k + 1..].iter().take_while(|other| other.0[0] <= high[0]) {
                if other_low[1] > high[1] || other_high[1] < low[1] {
                    continue;
                }
                let ends = [self.ends[edge], self.ends[other]];
                if let Some(share) = crossing(ends.map(|e| e.map(|c| flat(places.at(c)))), places.tolerance) {
                    let [a, b] = ends[0];
                    let corner = places.number(places.at(a).lerp(places.at(b), share));
                    self.on[edge].push(corner);
                    self.on[other].push(corner);
                }
            }
        }
    }

    /// Cuts every edge at all corners on it.
    pub(super) fn cut(&mut self, places: &Places) {
        for (ends, on) in self.ends.iter().zip(&mut self.on) {
            places.on_edge(*ends, on);
            on.retain(|corner| !ends.contains(corner));
            on.sort_unstable();
            on.dedup();
            let [a, b] = ends.map(|end| places.at(end));
            on.sort_by(|&c, &d| (places.at(c) - a).dot(b - a).total_cmp(&(places.at(d) - a).dot(b - a)));
        }
    }

    /// Calls `f` with the parts of a polygon's sides, in order.
    pub(super) fn for_each_part(&self, corners: &[u32], mut f: impl FnMut([u32; 2])) {
        for [a, b] in sides(corners) {
            let on: &[u32] = self.index([a, b]).map_or(&[], |edge| &self.on[edge]);
            let mut last = a;
            let mut go = |corner: u32| {
                f([last, corner]);
                last = corner;
            };
            if a < b {
                on.iter().for_each(|&c| go(c));
            } else {
                on.iter().rev().for_each(|&c| go(c));
            }
            go(b);
        }
    }
}

/// The sides of a polygon, in order.
pub(super) fn sides(corners: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]])
}

/// Where along the first of two segments they cross, clearly inside of both.
fn crossing([[a, b], [c, d]]: [[Vector<2>; 2]; 2], tolerance: f64) -> Option<f64> {
    let (first, second) = (b - a, d - c);
    let area = wedge(first, second);
    let (share, other) = (wedge(c - a, second) / area, wedge(c - a, first) / area);
    let inside = |share: f64, length: f64| share * length > tolerance && (1.0 - share) * length > tolerance;
    (inside(share, first.norm()) && inside(other, second.norm())).then_some(share)
}

/// The area of the parallelogram of two vectors, positive if the second is to the left of the first.
pub(super) fn wedge(a: Vector<2>, b: Vector<2>) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
