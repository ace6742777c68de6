//! A motion that is ready to start, and the columns of its rows.

use super::solid::Solid;
use affinor::mechanics::simulation::{Method, Motion, Started};
use nalgebra::DMatrix;

/// A motion that is ready to start.
pub struct Ready {
    /// The motion.
    pub motion: Box<dyn Motion>,
    /// Its method of integration.
    pub method: Method,
    /// The times of its rows; the first is the initial time.
    pub times: Vec<f64>,
    /// The columns of its rows.
    pub columns: Vec<Column>,
    /// The names of its events; in a row, their values follow those of the columns.
    pub events: Vec<String>,
    /// The matrix of the metric, for equations of motion with a kinetic energy.
    pub inertia: Option<DMatrix<f64>>,
    /// The factors of its group; none for a flow of matrices.
    pub factors: Vec<Factor>,
    /// Warnings about the problem.
    pub notes: Vec<String>,
}

/// A factor of the group of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Its dimension.
    pub dimension: usize,
    /// The parts of the body that it moves, to be drawn; none for a body by its moments, and of holes.
    pub solids: Vec<Solid>,
}

impl Ready {
    /// A motion without a metric and without warnings.
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
            events,
            inertia: None,
            factors: vec![],
            notes: vec![],
        }
    }
}

/// A column of the rows of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The formula of a named quantity or of a Casimir function.
    pub formula: Option<String>,
    /// Whether its change is reported.
    pub watched: bool,
    /// Whether the equations conserve it, by what is known of the forces.
    pub conserved: bool,
}

/// What a motion conserves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    /// The energy.
    pub energy: bool,
    /// The momentum in the other frame than that of the equations.
    pub momentum: bool,
}

impl Column {
    /// A column without a formula; one that is watched is conserved.
    pub fn new(name: impl Into<String>, watched: bool) -> Self {
        Column { name: name.into(), formula: None, watched, conserved: watched }
    }
}
