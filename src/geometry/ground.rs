//! What a geometry stands on: an algebra, or fields on a chart.

use crate::chart::Fields;
use crate::{Bracket, Error, Frame, LieAlgebra};
use affinor_tensors::Field;

/// What a geometry stands on: a frame, and where it comes from.
#[derive(Clone, Debug)]
pub enum Ground<S> {
    /// The left-invariant frame of a Lie algebra.
    Algebra(LieAlgebra<S>),
    /// Fields on a chart. If their structure functions are constants they are, near every point,
    /// the left-invariant fields of a group, whose algebra this is.
    Chart(Box<Fields<S>>, Option<LieAlgebra<S>>),
}

impl<S: Field> Ground<S> {
    /// The frame.
    pub fn frame(&self) -> &Frame<S> {
        match self {
            Ground::Algebra(algebra) => algebra.left_frame(),
            Ground::Chart(fields, _) => fields.frame(),
        }
    }

    /// The algebra of the structure constants, if they are constants.
    pub fn algebra(&self) -> Option<&LieAlgebra<S>> {
        match self {
            Ground::Algebra(algebra) => Some(algebra),
            Ground::Chart(_, algebra) => algebra.as_ref(),
        }
    }

    /// The algebra, for `what`.
    ///
    /// # Errors
    /// [`Error::NotConstant`] with a structure function.
    pub fn algebra_for(&self, what: &'static str) -> Result<&LieAlgebra<S>, Error> {
        self.algebra().ok_or_else(|| {
            let frame = self.frame();
            let found = frame.structure().components().find(|(_, value)| self.varies(value));
            let (component, value) = found.map_or_else(Default::default, |(at, value)| {
                let [i, j, k] = [at[0] + 1, at[1] + 1, at[2] + 1];
                (format!("c^{i}_{j}{k}"), value.to_string())
            });
            Error::NotConstant { what, component, value }
        })
    }

    /// Whether a value is not constant.
    pub(super) fn varies(&self, value: &S) -> bool {
        let frame = self.frame();
        (0..frame.dimension()).any(|k| !frame.derive(k, value).vanishes())
    }

    /// The fields, on a chart.
    pub fn fields(&self) -> Option<&Fields<S>> {
        match self {
            Ground::Algebra(_) => None,
            Ground::Chart(fields, _) => Some(fields),
        }
    }
}

impl<S> From<LieAlgebra<S>> for Ground<S> {
    fn from(algebra: LieAlgebra<S>) -> Self {
        Ground::Algebra(algebra)
    }
}

impl<S: Field> From<Fields<S>> for Ground<S> {
    fn from(fields: Fields<S>) -> Self {
        let frame = fields.frame();
        let structure = frame.structure();
        let constant = frame.derivative(structure).is_ok_and(|derivative| derivative.is_empty());
        let algebra = constant.then(|| Bracket::new(frame.labels().clone(), structure.clone()));
        let algebra = algebra.and_then(|bracket| LieAlgebra::try_from(bracket.ok()?).ok());
        Ground::Chart(Box::new(fields), algebra)
    }
}
