//! Geodesics between two points of a group or a homogeneous space.

use super::{Geodesic, ROUNDING, Shooting, TOLERANCE, spread};
use crate::Error;
use crate::group::{LieGroup, MatrixNotation};
use crate::mechanics::Adaptive;
use crate::mechanics::systems::HomogeneousSystem;
use nalgebra::{DMatrix, DVector};

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
    to: DVector<f64>,
    /// The matrix of the end, as a column.
    written: DVector<f64>,
    /// A basis of the isotropy algebra, as columns.
    isotropy: DMatrix<f64>,
}

impl HomogeneousShooting {
    /// The problem of two elements of G, given by their embedding coordinates. The columns of
    /// `basis` are the adapted basis of the system.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the points are equal.
    pub fn new(
        system: HomogeneousSystem,
        basis: &DMatrix<f64>,
        from: DVector<f64>,
        to: DVector<f64>,
    ) -> Result<Self, Error> {
        let (n, all) = (system.dimension(), system.base().dimension());
        let isotropy = basis.columns(n, all - n).into();
        let written = column(&system.base().write(&to));
        let problem = HomogeneousShooting { system, from, to, written, isotropy };
        if let Some(start) = problem.logarithm()
            && start.rows(0, n).amax() <= 1e-14
        {
            let reason = "it is the start point, so the geodesic is constant".into();
            return Err(Error::Invalid { what: "the end point", reason });
        }
        Ok(problem)
    }

    /// The components of the logarithm of `g_0^-1 g_1` in the adapted basis; `None` if there is no
    /// logarithm.
    fn logarithm(&self) -> Option<DVector<f64>> {
        let group = self.system.base();
        let relative = group.compose(&group.inverse(&self.from), &self.to);
        let x = group.log(&relative).ok()?;
        Some(self.system.adapted(&x))
    }

    /// The end of the curve with an initial velocity.
    fn end(&self, velocity: &DVector<f64>, tolerance: f64) -> Result<[DVector<f64>; 2], Error> {
        let start = self.system.state(0.0, &self.from, velocity, &[]);
        let control = Adaptive::of_order_8(tolerance);
        let control = Adaptive { span: 1.0, max_steps: STEPS, ..control };
        let end = control.states(&self.system, &start, &[1.0])?.remove(0);
        let reached = self.system.velocity(&end);
        Ok([end.element, reached])
    }
}

/// The entries of a matrix as a column.
fn column(matrix: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_column_slice(matrix.as_slice())
}

impl Shooting for HomogeneousShooting {
    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let (n, group) = (self.system.dimension(), self.system.base());
        let [element, _] = self.end(&unknowns.rows(0, n).into(), tolerance)?;
        let turn = &self.isotropy * unknowns.rows(n, unknowns.len() - n);
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
        let direct = self.logarithm();
        let n = self.system.base().dimension();
        let size = direct.as_ref().map_or(1.0, |x| x.amax().max(1.0));
        // the logarithm, curves in the opposite direction, and velocities in a cube
        let around = direct.iter().flat_map(|x| [1.0, -1.0, -2.0, -4.0].map(|factor| x * factor));
        let others = (1..=count.max(1)).map(|index| {
            let spread = spread(index, n) * (4.0 * size);
            direct.as_ref().map_or(spread.clone(), |x| x + spread)
        });
        around.chain(others).take(count.max(1)).collect()
    }

    fn sizes(&self) -> DVector<f64> {
        DVector::from_element(self.system.base().dimension(), 1.0)
    }

    fn resolution(&self) -> f64 {
        ROUNDING * self.written.norm()
    }
}
