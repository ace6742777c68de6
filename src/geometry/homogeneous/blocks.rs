//! Embeddings as blocks along the diagonal of the defining matrices.

use super::Embedded;
use super::name::{Factor, Name};
use crate::Error;
use crate::algebra::{Complex, catalogue};
use affinor_tensors::Rational;

/// The scalars of matrices.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Field {
    Real,
    Complex,
    Quaternion,
}

/// An integral quaternion `a + b i + c j + d k`.
type Quaternion = [i64; 4];
/// The nonzero entries of a matrix: row, column, value.
type Entries = Vec<(usize, usize, Quaternion)>;

const ONE: Quaternion = [1, 0, 0, 0];
const I: Quaternion = [0, 1, 0, 0];
const IMAGINARY: [Quaternion; 3] = [I, [0, 0, 1, 0], [0, 0, 0, 1]];

fn minus(q: Quaternion) -> Quaternion {
    q.map(|x| -x)
}

/// The factors of H as blocks of G, in their order.
pub(super) fn embed(group: Factor, isotropy: &[Factor], name: &Name) -> Result<Embedded, Error> {
    let unknown = || name.without_embedding();
    let (field, size) = defining(group).ok_or_else(unknown)?;
    let mut generators: Vec<Entries> = vec![];
    let mut used = 0;
    let mut places = vec![];
    for factor in isotropy {
        let (from, n, basis) = match factor {
            Factor::Torus => (Field::Complex, torus_size(field, size), torus(field, size)),
            Factor::Circle(k, l) if field == Field::Complex && size == 3 => {
                let weights = [*k, *l, -k - l].into_iter().enumerate();
                let circle = weights.map(|(at, weight)| (at, at, I.map(|x| x * weight)));
                (Field::Complex, 3, vec![circle.collect()])
            }
            Factor::IndefiniteOrthogonal(p, q) => {
                let Factor::IndefiniteOrthogonal(positive, _) = group else {
                    return Err(unknown());
                };
                // the block contains the change of signs of the form
                let before = positive.checked_sub(*p).filter(|_| isotropy.len() == 1);
                used = before.ok_or_else(unknown)?;
                (Field::Real, p + q, indefinite(*p, *q))
            }
            factor => generators_of(*factor).ok_or_else(unknown)?,
        };
        let width = n * real_size(from, field);
        if used + width > size {
            return Err(unknown());
        }
        let moved = basis.into_iter().map(|entries| {
            let entries = restricted(entries, from, field).into_iter();
            entries.map(|(i, j, q)| (i + used, j + used, q)).collect()
        });
        generators.extend(moved);
        let rows = match width {
            1 => format!("row {}", used + 1),
            _ => format!("rows {} to {}", used + 1, used + width),
        };
        places.push(format!("{factor} in {rows}"));
        used += width;
    }
    let traceless = matches!(group, Factor::SpecialUnitary(_) | Factor::IndefiniteUnitary(..));
    let mut sentence = format!("blocks of the matrices of {group}: {}", places.join(", "));
    if traceless {
        match size - used {
            0 => generators = without_trace(generators),
            1 => {
                let full = generators.len();
                let traced = generators.iter().filter(|entries| trace(entries) != 0).count();
                generators.iter_mut().for_each(|entries| {
                    let trace = trace(entries);
                    if trace != 0 {
                        entries.push((used, used, [0, -trace, 0, 0]));
                    }
                });
                if traced > 0 && full > 0 {
                    sentence += &format!(", with the inverse determinant in row {size}");
                }
            }
            _ if generators.iter().any(|entries| trace(entries) != 0) => return Err(unknown()),
            _ => {}
        }
    }
    let entry = catalogue::find(&group.algebra())?;
    let matrices = entry.matrices.as_ref().ok_or_else(unknown)?;
    let vectors = generators.into_iter().map(|entries| {
        let entries = entries.into_iter().flat_map(|entry| written(entry, field));
        matrices.coordinates(entries.collect())?.ok_or_else(unknown)
    });
    let vectors = vectors.collect::<Result<_, Error>>()?;
    Ok(Embedded { algebra: catalogue::algebra(&group.algebra())?, vectors, sentence })
}

/// The scalars and the size of the defining matrices of a group.
fn defining(group: Factor) -> Option<(Field, usize)> {
    Some(match group {
        Factor::Orthogonal(n) | Factor::SpecialLinear(n) => (Field::Real, n),
        Factor::Motions(n) => (Field::Real, n),
        Factor::IndefiniteOrthogonal(p, q) => (Field::Real, p + q),
        Factor::SpecialUnitary(n) | Factor::Unitary(n) => (Field::Complex, n),
        Factor::IndefiniteUnitary(p, q) => (Field::Complex, p + q),
        Factor::Symplectic(n) => (Field::Quaternion, n),
        Factor::IndefiniteSymplectic(p, q) => (Field::Quaternion, p + q),
        _ => return None,
    })
}

/// A basis of the anti-hermitian matrices of a compact group, with its scalars and its size.
fn generators_of(factor: Factor) -> Option<(Field, usize, Vec<Entries>)> {
    let (field, n, units, special): (_, _, &[Quaternion], _) = match factor {
        Factor::Orthogonal(n) => (Field::Real, n, &[], false),
        Factor::Unitary(n) => (Field::Complex, n, &IMAGINARY[..1], false),
        Factor::SpecialUnitary(n) => (Field::Complex, n, &IMAGINARY[..1], true),
        Factor::Symplectic(n) => (Field::Quaternion, n, &IMAGINARY, false),
        _ => return None,
    };
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let off = pairs.flat_map(|(i, j)| {
        let skew = vec![(i, j, ONE), (j, i, minus(ONE))];
        let symmetric = units.iter().map(move |unit| vec![(i, j, *unit), (j, i, *unit)]);
        [skew].into_iter().chain(symmetric)
    });
    let on = (0..n).flat_map(|k| units.iter().map(move |unit| (k, *unit)));
    let on = on.filter_map(|(k, unit)| match (special, k + 1 < n) {
        (false, _) => Some(vec![(k, k, unit)]),
        (true, true) => Some(vec![(k, k, unit), (k + 1, k + 1, minus(unit))]),
        (true, false) => None,
    });
    Some((field, n, off.chain(on).collect()))
}

/// A basis of so(p,q): `E_ij - eta_i eta_j E_ji` for `i < j`.
fn indefinite(p: usize, q: usize) -> Vec<Entries> {
    let pairs = (0..p + q).flat_map(|i| (i + 1..p + q).map(move |j| (i, j)));
    let mixed = |i: usize, j: usize| (i < p) != (j < p);
    let one = |i, j| vec![(i, j, ONE), (j, i, if mixed(i, j) { ONE } else { minus(ONE) })];
    pairs.map(|(i, j)| one(i, j)).collect()
}

/// so(3) in so(5), by `x -> [a, x]` on symmetric 3 x 3 matrices without trace.
///
/// The matrices `E_12 + E_21`, `E_13 + E_31`, `E_23 + E_32`, `E_11 - E_22` and `E_11 + E_22 - 2 E_33` are orthogonal, of the
/// squared lengths 2, 2, 2, 2 and 6. The rows of a 4 x 4 matrix `M` with `M M^T = 3` combine the first four to vectors of
/// the squared length 6. So the images are antisymmetric matrices of rational numbers.
pub(super) fn irreducible() -> Result<Embedded, Error> {
    type Symmetric = [[i64; 3]; 3];
    const BASIS: [Symmetric; 5] = [
        [[0, 1, 0], [1, 0, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 0], [1, 0, 0]],
        [[0, 0, 0], [0, 0, 1], [0, 1, 0]],
        [[1, 0, 0], [0, -1, 0], [0, 0, 0]],
        [[1, 0, 0], [0, 1, 0], [0, 0, -2]],
    ];
    const M: [[i64; 5]; 5] =
        [[1, 1, 1, 0, 0], [-1, 1, 0, 1, 0], [-1, 0, 1, -1, 0], [0, -1, 1, 1, 0], [0, 0, 0, 0, 1]];
    let vectors = M.map(|row| {
        let mut sum: Symmetric = [[0; 3]; 3];
        for (weight, matrix) in row.iter().zip(BASIS) {
            (0..9).for_each(|at| sum[at / 3][at % 3] += weight * matrix[at / 3][at % 3]);
        }
        sum
    });
    let entry = catalogue::find("so(5)")?;
    let unknown = || Error::Name("so(5) has no matrices".into());
    let matrices = entry.matrices.as_ref().ok_or_else(unknown)?;
    let image = |(i, j): (usize, usize)| {
        // a = E_ij - E_ji; the component of a x - x a along y is its inner product with y, by 6
        let a = |r: usize, c: usize| (r == i && c == j) as i64 - (r == j && c == i) as i64;
        let acted = |x: &Symmetric, r: usize, c: usize| -> i64 {
            (0..3).map(|k| a(r, k) * x[k][c] - x[r][k] * a(k, c)).sum()
        };
        let component = |y: &Symmetric, x: &Symmetric| -> i64 {
            (0..9).map(|at| acted(x, at / 3, at % 3) * y[at / 3][at % 3]).sum()
        };
        let places = (0..25).map(|at| (at / 5, at % 5));
        let entries = places.map(|(r, c)| {
            let value = Rational::from(component(&vectors[r], &vectors[c])) / Rational::from(6);
            (r, c, Complex { re: value, im: Rational::from(0) })
        });
        matrices.coordinates(entries.collect())?.ok_or_else(unknown)
    };
    let vectors = [(0, 1), (0, 2), (1, 2)].into_iter().map(image).collect::<Result<_, Error>>()?;
    let sentence = "SO(3) acts on the symmetric 3 x 3 matrices without trace".into();
    Ok(Embedded { algebra: catalogue::algebra("so(5)")?, vectors, sentence })
}

/// The number of complex rows that the maximal torus occupies.
fn torus_size(field: Field, size: usize) -> usize {
    if field == Field::Real { size / 2 } else { size }
}

fn torus(field: Field, size: usize) -> Vec<Entries> {
    (0..torus_size(field, size)).map(|k| vec![(k, k, I)]).collect()
}

/// The number of rows over `to` of one row over `from`.
fn real_size(from: Field, to: Field) -> usize {
    match (from, to) {
        (Field::Complex, Field::Real) | (Field::Quaternion, Field::Complex) => 2,
        (Field::Quaternion, Field::Real) => 4,
        _ => 1,
    }
}

/// A matrix over `from`, as a matrix over `to`, whose entries act from the left.
fn restricted(entries: Entries, from: Field, to: Field) -> Entries {
    let blocks = |size: usize, block: fn(Quaternion) -> Vec<(usize, usize, Quaternion)>| {
        let shifted = |(i, j, q)| {
            let block = block(q).into_iter();
            block.map(move |(r, c, q)| (size * i + r, size * j + c, q))
        };
        entries.iter().copied().flat_map(shifted).collect::<Entries>()
    };
    match (from, to) {
        (Field::Complex, Field::Real) => blocks(2, |[a, b, ..]| {
            let real = |x: i64| [x, 0, 0, 0];
            vec![(0, 0, real(a)), (0, 1, real(-b)), (1, 0, real(b)), (1, 1, real(a))]
        }),
        (Field::Quaternion, Field::Real) => blocks(4, |[a, b, c, d]| {
            let rows = [[a, -b, -c, -d], [b, a, -d, c], [c, d, a, -b], [d, -c, b, a]];
            let places = (0..4).flat_map(|r| (0..4).map(move |c| (r, c)));
            places.map(|(r, c)| (r, c, [rows[r][c], 0, 0, 0])).collect()
        }),
        (Field::Quaternion, Field::Complex) => blocks(2, as_complex),
        _ => entries,
    }
}

/// A quaternion as a complex matrix, as in the catalogue: `[[a + b i, c + d i], [-c + d i, a - b i]]`.
fn as_complex([a, b, c, d]: Quaternion) -> Vec<(usize, usize, Quaternion)> {
    vec![(0, 0, [a, b, 0, 0]), (0, 1, [c, d, 0, 0]), (1, 0, [-c, d, 0, 0]), (1, 1, [a, -b, 0, 0])]
}

/// The imaginary part of the trace.
fn trace(entries: &Entries) -> i64 {
    entries.iter().filter(|(i, j, _)| i == j).map(|(.., q)| q[1]).sum()
}

/// A basis of the combinations of generators without trace.
fn without_trace(generators: Vec<Entries>) -> Vec<Entries> {
    let Some(pivot) = generators.iter().position(|entries| trace(entries) != 0) else {
        return generators;
    };
    let (first, weight) = (generators[pivot].clone(), trace(&generators[pivot]));
    let others = generators.into_iter().enumerate().filter(|(at, _)| *at != pivot);
    let corrected = others.map(|(_, entries)| match trace(&entries) {
        0 => entries,
        trace => {
            let scaled = entries.into_iter().map(|(i, j, q)| (i, j, q.map(|x| x * weight)));
            let taken = first.iter().map(|(i, j, q)| (*i, *j, q.map(|x| -x * trace)));
            scaled.chain(taken).collect()
        }
    });
    corrected.collect()
}

/// An entry of a matrix of the catalogue, where a quaternion is a complex block.
fn written(
    (i, j, q): (usize, usize, Quaternion),
    field: Field,
) -> Vec<(usize, usize, Complex<Rational>)> {
    let complex = |[re, im, ..]: Quaternion| Complex { re: re.into(), im: im.into() };
    match field {
        Field::Quaternion => {
            let block = as_complex(q).into_iter();
            block.map(|(r, c, q)| (2 * i + r, 2 * j + c, complex(q))).collect()
        }
        _ => vec![(i, j, complex(q))],
    }
}
