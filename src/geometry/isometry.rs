//! Isometry algebras of metrics, without solving a differential equation. In reading order:
//!
//! - [`IsometryAlgebra`]: the algebra of Killing fields, or of homothetic fields;
//! - `jets`: the linear equations on a jet `(K, A)` at a point, and the bracket of jets;
//! - `conformal`: the same for conformal Killing fields;
//! - `fields`, `translations`: symmetry fields in the functions of a chart;
//! - `sample`, `point`, `power_series`, `residue`: metrics on charts around a rational point;
//! - `name`: names of the algebras that occur.
//!
//! # Method
//!
//! A Killing field `K` is determined by the jet `(K, A)` at a point, where `A^i_j = -nabla_j K^i` is
//! antisymmetric: `n(n+1)/2` numbers. Killing fields are the parallel sections of a connection on the
//! bundle of jets (B. Kostant, *Trans. Amer. Math. Soc.* 80 (1955) 528-542):
//!
//! ```text
//! nabla_j K^i = -A^i_j,    nabla_X A = R(K, X)
//! ```
//!
//! The Lie derivatives along a Killing field of the curvature and of its covariant derivatives
//! vanish. These conditions are linear equations on a jet. Let `d_s` be the dimension of the jets at a
//! point that satisfy `L_K nabla^j R = 0` for `j = 0, ..., s`, and `d_{-1} = n(n+1)/2`.
//!
//! - `d_s` is an upper bound for the dimension of the algebra of Killing fields, for every `s` and at
//!   every point.
//! - Let `d_s = d_{s-1}`, and let both be constant in a neighbourhood of the point. Then these jets
//!   form a parallel and flat subbundle: each of them belongs to a Killing field of a neighbourhood
//!   (K. Nomizu, *Ann. of Math.* 72 (1960) 105-120). The metric need not be analytic.
//! - On a homogeneous space all points are alike, so that `d_s` is constant (I. M. Singer, *Comm. Pure
//!   Appl. Math.* 13 (1960) 685-697). The answer for invariant metrics is a proof.
//!
//! On a chart the dimensions are computed at random points, where they are constant unless the point
//! is special: the set of special points has no interior.

mod conformal;
mod fields;
mod jets;
mod modular_point;
mod name;
mod point;
mod power_series;
mod residue;
mod sample;
mod translations;

use crate::Error;
use crate::algebra::frame::Frame;
use crate::algebra::structure::StructureTheory;
use crate::geometry::Geometry;
use crate::geometry::chart::Fields;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Notation, Rational, Ring, Scalar, Symbolic, Tensor};
use conformal::Prolonged;
use jets::{AtPoint, Columns, Jets};
use point::{Point, Unfit};
use residue::Residue;
pub(crate) use sample::is_positive_at_sample;
pub use sample::signature_at_sample;
use sample::{algebra, at_point, conformal_at, lift, series_at, signature};
use translations::{Translation, translations};

/// The largest number of points that are tried until all roots in the metric are rational there.
const POINTS: u64 = 20_000;
/// The number of points at which the dimension is computed, unless two of the first points agree.
const SAMPLES: usize = 5;
/// The order to which conformal Killing equations are differentiated first.
const FIRST_ORDERS: usize = 2;
/// The number of sample points at which a sign is computed.
const SIGNS: usize = 32;

/// The vector fields of a symmetry algebra.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Killing fields: `L_K g = 0`.
    Killing,
    /// Homothetic fields: `L_K g = 2 c g` with a constant `c`.
    Homothetic,
    /// Conformal Killing fields: `L_K g = 2 phi g` with a function `phi`, in dimension 3 and more.
    Conformal,
}

impl Symmetry {
    /// All symmetries.
    pub const ALL: [Symmetry; 3] = [Symmetry::Killing, Symmetry::Homothetic, Symmetry::Conformal];

    /// The name: `killing`, `homothetic` or `conformal`.
    pub fn name(self) -> &'static str {
        match self {
            Symmetry::Killing => "killing",
            Symmetry::Homothetic => "homothetic",
            Symmetry::Conformal => "conformal",
        }
    }

    /// The symmetry with this name.
    ///
    /// ```
    /// use affinor::geometry::isometry::Symmetry;
    /// assert_eq!(Symmetry::from_name("conformal"), Some(Symmetry::Conformal));
    /// ```
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|symmetry| symmetry.name() == name)
    }
}

/// The certainty of the dimension of a symmetry algebra.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// The dimension is proved.
    Proved,
    /// The dimension is a proved upper bound. It is the dimension unless the sample points are
    /// special.
    Generic,
    /// The dimension is a proved upper bound. It still decreased at the highest order that was
    /// computed.
    UpperBound,
}

/// The Lie algebra of the Killing fields, or of the homothetic fields, of a metric.
///
/// ```
/// use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
/// use affinor::{Chart, Metric, Symbolic, Tensor, Down};
/// // the hyperbolic plane: (dx^2 + dy^2)/y^2
/// let chart = Chart::new(["x", "y"])?;
/// let scale: Symbolic = "1/y^2".parse()?;
/// let g = Tensor::from_components(2, &[Down, Down], [([0, 0], scale.clone()), ([1, 1], scale)])?;
/// let fields = chart.fields(chart.labels(), Tensor::identity(2))?;
/// let metric = Metric::new(chart.labels(), g)?;
/// let algebra = IsometryAlgebra::on_chart(&fields, &metric, Symmetry::Killing)?;
/// assert_eq!((algebra.dimension(), algebra.isotropy(), algebra.orbit()), (3, 1, 2));
/// assert_eq!(algebra.name().as_deref(), Some("sl(2,R)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("Killing vectors", "isometry group", "symmetries", "homotheties"))]
#[derive(Clone, Debug)]
pub struct IsometryAlgebra {
    space: usize,
    symmetry: Symmetry,
    orbit: usize,
    dimensions: Vec<usize>,
    certainty: Certainty,
    signature: [usize; 2],
    values: Vec<(String, Rational)>,
    structure: Option<StructureTheory<Rational>>,
}

/// A symmetry algebra over the scalar of its computation.
struct Found<S> {
    columns: Columns,
    jets: Jets<S>,
    structure: Vec<(usize, usize, usize, S)>,
    is_conformal: bool,
}

impl<S: Field + Scalar> Found<S> {
    /// The symmetry algebra whose dimension is at least `least`.
    fn new(
        columns: Columns,
        least: usize,
        tensors: impl FnMut(usize) -> Result<AtPoint<S>, Error>,
    ) -> Result<Self, Error> {
        let (jets, point) = jets::solve(columns, least, tensors)?;
        // the brackets close if the dimension is stable at a point that is not special
        let structure = jets::structure(columns, &jets.space, &point);
        let jets = Jets { is_stable: jets.is_stable && structure.is_some(), ..jets };
        let structure = structure.unwrap_or_default();
        Ok(Found { columns, jets, structure, is_conformal: false })
    }

    /// The algebra of conformal Killing fields, whose dimension is at least `least`. The function
    /// `value` evaluates a scalar of the connection at the point.
    fn conformal<T: Field + Scalar>(
        connection: &Connection<T>,
        metric: &Metric<T>,
        value: impl Fn(&T) -> S,
        orders: usize,
        least: usize,
    ) -> Result<Self, Error> {
        let prolonged = Prolonged::new(connection, metric)?;
        let jets = prolonged.solve(connection, &value, orders, least)?;
        let structure = prolonged.at(&value).structure(&jets.space);
        let jets = Jets { is_stable: jets.is_stable && structure.is_some(), ..jets };
        let columns = columns_of(connection.frame().dimension(), Symmetry::Conformal);
        let structure = structure.unwrap_or_default();
        Ok(Found { columns, jets, structure, is_conformal: true })
    }

    fn dimension(&self) -> usize {
        self.jets.space.rank()
    }
}

impl IsometryAlgebra {
    /// The symmetry algebra of the metric of a geometry. An invariant metric of a group or of a
    /// homogeneous space is treated exactly; parameters get the sample values
    /// [`values`](Self::values).
    ///
    /// # Errors
    /// [`Error::NoMetric`]; those of [`on_chart`](Self::on_chart) and
    /// [`invariant`](Self::invariant).
    pub fn of(geometry: &Geometry<Symbolic>, symmetry: Symmetry) -> Result<Self, Error> {
        let metric = geometry.metric().ok_or(Error::NoMetric)?;
        let frame = geometry.frame();
        let fields = geometry.frame_origin().fields();
        let constant =
            |tensor: &Tensor<Symbolic>| Ok::<_, Error>(frame.derivative(tensor)?.is_empty());
        match fields {
            Some(fields)
                if !constant(metric.components())? || !constant(frame.structure_functions())? =>
            {
                Self::on_chart(fields, metric, symmetry)
            }
            _ => Self::with_parameters(frame, metric, symmetry),
        }
    }

    /// The symmetry algebra of an invariant metric, in the frame of a group or of a homogeneous
    /// space. The dimension is proved.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
    /// use affinor::{Metric, Rational};
    /// // the Heisenberg group: its isometry group has dimension 4
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let isometries =
    ///     IsometryAlgebra::invariant(algebra.left_frame(), &Metric::identity(3)?, Symmetry::Killing)?;
    /// assert_eq!((isometries.dimension(), isometries.isotropy()), (4, 1));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; those of [`Connection::levi_civita`].
    pub fn invariant(
        frame: &Frame<Rational>,
        metric: &Metric<Rational>,
        symmetry: Symmetry,
    ) -> Result<Self, Error> {
        let _stage = stage("isometries");
        let connection = Connection::levi_civita(frame, metric)?;
        let mut known = vec![];
        let columns = columns_of(frame.dimension(), symmetry);
        expect_conformal_dimension(columns.n, symmetry)?;
        let found = match symmetry {
            Symmetry::Conformal => {
                Found::conformal(&connection, metric, Rational::clone, conformal::MAX_ORDER, 0)?
            }
            _ => Found::new(columns, 0, |count| {
                jets::derivatives(&connection, metric, &mut known, count)?;
                Ok(AtPoint { metric: metric.clone(), derivatives: known.clone() })
            })?,
        };
        let certainty = match found.jets.is_stable {
            true => Certainty::Proved,
            false => Certainty::UpperBound,
        };
        let constants = found.structure.iter().cloned();
        let algebra = algebra(found.dimension(), constants.collect())?;
        let structure = found.jets.is_stable.then(|| StructureTheory::new(algebra));
        Ok(Self::assembled(&found, symmetry, certainty, signature(metric.components()), structure))
    }

    /// The symmetry algebra of an invariant metric with parameters, at sample values.
    fn with_parameters(
        frame: &Frame<Symbolic>,
        metric: &Metric<Symbolic>,
        symmetry: Symmetry,
    ) -> Result<Self, Error> {
        let (mut best, mut reason): (Option<Self>, _) = (None, String::new());
        let mut samples = 0;
        for seed in 1..POINTS {
            let mut point = Point::new(seed);
            let values = |tensor: &Tensor<Symbolic>, point: &mut Point| at_point(tensor, point);
            let parts = (|| {
                let structure = values(frame.structure_functions(), &mut point)?;
                let isotropy = frame.isotropy().map_err(|error| Unfit::Never(error.to_string()))?;
                let isotropy = values(&isotropy, &mut point)?;
                Ok((structure, isotropy, values(metric.components(), &mut point)?))
            })();
            let (structure, isotropy, components) = match parts {
                Ok(parts) => parts,
                Err(Unfit::Retry(text)) => {
                    reason = text;
                    continue;
                }
                Err(Unfit::Never(text)) => return Err(unsupported(&text)),
            };
            let Ok(sampled) = Metric::new(frame.labels(), components) else { continue };
            let frame = Frame::reductive(frame.labels(), structure, isotropy)?;
            let found = Self::invariant(&frame, &sampled, symmetry)?;
            let values = point.values();
            let exact = point.is_exact();
            let certainty = match found.certainty {
                Certainty::Proved if !exact => Certainty::Generic,
                certainty => certainty,
            };
            let found = IsometryAlgebra { values, certainty, ..found };
            samples += 1;
            let agrees = best.as_ref().is_some_and(|best| best.dimension() == found.dimension());
            if best.as_ref().is_none_or(|best| found.dimension() < best.dimension()) {
                best = Some(found);
            }
            if exact || agrees || samples == SAMPLES {
                break;
            }
        }
        best.ok_or_else(|| unsupported(&reason))
    }

    /// The symmetry algebra of a metric in a frame of fields on a chart. Parameters and free
    /// functions get sample values: the answer holds for generic ones.
    ///
    /// The dimension is computed at two random points, or more if they differ. If every field is
    /// a translation of a coordinate on which the metric does not depend, the dimension is proved.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Unsupported`] if a root in the metric is
    /// irrational at all points that were tried.
    pub fn on_chart(
        fields: &Fields<Symbolic>,
        metric: &Metric<Symbolic>,
        symmetry: Symmetry,
    ) -> Result<Self, Error> {
        Ok(Self::search(fields, metric, symmetry, false)?.0)
    }

    /// The symmetry algebra as in [`on_chart`](Self::on_chart), and its fields as far as their
    /// components are found in the functions of the chart. The components refer to the coordinate
    /// frame, slot `^i`. Each field satisfies its equation identically, and the fields are linearly
    /// independent. They are a basis if they are as many as the [`dimension`](Self::dimension).
    ///
    /// ```
    /// use affinor::geometry::isometry::{IsometryAlgebra, Symmetry};
    /// use affinor::{Chart, Down, Metric, Symbolic, Tensor};
    /// // the hyperbolic plane: (dx^2 + dy^2)/y^2
    /// let chart = Chart::new(["x", "y"])?;
    /// let scale: Symbolic = "1/y^2".parse()?;
    /// let g = Tensor::from_components(2, &[Down, Down], [([0, 0], scale.clone()), ([1, 1], scale)])?;
    /// let frame = chart.fields(chart.labels(), Tensor::identity(2))?;
    /// let metric = Metric::new(chart.labels(), g)?;
    /// let (algebra, fields) =
    ///     IsometryAlgebra::with_fields(&frame, &metric, Symmetry::Killing)?;
    /// assert_eq!((algebra.dimension(), fields.len()), (3, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`on_chart`](Self::on_chart).
    #[doc(alias("Killing vectors"))]
    pub fn with_fields(
        fields: &Fields<Symbolic>,
        metric: &Metric<Symbolic>,
        symmetry: Symmetry,
    ) -> Result<(Self, Vec<Tensor<Symbolic>>), Error> {
        let (algebra, translations) = Self::search(fields, metric, symmetry, true)?;
        let components = fields.change().inverted().apply(metric.components())?;
        let metric = Metric::new(fields.chart().labels(), components)?;
        let (coordinates, dimension) = (fields.chart().coordinates(), algebra.dimension());
        let found = fields::find(coordinates, &metric, symmetry, dimension, &translations)?;
        Ok((algebra, found))
    }

    /// The symmetry algebra on a chart, and the translations in it if they are needed.
    fn search(
        fields: &Fields<Symbolic>,
        metric: &Metric<Symbolic>,
        symmetry: Symmetry,
        with_translations: bool,
    ) -> Result<(Self, Vec<Translation>), Error> {
        let _stage = stage("isometries");
        let components = match fields.are_coordinates() {
            true => metric.components().clone(),
            false => fields.change().inverted().apply(metric.components())?,
        };
        let coordinates = fields.chart().coordinates();
        let ignorable = |name: &&String| {
            let mut values = components.components().map(|(_, value)| value);
            values.all(|value| Notation::derivative(value, name).vanishes())
        };
        let least = coordinates.iter().filter(ignorable).count();
        let columns = columns_of(coordinates.len(), symmetry);
        expect_conformal_dimension(columns.n, symmetry)?;
        let mut found: Vec<(Found<Residue>, Point, [usize; 2])> = vec![];
        let (mut reason, mut failures) = (String::new(), 0);
        for seed in 1..POINTS {
            let mut point = Point::new(seed);
            let values = match at_point(&components, &mut point) {
                Ok(values) => values,
                Err(Unfit::Retry(text)) => {
                    reason = text;
                    continue;
                }
                Err(Unfit::Never(text)) => return Err(unsupported(&text)),
            };
            let signature = signature(&values);
            if signature.iter().sum::<usize>() < coordinates.len() {
                continue;
            }
            let next = match symmetry {
                Symmetry::Conformal => conformal_at(fields, &components, &mut point, least),
                _ => Found::new(columns, least, |count| {
                    series_at(fields, &components, &mut point, count)
                }),
            };
            let next = match next {
                Ok(next) => next,
                // a pole of the inverse metric, which the values do not show
                Err(_) if failures < SAMPLES => {
                    failures += 1;
                    continue;
                }
                Err(error) => return Err(error),
            };
            let agrees = found.iter().any(|(other, ..)| other.dimension() == next.dimension());
            let is_least = next.jets.is_stable && next.dimension() == least;
            found.push((next, point, signature));
            if agrees || is_least || found.len() == SAMPLES {
                break;
            }
        }
        let dimension = found.iter().map(|(found, ..)| found.dimension()).min();
        let dimension = dimension.ok_or_else(|| unsupported(&reason))?;
        found.retain(|(found, ..)| found.dimension() == dimension);
        let lifted = found.iter().position(|(found, ..)| lift(&found.structure).is_some());
        let (found, mut point, signature) = found.swap_remove(lifted.unwrap_or(0));
        let translations = match with_translations {
            true => translations(&found, fields, &components, &mut point)?,
            false => vec![],
        };
        let certainty = match found.jets.is_stable {
            true if dimension == least => Certainty::Proved,
            true => Certainty::Generic,
            false => Certainty::UpperBound,
        };
        let constants = lift(&found.structure).filter(|_| found.jets.is_stable);
        let algebra = constants.map(|constants| algebra(dimension, constants)).transpose()?;
        let structure = algebra.map(StructureTheory::new);
        let isometries = Self::assembled(&found, symmetry, certainty, signature, structure);
        Ok((IsometryAlgebra { values: point.values(), ..isometries }, translations))
    }

    fn assembled<S: Field + Scalar>(
        found: &Found<S>,
        symmetry: Symmetry,
        certainty: Certainty,
        signature: [usize; 2],
        structure: Option<StructureTheory<Rational>>,
    ) -> Self {
        IsometryAlgebra {
            space: found.columns.n,
            symmetry,
            orbit: jets::orbit(found.columns, &found.jets.space),
            dimensions: found.jets.dimensions.clone(),
            certainty,
            signature,
            values: vec![],
            structure,
        }
    }

    /// The kind of the vector fields.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// The dimension of the algebra.
    pub fn dimension(&self) -> usize {
        self.dimensions.last().copied().unwrap_or_default()
    }

    /// The dimension of the space.
    pub fn space(&self) -> usize {
        self.space
    }

    /// The dimension of the isotropy algebra at a generic point: the fields that vanish there.
    pub fn isotropy(&self) -> usize {
        self.dimension() - self.orbit
    }

    /// The dimension of the orbit of a generic point.
    pub fn orbit(&self) -> usize {
        self.orbit
    }

    /// Whether the fields span the tangent space at a generic point: the space is locally
    /// homogeneous under their flows.
    pub fn is_transitive(&self) -> bool {
        self.orbit == self.space
    }

    /// The dimension of all jets, then of those that satisfy the equations of `R`, `nabla R`, ...,
    /// each with the equations before.
    pub fn dimensions(&self) -> &[usize] {
        &self.dimensions
    }

    /// The certainty of the dimension.
    pub fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// The signature of the metric at the point: the numbers of positive and of negative squares.
    pub fn signature(&self) -> [usize; 2] {
        self.signature
    }

    /// The sample values of coordinates, parameters and free functions, by name.
    pub fn values(&self) -> &[(String, Rational)] {
        &self.values
    }

    /// The algebra over the rational numbers, with the bracket of vector fields. The basis depends
    /// on the point; the first vectors span the orbit, and the last [`isotropy`](Self::isotropy) ones
    /// vanish at the point. `None` if the dimension is not stable, or if the structure constants at
    /// the point are too long.
    pub fn structure(&self) -> Option<&StructureTheory<Rational>> {
        self.structure.as_ref()
    }

    /// The name of the algebra; `None` for an algebra that is not named.
    pub fn name(&self) -> Option<String> {
        name::name(self.structure()?)
    }

    /// The Levi factor and the radical, for an algebra without a name.
    pub fn description(&self) -> Option<String> {
        name::description(self.structure()?)
    }
}

fn columns_of(n: usize, symmetry: Symmetry) -> Columns {
    Columns { n, homothetic: symmetry == Symmetry::Homothetic }
}

/// Checks that the conformal Killing fields have a finite dimension.
fn expect_conformal_dimension(n: usize, symmetry: Symmetry) -> Result<(), Error> {
    if symmetry == Symmetry::Conformal && n < 3 {
        return Err(Error::Unsupported(format!(
            "in dimension {n}, the conformal Killing fields have infinite dimension; they have \
             finite dimension from 3 on"
        )));
    }
    Ok(())
}

fn unsupported(reason: &str) -> Error {
    let reason = if reason.is_empty() { "the metric is degenerate" } else { reason };
    Error::Unsupported(format!("no rational sample point was found: {reason}"))
}
