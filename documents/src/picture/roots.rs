//! Root systems as pictures.

use super::{Anchor, BLACK, Font, Ink, Picture, Point, SOLID, Shape, Stroke};
use affinor::algebra::roots::{CartanType, RootSystem};

/// The radius of a diagram, its margin, and the height of the title.
const RADIUS: f64 = 150.0;
const MARGIN: f64 = 30.0;
const TITLE: f64 = 48.0;
const RAY: Stroke = Stroke { ink: Ink::opaque(0xb4b4b4), width: 0.8, dash: SOLID };
const SHORT: Ink = Ink::opaque(0xa3173f);
/// The number of steps of the power iteration, which is enough because its largest eigenvalue
/// dominates.
const STEPS: usize = 2000;

/// Draws the roots of simple factors one below the other, projected onto the Coxeter plane. In rank
/// 2 this is the plane of the roots. Short roots are smaller, and red.
///
/// The plane is spanned by two sums `sum x_i e_i*`: `u` is the sum over the black nodes of the
/// diagram, and `v` is the sum over the white nodes. Here `e_i*` is dual to the unit vectors along
/// the simple roots, and `x` is the positive eigenvector of the matrix of bonds. The angle between
/// `u` and `v` is `pi/h`. J. E. Humphreys, *Reflection Groups and Coxeter Groups* (1990), 3.17.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
/// use affinor_documents::picture::{roots, svg};
/// let picture = roots("G2", &[CartanType::new(Series::G, 2)?]);
/// assert_eq!(svg(&picture, 400).matches("<circle").count(), 12);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn roots(title: &str, types: &[CartanType]) -> Picture {
    let width = 2.0 * (RADIUS + MARGIN);
    let font = Font::words(17.0, Anchor::Middle);
    let mut shapes = vec![Shape::Text { at: [0.5 * width, 30.0], text: title.into(), font }];
    let mut count = 0;
    for (at, one) in types.iter().enumerate() {
        let center = [0.5 * width, TITLE + RADIUS + 2.0 * (RADIUS + MARGIN) * at as f64];
        let places = projected(*one);
        let reach = places.iter().map(|(at, _)| at[0].hypot(at[1])).fold(0.0, f64::max);
        let place = |at: &Point| [0, 1].map(|k| center[k] + RADIUS * at[k] / reach);
        let rays = places
            .iter()
            .map(|(at, _)| Shape::Line { points: vec![center, place(at)], stroke: RAY });
        shapes.extend(rays);
        shapes.extend(places.iter().map(|(at, long)| {
            let (radius, ink) = if *long { (4.0, BLACK) } else { (3.0, SHORT) };
            Shape::Disc { at: place(at), radius, ink }
        }));
        let font = Font::words(15.0, Anchor::Start);
        let name = [6.0, center[1] - RADIUS + 12.0];
        shapes.push(Shape::Text { at: name, text: one.to_string(), font });
        count += places.len();
    }
    let height = TITLE + 2.0 * (RADIUS + MARGIN) * types.len() as f64;
    let title = format!("Root diagram of {title}: {count} roots in the Coxeter plane");
    Picture { title, width, height, shapes }
}

/// The points of the roots in the plane, and whether each root is long.
fn projected(cartan_type: CartanType) -> Vec<(Point, bool)> {
    let system = RootSystem::new(cartan_type);
    let (cartan, rank) = (cartan_type.cartan_matrix(), cartan_type.rank());
    let lengths: Vec<f64> = system.positive_roots()[..rank]
        .iter()
        .map(|root| (root.squared_length() as f64).sqrt())
        .collect();
    // 2 cos of the angle between two simple roots, without its sign
    let bond = |i: usize, j: usize| {
        if i == j { 0.0 } else { ((cartan[i][j] * cartan[j][i]) as f64).sqrt() }
    };
    let mut x = vec![1.0; rank];
    let mut cosine = 0.0;
    for _ in 0..STEPS {
        // adds 2 to all eigenvalues, so that the largest one dominates
        let next: Vec<f64> = (0..rank)
            .map(|i| 2.0 * x[i] + (0..rank).map(|j| bond(i, j) * x[j]).sum::<f64>())
            .collect();
        let norm = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        let before = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        cosine = 0.5 * (norm / before - 2.0);
        x = next.into_iter().map(|x| x / norm).collect();
    }
    let black = colours(rank, &bond);
    let part = |c: &[i64], colour: bool| -> f64 {
        (0..rank).filter(|i| black[*i] == colour).map(|i| x[i] * lengths[i] * c[i] as f64).sum()
    };
    let longest = system.positive_roots().iter().map(|root| root.squared_length()).max();
    let sine = (1.0 - cosine * cosine).sqrt();
    let place = |c: &[i64]| {
        let (u, v) = (part(c, true), part(c, false));
        if rank == 1 { [u, 0.0] } else { [u, (v - cosine * u) / sine] }
    };
    let positive = system.positive_roots().iter();
    let both = positive.flat_map(|root| {
        let ([x, y], long) = (place(root.coefficients()), Some(root.squared_length()) == longest);
        [([x, y], long), ([-x, -y], long)]
    });
    both.collect()
}

/// Colours the nodes of a tree with two colours, so that adjacent nodes have different colours.
fn colours(rank: usize, bond: &dyn Fn(usize, usize) -> f64) -> Vec<bool> {
    let mut found: Vec<Option<bool>> = vec![None; rank];
    let mut open = vec![0];
    found[0] = Some(true);
    while let Some(i) = open.pop() {
        for j in (0..rank).filter(|j| bond(i, *j) > 0.0) {
            if found[j].is_none() {
                found[j] = found[i].map(|colour| !colour);
                open.push(j);
            }
        }
    }
    found.into_iter().map(|colour| colour == Some(true)).collect()
}

#[cfg(test)]
mod tests {
    use super::projected;
    use affinor::algebra::roots::{CartanType, Series};

    /// The picture is symmetric under rotations of order h, the Coxeter number: 6 for G2, 12 for
    /// F4, 30 for E8. Humphreys (1990), table 3.2.
    #[test]
    fn a_coxeter_element_turns_it() {
        for (series, rank, h) in [
            (Series::A, 2, 3),
            (Series::B, 3, 6),
            (Series::G, 2, 6),
            (Series::D, 5, 8),
            (Series::F, 4, 12),
            (Series::E, 8, 30),
        ] {
            let places = projected(CartanType::new(series, rank).expect("a type"));
            let (sin, cos) = (std::f64::consts::TAU / f64::from(h)).sin_cos();
            for ([x, y], long) in &places {
                let turned = [cos * x - sin * y, sin * x + cos * y];
                let near = |at: &[f64; 2]| (at[0] - turned[0]).hypot(at[1] - turned[1]) < 1e-9;
                assert!(
                    places.iter().any(|(at, other)| other == long && near(at)),
                    "{series:?} {rank}"
                );
            }
        }
    }

    /// In rank 2 the picture is not distorted: the angles between neighbouring roots of B2 are 45
    /// degrees.
    #[test]
    fn rank_two_is_itself() {
        let places = projected(CartanType::new(Series::B, 2).expect("a type"));
        let mut angles: Vec<f64> =
            places.iter().map(|([x, y], _)| y.atan2(*x).to_degrees()).collect();
        angles.sort_by(f64::total_cmp);
        assert!(
            angles.windows(2).all(|pair| (pair[1] - pair[0] - 45.0).abs() < 1e-9),
            "{angles:?}"
        );
        let size = |long: bool| {
            places
                .iter()
                .find(|(_, other)| *other == long)
                .map(|([x, y], _)| x.hypot(*y))
                .expect("a root")
        };
        assert!((size(true) / size(false) - 2f64.sqrt()).abs() < 1e-12);
    }
}
