//! Symmetric and exterior powers and Schur functors agree with characters and with dimensions.

use crate::common::property::properties;
use crate::representation::common::{PRIME, character_at, power, representation, torus, weights};
use affinor::representation::{Decomposition, RepresentationError};
use num_bigint::BigInt;

/// The dimension of the Schur functor of a partition: the product of `(n + j - i)/hook`.
fn schur_dimension(n: i64, partition: &[usize]) -> BigInt {
    let (mut above, mut below) = (BigInt::from(1), BigInt::from(1));
    for (i, &row) in partition.iter().enumerate() {
        for j in 0..row {
            let leg = partition[i..].iter().filter(|other| **other > j).count();
            above *= n + j as i64 - i as i64;
            below *= row - j - 1 + leg;
        }
    }
    above / below
}

#[test]
fn powers_of_physics_and_geometry() {
    for (algebra, v, partition, expected) in [
        ("SU(3)", "3", &[2][..], "6"),
        ("SU(3)", "3", &[1, 1], "3bar"),
        ("SU(3)", "3", &[1, 1, 1], "1"),
        ("SU(3)", "3", &[1, 1, 1, 1], "0"),
        ("SU(3)", "3", &[2, 1], "8"),
        ("SU(2)", "2", &[5], "6"),
        ("SO(10)", "16", &[2], "10 + 126"),
        ("G2", "7", &[1, 1, 1], "1 + 7 + 27"),
        ("E6", "27", &[3], "1 + 650 + 3003"),
        ("E8", "248", &[1, 1], "248 + 30380"),
        ("E8", "248", &[2], "1 + 3875 + 27000"),
        ("SU(5)", "5", &[], "1"),
    ] {
        let v = representation(algebra, v);
        let found = v.schur(partition).unwrap();
        assert_eq!(found.to_string(), expected, "{algebra} {partition:?}");
        let n = i64::try_from(v.dimension()).unwrap();
        assert_eq!(found.dimension(), schur_dimension(n, partition), "{algebra} {partition:?}");
    }
}

#[test]
fn the_exterior_algebra_ends_at_the_dimension() {
    let v = representation("F4", "26");
    let top = v.exterior_power(26).unwrap();
    assert_eq!(top.to_string(), "1");
    assert_eq!(v.exterior_power(27).unwrap().components().len(), 0);
    assert_eq!(v.exterior_power(20).unwrap(), v.exterior_power(6).unwrap());
}

#[test]
fn degrees_and_partitions_are_checked() {
    let v = representation("A2", "3");
    let error = v.schur(&[1, 2]).unwrap_err();
    assert!(matches!(error, RepresentationError::NotACharacter { .. }));
    for degree in [65, usize::MAX] {
        assert!(matches!(v.symmetric_power(degree), Err(RepresentationError::TooLarge { .. })));
        assert!(matches!(v.exterior_power(degree), Err(RepresentationError::TooLarge { .. })));
    }
    assert!(v.schur(&[usize::MAX, usize::MAX]).is_err());
}

properties! {
    #![cases(40)]

    #[test]
    fn powers_fill_the_square_and_the_cube(weight in weights(60)) {
        let v = Decomposition::irreducible(&weight);
        let square = v.tensor(&v).unwrap();
        let [s2, e2] = [v.symmetric_power(2).unwrap(), v.exterior_power(2).unwrap()];
        proptest::prop_assert_eq!(s2.plus(&e2, 1).unwrap(), square.clone());
        let cube = square.tensor(&v).unwrap();
        let [s3, e3] = [v.symmetric_power(3).unwrap(), v.exterior_power(3).unwrap()];
        let mixed = v.schur(&[2, 1]).unwrap();
        proptest::prop_assert_eq!(s3.plus(&e3, 1).unwrap().plus(&mixed, 2).unwrap(), cube);
    }

    /// The generating functions: `h_4` and `e_4` from the power sums `χ(t^k)`.
    #[test]
    fn characters_of_powers_are_newton_sums(weight in weights(12)) {
        let v = Decomposition::irreducible(&weight);
        let t = torus(weight.algebra(), 11);
        let p: Vec<u64> = (0..5).map(|k| character_at(&v, &t, k)).collect();
        for (sign, found) in [(1, v.symmetric_power(4).unwrap()), (-1, v.exterior_power(4).unwrap())] {
            let mut h = vec![1_u64];
            for n in 1..=4 {
                let sum = (1..=n).fold(0, |sum, i| {
                    let term = p[i] * h[n - i] % PRIME;
                    let negative = sign < 0 && i % 2 == 0;
                    (sum + if negative { PRIME - term } else { term }) % PRIME
                });
                h.push(sum * power(n as u64, -1) % PRIME);
            }
            proptest::prop_assert_eq!(character_at(&found, &t, 1), h[4]);
        }
    }
}
