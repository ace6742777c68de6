//! Algebras of quaternionic matrices, written as complex matrices of twice the size: a quaternion
//! `a + b i + c j + d k` is `[[a + b i, c + d i], [-c + d i, a - b i]]`.

use super::{Entry, Family, Reader, numbered, pairs};
use crate::algebra::Complex;
use affinor_tensors::Rational;

/// The family sl(n,H) = su*(2n).
pub(super) const LINEAR: Family = Family {
    pattern: "sl(n,H)",
    needs: "n >= 1",
    summary: "su*(2n): quaternionic n x n matrices with trace of real part 0; basis e1.. = q E_ij \
              for i /= j row by row and q = 1, i, j, k, then i, j, k times each E_kk, then \
              E_kk - E_k+1,k+1",
    example: "sl(2,H)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_mul(n[0]).saturating_mul(4) - 1),
        build: |name, n| linear(name, n[0]),
    },
};

/// The family sp(p,q).
pub(super) const INDEFINITE: Family = Family {
    pattern: "sp(p,q)",
    needs: "p, q >= 1",
    summary: "quaternionic matrices that preserve eta = diag(1 (p times), -1 (q times)); basis e1.. = \
              E_ij - eta_i eta_j E_ji, then q (E_ij + eta_i eta_j E_ji) for q = i, j, k, for each i < j, \
              then i, j, k times each E_kk",
    example: "sp(1,1)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| {
            let m = n[0].saturating_add(n[1]);
            (n[0] >= 1 && n[1] >= 1)
                .then(|| m.saturating_mul(m.saturating_mul(2).saturating_add(1)))
        },
        build: |name, n| symplectic(name, &[vec![1; n[0]], vec![-1; n[1]]].concat()),
    },
};

/// The family usp(2n), the compact form of sp(2n).
pub(super) const COMPACT: Family = Family {
    pattern: "usp(2n)",
    needs: "an even number, at least 2",
    summary: "compact symplectic, sp(n): anti-hermitian quaternionic n x n matrices; basis as in sp(p,q) \
              with q = 0",
    example: "usp(4)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2 && n[0] % 2 == 0).then(|| (n[0] / 2).saturating_mul(n[0] + 1)),
        build: |name, n| symplectic(name, &vec![1; n[0] / 2]),
    },
};

/// The family so*(2n).
pub(super) const SKEW: Family = Family {
    pattern: "so*(2n)",
    needs: "an even number, at least 2",
    summary: "quaternionic n x n matrices M with M^* j + j M = 0; basis e1.. = E_ab - E_ba, \
              i (E_ab - E_ba), j (E_ab + E_ba), k (E_ab - E_ba) for each a < b, then j E_kk",
    example: "so*(4)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 2 && n[0] % 2 == 0).then(|| (n[0] / 2).saturating_mul(n[0] - 1)),
        build: |name, n| skew(name, n[0] / 2),
    },
};

/// A unit of the quaternions: 0 to 3 are 1, i, j, k.
type Unit = usize;
const REAL: Unit = 0;
const IMAGINARY: [Unit; 3] = [1, 2, 3];

/// The nonzero entries of the complex form of the matrix `sign * unit * E_ij`.
fn entry((i, j): (usize, usize), unit: Unit, sign: i64) -> Vec<(usize, usize, Complex<Rational>)> {
    let value =
        |re: i64, im: i64| Complex { re: Rational::from(sign * re), im: Rational::from(sign * im) };
    let (a, b) = match unit {
        0 => ((0, 0, value(1, 0)), (1, 1, value(1, 0))),
        1 => ((0, 0, value(0, 1)), (1, 1, value(0, -1))),
        2 => ((0, 1, value(1, 0)), (1, 0, value(-1, 0))),
        _ => ((0, 1, value(0, 1)), (1, 0, value(0, 1))),
    };
    [a, b].map(|(row, column, value)| (2 * i + row, 2 * j + column, value)).to_vec()
}

fn build(name: String, n: usize, matrices: Vec<Vec<(usize, usize, Complex<Rational>)>>) -> Entry {
    Entry::of_matrices(name, numbered("e", matrices.len()), 2 * n, matrices)
}

fn linear(name: String, n: usize) -> Entry {
    let off = (0..n * n).map(|at| (at / n, at % n)).filter(|(i, j)| i != j);
    let off = off.flat_map(|at| (0..4).map(move |unit| entry(at, unit, 1)));
    let on = (0..n).flat_map(|k| IMAGINARY.map(move |unit| entry((k, k), unit, 1)));
    let real = (1..n).map(|k| [entry((k - 1, k - 1), REAL, 1), entry((k, k), REAL, -1)].concat());
    build(name, n, off.chain(on).chain(real).collect())
}

fn symplectic(name: String, signs: &[i64]) -> Entry {
    let n = signs.len();
    let off = pairs(n).flat_map(|(i, j)| {
        let sign = signs[i] * signs[j];
        let both = move |unit, sign| [entry((i, j), unit, 1), entry((j, i), unit, sign)].concat();
        [REAL]
            .map(|unit| both(unit, -sign))
            .into_iter()
            .chain(IMAGINARY.map(|unit| both(unit, sign)))
    });
    let on = (0..n).flat_map(|k| IMAGINARY.map(move |unit| entry((k, k), unit, 1)));
    build(name, n, off.chain(on).collect())
}

fn skew(name: String, n: usize) -> Entry {
    let off = pairs(n).flat_map(|(a, b)| {
        [-1, -1, 1, -1]
            .into_iter()
            .enumerate()
            .map(move |(unit, sign)| [entry((a, b), unit, 1), entry((b, a), unit, sign)].concat())
    });
    let on = (0..n).map(|k| entry((k, k), 2, 1));
    build(name, n, off.chain(on).collect())
}
