//! Homogeneous spaces: Nomizu's connections on spheres, projective spaces, flags and groups.

mod cohomology;
mod complement;
mod metrics;

use crate::common::algebras::{by_table, catalogued, seeds};
use crate::common::{fraction, integer, labels, property::properties, rationals, stored};
use affinor::{
    BasisChange, CanonicalConnection, Connection, Error, Law, LieAlgebra, Metric, ReductivePair,
};
use affinor_tensors::{Down, Field, Rational, Ring, Symbolic, Tensor, Up, contract};
use num_traits::Zero;
use proptest::collection::vec;
use proptest::prelude::*;

type Algebra = LieAlgebra<Rational>;
type Pair = ReductivePair<Rational>;

fn unit(n: usize, at: usize) -> Vec<Rational> {
    (0..n).map(|i| integer((i == at) as i64)).collect()
}

fn units(n: usize, at: impl IntoIterator<Item = usize>) -> Vec<Vec<Rational>> {
    at.into_iter().map(|at| unit(n, at)).collect()
}

fn metric(g: Tensor<Rational>) -> Metric<Rational> {
    Metric::new(labels(g.dimension()), g).unwrap()
}

fn delta(n: usize) -> Tensor<Rational> {
    Tensor::from_fn(n, [Down, Down], |[i, j]| integer((i == j) as i64)).unwrap()
}

/// The algebra so of the form `diag(eta)`, by `E_ij = e_i eta_j e_j^T - e_j eta_i e_i^T` for `i <
/// j`: `[E_ij, E_kl] = eta_jk E_il - eta_jl E_ik - eta_ik E_jl + eta_il E_jk`.
fn orthogonal(eta: &[i64]) -> (Algebra, Vec<(usize, usize)>) {
    let n = eta.len();
    let places: Vec<_> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let mut table = vec![];
    for (a, &(i, j)) in places.iter().enumerate() {
        for (b, &(k, l)) in places.iter().enumerate().skip(a + 1) {
            let terms = [(j, k, i, l, 1), (j, l, i, k, -1), (i, k, j, l, -1), (i, l, j, k, 1)];
            for (x, y, from, to, sign) in terms {
                if x == y && from != to {
                    let place = places.iter().position(|p| *p == (from.min(to), from.max(to)));
                    let sign = if from < to { sign } else { -sign };
                    table.push((a + 1, b + 1, place.unwrap() + 1, sign * eta[x]));
                }
            }
        }
    }
    (by_table(places.len(), &table), places)
}

/// `R^i_jkl = K (delta^i_k g_jl - delta^i_l g_jk)`.
fn constant_curvature(k: i64, g: &Tensor<Rational>) -> Tensor<Rational> {
    let operands = [("d", &Tensor::identity(g.dimension())), ("g", g)];
    contract("d^i_k g_jl - d^i_l g_jk -> ^i_jkl", &operands).unwrap().scale(&integer(k))
}

/// Laws of every invariant connection: both Bianchi identities, torsion and curvature by Nomizu's
/// formulas in plain sums, parallel tensors.
fn laws(pair: &Pair, connection: &Connection<Rational>) {
    let (r, c) = (pair.dimension(), pair.algebra().structure_constants());
    let n = pair.algebra().dimension();
    let gamma = connection.affinities();
    let (torsion, curvature) = (connection.torsion(), connection.curvature());
    let sum =
        |terms: &mut dyn Iterator<Item = Rational>| terms.fold(integer(0), |sum, term| sum + &term);
    for [i, j, k, l] in (0..r.pow(4)).map(|key| [3, 2, 1, 0].map(|p| key / r.pow(p) % r)) {
        let quadratic = sum(&mut (0..r).map(|m| {
            gamma.get(&[i, k, m]) * &gamma.get(&[m, l, j])
                - &(gamma.get(&[i, l, m]) * &gamma.get(&[m, k, j]))
                - &(c.get(&[m, k, l]) * &gamma.get(&[i, m, j]))
        }));
        let vertical = sum(&mut (r..n).map(|a| c.get(&[a, k, l]) * &c.get(&[i, a, j])));
        assert_eq!(curvature.get(&[i, j, k, l]), quadratic - &vertical);
        let skew = gamma.get(&[i, j, k]) - &gamma.get(&[i, k, j]) - &c.get(&[i, j, k]);
        assert_eq!(torsion.get(&[i, j, k]), skew);
    }
    assert!(connection.bianchi_first().is_empty());
    assert!(connection.bianchi_second().is_empty());
    let canonical = pair.canonical();
    for tensor in [&torsion, curvature] {
        assert!(canonical.nabla(tensor).unwrap().is_empty());
    }
}

/// The two canonical connections, the Levi-Civita connection of a combination of the invariant
/// forms, and a combination of all invariant connections.
fn all_connections(pair: &Pair, coefficients: &[Rational]) {
    let natural = pair.natural().unwrap();
    assert!(natural.torsion().is_empty());
    let canonical = pair.canonical();
    assert_eq!(canonical.torsion(), pair.frame().structure_functions().scale(&integer(-1)));
    let isotropy = pair.frame().isotropy().unwrap();
    assert_eq!(*canonical.curvature(), isotropy.scale(&integer(-1)));
    if pair.is_symmetric() {
        assert_eq!(canonical.affinities(), natural.affinities());
        assert!(canonical.nabla(canonical.curvature()).unwrap().is_empty());
    }
    let combination = |basis: Vec<Tensor<Rational>>| {
        let zero = basis.first()?.scale(&integer(0));
        let terms = basis.iter().zip(coefficients.iter().cycle());
        Some(terms.fold(zero, |sum, (tensor, factor)| add(&sum, &tensor.scale(factor))))
    };
    let invariant = pair.invariant_tensors(&[Up, Down, Down]).unwrap();
    if let Some(gamma) = combination(invariant) {
        laws(pair, &pair.connection(gamma).unwrap());
    }
    laws(pair, &natural);
    laws(pair, &canonical);
    if let Some(g) = combination(pair.invariant_tensors(&[Down, Down]).unwrap()) {
        let g = g.symmetrise(&[0, 1]).unwrap();
        if let Ok(g) = Metric::new(pair.frame().labels(), g) {
            let levi_civita = pair.levi_civita(&g).unwrap();
            assert!(levi_civita.torsion().is_empty());
            assert!(levi_civita.nonmetricity(&g).unwrap().is_empty());
            assert!(canonical.nonmetricity(&g).unwrap().is_empty());
            laws(pair, &levi_civita);
            pair.connection(levi_civita.affinities().clone()).unwrap();
        }
    }
}

fn add(a: &Tensor<Rational>, b: &Tensor<Rational>) -> Tensor<Rational> {
    let both = stored(a).into_iter().chain(stored(b));
    Tensor::from_components(a.dimension(), a.slots(), both).unwrap()
}

/// S^n = SO(n+1)/SO(n) has K = 1 for the metric of the frame, and H^n = SO(n,1)/SO(n) has K = -1.
/// The same holds for de Sitter and anti-de Sitter space, with indefinite metrics.
#[test]
fn spaces_of_constant_curvature() {
    for (eta, curvature) in [
        (vec![1, 1, 1], 1),
        (vec![1, 1, 1, 1], 1),
        (vec![1, 1, 1, 1, 1], 1),
        (vec![1, 1, 1, -1], -1),
        (vec![1, 1, -1], -1),
        (vec![-1, 1, 1, 1], 1),
        (vec![-1, 1, 1, -1], -1),
    ] {
        let (algebra, places) = orthogonal(&eta);
        let last = eta.len() - 1;
        let of_h = |at: &usize| places[*at].1 != last;
        let h: Vec<_> = (0..places.len()).filter(of_h).collect();
        let m: Vec<_> = (0..places.len()).filter(|at| !of_h(at)).collect();
        let n = places.len();
        let pair = ReductivePair::new(&algebra, &units(n, h.clone()), &units(n, m)).unwrap();
        let again = ReductivePair::orthogonal(&algebra, &units(n, h)).unwrap();
        assert_eq!(pair.algebra().structure_constants(), again.algebra().structure_constants());
        assert!(pair.is_symmetric());
        let forms = pair.invariant_tensors(&[Down, Down]).unwrap();
        let g =
            Tensor::from_fn(last, [Down, Down], |[i, j]| integer(if i == j { eta[i] } else { 0 }));
        let g = g.unwrap();
        // on S^2 the area form is invariant too
        assert_eq!(forms.len(), if last == 2 { 2 } else { 1 });
        let levi_civita = pair.levi_civita(&metric(g.clone())).unwrap();
        assert_eq!(*levi_civita.curvature(), constant_curvature(curvature, &g), "{eta:?}");
        assert_eq!(levi_civita.affinities(), pair.canonical().affinities());
        let dimension = last as i64;
        let ricci = g.scale(&integer(curvature * (dimension - 1)));
        assert_eq!(levi_civita.ricci(), ricci);
        let scalar = levi_civita.scalar_curvature(&metric(g)).unwrap();
        assert_eq!(scalar, integer(curvature * dimension * (dimension - 1)));
        all_connections(&pair, &[integer(2), integer(-3)]);
    }
}

/// The metric `-B` of the Killing form on `m`.
fn killing_metric(pair: &Pair) -> Metric<Rational> {
    let (r, killing) = (pair.dimension(), pair.algebra().killing_form());
    metric(Tensor::from_fn(r, [Down, Down], |[i, j]| -killing.get(&[i, j])).unwrap())
}

/// su(n+1) over s(u(1) x u(n)), the coroots and all `e_ij` with `i, j > 1`.
fn projective_space(n: usize) -> Pair {
    let algebra = catalogued(&format!("su({})", n + 1));
    let h = 2 * n..algebra.dimension();
    ReductivePair::orthogonal(&algebra, &units(algebra.dimension(), h)).unwrap()
}

/// CP^n: symmetric and Kähler, `Ric = g/2` for `g = -B` (A. L. Besse, *Einstein Manifolds*, chapter 7);
/// the holomorphic sectional curvature is constant, `H = 2 Ric/(n+1)`, and
/// `K(x,y) = H/4 (1 + 3 g(x,Jy)^2)` for orthonormal `x, y` (S. Kobayashi and K. Nomizu,
/// *Foundations II*, IX.7).
#[test]
fn complex_projective_spaces() {
    for n in [1, 2, 3] {
        let pair = projective_space(n);
        assert_eq!(pair.dimension(), 2 * n);
        assert!(pair.is_symmetric());
        let g = killing_metric(&pair);
        let levi_civita = pair.levi_civita(&g).unwrap();
        assert_eq!(levi_civita.ricci(), g.components().scale(&fraction(1, 2)));
        // the metric and the Kähler form are the invariant bilinear forms
        let forms = pair.invariant_tensors(&[Down, Down]).unwrap();
        assert_eq!(forms.len(), 2);
        let kaehler = forms.iter().find_map(|form| {
            let skew = form.antisymmetrise(&[0, 1]).unwrap();
            (!skew.is_empty()).then_some(skew)
        });
        let kaehler = kaehler.unwrap();
        assert!(levi_civita.nabla(&kaehler).unwrap().is_empty());
        let form = affinor::Form::new(kaehler.clone()).unwrap();
        assert!(pair.frame().exterior_derivative(&form).unwrap().is_zero());
        // J up to a factor: J^2 = -f^2
        let j = kaehler.raise(0, g.inverse()).unwrap();
        let square = contract("J^i_k J^k_j -> ^i_j", &[("J", &j)]).unwrap();
        let norm = square.get(&[0, 0]);
        assert_eq!(square, Tensor::identity(2 * n).scale(&norm));
        let h = fraction(1, n as i64 + 1);
        let sectional = |x: &[Rational], y: &[Rational]| {
            levi_civita.sectional_curvature(&g, x, y).unwrap().unwrap()
        };
        let product = |x: &[Rational], y: &[Rational]| {
            let lowered = g.lower(x).unwrap();
            lowered.iter().zip(y).fold(integer(0), |sum, (a, b)| sum + &(a.clone() * b))
        };
        let apply = |x: &[Rational]| {
            let x = Tensor::vector(x, Up);
            contract("J^i_j x^j -> ^i", &[("J", &j), ("x", &x)]).unwrap().to_vector().unwrap()
        };
        for seed in 1..6i64 {
            let vector = |k: i64| {
                (0..2 * n as i64).map(move |i| integer((i * i + k * i + seed * k + 1) % 5 - 2))
            };
            let (x, y): (Vec<_>, Vec<_>) = (vector(2).collect(), vector(7).collect());
            if product(&x, &x).is_zero() {
                continue;
            }
            assert_eq!(sectional(&x, &apply(&x)), h);
            let area = product(&x, &x) * &product(&y, &y) - &(product(&x, &y) * &product(&x, &y));
            if area.is_zero() {
                continue;
            }
            let angle = product(&x, &apply(&y));
            let angle = angle.clone() * &angle / &area / &(-norm.clone());
            let expected = (angle * &integer(3) + &integer(1)) * &h / &integer(4);
            assert_eq!(sectional(&x, &y), expected);
        }
        if n < 3 {
            all_connections(&pair, &[integer(1), fraction(1, 2)]);
        }
    }
}

/// The flags SU(3)/T^2 with the metric `x_i (-B)` on the three planes:
/// `r_i = 1/(2 x_i) + (x_i^2 - x_j^2 - x_k^2)/(12 x_1 x_2 x_3)` (A. Arvanitoyeorgos, *Trans. Amer.
/// Math. Soc.* 337 (1993) 981-995); Einstein exactly for (1,1,1) and the three (1,1,2).
#[test]
fn flags() {
    let algebra = catalogued("su(3)");
    let pair = ReductivePair::orthogonal(&algebra, &units(8, 6..8)).unwrap();
    assert!(!pair.is_symmetric());
    let killing = killing_metric(&pair);
    // the planes of su(3): e1, e2 and e3, e4 and e5, e6
    let scaled = |x: [Rational; 3]| {
        metric(killing.components().filter_map(|at, v| {
            assert_eq!(at[0] / 2, at[1] / 2, "the planes are orthogonal");
            Some(v.clone() * &x[at[0] / 2])
        }))
    };
    for [a, b, c] in [[1, 1, 1], [1, 1, 2], [2, 1, 1], [1, 2, 1], [1, 2, 3], [2, 3, 7], [1, -2, 5]]
    {
        let x = [a, b, c].map(integer);
        let volume = x.iter().fold(integer(12), |product, x| product * x);
        let squares = x.iter().fold(integer(0), |sum, x| sum + &(x.clone() * x));
        let closed = |i: usize| {
            let numerator = x[i].clone() * &x[i] * &integer(2) - &squares;
            (x[i].clone() * &integer(2)).recip().unwrap() + &(numerator / &volume)
        };
        let g = scaled(x.clone());
        let ricci = pair.levi_civita(&g).unwrap().ricci();
        let expected = g.components().filter_map(|at, v| Some(v.clone() * &closed(at[0] / 2)));
        assert_eq!(ricci, expected, "{x:?}");
        let einstein = closed(0) == closed(1) && closed(1) == closed(2);
        let known = [[1, 1, 1], [1, 1, 2], [2, 1, 1], [1, 2, 1]].contains(&[a, b, c]);
        assert_eq!(einstein, known, "{x:?}");
    }
    // natural is Levi-Civita of the normal metric
    let normal = pair.levi_civita(&killing).unwrap();
    assert_eq!(normal.affinities(), pair.natural().unwrap().affinities());
    assert_eq!(normal.ricci(), killing.components().scale(&fraction(5, 12)));
    // but not of the Kähler metrics
    let other = pair.levi_civita(&scaled([1, 1, 2].map(integer))).unwrap();
    assert_ne!(other.affinities(), pair.natural().unwrap().affinities());
    all_connections(&pair, &[integer(1), fraction(-1, 2), integer(3)]);
}

/// G x G over the diagonal is G, by `(x, y) -> x - y`. The three complements that `x -> (x, 0)`,
/// `(0, -x)` and `(x/2, -x/2)` span have the canonical connections minus, plus and zero. The
/// natural connection is zero for all of them (K. Nomizu, *Amer. J. Math.* 76 (1954) 33-65, on E.
/// Cartan's three connections).
#[test]
fn groups_as_homogeneous_spaces() {
    for (name, algebra) in seeds().into_iter().filter(|(_, algebra)| algebra.dimension() < 5) {
        let n = algebra.dimension();
        let double = algebra.direct_sum(&algebra).unwrap();
        let embedded = |a: &Rational, b: &Rational| -> Vec<Vec<Rational>> {
            let scaled = |k: usize, factor: &Rational| {
                unit(n, k).into_iter().map(|v| v * factor).collect::<Vec<_>>()
            };
            (0..n).map(|k| [scaled(k, a), scaled(k, b)].concat()).collect()
        };
        let [zero, one, half] = [integer(0), integer(1), fraction(1, 2)];
        let h = embedded(&one, &one);
        for (m, which) in [
            (embedded(&one, &zero), CanonicalConnection::Minus),
            (embedded(&zero, &-one.clone()), CanonicalConnection::Plus),
            (embedded(&half, &-half.clone()), CanonicalConnection::Zero),
        ] {
            let pair = ReductivePair::new(&double, &h, &m).unwrap();
            let on_group = Connection::canonical(&algebra, which);
            let canonical = pair.canonical();
            assert_eq!(canonical.torsion(), on_group.torsion(), "{name}");
            assert_eq!(canonical.curvature(), on_group.curvature(), "{name}");
            let natural = pair.natural().unwrap();
            let zero = Connection::canonical(&algebra, CanonicalConnection::Zero);
            assert_eq!(natural.curvature(), zero.curvature(), "{name}");
            assert_eq!(
                pair.is_symmetric(),
                which == CanonicalConnection::Zero || on_group.torsion().is_empty()
            );
            // invariant connections of G x G / G are the bi-invariant ones of G
            let invariant = pair.invariant_tensors(&[Up, Down, Down]).unwrap();
            assert_eq!(invariant, Connection::bi_invariant(&algebra).unwrap(), "{name}");
            if n < 4 {
                all_connections(&pair, &[integer(1), integer(-2), fraction(1, 3)]);
            }
        }
    }
}

/// The quotient by the trivial subgroup is the group.
#[test]
fn the_trivial_subgroup() {
    for (name, algebra) in seeds().into_iter().filter(|(_, algebra)| algebra.dimension() < 6) {
        let n = algebra.dimension();
        let pair = ReductivePair::new(&algebra, &[], &units(n, 0..n)).unwrap();
        let minus = Connection::canonical(&algebra, CanonicalConnection::Minus);
        assert_eq!(pair.canonical().torsion(), minus.torsion(), "{name}");
        assert!(pair.canonical().curvature().is_empty(), "{name}");
        let zero = Connection::canonical(&algebra, CanonicalConnection::Zero);
        assert_eq!(pair.natural().unwrap().curvature(), zero.curvature(), "{name}");
        assert_eq!(pair.invariant_tensors(&[Up]).unwrap().len(), n);
    }
}

/// The quotient of a group by itself is a point.
#[test]
fn a_point() {
    let so3 = catalogued("so(3)");
    for pair in [
        ReductivePair::new(&so3, &units(3, 0..3), &[]).unwrap(),
        ReductivePair::orthogonal(&so3, &units(3, 0..3)).unwrap(),
    ] {
        assert_eq!(pair.dimension(), 0);
        assert!(pair.is_symmetric());
        assert!(pair.canonical().curvature().is_empty());
        assert!(pair.invariant_tensors(&[Up, Down, Down]).unwrap().is_empty());
    }
}

/// Floats and parameters give the same results as exact numbers.
#[test]
fn other_scalars() {
    let so4 = catalogued("so(4)");
    let exact = ReductivePair::orthogonal(&so4, &units(6, [0])).unwrap();
    let floats = so4.map(Rational::to_f64).unwrap();
    let h: Vec<_> = unit(6, 0).iter().map(Rational::to_f64).collect();
    let floats = ReductivePair::orthogonal(&floats, &[h]).unwrap();
    let natural = floats.natural().unwrap();
    assert_eq!(*natural.curvature(), exact.natural().unwrap().curvature().map(Rational::to_f64));
    assert!(natural.bianchi_first().is_empty() && natural.bianchi_second().is_empty());
    let slots = [Up, Down, Down];
    let count = floats.invariant_tensors(&slots).unwrap().len();
    assert_eq!(count, exact.invariant_tensors(&slots).unwrap().len());
    // the sphere of radius a: K = 1/a^2
    let so3 = catalogued("so(3)").map(|v| Symbolic::constant(v.clone())).unwrap();
    let h: Vec<_> = unit(3, 2).into_iter().map(Symbolic::constant).collect();
    let sphere = ReductivePair::orthogonal(&so3, &[h]).unwrap();
    let square = Symbolic::parameter("a") * &Symbolic::parameter("a");
    let g = Tensor::from_components(2, &[Down; 2], [0, 1].map(|i| ([i, i], square.clone())));
    let g = Metric::new(labels(2), g.unwrap()).unwrap();
    let scalar = sphere.levi_civita(&g).unwrap().scalar_curvature(&g).unwrap();
    assert_eq!(scalar.to_string(), "2/a^2");
}

/// Quotients of groups that are not semisimple. The Heisenberg group over its centre is a flat
/// plane, the Euclidean group over the rotations is Euclidean space, and aff(1) over the dilations
/// is a line.
#[test]
fn other_groups() {
    let heisenberg = by_table(3, &[(1, 2, 3, 1)]);
    let plane = ReductivePair::new(&heisenberg, &units(3, [2]), &units(3, [0, 1])).unwrap();
    assert!(plane.is_symmetric());
    assert!(plane.canonical().curvature().is_empty());
    assert_eq!(plane.invariant_tensors(&[Down, Down]).unwrap().len(), 4);
    let se3 = catalogued("se(3)");
    let space = ReductivePair::new(&se3, &units(6, 0..3), &units(6, 3..6)).unwrap();
    let levi_civita = space.levi_civita(&metric(delta(3))).unwrap();
    assert!(levi_civita.curvature().is_empty() && levi_civita.affinities().is_empty());
    // cross products: one invariant connection, with torsion
    assert_eq!(space.invariant_tensors(&[Up, Down, Down]).unwrap().len(), 1);
    all_connections(&space, &[integer(2)]);
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let line = ReductivePair::new(&affine, &units(2, [0]), &units(2, [1])).unwrap();
    assert_eq!(line.invariant_tensors(&[Down]).unwrap().len(), 0);
}

properties! {
    #![cases(24)]

    /// Quotients of semisimple groups by one-parameter subgroups are not symmetric beyond dimension
    /// 3.
    #[test]
    fn over_one_direction(
        name in prop::sample::select(vec!["so(3)", "sl(2)", "so(2,1)", "so(4)", "so(3,1)"]),
        x in vec(rationals(), 6),
        coefficients in vec(rationals(), 7),
    ) {
        let algebra = catalogued(name);
        let x = &x[..algebra.dimension()];
        let killing = algebra.killing_form();
        let square = stored(&killing).into_iter().fold(integer(0), |sum, (at, v)| {
            sum + &(v * &x[at[0]] * &x[at[1]])
        });
        match ReductivePair::orthogonal(&algebra, std::slice::from_ref(&x.to_vec())) {
            Ok(pair) => {
                prop_assert!(!square.vanishes());
                all_connections(&pair, &coefficients);
            }
            Err(Error::Broken { law: Law::KillingOnSubalgebra, .. }) => prop_assert!(square.vanishes()),
            Err(Error::SingularBasis) => prop_assert!(x.iter().all(Ring::vanishes)),
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        }
    }
}

/// A change of the basis of `m` transforms torsion and curvature as tensors, including the part in
/// `h`.
#[test]
fn another_basis_of_the_tangent_space() {
    let (so4, _) = orthogonal(&[1; 4]);
    let pair = Pair::new(&so4, &units(6, [3, 4, 5]), &units(6, [0, 1, 2])).unwrap();
    let rows = [[2, 1, 0], [0, 1, -3], [1, 0, 1]];
    let matrix = Tensor::from_fn(3, [Up, Down], |[i, a]| integer(rows[i][a])).unwrap();
    let change = BasisChange::new(matrix).unwrap();
    for connection in [pair.canonical(), pair.natural().unwrap()] {
        let moved = connection.moved(labels(3), &change).unwrap();
        assert!(!moved.curvature().is_empty());
        assert_eq!(*moved.curvature(), change.apply(connection.curvature()).unwrap());
        assert_eq!(moved.torsion(), change.apply(&connection.torsion()).unwrap());
    }
}

#[test]
fn what_is_no_pair_is_refused() {
    let so3 = by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)]);
    let refused = ReductivePair::new(&so3, &units(3, [0, 1]), &units(3, [2])).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the vectors of h do not span a subalgebra: [e1, e2] = e3 is not in their span"
    );
    // y spans an ideal of aff(1), and no complement is invariant
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let refused = ReductivePair::new(&affine, &units(2, [1]), &units(2, [0])).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the complement m is not invariant under h: [e2, e1] = -e2 is not in m"
    );
    let refused = ReductivePair::orthogonal(&affine, &units(2, [1])).unwrap_err();
    assert_eq!(refused.to_string(), "the Killing form is degenerate on h: e2 is orthogonal to h");
    let refused = ReductivePair::new(&so3, &units(3, [0]), &units(3, [0, 1]));
    assert!(matches!(refused, Err(Error::SingularBasis)));
    let refused = ReductivePair::new(&so3, &units(3, [0]), &units(3, [1]));
    assert!(matches!(refused, Err(Error::Shape { .. })));
    let refused = ReductivePair::orthogonal(&so3, &units(4, [0]));
    assert!(matches!(refused, Err(Error::Shape { .. })));
    // a metric and affinities that are not invariant under the isotropy
    let sphere = ReductivePair::orthogonal(&so3, &units(3, [2])).unwrap();
    let g = Tensor::from_fn(2, [Down, Down], |[i, j]| integer(((i == j) as i64) << i)).unwrap();
    let refused = sphere.levi_civita(&metric(g)).unwrap_err();
    assert!(refused.to_string().contains("the metric must be invariant under h"), "{refused}");
    // (E g)_12 = -g_22 E^2_1 - g_11 E^1_2 = 2 - 1 up to the sign of E
    let Error::Broken { at, .. } = refused else { panic!("{refused}") };
    assert_eq!(at[2], "1,2");
    let gamma = Tensor::from_fn(2, [Up, Down, Down], |[i, ..]| integer(i as i64)).unwrap();
    assert!(matches!(
        sphere.connection(gamma),
        Err(Error::Broken { law: Law::IsotropyInvariance, .. })
    ));
    // nor through a frame
    let ellipse = Metric::diagonal([1, 2].map(integer)).unwrap();
    for refused in [sphere.levi_civita(&ellipse), Connection::levi_civita(sphere.frame(), &ellipse)]
    {
        assert!(matches!(refused, Err(Error::Broken { law: Law::IsotropyInvariance, .. })));
    }
    assert!(matches!(sphere.levi_civita(&metric(delta(3))), Err(Error::Shape { .. })));
    // quantities that exist for groups only
    assert!(matches!(sphere.canonical().ad_invariance_defect(), Err(Error::Unsupported(_))));
    assert!(matches!(sphere.canonical().curvature_forms(), Err(Error::Unsupported(_))));
}

/// Dependent vectors of `h` are reported as such, not as a degenerate Killing form.
#[test]
fn dependent_vectors_of_the_subalgebra_are_refused() {
    let [once, twice] = [1, 2].map(|k| vec![integer(0), integer(0), integer(k)]);
    let pair = ReductivePair::orthogonal(&catalogued("so(3)"), &[once, twice]);
    assert!(matches!(pair, Err(Error::SingularBasis)), "{pair:?}");
}
