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
//!
//! What happens near ±ê is told by the angle to it: a cone that is w wide there, as those of thin bodies and of facets that noise has
//! split are, has all its features within w²/2 of s = ±1, where numbers of double precision are too far apart. So heights are
//! latitudes, s = sin φ, and a facet that ê passes at the sine |ε| is met at h_G = √(h² − ε²)/λ where C is met at h = cos φ. With
//! T = g/h^(m−1), the part of the ball's section that C takes, up to a factor, dT/dφ = h^(−m) Σ_G ε g_G/λ.
//!
//! At least one end of g is zero, since C holds no line. From there the integral goes; of two such ends from the one farther from ±ê,
//! because an error of T, which what is steep near ±ê leaves, goes on with T, and is worth least where the ball's section is small.
//!
//! Own derivation; cones of two dimensions are chords of a sector.

use std::f64::consts::FRAC_PI_2;
use std::rc::Rc;

use hyperbody_math::{Vector, scalar};

use super::density;
use super::panels::{self, NODES};
use crate::mass::{Normals, orthogonal_part};
use crate::volume::unit_ball;

/// A face that has less than this of a unit direction is orthogonal to it: what it cuts off would be thinner than that.
const BLIND: f64 = 1e-9;

/// Sines below which angles are taken for none, one after the other, until cones make a whole. Vertices with noise contradict the normals of
/// the facets that they are taken for, and angles as small as that say which way a facet goes at random.
const BLURRED: [f64; 4] = [0.0, 1e-8, 1e-7, 1e-6];

/// What the normal cones of all vertices may miss of the ball's section, in parts of the largest one.
const MAX_MISSED: f64 = 2e-7;

/// What rounding leaves of it.
const NOTHING_MISSED: f64 = 1e-9;

/// Heights at which that is looked at.
const LOOKED_AT: [f64; 8] = [-0.93, -0.67, -0.41, -0.13, 0.17, 0.43, 0.71, 0.96];

/// The function g of one cone, by latitude.
#[derive(Debug)]
pub(super) struct ConeCut {
    dimension: usize,
    /// Where g is not zero.
    range: [f64; 2],
    /// Where g is not smooth, or would not be if it went on.
    breaks: Vec<f64>,
    /// Ends of the panels, over all of the range.
    panels: Vec<f64>,
    /// The same as heights s.
    pub(super) heights: Vec<f64>,
    form: Form,
}

#[derive(Debug)]
enum Form {
    /// One for a ray.
    Ray,
    /// Of two sides: what of the outward normals lies along ê and across it, in the plane of the cone.
    Sector([[f64; 2]; 2]),
    /// T at the nodes of each panel.
    Table(Vec<[f64; NODES]>),
}

impl ConeCut {
    /// g(s).
    pub(super) fn at(&self, s: f64) -> f64 {
        if s.abs() > 1.0 { 0.0 } else { self.at_latitude(latitude(s, ((1.0 - s) * (1.0 + s)).sqrt())) }
    }

    fn new(dimension: usize, range: [f64; 2], breaks: Vec<f64>, panels: Vec<f64>) -> Self {
        let heights = panels.iter().map(|&latitude| scalar::sin(latitude)).collect();
        Self { dimension, range, breaks, panels, heights, form: Form::Ray }
    }

    fn at_latitude(&self, latitude: f64) -> f64 {
        // Half open, as splines are: what ends at a height goes on in another piece.
        if latitude < self.range[0] || latitude >= self.range[1] {
            return 0.0;
        }
        match &self.form {
            Form::Ray => 1.0,
            Form::Sector(sides) => {
                let (s, half) = scalar::sin_cos(latitude);
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
                let panel = self.panels.partition_point(|end| *end <= latitude).clamp(1, values.len()) - 1;
                let (low, high) = (self.panels[panel], self.panels[panel + 1]);
                let half = scalar::cos(latitude).max(0.0);
                panels::interpolated(low, high, &values[panel], latitude) * half.powi(self.dimension as i32 - 1)
            }
        }
    }

    /// ∫ g, the volume of the cone in the unit ball.
    fn volume(&self) -> f64 {
        self.heights.windows(2).map(|pair| panels::integral(pair[0], pair[1], |s| self.at(s))).sum()
    }
}

/// The angle of which s and h are sine and cosine, but for a common factor; h ≥ 0.
fn latitude(s: f64, h: f64) -> f64 {
    scalar::atan2(s, h)
}

/// What a normal cone is to a direction.
#[derive(Clone, Debug)]
pub(super) enum Seen {
    /// The length of the direction's part in the span of the cone, and the section function along it.
    Along(f64, Rc<ConeCut>),
    /// The direction is orthogonal to the cone, which has this volume in the unit ball.
    Across(f64),
}

impl Seen {
    /// The volume of the cone in the unit ball.
    fn volume(&self) -> f64 {
        match self {
            Self::Along(_, cut) => cut.volume(),
            Self::Across(volume) => *volume,
        }
    }
}

/// The normal cones of a polytope, as one direction sees them.
pub(crate) struct ConeCuts<'a, const N: usize> {
    normals: &'a Normals<'a, N>,
    direction: Vector<N>,
    /// Sines below this are none.
    blurred: f64,
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

impl Side {
    /// Where the cone is met where the side is, seen from its own direction.
    fn outer(&self, own: f64) -> f64 {
        let (s, h) = scalar::sin_cos(own);
        latitude(self.length * s, (self.length * h).hypot(self.outward))
    }

    /// The other way round; `None` where the side ends before.
    fn own(&self, outer: f64) -> Option<f64> {
        let (s, h) = scalar::sin_cos(outer);
        // λ² + ε² = s² + h² = 1: by whichever pair is smaller, for the difference of numbers next to one is noise.
        let (large, small) = if self.length < 0.5 { (self.length, s) } else { (h, self.outward) };
        let left = (large - small) * (large + small);
        (left > 0.0).then(|| latitude(s, left.sqrt()))
    }
}

impl<'a, const N: usize> ConeCuts<'a, N> {
    /// For a unit direction. `None` where the cones contradict each other.
    pub(crate) fn new(normals: &'a Normals<'a, N>, direction: Vector<N>) -> Option<Self> {
        let mut best: Option<(f64, Self)> = None;
        for blurred in BLURRED {
            let mut cuts = Self::seen_along(normals, direction, blurred);
            let missed = cuts.missed();
            if missed < MAX_MISSED && best.as_ref().is_none_or(|(least, _)| missed < *least) {
                best = Some((missed, cuts));
            }
            if missed < NOTHING_MISSED {
                break;
            }
        }
        best.map(|(_, cuts)| cuts)
    }

    fn seen_along(normals: &'a Normals<'a, N>, direction: Vector<N>, blurred: f64) -> Self {
        let none = |rank: usize| vec![None; normals.lattice().faces(rank).len()];
        Self { normals, direction, blurred, known: (0..N).map(none).collect(), oblique: None, tries: 0 }
    }

    /// What the normal cones of all vertices miss of the ball's section, in parts of the largest one: every direction is in one of them.
    fn missed(&mut self) -> f64 {
        let cones: Vec<Seen> = (0..self.normals.lattice().faces(0).len()).map(|vertex| self.seen(0, vertex)).collect();
        let missed = |s: f64| {
            let of_cone = |cone: &Seen| if let Seen::Along(_, cut) = cone { cut.at(s) } else { f64::INFINITY };
            (cones.iter().map(of_cone).sum::<f64>() - density::of_ball(N, 1.0, s)).abs() / unit_ball(N - 1)
        };
        LOOKED_AT.into_iter().map(missed).fold(0.0, |most, missed| if missed <= most { most } else { missed })
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
            let direction = Vector::from_fn(component).normalize_or_zero();
            Box::new(Self { tries, ..Self::seen_along(normals, direction, 0.0) })
        });
        oblique.seen(rank, face).volume()
    }

    /// The solid angle of the normal cone of a face.
    pub(crate) fn solid_angle(&mut self, rank: usize, face: usize) -> f64 {
        (N - rank) as f64 * self.seen(rank, face).volume()
    }

    fn ray(&self, facet: usize) -> Seen {
        let height = self.normals.facet_normal(facet as u32).dot(self.direction);
        if height.abs() < BLIND.max(self.blurred) {
            return Seen::Across(1.0);
        }
        let range = if height > 0.0 { [0.0, FRAC_PI_2] } else { [-FRAC_PI_2, 0.0] };
        let breaks = vec![-FRAC_PI_2, 0.0, FRAC_PI_2];
        Seen::Along(height.abs(), Rc::new(ConeCut::new(1, range, breaks, range.to_vec())))
    }

    /// A cone of two dimensions or more.
    fn cone(&mut self, rank: usize, face: usize) -> Seen {
        let (own, towards) = self.normals.directions(rank, face);
        let part = orthogonal_part(self.direction, &own);
        let length = part.norm();
        if length < BLIND.max(self.blurred) {
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
                match self.sharp(along.dot(*towards)) {
                    0.0 if own > 0.0 => Side { outward: 0.0, length: 1.0, seen },
                    outward => Side { outward, length: own / length, seen },
                }
            })
            .collect();
        let (range, breaks) = extent(&sides);
        let panels = panels::graded(&breaks, range);
        let mut cut = ConeCut::new(N - rank, range, breaks, panels);
        cut.form = if cut.dimension == 2 { self.sector(along, &towards) } else { cut.table(&sides) };
        Seen::Along(length, Rc::new(cut))
    }

    /// Of a cone of two dimensions.
    fn sector(&self, along: Vector<N>, towards: &[Vector<N>]) -> Form {
        let part = |side: Vector<N>| side - along * along.dot(side);
        let across = towards
            .iter()
            .map(|&side| part(side))
            .fold(Vector::ZERO, |best: Vector<N>, v| if v.norm_sq() > best.norm_sq() { v } else { best });
        let across = across.normalize_or_zero();
        Form::Sector([0, 1].map(|i| [towards[i].dot(along), towards[i].dot(across)].map(|sine| self.sharp(sine))))
    }

    /// A sine, or none.
    fn sharp(&self, sine: f64) -> f64 {
        if sine.abs() < self.blurred { 0.0 } else { sine }
    }
}

/// Where g is not zero, and where it is not smooth.
fn extent(sides: &[Side]) -> ([f64; 2], Vec<f64>) {
    let mut range = [0.0_f64, 0.0];
    let mut breaks = vec![-FRAC_PI_2, 0.0, FRAC_PI_2];
    for side in sides {
        if let Seen::Along(_, cut) = &side.seen {
            range = [range[0].min(side.outer(cut.range[0])), range[1].max(side.outer(cut.range[1]))];
            breaks.extend(cut.breaks.iter().map(|&own| side.outer(own)));
        }
    }
    // The cone holds ê, or −ê, and with it directions on that side; a cone without breadth can seem to hold both.
    if range[1] > 0.0 && sides.iter().all(|side| side.outward <= 0.0) {
        range[1] = FRAC_PI_2;
    }
    if range[0] < 0.0 && sides.iter().all(|side| side.outward >= 0.0) {
        range[0] = -FRAC_PI_2;
    }
    (range, panels::in_order(breaks, panels::NEAREST))
}

impl ConeCut {
    fn table(&self, sides: &[Side]) -> Form {
        let slope = |latitude: f64| {
            let of_side = |side: &Side| match &side.seen {
                Seen::Along(_, cut) => {
                    let own = side.own(latitude).map_or(0.0, |own| cut.at_latitude(own));
                    -side.outward / side.length * own
                }
                Seen::Across(_) => 0.0,
            };
            let half = scalar::cos(latitude).max(f64::MIN_POSITIVE);
            sides.iter().map(of_side).sum::<f64>() / half.powi(self.dimension as i32)
        };
        // What facets across ê add at s = 0.
        let step: f64 = sides
            .iter()
            .map(|side| if let Seen::Across(volume) = side.seen { -side.outward * volume } else { 0.0 })
            .sum();
        // A cone that holds ±ê ends there, and is nowhere near as far from the other.
        let upwards = -self.range[0] <= self.range[1];
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

    /// The normal cones of the vertices fill the ball, at each height; where a cone holds the direction, its section ends as the ball's does.
    fn cones_fill_the_ball<const N: usize>(body: &Polytope<N>, direction: Vector<N>) {
        let direction = direction.normalize_or_zero();
        let lattice = body.face_lattice();
        let normals = Normals::new(body, &lattice);
        let mut cuts = ConeCuts::new(&normals, direction).unwrap();
        let all: Vec<Rc<ConeCut>> = (0..body.vertices().len())
            .map(|vertex| match cuts.seen(0, vertex) {
                Seen::Along(length, cut) if (length - 1.0).abs() < 1e-15 => cut,
                other => panic!("the cone of a vertex spans space: {other:?}"),
            })
            .collect();
        let mut worst: f64 = 0.0;
        for k in -19..20 {
            let s = f64::from(k) / 20.0 + 0.003;
            let expected = unit_ball(N - 1) * (1.0 - s * s).powf(0.5 * (N as f64 - 1.0));
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
        for squash in [1.0, 0.05, 1e-3, 1e-5, 1e-6] {
            let points: Vec<Vector<N>> =
                (0..N + 3).map(|_| Vector::from_fn(|i| next() * if i == 0 { squash } else { 1.0 })).collect();
            let body = Polytope::from_points(&points).unwrap();
            cones_fill_the_ball(&body, oblique);
            // Half of the facets have normals that come as near to this direction as the body is thin, half to its opposite.
            if N <= 4 {
                cones_fill_the_ball(&body, Vector::unit(0));
            }
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
