//! Errors as exceptions of `affinor.errors`, with their witnesses as data.

use affinor::Error;
use affinor_documents::input::{InputError, Refusal};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// The exception for an error.
pub fn raise(py: Python<'_>, error: &InputError) -> PyErr {
    exception(py, error).unwrap_or_else(|failed| failed)
}

/// The exception for any error that converts to an input error.
pub fn refused(py: Python<'_>, error: impl Into<InputError>) -> PyErr {
    raise(py, &error.into())
}

/// The exception for a panic.
pub fn internal(py: Python<'_>, text: &str) -> PyErr {
    let made = py.import("affinor.errors").and_then(|errors| errors.getattr("InternalError"));
    made.and_then(|class| class.call1((text,))).map_or_else(|failed| failed, PyErr::from_value)
}

/// The exception for a limit on the time or on the memory that was exceeded during a stage.
pub fn limit(py: Python<'_>, message: &str, memory: bool, stage: &str) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let data = PyDict::new(py);
        data.set_item("limit", if memory { "memory" } else { "timeout" })?;
        data.set_item("stage", Some(stage).filter(|stage| !stage.is_empty()))?;
        let class = py.import("affinor.errors")?.getattr("LimitError")?;
        Ok(PyErr::from_value(class.call1((message, None::<&str>, None::<&str>, data))?))
    };
    made().unwrap_or_else(|failed| failed)
}

/// Whether an exception is of this class of `affinor.errors`.
pub fn is_a(py: Python<'_>, error: &PyErr, class: &str) -> bool {
    let class = py.import("affinor.errors").and_then(|errors| errors.getattr(class));
    class.is_ok_and(|class| error.matches(py, class).unwrap_or(false))
}

/// The exception for a wrong value or a wrong shape, with the expected and the actual one.
pub fn wrong(what: &str, expected: &str, found: &str) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(format!("{what} should be {expected}, not {found}"))
}

fn exception(py: Python<'_>, error: &InputError) -> PyResult<PyErr> {
    let (class, data) = match error.cause.as_deref() {
        Some(cause) => (cause.class(), witness(py, cause)?),
        None if error.refusal == Refusal::Mathematics => ("MathematicsError", PyDict::new(py)),
        None => ("InputError", PyDict::new(py)),
    };
    let place = match &error.at {
        None => None,
        Some(place) => {
            let found = PyDict::new(py);
            found.set_item("source", in_words_of_python(&place.source.name))?;
            if let Some(span) =
                place.span.clone().filter(|span| place.source.text.get(span.clone()).is_some())
            {
                let before = &place.source.text[..span.start];
                let start = before.rfind('\n').map_or(0, |at| at + 1);
                found.set_item("line", before.matches('\n').count() + 1)?;
                found.set_item("column", before[start..].chars().count() + 1)?;
                found.set_item("text", &place.source.text[span])?;
            }
            Some(found)
        }
    };
    let help = error.help.as_deref().map(in_words_of_python);
    let arguments = (class, in_words_of_python(&error.message), help, place, data);
    let made = py.import("affinor.errors")?.getattr("_of_engine")?.call1(arguments)?;
    Ok(PyErr::from_value(made))
}

/// The witness of an error: names and values under the keys that the exceptions document.
fn witness<'py>(py: Python<'py>, error: &Error) -> PyResult<Bound<'py, PyDict>> {
    let data = PyDict::new(py);
    match error {
        Error::Broken { law, at, residual } => {
            let mut rest = at.as_slice();
            for (part, names) in law.parts() {
                let (entries, after) = rest.split_at(names.len().min(rest.len()));
                rest = after;
                match entries {
                    [entry] => data.set_item(part, entry)?,
                    several => data.set_item(part, PyTuple::new(py, several)?)?,
                }
            }
            data.set_item("residual", residual)?;
        }
        Error::Symmetry { at, residual, .. } => {
            data.set_item("at", at)?;
            data.set_item("residual", residual)?;
        }
        Error::Degenerate { null, components } => {
            data.set_item("null", null)?;
            data.set_item("components", components.clone())?;
        }
        Error::Integration { t, .. } => data.set_item("time", t)?,
        _ => {}
    }
    Ok(data)
}

/// Translates options of the command line to Python arguments (`--max-step` to `max_step`), and
/// commands to functions.
fn in_words_of_python(text: &str) -> String {
    let mut words = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("--") {
        let (before, option) = rest.split_at(at);
        let end = |c: char| !(c.is_ascii_lowercase() || c == '-');
        let name = &option[2..];
        let name = &name[..name.find(end).unwrap_or(name.len())];
        let begins = before.chars().last().is_none_or(|c| c.is_whitespace() || "`\"(".contains(c));
        words += before;
        if begins && name.starts_with(|c: char| c.is_ascii_lowercase()) {
            words += &name.replace('-', "_");
        } else {
            words += &option[..2 + name.len()];
        }
        rest = &option[2 + name.len()..];
    }
    (words + rest).replace("`affinor list`", "`affinor.catalogue()`")
}

#[cfg(test)]
mod tests {
    use super::in_words_of_python;

    #[test]
    fn options_are_arguments() {
        for (text, words) in [
            ("--metric", "metric"),
            ("give --max-step, or `--basis \"x y\"`", "give max_step, or `basis \"x y\"`"),
            ("a--b -- c ---", "a--b -- c ---"),
            ("`affinor list` shows the names", "`affinor.catalogue()` shows the names"),
        ] {
            assert_eq!(in_words_of_python(text), words);
        }
    }
}
