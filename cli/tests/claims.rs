//! `affinor claims`: user-defined statements, the exit status, and the witness of a failure.

use crate::program::{definition, run, stdout};
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

#[test]
fn the_exit_status_and_the_witness() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.txt"), "# one\ntorsion = 0\nRic_11 = 1/3\n").unwrap();
    fs::write(folder.path().join("b.txt"), "locally symmetric\r\nnot flat\r\n").unwrap();
    let claims = |arguments: &[&str]| run(folder.path(), &[&["claims"], arguments].concat(), b"");
    let held = claims(&["so3@zero", "b.txt", "--claim", "S = 3/2", "--metric", "identity"]);
    assert_eq!((held.status, &*held.err), (0, ""), "{}", held.out);
    assert!(held.out.starts_with("Claims about so(3): 3 of 3 hold"), "{}", held.out);
    let failed = claims(&["so3@zero", "a.txt", "b.txt", "--format", "json"]);
    assert_eq!(failed.status, 1);
    let found: Value = serde_json::from_str(&failed.out).unwrap();
    assert_eq!((&found["schema"], &found["ok"]), (&json!("affinor.claims/1"), &json!(false)));
    let witness = json!({"claim": "Ric_11 = 1/3", "line": 3, "holds": false, "component": "Ric_11", "left": "1/2", "right": "1/3"});
    assert_eq!(found["claims"][1], witness);
    let standard = run(folder.path(), &["claims", "so3@zero", "-"], b"flat");
    assert_eq!(standard.status, 1);
    for (arguments, message) in [
        (&["so3"][..], "no claims are given"),
        (&["so3", "no.txt"], "cannot read no.txt"),
        (&["so3@zero", "--claim", "Ric_11 = q"], "the space has no parameter q"),
        (&["so3@zero", "--claim", "# nothing"], "no statement in --claim"),
        (&["--claim", "flat"], "no SPACE is given"),
    ] {
        let refused = claims(arguments);
        assert_eq!(refused.status, 2, "{arguments:?}");
        assert!(refused.err.contains(message), "{}", refused.err);
    }
    // statements that cannot be tested do not hide the others
    fs::write(folder.path().join("c.txt"), "torsion = 0\nRic_11 = q\nflat\nbach = 0\n").unwrap();
    let mixed = claims(&["so3@zero", "c.txt"]);
    assert_eq!(mixed.status, 2, "{}", mixed.err);
    assert!(mixed.out.starts_with("Claims about so(3): 1 of 2 hold"), "{}", mixed.out);
    for place in ["c.txt:2", "the space has no parameter q", "c.txt:4", "bach"] {
        assert!(mixed.err.contains(place), "{place}: {}", mixed.err);
    }
    let jacobi = ["--basis", "x y z", "--bracket", "[x,y]=z; [y,z]=y", "--claim", "flat"];
    assert_eq!(claims(&jacobi).status, 1);
}

/// The example holds with parameters, with numbers, and in floats.
#[test]
fn the_example() {
    let folder = TempDir::new().unwrap();
    let file = definition("../claims/so3.txt");
    let space = ["claims", "so3", &file, "--metric", "diag(a,b,c)"];
    for settings in
        [&[][..], &["--set", "a=1,b=2,c=4"], &["--set", "a=1,b=2,c=4", "--scalar", "float"]]
    {
        let out = stdout(folder.path(), &[&space[..], settings].concat());
        assert!(!out.contains(" NO "), "{out}");
    }
    // the claims are about this metric only
    assert_eq!(
        run(folder.path(), &["claims", "sl2", &file, "--metric", "diag(a,b,c)"], b"").status,
        1
    );
}
