//! Definition files that cannot be understood, or define nothing.

use crate::bad_input::case::{Files, MATHEMATICS, USAGE, refuse_files};

/// A definition of the plane over the basis `x, y`, with more keys.
fn with(keys: &str) -> String {
    format!("basis = [\"x\", \"y\"]\nbrackets = \"[x, y] = x\"\n{keys}\n")
}

#[test]
fn syntax_errors_have_their_place() {
    let toml: &Files = &[
        ("unclosed array", "basis = [\"x\"\nbrackets = \"\"", USAGE, &["a.toml:2:1", "array"]),
        ("unclosed string", "name = \"x\nbrackets = \"\"", USAGE, &["a.toml:1:10", "string"]),
        ("no value", "dimension =\n", USAGE, &["a.toml:1:12", "string values must be quoted"]),
        ("no key", "= 3", USAGE, &["a.toml:1:1"]),
        ("unknown escape", "name = \"\\q\"", USAGE, &["a.toml:1:10", "escaped value"]),
        ("control character", "name = \"\u{1}\"", USAGE, &["a.toml:1:9", "invalid basic string"]),
        ("bare words", "bracket x y", USAGE, &["a.toml:1:9"]),
    ];
    refuse_files("a.toml", toml);
    let json: &Files = &[
        ("unclosed", "{", USAGE, &["a.json:1:1", "EOF while parsing an object"]),
        ("two commas", "{\"dimension\": 2,\n ,}", USAGE, &["a.json:2:2", "key must be a string"]),
        ("trailing comma", "{\"dimension\": 2,}", USAGE, &["a.json:1:17", "trailing comma"]),
        ("more behind", "{\"dimension\": 2, \"brackets\": \"\"} x", USAGE, &["a.json:1:34"]),
        ("an array", "[1, 2]", USAGE, &["a.json:1:1", "a JSON definition is an object of keys"]),
        ("single quotes", "{'dimension': 2}", USAGE, &["a.json:1:2", "key must be a string"]),
        ("not a number", "{\"dimension\": NaN}", USAGE, &["a.json:1:15", "expected value"]),
        ("half a surrogate", "{\"name\": \"\\ud800\"}", USAGE, &["a.json:1:1", "hex escape"]),
    ];
    refuse_files("a.json", json);
}

#[test]
fn keys_are_checked() {
    let toml: &Files = &[
        (
            "unknown key",
            &with("brakets = \"\""),
            USAGE,
            &["a.toml:3:1", "unknown key `brakets`", "did you mean `brackets`?"],
        ),
        (
            "unknown table",
            &with("[foo]\nbar = 1"),
            USAGE,
            &["a.toml:3:2", "`foo`", "the keys are name, basis,"],
        ),
        ("duplicate key", &with("basis = [\"x\"]"), USAGE, &["a.toml:3:1", "duplicate key"]),
        (
            "two origins",
            &with("structure_constants = []"),
            USAGE,
            &["a.toml", "more than once", "exactly one of brackets, structure_constants, matrices"],
        ),
        ("no origin", "dimension = 3", USAGE, &["a.toml", "defines no bracket"]),
        (
            "basis and dimension",
            &with("dimension = 2"),
            USAGE,
            &["a.toml:3:1", "either basis or dimension"],
        ),
        ("no basis", "# nothing\nbrackets = \"[x, y] = x\"", USAGE, &["a.toml has no basis"]),
        (
            "connection and affinities",
            &with("connection = \"zero\"\naffinities = \"\""),
            USAGE,
            &["a.toml:4:1", "not both"],
        ),
        ("empty", "", USAGE, &["a.toml is empty", "a definition has a basis and brackets"]),
        ("blank", " \n\t\n", USAGE, &["a.toml is empty"]),
        ("only a comment", "# nothing\n", USAGE, &["a.toml has no basis"]),
        (
            "brackets of a wrong type",
            "dimension = 2\nbrackets = 7",
            USAGE,
            &["a.toml:2:12", "integer `7`", "a string with one statement a line"],
        ),
        (
            "brackets too deep",
            "dimension = 2\nbrackets = [[\"\"]]",
            USAGE,
            &["a.toml:2:13", "expected a string"],
        ),
        (
            "basis of numbers",
            "basis = [1, 2]\nbrackets = \"\"",
            USAGE,
            &["a.toml:1:10", "integer `1`"],
        ),
        ("name of a wrong type", &with("name = 3"), USAGE, &["a.toml:3:8", "integer `3`"]),
        (
            "a broken dimension",
            "dimension = 2.5\nbrackets = \"\"",
            USAGE,
            &["a.toml:1:13", "`2.5`, expected an integer"],
        ),
        (
            "no number of dimensions",
            "dimension = nan\nbrackets = \"\"",
            USAGE,
            &["a.toml:1:13", "`NaN`"],
        ),
        (
            "dimension zero",
            "dimension = 0\nbrackets = \"\"",
            USAGE,
            &["a.toml:1:1", "the dimension 0 is not between 1 and 2048"],
        ),
        (
            "dimension below zero",
            "name = \"dimension\"\ndimension = -3\nbrackets = \"\"",
            USAGE,
            &["a.toml:2:1", "the dimension -3 is not"],
        ),
        (
            "dimension 10^9",
            "dimension = 1000000000\nbrackets = \"\"",
            USAGE,
            &["a.toml:1:1", "the dimension 1000000000 is not"],
        ),
        ("empty basis", "basis = []\nbrackets = \"\"", USAGE, &["the dimension 0 is not"]),
    ];
    refuse_files("a.toml", toml);
    let json: &Files = &[
        (
            "unknown key",
            "{\"dimension\": 2,\n\"brakets\": \"\"}",
            USAGE,
            &["a.json:2:1", "unknown key `brakets`"],
        ),
        (
            "duplicate key",
            "{\"dimension\": 2,\n\"dimension\": 3}",
            USAGE,
            &["a.json:2:1", "duplicate key `dimension`"],
        ),
        (
            "null",
            "{\"dimension\": 2, \"brackets\": \"\", \"metric\": [null]}",
            USAGE,
            &["a.json:1:45", "null"],
        ),
    ];
    refuse_files("a.json", json);
}

#[test]
fn brackets_are_checked() {
    // the same words stand in a comment and in the name, where they are not meant
    let head = "# [x, w] = q\nname = \"[x, w] = q\"\nbasis = [\"x\", \"y\", \"z\"]\nparameters = [\"h\"]\n";
    let table: [(&str, &str, i32, &[&str]); 20] = [
        (
            "unknown basis vector",
            "[x, w] = q",
            USAGE,
            &["a.toml:6:5", "`w` is not a basis vector", "the basis is x, y, z"],
        ),
        (
            "undeclared parameter",
            "[x, y] = z\n[y, z] = q*x",
            USAGE,
            &[
                "a.toml:7:10",
                "`q` is neither a basis vector here nor a declared parameter",
                "declare a parameter: parameters = [\"q\"]",
            ],
        ),
        (
            "two basis vectors",
            "[x, y] = 2*x*y",
            USAGE,
            &["a.toml:6:10", "the product of two basis vectors"],
        ),
        (
            "divided by a basis vector",
            "[x, y] = 1/x",
            USAGE,
            &["a.toml:6:12", "a basis vector cannot divide"],
        ),
        (
            "a power of a basis vector",
            "[x, y] = x^2",
            USAGE,
            &["a.toml:6:10", "the product of two basis vectors"],
        ),
        (
            "a scalar part",
            "[x, y] = z + 3*h",
            USAGE,
            &["a.toml:6:10", "the part 3*h has no basis vector"],
        ),
        (
            "no comma",
            "[x y] = z",
            USAGE,
            &["a.toml:6:2", "separated by a comma", "write [x, y] = ..."],
        ),
        (
            "three vectors",
            "[x, y, z] = z",
            USAGE,
            &["a.toml:6:2", "a bracket has two basis vectors"],
        ),
        ("one vector", "[x, ] = z", USAGE, &["a.toml:6:4", "`` is not a basis vector"]),
        ("no sign of equality", "[x, y] z", USAGE, &["a.toml:6:1", "`=` is missing"]),
        ("no right side", "[x, y] =", USAGE, &["a.toml:6:9", "the expression ends"]),
        ("no bracket", "x y = z", USAGE, &["a.toml:6:1", "this is not a bracket statement"]),
        (
            "affinities here",
            "nabla[x, y] = z",
            USAGE,
            &["a.toml:6:1", "this is not a bracket statement"],
        ),
        (
            "two statements a line",
            "[x, y] = z [y, z] = x",
            USAGE,
            &["a.toml:6:12", "`[` is not expected here"],
        ),
        (
            "given twice",
            "[x, y] = z\n[x, y] = 2*z",
            USAGE,
            &["a.toml:7:1", "a second, different value", "the first is `[x, y] = z`"],
        ),
        (
            "contradiction",
            "[x, y] = z\n[y, x] = h*z",
            MATHEMATICS,
            &["a.toml:7:1", "[x, y] + [y, x] = (h + 1)*z", "[y,x] must be -[x,y]"],
        ),
        ("[x, x] not zero", "[y, y] = 1/2*z", MATHEMATICS, &["a.toml:6:1", "[y, y] + [y, y] = z"]),
        (
            "Jacobi, by 10^-12",
            "[x, y] = z\n[y, z] = x\n[x, z] = -1e-12*x - y",
            MATHEMATICS,
            &[
                "a.toml:6:1",
                "[[x,y],z] + [[y,z],x] + [[z,x],y] = 1/1000000000000*z",
                "the brackets of these three",
            ],
        ),
        (
            "Jacobi, in a parameter",
            "[x, y] = z\n[y, z] = h*y",
            MATHEMATICS,
            &["a.toml:6:1", "[[x,y],z] + [[y,z],x] + [[z,x],y] = -h*z"],
        ),
        (
            "digits glued to e",
            "[x, y] = 2x",
            USAGE,
            &["a.toml:6:10", "write `*` or a space between the number and `x`"],
        ),
    ];
    for (name, statements, status, says) in table {
        let content = format!("{head}brackets = \"\"\"\n{statements}\n\"\"\"");
        refuse_files("a.toml", &[(name, &content, status, says)]);
    }
}

#[test]
fn places_are_right_behind_escapes() {
    let json = r##"{"name": "[x, y] = q", "basis": ["x", "y"],
  "brackets": "# \u00e9 [x, y] = q\n\t[x, y] = 1/0*x"}"##;
    refuse_files("a.json", &[("a JSON string", json, USAGE, &["a.json:2:50", "division by zero"])]);
    let toml = "basis = ['x', 'y']\nbrackets = \"\"\"#\\n[x, y] = \\\n   2*w\"\"\"";
    refuse_files("a.toml", &[("a TOML string", toml, USAGE, &["a.toml:3:6", "`w`"])]);
    let toml = "basis = ['x', 'y']\r\nbrackets = \"\"\"\r\n[x, y] = x\r\n[x, y] = w\r\n\"\"\"";
    refuse_files("a.toml", &[("lines of DOS", toml, USAGE, &["a.toml:4:10", "`w`"])]);
    let list = "dimension = 2\nbrackets = [\"#\", \"[e1, e2] = e1\",\n\"[e1, e2] = e2\"]";
    refuse_files("a.toml", &[("an array", list, USAGE, &["a.toml:3:2", "a second, different"])]);
}

#[test]
fn structure_constants_are_checked() {
    let rows: [(&str, &str, i32, &[&str]); 12] = [
        (
            "index zero",
            "[0, 2, 3, \"1\"]",
            USAGE,
            &["a.toml:2:35", "entry 1, [0, 2, 3, \"1\"]: the index 0 is not in 1..3"],
        ),
        (
            "index below zero",
            "[1, -2, 3, 1]",
            USAGE,
            &["a.toml:2:35", "the index -2 is not in 1..3"],
        ),
        (
            "index too big",
            "[1, 2, 3, 1], [1, 2, 4, \"5\"]",
            USAGE,
            &["a.toml:2:49", "entry 2, [1, 2, 4, \"5\"]: the index 4 is not in 1..3"],
        ),
        (
            "the least index of all",
            "[-9223372036854775808, 2, 3, 1]",
            USAGE,
            &["the index -9223372036854775808 is not in 1..3"],
        ),
        (
            "the largest of all",
            "[1, 2, 9223372036854775807, 1]",
            USAGE,
            &["the index 9223372036854775807 is not in 1..3"],
        ),
        ("index that is text", "[\"1\", 2, 3, 1]", USAGE, &["a.toml:2:25", "expected an integer"]),
        (
            "three entries",
            "[1, 2, 3]",
            USAGE,
            &["a.toml:2:24", "invalid length 3, expected [i, j, k, \"v\"]"],
        ),
        ("five entries", "[1, 2, 3, 1, 1]", USAGE, &["a.toml:2:24", "invalid length 5"]),
        ("a float", "[1, 2, 3, 0.5]", USAGE, &["a.toml:2:34", "0.5", "in quotes"]),
        (
            "a bad value",
            "[1, 2, 3, \"1/0\"]",
            USAGE,
            &["a.toml:2:37", "entry 1, [1, 2, 3, \"1/0\"]: division by zero"],
        ),
        (
            "given twice",
            "[1, 2, 3, \"1\"], [1, 2, 3, \"1\"]",
            USAGE,
            &["entry 2, [1, 2, 3, \"1\"]: this component is given twice"],
        ),
        (
            "contradiction",
            "[1, 2, 3, \"1\"], [2, 1, 3, \"1\"]",
            MATHEMATICS,
            &["a.toml:2:51", "[e1, e2] + [e2, e1] = 2*e3"],
        ),
    ];
    for (name, rows, status, says) in rows {
        let content = format!("dimension = 3\nstructure_constants = [{rows}]");
        refuse_files("a.toml", &[(name, &content, status, says)]);
    }
}

#[test]
fn matrices_are_checked() {
    let matrices: [(&str, &str, i32, &[&str]); 14] = [
        (
            "not closed",
            "[['0','1'],['0','0']], [['0','0'],['1','0']]",
            MATHEMATICS,
            &["a.toml", "[e1, e2] leaves their real span, by 1 at row 1, column 1"],
        ),
        (
            "dependent",
            "[['0','1'],['0','0']], [['0','2'],['0','0']]",
            MATHEMATICS,
            &["a.toml", "-2*e1 + e2 = 0"],
        ),
        (
            "dependent over the reals only",
            "[['i','0'],['0','1']], [['2*i','0'],['0','2']]",
            MATHEMATICS,
            &["over the reals: -2*e1 + e2 = 0"],
        ),
        ("zero", "[['0']]", MATHEMATICS, &["e1 = 0"]),
        (
            "complex constants",
            "[['0','1'],['0','0']], [['i','0'],['0','0']]",
            MATHEMATICS,
            &["[e1, e2] leaves their real span, by -i at row 1, column 2"],
        ),
        (
            "ragged",
            "[['0','1'],['0']]",
            USAGE,
            &["a.toml:1:16", "the matrix of `e1` has 2 rows of 1 or 2 entries, not 2 x 2"],
        ),
        (
            "different sizes",
            "[['0','1'],['0','0']], [['1']]",
            USAGE,
            &["a.toml:1:39", "the matrix of `e2` has 1 rows of 1 entries, not 2 x 2"],
        ),
        (
            "not square",
            "[['0','1']]",
            USAGE,
            &["the matrix of `e1` has 1 rows of 2 entries, not 1 x 1"],
        ),
        ("no rows", "[]", USAGE, &["a.toml:1:1", "the matrix of `e1`"]),
        ("none", "", USAGE, &["the dimension 0 is not"]),
        ("a bad entry", "[['0','1/0'],['0','0']]", USAGE, &["a.toml:1:22", "division by zero"]),
        ("one over zero times i", "[['1/(i-i)']]", USAGE, &["a.toml:1:18", "division by zero"]),
        (
            "an unknown key",
            "{nome = 'x', rows = [['1']]}",
            USAGE,
            &["a.toml:1:14", "unknown key `nome`"],
        ),
        (
            "named twice",
            "{name = 'x', rows = [['1']]}, {name = 'x', rows = [['2']]}",
            USAGE,
            &["a.toml:1:52", "the basis vector `x` is named twice"],
        ),
    ];
    for (name, matrices, status, says) in matrices {
        let content = format!("matrices = [{matrices}]");
        refuse_files("a.toml", &[(name, &content, status, says)]);
    }
    let more: &Files = &[
        (
            "too few",
            "dimension = 2\nmatrices = [[['1']]]",
            USAGE,
            &["a.toml:2:1", "1 matrices for 2 basis vectors"],
        ),
        (
            "another name",
            "basis = ['x']\nmatrices = [{name = 'y', rows = [['1']]}]",
            USAGE,
            &["a.toml:2:22", "the matrix of `x` is named `y`"],
        ),
        (
            "i is a number",
            "parameters = ['i']\nmatrices = [[['i']]]",
            USAGE,
            &["a.toml:1:16", "already the name of something"],
        ),
    ];
    refuse_files("a.toml", more);
}

#[test]
fn metrics_are_checked() {
    let table: [(&str, &str, i32, &[&str]); 17] = [
        (
            "diag too short",
            "'diag(1)'",
            USAGE,
            &["a.toml:3:11", "diag has 1 entries, the dimension is 2"],
        ),
        ("diag too long", "'diag(1, 2, 3)'", USAGE, &["a.toml:3:11", "diag has 3 entries"]),
        (
            "too many rows",
            "[[1, 0], [0, 1], [0, 0]]",
            USAGE,
            &["a.toml:3:1", "the metric has 3 rows of 2 entries, the dimension is 2"],
        ),
        ("ragged rows", "[[1, 0], [0]]", USAGE, &["a.toml:3:1", "2 rows of 1 or 2 entries"]),
        ("no rows", "[]", USAGE, &["a.toml:3:1", "0 rows"]),
        ("rows in words, too few", "'[[1, 0]]'", USAGE, &["a.toml:3:11", "1 rows of 2 entries"]),
        (
            "no rows in words",
            "'[1, 2]'",
            USAGE,
            &["a.toml:3:12", "a row of the metric is `[a, b, ...]`"],
        ),
        (
            "asymmetric",
            "[[1, 2], [3, 1]]",
            MATHEMATICS,
            &["a.toml:3:1", "g(x,y) - g(y,x) = -1", "the same value at both places"],
        ),
        (
            "degenerate",
            "'diag(1, 0)'",
            MATHEMATICS,
            &["a.toml:3:11", "y is orthogonal to every vector"],
        ),
        (
            "degenerate rows",
            "[[1, 2], [2, 4]]",
            MATHEMATICS,
            &["a.toml:3:1", "-2*x + y is orthogonal to every vector"],
        ),
        ("zero", "'diag(0, 0)'", MATHEMATICS, &["x is orthogonal to every vector"]),
        (
            "killing form of a solvable algebra",
            "'killing'",
            MATHEMATICS,
            &["a.toml:3:11", "x is orthogonal to every vector"],
        ),
        (
            "a word",
            "'euclid'",
            USAGE,
            &["a.toml:3:11", "`euclid` is not a metric", "identity, killing, diag(a, b, ...)"],
        ),
        ("empty", "''", USAGE, &["a.toml:3:11", "`` is not a metric"]),
        ("a float", "[[0.5, 0], [0, 1]]", USAGE, &["a.toml:3:12", "0.5"]),
        (
            "not a number",
            "[['nan', '0'], ['0', '1']]",
            USAGE,
            &["a.toml:3:13", "`nan` is not a number"],
        ),
        ("an undeclared parameter", "'diag(1, m)'", USAGE, &["a.toml:3:19", "`m` is neither"]),
    ];
    for (name, value, status, says) in table {
        let content = with(&format!("metric = {value}"));
        refuse_files("a.toml", &[(name, &content, status, says)]);
    }
}

#[test]
fn connections_are_checked() {
    let table: [(&str, &str, i32, &[&str]); 9] = [
        (
            "unknown",
            "connection = 'levi'",
            USAGE,
            &["a.toml:3:15", "`levi` is not a connection", "levi-civita"],
        ),
        ("empty", "connection = ''", USAGE, &["a.toml:3:15", "`` is not a connection"]),
        (
            "no metric",
            "connection = 'levi-civita'",
            MATHEMATICS,
            &["a.toml:3:15", "none is given", "give a metric"],
        ),
        ("no lambda", "connection = 'lambda = '", USAGE, &["a.toml:3:23", "the expression ends"]),
        (
            "an undeclared lambda",
            "connection = 'lambda = t'",
            USAGE,
            &["a.toml:3:24", "`t` is neither"],
        ),
        (
            "a vector for lambda",
            "connection = 'lambda = x'",
            USAGE,
            &["a.toml:3:24", "`x` is neither"],
        ),
        (
            "no nabla",
            "affinities = '[x, y] = x'",
            USAGE,
            &["a.toml:3:15", "write nabla[x, y] = ..."],
        ),
        (
            "an unknown direction",
            "affinities = 'nabla[x, z] = x'",
            USAGE,
            &["a.toml:3:24", "`z` is not a basis vector"],
        ),
        (
            "given twice",
            "affinities = ['nabla[x, x] = x', 'nabla[x, x] = y']",
            USAGE,
            &["a.toml:3:35", "the first is `nabla[x, x] = x`"],
        ),
    ];
    for (name, line, status, says) in table {
        refuse_files("a.toml", &[(name, &with(line), status, says)]);
    }
}
