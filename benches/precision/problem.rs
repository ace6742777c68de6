//! Problems of motion with their states in 25 digits.

use affinor::dynamics::euler_poincare::Torque;
use affinor::dynamics::{EulerPoincare, Inertia, State};
use affinor::group::{Coordinates, LieGroup, So3};
use affinor::{Canonical, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde_json::Value;

/// A problem up to one of its times.
pub struct Problem {
    metric: Vec<Vec<f64>>,
    velocity: Vec<f64>,
    /// `w` of the potential `w . R^T e_3`, if there is one.
    weight: Vec<f64>,
    /// The time.
    pub time: f64,
    element: Vec<f64>,
    momentum: Vec<f64>,
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
            time: number(&state["time"]),
            element: numbers(&state["element"]),
            momentum: numbers(&state["momentum"]),
        }
    }

    /// The system on a group.
    pub fn system<G: LieGroup, M: Torque<G>>(&self, group: G, torque: M) -> EulerPoincare<G, M> {
        let algebra = group.algebra().expect("an algebra");
        let metric = Tensor::from_fn(group.dimension(), [Down, Down], |[i, j]| self.metric[i][j]);
        let metric = Metric::new(algebra.labels(), metric.expect("a matrix")).expect("a metric");
        let plus = Connection::canonical(&algebra, Canonical::Plus);
        EulerPoincare::new(group, &plus, &metric, torque).expect("a system")
    }

    /// The start, at the identity.
    pub fn start<G: LieGroup, M: Torque<G>>(&self, system: &EulerPoincare<G, M>) -> State<G> {
        let velocity = G::Vector::from_components(&self.velocity);
        system.state(0.0, system.group().identity(), &velocity)
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

    /// The error of entries of an element and of a body momentum.
    pub fn error(&self, (element, momentum): &(Vec<f64>, Vec<f64>)) -> f64 {
        let off = |found: &[f64], expected: &[f64]| {
            found.iter().zip(expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
        };
        let size = self.momentum.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let error = off(element, &self.element).max(off(momentum, &self.momentum) / size);
        if element.iter().chain(momentum).all(|x| x.is_finite()) { error } else { f64::NAN }
    }
}

/// The entries of an element, row by row.
pub fn rows<G: LieGroup>(group: &G, element: &G::Element) -> Vec<f64> {
    group.matrix(element).transpose().as_slice().to_vec()
}

fn number(text: &Value) -> f64 {
    text.as_str().and_then(|text| text.parse().ok()).expect("a number")
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().map_or(vec![], |list| list.iter().map(number).collect())
}
