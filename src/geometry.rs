//! Geometries: a frame with a connection and, optionally, a metric. In reading order:
//!
//! - [`connection`]: affinities and covariant derivatives; [`metric`]: metrics and their inverses;
//! - [`metric_affine`]: nonmetricity, Levi-Civita, contorsion and disformation;
//! - [`curvature`]: torsion, curvature, Bianchi identities, Ricci, Weyl and further tensors;
//! - [`properties`]: parallel curvature, Einstein, bi-invariance, with witnesses; [`holonomy`];
//! - [`chart`]: coordinates and moving frames; [`forms`]: differential forms; [`hodge`]: their star
//!   and Laplacian;
//! - [`hypersurface`]: extrinsic curvature; [`equations`]: equations of motion;
//! - [`reductive`]: homogeneous spaces G/H; [`homogeneous`]: the same by name;
//! - [`isometry`]: Killing and homothetic fields as Lie algebras; [`petrov`]: the type of a spacetime;
//!   [`null_tetrad`]: Weyl scalars;
//! - [`sub_riemannian`]: distributions with an inner product;
//! - [`Geometry`]: frame, connection and metric together;
//! - [`conditions`]: the conditions on parameters under which a tensor vanishes.

pub mod chart;
pub mod conditions;
pub mod connection;
pub mod curvature;
pub mod equations;
pub mod forms;
pub mod hodge;
pub mod holonomy;
pub mod homogeneous;
pub mod hypersurface;
pub mod isometry;
pub mod metric;
pub mod metric_affine;
pub mod null_tetrad;
pub mod petrov;
pub mod properties;
pub mod reductive;
mod roots;
pub mod sub_riemannian;

use crate::algebra::frame::Frame;
use crate::algebra::{Bracket, LieAlgebra};
use crate::geometry::chart::Fields;
pub use crate::geometry::connection::complement_projector;
use crate::geometry::connection::{CanonicalConnection, Connection};
use crate::geometry::homogeneous::HomogeneousSpace;
use crate::geometry::metric::Metric;
pub use crate::geometry::sub_riemannian::SubRiemannian;
use crate::{Error, Law};
use affinor_tensors::{Field, Notation, Scalar, Tensor};
use std::fmt;

/// A frame with a connection and, optionally, a metric. All components refer to this frame.
///
/// Connection and metric are independent: M(3) and SO(3) have the same Lie algebra, but different
/// connections and metrics.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::{ConnectionKind, Geometry, Metric, Rational};
/// let metric = Metric::diagonal([1, 2, 3].map(Rational::from))?;
/// let so3 = catalogue::algebra("so(3)")?;
/// let body = Geometry::new("so(3)", so3, ConnectionKind::LeviCivita, Some(metric))?;
/// assert_eq!(body.to_string(), "so(3), connection levi-civita (of the metric), metric diag(1, 2, 3)");
/// assert_eq!(body.frame_name(), "left-invariant");
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("manifold"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry<S> {
    name: String,
    algebra_name: Option<String>,
    origin: FrameOrigin<S>,
    connection: Connection<S>,
    kind: ConnectionKind<S>,
    metric: Option<Metric<S>>,
    /// Whether the components are those of the right-invariant frame.
    right: bool,
}

/// The origin of the frame of a geometry.
#[derive(Clone, Debug, PartialEq)]
pub enum FrameOrigin<S> {
    /// The left-invariant frame of a Lie algebra.
    Algebra(LieAlgebra<S>),
    /// Fields on a chart, and their Lie algebra if the structure functions are constant. In this
    /// case, the fields are locally the left-invariant fields of a group with this algebra.
    Chart(Box<Fields<S>>, Option<LieAlgebra<S>>),
    /// The complement of the isotropy algebra of a homogeneous space.
    Homogeneous(Box<HomogeneousSpace<S>>),
}

impl<S: Field + Scalar> FrameOrigin<S> {
    /// The frame.
    pub fn frame(&self) -> &Frame<S> {
        match self {
            FrameOrigin::Algebra(algebra) => algebra.left_frame(),
            FrameOrigin::Chart(fields, _) => fields.frame(),
            FrameOrigin::Homogeneous(space) => space.pair().frame(),
        }
    }

    /// The Lie algebra of the frame; `None` if its structure functions are not constant, and for a
    /// homogeneous space.
    pub fn algebra(&self) -> Option<&LieAlgebra<S>> {
        match self {
            FrameOrigin::Algebra(algebra) => Some(algebra),
            FrameOrigin::Chart(_, algebra) => algebra.as_ref(),
            FrameOrigin::Homogeneous(_) => None,
        }
    }

    /// The homogeneous space; `None` for other frames.
    pub fn homogeneous(&self) -> Option<&HomogeneousSpace<S>> {
        match self {
            FrameOrigin::Homogeneous(space) => Some(space),
            _ => None,
        }
    }

    /// Checks that a metric is the metric of a geometry with this frame: on a homogeneous space,
    /// it must be invariant under the isotropy algebra.
    ///
    /// # Errors
    /// [`Law::IsotropyInvariance`]; [`Error::Shape`] when the dimensions differ.
    pub fn expect_metric(&self, metric: &Metric<S>) -> Result<(), Error> {
        metric.expect_dimension(self.frame().dimension())?;
        match self.homogeneous() {
            Some(space) => space.pair().expect_invariant("the metric", metric.components()),
            None => Ok(()),
        }
    }

    /// The structure functions, if they are constant: on a homogeneous space they are the brackets
    /// `[x,y]_m`. The parameter `what` names the computation; it occurs in the error.
    ///
    /// # Errors
    /// [`Law::Constant`] with `what` and the first structure function that is not constant.
    pub fn constant_structure(&self, what: &'static str) -> Result<&Tensor<S>, Error> {
        match self.homogeneous() {
            Some(space) => Ok(space.pair().frame().structure_functions()),
            None => Ok(self.algebra_for(what)?.structure_constants()),
        }
    }

    /// The Lie algebra of the frame. The parameter `what` names the computation that needs the
    /// algebra; it occurs in the error.
    ///
    /// # Errors
    /// [`Law::Constant`] with `what` and the first structure function that is not constant;
    /// [`Error::Unsupported`] for a homogeneous space.
    pub fn algebra_for(&self, what: &'static str) -> Result<&LieAlgebra<S>, Error> {
        if let Some(space) = self.homogeneous() {
            let name = space.name();
            let message = format!("{what} needs a Lie group, but {name} is a homogeneous space");
            return Err(Error::Unsupported(message));
        }
        self.algebra().ok_or_else(|| {
            let frame = self.frame();
            let found =
                frame.structure_functions().components().find(|(_, value)| self.varies(value));
            let (component, value) = found.map_or_else(Default::default, |(at, value)| {
                let [i, j, k] = [at[0] + 1, at[1] + 1, at[2] + 1];
                (format!("c^{i}_{j}{k}"), value.to_string())
            });
            Law::Constant.broken([what.into(), component], value)
        })
    }

    /// Whether the value has a nonzero derivative along a frame vector.
    fn varies(&self, value: &S) -> bool {
        let frame = self.frame();
        (0..frame.dimension()).any(|k| !frame.derive(k, value).vanishes())
    }

    /// The fields of a frame on a chart; `None` for other frames.
    pub fn fields(&self) -> Option<&Fields<S>> {
        match self {
            FrameOrigin::Chart(fields, _) => Some(fields),
            _ => None,
        }
    }
}

impl<S> From<HomogeneousSpace<S>> for FrameOrigin<S> {
    fn from(space: HomogeneousSpace<S>) -> Self {
        FrameOrigin::Homogeneous(Box::new(space))
    }
}

impl<S> From<LieAlgebra<S>> for FrameOrigin<S> {
    fn from(algebra: LieAlgebra<S>) -> Self {
        FrameOrigin::Algebra(algebra)
    }
}

impl<S: Field + Scalar> From<Fields<S>> for FrameOrigin<S> {
    fn from(fields: Fields<S>) -> Self {
        let frame = fields.frame();
        let structure = frame.structure_functions();
        let constant = frame.derivative(structure).is_ok_and(|derivative| derivative.is_empty());
        let algebra = constant.then(|| Bracket::new(frame.labels(), structure.clone()));
        let algebra = algebra.and_then(|bracket| LieAlgebra::try_from(bracket.ok()?).ok());
        FrameOrigin::Chart(Box::new(fields), algebra)
    }
}

/// The choice of a connection.
#[derive(Clone, Debug, PartialEq)]
pub enum ConnectionKind<S> {
    /// One of the three canonical connections.
    Canonical(CanonicalConnection),
    /// A member `Lambda = lambda c` of the family.
    Family(S),
    /// The Levi-Civita connection of the metric.
    LeviCivita,
    /// Affinities given by components, in the frame of the geometry.
    Affinities(Tensor<S>),
    /// The [nonholonomic connection](Connection::nonholonomic) of the Levi-Civita connection and of
    /// the projector `P'` onto the orthogonal complement of a distribution.
    Nonholonomic(Tensor<S>),
}

impl<S: Notation + Scalar> Geometry<S> {
    /// The geometry with a connection of the given kind.
    ///
    /// # Errors
    /// [`Error::NoMetric`] for Levi-Civita without a metric; [`Law::Constant`] for a canonical
    /// connection over structure functions; [`Law::IsotropyInvariance`] for a metric or affinities
    /// on a homogeneous space that are not invariant; [`Error::Shape`].
    pub fn new(
        name: impl Into<String>,
        origin: impl Into<FrameOrigin<S>>,
        kind: ConnectionKind<S>,
        metric: Option<Metric<S>>,
    ) -> Result<Self, Error> {
        let origin = origin.into();
        let frame = origin.frame();
        if let Some(metric) = &metric {
            origin.expect_metric(metric)?;
        }
        let canonical = |lambda: &S| {
            let what = "a connection lambda c";
            origin.constant_structure(what)?;
            if origin.varies(lambda) {
                let at = [what, "lambda"].map(String::from);
                return Err(Law::Constant.broken(at, lambda.to_string()));
            }
            Ok(Connection::in_frame(frame, lambda))
        };
        let connection = match (&kind, &metric) {
            (ConnectionKind::Canonical(which), _) => canonical(&which.lambda())?,
            (ConnectionKind::Family(lambda), _) => canonical(lambda)?,
            (ConnectionKind::LeviCivita, Some(metric)) => Connection::levi_civita(frame, metric)?,
            (ConnectionKind::Nonholonomic(projector), Some(metric)) => {
                if origin.homogeneous().is_some() {
                    let reason = "the connection nonholonomic does not exist on homogeneous spaces";
                    return Err(Error::Unsupported(reason.into()));
                }
                Connection::levi_civita(frame, metric)?.nonholonomic(projector)?
            }
            (ConnectionKind::LeviCivita | ConnectionKind::Nonholonomic(_), None) => {
                return Err(Error::NoMetric);
            }
            (ConnectionKind::Affinities(gamma), _) => match origin.homogeneous() {
                Some(space) => space.pair().connection(gamma.clone())?,
                None => Connection::new(frame.clone(), gamma.clone())?,
            },
        };
        let (name, algebra_name, right) = (name.into(), None, false);
        Ok(Geometry { name, algebra_name, origin, connection, kind, metric, right })
    }

    /// The same geometry with components in the right-invariant frame, which are the structure `-c`
    /// and the affinities `Lambda - c`. A metric that is not bi-invariant is omitted, because its
    /// components are not constant in this frame. Without a metric, applying this method twice
    /// returns the original geometry.
    ///
    /// # Errors
    /// [`Law::AdInvariance`] for a connection without constant components in the right-invariant
    /// frame; [`Error::Unsupported`] over a chart, and on a homogeneous space.
    pub fn in_right_frame(&self) -> Result<Self, Error> {
        let unsupported = |message: &str| Err(Error::Unsupported(message.into()));
        let algebra = match &self.origin {
            FrameOrigin::Algebra(algebra) => algebra,
            FrameOrigin::Chart(..) => {
                return unsupported("fields on a chart have no right-invariant frame");
            }
            FrameOrigin::Homogeneous(_) => {
                return unsupported("a homogeneous space has no right-invariant frame");
            }
        };
        let connection = self.connection.in_right_frame(algebra)?;
        let metric = self.metric.as_ref().filter(|metric| {
            metric.ad_invariance_defect(algebra).is_ok_and(|variation| variation.is_empty())
        });
        let kind = match &self.kind {
            ConnectionKind::Affinities(_) | ConnectionKind::Nonholonomic(_) => {
                ConnectionKind::Affinities(connection.affinities().clone())
            }
            kind => kind.clone(),
        };
        Ok(Geometry {
            origin: algebra.opposite().into(),
            connection,
            kind,
            metric: metric.cloned(),
            right: !self.right,
            ..self.clone()
        })
    }

    /// The name of the frame to which all components refer: `left-invariant` or `right-invariant`,
    /// `coordinate` or `moving` over a chart, or `reductive` on a homogeneous space.
    pub fn frame_name(&self) -> &'static str {
        match &self.origin {
            FrameOrigin::Homogeneous(_) => "reductive",
            FrameOrigin::Chart(fields, _) if fields.are_coordinates() => "coordinate",
            FrameOrigin::Chart(..) => "moving",
            FrameOrigin::Algebra(_) if self.right => "right-invariant",
            FrameOrigin::Algebra(_) => "left-invariant",
        }
    }

    /// The short name of the connection, as [`ConnectionKind::name`]. On a homogeneous space,
    /// `canonical` is the connection `Lambda = 0`, and `natural` the connection `Lambda = c/2`.
    pub fn connection_name(&self) -> &'static str {
        match (&self.kind, self.origin.homogeneous()) {
            (ConnectionKind::Canonical(which), Some(_)) => which.on_homogeneous_space().0,
            (kind, _) => kind.name(),
        }
    }

    /// The name of the connection with an explanation, as [`ConnectionKind::describe`].
    pub fn describe_connection(&self) -> String {
        match (&self.kind, self.origin.homogeneous()) {
            (ConnectionKind::Canonical(which), Some(_)) => {
                let (name, words) = which.on_homogeneous_space();
                format!("{name} ({words})")
            }
            (kind, _) => kind.describe(),
        }
    }

    /// The same geometry with another name for its algebra, such as so(3) for M(3).
    #[must_use]
    pub fn over(self, algebra_name: impl Into<String>) -> Self {
        Geometry { algebra_name: Some(algebra_name.into()), ..self }
    }

    /// The name of the algebra. It is the name of the geometry, unless [`over`](Self::over) has set
    /// another name.
    pub fn algebra_name(&self) -> &str {
        self.algebra_name.as_deref().unwrap_or(&self.name)
    }

    /// The name of the geometry.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The origin of the frame: the Lie algebra, the fields on a chart, or the homogeneous space.
    pub fn frame_origin(&self) -> &FrameOrigin<S> {
        &self.origin
    }

    /// The frame to which all components refer.
    pub fn frame(&self) -> &Frame<S> {
        self.connection.frame()
    }

    /// The Lie algebra of the frame; `None` if the structure functions are not constant.
    pub fn algebra(&self) -> Option<&LieAlgebra<S>> {
        self.origin.algebra()
    }

    /// The connection, with components in the [`frame`](Self::frame).
    pub fn connection(&self) -> &Connection<S> {
        &self.connection
    }

    /// The choice of the connection.
    pub fn kind(&self) -> &ConnectionKind<S> {
        &self.kind
    }

    /// The metric; `None` if the geometry has no metric.
    pub fn metric(&self) -> Option<&Metric<S>> {
        self.metric.as_ref()
    }

    /// Whether the connection is the Levi-Civita connection of the metric, which means torsion-free
    /// and compatible. For a bi-invariant metric, the connection `zero` is the Levi-Civita
    /// connection.
    ///
    /// # Errors
    /// No error occurs for a valid geometry. An [`Error::Shape`] of a computation is returned
    /// unchanged.
    pub fn is_levi_civita(&self) -> Result<bool, Error> {
        let Some(metric) = &self.metric else { return Ok(false) };
        Ok(self.kind == ConnectionKind::LeviCivita
            || self.connection.torsion().is_empty()
                && self.connection.nonmetricity(metric)?.is_empty())
    }
}

/// Writes the geometry, such as
/// `so(3), connection plus (left invariant canonical), metric diag(1, 2, 3)`.
impl<S: Notation + Scalar> fmt::Display for Geometry<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, connection {}", self.name, self.describe_connection())?;
        match &self.metric {
            Some(metric) => write!(f, ", metric {metric}"),
            None => Ok(()),
        }
    }
}

impl<S: Notation + Scalar> ConnectionKind<S> {
    /// The short name: `plus`, `zero`, `minus`, `lambda`, `levi-civita`, `affinities`,
    /// `nonholonomic`.
    pub fn name(&self) -> &'static str {
        match self {
            ConnectionKind::Canonical(which) => which.name(),
            ConnectionKind::Family(_) => "lambda",
            ConnectionKind::LeviCivita => "levi-civita",
            ConnectionKind::Affinities(_) => "affinities",
            ConnectionKind::Nonholonomic(_) => "nonholonomic",
        }
    }

    /// The factor `lambda` of a connection `Lambda = lambda c`; `None` for other connections.
    pub fn lambda(&self) -> Option<S> {
        match self {
            ConnectionKind::Canonical(which) => Some(which.lambda()),
            ConnectionKind::Family(lambda) => Some(lambda.clone()),
            _ => None,
        }
    }

    /// The name with an explanation, for the header of an output.
    pub fn describe(&self) -> String {
        match self {
            ConnectionKind::Canonical(which) => format!("{} ({})", which.name(), which.paper()),
            ConnectionKind::Family(lambda) => format!("lambda = {lambda}"),
            ConnectionKind::LeviCivita => "levi-civita (of the metric)".into(),
            ConnectionKind::Affinities(_) => "affinities (given one by one)".into(),
            ConnectionKind::Nonholonomic(_) => {
                "nonholonomic (of the metric and a distribution)".into()
            }
        }
    }
}
