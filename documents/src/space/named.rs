//! Spaces given by a string: sums of catalogue names, paths of files, and tables in the string
//! itself.

use super::catalogue_name::entry;
use super::charts::NamedChart;
use super::{Definition, check_dimension, homogeneous, paper, spelling, tables};
use crate::input::{InputError, Source};
use affinor::geometry::homogeneous::has_form;
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
