//! Sums that occur again and again are computed and stored once.
//!
//! The tensors of a large algebra have millions of components with a few thousand different values. A sum is known by the
//! addresses of its values, and returns the value that it had before; equal results share one address, so the sums of the next
//! tensor are recognised too. Only short sums of short values are remembered.

use super::super::effort::Counted;
use super::fraction::Fraction;
use super::product::Product;
use super::{Form, Rational, Symbolic};
use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

/// So many entries of a kind are remembered; then all are forgotten.
const MOST: usize = 1 << 14;

/// Longer sums are not remembered: they are computed slowly, and seldom repeated.
const MAX_PRODUCTS: usize = 24;

thread_local! {
    static KNOWN: RefCell<Known> = RefCell::default();
}

/// A sum with its value. The products keep their values alive, so that no other value takes their addresses.
struct Sum {
    constant: Rational,
    products: Vec<Product>,
    value: Symbolic,
    counted: Counted,
}

#[derive(Default)]
struct Known {
    /// Sums by the hash of their values' addresses, and values by their hash.
    sums: HashMap<u64, Sum>,
    values: HashMap<u64, Arc<Fraction>>,
}

/// The value of `constant + products`, which is computed if it is not known.
pub(super) fn value(
    constant: &Rational,
    products: &[Product],
    compute: impl FnOnce() -> Symbolic,
) -> Symbolic {
    let long = |f: &Arc<Fraction>| !f.is_short();
    if products.len() > MAX_PRODUCTS
        || products.iter().any(|p| p.factors.iter().flatten().any(long))
    {
        return compute();
    }
    let mut hasher = DefaultHasher::new();
    constant.hash(&mut hasher);
    for product in products {
        product.coefficient.hash(&mut hasher);
        product.addresses().hash(&mut hasher);
    }
    let key = hasher.finish();
    let same = |sum: &Sum| {
        let equal = |(a, b): (&Product, &Product)| {
            a.addresses() == b.addresses() && a.coefficient == b.coefficient
        };
        sum.constant == *constant
            && sum.products.len() == products.len()
            && sum.products.iter().zip(products).all(equal)
    };
    let found = KNOWN.with_borrow(|known| {
        let sum = known.sums.get(&key)?;
        same(sum).then(|| (sum.value.clone(), sum.counted))
    });
    if let Some((value, counted)) = found {
        counted.again();
        return value;
    }
    let (value, counted) = Counted::of(|| shared(compute()));
    let short = match &value.0 {
        Form::Constant(_) => true,
        Form::Fraction(f) => f.is_short(),
    };
    if let Some(counted) = counted.filter(|_| short) {
        let (constant, products) = (constant.clone(), products.to_vec());
        let sum = Sum { constant, products, value: value.clone(), counted };
        KNOWN.with_borrow_mut(|known| put(&mut known.sums, key, sum));
    }
    value
}

/// The value, at the address of an equal one that is known.
fn shared(value: Symbolic) -> Symbolic {
    let f = match &value.0 {
        Form::Fraction(f) if f.is_short() => f.clone(),
        _ => return value,
    };
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    let key = hasher.finish();
    KNOWN.with_borrow_mut(|known| match known.values.get(&key) {
        Some(known) if known.is_written_as(&f) => Symbolic(Form::Fraction(known.clone())),
        _ => {
            put(&mut known.values, key, f);
            value
        }
    })
}

/// Remembers an entry.
pub(super) fn put<T>(known: &mut HashMap<u64, T>, key: u64, entry: T) {
    if known.len() >= MOST {
        known.clear();
    }
    known.insert(key, entry);
}

impl Fraction {
    /// Whether the values are equal, with the same factors in the same order.
    fn is_written_as(&self, other: &Self) -> bool {
        self.variables == other.variables
            && self.numerator == other.numerator
            && self.denominator.monomial == other.denominator.monomial
            && self.denominator.factors == other.denominator.factors
    }
}
