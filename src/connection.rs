//! Connections: affinities over a frame.

mod canonical;
mod contorsion;
mod disformation;
mod invariant;
mod koszul;
mod levi_civita;
mod right_frame;

pub use canonical::Canonical;
pub use contorsion::contorsion;
pub use disformation::disformation;

use crate::Error;
use crate::algebra::{LETTERS, indices};
use crate::frame::{Frame, expect_numbers, expect_slots};
use crate::lie_derivative::derivation;
use affinor_tensors::{Down, Ring, Tensor, Up};

/// A connection by its affinities in a frame: `nabla_{e_j} e_k = Lambda^i_jk e_i` (B1).
///
/// The first lower index is the direction, the second the differentiated vector. Torsion and
/// curvature are in [`curvature`](crate::curvature), what needs a metric in
/// [`metric`](crate::metric).
#[derive(Clone, Debug)]
pub struct Connection<S> {
    frame: Frame<S>,
    gamma: Tensor<S>,
}

impl<S: Ring> Connection<S> {
    /// The connection with the affinities `Lambda^i_jk`, slots `[Up, Down, Down]`; any numbers.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`].
    pub fn new(frame: Frame<S>, gamma: Tensor<S>) -> Result<Self, Error> {
        expect_slots("the affinities", &gamma, frame.dimension(), &[Up, Down, Down])?;
        expect_numbers("the affinities", &gamma)?;
        Ok(Connection { frame, gamma })
    }

    /// The frame of the affinities.
    pub fn frame(&self) -> &Frame<S> {
        &self.frame
    }

    /// The affinities `Lambda^i_jk`.
    pub fn gamma(&self) -> &Tensor<S> {
        &self.gamma
    }

    /// The covariant derivative of a tensor of any type,
    /// `(nabla_m T)^i_j = e_m(T^i_j) + Lambda^i_mp T^p_j - Lambda^p_mj T^i_p`; the direction `m`
    /// is the first lower index of the result. Over the frame of a homogeneous space, of invariant
    /// tensors.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; when the result is beyond the engine.
    pub fn nabla(&self, tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
        let derivative = self.frame.derivative(tensor)?;
        let letters = &LETTERS[..tensor.rank()];
        let sum = format!("d_m{}{}", indices(letters, tensor), derivation("m", tensor));
        let at = tensor.slots().iter().position(|slot| *slot == Down).unwrap_or(tensor.rank());
        let before = indices(&letters[..at], tensor);
        // nabla keeps the symmetries of the tensor; an antisymmetric last pair is computed once
        let pair = tensor.rank().checked_sub(2).filter(|&pair| {
            pair >= at
                && tensor.slots()[pair..] == [Down, Down]
                && tensor.pair_symmetry(pair, pair + 1) == Some(-1)
        });
        let mut behind = String::new();
        for (position, (letter, slot)) in letters.chars().zip(tensor.slots()).enumerate().skip(at) {
            let opens = Some(position) == pair;
            match (opens, pair.is_some_and(|pair| position == pair + 1)) {
                (true, _) => behind += &format!("_[{letter}"),
                (_, true) => behind += &format!("{letter}]"),
                _ => behind += &format!("{}{letter}", if *slot == Up { "^" } else { "_" }),
            }
        }
        let operands = [("d", &derivative), ("L", &self.gamma), ("T", tensor)];
        Ok(affinor_tensors::contract(&format!("{sum} -> {before}_m{behind}"), &operands)?)
    }
}
