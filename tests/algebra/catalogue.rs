//! The catalogue is compared with closed forms.

mod name;
mod tables;

use affinor::algebra::BasisChange;
use affinor::algebra::catalogue;
use affinor::algebra::roots::{CartanType, RootSystem, Series};
use affinor::{Error, LieAlgebra};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up};
use std::collections::BTreeMap;

fn exact(value: &Symbolic) -> Result<Rational, Error> {
    value
        .as_constant()
        .cloned()
        .ok_or_else(|| Error::Unsupported("a parameter without a value".into()))
}

/// The algebra with this name; also checks the Jacobi identity.
fn algebra(name: &str) -> LieAlgebra<Rational> {
    let entry = catalogue::find(name).unwrap_or_else(|error| panic!("{name}: {error}"));
    entry
        .bracket(exact)
        .and_then(LieAlgebra::try_from)
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn symbolic(name: &str) -> LieAlgebra<Symbolic> {
    let bracket = catalogue::find(name).unwrap().bracket::<_, Error>(|value| Ok(value.clone()));
    LieAlgebra::try_from(bracket.unwrap()).unwrap()
}

fn rational(n: i64) -> Rational {
    Rational::from(n)
}

/// `[e_j, e_k]` as the nonzero components, by label.
fn bracket(algebra: &LieAlgebra<Rational>, x: &str, y: &str) -> BTreeMap<String, Rational> {
    let at = |label: &str| algebra.labels().iter().position(|l| l == label).unwrap();
    let (j, k) = (at(x), at(y));
    let labels = algebra.labels().iter().cloned().enumerate();
    labels
        .map(|(i, label)| (label, algebra.structure_constants().get(&[i, j, k])))
        .filter(|(_, v)| *v != rational(0))
        .collect()
}

fn combination(terms: &[(&str, i64)]) -> BTreeMap<String, Rational> {
    terms.iter().map(|(label, v)| (label.to_string(), rational(*v))).collect()
}

/// Whether `tr(ad_j) = c^i_ji` vanishes for all j.
fn unimodular(algebra: &LieAlgebra<Rational>) -> bool {
    let n = algebra.dimension();
    let trace =
        |j| (0..n).fold(rational(0), |sum, i| sum + algebra.structure_constants().get(&[i, j, i]));
    (0..n).all(|j| trace(j) == rational(0))
}

/// The inertia (plus, minus, zero) of a symmetric form, by congruence (Sylvester).
fn inertia(form: &Tensor<Rational>) -> (usize, usize, usize) {
    let n = form.dimension();
    let mut m: Vec<Vec<Rational>> =
        (0..n).map(|i| (0..n).map(|j| form.get(&[i, j])).collect()).collect();
    let (mut plus, mut minus) = (0, 0);
    let zero = rational(0);
    while !m.is_empty() {
        let size = m.len();
        let pivot = (0..size).find(|&i| m[i][i] != zero).or_else(|| {
            let (i, j) = (0..size)
                .flat_map(|i| (0..size).map(move |j| (i, j)))
                .find(|&(i, j)| m[i][j] != zero)?;
            // e_i + e_j is not null, because e_i and e_j are
            let other = m[j].clone();
            for (value, added) in m[i].iter_mut().zip(&other) {
                *value = value.clone() + added;
            }
            for row in m.iter_mut() {
                row[i] = row[i].clone() + &row[j].clone();
            }
            Some(i)
        });
        let Some(p) = pivot else { break };
        let d = m[p][p].clone();
        if d > zero {
            plus += 1
        } else {
            minus += 1
        }
        let row = m.remove(p);
        for other in &mut m {
            let factor = other[p].clone() / &d;
            for (value, below) in other.iter_mut().zip(&row) {
                *value = value.clone() - &(factor.clone() * below);
            }
            other.remove(p);
        }
    }
    (plus, minus, n - plus - minus)
}

/// A symmetric form with these values on and above the diagonal, by label.
fn form(algebra: &LieAlgebra<Rational>, values: impl Fn(&str, &str) -> i64) -> Tensor<Rational> {
    let labels = algebra.labels();
    Tensor::from_fn(labels.len(), [Down, Down], |[i, j]| rational(values(&labels[i], &labels[j])))
        .unwrap()
}

#[test]
fn dimensions_are_those_of_the_closed_forms() {
    let mut rows: Vec<(String, usize)> = Vec::new();
    for n in 1..8 {
        rows.push((format!("R^{n}"), n));
        rows.push((format!("gl({n})"), n * n));
        rows.push((format!("aff({n})"), n * (n + 1)));
        rows.push((format!("sp({})", 2 * n), n * (2 * n + 1)));
        rows.push((format!("heisenberg({})", 2 * n + 1), 2 * n + 1));
    }
    for n in 2..8 {
        rows.push((format!("so({n})"), n * (n - 1) / 2));
        rows.push((format!("su({n})"), n * n - 1));
        rows.push((format!("sl({n})"), n * n - 1));
        rows.push((format!("se({n})"), n * (n + 1) / 2));
        rows.extend((1..n).map(|p| (format!("so({p},{})", n - p), n * (n - 1) / 2)));
    }
    let others = "A1 3, A6 48, B3 21, C4 36, D5 45, E6 78, E7 133, E8 248, F4 52, G2 14, \
        bianchi(I) 3, bianchi(II) 3, bianchi(III) 3, bianchi(IV) 3, bianchi(V) 3, bianchi(VIII) 3, \
        bianchi(IX) 3, bianchi(VI,h=-1/2) 3, bianchi(VI,h=-1) 3, bianchi(VI,h=0) 3, \
        bianchi(VI,h=1) 3, bianchi(VI,h=7) 3, bianchi(VII,h=0) 3, bianchi(VII,h=1/3) 3";
    rows.extend(others.split(", ").map(|row| {
        let (name, dimension) = row.split_once(' ').unwrap();
        (name.to_string(), dimension.parse().unwrap())
    }));
    for (name, dimension) in rows {
        let entry = catalogue::find(&name).unwrap();
        assert_eq!(entry.name, name);
        assert_eq!(entry.dimension(), dimension, "{name}");
        assert_eq!(algebra(&name).dimension(), dimension, "{name}");
    }
}

#[test]
fn so3_su2_and_bianchi_ix_have_the_same_constants() {
    let so3 = algebra("so(3)");
    for (x, y, z) in [("e1", "e2", "e3"), ("e2", "e3", "e1"), ("e3", "e1", "e2")] {
        assert_eq!(bracket(&so3, x, y), combination(&[(z, 1)]));
    }
    assert_eq!(so3.structure_constants(), algebra("su(2)").structure_constants());
    assert_eq!(so3.structure_constants(), algebra("bianchi(IX)").structure_constants());
    assert_eq!(so3.killing_form(), form(&so3, |x, y| if x == y { -2 } else { 0 }));
}

/// With `M_ij = E_ij - η_i η_j E_ji`: `[M_ij, M_jk] = M_ik`, `M_ji = -η_i η_j M_ij`, and disjoint
/// pairs commute.
#[test]
fn so_pq_has_the_brackets_of_its_planes() {
    for (p, q) in [(4, 0), (5, 0), (6, 0), (3, 1), (1, 3), (2, 2), (4, 2)] {
        let n: usize = p + q;
        let name = if q == 0 { format!("so({n})") } else { format!("so({p},{q})") };
        let algebra = algebra(&name);
        let eta = |i: usize| if i < p { 1 } else { -1 };
        let planes: Vec<_> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).rev().collect();
        // M_ij as a multiple of a basis vector
        let plane = |i: usize, j: usize| {
            let at = planes.iter().position(|&at| at == (i.min(j), i.max(j))).unwrap();
            let turned = if i < j { 1 } else { -eta(i) * eta(j) };
            (at, turned * [1, -1][(i + j) % 2])
        };
        let mut seen = 0;
        for (x, &(i, j)) in planes.iter().enumerate() {
            for (y, &(k, l)) in planes.iter().enumerate() {
                let mut expected = vec![rational(0); planes.len()];
                // orient both planes so that they are (a,b) and (b,c)
                let meeting = [(i, j, k, l), (i, j, l, k), (j, i, k, l), (j, i, l, k)];
                if x != y
                    && let Some(&(a, b, _, c)) = meeting.iter().find(|(_, b, k, _)| b == k)
                {
                    let ((_, s), (_, t), (z, u)) = (plane(a, b), plane(b, c), plane(a, c));
                    expected[z] = rational(s * t * u);
                    seen += 1;
                }
                let found: Vec<_> = (0..planes.len())
                    .map(|z| algebra.structure_constants().get(&[z, x, y]))
                    .collect();
                assert_eq!(found, expected, "{name}: {x} {y}");
            }
        }
        assert_eq!(seen, n * (n - 1) * (n - 2));

        // K = (n - 2) tr(XY)
        let killing = algebra.killing_form();
        let expected = Tensor::from_fn(planes.len(), [Down, Down], |[x, y]| {
            let (i, j) = planes[x];
            rational(if x == y { -2 * (n as i64 - 2) * eta(i) * eta(j) } else { 0 })
        });
        assert_eq!(killing, expected.unwrap(), "{name}");
        let noncompact = p * q;
        assert_eq!(inertia(&killing), (noncompact, planes.len() - noncompact, 0), "{name}");
    }
}

/// `[E_ij, E_kl] = δ_jk E_il - δ_li E_kj`, and `K(X,Y) = 2n tr(XY) - 2 tr X tr Y`.
#[test]
fn gl_has_the_brackets_of_the_matrix_units() {
    for n in [1, 2, 3, 4] {
        let gl = algebra(&format!("gl({n})"));
        let unit = |at: usize| (at / n, at % n);
        for (x, y, z) in (0..n * n)
            .flat_map(|x| (0..n * n).flat_map(move |y| (0..n * n).map(move |z| (x, y, z))))
        {
            let ((i, j), (k, l)) = (unit(x), unit(y));
            let is = |condition: bool| i64::from(condition);
            let expected = is(j == k && unit(z) == (i, l)) - is(l == i && unit(z) == (k, j));
            assert_eq!(gl.structure_constants().get(&[z, x, y]), rational(expected));
        }
        let killing = Tensor::from_fn(n * n, [Down, Down], |[x, y]| {
            let ((i, j), (k, l)) = (unit(x), unit(y));
            let [trace, both] = [(i == l && j == k), (i == j && k == l)].map(i64::from);
            rational(2 * n as i64 * trace - 2 * both)
        });
        assert_eq!(gl.killing_form(), killing.unwrap());
    }
}

/// `K = 2n tr(XY)`: 2n on the pairs `E_ij, E_ji`, 2n times the Cartan matrix on the H.
#[test]
fn sl_and_su_have_the_killing_form_of_the_trace() {
    let cartan = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 2,
        1 => -1,
        _ => 0,
    };
    for n in [2, 3, 4, 5] {
        let units = n * (n - 1);
        let sl = algebra(&format!("sl({n})"));
        let size = 2 * n as i64;
        let expected = Tensor::from_fn(n * n - 1, [Down, Down], |[x, y]| {
            rational(
                size * match (x.checked_sub(units), y.checked_sub(units)) {
                    (Some(i), Some(j)) => cartan(i, j),
                    (None, None) => i64::from(x.abs_diff(y) == units / 2),
                    _ => 0,
                },
            )
        });
        assert_eq!(sl.killing_form(), expected.unwrap());
        assert_eq!(bracket(&sl, "E12", "E21"), combination(&[("H1", 1)]));
        assert_eq!(bracket(&sl, "H1", "E12"), combination(&[("E12", 2)]));

        // generators are -i/2 times a matrix; the square has the trace -1/2
        let su = algebra(&format!("su({n})"));
        let expected = Tensor::from_fn(n * n - 1, [Down, Down], |[x, y]| {
            let twice = match (x.checked_sub(units), y.checked_sub(units)) {
                (Some(i), Some(j)) => cartan(i, j),
                (None, None) => 2 * i64::from(x == y),
                _ => 0,
            };
            Rational::new(-(n as i64) * twice, 2).unwrap()
        });
        assert_eq!(su.killing_form(), expected.unwrap());
        assert_eq!(inertia(&su.killing_form()), (0, n * n - 1, 0));
    }
}

/// `K = (2n+2) tr(XY)`.
#[test]
fn sp_has_the_killing_form_of_the_trace() {
    for n in [1, 2, 3] {
        let sp = algebra(&format!("sp({})", 2 * n));
        let expected = form(&sp, |x, y| {
            let (a, b) = (x.as_bytes(), y.as_bytes());
            let trace = match (a[0], b[0]) {
                (b'A', b'A') if (a[1], a[2]) == (b[2], b[1]) => 2,
                (b'B', b'C') | (b'C', b'B') if a[1..] == b[1..] => {
                    if a[1] == a[2] {
                        1
                    } else {
                        2
                    }
                }
                _ => 0,
            };
            (2 * n + 2) * trace
        });
        assert_eq!(sp.killing_form(), expected);
    }
    let sp2 = algebra("sp2");
    assert_eq!(bracket(&sp2, "B11", "C11"), combination(&[("A11", 1)]));
    assert_eq!(bracket(&sp2, "A11", "B11"), combination(&[("B11", 2)]));
}

/// The translations are null; rotations have `(n - 2) tr(XY)` from so(n) and `tr(XY)` from R^n.
#[test]
fn se_is_a_semidirect_sum() {
    for n in [2, 3, 4] {
        let se = algebra(&format!("se({n})"));
        let expected =
            form(&se, |x, y| if x == y && x.starts_with('e') { -2 * (n - 1) } else { 0 });
        assert_eq!(se.killing_form(), expected);
    }
    let se3 = algebra("se(3)");
    for (x, y, z) in [(1, 2, 3), (2, 3, 1), (3, 1, 2)] {
        let [e, p] = ["e", "p"].map(|letter| move |i: i32| format!("{letter}{i}"));
        assert_eq!(bracket(&se3, &e(x), &e(y)), combination(&[(&e(z), 1)]));
        assert_eq!(bracket(&se3, &e(x), &p(y)), combination(&[(&p(z), 1)]));
        assert_eq!(bracket(&se3, &e(x), &p(x)), combination(&[]));
        assert_eq!(bracket(&se3, &p(x), &p(y)), combination(&[]));
    }
}

#[test]
fn heisenberg_r_n_and_aff_have_the_brackets_of_their_definition() {
    let h5 = algebra("heisenberg(5)");
    assert_eq!(h5.labels().join(" "), "x1 x2 y1 y2 z");
    assert_eq!(bracket(&h5, "x1", "y1"), combination(&[("z", 1)]));
    assert_eq!(bracket(&h5, "x2", "y2"), combination(&[("z", 1)]));
    assert_eq!(h5.structure_constants().len(), 4);
    assert!(h5.killing_form().is_empty());
    assert!(algebra("R^4").structure_constants().is_empty());
    let aff = algebra("aff(1)");
    assert_eq!(bracket(&aff, "x", "y"), combination(&[("y", 1)]));
    // ad_x = diag(0, 1)
    assert_eq!(aff.killing_form(), form(&aff, |x, y| i64::from(x == "x" && y == "x")));
    let aff = algebra("aff(2)");
    assert_eq!(aff.labels().join(" "), "E11 E12 E21 E22 p1 p2");
    assert_eq!(bracket(&aff, "E12", "E21"), combination(&[("E11", 1), ("E22", -1)]));
    assert_eq!(bracket(&aff, "E12", "p2"), combination(&[("p1", 1)]));
    assert!(bracket(&aff, "E12", "p1").is_empty() && bracket(&aff, "p1", "p2").is_empty());
}

/// On a Chevalley basis `K(h_i,h_j) = 2 h^∨ (α_i^∨, α_j^∨)` and `K(e_α, f_α) = h^∨ (α^∨, α^∨)`, all
/// else zero, where long roots have squared length 2 (Bourbaki, Lie VI, 1.12 and plates I-IX).
#[test]
fn simple_types_have_the_killing_form_of_their_dual_coxeter_number() {
    use Series::{A, B, C, D, E, F, G};
    let rows = [
        (A, 1, 2),
        (A, 2, 3),
        (A, 5, 6),
        (B, 2, 3),
        (B, 4, 7),
        (C, 2, 3),
        (C, 3, 4),
        (C, 4, 5),
        (D, 3, 4),
        (D, 4, 6),
        (D, 6, 10),
        (E, 6, 12),
        (E, 7, 18),
        (E, 8, 30),
        (F, 4, 9),
        (G, 2, 4),
    ];
    for (series, rank, coxeter) in rows {
        let kind = CartanType::new(series, rank).unwrap();
        let roots = RootSystem::new(kind);
        let positive = roots.positive_roots();
        let count = positive.len();
        let longest = positive.iter().map(|root| root.squared_length()).max().unwrap();
        // 2 (long, long) / (α, α), the coroot's squared length over 2
        let ratio = |at: usize| longest / positive[at].squared_length();
        let cartan = kind.cartan_matrix();
        let expected = Tensor::from_fn(kind.dimension(), [Down, Down], |[x, y]| {
            let value = match (x.checked_sub(2 * count), y.checked_sub(2 * count)) {
                (Some(i), Some(j)) => 2 * cartan[i][j] * ratio(i),
                (None, None) if x.abs_diff(y) == count => 2 * ratio(x.min(y)),
                _ => 0,
            };
            rational(coxeter * value)
        });
        let name = kind.to_string();
        assert_eq!(algebra(&name).killing_form(), expected.unwrap(), "{name}");
    }
}

#[test]
fn unimodular_or_not() {
    let yes = "R^3 so(5) so(3,1) su(3) sl(3) gl(3) sp(4) se(2) se(3) heisenberg(5) A2 B2 G2 \
        bianchi(I) bianchi(II) bianchi(VI,h=-1) bianchi(VII,h=0) bianchi(VIII) bianchi(IX)";
    let no = "aff(1) aff(2) aff(3) bianchi(III) bianchi(IV) bianchi(V) bianchi(VI,h=-1/2) bianchi(VI,h=3) \
        bianchi(VII,h=1/2)";
    for (names, expected) in [(yes, true), (no, false)] {
        for name in names.split_whitespace() {
            assert_eq!(unimodular(&algebra(name)), expected, "{name}");
        }
    }
}

#[test]
fn killing_forms_tell_the_real_forms_apart() {
    let rows = "\
        sl(2) so(2,1) so(1,2) bianchi(VIII) sp(2) A1: 2 1 0
        bianchi(IX) so(3) su(2): 0 3 0
        sl(3) A2: 5 3 0
        sp(4) so(3,2) so(2,3) B2 C2: 6 4 0
        sl(4) so(3,3) A3 D3: 9 6 0
        so(3,1) so(1,3): 3 3 0
        G2: 8 6 0
        F4: 28 24 0
        gl(2): 2 1 1
        R^3 heisenberg(3) bianchi(I) bianchi(II) bianchi(VII,h=1): 0 0 3
        aff(1): 1 0 1
        se(3): 0 3 3
        se(2) bianchi(VII,h=0): 0 1 2
        bianchi(III) bianchi(IV) bianchi(V) bianchi(VI,h=3) bianchi(VII,h=2): 1 0 2";
    for row in rows.lines() {
        let (names, numbers) = row.split_once(": ").unwrap();
        for name in names.split_whitespace() {
            let (plus, minus, zero) = inertia(&algebra(name).killing_form());
            assert_eq!(format!("{plus} {minus} {zero}"), numbers, "{name}");
        }
    }
}

/// An algebra, the vectors `e'_a` over its basis, and the algebra that they make it.
#[test]
fn isomorphisms_of_low_dimension() {
    let aff_and_line = algebra("aff(1)").direct_sum(&algebra("R^1"));
    let rows = [
        // e1 = z, e2 = x, e3 = y
        (algebra("heisenberg(3)"), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "bianchi(II)"),
        // e1, e2 = p1, p2, and e3 turns them
        (algebra("se(2)"), [[0, 1, 0], [0, 0, 1], [1, 0, 0]], "bianchi(VII,h=0)"),
        // e1 = y, e2 central, e3 = -x
        (aff_and_line.unwrap(), [[0, 1, 0], [0, 0, 1], [-1, 0, 0]], "bianchi(III)"),
        (algebra("bianchi(VI,h=0)"), [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "bianchi(III)"),
        (algebra("bianchi(VI,h=-1)"), [[0, 1, 0], [1, 0, 0], [0, 0, -1]], "bianchi(VI,h=-1)"),
        (algebra("sl(2)"), [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "A1"),
        // e, f, h = B, C, A
        (algebra("sp(2)"), [[0, 1, 0], [0, 0, 1], [1, 0, 0]], "A1"),
        // e, f, h = e1 + e3, e1 - e3, 2 e2
        (algebra("bianchi(VIII)"), [[1, 0, 1], [1, 0, -1], [0, 2, 0]], "sl(2)"),
    ];
    for (from, vectors, to) in rows {
        let matrix = Tensor::from_fn(3, [Up, Down], |[i, a]| rational(vectors[a][i])).unwrap();
        let change = BasisChange::new(matrix).unwrap();
        let changed = from.change_basis(&change).unwrap();
        assert_eq!(changed.structure_constants(), algebra(to).structure_constants(), "{to}");
    }
}

/// `n^mi = 1/2 eps^jkm c^i_jk - eps^jim a_j` and `a_j = 1/2 c^i_ji`, and the class from them:
/// `a_i a_j = h_EM adj(n)_ij` (Ellis and MacCallum).
#[test]
fn bianchi_types_are_what_ellis_and_maccallum_say() {
    // the inertia of n up to its sign (larger number first), whether a = 0, and h_EM if it exists
    let rows = [
        ("bianchi(I)", (0, 0), true, None),
        ("bianchi(II)", (1, 0), true, None),
        ("bianchi(III)", (1, 1), false, Some((-1, 1))),
        ("bianchi(IV)", (1, 0), false, None),
        ("bianchi(V)", (0, 0), false, None),
        ("bianchi(VI,h=-1)", (1, 1), true, Some((0, 1))),
        ("bianchi(VI,h=-1/2)", (1, 1), false, Some((-1, 9))),
        ("bianchi(VI,h=-2)", (1, 1), false, Some((-1, 9))),
        ("bianchi(VI,h=3)", (1, 1), false, Some((-4, 1))),
        ("bianchi(VI,h=0)", (1, 1), false, Some((-1, 1))),
        ("bianchi(VI,h=1)", (0, 0), false, None),
        ("bianchi(VII,h=0)", (2, 0), true, Some((0, 1))),
        ("bianchi(VII,h=-2/3)", (2, 0), false, Some((4, 9))),
        ("bianchi(VIII)", (2, 1), true, Some((0, 1))),
        ("bianchi(IX)", (3, 0), true, Some((0, 1))),
    ];
    for (name, signature, class_a, h) in rows {
        let algebra = algebra(name);
        let c = algebra.structure_constants();
        let half = Rational::new(1, 2).unwrap();
        let sum = |terms: Vec<Rational>| terms.into_iter().fold(rational(0), |sum, v| sum + &v);
        let eps = |i: usize, j: usize, k: usize| {
            let [i, j, k] = [i, j, k].map(|i| i as i64);
            rational((j - i) * (k - j) * (k - i) / 2)
        };
        let a: Vec<_> = (0..3)
            .map(|j| half.clone() * &sum((0..3).map(|i| c.get(&[i, j, i])).collect()))
            .collect();
        let n = |m: usize, i: usize| {
            let structure =
                (0..9).map(|at| eps(at / 3, at % 3, m) * &c.get(&[i, at / 3, at % 3]) * &half);
            let vector = (0..3).map(|j| -(eps(j, i, m) * &a[j]));
            sum(structure.chain(vector).collect())
        };
        let matrix = Tensor::from_fn(3, [Down, Down], |[m, i]| n(m, i)).unwrap();
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            assert_eq!(n(i, j), n(j, i), "{name}");
            let (k, l) = ((i + 1) % 3, (i + 2) % 3);
            let (p, q) = ((j + 1) % 3, (j + 2) % 3);
            let adjugate = n(k, p) * &n(l, q) - &(n(k, q) * &n(l, p));
            match h {
                Some((p, q)) => assert_eq!(
                    a[i].clone() * &a[j],
                    adjugate * &Rational::new(p, q).unwrap(),
                    "{name}"
                ),
                None => assert_eq!(adjugate, rational(0), "{name}"),
            }
            let n_a = (0..3).map(|j| n(i, j) * &a[j]);
            assert_eq!(sum(n_a.collect()), rational(0), "{name}");
        }
        let (plus, minus, _) = inertia(&matrix);
        assert_eq!((plus.max(minus), plus.min(minus)), signature, "{name}");
        assert_eq!(a.iter().all(|v| *v == rational(0)), class_a, "{name}");
    }
}

#[test]
fn the_parameter_h_may_stay_a_symbol() {
    let six = catalogue::find("bianchi(VI)").unwrap();
    assert_eq!(six.parameters, ["h"]);
    let h = Symbolic::parameter("h");
    assert_eq!(symbolic("bianchi(VI)").structure_constants().get(&[1, 1, 2]), h);
    assert_eq!(symbolic("bianchi(VII)").structure_constants().get(&[0, 0, 2]), h);
    assert_eq!(catalogue::find("bianchi(VI, h = (a + 1)/b)").unwrap().parameters, ["a", "b"]);
    assert!(six.bracket(exact).is_err());
    for name in ["bianchi(I)", "so(3)", "A2"] {
        assert!(catalogue::find(name).unwrap().parameters.is_empty());
    }
}

#[test]
fn only_families_of_matrices_carry_matrices() {
    // so(n): <L, L'> = 2 delta
    let so4 = catalogue::find("so(4)").unwrap().matrices.unwrap().frobenius();
    assert_eq!(
        so4,
        Tensor::from_fn(6, [Down, Down], |[i, j]| rational(2 * i64::from(i == j))).unwrap()
    );
    for name in ["so(3,1)", "su(3)", "sl(3)", "gl(2)", "sp(4)", "se(3)", "heisenberg(5)", "aff(1)"]
    {
        assert!(catalogue::find(name).unwrap().matrices.is_some(), "{name}");
    }
    for name in ["R^3", "bianchi(II)", "A2"] {
        assert!(catalogue::find(name).unwrap().matrices.is_none(), "{name}");
    }
}

#[test]
fn every_family_has_a_working_example() {
    for family in catalogue::families() {
        let entry = catalogue::find(family.example).unwrap();
        assert_eq!(entry.name, family.example);
        assert!(family.pattern.starts_with(&family.example[..1]));
    }
}
