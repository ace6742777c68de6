//! Lie algebras for the package DifferentialGeometry of Maple, in two forms. The first is
//! `LieAlgebraData([[x, y] = z], [x, y, z], Alg)`, which affinor writes. The second is
//! `_DG([["LieAlgebra", Alg, [n]], [[[i, j, k], v], ...]])`, which Maple prints; it means `[e_i,
//! e_j] = ... + v e_k`.

use super::{Entry, add, basis_vectors, enclosed, items, list, numbered, of_brackets, refuse};
use crate::input::{InputError, Source};
use crate::space::notation::{Names, basis, statement};
use crate::space::{Definition, Pairs};
use affinor_tensors::Symbolic;

const DATA: &str = "LieAlgebraData";
const PRINTED: &str = "_DG";

/// Whether a text calls one of the two constructors.
pub(super) fn is_table(text: &str) -> bool {
    call(text, DATA).or_else(|| call(text, PRINTED)).is_some()
}

/// The text after the name of a function that is called, beginning with its parenthesis.
fn call<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    let mut calls = text.match_indices(name).map(|(at, _)| text[at + name.len()..].trim_start());
    calls.find(|rest| rest.starts_with('('))
}

/// Reads the algebra from a table.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let mut definition = match call(text, DATA) {
        Some(call) => data(source, call)?,
        None => printed(source, call(text, PRINTED).unwrap_or_default())?,
    };
    // replaces Pi, which is the name of the constant in Maple
    if definition.parameters().iter().any(|name| name == "Pi") {
        definition.set(&[("Pi".to_string(), Symbolic::pi())].into())?;
    }
    Ok(definition)
}

fn data(source: &Source, call: &str) -> Result<Definition, InputError> {
    let arguments = enclosed(call).map(items).unwrap_or_default();
    let lists = arguments.get(..2).and_then(|both| Some((list(both[0])?, list(both[1])?)));
    let Some((brackets, labels)) = lists else {
        return refuse(source, call, "write LieAlgebraData([[x, y] = z, ...], [x, y, z], Alg)");
    };
    let vectors = basis_vectors(&labels);
    let borrowed: Vec<&str> = vectors.iter().map(String::as_str).collect();
    let indices = basis(&borrowed, &|at| source.whole(labels[at]))?;
    let names = Names::open(&indices, None);
    let mut given = Pairs::new();
    for line in brackets {
        let (pair, right) = statement(line, "", &names, source)?;
        add(&mut given, pair, right)?;
    }
    Ok(of_brackets(source, vectors, given))
}

fn printed(source: &Source, call: &str) -> Result<Definition, InputError> {
    const FORM: &str = "write _DG([[\"LieAlgebra\", Alg, [n]], [[[i, j, k], v], ...]])";
    let parts = enclosed(call).and_then(list).unwrap_or_default();
    let [head, rows] = parts[..] else { return refuse(source, call, FORM) };
    let kind = list(head).unwrap_or_default();
    let dimension = kind.get(2).and_then(|last| list(last)).unwrap_or_default();
    let dimension = dimension.first().and_then(|n| n.parse().ok());
    let (Some(n), Some(rows)) = (dimension, list(rows)) else { return refuse(source, call, FORM) };
    if kind[0].trim_matches('"') != "LieAlgebra" {
        return refuse(source, kind[0], "this object of Maple is not a Lie algebra");
    }
    let mut entries = vec![];
    for row in rows {
        let pair = list(row).unwrap_or_default();
        let at = pair.first().and_then(|at| list(at)).unwrap_or_default();
        let ([_, value], [j, k, i]) = (&pair[..], &at[..]) else {
            return refuse(source, row, "an entry is [[i, j, k], v]");
        };
        entries.push(Entry {
            j: (*j).into(),
            k: (*k).into(),
            i: (*i).into(),
            negative: false,
            value,
            place: row,
        });
    }
    numbered(source, n, &entries)
}
