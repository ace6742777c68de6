//! The rows of a motion: their times, columns and events.

use super::keys::{Keys, OutputKeys};
use super::reader::{Reader, Value, Written};
use super::ready::Column;
use crate::definition::input::{InputError, shown};
use crate::definition::source::{Place, Source};
use crate::definition::written::Text;
use affinor::mechanics::formula::Formula;
use affinor::mechanics::motions::quantities::{Names, Quantity, Scope};
use affinor_tensors::Symbolic;

/// The largest number of rows of one motion.
const MAX_ROWS: f64 = 1e7;

/// The columns of a file that names none; a motion with a given velocity has the first three.
const COLUMNS: [&str; 6] = ["t", "element", "Omega", "H", "h", "energy"];

/// The table `[output]`, with the named quantities and events.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub times: Times,
    columns: Vec<Written>,
    quantities: Vec<(String, Written)>,
    events: Vec<(String, Written)>,
    /// The terminal event.
    pub stop: Option<String>,
    /// The event that rows are written at, instead of times.
    pub section: Option<String>,
}

/// The columns and events of a motion, with their formulas: those of the events follow those of the columns.
pub(super) struct RowFormulas {
    pub columns: Vec<Column>,
    pub events: Vec<String>,
    pub formulas: (Scope, Vec<Formula>),
}

impl Output {
    pub fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let output = &keys.output;
        let times = Times::read(output, reader.optional(&keys.initial.time)?, reader)?;
        let own = if keys.given.is_some() { &COLUMNS[..3] } else { &COLUMNS[..] };
        let columns = match &output.columns {
            Some(columns) => columns.iter().map(|column| reader.written(column)).collect(),
            None => own.iter().map(|name| Written::beside(source, *name)).collect(),
        };
        let quantities = reader.formulas(&keys.quantities)?;
        let events = reader.formulas(&keys.events)?;
        let event = |name: &Option<Text>| {
            let Some(name) = name else { return Ok(None) };
            if events.iter().any(|(event, _)| *event == name.content) {
                return Ok(Some(name.to_string()));
            }
            let error = InputError::usage(format!("`{}` is no event", shown(name)));
            let help = "events are named in a table [events], by formulas that change their sign";
            Err(error.at(&source.at(name)).help(help))
        };
        let (stop, section) = (event(&output.stop)?, event(&output.section)?);
        Ok(Output { times, columns, quantities, events, stop, section })
    }

    /// The same with other columns and no named quantities.
    pub fn with_columns(&self, names: &[&str], source: &Source) -> Self {
        let columns = names.iter().map(|name| Written::beside(source, *name)).collect();
        Output { columns, quantities: vec![], ..self.clone() }
    }

    /// The columns and events in the names of a motion. Formulas use only quantities that are `allowed`; `casimirs` are
    /// polynomials in `mu1`, `mu2`, ..., the components of the momentum.
    ///
    /// # Errors
    /// A formula that is refused, or two columns of one name.
    pub fn formulas(
        &self,
        names: &Names,
        allowed: &dyn Fn(Quantity) -> bool,
        casimirs: &[Symbolic],
        source: &Source,
    ) -> Result<RowFormulas, InputError> {
        let help = || format!("the names here are {}", names.all());
        let (mut scope, mut columns, mut formulas) = (Scope::default(), vec![], vec![]);
        for stem in &self.columns {
            let expanded = names.expand(stem.text());
            if expanded.is_empty() {
                let message = format!("`{}` is no quantity of this motion", shown(stem.text()));
                return Err(InputError::usage(message).at(&stem.place()).help(help()));
            }
            let watched = ["h", "energy"].contains(&stem.text());
            for name in expanded {
                expect_new(&columns, &name, &stem.place())?;
                let formula = scope.read(&name, names, allowed);
                formulas.push(formula.map_err(|error| stem.refused(error, help()))?);
                columns.push(Column::new(name, watched));
            }
        }
        for (name, written) in &self.quantities {
            expect_new(&columns, name, &source.key(&format!("quantities.{name}")))?;
            let formula = scope.read(written.text(), names, allowed);
            formulas.push(formula.map_err(|error| written.refused(error, help()))?);
            let formula = Some(written.text().into());
            columns.push(Column { name: name.clone(), formula, watched: true });
        }
        for (i, casimir) in casimirs.iter().enumerate() {
            let text = casimir.to_string().replace("mu", names.momentum());
            if let Ok(formula) = scope.read(&text, names, allowed) {
                formulas.push(formula);
                let name = format!("casimir{}", i + 1);
                columns.push(Column { name, formula: Some(text), watched: true });
            }
        }
        let mut events = Vec::new();
        for (name, written) in &self.events {
            let formula = scope.read(written.text(), names, allowed);
            formulas.push(formula.map_err(|error| written.refused(error, help()))?);
            events.push(name.clone());
        }
        Ok(RowFormulas { columns, events, formulas: (scope, formulas) })
    }
}

/// Checks that no column has the name yet.
fn expect_new(columns: &[Column], name: &str, place: &Place) -> Result<(), InputError> {
    let is_new = columns.iter().all(|column| column.name != name);
    if is_new { Ok(()) } else { Err(twice(name, place)) }
}

fn twice(name: &str, place: &Place) -> InputError {
    InputError::usage(format!("there are two columns `{}`", shown(name))).at(place)
}

/// Checks that columns have distinct names, also beside those of an ensemble. A Casimir function, a multiplier or a
/// parameter of an ensemble may have the name of a quantity.
pub(super) fn expect_distinct(
    columns: &[Column],
    of_ensemble: &[&str],
    source: &Source,
) -> Result<(), InputError> {
    for (at, Column { name, .. }) in columns.iter().enumerate() {
        let place = source.key(&format!("quantities.{name}"));
        expect_new(&columns[..at], name, &place)?;
        if of_ensemble.contains(&&**name) {
            return Err(twice(name, &place));
        }
    }
    Ok(())
}

/// The times of rows, as formulas in the parameters.
#[derive(Clone, Debug)]
pub(super) struct Times {
    start: Option<Value>,
    rows: Rows,
}

#[derive(Clone, Debug)]
enum Rows {
    /// At these times.
    Listed(Vec<Value>),
    /// The end, and the interval between rows.
    Spaced(Box<(Value, Option<Value>)>),
}

impl Times {
    /// The times of an output; the initial time is 0 unless `start` gives it.
    fn read(keys: &OutputKeys, start: Option<Value>, reader: &Reader) -> Result<Self, InputError> {
        let rows = match (&keys.times, &keys.end, &keys.every) {
            (Some(times), None, None) => Rows::Listed(reader.values(times)?),
            (None, Some(end), every) => {
                Rows::Spaced(Box::new((reader.value(end)?, reader.optional(every)?)))
            }
            _ => {
                let message = "the output has an end and optionally every, or times";
                return Err(InputError::usage(message).at(&reader.source.key("output")));
            }
        };
        Ok(Times { start, rows })
    }

    /// The times at these values of the parameters, the start first.
    pub fn at(&self, source: &Source, parameters: &[f64]) -> Result<Vec<f64>, InputError> {
        let number = |key: &str, value: &Value| {
            value.at(parameters).map_err(|error| error.or_near(&source.key(key)))
        };
        let start = self.start.as_ref().map_or(Ok(0.0), |start| number("initial.time", start))?;
        match &self.rows {
            Rows::Listed(times) => {
                let mut all = vec![start];
                for time in times {
                    let time = number("output.times", time)?;
                    if time != all[all.len() - 1] {
                        all.push(time);
                    }
                }
                let forwards = all.windows(2).all(|pair| pair[0] < pair[1]);
                if forwards || all.windows(2).all(|pair| pair[0] > pair[1]) {
                    return Ok(all);
                }
                let message = "the times neither increase nor decrease from the start";
                Err(InputError::usage(message).at(&source.key("output.times")))
            }
            Rows::Spaced(spaced) => {
                let (end, every) = &**spaced;
                let end = number("output.end", end)?;
                let every =
                    every.as_ref().map(|every| number("output.every", every)).transpose()?;
                equally(start, end, every.unwrap_or((end - start).abs()))
                    .map_err(|error| error.at(&source.key("output.every")))
            }
        }
    }

    /// The start and the end alone.
    pub fn to_the_end(&self) -> Self {
        let rows = match &self.rows {
            Rows::Listed(times) => Rows::Listed(times.last().into_iter().cloned().collect()),
            Rows::Spaced(spaced) => Rows::Spaced(Box::new((spaced.0.clone(), None))),
        };
        Times { start: self.start.clone(), rows }
    }
}

/// Times from a start to an end at intervals of `every`.
fn equally(start: f64, end: f64, every: f64) -> Result<Vec<f64>, InputError> {
    if every.is_nan() || every <= 0.0 && end != start {
        return Err(InputError::usage(format!("rows every {every} never come to the end")));
    }
    if end == start {
        return Ok(vec![start]);
    }
    let count = (end - start).abs() / every;
    if count > MAX_ROWS {
        let message = format!("{count:.0} rows are too many, the limit is {MAX_ROWS}");
        return Err(InputError::usage(message));
    }
    // rounding must not add or lose a row
    let whole = (count + 1e-9).floor() as u64;
    let every = every.copysign(end - start);
    let mut times: Vec<f64> = (0..=whole).map(|k| start + every * k as f64).collect();
    if (count - whole as f64).abs() < 1e-9 {
        times.pop();
    }
    times.push(end);
    Ok(times)
}
