//! Names that a misspelt name of a homogeneous space may mean.

use super::name::{FAMILIES, Name, compact};

/// The letters with which names of groups begin.
const GROUPS: [&str; 13] =
    ["SO", "SU", "U", "Sp", "Spin", "SL", "SE", "T", "G", "F", "E", "S", "O"];
/// The longest text that may be a misspelt name, and the largest number of names.
const LONGEST: usize = 64;
const MOST: usize = 3;

/// The names that differ from the text in the letters of its groups: in capitals, or in one letter.
pub(super) fn nearest(text: &str) -> Vec<String> {
    let named = compact(text);
    if named.len() > LONGEST || !named.is_ascii() {
        return vec![];
    }
    // the letters with which names of families begin
    let families = FAMILIES.iter().map(|family| family.pattern).filter(|p| !p.contains('/'));
    let families = families.filter_map(|p| p.split(|c: char| !c.is_ascii_alphabetic()).next());
    let heads = if named.contains('/') { GROUPS.to_vec() } else { families.collect() };
    let words = words(&named);
    // a name with capitals only is nearer than one with another letter
    for distance in 0..=1 {
        let mut found = vec![String::new()];
        for (word, is_head) in &words {
            let choices = match is_head {
                true => choices(word, &heads, distance),
                false => vec![(*word).to_string()],
            };
            let longer = found
                .iter()
                .flat_map(|name| choices.iter().map(move |choice| format!("{name}{choice}")));
            found = longer.take(LONGEST).collect();
        }
        found.retain(|name| *name != named && Name::read(name).is_ok());
        if !found.is_empty() {
            found.truncate(MOST);
            return found;
        }
    }
    vec![]
}

/// The heads at this distance from a word, or the word itself if it is a head.
fn choices(word: &str, heads: &[&str], distance: usize) -> Vec<String> {
    if heads.contains(&word) {
        return vec![word.to_string()];
    }
    let lower = word.to_lowercase();
    let near = |head: &&&str| strsim::damerau_levenshtein(&lower, &head.to_lowercase());
    let least = heads.iter().map(|head| near(&head)).min().unwrap_or(usize::MAX);
    let fits = |head: &&&str| near(head) == least && least <= distance;
    heads.iter().filter(fits).map(|head| head.to_string()).collect()
}

/// The words of letters at which groups begin, outside the arguments, and the texts between them.
fn words(text: &str) -> Vec<(&str, bool)> {
    let (mut parts, mut start, mut depth) = (vec![], 0, 0);
    let mut inside = None;
    for (at, c) in text.char_indices() {
        // `S(` encloses factors, and `x` separates them
        let separates = c == 'x'
            && text[..at].ends_with([')', '0', '1', '2', '3', '4', '5', '6', '7', '8', '9']);
        let letter = c.is_ascii_alphabetic() && depth == 0 && !separates;
        if letter != inside.is_some() && at > start {
            parts.push((&text[start..at], inside.is_some()));
            start = at;
        }
        inside = letter.then_some(());
        let encloses = c == '(' && (text[..at].ends_with("/S") || text[..at].ends_with("/s"));
        match c {
            '(' if !encloses => depth += 1,
            ')' => depth = (depth - 1).max(0),
            _ => {}
        }
    }
    if start < text.len() {
        parts.push((&text[start..], inside.is_some()));
    }
    parts
}
