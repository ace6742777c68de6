//! The rows of a motion: their times, columns and events.

use super::keys::{Keys, OutputKeys};
use super::reader::{Reader, Value, Written};
use super::ready::{Column, Kept};
use crate::input::{InputError, Place, Source, forms::Text, shown};
use affinor::mechanics::formula::Formula;
use affinor::mechanics::simulation::ColumnFormulas;
use affinor::mechanics::simulation::quantities::{FormulaScope, MotionQuantity, SymbolTable};
use affinor_tensors::Symbolic;
use affinor_tensors::expression::ExpressionError;

/// The largest number of rows of one motion.
const MAX_ROWS: f64 = 1e7;

/// The default columns on a group. A motion with a prescribed velocity has only the first three.
const COLUMNS: [&str; 6] = ["t", "element", "Omega", "H", "h", "energy"];

/// The keys of the table `[output]`, and the named quantities and events.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub times: Times,
    /// The columns; `None` if the file sets none, so that the default of the class is used.
    columns: Option<Vec<Written>>,
    quantities: Vec<(String, Written)>,
    events: Vec<(String, Written)>,
    /// The terminal event.
    pub stop: Option<String>,
    /// The event at which rows are written, if rows are not written at given times.
    pub section: Option<String>,
    /// The names of the columns of constraints, which are always added at the end.
    following: Vec<String>,
}

/// The columns and events of a motion, with their formulas. The formulas of the events follow those
/// of the columns.
pub(super) struct RowFormulas {
    pub columns: Vec<Column>,
    pub events: Vec<String>,
    pub formulas: ColumnFormulas,
}

impl Output {
    pub fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let Some(output) = &keys.output else {
            let start = Place { source: source.clone(), span: Some(0..0) };
            let error = InputError::usage("missing field `output`").at(&start);
            return Err(error.help("give the final time, as in output = { end = 1, every = 0.1 }"));
        };
        let times = Times::read(output, reader.optional(&keys.initial.time)?, reader)?;
        let columns = output.columns.as_ref();
        let columns =
            columns.map(|columns| columns.iter().map(|column| reader.written(column)).collect());
        let quantities = reader.formulas(&keys.quantities)?;
        let events = reader.formulas(&keys.events)?;
        let event = |name: &Option<Text>| {
            let Some(name) = name else { return Ok(None) };
            if events.iter().any(|(event, _)| *event == name.content) {
                return Ok(Some(name.to_string()));
            }
            let error = InputError::usage(format!("`{}` is not an event", shown(name)));
            let help = "define events in a table [events], each as NAME = \"formula that changes its sign\"";
            Err(error.at(&source.at(name)).help(help))
        };
        let (stop, section) = (event(&output.stop)?, event(&output.section)?);
        let constraints =
            keys.constraints.as_ref().map_or(0, Vec::len) + keys.velocity_constraints().len();
        let mut following: Vec<String> = (1..=constraints).map(|a| format!("lambda{a}")).collect();
        if constraints > 0 {
            following.extend(["lambda", "violation"].map(String::from));
        }
        Ok(Output { times, columns, quantities, events, stop, section, following })
    }

    /// Returns the output with other columns. If a column of the motion and a quantity have the
    /// same name, the name means the column.
    pub fn with_columns(&self, names: &[&str], source: &Source) -> Self {
        let columns = names.iter().map(|name| Written::beside(source, *name)).collect();
        let mut output = Output { columns: Some(columns), ..self.clone() };
        output.quantities.retain(|(name, _)| !names.contains(&name.as_str()));
        output
    }

    /// Reads the formulas of the columns and events with the names of a motion on a group. Formulas
    /// may use only the quantities for which `allowed` is true. `casimirs` are polynomials in the
    /// components `mu1`, `mu2`, ... of the momentum.
    pub fn formulas(
        &self,
        names: &SymbolTable,
        allowed: &dyn Fn(MotionQuantity) -> bool,
        casimirs: &[Symbolic],
        kept: Kept,
        source: &Source,
    ) -> Result<RowFormulas, InputError> {
        let (scope, formulas) = (FormulaScope::default(), vec![]);
        let mut on_group = GroupNames { names, allowed, kept, scope, formulas };
        let (columns, events) = self.read_columns(&mut on_group, casimirs, source)?;
        let GroupNames { scope, formulas, .. } = on_group;
        Ok(RowFormulas { columns, events, formulas: ColumnFormulas { scope, formulas } })
    }

    /// Reads the formulas of the columns and events into `names`, and returns their names.
    /// `casimirs` are polynomials in the components `mu1`, `mu2`, ... of the momentum.
    pub fn read_columns(
        &self,
        names: &mut dyn RowNames,
        casimirs: &[Symbolic],
        source: &Source,
    ) -> Result<(Vec<Column>, Vec<String>), InputError> {
        let help = |names: &dyn RowNames| format!("the names here are {}", names.all());
        let mut columns = vec![];
        let add = |names: &mut dyn RowNames, text: &str, written: &Written| {
            let added = names.add(text);
            added.map_err(|error| written.refused(error, help(names)))
        };
        let own =
            || names.defaults().into_iter().map(|name| Written::beside(source, name)).collect();
        let stems: Vec<Written> = self.columns.clone().unwrap_or_else(own);
        for stem in &stems {
            let expanded = names.expand(stem.text());
            let named = self.quantities.iter().find(|(name, _)| name == stem.text());
            if let (Some((name, written)), true) = (named, expanded.is_empty()) {
                expect_new(&columns, &[], name, &stem.place())?;
                add(names, written.text(), written)?;
                columns.push(Column::named(name, written));
                continue;
            }
            if expanded.is_empty() && self.following.iter().any(|name| name == stem.text()) {
                continue;
            }
            if expanded.is_empty() {
                let message = format!("`{}` is not a quantity of this motion", shown(stem.text()));
                return Err(InputError::usage(message).at(&stem.place()).help(help(names)));
            }
            for name in expanded {
                expect_new(&columns, &[], &name, &stem.place())?;
                add(names, &name, stem)?;
                let (watched, conserved) = names.watched(stem.text(), &name);
                columns.push(Column { conserved, ..Column::new(name, watched) });
            }
        }
        for (name, written) in &self.quantities {
            let is_listed = stems.iter().any(|stem| stem.text() == name);
            if is_listed && names.expand(name).is_empty() {
                continue;
            }
            expect_new(&columns, &[], name, &source.key(&format!("quantities.{name}")))?;
            add(names, written.text(), written)?;
            columns.push(Column::named(name, written));
        }
        for (i, casimir) in casimirs.iter().enumerate() {
            let text = casimir.to_string().replace("mu", names.momentum());
            // leaves out a Casimir function with a coefficient beyond the range of floats
            if names.add(&text).is_ok() {
                let name = format!("casimir{}", i + 1);
                columns.push(Column { formula: Some(text), ..Column::new(name, true) });
            }
        }
        for (_, written) in &self.events {
            add(names, written.text(), written)?;
        }
        let events = self.events.iter().map(|(name, _)| name.clone()).collect();
        Ok((columns, events))
    }
}

/// The names that the columns and events of a class of problems may use.
pub(super) trait RowNames {
    /// The default columns.
    fn defaults(&self) -> Vec<&'static str>;

    /// All names with a stem such as `Omega`; empty for an unknown name.
    fn expand(&self, stem: &str) -> Vec<String>;

    /// All names, as text for messages.
    fn all(&self) -> String;

    /// Whether the summary of a run reports the change of the column `name`, which belongs to a
    /// stem, and whether the equations conserve the quantity.
    fn watched(&self, stem: &str, name: &str) -> (bool, bool);

    /// The name of the momentum in the frame of the equations.
    fn momentum(&self) -> &'static str;

    /// Adds the formula of the next column or event.
    fn add(&mut self, text: &str) -> Result<(), ExpressionError>;
}

/// The names of a motion on a group, and the formulas so far.
struct GroupNames<'n> {
    names: &'n SymbolTable,
    allowed: &'n dyn Fn(MotionQuantity) -> bool,
    kept: Kept,
    scope: FormulaScope,
    formulas: Vec<Formula>,
}

impl RowNames for GroupNames<'_> {
    fn defaults(&self) -> Vec<&'static str> {
        // a motion with a prescribed velocity has no momentum
        let has_momentum = (self.allowed)(MotionQuantity::Momentum(0));
        if has_momentum { COLUMNS.to_vec() } else { COLUMNS[..3].to_vec() }
    }

    fn expand(&self, stem: &str) -> Vec<String> {
        self.names.expand(stem)
    }

    fn all(&self) -> String {
        self.names.all(self.allowed)
    }

    fn watched(&self, stem: &str, _: &str) -> (bool, bool) {
        // the conserved momentum is in the frame that the equations do not use
        let conserved = if self.names.momentum() == "h" { "H" } else { "h" };
        let watched = ["energy", conserved].contains(&stem);
        let is_kept = if stem == "energy" { self.kept.energy } else { self.kept.momentum };
        (watched, watched && is_kept)
    }

    fn momentum(&self) -> &'static str {
        self.names.momentum()
    }

    fn add(&mut self, text: &str) -> Result<(), ExpressionError> {
        self.formulas.push(self.scope.read(text, self.names, self.allowed)?);
        Ok(())
    }
}

impl Column {
    /// The column for a named quantity.
    fn named(name: &str, written: &Written) -> Self {
        let formula = Some(written.text().into());
        Column { formula, conserved: false, ..Column::new(name, true) }
    }
}

/// Checks that the columns have distinct names, and that the ensemble does not use these names. A
/// quantity may have the same name as a Casimir function, a multiplier or a parameter of an
/// ensemble, so this must be checked.
pub(super) fn expect_distinct(
    columns: &[Column],
    of_ensemble: &[&str],
    source: &Source,
) -> Result<(), InputError> {
    for (at, Column { name, .. }) in columns.iter().enumerate() {
        let place = source.key(&format!("quantities.{name}"));
        expect_new(&columns[..at], of_ensemble, name, &place)?;
    }
    Ok(())
}

/// Checks that the name is not used by another column.
fn expect_new(
    columns: &[Column],
    others: &[&str],
    name: &str,
    place: &Place,
) -> Result<(), InputError> {
    if columns.iter().all(|column| column.name != name) && !others.contains(&name) {
        return Ok(());
    }
    Err(InputError::usage(format!("the column name `{}` occurs twice", shown(name))).at(place))
}

/// The times of rows, as formulas in the parameters.
#[derive(Clone, Debug)]
pub(super) struct Times {
    start: Option<Value>,
    rows: Rows,
}

#[derive(Clone, Debug)]
enum Rows {
    /// A list of times.
    Listed(Vec<Value>),
    /// The final time, and the interval between rows.
    Spaced(Box<(Value, Option<Value>)>),
}

impl Times {
    /// Reads the times of an output. The initial time is `start`; if it is `None`, 0.
    fn read(keys: &OutputKeys, start: Option<Value>, reader: &Reader) -> Result<Self, InputError> {
        let rows = match (&keys.times, &keys.end, &keys.every) {
            (Some(times), None, None) => Rows::Listed(reader.values(times)?),
            (None, Some(end), every) => {
                Rows::Spaced(Box::new((reader.value(end)?, reader.optional(every)?)))
            }
            _ => {
                let message = "give `end` and optionally `every`, or `times`";
                return Err(reader.source.refused("output", message));
            }
        };
        Ok(Times { start, rows })
    }

    /// Returns the same initial time with these output times.
    pub fn listed(&self, times: &[f64], source: &Source) -> Self {
        let times = times.iter().map(|time| Value::constant(source, *time)).collect();
        Times { start: self.start.clone(), rows: Rows::Listed(times) }
    }

    /// The times, for these values of the parameters. The first time is the initial time.
    pub fn at(&self, source: &Source, parameters: &[f64]) -> Result<Vec<f64>, InputError> {
        let start = self.start.as_ref().map_or(Ok(0.0), |start| start.at(parameters))?;
        match &self.rows {
            Rows::Listed(times) => {
                let mut all = vec![start];
                for time in times {
                    let time = time.at(parameters)?;
                    if time != all[all.len() - 1] {
                        all.push(time);
                    }
                }
                let forwards = all.windows(2).all(|pair| pair[0] < pair[1]);
                if forwards || all.windows(2).all(|pair| pair[0] > pair[1]) {
                    return Ok(all);
                }
                let message = "the times must increase or decrease from the start";
                Err(source.refused("output.times", message))
            }
            Rows::Spaced(spaced) => {
                let (end, every) = &**spaced;
                let end = end.at(parameters)?;
                let interval = every.as_ref().map(|every| every.at(parameters)).transpose()?;
                equally(start, end, interval.unwrap_or((end - start).abs()))
                    .map_err(|error| error.or_at(every.as_ref().map(Value::place).as_ref()))
                    .map_err(|error| error.or_at(&source.key("output.every")))
            }
        }
    }

    /// Returns only the initial and the final time.
    pub fn to_the_end(&self) -> Self {
        let rows = match &self.rows {
            Rows::Listed(times) => Rows::Listed(times.last().into_iter().cloned().collect()),
            Rows::Spaced(spaced) => Rows::Spaced(Box::new((spaced.0.clone(), None))),
        };
        Times { start: self.start.clone(), rows }
    }

    /// Returns the times with another final time or another interval between rows.
    pub fn replaced(&self, end: Option<Value>, every: Option<Value>) -> Self {
        let (old_end, old_every) = match &self.rows {
            Rows::Listed(times) => (times.last().cloned(), None),
            Rows::Spaced(spaced) => (Some(spaced.0.clone()), spaced.1.clone()),
        };
        let rows = match (end.or(old_end), every.or(old_every)) {
            (Some(end), every) => Rows::Spaced(Box::new((end, every))),
            (None, _) => self.rows.clone(),
        };
        Times { start: self.start.clone(), rows }
    }
}

/// Equidistant times from a start to an end, at intervals of `every`.
fn equally(start: f64, end: f64, every: f64) -> Result<Vec<f64>, InputError> {
    if every.is_nan() || every <= 0.0 && end != start {
        return Err(InputError::usage(format!(
            "`every` is {every}, but the interval between rows must be positive"
        )));
    }
    if end == start {
        return Ok(vec![start]);
    }
    let count = (end - start).abs() / every;
    if count > MAX_ROWS {
        let message = format!("{count:.0} rows exceed the limit of {MAX_ROWS}");
        return Err(InputError::usage(message));
    }
    // allows for rounding errors, which must not add or remove a row
    let rounding = f64::EPSILON * start.abs().max(end.abs()) / every;
    let slack = (1e-9 + 4.0 * rounding).min(0.25);
    let whole = (count + slack).floor() as u64;
    let every = every.copysign(end - start);
    let mut times: Vec<f64> = (0..=whole).map(|k| start + every * k as f64).collect();
    if (count - whole as f64).abs() < slack {
        times.pop();
    }
    times.push(end);
    Ok(times)
}
