//! Converts values to text and LaTeX.

use super::common::CommonFactors;
use super::free::Applied;
use super::shape::{Place, Shape, Shaping};
use super::variable::{Kind, Part, Variable};
use super::{Form, Symbolic, memo};
use crate::expression::is_name;
use crate::scalar::{Notation, Ring};
use num_integer::Integer;
use num_traits::One;

/// The two output formats of a value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Markup {
    Text,
    Latex,
}

impl Symbolic {
    /// The value as text or as LaTeX. Functions of angles are written as sines and cosines.
    pub(super) fn written(&self, markup: Markup, names: &CommonFactors) -> String {
        let whole = |value: &Symbolic| match &value.0 {
            Form::Constant(c) if markup == Markup::Text => c.to_string(),
            Form::Constant(c) => c.latex(),
            Form::Fraction(f) => {
                let mut text = String::new();
                let shape = match names.is_empty() && value.0 == self.0 {
                    true => memo::shape(f, || Shaping { names }.fraction(f)),
                    false => Shaping { names }.fraction(f).into(),
                };
                Writer { markup, variables: &f.variables }.write(&shape, Binds::Sum, &mut text);
                text
            }
        };
        match self.has_written_form() {
            false => whole(self),
            true if names.is_empty() => memo::text(self, markup, || whole(&names.written(self))),
            true => whole(&names.written(self)),
        }
    }
}

/// The precedence of operations.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Product,
    /// A single factor, as in a denominator.
    Factor,
    /// The base of a power.
    Atom,
}

/// A writer of shapes with named variables.
#[derive(Clone, Copy)]
struct Writer<'w> {
    markup: Markup,
    variables: &'w [Variable],
}

impl Writer<'_> {
    /// Appends a shape to a text. The shape has parentheses if the surrounding operation binds more
    /// tightly.
    fn write(self, shape: &Shape, around: Binds, text: &mut String) {
        let own = match shape {
            Shape::Number(_) | Shape::Variable(..) | Shape::Named(..) => Binds::Atom,
            Shape::Power(..) => Binds::Factor,
            Shape::Product(_) | Shape::Quotient(..) => Binds::Product,
            Shape::Sum(_) => Binds::Sum,
        };
        let enclosed = own < around;
        if enclosed {
            text.push_str(if self.markup == Markup::Latex { "\\left(" } else { "(" });
        }
        match shape {
            Shape::Number(number) if self.markup == Markup::Latex => text.push_str(&number.latex()),
            Shape::Number(number) => text.push_str(&number.to_string()),
            Shape::Variable(at, e) => text.push_str(&power(self.variables[*at], *e, self.markup)),
            Shape::Named(name, e) => {
                text.push_str(&parameter(name, self.markup));
                text.push_str(&exponent(*e, self.markup));
            }
            Shape::Power(base, e) => {
                self.write(base, Binds::Atom, text);
                text.push_str(&exponent(*e, self.markup));
            }
            Shape::Product(factors) => {
                for (at, factor) in factors.iter().enumerate() {
                    if at > 0 {
                        text.push(if self.markup == Markup::Latex { ' ' } else { '*' });
                    }
                    self.write(factor, Binds::Product, text);
                }
            }
            Shape::Sum(terms) => {
                for (at, (negative, term)) in terms.iter().enumerate() {
                    text.push_str(match (at, negative) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    });
                    self.write(term, Binds::Product, text);
                }
            }
            Shape::Quotient(above, below) if self.markup == Markup::Latex => {
                text.push_str("\\frac{");
                self.write(above, Binds::Sum, text);
                text.push_str("}{");
                self.write(below, Binds::Sum, text);
                text.push('}');
            }
            Shape::Quotient(above, below) => {
                self.write(above, Binds::Product, text);
                text.push('/');
                self.write(below, Binds::Factor, text);
            }
        }
        if enclosed {
            text.push_str(if self.markup == Markup::Latex { "\\right)" } else { ")" });
        }
    }
}

/// The text of a shape at a position in a fraction.
pub(super) fn text_at(shape: &Shape, variables: &[Variable], place: Place) -> String {
    let around = match place {
        Place::Alone => Binds::Sum,
        Place::Above => Binds::Product,
        Place::Below => Binds::Factor,
    };
    let mut text = String::new();
    Writer { markup: Markup::Text, variables }.write(shape, around, &mut text);
    text
}

/// The text of an exponent after its base. The exponent 1 is omitted.
fn exponent(exponent: u32, markup: Markup) -> String {
    match (exponent, markup) {
        (1, _) => String::new(),
        (_, Markup::Text) => format!("^{exponent}"),
        (_, Markup::Latex) => format!("^{{{exponent}}}"),
    }
}

/// The text of a function.
pub(super) fn variable(kind: &Kind) -> String {
    kind_power(kind, 1, Markup::Text)
}

/// The name of a function, and the text of its arguments with the closing parenthesis. Functions
/// are sorted by these two texts.
pub(super) fn call(kind: &Kind) -> [String; 2] {
    let [name, arguments] = match kind {
        Kind::Parameter(name) => [name.to_string(), String::new()],
        Kind::Pi => return ["pi".into(), String::new()],
        Kind::HalfTangent(angle) => ["tan".into(), multiple(angle.half(), 1, Markup::Text)],
        Kind::Exponential(part) => ["exp".into(), multiple(part.clone(), 1, Markup::Text)],
        Kind::Logarithm(p) => ["log".into(), p.to_string()],
        Kind::Root(Part { of, .. }) | Kind::FreeRoot(Part { of, .. }) => {
            ["sqrt".into(), of.to_string()]
        }
        Kind::Secant(part) => ["sech".into(), multiple(part.clone(), 1, Markup::Text)],
        Kind::Written(function, part) => {
            [function.name().into(), multiple(part.clone(), 1, Markup::Text)]
        }
        Kind::Applied(applied) => [applied.head(), applied.list(Markup::Text)],
    };
    [name, arguments + ")"]
}

/// A power of a variable.
fn power(variable: Variable, e: u32, markup: Markup) -> String {
    match variable.kind() {
        Kind::Parameter(name) => parameter(name, markup) + &exponent(e, markup),
        _ if e == 1 && markup == Markup::Text => variable.text().to_string(),
        kind => kind_power(kind, e, markup),
    }
}

/// The text of a power of a function, such as `sin(x)^2`, `exp(2*x)`, `\sin^{2} x`, `e^{2 x}`,
/// `\sqrt{x}`, `x^(2/3)`, `t^(2*p)`.
fn kind_power(kind: &Kind, e: u32, markup: Markup) -> String {
    match kind {
        Kind::Parameter(name) => parameter(name, markup) + &exponent(e, markup),
        Kind::Pi => parameter("pi", markup) + &exponent(e, markup),
        Kind::HalfTangent(angle) => called("tan", angle.half(), e, markup),
        Kind::Written(function, part) => called(function.name(), part.clone(), e, markup),
        Kind::Secant(part) => called("sech", part.clone(), e, markup),
        Kind::Logarithm(p) => called("log", Part { of: p.clone(), parts: 1 }, e, markup),
        Kind::Exponential(part) => match symbolic_power(part) {
            Some((base, part)) => powered(&base, &multiple(part, e, markup), markup),
            None if markup == Markup::Latex => {
                format!("e^{{{}}}", multiple(part.clone(), e, markup))
            }
            None => format!("exp({})", multiple(part.clone(), e, markup)),
        },
        Kind::Root(Part { of, parts }) | Kind::FreeRoot(Part { of, parts }) => {
            let common = e.gcd(parts);
            match ((e / common, parts / common), markup) {
                ((e, 2), Markup::Text) => format!("sqrt({of}){}", exponent(e, markup)),
                ((e, 2), Markup::Latex) => {
                    format!("\\sqrt{{{}}}{}", of.to_latex(), exponent(e, markup))
                }
                ((e, 1), _) => atom(of, markup) + &exponent(e, markup),
                ((1, n), Markup::Latex) => format!("\\sqrt[{n}]{{{}}}", of.to_latex()),
                ((e, n), _) => powered(of, &format!("{e}/{n}"), markup),
            }
        }
        Kind::Applied(applied) => applied.written(markup) + &exponent(e, markup),
    }
}

/// The text of a base with an exponent that is not an integer.
fn powered(base: &Symbolic, exponent: &str, markup: Markup) -> String {
    let base = atom(base, markup);
    match markup {
        Markup::Latex => format!("{base}^{{{exponent}}}"),
        Markup::Text if is_name(exponent) => format!("{base}^{exponent}"),
        Markup::Text => format!("{base}^({exponent})"),
    }
}

/// The text of a value as the base of a power. It has parentheses unless it is a name or a
/// nonnegative integer.
fn atom(base: &Symbolic, markup: Markup) -> String {
    let plain = base.as_variable().is_some_and(|variable| match variable.kind() {
        Kind::Parameter(_) => true,
        Kind::Applied(_) => markup == Markup::Text,
        _ => false,
    });
    let integer = base.as_constant().is_some_and(|c| c.to_i64().is_some_and(|n| n >= 0));
    match (markup, plain || integer) {
        (Markup::Text, true) => base.to_string(),
        (Markup::Latex, true) => base.to_latex(),
        (Markup::Text, false) => format!("({base})"),
        (Markup::Latex, false) => format!("\\left({}\\right)", base.to_latex()),
    }
}

/// The base `p` and the exponent `u`, if the argument is `u*log(p)`; otherwise `None`.
fn symbolic_power(part: &Part) -> Option<(Symbolic, Part)> {
    let mut logarithms = part.of.variables().iter().filter_map(|variable| match variable.kind() {
        Kind::Logarithm(p) => Some((*variable, p)),
        _ => None,
    });
    let (variable, p) = logarithms.next().filter(|_| logarithms.next().is_none())?;
    let of = part.of.clone() / &Symbolic::variable(variable);
    let free = !of.variables().contains(&variable) && of.as_constant().is_none();
    free.then(|| (p.clone(), Part { of, parts: part.parts }))
}

/// The text of a power of a function of a part of an argument.
fn called(function: &str, part: Part, e: u32, markup: Markup) -> String {
    let power = exponent(e, markup);
    match markup {
        Markup::Text => format!("{function}({}){power}", multiple(part, 1, markup)),
        Markup::Latex => match (part.of.as_parameter(), part.parts) {
            (Some(name), 1) => format!("\\{function}{power} {}", latex_name(name)),
            _ => format!("\\{function}{power}({})", multiple(part, 1, markup)),
        },
    }
}

/// The text of a multiple of a part of an argument, such as `2*a*x/3`.
fn multiple(part: Part, count: u32, markup: Markup) -> String {
    let common = count.gcd(&part.parts);
    let (count, parts) = (i64::from(count / common), i64::from(part.parts / common));
    let scaled = part.of * &Symbolic::from_i64(count);
    let term = scaled.numerator().terms().len() == 1 && scaled.denominator().is_one();
    match (parts, markup) {
        (1, Markup::Text) => scaled.to_string(),
        (1, Markup::Latex) => scaled.to_latex(),
        _ if !term || scaled.as_constant().is_some() => {
            let value = scaled / &Symbolic::from_i64(parts);
            if markup == Markup::Latex { value.to_latex() } else { value.to_string() }
        }
        (_, Markup::Text) => format!("{scaled}/{parts}"),
        (_, Markup::Latex) => format!("\\frac{{{}}}{{{parts}}}", scaled.to_latex()),
    }
}

impl Part {
    /// Half of the part.
    fn half(&self) -> Part {
        Part { of: self.of.clone(), parts: 2 * self.parts }
    }
}

impl Applied {
    /// The name of the function with its derivatives, such as `f_r_theta`.
    pub(super) fn head(&self) -> String {
        self.differentiated_by().iter().fold(self.name.to_string(), |head, by| head + "_" + by)
    }

    /// The arguments, separated by commas.
    fn list(&self, markup: Markup) -> String {
        let write = |value: &Symbolic| match markup {
            Markup::Text => value.to_string(),
            Markup::Latex => value.to_latex(),
        };
        let comma = if markup == Markup::Latex { ", " } else { "," };
        self.arguments.iter().map(write).collect::<Vec<_>>().join(comma)
    }

    /// The text of a free function, such as `f_r_theta(r,theta)`. The LaTeX form is
    /// `f_{,r \theta}`, or `f_{1,t}` for `f1_t(t)`. If the arguments are not names, the LaTeX form
    /// is for example `A_{,1}(\frac{r}{t})`.
    fn written(&self, markup: Markup) -> String {
        if markup == Markup::Text {
            return format!("{}({})", self.head(), self.list(markup));
        }
        let by: Vec<String> =
            self.differentiated_by().iter().map(|name| latex_name(name)).collect();
        let name = latex_name(&self.name);
        let head = match (by.is_empty(), name.strip_suffix('}').filter(|name| name.contains("_{")))
        {
            (true, _) => name,
            (false, Some(name)) => format!("{name},{}}}", by.join(" ")),
            (false, None) => format!("{name}_{{,{}}}", by.join(" ")),
        };
        match self.names() {
            Some(_) => head,
            None => format!("{head}\\left({}\\right)", self.list(markup)),
        }
    }
}

/// The name of a parameter.
fn parameter(name: &str, markup: Markup) -> String {
    match markup {
        Markup::Latex => latex_name(name),
        Markup::Text => name.to_owned(),
    }
}
/// The LaTeX form of a name. For example, `J11` becomes `J_{11}`, `lambda` becomes `\lambda`, and
/// `abc_x` becomes `\mathit{abc}_{x}`.
fn latex_name(name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = match name.split_once('_') {
        Some((stem, index)) if !index.is_empty() => (stem, index),
        _ => (stem, &name[stem.len()..]),
    };
    if stem.is_empty() {
        return latex_stem(name);
    }
    match index {
        "" => latex_stem(stem),
        digits if digits.bytes().all(|b| b.is_ascii_digit()) => {
            format!("{}_{{{digits}}}", latex_stem(stem))
        }
        index => format!("{}_{{{}}}", latex_stem(stem), latex_stem(index)),
    }
}

fn latex_stem(stem: &str) -> String {
    let mut letters = stem.chars();
    if GREEK.split(' ').any(|letter| letter == stem) {
        format!("\\{stem}")
    } else if letters.next().is_some_and(char::is_alphabetic) && letters.next().is_none() {
        stem.to_owned()
    } else {
        format!("\\mathit{{{}}}", stem.replace('_', "\\_"))
    }
}

/// The names of the Greek letters that have LaTeX commands.
const GREEK: &str = "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa \
    lambda mu nu xi pi varpi rho varrho sigma varsigma tau upsilon phi varphi chi psi omega \
    Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega";
