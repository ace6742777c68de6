//! Linear equations that are added one by one, so that the first contradiction is a witness.

use crate::Error;
use affinor_tensors::linear::Echelon;
use affinor_tensors::{Field, Scalar, Tolerance};

/// An ordered system of linear equations `sum of coefficient * unknown + constant = 0`.
pub(in crate::geometry) struct LinearSystem<S> {
    unknowns: usize,
    /// The equations as rows; the last column contains the constants.
    span: Echelon<S>,
}

impl<S: Field + Scalar> LinearSystem<S> {
    pub fn new(unknowns: usize, tolerance: Tolerance) -> Self {
        LinearSystem { unknowns, span: Echelon::new().with_tolerance(tolerance) }
    }

    /// Adds an equation. If the equation contradicts the earlier equations, the method returns the
    /// constant that remains.
    pub fn add(&mut self, mut row: Vec<(usize, S)>, constant: S) -> Result<Option<S>, Error> {
        row.push((self.unknowns, constant));
        let remainder = self.span.reduce(row);
        match remainder.first() {
            Some((at, residual)) if *at == self.unknowns => Ok(Some(residual.clone())),
            _ => {
                self.span.insert(remainder)?;
                Ok(None)
            }
        }
    }

    /// The nonzero values of the solution in which every unknown without a pivot is 0, each with
    /// its column.
    pub fn solution(&self) -> impl Iterator<Item = (usize, S)> {
        let value = |(pivot, row): (&usize, &Vec<(usize, S)>)| {
            let (at, constant) = row.last()?;
            (*at == self.unknowns).then(|| (*pivot, -constant.clone()))
        };
        self.span.pivots().iter().zip(self.span.rows()).filter_map(value)
    }
}
