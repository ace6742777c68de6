//! What formulas may speak of along a motion, and its value.

use super::Simulated;
use super::forces::{Forces, Point};
use crate::formula::Formula;
use crate::group::Coordinates;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DMatrix;

/// A number that a motion has at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `t`.
    Time,
    /// A parameter of the problem.
    Parameter(usize),
    /// An entry of the element as written, by row and column.
    Entry(usize, usize),
    /// A coordinate that the group has a name for.
    Named(usize),
    /// A component of the velocity, in the frame of the equations.
    Velocity(usize),
    /// A component of the momentum, in the frame of the equations.
    Momentum(usize),
    /// A component of the velocity in the other invariant frame.
    OtherVelocity(usize),
    /// A component of the momentum in the other invariant frame.
    OtherMomentum(usize),
    /// `T = H(Omega)/2` (98).
    Kinetic,
    /// The potential `V`.
    Potential,
    /// `T + V`.
    Energy,
    /// `M(Omega)` (109), of all forces.
    Power,
}

/// Coordinates of the origin of a body, where a group names them.
const POSITION: [&str; 3] = ["x", "y", "z"];

/// The names of quantities on a group.
#[derive(Clone, Debug)]
pub struct Names {
    /// Parameters of the problem.
    pub parameters: Vec<String>,
    dimension: usize,
    shape: (usize, usize),
    named: &'static [&'static str],
    /// Names of velocity and momentum: of the equations' frame, and of the other.
    sides: [[&'static str; 2]; 2],
}

impl Names {
    /// The names on a group.
    pub fn new<G: Simulated>(group: &G, parameters: Vec<String>) -> Self {
        let shape = group.write(&group.identity()).shape();
        let (body, space) = (["Omega", "H"], ["omega", "h"]);
        let sides = if G::RIGHT { [space, body] } else { [body, space] };
        Names { parameters, dimension: group.dimension(), shape, named: G::NAMED, sides }
    }

    /// The name of the momentum in the frame of the equations.
    pub fn momentum(&self) -> &'static str {
        self.sides[0][1]
    }

    /// Names of velocity and momentum: of the equations' frame, and of the other.
    pub(super) fn sides(&self) -> [[&'static str; 2]; 2] {
        self.sides
    }

    /// The quantity of a name.
    pub fn find(&self, name: &str) -> Option<Quantity> {
        if let Some(k) = self.parameters.iter().position(|parameter| parameter == name) {
            return Some(Quantity::Parameter(k));
        }
        if let Some(k) = self.named.iter().position(|named| *named == name) {
            // a position is the last column of the matrix, so a potential may speak of it
            let axis = POSITION.iter().position(|axis| *axis == name);
            return Some(
                axis.map_or(Quantity::Named(k), |row| Quantity::Entry(row, self.shape.1 - 1)),
            );
        }
        match name {
            "t" => return Some(Quantity::Time),
            "kinetic" => return Some(Quantity::Kinetic),
            "potential" => return Some(Quantity::Potential),
            "energy" => return Some(Quantity::Energy),
            "power" => return Some(Quantity::Power),
            _ => {}
        }
        let digits = name.find(|c: char| c.is_ascii_digit())?;
        let (stem, behind) = name.split_at(digits);
        if stem == self.element_stem() || (stem == "R" && self.shape.1 > 1) {
            let (row, column) = self.entry(behind)?;
            let inside = (1..=self.shape.0).contains(&row) && (1..=self.shape.1).contains(&column);
            return inside.then(|| Quantity::Entry(row - 1, column - 1));
        }
        let i: usize = behind.parse().ok().filter(|i| (1..=self.dimension).contains(i))?;
        let [[velocity, momentum], [other_velocity, other_momentum]] = self.sides;
        match stem {
            _ if stem == velocity => Some(Quantity::Velocity(i - 1)),
            _ if stem == momentum => Some(Quantity::Momentum(i - 1)),
            _ if stem == other_velocity => Some(Quantity::OtherVelocity(i - 1)),
            _ if stem == other_momentum => Some(Quantity::OtherMomentum(i - 1)),
            _ => None,
        }
    }

    /// Row and column: `12`, or `1_12` for larger matrices; a column has rows only.
    fn entry(&self, digits: &str) -> Option<(usize, usize)> {
        if self.shape.1 == 1 {
            return Some((digits.parse().ok()?, 1));
        }
        let (row, column) = match digits.split_once('_') {
            Some(both) => both,
            None if digits.len() == 2 => digits.split_at(1),
            None => return None,
        };
        Some((row.parse().ok()?, column.parse().ok()?))
    }

    /// `g` for matrices, `x` for columns of coordinates.
    pub(super) fn element_stem(&self) -> &'static str {
        if self.shape.1 == 1 { "x" } else { "g" }
    }

    /// All names of a stem, such as `Omega`, `g` or `energy`, or of one quantity.
    pub fn expand(&self, stem: &str) -> Vec<String> {
        let numbered = |n: usize| (1..=n).map(|i| format!("{stem}{i}")).collect();
        let sides = self.sides.as_flattened();
        let (rows, columns) = self.shape;
        if sides.contains(&stem) {
            return numbered(self.dimension);
        }
        if stem == "element" {
            return match self.named {
                [] => self.expand(self.element_stem()),
                named => named.iter().map(|name| name.to_string()).collect(),
            };
        }
        if stem == self.element_stem() {
            if columns == 1 {
                return numbered(rows);
            }
            let between = if rows.max(columns) > 9 { "_" } else { "" };
            let entries = (1..=rows).flat_map(|i| (1..=columns).map(move |j| (i, j)));
            return entries.map(|(i, j)| format!("{stem}{i}{between}{j}")).collect();
        }
        match self.find(stem) {
            Some(_) => vec![stem.into()],
            None => vec![],
        }
    }

    /// The entries of the element, for messages.
    pub fn entries(&self) -> String {
        let entries = self.expand(self.element_stem());
        let mut names = vec![match entries.as_slice() {
            [first, .., last] => format!("{first}..{last}"),
            few => few.concat(),
        }];
        let positions = self.named.iter().filter(|name| POSITION.contains(name));
        names.extend(positions.map(|name| name.to_string()));
        names.join(", ")
    }

    /// What there is, for messages.
    pub fn all(&self) -> String {
        let mut names: Vec<String> = vec!["t".into()];
        let n = self.dimension;
        names.extend(self.sides.as_flattened().iter().map(|stem| format!("{stem}1..{stem}{n}")));
        names.push(self.entries());
        let others = self.named.iter().filter(|name| !POSITION.contains(name));
        names.extend(others.map(|name| name.to_string()));
        names.extend(["kinetic", "potential", "energy", "power"].map(String::from));
        names.extend(self.parameters.iter().cloned());
        names.join(", ")
    }
}

/// Formulas over the quantities that they use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    quantities: Vec<Quantity>,
}

impl Scope {
    /// Reads a formula.
    ///
    /// # Errors
    /// As [`Formula::parse`]; a quantity that is not `allowed`.
    pub fn read(
        &mut self,
        text: &str,
        names: &Names,
        allowed: &dyn Fn(Quantity) -> bool,
    ) -> Result<Formula, ExpressionError> {
        Formula::parse(text, &mut |name| {
            let quantity = names.find(name).filter(|quantity| allowed(*quantity))?;
            Some(self.index(quantity))
        })
    }

    /// The place of a quantity among the values.
    pub fn index(&mut self, quantity: Quantity) -> usize {
        let known = self.quantities.iter().position(|other| *other == quantity);
        known.unwrap_or_else(|| {
            self.quantities.push(quantity);
            self.quantities.len() - 1
        })
    }

    /// The quantities, in the order of their values.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// The value of a formula, and its derivatives along invariant fields, by those of the element as written: through its
    /// entries alone.
    pub fn along_fields(
        &self,
        formula: &Formula,
        values: &[f64],
        fields: &[DMatrix<f64>],
    ) -> (f64, Vec<f64>) {
        let mut slopes = vec![0.0; values.len()];
        let value = formula.gradient(values, &mut slopes);
        let along = |field: &DMatrix<f64>| {
            let terms = self.quantities.iter().zip(&slopes);
            let term = |(quantity, slope): (&Quantity, &f64)| match *quantity {
                // 0 times an infinite derivative is none
                Quantity::Entry(row, column) if *slope != 0.0 => slope * field[(row, column)],
                _ => 0.0,
            };
            terms.map(term).sum()
        };
        (value, fields.iter().map(along).collect())
    }

    fn any(&self, wanted: impl Fn(Quantity) -> bool) -> bool {
        self.quantities.iter().any(|quantity| wanted(*quantity))
    }

    /// The values at a point of a motion.
    pub fn values<G: Simulated>(&self, forces: &Forces<G>, at: &Point<G>) -> Vec<f64> {
        use Quantity::*;
        let group = &forces.group;
        let own = |q| matches!(q, Momentum(_) | OtherMomentum(_) | Kinetic | Energy);
        let computed = || at.momentum.cloned().unwrap_or_else(|| forces.momentum(at.velocity));
        let momentum = self.any(own).then(computed);
        let other_momentum =
            momentum.as_ref().filter(|_| self.any(|q| matches!(q, OtherMomentum(_))));
        let other_momentum = other_momentum.map(|h| group.coadjoint(&group.inverse(at.element), h));
        let other_velocity = self.any(|q| matches!(q, OtherVelocity(_)));
        let other_velocity = other_velocity.then(|| group.adjoint(at.element, at.velocity));
        let element = self.any(|q| matches!(q, Entry(..))).then(|| group.write(at.element));
        let named = self.any(|q| matches!(q, Named(_))).then(|| group.named(at.element));
        let component = |v: &Option<G::Vector>, i: usize| match v {
            Some(v) => v.components()[i],
            None => f64::NAN,
        };
        let kinetic = || {
            let both = momentum.iter().flat_map(|h| h.components()).zip(at.velocity.components());
            0.5 * both.map(|(h, omega)| h * omega).sum::<f64>()
        };
        let value = |quantity: &Quantity| match *quantity {
            Time => at.time,
            Parameter(k) => forces.parameters[k],
            Entry(i, j) => element.as_ref().map_or(f64::NAN, |m| m[(i, j)]),
            Named(k) => named.as_ref().map_or(f64::NAN, |values| values[k]),
            Velocity(i) => at.velocity.components()[i],
            Momentum(i) => component(&momentum, i),
            OtherVelocity(i) => component(&other_velocity, i),
            OtherMomentum(i) => component(&other_momentum, i),
            Kinetic => at.energy.unwrap_or_else(kinetic),
            Potential => forces.potential(at),
            Energy => at.energy.unwrap_or_else(|| kinetic() + forces.potential(at)),
            Power => forces.power(at),
        };
        self.quantities.iter().map(value).collect()
    }
}
