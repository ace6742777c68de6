//! Finite-dimensional representations of complex reductive Lie algebras. In reading order:
//!
//! - [`ReductiveAlgebra`]: a sum of simple types and abelian factors; [`diagram`]: Dynkin diagrams;
//! - [`HighestWeight`]: an irreducible representation by its Dynkin labels, with its dimension, its
//!   dual, its indicator, its index and its Casimir eigenvalues; [`names`]: `10` and `5bar`;
//! - [`Character`]: the dominant weights of a representation with their multiplicities;
//! - [`Decomposition`]: multiplicities of irreducible representations; `products`, `powers`: tensor
//!   products, symmetric and exterior powers, Schur functors;
//! - [`Subalgebra`]: branching rules, by a projection of weights, by simple roots, by a
//!   representation or by vectors;
//! - [`MatrixRepresentation`]: the matrices of an irreducible representation, with invariant forms;
//! - [`Coupling`], [`clebsch_gordan`], [`wigner_3j`], [`wigner_6j`], [`real_coupling`]: coupling of spins.
//!
//! Weights are lists of integers: the Dynkin labels `<λ, α_i^∨>` of each simple factor, whose
//! simple roots are numbered as in Bourbaki, then one charge for each abelian factor.
//!
//! ```
//! use affinor::representation::{HighestWeight, ReductiveAlgebra};
//! let su5: ReductiveAlgebra = "SU(5)".parse()?;
//! let ten = HighestWeight::parse(&su5, "10")?;
//! assert_eq!(ten.labels(), [0, 1, 0, 0]);
//! let product = ten.tensor(&HighestWeight::parse(&su5, "5bar")?)?;
//! assert_eq!(product.to_string(), "5 + 45");
//! # Ok::<(), affinor::representation::RepresentationError>(())
//! ```

mod algebra;
mod casimirs;
mod character;
mod class;
mod clebsch_gordan;
mod decomposition;
pub mod diagram;
mod embeddings;
mod error;
mod exceptional;
mod highest_weight;
mod levi;
mod matrices;
mod named;
pub mod names;
mod packed;
mod powers;
mod products;
mod regular;
mod spanned;
mod subalgebra;
mod weyl;

pub use algebra::ReductiveAlgebra;
pub use casimirs::CasimirElement;
pub use character::Character;
pub use class::Indicator;
pub use clebsch_gordan::{
    Coupling, MAX_SPIN, SignedRoot, Spin, clebsch_gordan, real_coupling, wigner_3j, wigner_6j,
};
pub use decomposition::Decomposition;
pub use error::RepresentationError;
pub use highest_weight::{HighestWeight, MAX_LABEL};
pub use matrices::{MAX_MATRIX_DIMENSION, MatrixRepresentation, Monomial};
pub use subalgebra::Subalgebra;
