//! Problems of bodies and joints, with joint coordinates as the state.

mod constraints;
mod linearized;
mod names;
mod springs;

pub use linearized::LinearProblem;

use super::assembly::{AssembledJoint, Assembly};
use super::body::Bodies;
use super::integrator::Member;
use super::joint::{self, JointFormulas, vector};
use super::keys::{Keys, NOT_WITH_BODIES, OF_CHARTS, OF_HOMOGENEOUS};
use super::reader::{Reader, Value, Written};
use super::ready::{Factor, Ready};
use crate::input::{InputError, Place, forms::OneOrMore, shown};
use affinor::mechanics::MassProperties;
use affinor::mechanics::simulation::{TreeColumns, TreeSpec};
use affinor::mechanics::systems::tree::{
    JointForce, JointSpring, TreeForces, TreeState, TreeSystem,
};
use affinor::mechanism::{Cut, JointKind, Mechanism, Tree};
use constraints::{Cause, Constraints};
use nalgebra::{DVector, Vector3};
use names::TreeNames;
use springs::Springs;
use std::sync::Arc;

/// Bodies and joints.
#[derive(Clone, Debug)]
pub(super) struct OnTree {
    /// The names of the bodies, and whether each is fixed.
    bodies: Vec<(String, bool)>,
    /// Whether each body moves and has a mass, and the inertias of these bodies.
    has_inertia: Vec<bool>,
    inertias: Bodies,
    joints: Vec<TreeJoint>,
    springs: Springs,
    constraints: Constraints,
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
    motor: Option<Written>,
}

impl OnTree {
    /// Whether the file has bodies and joints, and does not ask for poses as coordinates.
    pub fn is_meant(keys: &Keys, reader: &Reader) -> Result<bool, InputError> {
        let has_joints = keys.urdf.is_some() || (keys.bodies.is_some() && keys.joints.is_some());
        let Some(text) = &keys.coordinates else { return Ok(has_joints) };
        let error = match &**text {
            "joints" | "poses" if !has_joints => {
                let error = InputError::usage("`coordinates` needs bodies and joints");
                error.help("give [[bodies]] and [[joints]]")
            }
            "joints" => return Ok(true),
            "poses" => return Ok(false),
            other => InputError::usage(format!("`{}` is neither joints nor poses", shown(other))),
        };
        Err(error.at(&reader.source.at(text)))
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
        let names: Vec<String> = bodies.iter().map(|body| body.name.clone()).collect();
        let springs = Springs::read(keys, &names, reader)?;
        let constraints = Constraints::read(keys, &names, reader)?;
        let has_inertia = bodies.iter().map(|body| !body.fixed && body.has_mass).collect();
        let bodies = bodies.into_iter().map(|body| (body.name, body.fixed)).collect();
        Ok(OnTree {
            bodies,
            has_inertia,
            inertias,
            joints,
            springs,
            constraints,
            gravity,
            notes,
            place,
        })
    }

    /// The mechanism for values of the parameters, with all loops cut.
    fn cut(&self, values: &[f64]) -> Result<Cut, InputError> {
        let joints = self.joints.iter().map(|joint| joint.own.at(values));
        let joints = joints.collect::<Result<Vec<_>, _>>()?;
        let fixed: Vec<usize> = (0..self.bodies.len()).filter(|at| self.bodies[*at].1).collect();
        let names = self.bodies.iter().map(|(name, _)| name.clone()).collect();
        let mechanism = Mechanism::new(names, &fixed, joints).map_err(|error| {
            let help = "connect every body by a joint, directly or through other bodies";
            InputError::from(error).or_at(&self.place).help(help)
        })?;
        let inertias: Vec<Option<MassProperties>> = self.of_bodies(self.inertias.masses(values)?);
        Cut::new(&mechanism, &inertias).map_err(|error| self.refused(error))
    }

    /// A list for the bodies that move and have a mass, as a list for all bodies.
    fn of_bodies<T>(&self, list: Vec<T>) -> Vec<Option<T>> {
        let mut list = list.into_iter();
        self.has_inertia.iter().map(|has| if *has { list.next() } else { None }).collect()
    }

    /// The tree for values of the parameters, with another acceleration of gravity if one is given.
    pub fn tree(&self, values: &[f64], gravity: Option<Vector3<f64>>) -> Result<Tree, InputError> {
        let cut = self.cut(values)?;
        if let Some([body, _]) = cut.copies.first() {
            let name = shown(&self.bodies[*body].0);
            let message = format!("the body `{name}` belongs to a loop");
            let error = InputError::usage(message).at(&self.place);
            return Err(error.help("`simulate` computes the motion of loops"));
        }
        let gravity = gravity.map_or_else(|| vector(&self.gravity, values), Ok)?;
        cut.tree(&gravity).map_err(|error| self.refused(error))
    }

    fn refused(&self, error: affinor::Error) -> InputError {
        InputError::from(error).or_at(&self.place).help("give the bodies masses away from the axis")
    }

    /// The system and its initial state, which satisfies the constraints.
    fn start<'m>(&self, member: &'m Member) -> Result<Start<'m>, InputError> {
        let values = member.values();
        let cut = self.cut(&values)?;
        let gravity = vector(&self.gravity, &values)?;
        let tree = Arc::new(cut.tree(&gravity).map_err(|error| self.refused(error))?);
        let mut names = TreeNames::new(self, &tree, &member.parameters)?;
        let (mut numbers, mut rates) = (tree.home(), vec![0.0; tree.freedom()]);
        let mut forces = TreeForces::default();
        for (at, joint) in self.joints.iter().enumerate() {
            joint.start(at, &tree, &values, &mut numbers, &mut rates)?;
            forces.joint_springs.extend(joint.springs(at, &tree, &values)?);
            forces.formulas.extend(joint.forces(at, &tree, &names)?);
        }
        forces.point_springs = self.springs.at(&tree, &values)?;
        tree.normalize(&mut numbers);
        let constraints = self.constraints(&cut, &tree, &names, &values)?;
        let (causes, constraints): (Vec<Cause>, _) = constraints.into_iter().unzip();
        let system = TreeSystem::new(tree, forces, constraints);
        names.complete(self, &system)?;
        let numbers = DVector::from_vec([numbers, rates].concat());
        let mut state = TreeState { time: member.times[0], numbers };
        let notes = self.assemble(&system, &causes, &mut state)?;
        Ok(Start { system, state, names, notes })
    }

    pub fn motion(&self, member: &Member) -> Result<Ready, InputError> {
        let Start { system, state, mut names, notes } = self.start(member)?;
        let (columns, events) = member.output.read_columns(&mut names, &[], member.source)?;
        let values = member.values();
        let points: Result<Vec<_>, InputError> =
            self.joints.iter().map(|joint| joint.own.point(&values)).collect();
        let spec = TreeSpec {
            system,
            time: state.time,
            numbers: state.numbers,
            integration: member.integration()?,
            columns: TreeColumns {
                bodies: names.bodies,
                points: points?,
                formulas: names.formulas,
            },
        };
        let ready = Ready::new(spec.start()?, &member.times, columns, events);
        let moving = self.bodies.iter().filter(|(_, fixed)| !fixed).count();
        let factor =
            |at: usize| Factor { number: (moving > 1).then_some(at + 1), first: 0, rotates: true };
        let factors = (0..moving).map(factor).collect();
        let notes = [&self.notes[..], &notes].concat();
        let solids = self.of_bodies(self.inertias.solids(&values)?);
        let moving = self.bodies.iter().zip(solids).filter(|((_, fixed), _)| !fixed);
        let solids = moving.map(|(_, solids)| solids.unwrap_or_default()).collect();
        Ok(Ready { notes, factors, solids, ..ready })
    }
}

/// A system at its initial state.
struct Start<'m> {
    system: TreeSystem,
    state: TreeState,
    names: TreeNames<'m>,
    notes: Vec<String>,
}

impl TreeJoint {
    fn read(joint: AssembledJoint, reader: &Reader) -> Result<Self, InputError> {
        let AssembledJoint { own, table } = joint;
        let Some((at, keys)) = table else {
            let spring = [None, own.damping.clone(), None];
            let motor = None;
            return Ok(TreeJoint { own, coordinate: None, rate: None, force: None, spring, motor });
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
            motor: keys.motor.as_ref().map(|formula| reader.written(&formula.0)),
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
                let all = names.list(..names.states).iter().chain(names.parameters());
                let all = all.cloned().collect::<Vec<_>>().join(", ");
                written.refused(error, format!("a joint force may contain {all}"))
            })?;
            Ok(JointForce { rate, formula, text: written.text().trim().into() })
        };
        tree.rates(at).zip(list).map(force).collect()
    }
}
