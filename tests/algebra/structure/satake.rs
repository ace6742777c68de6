//! Real forms against Helgason, *Differential Geometry, Lie Groups, and Symmetric Spaces*, ch. X,
//! tables V and VI: maximal compact subalgebras, restricted roots, multiplicities and Satake
//! diagrams. The nodes are numbered as in Bourbaki, and as in Onishchik and Vinberg, *Lie Groups and
//! Algebraic Groups*, table 9.

use affinor::algebra::roots::{CartanType, Series};
use affinor::algebra::structure::RealForm;

fn of_type(series: Series, rank: usize) -> CartanType {
    CartanType::new(series, rank).unwrap()
}

/// The restricted type, with `None` for A0 and the isomorphic names of low rank.
fn check(form: &RealForm, restricted: &str, multiplicities: &[usize], compact: usize) {
    let name = &form.name;
    assert_eq!(form.compact_dimension, compact, "{name}");
    let dimension = form.cartan_type.dimension();
    assert_eq!(form.character(), (dimension - compact) as i64 - compact as i64, "{name}");
    assert_eq!(
        form.restricted_type.map_or(String::new(), |one| one.to_string()),
        restricted,
        "{name}"
    );
    let found: Vec<usize> = form.multiplicities.iter().map(|(_, m)| *m).collect();
    assert_eq!(found, multiplicities, "{name}");
    // dim p = rank + sum of the multiplicities of the positive restricted roots
    let r = form.real_rank;
    let roots: usize = match (restricted.get(..1), found.len()) {
        (None, _) => 0,
        (_, 1) if restricted.starts_with('A') => r * (r + 1) / 2 * found[0],
        (_, 1) if restricted.starts_with('D') => r * (r - 1) * found[0],
        (_, 1) => {
            let count = [("E6", 36), ("E7", 63), ("E8", 120)];
            let count = count.iter().find(|(name, _)| *name == restricted).unwrap().1;
            count * found[0]
        }
        _ if restricted == "F4" => 12 * (found[0] + found[1]),
        _ if restricted == "G2" => 3 * (found[0] + found[1]),
        _ if restricted == "BC1" => found[0] + found[1],
        _ if restricted.starts_with("BC") => r * found[0] + r * (r - 1) * found[1] + r * found[2],
        _ if restricted.starts_with('B') => r * found[0] + r * (r - 1) * found[1],
        _ => r * (r - 1) * found[0] + r * found[1],
    };
    assert_eq!(dimension - compact, r + roots, "{name}");
    // white nodes without those that arrows join
    assert_eq!(form.cartan_type.rank() - form.black.len() - form.arrows.len(), r, "{name}");
}

/// The black nodes and the arrows of the Satake diagram.
fn check_satake(
    form: &RealForm,
    black: impl IntoIterator<Item = usize>,
    arrows: impl IntoIterator<Item = (usize, usize)>,
) {
    let name = &form.name;
    assert_eq!(form.black, black.into_iter().collect::<Vec<_>>(), "{name}");
    assert_eq!(form.arrows, arrows.into_iter().collect::<Vec<_>>(), "{name}");
}

fn named(series: Series, rank: usize, name: &str) -> RealForm {
    let of = of_type(series, rank);
    RealForm::named(of, name).unwrap_or_else(|| {
        panic!("{name}: {:?}", RealForm::all(of).iter().map(|f| &f.name).collect::<Vec<_>>())
    })
}

/// `A_r`, `B_r` with the short multiplicity first, `C_r`; with the isomorphisms of low rank.
fn b(r: usize, short: usize, long: usize) -> (String, Vec<usize>) {
    match r {
        0 => (String::new(), vec![]),
        1 => ("A1".into(), vec![short]),
        _ => (format!("B{r}"), vec![short, long]),
    }
}

fn c(r: usize, short: usize, long: usize) -> (String, Vec<usize>) {
    match r {
        1 => ("A1".into(), vec![long]),
        // C2 is B2
        2 => ("B2".into(), vec![short, long]),
        _ => (format!("C{r}"), vec![short, long]),
    }
}

fn bc(r: usize, short: usize, middle: usize, long: usize) -> (String, Vec<usize>) {
    let all = if r == 1 { vec![short, long] } else { vec![short, middle, long] };
    (format!("BC{r}"), all)
}

#[test]
fn special_linear_and_unitary_forms() {
    for n in 2..=9 {
        let form = named(Series::A, n - 1, &format!("sl({n},R)"));
        check(&form, &format!("A{}", n - 1), &[1], n * (n - 1) / 2);
        assert!(form.black.is_empty() && form.arrows.is_empty());
        for q in 0..=n / 2 {
            if (n, q) == (2, 1) {
                continue;
            }
            let p = n - q;
            let name = if q == 0 { format!("su({n})") } else { format!("su({p},{q})") };
            let form = named(Series::A, n - 1, &name);
            let (restricted, multiplicities) = match (q, p - q) {
                (0, _) => (String::new(), vec![]),
                (_, 0) => c(q, 2, 1),
                (_, d) => bc(q, 2 * d, 2, 1),
            };
            check(&form, &restricted, &multiplicities, p * p + q * q - 1);
            assert_eq!(form.real_rank, q, "{name}");
            assert_eq!(form.compact_centre, usize::from(q > 0), "{name}");
            // AIII: arrows from both ends, black nodes in the middle
            let arrows = (1..=q).map(|i| (i, n - i)).filter(|(i, j)| i != j);
            check_satake(&form, q + 1..n - q, arrows);
        }
        if n > 2 && n % 2 == 0 {
            let form = named(Series::A, n - 1, &format!("su*({n})"));
            check(&form, &format!("A{}", n / 2 - 1), &[4], n * (n + 1) / 2);
            check_satake(&form, (1..n).step_by(2), []);
        }
    }
}

#[test]
fn orthogonal_forms() {
    let pairs = |n: usize| n * n.saturating_sub(1) / 2;
    for n in 5..=12 {
        if n == 6 {
            continue;
        }
        let (series, rank) = (if n % 2 == 1 { Series::B } else { Series::D }, n / 2);
        for q in 0..=n / 2 {
            let p = n - q;
            let name = if q == 0 { format!("so({n})") } else { format!("so({p},{q})") };
            let form = named(series, rank, &name);
            let (restricted, multiplicities) = match (q, p - q) {
                (q, 0) => (format!("D{q}"), vec![1]),
                (1, d) => ("A1".into(), vec![d]),
                (q, d) => b(q, d, 1),
            };
            check(&form, &restricted, &multiplicities, pairs(p) + pairs(q));
            assert_eq!(form.real_rank, q, "{name}");
            // BI, DI: the black nodes are the last ones
            let is_quasi_split = n % 2 == 0 && q + 1 == rank;
            let black = if is_quasi_split { rank + 1 } else { q + 1 };
            check_satake(&form, black..=rank, is_quasi_split.then_some((rank - 1, rank)));
        }
        if n % 2 == 0 && n > 8 {
            let form = named(Series::D, rank, &format!("so*({n})"));
            let (restricted, multiplicities) = match rank % 2 {
                0 => c(rank / 2, 4, 1),
                _ => bc(rank / 2, 4, 4, 1),
            };
            check(&form, &restricted, &multiplicities, rank * rank);
            assert_eq!(form.compact_type(), format!("A{} + T1", rank - 1));
            // DIII: each second node; for odd rank an arrow
            let black = (1..rank).step_by(2);
            check_satake(&form, black, (rank % 2 == 1).then_some((rank - 1, rank)));
        }
    }
}

#[test]
fn symplectic_forms() {
    for r in 3..=7 {
        let form = named(Series::C, r, &format!("sp({},R)", 2 * r));
        check(&form, &format!("C{r}"), &[1, 1], r * r);
        assert_eq!(form.compact_type(), format!("A{} + T1", r - 1));
        check_satake(&form, [], []);
        for q in 1..=r / 2 {
            let p = r - q;
            let form = named(Series::C, r, &format!("sp({p},{q})"));
            let (restricted, multiplicities) = match p - q {
                0 => c(q, 4, 3),
                d => bc(q, 4 * d, 4, 3),
            };
            check(&form, &restricted, &multiplicities, p * (2 * p + 1) + q * (2 * q + 1));
            // CII: the white nodes are 2, 4, ..., 2q
            check_satake(&form, (1..=r).filter(|i| i % 2 == 1 || *i > 2 * q), []);
        }
    }
}

/// Two real forms of equal type and signature differ by their maximal compact subalgebras.
#[test]
fn forms_of_equal_signature() {
    type Row = (Series, usize, &'static str, &'static str, usize, &'static str, &'static [usize]);
    let rows: [Row; 4] = [
        (Series::A, 13, "su(9,5)", "A4 + A8 + T1", 105, "BC5", &[8, 2, 1]),
        (Series::A, 13, "su*(14)", "C7", 105, "A6", &[4]),
        (Series::D, 9, "so(12,6)", "A3 + D6", 81, "B6", &[6, 1]),
        (Series::D, 9, "so*(18)", "A8 + T1", 81, "BC4", &[4, 4, 1]),
    ];
    for (series, rank, name, compact, dimension, restricted, multiplicities) in rows {
        let form = named(series, rank, name);
        assert_eq!(form.compact_type(), compact, "{name}");
        check(&form, restricted, multiplicities, dimension);
    }
}

/// A type whose restricted roots have many coordinates.
#[test]
fn large_ranks() {
    let form = named(Series::A, 40, "sl(41,R)");
    check(&form, "A40", &[1], 820);
    check_satake(&form, [], []);
}

/// Cartan's names, the maximal compact subalgebra and its dimension, restricted roots,
/// multiplicities by increasing length, black nodes and arrows.
#[test]
fn exceptional_forms() {
    type Row = (
        &'static str,
        &'static str,
        usize,
        &'static str,
        &'static [usize],
        &'static [usize],
        &'static [(usize, usize)],
    );
    let e6: &[Row] = &[
        ("e6(6)", "C4", 36, "E6", &[1], &[], &[]),
        ("e6(2)", "A1 + A5", 38, "F4", &[2, 1], &[], &[(1, 6), (3, 5)]),
        ("e6(-14)", "D5 + T1", 46, "BC2", &[8, 6, 1], &[3, 4, 5], &[(1, 6)]),
        ("e6(-26)", "F4", 52, "A2", &[8], &[2, 3, 4, 5], &[]),
    ];
    let e7: &[Row] = &[
        ("e7(7)", "A7", 63, "E7", &[1], &[], &[]),
        ("e7(-5)", "A1 + D6", 69, "F4", &[4, 1], &[2, 5, 7], &[]),
        ("e7(-25)", "E6 + T1", 79, "C3", &[8, 1], &[2, 3, 4, 5], &[]),
    ];
    let e8: &[Row] = &[
        ("e8(8)", "D8", 120, "E8", &[1], &[], &[]),
        ("e8(-24)", "A1 + E7", 136, "F4", &[8, 1], &[2, 3, 4, 5], &[]),
    ];
    let f4: &[Row] = &[
        ("f4(4)", "A1 + C3", 24, "F4", &[1, 1], &[], &[]),
        ("f4(-20)", "B4", 36, "BC1", &[8, 7], &[1, 2, 3], &[]),
    ];
    let g2: &[Row] = &[("g2(2)", "A1 + A1", 6, "G2", &[1, 1], &[], &[])];
    for (series, rank, rows) in [
        (Series::E, 6, e6),
        (Series::E, 7, e7),
        (Series::E, 8, e8),
        (Series::F, 4, f4),
        (Series::G, 2, g2),
    ] {
        let all = RealForm::all(of_type(series, rank));
        assert_eq!(all.len(), rows.len() + 1, "{all:?}");
        assert_eq!(all[0].restricted_type, None);
        for &(name, compact, dimension, restricted, multiplicities, black, arrows) in rows {
            let form = named(series, rank, name);
            assert_eq!(form.compact_type(), compact, "{name}");
            check(&form, restricted, multiplicities, dimension);
            assert_eq!((&form.black[..], &form.arrows[..]), (black, arrows), "{name}");
        }
    }
}
