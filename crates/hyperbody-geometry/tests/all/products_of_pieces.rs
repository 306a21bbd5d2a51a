//! Products and pyramids over stars and other shapes of several pieces, against closed forms and compounds made by hand.

use std::f64::consts::PI;

use crate::common::Random;
use crate::section_volumes::integrated;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::Size;
use hyperbody_geometry::{GeometryErrorKind, MassProperties, Shape, SliceFrame, star};
use hyperbody_math::{Pose, Rotation, Vector};

pub(crate) fn star_shape<const N: usize>(symbol: &str) -> Shape<N> {
    let cells = star::cells::<N>(&star::symbol(symbol).unwrap(), Size::Circumradius(1.0), 100).unwrap();
    Shape::compound(cells.into_iter().map(|cell| (Pose::IDENTITY, Shape::polytope(cell.into()).unwrap())).collect())
        .unwrap()
}

/// Ten triangles from the centre to corners at distances 1 and 1/φ² by turns, 36° apart.
fn area_of_pentagram() -> f64 {
    let inner = (3.0 - 5.0_f64.sqrt()) / 2.0;
    5.0 * inner * (PI / 5.0).sin()
}

fn piece_count<const N: usize>(shape: &Shape<N>) -> usize {
    shape.pieces().len()
}

#[test]
fn products_of_stars_weigh_the_product_of_their_areas() {
    let star = star_shape::<2>("{5/2}");
    let own = star.mass_properties(1.0).unwrap();
    let area = area_of_pentagram();
    assert!((own.mass / area - 1.0).abs() < 1e-12, "{} for {area}", own.mass);
    let factor = |axes: [usize; 2]| Factor::new(axes, &star).unwrap();
    let duoprism = Shape::<4>::product(vec![factor([0, 2]), factor([3, 1])]).unwrap();
    assert_eq!(piece_count(&duoprism), piece_count(&star) * piece_count(&star));
    let mass = duoprism.mass_properties(1.0).unwrap();
    assert!((mass.mass / (area * area) - 1.0).abs() < 1e-12, "{}", mass.mass);
    // All directions of a plane are alike for five corners: half the polar moment each, times the other area.
    let moment = own.second_moments[0][0] * area;
    for axis in 0..4 {
        assert!((mass.second_moments[axis][axis] / moment - 1.0).abs() < 1e-12);
    }
    assert!(mass.centre.norm() < 1e-13);
    let oblique = Vector([0.5, -0.7, 0.4, 0.3]).normalize_or_zero();
    assert!((integrated(&duoprism, oblique, 1e-7) / (area * area) - 1.0).abs() < 1e-7);
    // A prism of five dimensions over a star of three, and one with a curved factor.
    let solid = star_shape::<3>("{5/2,5}");
    let content = solid.mass_properties(1.0).unwrap().mass;
    let parts = vec![Factor::new([0, 1, 2], &solid).unwrap(), factor([3, 4])];
    let mass = Shape::<5>::product(parts).unwrap().mass_properties(1.0).unwrap().mass;
    assert!((mass / (content * area) - 1.0).abs() < 1e-12);
    let disc = Factor::new([2, 3], &Shape::<2>::ball(0.7).unwrap()).unwrap();
    let round = Shape::<4>::product(vec![factor([0, 1]), disc]).unwrap();
    assert_eq!(piece_count(&round), piece_count(&star));
    assert!((round.mass_properties(1.0).unwrap().mass / (area * PI * 0.49) - 1.0).abs() < 1e-12);
    let across = SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.3).unwrap();
    let chord = 2.0 * (0.49_f64 - 0.09).sqrt();
    assert!((round.section_volume(&across, 1e-9).unwrap() / (area * chord) - 1.0).abs() < 1e-7);
}

/// Parts of a factor that are turned and moved stand so in the product.
#[test]
fn parts_of_factors_keep_their_places() {
    let mut random = Random(77);
    let parts: Vec<(f64, Vector<2>, Shape<2>)> = vec![
        (0.4, Vector([1.0, 0.2]), Shape::cuboid([0.5, 0.2]).unwrap()),
        (-1.1, Vector([-0.7, 0.5]), Shape::capsule(0.3, 0.1, 1).unwrap()),
        (2.0, Vector([0.0, -1.0]), Shape::ball(0.3).unwrap()),
    ];
    let flat = parts.iter().map(|(angle, at, shape)| (Pose::new(Rotation::in_plane(0, 1, *angle), *at), shape.clone()));
    let flat = Shape::compound(flat.collect()).unwrap();
    // The factor's axes are y and x: counterclockwise there is clockwise here.
    let prism =
        Shape::<3>::product(vec![Factor::new([1, 0], &flat).unwrap(), Factor::segment(2, 0.4).unwrap()]).unwrap();
    let by_hand = parts.iter().map(|(angle, at, shape)| {
        let own = vec![Factor::new([1, 0], shape).unwrap(), Factor::segment(2, 0.4).unwrap()];
        let pose = Pose::new(Rotation::in_plane(1, 0, *angle), Vector([at[1], at[0], 0.0]));
        (pose, Shape::<3>::product(own).unwrap())
    });
    let by_hand = Shape::compound(by_hand.collect()).unwrap();
    assert_same(&prism, &by_hand);
    for _ in 0..20 {
        let frame = SliceFrame::from_normal(random.direction::<3>(), random.symmetric()).unwrap();
        let [found, expected] = [&prism, &by_hand].map(|shape| shape.section_volume(&frame, 1e-9).unwrap());
        assert!((found - expected).abs() < 1e-8, "{found} for {expected}");
    }
}

fn assert_same<const N: usize>(found: &Shape<N>, expected: &Shape<N>) {
    let [found, expected]: [MassProperties<N>; 2] = [found, expected].map(|shape| shape.mass_properties(1.0).unwrap());
    assert!((found.mass / expected.mass - 1.0).abs() < 1e-12, "{} for {}", found.mass, expected.mass);
    assert!((found.centre - expected.centre).norm() < 1e-12);
    assert!((found.second_moments - expected.second_moments).max_abs() < 1e-12);
}

#[test]
fn pyramids_stand_over_stars_and_compounds() {
    let star = star_shape::<2>("{5/2}");
    let height = 0.8;
    let pyramid = Shape::<3>::pyramid(Factor::new([0, 1], &star).unwrap(), height).unwrap();
    let mass = pyramid.mass_properties(1.0).unwrap();
    assert!((mass.mass / (area_of_pentagram() * height / 3.0) - 1.0).abs() < 1e-12);
    assert!((mass.centre - Vector::unit(2) * (-0.25 * height)).norm() < 1e-12);
    // A box beside the origin: its pyramid leans towards the apex over the origin, and what counts is its area.
    let beside = |shape: Shape<3>| {
        let pose = Pose::new(Rotation::in_plane(0, 2, 0.3), Vector([1.0, 0.5, 0.0]));
        Factor::new([0, 1, 3], &Shape::compound(vec![(pose, shape)]).unwrap()).unwrap()
    };
    let leaning = Shape::<4>::pyramid(beside(Shape::cuboid([0.2, 0.3, 0.4]).unwrap()), height).unwrap();
    let mass = leaning.mass_properties(1.0).unwrap();
    assert!((mass.mass / (8.0 * 0.2 * 0.3 * 0.4 * height / 4.0) - 1.0).abs() < 1e-12);
    assert!((mass.centre - Vector([0.8, 0.4, -0.3 * height, 0.0])).norm() < 1e-12, "{:?}", mass.centre);
    let error = Shape::<4>::pyramid(beside(Shape::ball(0.2).unwrap()), height).unwrap_err();
    assert_eq!(error.kind(), GeometryErrorKind::Unsupported);
    assert!(error.to_string().contains("beside the origin"), "{error}");
}

#[test]
fn too_many_pieces_are_refused_before_they_are_made() {
    let square = Shape::<2>::cuboid([0.1, 0.1]).unwrap();
    let many = |count: usize| (0..count).map(|k| (Pose::from_translation(Vector([k as f64, 0.0])), square.clone()));
    let factor = |axes: [usize; 2]| Factor::new(axes, &Shape::compound(many(300).collect()).unwrap()).unwrap();
    let error = Shape::<4>::product(vec![factor([0, 1]), factor([2, 3])]).unwrap_err();
    assert!(error.to_string().contains("would have 90000"), "{error}");
}
