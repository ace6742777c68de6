//! Texts of values that occur again and again are written once, up to the names of the parameters.

use super::super::effort::Counted;
use super::cache::{Cache, hash};
use super::fraction::{Fraction, Quotient};
use super::variables::Name;
use super::writing::{Markup, parameter};
use super::{Form, Symbolic};
use std::cell::RefCell;
use std::sync::Arc;

/// Longer names are not left out: one placeholder is made for every place and length.
const MAX_LENGTH: usize = 32;

thread_local! {
    static KNOWN: RefCell<Known> = RefCell::default();
}

#[derive(Default)]
struct Known {
    texts: Cache<Box<Text>, { 1 << 14 }>,
    /// The key that is looked up.
    key: Vec<u64>,
}

/// The text of a value.
struct Text {
    /// The address of the quotient, the markup, and the lengths of the names or their addresses.
    key: Box<[u64]>,
    /// It is kept alive, so that no other quotient takes its address.
    _quotient: Arc<Quotient>,
    template: Template,
    counted: Counted,
}

/// A text without the names.
#[derive(Default)]
struct Template {
    letters: String,
    /// Where a name stands among these letters, and its place among the variables.
    names: Vec<(usize, usize)>,
}

/// The text of a value, which is written if it is not known.
pub(super) fn text(
    value: &Symbolic,
    markup: Markup,
    write: impl FnOnce(&Symbolic) -> String,
) -> String {
    let f = match &value.0 {
        Form::Fraction(f) if f.is_short() => f,
        _ => return write(value),
    };
    let fits = |name: &Name| name.len() <= MAX_LENGTH;
    let nameless = f.is_nameless() && f.variables.len() < 32 && f.variables.iter().all(fits);
    let name = |name: &Name| if nameless { name.len() } else { name.address() } as u64;
    let head = [Arc::as_ptr(&f.quotient).addr() as u64, markup as u64];
    let found = KNOWN.with_borrow_mut(|known| {
        known.key.clear();
        known.key.extend(head.into_iter().chain(f.variables.iter().map(name)));
        let hash = hash(&known.key);
        match known.texts.get(hash).filter(|text| *text.key == known.key) {
            Some(found) => Ok((found.template.filled(f, markup), found.counted)),
            None => Err((hash, known.key.as_slice().into())),
        }
    });
    let (hash, key) = match found {
        Ok((text, counted)) => {
            counted.again();
            return text;
        }
        Err(unknown) => unknown,
    };
    let quotient = f.quotient.clone();
    let (written, counted) = Counted::of(|| match nameless {
        true => {
            let variables = f.variables.iter().enumerate().map(placeholder).collect();
            write(&Fraction { variables, quotient: quotient.clone() }.into())
        }
        false => write(value),
    });
    let template = Template::of(&written, &f.variables);
    let filled = template.filled(f, markup);
    if let Some(counted) = counted {
        let text = Text { key, _quotient: quotient, template, counted };
        KNOWN.with_borrow_mut(|known| known.texts.put(hash, Box::new(text)));
    }
    filled
}

impl Template {
    /// Takes out the placeholders.
    fn of(written: &str, variables: &[Name]) -> Self {
        let mut template = Template::default();
        let mut rest = written;
        while let Some(at) = rest.find(is_placeholder) {
            let place = usize::from(rest.as_bytes()[at] - 1);
            template.letters.push_str(&rest[..at]);
            template.names.push((template.letters.len(), place));
            rest = &rest[at + variables[place].len()..];
        }
        template.letters.push_str(rest);
        template
    }

    /// The text with the names of the value.
    fn filled(&self, f: &Fraction, markup: Markup) -> String {
        let names = self.names.iter().map(|(_, place)| f.variables[*place].len()).sum::<usize>();
        let mut text = String::with_capacity(self.letters.len() + names);
        let mut from = 0;
        for (at, place) in &self.names {
            text.push_str(&self.letters[from..*at]);
            match markup {
                Markup::Text => text.push_str(&f.variables[*place]),
                Markup::Latex => text.push_str(&parameter(&f.variables[*place], markup)),
            }
            from = *at;
        }
        text.push_str(&self.letters[from..]);
        text
    }
}

/// What stands for a variable: as many times as its name has letters, the control character of its place.
fn placeholder((at, name): (usize, &Name)) -> Name {
    let letter = char::from(at as u8 + 1);
    Name::new(&std::iter::repeat_n(letter, name.len()).collect::<String>())
}

fn is_placeholder(letter: char) -> bool {
    ('\u{1}'..='\u{1f}').contains(&letter)
}
