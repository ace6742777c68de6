//! Brackets of fields and Lie derivatives of tensors, in any frame.

use super::{Frame, expect_slots, formula};
use crate::Error;
use affinor_tensors::{Down, Ring, Tensor, Up, contract, contraction};

impl<S: Ring> Frame<S> {
    /// The bracket of two fields, given like the result by components in this frame:
    /// `[X, Y]^i = X^j e_j(Y^i) - Y^j e_j(X^i) + c^i_jk X^j Y^k` (32), (A6).
    ///
    /// ```
    /// use affinor::Frame;
    /// use affinor_tensors::{Ring, Symbolic};
    /// let plane = Frame::coordinates(&["x", "y"])?;
    /// let [x, y, zero] = [Symbolic::parameter("x"), Symbolic::parameter("y"), Symbolic::from_i64(0)];
    /// let rotation = [-y, x.clone()];
    /// let shift = [Symbolic::from_i64(1), zero.clone()];
    /// assert_eq!(plane.bracket(&shift, &rotation)?, [zero, Symbolic::from_i64(1)]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless both have as many components as the frame.
    pub fn bracket(&self, x: &[S], y: &[S]) -> Result<Vec<S>, Error> {
        let y = Tensor::vector(y, Up).with_tolerance(self.structure().tolerance());
        expect_slots("the field", &y, self.dimension(), &[Up])?;
        Ok(self.lie_derivative(x, &y)?.to_vector().expect("a tensor of rank 1"))
    }

    /// The Lie derivative of a tensor of any type along a field,
    /// `(L_X T)^i_j = X^m e_m(T^i_j) - A^i_p T^p_j + A^p_j T^i_p`, where
    /// `A^i_j = e_j(X^i) + c^i_jk X^k`, that is `[X, e_j] = -A^i_j e_i`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; when a derivative is beyond the engine.
    pub fn lie_derivative(&self, x: &[S], tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
        let x = Tensor::vector(x, Up).with_tolerance(self.structure().tolerance());
        expect_slots("the field", &x, self.dimension(), &[Up])?;
        let (dx, derivative) = (self.derivative(&x)?, self.derivative(tensor)?);
        let operands = [("d", &dx), ("c", self.structure()), ("X", &x)];
        let a = formula("d_j^i + c^i_jk X^k -> ^i_j", &operands);
        let letters = &"abcdefg"[..tensor.rank()];
        let indices = |letters: &str| {
            contraction::indices(letters.chars().zip(tensor.slots().iter().copied()))
        };
        let mut sum = format!("X^m d_m{}", indices(letters));
        for (letter, slot) in letters.chars().zip(tensor.slots()) {
            let summed = indices(&letters.replace(letter, "p"));
            sum += &match slot {
                Up => format!(" - A^{letter}_p T{summed}"),
                Down => format!(" + A^p_{letter} T{summed}"),
            };
        }
        let operands = [("X", &x), ("d", &derivative), ("A", &a), ("T", tensor)];
        Ok(contract(&format!("{sum} -> {}", indices(letters)), &operands)?)
    }
}
