//! Definitions: what a person writes, read into geometries.
//!
//! A SPACE is a geometry of the paper, a catalogue name, a sum of names, a file, or brackets given
//! inline ([`Space`]). All become one [`Definition`], exact and symbolic, which is then taken into
//! the scalar of the computation. Files are TOML or JSON with the same keys.

mod chart;
mod document;
mod entry;
mod escapes;
mod file;
mod group;
mod input;
mod mesh;
mod notation;
mod numbers;
mod problem;
mod setting;
mod space;
mod written;

pub use file::{fingerprint, read_rows};
pub use group::GroupWork;
pub use input::{InputError, Place, Refusal, Source};
pub use mesh::{mesh, read_mesh};
pub use numbers::numbers;
pub use problem::{Column, Left, Problem, Ready, Walk};
pub use space::{Request, ScalarChoice, Space, Work};

use crate::algebra::Complex;
use crate::catalogue::MAX_DIMENSION;
use crate::geometry::{ConnectionKind, Geometry, Ground};
use crate::{Bracket, Canonical, Error, LieAlgebra, MatrixBasis, Metric};
use affinor_tensors::{Down, Notation, Ring, Symbolic, Tensor, Tolerance, Up};
use chart::OnChart;
use num_traits::Zero;
use std::collections::BTreeMap;

/// An algebra, or fields on a chart, with, perhaps, a connection and a metric, as written down:
/// exact, in parameters, and not yet checked.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// The name of its algebra, where that is another: so(3) for M(3).
    algebra_name: Option<String>,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    origin: Origin,
    metric: Option<MetricChoice>,
    connection: Option<(ConnectionChoice, Place)>,
    /// Parameters that were declared, whether or not a value depends on them.
    declared: Vec<String>,
    /// What it was read from; `None` for brackets on the command line.
    source: Option<Source>,
}

/// Where the structure constants come from.
#[derive(Clone, Debug)]
enum Origin {
    /// Brackets as given, by ordered pair (from 0).
    Brackets(Pairs),
    /// A matrix basis: entries (row, column, value) of each matrix.
    Matrices(usize, Vec<MatrixEntries>),
    /// Fields on a chart.
    Chart(OnChart),
}

/// Right sides by ordered pair.
type Pairs = BTreeMap<(usize, usize), Given>;

/// Two basis vectors, in order, from 0.
type Pair = (usize, usize);

type MatrixEntries = Vec<(usize, usize, Complex<Symbolic>)>;

/// The right side of a given bracket, and where it stands.
#[derive(Clone, Debug)]
struct Given {
    value: BTreeMap<usize, Symbolic>,
    place: Place,
}

/// How a metric is named.
#[derive(Clone, Debug)]
enum MetricChoice {
    Identity,
    Killing(Place),
    Components(Vec<([usize; 2], Symbolic)>, Place),
    /// The paper's product of matrices (102), computed from a matrix basis.
    Given(Tensor<Symbolic>),
}

/// How a connection is named.
#[derive(Clone, Debug)]
enum ConnectionChoice {
    Canonical(Canonical),
    Family(Symbolic),
    LeviCivita,
    Affinities(Pairs),
}

/// How values are taken into the scalar of a computation.
pub struct Reading<'r, S> {
    /// The value; `None` when the scalar cannot hold it.
    pub convert: &'r dyn Fn(&Symbolic) -> Option<S>,
    /// When a float counts as zero.
    pub tolerance: Tolerance,
}

impl<S: Notation> Reading<'_, S> {
    fn value(&self, value: &Symbolic) -> Result<S, InputError> {
        (self.convert)(value).ok_or_else(|| {
            let shown = input::shown(&value.to_string());
            InputError::usage(format!("the value {shown} has no counterpart in this scalar"))
                .help("set every parameter with --set, and keep floats within 1e308, and at 1e-307 or more unless 0")
        })
    }

    fn value_at(&self, value: &Symbolic, place: &Place) -> Result<S, InputError> {
        self.value(value).map_err(|error| error.or_at(place))
    }
}

impl Definition {
    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.labels.len()
    }

    /// The parameters that any of the values depends on, sorted.
    pub fn parameters(&self) -> Vec<String> {
        let mut names = Vec::new();
        self.each_value(&mut |value| names.extend(value.parameters()));
        let coordinates = self.coordinates();
        names.retain(|name| !coordinates.contains(name));
        names.sort();
        names.dedup();
        names
    }

    /// The coordinates, of which values may be functions; none without a chart.
    pub fn coordinates(&self) -> &[String] {
        match &self.origin {
            Origin::Chart(chart) => &chart.coordinates,
            _ => &[],
        }
    }

    /// Whether the components are functions on a chart.
    pub fn is_on_chart(&self) -> bool {
        matches!(self.origin, Origin::Chart(_))
    }

    /// Whether a metric was given.
    pub fn has_metric(&self) -> bool {
        self.metric.is_some()
    }

    /// The bracket, antisymmetric but not checked for Jacobi.
    ///
    /// # Errors
    /// The mathematics, with its witness: a bracket given twice that disagrees, `[x,x]` not zero,
    /// matrices that are dependent or do not close.
    pub fn bracket<S: Notation>(&self, reading: &Reading<S>) -> Result<Bracket<S>, InputError> {
        let bracket = match &self.origin {
            Origin::Brackets(given) => {
                self.antisymmetric(given)?;
                let mut constants = Vec::new();
                for (&(j, k), right) in given {
                    for (i, value) in &right.value {
                        constants.push((j, k, *i, reading.value_at(value, &right.place)?));
                    }
                }
                let labels = self.labels.clone().into();
                let bracket = Bracket::from_constants(labels, constants)?;
                let structure = bracket.structure().clone().with_tolerance(reading.tolerance);
                Bracket::new(bracket.labels().clone(), structure)?
            }
            Origin::Matrices(..) => {
                self.matrix_basis(reading)?.bracket().map_err(|error| self.refused(error))?
            }
            Origin::Chart(_) => return Err(InputError::usage("a chart has no table of brackets")),
        };
        Ok(bracket)
    }

    /// The Lie algebra, the Jacobi identity checked.
    ///
    /// # Errors
    /// As [`bracket`](Self::bracket), and the triple that violates Jacobi.
    pub fn algebra<S: Notation>(&self, reading: &Reading<S>) -> Result<LieAlgebra<S>, InputError> {
        LieAlgebra::try_from(self.bracket(reading)?).map_err(|error| self.refused(error))
    }

    /// What the geometry stands on: the [`algebra`](Self::algebra), or the fields on a chart.
    ///
    /// # Errors
    /// As [`algebra`](Self::algebra); fields that are dependent everywhere.
    pub fn ground<S: Notation>(&self, reading: &Reading<S>) -> Result<Ground<S>, InputError> {
        match &self.origin {
            Origin::Chart(chart) => Ok(chart.fields(&self.labels, reading)?.into()),
            _ => Ok(self.algebra(reading)?.into()),
        }
    }

    /// The metric in the frame of the geometry, if one is given.
    ///
    /// # Errors
    /// A form that is not symmetric or degenerate; the Killing form over structure functions.
    pub fn metric<S: Notation>(
        &self,
        ground: &Ground<S>,
        reading: &Reading<S>,
    ) -> Result<Option<Metric<S>>, InputError> {
        let n = self.dimension();
        let slots = [Down, Down];
        let (components, place) = match &self.metric {
            None => return Ok(None),
            Some(MetricChoice::Identity) => {
                let ones = (0..n).map(|i| ([i, i], S::one()));
                (Tensor::from_components(n, &slots, ones)?, None)
            }
            Some(MetricChoice::Killing(place)) => {
                let algebra = ground.algebra_for("a Killing form");
                let algebra = algebra.map_err(|error| InputError::from(error).at(place))?;
                (algebra.killing_form(), Some(place))
            }
            Some(MetricChoice::Components(entries, place)) => {
                let mut values = Vec::new();
                for (at, value) in entries {
                    values.push((*at, reading.value_at(value, place)?));
                }
                (Tensor::from_components(n, &slots, values)?, Some(place))
            }
            Some(MetricChoice::Given(tensor)) => {
                let mut values = Vec::new();
                for (at, value) in tensor.components() {
                    values.push((at, reading.value(value)?));
                }
                (Tensor::from_components(n, &slots, values)?, None)
            }
        };
        let components = components.with_tolerance(reading.tolerance);
        let metric = Metric::new(ground.frame().labels(), components);
        metric.map(Some).map_err(|error| InputError::from(error).or_at_some(place))
    }

    /// The geometry: ground, metric and connection. Without a connection it is levi-civita if
    /// there is a metric, else zero; over a chart a metric is asked for.
    ///
    /// # Errors
    /// As [`ground`](Self::ground) and [`metric`](Self::metric).
    pub fn geometry<S: Notation>(&self, reading: &Reading<S>) -> Result<Geometry<S>, InputError> {
        self.geometry_over(self.ground(reading)?, reading)
    }

    /// The geometry over the [`ground`](Self::ground) computed before.
    ///
    /// # Errors
    /// As [`metric`](Self::metric).
    pub fn geometry_over<S: Notation>(
        &self,
        ground: Ground<S>,
        reading: &Reading<S>,
    ) -> Result<Geometry<S>, InputError> {
        let metric = self.metric(&ground, reading)?;
        let (choice, place) = match &self.connection {
            Some((choice, place)) => (Some(choice), Some(place)),
            None => (None, None),
        };
        let kind = match choice {
            None if metric.is_some() || self.is_on_chart() => ConnectionKind::LeviCivita,
            None => ConnectionKind::Canonical(Canonical::Zero),
            Some(ConnectionChoice::Canonical(which)) => ConnectionKind::Canonical(*which),
            Some(ConnectionChoice::Family(lambda)) => {
                let value = reading.value(lambda);
                ConnectionKind::Family(value.map_err(|error| error.or_at_some(place))?)
            }
            Some(ConnectionChoice::LeviCivita) => ConnectionKind::LeviCivita,
            Some(ConnectionChoice::Affinities(given)) => {
                let mut components = Vec::new();
                for (&(j, k), right) in given {
                    for (i, value) in &right.value {
                        components.push(([*i, j, k], reading.value_at(value, &right.place)?));
                    }
                }
                let gamma =
                    Tensor::from_components(self.dimension(), &[Up, Down, Down], components)?;
                ConnectionKind::Affinities(gamma.with_tolerance(reading.tolerance))
            }
        };
        let geometry = Geometry::new(self.name.clone(), ground, kind, metric)
            .map_err(|error| InputError::from(error).or_at_some(place))?;
        Ok(match &self.algebra_name {
            Some(name) => geometry.over(name),
            None => geometry,
        })
    }

    /// Whether the connection is left to the default.
    pub fn connection_is_default(&self) -> bool {
        self.connection.is_none()
    }

    /// Gives the space a canonical connection, in the place of its own.
    pub fn set_canonical(&mut self, which: Canonical) {
        let place = Place::within(Source::new(which.name(), ""));
        self.connection = Some((ConnectionChoice::Canonical(which), place));
    }

    /// Whether the algebra is given by matrices.
    pub fn is_by_matrices(&self) -> bool {
        matches!(self.origin, Origin::Matrices(..))
    }

    /// The first pair of given brackets (from 0) that is not antisymmetric, with the components of
    /// `[x,y] + [y,x]`.
    pub fn antisymmetry_witness(&self) -> Option<((usize, usize), BTreeMap<usize, Symbolic>)> {
        let Origin::Brackets(given) = &self.origin else { return None };
        self.asymmetry(given).map(|(pair, sum, _)| (pair, sum))
    }

    /// `[x,x] = 0`, and `[y,x] = -[x,y]` where both are given.
    fn antisymmetric(&self, given: &Pairs) -> Result<(), InputError> {
        let Some(((j, k), sum, place)) = self.asymmetry(given) else { return Ok(()) };
        let written = |value: &BTreeMap<usize, Symbolic>| {
            let terms = value.iter().filter(|(_, value)| !value.vanishes());
            let named = terms.map(|(i, value)| (value, self.labels[*i].clone()));
            crate::error::combination(named)
        };
        let [x, y] = [j, k].map(|at| self.labels[at].clone());
        let error = match (given.get(&(j, k)), given.get(&(k, j))) {
            (Some(forward), Some(backward)) if j != k => {
                let values = Box::new([forward, backward].map(|given| written(&given.value)));
                Error::OrdersDisagree { x, y, values, residual: written(&sum) }
            }
            _ => Error::NotAntisymmetric { x, y, residual: written(&sum) },
        };
        Err(InputError::from(error).at(&place))
    }

    /// The first pair with `[x,y] + [y,x]` not zero, that sum, and where it stands.
    fn asymmetry(&self, given: &Pairs) -> Option<(Pair, BTreeMap<usize, Symbolic>, Place)> {
        given.iter().find_map(|(&(j, k), right)| {
            let other = given.get(&(k, j));
            if j > k || (j < k && other.is_none()) {
                return None;
            }
            let mut sum = right.value.clone();
            for (i, value) in other.iter().flat_map(|given| &given.value) {
                let entry = sum.entry(*i).or_insert_with(Symbolic::zero);
                *entry = entry.clone() + value;
            }
            sum.retain(|_, value| !value.vanishes());
            let place = other.map_or(&right.place, |other| &other.place);
            (!sum.is_empty()).then(|| ((j, k), sum, place.clone()))
        })
    }

    fn matrix_basis<S: Notation>(
        &self,
        reading: &Reading<S>,
    ) -> Result<MatrixBasis<S>, InputError> {
        let Origin::Matrices(size, matrices) = &self.origin else {
            return Err(InputError::usage("this algebra is not given by matrices"));
        };
        let mut read = Vec::new();
        for entries in matrices {
            let mut values = Vec::new();
            for (row, column, value) in entries {
                let (re, im) = (reading.value(&value.re)?, reading.value(&value.im)?);
                values.push((*row, *column, Complex { re, im }));
            }
            read.push(values);
        }
        MatrixBasis::new(self.labels.clone().into(), *size, read, reading.tolerance)
            .map_err(|error| self.refused(error))
    }

    /// What the mathematics refuses here, with its place: the first bracket that is given of those
    /// that it names, or the source.
    fn refused(&self, error: Error) -> InputError {
        let whole = self.source.clone().map(Place::within);
        let bracket = match (&error, &self.origin) {
            (Error::Jacobi { x, y, z, .. }, Origin::Brackets(given)) => {
                let index = |label: &String| self.labels.iter().position(|other| other == label);
                let pairs =
                    [(x, y), (y, z), (z, x)].into_iter().flat_map(|(x, y)| [(x, y), (y, x)]);
                let mut pairs = pairs.filter_map(|(x, y)| Some((index(x)?, index(y)?)));
                pairs.find_map(|pair| given.get(&pair)).map(|given| given.place.clone())
            }
            _ => None,
        };
        InputError::from(error).or_at_some(bracket.or(whole).as_ref())
    }

    fn each_value(&self, f: &mut dyn FnMut(&Symbolic)) {
        // one walk serves both: a walk by reference is a walk over a copy that changes nothing
        self.clone().each_value_mut(&mut |value| f(value));
    }

    fn each_value_mut(&mut self, f: &mut dyn FnMut(&mut Symbolic)) {
        let brackets = |given: &mut Pairs, f: &mut dyn FnMut(&mut Symbolic)| {
            given.values_mut().flat_map(|right| right.value.values_mut()).for_each(f);
        };
        match &mut self.origin {
            Origin::Brackets(given) => brackets(given, f),
            Origin::Matrices(_, matrices) => {
                for (_, _, value) in matrices.iter_mut().flatten() {
                    f(&mut value.re);
                    f(&mut value.im);
                }
            }
            Origin::Chart(chart) => {
                let values = chart.fields.iter_mut().flat_map(|field| field.value.values_mut());
                values.for_each(&mut *f);
            }
        }
        match &mut self.metric {
            Some(MetricChoice::Components(entries, _)) => {
                entries.iter_mut().for_each(|(_, value)| f(value));
            }
            Some(MetricChoice::Given(tensor)) => {
                let mut values: Vec<_> =
                    tensor.components().map(|(at, value)| (at, value.clone())).collect();
                values.iter_mut().for_each(|(_, value)| f(value));
                let rebuilt = Tensor::from_components(tensor.dimension(), &[Down, Down], values);
                if let Ok(rebuilt) = rebuilt {
                    *tensor = rebuilt;
                }
            }
            _ => {}
        }
        match &mut self.connection {
            Some((ConnectionChoice::Family(lambda), _)) => f(lambda),
            Some((ConnectionChoice::Affinities(given), _)) => brackets(given, f),
            _ => {}
        }
    }
}

/// Refuses a dimension of zero or beyond the engine.
fn check_dimension<N>(dimension: N) -> Result<usize, InputError>
where
    N: TryInto<usize> + std::fmt::Display + Copy,
{
    let fits = dimension.try_into().ok().filter(|n| (1..=MAX_DIMENSION).contains(n));
    fits.ok_or_else(|| {
        let message = format!("the dimension {dimension} is not between 1 and {MAX_DIMENSION}");
        InputError::usage(message)
    })
}
