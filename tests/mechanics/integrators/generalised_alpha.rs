//! The generalized-alpha method: its damping of high frequencies, and how exactly a step solves its equations.

use affinor::group::{LieGroup, Translations};
use affinor::mechanics::systems::euler_poincare::Torque;
use affinor::mechanics::{Constrained, Constraint, GeneralisedAlpha, Integrator};
use affinor::{CanonicalConnection, Connection, Metric};
use nalgebra::{Const, DMatrix, DVector, SVector, Vector1, Vector2, dvector};

/// No constraints.
struct Nothing;

impl Constraint<Translations<Const<1>>> for Nothing {
    fn value(&self, _: f64, _: &Vector1<f64>) -> DVector<f64> {
        DVector::zeros(0)
    }

    fn gradient(&self, _: f64, _: &Vector1<f64>) -> DMatrix<f64> {
        DMatrix::zeros(0, 1)
    }
}

/// A particle of mass 1 under a constraint, with a force by its place.
fn particle<const N: usize, C: Constraint<Translations<Const<N>>>>(
    force: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
    constraint: C,
) -> Constrained<Translations<Const<N>>, C, impl Torque<Translations<Const<N>>>> {
    let space = Translations(Const::<N>);
    let plus = Connection::canonical(&space.algebra().unwrap(), CanonicalConnection::Plus);
    let force = move |_: f64, x: &SVector<f64, N>, _: &SVector<f64, N>| force(x);
    Constrained::new(space, &plus, &Metric::identity(N).unwrap(), force, constraint).unwrap()
}

/// J. Chung and G. M. Hulbert, *J. Appl. Mech.* 60 (1993) 371-375: in the limit of high frequencies the amplification matrix of
/// a step has the threefold eigenvalue `-rho`, so `x_(n+3) + 3 rho x_(n+2) + 3 rho^2 x_(n+1) + rho^3 x_n = 0`.
#[test]
fn high_frequencies_are_damped_by_the_spectral_radius() {
    let stiffness = 1e4;
    let oscillator = particle(|x: &Vector1<f64>| x * -stiffness, Nothing);
    for spectral_radius in [0.0, 0.3, 0.5, 0.8, 0.9, 1.0] {
        let method = GeneralisedAlpha { spectral_radius };
        let mut state = oscillator.state(0.0, Vector1::new(1.0), &Vector1::zeros()).unwrap();
        let mut places = vec![];
        for _ in 0..12 {
            method.step(&oscillator, &mut state, 1.0).unwrap();
            places.push(state.element.x);
        }
        let rho = spectral_radius;
        for at in places.windows(4) {
            let terms = [at[3], 3.0 * rho * at[2], 3.0 * rho.powi(2) * at[1], rho.powi(3) * at[0]];
            let size: f64 = at.iter().map(|x| x.abs()).sum();
            assert!(terms.iter().sum::<f64>().abs() <= 1e-3 * size + 1e-12, "{rho}: {places:?}");
        }
    }
}

/// `(|x|^2 - 1)/2 = 0`.
struct Rod;

impl Constraint<Translations<Const<2>>> for Rod {
    fn value(&self, _: f64, x: &Vector2<f64>) -> DVector<f64> {
        dvector![0.5 * (x.norm_squared() - 1.0)]
    }

    fn gradient(&self, _: f64, x: &Vector2<f64>) -> DMatrix<f64> {
        DMatrix::from_row_slice(1, 2, x.as_slice())
    }
}

/// Newton's method goes on until its corrections are rounding errors, in long steps as well.
#[test]
fn constraints_hold_to_rounding() {
    let pendulum = particle(|_: &Vector2<f64>| Vector2::new(0.0, -1.0), Rod);
    for h in [0.1, 0.4, 0.5, 0.7] {
        let mut state = pendulum.state(0.0, Vector2::x(), &Vector2::zeros()).unwrap();
        for _ in 0..40 {
            GeneralisedAlpha::default().step(&pendulum, &mut state, h).unwrap();
            let off = pendulum.violation(&state);
            assert!(off <= 1e-13, "{h}: {off:e}");
        }
    }
}
