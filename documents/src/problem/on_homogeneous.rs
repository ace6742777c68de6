//! Problems on a homogeneous space G/H: geodesics, autoparallels, and parallel transport along them.

use super::initial::NamedBasis;
use super::integrator::Member;
use super::keys::{Keys, NOT_ON_HOMOGENEOUS};
use super::on_chart::velocity::Normalization;
use super::on_group::OnGroup;
use super::output::RowNames;
use super::reader::{Reader, Value};
use super::ready::Ready;
use crate::input::{InputError, Place};
use crate::space::notation::check_name;
use affinor::group::LieGroup;
use affinor::mechanics::formula::{Formula, Symbol};
use affinor::mechanics::simulation::quantities::{MotionQuantity, SymbolTable};
use affinor::mechanics::simulation::{HomogeneousColumns, HomogeneousSpec};
use affinor::mechanics::systems::HomogeneousSystem;
use affinor_tensors::Tolerance;
use affinor_tensors::expression::ExpressionError;
use nalgebra::DVector;

/// A curve on a homogeneous space.
#[derive(Clone, Debug)]
pub(super) struct OnHomogeneous {
    space: OnGroup,
    /// The names of the basis vectors of the complement.
    labels: Vec<String>,
    /// The components of the initial velocity that are given.
    velocity: Vec<Option<Value>>,
    normalization: Option<Normalization>,
    /// The vectors that are transported, with their names.
    transport: Vec<(String, Vec<Option<Value>>)>,
    transport_place: Place,
}

impl OnHomogeneous {
    pub fn read(keys: &Keys, space: OnGroup, reader: &Reader) -> Result<Self, InputError> {
        if cfg!(not(feature = "curves")) {
            return Err(absent());
        }
        let source = reader.source;
        reader.refuse("a curve on a homogeneous space", &NOT_ON_HOMOGENEOUS)?;
        let labels = space.definition().labels.clone();
        let basis = NamedBasis { names: &labels, of: "space", what: "basis vector" };
        let Some(velocity) = &keys.initial.velocity else {
            let error = source.refused("initial", "the initial velocity is missing");
            let first = labels.first().map_or("m1", String::as_str);
            return Err(error.help(format!("give velocity = {{ {first} = 1 }}")));
        };
        let velocity = basis.components("initial.velocity", Some(velocity), reader)?;
        let normalization = Normalization::read(&keys.initial, &labels, &velocity, reader)?;
        let mut transport = vec![];
        for (name, vector) in keys.transport.iter().flat_map(|table| &table.0) {
            check_name(name).map_err(|error| error.at(&source.at(name)))?;
            let path = format!("transport.{}", name.content);
            let components = basis.components(&path, Some(vector), reader)?;
            transport.push((name.content.clone(), components));
        }
        let transport_place = source.key("transport");
        Ok(OnHomogeneous { space, labels, velocity, normalization, transport, transport_place })
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        if cfg!(not(feature = "curves")) {
            return Err(absent());
        }
        let space = self.space.valued(member)?;
        let (definition, values) = (space.in_floats()?, member.values());
        let tolerance = Tolerance::default();
        let Some((group, basis)) = definition.transitive_group(tolerance)? else {
            return Err(absent());
        };
        let geometry = definition.geometry::<f64>(tolerance)?;
        let (connection, metric) = (geometry.connection(), geometry.metric());
        let count = self.transport.len();
        let system = HomogeneousSystem::new(&group, &basis, connection, metric, count)?;
        let element = self.space.element();
        let mut notes: Vec<String> = definition.default_connection_note().into_iter().collect();
        notes.extend(element.note(&group, &values));
        let element = element.at(&group, &values)?;
        let numbers = |vector: &[Option<Value>]| {
            let value =
                |value: &Option<Value>| value.as_ref().map(|value| value.at(&values)).transpose();
            vector.iter().map(value).collect::<Result<Vec<Option<f64>>, InputError>>()
        };
        let mut velocity = numbers(&self.velocity)?;
        if let Some(normalization) = &self.normalization {
            let components = metric.map(|metric| metric.components().to_dmatrix()).transpose()?;
            notes.push(normalization.apply(components.as_ref(), &self.labels, &mut velocity)?);
        }
        let full = |vector: Vec<Option<f64>>| {
            DVector::from_iterator(vector.len(), vector.into_iter().map(Option::unwrap_or_default))
        };
        let vectors = self.transport.iter().map(|(_, vector)| Ok(full(numbers(vector)?)));
        let vectors = vectors.collect::<Result<Vec<_>, InputError>>()?;
        let mut names = CurveNames::new(self, &system, metric.is_some(), &member.parameters);
        names.expect_distinct().map_err(|error| error.at(&self.transport_place))?;
        let (columns, events) = member.output.read_columns(&mut names, &[], member.source)?;
        let columns_of_curve =
            HomogeneousColumns { element: names.coordinates, formulas: names.formulas };
        let spec = HomogeneousSpec {
            time: member.times[0],
            element,
            velocity: full(velocity),
            vectors,
            integration: member.integration()?,
            columns: columns_of_curve,
            system,
        };
        let ready = Ready::new(spec.start()?, &member.times, columns, events);
        Ok(Ready { notes, ..ready })
    }
}

/// The names of the quantities of a curve, and the formulas so far.
struct CurveNames<'n> {
    /// The names, in the order of the quantities of [`HomogeneousColumns`], without the coordinates
    /// of the element.
    names: Vec<String>,
    labels: &'n [String],
    vectors: Vec<&'n str>,
    /// The dimension of G.
    momenta: usize,
    has_metric: bool,
    is_geodesic: bool,
    conserves_energy: bool,
    is_metric: bool,
    /// The names of the coordinates of the element.
    element: SymbolTable,
    /// The parameters of the problem and their values.
    parameters: &'n [(String, f64)],
    /// The coordinates of the element that formulas use.
    coordinates: Vec<MotionQuantity>,
    formulas: Vec<Formula>,
}

impl<'n> CurveNames<'n> {
    fn new(
        curve: &'n OnHomogeneous,
        system: &HomogeneousSystem,
        has_metric: bool,
        parameters: &'n [(String, f64)],
    ) -> Self {
        let (labels, momenta) = (&curve.labels, system.base().dimension());
        let vectors: Vec<&str> = curve.transport.iter().map(|(name, _)| &**name).collect();
        let components = |name: &str| components(name, labels);
        let mut names = vec!["t".to_string()];
        names.extend(components("v"));
        names.extend(["norm", "energy"].map(String::from));
        names.extend((1..=momenta).map(|i| format!("h{i}")));
        names.extend(vectors.iter().flat_map(|name| components(name)));
        names.extend(vectors.iter().map(|name| format!("norm_{name}")));
        CurveNames {
            names,
            labels,
            vectors,
            momenta,
            has_metric,
            is_geodesic: system.is_geodesic(),
            conserves_energy: system.conserves_energy(),
            is_metric: system.is_metric(),
            element: SymbolTable::new(system.base(), vec![]),
            parameters,
            coordinates: vec![],
            formulas: vec![],
        }
    }

    /// Returns an error if two quantities have the same name.
    fn expect_distinct(&self) -> Result<(), InputError> {
        let others = |at: usize| {
            let parameters = self.parameters.iter().map(|(name, _)| name);
            self.names[..at].iter().chain(parameters)
        };
        let twice = self.names.iter().enumerate();
        let twice = twice.map(|(at, name)| (name, others(at).any(|other| other == name)));
        let Some((name, _)) = twice.into_iter().find(|(_, is_taken)| *is_taken) else {
            return Ok(());
        };
        let message = format!("the name `{name}` of a column is already in use");
        Err(InputError::usage(message).help("rename the vector or the parameter"))
    }

    /// The coordinate of the element with a name.
    fn coordinate(&self, name: &str) -> Option<MotionQuantity> {
        let found = self.element.find(name);
        found.filter(|own| matches!(own, MotionQuantity::Entry(..) | MotionQuantity::Named(_)))
    }

    /// The index of the first norm of a transported vector. The norms are the last names.
    fn norms(&self) -> usize {
        self.names.len() - self.vectors.len()
    }

    /// The index of the quantity with a name, other than a coordinate of the element.
    fn find(&self, name: &str) -> Option<usize> {
        let (n, at) = (self.labels.len(), self.names.iter().position(|own| own == name)?);
        let needs_metric = (n + 1..n + 3 + self.momenta).contains(&at) || at >= self.norms();
        (self.has_metric || !needs_metric).then_some(at)
    }
}

/// The names of the components of a vector.
fn components(name: &str, labels: &[String]) -> Vec<String> {
    labels.iter().map(|label| format!("{name}_{label}")).collect()
}

impl RowNames for CurveNames<'_> {
    fn defaults(&self) -> Vec<&'static str> {
        let mut names = vec!["t", "velocity"];
        if self.has_metric {
            names.extend(["energy", "momentum"]);
        }
        names.extend((!self.vectors.is_empty()).then_some("transport"));
        names
    }

    fn expand(&self, stem: &str) -> Vec<String> {
        match stem {
            _ if self.find(stem).is_some() => vec![stem.into()],
            "velocity" | "v" => components("v", self.labels),
            "momentum" | "h" if self.has_metric => {
                (1..=self.momenta).map(|i| format!("h{i}")).collect()
            }
            "transport" => {
                self.vectors.iter().flat_map(|name| components(name, self.labels)).collect()
            }
            _ if self.vectors.contains(&stem) => components(stem, self.labels),
            _ => {
                let names = self.element.expand(stem);
                names.into_iter().filter(|name| self.coordinate(name).is_some()).collect()
            }
        }
    }

    fn all(&self) -> String {
        let own = self.names.iter().filter(|name| self.find(name).is_some()).cloned();
        let parameters = self.parameters.iter().map(|(name, _)| name.clone());
        let entries = self.element.entries();
        own.chain([entries]).chain(parameters).collect::<Vec<_>>().join(", ")
    }

    fn watched(&self, stem: &str, name: &str) -> (bool, bool) {
        let is_momentum = ["momentum", "h"].contains(&stem);
        match name {
            "norm" | "energy" => (true, self.conserves_energy),
            _ if is_momentum => (true, self.is_geodesic),
            _ => match self.find(name) {
                Some(at) if at >= self.norms() => (true, self.is_metric),
                _ => (false, false),
            },
        }
    }

    fn momentum(&self) -> &'static str {
        "h"
    }

    fn add(&mut self, text: &str) -> Result<(), ExpressionError> {
        let (count, mut coordinates) = (self.names.len(), std::mem::take(&mut self.coordinates));
        let formula = Formula::read(text, &mut |name| {
            if let Some(k) = self.find(name) {
                return Some(Symbol::Variable(k));
            }
            if let Some(own) = self.coordinate(name) {
                let known = coordinates.iter().position(|other| *other == own);
                let at = known.unwrap_or_else(|| {
                    coordinates.push(own);
                    coordinates.len() - 1
                });
                return Some(Symbol::Variable(count + at));
            }
            let parameter = self.parameters.iter().find(|(own, _)| own == name);
            parameter.map(|(_, value)| Symbol::Number(*value))
        });
        self.coordinates = coordinates;
        self.formulas.push(formula?);
        Ok(())
    }
}

/// The error of a build without curves or homogeneous spaces, such as the page.
fn absent() -> InputError {
    InputError::usage("curves on homogeneous spaces are computed by the program only")
}
