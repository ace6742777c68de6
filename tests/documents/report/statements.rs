//! Statements about spaces: each line of a printed table holds, and fails if a value in it is
//! changed.

use affinor_documents::report::{
    Computation, Format, Quantity, Report, Statements, Table, Verdicts, grouped_in_text,
};
use affinor_documents::space::{Request, ScalarChoice, Space};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::Tolerance;

fn open(space: &str) -> Space {
    Space::open(&Request { space: Some(space.into()), ..Request::default() }).unwrap()
}

fn test(space: &str, statements: &str) -> Verdicts {
    let statements = Statements::parse("claims.txt", statements).unwrap();
    Computation::of(&open(space)).test(&statements).unwrap_or_else(|e| panic!("{space}: {e:?}"))
}

/// The error message for an invalid statement.
fn refused(space: &str, statement: &str) -> String {
    let statements = Statements::parse("claims.txt", statement).unwrap();
    let verdicts = Computation::of(&open(space)).test(&statements).unwrap();
    assert!(!verdicts.all_hold());
    verdicts.errors()[0].message.clone()
}

/// The printed lines of all tensors of a space, without line breaks.
fn lines<S: Coefficient>(space: &Space) -> Vec<String> {
    let geometry = space.definition.geometry::<S>(Tolerance::default()).unwrap();
    let table = Table::new(&geometry, &Quantity::ALL).unwrap();
    let of = |entry: &affinor_documents::report::TableEntry<S>| {
        grouped_in_text(entry.quantity.symbol(), &entry.tensor)
    };
    table.tensors.iter().flat_map(of).collect()
}

fn example(file: &str) -> String {
    format!("{}/examples/definitions/{file}", crate::common::root().display())
}

/// The lines of tables are statements that hold: numbers, parameters, functions on a chart, and commas between indices
/// beyond dimension 9.
#[test]
fn lines_of_tables_hold() {
    let mut spaces: Vec<String> = [
        "so3@zero;metric=diag(1,2,3)",
        "so3@lambda=t;metric=diag(a,b,c)",
        "sl2@plus",
        "heisenberg(5)@levi-civita;metric=identity",
        "bianchi(VI,h=h)@levi-civita;metric=diag(1,p,1)",
        "M3",
        "so(5)@zero",
    ]
    .map(String::from)
    .into();
    spaces.extend(["schwarzschild", "sphere", "euler-angles"].map(String::from));
    for name in spaces {
        let space = open(&name);
        let kind = space.kind(ScalarChoice::Exact).unwrap();
        let lines = over_kind!(kind, S => lines::<S>(&space));
        assert!(lines.len() > 3, "{name}");
        let verdicts = test(&name, &lines.join("\n"));
        for verdict in verdicts.iter() {
            assert!(verdict.holds, "{name}: {verdict:?}");
        }
        // the last value is changed
        let wrong: Vec<String> = lines.iter().map(|line| format!("{line} + 1")).collect();
        let verdicts = test(&name, &wrong.join("\n"));
        assert_eq!(verdicts.iter().count(), lines.len());
        for (verdict, line) in verdicts.iter().zip(&lines) {
            assert!(!verdict.holds, "{name}: {verdict:?}");
            let last = line.rsplit(" = ").nth(1).unwrap();
            assert_eq!(verdict.component, last, "{name}: {line}");
        }
    }
}

/// Components with the names of coordinates, or of basis vectors, are statements that hold.
#[test]
fn components_with_names_hold() {
    fn named<S: Coefficient>(space: &Space) -> String {
        let geometry = space.definition.geometry::<S>(Tolerance::default()).unwrap();
        let mut table = Table::new(&geometry, &Quantity::ALL).unwrap();
        table.index_names = Some(table.frame_names().to_vec());
        let mut text = vec![];
        table.write(Format::Text, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap().replace("\n    ", " ");
        let is_component = |line: &&str| {
            line.starts_with("  ")
                && line.contains(" = ")
                && !line.contains('[')
                && !line.contains("  0")
        };
        let body = text.split_once("\n\n").unwrap().1;
        body.lines().filter(is_component).map(|line| line.trim().to_string() + "\n").collect()
    }
    for (name, component) in [
        ("schwarzschild", "Lambda^theta_r,theta"),
        ("euler-angles", "R^e1_e2,e1,e2"),
        ("so3@plus;metric=diag(1,2,3)", "g_e1,e1"),
        ("heisenberg(3)@levi-civita;metric=diag(a,b,1)", "Lambda^z_x1,y1"),
        ("aff(1)@levi-civita;metric=identity", "R^x_yyx"),
    ] {
        let space = open(name);
        let kind = space.kind(ScalarChoice::Exact).unwrap();
        let lines = over_kind!(kind, S => named::<S>(&space));
        assert!(lines.contains(component), "{name}: {lines}");
        for verdict in test(name, &lines).iter() {
            assert!(verdict.holds, "{name}: {verdict:?}");
        }
    }
}

/// Identities with free and summed letters, and with raised and lowered indices, hold where
/// theorems say so, and fail elsewhere.
#[test]
fn identities_with_letters() {
    let metric = "so3@levi-civita;metric=[[2,1,0],[1,3,0],[0,0,1]]";
    let schwarzschild = example("schwarzschild.toml");
    for space in [metric, "heisenberg(3)@levi-civita;metric=diag(a,b,c)", &schwarzschild] {
        let all = "\
R_ijkl = -R_jikl
R_ijkl = R_klij # pairs
R^i_jkl + R^i_klj + R^i_ljk = 0
Ric_jl = R^i_jil
Ric^i_i = S
Ric_ij g^ij = scalar_curvature
g_ij g^jk g_kl = g_il
R_ijkl R^ijkl = kretschmann
einstein = ricci - S/2*metric
Lambda^i_jk - Lambda^i_kj = c^i_jk";
        for verdict in test(space, all).iter() {
            assert!(verdict.holds, "{space}: {verdict:?}");
        }
    }
    // torsion and nonmetricity break the identities
    let other = "so3@plus;metric=diag(1,2,3)";
    let broken = "R_ijkl = R_jikl + g_ij g_kl\nc^i_jk = 2*tau^i_jk\nnonmetricity = 0\nLambda^i_jk = Lambda^i_kj";
    if let Some(verdict) = test(other, broken).iter().find(|verdict| verdict.holds) {
        panic!("{verdict:?}");
    }
}

#[test]
fn witnesses_have_the_component_and_both_values() {
    let verdicts = test(
        "so3@zero;metric=diag(1,2,4)",
        "ricci = metric\n\n# a comment\nRic_11 - g_11 = 0\nRic_ab = K_ab\nS > 2\nS <= 2 # first\nflat\nnot torsion-free\nS != 7/8",
    );
    let found: Vec<_> = verdicts
        .iter()
        .map(|verdict| (verdict.line, verdict.component.as_str(), verdict.sides.clone()))
        .collect();
    let sides = |a: &str, b: &str| Some([a.to_string(), b.to_string()]);
    assert_eq!(
        found,
        [
            (1, "Ric_11", sides("1/2", "1")),
            (4, "Ric_11 - g_11", sides("-1/2", "0")),
            (5, "Ric_11", sides("1/2", "-2")),
            (6, "", sides("7/8", "2")),
            (7, "", None),
            (8, "R^i_jkl = 1/4 at i = 1, j = 2, k = 1, l = 2", None),
            (9, "the space is torsion-free", None),
            (10, "", sides("7/8", "7/8")),
        ]
    );
}

/// Names of the basis and of coordinates are indices; a parameter takes precedence over a tensor
/// with the same name.
#[test]
fn names_of_indices_and_parameters() {
    let chart = example("schwarzschild.toml");
    let named =
        "Lambda^t_tr = Lambda^1_12\nLambda^{theta}_{phi phi} = Lambda^3_44\ng_tt = -(1 - 2*M/r)";
    assert!(test(&chart, named).all_hold());
    let space = "so3@levi-civita;metric=diag(S,S,S)";
    assert!(test(space, "scalar_curvature = 3/(2*S)\ng_11 = S").all_hold());
    assert!(!test(space, "S = scalar_curvature").all_hold());
}

/// Parameters that have been set keep their names in statements.
#[test]
fn set_parameters_have_values() {
    let request = Request {
        space: Some("so3".into()),
        metric: Some("diag(a,b,c)".into()),
        set: Some("a=2,b=3".into()),
        ..Request::default()
    };
    let statement = "Ric_11 = (a + b - c)*(a - b + c)/(2*b*c)";
    let statements = Statements::parse("claims.txt", statement).unwrap();
    let space = Space::open(&request).unwrap();
    assert!(Computation::of(&space).test(&statements).unwrap().all_hold());
}

#[test]
fn refused_statements() {
    let space = "so3@zero;metric=identity";
    for (statement, message) in [
        ("Ric_1 = 0", "Ric has 2 indices, not 1"),
        ("Ric_14 = 0", "the index 4 is not from 1 to 3"),
        ("Ric_11 = q", "the space has no parameter q"),
        ("Ric_ij = g_ik", "the terms have different indices: _ij and _ik"),
        ("Ric_ij = 1", "the terms have different indices: _ij and none"),
        ("Ric_ij + 1 = 0", "the terms have different indices: _ij and none"),
        ("Ric_ii = 0", "the summed index i must occur once upper and once lower"),
        ("c^i_jk c^i_jk = 0", "the summed index i must occur once upper and once lower"),
        ("g_mi c^m_jk c^j_ml = 0", "the summed index m occurs more than twice"),
        ("torsion*torsion = 0", "a product of tensors needs indices: write the indices of both"),
        ("1/ricci = 0", "the reciprocal of a tensor, with the indices lower, lower"),
        ("nice", "unknown property `nice`"),
        ("S =", "the expression ends where a value is expected"),
        ("metric > 0", "an inequality compares two numbers, not tensors"),
        ("Ric_11 = Ric_22 > 0", "only `=` may occur more than once in a statement"),
        ("2Ric_11 = 1", "`*` is missing: write `2*Ric_11`"),
        ("Ric_{12 = 0", "`{` is not closed"),
    ] {
        assert_eq!(refused(space, statement), message, "{statement}");
    }
    let without = "without a metric, the indices of R^i_jkl cannot be raised or lowered";
    assert_eq!(refused("so3@plus", "R_ijkl = 0"), without);
    assert_eq!(refused("so3@plus", "Einstein"), "`Einstein` is not defined for this space");
    assert_eq!(refused("so3@plus", "weyl = 0"), "weyl is not defined for this space");
    let sign = refused("so3@levi-civita;metric=diag(a,a,1)", "S > 0");
    assert!(sign.contains("depends on a: set numbers"), "{sign}");
}
