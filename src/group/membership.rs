//! Whether a matrix is an element of a group that is given by its algebra alone.

use super::MatrixGroup;
use super::logarithm::logarithm;
use crate::Error;
use nalgebra::DMatrix;

/// Powers of an element whose logarithms are looked at. The centres of the classical groups up to this size, and rotations by
/// half and third turns, are of such an order.
const POWERS: usize = 12;

/// A trace of a generator that is zero but for rounding, relatively.
const ROUNDING: f64 = 1e-12;

impl MatrixGroup {
    /// Checks what an element, whose entries are known to a relative `tolerance`, has to be: invertible, with a positive
    /// determinant, which is 1 where no generator has a trace; `Ad_g` takes the algebra to itself; and the principal logarithm
    /// of `g` lies in the algebra, or that of a power of it: in SU(n) the logarithm itself need not.
    ///
    /// A factor that has a finite order and keeps the algebra is not seen, as of another component of the pseudo-orthogonal
    /// matrices. Of a group that is not closed among the matrices, elements far from 1 may be refused.
    ///
    /// # Errors
    /// [`Error::NotInGroup`] with what fails.
    pub fn expect_element(&self, g: &DMatrix<f64>, tolerance: f64) -> Result<(), Error> {
        let refused = |reason: String| Err(Error::NotInGroup { reason });
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
