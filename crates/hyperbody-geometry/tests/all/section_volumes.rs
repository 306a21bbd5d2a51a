//! Volumes of sections of every sort of shape: integrated over the offset they give the volume of the body, and they are those of
//! closed forms and of the polytopes that approximate the section.

use std::f64::consts::PI;

use crate::common::{Random, slab_of_cube};
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{GeometryErrorKind, Polytope, Shape, SliceFrame, Solid, volume};
use hyperbody_math::{Pose, Vector};

/// Tolerance of each section, in parts of its box.
const TOLERANCE: f64 = 1e-7;

/// What the integral over the offset may be off by, relative.
const LIMIT: f64 = 1e-6;

fn regular<const N: usize>(name: &str, circumradius: f64) -> Shape<N> {
    Shape::polytope(polytope(name, Size::Circumradius(circumradius)).unwrap().into()).unwrap()
}

fn ball<const K: usize>(axes: [usize; K], radius: f64) -> Factor {
    Factor::new(axes, &Shape::ball(radius).unwrap()).unwrap()
}

fn segment(axis: usize, half_length: f64) -> Factor {
    Factor::segment(axis, half_length).unwrap()
}

/// ∫ of the section's volume over the offset, solid by solid.
pub(crate) fn integrated<const N: usize>(shape: &Shape<N>, normal: Vector<N>, tolerance: f64) -> f64 {
    let solids = shape.solids();
    let one = |solid: &Solid<N>| {
        let section = |offset: f64| {
            let frame = SliceFrame::from_normal(normal, offset).unwrap();
            solid.section_volume(&frame, tolerance).unwrap()
        };
        if let Solid::Polytope(polytope) = solid {
            let heights = polytope.vertices().iter().map(|v| v.dot(normal)).collect();
            return integrated_polynomials(heights, &section);
        }
        let low = -solid.reach(-normal);
        integrated_between(low, solid.reach(normal) - low, &section)
    };
    solids.iter().map(one).sum()
}

/// ∫ of the sections of a polytope, polynomials of a degree below six between the heights of its vertices: three nodes are exact there.
fn integrated_polynomials(mut heights: Vec<f64>, section: &dyn Fn(f64) -> f64) -> f64 {
    heights.sort_by(f64::total_cmp);
    let between = |pair: &[f64]| {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        if half < 1e-13 {
            return 0.0;
        }
        let off = half * 0.6_f64.sqrt();
        half / 9.0 * (5.0 * section(middle - off) + 8.0 * section(middle) + 5.0 * section(middle + off))
    };
    heights.windows(2).map(between).sum()
}

/// ∫ by the trapezoidal rule in t with x = low + width·(t − sin 2πt / 2π), which is flat at both ends, with twice as many steps each
/// time until it changes no more.
fn integrated_between(low: f64, width: f64, section: &dyn Fn(f64) -> f64) -> f64 {
    let term = |t: f64| {
        let offset = low + width * (t - (2.0 * PI * t).sin() / (2.0 * PI));
        section(offset) * width * (1.0 - (2.0 * PI * t).cos())
    };
    let (mut steps, mut sum) = (8, (1..8).map(|k| term(f64::from(k) / 8.0)).sum::<f64>());
    let mut previous = sum / 8.0;
    loop {
        sum += (0..steps).map(|k| term((f64::from(k) + 0.5) / f64::from(steps))).sum::<f64>();
        steps *= 2;
        let next = sum / f64::from(steps);
        // Kinks leave an error of the third order in the step or better.
        if (next - previous).abs() < 0.3 * LIMIT * next || steps >= 512 {
            return next;
        }
        previous = next;
    }
}

fn adds_up<const N: usize>(what: &str, shape: &Shape<N>, random: &mut Random) {
    adds_up_along(what, shape, &[Vector::unit(N - 1), random.direction()], TOLERANCE);
}

fn adds_up_along<const N: usize>(what: &str, shape: &Shape<N>, normals: &[Vector<N>], tolerance: f64) {
    let expected = shape.mass_properties(1.0).unwrap().mass;
    let mut worst: f64 = 0.0;
    for &normal in normals {
        worst = worst.max((integrated(shape, normal, tolerance) / expected - 1.0).abs());
    }
    println!("{N}D {what}: the sections add up to the volume to {worst:.1e}");
    assert!(worst < LIMIT, "{N}D {what}: off by {worst:e}");
}

/// Shapes that there are in every dimension.
fn common<const N: usize>() {
    let mut random = Random(200 + N as u64);
    let simplex = regular::<N>("simplex", 0.8);
    adds_up("ball", &Shape::<N>::ball(0.7).unwrap(), &mut random);
    adds_up("box", &Shape::cuboid(Vector::<N>::from_fn(|i| 0.3 + 0.1 * i as f64)).unwrap(), &mut random);
    adds_up("capsule", &Shape::<N>::capsule(0.6, 0.4, 0).unwrap(), &mut random);
    adds_up("simplex", &simplex, &mut random);
    adds_up("cross-polytope", &regular::<N>("orthoplex", 0.8), &mut random);
    adds_up(
        "hull",
        &Shape::polytope(Polytope::from_points(&random.points::<N>(N + 8)).unwrap().into()).unwrap(),
        &mut random,
    );
    let place = |shape, random: &mut Random| (Pose::new(random.rotation(), random.vector() * 0.5), shape);
    let parts = vec![place(simplex, &mut random), place(Shape::capsule(0.4, 0.2, 1).unwrap(), &mut random)];
    adds_up("compound", &Shape::compound(parts).unwrap(), &mut random);
}

/// Shapes that are measured by their supports.
fn rounded<const N: usize>(name: &str) {
    let mut random = Random(220 + N as u64);
    let cube = Shape::cuboid(Vector::<N>::from_fn(|i| 0.3 + 0.1 * i as f64)).unwrap();
    adds_up("rounded box", &Shape::rounded(cube, 0.2).unwrap(), &mut random);
    adds_up(&format!("rounded {name}"), &Shape::rounded(regular::<N>(name, 0.7), 0.2).unwrap(), &mut random);
}

#[test]
fn sections_of_all_common_shapes_add_up_to_the_volume() {
    common::<2>();
    common::<3>();
    common::<4>();
    common::<5>();
    common::<6>();
}

#[test]
fn sections_of_rounded_shapes_add_up_to_the_volume() {
    rounded::<2>("pentagon");
    rounded::<3>("dodecahedron");
}

/// The body is its own mirror image, so half the offsets do.
fn rounded_box_adds_up<const N: usize>(tolerance: f64, panels: u32) {
    let mut random = Random(230 + N as u64);
    let shape = Shape::rounded(Shape::cuboid(Vector::<N>::from_fn(|i| 0.3 + 0.05 * i as f64)).unwrap(), 0.3).unwrap();
    let normal = random.direction::<N>();
    let solid = &shape.solids()[0];
    let reach = solid.reach(normal);
    let mut sum = 0.0;
    for panel in 0..panels {
        for (node, weight) in GAUSS {
            // Towards the end the sections go to nothing like a power.
            let t = (f64::from(panel) + 0.5 * (1.0 + node)) / f64::from(panels);
            let frame = SliceFrame::from_normal(normal, reach * t * (2.0 - t)).unwrap();
            let section = solid.section_volume(&frame, tolerance).unwrap();
            sum += 2.0 * reach * (1.0 - t) * weight / f64::from(panels) * section;
        }
    }
    let error = (sum / shape.mass_properties(1.0).unwrap().mass - 1.0).abs();
    println!("{N}D rounded box: the sections add up to the volume to {error:.1e}");
    assert!(error < LIMIT, "{N}D: {error:e}");
}

#[test]
fn sections_of_rounded_boxes_in_any_direction_add_up_to_the_volume() {
    rounded_box_adds_up::<4>(1e-7, 24);
}

/// ∫ between heights at which the section is smooth, in a variable that makes roots at the ends smooth too. Measuring a solid of
/// three dimensions by its supports takes a while, so that every section counts.
fn between<const N: usize>(solid: &Solid<N>, normal: Vector<N>, knots: &[f64]) -> f64 {
    let piece = |pair: &[f64]| {
        let (low, width) = (pair[0], pair[1] - pair[0]);
        let terms = GAUSS.iter().map(|(node, weight)| {
            let t: f64 = 0.5 * (1.0 + node);
            let frame = SliceFrame::from_normal(normal, low + width * t * t * (3.0 - 2.0 * t)).unwrap();
            0.5 * weight * width * 6.0 * t * (1.0 - t) * solid.section_volume(&frame, 3e-8).unwrap()
        });
        terms.sum::<f64>()
    };
    knots.windows(2).map(piece).sum()
}

#[test]
fn sections_of_rounded_shapes_of_four_dimensions_add_up_to_the_volume() {
    let radius = 0.2;
    // A box along an axis: the sections change where the flat sides end.
    let rounded_box = Shape::rounded(Shape::cuboid(Vector([0.3, 0.4, 0.5, 0.6])).unwrap(), radius).unwrap();
    let found = 2.0 * between(&rounded_box.solids()[0], Vector::unit(3), &[0.0, 0.6, 0.6 + 0.5 * radius, 0.6 + radius]);
    // A simplex on a facet: where the bottom ends, at the top, and where the surface passes on between balls, cylinders around
    // edges and faces, and facets: at n·u = 1/4 of the sloping facets, √(1/6) and √(3/8) of what two and three of them share.
    let simplex = Shape::rounded(regular::<4>("simplex", 0.7), radius).unwrap();
    let (bottom, top) = (-0.7 / 4.0, 0.7);
    let passes = [0.25, (1.0_f64 / 6.0).sqrt(), (3.0_f64 / 8.0).sqrt()];
    let mut knots = vec![bottom - radius, top + radius];
    knots.extend([bottom, top].iter().flat_map(|end| passes.iter().map(move |n| end + radius * n)));
    knots.sort_by(f64::total_cmp);
    let other = between(&simplex.solids()[0], Vector::unit(1), &knots);
    for (what, shape, found) in [("box", rounded_box, found), ("simplex", simplex, other)] {
        let error = (found / shape.mass_properties(1.0).unwrap().mass - 1.0).abs();
        println!("4D rounded {what}: the sections add up to the volume to {error:.1e}");
        assert!(error < LIMIT, "{what}: {error:e}");
    }
}

/// Nodes and weights of Gauss and Legendre on [−1, 1].
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

#[test]
fn sections_of_products_add_up_to_the_volume() {
    let mut random = Random(240);
    let product = |factors| Shape::<4>::product(factors).unwrap();
    let triangle = Factor::new([2, 3], &regular::<2>("triangle", 0.6)).unwrap();
    let rounded_square = Shape::rounded(Shape::<2>::cuboid([0.3, 0.5]).unwrap(), 0.2).unwrap();
    let capsule = Factor::new([0, 1, 2], &Shape::<3>::capsule(0.4, 0.3, 1).unwrap()).unwrap();
    for (what, shape) in [
        ("duocylinder", product(vec![ball([0, 1], 0.7), ball([2, 3], 0.4)])),
        ("spherinder", product(vec![ball([0, 1, 2], 0.6), segment(3, 0.5)])),
        ("cubinder", product(vec![ball([0, 3], 0.6), segment(1, 0.5), segment(2, 0.3)])),
        ("disc and triangle", product(vec![ball([0, 1], 0.6), triangle])),
        ("capsule prism", product(vec![capsule, segment(3, 0.5)])),
    ] {
        adds_up(what, &shape, &mut random);
    }
    let duoprism = product(vec![Factor::new([0, 1], &rounded_square).unwrap(), ball([2, 3], 0.4)]);
    adds_up_along("rounded square and disc", &duoprism, &[random.direction()], 1e-6);
    let cylinder = Shape::<3>::product(vec![ball([0, 2], 0.6), segment(1, 0.5)]).unwrap();
    adds_up("cylinder", &cylinder, &mut random);
    let five = Shape::<5>::product(vec![ball([0, 1], 0.6), ball([2, 3], 0.5), segment(4, 0.4)]).unwrap();
    adds_up("two discs and a segment", &five, &mut random);
}

/// Three ways to the same volume: B-splines, the cut by combinatorics, and for cubes the closed form.
fn polytopes<const N: usize, const M: usize>() {
    let mut random = Random(260 + N as u64);
    let cube = Shape::<N>::cuboid(Vector::splat(0.5)).unwrap();
    let hull = Shape::polytope(Polytope::from_points(&random.points::<N>(N + 10)).unwrap().into()).unwrap();
    let (mut off_cube, mut off_cut): (f64, f64) = (0.0, 0.0);
    for _ in 0..40 {
        let normal = Vector::<N>::from_fn(|_| 0.2 + random.unit()).normalize_or_zero();
        let c = normal.iter().sum::<f64>() * random.unit();
        let frame = SliceFrame::from_normal(normal, c - 0.5 * normal.iter().sum::<f64>()).unwrap();
        let expected = slab_of_cube(normal, c);
        off_cube = off_cube.max((cube.section_volume(&frame, 1e-9).unwrap() - expected).abs());
        let frame = SliceFrame::from_normal(random.direction(), 0.5 * random.symmetric()).unwrap();
        let cut = hull.solids()[0].section::<M>(&frame).map_or(0.0, |section| section.volume(1e-9).unwrap());
        off_cut = off_cut.max((hull.section_volume(&frame, 1e-9).unwrap() - cut).abs());
    }
    println!("{N}D sections: cubes to {off_cube:.1e} of the closed form, hulls to {off_cut:.1e} of the cut");
    assert!(off_cube < 1e-10 && off_cut < 1e-10, "{off_cube:e} {off_cut:e}");
}

#[test]
fn splines_cuts_and_closed_forms_agree() {
    polytopes::<2, 1>();
    polytopes::<3, 2>();
    polytopes::<4, 3>();
    polytopes::<5, 4>();
    polytopes::<6, 5>();
}

/// Convolutions and supports know nothing of each other; nor does the polytope that approximates the section, whose volume
/// falls short by the tolerance times the surface at most, and by less with each smaller tolerance.
#[test]
fn measured_sections_are_those_that_are_drawn() {
    let mut random = Random(280);
    let capsule = Shape::<4>::capsule(0.6, 0.4, 2).unwrap();
    let duocylinder = Shape::<4>::product(vec![ball([0, 1], 0.7), ball([2, 3], 0.4)]).unwrap();
    let rounded = Shape::rounded(regular::<4>("simplex", 0.7), 0.2).unwrap();
    for shape in [capsule, duocylinder, rounded] {
        let frame = SliceFrame::from_normal(random.direction::<4>(), 0.1).unwrap();
        let measured = shape.section_volume(&frame, 1e-8).unwrap();
        let section = shape.solids()[0].section::<3>(&frame).unwrap();
        assert!((section.volume(1e-8).unwrap() / measured - 1.0).abs() < 1e-7, "the section measures itself alike");
        let missing: Vec<f64> = [1e-2, 1e-3, 1e-4]
            .iter()
            .map(|&tolerance| measured - section.to_polytope(tolerance).unwrap().unwrap().mass_properties().mass)
            .collect();
        println!("the drawn section lacks {missing:?} of {measured} at 1e-2, 1e-3 and 1e-4");
        // Surfaces of bodies of radius one or less are less than 4π.
        for (missing, tolerance) in missing.iter().zip([1e-2, 1e-3, 1e-4]) {
            assert!((0.0..4.0 * PI * tolerance).contains(missing), "{missing}");
        }
        // The error is of the first order in the tolerance: nothing else limits it.
        assert!(missing[2] < 0.03 * missing[0] && missing[2] > 0.001 * missing[0], "{missing:?}");
    }
}

/// A body that is known by its support function alone, against the closed form.
#[derive(Debug)]
struct Plain(Shape<4>);

impl hyperbody_geometry::SupportMap<4> for Plain {
    fn support(&self, direction: Vector<4>) -> Vector<4> {
        match self.0.solids().remove(0) {
            Solid::Curved(body) => body.support(direction),
            Solid::Ball { radius, .. } => direction.normalize_or_zero() * radius,
            _ => Vector::ZERO,
        }
    }
}

#[test]
fn measuring_by_supports_agrees_with_the_closed_forms() {
    use hyperbody_geometry::SupportMap;
    let mut random = Random(300);
    let duocylinder = Shape::<4>::product(vec![ball([0, 1], 0.7), ball([2, 3], 0.4)]).unwrap();
    for (shape, tolerance) in
        [(Shape::ball(0.8).unwrap(), 1e-6), (Shape::capsule(0.5, 0.4, 3).unwrap(), 1e-6), (duocylinder, 1e-5)]
    {
        let normal = random.direction::<4>();
        let expected = shape.section_volume(&SliceFrame::from_normal(normal, 0.2).unwrap(), 1e-9).unwrap();
        let found = Plain(shape).section_volume(normal, 0.2, tolerance);
        assert!((found - expected).abs() < tolerance, "{found} for {expected}");
    }
    let expected = volume::unit_ball(3) * (0.64_f64 - 0.04).powf(1.5);
    let ball = Shape::<4>::ball(0.8).unwrap();
    let frame = SliceFrame::from_normal(random.direction::<4>(), 0.2).unwrap();
    assert!((ball.section_volume(&frame, 1e-9).unwrap() / expected - 1.0).abs() < 1e-14);
}

#[test]
fn what_has_no_volume_is_refused() {
    let frame = SliceFrame::from_normal(Vector::<4>::unit(3), 0.0).unwrap();
    let floor = Shape::<4>::half_space(Vector::unit(1), 0.0).unwrap();
    assert_eq!(floor.section_volume(&frame, 1e-6).unwrap_err().kind(), GeometryErrorKind::Unsupported);
    let ball = Shape::<4>::ball(1.0).unwrap();
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(ball.section_volume(&frame, bad).unwrap_err().kind(), GeometryErrorKind::BadNumber);
    }
    let away = SliceFrame::from_normal(Vector::<4>::unit(3), 5.0).unwrap();
    assert_eq!(ball.section_volume(&away, 1e-6).unwrap(), 0.0);
}
