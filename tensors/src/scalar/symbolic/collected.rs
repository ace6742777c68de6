//! Sums in which common factors of terms are taken out: `a*(b + c) + d`.
//!
//! The method is a greedy Horner scheme. It takes out the variable that saves the most characters,
//! together with all factors that the terms with this variable have in common. The same is done for
//! these terms and for the other terms. The part with the leading term is first, so that the text
//! begins with the same sign as the expanded form.

use super::super::Rational;
use super::polynomial::Polynomial;
use super::variable::Variables;
use num_traits::One;

/// The deepest nesting of parts. Expressions may be nested to the depth
/// [`MAX_DEPTH`](crate::expression::MAX_DEPTH).
const MAX_NESTING: usize = 40;

/// A monomial, as the positions of its variables and their exponents.
pub(super) type Powers = Vec<(usize, u32)>;

/// The product `coefficient * monomial * (inner)`. If `inner` is empty, there is no last factor.
pub(super) struct Part {
    pub coefficient: Rational,
    pub powers: Powers,
    pub inner: Vec<Part>,
}

/// Splits a nonzero sum into parts. A single term is one part.
pub(super) fn parts(sum: &Polynomial, variables: &Variables) -> Vec<Part> {
    let powers = |exponents: &[u32]| -> Powers {
        exponents.iter().copied().enumerate().filter(|(_, e)| *e > 0).collect()
    };
    let lengths: Vec<usize> = variables.iter().map(|variable| variable.text().len()).collect();
    let terms = sum.terms.iter().enumerate();
    let terms = terms.map(|(place, (m, c))| {
        let (coefficient, powers) = (c.clone(), powers(m.exps()));
        let letters = letters(&coefficient, &powers, &lengths);
        Term { place, coefficient, powers, letters }
    });
    let mut terms: Vec<_> = terms.collect();
    let counts = vec![0; lengths.len()];
    let (parts, _) = Collector { lengths, counts }.collect(&mut terms, 0);
    parts
}

/// A term of a sum.
#[derive(Default)]
struct Term {
    /// The position of the term in the sum.
    place: usize,
    coefficient: Rational,
    powers: Powers,
    /// The printed length in characters, without the sign.
    letters: usize,
}

impl Term {
    fn exponent(&self, at: usize) -> u32 {
        self.powers.iter().find(|(place, _)| *place == at).map_or(0, |(_, e)| *e)
    }

    /// Divides the term in place by a coefficient and by powers. The term must contain these
    /// powers.
    fn divide(&mut self, inverse: &Rational, powers: &[(usize, u32)], lengths: &[usize]) {
        for (at, e) in powers {
            self.powers.iter_mut().filter(|(place, _)| place == at).for_each(|(_, own)| *own -= e);
        }
        self.powers.retain(|(_, e)| *e > 0);
        self.scale(inverse);
        self.letters = letters(&self.coefficient, &self.powers, lengths);
    }

    /// Multiplies the term in place. The cached length remains the length of the quotient.
    fn multiply(&mut self, unit: &Rational, powers: &[(usize, u32)]) {
        for (at, e) in powers {
            match self.powers.binary_search_by_key(at, |(place, _)| *place) {
                Ok(place) => self.powers[place].1 += e,
                Err(place) => self.powers.insert(place, (*at, *e)),
            }
        }
        self.scale(unit);
    }

    fn scale(&mut self, factor: &Rational) {
        if !factor.is_one() {
            self.coefficient *= factor;
        }
    }
}

struct Collector {
    /// The lengths of the names of the variables.
    lengths: Vec<usize>,
    /// A counter for each variable. All counters are zero between uses.
    counts: Vec<usize>,
}

impl Collector {
    /// Collects terms. Returns the parts and the length of their text. The terms are reordered, but
    /// not changed.
    fn collect(&mut self, terms: &mut [Term], nesting: usize) -> (Vec<Part>, usize) {
        let all = terms.iter().map(|term| SIGN + term.letters);
        let length = all.sum::<usize>().saturating_sub(SIGN);
        let shared = if nesting < MAX_NESTING { self.shared(terms) } else { None };
        let Some(at) = shared else { return (single(terms), length) };
        let leads = terms[0].exponent(at) > 0;
        let (with, without) = apart(terms, at);
        let powers = common(with);
        let unit = Rational::content(with.iter().map(|term| &term.coefficient));
        let inverse = Rational::one() / &unit;
        with.iter_mut().for_each(|term| term.divide(&inverse, &powers, &self.lengths));
        let outside = letters(&unit, &powers, &self.lengths);
        let (inner, inside) = self.collect(with, nesting + 1);
        with.iter_mut().for_each(|term| term.multiply(&unit, &powers));
        let (rest, more) = match without.is_empty() {
            true => (Vec::new(), 0),
            false => self.collect(without, nesting),
        };
        let collected = outside + inside + "*()".len() + if more > 0 { SIGN + more } else { 0 };
        if collected >= length {
            terms.sort_by_key(|term| term.place);
            return (single(terms), length);
        }
        let mut parts = vec![Part { coefficient: unit, powers, inner }];
        if leads {
            parts.extend(rest);
        } else {
            parts.splice(0..0, rest);
        }
        (parts, collected)
    }

    /// The variable that saves the most characters. If several variables save the same number, it
    /// is the first of them. Returns `None` if no two terms have a common variable.
    fn shared(&mut self, terms: &[Term]) -> Option<usize> {
        let all = || terms.iter().flat_map(|term| &term.powers).map(|(at, _)| *at);
        all().for_each(|at| self.counts[at] += 1);
        let gain = |at: &usize| (self.counts[*at] * self.lengths[*at], usize::MAX - at);
        let found = all().filter(|at| self.counts[*at] > 1).max_by_key(gain);
        all().for_each(|at| self.counts[at] = 0);
        found
    }
}

/// Partitions the terms stably: first the terms that contain a variable, then the other terms.
fn apart(terms: &mut [Term], at: usize) -> (&mut [Term], &mut [Term]) {
    let (with, without): (Vec<_>, Vec<_>) =
        terms.iter_mut().map(std::mem::take).partition(|term| term.exponent(at) > 0);
    let count = with.len();
    let ordered = with.into_iter().chain(without);
    terms.iter_mut().zip(ordered).for_each(|(term, ordered)| *term = ordered);
    terms.split_at_mut(count)
}

/// The length of a sign between two terms, including its spaces.
const SIGN: usize = 3;

/// Returns each term as a separate part.
fn single(terms: &[Term]) -> Vec<Part> {
    let part = |Term { coefficient, powers, .. }: &Term| Part {
        coefficient: coefficient.clone(),
        powers: powers.clone(),
        inner: Vec::new(),
    };
    terms.iter().map(part).collect()
}

/// The powers that all terms contain.
fn common(terms: &[Term]) -> Powers {
    let Some((first, others)) = terms.split_first() else { return vec![] };
    let mut powers = first.powers.clone();
    for term in others {
        powers.iter_mut().for_each(|(at, e)| *e = (*e).min(term.exponent(*at)));
        powers.retain(|(_, e)| *e > 0);
    }
    powers
}

/// The printed length of a term in characters, without its sign.
fn letters(coefficient: &Rational, powers: &[(usize, u32)], lengths: &[usize]) -> usize {
    let exponent = |e: u32| if e > 1 { 2 + e.ilog10() as usize } else { 0 };
    let powers = powers.iter().map(|(at, e)| 1 + lengths[*at] + exponent(*e));
    let number = match coefficient.letters() {
        _ if coefficient.is_one() || *coefficient == Rational::from(-1) => 0,
        letters => 1 + letters,
    };
    (number + powers.sum::<usize>()).saturating_sub(1).max(1)
}
