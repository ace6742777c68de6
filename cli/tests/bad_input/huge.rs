//! Input beyond the stated limits: refused, without flooding the terminal.

use crate::bad_input::case::{Case, USAGE, refuse};

fn refuse_file(name: &str, file: &str, content: &str, says: &[&str]) {
    refuse([Case {
        name,
        arguments: &["table", file],
        file: Some((file, content.as_bytes())),
        input: b"",
        status: USAGE,
        says,
    }]);
}

/// A right side over the basis `e1, e2`.
fn right_side(expression: &str) -> String {
    format!("dimension = 2\nparameters = ['x']\nbrackets = '[e1, e2] = {expression}*e1'")
}

#[test]
fn numbers() {
    let digits = "7".repeat(1_000_000);
    let many = &["a.toml:3:24", "a number has at most 10000 digits"];
    refuse_file("10^6 digits", "a.toml", &right_side(&digits), many);
    let decimals = format!("0.{digits}");
    refuse_file("10^6 decimals", "a.toml", &right_side(&decimals), many);
    let fraction = format!("1/{digits}");
    let says = &["a.toml:3:26", "a number has at most 10000 digits"];
    refuse_file("10^6 digits below", "a.toml", &right_side(&fraction), says);
    let toml = format!("dimension = {digits}\nbrackets = ''");
    refuse_file("a dimension in TOML", "a.toml", &toml, &["a.toml:1:13", "overflow"]);
    let json = format!("{{\"dimension\": {digits}}}");
    refuse_file("a dimension in JSON", "a.json", &json, &["a.json:1:", "number out of range"]);
    let product = vec!["9".repeat(9999); 40].join("*");
    let says = &["a.toml:3:24", "grows beyond the limit"];
    refuse_file("a product", "a.toml", &right_side(&format!("({product})")), says);
}

#[test]
fn texts() {
    let name = "q".repeat(1_000_000);
    refuse_file(
        "a name",
        "a.toml",
        &right_side(&name),
        &["a.toml:3:24", "`qqqq", "...` is neither"],
    );
    let says = &["a.toml:3:24", "is not a name", "qqqq..."];
    let basis = format!("dimension = 2\nbrackets = ''\nparameters = [        '{name}']");
    refuse_file("a parameter", "a.toml", &basis, says);
    let key = format!("dimension = 2\n{name} = 3");
    refuse_file("a key", "a.toml", &key, &["a.toml:2:1", "unknown key", "characters in all"]);
    let line = format!("dimension = 2\nname = '{name}'\nbrackets = '[e1, e2] = 1/0*e1'");
    refuse_file("a name before the error", "a.toml", &line, &["a.toml:3:26", "division by zero"]);
    let comment = format!("{{\"name\": \"{name}\", \"dimension\": 0}}");
    refuse_file("one line of JSON", "a.json", &comment, &["a.json:1:", "the dimension 0"]);
    let block: String = (0..1000).map(|i| format!("[{i}, 1],\n")).collect();
    let rows = format!("dimension = 2\nbrackets = ''\nmetric = '''[\n{block}[0, 0]]'''");
    refuse_file("a thousand rows", "a.toml", &rows, &["a.toml:3:13", "1001 rows of 2 entries"]);
}

#[test]
fn nesting() {
    const DEEP: usize = 100_000;
    let nested = |open: &str, close: &str| open.repeat(DEEP) + "1" + &close.repeat(DEEP);
    let parentheses = right_side(&nested("(", ")"));
    let says = &["a.toml:3:124", "more than 100 nested parentheses"];
    refuse_file("parentheses", "a.toml", &parentheses, says);
    let open = right_side(&"(".repeat(DEEP));
    refuse_file("parentheses left open", "a.toml", &open, says);
    let brackets = right_side(&nested("[", "]"));
    refuse_file("brackets", "a.toml", &brackets, &["a.toml:3:24", "`[` is not expected here"]);
    let arrays = format!("dimension = 2\nbrackets = ''\nmetric = {}", nested("[", "]"));
    refuse_file("arrays in TOML", "a.toml", &arrays, &["a.toml:3:", "recurs"]);
    let tables = format!("{}b = 1", "a.".repeat(DEEP));
    refuse_file("tables in TOML", "a.toml", &tables, &["a.toml", "recurs"]);
    let arrays = format!("{{\"metric\": {}}}", nested("[", "]"));
    refuse_file("arrays in JSON", "a.json", &arrays, &["a.json:1:", "recursion"]);
    let objects = format!("{{\"name\": {}", "{\"name\": ".repeat(DEEP));
    refuse_file("objects in JSON", "a.json", &objects, &["a.json:1:", "recursion"]);
    let rows = format!("dimension = 1\nbrackets = ''\nmetric = '{}'", nested("[", "]"));
    refuse_file("a metric in words", "a.toml", &rows, &["a.toml:3:", "`[` is not expected here"]);
    let diag = format!("dimension = 1\nbrackets = ''\nmetric = 'diag({})'", nested("(", ")"));
    refuse_file("parentheses in diag", "a.toml", &diag, &["more than 100 nested parentheses"]);
}

#[test]
fn operators() {
    let signs = right_side(&("-".repeat(1_000_000) + "q"));
    refuse_file("10^6 signs", "a.toml", &signs, &["a.toml:3:1000024", "`q` is neither"]);
    let terms = right_side(&("1+".repeat(100_000) + "1/0"));
    refuse_file("10^5 terms", "a.toml", &terms, &["a.toml:3:200026", "division by zero"]);
    let factors = right_side(&("x*".repeat(1_000_000) + "1"));
    refuse_file("10^6 factors", "a.toml", &factors, &["a.toml:3:24", "grows beyond the limit"]);
    let spaces = right_side(&(" ".repeat(1_000_000) + "1/0"));
    refuse_file("10^6 spaces", "a.toml", &spaces, &["a.toml:3:1000026", "division by zero"]);
}

#[test]
fn names_on_the_command_line() {
    let (sum, parentheses) = (vec!["so3"; 10_000].join("+"), "so(".repeat(30_000));
    let (digits, word) = (format!("so({})", "9".repeat(100_000)), "x".repeat(100_000));
    let metric = format!("diag({})", "1,".repeat(50_000));
    let set = format!("J11={}", "(".repeat(100_000));
    let table: [(&str, &[&str], &[&str]); 6] = [
        ("a sum", &["table", &sum], &["not between 1 and 2048"]),
        ("parentheses", &["table", &parentheses], &["SPACE:1:3", "is not closed"]),
        ("digits", &["table", &digits], &["SPACE:1:1", "exceeds the limit"]),
        ("a word", &["table", &word], &["SPACE:1:1", "there is no algebra named"]),
        ("a metric", &["table", "so3", "--metric", &metric], &["--metric:1:1", "50001 entries"]),
        ("a setting", &["table", "M3", "--set", &set], &["--set:1:105", "nested parentheses"]),
    ];
    refuse(table.map(|(name, arguments, says)| Case {
        name,
        arguments,
        file: None,
        input: b"",
        status: USAGE,
        says,
    }));
}

#[test]
fn settings_that_explode() {
    let content = "dimension = 2\nparameters = ['x']\nbrackets = '[e1, e2] = x^500*e1'";
    let numbers = format!("x={}", "9".repeat(9999));
    for setting in ["x=a+b+c+d", "x=a+1/b+1/c", numbers.as_str()] {
        refuse([Case {
            name: setting,
            arguments: &["table", "a.toml", "--set", setting],
            file: Some(("a.toml", content.as_bytes())),
            input: b"",
            status: USAGE,
            says: &["--set:1:1", "setting parameters in x^500 makes it too large"],
        }]);
    }
}
