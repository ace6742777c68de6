//! Dimensions that are proved over the rationals agree with the ranks of the same equations over
//! the rationals.

use crate::algebra::structure::{scrambled, stored};
use crate::common::algebras::catalogued;
use affinor::algebra::structure::StructureTheory;
use affinor::{LieAlgebra, Rational};
use affinor_tensors::linear::Matrix;

type Algebra = LieAlgebra<Rational>;

/// The unknowns by position, and the rank of the equations over the rationals.
struct Equations {
    unknowns: usize,
    rows: Vec<Vec<Rational>>,
}

impl Equations {
    fn row(&mut self, terms: impl IntoIterator<Item = (usize, Rational)>) {
        let mut row = vec![Rational::from(0); self.unknowns];
        terms.into_iter().for_each(|(at, value)| {
            row[at] = row[at].clone() + &value;
        });
        self.rows.push(row);
    }

    fn solutions(&self) -> usize {
        self.unknowns - Matrix::from_dense(&self.rows).unwrap().rank().unwrap()
    }
}

/// The derivations and the invariant symmetric forms, from their definitions.
fn by_definition(algebra: &Algebra) -> [usize; 2] {
    let n = algebra.dimension();
    let c = |i: usize, j: usize, k: usize| algebra.structure_constants().get(&[i, j, k]);
    let mut maps = Equations { unknowns: n * n, rows: vec![] };
    let mut forms = Equations { unknowns: n * (n + 1) / 2, rows: vec![] };
    let pair = |a: usize, b: usize| a.max(b) * (a.max(b) + 1) / 2 + a.min(b);
    for (i, j, k) in (0..n * n * n).map(|at| (at / n / n, at / n % n, at % n)) {
        maps.row((0..n).flat_map(|m| {
            [(i * n + m, c(m, j, k)), (m * n + j, -c(i, m, k)), (m * n + k, -c(i, j, m))]
        }));
        forms.row((0..n).flat_map(|m| [(pair(m, k), c(m, i, j)), (pair(j, m), c(m, i, k))]));
    }
    [maps.solutions(), forms.solutions()]
}

#[test]
fn proved_dimensions_are_those_over_the_rationals() {
    let stored: Vec<Algebra> = stored().into_iter().map(|(algebra, _)| algebra).collect();
    let low = stored.iter().filter(|algebra| (2..=5).contains(&algebra.dimension()));
    let mut seen = 0;
    for algebra in low.flat_map(|algebra| [algebra.clone(), scrambled(algebra, 7)]) {
        let structure = StructureTheory::new(algebra.clone());
        let counted = [structure.derivation_dimension(), structure.invariant_form_dimension()]
            .map(Option::unwrap);
        assert_eq!(counted.map(|all| all.dimension), by_definition(&algebra));
        assert!(counted.iter().all(|all| all.proved), "{:?}", algebra.structure_constants());
        assert!(structure.betti_numbers().unwrap().1, "{:?}", algebra.structure_constants());
        assert!(structure.index().proved, "{:?}", algebra.structure_constants());
        seen += 1;
    }
    assert!(seen > 40, "{seen}");
}

#[test]
fn proved_in_the_catalogue() {
    // index: se(3), iso(3,1) (mass and spin, 2), filiform algebras n - 2 by an abelian ideal, E6
    // its rank
    for (name, index) in
        [("se(3)", 2), ("iso(3,1)", 2), ("filiform(9)", 7), ("E6", 6), ("heisenberg(9)", 1)]
    {
        let counted = StructureTheory::new(catalogued(name)).index();
        assert_eq!((counted.dimension, counted.proved), (index, true), "{name}");
    }
    for name in ["se(3)", "filiform(9)", "heisenberg(9)", "gl(3)", "t(3)", "iso(3,1)"] {
        let structure = StructureTheory::new(catalogued(name));
        assert!(structure.derivation_dimension().unwrap().proved, "{name}");
        assert!(structure.invariant_form_dimension().unwrap().proved, "{name}");
        assert!(structure.betti_numbers().unwrap().1, "{name}");
    }
}

/// Betti numbers modulo primes, in dimensions in which closed forms are not multiplied out. For a
/// product of groups they are products of polynomials. For Heisenberg groups they are `C(2m,k) -
/// C(2m,k-2)` up to the middle degree (L. J. Santharoubane, *Proc. Amer. Math. Soc.* 87 (1983)
/// 23-28).
#[test]
fn betti_numbers_of_higher_dimension() {
    let betti = |name: &str| StructureTheory::new(catalogued(name)).betti_numbers().unwrap();
    let product = |a: &[u64], b: &[u64]| {
        let mut product = vec![0; a.len() + b.len() - 1];
        for (i, j) in (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j))) {
            product[i + j] += a[i] * b[j];
        }
        product
    };
    for (first, second) in [
        ("heisenberg(7)", "filiform(6)"),
        ("filiform(5)", "degraaf(5,6)+aff(1)"),
        ("se(3)", "t(3)"),
        ("free_nilpotent(2,3)", "free_nilpotent(3,2)+R^1"),
    ] {
        let (sum, _) = betti(&format!("{first}+{second}"));
        assert_eq!(sum, product(&betti(first).0, &betti(second).0), "{first}+{second}");
    }
    let binomial = |n: u64, k: u64| (0..k).fold(1, |value, i| value * (n - i) / (i + 1));
    let m = 6;
    let of = |k: u64| binomial(2 * m, k) - k.checked_sub(2).map_or(0, |k| binomial(2 * m, k));
    let mut expected: Vec<u64> = (0..=m).map(of).collect();
    expected.extend(expected.clone().iter().rev());
    assert_eq!(betti("heisenberg(13)"), (expected, false));
}

/// Reductive algebras whose dimension is beyond the limit of the equations. A derivation is inner but for the maps of the
/// centre. An invariant form is a multiple of the Killing form on each simple ideal, and any symmetric form on the centre.
#[test]
fn reductive_algebras_of_large_dimensions() {
    for (name, derivations, forms) in
        [("sl(6)", 35, 1), ("sl(6)+R^1", 36, 2), ("sl(6)+R^3", 44, 7), ("so(8)+sl(2)+R^2", 35, 5)]
    {
        let structure = StructureTheory::new(catalogued(name));
        assert_eq!(structure.derivation_dimension().unwrap().dimension, derivations, "{name}");
        assert_eq!(structure.invariant_form_dimension().unwrap().dimension, forms, "{name}");
    }
}

/// The cohomology of a reductive algebra is that of a product of spheres of odd dimensions (H. Hopf, *Ann. of Math.* 42 (1941)
/// 22-52), in small dimensions by linear algebra and in large ones by the exponents of the type.
#[test]
fn reductive_algebras_have_the_cohomology_of_spheres() {
    let cases: [(&str, &[usize]); 6] = [
        ("sl(2)+R^2", &[1, 1, 3]),
        ("sl(3)+R^1", &[1, 3, 5]),
        ("sl(3)+sl(2)+R^1", &[1, 3, 3, 5]),
        ("so(5)+sl(2)", &[3, 3, 7]),
        ("G2", &[3, 11]),
        ("sl(4)", &[3, 5, 7]),
    ];
    for (name, spheres) in cases {
        let structure = StructureTheory::new(catalogued(name));
        let mut expected = vec![0; structure.dimension() + 1];
        for set in 0..1_usize << spheres.len() {
            let chosen = spheres.iter().enumerate().filter(|(at, _)| set >> at & 1 == 1);
            expected[chosen.map(|(_, sphere)| sphere).sum::<usize>()] += 1;
        }
        assert_eq!(structure.betti_numbers(), Some((expected, true)), "{name}");
    }
}
