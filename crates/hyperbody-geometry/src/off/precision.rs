//! How precise the coordinates of a file are, as far as its digits tell.
//!
//! Programs round what they write: to four decimals, to six digits, to single precision. A polytope that was convex and flat is so
//! after that to the unit of the last place only. But short numbers need not be rounded ones: 0.01 beside 50 is most likely meant.
//! So a file counts as rounded if at least half of its vertices use the last place, and that place is small against the body and behind
//! the point: whole numbers are taken for what they are, a grid of millimetres or so.

use super::OffFile;

/// Coordinates with a last place above this, in parts of the size, are taken for exact: a cube of ±1, or a floor of 50 m.
const COARSEST_PLACE: f64 = 1.001e-3;

/// Coordinates of at least so many digits, all of which are numbers of single precision, were such numbers before.
const SINGLE_PRECISION: f64 = 1e-6;

/// What arithmetic in double precision leaves of a body, in parts of its size: ten times what hulls allow.
const ROUNDING: f64 = 1e-9;

impl OffFile {
    /// How far a vertex may lie off the facets of the convex polytope that is meant, in metres: what the digits of the coordinates
    /// leave open, 1e-9 of half the extent at least.
    ///
    /// A vertex rounded by half a unit on each axis is off a plane by √N / 2 units at most, and so are the vertices which the
    /// plane is known from.
    #[must_use]
    pub fn convexity_tolerance(&self) -> f64 {
        let root = (self.dimension as f64).sqrt();
        self.last_place().map_or(0.0, |unit| unit * root).max(self.rounding())
    }

    /// What arithmetic leaves of a length, in metres. Far from the origin that is more.
    pub(super) fn rounding(&self) -> f64 {
        let (size, farthest) = self.half_extent();
        (ROUNDING * size).max(8.0 * f64::EPSILON * farthest)
    }

    /// The unit of the last place that the coordinates were rounded to, or `None` if they do not look rounded.
    pub(super) fn last_place(&self) -> Option<f64> {
        let (size, farthest) = self.half_extent();
        // Programs that write six digits write more places of small numbers.
        let large = |c: &&f64| c.abs() >= 0.1 * farthest;
        let finest = |vertex: &[f64]| vertex.iter().filter(large).filter_map(|&c| place(c)).min();
        let mut places: Vec<i32> = self.vertices.chunks(self.dimension).filter_map(finest).collect();
        places.sort_unstable();
        let used_by_half = *places.get(places.len().checked_sub(1)? / 2)?;
        let unit = 10_f64.powi(used_by_half);
        let single = || self.vertices.iter().all(|&c| c == f64::from(c as f32));
        let unit = if unit <= SINGLE_PRECISION * farthest && single() {
            unit.max(f64::from(f32::EPSILON) * farthest)
        } else {
            unit
        };
        (used_by_half < 0 && unit <= COARSEST_PLACE * size).then_some(unit)
    }

    /// Half the extent of the vertices, the largest over the axes, and the largest coordinate.
    pub(super) fn half_extent(&self) -> (f64, f64) {
        let mut range = vec![(f64::INFINITY, f64::NEG_INFINITY); self.dimension];
        for vertex in self.vertices.chunks(self.dimension) {
            for (range, &c) in range.iter_mut().zip(vertex) {
                *range = (range.0.min(c), range.1.max(c));
            }
        }
        let half = range.iter().map(|(low, high)| 0.5 * high - 0.5 * low).fold(0.0, f64::max);
        (half, self.vertices.iter().fold(0.0, |most, c| most.max(c.abs())))
    }
}

/// The decimal place of the last digit of the shortest number that reads as this one; none for zero.
fn place(value: f64) -> Option<i32> {
    let single = value as f32;
    let text = if f64::from(single) == value { format!("{single:e}") } else { format!("{value:e}") };
    let (digits, exponent) = text.split_once('e')?;
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    (value != 0.0).then_some(exponent.parse::<i32>().ok()? - decimals as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn last_place(coordinates: &[f64]) -> Option<f64> {
        OffFile::from_elements(2, coordinates.to_vec(), Vec::new()).last_place()
    }

    #[test]
    fn rounded_coordinates_are_told_from_short_ones() {
        let (sin, cos) = (0.7_f64.sin(), 0.7_f64.cos());
        let with = |round: &dyn Fn(f64) -> f64| last_place(&[sin, cos, -sin, cos, cos, sin, -cos, -sin].map(round));
        let decimals = |places: i32| move |c: f64| (c * 10_f64.powi(places)).round() / 10_f64.powi(places);
        assert_eq!(with(&decimals(4)), Some(1e-4));
        assert_eq!(with(&decimals(6)), Some(1e-6));
        assert!(with(&|c| f64::from(c as f32)).is_some_and(|unit| (5e-8..2e-7).contains(&unit)));
        assert!(with(&|c| c).is_some_and(|unit| unit < 1e-14));
        // Whole numbers, and a single vertex with many digits, round nothing.
        assert_eq!(last_place(&[1.0, 1.0, -1.0, 1.0, 0.0, -1.0]), None);
        assert_eq!(last_place(&[1.0, 1.0, -1.0, 1.0, 0.9997, -1.0]), None);
        assert_eq!(last_place(&[2471.0, 3618.0, -1927.0, 2002.0, 1.0, -3301.0]), None);
        assert_eq!(last_place(&[0.0, 0.0]), None);
    }
}
