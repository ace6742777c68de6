//! Definitions: exact symbolic descriptions of spaces, converted to the scalar of a computation.

use super::chart::OnChart;
use super::functions::Functions;
use super::homogeneous::CosetSpace;
use crate::Coefficient;
use crate::input::{InputError, Place, Source, shown};
use affinor::algebra::Complex;
use affinor::algebra::catalogue::MAX_DIMENSION;
#[cfg(feature = "mechanisms")]
use affinor::algebra::structure::Subspace;
#[cfg(feature = "mechanisms")]
use affinor::geometry::complement_projector;
use affinor::geometry::{ConnectionKind, FrameOrigin, Geometry};
use affinor::{Bracket, CanonicalConnection, Error, Law, LieAlgebra, MatrixBasis, Metric};
#[cfg(feature = "mechanisms")]
use affinor_tensors::linear::Row;
use affinor_tensors::{Down, Ring, Symbolic, Tensor, Tolerance, Up};
use num_traits::Zero;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The definition of a space: an algebra, vector fields on a chart or a homogeneous space, and
/// optionally a connection and a metric.
///
/// The values are exact and may depend on parameters. They are checked when they are converted to a
/// scalar type.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// The name of the algebra, if it differs from the name of the space, as so(3) for M(3).
    pub(super) algebra_name: Option<String>,
    /// The names of the basis vectors.
    pub labels: Vec<String>,
    pub(super) origin: Origin,
    pub(super) metric: Option<MetricChoice>,
    pub(super) connection: Option<(ConnectionChoice, Place)>,
    /// The declared parameters, including those on which no value depends.
    pub(super) declared: Vec<String>,
    /// Notes on conventions that the file does not specify, and on their interpretation.
    pub(super) notes: Vec<String>,
    /// The source of the file; `None` for brackets on the command line.
    pub(super) source: Option<Source>,
}

/// How the brackets of a definition are given.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    /// Brackets, by ordered pairs of basis vectors, which count from 0.
    Brackets(Pairs),
    /// A basis of matrices: the size of the matrices, and the entries (row, column, value) of each.
    Matrices(usize, Vec<MatrixEntries>),
    /// Vector fields on a chart.
    Chart(OnChart),
    /// The complement of the isotropy algebra of a homogeneous space.
    Homogeneous(Box<CosetSpace>),
}

/// Brackets: the right-hand side for each ordered pair of basis vectors.
pub(super) type Pairs = BTreeMap<(usize, usize), Given>;

/// The indices of two basis vectors in order, from 0.
pub(super) type Pair = (usize, usize);

pub(super) type MatrixEntries = Vec<(usize, usize, Complex<Symbolic>)>;

/// The right-hand side of a bracket, and its location.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub(super) value: BTreeMap<usize, Symbolic>,
    pub(super) place: Place,
}

/// The metric of a definition.
#[derive(Clone, Debug)]
pub(super) enum MetricChoice {
    Identity,
    Killing(Place),
    /// The general invariant metric, with a letter for each parameter.
    Invariant(Place),
    /// Factors of the isotropy summands of a homogeneous space.
    Summands(Vec<Symbolic>, Place),
    Components(Vec<([usize; 2], Symbolic)>, Option<Place>),
}

/// The connection of a definition.
#[derive(Clone, Debug)]
pub(super) enum ConnectionChoice {
    Canonical(CanonicalConnection),
    Family(Symbolic),
    LeviCivita,
    Affinities(Pairs),
    /// The nonholonomic connection of the distribution that is spanned by these vectors.
    #[cfg(feature = "mechanisms")]
    Nonholonomic(Vec<BTreeMap<usize, Symbolic>>),
}

/// The components with indices `[i, j, k]`: for each pair `j, k`, the components `v^i` of the
/// right-hand side.
pub(super) fn components<S: Coefficient>(
    pairs: &Pairs,
) -> Result<Vec<([usize; 3], S)>, InputError> {
    let each = pairs.iter().flat_map(|(&(j, k), Given { value, place })| {
        value.iter().map(move |(&i, value)| {
            Ok(([i, j, k], S::read(value).map_err(|error| error.or_at(place))?))
        })
    });
    each.collect()
}

impl Definition {
    /// A definition of an algebra without a metric, a connection and parameters.
    pub(super) fn new(name: impl Into<String>, labels: Vec<String>, origin: Origin) -> Self {
        Definition {
            name: name.into(),
            algebra_name: None,
            labels,
            origin,
            metric: None,
            connection: None,
            declared: vec![],
            notes: vec![],
            source: None,
        }
    }

    /// The definition without its metric and its connection.
    #[must_use]
    pub fn algebra_alone(&self) -> Self {
        Definition { metric: None, connection: None, ..self.clone() }
    }

    /// Notes on the interpretation of conventions that the file does not specify, such as the order
    /// of the basis.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.labels.len()
    }

    /// Whether the definition is an entry of the catalogue or a sum of entries. Only such
    /// definitions may occur in a sum.
    pub fn is_of_catalogue(&self) -> bool {
        self.source.is_none() && self.algebra_name.is_none() && !self.is_homogeneous()
    }

    /// The parameters on which values depend, sorted.
    pub fn parameters(&self) -> Vec<String> {
        let mut names = Vec::new();
        self.each_value(&mut |value| names.extend(value.parameters()));
        let coordinates = self.coordinates();
        names.retain(|name| !coordinates.contains(name));
        names.sort();
        names.dedup();
        names
    }

    /// All known names: the parameters on which values depend, other declared parameters, and the
    /// coordinates.
    pub fn known_parameters(&self) -> Vec<String> {
        let mut names = self.parameters();
        names.extend(self.declared.iter().chain(self.coordinates()).cloned());
        names.sort();
        names.dedup();
        names
    }

    /// Whether all values are rational numbers, and not functions on a chart.
    pub fn is_rational(&self) -> bool {
        let mut rational = !self.is_on_chart();
        self.each_value(&mut |value| rational &= value.as_constant().is_some());
        rational
    }

    /// The coordinates of the chart; empty without a chart.
    pub fn coordinates(&self) -> &[String] {
        self.functions().map_or(&[], |functions| &functions.coordinates)
    }

    /// The functions on the chart.
    pub(super) fn functions(&self) -> Option<&Functions> {
        match &self.origin {
            Origin::Chart(chart) => Some(&chart.functions),
            _ => None,
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

    /// The bracket. It is antisymmetric, but the Jacobi identity is not checked.
    ///
    /// # Errors
    /// A mathematical error with its witness: if `[y,x]` differs from `-[x,y]`, if `[x,x]` is not
    /// zero, or if matrices are linearly dependent or not closed under commutators.
    pub fn bracket<S: Coefficient>(&self, tolerance: Tolerance) -> Result<Bracket<S>, InputError> {
        let bracket = match &self.origin {
            Origin::Brackets(given) => {
                self.antisymmetric(given)?;
                let constants = components(given)?;
                let constants = constants.into_iter().map(|([i, j, k], value)| (j, k, i, value));
                Bracket::from_constants(&self.labels, constants)?.with_tolerance(tolerance)
            }
            Origin::Matrices(..) => {
                self.matrix_basis(tolerance)?.bracket().map_err(|error| self.refused(error))?
            }
            Origin::Chart(_) => {
                return Err(InputError::usage("a table of brackets is not possible on a chart"));
            }
            Origin::Homogeneous(coset) => {
                let message = format!("{} is a homogeneous space, not a Lie algebra", self.name);
                let help = format!("name the algebra of the group: {}", coset.algebra);
                return Err(InputError::usage(message).help(help));
            }
        };
        Ok(bracket)
    }

    /// The Lie algebra, after a check of the Jacobi identity.
    ///
    /// # Errors
    /// Those of [`bracket`](Self::bracket), and an error with the triple that violates the Jacobi
    /// identity.
    pub fn algebra<S: Coefficient>(
        &self,
        tolerance: Tolerance,
    ) -> Result<LieAlgebra<S>, InputError> {
        LieAlgebra::try_from(self.bracket(tolerance)?).map_err(|error| self.refused(error))
    }

    /// The [`algebra`](Self::algebra), the vector fields on a chart, or the homogeneous space.
    ///
    /// # Errors
    /// Those of [`algebra`](Self::algebra), and an error for fields that are dependent everywhere.
    pub fn ground<S: Coefficient>(
        &self,
        tolerance: Tolerance,
    ) -> Result<FrameOrigin<S>, InputError> {
        match &self.origin {
            Origin::Chart(chart) => Ok(chart.fields(&self.labels)?.into()),
            Origin::Homogeneous(coset) => {
                Ok(coset.space(&self.name, &self.labels, tolerance)?.into())
            }
            Origin::Brackets(_) | Origin::Matrices(..) => Ok(self.algebra(tolerance)?.into()),
        }
    }

    /// The metric in the frame of the geometry, if a metric is given.
    ///
    /// # Errors
    /// An error for a metric that is degenerate, not symmetric, or not invariant on a homogeneous
    /// space, and for the Killing form if the structure functions are not constant.
    pub fn metric<S: Coefficient>(
        &self,
        ground: &FrameOrigin<S>,
        tolerance: Tolerance,
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
            Some(MetricChoice::Invariant(place) | MetricChoice::Summands(_, place)) => {
                // `set_metric` replaces these choices by components
                return Err(InputError::usage("this metric has no components").at(place));
            }
            Some(MetricChoice::Components(entries, place)) => {
                let mut values = Vec::new();
                for (at, value) in entries {
                    let value = S::read(value);
                    values.push((*at, value.map_err(|error| error.or_at(place.as_ref()))?));
                }
                (Tensor::from_components(n, &slots, values)?, place.as_ref())
            }
        };
        let components = components.with_tolerance(tolerance);
        let metric = Metric::new(ground.frame().labels(), components).and_then(|metric| {
            ground.expect_metric(&metric)?;
            Ok(Some(metric))
        });
        metric.map_err(|error| InputError::from(error).or_at(place))
    }

    /// The geometry. Its default connection is levi-civita if there is a metric, otherwise zero. On
    /// a chart, the default is always levi-civita, which needs a metric.
    ///
    /// # Errors
    /// Those of [`ground`](Self::ground) and [`metric`](Self::metric).
    pub fn geometry<S: Coefficient>(
        &self,
        tolerance: Tolerance,
    ) -> Result<Geometry<S>, InputError> {
        self.geometry_over(self.ground(tolerance)?, tolerance)
    }

    /// The geometry of an algebra, or of vector fields, that is already computed by
    /// [`ground`](Self::ground).
    ///
    /// # Errors
    /// Those of [`metric`](Self::metric).
    pub fn geometry_over<S: Coefficient>(
        &self,
        ground: FrameOrigin<S>,
        tolerance: Tolerance,
    ) -> Result<Geometry<S>, InputError> {
        let metric = self.metric(&ground, tolerance)?;
        let (choice, place) =
            self.connection.as_ref().map(|(choice, place)| (choice, place)).unzip();
        let kind = match choice {
            None if metric.is_some() || self.is_on_chart() => ConnectionKind::LeviCivita,
            None => ConnectionKind::Canonical(CanonicalConnection::Zero),
            Some(ConnectionChoice::Canonical(which)) => ConnectionKind::Canonical(*which),
            Some(ConnectionChoice::Family(lambda)) => {
                let value = S::read(lambda);
                ConnectionKind::Family(value.map_err(|error| error.or_at(place))?)
            }
            Some(ConnectionChoice::LeviCivita) => ConnectionKind::LeviCivita,
            Some(ConnectionChoice::Affinities(given)) => {
                let slots = [Up, Down, Down];
                let gamma = Tensor::from_components(self.dimension(), &slots, components(given)?)?;
                ConnectionKind::Affinities(gamma.with_tolerance(tolerance))
            }
            #[cfg(feature = "mechanisms")]
            Some(ConnectionChoice::Nonholonomic(vectors)) => {
                let metric = metric.as_ref().ok_or_else(|| self.without_metric().or_at(place))?;
                let projector = self.projector(vectors, metric);
                ConnectionKind::Nonholonomic(projector.map_err(|error| error.or_at(place))?)
            }
        };
        let geometry = Geometry::new(self.name.clone(), ground, kind, metric)
            .map_err(|error| InputError::from(error).or_at(place))?;
        Ok(match &self.algebra_name {
            Some(name) => geometry.over(name),
            None => geometry,
        })
    }

    /// Parses linear combinations of basis vectors, separated by commas, with letters as parameters.
    #[cfg(any(feature = "mechanisms", feature = "curves"))]
    pub(crate) fn vectors(
        &self,
        source: &Source,
    ) -> Result<Vec<BTreeMap<usize, Symbolic>>, InputError> {
        let labels = self.labels.iter().cloned().zip(0..).collect();
        super::notation::Names::open(&labels, self.functions()).vectors(source.content(), source)
    }

    /// The projector onto the orthogonal complement of the span of some vectors.
    #[cfg(feature = "mechanisms")]
    fn projector<S: Coefficient>(
        &self,
        vectors: &[BTreeMap<usize, Symbolic>],
        metric: &Metric<S>,
    ) -> Result<Tensor<S>, InputError> {
        let row = |vector: &BTreeMap<usize, Symbolic>| {
            vector.iter().map(|(at, value)| Ok((*at, S::read(value)?))).collect()
        };
        let rows: Vec<Row<S>> = vectors.iter().map(row).collect::<Result<_, InputError>>()?;
        let subspace = Subspace::span(self.dimension(), rows);
        if subspace.dimension() < vectors.len() {
            let message = format!(
                "the {} vectors of the distribution are linearly dependent: they span dimension {}",
                vectors.len(),
                subspace.dimension()
            );
            return Err(InputError::mathematics(message).help("leave dependent vectors out"));
        }
        Ok(complement_projector(metric, &subspace)?)
    }

    /// Whether the definition has no connection of its own, so that the default is used.
    pub fn connection_is_default(&self) -> bool {
        self.connection.is_none()
    }

    /// The error for a metric that is missing. On a homogeneous space, the advice names an invariant
    /// metric.
    pub(crate) fn without_metric(&self) -> InputError {
        let error = InputError::from(affinor::Error::NoMetric);
        match self.is_homogeneous() {
            true => error.help("give a metric, for instance --metric \"summands(1)\""),
            false => error,
        }
    }

    /// A note on the default connection; `None` if the definition names a connection, and on a chart
    /// without a metric.
    pub fn default_connection_note(&self) -> Option<String> {
        if !self.connection_is_default() {
            return None;
        }
        if self.has_metric() {
            let missing = "no connection given";
            return Some(format!("{missing}: using levi-civita, the connection of the metric"));
        }
        let default = if self.is_homogeneous() { "natural" } else { "zero" };
        let text = format!("no connection and no metric given: using the connection {default}");
        (!self.is_on_chart()).then_some(text)
    }

    /// Replaces the connection by a canonical connection.
    pub fn set_canonical(&mut self, which: CanonicalConnection) {
        let place = Place::within(Source::new(which.name(), ""));
        self.connection = Some((ConnectionChoice::Canonical(which), place));
    }

    /// Whether the algebra is given by matrices.
    pub fn is_by_matrices(&self) -> bool {
        matches!(self.origin, Origin::Matrices(..))
    }

    /// Finds the first pair of given brackets that is not antisymmetric. Returns its indices, from
    /// 0, and the components of `[x,y] + [y,x]`.
    pub fn antisymmetry_witness(&self) -> Option<((usize, usize), BTreeMap<usize, Symbolic>)> {
        let Origin::Brackets(given) = &self.origin else { return None };
        self.asymmetry(given).map(|(pair, sum, _)| (pair, sum))
    }

    /// Checks that `[x,x] = 0`, and that `[y,x] = -[x,y]` if both brackets are given.
    pub(super) fn antisymmetric(&self, given: &Pairs) -> Result<(), InputError> {
        let Some(((j, k), sum, place)) = self.asymmetry(given) else { return Ok(()) };
        let written = |value: &BTreeMap<usize, Symbolic>| {
            let terms = value.iter().filter(|(_, value)| !value.vanishes());
            let named = terms.map(|(i, value)| (value, self.labels[*i].clone()));
            affinor_tensors::text::combination(named)
        };
        let pair = [j, k].map(|at| self.labels[at].clone());
        let (law, at) = match (given.get(&(j, k)), given.get(&(k, j))) {
            (Some(forward), Some(backward)) if j != k => {
                let values = [forward, backward].map(|given| written(&given.value));
                (Law::OppositeOrders, [pair, values].concat())
            }
            _ => (Law::Antisymmetry, pair.into()),
        };
        Err(InputError::from(law.broken(at, written(&sum))).at(&place))
    }

    /// Finds the first pair for which `[x,y] + [y,x]` is not zero. Returns the pair, the sum, and
    /// the location.
    pub(super) fn asymmetry(
        &self,
        given: &Pairs,
    ) -> Option<(Pair, BTreeMap<usize, Symbolic>, Place)> {
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

    /// Adds a note on the order of a basis that the file does not name.
    pub(super) fn note_basis(&mut self) {
        const SHOWN: usize = 12;
        let first = self.labels.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>();
        let more = if self.labels.len() > SHOWN { ", ..." } else { "" };
        self.notes.push(format!("the basis is taken as {}{more}", first.join(", ")));
    }

    pub(super) fn matrix_basis<S: Coefficient>(
        &self,
        tolerance: Tolerance,
    ) -> Result<MatrixBasis<S>, InputError> {
        let Origin::Matrices(size, matrices) = &self.origin else {
            return Err(InputError::usage("this algebra is not given by matrices"));
        };
        let entry = |(row, column, value): &(usize, usize, Complex<Symbolic>)| {
            let (re, im) = (S::read(&value.re)?, S::read(&value.im)?);
            Ok((*row, *column, Complex { re, im }))
        };
        let read = matrices.iter().map(|entries| entries.iter().map(entry).collect());
        let read = read.collect::<Result<Vec<Vec<_>>, InputError>>()?;
        MatrixBasis::new(&self.labels, *size, read, tolerance).map_err(|error| self.refused(error))
    }

    /// Converts a mathematical error. Its location is the first given bracket that the error names;
    /// without such a bracket, the whole source.
    pub(crate) fn refused(&self, error: Error) -> InputError {
        let whole = self.source.clone().map(Place::within);
        let names = if let Error::Broken { at, .. } = &error { at.as_slice() } else { &[] };
        let pairs = names.iter().zip(names.iter().cycle().skip(1));
        let bracket = match &self.origin {
            Origin::Brackets(given) => {
                let index = |label: &String| self.labels.iter().position(|other| other == label);
                let pairs = pairs.flat_map(|(x, y)| [(x, y), (y, x)]);
                let mut pairs = pairs.filter_map(|(x, y)| Some((index(x)?, index(y)?)));
                pairs.find_map(|pair| given.get(&pair)).map(|given| given.place.clone())
            }
            _ => None,
        };
        InputError::from(error).or_at(bracket.or(whole).as_ref())
    }

    pub(super) fn each_value(&self, f: &mut dyn FnMut(&Symbolic)) {
        // visits a copy, so that one function serves both for reading and for changing values
        self.clone().each_value_mut(&mut |value| f(value));
    }

    pub(super) fn each_value_mut(&mut self, f: &mut dyn FnMut(&mut Symbolic)) {
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
            Origin::Homogeneous(coset) => coset.values_mut().for_each(&mut *f),
        }
        if let Some(MetricChoice::Components(entries, _)) = &mut self.metric {
            entries.iter_mut().for_each(|(_, value)| f(value));
        }
        match &mut self.connection {
            Some((ConnectionChoice::Family(lambda), _)) => f(lambda),
            Some((ConnectionChoice::Affinities(given), _)) => brackets(given, f),
            #[cfg(feature = "mechanisms")]
            Some((ConnectionChoice::Nonholonomic(vectors), _)) => {
                vectors.iter_mut().flat_map(BTreeMap::values_mut).for_each(f);
            }
            _ => {}
        }
    }
}

/// Returns an error for a dimension of zero or above [`MAX_DIMENSION`].
pub(super) fn check_dimension<N>(dimension: N) -> Result<usize, InputError>
where
    N: TryInto<usize> + std::fmt::Display + Copy,
{
    let fits = dimension.try_into().ok().filter(|n| (1..=MAX_DIMENSION).contains(n));
    fits.ok_or_else(|| {
        let message = format!("the dimension {dimension} is not between 1 and {MAX_DIMENSION}");
        InputError::usage(message)
    })
}

/// Adds a bracket. A pair that is given twice must have the same value both times.
pub(super) fn add(all: &mut Pairs, pair: (usize, usize), given: Given) -> Result<(), InputError> {
    match all.entry(pair) {
        Entry::Vacant(free) => drop(free.insert(given)),
        Entry::Occupied(other) if other.get().value == given.value => {}
        Entry::Occupied(other) => {
            let error = InputError::usage("this pair is given a second, different value");
            let error = error.at(&given.place);
            return Err(match other.get().place.text() {
                Some(first) => error.help(format!("the first is `{}`", shown(first))),
                None => error,
            });
        }
    }
    Ok(())
}
