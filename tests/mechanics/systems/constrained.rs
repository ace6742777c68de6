//! Constrained systems: the heavy top on R^3 x SO(3) and on SE(3) compared with 30 digits, and
//! simpler systems with closed forms.

use crate::common::steps::run;
use affinor::group::{
    LieGroup, MatrixGroup, Product, Se2, Se3, So3, TranslationSplit, Translations,
};
use affinor::mechanics::bodies::elliptic::Jacobi;
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    Adaptive, BodyState, Constrained, ConstrainedState, Constraint, EulerPoincare, FreeBody,
    GeneralisedAlpha, Inertia, Integrator,
};
use affinor::{CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{
    Const, DMatrix, DVector, Isometry3, Matrix3, UnitQuaternion, Vector2, Vector3, Vector6, dvector,
};

const MASS: f64 = 15.0;
const GRAVITY: f64 = 9.81;
const MOMENTS: [f64; 3] = [0.234375, 0.46875, 0.234375];
const SPIN: Vector3<f64> = Vector3::new(0.0, 150.0, -4.61538);
/// The centre of mass relative to the fixed point, in the body.
const ARM: Vector3<f64> = Vector3::new(0.0, 1.0, 0.0);

type Space = Product<Translations<Const<3>>, So3>;
const SPACE: Space = Product(Translations(Const::<3>), So3);

fn metric<G: TranslationSplit>(group: &G, diagonal: &[f64]) -> Metric<f64> {
    let entries: Vec<_> = diagonal.iter().enumerate().map(|(i, x)| ([i, i], *x)).collect();
    let tensor = Tensor::from_components(diagonal.len(), &[Down, Down], entries).unwrap();
    Metric::new(group.algebra().unwrap().labels(), tensor).unwrap()
}

/// The constrained system with the connection `plus`.
fn constrained<G: TranslationSplit, C: Constraint<G>, M: Torque<G>>(
    group: G,
    metric: &Metric<f64>,
    force: M,
    constraint: C,
) -> Result<Constrained<G, C, M>, Error> {
    let plus = Connection::canonical(&group.algebra().unwrap(), CanonicalConnection::Plus);
    Constrained::new(group, &plus, metric, force, constraint)
}

fn rotation(q: &UnitQuaternion<f64>) -> Matrix3<f64> {
    q.to_rotation_matrix().into_inner()
}

/// The constraint `-x + R X = 0`.
#[derive(Clone, Debug)]
struct Support;

fn support(left: &Matrix3<f64>, turned: &Matrix3<f64>, order: [usize; 2]) -> DMatrix<f64> {
    let mut b = DMatrix::zeros(3, 6);
    b.fixed_view_mut::<3, 3>(0, order[0]).copy_from(&-left);
    b.fixed_view_mut::<3, 3>(0, order[1]).copy_from(&-(turned * ARM.cross_matrix()));
    b
}

impl Constraint<Space> for Support {
    fn value(&self, _: f64, (x, q): &(Vector3<f64>, UnitQuaternion<f64>)) -> DVector<f64> {
        DVector::from_column_slice((q * ARM - x).as_slice())
    }

    fn gradient(&self, _: f64, (_, q): &(Vector3<f64>, UnitQuaternion<f64>)) -> DMatrix<f64> {
        support(&Matrix3::identity(), &rotation(q), [0, 3])
    }
}

impl Constraint<Se3> for Support {
    fn value(&self, _: f64, g: &Isometry3<f64>) -> DVector<f64> {
        DVector::from_column_slice((g.rotation * ARM - g.translation.vector).as_slice())
    }

    fn gradient(&self, _: f64, g: &Isometry3<f64>) -> DMatrix<f64> {
        support(&rotation(&g.rotation), &rotation(&g.rotation), [3, 0])
    }
}

/// The common interface of the two descriptions of the top.
trait Top: TranslationSplit + Copy {
    fn forces() -> impl Torque<Self>;
    fn masses() -> [f64; 6];
    fn upright() -> (Self::Element, Self::Vector);
    /// The position of the centre, the attitude, and the angular velocity in the body.
    fn parts(
        element: &Self::Element,
        velocity: &Self::Vector,
    ) -> (Vector3<f64>, UnitQuaternion<f64>, Vector3<f64>);
}

impl Top for Space {
    fn forces() -> impl Torque<Self> {
        |_: f64, _: &(Vector3<f64>, UnitQuaternion<f64>), _: &DVector<f64>| {
            dvector![0.0, 0.0, -MASS * GRAVITY, 0.0, 0.0, 0.0]
        }
    }

    fn masses() -> [f64; 6] {
        [MASS, MASS, MASS, MOMENTS[0], MOMENTS[1], MOMENTS[2]]
    }

    fn upright() -> (Self::Element, DVector<f64>) {
        ((ARM, UnitQuaternion::identity()), SPACE.join(&SPIN.cross(&ARM), &SPIN))
    }

    fn parts(
        (x, q): &Self::Element,
        velocity: &DVector<f64>,
    ) -> (Vector3<f64>, UnitQuaternion<f64>, Vector3<f64>) {
        (*x, *q, SPACE.split(velocity).1)
    }
}

impl Top for Se3 {
    fn forces() -> impl Torque<Self> {
        |_: f64, g: &Isometry3<f64>, _: &Vector6<f64>| {
            let weight =
                g.rotation.inverse_transform_vector(&Vector3::new(0.0, 0.0, -MASS * GRAVITY));
            Vector6::new(0.0, 0.0, 0.0, weight.x, weight.y, weight.z)
        }
    }

    fn masses() -> [f64; 6] {
        [MOMENTS[0], MOMENTS[1], MOMENTS[2], MASS, MASS, MASS]
    }

    fn upright() -> (Self::Element, Vector6<f64>) {
        let u = SPIN.cross(&ARM);
        let twist = Vector6::new(SPIN.x, SPIN.y, SPIN.z, u.x, u.y, u.z);
        (Isometry3::translation(ARM.x, ARM.y, ARM.z), twist)
    }

    fn parts(
        g: &Self::Element,
        velocity: &Vector6<f64>,
    ) -> (Vector3<f64>, UnitQuaternion<f64>, Vector3<f64>) {
        (g.translation.vector, g.rotation, velocity.fixed_rows::<3>(0).into_owned())
    }
}

/// A reference state of the top.
struct Known {
    time: f64,
    centre: Vector3<f64>,
    attitude: Matrix3<f64>,
    spin: Vector3<f64>,
    multipliers: Vector3<f64>,
}

fn references() -> Vec<Known> {
    let lines = include_str!("../../data/heavy_top.txt").lines();
    let known = |line: &str| {
        let x: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        let vector = |at: usize| Vector3::from_column_slice(&x[at..at + 3]);
        Known {
            time: x[0],
            centre: vector(1),
            attitude: Matrix3::from_row_slice(&x[4..13]),
            spin: vector(13),
            multipliers: vector(16),
        }
    };
    lines.map(known).collect()
}

/// Relative errors of position, velocity and multipliers.
fn errors<G: Top>(state: &ConstrainedState<G>, known: &Known) -> [f64; 3] {
    let (x, q, spin) = G::parts(&state.element, &state.velocity);
    let place = (x - known.centre).norm().max((rotation(&q) - known.attitude).norm());
    let multipliers = Vector3::from_column_slice(state.multipliers.as_slice());
    let off = (multipliers - known.multipliers).norm() / known.multipliers.norm();
    [place, (spin - known.spin).norm() / known.spin.norm(), off]
}

fn top<G: Top>(group: G) -> (Constrained<G, Support, impl Torque<G>>, ConstrainedState<G>)
where
    Support: Constraint<G>,
{
    let metric = metric(&group, &G::masses());
    let system = constrained(group, &metric, G::forces(), Support).unwrap();
    let (element, velocity) = G::upright();
    let start = system.state(0.0, element, &velocity).unwrap();
    (system, start)
}

/// Checks order 2 of several errors, over four halvings.
fn order_two<const N: usize>(error: impl Fn(usize) -> [f64; N], steps: usize) {
    let errors: Vec<_> = (0..5).map(|halving| error(steps << halving)).collect();
    for pair in errors.windows(2) {
        for (before, after) in pair[0].iter().zip(pair[1]) {
            let observed = (before / after).log2();
            assert!((observed - 2.0).abs() < 0.1, "{observed}: {errors:?}");
        }
    }
}

fn top_has_order_two<G: Top>(group: G, rho: f64)
where
    Support: Constraint<G>,
{
    let (system, start) = top(group);
    let known = references();
    assert!(errors(&start, &known[0]).iter().all(|error| *error < 1e-9));
    let method = GeneralisedAlpha { spectral_radius: rho };
    let (end, time) = (&known[3], known[3].time);
    order_two(|steps| errors(&run(&method, &system, &start, time, steps), end), 500);
}

#[test]
fn the_heavy_top_in_space_and_attitude() {
    top_has_order_two(SPACE, 0.9);
}

#[test]
fn the_heavy_top_with_more_damping() {
    top_has_order_two(SPACE, 0.6);
}

#[test]
fn the_heavy_top_in_poses() {
    top_has_order_two(Se3, 0.9);
}

/// The published state at `t = 2`, by extrapolation of the error `h^2`; constraints and energy are
/// checked on the way.
#[test]
fn the_heavy_top_after_two_seconds() {
    let (system, start) = top(SPACE);
    let method = GeneralisedAlpha::default();
    let [coarse, fine] = [8_000, 16_000].map(|n| run(&method, &system, &start, 2.0, n).element.0);
    let published = Vector3::new(-0.15041682274564, -0.72416559163690, -0.67302226956044);
    let centre = (fine * 4.0 - coarse) / 3.0;
    assert!((fine - published).norm() < 1e-3, "{}", (fine - published).norm());
    assert!((centre - published).norm() < 1e-5, "{}", (centre - published).norm());

    let energy = |state: &ConstrainedState<Space>| {
        system.kinetic_energy(state) + MASS * GRAVITY * state.element.0.z
    };
    let before = energy(&start);
    let worst = |steps: usize| {
        let (mut state, mut worst) = (start.clone(), [0.0_f64; 2]);
        for _ in 0..steps {
            method.step(&system, &mut state, 0.2 / steps as f64).unwrap();
            assert!(system.violation(&state) < 1e-14);
            let off = [(energy(&state) / before - 1.0).abs(), system.velocity_violation(&state)];
            worst = [worst[0].max(off[0]), worst[1].max(off[1])];
        }
        worst
    };
    order_two(worst, 200);
    assert!(worst(3200)[0] < 1e-4);
}

/// The largest error of the multipliers in the first twentieth of a second is of second order from
/// the first step on, compared with the unconstrained top on SO(3).
#[test]
fn multipliers_have_no_transient() {
    let moments = [MOMENTS[0] + MASS, MOMENTS[1], MOMENTS[2] + MASS];
    let metric = metric(&So3, &moments);
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let moment = |_: f64, q: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        ARM.cross(&q.inverse_transform_vector(&Vector3::new(0.0, 0.0, -MASS * GRAVITY)))
    };
    let body = EulerPoincare::new(So3, &plus, &metric, moment).unwrap();
    let at_rest = body.state(0.0, UnitQuaternion::identity(), &SPIN);
    // the force of the support, m (x'' + g e_z)
    let force = |q: &UnitQuaternion<f64>, spin: &Vector3<f64>| {
        let momentum = Vector3::from(moments).component_mul(spin);
        let rate =
            (moment(0.0, q, spin) - spin.cross(&momentum)).component_div(&Vector3::from(moments));
        let bent: Vector3<f64> = rate.cross(&ARM) + spin.cross(&spin.cross(&ARM));
        (q.transform_vector(&bent) + Vector3::z() * GRAVITY) * MASS
    };
    let (system, start) = top(SPACE);
    let method = GeneralisedAlpha::default();
    order_two(
        |steps| {
            let h = 0.05 / steps as f64;
            let times: Vec<f64> = (1..=steps).map(|k| h * k as f64).collect();
            let exact = Adaptive::new(1e-11).states(&body, &at_rest, &times).unwrap();
            let mut state = start.clone();
            let off = exact.iter().map(|exact| {
                method.step(&system, &mut state, h).unwrap();
                let force = force(&exact.element, &body.velocity(exact));
                (Vector3::from_column_slice(state.multipliers.as_slice()) - force).norm()
            });
            [off.fold(0.0, f64::max)]
        },
        100,
    );
}

/// No constraint equations.
struct Nothing;

impl<G: TranslationSplit> Constraint<G> for Nothing {
    fn value(&self, _: f64, _: &G::Element) -> DVector<f64> {
        DVector::zeros(0)
    }

    fn gradient(&self, _: f64, element: &G::Element) -> DMatrix<f64> {
        let _ = element;
        DMatrix::zeros(0, 3)
    }
}

#[test]
fn a_free_body_is_a_case() {
    let moments = Vector3::new(0.6, 0.8, 1.0);
    let momentum = Vector3::new(1.8, 0.4, -0.9);
    let inertia = Inertia::diagonal(&moments).unwrap();
    let start = BodyState { attitude: UnitQuaternion::identity(), momentum };
    let exact = FreeBody::new(&inertia, &start).unwrap().at(2.0);
    let system = constrained(So3, &metric(&So3, moments.as_slice()), Free, Nothing).unwrap();
    let velocity = momentum.component_div(&moments);
    let state = system.state(0.0, start.attitude, &velocity).unwrap();
    assert_eq!((system.violation(&state), system.velocity_violation(&state)), (0.0, 0.0));
    for rho in [0.0, 0.5, 1.0] {
        let method = GeneralisedAlpha { spectral_radius: rho };
        let error = |steps: usize| {
            let end = run(&method, &system, &state, 2.0, steps);
            let turn = (end.element.coords - exact.attitude.coords).norm();
            [turn, (end.velocity.component_mul(&moments) - exact.momentum).norm()]
        };
        order_two(error, 200);
    }
}

/// Other connections too: `zero` is compared with the system without constraints.
#[test]
fn a_connection_is_a_choice() {
    let metric = metric(&So3, &[0.6, 0.8, 1.0]);
    let zero = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Zero);
    let moment = |t: f64, _: &UnitQuaternion<f64>, v: &Vector3<f64>| {
        Vector3::new(t.cos(), 0.2, 0.0) - v * 0.1
    };
    let body = EulerPoincare::new(So3, &zero, &metric, moment).unwrap();
    let velocity = Vector3::new(1.0, -0.5, 0.8);
    let start = body.state(0.5, UnitQuaternion::identity(), &velocity);
    let exact = Adaptive::new(1e-12).states(&body, &start, &[2.5]).unwrap().remove(0);
    let system = Constrained::new(So3, &zero, &metric, moment, Nothing).unwrap();
    let start = system.state(0.5, UnitQuaternion::identity(), &velocity).unwrap();
    let error = |steps: usize| {
        let end = run(&GeneralisedAlpha::default(), &system, &start, 2.0, steps);
        let turn = (end.element.coords - exact.element.coords).norm();
        [turn, (end.velocity - body.velocity(&exact)).norm()]
    };
    order_two(error, 100);
}

/// The constraint `(|x|^2 - 1)/2 = 0`.
struct Rod;

impl Constraint<Translations<Const<2>>> for Rod {
    fn value(&self, _: f64, x: &Vector2<f64>) -> DVector<f64> {
        dvector![0.5 * (x.norm_squared() - 1.0)]
    }

    fn gradient(&self, _: f64, x: &Vector2<f64>) -> DMatrix<f64> {
        DMatrix::from_row_slice(1, 2, &[x.x, x.y])
    }
}

fn pendulum() -> Constrained<Translations<Const<2>>, Rod, impl Torque<Translations<Const<2>>>> {
    let plane = Translations(Const::<2>);
    let gravity = |_: f64, _: &Vector2<f64>, _: &Vector2<f64>| Vector2::new(0.0, -1.0);
    constrained(plane, &metric(&plane, &[1.0, 1.0]), gravity, Rod).unwrap()
}

/// For a release at the horizontal, the angle satisfies `sin(angle/2) = k sn(K - t)` with `k^2 =
/// 1/2`, and the force of the rod is `-3 y`.
#[test]
fn the_pendulum_is_elliptic() {
    let k = 0.5_f64.sqrt();
    let jacobi = Jacobi::new(k, k);
    let time = 3.0;
    let [sn, cn, _] = jacobi.at(jacobi.quarter_period() - time);
    let (half_sine, half_rate) = (k * sn, -k * cn);
    let half_cosine = (1.0 - half_sine * half_sine).sqrt();
    let exact = Vector2::new(2.0 * half_sine * half_cosine, 2.0 * half_sine * half_sine - 1.0);
    // the time derivative of the angle is 2 k d(sn)/dt over the cosine of the half angle, and dn is
    // that cosine
    let velocity = Vector2::new(-exact.y, exact.x) * (2.0 * half_rate);
    let system = pendulum();
    let start = system.state(0.0, Vector2::new(1.0, 0.0), &Vector2::zeros()).unwrap();
    for rho in [0.3, 0.9] {
        let method = GeneralisedAlpha { spectral_radius: rho };
        let error = |steps: usize| {
            let end = run(&method, &system, &start, time, steps);
            let force = (end.multipliers[0] + 3.0 * exact.y).abs();
            [(end.element - exact).norm(), (end.velocity - velocity).norm(), force]
        };
        order_two(error, 200);
    }
    // backwards in time the motion is the same
    let end = run(&GeneralisedAlpha::default(), &system, &start, -time, 1000);
    assert!((end.element - exact).norm() < 1e-4 && (end.velocity + velocity).norm() < 1e-4);
}

/// The constraint `b = sin x` for the map `s -> a s + b` and a number `x`.
#[derive(Clone)]
struct Curve;

type Line = Product<MatrixGroup, Translations<Const<1>>>;

impl Constraint<Line> for Curve {
    fn value(&self, _: f64, (g, x): &<Line as LieGroup>::Element) -> DVector<f64> {
        dvector![g[(0, 1)] - x[0].sin()]
    }

    fn gradient(&self, _: f64, (g, x): &<Line as LieGroup>::Element) -> DMatrix<f64> {
        DMatrix::from_row_slice(1, 3, &[0.0, g[(0, 0)], -x[0].cos()])
    }
}

/// The energy is conserved on the affine group of the line, which is not unimodular, with a metric
/// that is not diagonal.
#[test]
fn energy_on_the_affine_group() {
    let stretch = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]);
    let shift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
    let group = Product(MatrixGroup::new(&[stretch, shift]).unwrap(), Translations(Const::<1>));
    let mass = |[i, j]: [usize; 2]| f64::from(u8::from(i == j)) + 0.4 / (1.0 + (i + j) as f64);
    let mass = Tensor::from_fn(3, [Down, Down], mass).unwrap();
    let mass = Metric::new(group.algebra().unwrap().labels(), mass).unwrap();
    let system = constrained(group.clone(), &mass, Free, Curve).unwrap();
    let start = system.state(0.0, group.identity(), &dvector![0.8, 0.5, 0.5]).unwrap();
    let method = GeneralisedAlpha::default();
    let fine = run(&method, &system, &start, 2.0, 1600);
    // extrapolated, because multipliers of shorter steps have rounding errors of 2e-9
    let [coarser, finer] = [400, 800].map(|n| run(&method, &system, &start, 2.0, n).multipliers);
    let multipliers = &finer + (&finer - coarser) / 3.0;
    let error = |steps: usize| {
        let end = run(&method, &system, &start, 2.0, steps);
        let energy = system.kinetic_energy(&end) / system.kinetic_energy(&start) - 1.0;
        [energy.abs(), (end.multipliers - &multipliers).norm()]
    };
    let errors = [100, 200, 400].map(error);
    for pair in errors.windows(2) {
        for (before, after) in pair[0].iter().zip(pair[1]) {
            assert!(((before / after).log2() - 2.0).abs() < 0.1, "{errors:?}");
        }
    }
    assert!((system.kinetic_energy(&fine) / system.kinetic_energy(&start) - 1.0).abs() < 1e-6);
    assert!((&fine.velocity - &start.velocity).norm() > 0.1);
    assert!(system.violation(&fine) < 1e-14);
}

/// Constraints in the plane, by their values and gradients.
struct Given<V, B>(V, B);

impl<V: Fn(&Vector2<f64>) -> DVector<f64>, B: Fn(&Vector2<f64>) -> DMatrix<f64>>
    Constraint<Translations<Const<2>>> for Given<V, B>
{
    fn value(&self, _: f64, x: &Vector2<f64>) -> DVector<f64> {
        self.0(x)
    }

    fn gradient(&self, _: f64, x: &Vector2<f64>) -> DMatrix<f64> {
        self.1(x)
    }
}

/// `x = 0` with another gradient.
fn wrong(gradient: DMatrix<f64>) -> impl Constraint<Translations<Const<2>>> {
    Given(|x: &Vector2<f64>| dvector![x.x], move |_: &Vector2<f64>| gradient.clone())
}

/// `x = 0` and `factor x + angle y = 0`.
fn nearly_twice(factor: f64, angle: f64) -> impl Constraint<Translations<Const<2>>> {
    Given(
        move |x: &Vector2<f64>| dvector![x.x, factor * x.x + angle * x.y],
        move |_: &Vector2<f64>| DMatrix::from_row_slice(2, 2, &[1.0, 0.0, factor, angle]),
    )
}

#[test]
fn what_is_no_state_is_refused() {
    let plane = Translations(Const::<2>);
    let unit = metric(&plane, &[1.0, 1.0]);
    let zero = Vector2::zeros();
    fn reason<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
        match result {
            Err(Error::Invalid { what: "state", reason }) => reason,
            other => panic!("{other:?}"),
        }
    }
    let system = pendulum();
    let inside = reason(system.state(0.0, Vector2::new(0.5, 0.0), &zero));
    assert_eq!(inside, "constraint 1 is -0.375, not 0");
    let leaving = reason(system.state(0.0, Vector2::new(1.0, 0.0), &Vector2::new(0.25, 1.0)));
    let expected = "constraint 1 changes at the rate 0.25, not 0; \
                    the nearest velocity that satisfies all is [0, 1]";
    assert_eq!(leaving, expected);
    for (time, x, v) in [(f64::NAN, 1.0, 0.0), (0.0, f64::NAN, 0.0), (0.0, 1.0, f64::INFINITY)] {
        reason(system.state(time, Vector2::new(x, 0.0), &Vector2::new(0.0, v)));
    }
    let twice = constrained(plane, &unit, Free, nearly_twice(2.0, 0.0)).unwrap();
    let dependent = reason(twice.state(0.0, zero, &zero));
    assert!(dependent.contains("constraint 2 is dependent"), "{dependent}");
    let half = wrong(DMatrix::from_row_slice(1, 2, &[0.5, 0.0]));
    let half = constrained(plane, &unit, Free, half).unwrap();
    assert!(reason(half.state(0.0, zero, &zero)).contains("B^1_1 is 0.5"));
    let shape = constrained(plane, &unit, Free, wrong(DMatrix::zeros(2, 2))).unwrap();
    assert!(matches!(shape.state(0.0, zero, &zero), Err(Error::Shape { .. })));
    assert!(matches!(constrained(So3, &unit, Free, Nothing), Err(Error::Shape { .. })));
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let other = Constrained::new(Se2, &plus, &metric(&Se2, &[1.0; 3]), Free, Nothing);
    assert!(matches!(other, Err(Error::Shape { what: "the connection", .. })));
}

/// Errors of a state up to `1e-8` of its size are accepted, of a gradient up to `1e-4`, because it is compared with differences.
/// Gradients with an angle below `1e-10` are dependent.
#[test]
fn states_are_checked_to_their_tolerances() {
    let plane = Translations(Const::<2>);
    let unit = metric(&plane, &[1.0, 1.0]);
    let (system, zero) = (pendulum(), Vector2::zeros());
    let outside = |off: f64| system.state(0.0, Vector2::new(1.0 + off, 0.0), &zero).is_ok();
    let leaving =
        |rate: f64| system.state(0.0, Vector2::new(1.0, 0.0), &Vector2::new(rate, 1.0)).is_ok();
    let independent = |angle: f64| {
        let state = constrained(plane, &unit, Free, nearly_twice(1.0, angle))
            .unwrap()
            .state(0.0, zero, &zero);
        let reason = |error: Error| error.to_string();
        state.map_err(reason).map_or_else(|reason| !reason.contains("2 is dependent"), |_| true)
    };
    let derived = |off: f64| {
        let given = wrong(DMatrix::from_row_slice(1, 2, &[1.0 + off, 0.0]));
        constrained(plane, &unit, Free, given).unwrap().state(0.0, zero, &zero).is_ok()
    };
    for sign in [1.0, -1.0] {
        assert!(outside(sign * 1e-9) && !outside(sign * 1e-7));
        assert!(leaving(sign * 1e-9) && !leaving(sign * 1e-7));
        assert!(independent(sign * 1e-6) && !independent(sign * 1e-12));
        assert!(derived(sign * 1e-5) && !derived(sign * 1e-3));
    }
}

/// The acceleration of a free particle on a curve is its curvature times the square of the speed: derivatives of gradients are
/// differences of fourth order.
#[test]
fn accelerations_on_a_curve_have_ten_digits() {
    let plane = Translations(Const::<2>);
    let sine = Given(
        |x: &Vector2<f64>| dvector![x.y - x.x.sin()],
        |x: &Vector2<f64>| DMatrix::from_row_slice(1, 2, &[-x.x.cos(), 1.0]),
    );
    let system = constrained(plane, &metric(&plane, &[1.0, 1.0]), Free, sine).unwrap();
    for (x, speed) in [0.2_f64, 0.7, 1.3, 2.9].into_iter().flat_map(|x| [(x, 0.1), (x, 30.0)]) {
        let (sin, cos) = x.sin_cos();
        let state =
            system.state(0.0, Vector2::new(x, sin), &(Vector2::new(1.0, cos) * speed)).unwrap();
        let exact = Vector2::new(cos, -1.0) * (sin * speed.powi(2) / (1.0 + cos * cos));
        let off = (state.acceleration - exact).norm() / exact.norm();
        assert!(off <= 1e-10, "{x} {speed}: {off:e}");
    }
}

#[test]
fn steps_that_cannot_be_leave_the_state() {
    let system = pendulum();
    let start = system.state(0.0, Vector2::new(1.0, 0.0), &Vector2::zeros()).unwrap();
    let unchanged = |method: &GeneralisedAlpha, h: f64| {
        let mut state = start.clone();
        let stopped = method.step(&system, &mut state, h);
        assert!(matches!(stopped, Err(Error::Integration { .. })), "{h}: {stopped:?}");
        assert_eq!(state, start);
    };
    for h in [0.0, f64::NAN, f64::INFINITY, 1e3, 1e200] {
        unchanged(&GeneralisedAlpha::default(), h);
    }
    for spectral_radius in [-0.1, 1.1, f64::NAN] {
        unchanged(&GeneralisedAlpha { spectral_radius }, 0.1);
    }
    // a force that is undefined after some time
    let plane = Translations(Const::<2>);
    let gravity = |t: f64, _: &Vector2<f64>, _: &Vector2<f64>| Vector2::new(0.0, -(1.0 - t).sqrt());
    let system = constrained(plane, &metric(&plane, &[1.0, 1.0]), gravity, Rod).unwrap();
    let mut state = system.state(0.0, Vector2::new(1.0, 0.0), &Vector2::zeros()).unwrap();
    let steps = (0..20).map(|_| GeneralisedAlpha::default().step(&system, &mut state, 0.1));
    let stopped = steps.collect::<Result<Vec<_>, _>>();
    assert!(matches!(stopped, Err(Error::Integration { t, .. }) if (0.8..1.1).contains(&t)));
}
