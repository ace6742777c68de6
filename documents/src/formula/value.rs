//! Trees of computed values. Such values are written in the grammar of expressions.

use super::{Brackets, Node, Row, bare, fraction, is_function, symbol};
use affinor_tensors::expression::{Expression, View, is_name};
use affinor_tensors::scalar::FreeFunction;

/// Parses a written value. A text that the grammar of expressions does not allow becomes words.
pub(crate) fn value(text: &str) -> Row {
    match Expression::parse(text) {
        Ok(expression) => read(&expression, text),
        Err(_) => vec![Node::Text(text.into())],
    }
}

/// A linear combination, from pairs of coefficient and label: `a + 2 b - (p + q) c`. Without terms,
/// the result is zero.
pub(crate) fn sum(terms: impl IntoIterator<Item = (Row, Row)>) -> Row {
    let mut row: Row = vec![];
    for (coefficient, factor) in terms {
        let is_term = |at: usize| coefficient[at].is_sign_of_term() && at > 0;
        let (sign, size) = match coefficient.as_slice() {
            _ if (0..coefficient.len()).any(is_term) => {
                ("+", vec![Node::Group(Brackets::Round, coefficient)])
            }
            [Node::Sign("−"), size @ ..] => ("−", size.to_vec()),
            _ => ("+", coefficient),
        };
        if sign == "−" || !row.is_empty() {
            row.push(Node::Sign(sign));
        }
        if !matches!(size.as_slice(), [Node::Number(one)] if one == "1") {
            row.extend(size);
        }
        row.extend(factor);
    }
    if row.is_empty() { vec![Node::Number("0".into())] } else { row }
}

/// The label of a basis vector, as a name if possible, and otherwise as words.
pub(crate) fn label(label: &str) -> Node {
    if is_name(label) { name(label) } else { Node::Text(label.into()) }
}

/// A parameter: `J11` has the index 11, and `mass_max` has the index `max`.
pub(crate) fn name(name: &str) -> Node {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = match name.split_once('_') {
        Some((stem, index)) if !index.is_empty() => (stem, index),
        _ => (stem, &name[stem.len()..]),
    };
    if stem.is_empty() || index.is_empty() {
        return symbol(name);
    }
    let index = match index.bytes().all(|b| b.is_ascii_digit()) {
        true => Node::Number(index.into()),
        false => symbol(index),
    };
    Node::Scripts(Box::new(symbol(stem)), vec![(false, vec![index])])
}

fn read(expression: &Expression, text: &str) -> Row {
    match expression.view() {
        View::Number(_) => number(&text[expression.span()]),
        View::Name(text) => vec![name(text)],
        View::Sum(terms) => {
            let mut row = vec![];
            for (subtracted, term) in terms {
                if *subtracted || !row.is_empty() {
                    row.push(Node::Sign(if *subtracted { "−" } else { "+" }));
                }
                row.extend(factor(term, text));
            }
            row
        }
        View::Product(factors) => factors.iter().fold(vec![], |row, (divides, next)| {
            let next = factor(next, text);
            if *divides { fraction(row, next) } else { [row, next].concat() }
        }),
        View::Power(base, exponent) => power(base, exponent, text),
        View::Call(name, arguments) => call(name, arguments, None, text),
    }
}

/// A factor of a product, in brackets if it is a sum.
fn factor(expression: &Expression, text: &str) -> Row {
    let row = read(expression, text);
    match expression.view() {
        View::Sum(_) => vec![Node::Group(Brackets::Round, row)],
        _ => row,
    }
}

/// A number: `12`, `0.5`, or `1.5e-7`, which becomes a product with a power of ten.
fn number(text: &str) -> Row {
    let text = text.trim_matches(['(', ')', ' ']);
    let Some((mantissa, exponent)) = text.split_once(['e', 'E']) else {
        return vec![Node::Number(text.into())];
    };
    let ten = Node::Number("10".into());
    let power = Node::Scripts(Box::new(ten), vec![(true, signed(exponent))]);
    vec![Node::Number(mantissa.into()), Node::Sign("×"), power]
}

/// An integer, with its sign as a separate node.
fn signed(text: &str) -> Row {
    let size = Node::Number(text.trim_start_matches(['-', '+']).into());
    if text.starts_with('-') { vec![Node::Sign("−"), size] } else { vec![size] }
}

fn power(base: &Expression, exponent: &Expression, text: &str) -> Row {
    let exponent = match exponent.view() {
        View::Number(number) => {
            let number = number.to_string();
            match number.split_once('/') {
                None => signed(&number),
                Some((above, below)) => {
                    let below = Node::Number(below.into());
                    [signed(above), vec![Node::Sign("/"), below]].concat()
                }
            }
        }
        _ => read(exponent, text),
    };
    if let View::Call(name, arguments) = base.view() {
        return call(name, arguments, Some(exponent), text);
    }
    let base = match <[Node; 1]>::try_from(read(base, text)) {
        Ok([node]) if !matches!(node, Node::Fraction(_)) => node,
        Ok([node]) => Node::Group(Brackets::Round, vec![node]),
        Err(row) => Node::Group(Brackets::Round, row),
    };
    vec![raised(base, Some(exponent))]
}

fn raised(base: Node, exponent: Option<Row>) -> Node {
    match exponent {
        Some(exponent) => Node::Scripts(Box::new(base), vec![(true, exponent)]),
        None => base,
    }
}

/// A function, whose power is written as in `sin^2 x`. An undetermined function is written without
/// its arguments; its derivatives are indices after a comma, as in `f_{,r}`.
fn call(head: &str, arguments: &[Expression], exponent: Option<Row>, text: &str) -> Row {
    let rows: Vec<Row> = arguments.iter().map(|argument| read(argument, text)).collect();
    let names: Vec<&str> = arguments.iter().map(|argument| &text[argument.span()]).collect();
    if let Ok(function) = FreeFunction::new(head, &names) {
        let mut by: Row = function.differentiated_by().map(name).collect();
        let mut base = name(function.name());
        if !by.is_empty() {
            by.insert(0, Node::Sign(","));
            base = match base {
                Node::Scripts(base, mut scripts) => {
                    scripts.iter_mut().for_each(|(_, index)| index.append(&mut by));
                    Node::Scripts(base, scripts)
                }
                base => Node::Scripts(Box::new(base), vec![(false, by)]),
            };
        }
        return vec![raised(base, exponent)];
    }
    let argument = rows.join(&Node::Sign(","));
    match head {
        "exp" => {
            let base = raised(Node::Letter('e'), Some(bare(argument)));
            match exponent {
                None => vec![base],
                exponent => vec![raised(Node::Group(Brackets::Round, vec![base]), exponent)],
            }
        }
        "sqrt" => vec![raised(Node::Root(bare(argument)), exponent)],
        _ => {
            let function = match is_function(head) {
                true => Node::Function(head.into()),
                false => symbol(head),
            };
            let alone = matches!(
                argument.as_slice(),
                [Node::Letter(_) | Node::Name(_) | Node::Scripts(..)]
            ) && matches!(arguments, [one] if matches!(one.view(), View::Name(_)));
            let argument = match <[Node; 1]>::try_from(argument) {
                Ok([node]) if alone => node,
                Ok([node]) => Node::Group(Brackets::Round, vec![node]),
                Err(row) => Node::Group(Brackets::Round, row),
            };
            vec![Node::Apply(Box::new(raised(function, exponent)), Box::new(argument))]
        }
    }
}
