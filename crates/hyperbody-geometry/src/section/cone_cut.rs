//! Sections of what normal cones cut out of the unit ball.
//!
//! Let C be a polyhedral cone of dimension m, ê a unit vector of its span, and g(s) the volume of all y in C with |y| ≤ 1 and ê·y = s. For a
//! facet G of C with the inward normal ν, let g_G be the same of G, with the part of ê in the span of G, of length λ. The divergence theorem for
//! the fields y φ(ê·y) and ê φ(ê·y), with any function φ, has the integral over the sphere in common; without it, with ε = ê·ν,
//!
//! (1 − s²) g′ + (m − 1) s g = Σ_G ε g_G(s/λ)/λ,   so   (g (1 − s²)^(−(m−1)/2))′ = (1 − s²)^(−(m+1)/2) Σ_G ε g_G(s/λ)/λ:
//!
//! one integral for each face of the cone, of functions that are smooth between the heights where faces touch the sphere. What the facets
//! give is kept by panels, so that integrals do not nest. A facet across ê lies at s = 0 with all of its volume, and makes a step there.
//! At least one end of g is zero, since C holds no line; from there the integral goes.
//!
//! Own derivation; cones of two dimensions are chords of a sector.

use std::rc::Rc;

use hyperbody_math::{Vector, scalar};

use super::panels::{self, NODES};
use crate::mass::{Normals, orthogonal_part};

/// A face that has less than this of a unit direction is orthogonal to it: what it cuts off would be thinner than that.
const BLIND: f64 = 1e-9;

/// The function g of one cone.
#[derive(Debug)]
pub(super) struct ConeCut {
    dimension: usize,
    /// Where g is not zero.
    range: [f64; 2],
    /// Where g is not smooth, or would not be if it went on.
    breaks: Vec<f64>,
    /// Ends of the panels, over all of the range.
    pub(super) panels: Vec<f64>,
    form: Form,
}

#[derive(Debug)]
enum Form {
    /// One for a ray.
    Ray,
    /// Of two sides: what of the outward normals lies along ê and across it, in the plane of the cone.
    Sector([[f64; 2]; 2]),
    /// g (1 − s²)^(−(m−1)/2) at the nodes of each panel.
    Table(Vec<[f64; NODES]>),
}

impl ConeCut {
    /// g(s).
    pub(super) fn at(&self, s: f64) -> f64 {
        // Half open, as splines are: what ends at a height goes on in another piece.
        if s < self.range[0] || s >= self.range[1] {
            return 0.0;
        }
        let left = ((1.0 - s) * (1.0 + s)).max(0.0);
        match &self.form {
            Form::Ray => 1.0,
            Form::Sector(sides) => {
                let half = left.sqrt();
                let (mut from, mut to) = (-half, half);
                for [along, across] in sides {
                    // Points s·ê + t·p with s·along + t·across ≤ 0.
                    let end = -s * along / across;
                    if *across > 0.0 {
                        to = to.min(end);
                    } else if *across < 0.0 {
                        from = from.max(end);
                    } else if s * along > 0.0 {
                        return 0.0;
                    }
                }
                (to - from).max(0.0)
            }
            Form::Table(values) => {
                let panel = self.panels.partition_point(|end| *end <= s).clamp(1, values.len()) - 1;
                let (low, high) = (self.panels[panel], self.panels[panel + 1]);
                panels::interpolated(low, high, &values[panel], s) * scalar_power(left, self.dimension - 1)
            }
        }
    }

    /// ∫ g, the volume of the cone in the unit ball.
    fn volume(&self) -> f64 {
        self.panels.windows(2).map(|pair| panels::integral(pair[0], pair[1], |s| self.at(s))).sum()
    }
}

/// x^(k/2), x ≥ 0.
fn scalar_power(x: f64, k: usize) -> f64 {
    let whole = x.powi((k / 2) as i32);
    if k.is_multiple_of(2) { whole } else { whole * x.sqrt() }
}

/// What a normal cone is to a direction.
#[derive(Clone, Debug)]
pub(super) enum Seen {
    /// The length of the direction's part in the span of the cone, and the section function along it.
    Along(f64, Rc<ConeCut>),
    /// The direction is orthogonal to the cone, which has this volume in the unit ball.
    Across(f64),
}

/// The normal cones of a polytope, as one direction sees them.
pub(super) struct ConeCuts<'a, const N: usize> {
    normals: &'a Normals<'a, N>,
    direction: Vector<N>,
    /// By rank and face.
    known: Vec<Vec<Option<Seen>>>,
    /// The same for a direction that is orthogonal to nothing, for volumes.
    oblique: Option<Box<Self>>,
    /// How many directions came before that one.
    tries: u32,
}

/// One side of a cone.
struct Side {
    /// ê·(outward normal) = −ε.
    outward: f64,
    /// λ.
    length: f64,
    seen: Seen,
}

impl<'a, const N: usize> ConeCuts<'a, N> {
    /// For a unit direction.
    pub(super) fn new(normals: &'a Normals<'a, N>, direction: Vector<N>) -> Self {
        let none = |rank: usize| vec![None; normals.lattice().faces(rank).len()];
        Self { normals, direction, known: (0..N).map(none).collect(), oblique: None, tries: 0 }
    }

    /// The normal cone of a face.
    pub(super) fn seen(&mut self, rank: usize, face: usize) -> Seen {
        if let Some(seen) = &self.known[rank][face] {
            return seen.clone();
        }
        let seen = if rank + 1 == N { self.ray(face) } else { self.cone(rank, face) };
        self.known[rank][face] = Some(seen.clone());
        seen
    }

    /// The volume of a cone in the unit ball.
    fn content(&mut self, rank: usize, face: usize) -> f64 {
        let (normals, tries) = (self.normals, self.tries + 1);
        let oblique = self.oblique.get_or_insert_with(|| {
            // Irrational components, so that no lattice is met.
            let component = |i: usize| scalar::sin(f64::from(tries) + 1.7 * (i as f64 + 1.0));
            Box::new(Self { tries, ..Self::new(normals, Vector::from_fn(component).normalize_or_zero()) })
        });
        match oblique.seen(rank, face) {
            Seen::Along(_, cut) => cut.volume(),
            Seen::Across(volume) => volume,
        }
    }

    fn ray(&self, facet: usize) -> Seen {
        let height = self.normals.facet_normal(facet as u32).dot(self.direction);
        if height.abs() < BLIND {
            return Seen::Across(1.0);
        }
        let range = if height > 0.0 { [0.0, 1.0] } else { [-1.0, 0.0] };
        let breaks = vec![-1.0, 0.0, 1.0];
        let cut = ConeCut { dimension: 1, range, breaks, panels: range.to_vec(), form: Form::Ray };
        Seen::Along(height.abs(), Rc::new(cut))
    }

    /// A cone of two dimensions or more.
    fn cone(&mut self, rank: usize, face: usize) -> Seen {
        let (own, towards) = self.normals.directions(rank, face);
        let part = orthogonal_part(self.direction, &own);
        let length = part.norm();
        if length < BLIND {
            return Seen::Across(self.content(rank, face));
        }
        let along = part / length;
        let cofaces = self.normals.cofaces(rank, face).to_vec();
        let sides: Vec<Side> = cofaces
            .iter()
            .zip(&towards)
            .map(|(&coface, towards)| {
                let seen = self.seen(rank + 1, coface as usize);
                let own = if let Seen::Along(own, _) = &seen { *own } else { 0.0 };
                Side { outward: along.dot(*towards), length: own / length, seen }
            })
            .collect();
        let (range, breaks) = extent(&sides);
        let mut cut =
            ConeCut { dimension: N - rank, range, panels: panels::graded(&breaks, range), breaks, form: Form::Ray };
        cut.form = if cut.dimension == 2 { sector(along, &towards) } else { cut.table(&sides) };
        Seen::Along(length, Rc::new(cut))
    }
}

/// Where g is not zero, and where it is not smooth.
fn extent(sides: &[Side]) -> ([f64; 2], Vec<f64>) {
    let mut range = [0.0_f64, 0.0];
    let mut breaks = vec![-1.0, 0.0, 1.0];
    for side in sides {
        if let Seen::Along(_, cut) = &side.seen {
            range = [range[0].min(side.length * cut.range[0]), range[1].max(side.length * cut.range[1])];
            breaks.extend(cut.breaks.iter().map(|s| s * side.length));
        }
    }
    // The cone holds ê, or −ê.
    if sides.iter().all(|side| side.outward <= 0.0) {
        range[1] = 1.0;
    }
    if sides.iter().all(|side| side.outward >= 0.0) {
        range[0] = -1.0;
    }
    (range, panels::in_order(breaks))
}

fn sector<const N: usize>(along: Vector<N>, towards: &[Vector<N>]) -> Form {
    let part = |side: Vector<N>| side - along * along.dot(side);
    let across = towards
        .iter()
        .map(|&side| part(side))
        .fold(Vector::ZERO, |best: Vector<N>, v| if v.norm_sq() > best.norm_sq() { v } else { best });
    let across = across.normalize_or_zero();
    Form::Sector([0, 1].map(|i| [towards[i].dot(along), towards[i].dot(across)]))
}

impl ConeCut {
    fn table(&self, sides: &[Side]) -> Form {
        let power = self.dimension + 1;
        let slope = |s: f64| {
            let of_side = |side: &Side| match &side.seen {
                Seen::Along(_, cut) => -side.outward / side.length * cut.at(s / side.length),
                Seen::Across(_) => 0.0,
            };
            sides.iter().map(of_side).sum::<f64>() / scalar_power((1.0 - s) * (1.0 + s), power)
        };
        // What facets across ê add at s = 0.
        let step: f64 = sides
            .iter()
            .map(|side| if let Seen::Across(volume) = side.seen { -side.outward * volume } else { 0.0 })
            .sum();
        let highest = |sign: f64| sides.iter().map(|side| sign * side.outward).fold(f64::NEG_INFINITY, f64::max);
        let upwards = highest(1.0) <= highest(-1.0);
        let count = self.panels.len().saturating_sub(1);
        let mut values = vec![[0.0; NODES]; count];
        let order: Vec<usize> = if upwards { (0..count).collect() } else { (0..count).rev().collect() };
        let mut reached = 0.0;
        for panel in order {
            let (low, high) = (self.panels[panel], self.panels[panel + 1]);
            let (partial, whole) = panels::integrals(low, high, slope);
            // From below the step comes before the panel that begins at zero, from above after it.
            if upwards && low.abs() < BLIND {
                reached += step;
            } else if !upwards && high.abs() < BLIND {
                reached -= step;
            }
            let start = if upwards { reached } else { reached - whole };
            values[panel] = partial.map(|value| start + value);
            reached = if upwards { start + whole } else { start };
        }
        Form::Table(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Polytope;
    use crate::regular::{Size, polytope};
    use crate::volume::unit_ball;

    /// The normal cones of the vertices fill the ball, at each height; where a cone holds the direction, its section ends as the ball's does.
    fn cones_fill_the_ball<const N: usize>(body: &Polytope<N>, direction: Vector<N>) {
        let direction = direction.normalize_or_zero();
        let lattice = body.face_lattice();
        let normals = Normals::new(body, &lattice);
        let mut cuts = ConeCuts::new(&normals, direction);
        let all: Vec<Rc<ConeCut>> = (0..body.vertices().len())
            .map(|vertex| match cuts.seen(0, vertex) {
                Seen::Along(length, cut) if (length - 1.0).abs() < 1e-15 => cut,
                other => panic!("the cone of a vertex spans space: {other:?}"),
            })
            .collect();
        let mut worst: f64 = 0.0;
        for k in -19..20 {
            let s = f64::from(k) / 20.0 + 0.003;
            let expected = unit_ball(N - 1) * scalar_power(1.0 - s * s, N - 1);
            worst = worst.max((all.iter().map(|cut| cut.at(s)).sum::<f64>() - expected).abs());
        }
        let volume = all.iter().map(|cut| cut.volume()).sum::<f64>();
        let panels = all.iter().map(|cut| cut.panels.len()).max().unwrap_or(0);
        println!("{N}D, {} vertices: off by {worst:.1e}, {panels} panels", all.len());
        assert!(worst < 1e-9 && (volume - unit_ball(N)).abs() < 1e-9, "{worst:e} {volume}");
    }

    fn check<const N: usize>(names: &[&str]) {
        let oblique = Vector::<N>::from_fn(|i| [0.53, -0.71, 0.37, 0.61, -0.29, 0.43][i]);
        let narrow = Vector::<N>::from_fn(|i| if i == 0 { 1.0 } else { 1e-4 * (1.0 + i as f64) });
        for name in names {
            let body = polytope::<N>(name, Size::Circumradius(1.0)).unwrap();
            for direction in [oblique, narrow, Vector::unit(N - 1), Vector::unit(0), Vector::splat(1.0)] {
                cones_fill_the_ball(&body, direction);
            }
        }
        let mut state = 12_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
        };
        for squash in [1.0, 0.05] {
            let points: Vec<Vector<N>> =
                (0..N + 3).map(|_| Vector::from_fn(|i| next() * if i == 0 { squash } else { 1.0 })).collect();
            cones_fill_the_ball(&Polytope::from_points(&points).unwrap(), oblique);
        }
    }

    #[test]
    fn normal_cones_of_the_vertices_fill_the_ball_at_each_height() {
        check::<2>(&["pentagon"]);
        check::<3>(&["cube", "dodecahedron", "icosahedron"]);
        check::<4>(&["simplex", "16-cell", "24-cell"]);
        check::<5>(&["simplex", "cube", "orthoplex"]);
        check::<6>(&["simplex"]);
    }
}
