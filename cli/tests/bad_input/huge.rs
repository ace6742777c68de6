//! Input beyond the stated limits: short error messages.

use crate::bad_input::case::{commands, definitions};

/// A right side over the basis `e1, e2`.
fn right_side(expression: &str) -> String {
    format!("dimension = 2\nparameters = ['x']\nbrackets = '[e1, e2] = {expression}*e1'")
}

#[test]
fn numbers() {
    let digits = "7".repeat(1_000_000);
    let product = vec!["9".repeat(9999); 40].join("*");
    definitions("a.toml", right_side).usage(&[
        (&digits, &["a.toml:3:24", "a number can have at most 10000 digits"]),
        (&format!("0.{digits}"), &["a.toml:3:24", "a number can have at most 10000 digits"]),
        (&format!("1/{digits}"), &["a.toml:3:26", "a number can have at most 10000 digits"]),
        (&format!("({product})"), &["a.toml:3:24", "grows beyond the limit"]),
    ]);
    let toml = format!("dimension = {digits}\nbrackets = ''");
    definitions("a.toml", str::to_string).usage(&[(&toml, &["a.toml:1:13", "exceeds 64 bits"])]);
    let json = format!("{{\"dimension\": {digits}}}");
    let decimal = "{\"dimension\": 2, \"brackets\": \"\", \"metric\": [[1e999, 0], [0, 1]]}";
    definitions("a.json", str::to_string).usage(&[
        (&json, &["a.json:1:15", "exceeds 64 bits"]),
        (decimal, &["a.json:1:46", "number out of range"]),
    ]);
}

#[test]
fn texts() {
    let name = "q".repeat(1_000_000);
    definitions("a.toml", right_side)
        .usage(&[(&name, &["a.toml:3:24", "`qqqq", "...` is neither"])]);
    let basis = format!("brackets = ''\nparameters = [        '{name}']");
    let key = format!("{name} = 3");
    let line = format!("name = '{name}'\nbrackets = '[e1, e2] = 1/0*e1'");
    let block: String = (0..1000).map(|i| format!("[{i}, 1],\n")).collect();
    let rows = format!("brackets = ''\nmetric = '''[\n{block}[0, 0]]'''");
    definitions("a.toml", |keys| format!("dimension = 2\n{keys}")).usage(&[
        (&basis, &["a.toml:3:24", "is not a name", "qqqq..."]),
        (&key, &["a.toml:2:1", "unknown key", "characters in all"]),
        (&line, &["a.toml:3:26", "division by zero"]),
        (&rows, &["a.toml:3:13", "1001 rows of 2 entries"]),
    ]);
    let comment = format!("{{\"name\": \"{name}\", \"dimension\": 0}}");
    definitions("a.json", str::to_string).usage(&[(&comment, &["a.json:1:", "the dimension 0"])]);
}

#[test]
fn nesting() {
    const DEEP: usize = 100_000;
    let nested = |open: &str, close: &str| open.repeat(DEEP) + "1" + &close.repeat(DEEP);
    definitions("a.toml", right_side).usage(&[
        (&nested("(", ")"), &["a.toml:3:124", "more than 100 nested parentheses"]),
        (&"(".repeat(DEEP), &["a.toml:3:124", "more than 100 nested parentheses"]),
        (&nested("[", "]"), &["a.toml:3:24", "`[` is not expected here"]),
    ]);
    let metric = |metric: &str| format!("dimension = 1\nbrackets = ''\nmetric = {metric}");
    definitions("a.toml", metric).usage(&[
        (&nested("[", "]"), &["a.toml:3:", "recurs"]),
        (&format!("'{}'", nested("[", "]")), &["a.toml:3:", "`[` is not expected here"]),
        (&format!("'diag({})'", nested("(", ")")), &["more than 100 nested parentheses"]),
    ]);
    let tables = format!("{}b = 1", "a.".repeat(DEEP));
    definitions("a.toml", str::to_string).usage(&[(&tables, &["a.toml", "recurs"])]);
    definitions("a.json", str::to_string).usage(&[
        (&format!("{{\"metric\": {}}}", nested("[", "]")), &["a.json:1:", "recursion"]),
        (&format!("{{\"name\": {}", "{\"name\": ".repeat(DEEP)), &["a.json:1:", "recursion"]),
    ]);
}

#[test]
fn operators() {
    definitions("a.toml", right_side).usage(&[
        (&("-".repeat(100) + "q"), &["a.toml:3:124", "`q` is neither"]),
        (&"-".repeat(1_000_000), &["a.toml:3:124", "more than 100 signs in a row"]),
        (&("1+".repeat(100_000) + "1/0"), &["a.toml:3:200026", "division by zero"]),
        (&("x*".repeat(1_000_000) + "1"), &["a.toml:3:24", "grows beyond the limit"]),
        (&(" ".repeat(1_000_000) + "1/0"), &["a.toml:3:1000026", "division by zero"]),
    ]);
}

#[test]
fn names_on_the_command_line() {
    let (sum, parentheses) = (vec!["so3"; 10_000].join("+"), "so(".repeat(30_000));
    let (digits, word) = (format!("so({})", "9".repeat(100_000)), "x".repeat(100_000));
    let metric = format!("diag({})", "1,".repeat(50_000));
    let set = format!("J11={}", "(".repeat(100_000));
    commands(&["table"]).usage(&[
        (&sum, &["not between 1 and 2048"]),
        (&parentheses, &["SPACE:1:3", "is not closed"]),
        (&digits, &["SPACE:1:1", "exceeds the limit"]),
        (&word, &["SPACE:1:1", "there is no algebra named"]),
    ]);
    commands(&["table", "so3", "--metric"]).usage(&[(&metric, &["--metric:1:1", "50001 entries"])]);
    commands(&["table", "M3", "--set"]).usage(&[(&set, &["--set:1:105", "nested parentheses"])]);
}

#[test]
fn settings_that_explode() {
    let content = "dimension = 2\nparameters = ['x']\nbrackets = '[e1, e2] = x^500*e1'";
    let numbers = format!("x={}", "9".repeat(9999));
    let says = &["--set:1:1", "x^500 becomes too large when the parameters are set"];
    commands(&["table", "a.toml", "--set"]).beside("a.toml", content).usage(&[
        ("x=a+b+c+d", says),
        ("x=a+1/b+1/c", says),
        (&numbers, says),
    ]);
}
