//! Left-invariant complex structures in dimension 2 and 4: endomorphisms `J` with `J^2 = -1` and
//! `[Jx, Jy] = [x, y] + J [Jx, y] + J [x, Jy]`.
//!
//! Let `D = ad_e` act on an abelian ideal `U` of dimension 3. The plane `U & J U` is invariant, and
//! `D` commutes with `J` on the plane. To see this, take `e = J v` with `v` in `U`, and `x` in the
//! plane. Then `[v, x] = [v, Jx] = 0` implies `D J x = J D x`. Therefore, a complex structure
//! exists if and only if `D` has complex eigenvalues or an eigenspace of dimension 2. In this case,
//! `J` exchanges `e` with a vector outside the plane. All other algebras of dimension 4 have a
//! complex structure. Compare G. Ovando, *Manuscripta Math.* 103 (2000) 19-30.

use super::identification::{scale as scaled, spectrum, sum, vector_images};
use super::{StructureTheory, Subspace};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Rational, Ring};

type Vector = Row<Rational>;

/// Whether a complex structure exists over the reals, and a rational structure if one is found.
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexStructure {
    /// Whether a complex structure exists.
    pub exists: bool,
    /// The images `J e_i` of the basis, if a rational structure is found.
    pub images: Option<Vec<Vec<Rational>>>,
}

impl StructureTheory<Rational> {
    /// Decides whether there is a left-invariant complex structure. Returns `None` in dimensions
    /// other than 2 and 4.
    pub fn complex_structure(&self) -> Option<ComplexStructure> {
        let _stage = stage("complex structure");
        let pairs = match self.dimension() {
            2 => {
                let [x, y] = &self.whole().basis().to_vec()[..] else { return None };
                Some(vec![[x.clone(), y.clone()]])
            }
            4 => match self.pairs_of_dimension_four() {
                Pairs::Found(pairs) => Some(pairs),
                Pairs::Irrational => None,
                Pairs::Impossible => return Some(ComplexStructure { exists: false, images: None }),
                Pairs::Unknown => return None,
            },
            _ => return None,
        };
        let images = pairs.and_then(|pairs| {
            let minus = Rational::from(-1);
            let from: Vec<Vector> = pairs.iter().flatten().cloned().collect();
            let to =
                pairs.iter().flat_map(|[x, y]| [y.clone(), scaled(x, &minus)]).collect::<Vec<_>>();
            let images = vector_images(&from, &to)?;
            let dense = |row: &Vector| {
                let mut all = vec![Rational::from(0); self.dimension()];
                row.iter().for_each(|(at, value)| all[*at] = value.clone());
                all
            };
            Some(images.iter().map(dense).collect())
        });
        Some(ComplexStructure { exists: true, images })
    }

    fn pairs_of_dimension_four(&self) -> Pairs {
        let solvable = self.is_solvable();
        let found = match (solvable, self.nilradical().dimension()) {
            (false, _) => self.simple_and_centre(),
            (_, 2) => self.pairs_on_plane(),
            (_, 3) => match self.extension_form() {
                Some((e, acted, action)) if acted.len() == 3 => {
                    return self.pairs_on_space(&e, &acted, &action);
                }
                Some((e, acted, action)) => self.pairs_on_heisenberg(e, &acted, &action),
                None => return Pairs::Unknown,
            },
            _ => {
                let Some(form) = self.nilpotent_form() else { return Pairs::Unknown };
                let Some(action) = self.matrix_on(&form[0], &form[1..]) else {
                    return Pairs::Unknown;
                };
                return self.pairs_on_space(&form[0], &form[1..], &action);
            }
        };
        found.map_or(Pairs::Irrational, Pairs::Found)
    }

    /// The matrix of `ad_e` on the span of the independent vectors `acted`.
    fn matrix_on(&self, e: &Vector, acted: &[Vector]) -> Option<Matrix<Rational>> {
        let space = Subspace::span(self.dimension(), acted.iter().cloned());
        let basis = Matrix::from_rows(self.dimension(), acted.iter().cloned()).ok()?.transpose();
        let ad = self.products.ad(e);
        let columns = acted.iter().map(|x| {
            let image = ad.image(x);
            space.contains(&image).then_some(())?;
            let mut dense = vec![Rational::from(0); self.dimension()];
            image.into_iter().for_each(|(at, value)| dense[at] = value);
            basis.solve(&dense).ok()?
        });
        let columns = columns.collect::<Option<Vec<Vec<Rational>>>>()?;
        Some(Matrix::from_dense(&columns).ok()?.transpose())
    }

    /// Finds `J` if `e` acts by `D` on an abelian ideal of dimension 3.
    fn pairs_on_space(&self, e: &Vector, acted: &[Vector], action: &Matrix<Rational>) -> Pairs {
        let Some(spectrum) = spectrum(action) else { return Pairs::Unknown };
        let polynomial = |constant: &Rational, linear: &Rational| {
            // evaluates the polynomial D^2 + linear D + constant, or D + constant
            let shift = Matrix::diagonal(std::iter::repeat_n(constant.clone(), 3));
            let linear = action.map(|v| v.clone() * linear);
            linear.add(&shift).ok()
        };
        let in_algebra = |row: &Vector| super::subspace::combination(acted, row);
        let outside = |plane: &Subspace<Rational>| {
            plane.complement().next().map(|at| in_algebra(&vec![(at, Rational::from(1))]))
        };
        let kernel =
            |matrix: &Matrix<Rational>| Subspace::kernel(3, (0..3).map(|i| matrix.row(i).to_vec()));
        if let Some(pair) = &spectrum.complex {
            let Some((real, square)) = pair else { return Pairs::Irrational };
            let Some(unit) = square.sqrt().and_then(|root| root.recip()) else {
                return Pairs::Irrational;
            };
            let found = (|| {
                let shifted = polynomial(&-real.clone(), &Rational::from(1))?;
                let squares = Matrix::diagonal(std::iter::repeat_n(square.clone(), 3));
                let plane = kernel(&shifted.mul(&shifted).ok()?.add(&squares).ok()?);
                let x = plane.basis().first()?;
                let columns = shifted.transpose();
                let rows: Vec<Vector> = (0..3).map(|j| columns.row(j).to_vec()).collect();
                let y = scaled(&super::subspace::combination(&rows, x), &unit);
                Some(vec![[in_algebra(x), in_algebra(&y)], [e.clone(), outside(&plane)?]])
            })();
            return found.map_or(Pairs::Unknown, Pairs::Found);
        }
        for root in &spectrum.rational {
            let Some(shifted) = polynomial(&-root.clone(), &Rational::from(1)) else {
                return Pairs::Unknown;
            };
            let space = kernel(&shifted);
            if let [x, y, ..] = space.basis() {
                let plane = Subspace::span(3, [x.clone(), y.clone()]);
                let Some(last) = outside(&plane) else { return Pairs::Unknown };
                return Pairs::Found(vec![[in_algebra(x), in_algebra(y)], [e.clone(), last]]);
            }
        }
        Pairs::Impossible
    }

    /// Finds `J` if `e` acts by `D` on `v, w` of the Heisenberg algebra with `z = [v, w]`. If `D`
    /// commutes with a complex structure of the plane, `J` exchanges `e` and `z`. Otherwise let
    /// `D v = a v`, and let `b` be the other eigenvalue; then `J e = -b w` and `J v = -z`.
    fn pairs_on_heisenberg(
        &self,
        e: Vector,
        acted: &[Vector],
        action: &Matrix<Rational>,
    ) -> Option<Vec<[Vector; 2]>> {
        let spectrum = spectrum(action)?;
        let in_algebra = |row: &[Rational]| {
            let row = row.iter().cloned().enumerate().filter(|(_, v)| !v.vanishes());
            super::subspace::combination(acted, &row.collect::<Vector>())
        };
        let bracket = |x: &Vector, y: &Vector| self.products.ad(x).image(y);
        let one = [Rational::from(1), Rational::from(0)];
        let shifted = |root: &Rational| {
            action.add(&Matrix::diagonal(std::iter::repeat_n(-root.clone(), 2))).ok()
        };
        if let Some(pair) = &spectrum.complex {
            let (real, square) = pair.as_ref()?;
            let unit = square.sqrt()?.recip()?;
            let v = in_algebra(&one);
            let w = scaled(&in_algebra(&shifted(real)?.apply(&one).ok()?), &unit);
            let z = bracket(&v, &w);
            return Some(vec![[v, w], [e, z]]);
        }
        for (at, other) in spectrum.rational.iter().enumerate() {
            let eigenvalue = spectrum.rational.get(1 - at)?;
            if other.vanishes() {
                continue;
            }
            let matrix = shifted(eigenvalue)?;
            let kernel = Subspace::kernel(2, (0..2).map(|i| matrix.row(i).to_vec()));
            let v = kernel.dense().first()?.clone();
            let place = usize::from(v[0].vanishes());
            // w is any vector that is not a multiple of v
            let mut w = [Rational::from(0), Rational::from(0)];
            w[1 - place] = Rational::from(1);
            let (v, w) = (in_algebra(&v), in_algebra(&w));
            let z = bracket(&v, &w);
            let minus = Rational::from(-1);
            return Some(vec![[e, scaled(&w, &-other.clone())], [v, scaled(&z, &minus)]]);
        }
        None
    }

    /// Finds `J` if two vectors act on the nilradical. The algebra then is a sum of two algebras of
    /// dimension 2, or a complex algebra.
    fn pairs_on_plane(&self) -> Option<Vec<[Vector; 2]>> {
        let form = self.form_on_plane()?;
        let [u, v, h, k] = &form[..] else { return None };
        let half = Rational::new(1, 2)?;
        let ad = self.products.ad(k);
        if ad.image(u) == *u {
            let minus = scaled(k, &Rational::from(-1));
            let (first, second) = (scaled(&sum(h, k), &half), scaled(&sum(h, &minus), &half));
            return Some(vec![[first, u.clone()], [second, v.clone()]]);
        }
        Some(vec![[u.clone(), v.clone()], [h.clone(), k.clone()]])
    }

    /// Finds `J` if `x` rotates `y` and `[x, y]`; then `J x` is central.
    fn simple_and_centre(&self) -> Option<Vec<[Vector; 2]>> {
        // prefers a frame in which the lengths of x and y are rational, but only the length of x
        // must be rational
        let frame = self.frame(2).or_else(|| self.frame(1))?;
        let [x, y, z, centre] = &frame.vectors[..] else { return None };
        Some(vec![[y.clone(), z.clone()], [x.clone(), centre.clone()]])
    }
}

/// A complex structure as pairs `x, J x` that form a basis.
enum Pairs {
    Found(Vec<[Vector; 2]>),
    /// A structure exists over the reals, but no rational structure is known.
    Irrational,
    Impossible,
    Unknown,
}
