//! The operators of recorded values, and the abbreviated text of these values.

use super::image::Image;
use super::{Function, Node, Operation, Recorded};
use crate::scalar::operators::forward_operators;
use crate::text::is_sum;
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg};
use std::sync::Arc;

impl Add<&Recorded> for Recorded {
    type Output = Recorded;
    fn add(self, other: &Recorded) -> Recorded {
        if self.factor.is_zero() {
            return other.clone();
        }
        if other.factor.is_zero() {
            return self;
        }
        let (mut constant, mut terms) = self.into_terms();
        match &other.node {
            None => constant += &other.factor,
            Some(node) => terms.push((other.factor.clone(), node.clone())),
        }
        Recorded::combination(constant, terms)
    }
}

impl Mul<&Recorded> for Recorded {
    type Output = Recorded;
    fn mul(self, other: &Recorded) -> Recorded {
        let (a, b) = match (&self.node, &other.node) {
            (_, None) => return self.scaled(&other.factor),
            (None, _) => return other.clone().scaled(&self.factor),
            (Some(a), Some(b)) => (a, b),
        };
        let factor = self.factor.clone() * &other.factor;
        cancelled(a, b).unwrap_or_else(|| product(a, b)).scaled(&factor)
    }
}

/// The product as a single operation.
fn product(a: &Arc<Node>, b: &Arc<Node>) -> Recorded {
    let image = a.image.zip(b.image).map(|(a, b): (Image, Image)| a.mul(b));
    Recorded::of(Operation::Product(a.clone(), b.clone()), image)
}

/// Common factors are searched for in products of at most this number of factors.
const FACTORS: usize = 8;

/// The product after cancellation of factors, and with roots instead of their squares. Only
/// products of few factors are tried. Returns `None` if nothing cancels.
fn cancelled(a: &Arc<Node>, b: &Arc<Node>) -> Option<Recorded> {
    let mut parts = [vec![], vec![]];
    let mut open = vec![(a, false), (b, false)];
    while let Some((node, below)) = open.pop() {
        match &node.operation {
            Operation::Product(a, b) => open.extend([(a, below), (b, below)]),
            Operation::Reciprocal(a) => open.push((a, !below)),
            _ => parts[usize::from(below)].push(node),
        }
        if open.len() + parts[0].len() + parts[1].len() > FACTORS {
            return None;
        }
    }
    let [above, mut below] = parts;
    let given = above.len() + below.len();
    let (mut kept, mut negative) = (vec![], false);
    for node in above {
        let (key, sign) = node.key();
        match below.iter().position(|other| other.key().0 == key) {
            Some(at) => negative ^= below.swap_remove(at).key().1 != sign,
            None => kept.push(node),
        }
    }
    let root = |node: &&Arc<Node>| matches!(node.operation, Operation::Function(Function::Sqrt, _));
    while let Some((first, second)) = kept.iter().enumerate().find_map(|(at, node)| {
        let mut earlier = kept[..at].iter();
        Some((earlier.position(|other| root(node) && other.key() == node.key())?, at))
    }) {
        let node = kept.remove(second);
        if let Operation::Function(_, argument) = &node.operation {
            kept[first] = argument;
        }
    }
    if kept.len() + below.len() == given {
        return None;
    }
    let value = |node: &Arc<Node>| Recorded { factor: One::one(), node: Some(node.clone()) };
    let above = kept.into_iter().map(value).fold(Recorded::one(), |all, x| all * &x);
    let below = below.into_iter().map(value).fold(Recorded::one(), |all, x| all * &x);
    let quotient = above * &crate::Field::recip(&below)?;
    Some(if negative { -quotient } else { quotient })
}

impl Neg for Recorded {
    type Output = Recorded;
    fn neg(self) -> Recorded {
        Recorded { factor: -self.factor, node: self.node }
    }
}

forward_operators!(Recorded: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign);

/// Two values are equal if their images are equal. Values without images are equal if their
/// operations are equal.
impl PartialEq for Recorded {
    fn eq(&self, other: &Self) -> bool {
        match (&self.node, &other.node) {
            (None, None) => return self.factor == other.factor,
            (Some(a), Some(b)) if Arc::ptr_eq(a, b) => return self.factor == other.factor,
            _ => {}
        }
        (self.clone() - other).factor.is_zero()
    }
}

/// The value as text. Operations below this number of levels are omitted.
pub(super) fn written(value: &Recorded, levels: usize) -> String {
    let Recorded { factor, node } = value;
    let Some(node) = node else { return factor.to_string() };
    let text = operation(node, levels);
    if factor.is_one() {
        text
    } else if (-factor.clone()).is_one() {
        format!("-{}", enclosed(text))
    } else {
        format!("{factor}*{}", enclosed(text))
    }
}

fn operation(node: &Arc<Node>, levels: usize) -> String {
    let below = |node: &Arc<Node>| match levels {
        0 => "...".to_string(),
        _ => operation(node, levels - 1),
    };
    match &node.operation {
        Operation::Input(name) => name.to_string(),
        Operation::Function(function, a) => format!("{}({})", function.name(), below(a)),
        Operation::Sum(..) if levels == 0 => "...".into(),
        Operation::Sum(constant, terms) => {
            let mut text = String::new();
            for (factor, node) in terms {
                let term = Recorded { factor: factor.clone(), node: Some(node.clone()) };
                let term = written(&term, levels - 1);
                let sign = if term.starts_with('-') { " - " } else { " + " };
                let term = term.trim_start_matches('-');
                match text.is_empty() {
                    true => text = if sign == " - " { format!("-{term}") } else { term.into() },
                    false => text = format!("{text}{sign}{term}"),
                }
            }
            if constant.is_zero() {
                text
            } else if text.is_empty() {
                constant.to_string()
            } else {
                format!("{text} + {}", enclosed(constant.to_string()))
            }
        }
        Operation::Product(a, b) => format!("{}*{}", enclosed(below(a)), enclosed(below(b))),
        Operation::Reciprocal(a) => format!("1/({})", below(a)),
        Operation::Select(_) | Operation::Solution(..) if levels == 0 => "...".into(),
        Operation::Select(values) => {
            let [a, b, x, y] = values.each_ref().map(|value| written(value, levels - 1));
            format!("select({a}, {b}, {x}, {y})")
        }
        Operation::Solution(solution, i) => written(solution.eliminated(*i), levels - 1),
    }
}

fn enclosed(text: String) -> String {
    if is_sum(&text) || text.starts_with('-') { format!("({text})") } else { text }
}
