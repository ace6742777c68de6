//! Isomorphisms with `degraaf(6,24,e=...)`: nilpotent algebras of dimension 6 whose second centre
//! pairs a plane with a plane.
//!
//! Let `V` be the algebra modulo its second centre. The bracket with `y_3 = [x_1, x_2]`, where
//! `x_1` and `x_2` are a basis of `V`, maps `V` isomorphically to the centre. The bracket with
//! another vector `y_4` of the second centre, followed by the inverse of this isomorphism, is a map
//! `T` of `V` to itself. Up to a factor and central vectors, one `y_4` makes the trace of `T` zero.
//! Then `T^2` is a number `d`, and `e` is `d` up to squares.

use super::{StructureTheory, Subspace, Vector, scale, witness::sum};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Ring};

impl StructureTheory<Rational> {
    /// The images of the basis of `degraaf(6,24,e=...)` for this `e`. Returns `None` if the algebra
    /// is not isomorphic to it.
    pub(super) fn onto_pairing(&self, e: &Rational) -> Option<Vec<Vector>> {
        let (centre, second) = (self.centre(), self.upper_central_series().get(2)?.clone());
        let units: Vec<Vector> =
            second.complement().map(|at| vec![(at, Rational::from(1))]).collect();
        let [y1, y2] = &units[..] else { return None };
        let bracket = |x: &Vector, y: &Vector| self.products.ad(x).image(y);
        let y3 = bracket(y1, y2);
        let mut span = centre.clone();
        span.add(y3.clone());
        let y4 = second.basis().iter().find(|row| span.add((*row).clone()))?;
        let image = |x: &Vector| {
            // the coordinates of the bracket with y_4 in the basis that consists of the brackets
            // with y_3
            let columns = [bracket(y1, &y3), bracket(y2, &y3)];
            let dense = |row: &Vector| Some(on_plane(&centre, row)?.to_vec());
            let system = Matrix::from_dense(&[dense(&columns[0])?, dense(&columns[1])?]).ok()?;
            system.transpose().solve(&dense(&bracket(x, y4))?).ok()?
        };
        let (first, last) = (image(y1)?, image(y2)?);
        let half = Rational::new(1, 2)?;
        let trace = (first[0].clone() + &last[1]) * &half;
        let y4 = sum(y4, &scale(&y3, &-trace.clone()));
        let [a, b, c] = [first[0].clone() - &trace, last[0].clone(), first[1].clone()];
        let square = a.clone() * &a + &(b.clone() * &c);
        let factor = match square.recip() {
            Some(unit) => (e.clone() * &unit).sqrt()?,
            None if e.vanishes() => Rational::from(1),
            None => return None,
        };
        // chooses x_2 such that it is not an eigenvector of T; x_1 is a multiple of T x_2
        let apply = |[u, v]: &[Rational; 2]| {
            let below = c.clone() * u - &(a.clone() * v);
            [a.clone() * u + &(b.clone() * v), below]
        };
        let zero_one = |u: i64, v: i64| [Rational::from(u), Rational::from(v)];
        let (start, determinant) =
            [zero_one(0, 1), zero_one(1, 0), zero_one(1, 1)].into_iter().find_map(|start| {
                let [u, v] = apply(&start);
                let determinant = u * &start[1] - &(v * &start[0]);
                (!determinant.vanishes()).then_some((start, determinant))
            })?;
        let vector = |[u, v]: &[Rational; 2]| sum(&scale(y1, u), &scale(y2, v));
        let (x1, x2) = (scale(&vector(&apply(&start)), &factor), vector(&start));
        let x3 = bracket(&x1, &x2);
        let x4 = scale(&y4, &(factor.clone() * &factor * &determinant));
        let (x5, x6) = (bracket(&x1, &x3), bracket(&x2, &x3));
        Some(vec![x1, x2, x3, x4, x5, x6])
    }
}

/// The coordinates of a vector in a subspace of dimension 2; `None` if the subspace does not
/// contain the vector.
fn on_plane(plane: &Subspace<Rational>, x: &Vector) -> Option<[Rational; 2]> {
    let mut all = (plane.dimension() == 2).then(|| [Rational::from(0), Rational::from(0)])?;
    plane.coordinates(x)?.into_iter().for_each(|(at, value)| all[at] = value);
    Some(all)
}
