//! Extrinsic curvature of the hypersurfaces on which a function is constant.
//!
//! Let `f` be a function with `g(grad f, grad f) != 0`, `eps` the sign of this number, and
//! `n = eps grad f / |grad f|` the unit normal, along which `f` increases. On each hypersurface
//! `f = const`,
//!
//! ```text
//! h_ij = g_ij - eps n_i n_j                            first fundamental form
//! K_ij = h_i^a h_j^b nabla_a n_b                       second fundamental form, K(x,y) = g(nabla_x n, y)
//! H    = g^ij K_ij = div n                             mean curvature, the sum of the principal ones
//! S_h  = S - 2 eps Ric(n,n) + eps (H^2 - K_ij K^ij)    scalar curvature of h, by the equation of Gauss
//! ```
//!
//! The sphere of radius `r` in space has `K = g/r` for the outer normal. C. W. Misner, K. S. Thorne,
//! J. A. Wheeler, *Gravitation* (1973), section 21.5, use the opposite sign of `K`.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::isometry::{is_positive_at_sample, signature_at_sample};
use crate::geometry::metric::Metric;
use crate::geometry::roots::Roots;
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Ring, Symbolic, Tensor};
use num_traits::{One, Zero};
use std::collections::BTreeSet;

/// The geometry of the hypersurfaces on which a function is constant, in the frame of the space.
///
/// ```
/// use affinor::geometry::hypersurface::Hypersurface;
/// use affinor::tensors::scalar::PositiveFactors;
/// use affinor::{Chart, Connection, Metric, Symbolic};
/// // spheres of radius r in space, in the coordinates x, y, z
/// let chart = Chart::new(["x", "y", "z"])?;
/// let metric = Metric::<Symbolic>::identity(3)?;
/// let space = Connection::levi_civita(&chart.coordinate_frame()?, &metric)?;
/// let square: Symbolic = "x^2 + y^2 + z^2".parse()?;
/// let spheres = Hypersurface::new(&space, &metric, &square, PositiveFactors::default())?;
/// assert_eq!(spheres.mean_curvature.to_string(), "2/sqrt(x^2 + y^2 + z^2)");
/// assert_eq!(spheres.scalar_curvature.to_string(), "2/(x^2 + y^2 + z^2)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("shape operator", "second fundamental form"))]
#[derive(Clone, Debug)]
pub struct Hypersurface {
    /// The sign `eps` of the norm of the gradient: 1, or -1 for a timelike normal in signature
    /// `(-+++)`.
    pub sign: i64,
    /// The unit normal `n_i`, slot `_i`.
    pub normal: Tensor<Symbolic>,
    /// The first fundamental form `h_ij`.
    pub first: Tensor<Symbolic>,
    /// The second fundamental form `K_ij`.
    pub second: Tensor<Symbolic>,
    /// The mean curvature `H`.
    pub mean_curvature: Symbolic,
    /// The square `K_ij K^ij`.
    pub square: Symbolic,
    /// The scalar curvature `S_h` of the hypersurfaces.
    pub scalar_curvature: Symbolic,
    /// A name for the length `N = |grad f|`, and its square `N^2`, which is assumed to be positive.
    /// It is `None` if the length is a function of its own. Otherwise the name occurs in the
    /// normal, the second form and the mean curvature.
    pub length: Option<(String, Symbolic)>,
    /// The functions that are assumed to be positive.
    pub assumed: Vec<Symbolic>,
}

impl Hypersurface {
    /// The hypersurfaces of a function, for a Levi-Civita connection. If the norm of the gradient has
    /// both signs, a region is chosen in which the first vector of the basis is timelike. Without
    /// a region of this kind, the norm is positive.
    ///
    /// If the length `N` of the gradient is not a function of the engine, as the root of a sum of
    /// sines, a new name denotes it; see [`Hypersurface::length`].
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the gradient is null; [`Error::Shape`] if the dimensions differ.
    pub fn new(
        connection: &Connection<Symbolic>,
        metric: &Metric<Symbolic>,
        function: &Symbolic,
        positive: PositiveFactors,
    ) -> Result<Self, Error> {
        let _stage = stage("hypersurface");
        let frame = connection.frame();
        let n = frame.dimension();
        metric.expect_dimension(n)?;
        let slope = (0..n).map(|k| ([k], frame.derive(k, function)));
        let gradient = Tensor::from_components(n, &[Down], slope)?;
        let inverse = metric.inverse();
        let norm = formula("g^ij f_i f_j ->", &[("g", inverse), ("f", &gradient)]).get(&[]);
        if norm.is_zero() {
            let what = if gradient.is_empty() { "is constant" } else { "has a null gradient" };
            return Err(Error::Unsupported(format!(
                "the function {function} {what}, so it has no unit normal"
            )));
        }
        let mut roots = Roots::new(positive);
        let time = timelike(metric, roots.given());
        let is_positive = match &time {
            Some(time) if roots.sample(std::slice::from_ref(time)) => roots.is_positive(&norm),
            _ => None,
        };
        let is_positive =
            is_positive.unwrap_or_else(|| is_positive_at_sample(&norm, roots.given()));
        let sign = if is_positive { 1 } else { -1 };
        let eps = Symbolic::from_i64(sign);
        let size = norm.clone() * &eps;
        let both: Vec<Symbolic> = std::iter::once(size.clone()).chain(time).collect();
        if !roots.sample(&both) {
            roots.sample(&both[..1]);
        }
        // without a root, the equations below hold for a name N with N^2 = size
        let (length, named) = match roots.root(&size) {
            Ok(length) => (length, None),
            Err(_) => {
                let name = new_name(metric, function);
                (Symbolic::parameter(&name), Some((name, size.clone())))
            }
        };
        // eps/|grad f|
        let over_length = length.recip().unwrap_or_default() * &eps;
        let over_norm = norm.recip().unwrap_or_default();
        // h_i^a = delta_i^a - f_i f^a/g(f,f) contains no root
        let raised = gradient.raise(0, inverse)?.scale(&over_norm);
        let unit = Tensor::identity(n);
        let projection =
            formula("d^a_i - f^a k_i -> ^a_i", &[("d", &unit), ("f", &raised), ("k", &gradient)]);
        let hessian = connection.nabla(&gradient)?;
        let projected = formula("D_ab P^a_i -> _ib", &[("D", &hessian), ("P", &projection)]);
        let projected = formula("D_ib P^b_j -> _ij", &[("D", &projected), ("P", &projection)]);
        let second = projected.scale(&over_length);
        let first = formula(
            "g_ij - s_i f_j -> _ij",
            &[("g", metric.components()), ("s", &gradient.scale(&over_norm)), ("f", &gradient)],
        );
        let trace = metric.trace(&projected)?;
        let mean_curvature = trace.clone() * &over_length;
        let mixed = projected.raise(0, inverse)?;
        let square = formula("A^i_j A^j_i ->", &[("A", &mixed)]).get(&[]);
        // 1/N^2 contains no root
        let over_size = over_norm.clone() * &eps;
        let square = square * &over_size;
        let normal_ricci = formula(
            "R_ij f^i f^j ->",
            &[("R", &connection.ricci()), ("f", &gradient.raise(0, inverse)?)],
        );
        // eps Ric(n,n) = Ric(grad f, grad f)/g(grad f, grad f)
        let normal_ricci = normal_ricci.get(&[]) * &over_norm;
        let extrinsic = trace.clone() * &trace * &over_size - &square;
        let scalar_curvature = connection.scalar_curvature(metric)?
            - &(normal_ricci * &Symbolic::from_i64(2))
            + &(extrinsic * &eps);
        Ok(Hypersurface {
            sign,
            normal: gradient.scale(&over_length),
            first,
            second,
            mean_curvature,
            square,
            scalar_curvature,
            length: named,
            assumed: roots.assumed(),
        })
    }

    /// Whether all points are umbilic: `K = H/(n-1) h`.
    pub fn is_umbilic(&self) -> bool {
        let n = self.first.dimension() as i64;
        let share = Symbolic::from_i64(n - 1).recip().unwrap_or_else(Symbolic::one);
        let multiple = self.first.scale(&(self.mean_curvature.clone() * &share));
        formula("K_ij - h_ij -> _ij", &[("K", &self.second), ("h", &multiple)]).is_empty()
    }
}

/// A name for the length of the gradient that does not occur in the metric and the function.
fn new_name(metric: &Metric<Symbolic>, function: &Symbolic) -> String {
    let components = metric.components().components().map(|(_, value)| value);
    let taken: BTreeSet<String> =
        components.chain([function]).flat_map(|value| value.parameters()).collect();
    let numbered = (1..).map(|at| format!("N{at}"));
    let mut names = std::iter::once("N".to_string()).chain(numbered);
    names.find(|name| !taken.contains(name)).unwrap_or_default()
}

/// A function that is positive where the first vector of the basis of an indefinite metric is
/// timelike: its norm has the less frequent sign there. A definite metric has no such function.
fn timelike(metric: &Metric<Symbolic>, positive: &[Symbolic]) -> Option<Symbolic> {
    let [plus, minus] = signature_at_sample(metric.components(), positive)?;
    let norm = metric.components().get(&[0, 0]);
    let time = if plus >= minus { -norm } else { norm };
    (plus > 0 && minus > 0).then_some(time)
}
