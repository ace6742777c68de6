//! Arbitrary input: read or refused, never with a panic, and never for long.
//!
//! `AFFINOR_FRESH=100 cargo test --release --test fuzz` takes a long run.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod definitions;
mod expressions;
mod mutation;
#[path = "../../tensors/tests/common/property.rs"]
mod property;
mod spaces;
mod stored;

use affinor::definition::InputError;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// Far longer than anything takes on an idle machine.
const LIMIT: Duration = Duration::from_secs(2);

/// Does `work` within the time limit; a panic in it is a panic here.
fn within<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    let worker = thread::spawn(move || drop(sender.send(work())));
    match receiver.recv_timeout(LIMIT) {
        Ok(value) => value,
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("not done after {LIMIT:?}"),
        Err(mpsc::RecvTimeoutError::Disconnected) => {
            let panic = worker.join().unwrap_err();
            std::panic::resume_unwind(panic)
        }
    }
}

/// An error says something, and stands in the text that it names.
fn assert_sound(error: &InputError) {
    assert!(!error.message.trim().is_empty());
    let Some(place) = &error.at else { return };
    if let Some(span) = &place.span {
        let text = &place.source.text;
        assert!(text.get(span.clone()).is_some(), "{error}: {span:?} in {text:?}");
    }
}
