//! Root spaces, checked with the bracket alone.

use crate::common::algebras::catalogued;
use affinor::algebra::structure::StructureTheory;
use affinor::{BasisChange, Rational};
use affinor_tensors::linear::Row;
use affinor_tensors::{Down, Ring, Tensor, Up};

fn dense(row: &Row<Rational>, n: usize) -> Vec<Rational> {
    let mut vector = vec![Rational::from(0); n];
    row.iter().for_each(|(at, value)| vector[*at] = value.clone());
    vector
}

#[test]
fn root_vectors_are_eigenvectors() {
    for name in
        ["sl(2)", "sl(4)", "so(3,2)", "so(4,4)", "sp(6)", "G2", "F4", "sl(3)+G2+sl(2)", "so(2,2)"]
    {
        let structure = StructureTheory::new(catalogued(name));
        let (algebra, n) = (structure.algebra(), structure.dimension());
        let Some(found) = structure.root_spaces() else { panic!("{name} does not split") };
        let h = found.cartan.dense();
        assert_eq!(found.roots.len(), n - h.len(), "{name}");
        for root in &found.roots {
            let x = dense(&root.vector, n);
            for (h, value) in h.iter().zip(&root.values) {
                let scaled: Vec<Rational> = x.iter().map(|v| v.clone() * value).collect();
                assert_eq!(algebra.bracket(h, &x).unwrap(), scaled, "{name}");
            }
        }
        // alpha and -alpha, in the same order in both halves
        let half = found.roots.len() / 2;
        for (root, opposite) in found.roots[..half].iter().zip(&found.roots[half..]) {
            let negative: Vec<Rational> = root.values.iter().map(|v| -v.clone()).collect();
            assert_eq!(negative, opposite.values, "{name}");
        }
    }
}

/// The Cartan matrices by root strings and by the Killing form are the Cartan matrix of the type.
#[test]
fn cartan_matrices() {
    for name in ["sl(5)", "so(4,3)", "sp(6)", "so(4,4)", "G2", "F4", "E6", "sl(2)+so(3,2)"] {
        let structure = StructureTheory::new(catalogued(name));
        let Some(found) = structure.root_spaces() else { panic!("{name} does not split") };
        let matrix = found.cartan_matrix();
        let mut start = 0;
        for one in &found.types {
            for (i, row) in one.cartan_matrix().iter().enumerate() {
                assert_eq!(matrix[start + i][start..start + row.len()], row[..], "{name}");
                assert!(matrix[start + i][..start].iter().all(|value| *value == 0), "{name}");
            }
            start += one.rank();
        }
        assert_eq!(start, matrix.len(), "{name}");
        // a_ij = a_i(h_j) for the coroot h_j = 2 [x, y] / a_j([x, y]), with x, y in the spaces of a_j, -a_j
        let (algebra, n) = (structure.algebra(), structure.dimension());
        let half = found.roots.len() / 2;
        for (j, &at) in found.simple.iter().enumerate() {
            let [x, y] = [at, at + half].map(|at| dense(&found.roots[at].vector, n));
            let bracket = algebra.bracket(&x, &y).unwrap();
            let bracket: Row<Rational> =
                bracket.into_iter().enumerate().filter(|(_, v)| *v != Rational::from(0)).collect();
            let h = found.cartan.coordinates(&bracket).expect("[x, y] is in the Cartan subalgebra");
            let value = |root: usize| {
                let values = &found.roots[root].values;
                h.iter().fold(Rational::from(0), |sum, (k, v)| sum + &(v.clone() * &values[*k]))
            };
            for (i, &other) in found.simple.iter().enumerate() {
                assert_eq!(
                    value(other) * &Rational::from(2),
                    value(at) * &Rational::from(matrix[i][j]),
                    "{name}"
                );
            }
        }
    }
}

/// Compact and complex algebras do not split over a real field; so(x^2 + y^2 - 3 z^2) splits over
/// the reals only.
#[test]
fn some_do_not_split() {
    for name in ["so(3)", "so(3,1)", "su(3)", "so*(6)"] {
        assert!(StructureTheory::new(catalogued(name)).root_spaces().is_none(), "{name}");
    }
    assert!(StructureTheory::new(catalogued("se(3)")).root_spaces().is_none());
}

/// If many basis vectors commute, a root vanishes on most of their sums with small coefficients.
#[test]
fn cartan_subalgebras_of_many_commuting_vectors() {
    for (name, rank) in [("sl(16)", 15), ("so(8,8)", 8), ("gl(12)", 12), ("t(9)", 9)] {
        assert_eq!(StructureTheory::new(catalogued(name)).rank(), rank, "{name}");
    }
}

#[test]
#[ignore = "long: dimension 1599"]
fn cartan_subalgebra_of_sl_40() {
    assert_eq!(StructureTheory::new(catalogued("sl(40)")).rank(), 39);
}

/// A Cartan subalgebra is its own normalizer, also where every vector of the basis is nilpotent, and sums of two are.
#[test]
fn cartan_subalgebras_in_bases_of_nilpotent_vectors() {
    let algebra = catalogued("sl(2)+sl(2)");
    // e, f and e - f + h of each summand
    let vectors: Vec<Vec<i64>> = [0, 3]
        .into_iter()
        .flat_map(|at| [[1, 0, 0], [0, 1, 0], [1, -1, 1]].map(|x| (at, x)))
        .map(|(at, x)| (0..6).map(|i| if i / 3 == at / 3 { x[i % 3] } else { 0 }).collect())
        .collect();
    for first in (0..64_usize).filter(|set| set.count_ones() == 3) {
        // the positions of the vectors of the first summand
        let (inside, outside): (Vec<_>, Vec<_>) = (0..6).partition(|at| first >> at & 1 == 1);
        let places: Vec<usize> = inside.into_iter().chain(outside).collect();
        let change = Tensor::from_fn(6, [Up, Down], |[i, j]| {
            let at = places.iter().position(|place| *place == j).unwrap();
            Rational::from(vectors[at][i])
        });
        let change = BasisChange::new(change.unwrap()).unwrap();
        let structure = StructureTheory::new(algebra.change_basis(&change).unwrap());
        assert!((0..6).all(|at| structure.killing_matrix().get(at, at).vanishes()));
        let cartan = structure.cartan_subalgebra();
        assert_eq!(cartan.dimension(), 2);
        assert_eq!(structure.normalizer(&cartan), cartan, "{first:b}");
    }
}
