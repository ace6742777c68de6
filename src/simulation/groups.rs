//! The groups on which motions are simulated.

use super::drive::Drive;
use super::{Forces, Method, Simulated};
use crate::Error;
use crate::dynamics::{
    BodyState, EulerPoincare, FreeBody, Inertia, Integrator, MoserVeselov, State,
};
use crate::group::{LieGroup, MatrixGroup, Nilpotent, Se2, Se3, Sl2, So2, So3};
use nalgebra::{DMatrix, DVector};

impl Simulated for So2 {
    const NAMED: &'static [&'static str] = &["angle"];

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        vec![g.angle()]
    }
}

impl Simulated for Se2 {
    const NAMED: &'static [&'static str] = &["angle", "x", "y"];

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        vec![g.rotation.angle(), g.translation.x, g.translation.y]
    }
}

impl Simulated for Se3 {
    const NAMED: &'static [&'static str] = &["qw", "qx", "qy", "qz", "x", "y", "z"];

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        let (q, x) = (g.rotation, g.translation);
        vec![q.w, q.i, q.j, q.k, x.x, x.y, x.z]
    }
}

impl Simulated for Sl2 {}

impl Simulated for MatrixGroup {}

/// Elements are written as their canonical coordinates `x`, and `log(g exp(s e_i))` has the derivative
/// `T_left(x)^-1 e_i`.
impl Simulated for Nilpotent<f64> {
    fn generators(&self) -> Vec<DMatrix<f64>> {
        vec![]
    }

    fn slopes(&self, g: &Self::Element, _: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
        let slope = |e: &DVector<f64>| {
            // the series of a nilpotent algebra ends, and is never singular
            let slope = self.tangent_left_inverse(g, e).unwrap_or_else(|_| e * f64::NAN);
            DMatrix::from_column_slice(slope.len(), 1, slope.as_slice())
        };
        self.basis().iter().map(slope).collect()
    }
}

impl Simulated for So3 {
    const NAMED: &'static [&'static str] = &["qw", "qx", "qy", "qz"];

    fn named(&self, q: &Self::Element) -> Vec<f64> {
        vec![q.w, q.i, q.j, q.k]
    }

    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        Some(Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned()))
    }

    fn own_drive(
        &self,
        method: Method,
        system: &EulerPoincare<Self, Forces<Self>>,
        inertia: &Inertia,
        start: &State<Self>,
        step: f64,
    ) -> Option<Result<Drive<Self>, Error>> {
        let State { time, element: attitude, spatial } = *start;
        let momentum = system.momentum(start);
        match method {
            Method::Exact => {
                let body = FreeBody::new(inertia, &BodyState { attitude, momentum });
                Some(body.map(|body| {
                    Drive::Exact(Box::new(move |t: f64| State {
                        time: t,
                        element: body.at(t - time).attitude,
                        spatial,
                    }))
                }))
            }
            Method::MoserVeselov(order) => {
                let integrator = Box::new(Steps(MoserVeselov::new(inertia, order)));
                Some(Ok(Drive::Fixed { integrator, step, leg: None }))
            }
            _ => None,
        }
    }
}

/// Steps of the free body.
struct Steps(MoserVeselov);

impl Integrator<EulerPoincare<So3, Forces<So3>>> for Steps {
    fn step(
        &self,
        system: &EulerPoincare<So3, Forces<So3>>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        let body = BodyState { attitude: state.element, momentum: system.momentum(state) };
        let next = self.0.step(&body, h)?;
        *state = State { time: state.time + h, element: next.attitude, ..state.clone() };
        Ok(())
    }
}
