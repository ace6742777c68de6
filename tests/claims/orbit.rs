//! A satellite in a low orbit with the gravity gradient, in SI units, against a reference in 25 digits
//! (`tests/references/orbit.py`).
//!
//! Guards `Problem`, down to the integrators on SE(3).

use affinor_documents::problem::Problem;

const REFERENCE: &str = include_str!("../data/orbit.json");

struct Reference(serde_json::Value);

impl Reference {
    fn number(value: &serde_json::Value) -> f64 {
        value.as_str().unwrap().parse().unwrap()
    }

    fn list(value: &serde_json::Value) -> Vec<f64> {
        value.as_array().unwrap().iter().map(Self::number).collect()
    }

    /// The problem with these integrator keys.
    fn problem(&self, integrator: &str) -> String {
        let [position, velocity, spin, moments] =
            ["position", "velocity", "spin", "moments"].map(|key| Self::list(&self.0[key]));
        let [mass, mu] = ["mass", "mu"].map(|key| Self::number(&self.0[key]));
        let times: Vec<f64> = self.states().map(|state| Self::number(&state["time"])).collect();
        let [j1, j2, j3] = moments[..] else { panic!("three moments") };
        let along = |k: usize| format!("(R1{k}*x + R2{k}*y + R3{k}*z)^2");
        format!(
            r#"
space = "se3"
metric = "diag({j1}, {j2}, {j3}, {mass}, {mass}, {mass})"
[parameters]
mu = {mu:e}
[initial]
position = {position:?}
quaternion = [1, 0, 0, 0]
velocity = [{}, {}, {}, {}, {}, {}]
[forces]
potential = """-{mass}*mu/sqrt(x^2+y^2+z^2) - mu/(2*sqrt(x^2+y^2+z^2)^3)*({} - 3*({j1}*{}+{j2}*{}+{j3}*{})/(x^2+y^2+z^2))"""
[integrator]
{integrator}
[output]
times = {times:?}
columns = ["t", "Omega", "g", "x", "y", "z"]
"#,
            spin[0],
            spin[1],
            spin[2],
            velocity[0],
            velocity[1],
            velocity[2],
            j1 + j2 + j3,
            along(1),
            along(2),
            along(3),
        )
    }

    fn states(&self) -> impl Iterator<Item = &serde_json::Value> {
        self.0["states"].as_array().unwrap().iter()
    }
}

/// The largest difference, relative to the largest expected number.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    found.iter().zip(expected).map(|(x, y)| (x - y).abs() / size).fold(0.0, f64::max)
}

/// Spin, attitude and position over two orbits; each error is relative to the size of its vector.
#[test]
fn two_orbits_with_the_gravity_gradient() {
    let reference = Reference(serde_json::from_str(REFERENCE).unwrap());
    for (integrator, bounds) in [
        ("method = \"rkmk853\"\ntolerance = 1e-13", [1e-11, 1e-10, 1e-11]),
        ("method = \"projected853\"\ntolerance = 1e-13", [1e-11, 1e-10, 1e-11]),
        ("method = \"rkmk54\"\ntolerance = 1e-12", [1e-10, 1e-9, 1e-10]),
        ("method = \"rkmk4\"\nstep = 2", [1e-8, 1e-7, 1e-8]),
        ("method = \"cf4\"\nstep = 2", [1e-8, 1e-7, 1e-8]),
        ("method = \"projected4\"\nstep = 2", [1e-8, 1e-7, 1e-8]),
    ] {
        let text = reference.problem(integrator);
        let problem = Problem::parse("orbit.toml", &text).unwrap_or_else(|e| panic!("{e}"));
        let mut ready = problem.motion(0).unwrap_or_else(|e| panic!("{e}"));
        for state in reference.states() {
            let time = Reference::number(&state["time"]);
            while !ready.motion.step(time).unwrap_or_else(|e| panic!("{integrator}: {e}")) {}
            let row = ready.motion.row();
            let entries: Vec<f64> = (0..9).map(|k| row[7 + 4 * (k / 3) + k % 3]).collect();
            let found = [(&row[1..4], "spin"), (&entries, "element"), (&row[23..26], "position")];
            for ((found, key), bound) in found.into_iter().zip(bounds) {
                let error = off(found, &Reference::list(&state[key]));
                println!("{integrator:?} at {time}: {key} {error:.1e}");
                assert!(error < bound, "{integrator}: {key} at {time}: {error:e}");
            }
        }
    }
}
