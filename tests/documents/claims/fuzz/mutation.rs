//! Texts that are valid except for a few random changes.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// One change of a text.
#[derive(Clone, Debug)]
enum Change {
    Delete(Index, Index),
    Repeat(Index, Index, u8),
    Insert(Index, String),
    Replace(Index, String),
    Swap(Index, Index),
}

/// One of `seeds` with some changes, which may insert words of `words`.
pub fn mutants(
    seeds: &'static [&'static str],
    words: &'static [&'static str],
) -> impl Strategy<Value = String> {
    let word = || {
        prop_oneof![
            4 => select(words).prop_map(String::from),
            1 => any::<char>().prop_map(String::from),
        ]
    };
    let place = any::<Index>;
    let change = prop_oneof![
        2 => (place(), place()).prop_map(|(a, b)| Change::Delete(a, b)),
        1 => (place(), place(), any::<u8>()).prop_map(|(a, b, n)| Change::Repeat(a, b, n)),
        3 => (place(), word()).prop_map(|(a, word)| Change::Insert(a, word)),
        3 => (place(), word()).prop_map(|(a, word)| Change::Replace(a, word)),
        1 => (place(), place()).prop_map(|(a, b)| Change::Swap(a, b)),
    ];
    (select(seeds), vec(change, 0..6)).prop_map(|(seed, changes)| {
        changes.iter().fold(seed.to_string(), |text, change| change.apply(&text))
    })
}

/// Sequences of words.
pub fn sentences(words: &'static [&'static str], most: usize) -> impl Strategy<Value = String> {
    vec(select(words), 0..=most).prop_map(|words| words.concat())
}

/// Texts of any kind.
pub fn texts() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<String>(),
        vec(any::<u8>(), 0..200).prop_map(|bytes| String::from_utf8_lossy(&bytes).into_owned()),
    ]
}

impl Change {
    fn apply(&self, text: &str) -> String {
        let mut places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
        places.push(text.len());
        let range = |a: &Index, b: &Index, longest: usize| {
            let from = a.index(places.len());
            let to = (from + b.index(longest)).min(places.len() - 1);
            places[from]..places[to]
        };
        let spliced = |range: std::ops::Range<usize>, new: &str| {
            format!("{}{new}{}", &text[..range.start], &text[range.end..])
        };
        match self {
            Change::Delete(a, b) => spliced(range(a, b, 12), ""),
            Change::Repeat(a, b, n) => {
                let range = range(a, b, 12);
                spliced(range.clone(), &text[range].repeat(usize::from(*n)))
            }
            Change::Insert(a, word) => {
                spliced(places[a.index(places.len())]..places[a.index(places.len())], word)
            }
            Change::Replace(a, word) => spliced(range(a, a, 4), word),
            Change::Swap(a, b) => {
                let (a, b) = (a.index(places.len()), b.index(places.len()));
                let (a, b) = (places[a.min(b)], places[a.max(b)]);
                format!("{}{}", &text[b..], &text[..a]) + &text[a..b]
            }
        }
    }
}
