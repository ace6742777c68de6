//! Converts errors to the exceptions of `affinor.errors`, with their witnesses as data.

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

/// The exception for a limit that was exceeded during a stage: the limit on the memory if `memory` is set, otherwise on
/// the time.
pub fn limit(py: Python<'_>, message: &str, memory: bool, stage: &str) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let data = PyDict::new(py);
        let argument = if memory { "memory" } else { "timeout" };
        let help = format!("raise {argument}= in affinor.limits to allow more");
        data.set_item("limit", argument)?;
        data.set_item("stage", Some(stage).filter(|stage| !stage.is_empty()))?;
        let class = py.import("affinor.errors")?.getattr("LimitError")?;
        Ok(PyErr::from_value(class.call1((message, help, None::<&str>, data))?))
    };
    made().unwrap_or_else(|failed| failed)
}

/// Whether an exception belongs to this class of `affinor.errors`.
pub fn is_a(py: Python<'_>, error: &PyErr, class: &str) -> bool {
    let class = py.import("affinor.errors").and_then(|errors| errors.getattr(class));
    class.is_ok_and(|class| error.matches(py, class).unwrap_or(false))
}

/// The exception for a wrong value or a wrong shape. The message has the expected and the actual value.
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

/// The witness of an error: names and values, with the keys that the exception class documents.
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
        Error::Integration { t, .. } | Error::CurveEnds { parameter: t, .. } => {
            data.set_item("time", t)?
        }
        _ => {}
    }
    Ok(data)
}

/// Rewrites a message in terms of Python: options become arguments (`--max-step` becomes `max_step`), and commands
/// become functions.
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
    let words = (words + rest).replace("`affinor list`", "`affinor.catalogue()`");
    let words = words
        .replace("expected a table, or a list of tables", "expected a dict, or a list of dicts");
    tables_as_keys(&words)
}

/// Rewrites tables of a TOML file as keys of Python. ``a table [events]`` becomes ``a dict `events` ``, and ``one table
/// [[inertia]]`` becomes ``one dict in the list `inertia` ``.
fn tables_as_keys(text: &str) -> String {
    let mut words = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('[') {
        let (before, from) = rest.split_at(at);
        let open = from.len() - from.trim_start_matches('[').len();
        let inner = &from[open..];
        let end = |c: char| !(c.is_ascii_lowercase() || c == '.' || c == '_');
        let name = &inner[..inner.find(end).unwrap_or(inner.len())];
        let close = "]".repeat(open);
        let is_table = name.len() > 3 && open <= 2 && inner[name.len()..].starts_with(&close);
        let begins = before.chars().last().is_none_or(|c| c.is_whitespace() || "`\"(".contains(c));
        if !(is_table && begins) {
            words += before;
            words += &from[..open];
            rest = inner;
            continue;
        }
        match before.strip_suffix(" table ") {
            Some(start) if open == 2 => words += &format!("{start} dict in the list "),
            Some(start) => words += &format!("{start} dict "),
            None => words += before,
        }
        words += &format!("`{name}`");
        rest = &inner[name.len() + open..];
    }
    words + rest
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
            ("on so(3) also [inertia]", "on so(3) also `inertia`"),
            ("in a table [events], by", "in a dict `events`, by"),
            (
                "one table [[initial.parts]] for each",
                "one dict in the list `initial.parts` for each",
            ),
            (
                "[x, y] = z, [1, 2], [[1, 0]], c[omega], a [",
                "[x, y] = z, [1, 2], [[1, 0]], c[omega], a [",
            ),
        ] {
            assert_eq!(in_words_of_python(text), words);
        }
    }
}
