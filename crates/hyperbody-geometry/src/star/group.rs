//! The symmetry group of a star polytope, as its mirrors.

use std::collections::BTreeMap;

use hyperbody_math::{Matrix, Vector};

use super::{Fraction, mirrors};
use crate::Polytope;
use crate::section::SliceFrame;

/// Images of a point that are closer than this are one.
pub(super) const SAME_POINT: f64 = 1e-7;

/// Most images of a point under the mirrors that are written down; corners of the chamber of four dimensions have 1200 at most.
const MAX_IMAGES: usize = 14_400;

/// The mirrors of the symmetry group, and how many elements those that any of them make have.
pub(super) struct Group<const N: usize> {
    pub(super) mirrors: [Vector<N>; N],
    /// By the set of mirrors, as bits.
    pub(super) orders: Vec<usize>,
    /// Along the edges of the chamber: each is on all mirrors but the one of its number.
    pub(super) edges: [Vector<N>; N],
}

impl<const N: usize> Group<N> {
    pub(super) fn new<const M: usize>(symbol: &[Fraction]) -> Option<Self> {
        let mirrors = Self::walls::<M>(symbol)?;
        let inverse = Matrix::from_fn(|i, j| mirrors[i][j]).try_inverse()?;
        let edges = std::array::from_fn(|i| inverse.column(i).normalize_or_zero());
        let mut group = Self { mirrors, orders: vec![1], edges };
        for set in 1_usize..1 << N {
            // Those that leave an edge of the chamber in place are made by the other mirrors.
            let first = set.trailing_zeros() as usize;
            let order = group.orbit(group.edges[first], set)?.len() * group.orders[set & (set - 1)];
            group.orders.push(order);
        }
        Some(group)
    }

    /// The mirrors around a chamber, their normals inward. Those of the symbol of a star stand at angles such as 2π/5, with
    /// others between them: of the normals of all mirrors that point to one side the outermost ones are wanted.
    fn walls<const M: usize>(symbol: &[Fraction]) -> Option<[Vector<N>; N]> {
        let vectors = mirrors(symbol)?.iter().map(|row| Vector::from_slice(row)).collect::<Option<Vec<Vector<N>>>>()?;
        let symbol_mirrors: [Vector<N>; N] = vectors.try_into().ok()?;
        let plain = Self { mirrors: symbol_mirrors, orders: Vec::new(), edges: symbol_mirrors };
        let mut normals: Vec<Vector<N>> = Vec::new();
        for mirror in symbol_mirrors {
            for image in plain.orbit(mirror, (1 << N) - 1)? {
                if normals.iter().all(|known| known.distance(image) > SAME_POINT) {
                    normals.push(image);
                }
            }
        }
        let side = askew();
        normals.retain(|normal| normal.dot(side) > 0.0);
        let frame = SliceFrame::from_normal(side, 1.0).ok()?;
        let seen: Vec<Vector<M>> = normals.iter().map(|&n| frame.to_slice(n / n.dot(side))).collect();
        let outermost = Polytope::from_points(&seen).ok()?;
        let walls: Vec<Vector<N>> =
            outermost.vertices().iter().map(|&v| frame.to_space(v).normalize_or_zero()).collect();
        walls.try_into().ok()
    }

    pub(super) fn order(&self) -> usize {
        self.orders[(1 << N) - 1]
    }

    pub(super) fn reflect(&self, mirror: usize, point: Vector<N>) -> Vector<N> {
        point - self.mirrors[mirror] * (2.0 * self.mirrors[mirror].dot(point))
    }

    /// All images of a point under a set of mirrors; `None` if they are too many.
    pub(super) fn orbit(&self, point: Vector<N>, set: usize) -> Option<Vec<Vector<N>>> {
        let mut points = vec![point];
        let mut known = Known::new(point);
        let mut next = 0;
        while next < points.len() {
            for mirror in (0..N).filter(|mirror| set >> mirror & 1 == 1) {
                let image = self.reflect(mirror, points[next]);
                if known.is_new(image) {
                    points.push(image);
                }
            }
            next += 1;
            if points.len() > MAX_IMAGES {
                return None;
            }
        }
        Some(points)
    }
}

/// A direction in no mirror of any group: its coordinates have nothing to do with each other.
fn askew<const N: usize>() -> Vector<N> {
    Vector::from_fn(|i| 1.0 / (i as f64 + std::f64::consts::E)).normalize_or_zero()
}

/// Points that were met, by their place along one direction: among 50,400 a new one is told in no time.
pub(super) struct Known<const N: usize> {
    along: Vector<N>,
    points: BTreeMap<i64, Vec<Vector<N>>>,
}

impl<const N: usize> Known<N> {
    /// Longer than [`SAME_POINT`], so that the same points are in the same interval or in neighbours.
    const INTERVAL: f64 = 1e-6;

    pub(super) fn new(first: Vector<N>) -> Self {
        let mut known = Self { along: askew(), points: BTreeMap::new() };
        known.is_new(first);
        known
    }

    /// Notes a point; whether it was met for the first time.
    pub(super) fn is_new(&mut self, point: Vector<N>) -> bool {
        #[expect(clippy::cast_possible_truncation, reason = "points lie within a few units of the centre")]
        let interval = (self.along.dot(point) / Self::INTERVAL).floor() as i64;
        let mut nearby = self.points.range(interval - 1..=interval + 1).flat_map(|(_, points)| points);
        if nearby.any(|other| other.distance(point) <= SAME_POINT) {
            return false;
        }
        self.points.entry(interval).or_default().push(point);
        true
    }
}
