//! Initial states that satisfy the constraints.

use super::reduction::Reduction;
use super::rows::Rows;
use super::{ITERATIONS, NEAR, STILL, TreeState, TreeSystem};
use crate::mechanism::tree::MassFactor;
use nalgebra::DVector;

/// A constraint that cannot be satisfied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unsatisfied {
    /// The index of the constraint.
    pub constraint: usize,
    /// The violation that remains.
    pub violation: f64,
    /// The part of the state that violates the constraint.
    pub by: Violator,
}

/// The part of a state that violates a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Violator {
    /// The coordinates.
    Coordinates,
    /// The rates.
    Rates,
    /// No accelerations satisfy the constraints. At a singular position, the rates satisfy them to
    /// first order only; or the constraints contradict each other.
    Accelerations,
}

/// How an initial value is held while a tree is assembled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// The value follows from others.
    Free,
    /// The value changes by as little as possible, because it may be rounded.
    Near,
    /// The value does not change.
    Fixed,
}

impl Hold {
    /// The weight of a change of the value.
    fn weight(self) -> f64 {
        if self == Hold::Near { HEAVY } else { 1.0 }
    }
}

/// The weight of a change of a value that may be rounded.
const HEAVY: f64 = 1e8;

/// The longest change of a coordinate in one iteration of an assembly, in its unit.
const LONGEST: f64 = 0.5;

/// The largest violation of a constraint on the rates that counts as a rounding error, relative to
/// the size of its terms.
const CONSISTENT: f64 = 1e-9;

/// The largest violation of a constraint by the accelerations that counts as a rounding error,
/// relative to its terms.
const BRANCH: f64 = 1e-5;

impl TreeSystem {
    /// Assembles the tree: changes the coordinates and the rates until they satisfy the constraints, by
    /// as little as possible. The parameter `held` tells for each rate how its coordinate and the rate
    /// itself are held. Returns the change of each coordinate and rate, in the units of
    /// [`Tree::units`](crate::mechanism::Tree::units).
    ///
    /// # Errors
    /// The constraint whose violation remains the largest.
    pub fn assemble(
        &self,
        state: &mut TreeState,
        held: &[[Hold; 2]],
    ) -> Result<Vec<[f64; 2]>, Unsatisfied> {
        let split = state.numbers.len() - self.tree.freedom();
        self.tree.normalize(&mut state.numbers.as_mut_slice()[..split]);
        let units: Vec<f64> = self.tree.units().collect();
        let metrics = [0, 1].map(|which| {
            let weights =
                held.iter().zip(&units).map(|(held, unit)| held[which].weight() / (unit * unit));
            DVector::from_iterator(units.len(), weights)
        });
        let metric = |which: usize| MassFactor::diagonal(metrics[which].iter().copied());
        let mut buffers = self.buffers.borrow_mut();
        let free =
            |rows: &Rows, which: usize| rows.without(|rate| held[rate][which] == Hold::Fixed);
        let (mut moved, mut last) = (vec![0.0; units.len()], f64::INFINITY);
        for _ in 0..ITERATIONS {
            let rows = self.rows(state.time, state.numbers.as_slice(), &mut buffers);
            let reduction = Reduction::new(metric(0), &free(&rows, 0));
            let Some(reduction) = reduction else { break };
            // values that are rounded return to their initial values
            let back = moved.iter().zip(held).map(|(moved, held)| match held[0] {
                Hold::Near => -moved,
                _ => 0.0,
            });
            let back = metrics[0].component_mul(&DVector::from_iterator(units.len(), back));
            let change = reduction.nearest(&back, &rows.missing());
            let size = self.tree.largest(&change);
            if size <= STILL || (size > 0.9 * last && last <= NEAR) {
                break;
            }
            // a long way may lead past the nearest closed position
            let share = if size > LONGEST { LONGEST / size } else { 1.0 };
            let change = change * share;
            moved.iter_mut().zip(change.iter()).for_each(|(sum, x)| *sum += x);
            let numbers = &mut state.numbers.as_mut_slice()[..split];
            self.tree.displace(numbers, change.as_slice());
            last = size;
        }
        self.tree.normalize(&mut state.numbers.as_mut_slice()[..split]);
        let rows = self.rows(state.time, state.numbers.as_slice(), &mut buffers);
        let sizes = rows.sizes(&units);
        let values = rows.values.iter().map(|value| value.unwrap_or(0.0));
        self.expect(Violator::Coordinates, values, |row| NEAR * sizes[row])?;
        let rates = state.numbers.rows(split, units.len()).into_owned();
        let free = free(&rows, 1);
        let Some(reduction) = Reduction::new(metric(1), &free) else {
            let by = Violator::Rates;
            return Err(Unsatisfied { constraint: 0, violation: f64::NAN, by });
        };
        let found = &rates + reduction.shortest(&-rows.residual(&rates));
        state.numbers.rows_mut(split, units.len()).copy_from(&found);
        let residual = rows.residual(&found);
        let fastest = self.tree.largest(&found);
        let size = |row: usize| CONSISTENT * (sizes[row] * fastest).max(rows.right[row].abs());
        self.expect(Violator::Rates, residual.iter().copied(), size)?;
        // accelerations exist on each branch of the motion
        let settled = self.settled(state.time, &state.numbers, &mut buffers);
        if let Ok(settled) = settled {
            let (rows, accelerations) = (&settled.rows, settled.accelerations());
            let residual = rows.product(&accelerations) + &rows.bias;
            // without constraints, the accelerations may be larger, and have larger rounding errors
            let unbound = CONSISTENT * self.tree.largest(&settled.unbound());
            let bend = self.tree.largest(&accelerations) + fastest * fastest;
            let size =
                |row: usize| sizes[row] * (BRANCH * bend + unbound) + BRANCH * rows.bias[row].abs();
            self.expect(Violator::Accelerations, residual.iter().copied(), size)?;
        }
        let changes = found - rates;
        let changes = moved.iter().zip(&changes).zip(&units);
        Ok(changes.map(|((x, v), unit)| [x, v].map(|change| (change / unit).abs())).collect())
    }

    /// Checks that the violations of all rows are at most the allowed ones.
    fn expect(
        &self,
        by: Violator,
        violations: impl Iterator<Item = f64>,
        allowed: impl Fn(usize) -> f64,
    ) -> Result<(), Unsatisfied> {
        let counts = self.constraints.iter().enumerate();
        let of_row: Vec<usize> =
            counts.flat_map(|(at, own)| std::iter::repeat_n(at, own.count())).collect();
        let mut worst: Option<Unsatisfied> = None;
        for (row, violation) in violations.enumerate() {
            let violation = violation.abs();
            let is_worse = worst.is_none_or(|worst| violation > worst.violation);
            if (violation > allowed(row) || violation.is_nan()) && is_worse {
                worst = Some(Unsatisfied { constraint: of_row[row], violation, by });
            }
        }
        worst.map_or(Ok(()), Err)
    }
}
