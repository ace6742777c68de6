//! The first module of the page: readings of inputs, and cards of tensors.

use super::{Answer, Refusal, Request, reading};
use affinor::CanonicalConnection;
use affinor_documents::report::{CardKind, Computation, Quantity};
use affinor_documents::space::{self, Space};
use serde_json::json;

impl Request {
    /// A reading, the names for completion, or a card.
    pub(super) fn tables(&self) -> Result<Answer, Refusal> {
        match self.report.as_str() {
            "reading" => reading::reading(&self.input, &self.open()?),
            "names" => reading::names(),
            _ => self.card(),
        }
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
