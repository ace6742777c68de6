//! Springs and dampers between points of bodies.

use crate::input::{InputError, Place};
use crate::problem::joint::{components, vector};
use crate::problem::joint_keys::ends;
use crate::problem::keys::Keys;
use crate::problem::reader::{Reader, Value};
use affinor::mechanics::systems::tree::PointSpring;
use affinor::mechanism::Tree;

/// The springs of a file.
#[derive(Clone, Debug)]
pub(super) struct Springs(Vec<Spring>);

#[derive(Clone, Debug)]
struct Spring {
    ends: [usize; 2],
    /// The points at the position of the file.
    points: [Option<Vec<Value>>; 2],
    stiffness: Option<Value>,
    damping: Option<Value>,
    length: Option<Value>,
    place: Place,
}

impl Springs {
    pub fn read(keys: &Keys, names: &[String], reader: &Reader) -> Result<Self, InputError> {
        let mut springs = vec![];
        for (at, own) in keys.springs.iter().flatten().enumerate() {
            let place = |key: &str| reader.source.key(&format!("springs.{at}.{key}"));
            let name = (at + 1).to_string();
            let ends =
                ends(&own.bodies, ["spring", &name], names, reader.source, &place("bodies"))?;
            if own.stiffness.is_none() && own.damping.is_none() {
                let error = InputError::usage(format!("spring {name} has no force"));
                return Err(error.at(&place("bodies")).help("give stiffness or damping"));
            }
            springs.push(Spring {
                ends,
                points: [
                    Some(components::<3>(&own.from, &place("from"), reader)?),
                    Some(components::<3>(&own.to, &place("to"), reader)?),
                ],
                stiffness: reader.optional(&own.stiffness)?,
                damping: reader.optional(&own.damping)?,
                length: reader.optional(&own.length)?,
                place: place("bodies"),
            });
        }
        Ok(Springs(springs))
    }

    /// The springs for values of the parameters.
    pub fn at(&self, tree: &Tree, values: &[f64]) -> Result<Vec<PointSpring>, InputError> {
        self.0.iter().map(|spring| spring.at(tree, values)).collect()
    }
}

impl Spring {
    fn at(&self, tree: &Tree, values: &[f64]) -> Result<PointSpring, InputError> {
        let number = |value: &Option<Value>| value.as_ref().map_or(Ok(0.0), |own| own.at(values));
        let [from, to] = self.points.each_ref().map(|point| vector(point, values));
        let (from, to) = (from?, to?);
        let distance = (to - from).norm();
        let length = match &self.length {
            Some(length) => length.at(values)?,
            None => distance,
        };
        let ends = [tree.point(self.ends[0], &from), tree.point(self.ends[1], &to)];
        if distance == 0.0 && length != 0.0 {
            let error =
                InputError::usage("the ends of the spring coincide, so it has no direction");
            return Err(error.at(&self.place).help("move one of `from`, `to`, or give length = 0"));
        }
        let (stiffness, damping) = (number(&self.stiffness)?, number(&self.damping)?);
        Ok(PointSpring { ends, stiffness, length, damping })
    }
}
