//! Requests of the page, as arguments of the command line.

use super::{Answer, Refusal};
use serde::Deserialize;

/// A request of the page.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// `reading` (of the field), `names` (for it) or `card`; or a report in a format: `compare`, `table`,
    /// `check`, `info`, `properties`, `equations`, `transport`, `motion`, `list`, `conventions` or `rep`.
    pub report: String,
    /// A SPACE; for representations a sum of simple algebras, such as `A2 + A1`.
    pub space: String,
    /// The text of the field of the page, instead of a SPACE: a name, or a definition in any
    /// notation.
    pub input: String,
    /// The tensor of a card: `brackets`, `connection`, or the name of a quantity.
    pub card: String,
    /// The indices of the components of a card, separated by commas; an empty one means every index.
    pub filter: String,
    /// The second SPACE, for a comparison.
    pub other: String,
    /// The text of a definition file, instead of a SPACE; JSON if it begins with a brace.
    pub definition: String,
    /// A connection; if empty, that of the space.
    pub connection: String,
    /// A metric; if empty, that of the space.
    pub metric: String,
    /// Values of parameters.
    pub set: String,
    /// The tensors of a table.
    pub show: String,
    /// `euler-poincare`, `autoparallel` or `transport`.
    pub motion: String,
    /// Points of the ball of rotation vectors, separated by semicolons.
    pub path: String,
    /// The vector that is transported, in the left-invariant frame.
    pub vector: String,
    /// The text of a problem of motion.
    pub problem: String,
    /// Methods to compare with that of the problem.
    pub methods: String,
    /// The highest weight of a representation, or its name.
    pub weight: String,
    /// Further factors of a product of representations, separated by semicolons.
    pub factors: String,
    /// The subalgebra to which a representation is restricted.
    pub subalgebra: String,
    /// The format, by default `html`; or `toml`, `command`, `python`.
    pub format: String,
}

impl Request {
    /// Answers the request with its report.
    ///
    /// # Errors
    /// Any error of the request.
    pub fn answer(&self) -> Result<Answer, Refusal> {
        match self.report.as_str() {
            #[cfg(feature = "tables")]
            "reading" | "names" | "card" => self.tables(),
            #[cfg(feature = "representations")]
            "rep" => self.representation(),
            #[cfg(feature = "reports")]
            _ => self.report(),
            #[cfg(not(feature = "reports"))]
            other => Err(Refusal::new(format!("this part of the engine has no report `{other}`"))),
        }
    }
}
