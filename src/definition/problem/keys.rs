//! The keys of a problem, and what they say.

use super::ensemble::{Distribution, Ensemble, MAX_MEMBERS};
use super::matrices::{Flow, Matrices};
use super::{Course, Force, Kind, OnGroup, Problem, StartElement, Value, Written};
use crate::definition::document::Document;
use crate::definition::input::{InputError, Place, Source, shown};
use crate::definition::notation::check_name;
use crate::definition::written::{Cell, MetricText, Number, NumbersText, Text, TextsText};
use crate::definition::{Reading, Request, Space, file, numbers};
use crate::formula::Formula;
use crate::simulation::{Method, Side, Table};
use crate::{LieAlgebra, LiePoisson};
use affinor_tensors::{Symbolic, Tolerance};
use std::path::Path;

/// The most rows of one motion.
const MAX_ROWS: f64 = 1e8;
/// The most steps under control between two rows, unless another limit is given.
const MAX_STEPS: usize = 10_000_000;
/// Algebras up to this dimension have their Casimirs computed, up to the second degree.
const CASIMIRS: usize = 6;
/// What is written down where nothing is said.
const COLUMNS: [&str; 6] = ["t", "element", "Omega", "H", "h", "energy"];

/// The keys of a file.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Keys<'t> {
    name: Option<String>,
    #[serde(borrow)]
    space: Option<Text<'t>>,
    #[serde(borrow)]
    definition: Option<Document<'t>>,
    #[serde(borrow)]
    metric: Option<MetricText<'t>>,
    #[serde(borrow)]
    connection: Option<Text<'t>>,
    #[serde(borrow)]
    invariance: Option<Text<'t>>,
    #[serde(borrow)]
    parameters: Option<NumbersText<'t>>,
    #[serde(borrow)]
    flow: Option<FlowKeys<'t>>,
    #[serde(borrow, default)]
    initial: InitialKeys<'t>,
    #[serde(borrow)]
    given: Option<GivenKeys<'t>>,
    #[serde(borrow, default)]
    forces: ForceKeys<'t>,
    #[serde(borrow, default)]
    integrator: IntegratorKeys<'t>,
    #[serde(borrow)]
    output: OutputKeys<'t>,
    #[serde(borrow)]
    quantities: Option<TextsText<'t>>,
    #[serde(borrow)]
    ensemble: Option<EnsembleKeys<'t>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct FlowKeys<'t> {
    #[serde(borrow)]
    kind: Text<'t>,
    #[serde(borrow)]
    positions: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    momenta: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    masses: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    momentum: Option<Vec<Vec<Number<'t>>>>,
    size: Option<usize>,
    #[serde(borrow)]
    modes: Option<Vec<Vec<Number<'t>>>>,
    seed: Option<u64>,
    degree: Option<usize>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct GivenKeys<'t> {
    #[serde(borrow)]
    velocity: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    space_velocity: Option<Vec<Number<'t>>>,
}

#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct InitialKeys<'t> {
    #[serde(borrow)]
    time: Option<Number<'t>>,
    #[serde(borrow)]
    element: Option<Vec<Vec<Number<'t>>>>,
    #[serde(borrow)]
    coordinates: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    quaternion: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    position: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    velocity: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    space_velocity: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    momentum: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    space_momentum: Option<Vec<Number<'t>>>,
}

#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct ForceKeys<'t> {
    #[serde(borrow)]
    body: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    space: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    potential: Option<Text<'t>>,
    #[serde(borrow)]
    table: Option<Text<'t>>,
    #[serde(borrow)]
    table_in: Option<Text<'t>>,
}

#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct IntegratorKeys<'t> {
    #[serde(borrow)]
    method: Option<Text<'t>>,
    #[serde(borrow)]
    step: Option<Number<'t>>,
    #[serde(borrow)]
    tolerance: Option<Number<'t>>,
    max_steps: Option<usize>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct OutputKeys<'t> {
    #[serde(borrow)]
    end: Option<Number<'t>>,
    #[serde(borrow)]
    every: Option<Number<'t>>,
    #[serde(borrow)]
    times: Option<Vec<Number<'t>>>,
    #[serde(borrow)]
    columns: Option<Vec<Text<'t>>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct EnsembleKeys<'t> {
    #[serde(borrow)]
    grid: Option<TextsText<'t>>,
    #[serde(borrow)]
    random: Option<TextsText<'t>>,
    samples: Option<u64>,
    seed: Option<u64>,
}

impl Problem {
    pub(super) fn understand(source: &Source, folder: &Path) -> Result<Self, InputError> {
        let content = "a problem has a space, its metric, initial values and an output";
        let keys: Keys = file::keys(source, content)?;
        let reader = Reader { source, names: Vec::new(), values: Vec::new() };
        keys.problem(reader, folder)
    }
}

/// Reads numbers, which are formulas in the parameters that are known so far.
struct Reader<'s> {
    source: &'s Source,
    names: Vec<String>,
    /// Of those that are no ensemble's own.
    values: Vec<f64>,
}

impl Reader<'_> {
    fn written(&self, Text(text): &Text) -> Written {
        let source = self.source.holding(text);
        let own = source.own(text);
        Written { text: own.to_string(), place: source.whole(own) }
    }

    fn value(&self, Number(text): &Number) -> Result<Value, InputError> {
        let written = self.written(text);
        let names = &self.names;
        let formula =
            Formula::parse(&written.text, &mut |name| names.iter().position(|own| own == name));
        let help = || match names.as_slice() {
            [] => "there are no parameters, only pi and tau".to_string(),
            names => format!("the parameters are {}", names.join(", ")),
        };
        let formula = formula.map_err(|error| written.refused(error, help()))?;
        Ok(Value { formula, written })
    }

    fn values(&self, list: &[Number]) -> Result<Vec<Value>, InputError> {
        list.iter().map(|number| self.value(number)).collect()
    }

    /// A number that no ensemble varies.
    fn number(&self, number: &Number) -> Result<f64, InputError> {
        let value = self.value(number)?;
        if self.names.len() > self.values.len() {
            // the ensemble's own parameters have no value of their own
            let mut values = self.values.clone();
            values.resize(self.names.len(), f64::NAN);
            return value.at(&values);
        }
        value.at(&self.values)
    }

    fn declare(&mut self, Text(name): &Text) -> Result<(), InputError> {
        let place = self.source.whole(name);
        check_name(name).map_err(|error| error.at(&place))?;
        self.names.push(name.to_string());
        Ok(())
    }
}

impl<'t> Keys<'t> {
    fn problem(self, mut reader: Reader, folder: &Path) -> Result<Problem, InputError> {
        let source = reader.source;
        for (name, number) in self.parameters.iter().flat_map(|table| &table.0) {
            let value = reader.number(number)?;
            reader.declare(name)?;
            reader.values.push(value);
        }
        let parameters = reader.names.iter().cloned().zip(reader.values.iter().copied()).collect();
        let ensemble = match &self.ensemble {
            Some(keys) => Some(keys.ensemble(&mut reader)?),
            None => None,
        };
        let right = match self.invariance.as_ref().map(|Text(text)| &**text) {
            None | Some("left") => false,
            Some("right") => true,
            Some(other) => {
                let message = format!("`{}` is neither left nor right", shown(other));
                return Err(InputError::usage(message).at(&source.key("invariance")));
            }
        };
        let method = match &self.integrator.method {
            None => None,
            Some(Text(name)) => Some(Method::from_name(name).ok_or_else(|| {
                let all = Method::ALL.map(Method::name).join(", ");
                let message = format!("`{}` is no method", shown(name));
                let place = source.whole(name);
                InputError::usage(message).at(&place).help(format!("the methods are {all}"))
            })?),
        };
        let default = Number(Text("1e-10".into()));
        let tolerance = reader.value(self.integrator.tolerance.as_ref().unwrap_or(&default))?;
        let max_steps = self.integrator.max_steps.unwrap_or(MAX_STEPS);
        let step = self.integrator.step.as_ref().map(|step| reader.value(step)).transpose()?;
        let time = self.initial.time.as_ref().map_or(Ok(0.0), |time| reader.number(time))?;
        let times = self.output.times(time, &reader)?;
        let columns = match &self.output.columns {
            Some(columns) => columns.iter().map(|column| reader.written(column)).collect(),
            None => COLUMNS.map(|name| reader.written(&Text(name.into()))).to_vec(),
        };
        let quantities = self.quantities.iter().flat_map(|table| &table.0);
        let quantities = quantities.map(|(name, text)| {
            check_name(&name.0).map_err(|error| error.at(&source.whole(&name.0)))?;
            Ok((name.0.to_string(), reader.written(text)))
        });
        let quantities = quantities.collect::<Result<_, InputError>>()?;
        let name = self.name.clone().unwrap_or_else(|| stem(&source.name));
        let kind = match &self.flow {
            Some(flow) => {
                Kind::Matrices(Matrices { flow: flow.flow(&reader)?, place: source.key("flow") })
            }
            None => {
                let (forces, potential) = (self.forces.forces(&reader), &self.forces.potential);
                let potential = potential.as_ref().map(|text| reader.written(text));
                let table = self.forces.table(source, folder)?;
                let element = self.initial.element(&reader)?;
                let course = self.course(&reader)?;
                let is_given = matches!(course, Course::Given(..));
                let space = self.space(source, folder)?;
                let casimirs = if is_given { vec![] } else { casimirs(&space) };
                Kind::Group(Box::new(OnGroup {
                    space,
                    right,
                    element,
                    course,
                    forces,
                    potential,
                    table,
                    casimirs,
                }))
            }
        };
        Ok(Problem {
            name,
            source: source.clone(),
            parameters,
            kind,
            method,
            step,
            tolerance,
            max_steps,
            times,
            columns,
            quantities,
            ensemble,
        })
    }

    fn course(&self, reader: &Reader) -> Result<Course, InputError> {
        let Some(given) = &self.given else { return self.initial.course(reader) };
        let written = |list: &Vec<Number>| list.iter().map(|n| reader.written(&n.0)).collect();
        match (&given.velocity, &given.space_velocity) {
            (Some(list), None) => Ok(Course::Given(Side::Body, written(list))),
            (None, Some(list)) => Ok(Course::Given(Side::Space, written(list))),
            _ => {
                let message = "give one of velocity, space_velocity";
                Err(InputError::usage(message).at(&reader.source.key("given")))
            }
        }
    }

    fn space(self, source: &Source, folder: &Path) -> Result<Space, InputError> {
        let metric = self.metric.map(|metric| match metric {
            MetricText::Word(Text(text)) => text.into_owned(),
            MetricText::Rows(rows) => {
                let row = |row: &Vec<Cell>| {
                    let cells: Vec<&str> = row.iter().map(|cell| &*cell.0.0).collect();
                    format!("[{}]", cells.join(","))
                };
                format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join(","))
            }
        });
        let connection = self.connection.map(|Text(text)| text.into_owned());
        let request = Request { metric, connection, ..Request::default() };
        match (self.space, self.definition) {
            (Some(Text(name)), None) => {
                let is_file = name.ends_with(".toml") || name.ends_with(".json");
                let path = || folder.join(&*name).to_string_lossy().into_owned();
                let space = if is_file { path() } else { name.to_string() };
                let space = Space::open(&Request { space: Some(space), ..request });
                space.map_err(|error| error.or_at(&source.whole(&name)))
            }
            (None, Some(keys)) => Space::of(keys.define(source)?, &request),
            (None, None) => {
                let error = InputError::usage("the problem names no space");
                Err(error.help("give space = \"so3\", a file, or a table [definition]"))
            }
            (Some(_), Some(_)) => {
                let error = InputError::usage("the space is named and defined as well");
                Err(error.at(&source.key("space")).help("give one of space, definition"))
            }
        }
    }
}

/// The name of a file without its folder and ending.
fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| name.into())
}

/// Casimirs of the algebra up to the second degree, where it is small and without parameters.
fn casimirs(space: &Space) -> Vec<String> {
    if space.definition.dimension() > CASIMIRS || space.definition.is_on_chart() {
        return vec![];
    }
    let convert = |value: &Symbolic| Some(value.clone());
    let reading = Reading { convert: &convert, tolerance: Tolerance::default() };
    let algebra: Result<LieAlgebra<Symbolic>, _> = space.definition.algebra(&reading);
    let dual = algebra.ok().and_then(|algebra| LiePoisson::left(&algebra).ok());
    let found = dual.and_then(|dual| dual.casimir_generators(2).ok());
    found.unwrap_or_default().iter().map(Symbolic::to_string).collect()
}

impl InitialKeys<'_> {
    fn element(&self, reader: &Reader) -> Result<StartElement, InputError> {
        let source = reader.source;
        let element = match (&self.element, &self.coordinates, &self.quaternion) {
            (None, None, None) => StartElement::Identity,
            (Some(rows), None, None) => {
                let rows = rows.iter().map(|row| reader.values(row)).collect::<Result<_, _>>()?;
                StartElement::Rows(rows, source.key("element"))
            }
            (None, Some(x), None) => StartElement::Coordinates(reader.values(x)?),
            (None, None, Some(q)) => {
                let position = self.position.as_deref().unwrap_or(&[]);
                let (q, position) = (reader.values(q)?, reader.values(position)?);
                StartElement::Pose(q, position, source.key("quaternion"))
            }
            _ => {
                let message = "the element is given more than once";
                let help = "give one of element, coordinates, quaternion";
                return Err(InputError::usage(message).at(&source.key("initial")).help(help));
            }
        };
        if self.position.is_some() && self.quaternion.is_none() {
            let message = "a position stands beside a quaternion";
            return Err(InputError::usage(message).at(&source.key("position")));
        }
        Ok(element)
    }

    /// The velocity or the momentum.
    fn course(&self, reader: &Reader) -> Result<Course, InputError> {
        let source = reader.source;
        let given = [
            self.velocity.as_ref().map(|v| (true, Side::Body, v)),
            self.space_velocity.as_ref().map(|v| (true, Side::Space, v)),
            self.momentum.as_ref().map(|h| (false, Side::Body, h)),
            self.space_momentum.as_ref().map(|h| (false, Side::Space, h)),
        ];
        let mut given = given.into_iter().flatten();
        let help = "give one of velocity, momentum, space_velocity, space_momentum";
        match (given.next(), given.next()) {
            (Some((true, side, v)), None) => Ok(Course::Velocity(side, reader.values(v)?)),
            (Some((false, side, h)), None) => Ok(Course::Momentum(side, reader.values(h)?)),
            (None, _) => {
                let error = InputError::usage("there is no velocity at the start");
                Err(error.at(&source.key("initial")).help(help))
            }
            (Some(_), Some(_)) => {
                let error = InputError::usage("the velocity is given more than once");
                Err(error.at(&source.key("initial")).help(help))
            }
        }
    }
}

impl FlowKeys<'_> {
    fn flow(&self, reader: &Reader) -> Result<Flow, InputError> {
        let source = reader.source;
        let missing = |keys: &str| {
            let message = format!("the flow {} needs {keys}", shown(&self.kind.0));
            InputError::usage(message).at(&source.key("flow"))
        };
        let rows = |rows: &Vec<Vec<Number>>| -> Result<Vec<Vec<Value>>, InputError> {
            rows.iter().map(|row| reader.values(row)).collect()
        };
        match &*self.kind.0 {
            "toda" => {
                let both = self.positions.as_ref().zip(self.momenta.as_ref());
                let (positions, momenta) = both.ok_or_else(|| missing("positions and momenta"))?;
                let (positions, momenta) = (reader.values(positions)?, reader.values(momenta)?);
                Ok(Flow::Toda { positions, momenta })
            }
            "manakov" => {
                let both = self.masses.as_ref().zip(self.momentum.as_ref());
                let (masses, momentum) = both.ok_or_else(|| missing("masses and momentum"))?;
                Ok(Flow::Manakov { masses: reader.values(masses)?, momentum: rows(momentum)? })
            }
            "zeitlin" => {
                let size = self.size.ok_or_else(|| missing("a size"))?;
                match (&self.modes, self.seed) {
                    (Some(modes), None) => Ok(Flow::Zeitlin { size, modes: rows(modes)? }),
                    (None, Some(seed)) => {
                        let degree = self.degree.ok_or_else(|| missing("a degree"))?;
                        Ok(Flow::RandomZeitlin { size, seed, degree })
                    }
                    _ => Err(missing("modes, or else a seed and a degree")),
                }
            }
            other => {
                let message = format!("`{}` is no flow", shown(other));
                let error = InputError::usage(message).at(&source.whole(&self.kind.0));
                Err(error.help("the flows are toda, manakov, zeitlin"))
            }
        }
    }
}

impl ForceKeys<'_> {
    fn forces(&self, reader: &Reader) -> Vec<Force> {
        let of = |side: Side, list: &Option<Vec<Number>>| -> Vec<Force> {
            let components = list.iter().flatten().enumerate();
            let force = |(index, number): (usize, &Number)| Force {
                side,
                index,
                written: reader.written(&number.0),
            };
            components.map(force).collect()
        };
        let mut forces = of(Side::Body, &self.body);
        forces.extend(of(Side::Space, &self.space));
        forces
    }

    fn table(&self, source: &Source, folder: &Path) -> Result<Option<(Side, Table)>, InputError> {
        let side = match self.table_in.as_ref().map(|Text(text)| &**text) {
            None | Some("body") => Side::Body,
            Some("space") => Side::Space,
            Some(other) => {
                let message = format!("`{}` is neither body nor space", shown(other));
                return Err(InputError::usage(message).at(&source.key("table_in")));
            }
        };
        let Some(Text(name)) = &self.table else { return Ok(None) };
        let (_, rows) = file::read_rows(&folder.join(&**name).to_string_lossy())?;
        let table = Table::new(rows).map_err(|error| InputError::usage(error.to_string()))?;
        Ok(Some((side, table)))
    }
}

impl OutputKeys<'_> {
    /// The times of the rows.
    fn times(&self, start: f64, reader: &Reader) -> Result<Vec<f64>, InputError> {
        let source = reader.source;
        match (&self.times, &self.end, &self.every) {
            (Some(times), None, None) => {
                let mut all = vec![start];
                for time in times {
                    let time = reader.number(time)?;
                    if time != all[all.len() - 1] {
                        all.push(time);
                    }
                }
                let forwards = all.windows(2).all(|pair| pair[0] < pair[1]);
                if forwards || all.windows(2).all(|pair| pair[0] > pair[1]) {
                    return Ok(all);
                }
                let message = "the times neither increase nor decrease from the start";
                Err(InputError::usage(message).at(&source.key("times")))
            }
            (None, Some(end), every) => {
                let end = reader.number(end)?;
                let every = match every {
                    Some(every) => reader.number(every)?,
                    None => (end - start).abs(),
                };
                if every.is_nan() || every <= 0.0 && end != start {
                    let message = format!("rows every {every} never come to the end");
                    return Err(InputError::usage(message).at(&source.key("every")));
                }
                if end == start {
                    return Ok(vec![start]);
                }
                let count = (end - start).abs() / every;
                if count > MAX_ROWS {
                    let message = format!("{count:.0} rows are too many, the limit is {MAX_ROWS}");
                    return Err(InputError::usage(message).at(&source.key("every")));
                }
                // a whole number of rows is not spoilt by rounding
                let whole = (count + 1e-9).floor() as u64;
                let every = every.copysign(end - start);
                let mut times: Vec<f64> = (0..=whole).map(|k| start + every * k as f64).collect();
                if (count - whole as f64).abs() < 1e-9 {
                    times.pop();
                }
                times.push(end);
                Ok(times)
            }
            _ => {
                let message = "the output has an end, perhaps with every, or else times";
                Err(InputError::usage(message).at(&source.key("output")))
            }
        }
    }
}

impl EnsembleKeys<'_> {
    fn ensemble(&self, reader: &mut Reader) -> Result<Ensemble, InputError> {
        let source = reader.source;
        let (mut grid, mut random) = (vec![], vec![]);
        for (name, text) in self.grid.iter().flat_map(|table| &table.0) {
            grid.push((name.0.to_string(), points(text, reader)?));
        }
        for (name, text) in self.random.iter().flat_map(|table| &table.0) {
            random.push((name.0.to_string(), distribution(text, reader)?));
        }
        let all = self.grid.iter().chain(&self.random).flat_map(|table| &table.0);
        let mut seen: Vec<&str> = vec![];
        for (name, _) in all {
            if seen.contains(&&*name.0) {
                let message = format!("`{}` is varied twice", shown(&name.0));
                return Err(InputError::usage(message).at(&source.whole(&name.0)));
            }
            seen.push(&name.0);
            if !reader.names.contains(&name.0.to_string()) {
                reader.declare(name)?;
            }
        }
        let (samples, seed) = (self.samples.unwrap_or(1), self.seed.unwrap_or(0));
        let ensemble = Ensemble { grid, random, samples, seed };
        if ensemble.checked_size().is_none() {
            let message = format!("an ensemble has between 1 and {MAX_MEMBERS} members");
            return Err(InputError::usage(message).at(&source.key("ensemble")));
        }
        Ok(ensemble)
    }
}

/// `from .. to in n`, or a list of values.
fn points(text: &Text, reader: &Reader) -> Result<Vec<f64>, InputError> {
    let written = reader.written(text);
    let range = written.text.split_once("..").and_then(|(from, rest)| {
        let (to, count) = rest.split_once(" in ")?;
        Some((from.trim(), to.trim(), count.trim().parse::<u32>().ok()?))
    });
    let number = |text: &str| numbers_of(text, 1, &written.place).map(|found| found[0]);
    match range {
        Some((from, to, count)) if count > 0 => {
            let (from, to) = (number(from)?, number(to)?);
            let last = f64::from(count.max(2) - 1);
            Ok((0..count).map(|k| from + (to - from) * (f64::from(k) / last)).collect())
        }
        Some(_) => Err(InputError::usage("a grid has at least one point").at(&written.place)),
        None => {
            let all = numbers(&Source::new("a grid", &written.text));
            let all = all.map_err(|error| InputError::usage(error.message).at(&written.place))?;
            if all.is_empty() {
                let error = InputError::usage("a grid is \"0 .. 1 in 11\", or a list of numbers");
                return Err(error.at(&written.place));
            }
            Ok(all)
        }
    }
}

/// `normal(mean, deviation)` or `uniform(from, to)`.
fn distribution(text: &Text, reader: &Reader) -> Result<Distribution, InputError> {
    let written = reader.written(text);
    let inside = |name: &str| {
        let rest = written.text.trim().strip_prefix(name)?.trim().strip_prefix('(')?;
        rest.strip_suffix(')')
    };
    if let Some(inside) = inside("normal") {
        let found = numbers_of(inside, 2, &written.place)?;
        return Ok(Distribution::Normal(found[0], found[1]));
    }
    if let Some(inside) = inside("uniform") {
        let found = numbers_of(inside, 2, &written.place)?;
        return Ok(Distribution::Uniform(found[0], found[1]));
    }
    let message = "this is neither normal(mean, deviation) nor uniform(from, to)";
    Err(InputError::usage(message).at(&written.place))
}

fn numbers_of(text: &str, count: usize, place: &Place) -> Result<Vec<f64>, InputError> {
    let found = numbers(&Source::new("a value", text));
    let found = found.map_err(|error| InputError::usage(error.message).at(place))?;
    if found.len() == count {
        return Ok(found);
    }
    let message = format!("{} numbers stand here instead of {count}", found.len());
    Err(InputError::usage(message).at(place))
}
