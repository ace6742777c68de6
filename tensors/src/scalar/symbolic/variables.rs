//! The names of the parameters a value depends on, in their natural order.

use std::cmp::Ordering;
use std::sync::Arc;

/// Names in natural order, each once.
pub(super) type Variables = Arc<[Arc<str>]>;

/// All names of both lists.
pub(super) fn union(a: &Variables, b: &Variables) -> Variables {
    if a == b {
        return a.clone();
    }
    let mut all: Vec<Arc<str>> = a.iter().chain(b.iter()).cloned().collect();
    all.sort_by(|a, b| natural(a, b));
    all.dedup();
    all.into()
}

/// The place of each name in `all`, which includes the names.
pub(super) fn places(names: &Variables, all: &Variables) -> Vec<usize> {
    let mut at = 0;
    let place = |name: &Arc<str>| {
        while at < all.len() && !Arc::ptr_eq(&all[at], name) && all[at] != *name {
            at += 1;
        }
        at += 1;
        at - 1
    };
    names.iter().map(place).collect()
}

/// Alphabetical, with numbers compared by value: `J2 < J10 < K1`. Functions follow, sorted by their
/// arguments, the sine first: `z < sin(x) < cos(x) < sin(y)`.
pub(super) fn natural(a: &str, b: &str) -> Ordering {
    let alphabetical = |a: &str, b: &str| pieces(a).cmp(pieces(b)).then_with(|| a.cmp(b));
    match (a.split_once('('), b.split_once('(')) {
        (Some((f, x)), Some((g, y))) => {
            alphabetical(x, y).then_with(|| (f != "sin", f).cmp(&(g != "sin", g)))
        }
        (Some(_), None) => Ordering::Greater,
        (None, Some(_)) => Ordering::Less,
        (None, None) => alphabetical(a, b),
    }
}

/// Letters and the number behind them, piece by piece; numbers as (length, digits).
fn pieces(name: &str) -> impl Iterator<Item = (&str, usize, &str)> {
    let mut rest = name;
    std::iter::from_fn(move || {
        let (letters, tail) = rest.split_at(rest.find(digit).unwrap_or(rest.len()));
        let (digits, tail) = tail.split_at(tail.find(|c| !digit(c)).unwrap_or(tail.len()));
        let number = digits.trim_start_matches('0');
        let done = rest.is_empty();
        rest = tail;
        (!done).then_some((letters, number.len(), number))
    })
}

fn digit(c: char) -> bool {
    c.is_ascii_digit()
}
