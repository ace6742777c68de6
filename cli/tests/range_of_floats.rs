//! Exact numbers that floats cannot represent are errors in float output.

use std::fs;

/// Numbers that are too large or too small, and a subnormal number, which has fewer digits.
const BEYOND: [&str; 4] = ["1e400", "1e-400", "-1e309", "1.2345678901e-318"];

/// Every command that computes or writes floats reports an error, with status 2 and nothing on
/// standard output.
#[test]
fn every_command_refuses_what_floats_do_not_hold() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str], input: &str| {
        crate::program::run(folder.path(), arguments, input.as_bytes())
    };
    for number in BEYOND {
        let metric = format!("diag({number},1,1)");
        let problem = format!(
            "space = \"so(3)\"\nmetric = \"diag(1, 2, 3)\"\n[initial]\nvelocity = [\"{number}\", 1, 1]\n\
             [integration]\nmethod = \"rkmk4\"\nstep = 0.1\nend = 1\n"
        );
        fs::write(folder.path().join("top.toml"), problem).unwrap();
        let row = format!("{number} 0 0");
        let with = |pre: &[&str]| {
            let mut all: Vec<String> = pre.iter().map(|word| word.to_string()).collect();
            all.extend(["--metric".to_string(), metric.clone()]);
            all
        };
        let mut cases: Vec<(Vec<String>, &str)> = vec![
            (with(&["table", "so3", "--scalar", "float"]), ""),
            (with(&["check", "so3", "--scalar", "float"]), ""),
            (with(&["equations", "so3", "--scalar", "float"]), ""),
        ];
        for language in ["c", "python", "rust"] {
            cases.push((with(&["equations", "so3", "--code", language]), ""));
            cases.push((with(&["equations", "so3", "--scalar", "float", "--code", language]), ""));
        }
        let plain = |words: &[&str]| words.iter().map(|word| word.to_string()).collect::<Vec<_>>();
        for command in ["exp", "adjoint"] {
            cases.push((plain(&[command, "so3"]), &row));
        }
        cases.push((plain(&["simulate", "top.toml"]), ""));
        for (arguments, input) in cases {
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            let outcome = run(&arguments, input);
            assert_eq!(outcome.status, 2, "{arguments:?}: {outcome:?}");
            assert_eq!(outcome.out, "", "{arguments:?}");
            for wrong in ["inf", "NaN", "panicked"] {
                assert!(!outcome.err.contains(wrong), "{arguments:?}: {}", outcome.err);
            }
        }
    }
    // computed values outside the range of floats are not reported as names of parameters
    let large = ["equations", "so3", "--scalar", "float", "--metric", "diag(1e200,1e-200,1)"];
    for rest in [&["--solve"][..], &["--code", "c"], &["--code", "python"], &["--code", "rust"]] {
        let arguments = [&large[..], rest].concat();
        let outcome = run(&arguments, "");
        assert!(!outcome.out.contains("inf") && !outcome.out.contains("nan"), "{}", outcome.out);
    }
    // nor are they used for results on the Jacobi identity, curvature, Levi-Civita and given
    // affinities
    let spaces = [
        "brackets = ['[x,y]=1e160*z', '[y,z]=1e160*x', '[z,x]=1e160*x']",
        "brackets = ['[x,y]=1e160*z', '[y,z]=1e160*x', '[z,x]=1e160*y']",
        "brackets = ['[x,y]=1e160*z', '[y,z]=1e160*x', '[z,x]=1e160*y']\nconnection = 'plus'",
        "brackets = ['[x,y]=z', '[y,z]=x', '[z,x]=y']\nmetric = 'diag(1e200, 1e-200, 1)'",
        "brackets = '[x,y]=x'\naffinities = ['nabla[x, y] = 1e200*z', 'nabla[y, z] = 1e200*y']",
    ];
    for space in spaces {
        let file = format!("basis = ['x', 'y', 'z']\n{space}\n");
        fs::write(folder.path().join("wide.toml"), file).unwrap();
        for command in [&["check", "wide.toml"][..], &["compare", "wide.toml", "so3"]] {
            let arguments = [command, &["--scalar", "float"]].concat();
            let outcome = run(&arguments, "");
            assert_eq!((outcome.status, outcome.out.as_str()), (1, ""), "{arguments:?}: {space}");
            assert!(outcome.err.contains("is not a finite number"), "{}", outcome.err);
            assert!(outcome.err.contains("compute exactly"), "{}", outcome.err);
        }
    }
    // exact output has no range
    let exact = run(&["equations", "so3", "--metric", "diag(1e400,1,1)"], "");
    assert_eq!(exact.status, 0, "{}", exact.err);
}

/// Floats in output rows can be read as floats, and zero is written as zero.
#[test]
fn small_numbers_in_rows() {
    let folder = tempfile::tempdir().unwrap();
    // the rows of a matrix: [[1, x, z + x y/2], [0, 1, y], [0, 0, 1]]
    for (row, expected) in [
        ("0 -0.0 0e5", "1,0,0,0,1,0,0,0,1\n"),
        ("5e-324 -2.5e-310 0", "1,5e-324,0,0,1,-2.5e-310,0,0,1\n"),
        ("1/4 1e-200*1e-100 0", "1,0.25,1.25e-301,0,1,1e-300,0,0,1\n"),
    ] {
        let arguments = ["exp", "heisenberg(3)", "--format", "csv"];
        let outcome = crate::program::run(folder.path(), &arguments, row.as_bytes());
        let head = "g11,g12,g13,g21,g22,g23,g31,g32,g33\n";
        assert_eq!(outcome.out, [head, expected].concat(), "{row}: {}", outcome.err);
    }
    for row in ["1e-200*1e-200 0 0", "1/1e308 0 0", "0 0 1e-325", "0 1e308*10 0"] {
        let outcome = crate::program::run(folder.path(), &["exp", "heisenberg(3)"], row.as_bytes());
        assert_eq!((outcome.status, outcome.out.as_str()), (2, ""), "{row}: {}", outcome.err);
    }
}
