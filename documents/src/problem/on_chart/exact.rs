//! The exact equations of a curve on a chart, and the names of its quantities.

use crate::input::{InputError, Place, forms::MetricText, shown};
use crate::problem::keys::Keys;
use crate::problem::reader::{Reader, Written};
use crate::space::Definition;
use crate::space::formulas::ChartFormulas;
use affinor::Error;
use affinor::mechanics::systems::chart::{
    ChartEquations, ChartForces, ChartProgram, Edge, ElectromagneticField, VelocityPolynomial,
};
use affinor_tensors::{Down, Symbolic, Tensor, Tolerance};
use std::sync::Arc;

/// The forces of a problem and its Killing fields and tensors, as functions of the coordinates.
#[derive(Clone, Debug)]
pub(super) struct Laws {
    forces: ChartForces,
    /// The field strength in the frame of the definition.
    strength: Option<Tensor<Symbolic>>,
    forces_place: Place,
    /// Killing fields and Killing tensors in the frame of the definition.
    killing: Vec<(String, Tensor<Symbolic>, Place)>,
}

impl Laws {
    pub fn read(keys: &Keys, definition: &Definition, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let formulas = definition.formulas(&reader.names);
        let missing = definition.parameters().into_iter().find(|own| !reader.names.contains(own));
        if let Some(name) = missing {
            let message = format!("the parameter `{}` has no value", shown(&name));
            let place = source.key("space");
            let error = InputError::usage(message).at(&place);
            return Err(error.help("give the parameter a value in a table [parameters]"));
        }
        let scalar = |written: &Written| formulas.scalar(written.source());
        let number = |number: &Option<crate::input::forms::Number>| {
            let number = number.as_ref().map(|number| scalar(&reader.written(&number.0)));
            Ok::<_, InputError>(number.transpose()?.unwrap_or_else(one))
        };
        let keys_of_forces = &keys.forces;
        let potential = keys_of_forces.potential.as_ref();
        let potential = potential.map(|text| scalar(&reader.written(text))).transpose()?;
        let forces = ChartForces {
            mass: number(&keys_of_forces.mass)?,
            charge: number(&keys_of_forces.charge)?,
            potential,
            field: Self::vector_potential(keys, definition, &formulas, reader)?,
        };
        let strength = keys_of_forces.field_strength.as_ref();
        let strength = strength.map(|text| formulas.rows(text, [Down, Down], "forces.F", source));
        let strength = strength.transpose()?;
        if strength.is_some() && forces.field.is_some() {
            let error = source.refused("forces.F", "the electromagnetic field is given twice");
            return Err(error.help("give one of A, F"));
        }
        Ok(Laws {
            forces,
            strength,
            forces_place: source.key("forces"),
            killing: Self::killing(keys, &formulas, reader)?,
        })
    }

    /// The vector potential, in the coordinate frame.
    fn vector_potential(
        keys: &Keys,
        definition: &Definition,
        formulas: &ChartFormulas,
        reader: &Reader,
    ) -> Result<Option<ElectromagneticField>, InputError> {
        let Some(table) = &keys.forces.vector_potential else { return Ok(None) };
        let coordinates = definition.coordinates();
        let mut components = Vec::new();
        for (name, number) in &table.0 {
            let Some(i) = coordinates.iter().position(|own| *own == name.content) else {
                let message = format!("`{}` is not a coordinate", shown(name));
                let help = format!("the coordinates are {}", coordinates.join(", "));
                return Err(InputError::usage(message).at(&reader.source.at(name)).help(help));
            };
            components.push(([i], formulas.scalar(reader.written(&number.0).source())?));
        }
        let form = Tensor::from_components(coordinates.len(), &[Down], components)?;
        Ok(Some(ElectromagneticField::Potential(form)))
    }

    fn killing(
        keys: &Keys,
        formulas: &ChartFormulas,
        reader: &Reader,
    ) -> Result<Vec<(String, Tensor<Symbolic>, Place)>, InputError> {
        let source = reader.source;
        let mut killing = Vec::new();
        for (name, written) in reader.formulas(&keys.killing.fields)? {
            killing.push((name, formulas.field(written.source())?, written.place()));
        }
        let tensors: &[(_, MetricText)] = keys.killing.tensors.as_ref().map_or(&[], |all| &all.0);
        for (name, rows) in tensors {
            let path = format!("killing.tensors.{}", name.content);
            let checked = crate::space::notation::check_name(name);
            checked.map_err(|error| error.at(&source.at(name)))?;
            let tensor = formulas.rows(rows, [Down, Down], &path, source)?;
            killing.push((name.to_string(), tensor, source.key(&path)));
        }
        Ok(killing)
    }
}

fn one() -> Symbolic {
    Symbolic::from(1)
}

/// The compiled equations, and the names of the quantities of the curve.
#[derive(Clone, Debug)]
pub(super) struct Exact {
    pub program: Arc<ChartProgram>,
    pub has_metric: bool,
    /// Whether `g(v, v)` is constant along all curves.
    pub constant_speed: bool,
    /// The names, in the order of the quantities of a
    /// [`ChartColumns`](affinor::mechanics::simulation::ChartColumns).
    names: Vec<String>,
    /// The names of the conserved quantities.
    conserved: Vec<String>,
    dimension: usize,
    /// Whether there is a potential.
    pub has_potential: bool,
}

impl Exact {
    pub fn new(
        definition: &Definition,
        laws: &Laws,
        parameters: &[String],
    ) -> Result<Self, InputError> {
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let fields = geometry.frame_origin().fields();
        let in_coordinates = |tensor: &Tensor<Symbolic>| match fields {
            Some(fields) if !fields.are_coordinates() => fields.change().inverted().apply(tensor),
            _ => Ok(tensor.clone()),
        };
        let mut forces = laws.forces.clone();
        if let Some(strength) = &laws.strength {
            forces.field = Some(ElectromagneticField::Strength(in_coordinates(strength)?));
        }
        let equations = ChartEquations::new(&geometry, forces);
        let equations =
            equations.map_err(|error| InputError::from(error).at(&laws.forces_place))?;
        let mut named: Vec<(String, VelocityPolynomial)> = Vec::new();
        let mut conserved = Vec::new();
        let coordinates = equations.coordinates().to_vec();
        let dimension = coordinates.len();
        if equations.metric().is_some() {
            let (norm, energy) = (equations.norm()?, equations.energy()?);
            let constant = VelocityPolynomial::zero(dimension)?.constant;
            let kinetic = VelocityPolynomial { constant, ..energy.clone() };
            let potential = VelocityPolynomial {
                constant: equations.potential().clone(),
                ..VelocityPolynomial::zero(dimension)?
            };
            named.push(("norm".into(), norm));
            named.push(("kinetic".into(), kinetic));
            named.push(("potential".into(), potential));
            named.push(("energy".into(), energy));
            for (i, name) in coordinates.iter().enumerate() {
                named.push((format!("p_{name}"), equations.momentum(i)?));
            }
            for (name, polynomial) in &named {
                if name != "kinetic" && name != "potential" && equations.conserves(polynomial)? {
                    conserved.push(name.clone());
                }
            }
        }
        for (name, tensor, place) in &laws.killing {
            let refused = |error: Error| InputError::from(error).at(place);
            let tensor = in_coordinates(tensor).map_err(refused)?;
            let polynomial = match tensor.rank() {
                1 => equations.momentum_along(&tensor).map_err(refused)?,
                _ => {
                    VelocityPolynomial { quadratic: tensor, ..VelocityPolynomial::zero(dimension)? }
                }
            };
            equations.expect_conserved(name, &polynomial).map_err(refused)?;
            conserved.push(name.clone());
            named.push((name.clone(), polynomial));
        }
        let program = Self::program(definition, &equations, parameters, &named)?;
        let parameter = if coordinates.iter().any(|name| name == "s") { "sigma" } else { "s" };
        let mut names = vec![parameter.to_string()];
        names.extend(coordinates.iter().cloned());
        names.extend(coordinates.iter().map(|name| format!("v_{name}")));
        names.push("length".into());
        names.extend(named.into_iter().map(|(name, _)| name));
        if let Some((_, _, place)) = laws
            .killing
            .iter()
            .find(|(name, ..)| names.iter().filter(|own| *own == name).count() > 1)
        {
            let message = "the name is already in use";
            let help = "choose a name that is not a coordinate or a column";
            return Err(InputError::usage(message).at(place).help(help));
        }
        if let Some(name) = parameters.iter().find(|name| names.contains(name)) {
            let message = format!("the name `{name}` of the parameter is already in use");
            let help = format!("choose a name other than {}", names.join(", "));
            return Err(InputError::usage(message).help(help));
        }
        Ok(Exact {
            program: program.into(),
            has_metric: equations.metric().is_some(),
            constant_speed: conserved.iter().any(|name| name == "norm"),
            has_potential: *equations.potential() != Symbolic::default(),
            names,
            conserved,
            dimension,
        })
    }

    /// Compiles the equations with the edges of the chart.
    pub fn program(
        definition: &Definition,
        equations: &ChartEquations,
        parameters: &[String],
        named: &[(String, VelocityPolynomial)],
    ) -> Result<ChartProgram, InputError> {
        let mut edges: Vec<Edge> = definition
            .positive()
            .into_iter()
            .map(|function| Edge {
                reason: format!("{function} is positive on the chart, but reaches 0 there"),
                function,
                positive: true,
            })
            .collect();
        if let Some(function) = equations.density()? {
            let reason = format!("the metric degenerates where {function} = 0");
            edges.push(Edge { function, positive: false, reason });
        }
        let polynomials: Vec<VelocityPolynomial> =
            named.iter().map(|(_, polynomial)| polynomial.clone()).collect();
        let program = ChartProgram::new(equations, parameters, &polynomials, edges);
        program.map_err(|error| {
            let error = InputError::from(error);
            error.help("replace functions such as a(t) of the chart by formulas")
        })
    }

    /// The names of all quantities, in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The name of the parameter of the curve.
    pub fn parameter(&self) -> &str {
        &self.names[0]
    }

    /// The index of the quantity with a name.
    pub fn find(&self, name: &str) -> Option<usize> {
        // the proper time is the length of a timelike curve
        let name = if name == "proper_time" { "length" } else { name };
        let found = self.names.iter().position(|own| own == name);
        found.filter(|k| self.has_metric || *k <= 2 * self.dimension)
    }

    /// The names with a stem.
    pub fn expand(&self, stem: &str) -> Vec<String> {
        let n = self.dimension;
        match stem {
            "parameter" => self.names[..1].to_vec(),
            "position" => self.names[1..=n].to_vec(),
            "velocity" => self.names[n + 1..=2 * n].to_vec(),
            "momentum" if self.has_metric => {
                self.names[1..=n].iter().map(|name| format!("p_{name}")).collect()
            }
            "conserved" => {
                let others = |name: &&String| !["norm", "energy"].contains(&name.as_str());
                self.conserved.iter().filter(others).cloned().collect()
            }
            _ => vec![],
        }
    }

    /// Whether a quantity is constant along all curves.
    pub fn conserves(&self, name: &str) -> bool {
        self.conserved.iter().any(|own| own == name)
    }
}
