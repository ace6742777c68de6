//! Step-size control for trees of bodies in joint coordinates.

use super::Adaptive;
use crate::Error;
use crate::mechanics::stopped;
use crate::mechanics::systems::tree::{TreeState, TreeSystem};
use crate::numerics::ode::{LEAST_STEP, stages};
use crate::numerics::radau::{Radau, jacobian};
use crate::numerics::tableaux::combined_error;
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};

/// A scheme for a step of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeScheme {
    /// The explicit method of order 8 of Dormand and Prince.
    DormandPrince,
    /// The implicit method Radau IIA of order 5, for stiff springs and dampers. It is L-stable.
    Radau,
}

/// Steps of trees of bodies with step-size control. After each step, the state is projected onto the
/// constraints. So the error of a step is its part along the constraints, and a tenth of the other
/// part. Near singular positions, rounding errors across the constraints are large. If some shorter
/// steps do not avoid such a position, the other part counts with the factor `r^(1/4)`.
///
/// Let `r` be the tolerance. The error of an angle is at most `r`, or `r/10` of its change in the
/// step if this is larger. The error of a translation is compared to the same multiple of the
/// [`length`](crate::mechanism::Tree::length) of the tree. The error of a rate is at most `r` of the
/// fastest rate, in the same units. So steps do not depend on the units or on the ground frame.
/// [`Adaptive::absolute`] replaces the absolute errors of angles and of translations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeSteps {
    /// The scheme.
    pub scheme: TreeScheme,
    /// The tolerances and bounds.
    pub control: Adaptive,
}

/// A step that was tried: its end on the constraints, and the parts of its error along and across the
/// constraints, in units of the allowed error.
struct Tried {
    end: DVector<f64>,
    along: f64,
    across: f64,
}

/// The part of the error across the constraints that counts in the first tries of a step.
const ACROSS: f64 = 0.1;
/// The number of these tries.
const TRIES: usize = 12;
/// A step is shortened by this factor if a stage may be near a singular position. Much shorter steps
/// would lead to it.
const ASIDE: f64 = 0.83;

/// Newton's method stops at this multiple of the allowed error.
const NEWTON: f64 = 1e-3;

impl TreeSteps {
    /// The first step size to try from a state.
    pub(crate) fn first_step(&self, system: &TreeSystem, state: &TreeState) -> f64 {
        let Adaptive { tolerance, span, max_step, .. } = self.control;
        let slope = system.slope(state.time, &state.numbers);
        let accelerations = &slope.as_slice()[slope.len() - system.tree().freedom()..];
        let bends =
            system.tree().units().zip(accelerations).map(|(unit, a)| (a.abs() / unit).sqrt());
        let fastest = bends.fold(system.rate(state), f64::max);
        let longest = if span.is_finite() { span } else { 1.0 };
        let guess = tolerance.powf(0.125) / fastest;
        if guess > 0.0 { guess.min(longest).min(max_step) } else { longest.min(max_step) }
    }

    /// Makes one accepted step from a state towards `end`; see [`Adaptive::step`].
    ///
    /// # Errors
    /// [`Error::Integration`] if steps become too small, or if the end is not finite.
    pub fn step(
        &self,
        system: &TreeSystem,
        state: &mut TreeState,
        next: &mut f64,
        end: f64,
    ) -> Result<(), Error> {
        if !end.is_finite() {
            return Err(stopped(state.time, format!("the end is {end}, which is not finite")));
        }
        let units: Vec<f64> = system.tree().units().collect();
        let slope = system.slope(state.time, &state.numbers);
        let (mut matrix, mut tries) = (None, 0);
        loop {
            checkpoint();
            tries += 1;
            let left = end - state.time;
            *next = next.min(self.control.max_step);
            let last = *next >= left.abs();
            let h = if last { left } else { next.copysign(left) };
            let is_lost = state.time + h == state.time;
            let is_rounding = !last && h.abs() < LEAST_STEP * state.time.abs();
            if !h.is_finite() || is_lost || is_rounding || *next == 0.0 {
                return Err(stopped(state.time, "the steps become too small"));
            }
            // tries a shorter step, which may still succeed
            let Some(Tried { end: reached, along, across }) =
                self.tried(system, &units, state, &slope, h, &mut matrix)
            else {
                *next = 0.2 * h.abs();
                continue;
            };
            let least = self.control.tolerance.powf(0.25).min(ACROSS);
            let counted = if tries <= TRIES { ACROSS } else { least };
            let error = along.max(counted * across);
            if !last || error > 1.0 {
                let exponent = match self.scheme {
                    TreeScheme::DormandPrince => -0.125,
                    TreeScheme::Radau => -0.25,
                };
                let is_near = error > 1.0 && tries <= TRIES && across > along / ACROSS;
                let factor =
                    if is_near { ASIDE } else { (0.9 * error.powf(exponent)).clamp(0.2, 5.0) };
                *next = h.abs() * factor;
            }
            if error <= 1.0 {
                let time = if last { end } else { state.time + h };
                *state = TreeState { time, numbers: reached };
                return Ok(());
            }
        }
    }

    /// Tries a step. The Jacobian matrix of an implicit scheme is computed once for all tries. Returns
    /// `None` if an implicit scheme does not converge, or if the end is not finite or too far from
    /// the constraints.
    fn tried(
        &self,
        system: &TreeSystem,
        units: &[f64],
        state: &TreeState,
        slope: &DVector<f64>,
        h: f64,
        matrix: &mut Option<DMatrix<f64>>,
    ) -> Option<Tried> {
        let f = |time: f64, y: &DVector<f64>| system.slope(time, y);
        let (time, y) = (state.time, &state.numbers);
        let (end, errors) = match self.scheme {
            TreeScheme::DormandPrince => {
                let (end, errors) = stages(&f, time, y, slope, h);
                (end, errors.to_vec())
            }
            TreeScheme::Radau => {
                let matrix =
                    matrix.get_or_insert_with(|| jacobian(&f, time, y, &self.sizes(system, y)));
                let is_small = |change: &DVector<f64>| {
                    self.ratio(system, units, [y, y], &parts(system, y, change), h) <= NEWTON
                };
                let (end, error) = Radau::new(matrix, h).step(&f, (time, y, slope), is_small)?;
                (end, vec![error])
            }
        };
        if !end.iter().all(|value| value.is_finite()) {
            return None;
        }
        let whole: Vec<_> = errors.iter().map(|error| parts(system, &end, error)).collect();
        let mut along = whole.clone();
        let end = system.projected(time + h, &end, &mut along).ok()?;
        let ratio = |error: &[DVector<f64>; 2]| self.ratio(system, units, [y, &end], error, h);
        let combined = |list: &[[DVector<f64>; 2]]| match list {
            [fifth, third] => combined_error([ratio(fifth), ratio(third)]),
            _ => list.iter().map(ratio).fold(0.0, f64::max),
        };
        let [along, across] = [combined(&along), combined(&whole)];
        (along.is_finite() && across.is_finite()).then_some(Tried { end, along, across })
    }

    /// The units of the numbers and the rates.
    fn sizes(&self, system: &TreeSystem, y: &DVector<f64>) -> DVector<f64> {
        let (tree, mut sizes) = (system.tree(), DVector::repeat(y.len(), 1.0));
        let split = y.len() - tree.freedom();
        for (rate, unit) in tree.units().enumerate() {
            sizes[split + rate] = unit;
        }
        for (rate, number) in tree.coordinates() {
            sizes[number] = sizes[split + rate];
        }
        sizes
    }

    /// The error in units of the allowed error, from the numbers at both ends of the step, and the
    /// errors of the coordinates and of the rates.
    fn ratio(
        &self,
        system: &TreeSystem,
        units: &[f64],
        [start, end]: [&DVector<f64>; 2],
        [of_coordinates, of_rates]: &[DVector<f64>; 2],
        h: f64,
    ) -> f64 {
        let Adaptive { tolerance, absolute, span, .. } = self.control;
        let (tree, split) = (system.tree(), start.len() - units.len());
        let length = tree.length();
        let [of_angles, of_lengths] = absolute.unwrap_or([tolerance, tolerance * length]);
        let floor = |rate: usize| if tree.is_angular(rate) { of_angles } else { of_lengths };
        let speed = |rate: usize| {
            let at = split + rate;
            start[at].abs().max(end[at].abs())
        };
        let fastest = units.iter().enumerate().map(|(k, unit)| speed(k) / unit);
        let fastest = fastest.fold(0.0, f64::max);
        // a NaN must remain, so that the step is rejected
        let mut most = 0.0;
        let mut add = |error: f64, allowed: f64| {
            let ratio = if error == 0.0 { 0.0 } else { error.abs() / allowed };
            if ratio > most || ratio.is_nan() {
                most = ratio;
            }
        };
        for (rate, _) in tree.coordinates() {
            let path = 0.1 * tolerance * (h * speed(rate)).abs();
            add(of_coordinates[rate], floor(rate).max(path));
        }
        for (first, _) in tree.balls() {
            (first..first + 3).for_each(|rate| add(of_coordinates[rate], of_angles));
        }
        for (k, unit) in units.iter().enumerate() {
            let allowed = (tolerance * unit * fastest).max(floor(k) / span);
            add(of_rates[k], allowed.max(f64::MIN_POSITIVE));
        }
        most
    }
}

/// The parts of a small change of the numbers and rates: of the coordinates, and of the rates.
fn parts(system: &TreeSystem, y: &DVector<f64>, change: &DVector<f64>) -> [DVector<f64>; 2] {
    let tree = system.tree();
    let split = y.len() - tree.freedom();
    let displacement = tree.displacement(y.as_slice(), change.as_slice());
    [displacement, change.rows_range(split..).into_owned()]
}
