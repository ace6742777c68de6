//! Eigenvalues of the Ricci operator `Ric^i_j = g^ik Ric_kj`.

use crate::Coefficient;
use affinor_tensors::{Field, Kind, Tensor};
use nalgebra::DMatrix;

/// The largest block of a matrix whose eigenvalues are computed.
const LARGEST: usize = 16;
/// The largest denominator of a rational eigenvalue of a block of more than two rows.
const DENOMINATOR: i64 = 240;

/// An eigenvalue as text, with its multiplicity, and whether the text is an approximation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Eigenvalue {
    pub text: String,
    pub multiplicity: usize,
    pub approximate: bool,
}

/// The eigenvalues of a matrix, block by block; `None` for the eigenvalues of a block that has no
/// formula for them.
pub(super) fn eigenvalues<S: Coefficient + Field>(operator: &Tensor<S>) -> Option<Vec<Eigenvalue>> {
    let mut all: Vec<Eigenvalue> = vec![];
    let mut add =
        |text: String, approximate: bool| match all.iter_mut().find(|known| known.text == text) {
            Some(known) => known.multiplicity += 1,
            None => all.push(Eigenvalue { text, multiplicity: 1, approximate }),
        };
    for block in blocks(operator) {
        let entry = |i: usize, j: usize| operator.get(&[block[i], block[j]]);
        match block.len() {
            1 => add(entry(0, 0).to_string(), false),
            2 => {
                let trace = entry(0, 0) + &entry(1, 1);
                let determinant = entry(0, 0) * &entry(1, 1) - &(entry(0, 1) * &entry(1, 0));
                let four = S::from_i64(4);
                let square = trace.clone() * &trace - &(determinant * &four);
                let half = S::from_i64(2).recip()?;
                let middle = trace * &half;
                match root(&square.to_string()) {
                    Some((above, below)) => {
                        let root = S::from_i64(above) * &S::from_i64(2 * below).recip()?;
                        add((middle.clone() + &root).to_string(), false);
                        add((middle - &root).to_string(), false);
                    }
                    None => {
                        let middle =
                            if middle.vanishes() { String::new() } else { middle.to_string() };
                        for sign in ["+", "-"] {
                            let sign = if middle.is_empty() && sign == "+" { "" } else { sign };
                            add(format!("{middle} {sign} 1/2*sqrt({square})").trim().into(), false);
                        }
                    }
                }
            }
            n if n <= LARGEST && S::KIND == Kind::Exact => {
                let rows: Vec<Vec<S>> =
                    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
                for (text, approximate) in of_block(&rows)? {
                    add(text, approximate);
                }
            }
            _ => return None,
        }
    }
    Some(all)
}

/// The sets of rows that are connected by entries off the diagonal.
fn blocks<S: Coefficient>(operator: &Tensor<S>) -> Vec<Vec<usize>> {
    let n = operator.dimension();
    let mut block: Vec<usize> = (0..n).collect();
    for (at, _) in operator.components() {
        let (a, b) = (block[at[0]], block[at[1]]);
        block.iter_mut().filter(|other| **other == a.max(b)).for_each(|other| *other = a.min(b));
    }
    let rows = |first: usize| (0..n).filter(|at| block[*at] == first).collect::<Vec<_>>();
    (0..n).filter(|at| block[*at] == *at).map(rows).collect()
}

/// The positive square root of a rational number, if it is rational.
fn root(square: &str) -> Option<(i64, i64)> {
    let (above, below) = square.split_once('/').unwrap_or((square, "1"));
    let root = |text: &str| {
        let number: u64 = text.parse().ok()?;
        let root = number.isqrt();
        (root * root == number).then(|| i64::try_from(root).ok()).flatten()
    };
    Some((root(above)?, root(below)?))
}

/// The eigenvalues of a matrix of rational numbers: rational ones exactly, the others to six digits.
fn of_block<S: Coefficient + Field>(rows: &[Vec<S>]) -> Option<Vec<(String, bool)>> {
    let n = rows.len();
    let polynomial = characteristic(rows)?;
    let float = |value: &S| {
        value
            .to_string()
            .split('/')
            .map(str::parse::<f64>)
            .collect::<Result<Vec<_>, _>>()
            .ok()
            .map(|parts| parts.iter().skip(1).fold(parts[0], |a, b| a / b))
    };
    let entries: Option<Vec<f64>> = rows.iter().flatten().map(float).collect();
    let values = DMatrix::from_row_slice(n, n, &entries?).complex_eigenvalues();
    let is_root = |value: &S| {
        let value = polynomial.iter().rev().fold(S::zero(), |sum, c| sum * value + c);
        value.vanishes()
    };
    let mut all = vec![];
    for value in values.iter() {
        let rational = (1..=DENOMINATOR).find_map(|below| {
            let above = (value.re * below as f64).round();
            let near = (above / below as f64 - value.re).abs() < 1e-6 * (1.0 + value.re.abs());
            let exact = S::from_i64(above as i64) * &S::from_i64(below).recip()?;
            (near && value.im.abs() < 1e-6 && is_root(&exact)).then(|| exact.to_string())
        });
        let digits = |x: f64| {
            format!("{:.6}", x + 0.0).trim_end_matches('0').trim_end_matches('.').to_string()
        };
        all.push(match rational {
            Some(text) => (text, false),
            None if value.im.abs() < 1e-9 => (digits(value.re), true),
            None => {
                let sign = if value.im < 0.0 { "-" } else { "+" };
                (format!("{} {sign} {}*i", digits(value.re), digits(value.im.abs())), true)
            }
        });
    }
    all.sort_by(|a, b| a.0.len().cmp(&b.0.len()).then(a.0.cmp(&b.0)));
    Some(all)
}

/// The coefficients of the characteristic polynomial, the constant first, by the recursion of
/// Faddeev and Le Verrier.
fn characteristic<S: Coefficient + Field>(rows: &[Vec<S>]) -> Option<Vec<S>> {
    let n = rows.len();
    let mut coefficients = vec![S::zero(); n + 1];
    coefficients[n] = S::one();
    let mut product: Vec<Vec<S>> = vec![vec![S::zero(); n]; n];
    for k in 1..=n {
        for (i, row) in product.iter_mut().enumerate() {
            row[i] = row[i].clone() + &coefficients[n + 1 - k];
        }
        let times = |i: usize, j: usize| {
            (0..n).fold(S::zero(), |sum, m| sum + &(rows[i][m].clone() * &product[m][j]))
        };
        product = (0..n).map(|i| (0..n).map(|j| times(i, j)).collect()).collect();
        let trace = (0..n).fold(S::zero(), |sum, i| sum + &product[i][i]);
        coefficients[n - k] = -(trace * &S::from_i64(k as i64).recip()?);
    }
    Some(coefficients)
}

#[cfg(test)]
mod tests {
    use super::eigenvalues;
    use affinor_tensors::{Down, Rational, Tensor, Up};

    fn of(rows: &[&[i64]]) -> Vec<(String, usize)> {
        let entries = rows.iter().enumerate().flat_map(|(i, row)| {
            row.iter().enumerate().map(move |(j, value)| ([i, j], Rational::from(*value)))
        });
        let tensor =
            Tensor::from_components(rows.len(), &[Up, Down], entries).expect("the entries fit");
        let found = eigenvalues(&tensor).expect("there are eigenvalues");
        found.into_iter().map(|value| (value.text, value.multiplicity)).collect()
    }

    #[test]
    fn eigenvalues_of_blocks() {
        assert_eq!(of(&[&[2, 0, 0], &[0, 2, 0], &[0, 0, 3]]), [("2".into(), 2), ("3".into(), 1)]);
        assert_eq!(of(&[&[0, 1], &[1, 0]]), [("1".into(), 1), ("-1".into(), 1)]);
        // t^2 = 2
        let roots = ["1/2*sqrt(8)", "- 1/2*sqrt(8)"].map(|text| (text.to_string(), 1));
        assert_eq!(of(&[&[0, 2], &[1, 0]]), roots);
        // the companion matrix of (t - 1)(t - 2)(t - 3)
        let found = of(&[&[0, 0, 6], &[1, 0, -11], &[0, 1, 6]]);
        assert_eq!(found, [("1".into(), 1), ("2".into(), 1), ("3".into(), 1)]);
    }
}
