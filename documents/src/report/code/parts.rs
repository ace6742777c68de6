//! Splits a long function in C into parts, because the time of compilers grows faster than the
//! length of a function.
//!
//! A value that several parts use is stored in the array `t`; the parameters are stored in the
//! array `p`. All other values are local to their part.

use std::collections::{BTreeMap, BTreeSet};

/// The number of statements in a part.
const PART: usize = 150;

/// The largest number of statements of a function that is not split.
const WHOLE: usize = 2 * PART;

/// The parts of the signature of a function.
pub struct CodeFunction<'f> {
    pub name: &'f str,
    /// The arguments that are vectors: the declaration and the name of each.
    pub vectors: Vec<(String, String)>,
    /// The names of the parameters, such as `p_a`.
    pub parameters: &'f [String],
    /// The arguments that are arrays: the declaration and the name of each.
    pub arrays: Vec<(String, String)>,
}

/// Splits a function. Returns the functions of the parts, and the statements of the function that
/// calls them; `None` if there are few statements.
pub fn split(function: &CodeFunction, statements: &[String]) -> Option<(String, Vec<String>)> {
    if statements.len() <= WHOLE {
        return None;
    }
    let parts: Vec<&[String]> = statements.chunks(PART).collect();
    let mut defined = BTreeMap::new();
    let (mut shared, mut used) = (BTreeSet::new(), BTreeSet::new());
    for (part, lines) in parts.iter().enumerate() {
        for line in *lines {
            for name in names(line) {
                match defined.get(name) {
                    Some(other) if *other != part => drop(shared.insert(name)),
                    Some(_) => drop(used.insert(name)),
                    None if is_temporary(name) => drop(defined.insert(name, part)),
                    None => {}
                }
            }
        }
    }
    let places: BTreeMap<&str, usize> =
        shared.into_iter().enumerate().map(|(place, name)| (name, place)).collect();
    let CodeFunction { name, vectors, parameters, arrays } = function;
    let [more_vectors, more_arrays] = [vectors, arrays];
    let declared =
        more_vectors.iter().chain(more_arrays).map(|(declaration, _)| declaration.clone());
    let own = ["const double *p", "double *t"].map(String::from);
    let declared = own.into_iter().chain(declared).collect::<Vec<_>>().join(", ");
    let passed = more_vectors.iter().chain(more_arrays).map(|(_, name)| name.clone());
    let passed = ["p", "t"].map(String::from).into_iter().chain(passed);
    let passed = passed.collect::<Vec<_>>().join(", ");
    let mut before = String::from(
        "#ifdef __GNUC__\n#define PART static __attribute__((noinline)) void\n#else\n#define PART static void\n#endif\n\n",
    );
    let mut calls = vec![
        format!(
            "const double p[] = {{{}}};",
            [&parameters[..], &["0.0".into()]].concat().join(", ")
        ),
        format!("double t[{}];", places.len().max(1)),
    ];
    for (part, lines) in parts.iter().enumerate() {
        before += &format!("PART {name}_{part}({declared})\n{{\n");
        for line in *lines {
            let local = |name: &str| defined.get(name) == Some(&part) && used.contains(name);
            before += &format!("    {}\n", in_part(line, parameters, &places, local));
        }
        before += "}\n\n";
        calls.push(format!("{name}_{part}({passed});"));
    }
    Some((before, calls))
}

/// Rewrites a statement with the names that are valid within a part.
fn in_part(
    line: &str,
    parameters: &[String],
    places: &BTreeMap<&str, usize>,
    local: impl Fn(&str) -> bool,
) -> String {
    const DEFINITION: &str = "const double ";
    let defined = line.strip_prefix(DEFINITION).and_then(|rest| names(rest).next());
    let line = match defined {
        Some(name) if places.contains_key(name) && !local(name) => &line[DEFINITION.len()..],
        _ => line,
    };
    let (mut text, mut rest, mut first) = (String::new(), line, true);
    while let Some(name) = names(rest).next() {
        let at = name.as_ptr() as usize - rest.as_ptr() as usize;
        text.push_str(&rest[..at]);
        rest = &rest[at + name.len()..];
        let parameter = parameters.iter().position(|own| own == name);
        match (places.get(name), parameter) {
            (Some(place), _) if !local(name) => text += &format!("t[{place}]"),
            (Some(place), _) if first && defined == Some(name) => {
                text += &format!("{name} = t[{place}]");
            }
            (_, Some(place)) => text += &format!("p[{place}]"),
            _ => text.push_str(name),
        }
        first &= defined != Some(name);
    }
    text + rest
}

fn is_temporary(name: &str) -> bool {
    let digits = name.strip_prefix('t').unwrap_or("");
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
}

/// The names that occur in a text, in order. A name does not begin with a digit.
fn names(text: &str) -> impl Iterator<Item = &str> {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    text.split(move |c| !word(c)).filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
}
