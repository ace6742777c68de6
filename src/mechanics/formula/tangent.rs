//! Rates of change of the derivatives of a formula along a curve, computed by forward accumulation.

use super::{Gradient, Kind, Workspace};

impl Kind {
    /// The rate of change of the result of an operation on the values `[a, b]` with the rates
    /// `[da, db]`. A derivative that vanishes contributes nothing, even if it multiplies an infinite
    /// number.
    fn rate(self, result: f64, [a, b]: [f64; 2], [da, db]: [f64; 2]) -> f64 {
        let share = |slope: f64, rate: f64| {
            if slope == 0.0 || rate == 0.0 { 0.0 } else { slope * rate }
        };
        match self {
            Kind::Add => da + db,
            Kind::Multiply | Kind::Share => share(b, da) + share(a, db),
            Kind::Negate => -da,
            Kind::Reciprocal => -share(result * result, da),
            Kind::Call(f) => share((f.slope)(a, result), da),
            Kind::CallTwo(f) => {
                let [by_first, by_second] = (f.slopes)(a, b);
                share(by_first, da) + share(by_second, db)
            }
            Kind::Slope(f) => share((f.bend)(a, b), da),
            Kind::SlopeOfTwo(f, by) => {
                let [first, mixed, second] = (f.bends)(a, b);
                let [with_first, with_second] = [[first, mixed], [mixed, second]][by];
                share(with_first, da) + share(with_second, db)
            }
        }
    }
}

impl Gradient {
    /// The derivatives of the formula and their rates of change `d/ds` along a curve on which the
    /// variables have the values `variables` and the rates of change `rates`. Each item consists of
    /// the index of a variable, the derivative with respect to this variable, and its rate of
    /// change. Derivatives that vanish identically are omitted.
    ///
    /// ```
    /// use affinor::mechanics::formula::{Formula, Workspace};
    ///
    /// let formula = Formula::parse("x^3", &mut |_| Some(0))?.differentiated();
    /// let mut workspace = Workspace::default();
    /// // the derivative is 3 x^2, and its rate of change is 6 x x'
    /// let found: Vec<_> = formula.along(&[2.0], &[5.0], &mut workspace).collect();
    /// assert_eq!(found, [(0, 12.0, 60.0)]);
    /// # Ok::<(), affinor::tensors::expression::ExpressionError>(())
    /// ```
    pub fn along<'g>(
        &'g self,
        variables: &[f64],
        rates: &[f64],
        workspace: &'g mut Workspace,
    ) -> impl Iterator<Item = (usize, f64, f64)> + 'g {
        let formula = &self.formula;
        let first = formula.numbers.len() + formula.variables.len();
        formula.evaluate(variables, workspace);
        let Workspace { results, rates: found } = workspace;
        found.clear();
        found.resize(formula.numbers.len(), 0.0);
        found.extend(formula.variables.iter().map(|k| rates[*k]));
        for (at, operation) in formula.operations.iter().enumerate() {
            let [values, changes] =
                [&*results, &*found].map(|list| operation.operands.map(|k| list[k]));
            found.push(operation.kind.rate(results[first + at], values, changes));
        }
        self.slopes.iter().map(|&(k, at)| (k, results[at], found[at]))
    }
}
