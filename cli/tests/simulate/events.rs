//! Events along a motion.

use super::{folder, times};

/// Sections of a free body occur once per period, to 12 digits; the run ends at an event on
/// request.
#[test]
fn events_are_located() {
    const PERIOD: f64 = 6.862_616_178_058_116;
    let body = "space = \"so3\"\nmetric = \"diag(0.6, 0.8, 1)\"\n\
                initial.momentum = [1.8, 0.4, -0.9]\nevents = { section = \"H2\" }\n";
    let integrators = [
        ("method = \"rkmk54\"\ntolerance = 1e-13", 1e-11),
        ("step = 0.01", 1e-12),
        ("method = \"exact\"", 1e-13),
    ];
    for (integrator, tolerance) in integrators {
        let output = "[output]\nend = 30\nevery = 0.3\nsection = \"section\"\n";
        let problem = format!("{body}{output}[integrator]\n{integrator}\n");
        let sections = times(folder(&problem).path());
        // two in each period
        assert_eq!(sections.len(), 9, "{integrator}: {sections:?}");
        for pair in sections.windows(3) {
            assert!((pair[2] - pair[0] - PERIOD).abs() < tolerance, "{integrator}: {pair:?}");
        }
        let problem = problem.replace("section = \"section\"", "stop = \"section\"");
        assert_eq!(times(folder(&problem).path()).last(), sections.first());
    }
}

/// Events between output rows far apart are found: for a body that flips, and for uniform
/// rotations, whose step-size control alone would allow long steps.
#[test]
fn events_are_seen_between_rows_far_apart() {
    let flips = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.1, 2, 0.1]\n\
                 events = { turn = \"H2\" }\n";
    let section = |problem: &str, integrator: &str, every: f64| {
        let output = format!("[output]\nend = 100\nevery = {every}\nsection = \"turn\"\n");
        times(folder(&format!("{problem}{output}[integrator]\n{integrator}\n")).path())
    };
    let same = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8), "{a:?} and {b:?}");
    };
    let all = section(flips, "method = \"dmv10\"\nstep = 0.01", 100.0);
    assert_eq!(all.len(), 14);
    for every in [100.0, 5.0, 0.1] {
        same(&section(flips, "method = \"exact\"", every), &all);
    }
    same(&section(flips, "method = \"rkmk853\"\ntolerance = 1e-14", 100.0), &all);
    // a run stops at the first event, also backwards, where the last event is equally close
    for (end, first) in [(100.0, all[0]), (-100.0, all[0] - (all[1] - all[0]))] {
        let output = format!("[output]\nend = {end}\nstop = \"turn\"\n");
        let found = times(folder(&format!("{flips}{output}")).path());
        assert!((found[found.len() - 1] - first).abs() < 1e-8, "{found:?}, not {first}");
    }
    let turns = "metric = \"identity\"\ninitial.velocity = [0, 0, 1, 0, 0, 0]\n";
    for (space, entry) in [("se3", "g11"), ("so(4)", "g33 - 1/2")] {
        let problem = format!("space = \"{space}\"\n{turns}events = {{ turn = \"{entry}\" }}\n");
        let found = section(&problem, "method = \"rkmk853\"", 100.0);
        let dense = section(&problem, "method = \"rkmk4\"\nstep = 0.05", 100.0);
        assert!(dense.len() > 25, "{space}: {dense:?}");
        assert_eq!(found.len(), dense.len(), "{space}");
    }
}
