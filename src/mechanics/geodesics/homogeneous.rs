//! Geodesics between two points of a group or a homogeneous space.

use super::{Geodesic, ROUNDING, Shooting, TOLERANCE, spread};
use crate::Error;
use crate::group::{LieGroup, MatrixNotation};
use crate::mechanics::Adaptive;
use crate::mechanics::systems::HomogeneousSystem;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;

/// The largest product of the sizes of `g_0^-1` and `g_1` at which the product of these matrices is
/// computed: its rounding error is about `1e-16` times this number.
const LARGEST: f64 = 1e12;
/// The largest number of steps of one curve.
const STEPS: usize = 2_000;

/// A curve `g(t)` with `g(0) = g_0` whose point `g(1) H` is the coset `g_1 H`. On a group, the
/// isotropy group H is trivial.
///
/// The unknowns are the velocity `v` in the complement, and a vector `y` of the isotropy algebra
/// with `g(1) exp(y) = g_1`. The miss is the difference of the matrices of both sides.
#[derive(Clone, Debug)]
pub struct HomogeneousShooting {
    system: HomogeneousSystem,
    from: DVector<f64>,
    /// The matrix of the end, as a column.
    written: DVector<f64>,
    /// The logarithm of `g_0^-1 g_1` in the adapted basis; `None` outside the image of `exp`.
    direct: Option<DVector<f64>>,
    /// The last curve: its initial velocity, its tolerance and its end.
    last: RefCell<Option<(DVector<f64>, f64, End)>>,
}

/// The element and the velocity at the end of a curve.
type End = [DVector<f64>; 2];

impl HomogeneousShooting {
    /// The problem of two elements of G, given by their embedding coordinates. If a vector `x` of
    /// the algebra with `g_1 = g_0 exp(x)` is known, it is given, in the basis of the group.
    ///
    /// # Errors
    /// [`Error::EndPoint`] if the points are equal, or if they are so far from each other that
    /// their matrices do not determine `x`.
    pub fn new(
        system: HomogeneousSystem,
        from: DVector<f64>,
        to: DVector<f64>,
        x: Option<DVector<f64>>,
    ) -> Result<Self, Error> {
        let (n, group) = (system.dimension(), system.base());
        let written = column(&group.write(&to));
        let back = group.inverse(&from);
        let size = column(&group.write(&back)).amax() * written.amax();
        if x.is_none() && size > LARGEST {
            return Err(Error::EndPoint {
                reason: format!(
                    "is too far from the start: entries of matrices of the size {size:.0e} do not \
                     determine the way between them"
                ),
            });
        }
        let direct = x.or_else(|| group.log(&group.compose(&back, &to)).ok());
        let direct = direct.map(|x| system.adapted(&x));
        if direct.as_ref().is_some_and(|x| x.rows(0, n).amax() <= 1e-14) {
            return Err(super::equal_points());
        }
        Ok(HomogeneousShooting { system, from, written, direct, last: RefCell::default() })
    }

    /// The end of the curve with an initial velocity.
    fn end(&self, velocity: &DVector<f64>, tolerance: f64) -> Result<End, Error> {
        // a derivative by the vector of the isotropy algebra needs the same curve many times
        if let Some((own, to, end)) = &*self.last.borrow()
            && own == velocity
            && *to == tolerance
        {
            return Ok(end.clone());
        }
        let start = self.system.state(0.0, &self.from, velocity, &[]);
        let control = Adaptive::of_order_8(tolerance);
        let control = Adaptive { span: 1.0, max_steps: STEPS, ..control };
        let end = control.states(&self.system, &start, &[1.0])?.remove(0);
        let reached = self.system.velocity(&end);
        let end = [end.element, reached];
        *self.last.borrow_mut() = Some((velocity.clone(), tolerance, end.clone()));
        Ok(end)
    }
}

/// The entries of a matrix as a column.
fn column(matrix: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_column_slice(matrix.as_slice())
}

impl Shooting for HomogeneousShooting {
    type Curve = Geodesic;

    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let (n, group) = (self.system.dimension(), self.system.base());
        let [element, _] = self.end(&unknowns.rows(0, n).into(), tolerance)?;
        let turn = self.system.isotropy() * unknowns.rows(n, unknowns.len() - n);
        let reached = group.compose(&element, &group.exp(&turn));
        Ok(column(&group.write(&reached)) - &self.written)
    }

    fn geodesic(
        &self,
        unknowns: &DVector<f64>,
        miss: &DVector<f64>,
        regularity: f64,
    ) -> Result<Geodesic, Error> {
        let velocity: DVector<f64> = unknowns.rows(0, self.system.dimension()).into();
        let [_, end_velocity] = self.end(&velocity, TOLERANCE)?;
        let square = self.system.has_metric().then(|| self.system.product(&velocity, &velocity));
        let square = square.filter(|_| self.system.conserves_energy());
        Ok(Geodesic {
            velocity,
            end_velocity,
            square,
            length: square.map(|square| square.abs().sqrt()),
            residual: miss.norm(),
            regularity,
        })
    }

    fn starts(&self, count: usize) -> Vec<DVector<f64>> {
        let direct = &self.direct;
        let n = self.system.base().dimension();
        let size = direct.as_ref().map_or(1.0, |x| x.amax().max(1.0));
        // the logarithm, curves in the opposite direction, and velocities in a cube
        let around = direct.iter().flat_map(|x| [1.0, -1.0, -2.0, -4.0].map(|factor| x * factor));
        let others = (1..=count).map(|index| {
            let spread = spread(index, n) * (4.0 * size);
            direct.as_ref().map_or(spread.clone(), |x| x + spread)
        });
        around.chain(others).take(count).collect()
    }

    fn sizes(&self) -> DVector<f64> {
        DVector::from_element(self.system.base().dimension(), 1.0)
    }

    fn resolution(&self) -> f64 {
        ROUNDING * self.written.norm()
    }
}
