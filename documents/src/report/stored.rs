//! Stored tables, and their comparison with computed tables.

mod convention;
mod differences;

pub use convention::Convention;
pub use differences::{Differences, Verification};

use super::components::{plain, representatives, with_names};
use super::factors::NamedFactors;
use super::json::variances;
use super::{Quantity, Table, TableEntry};
use crate::Coefficient;
use crate::input::{
    InputError, Place, Source,
    file::{bytes, decode},
};
use affinor_tensors::expression::{Expression, Scalars, is_name};
use affinor_tensors::{Kind, Rational, Tensor, Variance};
use differences::compare;
use serde_json::Value;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// A table read from JSON (`affinor.table/1`) or CSV. Values are stored as text, because the scalar
/// type is not known yet.
#[derive(Clone, Debug)]
pub struct StoredTable {
    /// The location of the file.
    place: Place,
    /// The name of the connection, if the file contains it.
    connection: Option<String>,
    /// The names of the basis vectors, if the file contains them.
    basis: Option<Vec<String>>,
    /// The dimension, if the file contains it.
    dimension: Option<usize>,
    /// The frame, such as `left-invariant`, if the file contains it.
    frame: Option<String>,
    /// The scalar type, if the file contains it.
    scalar: Option<String>,
    /// Whether only independent components are listed.
    independent: bool,
    tensors: Vec<(Quantity, Vec<Component>)>,
    /// Tensors that were chosen but that the file does not contain.
    missing: Vec<Quantity>,
    /// The variances of the slots of tensors, such as `["up","down"]`, as far as the file contains
    /// them.
    slots: Vec<(Quantity, Value)>,
    /// The names of common factors that occur in values, each with its factor as text.
    names: Vec<(String, String)>,
    /// Whether the format also lists tensors that vanish: JSON lists them, but CSV does not.
    lists_zeros: bool,
}

/// The indices of a component (from 0), and its value as text.
type Component = (Vec<usize>, String);

/// The largest size of a stored table, in bytes.
const MAX_BYTES: u64 = 1 << 32;
/// Advice for a table without rows.
const NAMED: &str = "--show names the tensors";

impl StoredTable {
    /// Reads a stored table from a file, like [`parse`](Self::parse).
    ///
    /// # Errors
    /// An error for a file that cannot be read, and for a text that is not a table.
    pub fn read(path: &str) -> Result<Self, InputError> {
        let (name, bytes) = bytes(path, MAX_BYTES)?;
        Self::of_source(decode(&name, &bytes)?)
    }

    /// Parses a stored table: JSON if the text begins with `{`, otherwise CSV. Messages call the
    /// table `name`.
    ///
    /// # Errors
    /// An error for a text that is not a table.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::of_source(Source::new(name.escape_debug().to_string(), text))
    }

    fn of_source(source: Source) -> Result<Self, InputError> {
        let text = source.text.clone();
        let mut table = StoredTable {
            // stores only the name: the text itself is no longer needed
            place: Place::within(Source::new(source.name, "")),
            connection: None,
            basis: None,
            dimension: None,
            frame: None,
            scalar: None,
            independent: false,
            tensors: vec![],
            missing: vec![],
            slots: vec![],
            names: vec![],
            lists_zeros: text.trim_start().starts_with('{'),
        };
        let read = if table.lists_zeros { table.json(&text) } else { table.csv(&text) };
        read.map_err(|error| error.at(&table.place))?;
        Ok(table)
    }

    /// The tensors that are stored.
    pub fn quantities(&self) -> Vec<Quantity> {
        self.tensors.iter().map(|(quantity, _)| *quantity).collect()
    }

    /// Checks that the components fit a space with this basis.
    ///
    /// # Errors
    /// An error if the table has another dimension, an index that is too large, or another name of
    /// a basis vector.
    pub fn expect_basis(&self, labels: &[String]) -> Result<(), InputError> {
        let computed = labels.len();
        let components = self.tensors.iter().flat_map(|(_, components)| components);
        let least = components.flat_map(|(indices, _)| indices).max().map_or(0, |index| index + 1);
        let stored = match self.dimension {
            Some(dimension) if dimension != computed => dimension.to_string(),
            None if least > computed => format!("at least {least}"),
            _ => return self.expect_names(labels),
        };
        let message =
            format!("the stored dimension is {stored}, but the computed one is {computed}");
        Err(InputError::mathematics(message).at(&self.place))
    }

    fn expect_names(&self, labels: &[String]) -> Result<(), InputError> {
        let stored = self.basis.iter().flatten();
        let mut pairs = (1..).zip(stored.zip(labels));
        let Some((at, (stored, computed))) =
            pairs.find(|(_, (stored, computed))| stored != computed)
        else {
            return Ok(());
        };
        let (stored, computed) = (stored.escape_debug(), computed.escape_debug());
        let message = format!(
            "the stored basis vector {at} is `{stored}`, but the computed one is `{computed}`"
        );
        Err(InputError::mathematics(message).at(&self.place))
    }

    /// Returns this table. If it lists no components, as in CSV files of vanishing tensors, returns
    /// the vanishing basic tensors of the computed table.
    ///
    /// # Errors
    /// An error if this table lists no components, and no computed tensor vanishes.
    pub fn or_vanishing<S: Coefficient>(
        &self,
        table: &Table<S>,
    ) -> Result<Cow<'_, Self>, InputError> {
        if !self.tensors.is_empty() {
            return Ok(Cow::Borrowed(self));
        }
        let basic = |entry: &&TableEntry<S>| Quantity::BASIC.contains(&entry.quantity);
        let vanishing = table.tensors.iter().filter(basic).filter(|entry| entry.tensor.is_empty());
        let tensors: Vec<_> = vanishing.map(|entry| (entry.quantity, vec![])).collect();
        if tensors.is_empty() {
            let message = "no component is stored, but no tensor of this space vanishes";
            return Err(InputError::mathematics(message).at(&self.place).help(NAMED));
        }
        Ok(Cow::Owned(StoredTable { tensors, ..self.clone() }))
    }

    /// Remarks on the settings in which the stored table differs from the computed table. If an
    /// option changes such a setting, the remark names the option.
    pub fn remarks<S: Coefficient>(&self, table: &Table<S>) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.tensors.is_empty() {
            remarks.push(format!(
                "the stored table has no rows, so only vanishing tensors are compared; {NAMED}"
            ));
        }
        if let Some(stored) = self.connection.as_ref().filter(|name| **name != table.connection) {
            let (stored, computed) = (stored.escape_debug(), &table.connection);
            remarks.push(format!(
                "the stored connection is {stored}, but the computed one is {computed}"
            ));
        }
        if let Some(frame) = self.frame.as_ref().filter(|frame| *frame != table.frame) {
            let see = match (frame.as_str(), table.frame) {
                ("right-invariant", "left-invariant") => ": see --frame right",
                ("left-invariant", "right-invariant") => ": see --frame left",
                _ => "",
            };
            let (stored, computed) = (frame.escape_debug(), table.frame);
            remarks.push(format!(
                "the tensors are stored in the {stored} frame, but computed in the {computed}{see}"
            ));
        }
        if self.independent && !table.independent {
            remarks.push("only independent components are stored: see --independent".into());
        }
        if self.scalar.as_deref() == Some("float") && S::KIND != Kind::Float {
            remarks.push(
                "the stored values are floats, but the computed ones are exact: see --scalar float"
                    .into(),
            );
        }
        remarks
    }

    /// Restricts the table to the `chosen` tensors. A tensor that is not listed must be zero or, in
    /// JSON, must not apply to the space.
    pub fn select(&mut self, chosen: &[Quantity]) {
        let mut tensors = Vec::new();
        for &quantity in chosen {
            let found = self.tensors.iter().find(|(other, _)| *other == quantity);
            if found.is_none() {
                self.missing.push(quantity);
            }
            tensors.push(found.cloned().unwrap_or((quantity, vec![])));
        }
        self.tensors = tensors;
    }

    /// Whether the stored table contains only the independent components of a computed table,
    /// without saying so.
    pub(super) fn lists_independent<S: Coefficient>(&self, table: &Table<S>) -> bool {
        let independent = Table { independent: true, ..table.clone() };
        !table.independent
            && !self.independent
            && self.differences(&independent).is_ok_and(|found| found.is_empty())
    }

    /// The name of the file.
    pub fn name(&self) -> &str {
        &self.place.source.name
    }

    /// The components that differ from a computed table, in the order of the stored table. Exact
    /// values must be equal; floats must be equal within the tolerance of the table. If the
    /// computed table lists only independent components, the stored table may list any of the
    /// components that are equal by symmetry.
    ///
    /// # Errors
    /// An error if a stored value cannot be parsed, if only one of the tables contains a tensor, or
    /// if there is nothing to compare.
    pub fn differences<S: Coefficient>(&self, table: &Table<S>) -> Result<Differences, InputError> {
        let (mut found, mut compared) = (vec![], vec![]);
        let names = self.names(table)?;
        let same_names = |named: &NamedFactors| {
            let lines: BTreeMap<_, _> =
                named.lines.iter().map(|line| (&line.name, &line.text)).collect();
            lines.into_iter().eq(self.names.iter().map(|(name, text)| (name, text)))
        };
        let named = (!self.names.is_empty()).then(|| table.factors()).filter(same_names);
        for (quantity, components) in &self.tensors {
            let refused = |reason: String| InputError::usage(reason).at(&self.place);
            let key = quantity.key();
            let entry = table.tensors.iter().find(|entry| entry.quantity == *quantity);
            let missing = self.missing.contains(quantity);
            let tensor = match entry {
                Some(_) if missing && self.lists_zeros => {
                    return Err(refused(format!("{key} is not stored")));
                }
                Some(TableEntry { tensor, .. }) => tensor,
                None if missing => continue,
                None => {
                    let message = format!("{key} is stored, but it is not defined for this space");
                    let help =
                        "give a metric if the tensor needs one, as in --metric \"diag(1,2,3)\"";
                    return Err(refused(message).help(help));
                }
            };
            compared.push(*quantity);
            self.expect_slots(*quantity, tensor.slots())?;
            let mut values = Vec::new();
            for (indices, value) in components {
                let numbers: Vec<usize> = indices.iter().map(|index| index + 1).collect();
                let (rank, n) = (tensor.rank(), tensor.dimension());
                if indices.len() != rank || numbers.iter().any(|number| *number > n) {
                    let expected = format!("{rank} indices from 1 to {n}");
                    return Err(refused(format!(
                        "{key}: the component {numbers:?} needs {expected}"
                    )));
                }
                // compares the texts first: if they are equal, the stored text need not be
                // evaluated, which would exceed a limit for a long value
                let computed = tensor.get(indices);
                let written = match &named {
                    Some(named) => with_names(&computed, &named.factors),
                    None => plain(&computed),
                };
                let read =
                    if written == *value { Ok(computed.read_back()) } else { read(value, &names) };
                let read = read.map_err(|reason| refused(format!("{key}: `{value}`: {reason}")))?;
                values.push((indices.clone(), read));
            }
            values.sort_by(|a, b| a.0.cmp(&b.0));
            if let Some(twice) = values.windows(2).find(|pair| pair[0].0 == pair[1].0) {
                let indices: Vec<usize> = twice[0].0.iter().map(|index| index + 1).collect();
                return Err(refused(format!("{key}: the component {indices:?} is stored twice")));
            }
            // a file may contain any of the components that are equal by symmetry
            let listed: BTreeSet<_> = values.iter().map(|(at, _)| at.clone()).collect();
            let shown = match table.independent {
                true => &representatives(tensor, &listed),
                false => tensor,
            };
            let stored = Tensor::from_components(shown.dimension(), shown.slots(), values)
                .map_err(|error| refused(format!("{key}: {error}")))?
                .with_tolerance(table.tolerance);
            found.extend(compare(*quantity, &stored, shown));
        }
        if compared.is_empty() {
            let message = "none of the selected tensors is defined for this space";
            return Err(InputError::mathematics(message).at(&self.place));
        }
        Ok(Differences::new(compared, found, table.zero_line()))
    }

    /// Evaluates the names of common factors that occur in stored components.
    fn names<S: Coefficient>(&self, table: &Table<S>) -> Result<Vec<(String, S)>, InputError> {
        let refused = |reason: String| InputError::usage(reason).at(&self.place);
        let mut names = Vec::new();
        for (name, text) in &self.names {
            let shown = name.escape_debug();
            if !is_name(name) {
                return Err(refused(format!("where: `{shown}` is not a name")));
            }
            if table.parameters.contains(name) {
                return Err(refused(format!("where: `{shown}` is a parameter of the table")));
            }
            let value = read(text, &names)
                .map_err(|reason| refused(format!("where: `{shown}`: {reason}")))?;
            names.push((name.clone(), value));
        }
        Ok(names)
    }

    fn expect_slots(&self, quantity: Quantity, slots: &[Variance]) -> Result<(), InputError> {
        let computed = variances(slots);
        match self.slots.iter().find(|(other, _)| *other == quantity) {
            Some((_, stored)) if *stored != computed => {
                let key = quantity.key();
                let message = format!(
                    "{key}: the stored indices are {stored}, the computed indices {computed}"
                );
                Err(InputError::mathematics(message).at(&self.place))
            }
            _ => Ok(()),
        }
    }

    fn json(&mut self, text: &str) -> Result<(), InputError> {
        let refused = |reason: &str| InputError::usage(reason);
        let root: Value = serde_json::from_str(text).map_err(|e| refused(&e.to_string()))?;
        match root["schema"].as_str() {
            Some("affinor.table/1") => {}
            Some(other) => {
                return Err(refused(&format!("the schema is `{other}`, not affinor.table/1")));
            }
            None => return Err(refused("the schema is missing, affinor.table/1")),
        }
        let object = root["tensors"].as_object();
        for (key, tensor) in object.ok_or_else(|| refused("there is no object `tensors`"))? {
            let list = tensor["components"].as_array();
            let list = list.ok_or_else(|| refused(&format!("{key} has no components")));
            let mut components = Vec::new();
            let quantity = of_key(key)?;
            for item in list? {
                let component = component(item);
                let message = || refused(&format!("{key}: {item} is not a component"));
                components.push(component.ok_or_else(message)?);
            }
            self.tensors.push((quantity, components));
            if let Some(slots) = tensor.get("indices") {
                self.slots.push((quantity, slots.clone()));
            }
        }
        if self.tensors.is_empty() {
            return Err(refused("it contains no tensor"));
        }
        let text = |value: &Value| value.as_str().map(str::to_string);
        if let Some(names) = root.get("where") {
            let pair = |(name, value): (&String, &Value)| Some((name.clone(), text(value)?));
            let pairs = names.as_object().and_then(|names| names.iter().map(pair).collect());
            self.names = pairs.ok_or_else(|| {
                refused("`where` is not an object of names, each with an expression as a string")
            })?;
        }
        let conventions = &root["conventions"];
        self.connection = text(&root["connection"]["name"]);
        let names = root["algebra"]["basis"].as_array();
        self.basis = names.and_then(|names| names.iter().map(text).collect());
        self.dimension = root["algebra"]["dimension"].as_u64().and_then(|n| n.try_into().ok());
        self.frame = text(&conventions["frame"]);
        self.scalar = text(&root["scalar"]);
        self.independent = !conventions["components"].is_null();
        Ok(())
    }

    fn csv(&mut self, text: &str) -> Result<(), InputError> {
        let failed = |error: csv::Error| InputError::usage(error.to_string());
        if text.matches('"').count() % 2 == 1 {
            return Err(InputError::usage("a quote `\"` is not closed"));
        }
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().map_err(failed)?.clone();
        let columns = header.len();
        if columns < 6 || &header[0] != "tensor" || &header[columns - 1] != "value" {
            return Err(InputError::usage("the header is not tensor,i,j,k,l,...,value"));
        }
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(failed)?;
            let here = |what: &str| InputError::usage(format!("row {}: {what}", row + 2));
            let quantity = of_key(&record[0]).map_err(|error| here(&error.message))?;
            let index = |field: &str| field.parse::<usize>().ok()?.checked_sub(1);
            let fields = (1..columns - 1).map(|at| &record[at]).filter(|field| !field.is_empty());
            let indices = fields.map(index).collect::<Option<Vec<_>>>();
            let indices = indices.ok_or_else(|| here("an index is not a positive integer"))?;
            let component = (indices, record[columns - 1].into());
            match self.tensors.iter_mut().find(|(other, _)| *other == quantity) {
                Some((_, components)) => components.push(component),
                None => self.tensors.push((quantity, vec![component])),
            }
        }
        Ok(())
    }
}

fn of_key(key: &str) -> Result<Quantity, InputError> {
    Quantity::from_key(key).ok_or_else(|| InputError::usage(format!("`{key}` is not a tensor")))
}

/// A component in JSON, `[[1, 2, 1, 2], "1/4"]`.
fn component(item: &Value) -> Option<Component> {
    let [indices, value] = item.as_array()?.as_slice() else { return None };
    let index = |index: &Value| usize::try_from(index.as_u64()?.checked_sub(1)?).ok();
    let indices = indices.as_array()?.iter().map(index).collect::<Option<_>>()?;
    let value = match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        _ => return None,
    };
    Some((indices, value))
}

/// Parses a value that was written with any scalar type.
fn read<S: Coefficient>(value: &str, names: &[(String, S)]) -> Result<S, String> {
    if S::KIND == Kind::Float
        && let Ok(x) = value.parse::<f64>()
        && let Some(numerator) = Rational::from_f64(x)
    {
        return S::from_rational(&numerator).ok_or_else(|| "beyond the range of f64".into());
    }
    let parameter = |name: &str| {
        let named = names.iter().find(|(other, _)| other == name).map(|(_, value)| value.clone());
        named.or_else(|| S::parameter(name)).ok_or(format!("the space has no parameter {name}"))
    };
    let expression = Expression::parse(value).map_err(|error| error.to_string())?;
    expression.evaluate(&Scalars(parameter, S::call)).map_err(|error| error.to_string())
}
