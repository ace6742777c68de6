//! Floats as values of exact numbers.

use affinor_tensors::{Field, Notation, Rational, Ring};
use num_traits::pow;

fn power_of_ten(exponent: i32) -> Rational {
    let power = pow(Rational::from(10), exponent.unsigned_abs() as usize);
    if exponent < 0 { power.recip().unwrap() } else { power }
}

/// A conversion is exact to rounding error, or an error: above the largest float, and below the
/// smallest normal float unless the number is the shortest decimal of a float.
#[test]
fn conversion_keeps_the_digits_or_refuses() {
    for exponent in -420..=420 {
        for digits in [1, 3, 17, 123_456_789_012_345_678_i64] {
            for sign in [1, -1] {
                let number = power_of_ten(exponent) * &Rational::from(sign * digits);
                let text = format!("{}e{exponent}", sign * digits);
                let nearest: f64 = text.parse().unwrap();
                match f64::from_rational(&number) {
                    Some(x) => assert_eq!(x, nearest, "{text}"),
                    None => assert!(!nearest.is_normal(), "{text}"),
                }
                let lost = nearest.is_subnormal() && digits > 1 << 50;
                if nearest == 0.0 || nearest.is_infinite() || lost {
                    assert_eq!(f64::from_rational(&number), None, "{text}");
                }
            }
        }
    }
    assert_eq!(f64::from_rational(&Rational::from(0)), Some(0.0));
    // every subnormal float is read back as it is written
    for bits in [1, 2, 3, 77, 1 << 30, (1 << 52) - 1] {
        let x = f64::from_bits(bits);
        let text = format!("{x:e}");
        let (mantissa, exponent) = text.split_once('e').unwrap();
        let behind = mantissa.split_once('.').map_or(0, |(_, behind)| behind.len() as i32);
        let digits: i64 = mantissa.replace('.', "").parse().unwrap();
        let exact =
            power_of_ten(exponent.parse::<i32>().unwrap() - behind) * &Rational::from(digits);
        assert_eq!(f64::from_rational(&exact), Some(x), "{text}");
    }
    assert!(Rational::from(0).vanishes());
}
