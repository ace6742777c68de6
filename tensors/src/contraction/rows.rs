//! The layout of a term. Its factors are sorted into rows by leading and summed indices.

use super::arithmetic::{Factor, Term};
use super::positions::{Digits, Position, beginnings, sort_by_counting};
use super::shape::{Place, Shape};
use super::{KernelThresholds, Role};
use crate::stop::checkpoint;
use std::ops::Range;

/// A term that is laid out in rows. The driver is the factor that is read entry by entry; the rows
/// of the partner are looked up.
pub(super) struct Laid<V> {
    pub driver: Rows<V>,
    pub partner: Rows<V>,
    /// Whether the term also represents its mirror image.
    pub mirrored: bool,
}

impl<V: Clone> Laid<V> {
    /// Lays out a term. Returns `None` if a factor is empty.
    pub fn new(term: &Term<'_, V>, shape: Shape, paths: &KernelThresholds) -> Option<Self> {
        if term.factors.iter().any(|factor| factor.keys.is_empty()) {
            return None;
        }
        let leads = |role: &&Role| matches!(role, Role::Free(at) if *at < shape.outer);
        let lead = |factor: &Factor<V>| factor.roles.iter().filter(leads).count();
        let [mut driver, mut partner] = term.factors.each_ref();
        if lead(partner) > lead(driver) {
            std::mem::swap(&mut driver, &mut partner);
        }
        // the summed pairs that join the factors, in the order of the slots of the driver
        let shared: Vec<usize> = driver
            .roles
            .iter()
            .filter(|role| partner.roles.contains(role))
            .filter_map(|role| if let Role::Summed(pair) = role { Some(*pair) } else { None })
            .collect();
        let ascends = shape.ascends_inside() && !term.mirrored;
        let links = shape.n.pow(shared.len() as u32);
        let words = |factor: &Factor<V>| {
            shape.n.pow(lead(factor) as u32).saturating_mul(links.div_ceil(64)).max(links)
        };
        let marked = words(driver).max(words(partner)) <= paths.marked_words;
        let layout =
            Layout { shape, shared: &shared, links, ascends, marked, tabled: paths.direct_rows };
        let [driver, partner] = [driver, partner].map(|factor| Rows::new(factor, &layout));
        let empty = driver.entries.is_empty() || partner.entries.is_empty();
        (!empty).then_some(Laid { driver, partner, mirrored: term.mirrored })
    }
}

/// The number of entries that are laid out between two checkpoints.
const MANY: usize = 1 << 12;

/// The map from the slots of a factor to rows, and to places of the accumulator.
struct Layout<'l> {
    shape: Shape<'l>,
    /// The summed pairs that join the factors.
    shared: &'l [usize],
    /// The number of combinations of the values of these pairs.
    links: u64,
    /// Whether the result needs only places at which the indices of the accumulator ascend.
    ascends: bool,
    /// Whether [`Index::Marked`] represents the rows.
    marked: bool,
    /// If there are at most this many rows, [`Starts::Every`] stores their beginnings.
    tabled: u64,
}

/// Entries that are sorted by row. Within a row, they are in the order of the tensor. The leading
/// indices (the group) and the summed indices (the link) identify a row.
pub(super) struct Rows<V> {
    /// For each leading index of the result: the number of groups by which the index advances in
    /// one step. `None` if this factor does not have the index.
    pub spans: Vec<Option<u64>>,
    index: Index,
    /// Bit masks for the row and the column of a place. All bits are set if the index comes from
    /// the other factor.
    pub undetermined: [u32; 2],
    pub entries: Vec<Entry<V>>,
}

/// The index by which the entries of a row are found.
enum Index {
    Marked(Marked),
    /// The group and the link of each entry, for bisection.
    Sorted(Vec<(u64, u64)>),
}

/// A bit for each row. It is set if the row is not empty.
struct Marked {
    bits: Vec<u64>,
    /// The number of words of bits for each group. The last word may have unused bits.
    words: usize,
    starts: Starts,
}

/// The positions in the list of entries at which rows begin.
enum Starts {
    /// The beginning of the row of each bit, followed by the end of the last row.
    Every(Vec<u32>),
    /// First the number of nonempty rows before each word, and the number of all nonempty rows.
    /// Then the beginning of each nonempty row, and the end of the last row.
    Nonempty(Vec<u32>, Vec<u32>),
}

/// A component of a factor.
pub(super) struct Entry<V> {
    /// The contribution of the entry to the place of a product.
    pub place: Place,
    pub value: V,
}

impl<V: Clone> Rows<V> {
    fn new(factor: &Factor<'_, V>, layout: &Layout) -> Self {
        let Layout { shape, shared, links, ascends, marked, .. } = *layout;
        let (n, has) = (shape.n, |at: usize| factor.roles.contains(&Role::Free(at)));
        let mut spans = vec![None; shape.outer];
        let mut groups = 1;
        for at in (0..shape.outer).rev().filter(|&at| has(at)) {
            spans[at] = Some(groups);
            groups *= n;
        }
        let weight = |role: &Role| match role {
            Role::Free(at) if *at < shape.outer => (spans[*at].unwrap_or(0), 0, 0),
            Role::Free(at) => (0, 0, shape.unit(*at)),
            Role::Summed(pair) => match shared.iter().rev().position(|s| s == pair) {
                Some(at) => (0, n.pow(at as u32), 0),
                None => (0, 0, 0),
            },
        };
        let weights: Vec<_> = factor.roles.iter().map(weight).collect();
        let [row, column] = [2, 1].map(|back| shape.rank >= back && has(shape.rank - back));
        let needed = |place: Place| {
            let [a, b] = shape.indices(place);
            !(ascends && row && column) || a < b
        };
        let mut order: Vec<Position> = Vec::with_capacity(factor.keys.len());
        let mut digits = Digits::new(n, factor.roles, &weights);
        for (at, &key) in factor.keys.iter().enumerate() {
            if at % MANY == 0 {
                checkpoint();
            }
            if let Some((group, link, place)) = digits.read(key).filter(|at| needed(at.2)) {
                order.push(Position { group, link, place, at: at as u32 });
            }
        }
        let index = if marked {
            sort_by_counting(&mut order, links, |position| position.link);
            checkpoint();
            sort_by_counting(&mut order, groups, |position| position.group);
            Index::Marked(Marked::new(&order, groups, links.div_ceil(64) as usize, layout.tabled))
        } else {
            order.sort_unstable_by_key(|position| (position.group, position.link, position.at));
            Index::Sorted(order.iter().map(|position| (position.group, position.link)).collect())
        };
        checkpoint();
        let entry = |position: &Position| Entry {
            place: position.place,
            value: factor.values[position.at as usize].clone(),
        };
        let undetermined = [row, column].map(|has| if has { 0 } else { u32::MAX });
        Rows { spans, index, undetermined, entries: order.iter().map(entry).collect() }
    }

    /// Calls `f` for all values of the shared indices that occur in both factors. The arguments of
    /// `f` are the entries of two rows, one in each factor. The rows belong to the group `group` of
    /// this factor, and to the group `other` of the partner.
    #[inline(always)]
    pub fn meet(
        &self,
        group: u64,
        partner: &Self,
        other: u64,
        mut f: impl FnMut(&[Entry<V>], &[Entry<V>]),
    ) {
        match (&self.index, &partner.index) {
            (Index::Marked(mine), Index::Marked(theirs)) => {
                let [first, second] = [group, other].map(|group| group as usize * mine.words);
                for at in 0..mine.words {
                    let mut both = mine.bits[first + at] & theirs.bits[second + at];
                    while both != 0 {
                        let bit = both.trailing_zeros();
                        let mine = &self.entries[mine.row(first + at, bit)];
                        f(mine, &partner.entries[theirs.row(second + at, bit)]);
                        both &= both - 1;
                    }
                }
            }
            (Index::Sorted(mine), Index::Sorted(theirs)) => {
                let mut rest = self.groups(group, 1);
                while let Some(start) = rest.next() {
                    let row = |rows: &[(u64, u64)], row: (u64, u64)| {
                        rows.partition_point(|&other| other < row)
                            ..rows.partition_point(|&other| other <= row)
                    };
                    let link = mine[start].1;
                    let mine = row(mine, (group, link));
                    rest.start = mine.end;
                    f(&self.entries[mine], &partner.entries[row(theirs, (other, link))]);
                }
            }
            _ => unreachable!("rows of both factors of a term are found in the same way"),
        }
    }

    /// The range of the entries of `count` groups, beginning with `group`.
    #[inline(always)]
    pub fn groups(&self, group: u64, count: u64) -> Range<usize> {
        let [start, end] = [group, group + count].map(|group| match &self.index {
            Index::Marked(marked) => marked.start(group as usize * marked.words),
            Index::Sorted(rows) => rows.partition_point(|row| row.0 < group),
        });
        start..end
    }
}

impl Marked {
    /// Builds the index. The entries must be sorted by group and link.
    fn new(entries: &[Position], groups: u64, words: usize, tabled: u64) -> Self {
        let row = |entry: &Position| entry.group * 64 * words as u64 + entry.link;
        let mut bits = vec![0u64; groups as usize * words];
        for entry in entries {
            bits[(row(entry) / 64) as usize] |= 1 << (row(entry) % 64);
        }
        let starts = if 64 * bits.len() as u64 <= tabled {
            Starts::Every(beginnings(entries.iter().map(row), 64 * bits.len() as u64))
        } else {
            let mut before = vec![0];
            before.extend(bits.iter().scan(0, |count, word| {
                *count += word.count_ones();
                Some(*count)
            }));
            let mut starts = vec![0];
            starts.extend(entries.chunk_by(|a, b| row(a) == row(b)).scan(0, |end, entries| {
                *end += entries.len() as u32;
                Some(*end)
            }));
            Starts::Nonempty(before, starts)
        };
        Marked { bits, words, starts }
    }

    /// The range of the entries of the row that belongs to a set bit.
    #[inline(always)]
    fn row(&self, word: usize, bit: u32) -> Range<usize> {
        let (number, starts) = match &self.starts {
            Starts::Every(starts) => (64 * word + bit as usize, starts),
            Starts::Nonempty(before, starts) => {
                let below = self.bits[word] & ((1 << bit) - 1);
                ((before[word] + below.count_ones()) as usize, starts)
            }
        };
        starts[number] as usize..starts[number + 1] as usize
    }

    /// The beginning of the first row in a word. If the word has no row, it is the beginning of the
    /// next row.
    #[inline(always)]
    fn start(&self, word: usize) -> usize {
        match &self.starts {
            Starts::Every(starts) => starts[64 * word] as usize,
            Starts::Nonempty(before, starts) => starts[before[word] as usize] as usize,
        }
    }
}
