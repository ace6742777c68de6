//! Names of isometry algebras: those of the catalogue, and the algebras of flat spaces.

use crate::algebra::invariants::invariant_tensors;
use crate::algebra::structure::{Killing, StructureTheory};
use crate::algebra::to_matrix;
use affinor_tensors::linear::Echelon;
use affinor_tensors::{Down, Rational, Ring, Tensor, Up};

/// The name of the algebra, if it has one.
pub(super) fn name(structure: &StructureTheory<Rational>) -> Option<String> {
    if structure.dimension() == 0 {
        return Some("0".into());
    }
    if structure.is_abelian() {
        return Some(format!("R^{}", structure.dimension()));
    }
    let found = structure.identify().map(|found| {
        let names: Vec<String> = found.names.iter().map(|name| usual(name)).collect();
        match found.parameter {
            Some(equation) => format!("{} with {equation}", names.join(" or ")),
            None => names.join(" or "),
        }
    });
    found.or_else(|| motions(structure))
}

/// Names of isometry algebras in the literature, for names of the catalogue.
const USUAL: [(&str, &str); 10] = [
    ("su(2)", "so(3)"),
    ("bianchi(IX)", "so(3)"),
    ("bianchi(VIII)", "sl(2,R)"),
    ("bianchi(VII,h=0)", "se(2)"),
    ("bianchi(VI,h=-1)", "iso(1,1)"),
    ("bianchi(II)", "heisenberg(3)"),
    ("degraaf(5,4)", "heisenberg(5)"),
    ("sl(2,C)", "so(3,1)"),
    ("su(2,2)", "so(4,2)"),
    ("su*(4)", "so(5,1)"),
];

/// A sum with the usual names of its summands.
fn usual(name: &str) -> String {
    let summand = |part: &str| {
        let part = part.trim();
        let known = USUAL.iter().find(|(catalogue, _)| *catalogue == part);
        known.map_or(part, |(_, usual)| usual).to_string()
    };
    name.split('+').map(summand).collect::<Vec<_>>().join(" + ")
}

/// The name of the algebra of motions of a flat space: `se(n)` or `iso(p,q)`.
///
/// Its radical is abelian, of dimension `n`. The Levi subalgebra acts faithfully on the radical and
/// preserves one form, which is not degenerate. It has the dimension of the orthogonal algebra of the
/// form, so it is the orthogonal algebra.
fn motions(structure: &StructureTheory<Rational>) -> Option<String> {
    let (radical, levi) = (structure.radical(), structure.levi().ok()?);
    let n = radical.dimension();
    if levi.dimension() != n * n.saturating_sub(1) / 2
        || !structure.subalgebra(radical).ok()?.is_abelian()
    {
        return None;
    }
    let algebra = structure.algebra();
    let translations = radical.dense();
    let mut span = Echelon::new();
    let mut actions = vec![];
    for x in levi.dense() {
        let mut entries = vec![];
        for (j, translation) in translations.iter().enumerate() {
            let image = algebra.bracket(&x, translation).ok()?;
            let image = image.into_iter().enumerate().filter(|(_, value)| !value.vanishes());
            let image = radical.coordinates(&image.collect::<Vec<_>>())?;
            entries.extend(image.into_iter().map(|(i, value)| ([i, j], value)));
        }
        let action = Tensor::from_components(n, &[Up, Down], entries).ok()?;
        span.insert(action.to_row()).ok()?;
        actions.push(action);
    }
    let forms = invariant_tensors(n, &[Down, Down], &actions).ok()?;
    let [form] = forms.as_slice() else { return None };
    if span.rank() != levi.dimension() || form.pair_symmetry(0, 1) != Some(1) {
        return None;
    }
    let [plus, minus, zero] = Killing::new(to_matrix(form)).signature()?;
    let (p, q) = (plus.max(minus), plus.min(minus));
    match (zero, q) {
        (0, 0) => Some(format!("se({p})")),
        (0, _) => Some(format!("iso({p},{q})")),
        _ => None,
    }
}

/// A description of an algebra without a name: its Levi factor and its radical.
pub(super) fn description(structure: &StructureTheory<Rational>) -> Option<String> {
    let radical = structure.radical();
    let inside = structure.subalgebra(radical).ok()?;
    let kind = match () {
        () if inside.is_abelian() => "abelian",
        () if inside.is_nilpotent() => "nilpotent",
        () => "solvable",
    };
    let radical = match name(&inside) {
        Some(name) => name,
        None => format!("{kind} of dimension {}", radical.dimension()),
    };
    let levi = structure.levi().ok()?;
    if levi.is_zero() {
        let nilradical = structure.nilradical();
        let inside = structure.subalgebra(&nilradical).ok()?;
        let dimension = nilradical.dimension();
        return Some(match name(&inside) {
            _ if dimension == structure.dimension() => {
                format!("nilpotent of dimension {dimension}")
            }
            Some(name) => format!("solvable, with nilradical {name}"),
            None => format!("solvable, with a nilradical of dimension {dimension}"),
        });
    }
    let levi = name(&structure.subalgebra(levi).ok()?)?;
    Some(match inside.dimension() {
        0 => levi,
        _ => format!("Levi factor {levi}, radical {radical}"),
    })
}
