//! Programs of inverses and solutions choose their pivots; they agree with exact elimination at the
//! same numbers.

use crate::common::property::properties;
use affinor_tensors::linear::Matrix;
use affinor_tensors::scalar::{StraightLine, derivatives};
use affinor_tensors::{Notation, Rational, Recorded, Ring};
use num_traits::{One, Zero};
use proptest::prelude::*;

/// A symmetric matrix of numbers.
type Numbers = Vec<Vec<Rational>>;

fn name(i: usize, j: usize) -> String {
    format!("g{}{}", i.min(j), i.max(j))
}

/// The matrix with a parameter for each nonzero entry.
fn symbols(numbers: &Numbers) -> Vec<Vec<Recorded>> {
    let symbol = |i: usize, j: usize| match numbers[i][j].is_zero() {
        true => Recorded::zero(),
        false => Recorded::parameter(&name(i, j)).unwrap(),
    };
    (0..numbers.len()).map(|i| (0..numbers.len()).map(|j| symbol(i, j)).collect()).collect()
}

fn value(numbers: &Numbers, input: &str) -> Rational {
    let index = |at: usize| usize::from(input.as_bytes()[at] - b'0');
    numbers[index(1)][index(2)].clone()
}

fn inverse(rows: &Numbers) -> Option<Numbers> {
    Some(Matrix::from_dense(rows).unwrap().inverse()?.to_dense())
}

/// The program of the inverse of a matrix of parameters; `None` if it is singular for all values.
fn program(numbers: &Numbers) -> Option<StraightLine> {
    let inverse = Matrix::from_dense(&symbols(numbers)).unwrap().inverse()?;
    Some(StraightLine::new(&inverse.to_dense().concat()))
}

fn floats(program: &StraightLine, numbers: &Numbers) -> Vec<f64> {
    let input = |input: &str| value(numbers, input).to_f64();
    program.evaluate(input, |function, x| function.value(*x)).unwrap()
}

fn symmetric(n: usize, entries: &[Rational]) -> Numbers {
    let at = |i: usize, j: usize| entries[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)].clone();
    (0..n).map(|i| (0..n).map(|j| at(i, j)).collect()).collect()
}

/// Symmetric matrices of small integers, some of which are zero.
fn sparse() -> impl Strategy<Value = Numbers> {
    (3..=5usize).prop_flat_map(|n| {
        let entry = prop_oneof![1 => Just(0i64), 3 => -4..=4i64].prop_map(Rational::from);
        prop::collection::vec(entry, n * (n + 1) / 2).prop_map(move |all| symmetric(n, &all))
    })
}

/// Symmetric matrices of dyadic numbers with a leading minor that is smaller than the others by a
/// factor of `10^-decade`.
fn nearly_singular_corner() -> impl Strategy<Value = Numbers> {
    (3..=6usize, 2..=12i32).prop_flat_map(|(n, decade)| {
        let entry = (-4096..=4096i64).prop_map(|k| Rational::new(k, 1024).unwrap());
        (prop::collection::vec(entry, n * (n + 1) / 2), 0..n - 1).prop_map(move |(all, k)| {
            let mut numbers = symmetric(n, &all);
            let corner: Numbers = numbers[..=k].iter().map(|row| row[..=k].to_vec()).collect();
            if let Some(inverse) = inverse(&corner).filter(|inverse| !inverse[k][k].is_zero()) {
                // the Schur complement of the entry becomes about 10^-decade
                let schur = Rational::one() / &inverse[k][k];
                let shift = schur - &Rational::from_f64(10f64.powi(-decade)).unwrap();
                let entry = (numbers[k][k].clone() - &shift).to_f64();
                numbers[k][k] = Rational::from_f64(entry).unwrap();
            }
            numbers
        })
    })
}

/// Positive definite matrices `d_i H_ij d_j` with scales `d` from `10^-9` to `10^9`, and the scales.
fn definite_in_units() -> impl Strategy<Value = (Numbers, Vec<f64>)> {
    (3..=6usize).prop_flat_map(|n| {
        let rows = prop::collection::vec(prop::collection::vec(-8..=8i64, n), n);
        (rows, prop::collection::vec(-30..=30i32, n)).prop_map(move |(rows, exponents)| {
            let scales: Vec<f64> = exponents.iter().map(|e| f64::powi(2.0, *e)).collect();
            let entry = |i: usize, j: usize| {
                let product: i64 = rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum();
                let scale = Rational::from_f64(scales[i] * scales[j]).unwrap();
                Rational::from(product + i64::from(i == j)) * &scale
            };
            let numbers = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            (numbers, scales)
        })
    })
}

/// The largest sum of the sizes of the entries in a row.
fn norm(rows: &[Vec<f64>]) -> f64 {
    rows.iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
}

/// The largest error of the inverses of the matrices in the basis with these scales, relative to
/// the norm, in units of the machine precision and the condition number.
fn error(numbers: &Numbers, found: &[f64], scales: &[f64]) -> Option<f64> {
    let n = numbers.len();
    let scaled = |rows: &Numbers, sign: i32| -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| rows[i][j].to_f64() * (scales[i] * scales[j]).powi(sign);
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    };
    let exact = inverse(numbers)?;
    let error = |i: usize, j: usize| {
        let difference = Rational::from_f64(found[i * n + j])? - &exact[i][j];
        Some(difference.to_f64() * scales[i] * scales[j])
    };
    let errors: Option<Vec<Vec<f64>>> =
        (0..n).map(|i| (0..n).map(|j| error(i, j)).collect()).collect();
    let (matrix, exact) = (scaled(numbers, -1), scaled(&exact, 1));
    let condition = norm(&matrix) * norm(&exact);
    Some(norm(&errors?) / norm(&exact) / condition / f64::EPSILON)
}

properties! {
    #![cases(128)]

    /// The inverse is exact in exact arithmetic, symmetric, and equals the inverse of the matrix as
    /// a function.
    #[test]
    fn inverses_are_exact(numbers in sparse()) {
        let (n, matrix) = (numbers.len(), Matrix::from_dense(&symbols(&numbers)).unwrap());
        match (matrix.inverse(), inverse(&numbers)) {
            (Some(own), expected) => {
                prop_assert_eq!(matrix.mul(&own).unwrap(), Matrix::identity(n));
                prop_assert_eq!(own.transpose(), own.clone());
                // `None` if a divisor vanishes: small blocks are eliminated in the order of their
                // rows
                let found = program(&numbers).unwrap().evaluate(|x| value(&numbers, x), |_, x| x.clone());
                if let Some(found) = found {
                    prop_assert_eq!(Some(found), expected.map(|rows| rows.concat()));
                }
            }
            (None, expected) => prop_assert_eq!(expected, None),
        }
    }

    /// The only condition on a full matrix is that it is invertible.
    #[test]
    fn full_matrices_have_pivots(entries in prop::collection::vec(1..=3i64, 10), zeros in 0..1024u32) {
        // entries that are 0 for these numbers, but not as functions
        let entries = entries.iter().enumerate();
        let entries = entries.map(|(at, x)| Rational::from(if zeros >> at & 1 == 1 { 0 } else { *x }));
        let numbers = symmetric(4, &entries.collect::<Vec<_>>());
        let full = symmetric(4, &vec![Rational::one(); 10]);
        let found = program(&full).unwrap().evaluate(|x| value(&numbers, x), |_, x| x.clone());
        prop_assert_eq!(found, inverse(&numbers).map(|rows| rows.concat()));
    }

    /// Derivatives of the inverse are `-X dA X`, and those of a solution `A^-1 (db - dA x)`.
    #[test]
    fn derivatives_are_exact(numbers in sparse(), right in prop::collection::vec(-3..=3i64, 5)) {
        let n = numbers.len();
        let Some(x) = inverse(&numbers) else { return Ok(()) };
        let matrix = Matrix::from_dense(&symbols(&numbers)).unwrap();
        let own = matrix.inverse().unwrap().to_dense().concat();
        // a right side that depends on the parameter of the derivative
        let at = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let Some((p, q)) = at.clone().find(|(i, j)| !numbers[*i][*j].is_zero()) else { return Ok(()) };
        let parameter = Recorded::parameter(&name(p, q)).unwrap();
        let b: Vec<_> = right[..n].iter().map(|r| parameter.clone() * &Recorded::from_i64(*r)).collect();
        let solution = matrix.solve(&b).unwrap().unwrap();
        let rates = derivatives(&[own, solution].concat(), &name(p, q));
        let found = StraightLine::new(&rates).evaluate(|x| value(&numbers, x), |_, x| x.clone());
        let Some(found) = found else { return Ok(()) };
        let unit = |i: usize, j: usize| (i, j) == (p, q) || (j, i) == (p, q);
        let unit = |i: usize, j: usize| Rational::from(i64::from(unit(i, j)));
        let rate = Matrix::from_dense(&(0..n).map(|i| (0..n).map(|j| unit(i, j)).collect()).collect::<Vec<_>>()).unwrap();
        let x = Matrix::from_dense(&x).unwrap();
        let of_inverse = x.mul(&rate).unwrap().mul(&x).unwrap();
        let b = Matrix::from_dense(&right[..n].iter().map(|r| vec![Rational::from(*r)]).collect::<Vec<_>>()).unwrap();
        let scale = value(&numbers, &name(p, q));
        // d(X b s) = X b - X dA X b s
        let of_solution: Vec<Rational> = x.mul(&b).unwrap().to_dense().concat().into_iter()
            .zip(of_inverse.mul(&b).unwrap().to_dense().concat())
            .map(|(first, second)| first - &(second * &scale))
            .collect();
        let of_inverse = of_inverse.to_dense().concat().into_iter().map(|entry| -entry);
        prop_assert_eq!(found, of_inverse.chain(of_solution).collect::<Vec<_>>());
    }

    /// Systems that are not symmetric are solved.
    #[test]
    fn systems_are_solved(numbers in prop::collection::vec(prop::collection::vec(-3..=3i64, 4), 4)) {
        let rows = |of: &dyn Fn(usize, usize) -> Recorded| -> Vec<Vec<Recorded>> {
            (0..4).map(|i| (0..4).map(|j| of(i, j)).collect()).collect()
        };
        let matrix = rows(&|i, j| Recorded::parameter(&format!("a{i}{j}")).unwrap());
        let right: Vec<_> = (0..4).map(|i| Recorded::parameter(&format!("b{i}")).unwrap()).collect();
        let x = Matrix::from_dense(&matrix).unwrap().solve(&right).unwrap().unwrap();
        for (row, right) in matrix.iter().zip(&right) {
            let sum = row.iter().zip(&x).fold(Recorded::zero(), |sum, (a, x)| sum + &(a.clone() * x));
            prop_assert_eq!(&sum, right);
        }
        let at = |name: &str, at: usize| usize::from(name.as_bytes()[at] - b'0');
        let value = |name: &str| Rational::from(match name.as_bytes()[0] {
            b'a' => numbers[at(name, 1)][at(name, 2)],
            _ => at(name, 1) as i64 + 1,
        });
        let exact: Vec<Vec<_>> = numbers.iter().map(|row| row.iter().map(|x| Rational::from(*x)).collect()).collect();
        let exact = Matrix::from_dense(&exact).unwrap();
        let found = StraightLine::new(&x).evaluate(value, |_, x| x.clone());
        let unique = exact.inverse().is_some();
        let expected = exact.solve(&(1..5).map(Rational::from).collect::<Vec<_>>()).unwrap();
        prop_assert_eq!(found, expected.filter(|_| unique));
    }
}

properties! {
    #![cases(400)]

    /// The error of the inverse of an indefinite matrix is at most 4 times the machine precision times the condition number,
    /// if leading minors nearly vanish.
    #[test]
    fn inverses_of_indefinite_matrices_are_accurate(numbers in nearly_singular_corner()) {
        let Some(program) = program(&numbers) else { return Ok(()) };
        if inverse(&numbers).is_none() {
            return Ok(());
        }
        if let Some(error) = error(&numbers, &floats(&program, &numbers), &[1.0; 6]) {
            prop_assert!(error < 4.0, "{error}: {numbers:?}");
        }
    }

    /// The error of the inverse of a definite matrix does not depend on the units of the basis.
    #[test]
    fn inverses_of_definite_matrices_are_accurate_in_all_units((numbers, scales) in definite_in_units()) {
        let program = program(&numbers).unwrap();
        let size = |i: usize| (numbers[i][i].to_f64() / scales[i] / scales[i]).sqrt() * scales[i];
        let scales: Vec<f64> = (0..numbers.len()).map(size).collect();
        let error = error(&numbers, &floats(&program, &numbers), &scales).unwrap();
        prop_assert!(error < 4.0, "{error}: {numbers:?}");
    }
}

/// Numbers next to a matrix do not change its program, and a block of two rows is eliminated as it
/// would be alone.
#[test]
fn blocks_are_eliminated_alone() {
    let ones = |n: usize| symmetric(n, &vec![Rational::one(); n * (n + 1) / 2]);
    let [two, three] = [2, 3].map(|n| symbols(&ones(n)));
    let other =
        |i: usize, j: usize| Recorded::parameter(&format!("h{}{}", i.min(j), i.max(j))).unwrap();
    let mut rows = vec![vec![Recorded::zero(); 6]; 6];
    // the blocks interlock: rows 0, 2, 4 and rows 1, 3
    for i in 0..3 {
        for j in 0..3 {
            rows[2 * i][2 * j] = three[i][j].clone();
            if i < 2 && j < 2 {
                rows[2 * i + 1][2 * j + 1] = other(i, j);
            }
        }
    }
    rows[5][5] = Recorded::from_i64(3);
    let inverse = Matrix::from_dense(&rows).unwrap().inverse().unwrap().to_dense();
    let part = |places: &[usize]| -> StraightLine {
        let entries = places.iter().flat_map(|i| places.iter().map(|j| inverse[*i][*j].clone()));
        StraightLine::new(&entries.collect::<Vec<_>>())
    };
    let alone = |rows: &[Vec<Recorded>]| {
        let inverse = Matrix::from_dense(rows).unwrap().inverse().unwrap();
        StraightLine::new(&inverse.to_dense().concat())
    };
    assert_eq!(part(&[0, 2, 4]), alone(&three));
    let named = |i: usize| (0..2).map(|j| other(i, j)).collect();
    assert_eq!(part(&[1, 3]), alone(&(0..2).map(named).collect::<Vec<_>>()));
    assert_eq!(part(&[1, 3]).count().comparisons, 0);
    assert_eq!(alone(&two).count().comparisons, 0);
    assert_eq!(inverse[5][5], Recorded::from_quotient(1, 3).unwrap());
}

/// A matrix that is singular for all values has no inverse, and a system with it is solved if it has a solution.
#[test]
fn singular_matrices_of_parameters() {
    let [a, b, c] = ["a", "b", "c"].map(|name| Recorded::parameter(name).unwrap());
    let sum = |x: &Recorded, y: &Recorded| x.clone() + y;
    let first = [a.clone(), b.clone(), sum(&a, &b)];
    let second = [b.clone(), c.clone(), sum(&b, &c)];
    let third = [sum(&a, &b), sum(&b, &c), sum(&sum(&a, &b), &sum(&b, &c))];
    let matrix = Matrix::from_dense(&[first.to_vec(), second.to_vec(), third.to_vec()]).unwrap();
    assert!(matrix.inverse().is_none());
    let right = [a.clone(), b.clone(), sum(&a, &b)];
    let x = matrix.solve(&right).unwrap().unwrap();
    assert_eq!(x, [Recorded::one(), Recorded::zero(), Recorded::zero()]);
    assert_eq!(matrix.solve(&[a.clone(), b, a]).unwrap(), None);
}
