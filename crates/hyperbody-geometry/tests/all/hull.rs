//! Hulls against a brute-force enumeration of facets, and on every degenerate input we could think of.

use std::collections::BTreeSet;

use crate::common::{Random, cross_polytope, cube, grid};
use hyperbody_geometry::{GeometryErrorKind, Polytope, hull};
use hyperbody_math::{Matrix, Vector};

/// The normal of the hyperplane through `N` points as cofactors of their edges: another way than the hull's.
fn cofactor_normal<const N: usize>(points: &[Vector<N>], chosen: &[usize]) -> Option<Vector<N>> {
    let normal = Vector::from_fn(|axis| {
        let mut m = Matrix::ZERO;
        m[0] = Vector::<N>::unit(axis).0;
        for (row, &c) in chosen.iter().enumerate().skip(1) {
            m[row] = (points[c] - points[chosen[0]]).0;
        }
        m.determinant()
    });
    (normal.norm() > 1e-6).then(|| normal.normalize_or_zero())
}

/// Every facet of the hull as the set of all points in it: all hyperplanes through `N` points with no point beyond.
fn brute_force_facets<const N: usize>(points: &[Vector<N>]) -> BTreeSet<Vec<u32>> {
    let mut facets = BTreeSet::new();
    let mut chosen: Vec<usize> = (0..N).collect();
    loop {
        if let Some(normal) = cofactor_normal(points, &chosen) {
            let offset = normal.dot(points[chosen[0]]);
            let distances: Vec<f64> = points.iter().map(|p| normal.dot(*p) - offset).collect();
            let one_side = |sign: f64| distances.iter().all(|d| sign * d <= 1e-9);
            if one_side(1.0) || one_side(-1.0) {
                facets.insert((0..points.len() as u32).filter(|&i| distances[i as usize].abs() <= 1e-9).collect());
            }
        }
        // The next subset in lexicographic order.
        let Some(last) = (0..N).rev().find(|&k| chosen[k] < points.len() - N + k) else {
            return facets;
        };
        chosen[last] += 1;
        for k in last + 1..N {
            chosen[k] = chosen[k - 1] + 1;
        }
    }
}

/// The points that are vertices, duplicates once: those that are alone in all the facets that hold them.
fn brute_force_vertices(facets: &BTreeSet<Vec<u32>>, count: usize, same: impl Fn(u32, u32) -> bool) -> Vec<u32> {
    let alone = |point: &u32| {
        let holding: Vec<&Vec<u32>> = facets.iter().filter(|f| f.contains(point)).collect();
        !holding.is_empty()
            && (0..count as u32).all(|other| {
                other == *point
                    || (same(other, *point) && other > *point)
                    || holding.iter().any(|facet| !facet.contains(&other))
            })
    };
    (0..count as u32).filter(alone).collect()
}

fn compare_with_brute_force<const N: usize>(points: &[Vector<N>]) {
    let expected = brute_force_facets(points);
    let result = hull::convex_hull(points);
    if expected.is_empty() || spans_less(points) {
        assert_eq!(result.unwrap_err().kind(), GeometryErrorKind::Flat);
        return;
    }
    let (polytope, used) = result.unwrap_or_else(|error| panic!("{error}: {points:?}"));
    let same = |a: u32, b: u32| points[a as usize] == points[b as usize];
    let vertices = brute_force_vertices(&expected, points.len(), same);
    assert_eq!(used, vertices, "vertices of {points:?}");
    let found: BTreeSet<Vec<u32>> =
        polytope.facets().iter().map(|f| f.vertices.iter().map(|&v| used[v as usize]).collect()).collect();
    let expected: BTreeSet<Vec<u32>> =
        expected.iter().map(|f| f.iter().copied().filter(|p| vertices.contains(p)).collect()).collect();
    assert_eq!(found, expected, "facets of {points:?}");
    assert_eq!(found.len(), polytope.facets().len());
    check_incidences(&polytope);
}

/// Whether the points lie in a hyperplane, by the Gram determinant.
fn spans_less<const N: usize>(points: &[Vector<N>]) -> bool {
    let centre = points.iter().fold(Vector::ZERO, |sum, &p| sum + p) / points.len() as f64;
    let mut gram = Matrix::<N>::ZERO;
    for &p in points {
        gram += Matrix::outer(p - centre, p - centre);
    }
    gram.determinant() < 1e-9
}

/// Neighbours, edges and planes by their definitions.
fn check_incidences<const N: usize>(polytope: &Polytope<N>) {
    let facets = polytope.facets();
    let extent = polytope.bounding_radius();
    for (index, facet) in facets.iter().enumerate() {
        assert!((facet.normal.norm() - 1.0).abs() < 1e-14);
        for (v, &vertex) in polytope.vertices().iter().enumerate() {
            let distance = facet.normal.dot(vertex) - facet.offset;
            if facet.vertices.contains(&(v as u32)) {
                assert!(distance.abs() < 1e-9 * extent, "vertex {v} is {distance} off facet {index}");
                assert!(polytope.facets_of_vertex(v).contains(&(index as u32)));
            } else {
                assert!(distance < -1e-9 * extent, "vertex {v} is {distance} off facet {index}");
            }
        }
        for (other, second) in facets.iter().enumerate() {
            let shared: Vec<u32> = facet.vertices.iter().copied().filter(|v| second.vertices.contains(v)).collect();
            let ridge = other != index && affine_dimension(polytope, &shared) == Some(N - 2);
            assert_eq!(facet.neighbours.contains(&(other as u32)), ridge, "facets {index} and {other}");
        }
    }
    for v in 0..polytope.vertices().len() {
        for w in 0..polytope.vertices().len() {
            let shared: Vec<usize> = (0..facets.len())
                .filter(|&f| [v, w].iter().all(|&x| facets[f].vertices.contains(&(x as u32))))
                .collect();
            let edge = v != w && rank(shared.iter().map(|&f| facets[f].normal)) == N - 1;
            assert_eq!(polytope.neighbours_of_vertex(v).contains(&(w as u32)), edge, "vertices {v} and {w}");
        }
    }
}

fn rank<const N: usize>(vectors: impl Iterator<Item = Vector<N>>) -> usize {
    let mut basis: Vec<Vector<N>> = Vec::new();
    for v in vectors {
        let mut rest = v.normalize_or_zero();
        for _ in 0..2 {
            for b in &basis {
                rest -= *b * b.dot(rest);
            }
        }
        if rest.norm() > 1e-6 {
            basis.push(rest.normalize_or_zero());
        }
    }
    basis.len()
}

fn affine_dimension<const N: usize>(polytope: &Polytope<N>, vertices: &[u32]) -> Option<usize> {
    let base = polytope.vertices()[*vertices.first()? as usize];
    Some(rank(vertices.iter().map(|&v| polytope.vertices()[v as usize] - base)))
}

fn random_points<const N: usize>() {
    let mut random = Random(N as u64);
    for round in 0..12 {
        let count = N + 1 + random.below(9);
        compare_with_brute_force::<N>(&random.points(count));
        compare_with_brute_force::<N>(&random.sphere_points(count));
        let mut doubled = random.points(N + 2);
        doubled.extend_from_within(..round % (N + 2));
        random.shuffle(&mut doubled);
        compare_with_brute_force::<N>(&doubled);
    }
}

#[test]
fn random_points_agree_with_brute_force() {
    random_points::<2>();
    random_points::<3>();
    random_points::<4>();
    random_points::<5>();
    random_points::<6>();
}

/// Points of a small grid: many coplanar, collinear, duplicate and flat sets.
fn lattice_points<const N: usize>() {
    let mut random = Random(100 + N as u64);
    for side in [2, 3, 4] {
        for _ in 0..15 {
            let count = N + 1 + random.below(8);
            let points: Vec<Vector<N>> = (0..count).map(|_| Vector::from_fn(|_| random.below(side) as f64)).collect();
            compare_with_brute_force(&points);
        }
    }
}

#[test]
fn lattice_points_agree_with_brute_force() {
    lattice_points::<2>();
    lattice_points::<3>();
    lattice_points::<4>();
    lattice_points::<5>();
    lattice_points::<6>();
}

fn shape_of<const N: usize>(points: &[Vector<N>]) -> (usize, Vec<usize>) {
    let polytope = Polytope::from_points(points).unwrap_or_else(|error| panic!("{error}"));
    let mut sizes: Vec<usize> = polytope.facets().iter().map(|f| f.vertices.len()).collect();
    sizes.sort_unstable();
    (polytope.vertices().len(), sizes)
}

/// Cubes, grids and cross-polytopes stay what they are, turned, moved, scaled, shuffled, doubled and shaken by noise.
fn known_polytopes<const N: usize>() {
    let mut random = Random(200 + N as u64);
    let cube_sizes = vec![1 << (N - 1); 2 * N];
    let cross_sizes = vec![N; 1 << N];
    let side = [0, 0, 12, 7, 5, 4, 3][N];
    for round in 0..6 {
        let turn = random.rotation::<N>();
        let scale = [1.0, 1e-3, 1e3, 1e-6, 1e6, 0.3][round];
        let shift = random.vector::<N>() * scale * [0.0, 1.0, 10.0, 1e3, 1e-3, 100.0][round];
        let place = |p: &Vector<N>| turn.rotate(*p) * scale + shift;
        let mut placed: Vec<Vector<N>> = cube().iter().map(place).collect();
        random.shuffle(&mut placed);
        assert_eq!(shape_of(&placed), (1 << N, cube_sizes.clone()));
        let mut placed: Vec<Vector<N>> = cross_polytope().iter().map(place).collect();
        placed.extend_from_within(..N);
        placed.push(shift);
        random.shuffle(&mut placed);
        assert_eq!(shape_of(&placed), (2 * N, cross_sizes.clone()));
        let noise = [0.0, 1e-12][round % 2] * scale;
        let mut placed: Vec<Vector<N>> = grid(side).iter().map(|p| place(p) + random.vector() * noise).collect();
        random.shuffle(&mut placed);
        let (vertices, sizes) = shape_of(&placed);
        assert_eq!((vertices, sizes.len()), (1 << N, 2 * N));
        assert_eq!(sizes, cube_sizes);
    }
}

#[test]
fn known_polytopes_survive_every_motion() {
    known_polytopes::<2>();
    known_polytopes::<3>();
    known_polytopes::<4>();
    known_polytopes::<5>();
    known_polytopes::<6>();
}

fn flat_sets<const N: usize>() {
    let mut random = Random(300 + N as u64);
    for dimension in 0..N {
        for noise in [0.0, 1e-12] {
            let basis: Vec<Vector<N>> = (0..dimension).map(|_| random.direction()).collect();
            let origin = random.vector::<N>() * 5.0;
            let points: Vec<Vector<N>> = (0..40)
                .map(|_| basis.iter().fold(origin, |p, &b| p + b * random.symmetric()) + random.vector() * noise)
                .collect();
            // A cloud of noise around one point is a small body, not a flat one.
            if dimension == 0 && noise > 0.0 {
                continue;
            }
            let error = Polytope::from_points(&points).unwrap_err();
            assert_eq!(error.kind(), GeometryErrorKind::Flat);
            assert!(error.to_string().contains(&format!("only {dimension} of {N}")), "{error}");
        }
    }
    let bad = |points: &[Vector<N>]| Polytope::from_points(points).unwrap_err().kind();
    assert_eq!(bad(&[]), GeometryErrorKind::BadCount);
    assert_eq!(bad(&random.points(N)), GeometryErrorKind::BadCount);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut points = random.points(N + 5);
        points[3][N - 1] = value;
        assert_eq!(bad(&points), GeometryErrorKind::BadNumber);
    }
    let huge: Vec<Vector<N>> = cube().iter().map(|p| *p * 1e308).collect();
    assert_eq!(Polytope::from_points(&huge).unwrap().facets().len(), 2 * N);
}

#[test]
fn flat_and_bad_points_are_refused() {
    flat_sets::<2>();
    flat_sets::<3>();
    flat_sets::<4>();
    flat_sets::<5>();
    flat_sets::<6>();
}
