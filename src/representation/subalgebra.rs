//! Subalgebras by projections of weights, and branching rules.

use super::decomposition::Sum;
use super::{Decomposition, HighestWeight, ReductiveAlgebra, RepresentationError};
use affinor_tensors::stop::stage;
use std::fmt;

/// A reductive subalgebra, given by the restriction of weights: a matrix that maps the labels of a
/// weight of the algebra to the labels of its restriction.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
/// let su5: ReductiveAlgebra = "SU(5)".parse()?;
/// let standard_model = Subalgebra::levi(&su5, &[3])?;
/// assert_eq!(standard_model.algebra().to_string(), "A2 + A1 + T1");
/// let ten = standard_model.branch(&HighestWeight::parse(&su5, "10")?)?;
/// assert_eq!(ten.to_string(), "(1,1)(-6) + (3bar,1)(4) + (3,2)(-1)");
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Subalgebra {
    ambient: ReductiveAlgebra,
    algebra: ReductiveAlgebra,
    /// One row for each label of the subalgebra.
    projection: Vec<Vec<i64>>,
    description: String,
}

impl Subalgebra {
    /// The subalgebra with this projection of weights, one row for each label and charge of the
    /// subalgebra.
    ///
    /// The projection must pass a necessary condition: the adjoint representation of the algebra
    /// decomposes with multiplicities that are not negative, and contains the adjoint
    /// representation of the subalgebra.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if the matrix has the wrong size or fails the
    /// condition.
    ///
    /// ```
    /// use affinor::representation::{ReductiveAlgebra, Subalgebra};
    /// let (su3, so3): (ReductiveAlgebra, ReductiveAlgebra) = ("SU(3)".parse()?, "SO(3)".parse()?);
    /// assert!(Subalgebra::by_projection(&su3, &so3, vec![vec![2, 2]]).is_ok());
    /// assert!(Subalgebra::by_projection(&su3, &so3, vec![vec![2, 1]]).is_err());
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn by_projection(
        ambient: &ReductiveAlgebra,
        algebra: &ReductiveAlgebra,
        projection: Vec<Vec<i64>>,
    ) -> Result<Self, RepresentationError> {
        let (rows, columns) = (algebra.rank(), ambient.rank());
        let sizes = projection.len() == rows && projection.iter().all(|row| row.len() == columns);
        let small = projection.iter().flatten().all(|entry| entry.unsigned_abs() <= 1 << 16);
        if !sizes || !small {
            let reason = if sizes {
                "an entry of the projection exceeds 65536".into()
            } else {
                format!("the projection must have {rows} rows with {columns} entries")
            };
            return Err(not_a_subalgebra(ambient, algebra, reason));
        }
        let subalgebra = Subalgebra {
            ambient: ambient.clone(),
            algebra: algebra.clone(),
            projection,
            description: "projection".into(),
        };
        let wrong = |reason: String| not_a_subalgebra(ambient, algebra, reason);
        let restricted = subalgebra
            .branch_sum(&adjoint(ambient))
            .and_then(Decomposition::effective)
            .map_err(|error| wrong(format!("for the adjoint representation, {error}")))?;
        let missing = adjoint(algebra).components().any(|(w, m)| restricted.multiplicity(w) < m);
        if missing {
            let reason = "the adjoint representation of the algebra does not contain that of the \
                 subalgebra";
            return Err(wrong(reason.into()));
        }
        Ok(subalgebra)
    }

    /// The algebra that contains the subalgebra.
    pub fn ambient(&self) -> &ReductiveAlgebra {
        &self.ambient
    }

    /// The subalgebra.
    pub fn algebra(&self) -> &ReductiveAlgebra {
        &self.algebra
    }

    /// The projection of weights, one row for each label and charge of the subalgebra.
    pub fn projection(&self) -> &[Vec<i64>] {
        &self.projection
    }

    /// The way in which the subalgebra was found, such as `Levi subalgebra without node 3`.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The same subalgebra with another description.
    pub(super) fn described(self, description: impl Into<String>) -> Self {
        Subalgebra { description: description.into(), ..self }
    }

    /// The restriction of an irreducible representation to the subalgebra.
    ///
    /// # Errors
    /// - [`RepresentationError::DifferentAlgebras`] if the representation belongs to another algebra;
    /// - [`RepresentationError::TooLarge`] if a character or the result exceeds the limits;
    /// - [`RepresentationError::NotACharacter`] if a multiplicity would be negative, because the
    ///   projection does not belong to a subalgebra.
    pub fn branch(&self, weight: &HighestWeight) -> Result<Decomposition, RepresentationError> {
        self.restrict(&Decomposition::irreducible(weight))
    }

    /// The restriction of a representation to the subalgebra.
    ///
    /// # Errors
    /// As [`Subalgebra::branch`].
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let g2: ReductiveAlgebra = "G2".parse()?;
    /// let principal = Subalgebra::principal_sl2(&g2)?;
    /// let seven = HighestWeight::parse(&g2, "7")?;
    /// let square = principal.restrict(&seven.tensor(&seven)?)?;
    /// assert_eq!(square.to_string(), "1 + 3 + 5 + 7 + 9 + 11 + 13");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn restrict(
        &self,
        representation: &Decomposition,
    ) -> Result<Decomposition, RepresentationError> {
        if *representation.algebra() != self.ambient {
            return Err(RepresentationError::DifferentAlgebras {
                left: representation.algebra().to_string(),
                right: self.ambient.to_string(),
            });
        }
        self.branch_sum(representation)?.effective()
    }

    /// The restriction, by the formula of Brauer and Klimyk for the trivial representation: each
    /// weight `ν` with projection `Pν` contributes to the representation `w(Pν + ρ) - ρ`.
    fn branch_sum(
        &self,
        representation: &Decomposition,
    ) -> Result<Decomposition, RepresentationError> {
        let mut sum = Sum::new(&self.algebra);
        let origin = HighestWeight::trivial(&self.algebra);
        for (weight, multiplicity) in representation.components() {
            let character = weight.character()?;
            let _stage = stage("branching");
            sum.add_product(&origin, multiplicity, &character, Some(&self.projection))?;
        }
        sum.finish()
    }

    /// The embedding indices (Dynkin), one row for each simple factor of the subalgebra, one entry
    /// for each simple factor of the algebra. An index is the ratio of the invariant forms in which
    /// long roots have equal lengths. The Dynkin index of a restriction is the sum of the products
    /// of these numbers with the indices of the representation.
    ///
    /// ```
    /// use affinor::representation::{ReductiveAlgebra, Subalgebra};
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// assert_eq!(Subalgebra::principal_sl2(&e8)?.embedding_index(), [[1240]]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn embedding_index(&self) -> Vec<Vec<i64>> {
        let (ambient, algebra) = (&self.ambient, &self.algebra);
        let half_lengths = ambient.half_lengths();
        let factors = 0..algebra.simple_factors().len();
        let coroots = factors.filter_map(|factor| algebra.roots_of(factor).last());
        coroots
            .map(|highest| {
                // the coroot of the highest root over the simple coroots of the algebra
                let x: Vec<i64> = (0..ambient.semisimple_rank())
                    .map(|k| {
                        let rows = highest.coroot.iter().zip(&self.projection);
                        rows.map(|(c, row)| c * row[k]).sum()
                    })
                    .collect();
                let norm = |factor: usize| {
                    let long = ambient.roots_of(factor).map(|root| root.half_length).max();
                    let squares = ambient.positions(factor).map(|i| {
                        let joined = ambient.neighbours(i).iter().map(|&(j, a)| a * x[j]);
                        let image = 2 * x[i] + joined.sum::<i64>();
                        x[i] * image * long.unwrap_or(1) / half_lengths[i]
                    });
                    squares.sum::<i64>() / 2
                };
                (0..ambient.simple_factors().len()).map(norm).collect()
            })
            .collect()
    }
}

impl fmt::Display for Subalgebra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in {}", self.algebra, self.ambient)
    }
}

pub(super) fn not_a_subalgebra(
    ambient: &ReductiveAlgebra,
    algebra: impl ToString,
    reason: impl Into<String>,
) -> RepresentationError {
    RepresentationError::NotASubalgebra {
        subalgebra: algebra.to_string(),
        algebra: ambient.to_string(),
        reason: reason.into(),
    }
}

/// The adjoint representation, with the centre as trivial components.
fn adjoint(algebra: &ReductiveAlgebra) -> Decomposition {
    let centre = algebra.abelian_dimension() as i128;
    let factors = HighestWeight::adjoint(algebra).into_iter().map(|weight| (weight, 1));
    let mut components: Vec<_> = factors.collect();
    if centre > 0 {
        components.push((HighestWeight::trivial(algebra), centre));
    }
    components.sort_by(|a, b| b.0.labels().cmp(a.0.labels()));
    Decomposition::of(algebra, components)
}
