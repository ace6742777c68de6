//! Sample points: rational values for the variables of functions, and the power series of the
//! functions around the point.

use super::power_series::{Monomials, PowerSeries};
use super::residue::Residue;
use affinor_tensors::scalar::Variable;
use affinor_tensors::{Field, Notation, Rational, Ring, Symbolic};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::HashMap;
use std::sync::Arc;

/// Rational values of the variables of [`Symbolic`] values, drawn on their first use.
///
/// Coordinates, parameters, free functions and their derivatives get random positive values. A
/// function such as `tan(x/2)` or `exp(x)` gets a rational number near its value. It is
/// algebraically independent of the coordinates, so the rank of a matrix of formulas at such a point
/// is the generic one, unless the point is special. A root gets the root of the value of its
/// argument, which must be rational.
#[derive(Clone, Debug)]
pub(super) struct Point {
    random: u64,
    /// Whether parameters and coordinates may be negative.
    is_signed: bool,
    values: HashMap<Variable, Rational>,
    /// The parameters in the order in which they were drawn.
    drawn: Vec<(Variable, Rational)>,
}

/// The reason why a point does not serve.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Unfit {
    /// Another point may serve: a denominator vanishes, or a root is irrational.
    Retry(String),
    /// The root of a number is irrational at every point.
    Never(String),
}

impl Unfit {
    /// The reason in words.
    pub fn reason(&self) -> String {
        match self {
            Unfit::Retry(reason) | Unfit::Never(reason) => reason.clone(),
        }
    }
}

impl Point {
    /// The point with a number; equal numbers give equal points.
    pub fn new(seed: u64) -> Self {
        let random = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        Point { random, is_signed: false, values: HashMap::new(), drawn: vec![] }
    }

    /// The point with a number, whose parameters and coordinates have random signs.
    pub fn signed(seed: u64) -> Self {
        Point { is_signed: true, ..Self::new(seed) }
    }

    /// The values of the parameters and free functions that were used, by name.
    pub fn values(&self) -> Vec<(String, Rational)> {
        let mut values: Vec<_> = self.drawn.clone();
        values.sort_by_key(|(variable, _)| *variable);
        values.into_iter().map(|(variable, value)| (variable.to_string(), value)).collect()
    }

    /// Whether no value was needed: all functions are rational constants.
    pub fn is_exact(&self) -> bool {
        self.values.is_empty()
    }

    /// A random number below `limit`.
    fn draw(&mut self, limit: u64) -> u64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 33) % limit
    }

    /// A random number, positive unless the point is signed, with a short numerator and denominator.
    fn number(&mut self) -> Rational {
        let numerator = 1 + self.draw(24) as i64;
        let denominator = [1, 1, 2, 3, 4, 5, 9][self.draw(7) as usize];
        let sign = if self.is_signed && self.draw(2) == 1 { -1 } else { 1 };
        Rational::new(sign * numerator, denominator).unwrap_or_else(Rational::one)
    }

    /// The value of a variable.
    fn variable(&mut self, variable: Variable) -> Result<Rational, Unfit> {
        if let Some(known) = self.values.get(&variable) {
            return Ok(known.clone());
        }
        let value = if let Some((argument, order)) = variable.root() {
            let value = self.value(argument)?;
            root(&value, order).ok_or_else(|| {
                let message = format!("{variable} is irrational");
                match argument.as_constant() {
                    Some(_) => Unfit::Never(message),
                    None => Unfit::Retry(message),
                }
            })?
        } else if variable.is_parameter() || variable.free_function().is_some() {
            let value = self.number();
            self.drawn.push((variable, value.clone()));
            value
        } else {
            self.function(variable)
        };
        self.values.insert(variable, value.clone());
        Ok(value)
    }

    /// A short rational number near the value of a transcendental function.
    fn function(&mut self, variable: Variable) -> Rational {
        let own = Symbolic::variable(variable);
        for name in own.parameters() {
            // parameters have values at every point
            let _ = self.variable(Variable::from(name.as_str()));
        }
        let lookup = |name: &str| self.values.get(&Variable::from(name)).map(Rational::to_f64);
        let exact = own.evaluate(lookup).filter(|value| value.abs() > 1e-3 && value.abs() < 1e4);
        exact.and_then(near).unwrap_or_else(|| self.number())
    }

    /// The value of a function at the point.
    pub fn value(&mut self, function: &Symbolic) -> Result<Rational, Unfit> {
        if let Some(constant) = function.as_constant() {
            return Ok(constant.clone());
        }
        let numerator = self.polynomial(&function.numerator())?;
        let denominator = self.polynomial(&function.denominator())?;
        let inverse = denominator.recip();
        let inverse = inverse.ok_or_else(|| Unfit::Retry("a denominator vanishes".into()))?;
        Ok(numerator * &inverse)
    }

    fn polynomial(&mut self, polynomial: &Symbolic) -> Result<Rational, Unfit> {
        let mut sum = Rational::zero();
        for (powers, coefficient) in polynomial.terms() {
            let mut term = coefficient;
            for (variable, exponent) in powers {
                term *= &num_traits::pow(self.variable(variable)?, exponent as usize);
            }
            sum += &term;
        }
        Ok(sum)
    }
}

/// The positive root of a positive number, if it is rational.
fn root(value: &Rational, order: u32) -> Option<Rational> {
    let big = BigRational::from(value);
    let root = |n: &BigInt| {
        let root = n.nth_root(order);
        (root.pow(order) == *n).then_some(root)
    };
    let positive = big.is_positive().then_some(&big)?;
    Some(BigRational::new(root(positive.numer())?, root(positive.denom())?).into())
}

/// A rational number near a float, with a denominator up to 12 that reaches one part in 50.
fn near(value: f64) -> Option<Rational> {
    let close = |d: i64| ((value * d as f64).round() / d as f64 - value).abs() < value.abs() / 50.0;
    let denominator = (1..=12).find(|d| close(*d));
    match denominator {
        Some(d) => Rational::new((value * d as f64).round() as i64, d),
        None => Rational::new(1, (1.0 / value).round() as i64),
    }
}

/// Power series of functions of the coordinates around a [`Point`].
pub(super) struct Expansion<'p> {
    point: &'p mut Point,
    coordinates: &'p [String],
    monomials: Arc<Monomials>,
    known: HashMap<(Variable, usize), PowerSeries>,
}

impl<'p> Expansion<'p> {
    /// Expansions up to a total degree.
    pub fn new(point: &'p mut Point, coordinates: &'p [String], degree: usize) -> Self {
        let monomials = Arc::new(Monomials::new(coordinates.len(), degree));
        Expansion { point, coordinates, monomials, known: HashMap::new() }
    }

    /// The series of a function up to a degree.
    pub fn series(&mut self, function: &Symbolic, degree: usize) -> Result<PowerSeries, Unfit> {
        if let Some(constant) = function.as_constant() {
            return residue(constant).map(PowerSeries::constant);
        }
        let numerator = self.polynomial(&function.numerator(), degree)?;
        let denominator = self.polynomial(&function.denominator(), degree)?;
        let inverse = denominator.recip();
        let inverse = inverse.ok_or_else(|| Unfit::Retry("a denominator vanishes".into()))?;
        Ok(numerator * &inverse)
    }

    fn polynomial(&mut self, polynomial: &Symbolic, degree: usize) -> Result<PowerSeries, Unfit> {
        let mut powers: HashMap<(Variable, u32), PowerSeries> = HashMap::new();
        let mut sum = PowerSeries::zero();
        for (factors, coefficient) in polynomial.terms() {
            let mut term = PowerSeries::constant(residue(&coefficient)?);
            for (variable, exponent) in factors {
                let power = match powers.get(&(variable, exponent)) {
                    Some(power) => power.clone(),
                    None => {
                        let base = self.variable(variable, degree)?;
                        let power = num_traits::pow(base, exponent as usize);
                        powers.insert((variable, exponent), power.clone());
                        power
                    }
                };
                term = term * &power;
            }
            sum = sum + &term;
        }
        Ok(sum)
    }

    /// The series of a variable, from the series of its derivatives.
    fn variable(&mut self, variable: Variable, degree: usize) -> Result<PowerSeries, Unfit> {
        if let Some(known) = self.known.get(&(variable, degree)) {
            return Ok(known.clone());
        }
        let value = residue(&self.point.variable(variable)?)?;
        let function = Symbolic::variable(variable);
        let mut derivatives = vec![];
        if degree > 0 {
            for (at, coordinate) in self.coordinates.iter().enumerate() {
                let derivative = Notation::derivative(&function, coordinate);
                if !derivative.vanishes() {
                    derivatives.push((at, self.series(&derivative, degree - 1)?));
                }
            }
        }
        let series = PowerSeries::from_derivatives(&self.monomials, degree, value, &derivatives);
        self.known.insert((variable, degree), series.clone());
        Ok(series)
    }
}

fn residue(value: &Rational) -> Result<Residue, Unfit> {
    Residue::of(value).ok_or_else(|| Unfit::Retry("a denominator vanishes".into()))
}
