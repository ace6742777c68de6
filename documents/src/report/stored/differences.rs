//! Differences between a stored table and a computed table, and the report about one or several
//! stored tables.

use super::super::components::plain;
use super::super::grid::{Grid, head_of_grid};
use super::super::head::{conventions_in_json, printable};
use super::super::{Format, Quantity, Report, text};
use crate::Coefficient;
use affinor_tensors::{Sum, Tensor};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest number of differing components that are shown by default. All of them are counted.
const SHOWN: usize = 20;

/// The components whose stored values differ from the computed ones.
#[derive(Clone, Debug)]
pub struct Differences {
    /// The tensors that were compared.
    compared: Vec<Quantity>,
    /// For each differing component, its name, such as `R^1_212`, the stored value and the computed
    /// value.
    found: Vec<[String; 3]>,
    /// The rule by which a float counts as zero.
    zero: Option<String>,
    /// The largest number of components that are shown.
    shown: usize,
}

/// The differences of several stored tables from a space, each with the name of its file.
#[derive(Clone, Debug)]
pub struct Verification {
    tables: Vec<(String, Differences)>,
}

impl Differences {
    pub(super) fn new(
        compared: Vec<Quantity>,
        found: Vec<[String; 3]>,
        zero: Option<String>,
    ) -> Self {
        Differences { compared, found, zero, shown: SHOWN }
    }

    /// Shows all differing components, not only the first 20.
    #[must_use]
    pub fn showing_all(self) -> Self {
        Differences { shown: usize::MAX, ..self }
    }

    /// Whether all compared components agree.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// The differing components, each with its name, such as `R^1_212`, its stored value and its
    /// computed value. A missing value counts as 0.
    pub fn iter(&self) -> impl Iterator<Item = &[String; 3]> {
        self.found.iter()
    }

    fn shown(&self) -> impl Iterator<Item = &[String; 3]> {
        self.found.iter().take(self.shown)
    }

    fn keys(&self) -> Vec<&'static str> {
        self.compared.iter().map(|quantity| quantity.key()).collect()
    }

    /// The outcome in JSON, without the conventions.
    fn json(&self) -> Value {
        let entry = |[component, stored, computed]: &[String; 3]| json!({ "component": component, "stored": stored, "computed": computed });
        json!({
            "ok": self.is_empty(),
            "compared": self.keys(),
            "differences": self.found.len(),
            "first": self.shown().map(entry).collect::<Vec<_>>(),
        })
    }
}

/// The text `3 components differ`, with the number of shown components if it is smaller.
fn count(all: usize, shown: usize) -> String {
    match all {
        1 => "1 component differs".into(),
        n if n > shown => format!("{n} components differ; the first {shown}"),
        n => format!("{n} components differ"),
    }
}

impl Report for Differences {
    /// Writes the differences. JSON has the schema `affinor.verify/1`.
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        let compared = self.keys().join(", ");
        if self.is_empty() && format == Format::Text {
            return writeln!(out, "the stored table agrees: {compared}");
        }
        let title = match self.found.len() {
            0 => format!("The stored table agrees: {compared}"),
            n => count(n, self.shown),
        };
        let mut json = self.json();
        json["schema"] = "affinor.verify/1".into();
        json["conventions"] = conventions_in_json(self.zero.as_deref());
        let rows = self.shown().map(|row| row.each_ref().map(|cell| cell.as_str().into()).to_vec());
        Grid::new(title, &["component", "stored", "computed"], rows.collect(), json)
            .with_head(head_of_grid(self.zero.as_deref()))
            .write(format, out)
    }
}

impl Verification {
    /// The report about several stored tables, which are named after their files.
    pub fn new(tables: Vec<(String, Differences)>) -> Self {
        Verification { tables }
    }

    /// Whether all tables agree with the space.
    pub fn is_empty(&self) -> bool {
        self.tables.iter().all(|(_, found)| found.is_empty())
    }
}

impl Report for Verification {
    /// Writes the outcome of each table. JSON has the schema `affinor.verify/1`.
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        if let [(_, only)] = self.tables.as_slice() {
            return only.write(format, out);
        }
        let zero = self.tables.iter().find_map(|(_, found)| found.zero.as_deref());
        let entry = |(name, found): &(String, Differences)| {
            let mut entry = found.json();
            entry["table"] = name.as_str().into();
            entry
        };
        let json = json!({
            "schema": "affinor.verify/1",
            "ok": self.is_empty(),
            "conventions": conventions_in_json(zero),
            "tables": self.tables.iter().map(entry).collect::<Vec<_>>(),
        });
        let row = |(name, found): &(String, Differences)| {
            let outcome = match found.found.len() {
                0 => format!("agrees: {}", found.keys().join(", ")),
                n => count(n, found.shown),
            };
            let first =
                vec![name.as_str().into(), printable(&outcome).into(), "".into(), "".into()];
            let differences = found.shown().map(|[component, stored, computed]| {
                [name, component, stored, computed].map(|cell| cell.as_str().into()).to_vec()
            });
            [first].into_iter().chain(differences).collect::<Vec<_>>()
        };
        let agreeing = self.tables.iter().filter(|(_, found)| found.is_empty()).count();
        let title = format!("{agreeing} of {} stored tables agree", self.tables.len());
        let rows = self.tables.iter().flat_map(row).collect();
        Grid::new(title, &["table", "component", "stored", "computed"], rows, json)
            .with_head(head_of_grid(zero))
            .write(format, out)
    }
}

/// Finds the components in which two tensors differ, in the order of their indices.
pub(super) fn compare<S: Coefficient>(
    quantity: Quantity,
    stored: &Tensor<S>,
    computed: &Tensor<S>,
) -> Vec<[String; 3]> {
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
        if differs(a, &b.read_back()) {
            let component = text::component(quantity, computed, &at);
            differences.push([component, plain(a), plain(b)]);
        }
    }
}
