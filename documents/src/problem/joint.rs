//! Joints whose numbers are formulas.

use super::joint_keys::JointKeys;
use super::keys::Keys;
use super::reader::{Reader, Value};
use crate::input::urdf::{JointFrame, Urdf, UrdfJoint};
use crate::input::{InputError, Place, forms::Number};
use affinor::mechanism::joint::JointData;
use affinor::mechanism::{Joint, JointKind, Twist};
use nalgebra::Vector3;

/// A joint whose numbers are formulas.
#[derive(Clone, Debug)]
pub(super) struct JointFormulas {
    pub name: String,
    /// The indices of the two bodies.
    pub ends: [usize; 2],
    pub kind: JointKind,
    /// The point, the axis and the second axis, as far as they are given.
    vectors: [Option<Vec<Value>>; 3],
    pitch: Option<Value>,
    twists: Vec<Vec<Value>>,
    /// The factor of the damping force of a joint of a robot, unless it is zero.
    pub damping: Option<Value>,
    /// The location of the axis.
    place: Place,
}

impl JointFormulas {
    /// The joint of a robot, with its point and its axis in the ground frame.
    pub fn of_robot(joint: &UrdfJoint, frame: &JointFrame<f64>, robot: &Urdf) -> Self {
        let constant = |number: &f64| Value::constant(&robot.source, *number);
        let vector = |list: &[f64; 3]| Some(list.iter().map(constant).collect());
        JointFormulas {
            name: joint.name.clone(),
            ends: joint.links,
            kind: joint.kind,
            vectors: [vector(&frame.point), vector(&frame.axis), None],
            pitch: None,
            twists: vec![],
            damping: (joint.damping != 0.0).then(|| constant(&joint.damping)),
            place: joint.axis_place.clone(),
        }
    }

    /// Reads the joint of the table with the index `at`, with its number among all joints and the
    /// names of all bodies.
    pub fn read(
        keys: &JointKeys,
        at: usize,
        number: usize,
        names: &[String],
        reader: &Reader,
    ) -> Result<Self, InputError> {
        let source = reader.source;
        let default = || format!("J{number}");
        let name = keys.name.as_ref().map_or_else(default, |name| name.content.clone());
        let ends = keys.ends(&name, names, source, at)?;
        let kind = keys.kind(source, at)?;
        let place = |key: &str| source.key(&format!("joints.{at}.{key}"));
        let vector = |key: &str, list: &Option<Vec<Number>>| match list {
            Some(list) => components::<3>(list, &place(key), reader).map(Some),
            None => Ok(None),
        };
        let twists = keys.twists.iter().flatten();
        let twists: Result<_, InputError> =
            twists.map(|list| components::<6>(list, &place("twists"), reader)).collect();
        Ok(JointFormulas {
            name,
            ends,
            kind,
            vectors: [
                vector("at", &keys.at)?,
                vector("axis", &keys.axis)?,
                vector("second_axis", &keys.second_axis)?,
            ],
            pitch: reader.optional(&keys.pitch)?,
            twists: twists?,
            damping: None,
            place: place(if kind == JointKind::Subgroup { "twists" } else { "axis" }),
        })
    }

    /// The point, the axis and the second axis, for values of the parameters. They are zero if they
    /// are not given.
    pub fn vectors(&self, values: &[f64]) -> Result<[Vector3<f64>; 3], InputError> {
        let [point, axis, second] = self.vectors.each_ref().map(|list| vector(list, values));
        Ok([point?, axis?, second?])
    }

    /// The point of the joint for values of the parameters; the origin if it is not given.
    pub fn point(&self, values: &[f64]) -> Result<Vector3<f64>, InputError> {
        vector(&self.vectors[0], values)
    }

    /// The joint for values of the parameters.
    pub fn at(&self, values: &[f64]) -> Result<Joint<f64>, InputError> {
        let [point, axis, second_axis] = self.vectors(values)?.map(Into::into);
        let pitch = self.pitch.as_ref().map_or(Ok(0.0), |pitch| pitch.at(values))?;
        let mut twists: Vec<Twist<f64>> = vec![];
        for list in &self.twists {
            let components = Value::all(list, values)?;
            twists.push(std::array::from_fn(|i| components[i]));
        }
        let data = JointData { point, axis, second_axis, pitch, twists };
        let joint = Joint::of_kind(self.kind, data).map_err(|error| {
            let help = "give a vector that is not zero, and axes that are not parallel";
            InputError::from(error).help(help).or_at(&self.place)
        })?;
        Ok(joint.between(&self.name, self.ends))
    }
}

/// The acceleration of gravity of a file.
pub(super) fn gravity(keys: &Keys, reader: &Reader) -> Result<Option<Vec<Value>>, InputError> {
    let read = |list: &Vec<Number>| components::<3>(list, &reader.source.key("gravity"), reader);
    keys.gravity.as_ref().map(read).transpose()
}

/// A vector of `N` formulas.
pub(super) fn components<const N: usize>(
    list: &[Number],
    place: &Place,
    reader: &Reader,
) -> Result<Vec<Value>, InputError> {
    if list.len() != N {
        let message = format!("the vector has {} components instead of {N}", list.len());
        return Err(InputError::usage(message).at(place));
    }
    reader.values(list)
}

/// The value of a vector; zero for a vector that is not given.
pub(super) fn vector(
    list: &Option<Vec<Value>>,
    values: &[f64],
) -> Result<Vector3<f64>, InputError> {
    let numbers = list.as_ref().map(|list| Value::all(list, values)).transpose()?;
    Ok(numbers.map_or_else(Vector3::zeros, |numbers| Vector3::from_column_slice(&numbers)))
}
