//! Potentials and tables.

use super::{TOP, columns, folder, refused, simulate, times};
use std::fs;

/// A potential conserves the energy on every group, in both invariances, and its power is the rate of the kinetic
/// energy (109).
#[test]
fn potentials_conserve_the_energy_on_every_group() {
    let cases = [
        ("space = \"so2\"", 1, "g11^2 + g21"),
        ("space = \"so3\"", 3, "g33 + g12*g23"),
        ("space = \"se2\"", 3, "g13^2 + g23*g11"),
        ("space = \"se3\"", 6, "g14^2 + g24*g31 + sin(g34)"),
        ("space = \"sl2\"", 3, "g11^2 + g21^2 + g12^2 + g22^2"),
        ("space = \"heisenberg3\"", 3, "g12^2 + g13^2*g23"),
        (
            "definition.basis = [\"x\", \"y\", \"z\"]\ndefinition.brackets = \"[x, y] = z\"",
            3,
            "x1^2 + x2^4 + x3^2*x1",
        ),
        ("space = \"aff1\"", 2, "1/g11 + g12^2 + g11"),
        ("space = \"su2\"", 3, "g11 + g12^2"),
    ];
    for (space, n, potential) in cases {
        for invariance in ["left", "right"] {
            let metric: Vec<String> = (0..n)
                .map(|i: i32| {
                    let entry = |j: i32| match (i - j).abs() {
                        0 => format!("\"{}/2\"", 2 + i),
                        1 => "\"1/5\"".into(),
                        _ => "\"1/20\"".into(),
                    };
                    format!("[{}]", (0..n).map(entry).collect::<Vec<_>>().join(","))
                })
                .collect();
            let velocity: Vec<String> =
                (0..n).map(|i| format!("{}", 0.3 - 0.2 * f64::from(i))).collect();
            let problem = format!(
                "{space}\nmetric = [{}]\ninvariance = \"{invariance}\"\n\
                 [initial]\nvelocity = [{}]\ncoordinates = [{}]\n\
                 [forces]\npotential = \"{potential}\"\n\
                 [integrator]\ntolerance = 1e-12\n\
                 [output]\nend = 2\nevery = 0.01\ncolumns = [\"t\", \"kinetic\", \"energy\", \"power\"]\n",
                metric.join(","),
                velocity.join(","),
                velocity.join(","),
            );
            let columns = columns(folder(&problem).path());
            let [kinetic, energy, power] = [1, 2, 3].map(|k| &columns[k].1);
            let off = energy.iter().map(|e| (e - energy[0]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-10, "{space}, {invariance}: {off}");
            let moved = kinetic.iter().map(|t| (t - kinetic[0]).abs()).fold(0.0, f64::max);
            assert!(moved > 1e-3, "{space}, {invariance}: the potential does no work");
            // Simpson's rule
            let weighted = power.windows(3).step_by(2).map(|p| p[0] + 4.0 * p[1] + p[2]);
            let work = weighted.sum::<f64>() * 0.01 / 3.0;
            let off = (work - (kinetic[200] - kinetic[0])).abs();
            assert!(off < 1e-5 * (1.0 + moved), "{space}, {invariance}: power off by {off}");
        }
    }
}

/// A table acts between rows far apart, and its corners cost no digits: the impulse is its integral.
#[test]
fn a_table_is_not_passed_over() {
    let thruster = "t,M1,M2,M3\n20,0,0,0\n20.25,0.5,0,0\n20.75,0.5,0,0\n21,0,0,0\n";
    let pulse = "t,a,b,c\n0,0,0,0\n50,0,0,0\n50.001,1000,0,0\n50.002,0,0,0\n";
    for (table, rate, end) in [(thruster, 0.05, 0.425), (pulse, 0.05, 1.05), (pulse, 0.0, 1.0)] {
        for (start, stop, sign) in [(0.0, 100.0, 1.0), (100.0, 0.0, -1.0)] {
            for every in [100.0, 50.0, 7.0, 0.5] {
                for integrator in ["rkmk853", "rkmk54", "projected853"] {
                    let problem = format!(
                        "space = \"so3\"\nmetric = \"diag(1, 2, 2.5)\"\n\
                         [initial]\ntime = {start}\nvelocity = [{rate}, 0, 0]\n\
                         [forces]\ntable = \"table.csv\"\n\
                         [integrator]\nmethod = \"{integrator}\"\n\
                         [output]\nend = {stop}\nevery = {every}\ncolumns = [\"Omega1\", \"t\"]\n"
                    );
                    let folder = folder(&problem);
                    fs::write(folder.path().join("table.csv"), table).unwrap();
                    let found = times(folder.path());
                    assert_eq!(found.len(), (100.0_f64 / every).ceil() as usize + 1);
                    let expected = rate + sign * (end - rate);
                    let off = (found[found.len() - 1] - expected).abs();
                    assert!(off < 1e-10, "{integrator}, {every}: off by {off:e}");
                }
            }
        }
    }
}

/// A table of forces says where it is wrong, and a first row is not taken for names.
#[test]
fn tables_have_names_and_numbers() {
    let folder = folder(&TOP.replace("[forces]", "[forces]\ntable = \"pulse.csv\""));
    let folder = folder.path();
    let cases = [
        ("0,0,0,0\n1,5,0,0\n", "names its columns", "pulse.csv:1:1"),
        ("\u{feff}0, 1/2, -1e3, pi\n1,5,0,0\n", "names its columns", "pulse.csv:1:1"),
        ("# c\nt,a,b,c\n0,1,2,3\n", "`t` is no number", "pulse.csv:2:1"),
        ("t,a,b,c\n\n0,0,0,0\n1,5,x,0\n", "`x` is no number", "pulse.csv:4:5"),
        ("t,a,b,c\n0,0,0,0\n1,5,0\n", "a row of 3 numbers", "pulse.csv:3:1"),
    ];
    for (table, what, place) in cases {
        fs::write(folder.join("pulse.csv"), table).unwrap();
        let message = refused(&mut simulate(folder), 2);
        assert!(message.contains(what) && message.contains(place), "{message}");
    }
}
