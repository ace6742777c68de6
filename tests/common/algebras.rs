//! Lie algebras: explicit ones in random bases, two-step nilpotent and semidirect ones.

use super::{integer, invertible, labels, rationals, tensors};
use affinor::algebra::catalogue;
use affinor::{BasisChange, Bracket, Error, LieAlgebra};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up};
use proptest::collection::vec;
use proptest::prelude::*;

type Algebra = LieAlgebra<Rational>;

/// The algebra with `[e_j, e_k] = ... + v e_i` for each `(j, k, i, v)`, with indices from 1.
pub fn by_table(n: usize, table: &[(usize, usize, usize, i64)]) -> Algebra {
    let constants = table.iter().map(|&(j, k, i, v)| (j - 1, k - 1, i - 1, integer(v)));
    Bracket::from_constants(labels(n), constants).unwrap().try_into().unwrap()
}

/// An algebra of the catalogue without parameters, or a sum of such algebras: `so(3)+R^1`.
pub fn catalogued(name: &str) -> Algebra {
    let summand = |name: &str| -> Algebra {
        let entry = catalogue::find(name).unwrap();
        let bracket = entry.bracket::<_, Error>(|value| Ok(value.as_constant().cloned().unwrap()));
        bracket.unwrap().try_into().unwrap()
    };
    let summands = name.split('+').map(summand);
    summands.reduce(|sum, summand| sum.direct_sum(&summand).unwrap()).unwrap()
}

/// The algebra over rational functions.
pub fn symbolic(algebra: &Algebra) -> LieAlgebra<Symbolic> {
    algebra.map(|value| Symbolic::constant(value.clone())).unwrap()
}

/// Algebras of every kind, with their names.
pub fn seeds() -> Vec<(&'static str, Algebra)> {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let sl2 = by_table(3, &[(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1)]);
    let heisenberg = by_table(3, &[(1, 2, 3, 1)]);
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let line = by_table(1, &[]);
    let rotations = [(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)];
    let translations =
        [(1, 5, 6, 1), (1, 6, 5, -1), (2, 6, 4, 1), (2, 4, 6, -1), (3, 4, 5, 1), (3, 5, 4, -1)];
    let plane = [(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1), (1, 4, 4, 1), (1, 5, 5, -1)];
    let sum = |a: &Algebra, b: &Algebra| a.direct_sum(b).unwrap();
    vec![
        ("so(3)", so3.clone()),
        ("sl(2)", sl2.clone()),
        ("so(2,1)", by_table(3, &[(1, 2, 3, -1), (2, 3, 1, 1), (3, 1, 2, 1)])),
        ("heisenberg(3)", heisenberg.clone()),
        ("heisenberg(5)", by_table(5, &[(1, 2, 5, 1), (3, 4, 5, 1)])),
        ("aff(1) + R", sum(&affine, &line)),
        ("aff(1) + aff(1)", sum(&affine, &affine)),
        ("se(2)", by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)])),
        ("se(3)", by_table(6, &[&rotations[..], &translations].concat())),
        ("bianchi(IV)", by_table(3, &[(1, 3, 1, 1), (2, 3, 1, 1), (2, 3, 2, 1)])),
        ("filiform(4)", by_table(4, &[(1, 2, 3, 1), (1, 3, 4, 1)])),
        ("sl(2) x R^2", by_table(5, &[&plane[..], &[(2, 5, 4, 1), (3, 4, 5, 1)]].concat())),
        ("so(3) + R", sum(&so3, &line)),
        ("so(3) + aff(1)", sum(&so3, &affine)),
        ("sl(2) + heisenberg(3)", sum(&sl2, &heisenberg)),
    ]
}

/// Algebras of dimension 3 up to `most`. All but three of the seeds are not semisimple, and most of
/// the remaining ones are not unimodular.
pub fn algebras(most: usize) -> impl Strategy<Value = Algebra> {
    let fits = move |n: &usize| (3..=most).contains(n);
    let seeds: Vec<_> = seeds().into_iter().filter(|(_, a)| fits(&a.dimension())).collect();
    let raw = prop_oneof![
        3 => prop::sample::select(seeds).prop_map(|(_, algebra)| algebra),
        1 => nilpotent(most),
        2 => semidirect(most),
        1 => by_commuting_family(most.max(4)),
    ];
    raw.prop_flat_map(|algebra| {
        (invertible(algebra.dimension()), any::<bool>()).prop_map(move |(a, change)| {
            let basis = BasisChange::new(a).unwrap();
            if change { algebra.change_basis(&basis).unwrap() } else { algebra.clone() }
        })
    })
}

/// A two-step nilpotent algebra: a random skew map gives `[V, V]` in the centre `Z`.
fn nilpotent(most: usize) -> impl Strategy<Value = Algebra> {
    let sizes = (2..=4usize).prop_flat_map(|v| (Just(v), 1..=3usize));
    sizes.prop_filter("within the dimension", move |(v, z)| v + z <= most).prop_flat_map(
        |(v, z)| {
            vec(rationals(), v * (v - 1) / 2 * z).prop_map(move |values| {
                let pairs = (0..v).flat_map(|j| (j + 1..v).map(move |k| (j, k)));
                let slots = pairs.flat_map(|(j, k)| (v..v + z).map(move |i| (j, k, i)));
                let constants = slots.zip(values).map(|((j, k, i), value)| (j, k, i, value));
                Bracket::from_constants(labels(v + z), constants).unwrap().try_into().unwrap()
            })
        },
    )
}

/// The last basis vector acts on `R^n`: `[e_n+1, e_j] = A^i_j e_i`.
fn semidirect(most: usize) -> impl Strategy<Value = Algebra> {
    (2..most).prop_flat_map(|n| tensors(n, [Up, Down])).prop_map(|a| acting(a.dimension(), &[a]))
}

/// Two vectors act on `R^n` by `A` and `A^2 + A + 1`, which commute.
fn by_commuting_family(most: usize) -> impl Strategy<Value = Algebra> {
    (2..=most - 2).prop_flat_map(|n| tensors(n, [Up, Down])).prop_map(|a| {
        let n = a.dimension();
        let other = Tensor::from_fn(n, [Up, Down], |[i, j]| {
            let square = (0..n).map(|k| a.get(&[i, k]) * &a.get(&[k, j]));
            square.fold(a.get(&[i, j]) + &integer((i == j) as i64), |sum, term| sum + &term)
        });
        acting(n, &[a, other.unwrap()])
    })
}

/// Additional basis vectors act on `R^n` by commuting matrices.
fn acting(n: usize, matrices: &[Tensor<Rational>]) -> Algebra {
    let constants = matrices.iter().enumerate().flat_map(|(at, a)| {
        a.components().map(move |(ij, value)| (n + at, ij[1], ij[0], value.clone()))
    });
    let bracket = Bracket::from_constants(labels(n + matrices.len()), constants);
    bracket.unwrap().try_into().unwrap()
}
