//! The laws of linear algebra over rationals, rational functions and floats.

use crate::common::matrices;
use crate::common::property::properties;
use affinor_tensors::linear::{Echelon, Matrix, Row};
use affinor_tensors::{Field, Notation, Rational, Ring, Scalar, Symbolic};
use matrices::{dense, from_words, same, square};
use num_traits::{One, Zero};
use proptest::collection::vec;
use proptest::prelude::*;

fn same_vector<S: Notation + Scalar>(a: &[S], b: &[S]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
}

fn same_matrix<S: Notation + Scalar>(a: &Matrix<S>, b: &Matrix<S>) -> bool {
    let rows = a.to_dense().into_iter().zip(b.to_dense());
    (a.rows(), a.columns()) == (b.rows(), b.columns())
        && rows.into_iter().all(|(a, b)| same_vector(&a, &b))
}

fn square_laws<S: Notation + Scalar>(
    a: &Matrix<S>,
    b: &Matrix<S>,
    x: &[S],
) -> Result<(), TestCaseError> {
    let n = a.rows();
    let determinant = a.determinant()?;
    prop_assert!(same(&a.transpose().determinant()?, &determinant));
    let product = determinant.clone() * &b.determinant()?;
    prop_assert!(same(&a.mul(b)?.determinant()?, &product));
    let images = a.apply(x)?.into_iter().zip(b.apply(x)?);
    let sums: Vec<S> = images.map(|(y, z)| y + &z).collect();
    prop_assert!(same_vector(&a.add(b)?.apply(x)?, &sums));
    prop_assert_eq!(a.add(&a.map(|value| -value.clone()))?, Matrix::zero(n, n));
    let Some(inverse) = a.inverse() else {
        prop_assert!(determinant.vanishes());
        prop_assert!(a.rank()? < n);
        return Ok(());
    };
    prop_assert!(!determinant.vanishes());
    prop_assert_eq!(a.rank()?, n);
    prop_assert!(same_matrix(&a.mul(&inverse)?, &Matrix::identity(n)));
    prop_assert!(same_matrix(&inverse.mul(a)?, &Matrix::identity(n)));
    let solution = a.solve(&a.apply(x)?)?;
    prop_assert!(solution.is_some_and(|y| same_vector(&y, x)));
    Ok(())
}

fn rectangle_laws<S: Notation + Scalar>(a: &Matrix<S>, x: &[S]) -> Result<(), TestCaseError> {
    let (echelon, nullspace) = (a.echelon()?, a.nullspace()?);
    prop_assert_eq!(echelon.rank() + nullspace.rows(), a.columns());
    prop_assert_eq!(nullspace.rank()?, nullspace.rows());
    prop_assert_eq!(a.rank()?, a.transpose().rank()?);
    let image = a.mul(&nullspace.transpose())?;
    prop_assert!(same_matrix(&image, &Matrix::zero(a.rows(), nullspace.rows())));
    let b = a.apply(x)?;
    let solution = a.solve(&b)?;
    prop_assert!(solution.is_some_and(|y| same_vector(&a.apply(&y).unwrap(), &b)));
    is_reduced(&echelon)?;
    let row_space = a.row_space()?;
    for i in 0..a.rows() {
        prop_assert!(echelon.contains(a.row(i).to_vec()));
        let coordinates = echelon.coordinates(a.row(i).to_vec()).unwrap();
        let again = row_space.transpose().apply(&coordinates)?;
        prop_assert!(same_vector(&again, &a.to_dense()[i]));
    }
    Ok(())
}

fn is_reduced<S: Field + Scalar>(echelon: &Echelon<S>) -> Result<(), TestCaseError> {
    prop_assert!(echelon.pivots().is_sorted_by(|a, b| a < b));
    let value = |row: &Row<S>, j| row.iter().find(|(k, _)| *k == j).map(|(_, v)| v.clone());
    for (pivot, row) in echelon.pivots().iter().zip(echelon.rows()) {
        prop_assert_eq!(&row[0], &(*pivot, S::one()));
        prop_assert!(row.is_sorted_by(|a, b| a.0 < b.0));
        let others = echelon.pivots().iter().filter(|other| *other != pivot);
        prop_assert!(others.into_iter().all(|other| value(row, *other).is_none()));
    }
    Ok(())
}

fn rational() -> impl Strategy<Value = Rational> {
    (-9i64..=9, 1i64..=9).prop_map(|(n, d)| Rational::new(n, d).unwrap())
}

/// A matrix of low rank: the product of a tall and a wide one, sparse every other time.
fn low_rank() -> impl Strategy<Value = (Matrix<Rational>, Vec<Rational>)> {
    (1usize..6, 0usize..4, 1usize..6, any::<bool>()).prop_flat_map(|(m, r, n, sparse)| {
        let entry = move || {
            (rational(), 0..3).prop_map(move |(x, k)| match sparse && k > 0 {
                true => Rational::zero(),
                false => x,
            })
        };
        let factors = (vec(entry(), m * r), vec(entry(), r * n), vec(rational(), n));
        factors.prop_map(move |(a, b, x)| {
            let a = dense(m, r, |i, j| a[i * r + j].clone());
            (a.mul(&dense(r, n, |i, j| b[i * n + j].clone())).unwrap(), x)
        })
    })
}

fn square_of<S: Scalar, T: Strategy<Value = S>>(
    n: usize,
    entry: impl Fn() -> T,
) -> impl Strategy<Value = (Matrix<S>, Matrix<S>, Vec<S>)> {
    (vec(entry(), n * n), vec(entry(), n * n), vec(entry(), n)).prop_map(move |(a, b, x)| {
        let matrix = |a: Vec<S>| dense(n, n, |i, j| a[i * n + j].clone());
        (matrix(a), matrix(b), x)
    })
}

properties! {
    #![cases(256)]

    #[test]
    fn square_rationals((a, b, x) in (0usize..6).prop_flat_map(|n| square_of(n, rational))) {
        square_laws(&a, &b, &x)?;
    }

    #[test]
    fn singular_rationals(rows in (2usize..5).prop_flat_map(square), n in -3i64..=3) {
        let mut rows = rows;
        rows[0] = rows[1].iter().map(|x| x * n).collect();
        let a = from_words::<Rational>(&rows);
        let x: Vec<_> = rows[1].iter().map(|n| Rational::from(*n)).collect();
        prop_assert!(a.inverse().is_none());
        square_laws(&a, &a.transpose(), &x)?;
    }

    #[test]
    fn rectangular_rationals((a, x) in low_rank()) {
        rectangle_laws(&a, &x)?;
    }

    /// Equal subspaces have equal bases, whichever way they were built.
    #[test]
    fn the_echelon_form_is_canonical((a, _) in low_rank(), start in 0usize..6) {
        let mut one_by_one = Echelon::new();
        for i in 0..a.rows() {
            let row = a.row((i + start) % a.rows()).to_vec();
            let independent = !one_by_one.contains(row.clone());
            prop_assert_eq!(one_by_one.insert(row)?, independent);
        }
        is_reduced(&one_by_one)?;
        prop_assert_eq!(one_by_one.rank(), a.rank()?);
        prop_assert_eq!(one_by_one, a.echelon()?);
    }

    #[test]
    fn a_vector_outside_the_image_is_no_right_hand_side((a, x) in low_rank()) {
        // the image is what the left nullspace annihilates
        let left = a.transpose().nullspace()?;
        let mut b = a.apply(&x)?;
        if let Some((i, _)) = left.row(0).first() {
            b[*i] = b[*i].clone() + &Rational::one();
            prop_assert_eq!(a.solve(&b)?, None);
        } else {
            prop_assert!(a.solve(&vec![Rational::one(); a.rows()])?.is_some());
        }
    }

    #[test]
    fn rows_exchanged_change_the_sign(
        (a, _, _) in square_of(5, rational),
        order in Just([0, 1, 2, 3, 4usize]).prop_shuffle(),
    ) {
        let permuted = Matrix::from_rows(5, order.map(|i| a.row(i).to_vec()))?;
        let pairs = (0..5).flat_map(|i| (0..i).map(move |j| (j, i)));
        let inversions = pairs.filter(|(j, i)| order[*j] > order[*i]).count();
        let expected = a.determinant()?;
        let sign = if inversions % 2 == 0 { expected } else { -expected };
        prop_assert_eq!(permuted.determinant()?, sign);
    }

    /// Strictly dominant diagonals, exchanged rows: condition numbers below about 20.
    #[test]
    fn well_conditioned_floats(
        (a, b, x) in (1usize..9).prop_flat_map(|n| square_of(n, || -1.0..1.0f64)),
        shift in 0usize..8,
    ) {
        let n = a.rows();
        let dominant = |m: &Matrix<f64>| {
            let diagonal = 1.2 * n as f64;
            let entry = |i, j| m.get(i, j) + if i == j { diagonal } else { 0.0 };
            dense(n, n, |i, j| entry((i + shift) % n, j) / diagonal)
        };
        square_laws(&dominant(&a), &dominant(&b), &x)?;
        rectangle_laws(&dominant(&a), &x)?;
    }

    /// Units of a basis do not matter: the inverse of `D A D` is `D^-1 A^-1 D^-1` to rounding, for a symmetric `A` near a diagonal of
    /// signs. Its other entries are of many sizes; units can make them the largest of their columns.
    #[test]
    fn units_do_not_matter(
        words in (1usize..8).prop_flat_map(square),
        (signs, sizes) in (vec(any::<bool>(), 8), vec(0i32..50, 64)),
        units in vec(-60i32..60, 8),
    ) {
        let n = words.len();
        let unit = |at: i32| 2f64.powi(at);
        let entry = |i: usize, j: usize| match (i.max(j), i.min(j)) {
            (k, l) if k == l => if signs[k] { 1.0 } else { -1.0 },
            (k, l) => words[k][l] as f64 / (4 * n) as f64 * unit(-sizes[8 * k + l]),
        };
        let exact = |x: f64| Rational::from_f64(x).expect("finite");
        let expected = dense(n, n, |i, j| exact(entry(i, j))).inverse().expect("dominant");
        let scaled = dense(n, n, |i, j| 1.3 * unit(units[i]) * entry(i, j) * unit(units[j]));
        let found = scaled.inverse().ok_or_else(|| TestCaseError::fail("no inverse"))?;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let found = 1.3 * unit(units[i]) * found.get(i, j) * unit(units[j]);
            let off = found - expected.get(i, j).to_f64();
            prop_assert!(off.abs() <= 1e-14, "{off} in {i}, {j}");
        }
    }

    /// The tolerance tells rounding from rank.
    #[test]
    fn floats_have_the_rank_of_the_integers(
        (a, b) in (1usize..7, 1usize..4, 1usize..7)
            .prop_flat_map(|(m, r, n)| (vec(vec(-3i64..=3, r), m), vec(vec(-3i64..=3, n), r))),
    ) {
        let exact = from_words::<Rational>(&a).mul(&from_words(&b))?;
        let float = exact.map(Rational::to_f64);
        prop_assert_eq!(float.rank()?, exact.rank()?);
        let ones = vec![1.0; float.columns()];
        rectangle_laws(&float, &ones)?;
    }
}

fn symbolic() -> impl Strategy<Value = Symbolic> {
    let linear = || {
        (-2i64..=2, -2i64..=2, -2i64..=2).prop_map(|(k, m, n)| {
            let [k, m, n] = [k, m, n].map(Symbolic::from_i64);
            m * Symbolic::parameter("a") + n * Symbolic::parameter("b") + k
        })
    };
    let quotient = (linear(), linear()).prop_map(|(n, d)| match d.recip() {
        Some(inverse) => n * inverse,
        None => n,
    });
    prop_oneof![1 => Just(Symbolic::zero()), 2 => linear(), 1 => quotient]
}

properties! {
    #![cases(24)]
    #[test]
    fn square_rational_functions((a, b, x) in (1usize..4).prop_flat_map(|n| square_of(n, symbolic))) {
        square_laws(&a, &b, &x)?;
    }

    #[test]
    fn rational_functions_of_low_rank((a, x) in (vec(symbolic(), 6), vec(symbolic(), 3))) {
        let [tall, wide] = [(3, 1, 0), (1, 3, 3)]
            .map(|(m, n, start)| dense(m, n, |i, j| a[start + i * n + j].clone()));
        rectangle_laws(&tall.mul(&wide)?, &x)?;
    }
}
