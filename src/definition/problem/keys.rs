//! The keys of a problem, and what they say.

use super::control::Control;
use super::ensemble::EnsembleKeys;
use super::folder::Folder;
use super::inertia::InertiaKeys;
use super::launch::casimirs;
use super::matrices::{FlowKeys, Matrices};
use super::output::OutputKeys;
use super::reader::Reader;
use super::{Course, Force, Kind, OnGroup, Parameter, Places, Problem, StartElement, stem};
use crate::definition::document::Document;
use crate::definition::input::{InputError, Source, shown};
use crate::definition::written::{
    Cell, MetricText, Number, NumbersText, OneOrMore, Text, TextsText,
};
use crate::definition::{Request, Space, file};
use crate::simulation::{Method, Side, Table};
use std::sync::OnceLock;

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
    inertia: Option<InertiaKeys<'t>>,
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
    #[serde(borrow)]
    hamiltonian: Option<Text<'t>>,
    #[serde(borrow)]
    constraints: Option<Vec<Text<'t>>>,
    #[serde(borrow)]
    forces: Option<ForceKeys<'t>>,
    #[serde(borrow, default)]
    integrator: IntegratorKeys<'t>,
    #[serde(borrow)]
    output: OutputKeys<'t>,
    #[serde(borrow)]
    quantities: Option<TextsText<'t>>,
    #[serde(borrow)]
    events: Option<TextsText<'t>>,
    #[serde(borrow)]
    ensemble: Option<EnsembleKeys<'t>>,
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
    #[serde(borrow)]
    absolute_tolerance: Option<OneOrMore<'t>>,
    #[serde(borrow)]
    max_step: Option<Number<'t>>,
    max_steps: Option<usize>,
}

impl IntegratorKeys<'_> {
    fn control(&self, reader: &Reader) -> Result<Control, InputError> {
        let absolute = self.absolute_tolerance.as_ref().map(|OneOrMore(numbers)| {
            match &reader.values(numbers)?[..] {
                [both] => Ok([both.clone(), both.clone()]),
                [turns, translations] => Ok([turns.clone(), translations.clone()]),
                others => {
                    let message = format!("`absolute_tolerance` has {} numbers", others.len());
                    let help = "one is of turns and translations, two are of each";
                    let place = reader.source.key("absolute_tolerance");
                    Err(InputError::usage(message).at(&place).help(help))
                }
            }
        });
        Ok(Control {
            tolerance: reader.optional(&self.tolerance)?,
            absolute: absolute.transpose()?,
            max_step: reader.optional(&self.max_step)?,
            max_steps: self.max_steps,
        })
    }
}

impl Problem {
    pub(super) fn understand(source: &Source, folder: &Folder) -> Result<Self, InputError> {
        let content = "a problem has a space, its metric, initial values and an output";
        let keys: Keys = file::keys(source, content)?;
        let reader = Reader { source, names: Vec::new() };
        keys.problem(reader, folder)
    }
}

impl<'t> Keys<'t> {
    fn problem(self, mut reader: Reader, folder: &Folder) -> Result<Problem, InputError> {
        let source = reader.source;
        self.expect_no_idle_keys(source)?;
        let mut values = Vec::new();
        for (name, number) in self.parameters.iter().flat_map(|table| &table.0) {
            let value = reader.value(number);
            values.push(Some(value.map_err(|error| error.or_near(&source.key(&name.0)))?));
            reader.declare(name)?;
        }
        let ensemble = match &self.ensemble {
            Some(keys) => Some(keys.ensemble(&mut reader)?),
            None => None,
        };
        let values = values.into_iter().chain(std::iter::repeat(None));
        let parameters = reader.names.iter().cloned().zip(values);
        let parameters = parameters.map(|(name, value)| Parameter { name, value }).collect();
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
        let control = self.integrator.control(&reader)?;
        let step = reader.optional(&self.integrator.step)?;
        let times = self.output.times(reader.optional(&self.initial.time)?, &reader)?;
        let columns = match &self.output.columns {
            Some(columns) => columns.iter().map(|column| reader.written(column)).collect(),
            // a velocity that is given has no inertia
            None if self.given.is_some() => {
                COLUMNS[..3].iter().map(|name| reader.written(&Text((*name).into()))).collect()
            }
            None => COLUMNS.map(|name| reader.written(&Text(name.into()))).to_vec(),
        };
        let quantities = reader.formulas(&self.quantities)?;
        let events = reader.formulas(&self.events)?;
        let event = |name: &Option<Text>| {
            let Some(Text(name)) = name else { return Ok(None) };
            if events.iter().any(|(event, _)| event == name) {
                return Ok(Some(name.to_string()));
            }
            let error = InputError::usage(format!("`{}` is no event", shown(name)));
            let help = "events are named in a table [events], by formulas that change their sign";
            Err(error.at(&source.whole(name)).help(help))
        };
        let (stop, section) = (event(&self.output.stop)?, event(&self.output.section)?);
        let name = self.name.clone().unwrap_or_else(|| stem(&source.name));
        let kind = match &self.flow {
            Some(flow) => {
                Kind::Matrices(Matrices { flow: flow.flow(&reader)?, place: source.key("flow") })
            }
            None => {
                let none = ForceKeys::default();
                let keys = self.forces.as_ref().unwrap_or(&none);
                let forces = keys.forces(&reader);
                let potential = keys.potential.as_ref().map(|text| reader.written(text));
                let table = keys.table(source, folder)?;
                let inertia = self.inertia.as_ref();
                let inertia = inertia.map(|keys| keys.read(&reader, folder)).transpose()?;
                let hamiltonian = self.hamiltonian.as_ref().map(|text| reader.written(text));
                let constraints = self.constraints.iter().flatten();
                let constraints = constraints.map(|text| reader.written(text)).collect();
                let element = self.initial.element(&reader)?;
                let course = self.course(&reader)?;
                let is_given = matches!(course, Course::Given(..));
                let places = Places {
                    metric: match &self.metric {
                        Some(MetricText::Word(text)) => source.whole(&text.0),
                        _ => source.key("metric"),
                    },
                    connection: self.connection.as_ref().map(|text| source.whole(&text.0)),
                };
                let space = self.space(source, folder).map_err(|error| places.moved(error))?;
                let casimirs = if is_given { vec![] } else { casimirs(&space) };
                Kind::Group(Box::new(OnGroup {
                    space,
                    places,
                    inertia,
                    right,
                    element,
                    course,
                    forces,
                    potential,
                    table,
                    hamiltonian,
                    constraints,
                    casimirs,
                    shared: OnceLock::new(),
                }))
            }
        };
        Ok(Problem {
            name,
            source: source.clone(),
            files: folder.named(),
            parameters,
            settings: vec![],
            kind,
            method,
            step,
            control,
            times,
            columns,
            quantities,
            events,
            stop,
            section,
            ensemble,
        })
    }

    /// Checks that every key has something to say here.
    fn expect_no_idle_keys(&self, source: &Source) -> Result<(), InputError> {
        let initial = &self.initial;
        let of_equations = [
            ("metric", self.metric.is_some()),
            ("inertia", self.inertia.is_some()),
            ("connection", self.connection.is_some()),
            ("forces", self.forces.is_some()),
            ("constraints", self.constraints.is_some()),
            ("hamiltonian", self.hamiltonian.is_some()),
            ("velocity", initial.velocity.is_some() && self.given.is_none()),
            ("space_velocity", initial.space_velocity.is_some() && self.given.is_none()),
            ("initial", initial.velocity.is_some() || initial.space_velocity.is_some()),
            ("momentum", initial.momentum.is_some()),
            ("space_momentum", initial.space_momentum.is_some()),
        ];
        let of_groups = [
            ("space", self.space.is_some()),
            ("definition", self.definition.is_some()),
            ("invariance", self.invariance.is_some()),
            ("given", self.given.is_some()),
            ("element", initial.element.is_some()),
            ("coordinates", initial.coordinates.is_some()),
            ("quaternion", initial.quaternion.is_some()),
            ("columns", self.output.columns.is_some()),
            ("quantities", self.quantities.is_some()),
            ("events", self.events.is_some()),
        ];
        let forces = self.forces.as_ref();
        let is_empty = |list: Option<&Vec<Number>>| list.is_some_and(Vec::is_empty);
        let empty = [
            ("body", is_empty(forces.and_then(|forces| forces.body.as_ref()))),
            ("space", is_empty(forces.and_then(|forces| forces.space.as_ref()))),
            ("constraints", self.constraints.as_ref().is_some_and(Vec::is_empty)),
            ("ensemble", self.ensemble.as_ref().is_some_and(EnsembleKeys::is_empty)),
        ];
        if let Some((key, _)) = empty.iter().find(|(_, empty)| *empty) {
            let error = InputError::usage(format!("nothing stands in `{key}`"));
            return Err(error.at(&source.key(key)).help("leave the key out"));
        }
        let idle = |keys: &[(&'static str, bool)], what: &str| {
            let Some((key, _)) = keys.iter().find(|(_, given)| *given) else { return Ok(()) };
            let message = format!("{what} has no `{key}`");
            Err(InputError::usage(message).at(&source.key(key)).help("leave the key out"))
        };
        if self.flow.is_some() {
            return idle(&[&of_groups[..], &of_equations].concat(), "a flow of matrices");
        }
        if self.given.is_some() {
            return idle(&of_equations, "a velocity given over time");
        }
        if self.metric.is_some() && self.inertia.is_some() {
            let error = InputError::usage("the metric is given twice");
            return Err(error.at(&source.key("inertia")).help("give one of metric, inertia"));
        }
        Ok(())
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

    fn space(self, source: &Source, folder: &Folder) -> Result<Space, InputError> {
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
                let space = if is_file { folder.join(&name) } else { name.to_string() };
                let space = Space::open(&Request { space: Some(space), ..request });
                let place = source.whole(&name);
                space.map_err(|error| error.moved("SPACE", &place).or_at(&place))
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
            (Some((true, side, v)), None) => {
                let v = reader.values(v).map_err(|error| error.or_near(&source.key("velocity")))?;
                Ok(Course::Velocity(side, v))
            }
            (Some((false, side, h)), None) => {
                let h = reader.values(h).map_err(|error| error.or_near(&source.key("momentum")))?;
                Ok(Course::Momentum(side, h))
            }
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

    fn table(&self, source: &Source, folder: &Folder) -> Result<Option<(Side, Table)>, InputError> {
        let side = match self.table_in.as_ref().map(|Text(text)| &**text) {
            None | Some("body") => Side::Body,
            Some("space") => Side::Space,
            Some(other) => {
                let message = format!("`{}` is neither body nor space", shown(other));
                return Err(InputError::usage(message).at(&source.key("table_in")));
            }
        };
        let Some(Text(name)) = &self.table else {
            return match self.table_in {
                Some(_) => {
                    let error = InputError::usage("there is no table");
                    Err(error.at(&source.key("table_in")).help("give table = \"FILE.csv\""))
                }
                None => Ok(None),
            };
        };
        let place = source.whole(name);
        let rows = file::read_rows(&folder.join(name));
        let (_, rows) = rows.map_err(|error| error.or_at(&place))?;
        let table = Table::new(rows);
        let table = table.map_err(|error| InputError::usage(error.to_string()).at(&place))?;
        Ok(Some((side, table)))
    }
}
