//! Orders of the integrators, on groups of several kinds, compared with independent solutions; and
//! their conserved quantities.

mod adaptive;
mod compensated;
mod generalised_alpha;
mod munthe_kaas;
mod projected;
mod step_start;

use crate::common::steps::{expect_order, run};
use crate::ode;
use affinor::geometry::equations::Equations;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{
    Coordinates, Embedded, Heisenberg, LieGroup, MatrixGroup, Se2, Se3, Sl2, So3, TranslationSplit,
};
use affinor::mechanics::integrators::kick::{FreeMotion, KickOrder};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    Adaptive, BodyState, CommutatorFree, EulerPoincare, FreeBody, Inertia, Integrator, Kick,
    KinematicState, Magnus, MoserVeselov, MuntheKaas, PrescribedVelocity, Projected, SimoWong,
    State,
};
use affinor::{CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Const, DMatrix, DVector, Matrix3, UnitQuaternion, Vector3, Vector6, dmatrix};

/// The inner products of a basis that is neither orthogonal nor normalized.
pub fn full<G: TranslationSplit>(group: &G) -> Metric<f64> {
    let entry = |[i, j]: [usize; 2]| match i.abs_diff(j) {
        0 => 1.0 + 0.5 * i as f64,
        1 => 0.2,
        _ => 0.05,
    };
    let metric = Tensor::from_fn(group.dimension(), [Down, Down], entry).unwrap();
    Metric::new(group.algebra().unwrap().labels(), metric).unwrap()
}

/// The basis of the algebra as matrices, which have integer entries here.
fn generators<G: TranslationSplit>(group: &G) -> Vec<DMatrix<f64>> {
    let step = 1e-5;
    let slope = |x: &G::Vector| {
        let at = |t: f64| group.matrix(&group.exp(&(x.clone() * t)));
        (at(step) - at(-step)) / (2.0 * step)
    };
    let slopes = group.basis().iter().map(slope).collect::<Vec<_>>();
    for slope in &slopes {
        assert!((slope - slope.map(f64::round)).amax() < 1e-9);
    }
    slopes.iter().map(|slope| slope.map(f64::round)).collect()
}

/// The equation `g' = g Omega` for the entries of a matrix, after other unknowns `x` with `x' =
/// rates(t, g, x)`.
fn entries<G: TranslationSplit>(
    group: &G,
    start: (f64, &G::Element, &[f64]),
    end: f64,
    omega: impl Fn(f64, &[f64]) -> Vec<f64>,
    rates: impl Fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64>,
) -> (DMatrix<f64>, Vec<f64>) {
    let (time, element, others) = start;
    let (basis, matrix) = (generators(group), group.matrix(element));
    let (size, n) = (matrix.nrows(), others.len());
    let split = |y: &DVector<f64>| DMatrix::from_column_slice(size, size, &y.as_slice()[n..]);
    let joined = |others: &[f64], matrix: &DMatrix<f64>| {
        DVector::from_iterator(n + size * size, others.iter().chain(matrix.iter()).copied())
    };
    let f = |t: f64, y: &DVector<f64>| {
        let (others, matrix) = (&y.as_slice()[..n], split(y));
        let omega = omega(t, others);
        let spin =
            basis.iter().zip(&omega).fold(DMatrix::zeros(size, size), |s, (e, w)| s + e * *w);
        joined(&rates(t, &matrix, others), &(matrix * spin))
    };
    let y = ode::solve(f, time, joined(others, &matrix), &[end], 1e-14).remove(0);
    (split(&y), y.as_slice()[..n].to_vec())
}

/// A torque that depends on all its arguments.
fn moment(time: f64, matrix: &DMatrix<f64>, omega: &[f64]) -> Vec<f64> {
    let n = omega.len();
    let place = |i: usize| matrix[(0, 1)] * (1.0 + i as f64) - matrix[(0, matrix.ncols() - 1)];
    (0..n).map(|i| 0.2 * (time + i as f64).sin() - 0.1 * omega[i] + 0.1 * place(i)).collect()
}

/// The same torque, four times as fast.
fn fast(time: f64, matrix: &DMatrix<f64>, omega: &[f64]) -> Vec<f64> {
    moment(4.0 * time, matrix, omega).iter().map(|m| 4.0 * m).collect()
}

/// A torque that depends on the matrix of the element.
struct Load<G, F> {
    group: G,
    moment: F,
}

impl<G: TranslationSplit, F: Fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64>> Torque<G> for Load<G, F> {
    fn add(&self, time: f64, g: &G::Element, omega: &G::Vector, force: &mut G::Vector) {
        let moment = (self.moment)(time, &self.group.matrix(g), omega.components());
        *force = force.clone() + G::Vector::from_components(&moment);
    }
}

struct Case<G: TranslationSplit, M> {
    system: EulerPoincare<G, M>,
    start: State<G>,
    span: f64,
    end: (DMatrix<f64>, Vec<f64>),
}

impl<G: TranslationSplit, M: Torque<G>> Case<G, M> {
    /// The distance of the final state from the reference.
    fn error(&self, method: &impl Integrator<EulerPoincare<G, M>>, steps: usize) -> f64 {
        self.errors(method, steps).amax()
    }

    /// The errors of each entry of the element, and of the velocity.
    fn errors(&self, method: &impl Integrator<EulerPoincare<G, M>>, steps: usize) -> DVector<f64> {
        let end = run(method, &self.system, &self.start, self.span, steps);
        let off = self.system.group().matrix(&end.element) - &self.end.0;
        let velocity = self.system.velocity(&end) - G::Vector::from_components(&self.end.1);
        let entries = off.iter().chain(velocity.components()).copied();
        DVector::from_iterator(off.len() + velocity.components().len(), entries)
    }
}

/// A system, and the matrix entries and the velocity at a time by the equations (106).
fn case<G: TranslationSplit + Clone, F: Fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64> + Clone>(
    group: G,
    which: CanonicalConnection,
    metric: &Metric<f64>,
    velocity: &G::Vector,
    span: f64,
    moment: F,
) -> Case<G, Load<G, F>> {
    let connection = Connection::canonical(&group.algebra().unwrap(), which);
    let equations = Equations::euler_poincare(&connection, metric).unwrap();
    let torque = Load { group: group.clone(), moment: moment.clone() };
    let system = EulerPoincare::new(group.clone(), &connection, metric, torque).unwrap();
    let start = system.state(0.3, group.exp(&(velocity.clone() * 0.2)), velocity);
    let at = (0.3, &start.element, velocity.components());
    let end = entries(
        &group,
        at,
        0.3 + span,
        |_, omega| omega.to_vec(),
        |t, g, omega| equations.rate(omega, &moment(t, g, omega)).unwrap(),
    );
    Case { system, start, span, end }
}

type Moment = fn(f64, &DMatrix<f64>, &[f64]) -> Vec<f64>;

/// Motions of one time unit, and of three units with forces four times as fast, for two
/// connections.
fn each_motion<G: TranslationSplit + Clone>(
    group: G,
    velocity: &G::Vector,
    check: impl Fn(&Case<G, Load<G, Moment>>, &Case<G, Load<G, Moment>>),
) {
    let metric = full(&group);
    for which in [CanonicalConnection::Zero, CanonicalConnection::Plus] {
        let case = |span, load: Moment| case(group.clone(), which, &metric, velocity, span, load);
        check(&case(1.0, moment), &case(3.0, fast));
    }
}

/// The first numbers of steps, and the numbers of steps for order 5.
fn orders<G: TranslationSplit + Clone>(
    name: &str,
    group: G,
    velocity: &G::Vector,
    [steps, fifth]: [usize; 2],
) {
    each_motion(group, velocity, |short, long| {
        let check = |method: &str, order: u32, steps, error: &dyn Fn(usize) -> f64| {
            expect_order(&format!("{method} on {name}"), order, steps, 4, error);
        };
        check("CF4", CommutatorFree.order(), steps, &|n| short.error(&CommutatorFree, n));
        check("RKMK4", 4, steps, &|n| short.error(&MuntheKaas::RK4, n));
        order_of_five("DP5", name, fifth, |n| long.errors(&MuntheKaas::DORMAND_PRINCE, n));
    });
}

/// The orders of methods in embedding coordinates.
fn projected_orders<G: Embedded + TranslationSplit + Clone>(
    name: &str,
    group: G,
    velocity: &G::Vector,
    steps: usize,
) {
    each_motion(group, velocity, |short, long| {
        let error = |n: usize| short.error(&Projected::RK4, n);
        expect_order(&format!("projected RK4 on {name}"), 4, steps, 4, error);
        order_of_five("projected DP5", name, 64, |n| long.errors(&Projected::DORMAND_PRINCE, n));
    });
}

/// The error constants of order 5 are so small that the sixth power of a step is visible, so it is
/// eliminated: `e(h) = a h^5 + b h^6 + c h^7` gives `64 e(h/2) - e(h) = a h^5 - c h^7/2`.
fn order_of_five(method: &str, name: &str, steps: usize, errors: impl Fn(usize) -> DVector<f64>) {
    let fifth = |steps: usize| (errors(2 * steps) * 64.0 - errors(steps)).amax();
    expect_order(&format!("{method} on {name}"), 5, steps, 1, fifth);
}

/// The group of maps `x -> a x + b`, which is not unimodular.
pub fn affine_line() -> MatrixGroup {
    MatrixGroup::new(&[dmatrix![1.0, 0.0; 0.0, 0.0], dmatrix![0.0, 1.0; 0.0, 0.0]]).unwrap()
}

#[test]
fn orders_on_so3() {
    orders("SO(3)", So3, &Vector3::new(0.9, -0.5, 1.1), [16, 64]);
    projected_orders("SO(3)", So3, &Vector3::new(0.9, -0.5, 1.1), 16);
}

#[test]
fn orders_on_se3() {
    orders("SE(3)", Se3, &Vector6::new(0.5, -0.3, 0.6, 0.4, 0.2, -0.5), [16, 64]);
    projected_orders("SE(3)", Se3, &Vector6::new(0.5, -0.3, 0.6, 0.4, 0.2, -0.5), 16);
}

#[test]
fn orders_on_se2() {
    orders("SE(2)", Se2, &Vector3::new(1.2, 0.8, -0.6), [16, 64]);
    projected_orders("SE(2)", Se2, &Vector3::new(1.2, 0.8, -0.6), 16);
}

#[test]
fn orders_on_sl2() {
    orders("SL(2)", Sl2, &Vector3::new(0.4, -0.5, 0.2), [16, 64]);
    projected_orders("SL(2)", Sl2, &Vector3::new(0.4, -0.5, 0.2), 16);
}

#[test]
fn orders_on_heisenberg() {
    orders("Heisenberg", Heisenberg::<Const<3>>::new(), &Vector3::new(0.9, -0.5, 1.1), [16, 64]);
    projected_orders(
        "Heisenberg",
        Heisenberg::<Const<3>>::new(),
        &Vector3::new(0.9, -0.5, 1.1),
        16,
    );
}

#[test]
fn orders_on_the_affine_line() {
    orders("the affine line", affine_line(), &DVector::from_vec(vec![0.6, 0.8]), [10, 64]);
}

/// Magnus methods agree with the equations of the matrix entries.
fn magnus<G: TranslationSplit<Element: PartialEq> + Clone>(name: &str, group: G, steps: usize) {
    let n = group.dimension();
    let velocity = move |t: f64| -> Vec<f64> {
        (0..n).map(|i| ((1.0 + i as f64) * t + i as f64).sin() + 0.3 * t).collect()
    };
    let rate = |t: f64| G::Vector::from_components(&velocity(t));
    let system = PrescribedVelocity { group: group.clone(), velocity: rate };
    let element = group.exp(&(G::Vector::from_fn(n, |i| 0.3 - 0.1 * i as f64)));
    let start = KinematicState { time: 0.3, element };
    let mut moved = start.clone();
    assert!(moved == start, "{name}");
    Magnus::Four.step(&system, &mut moved, 0.1).unwrap();
    assert!(moved != start, "{name}");
    let at = (0.3, &start.element, &[][..]);
    let (end, _) = entries(&group, at, 1.3, |t, _| velocity(t), |_, _, _| vec![]);
    let error = |method: Magnus, steps: usize| {
        (group.matrix(&run(&method, &system, &start, 1.0, steps).element) - &end).amax()
    };
    expect_order(&format!("Magnus 4, {name}"), 4, steps, 4, |n| error(Magnus::Four, n));
    expect_order(&format!("Magnus 6, {name}"), 6, steps, 2, |n| error(Magnus::Six, n));
}

#[test]
fn orders_of_magnus() {
    magnus("SO(3)", So3, 8);
    magnus("SE(3)", Se3, 16);
    magnus("SE(2)", Se2, 8);
    magnus("SL(2)", Sl2, 16);
    magnus("Heisenberg", Heisenberg::<Const<3>>::new(), 8);
    magnus("the affine line", affine_line(), 8);
}

/// `R = Rz(w t) Rx(b) Rz(-w t)`: the axis of the body moves on a cone.
#[test]
fn coning() {
    let (rate, lean) = (1.3, 0.4_f64);
    let about = |axis: Vector3<f64>, angle: f64| So3.exp(&(axis * angle));
    let exact = |t: f64| {
        about(Vector3::z(), rate * t) * about(Vector3::x(), lean) * about(Vector3::z(), -rate * t)
    };
    // R^-1 R' = w (Ad_{Rz Rx^-1 Rz^-1} z - z)
    let velocity = move |t: f64| {
        let lower = Vector3::new(-(rate * t).sin(), (rate * t).cos(), 0.0) * lean.sin();
        (lower + Vector3::z() * (lean.cos() - 1.0)) * rate
    };
    let derivative = So3.log(&(exact(0.7).inverse() * exact(0.7 + 1e-6))).unwrap() * 1e6;
    assert!((velocity(0.7) - derivative).norm() < 1e-5);
    let system = PrescribedVelocity { group: So3, velocity };
    let start = KinematicState { time: 0.0, element: exact(0.0) };
    let error = |method: Magnus, steps: usize| {
        let end = run(&method, &system, &start, 20.0, steps).element;
        So3.log(&(exact(20.0).inverse() * end)).unwrap().norm()
    };
    expect_order("Magnus 4, coning", 4, 100, 4, |n| error(Magnus::Four, n));
    expect_order("Magnus 6, coning", 6, 50, 2, |n| error(Magnus::Six, n));
    assert!(error(Magnus::Six, 2000) < 1e-12, "{:e}", error(Magnus::Six, 2000));
}

/// A body with a dense inertia.
fn inertia() -> (Inertia, Metric<f64>) {
    let matrix = Matrix3::new(1.0, 0.1, -0.05, 0.1, 0.8, 0.1, -0.05, 0.1, 0.7);
    let metric = Tensor::from_fn(3, [Down, Down], |[i, j]| matrix[(i, j)]).unwrap();
    let metric = Metric::new(So3.algebra().unwrap().labels(), metric).unwrap();
    (Inertia::new(&matrix).unwrap(), metric)
}

const VELOCITY: Vector3<f64> = Vector3::new(1.9, -0.7, 1.2);

/// The error of `R` and the velocity after one unit of time, compared with elliptic functions.
fn free_error(method: &impl Integrator<EulerPoincare<So3, Free>>, steps: usize) -> f64 {
    free_error_at(1.0, method, steps)
}

fn free_error_at(
    time: f64,
    method: &impl Integrator<EulerPoincare<So3, Free>>,
    steps: usize,
) -> f64 {
    let (inertia, metric) = inertia();
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(So3, &connection, &metric).unwrap();
    let start = system.state(0.0, So3.exp(&Vector3::new(0.3, 1.0, -0.4)), &VELOCITY);
    let exact = BodyState { attitude: start.element, momentum: inertia.momentum(&VELOCITY) };
    let exact = FreeBody::new(&inertia, &exact).unwrap().at(time);
    let end = run(method, &system, &start, time, steps);
    assert_eq!(end.spatial, start.spatial);
    assert!((end.time - time).abs() < 1e-12);
    let turn = (end.element.coords - exact.attitude.coords).norm();
    turn.max((system.momentum(&end) - exact.momentum).norm())
}

#[test]
fn orders_of_the_free_body() {
    let (inertia, _) = inertia();
    let wong = SimoWong::new(&inertia);
    expect_order("Simo-Wong", wong.order(), 32, 4, |n| free_error(&wong, n));
    let orders = [
        (MoserVeselovOrder::Two, 2, 32, 4),
        (MoserVeselovOrder::Four, 4, 16, 4),
        (MoserVeselovOrder::Six, 6, 8, 2),
        (MoserVeselovOrder::Eight, 8, 6, 2),
    ];
    for (order, nominal, steps, halvings) in orders {
        let method = MoserVeselov::new(&inertia, order);
        assert_eq!(method.order(), nominal);
        expect_order(&format!("{order:?}"), nominal, steps, halvings, |n| free_error(&method, n));
    }
    // for longer steps the next power is visible, for shorter ones rounding errors
    let ten = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten);
    expect_order("Ten", 10, 15, 1, |n| free_error_at(3.0, &ten, n));
    for order in [KickOrder::Two, KickOrder::Six] {
        let exact = Kick::new(&inertia, order, FreeMotion::Exact);
        assert!(free_error(&exact, 3) < 1e-14, "{:e}", free_error(&exact, 3));
    }
}

/// The torque depends on time, position and velocity.
#[test]
fn order_of_simo_wong_with_a_torque() {
    let (inertia, metric) = inertia();
    let case = case(So3, CanonicalConnection::Plus, &metric, &VELOCITY, 1.0, moment);
    expect_order("Simo-Wong", 2, 32, 4, |n| case.error(&SimoWong::new(&inertia), n));
}

/// The potential depends on time and position.
fn potential(time: f64, matrix: &DMatrix<f64>, _: &[f64]) -> Vec<f64> {
    let down = Vector3::new(matrix[(2, 0)], matrix[(2, 1)], matrix[(2, 2)]);
    let pull = Vector3::new(0.3, -0.2, 1.0).cross(&down) * (-2.0 + time.sin());
    (pull + Vector3::new(0.0, matrix[(0, 0)], 0.0)).as_slice().to_vec()
}

#[test]
fn orders_of_kicks() {
    let (inertia, metric) = inertia();
    let case = case(So3, CanonicalConnection::Plus, &metric, &VELOCITY, 1.0, potential);
    for motion in [FreeMotion::Exact, FreeMotion::MoserVeselov(MoserVeselovOrder::Ten)] {
        let of = |order| Kick::new(&inertia, order, motion);
        let orders =
            [(KickOrder::Two, 2, 16, 4), (KickOrder::Four, 4, 8, 4), (KickOrder::Six, 6, 4, 2)];
        for (order, nominal, steps, halvings) in orders {
            let method = of(order);
            assert_eq!(method.order(), nominal);
            let name = format!("{order:?} {motion:?}");
            expect_order(&name, nominal, steps, halvings, |n| case.error(&method, n));
        }
        // agrees with compositions of steps of order 2: the triple jump, and Suzuki's five steps
        let composed = |shares: &[f64], steps: usize| {
            let (mut state, two) = (case.start.clone(), of(KickOrder::Two));
            for _ in 0..steps {
                for share in shares {
                    two.step(&case.system, &mut state, share / steps as f64).unwrap();
                }
            }
            (So3.matrix(&state.element) - &case.end.0).amax()
        };
        let outer = 1.0 / (2.0 - 2.0_f64.cbrt());
        let jump = composed(&[outer, 1.0 - 2.0 * outer, outer], 40);
        let outer = 1.0 / (4.0 - 4.0_f64.cbrt());
        let suzuki = composed(&[outer, outer, 1.0 - 4.0 * outer, outer, outer], 24);
        let four = case.error(&of(KickOrder::Four), 20);
        let six = case.error(&of(KickOrder::Six), 11);
        let errors = [jump, suzuki, four, six];
        assert!(four < 0.1 * suzuki && suzuki < jump && six < 0.1 * four, "{errors:?}");
    }
}

/// An adaptive run depends only on its state and its next step size: it continues from them to the
/// last bit.
#[test]
fn an_adaptive_run_goes_on() {
    let (_, metric) = inertia();
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let torque = |time: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| Vector3::x() * time.sin();
    let system = EulerPoincare::new(So3, &connection, &metric, torque).unwrap();
    let start = system.state(0.0, So3.identity(), &VELOCITY);
    let method = Adaptive::new(1e-10);
    let whole = method.states(&system, &start, &[5.0]).unwrap().remove(0);
    let (mut state, mut next, mut steps) = (start, method.first_step(), 0);
    while state.time != 5.0 {
        // as if read from a file
        (state, next) = (state.clone(), f64::from_bits(next.to_bits()));
        method.step(&system, &mut state, &mut next, 5.0).unwrap();
        steps += 1;
    }
    assert!(steps > 20);
    assert_eq!(
        (state.time, state.element, state.spatial),
        (whole.time, whole.element, whole.spatial)
    );
    let end = ode_end(&system, &metric, torque);
    assert!((system.velocity(&state) - end).norm() < 1e-8);
}

/// Methods for a free body reject a torque and leave the state unchanged.
#[test]
fn methods_for_a_free_body_refuse_a_torque() {
    let (inertia, metric) = inertia();
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let torque = |_: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| Vector3::x();
    let system = EulerPoincare::new(So3, &connection, &metric, torque).unwrap();
    let start = system.state(0.0, So3.identity(), &VELOCITY);
    let discrete = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten);
    let mut state = start.clone();
    let error = Integrator::<EulerPoincare<So3, _>>::step(&discrete, &system, &mut state, 0.1);
    let error = error.unwrap_err();
    assert!(matches!(error, Error::Integration { t: 0.0, .. }), "{error}");
    assert_eq!((state.time, state.element), (start.time, start.element));
}

/// The first step is proportional to the time scale of the state, in any unit of time.
#[test]
fn a_first_step_by_the_time_scale() {
    let (_, metric) = inertia();
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let method = Adaptive::of_order_8(1e-8);
    let free = EulerPoincare::free(So3, &connection, &metric).unwrap();
    let first = |unit: f64| {
        let state = free.state(0.0, So3.identity(), &(VELOCITY / unit));
        method.first_step_from(&free, &state)
    };
    assert!((first(1.0) * VELOCITY.amax() - 0.1).abs() < 1e-15);
    assert!((first(3600.0) / first(1.0) - 3600.0).abs() < 1e-9);
    // at rest there is no time scale
    assert_eq!(first(f64::INFINITY), method.first_step());
    // a torque that changes the momentum faster than the body rotates
    let torque = |_: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| Vector3::x() * 1e3;
    let pushed = EulerPoincare::new(So3, &connection, &metric, torque).unwrap();
    let state = pushed.state(0.0, So3.identity(), &VELOCITY);
    let scale = pushed.momentum(&state).amax() / 1e3;
    assert!((method.first_step_from(&pushed, &state) / scale - 0.1).abs() < 1e-15);
    let longest = Adaptive { max_step: 1e-9, ..method };
    assert_eq!(longest.first_step_from(&pushed, &state), 1e-9);
}

/// The velocity at time 5, by Euler's equations.
fn ode_end<M: Torque<So3>>(
    system: &EulerPoincare<So3, M>,
    metric: &Metric<f64>,
    torque: impl Fn(f64, &UnitQuaternion<f64>, &Vector3<f64>) -> Vector3<f64>,
) -> Vector3<f64> {
    let connection =
        Connection::canonical(&system.group().algebra().unwrap(), CanonicalConnection::Plus);
    let equations = Equations::euler_poincare(&connection, metric).unwrap();
    let rates = |t: f64, omega: &DVector<f64>| {
        let moment = torque(t, &So3.identity(), &Vector3::zeros());
        DVector::from_vec(equations.rate(omega.as_slice(), moment.as_slice()).unwrap())
    };
    let start = DVector::from_column_slice(VELOCITY.as_slice());
    let end = ode::solve(rates, 0.0, start, &[5.0], 1e-13).remove(0);
    Vector3::from_column_slice(end.as_slice())
}

/// Integrators of a body reject other systems; kicks reject a torque that depends on the velocity.
#[test]
fn what_is_not_meant_is_refused() {
    let (inertia, metric) = inertia();
    let other = Inertia::diagonal(&Vector3::new(1.0, 0.8, 0.7)).unwrap();
    let algebra = So3.algebra().unwrap();
    let of =
        |which| EulerPoincare::free(So3, &Connection::canonical(&algebra, which), &metric).unwrap();
    let (plus, zero) = (of(CanonicalConnection::Plus), of(CanonicalConnection::Zero));
    for (system, inertia) in [(&plus, &other), (&zero, &inertia)] {
        let mut state = system.state(0.0, So3.identity(), &VELOCITY);
        let methods: [&dyn Integrator<EulerPoincare<So3, Free>>; 3] = [
            &SimoWong::new(inertia),
            &MoserVeselov::new(inertia, MoserVeselovOrder::Six),
            &Kick::new(inertia, KickOrder::Two, FreeMotion::Exact),
        ];
        for method in methods {
            let refused = method.step(system, &mut state, 0.1);
            assert!(matches!(refused, Err(Error::Invalid { what: "inertia", .. })), "{refused:?}");
        }
        assert_eq!(state.time, 0.0);
    }
    // the moments of the system to rounding errors
    for (error, accepted) in [(1e-15, true), (1e-13, true), (1e-9, false), (1e-5, false)] {
        let nearly = Inertia::new(&(inertia.matrix() * (1.0 + error))).unwrap();
        let mut state = plus.state(0.0, So3.identity(), &VELOCITY);
        let step = SimoWong::new(&nearly).step(&plus, &mut state, 0.1);
        assert_eq!(step.is_ok(), accepted, "{error}");
    }
    let connection = Connection::canonical(&algebra, CanonicalConnection::Plus);
    let drag = |_: f64, _: &UnitQuaternion<f64>, omega: &Vector3<f64>| -omega;
    let system = EulerPoincare::new(So3, &connection, &metric, drag).unwrap();
    let mut state = system.state(0.0, So3.identity(), &VELOCITY);
    let kick = Kick::new(&inertia, KickOrder::Two, FreeMotion::Exact);
    assert!(matches!(kick.step(&system, &mut state, 0.1), Err(Error::Integration { .. })));
    assert!(SimoWong::new(&inertia).step(&system, &mut state, 0.1).is_ok());
}

#[test]
fn steps_without_a_solution_are_refused() {
    let (inertia, metric) = inertia();
    let connection = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(So3, &connection, &metric).unwrap();
    let start = system.state(0.0, So3.identity(), &(VELOCITY * 1e3));
    let methods: [&dyn Integrator<EulerPoincare<So3, Free>>; 2] =
        [&SimoWong::new(&inertia), &MoserVeselov::new(&inertia, MoserVeselovOrder::Two)];
    for (method, h) in methods.iter().flat_map(|m| [1.0, f64::NAN, f64::INFINITY].map(|h| (m, h))) {
        let mut state = start.clone();
        let error = method.step(&system, &mut state, h).unwrap_err();
        assert!(matches!(error, Error::Integration { t: 0.0, .. }), "{error}");
    }
}

/// Steps that are not positive are errors, and do not run for ever.
#[test]
fn tolerances_and_steps_are_positive() {
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let body =
        EulerPoincare::free(So3, &plus, &Metric::diagonal([1.0, 2.0, 3.0]).unwrap()).unwrap();
    let start = body.state(0.0, So3.identity(), &Vector3::new(0.3, 1.0, 0.5));
    let run = |tolerance: f64, max_step: f64| {
        let control = Adaptive { max_step, ..Adaptive::new(tolerance) };
        control.states(&body, &start, &[1.0])
    };
    assert!(run(1e-9, 0.5).is_ok());
    for (tolerance, longest) in [(1e-9, -1.0), (1e-9, 0.0), (-1e-9, 1.0), (f64::NAN, 1.0)] {
        let refused = run(tolerance, longest).unwrap_err().to_string();
        assert!(refused.contains("are positive"), "{tolerance} {longest}: {refused}");
    }
    for end in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let message = format!("the end is {end}, which is not finite");
        let control = Adaptive::new(1e-9);
        let refused = control.states(&body, &start, &[0.5, end]).unwrap_err().to_string();
        assert!(refused.contains("t = 0.5") && refused.contains(&message), "{refused}");
        let refused = control.run(&body, &start, end, vec![]).unwrap_err().to_string();
        assert!(refused.contains(&message), "{refused}");
    }
    let translation = ParallelTranslation::new(So3, plus.clone()).unwrap();
    let along = |tolerance| translation.along_curve(|_| Vector3::x(), &[0.0, 1.0], tolerance);
    assert!(along(1e-9).is_ok());
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert!(along(tolerance).unwrap_err().to_string().contains("is not positive"));
    }
}
