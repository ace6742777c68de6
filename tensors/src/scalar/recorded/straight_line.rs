//! Straight-line programs. They contain the operations of recorded values, each once and in order.

use super::{Function, Key, Operation, Recorded, Variable, post_order};
use crate::{Field, Rational};
use num_traits::{One, Zero};
use std::collections::HashMap;
use std::sync::Arc;

/// A straight-line program. It consists of steps that use earlier steps, and of outputs that are
/// multiples of steps.
///
/// Values that are equal up to sign are computed only once. Every step contributes to an output.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightLine {
    steps: Vec<Step>,
    outputs: Vec<Output>,
}

/// One operation. Its operands are the numbers of earlier steps.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// An input: a parameter, or a free function.
    Input(Variable),
    /// A function of a step.
    Function(Function, usize),
    /// The sum of a constant and of multiples of steps.
    Sum(Rational, Vec<(Rational, usize)>),
    /// The product of two steps.
    Product(usize, usize),
    /// The reciprocal of a step.
    Reciprocal(usize),
    /// The third value if the size of the first value is at least the size of the second; otherwise
    /// the fourth value.
    Select(Box<[Output; 4]>),
}

impl Step {
    /// The steps that this step uses. A square uses its operand twice.
    pub fn operands(&self) -> Vec<usize> {
        match self {
            Step::Input(_) => vec![],
            Step::Sum(_, terms) => terms.iter().map(|(_, at)| *at).collect(),
            Step::Product(a, b) => vec![*a, *b],
            Step::Reciprocal(a) | Step::Function(_, a) => vec![*a],
            Step::Select(values) => values.iter().filter_map(|value| value.step).collect(),
        }
    }

    fn renumber(&mut self, f: impl Fn(usize) -> usize) {
        match self {
            Step::Input(_) => {}
            Step::Sum(_, terms) => terms.iter_mut().for_each(|(_, at)| *at = f(*at)),
            Step::Product(a, b) => (*a, *b) = (f(*a), f(*b)),
            Step::Reciprocal(a) | Step::Function(_, a) => *a = f(*a),
            Step::Select(values) => {
                values.iter_mut().for_each(|value| value.step = value.step.map(&f));
            }
        }
    }
}

/// A constant, or a multiple of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The factor, or the constant.
    pub factor: Rational,
    /// The step; `None` if the output is a constant.
    pub step: Option<usize>,
}

/// The numbers of operations of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications, including those by constants.
    pub multiplications: usize,
    /// Divisions.
    pub divisions: usize,
    /// Calls of elementary functions.
    pub functions: usize,
    /// Comparisons of sizes.
    pub comparisons: usize,
}

/// For each value, the step that computes it, and whether the step is negated.
type Known = HashMap<Key, (usize, bool)>;

/// A value as a multiple of a step.
fn output(value: &Recorded, known: &Known) -> Output {
    let factor = value.factor.clone();
    let Some(node) = &value.node else { return Output { factor, step: None } };
    let (key, negative) = node.key();
    let (at, other) = known[&key];
    Output { factor: if negative != other { -factor } else { factor }, step: Some(at) }
}

impl StraightLine {
    /// The program that computes these values.
    pub fn new(values: &[Recorded]) -> Self {
        let mut known = Known::new();
        let mut steps: Vec<Step> = vec![];
        let roots = values.iter().filter_map(|value| value.node.as_ref());
        for node in post_order(roots, Operation::operands) {
            let (key, negative) = node.key();
            if known.contains_key(&key) {
                continue;
            }
            let place = |node: &Arc<super::Node>| {
                let (key, negative) = node.key();
                let (at, other) = known[&key];
                (at, negative != other)
            };
            let (step, negated) = match &node.operation {
                Operation::Input(variable) => (Step::Input(*variable), false),
                Operation::Function(function, a) => {
                    let (mut at, minus) = place(a);
                    if minus {
                        steps.push(Step::Sum(Rational::zero(), vec![(-Rational::one(), at)]));
                        at = steps.len() - 1;
                    }
                    (Step::Function(*function, at), false)
                }
                Operation::Sum(constant, terms) => {
                    let terms = terms.iter().map(|(factor, node)| {
                        let (at, negated) = place(node);
                        (if negated { -factor.clone() } else { factor.clone() }, at)
                    });
                    (Step::Sum(constant.clone(), terms.collect()), false)
                }
                Operation::Product(a, b) => {
                    let ((a, minus), (b, other)) = (place(a), place(b));
                    (Step::Product(a, b), minus != other)
                }
                Operation::Reciprocal(a) => {
                    let (a, minus) = place(a);
                    (Step::Reciprocal(a), minus)
                }
                Operation::Select(values) => {
                    let mut values = values.each_ref().map(|value| output(value, &known));
                    for size in &mut values[..2] {
                        size.factor = size.factor.clone().abs();
                    }
                    (Step::Select(Box::new(values)), false)
                }
                Operation::Solution(solution, i) => {
                    let Output { factor, step } = output(solution.eliminated(*i), &known);
                    if let (Some(at), true) = (step, factor.clone().abs().is_one()) {
                        known.insert(key, (at, negative != factor.is_negative()));
                        continue;
                    }
                    (
                        Step::Sum(
                            Rational::zero(),
                            step.map(|at| (factor, at)).into_iter().collect(),
                        ),
                        false,
                    )
                }
            };
            known.insert(key, (steps.len(), negative != negated));
            steps.push(step);
        }
        let outputs = values.iter().map(|value| output(value, &known)).collect();
        StraightLine { steps, outputs }.without_dead_steps()
    }

    fn without_dead_steps(mut self) -> Self {
        let mut used = vec![false; self.steps.len()];
        self.outputs.iter().filter_map(|output| output.step).for_each(|at| used[at] = true);
        for at in (0..self.steps.len()).rev() {
            if used[at] {
                self.steps[at].operands().into_iter().for_each(|at| used[at] = true);
            }
        }
        let mut next = 0;
        let places: Vec<usize> = used
            .iter()
            .map(|used| {
                next += usize::from(*used);
                next.saturating_sub(1)
            })
            .collect();
        let mut kept = used.iter();
        self.steps.retain(|_| kept.next() == Some(&true));
        self.steps.iter_mut().for_each(|step| step.renumber(|at| places[at]));
        for output in &mut self.outputs {
            output.step = output.step.map(|at| places[at]);
        }
        self
    }

    /// The steps, in order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The outputs, in the order of the values.
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// The inputs, sorted by their text.
    pub fn inputs(&self) -> impl Iterator<Item = Variable> {
        let inputs = self.steps.iter().filter_map(|step| match step {
            Step::Input(variable) => Some((variable.text(), *variable)),
            _ => None,
        });
        inputs.collect::<std::collections::BTreeMap<_, _>>().into_values()
    }

    /// For each step, the number of times that other steps and outputs use it.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.steps.len()];
        let operands = self.steps.iter().flat_map(Step::operands);
        operands.chain(self.outputs.iter().filter_map(|o| o.step)).for_each(|at| uses[at] += 1);
        uses
    }

    /// Counts the operations.
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        let plain = |factor: &Rational| factor.clone().abs().is_one();
        let scaled = |output: &Output| output.step.is_some() && !plain(&output.factor);
        for step in &self.steps {
            match step {
                Step::Input(_) => {}
                Step::Function(..) => count.functions += 1,
                Step::Sum(constant, terms) => {
                    let constant = usize::from(!constant.is_zero());
                    count.additions += (terms.len() + constant).saturating_sub(1);
                    count.multiplications +=
                        terms.iter().filter(|(factor, _)| !plain(factor)).count();
                }
                Step::Product(..) => count.multiplications += 1,
                Step::Reciprocal(_) => count.divisions += 1,
                Step::Select(values) => {
                    count.comparisons += 1;
                    count.multiplications += values.iter().filter(|v| scaled(v)).count();
                }
            }
        }
        count.multiplications += self.outputs.iter().filter(|output| scaled(output)).count();
        count
    }

    /// Evaluates the outputs over any field. The parameter `function` computes the values of
    /// functions. Sizes are compared by [`pivot_weight`](Field::pivot_weight), and zero is the
    /// smallest size.
    ///
    /// Returns `None` if a divisor is not a unit, or if a constant does not exist in the field.
    pub fn evaluate<S: Field>(
        &self,
        input: impl Fn(&str) -> S,
        function: impl Fn(Function, &S) -> S,
    ) -> Option<Vec<S>> {
        let mut values: Vec<S> = Vec::with_capacity(self.steps.len());
        let output = |output: &Output, values: &[S]| {
            let factor = constant_in::<S>(&output.factor)?;
            Some(match output.step {
                None => factor,
                Some(at) => factor * &values[at],
            })
        };
        for step in &self.steps {
            let value = match step {
                Step::Input(variable) => input(variable.text()),
                Step::Function(f, a) => function(*f, &values[*a]),
                Step::Sum(constant, terms) => {
                    let mut sum = constant_in(constant)?;
                    for (factor, at) in terms {
                        let term = constant_in::<S>(factor)? * &values[*at];
                        sum = term + &sum;
                    }
                    sum
                }
                Step::Product(a, b) => values[*a].clone() * &values[*b],
                Step::Reciprocal(a) => values[*a].recip()?,
                Step::Select(choice) => {
                    let [a, b, x, y] = &**choice;
                    let [a, b] = [output(a, &values)?, output(b, &values)?];
                    let second = a.vanishes() || a.pivot_weight() < b.pivot_weight();
                    output(if second && !b.vanishes() { y } else { x }, &values)?
                }
            };
            values.push(value);
        }
        self.outputs.iter().map(|own| output(own, &values)).collect()
    }
}

impl StraightLine {
    /// The first operation that has no finite value for these inputs, as text such as
    /// `division by zero` or `log(-1)`.
    ///
    /// ```
    /// use affinor_tensors::{Notation, Recorded, scalar::StraightLine};
    /// let x = Recorded::parameter("x").unwrap();
    /// let program = StraightLine::new(&[Recorded::function("log", &x)?]);
    /// assert_eq!(program.failure(|_| -2.0), Some("log(-2)".into()));
    /// assert_eq!(program.failure(|_| 2.0), None);
    /// # Ok::<(), String>(())
    /// ```
    pub fn failure(&self, input: impl Fn(&str) -> f64) -> Option<String> {
        let mut values: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let of =
                |value: &Output| value.factor.to_f64() * value.step.map_or(1.0, |at| values[at]);
            let value = match step {
                Step::Input(variable) => input(variable.text()),
                Step::Function(function, a) => function.value(values[*a]),
                Step::Sum(constant, terms) => {
                    let terms = terms.iter().map(|(factor, at)| factor.to_f64() * values[*at]);
                    constant.to_f64() + terms.sum::<f64>()
                }
                Step::Product(a, b) => values[*a] * values[*b],
                Step::Reciprocal(a) => 1.0 / values[*a],
                Step::Select(choice) => {
                    let [a, b, x, y] = &**choice;
                    of(if of(b).abs() > of(a).abs() { y } else { x })
                }
            };
            if !value.is_finite() {
                return Some(match step {
                    Step::Input(variable) => format!("{variable} = {value}"),
                    Step::Reciprocal(a) if values[*a] == 0.0 => "division by zero".into(),
                    Step::Function(function, a) if value.is_nan() || values[*a] == 0.0 => {
                        format!("{function}({})", values[*a])
                    }
                    _ => BEYOND.into(),
                });
            }
            values.push(value);
        }
        let beyond = |value: &Output| {
            let value = value.factor.to_f64() * value.step.map_or(1.0, |at| values[at]);
            !value.is_finite()
        };
        self.outputs.iter().any(beyond).then(|| BEYOND.into())
    }
}

/// The text for an overflow.
const BEYOND: &str = "a number beyond the range of floats";

/// Converts a rational number to a field.
fn constant_in<S: Field>(value: &Rational) -> Option<S> {
    if let Ok(words) = num_rational::Ratio::<i64>::try_from(value) {
        return S::from_quotient(*words.numer(), *words.denom());
    }
    // converts digit by digit, in base 2^32
    let big = num_rational::BigRational::from(value);
    let integer = |n: &num_bigint::BigInt| {
        let base = S::from_i64(1 << 32);
        let digits = n.magnitude().iter_u32_digits().rev();
        let size = digits.fold(S::zero(), |sum, digit| sum * &base + &S::from_i64(digit.into()));
        if n.sign() == num_bigint::Sign::Minus { -size } else { size }
    };
    Some(integer(big.numer()) * &integer(big.denom()).recip()?)
}
