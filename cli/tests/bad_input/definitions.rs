//! Definition files that cannot be parsed, or are empty.

use crate::bad_input::case::definitions;

/// A definition of the plane with the basis `x, y` and more keys.
fn with(keys: &str) -> String {
    format!("basis = [\"x\", \"y\"]\nbrackets = \"[x, y] = x\"\n{keys}\n")
}

#[test]
fn syntax_errors_have_their_place() {
    definitions("a.toml", str::to_string).usage(&[
        ("basis = [\"x\"\nbrackets = \"\"", &["a.toml:2:1", "array"]),
        ("name = \"x\nbrackets = \"\"", &["a.toml:1:10", "string"]),
        ("dimension =\n", &["a.toml:1:12", "string values must be quoted"]),
        ("= 3", &["a.toml:1:1"]),
        ("name = \"\\q\"", &["a.toml:1:10", "escaped value"]),
        ("name = \"\u{1}\"", &["a.toml:1:9", "invalid basic string"]),
        ("bracket x y", &["a.toml:1:9"]),
    ]);
    definitions("a.json", str::to_string).usage(&[
        ("{", &["a.json:1:1", "EOF while parsing an object"]),
        ("{\"dimension\": 2,\n ,}", &["a.json:2:2", "key must be a string"]),
        ("{\"dimension\": 2,}", &["a.json:1:17", "trailing comma"]),
        ("{\"dimension\": 2, \"brackets\": \"\"} x", &["a.json:1:34"]),
        ("[1, 2]", &["a.json:1:1", "a JSON definition must be an object of keys"]),
        ("{'dimension': 2}", &["a.json:1:2", "key must be a string"]),
        ("{\"dimension\": NaN}", &["a.json:1:15", "expected value"]),
        ("{\"name\": \"\\ud800\"}", &["a.json:1:1", "hex escape"]),
    ]);
}

#[test]
fn keys_are_checked() {
    definitions("a.toml", with).usage(&[
        ("brakets = \"\"", &["a.toml:3:1", "unknown key `brakets`", "did you mean `brackets`?"]),
        ("[foo]\nbar = 1", &["a.toml:3:2", "`foo`", "the keys are name, basis,"]),
        ("basis = [\"x\"]", &["a.toml:3:1", "duplicate key"]),
        ("structure_constants = []", &["a.toml", "more than once", "exactly one of"]),
        ("dimension = 2", &["a.toml:3:1", "either basis or dimension"]),
        ("connection = \"zero\"\naffinities = \"\"", &["a.toml:4:1", "not both"]),
        ("name = 3", &["a.toml:3:8", "integer `3`"]),
    ]);
    definitions("a.toml", str::to_string).usage(&[
        ("dimension = 3", &["a.toml", "defines no bracket"]),
        ("# nothing\nbrackets = \"[x, y] = x\"", &["a.toml has no basis"]),
        ("", &["a.toml is empty", "give a basis and brackets"]),
        (" \n\t\n", &["a.toml is empty"]),
        ("# nothing\n", &["a.toml has no basis"]),
        ("dimension = 2\nbrackets = 7", &["a.toml:2:12", "integer `7`", "one statement per line"]),
        ("dimension = 2\nbrackets = [[\"\"]]", &["a.toml:2:13", "expected a string"]),
        ("basis = [1, 2]\nbrackets = \"\"", &["a.toml:1:10", "integer `1`"]),
        ("dimension = 2.5\nbrackets = \"\"", &["a.toml:1:13", "`2.5`, expected an integer"]),
        ("dimension = nan\nbrackets = \"\"", &["a.toml:1:13", "`NaN`"]),
        ("dimension = 0\nbrackets = \"\"", &["a.toml:1:1", "0 is not between 1 and 2048"]),
        ("name = \"dimension\"\ndimension = -3\nbrackets = \"\"", &["a.toml:2:1", "dimension -3"]),
        ("dimension = 1000000000\nbrackets = \"\"", &["a.toml:1:1", "1000000000 is not"]),
        ("basis = []\nbrackets = \"\"", &["the dimension 0 is not"]),
    ]);
    definitions("a.json", str::to_string).usage(&[
        ("{\"dimension\": 2,\n\"brakets\": \"\"}", &["a.json:2:1", "unknown key `brakets`"]),
        ("{\"dimension\": 2,\n\"dimension\": 3}", &["a.json:2:1", "duplicate key `dimension`"]),
        ("{\"dimension\": 2, \"brackets\": \"\", \"metric\": [null]}", &["a.json:1:45", "null"]),
    ]);
}

#[test]
fn brackets_are_checked() {
    // the same words occur in a comment and in the name, which must not be reported
    let head = "# [x, w] = q\nname = \"[x, w] = q\"\nbasis = [\"x\", \"y\", \"z\"]\nparameters = [\"h\"]\n";
    let content = |statements: &str| format!("{head}brackets = \"\"\"\n{statements}\n\"\"\"");
    definitions("a.toml", content).usage(&[
        ("[x, w] = q", &["a.toml:6:5", "`w` is not a basis vector", "the basis is x, y, z"]),
        ("[x, y] = z\n[y, z] = q*x", &["a.toml:7:10", "`q` is neither", "parameters = [\"q\"]"]),
        ("[x, y] = 2*x*y", &["a.toml:6:10", "the product of two basis vectors"]),
        ("[x, y] = 1/x", &["a.toml:6:12", "a basis vector cannot divide"]),
        ("[x, y] = x^2", &["a.toml:6:10", "the product of two basis vectors"]),
        ("[x, y] = z + 3*h", &["a.toml:6:10", "the term 3*h does not contain a basis vector"]),
        ("[x y] = z", &["a.toml:6:2", "separated by a comma", "write [x, y] = ..."]),
        ("[x, y, z] = z", &["a.toml:6:2", "write two basis vectors in the bracket"]),
        ("[x, ] = z", &["a.toml:6:4", "`` is not a basis vector"]),
        ("[x, y] z", &["a.toml:6:1", "`=` is missing"]),
        ("[x, y] =", &["a.toml:6:9", "the expression ends"]),
        ("x y = z", &["a.toml:6:1", "this is not a bracket statement"]),
        ("nabla[x, y] = z", &["a.toml:6:1", "this is not a bracket statement"]),
        ("[x, y] = z [y, z] = x", &["a.toml:6:12", "`[` is not expected here"]),
        ("[x, y] = z\n[x, y] = 2*z", &["a.toml:7:1", "a second, different value", "`[x, y] = z`"]),
        ("[x, y] = 2x", &["a.toml:6:10", "write `*` or a space between the number and `x`"]),
    ]);
    definitions("a.toml", content).mathematics(&[
        (
            "[x, y] = z\n[y, x] = h*z",
            &["a.toml:7:1", "[x, y] + [y, x] = (h + 1)*z", "so that [y,x] = -[x,y]"],
        ),
        ("[y, y] = 1/2*z", &["a.toml:6:1", "[y, y] + [y, y] = z"]),
        (
            "[x, y] = z\n[y, z] = x\n[x, z] = -1e-12*x - y",
            &[
                "a.toml:6:1",
                "[[x,y],z] + [[y,z],x] + [[z,x],y] = 1/1000000000000*z",
                "the brackets of these three",
            ],
        ),
        ("[x, y] = z\n[y, z] = h*y", &["a.toml:6:1", "[[x,y],z] + [[y,z],x] + [[z,x],y] = -h*z"]),
    ]);
}

#[test]
fn places_are_right_behind_escapes() {
    let json = r##"{"name": "[x, y] = q", "basis": ["x", "y"],
  "brackets": "# \u00e9 [x, y] = q\n\t[x, y] = 1/0*x"}"##;
    definitions("a.json", str::to_string).usage(&[(json, &["a.json:2:50", "division by zero"])]);
    let toml = "basis = ['x', 'y']\nbrackets = \"\"\"#\\n[x, y] = \\\n   2*w\"\"\"";
    definitions("a.toml", str::to_string).usage(&[(toml, &["a.toml:3:6", "`w`"])]);
    let toml = "basis = ['x', 'y']\r\nbrackets = \"\"\"\r\n[x, y] = x\r\n[x, y] = w\r\n\"\"\"";
    definitions("a.toml", str::to_string).usage(&[(toml, &["a.toml:4:10", "`w`"])]);
    let list = "dimension = 2\nbrackets = [\"#\", \"[e1, e2] = e1\",\n\"[e1, e2] = e2\"]";
    definitions("a.toml", str::to_string).usage(&[(list, &["a.toml:3:2", "a second, different"])]);
}

#[test]
fn structure_constants_are_checked() {
    let content = |rows: &str| format!("dimension = 3\nstructure_constants = [{rows}]");
    definitions("a.toml", content).usage(&[
        ("[0, 2, 3, \"1\"]", &["a.toml:2:35", "3, \"1\"]: the index 0 is not in 1..3"]),
        ("[1, -2, 3, 1]", &["a.toml:2:35", "the index -2 is not in 1..3"]),
        (
            "[1, 2, 3, 1], [1, 2, 4, \"5\"]",
            &["a.toml:2:49", "entry 2, [1, 2, 4, \"5\"]: the index 4 is not in 1..3"],
        ),
        ("[-9223372036854775808, 2, 3, 1]", &["the index -9223372036854775808 is not in 1..3"]),
        ("[1, 2, 9223372036854775807, 1]", &["the index 9223372036854775807 is not in 1..3"]),
        ("[\"1\", 2, 3, 1]", &["a.toml:2:25", "expected an integer"]),
        ("[1, 2, 3]", &["a.toml:2:24", "invalid length 3, expected [i, j, k, \"v\"]"]),
        ("[1, 2, 3, 1, 1]", &["a.toml:2:24", "invalid length 5"]),
        ("[1, 2, 3, 0.5]", &["a.toml:2:34", "0.5", "in quotes"]),
        ("[1, 2, 3, \"1/0\"]", &["a.toml:2:37", "entry 1, [1, 2, 3, \"1/0\"]: division by zero"]),
        (
            "[1, 2, 3, \"1\"], [1, 2, 3, \"1\"]",
            &["entry 2, [1, 2, 3, \"1\"]: this component is given twice"],
        ),
    ]);
    definitions("a.toml", content).mathematics(&[(
        "[1, 2, 3, \"1\"], [2, 1, 3, \"1\"]",
        &["a.toml:2:51", "[e1, e2] + [e2, e1] = 2*e3"],
    )]);
}

#[test]
fn matrices_are_checked() {
    let content = |matrices: &str| format!("matrices = [{matrices}]");
    definitions("a.toml", content).mathematics(&[
        (
            "[['0','1'],['0','0']], [['0','0'],['1','0']]",
            &[
                "a.toml",
                "[e1, e2] is not in their real span, with the remainder 1 at row 1, column 1",
            ],
        ),
        ("[['0','1'],['0','0']], [['0','2'],['0','0']]", &["a.toml", "-2*e1 + e2 = 0"]),
        ("[['i','0'],['0','1']], [['2*i','0'],['0','2']]", &["over the reals: -2*e1 + e2 = 0"]),
        ("[['0']]", &["e1 = 0"]),
        (
            "[['0','1'],['0','0']], [['i','0'],['0','0']]",
            &["[e1, e2] is not in their real span, with the remainder -i at row 1, column 2"],
        ),
    ]);
    definitions("a.toml", content).usage(&[
        ("[['0','1'],['0']]", &["a.toml:1:16", "`e1` has 2 rows of 1 or 2 entries"]),
        ("[['0','1'],['0','0']], [['1']]", &["a.toml:1:39", "`e2` has 1 row of 1 entry"]),
        ("[['0','1']]", &["the matrix of `e1` has 1 row of 2 entries, not 1 x 1"]),
        ("[]", &["a.toml:1:1", "the matrix of `e1`"]),
        ("", &["the dimension 0 is not"]),
        ("[['0','1/0'],['0','0']]", &["a.toml:1:22", "division by zero"]),
        ("[['1/(i-i)']]", &["a.toml:1:18", "division by zero"]),
        ("{nome = 'x', rows = [['1']]}", &["a.toml:1:14", "unknown key `nome`"]),
        (
            "{name = 'x', rows = [['1']]}, {name = 'x', rows = [['2']]}",
            &["a.toml:1:52", "the basis vector `x` is named twice"],
        ),
    ]);
    definitions("a.toml", str::to_string).usage(&[
        ("dimension = 2\nmatrices = [[['1']]]", &["a.toml:2:1", "1 matrices for 2 basis vectors"]),
        (
            "basis = ['x']\nmatrices = [{name = 'y', rows = [['1']]}]",
            &["a.toml:2:22", "the matrix of `x` is named `y`"],
        ),
        ("parameters = ['i']\nmatrices = [[['i']]]", &["a.toml:1:16", "is already in use"]),
    ]);
}

#[test]
fn metrics_are_checked() {
    let content = |value: &str| with(&format!("metric = {value}"));
    definitions("a.toml", content).usage(&[
        ("'diag(1)'", &["a.toml:3:11", "diag has 1 entry, but the dimension is 2"]),
        ("'diag(1, 2, 3)'", &["a.toml:3:11", "diag has 3 entries"]),
        ("[[1, 0], [0, 1], [0, 0]]", &["a.toml:3:1", "3 rows of 2 entries"]),
        ("[[1, 0], [0]]", &["a.toml:3:1", "2 rows of 1 or 2 entries"]),
        ("[]", &["a.toml:3:1", "the metric has no rows"]),
        ("'[[1, 0]]'", &["a.toml:3:11", "1 row of 2 entries"]),
        ("'[1, 2]'", &["a.toml:3:12", "write each row of the metric as `[a, b, ...]`"]),
        ("'euclid'", &["a.toml:3:11", "`euclid` is not a metric", "identity, killing, diag"]),
        ("''", &["a.toml:3:11", "`` is not a metric"]),
        ("[[0.5, 0], [0, 1]]", &["a.toml:3:12", "0.5"]),
        ("[['nan', '0'], ['0', '1']]", &["a.toml:3:13", "`nan` is not a number"]),
        ("'diag(1, m)'", &["a.toml:3:19", "`m` is neither"]),
    ]);
    definitions("a.toml", content).mathematics(&[
        ("[[1, 2], [3, 1]]", &["a.toml:3:1", "g(x,y) - g(y,x) = -1", "the same value"]),
        ("'diag(1, 0)'", &["a.toml:3:11", "y is orthogonal to every vector"]),
        ("[[1, 2], [2, 4]]", &["a.toml:3:1", "-2*x + y is orthogonal to every vector"]),
        ("'diag(0, 0)'", &["x is orthogonal to every vector"]),
        ("'killing'", &["a.toml:3:11", "x is orthogonal to every vector"]),
    ]);
}

#[test]
fn connections_are_checked() {
    definitions("a.toml", with).usage(&[
        ("connection = 'levi'", &["a.toml:3:15", "`levi` is not a connection", "levi-civita"]),
        ("connection = ''", &["a.toml:3:15", "`` is not a connection"]),
        ("connection = 'lambda = '", &["a.toml:3:23", "the expression ends"]),
        ("connection = 'lambda = t'", &["a.toml:3:24", "`t` is neither"]),
        ("connection = 'lambda = x'", &["a.toml:3:24", "`x` is neither"]),
        ("affinities = '[x, y] = x'", &["a.toml:3:15", "write nabla[x, y] = ..."]),
        ("affinities = 'nabla[x, z] = x'", &["a.toml:3:24", "`z` is not a basis vector"]),
        (
            "affinities = ['nabla[x, x] = x', 'nabla[x, x] = y']",
            &["a.toml:3:35", "the first is `nabla[x, x] = x`"],
        ),
    ]);
    definitions("a.toml", with).mathematics(&[(
        "connection = 'levi-civita'",
        &["a.toml:3:15", "none is given", "give a metric"],
    )]);
}
