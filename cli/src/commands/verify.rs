//! `affinor verify`: comparison of a space with a stored table.

use super::failure::Failure;
use super::note::note;
use super::options::{Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use super::table::{Quantities, Selection};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{Cell, Difference, Format, Grid, Quantity, StoredTable};
use affinor_tensors::Notation;
use clap::Args;
use serde_json::{Value, json};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The largest number of differing components that are shown; all are counted.
const SHOWN: usize = 20;

#[derive(Args)]
pub struct Arguments {
    /// The space (see `affinor --help`) and the stored table, JSON or CSV
    #[arg(num_args = 1..=2, required = true, value_names = ["SPACE", "FILE"])]
    pub arguments: Vec<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Selection,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let stages = self.shared.start()?;
        let (space, file) = match self.arguments.as_slice() {
            [space, file] => (Some(space.as_str()), PathBuf::from(file)),
            [file] => (None, PathBuf::from(file)),
            _ => return Err(InputError::usage("verify takes a SPACE and a FILE").into()),
        };
        let mut stored = read(&file)?;
        if let Some(Quantities(chosen)) = &self.selection.show {
            let fail = |reason| InputError::usage(format!("{}: {reason}", shown(&file)));
            stored.select(chosen).map_err(fail)?;
        }
        let space = self.shared.open(space, &self.options)?;
        let mine = space.definition.dimension();
        let other = match (stored.dimension, stored.least_dimension()) {
            (Some(dimension), _) if dimension != mine => Some(dimension.to_string()),
            (None, least) if least > mine => Some(format!("at least {least}")),
            _ => None,
        };
        if let Some(other) = other {
            let name = shown(&file);
            let message =
                format!("{name}: the stored dimension is {other}, the computed one {mine}");
            return Err(InputError::mathematics(message).into());
        }
        let (selection, file) = (&self.selection, &*file);
        let work = Differences { selection, file, stored: &stored, stages: &stages };
        let found = self.shared.run(&space, work)?;
        stages.begin_output();
        let output = &self.shared.output;
        let inputs: Vec<&Path> = space.file.as_deref().into_iter().chain([file]).collect();
        let compared: Vec<&str> = stored.quantities().into_iter().map(Quantity::key).collect();
        let compared = compared.join(", ");
        let write = |out: &mut dyn Write| write(&found, &compared, output.format, out);
        deliver(output.file.as_deref(), &inputs, write)?;
        Ok(if found.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}

/// The largest size of a stored table, in bytes.
const MAX_BYTES: u64 = 1 << 32;

fn read(file: &Path) -> Result<StoredTable, Failure> {
    let fail = |reason: String| InputError::usage(format!("cannot read {}: {reason}", shown(file)));
    let mut text = String::new();
    let opened = std::fs::File::open(file).map_err(|error| fail(error.to_string()))?;
    opened.take(MAX_BYTES).read_to_string(&mut text).map_err(|error| fail(error.to_string()))?;
    Ok(StoredTable::parse(&text).map_err(fail)?)
}

fn shown(file: &Path) -> String {
    file.display().to_string().escape_debug().to_string()
}

struct Differences<'a> {
    selection: &'a Selection,
    file: &'a Path,
    stored: &'a StoredTable,
    stages: &'a Stages,
}

impl Work for Differences<'_> {
    type Output = Vec<Difference>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Vec<Difference>, InputError> {
        let quantities = self.stored.quantities();
        let table = self.selection.table(definition, reading, &quantities, self.stages)?;
        if let Some(name) = &self.stored.connection
            && *name != table.connection
        {
            let (stored, computed) = (name.escape_debug(), &table.connection);
            note(&format!("the stored connection is {stored}, the computed one {computed}"));
        }
        self.stored.remarks(&table).iter().for_each(|remark| note(remark));
        self.stages.begin("comparison");
        let fail = |reason: String| InputError::usage(format!("{}: {reason}", shown(self.file)));
        self.stored.differences(&table).map_err(fail)
    }
}

fn write(
    found: &[Difference],
    compared: &str,
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    let shown = &found[..found.len().min(SHOWN)];
    if format == Format::Json {
        let entry = |d: &Difference| -> Value {
            json!({ "component": d.component, "stored": d.stored, "computed": d.computed })
        };
        let all = json!({
            "schema": "affinor.verify/1",
            "ok": found.is_empty(),
            "compared": compared.split(", ").collect::<Vec<_>>(),
            "differences": found.len(),
            "first": shown.iter().map(entry).collect::<Vec<_>>(),
        });
        serde_json::to_writer_pretty(&mut *out, &all)?;
        return writeln!(out);
    }
    if found.is_empty() && format == Format::Text {
        return writeln!(out, "the stored table agrees: {compared}");
    }
    let title = match found.len() {
        0 => format!("The stored table agrees: {compared}"),
        1 => "1 component differs".into(),
        n if n > SHOWN => format!("{n} components differ; the first {SHOWN}"),
        n => format!("{n} components differ"),
    };
    let header = ["component", "stored", "computed"].map(String::from).to_vec();
    let row =
        |d: &Difference| [&d.component, &d.stored, &d.computed].map(|s| Cell::from(s.as_str()));
    let rows = shown.iter().map(|d| row(d).to_vec()).collect();
    Grid { title, header, rows }.write(format, out)
}
