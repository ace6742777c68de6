//! The limit on the terms of symbolic computations.

use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Effort, Symbolic, Tensor, Up, contract};

fn symmetric(n: usize) -> Vec<Vec<Symbolic>> {
    let entry = |i: usize, j: usize| Symbolic::parameter(&format!("g{}{}", i.min(j), i.max(j)));
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// A computation with quotients, on all threads.
fn squares(n: usize) -> Option<Tensor<Symbolic>> {
    let inverse = Matrix::from_dense(&symmetric(n)).ok()?.inverse()?;
    let entries = (0..n * n).map(|at| ([at / n, at % n], inverse.get(at / n, at % n)));
    let inverse = Tensor::from_components(n, &[Up, Down], entries).ok()?;
    contract("h^i_m h^m_k -> ^i_k", &[("h", &inverse)]).ok()
}

#[test]
fn the_limit_is_the_number_of_terms() {
    let effort = Effort::new(u64::MAX);
    let whole = effort.bound(|| squares(4)).unwrap().unwrap();
    let terms = effort.terms();
    assert!(terms > 100, "{terms}");
    // the same number each time, and large enough
    let same = Effort::new(terms);
    assert_eq!(same.bound(|| squares(4)).unwrap().unwrap(), whole);
    assert_eq!(same.terms(), terms);
    let refused = Effort::new(terms - 1).bound(|| squares(4)).unwrap_err();
    assert_eq!(refused.limit, terms - 1);
    // without a limit nothing is counted, also after a limit
    assert_eq!(squares(4).unwrap(), whole);
    assert_eq!(same.terms(), terms);
}

#[test]
fn what_passes_the_limit_ends_soon() {
    // dimension 8 alone would need minutes
    for limit in [1, 100, 5_000] {
        let refused = Effort::new(limit).bound(|| squares(8)).unwrap_err();
        assert_eq!(refused.limit, limit);
        assert!(refused.to_string().contains("the formulas exceed the limit of "));
    }
    // expressions with functions, and their text
    let text = "(sin(x) + a*cos(y))^6/(1 + b*sin(x - y))^3";
    let effort = Effort::new(20);
    let read = effort.bound(|| text.parse::<Symbolic>().map(|value| value.to_string()));
    assert!(read.is_err());
}

#[test]
fn limits_nest_and_end() {
    let outer = Effort::new(u64::MAX);
    let inner = Effort::new(1);
    let product = || "(a + b + c)*(a - b)".parse::<Symbolic>();
    let both = outer.bound(|| (inner.bound(product).is_err(), product().unwrap()));
    let (refused, value) = both.unwrap();
    assert!(refused);
    assert_eq!(value, product().unwrap());
    assert!(outer.terms() > 0);
}
