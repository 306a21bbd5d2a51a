//! The basis of the even subalgebra and its multiplication table, computed by the compiler.
//!
//! A basis blade e_i e_j … with i < j < … is a set of axes, kept as the bits of a number. Multiplying two blades cancels
//! the axes they share, which is an exclusive or, and gives a sign for every swap that sorts the rest.

/// Room for the 32 even blades of six dimensions.
const MAX: usize = 32;

/// The even blades of `N` ≤ 6 dimensions.
pub(super) struct Blades<const N: usize>;

/// `GATHER[a][k]` is the (slot, sign) of the one blade b for which blade a times blade b is the blade of slot k, and the
/// sign of that product.
type Gather = [[(u8, f64); MAX]; MAX];

impl<const N: usize> Blades<N> {
    /// How many there are: 2^(N−1).
    pub(super) const COUNT: usize = 1 << (N - 1);

    /// The axes of each slot's blade as bits: by grade, and within a grade in lexicographic order. Slot 0 is the scalar,
    /// slot 1 + p plane number p, so that slots 1..N are the planes (0, 1), (0, 2), …
    pub(super) const AXES: [usize; MAX] = {
        let mut axes = [0; MAX];
        let mut count = 0;
        let mut grade = 0;
        while grade <= N {
            // With axis 0 as the highest bit, lexicographic order of axis lists is descending order of numbers.
            let mut reversed = 1 << N;
            while reversed > 0 {
                reversed -= 1;
                let bits: usize = reversed;
                if bits.count_ones() as usize == grade {
                    axes[count] = bits.reverse_bits() >> (usize::BITS as usize - N);
                    count += 1;
                }
            }
            grade += 2;
        }
        axes
    };

    /// The multiplication table in the order that a product reads it.
    pub(super) const GATHER: Gather = {
        let mut table = [[(0, 0.0); MAX]; MAX];
        let mut a = 0;
        while a < Self::COUNT {
            let mut k = 0;
            while k < Self::COUNT {
                let b = Self::AXES[a] ^ Self::AXES[k];
                table[a][k] = (Self::slot(b) as u8, product_sign(Self::AXES[a], b));
                k += 1;
            }
            a += 1;
        }
        table
    };

    /// Number of axes of a slot's blade.
    pub(super) const fn grade(slot: usize) -> usize {
        Self::AXES[slot].count_ones() as usize
    }

    /// The slot of an even blade.
    const fn slot(axes: usize) -> usize {
        let mut slot = 0;
        while Self::AXES[slot] != axes {
            slot += 1;
        }
        slot
    }
}

/// The sign of blade a times blade b: one change for every axis of a that has to pass a smaller axis of b.
const fn product_sign(a: usize, b: usize) -> f64 {
    let mut higher = a >> 1;
    let mut swaps = 0;
    while higher != 0 {
        swaps += (higher & b).count_ones();
        higher >>= 1;
    }
    if swaps % 2 == 0 { 1.0 } else { -1.0 }
}
