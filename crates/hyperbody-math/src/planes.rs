//! The coordinate planes of `N` dimensions in lexicographic order, and the names of axes and planes.

/// Names of the axes, in order.
pub const AXIS_NAMES: [char; 6] = ['x', 'y', 'z', 'w', 'v', 'u'];

/// Number of coordinate planes of `n` dimensions: n(n−1)/2.
#[must_use]
pub const fn count(n: usize) -> usize {
    n * (n - 1) / 2
}

/// Position of plane (i, j), i < j < n, in lexicographic order: (0,1), (0,2), …, (0,n−1), (1,2), …
#[must_use]
pub const fn index(n: usize, i: usize, j: usize) -> usize {
    i * (2 * n - i - 1) / 2 + (j - i - 1)
}

/// The coordinate planes (i, j), i < j, of `n` dimensions in lexicographic order.
pub fn all(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

/// Name of plane (i, j): `"xw"` for (0, 3).
#[must_use]
pub fn name(i: usize, j: usize) -> String {
    [AXIS_NAMES[i], AXIS_NAMES[j]].iter().collect()
}

/// The axis of a name among the first `n`, or `None`.
#[must_use]
pub fn axis_from_name(n: usize, name: char) -> Option<usize> {
    AXIS_NAMES[..n].iter().position(|&c| c == name)
}

/// The axes (i, j) of a plane name such as `"xw"` in `n` dimensions. A name in descending order such as `"wx"` gives
/// (3, 0): the same plane with the opposite sense. `None` for anything else.
#[must_use]
pub fn from_name(n: usize, name: &str) -> Option<(usize, usize)> {
    let mut letters = name.chars();
    let i = axis_from_name(n, letters.next()?)?;
    let j = axis_from_name(n, letters.next()?)?;
    (letters.next().is_none() && i != j).then_some((i, j))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn index_follows_the_lexicographic_order() {
        for n in 2..=6 {
            for (position, (i, j)) in all(n).enumerate() {
                assert_eq!(index(n, i, j), position);
            }
            assert_eq!(all(n).count(), count(n));
        }
    }

    #[test]
    fn names_survive_a_round_trip() {
        let names: Vec<String> = all(4).map(|(i, j)| name(i, j)).collect();
        assert_eq!(names, ["xy", "xz", "xw", "yz", "yw", "zw"]);
        assert_eq!(from_name(4, "wx"), Some((3, 0)));
        assert_eq!(from_name(3, "xw"), None);
        assert_eq!(from_name(4, "xx"), None);
    }
}
