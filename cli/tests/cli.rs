//! The contract of the command line: every command and format, options, notes and files.

use crate::program::{Outcome, root, run, words};
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

const FORMATS: [&str; 6] = ["text", "markdown", "latex", "csv", "json", "html"];
const PLANE: &str = "basis = ['x', 'y']\nbrackets = '[x, y] = x'\n";
/// Jacobi fails: `[[e1,e2],e3] + [[e2,e3],e1] + [[e3,e1],e2] = [e3,e3] + [e2,e1] + 0 = -e3`.
const BROKEN: &str = "dimension = 3\nbrackets = '[e1, e2] = e3; [e2, e3] = e2'\n";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("plane.toml"), PLANE).unwrap();
    fs::write(folder.path().join("broken.toml"), BROKEN).unwrap();
    folder
}

/// Runs the program in an empty temporary folder.
fn affinor(arguments: &[&str]) -> Outcome {
    run(folder().path(), arguments, b"")
}

/// The standard output of a command that succeeds, in an empty temporary folder.
fn stdout(arguments: &[&str]) -> String {
    crate::program::stdout(folder().path(), arguments)
}

fn json_of(arguments: &[&str]) -> Value {
    let out = stdout(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str(&out).unwrap()
}

/// The rows of a CSV, without the header.
fn rows(csv: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let record = |record: csv::Result<csv::StringRecord>| {
        record.unwrap().iter().map(str::to_string).collect()
    };
    reader.records().map(record).collect()
}

#[test]
fn every_command_writes_every_format() {
    let folder = folder();
    let stored = folder.path().join("stored.json");
    fs::write(&stored, stdout(&["table", "so3@zero", "--format", "json"])).unwrap();
    for command in [
        &["compare"][..],
        &["compare", "so3", "SO3"],
        &["compare", "so3@levi-civita;metric=diag(1,2,3)", "heisenberg3@lambda=1/3"],
        &["table", "M3"],
        &["table", "so3"],
        &["table", "so3", "--metric", "identity", "--show", "all"],
        &["table", "so3", "--metric", "diag(1,2,3)", "--show", "derived"],
        &["table", "sl2", "--scalar", "float"],
        &["table", "bianchi(VI,h=h)"],
        &["table", "plane.toml", "--frame", "right"],
        &["check", "M3"],
        &["check", "plane.toml"],
        &["verify", "so3@zero", "stored.json"],
        &["list"],
        &["list", "so"],
        &["conventions"],
        &["coupling", "1", "3/2"],
    ] {
        for format in FORMATS {
            let arguments = [command, &["--format", format]].concat();
            let outcome = run(folder.path(), &arguments, b"");
            assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
            assert!(!outcome.err.contains("error"), "{arguments:?}: {}", outcome.err);
            assert!(!outcome.out.trim().is_empty(), "{arguments:?}");
            assert!(outcome.out.ends_with('\n'), "{arguments:?}");
            assert!(!outcome.out.contains('\u{1b}'), "{arguments:?}");
            match format {
                "json" => {
                    let object: Value = serde_json::from_str(&outcome.out).unwrap();
                    let schema = object["schema"].as_str().unwrap();
                    assert_eq!(schema, format!("affinor.{}/1", command[0]));
                }
                "csv" => drop(rows(&outcome.out)),
                "text" => {
                    let widest = outcome.out.lines().map(|line| line.chars().count()).max();
                    assert!(widest <= Some(80), "{arguments:?}: {widest:?}");
                }
                _ => {}
            }
        }
    }
}

#[test]
fn help_and_version_are_results() {
    let commands = "compare table check verify info properties equations exp log compose adjoint transport convert \
                    simulate list conventions completions isometries mobility linearize rep coupling solve geodesic spacetime forms hypersurface";
    let mut all = vec![vec!["--help"], vec!["--version"], vec!["help", "check"]];
    all.extend(commands.split_whitespace().map(|command| vec![command, "--help"]));
    let figures = "images transport autoparallels motion frames attitude momentum animation series phase section drift \
                   dynkin convergence";
    all.push(vec!["plot", "--help"]);
    all.extend(figures.split_whitespace().map(|figure| vec!["plot", figure, "--help"]));
    for arguments in &all {
        let outcome = affinor(arguments);
        assert_eq!((outcome.status, outcome.err.as_str()), (0, ""), "{arguments:?}");
        assert!(outcome.out.lines().all(|line| line.chars().count() <= 80), "{}", outcome.out);
    }
    assert_eq!(stdout(&["--version"]), format!("affinor {}\n", env!("CARGO_PKG_VERSION")));
}

/// The help of every command has two examples, which succeed beside the folder `examples`.
#[cfg(unix)]
#[test]
fn examples_of_the_help_succeed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::os::unix::fs::symlink(root().join("examples"), at.join("examples")).unwrap();
    fs::create_dir(at.join("tables")).unwrap();
    let table = stdout(&["table", "so3@zero", "--format", "json"]);
    for file in ["table.json", "tables/so3.json"] {
        fs::write(at.join(file), &table).unwrap();
    }
    fs::write(at.join("claims.txt"), "torsion = 0\n").unwrap();
    let commands = stdout(&["--help"]);
    let commands = commands.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = commands.take_while(|line| !line.is_empty()).filter_map(|line| {
        let indented = line.strip_prefix("  ").filter(|rest| !rest.starts_with(' '))?;
        indented.split_whitespace().next().filter(|name| *name != "help")
    });
    let mut count = 0;
    for name in names {
        let help = stdout(&[name, "--help"]);
        let examples: Vec<&str> =
            help.lines().skip_while(|line| *line != "Examples:").skip(1).collect();
        assert_eq!(examples.len(), 2, "{name}");
        for example in examples {
            let words = words(example.trim().strip_prefix("affinor ").unwrap());
            assert_eq!(words[0], name);
            let outcome = run(at, &words, b"");
            assert_eq!(outcome.status, 0, "{example}: {}", outcome.err);
        }
        count += 1;
    }
    assert_eq!(count, 30);
}

#[test]
fn the_default_connection_is_said_beside_the_results() {
    let cases: [(&[&str], &str); 6] = [
        (&["table", "so3"], "note: no connection and no metric given: using the connection zero\n"),
        (
            &["table", "so3", "--metric", "diag(1,2,3)"],
            "note: no connection given: using levi-civita, the connection of the metric\n",
        ),
        (&["table", "so3@plus"], ""),
        (&["table", "so3", "--connection", "minus"], ""),
        (&["table", "M3"], ""),
        (&["table", "SO3"], ""),
    ];
    for (arguments, note) in cases {
        let outcome = affinor(arguments);
        assert_eq!((outcome.status, outcome.err.as_str()), (0, note), "{arguments:?}");
        assert!(!outcome.out.contains("note:"), "{arguments:?}");
    }
    assert_eq!(json_of(&["table", "so3"])["connection"], json!({"name": "zero", "lambda": "1/2"}));
    let levi_civita = json_of(&["table", "so3", "--metric", "identity"]);
    assert_eq!(levi_civita["connection"], json!({"name": "levi-civita"}));
}

#[test]
fn unknown_names_become_parameters_and_are_said() {
    let metric = ["table", "so3@plus", "--metric", "diag(m, 1, 2*k)", "--format", "json"];
    let outcome = affinor(&metric);
    assert_eq!(outcome.err, "note: taken as parameters: k, m\n");
    let table: Value = serde_json::from_str(&outcome.out).unwrap();
    assert_eq!(table["algebra"]["parameters"], json!(["k", "m"]));
    assert_eq!(table["scalar"], "symbolic");

    let family = affinor(&["table", "so3", "--connection", "lambda=t"]);
    assert_eq!(family.err, "note: taken as parameters: t\n");
    let inline =
        affinor(&["table", "--basis", "x y", "--bracket", "[x,y]=a*x", "--connection", "plus"]);
    assert_eq!(inline.err, "note: taken as parameters: a\n");
    assert_eq!(inline.status, 0);

    // declarations of a name or a file are not repeated as notes
    assert_eq!(affinor(&["table", "M3"]).err, "");
    assert_eq!(affinor(&["table", "bianchi(VI,h=h)@zero"]).err, "");
}

#[test]
fn set_puts_values_for_parameters() {
    let values = "J11=1/2,J12=0,J13=0,J22=2*s,J23=0,J33=1e-3";
    let out = stdout(&["table", "M3", "--set", values, "--show", "metric", "--format", "csv"]);
    assert_eq!(
        out,
        "tensor,i,j,k,l,value\nmetric,1,1,,,1/2\nmetric,2,2,,,2*s\nmetric,3,3,,,1/1000\n"
    );
    let table =
        json_of(&["table", "bianchi(VI,h=h)@zero", "--set", "h=-1/2", "--show", "structure"]);
    assert_eq!((&table["scalar"], &table["algebra"]["parameters"]), (&json!("exact"), &json!([])));
    // values are substituted at once, not into each other
    let swapped = ["table", "so3", "--connection", "zero", "--metric", "diag(a,b,1)"];
    let swapped =
        [&swapped[..], &["--set", "a=b,b=a", "--show", "metric", "--format", "csv"]].concat();
    assert!(stdout(&swapped).ends_with("metric,1,1,,,b\nmetric,2,2,,,a\nmetric,3,3,,,1\n"));
    // after values are set, the metric is a metric of floats
    let float = ["table", "M3", "--scalar", "float", "--show", "metric", "--format", "json"];
    let set = ["--set", "J11=1/3,J12=0,J13=0,J22=1,J23=0,J33=1"];
    let table: Value = serde_json::from_str(&stdout(&[&float[..], &set].concat())).unwrap();
    assert_eq!(table["tensors"]["metric"]["components"][0], json!([[1, 1], 1.0 / 3.0]));
}

#[test]
fn independent_components_stand_for_all() {
    let curvature = ["table", "SO3", "--show", "curvature", "--format", "csv"];
    let all = rows(&stdout(&curvature));
    let few = rows(&stdout(&[&curvature[..], &["--independent"]].concat()));
    assert_eq!((all.len(), few.len()), (12, 6));
    assert!(few.iter().all(|row| all.contains(row)));
    // and the output says so
    let json = json_of(&["table", "SO3", "--independent"]);
    assert!(json["conventions"]["components"].is_string());
    // a stored table with these values verifies against them
    let folder = folder();
    fs::write(
        folder.path().join("few.csv"),
        stdout(&[&curvature[..], &["--independent"]].concat()),
    )
    .unwrap();
    let verify = run(folder.path(), &["verify", "SO3", "few.csv", "--independent"], b"");
    assert_eq!(verify.status, 0, "{}", verify.err);
    assert_eq!(run(folder.path(), &["verify", "SO3", "few.csv"], b"").status, 1);
}

#[test]
fn timings_are_lines_beside_the_results() {
    for (command, stages) in [
        (
            &["table", "so3@plus", "--show", "curvature"][..],
            &["input", "jacobi", "connection", "curvature", "output"][..],
        ),
        (
            &["check", "so3"],
            &["input", "antisymmetry", "jacobi", "bianchi_first", "bianchi_second", "output"],
        ),
    ] {
        let plain = affinor(command);
        let timed = affinor(&[command, &["--timings"]].concat());
        assert_eq!((timed.status, &timed.out), (0, &plain.out));
        let names: Vec<&str> = timed.err.lines().map(timing).collect();
        assert_eq!(names, stages, "{command:?}");
        assert!(!plain.err.contains("timing"));
    }
}

/// The seconds in a line `timing: NAME 0.041 s`.
fn timing(line: &str) -> &str {
    let inner = line.strip_prefix("timing: ").and_then(|line| line.strip_suffix(" s"));
    let (name, seconds) = inner.and_then(|inner| inner.split_once(' ')).unwrap();
    assert!(seconds.parse::<f64>().unwrap() >= 0.0);
    assert_eq!(seconds.split_once('.').unwrap().1.len(), 3, "{line}");
    name
}

#[test]
fn a_file_has_the_bytes_of_standard_output() {
    let folder = folder();
    for command in
        [&["table", "M3"][..], &["check", "so3"], &["compare"], &["list"], &["conventions"]]
    {
        for format in FORMATS {
            let arguments = [command, &["--format", format]].concat();
            let printed = run(folder.path(), &arguments, b"");
            let filed = run(folder.path(), &[&arguments[..], &["-o", "result"]].concat(), b"");
            assert_eq!((filed.status, filed.out.as_str()), (0, ""), "{arguments:?}");
            assert_eq!(filed.err, printed.err);
            let content = fs::read_to_string(folder.path().join("result")).unwrap();
            assert_eq!(content, printed.out, "{arguments:?}");
        }
    }
}

#[test]
fn definitions_are_read_from_files_and_from_standard_input() {
    let json = "{\"basis\": [\"x\", \"y\"], \"brackets\": [\"[x, y] = x\"], \"name\": \"plane\"}";
    let toml = format!("{PLANE}name = 'plane'");
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("at@zero")).unwrap();
    for name in ["plane.toml", "at@zero/plane", "plane.json"] {
        let text = if name.ends_with("json") { json } else { &toml };
        fs::write(folder.path().join(name), text).unwrap();
    }
    let show = ["--show", "structure,torsion", "--connection", "plus"];
    let of = |space: &str, input: &str| {
        // `-@zero` begins like an option, but is a space
        let arguments = [&["table"], &show[..], &["--", space]].concat();
        let outcome = run(folder.path(), &arguments, input.as_bytes());
        assert_eq!((outcome.status, outcome.err.as_str()), (0, ""), "{space}");
        outcome.out
    };
    let out = of("plane.toml", "");
    assert!(out.starts_with("plane\n") && out.contains("[x, y] = x"), "{out}");
    for (space, input) in [
        ("plane.json", ""),
        ("./plane.toml", ""),
        ("at@zero/plane", ""),
        ("-", &toml),
        ("-", json),
        ("plane.toml@plus", ""),
        ("at@zero/plane@minus", ""),
        ("-@levi-civita;metric=identity", json),
    ] {
        let same = of(space, input);
        // a metric is named in the text above a table
        assert!(same == out || space.contains("metric"), "{space}: {same}");
    }
}

#[test]
fn brackets_are_given_inline() {
    let arguments =
        ["--basis", "x y z", "--connection", "zero", "--show", "structure", "--format", "csv"];
    let of = |brackets: &[&str]| stdout(&[&["table"], &arguments[..], brackets].concat());
    let so3 = of(&["--bracket", "[x,y]=z; [y,z]=x; [z,x]=y"]);
    assert_eq!(so3, of(&["--bracket", "[x,y]=z", "--bracket", "[y,z]=x", "--bracket", "[x,z]=-y"]));
    assert_eq!(so3, of(&["--bracket", "[x, y] = z # so(3)\n[y, z] = 2/2*x\n[z, x] = y"]));
    assert_eq!(so3, stdout(&["table", "so3@zero", "--show", "structure", "--format", "csv"]));
    let abelian = stdout(&["table", "--basis", "x,y", "--show", "structure", "--format", "csv"]);
    assert_eq!(abelian, "tensor,i,j,k,l,value\n");
}

#[test]
fn a_certificate_names_the_witness() {
    let outcome = affinor(&["check", "broken.toml", "--format", "json"]);
    assert_eq!((outcome.status, outcome.err.as_str()), (1, ""));
    let certificate: Value = serde_json::from_str(&outcome.out).unwrap();
    assert_eq!(certificate["schema"], "affinor.check/1");
    assert_eq!(certificate["ok"], false);
    let checks = certificate["checks"].as_array().unwrap();
    assert_eq!((&checks[0]["name"], &checks[0]["ok"]), (&json!("antisymmetry"), &json!(true)));
    let jacobi = checks.last().unwrap();
    assert_eq!((&jacobi["name"], &jacobi["ok"]), (&json!("jacobi"), &json!(false)));
    assert_eq!(jacobi["witness"], json!({"indices": [1, 2, 3], "residual": [[3, "-1"]]}));

    let text = affinor(&["check", "broken.toml"]);
    assert_eq!(text.status, 1);
    let words: Vec<&str> = text.out.split(['│', ' ', '\n']).filter(|w| !w.is_empty()).collect();
    let words = words.join(" ");
    assert!(words.contains("[[e1,e2],e3] + [[e2,e3],e1] + [[e3,e1],e2] = -e3"), "{words}");

    let bracket = ["check", "--basis", "x y", "--bracket", "[x,y]=x;[y,x]=y", "--format", "json"];
    let outcome = affinor(&bracket);
    let certificate: Value = serde_json::from_str(&outcome.out).unwrap();
    let witness = json!({"indices": [1, 2], "residual": [[1, "1"], [2, "1"]]});
    assert_eq!((outcome.status, &certificate["checks"][0]["witness"]), (1, &witness));

    let good = json_of(&["check", "so3", "--metric", "diag(1,2,3)"]);
    let names: Vec<&Value> =
        good["checks"].as_array().unwrap().iter().map(|c| &c["name"]).collect();
    let all = [
        "antisymmetry",
        "jacobi",
        "metric",
        "torsion_free",
        "metric_compatible",
        "bianchi_first",
        "bianchi_second",
    ];
    assert_eq!(
        (names, &good["ok"]),
        (all.iter().map(|n| json!(n)).collect::<Vec<_>>().iter().collect(), &json!(true))
    );
    assert!(good["checks"].as_array().unwrap().iter().all(|check| check.get("witness").is_none()));
}

#[test]
fn undefined_tensors_are_noted() {
    let folder = folder();
    let table = run(folder.path(), &["table", "so3@zero", "--show", "metric,torsion"], b"");
    assert_eq!((table.status, &*table.err), (0, "note: not defined for this space: metric\n"));
    for (show, status) in [("metric,torsion", 0), ("metric", 2)] {
        let right = ["table", "M3", "--frame", "right", "--show", show];
        let table = run(folder.path(), &right, b"");
        assert_eq!(table.status, status);
        assert!(table.err.contains("no constant components in the right-invariant frame"));
    }
}

#[test]
fn a_setting_serves_whichever_space_has_the_parameter() {
    let folder = folder();
    let set = |spaces: &[&str], values: &str| {
        run(folder.path(), &[&["compare"], spaces, &["--set", values]].concat(), b"")
    };
    assert_eq!(set(&[], "J11=1").status, 0);
    assert_eq!(set(&["so3", "bianchi(VI,h=h)"], "h=2").status, 0);
    let unknown = set(&[], "K=1");
    assert_eq!(unknown.status, 2);
    assert!(unknown.err.contains("`K` is not a parameter here"), "{}", unknown.err);
    // a declared parameter is listed even if nothing depends on it; names in values are listed too
    let file = "basis = ['x', 'y']\nparameters = ['k']\nbrackets = '[x, y] = x'\n";
    fs::write(folder.path().join("declared.toml"), file).unwrap();
    let declared = run(folder.path(), &["check", "declared.toml", "--set", "k=2"], b"");
    assert_eq!((declared.status, &*declared.err), (0, ""));
    let brought = ["table", "so3@zero;metric=diag(a,1,1)", "--set", "a=b", "--show", "metric"];
    let brought = run(folder.path(), &brought, b"");
    assert!(brought.err.contains("taken as parameters: a, b"), "{}", brought.err);
}

#[test]
fn the_catalogue_and_the_conventions_are_listed() {
    let all = json_of(&["list"]);
    let spaces = all["spaces"].as_array().unwrap();
    for space in spaces {
        let example = space["example"].as_str().unwrap();
        assert_eq!(affinor(&["table", example, "--show", "structure"]).status, 0, "{example}");
    }
    let some = json_of(&["list", "HEISEN"]);
    assert_eq!(some["spaces"].as_array().unwrap().len(), 1);
    let conventions = json_of(&["conventions"]);
    let curvature = conventions["conventions"].as_object().unwrap();
    assert!(curvature.keys().any(|key| key.contains("curvature (B14)")), "{curvature:?}");
    assert_eq!(rows(&stdout(&["conventions", "--format", "csv"])).len(), curvature.len());
}

#[test]
fn shells_complete_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&["completions", shell]);
        for word in ["compare", "verify", "conventions", "tolerance"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    // names of algebras, tensors, connections, methods and formats are suggested
    let script = stdout(&["completions", "zsh"]);
    for word in ["heisenberg", "ricci", "levi-civita", "rkmk4", "latex", "quaternion"] {
        assert!(script.contains(word), "{word}");
    }
    let folder = TempDir::new().unwrap();
    let script = folder.path().join("affinor.bash");
    fs::write(&script, stdout(&["completions", "bash"])).unwrap();
    // if bash is installed, it accepts the script
    if let Ok(status) = std::process::Command::new("bash").arg("-n").arg(&script).status() {
        assert!(status.success());
    }
}

#[test]
fn spaces_have_short_names() {
    let csv = |arguments: &[&str]| stdout(&[&["table"], arguments, &["--format", "csv"]].concat());
    for (short, long) in [
        (&["M3"][..], &["M(3)"][..]),
        (&["SO3"], &["SO(3)"]),
        (&["so3@zero"], &["so(3)", "--connection", "zero"]),
        (&["so3@lambda=1/3"], &["so3", "--connection", "lambda = 1/3"]),
        (&["so3@lambda=1"], &["so3@plus"]),
        (&["so3@lambda=0"], &["so3@minus"]),
        (
            &["so3@levi-civita;metric=diag(1,2,3)"],
            &["so3", "--connection", "levi-civita", "--metric", "diag(1,2,3)"],
        ),
        (
            &["so3@metric=diag(1,2,3);levi-civita"],
            &["so3", "--metric", "[[1,0,0],[0,2,0],[0,0,3]]"],
        ),
        (
            &["so3@zero;metric=identity"],
            &["so3@plus;metric=killing", "--connection", "zero", "--metric", "diag(1,1,1)"],
        ),
        (&["so(3) + R^2@zero"], &["so3+R^2", "--connection", "zero"]),
        (&["SO3"], &["so3@zero;metric=diag(2,2,2)"]),
    ] {
        assert_eq!(csv(short), csv(long), "{short:?}");
    }
    assert_ne!(csv(&["so3@zero"]), csv(&["SO3"]));
    let table = json_of(&["table", "so3@lambda=1/3"]);
    assert_eq!(table["connection"], json!({"name": "lambda", "lambda": "1/3"}));
    assert_eq!(json_of(&["table", "M3"])["connection"], json!({"name": "plus", "lambda": "1"}));
    assert_eq!(json_of(&["table", "SO3"])["name"], "SO(3)");
}

#[test]
fn messages_are_coloured_on_request() {
    let of = |color: &str| affinor(&["table", "so31", "--color", color]).err;
    assert!(of("always").contains("\u{1b}["));
    assert!(!of("never").contains('\u{1b}'));
    assert!(!of("auto").contains('\u{1b}'), "standard error is not a terminal here");
    let results = affinor(&["table", "so3", "--color", "always"]);
    assert!(!results.out.contains('\u{1b}'));
}

#[test]
fn floats_have_a_tolerance() {
    let float = ["table", "so3@lambda=1/3", "--scalar", "float", "--show", "torsion"];
    let text = stdout(&float);
    assert!(text.contains("1.42e-14") || text.contains("e-14"), "{text}");
    let table = json_of(&float);
    assert_eq!(table["scalar"], "float");
    let value = &table["tensors"]["torsion"]["components"][0][1];
    // tau = (2 lambda - 1) c
    assert!((value.as_f64().unwrap() + 1.0 / 3.0).abs() < 1e-15, "{value}");
    assert_eq!(affinor(&[&float[..], &["--tolerance", "1e-9"]].concat()).status, 0);
    assert_eq!(affinor(&[&float[..], &["--tolerance", "0"]].concat()).status, 0);
}

#[test]
fn derived_tensors_are_shown_when_asked_for() {
    let keys = |arguments: &[&str]| -> Vec<String> {
        let table =
            json_of(&[&["table", "so4", "--metric", "diag(1,1,1,2,2,2)"], arguments].concat());
        table["tensors"].as_object().unwrap().keys().cloned().collect()
    };
    let basic = "structure, affinities, torsion, curvature, ricci, scalar_curvature, metric, \
                 inverse_metric, nonmetricity, killing";
    let derived = "nabla_torsion, nabla_curvature, ricci_symmetric, ricci_antisymmetric, \
                   ricci_trace_free, einstein, schouten, weyl, cotton, kretschmann";
    assert_eq!(keys(&["--show", "all"]).join(", "), basic);
    assert_eq!(keys(&["--show", "derived"]).join(", "), derived);
    assert_eq!(keys(&["--show", "all,derived"]).join(", "), format!("{basic}, {derived}"));
    assert_eq!(keys(&["--show", "weyl, ricci"]), ["weyl", "ricci"]);
    let refused = affinor(&["table", "so4", "--show", "conformal"]);
    assert_eq!(refused.status, 2);
    assert!(refused.err.contains(&format!("{basic}, {derived}, all, derived")), "{}", refused.err);

    // Weyl, Schouten and Cotton belong to a Levi-Civita connection, whichever name was used for it
    let show = ["--show", "weyl,einstein,schouten", "--format", "csv"];
    let plus = affinor(&[&["table", "so4@plus;metric=identity"], &show[..]].concat());
    assert!(plus.err.contains("not defined for this space: weyl, schouten"), "{}", plus.err);
    assert_eq!(plus.out, "tensor,i,j,k,l,value\n");
    let zero = affinor(&[&["table", "so4@zero;metric=killing"], &show[..]].concat());
    assert!(!zero.err.contains("not defined"), "{}", zero.err);
    assert!(rows(&zero.out).iter().any(|row| row[0] == "weyl"));
    let plane = affinor(&[&["table", "aff1@levi-civita;metric=identity"], &show[..]].concat());
    assert!(plane.err.contains("not defined for this space: weyl, schouten"), "{}", plane.err);
}
