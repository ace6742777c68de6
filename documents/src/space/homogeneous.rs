//! Homogeneous spaces G/H in definitions, by name or by the vectors of a subalgebra.

mod sum;

use super::catalogue_name::with_nearest;
use super::{Definition, Origin};
use crate::Coefficient;
use crate::input::forms::{HomogeneousText, Text};
use crate::input::{InputError, Place, Source};
use crate::space::notation::Names;
use affinor::algebra::structure::GroundField;
use affinor::geometry::homogeneous::{Embedding, HomogeneousSpace, has_form};
use affinor::group::{AnyGroup, LieGroup, registry};
use affinor::{Bracket, Error, Law, LieAlgebra, ReductivePair};
use affinor_tensors::linear::Matrix;
use affinor_tensors::text::combination;
use affinor_tensors::{Rational, Symbolic, Tolerance};
use nalgebra::{DMatrix, DVector};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

/// A homogeneous space: the algebra of G in a basis that begins with a complement of the isotropy
/// algebra.
#[derive(Clone, Debug)]
pub(super) struct CosetSpace {
    /// The name of the algebra of G.
    pub algebra: String,
    /// The names of the basis vectors in which the adapted basis is written.
    given: Vec<String>,
    /// The adapted basis, as components in the given basis: the complement, then the isotropy
    /// algebra.
    vectors: Vec<Vec<(usize, Symbolic)>>,
    /// The structure constants `[e_j, e_k] = c^i_jk e_i` in the adapted basis, with `j < k`.
    constants: Vec<([usize; 3], Symbolic)>,
    /// The dimension of the space.
    pub dimension: usize,
    /// A sentence about the embedding; `None` for a subalgebra that is given by its vectors.
    sentence: Option<String>,
}

impl<D> HomogeneousText<D> {
    /// Reads the vectors in the algebra of G, which has this name.
    pub(super) fn read(
        &self,
        name: &str,
        algebra: &LieAlgebra<Symbolic>,
        parameters: &BTreeSet<String>,
        source: &Source,
    ) -> Result<CosetSpace, InputError> {
        let labels: BTreeMap<String, usize> = algebra.labels().iter().cloned().zip(0..).collect();
        let parameters = (!source.declares_names()).then_some(parameters);
        let names = Names { parameters, ..Names::open(&labels, None) };
        let vector = |text: &Text| {
            let excerpt = source.excerpt(text);
            let mut vector = vec![Symbolic::zero(); algebra.dimension()];
            for (at, value) in names.vector(excerpt.content(), &excerpt)? {
                vector[at] = value;
            }
            Ok(vector)
        };
        let vectors =
            |texts: &Vec<Text>| texts.iter().map(vector).collect::<Result<Vec<_>, InputError>>();
        let h = vectors(&self.by)?;
        let m = self.complement.as_ref().map(vectors).transpose()?;
        let by = source.key("homogeneous.by");
        let n = algebra.dimension();
        if rank(&h)? < h.len() {
            return Err(InputError::usage("the vectors of `by` are linearly dependent").at(&by));
        }
        if h.len() == n {
            let message = "the subalgebra is the whole algebra, so that the space is a point";
            return Err(InputError::usage(message).at(&by));
        }
        if let Some(m) = &m {
            let place = source.key("homogeneous.complement");
            if m.len() + h.len() != n {
                let (found, wanted) = (m.len(), n - h.len());
                let message =
                    format!("the complement has {found} vectors, but its dimension is {wanted}");
                return Err(InputError::usage(message).at(&place));
            }
            if rank(&[&m[..], &h[..]].concat())? < n {
                let message = "the vectors of `by` and `complement` are linearly dependent";
                return Err(InputError::usage(message).at(&place));
            }
        }
        let read = match rational(algebra, &h, &m) {
            Some((algebra, h, m)) => CosetSpace::new(name, &algebra, &h, m),
            None => CosetSpace::new(name, algebra, &h, m),
        };
        read.map_err(|error| {
            let of_complement =
                matches!(error, Error::Broken { law: Law::ReductiveComplement, .. });
            let key = if of_complement && self.complement.is_some() { "complement" } else { "by" };
            InputError::from(error).at(&source.key(&format!("homogeneous.{key}")))
        })
    }
}

fn rank(vectors: &[Vec<Symbolic>]) -> Result<usize, Error> {
    match vectors {
        [] => Ok(0),
        vectors => Ok(Matrix::from_dense(vectors)?.rank()?),
    }
}

type OverTheRationals = (LieAlgebra<Rational>, Vec<Vec<Rational>>, Option<Vec<Vec<Rational>>>);

/// The algebra and the vectors over the rational numbers, if all values are rational.
fn rational(
    algebra: &LieAlgebra<Symbolic>,
    h: &[Vec<Symbolic>],
    m: &Option<Vec<Vec<Symbolic>>>,
) -> Option<OverTheRationals> {
    let value = |value: &Symbolic| value.as_constant().cloned();
    let vectors = |vectors: &[Vec<Symbolic>]| {
        vectors.iter().map(|x| x.iter().map(value).collect()).collect::<Option<Vec<_>>>()
    };
    let m = match m {
        Some(m) => Some(vectors(m)?),
        None => None,
    };
    let constants = algebra.structure_constants();
    constants.components().all(|(_, constant)| value(constant).is_some()).then_some(())?;
    let algebra = algebra.map(|constant| value(constant).unwrap_or_default()).ok()?;
    Some((algebra, vectors(h)?, m))
}

impl CosetSpace {
    /// The space of an algebra with this name, a basis `h` of the isotropy algebra, and a basis of
    /// the complement. Without the latter, a complement is chosen.
    pub fn new<E: GroundField>(
        name: &str,
        algebra: &LieAlgebra<E>,
        h: &[Vec<E>],
        complement: Option<Vec<Vec<E>>>,
    ) -> Result<Self, Error> {
        let m = match complement {
            Some(vectors) => vectors,
            None => ReductivePair::complement(algebra, h)?,
        };
        let pair = ReductivePair::new(algebra, h, &m)?;
        let constants = pair.algebra().structure_constants().components();
        let constants = constants.filter(|(at, _)| at[1] < at[2]);
        let nonzero = |x: &Vec<E>| {
            let entries = x.iter().enumerate().filter(|(_, value)| !value.vanishes());
            entries.map(|(at, value)| (at, value.symbolic())).collect()
        };
        Ok(CosetSpace {
            algebra: name.into(),
            given: algebra.labels().to_vec(),
            vectors: m.iter().chain(h).map(nonzero).collect(),
            constants: constants
                .map(|(at, value)| ([at[0], at[1], at[2]], value.symbolic()))
                .collect(),
            dimension: m.len(),
            sentence: None,
        })
    }

    /// The names `m1, m2, ...` of the basis vectors of the complement.
    pub fn labels(&self) -> Vec<String> {
        (1..=self.dimension).map(|at| format!("m{at}")).collect()
    }

    /// The space over a scalar type; `labels` are the names of the basis vectors of the complement.
    pub fn space<S: Coefficient>(
        &self,
        name: &str,
        labels: &[String],
        tolerance: Tolerance,
    ) -> Result<HomogeneousSpace<S>, InputError> {
        let pair = ReductivePair::adapted(self.adapted(labels, tolerance)?, self.dimension)?;
        let complement = self.vectors[..self.dimension].iter().map(|x| self.written(x)).collect();
        Ok(HomogeneousSpace::of_pair(name, self.embedding(), complement, pair))
    }

    /// A sentence that states how the isotropy algebra lies in the algebra of G.
    fn embedding(&self) -> String {
        if let Some(sentence) = &self.sentence {
            return sentence.clone();
        }
        let vectors = self.vectors[self.dimension..].iter().map(|x| self.written(x));
        match vectors.collect::<Vec<_>>() {
            none if none.is_empty() => format!("h = 0 in {}", self.algebra),
            vectors => format!("h is the span of {} in {}", vectors.join(", "), self.algebra),
        }
    }

    /// The adapted basis in floats, as columns of components in the given basis.
    fn basis(&self) -> Result<DMatrix<f64>, InputError> {
        let n = self.vectors.len();
        let mut basis = DMatrix::zeros(n, n);
        for (column, vector) in self.vectors.iter().enumerate() {
            for (row, value) in vector {
                basis[(*row, column)] = f64::read(value)?;
            }
        }
        Ok(basis)
    }

    /// The algebra of G in the adapted basis.
    fn adapted<S: Coefficient>(
        &self,
        labels: &[String],
        tolerance: Tolerance,
    ) -> Result<LieAlgebra<S>, InputError> {
        let isotropy = self.vectors.len() - self.dimension;
        let isotropy: Vec<_> = (1..=isotropy).map(|at| format!("h{at}")).collect();
        let all = affinor::algebra::join_labels(labels, &isotropy);
        let constants =
            self.constants.iter().map(|([i, j, k], value)| Ok((*j, *k, *i, S::read(value)?)));
        let constants = constants.collect::<Result<Vec<_>, InputError>>()?;
        let bracket = Bracket::from_constants(&all, constants)?.with_tolerance(tolerance);
        Ok(LieAlgebra::try_from(bracket)?)
    }

    /// A group G and the adapted basis in the basis of the group, as columns. The group comes from
    /// the registry if the name of the algebra is there, with the same brackets. Otherwise, it is
    /// the group of the brackets in the adapted basis.
    fn group(
        &self,
        labels: &[String],
        tolerance: Tolerance,
    ) -> Result<(AnyGroup, DMatrix<f64>), InputError> {
        let (algebra, basis) = (self.adapted::<f64>(labels, tolerance)?, self.basis()?);
        let named = registry::find(&self.algebra).ok();
        if let Some(group) = named.filter(|group| has_brackets(group, &basis, &algebra)) {
            return Ok((group, basis));
        }
        let group = registry::of_algebra(&algebra)?;
        Ok((group, DMatrix::identity(basis.nrows(), basis.nrows())))
    }

    fn written(&self, vector: &[(usize, Symbolic)]) -> String {
        combination(vector.iter().map(|(at, value)| (value, self.given[*at].clone())))
    }

    /// Whether all values are rational numbers.
    pub fn is_rational(&self) -> bool {
        let vectors = self.vectors.iter().flatten().map(|(_, value)| value);
        let mut values = self.constants.iter().map(|(_, value)| value).chain(vectors);
        values.all(|value| value.as_constant().is_some())
    }

    /// All values.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut Symbolic> {
        let vectors = self.vectors.iter_mut().flatten().map(|(_, value)| value);
        self.constants.iter_mut().map(|(_, value)| value).chain(vectors)
    }
}

/// Whether the vectors in the columns of `basis` have the brackets of an algebra in a group.
fn has_brackets(group: &AnyGroup, basis: &DMatrix<f64>, algebra: &LieAlgebra<f64>) -> bool {
    let n = algebra.dimension();
    let constants = algebra.structure_constants();
    let bracket = |j: usize, k: usize| {
        let expected = DVector::from_fn(n, |i, _| constants.get(&[i, j, k]));
        let found = group.bracket(&basis.column(j).into(), &basis.column(k).into());
        (found - basis * &expected).amax() <= 1e-12 * (1.0 + expected.amax())
    };
    group.dimension() == n && (0..n).all(|j| (0..j).all(|k| bracket(j, k)))
}

impl Definition {
    /// The group G of a homogeneous space G/H and an adapted basis of its algebra, which begins with
    /// the basis of the space. The columns of the matrix are components in the basis of the group.
    /// Returns `None` for other definitions.
    ///
    /// # Errors
    /// An error if a value is not a number, and if the algebra has no group of matrices.
    pub fn transitive_group(
        &self,
        tolerance: Tolerance,
    ) -> Result<Option<(AnyGroup, DMatrix<f64>)>, InputError> {
        let group = self.coset_space().map(|coset| coset.group(&self.labels, tolerance));
        group.transpose()
    }

    /// The homogeneous space, if the definition is one.
    pub(super) fn coset_space(&self) -> Option<&CosetSpace> {
        match &self.origin {
            Origin::Homogeneous(coset) => Some(coset),
            _ => None,
        }
    }

    /// Whether the definition is a homogeneous space.
    pub fn is_homogeneous(&self) -> bool {
        self.coset_space().is_some()
    }

    /// The name of the algebra of G, if the definition is a homogeneous space G/H.
    pub fn algebra_of_group(&self) -> Option<&str> {
        self.coset_space().map(|coset| coset.algebra.as_str())
    }

    /// The homogeneous space over a scalar type; `None` for other definitions.
    ///
    /// # Errors
    /// An error if a value does not exist in the scalar type.
    pub fn homogeneous<S: Coefficient>(
        &self,
        tolerance: Tolerance,
    ) -> Result<Option<HomogeneousSpace<S>>, InputError> {
        let space = self.coset_space().map(|coset| {
            let space = coset.space(&self.name, &self.labels, tolerance);
            space.map_err(|error| error.or_at(self.source.clone().map(Place::within).as_ref()))
        });
        space.transpose()
    }
}

/// The homogeneous space that a text names, if the text has the form of such a name, or of a sum
/// in which such a name occurs.
pub(super) fn named(source: &Source) -> Option<Result<Definition, InputError>> {
    let text = source.content().trim();
    let parts = registry::summands(text);
    if parts.len() > 1 && parts.iter().any(|part| has_form(part.trim())) {
        return Some(sum::of(&parts, source));
    }
    has_form(text).then(|| {
        let Embedding { name, algebra, algebra_name, vectors, sentence } = embedding(text, source)?;
        let coset = CosetSpace::new::<Rational>(&algebra_name, &algebra, &vectors, None);
        let coset = coset.map_err(|error| InputError::from(error).at(&source.whole(text)))?;
        let coset = CosetSpace { sentence: Some(sentence), ..coset };
        Ok(coset.read_as(name, text))
    })
}

/// The embedding that the name `text` means, which is a piece of `source`.
fn embedding(text: &str, source: &Source) -> Result<Embedding, InputError> {
    Embedding::find(text).map_err(|error| {
        let help = "`affinor list` shows the families; a file accepts every subalgebra, \
                    homogeneous = { of = \"su(3)\", by = [\"e1\"] }";
        let error = match error {
            Error::Name(message) => InputError::usage(message).help(help),
            error => InputError::from(error),
        };
        with_nearest(error.at(&source.whole(text)), text)
    })
}

impl CosetSpace {
    /// The definition of the space with this name, which was read from a text.
    fn read_as(self, name: String, text: &str) -> Definition {
        let labels = self.labels();
        let mut definition = Definition::new(name, labels, Origin::Homogeneous(Box::new(self)));
        if text.replace(' ', "") != definition.name.replace(' ', "") {
            definition.notes.push(format!("{text} is read as {}", definition.name));
        }
        definition
    }
}
