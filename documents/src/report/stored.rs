//! Stored tables, and their comparison with computed tables.

use super::components::plain;
use super::{Quantity, Table, TableEntry, text};
use affinor_tensors::expression::{Expression, Functions, Scalars};
use affinor_tensors::{Kind, Notation, Rational, Sum, Tensor};
use serde_json::Value;

/// A table read from JSON (`affinor.table/1`) or CSV. Values stay texts until the scalar is known.
#[derive(Clone, Debug)]
pub struct StoredTable {
    /// The name of the connection, if the file has it.
    pub connection: Option<String>,
    /// The dimension, if the file has it.
    pub dimension: Option<usize>,
    /// The frame, such as `left-invariant`, if the file has it.
    frame: Option<String>,
    /// The scalar, if the file has it.
    scalar: Option<String>,
    /// Whether only independent components are listed.
    independent: bool,
    tensors: Vec<(Quantity, Vec<Component>)>,
    /// Whether the format lists tensors without components: JSON does, CSV does not.
    lists_zeros: bool,
}

/// The indices of a component (from 0) and its value as written.
type Component = (Vec<usize>, String);

/// A component whose stored value differs from the computed one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The component, `R^1_212`.
    pub component: String,
    /// The stored value; `0` if there is none.
    pub stored: String,
    /// The computed value; `0` if there is none.
    pub computed: String,
}

impl StoredTable {
    /// Reads a stored table: JSON if the text begins with `{`, else CSV.
    ///
    /// # Errors
    /// A description of the error and its place.
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.trim_start().starts_with('{') { Self::json(text) } else { Self::csv(text) }
    }

    /// The tensors that are stored.
    pub fn quantities(&self) -> Vec<Quantity> {
        self.tensors.iter().map(|(quantity, _)| *quantity).collect()
    }

    /// The largest index of a stored component: the least dimension that it fits.
    pub fn least_dimension(&self) -> usize {
        let components = self.tensors.iter().flat_map(|(_, components)| components);
        components.flat_map(|(indices, _)| indices).max().map_or(0, |index| index + 1)
    }

    /// The settings of the stored table that differ from those of the computed one, each with the option that changes it,
    /// if there is one.
    pub fn remarks<S: Notation>(&self, table: &Table<S>) -> Vec<String> {
        let mut remarks = Vec::new();
        if let Some(frame) = self.frame.as_ref().filter(|frame| *frame != table.frame) {
            let see = match (frame.as_str(), table.frame) {
                ("right-invariant", "left-invariant") => ": see --frame right",
                ("left-invariant", "right-invariant") => ": see --frame left",
                _ => "",
            };
            let (stored, computed) = (frame.escape_debug(), table.frame);
            remarks.push(format!("stored in the {stored} frame, computed in the {computed}{see}"));
        }
        if self.independent && !table.independent {
            remarks.push("stored are independent components only: see --independent".into());
        }
        if self.scalar.as_deref() == Some("float") && S::KIND != Kind::Float {
            remarks.push("stored in floats, computed exactly: see --scalar float".into());
        }
        remarks
    }

    /// Keeps only the `chosen` tensors. A tensor that CSV does not list is zero.
    ///
    /// # Errors
    /// A tensor that is missing in JSON.
    pub fn select(&mut self, chosen: &[Quantity]) -> Result<(), String> {
        let mut tensors = Vec::new();
        for &quantity in chosen {
            let found = self.tensors.iter().find(|(other, _)| *other == quantity);
            match found {
                Some(found) => tensors.push(found.clone()),
                None if self.lists_zeros => {
                    return Err(format!("{} is not stored", quantity.key()));
                }
                None => tensors.push((quantity, vec![])),
            }
        }
        self.tensors = tensors;
        Ok(())
    }

    /// The components that differ from a computed table, in the order of the stored one. Exact values must be equal, floats
    /// equal within the tolerance of the table.
    ///
    /// # Errors
    /// A stored value that cannot be read, or a tensor that the computed table lacks.
    pub fn differences<S: Notation>(&self, table: &Table<S>) -> Result<Vec<Difference>, String> {
        let mut differences = Vec::new();
        for (quantity, components) in &self.tensors {
            let key = quantity.key();
            let entry = table.tensors.iter().find(|entry| entry.quantity == *quantity);
            let Some(TableEntry { tensor, .. }) = entry else {
                return Err(format!("{key} is stored, and does not apply to this space"));
            };
            let shown = if table.independent { &super::independent(tensor) } else { tensor };
            let mut values = Vec::new();
            for (indices, value) in components {
                let read = read(value).map_err(|reason| format!("{key}: `{value}`: {reason}"))?;
                values.push((indices.clone(), read));
            }
            values.sort_by(|a, b| a.0.cmp(&b.0));
            if let Some(twice) = values.windows(2).find(|pair| pair[0].0 == pair[1].0) {
                let indices: Vec<usize> = twice[0].0.iter().map(|index| index + 1).collect();
                return Err(format!("{key}: the component {indices:?} is stored twice"));
            }
            let stored = Tensor::from_components(shown.dimension(), shown.slots(), values)
                .map_err(|error| format!("{key}: {error}"))?
                .with_tolerance(table.tolerance);
            differences.extend(compare(*quantity, &stored, shown));
        }
        Ok(differences)
    }

    fn json(text: &str) -> Result<Self, String> {
        let root: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        match root["schema"].as_str() {
            Some("affinor.table/1") => {}
            Some(other) => return Err(format!("the schema is `{other}`, not affinor.table/1")),
            None => return Err("the schema is missing, affinor.table/1".into()),
        }
        let object = root["tensors"].as_object().ok_or("there is no object `tensors`")?;
        let mut tensors = Vec::new();
        for (key, tensor) in object {
            let quantity = Quantity::from_key(key).ok_or(format!("`{key}` is no tensor"))?;
            let list = tensor["components"].as_array().ok_or(format!("{key} has no components"))?;
            let component = |item: &Value| -> Option<Component> {
                let [indices, value] = item.as_array()?.as_slice() else {
                    return None;
                };
                let index = |index: &Value| usize::try_from(index.as_u64()?.checked_sub(1)?).ok();
                let indices = indices.as_array()?.iter().map(index).collect::<Option<_>>()?;
                let value = match value {
                    Value::String(text) => text.clone(),
                    Value::Number(number) => number.to_string(),
                    _ => return None,
                };
                Some((indices, value))
            };
            let mut components = Vec::new();
            for item in list {
                components.push(component(item).ok_or(format!("{key}: {item} is no component"))?);
            }
            tensors.push((quantity, components));
        }
        if tensors.is_empty() {
            return Err("there is no tensor in it".into());
        }
        let connection = root["connection"]["name"].as_str().map(str::to_string);
        let dimension = root["algebra"]["dimension"].as_u64().and_then(|n| usize::try_from(n).ok());
        let text = |value: &Value| value.as_str().map(str::to_string);
        let conventions = &root["conventions"];
        Ok(StoredTable {
            connection,
            dimension,
            frame: text(&conventions["frame"]),
            scalar: text(&root["scalar"]),
            independent: !conventions["components"].is_null(),
            tensors,
            lists_zeros: true,
        })
    }

    fn csv(text: &str) -> Result<Self, String> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().map_err(|error| error.to_string())?.clone();
        let columns = header.len();
        let shape = columns >= 6 && &header[0] == "tensor" && &header[columns - 1] == "value";
        if !shape {
            return Err("the header is not tensor,i,j,k,l,...,value".into());
        }
        let mut tensors: Vec<(Quantity, Vec<Component>)> = Vec::new();
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(|error| error.to_string())?;
            let here = |what: &str| format!("row {}: {what}", row + 2);
            let quantity = Quantity::from_key(&record[0])
                .ok_or(here(&format!("`{}` is no tensor", &record[0])))?;
            let index = |field: &str| field.parse::<usize>().ok()?.checked_sub(1);
            let fields = (1..columns - 1).map(|at| &record[at]).filter(|field| !field.is_empty());
            let indices = fields.map(index).collect::<Option<Vec<_>>>();
            let component =
                (indices.ok_or(here("an index is no number"))?, record[columns - 1].into());
            match tensors.iter_mut().find(|(other, _)| *other == quantity) {
                Some((_, components)) => components.push(component),
                None => tensors.push((quantity, vec![component])),
            }
        }
        if tensors.is_empty() {
            return Err("there is no component in it".into());
        }
        Ok(StoredTable {
            connection: None,
            dimension: None,
            frame: None,
            scalar: None,
            independent: false,
            tensors,
            lists_zeros: false,
        })
    }
}

/// A value as any scalar writes it.
fn read<S: Notation>(value: &str) -> Result<S, String> {
    if S::KIND == Kind::Float
        && let Ok(x) = value.parse::<f64>()
        && let Some(numerator) = Rational::from_f64(x)
    {
        return S::from_rational(&numerator).ok_or_else(|| "beyond the range of f64".into());
    }
    let parameter = |name: &str| S::parameter(name).ok_or(format!("`{name}` is no number"));
    let expression = Expression::parse(value).map_err(|error| error.to_string())?;
    let meaning = Functions(Scalars(parameter), S::function);
    expression.evaluate(&meaning).map_err(|error| error.to_string())
}

fn compare<S: Notation>(
    quantity: Quantity,
    stored: &Tensor<S>,
    computed: &Tensor<S>,
) -> Vec<Difference> {
    let differs = |a: &S, b: &S| {
        let mut difference = S::Sum::term(a);
        difference.add_term(&-b.clone());
        difference.finish(stored.tolerance()).is_some()
    };
    let mut differences = Vec::new();
    let (mut mine, mut theirs) = (stored.components().peekable(), computed.components().peekable());
    loop {
        let (at, a, b) = match (mine.peek(), theirs.peek()) {
            (None, None) => return differences,
            (Some((at, _)), None) => (*at, mine.next().map(|(_, v)| v), None),
            (None, Some((at, _))) => (*at, None, theirs.next().map(|(_, v)| v)),
            (Some((at, _)), Some((other, _))) => {
                let (at, other) = (*at, *other);
                let a = if at[..] <= other[..] { mine.next().map(|(_, v)| v) } else { None };
                let b = if other[..] <= at[..] { theirs.next().map(|(_, v)| v) } else { None };
                (if a.is_some() { at } else { other }, a, b)
            }
        };
        let zero = S::zero();
        let (a, b) = (a.unwrap_or(&zero), b.unwrap_or(&zero));
        if differs(a, b) {
            let component = text::component(quantity, computed, &at);
            let (stored, computed) = (plain(a), plain(b));
            differences.push(Difference { component, stored, computed });
        }
    }
}
