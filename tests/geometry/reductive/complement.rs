//! Reductive complements where the Killing form is degenerate on the isotropy algebra.

use crate::common::algebras::catalogued;
use crate::common::integer;
use affinor::{Error, Law, ReductivePair};
use affinor_tensors::Rational;

type Pair = ReductivePair<Rational>;

fn unit(n: usize, at: usize) -> Vec<Rational> {
    (0..n).map(|i| integer((i == at) as i64)).collect()
}

/// The brackets of the nilpotent and solvable algebras decide which lines have a complement. A line of
/// the Heisenberg algebra has one, an ideal that is not a summand has none.
#[test]
fn lines_with_and_without_a_complement() {
    // [e1, e2] = e3
    let heisenberg = catalogued("heisenberg(3)");
    for at in 0..3 {
        let h = [unit(3, at)];
        let m = Pair::complement(&heisenberg, &h).unwrap();
        assert_eq!(Pair::new(&heisenberg, &h, &m).unwrap().dimension(), 2);
    }
    // translations of the motions of space: [translation, rotation] is a translation
    let motions = catalogued("se(3)");
    let abelian = |h: &[Vec<Rational>]| {
        let bracket = |x: &Vec<Rational>, y: &Vec<Rational>| motions.bracket(x, y).unwrap();
        h.iter().all(|x| h.iter().all(|y| bracket(x, y).iter().all(|v| *v == integer(0))))
    };
    let blocks = [0..3, 3..6].map(|range| range.map(|at| unit(6, at)).collect::<Vec<_>>());
    let translations = blocks.iter().find(|h| abelian(h)).unwrap();
    let rotations = blocks.iter().find(|h| !abelian(h)).unwrap();
    let refused = Pair::complement(&motions, translations).unwrap_err();
    assert!(matches!(refused, Error::Broken { law: Law::Reductive, .. }), "{refused}");
    assert!(
        refused.to_string().starts_with("no complement of h is invariant under h"),
        "{refused}"
    );
    let m = Pair::complement(&motions, rotations).unwrap();
    assert!(Pair::new(&motions, rotations, &m).unwrap().is_symmetric());
}

/// A nilpotent direction of sl(2) has no complement, a line of the Euclidean plane has one.
#[test]
fn a_complement_exists_exactly_if_the_equations_have_a_solution() {
    let sl2 = catalogued("sl(2)");
    let killing = sl2.killing_form();
    let null = (0..3).find(|at| killing.get(&[*at, *at]) == integer(0)).unwrap();
    let refused = Pair::complement(&sl2, &[unit(3, null)]).unwrap_err();
    assert!(matches!(refused, Error::Broken { law: Law::Reductive, .. }), "{refused}");
    // vectors that do not span a subalgebra, in an algebra whose Killing form vanishes
    let heisenberg = catalogued("heisenberg(3)");
    let refused = Pair::complement(&heisenberg, &[unit(3, 0), unit(3, 1)]).unwrap_err();
    assert!(matches!(refused, Error::Broken { law: Law::ReductiveIsotropy, .. }), "{refused}");
    // the whole algebra is its own isotropy algebra, and the zero algebra has the whole complement
    assert_eq!(Pair::complement(&heisenberg, &[]).unwrap().len(), 3);
}
