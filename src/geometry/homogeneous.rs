//! Homogeneous spaces G/H by name: `SU(3)/U(2)`, `S^7 = Sp(2)/Sp(1)`, `CP^2`, `G2/SU(3)`.
//!
//! A name denotes a pair of Lie algebras and one embedding ([`HomogeneousSpace::embedding`]). Whether the groups are connected or simply connected makes no difference for the algebras.

mod blocks;
mod exceptional;
mod name;
mod nearest;
mod octonions;

pub use name::{FAMILIES, Family};

use crate::Error;
use crate::algebra::{LieAlgebra, catalogue};
use crate::geometry::reductive::ReductivePair;
use affinor_tensors::{Field, Rational, Scalar};
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
#[derive(Clone, Debug, PartialEq)]
#[doc(alias("coset space", "quotient", "symmetric space", "flag manifold", "Stiefel manifold"))]
pub struct HomogeneousSpace<S = Rational> {
    name: String,
    embedding: String,
    complement: Vec<String>,
    pair: ReductivePair<S>,
}

/// A subalgebra of a Lie algebra, as vectors in the basis of the algebra that contains it.
#[derive(Clone, Debug)]
pub struct Embedding {
    /// The name of the homogeneous space, as `G/H`.
    pub name: String,
    /// The Lie algebra of G.
    pub algebra: LieAlgebra<Rational>,
    /// The name of the Lie algebra of G in the catalogue.
    pub algebra_name: String,
    /// A basis of the Lie algebra of H.
    pub vectors: Vec<Vec<Rational>>,
    /// A sentence that states how H lies in G.
    pub sentence: String,
}

/// An embedding without its names.
struct Embedded {
    algebra: LieAlgebra<Rational>,
    vectors: Vec<Vec<Rational>>,
    sentence: String,
}

impl Embedded {
    /// The dimension of G/H.
    fn dimension(&self) -> usize {
        self.algebra.dimension() - self.vectors.len()
    }
}

impl Embedding {
    /// The embedding of H in G for the name of a homogeneous space; see [`HomogeneousSpace::find`].
    ///
    /// ```
    /// use affinor::geometry::homogeneous::Embedding;
    /// let sphere = Embedding::find("S^7 = Sp(2)/Sp(1)")?;
    /// assert_eq!((sphere.algebra_name.as_str(), sphere.vectors.len()), ("usp(4)", 3));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Name`] for a name that cannot be read, for groups without a known embedding, and if the
    /// name before `=` has another dimension.
    pub fn find(name: &str) -> Result<Self, Error> {
        let read = Name::read(name)?;
        let found = embed(&read)?;
        // a family before `=` has the dimension of the space
        if let Some((label, _)) = name.rsplit_once('=')
            && let Ok(label) = Name::read(label)
        {
            let [own, other] = [found.dimension(), embed(&label)?.dimension()];
            if own != other {
                return Err(Error::Name(format!(
                    "{read} has dimension {own}, but {label} before `=` has dimension {other}"
                )));
            }
        }
        let Embedded { algebra, vectors, sentence } = found;
        let factors: Vec<_> = read.group.iter().map(|factor| factor.algebra()).collect();
        let algebra_name = factors.join(" + ");
        Ok(Embedding { name: read.to_string(), algebra, algebra_name, vectors, sentence })
    }
}

/// Whether a text has the form of a name of a homogeneous space, although it may be misspelt. The
/// forms are `G/H`, where both sides look like names of groups, and the names of families.
///
/// ```
/// use affinor::geometry::homogeneous::has_form;
/// assert!(has_form("SU(3)/U(2)") && has_form("S^7 = Sp(2)/Sp(1)") && has_form("CP^2"));
/// assert!(!has_form("data/so3") && !has_form("so(3)"));
/// ```
pub fn has_form(text: &str) -> bool {
    name::has_form(text)
}

/// The fault of a name that has the form of a family, but numbers of no space.
///
/// ```
/// use affinor::geometry::homogeneous::fault;
/// assert_eq!(fault("dS^1").as_deref(), Some("dS^n needs a number n from 2 to 40"));
/// assert_eq!(fault("dS^4"), None);
/// ```
pub fn fault(text: &str) -> Option<String> {
    name::fault(text)
}

/// The names of homogeneous spaces that a misspelt name may mean; none for other texts.
///
/// ```
/// use affinor::geometry::homogeneous::nearest;
/// assert_eq!(nearest("su(3)/u(2)"), ["SU(3)/U(2)"]);
/// assert_eq!(nearest("cp^2"), ["CP^2"]);
/// ```
pub fn nearest(text: &str) -> Vec<String> {
    nearest::nearest(text)
}

impl HomogeneousSpace {
    /// The space with this name: `G/H` with factors joined by `x`, or the name of a family.
    ///
    /// | name | space |
    /// |---|---|
    /// | `S^n`, `H^n` | `SO(n+1)/SO(n)`, `SO(n,1)/SO(n)` |
    /// | `CP^n`, `CH^n` | `SU(n+1)/S(U(n)xU(1))`, `SU(n,1)/S(U(n)xU(1))` |
    /// | `HP^n`, `HH^n` | `Sp(n+1)/Sp(n)xSp(1)`, `Sp(n,1)/Sp(n)xSp(1)` |
    /// | `OP^2` | `F4/Spin(9)` |
    /// | `dS^n`, `AdS^n` | `SO(n,1)/SO(n-1,1)`, `SO(n-1,2)/SO(n-1,1)`; minus the Killing form has the signatures `(n-1,1)` and `(1,n-1)` |
    /// | `V(k,R^n)`, `V(k,C^n)`, `V(k,H^n)` | Stiefel manifolds, as `SO(n)/SO(n-k)` |
    /// | `Gr(k,R^n)`, `Gr(k,C^n)`, `Gr(k,H^n)` | Grassmann manifolds, as `SO(n)/SO(k)xSO(n-k)` |
    /// | `Fl(n)` | the full flags `SU(n)/T` |
    /// | `T^{p,q}` | `SU(2)xSU(2)/U(1)_{q,-p}`, a circle bundle over `S^2 x S^2` |
    ///
    /// Factors of H are blocks along the diagonal of the defining matrices of G, in their order.
    /// `U(n)` in `SO(2n)` and `Sp(n)` in `SU(2n)` are the complex and the quaternionic matrices in
    /// real and complex form. `T` is the diagonal maximal torus, `U(1)_{k,l}` the circle
    /// `diag(k, l, -k-l)` of `SU(3)`, in `SU(2)xSU(2)` the circle of the weights `k` and `l`. `Spin(7)` in
    /// `Spin(9)` fixes a spinor, `SO(3)_irr` acts on `R^5` irreducibly, `SU(2)_long` in `G2` belongs to a
    /// long root. One factor in a product of equal factors is the diagonal. A
    /// name before `=`, as in `S^7 = Sp(2)/Sp(1)`, must have the same dimension; another text is ignored.
    ///
    /// The complement is orthogonal under the Killing form of G.
    ///
    /// # Errors
    /// Those of [`Embedding::find`] and [`new`](Self::new).
    pub fn find(name: &str) -> Result<Self, Error> {
        let Embedding { name, algebra, vectors, sentence, .. } = Embedding::find(name)?;
        Self::new(name, sentence, &algebra, &vectors)
    }
}

impl<S: Field + Scalar> HomogeneousSpace<S> {
    /// The space of an algebra and a basis of the isotropy algebra, with the complement of
    /// [`ReductivePair::complement`]. The `embedding` is a sentence about the isotropy algebra.
    ///
    /// # Errors
    /// Those of [`ReductivePair::complement`] and [`ReductivePair::new`].
    pub fn new(
        name: impl Into<String>,
        embedding: impl Into<String>,
        algebra: &LieAlgebra<S>,
        h: &[Vec<S>],
    ) -> Result<Self, Error> {
        let m = ReductivePair::complement(algebra, h)?;
        let write = |x: &Vec<S>| algebra.left_frame().write(x.iter().cloned());
        let (pair, texts) = (ReductivePair::new(algebra, h, &m)?, m.iter().map(write).collect());
        Ok(Self::of_pair(name, embedding, texts, pair))
    }

    /// The space of a reductive pair. The `complement` is the basis of `m` as text, in the basis in
    /// which the algebra of G was given.
    pub fn of_pair(
        name: impl Into<String>,
        embedding: impl Into<String>,
        complement: Vec<String>,
        pair: ReductivePair<S>,
    ) -> Self {
        HomogeneousSpace { name: name.into(), embedding: embedding.into(), complement, pair }
    }
}

impl<S> HomogeneousSpace<S> {
    /// The name as `G/H`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A sentence that states how H lies in G.
    pub fn embedding(&self) -> &str {
        &self.embedding
    }

    /// The basis of the complement in the basis of the algebra of G, as text.
    pub fn complement(&self) -> &[String] {
        &self.complement
    }

    /// The algebra of G, the isotropy algebra and the complement.
    pub fn pair(&self) -> &ReductivePair<S> {
        &self.pair
    }
}

fn embed(name: &Name) -> Result<Embedded, Error> {
    match (name.group.as_slice(), name.isotropy.as_slice()) {
        ([Factor::Exceptional(group)], isotropy) => exceptional::embed(group, isotropy, name),
        ([Factor::Orthogonal(7)], [Factor::Exceptional("G2")]) => octonions::automorphisms(),
        ([Factor::Orthogonal(9)], [Factor::OfSpinor]) => octonions::of_spinor(),
        ([Factor::Orthogonal(5)], [Factor::Irreducible]) => blocks::irreducible(),
        ([Factor::SpecialUnitary(2), Factor::SpecialUnitary(2)], [Factor::Circle(k, l)]) => {
            circle(*k, *l)
        }
        ([group], isotropy) => blocks::embed(*group, isotropy, name),
        ([first, ..], [one]) if name.group.iter().all(|factor| factor == one) => {
            diagonal(*first, name.group.len())
        }
        _ => Err(name.without_embedding()),
    }
}

/// The circle `diag(e^(ikt), e^(-ikt))`, `diag(e^(ilt), e^(-ilt))` of two factors `SU(2)`.
fn circle(k: i64, l: i64) -> Result<Embedded, Error> {
    let one = catalogue::algebra::<Rational>("su(2)")?;
    // the last vector of su(2) is diagonal
    let vector = [0, 0, k, 0, 0, l].map(Rational::from).to_vec();
    let sentence = format!("the circle of diagonal matrices with the weights {k} and {l}");
    Ok(Embedded { algebra: one.direct_sum(&one)?, vectors: vec![vector], sentence })
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
