//! Parameters of problems: all values that depend on a parameter follow it, from the command line
//! and in an ensemble.
//!
//! Guards `documents::problem`: its parameters, ensembles and columns.

use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;

const TOP: &str = include_str!("../../../examples/motions/heavy_top.toml");

/// A body whose numbers all come from parameters.
const BODY: &str = r#"
space = "so3"
metric = "diag(J, J + 1, J + 2)"
[parameters]
m = 1
J = "1 + m"
T = "2*m"
[initial]
time = "m/2"
velocity = ["m", 0, 0]
[integrator]
method = "rkmk4"
step = "m/10"
[output]
end = "T"
every = "m/4"
columns = ["t", "H1"]
"#;

fn rows(problem: &Problem, member: u64) -> Vec<Vec<f64>> {
    let mut integration = problem.integrate(problem.motion(member).unwrap());
    let mut rows = vec![];
    loop {
        let left = integration.step().unwrap();
        rows.extend(left.rows);
        if left.done {
            return rows;
        }
    }
}

fn set(text: &str, settings: &str) -> Problem {
    let mut problem = Problem::parse("body.toml", text).unwrap();
    problem.set(settings).unwrap();
    problem
}

/// The error for a problem, as it is displayed.
fn refused(text: &str) -> String {
    let problem = Problem::parse("body.toml", text);
    let error: InputError = problem.and_then(|problem| problem.motion(0).map(drop)).unwrap_err();
    format!("{error:?}")
}

/// Setting a parameter is the same as editing the file: dependent masses, times and steps change
/// too.
#[test]
fn a_setting_is_an_edit() {
    let edited = TOP.replace("m  = 15", "m  = 20");
    assert_ne!(edited, TOP);
    let edited = Problem::parse("top.toml", &edited).unwrap();
    assert_eq!(rows(&set(TOP, "m = 20"), 0), rows(&edited, 0));
    let edited = Problem::parse("body.toml", &BODY.replace("m = 1\n", "m = 2\n")).unwrap();
    let found = rows(&set(BODY, "m=2"), 0);
    assert_eq!(found, rows(&edited, 0));
    let times: Vec<f64> = found.iter().map(|row| row[0]).collect();
    assert_eq!(times, [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
    assert!(found.iter().all(|row| (row[1] - 6.0).abs() < 1e-12), "{found:?}");
    // the last setting is used, and values that are set depend on nothing
    assert_eq!(rows(&set(BODY, "m=3,m=2"), 0), found);
    let [first, .., last] = &rows(&set(BODY, "J=7"), 0)[..] else { panic!() };
    assert!((first[1] - 7.0).abs() < 1e-12 && last[0] == 2.0);
}

#[test]
fn members_of_an_ensemble_follow_theirs() {
    let text = format!("{BODY}\n[ensemble]\ngrid = {{ m = \"1, 2, 4\", other = \"5, 6\" }}\n");
    let problem = Problem::parse("body.toml", &text).unwrap();
    for (member, m) in [(0, 1.0), (2, 2.0), (5, 4.0)] {
        let found = rows(&problem, member);
        assert!((found[0][1] - m * (1.0 + m)).abs() < 1e-12, "{found:?}");
        assert_eq!([found[0][0], found[found.len() - 1][0]], [m / 2.0, 2.0 * m]);
    }
    // a parameter that is set is not varied by the ensemble
    let mut problem = problem;
    problem.set("m=3").unwrap();
    assert_eq!((problem.members(), problem.varied()), (Some(2), vec!["other"]));
    assert_eq!(rows(&problem, 0)[0][..2], [1.5, 12.0]);
    // an end time that only the ensemble defines
    let text = text.replace("T = \"2*m\"\n", "").replace("other", "T");
    let problem = Problem::parse("body.toml", &text).unwrap();
    assert_eq!(rows(&problem, 1).last().unwrap()[0], 6.0);
}

/// Keys that a method or a flow ignores, or that are never used, are errors.
#[test]
fn idle_keys_are_refused() {
    let with = |lines: &str| BODY.replace("method = \"rkmk4\"\nstep = \"m/10\"\n", lines);
    let cases = [
        (with("method = \"exact\"\nstep = 0.1\n"), "the method exact has no `step`"),
        (with("method = \"rkmk853\"\nstep = 0.1\n"), "the method rkmk853 has no `step`"),
        (with("tolerance = 1e-9\n"), "the method exact has no `tolerance`"),
        (with("step = 0.1\ntolerance = 1e-9\n"), "the method dmv10 has no `tolerance`"),
        (with("step = 0.1\nmax_steps = 9\n"), "the method dmv10 has no `max_steps`"),
        (format!("{BODY}\n[forces]\nbody = []\n"), "`body` is empty"),
        (format!("constraints = []\n{BODY}"), "`constraints` is empty"),
        (format!("{BODY}\n[ensemble]\nseed = 3\n"), "`ensemble` is empty"),
    ];
    for (text, expected) in cases {
        assert!(refused(&text).contains(expected), "{}", refused(&text));
    }
    let flow = |keys: &str| format!("output.end = 1\nintegrator.step = 0.1\n[flow]\n{keys}\n");
    let toda = "kind = \"toda\"\npositions = [0, 0]\nmomenta = [1, -1]";
    assert!(Problem::parse("toda.toml", &flow(toda)).is_ok());
    let masses = refused(&flow(&format!("{toda}\nmasses = [1]")));
    assert!(masses.contains("the flow toda has no `masses`"), "{masses}");
    let modes = "kind = \"zeitlin\"\nsize = 3\nmodes = [[1, 0, 1]]";
    assert!(refused(&flow(&format!("{modes}\ndegree = 2"))).contains("has no `degree`"));
}

/// Every column has a unique name, also generated columns.
#[test]
fn columns_have_names_of_their_own() {
    let named = |name: &str| format!("{BODY}\n[quantities]\n{name} = \"t\"\n");
    for name in ["H1", "casimir1"] {
        let message = refused(&named(name));
        assert!(message.contains(&format!("the column name `{name}` occurs twice")), "{message}");
    }
    let ensemble = "\n[ensemble]\ngrid = { a = \"1, 2\" }\n";
    for name in ["member", "a"] {
        let message = refused(&format!("{}{ensemble}", named(name)));
        assert!(message.contains(&format!("the column name `{name}` occurs twice")), "{message}");
    }
}

/// The location of an error is the location of the key, even if its number occurs elsewhere as
/// well.
#[test]
fn numbers_are_found_where_they_stand() {
    let text = BODY.replace("velocity = [\"m\", 0, 0]", "velocity = [\"0*t\", 0, 0]");
    let text = text.replace("\"0*t\"", "\"0*m\"").replace("step = \"m/10\"", "step = 0");
    let error = Problem::parse("body.toml", &text).unwrap().motion(0).map(drop).unwrap_err();
    let place = error.at.as_ref().unwrap();
    assert_eq!((place.text(), &*error.message), (Some("0"), "the value 0 is not positive"));
    let singular = BODY.replace("diag(J, J + 1, J + 2)", "diag(J, 1, 0)");
    let error = Problem::parse("body.toml", &singular).unwrap().motion(0).map(drop).unwrap_err();
    assert_eq!(error.at.as_ref().unwrap().source.name, "body.toml", "{error:?}");
    let unknown = BODY.replace("diag(J, J + 1, J + 2)", "diag(J, 1, k)");
    let error = Problem::parse("body.toml", &unknown).unwrap().motion(0).map(drop).unwrap_err();
    assert_eq!(error.message, "the parameter `k` has no value");
    assert_eq!(error.at.as_ref().unwrap().text(), Some("diag(J, 1, k)"));
}

/// A note names a connection that is not the one of the Euler-Poincare equations, with the rate of
/// its equations.
#[test]
fn another_connection_is_said() {
    let notes = |text: &str| Problem::parse("body.toml", text).unwrap().motion(0).unwrap().notes;
    let free = BODY.replace("diag(J, J + 1, J + 2)", "diag(2, 3, 4)");
    assert!(notes(&free).is_empty());
    let other = free.replace("\"so3\"", "\"SO3\"");
    assert!(notes(&other).iter().any(|note| note.contains("not plus")), "{:?}", notes(&other));
    let named = notes(&format!("connection = \"zero\"\n{other}"));
    assert!(named[0].contains("H' is 0.5 times its value there"), "{named:?}");
}
