//! Factors of small symmetric positive matrices: K = L D Lᵀ, lower triangles by rows, with 1/D on the diagonal.

use super::panel::INDEPENDENT;

/// Numbers of a triangle of `count` rows.
pub(super) const fn len(count: usize) -> usize {
    count * (count + 1) / 2
}

/// Replaces a matrix by its factors.
pub(super) fn factorize(matrix: &mut [f64], count: usize) {
    for i in 0..count {
        let row = len(i);
        for j in 0..=i {
            let column = len(j);
            let mut value = matrix[row + j];
            for k in 0..j {
                // Entries left of the diagonal still hold L·D in this row, L in the rows above.
                value -= matrix[row + k] * matrix[column + k];
            }
            if j < i {
                matrix[row + j] = value;
            } else {
                let whole = matrix[row + i];
                let mut rest = whole;
                for k in 0..i {
                    let scaled = matrix[row + k] * matrix[len(k) + k];
                    rest -= scaled * matrix[row + k];
                    matrix[row + k] = scaled;
                }
                matrix[row + i] = if rest > INDEPENDENT * whole { 1.0 / rest } else { 0.0 };
            }
        }
    }
}

/// Solves K x = y in place.
pub(super) fn solve(factors: &[f64], count: usize, y: &mut [f64]) {
    for i in 0..count {
        for k in 0..i {
            y[i] -= factors[len(i) + k] * y[k];
        }
    }
    for i in (0..count).rev() {
        y[i] *= factors[len(i) + i];
        for k in i + 1..count {
            y[i] -= factors[len(k) + i] * y[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random symmetric positive matrices M Mᵀ: the solution put back gives the right side.
    #[test]
    fn solutions_fit_and_dependent_rows_get_nothing() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        for count in 1..=21 {
            let m: Vec<Vec<f64>> = (0..count).map(|_| (0..count + 2).map(|_| random()).collect()).collect();
            let k = |i: usize, j: usize| m[i].iter().zip(&m[j]).map(|(a, b)| a * b).sum::<f64>();
            let mut triangle: Vec<f64> =
                (0..count).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| k(i, j)).collect();
            factorize(&mut triangle, count);
            let right: Vec<f64> = (0..count).map(|_| random()).collect();
            let mut x = right.clone();
            solve(&triangle, count, &mut x);
            for i in 0..count {
                let back: f64 = (0..count).map(|j| k(i, j) * x[j]).sum();
                assert!((back - right[i]).abs() < 1e-9, "row {i} of {count}: {back} in place of {}", right[i]);
            }
        }
        // Twice the same row.
        let mut twin = [2.0, 2.0, 2.0];
        factorize(&mut twin, 2);
        let mut x = [4.0, 4.0];
        solve(&twin, 2, &mut x);
        assert_eq!(x, [2.0, 0.0]);
    }
}
