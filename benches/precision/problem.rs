//! Problems of motion with their states in 25 digits.

use crate::sweep::Seen;
use affinor::group::{Coordinates, So3, TranslationSplit};
use affinor::mechanics::systems::euler_poincare::Torque;
use affinor::mechanics::{EulerPoincare, Inertia, State};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde_json::Value;

/// A problem up to one of its times.
pub struct Problem {
    metric: Vec<Vec<f64>>,
    velocity: Vec<f64>,
    /// `w` of the potential `w . R^T e_3`, if there is one.
    weight: Vec<f64>,
    /// The canonical coordinates of the element at the start; empty for the identity.
    place: Vec<f64>,
    /// The scale of errors of positions, if it is not 1.
    pub length: Option<f64>,
    /// The time.
    pub time: f64,
    /// The state at that time.
    parts: Vec<Part>,
}

/// Components of a state with a common scale.
struct Part {
    numbers: Vec<f64>,
    size: f64,
}

impl Problem {
    /// By its name and time.
    pub fn read(name: &str, time: &str) -> Self {
        let text = include_str!("../../tests/data/motions.json");
        let all: Value = serde_json::from_str(text).expect("motions");
        let by = |list: &Value, key: &str, value: &str| -> Value {
            let mut list = list.as_array().expect("a list").iter();
            list.find(|entry| entry[key] == value).expect("an entry").clone()
        };
        let motion = by(&all["motions"], "name", name);
        let state = by(&motion["states"], "time", time);
        Problem {
            metric: motion["metric"].as_array().expect("rows").iter().map(numbers).collect(),
            velocity: numbers(&motion["velocity"]),
            weight: numbers(&motion["weight"]),
            place: vec![],
            length: None,
            time: number(&state["time"]),
            parts: vec![
                Part { numbers: numbers(&state["element"]), size: 1.0 },
                Part::by_largest(numbers(&state["momentum"])),
            ],
        }
    }

    /// The satellite of `tests/data/orbit.json`, in SI units, and the gravitational parameter. Its parts are attitude, spin in
    /// body components, position and velocity; the last two by their lengths.
    pub fn satellite(time: &str) -> (Self, f64) {
        let text = include_str!("../../tests/data/orbit.json");
        let all: Value = serde_json::from_str(text).expect("an orbit");
        let mut states = all["states"].as_array().expect("a list").iter();
        let state = states.find(|state| state["time"] == time).expect("a state");
        let mass = number(&all["mass"]);
        let diagonal = [numbers(&all["moments"]), vec![mass; 3]].concat();
        let row = |i: usize| (0..6).map(|j| if i == j { diagonal[i] } else { 0.0 }).collect();
        let [position, velocity] = ["position", "velocity"].map(|key| numbers(&all[key]));
        let problem = Problem {
            metric: (0..6).map(row).collect(),
            velocity: [numbers(&all["spin"]), velocity].concat(),
            weight: vec![],
            length: Some(length(&position)),
            place: [vec![0.0; 3], position].concat(),
            time: number(&state["time"]),
            parts: vec![
                Part { numbers: numbers(&state["element"]), size: 1.0 },
                Part::by_largest(numbers(&state["spin"])),
                Part::by_length(numbers(&state["position"])),
                Part::by_length(numbers(&state["velocity"])),
            ],
        };
        (problem, number(&all["mu"]))
    }

    /// The system on a group.
    pub fn system<G: TranslationSplit, M: Torque<G>>(
        &self,
        group: G,
        torque: M,
    ) -> EulerPoincare<G, M> {
        let algebra = group.algebra().expect("an algebra");
        let metric = Tensor::from_fn(group.dimension(), [Down, Down], |[i, j]| self.metric[i][j]);
        let metric = Metric::new(algebra.labels(), metric.expect("a matrix")).expect("a metric");
        let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
        EulerPoincare::new(group, &plus, &metric, torque).expect("a system")
    }

    /// The start.
    pub fn start<G: TranslationSplit, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
    ) -> State<G> {
        let velocity = G::Vector::from_components(&self.velocity);
        let element = if self.place.is_empty() {
            system.group().identity()
        } else {
            system.group().exp(&G::Vector::from_components(&self.place))
        };
        system.state(0.0, element, &velocity)
    }

    /// The position at the start of a rigid motion.
    pub fn position(&self) -> Vector3<f64> {
        Vector3::from_column_slice(&self.place[3..])
    }

    /// The body's inertia.
    pub fn inertia(&self) -> Inertia {
        Inertia::new(&Matrix3::from_fn(|i, j| self.metric[i][j])).expect("an inertia")
    }

    /// The diagonal of the metric.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.metric.len()).map(|i| self.metric[i][i]).collect()
    }

    /// The velocity at the start.
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// That of a body.
    pub fn velocity3(&self) -> Vector3<f64> {
        Vector3::from_column_slice(&self.velocity[..3])
    }

    /// `w`, 0 without a potential.
    pub fn weight(&self) -> Vector3<f64> {
        Vector3::from_fn(|i, _| self.weight.get(i).copied().unwrap_or(0.0))
    }

    /// The torque of the potential.
    pub fn gravity(&self) -> impl Torque<So3> + use<> {
        let weight = self.weight();
        move |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
            g.inverse_transform_vector(&Vector3::z()).cross(&weight)
        }
    }

    /// The largest error of a part over its size.
    pub fn error(&self, seen: &Seen) -> f64 {
        let off = |(found, part): (&Vec<f64>, &Part)| {
            let pairs = found.iter().zip(&part.numbers);
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / part.size
        };
        let error = seen.iter().zip(&self.parts).map(off).fold(0.0, f64::max);
        if seen.iter().flatten().all(|x| x.is_finite()) { error } else { f64::NAN }
    }
}

impl Part {
    fn by_largest(numbers: Vec<f64>) -> Self {
        let size = numbers.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        Part { numbers, size }
    }

    fn by_length(numbers: Vec<f64>) -> Self {
        let size = length(&numbers);
        Part { numbers, size }
    }
}

/// The entries of an element, row by row.
pub fn rows<G: TranslationSplit>(group: &G, element: &G::Element) -> Vec<f64> {
    group.matrix(element).transpose().as_slice().to_vec()
}

fn number(text: &Value) -> f64 {
    text.as_str().and_then(|text| text.parse().ok()).expect("a number")
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().map_or(vec![], |list| list.iter().map(number).collect())
}

fn length(numbers: &[f64]) -> f64 {
    numbers.iter().map(|x| x * x).sum::<f64>().sqrt()
}
