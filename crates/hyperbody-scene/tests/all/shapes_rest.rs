//! Every named shape falls onto a floor and comes to rest without sinking into it.

use hyperbody::geometry::OffFile;
use hyperbody::geometry::regular::{Size, names, polytope};
use hyperbody_scene::{
    Angle, AnyWorld, Body, BodyKind, Factor, Part, PolytopeSpec, RotationSpec, Scene, ShapeSpec, Turn,
};

/// Seconds until everything has to be at rest.
const SECONDS: f64 = 20.0;

/// How deep a body at rest may stand in the floor, m.
const DEEPEST: f64 = 0.02;

/// A file beside the scenes, whatever its shape.
const FILE: &str = "mesh.off";

/// A shape, what it is called here, and the text of the file that it names.
struct Named {
    name: String,
    shape: ShapeSpec,
    file: Option<String>,
}

fn named(name: impl Into<String>, shape: ShapeSpec) -> Named {
    Named { name: name.into(), shape, file: None }
}

fn mesh(name: &str, text: impl Into<String>) -> Named {
    Named { name: name.to_owned(), shape: ShapeSpec::Mesh { file: FILE.to_owned() }, file: Some(text.into()) }
}

fn stars(symbols: &[&str]) -> Vec<Named> {
    symbols.iter().map(|symbol| named(format!("star {symbol}"), ShapeSpec::star(symbol, 0.6))).collect()
}

fn disc(radius: f64, axes: &'static str) -> (ShapeSpec, &'static str) {
    (ShapeSpec::ball(radius), axes)
}

fn flat(dimension: usize, axes: &'static str) -> (ShapeSpec, &'static str) {
    (ShapeSpec::cube(dimension, 0.4), axes)
}

fn polygon(name: &str, axes: &'static str) -> (ShapeSpec, &'static str) {
    (ShapeSpec::regular(name, 0.6), axes)
}

/// A pyramid or cone that stands along y.
fn cone(base: ShapeSpec, axes: &str) -> ShapeSpec {
    ShapeSpec::pyramid(base, axes, 0.8)
}

/// What there is in every dimension.
fn common<const N: usize>() -> Vec<Named> {
    let corner = |sign: f64| (0..N).map(|axis| if axis == 0 { sign * 0.4 } else { 0.0 }).collect::<Vec<f64>>();
    let parts = [1.0, -1.0].map(|sign| Part::new(ShapeSpec::cube(N, 0.3), corner(sign))).to_vec();
    let points = (0..=N).map(|k| {
        (0..N).map(|axis| if axis + 1 == k { 0.6 } else { -0.2 } + 0.05 * ((3 * k + axis) % 4) as f64).collect()
    });
    let cube = polytope::<N>("hypercube", Size::Edge(0.7)).expect("a cube");
    let mut shapes = vec![
        named("ball", ShapeSpec::ball(0.5)),
        named("box", ShapeSpec::cube(N, 0.5)),
        named("capsule", ShapeSpec::capsule(0.4, 0.3, "x")),
        named("rounded box", ShapeSpec::cube(N, 0.4).rounded(0.1)),
        named("rounded simplex", ShapeSpec::regular("simplex", 0.5).rounded(0.1)),
        named("rounded cross-polytope", ShapeSpec::regular("cross-polytope", 0.5).rounded(0.1)),
        named("compound of two boxes", ShapeSpec::Compound { parts }),
        named("hull of points", ShapeSpec::Polytope(PolytopeSpec::Vertices(points.collect()))),
        mesh("mesh of a cube", OffFile::from_polytope(&cube).to_string()),
    ];
    let regular = names(N).into_iter().chain(["simplex", "cube", "cross-polytope"]);
    shapes.extend(regular.map(|name| named(name, ShapeSpec::regular(name, 0.6))));
    shapes
}

fn of_2d() -> Vec<Named> {
    let mut shapes = stars(&["{5/2}", "{7/2}", "{7/3}", "{8/3}"]);
    shapes.push(named("40-gon", ShapeSpec::regular("40-gon", 0.6)));
    shapes.push(mesh("mesh of an arrow", "2OFF\n4 1 4\n0.6 -0.4\n0 0.7\n-0.6 -0.4\n0 -0.1\n4 0 1 2 3\n"));
    shapes
}

fn of_3d() -> Vec<Named> {
    let mut shapes = stars(&["{5/2,5}", "{5,5/2}", "{5/2,3}", "{3,5/2}"]);
    // A pyramid with a pyramid cut out of its base.
    let dented = "OFF\n5 6 9\n0.6 -0.3 0\n-0.3 -0.3 0.5\n-0.3 -0.3 -0.5\n0 0.6 0\n0 0 0\n\
                  3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 1\n3 1 4 2\n3 2 4 0\n";
    shapes.extend([
        named("rounded dodecahedron", ShapeSpec::regular("dodecahedron", 0.5).rounded(0.1)),
        named("cylinder", ShapeSpec::product([disc(0.5, "xz"), flat(1, "y")])),
        named("pentagonal prism", ShapeSpec::product([polygon("pentagon", "xz"), flat(1, "y")])),
        named("product of a capsule and a segment", ShapeSpec::product([capsule("xy"), flat(1, "z")])),
        named("prism over a star", ShapeSpec::product([(ShapeSpec::star("{5/2}", 0.6), "xz"), flat(1, "y")])),
        named("pyramid over a star", cone(ShapeSpec::star("{5/2}", 0.6), "xz")),
        named("cone", cone(ShapeSpec::ball(0.5), "xz")),
        named("pyramid", cone(ShapeSpec::regular("pentagon", 0.6), "xz")),
        mesh("mesh of a dented pyramid", dented),
    ]);
    shapes
}

fn capsule(axes: &'static str) -> (ShapeSpec, &'static str) {
    (ShapeSpec::capsule(0.3, 0.3, "x"), axes)
}

fn of_4d() -> Vec<Named> {
    let mut shapes = stars(&["{5/2,5,3}", "{5/2,3,5}"]);
    shapes.extend([
        named("rounded 24-cell", ShapeSpec::regular("24-cell", 0.5).rounded(0.1)),
        named("duoprism", ShapeSpec::product([polygon("triangle", "xy"), polygon("6-gon", "zw")])),
        named("duocylinder", ShapeSpec::product([disc(0.5, "xz"), disc(0.4, "yw")])),
        named("star duoprism", ShapeSpec::product([(ShapeSpec::star("{5/2}", 0.6), "xz"), polygon("triangle", "yw")])),
        named(
            "product of a star and a disc",
            ShapeSpec::product([(ShapeSpec::star("{5/2}", 0.6), "xz"), disc(0.5, "yw")]),
        ),
        named("spherinder", ShapeSpec::product([disc(0.5, "xyz"), flat(1, "w")])),
        named("cubinder", ShapeSpec::product([disc(0.5, "xw"), flat(2, "yz")])),
        named("product of a capsule and a segment", ShapeSpec::product([capsule("xyz"), flat(1, "w")])),
        named("cone over a ball", cone(ShapeSpec::ball(0.5), "xzw")),
        named("cone over a capsule", cone(ShapeSpec::capsule(0.2, 0.4, "x"), "xzw")),
        named("pyramid over a cube", cone(ShapeSpec::cube(3, 0.4), "xzw")),
        mesh("mesh of a channel", crate::mesh_bodies::channel_4d()),
    ]);
    shapes
}

fn of_5d() -> Vec<Named> {
    vec![
        named("product of a disc and a cube", ShapeSpec::product([flat(3, "xyz"), disc(0.5, "wv")])),
        named("product of a ball and a square", ShapeSpec::product([disc(0.5, "xyz"), flat(2, "wv")])),
        named("product of a disc and a ball", ShapeSpec::product([disc(0.5, "xyz"), disc(0.5, "wv")])),
        named("product of polygons and a segment", {
            ShapeSpec::product([polygon("triangle", "xy"), polygon("pentagon", "zw"), flat(1, "v")])
        }),
        named("cone over a ball", cone(ShapeSpec::ball(0.5), "xzwv")),
        named("pyramid over a 24-cell", cone(ShapeSpec::regular("24-cell", 0.6), "xzwv")),
    ]
}

fn of_6d() -> Vec<Named> {
    vec![
        named("product of a tesseract and a square", ShapeSpec::product([flat(4, "xyzw"), flat(2, "vu")])),
        named("product of a disc and a tesseract", ShapeSpec::product([disc(0.5, "xy"), flat(4, "zwvu")])),
        named("product of a ball and a cube", ShapeSpec::product([disc(0.5, "xyz"), flat(3, "wvu")])),
        named("product of three discs", ShapeSpec::product([disc(0.5, "xy"), disc(0.5, "zw"), disc(0.5, "vu")])),
        named("product of two balls", ShapeSpec::product([disc(0.5, "xyz"), disc(0.5, "wvu")])),
        named("pyramid over a simplex", cone(ShapeSpec::regular("simplex", 0.6), "xzwvu")),
    ]
}

/// Rolling has no resistance of its own, and capsules as factors rock on the facets that contacts see of them: a limit that
/// ARCHITECTURE.md states.
fn speed_at_rest(shape: &ShapeSpec) -> f64 {
    let capsule = |factor: &Factor| matches!(factor.shape, ShapeSpec::Capsule { .. });
    if matches!(shape, ShapeSpec::Product { factors } if factors.iter().any(capsule)) { 0.1 } else { 0.01 }
}

fn falling(dimension: usize, what: &Named) -> AnyWorld {
    let mut scene = Scene::new(&what.name, dimension);
    scene.files.extend(what.file.iter().map(|text| (FILE.to_owned(), text.clone())));
    let upright = |height: f64| (0..dimension).map(|axis| if axis == 1 { height } else { 0.0 }).collect::<Vec<f64>>();
    let mut floor = Body::new(ShapeSpec::HalfSpace { normal: upright(1.0), offset: 0.0 });
    floor.kind = BodyKind::Static;
    let mut body = Body::new(what.shape.clone()).at(upright(1.2));
    (body.angular_damping, body.linear_damping) = (2.0, 1.0);
    let planes = ["xy", "yz", "yw", "yv", "yu"][..dimension - 1].iter();
    let turn =
        |(k, plane): (usize, &&str)| Turn { plane: (*plane).to_owned(), angle: Angle::Degrees(10.0 + 7.0 * k as f64) };
    body.rotation = RotationSpec::Turns(planes.enumerate().map(turn).collect());
    scene.bodies = vec![floor, body];
    AnyWorld::new(&scene, 1).unwrap_or_else(|error| panic!("{dimension}D {}: {error}", what.name))
}

/// Where each comes to rest, one line each.
fn every_shape_rests(dimension: usize, shapes: &[Named]) {
    let mut deepest: f64 = 0.0;
    for what in shapes {
        let mut world = falling(dimension, what);
        while world.time() < SECONDS {
            world.step();
        }
        let penetration = world.measure_penetration();
        let body = &world.body_states()[1];
        let speed = body.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        let name = format!("{dimension}D {}", what.name);
        println!("{name:<44} overlap {penetration:.1e} m, {speed:.0e} m/s");
        assert!(penetration < DEEPEST, "{name} has sunk by {penetration}");
        assert_eq!(world.quarantined(), Vec::<&str>::new());
        assert!(body.sleeping || speed < speed_at_rest(&what.shape), "{name} still moves at {speed} m/s");
        // The origin of a mesh may be one of its corners.
        let height = body.position[1];
        assert!((-DEEPEST..1.0).contains(&height), "{name} is at height {height}");
        deepest = deepest.max(penetration);
    }
    println!("{dimension}D: {} shapes at rest, deepest overlap {deepest:.1e} m", shapes.len());
}

fn both(mut common: Vec<Named>, own: Vec<Named>) -> Vec<Named> {
    common.extend(own);
    common
}

#[test]
fn every_named_shape_comes_to_rest_on_a_floor() {
    every_shape_rests(2, &both(common::<2>(), of_2d()));
    every_shape_rests(3, &both(common::<3>(), of_3d()));
    every_shape_rests(4, &both(common::<4>(), of_4d()));
    every_shape_rests(5, &both(common::<5>(), of_5d()));
    every_shape_rests(6, &both(common::<6>(), of_6d()));
}

/// Bodies of hundreds to tens of thousands of cells.
#[test]
fn large_star_polychora_come_to_rest_on_a_floor() {
    every_shape_rests(4, &stars(&["{5,5/2,5}", "{3,5,5/2}", "{3,5/2,5}", "{5/2,5,5/2}"]));
    every_shape_rests(4, &stars(&["{5/2,3,3}", "{5,5/2,3}", "{5,3,5/2}", "{3,3,5/2}"]));
}

/// On a slope of angle θ a body that rolls in one plane, with the moment I = m·k² in it, gains g sin θ / (1 + k²/r²): a cylinder
/// across its axis k² = r²/2, a spherinder k² = 2r²/5 of its ball, whatever else there is of it. A faceted body would stop or
/// stumble on a slope of a few degrees: 32 sides hold a cylinder up to 5.6°.
fn curved_products_roll(dimension: usize, shape: ShapeSpec, radius: f64, k_sq: f64) {
    let mut scene = Scene::new("rolling", dimension);
    let (sin, cos) = 3.0_f64.to_radians().sin_cos();
    let point = |x: f64, y: f64| (0..dimension).map(|i| [x, y].get(i).copied().unwrap_or(0.0)).collect::<Vec<f64>>();
    let mut slope = Body::new(ShapeSpec::HalfSpace { normal: point(sin, cos), offset: 0.0 });
    slope.kind = BodyKind::Static;
    scene.bodies.push(slope);
    scene.bodies.push(Body::new(shape).at(point(radius * sin, radius * cos)));
    let mut world = AnyWorld::new(&scene, 1).expect("the product can be built");
    while world.time() < 2.0 {
        world.step();
    }
    let velocity = &world.body_states()[1].velocity;
    let along = velocity[0] * cos - velocity[1] * sin;
    let expected = 9.81 * sin / (1.0 + k_sq / (radius * radius)) * world.time();
    println!("{dimension}D: {along} m/s down the slope, {expected} expected");
    assert!((along / expected - 1.0).abs() < 0.01, "{dimension}D: {along} m/s, expected {expected}");
}

#[test]
fn curved_products_roll_as_their_moments_say() {
    let (radius, half) = (0.5, 0.4);
    let disc = |axes| (ShapeSpec::ball(radius), axes);
    let flat = |size, axes| (ShapeSpec::cube(size, half), axes);
    curved_products_roll(3, ShapeSpec::product([disc("xy"), flat(1, "z")]), radius, 0.5 * radius * radius);
    curved_products_roll(4, ShapeSpec::product([disc("xy"), flat(2, "zw")]), radius, 0.5 * radius * radius);
    curved_products_roll(4, ShapeSpec::product([disc("xyz"), flat(1, "w")]), radius, 0.4 * radius * radius);
    curved_products_roll(
        4,
        ShapeSpec::product([disc("xy"), (ShapeSpec::ball(half), "zw")]),
        radius,
        0.5 * radius * radius,
    );
}
