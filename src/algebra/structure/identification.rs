//! Names of algebras: real algebras up to dimension 4, nilpotent algebras up to dimension 6, simple
//! and Heisenberg algebras, and direct sums of these.
//!
//! Parameters are determined by invariants of the action that do not change if the acting vector is
//! scaled, such as `tr^2 / det`. These invariants are rational even if the eigenvalues are
//! irrational.
//!
//! An isomorphism is returned as a witness if a rational isomorphism is found; isomorphisms of
//! simple algebras may also contain square roots. Nilpotent algebras are distinguished by the
//! dimensions of both central series and of the algebra of derivations, and by the Betti numbers.
//! These numbers distinguish all real nilpotent algebras up to dimension 6, except for the sign of
//! the parameter in four families. Quadratic forms determine this sign.

mod four;
mod nilpotent;
mod pairing;
mod polynomials;
mod sign;
mod sums;
mod witness;

use super::subspace::collected;
use super::{StructureTheory, Subspace};
use crate::algebra::{LieAlgebra, catalogue};
use affinor_tensors::linear::Row;
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Rational, Ring};
pub(super) use four::spectrum;
use witness::Images;
pub(super) use witness::{images as vector_images, sum};

/// The name of an algebra in the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// The names: one name, or several names if the invariants do not determine the algebra.
    pub names: Vec<String>,
    /// Equations for the parameters, if these are irrational.
    pub parameter: Option<String>,
    /// The images of the basis of the named algebra. They are rational, up to the factors in
    /// `under_root`.
    pub isomorphism: Option<Vec<Vec<Rational>>>,
    /// Positive numbers, one for each image. Each image must be multiplied by the square root of
    /// its number.
    pub under_root: Option<Vec<Rational>>,
    /// A positive number whose irrational square root occurs in every isomorphism. The algebras are
    /// then isomorphic over the reals, but not over the rationals. The number is present only if
    /// `isomorphism` is `None`.
    pub root: Option<Rational>,
    /// Whether the names are proved: by an isomorphism, or by invariants that are proved over the
    /// rationals.
    pub proved: bool,
}

impl Identification {
    fn by_name(names: Vec<String>) -> Self {
        Identification {
            names,
            parameter: None,
            isomorphism: None,
            under_root: None,
            root: None,
            proved: true,
        }
    }
}

type Vector = Row<Rational>;

impl StructureTheory<Rational> {
    /// The name of the algebra, or the names of the summands of a direct sum. Summands may be
    /// simple ideals, named by type and signature, Heisenberg and abelian ideals, and ideals of low
    /// dimension. Returns `None` for other algebras.
    #[doc(alias("classification", "name of an algebra"))]
    pub fn identify(&self) -> Option<Identification> {
        let _stage = stage("identification");
        let Some(found) = self.by_invariants() else { return self.as_sum() };
        let named = found.isomorphism.is_none() && found.parameter.is_none();
        match &found.names[..] {
            [name] if named => match self.isomorphism_with(name) {
                Some(images) => Some(self.with_images(name, images)),
                None => Some(Identification { root: self.needed_root(name), ..found }),
            },
            _ => Some(found),
        }
    }

    fn by_invariants(&self) -> Option<Identification> {
        match self.dimension() {
            1 => self.named("R^1", self.unit_vectors()),
            2 if self.is_abelian() => self.named("R^2", self.unit_vectors()),
            2 => {
                let y = self.derived().basis()[0].clone();
                let x = self.scaled_onto(&y, &y)?;
                self.named("aff(1)", vec![x, y])
            }
            3 => self.bianchi(),
            4..=6 if self.is_nilpotent() => self.nilpotent_by_invariants(),
            4 => self.real_of_dimension_four(),
            _ => None,
        }
    }

    fn unit_vectors(&self) -> Vec<Vector> {
        self.whole().basis().to_vec()
    }

    /// A multiple `x` of a basis vector with `[x, v] = target`.
    fn scaled_onto(&self, v: &Vector, target: &Vector) -> Option<Vector> {
        let (at, wanted) = target.first()?;
        self.unit_vectors().into_iter().find_map(|x| {
            let image = self.products.ad(&x).image(v);
            let (place, value) = image.first()?;
            (place == at).then_some(())?;
            Some(scale(&x, &(wanted.clone() * &value.recip()?)))
        })
    }

    fn named(&self, name: &str, images: Vec<Vector>) -> Option<Identification> {
        Some(match images.is_empty() {
            true => Identification::by_name(vec![name.into()]),
            false => self.with_images(name, Images { vectors: images, under_root: None }),
        })
    }

    fn with_images(&self, name: &str, images: Images) -> Identification {
        let dense = |vector: &Vector| {
            let mut all = vec![Rational::from(0); self.dimension()];
            vector.iter().for_each(|(at, value)| all[*at] = value.clone());
            all
        };
        let isomorphism = Some(images.vectors.iter().map(dense).collect());
        let under_root = images.under_root;
        Identification { isomorphism, under_root, ..Identification::by_name(vec![name.into()]) }
    }

    /// The Bianchi type, which depends on the dimension of the derived algebra.
    fn bianchi(&self) -> Option<Identification> {
        let derived = self.derived();
        match derived.dimension() {
            0 => self.named("bianchi(I)", self.unit_vectors()),
            1 if self.is_nilpotent() => {
                let pairs = [(0, 1), (0, 2), (1, 2)];
                let all = self.unit_vectors();
                let (x, y) = pairs
                    .into_iter()
                    .find(|&(x, y)| !self.products.ad(&all[x]).image(&all[y]).is_empty())?;
                let z = self.products.ad(&all[x]).image(&all[y]);
                self.named("bianchi(II)", vec![z, all[x].clone(), all[y].clone()])
            }
            1 => {
                // uses the normal form [e1, e3] = e1, with e2 in the centre
                let v = derived.basis()[0].clone();
                let e3 = scale(&self.scaled_onto(&v, &v)?, &Rational::from(-1));
                self.named("bianchi(III)", vec![v, self.centre().basis().first()?.clone(), e3])
            }
            2 => self.acting_on_the_plane(derived),
            _ => {
                let compact = self.killing().signature()? == [0, 3, 0];
                self.named(if compact { "bianchi(IX)" } else { "bianchi(VIII)" }, vec![])
            }
        }
    }

    /// The name if `ad_e` acts on the derived plane `U` with trace `t`, determinant `d` and
    /// discriminant `q = t^2 - 4 d`.
    fn acting_on_the_plane(&self, plane: &Subspace<Rational>) -> Option<Identification> {
        let outside = plane.complement().next()?;
        let e: Vector = vec![(outside, Rational::from(1))];
        let ad = self.products.ad(&e);
        let [u, v] = plane.basis() else { return None };
        let coordinates = |x: &Vector| {
            let row = plane.coordinates(&ad.image(x))?;
            let at = |i: usize| row.iter().find(|(k, _)| *k == i).map(|(_, v)| v.clone());
            Some([0, 1].map(|i| at(i).unwrap_or_else(|| Rational::from(0))))
        };
        let ([a, c], [b, f]) = (coordinates(u)?, coordinates(v)?);
        let trace = a.clone() + &f;
        let determinant = a.clone() * &f - &(b.clone() * &c);
        let four = Rational::from(4);
        let discriminant = trace.clone() * &trace - &(determinant.clone() * &four);
        let half = Rational::new(1, 2)?;
        let image = |x: &Vector, factor: &Rational| scale(&ad.image(x), factor);
        let difference = |x: &Vector, y: &Vector, factor: &Rational| {
            collected(x.iter().cloned().chain(scale(y, &-factor.clone())).collect())
        };
        if discriminant.vanishes() {
            let lambda = trace * &half;
            let unit = lambda.recip()?;
            let e3 = scale(&e, &-unit.clone());
            let scalar = b.vanishes() && c.vanishes();
            if scalar {
                return self.named("bianchi(V)", vec![u.clone(), v.clone(), e3]);
            }
            let nilpotent = |x: &Vector| difference(&image(x, &unit), x, &Rational::from(1));
            let e2 = if nilpotent(u).is_empty() { v } else { u };
            return self.named("bianchi(IV)", vec![nilpotent(e2), e2.clone(), e3]);
        }
        if discriminant.is_negative() {
            let beta = (-discriminant.clone()).sqrt().map(|root| root * &half);
            let Some(beta) = beta else {
                if trace.vanishes() {
                    // the images of e1 and e3 contain the square root of 1 / determinant
                    let images = vec![ad.image(u), u.clone(), scale(&e, &Rational::from(-1))];
                    let unit = determinant.recip()?;
                    let under_root = Some(vec![unit.clone(), Rational::from(1), unit]);
                    let images = Images { vectors: images, under_root };
                    return Some(self.with_images("bianchi(VII,h=0)", images));
                }
                let square = trace.clone() * &trace * &(-discriminant).recip()?;
                let mut found = self.named("bianchi(VII)", vec![])?;
                found.parameter = Some(format!("h^2 = {square}"));
                return Some(found);
            };
            let sign = if trace.is_negative() { -beta } else { beta };
            let unit = sign.recip()?;
            let h = trace * &half * &unit;
            let e2 = u.clone();
            let e1 = difference(&image(&e2, &unit), &e2, &h);
            return self.named(&format!("bianchi(VII,h={h})"), vec![e1, e2, scale(&e, &-unit)]);
        }
        let Some(root) = discriminant.sqrt() else {
            if trace.vanishes() {
                return self.named("bianchi(VI,h=-1)", vec![]);
            }
            let sum = (trace.clone() * &trace - &(determinant.clone() * &Rational::from(2)))
                * &determinant.recip()?;
            let mut found = self.named("bianchi(VI)", vec![])?;
            found.parameter = Some(format!("h + 1/h = {sum}"));
            return Some(found);
        };
        let (mut large, mut small) = ((trace.clone() + &root) * &half, (trace - &root) * &half);
        if small.clone().abs().to_f64() > large.clone().abs().to_f64() {
            std::mem::swap(&mut large, &mut small);
        }
        // finds an eigenvector: if `other` is the other eigenvalue, (D - other) x is an eigenvector
        // or zero
        let eigenvector = |other: &Rational| {
            let one = Rational::from(1);
            let vectors = [u, v].map(|x| difference(&image(x, &one), x, other));
            vectors.into_iter().find(|x| !x.is_empty())
        };
        let unit = large.recip()?;
        let h = small.clone() * &unit;
        let images = vec![eigenvector(&small)?, eigenvector(&large)?, scale(&e, &-unit)];
        self.named(&format!("bianchi(VI,h={h})"), images)
    }

    /// The names of nilpotent algebras with the same invariants.
    fn nilpotent_by_invariants(&self) -> Option<Identification> {
        let n = self.dimension();
        let (own, proved) = self.fingerprint();
        let mut names = vec![];
        for small in 1..=n {
            for name in nilpotent_names(small) {
                let full = if small < n { format!("{name}+R^{}", n - small) } else { name };
                if StructureTheory::new(catalogued(&full)?).fingerprint().0 == own {
                    names.push(full);
                }
            }
        }
        // determines the sign of e by a quadratic form, because e = 1 and e = -1 have the same
        // invariants
        let positive = match &names[..] {
            [first, _] => self.has_positive_parameter(first),
            _ => None,
        };
        if let Some(positive) = positive {
            names.retain(|name| name.ends_with("e=1)") == positive);
        }
        (!names.is_empty()).then(|| Identification { proved, ..Identification::by_name(names) })
    }

    /// The fingerprint of the algebra, and whether all of its dimensions are proved.
    fn fingerprint(&self) -> (Fingerprint, bool) {
        let dimensions = |series: &[Subspace<Rational>]| -> Vec<usize> {
            series.iter().map(Subspace::dimension).collect()
        };
        let (derivations, betti) = (self.derivation_dimension(), self.betti_numbers());
        let proved = derivations.is_none_or(|all| all.proved)
            && betti.as_ref().is_none_or(|(_, proved)| *proved);
        let fingerprint = (
            dimensions(self.lower_central_series()),
            dimensions(&self.upper_central_series()),
            derivations.map(|all| all.dimension),
            betti.map(|(numbers, _)| numbers),
        );
        (fingerprint, proved)
    }
}

/// The dimensions of the lower and the upper central series, the dimension of the derivations, and
/// the Betti numbers.
type Fingerprint = (Vec<usize>, Vec<usize>, Option<usize>, Option<Vec<u64>>);

/// The nilpotent algebras of a dimension that are not a direct sum with a line. In de Graaf's
/// family 6,22, the algebra with `e = 1` is a sum of two Heisenberg algebras.
fn nilpotent_names(dimension: usize) -> Vec<String> {
    if dimension == 1 {
        return vec!["R^1".into()];
    }
    let rows = catalogue::names(dimension).into_iter().filter(|name| name.starts_with("degraaf"));
    let valued =
        |name: String| match ["6,19)", "6,21)", "6,22)", "6,24)"].iter().any(|k| name.ends_with(k))
        {
            true => ["0", "1", "-1"].map(|e| name.replace(')', &format!(",e={e})"))).to_vec(),
            false => vec![name],
        };
    rows.flat_map(valued).collect()
}

/// The direct sum of algebras with names of the catalogue.
fn catalogued(names: &str) -> Option<LieAlgebra<Rational>> {
    let parts = names.split('+').map(catalogue::algebra::<Rational>);
    let parts = parts.collect::<Result<Vec<_>, _>>().ok()?;
    parts.into_iter().map(Ok).reduce(|a, b| a?.direct_sum(&b?))?.ok()
}

pub(super) fn scale<K: Copy>(vector: &[(K, Rational)], factor: &Rational) -> Vec<(K, Rational)> {
    vector.iter().map(|(at, value)| (*at, value.clone() * factor)).collect()
}
