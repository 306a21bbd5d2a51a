//! Every named shape falls onto a floor and comes to rest without sinking into it.

use hyperbody_scene::{
    Angle, AnyWorld, Body, BodyKind, Factor, Part, PolytopeSpec, RotationSpec, Scene, ShapeSpec, Turn,
};

/// Seconds until everything has to be at rest.
const SECONDS: f64 = 20.0;

fn duoprism(first: &str, second: &str) -> ShapeSpec {
    ShapeSpec::product([(ShapeSpec::regular(first, 0.6), "xy"), (ShapeSpec::regular(second, 0.6), "zw")])
}

fn star(name: &str) -> ShapeSpec {
    ShapeSpec::star(name, 0.6)
}

/// A pyramid or cone that stands along y.
fn cone(base: ShapeSpec, axes: &str) -> ShapeSpec {
    ShapeSpec::pyramid(base, axes, 0.8)
}

fn shapes(dimension: usize) -> Vec<ShapeSpec> {
    let mut shapes = vec![ShapeSpec::ball(0.5), ShapeSpec::cube(dimension, 0.5), ShapeSpec::capsule(0.4, 0.3, "x")];
    shapes.push(ShapeSpec::cube(dimension, 0.4).rounded(0.1));
    let corner = |sign: f64| (0..dimension).map(|axis| if axis == 0 { sign * 0.4 } else { 0.0 }).collect::<Vec<f64>>();
    let parts = [1.0, -1.0].map(|sign| Part::new(ShapeSpec::cube(dimension, 0.3), corner(sign))).to_vec();
    shapes.push(ShapeSpec::Compound { parts });
    shapes.extend(["simplex", "cross-polytope"].map(|name| ShapeSpec::regular(name, 0.6)));
    match dimension {
        2 => {
            shapes.extend(["pentagon", "7-gon"].map(|name| ShapeSpec::regular(name, 0.6)));
            shapes.push(star("{5/2}"));
        }
        3 => {
            shapes.extend(["dodecahedron", "icosahedron"].map(|name| ShapeSpec::regular(name, 0.6)));
            shapes.push(ShapeSpec::product([(ShapeSpec::ball(0.5), "xz"), (ShapeSpec::cube(1, 0.4), "y")]));
            shapes.push(cone(ShapeSpec::ball(0.5), "xz"));
            shapes.push(cone(ShapeSpec::regular("pentagon", 0.6), "xz"));
            shapes.extend(["{5/2,5}", "{5,5/2}", "{5/2,3}", "{3,5/2}"].map(star));
        }
        4 => {
            shapes.extend(["24-cell", "120-cell", "600-cell"].map(|name| ShapeSpec::regular(name, 0.6)));
            shapes.push(ShapeSpec::regular("24-cell", 0.5).rounded(0.1));
            shapes.push(duoprism("triangle", "6-gon"));
            // Duocylinder, spherinder and cubinder.
            shapes.push(ShapeSpec::product([(ShapeSpec::ball(0.5), "xz"), (ShapeSpec::ball(0.4), "yw")]));
            shapes.push(ShapeSpec::product([(ShapeSpec::ball(0.5), "xyz"), (ShapeSpec::cube(1, 0.4), "w")]));
            shapes.push(ShapeSpec::product([(ShapeSpec::ball(0.5), "xw"), (ShapeSpec::cube(2, 0.4), "yz")]));
            shapes
                .push(ShapeSpec::product([(ShapeSpec::capsule(0.3, 0.3, "x"), "xyz"), (ShapeSpec::cube(1, 0.4), "w")]));
            // Over a ball, a capsule and a cube.
            shapes.push(cone(ShapeSpec::ball(0.5), "xzw"));
            shapes.push(cone(ShapeSpec::capsule(0.2, 0.4, "x"), "xzw"));
            shapes.push(cone(ShapeSpec::cube(3, 0.4), "xzw"));
            let points =
                [[0.0; 4], [0.8, 0.1, 0.0, 0.2], [0.0, 0.9, 0.1, 0.0], [0.1, 0.0, 0.7, 0.1], [0.0, 0.2, 0.1, 0.8]];
            shapes.push(ShapeSpec::Polytope(PolytopeSpec::Vertices(
                points.map(|p| p.map(|c| c - 0.2).to_vec()).to_vec(),
            )));
        }
        5 => {
            shapes.push(ShapeSpec::product([(ShapeSpec::cube(3, 0.4), "xyz"), (ShapeSpec::ball(0.5), "wv")]));
            shapes.push(cone(ShapeSpec::ball(0.5), "xzwv"));
        }
        6 => shapes.push(ShapeSpec::product([(ShapeSpec::cube(4, 0.4), "xyzw"), (ShapeSpec::cube(2, 0.5), "vu")])),
        _ => {}
    }
    shapes
}

fn is_capsule(factor: &Factor) -> bool {
    matches!(factor.shape, ShapeSpec::Capsule { .. })
}

fn every_shape_rests(dimension: usize) {
    let mut scene = Scene::new("shapes", dimension);
    let up: Vec<f64> = (0..dimension).map(|axis| if axis == 1 { 1.0 } else { 0.0 }).collect();
    let mut floor = Body::new(ShapeSpec::HalfSpace { normal: up, offset: 0.0 });
    floor.kind = BodyKind::Static;
    scene.bodies.push(floor);
    let shapes = shapes(dimension);
    for (index, shape) in shapes.iter().enumerate() {
        let place: Vec<f64> =
            (0..dimension).map(|axis| [10.0 * index as f64, 1.2].get(axis).copied().unwrap_or(0.0)).collect();
        let rocks = matches!(shape, ShapeSpec::Product { factors } if factors.iter().any(is_capsule));
        let name = format!("{index} {}{}", if rocks { "rocking " } else { "" }, shape.key());
        let mut body = Body::new(shape.clone()).named(name).at(place);
        // Rolling has no resistance of its own.
        (body.angular_damping, body.linear_damping) = (2.0, 1.0);
        let planes = ["xy", "yz", "yw", "yv", "yu"][..dimension - 1].iter();
        let turn = |(k, plane): (usize, &&str)| Turn {
            plane: (*plane).to_owned(),
            angle: Angle::Degrees(10.0 + 7.0 * k as f64),
        };
        body.rotation = RotationSpec::Turns(planes.enumerate().map(turn).collect());
        scene.bodies.push(body);
    }
    let mut world = AnyWorld::new(&scene, 1).expect("every shape can be built");
    while world.time() < SECONDS {
        world.step();
    }
    let penetration = world.measure_penetration();
    println!("{dimension}D: {} shapes at rest, deepest overlap {penetration:.1e} m", shapes.len());
    assert!(penetration < 0.02, "{dimension}D: something has sunk by {penetration}");
    assert_eq!(world.quarantined(), Vec::<&str>::new());
    for (body, name) in world.body_states().iter().zip(world.body_names()) {
        let speed = body.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        // Capsules as factors rock on the facets that contacts see of them: a limit that ARCHITECTURE.md states.
        let limit = if name.contains("rocking") { 0.1 } else { 0.01 };
        assert!(body.sleeping || speed < limit, "{dimension}D: \"{name}\" still moves at {speed} m/s");
        let height = body.position[1];
        assert!(
            name.starts_with("body") || (0.05..1.0).contains(&height),
            "{dimension}D: \"{name}\" is at height {height}"
        );
    }
}

#[test]
fn every_named_shape_comes_to_rest_on_a_floor() {
    for dimension in 2..=6 {
        every_shape_rests(dimension);
    }
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
