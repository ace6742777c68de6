//! `affinor verify`: unchanged tables agree, and changed components are found and named.

use crate::program::{run, stdout};
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

#[test]
fn a_stored_table_verifies() {
    let folder = TempDir::new().unwrap();
    for space in ["M3", "bianchi(VI,h=h)@lambda=t"] {
        for format in ["json", "csv"] {
            let file = format!("stored.{format}");
            let table = ["table", space, "--format", format, "-o", &file];
            assert_eq!(run(folder.path(), &table, b"").status, 0, "{space}");
            let outcome = run(folder.path(), &["verify", space, &file], b"");
            assert_eq!(outcome.status, 0, "{space} {format}: {}{}", outcome.out, outcome.err);
            assert!(
                outcome.out.starts_with("the stored table agrees: structure, "),
                "{}",
                outcome.out
            );
        }
    }
    for format in ["json", "csv"] {
        let space = ["so3@levi-civita;metric=diag(1,2,3)", "--scalar", "float"];
        let file = format!("float.{format}");
        let table = [&["table"], &space[..], &["--format", format, "-o", &file]].concat();
        assert_eq!(run(folder.path(), &table, b"").status, 0);
        let verify = [&["verify"], &space[..], &[&file]].concat();
        assert_eq!(run(folder.path(), &verify, b"").status, 0, "{format}");
        // compared with the exact values; some floats are not fractions with few digits
        let exact =
            ["table", "so3@levi-civita;metric=diag(1,2,3)", "--format", format, "-o", &file];
        assert_eq!(run(folder.path(), &exact, b"").status, 0);
        assert_eq!(run(folder.path(), &verify, b"").status, 0, "{format}");
    }
}

/// `--show all` omits tensors that do not apply to the space, as `table` does; a tensor that
/// applies must be stored.
#[test]
fn chosen_tensors_that_do_not_apply() {
    let folder = TempDir::new().unwrap();
    for format in ["json", "csv"] {
        let file = format!("all.{format}");
        let table = ["table", "so3@zero", "--show", "all", "--format", format, "-o", &file];
        assert_eq!(run(folder.path(), &table, b"").status, 0);
        let all = run(folder.path(), &["verify", "so3@zero", &file, "--show", "all"], b"");
        assert_eq!((all.status, all.err.as_str()), (0, ""), "{format}");
        assert!(all.out.contains("curvature, ricci, killing"), "{}", all.out);
        let scalar = ["verify", "so3@zero", &file, "--show", "scalar_curvature"];
        let nothing = run(folder.path(), &scalar, b"");
        assert_eq!(nothing.status, 1, "{}{}", nothing.out, nothing.err);
        assert!(nothing.err.contains("none of the selected tensors is defined"), "{}", nothing.err);
        let metric = [&scalar[..], &["--metric", "identity"]].concat();
        let status = run(folder.path(), &metric, b"").status;
        assert_eq!(status, if format == "json" { 2 } else { 1 }, "{format}");
    }
}

#[test]
fn a_changed_component_is_named() {
    let folder = TempDir::new().unwrap();
    for (format, change, component, stored, computed) in [
        ("csv", ("curvature,1,2,1,2,1/4", "curvature,1,2,1,2,1/5"), "R^1_212", "1/5", "1/4"),
        ("csv", ("curvature,1,2,1,2,1/4", "curvature,1,2,1,2,-1/4"), "R^1_212", "-1/4", "1/4"),
        ("csv", ("curvature,1,2,1,2,1/4\n", ""), "R^1_212", "0", "1/4"),
        ("csv", ("ricci,1,1,,,1/2", "ricci,1,1,,,1/2\nricci,1,2,,,7"), "Ric_12", "7", "0"),
        ("json", ("[[1,1],\"1/2\"]", "[[1,1],\"1/3\"]"), "Ric_11", "1/3", "1/2"),
    ] {
        let text = stdout(folder.path(), &["table", "SO3", "--format", format]);
        assert!(text.contains(change.0), "{}", change.0);
        let file = format!("changed.{format}");
        fs::write(folder.path().join(&file), text.replacen(change.0, change.1, 1)).unwrap();
        let outcome = run(folder.path(), &["verify", "SO3", &file, "--format", "json"], b"");
        assert_eq!(outcome.status, 1, "{}", outcome.err);
        let found: Value = serde_json::from_str(&outcome.out).unwrap();
        assert_eq!((&found["schema"], &found["ok"]), (&json!("affinor.verify/1"), &json!(false)));
        let first = json!([{"component": component, "stored": stored, "computed": computed}]);
        assert_eq!((&found["differences"], &found["first"]), (&json!(1), &first));
        let text = run(folder.path(), &["verify", "SO3", &file], b"");
        assert_eq!(text.status, 1);
        assert!(text.out.contains(component), "{}", text.out);
    }
}

#[test]
fn a_table_of_another_dimension_does_not_verify() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    for format in ["json", "csv"] {
        let (file, structure) = (format!("sl3.{format}"), ["--show", "structure", "-o"]);
        let table = [&["table", "sl3", "--format", format][..], &structure, &[&file]].concat();
        assert_eq!(run(folder.path(), &table, b"").status, 0);
    }
    let huge = usize::MAX.to_string();
    write("beyond.csv", "tensor,i,j,k,l,value\nricci,1,4,,,1\n");
    write("huge.csv", &format!("tensor,i,j,k,l,value\nricci,2,{huge},,,1\n"));
    let json = "{\"schema\": \"affinor.table/1\", \"tensors\": {\"ricci\": {\"components\": [[[2, 4], \"1\"]]}}}";
    write("beyond.json", json);
    for (file, other) in [
        ("sl3.json", "8"),
        ("sl3.csv", "at least 8"),
        ("beyond.json", "at least 4"),
        ("beyond.csv", "at least 4"),
        ("huge.csv", &*format!("at least {huge}")),
    ] {
        let outcome = run(folder.path(), &["verify", "so3", file], b"");
        assert_eq!(outcome.status, 1, "{}", outcome.err);
        let message = format!("the stored dimension is {other}, but the computed one is 3");
        assert!(outcome.err.contains(&message) && outcome.err.contains(file), "{}", outcome.err);
    }
}

#[test]
fn what_is_verified_is_named() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let verify = |arguments: &[&str]| run(folder.path(), &[&["verify"], arguments].concat(), b"");
    write(
        "structure.csv",
        &stdout(folder.path(), &["table", "so3@zero", "--show", "structure", "--format", "csv"]),
    );
    write(
        "killing.json",
        &stdout(folder.path(), &["table", "so3", "--show", "killing", "--format", "json"]),
    );
    let all = verify(&["so3@plus", "structure.csv"]);
    assert_eq!((all.status, &*all.out), (0, "the stored table agrees: structure\n"));
    // CSV has no rows for a zero tensor, so a chosen one that is absent is zero
    let chosen = verify(&["so3@plus", "structure.csv", "--show", "structure,torsion"]);
    assert_eq!(chosen.status, 1);
    assert!(chosen.out.starts_with("6 components differ"), "{}", chosen.out);
    let absent = verify(&["so3@plus", "killing.json", "--show", "torsion"]);
    assert_eq!(absent.status, 2);
    assert!(absent.err.contains("torsion is not stored"), "{}", absent.err);
    assert!(absent.err.contains("killing.json"), "{}", absent.err);
    write("none.json", "{\"schema\": \"affinor.table/1\", \"tensors\": {}}");
    let none = verify(&["so3@plus", "none.json"]);
    assert_eq!(none.status, 2);
    assert!(none.err.contains("it contains no tensor"), "{}", none.err);
    // a table that cannot be read does not hide the others
    let mixed = verify(&["so3@zero", "none.json", "structure.csv", "missing.csv"]);
    assert_eq!((mixed.status, &*mixed.out), (2, "the stored table agrees: structure\n"));
    for place in ["none.json", "it contains no tensor", "missing.csv"] {
        assert!(mixed.err.contains(place), "{place}: {}", mixed.err);
    }
    write("twice.csv", "tensor,i,j,k,l,value\nricci,1,1,,,1/4\nricci,1,1,,,1/4\n");
    let twice = verify(&["so3@zero", "twice.csv"]);
    assert_eq!(twice.status, 2);
    assert!(twice.err.contains("ricci: the component [1, 1] is stored twice"), "{}", twice.err);
}

#[test]
fn a_stored_table_of_another_kind_is_remarked_upon() {
    let folder = TempDir::new().unwrap();
    for (option, remark) in [
        (&["--independent"][..], "only independent components are stored"),
        (&["--frame", "right"], "stored in the right-invariant frame, but computed in the left"),
        (&["--scalar", "float"], "the stored values are floats, but the computed ones are exact"),
    ] {
        let table = [&["table", "so3@zero", "--format", "json", "-o", "a.json"], option].concat();
        assert_eq!(run(folder.path(), &table, b"").status, 0);
        let bare = run(folder.path(), &["verify", "so3@zero", "a.json"], b"");
        assert!(bare.err.contains(remark), "{}", bare.err);
        assert!(bare.err.contains(&format!(": see {}", option.join(" "))), "{}", bare.err);
        let alike = [&["verify", "so3@zero", "a.json"], option].concat();
        let alike = run(folder.path(), &alike, b"");
        assert_eq!((alike.status, &*alike.err), (0, ""), "{}", alike.out);
    }
}

#[test]
fn the_other_sign_convention_does_not_verify() {
    let folder = TempDir::new().unwrap();
    let text =
        stdout(folder.path(), &["table", "sl3@zero", "--show", "curvature", "--format", "csv"]);
    let swapped: Vec<String> = text
        .lines()
        .map(|line| match line.rsplit_once(',') {
            Some((at, value)) if at.starts_with("curvature") => {
                let other = value.strip_prefix('-').map_or(format!("-{value}"), str::to_string);
                format!("{at},{other}")
            }
            _ => line.to_string(),
        })
        .collect();
    let count = swapped.len() - 1;
    fs::write(folder.path().join("swapped.csv"), swapped.join("\n")).unwrap();
    let outcome = run(folder.path(), &["verify", "sl3@zero", "swapped.csv"], b"");
    assert_eq!(outcome.status, 1);
    let head = format!("{count} components differ; the first 20");
    assert!(outcome.out.starts_with(&head), "{}", outcome.out);
    // the stored connection is another one, which is only noted
    let json =
        stdout(folder.path(), &["table", "sl3@zero", "--show", "structure", "--format", "json"]);
    fs::write(folder.path().join("zero.json"), json).unwrap();
    let other = run(folder.path(), &["verify", "sl3@plus", "zero.json"], b"");
    assert_eq!(
        (other.status, other.err.as_str()),
        (0, "note: the stored connection is zero, but the computed one is plus\n")
    );
}

/// A table of zeros has only a head in CSV.
#[test]
fn a_table_without_rows_verifies() {
    let folder = TempDir::new().unwrap();
    let verify = |arguments: &[&str]| run(folder.path(), &[&["verify"], arguments].concat(), b"");
    let table = ["table", "so3@plus", "--show", "curvature", "--format", "csv", "-o", "zero.csv"];
    assert_eq!(run(folder.path(), &table, b"").status, 0);
    let stored = fs::read_to_string(folder.path().join("zero.csv")).unwrap();
    assert_eq!(stored, "tensor,i,j,k,l,value\n");
    let named = verify(&["so3@plus", "zero.csv", "--show", "curvature"]);
    assert_eq!((named.status, &*named.out), (0, "the stored table agrees: curvature\n"));
    let vanishing = verify(&["so3@plus", "zero.csv"]);
    let agrees = "the stored table agrees: curvature, ricci\n";
    assert_eq!((vanishing.status, &*vanishing.out), (0, agrees));
    assert!(vanishing.err.contains("--show names the tensors"), "{}", vanishing.err);
    let other = verify(&["so3@zero", "zero.csv", "--show", "curvature"]);
    assert_eq!(other.status, 1);
    // no tensor of this space is zero
    let none = verify(&["so3@lambda=1/3;metric=diag(1,2,3)", "zero.csv"]);
    assert_eq!(none.status, 1);
    assert!(none.err.contains("no tensor of this space vanishes"), "{}", none.err);
}

#[test]
fn tables_are_read_with_a_mark_of_byte_order_and_from_standard_input() {
    let folder = TempDir::new().unwrap();
    for format in ["csv", "json"] {
        let text = stdout(folder.path(), &["table", "so3@zero", "--format", format]);
        let marked = format!("\u{feff}{text}");
        for input in [text, marked] {
            let outcome = run(folder.path(), &["verify", "so3@zero", "-"], input.as_bytes());
            assert_eq!(outcome.status, 0, "{format}: {}{}", outcome.out, outcome.err);
        }
    }
}

#[test]
fn basis_names_and_variances_are_compared() {
    let folder = TempDir::new().unwrap();
    let text =
        stdout(folder.path(), &["table", "so3@zero", "--show", "curvature", "--format", "json"]);
    for (from, to, message) in [
        ("\"e2\"", "\"y\"", "the stored basis vector 2 is `y`, but the computed one is `e2`"),
        (
            "[\"up\",\"down\"",
            "[\"down\",\"down\"",
            "curvature: the stored indices are [\"down\",\"down\",\"down\",\"down\"], \
             the computed indices [\"up\",\"down\",\"down\",\"down\"]",
        ),
        ("[1,2,1,2]", "[1,2,1,4]", "curvature: the component [1, 2, 1, 4] needs 4 indices from 1"),
        ("[1,2,1,2]", "[1,2,1]", "curvature: the component [1, 2, 1] needs 4 indices from 1 to 3"),
    ] {
        assert!(text.contains(from), "{from}");
        let outcome =
            run(folder.path(), &["verify", "so3@zero", "-"], text.replacen(from, to, 1).as_bytes());
        assert!(outcome.status > 0 && outcome.err.contains(message), "{}", outcome.err);
    }
}

#[test]
fn a_tensor_chosen_twice_is_shown_once() {
    let folder = TempDir::new().unwrap();
    for format in ["text", "markdown", "latex", "csv", "json"] {
        let show = |tensors: &str| {
            stdout(folder.path(), &["table", "so3@zero", "--show", tensors, "--format", format])
        };
        assert_eq!(show("ricci,ricci"), show("ricci"), "{format}");
        assert_eq!(show("ricci,all"), show("ricci,all,ricci,all"), "{format}");
    }
}

/// The names of common factors in JSON are read back.
#[test]
fn named_factors_verify() {
    let folder = TempDir::new().unwrap();
    let space = ["so3", "--metric", "[[a,b,c],[b,d,e],[c,e,f]]"];
    let show = ["--show", "affinities,curvature,ricci"];
    let table = [&["table"], &space[..], &show, &["--format", "json", "--common-factors"]].concat();
    let text = stdout(folder.path(), &table);
    let stored: Value = serde_json::from_str(&text).unwrap();
    let det = "a*d*f - a*e^2 - b^2*f + 2*b*c*e - c^2*d";
    assert_eq!(stored["where"], json!({ "D": det }));
    let verify = |text: &str, file: &str| {
        fs::write(folder.path().join(file), text).unwrap();
        run(folder.path(), &[&["verify"], &space[..], &[file]].concat(), b"")
    };
    let outcome = verify(&text, "same.json");
    assert_eq!(outcome.status, 0, "{}{}", outcome.out, outcome.err);
    // without the option each value is written for itself
    let plain = [&["table"], &space[..], &show, &["--format", "json"]].concat();
    let plain = stdout(folder.path(), &plain);
    assert!(!plain.contains("\"where\"") && !plain.contains("/D"));
    assert_eq!(verify(&plain, "plain.json").status, 0);
    // other names, or values without names, are equal values
    let renamed = text.replace("\"D\"", "\"det\"").replace("D)", "det)").replace("/D", "/det");
    let outcome = verify(&renamed.replace("*D^", "*det^"), "renamed.json");
    assert_eq!(outcome.status, 0, "{}{}", outcome.out, outcome.err);
    let csv = [&["table"], &space[..], &show, &["--format", "csv"]].concat();
    let csv = stdout(folder.path(), &csv);
    assert!(!csv.contains('D'));
    assert_eq!(verify(&csv, "plain.csv").status, 0);
    let outcome = verify(&text.replace(det, "a*d*f - a*e^2"), "other.json");
    assert_eq!(outcome.status, 1);
    assert!(outcome.out.contains("Lambda^1_11"), "{}", outcome.out);
    for (change, message) in [
        ("\"D\": \"a*\"", "where: `D`"),
        ("\"D\": 3", "`where` is not an object of names"),
        ("\"a\": \"b\"", "where: `a` is a parameter of the table"),
        ("\"1D\": \"b\"", "where: `1D` is not a name"),
        ("\"D\": \"0\"", "division by zero"),
    ] {
        let outcome = verify(&text.replace(&format!("\"D\": \"{det}\""), change), "bad.json");
        assert_eq!(outcome.status, 2, "{change}: {}{}", outcome.out, outcome.err);
        assert!(outcome.err.contains(message), "{change}: {}", outcome.err);
    }
}

/// The number of characters of all values without spaces, next to the number for Maxima 5.46 and
/// the same tensors (`benches/peers/run.py symbols`).
#[test]
fn values_are_not_longer_than_those_of_maxima() {
    let folder = TempDir::new().unwrap();
    let metric = |n: usize, free: &dyn Fn(usize, usize) -> bool| {
        let entry = |i: usize, j: usize| match i == j || free(i, j) {
            true => format!("g{}{}", i.min(j) + 1, i.max(j) + 1),
            false => "0".to_string(),
        };
        let row = |i| format!("[{}]", (0..n).map(|j| entry(i, j)).collect::<Vec<_>>().join(","));
        format!("[{}]", (0..n).map(row).collect::<Vec<_>>().join(","))
    };
    let (none, all) = (|_: usize, _: usize| false, |_: usize, _: usize| true);
    let blocks = |i: usize, j: usize| i / 3 == j / 3;
    for (space, metric, maxima) in [
        ("so3", metric(3, &none), vec![("affinities", 141), ("curvature", 375), ("ricci", 125)]),
        ("so3", metric(3, &all), vec![("affinities", 3332), ("curvature", 4493), ("ricci", 1465)]),
        ("se3", metric(6, &none), vec![("affinities", 456), ("curvature", 3192), ("ricci", 492)]),
        ("so4", metric(6, &none), vec![("affinities", 564), ("curvature", 4818), ("ricci", 654)]),
        ("se3", metric(6, &blocks), vec![("affinities", 12954)]),
        ("so4", metric(6, &blocks), vec![("affinities", 15455)]),
    ] {
        for (tensor, maxima) in maxima {
            let table = ["table", space, "--metric", &metric, "--show", tensor];
            let table = [&table[..], &["--format", "json", "--common-factors"]].concat();
            let table: Value = serde_json::from_str(&stdout(folder.path(), &table)).unwrap();
            let letters = |text: &Value| text.as_str().unwrap().replace(' ', "").len();
            let names = table["where"].as_object().into_iter().flatten();
            let names: usize = names.map(|(name, value)| name.len() + 1 + letters(value)).sum();
            let components = table["tensors"][tensor]["components"].as_array().unwrap().iter();
            let half = |c: &&Value| tensor != "curvature" || c[0][2].as_u64() < c[0][3].as_u64();
            let values: usize = components.filter(half).map(|c| letters(&c[1])).sum();
            assert!(names + values <= maxima, "{space} {tensor}: {names} + {values} > {maxima}");
        }
    }
}

/// A table with one component of each set of components that are equal by symmetry agrees with
/// `--independent`, whichever components it contains.
#[test]
fn any_component_of_a_symmetric_set_may_be_stored() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let metric = "so3@levi-civita;metric=[[2,1,0],[1,3,1],[0,1,4]]";
    for space in [metric, "sl2@zero"] {
        let table = ["table", space, "--show", "curvature,ricci,structure", "--format", "csv"];
        let full = stdout(folder.path(), &table);
        let chosen = |lower: bool| -> String {
            let kept = |line: &&str| {
                let fields: Vec<&str> = line.split(',').collect();
                let (a, b) = match fields[0] {
                    "ricci" => (fields[1], fields[2]),
                    "structure" => (fields[2], fields[3]),
                    "curvature" => (fields[3], fields[4]),
                    _ => return true,
                };
                a == b || (a > b) == lower
            };
            full.lines().filter(kept).map(|line| line.to_string() + "\n").collect()
        };
        for lower in [true, false] {
            write("chosen.csv", &chosen(lower));
            let arguments = ["verify", space, "chosen.csv"];
            let agrees = run(folder.path(), &[&arguments[..], &["--independent"]].concat(), b"");
            assert_eq!((agrees.status, &*agrees.err), (0, ""), "{space} {lower}: {}", agrees.out);
            let bare = run(folder.path(), &arguments, b"");
            assert_eq!(bare.status, 1);
            assert!(
                bare.err.contains("only independent components are stored: see --independent"),
                "{}",
                bare.err
            );
            // a changed value is reported with the name from the table
            let text = chosen(lower);
            let last = text.trim_end().rsplit_once(',').unwrap().0;
            write("changed.csv", &format!("{last},99\n"));
            let changed =
                [&["verify", space, "changed.csv", "--independent", "--format", "json"][..]]
                    .concat();
            let outcome = run(folder.path(), &changed, b"");
            assert_eq!(outcome.status, 1);
            let found: Value = serde_json::from_str(&outcome.out).unwrap();
            let stored =
                found["first"].as_array().unwrap().iter().filter(|row| row["stored"] == "99");
            assert_eq!(stored.count(), 1, "{}", outcome.out);
        }
        // a full table lists both components of a pair; each is compared
        write("full.csv", &full);
        let both = run(folder.path(), &["verify", space, "full.csv", "--independent"], b"");
        assert_eq!(both.status, 0, "{}", both.out);
    }
}

/// Tables in another convention agree only if the convention is stated.
#[test]
fn stated_conventions() {
    let folder = TempDir::new().unwrap();
    let space = "so3@lambda=1/3;metric=diag(1,2,3)";
    let table = ["table", space, "--format", "csv", "--show", "affinities,curvature,ricci,torsion"];
    let text = stdout(folder.path(), &table);
    // the text of the components after a change of `convention`
    let converted = |tensor: &str, order: &[usize], negative: bool| -> String {
        let convert = |line: &str| {
            let mut fields: Vec<String> = line.split(',').map(String::from).collect();
            if fields[0] == tensor {
                let old = fields.clone();
                order
                    .iter()
                    .enumerate()
                    .for_each(|(at, from)| fields[at + 1].clone_from(&old[*from]));
                if negative {
                    let value = &old[old.len() - 1];
                    let other = value.strip_prefix('-').map_or(format!("-{value}"), String::from);
                    *fields.last_mut().unwrap() = other;
                }
            }
            fields.join(",") + "\n"
        };
        text.lines().map(convert).collect()
    };
    for (tensor, order, negative, convention) in [
        ("curvature", &[1, 2, 3, 4][..], true, "R^i_jkl = -R^i_jkl"),
        ("curvature", &[1, 3, 4, 2], false, "R^i_klj = R^i_jkl"),
        ("curvature", &[1, 3, 4, 2], true, "curvature^a_bcd = -curvature^a_dbc"),
        ("affinities", &[1, 3, 2], false, "Lambda^i_jk = Lambda^i_kj"),
        ("ricci", &[1, 2], true, "Ric_jl = -Ric_jl"),
        ("torsion", &[1, 3, 2], true, "tau^i_jk = tau^i_jk"),
    ] {
        fs::write(folder.path().join("a.csv"), converted(tensor, order, negative)).unwrap();
        let verify = ["verify", space, "a.csv", "--convention", convention];
        let stated = run(folder.path(), &verify, b"");
        assert_eq!(stated.status, 0, "{convention}: {}{}", stated.out, stated.err);
        if tensor != "torsion" {
            assert_eq!(run(folder.path(), &verify[..3], b"").status, 1, "{convention}");
        }
    }
    // all indices lowered: R_1212 = g_11 R^1_212
    let lowered = "tensor,i,j,k,l,value\ncurvature,1,2,1,2,1/4\n";
    fs::write(folder.path().join("a.csv"), lowered).unwrap();
    let verify = ["verify", "so3@zero;metric=identity", "a.csv", "--independent"];
    let lower =
        run(folder.path(), &[&verify[..], &["--convention", "R_ijkl = R_ijkl"]].concat(), b"");
    assert!(lower.out.starts_with("2 components differ"), "{}{}", lower.out, lower.err);
    assert!(lower.out.contains("R_1313") && lower.out.contains("R_2323"), "{}", lower.out);
    for (convention, message) in [
        ("R^i_jkl", "the convention is not an equation"),
        ("2*R^i_jkl = R^i_jkl", "the left side must be one tensor with a letter for each index"),
        ("R^i_1kl = R^i_1kl", "the left side must be one tensor with a letter for each index"),
        ("R^i_jkl = R^i_jkm", "the sides have different indices"),
        ("R^i_jkl = R^i_j", "R has 4 indices, not 2"),
    ] {
        let refused =
            run(folder.path(), &[&verify[..], &["--convention", convention]].concat(), b"");
        assert_eq!(refused.status, 2, "{convention}");
        assert!(refused.err.contains(message), "{}", refused.err);
    }
}

/// A convention of a tensor that no stored table has is named, and the outcome is that of the other tensors.
#[test]
fn unused_conventions_are_named() {
    let folder = TempDir::new().unwrap();
    for (file, show) in [("a.csv", "structure"), ("b.json", "structure,ricci")] {
        let format = file.split_once('.').unwrap().1;
        let table = ["table", "so3@zero", "--show", show, "--format", format, "-o", file];
        assert_eq!(run(folder.path(), &table, b"").status, 0);
    }
    let verify = |files: &[&str], convention: &str| {
        let arguments = [&["verify", "so3@zero"], files, &["--convention", convention]].concat();
        let outcome = run(folder.path(), &arguments, b"");
        assert_eq!(outcome.status, 0, "{}{}", outcome.out, outcome.err);
        outcome.err.matches("is not used").count()
    };
    let torsion = "tau^i_jk = -tau^i_jk";
    assert_eq!(verify(&["a.csv"], torsion), 1);
    assert_eq!(verify(&["a.csv", "b.json"], torsion), 1);
    // one table has it
    assert_eq!(verify(&["a.csv", "b.json"], "Ric_jl = Ric_lj"), 0);
    assert_eq!(verify(&["a.csv"], "Ric_jl = Ric_lj"), 1);
}

/// Several tables, or the tables of a folder, are compared in one run, each with its own result.
#[test]
fn many_tables() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let verify = |arguments: &[&str]| {
        run(folder.path(), &[&["verify", "so3@zero"], arguments].concat(), b"")
    };
    fs::create_dir(folder.path().join("tables")).unwrap();
    fs::create_dir(folder.path().join("empty")).unwrap();
    for (show, file) in [("ricci", "b.json"), ("curvature", "a.csv"), ("torsion", "c.csv")] {
        let format = file.split('.').next_back().unwrap();
        let table = ["table", "so3@zero", "--show", show, "--format", format];
        write(&format!("tables/{file}"), &stdout(folder.path(), &table));
    }
    write("tables/notes.txt", "not a table");
    let all = verify(&["tables"]);
    assert_eq!(all.status, 0, "{}{}", all.out, all.err);
    assert!(all.out.starts_with("3 of 3 stored tables agree"), "{}", all.out);
    for file in ["tables/a.csv", "tables/b.json", "tables/c.csv"] {
        assert!(all.out.contains(file), "{}", all.out);
    }
    write("wrong.csv", "tensor,i,j,k,l,value\nricci,1,1,,,1/3\nricci,2,2,,,1/2\n");
    let some = verify(&["tables", "wrong.csv", "--format", "json"]);
    assert_eq!(some.status, 1);
    let found: Value = serde_json::from_str(&some.out).unwrap();
    let outcomes: Vec<_> =
        found["tables"].as_array().unwrap().iter().map(|t| (&t["table"], &t["ok"])).collect();
    let ok = |file: &str, ok: bool| (json!(file), json!(ok));
    let expected = [
        ok("tables/a.csv", true),
        ok("tables/b.json", true),
        ok("tables/c.csv", true),
        ok("wrong.csv", false),
    ];
    assert!(
        outcomes.iter().zip(&expected).all(|(a, b)| (a.0, a.1) == (&b.0, &b.1)),
        "{}",
        some.out
    );
    assert_eq!(found["tables"][3]["differences"], json!(2));
    assert_eq!(found["tables"][3]["first"][0]["component"], json!("Ric_11"));
    let empty = verify(&["empty"]);
    assert_eq!(empty.status, 2);
    assert!(empty.err.contains("the folder empty has no .json or .csv file"), "{}", empty.err);
    // one file after another, with inline brackets
    let inline = ["verify", "--basis", "x y", "--bracket", "[x,y]=y", "one.csv", "two.csv"];
    write("one.csv", "tensor,i,j,k,l,value\nstructure,2,1,2,,1\nstructure,2,2,1,,-1\n");
    write("two.csv", "tensor,i,j,k,l,value\nkilling,1,1,,,1\n");
    let outcome = run(folder.path(), &inline, b"");
    assert_eq!(outcome.status, 0, "{}{}", outcome.out, outcome.err);
}

#[test]
fn all_differences_are_shown_on_request() {
    let folder = TempDir::new().unwrap();
    let table = ["table", "sl3@zero", "--show", "curvature", "--format", "csv"];
    let text = stdout(folder.path(), &table);
    let doubled = text.replace(",1/4\n", ",1/2\n");
    fs::write(folder.path().join("a.csv"), doubled).unwrap();
    let verify = ["verify", "sl3@zero", "a.csv", "--format", "csv"];
    let first = run(folder.path(), &verify, b"");
    let all = run(folder.path(), &[&verify[..], &["--all"]].concat(), b"");
    let rows = |out: &str| out.lines().filter(|line| line.starts_with("R^")).count();
    let count = text.lines().filter(|line| line.ends_with(",1/4")).count();
    assert!(count > 20);
    assert_eq!((rows(&first.out), rows(&all.out)), (20, count));
}

#[test]
fn a_parameter_that_the_space_lacks_is_named() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.csv"), "tensor,i,j,k,l,value\nricci,1,1,,,t/2\n").unwrap();
    let outcome = run(folder.path(), &["verify", "so3@zero", "a.csv"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("ricci: `t/2`: the space has no parameter t"), "{}", outcome.err);
}
