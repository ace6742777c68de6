//! Converts reports to text.

use affinor_documents::input::InputError;
use affinor_documents::report::{Format, Report};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The format with this name.
pub fn format(name: &str) -> PyResult<Format> {
    Format::from_name(name).ok_or_else(|| {
        let names: Vec<&str> = Format::ALL.iter().map(|format| format.name()).collect();
        PyValueError::new_err(format!("the formats are {}, not {name:?}", names.join(", ")))
    })
}

/// Writes a report as text in a format.
pub fn written(report: &(impl Report + ?Sized), format: Format) -> Result<String, InputError> {
    let mut bytes = Vec::new();
    report.write(format, &mut bytes).map_err(|error| InputError::usage(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A report as JSON, as text and as Markdown.
pub type Written = (String, String, String);

/// Writes a report in the formats that `Report` in Python needs.
pub fn all_formats(report: &impl Report) -> Result<Written, InputError> {
    let [json, text, markdown] =
        [Format::Json, Format::Text, Format::Markdown].map(|format| written(report, format));
    Ok((json?, text?, markdown?))
}
