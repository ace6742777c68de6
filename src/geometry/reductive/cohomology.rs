//! Invariant differential forms of homogeneous spaces, and their cohomology.

use super::ReductivePair;
use crate::Error;
use crate::algebra::{Dimensions, relative_cohomology};
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Scalar};

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
        let n = self.algebra.dimension();
        match relative_cohomology(&self.algebra, r, &vec![vec![vec![]]; n], 1) {
            Ok(Dimensions { cochains, betti }) => {
                Ok(Some(InvariantForms { dimensions: cochains, betti }))
            }
            Err(Error::Size { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }
}
