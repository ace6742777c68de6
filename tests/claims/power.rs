//! The power of a connection: with the canonical connections only torques do work, although `plus`
//! does not preserve the metric. See the text after (109) of the paper, and its closing claim.
//!
//! Guards `Connection::{canonical, levi_civita}` and `geometry::conditions`.

use crate::common::algebras::{algebras as random, catalogued, seeds, symbolic};
use crate::common::{fraction, integer, labels, property::properties, tensors};
use affinor::geometry::conditions::conditions;
use affinor::{Bracket, CanonicalConnection, Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Indices, Rational, Symbolic, Tensor, Up, contract};
use proptest::prelude::*;

/// The parameters `x1`, `x2`, ... for a letter `x`.
fn parameters(letter: &str, n: usize) -> Vec<Symbolic> {
    (1..=n).map(|i| Symbolic::parameter(&format!("{letter}{i}"))).collect()
}

/// The symbolic inertia `J_ij`.
fn inertia(n: usize) -> Tensor<Symbolic> {
    let name = |[i, j]: [usize; 2]| format!("J{}{}", i.min(j) + 1, i.max(j) + 1);
    Tensor::from_fn(n, [Down, Down], |at| Symbolic::parameter(&name(at))).unwrap()
}

fn zero() -> Symbolic {
    Symbolic::constant(integer(0))
}

/// Evaluates a tensor on vectors by a loop; each vector is a list of components.
fn on(tensor: &Tensor<Symbolic>, vectors: &[&[Symbolic]]) -> Symbolic {
    let term = |(at, value): (Indices, &Symbolic)| {
        let factors = at.iter().zip(vectors).map(|(&i, v)| v[i].clone());
        factors.fold(value.clone(), |product, factor| product * &factor)
    };
    tensor.components().map(term).fold(zero(), |sum, term| sum + &term)
}

fn half(sign: i64, value: Symbolic) -> Symbolic {
    value * &Symbolic::constant(fraction(sign, 2))
}

/// `dT/dt - M(Omega)` for `M = DH/Dt` along a motion with the velocity `Omega` and its rate `a`, all symbols;
/// `T = 1/2 J_ij Omega^i Omega^j` (98).
fn unexplained(connection: &Connection<Symbolic>, j: &Tensor<Symbolic>) -> Symbolic {
    let n = connection.frame().dimension();
    let (omega, a) = (parameters("w", n), parameters("a", n));
    let energy = |v: &[Symbolic]| half(1, on(j, &[v, v]));
    // dT/dt is the part of T(Omega + a) that is linear in both
    let sum: Vec<_> = omega.iter().zip(&a).map(|(w, a)| w.clone() + a).collect();
    let rate = energy(&sum) - &energy(&omega) - &energy(&a);
    // DH/Dt = dH/dt + nabla_Omega H for H = J Omega, as of constant components
    let h = contract("J_ij w^j -> _i", &[("J", j), ("w", &Tensor::vector(&omega, Up))]).unwrap();
    let power = on(j, &[&omega, &a]) + &on(&connection.nabla(&h).unwrap(), &[&omega, &omega]);
    rate - &power
}

/// `-1/2 Q_kij Omega^k Omega^i Omega^j`: only the totally symmetric part of the nonmetricity.
fn of_nonmetricity(connection: &Connection<Symbolic>, j: &Tensor<Symbolic>) -> Symbolic {
    let omega = parameters("w", connection.frame().dimension());
    half(-1, on(&connection.nabla(j).unwrap(), &[&omega, &omega, &omega]))
}

fn canonical(algebra: &LieAlgebra<Rational>, which: CanonicalConnection) -> Connection<Symbolic> {
    Connection::canonical(&symbolic(algebra), which)
}

fn no_work(algebra: &LieAlgebra<Rational>) {
    let j = inertia(algebra.dimension());
    for which in [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
    {
        let connection = canonical(algebra, which);
        assert_eq!(unexplained(&connection, &j), zero(), "{which:?}");
        assert_eq!(of_nonmetricity(&connection, &j), zero(), "{which:?}");
    }
}

#[test]
fn torques_alone_do_work_on_any_algebra() {
    for (_, algebra) in seeds() {
        no_work(&algebra);
    }
    let names = ["R^3", "gl(2)", "su(2)", "so(4)", "so(3,1)", "so(2,2)", "aff(1)"];
    let bianchi = ["II", "III", "IV", "V", "VI,h=-1/2", "VII,h=2", "VIII", "IX"];
    for name in
        bianchi.map(|name| format!("bianchi({name})")).iter().map(String::as_str).chain(names)
    {
        no_work(&catalogued(name));
    }
}

/// The rest of `dT/dt` is the symmetric part of the affinities, and equals a contraction of the
/// nonmetricity.
fn only_the_symmetric_part_does_work(
    algebra: &LieAlgebra<Rational>,
    affinities: &Tensor<Rational>,
    antisymmetric: bool,
) {
    let part = if antisymmetric { "L^i_jk - L^i_kj -> ^i_jk" } else { "L^i_jk -> ^i_jk" };
    let affinities = contract(part, &[("L", affinities)]).unwrap();
    let symmetric = contract("L^i_jk + L^i_kj -> ^i_jk", &[("L", &affinities)]).unwrap();
    let gamma = affinities.map(|value| Symbolic::constant(value.clone()));
    let frame = symbolic(algebra).left_frame().clone();
    let connection = Connection::new(frame, gamma).unwrap();
    let j = inertia(algebra.dimension());
    let work = unexplained(&connection, &j);
    assert_eq!(work == zero(), symmetric.is_empty());
    assert_eq!(work, of_nonmetricity(&connection, &j));
}

/// The motion without any affinities in a basis of so(3) with large structure constants.
#[test]
fn no_affinities_do_no_work_in_a_skew_basis() {
    let constants = [
        (0, 1, 0, (-13667, 27)),
        (0, 2, 0, (-18599, 54)),
        (1, 2, 0, (267943, 162)),
        (0, 1, 1, (-949, 9)),
        (0, 2, 1, (-1291, 18)),
        (1, 2, 1, (18599, 54)),
        (0, 1, 2, (1394, 9)),
        (0, 2, 2, (949, 9)),
        (1, 2, 2, (-13667, 27)),
    ];
    let constants = constants.map(|(j, k, i, (n, d))| (j, k, i, fraction(n, d)));
    let bracket = Bracket::from_constants(labels(3), constants).unwrap();
    let none = Tensor::zero(3, &[Up, Down, Down]).unwrap();
    only_the_symmetric_part_does_work(&bracket.try_into().unwrap(), &none, true);
}

properties! {
    #![cases(16)]
    #[test]
    fn torques_alone_do_work_in_any_basis(algebra in random(6)) {
        no_work(&algebra);
    }

    /// Affinities of any connection.
    #[test]
    fn affinities_with_a_symmetric_part_do_work(
        (algebra, affinities) in random(4).prop_flat_map(|algebra| {
            let n = algebra.dimension();
            (Just(algebra), tensors(n, [Up, Down, Down]))
        }),
        antisymmetric in any::<bool>(),
    ) {
        only_the_symmetric_part_does_work(&algebra, &affinities, antisymmetric);
    }
}

/// A symmetric part may do no work for one `J`: the Levi-Civita connection of `J`.
#[test]
fn levi_civita_does_no_work_for_its_own_metric() {
    let own = Metric::diagonal(parameters("J", 3)).unwrap();
    let so3 = symbolic(&catalogued("so(3)"));
    let body = Connection::levi_civita(so3.left_frame(), &own).unwrap();
    assert_eq!(unexplained(&body, own.components()), zero());
    assert_ne!(unexplained(&body, &inertia(3)), zero());
}

/// The closing claim: `plus` preserves an inertia exactly if the inertia is ad-invariant. The
/// dimensions of the spaces of ad-invariant symmetric forms are computed by hand. The forms are
/// multiples of the Killing form on simple algebras, all forms on `g/[g,g]` on the solvable ones
/// here, `w.w` and `w.v` on se(3). Only nondegenerate forms are inertias.
#[test]
fn plus_preserves_ad_invariant_inertias_only() {
    let cases = [
        ("so(3)", 1),
        ("sl(2)", 1),
        ("so(2,1)", 1),
        ("heisenberg(3)", 3),
        ("se(2)", 1),
        ("se(3)", 2),
    ];
    let cases =
        cases.into_iter().chain([("aff(1) + aff(1)", 3), ("so(3) + R", 2), ("heisenberg(5)", 10)]);
    let seeds = seeds();
    for (name, invariant) in cases {
        let algebra = &seeds.iter().find(|(seed, _)| *seed == name).unwrap().1;
        let n = algebra.dimension();
        let plus = canonical(algebra, CanonicalConnection::Plus);
        let q = plus.nabla(&inertia(n)).unwrap();
        let loops = Tensor::from_fn(n, [Down, Down, Down], |[k, i, j]| {
            let c = |m: usize, i: usize| {
                Symbolic::constant(-algebra.structure_constants().get(&[m, k, i]))
            };
            let form = inertia(n);
            let terms =
                (0..n).map(|m| c(m, i) * &form.get(&[m, j]) + &(c(m, j) * &form.get(&[i, m])));
            terms.fold(zero(), |sum, term| sum + &term)
        });
        assert_eq!(q, loops.unwrap(), "{name}");
        assert!(!q.is_empty(), "{name}");
        // equations for the n (n + 1)/2 symbols
        assert_eq!(n * (n + 1) / 2 - conditions(&q).len(), invariant, "{name}");
        let killing = algebra.killing_form().map(|value| Symbolic::constant(value.clone()));
        assert!(plus.nabla(&killing).unwrap().is_empty(), "{name}: the Killing form");
    }
}
