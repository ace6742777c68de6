//! The linear equations of problems in joint coordinates.

use super::{OnTree, Start};
use crate::input::InputError;
use crate::problem::integrator::Member;
use affinor::mechanics::systems::tree::Linearization;

/// The linear equations of a problem in joint coordinates.
#[derive(Clone, Debug)]
pub struct LinearProblem {
    /// The linear equations.
    pub linear: Linearization,
    /// Whether the state is an equilibrium. Otherwise it is a steady motion.
    pub is_at_rest: bool,
    /// The names of the coordinates.
    pub coordinates: Vec<String>,
    /// The names of the rates.
    pub rates: Vec<String>,
    /// The values of the coordinates and the rates.
    pub state: Vec<f64>,
    /// Notes on the initial state.
    pub notes: Vec<String>,
}

impl OnTree {
    /// The linear equations at the initial state. If it is at rest, they are those of the equilibrium
    /// near it.
    pub fn linearized(&self, member: &Member) -> Result<LinearProblem, InputError> {
        let Start { system, mut state, names, notes } = self.start(member)?;
        let refused = |error: affinor::Error| InputError::from(error).or_at(&self.place);
        let [numbers, freedom] = names.sizes;
        let is_at_rest = state.numbers.rows_range(numbers..).iter().all(|rate| *rate == 0.0);
        if is_at_rest {
            let help = "change the initial coordinates";
            state = system.equilibrium(&state).map_err(|error| refused(error).help(help))?;
        }
        let help = "give the coordinates and the rates of a steady motion";
        let linear = system.linearized(&state).map_err(|error| refused(error).help(help))?;
        let list = |first: usize, count: usize| names.list(first..first + count).to_vec();
        Ok(LinearProblem {
            linear,
            is_at_rest,
            coordinates: list(1, numbers),
            rates: list(1 + numbers, freedom),
            state: state.numbers.as_slice().to_vec(),
            notes,
        })
    }
}
