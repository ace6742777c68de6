//! Vogan diagrams against A. W. Knapp, *Lie Groups Beyond an Introduction*, 2nd ed., figures 6.1 and
//! 6.2 and appendix C, in the numbering of Bourbaki.

use crate::algebra::structure::scrambled;
use crate::common::algebras::catalogued;
use affinor::algebra::roots::{CartanType, RootSystem, Series};
use affinor::algebra::structure::{RealForm, StructureTheory};

fn of_type(series: Series, rank: usize) -> CartanType {
    CartanType::new(series, rank).unwrap()
}

/// Checks the diagram of a real form, and its maximal compact subalgebra.
fn check(
    series: Series,
    rank: usize,
    name: &str,
    painted: Option<usize>,
    arrows: &[(usize, usize)],
) {
    let form = RealForm::named(of_type(series, rank), name).unwrap_or_else(|| panic!("{name}"));
    assert_eq!(form.vogan.painted(), painted, "{name}");
    assert_eq!(form.vogan.arrows(), arrows, "{name}");
    assert_eq!(compact_dimension(&form), form.compact_dimension, "{name}");
}

/// The dimension of the maximal compact subalgebra, counted from the diagram. The involution fixes
/// half of each pair of complex roots. A fixed root is noncompact if its coefficient of the painted
/// node is odd. In A_2m with arrows, all fixed roots are noncompact.
fn compact_dimension(form: &RealForm) -> usize {
    let rank = form.cartan_type.rank();
    let mut images: Vec<usize> = (0..rank).collect();
    form.vogan.arrows().iter().for_each(|(i, j)| images.swap(i - 1, j - 1));
    let arrows = form.vogan.arrows().len();
    let is_odd_chain =
        form.cartan_type.series() == Series::A && rank.is_multiple_of(2) && arrows > 0;
    let mut dimension = rank - arrows;
    for root in RootSystem::new(form.cartan_type).positive_roots() {
        let c = root.coefficients();
        let is_fixed = (0..rank).all(|i| c[i] == c[images[i]]);
        let is_noncompact =
            is_odd_chain || form.vogan.painted().is_some_and(|node| c[node - 1] % 2 != 0);
        // a root and its negative; of a pair of complex roots, each is counted with half its pair
        dimension += match (is_fixed, is_noncompact) {
            (false, _) => 1,
            (true, true) => 0,
            (true, false) => 2,
        };
    }
    dimension
}

#[test]
fn special_linear_and_unitary_forms() {
    for n in 2..=9 {
        let flipped: Vec<(usize, usize)> = (1..=(n - 1) / 2).map(|i| (i, n - i)).collect();
        let middle = (n % 2 == 0).then_some(n / 2);
        check(Series::A, n - 1, &format!("sl({n},R)"), middle, &flipped);
        check(Series::A, n - 1, &format!("su({n})"), None, &[]);
        for q in (1..=n / 2).filter(|_| n > 2) {
            check(Series::A, n - 1, &format!("su({},{q})", n - q), Some(q), &[]);
        }
        if n > 2 && n % 2 == 0 {
            check(Series::A, n - 1, &format!("su*({n})"), None, &flipped);
        }
    }
}

#[test]
fn orthogonal_forms() {
    for rank in 2..=7 {
        let n = 2 * rank + 1;
        check(Series::B, rank, &format!("so({n})"), None, &[]);
        for k in 1..=rank {
            // so(2k, n - 2k)
            let (large, small) = (usize::max(2 * k, n - 2 * k), usize::min(2 * k, n - 2 * k));
            check(Series::B, rank, &format!("so({large},{small})"), Some(k), &[]);
        }
    }
    for rank in 4..=8 {
        let n = 2 * rank;
        check(Series::D, rank, &format!("so({n})"), None, &[]);
        for k in 1..=rank / 2 {
            check(Series::D, rank, &format!("so({},{})", n - 2 * k, 2 * k), Some(k), &[]);
        }
        let forked = [(rank - 1, rank)];
        check(Series::D, rank, &format!("so({},1)", n - 1), None, &forked);
        for k in 1..=(rank - 1) / 2 {
            let q = 2 * k + 1;
            check(Series::D, rank, &format!("so({},{q})", n - q), Some(k), &forked);
        }
        if rank > 4 {
            check(Series::D, rank, &format!("so*({n})"), Some(rank), &[]);
        }
    }
}

#[test]
fn symplectic_forms() {
    for rank in 3..=7 {
        check(Series::C, rank, &format!("usp({})", 2 * rank), None, &[]);
        check(Series::C, rank, &format!("sp({},R)", 2 * rank), Some(rank), &[]);
        for q in 1..=rank / 2 {
            check(Series::C, rank, &format!("sp({},{q})", rank - q), Some(q), &[]);
        }
    }
}

/// In Knapp, figure 6.2: E I to E IX, F I, F II and G.
#[test]
fn exceptional_forms() {
    let folded = [(1, 6), (3, 5)];
    check(Series::E, 6, "e6(-78)", None, &[]);
    check(Series::E, 6, "e6(6)", Some(2), &folded);
    check(Series::E, 6, "e6(2)", Some(2), &[]);
    check(Series::E, 6, "e6(-14)", Some(1), &[]);
    check(Series::E, 6, "e6(-26)", None, &folded);
    check(Series::E, 7, "e7(-133)", None, &[]);
    check(Series::E, 7, "e7(7)", Some(2), &[]);
    check(Series::E, 7, "e7(-5)", Some(1), &[]);
    check(Series::E, 7, "e7(-25)", Some(7), &[]);
    check(Series::E, 8, "e8(-248)", None, &[]);
    check(Series::E, 8, "e8(8)", Some(1), &[]);
    check(Series::E, 8, "e8(-24)", Some(8), &[]);
    check(Series::F, 4, "f4(-52)", None, &[]);
    check(Series::F, 4, "f4(4)", Some(1), &[]);
    check(Series::F, 4, "f4(-20)", Some(4), &[]);
    check(Series::G, 2, "g2(-14)", None, &[]);
    check(Series::G, 2, "g2(2)", Some(2), &[]);
}

/// Each diagram with at most one painted node belongs to one real form, so that the diagram
/// identifies the form.
#[test]
fn diagrams_identify_real_forms() {
    for (series, ranks) in [
        (Series::A, 1..8),
        (Series::B, 2..7),
        (Series::C, 3..7),
        (Series::D, 4..8),
        (Series::E, 6..9),
    ] {
        for rank in ranks {
            let forms = RealForm::all(of_type(series, rank));
            assert!(forms[0].vogan.painted().is_none() && forms[0].vogan.arrows().is_empty());
            for (at, form) in forms.iter().enumerate() {
                assert!(forms[..at].iter().all(|other| other.vogan != form.vogan), "{}", form.name);
                assert_eq!(RealForm::named(form.cartan_type, &form.name).as_ref(), Some(form));
            }
        }
    }
}

/// The diagram of an algebra does not depend on its basis.
#[test]
fn diagrams_in_a_dense_basis() {
    type Case = (&'static str, Option<usize>, &'static [(usize, usize)]);
    let cases: [Case; 9] = [
        ("sl(3)", None, &[(1, 2)]),
        ("su(2,1)", Some(1), &[]),
        ("su(3)", None, &[]),
        ("so(4,1)", Some(2), &[]),
        ("so(3,2)", Some(1), &[]),
        ("sp(4,R)", Some(1), &[]),
        ("su*(4)", None, &[(1, 3)]),
        ("so(3,3)", Some(2), &[(1, 3)]),
        ("so*(6)", Some(1), &[]),
    ];
    for (seed, (name, painted, arrows)) in cases.into_iter().enumerate() {
        let algebra = catalogued(name);
        for algebra in [algebra.clone(), scrambled(&algebra, seed as i64)] {
            let ideals = StructureTheory::new(algebra).simple_ideals().unwrap().unwrap();
            let ideal = &ideals.real[0];
            let form = RealForm::named(ideal.cartan_type, &ideal.names[0]).unwrap();
            assert_eq!(
                (form.vogan.painted(), &form.vogan.arrows()[..]),
                (painted, arrows),
                "{name}"
            );
            assert_eq!(compact_dimension(&form), ideal.signature[1], "{name}");
        }
    }
}
