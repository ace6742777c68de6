//! The origin of a frame: a Lie algebra, or fields on a chart.

use crate::Error;
use crate::algebra::frame::Frame;
use crate::algebra::{Bracket, LieAlgebra};
use crate::geometry::chart::Fields;
use affinor_tensors::Field;

/// Where the frame of a geometry comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum FrameOrigin<S> {
    /// The left-invariant frame of a Lie algebra.
    Algebra(LieAlgebra<S>),
    /// Fields on a chart, and their Lie algebra if their structure functions are constants. The
    /// fields are then, near every point, the left-invariant fields of a group with this algebra.
    Chart(Box<Fields<S>>, Option<LieAlgebra<S>>),
}

impl<S: Field> FrameOrigin<S> {
    /// The frame.
    pub fn frame(&self) -> &Frame<S> {
        match self {
            FrameOrigin::Algebra(algebra) => algebra.left_frame(),
            FrameOrigin::Chart(fields, _) => fields.frame(),
        }
    }

    /// The Lie algebra of the frame; `None` if its structure functions are not constant.
    pub fn algebra(&self) -> Option<&LieAlgebra<S>> {
        match self {
            FrameOrigin::Algebra(algebra) => Some(algebra),
            FrameOrigin::Chart(_, algebra) => algebra.as_ref(),
        }
    }

    /// The Lie algebra of the frame, or an error that says what needs it.
    ///
    /// # Errors
    /// [`Error::NotConstant`] with `what` and the first structure function that is not constant.
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

    /// Whether the value has a derivative along the frame that is not zero.
    pub(super) fn varies(&self, value: &S) -> bool {
        let frame = self.frame();
        (0..frame.dimension()).any(|k| !frame.derive(k, value).vanishes())
    }

    /// The fields of a frame on a chart; `None` for the frame of a Lie algebra.
    pub fn fields(&self) -> Option<&Fields<S>> {
        match self {
            FrameOrigin::Algebra(_) => None,
            FrameOrigin::Chart(fields, _) => Some(fields),
        }
    }
}

impl<S> From<LieAlgebra<S>> for FrameOrigin<S> {
    fn from(algebra: LieAlgebra<S>) -> Self {
        FrameOrigin::Algebra(algebra)
    }
}

impl<S: Field> From<Fields<S>> for FrameOrigin<S> {
    fn from(fields: Fields<S>) -> Self {
        let frame = fields.frame();
        let structure = frame.structure();
        let constant = frame.derivative(structure).is_ok_and(|derivative| derivative.is_empty());
        let algebra = constant.then(|| Bracket::new(frame.labels(), structure.clone()));
        let algebra = algebra.and_then(|bracket| LieAlgebra::try_from(bracket.ok()?).ok());
        FrameOrigin::Chart(Box::new(fields), algebra)
    }
}
