//! Alternative notations of functions: `ln(x)`, `sec(x)`, `sin^2(x)`.

use super::{Expression, Node};
use crate::function::Function;

/// A function that is a quotient of other functions at the same argument.
struct Abbreviation {
    name: &'static str,
    above: Option<&'static str>,
    below: Option<&'static str>,
}

const fn quotient(
    name: &'static str,
    above: Option<&'static str>,
    below: Option<&'static str>,
) -> Abbreviation {
    Abbreviation { name, above, below }
}

const ABBREVIATIONS: [Abbreviation; 7] = [
    quotient("ln", Some("log"), None),
    quotient("sec", None, Some("cos")),
    quotient("csc", None, Some("sin")),
    quotient("cot", Some("cos"), Some("sin")),
    quotient("sech", None, Some("cosh")),
    quotient("csch", None, Some("sinh")),
    // does not use cosh(x)/sinh(x), which would overflow for large x
    quotient("coth", None, Some("tanh")),
];

/// Whether the name is an alternative notation, such as `sec` and `ln`, for a quotient of
/// elementary functions.
///
/// ```
/// use affinor_tensors::expression::is_abbreviation;
/// assert!(is_abbreviation("ln") && !is_abbreviation("log"));
/// ```
pub fn is_abbreviation(name: &str) -> bool {
    ABBREVIATIONS.iter().any(|known| known.name == name)
}

/// Whether the name is an elementary function or an abbreviation, so that `sin^2(x)` has a meaning.
pub(super) fn is_elementary(name: &str) -> bool {
    Function::from_name(name).is_some() || is_abbreviation(name)
}

impl Expression {
    /// Whether the expression is the name of an elementary function without an argument, or a power
    /// of such a name.
    pub(super) fn is_function_name(&self) -> bool {
        match &self.node {
            Node::Name(name) => is_elementary(name),
            Node::Power(base, _) => base.is_function_name(),
            _ => false,
        }
    }

    /// A call of the function `name` with these arguments. Abbreviations are replaced by quotients.
    pub(super) fn call(
        name: &str,
        arguments: Vec<Expression>,
        span: std::ops::Range<usize>,
    ) -> Self {
        let call = |name: &str| Expression {
            span: span.clone(),
            node: Node::Call(name.into(), arguments.clone()),
        };
        let known = ABBREVIATIONS.iter().find(|known| known.name == name);
        match known.filter(|_| arguments.len() == 1).map(|known| (known.above, known.below)) {
            None | Some((None, None)) => call(name),
            Some((Some(above), None)) => call(above),
            Some((above, Some(below))) => {
                let above = above.map(|above| (false, call(above)));
                let factors = above.into_iter().chain([(true, call(below))]).collect();
                Expression { span: span.clone(), node: Node::Product(factors) }
            }
        }
    }
}
