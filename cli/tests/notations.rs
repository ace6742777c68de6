//! Common notations in definitions, and names in other scripts.

use crate::program::{Outcome, run};
use tempfile::TempDir;

/// The outcome of `affinor table` for a definition, with these options.
fn table(definition: &str, options: &[&str]) -> Outcome {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("a.toml"), definition).unwrap();
    run(folder.path(), &[&["table", "a.toml"], options].concat(), b"")
}

/// The output for a definition that is valid.
fn accepted(definition: &str, options: &[&str]) -> String {
    let Outcome { status, out, err } = table(definition, options);
    assert_eq!(status, 0, "{definition}\n{err}");
    out
}

/// A chart with this component of its metric.
fn chart(component: &str) -> String {
    format!(
        "name = 'a'\nparameters = ['M']\n[chart]\ncoordinates = ['r', 'theta']\npositive = ['r']\n\
         [metric]\ncomponents = [[\"{component}\", 0], [0, 1]]"
    )
}

#[test]
fn notations_have_the_meaning_of_plain_expressions() {
    for (notation, plain) in [
        ("r**2", "r^2"),
        ("r²", "r^2"),
        ("M·r − 2×r⁻¹", "M*r - 2*r^-1"),
        ("ln(r)", "log(r)"),
        ("sec(theta)^2", "1/cos(theta)^2"),
        ("csc(theta)", "1/sin(theta)"),
        ("sech(r) + csch(r) + coth(r)", "1/cosh(r) + 1/sinh(r) + cosh(r)/sinh(r)"),
        ("sin^2(theta)", "sin(theta)^2"),
        ("cosh²(r)*cos**-2(theta)", "cosh(r)^2*cos(theta)^-2"),
        ("r^(4/2) + M^(1+1)", "r^2 + M^2"),
    ] {
        let options = ["--show", "metric,affinities"];
        assert_eq!(
            accepted(&chart(notation), &options),
            accepted(&chart(plain), &options),
            "{notation}"
        );
    }
}

#[test]
fn a_missing_operator_is_named_with_the_text_to_write() {
    for (component, place, message) in [
        ("r theta", "7:19", "`*` is missing: write `r*theta`"),
        ("2M/r", "7:18", "`*` is missing: write `2*M/r`"),
        ("r 2", "7:19", "`*` is missing: write `r*2`"),
        ("(1 - 2*M)r", "7:26", "`*` is missing: write `(1 - 2*M)*r`"),
        ("sin theta", "7:21", "parentheses are missing: write `sin(theta)`"),
        ("sin^-1(theta)", "7:17", "may be the reciprocal or the inverse function"),
        ("abs(r)", "7:17", "there are sin, cos, tan"),
    ] {
        let Outcome { status, err, .. } = table(&chart(component), &[]);
        assert_eq!(status, 2, "{component}: {err}");
        assert!(err.contains(message), "{component}: {err}");
        assert!(err.contains(&format!("a.toml:{place}")), "{component}: {err}");
        assert!(!err.contains("declare a parameter"), "{component}: {err}");
    }
    let Outcome { err, .. } = table(&chart("r^2*alpha"), &[]);
    assert!(err.contains("declare a parameter: parameters = [\"alpha\"]"), "{err}");
}

/// The function `d` has the derivative `d_x(x,y,z)`, next to the field `d_x`.
#[test]
fn a_function_may_be_named_as_the_fields() {
    let text = |f: &str| {
        format!(
            "[chart]\ncoordinates = ['x', 'y']\nfunctions = ['{f}(x,y)']\n\
             [metric]\ncomponents = 'diag(1, {f}(x,y)^2 + {f}_x(x,y))'\n\
             [frame]\nu = 'd_x'\nv = '{f}_y(x, y)*d_y'"
        )
    };
    let options = ["--show", "structure,ricci", "--format", "csv"];
    let renamed = accepted(&text("h"), &options).replace("h(", "d(").replace("h_", "d_");
    assert_eq!(accepted(&text("d"), &options), renamed);
}

/// Greek names give the same table as Latin names with the same order.
#[test]
fn names_have_letters_of_any_script() {
    let text = |[a, b, c]: [&str; 3]| {
        format!(
            "name = 'a'\nparameters = ['{a}']\n[chart]\ncoordinates = ['{b}', '{c}']\n\
             [metric]\ncomponents = 'diag({a}*{b}, {b}^2/({c} - {a}))'"
        )
    };
    let [greek, latin] = [["Θ", "α", "ω_1"], ["a", "b", "c"]];
    let options = ["--show", "affinities,ricci", "--format", "csv"];
    let renamed = greek
        .iter()
        .zip(latin)
        .fold(accepted(&text(greek), &options), |table, (g, l)| table.replace(g, l));
    assert_eq!(renamed, accepted(&text(latin), &options));
    let brackets = "basis = ['é', 'φ₁']\nbrackets = '[é, φ₁] = Ω*é'\nparameters = ['Ω']";
    let table = accepted(brackets, &["--show", "structure", "--set", "Ω=3"]);
    assert!(table.contains("é") && table.contains("φ₁") && table.contains('3'), "{table}");
    // the signs of ohm and micro
    let signs = brackets.replace("Ω", "\u{2126}").replace("φ₁", "\u{b5}");
    let table = accepted(&signs, &["--show", "structure", "--set", "\u{2126}=3"]);
    assert!(table.contains("\u{3bc}"), "{table}");
}
