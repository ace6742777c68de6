//! The groups on which motions are simulated.

use super::drive::Drive;
use super::{Body, Method, Simulated};
use crate::Error;
use crate::dynamics::euler_poincare::Free;
use crate::dynamics::integrators::kick::FreeMotion;
use crate::dynamics::integrators::projected::Projection;
use crate::dynamics::moser_veselov::Order;
use crate::dynamics::{
    BodyState, EulerPoincare, FreeBody, Inertia, Integrator, Kick, MoserVeselov, SimoWong,
    Splitting, State,
};
use crate::group::{
    Coordinates, LieGroup, MatrixGroup, Nilpotent, Opposite, Se2, Se3, Sl2, So2, So3,
};
use nalgebra::{DMatrix, DVector};

/// A matrix by its entries that are not zero: row, column and value.
fn sparse(size: usize, entries: &[(usize, usize, f64)]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(size, size);
    entries.iter().for_each(|&(row, column, value)| matrix[(row, column)] = value);
    matrix
}

/// `spin(e_i)` in the corner of a matrix.
fn spins(size: usize) -> impl Iterator<Item = DMatrix<f64>> {
    (0..3).map(move |i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        sparse(size, &[(k, j, 1.0), (j, k, -1.0)])
    })
}

impl Simulated for So2 {
    type Numbers = Projection;
    const NAMED: &'static [&'static str] = &["angle"];

    fn generators(&self) -> Vec<DMatrix<f64>> {
        vec![sparse(2, &[(1, 0, 1.0), (0, 1, -1.0)])]
    }

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        vec![g.angle()]
    }
}

impl Simulated for Se2 {
    type Numbers = Projection;
    const NAMED: &'static [&'static str] = &["angle", "x", "y"];

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let turn = sparse(3, &[(1, 0, 1.0), (0, 1, -1.0)]);
        vec![turn, sparse(3, &[(0, 2, 1.0)]), sparse(3, &[(1, 2, 1.0)])]
    }

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        vec![g.rotation.angle(), g.translation.x, g.translation.y]
    }
}

impl Simulated for Se3 {
    type Numbers = Projection;
    const NAMED: &'static [&'static str] = &["qw", "qx", "qy", "qz", "x", "y", "z"];

    fn generators(&self) -> Vec<DMatrix<f64>> {
        spins(4).chain((0..3).map(|row| sparse(4, &[(row, 3, 1.0)]))).collect()
    }

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        let (q, x) = (g.rotation, g.translation);
        vec![q.w, q.i, q.j, q.k, x.x, x.y, x.z]
    }
}

impl Simulated for Sl2 {
    type Numbers = Projection;

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let diagonal = sparse(2, &[(0, 0, 1.0), (1, 1, -1.0)]);
        vec![sparse(2, &[(0, 1, 1.0)]), sparse(2, &[(1, 0, 1.0)]), diagonal]
    }
}

impl Simulated for MatrixGroup {
    type Numbers = ();

    fn generators(&self) -> Vec<DMatrix<f64>> {
        self.matrices().to_vec()
    }
}

/// Elements are written as their canonical coordinates `x`, and `log(g exp(s e_i))` has the derivative
/// `T_left(x)^-1 e_i`.
impl Simulated for Nilpotent<f64> {
    type Numbers = ();

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
    type Numbers = Projection;
    const NAMED: &'static [&'static str] = &["qw", "qx", "qy", "qz"];

    fn generators(&self) -> Vec<DMatrix<f64>> {
        spins(3).collect()
    }

    fn named(&self, q: &Self::Element) -> Vec<f64> {
        vec![q.w, q.i, q.j, q.k]
    }

    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        Some(Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned()))
    }

    fn own_drive(
        &self,
        method: Method,
        system: &Body<Self>,
        inertia: &Inertia,
        start: &State<Self>,
        step: f64,
    ) -> Option<Result<Drive<Body<Self>>, Error>> {
        let State { time, element: attitude, spatial } = *start;
        let momentum = system.momentum(start);
        match method {
            Method::Exact => {
                let body = FreeBody::new(inertia, &BodyState { attitude, momentum });
                Some(body.map(|body| {
                    let rate = body.rate();
                    let at = move |t: f64| {
                        expect_phase(rate, t, t - time)?;
                        Ok(State { time: t, element: body.at(t - time).attitude, spatial })
                    };
                    Drive::Exact { at: Box::new(at), rate }
                }))
            }
            Method::MoserVeselov(order) => free(MoserVeselov::new(inertia, order), system, step),
            Method::Splitting(composition) => {
                free(Splitting::new(inertia, composition), system, step)
            }
            Method::SimoWong => Some(Ok(Drive::fixed(SimoWong::new(inertia), step))),
            Method::Kick(order) => {
                let motion = FreeMotion::MoserVeselov(Order::Ten);
                Some(Ok(Drive::fixed(Kick::new(inertia, order, motion), step)))
            }
            _ => None,
        }
    }
}

/// How far, in radians, the rounding of a time may turn a body.
const PHASE: f64 = 1e-3;

/// Checks that a time says where a body is that turns at a rate.
fn expect_phase(rate: f64, t: f64, elapsed: f64) -> Result<(), Error> {
    let turn = f64::EPSILON * rate * t.abs().max(elapsed.abs());
    if turn <= PHASE {
        return Ok(());
    }
    let reason =
        format!("the time is too long: its rounding alone turns the body by {turn:.1e} radians");
    Err(Error::Integration { t, reason })
}

/// Steps of the body without its forces, of which there are none.
fn free(
    integrator: impl Integrator<EulerPoincare<So3, Free>> + Send + 'static,
    system: &Body<So3>,
    step: f64,
) -> Option<Result<Drive<Body<So3>>, Error>> {
    let integrator = Unforced { system: system.clone_with(Free), integrator };
    Some(Ok(Drive::fixed(integrator, step)))
}

/// A method for the system without forces.
struct Unforced<I> {
    system: EulerPoincare<So3, Free>,
    integrator: I,
}

impl<I> Integrator<Body<So3>> for Unforced<I>
where
    I: Integrator<EulerPoincare<So3, Free>>,
{
    fn step(&self, _: &Body<So3>, state: &mut State<So3>, h: f64) -> Result<(), Error> {
        self.integrator.step(&self.system, state, h)
    }
}

/// What is said of an element stays; its derivatives along right-invariant fields are those of `exp(s e_i) g`.
impl<G: Simulated> Simulated for Opposite<G> {
    type Numbers = ();
    const RIGHT: bool = true;
    const NAMED: &'static [&'static str] = G::NAMED;

    fn named(&self, g: &Self::Element) -> Vec<f64> {
        self.0.named(g)
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        self.0.generators()
    }

    fn slopes(&self, g: &Self::Element, generators: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
        let slopes = self.0.slopes(g, generators);
        // e_i in the left frame at g is Ad_g^-1 e_i
        let column = |e: &Self::Vector| {
            let turned = self.adjoint(g, e);
            let terms = slopes.iter().zip(turned.components());
            terms.fold(&slopes[0] * 0.0, |sum, (slope, share)| sum + slope * *share)
        };
        self.basis().iter().map(column).collect()
    }
}
