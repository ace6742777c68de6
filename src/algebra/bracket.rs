//! Antisymmetric brackets; the Jacobi identity is not checked.

use crate::algebra::frame::{Frame, expect_numbers, formula};
use crate::algebra::generators::{are_dense_derivations, matrices_of_generators};
use crate::{Error, Law};
use affinor_tensors::text::combination;
use affinor_tensors::{Down, Scalar, Sum, Tensor, TensorError, Tolerance, Up};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

/// An antisymmetric bracket `[e_j, e_k] = c^i_jk e_i` that may violate the Jacobi identity.
/// `LieAlgebra::try_from(bracket)` checks the identity and returns a
/// [`LieAlgebra`](crate::LieAlgebra).
#[derive(Clone, Debug, PartialEq)]
pub struct Bracket<S> {
    frame: Frame<S>,
}

impl<S: Scalar> Bracket<S> {
    /// The bracket with the structure constants `c^i_jk`, slots `[Up, Down, Down]`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Law::Antisymmetry`] with the first
    /// pair that violates it.
    pub fn new(
        labels: impl IntoIterator<Item: AsRef<str>>,
        structure: Tensor<S>,
    ) -> Result<Self, Error> {
        Ok(Bracket { frame: Frame::invariant(labels, structure)? })
    }

    /// The bracket from a closure: `bracket(j, k)` lists `(i, c^i_jk)`. It is called for
    /// `j < k` only; indices count from 0.
    ///
    /// # Errors
    /// The errors of [`from_constants`](Self::from_constants).
    pub fn from_fn(
        labels: impl IntoIterator<Item: AsRef<str>>,
        bracket: impl Fn(usize, usize) -> Vec<(usize, S)>,
    ) -> Result<Self, Error> {
        let labels = owned(labels);
        let n = labels.len();
        let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k)));
        let constants =
            pairs.flat_map(|(j, k)| bracket(j, k).into_iter().map(move |(i, v)| (j, k, i, v)));
        Self::of_constants(labels, constants.collect())
    }

    /// The bracket with `[e_j, e_k] = ... + v e_i` for each `(j, k, i, v)`. Indices count from 0,
    /// and the entries may have any order.
    ///
    /// Each pair may be given in one order, or in both orders with opposite values. Definition
    /// files follow the same rule.
    ///
    /// ```
    /// use affinor::{Bracket, LieAlgebra, Rational};
    /// // [e1, e2] = e2, indices from 0
    /// let bracket = Bracket::from_constants(["e1", "e2"], [(0, 1, 1, Rational::from(1))])?;
    /// let affine = LieAlgebra::try_from(bracket)?;
    /// assert_eq!(affine.to_string(), "[e1, e2] = e2");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Tensor`] for an index out of range; [`Error::NotFinite`]; [`Law::GivenOnce`] for a
    /// component given twice; [`Law::OppositeOrders`] for a pair with nonzero `[x, y] + [y, x]`;
    /// [`Law::Antisymmetry`] for a nonzero `[x, x]`.
    #[doc(alias("structure constants"))]
    pub fn from_constants(
        labels: impl IntoIterator<Item: AsRef<str>>,
        constants: impl IntoIterator<Item = (usize, usize, usize, S)>,
    ) -> Result<Self, Error> {
        Self::of_constants(owned(labels), constants.into_iter().collect())
    }

    /// Builds the bracket from lists. This function is compiled once for each scalar type, and not
    /// for each type of iterator.
    fn of_constants(labels: Vec<String>, constants: Vec<Constant<S>>) -> Result<Self, Error> {
        let given = sorted(&labels, constants)?;
        let pairs: Vec<&[Constant<S>]> = given.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).collect();
        let of = |j: usize, k: usize| {
            let at = pairs.binary_search_by_key(&(j, k), |pair| (pair[0].0, pair[0].1));
            at.ok().map(|at| pairs[at])
        };
        let mut both = Vec::with_capacity(2 * given.len());
        for pair in &pairs {
            let (j, k, ..) = pair[0];
            if j > k
                && let Some(forward) = of(k, j)
            {
                expect_opposite(&labels, forward, pair)?;
                continue;
            }
            for (_, _, i, v) in *pair {
                both.push(([*i, j, k], v.clone()));
                if j != k {
                    both.push(([*i, k, j], -v.clone()));
                }
            }
        }
        let structure = Tensor::from_components(labels.len(), &[Up, Down, Down], both)?;
        Self::new(labels, structure)
    }

    /// The structure constants `c^i_jk`.
    pub fn structure_constants(&self) -> &Tensor<S> {
        self.frame.structure_functions()
    }

    /// The names of the basis vectors.
    pub fn labels(&self) -> &[String] {
        self.frame.labels()
    }

    /// The Jacobi residual, slots `^i_jkl`: `[[e_j,e_k],e_l] + [[e_k,e_l],e_j] + [[e_l,e_j],e_k]`.
    /// The residual of a Lie algebra is zero.
    ///
    /// ```
    /// use affinor::{Bracket, Rational};
    /// let one = Rational::from(1);
    /// // [x, y] = x and [y, z] = z violate the identity
    /// let bracket = Bracket::from_constants(["x", "y", "z"], [(0, 1, 0, one.clone()), (0, 2, 1, one)])?;
    /// assert!(!bracket.jacobi().is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Jacobi identity"))]
    pub fn jacobi(&self) -> Tensor<S> {
        self.frame.jacobi()
    }

    /// Returns the first triple of basis vectors that violates the Jacobi identity, or
    /// [`Error::NotFinite`] if a float overflows during the check.
    ///
    /// For rational constants, the method tests only the triples that begin with a generator. This
    /// is sufficient, because the vectors `x` for which `[x, .]` is a derivation are closed under
    /// the bracket. All triples are computed only if one of these tests fails.
    #[doc(alias("Jacobi identity"))]
    pub fn jacobi_violation(&self) -> Option<Error> {
        if let Some(generators) = matrices_of_generators(self.structure_constants())
            && self.are_derivations(&generators)
        {
            return None;
        }
        let residual = self.jacobi();
        if let Err(overflow) = expect_numbers("the Jacobi residual", &residual) {
            return Some(overflow);
        }
        let at = residual.components().map(|(at, _)| (at[1], at[2], at[3])).min();
        at.map(|(j, k, l)| {
            let parts = (0..self.labels().len()).map(|i| residual.get(&[i, j, k, l]));
            let at = [j, k, l].map(|at| self.labels()[at].clone());
            Law::Jacobi.broken(at, self.frame.write(parts))
        })
    }

    /// Whether `[x_j, .]` is a derivation for all `x_j`. The argument `matrices` contains their
    /// matrices `a^i_jk`.
    fn are_derivations(&self, matrices: &Tensor<S>) -> bool {
        if let Some(are) = are_dense_derivations(self.structure_constants(), matrices) {
            return are;
        }
        let residual = formula(
            "a^m_jk c^i_ml - a^m_jl c^i_mk - a^i_jm c^m_kl -> ^i_j[kl]",
            &[("a", matrices), ("c", self.structure_constants())],
        );
        residual.is_empty()
    }

    /// The same bracket with another tolerance for floats. All values computed from the bracket
    /// inherit this tolerance.
    #[must_use]
    pub fn with_tolerance(self, tolerance: Tolerance) -> Self {
        Bracket { frame: self.frame.with_tolerance(tolerance) }
    }

    pub(super) fn into_frame(self) -> Frame<S> {
        self.frame
    }
}

/// Writes the nonzero brackets `[x, y] = z`, one per line.
impl<S: Scalar> fmt::Display for Bracket<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.frame.write_products(f, self.structure_constants(), "[", "]", |j, k| j < k)
    }
}

/// An entry `(j, k, i, v)` means `[e_j, e_k] = ... + v e_i`.
type Constant<S> = (usize, usize, usize, S);

fn owned(labels: impl IntoIterator<Item: AsRef<str>>) -> Vec<String> {
    labels.into_iter().map(|label| label.as_ref().to_string()).collect()
}

/// Sorts the constants by pair and component, and checks that each constant is finite and occurs
/// once.
fn sorted<S: Scalar>(
    labels: &[String],
    mut given: Vec<Constant<S>>,
) -> Result<Vec<Constant<S>>, Error> {
    let dimension = labels.len();
    for (j, k, i, v) in &given {
        if let Some(&index) = [j, k, i].into_iter().find(|index| **index >= dimension) {
            return Err(TensorError::IndexRange { index, dimension }.into());
        }
        if !v.is_number() {
            let at = [i + 1, j + 1, k + 1].to_vec();
            return Err(Error::NotFinite { what: "the bracket", at, value: v.to_string() });
        }
    }
    given.sort_by_key(|(j, k, i, _)| (*j, *k, *i));
    let twice = given
        .windows(2)
        .find(|two| (two[0].0, two[0].1, two[0].2) == (two[1].0, two[1].1, two[1].2));
    if let Some([(j, k, i, first), (.., second)]) = twice {
        let [x, y, component] = [*j, *k, *i].map(|at| labels[at].clone());
        let at = [x, y, component, first.to_string()];
        return Err(Law::GivenOnce.broken(at, second.to_string()));
    }
    Ok(given)
}

/// Checks that `[e_j, e_k] + [e_k, e_j] = 0`.
fn expect_opposite<S: Scalar>(
    labels: &[String],
    forward: &[Constant<S>],
    backward: &[Constant<S>],
) -> Result<(), Error> {
    let (j, k, ..) = forward[0];
    let mut sums: BTreeMap<usize, S::Sum> = BTreeMap::new();
    for (_, _, i, v) in forward.iter().chain(backward) {
        match sums.entry(*i) {
            Entry::Vacant(free) => drop(free.insert(S::Sum::term(v))),
            Entry::Occupied(mut sum) => sum.get_mut().add_term(v),
        }
    }
    let written = |terms: &[(usize, S)]| {
        let terms = terms.iter().filter(|(_, v)| !v.vanishes());
        combination(terms.map(|(i, v)| (v.clone(), labels[*i].clone())))
    };
    let sums = sums.iter().filter_map(|(i, sum)| Some((*i, sum.finish(Tolerance::default())?)));
    let sums: Vec<(usize, S)> = sums.collect();
    if sums.is_empty() {
        return Ok(());
    }
    let of = |given: &[Constant<S>]| {
        let terms: Vec<_> = given.iter().map(|(_, _, i, v)| (*i, v.clone())).collect();
        written(&terms)
    };
    let at = [labels[j].clone(), labels[k].clone(), of(forward), of(backward)];
    Err(Law::OppositeOrders.broken(at, written(&sums)))
}
