//! Orders of a handful of numbers.

/// The indices 0 to N − 1 by descending value; equal ones ascend. By insertion: N is six at most.
pub(crate) fn descending<const N: usize>(value: impl Fn(usize) -> f64) -> [usize; N] {
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    for end in 1..N {
        let mut place = end;
        while place > 0 && value(order[place]).total_cmp(&value(order[place - 1])).is_gt() {
            order.swap(place, place - 1);
            place -= 1;
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::descending;

    #[test]
    fn orders_as_a_stable_sort_does() {
        let values = [0.0, -0.0, 2.5, f64::NAN, -1.0, 2.5];
        // All choices of six of these six.
        for choice in 0..6_usize.pow(6) {
            let chosen: [f64; 6] = std::array::from_fn(|place| values[choice / 6_usize.pow(place as u32) % 6]);
            let mut expected: [usize; 6] = std::array::from_fn(|i| i);
            expected.sort_by(|&i, &j| chosen[j].total_cmp(&chosen[i]));
            assert_eq!(descending(|i| chosen[i]), expected, "{chosen:?}");
        }
    }
}
