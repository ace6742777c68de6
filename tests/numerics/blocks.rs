//! Programs on blocks of rows agree with closed forms, with the evaluation of one row, and with derivatives.

use affinor::numerics::blocks::{BlockProgram, Column};
use affinor::{Metric, Tensor};
use affinor_tensors::scalar::{Function, StraightLine, derivatives};
use affinor_tensors::{Down, Notation, Recorded};
use nalgebra::{DMatrix, Matrix3};

/// Pseudorandom numbers between -1 and 1.
fn number(seed: usize) -> f64 {
    ((seed as f64 * 12.9898).sin() * 43_758.545_3).fract()
}

fn columns(rows: &[f64], width: usize) -> Vec<Column<'_>> {
    (0..width).map(|offset| Column { numbers: rows, offset, step: width }).collect()
}

/// The inverse of symmetric matrices, whose program chooses its pivots, and its derivative `-g^-1 h g^-1`.
#[test]
fn inverses_of_metrics_and_their_derivatives() {
    let names: Vec<String> = (0..3).flat_map(|i| (i..3).map(move |j| format!("g{i}{j}"))).collect();
    let entry = |i: usize, j: usize| Recorded::input(&format!("g{}{}", i.min(j), i.max(j)));
    let entries = (0..9).map(|at| ([at / 3, at % 3], entry(at / 3, at % 3)));
    let g = Tensor::from_components(3, &[Down, Down], entries).unwrap();
    let metric = Metric::new(["x", "y", "z"], g).unwrap();
    let (places, values): (Vec<usize>, Vec<Recorded>) =
        metric.inverse().components().map(|(at, v)| (at[0] * 3 + at[1], v.clone())).unzip();
    let program = BlockProgram::new(&StraightLine::new(&values), &names, &places).unwrap();
    for count in [1, 7, 8, 9, 30] {
        let numbers: Vec<f64> = (0..count * 6).map(|at| number(at + count)).collect();
        let rates: Vec<f64> = (0..count * 6).map(|at| number(at + 999)).collect();
        let symmetric =
            |n: &[f64]| Matrix3::new(n[0], n[1], n[2], n[1], n[3], n[4], n[2], n[4], n[5]);
        let mut inverse = vec![f64::NAN; count * 9];
        program.evaluate(&columns(&numbers, 6), 0, &mut inverse, 9);
        let mut rate = vec![f64::NAN; count * 9];
        program.derivative(&columns(&numbers, 6), &columns(&rates, 6), 0, &mut rate, 9);
        for at in 0..count {
            let row = at * 6..at * 6 + 6;
            let (g, h) = (symmetric(&numbers[row.clone()]), symmetric(&rates[row]));
            let expected = g.try_inverse().unwrap();
            let found = Matrix3::from_row_slice(&inverse[at * 9..at * 9 + 9]);
            let size = expected.amax().max(1.0);
            assert!((found - expected).amax() <= 1e-12 * size * size, "{found}{expected}");
            let (found, slope) =
                (Matrix3::from_row_slice(&rate[at * 9..at * 9 + 9]), -(expected * h * expected));
            assert!((found - slope).amax() <= 1e-11 * size.powi(4), "{found}{slope}");
        }
        // a part of the rows, from any row on, has the same floats
        let start = count / 2;
        let mut part = vec![f64::NAN; (count - start) * 9];
        program.evaluate(&columns(&numbers, 6), start, &mut part, 9);
        assert_eq!(part, inverse[start * 9..]);
    }
}

/// Functions, constants and shared steps: the values of one row, and the recorded derivatives.
#[test]
fn functions_and_their_slopes() {
    let [x, y] = ["x", "y"].map(Recorded::input);
    let argument = x.clone() * &x + &y + &Recorded::from(2);
    let mut values: Vec<Recorded> = Function::ALL
        .iter()
        .map(|function| Recorded::function(function.name(), &argument).unwrap())
        .collect();
    values.push(Recorded::from(7));
    values.push(x.clone() * &y - &(argument.clone() * &argument) * &x);
    values.push(-(x.clone() * &y));
    values.push(y);
    let places: Vec<usize> = (0..values.len()).rev().collect();
    let width = values.len();
    let line = StraightLine::new(&values);
    let program = BlockProgram::new(&line, &["x", "y"], &places).unwrap();
    assert!(program.size() > width);
    let slopes = derivatives(&values, "x");
    let slopes = StraightLine::new(&slopes);
    let count = 21;
    let numbers: Vec<f64> = (0..2 * count).map(number).collect();
    let moving: Vec<f64> = (0..2 * count).map(|at| f64::from(at % 2 == 0)).collect();
    let (mut out, mut rates) = (vec![f64::NAN; count * width], vec![f64::NAN; count * width]);
    program.evaluate(&columns(&numbers, 2), 0, &mut out, width);
    program.derivative(&columns(&numbers, 2), &columns(&moving, 2), 0, &mut rates, width);
    for at in 0..count {
        let input = |name: &str| numbers[2 * at + usize::from(name == "y")];
        let one = |line: &StraightLine| line.evaluate(input, |f, x| f.value(*x)).unwrap();
        for (k, (value, slope)) in one(&line).into_iter().zip(one(&slopes)).enumerate() {
            let place = at * width + places[k];
            assert!((out[place] - value).abs() <= 1e-14 * value.abs().max(1.0), "value {k}");
            assert!((rates[place] - slope).abs() <= 1e-13 * slope.abs().max(1.0), "slope {k}");
        }
    }
    // the same number in all rows
    let fixed = [Column { numbers: &[0.5], offset: 0, step: 0 }; 2];
    program.evaluate(&fixed, 0, &mut out, width);
    assert!(
        DMatrix::from_row_slice(count, width, &out)
            .row_iter()
            .all(|row| row == DMatrix::from_row_slice(count, width, &out).row(0))
    );
    assert!(BlockProgram::new(&line, &["x"], &places).is_none());
}
