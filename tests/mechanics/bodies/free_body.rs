//! The free rigid body: the exact solution agrees with Taylor series in 50 digits, its invariants
//! are conserved, and steps agree with it.

use crate::common::property::properties;
use crate::ode;
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::{BodyState, FreeBody, Inertia, MoserVeselov};
use nalgebra::{DVector, Matrix3, Quaternion, UnitQuaternion, Vector3, dvector};
use proptest::prelude::*;
use std::f64::consts::TAU;

struct Reference {
    name: &'static str,
    inertia: Inertia,
    start: BodyState,
    time: f64,
    end: BodyState,
}

fn state(numbers: &[f64]) -> BodyState {
    let q = Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3]);
    let momentum = Vector3::from_column_slice(&numbers[4..7]);
    BodyState { attitude: UnitQuaternion::new_unchecked(q), momentum }
}

fn references() -> Vec<Reference> {
    let line = |line: &'static str| {
        let (name, numbers) = line.split_once(' ').unwrap();
        let n: Vec<f64> = numbers.split(' ').map(|number| number.parse().unwrap()).collect();
        let inertia = Inertia::new(&Matrix3::from_row_slice(&n[..9])).unwrap();
        Reference { name, inertia, start: state(&n[9..16]), time: n[16], end: state(&n[17..24]) }
    };
    include_str!("../../data/free_body.txt").lines().map(line).collect()
}

/// The larger of the distances of quaternions (including their sign) and of momenta.
fn distance(x: &BodyState, y: &BodyState) -> f64 {
    let turn = (x.attitude.coords - y.attitude.coords).norm();
    turn.max((x.momentum - y.momentum).norm())
}

fn body(moments: [f64; 3], momentum: [f64; 3]) -> FreeBody {
    let inertia = Inertia::diagonal(&moments.into()).unwrap();
    FreeBody::new(&inertia, &start(momentum)).unwrap()
}

fn start(momentum: [f64; 3]) -> BodyState {
    BodyState { attitude: UnitQuaternion::identity(), momentum: momentum.into() }
}

#[test]
fn states_are_those_of_taylor_series() {
    let references = references();
    assert!(references.len() > 120);
    for Reference { name, inertia, start, time, end } in references {
        let found = FreeBody::new(&inertia, &start).unwrap().at(time);
        // the rounding errors of the angle; near the middle axis neighbouring motions diverge
        let angle = (inertia.velocity(&start.momentum).norm() * time).abs();
        let unstable = ["near-middle", "near-sep", "dzhan"].iter().any(|x| name.starts_with(x));
        // the principal axes of a dense matrix have a few rounding errors
        let factor = if unstable { 10.0 } else { f64::from(1 + u8::from(name == "dense")) };
        let tolerance = 4e-16 * (10.0 + angle) * factor;
        let error = distance(&found, &end);
        assert!(error < tolerance, "{name} at {time}: {error:e}, more than {tolerance:e}");
        if name == "hairer-vilmart" {
            assert!(error < 1e-13);
        }
    }
}

#[test]
fn periods_have_twelve_digits() {
    let cases = [
        ([0.6, 0.8, 1.0], [1.8, 0.4, -0.9], 6.862_616_178_058_116),
        ([3.0, 5.0, 9.0], [0.0, 2.0, 0.01], 118.110_887_046_385_74),
        ([1.0, 2.0, 3.0], [0.0, 2.0, 1e-6], 109.126_898_549_993_9),
        ([2.0, 1.0, 2.0 / 3.0], [1.1_f64.cos(), 0.0, 1.1_f64.sin()], 10.731_465_234_882_824),
        ([1.0, 2.0, 3.0], [3.0, 0.5, 1.0 / 3.0], 3.625_056_356_571_289),
    ];
    for (moments, momentum, period) in cases {
        let body = body(moments, momentum);
        let found = body.period().unwrap();
        assert!((found / period - 1.0).abs() < 1e-14, "{found}, not {period}");
        let back = body.at(period).momentum;
        assert!((back - Vector3::from(momentum)).norm() < 1e-13, "{momentum:?} {back}");
        // half of the period changes two signs, and no smaller time restores all components
        let half = body.at(period / 2.0).momentum;
        let signs = half.component_div(&Vector3::from(momentum)).map(f64::signum);
        assert!((half.abs() - Vector3::from(momentum).abs()).norm() < 1e-13, "{half} {signs}");
        assert!((half - Vector3::from(momentum)).norm() > 1e-3);
    }
}

#[test]
fn the_separatrix_is_sech_and_tanh() {
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let [x, z] = [signs[0], signs[1] * 3.0_f64.sqrt()];
        let body = body([1.0, 2.0, 3.0], [x, 0.0, z]);
        assert_eq!(body.period(), None);
        for time in [0.0, 0.3, -2.0, 5.0, -20.0, 60.0, 1e3, -1e6] {
            let u = time / 3.0_f64.sqrt();
            let exact =
                Vector3::new(x / u.cosh(), 2.0 * signs[0] * signs[1] * u.tanh(), z / u.cosh());
            let state = body.at(time);
            assert!((state.momentum - exact).norm() < 4e-15, "{time}: {}", state.momentum);
            assert!((state.space_momentum() - Vector3::new(x, 0.0, z)).norm() < 4e-15);
        }
        // at the end the rotation about the middle axis is steady, at |H|/J_2 = 1
        let (q, p) = (body.at(100.0).attitude, body.at(101.0).attitude);
        assert!((q.angle_to(&p) - 1.0).abs() < 1e-13);
    }
}

#[test]
fn a_body_turned_about_its_middle_axis_flips() {
    let body = body([1.0, 2.0, 3.0], [0.0, 2.0, 1e-6]);
    let period = body.period().unwrap();
    // nearly all the time the middle axis is parallel or antiparallel to the momentum
    let along = |t: f64| (body.at(t).attitude * Vector3::y()).y;
    for (share, sign) in
        [(0.0, 1.0), (0.1, 1.0), (0.2, 1.0), (0.3, -1.0), (0.5, -1.0), (0.7, -1.0), (0.8, 1.0)]
    {
        let y = along(share * period);
        assert!((y - sign).abs() < 0.05, "{share}: {y}");
    }
}

/// Checks that momentum in space, energy and length of `H` are as at the start.
fn assert_invariants(inertia: &Inertia, start: &BodyState, state: &BodyState, tolerance: f64) {
    let size = start.momentum.norm();
    let space = (state.space_momentum() - start.space_momentum()).norm() / size;
    assert!(space < tolerance, "R H moved by {space:e}");
    let [before, after] = [start, state].map(|state| inertia.energy(&state.momentum));
    assert!((after / before - 1.0).abs() < tolerance, "energy {before}, then {after}");
    assert!((state.attitude.norm() - 1.0).abs() < 1e-15);
}

#[test]
fn nothing_drifts_in_a_million() {
    for Reference { inertia, start, .. } in references() {
        let body = FreeBody::new(&inertia, &start).unwrap();
        for time in [1e3, -1e4, 1e5, 1e6, 1e12] {
            // the energy of the needle is in its small moment
            assert_invariants(&inertia, &start, &body.at(time), 2e-14);
        }
    }
}

/// Moments in `[0.3, 4]`, sometimes with equal ones.
fn moments() -> impl Strategy<Value = [f64; 3]> {
    let moment = 0.3..4.0;
    (moment.clone(), moment.clone(), moment, 0..6).prop_map(|(x, y, z, kind)| match kind {
        0 => [x, x, z],
        1 => [x, y, y],
        2 => [x, y, x],
        _ => [x, y, z],
    })
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    (-2.0..2.0, -2.0..2.0, -2.0..2.0).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    vector().prop_map(UnitQuaternion::new)
}

/// The body in axes that are rotated by `a`.
fn turned(moments: [f64; 3], a: &UnitQuaternion<f64>) -> Inertia {
    let a = a.to_rotation_matrix().into_inner();
    Inertia::new(&(a * Matrix3::from_diagonal(&moments.into()) * a.transpose())).unwrap()
}

/// The time derivative of `y = (q, H)`.
fn rate(inertia: &Inertia, y: &DVector<f64>) -> DVector<f64> {
    let (q, momentum) = (Quaternion::new(y[0], y[1], y[2], y[3]), Vector3::new(y[4], y[5], y[6]));
    let velocity = inertia.velocity(&momentum);
    let q = q * Quaternion::from_imag(velocity) * 0.5;
    let h = momentum.cross(&velocity);
    dvector![q.w, q.i, q.j, q.k, h.x, h.y, h.z]
}

properties! {
    #![cases(256)]

    #[test]
    fn short_motions_are_those_of_an_ode(
        moments in moments(), a in rotation(), momentum in vector(), attitude in rotation(), time in -3.0..3.0,
    ) {
        let (inertia, start) = (turned(moments, &a), BodyState { attitude, momentum });
        let q = attitude.quaternion();
        let y = dvector![q.w, q.i, q.j, q.k, momentum.x, momentum.y, momentum.z];
        let end = ode::solve(|_, y| rate(&inertia, y), 0.0, y, &[time], 1e-13);
        let found = FreeBody::new(&inertia, &start).unwrap().at(time);
        prop_assert!(distance(&found, &state(end[0].as_slice())) < 1e-10);
    }

    #[test]
    fn the_axes_of_the_body_are_a_choice(
        moments in moments(), a in rotation(), momentum in vector(), attitude in rotation(), time in -50.0..50.0,
    ) {
        let plain = Inertia::diagonal(&moments.into()).unwrap();
        let exact = FreeBody::new(&plain, &BodyState { attitude, momentum }).unwrap().at(time);
        let start = BodyState { attitude: attitude * a.inverse(), momentum: a * momentum };
        let found = FreeBody::new(&turned(moments, &a), &start).unwrap().at(time);
        let moved = BodyState { attitude: exact.attitude * a.inverse(), momentum: a * exact.momentum };
        // neighbours of an unstable motion diverge like exp(time)
        prop_assert!(distance(&found, &moved) < 1e-9);
    }

    #[test]
    fn a_motion_goes_on_from_where_it_is(
        moments in moments(), a in rotation(), momentum in vector(), attitude in rotation(),
        first in -20.0..20.0, second in -20.0..20.0,
    ) {
        let (inertia, start) = (turned(moments, &a), BodyState { attitude, momentum });
        let body = FreeBody::new(&inertia, &start).unwrap();
        prop_assert!(distance(&body.at(0.0), &start) < 1e-14);
        let later = FreeBody::new(&inertia, &body.at(first)).unwrap().at(second);
        let mut whole = body.at(first + second);
        prop_assert!(distance(&later, &whole) < 1e-9);
        assert_invariants(&inertia, &start, &whole, 1e-13);
        // after a period the body is rotated about the momentum
        if let Some(phase) = body.phase() {
            whole = body.at(first + phase.period);
            let axis = nalgebra::Unit::new_normalize(start.space_momentum());
            let turn = UnitQuaternion::from_axis_angle(&axis, phase.total);
            let part = body.at(first);
            let expected = BodyState { attitude: turn * part.attitude, ..part };
            prop_assert!(distance(&whole, &expected) < 1e-13 * (10.0 + phase.total.abs()));
        }
    }

    #[test]
    fn the_geometric_phase_is_a_solid_angle(moments in moments(), momentum in vector()) {
        let inertia = Inertia::diagonal(&moments.into()).unwrap();
        let body = FreeBody::new(&inertia, &BodyState { attitude: UnitQuaternion::identity(), momentum }).unwrap();
        let Some(phase) = body.phase() else { return Ok(()) };
        if phase.period > 40.0 {
            return Ok(()); // more points would be needed
        }
        // H circulates about the axis whose component does not change its sign
        let count = 2000;
        let times = (0..count).map(|i| phase.period * f64::from(i) / f64::from(count));
        let curve: Vec<_> = times.map(|t| body.at(t).momentum / momentum.norm()).collect();
        let axis = (0..3).max_by(|&i, &j| {
            let least = |i: usize| curve.iter().map(|m| m[i].abs()).fold(f64::INFINITY, f64::min);
            least(i).total_cmp(&least(j))
        }).unwrap();
        let mut n = Vector3::zeros();
        n[axis] = curve[0][axis].signum();
        // the integral of (1 - cos) d(longitude)
        let area: f64 = curve.iter().map(|m| {
            let rate = (m * momentum.norm()).cross(&inertia.velocity(m));
            n.dot(&m.cross(&rate)) / (1.0 + n.dot(m))
        }).sum::<f64>() * phase.period / f64::from(count);
        let difference = (phase.geometric + area) / TAU;
        prop_assert!((difference - difference.round()).abs() < 1e-9, "{difference}");
        let energy = inertia.energy(&momentum);
        let dynamic = 2.0 * energy * phase.period / momentum.norm();
        prop_assert!((phase.dynamic / dynamic - 1.0).abs() < 1e-13);
    }

    #[test]
    fn extreme_bodies_neither_panic_nor_hang(
        exponents in prop::array::uniform6(-120..120), time in prop::num::f64::ANY, mantissas in prop::array::uniform6(-1.0..1.0),
    ) {
        let number = |i: usize| mantissas[i] * 10_f64.powi(exponents[i]);
        let moments = Vector3::new(number(0), number(1), number(2)).abs();
        let Ok(inertia) = Inertia::diagonal(&moments) else { return Ok(()) };
        let momentum = Vector3::new(number(3), number(4), number(5));
        prop_assume!(momentum != Vector3::zeros());
        let start = BodyState { attitude: UnitQuaternion::identity(), momentum };
        if let Ok(body) = FreeBody::new(&inertia, &start) {
            let time = time.clamp(-1.0, 1.0) / inertia.velocity(&momentum).amax();
            let state = body.at(time);
            let length = state.momentum.norm() / momentum.norm();
            prop_assert!((length - 1.0).abs() < 1e-12 || !time.is_finite(), "{length} {body:?}");
            let unit = (state.attitude.norm() - 1.0).abs() < 1e-12;
            prop_assert!(unit || !time.is_finite(), "{state:?} {body:?}");
            body.at(time);
        }
        let _ = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten).steps(&start, time, 3);
    }
}

#[test]
fn a_symmetric_top_precesses_evenly() {
    for (moments, axis) in [([1.0, 1.0, 2.0], 2), ([2.0, 1.0, 1.0], 0), ([1.0, 3.0, 1.0], 1)] {
        let momentum = Vector3::new(0.4, -0.9, 1.1);
        let body = body(moments, momentum.into());
        let (equal, other) = (moments[(axis + 1) % 3], moments[axis]);
        let mut own = Vector3::zeros();
        own[axis] = momentum[axis] * (1.0 / other - 1.0 / equal);
        for time in [0.1, -3.0, 100.0, 1e4] {
            // R = R0 exp(t H0/J) exp(t own)
            let spin = UnitQuaternion::new(own * time);
            let attitude = UnitQuaternion::new(momentum * (time / equal)) * spin;
            let exact = BodyState { attitude, momentum: spin.inverse() * momentum };
            assert!(
                distance(&body.at(time), &exact) < 1e-15 * (5.0 + time.abs()),
                "{moments:?} {time}"
            );
        }
    }
}

#[test]
fn equal_moments_are_the_limit_of_nearly_equal_ones() {
    for momentum in
        [[0.5, -0.7, 0.3], [0.5, -0.7, 1e-5], [1e-5, 0.7, 0.4], [0.0, 0.7, 0.4], [0.6, 0.7, 0.0]]
    {
        for moments in [[1.0, 1.0, 2.0], [1.0, 2.0, 2.0], [1.5, 1.5, 1.5]] {
            let exact = body(moments, momentum).at(7.0);
            for gap in [1e-4, 1e-7, 1e-10, 1e-13, f64::EPSILON] {
                for other in [1.0 + gap, 1.0 - gap] {
                    let [x, y, z] = moments;
                    let error = distance(&body([x, y * other, z], momentum).at(7.0), &exact);
                    assert!(
                        error < 10.0 * gap + 1e-14,
                        "{moments:?} {momentum:?} {gap}: {error:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn steady_turns_and_rest() {
    let q = UnitQuaternion::new(Vector3::new(0.3, -0.2, 1.0));
    let inertia = Inertia::diagonal(&Vector3::new(1.0, 2.0, 3.0)).unwrap();
    for momentum in [Vector3::x(), -2.0 * Vector3::y(), 3.0 * Vector3::z(), Vector3::zeros()] {
        let body = FreeBody::new(&inertia, &BodyState { attitude: q, momentum }).unwrap();
        let end = body.at(-4.0);
        assert_eq!((end.momentum, body.period()), (momentum, None));
        let turn = UnitQuaternion::new(inertia.velocity(&momentum) * -4.0);
        assert!((end.attitude.coords - (q * turn).coords).norm() < 1e-15);
    }
    let bad = BodyState { attitude: q, momentum: Vector3::new(f64::NAN, 0.0, 0.0) };
    assert!(FreeBody::new(&inertia, &bad).is_err());
    assert!(Inertia::diagonal(&Vector3::new(1.0, 0.0, 1.0)).is_err());
    assert!(Inertia::new(&Matrix3::new(1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0)).is_err());
    assert!(Inertia::new(&Matrix3::new(1.0, 0.1, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0, 1.0)).is_err());
}

#[test]
fn the_equations_are_those_of_the_plus_connection() {
    use affinor::geometry::equations::Equations;
    use affinor::group::{LieGroup, So3};
    use affinor::{CanonicalConnection, Connection, Metric};
    use affinor_tensors::{Down, Tensor};
    let algebra = So3.algebra().unwrap();
    let inertia = turned([0.6, 0.8, 1.3], &UnitQuaternion::new(Vector3::new(0.3, -0.2, 1.0)));
    let matrix = So3.operator_matrix(|x| inertia.momentum(x));
    let components = (0..9).map(|at| [at / 3, at % 3]).map(|[i, j]| {
        ([i, j], 0.5 * (matrix[(i, j)] + matrix[(j, i)])) // symmetric to the last digit
    });
    let metric = Tensor::from_components(3, &[Down, Down], components).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    let euler = Equations::euler_poincare(&plus, &metric).unwrap();
    let start =
        BodyState { attitude: UnitQuaternion::identity(), momentum: Vector3::new(1.8, 0.4, -0.9) };
    let omega = inertia.velocity(&start.momentum);
    let rate =
        |_: f64, y: &DVector<f64>| DVector::from_vec(euler.rate(y.as_slice(), &[0.0; 3]).unwrap());
    let times = [0.5, 2.0];
    let found = ode::solve(rate, 0.0, DVector::from_column_slice(omega.as_slice()), &times, 1e-12);
    let body = FreeBody::new(&inertia, &start).unwrap();
    for (time, found) in times.into_iter().zip(found) {
        assert!(
            (body.velocity(time) - Vector3::from_column_slice(found.as_slice())).norm() < 1e-10
        );
    }
}

#[test]
fn a_million_steps_keep_what_is_kept() {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).unwrap();
    let start = start([1.8, 0.4, -0.9]);
    for order in [
        MoserVeselovOrder::Two,
        MoserVeselovOrder::Four,
        MoserVeselovOrder::Six,
        MoserVeselovOrder::Eight,
        MoserVeselovOrder::Ten,
    ] {
        let end = MoserVeselov::new(&inertia, order).steps(&start, 0.05, 1_000_000).unwrap();
        let energy = inertia.energy(&end.momentum) / inertia.energy(&start.momentum) - 1.0;
        let space = (end.space_momentum() - start.momentum).norm();
        let unit = (end.attitude.norm() - 1.0).abs();
        assert!(energy.abs() < 5e-13, "{order:?}: {energy:e}");
        assert!(space < 5e-12, "{order:?}: {space:e}");
        assert!(unit < 2e-15, "{order:?}: {unit:e}");
    }
}

properties! {
    #![cases(256)]

    #[test]
    fn steps_follow_the_motion_in_any_axes(
        moments in moments(), a in rotation(), momentum in vector(), attitude in rotation(), step in -0.02..0.02,
    ) {
        let (inertia, start) = (turned(moments, &a), BodyState { attitude, momentum });
        let exact = FreeBody::new(&inertia, &start).unwrap().at(20.0 * step);
        let method = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten);
        let end = method.steps(&start, step, 20).unwrap();
        prop_assert!(distance(&end, &exact) < 1e-12);
        // and the inverse
        prop_assert!(distance(&method.steps(&end, -step, 20).unwrap(), &start) < 1e-13);
        // one by one gives the same
        let mut state = start;
        for _ in 0..20 {
            state = method.step(&state, step).unwrap();
        }
        prop_assert!(distance(&state, &end) < 1e-13);
    }
}

#[test]
fn a_step_that_is_too_long_is_refused() {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).unwrap();
    let start = start([1.8, 0.4, -0.9]);
    for order in [
        MoserVeselovOrder::Two,
        MoserVeselovOrder::Four,
        MoserVeselovOrder::Six,
        MoserVeselovOrder::Eight,
        MoserVeselovOrder::Ten,
    ] {
        assert!(MoserVeselov::new(&inertia, order).steps(&start, 30.0, 10).is_err(), "{order:?}");
    }
}

/// The rate bounds the angular velocity and the angular frequency of `H`, also of moments that no masses have.
#[test]
fn rates_are_bounds() {
    let momenta = [[0.05, 0.05, 1.0], [1.0, 0.05, 0.05], [0.4, -0.5, 0.6], [1e-9, 0.0, 3.0]];
    for moments in [[1.0, 1.2, 1.5], [1.0, 1.2, 50.0], [1.0, 30.0, 50.0], [0.01, 1.0, 1.1]] {
        for momentum in momenta {
            let body = body(moments, momentum);
            let bound = body.rate() * (1.0 + 1e-12);
            let fastest = (0..100).map(|k| body.velocity(0.3 * f64::from(k)).norm());
            assert!(fastest.fold(0.0, f64::max) <= bound, "{moments:?} {momentum:?}");
            let frequency = body.period().map_or(0.0, |period| std::f64::consts::TAU / period);
            assert!(frequency <= bound, "{moments:?} {momentum:?}: {frequency} {bound}");
        }
    }
}
