//! Names for factors that occur in several values.

use super::denominator::Factor;
use super::fraction::Fraction;
use super::polynomial::Polynomial;
use super::variable::{Kind, Variables};
use super::{Form, Symbolic, normal_form};
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex};

/// Sums that occur in the denominators of several values. Each has a name, such as `D = a^2 + b`.
///
/// [`Tabular::common_factors`](crate::Tabular::common_factors) finds these sums.
/// [`Tabular::text_with`](crate::Tabular::text_with) writes values with the names.
///
/// ```
/// use affinor_tensors::{Notation, Symbolic, Tabular};
/// let values: Vec<Symbolic> = ["a", "b", "c"]
///     .map(|name| format!("{name}/(alpha*gamma - beta^2)^2").parse())
///     .into_iter()
///     .collect::<Result<_, _>>()?;
/// let factors = Symbolic::common_factors(&mut values.iter(), &[]);
/// let named: Vec<_> = factors.iter().collect();
/// assert_eq!(named, [("D", "alpha*gamma - beta^2".parse()?)]);
/// assert_eq!(values[0].text_with(&factors), "a/D^2");
/// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
/// ```
#[derive(Debug, Default)]
pub struct CommonFactors {
    named: Vec<(String, Arc<Factor>)>,
    /// A cache of the written forms of values that contain functions.
    written: Mutex<HashMap<Symbolic, Symbolic>>,
}

/// A factor has a name only if its text has at least this length. Shorter sums are written out.
const SHORTEST: usize = 16;

/// Each name is one of these letters, or begins with one of them.
const LETTERS: [&str; 4] = ["D", "W", "Q", "D_"];

impl CommonFactors {
    /// Whether there are no factors with names.
    pub fn is_empty(&self) -> bool {
        self.named.is_empty()
    }

    /// The names, and the values that they abbreviate. In these values, sines and cosines are
    /// variables without relations, so the values can only be written.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Symbolic)> {
        self.named.iter().map(|(name, factor)| (name.as_str(), value(factor)))
    }

    /// The name of a factor.
    pub(super) fn name(&self, factor: &Arc<Factor>) -> Option<&str> {
        let same = |other: &Arc<Factor>| Arc::ptr_eq(factor, other) || same(factor, other);
        let found = self.named.iter().find(|(_, other)| same(other));
        found.map(|(name, _)| name.as_str())
    }

    /// The name of a polynomial. Returns `None` if it is not one of the factors.
    pub(super) fn of_polynomial(&self, variables: &Variables, f: &Polynomial) -> Option<&str> {
        if self.named.iter().all(|(_, other)| other.polynomial.terms.len() != f.terms.len()) {
            return None;
        }
        self.name(&Factor::new(variables, f, false))
    }

    /// The written form of a value.
    pub(super) fn written<'v>(&self, value: &'v Symbolic) -> Cow<'v, Symbolic> {
        if !value.has_written_form() {
            return Cow::Borrowed(value);
        }
        let known = |forms: &HashMap<Symbolic, Symbolic>| forms.get(value).cloned();
        if let Some(form) = self.written.lock().ok().and_then(|forms| known(&forms)) {
            return Cow::Owned(form);
        }
        let form = normal_form::written(value);
        if let Ok(mut forms) = self.written.lock() {
            forms.insert(value.clone(), form.clone());
        }
        Cow::Owned(form)
    }

    /// Finds the factors for which a name shortens the text. The parameter `taken` contains names
    /// that are in use.
    pub(super) fn of(values: &mut dyn Iterator<Item = &Symbolic>, taken: &[String]) -> Self {
        let mut factors = CommonFactors::default();
        let mut found: Vec<(Arc<Factor>, usize)> = Vec::new();
        let mut places: HashMap<*const Factor, usize> = HashMap::new();
        let mut forms = Vec::new();
        let mut functions = BTreeSet::new();
        for value in values {
            let form = factors.written(value).into_owned();
            let Form::Fraction(f) = form.0 else { continue };
            functions.extend(f.variables.iter().filter_map(|variable| match variable.kind() {
                Kind::Applied(applied) => Some(applied.name.to_string()),
                _ => None,
            }));
            for (factor, _) in &f.denominator.factors {
                let known = places.get(&Arc::as_ptr(factor)).copied();
                let at = known.or_else(|| found.iter().position(|(f, _)| same(f, factor)));
                let at = at.unwrap_or_else(|| {
                    found.push((factor.clone(), 0));
                    found.len() - 1
                });
                places.insert(Arc::as_ptr(factor), at);
                found[at].1 += 1;
            }
            // stores the forms, because they must exist while their addresses are compared
            forms.extend(value.has_written_form().then_some(f));
        }
        found.retain(|(factor, count)| {
            let length = value(factor).to_string().len();
            // a name replaces "(...)" by "D1" in each place, but adds one line "D1 = ..."
            length >= SHORTEST && count * length > length + "where D1 = ".len() + 1
        });
        let prefix = LETTERS.into_iter().find(|letter| {
            let clash = |name: &String| {
                let rest = name.strip_prefix(letter);
                rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
            };
            !taken.iter().chain(&functions).any(clash)
        });
        let Some(prefix) = prefix else { return factors };
        let number = |at: usize| if found.len() > 1 { (at + 1).to_string() } else { String::new() };
        let named = found.iter().enumerate();
        factors.named =
            named.map(|(at, (f, _))| (format!("{prefix}{}", number(at)), f.clone())).collect();
        factors
    }
}

/// Whether two factors are the same polynomial. It need not be known whether the factors are
/// irreducible.
fn same(a: &Factor, b: &Factor) -> bool {
    a.variables == b.variables && a.polynomial == b.polynomial
}

fn value(factor: &Factor) -> Symbolic {
    let (variables, numerator) = (factor.variables.clone(), factor.polynomial.clone());
    Fraction::new(variables, numerator, Default::default()).into()
}
