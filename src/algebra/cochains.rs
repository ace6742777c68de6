//! The complex of Chevalley and Eilenberg with coefficients in a module, absolute and relative.

use super::LieAlgebra;
use super::invariants::common_kernel;
use super::sparse_bracket::SparseBracket;
use super::structure::collected;
use crate::Error;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar};
use std::collections::HashMap;

/// A set of indices of basis vectors, as bits.
pub(crate) type Indices = u128;

/// A term of a differential: the indices of the form, the vector of the module, whether the sign is
/// negative, and the factor.
pub(crate) type Term<'a, V> = (Indices, usize, bool, &'a V);

/// The terms of `d (e^set ⊗ v) = d e^set ⊗ v + sum over j of e^j e^set ⊗ x_j v`, where
/// `d e^i = -sum over j < l of c^i_jl e^j e^l`.
///
/// The function `of` returns the constants `(l, i, c^i_jl)` of `[e_j, .]`, and `action` the image
/// `e_j v`.
pub(crate) fn differential<'a, V>(
    n: usize,
    of: impl Fn(usize) -> &'a [(usize, usize, V)],
    action: impl Fn(usize) -> &'a [(usize, V)],
    set: Indices,
    vector: usize,
) -> Vec<Term<'a, V>> {
    let below = |set: Indices, at: usize| (set & ((1 << at) - 1)).count_ones() % 2 == 1;
    let mut terms = vec![];
    for i in (0..n).filter(|i| set >> i & 1 == 1) {
        let rest = set & !(1 << i);
        for j in (0..n).filter(|j| rest >> j & 1 == 0) {
            for (l, component, value) in of(j) {
                if *component == i && *l > j && rest >> l & 1 == 0 {
                    // the sign of the permutation that sorts e^j e^l into the set, in place of e^i
                    let minus = !(below(rest, i) ^ below(rest, j) ^ below(rest, *l));
                    terms.push((rest | 1 << j | 1 << l, vector, minus, value));
                }
            }
        }
    }
    for j in (0..n).filter(|j| set >> j & 1 == 0) {
        let images = action(j).iter();
        terms.extend(images.map(|(to, value)| (set | 1 << j, *to, below(set, j), value)));
    }
    terms
}

/// The sets with `k` of `n` indices, in increasing order.
pub(crate) fn sets(n: usize, k: usize) -> Vec<Indices> {
    let mut all = vec![];
    extend(n, k, 0, &mut all);
    all.sort_unstable();
    all
}

fn extend(n: usize, k: usize, set: Indices, all: &mut Vec<Indices>) {
    if k == 0 {
        all.push(set);
        return;
    }
    // the next smaller index
    let end = if set == 0 { n } else { set.trailing_zeros() as usize };
    (k - 1..end).for_each(|next| extend(n, k - 1, set | 1 << next, all));
}

/// The dimensions of the cochains and of the cohomology of a complex, by degree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dimensions {
    /// The dimensions of the spaces of cochains.
    pub cochains: Vec<usize>,
    /// The dimensions of the cohomology.
    pub betti: Vec<usize>,
}

/// The largest number of cochains of one degree.
pub(crate) const MAX_COCHAINS: usize = 20_000;

/// The cohomology of an algebra relative to the subalgebra `h` of the basis vectors from `r` on, with
/// coefficients in a module with the images `images[j][v]` of its basis vectors.
///
/// Relative cochains are the forms on `g/h` that `h` preserves. A form on `g/h` is preserved if and
/// only if its differential is a form on `g/h` again, because `L_x = i_x d + d i_x` and `i_x`
/// vanishes for `x` in `h`. So the differential alone determines the complex.
///
/// # Errors
/// [`Error::Size`] for more than 128 basis vectors or too many cochains.
pub(crate) fn relative_cohomology<S: Field + Scalar>(
    algebra: &LieAlgebra<S>,
    r: usize,
    images: &[Vec<Row<S>>],
    m: usize,
) -> Result<Dimensions, Error> {
    let n = algebra.dimension();
    let tolerance = algebra.structure_constants().tolerance();
    if n > Indices::BITS as usize {
        return Err(Error::Size { what: "basis vectors", size: n, limit: Indices::BITS as usize });
    }
    let products = SparseBracket::of_tensor(algebra.structure_constants());
    let inner = if r == n { !0 } else { (1 << r) - 1 };
    let (mut cochains, mut betti) = (vec![], vec![]);
    let mut exact = 0;
    for k in 0..=r {
        let count = (0..k).fold(m, |value, i| value.saturating_mul(r - i) / (i + 1));
        if count > MAX_COCHAINS {
            return Err(Error::Size { what: "cochains", size: count, limit: MAX_COCHAINS });
        }
        let (own, next) = (sets(r, k), sets(r, k + 1));
        let places: HashMap<Indices, usize> = next.into_iter().zip(0..).collect();
        // for each cochain its differential on g/h, and for each x in h the rest
        let mut inside: Vec<Row<S>> = vec![];
        let mut outside: Vec<Vec<Row<S>>> = vec![vec![]; n - r];
        let columns: HashMap<Indices, usize> = own.iter().copied().zip(0..).collect();
        for (set, v) in own.iter().flat_map(|set| (0..m).map(move |v| (*set, v))) {
            checkpoint();
            let terms = differential(n, |j| products.of(j), |j| &images[j][v][..], set, v);
            let mut row = vec![];
            let mut rest: Vec<Row<S>> = vec![vec![]; n - r];
            for (to, w, minus, value) in terms {
                let value = if minus { -value.clone() } else { value.clone() };
                match to & !inner {
                    0 => row.extend(places.get(&to).map(|at| (at * m + w, value))),
                    x => {
                        let remaining = columns.get(&(to & inner));
                        let x = x.trailing_zeros() as usize - r;
                        rest[x].extend(remaining.map(|at| (at * m + w, value)));
                    }
                }
            }
            inside.push(collected(row));
            outside.iter_mut().zip(rest).for_each(|(all, row)| all.push(collected(row)));
        }
        let image = |rows: &Vec<Row<S>>, form: &[(usize, S)]| Ok(applied(rows, form));
        let preserved =
            common_kernel("invariant forms", own.len() * m, tolerance, outside.iter(), image)?;
        let rank = match preserved.rows() {
            0 => 0,
            _ => {
                let images = (0..preserved.rows()).map(|at| applied(&inside, preserved.row(at)));
                let width = (places.len() * m).max(1);
                Matrix::from_rows(width, images.collect::<Vec<_>>())?
                    .with_tolerance(tolerance)
                    .rank()?
            }
        };
        cochains.push(preserved.rows());
        betti.push(preserved.rows() - rank - exact);
        exact = rank;
    }
    Ok(Dimensions { cochains, betti })
}

/// The combination of rows with the components of a form as factors.
fn applied<S: Field + Scalar>(rows: &[Row<S>], form: &[(usize, S)]) -> Row<S> {
    let terms = form.iter().flat_map(|(column, factor)| {
        rows[*column].iter().map(move |(at, value)| (*at, value.clone() * factor))
    });
    collected(terms.collect())
}
