//! Products of homogeneous spaces and groups, such as `S^2+so(3)`.

use super::{CosetSpace, embedding};
use crate::input::{InputError, Source};
use crate::space::catalogue_name::entry;
use crate::space::{Definition, check_dimension};
use affinor::algebra::join_labels;
use affinor::geometry::homogeneous::{Embedding, has_form};
use affinor::{Bracket, Error, LieAlgebra, ReductivePair};
use affinor_tensors::{Rational, Tolerance};
use num_traits::{One, Zero};

/// A factor of the product: a homogeneous space, or a group with the trivial isotropy group.
struct Factor {
    name: String,
    algebra_name: String,
    algebra: LieAlgebra<Rational>,
    isotropy: Vec<Vec<Rational>>,
    complement: Vec<Vec<Rational>>,
    sentence: Option<String>,
}

impl Factor {
    /// The factor with the name `part`, which is a piece of `source`.
    fn read(part: &str, source: &Source) -> Result<Self, InputError> {
        let refused = |error: Error| InputError::from(error).at(&source.whole(part));
        if has_form(part.trim()) {
            let Embedding { name, algebra, algebra_name, vectors, sentence } =
                embedding(part.trim(), source)?;
            let complement = ReductivePair::complement(&algebra, &vectors).map_err(refused)?;
            let (isotropy, sentence) = (vectors, Some(sentence));
            return Ok(Factor { name, algebra_name, algebra, isotropy, complement, sentence });
        }
        let definition = entry(part, source)?;
        let algebra = definition.algebra::<Rational>(Tolerance::default());
        let algebra = algebra.map_err(|error| error.or_at(&source.whole(part)))?;
        let n = algebra.dimension();
        let unit = |i: usize| {
            let entry = |j: usize| if i == j { Rational::one() } else { Rational::zero() };
            (0..n).map(entry).collect()
        };
        Ok(Factor {
            name: definition.name.clone(),
            algebra_name: definition.name,
            algebra,
            isotropy: vec![],
            complement: (0..n).map(unit).collect(),
            sentence: None,
        })
    }
}

/// The product of the spaces and groups with these names, which are pieces of `source`. Its basis
/// consists of the bases of the factors, one after the other.
pub(super) fn of(parts: &[&str], source: &Source) -> Result<Definition, InputError> {
    let factors = parts.iter().map(|part| Factor::read(part, source));
    let factors = factors.collect::<Result<Vec<_>, InputError>>()?;
    let all: usize = factors.iter().map(|factor| factor.algebra.dimension()).sum();
    let place = source.whole(source.content());
    check_dimension(all).map_err(|error| error.at(&place))?;
    let (mut labels, mut constants): (Vec<String>, Vec<_>) = (vec![], vec![]);
    let (mut isotropy, mut complement) = (vec![], vec![]);
    let mut first = 0;
    for factor in &factors {
        let wide = |vector: &Vec<Rational>| {
            let mut wide = vec![Rational::zero(); all];
            wide[first..first + vector.len()].clone_from_slice(vector);
            wide
        };
        isotropy.extend(factor.isotropy.iter().map(wide));
        complement.extend(factor.complement.iter().map(wide));
        let own = factor.algebra.structure_constants();
        let own = own.components().filter(|(at, _)| at[1] < at[2]);
        constants.extend(
            own.map(|(at, value)| (first + at[1], first + at[2], first + at[0], value.clone())),
        );
        labels = join_labels(&labels, factor.algebra.labels());
        first += factor.algebra.dimension();
    }
    let joined =
        |name: fn(&Factor) -> &str| factors.iter().map(name).collect::<Vec<_>>().join(" + ");
    let algebra_name = joined(|factor| &factor.algebra_name);
    let coset = || -> Result<CosetSpace, Error> {
        let algebra = LieAlgebra::try_from(Bracket::from_constants(&labels, constants)?)?;
        CosetSpace::new::<Rational>(&algebra_name, &algebra, &isotropy, Some(complement))
    };
    let coset = coset().map_err(|error| InputError::from(error).at(&place))?;
    let sentences: Vec<_> = factors.iter().filter_map(|factor| factor.sentence.clone()).collect();
    let coset = CosetSpace { sentence: Some(sentences.join("; ")), ..coset };
    Ok(coset.read_as(joined(|factor| &factor.name), source.content().trim()))
}
