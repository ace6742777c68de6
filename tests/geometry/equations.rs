//! Equations of motion agree with formulas in other forms: Euler's, Kirchhoff's, geodesics.

use crate::common::algebras::seeds;
use crate::common::{integer, property::properties, spaces};
use affinor::geometry::equations::{EquationKind, Equations, Row, Variable};
use affinor::{CanonicalConnection, Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Field, Rational, Scalar, Symbolic, Tensor};
use proptest::prelude::*;

type Vector<S> = [S; 3];

fn cross<S: Field + Scalar>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    let minor = |i: usize, j: usize| a[i].clone() * &b[j] - &(a[j].clone() * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn seed(name: &str) -> LieAlgebra<Rational> {
    seeds().into_iter().find(|(other, _)| *other == name).unwrap().1
}

fn metric<S: Field + Scalar>(algebra: &LieAlgebra<S>, rows: &[Vec<S>]) -> Metric<S> {
    let n = algebra.dimension();
    let tensor = Tensor::from_fn(n, [Down, Down], |[i, j]| rows[i][j].clone()).unwrap();
    Metric::new(algebra.labels(), tensor).unwrap()
}

/// `J v` for a symmetric matrix.
fn times<S: Field + Scalar>(matrix: &[Vec<S>], vector: &[S]) -> Vec<S> {
    let row =
        |row: &Vec<S>| row.iter().zip(vector).fold(S::zero(), |sum, (a, b)| sum + &(a.clone() * b));
    matrix.iter().map(row).collect()
}

/// (108) with every moment and product of inertia a symbol: `J dOmega/dt + Omega x J Omega = M`.
#[test]
fn eq_108_with_a_full_symbolic_inertia() {
    let so3 = seed("so(3)").map(|v| Symbolic::constant(v.clone())).unwrap();
    let symbol = |name: String| Symbolic::parameter(&name);
    let inertia: Vec<Vec<Symbolic>> = (1..4)
        .map(|i: usize| (1..4).map(|j| symbol(format!("J{}{}", i.min(j), i.max(j)))).collect())
        .collect();
    let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    let equations = Equations::euler_poincare(&plus, &metric(&so3, &inertia)).unwrap();
    let vector = |letter: &str| [1, 2, 3].map(|i| symbol(format!("{letter}{i}")));
    let (omega, torque) = (vector("w"), vector("m"));
    let momentum: Vector<Symbolic> = times(&inertia, &omega).try_into().unwrap();
    let gyroscopic = cross(&omega, &momentum);
    let rate = equations.rate(&omega, &torque).unwrap();
    let left = times(&inertia, &rate);
    for i in 0..3 {
        assert_eq!(left[i].clone() + &gyroscopic[i], torque[i]);
    }
}

/// Kirchhoff's equations of a body in a fluid (Lamb, Hydrodynamics, 124): `dP/dt = P x Omega + F`,
/// `dL/dt = L x Omega + P x V + N` with `(L, P)` the momenta of `(Omega, V)`.
#[test]
fn kirchhoff_on_se3() {
    let se3 = seed("se(3)");
    let entry = |i: usize, j: usize| {
        let (i, j) = (i.min(j) as i64, i.max(j) as i64);
        integer(if i == j { 20 + 3 * i } else { (2 * i + 3 * j) % 7 - 3 })
    };
    let matrix: Vec<Vec<Rational>> =
        (0..6).map(|i| (0..6).map(|j| entry(i, j)).collect()).collect();
    let plus = Connection::canonical(&se3, CanonicalConnection::Plus);
    let equations = Equations::euler_poincare(&plus, &metric(&se3, &matrix)).unwrap();
    let state = [2, -1, 3, 5, -4, 1].map(integer);
    let wrench = [1, 0, -2, 3, 1, 1].map(integer);
    let split = |v: &[Rational]| -> [Vector<Rational>; 2] {
        [v[..3].to_vec().try_into().unwrap(), v[3..].to_vec().try_into().unwrap()]
    };
    let ([omega, velocity], [l, p]) = (split(&state), split(&times(&matrix, &state)));
    let rates = times(&matrix, &equations.rate(&state, &wrench).unwrap());
    let (turned, carried, swept) = (cross(&l, &omega), cross(&p, &velocity), cross(&p, &omega));
    for i in 0..3 {
        assert_eq!(rates[i], turned[i].clone() + &carried[i] + &wrench[i], "dL/dt");
        assert_eq!(rates[i + 3], swept[i].clone() + &wrench[i + 3], "dP/dt");
    }
}

properties! {
    #![cases(48)]

    /// Geodesics of a left-invariant metric: the Levi-Civita connection gives the Euler-Poincare
    /// equations in both of its ways, and `zero` half of the quadratic terms.
    #[test]
    fn geodesics_are_euler_poincare(space in spaces(5)) {
        let (algebra, metric) = (&space.algebra, &space.metric);
        let motion = |connection: &Connection<Rational>| {
            Equations::euler_poincare(connection, metric).unwrap().solved()
        };
        let plus = motion(&Connection::canonical(algebra, CanonicalConnection::Plus));
        let levi_civita = space.levi_civita();
        prop_assert_eq!(motion(&levi_civita).rows(), plus.rows());
        let geodesics = Equations::new(EquationKind::Autoparallel, &levi_civita, None).unwrap();
        let free = |rows: Vec<Row<Rational>>| rows.into_iter().map(|mut row| {
            row.right.retain(|(_, product)| !matches!(product[..], [Variable::Force(_)]));
            row
        }).collect::<Vec<_>>();
        prop_assert_eq!(geodesics.rows(), free(plus.rows()));
        let zero = motion(&Connection::canonical(algebra, CanonicalConnection::Zero));
        let halves = free(plus.rows()).into_iter().map(|mut row| {
            row.right.iter_mut().for_each(|(v, _)| *v = v.clone() / &integer(2));
            row
        });
        prop_assert_eq!(free(zero.rows()), halves.collect::<Vec<_>>());
    }

    /// (B5) and (B7) by plain sums: the direction is the first lower index.
    #[test]
    fn parallel_vectors_by_plain_sums(space in spaces(4), seed in 1..50i64) {
        let n = space.dimension();
        let numbers = |k: i64| (0..n as i64).map(move |i| integer((seed + k) * (i + 2) % 11 - 5));
        let (u, w): (Vec<_>, Vec<_>) = (numbers(1).collect(), numbers(7).collect());
        for connection in space.connections() {
            let expected = |w: &[Rational], u: &[Rational]| {
                let term = |i, j: usize, k: usize| {
                    connection.affinities().get(&[i, j, k]) * &w[j] * &u[k]
                };
                let sum = |i| {
                    let pairs = (0..n).flat_map(|j| (0..n).map(move |k| (j, k)));
                    pairs.fold(integer(0), |sum, (j, k)| sum - &term(i, j, k))
                };
                (0..n).map(sum).collect::<Vec<_>>()
            };
            let transport = Equations::new(EquationKind::Transport, &connection, None).unwrap();
            prop_assert_eq!(transport.rate(&u, &w).unwrap(), expected(&w, &u));
            let geodesic = Equations::new(EquationKind::Autoparallel, &connection, None).unwrap();
            prop_assert_eq!(geodesic.rate(&u, &[]).unwrap(), expected(&u, &u));
        }
    }

    /// The printed rows agree with `rate`, for every motion and connection.
    #[test]
    fn rows_are_the_rates(space in spaces(4), seed in 1..50i64) {
        let n = space.dimension();
        let numbers = |k: i64| (0..n as i64).map(move |i| integer((seed + k) * (i + 2) % 11 - 5));
        let (state, other): (Vec<_>, Vec<_>) = (numbers(1).collect(), numbers(7).collect());
        for motion in EquationKind::ALL {
            for connection in space.connections() {
                let system = Equations::new(motion, &connection, Some(&space.metric)).unwrap();
                let beside = if motion == EquationKind::Autoparallel { &[][..] } else { &other[..] };
                let rates = system.rate(&state, beside).unwrap();
                for row in system.rows() {
                    let value = |v: &Variable| match *v {
                        Variable::State(j) => &state[j],
                        Variable::Along(j) | Variable::Force(j) => &beside[j],
                    };
                    let left = row.left.iter().fold(integer(0), |sum, (a, j)| {
                        sum + &(a.clone() * &rates[*j])
                    });
                    let right = row.right.iter().fold(integer(0), |sum, (a, product)| {
                        sum + &product.iter().fold(a.clone(), |term, v| term * value(v))
                    });
                    prop_assert_eq!(left, right);
                }
            }
        }
    }
}
