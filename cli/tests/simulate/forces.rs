//! Potentials and tables.

use super::{TOP, columns, done, folder, refused, simulate, times};
use std::fs;

/// A potential conserves the energy on every group, for both invariances. Its power is the time
/// derivative of the kinetic energy (109).
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

/// A force table with kinks between two output rows is integrated without loss of accuracy: the
/// impulse is its integral.
#[test]
fn a_table_is_not_passed_over() {
    let thruster = "t,M1,M2,M3\n20,0,0,0\n20.25,0.5,0,0\n20.75,0.5,0,0\n21,0,0,0\n";
    let pulse = "t,M1,M2,M3\n0,0,0,0\n50,0,0,0\n50.001,1000,0,0\n50.002,0,0,0\n";
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

/// An error in a table of forces has its location, and a first row of numbers is not read as names.
#[test]
fn tables_have_names_and_numbers() {
    let folder = folder(&TOP.replace("[forces]", "[forces]\ntable = \"pulse.csv\""));
    let folder = folder.path();
    let cases = [
        ("0,0,0,0\n1,5,0,0\n", "must name its columns", "pulse.csv:1:1"),
        ("\u{feff}0, 1/2, -1e3, pi\n1,5,0,0\n", "must name its columns", "pulse.csv:1:1"),
        ("# c\nt,M1,M2,M3\n0,1,2,3\n", "`t` is not a number", "pulse.csv:2:1"),
        ("t,M1,M2,M3\n\n0,0,0,0\n1,5,x,0\n", "`x` is not a number", "pulse.csv:4:5"),
        ("t,M1,M2,M3\n0,0,0,0\n1,5,0\n", "a row of 3 numbers", "pulse.csv:3:1"),
        ("t,M1,M2,M3\n0,1,,0,0\n", "a value is missing", "pulse.csv:2:1"),
        ("t,M1,M2,M3\n0,1 2,0,0\n", "is not a single number", "pulse.csv:2:1"),
        ("t,M1,M2,M1\n0,1,0,0\n", "two columns have the name `M1`", "pulse.csv:1:1"),
        ("t,x,y,z\n0,1,0,0\n", "no column `M1`", "top.toml"),
        ("time,M1,M2,M3\n0,1,0,0\n", "no column `t`", "top.toml"),
        ("t,M1,M2,M4\n0,1,0,0\n", "no column `M3`", "top.toml"),
        ("t,M1,M2,M3\n0,1,0,0\n1,NaN,0,0\n", "row 2 of the table is not finite", "top.toml"),
    ];
    for (table, what, place) in cases {
        fs::write(folder.join("pulse.csv"), table).unwrap();
        let message = refused(&mut simulate(folder), 2);
        assert!(message.contains(what) && message.contains(place), "{message}");
    }
}

/// Adaptive steps end at the discontinuities of a table, and a stage there uses the value on its
/// own side. So the impulse is exact at a tolerance that would allow a large error, in both
/// directions of time. The impulse of fixed steps that end at the discontinuities is exact too.
#[test]
fn tables_jump_and_hold() {
    // pairs of a table and its impulse
    let pulse = ("t,M1,M2,M3\n1,0,0,0\n1,8,0,0\n1.25,8,0,0\n1.25,0,0,0\n", 2.0);
    let saw = ("t,M1,M2,M3\n0,0,0,0\n1,4,0,0\n1,-1,0,0\n3,-1,0,0\n3,2,0,0\n4,0,0,0\n", 1.0);
    let held = ("t,M1,M2,M3\n0.5,1,0,0\n1,-3,0,0\n2,0.5,0,0\n4,0,0,0\n", 0.5 + 0.5 - 3.0 + 1.0);
    let methods = [
        "method = \"rkmk853\"\ntolerance = 1e-3",
        "method = \"rkmk54\"\ntolerance = 1e-3",
        "method = \"rkmk4\"\nstep = 0.25",
    ];
    for ((table, impulse), key) in [(pulse, ""), (saw, "linear"), (held, "hold")] {
        let key =
            if key.is_empty() { String::new() } else { format!("interpolation = \"{key}\"\n") };
        for (start, stop, sign) in [(0, 4, 1.0), (4, 0, -1.0)] {
            for (method, every) in methods.iter().flat_map(|method| [(method, 4.0), (method, 0.5)])
            {
                let problem = format!(
                    "space = \"so3\"\nmetric = \"diag(2, 3, 4)\"\n\
                     [initial]\ntime = {start}\nvelocity = [0.5, 0, 0]\n\
                     [forces]\ntable = \"table.csv\"\n{key}\
                     [integrator]\n{method}\n\
                     [output]\nend = {stop}\nevery = {every}\ncolumns = [\"Omega1\"]\n"
                );
                let folder = folder(&problem);
                fs::write(folder.path().join("table.csv"), table).unwrap();
                let found = times(folder.path());
                let off = (found[found.len() - 1] - (0.5 + sign * impulse / 2.0)).abs();
                assert!(off < 1e-14, "{method}, {every}, {start}: off by {off:e}\n{table}");
            }
        }
    }
}

/// A row at a discontinuity has the value after it, also if the run resumes there.
#[test]
fn rows_at_a_jump_have_the_value_after_it() {
    let problem = "space = \"so2\"\nmetric = \"identity\"\ninitial.velocity = [1]\n\
                   forces = { table = \"table.csv\" }\n\
                   [output]\nend = 2\nevery = 1\ncolumns = [\"power\", \"Omega1\"]\n";
    let folder = folder(problem);
    fs::write(folder.path().join("table.csv"), "t,M1\n1,0\n1,3\n").unwrap();
    let columns = columns(folder.path());
    for (found, expected) in columns.iter().zip([[0.0, 3.0, 12.0], [1.0, 1.0, 4.0]]) {
        let off = found.1.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-13, "{found:?}");
    }
}

/// Functions with discontinuities or kinks: their values, and a potential with them that conserves
/// the energy.
#[test]
fn formulas_with_corners() {
    type Function = fn(f64) -> f64;
    let cases: [(&str, Function); 9] = [
        ("min(t, 1/2)", |t| t.min(0.5)),
        ("max(t, 1/2, 1 - t, 2*t - 1)", |t| t.max(0.5).max(1.0 - t)),
        ("sign(t - 1/2)", |t| if t == 0.5 { 0.0 } else { (t - 0.5).signum() }),
        ("step(t - 1/2)", |t| f64::from(u8::from(t >= 0.5))),
        ("floor(2*t - 1/4)", |t| (2.0 * t - 0.25).floor()),
        ("atan2(t - 1/2, -1)", |t| (t - 0.5).atan2(-1.0)),
        ("atan2(0, -1)", |_| std::f64::consts::PI),
        ("(1 + step(t - 1/2))*min(t, t^2)", |t| (1.0 + f64::from(u8::from(t >= 0.5))) * t * t),
        ("max(-t, min(t, 1, 3))", |t| t),
    ];
    let named: Vec<String> =
        cases.iter().enumerate().map(|(k, (text, _))| format!("k{k} = \"{text}\"\n")).collect();
    let problem = format!(
        "space = \"so2\"\nmetric = \"identity\"\ninitial.velocity = [\"max(1, 2)\"]\n\
         output = {{ end = 1, every = 0.125, columns = [\"t\", \"Omega1\"] }}\n[quantities]\n{}",
        named.concat()
    );
    let columns = columns(folder(&problem).path());
    assert_eq!(columns[1].1, [2.0; 9]);
    for ((text, value), (_, found)) in cases.iter().zip(&columns[2..]) {
        let expected: Vec<f64> = columns[0].1.iter().map(|t| value(*t)).collect();
        assert_eq!(*found, expected, "{text}");
    }
}

/// A point that bounces on a spring, and a point that slides over a kink: potentials that are
/// smooth except at one position.
#[test]
fn potentials_with_corners_conserve_the_energy() {
    for potential in [
        "x1 + 50*max(0, -x1)^2",
        "x1 + 50*max(-x1, 0, -2)^2",
        "x1 + 25*step(-x1)*(1 - sign(x1))*x1^2",
        "x1 - 50*min(0, x1)*max(-x1, 0)",
        "x1 + 50*(abs(x1) - x1)^2/4",
        "cos(2*atan2(x1, x2 + 2)) + x1^2 + floor(0.25)*x1",
    ] {
        let problem = format!(
            "space = \"R^2\"\nmetric = \"identity\"\n\
             initial = {{ velocity = [0, 0.1], coordinates = [1, 0] }}\nforces.potential = \"{potential}\"\n\
             integrator = {{ tolerance = 1e-12, max_step = 0.01 }}\n\
             output = {{ end = 6, every = 0.1, columns = [\"energy\", \"Omega1\", \"x1\"] }}\n"
        );
        let columns = columns(folder(&problem).path());
        let off = columns[0].1.iter().map(|e| (e - columns[0].1[0]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{potential}: {off:e}");
        // it goes down and comes back
        let turns = columns[1].1.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
        assert!(turns >= 1, "{potential}");
    }
}

/// An error names the number of arguments of a function.
#[test]
fn functions_take_their_arguments() {
    let cases = [
        ("min(t)", "`min` takes two arguments or more, not 1"),
        ("atan2(t)", "`atan2` takes two arguments, not 1"),
        ("atan2(t, 1, 2)", "`atan2` takes two arguments, not 3"),
        ("sin(t, 1)", "`sin` takes one argument, not 2"),
        ("wind(t, 1)", "`wind` is not a function: there are sin, cos"),
        ("hold(t)", "sign, step, floor, min, max, atan2"),
        ("min(t, )", "`)` is not expected here"),
        ("(t, 1)", "`,` is not expected here"),
    ];
    for (formula, expected) in cases {
        let quantity = format!("{TOP}[quantities]\nk = \"{formula}\"\n");
        let message = refused(&mut simulate(folder(&quantity).path()), 2);
        assert!(message.contains(expected), "{message}");
    }
}

/// Columns are found by their names, in any order.
#[test]
fn columns_of_a_table_in_another_order() {
    let folder = folder(&TOP.replace("[forces]", "[forces]\ntable = \"pulse.csv\""));
    let folder = folder.path();
    let rows = |table: &str| {
        fs::write(folder.join("pulse.csv"), table).unwrap();
        done(&mut simulate(folder)).stdout
    };
    let expected = rows("t,M1,M2,M3\n0,1,2,3\n5,0,1,-1\n");
    assert!(rows("M3,M1,t,M2\n3,1,0,2\n-1,0,5,1\n") == expected);
    assert!(rows("t,M2,M1,M3\n0,1,2,3\n5,0,1,-1\n") != expected);
}

/// A table with other names of columns gives the same rows as the table with the names of
/// components. Missing components are zero, and additional columns are ignored.
#[test]
fn mapped_columns_of_a_table() {
    let rows = |columns: &str, table: &str| {
        let forces = format!("[forces]\ntable = \"log.csv\"\n{columns}");
        let folder = folder(&TOP.replace("[forces]", &forces));
        fs::write(folder.path().join("log.csv"), table).unwrap();
        done(&mut simulate(folder.path())).stdout
    };
    let expected = rows("", "t,M1,M2,M3\n0,1,0,3\n5,0,0,-1\n");
    let log = "time,yaw,battery,roll\n0,3,7,1\n5,-1,6,0\n";
    assert!(rows("columns = { t = 'time', M1 = 'roll', M3 = 'yaw' }", log) == expected);
    assert!(rows("columns = { M3 = 'yaw', M1 = 'roll' }", &log.replace("time", "t")) == expected);
    // the last component has no column
    let expected = rows("", "t,M1,M2,M3\n0,1,0,0\n5,0,0,0\n");
    assert!(rows("columns = { t = 'time', M1 = 'roll' }", log) == expected);
    for (columns, message) in [
        (
            "{ t = 'time', M1 = 'pitch' }",
            "the table has no column `pitch`; its columns are time, yaw",
        ),
        ("{ t = 'time', M0 = 'yaw' }", "`M0` is neither t nor a component"),
        ("{ t = 'time', roll = 'M1' }", "the table has no column `M1`"),
        ("{ t = 'time', M4 = 'yaw' }", "the table has 4 components, but the dimension is 3"),
        ("{ M1 = 'roll' }", "no column is the time"),
        ("{ t = 'time' }", "no column with a component"),
    ] {
        let forces = format!("[forces]\ntable = \"log.csv\"\ncolumns = {columns}");
        let folder = folder(&TOP.replace("[forces]", &forces));
        fs::write(folder.path().join("log.csv"), log).unwrap();
        let found = refused(&mut simulate(folder.path()), 2);
        assert!(found.contains(message), "{columns}: {found}");
    }
}

/// A rounded initial element is an error with advice. On request it is restored: the motion starts
/// at the nearest rotation.
#[test]
fn a_rounded_initial_element_is_restored() {
    let rounded = "element = [[0.866, -0.5, 0], [0.5, 0.866, 0], [0, 0, 1]]";
    let start = |initial: &str| {
        format!(
            "space = \"so3\"\nmetric = \"diag(1,2,3)\"\n[initial]\n{initial}\nvelocity = [0, 0, 1]\n\
             [output]\nend = 1\nevery = 1\ncolumns = [\"t\", \"g\"]\n"
        )
    };
    let refusal = refused(&mut simulate(folder(&start(rounded)).path()), 1);
    assert!(refusal.contains("restore = true in [initial]"), "{refusal}");
    let restored =
        done(&mut simulate(folder(&start(&format!("{rounded}\nrestore = true"))).path()));
    let note = String::from_utf8_lossy(&restored.stderr).into_owned();
    assert!(note.contains("the initial element is restored"), "{note}");
    // the polar decomposition: a rotation by atan2(0.5, 0.866)
    let angle = 0.5_f64.atan2(0.866);
    let exact =
        done(&mut simulate(folder(&start(&format!("coordinates = [0, 0, {angle}]"))).path()));
    let numbers = |output: &[u8]| -> Vec<f64> {
        let text = String::from_utf8_lossy(output);
        text.lines().skip(1).flat_map(|line| line.split(',')).map(|x| x.parse().unwrap()).collect()
    };
    for (a, b) in numbers(&restored.stdout).iter().zip(numbers(&exact.stdout)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

/// Log files may have quoted names and columns of words; only the columns that are used must be
/// numbers.
#[test]
fn columns_that_are_not_named_may_have_words() {
    let problem = "space = \"so3\"\nmetric = \"identity\"\ninitial.velocity = [0, 0, 0]\n\
                   forces = { table = \"log.csv\", columns = { t = \"time\", M1 = \"roll\" } }\n\
                   [output]\nend = 2\nevery = 1\ncolumns = [\"Omega1\"]\n";
    let folder = folder(problem);
    fs::write(
        folder.path().join("log.csv"),
        "\"time\",\"roll\",status\n0,1,armed\n1,2,up\n2,0,down\n",
    )
    .unwrap();
    let found = times(folder.path());
    for (found, exact) in found.iter().zip([0.0, 1.5, 2.5]) {
        assert!((found - exact).abs() < 1e-12, "{found}");
    }
}
