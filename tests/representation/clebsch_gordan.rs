//! Coupling coefficients agree with SymPy, e3nn and closed forms, and are orthogonal.

use crate::common::root;
use affinor::Rational;
use affinor::representation::{
    Coupling, HighestWeight, MatrixRepresentation, SignedRoot, Spin, clebsch_gordan, real_coupling,
    wigner_3j, wigner_6j,
};
use affinor::tensors::Ring;
use std::collections::BTreeMap;

fn spin(text: &str) -> Spin {
    text.parse().unwrap()
}

fn twice(n: i64) -> Spin {
    Spin::from_twice(n).unwrap()
}

/// The lines `name arguments = value` of the table.
fn table(name: &str) -> Vec<(Vec<Spin>, String)> {
    let path = root().join("tests/data/representations/coupling.txt");
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix(name)?.split_once('='));
    let rows = lines.map(|(arguments, value)| {
        (arguments.split_whitespace().map(spin).collect(), value.trim().to_string())
    });
    rows.collect()
}

#[test]
fn coefficients_are_those_of_sympy() {
    for (name, function) in [
        ("cg ", clebsch_gordan as fn([Spin; 2], [Spin; 2], [Spin; 2]) -> SignedRoot),
        ("3j ", wigner_3j),
    ] {
        let rows = table(name);
        assert_eq!(rows.len(), 150);
        for (j, expected) in rows {
            let value = function([j[0], j[1]], [j[2], j[3]], [j[4], j[5]]);
            assert_eq!(value.signed_square().to_string(), expected, "{name} {j:?}");
        }
    }
    let rows = table("6j ");
    assert_eq!(rows.len(), 150);
    for (j, expected) in rows {
        let value = wigner_6j([j[0], j[1], j[2]], [j[3], j[4], j[5]]);
        assert_eq!(value.signed_square().to_string(), expected, "6j {j:?}");
    }
}

/// All triples with `l` up to 10 agree with `o3.wigner_3j` of e3nn, contracted with three vectors.
#[test]
fn real_tensors_are_those_of_e3nn() {
    let weight = |m: i64| ((7 * m * m + 3 * m).rem_euclid(11) - 5) as f64;
    let rows = table("real ");
    assert_eq!(rows.len(), 671);
    for (l, expected) in rows {
        let tensor = real_coupling(l[0], l[1], l[2]).unwrap();
        let [a, b, c] = [l[0], l[1], l[2]].map(|l| -l.twice() / 2..=l.twice() / 2);
        let mut values = tensor.iter().map(SignedRoot::to_f64);
        let mut sum = 0.0;
        for m1 in a {
            for m2 in b.clone() {
                for m3 in c.clone() {
                    let w = weight(m1) * weight(m2 + 1) * weight(m3 + 2);
                    sum += w * values.next().unwrap();
                }
            }
        }
        let expected: f64 = expected.parse().unwrap();
        assert!((sum - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{l:?}: {sum} {expected}");
    }
}

/// A sum of numbers `±sqrt(q)`, as the rational coefficients of the square roots of the squarefree
/// kernels.
fn sum(terms: impl IntoIterator<Item = (Rational, SignedRoot)>) -> BTreeMap<i64, Rational> {
    let mut all: BTreeMap<i64, Rational> = BTreeMap::new();
    for (factor, root) in terms {
        let q = root.signed_square().clone();
        let text = q.clone().abs().to_string();
        let (n, d) = text.split_once('/').unwrap_or((&text, "1"));
        let (n, d): (i64, i64) = (n.parse().unwrap(), d.parse().unwrap());
        // sqrt(n/d) = sqrt(n d)/d
        let (mut kernel, mut outside) = (1, 1);
        for mut part in [n, d] {
            let mut p = 2;
            while part > 1 {
                while part % p == 0 {
                    part /= p;
                    if kernel % p == 0 {
                        (kernel, outside) = (kernel / p, outside * p);
                    } else {
                        kernel *= p;
                    }
                }
                p += 1;
            }
        }
        let sign = if q.is_negative() { -1 } else { 1 };
        if n != 0 {
            let term = factor * &Rational::new(sign * outside, d).unwrap();
            let place = all.entry(kernel).or_insert_with(|| Rational::from(0));
            *place = place.clone() + &term;
        }
    }
    all.retain(|_, value| !value.vanishes());
    all
}

/// The product of two roots.
fn times(a: &SignedRoot, b: &SignedRoot) -> SignedRoot {
    let square = a.signed_square().clone() * b.signed_square();
    SignedRoot::new(square)
}

/// `sum over m1, m2 of <m1 m2|j m><m1 m2|j' m'> = δ`, and the sum over `j`, exactly.
#[test]
fn coefficients_are_orthogonal() {
    let one = || Rational::from(1);
    for (a, b) in [(1, 1), (2, 1), (3, 2), (4, 4), (5, 3)] {
        let (j1, j2) = (twice(a), twice(b));
        let totals: Vec<[Spin; 2]> =
            j1.coupled(j2).flat_map(|j| j.projections().map(move |m| [j, m])).collect();
        let pairs: Vec<(Spin, Spin)> =
            j1.projections().flat_map(|m| j2.projections().map(move |n| (m, n))).collect();
        assert_eq!(totals.len(), pairs.len());
        let cg = |(m, n): (Spin, Spin), total| clebsch_gordan([j1, m], [j2, n], total);
        for &x in &totals {
            for &y in &totals {
                let terms = pairs.iter().map(|&p| (one(), times(&cg(p, x), &cg(p, y))));
                let expected = if x == y { BTreeMap::from([(1, one())]) } else { BTreeMap::new() };
                assert_eq!(sum(terms), expected);
            }
        }
        for &p in &pairs {
            for &q in &pairs {
                let terms = totals.iter().map(|&x| (one(), times(&cg(p, x), &cg(q, x))));
                let expected = if p == q { BTreeMap::from([(1, one())]) } else { BTreeMap::new() };
                assert_eq!(sum(terms), expected);
            }
        }
    }
}

/// `sum over j of (2j+1)(2k+1) {a b j; c d k} {a b j; c d l} = δ_kl`.
#[test]
fn six_j_symbols_are_orthogonal() {
    let [a, b, c, d] = [3, 4, 5, 2].map(twice);
    for k in a.coupled(d).filter(|k| c.coupled(b).any(|other| other == *k)) {
        for l in a.coupled(d).filter(|l| c.coupled(b).any(|other| other == *l)) {
            let terms = a.coupled(b).map(|j| {
                let factor = (j.twice() + 1) * (k.twice() + 1);
                let value = |k| wigner_6j([a, b, j], [c, d, k]);
                (Rational::from(factor), times(&value(k), &value(l)))
            });
            let expected = i64::from(k == l);
            let sum = sum(terms);
            assert_eq!(sum.get(&1).cloned().unwrap_or_default(), Rational::from(expected));
            assert!(sum.len() as i64 == expected, "{k} {l}");
        }
    }
}

/// The raising operator of the matrices of su(2) commutes with the coupling: the recursion
/// `J+ |j m> = J1+ + J2+`, with the orthonormal basis by the contravariant form.
#[test]
fn couplings_commute_with_the_matrices() {
    let su2 = "SU(2)".parse().unwrap();
    // sqrt((j-m)(j+m+1)) from the exact matrices: e v_m over the norms
    let raise = |j: Spin, m: Spin| -> SignedRoot {
        let weight = HighestWeight::new(&su2, [j.twice()]).unwrap();
        let v = MatrixRepresentation::new(&weight).unwrap();
        let at = ((j.twice() - m.twice()) / 2) as usize;
        if at == 0 {
            return SignedRoot::new(Rational::from(0));
        }
        let s = v.contravariant_form();
        let entry = v.raising()[0].get(at - 1, at);
        let norms = s.get(at - 1, at - 1) * &(Rational::from(1) / &s.get(at, at));
        SignedRoot::new(entry.clone() * &entry * &norms)
    };
    for (a, b) in [(1, 2), (3, 2), (4, 3)] {
        let (j1, j2) = (twice(a), twice(b));
        for j in j1.coupled(j2) {
            for m in j.projections().take(j.twice() as usize) {
                let up = twice(m.twice() + 2);
                for m1 in j1.projections() {
                    let m2 = twice(up.twice() - m1.twice());
                    let cg = |m1: i64, m2: i64, m| {
                        clebsch_gordan([j1, twice(m1)], [j2, twice(m2)], [j, m])
                    };
                    if m2.twice().abs() > j2.twice() {
                        continue;
                    }
                    let (m1, m2) = (m1.twice(), m2.twice());
                    let left = [times(&raise(j, m), &cg(m1, m2, up))];
                    let mut right = vec![];
                    if m1 > -a {
                        right.push(times(&raise(j1, twice(m1 - 2)), &cg(m1 - 2, m2, m)));
                    }
                    if m2 > -b {
                        right.push(times(&raise(j2, twice(m2 - 2)), &cg(m1, m2 - 2, m)));
                    }
                    let with = |terms: Vec<SignedRoot>| {
                        sum(terms.into_iter().map(|term| (Rational::from(1), term)))
                    };
                    assert_eq!(with(left.to_vec()), with(right));
                }
            }
        }
    }
}

/// Closed forms of Edmonds, table 2 and equation (3.7.9); the 6j symbol with a zero.
#[test]
fn closed_forms_hold() {
    for n in 1..12 {
        let (j, zero) = (twice(n), twice(0));
        for m in j.projections() {
            // <j m j -m | 0 0> = (-1)^(j-m)/sqrt(2j+1)
            let value = clebsch_gordan([j, m], [j, twice(-m.twice())], [zero, zero]);
            let sign = if (n - m.twice()) % 4 == 0 { 1 } else { -1 };
            assert_eq!(*value.signed_square(), Rational::new(sign, n + 1).unwrap());
            // <j m 1/2 1/2 | j+1/2 m+1/2> = sqrt((j+m+1)/(2j+1))
            let half = twice(1);
            let total = [twice(n + 1), twice(m.twice() + 1)];
            let value = clebsch_gordan([j, m], [half, half], total);
            let expected = Rational::new((n + m.twice()) / 2 + 1, n + 1).unwrap();
            assert_eq!(*value.signed_square(), expected);
        }
        // {j j 0; k k l} = (-1)^(j+k+l)/sqrt((2j+1)(2k+1))
        for l in j.coupled(twice(3)) {
            let value = wigner_6j([j, j, zero], [twice(3), twice(3), l]);
            let sign = if (n + 3 + l.twice()) % 4 == 0 { 1 } else { -1 };
            assert_eq!(*value.signed_square(), Rational::new(sign, 4 * (n + 1)).unwrap());
        }
    }
}

#[test]
fn invalid_spins_are_rejected() {
    for text in ["1/3", "x", "", "0.5", "1001", "-4/3", "99999999999999999999"] {
        assert!(text.parse::<Spin>().is_err(), "{text}");
    }
    assert!(real_coupling(twice(1), twice(1), twice(2)).is_err());
    assert!(real_coupling(twice(2), twice(2), twice(6)).is_err());
    assert!(clebsch_gordan([twice(1), twice(3)], [twice(1), twice(1)], [twice(2); 2]).is_zero());
    assert!(wigner_6j([twice(2); 3], [twice(2), twice(2), twice(1)]).is_zero());
}

/// `<j1 j1 j2 j2 | j1+j2 j1+j2> = 1`, and the least coefficient of the singlet and of the largest spin,
/// whose squares have closed forms.
#[test]
fn large_spins_do_not_underflow() {
    let j = twice(600);
    let coupling = Coupling::new(j, j, twice(1200)).unwrap();
    // the square of <j j j -j | 2j 0> is (2j)!^4/(4j)!/(2j)!^2 = 1/C(4j, 2j)
    let value = coupling.coefficient(j, twice(-600));
    let mut logarithm = 0.0;
    for k in 1..=600 {
        logarithm += (f64::from(600 + k) / f64::from(k)).ln();
    }
    assert!((value.to_f64().ln() + logarithm / 2.0).abs() < 1e-10, "{}", value.to_f64());
    assert!(value.to_f64() > 0.0 && value.signed_square().to_f64() < 1e-300);
    // the coefficient of extreme spins in a 3j symbol: (2j)! (2j)!/(4j+1)! under the root
    let symbol = wigner_3j([j, j], [j, twice(-600)], [twice(1200), twice(0)]);
    let expected = -(logarithm + 1201.0_f64.ln()) / 2.0;
    assert!((symbol.to_f64().abs().ln() - expected).abs() < 1e-10);
}

/// A table of coefficients is the same as single coefficients, and its squares have the sum `2j+1`.
#[test]
fn tables_of_coefficients() {
    for (j1, j2, j) in [(3, 4, 5), (6, 6, 4), (40, 40, 40), (31, 8, 25)] {
        let spins = [j1, j2, j].map(twice);
        let coupling = Coupling::new(spins[0], spins[1], spins[2]).unwrap();
        let mut sum = Rational::from(0);
        for (m1, m2) in coupling.pairs() {
            let value = coupling.coefficient(m1, m2);
            let total = [spins[2], twice(m1.twice() + m2.twice())];
            assert_eq!(value, clebsch_gordan([spins[0], m1], [spins[1], m2], total));
            sum += &value.signed_square().clone().abs();
        }
        assert_eq!(sum, Rational::from(j + 1));
    }
}
