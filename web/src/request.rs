//! Requests of the page, as arguments of the command line.

use super::{Answer, Refusal, reading};
use affinor::CanonicalConnection;
use affinor_documents::report::{CardKind, Computation, Quantity};
use affinor_documents::space::{self, Space};
use serde::Deserialize;
use serde_json::json;

/// A request of the page.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// `reading` (of the field), `names` (for it) or `card`; or a report in a format: `compare`, `table`,
    /// `check`, `info`, `properties`, `equations`, `transport`, `motion`, `list` or `conventions`.
    pub report: String,
    /// A SPACE.
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
            "reading" => reading::reading(&self.input, &self.open()?),
            "names" => reading::names(),
            "card" => self.card(),
            _ => self.report(),
        }
    }

    /// The other reports are not in the first module of the page.
    #[cfg(not(feature = "reports"))]
    fn report(&self) -> Result<Answer, Refusal> {
        Err(Refusal::new("this part of the engine has no reports"))
    }

    /// A tensor of the space, for a card.
    fn card(&self) -> Result<Answer, Refusal> {
        let kind = match self.card.as_str() {
            "brackets" => CardKind::Brackets,
            "connection" => CardKind::Tensor(Quantity::Affinities),
            name => CardKind::Tensor(
                Quantity::from_key(name)
                    .ok_or_else(|| Refusal::new(format!("there is no card “{name}”")))?,
            ),
        };
        let card = computation(&self.open()?).card(kind, &self.filter)?;
        reading::written(&match card {
            None => json!({ "absent": true }),
            Some(card) => json!({
                "title": card.title,
                "html": card.html,
                "definition": card.definition,
                "letters": card.letters,
                "count": card.count,
                "summarized": card.summarized,
            }),
        })
    }

    /// The space with its connection and metric.
    pub(super) fn open(&self) -> Result<Space, Refusal> {
        let given =
            |text: &str| Some(text.trim()).filter(|text| !text.is_empty()).map(String::from);
        let name = if self.definition.trim_start().starts_with('{') {
            "definition.json"
        } else {
            "definition.toml"
        };
        let request = space::Request {
            space: if self.definition.is_empty() { given(&self.space) } else { None },
            typed: given(&self.input),
            definition: given(&self.definition).map(|text| (name.into(), text)),
            connection: given(&self.connection),
            metric: given(&self.metric),
            set: given(&self.set),
            ..space::Request::default()
        };
        let mut space = Space::open(&request)?;
        let needs_plus =
            self.report == "equations" && ["", "euler-poincare"].contains(&&*self.motion);
        if needs_plus && space.definition.connection_is_default() {
            space.definition.set_canonical(CanonicalConnection::Plus);
        }
        Ok(space)
    }
}

/// An exact computation whose stages the page shows.
pub(super) fn computation(space: &Space) -> Computation<'_> {
    Computation { stage: &crate::stage, ..Computation::of(space) }
}
