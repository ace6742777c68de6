//! Forces as formulas and tables, on any group.

use super::Simulated;
use super::quantities::{Names, Quantity, Scope};
use super::table::Table;
use crate::dynamics::euler_poincare::Torque;
use crate::formula::Formula;
use crate::group::Coordinates;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DMatrix;
use std::sync::Mutex;

/// A point of a motion, with the velocity in the frame of the equations.
pub struct Point<'p, G: Simulated> {
    /// The time.
    pub time: f64,
    /// The element.
    pub element: &'p G::Element,
    /// The velocity.
    pub velocity: &'p G::Vector,
    /// The momentum in the frame of the equations, where it is not `J Omega`.
    pub momentum: Option<&'p G::Vector>,
    /// The energy, where it is not that of a metric and a potential.
    pub energy: Option<f64>,
}

impl<'p, G: Simulated> Point<'p, G> {
    /// Of a system with an inertia.
    pub fn new(time: f64, element: &'p G::Element, velocity: &'p G::Vector) -> Self {
        Point { time, element, velocity, momentum: None, energy: None }
    }
}

/// One of the two invariant frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left-invariant: body components.
    Body,
    /// Right-invariant: components in space.
    Space,
}

/// The forces on a system: covectors by their components, a potential, a table over time.
///
/// The potential `V` adds `M_i = -e_i(V)`, the derivative along the invariant field `e_i`.
#[derive(Debug)]
pub struct Forces<G: Simulated> {
    pub(super) group: G,
    pub(super) parameters: Vec<f64>,
    inertia: DMatrix<f64>,
    names: Names,
    scope: Scope,
    /// Components with their side, and their text.
    terms: Vec<(Side, usize, Formula, String)>,
    potential: Option<(Formula, String)>,
    table: Option<(Side, Table)>,
    /// Derivatives of the elements `exp(s e_i)` as written, at 0.
    generators: Vec<DMatrix<f64>>,
    trouble: Mutex<Option<String>>,
}

impl<G: Simulated> Forces<G> {
    /// No forces yet on a system with this inertia.
    pub fn none(group: G, inertia: DMatrix<f64>, parameters: Vec<(String, f64)>) -> Self {
        let (names, parameters) = parameters.into_iter().unzip();
        Forces {
            names: Names::new(&group, names),
            group,
            parameters,
            inertia,
            scope: Scope::default(),
            terms: vec![],
            potential: None,
            table: None,
            generators: vec![],
            trouble: Mutex::new(None),
        }
    }

    /// The names that formulas may use.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// Adds a component (from 0) of a covector.
    ///
    /// # Errors
    /// As [`Formula::parse`]. Energies and the power are not known to forces.
    pub fn add(&mut self, side: Side, i: usize, text: &str) -> Result<(), ExpressionError> {
        use Quantity::{Energy, Kinetic, Potential, Power};
        let allowed = |q| !matches!(q, Kinetic | Potential | Energy | Power);
        let formula = self.scope.read(text, &self.names, &allowed)?;
        self.terms.push((side, i, formula, text.trim().into()));
        Ok(())
    }

    /// Sets the potential, a function of time and of the entries of the element.
    ///
    /// # Errors
    /// As [`Formula::parse`].
    pub fn set_potential(&mut self, text: &str) -> Result<(), ExpressionError> {
        let allowed =
            |q| matches!(q, Quantity::Time | Quantity::Parameter(_) | Quantity::Entry(..));
        let formula = self.scope.read(text, &self.names, &allowed)?;
        self.generators = self.group.generators();
        self.potential = Some((formula, text.trim().into()));
        Ok(())
    }

    /// Sets a covector over time.
    pub fn set_table(&mut self, side: Side, table: Table) {
        self.table = Some((side, table));
    }

    /// Where a step under control from one time towards another has to end: at a corner of the table, or there.
    pub(super) fn pause(&self, from: f64, until: f64) -> f64 {
        let corner = self.table.as_ref().and_then(|(_, table)| table.corner(from, until));
        corner.unwrap_or(until)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty() && self.potential.is_none() && self.table.is_none()
    }

    /// Whether they depend on no velocity.
    pub fn are_positional(&self) -> bool {
        use Quantity::{Entry, Named, Parameter, Time};
        let of_place = |q: &Quantity| matches!(q, Time | Parameter(_) | Entry(..) | Named(_));
        self.scope.quantities().iter().all(of_place)
    }

    /// Whether a potential that does not depend on time is all there is, so that the energy is conserved.
    pub fn are_conservative(&self) -> bool {
        let timeless = !self.scope.quantities().contains(&Quantity::Time);
        self.terms.is_empty() && self.table.is_none() && timeless
    }

    /// `J Omega`.
    pub fn momentum(&self, velocity: &G::Vector) -> G::Vector {
        let omega = velocity.components();
        let row = |i: usize| (0..omega.len()).map(|j| self.inertia[(i, j)] * omega[j]).sum();
        G::Vector::from_fn(omega.len(), row)
    }

    /// `V`.
    pub(super) fn potential(&self, at: &Point<G>) -> f64 {
        match &self.potential {
            Some((formula, _)) => formula.value(&self.scope.values(self, at)),
            None => 0.0,
        }
    }

    /// `M(Omega)`.
    pub(super) fn power(&self, at: &Point<G>) -> f64 {
        let force = self.total(at);
        force.components().iter().zip(at.velocity.components()).map(|(m, omega)| m * omega).sum()
    }

    /// The sum of all, in the frame of the equations.
    fn total(&self, at: &Point<G>) -> G::Vector {
        let n = self.group.dimension();
        let values = self.scope.values(self, at);
        let own = if G::RIGHT { Side::Space } else { Side::Body };
        let mut sums = [vec![0.0; n], vec![0.0; n]];
        for (side, i, formula, text) in &self.terms {
            let value = formula.value(&values);
            if !value.is_finite() {
                self.note(&format!("the force {text}"), value, at);
            }
            sums[usize::from(*side != own)][*i] += value;
        }
        if let Some((side, table)) = &self.table {
            table.add(at.time, &mut sums[usize::from(*side != own)]);
        }
        if let Some((formula, text)) = &self.potential {
            let fields = self.group.slopes(at.element, &self.generators);
            let (value, mut slopes) = self.scope.along_fields(formula, &values, &fields);
            if !value.is_finite() {
                self.note(&format!("the potential {text}"), value, at);
                slopes.fill(f64::NAN);
            } else if let Some(value) = slopes.iter().find(|value| !value.is_finite()) {
                self.note(&format!("the derivative of the potential {text}"), *value, at);
            }
            for (sum, slope) in sums[0].iter_mut().zip(&slopes) {
                *sum -= slope;
            }
        }
        let [mine, other] = sums.map(|sum| G::Vector::from_components(&sum));
        if other.largest() == 0.0 && other.is_finite() {
            return mine;
        }
        mine + self.group.coadjoint(at.element, &other)
    }

    /// Keeps what went wrong, and where.
    fn note(&self, what: &str, value: f64, at: &Point<G>) {
        let list =
            |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        let [[velocity, _], _] = self.names.sides();
        // row by row
        let element = self.group.write(at.element).transpose();
        let text = format!(
            "{what} is {value} at t = {}, {velocity} = [{}], {} = [{}]",
            at.time,
            list(at.velocity.components()),
            self.names.element_stem(),
            list(element.as_slice())
        );
        self.tell(text);
    }

    /// Keeps what went wrong last.
    pub(super) fn tell(&self, text: String) {
        if let Ok(mut trouble) = self.trouble.lock() {
            *trouble = Some(text);
        }
    }

    /// What went wrong last in a force, which is then forgotten.
    pub fn trouble(&self) -> Option<String> {
        self.trouble.lock().ok()?.take()
    }
}

impl<G: Simulated> Torque<G> for Forces<G> {
    fn is_absent(&self) -> bool {
        self.is_empty()
    }

    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector) {
        if !self.is_empty() {
            *force = force.clone() + self.total(&Point::new(time, element, velocity));
        }
    }
}
