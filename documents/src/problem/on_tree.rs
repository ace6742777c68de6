//! Problems of trees of bodies, with joint coordinates as the state.

use super::assembly::{AssembledJoint, Assembly};
use super::body::Bodies;
use super::integrator::Member;
use super::joint::{self, JointFormulas, vector};
use super::keys::{Keys, NOT_WITH_BODIES, OF_CHARTS, OF_HOMOGENEOUS};
use super::output::RowNames;
use super::reader::{Reader, Value, Written};
use super::ready::Ready;
use crate::input::{InputError, Place, forms::OneOrMore, shown};
use affinor::mechanics::MassProperties;
use affinor::mechanics::formula::{Formula, Symbol};
use affinor::mechanics::simulation::{TreeColumns, TreeSpec};
use affinor::mechanics::systems::tree::{JointForce, JointSpring, TreeSystem};
use affinor::mechanism::{JointKind, Mechanism, Tree};
use affinor_tensors::expression::ExpressionError;
use nalgebra::Vector3;
use std::sync::Arc;

/// A tree of bodies.
#[derive(Clone, Debug)]
pub(super) struct OnTree {
    /// The names of the bodies, and whether each is fixed.
    bodies: Vec<(String, bool)>,
    /// Whether each body moves and has a mass, and the inertias of these bodies.
    has_inertia: Vec<bool>,
    inertias: Bodies,
    joints: Vec<TreeJoint>,
    gravity: Option<Vec<Value>>,
    notes: Vec<String>,
    place: Place,
}

/// A joint with its initial values and forces.
#[derive(Clone, Debug)]
struct TreeJoint {
    own: JointFormulas,
    coordinate: Option<(Vec<Value>, Place)>,
    rate: Option<(Vec<Value>, Place)>,
    force: Option<(Vec<Written>, Place)>,
    /// The stiffness, the damping and the rest coordinate.
    spring: [Option<Value>; 3],
}

impl OnTree {
    /// Whether the file asks for joint coordinates.
    pub fn is_meant(keys: &Keys, reader: &Reader) -> Result<bool, InputError> {
        let Some(text) = &keys.coordinates else { return Ok(false) };
        let place = reader.source.at(text);
        let error = match &**text {
            "joints" | "poses"
                if keys.urdf.is_none() && (keys.bodies.is_none() || keys.joints.is_none()) =>
            {
                let error = InputError::usage("`coordinates` needs bodies and joints").at(&place);
                error.help("give [[bodies]] and [[joints]]")
            }
            "joints" => return Ok(true),
            "poses" => return Ok(false),
            other => {
                let message = format!("`{}` is neither joints nor poses", shown(other));
                InputError::usage(message).at(&place)
            }
        };
        Err(error)
    }

    pub fn read(keys: &Keys, reader: &Reader) -> Result<Self, InputError> {
        let of_poses = ["forces", "initial.velocity"];
        let refused = [&NOT_WITH_BODIES[..], &of_poses, &OF_CHARTS, &OF_HOMOGENEOUS].concat();
        reader.refuse("a problem in joint coordinates", &refused)?;
        let Assembly { bodies, inertias, joints, notes, .. } = Assembly::read(keys, reader)?;
        let place = reader.source.key(if keys.joints.is_some() { "joints" } else { "urdf" });
        let joints = joints.into_iter().map(|joint| TreeJoint::read(joint, reader));
        let joints = joints.collect::<Result<_, _>>()?;
        let gravity = joint::gravity(keys, reader)?;
        let has_inertia = bodies.iter().map(|body| !body.fixed && body.has_mass).collect();
        let bodies = bodies.into_iter().map(|body| (body.name, body.fixed)).collect();
        Ok(OnTree { bodies, has_inertia, inertias, joints, gravity, notes, place })
    }

    /// The tree for values of the parameters, with another acceleration of gravity if one is given.
    pub fn tree(&self, values: &[f64], gravity: Option<Vector3<f64>>) -> Result<Tree, InputError> {
        let joints = self.joints.iter().map(|joint| joint.own.at(values));
        let joints = joints.collect::<Result<Vec<_>, _>>()?;
        let fixed: Vec<usize> = (0..self.bodies.len()).filter(|at| self.bodies[*at].1).collect();
        let names = self.bodies.iter().map(|(name, _)| name.clone()).collect();
        let mechanism = Mechanism::new(names, &fixed, joints).map_err(|error| {
            let help = "connect every body by a joint, directly or through other bodies";
            InputError::from(error).or_at(&self.place).help(help)
        })?;
        let mut masses = self.inertias.masses(values)?.into_iter();
        let inertias: Vec<Option<MassProperties>> =
            self.has_inertia.iter().map(|has| if *has { masses.next() } else { None }).collect();
        let gravity = gravity.map_or_else(|| vector(&self.gravity, values), Ok)?;
        let has_loop = !mechanism.loops().is_empty();
        Tree::new(&mechanism, &inertias, &gravity).map_err(|error| {
            let help = match has_loop {
                true => "leave `coordinates` out: the bodies then move by poses and constraints",
                false => "give the bodies masses away from the axis",
            };
            InputError::from(error).or_at(&self.place).help(help)
        })
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        let values = member.values();
        let tree = Arc::new(self.tree(&values, None)?);
        let mut names = TreeNames::new(self, &tree, &member.parameters)?;
        let (mut numbers, mut rates) = (tree.home(), vec![0.0; tree.freedom()]);
        let (mut springs, mut forces) = (vec![], vec![]);
        for (at, joint) in self.joints.iter().enumerate() {
            joint.start(at, &tree, &values, &mut numbers, &mut rates)?;
            springs.extend(joint.springs(at, &tree, &values)?);
            forces.extend(joint.forces(at, &tree, &names)?);
        }
        tree.normalize(&mut numbers);
        let system = TreeSystem::new(tree, springs, forces);
        names.is_conservative = system.is_conservative();
        let (columns, events) = member.output.read_columns(&mut names, &[], member.source)?;
        let spec = TreeSpec {
            system,
            time: member.times[0],
            numbers,
            rates,
            integration: member.integration()?,
            columns: TreeColumns { bodies: names.bodies, formulas: names.formulas },
        };
        let ready = Ready::new(spec.start()?, &member.times, columns, events);
        Ok(Ready { notes: self.notes.clone(), ..ready })
    }
}

impl TreeJoint {
    fn read(joint: AssembledJoint, reader: &Reader) -> Result<Self, InputError> {
        let AssembledJoint { own, table } = joint;
        let Some((at, keys)) = table else {
            let spring = [None, own.damping.clone(), None];
            return Ok(TreeJoint { own, coordinate: None, rate: None, force: None, spring });
        };
        let place = |key: &str| reader.source.key(&format!("joints.{at}.{key}"));
        let values = |key: &str, list: &Option<OneOrMore>| -> Result<_, InputError> {
            let Some(list) = list else { return Ok(None) };
            Ok(Some((reader.values(&list.0)?, place(key))))
        };
        let force = keys.force.as_ref().map(|list| {
            let written = list.0.iter().map(|number| reader.written(&number.0)).collect();
            (written, place("force"))
        });
        if let (None, Some(_)) = (&keys.stiffness, &keys.rest) {
            let error = InputError::usage("`rest` needs a stiffness").at(&place("rest"));
            return Err(error.help("give stiffness, or leave the key out"));
        }
        let damping = reader.optional(&keys.damping)?.or(own.damping.clone());
        Ok(TreeJoint {
            own,
            coordinate: values("coordinate", &keys.coordinate)?,
            rate: values("rate", &keys.rate)?,
            force,
            spring: [reader.optional(&keys.stiffness)?, damping, reader.optional(&keys.rest)?],
        })
    }

    /// Checks the number of values of a key.
    fn expect(&self, found: usize, needed: usize, place: &Place) -> Result<(), InputError> {
        if found == needed {
            return Ok(());
        }
        let (kind, name) = (self.own.kind.name(), shown(&self.own.name));
        let message = format!("the {kind} joint `{name}` needs {needed} values here, not {found}");
        let has_ball = matches!(self.own.kind, JointKind::Spherical | JointKind::Free);
        let help = match has_ball {
            true => "coordinates end with a quaternion w, x, y, z, rates with an angular velocity",
            false => "give one value for each freedom, in the order of the joint",
        };
        Err(InputError::usage(message).at(place).help(help))
    }

    /// Writes the initial values of this joint.
    fn start(
        &self,
        at: usize,
        tree: &Tree,
        values: &[f64],
        numbers: &mut [f64],
        rates: &mut [f64],
    ) -> Result<(), InputError> {
        let given = [
            (&self.coordinate, &mut numbers[tree.numbers(at)]),
            (&self.rate, &mut rates[tree.rates(at)]),
        ];
        for (given, target) in given {
            if let Some((list, place)) = given {
                self.expect(list.len(), target.len(), place)?;
                target.copy_from_slice(&Value::all(list, values)?);
            }
        }
        let range = tree.numbers(at);
        let ball = tree.balls().find(|(_, number)| range.contains(number));
        if let (Some((_, first)), Some((_, place))) = (ball, &self.coordinate) {
            let square: f64 = numbers[first..first + 4].iter().map(|x| x * x).sum();
            if !(square > 0.0 && square.is_finite()) {
                let error = InputError::usage("the quaternion w, x, y, z has no direction");
                return Err(error.at(place).help("the identity is 1, 0, 0, 0"));
            }
        }
        Ok(())
    }

    /// The springs and dampers of this joint, one for each freedom.
    fn springs(
        &self,
        at: usize,
        tree: &Tree,
        values: &[f64],
    ) -> Result<Vec<JointSpring>, InputError> {
        let number = |value: &Option<Value>| value.as_ref().map_or(Ok(0.0), |own| own.at(values));
        let [stiffness, damping, rest] = self.spring.each_ref().map(number);
        let (stiffness, damping, rest) = (stiffness?, damping?, rest?);
        if let [None, None, _] = self.spring {
            return Ok(vec![]);
        }
        let mut springs = vec![];
        for rate in tree.rates(at) {
            let number = tree.coordinates().find(|(own, _)| *own == rate).map(|(_, at)| at);
            if let (None, Some(value)) = (number, &self.spring[0]) {
                let error = InputError::usage("rotations about a point have no `stiffness`");
                let help = "give damping only, or a force in the quaternion of the joint";
                return Err(error.at(&value.place()).help(help));
            }
            springs.push(JointSpring { rate, number, stiffness, rest, damping });
        }
        Ok(springs)
    }

    /// The joint forces that are formulas.
    fn forces(
        &self,
        at: usize,
        tree: &Tree,
        names: &TreeNames,
    ) -> Result<Vec<JointForce>, InputError> {
        let Some((list, place)) = &self.force else { return Ok(vec![]) };
        self.expect(list.len(), tree.rates(at).len(), place)?;
        let force = |(rate, written): (usize, &Written)| {
            let formula = names.formula(written.text(), names.states);
            let formula = formula.map_err(|error| {
                let all = names.names[..names.states].iter().chain(names.parameters());
                let all = all.cloned().collect::<Vec<_>>().join(", ");
                written.refused(error, format!("a joint force may contain {all}"))
            })?;
            Ok(JointForce { rate, formula, text: written.text().trim().into() })
        };
        tree.rates(at).zip(list).map(force).collect()
    }
}

/// The names of the quantities of [`TreeColumns`], and the formulas so far.
struct TreeNames<'n> {
    names: Vec<String>,
    /// The number of names that joint forces may use: the time, the numbers and the rates.
    states: usize,
    /// The number of numbers of a configuration, and the number of rates.
    sizes: [usize; 2],
    /// The moving bodies.
    bodies: Vec<usize>,
    /// The parameters of the problem and their values.
    parameters: &'n [(String, f64)],
    is_conservative: bool,
    formulas: Vec<Formula>,
    of_parameters: Vec<String>,
}

impl<'n> TreeNames<'n> {
    fn new(
        problem: &OnTree,
        tree: &Tree,
        parameters: &'n [(String, f64)],
    ) -> Result<Self, InputError> {
        let mut labels: Vec<String> = vec![];
        for (at, joint) in problem.joints.iter().enumerate() {
            // blanks and hyphens are not allowed in names of formulas
            let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
            let label: String = joint.own.name.chars().map(letter).collect();
            let is_name = label.starts_with(|c: char| c.is_ascii_alphabetic());
            let label = if is_name { label } else { format!("J{}", at + 1) };
            if labels.contains(&label) {
                let message = format!("two joints have the name `{}`", shown(&label));
                let error = InputError::usage(message).at(&problem.place);
                return Err(error.help("choose another name"));
            }
            labels.push(label);
        }
        let of_joint = |stem: &str, count: usize, label: &str| -> Vec<String> {
            match count {
                1 => vec![format!("{stem}_{label}")],
                _ => (1..=count).map(|k| format!("{stem}{k}_{label}")).collect(),
            }
        };
        let mut names = vec!["t".to_string()];
        for (at, label) in labels.iter().enumerate() {
            let (numbers, rates) = (tree.numbers(at).len(), tree.rates(at).len());
            // a quaternion has one number more than rates
            let single = if numbers > rates { numbers - 4 } else { numbers };
            names.extend(of_joint("q", single, label));
            let quaternion = if numbers > rates { &["qw", "qx", "qy", "qz"][..] } else { &[] };
            names.extend(quaternion.iter().map(|stem| format!("{stem}_{label}")));
        }
        let numbers = names.len() - 1;
        for stem in ["v", "f"] {
            for (at, label) in labels.iter().enumerate() {
                names.extend(of_joint(stem, tree.rates(at).len(), label));
            }
        }
        let states = 1 + numbers + tree.freedom();
        names.extend(["kinetic", "potential", "energy", "power"].map(String::from));
        names.extend((1..=6).map(|i| format!("h{i}")));
        let bodies: Vec<usize> =
            (0..problem.bodies.len()).filter(|at| !problem.bodies[*at].1).collect();
        for number in 1..=bodies.len() {
            let suffix = if bodies.len() > 1 { format!("_{number}") } else { String::new() };
            let named = ["qw", "qx", "qy", "qz", "x", "y", "z"].map(String::from);
            let entries = (0..12).map(|at| format!("g{}{}", at / 4 + 1, at % 4 + 1));
            names.extend(named.into_iter().chain(entries).map(|name| name + &suffix));
        }
        let twice = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
        let taken = parameters.iter().map(|(name, _)| name).find(|name| names.contains(name));
        if let Some(name) = taken.or(twice.map(|(_, name)| name)) {
            let message = format!("the name `{}` is already in use", shown(name));
            let error = InputError::usage(message).at(&problem.place);
            return Err(error.help("rename the parameter or the joint"));
        }
        Ok(TreeNames {
            names,
            states,
            sizes: [numbers, tree.freedom()],
            bodies,
            parameters,
            is_conservative: false,
            formulas: vec![],
            of_parameters: parameters.iter().map(|(name, _)| name.clone()).collect(),
        })
    }

    fn parameters(&self) -> impl Iterator<Item = &String> {
        self.of_parameters.iter()
    }

    /// A formula in the first `count` quantities and the parameters.
    fn formula(&self, text: &str, count: usize) -> Result<Formula, ExpressionError> {
        Formula::read(text, &mut |name| {
            if let Some(k) = self.names[..count].iter().position(|own| own == name) {
                return Some(Symbol::Variable(k));
            }
            let parameter = self.parameters.iter().find(|(own, _)| own == name);
            parameter.map(|(_, value)| Symbol::Number(*value))
        })
    }

    /// The indices of the quantities behind the rates, up to the first pose.
    fn poses(&self) -> usize {
        self.states + TreeColumns::loads(self.sizes[1])
    }
}

impl RowNames for TreeNames<'_> {
    fn defaults(&self) -> Vec<&'static str> {
        vec!["t", "coordinates", "rates", "poses", "energy"]
    }

    fn expand(&self, stem: &str) -> Vec<String> {
        let [numbers, freedom] = self.sizes;
        let list = |first: usize, count: usize| self.names[first..first + count].to_vec();
        match stem {
            _ if self.names.iter().any(|name| name == stem) => vec![stem.into()],
            "coordinates" => list(1, numbers),
            "rates" => list(1 + numbers, freedom),
            "forces" => list(self.states, freedom),
            "h" | "momentum" => list(self.states + freedom + 4, 6),
            "poses" | "element" => {
                let poses = self.names[self.poses()..].chunks(TreeColumns::POSE);
                poses.flat_map(|pose| pose[..7].to_vec()).collect()
            }
            _ => vec![],
        }
    }

    fn all(&self) -> String {
        let stems = ["coordinates", "rates", "forces", "poses", "momentum"].map(String::from);
        let names = self.names[..self.poses()].iter().chain(self.parameters());
        names.chain(&stems).cloned().collect::<Vec<_>>().join(", ")
    }

    fn watched(&self, stem: &str, _: &str) -> (bool, bool) {
        (stem == "energy", stem == "energy" && self.is_conservative)
    }

    fn momentum(&self) -> &'static str {
        "h"
    }

    fn add(&mut self, text: &str) -> Result<(), ExpressionError> {
        let formula = self.formula(text, self.names.len())?;
        self.formulas.push(formula);
        Ok(())
    }
}
