//! The simple complex types, represented by their split real forms.

use super::{Entry, Family, Reader};
use crate::algebra::roots::{
    CartanType, RootError, RootSystem, Series, basis_names, chevalley_constants,
};
use affinor_tensors::{Ring, Symbolic};

pub(super) const A: Family = family(
    ("An", "n >= 1", "A2"),
    "simple, split: sl(n+1); Chevalley basis e1.. (positive roots by height), f1.., h1..hn",
    |n| dimension(Series::A, n),
    |name, n| build(name, Series::A, n),
);
pub(super) const B: Family = family(
    ("Bn", "n >= 2", "B2"),
    "simple, split: so(n+1,n); Chevalley basis e1.. (positive roots by height), f1.., h1..hn",
    |n| dimension(Series::B, n),
    |name, n| build(name, Series::B, n),
);
pub(super) const C: Family = family(
    ("Cn", "n >= 2", "C3"),
    "simple, split: sp(2n); Chevalley basis e1.. (positive roots by height), f1.., h1..hn",
    |n| dimension(Series::C, n),
    |name, n| build(name, Series::C, n),
);
pub(super) const D: Family = family(
    ("Dn", "n >= 3", "D4"),
    "simple, split: so(n,n); Chevalley basis e1.. (positive roots by height), f1.., h1..hn",
    |n| dimension(Series::D, n),
    |name, n| build(name, Series::D, n),
);
pub(super) const E: Family = family(
    ("En", "n = 6, 7, 8", "E8"),
    "simple, split, exceptional; Chevalley basis e1.. (positive roots by height), f1.., h1..hn",
    |n| dimension(Series::E, n),
    |name, n| build(name, Series::E, n),
);
pub(super) const F: Family = family(
    ("Fn", "n = 4", "F4"),
    "simple, split, exceptional; Chevalley basis e1.. (positive roots by height), f1.., h1..h4",
    |n| dimension(Series::F, n),
    |name, n| build(name, Series::F, n),
);
pub(super) const G: Family = family(
    ("Gn", "n = 2", "G2"),
    "simple, split, exceptional; Chevalley basis e1.. (positive roots by height), f1.., h1, h2",
    |n| dimension(Series::G, n),
    |name, n| build(name, Series::G, n),
);

const fn family(
    (pattern, needs, example): (&'static str, &'static str, &'static str),
    summary: &'static str,
    dimension: fn(&[usize]) -> Option<usize>,
    build: fn(String, &[usize]) -> Entry,
) -> Family {
    let reader = Reader::Integers { count: 1, dimension, build };
    Family { pattern, needs, summary, example, reader }
}

fn dimension(series: Series, rank: &[usize]) -> Option<usize> {
    match CartanType::new(series, rank[0]) {
        Ok(cartan_type) => Some(cartan_type.dimension()),
        Err(RootError::TooLarge { .. }) => Some(usize::MAX),
        Err(RootError::NoSuchType { .. }) => None,
    }
}

fn build(name: String, series: Series, rank: &[usize]) -> Entry {
    let cartan_type = CartanType::new(series, rank[0]).expect("a type that has a dimension");
    let roots = RootSystem::new(cartan_type);
    let constants = chevalley_constants(&roots).into_iter();
    let constants = constants.map(|(j, k, i, v)| (j, k, i, Symbolic::from_i64(v)));
    Entry::new(name, basis_names(&roots), constants)
}
