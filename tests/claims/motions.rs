//! Motions against Taylor series in 25 digits (`references/motions.py`): bodies, tops, torques, and other groups.
//!
//! Guards `mechanics::{systems, bodies, integrators}`.

use affinor::group::{
    Coordinates, Heisenberg, LieGroup, MatrixGroup, Se2, Se3, Sl2, So3, TranslationSplit,
};
use affinor::mechanics::systems::euler_poincare::Torque;
use affinor::mechanics::{
    Adaptive, BodyState, CommutatorFree, EulerPoincare, FreeBody, Inertia, Integrator, MuntheKaas,
    State,
};
use affinor::{Canonical, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Const, DMatrix, UnitQuaternion, Vector3};
use serde::Deserialize;

#[derive(Deserialize)]
struct References {
    motions: Vec<Motion>,
    coning: Coning,
}

/// Numbers are text, so that they are read to the last digit.
#[derive(Deserialize)]
struct Motion {
    name: String,
    group: String,
    metric: Vec<Vec<String>>,
    velocity: Vec<String>,
    #[serde(default)]
    start: Vec<String>,
    #[serde(default)]
    weight: Vec<String>,
    #[serde(default)]
    moment: Vec<String>,
    states: Vec<Reference>,
}

#[derive(Deserialize)]
struct Reference {
    time: String,
    element: Vec<String>,
    momentum: Vec<String>,
}

#[derive(Deserialize)]
struct Coning {
    rate: String,
    angle: String,
    time: String,
    element: Vec<String>,
    momentum: Vec<String>,
}

fn references() -> References {
    serde_json::from_str(include_str!("../data/motions.json")).unwrap()
}

fn number(text: impl AsRef<str>) -> f64 {
    let number = |text: &str| -> f64 { text.parse().unwrap() };
    let text = text.as_ref();
    text.split_once('/').map_or_else(|| number(text), |(p, q)| number(p) / number(q))
}

fn numbers(texts: &[String]) -> Vec<f64> {
    texts.iter().map(number).collect()
}

fn three(texts: &[String]) -> Option<Vector3<f64>> {
    (!texts.is_empty()).then(|| Vector3::from_vec(numbers(texts)))
}

/// The torque of a motion: constant, or that of the potential `w . gamma`, `gamma = R^T e_3`.
struct Load<G> {
    group: G,
    weight: Option<Vector3<f64>>,
    moment: Option<Vector3<f64>>,
}

impl<G: TranslationSplit> Load<G> {
    fn gamma(&self, element: &G::Element) -> Vector3<f64> {
        Vector3::from_iterator(self.group.matrix(element).row(2).iter().copied())
    }

    fn potential(&self, element: &G::Element) -> f64 {
        self.weight.map_or(0.0, |weight| weight.dot(&self.gamma(element)))
    }
}

impl<G: TranslationSplit> Torque<G> for Load<G> {
    fn add(&self, _: f64, element: &G::Element, _: &G::Vector, force: &mut G::Vector) {
        let torque = match (&self.weight, &self.moment) {
            (Some(weight), _) => self.gamma(element).cross(weight),
            (_, Some(moment)) => *moment,
            _ => return,
        };
        *force = force.clone() + G::Vector::from_components(torque.as_slice());
    }
}

fn positive(group: &impl LieGroup, entry: impl Fn([usize; 2]) -> f64) -> Metric<f64> {
    let labels = group.algebra().unwrap().labels().to_vec();
    let metric = Tensor::from_fn(labels.len(), [Down, Down], entry).unwrap();
    Metric::new(&labels, metric).unwrap()
}

fn system<G: TranslationSplit, M: Torque<G>>(
    group: G,
    metric: &Metric<f64>,
    torque: M,
) -> EulerPoincare<G, M> {
    let plus = Connection::canonical(&group.algebra().unwrap(), Canonical::Plus);
    EulerPoincare::new(group, &plus, metric, torque).unwrap()
}

impl Motion {
    fn system<G: TranslationSplit + Clone>(&self, group: &G) -> EulerPoincare<G, Load<G>> {
        let metric = positive(group, |[i, j]| number(&self.metric[i][j]));
        let (weight, moment) = (three(&self.weight), three(&self.moment));
        system(group.clone(), &metric, Load { group: group.clone(), weight, moment })
    }

    fn start<G: TranslationSplit + Clone>(&self, system: &EulerPoincare<G, Load<G>>) -> State<G> {
        let group = system.group();
        let turn = G::Vector::from_fn(group.dimension(), |i| self.start.get(i).map_or(0.0, number));
        let velocity = G::Vector::from_components(&numbers(&self.velocity));
        system.state(0.0, group.exp(&turn), &velocity)
    }
}

/// How far a state is from a reference, relative to its size.
fn off<G: TranslationSplit, M: Torque<G>>(
    system: &EulerPoincare<G, M>,
    state: &State<G>,
    reference: &Reference,
) -> f64 {
    let matrix = system.group().matrix(&state.element).transpose();
    let found = matrix.iter().copied().chain(system.momentum(state).components().to_vec());
    let expected = [numbers(&reference.element), numbers(&reference.momentum)].concat();
    let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    found.zip(&expected).map(|(x, y)| (x - y).abs() / size).fold(0.0, f64::max)
}

/// The error at the last time, after a run with step control; energy and what else a motion conserves is looked at, too.
fn adaptive<G: TranslationSplit + Clone>(motion: &Motion, group: &G, tolerance: f64) -> f64 {
    let system = motion.system(group);
    let start = motion.start(&system);
    let times: Vec<f64> = motion.states.iter().map(|state| number(&state.time)).collect();
    let states = Adaptive::new(tolerance).states(&system, &start, &times).unwrap();
    let load = Load { group: group.clone(), weight: three(&motion.weight), moment: None };
    let energy = |state: &State<G>| system.energy(state) + load.potential(&state.element);
    let mut last = 0.0;
    for (state, reference) in states.iter().zip(&motion.states) {
        last = off(&system, state, reference);
        if motion.moment.is_empty() {
            let drift = (energy(state) - energy(&start)).abs() / energy(&start);
            assert!(drift < 1e-10, "{} at {}: energy {drift:e}", motion.name, state.time);
            if motion.weight.is_empty() {
                let [h, before] = [state, &start].map(|state| state.spatial_momentum(group));
                let off = (h - before.clone()).largest();
                assert!(off <= 1e-12 * (1.0 + before.largest()), "{}: {off:e}", motion.name);
                if motion.group.starts_with("SO") {
                    assert_eq!(state.spatial, start.spatial, "{}", motion.name);
                }
            } else {
                // gravity does not turn about the vertical
                let [h, before] = [state, &start].map(|state| state.spatial.components()[2]);
                assert!((h - before).abs() <= 1e-11 * (1.0 + before.abs()), "{h} {before}");
            }
        }
    }
    last
}

fn stretches() -> MatrixGroup {
    let unit = |j: usize| DMatrix::from_fn(2, 2, |i, k| f64::from(i == 0 && k == j));
    MatrixGroup::new(&[unit(0), unit(1)]).unwrap()
}

/// `E_ij = e_i e_j^T - e_j e_i^T` up to the sign, `i < j`.
fn turns() -> MatrixGroup {
    let pairs = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
    let spin = |(i, j)| {
        DMatrix::from_fn(4, 4, |a, b| f64::from((a, b) == (j, i)) - f64::from((a, b) == (i, j)))
    };
    MatrixGroup::new(&pairs.map(spin).collect::<Vec<_>>()).unwrap()
}

fn by_group(motion: &Motion, tolerance: f64) -> f64 {
    match motion.group.as_str() {
        "SO(3)" => adaptive(motion, &So3, tolerance),
        "SE(3)" => adaptive(motion, &Se3, tolerance),
        "SE(2)" => adaptive(motion, &Se2, tolerance),
        "SL(2)" => adaptive(motion, &Sl2, tolerance),
        "heisenberg(3)" => adaptive(motion, &Heisenberg::<Const<3>>::new(), tolerance),
        "aff(1)" => adaptive(motion, &stretches(), tolerance),
        "SO(4)" => adaptive(motion, &turns(), tolerance),
        other => panic!("{other}"),
    }
}

/// Steps of the tolerance 1e-12. What stays near its neighbours has 1e-11 at its last time; tops turn up to 300 rad and the
/// first body goes on to t = 100.
#[test]
fn motions_are_those_of_taylor_series() {
    let motions = references().motions;
    assert_eq!(motions.len(), 16);
    for motion in motions {
        let bound = match motion.name.as_str() {
            "bruels-cardona-arnold" | "kovalevskaya" => 1e-8,
            "hairer-vilmart" => 1e-9,
            "hairer-vilmart-potential" | "simo-wong-05" | "simo-wong-3" => 1e-10,
            _ => 1e-11,
        };
        let error = by_group(&motion, 1e-12);
        assert!(error < bound, "{}: {error:e}", motion.name);
    }
}

/// The closed form has no steps: 1e-13 after 15 periods.
#[test]
fn a_free_body_is_exact_at_any_time() {
    let motions = references().motions;
    let motion = motions.iter().find(|motion| motion.name == "hairer-vilmart").unwrap();
    let moments = Vector3::from_fn(|i, _| number(&motion.metric[i][i]));
    let momentum = moments.component_mul(&three(&motion.velocity).unwrap());
    let start = BodyState { attitude: UnitQuaternion::identity(), momentum };
    let body = FreeBody::new(&Inertia::diagonal(&moments).unwrap(), &start).unwrap();
    for reference in &motion.states {
        let state = body.at(number(&reference.time));
        let attitude = DMatrix::from_row_slice(3, 3, &numbers(&reference.element));
        let turn = (So3.matrix(&state.attitude) - attitude).amax();
        let off = (state.momentum - three(&reference.momentum).unwrap()).amax();
        assert!(turn.max(off) < 1e-13, "{}: {turn:e} {off:e}", reference.time);
    }
}

/// Steps of one length: the error at the first time falls as the fourth power.
#[test]
fn steps_converge_to_the_taylor_series() {
    fn error<G: TranslationSplit + Clone>(
        motion: &Motion,
        group: &G,
        method: &impl Integrator<EulerPoincare<G, Load<G>>>,
        steps: usize,
    ) -> f64 {
        let system = motion.system(group);
        let mut state = motion.start(&system);
        let reference = &motion.states[0];
        for _ in 0..steps {
            method.step(&system, &mut state, number(&reference.time) / steps as f64).unwrap();
        }
        off(&system, &state, reference)
    }
    fn orders<G: TranslationSplit + Clone>(motion: &Motion, group: &G) {
        let check = |name: &str, error: &dyn Fn(usize) -> f64| {
            let order = (error(40) / error(80)).log2();
            assert!((order - 4.0).abs() < 0.3, "{name}, {}: {order}", motion.name);
        };
        check("RKMK4", &|steps| error(motion, group, &MuntheKaas::RK4, steps));
        check("CF4", &|steps| error(motion, group, &CommutatorFree, steps));
    }
    for motion in references().motions {
        match motion.name.as_str() {
            "hairer-vilmart-potential" | "romano-constant" => orders(&motion, &So3),
            "clebsch" => orders(&motion, &Se3),
            "se(2)" => orders(&motion, &Se2),
            "sl(2)" => orders(&motion, &Sl2),
            "so(4)" => orders(&motion, &turns()),
            _ => {}
        }
    }
}

/// What a motion conserves beside energy and spatial momentum, from `H` and `gamma`.
fn integrals(name: &str, h: &[f64], gamma: &Vector3<f64>) -> Vec<f64> {
    match name {
        // |(Omega_1 + i Omega_2)^2 - (gamma_1 + i gamma_2)|^2, moments (2, 2, 1)
        "kovalevskaya" => {
            let (p, q) = (h[0] / 2.0, h[1] / 2.0);
            let (re, im) = (p * p - q * q - gamma.x, 2.0 * p * q - gamma.y);
            vec![re * re + im * im]
        }
        // symmetric tops keep the spin
        "simo-wong-05" | "simo-wong-3" | "romano-transverse" => vec![h[2]],
        "kirchhoff" | "clebsch" => {
            let pi = Vector3::from_column_slice(&h[..3]);
            let p = Vector3::from_column_slice(&h[3..]);
            let mut all = vec![pi.dot(&p), p.norm_squared()];
            if name == "clebsch" {
                let q = Vector3::new(-1.0, -0.25, 0.0);
                all.push(pi.norm_squared() + p.component_mul(&p).dot(&q));
            }
            all
        }
        "sl(2)" => vec![h[0] * h[1] + h[2] * h[2] / 4.0],
        "heisenberg(3)" => vec![h[2]],
        "se(2)" => vec![h[1] * h[1] + h[2] * h[2]],
        // norm, Pfaffian, and the integral tr(M^2 B^2) + tr(MBMB)/2 of S. V. Manakov, B = diag(1, 3/2, 5/2, 4)^2
        "so(4)" => {
            let m = turns().basis().iter().zip(h).fold(DMatrix::zeros(4, 4), |sum, (e, h)| {
                let spin = turns().generator(e);
                sum + spin * *h
            });
            let b = [1.0, 2.25, 6.25, 16.0];
            let b = DMatrix::from_fn(4, 4, |i, j| if i == j { b[i] } else { 0.0 });
            let pfaffian = h[0] * h[5] - h[1] * h[4] + h[2] * h[3];
            let squares = h.iter().map(|h| h * h).sum();
            let twice = (&m * &b * &m * &b).trace();
            vec![squares, pfaffian, (&m * &m * &b * &b).trace() + 0.5 * twice]
        }
        _ => vec![],
    }
}

#[test]
fn integrals_stay() {
    fn check<G: TranslationSplit + Clone>(motion: &Motion, group: &G) -> usize {
        let system = motion.system(group);
        let start = motion.start(&system);
        let time = number(&motion.states.last().unwrap().time);
        let end = Adaptive::new(1e-12).states(&system, &start, &[time]).unwrap().remove(0);
        let of = |state: &State<G>| {
            let row = group.matrix(&state.element);
            let gamma = Vector3::from_fn(|i, _| if row.nrows() == 3 { row[(2, i)] } else { 0.0 });
            integrals(&motion.name, system.momentum(state).components(), &gamma)
        };
        let (first, last) = (of(&start), of(&end));
        for (at, (before, now)) in first.iter().zip(&last).enumerate() {
            let drift = (now - before).abs() / (1.0 + before.abs());
            assert!(drift < 1e-10, "{}, integral {at}: {before} and {now}", motion.name);
        }
        if motion.name == "kovalevskaya" {
            assert!((last[0] - 1.0).abs() < 1e-10, "{}", last[0]);
        }
        first.len()
    }
    let count: usize = references()
        .motions
        .iter()
        .map(|motion| match motion.group.as_str() {
            "SO(3)" => check(motion, &So3),
            "SE(3)" => check(motion, &Se3),
            "SE(2)" => check(motion, &Se2),
            "SL(2)" => check(motion, &Sl2),
            "heisenberg(3)" => check(motion, &Heisenberg::<Const<3>>::new()),
            "SO(4)" => check(motion, &turns()),
            _ => 0,
        })
        .sum();
    assert_eq!(count, 4 + 5 + 1 + 1 + 1 + 3);
}

/// `R = Rz(w t) Rx(b) Rz(-w t)`: of three unit moments, under the torque `dOmega/dt`.
#[test]
fn a_cone_closes() {
    let coning = references().coning;
    let [rate, angle, time] = [&coning.rate, &coning.angle, &coning.time].map(number);
    let velocity = move |t: f64| {
        let (sin, cos) = (rate * t).sin_cos();
        Vector3::new(-angle.sin() * sin, angle.sin() * cos, angle.cos() - 1.0) * rate
    };
    let torque = move |t: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        let (sin, cos) = (rate * t).sin_cos();
        Vector3::new(-cos, -sin, 0.0) * (angle.sin() * rate * rate)
    };
    let body = system(So3, &positive(&So3, |[i, j]| f64::from(i == j)), torque);
    let start = body.state(0.0, So3.exp(&Vector3::new(angle, 0.0, 0.0)), &velocity(0.0));
    let end = Adaptive::new(1e-13).states(&body, &start, &[time]).unwrap().remove(0);
    let (element, momentum) = (coning.element, coning.momentum);
    let error = off(&body, &end, &Reference { time: coning.time, element, momentum });
    assert!(error < 1e-11, "{error:e}");
}
