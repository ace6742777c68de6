//! The forces of a problem: the table `[forces]`.

use super::reader::{Reader, Written};
use crate::input::{
    InputError, Place,
    forms::{Entries, Formulas, MetricText, Number, Text},
    read_columns, shown,
};
use affinor::Error;
use affinor::mechanics::simulation::{ForceFrame, ForceFunction, ForceTable, Forces};
use serde::Deserialize;

/// The table `[forces]`.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct ForceKeys {
    pub body: Option<Vec<Number>>,
    pub spatial: Option<Vec<Number>>,
    pub potential: Option<Text>,
    pub table: Option<Text>,
    pub table_in: Option<Text>,
    pub columns: Option<Formulas>,
    pub interpolation: Option<Text>,
    pub mass: Option<Number>,
    pub charge: Option<Number>,
    #[serde(rename = "A")]
    pub vector_potential: Option<Entries<Text, Number>>,
    #[serde(rename = "F")]
    pub field_strength: Option<MetricText>,
}

/// The forces of a problem, as formulas.
#[derive(Clone, Debug)]
pub(super) struct ForceFormulas {
    /// The components of the forces in the body frame, and in the spatial frame.
    components: [(ForceFrame, Vec<Written>); 2],
    potential: Option<Written>,
    table: Option<(ForceFrame, ForceTable)>,
    /// Whether `columns` names the columns of the table. If it does, components without a column
    /// are zero.
    is_mapped: bool,
    functions: Vec<(ForceFrame, ForceFunction)>,
    place: Place,
}

impl ForceFormulas {
    pub fn read(keys: &ForceKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let components = [
            ("body", ForceFrame::Body, &keys.body),
            ("spatial", ForceFrame::Spatial, &keys.spatial),
        ];
        for (key, _, list) in components {
            let is_empty = list.as_ref().is_some_and(Vec::is_empty);
            reader.refuse_empty(&format!("forces.{key}"), is_empty)?;
        }
        let components = components.map(|(_, side, list)| {
            (side, list.iter().flatten().map(|number| reader.written(&number.0)).collect())
        });
        let side = match keys.table_in.as_deref() {
            None | Some("body") => ForceFrame::Body,
            Some("spatial") => ForceFrame::Spatial,
            Some("space") => {
                let error = source.refused("forces.table_in", "`space` is now `spatial`");
                return Err(error.help("write \"spatial\""));
            }
            Some(other) => {
                let message = format!("`{}` is neither body nor spatial", shown(other));
                return Err(source.refused("forces.table_in", message));
            }
        };
        let held = match keys.interpolation.as_deref() {
            None | Some("linear") => false,
            Some("hold") => true,
            Some(other) => {
                let message = format!("`{}` is neither linear nor hold", shown(other));
                return Err(source.refused("forces.interpolation", message));
            }
        };
        let table = match &keys.table {
            Some(name) => {
                let place = source.at(name);
                let is_used = |column: &str| match &keys.columns {
                    None => true,
                    Some(columns) => {
                        column == "t" || columns.0.iter().any(|(_, name)| name.trim() == column)
                    }
                };
                let columns = read_columns(&reader.file(name), is_used);
                let (names, rows) = columns.map_err(|error| error.or_at(&place))?;
                let rows = match &keys.columns {
                    None => force_rows(&names, rows).map_err(|error| error.at(&place))?,
                    Some(columns) => mapped_rows(columns, &names, &rows, reader)?,
                };
                let refused = |error: Error| InputError::usage(error.to_string()).at(&place);
                let table = ForceTable::new(rows).map_err(refused)?;
                Some((side, if held { table.held() } else { table }))
            }
            None => {
                let idle = ["forces.table_in", "forces.columns", "forces.interpolation"];
                if let Some(key) = idle.into_iter().find(|key| source.has_key(key)) {
                    let error =
                        source.refused(key, "this key needs a table of forces, but none is given");
                    return Err(error.help("give table = \"FILE.csv\""));
                }
                None
            }
        };
        let potential = keys.potential.as_ref().map(|text| reader.written(text));
        let (functions, place) = (vec![], source.key("forces"));
        let is_mapped = keys.columns.is_some();
        Ok(ForceFormulas { components, potential, table, is_mapped, functions, place })
    }

    /// Adds a force that is given as a function.
    pub fn add(&mut self, side: ForceFrame, function: ForceFunction) {
        self.functions.push((side, function));
    }

    /// Adds the forces of this problem to `forces`, for a group of this dimension.
    pub fn apply(&self, forces: &mut Forces, dimension: usize) -> Result<(), InputError> {
        let refused = |what: &str, found: usize, place: &Place| {
            let message =
                format!("{what} has {found} components, but the dimension is {dimension}");
            Err(InputError::usage(message).at(place))
        };
        for (_, components) in &self.components {
            let found = components.len();
            if let Some(first) = components.first().filter(|_| found != dimension) {
                return refused("the force", found, &first.place());
            }
        }
        let width = self.table.as_ref().map(|(_, table)| table.width());
        let fits = |width: usize| width == dimension || self.is_mapped && width < dimension;
        if let Some(width) = width.filter(|width| !fits(*width)) {
            return refused("the table", width, &self.place.source.key("forces.table"));
        }
        for (side, components) in &self.components {
            for (index, written) in components.iter().enumerate() {
                let added = forces.add(*side, index, written.text());
                let allowed = &Forces::may_depend_on;
                let help = || format!("the names here are {}", forces.names().all(allowed));
                added.map_err(|error| written.refused(error, help()))?;
            }
        }
        if let Some(potential) = &self.potential {
            let entries = forces.names().entries();
            let help = format!("a potential may contain t, the entries {entries} and parameters");
            let set = forces.set_potential(potential.text());
            set.map_err(|error| potential.refused(error, help))?;
        }
        if let Some((side, table)) = &self.table {
            forces.set_table(*side, table.clone().padded(dimension));
        }
        for (side, function) in &self.functions {
            forces.add_function(*side, function.clone());
        }
        Ok(())
    }
}

/// Sorts the columns of each row: the time, then the components `M1`, `M2`, ....
fn force_rows(names: &[String], rows: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, InputError> {
    let wanted = (0..names.len()).map(|k| if k == 0 { "t".into() } else { format!("M{k}") });
    let wanted: Vec<String> = wanted.collect();
    let refused = |name: &String| {
        let message =
            format!("the table has no column `{name}`; its columns are {}", names.join(", "));
        InputError::usage(message)
            .help(format!("name the columns {}, in any order", wanted.join(", ")))
    };
    let place = |name: &String| names.iter().position(|n| n == name).ok_or_else(|| refused(name));
    let places = wanted.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let ordered = |row: &Vec<f64>| places.iter().map(|at| row[*at]).collect::<Vec<_>>();
    finite(rows.iter().map(ordered).collect())
}

/// The rows of a table in which `columns` names the columns, as in `{ t = "time", M1 = "roll" }`. A
/// row has the time, and the components up to the last one with a column. Components without a
/// column are zero.
fn mapped_rows(
    columns: &Formulas,
    names: &[String],
    rows: &[Vec<f64>],
    reader: &Reader,
) -> Result<Vec<Vec<f64>>, InputError> {
    const FORM: &str = "columns = { t = \"time\", M1 = \"roll\" }";
    let refused = |text: &Text, message: String| {
        InputError::usage(message).at(&reader.source.at(text)).help(format!("write {FORM}"))
    };
    let column = |name: &str| names.iter().position(|other| other == name);
    let (mut time, mut components) = (column("t"), vec![]);
    for (key, name) in &columns.0 {
        let Some(at) = column(name.trim()) else {
            let (shown, all) = (shown(name), names.join(", "));
            let message = format!("the table has no column `{shown}`; its columns are {all}");
            return Err(refused(name, message));
        };
        let number = key.strip_prefix('M').and_then(|number| number.parse::<usize>().ok());
        match (&**key, number.and_then(|number| number.checked_sub(1))) {
            ("t", _) => time = Some(at),
            (_, Some(component)) if component < MAX_COMPONENTS => components.push((component, at)),
            _ => {
                let message = format!("`{}` is neither t nor a component M1, M2, ...", shown(key));
                return Err(refused(key, message));
            }
        }
    }
    let place = reader.source.key("forces.columns");
    let Some(time) = time else {
        let message = format!("no column is the time `t`; the columns are {}", names.join(", "));
        return Err(InputError::usage(message).at(&place).help(format!("write {FORM}")));
    };
    let Some(width) = components.iter().map(|(component, _)| component + 1).max() else {
        let message = "the table has no column with a component of the force";
        return Err(InputError::usage(message).at(&place).help(format!("write {FORM}")));
    };
    let ordered = |row: &Vec<f64>| {
        let mut ordered = vec![0.0; width + 1];
        ordered[0] = row[time];
        components.iter().for_each(|(component, at)| ordered[component + 1] = row[*at]);
        ordered
    };
    finite(rows.iter().map(ordered).collect()).map_err(|error| error.at(&place))
}

/// The largest number of components for which `columns` may name a column.
const MAX_COMPONENTS: usize = 1000;

/// Checks that all numbers are finite, and returns the rows.
fn finite(rows: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, InputError> {
    match rows.iter().position(|row| row.iter().any(|value| !value.is_finite())) {
        Some(at) => Err(InputError::usage(format!("row {} of the table is not finite", at + 1))),
        None => Ok(rows),
    }
}
