//! Partial derivatives of recorded values, computed in forward mode.

use super::{Function, Node, Operation, Recorded, Solution, post_order};
use crate::scalar::{Field, Sum, Symbolic, Tolerance};
use num_traits::{One, Zero};
use std::collections::HashMap;
use std::sync::Arc;

/// The partial derivatives of several values with respect to the input `name`.
///
/// The derivative of a common subexpression is recorded once.
///
/// ```
/// use affinor_tensors::{Notation, Recorded, scalar::derivatives};
/// let [x, y] = ["x", "y"].map(|name| Recorded::parameter(name).unwrap());
/// let square = x.clone() * &x;
/// assert_eq!(derivatives(&[square.clone() * &y, square.clone()], "y"), [square, 0.into()]);
/// ```
pub fn derivatives(values: &[Recorded], name: &str) -> Vec<Recorded> {
    let roots = values.iter().filter_map(|value| value.node.as_ref());
    let mut known: HashMap<*const Node, Recorded> = HashMap::new();
    let mut solutions: HashMap<*const Solution, Vec<Recorded>> = HashMap::new();
    for node in post_order(roots, Operation::arguments) {
        let rate = rate(node, name, &|node| known.get(&Arc::as_ptr(node)), &mut solutions);
        if !rate.factor.is_zero() {
            known.insert(Arc::as_ptr(node), rate);
        }
    }
    let of = |node: &Arc<Node>| known.get(&Arc::as_ptr(node));
    values.iter().map(|value| of_value(value, &of)).collect()
}

/// The derivative of a value. The function `of` returns the derivative of a node, or `None` if it
/// vanishes.
fn of_value<'k>(value: &Recorded, of: &dyn Fn(&Arc<Node>) -> Option<&'k Recorded>) -> Recorded {
    let rate = value.node.as_ref().and_then(of);
    rate.map_or_else(Recorded::zero, |rate| rate.clone().scaled(&value.factor))
}

/// The derivative of a node. The function `of` returns the derivative of an argument, or `None` if
/// it vanishes. The parameter `solutions` caches the derivatives of the components of a solution,
/// which are computed together.
fn rate<'k>(
    node: &Arc<Node>,
    name: &str,
    of: &dyn Fn(&Arc<Node>) -> Option<&'k Recorded>,
    solutions: &mut HashMap<*const Solution, Vec<Recorded>>,
) -> Recorded {
    let value = |node: &Arc<Node>| Recorded { factor: One::one(), node: Some(node.clone()) };
    match &node.operation {
        Operation::Input(own) if own.text() == name => Recorded::one(),
        Operation::Function(function, argument) => {
            let Some(rate) = of(argument) else { return Recorded::zero() };
            let argument = value(argument);
            let own = value(node);
            let of = |function| Recorded::of_function(function, &argument);
            let slope = match function {
                Function::Sin => of(Function::Cos),
                Function::Cos => -of(Function::Sin),
                Function::Tan => own.clone() * &own + &Recorded::one(),
                Function::Exp => own,
                Function::Sinh => of(Function::Cosh),
                Function::Cosh => of(Function::Sinh),
                Function::Tanh => {
                    let secant = of(Function::Cosh).recip().unwrap_or_default();
                    secant.clone() * &secant
                }
                Function::Log => argument.recip().unwrap_or_default(),
                Function::Sqrt => (own.clone() + &own).recip().unwrap_or_default(),
            };
            rate.clone() * &slope
        }
        Operation::Input(own) => {
            let derivative = Symbolic::variable(*own).derivative(name);
            Recorded::try_from(&derivative).unwrap_or_default()
        }
        Operation::Sum(_, terms) => {
            let rates =
                terms.iter().filter_map(|(factor, node)| Some(of(node)?.clone().scaled(factor)));
            total(rates)
        }
        Operation::Product(a, b) => {
            let first = of(a).map(|rate| rate.clone() * &value(b));
            let second = of(b).map(|rate| rate.clone() * &value(a));
            total(first.into_iter().chain(second))
        }
        Operation::Reciprocal(a) => match of(a) {
            None => Recorded::zero(),
            Some(rate) => -(rate.clone() * &(value(node) * &value(node))),
        },
        Operation::Select(values) => {
            let [a, b, x, y] = &**values;
            Recorded::select([a, b, &of_value(x, of), &of_value(y, of)])
        }
        Operation::Solution(solution, i) => {
            let rates = || solution.rates(|value| of_value(value, of));
            solutions.entry(Arc::as_ptr(solution)).or_insert_with(rates)[*i].clone()
        }
    }
}

fn total(terms: impl Iterator<Item = Recorded>) -> Recorded {
    let mut sum = <Recorded as crate::Summable>::Sum::default();
    terms.for_each(|term| sum.add_term(&term));
    sum.finish(Tolerance::default()).unwrap_or_default()
}
