//! The names of the parameters a value depends on, in their natural order.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Deref;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

/// A name. Every name is stored once, until the process ends, so that names are compared by their addresses.
#[derive(Clone, Copy)]
pub(super) struct Name(&'static Entry);

struct Entry {
    text: Box<str>,
    /// Numbers in the order of the names. Of names with equal numbers, [`natural`] decides.
    rank: u64,
    hash: u64,
    /// The number of names that were there before.
    index: usize,
}

static NAMES: LazyLock<Mutex<HashMap<&'static str, Name>>> = LazyLock::new(Mutex::default);

impl Name {
    pub fn new(text: &str) -> Self {
        let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(name) = names.get(text) {
            return *name;
        }
        let mut hasher = DefaultHasher::new();
        text.hash(&mut hasher);
        let (rank, hash, index) = (rank(text), hasher.finish(), names.len());
        let entry = Entry { text: text.into(), rank, hash, index };
        let entry: &'static Entry = Box::leak(Box::new(entry));
        names.insert(&entry.text, Name(entry));
        Name(entry)
    }

    /// A number that identifies the name in this process.
    pub fn address(self) -> usize {
        std::ptr::from_ref(self.0).addr()
    }
}

impl Deref for Name {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0.text
    }
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl Eq for Name {}

impl PartialOrd for Name {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Name {
    fn cmp(&self, other: &Self) -> Ordering {
        match self.0.rank.cmp(&other.0.rank) {
            Ordering::Equal if self != other => natural(self, other),
            order => order,
        }
    }
}

impl Hash for Name {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.0.hash);
    }
}

impl std::fmt::Debug for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.text.fmt(f)
    }
}

/// Names in natural order, each once.
pub(super) type Variables = Arc<[Name]>;

/// All names of these lists, each once, in no order.
pub(super) fn distinct<'v>(lists: impl Iterator<Item = &'v [Name]>) -> Vec<Name> {
    let mut found: Vec<Option<Name>> = Vec::new();
    for name in lists.flatten() {
        if found.len() <= name.0.index {
            found.resize(name.0.index + 1, None);
        }
        found[name.0.index] = Some(*name);
    }
    found.into_iter().flatten().collect()
}

/// All names of both lists.
pub(super) fn union(a: &Variables, b: &Variables) -> Variables {
    if a == b {
        return a.clone();
    }
    let mut all: Vec<Name> = a.iter().chain(b.iter()).copied().collect();
    all.sort_unstable();
    all.dedup();
    all.into()
}

/// The first letters of a name, the number of digits behind them and the first digits, in the order of names:
/// where [`natural`] says less, the number is less or equal.
fn rank(name: &str) -> u64 {
    if name.contains('(') {
        return 1 << 63;
    }
    let Some((letters, length, digits)) = pieces(name).next() else { return 0 };
    let mut first = [0; 4];
    let count = letters.len().min(4);
    first[..count].copy_from_slice(&letters.as_bytes()[..count]);
    let number = match letters.len() {
        0..=3 => {
            let digits = &digits[..digits.len().min(6)];
            (length.min(255) as u64) << 20 | digits.parse().unwrap_or(0)
        }
        _ => 0,
    };
    u64::from(u32::from_be_bytes(first)) << 28 | number
}

/// The place of each name in `all`, which includes the names.
pub(super) fn places(names: &Variables, all: &Variables) -> Vec<usize> {
    let mut at = 0;
    let place = |name: &Name| {
        while at < all.len() && all[at] != *name {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_ordered_by_letters_then_numbers_then_functions() {
        let sorted = [
            "",
            "1",
            "7",
            "11",
            "J",
            "J01",
            "J1",
            "J1a",
            "J2",
            "J10",
            "J999999",
            "J1000000",
            "J1000001",
            "J10000000",
            "K1",
            "Omeg9",
            "Omega",
            "Omega1",
            "Omega2",
            "Omega10",
            "_",
            "abc",
            "abc1",
            "abcd",
            "abcd1",
            "abcde",
            "b",
            "x_1",
            "x_2",
            "\u{e9}",
            "sin(J1)",
            "tan(J1/2)",
            "sin(J2)",
            "a(t)",
            "a_t(t)",
        ];
        let names = sorted.map(Name::new);
        for (i, a) in names.iter().enumerate() {
            assert_eq!(**a, *sorted[i]);
            for (j, b) in names.iter().enumerate() {
                assert_eq!(a.cmp(b), natural(a, b), "{a:?} {b:?}");
                assert_eq!(a.cmp(b), i.cmp(&j), "{a:?} {b:?}");
            }
        }
    }
}
