//! Brackets as in publications: `[x, y] = z, [y, z] = x`. They are separated by commas, semicolons
//! or lines; `#` begins a comment.
//!
//! A first line `basis x y z` gives the basis. Without such a line, the basis is deduced: names in
//! brackets are basis vectors, and so is the last name of a term that contains no other basis
//! vector. [`order_of`] determines the order of the basis vectors.

use super::{add, basis_vectors, first_line, marks, of_brackets, split_at_top};
use crate::input::{InputError, Source};
use crate::space::notation::{Names, basis, lines, statement};
use crate::space::{Definition, Pairs, check_dimension};
use affinor_tensors::expression::canonical_name;
use std::collections::{BTreeMap, BTreeSet};

/// Whether the first line begins with a bracket of two names and `=`, or names the basis.
pub(super) fn is_table(text: &str) -> bool {
    let first = first_line(text).trim_start_matches(['$', ' ']);
    let first = first.strip_prefix("\\left").unwrap_or(first);
    let inside = first.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    let statement = inside.is_some_and(|(pair, right)| {
        pair.matches(',').count() == 1 && right.trim_start().starts_with('=')
    });
    statement || named(first).is_some()
}

/// The names in a line `basis x y z`, which may also contain a colon and commas.
fn named(line: &str) -> Option<Vec<&str>> {
    let names = line.strip_prefix("basis")?;
    let names = names.trim_start_matches(':');
    let apart = |c: char| c == ',' || c.is_whitespace();
    let is_list = names.starts_with(apart) && !names.contains('=');
    is_list.then(|| names.split(apart).filter(|name| !name.is_empty()).collect())
}

/// Reads the algebra from the brackets.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let source = &marks::plain(source);
    let text = source.content();
    let first = first_line(text);
    let given_names = named(first);
    let statements: Vec<&str> =
        lines(text).filter(|line| given_names.is_none() || line.trim() != first).collect();
    let labels = match &given_names {
        Some(names) => names.iter().map(|name| canonical_name(name).into_owned()).collect(),
        None => {
            let found = vectors(&statements);
            // without a bracket, its message says what is missing
            if let (true, Some(line)) = (found.is_empty(), statements.first()) {
                statement(line, "", &Names::open(&BTreeMap::new(), None), source)?;
            }
            order_of(&found)?
        }
    };
    let borrowed: Vec<&str> = labels.iter().map(String::as_str).collect();
    let place = |at: usize| {
        let written = given_names.as_ref().and_then(|names| names.get(at));
        source.whole(written.copied().unwrap_or(first))
    };
    let indices = basis(&borrowed, &place)?;
    let names = Names::open(&indices, None);
    let mut given = Pairs::new();
    for line in statements {
        let (pair, right) = statement(line, "", &names, source)?;
        add(&mut given, pair, right)?;
    }
    let mut definition = of_brackets(source, basis_vectors(&borrowed), given);
    if given_names.is_none() {
        definition.note_basis();
    }
    Ok(definition)
}

/// The basis vectors in statements, in the order of their occurrence. A vector may occur several
/// times.
fn vectors<'t>(statements: &[&'t str]) -> Vec<&'t str> {
    let sides = |line: &&'t str| {
        let inside = line.trim().strip_prefix('[')?;
        inside.split_once(']')
    };
    let sides: Vec<(&str, &str)> = statements.iter().filter_map(sides).collect();
    let mut known: BTreeSet<&str> =
        sides.iter().flat_map(|(pair, _)| pair.split(',').map(str::trim)).collect();
    let mut vectors = vec![];
    for (pair, right) in sides {
        vectors.extend(pair.split(',').map(str::trim));
        for term in split_at_top(right, &['+', '-', '−']) {
            let names = names_in(term);
            if !names.iter().any(|name| known.contains(name)) {
                known.extend(names.last());
            }
            vectors.extend(names.into_iter().filter(|name| known.contains(name)));
        }
    }
    vectors
}

/// The names in a term.
fn names_in(term: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    let words = term.split(|c: char| !is_part(c));
    words.filter(|word| word.starts_with(|c: char| c.is_alphabetic() || c == '_')).collect()
}

/// Arranges names as a basis. If all names have the same stem and numbers from 1, such as `e1`,
/// `e4`, the basis is `e1`, `e2`, ... up to the highest number. Otherwise the names are in the
/// order of their first occurrence.
pub(super) fn order_of(names: &[&str]) -> Result<Vec<String>, InputError> {
    let mut distinct: Vec<String> = vec![];
    let mut seen = BTreeSet::new();
    for name in names {
        let name = canonical_name(name).into_owned();
        if seen.insert(name.clone()) {
            distinct.push(name);
        }
    }
    let stem = |name: &String| {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit()).to_string();
        let digits = &name[stem.len()..];
        let number: usize = digits.parse().ok()?;
        (!digits.starts_with('0')).then_some((stem, number))
    };
    let numbered: Option<Vec<(String, usize)>> = distinct.iter().map(stem).collect();
    let Some(numbered) = numbered.filter(|all| all.windows(2).all(|two| two[0].0 == two[1].0))
    else {
        return Ok(distinct);
    };
    let highest = numbered.iter().map(|(_, number)| *number).max().unwrap_or(0);
    let (n, stem) = (check_dimension(highest)?, &numbered[0].0);
    Ok((1..=n).map(|at| format!("{stem}{at}")).collect())
}
