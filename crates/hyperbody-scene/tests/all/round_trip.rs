//! Scene → text → scene is the same scene, for the gallery and for every key of the format.

use hyperbody::prelude::{CombineRule, Material};
use hyperbody_scene::{
    Angle, AnyWorld, BUILT_IN, Body, BodyKind, Joint, JointKind, JointLimits, JointSpring, NamedMaterial, Part,
    PolytopeSpec, RotationSpec, Scene, ShapeSpec, Size, Turn,
};

fn assert_round_trip(scene: &Scene) {
    let text = scene.to_json();
    let read = Scene::from_json(&text).unwrap_or_else(|error| panic!("{}: {error}\n{text}", scene.name));
    assert_eq!(&read, scene, "{text}");
    assert_eq!(read.to_json(), text, "writing what was read changes the text");
}

#[test]
fn every_built_in_scene_survives() {
    for built_in in &BUILT_IN {
        assert_round_trip(&built_in.scene());
    }
}

/// A scene that uses every key with a value that is not its default.
fn everything() -> Scene {
    let mut scene = Scene::new("every \"key\" — ключ\n", 4);
    scene.description = "What there is.".to_owned();
    scene.gravity = vec![0.1, -1.0 / 3.0, 1e-9, 5e-324];
    scene.dt = 1.0 / 240.0;
    scene.substeps = 7;
    scene.sleeping = false;
    let material = Material { friction: 0.7, restitution: 0.25, density: 1e-3, ..Material::default() };
    let tyre = Material {
        rolling_resistance: 0.01,
        twisting_resistance: 0.02,
        friction_rule: Some(CombineRule::Minimum),
        restitution_rule: Some(CombineRule::Average),
        ..Material::default()
    };
    let named = |name: &str, material| NamedMaterial { name: name.to_owned(), material };
    scene.materials = vec![named("ice", material), named("tyre", tyre)];
    let mut body = Body::new(ShapeSpec::ball(0.5)).named("a").at([1.0, 2.0, 3.0, 4.0]).moving([0.5, 0.0, 0.0, -0.0]);
    body = body.spinning("wx", 1.5).spinning("zw", -0.25).weighing(2.5).made_of("ice").coloured([1.0, 0.5, 0.0]);
    body.kind = BodyKind::Kinematic;
    body.density = Some(3.0);
    (body.groups, body.meets, body.sensor) = (Some(vec![0, 31]), Some(vec![]), true);
    body.one_way = vec![0.0, 1.0, 0.0, 0.0];
    (body.gravity_scale, body.linear_damping, body.angular_damping, body.can_sleep) = (-1.0, 0.1, 0.2, false);
    body.rotation = RotationSpec::Turns(vec![
        Turn { plane: "xw".to_owned(), angle: Angle::Degrees(30.0) },
        Turn { plane: "zy".to_owned(), angle: Angle::Radians(0.1) },
    ]);
    scene.bodies.push(body);
    let mut rows = vec![vec![0.0; 4]; 4];
    for (row, column, value) in [(0, 1, 1.0), (1, 0, -1.0), (2, 2, 1.0), (3, 3, 1.0)] {
        rows[row][column] = value;
    }
    let parts = vec![
        Part::new(ShapeSpec::cube(4, 0.5), Vec::new()),
        Part {
            shape: ShapeSpec::capsule(0.5, 0.25, "w"),
            position: vec![1.0, 0.0, 0.0, 0.0],
            rotation: RotationSpec::Matrix(rows),
        },
    ];
    scene.bodies.push(Body::new(ShapeSpec::Compound { parts }).named("b"));
    let product = ShapeSpec::product([(ShapeSpec::ball(0.5), "xw"), (ShapeSpec::cube(2, 0.2), "zy")]);
    scene.bodies.push(Body::new(product));
    scene.bodies.push(Body::new(ShapeSpec::pyramid(ShapeSpec::ball(0.5), "xzw", 0.75)));
    let mut rotor = vec![0.0; 8];
    rotor[0] = 1.0;
    let mut turned = Body::new(ShapeSpec::regular("24-cell", 0.7));
    turned.rotation = RotationSpec::Rotor(rotor);
    turned.surface_velocity = vec![0.5, 0.0, 0.0, -1.0];
    scene.bodies.push(turned);
    let edge = PolytopeSpec::Regular { name: "{3,3,4}".to_owned(), size: Size::Edge(1.0) };
    scene.bodies.push(Body::new(ShapeSpec::Polytope(edge).rounded(0.1)));
    let corners: Vec<Vec<f64>> =
        (0..5).map(|k| (0..4).map(|axis| f64::from(u8::from(axis + 1 == k))).collect()).collect();
    scene.bodies.push(Body::new(ShapeSpec::Polytope(PolytopeSpec::Vertices(corners))));
    scene.bodies.push(Body::new(ShapeSpec::HalfSpace { normal: vec![0.0, 2.0, 0.0, 0.0], offset: -20.0 }).fixed());
    scene.joints.push(Joint::new(JointKind::Ball, "a", "b").anchored([0.0, 1.0, 0.0, 0.0], []));
    let mut hinge = Joint::with_world(JointKind::Hinge { plane: "wx".to_owned() }, "b").limited_deg(-30.0, 45.0);
    hinge.rotation_a = RotationSpec::Turns(vec![Turn { plane: "xy".to_owned(), angle: Angle::Degrees(30.0) }]);
    hinge.rotation_b = hinge.rotation_a.clone();
    hinge.break_force = Some(1e3);
    hinge.break_torque = Some(1e2);
    hinge.collide = true;
    scene.joints.push(hinge.driven(1.5, 10.0).sprung(0.1, 2.0, 0.7));
    let mut slider = Joint::new(JointKind::Slider { along: "w".to_owned() }, "a", "b");
    slider.limits = Some(JointLimits { range: [-0.5, 0.5], degrees: false });
    slider.spring = Some(JointSpring { target: 0.0, hz: 1.0, damping_ratio: 1.0, max_force: Some(5.0) });
    scene.joints.push(slider);
    let mut rod = Joint::new(JointKind::Distance { length: 2.0 }, "a", "b");
    rod.softness = Some([2.0, 0.5]);
    scene.joints.push(rod);
    scene.joints.push(Joint::new(JointKind::Ball, "a", "b").within_cone_deg("w", 40.0));
    for kind in [JointKind::Weld, JointKind::Axle { keeps: 2 }, JointKind::Rope { length: 1.5 }] {
        scene.joints.push(Joint::new(kind, "a", "b"));
    }
    let wx = || "wx".to_owned();
    for kind in [
        JointKind::Gear { plane: wx(), teeth: [-12, 30] },
        JointKind::Rack { plane: wx(), radius: -0.25 },
        JointKind::Screw { plane: wx(), along: "y".to_owned(), lead: 0.1 },
    ] {
        scene.joints.push(Joint::new(kind, "a", "b").anchored([0.0, 1.0, 0.0, 0.0], []));
    }
    scene.joints.push(Joint::new(JointKind::Motor { plane: "xy".to_owned() }, "a", "b").driven(3.0, 1.0));
    scene
}

#[test]
fn every_key_survives() {
    let scene = everything();
    assert_round_trip(&scene);
    AnyWorld::new(&scene, 1).expect("the scene with every key is a good one");
    let mut with_file = Scene::new("", 3);
    with_file.bodies.push(Body::new(ShapeSpec::Polytope(PolytopeSpec::File("shapes/die.off".to_owned()))));
    with_file.bodies.push(Body::new(ShapeSpec::star("{5/2,5}", 0.5)));
    with_file.bodies.push(Body::new(ShapeSpec::Star { name: "great icosahedron".to_owned(), size: Size::Edge(1.0) }));
    assert_round_trip(&with_file);
}

#[test]
fn defaults_are_those_of_the_format() {
    let short = r#"{"format": "hyperbody-scene", "version": 1, "dimension": 3,
        "bodies": [{"shape": {"ball": {"radius": 1}}}, {"name": "body 2", "shape": {"ball": {"radius": 1}}},
                   {"shape": {"ball": {"radius": 1}}}]}"#;
    let scene = Scene::from_json(short).unwrap();
    assert_eq!(scene.gravity, [0.0, -9.81, 0.0]);
    assert_eq!((scene.dt, scene.substeps, scene.sleeping), (1.0 / 60.0, 4, true));
    assert_eq!(scene.bodies[0], Body::new(ShapeSpec::ball(1.0)));
    assert_eq!(
        scene.body_names(),
        ["body 0", "body 2", "body 2'"],
        "names differ even where a body takes a default one"
    );
}

#[test]
fn angles_in_degrees_and_in_radians_turn_alike() {
    let mut scene = Scene::new("", 4);
    for angle in [Angle::Degrees(90.0), Angle::Radians(std::f64::consts::FRAC_PI_2)] {
        let mut body = Body::new(ShapeSpec::ball(1.0));
        body.rotation = RotationSpec::Turns(vec![Turn { plane: "xw".to_owned(), angle }]);
        scene.bodies.push(body);
    }
    let world = AnyWorld::new(&scene, 1).unwrap();
    let states = world.body_states();
    assert_eq!(states[0].rotation, states[1].rotation);
    // Column x of the matrix is where axis x goes: a quarter turn in xw takes it to w.
    assert!((states[0].rotation[3][0] - 1.0).abs() < 1e-15, "{:?}", states[0].rotation);
}
