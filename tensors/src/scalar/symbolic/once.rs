//! Caches of sums. A sum that occurs again is not computed and stored again.
//!
//! The tensors of a large algebra have millions of components, but only a few thousand different
//! values. Some of these differ only in the names of the parameters: `(a - b)/c` and `(x - y)/z`
//! are the same quotient of polynomials in three variables. The key of a sum consists of the
//! addresses of its quotients, and of the positions of their variables among all variables of the
//! sum. Equal results have the same address, so the sums of the next tensor are found too. Only
//! short sums of short values are cached.

use super::super::effort::Counted;
use super::cache::{Cache, Mixer, hash};
use super::fraction::{Fraction, Quotient};
use super::product::Product;
use super::variable::{Variable, Variables};
use super::{Form, Rational, Symbolic};
use num_rational::Ratio;
use std::cell::RefCell;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// The largest number of products in a cached sum. Longer sums take long to compute anyway, and
/// seldom occur again.
const MAX_PRODUCTS: usize = 24;

thread_local! {
    static KNOWN: RefCell<Known> = RefCell::default();
}

/// The caches of a thread. They store at most 131,072 sums of at most 24 products, 32,768
/// multiples, 65,536 quotients and 16,384 values. Each has at most 48 terms. The constants below
/// are a quarter of these numbers.
#[derive(Default)]
struct Known {
    sums: Cache<Box<Sum>, { 1 << 15 }>,
    multiples: Cache<Box<Multiple>, { 1 << 13 }>,
    quotients: Quotients,
    values: Values,
    pattern: Pattern,
}

type Quotients = Cache<Arc<Quotient>, { 1 << 14 }>;

/// A small cache, which remains in fast memory. It is small because most values are new if there
/// are many parameters.
type Values = Cache<Arc<Fraction>, { 1 << 12 }>;

/// A sum with its value.
struct Sum {
    key: Box<[u64]>,
    /// These quotients are stored so that their addresses are not reused while the entry exists.
    _quotients: Vec<Arc<Quotient>>,
    value: Value,
    counted: Counted,
}

/// The product of a quotient and a number.
struct Multiple {
    coefficient: Rational,
    quotient: Arc<Quotient>,
    value: Arc<Quotient>,
    counted: Counted,
}

enum Value {
    /// A value with the names of its variables. If the value contains functions, its variables may
    /// differ from the variables of the sum.
    Named(Symbolic),
    /// A quotient of polynomials, and the positions of its variables among the variables of the
    /// sum.
    Nameless(Arc<Quotient>, Box<[u8]>),
}

/// The key of a sum in the cache.
#[derive(Default)]
struct Pattern {
    /// All variables, in their order.
    names: Vec<Variable>,
    /// The coefficients, the addresses of the quotients and the positions of the variables. If the
    /// value depends on the names, also the addresses of the variables.
    key: Vec<u64>,
}

impl Pattern {
    /// Describes a sum. Returns `false` unless the numbers fit in machine words, and there are few
    /// variables.
    fn describe(&mut self, constant: &Rational, products: &[Product]) -> bool {
        let fractions = || products.iter().flat_map(|p| p.factors.iter().flatten());
        self.names.clear();
        self.key.clear();
        for name in fractions().flat_map(|f| f.variables.iter()) {
            if !self.names.contains(name) {
                let at = self.names.partition_point(|other| other < name);
                self.names.insert(at, *name);
            }
        }
        if self.names.len() > usize::from(u8::MAX) || !self.number(constant) {
            return false;
        }
        for product in products {
            if !self.number(&product.coefficient) {
                return false;
            }
            for factor in &product.factors {
                let Some(f) = factor else {
                    self.key.push(0);
                    continue;
                };
                self.key.push(Arc::as_ptr(&f.quotient).addr() as u64);
                for names in f.variables.chunks(8) {
                    let place = |name| self.names.iter().position(|own| own == name).unwrap_or(0);
                    self.key
                        .push(names.iter().fold(0, |word, name| word << 8 | place(name) as u64));
                }
            }
        }
        if !fractions().all(|f| f.is_nameless()) {
            self.key.extend(self.names.iter().map(|name| name.address() as u64));
        }
        true
    }

    fn number(&mut self, number: &Rational) -> bool {
        let Ok(number) = Ratio::<i64>::try_from(number) else { return false };
        let (above, below) = (*number.numer(), *number.denom());
        match above.checked_mul(2) {
            // pushes an odd number, which marks an integer
            Some(twice) if below == 1 => self.key.push(twice as u64 + 1),
            _ => self.key.extend([0, above as u64, below as u64]),
        }
        true
    }
}

/// Clears the caches of the current thread.
pub(super) fn clear() {
    KNOWN.take();
}

/// The value of `constant + products`. It comes from the cache, or is computed.
pub(super) fn value(
    constant: &Rational,
    products: &[Product],
    compute: impl FnOnce() -> Symbolic,
) -> Symbolic {
    let fractions = || products.iter().flat_map(|p| p.factors.iter().flatten());
    if products.len() > MAX_PRODUCTS || !fractions().all(|f| f.is_short()) {
        return compute();
    }
    let found = KNOWN.with_borrow_mut(|known| {
        if !known.pattern.describe(constant, products) {
            return Err(None);
        }
        let key = hash(&known.pattern.key);
        match known.sums.get(key).map(|sum| &**sum).filter(|sum| *sum.key == known.pattern.key) {
            None => Err(Some((key, known.pattern.key.clone(), known.pattern.names.clone()))),
            Some(Sum { value: Value::Named(value), counted, .. }) => Ok((value.clone(), *counted)),
            Some(Sum { value: Value::Nameless(quotient, kept), counted, .. }) => {
                let names = kept.iter().map(|at| known.pattern.names[usize::from(*at)]);
                let make = || names.clone().collect();
                Ok((shared(&mut known.values, quotient, names.clone(), make), *counted))
            }
        }
    });
    let (hash, key, names) = match found {
        Ok((value, counted)) => {
            counted.again();
            return value;
        }
        Err(None) => return compute(),
        Err(Some(pattern)) => pattern,
    };
    let (value, counted) = Counted::of(compute);
    let short = match &value.0 {
        Form::Constant(_) => true,
        Form::Fraction(f) => f.is_short(),
    };
    let Some(counted) = counted.filter(|_| short) else { return value };
    KNOWN.with_borrow_mut(|known| {
        let nameless = fractions().all(|f| f.is_nameless());
        let (value, result) = match value.0 {
            Form::Constant(_) => (Value::Named(value.clone()), value),
            Form::Fraction(f) => {
                let quotient = equal(&mut known.quotients, &f.quotient);
                let result = with_names_of(&mut known.values, &quotient, &f);
                let place = |name| names.iter().position(|own| own == name).map(|at| at as u8);
                let kept = f.variables.iter().map(place).collect::<Option<Box<[u8]>>>();
                match kept.filter(|_| nameless) {
                    Some(kept) => (Value::Nameless(quotient, kept), result),
                    None => (Value::Named(result.clone()), result),
                }
            }
        };
        let quotients = fractions().map(|f| f.quotient.clone()).collect();
        let sum = Sum { key: key.into(), _quotients: quotients, value, counted };
        known.sums.put(hash, Box::new(sum));
        result
    })
}

/// The product `c f` for a nonzero number `c`.
pub(super) fn multiple(coefficient: &Rational, f: &Arc<Fraction>) -> Symbolic {
    let compute = || f.times(coefficient);
    if !f.is_short() {
        return compute().into();
    }
    let mut mixer = Mixer::default();
    coefficient.hash(&mut mixer);
    mixer.write_usize(Arc::as_ptr(&f.quotient).addr());
    let key = mixer.finish();
    let found = KNOWN.with_borrow_mut(|known| {
        let found = known.multiples.get(key)?;
        let same = Arc::ptr_eq(&found.quotient, &f.quotient) && found.coefficient == *coefficient;
        same.then(|| (with_names_of(&mut known.values, &found.value, f), found.counted))
    });
    if let Some((value, counted)) = found {
        counted.again();
        return value;
    }
    let (value, counted) = Counted::of(compute);
    let Some(counted) = counted else { return value.into() };
    KNOWN.with_borrow_mut(|known| {
        let value = equal(&mut known.quotients, &value.quotient);
        let result = with_names_of(&mut known.values, &value, f);
        let (coefficient, quotient) = (coefficient.clone(), f.quotient.clone());
        let multiple = Multiple { coefficient, quotient, value, counted };
        known.multiples.put(key, Box::new(multiple));
        result
    })
}

/// Returns the cached quotient that equals this quotient. If there is none, this quotient is
/// cached.
fn equal(known: &mut Quotients, quotient: &Arc<Quotient>) -> Arc<Quotient> {
    let mut mixer = Mixer::default();
    quotient.numerator.terms.hash(&mut mixer);
    quotient.denominator.monomial.hash(&mut mixer);
    let key = mixer.finish();
    match known.get(key).filter(|known| known.is_written_as(quotient)) {
        Some(known) => known.clone(),
        None => {
            known.put(key, quotient.clone());
            quotient.clone()
        }
    }
}

/// The quotient with the names of a fraction.
fn with_names_of(known: &mut Values, quotient: &Arc<Quotient>, f: &Fraction) -> Symbolic {
    shared(known, quotient, f.variables.iter().copied(), || f.variables.clone())
}

/// The quotient with these names. If the cache contains an equal value, that value is returned.
fn shared(
    known: &mut Values,
    quotient: &Arc<Quotient>,
    names: impl Iterator<Item = Variable> + Clone,
    variables: impl FnOnce() -> Variables,
) -> Symbolic {
    let mut mixer = Mixer::default();
    mixer.write_usize(Arc::as_ptr(quotient).addr());
    names.clone().for_each(|name| mixer.write_usize(name.address()));
    let key = mixer.finish();
    let same = |f: &&Arc<Fraction>| {
        Arc::ptr_eq(&f.quotient, quotient) && f.variables.iter().copied().eq(names)
    };
    if let Some(value) = known.get(key).filter(same) {
        return Symbolic(Form::Fraction(value.clone()));
    }
    let value = Arc::new(Fraction { variables: variables(), quotient: quotient.clone() });
    known.put(key, value.clone());
    Symbolic(Form::Fraction(value))
}

impl Quotient {
    /// Whether the quotients are equal and have the same factors in the same order.
    fn is_written_as(&self, other: &Self) -> bool {
        self.numerator == other.numerator
            && self.denominator.monomial == other.denominator.monomial
            && self.denominator.factors == other.denominator.factors
    }
}
