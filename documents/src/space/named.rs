//! Spaces given by a string: sums of catalogue names, paths of files, and tables in the string
//! itself.

use super::charts::{self, NamedChart};
use super::{Definition, check_dimension, homogeneous, paper, spelling, tables};
use crate::input::{InputError, Source, shown};
use affinor::algebra::catalogue::CatalogueError;
use affinor::geometry::homogeneous::{fault, has_form};
use affinor_tensors::{Rational, Symbolic};
use std::path::Path;

/// The longest chain of definition files that refer to each other.
const MAX_DEPTH: usize = 16;

/// The algebra that a string in a definition file names. The string is a sum of catalogue names, or
/// the path of a file, relative to the folder of the definition file.
pub(super) fn part(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    if let Some(table) = tables::inline(source) {
        return table;
    }
    if !is_path(text) {
        return named(source);
    }
    let refused = |message: String| Err(InputError::usage(message).at(&source.whole(text)));
    if text == "-" {
        return refused("standard input cannot be part of a definition".into());
    }
    if source.depth >= MAX_DEPTH {
        return refused(format!(
            "the definitions are nested more than {MAX_DEPTH} files deep: one of the files may refer to itself"
        ));
    }
    let folder = Path::new(&source.name).parent().unwrap_or(Path::new(""));
    let path = folder.join(text);
    match Definition::read_part(&path.to_string_lossy(), source.depth + 1, &source.files) {
        Err(error) => Err(error.or_at(&source.whole(text))),
        read => read,
    }
}

/// The space that a name in a source means: a geometry of Paraskevopoulos and Natsiavas (2013), a
/// chart, a homogeneous space, or the algebra of a sum of catalogue names.
pub(super) fn named_space(source: &Source) -> Result<Definition, InputError> {
    let name: String = source.content().chars().filter(|c| !c.is_whitespace()).collect();
    match name.as_str() {
        "M(3)" | "M3" => Definition::of_paper(&paper::m3()?, Symbolic::clone),
        "SO(3)" | "SO3" => {
            let exact = |value: &Rational| Symbolic::constant(value.clone());
            Definition::of_paper(&paper::so3()?, exact)
        }
        name => match NamedChart::find(name) {
            Some(chart) => chart.definition(),
            None => homogeneous::named(source).unwrap_or_else(|| named(source)),
        },
    }
}

/// The algebra that a sum of catalogue names in a source means.
fn named(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let parts = affinor::group::registry::summands(text).into_iter();
    let parts: Vec<_> = parts.map(|part| entry(part, source)).collect::<Result<_, _>>()?;
    check_dimension(parts.iter().map(Definition::dimension).sum::<usize>())
        .map_err(|error| error.at(&source.whole(text)))?;
    let mut parts = parts.into_iter();
    let first = parts.next().ok_or_else(|| InputError::usage("no SPACE is named"))?;
    parts.try_fold(first, Definition::direct_sum)
}

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
        CatalogueError::Unknown { .. } => homogeneous::with_nearest(refused.help(NAMES), name),
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

/// Whether a SPACE is a path: `-`, a name with an extension such as `.toml` or `.csv`, or a name
/// with a `/` outside parentheses. The name of a homogeneous space is a path only if there is such a
/// file.
pub(super) fn is_path(name: &str) -> bool {
    let folded = spelling::folded(name);
    let has_form = affinor::group::registry::summands(&folded).iter().any(|part| has_form(part));
    if tables::is_inline(name) || has_form && !Path::new(name).exists() {
        return false;
    }
    let mut depth = 0i64;
    let slash = name.chars().any(|c| {
        depth += i64::from(c == '(') - i64::from(c == ')');
        c == '/' && depth == 0
    });
    let ending = name.rsplit_once('.').is_some_and(|(stem, ending)| {
        let letters = ending.starts_with(|c: char| c.is_ascii_alphabetic());
        !stem.is_empty() && letters && ending.chars().all(|c| c.is_ascii_alphanumeric())
    });
    name == "-" || ending || slash
}
