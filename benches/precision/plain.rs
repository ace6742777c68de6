//! Motions as they would be written without affinor: quaternion and body momentum as plain numbers.

use crate::problem::{Problem, rows};
use crate::satellite::Gravity;
use crate::sweep::{Seen, Sweep, per_step};
use affinor::group::{Se3, So3};
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::{Isometry3, Quaternion, SVector, UnitQuaternion, Vector3, Vector4};
use std::hint::black_box;

/// The rates of a body in a potential `w . R^T e_3`: of `x, y, z, w` and of `H`.
fn body_rates(
    moments: Vector3<f64>,
    weight: Vector3<f64>,
) -> impl Fn(f64, &SVector<f64, 7>, &mut SVector<f64, 7>) {
    let heavy = weight != Vector3::zeros();
    move |_, y, rate| {
        let q = Quaternion::from(Vector4::new(y[0], y[1], y[2], y[3]));
        let momentum = Vector3::new(y[4], y[5], y[6]);
        let velocity = momentum.component_div(&moments);
        let turn = (q * Quaternion::from_imag(velocity)).coords * 0.5;
        let mut torque = momentum.cross(&velocity);
        if heavy {
            // R^T e_3
            let (i, j, k, w) = (q.i, q.j, q.k, q.w);
            let up = Vector3::new(
                2.0 * (i * k - w * j),
                2.0 * (j * k + w * i),
                1.0 - 2.0 * (i * i + j * j),
            );
            torque += up.cross(&weight);
        }
        *rate = SVector::from([turn.x, turn.y, turn.z, turn.w, torque.x, torque.y, torque.z]);
    }
}

fn body_seen(y: &SVector<f64, 7>) -> Seen {
    vec![rows(&So3, &attitude(y.as_slice())), y.as_slice()[4..].to_vec()]
}

fn attitude(y: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(y[3], y[0], y[1], y[2]))
}

/// The classical step; then the quaternion is normalized.
fn rk4<const N: usize>(
    rates: &impl Fn(f64, &SVector<f64, N>, &mut SVector<f64, N>),
    y: &mut SVector<f64, N>,
    t: f64,
    h: f64,
) {
    let mut k = [SVector::zeros(); 4];
    rates(t, y, &mut k[0]);
    rates(t + 0.5 * h, &(*y + k[0] * (0.5 * h)), &mut k[1]);
    rates(t + 0.5 * h, &(*y + k[1] * (0.5 * h)), &mut k[2]);
    rates(t + h, &(*y + k[2] * h), &mut k[3]);
    *y += (k[0] + (k[1] + k[2]) * 2.0 + k[3]) * (h / 6.0);
    let scale = 1.0 / (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]).sqrt();
    (0..4).for_each(|i| y[i] *= scale);
}

/// Both methods. The absolute tolerance of a component is the tolerance times its scale.
fn both<const N: usize>(
    sweep: &Sweep,
    few: u64,
    start: SVector<f64, N>,
    rates: &impl Fn(f64, &SVector<f64, N>, &mut SVector<f64, N>),
    scales: [f64; N],
    seen: impl Fn(&SVector<f64, N>) -> Seen,
) {
    let end = sweep.reference.time;
    let run = |n: u64| {
        let (mut y, h) = (black_box(start), end / n as f64);
        (0..n).for_each(|i| rk4(rates, &mut y, h * i as f64, h));
        Some(y)
    };
    sweep.fixed("Rust: RK4", few, run, &seen);
    let run = |tolerance: f64| {
        let right = |t: f64, y: &SVector<f64, N>, rate: &mut SVector<f64, N>| rates(t, y, rate);
        let absolute = scales.map(|scale| tolerance * scale);
        let method =
            ExplicitRungeKutta::dop853().rtol(tolerance).atol(absolute).max_steps(1_000_000);
        let solution =
            IVP::ode_from_fn(right, 0.0, end, black_box(start)).method(method).solve().ok()?;
        let steps = solution.t.len() as u64;
        solution.y.last().map(|y| (*y, steps))
    };
    sweep.tolerances("Rust: DOP853", run, |(y, _)| seen(y), |(_, steps)| *steps);
}

fn body_start(problem: &Problem) -> SVector<f64, 7> {
    let momentum = problem.inertia().momentum(&problem.velocity3());
    SVector::from([0.0, 0.0, 0.0, 1.0, momentum.x, momentum.y, momentum.z])
}

/// A body.
pub fn body(sweep: &Sweep, problem: &Problem, few: u64) {
    let moments = Vector3::from_column_slice(&problem.diagonal());
    let rates = body_rates(moments, problem.weight());
    both(sweep, few, body_start(problem), &rates, [1.0; 7], body_seen);
}

/// The cost of a step of the free body.
pub fn steps(problem: &Problem) {
    let moments = Vector3::from_column_slice(&problem.diagonal());
    let rates = body_rates(moments, problem.weight());
    let start = body_start(problem);
    per_step("Rust: RK4", "SO(3)", |count| {
        let mut y = black_box(start);
        (0..count).for_each(|i| rk4(&rates, &mut y, 0.05 * i as f64, 0.05));
        black_box(y);
    });
}

/// Kirchhoff's body in a fluid: quaternion, place, and both momenta.
pub fn kirchhoff(sweep: &Sweep, problem: &Problem, few: u64) {
    let diagonal = problem.diagonal();
    let mass = SVector::<f64, 6>::from_column_slice(&diagonal);
    let rates = move |_: f64, y: &SVector<f64, 13>, rate: &mut SVector<f64, 13>| {
        let q = Quaternion::from(Vector4::new(y[0], y[1], y[2], y[3]));
        let (pi, p) = (Vector3::new(y[7], y[8], y[9]), Vector3::new(y[10], y[11], y[12]));
        let omega = Vector3::new(pi.x / mass[0], pi.y / mass[1], pi.z / mass[2]);
        let v = Vector3::new(p.x / mass[3], p.y / mass[4], p.z / mass[5]);
        let turn = (q * Quaternion::from_imag(omega)).coords * 0.5;
        let place = UnitQuaternion::new_unchecked(q) * v;
        let (pi, p) = (pi.cross(&omega) + p.cross(&v), p.cross(&omega));
        rate.fixed_rows_mut::<4>(0).copy_from(&turn);
        rate.fixed_rows_mut::<3>(4).copy_from(&place);
        rate.fixed_rows_mut::<3>(7).copy_from(&pi);
        rate.fixed_rows_mut::<3>(10).copy_from(&p);
    };
    let momentum = SVector::<f64, 6>::from_column_slice(problem.velocity()).component_mul(&mass);
    let start = SVector::from_fn(|i, _| match i {
        3 => 1.0,
        7.. => momentum[i - 7],
        _ => 0.0,
    });
    both(sweep, few, start, &rates, [1.0; 13], |y| {
        let place = Vector3::new(y[4], y[5], y[6]);
        let pose = Isometry3::from_parts(place.into(), attitude(y.as_slice()));
        vec![rows(&Se3, &pose), y.as_slice()[7..].to_vec()]
    });
}

/// A satellite: quaternion, position, spin in body components, and velocity.
pub fn satellite(sweep: &Sweep, problem: &Problem, gravity: &Gravity, few: u64) {
    let rates = |_: f64, y: &SVector<f64, 13>, rate: &mut SVector<f64, 13>| {
        let q = Quaternion::from(Vector4::new(y[0], y[1], y[2], y[3]));
        let attitude = UnitQuaternion::new_unchecked(q);
        let omega = Vector3::new(y[7], y[8], y[9]);
        let turn = (q * Quaternion::from_imag(omega)).coords * 0.5;
        let (torque, force) = gravity.at(&attitude, &Vector3::new(y[4], y[5], y[6]));
        let momentum = gravity.moments.component_mul(&omega);
        let change = (momentum.cross(&omega) + torque).component_div(&gravity.moments);
        rate.fixed_rows_mut::<4>(0).copy_from(&turn);
        rate.fixed_rows_mut::<3>(4).copy_from(&y.fixed_rows::<3>(10));
        rate.fixed_rows_mut::<3>(7).copy_from(&change);
        rate.fixed_rows_mut::<3>(10).copy_from(&(attitude * force / gravity.mass));
    };
    let (position, twist) = (problem.position(), problem.velocity());
    let start = SVector::from_fn(|i, _| match i {
        3 => 1.0,
        4..7 => position[i - 4],
        7.. => twist[i - 7],
        _ => 0.0,
    });
    let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, x| x.abs().max(most));
    let speed = problem.velocity().iter().skip(3).map(|x| x * x).sum::<f64>().sqrt();
    let scales = std::array::from_fn(|i| match i {
        0..4 => 1.0,
        4..7 => position.norm(),
        7..10 => largest(&twist[..3]),
        _ => speed,
    });
    both(sweep, few, start, &rates, scales, |y| {
        let part = |at: usize| y.as_slice()[at..at + 3].to_vec();
        vec![rows(&So3, &attitude(y.as_slice())), part(7), part(4), part(10)]
    });
}
