//! Variables, which are the generators of the field of values. Each variable is stored once.
//!
//! A variable has a [`Kind`] and, if it is a function, arguments that are values. Its text is
//! written once. The text is used for output and for the order of variables, but it is never
//! parsed.

use super::free::Applied;
use super::{Symbolic, writing};
use crate::function::Function;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

/// The meaning of a variable.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    /// A parameter or a coordinate.
    Parameter(Box<str>),
    /// The number pi.
    Pi,
    /// The half tangent `tan(u/2)` of the part `u` of an argument. The sine and cosine of `u` are
    /// rational functions of it.
    HalfTangent(Part),
    /// The exponential of a part of an argument.
    Exponential(Part),
    /// The logarithm of an irreducible polynomial or a prime.
    Logarithm(Symbolic),
    /// The root `of^(1/parts)` of an irreducible polynomial or a prime.
    Root(Part),
    /// A free function, or a derivative of a free function, at its arguments.
    Applied(Applied),
    /// A function in its written form, such as the sine. It occurs only in written forms.
    Written(Function, Part),
    /// A root without its relation. It occurs only in written forms.
    FreeRoot(Part),
    /// The hyperbolic secant, which does not overflow. It occurs only in programs.
    Secant(Part),
}

/// A part of an argument: `of / parts`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Part {
    /// A member of the basis of arguments, such as `x` or `a*x^2`.
    pub of: Symbolic,
    /// The number of parts, which is positive.
    pub parts: u32,
}

/// A variable of [`Symbolic`] values. It is a parameter, or a function of values.
///
/// Every variable is stored once, until the process ends, so that variables can be compared by
/// their addresses. `Display` writes the text of the variable.
#[derive(Clone, Copy)]
pub struct Variable(&'static Entry);

struct Entry {
    kind: Kind,
    text: Box<str>,
    order: Order,
    /// The parameters on which the variable depends, in their order. The list is empty for a
    /// parameter.
    parameters: Variables,
    /// A number that is compatible with the order of the variables. Variables with equal numbers
    /// are compared by [`Order`].
    rank: u64,
    hash: u64,
    /// The number of variables that were stored before this variable.
    index: usize,
}

/// The order of variables. First come names in natural order, `J2 < J10 < K1`. Then come functions
/// in the order of the texts of their arguments, with the sine first:
/// `z < sin(x) < cos(x) < sin(y)`.
#[derive(PartialEq, Eq)]
enum Order {
    Name(Box<str>),
    Function { arguments: Box<str>, name: Box<str> },
}

/// All variables of this process. A value refers to its variables without counting references, so
/// variables are never freed. Each different parameter or function needs a few hundred bytes.
#[derive(Default)]
struct Stored {
    parameters: HashMap<&'static str, Variable>,
    functions: HashMap<&'static Kind, Variable>,
}

static STORED: LazyLock<Mutex<Stored>> = LazyLock::new(Mutex::default);

impl Stored {
    fn len(&self) -> usize {
        self.parameters.len() + self.functions.len()
    }

    fn lock() -> std::sync::MutexGuard<'static, Self> {
        STORED.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Variable {
    /// The parameter with this name.
    pub(crate) fn parameter(name: &str) -> Self {
        let mut stored = Stored::lock();
        if let Some(known) = stored.parameters.get(name) {
            return *known;
        }
        let kind = Kind::Parameter(name.into());
        let variable = Self::stored(kind, name.into(), Order::Name(name.into()), stored.len());
        stored.parameters.insert(&variable.0.text, variable);
        variable
    }

    /// The variable of this kind.
    pub(super) fn function(kind: Kind) -> Self {
        if let Some(known) = Stored::lock().functions.get(&kind) {
            return *known;
        }
        // writes the text before the table is locked again, because arguments contain other
        // variables
        let text = writing::variable(&kind);
        let [name, arguments] = writing::call(&kind).map(Box::from);
        let order = Order::Function { arguments, name };
        let mut stored = Stored::lock();
        if let Some(known) = stored.functions.get(&kind) {
            return *known;
        }
        let variable = Self::stored(kind, text.into(), order, stored.len());
        stored.functions.insert(&variable.0.kind, variable);
        variable
    }

    fn stored(kind: Kind, text: Box<str>, order: Order, index: usize) -> Self {
        let mut hasher = DefaultHasher::new();
        text.hash(&mut hasher);
        let (rank, hash) = (order.rank(), hasher.finish());
        let arguments = kind.arguments();
        let inner = arguments.iter().flat_map(|value| value.variables());
        let mut parameters: Vec<Variable> = inner.flat_map(|own| own.parameters()).collect();
        parameters.sort_unstable();
        parameters.dedup();
        let parameters = parameters.into();
        Variable(Box::leak(Box::new(Entry { kind, text, order, parameters, rank, hash, index })))
    }

    pub(super) fn kind(self) -> &'static Kind {
        &self.0.kind
    }

    /// The text of the variable, which is a name, or a call such as `tan(x/2)`.
    pub fn text(self) -> &'static str {
        &self.0.text
    }

    /// The parameters on which the variable depends. They are the variable itself, or the
    /// parameters of its arguments.
    pub(super) fn parameters(self) -> impl Iterator<Item = Variable> {
        let own = self.is_parameter().then_some(self);
        own.into_iter().chain(self.0.parameters.iter().copied())
    }

    /// Whether the variable is a parameter.
    pub fn is_parameter(self) -> bool {
        matches!(self.0.kind, Kind::Parameter(_))
    }

    /// The name of a free function with its derivatives, such as `a_t` for `a_t(t)`. Returns `None`
    /// for other variables.
    pub fn free_function(self) -> Option<String> {
        match self.kind() {
            Kind::Applied(applied) => Some(applied.head()),
            _ => None,
        }
    }

    /// The argument `p` and the order `n` of a root `p^(1/n)`, where `p` is a prime or an
    /// irreducible polynomial. Returns `None` for other variables.
    ///
    /// ```
    /// use affinor_tensors::{Symbolic, scalar::PositiveFactors};
    /// let root = PositiveFactors::default().function("sqrt", &Symbolic::from(3))?;
    /// let (powers, _) = root.terms().remove(0);
    /// let (argument, order) = powers[0].0.root().ok_or("not a root")?;
    /// assert_eq!((argument.to_string(), order), ("3".to_string(), 2));
    /// # Ok::<(), String>(())
    /// ```
    pub fn root(self) -> Option<(&'static Symbolic, u32)> {
        match self.kind() {
            Kind::Root(Part { of, parts }) => Some((of, *parts)),
            _ => None,
        }
    }

    /// A number that identifies the variable in this process.
    pub(super) fn address(self) -> usize {
        std::ptr::from_ref(self.0).addr()
    }
}

impl Kind {
    /// The arguments of the function.
    pub fn arguments(&self) -> Vec<&Symbolic> {
        match self {
            Kind::Parameter(_) | Kind::Pi => vec![],
            Kind::HalfTangent(part)
            | Kind::Exponential(part)
            | Kind::Root(part)
            | Kind::FreeRoot(part)
            | Kind::Secant(part)
            | Kind::Written(_, part) => vec![&part.of],
            Kind::Logarithm(argument) => vec![argument],
            Kind::Applied(applied) => applied.arguments.iter().collect(),
        }
    }

    /// The part of the argument of a half tangent, an exponential or a root. Functions of the same
    /// kind and argument depend on each other algebraically.
    pub fn part(&self) -> Option<&Part> {
        match self {
            Kind::HalfTangent(part) | Kind::Exponential(part) | Kind::Root(part) => Some(part),
            _ => None,
        }
    }

    /// The function of the same kind and argument, for another number of parts.
    pub fn in_parts(&self, parts: u32) -> Option<Kind> {
        let part = Part { of: self.part()?.of.clone(), parts };
        Some(match self {
            Kind::HalfTangent(_) => Kind::HalfTangent(part),
            Kind::Exponential(_) => Kind::Exponential(part),
            _ => Kind::Root(part),
        })
    }

    /// The root of order `n` of a root or an exponential. It is the same function of a part that is
    /// `n` times smaller.
    pub fn in_parts_of(&self, n: u32) -> Option<Kind> {
        match self {
            Kind::Exponential(part) | Kind::Root(part) => self.in_parts(part.parts.checked_mul(n)?),
            _ => None,
        }
    }

    /// Whether two functions have the same kind and argument, possibly with different numbers of
    /// parts.
    pub fn is_related(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
            && self.part().zip(other.part()).is_some_and(|(own, other)| own.of == other.of)
    }
}

impl PartialEq for Variable {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl Eq for Variable {}

impl PartialOrd for Variable {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Variable {
    fn cmp(&self, other: &Self) -> Ordering {
        match self.0.rank.cmp(&other.0.rank) {
            Ordering::Equal if self != other => {
                // compares different functions with the same text by the order in which they were
                // stored
                self.0.order.cmp(&other.0.order).then(self.0.index.cmp(&other.0.index))
            }
            order => order,
        }
    }
}

impl Hash for Variable {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.0.hash);
    }
}

impl From<&str> for Variable {
    /// Converts a name to the parameter with this name.
    fn from(name: &str) -> Self {
        Variable::parameter(name)
    }
}

impl fmt::Display for Variable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.text)
    }
}

impl fmt::Debug for Variable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.text.fmt(f)
    }
}

/// A list of variables in their order, each of which occurs once.
pub(super) type Variables = Arc<[Variable]>;

/// All variables of these lists, each once, in arbitrary order.
pub(super) fn distinct<'v>(lists: impl Iterator<Item = &'v [Variable]>) -> Vec<Variable> {
    let mut found: Vec<Option<Variable>> = Vec::new();
    for variable in lists.flatten() {
        let index = variable.0.index;
        if found.len() <= index {
            found.resize(index + 1, None);
        }
        found[index] = Some(*variable);
    }
    found.into_iter().flatten().collect()
}

/// All variables of the two lists.
pub(super) fn union(a: &Variables, b: &Variables) -> Variables {
    if a == b {
        return a.clone();
    }
    let mut all: Vec<Variable> = a.iter().chain(b.iter()).copied().collect();
    all.sort_unstable();
    all.dedup();
    all.into()
}

impl Order {
    /// A number that is compatible with the order of names. It contains the first letters of a
    /// name, the number of digits after them, and the first digits.
    fn rank(&self) -> u64 {
        match self {
            Order::Name(name) => rank(name),
            Order::Function { .. } => 1 << 63,
        }
    }
}

impl Ord for Order {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Order::Name(a), Order::Name(b)) => natural(a, b),
            (Order::Name(_), Order::Function { .. }) => Ordering::Less,
            (Order::Function { .. }, Order::Name(_)) => Ordering::Greater,
            (
                Order::Function { arguments: x, name: f },
                Order::Function { arguments: y, name: g },
            ) => natural(x, y).then_with(|| (&**f != "sin", f).cmp(&(&**g != "sin", g))),
        }
    }
}

impl PartialOrd for Order {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

fn rank(name: &str) -> u64 {
    let Some((letters, length, digits)) = pieces(name).next() else { return 0 };
    let mut first = [0; 4];
    let count = letters.len().min(4);
    first[..count].copy_from_slice(&letters.as_bytes()[..count]);
    let number = match letters.len() {
        0..=3 => {
            let digits = &digits[..digits.len().min(6)];
            (length.min(255) as u64) << 20 | digits.parse().unwrap_or(0)
        }
        _ => 0,
    };
    u64::from(u32::from_be_bytes(first)) << 28 | number
}

/// The position of each variable in `all`, which must contain all the variables.
pub(super) fn places(variables: &Variables, all: &Variables) -> Vec<usize> {
    let mut at = 0;
    let place = |variable: &Variable| {
        while at < all.len() && all[at] != *variable {
            at += 1;
        }
        at += 1;
        at - 1
    };
    variables.iter().map(place).collect()
}

/// Compares two names in natural order, which is alphabetical, except that numbers are compared by
/// value: `J2 < J10 < K1`.
pub(super) fn natural(a: &str, b: &str) -> Ordering {
    pieces(a).cmp(pieces(b)).then_with(|| a.cmp(b))
}

/// Splits a name into pairs of letters and a number. A number is returned as its length and its
/// digits, by which it is compared.
fn pieces(name: &str) -> impl Iterator<Item = (&str, usize, &str)> {
    let mut rest = name;
    std::iter::from_fn(move || {
        let (letters, tail) = rest.split_at(rest.find(digit).unwrap_or(rest.len()));
        let (digits, tail) = tail.split_at(tail.find(|c| !digit(c)).unwrap_or(tail.len()));
        let number = digits.trim_start_matches('0');
        let done = rest.is_empty();
        rest = tail;
        (!done).then_some((letters, number.len(), number))
    })
}

fn digit(c: char) -> bool {
    c.is_ascii_digit()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_ordered_by_letters_then_numbers_then_functions() {
        let sorted = [
            "",
            "1",
            "7",
            "11",
            "J",
            "J01",
            "J1",
            "J1a",
            "J2",
            "J10",
            "J999999",
            "J1000000",
            "J1000001",
            "J10000000",
            "K1",
            "Omeg9",
            "Omega",
            "Omega1",
            "Omega2",
            "Omega10",
            "_",
            "abc",
            "abc1",
            "abcd",
            "abcd1",
            "abcde",
            "b",
            "x_1",
            "x_2",
            "\u{e9}",
        ];
        let functions = ["sin(J1)", "sin(J2)", "a(t)", "a_t(t)"];
        let functions =
            functions.map(|text| text.parse::<Symbolic>().expect("a function").variables()[0]);
        let names = sorted.map(Variable::parameter);
        names.iter().zip(sorted).for_each(|(name, text)| assert_eq!(name.text(), text));
        let all: Vec<Variable> = names.into_iter().chain(functions).collect();
        for (i, a) in all.iter().enumerate() {
            for (j, b) in all.iter().enumerate() {
                assert_eq!(a.cmp(b), a.0.order.cmp(&b.0.order), "{a:?} {b:?}");
                assert_eq!(a.cmp(b), i.cmp(&j), "{a:?} {b:?}");
            }
        }
    }
}
