//! Lists of vectors in a basis, and planes of tangent vectors in the basis of a definition.

use crate::Coefficient;
use crate::input::{InputError, Source, shown};
use crate::space::{
    Definition,
    notation::{Names, split},
};
use affinor_tensors::linear::Row;
use affinor_tensors::{Rational, Ring, Symbolic, Tensor};
use std::collections::{BTreeMap, BTreeSet};

/// Parses rational combinations of basis vectors, separated by commas, as in `e1 - f1, 2 e2`.
///
/// # Errors
/// An error for a text that is not a combination of the basis vectors with rational factors.
///
/// ```
/// use affinor::Rational;
/// let labels = ["x", "y"].map(String::from);
/// let vectors = affinor_documents::space::vectors(&labels, "x - y, 2*y")?;
/// assert_eq!(vectors[1], [(1, Rational::from(2))]);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
pub fn vectors(labels: &[String], text: &str) -> Result<Vec<Row<Rational>>, InputError> {
    let labels: BTreeMap<String, usize> = labels.iter().cloned().zip(0..).collect();
    let parameters = BTreeSet::new();
    let names =
        Names { labels: &labels, parameters: Some(&parameters), functions: None, bare: false };
    let vector = |text: &str| {
        let terms = names.vector(text, &Source::new("the vectors", text));
        let terms = terms.map_err(|error| error.help(names.basis()))?;
        let entry = |(at, value)| Ok((at, Rational::read(&value)?));
        let terms = terms.into_iter().filter(|(_, value)| !value.vanishes());
        terms.map(entry).collect::<Result<Row<Rational>, InputError>>()
    };
    text.split(',').map(vector).collect()
}

impl Definition {
    /// Parses vectors whose components are functions of the coordinates: combinations of the basis,
    /// separated by commas. The option `origin` contains the text.
    ///
    /// # Errors
    /// An error with its location if an expression cannot be parsed.
    pub(crate) fn vector_list(
        &self,
        origin: &str,
        text: &str,
    ) -> Result<Vec<Tensor<Symbolic>>, InputError> {
        let formulas = self.formulas(&[]);
        let parts = split(text).into_iter();
        parts.map(|part| formulas.field(&Source::new(origin, part))).collect()
    }

    /// Parses the two vectors that span a plane: combinations of the basis, separated by a comma,
    /// as in `x1, y1 + 2*z`.
    ///
    /// # Errors
    /// An error if there are not exactly two vectors, or if an expression cannot be parsed.
    pub fn plane<S: Coefficient>(&self, text: &str) -> Result<[Vec<S>; 2], InputError> {
        let labels: BTreeMap<String, usize> = self.labels.iter().cloned().zip(0..).collect();
        let parameters: BTreeSet<String> = self.parameters().into_iter().collect();
        let names =
            Names { labels: &labels, parameters: Some(&parameters), functions: None, bare: false };
        let vector = |text: &str| {
            let mut vector = vec![S::zero(); self.dimension()];
            let terms = names.vector(text, &Source::new("--plane", text));
            // suggests the basis vectors, because an unknown name is probably a misspelled basis
            // vector
            for (at, value) in terms.map_err(|error| error.help(names.basis()))? {
                vector[at] = S::read(&value)?;
            }
            Ok(vector)
        };
        let vectors = text.split(',').map(vector).collect::<Result<Vec<_>, InputError>>()?;
        let count = vectors.len();
        <[Vec<S>; 2]>::try_from(vectors).map_err(|_| {
            InputError::usage(format!("the plane `{}` has {count} vectors, not 2", shown(text)))
                .help("write two combinations of the basis with a comma between them")
        })
    }
}
