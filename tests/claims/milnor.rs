//! J. Milnor, Curvatures of left invariant metrics on Lie groups, Adv. Math. 21 (1976) 293-329: the
//! groups of dimension 3.
//!
//! Guards `Connection::levi_civita` and the Ricci and sectional curvature of a geometry.

use crate::common::algebras::by_table;
use crate::common::charts::constant;
use crate::common::integer;
use crate::common::spaces::symbolic;
use affinor::{Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Field, Rational, Symbolic, Tensor};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

fn half() -> Symbolic {
    constant(2).recip().unwrap()
}

fn diagonal(values: [Symbolic; 3]) -> Tensor<Symbolic> {
    let entry = |[i, j]: [usize; 2]| if i == j { values[i].clone() } else { constant(0) };
    Tensor::from_fn(3, [Down, Down], entry).unwrap()
}

/// Theorem 4.3: `mu_i = (l1 + l2 + l3)/2 - l_i`, `Ric(e_1) = 2 mu_2 mu_3`, and cyclically.
#[test]
fn unimodular_groups() {
    let space = symbolic("milnor_unimodular.toml");
    let (connection, metric) = (space.connection(), space.metric().unwrap());
    let l = ["l1", "l2", "l3"].map(Symbolic::parameter);
    let sum = (l[0].clone() + &l[1] + &l[2]) * &half();
    let mu = l.clone().map(|l| sum.clone() - &l);
    let twice = |i: usize, j: usize| constant(2) * &mu[i] * &mu[j];
    let [r1, r2, r3] = [twice(1, 2), twice(2, 0), twice(0, 1)];
    assert_eq!(connection.ricci(), diagonal([r1.clone(), r2.clone(), r3.clone()]));
    // before the theorem: the affinities are nabla_{e_1} e_2 = mu_1 e_3, and cyclically
    for (i, mu) in mu.iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        assert_eq!(connection.affinities().get(&[k, i, j]), *mu);
        assert_eq!(connection.affinities().get(&[j, i, k]), -mu.clone());
    }
    assert_eq!(connection.affinities().len(), 6);
    let scalar = r1.clone() + &r2 + &r3;
    assert_eq!(connection.scalar_curvature(metric).unwrap(), scalar);
    // K(e_1, e_2) = S/2 - Ric(e_3), the value of the Einstein tensor with the sign reversed
    let einstein = connection.einstein(metric).unwrap();
    for i in 0..3 {
        let unit = |at: usize| (0..3).map(|k| constant(i64::from(k == at))).collect::<Vec<_>>();
        let (x, y) = (unit((i + 1) % 3), unit((i + 2) % 3));
        let sectional = connection.sectional_curvature(metric, &x, &y).unwrap().unwrap();
        assert_eq!(einstein.get(&[i, i]), -sectional);
    }
}

/// Lemma 6.5, with `[e1, e2] = a e2 + b e3`, `[e1, e3] = c e2 + d e3` and `a c + b d = 0`.
#[test]
fn other_groups() {
    let space = symbolic("milnor_nonunimodular.toml");
    let [x, y, one] = [Symbolic::parameter("x"), Symbolic::parameter("y"), constant(1)];
    let [a, d] = [one.clone() + &x, one - &x];
    let [b, c] = [a.clone() * &y, -d.clone() * &y];
    assert!((a.clone() * &c + &(b.clone() * &d)).is_zero());
    let structure = space.frame().structure_functions();
    let brackets = [([1, 0, 1], &a), ([2, 0, 1], &b), ([1, 0, 2], &c), ([2, 0, 2], &d)];
    assert!(brackets.iter().all(|(at, value)| structure.get(at) == **value));
    let square = |v: &Symbolic| v.clone() * v;
    let trace = a.clone() + &d;
    let turn = (square(&b) - &square(&c)) * &half();
    let r1 = -square(&a) - &square(&d) - &(square(&(b + &c)) * &half());
    let r2 = -(a * &trace) - &turn;
    let r3 = -(d * &trace) + &turn;
    assert_eq!(space.connection().ricci(), diagonal([r1, r2, r3]));
}

fn unit_metric(algebra: &LieAlgebra<Rational>) -> Metric<Rational> {
    let unit = Tensor::from_fn(3, [Down, Down], |[i, j]| integer(i64::from(i == j)));
    Metric::new(algebra.labels(), unit.unwrap()).unwrap()
}

/// Section 4: the signatures of the Ricci form that occur on each of the six groups. The groups are
/// distinguished by the signs of `l1, l2, l3` up to a common sign.
#[test]
fn signatures() {
    let mut found: BTreeMap<(usize, usize), BTreeSet<String>> = BTreeMap::new();
    for [l1, l2, l3] in (0..343).map(|key| [key / 49 - 3, key / 7 % 7 - 3, key % 7 - 3]) {
        let algebra = by_table(3, &[(2, 3, 1, l1), (3, 1, 2, l2), (1, 2, 3, l3)]);
        let metric = unit_metric(&algebra);
        let ricci = Connection::levi_civita(algebra.left_frame(), &metric).unwrap().ricci();
        assert!(ricci.components().all(|(at, _)| at[0] == at[1]));
        let mut signs: Vec<char> = (0..3)
            .map(|i| match ricci.get(&[i, i]).cmp(&Rational::zero()) {
                std::cmp::Ordering::Greater => '+',
                std::cmp::Ordering::Equal => '0',
                std::cmp::Ordering::Less => '-',
            })
            .collect();
        signs.sort_by_key(|sign| "+0-".find(*sign));
        let count = |sign: i64| [l1, l2, l3].iter().filter(|l| l.signum() == sign).count();
        let (plus, minus) = (count(1), count(-1));
        let group = (plus.max(minus), plus.min(minus));
        found.entry(group).or_default().insert(signs.into_iter().collect());
    }
    let table: [((usize, usize), &[&str]); 6] = [
        ((3, 0), &["+++", "+00", "+--"]), // SU(2)
        ((2, 1), &["+--", "00-"]),        // SL(2,R)
        ((2, 0), &["000", "+--"]),        // E(2)
        ((1, 1), &["+--", "00-"]),        // E(1,1)
        ((1, 0), &["+--"]),               // Heisenberg
        ((0, 0), &["000"]),               // R^3
    ];
    for (group, signatures) in table {
        let expected: BTreeSet<String> = signatures.iter().map(|s| s.to_string()).collect();
        assert_eq!(found.remove(&group), Some(expected), "{group:?}");
    }
    assert!(found.is_empty(), "{found:?}");
}
