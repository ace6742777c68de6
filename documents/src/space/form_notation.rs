//! Differential forms in formulas, such as `r^2*sin(theta)*dtheta^dphi`.
//!
//! `dr` is the differential of the coordinate `r`, the name of a basis vector is its dual form, and
//! `^` between forms is the exterior product.

use super::Definition;
use super::formulas::ChartFormulas;
use super::notation::{Names, scalars};
use crate::input::{InputError, Source};
use affinor::algebra::frame::Frame;
use affinor::{Form, Geometry};
use affinor_tensors::expression::{Evaluator, POWER};
use affinor_tensors::{Rational, Ring, Symbolic};
use std::collections::BTreeMap;

/// The largest number of components of a form in a formula.
const MAX_COMPONENTS: usize = 10_000;

impl Definition {
    /// Parses a differential form in the frame of the geometry of this definition.
    ///
    /// # Errors
    /// An error with its location for an invalid expression, and for a sum of forms of different
    /// degrees.
    pub fn form(
        &self,
        text: &str,
        geometry: &Geometry<Symbolic>,
    ) -> Result<Form<Symbolic>, InputError> {
        let source = Source::new("--form", text);
        let formulas = self.formulas(&[]);
        let differentials = self.differentials(geometry.frame());
        let meaning = Forms { formulas: &formulas, differentials: &differentials };
        let names = formulas.names();
        let found = names.read(source.content(), &source, &meaning);
        let help = || {
            format!("forms are {}", differentials.keys().cloned().collect::<Vec<_>>().join(", "))
        };
        let found = found.map_err(|error| match error.help {
            None => error.help(help()),
            Some(_) => error,
        })?;
        let n = self.dimension();
        if found.degree > n {
            let degree = found.degree;
            let message = format!("a form of degree {degree} in dimension {n} is zero");
            return Err(InputError::usage(message).at(&source.whole(text)));
        }
        Ok(Form::from_increasing(n, found.degree, found.entries)?)
    }

    /// The 1-forms that formulas may name, by their components in the frame.
    fn differentials(&self, frame: &Frame<Symbolic>) -> BTreeMap<String, Vec<Symbolic>> {
        let n = self.dimension();
        let unit =
            |i: usize| (0..n).map(|j| Symbolic::from_i64(i64::from(i == j))).collect::<Vec<_>>();
        let duals = self.labels.iter().enumerate().map(|(i, label)| (label.clone(), unit(i)));
        let coordinates = self.coordinates().iter().map(|name| {
            let function = Symbolic::parameter(name);
            let components = (0..n).map(|k| frame.derive(k, &function)).collect();
            (format!("d{name}"), components)
        });
        duals.chain(coordinates).collect()
    }
}

/// A sum of products of 1-forms, by increasing indices.
#[derive(Clone, Debug)]
struct Exterior {
    /// The degree. The zero of degree 0 is also the zero of every other degree.
    degree: usize,
    entries: BTreeMap<Vec<usize>, Symbolic>,
}

impl Exterior {
    fn new(degree: usize, entries: BTreeMap<Vec<usize>, Symbolic>) -> Self {
        let entries: BTreeMap<_, _> = entries.into_iter().filter(|(_, v)| !v.vanishes()).collect();
        Exterior { degree, entries }
    }

    fn function(value: Symbolic) -> Self {
        Exterior::new(0, [(vec![], value)].into())
    }

    /// The function; `None` for a form of positive degree.
    fn as_function(&self) -> Option<Symbolic> {
        let value = || self.entries.values().next().cloned();
        (self.degree == 0).then(|| value().unwrap_or_else(|| Symbolic::from_i64(0)))
    }

    fn wedge(&self, other: &Self) -> Result<Self, String> {
        let mut entries: BTreeMap<Vec<usize>, Symbolic> = BTreeMap::new();
        for (left, a) in &self.entries {
            for (right, b) in &other.entries {
                if left.iter().any(|i| right.contains(i)) {
                    continue;
                }
                let moves: usize =
                    left.iter().map(|i| right.iter().filter(|j| *j < i).count()).sum();
                let mut at = [left.as_slice(), right.as_slice()].concat();
                at.sort_unstable();
                let term = scalars().multiply(a.clone(), b.clone())?;
                let term = if moves % 2 == 1 { -term } else { term };
                let sum = entries.entry(at).or_insert_with(|| Symbolic::from_i64(0));
                *sum = scalars().add(sum.clone(), term)?;
                if entries.len() > MAX_COMPONENTS {
                    return Err(format!("the form has more than {MAX_COMPONENTS} components"));
                }
            }
        }
        Ok(Exterior::new(self.degree + other.degree, entries))
    }
}

/// Evaluates forms.
struct Forms<'n> {
    formulas: &'n ChartFormulas<'n>,
    differentials: &'n BTreeMap<String, Vec<Symbolic>>,
}

impl Forms<'_> {
    fn names(&self) -> Names<'_> {
        self.formulas.names()
    }
}

impl Evaluator for Forms<'_> {
    type Value = Exterior;
    fn number(&self, number: &Rational) -> Result<Exterior, String> {
        Ok(Exterior::function(Symbolic::constant(number.clone())))
    }
    fn name(&self, name: &str) -> Result<Exterior, String> {
        match self.differentials.get(name) {
            Some(components) => {
                let entries = components.iter().enumerate();
                Ok(Exterior::new(1, entries.map(|(i, v)| (vec![i], v.clone())).collect()))
            }
            None => self.names().parameter(name).map(Exterior::function),
        }
    }
    fn add(&self, a: Exterior, b: Exterior) -> Result<Exterior, String> {
        let is_zero = |form: &Exterior| form.degree == 0 && form.entries.is_empty();
        let degree = match (a.degree, b.degree) {
            (p, q) if p == q || is_zero(&b) => p,
            (_, q) if is_zero(&a) => q,
            (p, q) => {
                return Err(format!("a form of degree {p} and one of degree {q} have no sum"));
            }
        };
        let mut entries = a.entries;
        for (at, value) in b.entries {
            let sum = entries.entry(at).or_insert_with(|| Symbolic::from_i64(0));
            *sum = scalars().add(sum.clone(), value)?;
        }
        Ok(Exterior::new(degree, entries))
    }
    fn multiply(&self, a: Exterior, b: Exterior) -> Result<Exterior, String> {
        if a.as_function().is_none() && b.as_function().is_none() {
            return Err("write `^` between two forms, as in dx^dy".into());
        }
        a.wedge(&b)
    }
    fn negate(&self, a: Exterior) -> Exterior {
        Exterior { entries: a.entries.into_iter().map(|(at, value)| (at, -value)).collect(), ..a }
    }
    fn reciprocal(&self, a: Exterior) -> Result<Exterior, String> {
        let function = a.as_function().ok_or("a form cannot divide")?;
        scalars().reciprocal(function).map(Exterior::function)
    }
    fn raise(&self, base: Exterior, exponent: Exterior) -> Result<Exterior, String> {
        match (base.as_function(), exponent.as_function()) {
            (Some(base), Some(exponent)) => {
                self.names().call(POWER, &[base, exponent]).map(Exterior::function)
            }
            (None, Some(_)) => Err("a form has no powers".into()),
            _ => base.wedge(&exponent),
        }
    }
    fn call(&self, name: &str, arguments: Vec<Exterior>) -> Result<Exterior, String> {
        let arguments = arguments.iter().map(Exterior::as_function).collect::<Option<Vec<_>>>();
        let arguments = arguments.ok_or("a form cannot be an argument")?;
        self.names().call(name, &arguments).map(Exterior::function)
    }
}
