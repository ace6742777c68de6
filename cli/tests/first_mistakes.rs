//! Inputs of a newcomer.

use crate::program::run;
use std::fs;
use tempfile::TempDir;

/// Wrong inputs of a newcomer, each with what to write instead.
#[test]
fn a_wrong_file_or_name_is_told_what_it_is() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("rows.csv"), "t,R11\n0,1\n").unwrap();
    fs::write(folder.path().join("problem.toml"), "space = \"so3\"\n").unwrap();
    fs::write(folder.path().join("names.toml"), "basis = \"x y\"\nbrackets = 3\n").unwrap();
    for (arguments, message) in [
        (
            &["plot", "attitude", "rows.csv", "-o", "a.svg"][..],
            "rows.csv contains rows, not a problem",
        ),
        (&["simulate", "rows.csv"], "--rows rows.csv"),
        (&["table", "problem.toml"], "use `affinor simulate`"),
        (&["table", "so3", "--show", "rici"], "did you mean ricci?"),
        (&["table", "so3", "--show", "Torsion"], "did you mean torsion?"),
        (&["table", "names.toml"], "expected a list"),
    ] {
        let outcome = run(folder.path(), arguments, b"");
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.err);
        assert!(outcome.err.contains(message), "{arguments:?}: {}", outcome.err);
    }
}

/// A list as metric is a diagonal.
#[test]
fn a_metric_may_be_the_list_of_its_diagonal() {
    let folder = TempDir::new().unwrap();
    let table = |metric: &str| {
        let text = format!(
            "basis = ['x', 'y']\nbrackets = '[x,y]=y'\nparameters = ['a']\nmetric = {metric}\n"
        );
        fs::write(folder.path().join("a.toml"), text).unwrap();
        run(folder.path(), &["table", "a.toml", "--show", "metric,ricci"], b"")
    };
    let list = table("[2, \"a\"]");
    assert_eq!((list.status, &list.out), (0, &table("\"diag(2, a)\"").out), "{}", list.err);
    assert!(table("[2, 3]").out.contains("g_22 = 3"));
    for (metric, message) in [
        ("[1, 2, 3]", "the diagonal of the metric has 3 entries, but the dimension is 2"),
        ("[1, [2]]", "the metric mixes rows and single entries"),
    ] {
        let outcome = table(metric);
        assert!(outcome.status == 2 && outcome.err.contains(message), "{}", outcome.err);
    }
}
