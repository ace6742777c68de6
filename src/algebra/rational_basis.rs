//! Bases in which the structure constants contain no square roots.
//!
//! Let every structure constant be a rational number times the square root of a rational number.
//! Then multiples `e'_i = e_i / d_i` with rational `d_i^2` may have rational structure constants
//! `c^i_jk d_i / (d_j d_k)`. For each prime `p`, the bits "p divides `d_i^2`" satisfy linear
//! equations over the field of two elements: the bits of `d_i`, `d_j`, `d_k` and `c^i_jk` have the
//! sum 0. The same holds for irreducible polynomials in parameters instead of primes.

use crate::algebra::frame::Frame;
use crate::{Error, Law, LieAlgebra};
use affinor_tensors::scalar::Variable;
use affinor_tensors::{Down, Field, Rational, Symbolic, Tensor, Up};
use num_traits::One;
use std::collections::BTreeSet;

/// If at most `FREE` unknowns are free, all solutions of the linear equations are compared.
const FREE: usize = 12;

/// An algebra in a basis `e'_i = e_i / d_i` whose structure constants contain no square roots.
///
/// ```
/// use affinor::algebra::RationalBasis;
/// use affinor::{Bracket, LieAlgebra, Symbolic};
/// use affinor_tensors::scalar::PositiveFactors;
/// let root = PositiveFactors::default().function("sqrt", &Symbolic::from(3))?;
/// let constants = [(0, 1, 2, root.clone()), (1, 2, 0, root.clone()), (0, 2, 1, -root)];
/// let algebra = LieAlgebra::try_from(Bracket::from_constants(["x", "y", "z"], constants)?)?;
/// let basis = RationalBasis::of(&algebra)?;
/// assert_eq!(basis.algebra().labels(), ["x/sqrt(3)", "y", "z"]);
/// assert_eq!(basis.algebra().structure_constants().get(&[2, 0, 1]), Symbolic::from(1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RationalBasis {
    algebra: LieAlgebra<Symbolic>,
    divisors: Vec<Symbolic>,
}

impl RationalBasis {
    /// Finds multiples of the basis vectors, so that the structure constants are rational, or
    /// rational functions of parameters. If several solutions exist and few unknowns are free, the
    /// solution that changes the fewest basis vectors is chosen.
    ///
    /// # Errors
    /// [`Law::RationalConstants`] with a structure constant that prevents a rational basis. Either
    /// the constant is not a rational number times a square root, or its equation contradicts the
    /// other equations.
    pub fn of(algebra: &LieAlgebra<Symbolic>) -> Result<Self, Error> {
        let (n, structure) = (algebra.dimension(), algebra.structure_constants());
        let refused = |at: &[usize], value: &Symbolic| {
            let at = [at[1], at[2], at[0]].map(|at| algebra.labels()[at].clone());
            Law::RationalConstants.broken(at, value.to_string())
        };
        let mut roots: Vec<Variable> = vec![];
        let mut equations = vec![];
        for (at, value) in structure.components().filter(|(at, _)| at[1] < at[2]) {
            let class = class(value).ok_or_else(|| refused(&at, value))?;
            let new =
                class.iter().filter(|root| !roots.contains(root)).copied().collect::<Vec<_>>();
            roots.extend(new);
            equations.push((at, value, class));
        }
        if roots.is_empty() {
            return Ok(RationalBasis {
                algebra: algebra.clone(),
                divisors: vec![Symbolic::one(); n],
            });
        }
        // sorts rational constants first, so that a contradiction is reported for a constant with a
        // square root
        equations.sort_by_key(|(_, _, class)| !class.is_empty());
        let mut system = System::new(n);
        for (at, value, class) in &equations {
            let bits = class.iter().filter_map(|root| roots.iter().position(|own| own == root));
            system.add(at, bits.collect()).map_err(|Contradiction| refused(at, value))?;
        }
        let mut divisors = vec![Symbolic::one(); n];
        for (number, root) in roots.iter().enumerate() {
            for at in system.smallest_solution(number) {
                divisors[at] *= &Symbolic::variable(*root);
            }
        }
        let constants = structure.components().map(|(at, value)| {
            let below = divisors[at[1]].clone() * &divisors[at[2]];
            let inverse = below.recip().ok_or_else(|| refused(&at, value))?;
            Ok((at, value.clone() * &divisors[at[0]] * &inverse))
        });
        let constants = constants.collect::<Result<Vec<_>, Error>>()?;
        let structure = Tensor::from_components(n, &[Up, Down, Down], constants)?;
        let labels =
            algebra.labels().iter().zip(&divisors).map(|(label, divisor)| multiple(label, divisor));
        // no check is needed, because a change of basis preserves the Jacobi identity
        let algebra =
            LieAlgebra { frame: Frame::invariant(labels.collect::<Vec<_>>(), structure)? };
        Ok(RationalBasis { algebra, divisors })
    }

    /// The algebra in the new basis. The labels show the multiples: `e8/sqrt(3)`.
    pub fn algebra(&self) -> &LieAlgebra<Symbolic> {
        &self.algebra
    }

    /// The divisors `d_i` of the basis vectors: 1, or square roots.
    pub fn divisors(&self) -> &[Symbolic] {
        &self.divisors
    }

    /// Whether any basis vector has a divisor other than 1.
    pub fn is_new(&self) -> bool {
        self.divisors.iter().any(|divisor| !divisor.is_one())
    }

    /// The algebra over the rational numbers; `None` if its structure constants have parameters.
    pub fn over_the_rationals(&self) -> Option<LieAlgebra<Rational>> {
        let structure = self.algebra.structure_constants();
        let rational = structure.components().all(|(_, value)| value.as_constant().is_some());
        let convert = |value: &Symbolic| value.as_constant().cloned().unwrap_or_default();
        let frame =
            rational.then(|| Frame::invariant(self.algebra.labels(), structure.map(convert)));
        Some(LieAlgebra { frame: frame?.ok()? })
    }
}

/// The name of `label / divisor`. The divisor is the square root of a rational function.
fn multiple(label: &str, divisor: &Symbolic) -> String {
    match divisor.is_one() {
        true => label.to_string(),
        false => format!("{label}/sqrt({})", divisor.clone() * divisor),
    }
}

/// The set of square roots whose product is the value, up to a rational function; returns `None` if
/// the value is not such a product.
fn class(value: &Symbolic) -> Option<BTreeSet<Variable>> {
    let [above, below] = [class_of_sum(&value.numerator())?, class_of_sum(&value.denominator())?];
    Some(&above ^ &below)
}

/// The square roots that occur in every term of a polynomial.
fn class_of_sum(sum: &Symbolic) -> Option<BTreeSet<Variable>> {
    let classes = sum.terms().into_iter().map(|(powers, _)| {
        let mut class = BTreeSet::new();
        for (variable, power) in powers {
            match variable.root() {
                None if variable.is_parameter() => {}
                Some((argument, 2)) if is_rational(argument) => {
                    if power % 2 == 1 {
                        class.insert(variable);
                    }
                }
                _ => return None,
            }
        }
        Some(class)
    });
    let mut classes = classes.collect::<Option<Vec<_>>>()?.into_iter();
    let first = classes.next().unwrap_or_default();
    classes.all(|class| class == first).then_some(first)
}

/// Whether a value is a rational function of parameters.
fn is_rational(value: &Symbolic) -> bool {
    let only_parameters = |part: Symbolic| {
        let terms = part.terms();
        terms.iter().flat_map(|(powers, _)| powers).all(|(variable, _)| variable.is_parameter())
    };
    only_parameters(value.numerator()) && only_parameters(value.denominator())
}

/// The error for an equation of [`System`] that contradicts earlier equations.
struct Contradiction;

/// Linear equations `x_i + x_j + x_k = b` over the field of two elements, in reduced echelon form.
/// Several right-hand sides share the same left-hand sides.
struct System {
    unknowns: usize,
    /// For each unknown, the equation whose pivot is this unknown.
    pivots: Vec<Option<Equation>>,
    /// For each unknown, whether any equation contains it.
    used: Vec<bool>,
}

#[derive(Clone, Default)]
struct Equation {
    left: BTreeSet<usize>,
    /// The indices of the right-hand sides that are 1.
    right: BTreeSet<usize>,
}

impl Equation {
    fn add(&mut self, other: &Equation) {
        self.left = &self.left ^ &other.left;
        self.right = &self.right ^ &other.right;
    }
}

impl System {
    fn new(unknowns: usize) -> Self {
        System { unknowns, pivots: vec![None; unknowns], used: vec![false; unknowns] }
    }

    /// Adds the equation whose left-hand side is the sum of `unknowns`. An unknown that occurs
    /// twice cancels.
    fn add(&mut self, unknowns: &[usize], right: BTreeSet<usize>) -> Result<(), Contradiction> {
        let mut equation = Equation { left: BTreeSet::new(), right };
        for at in unknowns {
            self.used[*at] = true;
            if !equation.left.remove(at) {
                equation.left.insert(*at);
            }
        }
        for at in equation.left.clone() {
            if let Some(known) = &self.pivots[at] {
                equation.add(known);
            }
        }
        let Some(pivot) = equation.left.first().copied() else {
            return if equation.right.is_empty() { Ok(()) } else { Err(Contradiction) };
        };
        for known in self.pivots.iter_mut().flatten().filter(|known| known.left.contains(&pivot)) {
            known.add(&equation);
        }
        self.pivots[pivot] = Some(equation);
        Ok(())
    }

    /// The unknowns that are 1 in a solution for the right-hand side `number`. If few unknowns are
    /// free, the solution has the fewest such unknowns.
    fn smallest_solution(&self, number: usize) -> BTreeSet<usize> {
        let known =
            || self.pivots.iter().enumerate().filter_map(|(at, known)| Some((at, known.as_ref()?)));
        let one = known().filter(|(_, known)| known.right.contains(&number)).map(|(at, _)| at);
        let mut solution: BTreeSet<usize> = one.collect();
        let mut best = solution.clone();
        let free = (0..self.unknowns).filter(|at| self.used[*at] && self.pivots[*at].is_none());
        // for each free unknown, the changes of the solution if this unknown is 1
        let changes: Vec<BTreeSet<usize>> = free
            .take(FREE)
            .map(|free| {
                let with =
                    known().filter(|(_, known)| known.left.contains(&free)).map(|(at, _)| at);
                with.chain([free]).collect()
            })
            .collect();
        // follows a Gray code, which changes one free unknown in each step
        for step in 1..1usize << changes.len() {
            solution = &solution ^ &changes[step.trailing_zeros() as usize];
            if solution.len() < best.len() {
                best.clone_from(&solution);
            }
        }
        best
    }
}
