//! Elliptic functions and integrals agree with mpmath and quadrature.

use affinor::mechanics::bodies::elliptic::{Jacobi, first_kind, third_kind};

/// The stored lines of one kind.
fn lines(kind: &str) -> impl Iterator<Item = Vec<f64>> {
    include_str!("../../data/elliptic.txt").lines().filter_map(move |line| {
        let numbers = line.strip_prefix(kind)?.strip_prefix(' ')?;
        Some(numbers.split(' ').map(|number| number.parse().expect("a number")).collect())
    })
}

fn jacobi(complement: f64) -> Jacobi {
    Jacobi::new(((1.0 - complement) * (1.0 + complement)).sqrt(), complement)
}

/// Expects `found`, to a relative tolerance in units of the machine precision.
#[track_caller]
fn assert_close(found: f64, exact: f64, epsilons: f64, what: &[f64]) {
    let error = (found - exact).abs() / f64::EPSILON;
    assert!(error <= epsilons * exact.abs(), "{what:?}: {found:e}, {error} epsilons off");
}

#[test]
fn quarter_periods() {
    let mut count = 0;
    for line in lines("quarter") {
        assert_close(jacobi(line[0]).quarter_period(), line[1], 3.0, &line);
        count += 1;
    }
    assert_eq!(count, 7);
    // if only the complementary modulus is given: log(4/k')
    for complement in [1e-20, 1e-100, 1e-300] {
        let exact = 4_f64.ln() - f64::ln(complement);
        assert_close(jacobi(complement).quarter_period(), exact, 3.0, &[complement]);
    }
}

#[test]
fn functions_and_the_integral_of_the_first_kind() {
    let mut count = 0;
    for line in lines("jacobi") {
        let found = jacobi(line[0]).at(line[1]);
        // the argument is rounded once, on the scale of K
        let scale = jacobi(line[0]).quarter_period();
        for (found, exact) in found.into_iter().zip(&line[2..]) {
            let error = (found - exact).abs();
            assert!(error < 2.0 * scale * f64::EPSILON, "{line:?}: {found}, {error:e} off");
        }
        let exact = [line[2], line[3], line[4]];
        // an inverse sine loses accuracy towards its end, but not if cn is known too
        assert_close(first_kind(exact), line[1], 8.0, &line);
        count += 1;
    }
    assert_eq!(count, 28);
}

#[test]
fn the_integral_of_the_third_kind() {
    let mut count = 0;
    for line in lines("third") {
        let functions = lines("jacobi").find(|at| at[..2] == line[..2]).expect("the functions");
        let functions = [functions[2], functions[3], functions[4]];
        assert_close(third_kind(functions, line[2]), line[3], 12.0, &line);
        count += 1;
    }
    assert_eq!(count, 84);
}

#[test]
fn functions_have_their_periods_and_addition_theorem() {
    for complement in [1.0, 0.99, 0.5, 0.1, 1e-3] {
        let functions = jacobi(complement);
        let [quarter, m] = [functions.quarter_period(), (1.0 - complement) * (1.0 + complement)];
        for i in -20..20 {
            let (u, v) = (0.37 * f64::from(i), 0.61);
            let [s, c, d] = functions.at(u);
            let [s1, c1, d1] = functions.at(v);
            let scale = 1.0 - m * s * s * s1 * s1;
            let sum = [
                (s * c1 * d1 + s1 * c * d) / scale,
                (c * c1 - s * s1 * d * d1) / scale,
                (d * d1 - m * s * s1 * c * c1) / scale,
            ];
            let half = functions.at(u + 2.0 * quarter);
            let [found, back] = [functions.at(u + v), [-half[0], -half[1], half[2]]];
            for (i, exact) in [s, c, d].into_iter().enumerate() {
                assert!((found[i] - sum[i]).abs() < 1e-13, "{complement} {u}");
                assert!((back[i] - exact).abs() < 1e-14 * quarter, "{complement} {u}");
            }
        }
    }
}
