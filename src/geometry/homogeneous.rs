//! Homogeneous spaces G/H by name: `SU(3)/U(2)`, `S^7 = Sp(2)/Sp(1)`, `CP^2`, `G2/SU(3)`.
//!
//! A name denotes a pair of Lie algebras and one embedding ([`HomogeneousSpace::embedding`]). Whether the groups are connected or simply connected makes no difference for the algebras.

mod blocks;
mod exceptional;
mod name;

use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::catalogue;
use crate::geometry::reductive::ReductivePair;
use affinor_tensors::Rational;
use name::{Factor, Name};

/// A homogeneous space with its name and the embedding of the isotropy algebra.
///
/// ```
/// use affinor::Metric;
/// use affinor::geometry::homogeneous::HomogeneousSpace;
/// let plane = HomogeneousSpace::find("CP^2")?;
/// assert_eq!((plane.name(), plane.pair().dimension()), ("SU(3)/S(U(2)xU(1))", 4));
/// assert!(plane.pair().is_symmetric());
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
#[doc(alias("coset space", "quotient", "symmetric space", "flag manifold", "Stiefel manifold"))]
pub struct HomogeneousSpace {
    name: String,
    embedding: String,
    pair: ReductivePair<Rational>,
}

/// A subalgebra, as vectors in the basis of the algebra that contains it, with a sentence about the
/// embedding.
struct Embedded {
    algebra: LieAlgebra<Rational>,
    vectors: Vec<Vec<Rational>>,
    sentence: String,
}

impl HomogeneousSpace {
    /// The space with this name: `G/H` with factors joined by `x`, or the name of a family.
    ///
    /// | name | space |
    /// |---|---|
    /// | `S^n`, `H^n` | `SO(n+1)/SO(n)`, `SO(n,1)/SO(n)` |
    /// | `CP^n`, `CH^n` | `SU(n+1)/S(U(n)xU(1))`, `SU(n,1)/S(U(n)xU(1))` |
    /// | `HP^n`, `OP^2` | `Sp(n+1)/Sp(n)xSp(1)`, `F4/Spin(9)` |
    /// | `V(k,R^n)`, `V(k,C^n)`, `V(k,H^n)` | Stiefel manifolds, as `SO(n)/SO(n-k)` |
    /// | `Gr(k,R^n)`, `Gr(k,C^n)`, `Gr(k,H^n)` | Grassmann manifolds, as `SO(n)/SO(k)xSO(n-k)` |
    /// | `Fl(n)` | the full flags `SU(n)/T` |
    ///
    /// Factors of H are blocks along the diagonal of the defining matrices of G, in their order.
    /// `U(n)` in `SO(2n)` and `Sp(n)` in `SU(2n)` are the complex and the quaternionic matrices in
    /// real and complex form. `T` is the diagonal maximal torus, `U(1)_{k,l}` the circle
    /// `diag(k, l, -k-l)` of `SU(3)`. One factor in a product of equal factors is the diagonal. A
    /// text before `=` is ignored, as in `S^7 = Sp(2)/Sp(1)`.
    ///
    /// The complement is orthogonal under the Killing form of G.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a name that cannot be read, and for groups without a known embedding;
    /// those of [`ReductivePair::orthogonal`].
    pub fn find(name: &str) -> Result<Self, Error> {
        let read = Name::read(name)?;
        let embedded = embed(&read)?;
        let pair = ReductivePair::orthogonal(&embedded.algebra, &embedded.vectors)?;
        Ok(HomogeneousSpace { name: read.to_string(), embedding: embedded.sentence, pair })
    }

    /// The name as `G/H`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A sentence that states how H lies in G.
    pub fn embedding(&self) -> &str {
        &self.embedding
    }

    /// The algebra of G, the isotropy algebra and the complement.
    pub fn pair(&self) -> &ReductivePair<Rational> {
        &self.pair
    }
}

fn embed(name: &Name) -> Result<Embedded, Error> {
    match (name.group.as_slice(), name.isotropy.as_slice()) {
        ([Factor::Exceptional(group)], isotropy) => exceptional::embed(group, isotropy, name),
        ([Factor::Orthogonal(7)], [Factor::Exceptional("G2")]) => exceptional::octonions(),
        ([group], isotropy) => blocks::embed(*group, isotropy, name),
        ([first, ..], [one]) if name.group.iter().all(|factor| factor == one) => {
            diagonal(*first, name.group.len())
        }
        _ => Err(name.without_embedding()),
    }
}

/// The diagonal of a product of equal factors.
fn diagonal(factor: Factor, count: usize) -> Result<Embedded, Error> {
    let one = catalogue::algebra::<Rational>(&factor.algebra())?;
    let n = one.dimension();
    let algebra = (1..count).try_fold(one.clone(), |sum, _| sum.direct_sum(&one))?;
    let vectors =
        (0..n).map(|at| (0..n * count).map(|i| Rational::from((i % n == at) as i64)).collect());
    let sentence = format!("{factor} is the diagonal of {count} factors");
    Ok(Embedded { vectors: vectors.collect(), algebra, sentence })
}
