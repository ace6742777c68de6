//! The coefficients of cohomology, as text.

use crate::input::{InputError, Source};
use crate::space::tables::matrices::square_matrices;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Rational, Ring};
use std::str::FromStr;

/// The coefficients of cohomology: a module of the algebra.
///
/// ```
/// use affinor_documents::report::Coefficients;
/// assert_eq!("adjoint".parse::<Coefficients>()?, Coefficients::Adjoint);
/// assert!("[[0,1],[0,0]]".parse::<Coefficients>().is_ok());
/// assert!("[[0,1]]".parse::<Coefficients>().is_err());
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Coefficients {
    /// The numbers, on which the algebra acts by zero.
    #[default]
    Trivial,
    /// The algebra, on which it acts by `ad`.
    Adjoint,
    /// The dual of the algebra.
    Coadjoint,
    /// A module by the matrices of the basis vectors, with rational entries.
    Matrices(Vec<Matrix<Rational>>),
}

impl FromStr for Coefficients {
    type Err = InputError;

    /// Reads `trivial`, `adjoint`, `coadjoint`, or matrices in one of the forms of an algebra by
    /// matrices, such as `[[0,1],[0,0]], [[1,0],[0,-1]]`.
    fn from_str(text: &str) -> Result<Self, InputError> {
        match text.trim() {
            "trivial" => Ok(Coefficients::Trivial),
            "adjoint" => Ok(Coefficients::Adjoint),
            "coadjoint" => Ok(Coefficients::Coadjoint),
            matrices if matrices.starts_with(['[', '(', '{']) => {
                let (size, all) = square_matrices(&Source::new("the coefficients", matrices))?;
                let matrices = all.into_iter().map(|entries| {
                    let mut rows = vec![vec![]; size];
                    for (i, j, value) in entries {
                        let number = value.re.as_constant().filter(|_| value.im.vanishes())?;
                        rows[i].push((j, number.clone()));
                    }
                    Matrix::from_rows(size, rows).ok()
                });
                let matrices = matrices.collect::<Option<Vec<_>>>().ok_or_else(|| {
                    InputError::usage(
                        "a matrix of the coefficients has an entry that is not rational",
                    )
                })?;
                Ok(Coefficients::Matrices(matrices))
            }
            other => {
                let message = format!("unknown coefficients `{}`", other.escape_debug());
                let help = "write trivial, adjoint, coadjoint, or a matrix for each basis vector";
                Err(InputError::usage(message).help(help))
            }
        }
    }
}
