//! Conditions on the parameters under which a tensor vanishes, and under which a geometry has a
//! property, with all real solutions: [`Condition`], [`ConditionSolutions`].

mod condition;
mod solutions;

pub use condition::{Condition, ParametricGeometry};
pub use solutions::{ConditionSolutions, SolutionFamily, SolutionPoint};

use affinor_tensors::linear::Matrix;
use affinor_tensors::scalar::Variable;
use affinor_tensors::{Notation, Rational, Scalar, Tensor};
use std::collections::BTreeMap;

/// Polynomials in the parameters. All components of the tensor vanish exactly at the common zeros
/// of these polynomials.
///
/// The polynomials are a basis of the linear span of the numerators, reduced over their monomials.
/// For the nonmetricity of M(3), they state that `J` is a multiple of the identity. For a tensor of
/// numbers, the result is empty or contains only the constant 1.
pub fn conditions<S: Notation + Scalar>(tensor: &Tensor<S>) -> Vec<S> {
    let polynomials: Vec<_> = tensor.components().map(|(_, v)| v.numerator_terms()).collect();
    let key = |powers: &[(Variable, u32)]| -> Vec<(&str, u32)> {
        powers.iter().map(|(variable, power)| (variable.text(), *power)).collect()
    };
    let monomials: BTreeMap<_, _> =
        polynomials.iter().flatten().map(|(powers, _)| (key(powers), powers)).collect();
    let columns: BTreeMap<_, _> = monomials.keys().zip(0..).collect();
    let rows = polynomials.iter();
    let rows = rows.map(|terms| terms.iter().map(|(m, v)| (columns[&key(m)], v.clone())));
    let space = Matrix::from_rows(columns.len(), rows).ok().and_then(|m| m.echelon().ok());
    let monomials: Vec<S> = monomials
        .values()
        .map(|powers| {
            let factors = powers.iter().filter_map(|(variable, power)| {
                S::variable(*variable).map(|value| num_traits::pow(value, *power as usize))
            });
            factors.fold(S::one(), |product, factor| product * &factor)
        })
        .collect();
    let polynomial = |row: &[(usize, Rational)]| {
        row.iter().fold(S::zero(), |sum, (at, coefficient)| {
            let coefficient = S::from_rational(coefficient).unwrap_or_else(S::zero);
            sum + &(monomials[*at].clone() * &coefficient)
        })
    };
    space.iter().flat_map(|space| space.rows().iter().map(|row| polynomial(row))).collect()
}
