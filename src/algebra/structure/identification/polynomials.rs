//! Small systems of polynomial equations over the rationals. The solver finds one solution, by
//! elimination where possible, and otherwise by a search.
//!
//! A polynomial is a sparse row, whose columns are codes of monomials. The code of a monomial
//! contains its variables, six bits for each. A set of equations is therefore a matrix. Its echelon
//! form eliminates monomials of high degree, or of low degree if the columns are reversed.

use super::{Subspace, collected, scale};
use crate::algebra::irreducible_factors;
use affinor_tensors::{Field, Rational};
use num_rational::BigRational;
use polycore::Uni;

/// The number of bits of a variable in the code of a monomial.
const BITS: usize = 6;
/// The largest number of variables of a system.
pub(super) const MAX_VARIABLES: usize = (1 << BITS) - 1;
/// The largest degree that a substitution may reach. The code of a monomial can contain ten
/// variables.
const MAX_DEGREE: usize = 8;
/// The largest number of terms that a substitution may reach.
const MAX_TERMS: usize = 400;

/// The code of a monomial, with 64 bits on every machine.
type Monomial = u64;

/// A polynomial: a list of monomials with their coefficients.
pub(super) type Polynomial = Vec<(Monomial, Rational)>;

/// The variables of a monomial, from the largest to the smallest; variables count from 0.
fn variables(code: Monomial) -> Vec<usize> {
    let digit = |place: usize| (code >> (BITS * place)) as usize & MAX_VARIABLES;
    let digits = (0..=MAX_DEGREE + 1).rev().map(digit);
    digits.filter(|digit| *digit > 0).map(|digit| digit - 1).collect()
}

/// The code of the monomial whose variables are given in decreasing order.
fn code(variables: &[usize]) -> Monomial {
    variables.iter().fold(0, |code, variable| code << BITS | (*variable as Monomial + 1))
}

fn degree(code: Monomial) -> usize {
    (Monomial::BITS - code.leading_zeros()).div_ceil(BITS as u32) as usize
}

/// The total degree of a polynomial.
fn total(polynomial: &[(Monomial, Rational)]) -> usize {
    polynomial.iter().map(|(at, _)| degree(*at)).max().unwrap_or(0)
}

/// The polynomial that is a single variable.
pub(super) fn variable(at: usize) -> Polynomial {
    vec![(code(&[at]), Rational::from(1))]
}

fn times(a: Monomial, b: Monomial) -> Monomial {
    let mut all = [variables(a), variables(b)].concat();
    all.sort_unstable_by(|x, y| y.cmp(x));
    code(&all)
}

/// The product of two polynomials.
pub(super) fn product(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let terms = a.iter().flat_map(|(i, x)| b.iter().map(move |(j, y)| (i, x, j, y)));
    collected(terms.map(|(i, x, j, y)| (times(*i, *j), x.clone() * y)).collect())
}

/// The sum of two polynomials.
pub(super) fn plus(a: &Polynomial, b: &Polynomial) -> Polynomial {
    collected(a.iter().chain(b).cloned().collect())
}

/// The coefficients of the powers of the variable `of`.
fn in_powers(polynomial: &Polynomial, of: usize) -> Vec<Polynomial> {
    let mut powers: Vec<Polynomial> = vec![];
    for (at, value) in polynomial {
        let (own, rest): (Vec<usize>, Vec<usize>) =
            variables(*at).into_iter().partition(|v| *v == of);
        powers.resize(powers.len().max(own.len() + 1), vec![]);
        powers[own.len()].push((code(&rest), value.clone()));
    }
    powers.into_iter().map(collected).collect()
}

/// Substitutes the polynomial `by` for the variable `of`. Returns `None` if the result is too
/// large.
fn substituted(polynomial: &Polynomial, of: usize, by: &Polynomial) -> Option<Polynomial> {
    let powers = in_powers(polynomial, of);
    if powers.len() <= 1 {
        return Some(polynomial.clone());
    }
    powers.iter().rev().try_fold(vec![], |sum, coefficient| {
        let fits = total(&sum) + total(by) <= MAX_DEGREE;
        let next = plus(&product(&sum, by), if fits { coefficient } else { return None });
        (next.len() <= MAX_TERMS).then_some(next)
    })
}

/// The variables that occur in a polynomial.
fn occurring(polynomial: &Polynomial) -> Vec<usize> {
    let mut all: Vec<usize> = polynomial.iter().flat_map(|(at, _)| variables(*at)).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The value of a polynomial at the point `at`.
pub(super) fn value(polynomial: &Polynomial, at: &impl Fn(usize) -> Rational) -> Rational {
    let term = |(code, factor): &(Monomial, Rational)| {
        variables(*code).into_iter().fold(factor.clone(), |product, v| product * &at(v))
    };
    polynomial.iter().map(term).fold(Rational::from(0), |sum, term| sum + &term)
}

/// The rational roots of a polynomial in one variable; `coefficients` begins with the constant
/// term.
fn roots(coefficients: &[Rational]) -> Vec<Rational> {
    let polynomial = Uni::new(coefficients.iter().map(BigRational::from).collect());
    let linear = irreducible_factors(&polynomial).into_iter().filter(|(f, _)| f.deg() == 1);
    linear
        .filter_map(|(f, _)| {
            let [constant, lead] = [0, 1].map(|at| Rational::from(f.0[at].clone()));
            Some(-(constant * &lead.recip()?))
        })
        .collect()
}

/// A system of equations, and the polynomials `results`, in which the same substitutions are made.
#[derive(Clone)]
pub(super) struct System {
    pub equations: Vec<Polynomial>,
    pub results: Vec<Polynomial>,
}

/// A conclusion from one equation: a substitution, or a further equation.
enum Step {
    Replace(usize, Polynomial),
    Beside(Polynomial),
}

/// A search with a limited number of steps.
pub(super) struct Search<'a> {
    /// The test whether `results` may still lead to a solution.
    pub admissible: &'a dyn Fn(&[Polynomial]) -> bool,
    /// The variables, in the order in which they are assigned.
    pub order: &'a [usize],
    /// The number of variables that are assigned before polynomials of higher degree are
    /// eliminated.
    pub first: usize,
    /// The seed that determines the order of trial values.
    pub seed: usize,
    /// The number of remaining steps.
    pub left: usize,
}

impl Search<'_> {
    /// Solves the system, and returns the values of `results` at the solution.
    pub fn solve(&mut self, mut system: System) -> Option<Vec<Rational>> {
        loop {
            self.left = self.left.checked_sub(1)?;
            // reverses the order of the columns, so that they begin with the highest monomial
            system.equations = turned(&reduced(&turned(&system.equations)));
            if system.equations.iter().any(|row| total(row) == 0)
                || !(self.admissible)(&system.results)
            {
                return None;
            }
            let linear = system.equations.iter().find(|row| total(row) == 1);
            if let Some((at, by)) = linear.and_then(|row| self.isolated(row)) {
                system = system.with(at, &by)?;
                continue;
            }
            let rising = reduced(&system.equations);
            let branches = system.equations.iter().chain(&rising).find_map(factors);
            if let Some(branches) = branches {
                return branches.into_iter().find_map(|steps| {
                    let next =
                        steps.into_iter().try_fold(system.clone(), |system, step| match step {
                            Step::Replace(at, by) => system.with(at, &by),
                            Step::Beside(by) => {
                                let mut system = system;
                                system.equations.push(by);
                                Some(system)
                            }
                        })?;
                    self.solve(next)
                });
            }
            let free = |v: &&usize| {
                let all = system.equations.iter().chain(&system.results);
                all.flat_map(occurring).any(|other| other == **v)
            };
            let next = self.order.iter().position(|v| free(&v));
            let Some(place) = next else {
                let constant = |row: &Polynomial| value(row, &|_| Rational::from(0));
                return system
                    .equations
                    .is_empty()
                    .then(|| system.results.iter().map(constant).collect());
            };
            if place >= self.first {
                let mut short: Vec<&Polynomial> = system.equations.iter().collect();
                short.sort_by_key(|row| (total(row), row.len()));
                let next = short
                    .into_iter()
                    .filter_map(|row| self.isolated(row))
                    .find_map(|(at, by)| system.clone().with(at, &by));
                if let Some(next) = next {
                    system = next;
                    continue;
                }
            }
            let at = self.order[place];
            return self.values(place).into_iter().find_map(|number| {
                let by = collected(vec![(0, Rational::from(number))]);
                self.solve(system.clone().with(at, &by)?)
            });
        }
    }

    /// Trial values: small numbers, in an order that depends on the seed.
    fn values(&self, place: usize) -> Vec<i64> {
        let mixed = (self.seed * 7 + place * 5 + self.seed * place * 3) % 11;
        match (self.seed, mixed) {
            (0, _) => vec![0, 1, -1],
            (_, 0..=3) => vec![0, 1, 2],
            (_, 4..=6) => vec![1, 0, -1],
            (_, 7) => vec![-1, 1],
            (_, 8) => vec![2, 1],
            _ => vec![-2, 3],
        }
    }

    /// Finds a variable that occurs in only one term of an equation, with a constant factor.
    /// Returns the variable and the polynomial that equals it.
    fn isolated(&self, row: &Polynomial) -> Option<(usize, Polynomial)> {
        // prefers variables that would be assigned last
        self.order.iter().rev().find_map(|&at| {
            let powers = in_powers(row, at);
            let [rest, factor] = &powers[..] else { return None };
            let [(0, factor)] = &factor[..] else { return None };
            Some((at, scale(rest, &-factor.recip()?)))
        })
    }
}

impl System {
    fn with(self, at: usize, by: &Polynomial) -> Option<System> {
        let all = |rows: &[Polynomial]| -> Option<Vec<Polynomial>> {
            rows.iter().map(|row| substituted(row, at, by)).collect()
        };
        Some(System { equations: all(&self.equations)?, results: all(&self.results)? })
    }
}

/// The equations in reduced row echelon form.
fn reduced(rows: &[Polynomial]) -> Vec<Polynomial> {
    let mut columns: Vec<Monomial> = rows.iter().flatten().map(|(at, _)| *at).collect();
    columns.sort_unstable();
    columns.dedup();
    let column = |at: &Monomial| columns.partition_point(|other| other < at);
    let numbered = |row: &Polynomial| row.iter().map(|(at, v)| (column(at), v.clone())).collect();
    let echelon = Subspace::span(columns.len(), rows.iter().map(numbered));
    let named = |row: &Vec<(usize, Rational)>| {
        row.iter().map(|(column, value)| (columns[*column], value.clone())).collect()
    };
    echelon.basis().iter().map(named).collect()
}

/// Reverses the order of the columns.
fn turned(rows: &[Polynomial]) -> Vec<Polynomial> {
    let turn = |row: &Polynomial| {
        row.iter().rev().map(|(at, value)| (Monomial::MAX - at, value.clone())).collect()
    };
    rows.iter().map(turn).collect()
}

/// Splits an equation into cases. The equation must have a common variable, or have one variable
/// only, or be homogeneous in two variables.
fn factors(row: &Polynomial) -> Option<Vec<Vec<Step>>> {
    let all = occurring(row);
    let common = all.iter().find(|at| row.iter().all(|(code, _)| variables(*code).contains(at)));
    if let Some(&at) = common {
        let quotient = in_powers(row, at);
        let quotient = quotient[1..].iter().enumerate().flat_map(|(power, rest)| {
            let power = code(&vec![at; power]);
            rest.iter().map(move |(code, value)| (times(power, *code), value.clone()))
        });
        let quotient = collected(quotient.collect());
        let other = (total(&quotient) > 0).then(|| vec![Step::Beside(quotient)]);
        return Some(other.into_iter().chain([vec![Step::Replace(at, vec![])]]).collect());
    }
    let coefficients = |at: usize| -> Vec<Rational> {
        let one = |_| Rational::from(1);
        in_powers(row, at).iter().map(|rest| value(rest, &one)).collect()
    };
    match all[..] {
        [at] => {
            let by = |root| vec![Step::Replace(at, collected(vec![(0, root)]))];
            Some(roots(&coefficients(at)).into_iter().map(by).collect())
        }
        [x, y] if row.iter().all(|(code, _)| degree(*code) == total(row)) => {
            // a root r yields the case x = r y; the other case is x = y = 0
            let by = |root| vec![Step::Replace(x, scale(&variable(y), &root))];
            let zero = vec![Step::Replace(x, vec![]), Step::Replace(y, vec![])];
            Some(roots(&coefficients(x)).into_iter().map(by).chain([zero]).collect())
        }
        _ => None,
    }
}
