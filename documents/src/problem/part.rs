//! Parts of bodies: simple shapes, meshes, point masses, and bodies that are given by their inertia.

use super::reader::{Reader, Value};
use super::solid::Solid;
use crate::input::{
    InputError, Place,
    forms::{Number, Text},
    read_mesh, shown,
};
use affinor::mechanics::MassProperties;
use nalgebra::{Isometry3, Matrix3, Vector3};
use serde::Deserialize;

/// A part of a body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PartKeys {
    pub shape: Option<Text>,
    pub mesh: Option<Text>,
    pub edges: Option<Vec<Number>>,
    pub half_axes: Option<Vec<Number>>,
    pub radius: Option<Number>,
    pub height: Option<Number>,
    pub length: Option<Number>,
    pub points: Option<Vec<Vec<Number>>>,
    /// The inertia about the centre of mass, in place of a size.
    pub matrix: Option<Vec<Vec<Number>>>,
    pub mass: Option<Number>,
    pub density: Option<Number>,
    pub position: Option<Vec<Number>>,
    pub rotation: Option<Vec<Number>>,
    #[serde(default)]
    pub hole: bool,
}

/// The radius with which a point mass is drawn, relative to the distance of the farthest point
/// mass.
const POINT: f64 = 0.08;

/// The names of the shapes, with the keys of their sizes.
const SHAPES: [(&str, &[&str]); 7] = [
    ("box", &["edges"]),
    ("ball", &["radius"]),
    ("ellipsoid", &["half_axes"]),
    ("cylinder", &["radius", "height"]),
    ("rod", &["length"]),
    ("points", &["points"]),
    ("inertia", &["matrix"]),
];

/// A part of a body, whose numbers are formulas.
#[derive(Clone, Debug)]
pub(super) struct Part {
    shape: Shape,
    /// The mass or the density, if one is given; a list of points contains the masses itself.
    mass: Option<Value>,
    density: Option<Value>,
    position: Option<Vec<Value>>,
    rotation: Option<Vec<Value>>,
    /// Whether the part is subtracted.
    pub hole: bool,
    pub place: Place,
}

#[derive(Clone, Debug)]
enum Shape {
    /// A shape with its name and its sizes.
    Named(&'static str, Vec<Vec<Value>>),
    /// A mesh: its mass properties at density 1, and its surface.
    Mesh(MassProperties, Solid),
    /// The mass properties of a link of a robot.
    #[cfg_attr(not(feature = "mechanisms"), expect(dead_code, reason = "robots are mechanisms"))]
    Link(MassProperties),
}

impl PartKeys {
    pub(super) fn read(&self, reader: &Reader) -> Result<Part, InputError> {
        let name = self.shape.as_ref().or(self.mesh.as_ref());
        let place = name.map(|name| reader.source.at(name));
        let place = place.unwrap_or_else(|| reader.source.key("inertia.parts"));
        let refused = |message: String| InputError::usage(message).at(&place);
        let (keys, sizes) = self.sizes(reader)?;
        let (shape, needed) = match (&self.shape, &self.mesh) {
            (Some(name), None) => {
                let found = SHAPES.iter().find(|(shape, _)| *shape == &**name);
                let (name, needed) = found.ok_or_else(|| {
                    let all = SHAPES.map(|(name, keys)| format!("{name} ({})", keys.join(", ")));
                    refused(format!("`{}` is not a known shape", shown(name)))
                        .help(format!("the shapes are {}", all.join(", ")))
                })?;
                (Shape::Named(name, sizes), *needed)
            }
            (None, Some(file)) => {
                let mesh = read_mesh(&reader.file(file)).map_err(|error| error.or_at(&place))?;
                let surface = Solid {
                    corners: mesh.vertices().to_vec(),
                    faces: mesh.triangles().iter().map(|triangle| triangle.to_vec()).collect(),
                };
                (Shape::Mesh(mesh.mass_properties(), surface), &[][..])
            }
            _ => return Err(refused("a part needs either a shape or a mesh".into())),
        };
        if keys != needed {
            let sizes = if needed.is_empty() { "no sizes".into() } else { needed.join(", ") };
            return Err(refused(format!("the given sizes do not fit the shape: give {sizes}")));
        }
        let (mass, density) = (reader.optional(&self.mass)?, reader.optional(&self.density)?);
        let given = mass.iter().chain(&density).count();
        if given != usize::from(!matches!(shape, Shape::Named("points", _))) {
            let message = "a part needs either a mass or a density, except `points`, whose list contains the masses";
            return Err(refused(message.into()));
        }
        let position = reader.optional_values(&self.position)?;
        let rotation = reader.optional_values(&self.rotation)?;
        Ok(Part { shape, mass, density, position, rotation, hole: self.hole, place })
    }

    /// The keys of the sizes that are given, and their values.
    fn sizes(&self, reader: &Reader) -> Result<(Vec<&str>, Vec<Vec<Value>>), InputError> {
        let (mut keys, mut sizes) = (vec![], vec![]);
        for (key, list) in [("edges", &self.edges), ("half_axes", &self.half_axes)] {
            if let Some(list) = list {
                keys.push(key);
                sizes.push(reader.values(list)?);
            }
        }
        let one = [("radius", &self.radius), ("height", &self.height), ("length", &self.length)];
        for (key, number) in one {
            if let Some(number) = number {
                keys.push(key);
                sizes.push(vec![reader.value(number)?]);
            }
        }
        for (key, rows) in [("points", &self.points), ("matrix", &self.matrix)] {
            if let Some(rows) = rows {
                keys.push(key);
                sizes.extend(reader.rows(rows)?);
            }
        }
        Ok((keys, sizes))
    }
}

impl Part {
    /// The part with these mass properties in the frame of the body.
    #[cfg(feature = "mechanisms")]
    pub fn of_mass(mass: MassProperties, place: Place) -> Self {
        Part {
            shape: Shape::Link(mass),
            mass: None,
            density: None,
            position: None,
            rotation: None,
            hole: false,
            place,
        }
    }

    /// The mass properties, in the frame of the body.
    pub fn masses(&self, values: &[f64]) -> Result<MassProperties, InputError> {
        let refused = |error| InputError::from(error).at(&self.place);
        let shape = match &self.shape {
            Shape::Mesh(solid, _) | Shape::Link(solid) => Ok(*solid),
            Shape::Named(name, sizes) => match (*name, sizes.as_slice()) {
                ("box", [edges]) => MassProperties::cuboid(&three("a box", edges, values)?),
                ("ellipsoid", [axes]) => {
                    MassProperties::ellipsoid(&three("an ellipsoid", axes, values)?)
                }
                ("ball", [radius]) => MassProperties::ball(radius[0].at(values)?),
                ("cylinder", [radius, height]) => {
                    MassProperties::cylinder(radius[0].at(values)?, height[0].at(values)?)
                }
                ("rod", [length]) => MassProperties::rod(length[0].at(values)?),
                ("inertia", rows) => {
                    let rows = rows.iter().map(|row| three("a row of the matrix", row, values));
                    let rows: Vec<Vector3<f64>> = rows.collect::<Result<_, _>>()?;
                    let (&[a, b, c], Some(mass)) = (rows.as_slice(), &self.mass) else {
                        let error = InputError::usage("an inertia has three rows and a mass");
                        return Err(error.at(&self.place));
                    };
                    let matrix = Matrix3::from_columns(&[a, b, c]).transpose();
                    MassProperties::new(mass.at(values)?, Vector3::zeros(), &matrix)
                }
                (_, points) => {
                    let point =
                        |point: &Vec<Value>| match point.as_slice() {
                            [mass, at @ ..] => {
                                Ok((mass.at(values)?, three("the place of a point", at, values)?))
                            }
                            [] => Err(InputError::usage("write a point as [mass, x, y, z]")
                                .at(&self.place)),
                        };
                    let points = points.iter().map(point).collect::<Result<Vec<_>, _>>()?;
                    MassProperties::points(&points)
                }
            },
        };
        let shape = shape.map_err(refused)?;
        let part = match (&self.mass, &self.density) {
            (Some(mass), _) => shape.of_mass(mass.at(values)?),
            (None, Some(density)) => shape.of_density(density.at(values)?),
            (None, None) => Ok(shape),
        };
        Ok(part.map_err(refused)?.moved(&self.pose(values)?))
    }

    /// The rigid motion from the frame of the shape to the frame of the body.
    fn pose(&self, values: &[f64]) -> Result<Isometry3<f64>, InputError> {
        let vector = |what: &str, list: &Option<Vec<Value>>| match list {
            Some(list) => three(what, list, values),
            None => Ok(Vector3::zeros()),
        };
        let position = vector("`position`", &self.position)?;
        Ok(Isometry3::new(position, vector("`rotation`", &self.rotation)?))
    }

    /// The surface of the part, in the frame of the body.
    pub fn solids(&self, values: &[f64]) -> Result<Vec<Solid>, InputError> {
        let shapes = match &self.shape {
            Shape::Mesh(_, surface) => vec![surface.clone()],
            // these have no shape
            Shape::Link(_) | Shape::Named("inertia", _) => {
                return Ok(vec![Solid::of_inertia(&self.masses(values)?)]);
            }
            Shape::Named(name, sizes) => match (*name, sizes.as_slice()) {
                ("box", [edges]) => vec![Solid::cuboid(&three("a box", edges, values)?)],
                ("ellipsoid", [axes]) => {
                    vec![Solid::ellipsoid(&three("an ellipsoid", axes, values)?)]
                }
                ("ball", [radius]) => {
                    vec![Solid::ellipsoid(&Vector3::repeat(radius[0].at(values)?))]
                }
                ("cylinder", [radius, height]) => {
                    vec![Solid::cylinder(radius[0].at(values)?, height[0].at(values)?)]
                }
                ("rod", [length]) => vec![Solid::rod(length[0].at(values)?)],
                (_, points) => {
                    let places = points.iter().filter_map(|point| point.get(1..));
                    let places = places.map(|at| three("the place of a point", at, values));
                    let places = places.collect::<Result<Vec<_>, _>>()?;
                    let far = places.iter().map(|x| x.norm()).fold(0.0, f64::max);
                    let radius = POINT * if far > 0.0 { far } else { 1.0 };
                    let ball = Solid::ellipsoid(&Vector3::repeat(radius));
                    places
                        .iter()
                        .map(|x| ball.moved(&Isometry3::new(*x, Vector3::zeros())))
                        .collect()
                }
            },
        };
        let pose = self.pose(values)?;
        Ok(shapes.iter().map(|solid| solid.moved(&pose)).collect())
    }
}

/// The vector of three formulas, which messages call `what`.
pub(super) fn three(
    what: &str,
    list: &[Value],
    values: &[f64],
) -> Result<Vector3<f64>, InputError> {
    if list.len() != 3 {
        let message = format!("{what} has {} components instead of 3", list.len());
        let place = list.first().map(Value::place);
        return Err(InputError::usage(message).or_at(place.as_ref()));
    }
    Ok(Vector3::from_vec(Value::all(list, values)?))
}
