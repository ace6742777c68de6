//! The Lie-Poisson bracket: its laws, the rigid body, and Casimirs against known invariant rings.

use crate::algebra::structure::scrambled;
use crate::common::algebras::{algebras, by_table, catalogued, seeds};
use crate::common::charts::constant;
use crate::common::{fraction, integer, property::properties, rationals, stored};
use affinor::algebra::catalogue;
use affinor::{Bracket, CanonicalConnection, Connection, Error, LieAlgebra, LiePoisson};
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::{Rational, Symbolic, Tensor, Up, contract};
use num_traits::Zero;
use proptest::collection::vec;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn symbolic(algebra: &LieAlgebra<Rational>) -> LieAlgebra<Symbolic> {
    algebra.map(|v| Symbolic::constant(v.clone())).unwrap()
}

fn left(algebra: &LieAlgebra<Rational>) -> LiePoisson {
    LiePoisson::left(&symbolic(algebra)).unwrap()
}

/// A polynomial with mixed degrees.
fn polynomial(space: &LiePoisson, values: &[Rational]) -> Symbolic {
    let x = space.coordinates();
    let terms = values.iter().enumerate().map(|(at, value)| {
        let factors = [at, at / 2, 2 * at + 1].map(|at| x[at % x.len()].clone());
        let [a, b, c] = factors;
        let term = match at % 3 {
            0 => a,
            1 => a * &b,
            _ => a * &b * &c,
        };
        term * &Symbolic::constant(value.clone())
    });
    terms.fold(Symbolic::zero(), |sum, term| sum + &term)
}

properties! {
    #![cases(24)]

    #[test]
    fn a_poisson_bracket(algebra in algebras(4), values in vec(rationals(), 9)) {
        let space = left(&algebra);
        let n = algebra.dimension();
        let [f, g, h] = [0, 3, 6].map(|from| polynomial(&space, &values[from..from + 3]));
        let bracket = |f: &Symbolic, g: &Symbolic| space.bracket(f, g).unwrap();
        prop_assert_eq!(bracket(&f, &g), -bracket(&g, &f));
        let leibniz = f.clone() * &bracket(&g, &h) + &(bracket(&f, &h) * &g);
        prop_assert_eq!(bracket(&(f.clone() * &g), &h), leibniz);
        let jacobi = bracket(&bracket(&f, &g), &h)
            + &bracket(&bracket(&g, &h), &f)
            + &bracket(&bracket(&h, &f), &g);
        prop_assert!(jacobi.is_zero());
        // {mu_i, mu_j} = - c^k_ij mu_k, and + on the right
        let right = LiePoisson::right(&symbolic(&algebra)).unwrap();
        for [i, j] in (0..n * n).map(|key| [key / n, key % n]) {
            let x = space.coordinates();
            let terms = (0..n).map(|k| {
                x[k].clone() * &Symbolic::constant(algebra.structure_constants().get(&[k, i, j]))
            });
            let sum = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
            prop_assert_eq!(bracket(&x[i], &x[j]), -sum.clone());
            prop_assert_eq!(right.bracket(&x[i], &x[j]).unwrap(), sum);
            prop_assert_eq!(space.tensor().get(&[i, j]), bracket(&x[i], &x[j]));
        }
    }

    /// Euler-Poincaré (106): `dH_i/dt = Lambda^j_ki Omega^k H_j` with the connection (+), for
    /// `h = Omega^k H_k` at fixed `Omega = dh`.
    #[test]
    fn left_invariant_systems(algebra in algebras(5), omega in vec(rationals(), 5)) {
        let space = left(&algebra);
        let omega: Vec<_> = omega[..algebra.dimension()]
            .iter()
            .map(|value| Symbolic::constant(value.clone()))
            .collect();
        let terms = space.coordinates().iter().zip(&omega).map(|(x, o)| x.clone() * o);
        let h = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
        let plus = Connection::canonical(&symbolic(&algebra), CanonicalConnection::Plus);
        let momentum = Tensor::vector(space.coordinates(), affinor_tensors::Down);
        let ad = contract(
            "L^j_ki o^k -> ^j_i",
            &[("L", plus.affinities()), ("o", &Tensor::vector(&omega, Up))],
        )?;
        let euler = contract("a^j_i H_j -> _i", &[("a", &ad), ("H", &momentum)])?;
        prop_assert_eq!(space.hamiltonian_field(&h).unwrap(), euler);
    }

    /// The Casimir functions of a degree are as many as the ad-invariant symmetric tensors, and
    /// Poisson-commute with all coordinates.
    #[test]
    fn casimirs_are_invariant_tensors(algebra in algebras(4), values in vec(rationals(), 3)) {
        let space = left(&algebra);
        let units = Matrix::<Rational>::identity(algebra.dimension()).to_dense();
        for degree in 1..=3u32 {
            let casimirs = space.casimirs(degree).unwrap();
            let slots = vec![Up; degree as usize];
            let invariant = algebra.invariant_tensors(&slots, &units).unwrap();
            let all: Vec<_> = (0..degree as usize).collect();
            let mut symmetric = Echelon::new();
            for tensor in invariant {
                let key = |at: &[usize]| at.iter().fold(0, |key, i| key * 8 + i);
                let tensor = tensor.symmetrise(&all).unwrap();
                symmetric.insert(stored(&tensor).into_iter().map(|(at, v)| (key(&at), v))).unwrap();
            }
            prop_assert_eq!(casimirs.len(), symmetric.rank());
            let f = polynomial(&space, &values);
            for casimir in casimirs {
                prop_assert!(space.is_casimir(&casimir));
                prop_assert!(space.bracket(&f, &casimir).unwrap().is_zero());
            }
        }
        prop_assert_eq!(space.casimirs(0).unwrap(), [constant(1)]);
    }

    /// Orbits are symplectic; if an orbit is open, there are no Casimir functions.
    #[test]
    fn orbits(algebra in algebras(5), mu in vec(rationals(), 5)) {
        let n = algebra.dimension();
        let dimension = algebra.coadjoint_orbit_dimension(&mu[..n]).unwrap();
        prop_assert!(dimension.is_multiple_of(2));
        if dimension == n {
            let space = left(&algebra);
            prop_assert!(space.casimirs(1).unwrap().is_empty());
            prop_assert!(space.casimirs(2).unwrap().is_empty());
        }
    }
}

/// The number of monomials of a degree in generators of these degrees.
fn hilbert(generators: &[u32], degree: u32) -> usize {
    match generators.split_first() {
        None => usize::from(degree == 0),
        Some((own, others)) => {
            (0..=degree / own).map(|power| hilbert(others, degree - power * own)).sum()
        }
    }
}

/// Rings of invariants with free generators: the simple algebras by C. Chevalley, *Amer. J. Math.*
/// 77 (1955) 778-782, with the degrees of N. Bourbaki, *Lie* VI, planches; se(n) and other
/// semidirect sums, and the nilpotent ones, as in J. Patera, R. T. Sharp, P. Winternitz and
/// H. Zassenhaus, *J. Math. Phys.* 17 (1976) 986-994.
#[test]
fn rings_of_invariants() {
    let filiform = by_table(4, &[(1, 2, 3, 1), (1, 3, 4, 1)]);
    let plane = seeds().into_iter().find(|(name, _)| *name == "sl(2) x R^2").unwrap().1;
    let named = |name: &str| (name.to_string(), catalogued(name));
    for ((name, algebra), degrees, most) in [
        (named("so(3)"), vec![2], 6),
        (named("sl(2)"), vec![2], 6),
        (named("so(4)"), vec![2, 2], 5),
        (named("so(3,1)"), vec![2, 2], 4),
        (named("sl(3)"), vec![2, 3], 6),
        (named("su(3)"), vec![2, 3], 4),
        (named("so(5)"), vec![2, 4], 4),
        (named("su(4)"), vec![2, 3, 4], 3),
        (named("se(2)"), vec![2], 5),
        (named("se(3)"), vec![2, 2], 5),
        (named("heisenberg(3)"), vec![1], 5),
        (named("heisenberg(5)"), vec![1], 4),
        (named("aff(1)"), vec![], 5),
        (named("bianchi(IV)"), vec![], 4),
        (named("R^2"), vec![1, 1], 4),
        (named("so(3)+aff(1)"), vec![2], 4),
        (("filiform".into(), filiform), vec![1, 2], 5),
        (("sl(2) x R^2".into(), plane), vec![3], 6),
    ] {
        let space = left(&algebra);
        for degree in 0..=most {
            let casimirs = space.casimirs(degree).unwrap();
            assert_eq!(casimirs.len(), hilbert(&degrees, degree), "{name}, degree {degree}");
        }
        let generators = space.casimir_generators(most).unwrap();
        let degree = |f: &Symbolic| f.terms()[0].0.iter().map(|(_, power)| power).sum::<u32>();
        let found: Vec<_> = generators.iter().map(degree).collect();
        let expected: Vec<_> = degrees.iter().copied().filter(|d| *d <= most).collect();
        assert_eq!(found, expected, "{name}");
        // each Casimir function reduces the dimension of a generic orbit by one
        let n = algebra.dimension();
        let mu: Vec<_> = (0..n as i64).map(|i| integer(i * i * i + 3 * i + 7)).collect();
        let orbit = algebra.coadjoint_orbit_dimension(&mu).unwrap();
        let rational_only = usize::from(name == "bianchi(IV)");
        assert_eq!(n - orbit, degrees.len() + rational_only, "{name}");
    }
}

#[test]
fn as_they_are_written() {
    let written = |name: &str, degree: u32| -> Vec<String> {
        let casimirs = left(&catalogued(name)).casimirs(degree).unwrap();
        casimirs.iter().map(Symbolic::to_string).collect()
    };
    assert_eq!(written("so(3)", 2), ["mu1^2 + mu2^2 + mu3^2"]);
    assert_eq!(written("so(2,1)", 2).len(), 1);
    // momentum p and angular momentum j: j.p and p.p
    assert_eq!(written("se(3)", 2), ["mu1*mu4 + mu2*mu5 + mu3*mu6", "mu4^2 + mu5^2 + mu6^2"]);
    assert_eq!(written("heisenberg(3)", 1), ["mu3"]);
    assert_eq!(written("heisenberg(3)", 3), ["mu3^3"]);
}

/// The quadratic Casimir of a semisimple algebra is given by the inverse Killing form. The free
/// rigid body preserves its energy and `|H|^2`, and satisfies `dH/dt = H x Omega` (15).
#[test]
fn the_rigid_body() {
    for (name, algebra) in seeds().into_iter().take(3) {
        let space = left(&algebra);
        let metric = affinor::Metric::new(algebra.labels(), algebra.killing_form()).unwrap();
        let terms = stored(metric.inverse()).into_iter().map(|(at, value)| {
            let x = space.coordinates();
            x[at[0]].clone() * &x[at[1]] * &Symbolic::constant(value)
        });
        let quadratic = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
        assert!(space.is_casimir(&quadratic), "{name}");
    }
    let space = left(&catalogued("so(3)"));
    let [x, y, z] = space.coordinates() else { panic!("three coordinates") };
    let moments = ["A", "B", "C"].map(Symbolic::parameter);
    let omega: Vec<_> = [x, y, z].into_iter().zip(&moments).map(|(h, j)| h.clone() / j).collect();
    let terms = [x, y, z].into_iter().zip(&omega).map(|(h, o)| h.clone() * o / &constant(2));
    let energy = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
    let motion = space.hamiltonian_field(&energy).unwrap();
    for (i, [j, k]) in [[1, 2], [2, 0], [0, 1]].into_iter().enumerate() {
        let h = [x, y, z];
        let expected = h[j].clone() * &omega[k] - &(h[k].clone() * &omega[j]);
        assert_eq!(motion.get(&[i]), expected);
    }
    assert!(space.bracket(&energy, &energy).unwrap().is_zero());
    assert!(!space.is_casimir(&energy));
}

#[test]
fn limits_are_named() {
    let e8 = left(&catalogued("E8"));
    let refused = e8.casimirs(8).unwrap_err();
    assert!(matches!(refused, Error::Size { .. }), "{refused}");
    assert!(refused.to_string().contains("monomials are too many"), "{refused}");
    assert!(e8.casimirs(u32::MAX).is_err());
    let line = left(&by_table(1, &[]));
    assert!(line.casimirs(u32::MAX).is_err());
    assert_eq!(line.casimirs(255).unwrap().len(), 1);
    assert_eq!(line.casimir_generators(40).unwrap(), line.coordinates());
    assert!(line.casimir_generators(u32::MAX).is_err());
    // a parameter is allowed unless it has the name of a coordinate
    let with = |name: &str| {
        let constants = [(0, 1, 1, Symbolic::parameter(name))];
        let bracket = Bracket::from_constants(crate::common::labels(2), constants).unwrap();
        LiePoisson::left(&bracket.try_into().unwrap())
    };
    let space = with("k").unwrap();
    let x = space.coordinates();
    assert_eq!(space.bracket(&x[0], &x[1]).unwrap().to_string(), "-k*mu2");
    assert!(space.casimirs(1).unwrap().is_empty());
    assert!(matches!(with("mu2"), Err(Error::Name(_))));
    let nothing = left(&by_table(0, &[]));
    assert_eq!(nothing.casimirs(0).unwrap().len(), 1);
    assert!(nothing.casimirs(2).unwrap().is_empty());
    assert!(nothing.casimir_generators(u32::MAX).is_err());
    assert!(nothing.is_casimir(&constant(3)));
    assert!(catalogued("so(3)").coadjoint_orbit_dimension(&[integer(1)]).is_err());
}

/// A table whose constants are a number times a parameter, or the number alone for `""`.
fn with_parameters(n: usize, table: &[(usize, usize, usize, i64, &str)]) -> LieAlgebra<Symbolic> {
    let value = |number: i64, name: &str| match name {
        "" => constant(number),
        _ => constant(number) * &Symbolic::parameter(name),
    };
    let constants = table.iter().map(|(i, j, k, c, name)| (i - 1, j - 1, k - 1, value(*c, name)));
    Bracket::from_constants(crate::common::labels(n), constants).unwrap().try_into().unwrap()
}

/// so(3) with three scales, so(4) and so(3,1) over se(3), the oscillator algebra over heisenberg(3), and families of
/// the catalogue.
fn families() -> Vec<(&'static str, LieAlgebra<Symbolic>, Vec<u32>)> {
    let rotations = [(1, 2, 3, 1, "a"), (2, 3, 1, 1, "b"), (3, 1, 2, 1, "c")];
    let mut motions = vec![];
    for (i, j, k) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)] {
        motions.extend([
            (i, j, k, 1, ""),
            (i, j + 3, k + 3, 1, ""),
            (i + 3, j, k + 3, 1, ""),
            (i + 3, j + 3, k, 1, "k"),
        ]);
    }
    let deformed = [(1, 2, 3, 1, ""), (3, 1, 1, 1, "k"), (3, 2, 2, -1, "k")];
    let named = |name: &str| catalogue::algebra::<Symbolic>(name).unwrap();
    vec![
        ("so(3)", with_parameters(3, &rotations), vec![2]),
        ("so(4), so(3,1)", with_parameters(6, &motions), vec![2, 2]),
        ("sl(2) over heisenberg(3)", with_parameters(3, &deformed), vec![2]),
        ("bianchi(VI)", named("bianchi(VI)"), vec![]),
        ("patera(4,5)", named("patera(4,5)"), vec![]),
        ("degraaf(6,24)", named("degraaf(6,24)"), vec![1, 1]),
    ]
}

fn at(values: &BTreeMap<String, Symbolic>, algebra: &LieAlgebra<Symbolic>) -> LiePoisson {
    LiePoisson::left(&algebra.map(|v| v.substitute(values).unwrap()).unwrap()).unwrap()
}

fn all_at(algebra: &LieAlgebra<Symbolic>, numbers: &[Rational]) -> BTreeMap<String, Symbolic> {
    let names: BTreeSet<String> =
        algebra.structure_constants().components().flat_map(|(_, v)| v.parameters()).collect();
    let constants = numbers.iter().cloned().map(Symbolic::constant);
    names.into_iter().zip(constants).collect()
}

properties! {
    #![cases(8)]

    /// Casimir functions with parameters Poisson-commute identically, and at every value of the
    /// parameters.
    #[test]
    fn casimirs_with_parameters(numbers in vec(rationals(), 3)) {
        for (name, algebra, degrees) in families() {
            let space = LiePoisson::left(&algebra).unwrap();
            let special = at(&all_at(&algebra, &numbers), &algebra);
            let generators = space.casimir_generators(3).unwrap();
            prop_assert_eq!(generators.len(), degrees.len(), "{}", name);
            for generator in generators {
                prop_assert!(space.is_casimir(&generator), "{}", name);
                prop_assert_eq!(generator.denominator(), constant(1));
                let value = generator.substitute(&all_at(&algebra, &numbers)).unwrap();
                prop_assert!(special.is_casimir(&value), "{}", name);
            }
            // ranks are smaller at exceptional values only
            for degree in 0..=3 {
                let generic = space.casimirs(degree).unwrap().len();
                prop_assert_eq!(generic, hilbert(&degrees, degree), "{}", name);
                prop_assert!(generic <= special.casimirs(degree).unwrap().len(), "{}", name);
            }
        }
    }
}

/// In any basis and with parameters the coefficients are coprime integers.
#[test]
fn casimirs_are_primitive() {
    let mut checked = 0;
    let mut primitive = |space: &LiePoisson, name: &str| {
        for generator in space.casimir_generators(3).unwrap() {
            let integers = generator.terms().into_iter().map(|(_, value)| value.to_i64().unwrap());
            assert_eq!(integers.fold(0, divisor), 1, "{name}: {generator}");
            checked += 1;
        }
    };
    for name in ["so(3)", "sl(2)", "sl(3)", "se(3)", "so(4)", "heisenberg(5)", "degraaf(5,9)"] {
        for seed in 0..3 {
            primitive(&left(&scrambled(&catalogued(name), seed)), name);
        }
    }
    for (name, algebra, _) in families() {
        primitive(&LiePoisson::left(&algebra).unwrap(), name);
    }
    assert!(checked > 30);
}

/// The greatest common divisor.
fn divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}

/// The invariants of so(4) and so(3,1) as deformations of se(3), `j.p` and `k j.j + p.p`; at k = 0 those of se(3). The
/// algebras of type VI have polynomial invariants where the quotient of the weights is a negative rational number.
#[test]
fn casimirs_at_exceptional_values() {
    let written = |space: &LiePoisson, degree| -> Vec<String> {
        space.casimirs(degree).unwrap().iter().map(Symbolic::to_string).collect()
    };
    let families = families();
    let (_, motions, _) = &families[1];
    let generic =
        ["k*(mu1^2 + mu2^2 + mu3^2) + mu4^2 + mu5^2 + mu6^2", "mu1*mu4 + mu2*mu5 + mu3*mu6"];
    assert_eq!(written(&LiePoisson::left(motions).unwrap(), 2), generic);
    let still = at(&all_at(motions, &[integer(0)]), motions);
    assert_eq!(written(&still, 2), ["mu1*mu4 + mu2*mu5 + mu3*mu6", "mu4^2 + mu5^2 + mu6^2"]);
    let (_, six, _) = &families[3];
    for (h, degree) in [(integer(-1), 2), (integer(-2), 3), (fraction(-2, 3), 5)] {
        let special = at(&all_at(six, std::slice::from_ref(&h)), six);
        assert_eq!(special.casimir_generators(degree).unwrap().len(), 1, "{h}");
        assert!(special.casimir_generators(degree - 1).unwrap().is_empty(), "{h}");
    }
}
