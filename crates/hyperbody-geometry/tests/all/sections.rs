//! Sections of polytopes: known faces, closed forms, volumes that add up, and hyperplanes in every special position.

use crate::common::{Random, cube, slab_of_cube};
use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{
    MassProperties, Polytope, SectionPolytope, SectionScratch, Shape, SliceFrame, Solid, cut_pieces, hull, star,
};
use hyperbody_math::{Pose, Vector};

fn regular<const N: usize>(name: &str) -> Polytope<N> {
    polytope(name, Size::Circumradius(1.0)).unwrap()
}

fn frame<const N: usize>(normal: Vector<N>, offset: f64) -> SliceFrame<N> {
    SliceFrame::from_normal(normal, offset).unwrap()
}

/// The section closes up, its vertices lie in the body and its facets in those that they come from.
fn check_section<const N: usize, const M: usize>(
    body: &Polytope<N>,
    frame: &SliceFrame<N>,
    section: &SectionPolytope<M>,
    tolerance: f64,
) {
    let counts = section.face_counts();
    let euler = counts.iter().rev().fold(0, |sum, &count| count as i64 - sum);
    assert_eq!(euler, if M.is_multiple_of(2) { 0 } else { 2 }, "{counts:?}");
    let in_space: Vec<Vector<N>> = section.vertices().iter().map(|&v| frame.to_space(v)).collect();
    for point in &in_space {
        assert!(frame.height(*point).abs() < tolerance);
        for facet in body.facets() {
            assert!(facet.normal.dot(*point) - facet.offset < tolerance, "a vertex outside");
        }
    }
    // Vertices of each facet: down through the ranks.
    for (index, facet) in section.faces(M - 1).enumerate() {
        let mut parts: Vec<u32> = facet.to_vec();
        for rank in (1..M - 1).rev() {
            let faces: Vec<&[u32]> = section.faces(rank).collect();
            parts = parts.iter().flat_map(|&part| faces[part as usize]).copied().collect();
        }
        let source = &body.facets()[section.facet_sources()[index] as usize];
        for vertex in parts {
            let height = source.normal.dot(in_space[vertex as usize]) - source.offset;
            assert!(height.abs() < tolerance, "a facet off its source by {height}");
        }
    }
}

#[test]
fn sections_of_regular_polytopes_have_their_known_faces() {
    let counts = |name: &str, normal: [f64; 4], offset: f64| {
        let body = regular::<4>(name);
        let frame = frame(Vector(normal), offset);
        let section: SectionPolytope<3> = SectionPolytope::from_polytope(&body).section(&frame);
        check_section(&body, &frame, &section, 1e-12);
        section.face_counts()
    };
    let (w, diagonal) = ([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    assert_eq!(counts("tesseract", w, 0.1), [8, 12, 6]);
    // Through the middle across the long diagonal: an octahedron, all of whose vertices are vertices of the tesseract.
    assert_eq!(counts("tesseract", diagonal, 0.0), [6, 12, 8]);
    assert_eq!(counts("tesseract", diagonal, 1.5), [4, 6, 4]);
    assert_eq!(counts("tesseract", diagonal, 0.5), [12, 18, 8]);
    assert_eq!(counts("16-cell", w, 0.0), [6, 12, 8]);
    assert_eq!(counts("24-cell", w, 0.0), [12, 24, 14]);
    // Vertex first, the 600-cell has the thirty vertices of an icosidodecahedron in its middle (H. S. M. Coxeter, "Regular
    // Polytopes", table V), and twelve edges pass through the centres of its pentagons: the pentakis icosidodecahedron.
    assert_eq!(counts("600-cell", w, 0.0), [42, 120, 80]);
    assert_eq!(counts("600-cell", w, 0.9), [12, 30, 20]);
    assert_eq!(counts("5-cell", [0.0, 1.0, 0.0, 0.0], 0.2), [4, 6, 4]);
}

fn cubes<const N: usize, const M: usize>() {
    let mut random = Random(30 + N as u64);
    let points: Vec<Vector<N>> = cube().iter().map(|c: &Vector<N>| (*c + Vector::splat(1.0)) * 0.5).collect();
    let body = SectionPolytope::from_polytope(&Polytope::from_points(&points).unwrap());
    for _ in 0..40 {
        let a = Vector::<N>::from_fn(|_| 0.2 + random.unit()).normalize_or_zero();
        let c = a.iter().sum::<f64>() * random.unit();
        let section: SectionPolytope<M> = body.section(&frame(a, c));
        let (found, expected) = (section.mass_properties().mass, slab_of_cube(a, c));
        assert!((found - expected).abs() < 1e-10, "{found} for {expected}");
    }
}

#[test]
fn sections_of_cubes_have_the_volume_of_the_closed_form() {
    cubes::<2, 1>();
    cubes::<3, 2>();
    cubes::<4, 3>();
    cubes::<5, 4>();
    cubes::<6, 5>();
}

/// ∫ of the section's volume over the offset. Between neighbouring vertices that is a polynomial of degree M ≤ 5, so that
/// three Gauss points are exact.
fn integrated<const N: usize, const M: usize>(body: &Polytope<N>, normal: Vector<N>) -> f64 {
    let tables = SectionPolytope::from_polytope(body);
    let mut heights: Vec<f64> = body.vertices().iter().map(|v| v.dot(normal)).collect();
    heights.sort_by(f64::total_cmp);
    let (mut scratch, mut section) = (SectionScratch::default(), SectionPolytope::<M>::new());
    let mut sum = 0.0;
    for pair in heights.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for (node, weight) in [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)] {
            let frame = frame(normal, middle + half * node);
            tables.section_into(&frame, &mut scratch, &mut section);
            sum += half * weight * section.mass_properties().mass;
        }
    }
    sum
}

fn volumes<const N: usize, const M: usize>(names: &[&str]) {
    let mut random = Random(60 + N as u64);
    let mut bodies: Vec<Polytope<N>> = names.iter().map(|name| regular(name)).collect();
    bodies.push(Polytope::from_points(&random.points(N + 6)).unwrap());
    for body in bodies {
        let volume = MassProperties::of_polytope(&body).mass;
        for normal in [Vector::unit(N - 1), random.direction()] {
            let found = integrated::<N, M>(&body, normal);
            assert!((found / volume - 1.0).abs() < 1e-10, "{found} for {volume}");
        }
    }
}

#[test]
fn volumes_of_sections_add_up_to_that_of_the_body() {
    volumes::<2, 1>(&["7-gon"]);
    volumes::<3, 2>(&["dodecahedron", "icosahedron"]);
    volumes::<4, 3>(&["simplex", "tesseract", "16-cell", "24-cell", "600-cell", "120-cell"]);
    volumes::<5, 4>(&["simplex", "hypercube", "orthoplex"]);
    volumes::<6, 5>(&["simplex", "hypercube", "orthoplex"]);
}

/// Hyperplanes through `N` vertices: they contain vertices, edges, faces and, of regular bodies, facets.
fn special_positions<const N: usize, const M: usize>(name: &str) {
    let mut random = Random(90 + N as u64);
    let upright = regular::<N>(name);
    let turned = Pose::new(random.rotation(), random.vector());
    let points: Vec<Vector<N>> = upright.vertices().iter().map(|&v| turned.transform_point(v)).collect();
    for body in [upright, Polytope::from_points(&points).unwrap()] {
        let tables = SectionPolytope::from_polytope(&body);
        let (mut scratch, mut section) = (SectionScratch::default(), SectionPolytope::<M>::new());
        for _ in 0..60 {
            let corners: Vec<Vector<N>> =
                (0..N).map(|_| body.vertices()[random.below(body.vertices().len())]).collect();
            // Orthogonal to all differences, by removing them from a random vector.
            let mut basis: Vec<Vector<N>> = Vec::new();
            for &corner in &corners[1..] {
                let rest = remove(remove(corner - corners[0], &basis), &basis);
                if rest.norm() > 1e-6 {
                    basis.push(rest.normalize_or_zero());
                }
            }
            let Some(normal) = remove(remove(random.direction(), &basis), &basis).try_normalize() else { continue };
            let through = frame(normal, normal.dot(corners[0]));
            if !tables.section_into(&through, &mut scratch, &mut section) {
                continue;
            }
            check_section(&body, &through, &section, 1e-11);
            // From one side at least the volume is that of a hyperplane close by.
            let volume = section.mass_properties().mass;
            let beside = [1e-7, -1e-7]
                .map(|step| tables.section::<M>(&frame(normal, normal.dot(corners[0]) + step)).mass_properties().mass);
            let change = beside.iter().map(|v| (v - volume).abs()).fold(f64::INFINITY, f64::min);
            assert!(change < 1e-5, "{volume} beside {beside:?}");
        }
    }
}

fn remove<const N: usize>(v: Vector<N>, basis: &[Vector<N>]) -> Vector<N> {
    basis.iter().fold(v, |v, &b| v - b * b.dot(v))
}

#[test]
fn hyperplanes_along_vertices_edges_and_faces_are_ordinary() {
    for name in ["simplex", "hypercube", "orthoplex"] {
        special_positions::<3, 2>(name);
        special_positions::<4, 3>(name);
        special_positions::<5, 4>(name);
        special_positions::<6, 5>(name);
    }
    special_positions::<3, 2>("dodecahedron");
    special_positions::<4, 3>("24-cell");
    special_positions::<4, 3>("600-cell");
    special_positions::<4, 3>("120-cell");
}

fn touching<const N: usize, const M: usize>() {
    let body = SectionPolytope::from_polytope(&Polytope::from_points(&cube::<N>()).unwrap());
    // A facet gives itself, an edge or a vertex nothing.
    let facet: SectionPolytope<M> = body.section(&frame(Vector::unit(0), 1.0));
    assert_eq!(facet.face_counts()[0], 1 << M);
    assert!((facet.mass_properties().mass / 2_f64.powi(M as i32) - 1.0).abs() < 1e-14);
    assert_eq!(facet.facet_sources().len(), 2 * M);
    assert!(body.section::<M>(&frame(Vector::splat(1.0), N as f64)).is_empty());
    if N > 2 {
        assert!(body.section::<M>(&frame(Vector::unit(0) + Vector::unit(1), 2.0)).is_empty());
    }
    for outside in [1.0 + 1e-9, 5.0, -1e5] {
        assert!(body.section::<M>(&frame(Vector::unit(0), outside)).is_empty());
    }
    let nowhere = SliceFrame::new(Pose::from_translation(Vector::splat(f64::NAN)));
    assert!(body.section::<M>(&nowhere).is_empty());
}

#[test]
fn touching_hyperplanes_give_a_facet_or_nothing() {
    touching::<2, 1>();
    touching::<3, 2>();
    touching::<4, 3>();
    touching::<5, 4>();
    touching::<6, 5>();
}

#[test]
fn two_cuts_commute() {
    let mut random = Random(77);
    let body = Polytope::<5>::from_points(&random.points(30)).unwrap();
    let tables = SectionPolytope::from_polytope(&body);
    for _ in 0..20 {
        let (first, second) = (random.direction::<5>(), random.direction::<5>());
        let (c, d) = (0.2 * random.symmetric(), 0.2 * random.symmetric());
        let flat = |first: Vector<5>, c: f64, second: Vector<5>, d: f64| {
            let outer = frame(first, c);
            let inner = frame(outer.direction_to_slice::<4>(second), d - second.dot(first) * c);
            let solid: SectionPolytope<3> = tables.section::<4>(&outer).section(&inner);
            for &v in solid.vertices() {
                let p: Vector<5> = outer.to_space(inner.to_space::<3>(v));
                assert!((p.dot(first) - c).abs() < 1e-12 && (p.dot(second) - d).abs() < 1e-12);
            }
            let mut sources = solid.facet_sources().to_vec();
            sources.sort_unstable();
            (solid.mass_properties().mass, solid.face_counts(), sources)
        };
        let (one, other) = (flat(first, c, second, d), flat(second, d, first, c));
        assert!((one.0 - other.0).abs() < 1e-12 && one.0 > 0.0);
        assert_eq!((one.1, one.2), (other.1, other.2));
    }
}

/// Prisms over a 40-gon whose facets are flat to three digits only, cut by hyperplanes almost along them.
fn uneven<const N: usize, const M: usize>() {
    let mut random = Random(120 + N as u64);
    for _ in 0..4 {
        let turn = random.rotation::<N>();
        let base = cube::<N>().into_iter().filter(|c| c[0] > 0.0 && c[1] > 0.0);
        let around = base.flat_map(|c| {
            (0..40).map(move |k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 40.0).sin_cos();
                Vector::from_fn(|i| [cos, sin].get(i).copied().unwrap_or(c[i]))
            })
        });
        let round = |c: Vector<N>| Vector::from_fn(|i| (turn.rotate(c)[i] * 1e3).round() / 1e3);
        let points: Vec<Vector<N>> = around.map(round).collect();
        let (body, _) = hull::convex_hull_within(&points, 1e-3).unwrap();
        let tables = SectionPolytope::from_polytope(&body);
        for facet in body.facets().iter().step_by(body.facets().len().div_ceil(12)) {
            for _ in 0..20 {
                let normal = facet.normal + random.vector() * 1e-2;
                let frame = frame(normal, normal.dot(body.vertices()[facet.vertices[0] as usize]));
                let section: SectionPolytope<M> = tables.section(&frame);
                if !section.is_empty() {
                    check_section(&body, &frame, &section, 1e-2);
                }
            }
        }
    }
}

#[test]
fn uneven_facets_still_give_polytopes() {
    uneven::<3, 2>();
    uneven::<4, 3>();
}

#[test]
fn frames_move_without_jumps() {
    let mut random = Random(5);
    for _ in 0..200 {
        let normal = random.direction::<4>();
        let one = frame(normal, 0.3);
        let other = frame(normal + random.vector() * 1e-6, 0.3 + 1e-6);
        let point = random.vector();
        let moved = (one.to_slice::<3>(point) - other.to_slice::<3>(point)).norm();
        // The shortest turn to the normal is continuous except at −w.
        assert!(moved < 1e-4 / (1.0 + normal[3]).max(0.01), "{moved}");
        assert!((one.normal() - normal).norm() < 1e-14 && (one.offset() - 0.3).abs() < 1e-14);
        let seen = one.seen_from(&Pose::from_translation(Vector([1.0, 2.0, 3.0, 4.0])));
        assert!((seen.height(point) - one.height(point + Vector([1.0, 2.0, 3.0, 4.0]))).abs() < 1e-13);
    }
    let upright = frame(Vector([0.0, 0.0, 0.0, 2.0]), 1.0);
    assert_eq!(upright.to_slice::<3>(Vector([1.0, 2.0, 3.0, 0.0])), Vector([1.0, 2.0, 3.0]));
    assert_eq!(upright.offset(), 0.5);
    let down = frame(Vector([0.0, 0.0, 0.0, -1.0]), 1.0);
    assert!((down.height(Vector([0.0, 0.0, 0.0, -1.0]))).abs() < 1e-15);
    assert!(SliceFrame::<4>::from_normal([0.0; 4], 1.0).is_err());
    assert!(SliceFrame::<4>::from_normal([1.0; 4], f64::NAN).is_err());
}

#[test]
fn memory_does_not_matter() {
    let mut random = Random(8);
    let bodies: Vec<SectionPolytope<4>> =
        ["600-cell", "tesseract"].iter().map(|name| SectionPolytope::from_polytope(&regular(name))).collect();
    let (mut scratch, mut out) = (SectionScratch::default(), SectionPolytope::<3>::new());
    for k in 0..20 {
        let body = &bodies[k % 2];
        let frame = frame(random.direction(), 0.5 * random.unit());
        body.section_into(&frame, &mut scratch, &mut out);
        assert_eq!(out, body.section(&frame));
    }
}

/// Where pieces of a body meet wall on wall within the hyperplane, the wall counts once; at its foot and its top it is there.
#[test]
fn walls_within_the_hyperplane_count_once() {
    let cube = |half: f64| Shape::<4>::cuboid(Vector([1.0, 1.0, half, 1.0])).unwrap();
    let at = |w: f64| Pose::from_translation(Vector([0.0, 0.0, 0.0, w]));
    let body = Shape::compound(vec![(at(-1.0), cube(1.0)), (at(1.0), cube(0.5))]).unwrap();
    let volume = |offset: f64| {
        let frame = SliceFrame::from_normal(Vector::unit(3), offset).unwrap();
        let measured = body.section_volume(&frame, 1e-9).unwrap();
        let solids = body.solids();
        let cut = cut_pieces(&solids, &frame);
        let made = |(solid, cut): (&Solid<4>, bool)| if cut { solid.section::<3>(&frame) } else { None };
        let added: f64 = solids.iter().zip(cut).filter_map(made).map(|section| section.volume(1e-9).unwrap()).sum();
        (measured, added)
    };
    for (offset, expected) in [(-2.0, 8.0), (-1.0, 8.0), (-1e-9, 8.0), (0.0, 4.0), (1e-9, 4.0), (1.0, 4.0), (2.0, 4.0)]
    {
        let (measured, added) = volume(offset);
        assert!((added - expected).abs() < 1e-12, "at {offset}: {added} for {expected}");
        assert!((measured - expected).abs() < 1e-9, "at {offset}: measured {measured} for {expected}");
    }
    for symbol in ["{5/2,5,3}", "{5/2,3,5}", "{5,5/2,5}"] {
        let cells = star::cells::<4>(&star::symbol(symbol).unwrap(), Size::Circumradius(1.0), 10_000).unwrap();
        let parts = cells.into_iter().map(|cell| (Pose::IDENTITY, Shape::polytope(cell.into()).unwrap()));
        let body = Shape::compound(parts.collect()).unwrap();
        let volume =
            |offset| body.section_volume(&SliceFrame::from_normal(Vector::unit(3), offset).unwrap(), 1e-9).unwrap();
        let (middle, beside) = (volume(0.0), volume(1e-7));
        assert!((middle / beside - 1.0).abs() < 1e-5, "{symbol}: {middle} through the middle, {beside} beside it");
    }
}
