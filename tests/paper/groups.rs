//! Section 3: groups, brackets of fields and the canonical connections on them, (28)-(37).

use crate::common::charts::{constant, sum};
use crate::common::{inverse, labels};
use crate::paper::charts::{self, Group, groups};
use crate::paper::matrices::represented;
use crate::paper::{assert_tensors, epsilons, sl2, so3, tensor, values};
use affinor::algebra::Complex;
use affinor::{Canonical, Connection, Frame, MatrixBasis};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Tolerance, Up, contract};
use std::sync::Arc;

/// `nabla_X Y` with `X` and `Y` in left components.
fn along(connection: &Connection<Symbolic>, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
    let (x, y) = (Tensor::vector(x, Up), Tensor::vector(y, Up));
    let nabla = connection.nabla(&y).unwrap();
    assert_eq!(nabla.slots(), [Up, Down]);
    let along = contract("D^i_m X^m -> ^i", &[("D", &nabla), ("X", &x)]).unwrap();
    along.to_vector().unwrap()
}

/// The canonical connection over the left frame as a moving one.
fn canonical(group: &Group, which: Canonical) -> Connection<Symbolic> {
    let gamma = Connection::canonical(&group.chart.algebra, which).gamma().clone();
    Connection::new(group.frame(), gamma).unwrap()
}

fn unit(n: usize, j: usize) -> Vec<Symbolic> {
    (0..n).map(|i| constant(i64::from(i == j))).collect()
}

fn zero(n: usize) -> Vec<Symbolic> {
    vec![constant(0); n]
}

#[test]
fn eq_28_bracket_of_matrices_is_the_commutator() {
    for (name, algebra, basis) in represented() {
        let entries = basis.0.iter().map(|matrix| {
            let places = (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)));
            let entry = |(i, j)| (i, j, Complex::real(Rational::from_f64(matrix[(i, j)]).unwrap()));
            places.map(entry).collect()
        });
        let (n, size) = (basis.0.len(), basis.0[0].nrows());
        let of_matrices =
            MatrixBasis::new(labels(n), size, entries.collect(), Tolerance::default()).unwrap();
        let bracket = of_matrices.bracket().unwrap();
        assert_tensors(bracket.structure(), algebra.structure(), name);
    }
    // spin matrices: c = eps, the table of section 4
    assert_tensors(so3().structure(), &epsilons("1"), "so(3)");
    // [H, E] = 2 E as matrices: diag(1,-1) E12 - E12 diag(1,-1) = 2 E12
    let two = tensor(
        3,
        [Up, Down, Down],
        &[
            ([2, 1, 2], "2"),
            ([2, 2, 1], "-2"),
            ([3, 1, 3], "-2"),
            ([3, 3, 1], "2"),
            ([1, 2, 3], "1"),
            ([1, 3, 2], "-1"),
        ],
    );
    assert_tensors(sl2().structure(), &two, "sl(2)");
}

#[test]
fn eq_28_and_34_left_extensions_give_plus_c_and_right_extensions_minus_c() {
    for group in groups() {
        let (n, c) = (group.n(), group.chart.algebra.structure());
        for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
            let c = |sign: i64| -> Vec<_> {
                (0..n).map(|i| c.get(&[i, j, k]) * &constant(sign)).collect()
            };
            let left = group.lie(&group.left(j), &group.left(k));
            assert_eq!(left, group.to_coordinates(&c(1)), "{} {j} {k}", group.name);
            let right = group.lie(&group.right(j), &group.right(k));
            assert_eq!(right, charts::apply(&group.right, &c(-1)), "{} {j} {k}", group.name);
        }
    }
}

#[test]
fn eq_29_plus_is_the_bracket_with_left_invariant_fields() {
    for group in groups() {
        let (connection, [_, y]) = (canonical(&group, Canonical::Plus), group.fields());
        for j in 0..group.n() {
            let bracket = group.lie(&group.left(j), &group.to_coordinates(&y));
            let nabla = along(&connection, &unit(group.n(), j), &y);
            assert_eq!(group.to_coordinates(&nabla), bracket, "{} {j}", group.name);
        }
    }
}

#[test]
fn eq_30_minus_is_the_bracket_with_right_invariant_fields() {
    for group in groups() {
        let (connection, [_, y]) = (canonical(&group, Canonical::Minus), group.fields());
        for j in 0..group.n() {
            let bracket = group.lie(&group.right(j), &group.to_coordinates(&y));
            let nabla = along(&connection, &group.to_frame(&group.right(j)), &y);
            assert_eq!(group.to_coordinates(&nabla), bracket, "{} {j}", group.name);
        }
    }
}

#[test]
fn eq_31_zero_is_half_the_bracket_with_both() {
    for group in groups() {
        let (connection, [_, y]) = (canonical(&group, Canonical::Zero), group.fields());
        let coordinates = group.to_coordinates(&y);
        for j in 0..group.n() {
            // the right-invariant field through e_j(p), whose coefficients at p are constants
            let through = charts::apply(&inverse(&group.right), &group.left(j));
            let of_right = (0..group.n()).map(|m| group.lie(&group.right(m), &coordinates));
            let of_right: Vec<_> = of_right.collect();
            let left = group.lie(&group.left(j), &coordinates);
            let half = crate::paper::value::<Symbolic>("1/2");
            let expected: Vec<_> = (0..group.n())
                .map(|a| {
                    let right = sum(through.iter().zip(&of_right).map(|(v, x)| v.clone() * &x[a]));
                    (left[a].clone() + &right) * &half
                })
                .collect();
            let nabla = along(&connection, &unit(group.n(), j), &y);
            assert_eq!(group.to_coordinates(&nabla), expected, "{} {j}", group.name);
        }
    }
}

#[test]
fn eq_32_bracket_of_fields_takes_frame_derivatives_and_plus_c() {
    for group in groups() {
        let [x, y] = group.fields();
        let expected = group.lie(&group.to_coordinates(&x), &group.to_coordinates(&y));
        let found = group.bracket(&x, &y);
        assert_eq!(group.to_coordinates(&found), expected, "{}", group.name);
        // with -c it is another field
        let minus = group.chart.algebra.structure().scale(&constant(-1));
        let other = group.frame_of(minus).bracket(&x, &y).unwrap();
        assert_ne!(other, found, "{}: the sign of c", group.name);
    }
}

#[test]
fn eq_32_fails_with_coordinate_partials_in_a_left_frame() {
    // (A2) is true of coordinate bases only
    let group = charts::rotations();
    let [x, y] = group.fields();
    let (names, c) = (group.chart.names, group.chart.algebra.structure().clone());
    let partial = Arc::new(move |k: usize, f: &Symbolic| f.derivative(names[k]));
    let partials = Frame::moving(labels(group.n()), c, partial).unwrap();
    let printed = partials.bracket(&x, &y).unwrap();
    assert_ne!(printed, group.bracket(&x, &y));
}

#[test]
fn eq_34_bracket_of_constant_components() {
    // (2H + 3E + 5F) x (7H - E + F) in sl(2): H: 3 + 5, E: -4 - 42, F: -4 + 70
    let bracket = sl2().bracket(&values(["2", "3", "5"]), &values(["7", "-1", "1"])).unwrap();
    assert_eq!(bracket, values(["8", "-46", "66"]));
    // (85): the cross product on so(3)
    let bracket = so3().bracket(&values(["1", "2", "3"]), &values(["4", "5", "6"])).unwrap();
    assert_eq!(bracket, values(["-3", "6", "-3"]));
}

#[test]
fn eq_35_left_and_right_invariant_fields_commute() {
    for group in groups() {
        for (j, k) in (0..group.n()).flat_map(|j| (0..group.n()).map(move |k| (j, k))) {
            let right = group.to_frame(&group.right(k));
            let bracket = group.bracket(&unit(group.n(), j), &right);
            assert_eq!(bracket, zero(group.n()), "{} {j} {k}", group.name);
        }
    }
}

#[test]
fn eq_36_right_invariant_fields_are_parallel_for_plus_alone() {
    for group in groups() {
        for k in 0..group.n() {
            let right = Tensor::vector(&group.to_frame(&group.right(k)), Up);
            let plus = canonical(&group, Canonical::Plus).nabla(&right).unwrap();
            assert!(plus.is_empty(), "{} {k}", group.name);
        }
        // the first one is parallel neither for zero nor for minus
        let right = Tensor::vector(&group.to_frame(&group.right(0)), Up);
        for which in [Canonical::Zero, Canonical::Minus] {
            let nabla = canonical(&group, which).nabla(&right).unwrap();
            assert!(!nabla.is_empty(), "{} {which:?}", group.name);
        }
        // left-invariant fields are parallel for minus
        for k in 0..group.n() {
            let left = Tensor::vector(&unit(group.n(), k), Up);
            assert!(canonical(&group, Canonical::Minus).nabla(&left).unwrap().is_empty());
        }
    }
}

#[test]
fn eq_37_nabla_adds_frame_derivatives_and_c() {
    for group in groups() {
        let [x, y] = group.fields();
        let c = group.chart.algebra.structure();
        let expected: Vec<_> = (0..group.n())
            .map(|i| {
                sum((0..group.n()).map(|j| {
                    let turned = sum((0..group.n()).map(|k| c.get(&[i, j, k]) * &y[k]));
                    (group.chart.derive(j, &y[i]) + &turned) * &x[j]
                }))
            })
            .collect();
        let found = along(&canonical(&group, Canonical::Plus), &x, &y);
        assert_eq!(found, expected, "{}", group.name);
    }
}
