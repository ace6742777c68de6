//! Geometries: an algebra, a connection and a metric.

use crate::{Canonical, Connection, Error, LieAlgebra, Metric};
use affinor_tensors::{Notation, Tensor};

/// A Lie algebra with a left-invariant connection and, perhaps, a left-invariant metric.
///
/// A connection is not a kind of metric, nor the other way round: M(3) and SO(3) share their
/// algebra and differ in both ([`paper`](crate::paper)).
#[derive(Clone, Debug)]
pub struct Geometry<S> {
    name: String,
    algebra_name: Option<String>,
    algebra: LieAlgebra<S>,
    connection: Connection<S>,
    kind: ConnectionKind<S>,
    metric: Option<Metric<S>>,
}

/// How a connection was chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum ConnectionKind<S> {
    /// One of the three canonical connections.
    Canonical(Canonical),
    /// A member `Lambda = lambda c` of the family.
    Family(S),
    /// The Levi-Civita connection of the metric.
    LeviCivita,
    /// Affinities given one by one.
    Affinities(Tensor<S>),
}

impl<S: Notation> Geometry<S> {
    /// The geometry with a connection of the given kind.
    ///
    /// # Errors
    /// [`Error::NoMetric`] for Levi-Civita without a metric; [`Error::Shape`].
    pub fn new(
        name: impl Into<String>,
        algebra: LieAlgebra<S>,
        kind: ConnectionKind<S>,
        metric: Option<Metric<S>>,
    ) -> Result<Self, Error> {
        let frame = algebra.left_frame();
        let connection = match (&kind, &metric) {
            (ConnectionKind::Canonical(which), _) => Connection::canonical(&algebra, *which),
            (ConnectionKind::Family(lambda), _) => Connection::family(&algebra, lambda),
            (ConnectionKind::LeviCivita, Some(metric)) => Connection::levi_civita(frame, metric)?,
            (ConnectionKind::LeviCivita, None) => return Err(Error::NoMetric),
            (ConnectionKind::Affinities(gamma), _) => {
                Connection::new(frame.clone(), gamma.clone())?
            }
        };
        Ok(Geometry { name: name.into(), algebra_name: None, algebra, connection, kind, metric })
    }

    /// The same geometry with its components in the right-invariant frame: structure `-c`,
    /// affinities `Lambda - c`. A metric that is not bi-invariant has no constant components
    /// there, and is left out.
    ///
    /// # Errors
    /// [`Error::NotInvariant`] for a connection without constant components there.
    pub fn in_right_frame(&self) -> Result<Self, Error> {
        let connection = self.connection.in_right_frame(&self.algebra)?;
        let metric = self.metric.as_ref().filter(|metric| metric.is_bi_invariant(&self.algebra));
        Ok(Geometry {
            algebra: self.algebra.opposite(),
            connection,
            metric: metric.cloned(),
            ..self.clone()
        })
    }

    /// The same geometry with a name for its algebra, where that is not its own: so(3) for M(3).
    #[must_use]
    pub fn over(self, algebra_name: impl Into<String>) -> Self {
        Geometry { algebra_name: Some(algebra_name.into()), ..self }
    }

    /// The name of its algebra.
    pub fn algebra_name(&self) -> &str {
        self.algebra_name.as_deref().unwrap_or(&self.name)
    }

    /// The name it goes by.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The Lie algebra.
    pub fn algebra(&self) -> &LieAlgebra<S> {
        &self.algebra
    }

    /// The connection, in the left-invariant frame.
    pub fn connection(&self) -> &Connection<S> {
        &self.connection
    }

    /// How the connection was chosen.
    pub fn kind(&self) -> &ConnectionKind<S> {
        &self.kind
    }

    /// The metric, if there is one.
    pub fn metric(&self) -> Option<&Metric<S>> {
        self.metric.as_ref()
    }

    /// Whether the connection is that of the metric, chosen so or equal to it: torsion-free and
    /// compatible, as `zero` is with a bi-invariant metric.
    ///
    /// # Errors
    /// [`Error::Shape`], which a valid geometry does not cause.
    pub fn is_levi_civita(&self) -> Result<bool, Error> {
        let Some(metric) = &self.metric else { return Ok(false) };
        Ok(self.kind == ConnectionKind::LeviCivita
            || self.connection.torsion().is_empty()
                && self.connection.nonmetricity(metric)?.is_empty())
    }
}

impl<S: Notation> ConnectionKind<S> {
    /// The short name: `plus`, `zero`, `minus`, `lambda`, `levi-civita`, `affinities`.
    pub fn name(&self) -> &'static str {
        match self {
            ConnectionKind::Canonical(which) => which.name(),
            ConnectionKind::Family(_) => "lambda",
            ConnectionKind::LeviCivita => "levi-civita",
            ConnectionKind::Affinities(_) => "affinities",
        }
    }

    /// The factor in `Lambda = lambda c`, where the connection is of that kind.
    pub fn lambda(&self) -> Option<S> {
        match self {
            ConnectionKind::Canonical(which) => Some(which.lambda()),
            ConnectionKind::Family(lambda) => Some(lambda.clone()),
            _ => None,
        }
    }

    /// The name with its meaning, for the head of an output.
    pub fn describe(&self) -> String {
        match self {
            ConnectionKind::Canonical(which) => format!("{} ({})", which.name(), which.paper()),
            ConnectionKind::Family(lambda) => format!("lambda = {lambda}"),
            ConnectionKind::LeviCivita => "levi-civita (of the metric)".into(),
            ConnectionKind::Affinities(_) => "affinities (given one by one)".into(),
        }
    }
}
