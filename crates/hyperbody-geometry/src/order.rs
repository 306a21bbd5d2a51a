//! Orders of numbers and of lists of them.
//!
//! What is sorted by keys of its own type is sorted by code of its own, for every dimension: in a browser's module that adds up. Here
//! numbers are sorted, and the rest follows them.

/// The places of the values, by ascending value; equal ones in their order.
pub(crate) fn of_numbers(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    order
}

/// The places of the lists, as words are in a dictionary; equal ones in their order.
pub(crate) fn of_lists(lists: &[&[u32]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..lists.len()).collect();
    order.sort_by(|&a, &b| lists[a].cmp(lists[b]));
    order
}

/// The places of keys of `width` numbers, ascending by the first of these, then the second and so on; equal ones in their order.
pub(crate) fn of_keys(numbers: &[u64], width: usize) -> Vec<u32> {
    let key = |place: u32| &numbers[place as usize * width..][..width];
    let mut order: Vec<u32> = (0..(numbers.len() / width.max(1)) as u32).collect();
    order.sort_by(|&a, &b| key(a).cmp(key(b)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_ones_keep_their_order() {
        assert_eq!(of_numbers(&[2.0, -1.0, 2.0, 0.5]), [1, 3, 0, 2]);
        assert_eq!(of_lists(&[&[2], &[1, 5], &[1], &[2], &[]]), [4, 2, 1, 0, 3]);
        assert_eq!(of_keys(&[1, 2, 0, 9, 1, 1, 0, 9], 2), [1, 3, 2, 0]);
    }
}
