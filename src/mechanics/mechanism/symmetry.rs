//! Mobility by a symmetry of a loop that is an involution.
//!
//! Let an isometry `s` with `s^2 = 1` map the axes of a loop to axes of the loop. Consider the
//! positions with this symmetry.
//!
//! - If `s` moves the loop by half its length, then the second half of the loop is `s p s` for the
//!   first half `p`. The loop closes if `(p s)^2 = 1`. Near `s` the involutions are a manifold of
//!   the dimension of the class of `s`: 4 for half-turns, 3 for reflections and inversions.
//! - If `s` reverses the loop, then the loop closes if `p s p^-1 = s`. These are as many
//!   equations as the class of `s` has dimensions.
//!
//! If the equations are independent at the position, the symmetric positions are a smooth manifold
//! of known dimension. So R. Bricard's line-symmetric and plane-symmetric loops move
//! (*J. math. pures appl.* 3 (1897) 113-148).

use super::twist::{Twist, angular, cross, joined, linear};
use crate::tensors::linear::Matrix;
use crate::{Error, Field, Scalar};

/// The kinds of involutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Involution {
    /// The half-turn about a line.
    HalfTurn,
    /// The reflection in a plane.
    Reflection,
    /// The inversion in a point.
    Inversion,
}

impl Involution {
    /// The dimension of the set of these involutions: lines, planes or points.
    pub fn dimension(self) -> usize {
        if self == Involution::HalfTurn { 4 } else { 3 }
    }

    /// The description in words.
    pub fn name(self) -> &'static str {
        match self {
            Involution::HalfTurn => "half-turn about a line",
            Involution::Reflection => "reflection in a plane",
            Involution::Inversion => "inversion in a point",
        }
    }
}

/// A symmetry of a loop, and the mobility of its symmetric positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Symmetry {
    /// The involution.
    pub involution: Involution,
    /// Whether it reverses the order of the joints.
    pub reverses: bool,
    /// The dimension of the symmetric coordinates.
    pub coordinates: usize,
    /// The number of equations, which are independent.
    pub equations: usize,
}

impl Symmetry {
    /// The dimension of the symmetric closed positions.
    pub fn mobility(&self) -> usize {
        self.coordinates - self.equations
    }
}

/// An isometry of space: a matrix and a translation.
struct Isometry<S> {
    linear: [[S; 3]; 3],
    shift: [S; 3],
    /// The determinant of the matrix, `1` or `-1`.
    sign: i64,
}

/// The symmetry of a loop of one-parameter factors whose symmetric positions have the largest
/// dimension; `None` if the equations of every symmetry are dependent.
///
/// # Errors
/// Those of linear algebra.
pub fn symmetry<S: Field + Scalar>(chain: &[Twist<S>]) -> Result<Option<Symmetry>, Error> {
    let n = chain.len();
    let Some(basis) = independent(chain)? else { return Ok(None) };
    let mut best: Option<Symmetry> = None;
    let shift: Vec<usize> = (0..n).map(|i| (i + n / 2) % n).collect();
    let reversals = (0..n).map(|r| (0..n).map(|i| (n + r - i) % n).collect::<Vec<_>>());
    let shifts = n.is_multiple_of(2).then_some((shift, false));
    for (image, reverses) in shifts.into_iter().chain(reversals.map(|image| (image, true))) {
        for signs in 0..8_u32 {
            let Some(isometry) = isometry(chain, &image, &basis, signs)? else { continue };
            let Some(involution) = isometry.involution() else { continue };
            let Some(signs) = isometry.signs(chain, &image) else { continue };
            let found = counted(chain, &image, &signs, involution, reverses)?;
            if let Some(found) = found
                && best.is_none_or(|best| best.mobility() < found.mobility())
            {
                best = Some(found);
            }
        }
    }
    Ok(best)
}

/// Three factors whose angular parts are independent.
fn independent<S: Field + Scalar>(chain: &[Twist<S>]) -> Result<Option<[usize; 3]>, Error> {
    let mut found = vec![];
    for at in 0..chain.len() {
        let rows: Vec<Vec<S>> =
            found.iter().chain([&at]).map(|i: &usize| angular(&chain[*i]).to_vec()).collect();
        if Matrix::from_dense(&rows)?.rank()? > found.len() {
            found.push(at);
        }
    }
    Ok(found.try_into().ok())
}

/// The isometry of either sign that maps the axes of three factors to their images, up to signs.
fn isometry<S: Field + Scalar>(
    chain: &[Twist<S>],
    image: &[usize],
    basis: &[usize; 3],
    signs: u32,
) -> Result<Option<Isometry<S>>, Error> {
    let signed = |k: usize| {
        let twist = chain[image[basis[k]]].clone();
        if signs >> k & 1 == 1 { twist.map(|value| -value) } else { twist }
    };
    let rows = |twist: &dyn Fn(usize) -> Twist<S>| {
        let rows: Vec<Vec<S>> = (0..3).map(|k| angular(&twist(k)).to_vec()).collect();
        Matrix::from_dense(&rows)
    };
    let from = rows(&|k| chain[basis[k]].clone())?;
    let to = rows(&signed)?;
    // R a_k = sign b_k, where the rows of `from` are a_k: from R^T = sign to
    let Some(inverse) = from.inverse() else { return Ok(None) };
    let dense = inverse.mul(&to)?.transpose().to_dense();
    let proper: [[S; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|k| dense[i][k].clone()));
    let determinant = Matrix::from_dense(&dense)?.determinant()?;
    // w is an axial vector: an isometry R maps it by det(R) R, whose determinant is 1
    if !(determinant - &S::one()).vanishes() {
        return Ok(None);
    }
    for sign in [1_i64, -1] {
        let linear_map = proper.clone().map(|row| row.map(|value| value * &S::from_i64(sign)));
        // u' = R u + t cross w' for the three factors: linear equations for t
        let mut equations = vec![];
        let mut right = vec![];
        for k in 0..3 {
            let (own, other) = (&chain[basis[k]], signed(k));
            let (w, u) = (angular(&other), linear(&other));
            let moved = applied(&linear_map, &linear(own));
            let zero = S::zero;
            let [a, b, c] = w;
            equations.push(vec![zero(), c.clone(), -b.clone()]);
            equations.push(vec![-c, zero(), a.clone()]);
            equations.push(vec![b, -a, zero()]);
            right.extend((0..3).map(|i| u[i].clone() - &moved[i]));
        }
        let Some(shift) = Matrix::from_dense(&equations)?.solve(&right)? else { continue };
        let shift = std::array::from_fn(|i| shift[i].clone());
        let isometry = Isometry { linear: linear_map, shift, sign };
        if isometry.involution().is_some() {
            return Ok(Some(isometry));
        }
    }
    Ok(None)
}

fn applied<S: Field>(matrix: &[[S; 3]; 3], x: &[S; 3]) -> [S; 3] {
    std::array::from_fn(|i| super::twist::dot(&matrix[i], x))
}

impl<S: Field + Scalar> Isometry<S> {
    /// The twist of the conjugate motion.
    fn conjugated(&self, twist: &Twist<S>) -> Twist<S> {
        let sign = S::from_i64(self.sign);
        let w = applied(&self.linear, &angular(twist)).map(|value| value * &sign);
        let (u, turned) = (applied(&self.linear, &linear(twist)), cross(&self.shift, &w));
        joined(w, std::array::from_fn(|i| u[i].clone() + &turned[i]))
    }

    /// The kind, if the isometry is an involution.
    fn involution(&self) -> Option<Involution> {
        let m = &self.linear;
        let entry = |i: usize, k: usize| S::from_i64(i64::from(i == k));
        let row = |k: usize| std::array::from_fn::<S, 3, _>(|i| m[i][k].clone());
        for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
            let square = super::twist::dot(&m[i], &row(k)) - &entry(i, k);
            let transposed = m[i][k].clone() - &m[k][i];
            if !square.vanishes() || !transposed.vanishes() {
                return None;
            }
        }
        let back = applied(m, &self.shift);
        if (0..3).any(|i| !(back[i].clone() + &self.shift[i]).vanishes()) {
            return None;
        }
        let trace = m[0][0].clone() + &m[1][1] + &m[2][2];
        let kinds = [
            (-1, Involution::HalfTurn, 1),
            (1, Involution::Reflection, -1),
            (-3, Involution::Inversion, -1),
        ];
        let is = |value: i64| (trace.clone() - &S::from_i64(value)).vanishes();
        let found = kinds.into_iter().find(|(value, _, sign)| *sign == self.sign && is(*value));
        found.map(|(_, kind, _)| kind)
    }

    /// The sign of each factor: the conjugate of factor `i` is `sign_i` times its image.
    fn signs(&self, chain: &[Twist<S>], image: &[usize]) -> Option<Vec<i64>> {
        let sign = |(at, twist): (usize, &Twist<S>)| {
            let moved = self.conjugated(twist);
            let equal = |sign: i64| {
                let sign = S::from_i64(sign);
                let other = &chain[image[at]];
                (0..6).all(|i| (moved[i].clone() - &(other[i].clone() * &sign)).vanishes())
            };
            [1, -1].into_iter().find(|sign| equal(*sign))
        };
        chain.iter().enumerate().map(sign).collect()
    }
}

/// Counts the symmetric coordinates and the equations. Returns `None` if the equations are
/// dependent at the position.
fn counted<S: Field + Scalar>(
    chain: &[Twist<S>],
    image: &[usize],
    signs: &[i64],
    involution: Involution,
    reverses: bool,
) -> Result<Option<Symmetry>, Error> {
    let mut rows = vec![];
    for (at, twist) in chain.iter().enumerate() {
        let other = image[at];
        // a motion along the loop has the same sign on both sides, a reversal the opposite one
        let sign = if reverses { -signs[at] } else { signs[at] };
        if other == at && sign == 1 {
            rows.push(twist.to_vec());
        } else if at < other {
            let image = &chain[other];
            let sum = |i: usize| twist[i].clone() + &(image[i].clone() * &S::from_i64(sign));
            rows.push((0..6).map(sum).collect());
        }
    }
    let equations = match reverses {
        true => involution.dimension(),
        false => 6 - involution.dimension(),
    };
    if rows.len() < equations || Matrix::from_dense(&rows)?.rank()? != equations {
        return Ok(None);
    }
    Ok(Some(Symmetry { involution, reverses, coordinates: rows.len(), equations }))
}
