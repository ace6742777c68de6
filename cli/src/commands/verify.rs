//! `affinor verify`: comparison of a space with stored tables.

use super::failure::Failure;
use super::note::note;
use super::options::{Shared, SpaceOptions};
use super::table::{Choice, Quantities};
use affinor_documents::input::InputError;
use affinor_documents::report::{Convention, Quantity, StoredTable, Verification};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub struct Arguments {
    /// The space (see `affinor --help`), followed by stored tables, JSON or CSV; a folder means all
    /// .json and .csv files in it
    #[arg(num_args = 1.., required = true, value_names = ["SPACE", "FILE"])]
    pub arguments: Vec<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Choice,
    /// The convention of a stored tensor, as an equation: a stored component on the left, and the
    /// equal component of affinor on the right. Example
    /// of a sign: "R^i_jkl = -R^i_jkl". Example of the order of indices: "Lambda^i_jk =
    /// Lambda^i_kj". May be repeated
    #[arg(long, value_name = "EQUATION", allow_hyphen_values = true)]
    pub convention: Vec<String>,
    /// Show all components that differ, not only the first 20 of each table
    #[arg(long)]
    pub all: bool,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let (space, paths) = match self.arguments.as_slice() {
            files if self.options.basis.is_some() => (None, files),
            [space, files @ ..] if !files.is_empty() => (Some(space.as_str()), files),
            files => (None, files),
        };
        let mut files = vec![];
        for path in paths {
            files.extend(tables(path)?);
        }
        let (mut stored, mut errors) = (vec![], vec![]);
        for file in &files {
            match StoredTable::read(file) {
                Ok(table) => stored.push(table),
                Err(error) => errors.push(error),
            }
        }
        if let Some(Quantities(chosen)) = &self.selection.show {
            stored.iter_mut().for_each(|table| table.select(chosen));
        }
        let space = self.shared.open(space, &self.options)?;
        stored.retain(|table| match table.expect_basis(&space.definition.labels) {
            Ok(()) => true,
            Err(error) => {
                errors.push(error);
                false
            }
        });
        if stored.is_empty() {
            return Err(Failure::Several(errors));
        }
        let lists = stored.iter().map(StoredTable::quantities);
        let lists = lists.map(|list| if list.is_empty() { Quantity::BASIC.to_vec() } else { list });
        let mut quantities: Vec<Quantity> = vec![];
        for quantity in lists.flatten() {
            if !quantities.contains(&quantity) {
                quantities.push(quantity);
            }
        }
        let conventions: Vec<_> =
            self.convention.iter().map(|text| Convention::new(text)).collect();
        let stage = |name: &str| stages.begin(name);
        let computation = self.shared.computation(&space, &stage)?;
        let selection = self.selection.of(quantities);
        let found =
            stages.bound(|| computation.differences(&stored, &selection, &conventions))??;
        let mut outcomes = vec![];
        found.remarks.iter().for_each(|remark| note(remark));
        for (table, outcome) in stored.iter().zip(found.tables) {
            let (differences, remarks) = match outcome {
                Ok(outcome) => outcome,
                Err(error) => {
                    errors.push(error);
                    continue;
                }
            };
            let origin =
                if stored.len() > 1 { format!("{}: ", table.name()) } else { String::new() };
            remarks.iter().for_each(|remark| note(&(origin.clone() + remark)));
            let shown = if self.all { differences.showing_all() } else { differences };
            outcomes.push((table.name().to_string(), shown));
        }
        let compared = outcomes.len();
        let verification = Verification::new(outcomes);
        let inputs: Vec<_> =
            space.file.into_iter().chain(files.iter().map(PathBuf::from)).collect();
        if compared > 0 {
            self.shared.print(&stages, &inputs, &verification)?;
        }
        if !errors.is_empty() {
            return Err(Failure::Several(errors));
        }
        if verification.is_empty() { Ok(()) } else { Err(Failure::Refuted) }
    }
}

/// The tables at a path: the file itself, or the `.json` and `.csv` files of a folder, sorted by
/// name.
fn tables(path: &str) -> Result<Vec<String>, InputError> {
    if !Path::new(path).is_dir() {
        return Ok(vec![path.into()]);
    }
    let shown = path.escape_debug();
    let entries = std::fs::read_dir(path)
        .map_err(|error| InputError::usage(format!("cannot read {shown}: {error}")))?;
    let paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let is_table = |path: &PathBuf| {
        path.extension().is_some_and(|ending| ending == "json" || ending == "csv") && path.is_file()
    };
    let mut files: Vec<String> =
        paths.filter(is_table).filter_map(|path| Some(path.to_str()?.to_string())).collect();
    files.sort();
    match files.is_empty() {
        true => Err(InputError::usage(format!("the folder {shown} has no .json or .csv file"))),
        false => Ok(files),
    }
}
