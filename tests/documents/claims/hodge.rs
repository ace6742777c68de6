//! The Hodge star, the codifferential and the Laplacian of forms on charts and groups
//! (`affinor::geometry::hodge`): laws, harmonic functions, eigenvalues and Maxwell fields.

use affinor::{Connection, Error, Form, Geometry};
use affinor_documents::space::{Request, Space};
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::{Ring, Symbolic, Tensor, Tolerance};

struct OnSpace {
    space: Space,
    geometry: Geometry<Symbolic>,
    volume: Symbolic,
    minus: usize,
}

impl OnSpace {
    fn new(name: &str, minus: usize) -> Self {
        let request = Request { space: Some(name.into()), ..Request::default() };
        let space = Space::open(&request).unwrap();
        let geometry = space.definition.geometry(Tolerance::default()).unwrap();
        let metric = geometry.metric().unwrap();
        let (volume, _) = metric.volume(PositiveFactors::default()).unwrap();
        OnSpace { space, volume, minus, geometry }
    }

    fn form(&self, text: &str) -> Form<Symbolic> {
        self.space.definition.form(text, &self.geometry).unwrap()
    }

    fn star(&self, form: &Form<Symbolic>) -> Form<Symbolic> {
        self.geometry.metric().unwrap().hodge_star(form, &self.volume).unwrap()
    }

    fn d(&self, form: &Form<Symbolic>) -> Form<Symbolic> {
        self.geometry.frame().exterior_derivative(form).unwrap()
    }

    fn connection(&self) -> Connection<Symbolic> {
        Connection::levi_civita(self.geometry.frame(), self.geometry.metric().unwrap()).unwrap()
    }

    fn codifferential(&self, form: &Form<Symbolic>) -> Form<Symbolic> {
        self.connection().codifferential(self.geometry.metric().unwrap(), form).unwrap()
    }

    fn laplacian(&self, form: &Form<Symbolic>) -> Form<Symbolic> {
        self.connection().hodge_laplacian(self.geometry.metric().unwrap(), form).unwrap()
    }
}

fn scaled(form: &Form<Symbolic>, by: i64) -> Form<Symbolic> {
    Form::new(form.components().scale(&Symbolic::from(by))).unwrap()
}

/// `** = (-1)^(p(n-p)+q)`, `a ^ *b = <a,b> vol`, and `delta = (-1)^(n(p+1)+1+q) * d *`.
#[test]
fn laws_hold_on_charts_and_groups() {
    let spaces = [
        ("sphere", 0, &["cos(theta)*phi", "theta*dphi + sin(theta)*dtheta", "dtheta^dphi"][..]),
        ("hyperbolic-space", 0, &["x*y/z", "x*dy + z^2*dz", "y*dx^dz", "x*dx^dy^dz"][..]),
        (
            "schwarzschild",
            1,
            &["t*r", "r*dt + cos(theta)*dphi", "r^2*dt^dr + r*dr^dphi", "r*dt^dr^dphi"][..],
        ),
        ("schwarzschild-observers", 1, &["r*e0 + e3", "r*e0^e1 + e2^e3", "M*e0^e1^e3"][..]),
        ("eddington-finkelstein", 1, &["r*dv + dtheta", "dv^dr + r*dr^dphi"][..]),
        ("so3;metric=diag(1,4,9)", 0, &["e1 + 2*e3", "e1^e2 - 3*e2^e3"][..]),
    ];
    for (name, minus, forms) in spaces {
        let space = OnSpace::new(name, minus);
        let n = space.space.definition.dimension();
        for text in forms {
            let form = space.form(text);
            let p = form.degree();
            let sign = |odd: usize| if odd % 2 == 1 { -1 } else { 1 };
            let star = space.star(&form);
            assert_eq!(star.degree(), n - p, "{name}: {text}");
            assert_eq!(
                space.star(&star),
                scaled(&form, sign(p * (n - p) + space.minus)),
                "{name}: {text}"
            );
            if p > 0 {
                let other =
                    scaled(&space.star(&space.d(&star)), sign(n * (p + 1) + 1 + space.minus));
                assert_eq!(space.codifferential(&form), other, "{name}: {text}");
            }
            let square = space.geometry.metric().unwrap().form_product(&form, &form).unwrap();
            let top = form.wedge(&star).unwrap();
            let first: Vec<usize> = (0..n).collect();
            assert_eq!(top.components().get(&first), square * &space.volume, "{name}: {text}");
            let twice = space.codifferential(&form);
            assert!(space.codifferential(&twice).is_zero());
        }
    }
}

/// Spherical harmonics of degree 1, 2 and 3, and harmonic functions. Signs: `Delta = -div grad`.
#[test]
fn functions_are_harmonic_or_eigenfunctions() {
    let eigenfunctions = [
        ("sphere", "cos(theta)", "2/R^2"),
        ("sphere", "sin(theta)*cos(phi)", "2/R^2"),
        ("sphere", "3*cos(theta)^2 - 1", "6/R^2"),
        ("sphere", "sin(theta)^2*sin(2*phi)", "6/R^2"),
        ("sphere", "sin(theta)*(5*cos(theta)^2 - 1)*sin(phi)", "12/R^2"),
        // the functions y^s have the eigenvalue s (1 - s)/R^2, and are harmonic for s = 1
        ("hyperbolic-plane", "y", "0"),
        ("hyperbolic-plane", "x*y^0", "0"),
        ("hyperbolic-plane", "y/(x^2 + y^2)", "0"),
        ("hyperbolic-plane", "y^3", "-6/R^2"),
        // in dimension 3: s (2 - s)/R^2
        ("hyperbolic-space", "z^2", "0"),
        ("hyperbolic-space", "z^3", "-3/R^2"),
    ];
    for (name, function, eigenvalue) in eigenfunctions {
        let space = OnSpace::new(name, 0);
        let product = space.form(&format!("({eigenvalue})*({function})"));
        assert_eq!(space.laplacian(&space.form(function)), product, "{name}: {function}");
    }
    let space = OnSpace::new("minkowski", 1);
    // the wave operator has the opposite sign of the Laplacian
    assert_eq!(space.laplacian(&space.form("t^2")), space.form("2"));
    assert!(space.laplacian(&space.form("(x - t)^3 + sin(y - t)")).is_zero());
    // the static field of a massless scalar outside the horizon
    let space = OnSpace::new("schwarzschild-observers", 1);
    assert!(space.laplacian(&space.form("log(1 - 2*M/r)")).is_zero());
}

/// The Laplacian commutes with `d`, `delta` and `*`.
#[test]
fn the_laplacian_commutes() {
    let space = OnSpace::new("kerr", 1);
    let form = space.form("r*dt + cos(theta)*dphi");
    let laplacian = space.laplacian(&form);
    assert_eq!(space.d(&laplacian), space.laplacian(&space.d(&form)));
    let space = OnSpace::new("3-sphere", 0);
    let coordinates = space.space.definition.coordinates().to_vec();
    let form = space.form(&format!("cos({0})*d{1}", coordinates[0], coordinates[1]));
    assert_eq!(space.star(&space.laplacian(&form)), space.laplacian(&space.star(&form)));
    assert_eq!(
        space.codifferential(&space.laplacian(&form)),
        space.laplacian(&space.codifferential(&form))
    );
}

/// The fields of charged black holes satisfy Maxwell's equations `dF = 0`, `d*F = 0`
/// (C. W. Misner, K. S. Thorne, J. A. Wheeler, *Gravitation* (1973), (31.24) and box 33.2).
#[test]
fn charged_black_holes_satisfy_maxwells_equations() {
    let space = OnSpace::new("reissner-nordstrom", 1);
    let field = space.form("Q/r^2*dt^dr");
    assert!(space.d(&field).is_zero() && space.d(&space.star(&field)).is_zero());
    // the electric charge: *F = -Q sin(theta) dtheta^dphi
    assert_eq!(space.star(&field), space.form("-Q*sin(theta)*dtheta^dphi"));
    assert!(!space.d(&space.star(&space.form("Q/r*dt^dr"))).is_zero());
    let space = OnSpace::new("kerr-newman", 1);
    let sigma = "(r^2 + a^2*cos(theta)^2)";
    let field = space.form(&format!(
        "Q*(r^2 - a^2*cos(theta)^2)/{sigma}^2*dr^(dt - a*sin(theta)^2*dphi) \
         + 2*Q*a*r*cos(theta)*sin(theta)/{sigma}^2*dtheta^((r^2 + a^2)*dphi - a*dt)"
    ));
    assert!(space.d(&field).is_zero());
    assert!(space.d(&space.star(&field)).is_zero());
    assert!(space.codifferential(&field).is_zero());
}

/// A Killing field of a Ricci-flat metric is a vector potential in Lorenz gauge (R. M. Wald, *Phys.
/// Rev. D* 10 (1974) 1680): `delta K = 0`, and `Delta K = 2 Ric(K) = 0`.
#[test]
fn killing_fields_are_potentials_in_vacuum() {
    let space = OnSpace::new("kerr", 1);
    let metric = space.geometry.metric().unwrap();
    for field in [0, 3] {
        let entries = (0..4).map(|i| (vec![i], metric.components().get(&[field, i])));
        let form = Form::from_increasing(4, 1, entries).unwrap();
        assert!(space.codifferential(&form).is_zero());
        assert!(space.laplacian(&form).is_zero());
    }
}

#[test]
fn invalid_forms_are_refused() {
    let space = OnSpace::new("sphere", 0);
    let refused = |text: &str| {
        let error = space.space.definition.form(text, &space.geometry).unwrap_err();
        error.to_string()
    };
    assert!(refused("dtheta*dphi").contains("write `^` between two forms"));
    assert!(refused("1 + dphi").contains("degree"));
    assert!(refused("sin(dphi)").contains("cannot be an argument"));
    assert!(refused("1/dphi").contains("cannot divide"));
    assert!(refused("dx").contains("dx"));
    assert!(refused("dtheta^").contains("end") || !refused("dtheta^").is_empty());
    let round = space.geometry.metric().unwrap();
    let alien = Form::new(Tensor::zero(3, &[]).unwrap()).unwrap();
    assert!(matches!(round.hodge_star(&alien, &Symbolic::from_i64(1)), Err(Error::Shape { .. })));
}
