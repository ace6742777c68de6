//! Parses names of the catalogue: a head, and arguments with or without parentheses.

use super::{CatalogueError, Entry, FAMILIES, Family, MAX_DIMENSION, Reader};

/// An argument: a part of a name, and its byte offset in the name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Argument<'t> {
    pub text: &'t str,
    pub at: usize,
}

/// The algebra that a name identifies. The constants of a matrix algebra are not computed yet.
pub(super) enum Reading<'t> {
    Integers { family: &'static Family, digits: Vec<&'t str>, dimension: usize, build: Build },
    Entry(Entry),
}

type Build = fn(String, &[usize]) -> Entry;

impl Reading<'_> {
    /// The name in full.
    fn name(&self) -> String {
        match self {
            Reading::Integers { family, digits, .. } => family.name(&digits.join(",")),
            Reading::Entry(entry) => entry.name.clone(),
        }
    }

    pub(super) fn build(self) -> Entry {
        let name = self.name();
        match self {
            Reading::Integers { digits, build, .. } => {
                let numbers: Result<Vec<_>, _> =
                    digits.iter().map(|digits| digits.parse()).collect();
                build(name, &numbers.expect("each is at most the dimension, which has a limit"))
            }
            Reading::Entry(entry) => entry,
        }
    }
}

/// Finds the algebra with this name.
pub(super) fn resolve(name: &str) -> Result<Reading<'_>, CatalogueError> {
    let whole = Argument { text: name, at: 0 }.trimmed();
    let letters = &whole.text[..whole.find(|c| !c.is_ascii_alphabetic())];
    // tries heads such as se_2 first: they contain more than letters, and are longer than a head
    // such as se
    let longer = |head: &&str| {
        head.starts_with(letters) && head.contains(['_', '*']) && whole.text.starts_with(head)
    };
    let heads = FAMILIES.iter().map(|family| family.head()).filter(longer);
    let word = heads.max_by_key(|head| head.len()).unwrap_or(letters);
    let begins = |family: &Family| match family.reader {
        Reader::Integers { .. } => word == family.head(),
        Reader::Words(_) => word.starts_with(family.head()),
    };
    let families: Vec<_> = FAMILIES.iter().filter(|family| begins(family)).collect();
    let Some(first) = families.first() else {
        let nearest = nearest(word, whole.from(word.len()).text);
        return Err(CatalogueError::Unknown { name: name.into(), nearest });
    };
    let (arguments, bare) = arguments(name, first, whole.from(first.head().len()))?;
    if arguments.is_empty() {
        let candidates = families.iter().map(|family| family.example.into()).collect();
        return Err(CatalogueError::Incomplete { name: whole.text.into(), candidates });
    }
    let mut readings = match first.reader {
        Reader::Words(read) => return Ok(Reading::Entry(read(name, &arguments)?)),
        Reader::Integers { .. } => integer_readings(&families, &arguments, bare),
    };
    let name = whole.text.to_string();
    let fits = |reading: &Reading| match reading {
        Reading::Integers { dimension, .. } => *dimension <= MAX_DIMENSION,
        Reading::Entry(_) => true,
    };
    match readings.as_slice() {
        [] => Err(CatalogueError::NoSuchAlgebra { name, rule: rule(&families) }),
        all if !all.iter().any(fits) => Err(CatalogueError::TooLarge { name }),
        [_] => Ok(readings.swap_remove(0)),
        all => {
            let readings = all.iter().map(Reading::name).collect();
            Err(CatalogueError::Ambiguous { name, readings })
        }
    }
}

/// Translates names of real forms in Helgason's tables to names of the catalogue. Supports
/// `su*(2n)`, and names of exceptional types with the signature of the Killing form, such as
/// `g2(2)`, for split and compact forms.
pub(super) fn of_real_form(name: &str) -> Option<String> {
    let (head, argument) = name.trim().strip_suffix(')')?.split_once('(')?;
    if head.trim() == "su*" {
        let size: usize = argument.trim().parse().ok()?;
        return (size >= 2 && size.is_multiple_of(2)).then(|| format!("sl({},H)", size / 2));
    }
    const EXCEPTIONAL: [(&str, i64, i64); 5] =
        [("e6", 6, 78), ("e7", 7, 133), ("e8", 8, 248), ("f4", 4, 52), ("g2", 2, 14)];
    let (head, split, dimension) = EXCEPTIONAL.into_iter().find(|(known, ..)| *known == head)?;
    let character: i64 = argument.trim().parse().ok()?;
    match character {
        same if same == split => Some(head.to_uppercase()),
        same if same == -dimension => Some(format!("compact({})", head.to_uppercase())),
        _ => None,
    }
}

/// The condition on the arguments of these families, as text for messages.
pub(super) fn rule(families: &[&Family]) -> String {
    let rules = families.iter().map(|family| format!("{} needs {}", family.pattern, family.needs));
    rules.collect::<Vec<_>>().join(", ")
}

/// Splits the text after the head into arguments. Also returns whether they are written without
/// parentheses.
fn arguments<'t>(
    name: &str,
    family: &Family,
    behind: Argument<'t>,
) -> Result<(Vec<Argument<'t>>, bool), CatalogueError> {
    let malformed = |at: usize, to: usize, reason| {
        Err(CatalogueError::Malformed { name: name.into(), span: at..to, reason })
    };
    let mut behind = behind.trimmed();
    if family.pattern[family.head().len()..].starts_with('^') && behind.text.starts_with('^') {
        behind = behind.from(1).trimmed();
    }
    let bare = !behind.text.starts_with('(');
    if !bare {
        let Some(close) = closing(behind.text) else {
            return malformed(behind.at, behind.at + 1, "this parenthesis is not closed");
        };
        let rest = behind.from(close + 1).trimmed();
        if !rest.text.is_empty() {
            let reason = "nothing is expected behind the parenthesis";
            return malformed(rest.at, rest.at + rest.text.len(), reason);
        }
        behind = Argument { text: &behind.text[1..close], at: behind.at + 1 }.trimmed();
    }
    if behind.text.is_empty() {
        return Ok((vec![], bare));
    }
    let mut from = 0;
    let parts = behind.text.split(',').map(|text| {
        let at = behind.at + from;
        from += text.len() + 1;
        Argument { text, at }.trimmed()
    });
    Ok((parts.collect(), bare))
}

/// The position of the parenthesis that closes the first parenthesis.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.bytes().position(|symbol| {
        match symbol {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        depth == 0
    })
}

/// Lists all readings of the name as an existing algebra, including algebras that are too large.
/// Digits without parentheses may be read as several arguments.
fn integer_readings<'t>(
    families: &[&'static Family],
    arguments: &[Argument<'t>],
    bare: bool,
) -> Vec<Reading<'t>> {
    let written: Vec<&str> = arguments.iter().map(|argument| argument.text).collect();
    let mut splits = vec![written.clone()];
    if let (true, [digits]) = (bare, written.as_slice())
        // does not split longer digit strings, because one of the two numbers would be too large
        // anyway
        && digits.len() <= 20
        && digits.is_ascii()
    {
        let pairs = (1..digits.len()).map(|at| digits.split_at(at));
        splits.extend(pairs.map(|(p, q)| vec![p, q]));
    }
    let readings = splits.into_iter().flat_map(|digits| {
        families.iter().filter_map(move |family| integers(family, digits.clone()))
    });
    readings.collect()
}

fn integers<'t>(family: &'static Family, digits: Vec<&'t str>) -> Option<Reading<'t>> {
    let Reader::Integers { count, dimension, build } = family.reader else {
        return None;
    };
    let plain = |text: &&str| text.bytes().all(|b| b.is_ascii_digit()) && !text.starts_with('0');
    let mut digits = digits;
    let field = digits.last().copied().filter(|last| matches!(*last, "C" | "H" | "R"));
    // accepts the letter R for the real field: sl(2,R), sp(4,R)
    let real = matches!(family.head(), "sl" | "gl" | "sp") && family.letter().is_none();
    match (family.letter(), field) {
        (letter, Some(field)) if letter.unwrap_or("R") == field && (letter.is_some() || real) => {
            digits.pop();
        }
        (None, None) => {}
        _ => return None,
    }
    if digits.len() != count || !digits.iter().all(plain) || digits.contains(&"") {
        return None;
    }
    // counts a number that overflows a machine word as an algebra that is too large
    let numbers: Result<Vec<usize>, _> = digits.iter().map(|digits| digits.parse()).collect();
    let dimension = numbers.map_or(Some(usize::MAX), |numbers| dimension(&numbers))?;
    Some(Reading::Integers { family, digits, dimension, build })
}

/// Lists heads that are similar to the mistyped `word`. The arguments are retained if the family
/// accepts them.
fn nearest(word: &str, behind: &str) -> Vec<String> {
    /// The maximum length of a word that may be a typing error.
    const LONGEST: usize = 32;
    let lower = word.to_lowercase();
    let distance = |family: &&Family| {
        let head = family.head().to_lowercase();
        let distance = strsim::damerau_levenshtein(&lower, &head);
        (distance <= head.len() / 2).then_some(distance)
    };
    if word.len() > LONGEST {
        return vec![];
    }
    let Some(least) = FAMILIES.iter().filter_map(|family| distance(&family)).min() else {
        return vec![];
    };
    let mut names = Vec::new();
    for family in FAMILIES.iter().filter(|family| distance(family) == Some(least)) {
        let found = match resolve(&format!("{}{behind}", family.head())) {
            Ok(reading) => vec![reading.name()],
            Err(CatalogueError::Ambiguous { readings, .. }) => readings,
            Err(_) => vec![family.example.into()],
        };
        names.extend(found);
    }
    names.sort();
    names.dedup();
    names
}

impl<'t> Argument<'t> {
    /// The argument without white space at its ends.
    pub(super) fn trimmed(self) -> Self {
        let text = self.text.trim_start();
        Argument { text: text.trim_end(), at: self.at + self.text.len() - text.len() }
    }

    /// The rest of the argument, without its first `bytes` bytes.
    pub(super) fn from(self, bytes: usize) -> Self {
        Argument { text: &self.text[bytes..], at: self.at + bytes }
    }

    /// The position of the first matching character, or the end.
    fn find(self, matches: impl Fn(char) -> bool) -> usize {
        self.text.find(matches).unwrap_or(self.text.len())
    }
}
