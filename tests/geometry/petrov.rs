//! Petrov types: one metric of each type, other bases, the sign of the metric, and the electric and magnetic parts of the
//! Weyl tensor in floats.

use crate::common::algebras::seeds;
use crate::common::property::properties;
use crate::common::{integer, invertible};
use affinor::geometry::petrov::{Petrov, PetrovType};
use affinor::{BasisChange, Chart, Connection, LieAlgebra, Metric, Rational, Symbolic, Tensor};
use affinor_tensors::Down;
use nalgebra::{Complex, Matrix3};
use proptest::prelude::*;

fn petrov(algebra: &LieAlgebra<Rational>, metric: &Metric<Rational>) -> Option<Petrov<Rational>> {
    let connection = Connection::levi_civita(algebra.left_frame(), metric).unwrap();
    connection.petrov(metric).unwrap()
}

/// The metric `diag(-1, 1, 1, 1)`.
fn minkowski() -> Metric<Rational> {
    Metric::diagonal([-1, 1, 1, 1].map(integer)).unwrap()
}

/// `I` and `J` of a metric in an orthonormal basis, from the electric part `E_ab = W_0a0b` and the magnetic part
/// `B_ab = e_acd W_cd0b / 2`: the traces of the powers of `-(E + i B)`.
fn by_parts(algebra: &LieAlgebra<Rational>) -> [Complex<f64>; 2] {
    let metric = minkowski();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    let weyl = connection.weyl(&metric).unwrap();
    let lower = |at: [usize; 4]| {
        let value = weyl.get(&at).to_f64();
        if at[0] == 0 { -value } else { value }
    };
    let q = Matrix3::from_fn(|a, b| {
        let (c, d) = ((a + 1) % 3 + 1, (a + 2) % 3 + 1);
        -Complex::new(lower([0, a + 1, 0, b + 1]), lower([c, d, 0, b + 1]))
    });
    [(q * q).trace() / 2.0, (q * q * q).trace() / 6.0]
}

fn four_dimensional() -> impl Strategy<Value = LieAlgebra<Rational>> {
    let algebras = seeds().into_iter().map(|(_, algebra)| algebra);
    let algebras: Vec<_> = algebras.filter(|algebra| algebra.dimension() == 4).collect();
    (prop::sample::select(algebras), invertible(4)).prop_map(|(algebra, change)| {
        algebra.change_basis(&BasisChange::new(change).unwrap()).unwrap()
    })
}

properties! {
    #![cases(40)]

    /// The invariants are those of the electric and magnetic parts, up to the orientation.
    #[test]
    fn invariants_are_those_of_the_parts(algebra in four_dimensional()) {
        let found = petrov(&algebra, &minkowski()).unwrap();
        prop_assert_eq!(&found.volume_squared, &integer(1));
        let complex = |[a, b]: &[Rational; 2]| Complex::new(a.to_f64(), b.to_f64());
        let parts = by_parts(&algebra);
        let close = |found: Complex<f64>, part: Complex<f64>| {
            (found - part).norm() <= 1e-9 * (1.0 + part.norm())
        };
        let equal = |[i, j]: [Complex<f64>; 2]| {
            close(complex(&found.quadratic), i) && close(complex(&found.cubic), j)
        };
        prop_assert!(equal(parts) || equal(parts.map(|z| z.conj())), "{:?} {:?}", found, parts);
    }

    /// Type and invariants do not depend on the basis; the sign of the metric reverses `J`.
    #[test]
    fn types_do_not_depend_on_the_basis(algebra in four_dimensional(), change in invertible(4)) {
        let found = petrov(&algebra, &minkowski()).unwrap();
        let change = BasisChange::new(change).unwrap();
        let moved = algebra.change_basis(&change).unwrap();
        let form = change.apply(minkowski().components()).unwrap();
        for sign in [1, -1] {
            let metric = Metric::new(moved.labels(), form.scale(&integer(sign))).unwrap();
            let other = petrov(&moved, &metric).unwrap();
            prop_assert_eq!(other.kind, found.kind);
            prop_assert_eq!(&other.quadratic[0], &found.quadratic[0]);
            prop_assert_eq!(&other.cubic[0], &(found.cubic[0].clone() * &integer(sign)));
            let squared = |p: &Petrov<Rational>| p.quadratic[1].clone() * &p.quadratic[1] * &p.volume_squared;
            prop_assert_eq!(squared(&other), squared(&found));
        }
    }
}

/// A metric on a chart by its components for `i <= j`.
fn on_chart(coordinates: &[&str], components: &[([usize; 2], &str)]) -> Option<Petrov<Symbolic>> {
    let chart = Chart::new(coordinates).unwrap();
    let fields = chart.fields(chart.labels(), Tensor::identity(coordinates.len())).unwrap();
    let entries = components.iter().flat_map(|([i, j], text)| {
        let value: Symbolic = text.parse().unwrap();
        let mirrored = (i != j).then(|| ([*j, *i], value.clone()));
        [Some(([*i, *j], value)), mirrored].into_iter().flatten()
    });
    let form = Tensor::from_components(coordinates.len(), &[Down, Down], entries).unwrap();
    let metric = Metric::new(chart.labels(), form).unwrap();
    let connection = Connection::levi_civita(fields.frame(), &metric).unwrap();
    connection.petrov(&metric).unwrap()
}

/// One metric of each type. II: a wave on Nariai's spacetime (M. Ortaggio, J. Podolsky, *Class. Quantum Grav.* 19 (2002)
/// 5221-5227). III: the vacuum of Petrov in the form of Robinson and Trautman (H. Stephani and others, *Exact Solutions of
/// Einstein's Field Equations* (2003), (28.16)).
#[test]
fn metrics_of_each_type() {
    let wave = |uu: &str| {
        let components = [([0, 0], uu), ([0, 1], "1"), ([2, 2], "1"), ([3, 3], "sin(theta)^2")];
        on_chart(&["u", "v", "theta", "phi"], &components).unwrap()
    };
    assert_eq!(wave("v^2").kind, PetrovType::D);
    assert_eq!(wave("v^2 + h(u,theta)").kind, PetrovType::II);
    // the other sign of the curvature of (u, v): a wave on the spacetime of Bertotti and Robinson, which is of type O
    assert_eq!(wave("-v^2").kind, PetrovType::O);
    assert_eq!(wave("-v^2 + h(u,theta)").kind, PetrovType::N);
    let third = on_chart(
        &["u", "r", "x", "y"],
        &[([0, 0], "3/2*x"), ([0, 1], "-1"), ([2, 2], "r^2/x^3"), ([3, 3], "r^2/x^3")],
    );
    assert_eq!(third.unwrap().kind, PetrovType::III);
    let universe = |a: &str, b: &str, c: &str| {
        let diagonal = [([0, 0], "-1"), ([1, 1], a), ([2, 2], b), ([3, 3], c)];
        on_chart(&["t", "x", "y", "z"], &diagonal).unwrap().kind
    };
    assert_eq!(universe("a(t)^2", "b(t)^2", "c(t)^2"), PetrovType::I);
    assert_eq!(universe("a(t)^2", "b(t)^2", "b(t)^2"), PetrovType::D);
    assert_eq!(universe("a(t)^2", "a(t)^2", "a(t)^2"), PetrovType::O);
}

/// The type exists in Lorentzian signature and dimension 4 only.
#[test]
fn other_signatures_have_no_type() {
    let algebras = seeds().into_iter().map(|(_, algebra)| algebra);
    let algebra = &algebras.clone().find(|algebra| algebra.dimension() == 4).unwrap();
    for signs in [[1, 1, 1, 1], [-1, -1, 1, 1], [-1, -1, -1, -1]] {
        assert_eq!(petrov(algebra, &Metric::diagonal(signs.map(integer)).unwrap()), None);
    }
    let rotations = &algebras.clone().find(|algebra| algebra.dimension() == 3).unwrap();
    assert_eq!(petrov(rotations, &Metric::diagonal([-1, 1, 1].map(integer)).unwrap()), None);
    let sphere = [([0, 0], "1"), ([1, 1], "1"), ([2, 2], "sin(y)^2"), ([3, 3], "sin(y)^2")];
    assert_eq!(on_chart(&["x", "y", "z", "w"], &sphere), None);
}
