//! Left-invariant distributions: subspaces of a Lie algebra and the brackets of their vectors.

use super::LieAlgebra;
use super::structure::Subspace;
use crate::Error;
use crate::algebra::frame::formula;
use affinor_tensors::linear::Row;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar, Tensor, Up};

/// A left-invariant distribution on a group: at each element, the subspace of the tangent space that
/// some left-invariant fields span. An example is the space of admissible velocities of a system
/// with nonholonomic constraints. Over a field of functions, all statements hold for generic values of
/// the letters.
///
/// ```
/// use affinor::algebra::{Distribution, catalogue};
/// use affinor::Rational;
/// // a knife edge in the plane turns about its point of contact and slides along its direction
/// let se2 = catalogue::algebra::<Rational>("se(2)")?;
/// let [turn, forward] = [0, 1].map(|at| vec![(at, Rational::from(1))]);
/// let knife = Distribution::new(&se2, [turn, forward])?;
/// let witness = knife.noninvolutive_pair().expect("the knife can reach every pose");
/// assert_eq!(witness.bracket, [(2, Rational::from(1))]);
/// assert_eq!(knife.growth_vector(), [2, 3]);
/// assert!(knife.is_bracket_generating());
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Distribution<S> {
    /// The structure constants `c^i_jk`.
    structure: Tensor<S>,
    subspace: Subspace<S>,
}

/// The bracket of two vectors of a basis, with the vector itself.
#[derive(Clone, Debug, PartialEq)]
pub struct BracketWitness<S> {
    /// The two vectors `x` and `y`.
    pub pair: [Row<S>; 2],
    /// The bracket `[x, y]`.
    pub bracket: Row<S>,
}

impl<S: Field + Scalar> Distribution<S> {
    /// The distribution that is spanned by vectors of an algebra, each given by its nonzero
    /// components.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the vectors are linearly dependent, if there are none, or if a
    /// component does not exist.
    pub fn new(
        algebra: &LieAlgebra<S>,
        vectors: impl IntoIterator<Item = Row<S>>,
    ) -> Result<Self, Error> {
        Self::of(algebra.structure_constants(), vectors.into_iter().collect())
    }

    fn of(structure: &Tensor<S>, vectors: Vec<Row<S>>) -> Result<Self, Error> {
        let (n, count) = (structure.dimension(), vectors.len());
        let invalid = |reason: String| Error::Invalid { what: "distribution", reason };
        if vectors.iter().flatten().any(|(at, _)| *at >= n) {
            return Err(invalid(format!("a vector has a component beyond the dimension {n}")));
        }
        let subspace = Subspace::span(n, vectors);
        match subspace.dimension() {
            0 => Err(invalid("there is no nonzero vector".into())),
            found if found < count => {
                let reason = format!("the {count} vectors span only dimension {found}");
                Err(invalid(reason))
            }
            _ => Ok(Distribution { structure: structure.clone(), subspace }),
        }
    }

    /// The subspace, with its basis in reduced row echelon form.
    pub fn subspace(&self) -> &Subspace<S> {
        &self.subspace
    }

    /// The dimension of the subspace.
    pub fn rank(&self) -> usize {
        self.subspace.dimension()
    }

    /// The first pair of basis vectors whose bracket is not in the distribution. `None` means that
    /// the distribution is involutive, which by the theorem of Frobenius means integrable: the
    /// constraints are holonomic.
    pub fn noninvolutive_pair(&self) -> Option<BracketWitness<S>> {
        let basis = self.subspace.basis();
        let pairs = basis
            .iter()
            .enumerate()
            .flat_map(|(at, x)| basis[at + 1..].iter().map(move |y| [x, y]));
        pairs.map(|[x, y]| self.witness(x, y)).find(|w| !self.subspace.contains(&w.bracket))
    }

    /// The structure constants `c^i_jk` of the algebra, slots `[Up, Down, Down]`.
    pub fn structure_constants(&self) -> &Tensor<S> {
        &self.structure
    }

    /// The flag `D^1 = D`, `D^(k+1) = D^k + [D, D^k]`, until its terms no longer grow. The last term
    /// is the subalgebra that the distribution generates.
    pub fn flag(&self) -> Vec<Subspace<S>> {
        let (mut flag, mut witnesses) = (vec![], vec![]);
        self.generate(&mut flag, &mut witnesses);
        flag
    }

    /// The growth vector: the dimensions of the [flag](Self::flag).
    pub fn growth_vector(&self) -> Vec<usize> {
        self.flag().iter().map(Subspace::dimension).collect()
    }

    /// Whether the distribution generates the algebra. By the theorem of Chow and Rashevskii, every
    /// two elements of the connected group are then joined by a curve with velocities in the
    /// distribution. The [flag](Self::flag) is the witness if it does not, and the
    /// [generating brackets](Self::generating_brackets) if it does.
    pub fn is_bracket_generating(&self) -> bool {
        self.generating_brackets().len() + self.rank() == self.subspace.ambient()
    }

    /// Brackets that span, together with the distribution, the last term of the
    /// [flag](Self::flag). The first vector of each pair is in the distribution, and the second is in
    /// the distribution or an earlier bracket.
    pub fn generating_brackets(&self) -> Vec<BracketWitness<S>> {
        let (mut flag, mut witnesses) = (vec![], vec![]);
        self.generate(&mut flag, &mut witnesses);
        witnesses
    }

    fn generate(&self, flag: &mut Vec<Subspace<S>>, witnesses: &mut Vec<BracketWitness<S>>) {
        let mut all = self.subspace.clone();
        // brackets with vectors of earlier terms are known to be in the present term
        let mut newest: Vec<Row<S>> = self.subspace.basis().to_vec();
        while !newest.is_empty() {
            flag.push(all.clone());
            let mut found = vec![];
            for x in self.subspace.basis() {
                for y in &newest {
                    checkpoint();
                    let witness = self.witness(x, y);
                    if all.add(witness.bracket.clone()) {
                        found.push(witness.bracket.clone());
                        witnesses.push(witness);
                    }
                }
            }
            newest = found;
        }
    }

    fn witness(&self, x: &Row<S>, y: &Row<S>) -> BracketWitness<S> {
        let n = self.subspace.ambient();
        let [a, b] = [x, y].map(|row| vector(n, row));
        let operands = [("c", &self.structure), ("x", &a), ("y", &b)];
        let bracket = formula("c^i_jk x^j y^k -> ^i", &operands);
        let bracket = bracket.components().map(|(at, value)| (at[0], value.clone())).collect();
        BracketWitness { pair: [x.clone(), y.clone()], bracket }
    }
}

/// The vector with these nonzero components.
fn vector<S: Scalar>(n: usize, row: &Row<S>) -> Tensor<S> {
    let components = row.iter().map(|(at, value)| ([*at], value.clone()));
    Tensor::from_components(n, &[Up], components).expect("components within the dimension")
}
