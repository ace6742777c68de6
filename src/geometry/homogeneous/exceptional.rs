//! Subalgebras of exceptional algebras: those of maximal rank, by their roots, and G2 in so(7).

use super::Embedded;
use super::name::{Factor, Name};
use crate::Error;
use crate::algebra::catalogue;
use crate::algebra::roots::{CartanType, Root, RootSystem, Series};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

/// The rule by which the positive roots of a subsystem are chosen.
enum Subsystem {
    /// The long roots.
    Long,
    /// The roots whose coefficient of this simple root, from 0, is even: fixed by an involution.
    Even(usize),
    /// No roots: the torus.
    None,
}

/// A subalgebra of maximal rank of a compact exceptional algebra.
pub(super) fn embed(
    group: &'static str,
    isotropy: &[Factor],
    name: &Name,
) -> Result<Embedded, Error> {
    use Factor::{Orthogonal, SpecialUnitary, Symplectic, Torus};
    let (subsystem, what) = match (group, isotropy) {
        (_, [Torus]) => (Subsystem::None, ""),
        ("G2", [SpecialUnitary(3)]) => (Subsystem::Long, " and the long roots"),
        ("G2", [Orthogonal(4)]) => (
            Subsystem::Even(1),
            " and the roots with an even coefficient of the second simple root",
        ),
        ("F4", [Orthogonal(9)]) => (
            Subsystem::Even(3),
            " and the roots with an even coefficient of the fourth simple root",
        ),
        ("F4", [Symplectic(3), SpecialUnitary(2) | Symplectic(1)]) => {
            (Subsystem::Even(0), " and the roots with an even coefficient of the first simple root")
        }
        _ => return Err(name.without_embedding()),
    };
    let unknown = || name.without_embedding();
    let cartan_type = cartan_type(group).ok_or_else(unknown)?;
    let roots = RootSystem::new(cartan_type);
    let (positive, rank) = (roots.positive_roots(), cartan_type.rank());
    let longest = positive.iter().map(Root::squared_length).max();
    let chosen = |root: &Root| match subsystem {
        Subsystem::Long => Some(root.squared_length()) == longest,
        Subsystem::Even(at) => root.coefficients()[at] % 2 == 0,
        Subsystem::None => false,
    };
    // the basis of the compact form: u and v for each positive root, then w for each simple root
    let n = 2 * positive.len() + rank;
    let of_roots = (0..2 * positive.len()).filter(|at| chosen(&positive[at % positive.len()]));
    let places: Vec<usize> = of_roots.chain(2 * positive.len()..n).collect();
    let unit = |at: usize| (0..n).map(|i| Rational::from((i == at) as i64)).collect();
    Ok(Embedded {
        algebra: catalogue::algebra(&Factor::Exceptional(group).algebra())?,
        vectors: places.into_iter().map(unit).collect(),
        sentence: format!("the maximal torus of {group}{what}"),
    })
}

/// The type of a group, such as `G2`.
fn cartan_type(group: &str) -> Option<CartanType> {
    let series = match group.chars().next()? {
        'E' => Series::E,
        'F' => Series::F,
        _ => Series::G,
    };
    CartanType::new(series, group[1..].parse().ok()?).ok()
}

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

/// G2 in so(7): the rotations that preserve the product of the imaginary octonions.
pub(super) fn octonions() -> Result<Embedded, Error> {
    let entry = catalogue::find("so(7)")?;
    let unknown = || Error::Name("so(7) has no matrices".into());
    let matrices = entry.matrices.as_ref().ok_or_else(unknown)?.matrices();
    let form = |at: [usize; 3]| -> i64 {
        let mut sorted = at;
        sorted.sort_unstable();
        let inversions = (at[0] > at[1]) as u8 + (at[0] > at[2]) as u8 + (at[1] > at[2]) as u8;
        let found = TRIPLES.iter().find(|(triple, _)| *triple == sorted);
        let sign = if inversions.is_multiple_of(2) { 1 } else { -1 };
        found.map_or(0, |(_, value)| sign * value)
    };
    // (x phi)_ijk = x_mi phi_mjk + x_mj phi_imk + x_mk phi_ijm, for each i < j < k
    let triples =
        (0..7).flat_map(|i| (i + 1..7).flat_map(move |j| (j + 1..7).map(move |k| [i, j, k])));
    let rows: Vec<Vec<Rational>> = triples
        .map(|[i, j, k]| {
            let acted = |x: &Matrix<Rational>| {
                let terms = (0..7).map(|m| {
                    let [a, b, c] = [form([m, j, k]), form([i, m, k]), form([i, j, m])];
                    let weighted = [(i, a), (j, b), (k, c)];
                    let weighted =
                        weighted.map(|(to, weight)| x.get(m, to) * &Rational::from(weight));
                    weighted.into_iter().fold(Rational::from(0), |sum, term| sum + &term)
                });
                terms.fold(Rational::from(0), |sum, term| sum + &term)
            };
            matrices.iter().map(acted).collect()
        })
        .collect();
    let vectors = Matrix::from_dense(&rows)?.nullspace()?.to_dense();
    Ok(Embedded {
        algebra: catalogue::algebra("so(7)")?,
        vectors,
        sentence: "the rotations of R^7 that preserve the product of the imaginary octonions"
            .into(),
    })
}
