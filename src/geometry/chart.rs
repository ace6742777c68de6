//! Charts: coordinates, and frames whose vectors depend on the coordinates.
//!
//! A coordinate frame has zero structure functions (A9). There the curvature (B14) takes the form
//! with partial derivatives (B12). Any other frame is the product of a coordinate frame and a
//! matrix of functions
//! ([`Frame::moved`]). Its structure functions are the brackets of its fields (A6), and affinities
//! transform by the inhomogeneous law ([`Connection::moved`](crate::Connection::moved)).

mod at_point;
mod canonical;
mod eigenvalues;
mod exponential;
mod fields;
mod invariant_fields;
mod moved;
mod series;

pub use canonical::{CanonicalCoordinates, Side};
pub use fields::Fields;

use crate::algebra::frame::{Frame, expect_slots};
use crate::algebra::{BasisChange, to_matrix};
use crate::{Error, Law};
use affinor_tensors::expression::is_name;
use affinor_tensors::text::combination;
use affinor_tensors::{Down, Notation, Scalar, Tensor, Up};
use std::sync::Arc;

/// Named coordinates. Functions of the coordinates are scalars with the coordinates as parameters;
/// [`Symbolic`](affinor_tensors::Symbolic) supports their sines, cosines and exponentials.
///
/// ```
/// use affinor::{Connection, Metric};
/// use affinor::geometry::chart::Chart;
/// use affinor::{Down, Notation, Ring, Symbolic, Tensor};
/// // the sphere of radius 1: g = d theta^2 + sin(theta)^2 d phi^2
/// let chart = Chart::new(&["theta", "phi"])?;
/// let sine = Symbolic::function("sin", &Symbolic::parameter("theta"))?;
/// let g = [([0, 0], Symbolic::from_i64(1)), ([1, 1], sine.clone() * &sine)];
/// let frame = chart.coordinate_frame::<Symbolic>()?;
/// let metric = Metric::new(frame.labels(), Tensor::from_components(2, &[Down, Down], g)?)?;
/// let connection = Connection::levi_civita(&frame, &metric)?;
/// assert_eq!(connection.affinities().get(&[0, 1, 1]).to_string(), "-sin(theta)*cos(theta)");
/// assert_eq!(connection.scalar_curvature(&metric)?, Symbolic::from_i64(2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("coordinates", "manifold"))]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chart {
    coordinates: Arc<[String]>,
}

impl Chart {
    /// The chart with these coordinates.
    ///
    /// # Errors
    /// [`Error::Name`] unless the names are distinct identifiers.
    pub fn new(coordinates: impl IntoIterator<Item: AsRef<str>>) -> Result<Self, Error> {
        let coordinates: Arc<[String]> =
            coordinates.into_iter().map(|name| name.as_ref().to_string()).collect();
        for (at, name) in coordinates.iter().enumerate() {
            if !is_name(name) || coordinates[..at].contains(name) {
                return Err(Error::coordinate(name));
            }
        }
        Ok(Chart { coordinates })
    }

    /// The names of the coordinates.
    pub fn coordinates(&self) -> &[String] {
        &self.coordinates
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.coordinates.len()
    }

    /// The names of the coordinate fields: `d_x` for `x`.
    pub fn labels(&self) -> Vec<String> {
        self.coordinates.iter().map(|name| field_of(name)).collect()
    }

    /// The frame of the coordinate fields. Its structure functions (A9) are zero, and its
    /// derivations are partial derivatives.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn coordinate_frame<S: Notation + Scalar>(&self) -> Result<Frame<S>, Error> {
        let names = self.coordinates.clone();
        Frame::holonomic(&self.labels(), Arc::new(move |k, f: &S| f.derivative(&names[k])))
    }

    /// The frame of the fields `e_i = e^a_i d/dx^a`. The components `e^a_i` have the slots
    /// `[Up, Down]`: row `a`, column `i`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Law::IndependentFields`] for fields that are linearly dependent
    /// everywhere.
    pub fn fields<S: Notation + Scalar>(
        &self,
        labels: impl IntoIterator<Item: AsRef<str>>,
        components: Tensor<S>,
    ) -> Result<Fields<S>, Error> {
        let labels: Vec<_> = labels.into_iter().collect();
        expect_slots("the fields", &components, self.dimension(), &[Up, Down])?;
        let change = BasisChange::new(components.clone()).map_err(|error| match error {
            Error::SingularBasis => {
                let kernel = to_matrix(&components).nullspace().ok();
                let relation = kernel.filter(|kernel| kernel.rows() > 0).map(|kernel| {
                    combination(
                        kernel.row(0).iter().map(|(i, v)| (v, labels[*i].as_ref().to_string())),
                    )
                });
                Law::IndependentFields.broken([relation.unwrap_or_default()], "0")
            }
            error => error,
        })?;
        let frame = self.coordinate_frame()?.moved(labels, &change)?;
        Ok(Fields::new(self.clone(), change, frame))
    }
}

/// The name of the field `d/dx` of the coordinate `x`.
pub fn field_of(coordinate: &str) -> String {
    format!("d_{coordinate}")
}
