//! Motions of systems of an element and a momentum.

use super::configuration::ConfigurationGroup;
use super::forces::Forces;
use super::observables::{Buffers, Observables, Point};
use super::quantities::{Quantity, Scope};
use super::run::Recorded;
use crate::group::{Coordinates, LieGroup as _};
use crate::mechanics::formula::Formula;
use crate::mechanics::systems::cotangent::{CotangentSystem, State};
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::ops::Range;

/// A system with observables.
pub trait Observed: CotangentSystem<Group: ConfigurationGroup> {
    /// The observables.
    fn observables(&self) -> &Observables<Self::Group>;

    /// The forces, if it may have some.
    fn forces(&self) -> Option<&Forces<Self::Group>>;

    /// Calls a function with the point of a state.
    fn at<R>(&self, state: &State<Self::Group>, look: impl FnOnce(&Point<Self::Group>) -> R) -> R;
}

/// A system with the formulas of its columns.
pub struct OnCotangent<S: CotangentSystem> {
    pub system: S,
    pub columns: (Scope, Vec<Formula>),
    pub buffers: RefCell<(Buffers, [DMatrix<f64>; 2])>,
}

impl<S: CotangentSystem> OnCotangent<S> {
    /// The system with its columns.
    pub fn new(system: S, columns: (Scope, Vec<Formula>)) -> Self {
        let n = system.group().dimension();
        let square = || DMatrix::zeros(n, n);
        let buffers = RefCell::new((Buffers::default(), [square(), square()]));
        OnCotangent { system, columns, buffers }
    }
}

impl<S: Observed + Send> Recorded for OnCotangent<S> {
    type System = S;

    fn system(&self) -> &S {
        &self.system
    }

    fn set_time(state: &mut State<S::Group>, time: f64) {
        state.time = time;
    }

    fn fits(&self, state: &State<S::Group>, _: &State<S::Group>) -> bool {
        let group = self.system.group();
        state.spatial.components().len() == group.dimension() && group.has_shape(&state.element)
    }

    fn width(&self) -> usize {
        self.columns.1.len()
    }

    fn values(&self, state: &State<S::Group>, columns: Range<usize>, list: &mut Vec<f64>) {
        let (buffers, _) = &mut *self.buffers.borrow_mut();
        self.system.at(state, |point| {
            let load = |quantity| match (quantity, self.system.forces()) {
                (Quantity::Potential, Some(forces)) => forces.potential(point),
                (Quantity::Power, Some(forces)) => forces.power(point),
                _ => 0.0,
            };
            let observables = self.system.observables();
            observables.formulas(&self.columns, columns, (point, &load), buffers, list);
        });
    }

    /// The spectral radius of `ad_Omega`.
    fn rate(&self, state: &State<S::Group>) -> f64 {
        let group = self.system.group();
        let velocity = self.system.velocity_of(&state.momentum(group));
        let (_, [matrix, power]) = &mut *self.buffers.borrow_mut();
        for (k, mut column) in matrix.column_iter_mut().enumerate() {
            column.copy_from_slice(group.bracket(&velocity, &group.unit(k)).components());
        }
        spectral_radius(matrix, power)
    }

    fn pause(&self, from: f64, until: f64) -> f64 {
        self.system.forces().map_or(until, |forces| forces.pause(from, until))
    }

    fn trouble(&self) -> Option<String> {
        self.system.observables().trouble()
    }
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
