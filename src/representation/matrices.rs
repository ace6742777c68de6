//! Matrices of irreducible representations, in a basis of monomials of lowering operators.

mod chevalley;
mod construction;
mod forms;

use super::{HighestWeight, ReductiveAlgebra, RepresentationError};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring};

/// The maximum dimension of a representation whose matrices are computed.
pub const MAX_MATRIX_DIMENSION: u32 = 1 << 14;

/// The matrices of an irreducible representation: `e_i` and `f_i` for the simple roots, with exact
/// rational entries. The column `j` contains the image of the basis vector `v_j`: `x v_j = x_ij v_i`.
///
/// The basis consists of monomials `f_i^(a) f_j^(b) ... v` with divided powers `f^(a) = f^a/a!` and
/// a highest weight vector `v`, which comes first. Weights are in the order of their depth, the
/// number of simple roots that are subtracted from the highest weight. Within a weight space, the
/// first linearly independent monomials are chosen, by increasing `i`.
///
/// The relations `[e_i, f_j] = δ_ij h_i`, `[h_i, e_j] = a_ji e_j` and `[h_i, f_j] = -a_ji f_j` are multiplied out before the value is returned. Together
/// with the weights of the basis vectors and the dimension of Weyl's formula they prove that the
/// representation is the irreducible one.
///
/// ```
/// use affinor::representation::{HighestWeight, MatrixRepresentation, ReductiveAlgebra};
/// let su2: ReductiveAlgebra = "SU(2)".parse()?;
/// let triplet = MatrixRepresentation::new(&HighestWeight::new(&su2, [2])?)?;
/// assert_eq!(triplet.raising()[0].to_string(), "[0, 2, 0]\n[0, 0, 1]\n[0, 0, 0]");
/// assert_eq!(triplet.lowering()[0].to_string(), "[0, 0, 0]\n[1, 0, 0]\n[0, 2, 0]");
/// assert_eq!(triplet.basis()[2].to_string(), "f1^(2)");
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixRepresentation {
    weight: HighestWeight,
    basis: Vec<Monomial>,
    raising: Vec<Matrix<Rational>>,
    lowering: Vec<Matrix<Rational>>,
}

/// A basis vector of a representation: a monomial of lowering operators, applied to the highest
/// weight vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monomial {
    weight: Vec<i64>,
    factors: Vec<(usize, u32)>,
    /// The basis vector `w` with `f_i w = a f_i^(a) ...`, where `f_i^(a)` is the first factor.
    parent: usize,
}

impl Monomial {
    /// The weight: Dynkin labels, then charges.
    pub fn weight(&self) -> &[i64] {
        &self.weight
    }

    /// The factors `(i, a)` of the form `f_i^a / a!`, from left to right; simple roots count from 0.
    /// The list is empty for the highest weight vector.
    pub fn factors(&self) -> &[(usize, u32)] {
        &self.factors
    }
}

impl std::fmt::Display for Monomial {
    /// The factors, such as `f1^(2) f2`; `1` for the highest weight vector.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let factor = |&(i, power): &(usize, u32)| match power {
            1 => format!("f{}", i + 1),
            _ => format!("f{}^({power})", i + 1),
        };
        let factors: Vec<String> = self.factors.iter().map(factor).collect();
        f.write_str(if factors.is_empty() { "1" } else { "" })?;
        f.write_str(&factors.join(" "))
    }
}

impl MatrixRepresentation {
    /// Computes the matrices of the representation with a highest weight.
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] if the dimension exceeds [`MAX_MATRIX_DIMENSION`].
    pub fn new(weight: &HighestWeight) -> Result<Self, RepresentationError> {
        let _stage = stage("matrices");
        let dimension = weight.dimension();
        if dimension > MAX_MATRIX_DIMENSION.into() {
            return Err(RepresentationError::TooLarge {
                what: format!("the dimension {dimension} of a representation by matrices"),
                limit: MAX_MATRIX_DIMENSION.to_string(),
            });
        }
        construction::matrices(weight)
    }

    /// The highest weight.
    pub fn highest_weight(&self) -> &HighestWeight {
        &self.weight
    }

    /// The algebra.
    pub fn algebra(&self) -> &ReductiveAlgebra {
        self.weight.algebra()
    }

    /// The dimension of the representation.
    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// The basis vectors.
    pub fn basis(&self) -> &[Monomial] {
        &self.basis
    }

    /// The matrices of `e_i`, the root vectors of the simple roots.
    pub fn raising(&self) -> &[Matrix<Rational>] {
        &self.raising
    }

    /// The matrices of `f_i`, the root vectors of the negatives of the simple roots.
    pub fn lowering(&self) -> &[Matrix<Rational>] {
        &self.lowering
    }

    /// The diagonal matrix of `h_i = [e_i, f_i]` for a simple root, from 0. Beyond the semisimple
    /// rank, it is the charge times the identity, for a basis vector of the centre.
    pub fn diagonal(&self, i: usize) -> Matrix<Rational> {
        let label = |vector: &Monomial| vector.weight.get(i).copied().unwrap_or(0);
        Matrix::diagonal(self.basis.iter().map(|vector| Rational::from(label(vector))))
    }

    /// Whether `[e_i, f_j] = δ_ij h_i`, `[h_i, e_j] = a_ji e_j` and `[h_i, f_j] = -a_ji f_j` for all
    /// `i`, `j`, and whether the charges commute with the matrices.
    ///
    /// The relations of Serre follow. Under the subalgebra sl(2) of the root `i`, the matrix `e_j` is
    /// a lowest weight vector of weight `a_ij`, so `ad(e_i)^(1 - a_ij)` annihilates it.
    fn satisfies_relations(&self) -> bool {
        let algebra = self.algebra();
        let rank = algebra.semisimple_rank();
        // the matrices h_i are diagonal, so the brackets multiply each entry by a difference of weights
        let shifts = |matrix: &Matrix<Rational>, j: usize, sign: i64| {
            let mut root = vec![0; algebra.rank()];
            root[j] = 2 * sign;
            algebra.neighbours(j).iter().for_each(|&(k, entry)| root[k] = sign * entry);
            matrix.entries().all(|(row, column, _)| {
                let [to, from] = [row, column].map(|at| &self.basis[at].weight);
                (0..root.len()).all(|i| to[i] - from[i] == root[i])
            })
        };
        let homogeneous =
            (0..rank).all(|j| shifts(&self.raising[j], j, 1) && shifts(&self.lowering[j], j, -1));
        homogeneous
            && (0..rank).all(|i| {
                (0..rank).all(|j| {
                    let bracket = commutator(&self.raising[i], &self.lowering[j]);
                    let n = self.dimension();
                    bracket == if i == j { self.diagonal(i) } else { Matrix::zero(n, n) }
                })
            })
    }
}

/// The commutator `[A, B] = A B - B A` of square matrices of equal size.
fn commutator(a: &Matrix<Rational>, b: &Matrix<Rational>) -> Matrix<Rational> {
    let minus = a.map(|value| -value.clone());
    let product = |a: &Matrix<Rational>, b| a.mul(b).expect("the matrices have equal sizes");
    product(a, b).add(&product(b, &minus)).expect("the matrices have equal sizes")
}

/// The product of a row and a matrix, times a factor.
fn image(row: &[(usize, Rational)], matrix: &Matrix<Rational>, factor: &Rational) -> Row<Rational> {
    let mut sum = std::collections::BTreeMap::new();
    for (at, value) in row {
        for (column, entry) in matrix.row(*at) {
            let term = value.clone() * entry * factor;
            let place = sum.entry(*column).or_insert_with(|| Rational::from(0));
            *place = std::mem::replace(place, Rational::from(0)) + &term;
        }
    }
    sum.into_iter().filter(|(_, value)| !value.vanishes()).collect()
}
