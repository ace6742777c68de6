//! A scalar that records its computation as a graph of operations.
//!
//! Any formula for a [`Field`] accepts this scalar. The result is a straight-line program
//! ([`StraightLine`]) that evaluates the formula for numbers.

mod derivative;
mod image;
mod operators;
mod solution;
mod straight_line;

use super::{
    Field, Kind, Notation, Rational, Ring, Sum, Summable, Symbolic, Tabular, Tolerance, Variable,
};
use crate::expression::is_name;
use crate::function::{Function, is_elementary};
use crate::linear::Matrix;
use crate::stop::checkpoint;
use image::Image;
use num_traits::{One, Zero};
use solution::Solution;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt;
use std::sync::Arc;

pub use derivative::derivatives;
pub use straight_line::{Count, Output, Step, StraightLine};

/// A value that is represented by the operations that compute it from named inputs.
///
/// A value is a rational factor times a node of the graph. Constants are combined, and common
/// rational factors are taken out of sums; nothing is expanded.
///
/// Every value has an image, which is its value at a fixed point modulo two primes. Values with
/// different images are different. Values with equal images count as equal, even if their
/// operations differ: the probability that two different values of degree `d` have the same image
/// is below `d^2 / 2^122`. Therefore, sums that cancel are zero, as in [`Symbolic`], but no
/// denominators and gcds are computed. Logarithms and roots are identified by their whole argument:
/// `log(x) + log(1/x)` does not cancel.
///
/// A program chooses the pivots of inverses and linear systems by comparisons ([`Step::Select`]).
///
/// ```
/// use affinor_tensors::{Field, Notation, Rational, Recorded, scalar::StraightLine};
/// let [a, b] = ["a", "b"].map(|name| Recorded::parameter(name).unwrap());
/// let ratio = (a.clone() * &a - &(b.clone() * &b)) * &(a.clone() - &b).recip().unwrap();
/// assert_eq!(ratio, a + &b);
/// let program = StraightLine::new(&[ratio]);
/// assert_eq!(program.inputs().map(|input| input.text()).collect::<Vec<_>>(), ["a", "b"]);
/// let value = |name: &str| Rational::from(if name == "a" { 5 } else { 3 });
/// assert_eq!(program.evaluate(value, |_, x| x.clone()), Some(vec![Rational::from(8)]));
/// ```
#[derive(Clone)]
pub struct Recorded {
    factor: Rational,
    /// The node; `None` for a constant, whose value is the factor.
    node: Option<Arc<Node>>,
}

/// An operation, and the image of its result. The image is `None` if it proves nothing.
struct Node {
    operation: Operation,
    image: Option<Image>,
}

enum Operation {
    Input(Variable),
    Function(Function, Arc<Node>),
    /// The sum of a constant and of multiples of other nodes.
    Sum(Rational, Vec<(Rational, Arc<Node>)>),
    Product(Arc<Node>, Arc<Node>),
    Reciprocal(Arc<Node>),
    /// The third value if the size of the first value is at least the size of the second; otherwise
    /// the fourth value.
    Select(Box<[Recorded; 4]>),
    /// A component of the solution of a linear system. Its value is computed by elimination, but
    /// its image is the image of the exact solution.
    Solution(Arc<Solution>, usize),
}

impl Operation {
    /// The nodes that a program needs to compute the result of the operation.
    fn operands(&self) -> Vec<&Arc<Node>> {
        match self {
            Operation::Input(_) => vec![],
            Operation::Sum(_, terms) => terms.iter().map(|(_, node)| node).collect(),
            Operation::Product(a, b) => vec![a, b],
            Operation::Reciprocal(a) | Operation::Function(_, a) => vec![a],
            Operation::Select(values) => values.iter().filter_map(|v| v.node.as_ref()).collect(),
            Operation::Solution(solution, i) => solution.eliminated(*i).node.iter().collect(),
        }
    }

    /// The nodes on which the result depends as a mathematical function.
    fn arguments(&self) -> Vec<&Arc<Node>> {
        match self {
            Operation::Solution(solution, _) => solution.arguments().collect(),
            _ => self.operands(),
        }
    }
}

/// Frees long chains of nodes in a loop, because a recursion could overflow the stack.
impl Drop for Node {
    fn drop(&mut self) {
        let taken = |operation: &mut Operation| {
            let empty = Operation::Sum(Rational::zero(), vec![]);
            match std::mem::replace(operation, empty) {
                Operation::Input(_) => vec![],
                Operation::Sum(_, terms) => terms.into_iter().map(|(_, node)| node).collect(),
                Operation::Product(a, b) => vec![a, b],
                Operation::Reciprocal(a) | Operation::Function(_, a) => vec![a],
                Operation::Select(values) => values.into_iter().filter_map(|v| v.node).collect(),
                // systems that contain other systems are freed recursively
                Operation::Solution(..) => vec![],
            }
        };
        let mut open = taken(&mut self.operation);
        while let Some(node) = open.pop() {
            if let Some(mut node) = Arc::into_inner(node) {
                open.append(&mut taken(&mut node.operation));
            }
        }
    }
}

/// The identity of a node, up to sign. It is the image of the node or, if there is no image, its
/// memory address.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Key {
    Image(Image),
    Place(*const Node),
}

impl Node {
    /// The key of the node, and whether the node is the negative of the value with this key.
    fn key(self: &Arc<Self>) -> (Key, bool) {
        match self.image {
            Some(image) => {
                let negative = image.negated();
                if negative < image {
                    (Key::Image(negative), true)
                } else {
                    (Key::Image(image), false)
                }
            }
            None => (Key::Place(Arc::as_ptr(self)), false),
        }
    }
}

/// Lists all nodes below the given nodes. Each node occurs once, after its operands, which `below`
/// returns.
fn post_order<'n>(
    roots: impl IntoIterator<Item = &'n Arc<Node>>,
    below: impl Fn(&'n Operation) -> Vec<&'n Arc<Node>>,
) -> Vec<&'n Arc<Node>> {
    let mut seen = std::collections::HashSet::new();
    let mut order = vec![];
    for root in roots {
        let mut open = vec![(root, false)];
        while let Some((node, done)) = open.pop() {
            if done {
                order.push(node);
            } else if seen.insert(Arc::as_ptr(node)) {
                open.push((node, true));
                open.extend(below(&node.operation).into_iter().rev().map(|node| (node, false)));
            }
        }
    }
    order
}

impl Recorded {
    fn constant(factor: Rational) -> Self {
        Recorded { factor, node: None }
    }

    fn of(operation: Operation, image: Option<Image>) -> Self {
        checkpoint();
        match image.and_then(Image::certain) {
            Some(Image::ZERO) => Self::zero(),
            Some(Image::ONE) => Self::one(),
            image => {
                let node = Some(Arc::new(Node { operation, image }));
                Recorded { factor: Rational::one(), node }
            }
        }
    }

    /// The input with this name. A name may be any text.
    pub fn input(name: &str) -> Self {
        Self::variable(Variable::parameter(name))
    }

    /// The parameter or free function, if the value is a single input; `None` for any other value.
    pub fn as_input(&self) -> Option<Variable> {
        match (&self.node.as_ref()?.operation, self.factor.is_one()) {
            (Operation::Input(variable), true) => Some(*variable),
            _ => None,
        }
    }

    /// The input that represents a parameter or a free function.
    fn variable(variable: Variable) -> Self {
        Self::of(Operation::Input(variable), Some(Image::variable(variable.text())))
    }

    /// The value `constant + sum of factor * node`. Equal nodes are collected, and the common
    /// factor is taken out.
    fn combination(constant: Rational, terms: Vec<(Rational, Arc<Node>)>) -> Self {
        let mut collected: Vec<(Rational, Arc<Node>)> = Vec::with_capacity(terms.len());
        let mut places = HashMap::with_capacity(terms.len());
        for (factor, node) in terms {
            let (key, negative) = node.key();
            let signed =
                |factor: Rational, other: bool| if negative == other { factor } else { -factor };
            match places.entry(key) {
                Entry::Vacant(place) => {
                    place.insert((collected.len(), negative));
                    collected.push((factor, node));
                }
                Entry::Occupied(place) => {
                    let (at, other) = *place.get();
                    collected[at].0 += signed(factor, other);
                }
            }
        }
        collected.retain(|(factor, _)| !factor.vanishes());
        if collected.is_empty() {
            return Self::constant(constant);
        }
        let content = Rational::content(collected.iter().map(|(factor, _)| factor));
        let inverse = Rational::one() / &content;
        let constant = constant * &inverse;
        collected.iter_mut().for_each(|(factor, _)| *factor *= &inverse);
        if let ([(_, node)], true) = (collected.as_slice(), constant.vanishes()) {
            return Recorded { factor: content, node: Some(node.clone()) };
        }
        let image = collected.iter().try_fold(Image::rational(&constant), |sum, (factor, node)| {
            let term = Image::rational(factor).zip(node.image).map(|(a, b)| a.mul(b));
            Some(sum.zip(term).map(|(a, b)| a.add(b)))
        });
        let sum = Self::of(Operation::Sum(constant, collected), image.flatten());
        sum.scaled(&content)
    }

    /// The image of the value, which is the product of the images of the factor and the node.
    fn image(&self) -> Option<Image> {
        let own = self.node.as_ref().map_or(Some(Image::ONE), |node| node.image);
        Image::rational(&self.factor).zip(own).map(|(factor, own)| factor.mul(own))
    }

    /// The value `x` if the size of `a` is at least the size of `b`; otherwise the value `y`. Its
    /// image is unrelated to all other images, except for those of equal choices.
    fn select([a, b, x, y]: [&Self; 4]) -> Self {
        let key = |value: &Self| (value.factor.clone(), value.node.as_ref().map(Node::key));
        if b.vanishes() || key(x) == key(y) {
            return x.clone();
        }
        if a.vanishes() {
            return y.clone();
        }
        if a.node.is_none() && b.node.is_none() {
            let first = a.factor.clone().abs() >= b.factor.clone().abs();
            return if first { x.clone() } else { y.clone() };
        }
        let image = a.image().zip(b.image()).zip(x.image().zip(y.image()));
        let image = image.map(|((a, b), (x, y))| {
            Image::named("select", &[a.up_to_sign(), b.up_to_sign(), x, y])
        });
        Self::of(Operation::Select(Box::new([a, b, x, y].map(Self::clone))), image)
    }

    /// A function of a value.
    fn of_function(function: Function, argument: &Self) -> Self {
        let (zero, one) = (Rational::zero(), Rational::one());
        let node = match &argument.node {
            Some(node) if argument.factor.is_one() => node.clone(),
            node => {
                let (constant, terms) = match node {
                    None => (argument.factor.clone(), vec![]),
                    Some(node) => (Rational::zero(), vec![(argument.factor.clone(), node.clone())]),
                };
                let image = argument.image();
                Arc::new(Node { operation: Operation::Sum(constant, terms), image })
            }
        };
        // splits an angle into its terms, because the image of each term determines the functions
        // of its multiples
        let flat = match &node.operation {
            Operation::Sum(constant, terms) => Some((constant, &terms[..])),
            _ => None,
        };
        let single = [(one, node.clone())];
        let (constant, terms) = flat.unwrap_or((&zero, &single[..]));
        let multiples = terms.iter().map(|(factor, node)| {
            let (key, negative) = node.key();
            let Key::Image(image) = key else { return None };
            Some((if negative { -factor.clone() } else { factor.clone() }, image))
        });
        let constant = (!constant.vanishes()).then(|| Some((constant.clone(), Image::ONE)));
        let multiples: Option<Vec<_>> = multiples.chain(constant).collect();
        let image = multiples.and_then(|multiples| match function {
            Function::Log | Function::Sqrt => Some(Image::named(function.name(), &[node.image?])),
            _ => Image::function(function, &multiples),
        });
        Self::of(Operation::Function(function, node), image)
    }

    fn scaled(self, factor: &Rational) -> Self {
        if factor.vanishes() {
            return Self::zero();
        }
        Recorded { factor: self.factor * factor, node: self.node }
    }

    /// The terms of the value, as a sum. If nothing else uses the sum, its terms are moved out of
    /// it.
    fn into_terms(self) -> (Rational, Vec<(Rational, Arc<Node>)>) {
        let Recorded { factor, node } = self;
        let Some(mut node) = node else { return (factor, vec![]) };
        if let Some(Node { operation: Operation::Sum(constant, terms), .. }) =
            Arc::get_mut(&mut node)
        {
            let (constant, terms) = (constant.clone() * &factor, std::mem::take(terms));
            return (constant, terms.into_iter().map(|(c, node)| (c * &factor, node)).collect());
        }
        (Rational::zero(), vec![(factor, node)])
    }
}

impl Ring for Recorded {
    fn from_i64(n: i64) -> Self {
        Self::constant(n.into())
    }
    fn vanishes(&self) -> bool {
        self.factor.vanishes()
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        Rational::new(numerator, denominator).map(Self::constant)
    }
}

impl Summable for Recorded {
    type Sum = RecordedSum;
    fn solved(matrix: &Matrix<Self>, right: &Matrix<Self>) -> Option<Matrix<Self>> {
        solution::solved(matrix, right)
    }
    fn clear_denominators<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<i64>, i64)> {
        let constant = |value: &'a Self| value.node.is_none().then_some(&value.factor);
        let constants: Vec<_> = values.map(constant).collect::<Option<_>>()?;
        Rational::clear_denominators(constants.into_iter())
    }
}

impl Field for Recorded {
    fn recip(&self) -> Option<Self> {
        let factor = self.factor.recip()?;
        Some(match &self.node {
            None => Self::constant(factor),
            Some(node) => match &node.operation {
                Operation::Reciprocal(inner) => Recorded { factor, node: Some(inner.clone()) },
                // rewrites 1/sqrt(p), so that a product contains each root once, and sums of such
                // products cancel
                Operation::Function(Function::Sqrt, argument) => {
                    let argument =
                        Recorded { factor: Rational::one(), node: Some(argument.clone()) };
                    Recorded { factor, node: Some(node.clone()) } * &argument.recip()?
                }
                _ => {
                    let image = node.image.and_then(Image::recip);
                    Self::of(Operation::Reciprocal(node.clone()), image).scaled(&factor)
                }
            },
        })
    }
    /// The weight of the value as a pivot. Constants are better pivots than values that may vanish
    /// for some inputs.
    fn pivot_weight(&self) -> f64 {
        if self.node.is_none() { 1.0 } else { 0.0 }
    }
}

/// A sum, which becomes one operation when it is complete.
#[derive(Clone, Default)]
pub struct RecordedSum {
    constant: Rational,
    terms: Vec<(Rational, Arc<Node>)>,
}

impl RecordedSum {
    fn add(&mut self, Recorded { factor, node }: Recorded) {
        match node {
            None => self.constant += factor,
            Some(node) => self.terms.push((factor, node)),
        }
    }
}

impl Sum<Recorded> for RecordedSum {
    fn add_term(&mut self, a: &Recorded) {
        self.add(a.clone());
    }
    fn add_product(&mut self, a: &Recorded, b: &Recorded) {
        self.add(a.clone() * b);
    }
    fn finish(&self, _: Tolerance) -> Option<Recorded> {
        let value = Recorded::combination(self.constant.clone(), self.terms.clone());
        (!value.vanishes()).then_some(value)
    }
}

impl Notation for Recorded {
    const KIND: Kind = Kind::Symbolic;
    fn from_rational(value: &Rational) -> Option<Self> {
        Some(Self::constant(value.clone()))
    }
    fn parameter(name: &str) -> Option<Self> {
        is_name(name).then(|| Self::input(name))
    }
    fn parameters(&self) -> Vec<String> {
        let name = |node: &Arc<Node>| match &node.operation {
            Operation::Input(variable) => Some(variable.to_string()),
            _ => None,
        };
        let mut names: Vec<_> =
            post_order(&self.node, Operation::arguments).into_iter().filter_map(name).collect();
        names.sort();
        names.dedup();
        names
    }
    /// An elementary function of any value.
    ///
    /// Functions of sums of angles and of exponents satisfy the addition theorems. Roots and
    /// logarithms of different values count as independent.
    fn function(name: &str, argument: &Self) -> Result<Self, String> {
        let of = |function| Self::of_function(function, argument);
        let ratio = |above: Function, below: Function| match of(below).recip() {
            Some(below) => Ok(of(above) * &below),
            None => Err(format!("the function `{name}` has a pole at its argument")),
        };
        match Function::from_name(name) {
            Some(Function::Tan) => ratio(Function::Sin, Function::Cos),
            Some(function) => Ok(of(function)),
            None if name == "cot" => ratio(Function::Cos, Function::Sin),
            None => Err(format!("the function `{name}` cannot be written in a program")),
        }
    }
    /// Free functions of inputs, such as `a(t)` and `a_t(t)`, are inputs too.
    fn call(name: &str, arguments: &[Self]) -> Result<Self, String> {
        if let ([argument], true) = (arguments, is_elementary(name)) {
            return Self::function(name, argument);
        }
        let input = |value: &Self| value.as_input().map(Symbolic::variable);
        let inputs = arguments.iter().map(input).collect::<Option<Vec<_>>>();
        let inputs = inputs
            .ok_or_else(|| format!("each argument of `{name}` must be a name in a program"))?;
        Self::try_from(&<Symbolic as Notation>::call(name, &inputs)?)
    }
    fn derivative(&self, name: &str) -> Self {
        derivatives(std::slice::from_ref(self), name).pop().unwrap_or_default()
    }
    fn to_f64(&self) -> Option<f64> {
        self.node.is_none().then(|| self.factor.to_f64())
    }
    fn latex(&self) -> String {
        self.to_string()
    }
    fn size(&self) -> usize {
        if self.node.is_none() { self.factor.size() } else { 1 }
    }
}

impl Tabular for Recorded {}

impl TryFrom<&Symbolic> for Recorded {
    type Error = String;
    /// Records the written form of a value, which contains sines and cosines.
    ///
    /// # Errors
    /// A message if the value exceeds the limits of [expressions](crate::expression).
    fn try_from(value: &Symbolic) -> Result<Self, String> {
        value.in_scalars(&Self::variable)
    }
}

/// Writes the operations. Operations that are nested deeper than a few levels are omitted.
impl fmt::Display for Recorded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&operators::written(self, 4))
    }
}

impl fmt::Debug for Recorded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
