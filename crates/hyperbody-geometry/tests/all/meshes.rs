//! Surfaces of files that need not be convex: orientation, volume and moments against independent decompositions.

use crate::common::Random;
use hyperbody_geometry::decompose::convex_cells;
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, OffFile, off};
use hyperbody_math::{Matrix, Vector};

fn mass<const N: usize>(file: &OffFile) -> MassProperties<N> {
    let points = file.vertices::<N>().unwrap();
    MassProperties::of_closed_boundary(&points, &file.boundary().unwrap()).unwrap()
}

fn assert_same<const N: usize>(found: &MassProperties<N>, expected: &MassProperties<N>) {
    assert!((found.mass / expected.mass - 1.0).abs() < 1e-12, "{} for {}", found.mass, expected.mass);
    assert!((found.centre - expected.centre).norm() < 1e-12);
    assert!((found.second_moments - expected.second_moments).max_abs() < 1e-12 * expected.second_moments.max_abs());
}

#[test]
fn convex_files_have_the_mass_of_their_hull() {
    fn check<const N: usize>(names: &[&str]) {
        for name in names {
            let body = polytope::<N>(name, Size::Circumradius(1.3)).unwrap().translated(Vector::splat(0.3));
            assert_same(&mass::<N>(&OffFile::from_polytope(&body)), &MassProperties::of_polytope(&body));
        }
    }
    check::<2>(&["triangle", "7-gon"]);
    check::<3>(&["cube", "dodecahedron", "icosahedron"]);
    check::<4>(&["5-cell", "tesseract", "24-cell", "120-cell"]);
    check::<5>(&["simplex", "hypercube"]);
    check::<6>(&["simplex", "hypercube"]);
}

/// The surface of a set of unit cells of the grid of side three, as a file with cubic facets: the ranks below are shared.
fn grid_file<const N: usize>(filled: &dyn Fn([usize; N]) -> bool) -> (String, Vec<[usize; N]>) {
    const SIDE: usize = 3;
    let cells: Vec<[usize; N]> = (0..SIDE.pow(N as u32))
        .map(|k| std::array::from_fn(|i| k / SIDE.pow(i as u32) % SIDE))
        .filter(|c| filled(*c))
        .collect();
    // A face is its lowest corner and the axes along which it extends.
    let mut ranks: Vec<Vec<(Vec<usize>, Vec<usize>)>> = vec![Vec::new(); N];
    let number = |rank: &mut Vec<(Vec<usize>, Vec<usize>)>, face: (Vec<usize>, Vec<usize>)| {
        rank.iter().position(|known| *known == face).unwrap_or_else(|| {
            rank.push(face);
            rank.len() - 1
        })
    };
    for cell in &cells {
        for axis in 0..N {
            for side in [0, 1] {
                let mut beside = *cell;
                let inside =
                    if side == 0 { beside[axis].checked_sub(1) } else { Some(beside[axis] + 1).filter(|&c| c < SIDE) };
                if let Some(c) = inside {
                    beside[axis] = c;
                    if filled(beside) {
                        continue;
                    }
                }
                let mut corner = cell.to_vec();
                corner[axis] += side;
                number(&mut ranks[N - 1], (corner, (0..N).filter(|&other| other != axis).collect()));
            }
        }
    }
    let mut lines: Vec<Vec<String>> = vec![Vec::new(); N];
    for rank in (2..N).rev() {
        for (corner, axes) in ranks[rank].clone() {
            if rank == 2 {
                let at = |a: usize, b: usize| {
                    let mut corner = corner.clone();
                    corner[axes[0]] += a;
                    corner[axes[1]] += b;
                    (corner, Vec::new())
                };
                let around =
                    [at(0, 0), at(1, 0), at(1, 1), at(0, 1)].map(|face| number(&mut ranks[0], face).to_string());
                lines[2].push(format!("4 {}", around.join(" ")));
            } else {
                let mut parts = Vec::new();
                for &axis in &axes {
                    for side in [0, 1] {
                        let mut corner = corner.clone();
                        corner[axis] += side;
                        let rest = axes.iter().copied().filter(|&other| other != axis).collect();
                        parts.push(number(&mut ranks[rank - 1], (corner, rest)).to_string());
                    }
                }
                lines[rank].push(format!("{} {}", parts.len(), parts.join(" ")));
            }
        }
    }
    let mut text = format!("{N}OFF\n{} {} 0", ranks[0].len(), lines[2].len());
    for rank in &lines[3..] {
        text += &format!(" {}", rank.len());
    }
    text.push('\n');
    for (corner, _) in &ranks[0] {
        text += &(corner.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ") + "\n");
    }
    for line in lines.iter().flatten() {
        text += &(line.clone() + "\n");
    }
    (text, cells)
}

/// The convex cells of a solid fill it: they add up to its moments, and are no more than its cubes.
fn check_cells<const N: usize>(file: &OffFile, surface: &[[u32; N]], expected: &MassProperties<N>, cubes: usize) {
    let cells = convex_cells(&file.vertices::<N>().unwrap(), surface).unwrap();
    let parts: Vec<MassProperties<N>> = cells.iter().map(MassProperties::of_polytope).collect();
    let sum = MassProperties::combined(&parts).unwrap();
    assert!((sum.mass / expected.mass - 1.0).abs() < 1e-9, "{} for {}", sum.mass, expected.mass);
    assert!((sum.second_moments - expected.second_moments).max_abs() < 1e-9 * expected.second_moments.max_abs());
    assert!(cells.len() <= cubes, "{} cells for {cubes} cubes", cells.len());
}

/// Bodies of unit cubes: L, U and ring shapes, and at random. Their moments are sums over the cubes.
fn bodies_of_cubes<const N: usize>() {
    let mut random = Random(70 + N as u64);
    let mut checked = 0;
    for case in 0..24 {
        let weights: Vec<u64> = (0..3_usize.pow(N as u32)).map(|_| random.bits() % 100).collect();
        let filled = |c: [usize; N]| match case {
            0 => c[0] == 0 || c[1] == 0,
            1 => !(c[0] == 1 && c[1] == 1),
            2 => c[0] == 0 || (c[1] != 1),
            _ => weights[(0..N).map(|i| c[i] * 3_usize.pow(i as u32)).sum::<usize>()] < 60 && c[N - 1] == 0,
        };
        let (text, cells) = grid_file::<N>(&filled);
        let file = off::parse(&text).unwrap();
        // Cubes that touch along an edge only make a surface that branches.
        let surface = match file.boundary::<N>() {
            Ok(surface) => surface,
            Err(error) => {
                assert!(case > 2 && error.kind() == GeometryErrorKind::BadMesh, "{error}");
                continue;
            }
        };
        let found = MassProperties::of_closed_boundary(&file.vertices::<N>().unwrap(), &surface).unwrap();
        let cube = |cell: &[usize; N]| MassProperties {
            mass: 1.0,
            centre: Vector::from_fn(|i| cell[i] as f64 + 0.5),
            second_moments: Matrix::IDENTITY * (1.0 / 12.0),
        };
        let expected = MassProperties::combined(&cells.iter().map(cube).collect::<Vec<_>>()).unwrap();
        assert_same(&found, &expected);
        if N == 3 || case < 6 {
            check_cells(&file, &surface, &expected, cells.len());
        }
        checked += 1;
    }
    assert!(checked >= 4, "only {checked}");
}

#[test]
fn bodies_of_cubes_have_the_moments_of_the_cubes() {
    bodies_of_cubes::<3>();
    bodies_of_cubes::<4>();
}

#[test]
fn open_and_one_sided_surfaces_are_refused() {
    let open = "OFF\n4 3 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n";
    let error = off::parse(open).unwrap().boundary::<3>().unwrap_err();
    assert!(error.to_string().contains("open"), "{error}");
    // The projective plane with six vertices (D. Hilbert, S. Cohn-Vossen, 1932): closed, with only one side.
    let faces = ["0 1 2", "0 2 3", "0 3 4", "0 4 5", "0 5 1", "1 2 4", "2 3 5", "3 4 1", "4 5 2", "5 1 3"];
    let mut plane = "OFF\n6 10 15\n0 0 1\n1 0 0\n0.3 1 0\n-0.8 0.6 0\n-0.8 -0.6 0\n0.3 -1 0\n".to_string();
    faces.iter().for_each(|face| plane += &format!("3 {face}\n"));
    let error = off::parse(&plane).unwrap().boundary::<3>().unwrap_err();
    assert!(error.to_string().contains("one side"), "{error}");
    assert_eq!(
        off::parse("OFF\n1 0 0\n0 0 0\n").unwrap().boundary::<3>().unwrap_err().kind(),
        GeometryErrorKind::BadCount
    );
    assert_eq!(off::parse(open).unwrap().boundary::<4>().unwrap_err().kind(), GeometryErrorKind::BadCount);
}

/// A file of nested cubes of these half-widths, every second face turned over: nothing depends on that.
fn nested_cubes<const N: usize>(half_widths: &[f64], shift: f64) -> OffFile {
    let cube = OffFile::from_polytope(&polytope::<N>("hypercube", Size::Edge(2.0)).unwrap());
    let corners = cube.vertices::<N>().unwrap();
    let mut text =
        format!("{N}OFF\n{} {} 0", corners.len() * half_widths.len(), cube.elements(2).len() * half_widths.len());
    (3..N).for_each(|rank| text += &format!(" {}", cube.elements(rank).len() * half_widths.len()));
    for (k, half) in half_widths.iter().enumerate() {
        for corner in &corners {
            let words: Vec<String> = corner.iter().map(|c| (c * half + shift * k as f64).to_string()).collect();
            text += &format!("\n{}", words.join(" "));
        }
    }
    for rank in 2..N {
        let below = if rank == 2 { corners.len() } else { cube.elements(rank - 1).len() };
        for k in 0..half_widths.len() {
            for (index, face) in cube.elements(rank).iter().enumerate() {
                let mut words: Vec<String> = face.iter().map(|&part| (part as usize + k * below).to_string()).collect();
                if (index + k) % 2 == 0 {
                    words.reverse();
                }
                text += &format!("\n{} {}", face.len(), words.join(" "));
            }
        }
    }
    off::parse(&text).unwrap()
}

/// A surface within another bounds a hollow, one within that a body again; surfaces that cross each other do neither.
fn hollows<const N: usize>() {
    let cube = |half: f64| (2.0 * half).powi(N as i32);
    let found = mass::<N>(&nested_cubes::<N>(&[1.0, 0.7, 0.2], 0.05)).mass;
    let expected = cube(1.0) - cube(0.7) + cube(0.2);
    assert!((found / expected - 1.0).abs() < 1e-12, "{N}D: {found} for {expected}");
    let crossing = mass::<N>(&nested_cubes::<N>(&[1.0, 0.7], 0.5)).mass;
    assert!((crossing / (cube(1.0) + cube(0.7)) - 1.0).abs() < 1e-12, "{N}D: {crossing}");
    let file = nested_cubes::<N>(&[1.0, 0.5], 0.1);
    let surface = file.boundary::<N>().unwrap();
    let cells = convex_cells(&file.vertices::<N>().unwrap(), &surface).unwrap();
    let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    assert!((content / (cube(1.0) - cube(0.5)) - 1.0).abs() < 1e-9, "{N}D: {content} in {} cells", cells.len());
}

#[test]
fn surfaces_within_surfaces_bound_hollows() {
    hollows::<3>();
    hollows::<4>();
}

#[test]
fn files_with_corners_of_their_own_for_each_face_are_told_so() {
    let soup = "OFF\n12 4 0\n0 0 0\n1 0 0\n0 1 0\n-0 0 0\n1 0 0\n0 0 1\n0 0 0\n0 1 0\n0 0 1\n1 0 0\n0 1 0\n0 0 1\n\
                3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n";
    let file = off::parse(soup).unwrap();
    assert_eq!(file.repeated_vertices(), 8);
    let error = file.boundary::<3>().unwrap_err();
    assert!(error.to_string().contains("8 vertices stand where another one does"), "{error}");
    // A vertex that no face names is no part of the body.
    let stray = "OFF\n5 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 5 5\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";
    assert_eq!(off::parse(stray).unwrap().to_polytope::<3>().unwrap().vertices().len(), 4);
}

/// A pentagram's middle counts twice: |A| is the sum of the triangles of neighbouring points with the centre.
#[test]
fn stars_count_their_windings() {
    let point = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / 5.0).sin_cos();
        format!("{cos} {sin}\n")
    };
    let text = format!("2OFF\n5 1 5\n{}5 0 2 4 1 3\n", (0..5).map(point).collect::<String>());
    let file = off::parse(&text).unwrap();
    let expected = 2.5 * (std::f64::consts::TAU * 2.0 / 5.0).sin();
    assert!((mass::<2>(&file).mass - expected).abs() < 1e-14);
}

/// Rows of `across` points in circles, closed in both directions, two triangles for each step.
fn closed_grid(along: u32, across: u32, point: impl Fn(f64, f64) -> Vector<3>) -> (Vec<Vector<3>>, Vec<[u32; 3]>) {
    let turn = |k: u32, of: u32| std::f64::consts::TAU * f64::from(k) / f64::from(of);
    let places = (0..along).flat_map(|i| (0..across).map(move |j| (i, j)));
    let points = places.clone().map(|(i, j)| point(turn(i, along), turn(j, across))).collect();
    let index = |i: u32, j: u32| (i % along) * across + j % across;
    let two = |(i, j): (u32, u32)| {
        let (a, b, c, d) = (index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
        [[a, b, c], [a, c, d]]
    };
    (points, places.flat_map(two).collect())
}

/// Meshes of thousands of triangles take seconds; those that come apart into too many cells are refused before they do.
#[test]
fn large_meshes_are_cells_or_are_refused_soon() {
    let ring = |bumps: f64| {
        move |around: f64, tube: f64| {
            let thick = 0.4 + bumps * (7.0 * around).sin() * (5.0 * tube).sin();
            let out = 1.0 + thick * tube.cos();
            Vector([out * around.cos(), out * around.sin(), thick * tube.sin()])
        }
    };
    let start = std::time::Instant::now();
    let (points, surface) = closed_grid(48, 24, ring(0.0));
    let cells = convex_cells(&points, &surface).unwrap();
    let sum: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    let whole = MassProperties::of_closed_boundary(&points, &surface).unwrap().mass;
    println!("{} triangles are {} cells: {:.1?}", surface.len(), cells.len(), start.elapsed());
    assert!((sum / whole - 1.0).abs() < 1e-9, "{sum} for {whole}");

    let start = std::time::Instant::now();
    let (points, surface) = closed_grid(100, 60, ring(0.1));
    let error = convex_cells(&points, &surface).unwrap_err();
    println!("{} triangles are refused: {:.1?}", surface.len(), start.elapsed());
    assert_eq!(error.kind(), GeometryErrorKind::BadCount);
    assert!(error.to_string().contains("4096 is the limit: use a simpler mesh"), "{error}");
    // It took minutes; a second or so is enough, with room for a busy machine.
    assert!(
        start.elapsed().as_secs() < 60,
        "refused after {:?}: the walls still to come are not counted",
        start.elapsed()
    );
}

/// A cross-polytope of which every facet is divided by a point that stands out or in: star-shaped, and rough.
fn rough_cross_polytope<const N: usize>() -> (Vec<Vector<N>>, Vec<[u32; N]>) {
    let mut random = Random(5);
    let mut points: Vec<Vector<N>> =
        (0..2 * N).map(|k| Vector::unit(k / 2) * if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let mut surface = Vec::new();
    for signs in 0..1_usize << N {
        let facet: [u32; N] = std::array::from_fn(|axis| (2 * axis + (signs >> axis & 1)) as u32);
        let middle = facet.iter().fold(Vector::ZERO, |sum, &v| sum + points[v as usize]).normalize_or_zero();
        points.push(middle * (0.7 + 0.006 * (random.bits() % 100) as f64));
        for replaced in 0..N {
            let mut simplex = facet;
            simplex[replaced] = points.len() as u32 - 1;
            if Matrix::from_columns(simplex.map(|v| points[v as usize])).determinant() < 0.0 {
                simplex.swap(0, 1);
            }
            surface.push(simplex);
        }
    }
    (points, surface)
}

/// A cut of 6D takes thousands of times as long as one of 3D, so the number of cuts is no bound.
#[test]
fn rough_meshes_of_many_dimensions_are_cut_or_refused_soon() {
    let (points, surface) = rough_cross_polytope::<4>();
    let cells = convex_cells(&points, &surface).unwrap();
    let sum: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
    let whole = MassProperties::of_closed_boundary(&points, &surface).unwrap().mass;
    assert!((sum / whole - 1.0).abs() < 1e-9, "{sum} for {whole}");

    let start = std::time::Instant::now();
    let (points, surface) = rough_cross_polytope::<6>();
    let error = convex_cells(&points, &surface).map(|cells| cells.len()).unwrap_err();
    println!("{} simplices of 6D are refused: {:.1?}", surface.len(), start.elapsed());
    assert_eq!(error.kind(), GeometryErrorKind::BadCount);
    assert!(error.to_string().contains("takes too long to come apart into convex cells"), "{error}");
}
