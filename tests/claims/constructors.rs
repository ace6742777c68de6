//! Constructors, text and equality of algebras, connections, metrics and geometries.
//!
//! Guards the constructors of `LieAlgebra`, `Metric`, `MatrixBasis`, `Geometry`, their `Display`, and `Error`.

use affinor::algebra::catalogue::{self, CatalogueError};
use affinor::{
    Bracket, CanonicalConnection, Connection, ConnectionKind, Error, Frame, Geometry, LieAlgebra,
    MatrixBasis, Metric, Rational, Symbolic, Tolerance,
};
use nalgebra::dmatrix;

fn so3() -> LieAlgebra<Rational> {
    catalogue::algebra("so(3)").unwrap()
}

#[test]
fn labels_are_any_strings() {
    let bracket = |_, _| vec![(1, Rational::from(1))];
    let borrowed = Bracket::from_fn(&["x", "y"], bracket).unwrap();
    assert_eq!(borrowed, Bracket::from_fn(["x", "y"], bracket).unwrap());
    let owned: Vec<String> = borrowed.labels().to_vec();
    assert_eq!(borrowed, Bracket::from_fn(owned, bracket).unwrap());
    assert_ne!(borrowed, Bracket::from_fn(["x", "z"], bracket).unwrap());
}

#[test]
fn algebras_of_the_catalogue_over_a_scalar() {
    let brackets = "[e1, e2] = e3\n[e1, e3] = -e2\n[e2, e3] = e1";
    assert_eq!(so3().to_string(), brackets);
    assert_eq!(so3().map(Rational::to_f64).unwrap(), catalogue::algebra::<f64>("so3").unwrap());
    assert_eq!(catalogue::algebra::<f64>("R^3").unwrap().to_string(), "");
    let family = catalogue::algebra::<Symbolic>("bianchi(VII)").unwrap();
    assert_eq!(family.to_string(), "[e1, e3] = h*e1 - e2\n[e2, e3] = e1 + h*e2");
    let error = catalogue::algebra::<f64>("bianchi(VII)").unwrap_err();
    assert!(matches!(&error, Error::Catalogue(CatalogueError::Parameter { .. })), "{error}");
    assert!(error.to_string().contains("the structure constant h"), "{error}");
    let unknown = catalogue::algebra::<f64>("E9").unwrap_err();
    assert_eq!(unknown.to_string(), catalogue::find("E9").unwrap_err().to_string());
    assert!(std::error::Error::source(&unknown).is_none());
}

#[test]
fn metrics_by_their_diagonal() {
    let metric = Metric::diagonal([1, 2, 3].map(Rational::from)).unwrap();
    assert_eq!(metric.to_string(), "diag(1, 2, 3)");
    assert_eq!(metric, Metric::new(so3().labels(), metric.components().clone()).unwrap());
    assert_eq!(Metric::<f64>::identity(2).unwrap().to_string(), "diag(1, 1)");
    let error = Metric::diagonal([1.0, 0.0]).unwrap_err();
    assert_eq!(error, Error::Degenerate { null: "e2".into(), components: vec![(2, "1".into())] });
    assert!(matches!(Metric::diagonal([f64::NAN]), Err(Error::NotFinite { .. })));
    let full = affinor::Tensor::from_fn(2, [affinor::Down; 2], |[i, j]| (1 + i + j) as f64);
    assert_eq!(Metric::new(["x", "y"], full.unwrap()).unwrap().to_string(), "[[1, 2], [2, 3]]");
}

#[test]
fn matrices_of_nalgebra() {
    let half = |n: i64| Rational::new(n, 2).unwrap();
    let [zero, one] = [0, 2].map(half);
    // half the identity and half a nilpotent matrix: [x, y] = y/2
    let x = dmatrix![half(1), zero.clone(); zero.clone(), zero.clone()];
    let y = dmatrix![zero.clone(), one; zero.clone(), zero];
    let basis = MatrixBasis::from_dmatrices(["x", "y"], [&x, &y]).unwrap();
    assert_eq!(basis.bracket().unwrap().to_string(), "[x, y] = 1/2*y");
    let wide = dmatrix![1.0, 0.0];
    for matrices in [vec![&wide], vec![&dmatrix![1.0], &dmatrix![1.0, 0.0; 0.0, 1.0]]] {
        let labels = ["x", "y"].iter().take(matrices.len());
        let refused = MatrixBasis::from_dmatrices(labels, matrices);
        assert!(matches!(refused, Err(Error::Shape { .. })), "{refused:?}");
    }
    assert!(matches!(MatrixBasis::from_dmatrices(["x"], [&x, &y]), Err(Error::Shape { .. })));
}

/// The product is `tr(A^T B)` for matrices that are not symmetric: `tr(E^T E) = 1`, although `tr(E
/// E) = 0`.
#[test]
fn the_frobenius_product_transposes() {
    let [zero, one] = [0, 1].map(Rational::from);
    let h = dmatrix![one.clone(), zero.clone(); zero.clone(), -one.clone()];
    let e = dmatrix![zero.clone(), one.clone(); zero.clone(), zero.clone()];
    let f = dmatrix![zero.clone(), zero.clone(); one, zero];
    let basis = MatrixBasis::from_dmatrices(["H", "E", "F"], [&h, &e, &f]).unwrap();
    let product = Metric::new(["H", "E", "F"], basis.frobenius()).unwrap();
    assert_eq!(product, Metric::diagonal([2, 1, 1].map(Rational::from)).unwrap());
}

#[test]
fn a_tolerance_is_inherited() {
    let weak = Tolerance::new(1e-3).unwrap();
    let bracket = Bracket::from_fn(["x", "y"], |_, _| vec![(1, 1.0)]).unwrap();
    let algebra = LieAlgebra::try_from(bracket.with_tolerance(weak)).unwrap();
    let zero = Connection::canonical(&algebra, CanonicalConnection::Zero);
    for tensor in [algebra.structure_constants(), &zero.torsion(), zero.curvature(), &zero.ricci()]
    {
        assert_eq!(tensor.tolerance(), weak);
    }
}

#[test]
fn clones_share_one_curvature() {
    let zero = Connection::canonical(&so3(), CanonicalConnection::Zero);
    let clone = zero.clone();
    assert!(std::ptr::eq(zero.curvature(), clone.curvature()));
    let other = Connection::canonical(&so3(), CanonicalConnection::Zero);
    assert!(!std::ptr::eq(zero.curvature(), other.curvature()));
    assert_eq!((&zero, zero.curvature()), (&other, other.curvature()));
    assert_ne!(zero, Connection::canonical(&so3(), CanonicalConnection::Plus));
    assert_eq!(zero.to_string().lines().next(), Some("nabla[e1, e2] = 1/2*e3"));
}

#[test]
fn geometries_as_text_and_by_value() {
    let geometry = |kind| {
        let metric = Metric::diagonal([1, 2, 3].map(Rational::from)).unwrap();
        Geometry::new("body", so3(), kind, Some(metric)).unwrap()
    };
    let plus = geometry(ConnectionKind::Canonical(CanonicalConnection::Plus));
    let text = "body, connection plus (left invariant canonical), metric diag(1, 2, 3)";
    assert_eq!(plus.to_string(), text);
    assert_eq!(plus, plus.clone());
    assert_ne!(plus, geometry(ConnectionKind::LeviCivita));
    // derivations are closures, which are equal only to themselves
    let plane = || Frame::coordinates(["x", "y"]).unwrap();
    let once = plane();
    assert_eq!(once, once.clone());
    assert_ne!(once, plane());
}

#[test]
fn errors_are_small() {
    assert!(size_of::<Error>() < 128, "{}", size_of::<Error>());
}

/// Labels of frames and coordinates too: messages and brackets name vectors by their labels.
#[test]
fn labels_are_different_and_not_empty() {
    let zero =
        || affinor::Tensor::<f64>::zero(2, &[affinor::Up, affinor::Down, affinor::Down]).unwrap();
    let at_point = |labels: [&str; 2]| {
        Frame::at_point(labels, &[0.0, 0.0], |_, at| {
            affinor::Jet::constant(f64::from(at[0] == at[1]))
        })
    };
    for (labels, reason) in [
        (["x", "x"], "invalid basis: the name `x` occurs twice"),
        (["x", ""], "invalid basis: a name is empty"),
        (["", ""], "invalid basis: a name is empty"),
    ] {
        let errors = [
            Bracket::from_constants(labels, [(0, 1, 1, 1.0)]).unwrap_err(),
            Bracket::from_fn(labels, |_, _| vec![(1, 1.0)]).unwrap_err(),
            Bracket::new(labels, zero()).unwrap_err(),
            Frame::invariant(labels, zero()).unwrap_err(),
            Frame::moving(labels, zero(), std::sync::Arc::new(|_, _| 0.0)).unwrap_err(),
            Frame::coordinates(labels).unwrap_err(),
            at_point(labels).unwrap_err(),
        ];
        for error in errors {
            assert_eq!(error.to_string(), reason);
        }
    }
}
