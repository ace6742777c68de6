//! Constraints on the joint coordinates and the rates of a tree.

use super::closure::Closure;
use super::contact::Contact;
use super::rows::Rows;
use crate::mechanics::formula::{Gradient, Workspace};
use crate::mechanism::tree::GroundView;
use crate::mechanism::{MovingTree, Tree};

/// A constraint of a tree.
#[derive(Clone, Debug)]
pub enum TreeConstraint {
    /// Two bodies move as one.
    Closure(Closure),
    /// A body rolls or slides on a plane.
    Contact(Contact),
    /// A joint coordinate is a formula in the time.
    Motor(Motor),
    /// A formula in the time and the numbers of the configuration that must vanish.
    Position(Gradient),
    /// A formula in the time, the numbers and the rates that must vanish. It is affine in the rates.
    Velocity(Gradient),
}

/// A motor, which moves a joint coordinate as a formula: `q - f(t) = 0`.
#[derive(Clone, Debug)]
pub struct Motor {
    /// The index of the rate.
    pub rate: usize,
    /// The index of the coordinate among the numbers.
    pub number: usize,
    /// The formula in the time, which is variable 0.
    pub formula: Gradient,
}

/// A state at which constraints are evaluated.
pub(super) struct Place<'s> {
    pub tree: &'s Tree,
    pub view: &'s GroundView,
    pub time: f64,
    pub numbers: &'s [f64],
    pub rates: &'s [f64],
}

impl TreeConstraint {
    /// The number of equations on the rates.
    pub fn count(&self) -> usize {
        match self {
            TreeConstraint::Closure(_) => 6,
            TreeConstraint::Contact(contact) => contact.count(),
            TreeConstraint::Motor(_)
            | TreeConstraint::Position(_)
            | TreeConstraint::Velocity(_) => 1,
        }
    }

    /// Adds the force `-G^T lambda` of this constraint to the loads of the bodies. Formulas act on
    /// joint coordinates, and have no loads.
    pub(super) fn load(&self, view: &GroundView, multipliers: &[f64], moving: &mut MovingTree) {
        match self {
            TreeConstraint::Closure(closure) => closure.load(view, multipliers, moving),
            TreeConstraint::Contact(contact) => contact.load(view, multipliers, moving),
            TreeConstraint::Motor(_)
            | TreeConstraint::Position(_)
            | TreeConstraint::Velocity(_) => {}
        }
    }

    /// The rows of all constraints.
    pub(super) fn rows(list: &[Self], place: &Place, workspace: &mut Workspace) -> Rows {
        let count = list.iter().map(TreeConstraint::count).sum();
        let mut rows = Rows::new(count, place.tree.freedom());
        for constraint in list {
            match constraint {
                TreeConstraint::Closure(closure) => closure.add(place.tree, place.view, &mut rows),
                TreeConstraint::Contact(contact) => contact.add(place.tree, place.view, &mut rows),
                TreeConstraint::Motor(motor) => place.motor(motor, workspace, &mut rows),
                TreeConstraint::Position(formula) => place.position(formula, workspace, &mut rows),
                TreeConstraint::Velocity(formula) => place.velocity(formula, workspace, &mut rows),
            }
        }
        rows.complete()
    }
}

impl Place<'_> {
    /// The time, the numbers and the rates, which are the variables of formulas.
    fn variables(&self) -> Vec<f64> {
        [&[self.time], self.numbers, self.rates].concat()
    }

    /// Appends `q - f(t) = 0`.
    fn motor(&self, motor: &Motor, workspace: &mut Workspace, rows: &mut Rows) {
        let value = motor.formula.evaluate(&[self.time], workspace).0;
        let change = motor.formula.along(&[self.time], &[1.0], workspace).next();
        let (speed, acceleration) = change.map_or((0.0, 0.0), |(_, first, second)| (first, second));
        rows.begin(0.0);
        let row = rows.push(Some(self.numbers[motor.number] - value), speed, -acceleration);
        rows.add(row, motor.rate, 1.0);
    }

    /// Appends a formula in the time and the numbers, `Phi(t, q) = 0`:
    /// `sum dPhi/dq . E v = -dPhi/dt` with the time derivatives `E v` of the numbers.
    fn position(&self, formula: &Gradient, workspace: &mut Workspace, rows: &mut Rows) {
        let variables = self.variables();
        let (value, slopes) = formula.evaluate(&variables, workspace);
        let slopes: Vec<(usize, f64)> = slopes.collect();
        let by_time = slopes.iter().find(|(k, _)| *k == 0).map_or(0.0, |(_, slope)| *slope);
        let speeds = self.speeds();
        let mut bias = 0.0;
        for (k, slope, change) in formula.along(&variables, &speeds, workspace) {
            bias += change * speeds[k] + slope * self.second(k);
        }
        rows.begin(0.0);
        let row = rows.push(Some(value), -by_time, bias);
        let mut gradient = vec![0.0; self.numbers.len()];
        slopes.iter().filter(|(k, _)| *k > 0).for_each(|(k, slope)| gradient[k - 1] = *slope);
        for (rate, number) in self.tree.coordinates() {
            if gradient[number] != 0.0 {
                rows.add(row, rate, gradient[number]);
            }
        }
        for (rate, number) in self.tree.balls() {
            if gradient[number..number + 4].iter().any(|slope| *slope != 0.0) {
                let by_rates = self.tree.along_ball(self.numbers, number, &gradient);
                (0..3).for_each(|k| rows.add(row, rate + k, by_rates[k]));
            }
        }
    }

    /// Appends a formula that is affine in the rates.
    fn velocity(&self, formula: &Gradient, workspace: &mut Workspace, rows: &mut Rows) {
        let variables = self.variables();
        let first = 1 + self.numbers.len();
        let speeds = self.speeds();
        let (value, slopes) = formula.evaluate(&variables, workspace);
        let (mut bias, mut linear) = (0.0, 0.0);
        let mut entries = vec![];
        for (k, slope) in slopes {
            if k < first {
                bias += slope * speeds[k];
            } else {
                linear += slope * self.rates[k - first];
                entries.push((k - first, slope));
            }
        }
        rows.begin(0.0);
        let row = rows.push(None, linear - value, bias);
        entries.into_iter().for_each(|(rate, slope)| rows.add(row, rate, slope));
    }

    /// The time derivatives of all variables, for rates that do not change.
    fn speeds(&self) -> Vec<f64> {
        let mut speeds = vec![0.0; 1 + self.numbers.len() + self.rates.len()];
        speeds[0] = 1.0;
        self.tree.slopes(self.numbers, self.rates, &mut speeds[1..=self.numbers.len()]);
        speeds
    }

    /// The second time derivative of a variable, for rates that do not change: for a unit quaternion
    /// `q` and the angular velocity `w`, `q'' = -|w|^2 q/4`.
    fn second(&self, variable: usize) -> f64 {
        let Some(number) = variable.checked_sub(1) else { return 0.0 };
        let ball = self.tree.balls().find(|(_, first)| (*first..first + 4).contains(&number));
        ball.map_or(0.0, |(rate, _)| {
            let square: f64 = self.rates[rate..rate + 3].iter().map(|w| w * w).sum();
            -0.25 * square * self.numbers[number]
        })
    }
}
