//! Dictionaries for Sage: `{('x', 'y'): {'z': 1}}` means `[x, y] = z`. A dictionary may be alone,
//! or in a call of `LieAlgebra`.
//!
//! The program may give the basis as `names='x,y,z'` or `L.<x,y,z>`. Otherwise [`order_of`]
//! determines the order of the names.

use super::brackets::order_of;
use super::{
    Entry, algebra, basis_vectors, enclosed, expect_characteristic_0, items, list, refuse,
    split_at_top, unquoted,
};
use crate::input::{InputError, Source, shown};
use crate::space::Definition;
use crate::space::notation::basis;
use affinor_tensors::expression::canonical_name;

/// Whether a text contains a dictionary of pairs, `{('x', ...`, or a call of `LieAlgebra` with a
/// dictionary.
pub(super) fn is_table(text: &str) -> bool {
    dictionary(text).is_some()
}

/// The text from the opening brace of the dictionary to the end.
fn dictionary(text: &str) -> Option<&str> {
    let is_program = text.contains("LieAlgebra(");
    let braces = text.match_indices('{').map(|(at, _)| &text[at..]);
    let opens = |brace: &&str| {
        let inside = brace[1..].trim_start();
        let pair = inside.strip_prefix('(').map(str::trim_start);
        pair.is_some_and(|pair| pair.starts_with(['\'', '"']))
            || (is_program && inside.starts_with('}'))
    };
    braces.into_iter().find(opens)
}

/// Reads the algebra from a dictionary.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    expect_characteristic_0(source)?;
    let text = source.content();
    let braces = dictionary(text).unwrap_or_default();
    let Some(inside) = enclosed(braces) else {
        return refuse(source, braces, "the dictionary has no end: `}` is missing");
    };
    let (mut entries, mut used) = (vec![], vec![]);
    for item in items(inside) {
        let form = "an item of the dictionary is ('x', 'y'): {'z': 1}";
        let [pair, right] = split_at_top(item, &[':'])[..] else {
            return refuse(source, item, form);
        };
        let right = right.trim();
        let terms = right.starts_with('{').then(|| enclosed(right)).flatten();
        let (Some([j, k]), Some(terms)) = (list(pair).as_deref().and_then(pair_of), terms) else {
            return refuse(source, item, form);
        };
        used.extend([j, k]);
        for term in items(terms) {
            let [i, value] = split_at_top(term, &[':'])[..] else {
                return refuse(source, term, form);
            };
            let i = unquoted(i);
            used.push(i);
            let (j, k) = (canonical_name(j), canonical_name(k));
            entries.push(Entry {
                j,
                k,
                i: canonical_name(i),
                negative: false,
                value: number(value),
                place: item,
            });
        }
    }
    let (labels, named) = match named(text) {
        Some(names) => (names, true),
        None => (order_of(&used)?, false),
    };
    let borrowed: Vec<&str> = labels.iter().map(String::as_str).collect();
    let indices = basis(&borrowed, &|_| source.whole(braces))?;
    let mut definition = algebra(source, basis_vectors(&borrowed), &entries, |name| {
        let at = indices.get(name).copied();
        at.ok_or_else(|| format!("`{}` is not a basis vector", shown(name)))
    })?;
    if !named {
        definition.note_basis();
    }
    Ok(definition)
}

fn pair_of<'t>(names: &[&'t str]) -> Option<[&'t str; 2]> {
    let [x, y] = names else { return None };
    Some([unquoted(x), unquoted(y)])
}

/// Removes the call that converts a value: `QQ('1/2')` becomes `1/2`.
fn number(value: &str) -> &str {
    let value = value.trim();
    let inside = ["QQ", "ZZ", "Rational", "Integer"].iter().find_map(|parent| {
        let rest = value.strip_prefix(parent)?.trim_start();
        rest.starts_with('(').then(|| enclosed(rest)).flatten()
    });
    inside.map_or(value, unquoted)
}

/// The names that the program gives to the basis vectors.
fn named(text: &str) -> Option<Vec<String>> {
    let generators = text.split_once(".<").and_then(|(_, rest)| rest.split_once('>'));
    let keyword = || {
        let (_, rest) = text.split_once("names")?;
        let rest = rest.trim_start().strip_prefix('=')?.trim_start();
        match rest.chars().next()? {
            quote @ ('\'' | '"') => rest[1..].split_once(quote).map(|(names, _)| names),
            _ => enclosed(rest),
        }
    };
    let names = generators.map(|(names, _)| names).or_else(keyword)?;
    let apart = |c: char| c == ',' || c.is_whitespace();
    let names = names.split(apart).map(unquoted).filter(|name| !name.is_empty());
    Some(names.map(|name| canonical_name(name).into_owned()).collect())
}
