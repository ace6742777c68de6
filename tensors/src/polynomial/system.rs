//! Systems of polynomial equations, and the decomposition of their real solutions.

use super::algebraic::RealNumber;
use super::factors::{self, primitive};
use super::groebner::{Outcome, basis, remainder};
use super::point::Point;
use super::quotient::{Found, Quotient, independent};
use super::{Budget, ORDER, Polynomial, TooLarge};
use crate::scalar::Variable;
use crate::stop::stage;
use crate::{Rational, Ring, Symbolic};
use num_traits::One;
use polycore::{Monomial, Order, Poly};
use std::cmp::Ordering;

/// The effort of the whole solution, in operations on terms.
const EFFORT: u64 = 150_000_000;
/// The effort of steps that only improve the result.
const SMALL_EFFORT: u64 = 4_000_000;
/// The largest number of letters.
const MAX_LETTERS: usize = 16;
/// The largest number of cases.
const MAX_CASES: usize = 4000;
/// The number of sample points that a family needs.
const SAMPLES: usize = 8;

/// Equations `p = 0` and inequations `q != 0` between polynomials in letters, over the real numbers.
///
/// ```
/// use affinor_tensors::polynomial::System;
/// use affinor_tensors::Symbolic;
/// let letters = ["x", "y"].map(String::from);
/// let polynomial = |text: &str| text.parse::<Symbolic>();
/// let equations = [polynomial("x^2 + y^2 - 5")?, polynomial("x*y - 2")?];
/// let system = System::new(&letters, &equations, &[]).ok_or("not polynomials")?;
/// let points = system.solve()?.points;
/// let values: Vec<String> = points.iter().map(|p| format!("{}", p.values()[0])).collect();
/// assert_eq!(values, ["-2", "-1", "1", "2"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct System {
    letters: Vec<String>,
    equations: Vec<Polynomial>,
    nonzero: Vec<Polynomial>,
    effort: u64,
}

/// All real solutions of a system: the union of the points and of the families.
#[derive(Clone, Debug, Default)]
pub struct SolutionSet {
    /// Isolated solutions, in ascending order of their coordinates. No point belongs to a family.
    pub points: Vec<Point>,
    /// Solution sets of positive dimension. No family contains another one, as far as the limits of
    /// the effort allow to decide this.
    pub families: Vec<Family>,
}

/// The solutions of some equations, whose complex solutions have positive dimension.
#[derive(Clone, Debug)]
pub struct Family {
    /// The equations, a Groebner basis. If the list is empty, all values are solutions.
    pub equations: Vec<Symbolic>,
    /// The letters that are independent. Their number is the dimension of the complex solutions.
    pub free: Vec<String>,
    /// Some real points of the family. If there are none, the family may have no real points.
    pub samples: Vec<Point>,
}

/// Points, and Groebner bases of families.
#[derive(Default)]
struct Parts {
    points: Vec<Point>,
    families: Vec<Vec<Polynomial>>,
}

impl System {
    /// The system of the numerators of some values. Returns `None` if a value contains a variable
    /// that is not one of the letters, such as a function.
    pub fn new(letters: &[String], equations: &[Symbolic], nonzero: &[Symbolic]) -> Option<Self> {
        let read = |values: &[Symbolic]| -> Option<Vec<Polynomial>> {
            values.iter().map(|value| polynomial(value, letters)).collect()
        };
        let (equations, nonzero) = (read(equations)?, read(nonzero)?);
        // a product does not vanish if its factors do not
        let split = |f: &Polynomial| match f.is_zero() {
            true => vec![f.clone()],
            false => factors::distinct_factors(f),
        };
        let nonzero = nonzero.iter().flat_map(split).collect();
        Some(System { letters: letters.to_vec(), equations, nonzero, effort: EFFORT })
    }

    /// The system with one more equation: a letter has a value.
    #[must_use]
    pub fn with_value(&self, letter: usize, value: &Rational) -> Self {
        let mut system = self.clone();
        system.equations.push(fixed(letter, value, self.letters.len()));
        system
    }

    /// The same system, solved with at most this effort, in operations on terms.
    #[must_use]
    pub fn with_effort(self, effort: u64) -> Self {
        System { effort, ..self }
    }

    /// The letters.
    pub fn letters(&self) -> &[String] {
        &self.letters
    }

    /// Whether all equations and inequations are homogeneous in some letters.
    pub fn is_homogeneous_in(&self, letters: &[bool]) -> bool {
        let degree = |m: &Monomial| -> u32 {
            m.exps().iter().zip(letters).filter(|(_, chosen)| **chosen).map(|(e, _)| e).sum()
        };
        let homogeneous = |f: &Polynomial| {
            let mut degrees = f.terms.iter().map(|(m, _)| degree(m));
            degrees.next().is_none_or(|first| degrees.all(|other| other == first))
        };
        self.equations.iter().chain(&self.nonzero).all(homogeneous)
    }

    /// Whether the inequations contain a letter as a whole.
    pub fn excludes_zero(&self, letter: usize) -> bool {
        self.nonzero.contains(&Poly::var(letter, self.letters.len(), ORDER))
    }

    /// All real solutions.
    ///
    /// # Errors
    /// [`TooLarge`] if the limits of the effort are exceeded.
    pub fn solve(&self) -> Result<SolutionSet, TooLarge> {
        let _stage = stage("polynomial equations");
        if self.letters.len() > MAX_LETTERS {
            return Err(TooLarge("it has more than 16 letters"));
        }
        let mut budget = Budget(self.effort);
        let parts = self.decompose(self.equations.clone(), &self.nonzero, &mut budget)?;
        let families = self.without_contained(parts.families);
        let on_family = |point: &Point| {
            let zero = |f: &Polynomial| point.sign_of(f).is_eq();
            families.iter().any(|family| family.iter().all(zero))
        };
        let mut points: Vec<Point> = vec![];
        for point in parts.points {
            if !on_family(&point) && !points.iter().any(|other| other.is_same(&point)) {
                points.push(point);
            }
        }
        points.sort_by(|p, q| {
            let pairs = p.values().iter().zip(q.values());
            pairs.map(|(x, y)| x.compare(y)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
        });
        let families = families.iter().map(|family| Family {
            equations: self.written(family),
            free: independent(family, self.letters.len())
                .into_iter()
                .map(|x| self.letters[x].clone())
                .collect(),
            samples: self.samples(family),
        });
        Ok(SolutionSet { points, families: families.collect() })
    }

    /// The sign of the numerator of a value at a point. Returns `None` if the value contains other
    /// variables.
    pub fn sign(&self, point: &Point, value: &Symbolic) -> Option<Ordering> {
        Some(point.sign_of(&polynomial(value, &self.letters)?))
    }

    /// A value at a point. Returns `None` if its denominator vanishes, or if it contains other
    /// variables.
    pub fn value(&self, point: &Point, value: &Symbolic) -> Option<RealNumber> {
        let above = polynomial(&value.numerator(), &self.letters)?;
        point.quotient(&above, &polynomial(&value.denominator(), &self.letters)?)
    }

    /// The numbers of positive, negative and zero eigenvalues of a symmetric matrix of polynomials at
    /// a point. Returns `None` if an entry contains other variables.
    pub fn inertia(&self, point: &Point, matrix: &[Vec<Symbolic>]) -> Option<[usize; 3]> {
        let rows = matrix.iter().map(|row| {
            row.iter().map(|value| polynomial(value, &self.letters)).collect::<Option<Vec<_>>>()
        });
        Some(point.inertia(&rows.collect::<Option<Vec<_>>>()?))
    }

    /// Decomposes the real solutions. In all of them, some polynomials do not vanish.
    fn decompose(
        &self,
        equations: Vec<Polynomial>,
        nonzero: &[Polynomial],
        budget: &mut Budget,
    ) -> Result<Parts, TooLarge> {
        let letters = self.letters.len();
        let mut parts = Parts::default();
        let mut open = vec![equations];
        let mut count = 0;
        if nonzero.iter().any(Poly::is_zero) {
            return Ok(parts);
        }
        while let Some(case) = open.pop() {
            count += 1;
            if count > MAX_CASES {
                return Err(TooLarge("it splits into more than 4000 cases"));
            }
            let found = match basis(&case, nonzero, &ORDER, budget)? {
                Outcome::Cases(cases) => {
                    open.extend(cases);
                    continue;
                }
                Outcome::Basis(found) => found,
            };
            if found.iter().any(|f| f.is_constant() && !f.is_zero()) {
                continue;
            }
            if independent(&found, letters).is_empty() {
                match Quotient::new(&found, letters)?.points(budget)? {
                    Found::Points(points) => parts.points.extend(
                        points.into_iter().filter(|p| nonzero.iter().all(|f| p.sign_of(f).is_ne())),
                    ),
                    Found::Equations(equations) => open
                        .extend(equations.into_iter().map(|f| [found.clone(), vec![f]].concat())),
                }
                continue;
            }
            match self.saturated(&found, nonzero, budget)? {
                Some(cases) => open.extend(cases),
                None => match basis(
                    &found,
                    nonzero,
                    &Order::Lex,
                    &mut Budget(SMALL_EFFORT.min(self.effort)),
                ) {
                    Ok(Outcome::Cases(cases)) => open.extend(cases),
                    Ok(Outcome::Basis(_)) | Err(_) => parts.families.push(found),
                },
            }
        }
        Ok(parts)
    }

    /// Removes the zeros of polynomials that must not vanish, by an inverse `t` of each. Returns the
    /// new cases, or `None` if the ideal has not changed.
    fn saturated(
        &self,
        found: &[Polynomial],
        nonzero: &[Polynomial],
        budget: &mut Budget,
    ) -> Result<Option<Vec<Vec<Polynomial>>>, TooLarge> {
        let letters = self.letters.len();
        let order = Order::elimination(1, letters);
        let extended = |f: &Polynomial, power: u32| {
            let terms = f
                .terms
                .iter()
                .map(|(m, c)| (Monomial::new([&[power], m.exps()].concat()), c.clone()));
            Poly::new(terms.collect(), letters + 1, order.clone())
        };
        let other: Vec<Polynomial> = nonzero.iter().map(|f| extended(f, 0)).collect();
        for q in nonzero {
            let one = Poly::constant(Rational::one(), letters + 1, order.clone());
            let mut equations: Vec<Polynomial> = found.iter().map(|f| extended(f, 0)).collect();
            equations.push(&extended(q, 1) - &one);
            let cases = match basis(&equations, &other, &order, budget)? {
                Outcome::Cases(cases) => cases,
                Outcome::Basis(basis) => {
                    let divisors: Vec<&Polynomial> = found.iter().collect();
                    let mut same = true;
                    for f in basis.iter().filter(|f| f.degree(0) == 0) {
                        let f = without_inverse(f, q);
                        same &= remainder(&f, &divisors, budget)?.is_zero();
                    }
                    if same {
                        continue;
                    }
                    vec![basis.into_iter().filter(|f| f.degree(0) == 0).collect()]
                }
            };
            let plain = |case: Vec<Polynomial>| {
                let plain = case.iter().map(|f| without_inverse(f, q));
                plain.filter(|f| !f.is_zero()).collect::<Vec<_>>()
            };
            return Ok(Some(cases.into_iter().map(plain).collect()));
        }
        Ok(None)
    }

    /// Removes families that belong to others, as far as this is decided with a small effort.
    fn without_contained(&self, families: Vec<Vec<Polynomial>>) -> Vec<Vec<Polynomial>> {
        let contained = |inner: &[Polynomial], outer: &[Polynomial]| {
            outer.iter().all(|f| {
                let mut budget = Budget(SMALL_EFFORT.min(self.effort));
                let nonzero = [self.nonzero.clone(), vec![primitive(f)]].concat();
                let parts = self.decompose(inner.to_vec(), &nonzero, &mut budget);
                parts.is_ok_and(|parts| parts.points.is_empty() && parts.families.is_empty())
            })
        };
        let mut kept: Vec<Vec<Polynomial>> = vec![];
        for family in families {
            if !kept.iter().any(|other| contained(&family, other)) {
                kept.retain(|other| !contained(other, &family));
                kept.push(family);
            }
        }
        kept
    }

    /// Real points of a family, for some values of its independent letters.
    fn samples(&self, family: &[Polynomial]) -> Vec<Point> {
        let free = independent(family, self.letters.len());
        let value = |numerator, denominator| Rational::new(numerator, denominator);
        let values = [
            value(1, 1),
            value(2, 1),
            value(3, 1),
            value(1, 2),
            value(5, 1),
            value(1, 3),
            value(-1, 1),
            value(7, 2),
            value(-2, 1),
            value(1, 7),
            value(-1, 3),
        ];
        let values: Vec<Rational> = values.into_iter().flatten().collect();
        let mut found = vec![];
        for pattern in 0..2 * values.len() {
            let fix = free.iter().enumerate().map(|(at, x)| {
                let value = &values[(pattern * (at + 1) + at * (pattern % 3)) % values.len()];
                fixed(*x, value, self.letters.len())
            });
            let equations = family.iter().cloned().chain(fix).collect();
            let parts = self.decompose(
                equations,
                &self.nonzero,
                &mut Budget(SMALL_EFFORT.min(self.effort)),
            );
            found.extend(parts.map(|parts| parts.points).unwrap_or_default());
            if found.len() >= SAMPLES {
                break;
            }
        }
        found
    }

    /// Polynomials as values, in a lexicographic basis if it is found with a small effort.
    fn written(&self, family: &[Polynomial]) -> Vec<Symbolic> {
        let lexicographic =
            basis(family, &self.nonzero, &Order::Lex, &mut Budget(SMALL_EFFORT.min(self.effort)));
        let found = match lexicographic {
            Ok(Outcome::Basis(found)) => found,
            _ => family.to_vec(),
        };
        found.iter().map(|f| symbolic(&primitive(f), &self.letters)).collect()
    }
}

/// The different factors of the numerator of a value, except for constants. They have coprime integer
/// coefficients, and a positive first coefficient. Variables that are functions are treated as
/// letters.
///
/// ```
/// use affinor_tensors::polynomial::distinct_factors;
/// use affinor_tensors::Symbolic;
/// let factors = distinct_factors(&"2*a*(a^2 - b^2)^2/c".parse::<Symbolic>()?);
/// let mut factors: Vec<String> = factors.iter().map(|factor| factor.to_string()).collect();
/// factors.sort();
/// assert_eq!(factors, ["a", "a + b", "a - b"]);
/// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
/// ```
pub fn distinct_factors(value: &Symbolic) -> Vec<Symbolic> {
    let terms = value.terms();
    let mut variables: Vec<Variable> =
        terms.iter().flat_map(|(powers, _)| powers.iter().map(|(variable, _)| *variable)).collect();
    variables.sort_unstable();
    variables.dedup();
    let terms = terms.into_iter().map(|(powers, c)| {
        let mut exponents = vec![0; variables.len()];
        for (variable, power) in powers {
            if let Ok(at) = variables.binary_search(&variable) {
                exponents[at] += power;
            }
        }
        (Monomial::new(exponents), c)
    });
    let f = Poly::new(terms.collect(), variables.len(), Order::GrLex);
    if f.is_zero() {
        return vec![];
    }
    factors::distinct_factors(&f)
        .iter()
        .map(|factor| combined(factor, |at| Symbolic::variable(variables[at])))
        .collect()
}

/// The equation `x - value`.
fn fixed(letter: usize, value: &Rational, letters: usize) -> Polynomial {
    let x = Poly::var(letter, letters, ORDER);
    &x - &Poly::constant(value.clone(), letters, ORDER)
}

/// Replaces the first variable by `1/q`, multiplies by a power of `q`, and removes the variable.
fn without_inverse(f: &Polynomial, q: &Polynomial) -> Polynomial {
    let degree = f.degree(0);
    let parts = (0..=degree).map(|power| {
        let terms = f.terms.iter().filter(|(m, _)| m.exps()[0] == power);
        let terms = terms.map(|(m, c)| (Monomial::new(m.exps()[1..].to_vec()), c.clone()));
        &Poly::new(terms.collect(), q.nvars, ORDER) * &q.pow(degree - power)
    });
    parts.fold(Poly::zero(q.nvars, ORDER), |sum, part| &sum + &part)
}

/// The numerator of a value as a polynomial in the letters.
fn polynomial(value: &Symbolic, letters: &[String]) -> Option<Polynomial> {
    let terms = value.terms().into_iter().map(|(powers, c)| {
        let mut exponents = vec![0; letters.len()];
        for (variable, power) in powers {
            let text = variable.text();
            let known = variable.is_parameter();
            exponents[letters.iter().position(|letter| known && letter == text)?] += power;
        }
        Some((Monomial::new(exponents), c))
    });
    Some(Poly::new(terms.collect::<Option<Vec<_>>>()?, letters.len(), ORDER))
}

/// The polynomial as a value.
fn symbolic(f: &Polynomial, letters: &[String]) -> Symbolic {
    combined(f, |at| Symbolic::parameter(&letters[at]))
}

/// The value of a polynomial in some values.
fn combined(f: &Polynomial, letter: impl Fn(usize) -> Symbolic) -> Symbolic {
    let terms = f.terms.iter().map(|(m, c)| {
        let powers = m.exps().iter().enumerate().filter(|(_, power)| **power > 0);
        powers.fold(Symbolic::constant(c.clone()), |product, (at, power)| {
            product * &num_traits::pow(letter(at), *power as usize)
        })
    });
    terms.fold(Symbolic::from_i64(0), |sum, term| sum + &term)
}
