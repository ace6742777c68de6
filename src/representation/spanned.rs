//! Subalgebras by vectors that span them.

use super::subalgebra::not_a_subalgebra;
use super::{
    HighestWeight, MatrixRepresentation, ReductiveAlgebra, RepresentationError, Subalgebra,
};
use crate::algebra::roots::{RootSystem, Series, basis_names, chevalley_constants};
use crate::algebra::structure::{StructureTheory, Subspace};
use crate::algebra::{Bracket, LieAlgebra};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use affinor_tensors::linear::modular::Prime;
use affinor_tensors::stop::checkpoint;

/// The largest dimension of a representation that decides between numberings of the simple roots.
const LARGEST: u32 = 600;

impl ReductiveAlgebra {
    /// The brackets of the Chevalley bases of the simple factors: `e1 ...`, `f1 ...`, `h1 ...`. If
    /// there are several factors, the names in the second factor are `e1_2` and so on. The basis
    /// is ordered as in [`MatrixRepresentation::chevalley_basis`]. `None` if the algebra has a centre.
    ///
    /// ```
    /// use affinor::representation::ReductiveAlgebra;
    /// let algebra: ReductiveAlgebra = "A1 + A2".parse()?;
    /// let brackets = algebra.chevalley_algebra().expect("the algebra is semisimple");
    /// assert_eq!(brackets.labels()[..4], ["e1_1", "f1_1", "h1_1", "e1_2"]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn chevalley_algebra(&self) -> Option<LieAlgebra<Rational>> {
        let (mut labels, mut constants) = (vec![], vec![]);
        for (at, factor) in self.simple_factors().iter().enumerate() {
            let roots = RootSystem::new(*factor);
            let start = labels.len();
            let moved = |(i, j, k, value): (usize, usize, usize, i64)| {
                (start + i, start + j, start + k, Rational::from(value))
            };
            constants.extend(chevalley_constants(&roots).into_iter().map(moved));
            let single = self.simple_factors().len() == 1;
            let name = |name| if single { name } else { format!("{name}_{}", at + 1) };
            labels.extend(basis_names(&roots).into_iter().map(name));
        }
        let bracket = (self.abelian_dimension() == 0)
            .then(|| LieAlgebra::try_from(Bracket::from_constants(labels, constants).ok()?).ok());
        bracket.flatten()
    }
}

impl Subalgebra {
    /// The subalgebra that vectors span, in coordinates of the Chevalley bases of the simple factors
    /// ([`ReductiveAlgebra::chevalley_algebra`]). The projection of weights is computed; the
    /// subalgebra need not contain elements of the given Cartan subalgebra.
    ///
    /// The charges of the centre are coprime integers.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] with a witness if the span is not a subalgebra or is
    /// not reductive in the algebra. The same error has another reason if the algebra has a centre,
    /// or if no prime splits the Cartan subalgebra.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let g2: ReductiveAlgebra = "G2".parse()?;
    /// // e_a - f_a for all positive roots a: the maximal compact subalgebra so(4)
    /// let vector = |i: usize| vec![(i, Rational::from(1)), (i + 6, Rational::from(-1))];
    /// let compact = Subalgebra::spanned(&g2, (0..6).map(vector))?;
    /// let seven = compact.branch(&HighestWeight::parse(&g2, "7")?)?;
    /// assert_eq!(compact.algebra().to_string(), "A1 + A1");
    /// assert_eq!(seven.to_string(), "(1,3) + (2,2)");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn spanned(
        ambient: &ReductiveAlgebra,
        vectors: impl IntoIterator<Item = Vec<(usize, Rational)>>,
    ) -> Result<Self, RepresentationError> {
        let vectors: Vec<_> = vectors.into_iter().collect();
        let Some(algebra) = ambient.chevalley_algebra() else {
            let reason = "vectors are accepted only for semisimple algebras";
            return Err(not_a_subalgebra(ambient, "the span of the vectors", reason));
        };
        let (tests, omitted) = distinguishing(ambient)?;
        let n = ambient.dimension();
        let fits = |p: Prime, factor: usize, element: &[u64], labels: &[u64]| {
            let mut tests = tests.iter().filter(|test| test.factor == factor);
            tests.all(|test| test.fits(p, element, labels))
        };
        let found = Self::spanned_in(&StructureTheory::new(algebra), ambient, n, vectors, &fits)?;
        if omitted.is_empty() {
            return Ok(found);
        }
        let omitted = omitted.join(", ");
        let description = format!(
            "{}, up to the exchange of the half-spin representations of {omitted}",
            found.description()
        );
        Ok(found.described(description))
    }

    /// The subalgebra that vectors span in a semisimple algebra with any basis. Its type must be the
    /// type of `ambient`. The numbering of the simple roots is determined only up to automorphisms of
    /// the Dynkin diagram. So a representation may be exchanged with its image under an outer
    /// automorphism.
    ///
    /// # Errors
    /// As [`Subalgebra::spanned`].
    pub fn spanned_in_basis(
        ambient: &ReductiveAlgebra,
        algebra: &LieAlgebra<Rational>,
        vectors: impl IntoIterator<Item = Vec<(usize, Rational)>>,
    ) -> Result<Self, RepresentationError> {
        let (n, vectors) = (algebra.dimension(), vectors.into_iter().collect());
        let theory = StructureTheory::new(algebra.clone());
        Self::spanned_in(&theory, ambient, n, vectors, &|_, _, _, _| true)
    }

    fn spanned_in(
        theory: &StructureTheory<Rational>,
        ambient: &ReductiveAlgebra,
        n: usize,
        vectors: Vec<Vec<(usize, Rational)>>,
        fits: crate::algebra::structure::Numbering,
    ) -> Result<Self, RepresentationError> {
        let wrong = |reason: String| not_a_subalgebra(ambient, "the span of the vectors", reason);
        if let Some((at, _)) = vectors.iter().flatten().find(|(at, _)| *at >= n) {
            return Err(wrong(format!("there is no basis vector {at}, only 0 to {}", n - 1)));
        }
        let subspace = Subspace::span(n, vectors);
        let found = theory.embedding(&subspace, ambient.simple_factors(), fits);
        let found = found.map_err(|error| wrong(error.to_string()))?.ok_or_else(|| {
            wrong(
                "no prime was found modulo which its Cartan subalgebra splits; choose a basis in \
                 which a Cartan subalgebra is spanned by short vectors"
                    .into(),
            )
        })?;
        let algebra = ReductiveAlgebra::new(found.types, found.centre);
        let subalgebra = Self::by_projection(ambient, &algebra, found.projection)?;
        let dimension = subspace.dimension();
        Ok(subalgebra.described(format!("span of vectors, of dimension {dimension}")))
    }
}

/// A representation that is not invariant under the automorphisms of the Dynkin diagram.
struct Test {
    factor: usize,
    matrices: Vec<Matrix<Rational>>,
    /// The labels of the factor.
    weights: Vec<Vec<i64>>,
}

/// The smallest representations that determine the numbering of the simple roots. They are
/// fundamental representations at the ends of the diagrams that have automorphisms, and one
/// representation for each of several equal factors. Also the types whose half-spin representations
/// are too large.
fn distinguishing(
    algebra: &ReductiveAlgebra,
) -> Result<(Vec<Test>, Vec<String>), RepresentationError> {
    let factors = algebra.simple_factors();
    let (mut tests, mut omitted) = (vec![], vec![]);
    for (at, factor) in factors.iter().enumerate() {
        let equal = factors.iter().filter(|other| *other == factor).count() > 1;
        let rank = factor.rank();
        let nodes = match (factor.series(), rank) {
            (Series::A, 2..) | (Series::E, 6) => vec![0],
            (Series::D, 4..) => vec![0, rank - 2, rank - 1],
            (Series::D, _) => vec![rank - 1],
            (Series::E | Series::F, _) if equal => vec![rank - 1],
            _ if equal => vec![0],
            _ => vec![],
        };
        for node in nodes {
            checkpoint();
            let mut labels = vec![0; algebra.rank()];
            let positions = algebra.positions(at);
            labels[positions.start + node] = 1;
            let weight = HighestWeight::new(algebra, labels)?;
            if weight.dimension() > LARGEST.into() {
                let name = factor.to_string();
                if !omitted.contains(&name) {
                    omitted.push(name);
                }
                continue;
            }
            let module = MatrixRepresentation::new(&weight)?;
            let labels = module.basis().iter().map(|v| v.weight()[positions.clone()].to_vec());
            let weights = labels.collect();
            tests.push(Test { factor: at, matrices: module.chevalley_basis(), weights });
        }
    }
    Ok((tests, omitted))
}

impl Test {
    /// Whether the eigenvalues of an element are the values of the weights.
    fn fits(&self, p: Prime, element: &[u64], labels: &[u64]) -> bool {
        let n = self.weights.len();
        let mut matrix: Vec<Vec<(usize, u64)>> = vec![vec![]; n];
        for (factor, one) in element.iter().zip(&self.matrices) {
            for (i, j, value) in one.entries().filter(|_| *factor != 0) {
                let Some(value) = p.rational(value) else { return false };
                matrix[i].push((j, p.mul(*factor, value)));
            }
        }
        let values: Vec<u64> = self
            .weights
            .iter()
            .map(|weight| {
                let terms = weight.iter().zip(labels);
                terms.fold(0, |sum, (w, label)| p.reduce(sum + p.integer(*w) * label))
            })
            .collect();
        // the product of `A - value` over the distinct values annihilates a fixed vector
        let mut distinct = values.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let mut vector: Vec<u64> = (0..n as u64).map(|k| p.reduce(k * k * k + 7 * k + 3)).collect();
        for value in distinct {
            checkpoint();
            let minus = p.neg(value);
            vector = (0..n)
                .map(|i| {
                    let row = matrix[i].iter();
                    let start = p.mul(minus, vector[i]);
                    row.fold(start, |sum, (j, entry)| p.reduce(sum + entry * vector[*j]))
                })
                .collect();
        }
        vector.iter().all(|value| *value == 0)
    }
}
