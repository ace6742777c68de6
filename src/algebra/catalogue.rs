//! The catalogue: Lie algebras by name.
//!
//! [`algebra`] returns the Lie algebra with a name such as `so(3,1)`, `E8` or `bianchi(VI,h=-1/2)`,
//! over any scalar. [`find`] returns its [`Entry`]: labels, structure constants and, for matrix
//! algebras, the matrices. [`families`] lists all families with their bases.
//!
//! Families of matrix algebras are defined by matrices, from which the constants are computed
//! ([`MatrixBasis::bracket`]). The simple complex types come from their roots
//! ([`chevalley_constants`](crate::algebra::roots::chevalley_constants)), and the Bianchi types
//! from their symmetric matrix and vector.
//!
//! Parentheses may be omitted if the name stays unambiguous: `so3` is so(3). `so31` is rejected,
//! because so(31) and so(3,1) both exist.

mod bianchi;
mod compact;
mod complexified;
mod error;
mod euclidean;
mod kinematical;
mod linear;
mod name;
mod nilpotent;
mod orthogonal;
mod quaternionic;
mod simple;
mod solvable;
mod symplectic;
mod tables;
mod triangular;
mod unitary;

pub use error::CatalogueError;

use crate::Error;
use crate::algebra::{Bracket, Complex, LieAlgebra, MatrixBasis};
use affinor_tensors::{Notation, Rational, Ring, Scalar, Symbolic, Tolerance};
use name::Argument;

/// The largest dimension of an algebra of the catalogue.
pub const MAX_DIMENSION: usize = crate::algebra::roots::MAX_DIMENSION;

/// Returns the Lie algebra of the catalogue with this name, over the scalar `S`.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::Rational;
/// let so3 = catalogue::algebra::<Rational>("so(3)")?;
/// assert_eq!(so3.to_string(), "[e1, e2] = e3\n[e1, e3] = -e2\n[e2, e3] = e1");
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// The errors of [`find`]; [`CatalogueError::Parameter`] if a structure constant does not exist in
/// `S`: it depends on a parameter, or is out of range.
pub fn algebra<S: Notation + Scalar>(name: &str) -> Result<LieAlgebra<S>, Error> {
    let entry = find(name)?;
    let value = |value: &Symbolic| {
        let refused =
            || CatalogueError::Parameter { name: entry.name.clone(), value: value.to_string() };
        Ok(polynomial(value).ok_or_else(refused)?)
    };
    entry.bracket::<S, Error>(value)?.try_into()
}

/// Converts a polynomial in the parameters to the scalar `S`. Returns `None` if a parameter does
/// not exist in `S`.
fn polynomial<S: Notation + Scalar>(value: &Symbolic) -> Option<S> {
    value.terms().into_iter().try_fold(S::zero(), |sum, (powers, coefficient)| {
        let mut powers = powers.into_iter();
        let term = powers.try_fold(S::from_rational(&coefficient)?, |term, (variable, power)| {
            Some(term * &num_traits::pow(S::parameter(variable.text())?, power as usize))
        });
        Some(sum + &term?)
    })
}

/// Returns the entry of the catalogue with this name: labels and structure constants.
///
/// ```
/// let entry = affinor::algebra::catalogue::find("so3")?;
/// assert_eq!((entry.name.as_str(), entry.dimension()), ("so(3)", 3));
/// # Ok::<(), affinor::algebra::catalogue::CatalogueError>(())
/// ```
///
/// # Errors
/// [`CatalogueError`]. Its message lists similar or possible names.
pub fn find(name: &str) -> Result<Entry, CatalogueError> {
    if let Some(other) = name::of_real_form(name) {
        return Ok(name::resolve(&other)?.build());
    }
    Ok(name::resolve(name)?.build())
}

/// All families, in the order in which they are listed.
pub fn families() -> &'static [Family] {
    FAMILIES
}

/// The names of the algebras of a dimension, family by family. Borel and parabolic subalgebras are
/// omitted, and parameters have no values. The list is empty for dimensions above
/// [`MAX_DIMENSION`].
///
/// ```
/// let names = affinor::algebra::catalogue::names(2);
/// assert!(names.contains(&"aff(1)".to_string()) && !names.contains(&"so(3)".to_string()));
/// ```
pub fn names(dimension: usize) -> Vec<String> {
    if dimension > MAX_DIMENSION {
        return vec![];
    }
    FAMILIES.iter().flat_map(|family| family.names(dimension)).collect()
}

static FAMILIES: &[Family] = &[
    solvable::ABELIAN,
    orthogonal::DEFINITE,
    orthogonal::INDEFINITE,
    quaternionic::SKEW,
    complexified::ORTHOGONAL,
    unitary::FAMILY,
    unitary::INDEFINITE,
    unitary::FULL,
    linear::SPECIAL,
    complexified::LINEAR,
    quaternionic::LINEAR,
    linear::GENERAL,
    linear::AFFINE,
    symplectic::FAMILY,
    complexified::SYMPLECTIC,
    quaternionic::INDEFINITE,
    quaternionic::COMPACT,
    euclidean::FAMILY,
    euclidean::EXTENDED,
    kinematical::POINCARE,
    kinematical::GALILEI,
    kinematical::SIMILARITIES,
    kinematical::HOMOTHETIES,
    kinematical::CONFORMAL,
    kinematical::SCHROEDINGER,
    kinematical::OSCILLATOR,
    triangular::TRIANGULAR,
    triangular::STRICT,
    triangular::BOREL,
    triangular::PARABOLIC,
    solvable::HEISENBERG,
    nilpotent::FREE,
    nilpotent::FILIFORM,
    nilpotent::FILIFORM_Q,
    nilpotent::DAMEK_RICCI,
    bianchi::FAMILY,
    tables::PATERA,
    tables::DE_GRAAF,
    tables::GONG,
    simple::A,
    simple::B,
    simple::C,
    simple::D,
    simple::E,
    simple::F,
    simple::G,
    compact::FAMILY,
];

/// An algebra of the catalogue: a name, a basis and its structure constants.
#[non_exhaustive]
#[derive(Clone, Debug)]
pub struct Entry {
    /// The full name, such as `so(3)` for `so3`; [`find`] accepts it.
    pub name: String,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    /// The nonzero structure constants `(j, k, i, v)`, `[e_j, e_k] = ... + v e_i`, from 0, with `j
    /// < k`, sorted.
    pub constants: Vec<(usize, usize, usize, Symbolic)>,
    /// The parameters of the constants, in alphabetical order.
    pub parameters: Vec<String>,
    /// For a matrix algebra: the matrices from which the constants were computed.
    pub matrices: Option<MatrixBasis<Rational>>,
}

impl Entry {
    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.labels.len()
    }

    /// Converts the constants by `value_of` and returns the bracket.
    ///
    /// # Errors
    /// The first error of `value_of`.
    pub fn bracket<S: Scalar, E: From<Error>>(
        &self,
        value_of: impl Fn(&Symbolic) -> Result<S, E>,
    ) -> Result<Bracket<S>, E> {
        let constants = self.constants.iter();
        let constants = constants.map(|(j, k, i, value)| Ok((*j, *k, *i, value_of(value)?)));
        let constants = constants.collect::<Result<Vec<_>, E>>()?;
        Ok(Bracket::from_constants(&self.labels, constants)?)
    }

    fn new(
        name: String,
        labels: Vec<String>,
        constants: impl IntoIterator<Item = (usize, usize, usize, Symbolic)>,
    ) -> Self {
        Self::of_constants(name, labels, constants.into_iter().collect())
    }

    /// Builds an entry from a list. This function is compiled once, and not for each family.
    fn of_constants(
        name: String,
        labels: Vec<String>,
        mut constants: Vec<(usize, usize, usize, Symbolic)>,
    ) -> Self {
        constants.retain(|(.., value)| !value.vanishes());
        constants.sort_unstable_by_key(|&(j, k, i, _)| (j, k, i));
        let values = constants.iter().map(|(.., value)| value);
        let mut parameters: Vec<_> = values.flat_map(Symbolic::parameters).collect();
        parameters.sort();
        parameters.dedup();
        Entry { name, labels, constants, parameters, matrices: None }
    }

    /// The entry as in [`new`](Self::new), with integer constants.
    fn of_integers(
        name: String,
        labels: Vec<String>,
        constants: impl IntoIterator<Item = (usize, usize, usize, i64)>,
    ) -> Self {
        let constants = constants.into_iter();
        let constants = constants.map(|(j, k, i, value)| (j, k, i, Symbolic::from_i64(value)));
        Self::new(name, labels, constants)
    }

    /// The algebra of `size` x `size` matrices. Each matrix is a list of its nonzero entries, with
    /// indices from 0.
    fn of_matrices(
        name: String,
        labels: Vec<String>,
        size: usize,
        matrices: Vec<Vec<(usize, usize, Complex<Rational>)>>,
    ) -> Self {
        let matrices = MatrixBasis::new(labels, size, matrices, Tolerance::default())
            .expect("every family of matrices is linearly independent");
        let bracket = matrices.bracket().expect("every family of matrices is closed");
        let components = bracket.structure_constants().components();
        let constants = components
            .filter(|(at, _)| at[1] < at[2])
            .map(|(at, value)| (at[1], at[2], at[0], Symbolic::constant(value.clone())));
        let entry = Self::new(name, matrices.labels().to_vec(), constants);
        Entry { matrices: Some(matrices), ..entry }
    }

    /// The entry as in [`of_matrices`](Self::of_matrices), with integer entries of the matrices.
    fn of_integer_matrices(
        name: String,
        labels: Vec<String>,
        size: usize,
        matrices: impl IntoIterator<Item = Vec<(usize, usize, i64)>>,
    ) -> Self {
        let real = |(i, j, v): (usize, usize, i64)| (i, j, Complex::real(Rational::from(v)));
        let matrices = matrices.into_iter();
        let matrices = matrices.map(|entries| entries.into_iter().map(real).collect());
        Self::of_matrices(name, labels, size, matrices.collect())
    }
}

/// A family of the catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// The pattern of its names, such as `so(p,q)`.
    pub pattern: &'static str,
    /// The condition on the arguments, such as `p, q >= 1`.
    pub needs: &'static str,
    /// A description that lists the basis in order.
    pub summary: &'static str,
    /// One of its names.
    pub example: &'static str,
    reader: Reader,
}

/// The parser of the arguments of a family.
#[derive(Clone, Copy, Debug)]
enum Reader {
    /// Reads `count` integers. `dimension` computes the dimension of the algebra, with saturation,
    /// and returns `None` if no algebra has these arguments.
    Integers {
        count: usize,
        dimension: fn(&[usize]) -> Option<usize>,
        build: fn(String, &[usize]) -> Entry,
    },
    /// Reads arguments that may be words. The function has the full name and the arguments as
    /// parameters.
    Words(fn(&str, &[Argument]) -> Result<Entry, CatalogueError>),
}

impl Family {
    /// The word with which the names of the family begin.
    fn head(&self) -> &'static str {
        let end = self.pattern.find(['(', '^']).unwrap_or(self.pattern.len() - 1);
        &self.pattern[..end]
    }

    /// The names of the algebras of this family with the given dimension.
    fn names(&self, dimension: usize) -> Vec<String> {
        let Reader::Integers { count, dimension: of, .. } = self.reader else {
            let all = match self.head() {
                "bianchi" => bianchi::names(),
                _ => tables::names(self),
            };
            let fits = |name: &String| find(name).is_ok_and(|e| e.dimension() == dimension);
            return all.into_iter().filter(fits).collect();
        };
        // limits the search: no argument exceeds the dimension by more than two, in any family
        let most = dimension + 2;
        let first = (1..=most).map(|n| vec![n]);
        let arguments: Vec<Vec<usize>> = match count {
            1 => first.collect(),
            _ => first.flat_map(|p| (1..=most).map(move |q| vec![p[0], q])).collect(),
        };
        let fits = |numbers: &Vec<usize>| of(numbers) == Some(dimension);
        let written = |numbers: Vec<usize>| {
            numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
        };
        arguments.into_iter().filter(fits).map(|numbers| self.name(&written(numbers))).collect()
    }

    /// The last argument, if it is a letter: the field in `sl(n,C)`.
    fn letter(&self) -> Option<&'static str> {
        let last = self.pattern.strip_suffix(')')?.rsplit(',').next()?;
        matches!(last, "C" | "H").then_some(last)
    }

    /// The name of an algebra with these arguments, in the form of the pattern.
    fn name(&self, arguments: &str) -> String {
        let head = self.head();
        if let Some(letter) = self.letter() {
            return format!("{head}({arguments},{letter})");
        }
        match self.pattern[head.len()..].chars().next() {
            Some('(') => format!("{head}({arguments})"),
            Some('^') => format!("{head}^{arguments}"),
            _ => format!("{head}{arguments}"),
        }
    }
}

/// The names `e1 ... en`, if `letter` is `e`.
fn numbered(letter: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{letter}{i}")).collect()
}

/// The name of the matrix unit at `(i, j)`: `E12` for the letter `E` and the position (0, 1) in
/// matrices of size `n`. The name is `E1_12` if an index can have two digits.
fn at(letter: &str, (i, j): (usize, usize), n: usize) -> String {
    let between = if n < 10 { "" } else { "_" };
    format!("{letter}{}{between}{}", i + 1, j + 1)
}

/// The pairs `i < j` below `n`, in lexicographic order.
fn pairs(n: usize) -> impl DoubleEndedIterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

/// The number of [`pairs`], with saturation.
fn pair_count(n: usize) -> usize {
    n.saturating_mul(n.saturating_sub(1)) / 2
}
