//! Jets agree with the second derivatives of the crate num-dual.

use crate::common::property::properties;
use affinor_tensors::{Field, Jet, Ring};
use num_dual::{DualNum, HyperDual64};
use num_traits::{One, Zero};
use proptest::prelude::*;

/// The same formula for both types.
macro_rules! formula {
    ($x:expr, $y:expr, $one:expr) => {{
        let (x, y, one) = ($x, $y, $one);
        let s = (x.clone() * x.clone() + y.clone() * y.clone() + one.clone()).sqrt();
        let u = (x.clone() * y.clone()).sin() * x.exp() / s.clone();
        u - y.cos() * s.ln() / (one + x.clone() * x)
    }};
}

properties! {
    #![cases(256)]

    #[test]
    fn derivatives_are_those_of_num_dual(point in [-3.0f64..3.0, -3.0f64..3.0]) {
        let [x, y] = Jet::coordinates(point);
        let f = formula!(x, y, Jet::constant(1.0));
        for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let seed = |at: usize| {
                HyperDual64::new(point[at], f64::from(at == a), f64::from(at == b), 0.0)
            };
            let h = formula!(seed(0), seed(1), HyperDual64::from_re(1.0));
            let near = |u: f64, v: f64| (u - v).abs() <= 1e-9 * (1.0 + u.abs());
            prop_assert!(near(f.value(), h.re));
            prop_assert!(near(f.derivative(a).value(), h.eps1));
            prop_assert!(near(f.derivative(a).derivative(b).value(), h.eps1eps2));
        }
    }
}

#[test]
fn what_is_not_known_is_no_number() {
    let [x] = Jet::coordinates([2.0]);
    let cube = x.clone() * &x * &x;
    assert_eq!(cube.derivative(0).derivative(0).value(), 12.0);
    assert!(cube.derivative(0).derivative(0).derivative(0).value().is_nan());
    assert_eq!(Jet::constant(3.0).derivative(0), Jet::zero());
}

#[test]
fn zero_is_the_whole_jet() {
    let [x, y] = Jet::coordinates([0.0, 1.0]);
    assert!(!x.vanishes() && !x.is_zero() && x.recip().is_none());
    assert!((x.clone() - &x).vanishes());
    assert_eq!(y.recip().unwrap() * &y, Jet::one() + &(y.clone() - &y));
    assert_eq!(Jet::from_quotient(1, 4).unwrap().value(), 0.25);
    assert!(Jet::from_quotient(1, 0).is_none());
}
