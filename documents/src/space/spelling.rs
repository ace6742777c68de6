//! Spellings of names: letters of other alphabets, LaTeX, proper names, and names of groups.
//!
//! The catalogue has one name for each algebra, `su(2)`. Papers also write `SU(2)`, `\mathfrak{su}(2)`,
//! `SL_2(R)` or `Poincaré`.

use affinor::algebra::catalogue;

/// Proper names, and the catalogue names that they mean. Capitals and blanks make no difference.
const PROPER: [(&str, &str); 20] = [
    ("anti de Sitter", "so(3,2)"),
    ("conformal", "conformal(3,1)"),
    ("de Sitter", "so(4,1)"),
    ("Engel", "filiform(4)"),
    ("Euclid", "se(3)"),
    ("Euclidean", "se(3)"),
    ("Galilean", "galilei(3)"),
    ("Galilei", "galilei(3)"),
    ("Heisenberg", "heisenberg(3)"),
    ("Lorentz", "so(3,1)"),
    ("Nil", "heisenberg(3)"),
    ("Nil3", "heisenberg(3)"),
    ("oscillator", "oscillator(4)"),
    ("Poincare", "iso(3,1)"),
    ("rigid motions", "se(3)"),
    ("rotations", "so(3)"),
    ("Schroedinger", "schroedinger(1)"),
    ("Schrodinger", "schroedinger(1)"),
    ("Sol", "iso(1,1)"),
    ("Sol3", "iso(1,1)"),
];

/// The proper names that are read.
pub fn proper_names() -> Vec<&'static str> {
    PROPER.iter().map(|(name, _)| *name).collect()
}

/// Groups whose algebra has another name in the catalogue: the name of the group, in lower case, and
/// the family of the algebra.
const FAMILIES: [(&str, &str); 7] = [
    ("e", "se"),
    ("o", "so"),
    ("pgl", "sl"),
    ("pso", "so"),
    ("psl", "sl"),
    ("psu", "su"),
    ("spin", "so"),
];

/// Words around a proper name that carry no meaning.
const FILLERS: [&str; 6] = ["the", "group", "algebra", "lie", "of", "'s"];

/// A name in ASCII: accents are removed, letters of the Fraktur and double-struck alphabets become
/// Latin, `⊕` becomes `+`, and LaTeX commands for alphabets are dropped. Other characters stay.
pub(super) fn folded(name: &str) -> String {
    let mut text = name.trim().trim_matches('$').to_string();
    for command in ["mathfrak", "mathrm", "mathbb", "operatorname", "mathsf", "text"] {
        text = text.replace(&format!("\\{command}"), "");
    }
    // groups of a homogeneous space G/H have products; algebras have sums
    let product = if text.contains('/') { "x" } else { "+" };
    text = text.replace("\\oplus", "+").replace("\\times", product).replace('×', product);
    let text: String = text.chars().flat_map(letters).collect();
    if name.contains('\\') { text.replace(['{', '}'], "") } else { text }
}

/// The letters that a character means.
fn letters(c: char) -> Vec<char> {
    let shifted = |first: u32| char::from_u32(u32::from('a') + u32::from(c) - first);
    let latin = match c {
        'á' | 'à' | 'â' | 'ä' | 'å' | 'ã' => Some('a'),
        'é' | 'è' | 'ê' | 'ë' => Some('e'),
        'í' | 'ì' | 'î' | 'ï' => Some('i'),
        'ó' | 'ò' | 'ô' | 'ø' => Some('o'),
        'ö' => return vec!['o', 'e'],
        'ü' => return vec!['u', 'e'],
        'ç' => Some('c'),
        'ñ' => Some('n'),
        'ℝ' => Some('R'),
        'ℂ' => Some('C'),
        'ℍ' => Some('H'),
        '⊕' => Some('+'),
        '−' => Some('-'),
        '’' => Some('\''),
        '\u{2080}'..='\u{2089}' => char::from_digit(u32::from(c) - 0x2080, 10),
        '\u{1d51e}'..='\u{1d537}' => shifted(0x1d51e),
        '²' => return vec!['^', '2'],
        '³' => return vec!['^', '3'],
        '⁴'..='⁹' => {
            return vec!['^', char::from_digit(u32::from(c) - 0x2070, 10).unwrap_or(c)];
        }
        '\u{a0}' => Some(' '),
        _ => None,
    };
    vec![latin.unwrap_or(c)]
}

/// The catalogue name that another spelling means, and a note that says so.
///
/// A name of a group, which begins with a capital letter, means its Lie algebra.
pub(super) fn meaning(name: &str) -> Option<(String, String)> {
    let known = |other: &String| catalogue::find(other).is_ok();
    let words = |name: &str| -> String {
        let lower = name.to_lowercase();
        let words = lower.split([' ', '-', '_']).filter(|word| !FILLERS.contains(word));
        words.collect::<String>().replace("'s", "")
    };
    if let Some((_, meant)) = PROPER.iter().find(|(proper, _)| words(proper) == words(name)) {
        return Some((meant.to_string(), format!("{name} is read as {meant}")));
    }
    let compact: String = name.chars().filter(|c| !c.is_whitespace()).collect();
    let (family, rest) = split(&compact);
    // a name that is not finished has no other meaning
    if rest.matches('(').count() != rest.matches(')').count() || rest.contains(",)") {
        return None;
    }
    let arguments = arguments(rest);
    let is_group = family.starts_with(|c: char| c.is_ascii_uppercase());
    let spelled = families(family, rest)
        .into_iter()
        .flat_map(|family| [format!("{family}{rest}"), format!("{family}({arguments})")]);
    let exceptional = [compact.to_uppercase(), compact.to_lowercase()];
    let meant = spelled.chain(exceptional).find(known)?;
    let algebra = meant.starts_with(|c: char| c.is_ascii_lowercase());
    let note = match is_group && algebra {
        true => format!("{name}: computed in its Lie algebra {meant}"),
        false => format!("{name} is read as {meant}"),
    };
    Some((meant, note))
}

/// The name of a group with the family of its Lie algebra: `su(300)` for `SU(300)`. Errors for the
/// arguments of a group are those of this name.
pub(super) fn of_family(name: &str) -> Option<String> {
    let (family, rest) = split(name);
    let is_group = family.starts_with(|c: char| c.is_ascii_uppercase());
    let known = |name: &String| {
        !matches!(catalogue::find(name), Err(catalogue::CatalogueError::Unknown { .. }))
    };
    let mut names = families(family, rest).into_iter().map(|family| format!("{family}{rest}"));
    names.find(|name| is_group && known(name))
}

/// Splits a name into its letters and the rest.
fn split(name: &str) -> (&str, &str) {
    name.split_at(name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len()))
}

/// The families of algebras that the letters of a name may mean.
fn families(letters: &str, rest: &str) -> Vec<String> {
    let is_group = letters.starts_with(|c: char| c.is_ascii_uppercase());
    let lower = letters.to_lowercase();
    let other = FAMILIES.iter().find(|(group, _)| is_group && *group == lower);
    // E6 is an exceptional algebra, E(3) a group of motions
    let other = other.filter(|_| lower != "e" || rest.starts_with('('));
    other.map(|(_, family)| family.to_string()).into_iter().chain([lower]).collect()
}

/// The arguments of a name without parentheses around all of them: `2,R` for `_2(R)`, `2(R)` and
/// `(2;R)`.
fn arguments(rest: &str) -> String {
    let rest = rest.trim_start_matches(['_', '+', '^']);
    let parts = rest.split(['(', ')', ',', ';']).map(|part| part.trim_matches(['{', '}', '_']));
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::{folded, meaning};

    #[test]
    fn groups_mean_their_lie_algebras() {
        for (group, algebra) in [
            ("SU(2)", "su(2)"),
            ("SL(2,R)", "sl(2,R)"),
            ("SL_2(R)", "sl(2,R)"),
            ("SE(3)", "se(3)"),
            ("E(3)", "se(3)"),
            ("GL(2)", "gl(2)"),
            ("U(1)", "u(1)"),
            ("SO+(3,1)", "so(3,1)"),
            ("Spin(7)", "so(7)"),
            ("PSL(2,C)", "sl(2,C)"),
        ] {
            let (meant, note) = meaning(group).unwrap_or_default();
            assert_eq!(meant, algebra, "{group}");
            assert!(note.contains("Lie algebra"), "{note}");
        }
    }

    #[test]
    fn other_spellings_are_read() {
        for (spelling, name) in [
            ("e8", "E8"),
            ("Poincaré", "iso(3,1)"),
            ("the Lorentz group", "so(3,1)"),
            ("Nil", "heisenberg(3)"),
        ] {
            assert_eq!(meaning(&folded(spelling)).map(|(name, _)| name).as_deref(), Some(name));
        }
        assert_eq!(folded("\u{1d530}\u{1d532}(2) ⊕ ℝ³"), "su(2) + R^3");
        assert_eq!(folded("\\mathfrak{so}(3)"), "so(3)");
        assert_eq!(meaning("nonsense"), None);
    }
}
