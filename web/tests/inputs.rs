//! The field of the page: what it reads, in every notation, and how it rejects other texts.

use serde_json::{Value, json};

/// The answer to a request, as JSON.
fn ask(request: &Value) -> Result<Value, Value> {
    let read = |text: String| serde_json::from_str::<Value>(&text).unwrap();
    affinor_web::call(&request.to_string()).map(read).map_err(read)
}

/// The nonzero structure constants with `j < k`, as `i j k value`.
fn structure(input: &str) -> Result<Vec<String>, Value> {
    let request =
        json!({ "report": "table", "input": input, "show": "structure", "format": "csv" });
    let answer = ask(&request)?;
    let rows = answer["text"].as_str().unwrap().lines().skip(1).map(str::to_string);
    let row = |row: String| {
        let fields: Vec<&str> = row.split(',').collect();
        (fields[2] < fields[3])
            .then(|| format!("{} {} {} {}", fields[1], fields[2], fields[3], fields[5]))
    };
    Ok(rows.filter_map(row).collect())
}

const SO3: &str = "1 2 3 1; 2 1 3 -1; 3 1 2 1";
const HEISENBERG: &str = "3 1 2 1";
/// `(0,0,0,12,13,23)`: `de^4 = e^12`, so `[e_1, e_2] = -e_4`.
const FREE: &str = "4 1 2 -1; 5 1 3 -1; 6 2 3 -1";
const SL2: &str = "1 1 3 -2; 2 2 3 2; 3 1 2 1";

/// Inputs in all notations, and the structure constants that they mean.
const INPUTS: [(&str, &str); 73] = [
    ("so(3)", SO3),
    ("so3", SO3),
    (" so ( 3 ) ", SO3),
    ("SO3", SO3),
    ("SO(3)", SO3),
    ("M3", SO3),
    ("M(3)", SO3),
    ("su(2)", SO3),
    ("SU(2)", SO3),
    ("Su(2)", SO3),
    ("SU 2", SO3),
    ("SU_2", SO3),
    ("Spin(3)", SO3),
    ("\\mathfrak{so}(3)", SO3),
    ("𝔰𝔬(3)", SO3),
    ("rotations", SO3),
    ("sl(2)", SL2),
    ("SL(2,R)", SL2),
    ("SL_2(R)", SL2),
    ("sl(2,ℝ)", SL2),
    ("PSL(2,R)", SL2),
    ("heisenberg(3)", HEISENBERG),
    ("Heisenberg", HEISENBERG),
    ("the Heisenberg group", HEISENBERG),
    ("Nil", HEISENBERG),
    ("R^3", ""),
    ("ℝ³", ""),
    ("U(1)", ""),
    ("Aff(1)", "2 1 2 1"),
    ("aff(1)", "2 1 2 1"),
    ("[e1,e2]=e3", HEISENBERG),
    ("[e1, e2] = e3", HEISENBERG),
    ("[e_1,e_2]=e_3", HEISENBERG),
    ("[e_{1},e_{2}]=e_{3}", HEISENBERG),
    ("[e₁,e₂]=e₃", HEISENBERG),
    ("\\left[e_1,e_2\\right]=e_3", HEISENBERG),
    ("$[e_1, e_2] = e_3$", HEISENBERG),
    ("[x,y]=z", HEISENBERG),
    ("[X,Y] = Z", HEISENBERG),
    ("[x,y]=2z", "3 1 2 2"),
    ("[x,y] = 1/2 z", "3 1 2 1/2"),
    ("[x, y] = a z", "3 1 2 a"),
    ("[x, y] = 2 a z", "3 1 2 2*a"),
    ("[x, y] = (a + 1) z", "3 1 2 a + 1"),
    ("[x, y] = a*z - z", "3 1 2 a - 1"),
    ("[x,y]=z, [y,z]=x, [z,x]=y", SO3),
    ("[x,y]=z; [y,z]=x; [z,x]=y", SO3),
    ("[x,y]=z\n[y,z]=x\n[z,x]=y", SO3),
    ("[x,y]=z [y,z]=x [z,x]=y", SO3),
    ("[x,y]=z and [y,z]=x and [z,x]=y", SO3),
    ("[x,y] = z # a comment\n[y,z] = x\n[z,x] = y", SO3),
    ("basis x y z\n[x,y]=z", HEISENBERG),
    ("(0,0,12)", "3 1 2 -1"),
    ("(0,0,0,12,13,23)", FREE),
    ("0,0,0,12,13,23", FREE),
    ("(0^3, 12, 13, 23)", FREE),
    ("de1 = 0, de2 = 0, de3 = -e1^e2", HEISENBERG),
    ("de1=0; de2=0; de3=-e1∧e2", HEISENBERG),
    ("de^3 = -e^1\\wedge e^2", HEISENBERG),
    ("de^3 = -e^{12}", HEISENBERG),
    ("de4=e12, de5=e13, de6=e23", FREE),
    ("de4=12; de5=13; de6=23", FREE),
    ("de^4=12, de^5=13, de^6=23", FREE),
    ("de^4 = e^12\nde^5 = e^13\nde^6 = e^23", FREE),
    ("de4 = e1^e2, de5 = e13, de6 = 23", FREE),
    ("de3 = 2*12", "3 1 2 -2"),
    ("de3 = -2 e12", "3 1 2 2"),
    ("[[0,1],[0,0]], [[0,0],[1,0]], [[1,0],[0,-1]]", SL2),
    ("((0,1),(0,0)); ((0,0),(1,0)); ((1,0),(0,-1))", SL2),
    ("[0 1; 0 0], [0 0; 1 0], [1 0; 0 -1]", SL2),
    ("basis = [\"x\", \"y\", \"z\"]\nbrackets = \"[x, y] = a*z\"", "3 1 2 a"),
    ("{\"dimension\": 3, \"brackets\": \"[e1, e2] = e3\"}", HEISENBERG),
    (
        "T := EmptySCTable( 3, 0, \"antisymmetric\" );\nSetEntrySCTable( T, 1, 2, [ 1, 3 ] );",
        HEISENBERG,
    ),
];

/// Every notation is read, with the structure constants that it means.
#[test]
fn inputs_in_every_notation_are_read() {
    let mut wrong = vec![];
    for (input, expected) in INPUTS {
        let mut expected: Vec<&str> = expected.split("; ").filter(|row| !row.is_empty()).collect();
        expected.sort_unstable();
        match structure(input) {
            Ok(mut found) => {
                found.sort_unstable();
                if found != expected {
                    wrong.push(format!("{input}: {found:?}, not {expected:?}"));
                }
            }
            Err(refusal) => wrong.push(format!("{input}: {}", refusal["message"])),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Texts that cannot be read.
const WRONG: [&str; 62] = [
    "nonsense",
    "so(",
    "so)",
    "so(3",
    "so(-1)",
    "so(n)",
    "so(3,)",
    "su(1/2)",
    "E9",
    "E8 E8",
    "s",
    "su",
    "so(3)+",
    "+so(3)",
    "so(3)@",
    "so(3)@sideways",
    "so(3)@plus@minus",
    "so(1000)",
    "bianchi(X)",
    "bianchi",
    "heisenberg(4)",
    "sp(3)",
    "galilee(",
    "[x,y",
    "[x,y]",
    "[x,y]=",
    "[x]=y",
    "[x,y,z]=x",
    "[x,y]=z+",
    "[x,y]=z*",
    "[x,y]=1",
    "[x,y]=1/0 z",
    "[x,y]=nan z",
    "[x,x]=y",
    "[x,y]=z\n[y,x]=z",
    "[x,y]=z; [y,z]=y; [x,z]=x",
    "[x,y]=(z",
    "[x,y]=z)",
    "[x,y]=z^2",
    "[1,2]=3",
    "x,y = z",
    "[x,y]:=z",
    "[ , ]=z",
    "[x,y]=sin(z)",
    "(0,0,12",
    "(0,0,15)",
    "(0,0,1)",
    "()",
    "(0,0,12)(0,0,12)",
    "(0,0,ab)",
    "[[0,1],[0]]",
    "[[0,1,2],[0,0,1]]",
    "[[0,1],[0,0]], [[0,1,0],[0,0,0],[0,0,0]]",
    "[[0,1],[0,0]], [[0,1],[0,0]]",
    "[[0,1],[0,0]], [[0,0],[1,0]]",
    "de3 = e1",
    "basis = [\"x\", \"y\"]\nbrackets = \"[x, q] = y\"",
    "basis = [\"x\"\nbrackets = \"\"",
    "brackets = \"[x, y] = z\"",
    "{\"dimension\": 3",
    "dimension = -1\nbrackets = \"\"",
    "\u{441}о(3)",
];

/// Words of the command line and of files, which a reader of the page has not seen.
const FOREIGN: [&str; 16] = [
    "affinor",
    "--",
    "`",
    "TOML",
    ".toml",
    "JSON",
    "SPACE",
    "--set",
    "definition.",
    "standard input",
    "command",
    "file",
    "docs/",
    "the option",
    "exit",
    "panicked",
];

/// A message has a place in the text or names its fault, and no word of another door.
#[test]
fn messages_speak_the_language_of_the_page() {
    let mut wrong = vec![];
    for input in WRONG {
        let refusal = match ask(&json!({ "report": "reading", "input": input })) {
            Ok(answer) => {
                wrong.push(format!("{input:?} was read: {}", answer["text"]));
                continue;
            }
            Err(refusal) => refusal,
        };
        let all =
            format!("{} {} {}", refusal["message"], refusal["help"], refusal["place"]["source"]);
        if let Some(word) = FOREIGN.iter().find(|word| all.contains(**word)) {
            wrong.push(format!("{input:?} says {word:?}: {all}"));
        }
        // a law that fails, as that of Jacobi, has a witness instead of a place
        let mathematics = [
            "Jacobi",
            "differ",
            "independent",
            "closed",
            "not zero",
            "antisymm",
            "dependent",
            "close",
            "has no basis",
        ];
        let has_place = refusal["place"]["text"].is_string();
        if !has_place && !mathematics.iter().any(|word| all.contains(word)) {
            wrong.push(format!("{input:?} has no place: {all}"));
        }
        if refusal["message"].as_str().is_none_or(|message| message.len() < 8) {
            wrong.push(format!("{input:?} has no message"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The reading of an input.
fn reading(request: Value) -> Value {
    let mut request = request;
    request["report"] = "reading".into();
    let answer = ask(&request).unwrap();
    serde_json::from_str(answer["text"].as_str().unwrap()).unwrap()
}

/// The reading says what was assumed.
#[test]
fn readings_say_what_was_assumed() {
    let group = reading(json!({ "input": "SU(2)" }));
    assert_eq!(group["name"], "su(2)");
    assert!(group["notes"].to_string().contains("SU(2): computed in its Lie algebra su(2)"));
    let paper = reading(json!({ "input": "SO(3)" }));
    assert!(paper["notes"].to_string().contains("geometry of the paper"));
    assert_eq!((&paper["connection"], &paper["has_metric"]), (&json!("zero"), &json!(true)));
    let brackets = reading(json!({ "input": "[x,y] = a z", "metric": "diag(b, 1, 1)" }));
    assert_eq!(brackets["parameters"], json!(["a", "b"]));
    assert_eq!(brackets["notation"], "brackets");
    let list = reading(json!({ "input": "(0,0,0,12,13,23)" }));
    assert_eq!(list["notation"], "Salamon's list of de^i");
    assert_eq!(brackets["connection"], "levi-civita");
    let chart = reading(json!({ "input": "Schwarzschild" }));
    assert_eq!((&chart["kind"], &chart["parameters"]), (&json!("chart"), &json!(["M"])));
    assert_eq!(reading(json!({ "input": "Poincaré" }))["name"], "iso(3,1)");
    let nilpotent = reading(json!({ "input": "heisenberg(3)" }));
    assert_eq!(nilpotent["killing"], false);
}

/// The names that an unknown name resembles are suggestions.
#[test]
fn unknown_names_have_suggestions() {
    let refusal = ask(&json!({ "report": "reading", "input": "soo(3)" })).unwrap_err();
    assert!(refusal["suggestions"].as_array().is_some_and(|names| !names.is_empty()), "{refusal}");
    let refusal = ask(&json!({ "report": "reading", "input": "galilee" })).unwrap_err();
    assert_eq!(refusal["place"]["source"], "input");
}

/// Messages name the bracket that is missing, and the argument that does not fit.
#[test]
fn messages_name_the_fault() {
    for (input, part, words) in [
        ("(0,0,0,12,13,23", "(0,0,0,12,13,23", "a “)” is missing"),
        ("[e1,e2=e3", "[e1,e2=e3", "a “]” is missing"),
        ("[e1;e2]=e3", "e1;e2", "a comma separates the two basis vectors"),
        ("SU(", "(", "parenthesis is not closed"),
        ("SU(2.5)", "SU(2.5)", "su(n) needs n >= 2"),
        ("SU(300)", "SU(300)", "exceeds the limit of 2048"),
        ("SO(1000)", "SO(1000)", "exceeds the limit of 2048"),
        ("Spin(1000)", "Spin(1000)", "exceeds the limit of 2048"),
    ] {
        let refusal = ask(&json!({ "report": "reading", "input": input })).unwrap_err();
        let message = refusal["message"].as_str().unwrap();
        assert!(message.contains(words), "{input}: {message}");
        let place = &refusal["place"];
        let at = |name: &str| usize::try_from(place[name].as_u64().unwrap()).unwrap();
        let text = place["text"].as_str().unwrap();
        assert_eq!(&text[at("from")..at("to")], part, "{input}");
    }
}
