//! Expressions of tensors with index letters, such as `R^i_jkl + 1/4*c^m_kl c^i_mj`, evaluated on a
//! geometry.
//!
//! An index is a letter, a number from 1, or the name of a basis vector or a coordinate. A letter
//! that occurs twice in a product, once upper and once lower, is summed. If the level of an index
//! differs from the level in a table, the metric raises or lowers the index. A tensor without
//! indices means the whole tensor.

mod notation;

pub(super) use notation::{Index, Names, Occurrence, Parsed};

use super::components::scripts;
use super::{Quantity, text};
use crate::Coefficient;
use affinor::Geometry;
use affinor_tensors::contraction::indices;
use affinor_tensors::expression::{Evaluator, ExpressionError, Scalars};
use affinor_tensors::{Down, Rational, Tensor, Up, Variance, contract};
use std::cell::RefCell;

/// A tensor with a letter for each of its slots.
#[derive(Clone, Debug)]
pub(super) struct Indexed<S> {
    pub letters: Vec<char>,
    /// The letters over which a sum was taken.
    summed: Vec<char>,
    pub tensor: Tensor<S>,
}

/// Letters for the slots of a tensor that is written without indices.
pub(super) const WHOLE: [char; 5] = ['α', 'β', 'γ', 'δ', 'ε'];

/// A function from names to their values.
type Values<'a, S> = &'a dyn Fn(&str) -> Result<S, String>;

/// The tensors of a geometry, each computed once.
pub(super) struct Tensors<'a, S> {
    geometry: &'a Geometry<S>,
    known: RefCell<Vec<(Quantity, Tensor<S>)>>,
    /// The values of parameters and coordinates.
    scalars: Values<'a, S>,
}

/// The evaluator for one expression.
struct Meaning<'a, S> {
    tensors: &'a Tensors<'a, S>,
    occurrences: &'a [Occurrence],
}

impl<S: Coefficient> Indexed<S> {
    fn scalar(&self) -> Option<S> {
        self.tensor.to_scalar()
    }

    /// Whether the value is the number 0, which may be compared with every tensor.
    fn is_zero_number(&self) -> bool {
        self.letters.is_empty() && self.tensor.is_empty()
    }

    /// The difference `self - other`, with the letters of `self`. The number 0 fits any letters.
    ///
    /// # Errors
    /// A message if the two sides have different letters, or a letter at different levels.
    pub fn minus(&self, other: &Self) -> Result<Self, String> {
        self.combine(other, "-")
    }

    fn combine(&self, other: &Self, sign: &str) -> Result<Self, String> {
        if other.is_zero_number() {
            return Ok(self.clone());
        }
        if self.is_zero_number() {
            return Ok(if sign == "-" { other.negative() } else { other.clone() });
        }
        let place = |letter| self.letters.iter().position(|other| *other == letter);
        let same = self.letters.len() == other.letters.len()
            && other.letters.iter().zip(other.tensor.slots()).all(|(letter, slot)| {
                place(*letter).is_some_and(|at| self.tensor.slots()[at] == *slot)
            });
        if !same {
            let [mine, theirs] = [self, other].map(Self::described);
            return Err(format!("the terms have different indices: {mine} and {theirs}"));
        }
        let ([a, b], result) = ([self, other].map(Self::indices), self.indices());
        let operands = [("a", &self.tensor), ("b", &other.tensor)];
        let tensor = contract(&format!("a{a} {sign} b{b} -> {result}"), &operands);
        let tensor = tensor.map_err(|error| error.to_string())?;
        let summed = [&self.summed[..], &other.summed].concat();
        Ok(Indexed { letters: self.letters.clone(), summed, tensor })
    }

    fn negative(&self) -> Self {
        Indexed { tensor: self.tensor.map(|value| -value.clone()), ..self.clone() }
    }

    fn times(&self, other: &Self) -> Result<Self, String> {
        for (one, two) in [(self, other), (other, self)] {
            let used = |letter: &&char| two.letters.contains(letter) || two.summed.contains(letter);
            if let Some(letter) = one.summed.iter().find(used) {
                return Err(format!("the summed index {letter} occurs more than twice"));
            }
        }
        let all = || self.slots().chain(other.slots());
        let twice = |letter: char| all().filter(|(other, _)| *other == letter).count() > 1;
        let result: Vec<_> = all().filter(|(letter, _)| !twice(*letter)).collect();
        for (letter, slot) in self.slots() {
            if other.slots().any(|other| other == (letter, slot)) {
                return Err(match WHOLE.contains(&letter) {
                    true => "a product of tensors needs indices: write the indices of both".into(),
                    false => {
                        format!("the summed index {letter} must occur once upper and once lower")
                    }
                });
            }
        }
        let [a, b] = [self, other].map(Self::indices);
        let operands = [("a", &self.tensor), ("b", &other.tensor)];
        let product = format!("a{a} b{b} -> {}", indices(result.iter().copied()));
        let tensor = contract(&product, &operands).map_err(|error| error.to_string())?;
        let mut summed = [&self.summed[..], &other.summed].concat();
        summed.extend(self.letters.iter().filter(|letter| twice(**letter)));
        Ok(Indexed {
            letters: result.into_iter().map(|(letter, _)| letter).collect(),
            summed,
            tensor,
        })
    }

    fn slots(&self) -> impl Iterator<Item = (char, Variance)> {
        self.letters.iter().copied().zip(self.tensor.slots().iter().copied())
    }

    fn indices(&self) -> String {
        indices(self.slots())
    }

    /// The indices as text for a message: `^i_jk`.
    fn described(&self) -> String {
        match self.letters.as_slice() {
            [] => "none".into(),
            [first, ..] if WHOLE.contains(first) => {
                let marks = |slot: &Variance| if *slot == Up { "upper" } else { "lower" };
                let slots: Vec<_> = self.tensor.slots().iter().map(marks).collect();
                slots.join(", ")
            }
            _ => {
                let letters = self.letters.iter().map(char::to_string);
                text::join("", scripts(0, self.tensor.slots(), letters))
            }
        }
    }
}

impl<'a, S: Coefficient> Tensors<'a, S> {
    pub fn new(geometry: &'a Geometry<S>, scalars: Values<'a, S>) -> Self {
        Tensors { geometry, known: RefCell::default(), scalars }
    }

    /// The value of an expression.
    ///
    /// # Errors
    /// An error for unknown names, tensors that are not defined for the geometry, and sums and
    /// products whose indices do not fit.
    pub fn value(&self, parsed: &Parsed) -> Result<Indexed<S>, ExpressionError> {
        parsed.expression.evaluate(&Meaning { tensors: self, occurrences: &parsed.occurrences })
    }

    fn tensor(&self, quantity: Quantity) -> Result<Tensor<S>, String> {
        if let Some((_, tensor)) = self.known.borrow().iter().find(|(known, _)| *known == quantity)
        {
            return Ok(tensor.clone());
        }
        let tensor = quantity.of(self.geometry).map_err(|error| error.to_string())?;
        let key = quantity.key();
        let tensor = tensor.ok_or_else(|| format!("{key} is not defined for this space"))?;
        self.known.borrow_mut().push((quantity, tensor.clone()));
        Ok(tensor)
    }

    /// The value of a tensor with its indices in an expression.
    fn indexed(&self, occurrence: &Occurrence) -> Result<Indexed<S>, String> {
        let mut tensor = self.tensor(occurrence.quantity)?;
        let Some(written) = &occurrence.indices else {
            let letters = WHOLE[..tensor.rank()].to_vec();
            return Ok(Indexed { letters, summed: vec![], tensor });
        };
        for (slot, (_, variance)) in written.iter().enumerate() {
            if tensor.slots()[slot] == *variance {
                continue;
            }
            let Some(metric) = self.geometry.metric() else {
                let own = text::general(occurrence.quantity, &tensor);
                return Err(format!(
                    "without a metric, the indices of {own} cannot be raised or lowered"
                ));
            };
            let shifted = match variance {
                Up => tensor.raise(slot, metric.inverse()),
                Down => tensor.lower(slot, metric.components()),
            };
            tensor = shifted.map_err(|error| error.to_string())?;
        }
        let mut letters = Vec::new();
        for (slot, (index, variance)) in written.iter().enumerate().rev() {
            match *index {
                Index::Number(at) => {
                    tensor = tensor.slice(slot, at).map_err(|error| error.to_string())?;
                }
                Index::Letter(letter) => letters.insert(0, (letter, *variance)),
            }
        }
        let times = |letter: char| letters.iter().filter(|(other, _)| *other == letter).count();
        let free: Vec<_> = letters.iter().copied().filter(|(at, _)| times(*at) == 1).collect();
        let mut summed: Vec<char> = letters.iter().map(|(letter, _)| *letter).collect();
        summed.retain(|letter| times(*letter) > 1);
        let is_twice =
            |at: &(char, Variance)| letters.iter().filter(|other| *other == at).count() > 1;
        if let Some((letter, _)) = letters.iter().find(|at| is_twice(at)) {
            return Err(format!("the summed index {letter} must occur once upper and once lower"));
        }
        if !summed.is_empty() {
            let trace = format!(
                "a{} -> {}",
                indices(letters.iter().copied()),
                indices(free.iter().copied())
            );
            tensor = contract(&trace, &[("a", &tensor)]).map_err(|error| error.to_string())?;
        }
        Ok(Indexed {
            letters: free.into_iter().map(|(letter, _)| letter).collect(),
            summed,
            tensor,
        })
    }
}

impl<S: Coefficient> Meaning<'_, S> {
    fn number_of(&self, value: S) -> Result<Indexed<S>, String> {
        let structure = self.tensors.geometry.frame().structure_functions();
        let tensor = Tensor::from_components(structure.dimension(), &[], [([], value)]);
        let tensor = tensor.map_err(|error| error.to_string())?;
        let tensor = tensor.with_tolerance(structure.tolerance());
        Ok(Indexed { letters: vec![], summed: vec![], tensor })
    }

    /// The evaluator of numbers, which limits the size of values.
    fn scalars(&self) -> impl Evaluator<Value = S> {
        Scalars(self.tensors.scalars, |name: &str, arguments: &[S]| S::call(name, arguments))
    }

    /// The values of numbers. A tensor is an error, because the operation is not defined for
    /// tensors.
    fn numbers(values: &[Indexed<S>], operation: &str) -> Result<Vec<S>, String> {
        let number = |value: &Indexed<S>| {
            value.scalar().ok_or_else(|| {
                format!("{operation} of a tensor, with the indices {}", value.described())
            })
        };
        values.iter().map(number).collect()
    }
}

impl<S: Coefficient> Evaluator for Meaning<'_, S> {
    type Value = Indexed<S>;

    fn number(&self, number: &Rational) -> Result<Indexed<S>, String> {
        self.number_of(self.scalars().number(number)?)
    }

    fn name(&self, name: &str) -> Result<Indexed<S>, String> {
        match self.occurrences.iter().find(|occurrence| occurrence.placeholder == name) {
            Some(occurrence) => self.tensors.indexed(occurrence),
            None => self.number_of((self.tensors.scalars)(name)?),
        }
    }

    fn add(&self, a: Indexed<S>, b: Indexed<S>) -> Result<Indexed<S>, String> {
        a.combine(&b, "+")
    }

    fn multiply(&self, a: Indexed<S>, b: Indexed<S>) -> Result<Indexed<S>, String> {
        match (a.scalar(), b.scalar()) {
            (Some(x), Some(y)) => {
                let product = self.number_of(self.scalars().multiply(x, y)?)?;
                Ok(Indexed { summed: a.times(&b)?.summed, ..product })
            }
            _ => a.times(&b),
        }
    }

    fn negate(&self, a: Indexed<S>) -> Indexed<S> {
        a.negative()
    }

    fn reciprocal(&self, a: Indexed<S>) -> Result<Indexed<S>, String> {
        let [a] = [Self::numbers(&[a], "the reciprocal")?.remove(0)];
        self.number_of(self.scalars().reciprocal(a)?)
    }

    fn raise(&self, base: Indexed<S>, exponent: Indexed<S>) -> Result<Indexed<S>, String> {
        let mut values = Self::numbers(&[base, exponent], "a power")?.into_iter();
        match (values.next(), values.next()) {
            (Some(base), Some(exponent)) => self.number_of(self.scalars().raise(base, exponent)?),
            _ => Err("the base or the exponent of this power is missing".into()),
        }
    }

    fn call(&self, name: &str, arguments: Vec<Indexed<S>>) -> Result<Indexed<S>, String> {
        let arguments = Self::numbers(&arguments, &format!("the function {name}"))?;
        self.number_of(self.scalars().call(name, arguments)?)
    }
}
