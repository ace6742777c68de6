//! Orthonormal frames and null tetrads of a spacetime of dimension 4, the Weyl scalars of Newman and
//! Penrose, and the electric and magnetic parts of the Weyl tensor.
//!
//! Let the signature be `(3,1)`; for `(1,3)`, all formulas refer to `-g` and the same curvature
//! `R^i_jkl`. Of an orthonormal frame `e1, e2, e3, e4` with the timelike vector `e1`, the null tetrad
//! is
//!
//! ```text
//! l = (e1 + e2)/sqrt(2),   n = (e1 - e2)/sqrt(2),   m = (e3 + i e4)/sqrt(2)
//! g(l,n) = -1,   g(m,m*) = 1
//! ```
//!
//! and the scalars of the Weyl tensor `W_ijkl` are (H. Stephani and others, *Exact Solutions of
//! Einstein's Field Equations* (2003), (3.59) and (4.19))
//!
//! ```text
//! Psi0 = W(l,m,l,m),  Psi1 = W(l,n,l,m),  Psi2 = W(l,m,m*,n),  Psi3 = W(l,n,m*,n),  Psi4 = W(n,m*,n,m*)
//! I = Psi0 Psi4 - 4 Psi1 Psi3 + 3 Psi2^2
//! J = Psi0 Psi2 Psi4 + 2 Psi1 Psi2 Psi3 - Psi2^3 - Psi0 Psi3^2 - Psi1^2 Psi4
//! ```
//!
//! The scalars have the same values in the other signature, where `g(l,n) = 1`: there the original
//! definitions (E. Newman, R. Penrose, *J. Math. Phys.* 3 (1962) 566-578) have the opposite sign.
//!
//! The vectors of a frame are stored without their norms, so that no component contains a root. A root
//! is taken only of the product of the norms that belongs to a component.

use crate::Error;
use crate::algebra::frame::expect_slots;
use crate::algebra::{BasisChange, Complex};
use crate::geometry::connection::Connection;
use crate::geometry::isometry::{is_positive_at_sample, signature_at_sample};
use crate::geometry::metric::Metric;
use crate::geometry::roots::Roots;
use affinor_tensors::linear::Matrix;
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Down, Field, Ring, Symbolic, Tensor, Up};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// An orthonormal frame of a spacetime, or two null vectors and two orthonormal ones.
///
/// ```
/// use affinor::geometry::null_tetrad::NullTetrad;
/// use affinor::tensors::scalar::PositiveFactors;
/// use affinor::{Metric, Symbolic};
/// let metric = Metric::diagonal([-1, 1, 1, 1].map(Symbolic::from))?;
/// let tetrad = NullTetrad::new(&metric, &[], PositiveFactors::default())?;
/// assert!(tetrad.is_orthonormal());
/// assert_eq!(tetrad.vectors()[1].get(&[1]), Symbolic::from(1));
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Newman-Penrose", "vierbein", "observer"))]
#[derive(Clone, Debug)]
pub struct NullTetrad {
    /// Orthogonal vectors, not normalized; or `l`, `n` and two vectors orthogonal to both.
    vectors: Vec<Tensor<Symbolic>>,
    /// The absolute values of the norms. They are 1 for `l` and `n`.
    norms: Vec<Symbolic>,
    is_orthonormal: bool,
    /// The metric of signature `(3,1)`.
    metric: Tensor<Symbolic>,
    /// The factor 1 or -1 of this metric.
    sign: Symbolic,
    roots: Roots,
}

/// The Weyl tensor of a spacetime in a null tetrad.
#[derive(Clone, Debug, PartialEq)]
pub struct WeylScalars {
    /// `Psi0, Psi1, Psi2, Psi3, Psi4`.
    pub psi: [Complex<Symbolic>; 5],
    /// The invariant `I`.
    pub quadratic: Complex<Symbolic>,
    /// The invariant `J`.
    pub cubic: Complex<Symbolic>,
    /// The electric and the magnetic part relative to `e1`; `None` unless the frame is orthonormal.
    ///
    /// `E_ij = W(e_i,e1,e_j,e1)` and `B_ij = 1/2 eps_ikl W(e_k,e_l,e1,e_j)` have the indices 2, 3, 4
    /// of the frame, stored from 0, and `eps_234 = 1`.
    pub parts: Option<[Vec<Vec<Symbolic>>; 2]>,
}

impl NullTetrad {
    /// The frame that begins with given vectors, each with the slot `^i`, and is completed by the
    /// vectors of the basis, in their order. It is orthonormalized one by one.
    ///
    /// - If the first vector is null, it is `l`. The second vector gives `n`: it is the null vector of
    ///   the plane of both with `g(l,n) = -1`. The others give `e3` and `e4`.
    /// - Otherwise, the first vector is timelike.
    ///
    /// Without given vectors, the frame begins with the first null vector of the basis, and if there
    /// is none with the first timelike one. Unless all vectors are given, the last one has the sign for
    /// which the frame has the orientation of the basis. Roots are taken under the assumption that their
    /// arguments and the variables in them are positive.
    ///
    /// # Errors
    /// [`Error::Unsupported`] unless the metric is Lorentzian in dimension 4, or if no frame is found;
    /// [`Error::Shape`].
    pub fn new(
        metric: &Metric<Symbolic>,
        given: &[Tensor<Symbolic>],
        positive: PositiveFactors,
    ) -> Result<Self, Error> {
        let _stage = stage("tetrad");
        let n = metric.components().dimension();
        let refuse = |message: &str| Err(Error::Unsupported(message.into()));
        if n != 4 {
            return refuse(&format!("a null tetrad needs dimension 4, but this is dimension {n}"));
        }
        if given.len() > n {
            return refuse(&format!("a frame has 4 vectors, but {} are given", given.len()));
        }
        for vector in given {
            expect_slots("the vector", vector, n, &[Up])?;
        }
        let sign = match signature_at_sample(metric.components(), positive.factors()) {
            Some([3, 1]) => Symbolic::one(),
            Some([1, 3]) => -Symbolic::one(),
            Some([p, q]) => {
                return refuse(&format!(
                    "a null tetrad needs a Lorentzian metric, but the signature is ({p},{q})"
                ));
            }
            None => {
                return refuse(
                    "the signature of the metric is unknown: no sample point is rational",
                );
            }
        };
        let mut tetrad = NullTetrad {
            vectors: vec![],
            norms: vec![],
            is_orthonormal: true,
            metric: metric.components().scale(&sign),
            sign,
            roots: Roots::new(positive),
        };
        let unit = |i: usize| {
            let entries: Vec<Symbolic> =
                (0..n).map(|j| if i == j { Symbolic::one() } else { Symbolic::zero() }).collect();
            Tensor::vector(&entries, Up)
        };
        let basis: Vec<_> = (0..n).map(unit).collect();
        let first = match given.first() {
            Some(first) => first.clone(),
            None => match tetrad.first_of(&basis) {
                Some(first) => first,
                None => return refuse("no vector of the basis is timelike or null: give vectors"),
            },
        };
        let others = given.get(1..).unwrap_or_default();
        tetrad.begin(first, others, &basis)?;
        let is_orthogonal = |vector: &&Tensor<Symbolic>| {
            given.iter().all(|own| tetrad.product(own, vector).is_zero())
        };
        let (near, far): (Vec<_>, Vec<_>) = basis.iter().partition(is_orthogonal);
        let completion: Vec<_> = near.into_iter().chain(far).cloned().collect();
        for (at, vector) in others.iter().chain(&completion).enumerate() {
            checkpoint();
            let is_given = at < others.len();
            if tetrad.vectors.len() == n {
                break;
            }
            // the second vector of a null pair is used by `begin`
            if is_given && at == 0 && !tetrad.is_orthonormal {
                continue;
            }
            let mut rest = tetrad.orthogonal_part(vector);
            let last = rest.components().last().and_then(|(_, value)| value.recip());
            if let Some(inverse) = last.filter(|_| !is_given) {
                rest = rest.scale(&inverse);
            }
            let norm = tetrad.product(&rest, &rest);
            if rest.is_empty() && is_given {
                return refuse("the vectors are linearly dependent");
            }
            if norm.is_zero() || !tetrad.is_positive(&norm) {
                if is_given {
                    return refuse(&format!(
                        "a vector orthogonal to the ones before it is not spacelike: its norm is {norm}"
                    ));
                }
                continue;
            }
            tetrad.vectors.push(rest);
            tetrad.norms.push(norm);
        }
        if tetrad.vectors.len() < n {
            return refuse("the vectors of the basis do not complete the frame: give more vectors");
        }
        tetrad.roots.sample(&tetrad.norms);
        tetrad.take_out_squares();
        if given.len() < n {
            tetrad.orient()?;
        }
        Ok(tetrad)
    }

    /// Divides each vector whose norm is a square by its length.
    fn take_out_squares(&mut self) {
        for (vector, norm) in self.vectors.iter_mut().zip(&mut self.norms) {
            let root = norm.root_up_to_factor().map(|root| self.roots.positive(root));
            let Some(inverse) = root.and_then(|root| root.recip()) else { continue };
            *vector = vector.scale(&inverse);
            *norm = norm.clone() * &(inverse.clone() * &inverse);
        }
    }

    /// Gives the last vector the sign for which `e1, e2, e3, e4` have the orientation of the basis.
    fn orient(&mut self) -> Result<(), Error> {
        let rows: Vec<Vec<Symbolic>> =
            self.vectors.iter().map(|v| (0..4).map(|i| v.get(&[i])).collect()).collect();
        let determinant = Matrix::from_dense(&rows)?.determinant()?;
        // l ^ n = -e1 ^ e2
        let determinant = if self.is_orthonormal { determinant } else { -determinant };
        if self.roots.positive(determinant.clone()) != determinant {
            let last = &mut self.vectors[3];
            *last = last.scale(&-Symbolic::one());
        }
        Ok(())
    }

    /// The first null vector of the basis, or the first one that may be timelike. One that is
    /// timelike at all samples has precedence over one whose sign varies.
    fn first_of(&self, basis: &[Tensor<Symbolic>]) -> Option<Tensor<Symbolic>> {
        let norms: Vec<_> = basis.iter().map(|v| self.product(v, v)).collect();
        let null = norms.iter().position(Zero::is_zero);
        let always = || norms.iter().position(|norm| !self.is_positive(norm));
        let somewhere = || norms.iter().position(|norm| self.is_positive(&-norm.clone()));
        null.or_else(always).or_else(somewhere).map(|at| basis[at].clone())
    }

    /// Sets the first vector, or the first two if the first one is null.
    fn begin(
        &mut self,
        first: Tensor<Symbolic>,
        others: &[Tensor<Symbolic>],
        basis: &[Tensor<Symbolic>],
    ) -> Result<(), Error> {
        let refuse = |message: String| Err(Error::Unsupported(message));
        let norm = self.product(&first, &first);
        if !norm.is_zero() {
            let positive = -norm;
            if !self.is_positive(&positive) {
                let norm = self.sign.clone() * &-positive;
                return refuse(format!(
                    "the first vector is not timelike or null: its norm is {norm}"
                ));
            }
            self.vectors.push(first);
            self.norms.push(positive);
            return Ok(());
        }
        let candidates = if others.is_empty() { basis } else { &others[..1] };
        let partner = candidates.iter().find_map(|vector| {
            let across = self.product(&first, vector).recip()?;
            Some((vector, across))
        });
        let Some((vector, across)) = partner else {
            return refuse(
                "the second vector is orthogonal to the first one, which is null".into(),
            );
        };
        // n = -(w - g(w,w)/(2 g(l,w)) l)/g(l,w)
        let half = Symbolic::from(2).recip().unwrap_or_default();
        let along = self.product(vector, vector) * &across * &half;
        let second = (vector - &first.scale(&along)).scale(&-across);
        self.is_orthonormal = false;
        self.vectors = vec![first, second];
        self.norms = vec![Symbolic::one(), Symbolic::one()];
        Ok(())
    }

    /// The part of a vector that is orthogonal to the vectors so far.
    fn orthogonal_part(&self, vector: &Tensor<Symbolic>) -> Tensor<Symbolic> {
        let mut rest = vector.clone();
        let mut from = 0;
        if !self.is_orthonormal {
            let [l, n] = [&self.vectors[0], &self.vectors[1]];
            rest = &rest + &l.scale(&self.product(vector, n));
            rest = &rest + &n.scale(&self.product(vector, l));
            from = 2;
        }
        for (at, (own, norm)) in self.vectors.iter().zip(&self.norms).enumerate().skip(from) {
            let share = self.product(&rest, own) * &norm.recip().unwrap_or_default();
            // the first vector of an orthonormal frame is timelike
            let share = if at == 0 { share } else { -share };
            rest = &rest + &own.scale(&share);
        }
        rest
    }

    fn product(&self, x: &Tensor<Symbolic>, y: &Tensor<Symbolic>) -> Symbolic {
        let terms = self.metric.components().map(|(at, g)| {
            let (x, y) = (x.get(&[at[0]]), y.get(&[at[1]]));
            if x.is_zero() || y.is_zero() { Symbolic::zero() } else { x * g * &y }
        });
        terms.fold(Symbolic::zero(), |sum, term| sum + &term)
    }

    /// Whether a function is positive at a sample point.
    fn is_positive(&self, function: &Symbolic) -> bool {
        is_positive_at_sample(function, self.roots.given())
    }

    /// The numbers of positive and negative squares of the metric, where the given functions are
    /// positive: `[3, 1]` or `[1, 3]`.
    pub fn signature(&self) -> [usize; 2] {
        if self.sign.is_one() { [3, 1] } else { [1, 3] }
    }

    /// Whether the frame is orthonormal. Otherwise, its first two vectors are `l` and `n`.
    pub fn is_orthonormal(&self) -> bool {
        self.is_orthonormal
    }

    /// The vectors before they are divided by their lengths, slots `^i`: `e1, e2, e3, e4`, or
    /// `l, n, e3, e4`.
    pub fn vectors(&self) -> &[Tensor<Symbolic>] {
        &self.vectors
    }

    /// The squares of the lengths of the [`vectors`](Self::vectors): the absolute values of `g(v,v)`,
    /// and 1 for `l` and `n`.
    pub fn norms(&self) -> &[Symbolic] {
        &self.norms
    }

    /// The functions that are assumed to be positive.
    pub fn assumed(&self) -> Vec<Symbolic> {
        self.roots.assumed()
    }

    /// The Weyl scalars of a Levi-Civita connection in this tetrad.
    ///
    /// ```
    /// use affinor::geometry::null_tetrad::NullTetrad;
    /// use affinor::tensors::scalar::PositiveFactors;
    /// use affinor::{Chart, Connection, Down, Metric, Symbolic, Tensor};
    /// // a plane gravitational wave: 2 du dv + x y du^2 + dx^2 + dy^2
    /// let chart = Chart::new(["u", "v", "x", "y"])?;
    /// let [one, h]: [Symbolic; 2] = ["1".parse()?, "x*y".parse()?];
    /// let entries = [([0, 0], h), ([0, 1], one.clone()), ([1, 0], one.clone()), ([2, 2], one.clone()), ([3, 3], one)];
    /// let metric = Metric::new(chart.labels(), Tensor::from_components(4, &[Down, Down], entries)?)?;
    /// let wave = Connection::levi_civita(&chart.coordinate_frame()?, &metric)?;
    /// let mut tetrad = NullTetrad::new(&metric, &[], PositiveFactors::default())?;
    /// let scalars = tetrad.weyl_scalars(&wave, &metric)?;
    /// // e4 = -d_y, because the frame has the orientation of the basis
    /// assert_eq!(scalars.psi[4].im.to_string(), "-1/2");
    /// assert_eq!(scalars.psi[2].re.to_string(), "0");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unsupported`] if a component needs a root of unknown sign; those of
    /// [`Connection::weyl`].
    pub fn weyl_scalars(
        &mut self,
        connection: &Connection<Symbolic>,
        metric: &Metric<Symbolic>,
    ) -> Result<WeylScalars, Error> {
        let lowered = connection.weyl(metric)?.lower(0, metric.components())?.scale(&self.sign);
        let columns = self.vectors.iter().enumerate().flat_map(|(a, vector)| {
            vector.components().map(move |(at, value)| ([at[0], a], value.clone()))
        });
        let change = BasisChange::new(Tensor::from_components(4, &[Up, Down], columns)?)?;
        let bare = change.apply(&lowered)?;
        let mut roots: BTreeMap<u8, Symbolic> = BTreeMap::new();
        let mut entries = vec![];
        for (at, value) in bare.components() {
            checkpoint();
            let odd = at.iter().fold(0u8, |odd, a| odd ^ (1 << a));
            let square = (0..4).fold(Symbolic::one(), |product, a| {
                let pairs = at.iter().filter(|b| **b == a).count() / 2;
                product * &num_traits::pow(self.norms[a].clone(), pairs)
            });
            if let std::collections::btree_map::Entry::Vacant(place) = roots.entry(odd) {
                let odd: Vec<usize> = (0..4).filter(|a| odd >> a & 1 == 1).collect();
                place.insert(self.root_of_norms(&odd)?);
            }
            let length = square * &roots[&odd];
            entries.push((at.to_vec(), value.clone() * &length.recip().unwrap_or_default()));
        }
        let weyl = Tensor::from_components(4, &[Down; 4], entries)?;
        self.scalars(&weyl)
    }

    /// The root of the product of different norms. The root of a quotient of two norms is preferred,
    /// because their common factors cancel.
    fn root_of_norms(&mut self, at: &[usize]) -> Result<Symbolic, Error> {
        let pairings: &[[usize; 4]] = match at.len() {
            2 => &[[0, 1, 0, 0]],
            4 => &[[0, 1, 2, 3], [0, 2, 1, 3], [0, 3, 1, 2]],
            _ => &[],
        };
        for pairing in pairings {
            let mut roots = self.roots.clone();
            let mut product = Some(Symbolic::one());
            for pair in pairing[..at.len()].chunks(2) {
                let [a, b] = [pair[0], pair[1]].map(|place| &self.norms[at[place]]);
                let quotient = a.clone() * &b.recip().unwrap_or_default();
                let root = roots.root(&quotient).ok();
                product = product.zip(root).map(|(product, root)| product * &root * b);
            }
            if let Some(product) = product {
                self.roots = roots;
                return Ok(product);
            }
        }
        let norms = at.iter().map(|a| &self.norms[*a]);
        let product = norms.fold(Symbolic::one(), |product, norm| product * norm);
        self.roots.root(&product)
    }

    /// The scalars of the Weyl tensor with these components in the normalized frame.
    fn scalars(&mut self, weyl: &Tensor<Symbolic>) -> Result<WeylScalars, Error> {
        let real = |entries: [i64; 4]| entries.map(|re| [re, 0]);
        let (m, conjugate) = ([[0, 0], [0, 0], [1, 0], [0, 1]], [[0, 0], [0, 0], [1, 0], [0, -1]]);
        let ([l, n], [even, odd]) = match self.is_orthonormal {
            true => ([[1, 1, 0, 0], [1, -1, 0, 0]], [share(4), share(4)]),
            false => {
                let half = share(2) * &self.roots.root(&Symbolic::from(2))?;
                ([[1, 0, 0, 0], [0, 1, 0, 0]], [share(2), half])
            }
        };
        let (l, n) = (real(l), real(n));
        let psi = [
            scaled(&value(weyl, [&l, &m, &l, &m]), &even),
            scaled(&value(weyl, [&l, &n, &l, &m]), &odd),
            scaled(&value(weyl, [&l, &m, &conjugate, &n]), &even),
            scaled(&value(weyl, [&l, &n, &conjugate, &n]), &odd),
            scaled(&value(weyl, [&n, &conjugate, &n, &conjugate]), &even),
        ];
        let [p0, p1, p2, p3, p4] = &psi;
        let product = |factors: &[&Complex<Symbolic>], by: i64| {
            let one = Complex::real(Symbolic::from(by));
            factors.iter().fold(one, |product, factor| times(&product, factor))
        };
        let quadratic = sum([product(&[p0, p4], 1), product(&[p1, p3], -4), product(&[p2, p2], 3)]);
        let cubic = sum([
            product(&[p0, p2, p4], 1),
            product(&[p1, p2, p3], 2),
            product(&[p2, p2, p2], -1),
            product(&[p0, p3, p3], -1),
            product(&[p1, p1, p4], -1),
        ]);
        let parts = self.is_orthonormal.then(|| {
            let entry = |i: usize, j: usize| weyl.get(&[i + 1, 0, j + 1, 0]);
            let dual = |i: usize, j: usize| weyl.get(&[(i + 1) % 3 + 1, (i + 2) % 3 + 1, 0, j + 1]);
            let matrix = |entry: &dyn Fn(usize, usize) -> Symbolic| {
                (0..3).map(|i| (0..3).map(|j| entry(i, j)).collect()).collect()
            };
            [matrix(&entry), matrix(&dual)]
        });
        Ok(WeylScalars { psi, quadratic, cubic, parts })
    }
}

fn share(n: i64) -> Symbolic {
    Symbolic::from_i64(n).recip().unwrap_or_default()
}

fn times(a: &Complex<Symbolic>, b: &Complex<Symbolic>) -> Complex<Symbolic> {
    Complex {
        re: a.re.clone() * &b.re - &(a.im.clone() * &b.im),
        im: a.re.clone() * &b.im + &(a.im.clone() * &b.re),
    }
}

fn sum(terms: impl IntoIterator<Item = Complex<Symbolic>>) -> Complex<Symbolic> {
    let zero = Complex::real(Symbolic::zero());
    terms.into_iter().fold(zero, |a, b| Complex { re: a.re + &b.re, im: a.im + &b.im })
}

fn scaled(a: &Complex<Symbolic>, by: &Symbolic) -> Complex<Symbolic> {
    Complex { re: a.re.clone() * by, im: a.im.clone() * by }
}

/// A vector with complex integer components `[re, im]`.
type GaussVector = [[i64; 2]; 4];

/// The value of a tensor on four vectors.
fn value(tensor: &Tensor<Symbolic>, vectors: [&GaussVector; 4]) -> Complex<Symbolic> {
    sum(tensor.components().filter_map(|(at, value)| {
        let [re, im] = (0..4).fold([1, 0], |[a, b], slot| {
            let [x, y] = vectors[slot][at[slot]];
            [a * x - b * y, a * y + b * x]
        });
        (re != 0 || im != 0).then(|| {
            let [re, im] = [re, im].map(Symbolic::from_i64);
            Complex { re: value.clone() * &re, im: value.clone() * &im }
        })
    }))
}
