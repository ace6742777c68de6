//! Copies as files and programs: read back, compiled, run.

use super::{answer, refused};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Requests whose copies in Rust stand in `copied/`, and are compiled and run with this test.
fn copied() -> [(&'static str, Value); 6] {
    let space = "so3@levi-civita;metric=diag(a,2,3)";
    let problem = "space = \"so3\"\nmetric = \"diag(0.6, 0.8, 1)\"\ninitial.momentum = [1.8, 0.4, -0.9]\noutput = { end = 1, every = 0.5 }\n";
    [
        ("table", json!({ "report": "table", "space": space, "show": "ricci, scalar_curvature" })),
        ("check", json!({ "report": "check", "space": space })),
        ("info", json!({ "report": "info", "space": "sl(2)" })),
        ("properties", json!({ "report": "properties", "space": "so3@zero;metric=diag(1,2,3)" })),
        ("equations", json!({ "report": "equations", "space": "so3", "metric": "diag(a,b,c)" })),
        ("motion", json!({ "report": "motion", "problem": problem })),
    ]
}

macro_rules! programs {
    ($($name:ident),*) => {$(
        mod $name {
            include!(concat!("copied/", stringify!($name), ".rs"));

            #[test]
            fn it_runs() {
                main().unwrap();
            }
        }
    )*};
}
programs!(table, check, info, properties, equations, motion);

/// `UPDATE_DOCUMENTS=1` writes the programs anew.
#[test]
fn programs_are_those_of_the_page() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/copied");
    for (name, request) in copied() {
        let text = copy(&request, "rust");
        let path = folder.join(format!("{name}.rs"));
        if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
            fs::write(&path, &text).unwrap();
        }
        assert_eq!(text, fs::read_to_string(&path).unwrap(), "{name}");
    }
}

fn copy(request: &Value, format: &str) -> String {
    let mut request = request.clone();
    request["format"] = json!(format);
    answer(request)
}

/// The table of the copied file is that of the space, to the letter below its name.
#[test]
fn files_are_read_back() {
    let own = "basis = [\"x\", \"y\"]\nparameters = [\"a\"]\nbrackets = \"[x, y] = a*y\"\naffinities = \"nabla[x, y] = 1/2*x - (a + 1)*y\"\nname = \"mine \\\"quoted\\\"\"";
    let requests = [
        json!({ "report": "table", "space": "E6", "connection": "plus", "show": "killing" }),
        json!({ "report": "table", "space": "so3", "connection": "lambda=1/3", "metric": "diag(1,2,c)" }),
        json!({ "report": "table", "space": "bianchi(VI,h=h)", "metric": "[[2,1,0],[1,2,0],[0,0,1]]" }),
        json!({ "report": "table", "space": "M3" }),
        json!({ "report": "table", "space": "SO3" }),
        json!({ "report": "table", "definition": own }),
        json!({ "report": "equations", "space": "se(2)", "metric": "identity" }),
        json!({ "report": "check", "space": "sl(3)" }),
        json!({ "report": "info", "space": "su(2)" }),
        json!({ "report": "table", "space": "so3+R^3" }),
        json!({ "report": "table", "space": "aff1+aff1+sl2", "metric": "identity" }),
        json!({ "report": "table", "definition": "dimension = 1\nbrackets = ''\nname = \"a\\u007fb\"" }),
    ];
    for request in requests {
        let file = copy(&request, "toml");
        let mut again = json!({ "report": request["report"], "definition": file, "format": "csv" });
        again["show"] = request.get("show").cloned().unwrap_or(json!(""));
        assert_eq!(copy(&request, "csv"), answer(again), "{file}");
    }
}

#[test]
fn what_has_no_program_is_refused() {
    for request in [
        r#"{"report": "compare", "format": "python"}"#,
        r#"{"report": "list", "space": "so", "format": "toml"}"#,
        r#"{"report": "motion", "problem": "space = 1", "format": "rust"}"#,
        r#"{"report": "table", "space": "so33", "format": "rust"}"#,
    ] {
        assert!(
            refused(request)["message"].as_str().is_some_and(|text| text.len() > 5),
            "{request}"
        );
    }
}

/// AFFINOR_PYTHON is a Python with the package `affinor`.
#[test]
fn python_prints_the_report() {
    let Some(python) = std::env::var_os("AFFINOR_PYTHON") else { return };
    for (name, request) in copied() {
        let program = copy(&request, "python");
        let run = Command::new(&python).args(["-c", &program]).output().unwrap();
        let (out, err) =
            (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert!(run.status.success(), "{name}: {err}\n{program}");
        match name {
            "table" | "equations" => {
                assert_eq!(out.trim(), copy(&request, "text").trim(), "{name}")
            }
            "motion" => {
                let rows: Value = serde_json::from_str(&copy(&request, "json")).unwrap();
                let last = rows["rows"].as_array().unwrap().last().unwrap();
                for (at, column) in rows["columns"].as_array().unwrap().iter().enumerate() {
                    let line = format!("{} ", column.as_str().unwrap());
                    let found = out.lines().find_map(|text| text.strip_prefix(&line)).unwrap();
                    let found: f64 = found.parse().unwrap();
                    assert_eq!(found, last[at].as_f64().unwrap(), "{column}");
                }
            }
            _ => assert!(out.len() > 100, "{name}: {out}"),
        }
    }
}
