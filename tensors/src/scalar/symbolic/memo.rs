//! Caches of the shapes and texts of values.
//!
//! The key of a shape consists of the address of the quotient and the lengths of the names. The key
//! of a text also contains the variables.

use super::super::effort::Counted;
use super::cache::{Cache, hash};
use super::fraction::{Fraction, Quotient};
use super::shape::Shape;
use super::variable::Variable;
use super::writing::Markup;
use super::{Form, Symbolic};
use std::cell::RefCell;
use std::sync::Arc;
use std::thread::LocalKey;

/// A cache of at most 65,536 entries for each thread. The values have at most 48 terms.
type Memo<T> = Cache<Box<Entry<T>>, { 1 << 14 }>;

struct Entry<T> {
    key: Box<[u64]>,
    /// Stored so that the address of the quotient is not reused while the entry exists.
    _quotient: Arc<Quotient>,
    value: T,
    counted: Counted,
}

thread_local! {
    static SHAPES: RefCell<Memo<Arc<Shape>>> = RefCell::default();
    static TEXTS: RefCell<Memo<Arc<str>>> = RefCell::default();
}

/// Clears the caches of shapes and texts in the current thread.
pub(super) fn clear() {
    SHAPES.take();
    TEXTS.take();
}

/// The shape of a fraction. It comes from the cache, or is computed by `make`.
pub(super) fn shape(f: &Fraction, make: impl FnOnce() -> Shape) -> Arc<Shape> {
    if !f.is_short() {
        return make().into();
    }
    let length = |variable: &Variable| match variable.is_parameter() && f.is_nameless() {
        true => variable.text().len(),
        false => variable.address(),
    };
    let address = Arc::as_ptr(&f.quotient).addr();
    let key = [address].into_iter().chain(f.variables.iter().map(length)).map(|word| word as u64);
    known(&SHAPES, f, key.collect(), || make().into())
}

/// The text of a value. It comes from the cache, or is computed by `write`.
pub(super) fn text(value: &Symbolic, markup: Markup, write: impl FnOnce() -> String) -> String {
    let f = match &value.0 {
        Form::Fraction(f) if f.is_short() => f,
        _ => return write(),
    };
    let address = Arc::as_ptr(&f.quotient).addr();
    let variables = f.variables.iter().map(|variable| variable.address());
    let key = [address, markup as usize].into_iter().chain(variables).map(|word| word as u64);
    known(&TEXTS, f, key.collect(), || write().into()).to_string()
}

fn known<T: Clone + 'static>(
    memo: &'static LocalKey<RefCell<Memo<T>>>,
    f: &Fraction,
    key: Box<[u64]>,
    make: impl FnOnce() -> T,
) -> T {
    let hash = hash(&key);
    let found = memo.with_borrow(|memo| {
        let found = memo.get(hash).filter(|entry| entry.key == key);
        found.map(|entry| (entry.value.clone(), entry.counted))
    });
    if let Some((value, counted)) = found {
        counted.again();
        return value;
    }
    let (value, counted) = Counted::of(make);
    if let Some(counted) = counted {
        let entry = Entry { key, _quotient: f.quotient.clone(), value: value.clone(), counted };
        memo.with_borrow_mut(|memo| memo.put(hash, Box::new(entry)));
    }
    value
}
