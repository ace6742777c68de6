//! The kernel: products of sparse rows, collected in a dense accumulator over the last two indices.
//!
//! Nested loops run over the leading indices of the result and skip values that no term can reach,
//! so the results are sorted. The factor of a term with more leading indices is read entry by
//! entry. Each entry is multiplied with that row of the other factor that has the same summed
//! indices.

use super::KernelThresholds;
use super::accumulator::Accumulator;
use super::arithmetic::{Arithmetic, Term, Value};
use super::found::Found;
use super::rows::{Laid, Rows};
use super::shape::{Place, Shape};
use crate::stop::checkpoint;
use crate::threads;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// The sum of `terms`, for a result of this shape. Returns sorted keys and nonzero values.
pub(super) fn run<S: Value, A: Arithmetic<S>>(
    arithmetic: &A,
    terms: &[Term<A::Value>],
    (dimension, rank): (usize, usize),
    groups: &[Range<usize>],
    paths: &KernelThresholds,
) -> (Vec<u64>, Vec<S>) {
    let n = dimension as u64;
    let shape = Shape::new(n, rank, groups);
    let entries: usize =
        terms.iter().flat_map(|term| &term.factors).map(|factor| factor.keys.len()).sum();
    let parallel = entries >= paths.parallel_from && threads::count() > 1;
    let lay = |term| Laid::new(term, shape, paths);
    let laid: Vec<Laid<A::Value>> = if parallel {
        let lay = |(): &mut (), at: u64| lay(&terms[at as usize]);
        let laid = threads::map(terms.len() as u64, &threads::States::new(|| ()), lay);
        laid.into_iter().flatten().collect()
    } else {
        terms.iter().filter_map(lay).collect()
    };
    let walk = || Walk::new(shape, &laid, arithmetic);
    let found = if laid.is_empty() {
        Found::default()
    } else if parallel && shape.outer > 0 {
        in_rounds(shape, paths.round, walk)
    } else {
        walk().whole()
    };
    let spread = |(keys, values), group| spread(keys, values, n, rank, group);
    shape.groups_across().fold(found.into_lists(), spread)
}

/// Computes the components of all first indices on all threads. The computation consists of rounds
/// of about `size` components for each thread. While one round is computed, the previous round is
/// stored.
///
/// Each thread reuses its accumulator in all rounds, because filling an accumulator with zeros may
/// take longer than a round. The lists of a round are reused for the same reason.
fn in_rounds<'w, S: Value, A: Arithmetic<S, Value: 'w> + 'w>(
    shape: Shape,
    size: u64,
    walk: impl Fn() -> Walk<'w, S, A> + Sync,
) -> Found<S> {
    let (n, threads) = (shape.n, threads::count() as u64);
    let walks = threads::States::new(walk);
    let spare = Mutex::new(vec![]);
    let spare = || spare.lock().unwrap_or_else(PoisonError::into_inner);
    let (mut found, mut round) = (Found::default(), vec![]);
    let (mut start, mut count) = (0, threads.min(n));
    while start < n {
        let block = |walk: &mut Walk<S, A>, at: u64| {
            walk.found = spare().pop().unwrap_or_default();
            walk.enter(0, 0, 0, start + at);
            std::mem::take(&mut walk.found)
        };
        let store = || {
            round.iter_mut().for_each(|block| found.append(block));
            found.expect_more(shape.share(start), shape.share(start + count));
            spare().append(&mut round);
        };
        let compute = || threads::map(count, &walks, block);
        ((), round) = threads::join(store, compute);
        start += count;
        let known = found.len() + round.iter().map(Found::len).sum::<usize>();
        let enough = threads.saturating_mul(size).saturating_mul(start) / known.max(1) as u64;
        // limits the growth, because the next indices may have far more components than the indices
        // so far
        count = enough.clamp(threads, 4 * count.max(threads)).min(n - start);
    }
    round.iter_mut().for_each(|block| found.append(block));
    found
}

/// A term that does not vanish for the chosen leading indices, with the groups of rows at these
/// indices.
#[derive(Clone, Copy)]
struct Alive {
    term: usize,
    driver: u64,
    partner: u64,
}

/// The loops over the leading indices, with the accumulator and the results.
struct Walk<'w, S, A: Arithmetic<S>> {
    shape: Shape<'w>,
    terms: &'w [Laid<A::Value>],
    /// The terms that do not vanish at each depth. The lists of all depths are stored one after the
    /// other.
    alive: Vec<Alive>,
    accumulator: Accumulator<'w, A, A::Sum>,
    found: Found<S>,
}

impl<'w, S: Value, A: Arithmetic<S>> Walk<'w, S, A> {
    fn new(shape: Shape<'w>, terms: &'w [Laid<A::Value>], arithmetic: &'w A) -> Self {
        // all terms are alive at first, because no index is chosen
        let alive = (0..terms.len()).map(|term| Alive { term, driver: 0, partner: 0 }).collect();
        let accumulator = Accumulator::new(arithmetic, shape);
        Walk { shape, terms, alive, accumulator, found: Found::default() }
    }

    /// Computes the components for all indices.
    fn whole(mut self) -> Found<S> {
        if self.shape.outer == 0 {
            self.leaf(0, 0);
        } else {
            for index in 0..self.shape.n {
                self.enter(0, 0, 0, index);
                self.found.expect_more(self.shape.share(index + 1), self.shape.share(index + 2));
            }
        }
        self.found
    }

    /// Runs over all values of the leading index `depth`. The earlier indices are in `key`, and the
    /// terms are in `alive`, beginning at `from`.
    fn descend(&mut self, depth: usize, key: u64, from: usize) {
        if depth == self.shape.outer {
            return self.leaf(key, from);
        }
        let shape = self.shape;
        let first = if shape.ascends(depth) { key % shape.n + 1 } else { 0 };
        for index in first..shape.n {
            self.enter(depth, key, from, index);
        }
    }

    /// Continues with one value of the leading index `depth`, for the terms that do not vanish at
    /// this value.
    fn enter(&mut self, depth: usize, key: u64, from: usize, index: u64) {
        let step = |rows: &Rows<A::Value>, group: u64| match rows.spans[depth] {
            Some(span) => {
                let group = group + index * span;
                (!rows.groups(group, span).is_empty()).then_some(group)
            }
            None => Some(group),
        };
        let end = self.alive.len();
        for at in from..end {
            let Alive { term, driver, partner } = self.alive[at];
            let laid = &self.terms[term];
            if let Some(driver) = step(&laid.driver, driver)
                && let Some(partner) = step(&laid.partner, partner)
            {
                self.alive.push(Alive { term, driver, partner });
            }
        }
        if self.alive.len() > end {
            self.descend(depth + 1, key * self.shape.n + index, end);
            self.alive.truncate(end);
        }
    }

    /// Computes all components for fixed leading indices.
    fn leaf(&mut self, key: u64, from: usize) {
        checkpoint();
        let bounds = Bounds::new(self.shape, key);
        for &Alive { term, driver, partner } in &self.alive[from..] {
            let laid = &self.terms[term];
            let accumulator = &mut self.accumulator;
            let all = bounds.all() && !laid.mirrored;
            laid.driver.meet(driver, &laid.partner, partner, |mine, theirs| {
                if all {
                    for entry in mine {
                        for other in theirs {
                            let place = entry.place + other.place;
                            accumulator.add_product(place, &entry.value, &other.value, false);
                        }
                    }
                    return;
                }
                for entry in mine {
                    if bounds.beyond(entry.place, laid.driver.undetermined) {
                        continue;
                    }
                    for other in theirs {
                        let place = entry.place + other.place;
                        if let Some((place, negative)) = bounds.admit(place, laid.mirrored) {
                            accumulator.add_product(place, &entry.value, &other.value, negative);
                        }
                    }
                }
            });
        }
        self.accumulator.collect(key, &mut self.found);
    }
}

/// The places of the accumulator that are needed if the result is antisymmetric.
struct Bounds<'s> {
    shape: Shape<'s>,
    /// If set, the row must exceed this index.
    above: Option<u32>,
    /// Whether the column must exceed the row.
    pair: bool,
}

impl<'s> Bounds<'s> {
    fn new(shape: Shape<'s>, key: u64) -> Self {
        let across = shape.outer > 0 && shape.ascends(shape.outer);
        let above = across.then(|| (key % shape.n) as u32);
        Bounds { shape, above, pair: shape.ascends_inside() }
    }

    /// Whether the result needs all places.
    fn all(&self) -> bool {
        !self.pair && self.above.is_none()
    }

    /// Whether an entry contributes only to places that are not needed. The answer is `true` only
    /// if both indices belong to the antisymmetric group.
    #[inline(always)]
    fn beyond(&self, place: Place, undetermined: [u32; 2]) -> bool {
        let Some(bound) = self.above.filter(|_| self.pair) else { return false };
        let [row, column] = self.shape.indices(place);
        (row | undetermined[0]).min(column | undetermined[1]) <= bound
    }

    /// The place of a value, and whether the value is added with the opposite sign. Returns `None`
    /// if the place is not needed. A mirrored value also represents its image.
    #[inline(always)]
    fn admit(&self, place: Place, mirrored: bool) -> Option<(Place, bool)> {
        let [row, column] = self.shape.indices(place);
        let negative = mirrored && row > column;
        let (place, row, column) = match negative {
            true => (self.shape.image(place), column, row),
            false => (place, row, column),
        };
        let inside = (!self.pair || row < column) && self.above.is_none_or(|bound| row > bound);
        inside.then_some((place, negative))
    }
}

/// Adds the components for all permutations of the ascending indices in `group`, with their signs.
/// Returns sorted components.
fn spread<S: Value>(
    keys: Vec<u64>,
    values: Vec<S>,
    n: u64,
    rank: usize,
    group: &Range<usize>,
) -> (Vec<u64>, Vec<S>) {
    let place = |at: usize| n.pow((rank - 1 - at) as u32);
    let mut all: Vec<(u64, S)> = keys.into_iter().zip(values).collect();
    // inserts the index `end` of the group at every position among the earlier indices
    for end in group.start + 1..group.end {
        checkpoint();
        all.reserve_exact(all.len() * (end - group.start));
        for at in 0..all.len() {
            let (mut key, mut value) = all[at].clone();
            for left in (group.start..end).rev() {
                // exchanges the indices `left` and `left + 1`
                let [p, q] = [place(left), place(left + 1)];
                let [a, b] = [p, q].map(|place| key / place % n);
                key = key - (a * p + b * q) + (b * p + a * q);
                value = -value;
                all.push((key, value.clone()));
            }
        }
    }
    checkpoint();
    // an unstable sort suffices, because the keys are different
    all.sort_unstable_by_key(|(key, _)| *key);
    let mut sorted = (Vec::with_capacity(all.len()), Vec::with_capacity(all.len()));
    sorted.extend(all);
    sorted
}
