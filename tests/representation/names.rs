//! Names of representations agree with the tables of physics.

use crate::common::property::properties;
use crate::representation::common::{algebra, weight, weights};
use affinor::representation::HighestWeight;
use affinor::representation::names::{MAX_NAMED, name, names};

#[test]
fn names_agree_with_slansky() {
    // R. Slansky, Phys. Rep. 79 (1981), tables of irreducible representations, in the numbering of
    // Bourbaki
    for (algebra, labels, expected) in [
        ("A1", &[6][..], "7"),
        ("A2", &[1, 0], "3"),
        ("A2", &[0, 1], "3bar"),
        ("A2", &[2, 0], "6"),
        ("A2", &[1, 1], "8"),
        ("A2", &[3, 0], "10"),
        ("A2", &[2, 1], "15"),
        ("A2", &[4, 0], "15'"),
        ("A2", &[0, 5], "21"),
        ("A3", &[2, 0, 0], "10"),
        ("A4", &[0, 1, 0, 0], "10"),
        ("A4", &[2, 0, 0, 0], "15"),
        ("A4", &[0, 0, 0, 3], "35"),
        ("A4", &[0, 0, 1, 1], "40"),
        ("A4", &[0, 1, 0, 1], "45"),
        ("A4", &[0, 0, 2, 0], "50"),
        ("A4", &[1, 1, 1, 1], "1024"),
        ("D5", &[0, 0, 0, 0, 1], "16"),
        ("D5", &[0, 0, 0, 0, 2], "126"),
        ("D5", &[0, 0, 1, 0, 0], "120"),
        ("E6", &[1, 0, 0, 0, 0, 0], "27"),
        ("E6", &[0, 0, 0, 0, 0, 1], "27bar"),
        ("E7", &[0, 0, 0, 0, 0, 0, 1], "56"),
        ("G2", &[3, 0], "77"),
        ("G2", &[0, 2], "77'"),
        ("D4", &[1, 0, 0, 0], "8"),
        ("D4", &[0, 0, 1, 0], "8'"),
        ("D4", &[0, 0, 0, 1], "8''"),
        ("A2 + A1 + T1", &[0, 1, 0, 4], "(3bar,1)(4)"),
        ("T2", &[1, -2], "(1)(-2)"),
    ] {
        assert_eq!(name(&weight(algebra, labels)).as_deref(), Some(expected), "{labels:?}");
    }
    // two representations of G2 of dimension 77, of index 88 and 110
    assert_eq!(weight("G2", &[3, 0]).index(), [88u32.into()]);
    assert_eq!(weight("G2", &[0, 2]).index(), [110u32.into()]);
    assert_eq!(name(&weight("E8", &[1; 8])), None);
}

#[test]
fn weights_are_read_in_several_forms() {
    let su5 = algebra("SU(5)");
    let parse = |text: &str| HighestWeight::parse(&su5, text).unwrap().labels().to_vec();
    for text in ["10", "[0,1,0,0]", "0 1 0 0", "0,1,0,0", " [ 0, 1, 0, 0 ] "] {
        assert_eq!(parse(text), [0, 1, 0, 0], "{text}");
    }
    assert_eq!(parse("5*"), [0, 0, 0, 1]);
    assert_eq!(parse("175'bar"), parse("175bar'"));
    let su2 = algebra("SU(2)");
    assert_eq!(HighestWeight::parse(&su2, "10").unwrap().labels(), [9]);
    assert_eq!(HighestWeight::parse(&su2, "[10]").unwrap().labels(), [10]);
}

#[test]
fn other_texts_are_rejected_with_the_reason() {
    let error = |algebra_name: &str, text: &str| {
        HighestWeight::parse(&algebra(algebra_name), text).unwrap_err().to_string()
    };
    assert!(error("SU(5)", "11").contains("A4 has no representation of dimension 11"));
    assert!(error("SU(3)", "8bar").contains("A2 has 8 = [1,1]"));
    assert!(error("SU(3)", "8''").contains("A2 has 8 = [1,1]"));
    assert!(error("SU(3)", "").contains("has 0 labels, but the rank of A2 is 2"));
    assert!(error("SU(3)", "eight").contains("write Dynkin labels such as"));
    assert!(error("SU(3)", "8barx").contains("A2 has 8"));
    assert!(error("SU(3)", "99999999999").contains("names exist up to dimension 1000000"));
    assert!(error("SU(3)", "[1,0,0]").contains("has 3 labels, but the rank of A2 is 2"));
    assert!(error("SU(3)", "[1,-1]").contains("label 2 of the weight is -1"));
    assert!(error("SU(3) x U(1)", "3").contains("the name has 0 charges, but the algebra needs 1"));
    assert!(error("SU(3) x SU(2)", "3").contains("the name has 1 factors, but the algebra has 2"));
    assert!(error("SU(3) x U(1)", "3(x)").contains("write Dynkin labels"));
    assert!(error("SU(3) x U(1)", "3(1").contains("write Dynkin labels"));
}

/// The representations up to a dimension are those that a box of labels contains, and a list has the
/// names of its members.
#[test]
fn lists_of_representations() {
    for (text, dimension, box_size) in
        [("A1", 60, 60), ("A2", 400, 30), ("B3", 900, 9), ("G2", 2000, 9), ("A2 + A1 + T1", 30, 31)]
    {
        let algebra = algebra(text);
        let found = HighestWeight::up_to(&algebra, dimension).unwrap();
        let rank = algebra.semisimple_rank();
        let boxed = (0..i64::pow(box_size, rank as u32)).map(|code| {
            let mut labels = vec![0; algebra.rank()];
            let digits = (0..rank).map(|i| code / i64::pow(box_size, i as u32) % box_size);
            labels.iter_mut().zip(digits).for_each(|(label, digit)| *label = digit);
            HighestWeight::new(&algebra, labels).unwrap()
        });
        let mut expected: Vec<_> = boxed.filter(|w| w.dimension() <= dimension.into()).collect();
        expected.sort_by_key(|w| (w.dimension(), w.labels().to_vec()));
        assert_eq!(found, expected, "{text}");
        let each: Vec<_> = found.iter().map(name).collect();
        assert_eq!(names(&found), each);
        // the order does not matter
        let backwards = names(found.iter().rev());
        assert!(backwards.iter().rev().eq(&each));
    }
    assert!(names([]).is_empty());
    let error = HighestWeight::up_to(&algebra("E8"), MAX_NAMED + 1).unwrap_err().to_string();
    assert!(error.contains("the dimension 1000001"), "{error}");
}

properties! {
    #![cases(100)]

    #[test]
    fn names_are_unique(weight in weights(2000)) {
        let name = name(&weight).unwrap();
        proptest::prop_assert_eq!(HighestWeight::parse(weight.algebra(), &name).unwrap(), weight);
    }
}
