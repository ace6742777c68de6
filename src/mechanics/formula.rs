//! Formulas in floats that are evaluated many times: torques, potentials, columns of a trajectory.

use affinor_tensors::expression::{Expression, ExpressionError, Meaning};
use affinor_tensors::{Notation, Rational};
use std::cell::RefCell;
use std::f64::consts::{PI, TAU};

/// A formula: a list of operations, each on the results of earlier ones.
///
/// ```
/// use affinor::mechanics::formula::Formula;
/// let names = ["x", "y"];
/// let formula = Formula::parse("x^2*y - sin(pi*y)", &mut |name| names.iter().position(|n| *n == name))?;
/// assert_eq!(formula.value(&[3.0, 2.0]).round(), 18.0);
/// let mut slopes = [0.0; 2];
/// formula.gradient(&[3.0, 2.0], &mut slopes);
/// assert_eq!(slopes[0], 12.0);
/// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    operations: Vec<Operation>,
    /// The numbers of its variables, each once.
    variables: Vec<usize>,
    /// The operation whose result is the value.
    last: usize,
}

/// Buffers for the evaluation of formulas, reused from one evaluation to the next.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// The results of the operations.
    results: Vec<f64>,
    /// The derivatives of the value by these results.
    shares: Vec<f64>,
}

/// An operation; operands are the numbers of earlier operations.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Number(f64),
    Variable(usize),
    Add(usize, usize),
    Multiply(usize, usize),
    Negate(usize),
    Reciprocal(usize),
    Call(&'static Function, usize),
    /// A function of two numbers.
    CallTwo(&'static FunctionOfTwo, usize, usize),
}

/// A function of one number. `slope(x, y)` is its derivative at `x`, where `y` is its value there.
#[derive(Debug)]
struct Function {
    name: &'static str,
    value: fn(f64) -> f64,
    slope: fn(f64, f64) -> f64,
}

/// A function of two numbers. `slopes(x, y)` are its partial derivatives.
#[derive(Debug)]
struct FunctionOfTwo {
    name: &'static str,
    value: fn(f64, f64) -> f64,
    slopes: fn(f64, f64) -> [f64; 2],
    /// Whether it takes longer lists of arguments, two by two.
    folds: bool,
}

// pointers to functions need not be unique
impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl PartialEq for FunctionOfTwo {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The functions of one number that formulas may call. Where there is no derivative, the slope is the mean of those on both
/// sides.
static FUNCTIONS: [Function; 16] = [
    Function { name: "sin", value: f64::sin, slope: |x, _| x.cos() },
    Function { name: "cos", value: f64::cos, slope: |x, _| -x.sin() },
    Function { name: "tan", value: f64::tan, slope: |_, y| 1.0 + y * y },
    Function { name: "asin", value: f64::asin, slope: |x, _| 1.0 / (1.0 - x * x).sqrt() },
    Function { name: "acos", value: f64::acos, slope: |x, _| -1.0 / (1.0 - x * x).sqrt() },
    Function { name: "atan", value: f64::atan, slope: |x, _| 1.0 / (1.0 + x * x) },
    Function { name: "sinh", value: f64::sinh, slope: |x, _| x.cosh() },
    Function { name: "cosh", value: f64::cosh, slope: |x, _| x.sinh() },
    Function { name: "tanh", value: f64::tanh, slope: |_, y| 1.0 - y * y },
    Function { name: "exp", value: f64::exp, slope: |_, y| y },
    Function { name: "log", value: f64::ln, slope: |x, _| 1.0 / x },
    Function { name: "sqrt", value: f64::sqrt, slope: |_, y| 0.5 / y },
    Function { name: "abs", value: f64::abs, slope: |x, _| sign(x) },
    Function { name: "sign", value: sign, slope: |_, _| 0.0 },
    // 1 from 0 on
    Function {
        name: "step",
        value: |x| if x.is_nan() { x } else { f64::from(x >= 0.0) },
        slope: |_, _| 0.0,
    },
    Function { name: "floor", value: f64::floor, slope: |_, _| 0.0 },
];

/// The functions of two numbers that formulas may call.
static FUNCTIONS_OF_TWO: [FunctionOfTwo; 3] = [
    FunctionOfTwo {
        name: "min",
        value: |x, y| if x.is_nan() || x < y { x } else { y },
        slopes: |x, y| selected(x < y, y < x),
        folds: true,
    },
    FunctionOfTwo {
        name: "max",
        value: |x, y| if x.is_nan() || x > y { x } else { y },
        slopes: |x, y| selected(x > y, y > x),
        folds: true,
    },
    FunctionOfTwo {
        name: "atan2",
        value: f64::atan2,
        slopes: |y, x| {
            let square = x * x + y * y;
            [x / square, -y / square]
        },
        folds: false,
    },
];

/// `-1`, `0` or `1`.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// The derivatives by two numbers of the selected one; of neither, their mean.
fn selected(first: bool, second: bool) -> [f64; 2] {
    let share = 0.5 * (1.0 + f64::from(first) - f64::from(second));
    [share, 1.0 - share]
}

impl Formula {
    /// Parses a formula; `variable` gives the number of the variable of a name. `pi` and `tau` are constants.
    ///
    /// # Errors
    /// A syntax error, an unknown name or an unknown function, with its place in the text.
    pub fn parse(
        text: &str,
        variable: &mut dyn FnMut(&str) -> Option<usize>,
    ) -> Result<Self, ExpressionError> {
        let reader = Reader { operations: RefCell::default(), variable: RefCell::new(variable) };
        let last = Expression::parse(text)?.evaluate(&reader)?;
        let operations = reader.operations.into_inner();
        let variable = |operation: &Operation| match operation {
            Operation::Variable(k) => Some(*k),
            _ => None,
        };
        let mut variables: Vec<usize> = operations.iter().filter_map(variable).collect();
        variables.sort_unstable();
        variables.dedup();
        Ok(Formula { operations, variables, last })
    }

    /// The constant formula of a number.
    pub fn number(number: f64) -> Self {
        Formula { operations: vec![Operation::Number(number)], variables: vec![], last: 0 }
    }

    /// The value at given values of the variables.
    pub fn value(&self, variables: &[f64]) -> f64 {
        self.value_in(variables, &mut Workspace::default())
    }

    /// As [`value`](Self::value), with buffers of the caller, so that no memory is allocated once they have grown.
    #[inline]
    pub fn value_in(&self, variables: &[f64], workspace: &mut Workspace) -> f64 {
        self.evaluate(variables, &mut workspace.results);
        workspace.results[self.last]
    }

    /// The value; its partial derivatives by all variables are written to `slopes`.
    pub fn gradient(&self, variables: &[f64], slopes: &mut [f64]) -> f64 {
        self.gradient_in(variables, slopes, &mut Workspace::default())
    }

    /// As [`gradient`](Self::gradient), with buffers of the caller, so that no memory is allocated once they have grown.
    #[inline]
    pub fn gradient_in(
        &self,
        variables: &[f64],
        slopes: &mut [f64],
        workspace: &mut Workspace,
    ) -> f64 {
        let Workspace { results, shares } = workspace;
        self.evaluate(variables, results);
        shares.clear();
        shares.resize(results.len(), 0.0);
        shares[self.last] = 1.0;
        slopes.fill(0.0);
        for (at, operation) in self.operations.iter().enumerate().rev() {
            let share = shares[at];
            // skipped, as 0 times an infinite derivative is NaN
            if share == 0.0 {
                continue;
            }
            match *operation {
                Operation::Number(_) => {}
                Operation::Variable(k) => slopes[k] += share,
                Operation::Add(a, b) => {
                    shares[a] += share;
                    shares[b] += share;
                }
                Operation::Multiply(a, b) => {
                    shares[a] += share * results[b];
                    shares[b] += share * results[a];
                }
                Operation::Negate(a) => shares[a] -= share,
                Operation::Reciprocal(a) => shares[a] -= share * results[at] * results[at],
                Operation::Call(f, a) => shares[a] += share * (f.slope)(results[a], results[at]),
                Operation::CallTwo(f, a, b) => {
                    let [by_a, by_b] = (f.slopes)(results[a], results[b]);
                    shares[a] += share * by_a;
                    shares[b] += share * by_b;
                }
            }
        }
        results[self.last]
    }

    /// The numbers of its variables, each once.
    pub fn variables(&self) -> &[usize] {
        &self.variables
    }

    /// The results of all operations.
    #[inline]
    fn evaluate(&self, variables: &[f64], results: &mut Vec<f64>) {
        results.resize(self.operations.len(), 0.0);
        for (at, operation) in self.operations.iter().enumerate() {
            results[at] = match *operation {
                Operation::Number(number) => number,
                Operation::Variable(k) => variables[k],
                Operation::Add(a, b) => results[a] + results[b],
                Operation::Multiply(a, b) => results[a] * results[b],
                Operation::Negate(a) => -results[a],
                Operation::Reciprocal(a) => 1.0 / results[a],
                Operation::Call(f, a) => (f.value)(results[a]),
                Operation::CallTwo(f, a, b) => (f.value)(results[a], results[b]),
            };
        }
    }
}

/// Gives the number of the variable of a name.
type Variables<'v> = dyn FnMut(&str) -> Option<usize> + 'v;

/// Records operations instead of computing; a value is the number of its operation.
struct Reader<'v> {
    operations: RefCell<Vec<Operation>>,
    variable: RefCell<&'v mut Variables<'v>>,
}

impl Reader<'_> {
    fn push(&self, operation: Operation) -> usize {
        let mut operations = self.operations.borrow_mut();
        operations.push(operation);
        operations.len() - 1
    }
}

impl Meaning for Reader<'_> {
    type Value = usize;

    fn number(&self, number: &Rational) -> Result<usize, String> {
        let number = f64::from_rational(number).ok_or("it is beyond the range of floats")?;
        Ok(self.push(Operation::Number(number)))
    }

    fn name(&self, name: &str) -> Result<usize, String> {
        if let Some(k) = (self.variable.borrow_mut())(name) {
            return Ok(self.push(Operation::Variable(k)));
        }
        match name {
            "pi" => Ok(self.push(Operation::Number(PI))),
            "tau" => Ok(self.push(Operation::Number(TAU))),
            _ => Err(format!("`{name}` is no name here")),
        }
    }

    fn add(&self, a: usize, b: usize) -> Result<usize, String> {
        Ok(self.push(Operation::Add(a, b)))
    }

    fn multiply(&self, a: usize, b: usize) -> Result<usize, String> {
        Ok(self.push(Operation::Multiply(a, b)))
    }

    fn negate(&self, a: usize) -> usize {
        self.push(Operation::Negate(a))
    }

    fn reciprocal(&self, a: usize) -> Result<usize, String> {
        Ok(self.push(Operation::Reciprocal(a)))
    }

    fn function(&self, name: &str, argument: usize) -> Result<usize, String> {
        match FUNCTIONS.iter().find(|f| f.name == name) {
            Some(function) => Ok(self.push(Operation::Call(function, argument))),
            None => {
                let two = FUNCTIONS_OF_TWO.iter().map(|f| f.name);
                let all: Vec<&str> = FUNCTIONS.iter().map(|f| f.name).chain(two).collect();
                Err(format!("`{name}` is no function: there are {}", all.join(", ")))
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
                let fold = |a, b: &usize| self.push(Operation::CallTwo(f, a, *b));
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
