//! Representations of semisimple algebras: the third module of the page.

use super::{Answer, Refusal, Request};
use affinor::representation::HighestWeight;
use affinor_documents::input::InputError;
use affinor_documents::picture;
use affinor_documents::report::{Format, Operations, RepresentationReport};

impl Request {
    /// The representation, or its product and its restriction, with its weight diagram.
    pub(super) fn representation(&self) -> Result<Answer, Refusal> {
        let usage = |error: &dyn ToString| InputError::usage(error.to_string());
        let algebra = self.space.parse().map_err(|error| usage(&error))?;
        let given = |text: &str| Some(text.trim().to_string()).filter(|text| !text.is_empty());
        let operations = Operations {
            tensor: self.factors.split(';').filter_map(given).collect(),
            branch: given(&self.subalgebra),
            ..Operations::default()
        };
        let report = RepresentationReport::new(&algebra, &self.weight, &operations)?;
        let format = Format::from_name(&self.format).unwrap_or(Format::Html);
        let answer = Answer::new(&report, format, vec![])?;
        let weight = HighestWeight::parse(&algebra, &self.weight).map_err(|error| usage(&error))?;
        // errors of pictures are ignored, because the report is complete without them
        let drawn = picture::weights(&weight).ok().flatten();
        Ok(answer.with(drawn.into_iter().collect(), &[]))
    }
}
