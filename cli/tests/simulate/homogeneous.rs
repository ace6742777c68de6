//! Curves on homogeneous spaces: closed geodesics of spheres and projective spaces, metrics that are
//! not naturally reductive, conserved quantities, parallel vectors, and messages.
#![allow(clippy::excessive_precision, reason = "references have 25 digits")]

use super::{columns, done, folder, refused, simulate};
use std::f64::consts::PI;
use std::fs;

/// The columns of a problem, by name.
fn run(problem: &str) -> Run {
    Run(columns(folder(problem).path()))
}

struct Run(Vec<(String, Vec<f64>)>);

impl Run {
    fn column(&self, name: &str) -> &[f64] {
        let found = self.0.iter().find(|(own, _)| own == name);
        &found.unwrap_or_else(|| panic!("no column {name}")).1
    }

    fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }

    /// The largest change of a column.
    fn drift(&self, name: &str) -> f64 {
        let column = self.column(name);
        column.iter().map(|value| (value - column[0]).abs()).fold(0.0, f64::max)
    }
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} is not {expected}");
}

/// On the unit sphere, the point `g e_n` moves along a great circle: it is `cos(t) e_n + sin(t) w`.
#[test]
fn great_circles_on_spheres() {
    for (space, n, velocity) in [
        ("S^2", 2, "[0.6, 0.8]"),
        ("S^4", 4, "[0.5, 0.5, -0.5, 0.5]"),
        ("S^6", 6, "[0.6, 0, 0, 0.8, 0, 0]"),
    ] {
        let problem = format!(
            r#"
            space = "{space}"
            metric = "identity"
            initial.velocity = {velocity}
            integrator.tolerance = 1e-12
            output = {{ times = [1, {PI}, {}], columns = ["t", "g"] }}
            "#,
            2.0 * PI
        );
        let run = run(&problem);
        let rows = n + 1;
        let point = |at: usize| {
            let name =
                |i: usize| if rows > 9 { format!("g{i}_{rows}") } else { format!("g{i}{rows}") };
            (1..=rows).map(|i| run.column(&name(i))[at]).collect::<Vec<f64>>()
        };
        let [start, one, half, whole] = [0, 1, 2, 3].map(point);
        assert_near(one[n], 1_f64.cos(), 1e-11, space);
        let across: f64 = one[..n].iter().map(|x| x * x).sum();
        assert_near(across.sqrt(), 1_f64.sin(), 1e-11, space);
        for i in 0..rows {
            assert_near(half[i], -start[i], 1e-11, space);
            assert_near(whole[i], start[i], 1e-11, space);
        }
    }
}

/// On CP^n with the basis `-i/2 (E_jk + E_kj), -1/2 (E_jk - E_kj)` as orthonormal basis, a geodesic
/// of unit speed is closed with the period `2 pi`: the line `g e_n` has `|<e_n, g e_n>| = |cos(t/2)|`.
#[test]
fn lines_of_projective_spaces() {
    for (space, rows, velocity) in
        [("CP^2", 3, "[0.5, 0.5, -0.5, 0.5]"), ("CP^3", 4, "[0.6, 0, 0, 0.8, 0, 0]")]
    {
        let (last, imaginary) = (format!("g{rows}{rows}"), format!("g{}{rows}", 2 * rows));
        let problem = format!(
            r#"
            space = "{space}"
            metric = "identity"
            initial.velocity = {velocity}
            integrator.tolerance = 1e-12
            output = {{ times = [1, {PI}, {}], columns = ["{last}", "{imaginary}"] }}
            "#,
            2.0 * PI
        );
        let run = run(&problem);
        for (at, t) in [0.0, 1.0, PI, 2.0 * PI].into_iter().enumerate() {
            let size = run.column(&last)[at].hypot(run.column(&imaginary)[at]);
            assert_near(size, (0.5 * t).cos().abs(), 1e-11, space);
        }
    }
}

const FLAG: &str = r#"
space = "SU(3)/T"
metric = "diag(1,1,2,2,4,4)"
transport = { u = [0.1, 0.2, -0.3, 0, 0.5, 0.4] }
initial.velocity = [0.3, -0.5, 0.7, 0.2, 0.4, -0.1]
integrator.tolerance = 1e-13
output = { end = 3, every = 0.5, columns = ["t", "velocity", "energy", "h", "u", "norm_u", "g"] }
"#;

/// A metric on the flags of C^3 that is not naturally reductive. References: tests/references/homogeneous.py,
/// power series with 40 digits of `g' = g v, mu' = [mu, v]` in matrices, and of Koszul's formula for the
/// parallel vector.
#[test]
fn a_geodesic_of_flags() {
    let run = run(FLAG);
    let velocity = [
        0.4957412355586651832800212,
        -0.8496285817625816916067387,
        -0.2323554039689420677664587,
        -0.07273164071147988299819511,
        0.4829605292441357754758903,
        -0.1232989847479096758461493,
    ];
    let vector = [
        -0.2710578417852913486565482,
        -0.06747978022029927419939437,
        -0.4196416400101068722110754,
        -0.7692419052072466758671162,
        0.02301508162457934588528841,
        0.2520867510525306504059677,
    ];
    for i in 0..6 {
        assert_near(run.last(&format!("v_m{}", i + 1)), velocity[i], 1e-11, "v");
        assert_near(run.last(&format!("u_m{}", i + 1)), vector[i], 1e-11, "u");
    }
    // rows of the real part, then rows of the imaginary part, which the matrix has below
    let real = [
        0.3234490311782284253552584,
        0.5354878919307595213303188,
        -0.1951970056576947640668381,
        -0.7990412878431640019781885,
        0.05732044823617989032189314,
        0.08564507963914475823197091,
        -0.05708370642272284482320269,
        -0.196257407321994292019967,
        0.5950643493208802220199373,
    ];
    let imaginary = [
        0.005874095416326686099352058,
        -0.3162469145739123659647788,
        -0.6859190585143461155585571,
        -0.4700384267030448050106379,
        0.0001755328318614541140749445,
        -0.3605220568568547658203279,
        0.1807887370341803249676746,
        -0.7559351639469544930173862,
        0.0006009739492502271000633188,
    ];
    for at in 0..9 {
        let (i, j) = (at / 3 + 1, at % 3 + 1);
        assert_near(run.last(&format!("g{i}{j}")), real[at], 1e-11, "g");
        assert_near(run.last(&format!("g{}{j}", i + 3)), imaginary[at], 1e-11, "g");
    }
    for i in 1..=8 {
        assert!(run.drift(&format!("h{i}")) < 1e-12, "h{i} changes");
    }
    assert!(run.drift("energy") < 1e-11 && run.drift("norm_u") < 1e-11);
}

/// An invariant metric on the Stiefel manifold SO(5)/SO(3); references as in `a_geodesic_of_flags`.
#[test]
fn a_geodesic_of_the_stiefel_manifold() {
    let run = run(r#"
        space = "SO(5)/SO(3)"
        metric = "diag(3/2,1,3,1,3,1,3)"
        transport = { u = { m1 = -0.2, m2 = 0.1, m4 = 0.3, m5 = 0.4, m6 = -0.5, m7 = 0.6 } }
        initial.velocity = [0.4, -0.3, 0.5, 0.2, 0.6, -0.1, 0.3]
        integrator.tolerance = 1e-13
        output = { end = 3, every = 1, columns = ["v", "u", "h", "energy", "norm_u", "g"] }
        "#);
    let velocity = [
        -0.3873042237096881416994414,
        -0.3335532577047879580388933,
        0.5023564223542966916473826,
        0.1598755523461170827611383,
        0.5986614877502399262480953,
        -0.1201120315383209701936488,
        0.3008186792590185715986061,
    ];
    let vector = [
        -0.5874923359287985544783531,
        -0.0835671429600646702080802,
        0.07727175948727549525681098,
        0.2073244640847354321817973,
        0.06068556085853876283985768,
        -0.621889508924849060964616,
        0.5734703376238218656051001,
    ];
    let last_row = [
        0.2101074860023451228855944,
        0.5125073499811044516282555,
        0.6610865839991734372758055,
        0.08863458621790262031880237,
        0.4982965975434761615778563,
    ];
    for i in 0..7 {
        assert_near(run.last(&format!("v_m{}", i + 1)), velocity[i], 1e-11, "v");
        assert_near(run.last(&format!("u_m{}", i + 1)), vector[i], 1e-11, "u");
    }
    for (i, expected) in last_row.into_iter().enumerate() {
        assert_near(run.last(&format!("g5{}", i + 1)), expected, 1e-11, "g");
    }
    assert!(run.drift("energy") < 1e-11 && run.drift("norm_u") < 1e-11);
    assert!((1..=10).all(|i| run.drift(&format!("h{i}")) < 1e-12));
}

/// The normal metric is naturally reductive, and `natural` is the torsion-free
/// connection of its orbits: both have the orbits of `exp(t v)` as curves. The canonical connection has the same curves and
/// another parallel transport, in which the components of vectors are constant.
#[test]
fn orbits_of_one_parameter_groups() {
    let of = |connection: &str| {
        run(&format!(
            r#"
            space = "SU(3)/T"
            metric = "identity"
            connection = "{connection}"
            transport = {{ u = [0.1, 0.2, -0.3, 0, 0.5, 0.4] }}
            initial.velocity = [0.3, -0.5, 0.7, 0.2, 0.4, -0.1]
            integrator.tolerance = 1e-12
            output = {{ end = 2, columns = ["v", "u", "g", "h"] }}
            "#
        ))
    };
    let (metric, natural, canonical) = (of("levi-civita"), of("natural"), of("canonical"));
    for (name, values) in &metric.0 {
        let (found, last) = (natural.column(name), values.last().unwrap());
        assert_near(found[1], *last, 1e-10, name);
        if !name.starts_with("u_") {
            assert_near(canonical.column(name)[1], *last, 1e-10, name);
        }
    }
    for i in 1..=6 {
        let (v, u) = (format!("v_m{i}"), format!("u_m{i}"));
        assert!(metric.drift(&v) < 1e-11 && canonical.drift(&v) < 1e-11);
        assert!(canonical.drift(&u) < 1e-11);
    }
    assert!(metric.drift("u_m1") > 0.01);
}

/// The curve does not depend on the basis of the complement: here the flag manifold in a basis of
/// combinations, given as a subalgebra with a complement.
#[test]
fn another_basis_of_the_complement() {
    let change = r#"
        metric = [[2, 1, 0, 0, 0, 0], [1, 1, 0, 0, 0, 0], [0, 0, 2, 0, 0, 0], [0, 0, 0, 8, 0, 0], [0, 0, 0, 0, 8, 4], [0, 0, 0, 0, 4, 4]]
        initial.velocity = [0.3, -0.8, 0.7, 0.1, 0.4, -0.5]
        integrator.tolerance = 1e-13
        output = { end = 3, columns = ["v", "g", "energy", "h"] }
        [definition]
        homogeneous = { of = "su(3)", by = ["e7", "e8"], complement = ["e1 + e2", "e2", "e3", "2*e4", "e5 + e6", "e6"] }
        "#;
    let (first, second) = (run(FLAG), run(change));
    for name in ["energy", "h1", "h5", "h8", "g11", "g23", "g41", "g52", "v_m3"] {
        assert_near(second.last(name), first.last(name), 1e-11, name);
    }
    assert_near(2.0 * second.last("v_m4"), first.last("v_m4"), 1e-11, "v");
    assert_near(second.last("v_m5") + second.last("v_m6"), first.last("v_m6"), 1e-11, "v");
}

/// A group without given matrices acts by its adjoint representation: hyperbolic space of dimension
/// 2 from brackets of so(2,1). A geodesic of speed `w` has the point at the distance `w t`.
#[test]
fn brackets_alone() {
    let run = run(r#"
        metric = "identity"
        initial.velocity = { m1 = 1, m2 = 0 }
        integrator.tolerance = 1e-12
        output = { end = 1.5, columns = ["v", "g", "energy"] }
        [definition]
        homogeneous = { of = { basis = ["k", "p", "q"], brackets = "[k,p] = q; [k,q] = -p; [p,q] = -k" }, by = ["k"], complement = ["p", "q"] }
        "#);
    // the adjoint representation acts on p, q, k; the stabilizer k moves along a hyperbola
    assert_near(run.last("g33"), 1.5_f64.cosh(), 1e-10, "g33");
    assert_near(run.last("energy"), 0.5, 1e-14, "energy");
}

#[test]
fn groups_with_translations() {
    // the Euclidean space: a straight line
    let run = run(r#"
        initial.velocity = [1, -2, 0.5]
        output = { end = 10, columns = ["v", "x", "y", "z", "h"] }
        transport = { u = [3, 4, 5] }
        metric = "identity"
        [definition]
        homogeneous = { of = "se(3)", by = ["e1", "e2", "e3"], complement = ["p1", "p2", "p3"] }
        "#);
    for (name, value) in [("x", 10.0), ("y", -20.0), ("z", 5.0)] {
        assert_near(run.last(name), value, 1e-12, name);
    }
    assert!((1..=6).all(|i| run.drift(&format!("h{i}")) < 1e-12));
}

#[test]
fn the_default_columns_and_the_notes() {
    let folder = folder(
        r#"
        space = "S^2"
        metric = "identity"
        transport = { u = { m1 = 1 } }
        initial = { velocity = { m1 = 3, m2 = 4 }, normalize = "unit" }
        output.end = 1
        "#,
    );
    let output = done(&mut simulate(folder.path()));
    let rows = String::from_utf8(output.stdout).unwrap();
    assert_eq!(rows.lines().next(), Some("t,v_m1,v_m2,energy,h1,h2,h3,u_m1,u_m2"));
    let first: Vec<f64> =
        rows.lines().nth(1).unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    for (found, expected) in first.iter().zip([0.0, 0.6, 0.8, 0.5, 0.6, 0.8, 0.0, 1.0, 0.0]) {
        assert_near(*found, expected, 1e-15, "the first row");
    }
    let notes = String::from_utf8(output.stderr).unwrap();
    for part in ["multiplied by 0.2", "method rkmk853", "energy"] {
        assert!(notes.contains(part), "{part}: {notes}");
    }
}

/// A transported vector may have a name that begins as a norm, with and without a metric.
#[test]
fn a_vector_with_the_name_of_a_norm() {
    let motion = |metric: &str, columns: &str| {
        let text = format!(
            "space = 'S^2'\n{metric}initial.velocity = [1, 0]\n\
             transport = {{ norm_a = [0, 2] }}\noutput = {{ end = 1, columns = [{columns}] }}\n"
        );
        run(&text)
    };
    let without = motion("", "'t', 'norm_a_m1', 'norm_a_m2'");
    assert_near(without.last("norm_a_m2"), 2.0, 1e-12, "the component");
    let with = motion("metric = 'identity'\n", "'norm_a', 'norm_norm_a'");
    assert_near(with.last("norm_norm_a"), 4.0, 1e-12, "the square");
    // without a connection and a metric, the run says which connection it uses
    let folder = folder("space = 'S^2'\ninitial.velocity = [1, 0]\noutput.end = 1\n");
    let notes = String::from_utf8(done(&mut simulate(folder.path())).stderr).unwrap();
    assert!(notes.contains("using the connection natural"), "{notes}");
}

#[test]
fn messages_name_the_key() {
    let folder = folder("");
    let problem = |lines: &str| {
        let text = format!("space = \"S^2\"\nmetric = \"identity\"\n{lines}\noutput.end = 1\n");
        fs::write(folder.path().join("top.toml"), text).unwrap();
        refused(&mut simulate(folder.path()), 2)
    };
    for (lines, message) in [
        ("", "the initial velocity is missing"),
        (
            "initial.velocity = [1]",
            "the velocity has 1 components, but the space has 2 basis vectors",
        ),
        ("initial.velocity = { m3 = 1 }", "`m3` is not a basis vector"),
        ("initial.velocity = { m1 = 1 }\nforces.potential = \"g11\"", "has no `forces`"),
        ("initial.velocity = { m1 = 1 }\ninertia.moments = [1,2,3]", "has no `inertia`"),
        (
            "initial.velocity = [1, 0]\ntransport = { v = [1, 0] }",
            "`v_m1` of a column is already in use",
        ),
        ("initial.velocity = [1, 0]\nquantities = { q = \"w + 1\" }", "`w`"),
    ] {
        let found = problem(lines);
        assert!(found.contains(message), "{lines}: {found}");
    }
}
