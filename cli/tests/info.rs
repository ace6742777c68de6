//! `affinor info`, tables for other programs, and the catalogue by properties.

use crate::program::{definition, root, run, stdout};
use serde_json::{Value, json};

/// The structure of a space.
pub(crate) fn info(space: &str) -> Value {
    serde_json::from_str(&stdout(root(), &["info", space, "--format", "json"])).unwrap()
}

/// The structure of an algebra that is defined in a file on standard input.
pub(crate) fn info_of(file: &str) -> Value {
    let outcome = run(root(), &["info", "-", "--format", "json"], file.as_bytes());
    assert_eq!(outcome.status, 0, "{file}: {}", outcome.err);
    serde_json::from_str(&outcome.out).unwrap()
}

#[test]
fn has_the_keys_of_its_schema() {
    let keys = "dimension abelian nilpotent nilpotency_class solvable derived_length unimodular perfect reductive \
                semisimple simple centre derived_series lower_central_series upper_central_series killing radical \
                nilradical levi rank dynkin_type simple_ideals derivations betti identification";
    for space in ["iso(3,1)", "bianchi(VI)", "R^2", "so(3)"] {
        let info = info(space);
        assert_eq!(info["schema"], "affinor.info/1");
        for key in keys.split_whitespace() {
            assert!(info.get(key).is_some(), "{key} of {space}");
        }
        for key in ["centre", "radical", "nilradical", "levi"] {
            let basis = info[key]["basis"].as_array().unwrap();
            assert_eq!(basis.len() as u64, info[key]["dimension"].as_u64().unwrap(), "{key}");
        }
    }
    assert_eq!(info("R^2")["dynkin_type"], Value::Null);
    assert_eq!(info("heisenberg(5)")["nilpotency_class"], 2);
    assert_eq!(info("heisenberg(5)")["derived_length"], 2);
}

#[test]
fn cartan_decompositions() {
    let unitary = info("su(2,1)");
    let expected = json!([{
        "name": "su(2,1)", "compact_type": "A1 + T1", "compact_dimension": 4, "character": 0,
        "real_rank": 1, "restricted_type": "BC1", "multiplicities": [2, 1], "black": [],
        "arrows": [[1, 2]], "vogan": {"painted": [1], "arrows": []},
    }]);
    assert_eq!(unitary["real_forms"], expected);
    let lorentz = info("so(4,1)+so(3)");
    let ranks: Vec<_> = lorentz["real_forms"].as_array().unwrap().iter().collect();
    assert_eq!((&ranks[0]["real_rank"], &ranks[1]["real_rank"]), (&json!(0), &json!(1)));
    let diagrams: Vec<_> = ranks.iter().map(|form| &form["vogan"]["painted"]).collect();
    assert_eq!(diagrams, [&json!([]), &json!([2])]);
    assert_eq!(info("sl(2,C)")["real_forms"], json!([null]));
    let text = stdout(root(), &["info", "sl(4,R)+sl(2,C)", "--format", "csv"]);
    let expected = "Vogan diagram,\"sl(4,R): 1---2---3; painted 2; arrows 1<->3; \
                    sl(2,C): two copies of A1, joined by arrows\"";
    assert!(text.contains(expected), "{text}");
    assert_eq!(info("heisenberg(3)")["real_forms"], json!([]));
}

/// Cohomology with coefficients: the algebra and its relative version on a homogeneous space.
#[test]
fn coefficients() {
    let with = |space: &str, module: &str| -> Value {
        let all = ["info", space, "--coefficients", module, "--format", "json"];
        serde_json::from_str(&stdout(root(), &all)).unwrap()
    };
    let motions = with("se(3)", "adjoint");
    let expected = json!({
        "coefficients": "adjoint", "dimension": 6, "numbers": [0, 1, 1, 0, 1, 1, 0], "proved": true,
    });
    assert_eq!(motions["cohomology"], expected);
    assert!(info("se(3)").get("cohomology").is_none());
    let plane = with("aff(1)", "[[1,0],[0,0]], [[0,1],[0,0]]");
    assert_eq!(plane["cohomology"]["dimension"], 2);
    assert_eq!(with("S^2", "adjoint")["cohomology"]["numbers"], json!([0, 0, 0]));
    for (space, module, reason) in [
        ("se(3)", "adjiont", "unknown coefficients"),
        ("aff(1)", "[[1,0],[0,0]], [[1,1],[0,0]]", "the matrices are not an action"),
        ("aff(1)", "[[1,0],[0,0]]", "2 matrices"),
        ("S^2", "[[1]]", "only for an algebra"),
    ] {
        let outcome = run(root(), &["info", space, "--coefficients", module], b"");
        assert_ne!(outcome.status, 0);
        assert!(outcome.err.contains(reason), "{}", outcome.err);
    }
}

#[test]
fn root_systems() {
    let e8 = info("E8");
    assert_eq!(e8["betti"].as_array().unwrap().len(), 249);
    assert_eq!(e8["cartan_matrix"][0]["matrix"].as_array().unwrap().len(), 8);
    assert_eq!(e8["roots"]["positive"], 120);
    assert_eq!(e8["roots"]["vectors"].as_array().unwrap().len(), 240);
    let motions = info("sl(2)+R^1");
    assert_eq!(motions["roots"]["simple"].as_array().unwrap().len(), 1);
    assert_eq!(motions["cartan_matrix"], json!([{ "type": "A1", "matrix": [[2]] }]));
    let compact = info("so(4)");
    assert_eq!(compact["roots"]["positive"], 2);
    assert_eq!(compact["roots"]["vectors"], Value::Null);
    assert_eq!(info("heisenberg(3)")["roots"], Value::Null);
    assert_eq!(info("heisenberg(3)")["cartan_matrix"], Value::Null);
    // the spaces of a branched diagram are in boxes
    let latex = stdout(root(), &["info", "D4", "--format", "latex"]);
    assert!(latex.contains("\\mbox{\\footnotesize\\ttfamily ~~~~\\textbar{}}"), "{latex}");
}

/// Discs, bonds and arrowheads of the picture.
#[test]
fn dynkin_diagrams_as_svg() {
    let count = |space: &str| {
        let picture = stdout(root(), &["plot", "dynkin", space]);
        let document = roxmltree::Document::parse(&picture).unwrap();
        let all = |tag: &str| document.descendants().filter(|node| node.has_tag_name(tag)).count();
        // each node is a disc with a white disc inside
        (all("circle") / 2, all("polyline"))
    };
    assert_eq!(count("E8"), (8, 7));
    assert_eq!(count("so(5)+so(8)"), (6, 3 + 3));
    assert_eq!(count("G2"), (2, 4));
    assert_eq!(count("iso(3,1)"), (2, 0));
    let refused = run(root(), &["plot", "dynkin", "heisenberg(3)"], b"");
    assert_eq!(refused.status, 1);
    assert!(refused.err.contains("no roots"), "{}", refused.err);
}

#[test]
fn with_parameters_holds_for_generic_values() {
    let generic = info("bianchi(VI)");
    assert_eq!((&generic["generic"], &generic["parameters"]), (&json!(true), &json!(["h"])));
    assert_eq!(generic["unimodular"], false);
    // VI_0, III and V
    assert_eq!(generic["exceptional_values"], json!(["-1", "0", "1"]));
    // VII_0, and the Killing form (2 h^2 - 2) e3* e3* of rank 1, in sums with Killing forms of rank
    // 0, 1 and 3
    for (name, rank) in [("bianchi(VII)", 1), ("bianchi(VII)+aff(1)", 2), ("bianchi(VII)+sl(2)", 4)]
    {
        let all = info(name);
        assert_eq!(all["killing"]["rank"], rank, "{name}");
        assert_eq!(all["exceptional_values"], json!(["-1", "0", "1"]), "{name}");
    }
    // mu1^p mu2^q is invariant where p + h q = 0, and of degree 4 at most
    assert_eq!(generic["casimirs"]["generators"], json!([]));
    let values = json!(["-3", "-2", "-1", "-1/2", "-1/3", "0"]);
    assert_eq!(generic["exceptional_casimirs"], values);
    let special = run(root(), &["info", "bianchi(VI)", "--set", "h=-1", "--format", "json"], b"");
    let special: Value = serde_json::from_str(&special.out).unwrap();
    assert_eq!((&special["generic"], &special["unimodular"]), (&json!(false), &json!(true)));
    let scaled = "parameters = ['a', 'b', 'c']\nbasis = ['x', 'y', 'z']\nbrackets = '''
        [x, y] = a*z
        [y, z] = b*x
        [z, x] = c*y'''";
    let casimirs = json!({
        "degree": 4,
        "degrees": [2],
        "generators": ["a*mu3^2 + b*mu1^2 + c*mu2^2"],
    });
    assert_eq!(info_of(scaled)["casimirs"], casimirs);
    // the inertia of M(3) does not affect its algebra
    assert_eq!(info("M3")["generic"], false);
}

/// Rows with reservations: a root that every isomorphism needs, equations of parameters, and flags
/// that are not proved.
#[test]
fn reservations_are_written() {
    let rows =
        |arguments: &[&str]| stdout(root(), &[&["info", "--format", "csv"], arguments].concat());
    let oscillator = ["--bracket", "[H,x] = p", "--bracket", "[H,p] = -2*x"];
    let text = rows(&[&["--basis", "H x p m"], &oscillator[..]].concat());
    let expected = "\"bianchi(VII,h=0)+R^1\",isomorphic over the reals; sqrt(2) is needed";
    assert!(text.contains(&format!("identification,{expected}")), "{text}");
    let text = rows(&[&["--basis", "H x p"], &oscillator[..]].concat());
    let expected = "\"its basis is p, x, -H, times sqrt(1/2), sqrt(1), sqrt(1/2)\"";
    assert!(text.contains(&format!("identification,\"bianchi(VII,h=0)\",{expected}")), "{text}");
    let damped = ["--bracket", "[H,x] = p", "--bracket", "[H,p] = p - 2*x"];
    let text = rows(&[&["--basis", "H x p m"], &damped[..]].concat());
    assert!(
        text.contains("identification,\"bianchi(VII)+R^1, h^2 = 1/7\",by invariants"),
        "{text}"
    );
    assert_eq!(info("degraaf(6,22,e=3)")["identification"]["root"], "3");
    assert_eq!(info("so(3)")["identification"].get("root"), None);
    // derivations with parameters are counted modulo two primes
    assert!(rows(&["bianchi(VI)"]).contains("complete (modulo two primes)"));
    assert!(!rows(&["bianchi(VI,h=2)"]).contains("complete (modulo two primes)"));
}

#[test]
fn refuses_what_is_no_algebra() {
    let space = ["info", "--basis", "x y z", "--bracket", "[x,y]=z; [y,z]=y"];
    let outcome = run(root(), &space, b"");
    assert_eq!(outcome.status, 1);
    assert!(outcome.err.contains("the Jacobi identity fails"), "{}", outcome.err);
    assert_eq!(run(root(), &["info", "so(3.5)"], b"").status, 2);
}

#[test]
fn the_catalogue_by_properties() {
    let list = |condition: &str| -> Vec<String> {
        let text = stdout(root(), &["list", "--where", condition, "--format", "json"]);
        let list: Value = serde_json::from_str(&text).unwrap();
        let spaces = list["spaces"].as_array().unwrap().iter();
        spaces.map(|space| space["name"].as_str().unwrap().to_string()).collect()
    };
    let nilpotent = list("dimension=4, nilpotent, not abelian");
    assert_eq!(nilpotent, ["filiform(4)", "patera(4,1)", "degraaf(4,3)"]);
    let simple = list("dimension=3, semisimple");
    for name in ["so(3)", "so(2,1)", "su(2)", "sl(2)", "A1", "bianchi(IX)", "patera(3,8)"] {
        assert!(simple.contains(&name.to_string()), "{name}: {simple:?}");
    }
    assert!(list("perfect, not semisimple").contains(&"se(3)".to_string()));
    for condition in ["dimension=40", "big", "nilpotent and abelian", ""] {
        assert_eq!(run(root(), &["list", "--where", condition], b"").status, 2, "{condition}");
    }
    assert_eq!(run(root(), &["list", "--where", "semisimple, abelian"], b"").status, 2);
}

#[test]
fn properties_of_geometries() {
    let of = |arguments: &[&str]| -> Value {
        let arguments = [&["properties"], arguments, &["--format", "json"]].concat();
        serde_json::from_str(&stdout(root(), &arguments)).unwrap()
    };
    let find = |all: &Value, name: &str| {
        let found = all["properties"].as_array().unwrap().iter().find(|p| p["name"] == name);
        found.unwrap_or_else(|| panic!("{name}")).clone()
    };
    let so3 = of(&["SO3"]);
    assert_eq!(so3["schema"], "affinor.properties/1");
    assert_eq!(find(&so3, "holonomy algebra")["value"], "dimension 3: su(2)");
    // names that parameters already have
    let plane = of(&["aff1", "--metric", "diag(c,K)"]);
    assert_eq!(find(&plane, "Einstein (Ric = c g)")["value"], "the constant is -1/c");
    assert_eq!(find(&plane, "constant curvature K")["value"], "the constant is -1/c");
    let scaled = of(&["heisenberg(3)", "--metric", "diag(a1,a2,a3)"]);
    let forms = find(&scaled, "parallel symmetric forms");
    assert_eq!(
        forms["value"],
        "dimension 1: g(x1, x1) = b1, g(y1, y1) = a2/a1*b1, g(z, z) = a3/a1*b1"
    );
    let of_plane = of(&["so3", "--metric", "diag(1,1,1/4)", "--plane", "e1, e2+e3"]);
    assert_eq!(find(&of_plane, "sectional curvature of e1, e2+e3")["value"], "K = 53/80");
    for plane in ["e1", "e1, e9", "e1, e2, e3"] {
        let arguments = ["properties", "so3", "--metric", "identity", "--plane", plane];
        assert_eq!(run(root(), &arguments, b"").status, 2, "{plane}");
    }
    // an unknown name was meant as a vector, so the help does not suggest to declare it
    for plane in ["e1, q", "e1, e2+q*e3", "e1, 2*q"] {
        let arguments = ["properties", "so3", "--metric", "identity", "--plane", plane];
        let message = run(root(), &arguments, b"").err;
        assert!(message.contains("`q` is neither a basis vector"), "{message}");
        assert!(message.contains("help: the basis is e1, e2, e3\n"), "{message}");
    }
    // each row says which connection it is about
    let by = |connection: &str| {
        let arguments =
            ["properties", "heisenberg(3)", "--metric", "identity", "--connection", connection];
        stdout(root(), &arguments)
    };
    assert!(by("plus").contains("Einstein and K are of the connection above"), "{}", by("plus"));
    assert!(by("levi-civita").contains("metric       given\n"), "{}", by("levi-civita"));
    // claims about a metric need a metric
    let bare = of(&["so3@zero"]);
    let names: Vec<&Value> =
        bare["properties"].as_array().unwrap().iter().map(|p| &p["name"]).collect();
    assert!(!names.contains(&&json!("metric-compatible")) && names.contains(&&json!("flat")));
    // a chart does not have an algebra
    let sphere = of(&[&definition("sphere.toml")]);
    assert_eq!(find(&sphere, "constant curvature K")["value"], "K = 1/a^2");
}

/// GAP reads the program; the list is the output of GAP 4.12.1 for the table of so(3).
#[test]
fn tables_of_gap_are_written_and_read() {
    let code = stdout(root(), &["table", "so3", "--show", "structure", "--format", "gap"]);
    let expected = "# so(3)\nT := EmptySCTable( 3, 0, \"antisymmetric\" );\n\
                    SetEntrySCTable( T, 1, 2, [ 1, 3 ] );\nSetEntrySCTable( T, 1, 3, [ -1, 2 ] );\n\
                    SetEntrySCTable( T, 2, 3, [ 1, 1 ] );\n\
                    L := LieAlgebraByStructureConstants( Rationals, T );\n";
    assert_eq!(code, expected);
    let structure = |input: &str| {
        let arguments = ["table", "-", "--show", "structure", "--format", "csv"];
        let outcome = run(root(), &arguments, input.as_bytes());
        assert_eq!(outcome.status, 0, "{input}: {}", outcome.err);
        outcome.out
    };
    for space in ["so3", "bianchi(VI,h=-1/2)", "sl(3)", "damek_ricci(1,2)"] {
        let table = ["table", space, "--show", "structure", "--format"];
        let own = stdout(root(), &[&table[..], &["csv"]].concat());
        assert_eq!(structure(&stdout(root(), &[&table[..], &["gap"]].concat())), own, "{space}");
    }
    let printed = "[ [ [ [  ], [  ] ], [ [ 3 ], [ 1 ] ], [ [ 2 ], [ -1 ] ] ],\n\
                   [ [ [ 3 ], [ -1 ] ], [ [  ], [  ] ], [ [ 1 ], [ 1 ] ] ],\n\
                   [ [ [ 2 ], [ 1 ] ], [ [ 1 ], [ -1 ] ], [ [  ], [  ] ] ], -1, 0 ]";
    assert_eq!(structure(printed), structure(expected));
    let refused = [
        ("T := EmptySCTable( x, 0 );", "must be the dimension"),
        (
            "T := EmptySCTable( 2, 0 );\nSetEntrySCTable( T, 1, 3, [ 1, 1 ] );",
            "the index 3 is not in 1..2",
        ),
        (
            "T := EmptySCTable( 2, 0 );\nSetEntrySCTable( T, 1, 2, [ 1 ] );",
            "SetEntrySCTable( T, j, k",
        ),
        ("[ [ [ [ 1 ], [ ] ] ], -1, 0 ]", "the numbers of indices and values differ"),
    ];
    for (input, says) in refused {
        let outcome = run(root(), &["table", "-"], input.as_bytes());
        assert!(outcome.status == 2 && outcome.err.contains(says), "{input}: {}", outcome.err);
    }
}

#[test]
fn other_programs_get_their_tables() {
    let code = |space: &str, format: &str| {
        stdout(root(), &["table", space, "--show", "structure", "--format", format])
    };
    let sage = code("bianchi(VI)", "sage");
    assert!(sage.contains("FractionField(PolynomialRing(QQ, 'h'))"), "{sage}");
    assert!(sage.contains("('e2', 'e3'): {'e2': h}"), "{sage}");
    assert!(code("so3+so3", "sage").contains("('e4', 'e5'): {'e6': 1}"));
    let maple = code("heisenberg(3)", "maple");
    assert!(maple.contains("LieAlgebraData([\n  [x1, y1] = z\n], [x1, y1, z], Alg)"), "{maple}");
    let sympy = code("bianchi(VI,h=-1/2)", "sympy");
    assert!(sympy.contains("c[1, 1, 2] = Rational('-1/2')\nc[1, 2, 1] = -c[1, 1, 2]"), "{sympy}");
    let refused = run(root(), &["table", "so3", "--format", "gap"], b"");
    assert!(
        refused.status == 2 && refused.err.contains("structure constants only"),
        "{}",
        refused.err
    );
    assert_eq!(run(root(), &["check", "so3", "--format", "sage"], b"").status, 2);
}

/// The notions of the rows, in order.
fn notions(space: &str) -> Vec<String> {
    let text = stdout(root(), &["info", space, "--format", "csv"]);
    let first = |line: &str| line.split(',').next().unwrap_or_default().to_string();
    text.lines().skip(1).map(first).filter(|notion| !notion.is_empty()).collect()
}

/// Every algebra has the same rows and keys, and a reason for each key that is null.
#[test]
fn rows_are_always_there() {
    let expected = notions("so(3)");
    for space in [
        "R^1",
        "R^2",
        "aff(1)",
        "heisenberg(3)",
        "se(3)",
        "G2",
        "filiform(13)",
        "parabolic(A4,1)",
        "t(6)",
        "n(9)",
        "usp(8)",
        "R^40",
        "D9",
        "free_nilpotent(3,3)",
    ] {
        let found: Vec<String> =
            notions(space).into_iter().filter(|notion| notion != "not decided").collect();
        // drawings have several lines
        let of = |all: &[String]| {
            all.iter().filter(|notion| expected.contains(notion)).cloned().collect::<Vec<_>>()
        };
        assert_eq!(of(&found), expected, "{space}");
        let info = info(space);
        for (key, value) in info.as_object().unwrap() {
            let reason = &info["reasons"][key];
            assert!(!value.is_null() || reason.is_string(), "{key} of {space}");
        }
    }
    assert_eq!(info("G2")["casimirs"]["degrees"], json!([2]));
    assert_eq!(info("usp(8)")["identification"]["name"], "usp(8)");
}

/// A 2-step nilpotent algebra of dimension 14 without a symplectic form.
#[test]
fn no_symplectic_form_in_dimension_14() {
    let file = "basis = ['e1','e2','e3','e4','e5','e6','e7','z1','z2','z3','z4','z5','z6','z7']\nbrackets = '''
        [e1,e2]=z1
        [e3,e4]=z1
        [e1,e6]=z1
        [e5,e7]=z1
        [e2,e5]=z2
        [e2,e6]=z3
        [e2,e7]=z4
        [e3,e5]=z5
        [e3,e6]=z6
        [e3,e7]=z7'''";
    let found = info_of(file);
    let symplectic = &found["symplectic"];
    assert_eq!((&symplectic["exists"], &symplectic["proved"]), (&json!(false), &json!(true)));
    assert_eq!((&symplectic["closed"], &symplectic["rank"]), (&json!(42), &json!(12)));
    assert_eq!(found["cocycles"]["two_forms"].as_array().unwrap().len(), 42 - 7);
    assert_eq!(found["betti"][2], 42 - 7);
}

/// Exceptional values are roots of polynomials in the computation; other polynomials are reported
/// as open.
#[test]
fn exceptional_values_are_roots() {
    let of = |brackets: &str| {
        info_of(&format!(
            "parameters = ['h']\nbasis = ['e1','e2','e3','e4','e5']\nbrackets = '{brackets}'"
        ))
    };
    let found = of("[e2,e3]=e1; [e1,e5]=2*e1; [e2,e5]=e2; [e3,e5]=e3; [e4,e5]=h*e4");
    let values = found["exceptional_values"].as_array().unwrap();
    for value in ["-4", "0", "1", "2"] {
        assert!(values.contains(&json!(value)), "{value} in {values:?}");
    }
    // unimodular at a root with large coefficients, but at no rational number
    let found = of("[e1,e5]=e1; [e2,e5]=(355/113 - h)*e2; [e3,e5]=-e3");
    assert!(found["exceptional_values"].as_array().unwrap().contains(&json!("355/113")));
    let found = of("[e1,e5]=e1; [e2,e5]=(h^2 - 3)*e2; [e3,e5]=-e3");
    assert!(found["exceptional_open"].as_array().unwrap().contains(&json!("h^2 - 3")));
    let several = info_of(
        "parameters = ['a', 'b']\nbasis = ['x', 'y', 'z']\nbrackets = '[x, z] = a*x; [y, z] = b*y'",
    );
    assert_eq!(several["exceptional_values"], Value::Null);
    assert_eq!(several["reasons"]["exceptional_values"], "not computed with several parameters");
}

/// A table in which no tensor applies is an error with help.
#[test]
fn tables_without_tensors_are_refused() {
    for (space, help) in
        [(vec!["so3@plus"], "--metric"), (vec!["so3@plus", "--format", "csv"], "--metric")]
    {
        let arguments = [&["table"], &space[..], &["--show", "kretschmann"]].concat();
        let outcome = run(root(), &arguments, b"");
        assert_eq!(outcome.status, 2, "{}", outcome.err);
        assert!(
            outcome.err.contains(help) && outcome.err.contains("kretschmann"),
            "{}",
            outcome.err
        );
        assert!(outcome.out.is_empty());
    }
    // some of the tensors
    assert_eq!(run(root(), &["table", "so3@plus", "--show", "kretschmann,torsion"], b"").status, 0);
}
