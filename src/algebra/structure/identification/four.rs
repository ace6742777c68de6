//! Names of the solvable real algebras of dimension 4. They are determined by the action on the
//! nilradical.
//!
//! G. M. Mubarakzyanov, *Izv. Vyssh. Uchebn. Zaved. Mat.* 32 (1963) 114-123; the numbers are those
//! of Patera, Sharp, Winternitz and Zassenhaus. For irrational parameters, the answer contains
//! equations with rational coefficients.

use super::Identification;
use crate::algebra::irreducible_factors;
use crate::algebra::structure::{StructureTheory, Subspace};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Ring};
use num_rational::BigRational;
use polycore::Uni;

/// Eigenvalues of a real matrix.
pub(in crate::algebra::structure) struct Spectrum {
    /// The rational eigenvalues, with multiplicity.
    pub rational: Vec<Rational>,
    /// Whether there are irrational real eigenvalues.
    pub irrational: bool,
    /// The real part and the squared imaginary part of a pair of complex eigenvalues; `Some(None)`
    /// if these are irrational.
    pub complex: Option<Option<(Rational, Rational)>>,
}

impl StructureTheory<Rational> {
    /// The name of a real algebra of dimension 4 that is solvable, but not nilpotent.
    pub(super) fn real_of_dimension_four(&self) -> Option<Identification> {
        if !self.is_solvable() {
            let [plus, ..] = self.killing().signature()?;
            return by_name(if plus == 0 { "bianchi(IX)+R^1" } else { "bianchi(VIII)+R^1" }.into());
        }
        let nilradical = self.nilradical();
        let outside = nilradical.complement().next()?;
        if nilradical.dimension() == 2 {
            // at least one of e, f, e + f acts with two different eigenvalues
            let spectra = self.action_of_complement(&nilradical)?;
            let split = spectra.iter().any(|(_, s)| s.irrational || different(&s.rational));
            let complex = spectra.iter().any(|(_, s)| s.complex.is_some());
            return match (split, complex) {
                (true, false) => by_name("aff(1)+aff(1)".into()),
                (false, true) => by_name("patera(4,12)".into()),
                _ => None,
            };
        }
        let inside = self.subalgebra(&nilradical).ok()?;
        if inside.is_abelian() {
            let action = self.action(&[(outside, Rational::from(1))], &nilradical, None)?;
            return on_space(&action);
        }
        let centre = nilradical.within(&inside.centre());
        let action = self.action(&[(outside, Rational::from(1))], &nilradical, Some(&centre))?;
        on_heisenberg(&action)
    }

    /// The matrix of `ad_x` on the subspace `on`, or on its quotient by the subspace `modulo`.
    pub(super) fn action(
        &self,
        x: &[(usize, Rational)],
        on: &Subspace<Rational>,
        modulo: Option<&Subspace<Rational>>,
    ) -> Option<Matrix<Rational>> {
        let ad = self.products.ad(x);
        // the first vectors of this basis span a complement of `modulo`
        let zero = Subspace::zero(self.dimension());
        let modulo = modulo.unwrap_or(&zero);
        let mut span = modulo.clone();
        let basis: Vec<_> = on.basis().iter().filter(|row| span.add((*row).clone())).collect();
        let all: Vec<_> = basis.iter().copied().chain(modulo.basis()).cloned().collect();
        let matrix = Matrix::from_rows(self.dimension(), all).ok()?.transpose();
        let columns = basis.iter().map(|row| {
            let mut image = vec![Rational::from(0); self.dimension()];
            ad.image(row).into_iter().for_each(|(at, value)| image[at] = value);
            matrix.solve(&image).ok()?.map(|solution| solution[..basis.len()].to_vec())
        });
        let columns = columns.collect::<Option<Vec<Vec<Rational>>>>()?;
        Some(Matrix::from_dense(&columns).ok()?.transpose())
    }

    fn action_of_complement(
        &self,
        plane: &Subspace<Rational>,
    ) -> Option<Vec<(Matrix<Rational>, Spectrum)>> {
        let outside: Vec<usize> = plane.complement().collect();
        let [e, f] = outside[..] else { return None };
        let one = || Rational::from(1);
        let trials = [vec![(e, one())], vec![(f, one())], vec![(e, one()), (f, one())]];
        let each = trials.iter().map(|x| {
            let matrix = self.action(x, plane, None)?;
            let spectrum = spectrum(&matrix)?;
            Some((matrix, spectrum))
        });
        each.collect()
    }
}

fn by_name(name: String) -> Option<Identification> {
    Some(Identification::by_name(vec![name]))
}

/// A name whose parameters are irrational, with equations for these parameters.
fn open(name: &str, equations: String) -> Option<Identification> {
    let parameter = Some(equations);
    Some(Identification { parameter, ..Identification::by_name(vec![name.into()]) })
}

/// The text for parameters without known equations.
fn unknown() -> String {
    "its parameters are not rational".into()
}

fn squared(value: &Rational) -> Rational {
    value.clone() * value
}

fn trace(matrix: &Matrix<Rational>) -> Rational {
    (0..matrix.rows()).fold(Rational::from(0), |sum, i| sum + &matrix.get(i, i))
}

/// The rational number `tr D^2 / (x y) = x/y + y/x` of an action `D` with exactly two nonzero
/// eigenvalues `x`, `y`.
fn ratios(action: &Matrix<Rational>) -> Option<Rational> {
    let squares = trace(&action.mul(action).ok()?);
    let product = (squared(&trace(action)) - &squares) * &Rational::new(1, 2)?;
    Some(squares * &product.recip()?)
}

fn different(values: &[Rational]) -> bool {
    values.windows(2).any(|two| two[0] != two[1])
}

/// The eigenvalues, from the factors of the characteristic polynomial. The recursion of Faddeev and
/// Leverrier computes this polynomial.
pub(in crate::algebra::structure) fn spectrum(matrix: &Matrix<Rational>) -> Option<Spectrum> {
    let n = matrix.rows();
    let mut coefficients = vec![Rational::from(1)];
    let mut power = Matrix::identity(n);
    for k in 1..=n {
        let product = matrix.mul(&power).ok()?;
        let trace = (0..n).fold(Rational::from(0), |sum, i| sum + &product.get(i, i));
        let c = -(trace * &Rational::new(1, k as i64)?);
        power = product.add(&Matrix::diagonal(std::iter::repeat_n(c.clone(), n))).ok()?;
        coefficients.push(c);
    }
    coefficients.reverse();
    let polynomial = Uni::new(coefficients.iter().map(BigRational::from).collect());
    let mut found = Spectrum { rational: vec![], irrational: false, complex: None };
    for (factor, multiplicity) in irreducible_factors(&polynomial) {
        let real = factor.isolate().len();
        let coefficient = |at: usize| Rational::from(factor.0[at].clone());
        match (factor.deg(), real) {
            (1, _) => {
                let root = -coefficient(0);
                found.rational.extend(std::iter::repeat_n(root, multiplicity as usize));
            }
            (2, 0) => {
                let real = -(coefficient(1) * &Rational::new(1, 2)?);
                let square = coefficient(0) - &(real.clone() * &real);
                found.complex = Some(Some((real, square)));
            }
            (degree, real) => {
                found.irrational |= real > 0;
                if real < degree {
                    found.complex = Some(None);
                }
            }
        }
    }
    Some(found)
}

/// The name if the nilradical is abelian of dimension 3.
fn on_space(action: &Matrix<Rational>) -> Option<Identification> {
    let Spectrum { rational, irrational, complex } = spectrum(action)?;
    if let Some(pair) = complex {
        let Some((real, square)) = pair else { return open("patera(4,6)", unknown()) };
        let [simple] = &rational[..] else { return None };
        let Some(unit) = square.sqrt().and_then(|root| root.recip()) else {
            let unit = square.recip()?;
            return match (simple.recip(), real.vanishes()) {
                (None, true) => by_name("bianchi(VII,h=0)+R^1".into()),
                (None, false) => {
                    open("bianchi(VII)+R^1", format!("h^2 = {}", squared(&real) * &unit))
                }
                (Some(inverse), zero) => {
                    let (a, ratio) = (squared(simple) * &unit, real * &inverse);
                    let b = if zero { "b = 0".into() } else { format!("b/a = {ratio}") };
                    open("patera(4,6)", format!("a^2 = {a}, {b}"))
                }
            };
        };
        let (mut a, mut b) = (simple.clone() * &unit, real * &unit);
        if b.is_negative() || (b.vanishes() && a.is_negative()) {
            (a, b) = (-a, -b);
        }
        return by_name(match a.vanishes() {
            true => format!("bianchi(VII,h={b})+R^1"),
            false => format!("patera(4,6,a={a},b={b})"),
        });
    }
    if irrational {
        return match rational.first() {
            Some(zero) if zero.vanishes() && trace(action).vanishes() => {
                by_name("bianchi(VI,h=-1)+R^1".into())
            }
            Some(zero) if zero.vanishes() => {
                open("bianchi(VI)+R^1", format!("h + 1/h = {}", ratios(action)?))
            }
            _ => open("patera(4,5)", unknown()),
        };
    }
    let shifted = |root: &Rational| {
        let shift = Matrix::diagonal(std::iter::repeat_n(-root.clone(), 3));
        action.add(&shift).ok()?.rank().ok()
    };
    let count = |root: &Rational| rational.iter().filter(|other| *other == root).count();
    for root in &rational {
        let (size, blocks) = (count(root), 3 - shifted(root)?);
        let other = rational.iter().find(|other| *other != root);
        match (size, blocks, other) {
            (3, 1, _) => return by_name("patera(4,4)".into()),
            // the action has a Jordan block of size 2 and another eigenvalue, which may equal the
            // eigenvalue of the block
            (3, 2, _) => return by_name("patera(4,2,a=1)".into()),
            (2, 1, Some(other)) => {
                return by_name(match (root.recip(), other.vanishes()) {
                    (None, _) => "patera(4,3)".into(),
                    (_, true) => "bianchi(IV)+R^1".into(),
                    (Some(unit), _) => format!("patera(4,2,a={})", other.clone() * &unit),
                });
            }
            _ => {}
        }
    }
    diagonal(&rational)
}

/// The name if the action is diagonal. The eigenvalues are sorted, and divided by an eigenvalue of
/// maximal size.
fn diagonal(values: &[Rational]) -> Option<Identification> {
    let size = |value: &Rational| value.clone().abs().to_f64();
    let largest = values.iter().map(size).fold(0.0, f64::max);
    let mut best: Option<Vec<Rational>> = None;
    for (at, value) in values.iter().enumerate().filter(|(_, value)| size(value) >= largest) {
        let unit = value.recip()?;
        let others = values.iter().enumerate().filter(|(other, _)| *other != at);
        let mut others: Vec<Rational> = others.map(|(_, v)| v.clone() * &unit).collect();
        others.sort_by(|x, y| x.to_f64().total_cmp(&y.to_f64()));
        let larger = best.as_ref().is_none_or(|best| {
            let key = |v: &[Rational]| v.iter().map(Rational::to_f64).collect::<Vec<_>>();
            key(&others) > key(best)
        });
        if larger {
            best = Some(others);
        }
    }
    let [a, b] = &best?[..] else { return None };
    let one = Rational::from(1);
    by_name(match (a.vanishes(), b.vanishes()) {
        (true, true) => "aff(1)+R^2".into(),
        (true, false) | (false, true) => {
            let h = if a.vanishes() { b } else { a };
            if *h == one { "bianchi(V)+R^1".into() } else { format!("bianchi(VI,h={h})+R^1") }
        }
        _ => format!("patera(4,5,a={a},b={b})"),
    })
}

/// The name if the nilradical is the Heisenberg algebra. The parameter `action` is the action on
/// the quotient of the nilradical by its centre.
fn on_heisenberg(action: &Matrix<Rational>) -> Option<Identification> {
    let Spectrum { rational, irrational, complex } = spectrum(action)?;
    if trace(action).vanishes() {
        let name = if complex.is_some() { "patera(4,10)" } else { "patera(4,8)" };
        return by_name(name.into());
    }
    if let Some(pair) = complex {
        let (real, square) = pair?;
        let Some(unit) = square.sqrt().and_then(|root| root.recip()) else {
            return open("patera(4,11)", format!("a^2 = {}", squared(&real) * &square.recip()?));
        };
        return by_name(format!("patera(4,11,a={})", (real * &unit).abs()));
    }
    if irrational {
        return open("patera(4,9)", format!("b + 1/b = {}", ratios(action)?));
    }
    let [x, y] = &rational[..] else { return None };
    if x == y {
        let scalar = action.get(0, 1).vanishes() && action.get(1, 0).vanishes();
        return by_name(if scalar { "patera(4,9,b=1)" } else { "patera(4,7)" }.into());
    }
    let size = |value: &Rational| value.clone().abs().to_f64();
    let (large, small) = if size(x) > size(y) { (x, y) } else { (y, x) };
    by_name(format!("patera(4,9,b={})", small.clone() * &large.recip()?))
}
