//! Tokens that stop computations, on all threads.

use affinor_tensors::stop::{StopReason, StopToken, Stopped, checkpoint, detached, stage};
use affinor_tensors::{Effort, Limits, Symbolic, Tensor, Up, contract};
use rayon::ThreadPoolBuilder;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

fn set(reason: StopReason) -> StopToken {
    let token = StopToken::new();
    token.request(reason);
    token
}

#[test]
fn the_first_reason_counts() {
    let token = set(StopReason::Memory);
    token.request(StopReason::Timeout);
    assert_eq!(token.requested(), Some(StopReason::Memory));
    assert_eq!(StopToken::new().requested(), None);
}

/// A checkpoint stops only the work of its own token, and only while the work runs.
#[test]
fn tokens_nest_and_end() {
    let (outer, inner) = (StopToken::new(), set(StopReason::Timeout));
    checkpoint();
    let both = outer.run(|| {
        checkpoint();
        let inside = inner.run(|| {
            let _stage = stage("inner");
            checkpoint();
        });
        checkpoint();
        outer.request(StopReason::Interrupted);
        // the innermost token is in force
        StopToken::new().run(checkpoint).unwrap();
        inside
    });
    let inside = both.unwrap().unwrap_err();
    assert_eq!(inside, Stopped { reason: StopReason::Timeout, stage: "inner" });
    assert_eq!(outer.run(checkpoint).unwrap_err().stage, "");
    checkpoint();
}

/// Stages nest, also if the work unwinds.
#[test]
fn stages_nest() {
    let token = set(StopReason::Interrupted);
    let free = StopToken::new();
    let stopped = token.run(|| {
        let _outer = stage("outer");
        let panic = catch_unwind(AssertUnwindSafe(|| {
            let _inner = stage("inner");
            std::panic::resume_unwind(Box::new(()));
        }));
        assert!(panic.is_err());
        free.run(|| drop(stage("other"))).unwrap();
        checkpoint();
    });
    assert_eq!(stopped.unwrap_err().to_string(), "interrupted, in the stage `outer`");
}

/// Other panics are passed through a token.
#[test]
fn panics_are_no_stops() {
    let token = StopToken::new();
    let caught = catch_unwind(AssertUnwindSafe(|| {
        token.run(|| std::panic::resume_unwind(Box::new("a panic"))).is_err()
    }));
    assert_eq!(caught.unwrap_err().downcast_ref::<&str>(), Some(&"a panic"));
    let caught = catch_unwind(AssertUnwindSafe(|| {
        token.run(|| detached(|| -> u8 { std::panic::resume_unwind(Box::new(5_u8)) }))
    }));
    assert_eq!(caught.unwrap_err().downcast_ref::<u8>(), Some(&5));
}

/// A checkpoint in a destructor does not unwind again while the work unwinds.
#[test]
fn destructors_are_not_stopped() {
    struct Polls<'c>(&'c AtomicUsize);
    impl Drop for Polls<'_> {
        fn drop(&mut self) {
            checkpoint();
            self.0.fetch_add(1, Ordering::Relaxed);
        }
    }
    let count = AtomicUsize::new(0);
    let stopped = set(StopReason::Memory).run(|| {
        let _polls = Polls(&count);
        checkpoint();
    });
    assert!(stopped.is_err());
    assert_eq!(count.into_inner(), 1);
}

/// Workers of a contraction use the token of the caller, also threads with [`Limits`]; the limit on
/// terms applies in addition.
#[test]
fn all_threads_stop() {
    let vector = |letter: char| {
        let entry = |[i]: [usize; 1]| format!("{letter}{i} + 1").parse::<Symbolic>().unwrap();
        Tensor::from_fn(40, [Up], entry).unwrap()
    };
    let (a, b) = (vector('a'), vector('b'));
    let product = || contract("a^i b^j -> ^ij", &[("a", &a), ("b", &b)]).unwrap().len();
    for threads in [1, 4] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let token = set(StopReason::Interrupted);
        assert!(pool.install(|| token.run(product)).is_err());
        assert_eq!(pool.install(|| StopToken::new().run(product)), Ok(1600));
        let reached = Mutex::new(0);
        let stopped = token.run(|| {
            let limits = Limits::current();
            pool.broadcast(|_| {
                limits.run(checkpoint);
                *reached.lock().unwrap() += 1;
            });
        });
        assert!(stopped.is_err());
        assert_eq!(reached.into_inner().unwrap(), 0);
    }
    let effort = Effort::new(10);
    let bounded = StopToken::new().run(|| effort.bound(product).is_err());
    assert_eq!(bounded, Ok(true));
}
