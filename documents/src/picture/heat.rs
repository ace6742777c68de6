//! Tensors as pictures: slices with a coloured cell for each component.

use super::{Anchor, Font, Ink, Picture, SOLID, Shape, Stroke};
use crate::Coefficient;
use affinor_tensors::Tensor;

const CELL: f64 = 14.0;
const GAP: f64 = 12.0;
const TITLE: f64 = 48.0;
/// The largest number of cells.
const CELLS: usize = 6000;
const EDGE: Stroke = Stroke { ink: Ink::opaque(0x666666), width: 0.8, dash: SOLID };
const POSITIVE: [u8; 3] = [0xb3, 0x4a, 0x00];
const NEGATIVE: [u8; 3] = [0x1f, 0x4e, 0x9c];
const SYMBOL: [u8; 3] = [0x55, 0x55, 0x55];

/// Draws the slices of a tensor over its last two indices; the first two indices are the row and
/// the column of a slice. Positive components are orange with a dot in the middle, and negative
/// components are blue. Larger components have stronger colours; components with symbols are grey.
/// `None` for a tensor of rank below 2 or above 4, or with too many components.
///
/// ```
/// use affinor_documents::picture::{heat, svg};
/// use affinor::tensors::{Down, Rational, Tensor};
/// let metric = Tensor::from_fn(2, [Down, Down], |[i, j]| Rational::from(if i == j { 1 } else { 0 }))?;
/// let picture = heat("metric", "g", &metric).unwrap();
/// assert_eq!(svg(&picture, 400).matches("<circle").count(), 2);
/// # Ok::<(), affinor::tensors::TensorError>(())
/// ```
pub fn heat<S: Coefficient>(title: &str, symbol: &str, tensor: &Tensor<S>) -> Option<Picture> {
    let (n, rank) = (tensor.dimension(), tensor.slots().len());
    let cells = n.checked_pow(u32::try_from(rank).ok()?)?;
    if !(2..=4).contains(&rank) || cells > CELLS || tensor.is_empty() {
        return None;
    }
    let (rows, columns) = match rank {
        2 => (1, 1),
        3 => (1, n),
        _ => (n, n),
    };
    let side = CELL * n as f64;
    let (across, down) = (side + GAP, side + GAP + 14.0);
    let width = (GAP + across * columns as f64).max(9.5 * title.chars().count() as f64 + 2.0 * GAP);
    let font = Font::words(17.0, Anchor::Middle);
    let mut shapes = vec![Shape::Text { at: [0.5 * width, 30.0], text: title.into(), font }];
    let corner = |row: usize, column: usize| {
        [GAP + across * column as f64, TITLE + 14.0 + down * row as f64]
    };
    let square = |[x, y]: [f64; 2], size: f64| {
        vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]
    };
    for row in 0..rows {
        for column in 0..columns {
            let at = corner(row, column);
            shapes.push(Shape::Line { points: square(at, side), stroke: EDGE });
            let indices = match rank {
                2 => String::new(),
                3 => format!(" {}", column + 1),
                _ => format!(" {},{}", row + 1, column + 1),
            };
            let text = format!("{symbol}{indices}");
            let font = Font::words(11.0, Anchor::Start);
            shapes.push(Shape::Text { at: [at[0], at[1] - 3.0], text, font });
        }
    }
    let largest = tensor.components().filter_map(|(_, value)| value.to_f64());
    let largest = largest.map(f64::abs).fold(0.0, f64::max);
    for (at, value) in tensor.components() {
        let (row, column) = match rank {
            2 => (0, 0),
            3 => (0, at[0]),
            _ => (at[0], at[1]),
        };
        let [x, y] = corner(row, column);
        let at = [x + CELL * at[rank - 1] as f64, y + CELL * at[rank - 2] as f64];
        let (rgb, share, positive) = match value.to_f64() {
            None => (SYMBOL, 0.6, false),
            Some(value) => (
                if value > 0.0 { POSITIVE } else { NEGATIVE },
                0.25 + 0.75 * value.abs() / largest,
                value > 0.0,
            ),
        };
        let ink = Ink { rgb, opacity: (share * 100.0).round() / 100.0 };
        shapes.push(Shape::Area { points: square(at, CELL), ink });
        if positive {
            let middle = at.map(|x| x + 0.5 * CELL);
            shapes.push(Shape::Disc { at: middle, radius: 1.8, ink: Ink::opaque(0xffffff) });
        }
    }
    let height = TITLE + 14.0 + down * rows as f64;
    let title = format!(
        "{title}: {} nonzero components of {cells} in {} slices of {n} rows and {n} columns",
        tensor.len(),
        rows * columns
    );
    Some(Picture { title, width, height, shapes })
}
