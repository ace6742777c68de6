//! Error messages of the documents in the language of the page.
//!
//! The page has fields and buttons, but no options, files and commands. Names in backticks are put
//! in quotation marks.

/// Advice that names an option or a command, by a part of it, and the advice of the page.
const ADVICE: [(&str, &str); 12] = [
    (
        "affinor list",
        "choose a name from the list below the field, or write brackets such as [x, y] = z",
    ),
    ("--metric", "choose a metric, for instance identity"),
    ("--connection", "choose a connection"),
    ("--set", "give every letter a value with its slider"),
    ("--basis", "write a name such as so(3), or brackets such as [x, y] = z"),
    ("--kind", "choose other equations"),
    ("--scalar", "write exact numbers"),
    ("--frame", "choose a canonical connection: plus, zero or minus"),
    ("--independent", "choose indices"),
    ("declare a parameter", "add the letter to the parameters"),
    (
        "docs/formats",
        "write a name, brackets [x, y] = z, (0,0,12), matrices, or keys such as basis and brackets",
    ),
    ("affinor table", "write one list, such as (0,0,12)"),
];

/// Names of sources, and what the page calls them.
const SOURCES: [(&str, &str); 9] = [
    ("the input", "input"),
    ("SPACE", "input"),
    ("definition.toml", "input"),
    ("definition.json", "input"),
    ("@metric", "input"),
    ("@connection", "input"),
    ("--metric", "metric"),
    ("--connection", "connection"),
    ("--set", "values"),
];

/// The name of a source on the page.
pub(super) fn source(name: &str) -> &str {
    SOURCES.iter().find(|(known, _)| *known == name).map_or(name, |(_, page)| page)
}

/// A message for the page.
pub(super) fn message(text: &str) -> String {
    let text = text.strip_prefix("TOML parse error").unwrap_or(text);
    let mut out = String::new();
    let mut open = false;
    for c in text.chars() {
        match c {
            '`' => {
                out.push(if open { '”' } else { '“' });
                open = !open;
            }
            _ => out.push(c),
        }
    }
    for (name, page) in SOURCES {
        let word = if name == "the input" { continue } else { name };
        out = out.replace(word, &format!("the {page}"));
    }
    out
}

/// Advice for the page; `None` if it concerns the command line only.
pub(super) fn advice(text: &str) -> Option<String> {
    if let Some((_, advice)) = ADVICE.iter().find(|(part, _)| text.contains(part)) {
        return Some((*advice).into());
    }
    let foreign = ["--", "affinor ", ".toml", ".csv", "docs/", "command"];
    (!foreign.iter().any(|word| text.contains(word))).then(|| message(text))
}

#[cfg(test)]
mod tests {
    use super::{advice, message};

    #[test]
    fn options_and_backticks_do_not_reach_the_page() {
        assert_eq!(message("there is no algebra named `x`"), "there is no algebra named “x”");
        assert_eq!(
            advice("give one, as in --metric identity").as_deref(),
            Some("choose a metric, for instance identity")
        );
        assert_eq!(advice("see `affinor examples`"), None);
    }
}
