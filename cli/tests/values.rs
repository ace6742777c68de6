//! Values of options and settings: signs, integers of any length; families of the catalogue.

use crate::program::stdout;
use tempfile::TempDir;

/// Signs after `*` and `/`, repeated `--set`, and integers of any length.
#[test]
fn values_that_are_read() {
    let folder = TempDir::new().unwrap();
    let metric = |metric: &str, more: &[&str]| {
        let table =
            ["table", "so3@zero", "--show", "metric", "--format", "csv", "--metric", metric];
        stdout(folder.path(), &[&table[..], more].concat())
    };
    let minus_two = metric("diag(-2,-1/2,-1)", &[]);
    assert_eq!(metric("diag(2*-1,1/-2,-1)", &[]), minus_two);
    assert_eq!(metric(&format!("diag(-2,-1/2,{}1)", "-".repeat(99)), &[]), minus_two);
    assert_eq!(metric("diag(2 * - + 1, -2 / --4, -1)", &[]), minus_two);
    let set = metric("diag(a,b,-1)", &["--set", "a=-2", "--set", "b=-1/2"]);
    assert_eq!(set, minus_two);
    for digits in [18, 19, 20, 39, 40, 5000] {
        let huge = "7".repeat(digits);
        for (file, content) in [
            ("a.toml", format!("basis = ['x', 'y']\nstructure_constants = [[1, 2, 2, {huge}]]")),
            (
                "a.json",
                format!("{{\"dimension\": 2, \"structure_constants\": [[1, 2, 2, {huge}]]}}"),
            ),
        ] {
            std::fs::write(folder.path().join(file), content).unwrap();
            let table = ["table", file, "--show", "structure", "--format", "csv"];
            let text = stdout(folder.path(), &table);
            assert!(text.contains(&format!("structure,2,1,2,,{huge}\n")), "{file}: {text}");
        }
    }
}

#[test]
fn affine_algebras_of_any_dimension() {
    let folder = TempDir::new().unwrap();
    for n in 1..4 {
        let name = format!("aff({n})");
        let check = stdout(folder.path(), &["check", &name]);
        assert!(check.contains("jacobi") && !check.contains("FAILS"), "{check}");
        let table = stdout(folder.path(), &["table", &name, "--show", "killing"]);
        assert!(table.contains(&format!("  dimension    {}\n", n * (n + 1))), "{table}");
    }
    // Greek letters that LaTeX has without packages
    let list = stdout(folder.path(), &["list", "--format", "latex"]);
    assert!(list.contains("aff(n)") && list.is_ascii(), "{list}");
}
