//! Copies as files, commands and Python: read back and run.

use super::{answer, refused};
use serde_json::{Value, json};
use std::fs;
use std::process::Command;

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

#[test]
fn commands_name_the_file_and_the_options() {
    let expected = [
        "affinor table table.toml --show \"ricci, scalar_curvature\"\n",
        "affinor check check.toml\n",
        "affinor info info.toml\n",
        "affinor properties properties.toml\n",
        "affinor equations equations.toml --kind euler-poincare\n",
        "affinor simulate problem.toml\n",
    ];
    for ((name, request), expected) in copied().iter().zip(expected) {
        assert_eq!(copy(request, "command"), expected, "{name}");
        assert_eq!(copy(request, "python").lines().count(), 2, "{name}");
    }
}

fn copy(request: &Value, format: &str) -> String {
    let mut request = request.clone();
    request["format"] = json!(format);
    answer(request)
}

/// The table of the copied file equals the table of the space, except for the name.
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
fn reports_without_a_file_are_refused() {
    for request in [
        r#"{"report": "compare", "format": "python"}"#,
        r#"{"report": "list", "space": "so", "format": "toml"}"#,
        r#"{"report": "motion", "problem": "space = 1", "format": "python"}"#,
        r#"{"report": "table", "space": "so33", "format": "command"}"#,
        r#"{"report": "table", "space": "so3", "show": "\"; rm", "format": "command"}"#,
        r#"{"report": "table", "space": "so3", "format": "rust"}"#,
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
    let folder = std::env::temp_dir().join(format!("affinor-copies-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    for (name, request) in copied() {
        let file = if name == "motion" { "problem" } else { name };
        fs::write(folder.join(format!("{file}.toml")), copy(&request, "toml")).unwrap();
        let program = copy(&request, "python");
        let mut run = Command::new(&python);
        let run = run.args(["-c", &program]).current_dir(&folder).output().unwrap();
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
                let found: Value = serde_json::from_str(&out.replace('\'', "\"")).unwrap();
                for (at, column) in rows["columns"].as_array().unwrap().iter().enumerate() {
                    assert_eq!(found[column.as_str().unwrap()], last[at], "{column}");
                }
            }
            _ => assert!(out.len() > 100, "{name}: {out}"),
        }
    }
    fs::remove_dir_all(folder).unwrap();
}
