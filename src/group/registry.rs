//! The registry of groups. It contains a group for every name in the catalogue of algebras.
//!
//! [`find`] returns the group for a name such as `se(3)`, `heisenberg(5)` or `so3+R^3`.
//! [`families`] lists the groups in closed form. The groups of other algebras are defined by their
//! matrices or, near the identity, by their brackets. The group of a sum of algebras is the direct
//! product of their groups, with the basis of the sum.
//!
//! | algebra | an element as written ([`MatrixNotation::write`](super::MatrixNotation::write)) |
//! |---|---|
//! | in the list | a matrix, or a column for `R^n` |
//! | given by matrices, as `so(4)`, `gl(2)` or `sl(2,C)` | the matrix; of complex matrices `A + iB` the real `[[A, -B], [B, A]]` |
//! | nilpotent, given by brackets | a column of canonical coordinates of the first kind |
//! | any other given by brackets | the matrix of `exp(ad_x)`, extended by derivations if there is a centre |
//! | a sum | one column: the entries of each factor as above, row by row, factor after factor |
//!
//! For example, an element of `se3+se3` has 32 numbers, which are two 4 x 4 matrices; an element of
//! `so3+R^3` has 9 + 3. In formulas for motions, the names of the coordinates of factor `k` end in
//! `_k`, such as `x_2`, `qw_1` and `g11_2`.

use super::{
    AnyGroup, Heisenberg, Homotheties, MatrixGroup, Nilpotent, Product, Se2, Se3, Se23, Sl2, So2,
    So3, Translations,
};
use crate::algebra::catalogue;
use crate::{Error, Law, LieAlgebra};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Rational, Symbolic};
use nalgebra::{DMatrix, Dyn};

/// A family of groups in closed form.
#[derive(Clone, Copy, Debug)]
pub struct GroupFamily {
    /// The name in the catalogue of algebras, in which `n` represents a number.
    pub pattern: &'static str,
    /// The written form of elements.
    pub summary: &'static str,
    /// Builds the group for a number `n`.
    build: fn(usize) -> AnyGroup,
}

/// The groups in closed form.
pub fn families() -> &'static [GroupFamily] {
    FAMILIES
}

static FAMILIES: &[GroupFamily] = &[
    family("R^n", "columns of n coordinates", |n| AnyGroup::new(Translations(Dyn(n)))),
    family("so(2)", "rotation matrices of size 2", |_| AnyGroup::new(So2)),
    family("so(3)", "rotation matrices of size 3", |_| AnyGroup::new(So3)),
    family("se(2)", "homogeneous matrices of size 3", |_| AnyGroup::new(Se2)),
    family("se(3)", "homogeneous matrices of size 4", |_| AnyGroup::new(Se3)),
    family("se_2(3)", "matrices [[R, v, p], [0, 1]] of size 5", |_| AnyGroup::new(Se23)),
    family("sl(2)", "matrices of size 2 and determinant 1", |_| AnyGroup::new(Sl2)),
    family("heisenberg(n)", "upper triangular matrices of size m + 2, n = 2m + 1", |n| {
        AnyGroup::new(Heisenberg::of_pairs(n / 2))
    }),
    family("hom(n)", "matrices [[a, b], [0, 1]] of size n + 1, a > 0", |n| {
        AnyGroup::new(Homotheties::of_space(n))
    }),
];

const fn family(
    pattern: &'static str,
    summary: &'static str,
    build: fn(usize) -> AnyGroup,
) -> GroupFamily {
    GroupFamily { pattern, summary, build }
}

/// The group for a name of the catalogue, or for several names joined by `+`.
///
/// ```
/// use affinor::group::{LieGroup, registry};
/// for (name, dimension) in [("so3+R^3", 6), ("heisenberg(5)", 5), ("se_2(3)", 9), ("su(3)", 8)] {
///     assert_eq!(registry::find(name)?.dimension(), dimension);
/// }
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Name`] for an unknown name or a name with parameters; the errors of [`of_algebra`].
pub fn find(name: &str) -> Result<AnyGroup, Error> {
    let mut factors = summands(name).into_iter().map(factor);
    let first = factors.next().unwrap_or_else(|| factor(name))?;
    factors.try_fold(first, |product, next| Ok(AnyGroup::new(Product(product, next?))))
}

/// A group of an algebra that is given by its brackets. The group is simply connected if the
/// algebra is nilpotent. Otherwise, it is a group of matrices near the identity.
///
/// # Errors
/// The errors of [`MatrixGroup::of_algebra`].
pub fn of_algebra(algebra: &LieAlgebra<f64>) -> Result<AnyGroup, Error> {
    match Nilpotent::new(algebra.clone()) {
        Ok(group) => Ok(AnyGroup::new(group)),
        Err(Error::Broken { law: Law::Nilpotent, .. }) => {
            MatrixGroup::of_algebra(algebra).map(AnyGroup::new)
        }
        Err(error) => Err(error),
    }
}

/// The names in a sum. A `+` inside parentheses does not separate names.
pub fn summands(name: &str) -> Vec<&str> {
    let mut depth = 0_i64;
    let joins = |symbol: char| {
        depth += i64::from(symbol == '(') - i64::from(symbol == ')');
        symbol == '+' && depth == 0
    };
    name.split(joins).collect()
}

fn factor(name: &str) -> Result<AnyGroup, Error> {
    let refused =
        |reason: String| Error::Name(format!("no group named `{}`: {reason}", name.trim()));
    let entry = catalogue::find(name.trim()).map_err(|error| refused(error.to_string()))?;
    let closed =
        |family: &GroupFamily| Some((family.build)(argument(family.pattern, &entry.name)?));
    if let Some(group) = FAMILIES.iter().find_map(closed) {
        return Ok(group);
    }
    if let Some(matrices) = &entry.matrices {
        let dense = |m: &Matrix<Rational>| {
            DMatrix::from_fn(m.rows(), m.columns(), |i, j| m.get(i, j).to_f64())
        };
        let matrices: Vec<_> = matrices.matrices().iter().map(dense).collect();
        return MatrixGroup::with_labels(&matrices, &entry.labels).map(AnyGroup::new);
    }
    let number = |value: &Symbolic| match value.approximation() {
        Some(value) => Ok(value.to_f64()),
        None => {
            Err(refused(format!("its structure constants contain {value}, which is not a number")))
        }
    };
    of_algebra(&LieAlgebra::try_from(entry.bracket(number)?)?)
}

/// The number in `name` at the position of `n` in `pattern`. Returns 0 if the pattern has no `n`.
fn argument(pattern: &str, name: &str) -> Option<usize> {
    let (before, behind) = match (pattern.strip_suffix("n)"), pattern.strip_suffix("^n")) {
        (Some(before), _) => (before, ")"),
        (None, Some(_)) => (&pattern[..pattern.len() - 1], ""),
        (None, None) => return (name == pattern).then_some(0),
    };
    name.strip_prefix(before)?.strip_suffix(behind)?.parse().ok()
}
