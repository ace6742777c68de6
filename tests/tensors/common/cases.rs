//! Random contractions: a text in index letters and the tensors that it names.

use crate::common::dual::Dual;
use affinor_tensors::{Down, Indices, Rational, Scalar, Tensor, Up, Variance};
use proptest::collection::vec;
use proptest::prelude::*;
use std::ops::Range;

/// A random contraction. The result is antisymmetric in its bracketed letters, because every term
/// occurs in all their orders, each with its sign.
#[derive(Clone, Debug)]
pub struct Case<S = Rational> {
    pub text: String,
    pub slots: Vec<Variance>,
    pub operands: Vec<(String, Tensor<S>)>,
}

impl<S> Case<S> {
    pub fn operands(&self) -> Vec<(&str, &Tensor<S>)> {
        self.operands.iter().map(|(name, tensor)| (name.as_str(), tensor)).collect()
    }
}

impl Case {
    /// The case with its operands mapped into another ring.
    pub fn mapped<S: Scalar>(&self, f: impl Fn(&[usize], &Rational) -> S) -> Case<S> {
        let operand = |t: &Tensor<Rational>| t.filter_map(|at, value| Some(f(at, value)));
        let operands = self.operands.iter().map(|(name, t)| (name.clone(), operand(t)));
        Case { text: self.text.clone(), slots: self.slots.clone(), operands: operands.collect() }
    }

    pub fn floats(&self) -> Case<f64> {
        self.mapped(|_, value| value.to_f64())
    }

    /// Dual numbers, exact if the values are integers; some have a zero real part.
    pub fn duals(&self) -> Case<Dual<true>> {
        self.mapped(|at, value| {
            let parity = at.iter().sum::<usize>() % 3;
            let real = if parity == 0 { 0.0 } else { value.to_f64() };
            Dual::new(real, value.to_f64() + parity as f64)
        })
    }
}

/// The kinds of numbers in the operands.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// Small integers: sums use machine integers, and are exact in floats too.
    Integers,
    /// Small fractions: sums use machine integers over one denominator.
    Fractions,
    /// Integers for which sums of products are near the limit of 64 bits.
    Words,
    /// Integers beyond 64 bits.
    Huge,
}

/// Contractions of rank 0 to 5 in dimension `0..=5`, and in 20 to 40 with few components.
#[allow(dead_code, reason = "each test takes what it needs")]
pub fn cases(values: Values) -> impl Strategy<Value = Case> {
    cases_of_ranks(0..6, values)
}

/// The same with results of these ranks, at most 8.
pub fn cases_of_ranks(ranks: Range<usize>, values: Values) -> impl Strategy<Value = Case> {
    vec(any::<u16>(), 600).prop_map(move |tape| {
        let mut choices = Choices(tape.into_iter());
        let dimension = match choices.below(8) {
            6 => 20 + choices.below(20),
            7 => 0,
            few => few.min(5),
        };
        let rank = ranks.start + choices.below(ranks.len());
        case(&mut choices, dimension, rank, values)
    })
}

/// The random choices, read from a tape that proptest can shrink.
struct Choices(std::vec::IntoIter<u16>);

impl Choices {
    /// A number below `bound`; 0 if the tape is at its end.
    fn below(&mut self, bound: usize) -> usize {
        usize::from(self.0.next().unwrap_or(0)) % bound
    }

    fn one_in(&mut self, chances: usize) -> bool {
        self.below(chances) == chances - 1
    }

    fn shuffle<T>(&mut self, items: &mut [T]) {
        for at in (1..items.len()).rev() {
            items.swap(at, self.below(at + 1));
        }
    }
}

/// A factor: the number of its operand, and its letters.
type Factor = (usize, Vec<(char, Variance)>);

fn case(choices: &mut Choices, dimension: usize, rank: usize, values: Values) -> Case {
    let groups = groups(choices, rank);
    let mut slots: Vec<Variance> = (0..rank).map(|_| variance(choices)).collect();
    for group in &groups {
        let first = slots[group.start];
        slots[group.clone()].fill(first);
    }
    let free: Vec<_> = "ijklmnrs".chars().zip(slots.iter().copied()).collect();
    let mut operands: Vec<(String, Tensor<Rational>)> = vec![];
    let mut terms = vec![];
    for _ in 0..1 + choices.below(3) {
        let factors = factors(choices, &free);
        let factors: Vec<Factor> = factors
            .into_iter()
            .map(|letters| {
                let slots: Vec<_> = letters.iter().map(|(_, slot)| *slot).collect();
                let known = operands.iter().position(|(_, t)| t.slots() == slots);
                let at = known.filter(|_| !choices.one_in(3)).unwrap_or_else(|| {
                    let name = format!("T{}", operands.len());
                    operands.push((name, operand(choices, dimension, &slots, values)));
                    operands.len() - 1
                });
                (at, letters)
            })
            .collect();
        let coefficient = choices.below(7) as i64 - 3;
        terms.extend(orders(rank, &groups).into_iter().map(|(sign, order)| {
            let exchanged = |letter: &mut char| {
                if let Some(at) = free.iter().position(|(own, _)| own == letter) {
                    *letter = free[order[at]].0;
                }
            };
            let mut factors = factors.clone();
            factors.iter_mut().flat_map(|(_, l)| l).for_each(|(letter, _)| exchanged(letter));
            (sign * coefficient, factors)
        }));
    }
    choices.shuffle(&mut terms);
    let terms: Vec<String> = terms
        .iter()
        .enumerate()
        .map(|(at, (coefficient, factors))| term(choices, at == 0, *coefficient, factors))
        .collect();
    let text = format!("{} -> {}", terms.join(" "), result(&free, &groups));
    Case { text, slots, operands }
}

fn variance(choices: &mut Choices) -> Variance {
    if choices.one_in(2) { Up } else { Down }
}

/// No, one or two groups of two or three consecutive positions.
fn groups(choices: &mut Choices, rank: usize) -> Vec<Range<usize>> {
    let mut groups = vec![];
    let mut from = 0;
    while rank >= from + 2 && !choices.one_in(3) && groups.len() < 2 {
        let start = from + choices.below(rank - from - 1);
        let end = (start + 2 + choices.below(2)).min(rank);
        groups.push(start..end);
        from = end;
    }
    groups
}

/// The letters of one or two factors: the free ones and up to two summed pairs.
fn factors(choices: &mut Choices, free: &[(char, Variance)]) -> Vec<Vec<(char, Variance)>> {
    let mut factors = vec![vec![]; 1 + choices.below(2)];
    for letter in free {
        let at = choices.below(factors.len());
        factors[at].push(*letter);
    }
    let pairs = choices.below(3).min((factors.len() * Indices::MAX - free.len()) / 2);
    for letter in "pq".chars().take(pairs) {
        let first = variance(choices);
        for slot in [first, if first == Up { Down } else { Up }] {
            let at = choices.below(factors.len());
            let full = factors[at].len() == Indices::MAX;
            let at = if full { factors.len() - 1 - at } else { at };
            factors[at].push((letter, slot));
        }
    }
    factors.iter_mut().for_each(|letters| choices.shuffle(letters));
    factors
}

fn operand(
    choices: &mut Choices,
    dimension: usize,
    slots: &[Variance],
    values: Values,
) -> Tensor<Rational> {
    let count = if dimension == 0 && !slots.is_empty() { 0 } else { choices.below(24) };
    let components: Vec<_> = (0..count)
        .map(|_| {
            let at: Vec<usize> = slots.iter().map(|_| choices.below(dimension)).collect();
            (at, value(choices, values))
        })
        .collect();
    Tensor::from_components(dimension, slots, components).unwrap()
}

fn value(choices: &mut Choices, values: Values) -> Rational {
    let small = choices.below(9) as i64 - 4;
    let corners = [1, 1 << 15, 1 << 31, 3_037_000_499, 1 << 32, 1 << 61, 1 << 62, i64::MAX];
    match values {
        Values::Integers => Rational::from(small),
        Values::Fractions => Rational::new(small, 1 + choices.below(6) as i64).unwrap(),
        Values::Words => {
            let corner = corners[choices.below(8)];
            let signed = if choices.one_in(2) { -corner } else { corner };
            Rational::from(signed.saturating_add(small))
        }
        Values::Huge => {
            let corner = Rational::from(corners[choices.below(8)]);
            let below = Rational::new(small, corners[choices.below(8)]).unwrap();
            corner.clone() * &corner * &corner + &below
        }
    }
}

/// All permutations of the positions within the groups, with their signs.
fn orders(rank: usize, groups: &[Range<usize>]) -> Vec<(i64, Vec<usize>)> {
    let mut orders = vec![(1, (0..rank).collect::<Vec<_>>())];
    for group in groups {
        for last in group.clone() {
            for exchanged in group.start..last {
                let images =
                    orders.iter().filter(|(_, o)| o[last..].iter().copied().eq(last..rank));
                let images: Vec<_> = images
                    .map(|(sign, order)| {
                        let mut order = order.clone();
                        order.swap(exchanged, last);
                        (-sign, order)
                    })
                    .collect();
                orders.extend(images);
            }
        }
    }
    orders
}

/// A term with its coefficient, in one of the possible notations.
fn term(choices: &mut Choices, leads: bool, coefficient: i64, factors: &[Factor]) -> String {
    let factors: Vec<String> =
        factors.iter().map(|(at, letters)| format!("T{at}{}", indices(letters))).collect();
    let factors = factors.join(" ");
    let (sign, size) = if coefficient < 0 { ("-", -coefficient) } else { ("+", coefficient) };
    match (leads, size) {
        (true, 1) if coefficient > 0 => factors,
        (true, _) => format!("{coefficient} {factors}"),
        (false, 1) if choices.one_in(2) => format!("{sign} {factors}"),
        (false, _) if choices.one_in(2) => format!("+ {coefficient} {factors}"),
        (false, _) => format!("{sign} {size} {factors}"),
    }
}

fn indices(letters: &[(char, Variance)]) -> String {
    let mark = |slot| if slot == Up { '^' } else { '_' };
    letters.iter().flat_map(|(letter, slot)| [mark(*slot), *letter]).collect()
}

/// The indices of the result with brackets around the groups.
fn result(letters: &[(char, Variance)], groups: &[Range<usize>]) -> String {
    let mut text = String::new();
    for (at, (letter, slot)) in letters.iter().enumerate() {
        if groups.iter().any(|group| group.start < at && at < group.end) {
            text.push(*letter);
        } else {
            text.push(if *slot == Up { '^' } else { '_' });
            if groups.iter().any(|group| group.start == at) {
                text.push('[');
            }
            text.push(*letter);
        }
        if groups.iter().any(|group| group.end == at + 1) {
            text.push(']');
        }
    }
    text
}
