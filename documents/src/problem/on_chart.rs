//! Problems on a chart: autoparallels, geodesics, and particles in a potential or an
//! electromagnetic field.
//!
//! `exact` builds the exact equations and the names of columns, and `velocity` normalizes the
//! initial velocity.

mod exact;
pub(super) mod velocity;

use super::initial::NamedBasis;
use super::integrator::Member;
use super::keys::{Keys, NOT_ON_CHARTS};
use super::output::RowNames;
use super::reader::{Reader, Value, Written};
use super::ready::Ready;
use crate::input::{InputError, Place};
use crate::space::{Definition, Space};
use affinor::Error;
use affinor::mechanics::formula::{Formula, Symbol};
use affinor::mechanics::simulation::{ChartColumns, ChartSpec, CurveLength};
use affinor::mechanics::systems::chart::{ChartEquations, ChartProgram};
use affinor_tensors::expression::ExpressionError;
use exact::{Exact, Laws};
use std::sync::{Arc, OnceLock};
use velocity::Normalization;

/// A curve on a chart.
#[derive(Clone, Debug)]
pub(super) struct OnChart {
    space: Space,
    laws: Laws,
    /// The initial coordinates.
    position: Vec<Value>,
    position_place: Place,
    /// The components of the initial velocity that are given.
    velocity: Vec<Option<Value>>,
    normalization: Option<Normalization>,
    /// The map that draws the curve.
    embedding: Vec<Written>,
    /// The names of the parameters of the problem.
    parameters: Vec<String>,
    /// The exact equations. All members of an ensemble share them.
    shared: OnceLock<Arc<Exact>>,
}

impl OnChart {
    pub fn read(keys: &Keys, space: Space, reader: &Reader) -> Result<Self, InputError> {
        if cfg!(not(feature = "curves")) {
            return Err(absent());
        }
        let source = reader.source;
        reader.refuse("a curve on a chart", &NOT_ON_CHARTS)?;
        let coordinates = space.definition.coordinates().to_vec();
        let position_place = source.key("initial.position");
        let basis = NamedBasis { names: &coordinates, of: "chart", what: "coordinate" };
        let position =
            basis.components("initial.position", keys.initial.position.as_ref(), reader)?;
        let missing = position.iter().zip(&coordinates).find(|(value, _)| value.is_none());
        if let Some((_, name)) = missing {
            let message = format!("the initial coordinate `{name}` is missing");
            let error = InputError::usage(message).at(&position_place);
            return Err(error.help(format!(
                "give all of {}, as in position = {{ {name} = 1 }}",
                coordinates.join(", ")
            )));
        }
        let velocity =
            basis.components("initial.velocity", keys.initial.velocity.as_ref(), reader)?;
        let normalization = Normalization::read(&keys.initial, &coordinates, &velocity, reader)?;
        if normalization.is_none() && keys.initial.velocity.is_none() {
            let error = source.refused("initial", "the initial velocity is missing");
            let first = coordinates.first().map_or("x", String::as_str);
            return Err(error.help(format!("give velocity = {{ {first} = 1 }}")));
        }
        let embedding: Vec<_> =
            keys.embedding.iter().flatten().map(|text| reader.written(text)).collect();
        if keys.embedding.is_some() && !(2..=3).contains(&embedding.len()) {
            let message = format!("the embedding has {} functions", embedding.len());
            return Err(source.refused("embedding", message).help("give two or three functions"));
        }
        Ok(OnChart {
            laws: Laws::read(keys, &space.definition, reader)?,
            space,
            position: position.into_iter().flatten().collect(),
            position_place,
            velocity,
            normalization,
            embedding,
            parameters: reader.names.clone(),
            shared: OnceLock::new(),
        })
    }

    /// The exact equations, computed once.
    fn exact(&self) -> Result<Arc<Exact>, InputError> {
        if let Some(exact) = self.shared.get() {
            return Ok(exact.clone());
        }
        let exact = Arc::new(Exact::new(&self.space.definition, &self.laws, &self.parameters)?);
        // ignores an error, because another thread may have stored the same value in the meantime
        let _ = self.shared.set(exact.clone());
        Ok(exact)
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        if cfg!(not(feature = "curves")) {
            return Err(absent());
        }
        let exact = self.exact()?;
        let values = member.values();
        let position = Value::all(&self.position, &values)?;
        let velocity = self
            .velocity
            .iter()
            .map(|value| value.as_ref().map(|value| value.at(&values)).transpose());
        let mut velocity = velocity.collect::<Result<Vec<Option<f64>>, InputError>>()?;
        let metric = exact.program.metric(&position, &values);
        let mut notes = vec![];
        if let Some(normalization) = &self.normalization {
            let coordinates = exact.program.coordinates();
            notes.push(normalization.apply(metric.as_ref(), coordinates, &mut velocity)?);
        }
        let velocity: Vec<f64> = velocity.into_iter().map(Option::unwrap_or_default).collect();
        let length = match &metric {
            None => CurveLength::None,
            Some(g) if exact.constant_speed => {
                CurveLength::Speed(velocity::square(g, &velocity).abs().sqrt())
            }
            Some(_) => CurveLength::Integral,
        };
        let mut names = ChartNames {
            exact: &exact,
            parameters: &member.parameters,
            embedded: vec![],
            is_timelike: self.normalization.as_ref().is_some_and(Normalization::is_timelike),
            formulas: vec![],
        };
        for written in &self.embedding {
            let formula = names.formula(written.text());
            let all = names.all();
            let formula = formula
                .map_err(|error| written.refused(error, format!("the names here are {all}")))?;
            names.embedded.push(formula);
        }
        let (columns, events) = member.output.read_columns(&mut names, &[], member.source)?;
        let columns_of_curve = ChartColumns { derived: names.embedded, formulas: names.formulas };
        let spec = ChartSpec {
            program: exact.program.clone(),
            parameters: values,
            start: member.times[0],
            position,
            velocity,
            length,
            integration: member.integration()?,
            columns: columns_of_curve,
        };
        let started = spec.start();
        let started = started.map_err(|error| {
            let place = matches!(error, Error::CurveEnds { .. }).then_some(&self.position_place);
            InputError::from(error).or_at(place)
        })?;
        let ready = Ready::new(started, &member.times, columns, events);
        Ok(Ready { notes, parameter: exact.parameter().into(), ..ready })
    }
}

/// The program of equations without parameters.
pub(super) fn program(
    definition: &Definition,
    equations: &ChartEquations,
) -> Result<ChartProgram, InputError> {
    Exact::program(definition, equations, &[], &[])
}

/// The names of the quantities of a curve, and the formulas so far.
struct ChartNames<'n> {
    exact: &'n Exact,
    /// The parameters of the problem and their values.
    parameters: &'n [(String, f64)],
    /// The functions that map the curve into a picture.
    embedded: Vec<Formula>,
    is_timelike: bool,
    formulas: Vec<Formula>,
}

impl ChartNames<'_> {
    /// The names of the functions of the embedding.
    fn embedding(&self) -> Vec<String> {
        (1..=self.embedded.len()).map(|k| format!("X{k}")).collect()
    }

    /// The index of the quantity with a name.
    fn find(&self, name: &str) -> Option<usize> {
        let own = self.exact.find(name);
        let embedded = || self.embedding().iter().position(|own| own == name);
        own.or_else(|| Some(self.exact.names().len() + embedded()?))
    }

    fn formula(&self, text: &str) -> Result<Formula, ExpressionError> {
        Formula::read(text, &mut |name| {
            if let Some(k) = self.find(name) {
                return Some(Symbol::Variable(k));
            }
            let parameter = self.parameters.iter().find(|(own, _)| own == name);
            parameter.map(|(_, value)| Symbol::Number(*value))
        })
    }
}

impl RowNames for ChartNames<'_> {
    fn defaults(&self) -> Vec<&'static str> {
        let mut names = vec!["parameter", "position", "velocity"];
        if self.exact.has_metric {
            names.extend(["norm", if self.is_timelike { "proper_time" } else { "length" }]);
            names.extend(self.exact.has_potential.then_some("energy"));
            if !self.exact.expand("conserved").is_empty() {
                names.push("conserved");
            }
        }
        names
    }

    fn expand(&self, stem: &str) -> Vec<String> {
        match stem {
            _ if self.find(stem).is_some() => vec![stem.into()],
            "embedding" => self.embedding(),
            _ => self.exact.expand(stem),
        }
    }

    fn all(&self) -> String {
        let parameters = self.parameters.iter().map(|(name, _)| name.clone());
        let names = self.exact.names().iter().cloned().chain(self.embedding()).chain(parameters);
        names.collect::<Vec<_>>().join(", ")
    }

    fn watched(&self, _: &str, name: &str) -> (bool, bool) {
        let conserved = self.exact.conserves(name);
        (conserved, conserved)
    }

    fn momentum(&self) -> &'static str {
        "p"
    }

    fn add(&mut self, text: &str) -> Result<(), ExpressionError> {
        let formula = self.formula(text)?;
        self.formulas.push(formula);
        Ok(())
    }
}

/// The error of a build without the feature `curves`, such as the page.
fn absent() -> InputError {
    InputError::usage("curves on charts are computed by the program only")
}
