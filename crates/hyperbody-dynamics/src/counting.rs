//! Sorting by small keys, in time proportional to their number: colours of contacts, slots of bodies.

/// Buffers, kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Counting {
    starts: Vec<u32>,
    sorted: Vec<u32>,
}

/// Keys for each thing to sort from which comparing is faster than going through all keys.
const MANY_KEYS: usize = 16;

impl Counting {
    pub(crate) const fn new() -> Self {
        Self { starts: Vec::new(), sorted: Vec::new() }
    }

    /// Puts `order` into ascending order of its elements' keys, which are below `keys`; equal ones stay as they stand.
    pub(crate) fn sort(&mut self, order: &mut Vec<u32>, keys: usize, key: impl Fn(u32) -> usize) {
        if keys / MANY_KEYS > order.len() {
            // Few: by one function for all callers, whatever their keys.
            let key: &mut dyn FnMut(&u32) -> usize = &mut |&element| key(element);
            order.sort_by_key(key);
            return;
        }
        self.starts.clear();
        self.starts.resize(keys + 1, 0);
        for &element in &*order {
            self.starts[key(element) + 1] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.sorted.clear();
        self.sorted.resize(order.len(), 0);
        for &element in &*order {
            let place = &mut self.starts[key(element)];
            self.sorted[*place as usize] = element;
            *place += 1;
        }
        std::mem::swap(order, &mut self.sorted);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_as_comparing_does_and_leaves_equals_in_place() {
        let mut counting = Counting::default();
        for (count, keys) in [(0, 1), (1, 1), (5, 3), (1000, 7), (1000, 3000), (3, 5000)] {
            let key = |element: u32| (element as usize).wrapping_mul(2_654_435_761) % keys;
            let mut order: Vec<u32> = (0..count).map(|i| (i * 37) % 1009).collect();
            let mut expected = order.clone();
            expected.sort_by_key(|&element| key(element));
            counting.sort(&mut order, keys, key);
            assert_eq!(order, expected, "{count} elements, {keys} keys");
        }
    }
}
