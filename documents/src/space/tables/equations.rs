//! Structure equations of a coframe: `de1 = 0, de3 = -e1^e2`, also with `∧`, `e^{12}` and `d\omega^1`.
//! Products may be written as in the notation of Salamon: `de4 = e12`, `de4 = 12`.
//!
//! `de^k = a e^i ∧ e^j` means `[e_i, e_j] = -a e_k`, because `de^k(x, y) = -e^k([x, y])`. The basis
//! is deduced as for brackets.

use super::brackets::order_of;
use super::{Entry, algebra, basis_vectors, first_line, salamon, split_at_top};
use crate::input::{InputError, Source, shown};
use crate::space::Definition;

/// The mark of a wedge product in the rewritten text.
const WEDGE: char = '∧';

/// Whether the first statement is `d` of a name, and some statement contains a product of forms, or
/// two indices after the `d` of a numbered form.
pub(super) fn is_table(text: &str) -> bool {
    let first = first_line(text);
    let head = first.split(['=', ',', ';']).next().unwrap_or_default();
    let is_head = first.contains('=') && form(head).is_some_and(|name| !name.is_empty());
    let wedge = |line: &str| {
        line.contains(WEDGE)
            || line.contains("\\wedge")
            || line
                .split('^')
                .skip(1)
                .any(|rest| rest.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '{'))
    };
    let is_numbered = head.trim_end_matches(['}', ' ']).ends_with(|c: char| c.is_ascii_digit());
    let indices = |line: &str| {
        let sums = split_at_top(line, &[',', ';']).into_iter().filter_map(|s| s.split_once('='));
        sums.flat_map(|(_, sum)| salamon::terms(sum)).any(|(_, term)| is_pair(term))
    };
    let product = |line: &str| wedge(line) || is_numbered && indices(line);
    is_head && text.lines().any(|line| line.contains('=') && product(line))
}

/// Whether a term is a product of forms by two indices, after a factor: `12`, `2*e12`.
fn is_pair(term: &str) -> bool {
    let last = term.rsplit(['*', '·', ' ']).next().unwrap_or_default();
    let name = last.trim_start_matches(|c: char| c.is_ascii_digit() || c == '\\');
    let is_name = |c: char| c.is_alphanumeric() || "_^{}".contains(c);
    let digits = name.chars().filter(char::is_ascii_digit).count();
    let named = name.starts_with(char::is_alphabetic) && name.chars().all(is_name);
    salamon::form(term).is_some() || named && digits == 2
}

/// The algebra of the equations.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let source = &rewritten(source);
    let text = source.content();
    let statements: Vec<&str> = text
        .lines()
        .map(|line| line.split('#').next().unwrap_or_default())
        .flat_map(|line| split_at_top(line, &[',', ';']))
        .filter(|statement| !statement.trim().is_empty())
        .collect();
    let (mut entries, mut names) = (vec![], vec![]);
    let mut found: Vec<String> = vec![];
    for statement in &statements {
        let refuse = |part: &str, message: String| {
            let help = "write de3 = -e1^e2, one equation for each form";
            Err(InputError::usage(message).at(&source.whole(part)).help(help))
        };
        let Some((head, sum)) = statement.split_once('=') else {
            return refuse(statement.trim(), "`=` is missing".into());
        };
        let Some(k) = form(head) else {
            let head = head.trim();
            return refuse(head, format!("`{}` is not d of a form", shown(head)));
        };
        names.push(k);
        if sum.trim() == "0" {
            continue;
        }
        for (negative, term) in salamon::terms(sum) {
            let Some((value, [i, j])) = product(term).or_else(|| by_indices(k, term)) else {
                let part = if term.is_empty() { sum } else { term };
                let message = format!("`{}` is not a product of two forms", shown(part.trim()));
                return refuse(part, message);
            };
            found.extend([i.clone(), j.clone()]);
            let (j, k, i) = (i.into(), j.into(), k.into());
            entries.push(Entry { j, k, i, negative: !negative, value, place: term });
        }
    }
    names.extend(found.iter().map(String::as_str));
    let labels = order_of(&names)?;
    let borrowed: Vec<&str> = labels.iter().map(String::as_str).collect();
    let labels = basis_vectors(&borrowed);
    let known = labels.clone();
    let index = move |name: &str| {
        let at = known.iter().position(|label| label == name);
        at.ok_or_else(|| format!("`{}` is not a form of the basis", shown(name)))
    };
    let mut definition = algebra(source, labels, &entries, index)?;
    definition.note_basis();
    Ok(definition)
}

/// The name in `d name`.
fn form(head: &str) -> Option<&str> {
    let name = head.trim().strip_prefix('d')?.trim_start().trim_start_matches('\\');
    let is_name = |c: char| c.is_alphanumeric() || "_^{}".contains(c);
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit() || "_^{}".contains(c));
    let short = stem.chars().count() == 1 || head.contains('\\') || GREEK.contains(&stem);
    (short && name.starts_with(char::is_alphabetic) && name.chars().all(is_name)).then_some(name)
}

/// Names of forms of several letters.
const GREEK: [&str; 5] = ["alpha", "eta", "omega", "sigma", "theta"];

/// The factor and the two forms of a term: `a*e1∧e2`, `2 e1∧e2`.
fn product(term: &str) -> Option<(&str, [String; 2])> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let (head, second) = term.split_once(WEDGE)?;
    let (head, second) = (head.trim_end(), second.trim());
    let from = head.trim_end_matches(is_name).len();
    // digits that are glued to a name are its factor
    let name = head[from..].trim_start_matches(|c: char| c.is_ascii_digit());
    let factor = head[..head.len() - name.len()].trim_end();
    let factor = factor.trim_end_matches(['*', '·']).trim_end();
    let factor = if factor.is_empty() { "1" } else { factor };
    let ok = !name.is_empty() && !second.is_empty() && second.chars().all(is_name);
    ok.then(|| (factor, [name.into(), second.into()]))
}

/// The factor and the two forms of a term in the notation of Salamon: `2*12` in `de4` means
/// `2 e1∧e2`.
fn by_indices<'t>(form: &str, term: &'t str) -> Option<(&'t str, [String; 2])> {
    let stem = form.trim_end_matches(|c: char| c.is_ascii_digit());
    let (factor, indices) = salamon::form(term).filter(|_| stem.len() < form.len())?;
    Some((factor, indices.map(|index| format!("{stem}{index}"))))
}

/// The source with one mark for products and with plain indices: `e^{12}` and `e12` on the right
/// become `e1∧e2`, `e^1` becomes `e1`, and `e1^e2` becomes `e1∧e2`.
fn rewritten(source: &Source) -> Source {
    let text = source.content();
    let (mut out, mut places) = (String::new(), vec![]);
    let mut push = |out: &mut String, part: &str, from: usize| {
        out.push_str(part);
        places.extend((0..part.len()).map(|_| from));
    };
    let (mut at, mut right) = (0, false);
    while let Some(symbol) = text[at..].chars().next() {
        let rest = &text[at..];
        let next = rest[symbol.len_utf8()..].trim_start();
        match symbol {
            '=' => right = true,
            '\n' | ';' | ',' => right = false,
            _ => {}
        }
        if let Some(behind) = rest.strip_prefix("\\wedge") {
            push(&mut out, "∧", at);
            at += rest.len() - behind.len();
            continue;
        }
        if symbol.is_alphabetic() && (right || symbol != 'd') {
            let name = rest.find(|c: char| !c.is_alphabetic()).unwrap_or(rest.len());
            let marks = rest[name..].find(|c: char| !(c.is_ascii_digit() || "_^{}".contains(c)));
            // a wedge may follow an index
            let mut end = name + marks.unwrap_or(rest.len() - name);
            end = rest[..end].trim_end_matches('^').len();
            let digits: String = rest[name..end].chars().filter(char::is_ascii_digit).collect();
            let stem = &rest[..name];
            let product = |text: &str| text.trim_start().starts_with(['^', WEDGE, '\\']);
            let wedged = out.trim_end().ends_with(WEDGE) || product(&rest[end..]);
            if right && digits.len() == 2 && !wedged {
                let (i, j) = digits.split_at(1);
                push(&mut out, &format!("{stem}{i}∧{stem}{j}"), at);
            } else {
                push(&mut out, stem, at);
                push(&mut out, &digits, at + name);
            }
            at += end;
            continue;
        }
        match symbol {
            '^' if next.starts_with(char::is_alphabetic) => push(&mut out, "∧", at),
            '\\' | '$' | '&' => {}
            _ => push(&mut out, &rest[..symbol.len_utf8()], at),
        }
        at += symbol.len_utf8();
    }
    source.rewritten(out, places, text.len())
}
