//! The sign of the parameter in four nilpotent families of dimension 6, determined by invariant
//! quadratic forms in two variables.
//!
//! The parameter `e` of de Graaf's algebras `6,19`, `6,21`, `6,22`, `6,24` determines a quadratic
//! form. For `6,19`, the form is `q(y) = [y, [x_1, y]]`, with `x_1` in the centralizer of the
//! derived algebra. For `6,21`, it is `[y, [z, [x_1, x_2]]]` on `L/[L,L]`. For `6,22`, it is the
//! Pfaffian of `f([x, y])`, for `f` on the derived algebra. For `6,24`, it is the determinant of
//! the pairing of `L/Z_2` with `Z_2/Z`, for `f` on the centre `Z`. Up to a factor, the first two
//! forms are equivalent to `a^2 + e b^2`, and the last two to `a^2 - e b^2`.

use super::{StructureTheory, Subspace, Vector};
use affinor_tensors::{Rational, Ring};

impl StructureTheory<Rational> {
    /// Whether the parameter of a family is positive. Returns `None` for other names, or if the
    /// form is degenerate.
    pub(super) fn has_positive_parameter(&self, name: &str) -> Option<bool> {
        let determinant = self.determinant_of_form(name)?;
        let definite = !determinant.vanishes() && !determinant.is_negative();
        let is_sum = ["degraaf(6,19,", "degraaf(6,21,"].iter().any(|head| name.starts_with(head));
        (!determinant.vanishes()).then_some(definite == is_sum)
    }

    /// Four times the determinant of the form, up to squares. Returns `None` for other names.
    pub(super) fn determinant_of_form(&self, name: &str) -> Option<Rational> {
        let family = name.strip_prefix("degraaf(6,")?.split(',').next()?;
        // the determinant of a form with the coefficients (A, B, C) is A C - B^2 / 4
        let [a, b, c] = match family {
            "19" => self.form_by_centralizer()?,
            "21" => self.form_by_triple_brackets()?,
            "22" => self.values_at_functionals(self.derived(), &self.whole(), &self.whole())?,
            "24" => {
                let (centre, second) = (self.centre(), self.upper_central_series().get(2)?.clone());
                self.values_at_functionals(&centre, &self.whole(), &second)?
            }
            _ => return None,
        };
        Some(a * &c * &Rational::from(4) - &(b.clone() * &b))
    }

    fn bracket_of(&self, x: &Vector, y: &Vector) -> Vector {
        self.products.ad(x).image(y)
    }

    /// The coordinate of a vector in a subspace of dimension 1. Returns `None` if the subspace has
    /// another dimension, or does not contain the vector.
    fn on_line(line: &Subspace<Rational>, x: &Vector) -> Option<Rational> {
        (line.dimension() == 1).then_some(())?;
        Some(line.coordinates(x)?.pop().map_or_else(|| Rational::from(0), |(_, value)| value))
    }

    fn form_by_centralizer(&self) -> Option<[Rational; 3]> {
        let line = self.lower_central_series().iter().rev().nth(1)?;
        let centralizer = self.centralizer(self.derived());
        let first = centralizer.basis().iter().find(|x| !self.derived().contains(x))?;
        let outside: Vec<Vector> =
            centralizer.complement().map(|at| vec![(at, Rational::from(1))]).collect();
        let [y, z] = &outside[..] else { return None };
        let value = |y: &Vector, z: &Vector| {
            Self::on_line(line, &self.bracket_of(y, &self.bracket_of(first, z)))
        };
        Some([value(y, y)?, value(y, z)? + &value(z, y)?, value(z, z)?])
    }

    fn form_by_triple_brackets(&self) -> Option<[Rational; 3]> {
        let line = self.lower_central_series().iter().rev().nth(1)?;
        let outside: Vec<Vector> =
            self.derived().complement().map(|at| vec![(at, Rational::from(1))]).collect();
        let [y, z] = &outside[..] else { return None };
        let w = self.bracket_of(y, z);
        let value = |y: &Vector, z: &Vector| {
            Self::on_line(line, &self.bracket_of(y, &self.bracket_of(z, &w)))
        };
        Some([value(y, y)?, value(y, z)? + &value(z, y)?, value(z, z)?])
    }

    /// The coefficients of a quadratic form in functionals `f` on the plane `values`. If `right` is
    /// the whole algebra, the form is the Pfaffian of `f([x, y])` on a complement of the plane.
    /// Otherwise, it is the determinant of the pairing of a complement of `right` with a complement
    /// of the plane in `right`.
    fn values_at_functionals(
        &self,
        values: &Subspace<Rational>,
        whole: &Subspace<Rational>,
        right: &Subspace<Rational>,
    ) -> Option<[Rational; 3]> {
        let mut span = values.clone();
        let right_basis: Vec<Vector> =
            right.basis().iter().filter(|row| span.add((*row).clone())).cloned().collect();
        let left: Vec<Vector> =
            whole.basis().iter().filter(|row| span.add((*row).clone())).cloned().collect();
        let bracket = |x: &Vector, y: &Vector, f: [i64; 2]| -> Option<Rational> {
            let all = values.coordinates(&self.bracket_of(x, y))?;
            let term = |(at, value): (usize, Rational)| value * &Rational::from(f[at]);
            Some(all.into_iter().map(term).fold(Rational::from(0), |sum, v| sum + &v))
        };
        let at = |f: [i64; 2]| -> Option<Rational> {
            let product = |[a, b, c, d]: [&Vector; 4]| Some(bracket(a, b, f)? * &bracket(c, d, f)?);
            match (&left[..], &right_basis[..]) {
                ([], [a, b, c, d]) => {
                    let (first, second) = (product([a, b, c, d])?, product([a, c, b, d])?);
                    Some(first - &second + &product([a, d, b, c])?)
                }
                ([x, y], [z, w]) => Some(product([x, z, y, w])? - &product([x, w, y, z])?),
                _ => None,
            }
        };
        let (a, c) = (at([1, 0])?, at([0, 1])?);
        let b = at([1, 1])? - &a - &c;
        Some([a, b, c])
    }
}
