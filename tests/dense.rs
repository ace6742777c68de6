//! Tensors of rank 2 and nalgebra's matrices are the same numbers in the same places.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::dense::{from_dmatrix, to_dmatrix};
use affinor::{Bracket, Error, LieAlgebra};
use affinor_tensors::{Down, Tensor, Up};
use nalgebra::DMatrix;

#[test]
fn the_first_index_is_the_row() {
    // [e1, e2] = e2: ad of n = (2, 3) takes e1 to -3 e2 and e2 to 2 e2
    let bracket = Bracket::from_fn(&["e1", "e2"], |_, _| vec![(1, 1.0)]).unwrap();
    let ad = LieAlgebra::try_from(bracket).unwrap().ad(&[2.0, 3.0]).unwrap();
    let matrix = to_dmatrix(&ad).unwrap();
    assert_eq!(matrix, DMatrix::from_row_slice(2, 2, &[0.0, 0.0, -3.0, 2.0]));
    assert_eq!(from_dmatrix(&matrix, [Up, Down]).unwrap(), ad);
}

#[test]
fn slots_are_those_asked_for() {
    let matrix = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 0.0, -4.0, 0.5, 0.0, 0.0, 6.0]);
    let form = from_dmatrix(&matrix, [Down, Down]).unwrap();
    assert_eq!(form.slots(), [Down, Down]);
    assert_eq!((form.len(), form.get(&[0, 1]), form.get(&[1, 2])), (5, 2.0, 0.5));
    assert_eq!(to_dmatrix(&form).unwrap(), matrix);
}

#[test]
fn other_shapes_are_refused() {
    let vector = Tensor::vector(&[1.0, 2.0], Up);
    let error = to_dmatrix(&vector).unwrap_err();
    assert_eq!(error.to_string(), "a matrix should have rank 2, not rank 1");
    let wide = DMatrix::<f64>::zeros(2, 3);
    match from_dmatrix(&wide, [Up, Down]) {
        Err(Error::Shape { found, .. }) => assert_eq!(found, "2 rows and 3 columns"),
        other => panic!("{other:?}"),
    }
}
