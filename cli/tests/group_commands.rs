//! `exp`, `log`, `compose`, `adjoint`, `transport` and `convert`, through the program.

use crate::program::{root, run};

/// The standard output of a command that succeeds.
fn output(arguments: &[&str], input: &str) -> String {
    let outcome = run(root(), arguments, input.as_bytes());
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    outcome.out
}

/// The numbers of the output, without its header.
fn numbers(arguments: &[&str], input: &str) -> Vec<f64> {
    let text = output(arguments, input);
    let begins_head = |line: &&str| line.starts_with(|c: char| c.is_ascii_alphabetic());
    let text: String = text.lines().skip_while(begins_head).flat_map(|line| [line, " "]).collect();
    let apart = |c: char| c.is_whitespace() || ",[]".contains(c);
    let words = text.split(apart).filter(|word| !word.is_empty());
    words.map(|word| word.parse().unwrap_or_else(|_| panic!("{word}"))).collect()
}

fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (a, b) in found.iter().zip(expected) {
        // text output has twelve digits
        assert!((a - b).abs() < 1e-11 * (1.0 + b.abs()), "{found:?} and not {expected:?}");
    }
}

/// The exit status and the message of a command that fails.
fn refusal(arguments: &[&str], input: &str) -> (i32, String) {
    let outcome = run(root(), arguments, input.as_bytes());
    (outcome.status, outcome.err)
}

#[test]
fn a_quarter_turn() {
    let turn = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    near(&numbers(&["exp", "so3", "0,0,pi/2"], ""), &turn);
    near(&numbers(&["exp", "so3", "--degrees", "[0, 0, 90]", "--format", "csv"], ""), &turn);
    near(&numbers(&["log", "so3", "0,-1,0, 1,0,0, 0,0,1", "--degrees"], ""), &[0.0, 0.0, 90.0]);
    // a third of a turn about the diagonal
    let third = std::f64::consts::TAU / 3.0 / 3f64.sqrt();
    near(&numbers(&["compose", "so3", "0,0,pi/2, pi/2,0,0"], ""), &[third; 3]);
}

/// `Ad` of a translation `t` maps `(w, v)` to `(w, v + t x w)`.
#[test]
fn adjoint_of_a_translation() {
    let ad = numbers(&["adjoint", "se3", "0,0,0,1,2,3", "--format", "json"], "");
    let column: Vec<f64> = (0..6).map(|i| ad[6 * i]).collect();
    // (1,2,3) x (1,0,0) = (0,3,-2)
    near(&column, &[1.0, 0.0, 0.0, 0.0, 3.0, -2.0]);
}

/// Every input row gives an output row. Headers and comments are skipped; both notations are read.
#[test]
fn rows_of_standard_input() {
    let input = "x,y,z\n0,0,0\n\n# a remark\n[0, 0, 3.141592653589793]\n-1e-3;0;0\n";
    let back = output(&["exp", "so3", "--format", "csv"], input);
    let vectors = output(&["log", "so3", "--format", "json"], &back);
    let lines: Vec<&str> = vectors.lines().collect();
    assert_eq!(lines.len(), 3);
    assert_eq!(lines[0], "[0,0,0]");
    assert_eq!(lines[1], "[0,0,3.141592653589793]");
    // small angles are accurate up to rounding errors
    let small: f64 =
        lines[2].trim_start_matches('[').split(',').next().unwrap_or("").parse().expect("x");
    assert!((small + 1e-3).abs() < 1e-18 && lines[2].ends_with(",0,0]"), "{}", lines[2]);
}

/// Groups that are given without a name: unipotent matrices, brackets of a nilpotent algebra, ad.
#[test]
fn groups_of_any_algebra() {
    near(
        &numbers(&["exp", "heisenberg3", "1,2,3"], ""),
        &[1.0, 1.0, 4.0, 0.0, 1.0, 2.0, 0.0, 0.0, 1.0],
    );
    near(&numbers(&["compose", "heisenberg3", "1,0,0, 0,1,0"], ""), &[1.0, 1.0, 0.5]);
    // a dilation by 2 about a point of the plane
    near(
        &numbers(&["exp", "hom(2)", &format!("{0},1,{0}", 2f64.ln())], ""),
        &[2.0, 0.0, 1.0 / 2f64.ln(), 0.0, 2.0, 1.0, 0.0, 0.0, 1.0],
    );
    near(
        &numbers(&["log", "hom(2)", "2,0,0, 0,2,3, 0,0,1"], ""),
        &[2f64.ln(), 0.0, 3.0 * 2f64.ln()],
    );
    let (code, message) = refusal(&["log", "hom(1)", "-2,0,0,1"], "");
    assert!(code == 1 && message.contains("the factor -2 of the dilation"), "{message}");
    // groups given by brackets only: elements are columns of coordinates
    let file = "examples/definitions/heisenberg.toml";
    near(&numbers(&["exp", file, "1,2,3"], ""), &[1.0, 2.0, 3.0]);
    // algebras with an additional centre, and a Heisenberg algebra with its own centre
    near(&numbers(&["compose", "so3+R^1", "0,0,1,2, 0,0,1,3"], ""), &[0.0, 0.0, 2.0, 5.0]);
    // brackets only, with a centre and too many derivations to solve for
    let (code, message) =
        refusal(&["exp", "-", "1"], "dimension = 25\nbrackets = '[e1,e2] = e2'\n");
    assert_eq!(code, 1);
    assert!(message.contains("centre") && message.contains("by matrices"), "{message}");
    // one column for each factor, in the order of the sum
    let row = numbers(&["exp", "R^2+so2+heisenberg3", "--degrees", "1,2, 90, 1,2,3"], "");
    near(&row, &[1.0, 2.0, 0.0, -1.0, 1.0, 0.0, 1.0, 1.0, 4.0, 0.0, 1.0, 2.0, 0.0, 0.0, 1.0]);
    let element: Vec<String> = row.iter().map(f64::to_string).collect();
    let back = ["log", "R^2+so2+heisenberg3", "--degrees", &element.join(",")];
    near(&numbers(&back, ""), &[1.0, 2.0, 90.0, 1.0, 2.0, 3.0]);
    let adjoint = numbers(&["adjoint", "se3+se3", "0,0,0,1,2,3, 0,0,0,0,0,0"], "");
    assert_eq!(adjoint.len(), 144);
    assert_eq!(numbers(&["exp", "se_2(3)", "0,0,0,1,2,3,4,5,6"], "").len(), 25);
    let product = ["compose", "so3+heisenberg3", "0,0,1,1,0,0, 0,0,1,0,1,0"];
    near(&numbers(&product, ""), &[0.0, 0.0, 2.0, 1.0, 1.0, 0.5]);
}

/// `compose` of boosts is accurate to all digits. `log` notes how many digits are determined, if
/// rounded entries determine few.
#[test]
fn digits_of_logarithms() {
    for (space, rows) in [
        ("so(2,1)", ["3,0,0,3,0,0", "14,0,0,-13,0,0"]),
        ("so(3,1)", ["0,3,0,0,0,0, 0,3,0,0,0,0", "0,14,0,0,0,0, 0,-13,0,0,0,0"]),
    ] {
        let found = output(&["compose", space, "--format", "csv", rows[0], rows[1]], "");
        let sums: Vec<f64> = found
            .lines()
            .skip(1)
            .flat_map(|line| line.split(','))
            .map(|n| n.parse().expect(n))
            .collect();
        let largest: Vec<f64> = sums
            .chunks(sums.len() / 2)
            .map(|x| x.iter().fold(0.0, |a: f64, b| a.max(b.abs())))
            .collect();
        assert!((largest[0] - 6.0).abs() < 1e-14 && (largest[1] - 1.0).abs() < 1e-14, "{found}");
    }
    let rows = ["1.00000001,0,0,1", "2,0,0,3", "1.00000001,1e-3,0,1"];
    let outcome = run(root(), &["log", "gl(2)", rows[0], rows[1], rows[2]], b"");
    let note =
        "note: entries rounded to floats determine about 7 digits of the logarithm (1 row)\n";
    assert_eq!(outcome.err, note);
    for row in ["2,0,0,3", "1,0,0,1", "1,2,0,1"] {
        assert_eq!(run(root(), &["log", "gl(2)", row], b"").err, "", "{row}");
    }
}

/// For matrix groups too, components along rotation generators are angles in degrees.
#[test]
fn degrees_of_matrix_groups() {
    let quarter = numbers(&["exp", "so(4)", "--degrees", "0,0,0,0,0,90"], "");
    near(&quarter[..6], &[0.0, -1.0, 0.0, 0.0, 1.0, 0.0]);
    let back = numbers(&["log", "sim2", "--degrees", "0,-2,1,2,0,1,0,0,1"], "");
    near(&back[..2], &[90.0, 2f64.ln()]);
    // boosts and the centre of heisenberg(3) are not angles
    let boost = numbers(&["adjoint", "so(2,1)", "--degrees", "1,0,0"], "");
    assert!((boost[4] - 1f64.cosh()).abs() < 1e-11, "{boost:?}");
    let outcome = run(root(), &["exp", "heisenberg(3)", "--degrees", "1,2,3"], b"");
    assert_eq!(outcome.err, "note: --degrees has no effect: no component is an angle\n");
}

#[test]
fn translation_around_a_closed_subgroup() {
    let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    near(&numbers(&["transport", "so3@plus", "--along", "0,0,2*pi"], ""), &identity);
    let half_turn = [-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0];
    near(&numbers(&["transport", "SO3", "--along", "0,0,360", "--degrees"], ""), &half_turn);
    // in two halves, and a vector given on standard input
    let halves = ["transport", "SO3", "--along", "0,0,pi", "--along", "0,0,pi", "-"];
    near(&numbers(&halves, "1,2,3\n"), &[-1.0, -2.0, 3.0]);
    // back along the same arc
    let back = ["transport", "so3@levi-civita;metric=diag(1,2,4)", "--along", "1,2,3", "--along"];
    near(&numbers(&[&back[..], &["-1,-2,-3", "-1,0.5,2"]].concat(), ""), &[-1.0, 0.5, 2.0]);
}

#[test]
fn conversions() {
    let quaternion = numbers(&["convert", "--from", "vector", "--to", "quaternion", "0,0,pi"], "");
    near(&quaternion, &[0.0, 0.0, 0.0, 1.0]);
    let angles = ["convert", "--from", "ZYX", "--to", "matrix", "--degrees", "90,0,0"];
    near(&numbers(&angles, ""), &[0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let locked = ["convert", "--from", "vector", "--to", "ZYX", "--degrees", "0,90,0"];
    let outcome = run(root(), &locked, b"");
    assert_eq!(outcome.out.trim(), "0 90 0");
    assert!(outcome.err.contains("gimbal lock in 1 row:"), "{}", outcome.err);
}

/// Errors of rows give the location. The status is 2 for wrong notation and 1 for a mathematical
/// error.
#[test]
fn what_is_refused() {
    let cases: [(&[&str], &str, i32, &str); 12] = [
        (&["exp", "so3", "1,2"], "", 2, "has 3 numbers, not 2"),
        (&["exp", "so3", "1,2,x"], "", 2, "names are pi and tau"),
        (&["exp", "so3", "1,2,1/0"], "", 2, "divides by zero"),
        (&["exp", "so3", "1,2,1e999"], "", 2, "beyond the range"),
        (&["exp", "so3", "1,2,nan"], "", 2, "not a number"),
        (&["exp", "so3"], "1,2,3\n4,5\n", 2, "<standard input>, line 2"),
        (&["exp", "so3", "1,2,3", "--format", "latex"], "", 2, "text, csv, json"),
        (&["log", "so3", "1,0,0,0,1,0,0,0,2"], "", 1, "R^T R differs from 1"),
        (&["log", "so3", "-1,0,0,0,1,0,0,0,1"], "", 1, "reflection"),
        (&["log", "sl2", "-2,0,0,-0.5"], "", 1, "trace is -2.5"),
        (
            &["convert", "--from", "vector", "--to", "XXY", "1,2,3"],
            "",
            2,
            "choose vector, quaternion",
        ),
        (&["exp", "examples/definitions/sphere.toml", "1,2"], "", 2, "help: give a Lie algebra"),
    ];
    for (arguments, input, code, part) in cases {
        let (found, message) = refusal(arguments, input);
        assert_eq!(found, code, "{arguments:?}: {message}");
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
    // a first line with a number is a row, here an invalid one
    let (code, message) = refusal(&["exp", "so3"], "1,2,x\n1,2,3\n");
    assert_eq!((code, message.contains("names are pi")), (2, true), "{message}");
    let (code, message) = refusal(&["transport", "SO3", "--along", "1e100,1,2", "1,2,3"], "");
    assert_eq!((code, message.contains("rotate too often")), (1, true), "{message}");
    let (code, message) = refusal(&["exp", "sl2", "1,1,800"], "");
    assert_eq!(
        (code, message.contains("row 1, column 1 of the result is inf")),
        (1, true),
        "{message}"
    );
    let outcome = run(root(), &["exp", "so3"], b"1,2,3\n\xff\n");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("cannot read standard input, line 2"), "{}", outcome.err);
    // the rows before the invalid row are written
    let outcome = run(root(), &["log", "so2"], b"0,-1,1,0\nx\n");
    assert_eq!((outcome.status, outcome.out.lines().count()), (2, 1));
}

/// The header of CSV names the columns.
#[test]
fn columns_of_csv_have_names() {
    let head = |arguments: &[&str]| {
        let text = output(&[arguments, &["--format", "csv"]].concat(), "");
        text.lines().next().unwrap().to_string()
    };
    let matrix = |letter: &str| {
        let places = (1..=3).flat_map(|i| (1..=3).map(move |j| format!("{letter}{i}{j}")));
        places.collect::<Vec<_>>().join(",")
    };
    assert_eq!(head(&["exp", "so3", "1,2,3"]), matrix("g"));
    assert_eq!(head(&["adjoint", "so3", "1,2,3"]), matrix("Ad"));
    assert_eq!(head(&["transport", "so3@plus", "--along", "1,2,3"]), matrix("P"));
    assert_eq!(head(&["transport", "so3@plus", "--along", "1,2,3", "1,0,0"]), "u1,u2,u3");
    assert_eq!(head(&["log", "so3", "1,0,0,0,1,0,0,0,1"]), "x1,x2,x3");
    let convert = |to| head(&["convert", "--from", "vector", "--to", to, "1,2,3"]);
    assert_eq!(convert("quaternion"), "w,x,y,z");
    assert_eq!(convert("matrix"), matrix("R"));
    assert_eq!(convert("ZYX"), "angle1,angle2,angle3");
    // from the tenth row on, row and line numbers differ in length
    let large = head(&["exp", "so(10)", &["0"; 45].join(",")]);
    assert!(large.starts_with("g1_1,g1_2,") && large.ends_with(",g10_10"), "{large}");
}

/// Only a line of names is a header, also after a byte-order mark. Missing numbers are an error.
#[test]
fn headers_and_missing_numbers() {
    let expected = output(&["exp", "so3"], "1,2,3\n");
    for header in
        ["x,y,z", "\"x\",\"y\",\"z\"", "x1 x2 x3", "\u{feff}x;y;z", "e1,e2,e3", "v_1 v_2 v_3"]
    {
        assert_eq!(output(&["exp", "so3"], &format!("{header}\n1,2,3\n")), expected, "{header}");
    }
    assert_eq!(output(&["exp", "so3"], "\u{feff}1,2,3\n"), expected);
    for line in ["null,null,null", "NaN,nan,NA", "1d0,2d0,3d0", "1.5f,2f,3f", "\"1\",\"2\",\"3\""] {
        let (code, message) = refusal(&["exp", "so3"], &format!("{line}\n1,2,3\n"));
        assert!(code == 2 && message.contains("line 1"), "{line}: {message}");
    }
    for line in ["1,,2,3", ",1,2,3", "1;,2,3", "[,1,2,3]", "1, ,2,3"] {
        let (code, message) = refusal(&["exp", "so3"], &format!("0,0,0\n{line}\n"));
        assert!(code == 2 && message.contains("a number is missing"), "{line}: {message}");
    }
}

#[test]
fn refused_rows_are_left_out_on_request() {
    let input = "1,2,3\n4,5\n0,0,x\n0,0,0\n";
    let skip = ["exp", "so3", "--format", "json", "--on-error", "skip"];
    let outcome = run(root(), &skip, input.as_bytes());
    let kept = output(&["exp", "so3", "--format", "json"], "1,2,3\n0,0,0\n");
    assert_eq!((outcome.status, &outcome.out), (0, &kept));
    let report: Vec<&str> = outcome.err.lines().collect();
    assert_eq!(
        report[..],
        [
            "note: <standard input>, line 2 is left out: a vector of this algebra of dimension 3 \
             has 3 numbers, not 2",
            "note: <standard input>, line 3 is left out: `x` is not a number: the only names are pi and tau",
            "note: 2 of 4 rows left out",
        ]
    );
    // invalid rows and mathematical errors
    for (arguments, reason) in [
        (&["log", "so3", "1,0,0,0,1,0,0,0,1", "1,0,0,0,1,0,0,0,2"][..], "R^T R differs from 1"),
        (&["compose", "so3", "0,0,0,0,0,0", "1"], "has 6 numbers, not 1"),
        (&["adjoint", "so3", "0,0,0", "nan,0,0"], "not a number"),
        (&["exp", "sl2", "0,0,0", "1,1,800"], "of the result is inf"),
        (&["transport", "so3@plus", "--along", "0,0,0", "0,0,0", "1,2"], "has 3 numbers, not 2"),
        (
            &["transport", "sl2@plus", "--along", "9,9,0", "1,-1,1", "1,-1,-1"],
            "the arcs are too long",
        ),
        (
            &["convert", "--from", "quaternion", "--to", "vector", "1,0,0,0", "0,0,0,0"],
            "is zero or not finite",
        ),
    ] {
        let skipped = [arguments, &["--on-error", "skip"]].concat();
        let outcome = run(root(), &skipped, b"");
        let report = &outcome.err;
        assert_eq!(outcome.status, 0, "{arguments:?}: {report}");
        assert!(report.contains("note: row 2 is left out: "), "{arguments:?}: {report}");
        assert!(report.contains(reason), "{arguments:?}: {report}");
        assert!(report.ends_with("note: 1 of 2 rows left out\n"), "{arguments:?}: {report}");
        let alone = output(&arguments[..arguments.len() - 1], "");
        assert_eq!(outcome.out, alone, "{arguments:?}");
        // by default the run stops at the invalid row
        for stop in [&[][..], &["--on-error", "stop"]] {
            let (code, message) = refusal(&[arguments, stop].concat(), "");
            assert!(code > 0 && message.contains(reason), "{arguments:?}: {message}");
        }
    }
}

/// A header of the input names the columns in any order; other names are errors.
#[test]
fn heads_order_the_columns_of_input() {
    let convert = |from: &str, input: &str| {
        output(&["convert", "--from", from, "--to", "vector", "--degrees"], input)
    };
    let turn = convert("quaternion", "0.7071068,0,0,0.7071068\n");
    for input in [
        "qx,qy,qz,qw\n0,0,0.7071068,0.7071068\n",
        "z w x y\n0.7071068 0.7071068 0 0\n",
        "\"W\";\"X\";\"Y\";\"Z\"\n0.7071068;0;0;0.7071068\n",
    ] {
        assert_eq!(convert("quaternion", input), turn, "{input}");
    }
    let angles = convert("ZYX", "10,20,30\n");
    assert_eq!(convert("ZYX", "roll,pitch,yaw\n30,20,10\n"), angles);
    assert_eq!(convert("ZYX", "angle3,angle1,angle2\n30,10,20\n"), angles);
    assert_eq!(convert("xyz", "yaw,roll,pitch\n10,30,20\n"), convert("xyz", "30,20,10\n"));
    let order = [
        "convert",
        "--from",
        "quaternion",
        "--to",
        "quaternion",
        "--order",
        "xyzw",
        "--format",
        "csv",
    ];
    assert_eq!(output(&order, "0,0,1,0\n"), "x,y,z,w\n0,0,1,0\n");
    assert_eq!(output(&order, "w,x,y,z\n0,0,0,1\n"), "x,y,z,w\n0,0,1,0\n");
    // output with a header is read back, with its columns in reverse order too
    for (space, vector) in
        [("so3", "0.1,0.2,0.3"), ("se(3)", "0.1,0.2,0.3,1,2,3"), ("so3+so2", "0.1,0.2,0.3,0.4")]
    {
        let written = output(&["exp", space, "--format", "csv", vector], "");
        let reversed = |line: &str| line.split(',').rev().collect::<Vec<_>>().join(",") + "\n";
        let reversed: String = written.lines().map(reversed).collect();
        let log = |input: &str| output(&["log", space, "--format", "csv"], input);
        assert_eq!(log(&reversed), log(&written), "{space}");
    }
    for (arguments, head, says) in [
        (
            &["convert", "--from", "quaternion", "--to", "vector"][..],
            "q0,q1,q2,q3",
            "the columns q0, q1, q2, q3 are not a quaternion",
        ),
        (
            &["convert", "--from", "quaternion", "--to", "vector"],
            "t,x,y,z",
            "name the columns w, x, y, z; or qw, qx, qy, qz",
        ),
        (
            &["convert", "--from", "ZXZ", "--to", "vector"],
            "roll,pitch,yaw",
            "are not a triple of Euler angles",
        ),
        (&["exp", "so3"], "a,b,c", "the columns a, b, c are not a vector"),
        (&["log", "so2"], "g11,g12,g21,g21", "are not an element"),
    ] {
        let outcome = run(root(), arguments, format!("{head}\n0,0,0,0\n").as_bytes());
        assert!(outcome.status == 2 && outcome.err.contains(says), "{head}: {}", outcome.err);
    }
}

/// Elements rounded to 3 to 8 digits are restored on all groups; without `--restore` they are
/// errors.
#[test]
fn rounded_elements_are_restored() {
    let groups = [
        ("so2", 1),
        ("so3", 3),
        ("so(4)", 6),
        ("so(5)", 10),
        ("se(2)", 3),
        ("se(3)", 6),
        ("sim(3)", 7),
        ("sl2", 3),
        ("sl(3)", 8),
        ("gl(2)", 4),
        ("su(2)", 3),
        ("su(3)", 8),
        ("so(2,1)", 3),
        ("so(3,1)", 6),
        ("heisenberg(3)", 3),
        ("aff(2)", 6),
        ("so3+so2", 4),
        ("so3+R^2", 5),
    ];
    for (group, n) in groups {
        let row = |k: usize| {
            let entry = |i: usize| (0.7 * ((3 * k + i + 1) as f64 * 2.3).sin()).to_string();
            (0..n).map(entry).collect::<Vec<_>>().join(",")
        };
        let vectors: Vec<String> = (0..3).map(row).collect();
        let numbers = |text: &str| -> Vec<f64> {
            text.lines()
                .skip(1)
                .flat_map(|line| line.split(','))
                .map(|x| x.parse().unwrap())
                .collect()
        };
        let exp = output(&["exp", group, "--format", "csv"], &(vectors.join("\n") + "\n"));
        let exact = numbers(&format!("head\n{}", vectors.join("\n")));
        for digits in 3..=8usize {
            let round = |x: &str| format!("{:.digits$}", x.parse::<f64>().unwrap());
            let line = |line: &str| line.split(',').map(round).collect::<Vec<_>>().join(",") + "\n";
            let rounded: String = exp.lines().skip(1).map(line).collect();
            let log = ["log", group, "--format", "csv", "--restore"];
            let outcome = run(root(), &log, rounded.as_bytes());
            assert_eq!(outcome.status, 0, "{group} {digits}: {}", outcome.err);
            assert!(outcome.err.contains("3 rows restored"), "{}", outcome.err);
            let close = |found: &[f64]| {
                let off = found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < 20.0 * 0.1f64.powi(digits as i32), "{group} {digits}: {off:e}");
            };
            close(&numbers(&outcome.out));
            // one tolerance for all groups: 1e-6
            let strict = run(root(), &log[..4], rounded.as_bytes());
            match strict.status {
                0 => close(&numbers(&strict.out)),
                _ => assert!(
                    digits < 7 && strict.err.contains("--restore"),
                    "{group} {digits}: {}",
                    strict.err
                ),
            }
        }
    }
    // a reflection, and a matrix far from the group
    for element in ["-1,0,0,0,1,0,0,0,1", "1,0.5,0,0,1,0,0,0,1"] {
        let outcome = run(root(), &["log", "so3", "--restore", element], b"");
        assert!(outcome.status == 1 && outcome.err.contains("nearest element"), "{}", outcome.err);
    }
    let half_turn = "0.7071,0,0.7071,0,-1,0,0.7071,0,-0.7071";
    let convert = [
        "convert",
        "--restore",
        "--from",
        "matrix",
        "--to",
        "vector",
        "--format",
        "csv",
        half_turn,
    ];
    let found = output(&convert, "");
    let angle = found
        .lines()
        .nth(1)
        .unwrap()
        .split(',')
        .map(|x| x.parse::<f64>().unwrap().powi(2))
        .sum::<f64>();
    assert!((angle.sqrt() - std::f64::consts::PI).abs() < 1e-9, "{found}");
}

/// Logarithms near half a turn are accurate up to the rounding error of the angle.
#[test]
fn logarithms_near_half_a_turn() {
    type Vector = fn(f64) -> Vec<f64>;
    let groups: [(&str, Vector); 5] = [
        ("sim(3)", |t| vec![t / 3f64.sqrt(), t / 3f64.sqrt(), t / 3f64.sqrt(), 0.5, 1.0, 1.0, 1.0]),
        ("so(4)", |t| vec![t, 0.0, 0.0, 0.0, 0.0, 0.0]),
        ("so(5)", |t| vec![t, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1]),
        ("so(3,1)", |t| vec![t, 0.0, 0.0, 0.3, 0.0, 0.0]),
        ("su(3)", |t| vec![t, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    for (group, vector) in groups {
        for power in 1..=12 {
            let x = vector(std::f64::consts::PI - 0.1f64.powi(power));
            let row = x.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
            let g = output(&["exp", group, "--format", "csv", &row], "");
            let log = output(&["log", group, "--format", "csv"], &g);
            let found = log.lines().nth(1).unwrap().split(',').map(|x| x.parse::<f64>().unwrap());
            let off = found.zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-13, "{group} {power}: {off:e}");
        }
    }
    let g = output(&["exp", "gl(2)", "--format", "csv", "0.1,3.14159265,-3.14159265,0.1"], "");
    let (code, message) = refusal(&["log", "gl(2)"], &g);
    assert!(code == 1 && message.contains("too near pi"), "{message}");
}

/// The complex classical groups act by their complex matrices, not by the adjoint representation.
#[test]
fn complex_groups() {
    // exp(i pi/2 H), H = diag(1, -1): diag(i, -i) as a real matrix
    let [zero, one] = [0.0, 1.0];
    let turn = [
        [zero, zero, -one, zero],
        [zero, zero, zero, one],
        [one, zero, zero, zero],
        [zero, -one, zero, zero],
    ]
    .concat();
    near(&numbers(&["exp", "sl(2,C)", "0,0,0,0,0,pi/2"], ""), &turn);
    // `exp(2 pi i H/2) = -1`, which the adjoint representation does not tell from 1
    let minus: Vec<f64> = (0..16).map(|at| if at % 5 == 0 { -1.0 } else { 0.0 }).collect();
    near(&numbers(&["exp", "sl(2,C)", "0,0,0,0,0,pi"], ""), &minus);
    assert_eq!(numbers(&["exp", "sp(4,C)", &["0"; 20].join(",")], "").len(), 64);
}
