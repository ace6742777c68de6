//! The layout of a term: its factors sorted into rows by leading and summed indices.

use super::arithmetic::{Factor, Term};
use super::{Paths, Role};
use std::ops::Range;

/// A term laid out in rows. The driver is read entry by entry; the partner is looked up by row.
pub(super) struct Laid<V> {
    pub driver: Rows<V>,
    pub partner: Option<Rows<V>>,
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
        let (mut driver, mut partner) = match term.factors.as_slice() {
            [one] => (one, None),
            [one, two] => (one, Some(two)),
            _ => return None,
        };
        if let Some(other) = partner
            && lead(other) > lead(driver)
        {
            (driver, partner) = (other, Some(driver));
        }
        // the pairs that join the factors, in the order of the driver's slots
        let shared: Vec<usize> = driver
            .roles
            .iter()
            .filter(|role| partner.is_some_and(|p| p.roles.contains(role)))
            .filter_map(|role| if let Role::Summed(pair) = role { Some(*pair) } else { None })
            .collect();
        let layout = Layout { n, outer, rank, shared: &shared, paths };
        let driver = Rows::new(driver, &layout);
        let partner = partner.map(|p| Rows::new(p, &layout));
        let empty =
            driver.entries.is_empty() || partner.as_ref().is_some_and(|p| p.entries.is_empty());
        (!empty).then_some(Laid { driver, partner, mirrored: term.mirrored })
    }

    /// The number of products of the term.
    pub fn products(&self) -> u64 {
        let Some(partner) = &self.partner else { return self.driver.entries.len() as u64 };
        let links = self.driver.links;
        let mut counts = std::collections::HashMap::new();
        for row in &self.driver.rows {
            *counts.entry(row % links).or_insert(0u64) += 1;
        }
        let met = partner.rows.iter().map(|row| counts.get(&(row % links)).copied().unwrap_or(0));
        met.fold(0, u64::saturating_add)
    }

    pub fn entries(&self) -> usize {
        self.driver.entries.len() + self.partner.as_ref().map_or(0, |p| p.entries.len())
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

/// Entries sorted by row; a row is the leading indices followed by the shared summed ones.
pub(super) struct Rows<V> {
    /// For each leading index of the result: the number of rows per step, if this factor has the index.
    pub spans: Vec<Option<u64>>,
    /// The number of combinations of values of the shared indices.
    pub links: u64,
    index: Index,
    /// A bit for each row, set if the row is not empty; `links` bits are padded to whole words. `None`
    /// if these are too many.
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
    /// The beginning of each group of `links` rows with equal leading indices, and the end of the last
    /// one.
    Groups(Vec<u32>),
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
        let mut span = links;
        for at in (0..outer).rev().filter(|&at| factor.roles.contains(&Role::Free(at))) {
            spans[at] = Some(span);
            span *= n;
        }
        let weight = |role: &Role| match role {
            Role::Free(at) if *at < outer => (spans[*at].unwrap_or(0), [0, 0]),
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
        let groups = span / links;
        let index = if span <= paths.direct_rows {
            Index::Rows(sort_by_counting(&mut order, 1, span))
        } else {
            order.sort_unstable_by_key(|&(row, _, at)| (row, at));
            if groups <= paths.direct_rows {
                Index::Groups(sort_by_counting(&mut order, links, groups))
            } else {
                Index::Sorted
            }
        };
        let words = links.div_ceil(64);
        let marked = !matches!(index, Index::Sorted)
            && groups.checked_mul(words).is_some_and(|all| all <= paths.marked_words);
        let occupied = marked.then(|| {
            let mut bits = vec![0; (groups * words) as usize];
            for &(row, _, _) in &order {
                let (group, link) = (row / links, row % links);
                bits[(group * words + link / 64) as usize] |= 1 << (link % 64);
            }
            bits
        });
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
    /// both, from the rows `row` here and `other` in the partner on.
    #[inline(always)]
    pub fn meet(
        &self,
        row: u64,
        partner: &Self,
        other: u64,
        mut f: impl FnMut(Range<usize>, Range<usize>),
    ) {
        let mut both = |link| f(self.range(row + link, 1), partner.range(other + link, 1));
        if let (Some(mine), Some(theirs)) = (&self.occupied, &partner.occupied) {
            let words = self.links.div_ceil(64);
            let word = |occupied: &[u64], row: u64, at: u64| {
                occupied[(row / self.links * words + at) as usize]
            };
            for at in 0..words {
                let mut bits = word(mine, row, at) & word(theirs, other, at);
                while bits != 0 {
                    both(at * 64 + u64::from(bits.trailing_zeros()));
                    bits &= bits - 1;
                }
            }
        } else {
            let mut at = self.range(row, self.links);
            while let Some(first) = at.next() {
                let link = self.rows[first] - row;
                both(link);
                at.start = self.range(row + link, 1).end;
            }
        }
    }

    /// The entries of `count` rows from `row` on.
    #[inline(always)]
    pub fn range(&self, row: u64, count: u64) -> Range<usize> {
        let within = |range: Range<usize>| {
            let rows = &self.rows[range.clone()];
            let from = range.start + rows.partition_point(|&r| r < row);
            from..range.start + rows.partition_point(|&r| r < row + count)
        };
        match &self.index {
            Index::Rows(starts) => {
                starts[row as usize] as usize..starts[(row + count) as usize] as usize
            }
            Index::Groups(starts) => {
                let first = (row / self.links) as usize;
                let last = (row + count).div_ceil(self.links) as usize;
                let range = starts[first] as usize..starts[last] as usize;
                if count.is_multiple_of(self.links) { range } else { within(range) }
            }
            Index::Sorted => within(0..self.rows.len()),
        }
    }
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

/// Sorts entries stably by steps of `stride` rows and returns the beginning of each step.
fn sort_by_counting(entries: &mut Vec<(u64, Place, u32)>, stride: u64, steps: u64) -> Vec<u32> {
    let step = |entry: &(u64, Place, u32)| match stride {
        1 => entry.0 as usize,
        _ => (entry.0 / stride) as usize,
    };
    // counted two places ahead, so that filling a step moves the beginning of the next one to its
    // final value
    let mut starts = vec![0u32; steps as usize + 2];
    entries.iter().for_each(|entry| starts[step(entry) + 2] += 1);
    for at in 2..starts.len() {
        starts[at] += starts[at - 1];
    }
    let mut sorted = vec![(0, [0, 0], 0); entries.len()];
    for entry in entries.iter() {
        let slot = &mut starts[step(entry) + 1];
        sorted[*slot as usize] = *entry;
        *slot += 1;
    }
    *entries = sorted;
    starts.truncate(steps as usize + 1);
    starts
}
