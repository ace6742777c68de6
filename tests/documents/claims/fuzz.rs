//! Arbitrary input is read or is an error, and never causes a panic.
//!
//! Inputs are short, but their values may be large: the limits of the parser keep each case fast.
//! `AFFINOR_FRESH=100 cargo test --release --test documents fuzz` runs many more cases.
//!
//! Guards `Definition::parse`, `Expression::parse`, `Space`, `Statements` and `StoredTable`.

mod definitions;
mod expressions;
mod mutation;
mod spaces;
mod statements;
mod stored;

use affinor_documents::input::InputError;

/// Checks that an error has a message, and that its location is within its text.
fn assert_sound(error: &InputError) {
    assert!(!error.message.trim().is_empty());
    let Some(place) = &error.at else { return };
    if let Some(span) = &place.span {
        let text = &place.source.text;
        assert!(text.get(span.clone()).is_some(), "{error}: {span:?} in {text:?}");
    }
}
