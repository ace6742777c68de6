//! The exact invariant fields of a Lie algebra in canonical coordinates.

use super::canonical::invariant_forms;
use super::exponential::closed_form;
use super::{CanonicalCoordinates, Chart, Fields, Side};
use crate::Error;
use crate::algebra::{LieAlgebra, inverse};
use affinor_tensors::{Down, Symbolic, Tensor, Up};

impl Chart {
    /// The invariant fields that equal the basis of the algebra at the identity of a group with
    /// this algebra. They are dual to the forms `g^-1 dg` (left) or `dg g^-1` (right), which are
    ///
    /// ```text
    /// first kind    T_left(x) dx, T_right(x) dx      T_left(x) = sum (-ad_x)^k/(k+1)!
    /// second kind   exp(-x^n ad_n) .. exp(-x^{a+1} ad_{a+1}) e_a dx^a,
    ///               exp(x^1 ad_1) .. exp(x^{a-1} ad_{a-1}) e_a dx^a
    /// ```
    ///
    /// S. Helgason, *Differential Geometry, Lie Groups, and Symmetric Spaces* (1978), II.1. The
    /// closed form exists if the eigenvalues `a + ib` of `ad_x` (for the second kind, of each
    /// `x^m ad_m`) are linear forms of the coordinates with small integer coefficients. Other
    /// eigenvalues, such as `i|x|` of so(3), have no closed form; then
    /// [`Frame::canonical_at_point`](crate::Frame::canonical_at_point) computes the fields in
    /// floats. At removable singularities, such as `(exp(x) - 1)/x` at 0, the fields are the limits
    /// of the formulas.
    ///
    /// ```
    /// use affinor::geometry::chart::{CanonicalCoordinates, Chart, Side};
    /// use affinor::{Bracket, LieAlgebra};
    /// use affinor::{Ring, Symbolic};
    /// // the rotations and translations of a plane
    /// let plane = Bracket::from_fn(&["turn", "right", "up"], |j, k| match (j, k) {
    ///     (0, 1) => vec![(2, Symbolic::from_i64(1))],
    ///     (0, 2) => vec![(1, Symbolic::from_i64(-1))],
    ///     _ => vec![],
    /// })?;
    /// let plane = LieAlgebra::try_from(plane)?;
    /// let chart = Chart::new(&["t", "x", "y"])?;
    /// let fields = chart.invariant_fields(&plane, CanonicalCoordinates::Second, Side::Right)?;
    /// assert_eq!(fields.written()[1], "cos(t)*d_x - sin(t)*d_y");
    /// let fields = chart.invariant_fields(&plane, CanonicalCoordinates::First, Side::Right)?;
    /// assert_eq!(fields.frame().structure_functions().get(&[2, 0, 1]), Symbolic::from_i64(-1));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::Eigenvalues`](crate::Law::Eigenvalues) for eigenvalues of another form;
    /// [`Error::Size`] for too many eigenvalues; [`Error::Shape`]; [`Error::Name`] for a coordinate
    /// that is also a parameter of the algebra.
    pub fn invariant_fields(
        &self,
        algebra: &LieAlgebra<Symbolic>,
        kind: CanonicalCoordinates,
        side: Side,
    ) -> Result<Fields<Symbolic>, Error> {
        let (names, labels) = (self.coordinates(), algebra.labels());
        let used =
            algebra.structure_constants().components().flat_map(|(_, value)| value.parameters());
        if let Some(name) = used.into_iter().find(|name| names.contains(name)) {
            return Err(Error::coordinate(&name));
        }
        let x: Vec<Symbolic> = names.iter().map(|x| Symbolic::parameter(x)).collect();
        let forms =
            invariant_forms(algebra.structure_constants(), &x, kind, side, |function, ad, at| {
                closed_form(function, side, ad, &names[at.clone()], &labels[at])
            })?;
        let fields = inverse(&forms).ok_or(Error::SingularBasis)?;
        let fields = Tensor::from_components(self.dimension(), &[Up, Down], fields)?;
        self.fields(labels, fields)
    }
}
