//! Values of functions modulo a prime at random points.

use affinor_tensors::Symbolic;
use affinor_tensors::linear::modular::Prime;
use affinor_tensors::scalar::Variable;
use std::collections::HashMap;

/// Values of the variables of functions modulo a prime. A root gets a root of the value of its
/// argument.
pub(super) struct ModularPoint {
    pub prime: Prime,
    pub seed: u64,
    pub values: HashMap<Variable, u64>,
}

impl ModularPoint {
    fn draw(&mut self) -> u64 {
        // SplitMix64
        self.seed = self.seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        self.prime.reduce((z ^ (z >> 31)) >> 2)
    }

    /// The values of the variables that do not depend on the coordinates.
    pub fn constants(&self, coordinates: &[String]) -> HashMap<Variable, u64> {
        let is_constant = |variable: &Variable| {
            let names = Symbolic::variable(*variable).parameters();
            !names.iter().any(|name| coordinates.contains(name))
        };
        self.values.iter().filter(|(v, _)| is_constant(v)).map(|(v, x)| (*v, *x)).collect()
    }

    fn variable(&mut self, variable: Variable) -> Option<u64> {
        if let Some(known) = self.values.get(&variable) {
            return Some(*known);
        }
        let value = match variable.root() {
            Some((argument, 2)) => {
                let p = self.prime.get();
                let square = self.value(argument)?;
                // p = 3 modulo 4
                let root = self.power(square, p.div_ceil(4));
                (self.prime.mul(root, root) == square).then_some(root)?
            }
            Some(_) => return None,
            None => self.draw(),
        };
        self.values.insert(variable, value);
        Some(value)
    }

    fn power(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut square, mut product) = (base, 1);
        while exponent > 0 {
            if exponent & 1 == 1 {
                product = self.prime.mul(product, square);
            }
            square = self.prime.mul(square, square);
            exponent >>= 1;
        }
        product
    }

    /// The value of a function; `None` if a denominator vanishes, or if a root does not exist.
    pub fn value(&mut self, function: &Symbolic) -> Option<u64> {
        if let Some(constant) = function.as_constant() {
            return self.prime.rational(constant);
        }
        let below = self.polynomial(&function.denominator())?;
        let above = self.polynomial(&function.numerator())?;
        Some(self.prime.mul(above, self.prime.inv(below)?))
    }

    fn polynomial(&mut self, polynomial: &Symbolic) -> Option<u64> {
        let mut sum = 0;
        for (powers, coefficient) in polynomial.terms() {
            let mut term = self.prime.rational(&coefficient)?;
            for (variable, exponent) in powers {
                let value = self.variable(variable)?;
                term = self.prime.mul(term, self.power(value, exponent.into()));
            }
            sum = self.prime.add(sum, term);
        }
        Some(sum)
    }
}
