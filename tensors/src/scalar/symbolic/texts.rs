//! Texts of values that occur again and again are written once.

use super::super::effort::Counted;
use super::fraction::Fraction;
use super::once::put;
use super::writing::Markup;
use super::{Form, Symbolic};
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

thread_local! {
    /// Texts by the address of the value.
    static KNOWN: RefCell<HashMap<u64, Text>> = RefCell::default();
}

/// The text of a value, whose address it keeps.
struct Text {
    value: Arc<Fraction>,
    markup: Markup,
    text: String,
    counted: Counted,
}

/// The text of a value, which is written if it is not known.
pub(super) fn text(value: &Symbolic, markup: Markup, write: impl FnOnce() -> String) -> String {
    let f = match &value.0 {
        Form::Fraction(f) if f.is_short() => f,
        _ => return write(),
    };
    let key = Arc::as_ptr(f) as u64;
    let found = KNOWN.with_borrow(|known| {
        let found = known.get(&key)?;
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
        KNOWN.with_borrow_mut(|known| put(known, key, entry));
    }
    text
}
