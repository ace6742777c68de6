//! Printed values are evaluated at a point by an independent parser and an independent arithmetic.

use super::double_double::DoubleDouble;
use serde_json::Value;
use std::collections::BTreeMap;

/// A point: the values of names, and the partial derivatives of free functions.
#[derive(Debug, Default)]
pub struct Point {
    pub names: BTreeMap<String, DoubleDouble>,
    pub functions: Vec<FreeFunction>,
}

/// The partial derivatives of a free function at certain values of its arguments.
#[derive(Debug)]
pub struct FreeFunction {
    name: String,
    arguments: Vec<String>,
    at: Vec<DoubleDouble>,
    /// The derivatives by name: the arguments that are differentiated by, in order and joined by
    /// `_`.
    derivatives: BTreeMap<String, DoubleDouble>,
}

/// A number of the reference file: a decimal or a quotient.
pub fn number(text: &str) -> DoubleDouble {
    let number = |text: &str| DoubleDouble::parse(text).unwrap_or_else(|| panic!("{text}"));
    match text.split_once('/') {
        Some((above, below)) => number(above) / number(below),
        None => number(text),
    }
}

impl FreeFunction {
    pub fn read(row: &Value) -> Self {
        let texts = |key: &str| {
            let items = row[key].as_array().unwrap().iter();
            items.map(|item| item.as_str().unwrap().to_string()).collect::<Vec<_>>()
        };
        let derivatives = row["values"].as_object().unwrap().iter();
        FreeFunction {
            name: row["name"].as_str().unwrap().into(),
            arguments: texts("arguments"),
            at: texts("at").iter().map(|text| number(text)).collect(),
            derivatives: derivatives
                .map(|(by, value)| (by.clone(), number(value.as_str().unwrap())))
                .collect(),
        }
    }

    /// The derivative `f_x_y` at these arguments, if it belongs to this function and these values.
    fn value(&self, name: &str, arguments: &[DoubleDouble]) -> Option<DoubleDouble> {
        let by = name.strip_prefix(&self.name)?;
        // an argument is given by name, or by number from 1
        let argument = |by| str::parse::<usize>(by).map_or(by, |at| &self.arguments[at - 1]);
        let mut by: Vec<&str> = by.split('_').skip(1).map(argument).collect();
        let place = |name: &&str| self.arguments.iter().position(|other| other == name);
        by.sort_by_key(place);
        let near = |(a, b): (&DoubleDouble, &DoubleDouble)| {
            (*a - *b).high.abs() <= 1e-24 * (a.high.abs() + a.size)
        };
        let here = arguments.len() == self.at.len() && arguments.iter().zip(&self.at).all(near);
        here.then(|| self.derivatives.get(&by.join("_")).copied())?
    }
}

impl Point {
    /// The value of a printed expression.
    ///
    /// # Panics
    /// A text outside of the grammar, or a name without a value.
    pub fn value(&self, text: &str) -> DoubleDouble {
        let mut reader = Reader { text, rest: text, point: self };
        let value = reader.sum();
        assert!(reader.rest.trim().is_empty(), "`{}` is left of `{text}`", reader.rest);
        value
    }

    fn name(&self, name: &str) -> DoubleDouble {
        match self.names.get(name) {
            Some(value) => *value,
            None if name == "pi" => DoubleDouble::pi(),
            None => panic!("`{name}` has no value"),
        }
    }

    fn call(&self, name: &str, arguments: &[DoubleDouble]) -> DoubleDouble {
        if let [x] = arguments
            && let Some(value) = x.function(name)
        {
            return value;
        }
        let value = self.functions.iter().find_map(|free| free.value(name, arguments));
        value.unwrap_or_else(|| panic!("`{name}` has no value at {arguments:?}"))
    }
}

/// Recursive descent over `+ - * / ^`, numbers, names and calls.
struct Reader<'t> {
    text: &'t str,
    rest: &'t str,
    point: &'t Point,
}

impl Reader<'_> {
    fn take(&mut self, symbol: &str) -> bool {
        let rest = self.rest.trim_start().strip_prefix(symbol);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn word(&mut self, of: impl Fn(char) -> bool) -> String {
        let rest = self.rest.trim_start();
        let end = rest.find(|c| !of(c)).unwrap_or(rest.len());
        self.rest = &rest[end..];
        rest[..end].into()
    }

    fn sum(&mut self) -> DoubleDouble {
        let mut value = self.product();
        loop {
            if self.take("+") {
                value = value + self.product();
            } else if self.take("-") {
                value = value - self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> DoubleDouble {
        let mut value = self.sign();
        loop {
            if self.take("*") {
                value = value * self.sign();
            } else if self.take("/") {
                value = value / self.sign();
            } else {
                return value;
            }
        }
    }

    fn sign(&mut self) -> DoubleDouble {
        if self.take("-") { -self.sign() } else { self.power() }
    }

    fn power(&mut self) -> DoubleDouble {
        let base = self.atom();
        if !self.take("^") {
            return base;
        }
        // one factor, or a sum in parentheses
        let exponent = self.sign();
        base.power(exponent)
    }

    fn atom(&mut self) -> DoubleDouble {
        if self.take("(") {
            let value = self.sum();
            assert!(self.take(")"), "`)` is missing before `{}` in `{}`", self.rest, self.text);
            return value;
        }
        let digits = self.word(|c| c.is_ascii_digit() || c == '.');
        if !digits.is_empty() {
            return number(&digits);
        }
        let name = self.word(|c| c.is_alphanumeric() || c == '_');
        assert!(!name.is_empty(), "`{}` begins with no value, in `{}`", self.rest, self.text);
        if !self.take("(") {
            return self.point.name(&name);
        }
        let mut arguments = vec![self.sum()];
        while self.take(",") {
            arguments.push(self.sum());
        }
        assert!(self.take(")"), "`)` is missing before `{}` in `{}`", self.rest, self.text);
        self.point.call(&name, &arguments)
    }
}
