//! The kernel: sparse row products, gathered in a dense accumulator over the last two indices.
//!
//! The leading indices of the result are walked as nested loops that skip whatever no term can
//! reach, so results come out sorted. In a term of two factors, the one with more leading indices
//! is read entry by entry, and each entry meets its partner's rows of the same summed indices.

use super::{Product, Role};
use crate::{Ring, Sum, Tensor, Tolerance};
use rayon::prelude::*;
use std::ops::Range;

/// Row tables up to this many entries are addressed directly, larger ones by binary search.
const DIRECT_ROWS: u64 = 1 << 22;

/// Below this many operand entries, threads cost more than they save.
const PARALLEL_FROM: usize = 4096;

/// A term before it is laid out for a run.
pub(super) struct Term<V> {
    pub factors: Vec<Factor<V>>,
    pub mirrored: bool,
}

/// The entries of a tensor with the role of each slot.
pub(super) struct Factor<V> {
    pub roles: Vec<Role>,
    pub keys: Vec<u64>,
    pub values: Vec<V>,
}

/// How sums of products are formed: in the ring itself, or on machine integers.
pub(super) trait Arithmetic<S>: Sync {
    type Value: Clone + Send + Sync;
    type Sum: Clone + Send;
    fn empty(&self) -> Self::Sum;
    fn negate(&self, a: &Self::Value) -> Self::Value;
    fn term(&self, a: &Self::Value) -> Self::Sum;
    fn product(&self, a: &Self::Value, b: &Self::Value) -> Self::Sum;
    fn add_term(&self, sum: &mut Self::Sum, a: &Self::Value);
    fn add_product(&self, sum: &mut Self::Sum, a: &Self::Value, b: &Self::Value);
    fn finish(&self, sum: &Self::Sum) -> Option<S>;
}

/// Sums in the ring, by its own [`Sum`].
pub(super) struct InRing {
    tolerance: Tolerance,
}

impl InRing {
    pub fn new(tolerance: Tolerance) -> Self {
        InRing { tolerance }
    }

    /// The terms with the coefficient multiplied into the first factor.
    pub fn terms<S: Ring>(products: &[Product<S>]) -> Vec<Term<S>> {
        let term = |product: &Product<S>| {
            let coefficient = S::from_i64(product.coefficient);
            product.with_values(|at, tensor| {
                let scaled = |(_, v): (u64, &S)| match at {
                    0 if product.coefficient != 1 => v.clone() * &coefficient,
                    _ => v.clone(),
                };
                tensor.keyed().map(scaled).collect()
            })
        };
        products.iter().map(term).collect()
    }
}

impl<S: Ring> Arithmetic<S> for InRing {
    type Value = S;
    type Sum = S::Sum;
    fn empty(&self) -> S::Sum {
        S::Sum::term(&S::zero())
    }
    fn negate(&self, a: &S) -> S {
        -a.clone()
    }
    fn term(&self, a: &S) -> S::Sum {
        S::Sum::term(a)
    }
    fn product(&self, a: &S, b: &S) -> S::Sum {
        S::Sum::product(a, b)
    }
    fn add_term(&self, sum: &mut S::Sum, a: &S) {
        sum.add_term(a);
    }
    fn add_product(&self, sum: &mut S::Sum, a: &S, b: &S) {
        sum.add_product(a, b);
    }
    fn finish(&self, sum: &S::Sum) -> Option<S> {
        sum.finish(self.tolerance)
    }
}

/// Sums of machine integers over one denominator, which no sum of these terms can overflow.
pub(super) struct OnIntegers<S> {
    denominator: i64,
    /// The quotients of the numerators `1, 2, ...`, which most components repeat.
    small: Vec<Option<S>>,
}

impl<S: Ring> OnIntegers<S> {
    /// Clears the denominators of all terms, if the scalar can and the sums provably fit 64 bits.
    pub fn clear(
        products: &[Product<S>],
        dimension: usize,
    ) -> Option<(Self, Vec<Term<i64>>)> {
        let mut cleared = Vec::new();
        let mut denominator = 1i64;
        for product in products {
            let factors: Vec<(Vec<i64>, i64)> = product
                .factors
                .iter()
                .map(|(_, tensor)| S::clear_denominators(tensor.keyed().map(|(_, v)| v)))
                .collect::<Option<_>>()?;
            let d = factors.iter().try_fold(1i64, |d, (_, f)| d.checked_mul(*f))?;
            denominator = denominator.checked_mul(d / num_integer::gcd(d, denominator))?;
            cleared.push((factors, d));
        }
        let mut bound = 0u64;
        let mut terms = Vec::new();
        for (product, (mut factors, d)) in products.iter().zip(cleared) {
            let scale = product.coefficient.checked_mul(denominator / d)?;
            for value in &mut factors.first_mut()?.0 {
                *value = value.checked_mul(scale)?;
            }
            // products in one component: one for each value of the summed letters
            let summed = product.factors.iter().flat_map(|(roles, _)| roles);
            let pairs = summed.filter(|r| matches!(r, Role::Summed(_))).count() / 2;
            let entries = factors.iter().map(|(values, _)| values.len() as u64).max()?;
            let count = (dimension as u64).saturating_pow(pairs as u32).min(entries.saturating_mul(entries));
            let largest = |(values, _): &(Vec<i64>, i64)| {
                values.iter().map(|v| v.unsigned_abs()).max().unwrap_or(0)
            };
            let size = factors.iter().map(largest).try_fold(count, u64::checked_mul)?;
            bound = bound.checked_add(size)?;
            let mut values = factors.into_iter().map(|(values, _)| values);
            terms.push(product.with_values(|_, _| values.next().unwrap_or_default()));
        }
        let small = (1..=64).map(|n| S::from_quotient(n, denominator)).collect();
        (bound <= i64::MAX as u64).then_some((OnIntegers { denominator, small }, terms))
    }
}

impl<S: Ring> Arithmetic<S> for OnIntegers<S> {
    type Value = i64;
    type Sum = i64;
    fn empty(&self) -> i64 {
        0
    }
    fn negate(&self, a: &i64) -> i64 {
        -a
    }
    fn term(&self, a: &i64) -> i64 {
        *a
    }
    fn product(&self, a: &i64, b: &i64) -> i64 {
        a * b
    }
    fn add_term(&self, sum: &mut i64, a: &i64) {
        *sum += a;
    }
    fn add_product(&self, sum: &mut i64, a: &i64, b: &i64) {
        *sum += a * b;
    }
    fn finish(&self, sum: &i64) -> Option<S> {
        match (*sum, self.small.get((sum.unsigned_abs() as usize).wrapping_sub(1))) {
            (0, _) => None,
            (1.., Some(value)) => value.clone(),
            (_, Some(value)) => value.clone().map(|v| -v),
            _ => S::from_quotient(*sum, self.denominator),
        }
    }
}

/// Runs the sum of `terms` into the shape of `result`: sorted keys and nonzero values.
pub(super) fn run<S: Ring, A: Arithmetic<S>>(
    arithmetic: &A,
    terms: &[Term<A::Value>],
    result: &Tensor<S>,
    groups: &[Range<usize>],
) -> (Vec<u64>, Vec<S>) {
    let n = result.dimension() as u64;
    let rank = result.rank();
    let outer = rank.saturating_sub(2);
    let laid: Vec<Laid<A::Value>> =
        terms.iter().filter_map(|term| Laid::new(term, n, outer, rank, |v| arithmetic.negate(v))).collect();
    let plan = Plan { n, outer, rank, groups, terms: &laid };
    let entries: usize = laid.iter().map(Laid::entries).sum();
    let blocks: Vec<(Vec<u64>, Vec<S>)> = if laid.is_empty() {
        vec![]
    } else if outer == 0 || entries < PARALLEL_FROM || rayon::current_num_threads() == 1 {
        let mut walk = Walk::new(&plan, arithmetic);
        walk.descend(0, 0, 0);
        vec![(walk.keys, walk.values)]
    } else {
        let block = |walk: &mut Walk<S, A>, first: u64| {
            walk.enter(0, 0, 0, first);
            (std::mem::take(&mut walk.keys), std::mem::take(&mut walk.values))
        };
        (0..n).into_par_iter().map_init(|| Walk::new(&plan, arithmetic), block).collect()
    };
    let (mut keys, mut values) = (Vec::new(), Vec::new());
    for (block_keys, block_values) in blocks {
        if keys.is_empty() {
            (keys, values) = (block_keys, block_values);
        } else {
            keys.extend(block_keys);
            values.extend(block_values);
        }
    }
    plan.groups_across().fold((keys, values), |(keys, values), group| {
        spread(keys, values, n, rank, group)
    })
}

/// What a run works on.
struct Plan<'p, V> {
    n: u64,
    /// How many leading indices are loops; the rest (at most two) are the accumulator's.
    outer: usize,
    rank: usize,
    groups: &'p [Range<usize>],
    terms: &'p [Laid<V>],
}

impl<V> Plan<'_, V> {
    /// Antisymmetric runs that reach into the loops; a pair within the accumulator is spread there.
    fn groups_across(&self) -> impl Iterator<Item = &Range<usize>> {
        self.groups.iter().filter(|group| group.start < self.outer && group.len() > 1)
    }

    /// Whether the two indices of the accumulator are an antisymmetric run by themselves.
    fn mirrors(&self) -> bool {
        self.groups.iter().any(|group| group.start == self.outer && group.len() == 2)
    }

    /// Whether position `at` must exceed the position before it.
    fn ascends(&self, at: usize) -> bool {
        self.groups.iter().any(|group| group.start < at && at < group.end)
    }
}

/// A term that the chosen leading indices have not emptied, with the rows they lead to.
#[derive(Clone, Copy)]
struct Alive {
    term: usize,
    driver: u64,
    partner: u64,
}

/// A term laid out in rows: the factor that is read through, and the one that is looked up.
struct Laid<V> {
    driver: Rows<V>,
    /// The driver's values negated, for a term that stands for its mirror image too.
    negated: Option<Vec<V>>,
    partner: Option<Rows<V>>,
}

impl<V: Clone> Laid<V> {
    /// `None` for a term with an empty factor.
    fn new(
        term: &Term<V>,
        n: u64,
        outer: usize,
        rank: usize,
        negate: impl Fn(&V) -> V,
    ) -> Option<Self> {
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
        let layout = Layout { n, outer, rank, shared: &shared };
        let driver = Rows::new(driver, &layout);
        let partner = partner.map(|p| Rows::new(p, &layout));
        let empty = driver.values.is_empty() || partner.as_ref().is_some_and(|p| p.values.is_empty());
        let negated = term.mirrored.then(|| driver.values.iter().map(negate).collect());
        (!empty).then_some(Laid { driver, negated, partner })
    }

    fn entries(&self) -> usize {
        self.driver.values.len() + self.partner.as_ref().map_or(0, |p| p.values.len())
    }
}

/// How the slots of a factor become a row and an offset in the accumulator.
struct Layout<'l> {
    n: u64,
    outer: usize,
    rank: usize,
    shared: &'l [usize],
}

/// Entries sorted by row; a row is the leading indices followed by the shared summed ones.
struct Rows<V> {
    /// For each leading position of the result: how many rows one step of it spans, if it is here.
    spans: Vec<Option<u64>>,
    /// How many values the shared indices take together.
    links: u64,
    /// Where each row begins, when there are few enough rows.
    starts: Option<Vec<u32>>,
    /// With `starts`: a bit for each row that is not empty, `links` of them padded to whole words.
    occupied: Option<Vec<u64>>,
    rows: Vec<u64>,
    /// The share of each entry in the indices of the accumulator.
    places: Vec<Place>,
    /// The smallest accumulator index of each entry: what an ascending run is checked by first.
    lowest: Vec<u32>,
    values: Vec<V>,
}

impl<V: Clone> Rows<V> {
    fn new(factor: &Factor<V>, layout: &Layout) -> Self {
        let Layout { n, outer, rank, shared } = *layout;
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
        let inside: Vec<(usize, usize)> = pairs_inside(&factor.roles);
        let mut entries = Vec::with_capacity(factor.keys.len());
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
            entries.push((row, place, at));
        }
        let starts = (span <= DIRECT_ROWS).then(|| sort_by_counting(&mut entries, span));
        if starts.is_none() {
            entries.sort_unstable_by_key(|&(row, place, _)| (row, place));
        }
        let occupied = starts.is_some().then(|| {
            let words = links.div_ceil(64);
            let mut bits = vec![0; (span / links * words) as usize];
            for &(row, _, _) in &entries {
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
            starts,
            occupied,
            rows: entries.iter().map(|e| e.0).collect(),
            places: entries.iter().map(|e| e.1).collect(),
            lowest: entries.iter().map(|e| lowest(e.1)).collect(),
            values: entries.iter().map(|e| factor.values[e.2].clone()).collect(),
        }
    }

    /// Calls `f` with the entries of both sides for every value of the shared indices that
    /// neither side lacks, behind the leading indices `row` here and `other` there.
    #[inline(always)]
    fn meet(
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
    fn range(&self, row: u64, count: u64) -> Range<usize> {
        match &self.starts {
            Some(starts) => starts[row as usize] as usize..starts[(row + count) as usize] as usize,
            None => {
                let from = self.rows.partition_point(|&r| r < row);
                from..from + self.rows[from..].partition_point(|&r| r < row + count)
            }
        }
    }
}

/// The two indices of the accumulator (the first is 0 where the result has only one).
type Place = [u32; 2];

#[inline(always)]
fn sum(a: Place, b: Place) -> Place {
    [a[0] + b[0], a[1] + b[1]]
}

/// Slots of one factor that are summed with each other.
fn pairs_inside(roles: &[Role]) -> Vec<(usize, usize)> {
    let twin = |a: usize| (a + 1..roles.len()).find(|&b| roles[b] == roles[a]);
    (0..roles.len()).filter_map(|a| twin(a).map(|b| (a, b))).collect()
}

/// Sorts entries by their row, stably, and returns where each row begins.
fn sort_by_counting(entries: &mut Vec<(u64, Place, usize)>, rows: u64) -> Vec<u32> {
    let mut starts = vec![0u32; rows as usize + 1];
    entries.iter().for_each(|e| starts[e.0 as usize + 1] += 1);
    for row in 0..rows as usize {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let mut sorted = vec![(0, [0, 0], 0); entries.len()];
    for &entry in entries.iter() {
        let slot = &mut next[entry.0 as usize];
        sorted[*slot as usize] = entry;
        *slot += 1;
    }
    *entries = sorted;
    starts
}

/// The walk over the leading indices, with its accumulator and its results.
struct Walk<'w, S, A: Arithmetic<S>> {
    plan: &'w Plan<'w, A::Value>,
    arithmetic: &'w A,
    /// The terms alive at each depth, one run behind the other.
    alive: Vec<Alive>,
    sums: Vec<A::Sum>,
    /// A bit for each of `sums` that is filled, and the places of those.
    filled: Vec<u64>,
    touched: Vec<Place>,
    /// The components of one leaf, before they are in order.
    ready: Vec<(u64, S)>,
    keys: Vec<u64>,
    values: Vec<S>,
}

impl<'w, S: Ring, A: Arithmetic<S>> Walk<'w, S, A> {
    fn new(plan: &'w Plan<'w, A::Value>, arithmetic: &'w A) -> Self {
        let inner = plan.n.pow((plan.rank - plan.outer) as u32) as usize;
        Walk {
            plan,
            arithmetic,
            // at first every term lives and no index is chosen
            alive: (0..plan.terms.len()).map(|term| Alive { term, driver: 0, partner: 0 }).collect(),
            sums: vec![arithmetic.empty(); inner],
            filled: vec![0; inner.div_ceil(64)],
            touched: vec![],
            ready: vec![],
            keys: vec![],
            values: vec![],
        }
    }

    /// All values of the leading index `depth`, behind the indices in `key`, for the terms in
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

    /// One value of the leading index `depth`: goes on with the terms it leaves alive.
    fn enter(&mut self, depth: usize, key: u64, from: usize, index: u64) {
        let step = |rows: &Rows<A::Value>, row: u64| match rows.spans[depth] {
            Some(span) => {
                let row = row + index * span;
                (!rows.range(row, span).is_empty()).then_some(row)
            }
            None => Some(row),
        };
        let end = self.alive.len();
        for at in from..end {
            let Alive { term, driver, partner } = self.alive[at];
            let laid = &self.plan.terms[term];
            if let Some(driver) = step(&laid.driver, driver)
                && let Some(partner) = laid.partner.as_ref().map_or(Some(0), |p| step(p, partner))
            {
                self.alive.push(Alive { term, driver, partner });
            }
        }
        if self.alive.len() > end {
            self.descend(depth + 1, key * self.plan.n + index, end);
            self.alive.truncate(end);
        }
    }

    /// All components behind fixed leading indices.
    fn leaf(&mut self, key: u64, from: usize) {
        let plan = self.plan;
        let bounds = Bounds::new(plan, key);
        for at in from..self.alive.len() {
            let Alive { term, driver, partner } = self.alive[at];
            let laid = &plan.terms[term];
            let (rows, links) = (&laid.driver, laid.driver.links);
            let Some(partners) = &laid.partner else {
                for at in rows.range(driver, links) {
                    let negated = laid.negated.as_ref().map(|values| &values[at]);
                    let admitted = bounds.admit(rows.places[at], &rows.values[at], negated);
                    if let Some((place, value)) = admitted {
                        self.add(place, |a| a.term(value), |a, sum| a.add_term(sum, value));
                    }
                }
                continue;
            };
            rows.meet(driver, partners, partner, |mine, theirs| {
                for at in mine {
                    if bounds.above.is_some_and(|bound| rows.lowest[at] <= bound) {
                        continue;
                    }
                    let (place, value) = (rows.places[at], &rows.values[at]);
                    let negated = laid.negated.as_ref().map(|values| &values[at]);
                    for other in theirs.clone() {
                        let place = sum(place, partners.places[other]);
                        let factor = &partners.values[other];
                        if let Some((place, value)) = bounds.admit(place, value, negated) {
                            self.add(
                                place,
                                |a| a.product(value, factor),
                                |a, sum| a.add_product(sum, value, factor),
                            );
                        }
                    }
                }
            });
        }
        self.collect(key);
    }

    #[inline(always)]
    fn add(
        &mut self,
        place: Place,
        start: impl FnOnce(&A) -> A::Sum,
        add: impl FnOnce(&A, &mut A::Sum),
    ) {
        let at = place[0] as usize * self.plan.n as usize + place[1] as usize;
        let (word, bit) = (&mut self.filled[at / 64], 1u64 << (at % 64));
        if *word & bit != 0 {
            add(self.arithmetic, &mut self.sums[at]);
        } else {
            *word |= bit;
            self.sums[at] = start(self.arithmetic);
            self.touched.push(place);
        }
    }

    /// Moves the accumulated components, in order, behind the results so far.
    fn collect(&mut self, key: u64) {
        let mirrors = self.plan.mirrors();
        let (n, inner) = (self.plan.n, self.sums.len() as u64);
        for place in self.touched.drain(..) {
            let at = |[a, b]: Place| u64::from(a) * n + u64::from(b);
            let slot = at(place) as usize;
            self.filled[slot / 64] &= !(1u64 << (slot % 64));
            if let Some(value) = self.arithmetic.finish(&self.sums[slot]) {
                if mirrors {
                    self.ready.push((at([place[1], place[0]]), -value.clone()));
                }
                self.ready.push((at(place), value));
            }
        }
        self.ready.sort_unstable_by_key(|(offset, _)| *offset);
        for (offset, value) in self.ready.drain(..) {
            self.keys.push(key * inner + offset);
            self.values.push(value);
        }
    }
}

/// Which places of the accumulator an antisymmetric result needs.
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

    /// Where a value goes, and with which sign; `None` if nowhere. With `negated` the value stands
    /// for its mirror image too.
    #[inline(always)]
    fn admit<'v, V>(
        &self,
        [first, second]: Place,
        value: &'v V,
        negated: Option<&'v V>,
    ) -> Option<(Place, &'v V)> {
        let (place, value) = match negated {
            Some(negated) if first > second => ([second, first], negated),
            _ => ([first, second], value),
        };
        let inside = (!self.pair || place[0] < place[1])
            && self.above.is_none_or(|bound| place[0] > bound);
        inside.then_some((place, value))
    }
}

/// Every permutation of the ascending indices in `group`, with its sign, sorted.
fn spread<S: Ring>(
    keys: Vec<u64>,
    values: Vec<S>,
    n: u64,
    rank: usize,
    group: &Range<usize>,
) -> (Vec<u64>, Vec<S>) {
    let place = |at: usize| n.pow((rank - 1 - at) as u32);
    let mut all: Vec<(u64, S)> = keys.into_iter().zip(values).collect();
    // insert the k-th index of the group at every place among those before it
    for end in group.start + 1..group.end {
        let mut images = Vec::new();
        for (key, value) in &all {
            let digit = |at: usize| key / place(at) % n;
            let mut sign = S::one();
            for at in (group.start..end).rev() {
                sign = -sign;
                let moved: Vec<u64> = (at..=end)
                    .map(|p| if p == at { digit(end) } else { digit(p - 1) })
                    .collect();
                let old: u64 = (at..=end).map(|p| digit(p) * place(p)).sum();
                let new: u64 = (at..=end).zip(&moved).map(|(p, d)| d * place(p)).sum();
                images.push((key - old + new, value.clone() * &sign));
            }
        }
        all.extend(images);
    }
    all.sort_by_key(|(key, _)| *key);
    all.into_iter().unzip()
}
