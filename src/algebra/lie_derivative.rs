//! Derivations of tensors, Lie derivatives and brackets of vector fields.

use crate::Error;
use crate::algebra::frame::{Frame, expect_slots, formula};
use crate::algebra::{LETTERS, indices};
use affinor_tensors::{Down, Scalar, Tensor, Up, Variance, contract};

/// The derivation `e_k -> L^i_{direction}k e_i` of `T`, as a formula for contractions. The formula
/// has a term `+ L^a_p T^p...` for each upper slot, and a term `- L^p_a T_p...` for each lower
/// slot.
pub(crate) fn derivation<S: Scalar>(direction: &str, tensor: &Tensor<S>) -> String {
    let letters = &LETTERS[..tensor.rank()];
    let slots = letters.chars().zip(tensor.slots());
    let term = |(letter, slot): (char, &Variance)| {
        let summed = indices(&letters.replace(letter, "p"), tensor);
        match slot {
            Up => format!(" + L^{letter}_{direction}p T{summed}"),
            Down => format!(" - L^p_{direction}{letter} T{summed}"),
        }
    };
    slots.map(term).collect()
}

/// The action of an endomorphism `A^i_j` on a tensor of any type. The action is a derivation; for
/// slots `^i_j`, it is `(A T)^i_j = A^i_p T^p_j - A^p_j T^i_p`.
///
/// # Errors
/// [`Error::Shape`] unless `A` has the slots `^i_j` in the dimension of the tensor.
pub fn act<S: Scalar>(endomorphism: &Tensor<S>, tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
    expect_slots("the endomorphism", endomorphism, tensor.dimension(), &[Up, Down])?;
    if tensor.rank() == 0 {
        return Ok(Tensor::zero(tensor.dimension(), &[])?);
    }
    let result = indices(&LETTERS[..tensor.rank()], tensor);
    let sum = derivation("", tensor);
    Ok(contract(&format!("{sum} -> {result}"), &[("L", endomorphism), ("T", tensor)])?)
}

impl<S: Scalar> Frame<S> {
    /// The bracket of two fields `X` and `Y`, from their components in this frame:
    /// `[X, Y]^i = X^j e_j(Y^i) - Y^j e_j(X^i) + c^i_jk X^j Y^k` (equations (32), (A6)).
    ///
    /// # Errors
    /// [`Error::Shape`] unless both fields have as many components as the frame.
    pub fn bracket(&self, x: &[S], y: &[S]) -> Result<Vec<S>, Error> {
        let field =
            |v: &[S]| Tensor::vector(v, Up).with_tolerance(self.structure_functions().tolerance());
        let bracket = self.lie_derivative(&field(x), &field(y))?;
        Ok(bracket.to_vector().expect("a tensor of rank 1"))
    }

    /// The Lie derivative of a tensor of any type along the field `X^i`:
    ///
    /// ```text
    /// (L_X T)^i_j = X^m e_m(T^i_j) + A^i_p T^p_j - A^p_j T^i_p,    A^i_j = X^m c^i_mj - e_j(X^i)
    /// ```
    ///
    /// With this definition `L_X Y = [X, Y]`, equation (A7). In the left-invariant frame of an
    /// algebra, `A = ad_X` if the components are constant.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Tensor`] if the derivative is too large for the indices of a
    /// tensor, 64 bits.
    pub fn lie_derivative(
        &self,
        field: &Tensor<S>,
        tensor: &Tensor<S>,
    ) -> Result<Tensor<S>, Error> {
        expect_slots("the field", field, self.dimension(), &[Up])?;
        let d = self.derivative(field)?;
        let operands = [("c", self.structure_functions()), ("X", field), ("d", &d)];
        let endomorphism = formula("X^m c^i_mj - d_j^i -> ^i_j", &operands);
        let acted = act(&endomorphism, tensor)?;
        let result = indices(&LETTERS[..tensor.rank()], tensor);
        let text = format!("X^m d_m{result} + A{result} -> {result}");
        let derivative = self.derivative(tensor)?;
        Ok(contract(&text, &[("X", field), ("d", &derivative), ("A", &acted)])?)
    }
}
