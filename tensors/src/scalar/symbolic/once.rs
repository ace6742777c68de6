//! Sums that occur again and again are computed and stored once.
//!
//! The tensors of a large algebra have millions of components with a few thousand different values. A sum is known by the
//! addresses of its values, and returns the value that it had before; equal results share one address, so the sums of the next
//! tensor are recognised too. The memory is small: a sum that is not found is computed.

use super::super::effort::Counted;
use super::fraction::Fraction;
use super::sum::Product;
use super::writing::Markup;
use super::{Form, Rational, Symbolic};
use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

/// The number of sums, and of values, that are remembered; a newer one takes the place of another.
const PLACES: usize = 1 << 12;

/// Longer sums and values are not remembered: they are computed slowly, and seldom repeated.
const MAX_PRODUCTS: usize = 24;
const MAX_TERMS: usize = 48;

thread_local! {
    static KNOWN: RefCell<Known> = const { RefCell::new(Known::new()) };
}

/// A sum with its value. The products keep their values alive, so that no other value takes their addresses.
struct Sum {
    constant: Rational,
    products: Vec<Product>,
    value: Symbolic,
    counted: Counted,
}

/// The text of a value, whose address it keeps.
struct Text {
    value: Arc<Fraction>,
    markup: Markup,
    text: String,
    counted: Counted,
}

struct Known {
    /// Sums by the hash of their values' addresses, and values by their hash.
    sums: Vec<Option<Sum>>,
    values: Vec<Option<Arc<Fraction>>>,
    /// Texts by the address of the value.
    texts: Vec<Option<Text>>,
}

impl Known {
    const fn new() -> Self {
        Known { sums: Vec::new(), values: Vec::new(), texts: Vec::new() }
    }
}

/// The value of `constant + products`, which is computed if it is not known.
pub(super) fn value(
    constant: &Rational,
    products: &[Product],
    compute: impl FnOnce() -> Symbolic,
) -> Symbolic {
    if products.len() > MAX_PRODUCTS {
        return compute();
    }
    let mut hasher = DefaultHasher::new();
    constant.hash(&mut hasher);
    for product in products {
        product.coefficient.hash(&mut hasher);
        product.addresses().hash(&mut hasher);
    }
    let place = hasher.finish() as usize % PLACES;
    let same = |sum: &Sum| {
        let equal = |(a, b): (&Product, &Product)| {
            a.addresses() == b.addresses() && a.coefficient == b.coefficient
        };
        sum.constant == *constant
            && sum.products.len() == products.len()
            && sum.products.iter().zip(products).all(equal)
    };
    let found = KNOWN.with_borrow(|known| {
        let sum = known.sums.get(place)?.as_ref()?;
        same(sum).then(|| (sum.value.clone(), sum.counted))
    });
    if let Some((value, counted)) = found {
        counted.again();
        return value;
    }
    let (value, counted) = Counted::of(|| shared(compute()));
    if let Some(counted) = counted.filter(|_| value.is_short()) {
        let (constant, products) = (constant.clone(), products.to_vec());
        let sum = Sum { constant, products, value: value.clone(), counted };
        KNOWN.with_borrow_mut(|known| put(&mut known.sums, place, sum));
    }
    value
}

/// The value, at the address of an equal one that is known.
fn shared(value: Symbolic) -> Symbolic {
    let f = match &value.0 {
        Form::Fraction(f) if value.is_short() => f.clone(),
        _ => return value,
    };
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    let place = hasher.finish() as usize % PLACES;
    KNOWN.with_borrow_mut(|known| match known.values.get(place).and_then(Option::as_ref) {
        Some(known) if known.is_written_as(&f) => Symbolic(Form::Fraction(known.clone())),
        _ => {
            put(&mut known.values, place, f);
            value
        }
    })
}

/// The text of a value, which is written if it is not known.
pub(super) fn text(value: &Symbolic, markup: Markup, write: impl FnOnce() -> String) -> String {
    let f = match &value.0 {
        Form::Fraction(f) if value.is_short() => f,
        _ => return write(),
    };
    // addresses are multiples of 16
    let place = (Arc::as_ptr(f) as usize >> 4) % PLACES;
    let found = KNOWN.with_borrow(|known| {
        let found = known.texts.get(place)?.as_ref()?;
        let same = Arc::ptr_eq(&found.value, f) && found.markup == markup;
        same.then(|| (found.text.clone(), found.counted))
    });
    if let Some((text, counted)) = found {
        counted.again();
        return text;
    }
    let (text, counted) = Counted::of(write);
    if let Some(counted) = counted {
        let entry = Text { value: f.clone(), markup, text: text.clone(), counted };
        KNOWN.with_borrow_mut(|known| put(&mut known.texts, place, entry));
    }
    text
}

fn put<T>(places: &mut Vec<Option<T>>, place: usize, entry: T) {
    if places.is_empty() {
        places.resize_with(PLACES, || None);
    }
    places[place] = Some(entry);
}

impl Symbolic {
    fn is_short(&self) -> bool {
        match &self.0 {
            Form::Constant(_) => true,
            Form::Fraction(f) => {
                let below = f.denominator.factors.iter().map(|(f, _)| f.polynomial.terms.len());
                below.fold(f.numerator.terms.len(), usize::saturating_add) <= MAX_TERMS
            }
        }
    }
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
