//! The layout of values in tables: names for common factors, and fingerprints of equal values.

use super::{CommonFactors, Notation};
use std::hash::{DefaultHasher, Hash, Hasher};

/// A scalar with a layout for tables. The layout consists of names for common factors of the
/// values, and of fingerprints of equal values.
pub trait Tabular: Notation {
    /// Sums that occur so often in the denominators of these values that names make the table
    /// shorter. The parameter `taken` contains names that are in use. The result is empty for
    /// scalars without parameters.
    fn common_factors(values: &mut dyn Iterator<Item = &Self>, taken: &[String]) -> CommonFactors {
        let _ = (values, taken);
        CommonFactors::default()
    }

    /// The plain text of the value, with the names of these factors.
    fn text_with(&self, factors: &CommonFactors) -> String {
        let _ = factors;
        self.to_string()
    }

    /// Whether the text with the names of these factors begins with a minus sign.
    fn is_negative_with(&self, factors: &CommonFactors) -> bool {
        self.text_with(factors).starts_with('-')
    }

    /// A hash of the value. Equal values have equal hashes, and different values seldom have equal
    /// hashes.
    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.to_string().hash(&mut hasher);
        hasher.finish()
    }

    /// The LaTeX form of the value, with the names of these factors.
    fn latex_with(&self, factors: &CommonFactors) -> String {
        let _ = factors;
        self.latex()
    }
}
