//! Accuracy over cost of motions, and the cost of a step.
//!
//! ```text
//! cargo bench -p affinor-benches --bench precision -- measure > motion.csv
//! cargo bench -p affinor-benches --bench precision -- measure --problem "satellite, two orbits"
//! cargo bench -p affinor-benches --bench precision -- steps
//! cargo bench -p affinor-benches --bench precision -- draw < motion.csv > motion.svg
//! ```
//!
//! A row of `measure` is `problem,method,parameter,error,seconds,steps`. The parameter is a number
//! of steps or a tolerance. The seconds are CPU time, the minimum over some batches. The error is
//! the error at the end, compared with 25 digits: of the entries of the element and of the body
//! momentum, divided by its largest component (`tests/data/motions.json`). For the satellite
//! (`tests/data/orbit.json`) it is the error of attitude, spin, position and velocity, each divided
//! by its size. Rows of the problem `step` measure single steps on the group that the parameter
//! names. `benches/peers/motion.py` adds rows of other programs.
//!
//! Methods that begin with `Rust:` are written without affinor, as plain Rust with the same compiler options.

#[path = "precision/draw.rs"]
mod draw;
#[path = "precision/plain.rs"]
mod plain;
#[path = "precision/problem.rs"]
mod problem;
#[path = "precision/satellite.rs"]
mod satellite;
#[path = "precision/sweep.rs"]
mod sweep;

use affinor::group::{Coordinates, Embedded, Se3, So3, TranslationSplit};
use affinor::mechanics::integrators::Pair;
use affinor::mechanics::integrators::kick::{FreeMotion, KickOrder};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::integrators::runge_kutta::LocalCoordinates;
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    Adaptive, BodyState, CommutatorFree, EulerPoincare, FreeBody, Integrator, Kick, MoserVeselov,
    MuntheKaas, Projected, SimoWong, State,
};
use nalgebra::{UnitQuaternion, Vector3};
use problem::Problem;
use satellite::Gravity;
use std::hint::black_box;
use sweep::{Seen, Sweep, per_step};

const MOSER_VESELOV: [(&str, MoserVeselovOrder); 5] = [
    ("DMV2", MoserVeselovOrder::Two),
    ("DMV4", MoserVeselovOrder::Four),
    ("DMV6", MoserVeselovOrder::Six),
    ("DMV8", MoserVeselovOrder::Eight),
    ("DMV10", MoserVeselovOrder::Ten),
];
const KICKS: [(&str, KickOrder); 3] =
    [("kick2", KickOrder::Two), ("kick4", KickOrder::Four), ("kick6", KickOrder::Six)];
const MOTIONS: [(&str, FreeMotion); 2] =
    [("exact", FreeMotion::Exact), ("DMV10", FreeMotion::MoserVeselov(MoserVeselovOrder::Ten))];

/// Measures a problem; its rows contain the name.
type Measure = fn(&'static str);
/// The problems by their names in the rows.
const PROBLEMS: [(&str, Measure); 6] = [
    ("free body, t = 10", |name| free_body(name, "hairer-vilmart", "10.0", 20)),
    ("free body, t = 100", |name| free_body(name, "hairer-vilmart", "100.0", 200)),
    ("heavy top, t = 2", |name| {
        heavy_top(name, &Problem::read("bruels-cardona-arnold", "2.0"), 300)
    }),
    ("Kirchhoff, t = 20", |name| kirchhoff(name, &Problem::read("kirchhoff", "20.0"), 20)),
    ("satellite, two orbits", |name| satellite(name, &Problem::satellite("12000"), 100)),
    ("step", |_| steps()),
];

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if arguments.iter().any(|argument| argument == "draw") {
        draw::draw();
    } else if arguments.iter().any(|argument| argument == "measure") {
        println!("problem,method,parameter,error,seconds,steps");
        let named: Vec<&String> = arguments.iter().skip_while(|a| *a != "--problem").collect();
        for (name, measure) in PROBLEMS {
            if named.get(1).is_none_or(|only| *only == name) {
                measure(name);
            }
        }
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
        vec![problem::rows(&So3, &state.attitude), state.momentum.as_slice().to_vec()]
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
    let case = Case { sweep: &sweep, system: &system, few, seen: body_momentum };
    case.any_group();
    case.steps("Simo-Wong", || SimoWong::new(&inertia));
    plain::body(&sweep, &problem, few);
}

fn heavy_top(name: &'static str, problem: &Problem, few: u64) {
    let inertia = problem.inertia();
    let system = problem.system(So3, problem.gravity());
    let sweep = Sweep { problem: name, reference: problem };
    let case = Case { sweep: &sweep, system: &system, few, seen: body_momentum };
    case.any_group();
    for (name, order) in KICKS {
        for (with, motion) in MOTIONS {
            case.steps(&format!("{name}, {with}"), || Kick::new(&inertia, order, motion));
        }
    }
    case.steps("Simo-Wong", || SimoWong::new(&inertia));
    plain::body(&sweep, problem, few);
}

fn kirchhoff(name: &'static str, problem: &Problem, few: u64) {
    let system = problem.system(Se3, Free);
    let sweep = Sweep { problem: name, reference: problem };
    Case { sweep: &sweep, system: &system, few, seen: body_momentum }.any_group();
    plain::kirchhoff(&sweep, problem, few);
}

fn satellite(name: &'static str, (problem, mu): &(Problem, f64), few: u64) {
    let gravity = Gravity::new(problem, *mu);
    let system = problem.system(Se3, gravity.torque());
    let sweep = Sweep { problem: name, reference: problem };
    Case { sweep: &sweep, system: &system, few, seen: satellite::seen }.any_group();
    plain::satellite(&sweep, problem, &gravity, few);
}

/// A system on a group, the fewest steps, and what is compared with the reference.
struct Case<'c, G: TranslationSplit, M> {
    sweep: &'c Sweep<'c>,
    system: &'c EulerPoincare<G, M>,
    few: u64,
    seen: fn(&EulerPoincare<G, M>, &State<G>) -> Seen,
}

impl<G: Embedded + TranslationSplit, M: Torque<G>> Case<'_, G, M> {
    /// The methods for all groups.
    fn any_group(&self) {
        self.steps("RKMK4", || MuntheKaas::RK4);
        self.steps("projected RK4", || Projected::RK4);
        self.steps("CF4", || CommutatorFree);
        let length = self.sweep.reference.length;
        for (name, projected, pair) in
            [("RKMK54", "projected DP54", Pair::Five), ("RKMK853", "projected DP853", Pair::Eight)]
        {
            let control = |tolerance: f64| {
                let absolute = length.map(|length| [tolerance, tolerance * length]);
                Adaptive { pair, absolute, ..Adaptive::new(tolerance) }
            };
            self.controlled(name, control);
            self.controlled(projected, |tolerance| control(tolerance).projected());
        }
    }

    fn controlled<C>(&self, name: &str, control: impl Fn(f64) -> Adaptive<C>)
    where
        C: LocalCoordinates<G> + Copy,
    {
        let (sweep, system) = (self.sweep, self.system);
        let run = |tolerance: f64| {
            let control = control(tolerance);
            let mut state = sweep.reference.start(system);
            let (mut next, mut count) = (control.first_step_from(system, &state), 0);
            while state.time != sweep.reference.time {
                control.step(system, &mut state, &mut next, sweep.reference.time).ok()?;
                count += 1;
            }
            Some((state, count))
        };
        let seen = |(state, _): &(State<G>, u64)| (self.seen)(system, state);
        sweep.tolerances(name, run, seen, |(_, count)| *count);
    }

    fn steps<I>(&self, name: &str, method: impl Fn() -> I)
    where
        I: Integrator<EulerPoincare<G, M>>,
    {
        let (sweep, system) = (self.sweep, self.system);
        let run = |n: u64| {
            let (method, mut state) = (method(), sweep.reference.start(system));
            let h = sweep.reference.time / n as f64;
            (0..n).try_for_each(|_| method.step(system, &mut state, h)).ok()?;
            Some(state)
        };
        sweep.fixed(name, self.few, run, |state| (self.seen)(system, state));
    }
}

fn body_momentum<G: TranslationSplit, M: Torque<G>>(
    system: &EulerPoincare<G, M>,
    state: &State<G>,
) -> Seen {
    let momentum = system.momentum(state).components().to_vec();
    vec![problem::rows(system.group(), &state.element), momentum]
}

/// Seconds per step, h = 0.05, for the free body, for a body in a potential, and for a free system
/// on SE(3).
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

fn runge_kutta<G: Embedded + TranslationSplit, M: Torque<G>>(
    place: &str,
    system: &EulerPoincare<G, M>,
) {
    one_by_one("RKMK4", place, system, &MuntheKaas::RK4);
    one_by_one("RKMK5 of RKMK54", place, system, &MuntheKaas::DORMAND_PRINCE);
    one_by_one("RKMK8 of RKMK853", place, system, &MuntheKaas::DORMAND_PRINCE_8);
    one_by_one("projected RK4", place, system, &Projected::RK4);
    one_by_one("projected DP5", place, system, &Projected::DORMAND_PRINCE);
    one_by_one("projected DP8", place, system, &Projected::DORMAND_PRINCE_8);
    one_by_one("CF4", place, system, &CommutatorFree);
}

fn one_by_one<G: TranslationSplit, M: Torque<G>>(
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
