//! Every constructor that accepts floats reports NaN and infinity, with the component.
//!
//! Guards `frame::expect_numbers` and the constructors that call it.

use crate::common::labels;
use affinor::algebra::Complex;
use affinor::geometry::forms::Form;
use affinor::geometry::metric_affine::{contorsion, disformation};
use affinor::{BasisChange, Bracket, Connection, Error, Frame, MatrixBasis, Metric};
use affinor_tensors::{Down, Tensor, Tolerance, Up, Variance};

/// The tensor with `value` at an index and at its cyclic successors, and 1 or 0 elsewhere.
fn with<const RANK: usize>(slots: [Variance; RANK], at: [usize; RANK], value: f64) -> Tensor<f64> {
    Tensor::from_fn(3, slots, |place| match place == at {
        true => value,
        false => f64::from(u8::from(place.iter().all(|i| *i == place[0]))),
    })
    .unwrap()
}

fn refused<T: std::fmt::Debug>(result: Result<T, Error>, expected: &[usize], value: f64) {
    match result {
        Err(Error::NotFinite { at, value: found, .. }) => {
            assert_eq!((at.as_slice(), found), (expected, value.to_string()));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_constructor_says_what_is_no_number() {
    let flat = Frame::invariant(labels(3), Tensor::zero(3, &[Up, Down, Down]).unwrap()).unwrap();
    let identity = Tensor::from_fn(3, [Down, Down], |[i, j]| f64::from(u8::from(i == j))).unwrap();
    let metric = Metric::new(labels(3), identity).unwrap();
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let third = with([Up, Down, Down], [2, 0, 1], value);
        refused(Bracket::new(labels(3), third.clone()), &[3, 1, 2], value);
        refused(Frame::invariant(labels(3), third.clone()), &[3, 1, 2], value);
        let derivations = std::sync::Arc::new(|_: usize, _: &f64| 0.0);
        refused(Frame::moving(labels(3), third.clone(), derivations), &[3, 1, 2], value);
        refused(Connection::new(flat.clone(), third), &[3, 1, 2], value);
        let given = [(1, 2, 0, 1.0), (0, 1, 2, value)];
        refused(Bracket::from_constants(labels(3), given), &[3, 1, 2], value);
        let both = [(0, 1, 2, value), (1, 0, 2, -value)];
        refused(Bracket::from_constants(labels(3), both), &[3, 1, 2], value);
        let listed = |j: usize, k: usize| if (j, k) == (0, 1) { vec![(2, value)] } else { vec![] };
        refused(Bracket::from_fn(&["x", "y", "z"], listed), &[3, 1, 2], value);
        for at in [[0, 1], [2, 2]] {
            let shown = at.map(|i| i + 1);
            refused(Metric::new(labels(3), with([Down, Down], at, value)), &shown, value);
            refused(BasisChange::new(with([Up, Down], at, value)), &shown, value);
        }
        let two_form = with([Down, Down], [0, 1], value);
        refused(Form::new(two_form), &[1, 2], value);
        refused(Form::new(Tensor::vector(&[1.0, value], Down)), &[2], value);
        let torsion = with([Up, Down, Down], [2, 0, 1], value);
        refused(contorsion(&metric, &torsion), &[3, 1, 2], value);
        let nonmetricity = with([Down; 3], [2, 0, 1], value);
        refused(disformation(&metric, &nonmetricity), &[3, 1, 2], value);
        let matrices = vec![vec![(0, 1, Complex::real(value))]];
        let basis = MatrixBasis::new(labels(1), 2, matrices, Tolerance::default());
        refused(basis, &[1, 2], value);
    }
    let said = Metric::new(labels(3), with([Down, Down], [0, 1], f64::NAN)).unwrap_err();
    assert_eq!(said.to_string(), "the metric: the component 1,2 = NaN is not a finite number");
}
