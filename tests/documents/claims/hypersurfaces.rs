//! Extrinsic curvature of hypersurfaces (`affinor::geometry::hypersurface`) and conformal factors of
//! metrics: closed forms, and the law of the Weyl tensor.

use affinor::geometry::hypersurface::Hypersurface;
use affinor::{Connection, Geometry};
use affinor_documents::input::InputError;
use affinor_documents::space::{Definition, Request, Space};
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::scalar::{FreeFunction, PositiveFactors};
use affinor_tensors::{Notation, Symbolic, Tolerance};
use num_traits::Zero;

fn value(text: &str) -> Symbolic {
    let name = |name: &str| Ok::<_, String>(Symbolic::parameter(name));
    let call = |name: &str, arguments: &[Symbolic]| Notation::call(name, arguments);
    Expression::parse(text).unwrap().evaluate(&Scalars(name, call)).unwrap()
}

fn open(space: &str, factor: Option<&str>) -> Result<Geometry<Symbolic>, InputError> {
    let request = Request {
        space: Some(space.into()),
        conformal_factor: factor.map(Into::into),
        ..Request::default()
    };
    Space::open(&request)?.definition.geometry(Tolerance::default())
}

fn hypersurface(space: &str, function: &str) -> Hypersurface {
    let geometry = open(space, None).unwrap();
    let metric = geometry.metric().unwrap();
    let connection = Connection::levi_civita(geometry.frame(), metric).unwrap();
    Hypersurface::new(&connection, metric, &value(function), PositiveFactors::default()).unwrap()
}

/// Spheres, slices of Friedmann's universe, and horospheres. E. Poisson, *A Relativist's Toolkit*
/// (2004), chapter 3.
#[test]
fn hypersurfaces_have_their_published_curvature() {
    let sphere = hypersurface("minkowski", "x^2 + y^2 + z^2");
    assert_eq!(sphere.sign, 1);
    assert_eq!(sphere.mean_curvature, value("2/sqrt(x^2 + y^2 + z^2)"));
    assert_eq!(sphere.scalar_curvature, value("2/(x^2 + y^2 + z^2)"));
    assert!(!sphere.is_umbilic());
    // t = const in an expanding universe: K = a'/a h, H = 3 a'/a, S_h = 6 k/a^2
    let slice = hypersurface("friedmann", "t");
    let scale = FreeFunction::read("a(t)").unwrap();
    let rate = scale.named("a_t").unwrap().value() / &scale.value();
    assert_eq!((slice.sign, slice.is_umbilic()), (-1, true));
    assert_eq!(slice.mean_curvature, rate.clone() * &Symbolic::from(3));
    assert_eq!(slice.square, rate.clone() * &rate * &Symbolic::from(3));
    let intrinsic = value("6*k") / &(scale.value() * &scale.value());
    assert_eq!(slice.scalar_curvature, intrinsic);
    // r = const of Schwarzschild: K_tt = -M/r^2 sqrt(f), K_theta theta = r sqrt(f)
    let shell = hypersurface("schwarzschild", "r");
    let square = |x: &Symbolic| x.clone() * x;
    assert_eq!(square(&shell.second.get(&[2, 2])), value("r^2*(1 - 2*M/r)"));
    assert_eq!(square(&shell.second.get(&[0, 0])), value("M^2/r^4*(1 - 2*M/r)"));
    assert_eq!(square(&shell.mean_curvature), value("(2*r - 3*M)^2/(r^4*(1 - 2*M/r))"));
    assert_eq!(shell.scalar_curvature, value("2/r^2"));
    // static slices are totally geodesic, and horospheres are flat and umbilic with H = n - 1
    let time = hypersurface("schwarzschild", "t");
    assert!(time.second.is_empty() && time.scalar_curvature.is_zero() && time.sign == -1);
    let horosphere = hypersurface("hyperbolic-space", "z");
    assert!(horosphere.is_umbilic() && horosphere.scalar_curvature.is_zero());
    assert_eq!(square(&horosphere.mean_curvature), value("4/R^2"));
    // in a null direction there is no unit normal
    let geometry = open("eddington-finkelstein", None).unwrap();
    let metric = geometry.metric().unwrap();
    let connection = Connection::levi_civita(geometry.frame(), metric).unwrap();
    let function =
        Symbolic::parameter(&geometry.frame_origin().fields().unwrap().chart().coordinates()[0]);
    let refused = Hypersurface::new(&connection, metric, &function, PositiveFactors::default());
    assert!(refused.unwrap_err().to_string().contains("null gradient"));
}

/// Without a root of the squared length of the gradient, N is a name of the length. The
/// intrinsic curvature of the slices, computed from their own metric, satisfies the equation of
/// Gauss; the ellipsoid has its closed form. M. P. do Carmo, *Differential Geometry of Curves and
/// Surfaces* (1976), section 3.3.
#[test]
fn lengths_without_a_root_have_a_name() {
    let definition = |text: &str| {
        let definition = Definition::parse("space.toml", text).unwrap();
        definition.geometry::<Symbolic>(Tolerance::default()).unwrap()
    };
    let intrinsic = |text: &str| {
        let geometry = definition(text);
        let metric = geometry.metric().unwrap();
        geometry.connection().scalar_curvature(metric).unwrap()
    };
    let square = |x: &Symbolic| x.clone() * x;
    // the slices t = const of a rotating mass: maximal, with S_h = K_ij K^ij
    let slice = hypersurface("kerr", "t");
    let (name, length) = slice.length.clone().unwrap();
    assert_eq!((name.as_str(), slice.sign), ("N", -1));
    assert!(slice.mean_curvature.is_zero() && !slice.second.is_empty());
    assert_eq!(slice.scalar_curvature, slice.square);
    let sigma = "(r^2 + a^2*cos(theta)^2)";
    let text = format!(
        "parameters = [\"M\", \"a\"]\nmetric = \"diag({sigma}/(r^2 - 2*M*r + a^2), {sigma}, \
         (r^2 + a^2 + 2*M*r*a^2*sin(theta)^2/{sigma})*sin(theta)^2)\"\n\
         [chart]\ncoordinates = [\"r\", \"theta\", \"phi\"]\n"
    );
    assert_eq!(slice.scalar_curvature, intrinsic(&text));
    // K_r phi of the published form: N K = -g_phi phi/2 d_r omega, times N^2 = -g^tt
    let n = square(&Symbolic::parameter(&name));
    let k = square(&slice.second.get(&[1, 3])) * &n;
    assert!(!k.is_zero() && !k.parameters().contains(&name), "{k}");
    assert!(length.parameters().iter().any(|name| name == "theta"));
    // an ellipsoid of revolution in spherical coordinates, at f = s: K = s/(a^4 c^2 w^2)
    let flat = definition(
        "parameters = [\"a\", \"c\"]\nmetric = \"diag(1, r^2, r^2*sin(theta)^2)\"\n\
         [chart]\ncoordinates = [\"r\", \"theta\", \"phi\"]\n",
    );
    let metric = flat.metric().unwrap();
    let connection = Connection::levi_civita(flat.frame(), metric).unwrap();
    let f = value("r^2*(sin(theta)^2/a^2 + cos(theta)^2/c^2)");
    let ellipsoids = Hypersurface::new(&connection, metric, &f, PositiveFactors::default());
    let ellipsoids = ellipsoids.unwrap();
    let w = value("r^2*(sin(theta)^2/a^4 + cos(theta)^2/c^4)");
    let curvature = f / &(value("a^4*c^2") * &w * &w);
    assert_eq!(ellipsoids.scalar_curvature, curvature * &Symbolic::from(2));
    assert_eq!(ellipsoids.length.unwrap().1, w * &Symbolic::from(4));
}

/// `W^i_jkl` does not depend on a conformal factor; anti-de Sitter space and the hyperbolic plane are
/// conformal to flat spaces.
#[test]
fn conformal_factors_preserve_the_weyl_tensor() {
    for (space, factor) in [("schwarzschild", "r"), ("kerr", "1/r"), ("goedel", "exp(x)")] {
        let [plain, rescaled] = [None, Some(factor)].map(|factor| open(space, factor).unwrap());
        let weyl = |geometry: &Geometry<Symbolic>| {
            let metric = geometry.metric().unwrap();
            Connection::levi_civita(geometry.frame(), metric).unwrap().weyl(metric).unwrap()
        };
        assert_eq!(weyl(&plain), weyl(&rescaled), "{space}");
    }
    let space = open("minkowski", Some("1/x")).unwrap();
    let metric = space.metric().unwrap();
    let connection = Connection::levi_civita(space.frame(), metric).unwrap();
    assert_eq!(connection.scalar_curvature(metric).unwrap(), Symbolic::from(-12));
    let file =
        "conformal = \"1/y\"\nmetric = \"identity\"\n[chart]\ncoordinates = [\"x\", \"y\"]\n";
    let plane = Definition::parse("plane.toml", file).unwrap();
    let plane = plane.geometry::<Symbolic>(Tolerance::default()).unwrap();
    let curvature = plane.connection().scalar_curvature(plane.metric().unwrap()).unwrap();
    assert_eq!(curvature, Symbolic::from(-2));
}

#[test]
fn conformal_factors_are_refused_with_a_reason() {
    let refused = |space: &str, factor: &str| open(space, Some(factor)).unwrap_err().to_string();
    assert!(refused("minkowski", "0").contains("zero"));
    assert!(refused("so3", "2").contains("needs a metric"));
    assert!(refused("so3;metric=killing", "2").contains("cannot be rescaled"));
}
