//! Semidirect products of rotations and vectors: the common formulas of SE(3) and SE_2(3).
//!
//! A vector `(w; u_1 ... u_K)` represents `w + d_1 u_1 + ... + d_K u_K`, an element of so(3) over
//! dual numbers with `d_a d_b = 0`. Each operator of SO(3) acts on `w`, and its derivative acts on
//! the `u_a`. V. Brodsky and M. Shoham, *Mechanism and Machine Theory* 34 (1999) 693-718.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, TOLERANCE, checked, sparse, spins};
use crate::group::{Embedded, LieGroup, So3, rotation};
use crate::numerics::stumpff::{FAR, Stumpff};
use nalgebra::{DMatrix, SVector, UnitQuaternion, Vector3};
use std::array::from_fn;
use std::fmt::Debug;

/// A group of rotations `R` of space and `K` vectors `t_a`, on which the rotations act:
/// `(R, t)(R', t') = (R R', t + R t')`. Every type with this trait is a [`LieGroup`].
pub trait SemidirectSo3 {
    /// The type of an element.
    type Pose: Copy + Debug;
    /// The type of the vectors `[t_1 ... t_K]` of an element.
    type Vectors;
    /// The type of the components of an algebra vector: `w`, then the `u_a`.
    type Components;
    /// The type of the embedding coordinates: the quaternion `x, y, z, w` of `R`, then the `t_a`.
    type Coordinates;
    /// The names of the components of the quaternion `w, x, y, z` and of the `t_a`.
    const NAMES: &'static [&'static str];

    /// The rotation `R` and the vectors `t_a` of an element.
    fn parts(g: &Self::Pose) -> (UnitQuaternion<f64>, Self::Vectors);

    /// The element with the rotation `R` and the vectors `t_a`.
    fn whole(rotation: UnitQuaternion<f64>, vectors: Self::Vectors) -> Self::Pose;
}

/// Splits the components of a vector into groups of three.
#[inline(always)]
fn split<const N: usize, const K: usize>(x: &SVector<f64, N>) -> (Vector3<f64>, [Vector3<f64>; K]) {
    let part = |at: usize| Vector3::new(x[at], x[at + 1], x[at + 2]);
    (part(0), from_fn(|a| part(3 * a + 3)))
}

/// Joins groups of three components to a vector; the inverse of [`split`].
#[inline(always)]
fn join<const N: usize, const K: usize>(w: Vector3<f64>, u: [Vector3<f64>; K]) -> SVector<f64, N> {
    SVector::from_fn(|i, _| if i < 3 { w[i] } else { u[i / 3 - 1][i % 3] })
}

/// Whether all vectors are zero, as for a pure rotation.
#[inline(always)]
fn are_zero<const K: usize>(u: &[Vector3<f64>; K]) -> bool {
    u.iter().all(|u| *u == Vector3::zeros())
}

impl<G, const K: usize, const N: usize, const M: usize> LieGroup for G
where
    G: SemidirectSo3<
            Vectors = [Vector3<f64>; K],
            Components = SVector<f64, N>,
            Coordinates = SVector<f64, M>,
        >,
{
    type Element = G::Pose;
    type Vector = SVector<f64, N>;

    #[inline]
    fn dimension(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        G::whole(UnitQuaternion::identity(), [Vector3::zeros(); K])
    }

    #[inline]
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let ((r, t), (q, s)) = (G::parts(g), G::parts(h));
        G::whole(r * q, from_fn(|a| t[a] + r * s[a]))
    }

    /// Returns `(R^-1, -R^-1 t)`.
    #[inline]
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        let (r, t) = G::parts(g);
        let back = r.inverse();
        G::whole(back, t.map(|t| -(back * t)))
    }

    /// Computes the exponential by `R = exp(w)`, `t_a = T_right(w) u_a`.
    #[inline]
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (w, u) = split::<N, K>(x);
        if w == Vector3::zeros() {
            return G::whole(UnitQuaternion::identity(), u);
        }
        if are_zero(&u) {
            return G::whole(So3.exp(&w), u);
        }
        G::whole(So3.exp(&w), u.map(|u| So3.tangent_right(&w, &u)))
    }

    /// Computes the logarithm by `w = log(R)`, of length at most `pi`, and
    /// `u_a = T_right(w)^-1 t_a`.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        let (r, t) = G::parts(g);
        let w = So3.log(&r)?;
        Ok(join(w, each(&t, |t| So3.tangent_right_inverse(&w, t))?))
    }

    /// Returns `(R w; R u_a + t_a cross R w)`.
    #[inline]
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let ((r, t), (w, u)) = (G::parts(g), split::<N, K>(x));
        let w = r * w;
        join(w, from_fn::<_, K, _>(|a| r * u[a] + t[a].cross(&w)))
    }

    /// Computes the action by `Ad* (m; f_a) = (R^T (m + f_a cross t_a); R^T f_a)`.
    #[inline]
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        let ((r, t), (m, f)) = (G::parts(g), split::<N, K>(h));
        let m = (0..K).fold(m, |m, a| m + f[a].cross(&t[a]));
        let r = r.to_rotation_matrix().into_inner();
        join(r.tr_mul(&m), f.map(|f| r.tr_mul(&f)))
    }

    /// Computes the [`coadjoint`](LieGroup::coadjoint) action, with
    /// `R^T (f_a cross t_a) = R^T f_a cross T_left(w) u_a`.
    #[inline]
    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        let ((w, u), (m, f)) = (split::<N, K>(x), split::<N, K>(h));
        let f = f.map(|f| So3.coadjoint_exp(&w, &f));
        let m = So3.coadjoint_exp(&w, &m);
        if are_zero(&u) {
            return join(m, f);
        }
        join((0..K).fold(m, |m, a| m + f[a].cross(&So3.tangent_left(&w, &u[a]))), f)
    }

    #[inline]
    fn project(&self, g: Self::Element) -> Self::Element {
        let (r, t) = G::parts(&g);
        G::whole(So3.project(r), t)
    }

    /// Computes the bracket by
    /// `[(w; u_a), (w'; u'_a)] = (w cross w'; w cross u'_a + u_a cross w')`.
    #[inline]
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let ((w, u), (v, s)) = (split::<N, K>(x), split::<N, K>(y));
        join(w.cross(&v), from_fn::<_, K, _>(|a| w.cross(&s[a]) + u[a].cross(&v)))
    }

    /// The homogeneous matrix `[[R, t_1 ... t_K], [0, 1]]`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let mut entries = Vec::new();
        self.entries(g, &mut entries);
        DMatrix::from_vec(3 + K, 3 + K, entries)
    }

    /// Computes the operator by
    /// `T_left(w; u_a) (v; s_a) = (T_left(w) v; T_left(w) s_a + Q(w, u_a) v)`. Here `T_left(w)` is
    /// the operator of [`So3`], and `Q` is its derivative along `u_a`.
    #[inline]
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        let ((w, u), (v, s)) = (split::<N, K>(x), split::<N, K>(v));
        let lower = |a: usize| So3.tangent_left(&w, &s[a]) + slope(&w, &u[a], &v);
        join(So3.tangent_left(&w, &v), from_fn::<_, K, _>(lower))
    }

    /// Computes the operator by forward substitution: `v' = T_left(w)^-1 v`, then
    /// `s'_a = T_left(w)^-1 (s_a - Q(w, u_a) v')`. It is singular where the operator of [`So3`] is
    /// singular.
    #[inline]
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        let ((w, u), (v, s)) = (split::<N, K>(x), split::<N, K>(v));
        let v = So3.tangent_left_inverse(&w, &v)?;
        if are_zero(&u) && are_zero(&s) {
            return Ok(join(v, s));
        }
        let right = from_fn::<_, K, _>(|a| s[a] - slope(&w, &u[a], &v));
        Ok(join(v, each(&right, |right| So3.tangent_left_inverse(&w, right))?))
    }
}

impl<G, const K: usize, const N: usize, const M: usize> TranslationSplit for G
where
    G: SemidirectSo3<
            Vectors = [Vector3<f64>; K],
            Components = SVector<f64, N>,
            Coordinates = SVector<f64, M>,
        >,
{
    /// Returns `(0; u_a)`.
    #[inline]
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        Some(join(Vector3::zeros(), split::<N, K>(x).1))
    }

    #[inline]
    fn translational_momentum(&self, h: &Self::Vector) -> Option<Self::Vector> {
        self.translational_part(h)
    }

    /// Returns `(R, 0)`, because `(R, t_a) = (1, t_a)(R, 0)`.
    #[inline]
    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        G::whole(G::parts(g).0, [Vector3::zeros(); K])
    }

    /// Computes the action by `Ad*_(R^-1, 0) (m; f_a) = (R m; R f_a)`.
    #[inline]
    fn coadjoint_inverse(&self, turn: &Self::Element, h: &Self::Vector) -> Self::Vector {
        let ((r, _), (m, f)) = (G::parts(turn), split::<N, K>(h));
        let r = r.to_rotation_matrix().into_inner();
        join(r * m, f.map(|f| r * f))
    }

    /// Returns `(R^-1 R', 0)`.
    #[inline]
    fn relative_linear_part(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        G::whole(G::parts(g).0.inverse() * G::parts(h).0, [Vector3::zeros(); K])
    }

    fn has_bounded_adjoint(&self) -> bool {
        true
    }
}

/// The embedding coordinates are the quaternion of the rotation, followed by the `t_a`. The time
/// derivatives of the `t_a` are `R u_a`.
impl<G, const K: usize, const N: usize, const M: usize> Embedded for G
where
    G: SemidirectSo3<
            Vectors = [Vector3<f64>; K],
            Components = SVector<f64, N>,
            Coordinates = SVector<f64, M>,
        >,
{
    type Ambient = SVector<f64, M>;

    #[inline]
    fn coordinates(&self, g: &Self::Element) -> Self::Ambient {
        let (r, t) = G::parts(g);
        SVector::from_fn(|i, _| if i < 4 { r.coords[i] } else { t[(i - 4) / 3][(i - 4) % 3] })
    }

    #[inline]
    fn from_coordinates(&self, y: &Self::Ambient) -> Self::Element {
        let r = So3.from_coordinates(&y.fixed_rows::<4>(0).into_owned());
        G::whole(r, from_fn(|a| y.fixed_rows::<3>(4 + 3 * a).into_owned()))
    }

    #[inline]
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Self::Ambient {
        self.rate_at_projected(g, &self.project(*g), v)
    }

    /// The time derivative of `R`, followed by `R u_a` with the projected rotation, because only
    /// the projected rotation makes the path consistent with the momentum.
    #[inline(always)]
    fn rate_at_projected(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> Self::Ambient {
        let ((r, _), (projected, _)) = (G::parts(point), G::parts(projected));
        let (w, u) = split::<N, K>(v);
        let r_rate = So3.rate(&r, &w);
        let r = projected.to_rotation_matrix().into_inner();
        let t_rate = u.map(|u| r * u);
        SVector::from_fn(|i, _| if i < 4 { r_rate[i] } else { t_rate[(i - 4) / 3][(i - 4) % 3] })
    }

    #[inline]
    fn is_translation_coordinate(&self, at: usize) -> bool {
        at >= 4
    }
}

/// The written form is the homogeneous matrix. The quaternion and the `t_a` are named coordinates.
impl<G, const K: usize, const N: usize, const M: usize> MatrixNotation for G
where
    G: SemidirectSo3<
            Vectors = [Vector3<f64>; K],
            Components = SVector<f64, N>,
            Coordinates = SVector<f64, M>,
        >,
{
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let turn = m.fixed_view::<3, 3>(0, 0).into_owned();
            let vectors = from_fn(|a| m.fixed_view::<3, 1>(0, 3 + a).into_owned());
            Ok(G::whole(rotation::from_matrix(&turn, TOLERANCE)?, vectors))
        })
    }

    fn is_angle(&self, at: usize) -> bool {
        at < 3
    }

    fn names(&self) -> &'static [&'static str] {
        G::NAMES
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        let (q, t) = G::parts(g);
        match k {
            0..4 => So3.named(&q, k),
            _ => t[(k - 4) / 3][(k - 4) % 3],
        }
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        let (r, t) = G::parts(g);
        entries.clear();
        for column in rotation::matrix(&r).column_iter() {
            entries.extend(column.iter().chain(&[0.0; K]));
        }
        for (a, t) in t.iter().enumerate() {
            entries.extend(t.iter());
            entries.extend((0..K).map(|row| f64::from(row == a)));
        }
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let translations = (0..K).flat_map(|a| (0..3).map(move |row| (row, 3 + a, 1.0)));
        spins(3 + K).chain(translations.map(|entry| sparse(3 + K, &[entry]))).collect()
    }
}

/// The derivative `Q(x, p) v = d/de T_left(x + e p) v` at `e = 0`, for `T_left(x) v = v - c_2 x
/// cross v + c_3 x cross (x cross v)`.
fn slope(x: &Vector3<f64>, p: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    if x.norm_squared() > FAR {
        // for a large angle, uses the derivative of the mean over a full turn, which is the
        // projection onto x
        let largest = x.amax();
        let (unit, p) = ((x / largest).normalize(), p / largest);
        let (length, across) = ((x / largest).norm(), p - unit * unit.dot(&p));
        return (across * unit.dot(v) + unit * across.dot(v)) / length;
    }
    let c = Stumpff::at(x.norm_squared());
    let (xv, pv) = (x.cross(v), p.cross(v));
    let turning = x.cross(&xv) * c.slope3() - xv * c.slope2();
    (p.cross(&xv) + x.cross(&pv)) * c.c3 - pv * c.c2 + turning * (2.0 * x.dot(p))
}

fn each<const K: usize>(
    vectors: &[Vector3<f64>; K],
    map: impl Fn(&Vector3<f64>) -> Result<Vector3<f64>, Error>,
) -> Result<[Vector3<f64>; K], Error> {
    let mut images = *vectors;
    for vector in &mut images {
        *vector = map(vector)?;
    }
    Ok(images)
}
