//! String literals of TOML and JSON: the position of each byte of their content.

/// For each byte of `content`, and for its end, the position in the literal. The literal includes
/// its quotes. `None` if the value of the literal is not `content`.
pub(crate) fn places(literal: &str, content: &str) -> Option<Vec<usize>> {
    let quote = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|quote| literal.starts_with(quote));
    let Some(quote) = quote else {
        // the content of a key without quotes, or of a number, is the literal itself
        return (literal == content).then(|| (0..=content.len()).collect());
    };
    let escaped = quote.starts_with('"');
    let mut places = Vec::with_capacity(content.len() + 1);
    let mut at = quote.len();
    // skips a line end after the opening quotes of a block, because TOML ignores it
    if quote.len() == 3 {
        let rest = &literal[at..];
        let kept = rest.strip_prefix("\r\n").or_else(|| rest.strip_prefix('\n'));
        at += rest.len() - kept.unwrap_or(rest).len();
    }
    for symbol in content.chars() {
        let rest = literal.get(at..)?;
        let skipped = if escaped { continuation(rest) } else { 0 };
        let rest = &rest[skipped..];
        let length = match escaped {
            true => written(rest, symbol)?,
            false => rest.starts_with(symbol).then_some(symbol.len_utf8())?,
        };
        at += skipped;
        places.extend(std::iter::repeat_n(at, symbol.len_utf8()));
        at += length;
    }
    let rest = literal.get(at..)?;
    at += if escaped { continuation(rest) } else { 0 };
    places.push(at);
    literal[at..].starts_with(quote).then_some(places)
}

/// The length of a backslash at the end of a line, including the white space that it removes; 0 for
/// other text.
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

/// The number of bytes at the start of `rest` that represent `symbol`; `None` if they represent
/// another character.
fn written(rest: &str, symbol: char) -> Option<usize> {
    let Some(escape) = rest.strip_prefix('\\') else {
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
