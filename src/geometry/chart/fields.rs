//! Vector fields on a chart that form a frame.

use super::Chart;
use crate::algebra::BasisChange;
use crate::algebra::frame::Frame;
use affinor_tensors::text::combination;
use affinor_tensors::{Field, Scalar, Tensor};

/// Vector fields `e_i = e^a_i d/dx^a`, and the frame that they form. The fields are linearly
/// independent where the determinant of `e^a_i` is not zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields<S> {
    chart: Chart,
    change: BasisChange<S>,
    frame: Frame<S>,
}

impl<S: Field + Scalar> Fields<S> {
    pub(super) fn new(chart: Chart, change: BasisChange<S>, frame: Frame<S>) -> Self {
        Fields { chart, change, frame }
    }

    /// The chart.
    pub fn chart(&self) -> &Chart {
        &self.chart
    }

    /// The frame with the structure functions `c^i_jk` of `[e_j, e_k] = c^i_jk e_i` (A6), and the
    /// derivatives along the fields.
    pub fn frame(&self) -> &Frame<S> {
        &self.frame
    }

    /// The components `e^a_i`, slots `[Up, Down]`. Column `i` is the field `e_i`.
    pub fn components(&self) -> &Tensor<S> {
        self.change.matrix()
    }

    /// The change from the coordinate frame to the frame of the fields.
    pub fn change(&self) -> &BasisChange<S> {
        &self.change
    }

    /// Whether the fields are the coordinate fields.
    pub fn are_coordinates(&self) -> bool {
        *self.components() == Tensor::identity(self.chart.dimension())
    }

    /// Writes the fields as text, such as `1/sin(theta)*d_phi`.
    pub fn written(&self) -> Vec<String> {
        let labels = self.chart.labels();
        let field = |i: usize| {
            let terms = self.components().components().filter(|(at, _)| at[1] == i);
            combination(terms.map(|(at, value)| (value, labels[at[0]].clone())))
        };
        (0..self.chart.dimension()).map(field).collect()
    }
}
