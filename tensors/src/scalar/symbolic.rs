//! Rational functions of named parameters over the rationals. They are always in lowest terms.
//!
//! A value without parameters is a [`Rational`]. Any other value is a quotient of coprime
//! polynomials in exactly the parameters on which it depends, in alphabetical order. A parameter is
//! identified by its name, so any two values can be combined. Equal values have equal forms. Sines,
//! cosines, exponentials, logarithms, square roots and free functions are rational functions of
//! additional variables.

mod approximation;
mod argument;
mod cache;
mod canonical;
mod collected;
mod common;
mod conjugates;
mod denominator;
mod derivative;
mod differences;
mod elementary;
mod factors;
mod fraction;
mod free;
mod memo;
mod normal_form;
mod numeric;
mod once;
mod operators;
mod packed;
mod polynomial;
mod positive;
mod product;
mod shape;
mod square_root;
mod substitution;
mod sum;
mod variable;
mod writing;

use super::{Field, Kind, Notation, Rational, Ring, Summable, Tabular, divisors};
use crate::expression::is_name;
use fraction::Fraction;
use polynomial::Polynomial;
use std::collections::BTreeSet;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;
use variable::Kind as Evaluator;
use writing::Markup;

pub use common::CommonFactors;
pub use free::FreeFunction;
pub use positive::PositiveFactors;
pub use variable::Variable;

/// The factors of a primitive polynomial with a positive leading coefficient, in graded
/// lexicographic order. Each factor is repeated by its multiplicity, and has a flag that tells
/// whether it is known to be irreducible.
pub(crate) fn polynomial_factors(f: &Polynomial) -> Vec<(Polynomial, bool)> {
    factors::parts(f).into_iter().map(|part| (part.polynomial, part.irreducible)).collect()
}

/// Clears the caches of symbolic values in the current thread.
pub(super) fn clear_caches() {
    once::clear();
    memo::clear();
}

/// A rational function of named parameters. It has rational coefficients, and is in lowest terms.
///
/// The denominator has coprime integer coefficients, and its first coefficient is positive. Terms
/// are sorted by total degree, in descending order, and then alphabetically (`J2` before `J10`).
///
/// ```
/// use affinor_tensors::{Rational, Symbolic};
/// let [a, b] = ["a", "b"].map(Symbolic::parameter);
/// let difference = a.clone() * &a - &(b.clone() * &b);
/// assert_eq!(difference.clone() / &(a.clone() - &b), a.clone() + &b);
///
/// let four = Symbolic::constant(Rational::from(4));
/// assert_eq!((difference / &(four * &b)).to_string(), "(a^2 - b^2)/(4*b)");
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Symbolic(Form);

#[derive(Clone, PartialEq, Eq)]
enum Form {
    Constant(Rational),
    Fraction(Arc<Fraction>),
}

impl Symbolic {
    /// The parameter with this name.
    ///
    /// This function accepts any name, but only identifiers can be parsed from the text.
    /// [`Notation::parameter`] rejects other names.
    pub fn parameter(name: &str) -> Self {
        Self::variable(Variable::parameter(name))
    }

    /// The value that is a single variable.
    pub fn variable(variable: Variable) -> Self {
        Fraction::variable(variable).into()
    }

    /// The variable, if the value is a single variable; otherwise `None`.
    fn as_variable(&self) -> Option<Variable> {
        match self.variables() {
            [variable] if *self == Self::variable(*variable) => Some(*variable),
            _ => None,
        }
    }

    /// The name of the parameter, if the value is a single parameter; otherwise `None`.
    pub fn as_parameter(&self) -> Option<&'static str> {
        self.as_variable().filter(|variable| variable.is_parameter()).map(Variable::text)
    }

    /// The number pi.
    pub fn pi() -> Self {
        Self::variable(Variable::function(Evaluator::Pi))
    }

    /// The constant function.
    pub fn constant(value: Rational) -> Self {
        Symbolic(Form::Constant(value))
    }

    /// The value as a number. Returns `None` if it depends on a parameter.
    pub fn as_constant(&self) -> Option<&Rational> {
        match &self.0 {
            Form::Constant(c) => Some(c),
            Form::Fraction(_) => None,
        }
    }

    /// The value in the mathematics mode of LaTeX, such as `\frac{a}{b}`.
    pub fn to_latex(&self) -> String {
        self.written(Markup::Latex, &CommonFactors::default())
    }

    /// The names of the parameters on which the value depends, in alphabetical order. For `sin(x)`,
    /// the list contains `x`.
    pub fn parameters(&self) -> Vec<String> {
        let own = self.variables().iter().flat_map(|variable| variable.parameters());
        let mut parameters: Vec<Variable> = own.collect();
        if !parameters.is_sorted_by(|a, b| a < b) {
            parameters.sort_unstable();
            parameters.dedup();
        }
        parameters.into_iter().map(|parameter| parameter.text().to_string()).collect()
    }

    /// The variables of the fraction: parameters, and the functions `tan(x/2)`, `exp(x)`, `log(x)`
    /// and `sqrt(x)` of parameters.
    fn variables(&self) -> &[Variable] {
        match &self.0 {
            Form::Constant(_) => &[],
            Form::Fraction(f) => &f.variables,
        }
    }

    /// The numerator `N` of the value `N / D`. It is a polynomial with rational coefficients.
    pub fn numerator(&self) -> Self {
        match &self.0 {
            Form::Constant(_) => self.clone(),
            Form::Fraction(f) => f.polynomial(&f.numerator),
        }
    }

    /// The denominator `D` of the value `N / D`. It is a polynomial with coprime integer
    /// coefficients, and its first coefficient is positive. It is 1 for constants and polynomials.
    pub fn denominator(&self) -> Self {
        match &self.0 {
            Form::Constant(_) => Self::from_i64(1),
            Form::Fraction(f) => f.polynomial(&f.expanded_denominator()),
        }
    }

    /// The partial derivative with respect to a variable of the fraction.
    fn partial(&self, variable: Variable) -> Self {
        match (&self.0, self.variables().iter().position(|own| *own == variable)) {
            (Form::Fraction(f), Some(variable)) => f.derivative(variable),
            _ => Self::from_i64(0),
        }
    }

    /// The terms of the [`numerator`](Self::numerator), each with the powers of its parameters and
    /// its coefficient.
    ///
    /// The terms of a polynomial are its components in the basis of monomials. The denominator of a
    /// polynomial is 1, so constant denominators are part of the coefficients. For other values,
    /// only the terms of the numerator are listed. Zero has no terms. Functions of a parameter `x`
    /// occur as powers of the variables `tan(x/2)` and `exp(x)`.
    ///
    /// ```
    /// use affinor_tensors::{Rational, Symbolic};
    /// let half = Symbolic::constant(Rational::new(1, 2).unwrap());
    /// let terms = (Symbolic::parameter("a") * &half).terms();
    /// let (powers, coefficient) = &terms[0];
    /// assert_eq!((powers[0].0.to_string(), powers[0].1), ("a".to_string(), 1));
    /// assert_eq!(*coefficient, Rational::new(1, 2).unwrap());
    /// ```
    pub fn terms(&self) -> Vec<(Vec<(Variable, u32)>, Rational)> {
        match &self.0 {
            Form::Constant(_) if self.vanishes() => Vec::new(),
            Form::Constant(c) => vec![(Vec::new(), c.clone())],
            Form::Fraction(f) => {
                let powers = |exponents: &[u32]| {
                    let powers = f.variables.iter().zip(exponents).filter(|(_, e)| **e > 0);
                    powers.map(|(variable, &e)| (*variable, e)).collect()
                };
                let terms = f.numerator.terms.iter();
                terms.map(|(m, c)| (powers(m.exps()), c.clone())).collect()
            }
        }
    }
}

impl Ring for Symbolic {
    fn from_i64(n: i64) -> Self {
        Self::constant(n.into())
    }
    fn vanishes(&self) -> bool {
        self.as_constant().is_some_and(Rational::vanishes)
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        Rational::new(numerator, denominator).map(Self::constant)
    }
}

impl Summable for Symbolic {
    type Sum = sum::SymbolicSum;
    const GROWS: bool = true;
    fn clear_denominators<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<i64>, i64)> {
        let constants: Vec<_> = values.map(Self::as_constant).collect::<Option<_>>()?;
        Rational::clear_denominators(constants.into_iter())
    }
}

impl Field for Symbolic {
    fn recip(&self) -> Option<Self> {
        match &self.0 {
            Form::Constant(c) => c.recip().map(Self::constant),
            Form::Fraction(f) => {
                divisors::record(self);
                canonical::reciprocal(f)
            }
        }
    }
    fn pivot_weight(&self) -> f64 {
        match &self.0 {
            // a constant is the best pivot, because a division by a constant needs no common
            // divisors
            Form::Constant(c) => 1.0 / (1.0 + c.size() as f64),
            Form::Fraction(_) => -(self.size() as f64),
        }
    }
}

impl Notation for Symbolic {
    const KIND: Kind = Kind::Symbolic;
    fn from_rational(value: &Rational) -> Option<Self> {
        Some(Self::constant(value.clone()))
    }
    /// Returns `None` unless the name is an identifier, or the text of a function variable. An
    /// identifier is an ASCII letter or `_`, followed by letters, digits or `_`. Function variables
    /// are for example `tan(x/2)`, `exp(a*x)` and `sqrt(x)`.
    fn parameter(name: &str) -> Option<Self> {
        match name {
            "pi" => Some(Symbolic::pi()),
            _ => is_name(name).then(|| Symbolic::parameter(name)),
        }
    }
    fn to_f64(&self) -> Option<f64> {
        match self.as_constant() {
            Some(c) => Some(c.to_f64()),
            None if self.variables().iter().all(|own| own.parameters().next().is_none()) => {
                self.evaluate(|_| None)
            }
            None => None,
        }
    }
    fn latex(&self) -> String {
        self.to_latex()
    }
    fn is_negative(&self) -> bool {
        self.is_negative_with(&CommonFactors::default())
    }
    /// The functions `sin`, `cos`, `tan`, `cot`, `exp`, `sinh`, `cosh` and `tanh` accept
    /// combinations of products of parameters, such as `2*x - a*y/2`. The functions `sqrt` and
    /// `log` accept numbers, irreducible polynomials, and other arguments for which
    /// [`PositiveFactors`] determines the sign.
    fn function(name: &str, argument: &Self) -> Result<Self, String> {
        PositiveFactors::default().function(name, argument)
    }
    /// Accepts the functions of one argument that [`function`](Self::function) accepts. Also
    /// accepts free functions of names, such as `a(t)` and its derivative `a_t(t)`.
    fn call(name: &str, arguments: &[Self]) -> Result<Self, String> {
        Self::called(name, arguments)
    }
    fn derivative(&self, name: &str) -> Self {
        Symbolic::derivative(self, name)
    }
    fn numerator_terms(&self) -> Vec<(Vec<(Variable, u32)>, Rational)> {
        self.terms()
    }
    fn read_back(&self) -> Self {
        self.without_conditions()
    }
    fn variable(variable: Variable) -> Option<Self> {
        Some(Symbolic::variable(variable))
    }
    fn parameters(&self) -> Vec<String> {
        Symbolic::parameters(self)
    }
    fn parameters_of(values: &mut dyn Iterator<Item = &Self>) -> BTreeSet<String> {
        let variables = variable::distinct(values.map(Self::variables));
        let parameters = variables.into_iter().flat_map(|variable| variable.parameters());
        parameters.map(|parameter| parameter.text().to_string()).collect()
    }
    /// An upper bound of the size of the sum. It consists of the sizes of the products over a
    /// common denominator.
    fn sum_size(&self, other: &Self) -> usize {
        let ([n, d], [m, e]) = (self.expanded_parts(), other.expanded_parts());
        if let (Form::Fraction(f), Form::Fraction(g)) = (&self.0, &other.0)
            && f.variables == g.variables
            && f.denominator == g.denominator
        {
            return [n, m, d].iter().fold(0, |sum, (size, _)| sum.saturating_add(*size));
        }
        let products = [(n, e), (m, d), (d, e)].map(|(p, q)| meeting(p, q));
        products.into_iter().fold(0, usize::saturating_add)
    }
    fn product_size(&self, other: &Self) -> usize {
        let ([n, d], [m, e]) = (self.parts(), other.parts());
        meeting(n, m).saturating_add(meeting(d, e))
    }
    /// The number of bits of the coefficients plus the degrees of the terms. The size is the sum
    /// over the numerator and the factors of the denominator.
    fn size(&self) -> usize {
        let [(above, _), (below, _)] = self.parts();
        if self.as_constant().is_some() { above } else { above.saturating_add(below) }
    }
}

impl Tabular for Symbolic {
    fn common_factors(values: &mut dyn Iterator<Item = &Self>, taken: &[String]) -> CommonFactors {
        CommonFactors::of(values, taken)
    }
    fn text_with(&self, factors: &CommonFactors) -> String {
        self.written(Markup::Text, factors)
    }
    fn latex_with(&self, factors: &CommonFactors) -> String {
        self.written(Markup::Latex, factors)
    }
    fn is_negative_with(&self, factors: &CommonFactors) -> bool {
        match &factors.written(self).0 {
            Form::Constant(c) => c.is_negative(),
            Form::Fraction(f) => shape::leads_negative(&f.numerator),
        }
    }
    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.hash(&mut hasher);
        hasher.finish()
    }
}

impl Symbolic {
    /// Whether the value may contain sines, cosines or roots. Their written form differs from the
    /// stored form.
    fn has_written_form(&self) -> bool {
        let written = |variable: &Variable| {
            let kind = variable.kind();
            matches!(
                kind,
                Evaluator::HalfTangent(_) | Evaluator::Exponential(_) | Evaluator::Root(_)
            )
        };
        self.variables().iter().any(written)
    }

    /// The sizes as in [`parts`](Self::parts), but with a bound for the expanded denominator, by
    /// which a sum multiplies the other numerator.
    fn expanded_parts(&self) -> [(usize, usize); 2] {
        let [above, below] = self.parts();
        let Form::Fraction(f) = &self.0 else { return [above, below] };
        let mut degrees = vec![1u64; f.variables.len()];
        for (factor, e) in &f.denominator.factors {
            let own = factor.polynomial.degrees().into_iter();
            for (at, degree) in
                variable::places(&factor.variables, &f.variables).into_iter().zip(own)
            {
                degrees[at] += u64::from(degree) * u64::from(*e);
            }
        }
        let dense = degrees.iter().fold(1, |product: u64, degree| product.saturating_mul(*degree));
        let terms = usize::try_from(dense.min(f.denominator.terms())).unwrap_or(usize::MAX);
        let degree = usize::try_from(f.denominator.degree()).unwrap_or(usize::MAX);
        [above, (terms.saturating_mul(degree.saturating_add(1)), terms)]
    }

    /// The size and the number of terms, for the numerator and for the denominator. Products
    /// preserve the factors of denominators, so the sizes of factors are added and nothing is
    /// expanded.
    fn parts(&self) -> [(usize, usize); 2] {
        match &self.0 {
            Form::Constant(c) => [(c.size(), 1), (1, 1)],
            Form::Fraction(f) => {
                let monomial: u32 = f.denominator.monomial.iter().sum();
                let factors = f.denominator.factors.iter();
                let below = factors.map(|(g, e)| size(&g.polynomial).saturating_add(*e as usize));
                let below = below.fold(1 + monomial as usize, usize::saturating_add);
                [(size(&f.numerator), f.numerator.terms.len()), (below, 1)]
            }
        }
    }
}

/// The size of a product of two sums. Every term of one sum is multiplied by every term of the
/// other.
fn meeting((p, terms): (usize, usize), (q, others): (usize, usize)) -> usize {
    p.saturating_mul(others).saturating_add(q.saturating_mul(terms))
}

/// The number of bits of the coefficients plus the degrees of the terms.
fn size(polynomial: &Polynomial) -> usize {
    let terms = polynomial.terms.iter();
    let sizes = terms.map(|(m, c)| c.size().saturating_add(m.degree() as usize));
    sizes.fold(0, usize::saturating_add)
}

impl fmt::Display for Symbolic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(Markup::Text, &CommonFactors::default()))
    }
}

impl fmt::Debug for Symbolic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
