//! Invariant differential forms of homogeneous spaces, and their cohomology.

use super::ReductivePair;
use crate::Error;
use crate::algebra::invariants::common_kernel;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Scalar, Tensor};
use std::collections::BTreeMap;

/// The largest dimension of a space in which invariant forms are computed.
pub const MAX_FORMS: usize = 12;

/// The dimensions of the spaces of invariant forms, and of their cohomology, by degree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvariantForms {
    /// The dimensions of the invariant forms of degree 0, 1, ...
    pub dimensions: Vec<usize>,
    /// The dimensions of the relative cohomology of the algebra and `h`. If G is compact and H
    /// connected, they are the Betti numbers of G/H.
    pub betti: Vec<usize>,
}

impl InvariantForms {
    /// The alternating sum of the dimensions: the Euler characteristic if G is compact and H
    /// connected.
    pub fn euler_characteristic(&self) -> i64 {
        let signed = self.betti.iter().enumerate();
        signed.map(|(k, b)| if k % 2 == 0 { *b as i64 } else { -(*b as i64) }).sum()
    }
}

impl<S: Field + Scalar> ReductivePair<S> {
    /// The dimensions of the invariant differential forms and of their cohomology; `None` beyond the
    /// dimension [`MAX_FORMS`].
    ///
    /// Invariant forms are the `h`-invariant elements of the exterior algebra of the dual of `m`, with
    /// the derivative `d e^i = -(1/2) c^i_jk e^j ^ e^k` (C. Chevalley and S. Eilenberg, *Trans. Amer.
    /// Math. Soc.* 63 (1948) 85-124).
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// let plane = HomogeneousSpace::find("CP^2")?;
    /// let forms = plane.pair().differential_forms()?.expect("dimension 4");
    /// assert_eq!((forms.euler_characteristic(), forms.betti), (3, vec![1, 0, 1, 0, 1]));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Linear`] over a ring that is not a field.
    #[doc(alias("Betti numbers", "de Rham cohomology"))]
    pub fn differential_forms(&self) -> Result<Option<InvariantForms>, Error> {
        let r = self.dimension();
        if r > MAX_FORMS {
            return Ok(None);
        }
        let _stage = stage("invariant differential forms");
        let duals: Vec<_> = self.isotropy.iter().map(|ad| on_covectors(r, ad)).collect();
        let derivative = derivatives(r, self.frame.structure_functions());
        let tolerance = self.algebra.structure_constants().tolerance();
        let (mut dimensions, mut betti) = (vec![], vec![]);
        let mut exact = 0;
        let mut places = columns(r, 0);
        for k in 0..=r {
            let next = columns(r, k + 1);
            let masks: Vec<u16> = places.keys().copied().collect();
            let image = |map: &Vec<Vec<(u16, S)>>, row: &[(usize, S)]| {
                Ok(acted(row, &masks, &places, map, false))
            };
            let forms =
                common_kernel("invariant forms", masks.len(), tolerance, duals.iter(), image)?;
            let images =
                (0..forms.rows()).map(|at| acted(forms.row(at), &masks, &next, &derivative, true));
            let rank = match forms.rows() {
                0 => 0,
                _ => Matrix::from_rows(next.len(), images.collect::<Vec<_>>())?
                    .with_tolerance(tolerance)
                    .rank()?,
            };
            dimensions.push(forms.rows());
            betti.push(forms.rows() - rank - exact);
            (exact, places) = (rank, next);
        }
        Ok(Some(InvariantForms { dimensions, betti }))
    }
}

/// The columns of the basis forms of degree `k`, by the set of their indices as bits.
fn columns(r: usize, k: usize) -> BTreeMap<u16, usize> {
    let sets = (0..1u16 << r).filter(|set| set.count_ones() as usize == k);
    sets.zip(0..).collect()
}

/// The images of the covectors `e^i` under an endomorphism `A^i_j`: `-A^i_j e^j`, by sets of
/// indices.
fn on_covectors<S: Scalar>(r: usize, endomorphism: &Tensor<S>) -> Vec<Vec<(u16, S)>> {
    let mut images = vec![vec![]; r];
    for (at, value) in endomorphism.components() {
        images[at[0]].push((1 << at[1], -value.clone()));
    }
    images
}

/// The derivatives `d e^i`: the sum of `-c^i_jk e^j ^ e^k` over `j < k`.
fn derivatives<S: Scalar>(r: usize, structure: &Tensor<S>) -> Vec<Vec<(u16, S)>> {
    let mut images = vec![vec![]; r];
    for (at, value) in structure.components().filter(|(at, _)| at[1] < at[2]) {
        images[at[0]].push((1 << at[1] | 1 << at[2], -value.clone()));
    }
    images
}

/// The image of a form under the derivation of the exterior algebra with these images of the
/// covectors. An `odd` derivation changes its sign at each covector that it passes.
fn acted<S: Field + Scalar>(
    form: &[(usize, S)],
    masks: &[u16],
    target: &BTreeMap<u16, usize>,
    images: &[Vec<(u16, S)>],
    odd: bool,
) -> Row<S> {
    let mut sum = BTreeMap::<usize, S>::new();
    for (column, value) in form {
        let set = masks[*column];
        let indices = (0..16).filter(|i| set >> i & 1 == 1);
        for (position, i) in indices.enumerate() {
            let rest = set & !(1 << i);
            for (image, factor) in images[i].iter().filter(|(image, _)| image & rest == 0) {
                // the image replaces e^i; exchanges then sort the indices
                let before = set & ((1 << i) - 1);
                let bits = (0..16).filter(|j| image >> j & 1 == 1);
                let exchanges: u32 = bits
                    .map(|j| {
                        let below = (1u16 << j) - 1;
                        (before & !below).count_ones() + (rest & !before & below).count_ones()
                    })
                    .sum();
                let passed = if odd { position as u32 } else { 0 };
                let term = value.clone() * factor;
                let term = if (exchanges + passed).is_multiple_of(2) { term } else { -term };
                if let Some(at) = target.get(&(rest | image)) {
                    let entry = sum.entry(*at).or_insert_with(S::zero);
                    *entry = entry.clone() + &term;
                }
            }
        }
    }
    sum.into_iter().filter(|(_, value)| !value.vanishes()).collect()
}
