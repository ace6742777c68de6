//! Names that are unknown, ambiguous, or contain control characters.

use crate::bad_input::case::{commands, definitions};

#[test]
fn names_in_files() {
    definitions("a.toml", str::to_string).usage(&[
        ("basis = ['x', 'y', 'x']\nbrackets = ''", &["a.toml:1:21", "`x` is named twice"]),
        ("basis = ['x', '2y']\nbrackets = ''", &["a.toml:1:16", "`2y`", "letter or _"]),
        ("basis = [\"'\"]\nbrackets = ''", &["a.toml:1:11", "is not a name"]),
        ("basis = [\"x'y\"]\nbrackets = ''", &["a.toml:1:11", "is not a name"]),
        ("basis = ['x']\nbrackets = ''\nmetric = \"diag(a')\"", &["a.toml:3", "`a'` is not"]),
        ("basis = ['x', '']\nbrackets = ''", &["a.toml:1:16", "`` is not a name"]),
        ("basis = ['x ', 'y']\nbrackets = ''", &["a.toml:1:11", "`x ` is not a name"]),
        ("basis = ['x', 'у']\nbrackets = ''", &["a.toml:1:16", "`\\u{443}` is not a name"]),
        ("basis = ['x', 'y']\nbrackets = '[x, у] = x'", &["a.toml:2:17", "`\\u{443}` is not"]),
        (
            "basis = ['x', 'y']\nbrackets = '[x, y] = х'",
            &["a.toml:2:22", "the character \\u{445} is not expected here"],
        ),
        ("basis = ['x']\nparameters = ['а']\nbrackets = ''", &["a.toml:2:16", "`\\u{430}` is not"]),
        ("basis = ['x']\n'nаme' = 'x'\nbrackets = ''", &["a.toml:2:1", "unknown key"]),
        (
            "basis = ['x', 'y']\nparameters = ['y']\nbrackets = ''",
            &["a.toml:2:16", "the name `y` of the parameter is already in use"],
        ),
        (
            "basis = ['x']\nparameters = ['a', 'a']\nbrackets = ''",
            &["a.toml:2:21", "the name `a` of the parameter is already in use"],
        ),
        (
            "basis = ['x', 'y']\nparameters = ['NaN']\nbrackets = '[x, y] = NaN*x'",
            &["a.toml:3:22", "`NaN` is not a number"],
        ),
        ("basis = ['x', \"\\u001b[31m\"]\nbrackets = ''", &["a.toml", "`\\u{1b}[31m` is not"]),
        (
            "basis = ['x', 'y']\nbrackets = \"[x, y] = \\u001b[31m\"",
            &["a.toml:2:22", "the character \\u{1b} is not expected"],
        ),
        ("basis = ['x']\n\"\\u001b[31m\" = 1", &["a.toml:2:1", "unknown key `\\u{1b}[31m`"]),
        (
            "basis = ['x']\nbrackets = ''\nmetric = \"\\u001b[31m\"",
            &["a.toml:3:11", "`\\u{1b}[31m` is not a metric"],
        ),
        ("basis = ['x', '\u{202e}y']\nbrackets = ''", &["a.toml:1:16", "`\\u{202e}y` is not"]),
        (
            &format!("basis = ['{}']\nbrackets = ''", "x".repeat(65)),
            &["a.toml:1:11", "is not a name", "at most 64"],
        ),
    ]);
}

#[test]
fn spaces_without_an_algebra() {
    commands(&["table"]).usage(&[
        ("so31", &["SPACE:1:1", "can be read as so(31) or so(3,1)", "write the parentheses"]),
        ("soo3", &["SPACE:1:1", "no algebra named `soo3`", "nearest is so(3)"]),
        ("Heisenburg(3)", &["nearest is heisenberg(3)"]),
        ("xyzzy", &["no algebra named `xyzzy`", "`affinor list` shows the names"]),
        ("E9", &["no `E9` in the catalogue", "n = 6, 7, 8"]),
        ("sp(5)", &["no `sp(5)` in the catalogue", "an even number"]),
        ("so(0)", &["no `so(0)`"]),
        ("so(-3)", &["no `so(-3)`"]),
        ("so(3,1,1)", &["no `so(3,1,1)`"]),
        ("so", &["`so` needs arguments", "so(3)"]),
        ("so()", &["`so()` needs arguments"]),
        ("so(3", &["SPACE:1:3", "this parenthesis is not closed"]),
        ("so(3))", &["SPACE:1:6", "nothing is expected behind the parenthesis"]),
        ("so(99)", &["the dimension of `so(99)` exceeds the limit of 2048"]),
        ("so(1000000000)", &["exceeds the limit"]),
        ("sl(99999999999999999999999999)", &["exceeds the limit"]),
        ("so3+", &["SPACE:1:5", "the name of an algebra is missing here"]),
        ("so3++so3", &["SPACE:1:5", "the name of an algebra is missing here"]),
        ("so3+bad9", &["SPACE:1:5", "no algebra named `bad9`"]),
        ("R^2000+R^2000", &["the dimension 4000 is not between 1 and 2048"]),
        ("", &["the name of an algebra is missing here"]),
        ("@plus", &["the name of an algebra is missing here"]),
        ("bianchi(VI,h=1/0)", &["SPACE:1:16", "division by zero"]),
        ("bianchi(VI,h=)", &["SPACE:1:", "bianchi"]),
        ("sо(3)", &["names of algebras must be ASCII, but this one contains \\u{43e}"]),
        ("\u{1b}[31mred", &["no algebra named `\\u{1b}[31mred`"]),
        ("so3@plus;zero", &["SPACE:1:10", "given twice"]),
        ("so3@metric=diag(1)", &["@metric:1:1", "diag has 1 entry, but the dimension is 3"]),
        ("so3@metrik=identity", &["@connection:1:1", "`metrik=identity` is not a connection"]),
        ("so3@lambda=1/0", &["@connection:1:10", "division by zero"]),
        ("so3@lambda=inf", &["@connection:1:8", "`inf` is not a number"]),
    ]);
    commands(&["table"]).mathematics(&[("so3@levi-civita", &["@connection:1:1", "none is given"])]);
}

#[test]
fn inline_brackets() {
    commands(&["table", "so3", "--basis", "x y", "--bracket"]).usage(&[("[x,y]=x", &["not both"])]);
    commands(&["table"])
        .usage(&[("so3 --bracket [x,y]=x", &["not both"]), ("--bracket [x,y]=x", &["--basis"])]);
    commands(&["table", "--basis", "x y x", "--bracket"])
        .usage(&[("", &["--basis:1:5", "`x` is named twice"])]);
    commands(&["table", "--basis", "", "--bracket"]).usage(&[("", &["the dimension 0 is not"])]);
    commands(&["table", "--basis", "x y", "--bracket"]).usage(&[
        ("[x,z]=x", &["--bracket:1:4", "`z` is not a basis vector"]),
        ("[x,y]=q", &["--bracket:1:7", "the term q does not contain a basis vector"]),
    ]);
    commands(&["table", "--basis", "x y", "--bracket"])
        .mathematics(&[("[x,y]=x;[y,x]=x", &["--bracket:1:9", "[x, y] + [y, x] = 2*x"])]);
    commands(&["table", "--basis", "e1 e2", "--bracket"])
        .usage(&[("[e1,e2]=2e1", &["--bracket:1:9", "between the number and `e1`"])]);
    commands(&["table", "--basis", "x y z", "--bracket"])
        .mathematics(&[("[x,y]=z --bracket [y,z]=y", &["[[x,y],z] + [[y,z],x] + [[z,x],y] = -z"])]);
}

#[test]
fn names_of_files_are_shown_escaped() {
    let says = &["a\\u{1b}[31m\\u{202e}.toml:2:17", "`q`"];
    definitions("a\u{1b}[31m\u{202e}.toml", str::to_string)
        .usage(&[("basis = ['x']\nbrackets = '[x, q] = x'", says)]);
    commands(&["table"]).usage(&[
        ("b\u{1b}[31m.toml", &["cannot read b\\u{1b}[31m.toml"]),
        ("so3 -o no/b\u{1b}[31m", &["cannot write no/b\\u{1b}[31m"]),
        ("--b\u{1b}[31m", &["--b\\u{1b}[31m"]),
    ]);
    commands(&[]).usage(&[
        ("verify so3 b\u{1b}[31m.json", &["cannot read b\\u{1b}[31m.json"]),
        ("list \u{1b}[31m", &["`\\u{1b}[31m`"]),
        ("b\u{1b}[31m", &["b\\u{1b}[31m"]),
    ]);
}
