//! Equations of motion of a kinetic energy and of forces, with or without constraints.

use super::body::Body;
use super::initial::InitialMomentum;
use super::keys::{ForceKeys, Keys};
use super::on_group::{OnGroup, Start};
use super::output::RowFormulas;
use super::reader::{Reader, Written};
use super::ready::Ready;
use crate::definition::file;
use crate::definition::input::{InputError, shown};
use crate::definition::source::Place;
use affinor::group::{AnyGroup, LieGroup, So3};
use affinor::mechanics::motions::chosen::on_group;
use affinor::mechanics::motions::{
    ForceFunction, Forces, Setup, Side, SimulationGroup, Table, is_plus, share_of_plus,
};
use affinor::tensors::Tolerance;
use affinor::{Canonical, Connection, Error, Metric};
use affinor_tensors::Symbolic;
use nalgebra::{DMatrix, DVector};
use std::borrow::Cow;
use std::sync::OnceLock;

/// The metric of a kinetic energy, a connection, forces, and an initial velocity or momentum: equations of motion
/// `DH/Dt = M`.
#[derive(Clone, Debug)]
pub(super) struct Dynamics {
    /// The body that moves, instead of a metric.
    body: Option<Body>,
    initial: InitialMomentum,
    forces: ForceFormulas,
    casimirs: Vec<Symbolic>,
    /// The kinetic energy of all members of an ensemble, if it depends on no parameter.
    shared: OnceLock<KineticEnergy>,
}

/// The metric of a kinetic energy, and the connection of the equations of motion.
#[derive(Clone, Debug)]
pub(super) struct KineticEnergy {
    pub metric: Metric<f64>,
    pub connection: Connection<f64>,
    /// The names that a body adds, with their values.
    of_body: Vec<(String, f64)>,
}

/// The equations of one motion, and its initial condition.
pub(super) struct System<'d> {
    pub energy: Cow<'d, KineticEnergy>,
    /// The matrix of the metric.
    pub inertia: DMatrix<f64>,
    pub forces: Forces<AnyGroup>,
    pub rows: RowFormulas,
    pub element: DVector<f64>,
    pub momentum: DVector<f64>,
    pub notes: Vec<String>,
}

impl Dynamics {
    pub fn read(keys: &Keys, on_group: &OnGroup, reader: &Reader) -> Result<Self, InputError> {
        if keys.metric.is_some() && keys.inertia.is_some() {
            let error = reader.source.refused("inertia", "the metric is given twice");
            return Err(error.help("give one of metric, inertia"));
        }
        let forces = ForceFormulas::read(&keys.forces, reader)?;
        let body = keys.inertia.as_ref().map(|keys| Body::read(keys, reader)).transpose()?;
        let initial = InitialMomentum::read(&keys.initial, reader)?;
        Ok(Dynamics {
            body,
            initial,
            forces,
            casimirs: on_group.casimirs(),
            shared: OnceLock::new(),
        })
    }

    /// Adds a force as a function.
    pub fn add_force(&mut self, side: Side, function: ForceFunction) {
        self.forces.functions.push((side, function));
    }

    /// The same without Casimir functions, which constraint forces change.
    pub fn without_casimirs(self) -> Self {
        Dynamics { casimirs: Default::default(), ..self }
    }

    /// The motion without constraints.
    pub fn motion(&self, start: &Start) -> Result<Ready, InputError> {
        let member = start.member;
        let System { energy, inertia, forces, rows, element, momentum, notes } =
            self.system(start)?;
        let setup = Setup {
            connection: &energy.connection,
            metric: &energy.metric,
            forces,
            time: member.times[0],
            element,
            momentum,
            method: member.method(),
            step: member.step()?,
            control: member.control()?,
            columns: rows.formulas,
        };
        let motion = on_group(start.group, setup)?;
        let ready = Ready::new(motion, &member.times, rows.columns, rows.events);
        Ok(Ready { inertia: Some(inertia), notes, ..ready })
    }

    fn energy(&self, start: &Start) -> Result<KineticEnergy, InputError> {
        let group = start.group;
        let tolerance = Tolerance::default();
        let ground = start.definition.ground(tolerance)?;
        let (metric, of_body) = match &self.body {
            Some(body) => {
                let labels = group.algebra()?.labels().to_vec();
                let (metric, names) = body.metric(group, &labels, &start.member.values())?;
                (Some(metric), names)
            }
            None => (start.definition.metric(&ground, tolerance)?, vec![]),
        };
        let metric = metric.ok_or_else(|| {
            let error = InputError::mathematics("a motion needs the metric of its kinetic energy");
            error.help("give metric = \"diag(..)\", or rows; on so(3) and se(3) also [inertia]")
        })?;
        let connection = if start.definition.connection_is_default() {
            Connection::canonical(&group.algebra()?, Canonical::Plus)
        } else if group.is_right() {
            let message = "right-invariant equations have the connection plus of their own frame";
            return Err(InputError::usage(message).help("name no connection"));
        } else {
            start.definition.geometry_over(ground, tolerance)?.connection().clone()
        };
        Ok(KineticEnergy { metric, connection, of_body })
    }

    /// The equations and the initial condition of one motion.
    pub fn system(&self, start: &Start) -> Result<System<'_>, InputError> {
        let (group, member, values) = (start.group, start.member, start.member.values());
        let energy = match self.shared.get() {
            Some(energy) => Cow::Borrowed(energy),
            None => Cow::Owned(self.energy(start)?),
        };
        let is_new = self.shared.get().is_none() && self.body.is_none();
        if is_new && start.on_group.definition().parameters().is_empty() {
            // another thread may have set the same value in the meantime
            let _ = self.shared.set(energy.clone().into_owned());
        }
        let inertia = energy.metric.components().to_dmatrix().map_err(affinor::Error::from)?;
        let mut notes = notes(group, &inertia);
        if !is_plus(&energy.connection) {
            let rate = share_of_plus(&energy.connection).map_or(String::new(), |share| {
                format!(": without forces, H' is {share} times that of theirs")
            });
            let not =
                "the connection is not plus, so the equations are not those of Euler and Poincare";
            notes.push(format!("{not}{rate}"));
        }
        start.expect_new_names(&energy.of_body)?;
        let parameters = [&member.parameters[..], &energy.of_body].concat();
        let mut forces = Forces::none(group.clone(), inertia.clone(), parameters);
        self.forces.apply(&mut forces, start.definition.dimension())?;
        // forces change the coadjoint orbit
        let casimirs = if forces.is_empty() { &self.casimirs[..] } else { &[] };
        let rows = member.output.formulas(forces.names(), &|_| true, casimirs, member.source)?;
        let element = start.on_group.element().at(group, &values)?;
        let momentum = self.initial.at(group, &element, forces.observables(), &values)?;
        Ok(System { energy, inertia, forces, rows, element, momentum, notes })
    }
}

/// The table `[forces]`.
#[derive(Clone, Debug)]
struct ForceFormulas {
    /// The components in the body frame and in space.
    components: [(Side, Vec<Written>); 2],
    potential: Option<Written>,
    table: Option<(Side, Table)>,
    functions: Vec<(Side, ForceFunction)>,
    place: Place,
}

impl ForceFormulas {
    fn read(keys: &ForceKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let components = [("body", Side::Body, &keys.body), ("space", Side::Space, &keys.space)];
        for (key, _, list) in components {
            let is_empty = list.as_ref().is_some_and(Vec::is_empty);
            reader.refuse_empty(&format!("forces.{key}"), is_empty)?;
        }
        let components = components.map(|(_, side, list)| {
            (side, list.iter().flatten().map(|number| reader.written(&number.0)).collect())
        });
        let side = match keys.table_in.as_deref() {
            None | Some("body") => Side::Body,
            Some("space") => Side::Space,
            Some(other) => {
                let message = format!("`{}` is neither body nor space", shown(other));
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
                let columns = file::read_rows(&reader.file(name));
                let (names, rows) = columns.map_err(|error| error.or_at(&place))?;
                let rows = force_rows(&names, rows).map_err(|error| error.at(&place))?;
                let refused = |error: Error| InputError::usage(error.to_string()).at(&place);
                let table = Table::new(rows).map_err(refused)?;
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

    /// Adds the forces to those of a motion on a group of this dimension.
    fn apply(&self, forces: &mut Forces<AnyGroup>, dimension: usize) -> Result<(), InputError> {
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
                let allowed = &Forces::<AnyGroup>::may_depend_on;
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

/// Warnings about a metric that no rigid body has.
fn notes(group: &AnyGroup, inertia: &DMatrix<f64>) -> Vec<String> {
    let eigenvalues = inertia.symmetric_eigenvalues();
    if eigenvalues.max() < 0.0 {
        return vec!["the metric is negative: so is the kinetic energy".into()];
    }
    if eigenvalues.min() <= 0.0 {
        return vec!["the metric is indefinite: no energy bounds the velocity".into()];
    }
    let Some(Ok(body)) = group.downcast_ref::<So3>().and_then(|so3| so3.body(inertia)) else {
        return vec![];
    };
    body.expect_masses().err().iter().map(Error::to_string).collect()
}
