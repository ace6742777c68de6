//! The isotropy representation of a homogeneous space: its isotypic components.

use super::ReductivePair;
use crate::Error;
use crate::algebra::irreducible_factors;
use crate::algebra::matrix_polynomials::{evaluate, minimal_polynomial};
use crate::algebra::structure::Subspace;
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::{Down, Rational, Tensor, Up};
use num_rational::BigRational;
use num_traits::Signed;
use polycore::Uni;

/// The scalars of the endomorphisms of an irreducible real representation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RealType {
    /// Multiples of the identity only.
    Real,
    /// The complex numbers.
    Complex,
    /// The quaternions.
    Quaternionic,
}

/// A sum of equivalent irreducible summands of the isotropy representation, or several such sums
/// that are conjugate over the rationals.
#[derive(Clone, Debug)]
pub struct IsotropyComponent {
    /// The subspace of `m`, in the basis of `m`.
    pub subspace: Subspace<Rational>,
    /// The number of equivalent summands over the reals, and their type. `None` if the component is
    /// irreducible over the rationals, but not over the reals. Also `None` if the representation has
    /// no invariant scalar product.
    pub summands: Option<(usize, RealType)>,
}

impl IsotropyComponent {
    /// The dimension of the invariant symmetric forms on the component; `None` if the summands are
    /// not known.
    ///
    /// `k` summands have `k(k+1)/2` (real), `k^2` (complex) or `k(2k-1)` (quaternionic type).
    pub fn metrics(&self) -> Option<usize> {
        let (k, of) = self.summands?;
        Some(match of {
            RealType::Real => k * (k + 1) / 2,
            RealType::Complex => k * k,
            RealType::Quaternionic => k * (2 * k - 1),
        })
    }
}

impl ReductivePair<Rational> {
    /// The isotypic components of the isotropy representation of `h` on `m`. Their sum is `m` if `h`
    /// is compact or semisimple.
    ///
    /// They are the kernels of the irreducible factors of the minimal polynomial of a general
    /// element in the centre of the commutant, the endomorphisms of `m` that commute with `h`. The
    /// components are in the order of their dimensions, and then of their first basis vectors.
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// // the Stiefel manifold V_2(R^5): a line, and two equivalent summands of dimension 3
    /// let space = HomogeneousSpace::find("V(2,R^5)")?;
    /// let components = space.pair().isotropy_components()?;
    /// let metrics: usize = components.iter().filter_map(|component| component.metrics()).sum();
    /// assert_eq!((components.len(), metrics), (2, 4));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] if the endomorphisms of `m` have too many components.
    #[doc(alias("isotropy summands", "isotropy representation"))]
    pub fn isotropy_components(&self) -> Result<Vec<IsotropyComponent>, Error> {
        let n = self.dimension();
        let commutant = self.invariant_tensors(&[Up, Down])?;
        let commutant = commutant.iter().map(|map| matrix(n, map));
        let commutant = commutant.collect::<Result<Vec<_>, Error>>()?;
        let general = general_element(n, &centre(&commutant)?)?;
        let polynomial = minimal_polynomial(&general).ok_or(Error::SingularBasis)?;
        let forms = self.invariant_tensors(&[Down, Down])?;
        let mut components = vec![];
        for (factor, _) in irreducible_factors(&polynomial) {
            let kernel = evaluate(&general, &factor).nullspace()?;
            let rows = (0..kernel.rows()).map(|at| kernel.row(at).to_vec());
            let subspace = Subspace::span(n, rows);
            let summands = match is_single(&factor) {
                true => summands(&kernel, &commutant, &forms)?,
                false => None,
            };
            components.push(IsotropyComponent { subspace, summands });
        }
        components.sort_by_key(|component| {
            let subspace = &component.subspace;
            let first = subspace.basis().first().and_then(|row| row.first()).map(|(at, _)| *at);
            (subspace.dimension(), first)
        });
        Ok(components)
    }
}

/// Whether an irreducible factor belongs to one isotypic component over the reals: it has one real
/// root, or one pair of complex roots.
fn is_single(factor: &Uni<BigRational>) -> bool {
    match factor.0.as_slice() {
        [_, _] => true,
        [c, b, a] => (b * b - a * c * BigRational::from_integer(4.into())).is_negative(),
        _ => false,
    }
}

/// The matrix of an endomorphism, slots `^i_j`.
fn matrix(n: usize, map: &Tensor<Rational>) -> Result<Matrix<Rational>, Error> {
    let mut rows = vec![vec![]; n];
    for (at, value) in map.components() {
        rows[at[0]].push((at[1], value.clone()));
    }
    Ok(Matrix::from_rows(n, rows)?)
}

/// A combination of matrices.
fn combined(n: usize, x: &[Rational], of: &[Matrix<Rational>]) -> Result<Matrix<Rational>, Error> {
    x.iter().zip(of).try_fold(Matrix::zero(n, n), |sum, (x, matrix)| {
        Ok(sum.add(&matrix.map(|value| value.clone() * x))?)
    })
}

/// A basis of the centre of an algebra of matrices, given by a basis.
fn centre(algebra: &[Matrix<Rational>]) -> Result<Vec<Matrix<Rational>>, Error> {
    let n = algebra.first().map_or(0, Matrix::rows);
    let count = algebra.len();
    // sum of x_a [A_a, A_b] = 0 for each b
    let mut conditions: Vec<Vec<(usize, Rational)>> = vec![vec![]; count * n * n];
    for (a, left) in algebra.iter().enumerate() {
        for (b, right) in algebra.iter().enumerate() {
            let reverse = right.mul(left)?.map(|value| -value.clone());
            for (i, j, value) in left.mul(right)?.add(&reverse)?.entries() {
                conditions[(b * n + i) * n + j].push((a, value.clone()));
            }
        }
    }
    let solutions = Matrix::from_rows(count, conditions)?.nullspace()?;
    solutions.to_dense().iter().map(|x| combined(n, x, algebra)).collect()
}

/// The largest number of combinations that are tried.
const TRIALS: i64 = 64;

/// An element that generates a commutative algebra: the degree of its minimal polynomial is the
/// dimension of the algebra. If none is found, the last element that was tried.
fn general_element(n: usize, algebra: &[Matrix<Rational>]) -> Result<Matrix<Rational>, Error> {
    let mut element = Matrix::identity(n);
    for t in 1..=TRIALS {
        let powers = std::iter::successors(Some(Rational::from(1)), |power| {
            Some(power.clone() * &Rational::from(t))
        });
        let powers: Vec<_> = powers.take(algebra.len()).collect();
        element = combined(n, &powers, algebra)?;
        if minimal_polynomial(&element).is_some_and(|found| found.deg() == algebra.len()) {
            break;
        }
    }
    Ok(element)
}

/// The number and the type of the equivalent summands of a component, whose basis are the rows of
/// `kernel`. For `k` summands the endomorphisms have dimension `k^2`, `2k^2` or `4k^2`, and so have
/// the invariant forms. The dimension of the symmetric forms is `k(k+1)/2`, `k^2` or `k(2k-1)`.
fn summands(
    kernel: &Matrix<Rational>,
    commutant: &[Matrix<Rational>],
    forms: &[Tensor<Rational>],
) -> Result<Option<(usize, RealType)>, Error> {
    let n = kernel.columns();
    let columns = kernel.transpose();
    let flat = |matrix: &Matrix<Rational>| -> Vec<(usize, Rational)> {
        let columns = matrix.columns();
        matrix.entries().map(|(i, j, value)| (i * columns + j, value.clone())).collect()
    };
    let mut endomorphisms = Echelon::new();
    for map in commutant {
        endomorphisms.insert(flat(&map.mul(&columns)?))?;
    }
    let (mut symmetric, mut antisymmetric) = (Echelon::new(), Echelon::new());
    for form in forms {
        let restricted = kernel.mul(&matrix(n, form)?)?.mul(&columns)?;
        let reverse = restricted.transpose();
        symmetric.insert(flat(&restricted.add(&reverse)?))?;
        antisymmetric.insert(flat(&restricted.add(&reverse.map(|value| -value.clone()))?))?;
    }
    let (all, even, odd) = (endomorphisms.rank(), symmetric.rank(), antisymmetric.rank());
    let found = match (even.cmp(&odd), even.abs_diff(odd)) {
        (std::cmp::Ordering::Greater, k) if all == k * k => Some((k, RealType::Real)),
        (std::cmp::Ordering::Equal, _) => {
            let k = (1..=n).find(|k| 2 * k * k == all);
            k.filter(|k| k * k == even).map(|k| (k, RealType::Complex))
        }
        (std::cmp::Ordering::Less, d) if d % 2 == 0 && all == d * d => {
            Some((d / 2, RealType::Quaternionic))
        }
        _ => None,
    };
    Ok(found.filter(|_| even + odd == all))
}
