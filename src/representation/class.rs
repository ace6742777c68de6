//! Reality and congruency class of representations.

use super::HighestWeight;
use crate::algebra::roots::{CartanType, Series};
use std::fmt;

/// The Frobenius-Schur indicator of an irreducible representation of the compact group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Indicator {
    /// The representation is the complexification of a real one and has an invariant symmetric
    /// form; the indicator is 1.
    Real,
    /// The representation is not isomorphic to its dual; the indicator is 0.
    Complex,
    /// The representation has a quaternionic structure and an invariant antisymmetric form; the
    /// indicator is -1.
    Quaternionic,
}

impl Indicator {
    /// The value `1`, `0` or `-1`: the mean of the character at `g²`.
    pub fn value(self) -> i64 {
        match self {
            Indicator::Real => 1,
            Indicator::Complex => 0,
            Indicator::Quaternionic => -1,
        }
    }
}

impl fmt::Display for Indicator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Indicator::Real => "real",
            Indicator::Complex => "complex",
            Indicator::Quaternionic => "quaternionic",
        })
    }
}

impl HighestWeight {
    /// The Frobenius-Schur indicator. A self-dual representation is real if `<λ, 2ρ^∨>` is even,
    /// else quaternionic (Bourbaki, *Lie* VIII, 7.5, prop. 12).
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, Indicator, ReductiveAlgebra};
    /// let e7: ReductiveAlgebra = "E7".parse()?;
    /// let weight = HighestWeight::new(&e7, [0, 0, 0, 0, 0, 0, 1])?;
    /// assert_eq!(weight.indicator(), Indicator::Quaternionic);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn indicator(&self) -> Indicator {
        if self.dual() != *self {
            return Indicator::Complex;
        }
        let odd = self.algebra().positive_roots().iter().fold(false, |odd, root| {
            let pairs = root.coroot.iter().zip(self.labels());
            odd ^ pairs.fold(false, |odd, (c, label)| odd ^ (c * label % 2 != 0))
        });
        if odd { Indicator::Quaternionic } else { Indicator::Real }
    }

    /// The congruency class of each simple factor: the class of the weight modulo the root lattice,
    /// as residues with their moduli (Lemire and Patera, *J. Math. Phys.* 21 (1980) 2026).
    ///
    /// | type | class |
    /// |---|---|
    /// | A_n | `λ_1 + 2 λ_2 + ... + n λ_n` modulo n+1 |
    /// | B_n | `λ_n` modulo 2 |
    /// | C_n | `λ_1 + λ_3 + λ_5 + ...` modulo 2 |
    /// | D_n | `λ_(n-1) + λ_n` modulo 2; `2 λ_1 + 2 λ_3 + ... + (n-2) λ_(n-1) + n λ_n` modulo 4, with the sum over the odd indices up to n-2 |
    /// | E6 | `λ_1 - λ_3 + λ_5 - λ_6` modulo 3 |
    /// | E7 | `λ_2 + λ_5 + λ_7` modulo 2 |
    /// | E8, F4, G2 | one class, without residues |
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let so10: ReductiveAlgebra = "SO(10)".parse()?;
    /// let spinor = HighestWeight::new(&so10, [0, 0, 0, 0, 1])?;
    /// assert_eq!(spinor.congruency_class(), [vec![(1, 2), (1, 4)]]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn congruency_class(&self) -> Vec<Vec<(i64, i64)>> {
        let factors = self.algebra().simple_factors().iter().enumerate();
        let labels = |at| &self.labels()[self.algebra().positions(at)];
        factors.map(|(at, factor)| class(*factor, labels(at))).collect()
    }
}

fn class(factor: CartanType, labels: &[i64]) -> Vec<(i64, i64)> {
    let n = factor.rank();
    let sum = |modulus: i64, coefficient: &dyn Fn(usize) -> i64| {
        let terms = labels.iter().enumerate().map(|(at, label)| coefficient(at + 1) * label);
        (terms.sum::<i64>().rem_euclid(modulus), modulus)
    };
    match (factor.series(), n) {
        (Series::A, _) => vec![sum(n as i64 + 1, &|i| i as i64)],
        (Series::B, _) => vec![sum(2, &|i| i64::from(i == n))],
        (Series::C, _) => vec![sum(2, &|i| i as i64 % 2)],
        (Series::D, _) => vec![
            sum(2, &|i| i64::from(i + 1 >= n)),
            sum(4, &|i| match n - i {
                0 => n as i64,
                1 => n as i64 - 2,
                _ => 2 * (i as i64 % 2),
            }),
        ],
        (Series::E, 6) => vec![sum(3, &|i| [1, 0, -1, 0, 1, -1][i - 1])],
        (Series::E, 7) => vec![sum(2, &|i| i64::from([2, 5, 7].contains(&i)))],
        _ => vec![],
    }
}
