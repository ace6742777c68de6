//! Conversions of tensors to and from nalgebra, ndarray and serde preserve numbers and positions.

use crate::common::property::properties;
use crate::common::tensors::tensors;
use affinor_tensors::{Down, Rational, Symbolic, Tensor, TensorError, Tolerance, TrackedFloat, Up};
use nalgebra::DMatrix;
use ndarray::ArrayD;
use proptest::prelude::*;

#[test]
fn the_first_index_is_the_row() -> Result<(), TensorError> {
    let components = [([0, 1], 2.0), ([2, 1], 0.5)];
    let form = Tensor::from_components(3, &[Down, Down], components)?;
    let matrix = form.to_dmatrix()?;
    assert_eq!(matrix, DMatrix::from_row_slice(3, 3, &[0., 2., 0., 0., 0., 0., 0., 0.5, 0.]));
    let back = Tensor::from_dmatrix(&matrix, [Up, Down])?;
    assert_eq!((back.slots(), back.len(), back[[2, 1]]), (&[Up, Down][..], 2, 0.5));
    Ok(())
}

#[test]
fn other_shapes_are_refused() -> Result<(), TensorError> {
    let error = Tensor::vector(&[1.0, 2.0], Up).to_dmatrix().unwrap_err();
    assert_eq!(error, TensorError::Rank { rank: 1, given: 2 });
    let error = Tensor::from_dmatrix(&DMatrix::<f64>::zeros(2, 3), [Up, Down]).unwrap_err();
    assert_eq!(error.to_string(), "the sides must have equal lengths, but the shape is [2, 3]");
    let array = ArrayD::<f64>::zeros(vec![2, 2, 3]);
    let error = Tensor::from_array(&array, &[Up, Down, Down]).unwrap_err();
    assert_eq!(error, TensorError::NotSquare { shape: vec![2, 2, 3] });
    let error = Tensor::from_array(&array, &[Up, Down]).unwrap_err();
    assert_eq!(error, TensorError::Rank { rank: 2, given: 3 });
    assert!(Tensor::<f64>::zero(256, &[Up; 3])?.to_array().is_ok());
    let error = Tensor::<f64>::zero(257, &[Up; 3])?.to_array().unwrap_err();
    assert_eq!(error, TensorError::TooLarge { dimension: 257, rank: 3 });
    Ok(())
}

properties! {
    #![cases(64)]

    #[test]
    fn there_and_back(tensor in tensors(3, [Up, Down, Down])) {
        let array = tensor.to_array()?;
        prop_assert_eq!(array.len(), 27);
        for (at, value) in array.indexed_iter() {
            prop_assert_eq!(value, &tensor[[at[0], at[1], at[2]]]);
        }
        prop_assert_eq!(&Tensor::from_array(&array, tensor.slots())?, &tensor);
        // with another memory order
        let transposed = Tensor::from_array(&array.t().to_owned(), &[Down, Down, Up])?;
        prop_assert_eq!(&transposed, &tensor.permute(&[2, 1, 0])?);

        let tensor = tensor.with_tolerance(Tolerance::new(1e-6).unwrap());
        let text = serde_json::to_string(&tensor).unwrap();
        let read: Tensor<Rational> = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(read.tolerance(), tensor.tolerance());
        prop_assert_eq!(read, tensor);
    }
}

#[test]
fn the_written_forms() {
    let half = Rational::new(-1, 2).unwrap();
    let tensor = Tensor::from_components(3, &[Up, Down], [([0, 1], half)]).unwrap();
    let text = r#"{"schema":"affinor.tensor/1","dimension":3,"slots":["up","down"],"tolerance":0.5,"components":[[[1,2],"-1/2"]]}"#;
    let tolerance = Tolerance::new(0.5).unwrap();
    assert_eq!(serde_json::to_string(&tensor.with_tolerance(tolerance)).unwrap(), text);
    let value: Symbolic = "(a^2 - b)/(4*c)".parse().unwrap();
    assert_eq!(serde_json::to_string(&value).unwrap(), r#""(a^2 - b)/(4*c)""#);
    assert_eq!(serde_json::from_str::<Symbolic>(r#""(a^2 - b)/(4*c)""#).unwrap(), value);
    let product = TrackedFloat::new(0.1) * TrackedFloat::new(0.1);
    let text = serde_json::to_string(&product).unwrap();
    let read: TrackedFloat = serde_json::from_str(&text).unwrap();
    assert_eq!((read.value(), read.error()), (product.value(), product.error()));
}

#[test]
fn what_is_read_is_checked() {
    let read = |dimension: &str, slots: &str, tolerance: &str, at: &str, value: &str| {
        let text = format!(
            r#"{{"schema": "affinor.tensor/1", "dimension": {dimension}, "slots": [{slots}],
            "tolerance": {tolerance}, "components": [[[{at}], {value}]]}}"#
        );
        let tensor = serde_json::from_str::<Tensor<Rational>>(&text);
        tensor.map(|tensor| tensor.to_string()).map_err(|error| error.to_string())
    };
    assert_eq!(read("2", r#""up", "down""#, "0", "2, 1", r#""3/6""#), Ok("^2_1 = 1/2".into()));
    for (given, message) in [
        (("2", r#""up""#, "0", "3", r#""1""#), "index 2 is out of range for dimension 2"),
        (("2", r#""up""#, "0", "0", r#""1""#), "an index is 0, but indices count from 1"),
        (("2", r#""up""#, "0", "1, 1", r#""1""#), "a tensor of rank 1 was given 2 indices"),
        (("2", r#""up""#, "0", "1", r#""1/0""#), "`1/0`: division by zero"),
        (("2", r#""side""#, "0", "1", r#""1""#), "unknown variant `side`"),
        (("2", r#""up""#, "1", "1", r#""1""#), "the tolerance must be"),
        (("9999999999", r#""up", "up""#, "0", "1, 1", r#""1""#), "is too large"),
    ] {
        let (dimension, slots, tolerance, at, value) = given;
        let error = read(dimension, slots, tolerance, at, value).unwrap_err();
        assert!(error.contains(message), "{error}");
    }
    // a repeated index is an error, not a sum
    let twice = r#"{"schema": "affinor.tensor/1", "dimension": 2, "slots": ["up", "down"], "tolerance": 0,
        "components": [[[2, 1], "1"], [[1, 1], "1"], [[2, 1], "1"]]}"#;
    let error = serde_json::from_str::<Tensor<Rational>>(twice).unwrap_err().to_string();
    assert!(error.contains("the component [2, 1] is given twice"), "{error}");
    let other = r#"{"schema": "affinor.tensor/2", "dimension": 1, "slots": [], "tolerance": 0, "components": []}"#;
    let error = serde_json::from_str::<Tensor<Rational>>(other).unwrap_err().to_string();
    assert!(error.contains("expected schema affinor.tensor/1, got affinor.tensor/2"), "{error}");
}

/// NaN and infinity are not written: JSON would write null for them.
#[test]
fn what_is_no_number_is_not_written() {
    for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let message = format!("a component is {wild}, not a finite number");
        let floats = Tensor::vector(&[1.0, wild], Up);
        assert_eq!(serde_json::to_string(&floats).unwrap_err().to_string(), message);
        let tracked = serde_json::to_string(&floats.map(|v| TrackedFloat::new(*v)));
        assert_eq!(tracked.unwrap_err().to_string(), message);
    }
}
