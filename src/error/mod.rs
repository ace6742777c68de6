//! Errors of the library. Each error contains a witness.

mod law;

pub use law::Law;

use crate::algebra::catalogue::CatalogueError;
use affinor_tensors::TensorError;
use affinor_tensors::linear::LinearError;

/// An error of the library. It reports the fault, the location and the size of the violation.
///
/// Basis vectors are identified by their labels. Residuals are linear combinations of these labels.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The shapes of tensors do not fit, or a scalar in a formula has no inverse.
    #[error(transparent)]
    Tensor(#[from] TensorError),
    /// Linear equations cannot be solved, because the scalars are not a field.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// The name does not identify exactly one algebra of the catalogue.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The name does not identify a group or a column, or cannot be the name of a coordinate.
    #[error("{0}")]
    Name(String),
    /// A tensor has the wrong dimension or the wrong slots.
    #[error("{what} should have {expected}, not {found}")]
    Shape {
        /// The name of the object.
        what: &'static str,
        /// The required shape.
        expected: String,
        /// The shape that was found.
        found: String,
    },
    /// A search has more candidates than its limit.
    #[error("{size} {what} are too many to search: the limit is {limit}")]
    Size {
        /// The candidates, as a plural noun.
        what: &'static str,
        /// The number of candidates.
        size: usize,
        /// The largest number that is allowed.
        limit: usize,
    },
    /// A component is infinite or NaN.
    #[error("{what}: the component {} = {value} is not a finite number", indices(.at.iter().copied()))]
    NotFinite {
        /// The name of the object.
        what: &'static str,
        /// The indices of the component, from 1.
        at: Vec<usize>,
        /// The value of the component.
        value: String,
    },
    /// A value exceeds the range of `f64`.
    #[error("{component} = {value}: the computation left the range of f64")]
    Overflow {
        /// The name of the component.
        component: String,
        /// The value.
        value: String,
    },
    /// A law is violated; see [`Law::broken`].
    #[error(fmt = Law::write)]
    Broken {
        /// The law.
        law: Law,
        /// The vectors and other names at which the law fails, in the order of [`Law::parts`].
        at: Vec<String>,
        /// The value that contradicts the law. In most laws, it is a remainder that should vanish.
        residual: String,
    },
    /// A tensor lacks a required symmetry.
    #[error(
        "{what} is not {symmetry} in the slots {} and {}: component {} is off by {residual}",
        .slots[0], .slots[1], indices(.at.iter().copied())
    )]
    Symmetry {
        /// The name of the tensor.
        what: &'static str,
        /// The required symmetry: `symmetric` or `antisymmetric`.
        symmetry: &'static str,
        /// The two slots, from 1.
        slots: [usize; 2],
        /// The indices of a component, from 1.
        at: Vec<usize>,
        /// The difference (for antisymmetry: the sum) of the component and the component with the
        /// two indices exchanged.
        residual: String,
    },
    /// The metric is degenerate.
    #[error("the metric is degenerate: {null} is orthogonal to every vector")]
    Degenerate {
        /// A vector of the kernel, as text.
        null: String,
        /// The nonzero components of this vector, each with the number of its basis vector, from 1.
        components: Vec<(usize, String)>,
    },
    /// The Levi-Civita connection was requested without a metric.
    #[error("the connection levi-civita needs a metric, but none is given")]
    NoMetric,
    /// The matrix of a change of basis is singular.
    #[error("the new basis is linearly dependent")]
    SingularBasis,
    /// A value does not exist or is not admissible, as in `invalid inertia: the mass is -1`.
    #[error("invalid {what}: {reason}")]
    Invalid {
        /// The name of the object: `basis`, `element of the group`, `logarithm`, `mean`,
        /// `rotation`, `inertia`, `state`, `solid`, or the name of coordinates.
        what: &'static str,
        /// The reason, with the witness.
        reason: String,
    },
    /// The operation is not defined in this frame, or the method does not apply to the problem.
    #[error("{0}")]
    Unsupported(String),
    /// A curve on a chart cannot be continued, because it leaves the chart.
    #[error("the curve ends at the parameter {parameter}: {reason}")]
    CurveEnds {
        /// The parameter that has been reached.
        parameter: f64,
        /// The place and the reason.
        reason: String,
    },
    /// A point cannot be the end of a geodesic.
    #[error("the end point {reason}")]
    EndPoint {
        /// The predicate of the sentence, as in `is not in the chart`.
        reason: String,
    },
    /// No geodesic between two points was found.
    #[error("no geodesic between the points was found: {reason}")]
    NoGeodesic {
        /// How far the nearest curve ends from the point, or why no curve reached its end.
        reason: String,
    },
    /// An integration has failed before its final time.
    #[error("the integration stops at t = {t}: {reason}")]
    Integration {
        /// The time that has been reached.
        t: f64,
        /// The reason of the failure.
        reason: String,
    },
}

impl Error {
    /// The error for a name that cannot be a coordinate, because it is not an identifier or occurs
    /// twice.
    pub(crate) fn coordinate(name: &str) -> Self {
        Error::Name(format!("the coordinate name `{name}` is not an identifier, or occurs twice"))
    }

    /// The class of the error, which is the name of the exception in Python, such as `JacobiError`.
    pub fn class(&self) -> &'static str {
        self.row().0
    }

    /// Advice on what to change, if there is general advice.
    pub fn advice(&self) -> Option<&'static str> {
        self.row().1
    }

    fn row(&self) -> (&'static str, Option<&'static str>) {
        match self {
            Error::Broken { law, .. } => (law.class(), law.advice()),
            Error::Tensor(_) | Error::Shape { .. } => ("ShapeError", None),
            Error::Catalogue(_) | Error::Name(_) => ("InputError", None),
            Error::Symmetry { .. } => ("SymmetryError", None),
            Error::NoMetric => ("MetricError", None),
            Error::Degenerate { .. } => {
                ("MetricError", Some("give a metric whose matrix is invertible"))
            }
            Error::Integration { .. } | Error::CurveEnds { .. } => ("IntegrationError", None),
            Error::NoGeodesic { .. } => (
                "MathematicsError",
                Some(
                    "search from more initial velocities, or check that a geodesic joins the points",
                ),
            ),
            Error::Linear(_)
            | Error::Size { .. }
            | Error::NotFinite { .. }
            | Error::Overflow { .. }
            | Error::SingularBasis
            | Error::EndPoint { .. }
            | Error::Invalid { .. }
            | Error::Unsupported(_) => ("MathematicsError", None),
        }
    }
}

/// Writes a list of indices, such as `1,2,3`.
pub(crate) fn indices(at: impl IntoIterator<Item = usize>) -> String {
    at.into_iter().map(|index| index.to_string()).collect::<Vec<_>>().join(",")
}
