//! Bodies beside the slice: ghosts, and the strips of the hidden directions.

use std::sync::Arc;

use crate::common::{PIXEL, SIDE, count, cut, differing, far_camera, settings, shadow, turned, world_of};
use hyperbody::geometry::regular;
use hyperbody::geometry::section::SectionPolytope;
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::{BodyDef, Shape, World, WorldDef};
use hyperbody_render::{Bodies, Camera, Image, Settings, Slice, render};

/// The picture with ghosts and the one without.
fn with_and_without<const N: usize>(world: &World<N>, slice: &Slice<N>) -> [Image; 2] {
    [true, false].map(|ghosts| {
        render(&Bodies::of(world), slice, Some(&far_camera()), &Settings { ghosts, ..settings() }, &|_| ()).unwrap()
    })
}

/// How much bluer, and how much greener, the picture is in its middle for the ghost.
fn tint([with, without]: &[Image; 2]) -> [i32; 2] {
    let [a, b] = [with, without].map(|image| image.pixel(SIDE / 2, SIDE / 2).unwrap().map(i32::from));
    let more = [0, 1, 2].map(|part| a[part] - b[part]);
    [more[2] - more[0], more[1] - (more[0] + more[2]) / 2]
}

/// A ball beside the slice is shown by its section through its own middle: a disc of its whole radius around the place where
/// the hidden coordinates leave it.
fn a_ghost_of_a_ball_has_its_whole_radius<const N: usize>() {
    let (radius, slice) = (0.8, Slice::<N>::natural());
    // Along u ghosts are grey, and where the sky is as bright nothing tells them from it.
    for hidden in 3..N.min(5) {
        let mut tints = Vec::new();
        for beside in [0.9, 1.2, -0.9, -1.2] {
            let mut centre = Vector::ZERO;
            (centre[0], centre[1], centre[hidden]) = (0.1, -0.2, beside);
            let world = world_of(Shape::ball(radius).unwrap(), Pose::from_translation(centre));
            let pictures = with_and_without(&world, &slice);
            let pixels = differing(&pictures[0], &pictures[1]);
            let area = count(&pixels) as f64 * PIXEL * PIXEL;
            let exact = std::f64::consts::PI * radius * radius;
            assert!((area / exact - 1.0).abs() < 0.01, "{area} m² instead of {exact} m² in {N}D, {beside} m beside");
            let row = ((2.0 - centre[1]) / PIXEL) as u32;
            let columns: Vec<u32> = (0..SIDE).filter(|x| pixels[(row * SIDE + x) as usize]).collect();
            let [left, right] = [columns[0], columns[columns.len() - 1] + 1].map(|x| f64::from(x) * PIXEL - 2.0);
            assert!((left - (0.1 - radius)).abs() < 1.5 * PIXEL && (right - (0.1 + radius)).abs() < 1.5 * PIXEL);
            tints.push(tint(&pictures));
        }
        // Blue and orange along w, green and pink along v; paler the farther away.
        let tints: Vec<i32> = tints.iter().map(|tint| tint[hidden - 3]).collect();
        assert!(tints[0] > tints[1] && tints[1] > 0 && tints[2] < tints[3] && tints[3] < 0, "{tints:?} in {N}D");
    }
}

#[test]
fn ghosts_of_balls_are_discs() {
    a_ghost_of_a_ball_has_its_whole_radius::<4>();
    a_ghost_of_a_ball_has_its_whole_radius::<5>();
    a_ghost_of_a_ball_has_its_whole_radius::<6>();
}

#[test]
fn a_ghost_of_a_polytope_has_the_section_through_its_middle() {
    let polytope = regular::polytope::<4>("24-cell", regular::Size::Circumradius(1.2)).unwrap();
    let pose = Pose::new(turned(0.8), Vector([0.1, 0.2, 0.0, 0.0]));
    let exact = shadow(&cut(&SectionPolytope::from_polytope(&polytope).placed(&pose)))[0];
    let beside = Pose::new(pose.rotation, pose.translation + Vector::unit(3) * 1.4);
    let world = world_of(Shape::polytope(Arc::new(polytope)).unwrap(), beside);
    let [with, without] = with_and_without(&world, &Slice::natural());
    let area = count(&differing(&with, &without)) as f64 * PIXEL * PIXEL;
    assert!((area / exact - 1.0).abs() < 0.01, "{area} m² instead of {exact} m²");
}

#[test]
fn only_what_is_near_the_slice_has_a_ghost() {
    // A gap of 0.75 radii is the farthest; what the slice cuts is there itself, and three dimensions hide nothing.
    for (beside, is_seen) in [(0.9, true), (1.39, true), (1.41, false), (5.0, false), (0.7, false)] {
        let world = world_of(Shape::<4>::ball(0.8).unwrap(), Pose::from_translation(Vector::unit(3) * beside));
        let [with, without] = with_and_without(&world, &Slice::natural());
        assert_eq!(with != without, is_seen, "{beside} m beside the slice");
    }
    let world = world_of(Shape::<3>::ball(0.8).unwrap(), Pose::IDENTITY);
    let [with, without] = with_and_without(&world, &Slice::natural());
    assert_eq!(with, without);
}

/// Half extent and middle along the hidden direction of three boxes.
const BOXES: [(f64, f64); 3] = [(0.5, 0.1), (0.25, 1.5), (1.0, -2.0)];

/// Boxes at places along a hidden direction, seen by a camera that looks away from them: what it shows is the strip alone.
fn strip_of<const N: usize>(hidden: usize) -> [Image; 2] {
    let mut world = World::<N>::new(WorldDef { gravity: Vector::ZERO, ..WorldDef::default() }).unwrap();
    for (number, (half, middle)) in BOXES.into_iter().enumerate() {
        let half_extents: [f64; N] = std::array::from_fn(|axis| if axis == hidden { half } else { 0.3 });
        let mut place = Vector::unit(0) * (2.0 * number as f64);
        place[hidden] = middle;
        world.add_body(BodyDef::new(Shape::cuboid(half_extents).unwrap()).position(place)).unwrap();
    }
    let camera = Camera {
        eye: Vector([0.0, 0.0, 50.0]),
        target: Vector([0.0, 0.0, 60.0]),
        up: Vector::unit(1),
        field_of_view: 0.6,
    };
    let bodies = Bodies::of(&world).coloured([Some([0.9, 0.05, 0.05]); 3]);
    [true, false].map(|strip| {
        let settings = Settings { width: 640, height: 720, strip, ..settings() };
        render(&bodies, &Slice::natural(), Some(&camera), &settings, &|_| ()).unwrap()
    })
}

/// A bar of a strip: its highest and its lowest row, and the colour in its middle.
struct Bar {
    rows: [u32; 2],
    colour: [i32; 3],
}

/// The bars of the strip in these columns, from the left: where rows differ from what the strip shows beside them.
fn bars(image: &Image, columns: std::ops::Range<u32>) -> Vec<Bar> {
    let pixel = |x: u32, y: u32| image.pixel(x, y).unwrap().map(i32::from);
    let differs = |x: u32, y: u32| {
        let (here, beside) = (pixel(x, y), pixel(columns.start + 6, y));
        (0..3).map(|part| (here[part] - beside[part]).abs()).max().unwrap() > 12
    };
    // Above stands the name of the axis.
    let rows_of = |x: u32| -> Vec<u32> { (60..690).filter(|&y| differs(x, y)).collect() };
    let mut bars: Vec<Bar> = Vec::new();
    let mut was_bar = false;
    for x in columns.start + 6..columns.end - 6 {
        let rows = rows_of(x);
        if let (Some(&top), Some(&bottom), false) = (rows.first(), rows.last(), was_bar) {
            // The first column of a bar may be covered in part: the next one is its own.
            bars.push(Bar { rows: [top, bottom + 1], colour: pixel(x + 3, u32::midpoint(top, bottom) + 8) });
        }
        was_bar = !rows.is_empty();
    }
    bars
}

/// Each strip shows every body over its extent along its direction, by one scale about the slice in the middle.
fn strips_show_extents<const N: usize>() {
    for hidden in 3..N {
        let [with, without] = strip_of::<N>(hidden);
        let pixels = differing(&with, &without);
        let is_taken = |x: u32| (0..720).any(|y| pixels[(y * 640 + x) as usize]);
        // Strips stand from the right edge on, the first hidden direction last.
        let taken: Vec<u32> = (0..640).filter(|&x| is_taken(x)).collect();
        let starts: Vec<u32> = taken.iter().copied().filter(|&x| !taken.contains(&(x.wrapping_sub(1)))).collect();
        assert_eq!(starts.len(), N - 3, "a strip for each hidden direction");
        let start = starts[N - 1 - hidden];
        let end = (start..640).find(|x| !taken.contains(x)).unwrap_or(640);
        let bars = bars(&with, start..end);
        assert_eq!(bars.len(), 3, "a bar for each body");
        // The first one gives the scale.
        let length = |bar: &Bar| f64::from(bar.rows[1] - bar.rows[0]);
        let scale = length(&bars[0]) / (2.0 * BOXES[0].0);
        for (bar, (half, middle)) in bars.iter().zip(BOXES) {
            let rows = [middle + half, middle - half].map(|place| 360.0 - scale * place);
            for (row, exact) in bar.rows.iter().zip(rows) {
                assert!((f64::from(*row) - exact).abs() < 3.5, "row {row} instead of {exact} in {N}D");
            }
        }
        // What is cut has its colour, the others that of their side.
        let [cut, positive, negative] = [0, 1, 2].map(|number: usize| bars[number].colour);
        assert!(cut[0] > 2 * cut[1] && cut[0] > 2 * cut[2], "{cut:?} is red");
        if hidden == 3 {
            assert!(
                positive[2] - positive[0] > negative[2] - negative[0] + 40,
                "{positive:?} is bluer than {negative:?}"
            );
        }
    }
}

#[test]
fn strips_show_where_bodies_are_along_hidden_directions() {
    strips_show_extents::<4>();
    strips_show_extents::<5>();
    strips_show_extents::<6>();
    let [with, without] = strip_of::<3>(2);
    assert_eq!(with, without, "three dimensions hide nothing");
}

#[test]
fn half_spaces_that_hold_the_whole_slice_are_named() {
    let mut world = World::<4>::new(WorldDef::default()).unwrap();
    world.add_body(BodyDef::new(Shape::ball(0.5).unwrap())).unwrap();
    for normal in [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, -1.0]] {
        world.add_body(BodyDef::fixed(Shape::half_space(normal, -3.0).unwrap())).unwrap();
    }
    let bodies = Bodies::of(&world);
    let at = |w: f64| bodies.half_spaces_around(&Slice::natural().moved(Vector::unit(3) * w));
    assert_eq!([at(0.0), at(2.9), at(-2.9)], [const { Vec::<usize>::new() }; 3], "between the walls");
    assert_eq!([at(-3.1), at(3.1)], [vec![2], vec![3]], "within a wall; the floor is across and never holds all");
    let turned = Slice::natural().moved(Vector::unit(3) * 3.1).turned(0, 3, 0.1);
    assert_eq!(bodies.half_spaces_around(&turned), Vec::<usize>::new(), "across the walls");
}
