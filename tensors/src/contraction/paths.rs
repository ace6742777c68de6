//! The thresholds between the paths of a contraction.

/// The thresholds between the paths of the kernel. All paths lead to the same result.
///
/// The defaults are chosen for speed and memory. Tests set other values, so that small tensors use
/// every path. No threshold changes a result: exact values are equal, and floats are equal to the
/// last bit, because every path adds the products of a component in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelThresholds {
    /// If a factor has at most this many rows, a table stores the beginnings of its rows.
    pub direct_rows: u64,
    /// If a bit set of the nonempty rows of a factor needs at most this many 64-bit words, the
    /// factors of a term have such bit sets. Otherwise, rows are found by bisection.
    pub marked_words: u64,
    /// If the operands have fewer components than this, one thread computes the contraction.
    pub parallel_from: usize,
    /// The approximate number of components that each thread computes before all components are
    /// stored.
    pub round: u64,
    /// The largest number of places of the accumulator. For a result of rank 2 or more, this number
    /// is the square of the dimension. The default and maximum is 2^24; larger values count as
    /// 2^24.
    pub places: u64,
    /// Sums are computed in machine integers if it is proved that they do not exceed this bound.
    /// The default and maximum is `i64::MAX`. If the bound is 0, all sums are computed in the ring.
    pub largest_integer: u64,
    /// Sums beyond machine integers are computed in integers of any size over one denominator, if
    /// the denominator has more bits than this. If the value is `usize::MAX`, all these sums are
    /// computed in the ring.
    pub denominator_bits: usize,
    /// Quotients whose numerators have at most this magnitude are computed once and stored.
    pub kept_quotients: u32,
}

impl Default for KernelThresholds {
    fn default() -> Self {
        KernelThresholds {
            direct_rows: 1 << 22,
            marked_words: 1 << 22,
            parallel_from: 4096,
            round: 1 << 16,
            places: MAX_PLACES,
            largest_integer: i64::MAX as u64,
            denominator_bits: 62,
            kept_quotients: 64,
        }
    }
}

/// The largest number of places of the accumulator. With two indices, it corresponds to the
/// dimension 4096.
pub(super) const MAX_PLACES: u64 = 1 << 24;
