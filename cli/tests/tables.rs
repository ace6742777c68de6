//! Tables of structure constants, written by affinor and by other programs, read as spaces.

use crate::common::root;
use crate::program::run;
use std::fmt::Write;

/// The structure constants of a SPACE, as CSV.
fn structure(space: &str, input: &str) -> String {
    let arguments = ["table", space, "--show", "structure", "--format", "csv"];
    let outcome = run(root(), &arguments, input.as_bytes());
    assert_eq!(outcome.status, 0, "{space} {input}: {}", outcome.err);
    outcome.out
}

fn refused(space: &str, input: &str) -> String {
    let outcome = run(root(), &["table", space], input.as_bytes());
    assert_eq!(outcome.status, 2, "{space} {input}: {}", outcome.out);
    outcome.err
}

/// Random numbers below a bound, from a fixed seed.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn value(&mut self) -> String {
        let numerator = self.below(9) + 1;
        match self.below(4) {
            0 => format!("{numerator}/{}", self.below(5) + 2),
            1 => format!("{numerator}*a"),
            _ => numerator.to_string(),
        }
    }
}

/// Brackets of the semidirect product of a line with `R^(n-1)` by a random matrix with rational and symbolic entries.
fn semidirect(n: usize, random: &mut Random) -> String {
    let mut text =
        format!("basis {}\n", (1..=n).map(|i| format!("e{i}")).collect::<Vec<_>>().join(" "));
    for j in 2..=n {
        let mut terms = vec![format!("{}*e{n}", random.value())];
        terms.extend(
            (0..random.below(3))
                .map(|_| format!("{}*e{}", random.value(), random.below(n - 1) + 2)),
        );
        writeln!(text, "[e1, e{j}] = {} # a comment", terms.join(" - ")).unwrap();
    }
    text
}

/// Every format of `affinor table` with structure constants can be read back as the same table.
#[test]
fn written_tables_are_read_back() {
    let mut random = Random(7);
    let named = [
        "so3",
        "sl(2)",
        "heisenberg(5)",
        "bianchi(VI)",
        "so(3,1)",
        "su(3)",
        "sl(4)",
        "so3+so3",
        "se(3)",
        "damek_ricci(1,2)",
        "sp(4)",
        "aff(3)",
        "sim(3)",
        "gl(3)",
        "so(6)",
        "so3+R^2",
    ];
    let random = (3..=15).map(|n| semidirect(n, &mut random));
    let spaces = named.map(|name| (name, String::new())).into_iter();
    for (space, input) in spaces.chain(random.map(|text| ("-", text))) {
        let expected = structure(space, &input);
        for format in ["csv", "json", "gap", "sage", "maple"] {
            let arguments = ["table", space, "--show", "structure", "--format", format];
            let table = run(root(), &arguments, input.as_bytes());
            assert_eq!(table.status, 0, "{}", table.err);
            assert_eq!(structure("-", &table.out), expected, "{space} {format} {}", table.out);
        }
    }
}

/// Columns of CSV are found by their names, in every order and with every separator.
#[test]
fn columns_are_read_by_their_names() {
    let mut random = Random(11);
    for n in 3..=15 {
        let text = semidirect(n, &mut random);
        let expected = structure("-", &text);
        let rows: Vec<Vec<&str>> = expected
            .lines()
            .skip(1)
            .map(|line| line.split(',').collect::<Vec<_>>())
            .map(|row| vec![row[1], row[2], row[3], row[5]])
            .collect();
        let mut order = [0, 1, 2, 3];
        (1..4).rev().for_each(|at| order.swap(at, random.below(at + 1)));
        let separator = [",", ";", "\t", " , "][random.below(4)];
        let line = |row: &[&str]| order.map(|at| row[at]).join(separator) + "\n";
        let body: String = rows.iter().map(|row| line(row)).collect();
        assert_eq!(
            structure("-", &(line(&["i", "j", "k", "value"]) + &body)),
            expected,
            "{order:?}"
        );
        // without a header the order is the one that affinor writes
        let plain: String = rows.iter().map(|row| row.join(";") + "\n").collect();
        assert_eq!(structure("-", &plain), expected);
    }
}

/// `de^k = a e^i e^j` in Salamon's notation is `[e_i, e_j] = -a e_k`.
#[test]
fn differentials_of_nilmanifolds_are_read() {
    let mut random = Random(13);
    for n in 3..=15usize {
        let generators = n.div_ceil(2).max(2);
        let (mut list, mut brackets) = (vec![format!("0^{generators}")], String::new());
        for k in generators + 1..=n {
            let (i, j) = (1 + random.below(generators - 1), generators);
            let (value, negative) = (random.value(), random.below(2) == 0);
            let pair = match (j < 10, random.below(3)) {
                (true, 0) => format!("{i}{j}"),
                (_, 1) => format!("{{{i},{j}}}"),
                _ => format!("{i}.{j}"),
            };
            let sign = if negative { "-" } else { "" };
            list.push(format!("{sign}{value}*{pair}"));
            let opposite = if negative { "" } else { "-" };
            writeln!(brackets, "[e{i}, e{j}] = {opposite}{value}*e{k}").unwrap();
        }
        let list = format!("({})", list.join(","));
        // each pair of indices may occur for several k
        let rows = |csv: String| {
            let mut rows: Vec<String> = csv.lines().map(str::to_string).collect();
            rows.sort();
            rows
        };
        let mut expected = vec![];
        for line in brackets.lines() {
            let names = (1..=n).map(|i| format!("e{i}")).collect::<Vec<_>>().join(" ");
            expected.extend(
                structure("-", &format!("basis {names}\n{line}\n"))
                    .lines()
                    .skip(1)
                    .map(str::to_string),
            );
        }
        expected.push("tensor,i,j,k,l,value".into());
        expected.sort();
        assert_eq!(rows(structure(&list, "")), expected, "{list}");
        assert_eq!(rows(structure("-", &list)), expected, "{list}");
    }
}

#[test]
fn brackets_of_papers_are_read() {
    let so3 = structure("so3", "");
    for text in [
        "[x,y]=z, [y,z]=x, [z,x]=y",
        "[x, y] = z; [y, z] = x; [z, x] = y",
        "[e1,e2] = e3,\n[e2,e3] = e1,\n[e3,e1] = e2,",
        "# rotations\n\n[e2,e3] = e1  # first\n[e1,e2] = e3\n[e1,e3] = -e2\n",
        "basis: ω_1, ω_2, ω_3\n[ω_1, ω_2] = ω_3\n[ω_2, ω_3] = ω_1\n[ω_3, ω_1] = ω_2",
        "{('x','y'): {'z': 1}, ('y','z'): {'x': 1}, ('x','z'): {'y': -1}}",
        "_DG([[\"LieAlgebra\", Alg, [3]], [[[1, 2, 3], 1], [[1, 3, 2], -1], [[2, 3, 1], 1]]])",
    ] {
        assert_eq!(structure("-", text), so3, "{text}");
        if !text.contains('#') && !text.contains("basis") && text.starts_with('[') {
            assert_eq!(structure(text, ""), so3, "{text}");
        }
    }
    // missing numbers of a numbered basis denote basis vectors
    assert!(structure("[e1,e2]=a*e5;metric=identity", "").contains("structure,5,1,2,,a\n"));
    let basis = "names='x,y,z,w'";
    let central = format!("LieAlgebra(QQ, {{('x','y'): {{'z': QQ('1/2')}}}}, {basis})");
    assert!(run(root(), &["table", "-"], central.as_bytes()).out.contains("x, y, z, w"));
}

#[test]
fn unreadable_tables_are_refused_by_name() {
    let gap = "F:=GF(2);\nT:= EmptySCTable( 3, Zero(F), \"antisymmetric\" );\nSetEntrySCTable( T, 1, 2, [1,3] );";
    let cases = [
        (gap, "the finite field GF(2)"),
        ("[ [ [ [  ], [  ] ] ], -1, 0*Z(2) ]", "the finite field Z(2)"),
        ("LieAlgebra(GF(5), {('x','y'): {'z': 1}})", "the finite field GF(5)"),
        ("(0,0,12)\n(0,0,12,13)", "a second algebra follows"),
        ("(0,0,123)", "`123` is not a term of de^3"),
        ("(0,0,14)", "the index 4 is not in 1..3"),
        ("a,b,c,d\n1,2,3,4", "name them i, j, k and value"),
        ("1,2,3,1\n1,2,3,2", "given twice"),
        ("1,2,0,1", "`0` is not an index from 1"),
        ("1,2,3,1\n1,2,3", "not 3"),
        ("tensor,i,j,k,l,value\nricci,1,1,,,1", "--show structure"),
        ("{\"schema\": \"affinor.check/1\"}", "a report affinor.check/1 is not a table"),
        ("\\documentclass{article}", "it seems to be LaTeX"),
        ("what is this", "is not a definition of a space"),
        ("{('x','y'): {'z' 1}}", "an item of the dictionary"),
        ("LieAlgebraData([x])", "write LieAlgebraData"),
        ("_DG([[\"Frame\", F, [3]], []])", "not a Lie algebra"),
        ("[x, y] = z, [x, y] = 2*z", "a second, different value"),
    ];
    for (input, says) in cases {
        let message = refused("-", input);
        assert!(message.contains(says), "{input}: {message}");
    }
    let chart = format!("{}/examples/definitions/sphere.toml", root().display());
    let table = run(root(), &["table", &chart, "--format", "json"], b"").out;
    assert!(refused("-", &table).contains("over a chart"));
    let right = run(root(), &["table", "so3", "--frame", "right", "--format", "json"], b"").out;
    assert!(refused("-", &right).contains("--frame left"));
    assert!(refused("u1.csv", "").contains("cannot read u1.csv"));
}
