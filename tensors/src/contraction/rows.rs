//! The layout of a term: its factors sorted into rows by leading and summed indices.

use super::arithmetic::{Factor, Term};
use super::{Paths, Role};
use std::ops::Range;

/// A term laid out in rows. The driver is read entry by entry; the partner is looked up by row.
pub(super) struct Laid<V> {
    pub driver: Rows<V>,
    pub partner: Rows<V>,
    /// Whether the term also represents its mirror image.
    pub mirrored: bool,
}

impl<V: Clone> Laid<V> {
    /// `None` for a term with an empty factor.
    pub fn new(
        term: &Term<'_, V>,
        n: u64,
        outer: usize,
        rank: usize,
        paths: &Paths,
    ) -> Option<Self> {
        if term.factors.iter().any(|factor| factor.keys.is_empty()) {
            return None;
        }
        let lead = |factor: &Factor<V>| {
            factor.roles.iter().filter(|r| matches!(r, Role::Free(at) if *at < outer)).count()
        };
        let [mut driver, mut partner] = term.factors.each_ref();
        if lead(partner) > lead(driver) {
            std::mem::swap(&mut driver, &mut partner);
        }
        // the pairs that join the factors, in the order of the driver's slots
        let shared: Vec<usize> = driver
            .roles
            .iter()
            .filter(|role| partner.roles.contains(role))
            .filter_map(|role| if let Role::Summed(pair) = role { Some(*pair) } else { None })
            .collect();
        let layout = Layout { n, outer, rank, shared: &shared, paths };
        let [driver, partner] = [driver, partner].map(|factor| Rows::new(factor, &layout));
        let empty = driver.entries.is_empty() || partner.entries.is_empty();
        (!empty).then_some(Laid { driver, partner, mirrored: term.mirrored })
    }

    /// The number of products of the term.
    pub fn products(&self) -> u64 {
        let links = self.driver.links;
        let mut counts = std::collections::HashMap::new();
        for row in &self.driver.rows {
            *counts.entry(row % links).or_insert(0u64) += 1;
        }
        let met =
            self.partner.rows.iter().map(|row| counts.get(&(row % links)).copied().unwrap_or(0));
        met.fold(0, u64::saturating_add)
    }

    pub fn entries(&self) -> usize {
        self.driver.entries.len() + self.partner.entries.len()
    }
}

/// How the slots of a factor become a row and an offset in the accumulator.
struct Layout<'l> {
    n: u64,
    outer: usize,
    rank: usize,
    shared: &'l [usize],
    paths: &'l Paths,
}

/// Entries sorted by row; a row is the leading indices followed by the shared summed ones. The rows
/// with equal leading indices are a group.
pub(super) struct Rows<V> {
    /// For each leading index of the result: the number of groups per step, if this factor has the
    /// index.
    pub spans: Vec<Option<u64>>,
    /// The number of rows in a group: of combinations of values of the shared indices.
    links: u64,
    index: Index,
    /// A bit for each row, set if the row is not empty; `links` bits are padded to whole words, and
    /// an empty word follows. `None` if these are too many.
    occupied: Option<Vec<u64>>,
    /// The row of each entry, ascending.
    rows: Vec<u64>,
    pub entries: Vec<Entry<V>>,
}

/// The way to find the entries of a row. The entries are always sorted by row, and within one row
/// in the order of the tensor.
enum Index {
    /// The beginning of each row, and the end of the last one.
    Rows(Vec<u32>),
    /// The number of nonempty rows before each word of [`Rows::occupied`]; then the beginning of
    /// each nonempty row, and the end of the last one.
    Nonempty(Vec<u32>, Vec<u32>),
    /// By bisection.
    Sorted,
}

/// A component of a factor.
pub(super) struct Entry<V> {
    /// Its contribution to the indices of the accumulator.
    pub place: Place,
    /// The smallest accumulator index that it determines, for an early check of ascending indices.
    pub lowest: u32,
    pub value: V,
}

impl<V: Clone> Rows<V> {
    fn new(factor: &Factor<'_, V>, layout: &Layout) -> Self {
        let Layout { n, outer, rank, shared, paths } = *layout;
        let links = n.pow(shared.len() as u32);
        let mut spans = vec![None; outer];
        let mut groups = 1;
        for at in (0..outer).rev().filter(|&at| factor.roles.contains(&Role::Free(at))) {
            spans[at] = Some(groups);
            groups *= n;
        }
        let weight = |role: &Role| match role {
            Role::Free(at) if *at < outer => (spans[*at].unwrap_or(0) * links, [0, 0]),
            Role::Free(at) if at + 1 == rank => (0, [0, 1]),
            Role::Free(_) => (0, [1, 0]),
            Role::Summed(pair) => match shared.iter().rev().position(|s| s == pair) {
                Some(at) => (n.pow(at as u32), [0, 0]),
                None => (0, [0, 0]),
            },
        };
        let weights: Vec<_> = factor.roles.iter().map(weight).collect();
        let inside: Vec<(usize, usize)> = pairs_inside(factor.roles);
        let mut order: Vec<(u64, Place, u32)> = Vec::with_capacity(factor.keys.len());
        let mut digits = vec![0; factor.roles.len()];
        for (at, &key) in factor.keys.iter().enumerate() {
            let mut rest = key;
            for digit in digits.iter_mut().rev() {
                (*digit, rest) = (rest % n, rest / n);
            }
            if inside.iter().any(|&(a, b)| digits[a] != digits[b]) {
                continue;
            }
            let (mut row, mut place) = (0, [0, 0]);
            for (digit, &(r, p)) in digits.iter().zip(&weights) {
                row += digit * r;
                place = sum(place, p.map(|p| p * *digit as u32));
            }
            order.push((row, place, at as u32));
        }
        let words = groups.saturating_mul(links.div_ceil(64));
        let occupied = (words <= paths.marked_words).then(|| {
            let mut bits = vec![0u64; words as usize + 1];
            for &(row, _, _) in &order {
                let (word, bit) = position(row, links);
                bits[word] |= 1 << bit;
            }
            bits
        });
        let index = if groups * links <= paths.direct_rows {
            let rows = (groups * links) as usize;
            Index::Rows(sort_by_counting(&mut order, rows, |row| row as usize))
        } else if let Some(bits) = &occupied {
            let mut count = 0;
            let before: Vec<u32> = (bits.iter())
                .map(|word| {
                    count += word.count_ones();
                    count - word.count_ones()
                })
                .collect();
            let starts = sort_by_counting(&mut order, count as usize, |row| {
                let (word, bit) = position(row, links);
                number(&before, bits, word, bit)
            });
            Index::Nonempty(before, starts)
        } else {
            order.sort_unstable_by_key(|&(row, _, at)| (row, at));
            Index::Sorted
        };
        let first = factor.roles.contains(&Role::Free(outer));
        let second = factor.roles.contains(&Role::Free(outer + 1));
        let lowest = |[a, b]: Place| match (first && outer + 2 == rank, second) {
            (true, true) => a.min(b),
            (true, false) => a,
            (false, true) => b,
            (false, false) => u32::MAX,
        };
        Rows {
            spans,
            links,
            index,
            occupied,
            rows: order.iter().map(|e| e.0).collect(),
            entries: order
                .iter()
                .map(|&(_, place, at)| Entry {
                    place,
                    lowest: lowest(place),
                    value: factor.values[at as usize].clone(),
                })
                .collect(),
        }
    }

    /// Calls `f` with the entries of both factors for all values of the shared indices that occur in
    /// both, in the group `group` here and `other` in the partner.
    #[inline(always)]
    pub fn meet(
        &self,
        group: u64,
        partner: &Self,
        other: u64,
        mut f: impl FnMut(Range<usize>, Range<usize>),
    ) {
        let [row, other_row] = [group, other].map(|group| group * self.links);
        if let (Some(mine), Some(theirs)) = (&self.occupied, &partner.occupied) {
            let words = self.links.div_ceil(64) as usize;
            let [first, second] = [group, other].map(|group| group as usize * words);
            for at in 0..words {
                let mut bits = mine[first + at] & theirs[second + at];
                while bits != 0 {
                    let bit = bits.trailing_zeros();
                    let link = 64 * at as u64 + u64::from(bit);
                    let mine = self.marked(row + link, first + at, bit);
                    f(mine, partner.marked(other_row + link, second + at, bit));
                    bits &= bits - 1;
                }
            }
        } else {
            let mut at = self.groups(group, 1);
            while let Some(first) = at.next() {
                let link = self.rows[first] - row;
                let mine = self.range(row + link, 1);
                at.start = mine.end;
                f(mine, partner.range(other_row + link, 1));
            }
        }
    }

    /// The entries of a nonempty row, also given by its [`position`].
    #[inline(always)]
    fn marked(&self, row: u64, word: usize, bit: u32) -> Range<usize> {
        match (&self.index, &self.occupied) {
            (Index::Nonempty(before, starts), Some(bits)) => {
                let at = number(before, bits, word, bit);
                starts[at] as usize..starts[at + 1] as usize
            }
            _ => self.range(row, 1),
        }
    }

    /// The entries of `count` groups from `group` on.
    #[inline(always)]
    pub fn groups(&self, group: u64, count: u64) -> Range<usize> {
        match &self.index {
            Index::Nonempty(before, starts) => {
                let word = |group: u64| (group * self.links.div_ceil(64)) as usize;
                let start = |group: u64| starts[before[word(group)] as usize] as usize;
                start(group)..start(group + count)
            }
            _ => self.range(group * self.links, count * self.links),
        }
    }

    /// The entries of `count` rows from `row` on.
    #[inline(always)]
    fn range(&self, row: u64, count: u64) -> Range<usize> {
        let start = |row: u64| match &self.index {
            Index::Rows(starts) => starts[row as usize] as usize,
            _ => self.rows.partition_point(|&r| r < row),
        };
        start(row)..start(row + count)
    }
}

/// The word of [`Rows::occupied`] and the number of the bit in it that belong to a row.
#[inline(always)]
fn position(row: u64, links: u64) -> (usize, u32) {
    let (group, link) = (row / links, row % links);
    ((group * links.div_ceil(64) + link / 64) as usize, (link % 64) as u32)
}

/// The number of nonempty rows before a row.
#[inline(always)]
fn number(before: &[u32], bits: &[u64], word: usize, bit: u32) -> usize {
    (before[word] + (bits[word] & ((1 << bit) - 1)).count_ones()) as usize
}

/// The two indices of the accumulator (the first is 0 where the result has only one).
pub(super) type Place = [u32; 2];

#[inline(always)]
pub(super) fn sum(a: Place, b: Place) -> Place {
    [a[0] + b[0], a[1] + b[1]]
}

/// Pairs of slots within one factor that are summed with each other.
fn pairs_inside(roles: &[Role]) -> Vec<(usize, usize)> {
    let twin = |a: usize| (a + 1..roles.len()).find(|&b| roles[b] == roles[a]);
    (0..roles.len()).filter_map(|a| twin(a).map(|b| (a, b))).collect()
}

/// Sorts entries stably by the step of their row, out of `steps`, and returns the beginning of each
/// step and the end of the last one.
fn sort_by_counting(
    entries: &mut Vec<(u64, Place, u32)>,
    steps: usize,
    step: impl Fn(u64) -> usize,
) -> Vec<u32> {
    // counted two places ahead, so that filling a step moves the beginning of the next one to its
    // final value
    let mut starts = vec![0u32; steps + 2];
    entries.iter().for_each(|entry| starts[step(entry.0) + 2] += 1);
    for at in 2..starts.len() {
        starts[at] += starts[at - 1];
    }
    let mut sorted = vec![(0, [0, 0], 0); entries.len()];
    for entry in entries.iter() {
        let slot = &mut starts[step(entry.0) + 1];
        sorted[*slot as usize] = *entry;
        *slot += 1;
    }
    *entries = sorted;
    starts.truncate(steps + 1);
    starts
}
