//! Dynkin diagrams as pictures.

use super::{Anchor, BLACK, Font, Picture, Point, SOLID, Shape, Stroke, WHITE};
use affinor::algebra::roots::{CartanType, Series};

/// The distance between adjacent nodes, and the margin.
const STEP: f64 = 64.0;
const MARGIN: f64 = 40.0;
const RADIUS: f64 = 7.0;
/// The height of the title, and the width of the name of a factor.
const TITLE: f64 = 48.0;
const NAME: f64 = 48.0;
/// The distance between the lines of a multiple bond.
const BOND: f64 = 4.5;

/// Draws the Dynkin diagrams of simple factors one below the other, numbered as in Bourbaki. Arrows
/// point to the short roots.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
/// use affinor_documents::picture::{dynkin, svg};
/// let picture = dynkin("F4", &[CartanType::new(Series::F, 4)?]);
/// assert_eq!(svg(&picture, 400).matches("<circle").count(), 2 * 4);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn dynkin(title: &str, types: &[CartanType]) -> Picture {
    let mut shapes = vec![];
    let (mut widest, mut top) = (0.0f64, TITLE);
    for one in types {
        let places = places(*one);
        let below = places.iter().map(|at| at[1]).fold(0.0, f64::max);
        widest = places.iter().map(|at| at[0]).fold(widest, f64::max);
        let moved = |at: &Point| [MARGIN + NAME + STEP * at[0], top + MARGIN + STEP * at[1]];
        let places: Vec<Point> = places.iter().map(moved).collect();
        let name = [MARGIN, top + MARGIN + 5.0];
        let font = Font::words(15.0, Anchor::Middle);
        shapes.push(Shape::Text { at: name, text: one.to_string(), font });
        factor(*one, &places, &mut shapes);
        top += STEP * (below + 1.0);
    }
    let least = 9.5 * title.chars().count() as f64;
    let width = (2.0 * MARGIN + NAME + STEP * widest).max(least + MARGIN);
    let font = Font::words(17.0, Anchor::Middle);
    shapes.push(Shape::Text { at: [0.5 * width, 30.0], text: title.into(), font });
    Picture { title: format!("Dynkin diagram of {title}"), width, height: top + MARGIN, shapes }
}

/// The positions of the simple roots, in units of the distance between nodes: a row, and the end of
/// a branch below it.
fn places(cartan_type: CartanType) -> Vec<Point> {
    let r = cartan_type.rank();
    let row: Vec<usize> = match cartan_type.series() {
        Series::D if r == 3 => vec![1, 0, 2],
        Series::D => (0..r - 1).collect(),
        Series::E => [0].into_iter().chain(2..r).collect(),
        _ => (0..r).collect(),
    };
    let matrix = cartan_type.cartan_matrix();
    let across = |root: usize| row.iter().position(|other| *other == root);
    let place = |root: usize| match across(root) {
        Some(at) => [at as f64, 0.0],
        None => {
            let joined = (0..r).filter(|other| *other != root && matrix[root][*other] != 0);
            [joined.filter_map(across).next().unwrap_or(0) as f64, 1.0]
        }
    };
    (0..r).map(place).collect()
}

/// Draws the bonds, then the nodes with their numbers.
fn factor(cartan_type: CartanType, places: &[Point], shapes: &mut Vec<Shape>) {
    let matrix = cartan_type.cartan_matrix();
    let stroke = Stroke { ink: BLACK, width: 1.6, dash: SOLID };
    for (i, from) in places.iter().enumerate() {
        for (j, to) in places.iter().enumerate().skip(i + 1).filter(|(j, _)| matrix[i][*j] != 0) {
            let count = matrix[i][j] * matrix[j][i];
            let down = from[0] == to[0];
            for k in 0..count {
                let aside = BOND * (k as f64 - 0.5 * (count - 1) as f64);
                let shift =
                    |at: &Point| if down { [at[0] + aside, at[1]] } else { [at[0], at[1] + aside] };
                shapes.push(Shape::Line { points: vec![shift(from), shift(to)], stroke });
            }
            if count > 1 {
                // a_ij = 2 (a_i, a_j) / (a_j, a_j), so the larger entry is in the column of the
                // short root
                let (long, short) =
                    if matrix[i][j] < matrix[j][i] { (from, to) } else { (to, from) };
                let middle = 0.5 * (long[0] + short[0]);
                let ahead = (short[0] - long[0]).signum();
                let wing = |up: f64| [middle - 6.0 * ahead, long[1] + 9.0 * up];
                let points = vec![wing(-1.0), [middle + 6.0 * ahead, long[1]], wing(1.0)];
                shapes.push(Shape::Line { points, stroke });
            }
        }
    }
    for (number, at) in places.iter().enumerate() {
        shapes.push(Shape::Disc { at: *at, radius: RADIUS, ink: BLACK });
        shapes.push(Shape::Disc { at: *at, radius: RADIUS - 1.6, ink: WHITE });
        let aside = if at[1] > places[0][1] { [16.0, 5.0] } else { [0.0, -14.0] };
        let font = Font::words(13.0, Anchor::Middle);
        let text = (number + 1).to_string();
        shapes.push(Shape::Text { at: [at[0] + aside[0], at[1] + aside[1]], text, font });
    }
}
