//! Checks whether a frame consists of the left-invariant fields of a group.

use super::{Coordinates, LieGroup};
use crate::{Error, Frame};
use affinor_tensors::stop::checkpoint;

/// The tolerance of structure constants, relative to the largest constant. A change of units causes
/// rounding errors of this size.
const ROUNDING: f64 = 1e-12;

/// Checks that a frame has the structure constants of the group in the basis of the group, and that
/// it has no derivations.
pub(crate) fn expect_left_frame<G: LieGroup>(group: &G, frame: &Frame<f64>) -> Result<(), Error> {
    let differs = |found: String| Error::Shape {
        what: "the connection",
        expected: "the left-invariant frame of the group".into(),
        found,
    };
    if frame.dimension() != group.dimension() || !frame.is_invariant() {
        return Err(differs(format!("a frame of {} fields", frame.dimension())));
    }
    let largest =
        frame.structure_functions().components().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
    let basis = group.basis();
    for (j, x) in basis.iter().enumerate() {
        for (k, y) in basis.iter().enumerate() {
            checkpoint();
            let bracket = group.bracket(x, y);
            for (i, of_group) in bracket.components().iter().enumerate() {
                let of_frame = frame.structure_functions().get(&[i, j, k]);
                if (of_group - of_frame).abs() > ROUNDING * largest.max(of_group.abs()) {
                    let at = format!("c^{}_{},{}", i + 1, j + 1, k + 1);
                    return Err(differs(format!("{at} = {of_frame} and not {of_group}")));
                }
            }
        }
    }
    Ok(())
}
