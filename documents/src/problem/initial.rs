//! Initial conditions on a group: an element, and a velocity or a momentum.

use super::reader::{Reader, Value};
use super::ready::factors;
use crate::input::{
    InputError, Place,
    forms::{Number, Text, VectorText},
    shown,
};
use affinor::Error;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation, restored, rotation};
use affinor::mechanics::simulation::{ForceFrame, Observables, SimulationGroup};
use nalgebra::DVector;
use serde::Deserialize;

/// The table `[initial]`: the initial condition.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct InitialKeys {
    pub time: Option<Number>,
    pub element: Option<Vec<Vec<Number>>>,
    pub restore: Option<bool>,
    pub coordinates: Option<Vec<Number>>,
    pub quaternion: Option<Vec<Number>>,
    pub position: Option<VectorText>,
    pub parts: Option<Vec<ElementKeys>>,
    pub velocity: Option<VectorText>,
    pub spatial_velocity: Option<Vec<Number>>,
    pub momentum: Option<Vec<Number>>,
    pub spatial_momentum: Option<Vec<Number>>,
    pub normalize: Option<Text>,
    pub solve: Option<Text>,
    pub root: Option<Text>,
}

impl InitialKeys {
    /// Returns an error if a vector is not a list. Only on charts, components have names.
    pub fn expect_lists(&self, reader: &Reader) -> Result<(), InputError> {
        let vectors = [("position", &self.position), ("velocity", &self.velocity)];
        let named =
            vectors.into_iter().find(|(_, value)| matches!(value, Some(VectorText::Named(_))));
        named.map_or(Ok(()), |(key, _)| {
            let message =
                format!("`{key}` is a table of components, but the space has no coordinates");
            let error = reader.source.refused(&format!("initial.{key}"), message);
            Err(error.help("give a list of numbers, or a space that is a chart"))
        })
    }

    /// The keys of an element that is given directly, and not by its parts.
    fn element(&self) -> ElementKeys {
        let Self { element, restore, coordinates, quaternion, position, .. } = self;
        ElementKeys {
            element: element.clone(),
            restore: *restore,
            coordinates: coordinates.clone(),
            quaternion: quaternion.clone(),
            position: listed(position).cloned(),
        }
    }
}

/// The list of a vector.
fn listed(vector: &Option<VectorText>) -> Option<&Vec<Number>> {
    match vector {
        Some(VectorText::List(list)) => Some(list),
        _ => None,
    }
}

/// The names of the components of a vector, with words for messages.
pub(super) struct NamedBasis<'n> {
    pub names: &'n [String],
    /// The kind of space, as in "chart".
    pub of: &'n str,
    /// The kind of names, as in "coordinate".
    pub what: &'n str,
}

impl NamedBasis<'_> {
    /// The components of a vector by name, or all of them in a list; `path` is the key of the
    /// vector.
    pub fn components(
        &self,
        path: &str,
        vector: Option<&VectorText>,
        reader: &Reader,
    ) -> Result<Vec<Option<Value>>, InputError> {
        let (mut components, Self { names, of, what }) = (vec![None; self.names.len()], self);
        let mut set = |i: usize, number: &Number| {
            components[i] = Some(reader.value(number)?);
            Ok::<_, InputError>(())
        };
        match vector {
            None => {}
            Some(VectorText::List(list)) if list.len() == names.len() => {
                list.iter().enumerate().try_for_each(|(i, number)| set(i, number))?;
            }
            Some(VectorText::List(list)) => {
                let (found, needed) = (list.len(), names.len());
                let key = path.rsplit('.').next().unwrap_or(path);
                let message =
                    format!("the {key} has {found} components, but the {of} has {needed} {what}s");
                return Err(reader.source.refused(path, message));
            }
            Some(VectorText::Named(table)) => {
                for (name, number) in &table.0 {
                    let Some(i) = names.iter().position(|own| *own == name.content) else {
                        let message = format!("`{}` is not a {what}", shown(name));
                        let error = InputError::usage(message).at(&reader.source.at(name));
                        return Err(error.help(format!("the {what}s are {}", names.join(", "))));
                    };
                    set(i, number)?;
                }
            }
        }
        Ok(components)
    }
}

/// The keys of an element of a group, or of one factor of a product in a table `[[initial.parts]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ElementKeys {
    pub element: Option<Vec<Vec<Number>>>,
    pub restore: Option<bool>,
    pub coordinates: Option<Vec<Number>>,
    pub quaternion: Option<Vec<Number>>,
    pub position: Option<Vec<Number>>,
}

/// The initial element of the group.
#[derive(Clone, Debug)]
pub(super) enum InitialElement {
    Identity,
    /// The canonical coordinates `x`; the element is `exp(x)`.
    Coordinates(Vec<Value>, Place),
    /// The rows of the matrix, and whether it is replaced by the nearest element of the group.
    Rows(Vec<Vec<Value>>, Place, bool),
    /// A quaternion `w, x, y, z`, by default 1, and the position of a body.
    Pose(Option<Vec<Value>>, Vec<Value>, Place),
    /// An element for each factor of the group.
    Parts(Vec<InitialElement>, Place),
}

impl InitialElement {
    pub fn read(keys: &InitialKeys, reader: &Reader) -> Result<Self, InputError> {
        let own = Self::of_one(&keys.element(), "initial", reader)?;
        let Some(parts) = &keys.parts else { return Ok(own) };
        if !matches!(own, Self::Identity) {
            let error = reader.source.refused("initial", "the element is given more than once");
            return Err(error.help("give the parts alone"));
        }
        let each = parts.iter().enumerate();
        let parts =
            each.map(|(at, part)| Self::of_one(part, &format!("initial.parts.{at}"), reader));
        Ok(Self::Parts(parts.collect::<Result<_, _>>()?, reader.source.key("initial.parts")))
    }

    /// Reads the element that is given directly in the table with this path.
    fn of_one(keys: &ElementKeys, path: &str, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let key = |name: &str| source.key(&format!("{path}.{name}"));
        let pose = keys.quaternion.as_ref().map(|_| "quaternion");
        let pose = pose.or(keys.position.as_ref().map(|_| "position"));
        if keys.restore == Some(true) && keys.element.is_none() {
            let error = source
                .refused(&format!("{path}.restore"), "`restore` needs a matrix, but none is given");
            return Err(error.help("give element = [[...], ...], the rows of a matrix"));
        }
        let restore = keys.restore.unwrap_or(false);
        Ok(match (&keys.element, &keys.coordinates, pose) {
            (None, None, None) => Self::Identity,
            (Some(rows), None, None) => Self::Rows(reader.rows(rows)?, key("element"), restore),
            (None, Some(x), None) => Self::Coordinates(reader.values(x)?, key("coordinates")),
            (None, None, Some(name)) => {
                let position = keys.position.as_deref().unwrap_or(&[]);
                let q = reader.optional_values(&keys.quaternion)?;
                Self::Pose(q, reader.values(position)?, key(name))
            }
            _ => {
                let error = source.refused(path, "the element is given more than once");
                let help = "give one of element, coordinates, quaternion; give a position alone or with a quaternion";
                return Err(error.help(help));
            }
        })
    }

    /// The element, for these values of the parameters.
    pub fn at(&self, group: &AnyGroup, values: &[f64]) -> Result<DVector<f64>, InputError> {
        let (matrix, place) = match self {
            Self::Identity => return Ok(group.identity()),
            Self::Coordinates(x, place) => {
                let x = Value::vector("coordinates", x, group.dimension(), values, place)?;
                return Ok(group.exp(&x.into()));
            }
            Self::Parts(parts, place) => {
                let factors = factors(group);
                if parts.len() != factors.len() {
                    let (found, needed) = (parts.len(), factors.len());
                    let message =
                        format!("the space has {needed} parts, but there are {found} elements");
                    let help = "give one table [[initial.parts]] for each part of the sum, in order; leave it empty for the identity";
                    return Err(InputError::usage(message).at(place).help(help));
                }
                let numbers = parts
                    .iter()
                    .zip(factors)
                    .map(|(part, factor)| Ok(part.at(factor, values)?.as_slice().to_vec()));
                let numbers = numbers.collect::<Result<Vec<_>, InputError>>()?;
                return Ok(DVector::from_vec(numbers.concat()));
            }
            Self::Rows(rows, place, restore) => {
                let matrix = Value::matrix("element", rows, values, place)?;
                if *restore {
                    let nearest = restored(group, &matrix).map(|(g, _)| g);
                    return nearest.map_err(|error| InputError::from(error).at(place));
                }
                let read = group.read(&matrix);
                return read.map_err(|error| {
                    let is_off = matches!(error, Error::Invalid { .. });
                    let error = InputError::from(error).at(place);
                    if is_off { error.help(ADVICE) } else { error }
                });
            }
            Self::Pose(quaternion, position, place) => {
                let refused = |message: &str| InputError::usage(message).at(place);
                let mut matrix = group.write(&group.identity());
                let (size, along) = (matrix.shape(), position.len());
                let of_rotations = group.names().first() == Some(&"qw");
                if !(of_rotations && matches!((size, along), ((3, 3), 0) | ((4, 4), 0 | 3))) {
                    return Err(refused(match quaternion {
                        Some(_) => {
                            "`quaternion` is allowed on so(3) only, and with `position` on se(3)"
                        }
                        None => {
                            "`position` must be three numbers x, y, z, and is allowed on se(3) only"
                        }
                    }));
                }
                if let Some(quaternion) = quaternion {
                    let Ok(q) = <[f64; 4]>::try_from(Value::all(quaternion, values)?) else {
                        return Err(refused("`quaternion` must be four numbers w, x, y, z"));
                    };
                    let rotation = rotation::from_wxyz(q);
                    let rotation = rotation.map_err(|error| InputError::from(error).at(place))?;
                    matrix.view_mut((0, 0), (3, 3)).copy_from(&rotation::matrix(&rotation));
                }
                for (i, value) in Value::all(position, values)?.into_iter().enumerate() {
                    matrix[(i, 3)] = value;
                }
                (matrix, place)
            }
        };
        group.read(&matrix).map_err(|error| InputError::from(error).at(place))
    }

    /// A note with the largest change, if a matrix was replaced by the nearest element.
    pub fn note(&self, group: &AnyGroup, values: &[f64]) -> Option<String> {
        let distance = self.distance(group, values)?;
        Some(format!(
            "the initial element is restored: the nearest one differs by at most {distance:.1e} in an entry"
        ))
    }

    /// The largest change of an entry if matrices are replaced by their nearest elements; `None` if
    /// no matrix is replaced.
    fn distance(&self, group: &AnyGroup, values: &[f64]) -> Option<f64> {
        match self {
            Self::Rows(rows, place, true) => {
                let matrix = Value::matrix("element", rows, values, place).ok()?;
                restored(group, &matrix).ok().map(|(_, distance)| distance)
            }
            Self::Parts(parts, _) => {
                let each = parts.iter().zip(factors(group));
                each.filter_map(|(part, factor)| part.distance(factor, values)).reduce(f64::max)
            }
            _ => None,
        }
    }
}

/// Advice for a matrix that is not an element of the group.
const ADVICE: &str =
    "set restore = true in [initial] to replace the element by the nearest element of the group";

/// The initial velocity or momentum.
#[derive(Clone, Debug)]
pub(super) struct InitialMomentum {
    is_velocity: bool,
    side: ForceFrame,
    values: Vec<Value>,
    place: Place,
}

impl InitialMomentum {
    pub fn read(keys: &InitialKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let given = [
            ("velocity", true, ForceFrame::Body, listed(&keys.velocity)),
            ("spatial_velocity", true, ForceFrame::Spatial, keys.spatial_velocity.as_ref()),
            ("momentum", false, ForceFrame::Body, keys.momentum.as_ref()),
            ("spatial_momentum", false, ForceFrame::Spatial, keys.spatial_momentum.as_ref()),
        ];
        let mut given = given
            .into_iter()
            .filter_map(|(key, is_velocity, side, list)| Some((key, is_velocity, side, list?)));
        let refused = |message: &str| {
            let help = "give one of velocity, momentum, spatial_velocity, spatial_momentum";
            Err(source.refused("initial", message).help(help))
        };
        match (given.next(), given.next()) {
            (Some((key, is_velocity, side, list)), None) => {
                let (values, place) = (reader.values(list)?, source.key(&format!("initial.{key}")));
                Ok(InitialMomentum { is_velocity, side, values, place })
            }
            (None, _) => refused("the initial velocity is missing"),
            (Some(_), Some(_)) => refused("the velocity is given more than once"),
        }
    }

    /// Whether a momentum is given, and not a velocity.
    pub fn is_momentum(&self) -> bool {
        !self.is_velocity
    }

    /// The initial momentum in the frame of the equations.
    pub fn at(
        &self,
        group: &AnyGroup,
        g: &DVector<f64>,
        observables: &Observables,
        values: &[f64],
    ) -> Result<DVector<f64>, InputError> {
        let what = if self.is_velocity { "velocity" } else { "momentum" };
        let list = Value::vector(what, &self.values, group.dimension(), values, &self.place)?;
        let vector = DVector::from_vec(list);
        let own =
            self.side == if group.is_right() { ForceFrame::Spatial } else { ForceFrame::Body };
        Ok(match (self.is_velocity, own) {
            (true, true) => observables.momentum(&vector),
            (true, false) => observables.momentum(&group.adjoint(&group.inverse(g), &vector)),
            (false, true) => vector,
            (false, false) => group.coadjoint(g, &vector),
        })
    }
}
