//! Fractions as text and as LaTeX.

use super::Symbolic;
use super::collected::{self, Part};
use super::common::CommonFactors;
use super::elementary::{Variable, part};
use super::factors::{Factors, factors, known, sort, within_limits};
use super::fraction::Fraction;
use super::free::FreeFunction;
use super::polynomial::{Polynomial, common_denominator};
use crate::expression::is_name;
use crate::scalar::{Notation, Rational};
use num_integer::Integer;
use num_traits::One;

/// The two ways to write a value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Markup {
    Text,
    Latex,
}

impl Markup {
    /// An exponent after its base; 1 is not written.
    fn exponent(self, exponent: u32) -> String {
        match (exponent, self) {
            (1, _) => String::new(),
            (_, Markup::Text) => format!("^{exponent}"),
            (_, Markup::Latex) => format!("^{{{exponent}}}"),
        }
    }

    fn product(self, factors: impl Iterator<Item = String>) -> String {
        factors.collect::<Vec<_>>().join(if self == Markup::Latex { " " } else { "*" })
    }
}

/// A writer of fractions.
#[derive(Clone, Copy)]
pub(super) struct Writer<'w> {
    pub markup: Markup,
    /// The factors that have names.
    pub names: &'w CommonFactors,
}

impl Writer<'_> {
    /// `1/2*a` for one term without a denominator; otherwise integer polynomials above and below,
    /// in factors where that is shorter.
    pub fn fraction(self, f: &Fraction) -> String {
        let whole = f.denominator.is_one();
        if whole && f.numerator.terms.len() == 1 {
            return self.expanded(f, &f.numerator);
        }
        let unit = common_denominator(&f.numerator);
        let above = f.numerator.scale(&unit);
        let (sign, size) =
            if leads_negative(&above) { ("-", -&above) } else { ("", above.clone()) };
        if whole && unit.is_one() {
            return match self.factored(f, &size, Place::Alone) {
                Ok(product) => format!("{sign}{product}"),
                Err(sum) if sign.is_empty() => sum,
                Err(_) => self.sum(f, &above),
            };
        }
        let top = self.factored(f, &size, Place::Above).unwrap_or_else(|sum| sum);
        let bottom = self.denominator(f, unit);
        match self.markup {
            Markup::Latex => format!("{sign}\\frac{{{top}}}{{{bottom}}}"),
            Markup::Text => format!("{sign}{top}/{bottom}"),
        }
    }

    /// The sum, in parentheses where a division would otherwise apply to a part of it.
    fn enclosed_sum(self, f: &Fraction, part: &Polynomial, place: Place) -> String {
        let torn = match place {
            Place::Alone => false,
            Place::Above => part.terms.len() > 1,
            Place::Below => factors_in(part) > 1,
        };
        enclosed(self.sum(f, part), torn && self.markup == Markup::Text)
    }

    /// The denominator times a number.
    ///
    /// Its known factors are written where one has a name, where [`factors`] would find the same, or
    /// gives up.
    fn denominator(self, f: &Fraction, unit: Rational) -> String {
        if f.denominator.factors.iter().any(|(factor, _)| self.names.name(factor).is_some()) {
            let mut factors = f.denominator.all(&f.variables);
            sort(&mut factors);
            let found = Factors { content: unit, factors };
            return self.enclosed_product(f, &found, Place::Below);
        }
        let irreducible = f.denominator.irreducible(&f.variables);
        let separate = irreducible.as_ref().and_then(|factors| known(unit.clone(), factors));
        let part = || f.expanded_denominator().scale(&unit);
        let (found, part) = match (separate, f.denominator.terms() > MAX_EXPANDED) {
            (Some(found), true) => return self.enclosed_product(f, &found, Place::Below),
            (Some(found), false) => (found, part()),
            (None, large) => match irreducible {
                Some(mut factors) if large || !within_limits(&part()) => {
                    sort(&mut factors);
                    let found = Factors { content: unit.clone(), factors };
                    if large {
                        return self.enclosed_product(f, &found, Place::Below);
                    }
                    (found, part())
                }
                _ => (factors(&part()), part()),
            },
        };
        self.shorter(f, &part, &found, Place::Below).unwrap_or_else(|sum| sum)
    }

    /// The product of the factors if its text is shorter, otherwise the sum. LaTeX follows the text.
    fn factored(self, f: &Fraction, part: &Polynomial, place: Place) -> Result<String, String> {
        match part.terms.len() {
            0 | 1 => Err(self.enclosed_sum(f, part, place)),
            _ => self.shorter(f, part, &factors(part), place),
        }
    }

    /// The product of these factors if its text is shorter, otherwise the sum.
    fn shorter(
        self,
        f: &Fraction,
        part: &Polynomial,
        found: &Factors,
        place: Place,
    ) -> Result<String, String> {
        let whole = match &found.factors[..] {
            [(factor, 1)] if found.content.is_one() => {
                self.names.of_polynomial(&f.variables, factor).is_none()
            }
            _ => false,
        };
        if whole || part.terms.len() < 2 {
            return Err(self.enclosed_sum(f, part, place));
        }
        let text = Writer { markup: Markup::Text, ..self };
        let [product, sum] =
            [text.enclosed_product(f, found, place), text.enclosed_sum(f, part, place)];
        match (self.markup, product.len() < sum.len()) {
            (Markup::Text, true) => Ok(product),
            (Markup::Text, false) => Err(sum),
            (Markup::Latex, true) => Ok(self.enclosed_product(f, found, place)),
            (Markup::Latex, false) => Err(self.enclosed_sum(f, part, place)),
        }
    }

    /// The product of the factors, in parentheses where a division would otherwise apply to a part of
    /// it.
    fn enclosed_product(self, f: &Fraction, found: &Factors, place: Place) -> String {
        let pieces = found.factors.len() + usize::from(!found.content.is_one());
        let torn = place == Place::Below && pieces > 1 && self.markup == Markup::Text;
        enclosed(self.product(f, found), torn)
    }

    fn product(self, f: &Fraction, found: &Factors) -> String {
        let number = Some(found.content.to_string()).filter(|_| !found.content.is_one());
        let factor = |(factor, exponent): &(Polynomial, u32)| {
            if let [(monomial, _)] = &factor.terms[..] {
                // a variable; the power of an exponential stands in its argument
                let at = monomial.exps().iter().position(|e| *e > 0).unwrap_or(0);
                return power(&f.variables[at], *exponent, self.markup);
            }
            if let Some(name) = self.names.of_polynomial(&f.variables, factor) {
                return power(name, *exponent, self.markup);
            }
            self.in_parentheses(&self.sum(f, factor)) + &self.markup.exponent(*exponent)
        };
        self.markup.product(number.into_iter().chain(found.factors.iter().map(factor)))
    }

    fn in_parentheses(self, text: &str) -> String {
        match self.markup {
            Markup::Latex => format!("\\left({text}\\right)"),
            Markup::Text => format!("({text})"),
        }
    }

    /// A sum of terms, with common factors taken out where that is shorter.
    fn sum(self, f: &Fraction, part: &Polynomial) -> String {
        if part.terms.len() < 3 {
            return self.expanded(f, part);
        }
        self.parts(f, &collected::parts(part, &f.variables))
    }

    fn parts(self, f: &Fraction, parts: &[Part]) -> String {
        let mut text = String::new();
        for Part { coefficient, powers, inner } in parts {
            text += sign(text.is_empty(), coefficient);
            text += &self.term(f, &coefficient.clone().abs(), powers.iter().copied());
            if !inner.is_empty() {
                let inner = self.in_parentheses(&self.parts(f, inner));
                text += if self.markup == Markup::Latex { " " } else { "*" };
                text += &inner;
            }
        }
        text
    }

    /// The sum of its terms.
    fn expanded(self, f: &Fraction, part: &Polynomial) -> String {
        let mut text = String::new();
        for (m, c) in &part.terms {
            text += sign(text.is_empty(), c);
            let powers = m.exps().iter().copied().enumerate().filter(|(_, e)| *e > 0);
            text += &self.term(f, &c.clone().abs(), powers);
        }
        text
    }

    fn term(
        self,
        f: &Fraction,
        coefficient: &Rational,
        powers: impl Iterator<Item = (usize, u32)>,
    ) -> String {
        let mut powers = powers.map(|(at, e)| power(&f.variables[at], e, self.markup)).peekable();
        let number = match self.markup {
            _ if coefficient.is_one() && powers.peek().is_some() => None,
            Markup::Text => Some(coefficient.to_string()),
            Markup::Latex => Some(coefficient.latex()),
        };
        self.markup.product(number.into_iter().chain(powers))
    }
}

/// The sign in front of a term.
fn sign(first: bool, coefficient: &Rational) -> &'static str {
    match (first, coefficient.is_negative()) {
        (true, false) => "",
        (true, true) => "-",
        (false, false) => " + ",
        (false, true) => " - ",
    }
}

/// Where a polynomial stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Alone,
    Above,
    Below,
}

/// A product that may have more terms than this is not expanded to compare the lengths of both
/// texts.
const MAX_EXPANDED: u64 = 4096;

/// Whether the leading coefficient is negative. Then the text starts with a minus sign.
pub(super) fn leads_negative(f: &Polynomial) -> bool {
    f.lc().is_some_and(Rational::is_negative)
}

fn enclosed(text: String, needed: bool) -> String {
    if needed { format!("({text})") } else { text }
}

/// The number of factors of a single term, otherwise the number of terms.
fn factors_in(f: &Polynomial) -> usize {
    match &f.terms[..] {
        [(m, c)] => m.exps().iter().filter(|e| **e > 0).count() + usize::from(!c.is_one()),
        terms => terms.len(),
    }
}

fn power(name: &str, exponent: u32, markup: Markup) -> String {
    if let (Markup::Latex, Variable::Free(name)) = (markup, Variable::of(name)) {
        return latex_function(name) + &markup.exponent(exponent);
    }
    if let Some((function, argument)) = name.strip_suffix(')').and_then(|n| n.split_once('(')) {
        return function_power(function, argument, exponent, markup);
    }
    parameter(name, markup) + &markup.exponent(exponent)
}

/// The name of a parameter. Placeholders of [`texts`](super::texts) stay as they are.
pub(super) fn parameter(name: &str, markup: Markup) -> String {
    match markup {
        Markup::Latex if !name.starts_with(char::is_control) => latex_name(name),
        _ => name.to_owned(),
    }
}

/// `sin(x)^2`, `exp(2*x)`, `\sin^{2} x`, `e^{2 x}`, `\sqrt{x}`.
fn function_power(function: &str, argument: &str, exponent: u32, markup: Markup) -> String {
    let power = markup.exponent(exponent);
    let multiple = || match Variable::of(&format!("exp({argument})")).parts() {
        Some((product, parts)) => {
            let common = exponent.gcd(&parts);
            let number = Some(exponent / common).filter(|n| *n > 1).map(|n| format!("{n}*"));
            number.unwrap_or_default() + &part(product, parts / common)
        }
        None => argument.to_owned(),
    };
    match (markup, function) {
        (Markup::Text, "exp") => format!("exp({})", multiple()),
        (Markup::Text, _) => format!("{function}({argument}){power}"),
        (Markup::Latex, "exp") => format!("e^{{{}}}", latex_argument(&multiple())),
        (Markup::Latex, "sqrt") => format!("\\sqrt{{{}}}{power}", latex_argument(argument)),
        (Markup::Latex, _) if is_name(argument) => {
            format!("\\{function}{power} {}", latex_name(argument))
        }
        (Markup::Latex, _) => format!("\\{function}{power}({})", latex_argument(argument)),
    }
}

/// `a*x/2` is `\frac{a x}{2}`; a polynomial is written as such.
fn latex_argument(argument: &str) -> String {
    let (above, below) = match argument.rsplit_once('/') {
        Some((above, below)) => (above, Some(below)),
        None => (argument, None),
    };
    let above = above.parse().map_or_else(|_| above.to_owned(), |value: Symbolic| value.to_latex());
    below.map_or(above.clone(), |below| format!("\\frac{{{above}}}{{{below}}}"))
}

/// `f_r_theta(r,theta)` is `f_{,r \\theta}`, and `f1_t(t)` is `f_{1,t}`.
fn latex_function(variable: &str) -> String {
    let Ok(function) = FreeFunction::read(variable) else { return variable.into() };
    let by: Vec<String> = function.differentiated_by().map(latex_name).collect();
    let name = latex_name(function.name());
    match (by.is_empty(), name.strip_suffix('}').filter(|name| name.contains("_{"))) {
        (true, _) => name,
        (false, Some(name)) => format!("{name},{}}}", by.join(" ")),
        (false, None) => format!("{name}_{{,{}}}", by.join(" ")),
    }
}

/// `J11` is `J_{11}`, `lambda` is `\lambda`, `abc_x` is `\mathit{abc}_{x}`.
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

/// The Greek letters that LaTeX knows by name.
const GREEK: &str = "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa \
    lambda mu nu xi pi varpi rho varrho sigma varsigma tau upsilon phi varphi chi psi omega \
    Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega";
