//! A motion that is ready to start, with the columns of its rows.

use super::solid::Solid;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation, Opposite};
use affinor::mechanics::simulation::{Method, Motion, Started};
use nalgebra::DMatrix;

/// A motion that is ready to start.
pub struct Ready {
    /// The motion.
    pub motion: Box<dyn Motion>,
    /// The integration method of the motion.
    pub method: Method,
    /// The times of the rows; the first time is the initial time.
    pub times: Vec<f64>,
    /// The columns of the rows.
    pub columns: Vec<Column>,
    /// The name of the column of the time; on a chart, of the parameter of the curve.
    pub parameter: String,
    /// The names of the events. In a row, the values of their event functions follow the values of
    /// the columns.
    pub events: Vec<String>,
    /// The matrix of the metric, for equations of motion with a kinetic energy.
    pub inertia: Option<DMatrix<f64>>,
    /// The factors of the group; empty for a flow of matrices.
    pub factors: Vec<Factor>,
    /// For each factor, the parts of its body without the holes. The list is empty if the bodies
    /// are given by moments of inertia, or by a metric.
    pub solids: Vec<Vec<Solid>>,
    /// Warnings about the problem.
    pub notes: Vec<String>,
}

/// A factor of the group of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    /// The number of the factor, from 1; `None` if there is only one factor.
    pub number: Option<usize>,
    /// The index of the first component of the factor in vectors.
    pub first: usize,
    /// Whether the factor rotates a body. If it does, its elements have a quaternion.
    pub rotates: bool,
}

impl Factor {
    /// The factors of a group; the opposite of a group has the same factors.
    pub(super) fn all(group: &AnyGroup) -> Vec<Self> {
        let factors = factors(group);
        let is_product = factors.len() > 1;
        let mut first = 0;
        let factor = |(at, factor): (usize, &AnyGroup)| {
            let number = is_product.then_some(at + 1);
            let found = Factor { number, first, rotates: factor.names().first() == Some(&"qw") };
            first += factor.dimension();
            found
        };
        factors.into_iter().enumerate().map(factor).collect()
    }
}

/// The factors of a group. The opposite of a group has the same factors and the same elements.
pub(super) fn factors(group: &AnyGroup) -> Vec<&AnyGroup> {
    let opposite = group.downcast_ref::<Opposite<AnyGroup>>();
    opposite.map_or(group, |opposite| &opposite.0).factors()
}

impl Ready {
    /// A motion that has no metric and no warnings.
    pub(super) fn new(
        started: Started,
        times: &[f64],
        columns: Vec<Column>,
        events: Vec<String>,
    ) -> Self {
        let (Started { motion, method }, times) = (started, times.to_vec());
        Ready {
            motion,
            method,
            times,
            columns,
            parameter: "t".into(),
            events,
            inertia: None,
            factors: vec![],
            solids: vec![],
            notes: vec![],
        }
    }
}

/// A column of the rows of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name of the column.
    pub name: String,
    /// The formula of a named quantity or of a Casimir function.
    pub formula: Option<String>,
    /// Whether the summary of a run reports the change of the column.
    pub watched: bool,
    /// Whether the equations and the forces conserve the quantity, as far as this is known.
    pub conserved: bool,
}

/// The quantities that a motion conserves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    /// Whether the energy is conserved.
    pub energy: bool,
    /// Whether the momentum is conserved in the frame that the equations do not use.
    pub momentum: bool,
}

impl Column {
    /// A column without a formula. If it is watched, it is also expected to be conserved.
    pub fn new(name: impl Into<String>, watched: bool) -> Self {
        Column { name: name.into(), formula: None, watched, conserved: watched }
    }
}
