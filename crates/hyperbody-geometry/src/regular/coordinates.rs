//! Vertices of the regular polytopes in closed form (H. S. M. Coxeter, "Regular Polytopes", §8.7 and table V).

use std::f64::consts::PI;

use hyperbody_math::scalar;

/// The golden ratio, (1 + √5)/2.
const PHI: f64 = 1.618_033_988_749_895;

/// √5.
const ROOT_5: f64 = 2.236_067_977_499_79;

/// Regular n-simplex of circumradius one: the first vertex on +y, the opposite facet orthogonal to y below it, and so
/// on with x, z, w, … within that facet. In two dimensions a triangle that stands on an edge.
pub(super) fn simplex(n: usize) -> Vec<Vec<f64>> {
    let axis = |step: usize| [1, 0].get(step).copied().unwrap_or(step);
    // Circumradius of the face that is left after `step` vertices have been taken away.
    let radius = |step: usize| (((n + 1) * (n - step)) as f64 / (n * (n - step + 1)) as f64).sqrt();
    (0..=n)
        .map(|k| {
            let mut vertex = vec![0.0; n];
            for step in 0..n.min(k + 1) {
                vertex[axis(step)] = if step == k { radius(step) } else { -radius(step) / (n - step) as f64 };
            }
            vertex
        })
        .collect()
}

/// All (±1, …, ±1): facets orthogonal to the axes.
pub(super) fn cube(n: usize) -> Vec<Vec<f64>> {
    signs(&vec![1.0; n])
}

/// ±1 on every axis.
pub(super) fn cross_polytope(n: usize) -> Vec<Vec<f64>> {
    (0..2 * n)
        .map(|i| {
            let mut vertex = vec![0.0; n];
            vertex[i / 2] = if i % 2 == 0 { 1.0 } else { -1.0 };
            vertex
        })
        .collect()
}

/// Regular p-gon of circumradius one whose lowest edge is horizontal.
pub(super) fn polygon(p: usize) -> Vec<Vec<f64>> {
    (0..p)
        .map(|k| {
            let (sin, cos) = scalar::sin_cos(PI * (2 * k + 1) as f64 / p as f64);
            // Measured from −y, so that the first and the last vertex bound the lowest edge.
            vec![sin, -cos]
        })
        .collect()
}

/// Cyclic permutations of (0, ±1, ±φ).
pub(super) fn icosahedron() -> Vec<Vec<f64>> {
    cyclic([0.0, 1.0, PHI])
}

/// (±1, ±1, ±1) and the cyclic permutations of (0, ±1/φ, ±φ).
pub(super) fn dodecahedron() -> Vec<Vec<f64>> {
    let mut vertices = signs(&[1.0; 3]);
    // 1/φ = φ − 1. The order (0, φ, 1/φ) makes the two sets fit each other.
    vertices.extend(cyclic([0.0, PHI - 1.0, PHI]));
    vertices
}

/// Permutations of (±1, ±1, 0, 0): eight of the octahedra are orthogonal to the axes.
pub(super) fn cell_24() -> Vec<Vec<f64>> {
    permuted(&[1.0, 1.0, 0.0, 0.0], false)
}

/// (±2, 0, 0, 0) permuted, (±1, ±1, ±1, ±1), and the even permutations of (±φ, ±1, ±1/φ, 0).
pub(super) fn cell_600() -> Vec<Vec<f64>> {
    let mut vertices = permuted(&[2.0, 0.0, 0.0, 0.0], false);
    vertices.extend(signs(&[1.0; 4]));
    vertices.extend(permuted(&[PHI, 1.0, PHI - 1.0, 0.0], true));
    vertices
}

/// The dual of [`cell_600`]: eight of its dodecahedra are orthogonal to the axes.
pub(super) fn cell_120() -> Vec<Vec<f64>> {
    let (sq, inv, inv_sq) = (PHI + 1.0, PHI - 1.0, 2.0 - PHI);
    let mut vertices = permuted(&[2.0, 2.0, 0.0, 0.0], false);
    vertices.extend(permuted(&[ROOT_5, 1.0, 1.0, 1.0], false));
    vertices.extend(permuted(&[inv_sq, PHI, PHI, PHI], false));
    vertices.extend(permuted(&[sq, inv, inv, inv], false));
    vertices.extend(permuted(&[sq, 1.0, inv_sq, 0.0], true));
    vertices.extend(permuted(&[ROOT_5, PHI, inv, 0.0], true));
    vertices.extend(permuted(&[2.0, PHI, 1.0, inv], true));
    vertices
}

/// `magnitudes` with every choice of signs; zeros keep theirs.
fn signs(magnitudes: &[f64]) -> Vec<Vec<f64>> {
    let nonzero: Vec<usize> = (0..magnitudes.len()).filter(|&i| magnitudes[i] != 0.0).collect();
    (0_usize..1 << nonzero.len())
        .map(|choice| {
            let mut vertex = magnitudes.to_vec();
            for (bit, &i) in nonzero.iter().enumerate() {
                if choice >> bit & 1 == 1 {
                    vertex[i] = -vertex[i];
                }
            }
            vertex
        })
        .collect()
}

fn cyclic([a, b, c]: [f64; 3]) -> Vec<Vec<f64>> {
    [[a, b, c], [c, a, b], [b, c, a]].iter().flat_map(|v| signs(v)).collect()
}

/// Every choice of signs of all different permutations, or of the even ones only.
fn permuted(magnitudes: &[f64; 4], even_only: bool) -> Vec<Vec<f64>> {
    let mut arrangements: Vec<Vec<f64>> = Vec::new();
    for code in 0..256_usize {
        let order: [usize; 4] = std::array::from_fn(|i| code >> (2 * i) & 3);
        let inversions = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).filter(|&(i, j)| order[i] > order[j]);
        let permutation = (0..4).all(|i| order.contains(&i));
        if permutation && (!even_only || inversions.count() % 2 == 0) {
            let arrangement = order.map(|i| magnitudes[i]).to_vec();
            if !arrangements.contains(&arrangement) {
                arrangements.push(arrangement);
            }
        }
    }
    arrangements.iter().flat_map(|v| signs(v)).collect()
}
