//! Membership test for groups that are given by a basis of their algebra.

use super::MatrixGroup;
use super::logarithm::logarithm;
use crate::Error;
use nalgebra::DMatrix;

/// The largest power of an element whose logarithm is tested. It covers the orders of the centres of small classical groups,
/// and of half and third turns.
const POWERS: usize = 12;

/// The relative rounding of the trace of a generator.
const ROUNDING: f64 = 1e-12;

impl MatrixGroup {
    /// Checks necessary conditions for an element whose entries have the relative error `tolerance`. It is invertible and has
    /// a positive determinant, 1 if all generators are traceless. `Ad_g` maps the algebra to itself. The principal logarithm of
    /// `g` or of a power of it lies in the algebra; in SU(n) that of `g` itself need not.
    ///
    /// The test cannot detect a factor of finite order that normalises the algebra, such as an element of another component
    /// of the pseudo-orthogonal matrices. If the group is not closed, elements far from 1 may be refused.
    ///
    /// # Errors
    /// [`Error::Invalid`] with what fails.
    pub fn expect_element(&self, g: &DMatrix<f64>, tolerance: f64) -> Result<(), Error> {
        let refused = |reason: String| Err(Error::Invalid { what: "element of the group", reason });
        let Some(inverse) = g.clone().try_inverse() else {
            return refused("it is singular".into());
        };
        let tolerance = tolerance * (1.0 + g.norm() * inverse.norm());
        let determinant = g.determinant();
        let special = self.matrices().iter().all(|b| b.trace().abs() <= ROUNDING * b.norm());
        let is_one = (determinant - 1.0).abs() <= tolerance;
        if (special && !is_one) || determinant <= 0.0 {
            return refused(format!("its determinant is {determinant}"));
        }
        for (at, b) in self.matrices().iter().enumerate() {
            let off = self.outside(&(g * b * &inverse));
            if off.is_nan() || off > tolerance * b.norm() {
                let vector = at + 1;
                return refused(format!(
                    "Ad takes basis vector {vector} out of the algebra by {off:e}"
                ));
            }
        }
        let (mut power, mut witness) = (g.clone(), None);
        for k in 1..=POWERS {
            if let Ok(log) = logarithm(&power) {
                let off = self.outside(&log);
                if off <= tolerance * k as f64 * (1.0 + log.norm()) {
                    return Ok(());
                }
                witness = witness.or(Some((k, off)));
            }
            power = &power * g;
        }
        match witness {
            Some((1, off)) => refused(format!("its logarithm leaves the algebra by {off:e}")),
            Some((k, off)) => {
                refused(format!("the logarithm of its power {k} leaves the algebra by {off:e}"))
            }
            // there is none to look at
            None => Ok(()),
        }
    }
}
