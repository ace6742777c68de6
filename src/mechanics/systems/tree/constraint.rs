//! Constraints on the joint coordinates and the rates of a tree.

use super::contact::Contact;
use crate::mechanics::formula::{Gradient, Workspace};
use crate::mechanism::tree::{BodyPoint, GroundView};
use crate::mechanism::{MovingTree, Tree};
use nalgebra::{DMatrix, DVector, Vector3};

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

/// The equations of two bodies that move as one, because a loop was [cut](crate::mechanism::Cut)
/// there.
///
/// With the attitudes `R_a`, `R_b` and the positions `x_a`, `x_b` of one point in both bodies, the
/// six equations are
///
/// ```text
/// 2 l vec(R_a R_b^T) = 0,   x_a - x_b = 0
/// ```
///
/// where `vec` is the vector part of the quaternion with a positive real part, and `l` is the
/// [length](Tree::length) of the tree. Their derivatives with respect to the time are the differences
/// of the angular velocities, times `l`, and of the velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    points: [BodyPoint; 2],
}

impl Closure {
    /// The equations of a body and its copy.
    ///
    /// # Panics
    /// Panics if a body does not exist.
    pub fn new(tree: &Tree, [body, copy]: [usize; 2]) -> Self {
        let first = tree.origin(body);
        Closure { points: [first, tree.point(copy, &tree.at_home(&first))] }
    }

    fn add(&self, tree: &Tree, view: &GroundView, rows: &mut Rows) {
        let [a, b] = self.points.map(|point| view.motion(&point));
        let [turn_a, turn_b] = self.points.map(|point| view.attitude(&point));
        let turn = turn_a * turn_b.inverse();
        let angle = turn.imag() * (2.0_f64).copysign(turn.w);
        let length = tree.length();
        let values = [angle * length, a.position - b.position];
        let biases = [(a.spin_rate - b.spin_rate) * length, a.acceleration - b.acceleration];
        let first = rows.begin();
        for (value, bias) in values.iter().zip(&biases) {
            for i in 0..3 {
                rows.push(Some(value[i]), 0.0, bias[i]);
            }
        }
        for (point, motion, sign) in [(self.points[0], a, 1.0), (self.points[1], b, -1.0)] {
            view.for_rates(tree, &point, &motion.position, |rate, w, u| {
                for (block, part) in [w * length, u].iter().enumerate() {
                    for i in 0..3 {
                        rows.matrix[(first + 3 * block + i, rate)] += sign * part[i];
                    }
                }
            });
        }
    }
}

impl Closure {
    fn load(&self, place: &Place, multipliers: &[f64], moving: &mut MovingTree) {
        let part = |at: usize| Vector3::from_column_slice(&multipliers[at..at + 3]);
        let [moment, force] = [part(0) * place.tree.length(), part(3)];
        for (point, sign) in self.points.iter().zip([-1.0, 1.0]) {
            let attitude = place.view.attitude(point);
            moving.load(point, &attitude, &(moment * sign), &(force * sign));
        }
    }
}

/// All constraints at a state, as linear equations `matrix v = right` for the rates.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    pub matrix: DMatrix<f64>,
    pub right: DVector<f64>,
    /// The time derivatives of `matrix v - right` for rates that do not change.
    pub bias: DVector<f64>,
    /// The values of the constraints on the coordinates; `None` for constraints on the rates.
    pub values: Vec<Option<f64>>,
    /// For each row, the first row of its constraint. All rows of a constraint have the same unit.
    pub first: Vec<usize>,
    /// The number of rows so far.
    next: usize,
    /// The first row of the present constraint.
    own: usize,
}

impl Rows {
    fn new(count: usize, freedom: usize) -> Self {
        Rows {
            matrix: DMatrix::zeros(count, freedom),
            right: DVector::zeros(count),
            bias: DVector::zeros(count),
            values: Vec::with_capacity(count),
            first: Vec::with_capacity(count),
            next: 0,
            own: 0,
        }
    }

    /// Begins a constraint, and returns the index of its first row.
    pub fn begin(&mut self) -> usize {
        self.own = self.next;
        self.own
    }

    /// Appends a row without its entries, and returns its index.
    pub fn push(&mut self, value: Option<f64>, right: f64, bias: f64) -> usize {
        let row = self.next;
        (self.right[row], self.bias[row]) = (right, bias);
        self.values.push(value);
        self.first.push(self.own);
        self.next += 1;
        row
    }

    /// The size of each constraint: the largest sum of the terms of one of its rows, for rates of
    /// these units.
    pub fn sizes(&self, units: &[f64]) -> Vec<f64> {
        let mut sizes = vec![0.0_f64; self.first.len()];
        for (row, first) in self.first.iter().enumerate() {
            let terms = self.matrix.row(row);
            let sum = terms.iter().zip(units).map(|(entry, unit)| (entry * unit).abs()).sum();
            sizes[*first] = sizes[*first].max(sum);
        }
        self.first.iter().map(|first| sizes[*first]).collect()
    }

    /// The violations `matrix v - right` of the rates.
    pub fn residual(&self, rates: &[f64]) -> DVector<f64> {
        &self.matrix * DVector::from_column_slice(rates) - &self.right
    }
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
    pub(super) fn load(&self, place: &Place, multipliers: &[f64], moving: &mut MovingTree) {
        match self {
            TreeConstraint::Closure(closure) => closure.load(place, multipliers, moving),
            TreeConstraint::Contact(contact) => contact.load(place.view, multipliers, moving),
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
        rows
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
        rows.begin();
        let row = rows.push(Some(self.numbers[motor.number] - value), speed, -acceleration);
        rows.matrix[(row, motor.rate)] = 1.0;
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
        rows.begin();
        let row = rows.push(Some(value), -by_time, bias);
        let mut gradient = vec![0.0; self.numbers.len()];
        slopes.iter().filter(|(k, _)| *k > 0).for_each(|(k, slope)| gradient[k - 1] = *slope);
        for (rate, number) in self.tree.coordinates() {
            rows.matrix[(row, rate)] = gradient[number];
        }
        for (rate, number) in self.tree.balls() {
            let by_rates = self.tree.along_ball(self.numbers, number, &gradient);
            (0..3).for_each(|k| rows.matrix[(row, rate + k)] = by_rates[k]);
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
        rows.begin();
        let row = rows.push(None, linear - value, bias);
        entries.into_iter().for_each(|(rate, slope)| rows.matrix[(row, rate)] = slope);
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
