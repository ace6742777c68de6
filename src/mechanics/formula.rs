//! Formulas in floats that are evaluated many times, such as torques, potentials and columns of a
//! trajectory.

mod affine;
mod functions;
mod tangent;

pub use affine::{AffineTerms, affine_terms};

use affinor_tensors::expression::{Evaluator, Expression, ExpressionError};
use affinor_tensors::{Notation, Rational};
use functions::{FUNCTIONS, FUNCTIONS_OF_TWO, Function, FunctionOfTwo};
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// A formula, stored as numbers and variables, followed by a list of operations on earlier values.
///
/// ```
/// use affinor::mechanics::formula::Formula;
/// let names = ["x", "y"];
/// let formula = Formula::parse("x^2*y - sin(pi*y)", &mut |name| names.iter().position(|n| *n == name))?;
/// assert_eq!(formula.value(&[3.0, 2.0]).round(), 18.0);
/// let mut slopes = [0.0; 2];
/// formula.gradient(&[3.0, 2.0], &mut slopes);
/// assert_eq!(slopes[0], 12.0);
/// # Ok::<(), affinor::tensors::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    numbers: Vec<f64>,
    variables: Vec<usize>,
    operations: Vec<Operation>,
    /// The position of the value of the formula in the list of numbers, variables and results of
    /// operations.
    last: usize,
}

/// A formula and its partial derivatives, stored as one list of operations. Subexpressions without
/// variables are computed only once, when the list is made.
///
/// ```
/// use affinor::mechanics::formula::{Formula, Symbol, Workspace};
///
/// let mut symbol = |name: &str| match name {
///     "m" => Some(Symbol::Number(3.0)),
///     "x" => Some(Symbol::Variable(0)),
///     _ => None,
/// };
/// let gradient = Formula::read("m*x^2 + 1", &mut symbol)?.differentiated();
/// let mut workspace = Workspace::default();
/// let (value, slopes) = gradient.evaluate(&[2.0], &mut workspace);
/// assert_eq!((value, slopes.collect::<Vec<_>>()), (13.0, vec![(0, 12.0)]));
/// # Ok::<(), affinor::tensors::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    formula: Formula,
    /// The variables with nonzero derivatives, each with the position of the derivative. All other
    /// derivatives are zero.
    slopes: Vec<(usize, usize)>,
}

/// A buffer for the evaluation of formulas. It is reused from one evaluation to the next.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// The values of numbers, variables and results of operations.
    results: Vec<f64>,
    /// The rates of change of the same values.
    rates: Vec<f64>,
}

/// The meaning of a name in a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Symbol {
    /// A constant.
    Number(f64),
    /// The variable with this index.
    Variable(usize),
}

/// An operation on two earlier values; some operations ignore the second value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Operation {
    kind: Kind,
    operands: [usize; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Add,
    Multiply,
    Negate,
    Reciprocal,
    Call(&'static Function),
    CallTwo(&'static FunctionOfTwo),
    /// The product of a derivative and a number. The product is 0 if the derivative is 0, even if
    /// the number is infinite.
    Share,
    /// The slope of a function at its argument. The second operand is the value of the function at
    /// this argument.
    Slope(&'static Function),
    /// The slope of a function of two numbers with respect to the argument at this index.
    SlopeOfTwo(&'static FunctionOfTwo, usize),
}

impl Kind {
    #[inline(always)]
    fn value(self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Kind::Add => a + b,
            Kind::Multiply => a * b,
            Kind::Negate => -a,
            Kind::Reciprocal => 1.0 / a,
            Kind::Call(f) => (f.value)(a),
            Kind::CallTwo(f) => (f.value)(a, b),
            Kind::Share if a == 0.0 => 0.0,
            Kind::Share => a * b,
            Kind::Slope(f) => (f.slope)(a, b),
            Kind::SlopeOfTwo(f, by) => (f.slopes)(a, b)[by],
        }
    }
}

impl Formula {
    /// Parses a formula. The function `variable` returns the index of the variable with a name. The
    /// names `pi` and `tau` are constants.
    ///
    /// # Errors
    /// A syntax error, an unknown name or an unknown function, with its position in the text.
    pub fn parse(
        text: &str,
        variable: &mut dyn FnMut(&str) -> Option<usize>,
    ) -> Result<Self, ExpressionError> {
        Self::read(text, &mut |name| variable(name).map(Symbol::Variable))
    }

    /// Parses a formula as in [`parse`](Self::parse), but names may also be constants.
    ///
    /// # Errors
    /// The errors of [`parse`](Self::parse).
    pub fn read(
        text: &str,
        symbol: &mut dyn FnMut(&str) -> Option<Symbol>,
    ) -> Result<Self, ExpressionError> {
        let reader = Reader { graph: RefCell::default(), symbol: RefCell::new(symbol) };
        let last = Expression::parse(text)?.evaluate(&reader)?;
        Ok(reader.graph.into_inner().formula(last, &mut []))
    }

    /// A formula that is a constant number.
    pub fn number(number: f64) -> Self {
        Formula { numbers: vec![number], variables: vec![], operations: vec![], last: 0 }
    }

    /// The polynomial with these terms, each with a coefficient and the indices of its variables.
    ///
    /// ```
    /// use affinor::mechanics::formula::Formula;
    /// let polynomial = Formula::polynomial(&[(2.0, vec![0, 0]), (-3.0, vec![1]), (5.0, vec![])]);
    /// assert_eq!(polynomial.value(&[4.0, 1.0]), 34.0);
    /// ```
    pub fn polynomial(terms: &[(f64, Vec<usize>)]) -> Self {
        let mut graph = Graph::default();
        let mut last = graph.number(0.0);
        for (at, (coefficient, factors)) in terms.iter().enumerate() {
            let mut term = graph.number(*coefficient);
            for k in factors {
                let variable = graph.push(Node::Variable(*k));
                term = graph.apply(Kind::Multiply, [term, variable]);
            }
            last = if at == 0 { term } else { graph.apply(Kind::Add, [last, term]) };
        }
        graph.formula(last, &mut [])
    }

    /// The value of the formula at these values of the variables.
    pub fn value(&self, variables: &[f64]) -> f64 {
        self.value_in(variables, &mut Workspace::default())
    }

    /// The value as in [`value`](Self::value), computed in a reusable buffer. Once the buffer is
    /// large enough, no memory is allocated.
    #[inline]
    pub fn value_in(&self, variables: &[f64], workspace: &mut Workspace) -> f64 {
        self.evaluate(variables, workspace)[self.last]
    }

    /// Returns the value, and writes its partial derivatives with respect to all variables to
    /// `slopes`. If there are many points, [`differentiated`](Self::differentiated) is faster,
    /// because it prepares the derivatives once.
    pub fn gradient(&self, variables: &[f64], slopes: &mut [f64]) -> f64 {
        let (gradient, mut workspace) = (self.differentiated(), Workspace::default());
        let (value, derivatives) = gradient.evaluate(variables, &mut workspace);
        slopes.fill(0.0);
        derivatives.for_each(|(k, slope)| slopes[k] = slope);
        value
    }

    /// The formula with its partial derivatives, computed by reverse accumulation.
    pub fn differentiated(&self) -> Gradient {
        let numbers = self.numbers.iter().map(|number| Node::Number(number.to_bits()));
        let variables = self.variables.iter().map(|k| Node::Variable(*k));
        let operations = self.operations.iter().map(|operation| Node::Result(*operation));
        let mut graph = Graph::default();
        for (at, node) in numbers.chain(variables).chain(operations).enumerate() {
            assert_eq!(graph.push(node), at, "nodes of a formula are distinct");
        }
        // the derivatives of the value with respect to each node; `None` if the derivative vanishes
        let mut shares = vec![None; graph.nodes.len()];
        shares[self.last] = Some(graph.number(1.0));
        let mut slopes: Vec<(usize, usize)> = vec![];
        for at in (0..shares.len()).rev() {
            let Some(share) = shares[at] else { continue };
            let Operation { kind, operands: [a, b] } = match graph.nodes[at] {
                Node::Number(_) => continue,
                Node::Variable(k) => {
                    match slopes.iter_mut().find(|(known, _)| *known == k) {
                        Some((_, sum)) => *sum = graph.apply(Kind::Add, [*sum, share]),
                        None => slopes.push((k, share)),
                    }
                    continue;
                }
                Node::Result(operation) => operation,
            };
            let mut add = |graph: &mut Graph, operand: usize, part: usize| {
                shares[operand] = Some(match shares[operand] {
                    Some(sum) => graph.apply(Kind::Add, [sum, part]),
                    None => part,
                });
            };
            match kind {
                Kind::Add => {
                    add(&mut graph, a, share);
                    add(&mut graph, b, share);
                }
                Kind::Multiply => {
                    for (operand, other) in [(a, b), (b, a)] {
                        let part = graph.apply(Kind::Share, [share, other]);
                        add(&mut graph, operand, part);
                    }
                }
                Kind::Negate => {
                    let part = graph.apply(Kind::Negate, [share, share]);
                    add(&mut graph, a, part);
                }
                Kind::Reciprocal => {
                    let part = graph.apply(Kind::Share, [share, at]);
                    let part = graph.apply(Kind::Share, [part, at]);
                    let part = graph.apply(Kind::Negate, [part, part]);
                    add(&mut graph, a, part);
                }
                Kind::Call(f) => {
                    let slope = graph.apply(Kind::Slope(f), [a, at]);
                    let part = graph.apply(Kind::Share, [share, slope]);
                    add(&mut graph, a, part);
                }
                Kind::CallTwo(f) => {
                    for (by, operand) in [a, b].into_iter().enumerate() {
                        let slope = graph.apply(Kind::SlopeOfTwo(f, by), [a, b]);
                        let part = graph.apply(Kind::Share, [share, slope]);
                        add(&mut graph, operand, part);
                    }
                }
                // these operations occur only in derivatives, which are not differentiated
                Kind::Share | Kind::Slope(_) | Kind::SlopeOfTwo(..) => {}
            }
        }
        slopes.sort_unstable();
        let formula = graph.formula(self.last, &mut slopes);
        Gradient { formula, slopes }
    }

    /// The indices of the variables that occur in the formula, each once.
    pub fn variables(&self) -> &[usize] {
        &self.variables
    }

    /// The numbers, the variables and the results of all operations.
    #[inline]
    fn evaluate<'w>(&self, variables: &[f64], workspace: &'w mut Workspace) -> &'w [f64] {
        let Formula { numbers, variables: used, operations, .. } = self;
        let first = numbers.len() + used.len();
        let (results, count) = (&mut workspace.results, first + operations.len());
        if results.len() < count {
            results.resize(count, 0.0);
        }
        let results = &mut results[..count];
        results[..numbers.len()].copy_from_slice(numbers);
        for (result, k) in results[numbers.len()..].iter_mut().zip(used) {
            *result = variables[*k];
        }
        for (at, operation) in operations.iter().enumerate() {
            results[first + at] = operation.kind.value(operation.operands.map(|k| results[k]));
        }
        results
    }
}

impl Gradient {
    /// The value at these values of the variables, and the derivatives, each with the index of its
    /// variable. Derivatives that vanish identically are omitted.
    #[inline]
    pub fn evaluate<'g>(
        &'g self,
        variables: &[f64],
        workspace: &'g mut Workspace,
    ) -> (f64, impl Iterator<Item = (usize, f64)> + 'g) {
        let results = self.formula.evaluate(variables, workspace);
        (results[self.formula.last], self.slopes.iter().map(|(k, at)| (*k, results[*at])))
    }
}

/// A number, a variable, or the result of an operation on earlier nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Node {
    /// The bits of a floating-point number.
    Number(u64),
    Variable(usize),
    Result(Operation),
}

/// The nodes of formulas under construction. Each node occurs once, so that repeated subexpressions
/// are computed once.
#[derive(Debug, Default)]
struct Graph {
    nodes: Vec<Node>,
    places: HashMap<Node, usize>,
}

impl Graph {
    /// The position of a node. The node is added unless it is already present.
    fn push(&mut self, node: Node) -> usize {
        let place = *self.places.entry(node).or_insert(self.nodes.len());
        if place == self.nodes.len() {
            self.nodes.push(node);
        }
        place
    }

    fn number(&mut self, number: f64) -> usize {
        self.push(Node::Number(number.to_bits()))
    }

    /// The result of an operation, simplified: a number if both operands are numbers, or the other
    /// factor if one factor is 1.
    fn apply(&mut self, kind: Kind, mut operands: [usize; 2]) -> usize {
        let number = |operand: usize| match self.nodes[operand] {
            Node::Number(bits) => Some(f64::from_bits(bits)),
            _ => None,
        };
        match (kind, operands.map(number)) {
            (_, [Some(a), Some(b)]) => return self.number(kind.value([a, b])),
            (Kind::Share | Kind::Multiply, [Some(1.0), _]) => return operands[1],
            (Kind::Share | Kind::Multiply, [_, Some(1.0)]) => return operands[0],
            (Kind::Add | Kind::Multiply, _) => operands.sort_unstable(),
            _ => {}
        }
        self.push(Node::Result(Operation { kind, operands }))
    }

    /// Builds the formula of a node, with all nodes on which this node and the `outputs` depend.
    /// Each output is a pair of a name and a node; the node is replaced by its position in the
    /// formula.
    fn formula(self, last: usize, outputs: &mut [(usize, usize)]) -> Formula {
        let mut needed = vec![false; self.nodes.len()];
        needed[last] = true;
        outputs.iter().for_each(|(_, node)| needed[*node] = true);
        for (at, node) in self.nodes.iter().enumerate().rev() {
            if let (true, Node::Result(operation)) = (needed[at], node) {
                operation.operands.iter().for_each(|operand| needed[*operand] = true);
            }
        }
        // sorts the nodes: first numbers, then variables
        let rank = |node: &Node| match node {
            Node::Number(_) => 0,
            Node::Variable(_) => 1,
            Node::Result(_) => 2,
        };
        let mut order: Vec<usize> = (0..self.nodes.len()).filter(|at| needed[*at]).collect();
        order.sort_by_key(|at| rank(&self.nodes[*at]));
        let mut places = vec![0; self.nodes.len()];
        order.iter().enumerate().for_each(|(place, at)| places[*at] = place);
        outputs.iter_mut().for_each(|(_, node)| *node = places[*node]);
        let (numbers, variables, operations) = (vec![], vec![], vec![]);
        let mut formula = Formula { numbers, variables, operations, last: places[last] };
        for at in order {
            match self.nodes[at] {
                Node::Number(bits) => formula.numbers.push(f64::from_bits(bits)),
                Node::Variable(k) => formula.variables.push(k),
                Node::Result(Operation { kind, operands }) => {
                    let operands = operands.map(|operand| places[operand]);
                    formula.operations.push(Operation { kind, operands });
                }
            }
        }
        formula
    }
}

/// A function that returns the meaning of a name.
type Symbols<'s> = dyn FnMut(&str) -> Option<Symbol> + 's;

/// An evaluator that records operations instead of computing. Its values are indices of nodes.
struct Reader<'s> {
    graph: RefCell<Graph>,
    symbol: RefCell<&'s mut Symbols<'s>>,
}

impl Reader<'_> {
    fn apply(&self, kind: Kind, operands: [usize; 2]) -> usize {
        self.graph.borrow_mut().apply(kind, operands)
    }
}

impl Evaluator for Reader<'_> {
    type Value = usize;

    fn number(&self, number: &Rational) -> Result<usize, String> {
        let number = f64::from_rational(number).ok_or("it is beyond the range of floats")?;
        Ok(self.graph.borrow_mut().number(number))
    }

    fn name(&self, name: &str) -> Result<usize, String> {
        let symbol = match ((self.symbol.borrow_mut())(name), name) {
            (Some(symbol), _) => symbol,
            (None, "pi") => Symbol::Number(PI),
            (None, "tau") => Symbol::Number(TAU),
            (None, _) => return Err(format!("`{name}` is not a known name here")),
        };
        Ok(self.graph.borrow_mut().push(match symbol {
            Symbol::Number(number) => Node::Number(number.to_bits()),
            Symbol::Variable(k) => Node::Variable(k),
        }))
    }

    fn add(&self, a: usize, b: usize) -> Result<usize, String> {
        Ok(self.apply(Kind::Add, [a, b]))
    }

    fn multiply(&self, a: usize, b: usize) -> Result<usize, String> {
        Ok(self.apply(Kind::Multiply, [a, b]))
    }

    fn negate(&self, a: usize) -> usize {
        self.apply(Kind::Negate, [a, a])
    }

    fn reciprocal(&self, a: usize) -> Result<usize, String> {
        Ok(self.apply(Kind::Reciprocal, [a, a]))
    }

    fn function(&self, name: &str, argument: usize) -> Result<usize, String> {
        match FUNCTIONS.iter().find(|f| f.name == name) {
            Some(function) => Ok(self.apply(Kind::Call(function), [argument, argument])),
            None => {
                let two = FUNCTIONS_OF_TWO.iter().map(|f| f.name);
                let all: Vec<&str> = FUNCTIONS.iter().map(|f| f.name).chain(two).collect();
                Err(format!("`{name}` is not a function: there are {}", all.join(", ")))
            }
        }
    }

    fn call(&self, name: &str, arguments: Vec<usize>) -> Result<usize, String> {
        let of_two = FUNCTIONS_OF_TWO.iter().find(|f| f.name == name);
        let takes = match (of_two, arguments.as_slice()) {
            (None, &[argument]) => return self.function(name, argument),
            (Some(f), [first, others @ ..])
                if others.len() == 1 || (f.folds && others.len() > 1) =>
            {
                let fold = |a, b: &usize| self.apply(Kind::CallTwo(f), [a, *b]);
                return Ok(others.iter().fold(*first, fold));
            }
            (None, several) => {
                several.first().map_or(Ok(0), |first| self.function(name, *first))?;
                "one argument"
            }
            (Some(f), _) if f.folds => "two arguments or more",
            (Some(_), _) => "two arguments",
        };
        Err(format!("`{name}` takes {takes}, not {}", arguments.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Formula {
        let mut symbol = |name: &str| match name {
            "a" => Some(Symbol::Number(1.5)),
            _ => ["x", "y"].iter().position(|known| *known == name).map(Symbol::Variable),
        };
        Formula::read(text, &mut symbol).expect("a formula")
    }

    #[test]
    fn constants_are_computed_once() {
        assert_eq!(read("sin(a*pi)/2 + a"), Formula::number((1.5 * PI).sin() * 0.5 + 1.5));
        let linear = read("a*2*(3*x - sqrt(a)*y) + 1^2");
        assert_eq!(linear.operations.len(), 6);
        // the number of operations remains the same, because the derivatives of a linear formula
        // are constants
        assert_eq!(linear.differentiated().formula.operations.len(), 6);
        let mut slopes = [0.0; 2];
        assert_eq!(linear.gradient(&[f64::MAX, f64::MIN], &mut slopes), f64::INFINITY);
        assert_eq!(slopes, [9.0, -3.0 * 1.5_f64.sqrt()]);
    }

    #[test]
    fn what_repeats_is_computed_once() {
        let formula = read("sin(x*y)/sqrt(x^2 + y^2) + sin(y*x)*(y^2 + x^2)");
        // the operations are x y, sin, x^2, y^2, their sum, sqrt, 1/sqrt, two products, and the sum
        assert_eq!(formula.operations.len(), 10);
        assert_eq!(formula.variables(), [0, 1]);
        let mut slopes = [0.0; 2];
        assert_eq!(read("(x*y)*(x*y)").gradient(&[3.0, 5.0], &mut slopes), 225.0);
        assert_eq!(slopes, [150.0, 90.0]);
    }

    /// The product of zero and an infinite slope is zero, for example in `min(x, 1/y)` at `y = 0`.
    #[test]
    fn zero_times_an_infinite_slope_is_zero() {
        let mut slopes = [f64::NAN; 2];
        assert_eq!(read("step(x)*sqrt(y)*0").gradient(&[-1.0, 0.0], &mut slopes), 0.0);
        assert_eq!(slopes, [0.0, 0.0]);
    }
}
