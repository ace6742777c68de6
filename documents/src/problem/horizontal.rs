//! Curves of a left-invariant distribution: extremals of a covector, and geodesics between two points.

use super::geodesic::{at_option, element, point};
use crate::Coefficient;
use crate::input::{InputError, Source};
use crate::space::Space;
use crate::space::notation::split;
use affinor::geometry::SubRiemannian;
use affinor::group::{AnyGroup, LieGroup, MatrixNotation};
use affinor::mechanics::geodesics::sub_riemannian::{Conjugacy, ExtremalPoint};
use affinor::mechanics::geodesics::{
    HorizontalGeodesic, HorizontalShooting, SubRiemannianGroup, find,
};
use affinor_tensors::Tolerance;
use nalgebra::{DMatrix, DVector};

/// The number of covectors from which a search for the shortest geodesic begins.
const STARTS: usize = 32;

/// The question for curves of a distribution, as texts of options.
#[derive(Clone, Copy, Debug)]
pub struct HorizontalRequest<'t> {
    /// The vectors that span the distribution, such as `e1, e2 + e3`.
    pub distribution: &'t str,
    /// The start; by default, it is the identity.
    pub from: Option<&'t str>,
    /// The curve.
    pub curve: HorizontalCurve<'t>,
}

/// The kind of a curve of a distribution.
#[derive(Clone, Copy, Debug)]
pub enum HorizontalCurve<'t> {
    /// The extremal of a covector.
    Extremal {
        /// The components of the covector.
        covector: &'t str,
        /// The times, separated by commas.
        times: &'t str,
        /// Whether the extremal is abnormal.
        is_abnormal: bool,
    },
    /// Normal geodesics to another point.
    Between {
        /// The end.
        to: &'t str,
        /// The number of covectors from which the search begins. All geodesics that are found are
        /// in the answer. By default, it is the shortest one.
        starts: Option<usize>,
    },
}

/// Curves of a left-invariant distribution.
#[derive(Clone, Debug)]
pub struct Horizontal {
    /// The name of the space.
    pub space: String,
    /// The vectors that span the distribution, as they were given.
    pub distribution: Vec<String>,
    /// Whether the inner product is the restriction of a metric. Otherwise, the vectors are
    /// orthonormal.
    pub is_restricted: bool,
    /// The growth vector.
    pub growth: Vec<usize>,
    /// The names of the basis vectors.
    pub names: Vec<String>,
    /// The numbers of the start, as they were given.
    pub from: Vec<f64>,
    /// The curves.
    pub curves: HorizontalCurves,
}

/// The curves of [`Horizontal`].
#[derive(Clone, Debug)]
pub enum HorizontalCurves {
    /// A normal extremal.
    Normal {
        /// The initial covector.
        covector: Vec<f64>,
        /// The speed, which is constant.
        speed: f64,
        /// The points at the given times.
        points: Vec<WrittenPoint>,
        /// The first conjugate time up to the last time.
        conjugacy: Conjugacy,
    },
    /// An abnormal extremal with unit speed.
    Abnormal {
        /// The initial covector.
        covector: Vec<f64>,
        /// The points at the given times.
        points: Vec<WrittenPoint>,
        /// The time at which the equations leave the direction open.
        vanishes: Option<f64>,
    },
    /// Geodesics to a point.
    Geodesics {
        /// The numbers of the end, as they were given.
        to: Vec<f64>,
        /// The geodesics, by increasing length, with the first conjugate parameter of each.
        geodesics: Vec<(HorizontalGeodesic, Conjugacy)>,
    },
}

/// A point of an extremal with its matrix.
#[derive(Clone, Debug)]
pub struct WrittenPoint {
    /// The time.
    pub time: f64,
    /// The matrix of the element.
    pub matrix: DMatrix<f64>,
    /// The coordinates `x` of the element `exp(x)`; `None` if the group has no logarithm of it.
    pub coordinates: Option<DVector<f64>>,
    /// The covector in the left-invariant basis.
    pub covector: DVector<f64>,
}

impl WrittenPoint {
    fn of(group: &AnyGroup, point: ExtremalPoint) -> Self {
        WrittenPoint {
            time: point.time,
            matrix: group.write(&point.element),
            coordinates: group.log(&point.element).ok(),
            covector: point.covector,
        }
    }
}

/// The curves of a distribution on a group. The inner product is the restriction of the metric of
/// the space; without a metric, the given vectors are orthonormal.
///
/// ```
/// use affinor_documents::problem::{HorizontalCurve, HorizontalCurves, HorizontalRequest, horizontal};
/// use affinor_documents::space::{Request, Space};
/// let space = Space::open(&Request { space: Some("heisenberg(3)".into()), ..Request::default() })?;
/// let curve = HorizontalCurve::Extremal { covector: "1, 0, 1", times: "1", is_abnormal: false };
/// let request = HorizontalRequest { distribution: "x1, y1", from: None, curve };
/// let found = horizontal(&space, &request)?;
/// let HorizontalCurves::Normal { points, .. } = &found.curves else { unreachable!() };
/// assert!((points[0].matrix[(0, 1)] - 1_f64.sin()).abs() < 1e-12);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// # Errors
/// An error with its location for vectors, covectors, points and times that are invalid, for charts
/// and homogeneous spaces, and if no geodesic is found.
pub fn horizontal(space: &Space, request: &HorizontalRequest) -> Result<Horizontal, InputError> {
    let text = request.distribution;
    let source = Source::new("--distribution", text);
    let whole = source.whole(text);
    if space.definition.is_homogeneous() || space.definition.is_on_chart() {
        let message = "a distribution needs a Lie algebra, not a chart or a homogeneous space";
        return Err(InputError::usage(message).at(&whole).help("name the algebra alone"));
    }
    let (definition, tolerance) = (space.in_floats()?, Tolerance::default());
    let mut vectors = vec![];
    for vector in definition.vectors(&source)? {
        let entries = vector.iter().map(|(at, value)| Ok((*at, f64::read(value)?)));
        vectors.push(entries.collect::<Result<Vec<_>, InputError>>()?);
    }
    let algebra = definition.algebra_alone().algebra::<f64>(tolerance)?;
    let geometry = definition.geometry::<f64>(tolerance)?;
    let structure = match geometry.metric() {
        Some(metric) => SubRiemannian::restricted(&algebra, vectors, metric),
        None => SubRiemannian::orthonormal(&algebra, vectors),
    };
    let group = definition.group(tolerance)?;
    let here = |error: affinor::Error| InputError::from(error).or_at(Some(&whole));
    let structure = structure.map_err(here)?;
    let of_group = SubRiemannianGroup::new(group.clone(), &structure).map_err(here)?;
    let n = group.dimension();
    let from = match request.from {
        Some(text) => point(space, &group, "--from", text)?,
        None => vec![0.0; n],
    };
    let complement = DMatrix::identity(n, n);
    let start = at("--from", request.from, || element(&group, &complement, &from))?;
    let curves = match request.curve {
        HorizontalCurve::Between { to, starts } => {
            let numbers = point(space, &group, "--to", to)?;
            let end = at("--to", Some(to), || element(&group, &complement, &numbers))?;
            let problem = HorizontalShooting::new(of_group.clone(), start, end);
            let ends = [("--from", request.from.unwrap_or("")), ("--to", to)];
            let problem = problem.map_err(|error| at_option(error, &ends))?;
            let mut geodesics = find(&problem, Some(starts.unwrap_or(STARTS)))?;
            if starts.is_none() {
                geodesics.truncate(1);
            }
            let with_conjugacy = |geodesic| {
                let conjugacy = problem.conjugacy(&geodesic)?;
                Ok((geodesic, conjugacy))
            };
            let geodesics: Result<_, affinor::Error> =
                geodesics.into_iter().map(with_conjugacy).collect();
            HorizontalCurves::Geodesics { to: numbers, geodesics: geodesics? }
        }
        HorizontalCurve::Extremal { covector: text, times, is_abnormal } => {
            let covector = space.numbers("--covector", text, &definition.labels, None)?;
            let times = increasing(space, times)?;
            let p = DVector::from_column_slice(&covector);
            let source = Source::new("--covector", text);
            let of_covector = |error: affinor::Error| {
                let error = InputError::from(error).or_at(&source.whole(text));
                match is_abnormal {
                    true => error,
                    false => error
                        .help("give a covector with p(e) != 0 for a vector e of the distribution"),
                }
            };
            let written = |points: Vec<ExtremalPoint>| {
                points.into_iter().map(|point| WrittenPoint::of(&group, point)).collect()
            };
            match is_abnormal {
                true => {
                    let found = of_group.abnormal(&start, &p, &times).map_err(of_covector)?;
                    let (points, vanishes) = (written(found.points), found.vanishes);
                    HorizontalCurves::Abnormal { covector, points, vanishes }
                }
                false => {
                    let points = of_group.extremal(&start, &p, &times).map_err(of_covector)?;
                    let last = times.last().copied().unwrap_or(1.0);
                    HorizontalCurves::Normal {
                        covector,
                        speed: of_group.speed(&p),
                        points: written(points),
                        conjugacy: of_group.first_conjugate(&p, last)?,
                    }
                }
            }
        }
    };
    Ok(Horizontal {
        space: definition.name.clone(),
        distribution: split(text).into_iter().map(|part| part.trim().to_string()).collect(),
        is_restricted: geometry.metric().is_some(),
        growth: of_group.growth_vector().to_vec(),
        names: definition.labels.clone(),
        from,
        curves,
    })
}

/// The value of a function; an error has the location of an option.
fn at<T>(
    option: &'static str,
    text: Option<&str>,
    value: impl FnOnce() -> Result<T, InputError>,
) -> Result<T, InputError> {
    value().map_err(|error| match text {
        Some(text) => error.or_at(&Source::new(option, text).whole(text)),
        None => error,
    })
}

/// Positive times in increasing order.
fn increasing(space: &Space, text: &str) -> Result<Vec<f64>, InputError> {
    let mut times: Vec<f64> = vec![];
    for part in split(text) {
        let time = space.numbers("--time", part, &["t".into()], None)?[0];
        let before = times.last().copied().unwrap_or(0.0);
        if time <= before {
            let message = match times.is_empty() {
                true => format!("the time {time} is not positive"),
                false => format!("the time {time} is not after {before}"),
            };
            let source = Source::new("--time", text);
            let help = "give positive times in increasing order; for the opposite direction, change \
                        the sign of the covector";
            return Err(InputError::usage(message).at(&source.whole(text)).help(help));
        }
        times.push(time);
    }
    Ok(times)
}
