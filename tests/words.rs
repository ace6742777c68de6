//! Comments and messages are written as `docs/style.md` asks: the number of doubtful phrases per package may only fall.
//!
//! `UPDATE_DOCUMENTS=1 cargo test -p affinor-tests --test affinor words::` stores smaller numbers in `tests/words.txt`.

use crate::common::root;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The maximum number of words of a sentence.
const WORDS: usize = 30;

/// Name, phrases and advice. A phrase is a list of words: `a|b` is either word, `*` any word, `x*` any word with this
/// beginning, `!a|b` any word but these, and `^` the beginning of a sentence. Punctuation marks are words.
const RULES: [(&str, &[&str], &str); 7] = [
    ("headless", &["^ What|Where|Who|Whoever|Whatever|Whichever *"], "name the noun"),
    (
        "is no",
        &[
            "!there|There is|are|was|were|be no !longer|more|less|way",
            "^ no !such :",
            "^ no * !to|for|of|in|from|with :",
        ],
        "`is not an X`, `unknown X`, `not an X file`",
    ),
    (
        "a for per",
        &[
            "a|an|one !is|of|as|in|for|with|to|at|by|on|and|or|than|from|not|like|,|;|:|makes|has a|an",
            "once a|an",
        ],
        "`one X per Y`, `once for each Y`",
    ),
    (
        "things act",
        &[
            "stand|stands|stood|lives|knows|refuse|refuses|refused|refusal|refusals|keeps",
            "takes a|an|no|any|only",
            "lie|lies|lay !in|outside|off|on|between",
        ],
        "occur, be stored, contain, support, accept, preserve, reject, return an error",
    ),
    ("two dots", &[".."], "an ellipsis has three dots"),
    (
        "spelling",
        &[
            "center|centers|centered|color|colors|colored|catalog|catalogs|behavior|neighbor|neighbors",
            "symmetris*|antisymmetris*|generalis*|optimis*|normalis*|initialis*|parametris*|linearis*|factoris*",
            "discretis*|organis*|recognis*|minimis*|maximis*|summaris*|serialis*|orthogonalis*|diagonalis*",
            "randomis*|characterise|characterised|characterises|regularis*|synchronis*|vectoris*|realise*",
        ],
        "British with Oxford -ize: centre, colour, normalize",
    ),
    (
        "household words",
        &["beside|roundings|film|films|digits kept|lost", "near equals", "scrambled|uneven"],
        "the technical terms of docs/style.md",
    ),
];

/// Words for a noun that is elsewhere: at most one of them in a sentence.
const PRONOUNS: [&str; 7] = [
    "that of",
    "those of",
    "such !as|a|an",
    "both !of|sides",
    "the one|ones !that",
    "whose",
    "thereof",
];

/// Folders, and whether their messages count as well as their comments.
const FOLDERS: [(&str, bool); 14] = [
    ("tensors/src", true),
    ("src", true),
    ("documents/src", true),
    ("paper/src", true),
    ("cli/src", true),
    ("python/src", true),
    ("python/pysrc", true),
    ("web/src", true),
    ("tests", false),
    ("cli/tests", false),
    ("python/tests", false),
    ("web/tests", false),
    ("benches", false),
    ("examples", false),
];

/// A comment without its marks, or a text in quotes.
struct Prose {
    line: usize,
    text: String,
    message: bool,
}

/// The comments and texts of a Rust, Python or TOML file. Comments on successive lines are one.
fn prose(source: &str, rust: bool) -> Vec<Prose> {
    let mut found: Vec<Prose> = vec![];
    let (mut at, mut line) = (0, 1);
    // the line and indent of the last comment: the next line may continue it
    let mut last = None;
    let mut begins = 0;
    while let Some(c) = source[at..].chars().next() {
        let rest = &source[at..];
        let until = |mark: &str| rest.find(mark).unwrap_or(rest.len());
        let length = if rust && rest.starts_with("//") || !rust && c == '#' {
            let comment = &rest[..until("\n")];
            let alone = source[begins..at].trim().is_empty();
            let text = comment.trim_start_matches(['/', '!', '#']).to_string();
            let mark = comment.len() - text.len();
            match found.last_mut() {
                Some(before) if alone && last == Some((line - 1, at - begins, mark)) => {
                    write!(before.text, "\n{text}").expect("a text grows");
                }
                _ => found.push(Prose { line, text, message: false }),
            }
            last = alone.then_some((line, at - begins, mark));
            comment.len()
        } else if rust
            && let Some(raw) = rest.strip_prefix("r").filter(|_| !ends_in_name(&source[..at]))
        {
            let hashes = raw.len() - raw.trim_start_matches('#').len();
            match raw[hashes..].strip_prefix('"') {
                Some(text) => {
                    let end = format!("\"{}", "#".repeat(hashes));
                    let text = &text[..text.find(&end).unwrap_or(text.len())];
                    found.push(Prose { line, text: text.to_string(), message: true });
                    1 + hashes + 1 + text.len() + end.len()
                }
                None => 1,
            }
        } else if !rust && (rest.starts_with("\"\"\"") || rest.starts_with("'''")) {
            let text = &rest[3..];
            let text = &text[..text.find(&rest[..3]).unwrap_or(text.len())];
            found.push(Prose { line, text: text.to_string(), message: true });
            text.len() + 6
        } else if c == '"' || !rust && c == '\'' {
            let mut escaped = false;
            let end = rest[1..].find(|d| {
                let ends = d == c && !escaped;
                escaped = d == '\\' && !escaped;
                ends
            });
            let text = &rest[1..1 + end.unwrap_or(rest.len() - 1)];
            let joined: Vec<&str> = text.split("\\\n").map(str::trim_start).collect();
            found.push(Prose { line, text: joined.concat(), message: true });
            text.len() + 2
        } else if rust && c == '\'' {
            // a character, or a lifetime
            let mut after = rest[1..].chars();
            match (after.next(), after.next()) {
                (Some('\\'), _) => 3 + until("\\") + rest[3..].find('\'').unwrap_or(0),
                (Some(d), Some('\'')) => 2 + d.len_utf8(),
                _ => 1,
            }
        } else {
            c.len_utf8()
        };
        let passed = &source[at..(at + length).min(source.len())];
        line += passed.matches('\n').count();
        if let Some(end) = passed.rfind('\n') {
            begins = at + end + 1;
        }
        at += passed.len();
    }
    found
}

fn ends_in_name(text: &str) -> bool {
    text.ends_with(|c: char| c.is_alphanumeric() || c == '_')
}

/// The sentences of a text as lists of words, each with the line of its first word from the line of the text.
/// Code, tables and links are left out; text between backticks is one word.
fn sentences(text: &str) -> Vec<(usize, Vec<String>)> {
    let mut found = vec![(0, vec![])];
    let (mut code, mut quoted) = (false, false);
    for (at, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.starts_with("```") {
            code = !code;
        }
        let item = line.starts_with(['*', '-', '|', '#']) || line.starts_with("```");
        if code || item || line.is_empty() {
            found.push((at, vec![]));
            quoted = false;
        }
        if code || line.starts_with(['|', '>']) || line.starts_with("```") {
            continue;
        }
        let mut word = String::new();
        let chars: Vec<char> = line.trim_start_matches(['*', '-', '#', ' ']).chars().collect();
        for (place, &c) in chars.iter().enumerate() {
            let next = chars.get(place + 1).copied().unwrap_or(' ');
            quoted ^= c == '`';
            let mark = ",;:!?()".contains(c) || c == '.' && (next == ' ' || word.ends_with('.'));
            if quoted || c == '`' || !mark && !c.is_whitespace() {
                word.push(c);
                continue;
            }
            let (line, words) = found.last_mut().expect("there is a sentence");
            if words.is_empty() {
                *line = at;
            }
            if c == '.' && word.ends_with('.') {
                word.push('.');
                continue;
            }
            words.extend((!word.is_empty()).then(|| std::mem::take(&mut word)));
            if mark {
                words.push(c.to_string());
            }
            if ".!?".contains(c) && mark && next == ' ' {
                found.push((at, vec![]));
            }
        }
        let (begins, words) = found.last_mut().expect("there is a sentence");
        if words.is_empty() {
            *begins = at;
        }
        words.extend((!word.is_empty()).then_some(word));
    }
    found.retain(|(_, words)| !words.is_empty());
    found
}

/// Whether a phrase of a rule occurs in a sentence.
fn occurs(phrase: &str, words: &[String]) -> bool {
    let (phrase, first) = match phrase.strip_prefix("^ ") {
        Some(phrase) => (phrase, true),
        None => (phrase, false),
    };
    let pattern: Vec<&str> = phrase.split(' ').collect();
    let fits = |(part, word): (&&str, &String)| {
        let (part, wanted) = match part.strip_prefix('!') {
            Some(part) => (part, false),
            None => (*part, true),
        };
        let one = |p: &str| match p.strip_suffix('*') {
            Some(beginning) => word.starts_with(beginning),
            None => p == word,
        };
        part.split('|').any(one) == wanted
    };
    let mut windows = words.windows(pattern.len());
    if first {
        return windows.next().is_some_and(|window| pattern.iter().zip(window).all(fits));
    }
    windows.any(|window| pattern.iter().zip(window).all(fits))
}

/// The names of the rules that a sentence breaks.
fn broken(words: &[String]) -> Vec<&'static str> {
    let question = words.last().is_some_and(|word| word == "?");
    let rules = RULES.iter().filter(|(name, phrases, _)| {
        phrases.iter().any(|phrase| occurs(phrase, words)) && !(question && *name == "headless")
    });
    let mut names: Vec<_> = rules.map(|(name, ..)| *name).collect();
    let pronouns = PRONOUNS.iter().filter(|phrase| occurs(phrase, words)).count();
    names.extend((pronouns > 1).then_some("pronouns"));
    let marks = words.iter().filter(|word| word.chars().all(|c| !c.is_alphanumeric())).count();
    names.extend((words.len() - marks > WORDS).then_some("long"));
    names
}

fn advice(name: &str) -> &'static str {
    match name {
        "pronouns" => "repeat the noun",
        "long" => "at most 30 words in a sentence, better 25",
        _ => RULES.iter().find(|(rule, ..)| *rule == name).map_or("", |(_, _, advice)| advice),
    }
}

/// All files of a folder in Rust, Python and TOML, with their paths from the root.
fn files(folder: &str) -> Vec<(String, String)> {
    let mut open = vec![root().join(folder)];
    let mut found = vec![];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the project") {
            let path = entry.expect("an entry of the folder").path();
            let kind = path.extension().and_then(|kind| kind.to_str()).unwrap_or_default();
            if path.is_dir() {
                open.push(path);
            } else if ["rs", "py", "pyi", "toml"].contains(&kind) {
                let text = fs::read_to_string(&path).expect("a source is text");
                let path: &Path = path.strip_prefix(root()).expect("a path below the root");
                let names: Vec<_> = path.iter().map(|name| name.to_string_lossy()).collect();
                found.push((names.join("/"), text));
            }
        }
    }
    found.sort();
    found
}

/// Places and sentences for each folder and rule.
fn count() -> BTreeMap<(&'static str, &'static str), Vec<String>> {
    let mut found = BTreeMap::<_, Vec<String>>::new();
    for (folder, messages) in FOLDERS {
        for (path, text) in files(folder) {
            let pieces = prose(&text, path.ends_with(".rs")).into_iter();
            // this file lists the phrases
            let pieces =
                pieces.filter(|piece| (messages || !piece.message) && path != "tests/words.rs");
            for piece in pieces {
                for (line, words) in sentences(&piece.text) {
                    for name in broken(&words) {
                        let place = format!("{path}:{}: {}", piece.line + line, words.join(" "));
                        found.entry((folder, name)).or_default().push(place);
                    }
                }
            }
        }
    }
    found
}

#[test]
fn doubtful_phrases_become_fewer() {
    let stored = root().join("tests/words.txt");
    let found = count();
    let mut table = String::new();
    for ((folder, name), places) in &found {
        writeln!(table, "{folder}\t{name}\t{}", places.len()).expect("a text grows");
    }
    let update = std::env::var_os("UPDATE_DOCUMENTS").is_some();
    if update && !stored.exists() {
        return fs::write(stored, table).expect("the table is written");
    }
    let text = fs::read_to_string(&stored).unwrap_or_default();
    let allowed = |folder: &str, name: &str| {
        let row = format!("{folder}\t{name}\t");
        let number = text.lines().find_map(|line| line.strip_prefix(&row));
        number.map_or(0, |number| number.parse().expect("a number of places"))
    };
    let mut errors = String::new();
    for ((folder, name), places) in &found {
        if places.len() > allowed(folder, name) {
            let (number, limit) = (places.len(), allowed(folder, name));
            writeln!(errors, "{folder}: {name}: {number}, more than {limit}: {}", advice(name))
                .expect("a text grows");
            writeln!(errors, "  {}", places.join("\n  ")).expect("a text grows");
        }
    }
    assert!(errors.is_empty(), "{errors}");
    if update {
        return fs::write(stored, table).expect("the table is written");
    }
    assert_eq!(text, table, "fewer: UPDATE_DOCUMENTS=1 stores the new numbers in tests/words.txt");
}

#[test]
fn prose_and_sentences_are_found() {
    let source =
        "let x = 'a'; // What is new.\nlet y: &'static str = \"a `b c` row\"; /// one\n/// two\n";
    let found = prose(source, true);
    let texts: Vec<_> = found.iter().map(|piece| (piece.line, piece.text.trim())).collect();
    assert_eq!(texts, [(1, "What is new."), (2, "a `b c` row"), (2, "one"), (3, "two")]);
    let broken_by = |text: &str| {
        sentences(text).iter().flat_map(|(_, words)| broken(words)).collect::<Vec<_>>()
    };
    assert_eq!(broken_by("What is zero."), ["headless"]);
    assert_eq!(
        broken_by("A file. The cube is no shape, one row a vector."),
        ["is no", "a for per"]
    );
    assert_eq!(broken_by("There is no metric. What is a group? It is `what no x`"), [""; 0]);
    assert_eq!(broken_by("Names, .. and more"), ["two dots"]);
    assert_eq!(broken_by("those of a matrix, such that of a form"), ["pronouns"]);
    assert_eq!(broken_by(&"word ".repeat(31)), ["long"]);
    assert_eq!(broken_by("```\nWhat is code.\n```\nA list:\n* one\n* Who reads."), ["headless"]);
}
