//! Subalgebras by vectors agree with those by names, and others are rejected with a witness.

use crate::representation::common::{algebra, representation};
use affinor::Rational;
use affinor::algebra::roots::Series;
use affinor::algebra::structure::StructureTheory;
use affinor::representation::{
    Decomposition, HighestWeight, MatrixRepresentation, ReductiveAlgebra, RepresentationError,
    Subalgebra,
};
use std::collections::{BTreeMap, BTreeSet};

type Vector = Vec<(usize, Rational)>;

/// A vector such as `e1 + 2 f3`, as pairs of a label and a factor.
fn vector(algebra: &ReductiveAlgebra, terms: &[(&str, i64)]) -> Vector {
    let brackets = algebra.chevalley_algebra().unwrap();
    let at = |label: &str| brackets.labels().iter().position(|own| own == label).unwrap();
    terms.iter().map(|(label, factor)| (at(label), Rational::from(*factor))).collect()
}

/// The subalgebra that vectors generate.
fn generated(algebra: &ReductiveAlgebra, generators: &[&[(&str, i64)]]) -> Vec<Vector> {
    let brackets = algebra.chevalley_algebra().unwrap();
    let n = brackets.dimension();
    let structure = brackets.structure_constants();
    let mut span = affinor::algebra::structure::Subspace::zero(n);
    let mut open: Vec<Vector> = generators.iter().map(|terms| vector(algebra, terms)).collect();
    let first = open.clone();
    while let Some(x) = open.pop() {
        if !span.add(x.clone()) {
            continue;
        }
        for y in &first {
            let mut image = vec![Rational::from(0); n];
            for (at, value) in structure.components() {
                let factor = |v: &Vector, k| {
                    v.iter().filter(|(at, _)| *at == k).map(|(_, value)| value.clone()).next()
                };
                if let (Some(a), Some(b)) = (factor(&x, at[1]), factor(y, at[2])) {
                    image[at[0]] = image[at[0]].clone() + &(a * &b * value);
                }
            }
            let zero = Rational::from(0);
            let row = image.into_iter().enumerate().filter(|(_, value)| *value != zero);
            open.push(row.collect());
        }
    }
    span.basis().to_vec()
}

/// The components with their multiplicities, up to the order of equal factors.
fn branched(subalgebra: &Subalgebra, weight: &str) -> BTreeSet<String> {
    let ambient = subalgebra.ambient();
    let weight = HighestWeight::parse(ambient, weight).unwrap();
    let sum = subalgebra.branch(&weight).unwrap();
    sum.to_string().split(" + ").map(str::to_string).collect()
}

fn of(texts: &[&str]) -> BTreeSet<String> {
    texts.iter().map(|text| text.to_string()).collect()
}

/// Whether the components are the expected ones up to the choices of a subalgebra by vectors. These
/// are the order of equal simple factors, the dual numbering of series A, and the signs of charges.
fn is_renumbered(sum: &Decomposition, expected: &BTreeMap<Vec<i64>, i128>) -> bool {
    let algebra = sum.algebra();
    let factors = algebra.simple_factors();
    let blocks: Vec<Vec<usize>> =
        (0..factors.len()).map(|at| algebra.positions(at).collect()).collect();
    // the positions of labels, and their signs
    let mut choices: Vec<(Vec<usize>, Vec<Vec<usize>>)> = vec![(vec![], vec![])];
    for factor in factors {
        choices = choices
            .into_iter()
            .flat_map(|(used, orders)| {
                let free = (0..factors.len()).filter(|at| !used.contains(at));
                let free: Vec<usize> = free.filter(|at| factors[*at] == *factor).collect();
                free.into_iter()
                    .flat_map(move |at| [false, true].map(|dual| (at, dual)))
                    .filter(|(_, dual)| !dual || factor.series() == Series::A)
                    .map(|(at, dual)| {
                        let mut block = blocks[at].clone();
                        if dual {
                            block.reverse();
                        }
                        ([&used[..], &[at]].concat(), [&orders[..], &[block]].concat())
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
    }
    let rank = algebra.semisimple_rank();
    choices.into_iter().any(|(_, orders)| {
        let order = orders.concat();
        [1, -1].into_iter().any(|sign| {
            let renumbered = |(weight, multiplicity): (&HighestWeight, i128)| {
                let labels = weight.labels();
                let charges = labels[rank..].iter().map(|charge| sign * charge);
                let all = order.iter().map(|at| labels[*at]).chain(charges);
                (all.collect::<Vec<i64>>(), multiplicity)
            };
            sum.components().map(renumbered).collect::<BTreeMap<_, _>>() == *expected
        })
    })
}

#[test]
fn levi_subalgebras_are_found_from_their_generators() {
    let su5 = algebra("SU(5)");
    let generators: [&[(&str, i64)]; 8] = [
        &[("e1", 1)],
        &[("e2", 1)],
        &[("f1", 1)],
        &[("f2", 1)],
        &[("e4", 1)],
        &[("f4", 1)],
        &[("h3", 1)],
        &[("h1", 1)],
    ];
    let vectors = generated(&su5, &generators);
    assert_eq!(vectors.len(), 12);
    let found = Subalgebra::spanned(&su5, vectors).unwrap();
    let levi = Subalgebra::levi(&su5, &[3]).unwrap();
    // the algebras list the factors in another order: A1 + A2 + T1 and A2 + A1 + T1
    let reordered = |weight: &HighestWeight| {
        let [b1, b2, a, charge] = weight.labels()[..] else { panic!("{weight}") };
        vec![a, b1, b2, charge]
    };
    for weight in ["5", "10", "24", "45"] {
        let weight = HighestWeight::parse(&su5, weight).unwrap();
        let [own, other] = [&found, &levi].map(|sub| sub.branch(&weight).unwrap());
        let expected = other.components().map(|(w, m)| (reordered(w), m)).collect();
        assert!(is_renumbered(&own, &expected), "{weight}: {own} and {other}");
    }
    assert_eq!(found.algebra().to_string(), "A1 + A2 + T1");
}

/// Compact subalgebras contain no element with real eigenvalues.
#[test]
fn maximal_compact_subalgebras_of_split_forms() {
    for (name, count, compact, weight, expected) in [
        ("A2", 3, "A1", "3", &["3"][..]),
        ("A3", 6, "A1 + A1", "4", &["(2,2)"]),
        ("A4", 10, "B2", "5", &["5"]),
        ("G2", 6, "A1 + A1", "7", &["(3,1)", "(2,2)"]),
        ("B3", 9, "A1 + A1 + A1", "7", &["(1,1,3)", "(2,2,1)"]),
        ("C2", 4, "A1 + T1", "4", &["2(1)", "2(-1)"]),
        ("F4", 24, "A1 + C3", "26", &["(1,14)", "(2,6)"]),
        ("E6", 36, "C4", "27", &["27"]),
    ] {
        let ambient = algebra(name);
        let vectors =
            (0..count).map(|i| vec![(i, Rational::from(1)), (i + count, Rational::from(-1))]);
        let found = Subalgebra::spanned(&ambient, vectors).unwrap();
        assert_eq!(found.algebra().to_string(), compact, "{name}");
        let weight = HighestWeight::parse(&ambient, weight).unwrap();
        let sum = found.branch(&weight).unwrap();
        let labels = |text: &&str| {
            (HighestWeight::parse(found.algebra(), text).unwrap().labels().to_vec(), 1)
        };
        let expected = expected.iter().map(labels).collect();
        assert!(is_renumbered(&sum, &expected), "{name}: {sum}");
    }
}

/// The principal sl(2), and so(3) and g2 in so(7) by representations.
#[test]
fn images_of_representations_are_found() {
    let g2 = algebra("G2");
    // e = e1 + e2, h = 2 rho^v, f = the partner of e
    let rows = g2.chevalley_algebra().unwrap();
    assert_eq!(rows.dimension(), 14);
    let e = vector(&g2, &[("e1", 1), ("e2", 1)]);
    // h = 6 h1 + 10 h2 has the value 2 on both simple roots, in the order short, long
    let f = vector(&g2, &[("f1", 6), ("f2", 10)]);
    let h = vector(&g2, &[("h1", 6), ("h2", 10)]);
    let found = Subalgebra::spanned(&g2, [e, f, h]).unwrap();
    assert_eq!(found.projection(), Subalgebra::principal_sl2(&g2).unwrap().projection());
    assert_eq!(found.embedding_index(), [[28]]);

    // the image of so(7) in so(8) by the spinor: the fixed vector is a spinor, not a vector
    let so8 = algebra("D4");
    let spin7 = spin7_in_so8(&so8, 2);
    let found = Subalgebra::spanned(&so8, spin7).unwrap();
    assert_eq!(found.algebra().to_string(), "B3");
    let eight = |labels: [i64; 4]| {
        let weight = HighestWeight::new(&so8, labels).unwrap();
        found.branch(&weight).unwrap().to_string()
    };
    assert_eq!(eight([0, 0, 1, 0]), "1 + 7");
    assert_eq!(eight([1, 0, 0, 0]), "8");
    assert_eq!(eight([0, 0, 0, 1]), "8");
    for (node, labels) in [(0, [1, 0, 0, 0]), (3, [0, 0, 0, 1])] {
        let found = Subalgebra::spanned(&so8, spin7_in_so8(&so8, node)).unwrap();
        let weight = HighestWeight::new(&so8, labels).unwrap();
        assert_eq!(found.branch(&weight).unwrap().to_string(), "1 + 7", "{node}");
    }
}

/// The stabilizer in D4 of a vector of one of the representations with dimension 8 whose square is
/// not zero.
fn spin7_in_so8(so8: &ReductiveAlgebra, node: usize) -> Vec<Vector> {
    let mut labels = vec![0; 4];
    labels[node] = 1;
    let module = MatrixRepresentation::new(&HighestWeight::new(so8, labels).unwrap()).unwrap();
    // the sum of a highest and a lowest weight vector
    let columns = module
        .chevalley_basis()
        .into_iter()
        .map(|matrix| (0..8).map(|i| matrix.get(i, 0) + &matrix.get(i, 7)).collect::<Vec<_>>());
    let columns: Vec<Vec<Rational>> = columns.collect();
    let rows: Vec<Vec<Rational>> =
        (0..8).map(|i| columns.iter().map(|column| column[i].clone()).collect()).collect();
    let matrix = affinor::tensors::linear::Matrix::from_dense(&rows).unwrap();
    let null = matrix.nullspace().unwrap();
    (0..null.rows()).map(|i| null.row(i).to_vec()).collect()
}

/// In another basis of the algebra the restriction is the same up to an outer automorphism.
#[test]
fn any_basis_of_the_algebra_is_accepted() {
    let brackets = affinor::algebra::catalogue::algebra::<Rational>("sl(3)").unwrap();
    let a2 = algebra("A2");
    let theory = StructureTheory::new(brackets.clone());
    let sub = theory.cartan_subalgebra();
    let found = Subalgebra::spanned_in_basis(&a2, &brackets, sub.basis().to_vec()).unwrap();
    assert_eq!(found.algebra().to_string(), "T2");
    let eight = found.restrict(&representation("A2", "8")).unwrap();
    assert_eq!(eight.components().map(|(_, m)| m).max(), Some(2));
    assert_eq!(eight.components().count(), 7);
}

#[test]
fn other_spans_are_rejected_with_a_witness() {
    let a2 = algebra("A2");
    let reason = |vectors: Vec<Vector>| match Subalgebra::spanned(&a2, vectors).unwrap_err() {
        RepresentationError::NotASubalgebra { reason, .. } => reason,
        other => panic!("{other}"),
    };
    let v = |terms: &[(&str, i64)]| vector(&a2, terms);
    let text = reason(vec![v(&[("e1", 1)]), v(&[("e2", 1)])]);
    assert!(text.contains("[e1, e2] = e3"), "{text}");
    let text = reason(vec![v(&[("e1", 1)]), v(&[("h1", 1)])]);
    assert!(text.contains("e1 is orthogonal"), "{text}");
    let text = reason(vec![vec![(9, Rational::from(1))]]);
    assert!(text.contains("no basis vector 9"), "{text}");
    let torus = algebra("A1 + T1");
    assert!(Subalgebra::spanned(&torus, [vec![(0, Rational::from(1))]]).is_err());
    // the whole algebra and the zero subalgebra
    let whole = Subalgebra::spanned(&a2, (0..8).map(|i| vec![(i, Rational::from(1))])).unwrap();
    assert_eq!(branched(&whole, "8"), of(&["8"]));
    let zero = Subalgebra::spanned(&a2, []).unwrap();
    assert_eq!(zero.algebra().to_string(), "T0");
}

/// Each of eight equal factors is found: the diagonal of the last two in the sum of eight algebras.
#[test]
fn many_equal_factors_are_numbered() {
    let eight = algebra(&["A1"; 8].join(" + "));
    let brackets = eight.chevalley_algebra().unwrap();
    let at = |label: &str| brackets.labels().iter().position(|own| own == label).unwrap();
    let one = || Rational::from(1);
    for (first, second) in [(6, 7), (0, 3)] {
        let vectors = ["e1", "f1", "h1"].map(|name| {
            let [a, b] = [first, second].map(|k| at(&format!("{name}_{}", k + 1)));
            vec![(a, one()), (b, one())]
        });
        let found = Subalgebra::spanned(&eight, vectors).unwrap();
        let expected: Vec<i64> = (0..8).map(|k| i64::from(k == first || k == second)).collect();
        assert_eq!(found.projection(), [expected]);
    }
}

/// The half-spin representations of large orthogonal algebras are not distinguished, and the
/// description states this.
#[test]
fn undetermined_numberings_are_stated() {
    for (name, is_determined) in [("D5", true), ("D11", false)] {
        let ambient = algebra(name);
        let e1 = vector(&ambient, &[("e1", 1)]);
        let f1 = vector(&ambient, &[("f1", 1)]);
        let h1 = vector(&ambient, &[("h1", 1)]);
        let found = Subalgebra::spanned(&ambient, [e1, f1, h1]).unwrap();
        assert_eq!(found.description().contains("exchange"), !is_determined, "{name}");
        assert_eq!(found.embedding_index(), [[1]]);
    }
}
