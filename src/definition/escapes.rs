//! Places in strings that were written with escapes, in TOML or JSON.

/// A string without its escapes, and where each byte of it stands in the text it was read from.
#[derive(Debug)]
pub(super) struct Unescaped {
    /// The string.
    pub text: String,
    /// The place of each byte, and that of the end.
    pub places: Vec<usize>,
}

impl Unescaped {
    /// Finds the literal in `source` that reads as `string`.
    pub fn find(source: &str, string: &str) -> Option<Self> {
        let quotes = source.match_indices('"').map(|(at, _)| at + 1);
        let places = quotes.into_iter().find_map(|start| align(source, start, string))?;
        let text = string.to_string();
        Some(Unescaped { text, places })
    }
}

/// The places of the bytes of `string` in the literal that begins at `start`.
fn align(source: &str, start: usize, string: &str) -> Option<Vec<usize>> {
    let mut places = Vec::new();
    let mut at = start;
    // a line end directly behind the quotes of a block is none of the string
    if !string.starts_with(['\n', '\r']) {
        let rest = &source[at..];
        let skipped = rest.strip_prefix("\r\n").or_else(|| rest.strip_prefix('\n'));
        at += rest.len() - skipped.unwrap_or(rest).len();
    }
    for symbol in string.chars() {
        at += continuation(&source[at..]);
        let length = written(&source[at..], symbol)?;
        places.extend(std::iter::repeat_n(at, symbol.len_utf8()));
        at += length;
    }
    at += continuation(&source[at..]);
    places.push(at);
    source[at..].starts_with('"').then_some(places)
}

/// The length of a backslash at the end of a line with the white space that it swallows.
fn continuation(rest: &str) -> usize {
    let Some(behind) = rest.strip_prefix('\\') else {
        return 0;
    };
    let begins = behind.trim_start_matches([' ', '\t']);
    match begins.starts_with(['\n', '\r']) {
        true => rest.len() - begins.trim_start().len(),
        false => 0,
    }
}

/// How many bytes at the start of `rest` say `symbol`, if they do.
fn written(rest: &str, symbol: char) -> Option<usize> {
    let Some(escape) = rest.strip_prefix('\\') else {
        // TOML reads a line end of either kind as it stands
        return rest.starts_with(symbol).then_some(symbol.len_utf8());
    };
    let letter = escape.chars().next()?;
    let digits = match letter {
        'x' => 2,
        'u' => 4,
        'U' => 8,
        _ => {
            let meant = match letter {
                'b' => '\u{8}',
                't' => '\t',
                'n' => '\n',
                'f' => '\u{c}',
                'r' => '\r',
                'e' => '\u{1b}',
                other => other,
            };
            return (meant == symbol).then_some(1 + letter.len_utf8());
        }
    };
    let code = u32::from_str_radix(escape.get(1..=digits)?, 16).ok()?;
    (char::from_u32(code) == Some(symbol)).then_some(2 + digits)
}

#[cfg(test)]
mod tests {
    use super::Unescaped;

    #[test]
    fn every_byte_has_its_place() {
        let source = r##"{"a": "x", "b": "# \u00e9\n[x,\ty]"}"##;
        let string = "# é\n[x,\ty]";
        let found = Unescaped::find(source, string).expect("it stands there");
        let at = |part: &str| found.places[string.find(part).expect("a part")];
        assert_eq!(&source[at("é")..at("\n")], r"\u00e9");
        assert_eq!(&source[at("[x")..at("\t")], "[x,");
        assert_eq!(&source[at("y]")..], "y]\"}");
    }

    #[test]
    fn a_block_may_continue_its_lines() {
        let source = "b = \"\"\"\n[x,y] \\\n   = z\\\"\n\"\"\"";
        let string = "[x,y] = z\"\n";
        let found = Unescaped::find(source, string).expect("it stands there");
        assert_eq!(found.places[0], source.find('[').expect("a bracket"));
        assert_eq!(found.places[6], source.find("= z").expect("a sign"));
    }

    #[test]
    fn nothing_else_is_taken_for_it() {
        assert!(Unescaped::find(r#"{"a": "x\ny"}"#, "x\nz").is_none());
        assert!(Unescaped::find("\"\\", "x").is_none());
    }
}
