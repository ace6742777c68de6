//! Motions of systems of an element and a momentum.

use super::drive::Drive;
use super::forces::Forces;
use super::observables::{Buffers, Observables, Point};
use super::quantities::{Quantity, Scope};
use super::run::{Recorded, Run};
use super::{Motion, SimulationGroup};
use crate::group::{Coordinates, LieGroup as _};
use crate::mechanics::formula::Formula;
use crate::mechanics::systems::cotangent::{CotangentSystem, State};
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::ops::Range;

/// A system with observables.
pub trait Observed: CotangentSystem<Group: SimulationGroup> {
    /// The observables.
    fn observables(&self) -> &Observables<Self::Group>;

    /// The forces, if it may have some.
    fn forces(&self) -> Option<&Forces<Self::Group>>;

    /// Calls a function with the point of a state.
    fn at<R>(&self, state: &State<Self::Group>, look: impl FnOnce(&Point<Self::Group>) -> R) -> R;
}

/// The motion of a system from a state, with the formulas of its columns.
pub fn on_cotangent<S: Observed<Group: SimulationGroup> + Send + 'static>(
    system: S,
    state: State<S::Group>,
    drive: Drive<S>,
    columns: (Scope, Vec<Formula>),
) -> Box<dyn Motion> {
    let (n, width) = (system.group().dimension(), columns.1.len());
    let buffers = RefCell::new(Buffers::default());
    let values = move |system: &S, state: &_, range: Range<usize>, list: &mut Vec<f64>| {
        system.at(state, |point| {
            let load = |quantity| match (quantity, system.forces()) {
                (Quantity::Potential, Some(forces)) => forces.potential(point),
                (Quantity::Power, Some(forces)) => forces.power(point),
                _ => 0.0,
            };
            let (observables, buffers) = (system.observables(), &mut *buffers.borrow_mut());
            observables.formulas(&columns, range, (point, &load), buffers, list);
        });
    };
    let fits = |system: &S, state: &State<S::Group>, _: &_| {
        let group = system.group();
        state.spatial.components().len() == group.dimension() && group.has_shape(&state.element)
    };
    let mut recorded = Recorded::new(system, |state| &mut state.time, fits, width, values);
    let matrices = RefCell::new([DMatrix::zeros(n, n), DMatrix::zeros(n, n)]);
    // the spectral radius of ad_Omega
    recorded.rate = Box::new(move |system, state| {
        let group = system.group();
        let velocity = system.velocity_of(&state.momentum(group));
        let [matrix, power] = &mut *matrices.borrow_mut();
        for (k, mut column) in matrix.column_iter_mut().enumerate() {
            column.copy_from_slice(group.bracket(&velocity, &group.unit(k)).components());
        }
        spectral_radius(matrix, power)
    });
    recorded.pause =
        |system, from, until| system.forces().map_or(until, |forces| forces.pause(from, until));
    recorded.trouble = |system| system.observables().trouble();
    Run::boxed(recorded, state, drive)
}

/// The largest `|lambda|` of an eigenvalue, by Gelfand's `|A^k|^(1/k)`: not much above, and 0 for a nilpotent matrix. Both
/// matrices are overwritten.
fn spectral_radius(matrix: &mut DMatrix<f64>, power: &mut DMatrix<f64>) -> f64 {
    let size = matrix.norm();
    if size == 0.0 || !size.is_finite() {
        return 0.0;
    }
    *matrix /= size;
    for _ in 0..2 {
        power.gemm(1.0, matrix, matrix, 0.0);
        matrix.gemm(1.0, power, power, 0.0);
    }
    size * matrix.norm().powf(1.0 / 16.0)
}
