//! Accuracy over cost of motions, and the cost of a step.
//!
//! ```text
//! cargo bench --bench precision -- measure > motion.csv
//! cargo bench --bench precision -- steps
//! cargo bench --bench precision -- draw < motion.csv > motion.svg
//! ```
//!
//! A row of `measure` is `problem,method,parameter,error,seconds,steps`: the parameter is a number of steps or a tolerance,
//! the error that at the end against 25 digits (`tests/data/motions.json`), of the entries of the element and of the body
//! momentum over its largest component, and the seconds are CPU time, the least of some batches. Rows of the problem
//! `step` are steps on the group that stands for the parameter. `benches/peers/motion.py` puts others beside.
//!
//! What begins with `Rust:` is not affinor's: what one would write without it, compiled alike.

#[path = "precision/draw.rs"]
mod draw;
#[path = "precision/plain.rs"]
mod plain;
#[path = "precision/problem.rs"]
mod problem;
#[path = "precision/sweep.rs"]
mod sweep;

use affinor::dynamics::euler_poincare::{Free, Torque};
use affinor::dynamics::integrators::Pair;
use affinor::dynamics::integrators::kick::{FreeMotion, Order as KickOrder};
use affinor::dynamics::integrators::runge_kutta::LocalCoordinates;
use affinor::dynamics::integrators::splitting::Composition;
use affinor::dynamics::moser_veselov::Order;
use affinor::dynamics::{
    Adaptive, BodyState, CommutatorFree, CrouchGrossman, EulerPoincare, FreeBody, Integrator, Kick,
    MoserVeselov, MuntheKaas, Projected, SimoWong, Splitting, State,
};
use affinor::group::{Coordinates, LieGroup, Se3, So3, Stored};
use nalgebra::{UnitQuaternion, Vector3};
use problem::Problem;
use std::hint::black_box;
use sweep::{Sweep, per_step};

const MOSER_VESELOV: [(&str, Order); 5] = [
    ("DMV2", Order::Two),
    ("DMV4", Order::Four),
    ("DMV6", Order::Six),
    ("DMV8", Order::Eight),
    ("DMV10", Order::Ten),
];
const KICKS: [(&str, KickOrder); 3] =
    [("kick2", KickOrder::Two), ("kick4", KickOrder::Four), ("kick6", KickOrder::Six)];
const MOTIONS: [(&str, FreeMotion); 2] =
    [("exact", FreeMotion::Exact), ("DMV10", FreeMotion::MoserVeselov(Order::Ten))];

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if arguments.iter().any(|argument| argument == "draw") {
        draw::draw();
    } else if arguments.iter().any(|argument| argument == "measure") {
        println!("problem,method,parameter,error,seconds,steps");
        free_body("free body, t = 10", "hairer-vilmart", "10.0", 20);
        free_body("free body, t = 100", "hairer-vilmart", "100.0", 200);
        heavy_top(&Problem::read("bruels-cardona-arnold", "2.0"), 300);
        kirchhoff(&Problem::read("kirchhoff", "20.0"), 20);
        steps();
    } else if arguments.iter().any(|argument| argument == "steps") {
        println!("problem,method,parameter,error,seconds,steps");
        steps();
    }
}

fn free_body(name: &'static str, motion: &str, time: &str, few: u64) {
    let problem = Problem::read(motion, time);
    let inertia = problem.inertia();
    let attitude = UnitQuaternion::identity();
    let momentum = inertia.momentum(&problem.velocity3());
    let start = BodyState { attitude, momentum };
    let seen = |state: &BodyState| {
        (problem::rows(&So3, &state.attitude), state.momentum.as_slice().to_vec())
    };
    let sweep = Sweep { problem: name, reference: &problem };
    sweep.once(
        "exact",
        || FreeBody::new(&inertia, &start).ok().map(|body| body.at(problem.time)),
        seen,
    );
    for (name, order) in MOSER_VESELOV {
        let run = |n: u64| {
            let method = MoserVeselov::new(&inertia, order);
            method.steps(black_box(&start), problem.time / n as f64, n as usize).ok()
        };
        sweep.fixed(name, few, run, seen);
    }
    let system = problem.system(So3, Free);
    any_group(&sweep, &system, few);
    group_steps(&sweep, "Strang", &system, few, || Splitting::new(&inertia, Composition::Strang));
    group_steps(&sweep, "Suzuki", &system, few, || Splitting::new(&inertia, Composition::Suzuki));
    group_steps(&sweep, "Simo-Wong", &system, few, || SimoWong::new(&inertia));
    plain::body(&sweep, &problem, few);
}

fn heavy_top(problem: &Problem, few: u64) {
    let inertia = problem.inertia();
    let system = problem.system(So3, problem.gravity());
    let sweep = Sweep { problem: "heavy top, t = 2", reference: problem };
    any_group(&sweep, &system, few);
    for (name, order) in KICKS {
        for (with, motion) in MOTIONS {
            let name = format!("{name}, {with}");
            group_steps(&sweep, &name, &system, few, || Kick::new(&inertia, order, motion));
        }
    }
    group_steps(&sweep, "Simo-Wong", &system, few, || SimoWong::new(&inertia));
    plain::body(&sweep, problem, few);
}

fn kirchhoff(problem: &Problem, few: u64) {
    let system = problem.system(Se3, Free);
    let sweep = Sweep { problem: "Kirchhoff, t = 20", reference: problem };
    any_group(&sweep, &system, few);
    plain::kirchhoff(&sweep, problem, few);
}

/// The methods for all groups.
fn any_group<G: Stored, M: Torque<G>>(sweep: &Sweep, system: &EulerPoincare<G, M>, few: u64) {
    group_steps(sweep, "RKMK4", system, few, || MuntheKaas::RK4);
    group_steps(sweep, "projected RK4", system, few, || Projected::RK4);
    group_steps(sweep, "CF4", system, few, || CommutatorFree);
    group_steps(sweep, "CG3", system, few, || CrouchGrossman);
    for (name, projected, pair) in
        [("RKMK54", "projected DP54", Pair::Five), ("RKMK853", "projected DP853", Pair::Eight)]
    {
        let control = move |tolerance: f64| Adaptive { pair, ..Adaptive::new(tolerance) };
        controlled(sweep, name, system, control);
        controlled(sweep, projected, system, move |tolerance| control(tolerance).projected());
    }
}

fn controlled<G: Stored, M: Torque<G>, C: LocalCoordinates<G> + Copy>(
    sweep: &Sweep,
    name: &str,
    system: &EulerPoincare<G, M>,
    control: impl Fn(f64) -> Adaptive<C>,
) {
    let run = |tolerance: f64| {
        let control = control(tolerance);
        let mut state = sweep.reference.start(system);
        let (mut next, mut count) = (control.first_step(), 0);
        while state.time != sweep.reference.time {
            control.step(system, &mut state, &mut next, sweep.reference.time).ok()?;
            count += 1;
        }
        Some((state, count))
    };
    let seen = |(state, _): &(State<G>, u64)| body_momentum(system, state);
    sweep.tolerances(name, run, seen, |(_, count)| *count);
}

fn group_steps<G: LieGroup, M: Torque<G>, I: Integrator<EulerPoincare<G, M>>>(
    sweep: &Sweep,
    name: &str,
    system: &EulerPoincare<G, M>,
    few: u64,
    method: impl Fn() -> I,
) {
    let run = |n: u64| {
        let (method, mut state) = (method(), sweep.reference.start(system));
        let h = sweep.reference.time / n as f64;
        (0..n).try_for_each(|_| method.step(system, &mut state, h)).ok()?;
        Some(state)
    };
    sweep.fixed(name, few, run, |state| body_momentum(system, state));
}

fn body_momentum<G: LieGroup, M: Torque<G>>(
    system: &EulerPoincare<G, M>,
    state: &State<G>,
) -> (Vec<f64>, Vec<f64>) {
    let momentum = system.momentum(state).components().to_vec();
    (problem::rows(system.group(), &state.element), momentum)
}

/// Seconds a step, h = 0.05: of the free body, of one in a potential, and of a free system on SE(3).
fn steps() {
    let body = Problem::read("hairer-vilmart", "10.0");
    let inertia = body.inertia();
    let (free, start) = (body.system(So3, Free), body.velocity3());
    let state =
        BodyState { attitude: UnitQuaternion::identity(), momentum: inertia.momentum(&start) };
    for (name, order) in MOSER_VESELOV {
        let method = MoserVeselov::new(&inertia, order);
        let many = |count: usize| drop(black_box(method.steps(black_box(&state), 0.05, count)));
        per_step(&format!("{name}, many at once"), "SO(3)", many);
        one_by_one(name, "SO(3)", &free, &method);
    }
    one_by_one("Strang", "SO(3)", &free, &Splitting::new(&inertia, Composition::Strang));
    one_by_one("Suzuki", "SO(3)", &free, &Splitting::new(&inertia, Composition::Suzuki));
    one_by_one("Simo-Wong", "SO(3)", &free, &SimoWong::new(&inertia));
    runge_kutta("SO(3)", &free);
    plain::steps(&body);
    let weight = Vector3::new(0.0, 0.0, 1.0);
    let heavy = body.system(So3, move |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        g.inverse_transform_vector(&Vector3::z()).cross(&weight)
    });
    for (name, order) in KICKS {
        for (with, motion) in MOTIONS {
            let kick = Kick::new(&inertia, order, motion);
            one_by_one(&format!("{name}, {with}"), "SO(3), potential", &heavy, &kick);
        }
    }
    one_by_one("Simo-Wong", "SO(3), potential", &heavy, &SimoWong::new(&inertia));
    runge_kutta("SO(3), potential", &heavy);
    let rigid = Problem::read("kirchhoff", "20.0");
    runge_kutta("SE(3)", &rigid.system(Se3, Free));
}

fn runge_kutta<G: Stored, M: Torque<G>>(place: &str, system: &EulerPoincare<G, M>) {
    one_by_one("RKMK4", place, system, &MuntheKaas::RK4);
    one_by_one("RKMK5 of RKMK54", place, system, &MuntheKaas::DORMAND_PRINCE);
    one_by_one("RKMK8 of RKMK853", place, system, &MuntheKaas::DORMAND_PRINCE_8);
    one_by_one("projected RK4", place, system, &Projected::RK4);
    one_by_one("projected DP5", place, system, &Projected::DORMAND_PRINCE);
    one_by_one("projected DP8", place, system, &Projected::DORMAND_PRINCE_8);
    one_by_one("CF4", place, system, &CommutatorFree);
    one_by_one("CG3", place, system, &CrouchGrossman);
}

fn one_by_one<G: LieGroup, M: Torque<G>>(
    name: &str,
    place: &str,
    system: &EulerPoincare<G, M>,
    method: &impl Integrator<EulerPoincare<G, M>>,
) {
    let n = system.group().dimension();
    let velocity = G::Vector::from_fn(n, |i| [3.0, 0.5, -0.9][i % 3]);
    let start = system.state(0.0, system.group().identity(), &velocity);
    per_step(name, place, |count| {
        let mut state = black_box(start.clone());
        let _ = (0..count).try_for_each(|_| method.step(system, &mut state, 0.05));
        black_box(state);
    });
}
