//! Isomorphisms with algebras of the catalogue. Both algebras are transformed to the same normal
//! form, and the images are verified.
//!
//! A solvable algebra of dimension 4 that is not nilpotent has one of two forms. Either one vector
//! acts on a nilradical of dimension 3 (abelian or Heisenberg), or two vectors act on a plane. The
//! actions `D` and `D'` of the two algebras satisfy `a D X = X D'`. These equations are linear in
//! `X` if `a` is known, and traces determine `a`.

use super::{Vector, catalogued, scale};
use crate::algebra::structure::subspace::{collected, combination};
use crate::algebra::structure::{Killing, StructureTheory, Subspace};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Ring};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

/// The largest integer that is tried as a component in the search for vectors of a prescribed
/// length.
const SMALL: i64 = 6;
const SMALL_IN_PLANE: i64 = 24;
const ON_CONIC: i64 = 100;
/// The maximum number of first vectors of a prescribed length that the search tries.
const FIRST: usize = 60;

/// The images of a basis. If `under_root` is present, each image must be multiplied by the square
/// root of its positive number.
pub(super) struct Images {
    pub vectors: Vec<Vector>,
    pub under_root: Option<Vec<Rational>>,
}

impl StructureTheory<Rational> {
    /// The images of the basis of a named algebra, if an isomorphism is found. The algebra is
    /// simple of dimension 3, or has dimension 4, or is nilpotent of dimension 5 or 6.
    pub(super) fn isomorphism_with(&self, name: &str) -> Option<Images> {
        let named = StructureTheory::new(catalogued(name)?);
        if !self.is_solvable() {
            return self.onto_simple(&named);
        }
        let forms = self.determinant_of_form(name).zip(named.determinant_of_form(name));
        if forms.is_some_and(|(own, other)| (own * &other).sqrt().is_none()) {
            // returns no isomorphism: the algebras may be isomorphic over the reals, but not over
            // the rationals
            return None;
        }
        let vectors = match (self.is_nilpotent(), self.nilradical().dimension()) {
            (true, 5..) if name.starts_with("degraaf(6,24,") => {
                // reads e from the bracket [x1, x4] = e x6
                let bracket = named.column_of(0, 3).pop();
                self.onto_pairing(&bracket.map_or_else(|| Rational::from(0), |(_, e)| e))
            }
            (true, 5..) => self.onto_nilpotent(&named),
            (true, _) => images(&named.nilpotent_form()?, &self.nilpotent_form()?),
            (_, 2) => images(&named.form_on_plane()?, &self.form_on_plane()?),
            _ => self.onto_extension(&named),
        }?;
        self.respects(&named, &vectors).then_some(Images { vectors, under_root: None })
    }

    /// The number whose irrational square root occurs in every isomorphism with a named algebra.
    /// Returns `None` if no invariant proves this.
    ///
    /// The invariants are known up to squares. For a nilpotent family, the invariant is the
    /// determinant of the quadratic form. For two vectors that act on a plane, it is the square of
    /// the trace-free action. For one vector with a trace-free action, it is `tr(D^2)`, because
    /// `a D` is conjugate to `D'`.
    pub(super) fn needed_root(&self, name: &str) -> Option<Rational> {
        if !self.is_solvable() {
            return None;
        }
        let named = StructureTheory::new(catalogued(name)?);
        let square = |all: &Self| match all.dimension() - all.nilradical().dimension() {
            0 => all.determinant_of_form(name),
            2 => all.square_on_plane().map(|(_, _, square)| square),
            _ => {
                let (trace, square) = traces(&all.extension_form()?.2)?;
                trace.vanishes().then_some(square)
            }
        };
        let (own, other) = (square(self)?, square(&named)?);
        let product = own * &other;
        let (root, _) = without_squares(&product);
        (!product.vanishes() && !product.is_negative() && product.sqrt().is_none()).then_some(root)
    }

    /// Whether the images `f_i` satisfy `[f_i, f_j] = c^k_ij f_k` and are a basis.
    pub(super) fn respects(&self, named: &Self, images: &[Vector]) -> bool {
        let n = self.dimension();
        let brackets = (0..n).all(|i| {
            let ad = self.products.ad(&images[i]);
            let named = named.products.ad(&[(i, Rational::from(1))]);
            (0..n).all(|j| ad.image(&images[j]) == combination(images, named.column(j)))
        });
        brackets && Subspace::span(n, images.iter().cloned()).dimension() == n
    }

    /// An adapted basis of a nilpotent algebra: `x, y, [x, y], [x, [x, y]]`, or `x, y, [x, y]` and
    /// a central vector, or any basis if the algebra is abelian.
    pub(in crate::algebra::structure) fn nilpotent_form(&self) -> Option<Vec<Vector>> {
        let units = self.unit_vectors();
        let derived = self.derived();
        let bracket = |x: &Vector, y: &Vector| self.products.ad(x).image(y);
        if derived.is_zero() {
            return Some(units);
        }
        // chooses y that commutes with the derived algebra, and x that does not, if possible
        let centralizer = self.centralizer(derived);
        let outside = |y: &&Vector| !derived.contains(y);
        for y in centralizer.basis().iter().filter(outside) {
            for x in &units {
                let z = bracket(x, y);
                if z.is_empty() || (derived.dimension() == 2 && centralizer.contains(x)) {
                    continue;
                }
                let mut span = Subspace::span(self.dimension(), [x.clone(), y.clone(), z.clone()]);
                let last = match derived.dimension() {
                    2 => Some(bracket(x, &z)),
                    _ => self.centre().basis().iter().find(|c| span.add((*c).clone())).cloned(),
                };
                return Some(vec![x.clone(), y.clone(), z, last?]);
            }
        }
        None
    }

    /// Applies if the nilradical is a plane. Returns the vector `h` that acts on the plane as 1, a
    /// vector `k` whose action is trace-free, and the square of this action.
    fn square_on_plane(&self) -> Option<(Vector, Vector, Rational)> {
        let plane = self.nilradical();
        let outside: Vec<usize> = plane.complement().collect();
        let unit = |at: usize| vec![(at, Rational::from(1))];
        let [e, f] = [unit(*outside.first()?), unit(*outside.get(1)?)];
        let matrix = |x: &Vector| Some(self.action(x, &plane, None)?.to_dense().concat());
        let system = Matrix::from_dense(&[matrix(&e)?, matrix(&f)?]).ok()?.transpose();
        let one = [1, 0, 0, 1].map(Rational::from);
        let solution = system.solve(&one).ok()??;
        let h = sum(&scale(&e, &solution[0]), &scale(&f, &solution[1]));
        let half = Rational::new(1, 2)?;
        [e, f].into_iter().find_map(|x| {
            let m = self.action(&x, &plane, None)?;
            let trace = m.get(0, 0) + &m.get(1, 1);
            let k = sum(&x, &scale(&h, &-(trace * &half)));
            let square = -self.action(&k, &plane, None)?.determinant().ok()?;
            (!square.vanishes()).then(|| (h.clone(), k, square))
        })
    }

    /// Applies if the nilradical is a plane. Returns a basis `u, v` of the plane and commuting
    /// vectors `h`, `k`. The vector `h` acts as 1, and the square of the action of `k` is 1 or -1.
    pub(in crate::algebra::structure) fn form_on_plane(&self) -> Option<Vec<Vector>> {
        let (h, k, square) = self.square_on_plane()?;
        let k = scale(&k, &square.clone().abs().sqrt()?.recip()?);
        let twisted = self.products.ad(&h).image(&k);
        let k = sum(&k, &scale(&twisted, &Rational::from(-1)));
        let ad = self.products.ad(&k);
        let plane = self.nilradical();
        let basis = plane.basis();
        if square.is_negative() {
            return Some(vec![basis[0].clone(), ad.image(&basis[0]), h, k]);
        }
        // finds an eigenvector of k, as an image of k + 1 or of k - 1
        let eigenvector = |sign: i64| {
            let image = |v: &Vector| sum(&ad.image(v), &scale(v, &Rational::from(sign)));
            basis.iter().map(image).find(|v| !v.is_empty())
        };
        Some(vec![eigenvector(1)?, eigenvector(-1)?, h, k])
    }

    /// The vector that acts on a nilradical of dimension 3, the vectors on which it acts, and the
    /// matrix of the action.
    pub(in crate::algebra::structure) fn extension_form(
        &self,
    ) -> Option<(Vector, Vec<Vector>, Matrix<Rational>)> {
        let nilradical = self.nilradical();
        let n = self.dimension();
        let e: Vector = vec![(nilradical.complement().next()?, Rational::from(1))];
        let square = self.subalgebra(&nilradical).ok()?.derived().clone();
        let centre = nilradical.within(&square);
        let mut span = centre.clone();
        let acted: Vec<Vector> =
            nilradical.basis().iter().filter(|row| span.add((*row).clone())).cloned().collect();
        let mut e = e;
        if let ([z], [v, w]) = (centre.basis(), &acted[..]) {
            // chooses n such that [e + n, v] and [e + n, w] are in the span of v, w
            let basis = [v.clone(), w.clone(), z.clone()];
            let last = |x: &Vector| coordinates(n, &basis, x).map(|all| all[2].clone());
            let unit = last(&self.products.ad(v).image(w))?.recip()?;
            let ad = self.products.ad(&e);
            let (by_v, by_w) = (last(&ad.image(v))? * &unit, last(&ad.image(w))? * &unit);
            e = sum(&e, &sum(&scale(w, &by_v), &scale(v, &-by_w)));
        }
        let action = self.action(&e, &nilradical, Some(&centre))?;
        Some((e, acted, action))
    }

    fn onto_extension(&self, named: &Self) -> Option<Vec<Vector>> {
        let n = self.dimension();
        let (e, acted, own) = self.extension_form()?;
        let (f, named_acted, other) = named.extension_form()?;
        let m = acted.len();
        if named_acted.len() != m {
            return None;
        }
        let ((t1, t2), (s1, s2)) = (traces(&own)?, traces(&other)?);
        let factors = match (t1.recip(), t2.recip()) {
            (Some(unit), _) => vec![s1 * &unit],
            (None, Some(unit)) => {
                let root = (s2 * &unit).sqrt()?;
                vec![root.clone(), -root]
            }
            _ => return None,
        };
        for factor in factors {
            // the equations a D X - X D' = 0; the unknown X_ij has the index i m + j
            let rows = (0..m * m).map(|at| {
                let (i, j) = (at / m, at % m);
                let left = (0..m).map(|k| (k * m + j, own.get(i, k) * &factor));
                let right = (0..m).map(|k| (i * m + k, -other.get(k, j)));
                collected(left.chain(right).collect())
            });
            let kernel = Subspace::kernel(m * m, rows.filter(|row| !row.is_empty()));
            for trial in 0..8i64 {
                let weights = (0..kernel.dimension()).map(|at| {
                    let at = at as i64;
                    (
                        at as usize,
                        Rational::from(if trial == 0 {
                            1
                        } else {
                            (at * trial * 5 + trial) % 7 - 3
                        }),
                    )
                });
                let x = kernel.vector(&weights.filter(|(_, v)| !v.vanishes()).collect::<Vec<_>>());
                let column = |j: usize| -> Vector {
                    let own = x.iter().filter(|(at, _)| at % m == j);
                    let terms: Vector = own.map(|(at, v)| (at / m, v.clone())).collect();
                    combination(&acted, &terms)
                };
                let mut from = vec![f.clone()];
                from.extend(named_acted.iter().cloned());
                let mut to = vec![scale(&e, &factor)];
                to.extend((0..m).map(column));
                if m == 2 {
                    from.push(named.products.ad(&from[1]).image(&from[2]));
                    to.push(self.products.ad(&to[1]).image(&to[2]));
                }
                if Subspace::span(n, to.iter().cloned()).dimension() < n {
                    continue;
                }
                if let Some(found) = images(&from, &to).filter(|all| self.respects(named, all)) {
                    return Some(found);
                }
            }
        }
        None
    }

    /// The images for a simple algebra of dimension 3, or its direct sum with a central line.
    fn onto_simple(&self, named: &Self) -> Option<Images> {
        let other = named.frame(2)?.vectors;
        if let Some(own) = self.frame(2) {
            let vectors = images(&other, &own.vectors).filter(|all| self.respects(named, all))?;
            return Some(Images { vectors, under_root: None });
        }
        // each image is a multiple of one vector of the frame, divided by the square root of the
        // number in `squares`
        let Frame { vectors, squares } = self.frame(0)?;
        let (mut found, mut under_root) = (vec![], vec![]);
        for unit in named.unit_vectors() {
            let terms = coordinates(named.dimension(), &other, &unit)?;
            let mut terms = terms.iter().enumerate().filter(|(_, value)| !value.vanishes());
            let (Some((at, value)), None) = (terms.next(), terms.next()) else { return None };
            found.push(scale(&vectors[at], value));
            under_root.push(squares[at].recip()?);
        }
        Some(Images { vectors: found, under_root: Some(under_root) })
    }

    /// A frame of orthogonal vectors `x`, `y` with Killing squares `-2 s` and `+-2 t`, followed by
    /// `[x, y]` and a basis of the centre. The first `roots` of the numbers `s`, `t` are squares,
    /// and the vectors are divided by the square roots of these numbers.
    pub(in crate::algebra::structure) fn frame(&self, roots: usize) -> Option<Frame> {
        let (x, y, s, t) = self.orthogonal_vectors(roots).or_else(|| self.split_vectors())?;
        let z = self.products.ad(&x).image(&y);
        let both = s.clone() * &t;
        let (mut vectors, mut squares) = (vec![x, y, z], vec![s, t, both]);
        for line in self.centre().basis() {
            vectors.push(line.clone());
            squares.push(Rational::from(1));
        }
        Some(Frame { vectors, squares })
    }

    /// The vectors `x`, `y` and the numbers `s`, `t` of [`frame`](Self::frame), found by a search
    /// among small integers.
    fn orthogonal_vectors(&self, roots: usize) -> Option<(Vector, Vector, Rational, Rational)> {
        let derived = self.derived();
        let basis = derived.basis();
        let killing = self.killing_matrix().to_dense();
        let product = |x: &Vector, y: &Vector| {
            let terms = x.iter().flat_map(|(i, a)| y.iter().map(move |(j, b)| (i, j, a, b)));
            terms.fold(Rational::from(0), |sum, (i, j, a, b)| {
                sum + &(a.clone() * b * &killing[*i][*j])
            })
        };
        let half = Rational::new(1, 2)?;
        let root = |square: &Rational| square.sqrt().and_then(|root| root.recip());
        let compact = self.killing().signature()?[0] == 0;
        let range = || (0..=2 * SMALL).map(|k| if k % 2 == 0 { -k / 2 } else { (k + 1) / 2 });
        let triples =
            range().flat_map(|a| range().flat_map(move |b| range().map(move |c| [a, b, c])));
        let mut firsts = triples.filter_map(|t| {
            let x = vector(basis, &t);
            let square = -(product(&x, &x) * &half);
            let fits = !square.vanishes() && !square.is_negative();
            (fits && (roots < 1 || root(&square).is_some())).then_some((x, square))
        });
        firsts.by_ref().take(FIRST).find_map(|(x, s)| {
            let row: Vector = basis.iter().map(|v| product(&x, v)).enumerate().collect();
            let row = row.into_iter().filter(|(_, value)| !value.vanishes()).collect();
            let plane = derived.within(&Subspace::kernel(basis.len(), [row]));
            let small = || (0..=SMALL_IN_PLANE).flat_map(|a| [a, -a]);
            let pairs = (0..=SMALL_IN_PLANE).flat_map(|a| small().map(move |b| [a, b]));
            let (y, t) = pairs.into_iter().find_map(|pair| {
                let y = vector(plane.basis(), &pair);
                let square = product(&y, &y) * &half;
                let square = if compact { -square } else { square };
                let fits = !square.vanishes() && !square.is_negative();
                (fits && (roots < 2 || root(&square).is_some())).then_some((y, square))
            })?;
            let unit = |x: Vector, square: Rational, exact: bool| match exact {
                true => Some((scale(&x, &root(&square)?), Rational::from(1))),
                false => Some((x, square)),
            };
            let ((x, s), (y, t)) = (unit(x, s, roots > 0)?, unit(y, t, roots > 1)?);
            Some((x, y, s, t))
        })
    }

    /// The vectors and numbers of [`frame`](Self::frame) for an algebra that is sl(2) over the
    /// rationals. A vector `e` with Killing square 0 is completed to a basis with `[h, e] = 2 e`,
    /// `[h, f] = -2 f`, `[e, f] = h`. The vectors are `x = (e - f)/2` and `y = h/2`.
    fn split_vectors(&self) -> Option<(Vector, Vector, Rational, Rational)> {
        let bracket = |x: &Vector, y: &Vector| self.products.ad(x).image(y);
        let (half, minus) = (Rational::new(1, 2)?, Rational::from(-1));
        let e = self.isotropic_vector()?;
        // m is defined by [[e, v], e] = m e; it is nonzero if v is not orthogonal to e
        let of = |v: &Vector| {
            let m = multiple(&bracket(&bracket(&e, v), &e), &e)?;
            let f = scale(v, &(Rational::from(2) * &m.recip()?));
            let h = bracket(&e, &f);
            let rest = sum(&bracket(&h, &f), &scale(&f, &Rational::from(2)));
            // the sum [h, f] + 2 f is a multiple of e; the correction of f removes this multiple
            let own = multiple(&rest, &e).unwrap_or_else(|| Rational::from(0));
            Some((h, sum(&f, &scale(&e, &(-own * &Rational::new(1, 4)?)))))
        };
        let (h, f) = self.derived().basis().iter().find_map(of)?;
        let (x, y) = (scale(&sum(&e, &scale(&f, &minus)), &half), scale(&h, &half));
        Some((x, y, Rational::from(1), Rational::from(1)))
    }

    /// A vector with Killing square 0 in the derived algebra, which has dimension 3. The vector is
    /// a point of the conic `a i^2 + b j^2 + c k^2 = 0`, found by a search among small `i` and `j`.
    fn isotropic_vector(&self) -> Option<Vector> {
        let basis = self.derived().basis();
        let rows = Matrix::from_rows(self.dimension(), basis.iter().cloned()).ok()?;
        let gram = rows.mul(self.killing_matrix()).ok()?.mul(&rows.transpose()).ok()?;
        let Killing { basis: axes, values, .. } = Killing::new(gram);
        let axis = |(x, value): (&Vector, &Rational)| {
            let (square, by) = without_squares(value);
            (scale(&combination(basis, x), &by), square)
        };
        let axes: Vec<(Vector, Rational)> = axes.iter().zip(&values).map(axis).collect();
        let [(x, a), (y, b), (z, c)] = &axes[..] else { return None };
        let unit = c.recip()?;
        let pairs = (0..=ON_CONIC).flat_map(|i| (0..=ON_CONIC).map(move |j| [i, j]));
        pairs.skip(1).find_map(|[i, j]| {
            let squares =
                a.clone() * &Rational::from(i * i) + &(b.clone() * &Rational::from(j * j));
            let k = (-squares * &unit).sqrt()?;
            let [i, j] = [i, j].map(Rational::from);
            Some(sum(&scale(z, &k), &sum(&scale(x, &i), &scale(y, &j))))
        })
    }
}

/// Orthogonal vectors and their Killing squares.
pub(in crate::algebra::structure) struct Frame {
    pub vectors: Vec<Vector>,
    squares: Vec<Rational>,
}

/// The traces `tr D` and `tr D^2`.
fn traces(matrix: &Matrix<Rational>) -> Option<(Rational, Rational)> {
    let square = matrix.mul(matrix).ok()?;
    let trace =
        |a: &Matrix<Rational>| (0..a.rows()).fold(Rational::from(0), |sum, i| sum + &a.get(i, i));
    Some((trace(matrix), trace(&square)))
}

/// Factors a value into a number without small square factors, and the square of a second number.
/// Returns the first and the second number.
fn without_squares(value: &Rational) -> (Rational, Rational) {
    let value = BigRational::from(value);
    let (mut square, mut by) =
        (value.numer() * value.denom(), BigRational::from(value.denom().clone()));
    for factor in (2..100).map(BigInt::from) {
        while (&square % (&factor * &factor)).is_zero() && !square.is_zero() {
            square /= &factor * &factor;
            by /= &factor;
        }
    }
    (Rational::from(BigRational::from(square)), Rational::from(by))
}

/// The factor `m` in `x = m e`; `None` if `x` or `e` is 0.
fn multiple(x: &Vector, e: &Vector) -> Option<Rational> {
    let ((_, above), (_, below)) = (x.first()?, e.first()?);
    Some(above.clone() * &below.recip()?)
}

/// The linear combination of the basis vectors with these integer coefficients.
fn vector(basis: &[Vector], coefficients: &[i64]) -> Vector {
    let terms = coefficients.iter().enumerate().filter(|(_, value)| **value != 0);
    combination(basis, &terms.map(|(at, value)| (at, Rational::from(*value))).collect::<Vector>())
}

pub(in crate::algebra::structure) fn sum(x: &Vector, y: &Vector) -> Vector {
    collected(x.iter().chain(y).cloned().collect())
}

/// The coordinates of a vector in a basis of a subspace.
fn coordinates(n: usize, basis: &[Vector], x: &Vector) -> Option<Vec<Rational>> {
    let mut dense = vec![Rational::from(0); n];
    x.iter().for_each(|(at, value)| dense[*at] = value.clone());
    Matrix::from_rows(n, basis.iter().cloned()).ok()?.transpose().solve(&dense).ok()?
}

/// The images of the unit vectors under the linear map that maps the basis `from` to the basis
/// `to`.
pub(in crate::algebra::structure) fn images(from: &[Vector], to: &[Vector]) -> Option<Vec<Vector>> {
    let n = from.len();
    let unit = |at: usize| coordinates(n, from, &vec![(at, Rational::from(1))]);
    let image = |at: usize| {
        let terms = unit(at)?.into_iter().enumerate().filter(|(_, value)| !value.vanishes());
        Some(combination(to, &terms.collect::<Vector>()))
    };
    (0..n).map(image).collect()
}
