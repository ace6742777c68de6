//! Frames: structure functions and derivations.

use crate::{Error, Law};
use affinor_tensors::text::combination;
use affinor_tensors::{Down, Scalar, Sum, Symbolic, Tensor, Tolerance, Up, Variance, contract};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::Arc;

/// A frame `e_1, ..., e_n`, with structure functions `[e_j, e_k] = c^i_jk e_i` and derivations `f
/// -> e_k(f)`.
///
/// The left-invariant frame of a Lie algebra has constant `c`, and its derivations vanish on
/// constants. The right-invariant frame (the frame of the opposite algebra), moving frames,
/// coordinate frames and the tangent space of a homogeneous space
/// ([`ReductivePair`](crate::ReductivePair)) are frames too. Therefore, every formula of
/// differential geometry is implemented once.
#[doc(alias("tetrad", "vielbein", "moving frame"))]
#[derive(Clone)]
pub struct Frame<S> {
    labels: Arc<[String]>,
    structure: Tensor<S>,
    derivations: Option<Derivations<S>>,
    isotropy: Option<Tensor<S>>,
}

/// The derivations `f -> e_k(f)`, with `k` from 0.
pub type Derivations<S> = Arc<dyn Fn(usize, &S) -> S + Send + Sync>;

impl<S: Scalar> Frame<S> {
    /// An invariant frame: constant structure `c^i_jk`, and zero derivations.
    ///
    /// ```
    /// use affinor::{CanonicalConnection, Connection, Frame, Metric, Rational};
    /// use affinor::algebra::catalogue;
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let constants = algebra.structure_constants().clone();
    /// let frame = Frame::invariant(["x", "y", "z"], constants)?;
    /// let metric = Metric::identity(3)?;
    /// let scalar = Connection::levi_civita(&frame, &metric)?.scalar_curvature(&metric)?;
    /// assert_eq!(Some(scalar), Rational::new(-1, 2));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless `structure` has the slots `^i_jk` in the dimension of the labels;
    /// [`Error::Invalid`] for an empty label, or two equal labels; [`Error::NotFinite`];
    /// [`Law::Antisymmetry`].
    #[doc(alias("left-invariant frame"))]
    pub fn invariant(
        labels: impl IntoIterator<Item: AsRef<str>>,
        structure: Tensor<S>,
    ) -> Result<Self, Error> {
        Self::labelled(
            labels.into_iter().map(|label| label.as_ref().to_string()).collect(),
            structure,
        )
    }

    fn labelled(labels: Arc<[String]>, structure: Tensor<S>) -> Result<Self, Error> {
        let frame = Frame { labels, structure, derivations: None, isotropy: None };
        expect_slots("the structure", &frame.structure, frame.labels.len(), &[Up, Down, Down])?;
        expect_names("basis", &frame.labels)?;
        expect_numbers("the structure", &frame.structure)?;
        let symmetric = contract("c^i_jk + c^i_kj -> ^i_jk", &[("c", &frame.structure)])?;
        match symmetric.components().next() {
            None => Ok(frame),
            Some((at, _)) => {
                let value = frame.structure.get(&at);
                let difference = value.clone() - &value;
                if !difference.vanishes() {
                    let at = [value.to_string()];
                    return Err(Law::AdditiveInverse.broken(at, difference.to_string()));
                }
                let (j, k) = (at[1], at[2]);
                let residual = (0..frame.labels.len()).map(|i| symmetric.get(&[i, j, k]));
                let at = [j, k].map(|at| frame.labels[at].clone());
                Err(Law::Antisymmetry.broken(at, frame.write(residual)))
            }
        }
    }

    /// A frame whose vectors differentiate the scalars: the closure computes
    /// `derivations(k, f) = e_k(f)`.
    ///
    /// # Errors
    /// The errors of [`invariant`](Self::invariant).
    pub fn moving(
        labels: impl IntoIterator<Item: AsRef<str>>,
        structure: Tensor<S>,
        derivations: Derivations<S>,
    ) -> Result<Self, Error> {
        let frame = Self::invariant(labels, structure)?;
        Ok(Frame { derivations: Some(derivations), ..frame })
    }

    /// The coordinate frame of partial derivatives; its structure functions (A9) are zero.
    pub(crate) fn holonomic(labels: &[String], partial: Derivations<S>) -> Result<Self, Error> {
        let structure = Tensor::zero(labels.len(), &[Up, Down, Down])?;
        Self::moving(labels, structure, partial)
    }

    /// A frame with other vectors, which are given by their structure, isotropy and derivations.
    /// The closure `derive` is used only if this frame has derivations.
    pub(crate) fn with_vectors(
        &self,
        labels: impl IntoIterator<Item: AsRef<str>>,
        structure: Tensor<S>,
        isotropy: Tensor<S>,
        derive: Derivations<S>,
    ) -> Result<Self, Error> {
        let derivations = self.derivations.as_ref().map(|_| derive);
        Ok(Frame { derivations, ..Self::reductive(labels, structure, isotropy)? })
    }

    /// The frame of the tangent space `m` of a reductive homogeneous space. Its structure is
    /// `[e_j, e_k]_m`, its isotropy `[[e_k, e_l]_h, e_j] = h^i_jkl e_i`. If the isotropy vanishes,
    /// the frame is an invariant frame of a group.
    pub(crate) fn reductive(
        labels: impl IntoIterator<Item: AsRef<str>>,
        structure: Tensor<S>,
        isotropy: Tensor<S>,
    ) -> Result<Self, Error> {
        let frame = Self::invariant(labels, structure)?;
        expect_slots("the isotropy", &isotropy, frame.dimension(), &[Up, Down, Down, Down])?;
        Ok(Frame { isotropy: (!isotropy.is_empty()).then_some(isotropy), ..frame })
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.labels.len()
    }

    /// The names of the frame vectors.
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// The structure functions `c^i_jk`, slots `[Up, Down, Down]`.
    pub fn structure_functions(&self) -> &Tensor<S> {
        &self.structure
    }

    /// The isotropy `h^i_jkl` of a homogeneous space, slots `[Up, Down, Down, Down]`, defined by
    /// `[[e_k, e_l]_h, e_j] = h^i_jkl e_i`. The curvature contains it with a minus sign. Any other
    /// frame has zero isotropy.
    ///
    /// # Errors
    /// If the dimension exceeds the limit of tensors of rank 4.
    pub fn isotropy(&self) -> Result<Tensor<S>, Error> {
        match &self.isotropy {
            Some(isotropy) => Ok(isotropy.clone()),
            None => Ok(Tensor::zero(self.dimension(), &[Up, Down, Down, Down])?),
        }
    }

    /// Whether the frame is an invariant frame of a group: no derivations and no isotropy.
    pub fn is_invariant(&self) -> bool {
        self.derivations.is_none() && self.isotropy.is_none()
    }

    /// Whether components of invariant tensors are constant: the frame of a group or of a homogeneous
    /// space.
    pub(crate) fn is_homogeneous(&self) -> bool {
        self.derivations.is_none()
    }

    /// The frame derivatives `e_k(T)` of all components; `k` is a new first slot `_k`.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Tensor`] if the result is too large for
    /// the indices of a tensor, 64 bits.
    pub fn derivative(&self, tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
        expect_slots("the tensor", tensor, self.dimension(), tensor.slots())?;
        let derivative = match &self.derivations {
            Some(derive) => tensor.with_first_slot(Down, |k, value| derive(k, value))?,
            None => Tensor::zero(self.dimension(), &[&[Down], tensor.slots()].concat())?,
        };
        Ok(derivative.with_tolerance(tensor.tolerance()))
    }

    /// The derivative `e_k(f)` of one function, `k` from 0.
    pub fn derive(&self, k: usize, f: &S) -> S {
        self.derivations.as_ref().map_or_else(S::zero, |derive| derive(k, f))
    }

    /// The Jacobi residual, slots `^i_jkl`: `[[e_j,e_k],e_l] + [[e_k,e_l],e_j] + [[e_l,e_j],e_k]`,
    /// where `[[e_j,e_k],e_l] = c^m_jk c^i_ml e_i - e_l(c^i_jk) e_i`. The residual vanishes for
    /// fields on a manifold.
    pub fn jacobi(&self) -> Tensor<S> {
        let derivative = self.derivative(&self.structure).expect("the structure of this frame");
        // the second term contains [[e_j,e_l],e_k] with the opposite sign, so that it is the mirror
        // image of the first term
        formula(
            "c^m_jk c^i_ml - c^m_jl c^i_mk + c^m_kl c^i_mj \
             - d_l^i_jk + d_k^i_jl - d_j^i_kl -> ^i_[jkl]",
            &[("c", &self.structure), ("d", &derivative)],
        )
    }

    /// The same frame with another tolerance for floats.
    pub(crate) fn with_tolerance(self, tolerance: Tolerance) -> Self {
        Frame { structure: self.structure.with_tolerance(tolerance), ..self }
    }

    /// Writes one line `{open}x, y{close} = z` for each nonzero product `e_j e_k = T^i_jk e_i`
    /// whose indices satisfy `wanted`.
    pub(crate) fn write_products(
        &self,
        f: &mut fmt::Formatter<'_>,
        products: &Tensor<S>,
        open: &str,
        close: &str,
        wanted: impl Fn(usize, usize) -> bool,
    ) -> fmt::Result {
        let mut lines = BTreeMap::<_, Vec<_>>::new();
        for (at, value) in products.components().filter(|(at, _)| wanted(at[1], at[2])) {
            let term = (value.clone(), self.labels[at[0]].clone());
            lines.entry((at[1], at[2])).or_default().push(term);
        }
        for (line, ((j, k), terms)) in lines.into_iter().enumerate() {
            let (x, y) = (&self.labels[j], &self.labels[k]);
            let end = if line == 0 { "" } else { "\n" };
            write!(f, "{end}{open}{x}, {y}{close} = {}", combination(terms))?;
        }
        Ok(())
    }

    /// Writes components as a linear combination of the frame vectors.
    pub(crate) fn write(&self, components: impl IntoIterator<Item = S>) -> String {
        let named = components.into_iter().zip(self.labels.iter().cloned());
        combination(named.filter(|(value, _)| !value.vanishes()))
    }
}

impl Frame<Symbolic> {
    /// The frame `d/dx^1 .. d/dx^n` of coordinates that are parameters of the scalars. Its
    /// structure functions (A9) are zero, and its derivations are partial derivatives.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an empty name, or two equal names; [`Error::Tensor`] if the dimension
    /// is too large for the indices of a tensor, 64 bits.
    pub fn coordinates(names: impl IntoIterator<Item: AsRef<str>>) -> Result<Self, Error> {
        let names: Arc<[String]> =
            names.into_iter().map(|name| name.as_ref().to_string()).collect();
        let variables = names.clone();
        Self::holonomic(&names, Arc::new(move |k, f| f.derivative(&variables[k])))
    }
}

/// Two frames are equal if their labels, structure, isotropy and derivations are equal. Closures of
/// derivations are compared by their addresses.
impl<S: PartialEq> PartialEq for Frame<S> {
    fn eq(&self, other: &Self) -> bool {
        let derivations = match (&self.derivations, &other.derivations) {
            (None, None) => true,
            (Some(mine), Some(theirs)) => Arc::ptr_eq(mine, theirs),
            _ => false,
        };
        derivations
            && self.labels == other.labels
            && self.structure == other.structure
            && self.isotropy == other.isotropy
    }
}

impl<S: fmt::Debug> fmt::Debug for Frame<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Frame")
            .field("labels", &self.labels)
            .field("structure", &self.structure)
            .field("derivations", &self.derivations.is_some())
            .field("isotropy", &self.isotropy)
            .finish()
    }
}

/// Checks that the tensor has the given dimension and slots.
pub(crate) fn expect_slots<S: Scalar>(
    what: &'static str,
    tensor: &Tensor<S>,
    dimension: usize,
    slots: &[Variance],
) -> Result<(), Error> {
    if tensor.dimension() == dimension && tensor.slots() == slots {
        return Ok(());
    }
    let shape = |n, slots: &[Variance]| format!("dimension {n} and slots {slots:?}");
    Err(Error::Shape {
        what,
        expected: shape(dimension, slots),
        found: shape(tensor.dimension(), tensor.slots()),
    })
}

/// Checks that names are nonempty and distinct.
fn expect_names(what: &'static str, names: &[String]) -> Result<(), Error> {
    let mut seen = BTreeSet::new();
    match names.iter().find(|name| name.is_empty() || !seen.insert(*name)) {
        None => Ok(()),
        Some(name) if name.is_empty() => {
            Err(Error::Invalid { what, reason: "a name is empty".into() })
        }
        Some(name) => {
            Err(Error::Invalid { what, reason: format!("the name `{name}` occurs twice") })
        }
    }
}

/// Checks that no component is infinite or NaN. The check is explicit, because comparisons with NaN
/// are always false.
///
/// # Errors
/// [`Error::NotFinite`] with the first such component; `what` is the name of the tensor.
pub fn expect_numbers<S: Scalar>(what: &'static str, tensor: &Tensor<S>) -> Result<(), Error> {
    match tensor.components().find(|(_, value)| !value.is_number()) {
        None => Ok(()),
        Some((at, value)) => {
            let at = at.iter().map(|index| index + 1).collect();
            Err(Error::NotFinite { what, at, value: value.to_string() })
        }
    }
}

/// Checks that a tensor is symmetric (`sign` 1) or antisymmetric (-1) in two slots, and that its
/// components are finite.
pub(crate) fn expect_symmetry<S: Scalar>(
    what: &'static str,
    tensor: &Tensor<S>,
    [a, b]: [usize; 2],
    sign: i64,
) -> Result<(), Error> {
    expect_numbers(what, tensor)?;
    for (at, value) in tensor.components() {
        let mut exchanged = at.to_vec();
        exchanged.swap(a, b);
        let mut sum = S::Sum::term(value);
        sum.add_product(&S::from_i64(-sign), &tensor.get(&exchanged));
        if let Some(residual) = sum.finish(tensor.tolerance()) {
            return Err(Error::Symmetry {
                what,
                symmetry: if sign > 0 { "symmetric" } else { "antisymmetric" },
                slots: [a + 1, b + 1],
                at: at.iter().map(|index| index + 1).collect(),
                residual: residual.to_string(),
            });
        }
    }
    Ok(())
}

/// Evaluates a contraction formula of this package. The evaluation cannot fail, because the formula
/// is well formed and constructors have checked the slots of the operands.
pub(crate) fn formula<S: Scalar>(text: &str, operands: &[(&str, &Tensor<S>)]) -> Tensor<S> {
    contract(text, operands).expect("a formula over tensors of one frame")
}
