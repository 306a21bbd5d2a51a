//! Volume, centre and second moments against a second hull that shares nothing with the crate's: points are put in one by one, each
//! joined to the facets that it sees ("beneath and beyond": M. Kallay, 1981), which fills the hull with simplices; and against the
//! sums over random sets of these simplices, which are bodies that are not convex.

use std::collections::HashMap;

use crate::common::Random;
use hyperbody_geometry::{MassProperties, Polytope};
use hyperbody_math::{Matrix, Vector};

/// What volumes, centres and moments may be off by, relative.
const LIMIT: f64 = 1e-9;

/// A facet of a hull that grows: its points, and the hyperplane through them with the normal outward.
struct Side<const N: usize> {
    corners: [u32; N],
    normal: Vector<N>,
    offset: f64,
}

fn without<const N: usize>(corners: &[u32; N], skip: usize) -> Vec<u32> {
    let mut rest: Vec<u32> = corners.iter().copied().enumerate().filter(|&(i, _)| i != skip).map(|(_, c)| c).collect();
    rest.sort_unstable();
    rest
}

/// The vector orthogonal to N − 1 others as long as the volume that they span: cofactors.
fn across<const N: usize>(edges: &[Vector<N>]) -> Vector<N> {
    Vector::from_fn(|axis| {
        let row = |i: usize| if i + 1 < N { edges[i] } else { Vector::unit(axis) };
        Matrix::from_columns(std::array::from_fn(row)).determinant()
    })
}

/// Simplices that fill the hull of points in general position, the first of which span space: each is a facet and what sees it.
pub(crate) fn simplices_of_hull<const N: usize>(points: &[Vector<N>]) -> Vec<Vec<u32>> {
    let middle = points[..=N].iter().fold(Vector::ZERO, |sum, &p| sum + p) / (N as f64 + 1.0);
    let side = |corners: [u32; N]| {
        let base = points[corners[0] as usize];
        let edges: Vec<Vector<N>> = corners[1..].iter().map(|&c| points[c as usize] - base).collect();
        let normal = across(&edges).normalize_or_zero();
        let normal = if normal.dot(middle - base) < 0.0 { normal } else { -normal };
        Side { corners, normal, offset: normal.dot(base) }
    };
    let first: Vec<u32> = (0..=N as u32).collect();
    let opposite = |skip: usize| std::array::from_fn(|i| first[if i < skip { i } else { i + 1 }]);
    let mut sides: Vec<Side<N>> = (0..=N).map(|skip| side(opposite(skip))).collect();
    let mut simplices = vec![first.clone()];
    for (index, &point) in points.iter().enumerate().skip(N + 1) {
        let (seen, kept): (Vec<_>, Vec<_>) = sides.into_iter().partition(|s| s.normal.dot(point) > s.offset);
        sides = kept;
        let mut rims: HashMap<Vec<u32>, usize> = HashMap::new();
        for facet in &seen {
            let mut simplex = facet.corners.to_vec();
            simplex.push(index as u32);
            simplices.push(simplex);
            (0..N).for_each(|skip| *rims.entry(without(&facet.corners, skip)).or_default() += 1);
        }
        for rim in rims.into_iter().filter(|(_, count)| *count == 1).map(|(rim, _)| rim) {
            sides.push(side(std::array::from_fn(|i| rim.get(i).copied().unwrap_or(index as u32))));
        }
    }
    simplices
}

/// By a rule of points, exact for polynomials of degree two: corners and centre of each simplex.
fn by_points<const N: usize>(points: &[Vector<N>], simplices: &[Vec<u32>]) -> MassProperties<N> {
    let n = N as f64;
    let (mut mass, mut first, mut second) = (0.0, Vector::ZERO, Matrix::ZERO);
    for simplex in simplices {
        let corners: Vec<Vector<N>> = simplex.iter().map(|&c| points[c as usize]).collect();
        let edges = Matrix::from_columns(std::array::from_fn(|i| corners[i + 1] - corners[0]));
        let content = edges.determinant().abs() / (1..=N).map(|k| k as f64).product::<f64>();
        let centre = corners.iter().fold(Vector::ZERO, |sum, &c| sum + c) / (n + 1.0);
        let at_corners = corners.iter().map(|&c| (c, content / ((n + 1.0) * (n + 2.0))));
        for (place, weight) in at_corners.chain([(centre, content * (n + 1.0) / (n + 2.0))]) {
            mass += weight;
            first += place * weight;
            second += Matrix::outer(place, place) * weight;
        }
    }
    let centre = first / mass;
    MassProperties { mass, centre, second_moments: second - Matrix::outer(centre, centre) * mass }
}

/// The largest relative difference: of volumes, of centres in parts of the body's radius of gyration, of second moments in parts of
/// the largest.
fn difference<const N: usize>(found: &MassProperties<N>, expected: &MassProperties<N>) -> f64 {
    let size = (expected.second_moments.trace() / expected.mass).sqrt();
    let moments = (found.second_moments - expected.second_moments).max_abs() / expected.second_moments.max_abs();
    (found.mass / expected.mass - 1.0).abs().max((found.centre - expected.centre).norm() / size).max(moments)
}

fn hulls<const N: usize>() {
    let mut random = Random(1400 + N as u64);
    let mut worst: f64 = 0.0;
    let mut largest = 0;
    // A hull of two hundred points in six dimensions has some ten thousand facets.
    for count in [N + 1, N + 2, N + 4, 25, 50, 100, 200] {
        for ball in [false, true] {
            let points = if ball { random.sphere_points(count) } else { random.points::<N>(count) };
            let simplices = simplices_of_hull(&points);
            let found = MassProperties::of_polytope(&Polytope::from_points(&points).unwrap());
            worst = worst.max(difference(&found, &by_points(&points, &simplices)));
            largest = largest.max(simplices.len());
        }
    }
    println!("{N}D hulls of up to 200 random points, {largest} simplices: worst relative error {worst:.1e}");
    assert!(worst < LIMIT, "{N}D: {worst:e}");
}

/// The surface of a set of simplices: facets of one of them alone, facing outward.
pub(crate) fn surface<const N: usize>(points: &[Vector<N>], simplices: &[Vec<u32>]) -> Vec<[u32; N]> {
    let mut sides: HashMap<Vec<u32>, Option<[u32; N]>> = HashMap::new();
    for simplex in simplices {
        for (skip, &apex) in simplex.iter().enumerate() {
            let mut corners: [u32; N] = std::array::from_fn(|i| simplex[if i < skip { i } else { i + 1 }]);
            let edges = corners.map(|c| points[c as usize] - points[apex as usize]);
            if Matrix::from_columns(edges).determinant() < 0.0 {
                corners.swap(0, 1);
            }
            let mut key = corners.to_vec();
            key.sort_unstable();
            sides.entry(key).and_modify(|side| *side = None).or_insert(Some(corners));
        }
    }
    let mut surface: Vec<[u32; N]> = sides.into_values().flatten().collect();
    surface.sort_unstable();
    surface
}

fn meshes<const N: usize>() {
    let mut random = Random(1500 + N as u64);
    let (mut worst, mut largest): (f64, usize) = (0.0, 0);
    for count in [N + 3, 20, 60] {
        let points = random.points::<N>(count);
        let all = simplices_of_hull(&points);
        for share in [30, 60, 90] {
            let mut some: Vec<Vec<u32>> = all.iter().filter(|_| random.below(100) < share).cloned().collect();
            if some.is_empty() {
                some.push(all[0].clone());
            }
            let surface = surface(&points, &some);
            let found = MassProperties::of_closed_boundary(&points, &surface).unwrap();
            worst = worst.max(difference(&found, &by_points(&points, &some)));
            largest = largest.max(surface.len());
        }
    }
    println!("{N}D closed meshes of up to {largest} simplices, not convex: worst relative error {worst:.1e}");
    assert!(worst < LIMIT, "{N}D: {worst:e}");
}

#[test]
fn hulls_of_random_points_agree_with_a_second_hull() {
    hulls::<2>();
    hulls::<3>();
    hulls::<4>();
    hulls::<5>();
    hulls::<6>();
}

#[test]
fn random_meshes_agree_with_the_simplices_they_bound() {
    meshes::<2>();
    meshes::<3>();
    meshes::<4>();
    meshes::<5>();
    meshes::<6>();
}
