//! Problems with bodies and joints: their space, constraints, gravity and initial velocity.
//!
//! The frame of each body is that of the ground at the initial position. So every initial element
//! is the identity, and a point or an axis has the same components in all bodies.

use super::assembly::{AssembledJoint, Assembly};
use super::euler_poincare::EulerPoincare;
use super::forces::ForceFormulas;
use super::initial::InitialMomentum;
use super::joint::{self, JointFormulas, vector};
use super::keys::{Keys, NOT_WITH_BODIES, OF_CHARTS, OF_CONSTRAINTS, OF_HOMOGENEOUS, OF_TREES};
use super::on_group::OnGroup;
use super::reader::{Reader, Value};
use crate::input::{InputError, Place, Refusal, Source, shown};
use affinor::mechanics::simulation::quantities::SymbolTable;
use affinor::mechanics::simulation::{Constraints, Forces};
use affinor::mechanism::constraint::gravity;
use affinor::mechanism::{JointConstraint, JointKind, Mechanism};
use nalgebra::{DMatrix, DVector, Vector3};

/// A row of constraints fails to be independent below this size, relative to its own size.
const DEPENDENT: f64 = 1e-9;
/// Given rates of joints are consistent up to this relative error.
const RATES: f64 = 1e-9;

/// A joint with its initial rate.
#[derive(Clone, Debug)]
struct Joined {
    own: JointFormulas,
    /// The initial rate, about or along an axis of length 1.
    rate: Option<Value>,
}

/// The joints of a problem. A moving body is a factor of the product of groups SE(3).
#[derive(Clone, Debug)]
pub(super) struct Joints {
    /// The names of the bodies, and for each body the number of its factor.
    bodies: Vec<String>,
    factors: Vec<Option<usize>>,
    joints: Vec<Joined>,
    /// The constraints that are independent at the initial position, by the index of their joint
    /// and their index in it.
    kept: Vec<(usize, usize)>,
    gravity: Option<Vec<Value>>,
    notes: Vec<String>,
    place: Place,
}

/// The joints for values of the parameters.
struct Numbers {
    mechanism: Mechanism<f64>,
    /// The constraints of each joint.
    constraints: Vec<Vec<JointConstraint>>,
}

/// Reads a problem with bodies and joints: the group, the dynamics and the joints. Constraints that
/// depend on others for these values of the parameters are left out.
pub(super) fn read(
    keys: &Keys,
    reader: &Reader,
    values: &[f64],
) -> Result<(OnGroup, EulerPoincare, Joints), InputError> {
    let source = reader.source;
    if keys.urdf.is_none() && (keys.bodies.is_none() || keys.joints.is_none()) {
        let error = source.refused("bodies", "bodies need joints, and joints need bodies");
        return Err(error.help("give both [[bodies]] and [[joints]]"));
    }
    let of_mechanisms = "a problem with bodies and joints";
    for key in OF_TREES.iter().chain(&OF_CONSTRAINTS) {
        if source.has_key(key) {
            let error = source.refused(key, format!("`{key}` needs joint coordinates"));
            return Err(error.help("leave coordinates = \"poses\" out"));
        }
    }
    let others = [&NOT_WITH_BODIES[..], &OF_CHARTS, &OF_HOMOGENEOUS].concat();
    reader.refuse(of_mechanisms, &others)?;
    if keys.gravity.is_some() && keys.forces.potential.is_some() {
        let error = InputError::usage("the potential is given twice").at(&source.key("gravity"));
        return Err(error.help("give one of gravity, forces.potential"));
    }
    let assembly = Assembly::read(keys, reader)?;
    let mut joints = Joints::read(keys, &assembly, reader)?;
    joints.select(values, source)?;
    let moving = joints.factors.iter().flatten().count();
    let dynamics = EulerPoincare::new(
        assembly.inertias,
        match keys.initial.velocity {
            Some(_) => Some(InitialMomentum::read(&keys.initial, reader)?),
            None => None,
        },
        ForceFormulas::read(&keys.forces, reader)?,
    );
    Ok((OnGroup::of_poses(moving, source)?, dynamics.constrained(), joints))
}

impl Joints {
    fn read(keys: &Keys, assembly: &Assembly, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let with_joints = "leave coordinates = \"poses\" out";
        let mut next = 0;
        let mut factors = vec![];
        for body in &assembly.bodies {
            if !body.fixed && !body.has_mass {
                let message = format!("the moving link `{}` has no mass", shown(&body.name));
                let help = format!("{with_joints}, or give the link an <inertial>");
                return Err(InputError::usage(message).at(&body.place).help(help));
            }
            factors.push((!body.fixed).then_some(next));
            next += usize::from(!body.fixed);
        }
        let mut joints = vec![];
        for AssembledJoint { own, table } in &assembly.joints {
            let own = own.clone();
            if let Some(damping) = &own.damping {
                let message =
                    format!("the damping of joint `{}` needs joint coordinates", shown(&own.name));
                return Err(InputError::usage(message).at(&damping.place()).help(with_joints));
            }
            let Some((at, keys)) = table else {
                joints.push(Joined { own, rate: None });
                continue;
            };
            if matches!(own.kind, JointKind::Helical | JointKind::Subgroup) {
                let message = format!("the motion of a {} joint is not supported", own.kind.name());
                let error =
                    InputError::usage(message).at(&source.key(&format!("joints.{at}.type")));
                return Err(error.help("leave coordinates = \"poses\" out, or use other joints"));
            }
            let of_trees = ["coordinate", "force", "stiffness", "damping", "rest", "motor"];
            for key in of_trees.map(|key| format!("joints.{at}.{key}")) {
                if source.has_key(&key) {
                    let error = source.refused(&key, "this key needs joint coordinates");
                    return Err(error.help(with_joints));
                }
            }
            let rate = match keys.rate.as_ref().map(|rate| &rate.0[..]) {
                None => None,
                Some([rate]) => Some(reader.value(rate)?),
                Some(_) => {
                    let place = format!("joints.{at}.rate");
                    let error = source.refused(&place, "a list of rates needs joint coordinates");
                    return Err(error.help(with_joints));
                }
            };
            joints.push(Joined { own, rate });
        }
        let gravity = joint::gravity(keys, reader)?;
        let bodies = assembly.bodies.iter().map(|body| body.name.clone()).collect();
        let (notes, place) = (assembly.notes.clone(), assembly.place.clone());
        Ok(Joints { bodies, factors, joints, kept: vec![], gravity, notes, place })
    }

    /// The joints for these values of the parameters.
    fn at(&self, values: &[f64]) -> Result<Numbers, InputError> {
        let (mut joints, mut constraints) = (vec![], vec![]);
        for Joined { own, .. } in &self.joints {
            let [point, axis, second] = own.vectors(values)?;
            constraints.push(JointConstraint::all(own.kind, &point, &axis, &second));
            joints.push(own.at(values)?);
        }
        let fixed: Vec<usize> =
            (0..self.factors.len()).filter(|at| self.factors[*at].is_none()).collect();
        let mechanism = Mechanism::new(self.bodies.clone(), &fixed, joints).map_err(|error| {
            let help = "connect every body by a joint, directly or through other bodies";
            InputError::from(error).or_at(&self.place).help(help)
        })?;
        Ok(Numbers { mechanism, constraints })
    }

    /// Selects the constraints that are independent at the initial position.
    fn select(&mut self, values: &[f64], source: &Source) -> Result<(), InputError> {
        let moving = self.factors.iter().flatten().count();
        let numbers = self.at(values)?;
        let (mut basis, mut left): (Vec<DVector<f64>>, Vec<&str>) = (vec![], vec![]);
        for (joint, (joined, constraints)) in
            self.joints.iter().zip(&numbers.constraints).enumerate()
        {
            for (at, constraint) in constraints.iter().enumerate() {
                let row = constraint.gradient(self.ends(joined), moving);
                let mut rest = row.clone();
                // twice, against loss of orthogonality
                for _ in 0..2 {
                    basis.iter().for_each(|own| rest -= own * own.dot(&rest));
                }
                if rest.norm() > DEPENDENT * row.norm() {
                    basis.push(rest.normalize());
                    self.kept.push((joint, at));
                } else {
                    left.push(&joined.own.name);
                }
            }
        }
        if self.kept.is_empty() {
            let error = source.refused("joints", "the joints do not constrain the bodies");
            return Err(error.help("give a joint with fewer degrees of freedom"));
        }
        if self.kept.len() == 6 * moving {
            let error = source.refused("joints", "the joints lock all bodies at this position");
            return Err(InputError { refusal: Refusal::Mathematics, ..error }
                .help("remove a joint; `affinor mobility` finds redundant joints"));
        }
        if !left.is_empty() {
            let count = left.len();
            left.dedup();
            self.notes.push(format!(
                "{count} constraints of the joints {} follow from the others at the initial \
                 position and are left out: their reactions are 0",
                left.join(", ")
            ));
        }
        Ok(())
    }

    /// The number of constraints.
    pub fn count(&self) -> usize {
        self.kept.len()
    }

    /// Notes on the robot, and on the constraints that are left out.
    pub fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn ends(&self, joined: &Joined) -> [Option<usize>; 2] {
        joined.own.ends.map(|body| self.factors[body])
    }

    /// The constraints for these values of the parameters.
    pub fn constraints(
        &self,
        values: &[f64],
        names: &SymbolTable,
    ) -> Result<Constraints, InputError> {
        let numbers = self.at(values)?;
        let mut all = Constraints::default();
        for (joint, at) in &self.kept {
            let ends = self.ends(&self.joints[*joint]);
            let constraint = numbers.constraints[*joint][*at];
            all.add_polynomial(&constraint.polynomial(ends, &|k, i, j| names.entry(k, i, j)));
        }
        Ok(all)
    }

    /// The forces with gravity, for the metric of the kinetic energy.
    pub fn with_gravity(
        &self,
        values: &[f64],
        inertia: &DMatrix<f64>,
        mut forces: Forces,
    ) -> Result<Forces, InputError> {
        if self.gravity.is_none() {
            return Ok(forces);
        }
        let acceleration = vector(&self.gravity, values)?;
        let bodies = (0..inertia.nrows()).step_by(6);
        // the kinetic energy contains m w . (c x u), so its matrix is the matrix of the cross product
        let moment = |at: usize| {
            let entry = |i: usize, j: usize| inertia[(at + i, at + 3 + j)];
            (inertia[(at + 3, at + 3)], Vector3::new(entry(2, 1), entry(0, 2), entry(1, 0)))
        };
        let moments: Vec<(f64, Vector3<f64>)> = bodies.map(moment).collect();
        let names = forces.names();
        let potential = gravity(&acceleration, &moments, &|k, i, j| names.entry(k, i, j));
        forces.set_polynomial_potential(&potential, "gravity");
        Ok(forces)
    }

    /// The initial velocities of the moving bodies for the rates of joints; without rates, all
    /// bodies are at rest. Rates that are not given have the least sum of squares.
    pub fn velocity(&self, values: &[f64]) -> Result<DVector<f64>, InputError> {
        let mechanism = self.at(values)?.mechanism;
        let offsets = mechanism.offsets();
        let mut given = vec![];
        for (at, joined) in self.joints.iter().enumerate() {
            let Some(rate) = &joined.rate else { continue };
            let joint = &mechanism.joints()[at];
            if joint.freedom() != 1 {
                let error = InputError::usage("this joint has several rates").at(&rate.place());
                return Err(error.help("give the rates of revolute and prismatic joints"));
            }
            let twist = DVector::from_column_slice(&joint.twists()[0]);
            // the rate refers to an axis of length 1
            let turn = twist.rows_range(..3).norm();
            let size = if turn > 0.0 { turn } else { twist.rows_range(3..).norm() };
            given.push((offsets[at], rate.at(values)? / size, rate.place()));
        }
        let moving = self.factors.iter().flatten().count();
        let Some((.., place)) = given.first() else { return Ok(DVector::zeros(6 * moving)) };
        let closure = mechanism.jacobian()?.to_dense();
        let mut matrix = DMatrix::zeros(closure.len() + given.len(), mechanism.freedom());
        let mut right = DVector::zeros(matrix.nrows());
        for (i, row) in closure.iter().enumerate() {
            matrix.row_mut(i).copy_from_slice(row);
        }
        for (i, (column, rate, _)) in given.iter().enumerate() {
            matrix[(closure.len() + i, *column)] = 1.0;
            right[closure.len() + i] = *rate;
        }
        let svd = matrix.clone().svd(true, true);
        let cut = 1e-10 * svd.singular_values.max();
        let rates = svd.solve(&right, cut).map_err(InputError::mathematics)?;
        let rest = (&matrix * &rates - &right).norm();
        if rest > RATES * right.norm() {
            let message =
                format!("the joints do not allow these rates: they are off by {rest:.2e}");
            let error = InputError::mathematics(message).at(place);
            return Err(
                error.help("give rates that close all loops; `affinor mobility` prints them")
            );
        }
        let bodies = mechanism.velocities(rates.as_slice());
        let mut velocity = DVector::zeros(6 * moving);
        for (factor, own) in self.factors.iter().zip(bodies) {
            if let Some(factor) = factor {
                velocity.rows_range_mut(6 * factor..6 * factor + 6).copy_from_slice(&own);
            }
        }
        Ok(velocity)
    }
}
