//! Triangular matrices, and Borel and parabolic subalgebras of the split simple algebras.

use super::name::{Argument, rule};
use super::{CatalogueError, Entry, Family, MAX_DIMENSION, Reader, at};
use crate::algebra::roots::{CartanType, RootSystem, Series, basis_names, chevalley_constants};
use affinor_tensors::{Ring, Symbolic};

/// The family t(n).
pub(super) const TRIANGULAR: Family = Family {
    pattern: "t(n)",
    needs: "n >= 1",
    summary: "upper triangular matrices; basis E_ij for i <= j, row by row",
    example: "t(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_mul(n[0].saturating_add(1)) / 2),
        build: |name, n| triangular(name, n[0], 0),
    },
};

/// The family n(n).
pub(super) const STRICT: Family = Family {
    pattern: "n(n)",
    needs: "n >= 2",
    summary: "strictly upper triangular matrices, nilpotent; basis E_ij for i < j, row by row",
    example: "n(4)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2).then(|| n[0].saturating_mul(n[0] - 1) / 2),
        build: |name, n| triangular(name, n[0], 1),
    },
};

/// The family borel(X).
pub(super) const BOREL: Family = Family {
    pattern: "borel(TYPE)",
    needs: "a TYPE such as A2 or E7",
    summary: "Borel subalgebra of a split simple algebra; basis e1.., h1.. as in the algebra",
    example: "borel(A2)",
    reader: Reader::Words(|name, arguments| parabolic(&BOREL, name, arguments)),
};

/// The family parabolic(X,i,...).
pub(super) const PARABOLIC: Family = Family {
    pattern: "parabolic(TYPE,i,..)",
    needs: "a TYPE such as E7 and the numbers of simple roots that leave the Levi factor",
    summary: "standard parabolic subalgebra of a split simple algebra: roots with coefficient >= 0 at the \
              simple roots i, ..; basis e1.., f.., h1.. as in the algebra",
    example: "parabolic(A3,2)",
    reader: Reader::Words(|name, arguments| parabolic(&PARABOLIC, name, arguments)),
};

fn triangular(name: String, n: usize, above: usize) -> Entry {
    let places: Vec<_> = (0..n).flat_map(|i| (i + above..n).map(move |j| (i, j))).collect();
    let labels = places.iter().map(|&place| at("E", place, n)).collect();
    let matrices = places.into_iter().map(|(i, j)| vec![(i, j, 1)]);
    Entry::of_integer_matrices(name, labels, n, matrices)
}

fn parabolic(family: &Family, name: &str, arguments: &[Argument]) -> Result<Entry, CatalogueError> {
    let refused =
        || CatalogueError::NoSuchAlgebra { name: name.trim().to_string(), rule: rule(&[family]) };
    let (first, crossed) = arguments.split_first().ok_or_else(refused)?;
    let cartan_type = cartan_type(first.text).ok_or_else(refused)?;
    if cartan_type.dimension() > MAX_DIMENSION {
        return Err(CatalogueError::TooLarge { name: name.trim().to_string() });
    }
    let rank = cartan_type.rank();
    let number = |argument: &Argument| {
        let number = argument.text.parse::<usize>().ok();
        number.filter(|i| (1..=rank).contains(i)).ok_or_else(refused)
    };
    let borel = family.pattern == BOREL.pattern;
    if borel != crossed.is_empty() {
        return Err(refused());
    }
    let mut crossed = crossed.iter().map(number).collect::<Result<Vec<_>, _>>()?;
    crossed.sort_unstable();
    crossed.dedup();
    let full = match borel {
        true => format!("borel({cartan_type})"),
        false => {
            let numbers: Vec<String> = crossed.iter().map(usize::to_string).collect();
            format!("parabolic({cartan_type},{})", numbers.join(","))
        }
    };
    let roots = RootSystem::new(cartan_type);
    let levi = |coefficients: &[i64]| !borel && crossed.iter().all(|&i| coefficients[i - 1] == 0);
    let positive = roots.positive_roots().len();
    let kept = |at: usize| {
        let negative = at.checked_sub(positive).and_then(|at| roots.positive_roots().get(at));
        at < positive || negative.is_none_or(|root| levi(root.coefficients()))
    };
    let labels = basis_names(&roots);
    let places: Vec<usize> = (0..labels.len()).filter(|&at| kept(at)).collect();
    let place = |at: usize| places.binary_search(&at).ok();
    let constants = chevalley_constants(&roots).into_iter().filter_map(|(j, k, i, value)| {
        Some((place(j)?, place(k)?, place(i)?, Symbolic::from_i64(value)))
    });
    let labels = places.iter().map(|&at| labels[at].clone()).collect();
    Ok(Entry::new(full, labels, constants))
}

/// The type of a name such as `E7`.
pub(super) fn cartan_type(text: &str) -> Option<CartanType> {
    let all = [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G];
    let series = all.into_iter().find(|series| text.starts_with(&series.to_string()))?;
    let rank = text.get(1..)?.trim_matches(['(', ')']);
    CartanType::new(series, rank.parse().ok()?).ok()
}
