//! The kernel: sparse row products, gathered in a dense accumulator over the last two indices.
//!
//! Nested loops run over the leading indices of the result and skip values that no term can reach, so
//! the results are sorted. Of the two factors of a term, the one with more leading indices is read entry
//! by entry, and each entry is multiplied with the partner's row of equal summed indices.

use super::Paths;
use super::arithmetic::{Arithmetic, Term, Value};
use super::rows::{Entry, Laid, Place, Rows, sum};
use crate::threads;
use std::ops::Range;

/// The sum of `terms` in a dimension and of a rank: sorted keys and nonzero values.
pub(super) fn run<S: Value, A: Arithmetic<S>>(
    arithmetic: &A,
    terms: &[Term<A::Value>],
    (dimension, rank): (usize, usize),
    groups: &[Range<usize>],
    paths: &Paths,
) -> (Vec<u64>, Vec<S>) {
    let n = dimension as u64;
    let outer = rank.saturating_sub(2);
    let laid: Vec<Laid<A::Value>> =
        terms.iter().filter_map(|term| Laid::new(term, n, outer, rank, paths)).collect();
    let plan = Plan { n, outer, rank, groups, terms: &laid };
    let entries: usize = laid.iter().map(Laid::entries).sum();
    let (mut keys, mut values) = (Vec::new(), Vec::new());
    // memory that is reserved and not used costs nothing, growing does
    let products = laid.iter().filter(|_| outer > 0).map(Laid::products);
    let room = 2 * products.fold(0, u64::saturating_add).min(paths.reserved) as usize;
    if laid.is_empty() {
        // zero
    } else if outer == 0 || entries < paths.parallel_from || threads::count() == 1 {
        let mut walk = Walk::new(&plan, arithmetic);
        walk.keys.reserve(room);
        walk.values.reserve(room);
        walk.descend(0, 0, 0);
        (keys, values) = (walk.keys, walk.values);
    } else {
        keys.reserve(room);
        values.reserve(room);
        // In rounds, so that few results are stored twice. Each thread keeps its accumulator from round to round, for filling one
        // with zeros may take longer than a round.
        let walks = threads::States::new(|| Walk::new(&plan, arithmetic));
        let round = paths.round.max(1).saturating_mul(threads::count() as u64).min(n);
        for start in (0..n).step_by(round as usize) {
            let block = |walk: &mut Walk<S, A>, at: u64| {
                walk.enter(0, 0, 0, start + at);
                (std::mem::take(&mut walk.keys), std::mem::take(&mut walk.values))
            };
            let count = round.min(n - start);
            for block in threads::map(count, &walks, block) {
                keys.extend(block.0);
                values.extend(block.1);
            }
        }
    }
    keys.shrink_to_fit();
    values.shrink_to_fit();
    plan.groups_across()
        .fold((keys, values), |(keys, values), group| spread(keys, values, n, rank, group))
}

/// The input of a run.
struct Plan<'p, V> {
    n: u64,
    /// The number of leading indices, which are loops. The last ones, at most two, belong to the
    /// accumulator.
    outer: usize,
    rank: usize,
    groups: &'p [Range<usize>],
    terms: &'p [Laid<V>],
}

impl<V> Plan<'_, V> {
    /// The antisymmetric groups that include leading indices.
    fn groups_across(&self) -> impl Iterator<Item = &Range<usize>> {
        self.groups.iter().filter(|group| group.start < self.outer && group.len() > 1)
    }

    /// Whether the two indices of the accumulator are an antisymmetric group of their own.
    fn mirrors(&self) -> bool {
        self.groups.iter().any(|group| group.start == self.outer && group.len() == 2)
    }

    /// Whether index `at` must exceed the index before it.
    fn ascends(&self, at: usize) -> bool {
        self.groups.iter().any(|group| group.start < at && at < group.end)
    }
}

/// A term that is not zero for the chosen leading indices, with its current groups of rows.
#[derive(Clone, Copy)]
struct Alive {
    term: usize,
    driver: u64,
    partner: u64,
}

/// The loops over the leading indices, with the accumulator and the results.
struct Walk<'w, S, A: Arithmetic<S>> {
    plan: &'w Plan<'w, A::Value>,
    arithmetic: &'w A,
    /// The terms that are alive at each depth, stored one after the other.
    alive: Vec<Alive>,
    /// Empty where it is not filled.
    sums: Vec<A::Sum>,
    /// A bit for each of `sums`, set if it is filled, and the places of the filled ones.
    filled: Vec<u64>,
    touched: Vec<Place>,
    /// The values of one leaf, and the order in which they are stored: in each entry the place in
    /// the accumulator, then in 32 bits twice the number of the value, plus 1 if it is negated.
    finished: Vec<S>,
    order: Vec<u64>,
    keys: Vec<u64>,
    values: Vec<S>,
}

impl<'w, S: Value, A: Arithmetic<S>> Walk<'w, S, A> {
    fn new(plan: &'w Plan<'w, A::Value>, arithmetic: &'w A) -> Self {
        let inner = plan.n.pow((plan.rank - plan.outer) as u32) as usize;
        Walk {
            plan,
            arithmetic,
            // at first every term lives and no index is chosen
            alive: (0..plan.terms.len())
                .map(|term| Alive { term, driver: 0, partner: 0 })
                .collect(),
            sums: vec![A::Sum::default(); inner],
            filled: vec![0; inner.div_ceil(64)],
            touched: vec![],
            finished: vec![],
            order: vec![],
            keys: vec![],
            values: vec![],
        }
    }

    /// Runs over all values of the leading index `depth`, after the indices in `key`, for the terms in
    /// `alive` from `from` on.
    fn descend(&mut self, depth: usize, key: u64, from: usize) {
        if depth == self.plan.outer {
            return self.leaf(key, from);
        }
        let first = if self.plan.ascends(depth) { key % self.plan.n + 1 } else { 0 };
        for index in first..self.plan.n {
            self.enter(depth, key, from, index);
        }
    }

    /// Continues with one value of the leading index `depth` and the terms that stay alive.
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
            let laid = &self.plan.terms[term];
            if let Some(driver) = step(&laid.driver, driver)
                && let Some(partner) = step(&laid.partner, partner)
            {
                self.alive.push(Alive { term, driver, partner });
            }
        }
        if self.alive.len() > end {
            self.descend(depth + 1, key * self.plan.n + index, end);
            self.alive.truncate(end);
        }
    }

    /// Computes all components with fixed leading indices.
    fn leaf(&mut self, key: u64, from: usize) {
        let plan = self.plan;
        let bounds = Bounds::new(plan, key);
        for at in from..self.alive.len() {
            let Alive { term, driver, partner } = self.alive[at];
            let laid = &plan.terms[term];
            laid.driver.meet(driver, &laid.partner, partner, |mine, theirs| {
                let theirs = &laid.partner.entries[theirs];
                for Entry { place, lowest, value } in &laid.driver.entries[mine] {
                    if bounds.beyond(*lowest) {
                        continue;
                    }
                    for other in theirs {
                        let place = sum(*place, other.place);
                        if let Some((place, negative)) = bounds.admit(place, laid.mirrored) {
                            self.add_product(place, value, &other.value, negative);
                        }
                    }
                }
            });
        }
        self.collect(key);
    }

    #[inline(always)]
    fn add_product(&mut self, place: Place, a: &A::Value, b: &A::Value, negative: bool) {
        let at = place[0] as usize * self.plan.n as usize + place[1] as usize;
        let (word, bit) = (&mut self.filled[at / 64], 1u64 << (at % 64));
        if *word & bit == 0 {
            *word |= bit;
            self.touched.push(place);
        }
        self.arithmetic.add_product(&mut self.sums[at], a, b, negative);
    }

    /// Appends the accumulated components to the results, in the order of their indices.
    fn collect(&mut self, key: u64) {
        let (n, inner) = (self.plan.n, self.sums.len() as u64);
        let mirrors = self.plan.mirrors();
        for [a, b] in self.touched.drain(..) {
            let (a, b) = (u64::from(a), u64::from(b));
            let slot = a * n + b;
            self.filled[slot as usize / 64] &= !(1u64 << (slot % 64));
            // emptied now, because a sum of products keeps their values
            let sum = std::mem::take(&mut self.sums[slot as usize]);
            if let Some(value) = self.arithmetic.finish(&sum) {
                let number = (self.finished.len() as u64) << 1;
                self.finished.push(value);
                self.order.push((slot << 32) | number);
                if mirrors {
                    self.order.push(((b * n + a) << 32) | number | 1);
                }
            }
        }
        self.order.sort_unstable();
        self.keys.extend(self.order.iter().map(|entry| key * inner + (entry >> 32)));
        self.values.extend(self.order.drain(..).map(|entry| {
            let value = self.finished[(entry as u32 >> 1) as usize].clone();
            if entry & 1 == 1 { -value } else { value }
        }));
        self.finished.clear();
    }
}

/// The places of the accumulator that an antisymmetric result needs.
struct Bounds {
    /// The first inner index exceeds this.
    above: Option<u32>,
    /// The two inner indices ascend.
    pair: bool,
}

impl Bounds {
    fn new<V>(plan: &Plan<V>, key: u64) -> Self {
        let across = plan.outer > 0 && plan.ascends(plan.outer);
        Bounds {
            above: across.then(|| (key % plan.n) as u32),
            pair: plan.rank >= 2 && plan.ascends(plan.outer + 1),
        }
    }

    /// Whether no place with this smallest index is needed. It decides only if both indices belong to
    /// the antisymmetric group.
    #[inline(always)]
    fn beyond(&self, lowest: u32) -> bool {
        self.pair && self.above.is_some_and(|bound| lowest <= bound)
    }

    /// The place of a value, and whether it is added with the opposite sign; `None` if it is not
    /// needed. A mirrored value also represents its image.
    #[inline(always)]
    fn admit(&self, [first, second]: Place, mirrored: bool) -> Option<(Place, bool)> {
        let negative = mirrored && first > second;
        let place = if negative { [second, first] } else { [first, second] };
        let inside =
            (!self.pair || place[0] < place[1]) && self.above.is_none_or(|bound| place[0] > bound);
        inside.then_some((place, negative))
    }
}

/// Adds all permutations of the ascending indices in `group` with their signs, sorted.
fn spread<S: Value>(
    keys: Vec<u64>,
    values: Vec<S>,
    n: u64,
    rank: usize,
    group: &Range<usize>,
) -> (Vec<u64>, Vec<S>) {
    let place = |at: usize| n.pow((rank - 1 - at) as u32);
    let mut all: Vec<(u64, S)> = keys.into_iter().zip(values).collect();
    // insert the index `end` of the group at every place among those before it
    for end in group.start + 1..group.end {
        all.reserve_exact(all.len() * (end - group.start));
        for at in 0..all.len() {
            let (mut key, mut value) = all[at].clone();
            for left in (group.start..end).rev() {
                // exchange the indices `left` and `left + 1`
                let [p, q] = [place(left), place(left + 1)];
                let [a, b] = [p, q].map(|place| key / place % n);
                key = key - (a * p + b * q) + (b * p + a * q);
                value = -value;
                all.push((key, value.clone()));
            }
        }
    }
    // the keys are different
    all.sort_unstable_by_key(|(key, _)| *key);
    let mut sorted = (Vec::with_capacity(all.len()), Vec::with_capacity(all.len()));
    sorted.extend(all);
    sorted
}
