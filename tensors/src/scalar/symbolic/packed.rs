//! Polynomials whose exponents are packed into one machine word. Sums of products and exact
//! quotients are computed in this form.
//!
//! All polynomials of one computation share a [`Layout`]. A monomial is a word. Every exponent has
//! enough bits for its largest value, and a guard bit above them. A product of monomials is
//! therefore a sum of words. Coefficients are integers of 128 bits. Sums of products are collected
//! in a hash table, and quotients are computed with a heap (M. Monagan and R. Pearce, *J. Symb.
//! Comp.* 46 (2011) 807-822).

use super::polynomial::{Residue, coordinate};
use crate::stop::checkpoint;
use num_traits::{One, PrimInt, Zero};
use polycore::Field;
use std::collections::BinaryHeap;

/// A word of packed exponents.
pub(super) trait Word: PrimInt + Send + Sync + 'static {
    /// A hash of the word. Only its high bits are used.
    fn hash(self) -> u64;
}

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Word for u64 {
    #[inline]
    fn hash(self) -> u64 {
        (self ^ (self >> 29)).wrapping_mul(GOLDEN)
    }
}

impl Word for u128 {
    #[inline]
    fn hash(self) -> u64 {
        let high = ((self >> 64) as u64).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (self as u64 ^ high ^ (high >> 31)).hash()
    }
}

/// The bits of each exponent in a word. The first variable has the highest bits.
pub(super) struct Layout {
    shifts: Vec<u32>,
    widths: Vec<u32>,
    /// The number of bits that are in use.
    pub bits: u32,
}

impl Layout {
    /// A layout for exponents up to `degrees`. Returns `None` if it needs more than 128 bits.
    pub fn new(degrees: &[u64]) -> Option<Self> {
        let mut bits = 0;
        let widths: Vec<u32> = degrees.iter().map(|d| 65 - d.leading_zeros()).collect();
        let mut shifts = vec![0; degrees.len()];
        for (shift, width) in shifts.iter_mut().zip(&widths).rev() {
            *shift = bits;
            bits += width;
            if bits > u128::BITS || *width > u32::BITS {
                return None;
            }
        }
        Some(Layout { shifts, widths, bits })
    }

    /// The number of variables.
    pub fn variables(&self) -> usize {
        self.shifts.len()
    }

    /// The word with these exponents, given as pairs `(variable, exponent)`.
    pub fn pack<K: Word>(&self, exponents: impl Iterator<Item = (usize, u32)>) -> K {
        let place =
            |(at, e): (usize, u32)| K::from(e).unwrap_or_else(K::zero) << self.shifts[at] as usize;
        exponents.map(place).fold(K::zero(), |word, e| word + e)
    }

    /// The exponent of a variable.
    pub fn exponent<K: Word>(&self, word: K, at: usize) -> u32 {
        let ones = (K::one() << self.widths[at] as usize) - K::one();
        ((word >> self.shifts[at] as usize) & ones).to_u32().unwrap_or(u32::MAX)
    }

    /// The word in which the guard bit of every exponent is set.
    fn guard<K: Word>(&self) -> K {
        let bits = self.shifts.iter().zip(&self.widths);
        bits.fold(K::zero(), |guard, (s, w)| guard | (K::one() << (s + w - 1) as usize))
    }

    /// The largest exponent of each variable.
    pub fn degrees<K: Word>(&self, terms: &[(K, i128)]) -> Vec<u32> {
        let largest = |at| terms.iter().map(|(word, _)| self.exponent(*word, at)).max();
        (0..self.shifts.len()).map(|at| largest(at).unwrap_or(0)).collect()
    }
}

/// A sum of terms in a hash table. Each monomial occurs once.
pub(super) struct Gathered<K> {
    words: Vec<K>,
    values: Vec<i128>,
    filled: usize,
}

impl<K: Word> Gathered<K> {
    /// An empty sum with memory for this number of terms.
    pub fn with_room(terms: usize) -> Self {
        let room = (2 * terms).clamp(8, 1 << 12).next_power_of_two();
        Gathered { words: vec![K::max_value(); room], values: vec![0; room], filled: 0 }
    }

    /// Adds the product `scale a b`.
    pub fn add_product(&mut self, scale: i128, a: &[(K, i128)], b: &[(K, i128)]) {
        let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
        for (word, value) in few {
            checkpoint();
            self.reserve(many.len());
            let value = scale * value;
            for (other, factor) in many {
                self.add(*word + *other, value * factor);
            }
        }
    }

    #[inline]
    fn add(&mut self, word: K, value: i128) {
        let mask = self.words.len() - 1;
        let mut at = (word.hash() >> (64 - mask.count_ones())) as usize;
        loop {
            if self.words[at] == word {
                self.values[at] += value;
                return;
            }
            // the word of all ones marks an empty slot, because the guard bits of monomials are
            // zero
            if self.words[at] == K::max_value() {
                self.words[at] = word;
                self.values[at] = value;
                self.filled += 1;
                return;
            }
            at = (at + 1) & mask;
        }
    }

    /// Reserves memory for this number of new terms.
    fn reserve(&mut self, terms: usize) {
        let needed = 2 * (self.filled + terms);
        if needed <= self.words.len() {
            return;
        }
        let room = needed.next_power_of_two();
        let old = std::mem::replace(
            self,
            Gathered { words: vec![K::max_value(); room], values: vec![0; room], filled: 0 },
        );
        for (word, value) in old.words.into_iter().zip(old.values) {
            if word != K::max_value() && value != 0 {
                self.add(word, value);
            }
        }
    }

    /// The nonzero terms, in descending order.
    pub fn sorted(self) -> Vec<(K, i128)> {
        let terms = self.words.into_iter().zip(self.values);
        let mut terms: Vec<_> =
            terms.filter(|(word, value)| *word != K::max_value() && *value != 0).collect();
        terms.sort_unstable_by(|(a, _), (b, _)| b.cmp(a));
        terms
    }
}

/// The error if a coefficient exceeds 128 bits.
#[derive(Debug)]
pub(super) struct Overflow;

/// The exact quotient `f / g` of two sums of terms, in descending order. Returns `None` if there is
/// a remainder. The sum `g` must be primitive, so that an exact quotient has integer coefficients.
pub(super) fn exact<K: Word>(
    layout: &Layout,
    f: &[(K, i128)],
    g: &[(K, i128)],
) -> Result<Option<Vec<(K, i128)>>, Overflow> {
    let Some(&(lead, unit)) = g.first() else { return Ok(None) };
    let (above, below) = (layout.degrees(f), layout.degrees(g));
    let bound = above.iter().zip(&below).map(|(above, below)| above.checked_sub(*below));
    let Some(bound) = bound.collect::<Option<Vec<u32>>>() else { return Ok(None) };
    if f.len() > CERTIFIED && certainly_indivisible(layout, (f, &above), (g, &below)) {
        return Ok(None);
    }
    let guard: K = layout.guard();
    let bound: K = layout.pack(bound.into_iter().enumerate());
    let less = |a: K, b: K| {
        let rest = (a | guard) - b;
        (rest & guard == guard).then(|| rest & !guard)
    };
    let mut quotient: Vec<(K, i128)> = Vec::new();
    // the heap contains, for each term of `g`, its next product with a known term of the quotient
    let mut heap: BinaryHeap<(K, usize)> = BinaryHeap::new();
    let mut next = vec![0usize; g.len()];
    let mut waiting: Vec<usize> = (1..g.len()).collect();
    let mut input = f.iter().copied().peekable();
    loop {
        checkpoint();
        let above = input.peek().map(|(word, _)| *word);
        let Some(word) = above.max(heap.peek().map(|(word, _)| *word)) else {
            return Ok(Some(quotient));
        };
        let mut value = 0i128;
        if above == Some(word) {
            value = input.next().map_or(0, |(_, value)| value);
        }
        while let Some((_, at)) = heap.peek().copied().filter(|(top, _)| *top == word) {
            let product = g[at].1.checked_mul(quotient[next[at]].1).ok_or(Overflow)?;
            value = value.checked_sub(product).ok_or(Overflow)?;
            next[at] += 1;
            if let Some((other, _)) = quotient.get(next[at]) {
                if let Some(mut top) = heap.peek_mut() {
                    top.0 = g[at].0 + *other;
                }
            } else {
                heap.pop();
                waiting.push(at);
            }
        }
        if value == 0 {
            continue;
        }
        let Some(word) = less(word, lead).filter(|word| less(bound, *word).is_some()) else {
            return Ok(None);
        };
        if value % unit != 0 {
            return Ok(None);
        }
        // adds the terms of `g` that have waited for this term of the quotient
        for at in waiting.drain(..) {
            heap.push((g[at].0 + word, at));
        }
        quotient.push((word, value / unit));
    }
}

/// If the polynomial has fewer terms than this, the division is tried at once.
const CERTIFIED: usize = 64;

/// A quick proof that `g` does not divide `f`. All variables except one are replaced by numbers,
/// and the division fails modulo a prime. The result `false` proves nothing.
fn certainly_indivisible<K: Word>(
    layout: &Layout,
    (f, above): (&[(K, i128)], &[u32]),
    (g, below): (&[(K, i128)], &[u32]),
) -> bool {
    let free = (0..below.len()).filter(|&at| below[at] > 0).min_by_key(|&at| above[at]);
    let Some(free) = free else { return false };
    let powers = |(at, degree): (usize, &u32)| {
        let point = coordinate(at as u64 + 1);
        let next = |power: &Residue| Some(if at == free { *power } else { *power * point });
        std::iter::successors(Some(Residue::one()), next).take(*degree as usize + 1).collect()
    };
    let powers: Vec<Vec<Residue>> = above.iter().enumerate().map(powers).collect();
    let image = |terms: &[(K, i128)], degree: u32| {
        let mut image = vec![Residue::zero(); degree as usize + 1];
        for (word, value) in terms {
            let mut term = residue(*value);
            for (at, powers) in powers.iter().enumerate() {
                let e = layout.exponent(*word, at);
                if e > 0 && at != free {
                    term = term * powers[e as usize];
                }
            }
            let place = &mut image[layout.exponent(*word, free) as usize];
            *place = *place + term;
        }
        image
    };
    let divisor = image(g, below[free]);
    let Some(unit) = divisor.last().and_then(Field::inverse) else { return false };
    let mut rest = image(f, above[free]);
    while rest.len() >= divisor.len() {
        let Some(lead) = rest.pop() else { break };
        let from = rest.len() + 1 - divisor.len();
        let scale = lead * unit;
        for (value, factor) in rest[from..].iter_mut().zip(&divisor) {
            *value = *value - scale * *factor;
        }
    }
    rest.iter().any(|value| !value.is_zero())
}

fn residue(value: i128) -> Residue {
    let prime = i128::from((1u64 << 61) - 1);
    Residue::new((value % prime + prime) as u64)
}
