//! Hulls of points whose noise has the size of the tolerance, or any other: always a polytope, never a wrong one.

use crate::common::{Random, cross_polytope, cube, grid};
use hyperbody_geometry::{GeometryErrorKind, MassProperties, Polytope, hull};
use hyperbody_math::Vector;

/// Point sets with many coplanar points, near-duplicates and points on edges.
fn bases<const N: usize>(random: &mut Random) -> Vec<Vec<Vector<N>>> {
    let prism = |sides: u32| {
        let lifted = cube::<N>().into_iter().filter(|c| c[0] > 0.0 && c[1] > 0.0);
        let turn = move |corner: Vector<N>| {
            (0..sides).map(move |k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(sides)).sin_cos();
                Vector::from_fn(|i| [cos, sin].get(i).copied().unwrap_or(corner[i]))
            })
        };
        lifted.flat_map(turn).collect::<Vec<Vector<N>>>()
    };
    let lattice = (0..15).map(|_| Vector::from_fn(|_| random.below(3) as f64)).collect();
    let simplex = random.points::<N>(N + 1);
    let mut on_edges = simplex.clone();
    on_edges.extend((0..12).map(|_| simplex[random.below(N + 1)].lerp(simplex[random.below(N + 1)], random.unit())));
    let mut clusters = random.points::<N>(N + 3);
    clusters.extend_from_within(..);
    let thin = cube().into_iter().map(|mut c: Vector<N>| {
        c[N - 1] *= 1e-6;
        c
    });
    vec![
        cube(),
        cross_polytope(),
        grid(if N < 4 { 4 } else { 2 }),
        prism(7),
        lattice,
        on_edges,
        clusters,
        thin.collect(),
    ]
}

fn check_polytope<const N: usize>(points: &[Vector<N>], polytope: &Polytope<N>) {
    let extent = 2.0 * polytope.translated(-polytope.vertex_mean()).bounding_radius();
    for facet in polytope.facets() {
        assert!(facet.vertices.len() >= N);
        for &point in points {
            assert!(facet.normal.dot(point) - facet.offset < 1e-7 * extent, "a point outside");
        }
        for &v in &facet.vertices {
            let height = facet.normal.dot(polytope.vertices()[v as usize]) - facet.offset;
            assert!(height.abs() < 1e-7 * extent, "a facet that is not flat");
        }
    }
    let lattice = polytope.face_lattice();
    let euler: i64 = lattice.face_counts().iter().rev().fold(0, |sum, &count| count as i64 - sum);
    assert_eq!(euler, if N.is_multiple_of(2) { 0 } else { 2 }, "{:?}", lattice.face_counts());
    for rank in 1..N {
        for face in lattice.faces(rank) {
            assert!(face.boundary.len() > rank);
        }
    }
    assert!(lattice.cofaces(N - 2).iter().all(|facets| facets.len() == 2));
}

fn noisy<const N: usize>() {
    let mut random = Random(900 + N as u64);
    for base in bases::<N>(&mut random) {
        let Ok(ideal) = Polytope::from_points(&base) else {
            continue;
        };
        let volume = MassProperties::of_polytope(&ideal).mass;
        let turn = random.rotation::<N>();
        for exponent in [-15, -13, -12, -11, -10, -9, -8, -6, -4] {
            let noise = 10_f64.powi(exponent);
            let mut points: Vec<Vector<N>> = base.iter().map(|p| turn.rotate(*p) + random.vector() * noise).collect();
            random.shuffle(&mut points);
            let polytope = Polytope::from_points(&points).unwrap_or_else(|e| panic!("noise {noise}: {e}: {points:?}"));
            check_polytope(&points, &polytope);
            // Moving the points by d changes the volume by at most surface times d, roughly; the bodies are of size one.
            let change = (MassProperties::of_polytope(&polytope).mass - volume).abs();
            assert!(change < 1e3 * (noise + 1e-9), "noise {noise} changes the volume {volume} by {change}");
        }
    }
}

#[test]
fn noise_of_any_size_leaves_a_polytope() {
    noisy::<2>();
    noisy::<3>();
    noisy::<4>();
    noisy::<5>();
    noisy::<6>();
}

/// Coordinates of low precision keep their facets where the tolerance is told.
fn told<const N: usize>() {
    let mut random = Random(950 + N as u64);
    let turn = random.rotation::<N>();
    let points: Vec<Vector<N>> = cube().iter().map(|c| turn.rotate(*c) + random.vector() * 1e-6).collect();
    let (polytope, used) = hull::convex_hull_within(&points, 1e-5).unwrap();
    assert_eq!((used.len(), polytope.facets().len()), (1 << N, 2 * N));
    for bad in [f64::NAN, 0.0, -1.0, 0.1] {
        assert_eq!(hull::convex_hull_within(&points, bad).unwrap_err().kind(), GeometryErrorKind::BadNumber);
    }
}

#[test]
fn coarse_tolerances_see_through_noise() {
    told::<2>();
    told::<3>();
    told::<4>();
    told::<5>();
    told::<6>();
}
