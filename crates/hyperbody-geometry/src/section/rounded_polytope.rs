//! Volumes of sections of rounded polytopes.
//!
//! Each point of the polytope rounded by r is x + y in exactly one way, with x in a face F and y in the normal cone of F, |y| ≤ r (see
//! `mass::rounded_polytope`), and n·x and n·y are independent for points that are uniform there. So the section function is a sum over
//! the faces of convolutions: of a B-spline, for the heights of F, with the section function of the cone within a ball (see
//! `cone_cut`). Both are smooth between breaks that are known, and the integrals over what lies in between take a few nodes.

use hyperbody_math::Vector;

use super::cone_cut::{ConeCuts, Seen};
use super::{density, panels};
use crate::mass::{Normals, simplex_content};
use crate::{Convex, Core, FaceLattice, Polytope};

/// A face whose heights differ by less than this, in parts of what its cone adds, is level.
const LEVEL: f64 = 1e-9;

/// The volumes of all sections across one direction.
pub(crate) struct SectionFunction<const N: usize> {
    core: Vec<density::Simplex<N>>,
    normal: Vector<N>,
    radius: f64,
    parts: Vec<Part>,
}

/// All points nearest to one face.
struct Part {
    rank: usize,
    /// Of the face's vertices along the normal, in order.
    heights: Vec<f64>,
    /// Content and heights of the corners of simplices that fill the face.
    simplices: Vec<(f64, Vec<f64>)>,
    content: f64,
    cone: Seen,
}

impl<const N: usize> SectionFunction<N> {
    /// Of a rounded box or polytope. `None` for other cores, for boxes thinner than a hull can be, and where noise in the
    /// vertices leaves normal cones that contradict each other.
    pub(crate) fn of_convex(convex: &Convex<N>, normal: Vector<N>) -> Option<Self> {
        match &convex.core {
            _ if N < 2 => None,
            core @ Core::Box { .. } => Self::new(&Polytope::from_points(&core.corners()).ok()?, convex.radius, normal),
            Core::Polytope(polytope) => Self::new(polytope, convex.radius, normal),
            Core::Point | Core::Segment { .. } => None,
        }
    }

    /// For a unit normal and a radius ≥ 0.
    fn new(polytope: &Polytope<N>, radius: f64, normal: Vector<N>) -> Option<Self> {
        let core = density::filling(polytope);
        if radius == 0.0 {
            return Some(Self { core, normal, radius, parts: Vec::new() });
        }
        let lattice = polytope.face_lattice();
        let normals = Normals::new(polytope, &lattice);
        let mut cuts = ConeCuts::new(&normals, normal)?;
        let heights: Vec<f64> = polytope.vertices().iter().map(|v| v.dot(normal)).collect();
        let mut parts = Vec::new();
        for rank in 0..N {
            for face in 0..lattice.faces(rank).len() {
                let cone = cuts.seen(rank, face);
                parts.push(Part::new(polytope, &lattice, &heights, rank, face, cone));
            }
        }
        Some(Self { core, normal, radius, parts })
    }

    /// The volume of the section at this offset, m^(N−1), to 1e-9 of the widest one at worst.
    pub(crate) fn at(&self, offset: f64) -> f64 {
        let core = density::of_simplices(&self.core, self.normal, offset);
        if self.radius == 0.0 {
            return core;
        }
        core + self.parts.iter().map(|part| part.at(offset, self.radius, N)).sum::<f64>()
    }
}

impl Part {
    fn new<const N: usize>(
        polytope: &Polytope<N>,
        lattice: &FaceLattice,
        all_heights: &[f64],
        rank: usize,
        face: usize,
        cone: Seen,
    ) -> Self {
        let along = |list: &[u32]| list.iter().map(|&v| all_heights[v as usize]).collect::<Vec<f64>>();
        let simplices: Vec<(f64, Vec<f64>)> = lattice
            .triangulation(rank, face)
            .iter()
            .map(|simplex| {
                let corners: Vec<Vector<N>> = simplex.iter().map(|&v| polytope.vertices()[v as usize]).collect();
                (simplex_content(&corners), along(simplex))
            })
            .collect();
        let mut heights = along(&lattice.faces(rank)[face].vertices);
        heights.sort_unstable_by(f64::total_cmp);
        let content = simplices.iter().map(|(content, _)| content).sum();
        Self { rank, heights, simplices, content, cone }
    }

    /// Its part of the section in a space of so many dimensions.
    fn at(&self, offset: f64, radius: f64, dimension: usize) -> f64 {
        let power = radius.powi((dimension - self.rank) as i32);
        let (lowest, highest) = (self.heights[0], self.heights[self.heights.len() - 1]);
        let (length, cut) = match &self.cone {
            Seen::Across(volume) => return power * volume * self.face_at(offset),
            Seen::Along(length, cut) => (radius * length, cut),
        };
        if highest - lowest < LEVEL * length {
            let middle = 0.5 * (lowest + highest);
            return power * self.content * cut.at((offset - middle) / length) / length;
        }
        let (Some(first), Some(last)) = (cut.heights.first(), cut.heights.last()) else { return 0.0 };
        let low = first.max((offset - highest) / length);
        let high = last.min((offset - lowest) / length);
        if high <= low {
            return 0.0;
        }
        let knots = self.heights.iter().map(|height| (offset - height) / length);
        let inside = knots.chain(cut.heights.iter().copied()).filter(|s| *s > low && *s < high);
        // A face that is nearly level is a high and narrow peak, whose breaks are as close to each other as it is narrow.
        let ends = panels::in_order(inside.chain([low, high]).collect(), panels::NEAREST * (high - low));
        let over = |pair: &[f64]| panels::integral(pair[0], pair[1], |s| cut.at(s) * self.face_at(offset - length * s));
        power * ends.windows(2).map(over).sum::<f64>()
    }

    /// The content of the face at a height.
    fn face_at(&self, height: f64) -> f64 {
        self.simplices.iter().map(|(content, corners)| content * density::spline(corners, height)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;
    use crate::regular::{Size, polytope};
    use crate::section::{SupportMap, measure};

    fn rounded_box<const N: usize>(half: Vector<N>) -> Convex<N> {
        Convex { core: Core::Box { half_extents: half }, radius: 0.2 }
    }

    /// Across an axis a rounded box is one of less dimensions and less radius, whose volume is Steiner's sum.
    fn boxes_across_an_axis<const N: usize, const M: usize>() {
        let half = |i: usize| 0.3 + 0.07 * i as f64;
        let function = SectionFunction::of_convex(&rounded_box(Vector::<N>::from_fn(half)), Vector::unit(M)).unwrap();
        for out in [0.0, 0.1, 0.19, 0.1999] {
            let rest = Shape::<M>::cuboid(Vector::from_fn(half)).unwrap();
            let rest = Shape::rounded(rest, f64::sqrt((0.2 - out) * (0.2 + out))).unwrap();
            let expected = rest.mass_properties(1.0).unwrap().mass;
            let found = function.at(-half(M) - out);
            assert!((found / expected - 1.0).abs() < 1e-10, "{N}D, {out} out: {found} for {expected}");
        }
    }

    #[test]
    fn rounded_boxes_across_an_axis_are_rounded_boxes() {
        boxes_across_an_axis::<3, 2>();
        boxes_across_an_axis::<4, 3>();
        boxes_across_an_axis::<5, 4>();
        boxes_across_an_axis::<6, 5>();
    }

    /// All heights at which a face begins or ends to be met.
    fn breaks<const N: usize>(function: &SectionFunction<N>) -> Vec<f64> {
        let mut breaks = Vec::new();
        for part in &function.parts {
            let ends = match &part.cone {
                Seen::Along(length, cut) => {
                    [cut.heights.first(), cut.heights.last()].map(|end| function.radius * length * end.unwrap())
                }
                Seen::Across(_) => [0.0; 2],
            };
            breaks.extend(part.heights.iter().flat_map(|height| ends.map(|end| height + end)));
        }
        breaks
    }

    /// ∫ over the offset, panel by panel between those.
    fn integrated<const N: usize>(function: &SectionFunction<N>) -> f64 {
        let ends = panels::in_order(breaks(function), panels::NEAREST);
        let (low, high) = (ends[0], ends[ends.len() - 1]);
        let ends = panels::graded(&ends, [low, high]);
        ends.windows(2).map(|pair| panels::integral(pair[0], pair[1], |offset| function.at(offset))).sum()
    }

    fn adds_up<const N: usize>(body: &Polytope<N>, tilts: &[f64]) {
        let volume = Shape::rounded(Shape::polytope(body.clone().into()).unwrap(), 0.2).unwrap();
        let volume = volume.mass_properties(1.0).unwrap().mass;
        for tilt in tilts {
            let normal = Vector::from_fn(|i| if i == 0 { 1.0 } else { tilt * [0.61, -0.37, 0.71, 0.29, -0.43][i - 1] });
            let function = SectionFunction::new(body, 0.2, normal.normalize_or_zero()).unwrap();
            let error = integrated(&function) / volume - 1.0;
            println!("{N}D, {} vertices, tilt {tilt}: {error:.1e}", body.vertices().len());
            assert!(error.abs() < 1e-9, "{N}D, tilt {tilt}: {error:e}");
        }
    }

    #[test]
    fn sections_in_all_directions_add_up_to_the_volume() {
        fn regular<const N: usize>(name: &str) -> Polytope<N> {
            polytope(name, Size::Circumradius(0.7)).unwrap()
        }
        // From faces that are level, over such as nearly are, to none.
        let tilts = [0.0, 1e-12, 1e-8, 1e-5, 1e-2, 1.0];
        adds_up::<2>(&regular("pentagon"), &tilts);
        adds_up::<3>(&regular("cube"), &tilts);
        adds_up::<4>(&regular("simplex"), &[0.0, 1.0]);
    }

    /// Supports know nothing of faces.
    fn as_by_supports<const N: usize>(body: &Convex<N>, tolerance: f64, offsets: &[f64]) {
        for k in 0..offsets.len() {
            let normal = Vector::<N>::from_fn(|i| [0.53, -0.71, 0.37, 0.61][(i + k) % 4]).normalize_or_zero();
            let function = SectionFunction::of_convex(body, normal).unwrap();
            for &offset in offsets {
                let expected = measure::section_by_support(body, normal, offset, 0.1 * tolerance);
                let found = function.at(offset);
                assert!((found - expected).abs() < tolerance, "{N}D {normal:?} at {offset}: {found} for {expected}");
            }
        }
    }

    #[test]
    fn sections_are_those_measured_by_supports() {
        fn rounded<const N: usize>(name: &str) -> Convex<N> {
            let body = polytope(name, Size::Circumradius(0.7)).unwrap();
            Convex { core: Core::Polytope(body.into()), radius: 0.2 }
        }
        let offsets = [-0.7, 0.02, 0.45];
        as_by_supports::<2>(&rounded("pentagon"), 1e-9, &offsets);
        as_by_supports::<3>(&rounded("dodecahedron"), 1e-8, &offsets);
        as_by_supports::<3>(&rounded_box(Vector([0.3, 0.4, 0.5])), 1e-8, &offsets);
        as_by_supports::<4>(&rounded("24-cell"), 1e-5, &[0.3]);
        as_by_supports::<4>(&rounded_box(Vector([0.3, 0.4, 0.5, 0.6])), 1e-5, &[0.3]);
    }

    /// A body of which the support is exact says what its section is, however thin it is.
    fn thin_bodies<const N: usize>(thicknesses: &[f64], tolerance: f64) {
        let mut state = 40_u64 + N as u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for &thickness in thicknesses {
            let points: Vec<Vector<N>> =
                (0..N + 8).map(|_| Vector::from_fn(|i| next() * if i == 0 { thickness } else { 1.0 })).collect();
            let core = Polytope::from_points(&points).unwrap();
            let body = Convex { core: Core::Polytope(core.into()), radius: 0.2 };
            let narrow = Vector::from_fn(|i| if i == 0 { 1.0 } else { thickness }).normalize_or_zero();
            let oblique = Vector::from_fn(|i| [0.53, -0.71, 0.37][i]).normalize_or_zero();
            for normal in [Vector::unit(0), narrow, Vector::unit(1), oblique] {
                let function = SectionFunction::of_convex(&body, normal).unwrap();
                for offset in [0.0, 0.07, -0.15] {
                    // Along edges that are next to straight it believes an arc too soon, so that it is asked for more.
                    let expected = measure::section_by_support(&body, normal, offset, 1e-3 * tolerance);
                    let error = function.at(offset) / expected - 1.0;
                    assert!(
                        error.abs() < tolerance,
                        "{N}D, {thickness:e} thin, {normal:?} at {offset}: off by {error:e}"
                    );
                }
            }
        }
    }

    /// The normals of a flat body come together within its thickness, where heights on the unit sphere are next to one: sections across
    /// lenses of 1e-5 were off by 1e-2.
    #[test]
    fn thin_bodies_are_cut_as_closely_as_thick_ones() {
        thin_bodies::<2>(&[1e-2, 1e-4, 1e-6], 1e-7);
        thin_bodies::<3>(&[1e-2, 1e-4, 1e-5, 1e-6], 1e-7);
    }

    /// Boxes whose corners are off by so much: the facets that this splits have normals that differ by next to nothing, and those that it
    /// leaves are not quite flat. Sections that were 20,000 times too large came of it.
    fn noisy_boxes<const N: usize>(half: Vector<N>, seeds: std::ops::Range<u64>) {
        for (noise, radius) in [(1e-12, 0.2), (1e-11, 0.2), (1e-10, 0.2), (1e-9, 0.2), (1e-8, 0.2), (1e-9, 1e-3)] {
            for seed in seeds.clone() {
                let mut state = seed;
                let mut next = || {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
                };
                let side = |k: usize, i: usize| if k >> i & 1 == 1 { half[i] } else { -half[i] };
                let points: Vec<Vector<N>> =
                    (0..1 << N).map(|k| Vector::from_fn(|i| side(k, i) + noise * next())).collect();
                let core = Core::Polytope(Polytope::from_points(&points).unwrap().into());
                let exact = Convex { core: Core::Box { half_extents: half }, radius };
                for normal in [Vector::unit(0), Vector::unit(N - 1), Vector::splat(0.3) + Vector::unit(1) * 0.4] {
                    let normal = normal.normalize_or_zero();
                    let noisy = SectionFunction::of_convex(&Convex { core: core.clone(), radius }, normal).unwrap();
                    let exact_function = SectionFunction::of_convex(&exact, normal).unwrap();
                    let top = SupportMap::support(&exact, normal).dot(normal);
                    for offset in [0.03, 0.3, 0.7, 0.9].map(|part| part * top) {
                        let error = noisy.at(offset) / exact_function.at(offset) - 1.0;
                        assert!(
                            error.abs() < 1e-6,
                            "{N}D, {half:?} with noise {noise:e} ({seed}), radius {radius}, {normal:?} at {offset}: {error:e}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn noise_in_the_corners_is_noise_in_the_section() {
        noisy_boxes(Vector([0.5, 0.5]), 1..4);
        noisy_boxes(Vector([0.5, 0.5, 0.5]), 1..4);
        noisy_boxes(Vector([0.05, 0.5, 0.5]), 1..4);
        noisy_boxes(Vector([0.5, 0.5, 0.5, 0.5]), 1..2);
        noisy_boxes(Vector([0.05, 0.5, 0.5, 0.5]), 1..2);
    }

    /// A box whose corners are off by so much.
    fn uneven_slab<const N: usize>(thickness: f64, noise: f64, seed: u64) -> Polytope<N> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let half = |i: usize| if i == 0 { 0.5 * thickness } else { 0.5 };
        let side = |k: usize, i: usize| if k >> i & 1 == 1 { half(i) } else { -half(i) };
        let corners = (0..1 << N).map(|k| Vector::from_fn(|i| side(k, i) + noise * next()));
        Polytope::from_points(&corners.collect::<Vec<_>>()).unwrap()
    }

    /// What mass, centre and second moments along a direction are off by, in parts of the body, from what its sections add up to.
    fn off_from_sections<const N: usize>(body: &Polytope<N>, radius: f64, normal: Vector<N>) -> f64 {
        let shape = Shape::rounded(Shape::polytope(body.clone().into()).unwrap(), radius).unwrap();
        let found = shape.mass_properties(1.0).unwrap();
        let function = SectionFunction::new(body, radius, normal).unwrap();
        let heights = body.vertices().iter().map(|v| v.dot(normal));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let (low, high) = (low - radius, high + radius);
        // The more dimensions, the smoother is the section and the more there are of its breaks.
        let ends = match N {
            ..4 => panels::in_order(breaks(&function), 1e-6),
            _ => (0..=16).map(|k| low + (high - low) * f64::from(k) / 16.0).collect(),
        };
        let mut sums = [0.0; 3];
        for pair in ends.windows(2) {
            let known = std::cell::RefCell::new(std::collections::BTreeMap::new());
            for (power, sum) in sums.iter_mut().enumerate() {
                *sum += panels::integral(pair[0], pair[1], |offset| {
                    let area = *known.borrow_mut().entry(offset.to_bits()).or_insert_with(|| function.at(offset));
                    area * offset.powi(power as i32)
                });
            }
        }
        let centre = sums[1] / sums[0];
        let second = sums[2] - centre * sums[1];
        let errors = [
            found.mass / sums[0] - 1.0,
            (found.centre.dot(normal) - centre) / (high - low),
            normal.dot(found.second_moments * normal) / second - 1.0,
        ];
        // Unlike their maximum, the sum is no number where one of them is none.
        errors.into_iter().map(f64::abs).sum()
    }

    /// Slabs so thin and uneven that facets must not be joined, or with noise that must be borne: masses were off by up to 4e-3.
    #[test]
    fn masses_of_uneven_slabs_are_what_their_sections_add_up_to() {
        fn grid<const N: usize>(thicknesses: &[f64], noises: &[f64], radii: &[f64]) {
            let normal = Vector::from_fn(|i| [0.53, -0.71, 0.37, 0.61][i]).normalize_or_zero();
            for (seed, &thickness) in thicknesses.iter().enumerate() {
                for &noise in noises {
                    let body = uneven_slab::<N>(thickness, noise, 7 + seed as u64);
                    for &radius in radii {
                        let start = std::time::Instant::now();
                        let error = off_from_sections(&body, radius, normal);
                        println!(
                            "{N}D, {thickness:e} thick, noise {noise:e}, radius {radius:e}: {error:.1e} {:.1?}",
                            start.elapsed()
                        );
                        assert!(
                            error < 1e-6,
                            "{N}D, {thickness:e} thick, noise {noise:e}, radius {radius:e}: {error:e}"
                        );
                    }
                }
            }
        }
        let radii = [1e-3, 0.3];
        grid::<2>(&[1.0, 0.01, 1e-3], &[1e-12, 1e-9, 1e-6, 1e-3], &radii);
        grid::<3>(&[1.0, 0.01, 1e-3], &[1e-12, 1e-9, 1e-6, 1e-3], &radii);
        grid::<4>(&[0.01], &[1e-8, 1e-4], &[1e-3]);
        grid::<4>(&[1e-3], &[1e-6, 1e-3], &[0.3]);
        grid::<4>(&[0.1], &[1e-12], &[0.03]);
    }
}
