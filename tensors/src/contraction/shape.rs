//! The shape of a result. Loops run over its leading indices, and its last two indices are places
//! of the accumulator.

use std::ops::Range;

/// The shape of a result.
#[derive(Clone, Copy)]
pub(super) struct Shape<'s> {
    /// The dimension.
    pub n: u64,
    /// The number of leading indices, over which loops run. The other indices, at most two, belong
    /// to the accumulator.
    pub outer: usize,
    pub rank: usize,
    /// The antisymmetric groups of indices.
    groups: &'s [Range<usize>],
    /// The number of bits of a column in a [`Place`].
    bits: u32,
}

/// A place in the accumulator: the column in the lower bits, and the row above them. The column is
/// the last index. The row is the index before it, or 0 if the result has only one index. The place
/// of a product is the sum of the contributions of its two factors.
pub(super) type Place = u32;

impl<'s> Shape<'s> {
    /// The shape of a result whose accumulator has at most 2^24 places.
    pub fn new(n: u64, rank: usize, groups: &'s [Range<usize>]) -> Self {
        let outer = rank.saturating_sub(2);
        let columns = if rank > 0 { n.max(1) } else { 1 };
        // each row consists of whole 64-bit words of bits
        let bits = columns.next_power_of_two().trailing_zeros().max(6);
        Shape { n, outer, rank, groups, bits }
    }

    /// The number of rows of the accumulator.
    pub fn rows(self) -> usize {
        if self.rank > 1 { self.n as usize } else { 1 }
    }

    /// The number of columns. It is the smallest power of two that suffices, but at least 64.
    pub fn columns(self) -> usize {
        1 << self.bits
    }

    /// The place of the index value 1 at the position `at` of the result. It is 0 if the position
    /// is a leading index.
    pub fn unit(self, at: usize) -> Place {
        match self.rank - at {
            1 => 1,
            2 => 1 << self.bits,
            _ => 0,
        }
    }

    /// The row and the column of a place.
    #[inline(always)]
    pub fn indices(self, place: Place) -> [u32; 2] {
        [place >> self.bits, place & ((1 << self.bits) - 1)]
    }

    /// The place with exchanged row and column.
    #[inline(always)]
    pub fn image(self, place: Place) -> Place {
        let [row, column] = self.indices(place);
        (column << self.bits) | row
    }

    /// The antisymmetric groups that contain leading indices.
    pub fn groups_across(self) -> impl Iterator<Item = &'s Range<usize>> {
        self.groups.iter().filter(move |group| group.start < self.outer && group.len() > 1)
    }

    /// Whether the two indices of the accumulator form a complete antisymmetric group.
    pub fn mirrors(self) -> bool {
        self.groups.iter().any(|group| group.start == self.outer && group.len() == 2)
    }

    /// Whether index `at` must exceed the index before it.
    pub fn ascends(self, at: usize) -> bool {
        self.groups.iter().any(|group| group.start < at && at < group.end)
    }

    /// Whether the row must be less than the column in the accumulator.
    pub fn ascends_inside(self) -> bool {
        self.rank > 1 && self.ascends(self.outer + 1)
    }

    /// The fraction of the index combinations whose first index is below `first`.
    pub fn share(self, first: u64) -> f64 {
        let together = self.groups.iter().find(|group| group.start == 0).map_or(1, Range::len);
        let rest = 1.0 - first.min(self.n) as f64 / self.n as f64;
        1.0 - rest.powi(together as i32)
    }
}
