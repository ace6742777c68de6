//! Floats that track their rounding errors through all stages: every tensor of a table has the
//! zeros of the exact tensor, and its values within the tracked error.
//!
//! Guards `TrackedFloat`, through all tensors of `Quantity`.

use crate::common::algebras::{algebras, by_table, catalogued};
use crate::common::{
    Space, fraction, integer, labels, metrics, property::properties, spaces, stored,
};
use affinor::{
    CanonicalConnection, Connection, ConnectionKind, Error, Geometry, LieAlgebra, Metric,
};
use affinor_documents::report::Quantity;
use affinor_tensors::{Down, Notation, Rational, Ring, Scalar, Tensor, TrackedFloat, Up, contract};
use proptest::prelude::*;

/// The scalar under test.
type Float = TrackedFloat;

fn number(value: &Rational) -> Float {
    TrackedFloat::from_rational(value).unwrap()
}

/// The definition of a geometry, over any scalar.
#[derive(Clone, Debug)]
struct Given {
    algebra: LieAlgebra<Rational>,
    metric: Tensor<Rational>,
    kind: ConnectionKind<Rational>,
}

impl Given {
    fn levi_civita(algebra: &LieAlgebra<Rational>, metric: &Tensor<Rational>) -> Self {
        let (algebra, metric) = (algebra.clone(), metric.clone());
        Given { algebra, metric, kind: ConnectionKind::LeviCivita }
    }

    fn over<S: Notation + Scalar>(&self, f: impl Fn(&Rational) -> S) -> Geometry<S> {
        let algebra = self.algebra.map(&f).unwrap();
        let metric = Metric::new(algebra.labels(), self.metric.map(&f)).unwrap();
        let kind = match &self.kind {
            ConnectionKind::Canonical(which) => ConnectionKind::Canonical(*which),
            ConnectionKind::Family(lambda) => ConnectionKind::Family(f(lambda)),
            ConnectionKind::LeviCivita => ConnectionKind::LeviCivita,
            ConnectionKind::Affinities(gamma) => ConnectionKind::Affinities(gamma.map(&f)),
            ConnectionKind::Nonholonomic(projector) => {
                ConnectionKind::Nonholonomic(projector.map(&f))
            }
        };
        Geometry::new("", algebra, kind, Some(metric)).unwrap()
    }
}

fn places<S: Scalar>(tensor: &Tensor<S>) -> Vec<Vec<usize>> {
    stored(tensor).into_iter().map(|(at, _)| at).collect()
}

/// The table in floats has exactly the components of the exact table, within the tracked errors. A
/// component may be missing only if plain floats have fewer than two correct digits of it.
fn same_tables(given: &Given, quantities: &[Quantity]) -> Result<(), TestCaseError> {
    let (exact, float) = (given.over(Rational::clone), given.over(number));
    let plain = given.over(Rational::to_f64);
    for &quantity in quantities {
        let (expected, found) = (quantity.of(&exact)?, quantity.of(&float)?);
        prop_assert_eq!(found.is_some(), expected.is_some(), "{:?}", quantity);
        let (Some(expected), Some(found)) = (expected, found) else { continue };
        for (at, value) in found.components() {
            let exact = expected.get(&at).to_f64();
            prop_assert!(exact != 0.0, "{:?}{:?} = {:?} is noise", quantity, &at[..], value);
            let left = (value.value() - exact) - value.error();
            let bound = 1e-9 * exact.abs() + 0.1 * value.error().abs();
            prop_assert!(left.abs() <= bound, "{quantity:?}{at:?}: {value:?} for {exact}");
        }
        // plain floats may find a nonmetricity that is a rounding error, and then have no Weyl
        // tensor
        let Some(plain) = quantity.of(&plain)? else { continue };
        for (at, value) in expected.components() {
            let (value, plain) = (value.to_f64(), plain.get(&at));
            let known = (plain - value).abs() <= 1e-2 * value.abs();
            let missing = known && found.get(&at).vanishes();
            prop_assert!(!missing, "{:?}{:?} = {} is missing", quantity, &at[..], value);
        }
    }
    Ok(())
}

/// Tensors that vanish in theory have no components.
fn identities(given: &Given) -> Result<(), TestCaseError> {
    let geometry = given.over(number);
    let (connection, n) = (geometry.connection(), geometry.frame().dimension());
    let empty = |what: &str, tensor: &Tensor<Float>| {
        prop_assert!(tensor.is_empty(), "{}: {:?}", what, tensor);
        Ok(())
    };
    empty("jacobi", &geometry.frame().jacobi())?;
    empty("first Bianchi identity", &connection.bianchi_first())?;
    empty("second Bianchi identity", &connection.bianchi_second())?;
    let Some(metric) = geometry.metric() else { return Ok(()) };
    if given.kind != ConnectionKind::LeviCivita {
        return Ok(());
    }
    empty("torsion", &connection.torsion())?;
    empty("nonmetricity", &connection.nonmetricity(metric)?)?;
    empty("antisymmetric Ricci", &connection.ricci_antisymmetric()?)?;
    let einstein = connection.einstein(metric)?.raise(0, metric.inverse())?;
    empty("divergence of Einstein", &connection.nabla(&einstein)?.trace(0, 1)?)?;
    if n < 3 {
        return Ok(());
    }
    let (weyl, cotton) = (connection.weyl(metric)?, connection.cotton(metric)?);
    for slot in 1..4 {
        empty("trace of Weyl", &weyl.trace(0, slot)?)?;
    }
    let divergence = connection.nabla(&weyl)?.trace(0, 1)?;
    let text = format!("W_jkl - {} C_jkl -> _jkl", n - 3);
    empty("divergence of Weyl", &contract(&text, &[("W", &divergence), ("C", &cotton)])?)?;
    if n == 3 {
        empty("Weyl", &weyl)?;
    }
    Ok(())
}

/// All quantities except the derivative of the curvature, which has `n^5` components.
fn but_the_largest() -> Vec<Quantity> {
    let all = Quantity::ALL.into_iter();
    all.filter(|quantity| *quantity != Quantity::NablaCurvature).collect()
}

/// The named algebras of the catalogue, with parameters if they have any.
fn named() -> Vec<(&'static str, LieAlgebra<Rational>)> {
    let bianchi = |h: Rational| {
        let constants = [(0, 2, 0, integer(1)), (1, 2, 1, h)];
        affinor::Bracket::from_constants(labels(3), constants).unwrap().try_into().unwrap()
    };
    let names = ["so(3)", "sl(2)", "se(3)", "so(3,1)", "heisenberg(5)", "bianchi(VIII)"];
    let mut named: Vec<_> = names.map(|name| (name, catalogued(name))).into();
    named.extend([
        ("bianchi VI_h, h = -1/3", bianchi(fraction(-1, 3))),
        ("bianchi VI_h, h = 10/7", bianchi(fraction(10, 7))),
        ("aff(1)", by_table(2, &[(1, 2, 2, 1)])),
    ]);
    named
}

/// The condition number of a metric, independent of units: the largest sum of `|g^im| |g_mj|`.
fn condition(metric: &Metric<Rational>) -> f64 {
    let [g, h] = [metric.components(), metric.inverse()].map(|t| t.map(|v| v.to_f64().abs()));
    let sums = contract("h^im g_mj -> ^i_j", &[("g", &g), ("h", &h)]).unwrap();
    sums.components().map(|(_, v)| *v).fold(0.0, f64::max)
}

/// Metrics whose entries are not exact in floats, with a condition number of at most 1e6.
fn uneven(n: usize) -> impl Strategy<Value = Tensor<Rational>> {
    let units = prop::collection::vec(prop::sample::select(vec![1i64, 3, 7, 10]), n);
    let metrics = metrics(n).prop_filter("within 1e6", |metric| condition(metric) <= 1e6);
    (metrics, units).prop_map(move |(metric, units)| {
        let unit = |i: usize| fraction(1, units[i]);
        let g = metric.components();
        Tensor::from_fn(n, [Down, Down], |[i, j]| g.get(&[i, j]) * &unit(i) * &unit(j)).unwrap()
    })
}

fn uneven_spaces(most: usize) -> impl Strategy<Value = Given> {
    let by_name = prop::sample::select(named()).prop_map(|(_, algebra)| algebra);
    let fits = move |a: &LieAlgebra<Rational>| a.dimension() <= most;
    prop_oneof![by_name.prop_filter("small", fits), algebras(most)].prop_flat_map(|algebra| {
        let metrics = uneven(algebra.dimension());
        metrics.prop_map(move |metric| Given::levi_civita(&algebra, &metric))
    })
}

/// The same geometry in the basis `d_i e_i`.
fn in_units(given: &Given, units: &[Rational]) -> Given {
    let n = given.algebra.dimension();
    let inverse: Vec<_> = units.iter().map(|u| fraction(1, 1) / u).collect();
    let structure = given.algebra.structure_constants().filter_map(|at, value| {
        Some(value.clone() * &inverse[at[0]] * &units[at[1]] * &units[at[2]])
    });
    let bracket = affinor::Bracket::new(labels(n), structure).unwrap();
    let metric = given.metric.filter_map(|at, v| Some(v.clone() * &units[at[0]] * &units[at[1]]));
    Given { algebra: bracket.try_into().unwrap(), metric, kind: given.kind.clone() }
}

/// A power of ten.
fn scale(exponent: i32) -> Rational {
    let power = integer(10i64.pow(exponent.unsigned_abs()));
    if exponent < 0 { integer(1) / &power } else { power }
}

properties! {
    #![cases(48)]

    #[test]
    fn tables_have_the_zeros_of_exact_ones(given in uneven_spaces(5)) {
        same_tables(&given, &Quantity::ALL)?;
    }

    #[test]
    fn identities_hold(given in uneven_spaces(6)) {
        identities(&given)?;
    }

    /// Connections of every kind, with any torsion and nonmetricity.
    #[test]
    fn other_connections(space in spaces(4)) {
        let Space { algebra, lambda, metric, affinities } = space;
        let kinds = [
            ConnectionKind::Canonical(CanonicalConnection::Zero),
            ConnectionKind::Canonical(CanonicalConnection::Plus),
            ConnectionKind::Family(lambda / &integer(7)),
            ConnectionKind::Affinities(affinities.scale(&fraction(1, 3))),
        ];
        for kind in kinds {
            let (algebra, metric) = (algebra.clone(), metric.components().clone());
            let given = Given { algebra, metric, kind };
            same_tables(&given, &Quantity::ALL)?;
            identities(&given)?;
        }
    }

    /// Units of the basis vectors do not change which components are zero, over twenty orders of
    /// magnitude.
    #[test]
    fn units_change_no_zero(
        given in uneven_spaces(4),
        exponents in prop::collection::vec(-5i32..=5, 4),
    ) {
        let units: Vec<_> = exponents.into_iter().map(scale).collect();
        let given = in_units(&given, &units);
        same_tables(&given, &but_the_largest())?;
        identities(&given)?;
    }

    /// If the metric is multiplied by a power of ten, every component is multiplied by the
    /// corresponding power, and the zeros are the same.
    #[test]
    fn one_unit_scales_all(given in uneven_spaces(4), exponent in -12i32..=12) {
        let scaled = Given { metric: given.metric.scale(&scale(exponent)), ..given.clone() };
        let (before, after) = (given.over(number), scaled.over(number));
        for quantity in Quantity::ALL {
            let (before, after) = (quantity.of(&before)?, quantity.of(&after)?);
            let (Some(before), Some(after)) = (before, after) else { continue };
            prop_assert_eq!(places(&after), places(&before), "{:?}", quantity);
        }
        same_tables(&scaled, &but_the_largest())?;
        identities(&scaled)?;
    }

    /// Diagonal metrics of bodies in all units: small entries next to large ones are not rounding
    /// errors.
    #[test]
    fn diagonal_metrics_over_many_scales(
        (_, algebra) in prop::sample::select(named()),
        entries in prop::collection::vec((1i64..=9, -10i32..=10, any::<bool>()), 6),
    ) {
        let n = algebra.dimension();
        let entry = |i: usize| {
            let (digit, exponent, negative) = entries[i];
            fraction(if negative { -digit } else { digit }, 3) * &scale(exponent)
        };
        let diagonal = (0..n).map(|i| ([i, i], entry(i)));
        let metric = Tensor::from_components(n, &[Down, Down], diagonal)?;
        let given = Given::levi_civita(&algebra, &metric);
        use Quantity::{Affinities, Curvature, InverseMetric, Killing, Torsion};
        same_tables(&given, &[Affinities, Torsion, Curvature, InverseMetric, Killing])?;
    }
}

properties! {
    #![cases(4)]

    /// A2 and B2, of dimensions 8 and 10, with metrics that mix neighbouring basis vectors.
    #[test]
    fn larger_algebras(
        name in prop::sample::select(vec!["A2", "B2"]),
        entries in prop::collection::vec(1i64..=9, 20),
    ) {
        let algebra = catalogued(name);
        let metric = band(algebra.dimension(), &entries);
        let given = Given::levi_civita(&algebra, &metric);
        same_tables(&given, &but_the_largest())?;
        identities(&given)?;
    }
}

/// A metric with thirds and sevenths on the diagonal and next to it.
fn band(n: usize, entries: &[i64]) -> Tensor<Rational> {
    let entry = |i: usize| entries[i % entries.len()];
    Tensor::from_fn(n, [Down, Down], |[i, j]| match i.abs_diff(j) {
        0 => fraction(entry(i) + 10, 3),
        1 if i.min(j) % 2 == 0 => fraction(entry(n + i.min(j)), 7),
        _ => integer(0),
    })
    .unwrap()
}

/// G2 and A3 with one metric each, and E6 with a diagonal one.
#[test]
fn large_algebras() {
    for name in ["A3", "G2"] {
        let algebra = catalogued(name);
        let metric = band(algebra.dimension(), &[3, 1, 4, 1, 5, 9, 2, 6]);
        let given = Given::levi_civita(&algebra, &metric);
        use Quantity::{Affinities, Curvature, Einstein, InverseMetric, Ricci, RicciAntisymmetric};
        let some = [Affinities, InverseMetric, Curvature, Ricci, RicciAntisymmetric, Einstein];
        same_tables(&given, &some).unwrap();
    }
    let algebra = catalogued("E6");
    let metric = Tensor::from_components(
        78,
        &[Down, Down],
        (0..78).map(|i| ([i, i], fraction(i as i64 + 1, 7))),
    );
    let given = Given::levi_civita(&algebra, &metric.unwrap());
    let geometry = given.over(number);
    let (connection, metric) = (geometry.connection(), geometry.metric().unwrap());
    assert!(connection.torsion().is_empty());
    assert!(connection.nonmetricity(metric).unwrap().is_empty());
    assert!(connection.ricci_antisymmetric().unwrap().is_empty());
    let exact = given.over(Rational::clone);
    assert_eq!(places(connection.affinities()), places(exact.connection().affinities()));
    assert_eq!(connection.curvature().len(), exact.connection().curvature().len());
}

/// A conformally flat space of dimension 4: hyperbolic space in a skewed basis.
#[test]
fn conformally_flat() {
    let algebra = by_table(4, &[(1, 2, 2, 1), (1, 3, 3, 1), (1, 4, 4, 1)]);
    let moved = Tensor::from_fn(4, [Up, Down], |[i, j]| match i.cmp(&j) {
        std::cmp::Ordering::Less => fraction(1, 3 + i as i64),
        std::cmp::Ordering::Equal => fraction(7, 10),
        std::cmp::Ordering::Greater => fraction(-1, 9),
    })
    .unwrap();
    let unit = Tensor::from_fn(4, [Down, Down], |[i, j]| integer((i == j) as i64)).unwrap();
    let metric = contract("A^p_i A^q_k g_pq -> _ik", &[("A", &moved), ("g", &unit)]).unwrap();
    let change = affinor::BasisChange::new(moved).unwrap();
    let given = Given::levi_civita(&algebra.change_basis(&change).unwrap(), &metric);
    let geometry = given.over(number);
    let (connection, metric) = (geometry.connection(), geometry.metric().unwrap());
    assert!(connection.weyl(metric).unwrap().is_empty());
    assert!(connection.cotton(metric).unwrap().is_empty());
    assert!(connection.nabla_curvature().is_empty());
    let curvature = connection.constant_curvature(metric).unwrap().holds().unwrap();
    assert!((curvature.value() + 1.0).abs() < 1e-13);
}

/// Constants are quotients of large components: a component of the metric that nearly cancels has few digits in the curvature.
/// With `[e_1, e_i] = e_i` all metrics have constant curvature.
#[test]
fn constants_are_quotients_of_large_components() {
    let algebra = by_table(3, &[(1, 2, 2, 1), (1, 3, 3, 1)]);
    // orthonormal vectors e_p = A^p_i e'_i, where the first two columns of A are orthogonal to 1e-13
    let t = fraction(21, 5) - &Rational::new(9, 10_i64.pow(13)).unwrap();
    let columns = [
        [fraction(7, 10), fraction(1, 3), fraction(-1, 9)],
        [fraction(1, 3), fraction(7, 10), t],
        [fraction(-1, 9), fraction(1, 4), fraction(7, 10)],
    ];
    let moved = Tensor::from_fn(3, [Up, Down], |[i, j]| columns[j][i].clone()).unwrap();
    let unit = Tensor::from_fn(3, [Down, Down], |[i, j]| integer((i == j) as i64)).unwrap();
    let metric = contract("A^p_i A^q_k g_pq -> _ik", &[("A", &moved), ("g", &unit)]).unwrap();
    let change = affinor::BasisChange::new(moved).unwrap();
    let given = Given::levi_civita(&algebra.change_basis(&change).unwrap(), &metric);
    let geometry = given.over(number);
    let (connection, metric) = (geometry.connection(), geometry.metric().unwrap());
    let einstein = connection.einstein_constant(metric).unwrap().holds().unwrap();
    let curvature = connection.constant_curvature(metric).unwrap().holds().unwrap();
    assert!((einstein.value() + 2.0).abs() < 1e-12, "{einstein:?}");
    assert!((curvature.value() + 1.0).abs() < 1e-12, "{curvature:?}");
}

/// A NaN is reported with its component, and not as a missing symmetry.
#[test]
fn what_is_no_number_is_named() {
    fn all<S: Scalar + affinor_tensors::Field + From<f64>>() {
        for wild in [f64::NAN, f64::INFINITY] {
            let constants = [(0, 1, 1, S::from(2.0)), (0, 2, 1, S::from(wild))];
            let error = affinor::Bracket::from_constants(labels(3), constants).unwrap_err();
            let Error::NotFinite { at, value, .. } = error else { panic!("{error}") };
            assert_eq!((at, value), (vec![2, 1, 3], wild.to_string()));

            let g = Tensor::from_fn(2, [Down, Down], |[i, j]| {
                S::from(if i + j == 2 { wild } else { 1.0 })
            });
            let error = Metric::new(labels(2), g.unwrap()).unwrap_err();
            let Error::NotFinite { at, value, .. } = error else { panic!("{error}") };
            assert_eq!((at, value), (vec![2, 2], wild.to_string()));
        }
        // products outside the range of floats do not decide the identity
        let large = || S::from(1e200);
        let constants = [(0, 1, 1, large()), (0, 2, 2, -large()), (1, 2, 0, large())];
        let bracket = affinor::Bracket::from_constants(labels(3), constants).unwrap();
        let error = LieAlgebra::try_from(bracket).unwrap_err();
        assert!(matches!(error, Error::NotFinite { .. }), "{error}");
    }
    all::<f64>();
    all::<TrackedFloat>();
}

/// A connection that is built by the library directly.
#[test]
fn connections_of_the_library_follow_their_rounding() {
    let algebra = catalogued("sl(2)").map(number).unwrap();
    let rows = [[0.1, 1.0 / 3.0, 2.0], [1.0 / 3.0, 1.0 / 3.0, 2.0], [2.0, 2.0, 0.0]];
    let g = Tensor::from_fn(3, [Down, Down], |[i, j]| Float::from(rows[i][j])).unwrap();
    let metric = Metric::new(algebra.labels(), g).unwrap();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    assert!(connection.weyl(&metric).unwrap().is_empty());
}
