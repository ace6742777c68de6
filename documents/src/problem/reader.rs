//! Reads numbers and formulas of a problem, which may contain the parameters that are declared so
//! far.

use crate::input::{
    InputError, Place, Source,
    forms::{Formulas, Number, Text},
    shown,
};
use crate::space::notation::check_name;
use affinor::mechanics::formula::Formula;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DMatrix;
use std::cell::RefCell;
use std::path::Path;

/// The names of constants. A parameter must not have such a name.
const NUMBERS: [&str; 2] = ["pi", "tau"];

/// The text of a formula, and its location.
#[derive(Clone, Debug)]
pub(super) struct Written {
    /// The file. Its excerpt is the formula, if the formula comes from the file.
    source: Source,
    /// The formula, if it does not come from a file.
    own: Option<String>,
}

impl Written {
    /// A formula that does not come from a file. Error messages about the formula name `source`.
    pub fn beside(source: &Source, text: impl Into<String>) -> Self {
        Written { source: source.clone(), own: Some(text.into()) }
    }

    pub fn text(&self) -> &str {
        self.own.as_deref().unwrap_or(self.source.content())
    }

    pub fn place(&self) -> Place {
        self.source.whole(self.text())
    }

    /// The formula as a source whose pieces have locations.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Converts an error in the formula, and adds its location.
    pub fn refused(&self, error: ExpressionError, help: impl Into<String>) -> InputError {
        let place = self.source.find(self.text(), error.span);
        InputError::usage(error.reason).at(&place).help(help)
    }
}

/// A number as a formula in the parameters.
#[derive(Clone, Debug)]
pub(super) struct Value {
    formula: Formula,
    written: Written,
}

impl Value {
    /// A constant number that does not come from a file.
    pub fn constant(source: &Source, number: f64) -> Self {
        let written = Written::beside(source, number.to_string());
        Value { formula: Formula::number(number), written }
    }

    pub fn place(&self) -> Place {
        self.written.place()
    }

    /// The value, for these values of the parameters.
    pub fn at(&self, parameters: &[f64]) -> Result<f64, InputError> {
        let value = self.formula.value(parameters);
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!(
            "the value of `{}` is {value}, which is not finite",
            shown(self.written.text())
        );
        Err(InputError::mathematics(message).at(&self.place()))
    }

    /// The value, for these values of the parameters. It must be positive.
    pub fn positive(&self, parameters: &[f64]) -> Result<f64, InputError> {
        let value = self.at(parameters)?;
        if value > 0.0 {
            return Ok(value);
        }
        Err(InputError::usage(format!("the value {value} is not positive")).at(&self.place()))
    }

    /// The values of a list of numbers.
    pub fn all(list: &[Value], parameters: &[f64]) -> Result<Vec<f64>, InputError> {
        list.iter().map(|value| value.at(parameters)).collect()
    }

    /// The matrix with these rows. Messages call it `what`.
    pub fn matrix(
        what: &str,
        rows: &[Vec<Value>],
        parameters: &[f64],
        place: &Place,
    ) -> Result<DMatrix<f64>, InputError> {
        let width = rows.first().map_or(0, Vec::len);
        if rows.iter().any(|row| row.len() != width) {
            let message = format!("the rows of the {what} have different lengths");
            return Err(InputError::usage(message).at(place));
        }
        let entries: Result<Vec<f64>, _> =
            rows.iter().flatten().map(|value| value.at(parameters)).collect();
        Ok(DMatrix::from_row_slice(rows.len(), width, &entries?))
    }

    /// The values of a list, which must have one component for each dimension of the algebra.
    /// Messages call the list `what`.
    pub fn vector(
        what: &str,
        list: &[Value],
        dimension: usize,
        parameters: &[f64],
        place: &Place,
    ) -> Result<Vec<f64>, InputError> {
        if list.len() != dimension {
            let found = list.len();
            let message =
                format!("{what} has {found} components, but the dimension is {dimension}");
            return Err(InputError::usage(message).at(place));
        }
        Value::all(list, parameters)
    }
}

/// Reads formulas, which may contain the parameters that are declared so far.
pub(super) struct Reader<'s> {
    pub source: &'s Source,
    /// The parameters that are declared so far.
    pub names: Vec<String>,
    folder: &'s Path,
    files: RefCell<Vec<String>>,
}

impl<'s> Reader<'s> {
    /// Creates a reader of a file in the folder `folder`.
    pub fn new(source: &'s Source, folder: &'s Path) -> Self {
        Reader { source, names: vec![], folder, files: RefCell::default() }
    }

    /// The path of another file to which the problem refers. The reader records it.
    pub fn file(&self, name: &str) -> String {
        let path = self.folder.join(name).to_string_lossy().into_owned();
        self.files.borrow_mut().push(path.clone());
        path
    }

    /// The paths of all other files, once the problem is read.
    pub fn into_files(self) -> Vec<String> {
        self.files.into_inner()
    }

    pub fn written(&self, text: &Text) -> Written {
        Written { source: self.source.excerpt(text), own: None }
    }

    pub fn value(&self, Number(text): &Number) -> Result<Value, InputError> {
        self.value_of(self.written(text))
    }

    /// Reads the whole source as a number.
    pub fn whole(&self) -> Result<Value, InputError> {
        self.value_of(Written { source: self.source.clone(), own: None })
    }

    fn value_of(&self, written: Written) -> Result<Value, InputError> {
        let names = &self.names;
        let formula =
            Formula::parse(written.text(), &mut |name| names.iter().position(|own| own == name));
        let help = || match names.as_slice() {
            [] => "there are no parameters, only pi and tau".to_string(),
            names => format!("the parameters are {}", names.join(", ")),
        };
        let formula = formula.map_err(|error| written.refused(error, help()))?;
        Ok(Value { formula, written })
    }

    pub fn values(&self, list: &[Number]) -> Result<Vec<Value>, InputError> {
        list.iter().map(|number| self.value(number)).collect()
    }

    pub fn rows(&self, rows: &[Vec<Number>]) -> Result<Vec<Vec<Value>>, InputError> {
        rows.iter().map(|row| self.values(row)).collect()
    }

    pub fn optional(&self, number: &Option<Number>) -> Result<Option<Value>, InputError> {
        number.as_ref().map(|number| self.value(number)).transpose()
    }

    pub fn optional_values(
        &self,
        list: &Option<Vec<Number>>,
    ) -> Result<Option<Vec<Value>>, InputError> {
        list.as_ref().map(|list| self.values(list)).transpose()
    }

    /// Reads the formulas of a table, each with its name.
    pub fn formulas(&self, table: &Option<Formulas>) -> Result<Vec<(String, Written)>, InputError> {
        let named = table.iter().flat_map(|table| &table.0).map(|(name, text)| {
            check_name(name).map_err(|error| error.at(&self.source.at(name)))?;
            Ok((name.to_string(), self.written(text)))
        });
        named.collect()
    }

    /// Declares a parameter.
    pub fn declare(&mut self, name: &Text) -> Result<(), InputError> {
        let place = self.source.at(name);
        check_name(name).map_err(|error| error.at(&place))?;
        if NUMBERS.contains(&&**name) || self.names.contains(&name.content) {
            let message = format!("the name `{}` is already in use", &**name);
            return Err(InputError::usage(message).at(&place).help("choose another name"));
        }
        self.names.push(name.to_string());
        Ok(())
    }

    /// Returns an error if the file contains one of these keys, given by their dotted paths,
    /// because the class of problems `what` ignores them.
    pub fn refuse(&self, what: &str, keys: &[&str]) -> Result<(), InputError> {
        let Some(path) = keys.iter().find(|path| self.source.has_key(path)) else { return Ok(()) };
        let key = path.rsplit('.').next().unwrap_or(path);
        let error = self.source.refused(path, format!("{what} has no `{key}`"));
        Err(error.help("leave the key out"))
    }

    /// Returns an error for a key if its value is empty.
    pub fn refuse_empty(&self, path: &str, is_empty: bool) -> Result<(), InputError> {
        if !is_empty {
            return Ok(());
        }
        let key = path.rsplit('.').next().unwrap_or(path);
        let error = self.source.refused(path, format!("`{key}` is empty"));
        Err(error.help("leave the key out"))
    }
}
