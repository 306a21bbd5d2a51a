//! What a picture shows of a body is its exact section.

use std::sync::Arc;

use crate::common::{PIXEL, SIDE, count, covered, cut, far_camera, heap, settings, shadow, turned, world_of};
use hyperbody::geometry::regular;
use hyperbody::geometry::section::SectionPolytope;
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::Shape;
use hyperbody_render::{Bodies, Settings, Slice, frame_bodies, render};

/// A ball of radius r whose centre is d beside the slice shows as a ball of radius √(r² − d²).
fn a_ball_has_its_radius<const N: usize>() {
    let radius = 1.5;
    for beside in [0.0, 0.5, 1.2] {
        let slice = Slice::<N>::new(Pose::new(turned(1.0), Vector::from_fn(|i| 0.3 * i as f64 - 0.5)));
        let centre = Vector::from_fn(|i| match i {
            0 => 0.2,
            1 => -0.1,
            2 => 0.4,
            // Anywhere among the hidden directions, as long as it is so far away.
            _ => beside / ((N - 3) as f64).sqrt(),
        });
        let centre_in_world = slice.pose().transform_point(centre);
        let world = world_of(Shape::ball(radius).unwrap(), Pose::from_translation(centre_in_world));
        let pixels = covered(&world, &slice);
        let section = if N > 3 { (radius * radius - beside * beside).sqrt() } else { radius };
        let row = |y: u32| (0..SIDE).filter(|x| pixels[(y * SIDE + x) as usize]).count() as f64;
        let middle_row = ((2.0 - centre[1]) / PIXEL) as u32;
        let width = row(middle_row).max(row(middle_row - 1));
        assert!(
            (width - 2.0 * section / PIXEL).abs() <= 1.0,
            "{width} pixels wide in {N}D, {beside} m beside the slice"
        );
        let area = pixels.iter().filter(|&&pixel| pixel).count() as f64 * PIXEL * PIXEL;
        let exact = std::f64::consts::PI * section * section;
        assert!((area / exact - 1.0).abs() < 0.01, "an area of {area} m² instead of {exact} m² in {N}D");
    }
    let slice = Slice::<N>::natural();
    let outside = Vector::from_fn(|i| if i == N - 1 { 1.6 } else { 0.0 });
    let world = world_of(Shape::<N>::ball(1.5).unwrap(), Pose::from_translation(outside));
    let seen = covered(&world, &slice).into_iter().filter(|&pixel| pixel).count();
    assert_eq!(seen == 0, N > 3, "a ball that the slice misses is not there");
}

#[test]
fn a_section_of_a_ball_has_the_exact_radius() {
    a_ball_has_its_radius::<3>();
    a_ball_has_its_radius::<4>();
    a_ball_has_its_radius::<5>();
    a_ball_has_its_radius::<6>();
}

/// The picture of a polytope beside the exact section, which is cut from its face lattice, one hidden axis after the other.
fn area_is_exact<const N: usize>(name: &str, offset: f64, section: impl Fn(&SectionPolytope<N>) -> SectionPolytope<3>) {
    let polytope = regular::polytope::<N>(name, regular::Size::Circumradius(1.7)).unwrap();
    let place = Vector::from_fn(|i| [0.1, 0.2, -0.1, offset, -0.5 * offset, 0.3 * offset][i]);
    let slice = Slice::<N>::new(Pose::new(turned(0.8), place));
    let exact = shadow(&section(&SectionPolytope::from_polytope(&polytope).placed(&slice.pose().inverse())))[0];
    let world = world_of(Shape::polytope(Arc::new(polytope)).unwrap(), Pose::IDENTITY);
    let area = count(&covered(&world, &slice)) as f64 * PIXEL * PIXEL;
    assert!(exact > 1.0, "{name} in {N}D: the slice cuts it in {exact} m² only, which proves little");
    assert!((area / exact - 1.0).abs() < 0.01, "{name} in {N}D: {area} m² instead of {exact} m²");
}

#[test]
fn sections_of_polytopes_have_the_exact_area() {
    for (name, offset) in [("8-cell", 0.2), ("24-cell", 0.3), ("16-cell", 0.25), ("5-cell", 0.1), ("120-cell", 0.5)] {
        area_is_exact::<4>(name, offset, cut);
    }
    for (name, offset) in [("cube", 0.2), ("cross-polytope", 0.15), ("simplex", 0.1)] {
        area_is_exact::<5>(name, offset, |polytope| cut(&cut::<5, 4>(polytope)));
        area_is_exact::<6>(name, offset, |polytope| cut(&cut::<5, 4>(&cut::<6, 5>(polytope))));
    }
}

#[test]
fn a_turned_slice_shows_a_box_by_its_diagonal() {
    // Cut by a slice turned by 45° from x to w, a tesseract is a box √2 times as long.
    let world = world_of(Shape::<4>::cuboid([1.0; 4]).unwrap(), Pose::IDENTITY);
    let slice = Slice::<4>::natural().turned(0, 3, std::f64::consts::FRAC_PI_4);
    let pixels = covered(&world, &slice);
    let area = pixels.into_iter().filter(|&pixel| pixel).count() as f64 * PIXEL * PIXEL;
    let exact = 4.0 * 2.0_f64.sqrt();
    assert!((area / exact - 1.0).abs() < 0.01, "{area} m² instead of {exact} m²");
}

fn same_bytes<const N: usize>() {
    let world = heap::<N>();
    let slice = Slice::<N>::natural();
    let camera = frame_bodies(&Bodies::of(&world), &slice, 1.5);
    let draw = |threads| {
        let settings =
            Settings { width: 150, height: 100, caption: vec!["t = 0.5 s".to_owned()], threads, ..Settings::default() };
        render(&Bodies::of(&world), &slice, Some(&camera), &settings, &|_| ()).unwrap()
    };
    let one = draw(1);
    assert_eq!(one, draw(2), "threads change nothing");
    assert_eq!(one, draw(1), "nor does time");
    let colours: std::collections::BTreeSet<&[u8]> = one.bytes().chunks(3).collect();
    assert!(colours.len() > 500, "only {} colours in {N}D", colours.len());
}

#[test]
fn the_same_bytes_with_any_number_of_threads() {
    same_bytes::<2>();
    same_bytes::<3>();
    same_bytes::<4>();
    same_bytes::<5>();
    same_bytes::<6>();
}

#[test]
fn bodies_have_the_colours_that_they_are_given() {
    let world = world_of(Shape::<4>::cuboid([1.5; 4]).unwrap(), Pose::IDENTITY);
    let middle = |colour| {
        let bodies = Bodies::of(&world).coloured([Some(colour)]);
        let image = render(&bodies, &Slice::natural(), Some(&far_camera()), &settings(), &|_| ()).unwrap();
        image.pixel(SIDE / 2, SIDE / 2).unwrap()
    };
    let (first, second) = (middle([1.0, 0.0, 0.0]), middle([0.0, 0.0, 1.0]));
    assert!(first[0] / 2 > first[2] && second[2] / 2 > second[0], "{first:?} should be red and {second:?} blue");
}

#[test]
fn bad_settings_are_refused() {
    let world = heap::<4>();
    let refused = |settings: Settings, word: &str| {
        let error =
            render(&Bodies::of(&world), &Slice::natural(), None, &settings, &|_| ()).expect_err(word).to_string();
        assert!(error.contains(word), "{error}");
    };
    refused(Settings { width: 0, ..settings() }, "width");
    refused(Settings { height: 1 << 20, ..settings() }, "height");
    refused(Settings { light_rays: 0, ..settings() }, "light_rays");
    refused(Settings { edge_samples: 1000, ..settings() }, "edge_samples");
    refused(Settings { threads: 1 << 20, ..settings() }, "threads");
    for field_of_view in [0.0, 4.0, f64::NAN] {
        let mut camera = far_camera();
        camera.field_of_view = field_of_view;
        assert!(render(&Bodies::of(&world), &Slice::natural(), Some(&camera), &settings(), &|_| ()).is_err());
    }
    let mut camera = far_camera();
    camera.eye = camera.target;
    assert!(render(&Bodies::of(&world), &Slice::natural(), Some(&camera), &settings(), &|_| ()).is_err());
}
