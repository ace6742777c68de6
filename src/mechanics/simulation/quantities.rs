//! Quantities of a motion and their names in formulas.

use super::group::SimulationGroup;
use crate::group::{Block, Coordinate, Partial};
use crate::mechanics::formula::{Formula, Symbol};
use affinor_tensors::expression::ExpressionError;

/// A quantity of a motion, with one value at each time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionQuantity {
    /// The time `t`.
    Time,
    /// A parameter of the problem.
    Parameter(usize),
    /// An entry of the written form of the element, given by its row and column from 0.
    Entry(usize, usize),
    /// A named coordinate of the element, such as `qw`, given by its index in
    /// [`MatrixNotation::named`](crate::group::MatrixNotation::named).
    Named(usize),
    /// A component of the velocity, in the frame of the equations.
    Velocity(usize),
    /// A component of the momentum, in the frame of the equations.
    Momentum(usize),
    /// A component of the velocity in the other invariant frame.
    OtherVelocity(usize),
    /// A component of the momentum in the other invariant frame.
    OtherMomentum(usize),
    /// The kinetic energy `T = H(Omega)/2` (98).
    Kinetic,
    /// The potential `V`.
    Potential,
    /// The energy `T + V`.
    Energy,
    /// The power `M(Omega)` (109) of all forces.
    Power,
}

/// The names that formulas on a group may use.
#[derive(Clone, Debug)]
pub struct SymbolTable {
    /// Parameters of the problem and their values.
    pub parameters: Vec<(String, f64)>,
    dimension: usize,
    /// The written forms of the factors of the group. If a group is not a product, its only factor
    /// is the group itself.
    blocks: Vec<Block>,
    /// The names of the velocity and the momentum: first in the frame of the equations, then in the
    /// other invariant frame.
    sides: [[&'static str; 2]; 2],
}

impl SymbolTable {
    /// The names of the quantities of motions on `group`, and of the parameters.
    pub fn new<G: SimulationGroup>(group: &G, parameters: Vec<(String, f64)>) -> Self {
        let blocks = group.blocks();
        let (body, spatial) = (["Omega", "H"], ["omega", "h"]);
        let sides = if group.is_right() { [spatial, body] } else { [body, spatial] };
        SymbolTable { parameters, dimension: group.dimension(), blocks, sides }
    }

    /// The name of the momentum in the frame of the equations.
    pub fn momentum(&self) -> &'static str {
        self.sides[0][1]
    }

    /// The name of the velocity in the frame of the equations.
    pub(super) fn velocity(&self) -> &'static str {
        self.sides[0][0]
    }

    /// The number of rows of the matrix of an element.
    pub(super) fn rows(&self) -> usize {
        match &*self.blocks {
            [block] => block.shape.0,
            factors => factors.iter().map(|block| block.shape.0 * block.shape.1).sum(),
        }
    }

    /// The quantity with this name; `None` if there is no such quantity.
    pub fn find(&self, name: &str) -> Option<MotionQuantity> {
        if let Some(k) = self.parameters.iter().position(|(known, _)| known == name) {
            return Some(MotionQuantity::Parameter(k));
        }
        match name {
            "t" => return Some(MotionQuantity::Time),
            "kinetic" => return Some(MotionQuantity::Kinetic),
            "potential" => return Some(MotionQuantity::Potential),
            "energy" => return Some(MotionQuantity::Energy),
            "power" => return Some(MotionQuantity::Power),
            _ => {}
        }
        if let Some(coordinate) = self.coordinate(name) {
            return Some(coordinate);
        }
        let digits = name.find(|c: char| c.is_ascii_digit())?;
        let (stem, behind) = name.split_at(digits);
        let i: usize = behind.parse().ok().filter(|i| (1..=self.dimension).contains(i))?;
        let [[velocity, momentum], [other_velocity, other_momentum]] = self.sides;
        match stem {
            _ if stem == velocity => Some(MotionQuantity::Velocity(i - 1)),
            _ if stem == momentum => Some(MotionQuantity::Momentum(i - 1)),
            _ if stem == other_velocity => Some(MotionQuantity::OtherVelocity(i - 1)),
            _ if stem == other_momentum => Some(MotionQuantity::OtherMomentum(i - 1)),
            _ => None,
        }
    }

    /// The coordinate of the element with this name. The names of factor `k` of a product end in
    /// `_k`.
    fn coordinate(&self, name: &str) -> Option<MotionQuantity> {
        let (factor, name) = self.factor(name)?;
        let (before, block) = (&self.blocks[..factor], self.blocks.get(factor)?);
        Some(match block.find(name)? {
            Coordinate::Named(k) => MotionQuantity::Named(
                before.iter().map(|block| block.names.len()).sum::<usize>() + k,
            ),
            Coordinate::Entry(row, column) => self.entry(factor, row, column),
        })
    }

    /// An entry of the matrix of a factor, all counted from 0. The entries of a product are rows of
    /// one column.
    ///
    /// # Panics
    /// Panics if the group has fewer factors.
    pub fn entry(&self, factor: usize, row: usize, column: usize) -> MotionQuantity {
        if self.blocks.len() == 1 {
            return MotionQuantity::Entry(row, column);
        }
        let size = |block: &Block| block.shape.0 * block.shape.1;
        let start: usize = self.blocks[..factor].iter().map(size).sum();
        MotionQuantity::Entry(start + row * self.blocks[factor].shape.1 + column, 0)
    }

    /// The factor to which a name refers, counted from 0, and the name within this factor.
    fn factor<'n>(&self, name: &'n str) -> Option<(usize, &'n str)> {
        if self.blocks.len() == 1 {
            return Some((0, name));
        }
        let (name, factor) = name.rsplit_once('_')?;
        let factor: usize = factor.parse().ok()?;
        (1..=self.blocks.len()).contains(&factor).then(|| (factor - 1, name))
    }

    /// The names in all factors, with the suffix of each factor.
    fn of_factors(&self, names: impl Fn(&Block) -> Vec<String>) -> Vec<String> {
        let blocks = self.blocks.iter().enumerate();
        let outside = |(k, block): (usize, &Block)| {
            let suffix = if self.blocks.len() > 1 { format!("_{}", k + 1) } else { String::new() };
            names(block).into_iter().map(|name| name + &suffix).collect::<Vec<_>>()
        };
        blocks.flat_map(outside).collect()
    }

    /// The letter of the entries in messages: `g` for matrices, `x` for columns of coordinates.
    pub(super) fn element_stem(&self) -> &'static str {
        if let [block] = &*self.blocks { block.letter() } else { "element" }
    }

    /// All names with a stem such as `Omega` or `g`. For a single quantity such as `energy`, the
    /// list contains only its name.
    pub fn expand(&self, stem: &str) -> Vec<String> {
        let numbered = |n: usize| (1..=n).map(|i| format!("{stem}{i}")).collect();
        let sides = self.sides.as_flattened();
        if sides.contains(&stem) {
            return numbered(self.dimension);
        }
        let names = self.of_factors(|block| match stem {
            "element" if !block.names.is_empty() => {
                block.names.iter().map(|name| name.to_string()).collect()
            }
            _ if stem == "element" || stem == block.letter() => block.entries(),
            // accepts `R` as the letter of matrices too, unless it is a parameter
            "R" if self.find(stem).is_none() && block.letter() == "g" => {
                block.entries().iter().map(|entry| entry.replace('g', stem)).collect()
            }
            _ => vec![],
        });
        if !names.is_empty() {
            return names;
        }
        match self.find(stem) {
            Some(_) => vec![stem.into()],
            None => vec![],
        }
    }

    /// The names of the entries of the element, as text for messages.
    pub fn entries(&self) -> String {
        self.entry_ranges().join(", ")
    }

    fn entry_ranges(&self) -> Vec<String> {
        let of_block = |block: &Block| {
            let entries = block.entries();
            let mut names = vec![match entries.as_slice() {
                [first, .., last] => format!("{first}..{last}"),
                few => few.concat(),
            }];
            let positions = block.names.iter().filter(|name| Block::is_position(name));
            names.extend(positions.map(|name| name.to_string()));
            names
        };
        self.of_factors(of_block)
    }

    /// All names of allowed quantities, as text for messages.
    pub fn all(&self, allowed: &dyn Fn(MotionQuantity) -> bool) -> String {
        let mut names: Vec<String> = vec!["t".into()];
        let n = self.dimension;
        names.extend(self.sides.as_flattened().iter().map(|stem| format!("{stem}1..{stem}{n}")));
        names.extend(self.entry_ranges());
        let others = |block: &Block| {
            let others = block.names.iter().filter(|name| !Block::is_position(name));
            others.map(|name| name.to_string()).collect()
        };
        names.extend(self.of_factors(others));
        names.extend(["kinetic", "potential", "energy", "power"].map(String::from));
        names.extend(self.parameters.iter().map(|(name, _)| name.clone()));
        let first = |name: &str| self.find(name.split("..").next().unwrap_or(name));
        names.retain(|name| first(name).is_none_or(allowed));
        names.join(", ")
    }
}

/// The quantities that a set of formulas uses. Their order is the numbering of the variables in the
/// formulas. Parameters are constants.
#[derive(Clone, Debug, Default)]
pub struct FormulaScope {
    quantities: Vec<MotionQuantity>,
}

impl FormulaScope {
    /// Parses a formula, and adds its quantities to the scope.
    ///
    /// # Errors
    /// The errors of [`Formula::parse`]; also an error if the formula contains a quantity that is
    /// not `allowed`.
    pub fn read(
        &mut self,
        text: &str,
        names: &SymbolTable,
        allowed: &dyn Fn(MotionQuantity) -> bool,
    ) -> Result<Formula, ExpressionError> {
        Formula::read(text, &mut |name| {
            Some(match names.find(name).filter(|quantity| allowed(*quantity))? {
                MotionQuantity::Parameter(k) => Symbol::Number(names.parameters[k].1),
                quantity => Symbol::Variable(self.index(quantity)),
            })
        })
    }

    /// The polynomial with these terms, each with a coefficient and its factors. The quantities are
    /// added to the scope.
    pub fn polynomial(&mut self, terms: &[(f64, Vec<MotionQuantity>)]) -> Formula {
        let mut indices = |factors: &Vec<MotionQuantity>| -> Vec<usize> {
            factors.iter().map(|quantity| self.index(*quantity)).collect()
        };
        let terms: Vec<_> = terms.iter().map(|(c, factors)| (*c, indices(factors))).collect();
        Formula::polynomial(&terms)
    }

    /// The index of a quantity. The quantity is added if it is new.
    pub fn index(&mut self, quantity: MotionQuantity) -> usize {
        let known = self.quantities.iter().position(|other| *other == quantity);
        known.unwrap_or_else(|| {
            self.quantities.push(quantity);
            self.quantities.len() - 1
        })
    }

    /// The quantities, in order of their indices.
    pub fn quantities(&self) -> &[MotionQuantity] {
        &self.quantities
    }

    /// Replaces the content of `values` by the values of the quantities, in order of their indices.
    #[inline]
    pub(super) fn evaluate(&self, value: impl FnMut(MotionQuantity) -> f64, values: &mut Vec<f64>) {
        values.clear();
        values.extend(self.quantities.iter().copied().map(value));
    }

    /// Replaces the content of `partial` by the nonzero derivatives with respect to entries. They
    /// are taken from `slopes`, the derivatives with respect to quantities.
    #[inline]
    pub(super) fn by_entries(
        &self,
        slopes: impl Iterator<Item = (usize, f64)>,
        partial: &mut Vec<Partial>,
    ) {
        partial.clear();
        for (k, slope) in slopes {
            // omits zero derivatives, because 0 times an infinite entry is NaN
            if let MotionQuantity::Entry(row, column) = self.quantities[k]
                && slope != 0.0
            {
                partial.push((row, column, slope));
            }
        }
    }
}
