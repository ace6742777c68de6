//! The sizes at which a contraction takes another path to the same result.

/// The sizes at which the kernel takes another path to the same result.
///
/// The defaults serve speed and memory. Tests set other values, so that small tensors enter
/// every path. No choice changes a result: exact values are equal, and floats are equal to the
/// last bit, because every path adds the products of a component in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paths {
    /// A factor with at most this many rows gets a table that says where each row begins. One with
    /// at most this many groups of rows (equal leading indices) gets a table of the groups. In any
    /// other factor, rows are found by bisection.
    pub direct_rows: u64,
    /// A table of rows or groups is joined by a bit for each row that is not empty, if the bits
    /// take at most this many words.
    pub marked_words: u64,
    /// With fewer components in the operands, the sum runs on one thread.
    pub parallel_from: usize,
    /// Room is reserved for at most this many components of the result (and doubled).
    pub reserved: u64,
    /// The most values of the last two indices of a result together. At most 2^24, the default: a
    /// larger number counts as that.
    pub places: u64,
    /// Sums run on machine integers if they provably stay within this bound. At most `i64::MAX`,
    /// the default: a larger number counts as that. With 0, all sums run in the ring.
    pub largest_integer: u64,
    /// The quotients of the numerators up to this one are computed once and kept.
    pub kept_quotients: u32,
}

impl Default for Paths {
    fn default() -> Self {
        Paths {
            direct_rows: 1 << 22,
            marked_words: 1 << 22,
            parallel_from: 4096,
            reserved: 1 << 21,
            places: MAX_PLACES,
            largest_integer: i64::MAX as u64,
            kept_quotients: 64,
        }
    }
}

/// The most places of the accumulator: dimension 4096, when it has two indices.
pub(super) const MAX_PLACES: u64 = 1 << 24;
