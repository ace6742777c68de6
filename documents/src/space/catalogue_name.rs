//! Names of catalogue algebras, and the advice for names that are none.

use super::{Definition, charts, spelling};
use crate::input::{InputError, Source, shown};
use affinor::algebra::catalogue::CatalogueError;
use affinor::geometry::homogeneous::{fault, has_form, nearest};

/// The exceptional algebra of a real form that is written with its index, such as `E6(-14)`.
fn with_index(name: &str) -> Option<String> {
    let (algebra, index) = name.strip_suffix(')')?.split_once('(')?;
    index.parse::<i32>().ok()?;
    let exceptional = ["E6", "E7", "E8", "F4", "G2"];
    exceptional.into_iter().find(|own| own.eq_ignore_ascii_case(algebra)).map(Into::into)
}

/// The catalogue entry with the name `part`, which is a piece of `source`.
pub(super) fn entry(part: &str, source: &Source) -> Result<Definition, InputError> {
    const NAMES: &str =
        "`affinor list` shows the names; a file has an ending, such as .toml or .csv";
    let name = part.trim();
    if name.is_empty() {
        let error = InputError::usage("the name of an algebra is missing here");
        return Err(error.at(&source.whole(part)).help(NAMES));
    }
    if has_form(name) {
        let message = format!("{name} is a homogeneous space, not a Lie algebra");
        let help = "this construction consists of Lie algebras, such as so(3) + R^2";
        return Err(InputError::usage(message).at(&source.whole(part)).help(help));
    }
    let error = match affinor::algebra::catalogue::find(name) {
        Ok(entry) => return Ok(Definition::from_entry(entry)),
        Err(error) => error,
    };
    if let Some(fault) = fault(name) {
        let message = format!("unknown space `{}`: {fault}", shown(name));
        return Err(InputError::usage(message).at(&source.whole(part)));
    }
    if let Some(algebra) = with_index(name) {
        let message = format!("the catalogue has no real form `{}`", shown(name));
        let help =
            format!("{algebra} is the split form, and compact({algebra}) is the compact form");
        return Err(InputError::usage(message).at(&source.whole(part)).help(help));
    }
    if matches!(error, CatalogueError::Unknown { .. })
        && let Some(chart) = charts::nearest(name)
    {
        let message =
            format!("there is no space named `{}`; the nearest is {chart}", name.escape_debug());
        let refused = InputError::usage(message).at(&source.whole(part)).help(NAMES);
        return Err(InputError { suggestions: vec![chart.into()], ..refused });
    }
    // a short form with several readings is an error, because the spelling would choose one of them
    let is_ambiguous = matches!(error, CatalogueError::Ambiguous { .. });
    if !is_ambiguous
        && let Some((meant, note)) = spelling::meaning(name)
        && let Ok(entry) = affinor::algebra::catalogue::find(&meant)
    {
        let mut definition = Definition::from_entry(entry);
        definition.notes.push(note);
        return Ok(definition);
    }
    // the arguments of a group are those of its algebra
    let group = spelling::of_family(name);
    let error = match group.as_ref().map(|algebra| affinor::algebra::catalogue::find(algebra)) {
        Some(Err(other)) => other,
        _ => error,
    };
    let same_length = group.is_none_or(|algebra| algebra.len() == name.len());
    let span = match &error {
        CatalogueError::Malformed { span, .. } if same_length => span.clone(),
        CatalogueError::Value { source, .. } if same_length => source.span.clone(),
        _ => 0..name.len(),
    };
    let refused = InputError::usage(error.to_string()).at(&source.find(name, span));
    let refused = InputError { suggestions: suggestions(&error), ..refused };
    let foreign: String = name.chars().filter(|c| !c.is_ascii()).take(64).collect();
    Err(match error {
        _ if !foreign.is_empty() => {
            let foreign = foreign.escape_unicode();
            refused
                .help(format!("names of algebras must be ASCII, but this one contains {foreign}"))
        }
        CatalogueError::Unknown { .. } => with_nearest(refused.help(NAMES), name),
        CatalogueError::NoSuchAlgebra { .. } if name.contains('.') => {
            refused.help("write a whole number")
        }
        _ => refused,
    })
}

/// The names that may have been meant.
fn suggestions(error: &CatalogueError) -> Vec<String> {
    match error {
        CatalogueError::Unknown { nearest: names, .. }
        | CatalogueError::Ambiguous { readings: names, .. }
        | CatalogueError::Incomplete { candidates: names, .. } => names.clone(),
        _ => vec![],
    }
}

/// Adds the names of homogeneous spaces that a misspelt name may mean.
pub(super) fn with_nearest(error: InputError, text: &str) -> InputError {
    let names = if cfg!(feature = "homogeneous") { nearest(text) } else { vec![] };
    if names.is_empty() {
        return error;
    }
    let shown = shown(text);
    let message =
        format!("there is no space named `{shown}`; the nearest is {}", names.join(" or "));
    InputError { message, suggestions: names, ..error }
}
