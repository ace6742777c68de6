//! The Baker-Campbell-Hausdorff series: published terms, exact groups, convergence to products of
//! matrices.

use crate::common::algebras::{algebras, by_table, catalogued};
use crate::common::{fraction, integer, labels, property::properties, rationals};
use affinor::group::Nilpotent;
use affinor::{Bracket, LieAlgebra};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Ring};
use nalgebra::DMatrix;
use proptest::collection::vec;
use proptest::prelude::*;

type Algebra = LieAlgebra<Rational>;
type Vector = Vec<Rational>;

fn scaled(x: &[Rational], by: Rational) -> Vector {
    x.iter().map(|x| x.clone() * &by).collect()
}

fn sum(x: &[Rational], y: &[Rational]) -> Vector {
    x.iter().zip(y).map(|(x, y)| x.clone() + y).collect()
}

/// The nested bracket `[a, [b, ... c]]` of a word of letters.
fn word(algebra: &Algebra, letters: &str, x: &[Rational], y: &[Rational]) -> Vector {
    let letter = |letter| if letter == 'x' { x.to_vec() } else { y.to_vec() };
    let mut letters = letters.chars().rev();
    let first = letter(letters.next().unwrap());
    letters.fold(first, |inner, next| algebra.bracket(&letter(next), &inner).unwrap())
}

/// The terms that textbooks and encyclopedias print, in right-normed brackets.
const PUBLISHED: [&[(&str, i64, i64)]; 5] = [
    &[("x", 1, 1), ("y", 1, 1)],
    &[("xy", 1, 2)],
    &[("xxy", 1, 12), ("yxy", -1, 12)],
    &[("yxxy", -1, 24)],
    &[
        ("yyyyx", -1, 720),
        ("xxxxy", -1, 720),
        ("xyyyx", 1, 360),
        ("yxxxy", 1, 360),
        ("yxyxy", 1, 120),
        ("xyxyx", 1, 120),
    ],
];

properties! {
    #![cases(32)]

    #[test]
    fn published_terms(
        (algebra, x, y) in algebras(5).prop_flat_map(|a| {
            let n = a.dimension();
            (Just(a), vec(rationals(), n), vec(rationals(), n))
        })
    ) {
        let parts = algebra.bch(&x, &y, 5).unwrap();
        for (part, terms) in parts.iter().zip(PUBLISHED) {
            let zero = vec![integer(0); x.len()];
            let expected = terms.iter().fold(zero, |total, &(letters, n, d)| {
                sum(&total, &scaled(&word(&algebra, letters, &x, &y), fraction(n, d)))
            });
            prop_assert_eq!(part, &expected);
        }
        // in degree 6 and above: log(exp(y)^-1 exp(x)^-1) is the negative
        let (back_x, back_y) = (scaled(&x, integer(-1)), scaled(&y, integer(-1)));
        let forth = algebra.bch(&x, &y, 8).unwrap();
        let back = algebra.bch(&back_y, &back_x, 8).unwrap();
        for (forth, back) in forth.iter().zip(&back) {
            prop_assert_eq!(forth, &scaled(back, integer(-1)));
        }
    }

    /// `T_left(x)^-1 v` is the part that is linear in `y = v`: its difference quotient at zero.
    #[test]
    fn the_linear_part(
        (algebra, x, v) in algebras(4).prop_flat_map(|a| {
            let n = a.dimension();
            (Just(a), vec(rationals(), n), vec(rationals(), n))
        })
    ) {
        let order = 7;
        let total = |by: Rational| -> Vector {
            let parts = algebra.bch(&x, &scaled(&v, by), order).unwrap();
            parts.iter().skip(1).fold(parts[0].clone(), |total, part| sum(&total, part))
        };
        // a polynomial of degree 7 in the factor: its slope at 0 from 8 values
        let nodes: Vec<i64> = (0..=order as i64).collect();
        let slope = nodes.iter().fold(vec![integer(0); x.len()], |slope, &at| {
            sum(&slope, &scaled(&total(integer(at)), weight(&nodes, at)))
        });
        prop_assert_eq!(slope, algebra.tangent_left_inverse(&x, &v, order - 1).unwrap());
    }

    #[test]
    fn products_are_associative(
        (algebra, numbers) in prop::sample::select(nilpotent()).prop_flat_map(|algebra| {
            let n = algebra.dimension();
            (Just(algebra), vec(rationals(), 3 * n))
        })
    ) {
        let n = algebra.dimension();
        let group = Nilpotent::new(algebra).unwrap();
        let (x, y, z) = (&numbers[..n], &numbers[n..2 * n], &numbers[2 * n..]);
        let product = |x: &[Rational], y: &[Rational]| group.product(x, y).unwrap();
        prop_assert_eq!(product(&product(x, y), z), product(x, &product(y, z)));
        prop_assert_eq!(product(x, &scaled(x, integer(-1))), vec![integer(0); n]);
    }

    /// Products of unitriangular matrices, whose exponentials and logarithms are finite sums.
    #[test]
    fn products_are_those_of_unitriangular_matrices(
        (size, numbers) in (3..=5usize).prop_flat_map(|size| (Just(size), vec(rationals(), size * (size - 1))))
    ) {
        let n = size * (size - 1) / 2;
        let group = Nilpotent::new(unitriangular(size)).unwrap();
        prop_assert_eq!(group.class(), size - 1);
        let (x, y) = numbers.split_at(n);
        let product = exponential(&strict(size, x)).mul(&exponential(&strict(size, y))).unwrap();
        let found = strict(size, &group.product(x, y).unwrap());
        prop_assert_eq!(logarithm(&product), found);
    }
}

/// The weight of the value at a node in the slope at 0 of the interpolating polynomial.
fn weight(nodes: &[i64], at: i64) -> Rational {
    let others = || nodes.iter().filter(move |node| **node != at);
    let product = |except: Option<i64>| {
        let kept = others().filter(|node| Some(**node) != except);
        kept.fold(integer(1), |product, node| product * &integer(-node))
    };
    let slope = others().fold(integer(0), |total, left| total + &product(Some(*left)));
    let size = others().fold(integer(1), |size, node| size * &integer(at - node));
    slope * &size.recip().unwrap()
}

fn nilpotent() -> Vec<Algebra> {
    // free on two generators: x, y, [x,y], [x,[x,y]], [y,[x,y]]; then a filiform one
    let free = by_table(5, &[(1, 2, 3, 1), (1, 3, 4, 1), (2, 3, 5, 1)]);
    let filiform =
        by_table(7, &[(1, 2, 3, 1), (1, 3, 4, 1), (1, 4, 5, 1), (1, 5, 6, 1), (1, 6, 7, 1)]);
    let known = ["R^3", "heisenberg(3)", "heisenberg(5)"].map(catalogued);
    known.into_iter().chain([free, filiform, unitriangular(4), unitriangular(5)]).collect()
}

fn places(size: usize) -> Vec<(usize, usize)> {
    (0..size).flat_map(|i| (i + 1..size).map(move |j| (i, j))).collect()
}

/// Strictly upper triangular matrices, row by row: `[E_ij, E_jk] = E_ik`.
fn unitriangular(size: usize) -> Algebra {
    let places = places(size);
    let mut constants = vec![];
    for (a, (i, j)) in places.iter().enumerate() {
        for (b, (k, l)) in places.iter().enumerate() {
            if j == k {
                let c = places.iter().position(|place| *place == (*i, *l)).unwrap();
                constants.push((a, b, c, integer(1)));
            }
        }
    }
    Bracket::from_constants(labels(places.len()), constants).unwrap().try_into().unwrap()
}

fn strict(size: usize, x: &[Rational]) -> Matrix<Rational> {
    let mut rows = vec![vec![]; size];
    for ((i, j), value) in places(size).into_iter().zip(x).filter(|(_, value)| !value.vanishes()) {
        rows[i].push((j, value.clone()));
    }
    Matrix::from_rows(size, rows).unwrap()
}

/// `sum_{k >= 1} c_k N^k`.
fn series(n: &Matrix<Rational>, coefficient: impl Fn(i64) -> Rational) -> Matrix<Rational> {
    let size = n.rows();
    let mut total = vec![vec![integer(0); size]; size];
    let mut power = n.clone();
    for k in 1..size as i64 {
        for (i, j, value) in power.entries() {
            total[i][j] = total[i][j].clone() + &(value.clone() * &coefficient(k));
        }
        power = power.mul(n).unwrap();
    }
    Matrix::from_dense(&total).unwrap()
}

fn shifted(m: &Matrix<Rational>, by: i64) -> Matrix<Rational> {
    let mut dense = m.to_dense();
    (0..m.rows()).for_each(|i| dense[i][i] = dense[i][i].clone() + &integer(by));
    Matrix::from_dense(&dense).unwrap()
}

fn exponential(n: &Matrix<Rational>) -> Matrix<Rational> {
    shifted(&series(n, |k| fraction(1, (1..=k).product())), 1)
}

fn logarithm(g: &Matrix<Rational>) -> Matrix<Rational> {
    series(&shifted(g, -1), |k| fraction(if k % 2 == 0 { -1 } else { 1 }, k))
}

/// Near zero the partial sums converge to the logarithm of the product.
#[test]
fn the_series_converges_to_products_of_matrices() {
    let of = |rows: &[f64]| {
        let size = (rows.len() as f64).sqrt() as usize;
        DMatrix::from_row_slice(size, size, rows)
    };
    let spins = [
        of(&[0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0]),
        of(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0]),
        of(&[0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    let traceless =
        [of(&[0.0, 1.0, 0.0, 0.0]), of(&[0.0, 0.0, 1.0, 0.0]), of(&[1.0, 0.0, 0.0, -1.0])];
    for (name, basis) in [("so(3)", spins), ("sl(2)", traceless)] {
        let algebra = catalogued(name).map(|v| v.to_f64()).unwrap();
        let (x, y) = ([0.3, -0.1, 0.2], [0.05, 0.25, -0.15]);
        let matrix = |x: &[f64]| &basis[0] * x[0] + &basis[1] * x[1] + &basis[2] * x[2];
        let product = matrix(&x).exp() * matrix(&y).exp();
        let parts = algebra.bch(&x, &y, 24).unwrap();
        let mut partial = vec![0.0; 3];
        let mut off = vec![];
        for part in parts {
            partial.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            off.push((matrix(&partial).exp() - &product).norm());
        }
        assert!(off[1] > 1e-4 && off[5] < 1e-4 && off[23] < 1e-14, "{name}: {off:?}");
    }
}
