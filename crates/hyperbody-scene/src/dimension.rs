//! From a dimension known at run time to one known at compile time: the one `match` of the whole project over 2..=6.

use std::ops::RangeInclusive;

use hyperbody::math::{Dim, EvenAlgebra};

/// The dimensions that scenes can have.
pub const DIMENSIONS: RangeInclusive<usize> = 2..=6;

/// Code that is generic over the dimension and run for one that is known only now: a closure cannot be generic, so the
/// code is a method, and what it captures are the fields of `self`.
pub trait DimensionVisitor {
    /// What the code gives.
    type Output;

    /// Runs the code in `N` dimensions.
    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra;
}

/// Runs `visitor` in `dimension` dimensions; `None` unless that is one of [`DIMENSIONS`].
pub fn visit_dimension<V: DimensionVisitor>(dimension: usize, visitor: V) -> Option<V::Output> {
    match dimension {
        2 => Some(visitor.visit::<2>()),
        3 => Some(visitor.visit::<3>()),
        4 => Some(visitor.visit::<4>()),
        5 => Some(visitor.visit::<5>()),
        6 => Some(visitor.visit::<6>()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Count;

    impl DimensionVisitor for Count {
        type Output = usize;
        fn visit<const N: usize>(self) -> usize {
            N
        }
    }

    #[test]
    fn the_dimension_arrives_in_the_type() {
        for dimension in 0..10 {
            let expected = DIMENSIONS.contains(&dimension).then_some(dimension);
            assert_eq!(visit_dimension(dimension, Count), expected);
        }
    }
}
