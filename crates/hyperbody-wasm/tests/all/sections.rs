//! What is drawn, against closed forms.

use hyperbody_wasm::Playground;
use serde_json::{Value, json};

use crate::{answer, ask, refusal, with_bodies};

/// Volume inside the triangles (divergence theorem).
fn volume(positions: &[f32]) -> f64 {
    let corner = |p: &[f32]| [f64::from(p[0]), f64::from(p[1]), f64::from(p[2])];
    let of_triangle = |t: &[f32]| {
        let (a, b, c) = (corner(&t[0..3]), corner(&t[3..6]), corner(&t[6..9]));
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0
    };
    positions.chunks_exact(9).map(of_triangle).sum()
}

fn slice(dimension: usize, last: f64, drawn: usize) -> Value {
    let unit = |k: usize| (0..dimension).map(|i| if i == k { 1.0 } else { 0.0 }).collect::<Vec<_>>();
    let mut origin = vec![0.0; dimension];
    if dimension > drawn {
        origin[dimension - 1] = last;
    }
    json!({ "type": "slice", "origin": origin, "axes": (0..drawn).map(unit).collect::<Vec<_>>() })
}

fn one_body(dimension: usize, shape: Value) -> Playground {
    with_bodies(dimension, json!([{ "shape": shape }]))
}

fn drawn_volume(playground: &mut Playground) -> f64 {
    playground.draw();
    volume(&playground.buffers().surface_positions)
}

#[test]
fn boxes_are_cut_exactly_in_every_dimension() {
    for dimension in 3..=6 {
        let half: Vec<f64> = (0..dimension).map(|i| 0.5 + 0.1 * i as f64).collect();
        let mut playground = one_body(dimension, json!({ "box": { "half_extents": half } }));
        let expected = 8.0 * half[0] * half[1] * half[2];
        let found = drawn_volume(&mut playground);
        assert!((found - expected).abs() < 1e-5 * expected, "{dimension}D: {found} instead of {expected}");
        assert_eq!(playground.buffers().edge_positions.len(), 12 * 6, "a box has twelve edges");
        // Beyond the last half-extent nothing is left.
        if dimension > 3 {
            ask(&mut playground, slice(dimension, half[dimension - 1] + 0.01, 3));
            assert_eq!(drawn_volume(&mut playground), 0.0);
        }
    }
}

#[test]
fn a_tesseract_across_its_diagonal_is_an_octahedron() {
    let mut playground = one_body(4, json!({ "box": { "half_extents": [0.5, 0.5, 0.5, 0.5] } }));
    let h = 0.5;
    let axes = [[h, h, -h, -h], [h, -h, h, -h], [h, -h, -h, h]];
    ask(&mut playground, json!({ "type": "slice", "origin": [0, 0, 0, 0], "axes": axes }));
    // Volume of the middle section of the unit tesseract across (1,1,1,1): 4/3 (G. Pólya's formula for cube sections).
    let found = drawn_volume(&mut playground);
    assert!((found - 4.0 / 3.0).abs() < 1e-5, "{found}");
    assert_eq!(playground.buffers().surface_cells.len(), 8 * 3, "eight triangles");
}

#[test]
fn round_bodies_are_cut_where_closed_forms_say() {
    let pi = std::f64::consts::PI;
    for dimension in 4..=6 {
        let mut playground = one_body(dimension, json!({ "ball": { "radius": 1.0 } }));
        ask(&mut playground, slice(dimension, 0.6, 3));
        let expected = 4.0 / 3.0 * pi * 0.8_f64.powi(3);
        let found = drawn_volume(&mut playground);
        // The triangles lie inside of the ball.
        assert!(found < expected && found > 0.98 * expected, "ball in {dimension}D: {found} of {expected}");

        let capsule = json!({ "capsule": { "half_length": 0.7, "radius": 0.5, "along": "y" } });
        let mut playground = one_body(dimension, capsule);
        ask(&mut playground, slice(dimension, 0.3, 3));
        // Across its axis: a capsule of radius 0.4.
        let expected = pi * 0.16 * 1.4 + 4.0 / 3.0 * pi * 0.064;
        let found = drawn_volume(&mut playground);
        assert!(found < expected && found > 0.97 * expected, "capsule in {dimension}D: {found} of {expected}");
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

/// A triangle with the normals of its corners, and the direction it faces, as long as twice its area.
struct Triangle {
    corners: [[f64; 3]; 3],
    normals: [[f64; 3]; 3],
    facing: [f64; 3],
}

/// All triangles that are more than slivers.
fn triangles(playground: &mut Playground) -> Vec<Triangle> {
    playground.draw();
    let drawn = playground.buffers();
    let points =
        |t: &[f32]| -> [[f64; 3]; 3] { std::array::from_fn(|i| std::array::from_fn(|k| f64::from(t[3 * i + k]))) };
    let pairs = drawn.surface_positions.chunks_exact(9).zip(drawn.surface_normals.chunks_exact(9));
    let all = pairs.map(|(corners, normals)| {
        let corners = points(corners);
        let facing = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        Triangle { corners, normals: points(normals), facing }
    });
    all.filter(|triangle| dot(triangle.facing, triangle.facing) > 1e-10).collect()
}

#[test]
fn triangles_of_round_bodies_with_edges_face_outward_as_their_normals_do() {
    let ball = |axes: &str| json!({ "shape": { "ball": { "radius": 0.4 } }, "axes": axes });
    let segment = |axes: &str| json!({ "shape": { "box": { "half_extents": [0.75] } }, "axes": axes });
    let product = |factors: [Value; 2]| json!({ "product": { "factors": factors } });
    let shapes = [
        (3, product([ball("xy"), segment("z")])),
        (4, product([ball("xyz"), segment("w")])),
        (4, product([ball("xy"), ball("zw")])),
    ];
    for (dimension, shape) in shapes {
        for angle in [0.0, 17.0, 45.0, 71.0, 90.0] {
            let turns = ["xz", "yz", "zw", "xw"].into_iter().take(if dimension == 4 { 4 } else { 2 });
            let rotation: Vec<Value> = turns.map(|plane| json!({ "plane": plane, "angle_deg": angle })).collect();
            let mut playground = with_bodies(dimension, json!([{ "shape": shape, "rotation": rotation }]));
            let triangles = triangles(&mut playground);
            assert!(triangles.len() > 100, "{shape} at {angle}°: {} triangles", triangles.len());
            for Triangle { corners, normals, facing } in triangles {
                // The origin is the middle of the section.
                let outward = dot(facing, corners[0]);
                assert!(outward > 0.0, "{shape} at {angle}°: {corners:?} faces inward");
                let long = dot(facing, facing).sqrt();
                for normal in normals {
                    let cosine = dot(normal, facing) / long;
                    assert!(cosine > 0.85, "{shape} at {angle}°: normal {normal:?} of {corners:?}, cosine {cosine}");
                }
            }
        }
    }
}

#[test]
fn the_ends_of_a_cylinder_are_flat_and_whole() {
    let factors = json!([{ "shape": { "ball": { "radius": 0.4 } }, "axes": "xy" },
        { "shape": { "box": { "half_extents": [0.75] } }, "axes": "z" }]);
    let mut playground = one_body(3, json!({ "product": { "factors": factors } }));
    let triangles = triangles(&mut playground);
    let top: Vec<_> = triangles.iter().filter(|triangle| triangle.corners.iter().all(|c| c[2] > 0.749)).collect();
    for Triangle { corners, normals, .. } in &top {
        assert!(normals.iter().all(|normal| normal[2] > 1.0 - 1e-6), "{corners:?} {normals:?}");
    }
    // The rim is a polygon of some dozens of corners.
    for (share, turn) in (0..60).map(|k| (f64::from(k % 10) / 10.0, 0.7 * f64::from(k))) {
        let point = [0.39 * share * turn.cos(), 0.39 * share * turn.sin(), 0.75];
        let within = |corners: &[[f64; 3]; 3]| {
            (0..3).all(|i| cross(minus(corners[(i + 1) % 3], corners[i]), minus(point, corners[i]))[2] >= -1e-9)
        };
        assert!(top.iter().any(|triangle| within(&triangle.corners)), "a hole at {point:?}");
    }
}

#[test]
fn a_capsule_askew_agrees_with_the_general_search() {
    // Turned into w, so that its balls shrink along it; the export goes the general way, by support searches.
    let body = json!([{ "shape": { "capsule": { "half_length": 0.7, "radius": 0.5, "along": "x" } },
        "rotation": [{ "plane": "xw", "angle_deg": 35.0 }, { "plane": "yw", "angle_deg": 20.0 }] }]);
    let mut playground = with_bodies(4, body);
    ask(&mut playground, slice(4, 0.12, 3));
    let found = drawn_volume(&mut playground);
    answer(&mut playground, json!({ "type": "export", "format": "stl" }));
    let file = playground.file();
    let triangles: Vec<f32> = file[84..]
        .chunks_exact(50)
        .flat_map(|record| record[12..48].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])))
        .collect();
    let exported = volume(&triangles);
    assert!((found - exported).abs() < 0.02 * exported, "{found} drawn, {exported} exported");
}

#[test]
fn flatland_and_plane_worlds_are_drawn_as_polygons() {
    let area = |playground: &Playground| -> f64 {
        let positions = &playground.buffers().surface_positions;
        let cross = |t: &[f32]| {
            f64::from(t[3] - t[0]) * f64::from(t[7] - t[1]) - f64::from(t[4] - t[1]) * f64::from(t[6] - t[0])
        };
        positions.chunks_exact(9).map(|t| 0.5 * cross(t)).sum()
    };
    let mut plane = one_body(2, json!({ "box": { "half_extents": [0.5, 1.0] } }));
    plane.draw();
    assert!((area(&plane) - 2.0).abs() < 1e-6);
    let mut flatland = one_body(3, json!({ "box": { "half_extents": [0.5, 1.0, 0.3] } }));
    ask(&mut flatland, slice(3, 0.2, 2));
    flatland.draw();
    assert!((area(&flatland) - 2.0).abs() < 1e-6);
    let strip = &flatland.buffers().strip;
    assert_eq!(strip.len(), 3);
    assert!((strip[1] + 0.5).abs() < 1e-6 && (strip[2] - 0.1).abs() < 1e-6, "{strip:?}");
    let refused = refusal(&mut flatland, json!({ "type": "export", "format": "glb" }));
    assert!(refused["message"].as_str().is_some_and(|m| m.contains("flat")));
}

#[test]
fn ghosts_show_what_lies_off_the_slice_and_how_far() {
    let mut playground = one_body(4, json!({ "box": { "half_extents": [0.5, 0.5, 0.5, 0.2] } }));
    ask(&mut playground, json!({ "type": "ghosts", "on": true, "reach": 0.5 }));
    ask(&mut playground, slice(4, -0.5, 3));
    playground.draw();
    let drawn = playground.buffers();
    assert!(drawn.surface_positions.is_empty());
    assert!((volume(&drawn.ghost_positions) - 1.0).abs() < 1e-5);
    // The body lies on the side of +w, and its nearest point 0.3 away.
    assert!((drawn.ghost_distances[0] - 0.3).abs() < 1e-6, "{:?}", drawn.ghost_distances);
    ask(&mut playground, slice(4, -0.8, 3));
    playground.draw();
    assert!(playground.buffers().ghost_ranges.is_empty(), "0.6 away is beyond the reach");
}

#[test]
fn half_spaces_are_planes_of_the_slice() {
    let normal = [0.0, 0.6, 0.0, 0.8];
    let body = json!([{ "kind": "static", "shape": { "half_space": { "normal": normal, "offset": 1.0 } } }]);
    let mut playground = with_bodies(4, body);
    ask(&mut playground, slice(4, 0.5, 3));
    playground.draw();
    // 0.6 y + 0.8 · 0.5 ≤ 1
    let plane = &playground.buffers().half_spaces;
    let expected = [0.0, 0.0, 1.0, 0.0, 1.0];
    assert!(plane.iter().zip(expected).all(|(a, b): (&f32, f32)| (a - b).abs() < 1e-6), "{plane:?}");
    assert_eq!(plane.len(), 5);
}
