//! Bodies by their parts: simple shapes, meshes, masses at points, holes.

use super::reader::{Reader, Value};
use crate::input::{
    InputError, Place,
    forms::{Number, PointText, Text},
    read_mesh, shown,
};
use affinor::Metric;
use affinor::group::{AnyGroup, MatrixNotation};
use affinor::mechanics::simulation::SimulationGroup;
use affinor::mechanics::{Inertia, MassProperties};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Isometry3, Matrix3, Vector3};
use serde::Deserialize;

/// The table `[inertia]`: a rigid body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct InertiaKeys {
    pub about: Option<PointText>,
    pub parts: Option<Vec<PartKeys>>,
    pub moments: Option<Vec<Number>>,
    pub matrix: Option<Vec<Vec<Number>>>,
}

/// A part of a body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartKeys {
    pub shape: Option<Text>,
    pub mesh: Option<Text>,
    pub edges: Option<Vec<Number>>,
    pub half_axes: Option<Vec<Number>>,
    pub radius: Option<Number>,
    pub height: Option<Number>,
    pub length: Option<Number>,
    pub points: Option<Vec<Vec<Number>>>,
    pub mass: Option<Number>,
    pub density: Option<Number>,
    pub position: Option<Vec<Number>>,
    pub rotation: Option<Vec<Number>>,
    #[serde(default)]
    pub hole: bool,
}

/// The shapes, with the keys of their sizes.
const SHAPES: [(&str, &[&str]); 6] = [
    ("box", &["edges"]),
    ("ball", &["radius"]),
    ("ellipsoid", &["half_axes"]),
    ("cylinder", &["radius", "height"]),
    ("rod", &["length"]),
    ("points", &["points"]),
];

/// A body whose numbers are formulas.
#[derive(Clone, Debug)]
pub(super) struct Body {
    about: Option<About>,
    content: Content,
    place: Place,
}

#[derive(Clone, Debug)]
enum About {
    Centre,
    Point(Vec<Value>),
}

#[derive(Clone, Debug)]
enum Content {
    Parts(Vec<Part>),
    /// Rows of the inertia itself.
    Matrix(Vec<Vec<Value>>),
}

#[derive(Clone, Debug)]
struct Part {
    shape: Shape,
    /// At most one of both is given; points have masses of their own.
    mass: Option<Value>,
    density: Option<Value>,
    position: Option<Vec<Value>>,
    rotation: Option<Vec<Value>>,
    hole: bool,
    place: Place,
}

#[derive(Clone, Debug)]
enum Shape {
    /// By its name and its sizes.
    Named(&'static str, Vec<Vec<Value>>),
    /// At density 1.
    Solid(MassProperties),
}

impl Body {
    /// Reads a body, and its meshes.
    pub fn read(keys: &InertiaKeys, reader: &Reader) -> Result<Self, InputError> {
        let place = reader.source.key("inertia");
        let content = match (&keys.parts, &keys.moments, &keys.matrix) {
            (Some(parts), None, None) => {
                let parts = parts.iter().map(|part| part.read(reader));
                Content::Parts(parts.collect::<Result<_, _>>()?)
            }
            (None, Some(moments), None) => {
                let moments = reader.values(moments)?;
                let zero = Value::constant(reader.source, 0.0);
                let rows = (0..moments.len()).map(|i| {
                    let mut row = vec![zero.clone(); moments.len()];
                    row[i] = moments[i].clone();
                    row
                });
                Content::Matrix(rows.collect())
            }
            (None, None, Some(rows)) => Content::Matrix(reader.rows(rows)?),
            _ => {
                let error = InputError::usage("an inertia needs exactly one of its keys");
                return Err(error.at(&place).help("give one of parts, moments, matrix"));
            }
        };
        let about = match &keys.about {
            None => None,
            Some(PointText::Numbers(point)) => Some(About::Point(reader.values(point)?)),
            Some(PointText::Word(word)) if &**word == "centre" => Some(About::Centre),
            Some(PointText::Word(word)) => {
                let message = format!("`{}` is no point", shown(word));
                let help = "a point is \"centre\" or [x, y, z]";
                return Err(InputError::usage(message).at(&reader.source.at(word)).help(help));
            }
        };
        if about.is_some() && matches!(content, Content::Matrix(_)) {
            let error = InputError::usage("a point goes with parts").at(&place);
            return Err(error.help("moments and matrix are about the point that stays"));
        }
        Ok(Body { about, content, place })
    }
}

impl PartKeys {
    fn read(&self, reader: &Reader) -> Result<Part, InputError> {
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
                    refused(format!("`{}` is no shape", shown(name)))
                        .help(format!("the shapes are {}", all.join(", ")))
                })?;
                (Shape::Named(name, sizes), *needed)
            }
            (None, Some(file)) => {
                let mesh = read_mesh(&reader.file(file)).map_err(|error| error.or_at(&place))?;
                (Shape::Solid(mesh.mass_properties()), &[][..])
            }
            _ => return Err(refused("a part has a shape or a mesh".into())),
        };
        if keys != needed {
            let sizes = if needed.is_empty() { "no sizes".into() } else { needed.join(", ") };
            return Err(refused(format!("the part has {sizes}")));
        }
        let (mass, density) = (reader.optional(&self.mass)?, reader.optional(&self.density)?);
        let given = mass.iter().chain(&density).count();
        if given != usize::from(!matches!(shape, Shape::Named("points", _))) {
            let message = "a part has a mass or a density; points have their own";
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
        if let Some(points) = &self.points {
            keys.push("points");
            sizes.extend(reader.rows(points)?);
        }
        Ok((keys, sizes))
    }
}

/// Parameters that a body adds: its mass, and its centre from the point that stays.
type Names = Vec<(String, f64)>;

impl Body {
    /// The metric on so(3) or se(3), and the parameters `mass`, `centre1`, `centre2`, `centre3`.
    pub fn metric(
        &self,
        group: &AnyGroup,
        labels: &[String],
        values: &[f64],
    ) -> Result<(Metric<f64>, Names), InputError> {
        let refused = |message: &str| Err(InputError::usage(message).at(&self.place));
        let turns = group.names().first() == Some(&"qw") && !group.is_right();
        let whole = match (turns, labels.len()) {
            (true, 3) => false,
            (true, 6) => true,
            _ => return refused("an inertia is that of bodies: so(3) and se(3), left-invariant"),
        };
        let on_rotations = |matrix: &Matrix3<f64>| {
            Metric::new(labels, Tensor::from_fn(3, [Down, Down], |[i, j]| matrix[(i, j)])?)
        };
        let parts = match &self.content {
            Content::Matrix(_) if whole => {
                return refused("on se(3) a body has a mass and a centre: give its parts");
            }
            Content::Matrix(rows) => {
                let rows = rows.iter().map(|row| three("a row of the inertia", row, values));
                let rows: Vec<Vector3<f64>> = rows.collect::<Result<_, _>>()?;
                let &[a, b, c] = rows.as_slice() else {
                    return refused(&format!("{} rows are no inertia, which has 3", rows.len()));
                };
                let matrix = Matrix3::from_columns(&[a, b, c]).transpose();
                let inertia = Inertia::new(&matrix).and_then(|inertia| inertia.require_physical());
                inertia.map_err(|error| InputError::from(error).at(&self.place))?;
                return Ok((on_rotations(&matrix)?, vec![]));
            }
            Content::Parts(parts) => parts,
        };
        let body = self.joined(parts, values)?;
        let point = match &self.about {
            Some(_) if whole => {
                return refused("on se(3) a body is about its origin: leave `about` out");
            }
            Some(About::Point(point)) => three("the point", point, values)?,
            None if whole => Vector3::zeros(),
            None | Some(About::Centre) => *body.centre(),
        };
        let metric = match whole {
            true => {
                body.metric().and_then(|metric| Metric::new(labels, metric.components().clone()))
            }
            false => body
                .inertia_about(&point)
                .and_then(|_| on_rotations(&body.inertia_matrix_about(&point))),
        };
        let metric = metric.map_err(|error| InputError::from(error).at(&self.place))?;
        let centre = body.centre() - point;
        let mut names = vec![("mass".to_string(), body.mass())];
        names.extend((0..3).map(|i| (format!("centre{}", i + 1), centre[i])));
        Ok((metric, names))
    }

    /// All parts, then without the holes.
    fn joined(&self, parts: &[Part], values: &[f64]) -> Result<MassProperties, InputError> {
        let (holes, solids): (Vec<&Part>, Vec<&Part>) = parts.iter().partition(|part| part.hole);
        let mut body: Option<MassProperties> = None;
        for part in solids {
            let part = part.masses(values)?;
            body = Some(body.map_or(part, |body| body + part));
        }
        let Some(mut body) = body else {
            let error = InputError::usage("the body has no part but holes");
            return Err(error.at(&self.place));
        };
        for hole in holes {
            let left = body.subtract(&hole.masses(values)?);
            body = left.map_err(|error| InputError::from(error).at(&hole.place))?;
        }
        Ok(body)
    }
}

impl Part {
    fn masses(&self, values: &[f64]) -> Result<MassProperties, InputError> {
        let refused = |error| InputError::from(error).at(&self.place);
        let shape = match &self.shape {
            Shape::Solid(solid) => Ok(*solid),
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
                (_, points) => {
                    let point = |point: &Vec<Value>| match point.as_slice() {
                        [mass, at @ ..] => {
                            Ok((mass.at(values)?, three("the place of a point", at, values)?))
                        }
                        [] => Err(InputError::usage("a point is [mass, x, y, z]").at(&self.place)),
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
        let vector = |what: &str, list: &Option<Vec<Value>>| match list {
            Some(list) => three(what, list, values),
            None => Ok(Vector3::zeros()),
        };
        let motion = Isometry3::new(
            vector("`position`", &self.position)?,
            vector("`rotation`", &self.rotation)?,
        );
        Ok(part.map_err(refused)?.moved(&motion))
    }
}

fn three(what: &str, list: &[Value], values: &[f64]) -> Result<Vector3<f64>, InputError> {
    if list.len() != 3 {
        let message = format!("{what} has {} components instead of 3", list.len());
        let place = list.first().map(Value::place);
        return Err(InputError::usage(message).or_at(place.as_ref()));
    }
    Ok(Vector3::from_vec(Value::all(list, values)?))
}
