//! Names that are none, that mean something else, or that would act on a terminal.

use crate::bad_input::case::{Case, Files, USAGE, refuse, refuse_commands, refuse_files};

#[test]
fn names_in_files() {
    let table: &Files = &[
        (
            "basis vector named twice",
            "basis = ['x', 'y', 'x']\nbrackets = ''",
            USAGE,
            &["a.toml:1:21", "the basis vector `x` is named twice"],
        ),
        (
            "not a name",
            "basis = ['x', '2y']\nbrackets = ''",
            USAGE,
            &["a.toml:1:16", "`2y` is not a name", "a name is an ASCII letter or _"],
        ),
        (
            "empty name",
            "basis = ['x', '']\nbrackets = ''",
            USAGE,
            &["a.toml:1:16", "`` is not a name"],
        ),
        (
            "a name with a space",
            "basis = ['x ', 'y']\nbrackets = ''",
            USAGE,
            &["a.toml:1:11", "`x ` is not a name"],
        ),
        (
            "Cyrillic basis vector",
            "basis = ['x', 'у']\nbrackets = ''",
            USAGE,
            &["a.toml:1:16", "`\\u{443}` is not a name"],
        ),
        (
            "Cyrillic in a bracket",
            "basis = ['x', 'y']\nbrackets = '[x, у] = x'",
            USAGE,
            &["a.toml:2:17", "`\\u{443}` is not a basis vector"],
        ),
        (
            "Cyrillic in an expression",
            "basis = ['x', 'y']\nbrackets = '[x, y] = х'",
            USAGE,
            &["a.toml:2:22", "the character \\u{445} is not expected here"],
        ),
        (
            "Cyrillic parameter",
            "basis = ['x']\nparameters = ['а']\nbrackets = ''",
            USAGE,
            &["a.toml:2:16", "`\\u{430}` is not a name"],
        ),
        (
            "Cyrillic key",
            "basis = ['x']\n'nаme' = 'x'\nbrackets = ''",
            USAGE,
            &["a.toml:2:1", "unknown key"],
        ),
        (
            "a parameter like a basis vector",
            "basis = ['x', 'y']\nparameters = ['y']\nbrackets = ''",
            USAGE,
            &["a.toml:2:16", "the parameter `y` is already the name of something"],
        ),
        (
            "a parameter declared twice",
            "basis = ['x']\nparameters = ['a', 'a']\nbrackets = ''",
            USAGE,
            &["a.toml:2:21", "`a` is already the name"],
        ),
        (
            "a parameter that is not a number",
            "basis = ['x', 'y']\nparameters = ['NaN']\nbrackets = '[x, y] = NaN*x'",
            USAGE,
            &["a.toml:3:22", "`NaN` is not a number"],
        ),
        (
            "escape sequence as a name",
            "basis = ['x', \"\\u001b[31m\"]\nbrackets = ''",
            USAGE,
            &["a.toml", "`\\u{1b}[31m` is not a name"],
        ),
        (
            "escape sequence in a bracket",
            "basis = ['x', 'y']\nbrackets = \"[x, y] = \\u001b[31m\"",
            USAGE,
            &["a.toml:2:22", "the character \\u{1b} is not expected"],
        ),
        (
            "escape sequence as a key",
            "basis = ['x']\n\"\\u001b[31m\" = 1",
            USAGE,
            &["a.toml:2:1", "unknown key `\\u{1b}[31m`"],
        ),
        (
            "escape sequence as a metric",
            "basis = ['x']\nbrackets = ''\nmetric = \"\\u001b[31m\"",
            USAGE,
            &["a.toml:3:11", "`\\u{1b}[31m` is not a metric"],
        ),
        (
            "direction of writing",
            "basis = ['x', '\u{202e}y']\nbrackets = ''",
            USAGE,
            &["a.toml:1:16", "`\\u{202e}y` is not a name"],
        ),
        (
            "a long name",
            &format!("basis = ['{}']\nbrackets = ''", "x".repeat(65)),
            USAGE,
            &["a.toml:1:11", "is not a name", "at most 64"],
        ),
    ];
    refuse_files("a.toml", table);
}

#[test]
fn spaces_without_an_algebra() {
    refuse_commands(&[
        (
            &["table", "so31"],
            USAGE,
            &["SPACE:1:1", "can be read as so(31) or so(3,1)", "write the parentheses"],
        ),
        (&["table", "soo3"], USAGE, &["SPACE:1:1", "no algebra named `soo3`", "nearest is so(3)"]),
        (&["table", "Heisenberg(3)"], USAGE, &["nearest is heisenberg(3)"]),
        (
            &["table", "xyzzy"],
            USAGE,
            &["no algebra named `xyzzy`", "`affinor list` shows the names"],
        ),
        (&["table", "E9"], USAGE, &["no `E9` in the catalogue", "n = 6, 7, 8"]),
        (&["table", "sp(5)"], USAGE, &["no `sp(5)` in the catalogue", "an even number"]),
        (&["table", "so(0)"], USAGE, &["no `so(0)`"]),
        (&["table", "so(-3)"], USAGE, &["no `so(-3)`"]),
        (&["table", "so(3,1,1)"], USAGE, &["no `so(3,1,1)`"]),
        (&["table", "so"], USAGE, &["`so` needs arguments", "so(3)"]),
        (&["table", "so()"], USAGE, &["`so()` needs arguments"]),
        (&["table", "so(3"], USAGE, &["SPACE:1:3", "this parenthesis is not closed"]),
        (&["table", "so(3))"], USAGE, &["SPACE:1:6", "nothing is expected behind the parenthesis"]),
        (&["table", "so(99)"], USAGE, &["the dimension of `so(99)` exceeds the limit of 2048"]),
        (&["table", "so(1000000000)"], USAGE, &["exceeds the limit"]),
        (&["table", "sl(99999999999999999999999999)"], USAGE, &["exceeds the limit"]),
        (&["table", "so3+"], USAGE, &["SPACE:1:5", "the name of an algebra is missing here"]),
        (&["table", "so3++so3"], USAGE, &["SPACE:1:5", "the name of an algebra is missing here"]),
        (&["table", "so3+bad9"], USAGE, &["SPACE:1:5", "no algebra named `bad9`"]),
        (&["table", "R^2000+R^2000"], USAGE, &["the dimension 4000 is not between 1 and 2048"]),
        (&["table", ""], USAGE, &["the name of an algebra is missing here"]),
        (&["table", "@plus"], USAGE, &["the name of an algebra is missing here"]),
        (&["table", "bianchi(VI,h=1/0)"], USAGE, &["SPACE:1:16", "division by zero"]),
        (&["table", "bianchi(VI,h=)"], USAGE, &["SPACE:1:", "bianchi"]),
        (&["table", "sо(3)"], USAGE, &["names are ASCII; this is not: \\u{43e}"]),
        (&["table", "\u{1b}[31mred"], USAGE, &["no algebra named `\\u{1b}[31mred`"]),
        (&["table", "so3@plus;zero"], USAGE, &["SPACE:1:10", "named twice"]),
        (
            &["table", "so3@metric=diag(1)"],
            USAGE,
            &["@metric:1:1", "diag has 1 entries, the dimension is 3"],
        ),
        (
            &["table", "so3@metrik=identity"],
            USAGE,
            &["@connection:1:1", "`metrik=identity` is not a connection"],
        ),
        (&["table", "so3@lambda=1/0"], USAGE, &["@connection:1:10", "division by zero"]),
        (&["table", "so3@lambda=inf"], USAGE, &["@connection:1:8", "`inf` is not a number"]),
        (&["table", "so3@levi-civita"], 1, &["@connection:1:1", "none is given"]),
    ]);
}

#[test]
fn inline_brackets() {
    refuse_commands(&[
        (&["table", "so3", "--basis", "x y", "--bracket", "[x,y]=x"], USAGE, &["not both"]),
        (&["table", "so3", "--bracket", "[x,y]=x"], USAGE, &["not both"]),
        (&["table", "--bracket", "[x,y]=x"], USAGE, &["--basis"]),
        (
            &["table", "--basis", "x y x", "--bracket", ""],
            USAGE,
            &["--basis:1:5", "`x` is named twice"],
        ),
        (&["table", "--basis", "", "--bracket", ""], USAGE, &["the dimension 0 is not"]),
        (
            &["table", "--basis", "x y", "--bracket", "[x,z]=x"],
            USAGE,
            &["--bracket:1:4", "`z` is not a basis vector"],
        ),
        (
            &["table", "--basis", "x y", "--bracket", "[x,y]=x;[y,x]=x"],
            1,
            &["--bracket:1:9", "[x, y] + [y, x] = 2*x"],
        ),
        (
            &["table", "--basis", "x y", "--bracket", "[x,y]=q"],
            USAGE,
            &["--bracket:1:7", "the part q has no basis vector"],
        ),
        (
            &["table", "--basis", "e1 e2", "--bracket", "[e1,e2]=2e1"],
            USAGE,
            &["--bracket:1:9", "between the number and `e1`"],
        ),
        (
            &["table", "--basis", "x y z", "--bracket", "[x,y]=z", "--bracket", "[y,z]=y"],
            1,
            &["[[x,y],z] + [[y,z],x] + [[z,x],y] = -z"],
        ),
    ]);
}

#[test]
fn names_of_files_are_shown_escaped() {
    let name = "a\u{1b}[31m\u{202e}.toml";
    let content = b"basis = ['x']\nbrackets = '[x, q] = x'";
    refuse([Case {
        name: "an escape sequence in the name of a file",
        arguments: &["table", name],
        file: Some((name, content)),
        input: b"",
        status: USAGE,
        says: &["a\\u{1b}[31m\\u{202e}.toml:2:17", "`q`"],
    }]);
    refuse_commands(&[
        (&["table", "b\u{1b}[31m.toml"], USAGE, &["cannot read b\\u{1b}[31m.toml"]),
        (&["verify", "so3", "b\u{1b}[31m.json"], USAGE, &["cannot read b\\u{1b}[31m.json"]),
        (&["table", "so3", "-o", "no/b\u{1b}[31m"], USAGE, &["cannot write no/b\\u{1b}[31m"]),
        (&["list", "\u{1b}[31m"], USAGE, &["`\\u{1b}[31m`"]),
        (&["table", "--b\u{1b}[31m"], USAGE, &["--b\\u{1b}[31m"]),
        (&["b\u{1b}[31m"], USAGE, &["b\\u{1b}[31m"]),
    ]);
}
