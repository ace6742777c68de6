//! Bodies that are given by their parts or by their inertia. Also several bodies, and wheels.

use super::part::{Part, PartKeys, three};
use super::reader::{Reader, Value};
use super::solid::Solid;
use crate::input::{
    InputError, Place,
    forms::{Number, OneOrEach, PointText},
    shown,
};
use affinor::Metric;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation, Opposite};
use affinor::mechanics::{Inertia, MassProperties};
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, Isometry3, Matrix3, Vector3};
use serde::Deserialize;

/// The table `[inertia]`: a rigid body, or the body of one factor of a group.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaKeys {
    pub about: Option<PointText>,
    pub parts: Option<Vec<PartKeys>>,
    pub moments: Option<Vec<Number>>,
    pub matrix: Option<Vec<Vec<Number>>>,
    pub axis: Option<Vec<Number>>,
}

/// The single moving body, or one body for each factor of a group.
#[derive(Clone, Debug)]
pub(super) enum Bodies {
    One(Body),
    Each(Vec<Body>, Place),
}

/// A body whose numbers are formulas.
#[derive(Clone, Debug)]
pub(super) struct Body {
    about: Option<About>,
    content: Content,
    /// The axis of a wheel, in the frame of the first body.
    axis: Option<Vec<Value>>,
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
    /// The rows of the inertia matrix.
    Matrix(Vec<Vec<Value>>),
}

impl Bodies {
    /// Reads the bodies, and the files of their meshes.
    pub fn read(keys: &OneOrEach<InertiaKeys>, reader: &Reader) -> Result<Self, InputError> {
        let place = |path: &str| reader.source.key(path);
        match keys {
            OneOrEach::One(keys) => Ok(Bodies::One(Body::read(keys, place("inertia"), reader)?)),
            OneOrEach::Each(list) => {
                let bodies = list
                    .iter()
                    .enumerate()
                    .map(|(at, keys)| Body::read(keys, place(&format!("inertia.{at}")), reader));
                Ok(Bodies::Each(bodies.collect::<Result<_, _>>()?, place("inertia")))
            }
        }
    }

    /// The bodies with these mass properties, each with its location, then the bodies with these
    /// keys, each with its path in the file.
    #[cfg(feature = "mechanisms")]
    pub fn all<'k>(
        given: Vec<(MassProperties, Place)>,
        keys: impl Iterator<Item = (String, &'k InertiaKeys)>,
        place: Place,
        reader: &Reader,
    ) -> Result<Self, InputError> {
        let given = given.into_iter().map(|(mass, place)| Ok(Body::of_mass(mass, place)));
        let read = keys.map(|(path, keys)| Body::read(keys, reader.source.key(&path), reader));
        Ok(Bodies::Each(given.chain(read).collect::<Result<_, _>>()?, place))
    }

    fn list(&self) -> &[Body] {
        match self {
            Bodies::One(body) => std::slice::from_ref(body),
            Bodies::Each(bodies, _) => bodies,
        }
    }

    fn place(&self) -> &Place {
        match self {
            Bodies::One(body) => &body.place,
            Bodies::Each(_, place) => place,
        }
    }

    /// The mass properties of each body, for values of the parameters.
    #[cfg(feature = "mechanisms")]
    pub fn masses(&self, values: &[f64]) -> Result<Vec<MassProperties>, InputError> {
        let mass = |body: &Body| match (&body.content, &body.about) {
            (Content::Parts(parts), None) => body.joined(parts, values),
            (Content::Parts(_), Some(_)) => {
                let error = InputError::usage("the inertia of a body with joints has no `about`");
                Err(error.at(&body.place).help("leave `about` out"))
            }
            (Content::Matrix(_), _) => {
                let error = InputError::usage("the inertia of a body with joints needs a mass");
                Err(error.at(&body.place).help("give `parts`"))
            }
        };
        self.list().iter().map(mass).collect()
    }

    /// The parts of each body without the holes, for values of the parameters.
    #[cfg(feature = "mechanisms")]
    pub fn solids(&self, values: &[f64]) -> Result<Vec<Vec<Solid>>, InputError> {
        let of_body = |body: &Body| {
            let Content::Parts(parts) = &body.content else { return Ok(vec![]) };
            let parts = parts.iter().filter(|part| !part.hole).map(|part| part.solids(values));
            Ok(parts.collect::<Result<Vec<_>, InputError>>()?.concat())
        };
        self.list().iter().map(of_body).collect()
    }

    /// The metric on the group. Each body that is given by parts also defines the parameters
    /// `mass`, `centre1`, `centre2`, `centre3`. In a product, their names end in the number of the
    /// factor: `mass_2`.
    ///
    /// A wheel with the moment of inertia `I` rotates in the first body about the axis `a`, with
    /// the relative velocity `rho`. The inertia `J` of the first body includes everything except
    /// `I`. The kinetic energy is `(J(Omega, Omega) + I (a . Omega + rho)^2)/2`.
    pub fn metric(
        &self,
        group: &AnyGroup,
        labels: &[String],
        values: &[f64],
    ) -> Result<Moved<Metric<f64>>, InputError> {
        let factors = match group.downcast_ref::<Opposite<AnyGroup>>() {
            Some(_) => vec![group],
            None => group.factors(),
        };
        let (bodies, place) = (self.list(), self.place());
        if bodies.len() != factors.len() {
            let (found, needed) = (bodies.len(), factors.len());
            let message = format!("the space has {needed} parts, but there are {found} inertias");
            let help = "give one table [[inertia]] for each part of the sum, in order";
            return Err(InputError::usage(message).at(place).help(help));
        }
        let n = labels.len();
        let (mut matrix, mut names, mut solids) = (DMatrix::zeros(n, n), vec![], vec![]);
        let mut first = 0;
        for (at, (body, factor)) in bodies.iter().zip(&factors).enumerate() {
            let own = body.block(factor, values)?;
            let (block, size) = (own.metric, factor.dimension());
            matrix.view_mut((first, first), (size, size)).copy_from(&block);
            let number = if factors.len() > 1 { format!("_{}", at + 1) } else { String::new() };
            solids.extend(own.solids);
            names.extend(own.names.into_iter().map(|(name, value)| (name + &number, value)));
            if let Some(axis) = &body.axis {
                let refused = |message: &str| Err(InputError::usage(message).at(&body.place));
                if at == 0 || size != 1 || !turns(factors[0]) {
                    return refused(
                        "`axis` is allowed for a wheel on R^1 or so(2) only, with so(3) or se(3) as the first part",
                    );
                }
                let axis = three("`axis`", axis, values)?;
                // overflow: scales the axis first, so that its length may be arbitrary
                let axis = axis / axis.amax();
                let Some(axis) =
                    axis.try_normalize(0.0).filter(|a| a.iter().all(|x| x.is_finite()))
                else {
                    return refused(
                        "the axis of the wheel has no direction: its components are zero or not finite",
                    );
                };
                let moment = block[(0, 0)];
                for i in 0..3 {
                    for j in 0..3 {
                        matrix[(i, j)] += moment * axis[i] * axis[j];
                    }
                    matrix[(i, first)] = moment * axis[i];
                    matrix[(first, i)] = moment * axis[i];
                }
            }
            first += size;
        }
        let components = Tensor::from_fn(n, [Down, Down], |[i, j]| matrix[(i, j)]);
        let metric = components.map_err(affinor::Error::from);
        let metric = metric.and_then(|components| Metric::new(labels, components));
        let metric = metric.map_err(|error| InputError::from(error).at(place))?;
        Ok(Moved { metric, names, solids })
    }
}

/// Whether a group contains rotations of a body, as SO(3) and SE(3) do.
fn turns(group: &AnyGroup) -> bool {
    let is_opposite = group.downcast_ref::<Opposite<AnyGroup>>().is_some();
    group.names().first() == Some(&"qw") && !is_opposite && matches!(group.dimension(), 3 | 6)
}

impl Body {
    /// The body with these mass properties.
    #[cfg(feature = "mechanisms")]
    fn of_mass(mass: MassProperties, place: Place) -> Self {
        let part = Part::of_mass(mass, place.clone());
        Body { about: None, content: Content::Parts(vec![part]), axis: None, place }
    }

    fn read(keys: &InertiaKeys, place: Place, reader: &Reader) -> Result<Self, InputError> {
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
                let message = format!("`{}` is not a point", shown(word));
                let help = "write a point as \"centre\" or [x, y, z]";
                return Err(InputError::usage(message).at(&reader.source.at(word)).help(help));
            }
        };
        if about.is_some() && matches!(content, Content::Matrix(_)) {
            let error = InputError::usage("`about` is allowed with `parts` only").at(&place);
            return Err(
                error.help("leave `about` out: moments and matrix refer to the fixed point")
            );
        }
        let axis = reader.optional_values(&keys.axis)?;
        Ok(Body { about, content, axis, place })
    }
}

/// A kinetic energy, and the data of the bodies that formulas and pictures need.
pub(super) struct Moved<M> {
    /// The metric on the group, or the matrix for one factor.
    pub metric: M,
    /// The parameters that bodies with parts define: the mass, and the centre of mass relative to
    /// the fixed point.
    pub names: Vec<(String, f64)>,
    /// The parts of each body, in a frame at the fixed point.
    pub solids: Vec<Vec<Solid>>,
}

impl Body {
    /// The matrix of inner products of the basis of one factor, and the parameters that the body
    /// defines.
    fn block(&self, group: &AnyGroup, values: &[f64]) -> Result<Moved<DMatrix<f64>>, InputError> {
        let refused = |message: &str| Err(InputError::usage(message).at(&self.place));
        let failed = |error: affinor::Error| InputError::from(error).at(&self.place);
        let of_moments = |metric| Ok(Moved { metric, names: vec![], solids: vec![vec![]] });
        let n = group.dimension();
        if !turns(group) {
            return match &self.content {
                Content::Matrix(rows) if group.algebra()?.structure_constants().is_empty() => {
                    let matrix = Value::matrix("inertia", rows, values, &self.place)?;
                    if matrix.shape() != (n, n) {
                        return refused(&format!(
                            "the inertia must have {n} rows and {n} columns here"
                        ));
                    }
                    let is_positive = matrix.is_square() && matrix.clone().cholesky().is_some();
                    if matrix != matrix.transpose() || !is_positive {
                        return refused(
                            "masses and moments must be positive, and a matrix must be symmetric",
                        );
                    }
                    of_moments(matrix)
                }
                _ => refused(
                    "an inertia is allowed for bodies only: so(3) and se(3), left-invariant",
                ),
            };
        }
        let whole = n == 6;
        let dense = |matrix: &Matrix3<f64>| DMatrix::from_fn(3, 3, |i, j| matrix[(i, j)]);
        let parts = match &self.content {
            Content::Matrix(_) if whole => {
                return refused("an inertia on se(3) includes a mass and a centre: give `parts`");
            }
            Content::Matrix(rows) => {
                let rows = rows.iter().map(|row| three("a row of the inertia", row, values));
                let rows: Vec<Vector3<f64>> = rows.collect::<Result<_, _>>()?;
                let &[a, b, c] = rows.as_slice() else {
                    return refused(&format!(
                        "the inertia matrix has {} rows instead of 3",
                        rows.len()
                    ));
                };
                let matrix = Matrix3::from_columns(&[a, b, c]).transpose();
                let inertia = Inertia::new(&matrix).and_then(|inertia| inertia.require_physical());
                inertia.map_err(failed)?;
                return of_moments(dense(&matrix));
            }
            Content::Parts(parts) => parts,
        };
        let body = self.joined(parts, values)?;
        let point = match &self.about {
            Some(_) if whole => {
                return refused(
                    "on se(3) the inertia refers to the origin of the body: leave `about` out",
                );
            }
            Some(About::Point(point)) => three("the point", point, values)?,
            None if whole => Vector3::zeros(),
            None | Some(About::Centre) => *body.centre(),
        };
        let matrix = if whole {
            let metric = body.metric().map_err(failed)?;
            metric.components().to_dmatrix().map_err(affinor::Error::from)?
        } else {
            body.inertia_about(&point).map_err(failed)?;
            dense(&body.inertia_matrix_about(&point))
        };
        let centre = body.centre() - point;
        let mut names = vec![("mass".to_string(), body.mass())];
        names.extend((0..3).map(|i| (format!("centre{}", i + 1), centre[i])));
        let motion = Isometry3::new(-point, Vector3::zeros());
        let mut solids = vec![];
        for part in parts.iter().filter(|part| !part.hole) {
            solids.extend(part.solids(values)?.iter().map(|solid| solid.moved(&motion)));
        }
        Ok(Moved { metric: matrix, names, solids: vec![solids] })
    }

    /// Adds the mass properties of all parts, and subtracts those of the holes.
    fn joined(&self, parts: &[Part], values: &[f64]) -> Result<MassProperties, InputError> {
        let (holes, solids): (Vec<&Part>, Vec<&Part>) = parts.iter().partition(|part| part.hole);
        let mut body: Option<MassProperties> = None;
        for part in solids {
            let part = part.masses(values)?;
            body = Some(body.map_or(part, |body| body + part));
        }
        let Some(mut body) = body else {
            let error = InputError::usage("all parts of the body are holes");
            return Err(error.at(&self.place));
        };
        for hole in holes {
            let left = body.subtract(&hole.masses(values)?);
            body = left.map_err(|error| InputError::from(error).at(&hole.place))?;
        }
        Ok(body)
    }
}
