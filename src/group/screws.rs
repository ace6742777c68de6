//! Rotations with vectors that they turn: what SE(3) and SE_2(3) share.
//!
//! `(w; u_1 .. u_K)` stands for `w + d_1 u_1 + .. + d_K u_K`, so(3) over dual numbers, `d_a d_b = 0`:
//! each operator of SO(3) acts on `w` and, by its derivative, on the `u_a`. V. Brodsky and M. Shoham, *Mechanism and Machine Theory* 34 (1999) 693-718.

use super::stumpff::{FAR, Stumpff};
use super::{LieGroup, So3, Stored, rotation};
use crate::Error;
use nalgebra::{DMatrix, SVector, UnitQuaternion, Vector3};

/// A vector of the algebra: `w`, then the `u_a`.
type Screw<const K: usize> = (Vector3<f64>, [Vector3<f64>; K]);
/// An element of the group, `R` and the vectors `t_a`.
type Motion<const K: usize> = (UnitQuaternion<f64>, [Vector3<f64>; K]);

/// The components of a vector, three by three.
pub(super) fn split<const N: usize, const K: usize>(x: &SVector<f64, N>) -> Screw<K> {
    let part = |at: usize| Vector3::new(x[at], x[at + 1], x[at + 2]);
    (part(0), std::array::from_fn(|a| part(3 * a + 3)))
}

/// The reverse of [`split`].
pub(super) fn join<const N: usize, const K: usize>((w, u): Screw<K>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| if i < 3 { w[i] } else { u[i / 3 - 1][i % 3] })
}

/// `(R, t)(R', t') = (R R', t + R t')`.
pub(super) fn compose<const K: usize>((r, t): Motion<K>, (q, s): Motion<K>) -> Motion<K> {
    (r * q, std::array::from_fn(|a| t[a] + r * s[a]))
}

/// `(R, t)^-1 = (R^-1, -R^-1 t)`.
pub(super) fn inverse<const K: usize>((r, t): Motion<K>) -> Motion<K> {
    let back = r.inverse();
    (back, t.map(|t| -(back * t)))
}

/// `R = exp(w)`, `t_a = T_right(w) u_a`.
pub(super) fn exp<const K: usize>((w, u): Screw<K>) -> Motion<K> {
    (So3.exp(&w), u.map(|u| So3.tangent_right(&w, &u)))
}

/// `w = log(R)`, `u_a = T_right(w)^-1 t_a`.
pub(super) fn log<const K: usize>((r, t): Motion<K>) -> Result<Screw<K>, Error> {
    let w = So3.log(&r)?;
    Ok((w, each(&t, |t| So3.tangent_right_inverse(&w, t))?))
}

/// `Ad (w; u_a) = (R w; R u_a + t_a cross R w)`.
pub(super) fn adjoint<const K: usize>((r, t): Motion<K>, (w, u): Screw<K>) -> Screw<K> {
    let w = r * w;
    (w, std::array::from_fn(|a| r * u[a] + t[a].cross(&w)))
}

/// `Ad* (m; f_a) = (R^T (m + f_a cross t_a); R^T f_a)`.
pub(super) fn coadjoint<const K: usize>((r, t): Motion<K>, (m, f): Screw<K>) -> Screw<K> {
    let m = (0..K).fold(m, |m, a| m + f[a].cross(&t[a]));
    (r.inverse_transform_vector(&m), f.map(|f| r.inverse_transform_vector(&f)))
}

/// `Ad*_exp(w; u_a) (m; f_a)`: as [`coadjoint`], with all in one turn, for `f_a cross t_a` goes to
/// `R^T f_a cross T_left(w) u_a`.
#[inline]
pub(super) fn coadjoint_exp<const K: usize>((w, u): Screw<K>, (m, f): Screw<K>) -> Screw<K> {
    let f = f.map(|f| So3.coadjoint_exp(&w, &f));
    let m = So3.coadjoint_exp(&w, &m);
    if u.iter().all(|u| *u == Vector3::zeros()) {
        return (m, f);
    }
    ((0..K).fold(m, |m, a| m + f[a].cross(&So3.tangent_left(&w, &u[a]))), f)
}

/// `(0; u_a)`.
#[inline]
pub(super) fn translation<const K: usize>((_, u): Screw<K>) -> Screw<K> {
    (Vector3::zeros(), u)
}

/// `(R, 0)`, for `(R, t_a) = (1, t_a)(R, 0)`.
#[inline]
pub(super) fn turn<const K: usize>((r, _): Motion<K>) -> Motion<K> {
    (r, [Vector3::zeros(); K])
}

/// `[(w; u_a), (w'; u'_a)] = (w cross w'; w cross u'_a + u_a cross w')`.
pub(super) fn bracket<const K: usize>((w, u): Screw<K>, (v, s): Screw<K>) -> Screw<K> {
    (w.cross(&v), std::array::from_fn(|a| w.cross(&s[a]) + u[a].cross(&v)))
}

/// `T_left(w; u_a) (v; s_a) = (T_left(w) v; T_left(w) s_a + Q(w, u_a) v)`.
pub(super) fn tangent_left<const K: usize>((w, u): Screw<K>, (v, s): Screw<K>) -> Screw<K> {
    let lower = |a: usize| So3.tangent_left(&w, &s[a]) + slope(&w, &u[a], &v);
    (So3.tangent_left(&w, &v), std::array::from_fn(lower))
}

/// The inverse, from above to below: `v' = T_left(w)^-1 v`, then
/// `s'_a = T_left(w)^-1 (s_a - Q(w, u_a) v')`.
pub(super) fn tangent_left_inverse<const K: usize>(
    (w, u): Screw<K>,
    (v, s): Screw<K>,
) -> Result<Screw<K>, Error> {
    let v = So3.tangent_left_inverse(&w, &v)?;
    let right = std::array::from_fn::<_, K, _>(|a| s[a] - slope(&w, &u[a], &v));
    Ok((v, each(&right, |right| So3.tangent_left_inverse(&w, right))?))
}

/// `[[R, t_1 .. t_K], [0, 1]]`.
pub(super) fn matrix<const K: usize>((r, t): Motion<K>) -> DMatrix<f64> {
    let mut matrix = DMatrix::identity(3 + K, 3 + K);
    matrix.view_mut((0, 0), (3, 3)).copy_from(&rotation::matrix(&r));
    for (a, t) in t.iter().enumerate() {
        matrix.view_mut((0, 3 + a), (3, 1)).copy_from(t);
    }
    matrix
}

/// The numbers of `R`, then the `t_a`.
#[inline]
pub(super) fn numbers<const N: usize, const K: usize>((r, t): Motion<K>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| if i < 4 { r.coords[i] } else { t[(i - 4) / 3][(i - 4) % 3] })
}

/// The reverse of [`numbers`].
#[inline]
pub(super) fn from_numbers<const N: usize, const K: usize>(y: &SVector<f64, N>) -> Motion<K> {
    let r = So3.from_numbers(&y.fixed_rows::<4>(0).into_owned());
    (r, std::array::from_fn(|a| y.fixed_rows::<3>(4 + 3 * a).into_owned()))
}

/// That of `R`, then `R u_a` with the rotation that is meant, so that the path belongs to the momentum.
#[inline]
pub(super) fn rate<const N: usize, const K: usize>(
    (r, _): Motion<K>,
    (w, u): Screw<K>,
) -> SVector<f64, N> {
    let r_rate = So3.rate(&r, &w);
    let meant = So3.restored(r);
    let t_rate = u.map(|u| meant * u);
    SVector::from_fn(|i, _| if i < 4 { r_rate[i] } else { t_rate[(i - 4) / 3][(i - 4) % 3] })
}

/// `Q(x, p) v = d/de T_left(x + e p) v` at `e = 0`, for
/// `T_left(x) v = v - c_2 x cross v + c_3 x cross (x cross v)`.
fn slope(x: &Vector3<f64>, p: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    if x.norm_squared() > FAR {
        // that of the mean over a turn, the projection on x
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
