//! A problem put on its group: from values of the parameters to a motion.

use super::held::{Held, velocity_of};
use super::{
    Column, Course, OnGroup, Problem, Ready, StartElement, Value, Written, expect_new, numbers_of,
};
use crate::definition::group::GroupWork;
use crate::definition::input::{Place, shown};
use crate::definition::{Definition, InputError, Reading, Space};
use crate::dense::to_dmatrix;
use crate::dynamics::integrators::Magnus;
use crate::formula::Formula;
use crate::group::{Coordinates, Opposite, rotation};
use crate::simulation::quantities::{Names, Quantity, Scope};
use crate::simulation::{
    Forces, GivenVelocity, Method, Setup, Side, Simulated, is_plus, on_given, on_group,
};
use crate::{Canonical, Connection, Error, LieAlgebra, LiePoisson, Metric};
use affinor_tensors::expression::ExpressionError;
use affinor_tensors::{Symbolic, Tolerance};
use nalgebra::DMatrix;
use std::borrow::Cow;

/// Formulas over their scope.
pub(super) type Formulas = (Scope, Vec<Formula>);

/// Algebras up to this dimension have their Casimirs computed, up to the second degree.
const CASIMIRS: usize = 6;

/// What is needed beside the group.
pub(super) struct Launch<'p> {
    pub problem: &'p Problem,
    pub on_group: &'p OnGroup,
    pub parameters: Vec<(String, f64)>,
    pub times: &'p [f64],
    pub definition: &'p Definition,
    pub reading: &'p Reading<'p, f64>,
}

impl Written {
    /// An error of the expression at its place.
    pub(super) fn refused(&self, error: ExpressionError, help: String) -> InputError {
        let mut place = self.place.clone();
        if place.text() == Some(&self.text)
            && let Some(span) = &mut place.span
        {
            *span = span.start + error.span.start..span.start + error.span.end;
        }
        InputError::usage(error.reason).at(&place).help(help)
    }
}

impl GroupWork for Launch<'_> {
    type Output = Ready;

    fn run<G: Simulated>(self, group: G) -> Result<Ready, InputError> {
        if self.on_group.right { self.ready(Opposite(group)) } else { self.ready(group) }
    }
}

/// The metric and the connection of equations of motion.
#[derive(Clone, Debug)]
pub(super) struct Ground {
    metric: Metric<f64>,
    connection: Connection<f64>,
    /// Names that a body by parts gives, with their values.
    of_body: Vec<(String, f64)>,
}

impl Launch<'_> {
    fn ground<G: Simulated>(&self, group: &G, values: &[f64]) -> Result<Ground, InputError> {
        let ground = self.definition.ground(self.reading)?;
        let (metric, of_body) = match &self.on_group.inertia {
            Some(body) => {
                let labels = group.algebra()?.labels().clone();
                let (metric, names) = body.metric::<G>(&labels, values)?;
                (Some(metric), names)
            }
            None => (self.definition.metric(&ground, self.reading)?, vec![]),
        };
        let metric = metric.ok_or_else(|| {
            let error = InputError::mathematics("a motion needs the metric of its kinetic energy");
            error.help("give metric = \"diag(..)\", or rows; on so(3) and se(3) also [inertia]")
        })?;
        let connection = if self.definition.connection_is_default() {
            Connection::canonical(&group.algebra()?, Canonical::Plus)
        } else if G::RIGHT {
            let message = "right-invariant equations have the connection plus of their own frame";
            return Err(InputError::usage(message).help("name no connection"));
        } else {
            self.definition.geometry_over(ground, self.reading)?.connection().clone()
        };
        Ok(Ground { metric, connection, of_body })
    }

    fn ready<G: Simulated>(&self, group: G) -> Result<Ready, InputError> {
        if let Course::Given(side, formulas) = &self.on_group.course {
            return self.given(group, *side, formulas);
        }
        if let Some(hamiltonian) = &self.on_group.hamiltonian {
            return self.hamiltonian(group, hamiltonian);
        }
        let values = numbers_of(&self.parameters);
        let shared = &self.on_group.shared;
        let ground = match shared.get() {
            Some(ground) => Cow::Borrowed(ground),
            None => Cow::Owned(self.ground(&group, &values)?),
        };
        let is_fixed = self.on_group.space.definition.parameters().is_empty();
        if is_fixed && self.on_group.inertia.is_none() && shared.get().is_none() {
            // another thread may have been first, with the same
            let _ = shared.set(ground.clone().into_owned());
        }
        let Ground { metric, connection, of_body } = &*ground;
        let inertia = to_dmatrix(metric.components())?;
        let (times, mut notes) = (self.times.to_vec(), notes(&group, &inertia));
        if self.on_group.places.connection.is_none() && !is_plus(connection) {
            let own = "the space brings a connection that is not plus, with equations of its own";
            notes.push(own.into());
        }
        self.expect_new_names(&group, of_body)?;
        let parameters = [&self.parameters[..], of_body].concat();
        let whole = Launch { parameters: parameters.clone(), ..*self };
        let mut forces = Forces::none(group.clone(), inertia.clone(), parameters);
        self.forces(&mut forces)?;
        let (columns, mut formulas) = self.columns(&forces, &|_| true)?;
        let events = self.events(&forces, &|_| true, &mut formulas)?;
        let element = self.element(&group, &values)?;
        let momentum = self.momentum(&group, &element, &forces, &values)?;
        let step = self.problem.step_at(&values)?;
        if !self.on_group.constraints.is_empty() {
            let velocity = velocity_of(metric, &momentum)?;
            let start = (self.times[0], element, velocity);
            let held = Held { metric, connection, forces, step };
            let (motion, columns) = whole.constrained(group, held, start, columns, formulas)?;
            let (method, inertia) = (Method::GeneralisedAlpha, Some(inertia));
            return Ok(Ready { motion, method, times, columns, events, inertia, notes });
        }
        let setup = Setup {
            connection,
            metric,
            forces,
            time: self.times[0],
            element,
            momentum,
            method: self.problem.method,
            step,
            control: self.problem.control_at(&values, self.times)?,
            columns: formulas,
        };
        let (motion, method) = on_group(group, setup)?;
        Ok(Ready { motion, method, times, columns, events, inertia: Some(inertia), notes })
    }

    /// A motion of a velocity over time.
    fn given<G: Simulated>(
        &self,
        group: G,
        side: Side,
        written: &[Written],
    ) -> Result<Ready, InputError> {
        let n = group.dimension();
        if (side == Side::Space) != G::RIGHT {
            let message =
                "a velocity over time is of the body, and in space with invariance = \"right\"";
            return Err(InputError::usage(message).or_at_some(written.first().map(|w| &w.place)));
        }
        if written.len() != n {
            let found = written.len();
            let message = format!("the velocity has {found} components, the dimension is {n}");
            return Err(InputError::usage(message).at(&self.problem.source.key("given")));
        }
        let method = self.problem.method.unwrap_or(Method::Magnus(Magnus::Six));
        let Method::Magnus(magnus) = method else {
            let message = format!("the method {method} is not for a velocity over time");
            return Err(InputError::mathematics(message).help("that has magnus4 and magnus6"));
        };
        let values = numbers_of(&self.parameters);
        let Some(step) = self.problem.step_at(&values)? else {
            return Err(InputError::mathematics("a velocity over time needs a step"));
        };
        self.expect_new_names(&group, &[])?;
        let names = Forces::none(group.clone(), DMatrix::identity(n, n), self.parameters.clone());
        let mut velocity = GivenVelocity::new(values.clone());
        for formula in written {
            let added = velocity.add(&formula.text, names.names());
            let help = "the velocity is a formula of t and the parameters";
            added.map_err(|error| formula.refused(error, help.into()))?;
        }
        // there is no inertia
        let kinematic = |quantity: Quantity| {
            use Quantity::{Energy, Kinetic, Momentum, OtherMomentum, Potential, Power};
            !matches!(
                quantity,
                Momentum(_) | OtherMomentum(_) | Kinetic | Potential | Energy | Power
            )
        };
        let (columns, mut formulas) = self.columns(&names, &kinematic)?;
        let events = self.events(&names, &kinematic, &mut formulas)?;
        let start = (self.times[0], self.element(&group, &values)?);
        let motion = on_given(group, velocity, start, (magnus, step), formulas, names);
        let (times, notes) = (self.times.to_vec(), vec![]);
        Ok(Ready { motion, method, times, columns, events, inertia: None, notes })
    }

    /// Checks that parameters hide nothing that formulas speak of.
    pub(super) fn expect_new_names<G: Simulated>(
        &self,
        group: &G,
        of_body: &[(String, f64)],
    ) -> Result<(), InputError> {
        let names = Names::new(group, of_body.iter().map(|(name, _)| name.clone()).collect());
        match self.parameters.iter().find(|(name, _)| names.find(name).is_some()) {
            None => Ok(()),
            Some((name, _)) => {
                let message = format!("`{name}` has a meaning already");
                let help = format!("take another name than {}", names.all());
                Err(InputError::usage(message).at(&self.problem.source.key(name)).help(help))
            }
        }
    }

    fn forces<G: Simulated>(&self, forces: &mut Forces<G>) -> Result<(), InputError> {
        let expected = self.definition.dimension();
        let refused = |what: &str, found: usize, place: &Place| {
            let message = format!("{what} has {found} components, the dimension is {expected}");
            let error = InputError::usage(message).at(place);
            Err(error.or_near(&self.problem.source.key("forces")))
        };
        for side in [Side::Body, Side::Space] {
            let mut components = self.on_group.forces.iter().filter(|force| force.side == side);
            if let Some(first) = components.next()
                && components.clone().count() + 1 != expected
            {
                let found = components.count() + 1;
                return refused("the force", found, &first.written.place);
            }
        }
        if let Some((_, table)) = &self.on_group.table
            && table.width() != expected
        {
            return refused("the table", table.width(), &self.problem.source.key("table"));
        }
        for force in &self.on_group.forces {
            let added = forces.add(force.side, force.index, &force.written.text);
            let help = |forces: &Forces<G>| format!("the names here are {}", forces.names().all());
            added.map_err(|error| force.written.refused(error, help(forces)))?;
        }
        if let Some(potential) = &self.on_group.potential {
            let entries = forces.names().entries();
            let set = forces.set_potential(&potential.text);
            let help =
                format!("a potential is a formula of t, the entries {entries} and parameters");
            set.map_err(|error| potential.refused(error, help))?;
        }
        if let Some((side, table)) = &self.on_group.table {
            forces.set_table(*side, table.clone());
        }
        Ok(())
    }

    /// The columns of the rows, of quantities that are `allowed`, and their formulas.
    pub(super) fn columns<G: Simulated>(
        &self,
        forces: &Forces<G>,
        allowed: &dyn Fn(Quantity) -> bool,
    ) -> Result<(Vec<Column>, Formulas), InputError> {
        let names = forces.names();
        let help = || format!("the names here are {}", names.all());
        let (mut scope, mut columns, mut formulas) = (Scope::default(), vec![], vec![]);
        for stem in &self.problem.columns {
            let expanded = names.expand(&stem.text);
            if expanded.is_empty() {
                let message = format!("`{}` is no quantity of this motion", shown(&stem.text));
                return Err(InputError::usage(message).at(&stem.place).help(help()));
            }
            let watched = ["h", "energy"].contains(&&*stem.text);
            for name in expanded {
                expect_new(&columns, &name, &stem.place)?;
                let formula = scope.read(&name, names, allowed);
                formulas.push(formula.map_err(|error| stem.refused(error, help()))?);
                columns.push(Column { name, formula: None, watched });
            }
        }
        for (name, written) in &self.problem.quantities {
            expect_new(&columns, name, &self.problem.source.key(name))?;
            let formula = scope.read(&written.text, names, allowed);
            formulas.push(formula.map_err(|error| written.refused(error, help()))?);
            let formula = Some(written.text.clone());
            columns.push(Column { name: name.clone(), formula, watched: true });
        }
        // forces lead off the coadjoint orbits
        let casimirs = self.on_group.casimirs.iter().filter(|_| forces.is_empty());
        for (i, casimir) in casimirs.enumerate() {
            let text = casimir.replace("mu", names.momentum());
            if let Ok(formula) = scope.read(&text, names, allowed) {
                formulas.push(formula);
                let name = format!("casimir{}", i + 1);
                columns.push(Column { name, formula: Some(text), watched: true });
            }
        }
        Ok((columns, (scope, formulas)))
    }

    /// The names of events, of quantities that are `allowed`; their formulas go behind the others.
    pub(super) fn events<G: Simulated>(
        &self,
        forces: &Forces<G>,
        allowed: &dyn Fn(Quantity) -> bool,
        (scope, formulas): &mut Formulas,
    ) -> Result<Vec<String>, InputError> {
        let names = forces.names();
        let help = || format!("the names here are {}", names.all());
        let mut events = Vec::new();
        for (name, written) in &self.problem.events {
            let formula = scope.read(&written.text, names, allowed);
            formulas.push(formula.map_err(|error| written.refused(error, help()))?);
            events.push(name.clone());
        }
        Ok(events)
    }

    pub(super) fn element<G: Simulated>(
        &self,
        group: &G,
        values: &[f64],
    ) -> Result<G::Element, InputError> {
        let identity = group.write(&group.identity());
        let (matrix, place) = match &self.on_group.element {
            StartElement::Identity => return Ok(group.identity()),
            StartElement::Coordinates(x) => {
                let x = self.numbers("coordinates", x, group.dimension(), values)?;
                return Ok(group.exp(&G::Vector::from_components(&x)));
            }
            StartElement::Rows(rows, place) => {
                let width = rows.first().map_or(0, Vec::len);
                if rows.iter().any(|row| row.len() != width) {
                    let error = InputError::usage("the rows of the element have different lengths");
                    return Err(error.at(place));
                }
                let mut entries = Vec::new();
                for row in rows {
                    entries.extend(Value::all(row, values)?);
                }
                (DMatrix::from_row_slice(rows.len(), width, &entries), place)
            }
            StartElement::Pose(quaternion, position, place) => {
                let (size, along) = (identity.shape(), position.len());
                let of_turns = G::NAMED.first() == Some(&"qw");
                if !(of_turns && matches!((size, along), ((3, 3), 0) | ((4, 4), 0 | 3))) {
                    let message = "a quaternion is for so(3), and with a position for se(3)";
                    return Err(InputError::usage(message).at(place));
                }
                let q = Value::all(quaternion, values)?;
                let Ok(q) = <[f64; 4]>::try_from(q) else {
                    let message = "a quaternion is four numbers w, x, y, z";
                    return Err(InputError::usage(message).at(place));
                };
                let turn = rotation::from_wxyz(q);
                let turn = turn.map_err(|error| InputError::from(error).at(place))?;
                let mut matrix = identity;
                matrix.view_mut((0, 0), (3, 3)).copy_from(&rotation::matrix(&turn));
                for (i, value) in Value::all(position, values)?.into_iter().enumerate() {
                    matrix[(i, 3)] = value;
                }
                (matrix, place)
            }
        };
        group.read(&matrix).map_err(|error| InputError::from(error).at(place))
    }

    /// A list of as many numbers as the algebra has dimensions.
    fn numbers(
        &self,
        what: &str,
        list: &[Value],
        dimension: usize,
        values: &[f64],
    ) -> Result<Vec<f64>, InputError> {
        if list.len() != dimension {
            let found = list.len();
            let message = format!("{what} has {found} components, the dimension is {dimension}");
            return Err(InputError::usage(message).at(&self.problem.source.key(what)));
        }
        Value::all(list, values).map_err(|error| error.or_near(&self.problem.source.key(what)))
    }

    /// The momentum in the frame of the equations.
    pub(super) fn momentum<G: Simulated>(
        &self,
        group: &G,
        g: &G::Element,
        forces: &Forces<G>,
        values: &[f64],
    ) -> Result<G::Vector, InputError> {
        let n = group.dimension();
        let own = if G::RIGHT { Side::Space } else { Side::Body };
        match &self.on_group.course {
            Course::Velocity(side, list) => {
                let v = G::Vector::from_components(&self.numbers("velocity", list, n, values)?);
                let v = if *side == own { v } else { group.adjoint(&group.inverse(g), &v) };
                Ok(forces.momentum(&v))
            }
            Course::Momentum(side, list) => {
                let h = G::Vector::from_components(&self.numbers("momentum", list, n, values)?);
                Ok(if *side == own { h } else { group.coadjoint(g, &h) })
            }
            // it has no equations of motion
            Course::Given(..) => Ok(G::Vector::zeros(n)),
        }
    }
}

/// What is said of a metric that no body has.
fn notes<G: Simulated>(group: &G, inertia: &DMatrix<f64>) -> Vec<String> {
    let eigenvalues = inertia.symmetric_eigenvalues();
    if eigenvalues.max() < 0.0 {
        return vec!["the metric is negative: so is the kinetic energy".into()];
    }
    if eigenvalues.min() <= 0.0 {
        return vec!["the metric is indefinite: no energy bounds the velocity".into()];
    }
    let Some(Ok(body)) = group.body(inertia) else { return vec![] };
    body.expect_masses().err().iter().map(Error::to_string).collect()
}

/// Casimirs of the algebra up to the second degree, where it is small and without parameters.
pub(super) fn casimirs(space: &Space) -> Vec<String> {
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
