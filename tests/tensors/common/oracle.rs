//! Contraction by definition: all combinations of components are tried, and indices are matched by
//! letter.

use affinor_tensors::{Scalar, Tensor};
use std::collections::BTreeMap;

/// The nonzero components by their indices.
pub type Components<S> = BTreeMap<Vec<usize>, S>;

/// The stored components of a tensor.
pub fn stored<S: Scalar>(tensor: &Tensor<S>) -> Vec<(Vec<usize>, S)> {
    tensor.components().map(|(at, value)| (at.to_vec(), value.clone())).collect()
}

/// Evaluates `text` without the kernel; brackets are ignored.
pub fn oracle<S: Scalar>(text: &str, operands: &[(&str, &Tensor<S>)]) -> Components<S> {
    let (sum, result) = text.split_once("->").unwrap();
    let result = letters(result);
    let mut total = Components::new();
    let mut sign = 1;
    let mut term: Vec<&str> = vec![];
    for word in sum.split_whitespace().chain(["+"]) {
        if word != "+" && word != "-" {
            term.push(word);
        } else if !term.is_empty() {
            add_term(&mut total, sign, &term, &result, operands);
            term.clear();
        }
        match word {
            "+" => sign = 1,
            "-" => sign = -1,
            _ => {}
        }
    }
    total.retain(|_, value| !value.vanishes());
    total
}

fn letters(text: &str) -> Vec<char> {
    text.chars().filter(|c| c.is_alphabetic()).collect()
}

/// Adds one term: a value for each choice of a component of every factor such that the indices
/// agree.
fn add_term<S: Scalar>(
    total: &mut Components<S>,
    sign: i64,
    words: &[&str],
    result: &[char],
    operands: &[(&str, &Tensor<S>)],
) {
    let mut products = vec![(BTreeMap::new(), S::from_i64(sign))];
    for word in words {
        if let Ok(number) = word.parse::<i64>() {
            let number = S::from_i64(number);
            products.iter_mut().for_each(|(_, value)| *value = value.clone() * &number);
            continue;
        }
        let (name, indices) = word.split_at(word.find(['^', '_']).unwrap_or(word.len()));
        let letters = letters(indices);
        let (_, tensor) = operands.iter().find(|(operand, _)| *operand == name).unwrap();
        let components = stored(tensor);
        products = products
            .iter()
            .flat_map(|(chosen, value)| {
                components.iter().filter_map(|(at, component)| {
                    let mut chosen: BTreeMap<char, usize> = chosen.clone();
                    let agree = letters
                        .iter()
                        .zip(at)
                        .all(|(letter, index)| *chosen.entry(*letter).or_insert(*index) == *index);
                    agree.then(|| (chosen, value.clone() * component))
                })
            })
            .collect();
    }
    for (chosen, value) in products {
        let at = result.iter().map(|letter| chosen[letter]).collect();
        let sum = total.entry(at).or_insert_with(S::zero);
        *sum = std::mem::replace(sum, S::zero()) + &value;
    }
}
