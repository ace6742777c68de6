//! The thresholds between the paths of a contraction.

/// The thresholds at which the kernel chooses another path to the same result.
///
/// The defaults are chosen for speed and memory. Tests set other values, so that small tensors take
/// every path. No threshold changes a result: exact values are equal, and floats are equal to the
/// last bit, because every path adds the products of a component in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelThresholds {
    /// A factor with at most this many rows gets a table of the beginnings of its rows.
    pub direct_rows: u64,
    /// The factors of a term get bit sets of their nonempty rows if a set takes at most this many
    /// 64-bit words. Otherwise rows are found by bisection.
    pub marked_words: u64,
    /// A contraction of operands with fewer components runs on one thread.
    pub parallel_from: usize,
    /// On several threads, each one computes about this many components before all are stored.
    pub round: u64,
    /// The largest number of places of the accumulator, which is the square of the dimension for a
    /// result of rank 2 or more. At most 2^24, the default; larger values count as 2^24.
    pub places: u64,
    /// Sums are computed in machine integers if they provably do not exceed this bound. At most
    /// `i64::MAX`, the default; larger values count as `i64::MAX`. With 0, all sums are computed in the
    /// ring.
    pub largest_integer: u64,
    /// Sums beyond machine integers are computed in integers of any size over one denominator, if it has more bits than this. With
    /// `usize::MAX`, all these sums are computed in the ring.
    pub denominator_bits: usize,
    /// Quotients with a numerator of at most this magnitude are computed once and stored.
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

/// The largest number of places of the accumulator: dimension 4096 if it has two indices.
pub(super) const MAX_PLACES: u64 = 1 << 24;
