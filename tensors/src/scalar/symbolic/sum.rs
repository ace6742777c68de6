//! Sums of products of rational functions, computed over one common denominator.
//!
//! At first, a sum only collects its terms. When it is complete, all terms are extended to the
//! least common denominator, whose factors are known ([`denominator`](super::denominator)). The
//! numerators are multiplied and added as polynomials. Then the numerator is divided once by each
//! factor. Common divisors are searched for only if a factor is not known to be irreducible.

use super::super::effort;
use super::denominator::{Denominator, Factor, Powers, common_base, coprime};
use super::fraction::{Fraction, lowest_terms};
use super::packed::{Gathered, Layout, Overflow, Word, exact};
use super::polynomial::{Polynomial, cofactors, constant, power, product, select};
use super::product::Product;
use super::variable::{Variable, Variables, places, union};
use super::{Form, Rational, Symbolic, canonical, once};
use crate::{Ring, Sum, Tolerance};
use num_integer::Integer;
use num_rational::Ratio;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A sum of terms and products. It is reduced to lowest terms only once, when it is complete.
#[derive(Clone, Debug, Default)]
pub struct SymbolicSum {
    constant: Rational,
    products: Vec<Product>,
}

impl Sum<Symbolic> for SymbolicSum {
    fn add_term(&mut self, a: &Symbolic) {
        match &a.0 {
            Form::Constant(c) => self.constant += c,
            Form::Fraction(f) => self.add(Rational::one(), [Some(f.clone()), None]),
        }
    }

    fn add_product(&mut self, a: &Symbolic, b: &Symbolic) {
        match (&a.0, &b.0) {
            (Form::Constant(a), Form::Constant(b)) => self.constant += &(a.clone() * b),
            (Form::Constant(c), Form::Fraction(f)) | (Form::Fraction(f), Form::Constant(c)) => {
                self.add(c.clone(), [Some(f.clone()), None]);
            }
            (Form::Fraction(f), Form::Fraction(g)) => {
                self.add(Rational::one(), [Some(f.clone()), Some(g.clone())]);
            }
        }
    }

    fn finish(&self, _: Tolerance) -> Option<Symbolic> {
        Some(self.value()).filter(|value| !value.vanishes())
    }
}

impl SymbolicSum {
    fn add(&mut self, coefficient: Rational, factors: [Option<Arc<Fraction>>; 2]) {
        if !coefficient.is_zero() {
            self.products.push(Product { coefficient, factors });
        }
    }

    /// The sum `a + b`.
    pub(super) fn of_terms(terms: [Arc<Fraction>; 2]) -> Symbolic {
        let mut sum = SymbolicSum::default();
        terms.into_iter().for_each(|f| sum.add(Rational::one(), [Some(f), None]));
        sum.value()
    }

    /// The product `a b`.
    pub(super) fn of_product([a, b]: [Arc<Fraction>; 2]) -> Symbolic {
        let mut sum = SymbolicSum::default();
        sum.add(Rational::one(), [Some(a), Some(b)]);
        sum.value()
    }

    pub(super) fn value(&self) -> Symbolic {
        match &self.products[..] {
            [] => Symbolic::constant(self.constant.clone()),
            [Product { coefficient, factors: [Some(f), None] }] if self.constant.is_zero() => {
                match coefficient.is_one() {
                    true => Symbolic(Form::Fraction(f.clone())),
                    false => once::multiple(coefficient, f),
                }
            }
            products => once::value(&self.constant, products, || self.computed()),
        }
    }

    fn computed(&self) -> Symbolic {
        match &self.products[..] {
            [Product { coefficient, factors: [Some(f), None] }] => {
                let f = match coefficient.is_one() {
                    true => Symbolic(Form::Fraction(f.clone())),
                    false => f.times(coefficient).into(),
                };
                match &f.0 {
                    Form::Fraction(f) if !self.constant.is_zero() => f.plus(&self.constant).into(),
                    _ => f,
                }
            }
            products => {
                let fractions = products.iter().flat_map(|p| p.factors.iter().flatten());
                match canonical::common_parts(fractions) {
                    None => Common::new(&self.constant, products).value(),
                    Some(parts) => {
                        let refined = products.iter().map(|p| Product {
                            coefficient: p.coefficient.clone(),
                            factors: p
                                .factors
                                .each_ref()
                                .map(|f| f.as_ref().map(|f| canonical::in_parts(f, &parts))),
                        });
                        Common::new(&self.constant, &refined.collect::<Vec<_>>()).value()
                    }
                }
            }
        }
    }
}

/// The terms of a sum, and their common denominator.
struct Common<'s> {
    variables: Variables,
    terms: Vec<Term<'s>>,
    /// For each group of terms, the factors by which its terms must be multiplied. They are the
    /// exponents of the variables, followed by those of the base.
    groups: Vec<Vec<u32>>,
    /// Coprime factors, each with its polynomial in all variables.
    base: Vec<(Arc<Factor>, Polynomial)>,
    /// The exponents of the common denominator: first those of the variables, then those of the
    /// base.
    exponents: Vec<u32>,
    /// For each variable and factor, whether the numerator may be a multiple of it.
    suspects: Vec<bool>,
}

struct Term<'s> {
    coefficient: &'s Rational,
    factors: [Option<(&'s Polynomial, Vec<usize>)>; 2],
    group: usize,
}

impl<'s> Common<'s> {
    fn new(constant: &'s Rational, products: &'s [Product]) -> Self {
        let fractions = || products.iter().flat_map(|p| p.factors.iter().flatten());
        let none = Variables::from([]);
        let variables = fractions().fold(none, |all, f| match all.is_empty() {
            true => f.variables.clone(),
            false => union(&all, &f.variables),
        });
        let mut distinct: Vec<Arc<Factor>> = Vec::new();
        let mut known = |factor: &Arc<Factor>| {
            let found = distinct.iter().position(|f| f == factor);
            found.unwrap_or_else(|| {
                distinct.push(factor.clone());
                distinct.len() - 1
            })
        };
        let below: Vec<Vec<(usize, u32)>> = products
            .iter()
            .map(|p| {
                let all = p.factors.iter().flatten().flat_map(|f| &f.denominator.factors);
                all.map(|(factor, e)| (known(factor), *e)).collect()
            })
            .collect();
        let (base, shares) = match distinct.iter().all(|factor| factor.irreducible) {
            true => (distinct, None),
            false => {
                let (base, shares) = common_base(distinct);
                (base, Some(shares))
            }
        };
        let n = variables.len();
        let mut terms = Vec::with_capacity(products.len() + 1);
        let mut denominators: BTreeMap<Vec<u32>, (usize, usize)> = BTreeMap::new();
        let mut group = |exponents: Vec<u32>, weight: usize| {
            let next = denominators.len();
            let (group, count) = denominators.entry(exponents).or_insert((next, 0));
            *count += weight;
            *group
        };
        for (p, below) in products.iter().zip(below) {
            let mut exponents = vec![0u32; n + base.len()];
            let factors = p.factors.each_ref().map(|f| {
                f.as_ref().map(|f| {
                    let columns = places(&f.variables, &variables);
                    for (at, column) in columns.iter().enumerate() {
                        exponents[*column] += f.denominator.exponent(at);
                    }
                    (&f.numerator, columns)
                })
            });
            for (at, e) in below {
                match &shares {
                    None => exponents[n + at] += e,
                    Some(shares) => (exponents[n..].iter_mut().zip(&shares[at]))
                        .for_each(|(total, share)| *total += share * e),
                }
            }
            // the weight is 2 for a product, because a product of two fractions need not be in
            // lowest terms
            let weight = if factors[1].is_some() { 2 } else { 1 };
            let group = group(exponents, weight);
            terms.push(Term { coefficient: &p.coefficient, factors, group });
        }
        if !constant.is_zero() {
            let group = group(vec![0; n + base.len()], 1);
            terms.push(Term { coefficient: constant, factors: [None, None], group });
        }
        let largest = |at: usize| denominators.keys().map(|e| e[at]).max().unwrap_or(0);
        let exponents: Vec<u32> = (0..n + base.len()).map(largest).collect();
        let suspect = |at: usize| {
            let with = denominators.iter().filter(|(e, _)| e[at] == exponents[at]);
            exponents[at] > 0 && with.map(|(_, (_, count))| count).sum::<usize>() > 1
        };
        let suspects = (0..n + base.len()).map(suspect).collect();
        let mut groups = vec![Vec::new(); denominators.len()];
        for (own, (group, _)) in &denominators {
            groups[*group] = exponents.iter().zip(own).map(|(all, own)| all - own).collect();
        }
        let base = base.into_iter().map(|factor| {
            let polynomial = factor.over(&variables);
            (factor, polynomial)
        });
        Common { base: base.collect(), variables, terms, groups, exponents, suspects }
    }

    fn value(self) -> Symbolic {
        self.within_limit().unwrap_or_else(ended)
    }

    /// The value of the sum. Returns `None` if the limit on terms is exceeded.
    fn within_limit(mut self) -> Option<Symbolic> {
        let length = |f: &Option<(&Polynomial, _)>| f.as_ref().map_or(1, |(f, _)| f.terms.len());
        let products =
            self.terms.iter().map(|term| length(&term.factors[0]) * length(&term.factors[1]));
        if !effort::products(products.sum()) {
            return None;
        }
        let quotient = self.in_words();
        if !effort::products(0) {
            return None;
        }
        let numerator = quotient.unwrap_or_else(|| self.in_polynomials());
        if !effort::terms(numerator.terms.len()) {
            return None;
        }
        if numerator.is_zero() {
            return Some(Symbolic::zero());
        }
        let n = self.variables.len();
        let mut factors: Powers = Vec::new();
        let mut numerator = numerator;
        for (at, (factor, polynomial)) in self.base.iter().enumerate() {
            let exponent = self.exponents[n + at];
            if exponent == 0 {
                continue;
            }
            if factor.irreducible || !self.suspects[n + at] {
                factors.push((factor.clone(), exponent));
                continue;
            }
            let mut work = vec![(polynomial.clone(), exponent)];
            while let Some((polynomial, exponent)) = work.pop() {
                let (common, rest, left) = cofactors(&numerator, &polynomial);
                if common.is_constant() {
                    let found = Denominator::of(&self.variables, &polynomial).factors;
                    factors.extend(found.into_iter().map(|(f, e)| (f, e * exponent)));
                    continue;
                }
                numerator = rest;
                work.extend(Some((polynomial, exponent - 1)).filter(|(_, e)| *e > 0));
                work.extend(Some((left, 1)).filter(|(left, _)| !left.is_constant()));
            }
        }
        let denominator =
            Denominator { monomial: self.exponents[..n].into(), factors: coprime(factors) };
        Some(canonical::settled(lowest_terms(&self.variables, numerator, denominator)))
    }

    /// The numerator, computed with polynomials of any size.
    fn in_polynomials(&mut self) -> Polynomial {
        let n = self.variables.len();
        let zero = constant(Rational::zero(), n);
        let mut sums = vec![zero.clone(); self.groups.len()];
        for term in &self.terms {
            let mut value = constant(term.coefficient.clone(), n);
            for (f, columns) in term.factors.iter().flatten() {
                let column = |k| columns.iter().position(|place| *place == k);
                let columns: Vec<_> = (0..n).map(column).collect();
                if !effort::products(0) {
                    return zero;
                }
                value = product(&value, &select(f, &columns));
            }
            sums[term.group] = &sums[term.group] + &value;
        }
        let mut numerator = zero.clone();
        for (sum, missing) in sums.into_iter().zip(&self.groups) {
            let mut sum = sum.mul_term(&Rational::one(), &Monomial::new(&missing[..n]));
            for ((_, f), e) in self.base.iter().zip(&missing[n..]).filter(|(_, e)| **e > 0) {
                if !effort::products(sum.terms.len() * f.terms.len()) {
                    return zero;
                }
                sum = product(&sum, &power(f, *e));
            }
            numerator = &numerator + &sum;
        }
        if numerator.is_zero() {
            return numerator;
        }
        let least = numerator.min_exps();
        let common = least.exps().iter().zip(&self.exponents).map(|(a, b)| *a.min(b));
        let common: Vec<u32> = common.collect();
        self.exponents.iter_mut().zip(&common).for_each(|(e, c)| *e -= c);
        numerator = super::polynomial::lowered(&numerator, &Monomial::new(common));
        for (at, (factor, f)) in self.base.iter().enumerate() {
            while factor.irreducible && self.suspects[n + at] && self.exponents[n + at] > 0 {
                let Some(quotient) = numerator.exact(f) else { break };
                numerator = quotient;
                self.exponents[n + at] -= 1;
            }
        }
        numerator
    }

    /// The numerator, computed in machine words. Returns `None` if it may not fit.
    fn in_words(&mut self) -> Option<Polynomial> {
        let n = self.variables.len();
        let factor_degrees: Vec<Vec<u32>> = self.base.iter().map(|(_, f)| f.degrees()).collect();
        let factor_norms: Vec<u128> =
            self.base.iter().map(|(_, f)| Some(integral(f)?.norm)).collect::<Option<_>>()?;
        // the degrees and magnitudes of the sum of each group, and the common denominator
        let mut degrees = vec![vec![0u64; n]; self.groups.len()];
        let mut operands = Vec::with_capacity(self.terms.len());
        let mut denominator = 1i128;
        for term in &self.terms {
            let mut own = vec![0u64; n];
            let c = Ratio::<i64>::try_from(term.coefficient).ok()?;
            let (mut below, mut norm) = (i128::from(*c.denom()), 1u128);
            for (f, columns) in term.factors.iter().flatten() {
                let degrees = f.degrees();
                columns.iter().zip(&degrees).for_each(|(at, d)| own[*at] += u64::from(*d));
                let integral = integral(f)?;
                below = below.checked_mul(integral.denominator.into())?;
                norm = norm.checked_mul(integral.norm)?;
            }
            let total = &mut degrees[term.group];
            total.iter_mut().zip(own).for_each(|(total, own)| *total = own.max(*total));
            denominator = denominator.checked_mul(below / denominator.gcd(&below))?;
            operands.push((*c.numer(), below, norm));
        }
        let mut bound = 0u128;
        let mut scales = Vec::with_capacity(operands.len());
        for ((numerator, below, norm), term) in operands.into_iter().zip(&self.terms) {
            let scale = i128::from(numerator).checked_mul(denominator / below)?;
            let missing = self.groups[term.group][n..].iter().zip(&factor_norms);
            let norm = missing
                .filter(|(e, _)| **e > 0)
                .try_fold(norm, |norm, (e, factor)| norm.checked_mul(factor.checked_pow(*e)?))?;
            bound = bound.checked_add(norm.checked_mul(scale.unsigned_abs())?)?;
            scales.push(scale);
        }
        if bound > i128::MAX as u128 {
            return None;
        }
        for (own, missing) in degrees.iter_mut().zip(&self.groups) {
            for (at, total) in own.iter_mut().enumerate() {
                let factors = missing[n..].iter().zip(&factor_degrees);
                *total += u64::from(missing[at]);
                *total += factors.map(|(e, d)| u64::from(*e) * u64::from(d[at])).sum::<u64>();
            }
        }
        let mut all: Vec<u64> =
            (0..n).map(|at| degrees.iter().map(|own| own[at]).max().unwrap_or(0)).collect();
        for degrees in &factor_degrees {
            // reserves bits for the divisors in the layout
            all.iter_mut().zip(degrees).for_each(|(all, d)| *all = (*all).max((*d).into()));
        }
        let layout = Layout::new(&all)?;
        if layout.bits <= u64::BITS {
            self.gathered::<u64>(&layout, &scales, denominator)
        } else {
            self.gathered::<u128>(&layout, &scales, denominator)
        }
    }

    fn gathered<K: Word>(
        &mut self,
        layout: &Layout,
        scales: &[i128],
        denominator: i128,
    ) -> Option<Polynomial> {
        let n = self.variables.len();
        let identity: Vec<usize> = (0..n).collect();
        let base: Vec<Vec<(K, i128)>> =
            (self.base.iter()).map(|(_, f)| packed(layout, f, &identity)).collect::<Option<_>>()?;
        let unit = [(K::zero(), 1i128)];
        let mut sums: Vec<Option<Gathered<K>>> = self.groups.iter().map(|_| None).collect();
        for (term, scale) in self.terms.iter().zip(scales) {
            let factors = term.factors.each_ref().map(|f| match f {
                Some((f, columns)) => packed(layout, f, columns),
                None => Some(unit.to_vec()),
            });
            let [Some(a), Some(b)] = &factors else { return None };
            let sum = &mut sums[term.group];
            let room = a.len().saturating_mul(b.len());
            sum.get_or_insert_with(|| Gathered::with_room(room)).add_product(*scale, a, b);
        }
        // collects all groups in the first group that needs no factors
        let mut total = match self.groups.iter().position(|missing| missing.iter().all(|e| *e == 0))
        {
            Some(at) => sums[at].take(),
            None => None,
        };
        for (sum, missing) in sums.into_iter().zip(&self.groups) {
            let Some(sum) = sum else { continue };
            let monomial: K = layout.pack(missing[..n].iter().copied().enumerate());
            let mut sum = sum.sorted();
            let mut factors: Vec<&[(K, i128)]> = Vec::new();
            for (factor, e) in base.iter().zip(&missing[n..]) {
                factors.extend(std::iter::repeat_n(&factor[..], *e as usize));
            }
            let last = factors.pop();
            for factor in factors {
                if !effort::products(sum.len() * factor.len()) {
                    return None;
                }
                let mut next = Gathered::with_room(sum.len());
                next.add_product(1, &sum, factor);
                sum = next.sorted();
            }
            sum.iter_mut().for_each(|(word, _)| *word = *word + monomial);
            if !effort::products(sum.len() * last.map_or(1, <[_]>::len)) {
                return None;
            }
            let total = total.get_or_insert_with(|| Gathered::with_room(sum.len()));
            total.add_product(1, &sum, last.unwrap_or(&unit));
        }
        let mut numerator = total.map_or_else(Vec::new, Gathered::sorted);
        let exponents = self.exponents.clone();
        self.divide_monomial(layout, &mut numerator);
        for (at, factor) in base.iter().enumerate() {
            let exponent = &mut self.exponents[n + at];
            while self.base[at].0.irreducible && self.suspects[n + at] && *exponent > 0 {
                match exact(layout, &numerator, factor) {
                    Ok(Some(quotient)) => {
                        effort::products(quotient.len() * factor.len());
                        numerator = quotient;
                    }
                    Ok(None) => break,
                    Err(Overflow) => {
                        self.exponents = exponents;
                        return None;
                    }
                }
                *exponent -= 1;
            }
        }
        Some(unpacked(layout, &numerator, denominator))
    }

    /// Divides by the largest monomial that divides the numerator and the denominator.
    fn divide_monomial<K: Word>(&mut self, layout: &Layout, numerator: &mut [(K, i128)]) {
        if numerator.is_empty() {
            return;
        }
        let mut common = vec![0u32; self.variables.len()];
        for (at, common) in common.iter_mut().enumerate().filter(|(at, _)| self.suspects[*at]) {
            *common = self.exponents[at];
            for (word, _) in &*numerator {
                if *common == 0 {
                    break;
                }
                *common = layout.exponent(*word, at).min(*common);
            }
            self.exponents[at] -= *common;
        }
        let monomial: K = layout.pack(common.into_iter().enumerate());
        if !monomial.is_zero() {
            numerator.iter_mut().for_each(|(word, _)| *word = *word - monomial);
        }
    }
}

/// The placeholder for values that are no longer computed. It is neither zero nor a polynomial,
/// because loops might wait for such a value.
fn ended() -> Symbolic {
    Fraction::variable(Variable::parameter("limit"))
        .recip()
        .map_or_else(Symbolic::zero, Symbolic::from)
}

/// A polynomial, as integers over a common denominator.
struct Integral {
    denominator: i64,
    /// The sum of the magnitudes of the integers.
    norm: u128,
}

/// Converts a polynomial to integers. Returns `None` if a number does not fit in a machine word.
fn integral(f: &Polynomial) -> Option<Integral> {
    let mut denominator = 1i64;
    for (_, c) in &f.terms {
        let own = *Ratio::<i64>::try_from(c).ok()?.denom();
        if own != 1 {
            denominator = denominator.checked_mul(own / denominator.gcd(&own))?;
        }
    }
    let norm = f.terms.iter().try_fold(0u128, |norm, (_, c)| {
        norm.checked_add(numerator_over(c, denominator)?.unsigned_abs())
    })?;
    Some(Integral { denominator, norm })
}

/// The integer `denominator * c`.
fn numerator_over(c: &Rational, denominator: i64) -> Option<i128> {
    let c = Ratio::<i64>::try_from(c).ok()?;
    Some(i128::from(*c.numer()) * i128::from(denominator / c.denom()))
}

/// The integer polynomial of [`integral`], with terms in descending order. Returns `None` if it
/// does not fit in the layout.
fn packed<K: Word>(layout: &Layout, f: &Polynomial, columns: &[usize]) -> Option<Vec<(K, i128)>> {
    let denominator = integral(f)?.denominator;
    let mut terms = Vec::with_capacity(f.terms.len());
    for (m, c) in &f.terms {
        let exponents = columns.iter().copied().zip(m.exps().iter().copied());
        terms.push((layout.pack(exponents), numerator_over(c, denominator)?));
    }
    terms.sort_unstable_by(|(a, _): &(K, i128), (b, _)| b.cmp(a));
    Some(terms)
}

/// Converts packed terms to a polynomial, and divides it by the integer `denominator`. The terms
/// are sorted in the order of polynomials.
fn unpacked<K: Word>(layout: &Layout, terms: &[(K, i128)], denominator: i128) -> Polynomial {
    let monomial = |word: K| {
        let exponents = (0..layout.variables()).map(|at| layout.exponent(word, at));
        Monomial::new(exponents.collect::<Vec<u32>>())
    };
    let mut terms: Vec<(Monomial, Rational)> = terms
        .iter()
        .map(|(word, value)| (monomial(*word), Rational::reduced(*value, denominator)))
        .collect();
    // sorts by degree, because words are in lexicographic order, but polynomials are in graded
    // order
    terms.sort_by_key(|(monomial, _)| std::cmp::Reverse(monomial.degree()));
    Poly { terms, nvars: layout.variables(), order: Order::GrLex }
}
