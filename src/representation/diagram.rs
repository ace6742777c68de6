//! Dynkin diagrams labelled with a weight.

use super::HighestWeight;
use crate::algebra::structure::dynkin::diagram;

/// The Dynkin diagrams of the simple factors, in text. Each node is `number:label`, with the number
/// of Bourbaki and the Dynkin label; arrows point to the short roots. Charges follow in a line of
/// their own.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra, diagram::labelled};
/// let g2: ReductiveAlgebra = "G2 + T1".parse()?;
/// let weight = HighestWeight::new(&g2, [1, 0, 3])?;
/// assert_eq!(labelled(&weight), "G2  1:1<==2:0 (triple)\ncharge 3");
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
pub fn labelled(weight: &HighestWeight) -> String {
    let algebra = weight.algebra();
    let mut parts = vec![];
    for (at, factor) in algebra.simple_factors().iter().enumerate() {
        let labels = &weight.labels()[algebra.positions(at)];
        let head = format!("{factor}  ");
        let lines = with_labels(&diagram(*factor), labels);
        let indent = format!("\n{}", " ".repeat(head.len()));
        parts.push(head + &lines.join(&indent));
    }
    let charges = &weight.labels()[algebra.semisimple_rank()..];
    if !charges.is_empty() {
        let values: Vec<String> = charges.iter().map(ToString::to_string).collect();
        let name = if charges.len() == 1 { "charge" } else { "charges" };
        parts.push(format!("{name} {}", values.join(", ")));
    }
    parts.join("\n")
}

/// Writes the labels behind the numbers of the nodes. Branches below a node move with it.
fn with_labels(diagram: &str, labels: &[i64]) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    // columns of the first line, before and after the labels
    let mut moved: Vec<(usize, usize)> = vec![];
    for (row, line) in diagram.lines().enumerate() {
        let mut text = String::new();
        let (mut at, mut rest) = (0, line);
        if row > 0 {
            let indent = line.len() - line.trim_start().len();
            let column = moved.iter().find(|(before, _)| *before == indent);
            text = " ".repeat(column.map_or(indent, |(_, after)| *after));
            rest = line.trim_start();
        }
        while let Some(c) = rest.chars().next() {
            let digits = rest.chars().take_while(char::is_ascii_digit).count();
            let node = rest[..digits].parse::<usize>().ok();
            if row == 0 {
                moved.push((at, text.len()));
            }
            match node.and_then(|node| Some((node, labels.get(node.checked_sub(1)?)?))) {
                Some((node, label)) => {
                    text += &format!("{node}:{label}");
                    rest = &rest[digits..];
                    at += digits;
                }
                None => {
                    text.push(c);
                    rest = &rest[c.len_utf8()..];
                    at += 1;
                }
            }
        }
        lines.push(text);
    }
    lines
}
