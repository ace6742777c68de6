//! The spaces of bi-invariant connections, and of connections that are invariant under a
//! subalgebra.

use crate::common::algebras::{algebras, by_table, catalogued, seeds};
use crate::common::{fraction, integer, property::properties, rationals, stored};
use affinor::algebra::invariants::invariant_tensors;
use affinor::{Connection, Error, LieAlgebra};
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::{Down, Rational, Tensor, Up, contract};
use proptest::collection::vec;
use proptest::prelude::*;

type Algebra = LieAlgebra<Rational>;

fn dimension(name: &str) -> usize {
    Connection::bi_invariant(&catalogued(name)).unwrap().len()
}

fn row(tensor: &Tensor<Rational>) -> Vec<(usize, Rational)> {
    let n = tensor.dimension();
    let key = |at: Vec<usize>| at.iter().fold(0, |key, index| key * n + index);
    stored(tensor).into_iter().map(|(at, value)| (key(at), value)).collect()
}

fn span(tensors: &[Tensor<Rational>]) -> Echelon<Rational> {
    let mut span = Echelon::new();
    for tensor in tensors {
        assert!(span.insert(row(tensor)).unwrap(), "a basis is independent");
    }
    span
}

/// The rank of the equations `(L_x Lambda)^i_jk = 0`, by plain sums.
fn rank(algebra: &Algebra, directions: &[Vec<Rational>]) -> usize {
    let (n, c) = (algebra.dimension(), algebra.structure_constants());
    let place = |i: usize, j: usize, k: usize| (i * n + j) * n + k;
    let mut rows = vec![];
    for x in directions {
        let ad = |i: usize, p: usize| {
            let terms = x.iter().enumerate().map(|(m, x)| c.get(&[i, m, p]) * x);
            terms.fold(integer(0), |sum, term| sum + &term)
        };
        let ad: Vec<Vec<_>> = (0..n).map(|i| (0..n).map(|p| ad(i, p)).collect()).collect();
        for [i, j, k] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
            let terms = (0..n).flat_map(|p| {
                [
                    (place(p, j, k), ad[i][p].clone()),
                    (place(i, p, k), -ad[p][j].clone()),
                    (place(i, j, p), -ad[p][k].clone()),
                ]
            });
            rows.push(terms.collect::<Vec<_>>());
        }
    }
    Matrix::from_rows(n.pow(3), rows).unwrap().rank().unwrap()
}

properties! {
    #![cases(24)]

    /// The basis spans the whole space: each connection is invariant, and the dimension is that of
    /// the equations.
    #[test]
    fn the_whole_space((algebra, x) in algebras(4).prop_flat_map(|algebra| {
        let n = algebra.dimension();
        (Just(algebra), vec(rationals(), n))
    })) {
        let n = algebra.dimension();
        let units = Matrix::<Rational>::identity(n).to_dense();
        let basis = Connection::bi_invariant(&algebra).unwrap();
        prop_assert_eq!(basis.len(), n.pow(3) - rank(&algebra, &units));
        let space = span(&basis);
        prop_assert!(space.contains(row(algebra.structure_constants())));
        for gamma in &basis {
            let connection = Connection::new(algebra.left_frame().clone(), gamma.clone()).unwrap();
            prop_assert!(connection.ad_invariance_defect().unwrap().is_empty());
            prop_assert!(connection.in_right_frame(&algebra).is_ok());
        }
        // invariance under one direction only
        let under = algebra.invariant_tensors(&[Up, Down, Down], std::slice::from_ref(&x)).unwrap();
        prop_assert_eq!(under.len(), n.pow(3) - rank(&algebra, std::slice::from_ref(&x)));
        let larger = span(&under);
        prop_assert!(basis.iter().all(|gamma| larger.contains(row(gamma))));
        let field = Tensor::vector(&x, Up);
        for gamma in &under {
            let frame = algebra.left_frame();
            prop_assert!(frame.lie_derivative(&field, gamma).unwrap().is_empty());
        }
        prop_assert_eq!(algebra.invariant_tensors(&[Up, Down, Down], &[]).unwrap().len(), n.pow(3));
    }

    /// The dimension does not depend on the basis, nor on the order of the directions.
    #[test]
    fn the_order_of_directions_is_free(algebra in algebras(4)) {
        let mut units = Matrix::<Rational>::identity(algebra.dimension()).to_dense();
        let forwards = algebra.invariant_tensors(&[Up, Down, Down], &units).unwrap();
        units.reverse();
        prop_assert_eq!(algebra.invariant_tensors(&[Up, Down, Down], &units).unwrap(), forwards);
    }
}

/// H. T. Laquer, *Trans. Amer. Math. Soc.* 331 (1992) 541-551: on a simple compact group the
/// bi-invariant connections are the multiples of `c`, but for SU(n), n >= 3, where there are two dimensions.
/// SO(6) is SU(4) up to covering.
#[test]
fn laquer() {
    for name in ["so(3)", "su(2)", "so(5)", "so(7)"] {
        let algebra = catalogued(name);
        let basis = Connection::bi_invariant(&algebra).unwrap();
        assert_eq!(basis.len(), 1, "{name}");
        assert!(span(&basis).contains(row(algebra.structure_constants())), "{name}");
    }
    for name in ["su(3)", "su(4)", "so(6)", "su(5)"] {
        assert_eq!(dimension(name), 2, "{name}");
    }
}

/// The dimension is invariant under complexification. So other real forms have the dimension of the
/// compact form, and a complex algebra over the reals has the dimension of two copies.
#[test]
fn other_real_forms() {
    for (name, expected) in [
        ("sl(2)", 1),
        ("so(2,1)", 1),
        ("so(3,2)", 1),
        ("sp(4)", 1),
        ("G2", 1),
        ("sl(3)", 2),
        ("A3", 2),
        ("so(3,3)", 2),
        ("so(3,1)", 2),
        ("so(4)", 2),
        ("so(3)+sl(3)", 3),
    ] {
        assert_eq!(dimension(name), expected, "{name}");
    }
}

/// Cases without Schur's lemma: every connection on R^n; so(3) + R by counting the invariant maps
/// `V x V -> V, V x V -> R, V x R -> V, R x V -> V, R x R -> R`.
#[test]
fn with_a_centre() {
    assert_eq!(dimension("R^1"), 1);
    assert_eq!(dimension("R^3"), 27);
    assert_eq!(dimension("so(3)+R^1"), 5);
    assert_eq!(dimension("so(3)+R^2"), 2 * 2 + 2 * 2 - 1 + 8);
}

/// The second connection of sl(n) is the trace-free symmetric product, `XY + YX - 2/n tr(XY) 1`.
#[test]
fn the_symmetric_tensor_of_sl() {
    let n = 3;
    let algebra = catalogued("sl(3)");
    let matrices: Vec<_> = algebra.labels().iter().map(|label| matrix(label, n)).collect();
    let times = |a: &[i64], b: &[i64]| -> Vec<i64> {
        let entry = |i, j| (0..n).map(|k| a[i * n + k] * b[k * n + j]).sum();
        (0..n * n).map(|at| entry(at / n, at % n)).collect()
    };
    let size = matrices.len();
    let columns = (0..n * n).map(|at| matrices.iter().map(|m| integer(m[at])).collect::<Vec<_>>());
    let coordinates = Matrix::from_dense(&columns.collect::<Vec<_>>()).unwrap();
    let symmetric = Tensor::from_components(
        size,
        &[Up, Down, Down],
        (0..size * size).flat_map(|pair| {
            let (j, k) = (pair / size, pair % size);
            let (xy, yx) = (times(&matrices[j], &matrices[k]), times(&matrices[k], &matrices[j]));
            let trace: i64 = (0..n).map(|i| xy[i * n + i]).sum();
            let entry = |at: usize| {
                let unit =
                    if at / n == at % n { fraction(2 * trace, n as i64) } else { integer(0) };
                integer(xy[at] + yx[at]) - &unit
            };
            let product: Vec<_> = (0..n * n).map(entry).collect();
            let product = coordinates.solve(&product).unwrap().unwrap();
            product.into_iter().enumerate().map(move |(i, value)| ([i, j, k], value))
        }),
    )
    .unwrap();
    assert!(!symmetric.is_empty());
    let space = span(&Connection::bi_invariant(&algebra).unwrap());
    assert!(space.contains(row(&symmetric)));
    // so zero is not the only torsion-free bi-invariant connection
    let operands = [("c", algebra.structure_constants()), ("d", &symmetric)];
    let gamma = contract("c^i_jk + 2 d^i_jk -> ^i_jk", &operands).unwrap().scale(&fraction(1, 2));
    let connection = Connection::new(algebra.left_frame().clone(), gamma).unwrap();
    assert!(connection.torsion().is_empty());
    assert!(connection.in_right_frame(&algebra).is_ok());
    assert!(connection.bianchi_first().is_empty());
}

/// The matrix of a label of sl(n): `E12`, `H1`.
fn matrix(label: &str, n: usize) -> Vec<i64> {
    let digit = |at: usize| label[at..=at].parse::<usize>().unwrap() - 1;
    let mut entries = vec![0; n * n];
    match &label[..1] {
        "E" => entries[digit(1) * n + digit(2)] = 1,
        _ => {
            let k = digit(1);
            (entries[k * n + k], entries[(k + 1) * n + k + 1]) = (1, -1);
        }
    }
    entries
}

/// Invariant bilinear forms: one for each simple ideal, which include the Killing form; on the
/// Heisenberg algebra the forms on the quotient by the centre.
#[test]
fn other_invariant_tensors() {
    let forms = |algebra: &Algebra| {
        let units = Matrix::<Rational>::identity(algebra.dimension()).to_dense();
        algebra.invariant_tensors(&[Down, Down], &units).unwrap()
    };
    for (name, expected) in [("so(3)", 1), ("sl(3)", 1), ("so(4)", 2), ("heisenberg(3)", 4)] {
        let algebra = catalogued(name);
        let basis = forms(&algebra);
        assert_eq!(basis.len(), expected, "{name}");
        assert!(span(&basis).contains(row(&algebra.killing_form())), "{name}");
    }
    for (name, algebra) in seeds() {
        let space = span(&forms(&algebra));
        assert!(space.contains(row(&algebra.killing_form())), "{name}");
        let units = Matrix::<Rational>::identity(algebra.dimension()).to_dense();
        // the identity commutes with everything
        let maps = algebra.invariant_tensors(&[Up, Down], &units).unwrap();
        assert!(span(&maps).contains(row(&Tensor::identity(algebra.dimension()))), "{name}");
    }
}

#[test]
fn limits_are_named() {
    let e8 = catalogued("E8");
    let refused = Connection::bi_invariant(&e8).unwrap_err();
    assert!(matches!(refused, Error::Size { size: 15_252_992, .. }), "{refused}");
    let wrong = invariant_tensors(3, &[Up], &[Tensor::<Rational>::identity(2)]);
    assert!(matches!(wrong, Err(Error::Shape { .. })));
    let line = by_table(1, &[]);
    let wrong = line.invariant_tensors(&[Up, Down, Down], &[vec![integer(1); 2]]);
    assert!(matches!(wrong, Err(Error::Shape { .. })));
}
