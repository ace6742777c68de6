//! Motions on sums of groups: every summand moves as it does on its own group.

use super::{columns, folder};
use std::collections::BTreeMap;

/// A body that is a summand of a problem. In its potential `_` means the number of the summand.
#[derive(Clone, Copy)]
struct Summand {
    space: &'static str,
    metric: &'static str,
    velocity: &'static str,
    force: &'static str,
    potential: &'static str,
}

const TOP: Summand = Summand {
    space: "so3",
    metric: "1, 2, 3",
    velocity: "0.3, 1, 0.2",
    force: "'0.1*cos(t)', 0, 0.05",
    potential: "g33_ + g12_*g23_",
};
const POINT: Summand = Summand {
    space: "R^3",
    metric: "1, 2, 4",
    velocity: "1, 2, 3",
    force: "0, '-0.2*t', 0",
    potential: "x1_^2 + x2_*x3_",
};
const VEHICLE: Summand = Summand {
    space: "se3",
    metric: "1, 2, 3, 4, 5, 6",
    velocity: "0.3, 1, 0.2, 1, 0.2, -0.5",
    force: "0, 0.1, 0, 'sin(t)', 0, 0",
    potential: "z_^2/2 + g13_",
};
const BUOY: Summand = Summand {
    space: "se3",
    metric: "2, 3, 4, 1, 1, 1",
    velocity: "0.1, -0.2, 0.5, 0, 1, 0.5",
    force: "0, 0, '0.3*sin(2*t)', 0, 0, 0",
    potential: "x_*y_/5 + g21_",
};

/// The columns of a run by their names. A method and its options are lines of `[integrator]`.
fn run(summands: &[Summand], integrator: &str) -> BTreeMap<String, Vec<f64>> {
    let join = |part: fn(&Summand) -> &str, separator: &str| {
        summands.iter().map(part).collect::<Vec<_>>().join(separator)
    };
    let name = |k: usize| if summands.len() > 1 { format!("_{}", k + 1) } else { String::new() };
    let potentials = summands.iter().enumerate();
    let potential: Vec<_> = potentials.map(|(k, s)| s.potential.replace('_', &name(k))).collect();
    let problem = format!(
        "space = '{}'\nmetric = 'diag({})'\ninitial.velocity = [{}]\n\
         [forces]\nbody = [{}]\npotential = '{}'\n\
         [integrator]\n{integrator}\n[output]\nend = 1\nevery = 0.25\n",
        join(|s| s.space, "+"),
        join(|s| s.metric, ", "),
        join(|s| s.velocity, ", "),
        join(|s| s.force, ", "),
        potential.join(" + "),
    );
    columns(folder(&problem).path()).into_iter().collect()
}

/// The name of a column of summand `k` (from 1) in a sum; `offset` basis vectors precede the
/// summand.
fn in_sum(name: &str, k: usize, offset: usize) -> String {
    for letter in ["Omega", "H", "h"] {
        if let Some(Ok(index)) = name.strip_prefix(letter).map(str::parse::<usize>) {
            return format!("{letter}{}", index + offset);
        }
    }
    format!("{name}_{k}")
}

/// With fixed steps and with step-size control, in the algebra and in embedding coordinates.
#[test]
fn a_sum_moves_as_its_summands_alone() {
    for summands in [[TOP, POINT], [VEHICLE, BUOY]] {
        for (integrator, bound) in [
            ("method = 'rkmk4'\nstep = 0.01", 1e-13),
            // its stages are off the group, where a sum is evaluated differently from its summands
            ("method = 'projected4'\nstep = 0.01", 1e-9),
            ("method = 'rkmk853'\ntolerance = 1e-13", 1e-11),
            ("method = 'projected853'\ntolerance = 1e-13", 1e-11),
        ] {
            let whole = run(&summands, integrator);
            let (mut energy, mut offset, mut compared) = (vec![0.0; 5], 0, 0);
            for (k, summand) in summands.iter().enumerate() {
                let alone = run(&[*summand], integrator);
                for (name, values) in &alone {
                    if name == "energy" {
                        energy.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
                    }
                    if ["t", "energy"].contains(&&**name) || name.starts_with("casimir") {
                        continue;
                    }
                    let name = in_sum(name, k + 1, offset);
                    for (a, b) in whole[&name].iter().zip(values) {
                        assert!((a - b).abs() < bound, "{integrator}: {name}: {a} and {b}");
                    }
                    compared += 1;
                }
                offset += summand.metric.split(',').count();
            }
            for (a, b) in whole["energy"].iter().zip(&energy) {
                assert!((a - b).abs() < 10.0 * bound, "{integrator}: energy {a} and {b}");
            }
            let own = |name: &&String| *name != "t" && *name != "energy" && !name.contains("cas");
            assert_eq!(compared, whole.keys().filter(own).count(), "{integrator}");
        }
    }
}

/// With a fixed step, a change of one summand does not change any digit of the other.
#[test]
fn a_summand_does_not_change_the_other() {
    let heavy = Summand { metric: "3, 5, 6, 2, 7, 4", velocity: "1, 0, 3, 0, -2, 0", ..BUOY };
    for method in ["rkmk4", "projected4", "cf4"] {
        let integrator = format!("method = '{method}'\nstep = 0.05");
        let [one, other] = [BUOY, heavy].map(|second| run(&[VEHICLE, second], &integrator));
        let first = |name: &str| {
            let number = name.trim_start_matches(|c: char| c.is_ascii_alphabetic());
            name.ends_with("_1") || number.parse::<usize>().is_ok_and(|index| index <= 6)
        };
        let mine = |columns: &BTreeMap<String, Vec<f64>>| -> Vec<_> {
            columns.clone().into_iter().filter(|(name, _)| first(name)).collect()
        };
        // seven numbers of a pose, and six of Omega, H and h each
        assert_eq!(mine(&one).len(), 7 + 18, "{method}: {:?}", one.keys());
        assert_eq!(mine(&one), mine(&other), "{method}");
        assert_ne!(one["x_2"], other["x_2"]);
    }
}
