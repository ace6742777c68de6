//! Subalgebras of orthogonal algebras that octonions define: G2 in so(7), and so(7) in so(9) by spinors.

use super::Embedded;
use crate::Error;
use crate::algebra::catalogue;
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

/// The triples of imaginary octonions with `e_i e_j = e_k`, from 0.
const TRIPLES: [([usize; 3], i64); 7] = [
    ([0, 1, 2], 1),
    ([0, 3, 4], 1),
    ([0, 5, 6], 1),
    ([1, 3, 5], 1),
    ([1, 4, 6], -1),
    ([2, 3, 6], -1),
    ([2, 4, 5], -1),
];

/// The value on basis vectors, from 0, of the form `phi(x, y, z) = <x y, z>` on imaginary octonions.
fn form(at: [usize; 3]) -> i64 {
    let mut sorted = at;
    sorted.sort_unstable();
    let inversions = (at[0] > at[1]) as u8 + (at[0] > at[2]) as u8 + (at[1] > at[2]) as u8;
    let found = TRIPLES.iter().find(|(triple, _)| *triple == sorted);
    let sign = if inversions.is_multiple_of(2) { 1 } else { -1 };
    found.map_or(0, |(_, value)| sign * value)
}

/// The subalgebra of so(n) whose elements satisfy linear equations, which `act` evaluates on a matrix.
fn annihilator(
    n: usize,
    act: impl Fn(&Matrix<Rational>) -> Vec<Rational>,
    sentence: &str,
) -> Result<Embedded, Error> {
    let name = format!("so({n})");
    let entry = catalogue::find(&name)?;
    let unknown = || Error::Name(format!("{name} has no matrices"));
    let matrices = entry.matrices.as_ref().ok_or_else(unknown)?.matrices();
    let columns: Vec<Vec<Rational>> = matrices.iter().map(act).collect();
    let rows = (0..columns[0].len()).map(|at| columns.iter().map(move |column| column[at].clone()));
    let rows: Vec<Vec<Rational>> = rows.map(Iterator::collect).collect();
    let vectors = Matrix::from_dense(&rows)?.nullspace()?.to_dense();
    Ok(Embedded { algebra: catalogue::algebra(&name)?, vectors, sentence: sentence.into() })
}

/// The sum of products of entries of a matrix with integers.
fn sum(terms: impl IntoIterator<Item = (Rational, i64)>) -> Rational {
    let products = terms.into_iter().map(|(x, weight)| x * &Rational::from(weight));
    products.fold(Rational::from(0), |sum, term| sum + &term)
}

/// G2 in so(7): the rotations that preserve the product of the imaginary octonions.
pub(super) fn automorphisms() -> Result<Embedded, Error> {
    let triples =
        || (0..7).flat_map(|i| (i + 1..7).flat_map(move |j| (j + 1..7).map(move |k| [i, j, k])));
    // (x phi)_ijk = x_mi phi_mjk + x_mj phi_imk + x_mk phi_ijm, for each i < j < k
    let act = |x: &Matrix<Rational>| {
        let value = |[i, j, k]: [usize; 3]| {
            sum((0..7).flat_map(|m| {
                let of = [(i, [m, j, k]), (j, [i, m, k]), (k, [i, j, m])];
                of.map(|(to, at)| (x.get(m, to), form(at)))
            }))
        };
        triples().map(value).collect()
    };
    annihilator(7, act, "the rotations of R^7 that preserve the product of the imaginary octonions")
}

/// The product of basis octonions, 1 first: the place and the sign.
fn product(a: usize, b: usize) -> (usize, i64) {
    match (a, b) {
        (0, at) | (at, 0) => (at, 1),
        _ if a == b => (0, -1),
        _ => {
            let values = (0..7).map(|k| (k + 1, form([a - 1, b - 1, k])));
            values.into_iter().find(|(_, sign)| *sign != 0).unwrap_or((0, 0))
        }
    }
}

/// The Clifford generator `gamma_i` of `R^9` on a basis vector of pairs of octonions. It is
/// `(x, y) -> (e_i y, conj(e_i) x)` for the octonions `e_i`, and `(x, y) -> (x, -y)` for the last.
fn gamma(i: usize, (half, at): (usize, usize)) -> ((usize, usize), i64) {
    if i == 8 {
        return ((half, at), if half == 0 { 1 } else { -1 });
    }
    let (place, sign) = product(i, at);
    let conjugate = if half == 0 && i > 0 { -1 } else { 1 };
    ((1 - half, place), sign * conjugate)
}

/// so(7) in so(9): the elements `x` that annihilate a spinor, `sum x_ij gamma_i gamma_j / 2` over `i < j`.
pub(super) fn of_spinor() -> Result<Embedded, Error> {
    let act = |x: &Matrix<Rational>| {
        let pairs = || (0..9).flat_map(|i| (i + 1..9).map(move |j| (i, j)));
        let component = |place: (usize, usize)| {
            sum(pairs().filter_map(|(i, j)| {
                let (middle, first) = gamma(j, (0, 0));
                let (found, second) = gamma(i, middle);
                (found == place).then(|| (x.get(i, j), first * second))
            }))
        };
        (0..2).flat_map(|half| (0..8).map(move |at| (half, at))).map(component).collect()
    };
    annihilator(9, act, "the stabilizer of a spinor of R^9")
}
