//! Curves on homogeneous spaces G/H: autoparallels of invariant connections, with parallel vectors.

use super::cotangent::{any_system, spectral_radius_of};
use crate::Error;
use crate::group::{AnyGroup, MatrixNotation};
use crate::mechanics::formula::{Formula, Workspace};
use crate::mechanics::simulation::integration::Integration;
use crate::mechanics::simulation::methods::{Class, Method};
use crate::mechanics::simulation::motion::{ObservedMotion, Started, simulation};
use crate::mechanics::simulation::quantities::MotionQuantity;
use crate::mechanics::{CotangentSystem, State, systems::HomogeneousSystem};
use nalgebra::DVector;
use std::cell::RefCell;
use std::ops::Range;

/// The specification of a curve on a homogeneous space.
pub struct HomogeneousSpec {
    /// The equations.
    pub system: HomogeneousSystem,
    /// The initial time.
    pub time: f64,
    /// The embedding coordinates of the initial element of G.
    pub element: DVector<f64>,
    /// The initial velocity in the complement.
    pub velocity: DVector<f64>,
    /// The initial values of the parallel vectors, in the complement.
    pub vectors: Vec<DVector<f64>>,
    /// The method and its settings. The default is `rkmk4` if there is a step size; otherwise it is
    /// a method with step-size control.
    pub integration: Integration,
    /// The columns.
    pub columns: HomogeneousColumns,
}

/// The columns of a curve on a homogeneous space, as formulas in its quantities.
///
/// The quantities are the time, the components of the velocity `v`, the square `J(v, v)` and the
/// energy `J(v, v)/2`. After them come the spatial momentum, the components of all parallel vectors
/// `u`, their squares `J(u, u)`, and the coordinates of the element.
#[derive(Clone, Debug, Default)]
pub struct HomogeneousColumns {
    /// The coordinates of the element that formulas use: entries and named coordinates.
    pub element: Vec<MotionQuantity>,
    /// The formulas of the columns.
    pub formulas: Vec<Formula>,
}

impl HomogeneousSpec {
    /// Starts the motion.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the method belongs to another class.
    pub fn start(self) -> Result<Started, Error> {
        let Integration { method, step, control } = self.integration;
        let default =
            if step.is_some() { Method::MuntheKaas4 } else { Method::to(control.tolerance) };
        let method = method.unwrap_or(default);
        let step = self.integration.step_of(method)?;
        // vectors of the size of the momentum, so that one tolerance fits both; a power of two
        // avoids rounding errors
        let momentum = self.system.state(self.time, &self.element, &self.velocity, &[]).spatial;
        let scale = |u: &DVector<f64>| match momentum.amax() / u.amax() {
            ratio if ratio > 0.0 && ratio.is_finite() => ratio.log2().round().exp2(),
            _ => 1.0,
        };
        let scales: Vec<f64> = self.vectors.iter().map(scale).collect();
        let scaled: Vec<_> =
            self.vectors.iter().zip(&scales).map(|(u, scale)| u * *scale).collect();
        let state = self.system.state(self.time, &self.element, &self.velocity, &scaled);
        let stepper = any_system(self.system.group(), method, step, control)?.ok_or_else(|| {
            let names = Method::names_of(&[Class::AnySystem]);
            method.refused(&format!("curves on a homogeneous space need one of {names}"))
        })?;
        let curve = Curve {
            system: self.system,
            scales,
            columns: self.columns,
            buffers: RefCell::default(),
        };
        Ok(Started { motion: simulation(curve, state, stepper), method })
    }
}

/// The motion, with the values of its columns.
struct Curve {
    system: HomogeneousSystem,
    /// The factors by which the parallel vectors are multiplied in the state.
    scales: Vec<f64>,
    columns: HomogeneousColumns,
    buffers: RefCell<(Vec<f64>, Workspace)>,
}

impl Curve {
    /// Replaces `values` by the quantities at a state.
    fn quantities(&self, state: &State<AnyGroup>, values: &mut Vec<f64>) {
        let system = &self.system;
        let velocity = system.velocity(state);
        values.clear();
        values.push(state.time);
        values.extend(velocity.iter());
        let norm = system.product(&velocity, &velocity);
        values.extend([norm, 0.5 * norm]);
        values.extend(system.spatial_momentum(state).iter());
        let vectors = self.scales.iter().enumerate();
        let vectors: Vec<_> =
            vectors.map(|(at, scale)| system.vector(state, at) / *scale).collect();
        values.extend(vectors.iter().flatten());
        values.extend(vectors.iter().map(|u| system.product(u, u)));
        let element = system.element(state);
        let is_entry = |quantity: &MotionQuantity| matches!(quantity, MotionQuantity::Entry(..));
        let matrix = self.columns.element.iter().any(is_entry).then(|| {
            let group = system.base();
            group.write(&element)
        });
        values.extend(self.columns.element.iter().map(|quantity| match (quantity, &matrix) {
            (MotionQuantity::Entry(row, column), Some(matrix)) => matrix[(*row, *column)],
            (MotionQuantity::Named(k), _) => system.base().named(&element, *k),
            _ => f64::NAN,
        }));
    }
}

impl ObservedMotion for Curve {
    type System = HomogeneousSystem;

    fn system(&self) -> &HomogeneousSystem {
        &self.system
    }

    fn set_time(&self, state: &mut State<AnyGroup>, time: f64) {
        state.time = time;
    }

    fn column_count(&self) -> usize {
        self.columns.formulas.len()
    }

    fn values(&self, state: &State<AnyGroup>, columns: Range<usize>, list: &mut Vec<f64>) {
        let (values, workspace) = &mut *self.buffers.borrow_mut();
        self.quantities(state, values);
        let formulas = &self.columns.formulas[columns];
        list.extend(formulas.iter().map(|formula| formula.value_in(values, workspace)));
    }

    fn rate(&self, state: &State<AnyGroup>) -> f64 {
        let group = self.system.group();
        let velocity = self.system.velocity_of(&state.momentum(group));
        spectral_radius_of(group, &velocity)
    }
}
