//! Nilmanifolds in the notation of Salamon: `(0,0,12)` lists `de^1`, `de^2`, `de^3`, where `12`
//! means `e^1 e^2`.
//!
//! An equation `de^k = sum of a_ij e^i e^j` means `[e_i, e_j] = - a_ij e_k`, because `de^k(x, y) =
//! -e^k([x, y])`. Indices of several digits are separated by a dot, as in `1.10`, or by a comma in
//! braces, as in `{1,10}`. Terms may have factors, as in `2*13`. `0^3` means `0,0,0`.

use super::{Entry, enclosed, first_line, items, numbered, refuse};
use crate::input::{InputError, Source, shown};
use crate::space::Definition;

/// Whether a text begins with `(` and a number, a sign or a name, and the first line ends with `)`.
pub(super) fn is_table(text: &str) -> bool {
    let line = first_line(text).trim_end_matches([';', '.']).trim_end();
    if is_bare(line) {
        return true;
    }
    let inside = line.starts_with('(').then(|| enclosed(line)).flatten();
    inside.is_some_and(|inside| {
        let known = |c: char| c.is_alphanumeric() || " \t,.+-*/^_(){}−·".contains(c);
        inside.len() + 2 == line.len() && inside.contains(',') && inside.chars().all(known)
    })
}

/// Whether a line is a list without parentheses that begins with 0, as no row of CSV does.
fn is_bare(line: &str) -> bool {
    let items = items(line);
    let term =
        |item: &&str| zeros(item).is_some() || terms(item).iter().all(|(_, t)| form(t).is_some());
    items.len() > 2 && zeros(items[0]).is_some() && items.iter().all(term)
}

/// Reads the algebra from a list.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let line = first_line(text);
    let (_, rest) = text.split_once(line).unwrap_or_default();
    let second = first_line(rest);
    if !second.is_empty() {
        let message = "a second algebra follows: give only one";
        let help = "give one list: affinor table \"(0,0,12)\"";
        return Err(InputError::usage(message).at(&source.whole(second)).help(help));
    }
    let inside = if is_bare(line) { line } else { enclosed(line).unwrap_or_default() };
    let (mut entries, mut k) = (vec![], 0usize);
    for item in items(inside) {
        if let Some(count) = zeros(item) {
            k += count;
            continue;
        }
        k += 1;
        for (negative, term) in terms(item) {
            let Some((factor, [i, j])) = form(term) else {
                let message = format!("`{}` is not a term of de^{k}", shown(term));
                return Err(InputError::usage(message)
                    .at(&source.whole(if term.is_empty() { item } else { term }))
                    .help("write 12 for e^1 e^2, 1.10 for e^1 e^10, 2*12 with a factor"));
            };
            // sorts the indices, because e^j e^i = - e^i e^j
            let rising = i.parse::<usize>().ok() <= j.parse().ok();
            let (first, second) = if rising { (i, j) } else { (j, i) };
            let (j, k, i) = (first.into(), second.into(), k.to_string().into());
            // reverses the sign, because [e_i, e_j] has the opposite sign of de^k
            let negative = rising != negative;
            entries.push(Entry { j, k, i, negative, value: factor, place: term });
        }
    }
    if k == 0 {
        return refuse(source, line, "the list is empty");
    }
    numbered(source, k, &entries)
}

/// The number of zeros that an item means: 1 for `0`, and `n` for `0^n`.
fn zeros(item: &str) -> Option<usize> {
    let rest = item.strip_prefix('0')?.trim();
    match rest.strip_prefix('^') {
        Some(count) => count.trim().parse().ok().filter(|count| *count <= 4096),
        None => rest.is_empty().then_some(1),
    }
}

/// Splits a sum into its terms, each with its sign.
pub(super) fn terms(sum: &str) -> Vec<(bool, &str)> {
    let (mut depth, mut from, mut negative, mut terms) = (0i64, 0, false, vec![]);
    for (at, symbol) in sum.char_indices() {
        match symbol {
            '(' | '{' => depth += 1,
            ')' | '}' => depth -= 1,
            '+' | '-' | '−' if depth == 0 => {
                if !sum[..at].trim().is_empty() {
                    terms.push((negative, sum[from..at].trim()));
                }
                (negative, from) = (symbol != '+', at + symbol.len_utf8());
            }
            _ => {}
        }
    }
    terms.push((negative, sum[from..].trim()));
    terms
}

/// The factor and the two indices of a term: `12`, `1.10`, `{1,10}`, `a*12`, `2 12`.
pub(super) fn form(term: &str) -> Option<(&str, [&str; 2])> {
    let (factor, pair) = match term.rfind(['*', '·', ' ']) {
        Some(at) => {
            let behind = term[at..].chars().next().map_or(0, char::len_utf8);
            (term[..at].trim_end(), &term[at + behind..])
        }
        None => ("1", term),
    };
    let braced = pair.starts_with(['(', '{']).then(|| enclosed(pair)).flatten();
    let pair = braced.unwrap_or(pair).trim();
    let (i, j) = match pair.split_once(['.', ',']) {
        Some(parts) => parts,
        None if pair.len() == 2 && pair.is_ascii() => pair.split_at(1),
        None => return None,
    };
    let is_index = |at: &str| !at.is_empty() && at.bytes().all(|byte| byte.is_ascii_digit());
    let indices = [i.trim(), j.trim()];
    indices.iter().all(|at| is_index(at)).then_some((factor, indices))
}
