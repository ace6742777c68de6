//! Checks that hold for each problem.

#![allow(clippy::excessive_precision, reason = "reference values have 20 to 25 digits")]

use super::references::*;
use super::run::{Run, open};
use affinor::mechanics::MassProperties;
use affinor_documents::problem::Problem;
use nalgebra::{DMatrix, Isometry3, Matrix3, Vector3};

/// A file of the folder, and a check of its motion.
pub type Check = (&'static str, fn(&str));

pub const CHECKS: &[Check] = &[
    // complete elliptic integrals by mpmath with 40 digits: phi of a revolution is
    // 4 K(m)/sqrt(2 M (u3 - u1)), so 2 pi + 5.0186638798136381791e-7
    ("mercury", |name| {
        let problem = open(name);
        let mut integration = problem.integrate(problem.motion(0).unwrap());
        let mut rows = vec![];
        loop {
            let step = integration.step().unwrap();
            rows.extend(step.rows);
            if step.done {
                break;
            }
        }
        assert_eq!(rows.len(), 2);
        let advance = rows[1][2] - std::f64::consts::TAU;
        assert!((advance - 5.0186638798136381791e-7).abs() < 1e-12, "{advance:e}");
        assert!((rows[1][3] - 42.98).abs() < 0.01, "{rows:?}");
    }),
    // 4 M/radius + (15 pi/4 - 4) (M/radius)^2, in arc seconds
    ("light_bending", |name| {
        let run = Run::new(&open(name), 0);
        let m: f64 = 1476.625 / 6.957e8;
        let whole = 4.0 * m + (3.75 * std::f64::consts::PI - 4.0) * m * m;
        let seconds = whole * 180.0 * 3600.0 / std::f64::consts::PI;
        let found = run.column("deflection")[5];
        assert!((found - seconds).abs() < 1e-4, "{found} {seconds}");
    }),
    ("clairaut", |name| Run::new(&open(name), 0).keeps(&["p_phi"], 1e-10)),
    ("free_body", |name| {
        free_body(&open(name), "hairer-vilmart", 1e-13);
        taylor(&Run::new(&open(name), 0), "hairer-vilmart", 1e-13);
    }),
    // initial conditions near the middle axis diverge
    ("dzhanibekov", |name| free_body(&open(name), "dzhanibekov", 1e-11)),
    ("dzhanibekov_long", |name| free_body(&open(name), "dzhanibekov-long", 1e-9)),
    ("hairer_lubich_wanner", |name| {
        free_body(&open(name), "hairer-lubich-wanner", 1e-13);
        let notes = open(name).motion(0).unwrap().notes;
        assert!(notes[0].contains("no body has these moments"), "{notes:?}");
    }),
    ("small_axis", |name| free_body(&open(name), "small-axis", 1e-13)),
    ("separatrix", |name| {
        free_body(&open(name), "separatrix", 1e-12);
        let run = Run::new(&open(name), 0);
        run.keeps(&["sech"], 1e-12);
        assert!(run.column("tanh").iter().all(|off| off.abs() < 1e-13));
    }),
    ("heavy_top", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["energy", "h3"], 1e-9);
        // R chi, and the velocity about the second axis of space
        let centre = run.values(4, &["g12", "g22", "g32"]);
        let expected = [-0.15041682274564, -0.72416559163690, -0.67302226956044];
        assert!(off(&centre, &expected) < 1e-8, "{centre:?}");
        assert!(off(&run.values(4, &["omega2"]), &[-106.16380414312448]) < 1e-8);
        assert!(
            off(&run.values(0, &["energy", "h3"]), &[5435.696790865547, -70.3124296875]) < 1e-14
        );
    }),
    // the second half of the momentum is the vertical direction in the body
    ("heavy_top_reduced", |name| {
        let run = Run::new(&open(name), 0);
        let all = references();
        let motions = all["motions"].as_array().unwrap();
        let top = motions.iter().find(|motion| motion["name"] == "bruels-cardona-arnold").unwrap();
        for state in top["states"].as_array().unwrap() {
            let (element, momentum) = (numbers(&state["element"]), numbers(&state["momentum"]));
            let expected = [&momentum[..], &element[6..]].concat();
            let error = off(&run.vector(run.at(number(&state["time"])), "H"), &expected);
            println!("{name}: {error:.1e}");
            assert!(error < 1e-8, "{error:e}");
        }
        run.keeps(&["energy"], 1e-10);
    }),
    // the same top with constraints, of order 2
    ("heavy_top_held", |name| {
        let error = |problem: &Problem| {
            let run = Run::new(problem, 0);
            assert!(run.column("violation").iter().all(|off| off.abs() < 1e-10));
            let place = run.values(run.rows.len() - 1, &["x", "y", "z"]);
            off(&place, &[-0.15041682274564, -0.72416559163690, -0.67302226956044])
        };
        let problem = open(name);
        let method = problem.motion(0).unwrap().method;
        let (whole, half) =
            (error(&problem), error(&problem.with_method(method, Some(0.0001), Some(1.0))));
        let order = (whole / half).log2();
        println!("{name}: {whole:.1e} {half:.1e}, order {order}");
        assert!(whole < 1e-2 && (order - 2.0).abs() < 0.1, "{whole:e} {half:e}");
    }),
    ("fast_top", |name| {
        let mut problem = open(name);
        for (tilt, reference, energy) in [
            ("tilt=0.05", "simo-wong-05", 1269.975005207899),
            ("tilt=0.3", "simo-wong-3", 1269.106729782512),
        ] {
            problem.set(tilt).unwrap();
            let run = Run::new(&problem, 0);
            taylor(&run, reference, 1e-9);
            run.keeps(&["energy", "h3", "spin"], 1e-11);
            assert!(off(&run.values(0, &["energy"]), &[energy]) < 1e-15);
        }
    }),
    ("body_in_potential", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "hairer-vilmart-potential", 1e-10);
        run.keeps(&["energy", "vertical"], 1e-11);
        assert!(off(&run.values(0, &["energy", "vertical"]), &[4.205, -0.9]) < 1e-15);
    }),
    ("kovalevskaya", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "kovalevskaya", 1e-8);
        run.keeps(&["energy", "h3", "k"], 1e-10);
        assert_eq!(run.column("k")[0], 1.0);
    }),
    ("romano_constant", |name| taylor(&Run::new(&open(name), 0), "romano-constant", 1e-11)),
    ("romano_axial", |name| taylor(&Run::new(&open(name), 0), "romano-axial", 1e-11)),
    ("romano_transverse", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "romano-transverse", 1e-11);
        run.keeps(&["spin"], 1e-11);
    }),
    ("coning", |name| {
        let run = Run::new(&open(name), 0);
        let coning = &references()["coning"];
        let row = run.at(number(&coning["time"]));
        // with three unit moments the momentum equals the velocity
        let velocity = off(&run.vector(row, "Omega"), &numbers(&coning["momentum"]));
        let element = off(run.matrix(row).transpose().as_slice(), &numbers(&coning["element"]));
        println!("coning: {element:.1e} {velocity:.1e}");
        assert!(element < 1e-12 && velocity < 1e-13, "{element:e} {velocity:e}");
    }),
    ("kirchhoff", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "kirchhoff", 1e-11);
        run.keeps(&["energy", "Pi_P", "P_P", "casimir1", "casimir2"], 1e-11);
    }),
    ("clebsch", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "clebsch", 1e-11);
        run.keeps(&["energy", "Pi_P", "P_P", "clebsch"], 1e-11);
    }),
    ("manakov_so4", |name| manakov(name, 4)),
    ("manakov_so5", |name| manakov(name, 5)),
    ("euler_poincare_so4", |name| {
        let run = Run::new(&open(name), 0);
        // e1, e2, ... are the planes from the last, with alternating signs
        let mut turned = Run { name: run.name.clone(), names: run.names.clone(), rows: vec![] };
        let at = |i: usize| run.names.iter().position(|own| *own == format!("H{i}")).unwrap();
        for row in &run.rows {
            let mut new = row.clone();
            for (i, sign) in [1.0, -1.0, 1.0, 1.0, -1.0, 1.0].into_iter().enumerate() {
                new[at(6 - i)] = sign * row[at(i + 1)];
            }
            turned.rows.push(new);
        }
        taylor(&turned, "so(4)", 1e-11);
        run.keeps(&["energy", "norm_squared", "pfaffian", "casimir1", "casimir2"], 1e-11);
    }),
    ("geodesic_sl2", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "sl(2)", 1e-11);
        run.keeps(&["energy", "determinant", "casimir1"], 1e-11);
    }),
    ("geodesic_flags", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["energy", "h1", "norm_u"], 1e-11);
        // the metric is not naturally reductive: the velocity in the frame changes
        let at = run.names.iter().position(|own| own == "v_m1").unwrap();
        assert!(run.rows.iter().all(|row| row == &run.rows[0] || row[at] < 0.29));
    }),
    ("geodesic_heisenberg", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "heisenberg(3)", 1e-11);
        run.keeps(&["energy", "centre"], 1e-10);
    }),
    ("geodesic_aff1", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "aff(1)", 1e-11);
        run.keeps(&["energy"], 1e-11);
    }),
    ("geodesic_se2", |name| {
        let run = Run::new(&open(name), 0);
        taylor(&run, "se(2)", 1e-11);
        run.keeps(&["energy", "P_P"], 1e-11);
    }),
    // g for a right-invariant metric is the inverse of g for the left-invariant metric with the
    // opposite velocity
    ("fluid_se2", |name| {
        let problem = open(name);
        let text = problem.text().replace("\"right\"", "\"left\"");
        let text = text.replace("spatial_velocity = [0.3, 1, -0.5]", "velocity = [-0.3, -1, 0.5]");
        let left = Run::new(&Problem::parse("left.toml", &text).unwrap(), 0);
        let right = Run::new(&problem, 0);
        let row = right.rows.len() - 1;
        let product = right.matrix(row) * left.matrix(row);
        assert!((product - DMatrix::identity(3, 3)).amax() < 1e-8);
        assert!((right.matrix(row) - right.matrix(0)).amax() > 1.0);
        right.keeps(&["H1", "H2", "H3"], 1e-12);
        right.keeps(&["energy", "casimir1"], 1e-9);
    }),
    ("toda", |name| toda(name, 3)),
    ("toda_six", |name| toda(name, 6)),
    ("zeitlin_su3", |name| zeitlin(name, 3)),
    ("zeitlin_su5", |name| zeitlin(name, 5)),
    ("zeitlin", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["enstrophy", "L1", "L2", "L3", "lambda1", "lambda17", "lambda33"], 1e-13);
        let halved = open(name);
        let halved = halved.with_method(halved.motion(0).unwrap().method, Some(0.025), Some(1.0));
        let order = (run.drift("energy") / Run::new(&halved, 0).drift("energy")).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }),
    ("torque_in_space", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["h1_off", "h2", "h3_off"], 1e-13);
    }),
    // the area of the trapezoid is 0.75 times its height
    ("thruster", |name| {
        let run = Run::new(&open(name), 0);
        let (before, after) = (run.at(1.0), run.at(2.0));
        for row in [0, before, after, run.rows.len() - 1] {
            let push = if row < after { 0.0 } else { 0.75 };
            let expected = [0.5 * push, 0.0, 2.5 - 0.25 * push];
            let error = off(&run.vector(row, "h"), &expected);
            println!("thruster in row {row}: {error:.1e}");
            assert!(error < 1e-9, "{error:e}");
        }
    }),
    // free until the thrusters fire, then slower and slower
    ("satellite", |name| {
        let run = Run::new(&open(name), 0);
        let (fire, last) = (run.at(58.0), run.rows.len() - 1);
        let kinetic = run.column("kinetic");
        assert!(kinetic[..=fire].iter().all(|energy| (energy / kinetic[0] - 1.0).abs() < 1e-8));
        assert!(kinetic[run.at(62.0)..].windows(2).all(|pair| pair[1] <= pair[0]));
        let second = run.column("Omega2");
        assert!(second[..=fire].windows(2).any(|pair| pair[0] * pair[1] < 0.0), "it tumbles");
        let rate = |row: usize| run.vector(row, "Omega").iter().map(|x| x * x).sum::<f64>().sqrt();
        let limit = std::f64::consts::PI / 360.0;
        assert!(rate(run.at(214.0)) > limit && rate(run.at(216.0)) < limit && rate(last) < 1e-6);
    }),
    // the axis precesses about the vertical with constant tilt and rate
    ("precessing_top", |name| {
        let run = Run::new(&open(name), 0);
        let (sin, cos) = std::f64::consts::FRAC_PI_6.sin_cos();
        for (row, t) in run.column("t").into_iter().enumerate() {
            let axis = run.values(row, &["g13", "g23", "g33"]);
            let expected = [sin * (12.0 * t).sin(), -sin * (12.0 * t).cos(), cos];
            assert!(off(&axis, &expected) < 1e-8, "{axis:?} at {t}");
        }
        run.keeps(&["energy", "h3"], 1e-9);
    }),
    ("million_steps", |name| {
        let mut problem = open(name);
        assert_eq!(problem.times(0).unwrap().len(), 1001);
        problem.set("steps=2000").unwrap();
        let run = Run::new(&problem, 0);
        run.keeps(&["energy"], 1e-8);
        run.keeps(&["h3"], 1e-12);
    }),
    // (109): the energy changes by the power, which is integrated by Simpson's rule here
    ("friction", |name| {
        let run = Run::new(&open(name), 0);
        let (energy, power) = (run.column("energy"), run.column("power"));
        assert!(energy.windows(2).all(|pair| pair[1] < pair[0]));
        assert!(power.iter().all(|power| *power < 0.0));
        let work = simpson(&power, 0.05);
        let last = energy.len() - 1;
        assert!((energy[last] - energy[0] - work).abs() < 1e-6, "{work}");
        let dissipation = |row: usize| {
            let d = [0.1, 0.2, 0.3];
            let squares = run.vector(row, "Omega").into_iter().zip(d).map(|(x, d)| d * x * x);
            squares.sum::<f64>()
        };
        assert!((0..=last).all(|row| (power[row] + dissipation(row)).abs() < 1e-14));
    }),
    ("double_bracket", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["length"], 1e-12);
        assert!(!run.has("casimir1"));
        let energy = run.column("energy");
        assert!(energy.windows(2).all(|pair| pair[1] <= pair[0] + 1e-14));
        // all members rotate about the axis of the largest moment
        let square = run.column("length")[0].powi(2);
        assert!((energy[energy.len() - 1] - square / 5.0).abs() < 1e-12);
    }),
    ("ensemble_grid", |name| {
        let problem = open(name);
        assert_eq!(problem.members(), Some(15));
        assert_eq!(problem.varied(), ["tilt", "spin"]);
        for member in 0..15 {
            let (tilt, spin) = (0.1 * (1 + member / 3) as f64, f64::from(2 << (member % 3)));
            assert!(off(&problem.variation(member), &[tilt, spin]) < 1e-15);
            let run = Run::new(&problem, member);
            let start = [tilt.cos(), 0.5 * spin * spin + tilt.cos()];
            assert!(off(&run.values(0, &["R33", "energy"]), &start) < 1e-15);
            run.keeps(&["energy"], 1e-9);
        }
    }),
    ("ensemble_random", |name| {
        let problem = open(name);
        assert_eq!(problem.members(), Some(100));
        let all: Vec<Vec<f64>> = (0..100).map(|member| problem.variation(member)).collect();
        let mean = |k: usize| all.iter().map(|values| values[k]).sum::<f64>() / 100.0;
        let square = |k: usize| all.iter().map(|values| values[k].powi(2)).sum::<f64>() / 100.0;
        // standard deviations: normal 0.01, uniform 0.1/sqrt(3)
        assert!(mean(0).abs() < 0.004 && (0.007..0.013).contains(&square(0).sqrt()));
        assert!(mean(1).abs() < 0.02 && (0.045..0.07).contains(&square(1).sqrt()));
        assert!(all.iter().all(|values| values[1].abs() <= 0.1 && values[2].abs() <= 0.1));
        for member in [0, 41, 99] {
            let run = Run::new(&problem, member);
            assert!(off(&run.values(0, &["H1"]), &[all[member as usize][0]]) < 1e-15);
            run.keeps(&["energy", "casimir1"], 1e-12);
            assert_eq!(Run::new(&problem, member).rows, run.rows);
        }
    }),
    // a parabola
    ("thrown_ball", |name| {
        let run = Run::new(&open(name), 0);
        for (row, t) in run.column("t").into_iter().enumerate() {
            assert!(off(&run.vector(row, "x"), &[3.0 * t, 12.0 * t - 3.0 * t * t]) < 1e-14);
            assert!(off(&run.vector(row, "Omega"), &[3.0, 12.0 - 6.0 * t]) < 1e-14);
        }
        run.keeps(&["energy"], 1e-14);
    }),
    ("top_of_parts", |name| {
        let problem = open(name);
        // a disc of mass 0.2 on a rod of mass 0.02, about the tip
        let (m, r, h, at) = (0.2, 0.05, 0.01, 0.04);
        let across = m * (r * r / 4.0 + h * h / 12.0 + at * at) + 0.02 * 0.06 * 0.06 / 3.0;
        let expected = Matrix3::from_diagonal(&Vector3::new(across, across, 0.5 * m * r * r));
        let inertia = problem.motion(0).unwrap().inertia.unwrap();
        assert!(off(inertia.as_slice(), expected.as_slice()) < 1e-17, "{inertia}");
        let run = Run::new(&problem, 0);
        run.keeps(&["energy", "h3", "H3"], 1e-9);
        let weight = 9.81 * (0.2 * 0.04 + 0.02 * 0.03);
        let kinetic = 0.5 * expected[(2, 2)] * 200.0 * 200.0;
        let energy = kinetic + weight * 0.2_f64.cos();
        assert!(off(&run.values(0, &["energy"]), &[energy]) < 1e-15);
    }),
    ("body_of_mesh", |name| {
        let problem = open(name);
        // a box 1 x 2 x 3 with a bore along the first axis
        let block = MassProperties::cuboid(&Vector3::new(1.0, 2.0, 3.0)).unwrap();
        let bore = MassProperties::cylinder(0.25, 1.0).unwrap();
        let bore = bore.moved(&Isometry3::rotation(Vector3::y() * std::f64::consts::FRAC_PI_2));
        let body = block.subtract(&bore).unwrap().of_density(2.0).unwrap();
        let inertia = problem.motion(0).unwrap().inertia.unwrap();
        let metric = body.metric().unwrap();
        for i in 0..6 {
            for j in 0..6 {
                let expected = metric.components().get(&[i, j]);
                assert!((inertia[(i, j)] - expected).abs() < 1e-13, "{inertia}");
            }
        }
        Run::new(&problem, 0).keeps(&["energy", "h1", "h2", "h3", "h4", "h5", "h6"], 1e-9);
    }),
    ("gyrostat", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["energy", "H4", "h1", "h2", "h3"], 1e-8);
        let expected = &joints()[name];
        let row = run.at(number(&expected["time"]));
        let momentum = run.values(row, &["H1", "H2", "H3"]);
        assert!(off(&momentum, &numbers(&expected["momentum"])) < 1e-8, "{momentum:?}");
        let found = run.values(row, &["qw_1", "qx_1", "qy_1", "qz_1"]);
        let q = numbers(&expected["quaternion"]);
        let opposite: Vec<f64> = q.iter().map(|x| -x).collect();
        assert!(off(&found, &q).min(off(&found, &opposite)) < 1e-8, "{found:?}");
    }),
    // of order 2, with constraint forces of the joints
    ("double_pendulum", |name| {
        let expected = &joints()[name];
        let axes = ["g13_1", "g23_1", "g33_1", "g13_2", "g23_2", "g33_2"];
        let error = |problem: &Problem| {
            let run = Run::new(&problem.with_columns(&[&["t"], &axes[..]].concat()), 0);
            assert!(run.column("violation").iter().all(|off| off.abs() < 1e-10));
            let down = run
                .values(run.at(number(&expected["time"])), &axes)
                .iter()
                .map(|x| -x)
                .collect::<Vec<_>>();
            off(&down, &numbers(&expected["directions"]))
        };
        let problem = open(name);
        let method = problem.motion(0).unwrap().method;
        let (whole, half) =
            (error(&problem), error(&problem.with_method(method, Some(0.0005), None)));
        let order = (whole / half).log2();
        println!("{name}: {whole:.1e} {half:.1e}, order {order}");
        assert!(whole < 1e-3 && (order - 2.0).abs() < 0.1, "{whole:e} {half:e}");
    }),
    // the sleigh turns round: the edge slides with the speed of the same energy in the end
    ("sleigh", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["energy"], 1e-10);
        let (m, a, inertia) = (2.0f64, 0.3f64, 0.5f64);
        let about = inertia + m * a * a;
        let top = (2.0 * run.column("energy")[0] / m).sqrt();
        let (start, rate) = ((-0.5 / top).atanh(), a * m * top / about);
        for (time, speed) in run.column("t").into_iter().zip(run.column("Omega2")) {
            assert!((speed - top * (rate * time + start).tanh()).abs() < 1e-10, "{time}");
        }
    }),
    // its numbers at the end are those of an independent program: see `nonholonomic`
    ("rolling_disk", |name| {
        let run = Run::new(&open(name), 0);
        run.keeps(&["energy"], 1e-8);
        assert!(run.column("violation").iter().all(|off| off.abs() < 1e-12));
        let place = run.values(run.at(2.0), &["x", "y"]);
        assert!(off(&place, &[0.88976451932, -5.41445916605]) < 1e-9, "{place:?}");
    }),
    ("joined_bodies", |name| {
        let run = Run::new(&open(name), 0);
        let sums = ["linear1", "linear2", "linear3", "angular1", "angular2", "angular3"];
        run.keeps(&sums, 1e-4);
        run.keeps(&["energy"], 1e-4);
        assert!(run.column("violation").iter().all(|off| off.abs() < 1e-10));
    }),
];

fn simpson(values: &[f64], h: f64) -> f64 {
    let last = values.len() - 1;
    assert!(last.is_multiple_of(2));
    let weight = |k: usize| match k {
        0 => 1.0,
        k if k == last => 1.0,
        k if k.is_multiple_of(2) => 2.0,
        _ => 4.0,
    };
    values.iter().enumerate().map(|(k, value)| weight(k) * value).sum::<f64>() * h / 3.0
}
