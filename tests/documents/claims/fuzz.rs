//! Arbitrary input is read or refused, and never causes a panic.
//!
//! Inputs are short, but their values need not be: the limits of the parser keep each case short, or the tests would not
//! end. `AFFINOR_FRESH=100 cargo test --release --test documents fuzz` takes a long run.
//!
//! Guards `Definition::parse`, `Expression::parse`, `Space`, `Statements` and `StoredTable`.

mod definitions;
mod expressions;
mod mutation;
mod spaces;
mod statements;
mod stored;

use affinor_documents::input::InputError;

/// An error has a message, and its place is in the text that it names.
fn assert_sound(error: &InputError) {
    assert!(!error.message.trim().is_empty());
    let Some(place) = &error.at else { return };
    if let Some(span) = &place.span {
        let text = &place.source.text;
        assert!(text.get(span.clone()).is_some(), "{error}: {span:?} in {text:?}");
    }
}
