//! Geodesics between two points of a space.

use super::on_chart::program;
use crate::input::{InputError, Source};
use crate::space::Space;
use affinor::Geometry;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation};
use affinor::mechanics::geodesics::{ChartShooting, Geodesic, HomogeneousShooting, find};
use affinor::mechanics::systems::HomogeneousSystem;
use affinor::mechanics::systems::chart::{ChartEquations, ChartForces};
use affinor_tensors::{Notation, Scalar, Symbolic, Tolerance};
use nalgebra::{DMatrix, DVector};

/// The geodesics between two points that were found.
#[derive(Clone, Debug)]
pub struct Connecting {
    /// The name of the space.
    pub space: String,
    /// The connection, as [`Geometry::describe_connection`] writes it, and its name.
    pub connection: [String; 2],
    /// The names of the components of velocities: coordinates, or basis vectors.
    pub names: Vec<String>,
    /// The numbers of the points, as they were given.
    pub points: [Vec<f64>; 2],
    /// The measure of residuals, in words.
    pub measure: &'static str,
    /// The geodesics, by increasing length.
    pub geodesics: Vec<Geodesic>,
}

/// The geodesics from a point to another point. On a chart, a point is a list of coordinates, also
/// by name. On a group, it consists of coordinates `x` of `exp(x)`; on a homogeneous space, `x` has
/// components in the complement. An element may also be a matrix, row by row.
///
/// ```
/// use affinor_documents::problem::geodesics;
/// use affinor_documents::space::{Request, Space};
/// let name = Some("so3@levi-civita;metric=identity".into());
/// let space = Space::open(&Request { space: name, ..Request::default() })?;
/// let found = geodesics(&space, "0, 0, 0", "0, 0, pi/2", None)?;
/// let length = found.geodesics[0].length.unwrap();
/// assert!((length - std::f64::consts::FRAC_PI_2).abs() < 1e-11);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// The search ends at the first geodesic, unless a number of starts is given.
///
/// # Errors
/// An error for numbers that are not a point, for parameters without a value, and if no geodesic is
/// found.
pub fn geodesics(
    space: &Space,
    from: &str,
    to: &str,
    starts: Option<usize>,
) -> Result<Connecting, InputError> {
    if cfg!(not(feature = "curves")) {
        return Err(InputError::usage("geodesics are computed by the program only"));
    }
    let definition = &space.definition;
    let parameters = definition.parameters();
    if !parameters.is_empty() {
        let message = format!("the equations need numbers for {}", parameters.join(", "));
        return Err(InputError::usage(message).help("set them, as in --set \"m=1\""));
    }
    let texts = [("--from", from), ("--to", to)];
    if definition.is_on_chart() {
        return on_chart(space, texts, starts);
    }
    on_group(space, texts, starts)
}

/// The sources of two options.
pub(super) type Ends<'t> = [(&'static str, &'t str); 2];

/// The connection in words, and its name.
fn connection<S: Scalar + Notation>(geometry: &Geometry<S>) -> [String; 2] {
    [geometry.describe_connection(), geometry.connection_name().into()]
}

fn on_chart(space: &Space, texts: Ends, starts: Option<usize>) -> Result<Connecting, InputError> {
    let definition = &space.definition;
    let names = definition.coordinates().to_vec();
    let [from, to] = texts.map(|(option, text)| space.numbers(option, text, &names, None));
    let (from, to) = (from?, to?);
    let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
    let equations = ChartEquations::new(&geometry, ChartForces::default())?;
    let program = program(definition, &equations)?;
    let problem = ChartShooting::new(program.into(), vec![], &from, &to);
    let problem = problem.map_err(|error| at_option(error, &texts))?;
    Ok(Connecting {
        space: definition.name.clone(),
        connection: connection(&geometry),
        names,
        geodesics: find(&problem, starts)?,
        points: [from, to],
        measure: match geometry.metric() {
            Some(_) => "distance of the end from the point, by coordinates in the sizes sqrt|g_ii|",
            None => "distance of the end from the point, by coordinates",
        },
    })
}

fn on_group(space: &Space, texts: Ends, starts: Option<usize>) -> Result<Connecting, InputError> {
    let (definition, tolerance) = (space.in_floats()?, Tolerance::default());
    let geometry = definition.geometry::<f64>(tolerance)?;
    let (group, basis) = match definition.transitive_group(tolerance)? {
        Some(pair) => pair,
        None => {
            let group = definition.group(tolerance)?;
            let n = group.dimension();
            (group, DMatrix::identity(n, n))
        }
    };
    let names = definition.labels.clone();
    let [first, last] = texts.map(|(option, text)| point(space, &group, option, text));
    let (first, last) = (first?, last?);
    let complement = basis.columns(0, names.len()).into_owned();
    let element = |point: &[f64], option: &(&'static str, &str)| {
        element(&group, &complement, point).map_err(|error| {
            let (name, text) = *option;
            error.or_at(&Source::new(name, text).whole(text))
        })
    };
    let (from, to) = (element(&first, &texts[0])?, element(&last, &texts[1])?);
    let (connecting, metric) = (geometry.connection(), geometry.metric());
    let system = HomogeneousSystem::new(&group, &basis, connecting, metric, 0)?;
    // from the identity, the coordinates of the end are the logarithm
    let is_identity = first.len() == names.len() && first.iter().all(|x| *x == 0.0);
    let is_logarithm = is_identity && last.len() == names.len();
    let x = is_logarithm.then(|| &complement * DVector::from_column_slice(&last));
    let problem = HomogeneousShooting::new(system, from, to, x);
    let problem = problem.map_err(|error| at_option(error, &texts))?;
    Ok(Connecting {
        space: definition.name.clone(),
        connection: connection(&geometry),
        names,
        geodesics: find(&problem, starts)?,
        points: [first, last],
        measure: "distance of the end from the point, by entries of the matrix",
    })
}

/// The numbers of a point of a group.
pub(super) fn point(
    space: &Space,
    group: &AnyGroup,
    option: &'static str,
    text: &str,
) -> Result<Vec<f64>, InputError> {
    let (rows, columns) = group.write(&group.identity()).shape();
    let labels = space.definition.labels.clone();
    space.numbers(option, text, &labels, Some(rows * columns))
}

/// The element with these numbers: coordinates, or the rows of its matrix.
pub(super) fn element(
    group: &AnyGroup,
    complement: &DMatrix<f64>,
    numbers: &[f64],
) -> Result<DVector<f64>, InputError> {
    if numbers.len() == complement.ncols() {
        return Ok(group.exp(&(complement * DVector::from_column_slice(numbers))));
    }
    let (rows, columns) = group.write(&group.identity()).shape();
    Ok(group.read(&DMatrix::from_row_slice(rows, columns, numbers))?)
}

/// An error with the location of the option that it is about.
pub(super) fn at_option(error: affinor::Error, texts: &Ends) -> InputError {
    let of_end = matches!(error, affinor::Error::EndPoint { .. });
    let (option, text) = texts[usize::from(of_end)];
    let source = Source::new(option, text);
    InputError::from(error).or_at(&source.whole(text))
}
