//! Curves on charts: autoparallels of a connection, geodesics, and the motion of a particle in a
//! potential or an electromagnetic field.
//!
//! The equations are exact functions of the coordinates. [`conserved`] decides which polynomials in
//! the velocity are constant along all curves, and [`compiled`] evaluates the equations in floats.

pub mod compiled;
pub mod conserved;

pub use compiled::{ChartProgram, ChartState, ChartSystem, Edge};
pub use conserved::VelocityPolynomial;

use crate::algebra::frame::formula;
use crate::geometry::forms::Form;
use crate::{Connection, Error, Geometry, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Ring, Symbolic, Tensor, Up};

/// The forces on a particle on a chart.
#[derive(Clone, Debug)]
pub struct ChartForces {
    /// The mass of the particle, by default 1.
    pub mass: Symbolic,
    /// The charge of the particle, by default 1.
    pub charge: Symbolic,
    /// The potential `V`, a function of the coordinates.
    pub potential: Option<Symbolic>,
    /// The electromagnetic field.
    pub field: Option<ElectromagneticField>,
}

/// An electromagnetic field, in the coordinate frame.
#[derive(Clone, Debug)]
pub enum ElectromagneticField {
    /// The vector potential `A_i`, slots `[Down]`. The field strength is `F = dA`.
    Potential(Tensor<Symbolic>),
    /// The field strength `F_ij`, slots `[Down, Down]`.
    Strength(Tensor<Symbolic>),
}

impl Default for ChartForces {
    fn default() -> Self {
        let one = || Symbolic::from_i64(1);
        ChartForces { mass: one(), charge: one(), potential: None, field: None }
    }
}

/// The equations `D v^i/ds = q/m F^i_j v^j - g^ij dV_j/m` of a curve with the velocity `v`, in the
/// coordinate frame. Without forces, the curves are the autoparallels of the connection.
///
/// ```
/// use affinor::geometry::{Geometry, ConnectionKind, chart::Chart};
/// use affinor::mechanics::systems::chart::{ChartEquations, ChartForces};
/// use affinor::{Metric, Symbolic};
/// // the plane in polar coordinates
/// let chart = Chart::new(["r", "phi"])?;
/// let unit = affinor::Tensor::identity(2);
/// let fields = chart.fields::<Symbolic>(chart.labels(), unit)?;
/// let metric = Metric::diagonal(["1", "r^2"].map(|value| value.parse().unwrap()))?;
/// let plane = Geometry::new("plane", fields, ConnectionKind::LeviCivita, Some(metric))?;
/// let equations = ChartEquations::new(&plane, ChartForces::default())?;
/// assert!(equations.conserves(&equations.momentum(1)?)?);
/// assert!(!equations.conserves(&equations.momentum(0)?)?);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ChartEquations {
    coordinates: Vec<String>,
    connection: Connection<Symbolic>,
    metric: Option<Metric<Symbolic>>,
    mass: Symbolic,
    charge: Symbolic,
    potential: Symbolic,
    /// The vector potential `A_i`; zero if there is none.
    vector_potential: Tensor<Symbolic>,
    /// The force per mass that is linear in the velocity: `q/m F^i_j`.
    linear: Tensor<Symbolic>,
    /// The force per mass that does not depend on the velocity: `-g^ij dV_j/m`.
    constant: Tensor<Symbolic>,
}

impl ChartEquations {
    /// The equations on a geometry whose frame consists of fields on a chart. They refer to the
    /// coordinate frame, also if the geometry has another frame.
    ///
    /// # Errors
    /// [`Error::Unsupported`] without a chart; [`Error::NoMetric`] for forces without a metric;
    /// [`Error::Shape`]; [`Error::Symmetry`] for a field strength that is not antisymmetric;
    /// [`Error::Invalid`] for the mass zero.
    pub fn new(geometry: &Geometry<Symbolic>, forces: ChartForces) -> Result<Self, Error> {
        let fields = geometry.frame_origin().fields();
        let fields = fields
            .ok_or_else(|| Error::Unsupported(format!("{} has no chart", geometry.name())))?;
        let chart = fields.chart();
        let (frame, labels) = (chart.coordinate_frame::<Symbolic>()?, chart.labels());
        let (connection, metric) = if fields.are_coordinates() {
            let gamma = geometry.connection().affinities().clone();
            (Connection::new(frame, gamma)?, geometry.metric().cloned())
        } else {
            let back = fields.change().inverted();
            let moved = geometry.connection().moved(&labels, &back)?;
            let components = geometry.metric().map(|metric| back.apply(metric.components()));
            let metric = components.transpose()?;
            let metric = metric.map(|components| Metric::new(&labels, components)).transpose()?;
            (Connection::new(frame, moved.affinities().clone())?, metric)
        };
        let n = labels.len();
        let mut equations = ChartEquations {
            coordinates: chart.coordinates().to_vec(),
            connection,
            metric,
            mass: forces.mass,
            charge: forces.charge,
            potential: forces.potential.unwrap_or_default(),
            vector_potential: Tensor::zero(n, &[Down])?,
            linear: Tensor::zero(n, &[Up, Down])?,
            constant: Tensor::zero(n, &[Up])?,
        };
        equations.apply(forces.field)?;
        Ok(equations)
    }

    /// Computes the forces per mass.
    fn apply(&mut self, field: Option<ElectromagneticField>) -> Result<(), Error> {
        if field.is_none() && self.potential == Symbolic::default() {
            return Ok(());
        }
        let metric = self.metric.as_ref().ok_or(Error::NoMetric)?;
        let no_mass = || Error::Invalid { what: "mass", reason: "the mass is zero".into() };
        let inverse_mass = self.mass.recip().ok_or_else(no_mass)?;
        let frame = self.connection.frame();
        let n = frame.dimension();
        let strength = match field {
            None => Tensor::zero(n, &[Down, Down])?,
            Some(ElectromagneticField::Potential(a)) => {
                let strength = frame.exterior_derivative(&Form::new(a.clone())?)?;
                self.vector_potential = a;
                strength.components().clone()
            }
            Some(ElectromagneticField::Strength(f)) => Form::new(f)?.components().clone(),
        };
        let scalar = Tensor::from_components(n, &[], [([], self.potential.clone())])?;
        let slope = frame.derivative(&scalar)?;
        let ratio = self.charge.clone() * &inverse_mass;
        let linear = formula("g^ik F_kj -> ^i_j", &[("g", metric.inverse()), ("F", &strength)]);
        let constant = formula("g^ij d_j -> ^i", &[("g", metric.inverse()), ("d", &slope)]);
        (self.linear, self.constant) = (linear.scale(&ratio), constant.scale(&-inverse_mass));
        Ok(())
    }

    /// The names of the coordinates.
    pub fn coordinates(&self) -> &[String] {
        &self.coordinates
    }

    /// The connection, in the coordinate frame.
    pub fn connection(&self) -> &Connection<Symbolic> {
        &self.connection
    }

    /// The metric, in the coordinate frame.
    pub fn metric(&self) -> Option<&Metric<Symbolic>> {
        self.metric.as_ref()
    }

    /// The potential.
    pub fn potential(&self) -> &Symbolic {
        &self.potential
    }

    /// The vector potential `A_i`; zero if there is none.
    pub fn vector_potential(&self) -> &Tensor<Symbolic> {
        &self.vector_potential
    }

    /// The function whose zeros are the points at which the metric degenerates: the volume density,
    /// or the determinant if its root is not a function of the coordinates. Returns `None` without
    /// a metric.
    ///
    /// # Errors
    /// [`Error::Linear`] if the determinant is not found.
    pub fn density(&self) -> Result<Option<Symbolic>, Error> {
        let Some(metric) = &self.metric else { return Ok(None) };
        let n = self.coordinates.len();
        let rows: Vec<Vec<Symbolic>> =
            (0..n).map(|i| (0..n).map(|j| metric.components().get(&[i, j])).collect()).collect();
        let determinant = Matrix::from_dense(&rows)?.determinant()?;
        Ok(Some(determinant.root_up_to_factor().unwrap_or(determinant)))
    }
}
