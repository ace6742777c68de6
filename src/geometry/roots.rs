//! Square roots of functions, under the assumption that their factors are positive.

use crate::Error;
use affinor_tensors::Symbolic;
use affinor_tensors::scalar::PositiveFactors;
use std::collections::{BTreeMap, BTreeSet};

/// The number of points at which the signs of roots are sought.
const POINTS: u64 = 4000;

/// The assumptions under which roots are taken, and a point at which the roots are positive.
#[derive(Clone, Debug)]
pub(super) struct Roots {
    assumptions: PositiveFactors,
    /// The number of assumptions that were given.
    given: usize,
    /// Functions whose squares were under roots, with the sign that they have at the point.
    bases: Vec<Symbolic>,
    point: Option<BTreeMap<String, f64>>,
}

impl Roots {
    pub fn new(positive: PositiveFactors) -> Self {
        let given = positive.factors().len();
        Roots { assumptions: positive, given, bases: vec![], point: None }
    }

    /// Chooses the point at which roots are positive, so that these functions and the assumptions are
    /// positive there. Returns whether there is one.
    pub fn sample(&mut self, functions: &[Symbolic]) -> bool {
        let functions: Vec<_> = functions.iter().chain(self.assumptions.factors()).collect();
        let parameters = functions.iter().flat_map(|function| function.parameters());
        let mut names: BTreeSet<String> = parameters.collect();
        let parts = functions.iter().flat_map(|f| [f.numerator(), f.denominator()]);
        let variables = parts.flat_map(|part| part.terms()).flat_map(|(powers, _)| powers);
        let free = variables.filter(|(variable, _)| variable.free_function().is_some());
        names.extend(free.map(|(variable, _)| variable.text().to_string()));
        self.point = (0..POINTS).find_map(|seed| {
            let mut random = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
            let mut draw = || {
                random ^= random << 13;
                random ^= random >> 7;
                random ^= random << 17;
                let size = 0.05 + 3.0 * (random >> 40) as f64 / (1u64 << 24) as f64;
                // every second point may have negative coordinates
                if seed % 2 == 1 && random >> 39 & 1 == 1 { -size } else { size }
            };
            let values: BTreeMap<String, f64> =
                names.iter().map(|name| (name.clone(), draw())).collect();
            let lookup = |name: &str| values.get(name).copied();
            let is_positive =
                |function: &&Symbolic| function.evaluate(lookup).is_some_and(|v| v > 1e-9);
            functions.iter().all(is_positive).then_some(values)
        });
        self.point.is_some()
    }

    /// The positive root of a function.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the function is negative, or if the sign of a factor is unknown.
    pub fn root(&mut self, function: &Symbolic) -> Result<Symbolic, Error> {
        let root = self.assumptions.assumed_root(function).map_err(|reason| {
            Error::Unsupported(format!("the root of {function} is needed, but {reason}"))
        })?;
        let mut base = self.positive(function.square_factor());
        let is_constant = |f: &Symbolic| f.parameters().is_empty();
        if is_constant(&(root.clone() / &base)) {
            base = self.positive(root.clone());
        } else if is_constant(&base.numerator()) {
            base = Symbolic::from(1) / &base;
        }
        if !self.assumptions.show(&base) && !self.bases.contains(&base) {
            self.bases.push(base);
        }
        Ok(self.positive(root))
    }

    /// Whether the function is positive at the point; `None` if there is no point.
    pub fn is_positive(&self, function: &Symbolic) -> Option<bool> {
        let point = self.point.as_ref()?;
        let value = function.evaluate(|name: &str| point.get(name).copied())?;
        (value != 0.0).then_some(value > 0.0)
    }

    /// The function with the sign for which it is positive at the point.
    pub fn positive(&self, function: Symbolic) -> Symbolic {
        if self.is_positive(&function) == Some(false) { -function } else { function }
    }

    /// The functions that were given as positive.
    pub fn given(&self) -> &[Symbolic] {
        &self.assumptions.factors()[..self.given]
    }

    /// The functions that the roots assume to be positive, without the given ones.
    pub fn assumed(&self) -> Vec<Symbolic> {
        let factors = &self.assumptions.factors()[self.given..];
        factors.iter().chain(&self.bases).cloned().collect()
    }
}
