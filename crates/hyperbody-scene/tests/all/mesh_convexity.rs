//! Which meshes in files are convex: shallow dents and thin channels stay, and what few digits did to a convex polytope is passed over.

use std::path::PathBuf;

use hyperbody_scene::ShapeFile;

fn stored(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("hyperbody-convexity-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file");
    path
}

/// The volume of the surface in a file if it is not convex, and in any case that of the body made of it.
fn volumes(name: &str, text: &str) -> (Option<f64>, f64) {
    let file = ShapeFile::load(stored(name, text), None).unwrap();
    let surface = file.mesh::<3>().unwrap().map(|(_, properties)| properties.mass);
    (surface, file.build::<3>().unwrap().mass_properties(1.0).unwrap().mass)
}

/// The profile of a channel from z = 0 to `length`, as an OFF file.
fn channel(profile: &[[f64; 2]; 8], length: f64) -> String {
    let mut text = String::from("OFF\n16 10 0\n");
    for z in [0.0, length] {
        profile.iter().for_each(|[x, y]| text += &format!("{x} {y} {z}\n"));
    }
    text += "8 7 6 5 4 3 2 1 0\n8 8 9 10 11 12 13 14 15\n";
    (0..8).for_each(|k| text += &format!("4 {k} {} {} {}\n", (k + 1) % 8, (k + 1) % 8 + 8, k + 8));
    text
}

#[test]
fn shallow_dents_and_thin_channels_are_not_filled_up() {
    let beam = [
        [0.0, 0.0],
        [0.003, 0.0],
        [0.003, 0.001],
        [0.002, 0.001],
        [0.002, 0.0002],
        [0.001, 0.0002],
        [0.001, 0.001],
        [0.0, 0.001],
    ];
    let floor =
        [[-50.0, -1.0], [50.0, -1.0], [50.0, 0.0], [0.5, 0.0], [0.5, -0.01], [-0.5, -0.01], [-0.5, 0.0], [-50.0, 0.0]];
    let pit = |depth: f64| {
        [
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [0.9, 1.0],
            [0.9, 1.0 - depth],
            [-0.9, 1.0 - depth],
            [-0.9, 1.0],
            [-1.0, 1.0],
        ]
    };
    for (name, profile, length, expected) in [
        ("beam.off", beam, 10.0, 2.2e-5),
        ("floor.off", floor, 100.0, 9999.0),
        ("pit.off", pit(3e-4), 2.0, 8.0 - 3.6 * 3e-4),
        ("shallow.off", pit(1e-5), 2.0, 8.0 - 3.6 * 1e-5),
    ] {
        let (surface, body) = volumes(name, &channel(&profile, length));
        let surface = surface.unwrap_or_else(|| panic!("{name} is not convex"));
        assert!((surface / expected - 1.0).abs() < 1e-9, "{name}: {surface} for {expected}");
        assert!((body / expected - 1.0).abs() < 1e-9, "{name}: a body of {body} for {expected}");
    }
}

/// A cube whose faces are divided into triangles, turned and written with few digits: each square is a little bent, inward or outward.
#[test]
fn few_digits_leave_a_convex_polytope_convex() {
    let squares = 4;
    for (digits, turn) in (4..=9).flat_map(|digits| (1..=8).map(move |turn| (digits, turn))) {
        let (sin, cos) = (0.37 * f64::from(turn)).sin_cos();
        let mut corners: Vec<[i32; 3]> = Vec::new();
        let mut faces = String::new();
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -squares), (axis, squares)]) {
            for (i, j) in (0..squares).flat_map(|i| (0..squares).map(move |j| (i, j))) {
                let mut number = |i: i32, j: i32| {
                    let mut corner = [side; 3];
                    (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (2 * i - squares, 2 * j - squares);
                    corners.iter().position(|known| *known == corner).unwrap_or_else(|| {
                        corners.push(corner);
                        corners.len() - 1
                    })
                };
                let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
                // Diagonals of both kinds: some of them are valleys.
                let (p, q) = if (i + j) % 2 == 0 { ([a, b, c], [a, c, d]) } else { ([a, b, d], [b, c, d]) };
                [p, q].iter().for_each(|[u, v, w]| faces += &format!("3 {u} {v} {w}\n"));
            }
        }
        let mut text = format!("OFF\n{} {} 0\n", corners.len(), 12 * squares * squares);
        for corner in &corners {
            let [x, y, z] = corner.map(|c| f64::from(c) / f64::from(squares));
            let (x, y) = (x * cos - y * sin, x * sin + y * cos);
            let (y, z) = (y * cos - z * sin, y * sin + z * cos);
            text += &format!("{x:.digits$} {y:.digits$} {z:.digits$}\n");
        }
        let (surface, body) = volumes("turned.off", &(text + &faces));
        assert_eq!(surface, None, "{digits} digits, turned by {turn}: the cube is convex");
        assert!((body / 8.0 - 1.0).abs() < 10.0_f64.powi(-(digits as i32)) * 3.0, "{digits} digits: {body}");
    }
}

/// A surface that covers its hull twice is not that of the hull.
#[test]
fn a_polytope_that_stands_twice_in_a_file_is_refused() {
    let corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    let text = format!(
        "OFF\n8 8 0\n{corners}{corners}3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n3 4 5 6\n3 4 5 7\n3 4 6 7\n3 5 6 7\n"
    );
    let error = ShapeFile::load(stored("twice.off", &text), None).unwrap().mesh::<3>().unwrap_err().to_string();
    assert!(error.contains("faces 0 and 4 lie upon each other"), "{error}");
}
