//! The forces of a problem: the table `[forces]`.

use super::reader::{Reader, Written};
use crate::input::{
    InputError, Place,
    forms::{Number, Text},
    read_rows, shown,
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
    pub interpolation: Option<Text>,
}

/// The forces of a problem, as formulas.
#[derive(Clone, Debug)]
pub(super) struct ForceFormulas {
    /// The components in the body frame and in the spatial frame.
    components: [(ForceFrame, Vec<Written>); 2],
    potential: Option<Written>,
    table: Option<(ForceFrame, ForceTable)>,
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
                let columns = read_rows(&reader.file(name));
                let (names, rows) = columns.map_err(|error| error.or_at(&place))?;
                let rows = force_rows(&names, rows).map_err(|error| error.at(&place))?;
                let refused = |error: Error| InputError::usage(error.to_string()).at(&place);
                let table = ForceTable::new(rows).map_err(refused)?;
                Some((side, if held { table.held() } else { table }))
            }
            None => {
                let idle = ["forces.table_in", "forces.interpolation"];
                if let Some(key) = idle.into_iter().find(|key| source.has_key(key)) {
                    let error = source.refused(key, "there is no table");
                    return Err(error.help("give table = \"FILE.csv\""));
                }
                None
            }
        };
        let potential = keys.potential.as_ref().map(|text| reader.written(text));
        let (functions, place) = (vec![], source.key("forces"));
        Ok(ForceFormulas { components, potential, table, functions, place })
    }

    /// Adds a force as a function.
    pub fn add(&mut self, side: ForceFrame, function: ForceFunction) {
        self.functions.push((side, function));
    }

    /// Adds the forces to those of a motion on a group of this dimension.
    pub fn apply(&self, forces: &mut Forces, dimension: usize) -> Result<(), InputError> {
        let refused = |what: &str, found: usize, place: &Place| {
            let message = format!("{what} has {found} components, the dimension is {dimension}");
            Err(InputError::usage(message).at(place))
        };
        for (_, components) in &self.components {
            let found = components.len();
            if let Some(first) = components.first().filter(|_| found != dimension) {
                return refused("the force", found, &first.place());
            }
        }
        let width = self.table.as_ref().map(|(_, table)| table.width());
        if let Some(width) = width.filter(|width| *width != dimension) {
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
            let help =
                format!("a potential is a formula of t, the entries {entries} and parameters");
            let set = forces.set_potential(potential.text());
            set.map_err(|error| potential.refused(error, help))?;
        }
        if let Some((side, table)) = &self.table {
            forces.set_table(*side, table.clone());
        }
        for (side, function) in &self.functions {
            forces.add_function(*side, function.clone());
        }
        Ok(())
    }
}

/// The time and the components `M1`, `M2`, .. of each row, in this order.
fn force_rows(names: &[String], rows: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, InputError> {
    let wanted = (0..names.len()).map(|k| if k == 0 { "t".into() } else { format!("M{k}") });
    let wanted: Vec<String> = wanted.collect();
    let refused = |name: &String| {
        let message =
            format!("the table has no column `{name}`; its columns are {}", names.join(", "));
        InputError::usage(message).help(format!("name them {}, in any order", wanted.join(", ")))
    };
    let place = |name: &String| names.iter().position(|n| n == name).ok_or_else(|| refused(name));
    let places = wanted.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let ordered = |row: &Vec<f64>| places.iter().map(|at| row[*at]).collect::<Vec<_>>();
    let rows: Vec<Vec<f64>> = rows.iter().map(ordered).collect();
    match rows.iter().position(|row| row.iter().any(|value| !value.is_finite())) {
        Some(at) => Err(InputError::usage(format!("row {} of the table is not finite", at + 1))),
        None => Ok(rows),
    }
}
