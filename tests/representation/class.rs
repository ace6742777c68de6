//! Indicators and congruency classes agree with invariant forms and with products.

use crate::common::property::properties;
use crate::representation::common::{pairs, weight, weights};
use affinor::representation::{Decomposition, HighestWeight, Indicator};

#[test]
fn indicators_agree_with_tables() {
    use Indicator::{Complex, Quaternionic, Real};
    for (name, labels, indicator) in [
        ("A1", &[1][..], Quaternionic),
        ("A1", &[2], Real),
        ("A2", &[1, 0], Complex),
        ("A5", &[0, 0, 1, 0, 0], Quaternionic),
        ("A3", &[0, 1, 0], Real),
        ("B3", &[0, 0, 1], Real),
        ("B2", &[0, 1], Quaternionic),
        ("C3", &[1, 0, 0], Quaternionic),
        ("C3", &[0, 1, 0], Real),
        ("D4", &[0, 0, 0, 1], Real),
        ("D5", &[0, 0, 0, 0, 1], Complex),
        ("D6", &[0, 0, 0, 0, 0, 1], Quaternionic),
        ("E6", &[1, 0, 0, 0, 0, 0], Complex),
        ("E7", &[0, 0, 0, 0, 0, 0, 1], Quaternionic),
        ("E8", &[0, 0, 0, 0, 0, 0, 0, 1], Real),
        ("A1 + A1", &[1, 1], Real),
        ("A1 + T1", &[1, 2], Complex),
    ] {
        assert_eq!(weight(name, labels).indicator(), indicator, "{name} {labels:?}");
    }
}

properties! {
    #![cases(100)]

    /// A real representation has an invariant symmetric form, a quaternionic one an invariant
    /// antisymmetric form, a complex one neither.
    #[test]
    fn the_indicator_counts_invariant_forms(weight in weights(300)) {
        let trivial = HighestWeight::trivial(weight.algebra());
        let v = Decomposition::irreducible(&weight);
        let symmetric = v.symmetric_power(2).unwrap().multiplicity(&trivial);
        let antisymmetric = v.exterior_power(2).unwrap().multiplicity(&trivial);
        let value = i128::from(weight.indicator().value());
        proptest::prop_assert_eq!(value, symmetric - antisymmetric);
    }

    #[test]
    fn congruency_classes_add_in_products((left, right) in pairs(300)) {
        let sums: Vec<Vec<(i64, i64)>> = left.congruency_class().iter()
            .zip(right.congruency_class())
            .map(|(a, b)| a.iter().zip(b).map(|((x, m), (y, _))| ((x + y) % m, *m)).collect())
            .collect();
        for (weight, _) in left.tensor(&right).unwrap().components() {
            proptest::prop_assert_eq!(&weight.congruency_class(), &sums);
        }
    }
}
