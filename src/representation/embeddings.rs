//! Subalgebras of simple algebras, given by the restriction of the defining representation.

use super::exceptional::projection;
use super::names::irreducible;
use super::subalgebra::not_a_subalgebra;
use super::{
    Decomposition, HighestWeight, Indicator, ReductiveAlgebra, RepresentationError, Subalgebra,
};
use crate::algebra::roots::{CartanType, Series};
use num_bigint::BigInt;

impl Subalgebra {
    /// The subalgebra of a simple algebra to which the defining representation restricts as given.
    /// For `A_n` this is a representation of dimension `n + 1`, for `B_n` and `D_n` an orthogonal one
    /// of dimension `2n + 1` and `2n`, for `C_n` a symplectic one of dimension `2n`. The defining
    /// representations of the exceptional algebras are the smallest: 7 of G2, 26 of F4, 27 of E6, 56
    /// of E7, 248 of E8.
    ///
    /// For a classical algebra, the weights of the representation are the projections of the weights
    /// `ε_i`; their order does not matter, because the Weyl group permutes the `ε_i`. For `D_n` another order may exchange
    /// the two spinor representations.
    ///
    /// # Errors
    /// [`RepresentationError::NotASubalgebra`] if the algebra is not simple, or if the representation
    /// has the wrong dimension, no invariant form of the kind, a trace or a kernel. The same error
    /// occurs if it does not extend to the spinors or to an exceptional algebra.
    ///
    /// ```
    /// use affinor::representation::{Decomposition, HighestWeight, ReductiveAlgebra, Subalgebra};
    /// let su6: ReductiveAlgebra = "SU(6)".parse()?;
    /// let factors: ReductiveAlgebra = "SU(3) x SU(2)".parse()?;
    /// let six = Decomposition::irreducible(&HighestWeight::parse(&factors, "(3,2)")?);
    /// let quark_model = Subalgebra::by_representation(&su6, &six)?;
    /// let baryons = quark_model.branch(&HighestWeight::parse(&su6, "56")?)?;
    /// assert_eq!(baryons.to_string(), "(8,2) + (10,4)");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn by_representation(
        ambient: &ReductiveAlgebra,
        defining: &Decomposition,
    ) -> Result<Self, RepresentationError> {
        let algebra = defining.algebra();
        let wrong = |reason: String| not_a_subalgebra(ambient, algebra, reason);
        let dimension = match ambient.simple_factors() {
            [one] if ambient.abelian_dimension() == 0 => Some(defining_dimension(*one)),
            _ => None,
        };
        let (Some(dimension), Some(factor)) = (dimension, ambient.simple_factors().first()) else {
            return Err(wrong("a defining representation needs a simple algebra".into()));
        };
        if defining.dimension() != BigInt::from(dimension) {
            return Err(wrong(format!(
                "the dimension of {defining} is {}, but the defining representation has {dimension}",
                defining.dimension()
            )));
        }
        let form = match factor.series() {
            Series::A => None,
            Series::C => Some(Indicator::Quaternionic),
            Series::E if factor.rank() == 6 => None,
            Series::E if factor.rank() == 7 => Some(Indicator::Quaternionic),
            _ => Some(Indicator::Real),
        };
        if let Some(indicator) = form.filter(|indicator| !has_form(defining, *indicator)) {
            let kind = if indicator == Indicator::Real { "symmetric" } else { "antisymmetric" };
            return Err(wrong(format!("{defining} has no invariant {kind} form")));
        }
        if matches!(factor.series(), Series::E | Series::F | Series::G) {
            let smallest = irreducible(*factor, dimension as u64).into_iter().max();
            let smallest = smallest.map(|labels| HighestWeight::of(ambient, labels));
            let found = smallest.and_then(|weight| projection(ambient, &weight, defining));
            let found = found.ok_or_else(|| wrong(format!("{defining} does not extend")))?;
            let found = Self::by_projection(ambient, algebra, found)?;
            return Ok(found.described(format!("defining representation {defining}")));
        }
        let mut all = vec![];
        defining.character()?.for_each_weight(|weight, multiplicity| {
            all.extend((0..multiplicity).map(|_| weight.to_vec()));
        });
        all.sort_by(|a, b| b.cmp(a));
        let (rank, n) = (algebra.rank(), factor.rank());
        if form.is_none() && (0..rank).any(|i| all.iter().map(|w| w[i]).sum::<i64>() != 0) {
            return Err(wrong(format!("the charges of {defining} have a trace")));
        }
        // ε_1, ..., ε_n: one weight of each pair of opposite weights, and zeros
        let mut epsilons = all;
        if form.is_some() {
            let zero = vec![0; rank];
            epsilons.retain(|weight| *weight > zero);
            epsilons.resize(n, zero);
        }
        let mut images = vec![];
        let mut sum = vec![0; rank];
        for epsilon in epsilons.iter().take(n) {
            sum.iter_mut().zip(epsilon).for_each(|(s, e)| *s += e);
            images.push(sum.clone());
        }
        let halved = |image: &[i64]| -> Result<Vec<i64>, RepresentationError> {
            let half = image.iter().map(|label| (label % 2 == 0).then_some(label / 2));
            let half: Option<Vec<i64>> = half.collect();
            half.ok_or_else(|| {
                wrong("a spinor would have half a charge: double the charges".into())
            })
        };
        match factor.series() {
            Series::B => images[n - 1] = halved(&images[n - 1])?,
            Series::D => {
                let last = epsilons[n - 1].iter();
                let other: Vec<i64> =
                    images[n - 1].iter().zip(last).map(|(s, e)| s - 2 * e).collect();
                images[n - 1] = halved(&images[n - 1])?;
                images[n - 2] = halved(&other)?;
            }
            _ => {}
        }
        let rows = (0..rank).map(|i| images.iter().map(|image| image[i]).collect());
        let found = Self::by_projection(ambient, algebra, rows.collect())?;
        Ok(found.described(format!("defining representation {defining}")))
    }
}

/// The dimension of the defining representation of a simple type.
pub(super) fn defining_dimension(factor: CartanType) -> usize {
    let n = factor.rank();
    match (factor.series(), n) {
        (Series::A, _) => n + 1,
        (Series::B, _) => 2 * n + 1,
        (Series::C | Series::D, _) => 2 * n,
        (Series::G, _) => 7,
        (Series::F, _) => 26,
        (Series::E, 6) => 27,
        (Series::E, 7) => 56,
        (Series::E, _) => 248,
    }
}

/// Whether a representation has an invariant form that is not degenerate, symmetric or
/// antisymmetric: components without such a form of their own occur in dual pairs.
fn has_form(representation: &Decomposition, indicator: Indicator) -> bool {
    representation.components().all(|(weight, multiplicity)| match weight.indicator() {
        Indicator::Complex => representation.multiplicity(&weight.dual()) == multiplicity,
        own => own == indicator || multiplicity % 2 == 0,
    })
}
