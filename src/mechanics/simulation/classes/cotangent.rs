//! Motions of systems of an element and a momentum. This code is common to free, forced and
//! Lie-Poisson systems.

use crate::Error;
use crate::group::{Coordinates, Embedded as _, LieGroup};
use crate::mechanics::Adaptive;
use crate::mechanics::simulation::forces::ForcesOn;
use crate::mechanics::simulation::group::SimulationGroup;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::ObservedMotion;
use crate::mechanics::simulation::observables::{
    Buffers, ColumnFormulas, Observables, ObservationPoint,
};
use crate::mechanics::simulation::quantities::MotionQuantity;
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::systems::cotangent::{CotangentSystem, State};
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::ops::Range;

/// A system with observables.
pub(super) trait ObservedSystem:
    CotangentSystem<Group: SimulationGroup> + Send + 'static
{
    /// The observables.
    fn observables(&self) -> &Observables;

    /// The forces; `None` if the system cannot have forces.
    fn forces(&self) -> Option<&ForcesOn<Self::Group>> {
        None
    }

    /// Calls a function with the observation point of a state.
    fn at<R>(
        &self,
        state: &State<Self::Group>,
        look: impl FnOnce(&ObservationPoint<Self::Group>) -> R,
    ) -> R;
}

/// A system, with the formulas of its columns.
pub(super) struct CotangentMotion<S> {
    system: S,
    columns: ColumnFormulas,
    buffers: RefCell<Buffers>,
    /// Buffers for the computation of the spectral radius of `ad_Omega`.
    matrices: RefCell<[DMatrix<f64>; 2]>,
}

impl<S: ObservedSystem> CotangentMotion<S> {
    pub(super) fn new(system: S, columns: ColumnFormulas) -> Self {
        let n = system.group().dimension();
        let matrices = RefCell::new([DMatrix::zeros(n, n), DMatrix::zeros(n, n)]);
        CotangentMotion { system, columns, buffers: RefCell::default(), matrices }
    }
}

impl<S: ObservedSystem> ObservedMotion for CotangentMotion<S> {
    type System = S;

    fn system(&self) -> &S {
        &self.system
    }

    fn set_time(&self, state: &mut State<S::Group>, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len()
    }

    fn values(&self, state: &State<S::Group>, range: Range<usize>, list: &mut Vec<f64>) {
        let system = &self.system;
        system.at(state, |point| {
            let load = |quantity| match (quantity, system.forces()) {
                (MotionQuantity::Potential, Some(forces)) => forces.potential(point),
                (MotionQuantity::Power, Some(forces)) => forces.power(point),
                _ => 0.0,
            };
            let (observables, buffers) = (system.observables(), &mut *self.buffers.borrow_mut());
            self.columns.values(range, system.group(), observables, point, &load, buffers, list);
        });
    }

    /// The spectral radius of `ad_Omega`.
    fn rate(&self, state: &State<S::Group>) -> f64 {
        let group = self.system.group();
        let velocity = self.system.velocity_of(&state.momentum(group));
        let [matrix, power] = &mut *self.matrices.borrow_mut();
        adjoint_operator(group, &velocity, matrix);
        spectral_radius(matrix, power)
    }

    fn begin_step(&self, from: f64, until: f64) -> f64 {
        self.system.forces().map_or(until, |on| on.forces.begin_step(from, until))
    }

    fn take_trouble(&self) -> Option<String> {
        self.system.observables().take_trouble()
    }
}

/// The groups with projection methods, as text for messages.
const NO_PROJECTION: &str = "it is for left-invariant systems on groups in closed form, such as so(2), so(3), se(2), se(3) and sl(2)";

/// The stepper of a method that integrates systems with any group and any forces. Returns `None`
/// for methods of other classes.
///
/// # Errors
/// [`Error::Unsupported`] if a projection method is used on a group without a projection.
pub(super) fn any_system<S: CotangentSystem<Group: SimulationGroup> + 'static>(
    group: &S::Group,
    method: Method,
    step: f64,
    control: Adaptive,
) -> Result<Option<Stepper<S>>, Error> {
    let projects = group.has_projection() && !group.is_right();
    if method.class() == Class::Projection && !projects {
        return Err(method.refused(NO_PROJECTION));
    }
    Ok(method.any_system(step, control))
}

/// Replaces a matrix by the matrix of `ad_Omega`.
fn adjoint_operator<G: LieGroup>(group: &G, velocity: &G::Vector, matrix: &mut DMatrix<f64>) {
    for (k, mut column) in matrix.column_iter_mut().enumerate() {
        let image = group.bracket(velocity, &group.basis_vector(k));
        column.copy_from_slice(image.components());
    }
}

/// The spectral radius of `ad_Omega`.
pub(super) fn spectral_radius_of<G: LieGroup>(group: &G, velocity: &G::Vector) -> f64 {
    let n = group.dimension();
    let (mut matrix, mut power) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    adjoint_operator(group, velocity, &mut matrix);
    spectral_radius(&mut matrix, &mut power)
}

/// The spectral radius, computed by Gelfand's formula `|A^k|^(1/k)`. The result is an upper bound
/// that is nearly sharp, and 0 for a nilpotent matrix. Both matrices are overwritten.
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
