//! Maps of stability over two spins or over two moments, computed in parallel.
//!
//! Each cell holds the verdict and growth rate of the eigenvalues and, beside it, the growth rate measured on the
//! linearised run. Cells are independent and land in a fixed order, so a map is the same for every number of threads.

use std::sync::atomic::{AtomicUsize, Ordering};

use hyperbody_math::{Bivector, planes};
use rayon::prelude::*;

use super::error::{FreeTopError, FreeTopErrorKind, Result, shown};
use super::growth::linearised_growth_rate;
use super::principal_rotation::PrincipalRotation;
use super::run::bad_span;
use super::stability::{Verdict, verdict_and_growth};
use super::top::FreeTop;

/// Most cells of a map.
pub const MAX_CELLS: usize = 16_000_000;

/// The values along one side of a map: `count` of them, evenly from `from` to `to`, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapRange {
    from: f64,
    to: f64,
    count: usize,
}

impl MapRange {
    /// The range from `from` to `to` with `count` ≥ 2 values.
    ///
    /// # Errors
    /// If the ends are not finite or not in order, or there are fewer than two values.
    pub fn new(from: f64, to: f64, count: usize) -> Result<Self> {
        if !(from.is_finite() && to.is_finite() && from < to && (2..=MAX_CELLS).contains(&count)) {
            return Err(bad_span(format!(
                "a map from {} to {} with {count} values; the ends must be finite and in order, and the values from 2 to \
                 {MAX_CELLS}",
                shown(from),
                shown(to)
            )));
        }
        Ok(Self { from, to, count })
    }

    /// Number of values.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Value `index`; the last for every index beyond.
    #[must_use]
    pub fn value(&self, index: usize) -> f64 {
        let t = index.min(self.count - 1) as f64 / (self.count - 1) as f64;
        // Exact at both ends.
        self.from * (1.0 - t) + self.to * t
    }
}

/// One cell of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCell {
    /// From the eigenvalues.
    pub verdict: Verdict,
    /// Largest real part of an eigenvalue, in 1/s.
    pub growth_rate: f64,
    /// Growth rate of the linearised run, in 1/s.
    pub measured_growth_rate: f64,
}

/// A map of stability.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityMap {
    /// Along the columns.
    pub x: MapRange,
    /// Along the rows.
    pub y: MapRange,
    /// Row by row: cell (column, row) is at row · columns + column.
    pub cells: Vec<MapCell>,
}

impl StabilityMap {
    /// The cell of a column and a row, or `None` beyond the map.
    #[must_use]
    pub fn cell(&self, column: usize, row: usize) -> Option<&MapCell> {
        (column < self.x.count).then(|| self.cells.get(row * self.x.count + column)).flatten()
    }
}

/// Map over the rates of two turning planes without common axes, x in the first and y in the second, in rad/s.
/// `progress(done, cells)` is called from any thread.
///
/// # Errors
/// If the planes share an axis or do not exist, or the map has more than [`MAX_CELLS`] cells.
pub fn map_spins<const N: usize>(
    top: &FreeTop<N>,
    [first, second]: [(usize, usize); 2],
    x: MapRange,
    y: MapRange,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<StabilityMap> {
    let axes = [first.0, first.1, second.0, second.1];
    let distinct = (0..4).all(|i| axes[i] < N && (0..i).all(|j| axes[i] != axes[j]));
    if !distinct {
        return Err(FreeTopError::new(
            FreeTopErrorKind::Spin,
            format!(
                "the planes {} and {} must have four different axes of {N} dimensions, such as xy and zw",
                plane_text(first),
                plane_text(second)
            ),
        ));
    }
    fill(x, y, progress, |a, b| {
        let spin = Bivector::plane(first.0, first.1, a) + Bivector::plane(second.0, second.1, b);
        cell(top, &spin)
    })
}

/// Map over the second moments of two axes, x of the first and y of the second, for a fixed steady spin in rad/s; the
/// other moments are those of `top`.
///
/// # Errors
/// If an axis does not exist, both are the same, the spin is not steady, a moment would be no body's, or the map has more
/// than [`MAX_CELLS`] cells.
pub fn map_moments<const N: usize>(
    top: &FreeTop<N>,
    [first, second]: [usize; 2],
    spin: &Bivector<N>,
    x: MapRange,
    y: MapRange,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<StabilityMap> {
    if first == second || first >= N || second >= N {
        return Err(bad_span(format!(
            "the moments of axes {} and {} were to vary; name two different axes of {N} dimensions",
            axis_text(first),
            axis_text(second)
        )));
    }
    if PrincipalRotation::new(spin)?.turns().is_empty() {
        return Err(FreeTopError::new(
            FreeTopErrorKind::Spin,
            "the body does not turn in any plane, so there is nothing to map; give a steady spin such as xw=1",
        ));
    }
    fill(x, y, progress, |a, b| {
        let mut moments = *top.principal_moments();
        (moments[first], moments[second]) = (a, b);
        cell(&FreeTop::new(moments)?, spin)
    })
}

fn axis_text(axis: usize) -> String {
    planes::AXIS_NAMES.get(axis).map_or_else(|| axis.to_string(), char::to_string)
}

fn plane_text((i, j): (usize, usize)) -> String {
    axis_text(i) + &axis_text(j)
}

fn cell<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Result<MapCell> {
    let rotation = PrincipalRotation::new(spin)?;
    let (verdict, growth_rate) = verdict_and_growth(top, &rotation);
    Ok(MapCell { verdict, growth_rate, measured_growth_rate: linearised_growth_rate(top, &rotation) })
}

fn fill(
    x: MapRange,
    y: MapRange,
    progress: &(dyn Fn(usize, usize) + Sync),
    cell: impl Fn(f64, f64) -> Result<MapCell> + Sync,
) -> Result<StabilityMap> {
    let total = x.count.saturating_mul(y.count);
    if total > MAX_CELLS {
        return Err(bad_span(format!("a map of {} × {} cells; at most {MAX_CELLS} are computed", x.count, y.count)));
    }
    let done = AtomicUsize::new(0);
    let rows: Result<Vec<Vec<MapCell>>> = (0..y.count)
        .into_par_iter()
        .map(|row| {
            let cells: Result<Vec<MapCell>> = (0..x.count).map(|column| cell(x.value(column), y.value(row))).collect();
            progress(done.fetch_add(x.count, Ordering::Relaxed) + x.count, total);
            cells
        })
        .collect();
    Ok(StabilityMap { x, y, cells: rows?.concat() })
}

/// The planes of `n` dimensions in pairs without common axes: three pairs in 4D.
#[must_use]
pub fn plane_pairs(n: usize) -> Vec<[(usize, usize); 2]> {
    let mut pairs = Vec::new();
    for first in planes::all(n) {
        for second in planes::all(n).filter(|&second| second > first) {
            let shared = first.0 == second.0 || first.0 == second.1 || first.1 == second.0 || first.1 == second.1;
            if !shared {
                pairs.push([first, second]);
            }
        }
    }
    pairs
}
