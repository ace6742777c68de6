//! The tensors of a direct sum with R^k are the tensors of the algebra, padded with zeros, in every
//! dimension and on every code path.
//!
//! Guards `StructureTheory`, `Quantity` and `certificate::certify`, over `direct_sum`.

use crate::common::algebras::{by_table, catalogued, seeds};
use crate::common::{fraction, integer, labels, property::properties, spaces, stored};
use affinor::{Bracket, CanonicalConnection, ConnectionKind, Geometry, LieAlgebra, Metric};
use affinor_documents::Coefficient;
use affinor_documents::certificate::certify;
use affinor_documents::report::Quantity;
use affinor_documents::space::{Request, Space};
use affinor_tensors::{Down, Kind, Notation, Rational, Tensor, Tolerance};
use std::collections::BTreeMap;

type Components<S> = BTreeMap<Vec<usize>, S>;

/// The position of an algebra of dimension `own` in a sum of dimension `n`: its indices start at
/// `from`; the other indices belong to `R^k`.
#[derive(Clone, Copy, Debug)]
struct Place {
    n: usize,
    own: usize,
    from: usize,
}

impl Place {
    fn pad<S: Coefficient>(&self, tensor: &Tensor<S>) -> Tensor<S> {
        let moved = stored(tensor).into_iter().map(|(at, value)| (self.shift(&at), value));
        let padded = Tensor::from_components(self.n, tensor.slots(), moved).unwrap();
        padded.with_tolerance(tensor.tolerance())
    }

    fn shift(&self, at: &[usize]) -> Vec<usize> {
        at.iter().map(|index| index + self.from).collect()
    }

    /// The indices of `R^k`.
    fn others(&self) -> impl Iterator<Item = usize> + use<> {
        let Place { n, own, from } = *self;
        (0..n).filter(move |at| !(from..from + own).contains(at))
    }

    /// The block matrix of the tensor and the identity on `R^k`.
    fn block<S: Coefficient>(&self, tensor: &Tensor<S>) -> Tensor<S> {
        let ones = self.others().map(|at| (vec![at, at], S::one()));
        let all = stored(&self.pad(tensor)).into_iter().chain(ones);
        Tensor::from_components(self.n, tensor.slots(), all).unwrap()
    }

    /// The geometry of the sum, from its constants.
    fn sum<S: Coefficient>(&self, space: &Geometry<S>) -> Geometry<S> {
        let structure = self.pad(space.frame().structure_functions());
        let algebra: LieAlgebra<S> =
            Bracket::new(labels(self.n), structure).unwrap().try_into().unwrap();
        let metric = space.metric().map(|g| {
            let block = self.block(g.components()).with_tolerance(g.components().tolerance());
            Metric::new(algebra.labels(), block).unwrap()
        });
        let kind = match space.kind() {
            ConnectionKind::Affinities(gamma) => ConnectionKind::Affinities(self.pad(gamma)),
            other => other.clone(),
        };
        Geometry::new("sum", algebra, kind, metric).unwrap()
    }
}

/// Quantities that are padded with zeros; the metric and its inverse are padded with the identity.
const PADDED: [Quantity; 12] = [
    Quantity::Structure,
    Quantity::Affinities,
    Quantity::Torsion,
    Quantity::Curvature,
    Quantity::Ricci,
    Quantity::ScalarCurvature,
    Quantity::Nonmetricity,
    Quantity::NablaTorsion,
    Quantity::NablaCurvature,
    Quantity::RicciSymmetric,
    Quantity::RicciAntisymmetric,
    Quantity::Kretschmann,
];

/// Quantities that are not padded with zeros, because their formulas contain the metric or the
/// dimension.
const DENSE: [Quantity; 5] = [
    Quantity::RicciTraceFree,
    Quantity::Einstein,
    Quantity::Schouten,
    Quantity::Weyl,
    Quantity::Cotton,
];

/// Trace-free Ricci, Einstein, Schouten, Weyl and Cotton of the sum, by nested loops over nonzero
/// components.
struct Dense<S> {
    n: usize,
    metric: Components<S>,
    inverse: Components<S>,
    ricci: Components<S>,
    curvature: Components<S>,
    affinities: Components<S>,
    scalar: S,
}

impl<S: Coefficient> Dense<S> {
    /// Computes the tensors of the sum from the tensors of the summand.
    fn new(place: &Place, space: &Geometry<S>) -> Self {
        let metric = space.metric().unwrap();
        let map = |tensor: Tensor<S>| stored(&tensor).into_iter().collect();
        let of = |quantity: Quantity| quantity.of(space).unwrap().unwrap();
        Dense {
            n: place.n,
            metric: map(place.block(metric.components())),
            inverse: map(place.block(metric.inverse())),
            ricci: map(place.pad(&of(Quantity::Ricci))),
            curvature: map(place.pad(&of(Quantity::Curvature))),
            affinities: map(place.pad(&of(Quantity::Affinities))),
            scalar: of(Quantity::ScalarCurvature).to_scalar().unwrap(),
        }
    }

    /// `share (Ric_jl - trace S g_jl)`.
    fn less_trace(&self, trace: S, share: S) -> Components<S> {
        let mut sum = Components::new();
        for (at, value) in &self.ricci {
            add(&mut sum, at.clone(), value.clone() * &share);
        }
        for (at, value) in &self.metric {
            add(&mut sum, at.clone(), -(value.clone() * &self.scalar * &trace * &share));
        }
        sum
    }

    fn schouten(&self) -> Components<S> {
        let share = |of: usize| S::from_i64(of as i64).recip().unwrap();
        self.less_trace(share(2 * (self.n - 1)), share(self.n - 2))
    }

    fn weyl(&self) -> Components<S> {
        let schouten = self.schouten();
        let mut sum = self.curvature.clone();
        for (jl, value) in &schouten {
            let (j, l) = (jl[0], jl[1]);
            for i in 0..self.n {
                add(&mut sum, vec![i, j, i, l], -value.clone());
                add(&mut sum, vec![i, j, l, i], value.clone());
            }
        }
        for (i, k, value) in raised(&self.inverse, &schouten) {
            for (jl, g) in &self.metric {
                let (j, l) = (jl[0], jl[1]);
                add(&mut sum, vec![i, j, k, l], -(value.clone() * g));
                add(&mut sum, vec![i, j, l, k], value.clone() * g);
            }
        }
        sum
    }

    /// `C_jkl = (nabla_k P)_jl - (nabla_l P)_jk`.
    fn cotton(&self) -> Components<S> {
        let schouten = self.schouten();
        let mut nabla = Components::new();
        for (pmj, value) in &self.affinities {
            let (p, m, j) = (pmj[0], pmj[1], pmj[2]);
            for (at, other) in &schouten {
                let part = -(value.clone() * other);
                if at[0] == p {
                    add(&mut nabla, vec![m, j, at[1]], part.clone());
                }
                if at[1] == p {
                    add(&mut nabla, vec![m, at[0], j], part);
                }
            }
        }
        let mut sum = Components::new();
        for (kjl, value) in nabla {
            add(&mut sum, vec![kjl[1], kjl[0], kjl[2]], value.clone());
            add(&mut sum, vec![kjl[1], kjl[2], kjl[0]], -value);
        }
        sum
    }

    fn of(&self, quantity: Quantity) -> Components<S> {
        match quantity {
            Quantity::RicciTraceFree => {
                self.less_trace(S::from_i64(self.n as i64).recip().unwrap(), S::one())
            }
            Quantity::Einstein => self.less_trace(S::from_i64(2).recip().unwrap(), S::one()),
            Quantity::Schouten => self.schouten(),
            Quantity::Weyl => self.weyl(),
            Quantity::Cotton => self.cotton(),
            other => unreachable!("{other:?} is padded"),
        }
    }
}

/// `g^ip P_pk` with its indices.
fn raised<S: Coefficient>(inverse: &Components<S>, form: &Components<S>) -> Vec<(usize, usize, S)> {
    let mut sum = Components::new();
    for (ip, g) in inverse {
        for (pk, value) in form.range(vec![ip[1], 0]..vec![ip[1] + 1, 0]) {
            add(&mut sum, vec![ip[0], pk[1]], g.clone() * value);
        }
    }
    sum.into_iter().map(|(at, value)| (at[0], at[1], value)).collect()
}

fn add<S: Coefficient>(sum: &mut Components<S>, at: Vec<usize>, value: S) {
    let old = sum.remove(&at).unwrap_or_else(S::zero);
    sum.insert(at, old + &value);
}

/// Checks every tensor of the sum against the tensor of the summand, and that the other components
/// vanish.
fn embedded<S: Coefficient>(space: &Geometry<S>, place: &Place, dense: bool) {
    let n = place.n;
    let sum = place.sum(space);
    let of = |space: &Geometry<S>, quantity: Quantity| quantity.of(space).unwrap();
    let same = |quantity: Quantity, found: Option<Tensor<S>>, expected: Option<Tensor<S>>| {
        let [found, expected] = [found, expected].map(|tensor| tensor.map(|t| stored(&t)));
        let sizes = [&found, &expected].map(|tensor| tensor.as_ref().map(Vec::len));
        assert_eq!(sizes[0], sizes[1], "{quantity:?} in dimension {n}");
        assert!(found == expected, "{quantity:?} in dimension {n}");
    };
    for quantity in PADDED {
        let expected = of(space, quantity).map(|tensor| place.pad(&tensor));
        same(quantity, of(&sum, quantity), expected);
    }
    for quantity in [Quantity::Metric, Quantity::InverseMetric] {
        let expected = of(space, quantity).map(|tensor| place.block(&tensor));
        same(quantity, of(&sum, quantity), expected);
    }
    let killing = place.pad(&space.algebra().unwrap().killing_form());
    same(Quantity::Killing, of(&sum, Quantity::Killing), Some(killing));
    if dense && space.metric().is_some() {
        let expected = Dense::new(place, space);
        for quantity in DENSE {
            let of_any = [Quantity::RicciTraceFree, Quantity::Einstein].contains(&quantity);
            let applies = of_any || space.is_levi_civita().unwrap() && n > 2;
            let found = of(&sum, quantity);
            assert_eq!(found.is_some(), applies, "{quantity:?} in dimension {n}");
            if let Some(found) = found {
                close(quantity, &found, expected.of(quantity));
            }
        }
    }
    assert!(sum.frame().jacobi().is_empty(), "Jacobi in dimension {n}");
    assert!(sum.connection().bianchi_first().is_empty(), "bianchi_first in dimension {n}");
    assert!(sum.connection().bianchi_second().is_empty(), "bianchi_second in dimension {n}");
}

/// Expects exact equality; for floats equality up to rounding errors.
fn close<S: Coefficient>(quantity: Quantity, found: &Tensor<S>, mut expected: Components<S>) {
    let n = found.dimension();
    if S::KIND != Kind::Float {
        expected.retain(|_, value| !value.vanishes());
        assert_eq!(found.len(), expected.len(), "{quantity:?} in dimension {n}");
        assert!(stored(found).into_iter().eq(expected), "{quantity:?} in dimension {n}");
        return;
    }
    for (at, value) in stored(found) {
        add(&mut expected, at, -value);
    }
    let off = expected.values().filter_map(Notation::to_f64).fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(off < 1e-12, "{quantity:?} in dimension {n} is off by {off}");
}

/// The same test in floats.
fn floats(space: &Geometry<Rational>) -> Geometry<f64> {
    let float = |tensor: &Tensor<Rational>| tensor.map(Rational::to_f64);
    let algebra = space.algebra().unwrap().map(Rational::to_f64).unwrap();
    let metric =
        space.metric().map(|g| Metric::new(algebra.labels(), float(g.components())).unwrap());
    let kind = match space.kind() {
        ConnectionKind::Canonical(which) => ConnectionKind::Canonical(*which),
        ConnectionKind::Family(lambda) => ConnectionKind::Family(lambda.to_f64()),
        ConnectionKind::LeviCivita => ConnectionKind::LeviCivita,
        ConnectionKind::Affinities(gamma) => ConnectionKind::Affinities(float(gamma)),
        ConnectionKind::Nonholonomic(projector) => ConnectionKind::Nonholonomic(float(projector)),
    };
    Geometry::new("floats", algebra, kind, metric).unwrap()
}

/// Connections of every kind except given affinities.
fn kinds() -> [ConnectionKind<Rational>; 5] {
    [
        ConnectionKind::Canonical(CanonicalConnection::Plus),
        ConnectionKind::Canonical(CanonicalConnection::Zero),
        ConnectionKind::Canonical(CanonicalConnection::Minus),
        ConnectionKind::Family(fraction(1, 3)),
        ConnectionKind::LeviCivita,
    ]
}

/// A metric that is not diagonal: 2 on the diagonal, 1 next to it.
fn band(n: usize) -> Tensor<Rational> {
    Tensor::from_fn(n, [Down, Down], |[i, j]| match i.abs_diff(j) {
        0 => integer(2),
        1 => integer(1),
        _ => integer(0),
    })
    .unwrap()
}

fn geometry(
    algebra: &LieAlgebra<Rational>,
    kind: ConnectionKind<Rational>,
    metric: Tensor<Rational>,
) -> Geometry<Rational> {
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    Geometry::new("summand", algebra.clone(), kind, Some(metric)).unwrap()
}

/// Dimensions on both sides of 161, the largest with a table of `n^3` rows, and far beyond.
#[test]
fn large_sums() {
    let affine = by_table(2, &[(1, 2, 2, 1)]);
    let named = |name: &str| {
        seeds().into_iter().find(|(own, _)| *own == name).map(|(_, algebra)| algebra).unwrap()
    };
    let algebras = [
        ("heisenberg(5)", named("heisenberg(5)")),
        ("sl(2)", named("sl(2)")),
        ("se(3)", named("se(3)")),
        ("aff(1)", affine),
        ("bianchi(IV)", named("bianchi(IV)")),
    ];
    let mut all = Vec::new();
    for (name, algebra) in &algebras {
        let own = algebra.dimension();
        for (at, kind) in kinds().into_iter().enumerate() {
            let metric = if at % 2 == 0 {
                band(own)
            } else {
                Tensor::from_fn(own, [Down, Down], |[i, j]| integer((i == j) as i64)).unwrap()
            };
            all.push((*name, geometry(algebra, kind, metric)));
        }
    }
    for (at, (name, space)) in all.iter().enumerate() {
        let own = space.frame().dimension();
        let n = [162, 161, 405, 163, own + 157][(at + at / 5) % 5];
        let from = [0, n - own, (n - own) / 2][at % 3];
        let place = Place { n, own, from };
        println!("{name} {place:?} {}", space.kind().name());
        embedded(space, &place, n < 200);
        embedded(&floats(space), &place, false);
    }
}

/// Beyond dimension 2048, the largest with a table of `n^2` groups of rows.
#[test]
fn huge_sums() {
    let algebra = catalogued("heisenberg(5)");
    let space = geometry(&algebra, ConnectionKind::LeviCivita, band(5));
    for (n, from) in [(2048, 1000), (2049, 2044)] {
        embedded(&space, &Place { n, own: 5, from }, false);
    }
}

/// Certificates in the order of the command line, with and without a metric.
#[test]
fn certificates_of_large_sums() {
    for (space, metric, connection) in [
        ("heisenberg(5)+R^157", Some("identity"), None),
        ("R^160+heisenberg(5)", Some("identity"), None),
        ("heisenberg(5)+R^156", Some("identity"), None),
        ("heisenberg(163)", None, Some("zero")),
        ("heisenberg(163)", Some("identity"), Some("levi-civita")),
        ("sl(2)+R^170", None, Some("lambda=1/3")),
        ("se(3)+R^200", Some("identity"), Some("plus")),
        ("aff(1)+R^300+aff(1)", Some("identity"), None),
        ("R^162+bianchi(IV)", Some("identity"), Some("minus")),
    ] {
        let text = |text: Option<&str>| text.map(str::to_string);
        let request = Request {
            space: Some(space.into()),
            metric: text(metric),
            connection: text(connection),
            ..Request::default()
        };
        let definition = Space::open(&request).unwrap().definition;
        let tolerance = Tolerance::default();
        let checks = [
            certify::<Rational>(&definition, tolerance, &|_| ()).unwrap(),
            certify::<f64>(&definition, tolerance, &|_| ()).unwrap(),
        ];
        for check in checks.iter().flatten() {
            assert!(check.ok, "{space}: {} {} {:?}", check.name, check.detail, check.witness);
        }
        for name in ["jacobi", "bianchi_first", "bianchi_second"] {
            let found = checks.iter().all(|all| all.iter().any(|check| check.name == name));
            assert!(found, "{space}: {name}");
        }
    }
}

properties! {
    #![cases(40)]

    /// Random algebras, metrics and connections, with some additional dimensions.
    #[test]
    fn small_sums(space in spaces(5), k in 1usize..9, from in 0usize..9, kind in 0usize..7) {
        let kind = match kind {
            5 => ConnectionKind::Family(space.lambda.clone()),
            6 => ConnectionKind::Affinities(space.affinities.clone()),
            known => kinds()[known].clone(),
        };
        let own = space.dimension();
        let metric = space.metric.components().clone();
        let geometry = geometry(&space.algebra, kind, metric);
        embedded(&geometry, &Place { n: own + k, own, from: from.min(k) }, true);
    }
}
