//! Planes of tangent vectors, given in the basis of a definition.

use crate::Coefficient;
use crate::input::{InputError, Source, shown};
use crate::space::{Definition, notation::Names};
use std::collections::{BTreeMap, BTreeSet};

impl Definition {
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
