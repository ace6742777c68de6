//! Files, formats, notes and the conservation summary of a run.

use super::{TOP, done, folder, refused, simulate};
use crate::program::root;
use std::fs;
use std::path::Path;

/// The rows of an incomplete run are also written to a pipe.
#[test]
fn part_of_a_run_goes_to_a_pipe() {
    let folder = folder(&TOP.replace("-0.001*Omega1", "sqrt(3 - t)"));
    let output = simulate(folder.path()).args(["-o", "/dev/stdout"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(output.stdout.iter().filter(|byte| **byte == b'\n').count(), 14);
}

#[test]
fn a_full_disk_is_told() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = folder(&TOP.replace("end = 400", "end = 1"));
    let message = refused(simulate(folder.path()).args(["-o", "/dev/full"]), 2);
    assert!(message.contains("cannot write /dev/full"), "{message}");
}

/// All formats contain the same numbers.
#[test]
fn formats_agree() {
    let folder = folder(&TOP.replace("end = 400", "end = 20"));
    let folder = folder.path();
    done(simulate(folder).args(["-o", "rows.csv"]));
    done(simulate(folder).args(["-o", "rows.json"]));
    let text = fs::read_to_string(folder.join("rows.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|value| value.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 81);
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.join("rows.json")).unwrap()).unwrap();
    assert_eq!(json["schema"], "affinor.run/1");
    assert_eq!(serde_json::from_value::<Vec<String>>(json["columns"].clone()).unwrap(), names);
    assert_eq!(serde_json::from_value::<Vec<Vec<f64>>>(json["rows"].clone()).unwrap(), rows);
    #[cfg(feature = "parquet")]
    {
        use parquet::file::reader::{FileReader, SerializedFileReader};
        done(simulate(folder).args(["-o", "rows.parquet"]));
        let file = fs::File::open(folder.join("rows.parquet")).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let mut count = 0;
        for (row, expected) in reader.get_row_iter(None).unwrap().zip(&rows) {
            let row = row.unwrap();
            for (k, (name, field)) in row.get_column_iter().enumerate() {
                assert_eq!(name, names[k]);
                assert_eq!(*field, parquet::record::Field::Double(expected[k]));
            }
            count += 1;
        }
        assert_eq!(count, rows.len());
    }
}

/// Without the feature, Parquet output is an error before the run, by format name or by file
/// extension.
#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_needs_a_build_with_it() {
    let folder = folder(&TOP.replace("end = 400", "end = 1e6"));
    let folder = folder.path();
    for options in [["-o", "rows.parquet"], ["--format", "parquet"], ["-o", "rows.PARQUET"]] {
        let message = refused(simulate(folder).args(options), 2);
        assert!(message.contains("built without the feature `parquet`"), "{message}");
        assert!(message.contains("cargo install --path cli --features parquet"), "{message}");
        assert_eq!(fs::read_dir(folder).unwrap().count(), 1, "{options:?}");
    }
    // the file extension is ignored if the format is given
    fs::write(folder.join("top.toml"), TOP.replace("end = 400", "end = 1")).unwrap();
    done(simulate(folder).args(["-o", "rows.parquet", "--format", "csv"]));
}

/// An output file that cannot be written is an error before the run, so that no rows are lost.
#[test]
fn places_are_looked_at_first() {
    let folder = folder(&TOP.replace("end = 400", "end = 1e6"));
    let folder = folder.path();
    let cases = [
        (&["-o", "top.toml"][..], "top.toml is the input"),
        (&["-o", "none/rows.csv"], "cannot write none/rows.csv"),
        (&["-o", "."], "cannot write ."),
        (&["--ensemble", "-o", "rows.csv", "--checkpoint", "./rows.csv"], "need different files"),
        (&["--ensemble", "-o", "c.rows", "--checkpoint", "c"], "need different files"),
    ];
    for (options, expected) in cases {
        let message = refused(simulate(folder).args(options), 2);
        assert!(message.contains(expected), "{message}");
        let left: Vec<_> = fs::read_dir(folder).unwrap().collect();
        assert_eq!(left.len(), 1, "{options:?}: {left:?}");
    }
}

/// An ensemble prints the notes of its first member once.
#[test]
fn an_ensemble_says_its_method_and_notes() {
    let problem = TOP.replace("diag(1, 2, 3)", "diag(1, 2, -3)").replace("end = 400", "end = 0.5");
    let folder = folder(&problem);
    for (options, whose) in [(&[][..], ""), (&["--ensemble"], "member 1: ")] {
        let output = done(simulate(folder.path()).args(options));
        let message = String::from_utf8(output.stderr).unwrap();
        let indefinite = format!("note: {whose}the metric is indefinite");
        for expected in [&*indefinite, "note: method rkmk853: "] {
            assert_eq!(message.matches(expected).count(), 1, "{message}");
        }
    }
}

/// The summary reports the momentum in the frame that the equations do not use, which is the
/// conserved one.
#[test]
fn the_summary_of_a_right_invariant_system() {
    let fluid = fs::read_to_string(root().join("examples/motions/fluid_se2.toml")).unwrap();
    let left = fluid.replace("\"right\"", "\"left\"").replace("spatial_velocity", "velocity");
    for (problem, shown, hidden) in [(fluid, "\n H2 ", "\n h2 "), (left, "\n h2 ", "\n H2 ")] {
        let output = done(&mut simulate(folder(&problem).path()));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(!message.contains(hidden), "{message}");
        let (_, row) = message.split_once(shown).unwrap();
        let change: f64 =
            row.lines().next().unwrap().split_whitespace().last().unwrap().parse().unwrap();
        assert!(change < 1e-12, "{message}");
    }
}

/// The summary is at most 80 columns wide, with formulas of quantities and large numbers too.
#[test]
fn the_summary_is_as_wide_as_a_terminal() {
    let long = ["2.5*Omega1"; 9].join(" + ");
    let problem = format!("{TOP}[quantities]\nk = \"1e290*({long})\"\nlast = \"h1\"\n");
    let problem = problem.replace("end = 400", "end = 0.5").replace("[1, \"w\"", "[-1, \"w\"");
    let free = "space = \"so(4)\"\nmetric = \"identity\"\n\
                initial.velocity = [1, 2, 3, 4, 5, 6]\noutput = { end = 1, columns = [\"t\"] }";
    for (problem, expected) in [(&*problem, &long), (free, &"H1^2 + H2^2".to_string())] {
        let output = done(&mut simulate(folder(problem).path()));
        let message = String::from_utf8(output.stderr).unwrap();
        let table = message.split_once("top: method").unwrap().1;
        assert!(table.lines().all(|line| line.len() <= 80), "{message}");
        let words = |text: &str| text.split_whitespace().map(String::from).collect::<Vec<_>>();
        // the formula is complete, although numbers are between its lines
        let mut found = words(table).into_iter();
        assert!(
            words(expected).iter().all(|word| found.any(|other| other.contains(word))),
            "{message}"
        );
    }
}
