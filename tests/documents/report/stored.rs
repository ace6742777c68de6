//! A stored table agrees with its space: for every tensor, in both formats that can be read back,
//! for the catalogue up to dimension 30 and the examples.

use crate::common::root;
use affinor::algebra::catalogue;
use affinor_documents::input::InputError;
use affinor_documents::report::{Format, Quantity, Report, StoredTable, Table};
use affinor_documents::space::{Definition, Request, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::Tolerance;

/// The largest dimension of the algebras that are read back.
const LARGEST: usize = 30;

/// Stores and reads a table of each tensor, and of all together. Returns the number of tables.
fn read_tables<S: Coefficient>(
    definition: &Definition,
    all: &[Quantity],
) -> Result<usize, InputError> {
    let geometry = definition.geometry::<S>(Tolerance::default())?;
    let alone = all.iter().map(std::slice::from_ref);
    let mut read = 0;
    for quantities in alone.chain([all]) {
        let table = Table::new(&geometry, quantities)?;
        for format in [Format::Csv, Format::Json] {
            let mut text = vec![];
            table.write(format, &mut text).unwrap();
            let text = String::from_utf8(text).unwrap();
            if table.tensors.is_empty() {
                continue;
            }
            let mut stored = StoredTable::parse("stored", &text)?;
            let shown: Vec<_> = table.tensors.iter().map(|entry| entry.quantity).collect();
            // a tensor without rows in CSV is zero
            stored.select(&shown);
            stored.expect_basis(&table.labels)?;
            assert_eq!(stored.remarks(&table), [""; 0]);
            let differences = stored.differences(&table)?;
            assert!(differences.is_empty(), "{quantities:?}: {differences:?}");
            read += 1;
        }
    }
    Ok(read)
}

/// Reads back the tables of a space. Returns the number of tables.
#[track_caller]
fn read_back(request: &Request, quantities: &[Quantity]) -> usize {
    let space = Space::open(request).unwrap();
    let kind = space.kind(ScalarChoice::Exact).unwrap();
    let read = over_kind!(kind, S => read_tables::<S>(&space.definition, quantities));
    read.unwrap_or_else(|error| panic!("{request:?}: {error:?}"))
}

/// The names of the catalogue up to a dimension: every family by its pattern, with its arguments.
fn names() -> Vec<String> {
    let mut names = vec![];
    for family in catalogue::families() {
        let stem = family.pattern.split(['(', '^']).next().unwrap();
        let stem = if stem.len() == 2 { stem.trim_end_matches('n') } else { stem };
        let written: Vec<String> = match family.pattern {
            "so(p,q)" => (1..8).flat_map(|p| (1..8).map(move |q| format!("so({p},{q})"))).collect(),
            "bianchi(TYPE,h=v)" => {
                let types = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "VI,h=-1/2"];
                types.map(|name| format!("bianchi({name})")).to_vec()
            }
            pattern if pattern.contains('(') => {
                (1..=LARGEST).map(|n| format!("{stem}({n})")).collect()
            }
            _ => (1..=LARGEST).map(|n| format!("{stem}{n}")).collect(),
        };
        // dimensions grow with the argument, so the first that is too large ends the search
        let dimension = |name: &String| catalogue::find(name).ok().map(|entry| entry.dimension());
        let found = written
            .into_iter()
            .map(|name| (dimension(&name), name))
            .take_while(|(dimension, _)| dimension.is_none_or(|n| n <= 3 * LARGEST))
            .filter(|(dimension, _)| dimension.is_some_and(|n| n <= LARGEST));
        names.extend(found.map(|(_, name)| name));
        // families with other arguments
        let example = family.example.to_string();
        let is_large = dimension(&example).is_none_or(|n| n > LARGEST);
        if !is_large && !names.contains(&example) {
            names.push(example);
        }
    }
    names
}

/// With the connection `zero`, and with the Levi-Civita connection of the identity up to dimension
/// 6, where the curvature has enough components.
#[test]
fn every_table_of_the_catalogue_is_read_back() {
    let names = names();
    assert!(names.len() > 100, "{names:?}");
    let mut read = 0;
    for name in &names {
        let space = Request { space: Some(name.clone()), ..Request::default() };
        let dimension = Space::open(&space).unwrap().definition.dimension();
        let metric = Some("identity".to_string());
        let [zero, own] = ["zero", "levi-civita"].map(|connection| Request {
            connection: Some(connection.into()),
            metric: metric.clone(),
            ..space.clone()
        });
        read += read_back(&zero, &Quantity::ALL);
        if dimension <= 6 {
            read += read_back(&own, &Quantity::ALL);
        }
    }
    println!("{read} tables of {} algebras", names.len());
    assert!(read > 10 * names.len());
}

#[test]
fn every_table_of_the_examples_is_read_back() {
    let mut files = 0;
    let folders = ["examples/definitions", "documents/charts"];
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(root().join(folder)).unwrap());
    for entry in entries {
        let path = entry.unwrap().path().to_str().unwrap().to_string();
        let request = Request { space: Some(path), ..Request::default() };
        assert!(read_back(&request, &Quantity::ALL) > 0, "{request:?}");
        files += 1;
    }
    assert!(files > 80, "{files}");
}
