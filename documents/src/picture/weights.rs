//! Weight diagrams as pictures.

use super::{Anchor, BLACK, Font, Ink, Picture, Point, SOLID, Shape, Stroke};
use affinor::algebra::roots::RootSystem;
use affinor::representation::names::name;
use affinor::representation::{HighestWeight, ReductiveAlgebra, RepresentationError};
use nalgebra::{DMatrix, DVector, Vector3};
use num_traits::ToPrimitive;
use std::collections::HashMap;

/// The largest number of weights that are drawn.
const MOST: u32 = 1500;
/// The greatest distance of a point from the centre, and the room around it.
const RADIUS: f64 = 190.0;
const MARGIN: f64 = 34.0;
/// The height of the title.
const TITLE: f64 = 48.0;
/// The colours of the simple roots.
const COLOURS: [Ink; 3] = [Ink::opaque(0x0072b2), Ink::opaque(0xd55e00), Ink::opaque(0x009e73)];
/// The direction of view of three dimensions: the angle around the vertical axis, and the elevation.
const VIEW: [f64; 2] = [0.42, 0.28];

/// Draws the weights of an irreducible representation. Lines join weights that differ by a simple
/// root, in the colour of the root; numbers are multiplicities above 1.
///
/// A weight `sum c_i alpha_i` is drawn at `sum c_i a_i`, where the vectors `a_i` have the inner
/// products of the simple roots. Three dimensions are drawn in parallel projection, and points that
/// are farther away are smaller. Returns `None` unless the semisimple rank is 2 or 3 and there are
/// at most 1500 weights.
///
/// # Errors
/// Those of [`HighestWeight::character`].
///
/// ```
/// use affinor::representation::HighestWeight;
/// use affinor_documents::picture::{svg, weights};
/// let octet = HighestWeight::parse(&"SU(3)".parse()?, "8")?;
/// let picture = weights(&octet)?.expect("two dimensions");
/// // six weights of multiplicity 1, and one of multiplicity 2
/// assert_eq!(svg(&picture, 400).matches("<circle").count(), 7);
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
pub fn weights(highest: &HighestWeight) -> Result<Option<Picture>, RepresentationError> {
    let rank = highest.algebra().semisimple_rank();
    if rank != 2 && rank != 3 {
        return Ok(None);
    }
    let character = highest.character()?;
    if character.weight_count() > MOST.into() {
        return Ok(None);
    }
    let (vectors, steps) = simple_roots(highest.algebra());
    // labels are inner products with the simple coroots
    let dual = DMatrix::from_fn(rank, rank, |i, j| steps[j][i] as f64).try_inverse();
    let Some(dual) = dual else { return Ok(None) };
    let mut places: HashMap<Vec<i64>, (Vector3<f64>, i128)> = HashMap::new();
    character.for_each_weight(|weight, multiplicity| {
        let labels = DVector::from_iterator(rank, weight[..rank].iter().map(|l| *l as f64));
        let at = &vectors * (&dual * labels);
        let at = Vector3::from_fn(|i, _| at.get(i).copied().unwrap_or(0.0));
        places.insert(weight[..rank].to_vec(), (turned(at, rank), multiplicity));
    });
    let reach = places.values().map(|(at, _)| at.xy().norm()).fold(1e-9, f64::max);
    let width = 2.0 * (RADIUS + MARGIN);
    let center = [0.5 * width, TITLE + RADIUS + MARGIN];
    let place = |at: &Vector3<f64>| -> Point {
        [center[0] + RADIUS * at.x / reach, center[1] - RADIUS * at.y / reach]
    };
    // nearer is larger: 0 at the back, 1 in front
    let near = |at: &Vector3<f64>| if rank == 2 { 1.0 } else { 0.5 + 0.5 * at.z / reach };
    let known = name(highest).unwrap_or_else(|| highest.to_string());
    let title = format!("Representation {known} of {}", highest.algebra());
    let font = Font::words(17.0, Anchor::Middle);
    let mut shapes = vec![Shape::Text { at: [0.5 * width, 30.0], text: title.clone(), font }];
    let mut drawn: Vec<(f64, Shape)> = vec![];
    for (weight, (at, _)) in &places {
        for (step, colour) in steps.iter().zip(COLOURS) {
            let below: Vec<i64> = weight.iter().zip(step).map(|(w, s)| w - s).collect();
            let Some((other, _)) = places.get(&below) else { continue };
            let depth = 0.5 * (near(at) + near(other));
            let ink = Ink { opacity: 0.25 + 0.5 * depth, ..colour };
            let stroke = Stroke { ink, width: 1.0 + depth, dash: SOLID };
            drawn
                .push((depth - 1.0, Shape::Line { points: vec![place(at), place(other)], stroke }));
        }
    }
    for (at, multiplicity) in places.values() {
        let (depth, at) = (near(at), place(at));
        let ink = Ink { opacity: 0.4 + 0.6 * depth, ..BLACK };
        drawn.push((depth, Shape::Disc { at, radius: 2.5 + 2.5 * depth, ink }));
        if *multiplicity > 1 {
            let at = [at[0] + 7.0, at[1] - 7.0];
            let font = Font { ink, ..Font::words(13.0, Anchor::Start) };
            drawn.push((2.0, Shape::Text { at, text: multiplicity.to_string(), font }));
        }
    }
    // from back to front; the places make the order definite
    drawn.sort_by(|(a, one), (b, other)| a.total_cmp(b).then_with(|| order(one, other)));
    shapes.extend(drawn.into_iter().map(|(_, shape)| shape));
    for (i, ink) in COLOURS.into_iter().take(rank).enumerate() {
        let text = format!("alpha{}", i + 1);
        let font = Font { ink, ..Font::words(15.0, Anchor::Start) };
        shapes.push(Shape::Text { at: [8.0, TITLE + 16.0 + 20.0 * i as f64], text, font });
    }
    let height = TITLE + 2.0 * (RADIUS + MARGIN);
    let count = character.weight_count().to_u32().unwrap_or(MOST);
    let title = format!("{title}: {count} different weights, joined along the simple roots");
    Ok(Some(Picture { title, width, height, shapes }))
}

/// Vectors with the inner products of the simple roots, as columns, and the labels of the simple
/// roots.
fn simple_roots(algebra: &ReductiveAlgebra) -> (DMatrix<f64>, Vec<Vec<i64>>) {
    let rank = algebra.semisimple_rank();
    let mut gram = DMatrix::zeros(rank, rank);
    let mut steps = vec![vec![0; rank]; rank];
    let mut start = 0;
    for factor in algebra.simple_factors() {
        let system = RootSystem::new(*factor);
        for (i, root) in system.positive_roots()[..factor.rank()].iter().enumerate() {
            for (j, label) in root.weight().iter().enumerate() {
                let half = 0.5 * system.positive_roots()[j].squared_length() as f64;
                gram[(start + i, start + j)] = *label as f64 * half;
                steps[start + i][start + j] = *label;
            }
        }
        start += factor.rank();
    }
    // the Gram matrix of independent vectors is positive definite
    let vectors = gram.cholesky().map_or(DMatrix::identity(rank, rank), |c| c.l().transpose());
    (vectors, steps)
}

/// The point as it is seen: to the right, up and to the front.
fn turned(at: Vector3<f64>, rank: usize) -> Vector3<f64> {
    if rank == 2 {
        return at;
    }
    let [around, up] = VIEW;
    let (x, y) =
        (at.x * around.cos() - at.y * around.sin(), at.x * around.sin() + at.y * around.cos());
    Vector3::new(x, at.z * up.cos() + y * up.sin(), at.z * up.sin() - y * up.cos())
}

/// An order of shapes by their first points.
fn order(one: &Shape, other: &Shape) -> std::cmp::Ordering {
    let key = |shape: &Shape| match shape {
        Shape::Line { points, .. } => points.concat(),
        Shape::Disc { at, .. } | Shape::Text { at, .. } => at.to_vec(),
        _ => vec![],
    };
    let (a, b) = (key(one), key(other));
    a.partial_cmp(&b).unwrap_or(std::cmp::Ordering::Equal)
}
