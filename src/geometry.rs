//! Geometries: an algebra or a frame over a chart, a connection and a metric.

mod ground;

pub use ground::Ground;

use crate::{Canonical, Connection, Error, Frame, LieAlgebra, Metric};
use affinor_tensors::{Notation, Tensor};

/// A Lie algebra, or fields on a chart, with a connection and, perhaps, a metric, both given in
/// that frame.
///
/// A connection is not a kind of metric, nor the other way round: M(3) and SO(3) share their
/// algebra and differ in both ([`paper`](crate::paper)).
#[derive(Clone, Debug)]
pub struct Geometry<S> {
    name: String,
    algebra_name: Option<String>,
    ground: Ground<S>,
    connection: Connection<S>,
    kind: ConnectionKind<S>,
    metric: Option<Metric<S>>,
    /// Whether the components are those of the right-invariant frame.
    right: bool,
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
    /// Affinities given one by one, in the frame of the geometry.
    Affinities(Tensor<S>),
}

impl<S: Notation> Geometry<S> {
    /// The geometry with a connection of the given kind.
    ///
    /// # Errors
    /// [`Error::NoMetric`] for Levi-Civita without a metric; [`Error::NotConstant`] for a canonical
    /// connection over structure functions; [`Error::Shape`].
    pub fn new(
        name: impl Into<String>,
        ground: impl Into<Ground<S>>,
        kind: ConnectionKind<S>,
        metric: Option<Metric<S>>,
    ) -> Result<Self, Error> {
        let ground = ground.into();
        let frame = ground.frame();
        let canonical = |lambda: &S| {
            let what = "a connection lambda c";
            ground.algebra_for(what)?;
            if ground.varies(lambda) {
                let (component, value) = ("lambda".into(), lambda.to_string());
                return Err(Error::NotConstant { what, component, value });
            }
            Ok(Connection::over(frame, lambda))
        };
        let connection = match (&kind, &metric) {
            (ConnectionKind::Canonical(which), _) => canonical(&which.lambda())?,
            (ConnectionKind::Family(lambda), _) => canonical(lambda)?,
            (ConnectionKind::LeviCivita, Some(metric)) => Connection::levi_civita(frame, metric)?,
            (ConnectionKind::LeviCivita, None) => return Err(Error::NoMetric),
            (ConnectionKind::Affinities(gamma), _) => {
                Connection::new(frame.clone(), gamma.clone())?
            }
        };
        let (name, algebra_name, right) = (name.into(), None, false);
        Ok(Geometry { name, algebra_name, ground, connection, kind, metric, right })
    }

    /// The same geometry with its components in the right-invariant frame: structure `-c`,
    /// affinities `Lambda - c`. A metric that is not bi-invariant has no constant components
    /// there, and is left out. Taken twice, it is this geometry again.
    ///
    /// # Errors
    /// [`Error::NotInvariant`] for a connection without constant components there;
    /// [`Error::Frame`] over a chart.
    pub fn in_right_frame(&self) -> Result<Self, Error> {
        let Ground::Algebra(algebra) = &self.ground else {
            return Err(Error::Frame(
                "fields on a chart have no right-invariant frame beside them",
            ));
        };
        let connection = self.connection.in_right_frame(algebra)?;
        let metric = self.metric.as_ref().filter(|metric| metric.is_bi_invariant(algebra));
        let kind = match &self.kind {
            ConnectionKind::Affinities(_) => ConnectionKind::Affinities(connection.gamma().clone()),
            kind => kind.clone(),
        };
        Ok(Geometry {
            ground: algebra.opposite().into(),
            connection,
            kind,
            metric: metric.cloned(),
            right: !self.right,
            ..self.clone()
        })
    }

    /// The name of the frame of all components: `left-invariant`, `right-invariant`, and over a
    /// chart `coordinate` or `moving`.
    pub fn frame_name(&self) -> &'static str {
        match self.ground.fields() {
            Some(fields) if fields.are_coordinates() => "coordinate",
            Some(_) => "moving",
            None if self.right => "right-invariant",
            None => "left-invariant",
        }
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

    /// What it stands on.
    pub fn ground(&self) -> &Ground<S> {
        &self.ground
    }

    /// The frame of all components.
    pub fn frame(&self) -> &Frame<S> {
        self.connection.frame()
    }

    /// The Lie algebra; `None` over structure functions.
    pub fn algebra(&self) -> Option<&LieAlgebra<S>> {
        self.ground.algebra()
    }

    /// The connection, in the [`frame`](Self::frame).
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
