//! Rotations together with vectors: the common formulas of SE(3) and SE_2(3).
//!
//! `(w; u_1 .. u_K)` stands for `w + d_1 u_1 + .. + d_K u_K`, so(3) over dual numbers, `d_a d_b = 0`:
//! each operator of SO(3) acts on `w` and, by its derivative, on the `u_a`. V. Brodsky and M. Shoham, *Mechanism and Machine Theory* 34 (1999) 693-718.

use super::stumpff::{FAR, Stumpff};
use super::written::{TOLERANCE, sparse, spins};
use super::{Embedded, LieGroup, So3, rotation};
use crate::Error;
use nalgebra::{DMatrix, SVector, UnitQuaternion, Vector3};

/// A vector of the algebra: `w`, then the `u_a`.
type Screw<const K: usize> = (Vector3<f64>, [Vector3<f64>; K]);
/// An element of the group, `R` and the vectors `t_a`.
type Motion<const K: usize> = (UnitQuaternion<f64>, [Vector3<f64>; K]);

/// The components of a vector, three by three.
#[inline(always)]
pub(super) fn split<const N: usize, const K: usize>(x: &SVector<f64, N>) -> Screw<K> {
    let part = |at: usize| Vector3::new(x[at], x[at + 1], x[at + 2]);
    (part(0), std::array::from_fn(|a| part(3 * a + 3)))
}

/// The reverse of [`split`].
#[inline(always)]
pub(super) fn join<const N: usize, const K: usize>((w, u): Screw<K>) -> SVector<f64, N> {
    SVector::from_fn(|i, _| if i < 3 { w[i] } else { u[i / 3 - 1][i % 3] })
}

/// Whether the translations are zero, as those of a turn.
#[inline(always)]
fn are_zero<const K: usize>(u: &[Vector3<f64>; K]) -> bool {
    u.iter().all(|u| *u == Vector3::zeros())
}

/// `(R, t)(R', t') = (R R', t + R t')`.
#[inline]
pub(super) fn compose<const K: usize>((r, t): Motion<K>, (q, s): Motion<K>) -> Motion<K> {
    (r * q, std::array::from_fn(|a| t[a] + r * s[a]))
}

/// `(R, t)^-1 = (R^-1, -R^-1 t)`.
#[inline]
pub(super) fn inverse<const K: usize>((r, t): Motion<K>) -> Motion<K> {
    let back = r.inverse();
    (back, t.map(|t| -(back * t)))
}

/// `R = exp(w)`, `t_a = T_right(w) u_a`.
#[inline]
pub(super) fn exp<const K: usize>((w, u): Screw<K>) -> Motion<K> {
    if w == Vector3::zeros() {
        return (UnitQuaternion::identity(), u);
    }
    if are_zero(&u) {
        return (So3.exp(&w), u);
    }
    (So3.exp(&w), u.map(|u| So3.tangent_right(&w, &u)))
}

/// `w = log(R)`, `u_a = T_right(w)^-1 t_a`.
pub(super) fn log<const K: usize>((r, t): Motion<K>) -> Result<Screw<K>, Error> {
    let w = So3.log(&r)?;
    Ok((w, each(&t, |t| So3.tangent_right_inverse(&w, t))?))
}

/// `Ad (w; u_a) = (R w; R u_a + t_a cross R w)`.
#[inline]
pub(super) fn adjoint<const K: usize>((r, t): Motion<K>, (w, u): Screw<K>) -> Screw<K> {
    let w = r * w;
    (w, std::array::from_fn(|a| r * u[a] + t[a].cross(&w)))
}

/// `Ad* (m; f_a) = (R^T (m + f_a cross t_a); R^T f_a)`.
#[inline]
pub(super) fn coadjoint<const K: usize>((r, t): Motion<K>, (m, f): Screw<K>) -> Screw<K> {
    let m = (0..K).fold(m, |m, a| m + f[a].cross(&t[a]));
    (r.inverse_transform_vector(&m), f.map(|f| r.inverse_transform_vector(&f)))
}

/// `Ad*_(R^-1, 0) (m; f_a) = (R m; R f_a)`.
#[inline]
pub(super) fn coadjoint_back<const K: usize>((r, _): Motion<K>, (m, f): Screw<K>) -> Screw<K> {
    (r * m, f.map(|f| r * f))
}

/// `Ad*_exp(w; u_a) (m; f_a)`: as [`coadjoint`], where `R^T (f_a cross t_a) = R^T f_a cross T_left(w) u_a`.
#[inline]
pub(super) fn coadjoint_exp<const K: usize>((w, u): Screw<K>, (m, f): Screw<K>) -> Screw<K> {
    let f = f.map(|f| So3.coadjoint_exp(&w, &f));
    let m = So3.coadjoint_exp(&w, &m);
    if are_zero(&u) {
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

/// `(R^-1 R', 0)`.
#[inline]
pub(super) fn turn_between<const K: usize>((r, _): Motion<K>, (q, _): Motion<K>) -> Motion<K> {
    (r.inverse() * q, [Vector3::zeros(); K])
}

/// `[(w; u_a), (w'; u'_a)] = (w cross w'; w cross u'_a + u_a cross w')`.
#[inline]
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
    if are_zero(&u) && are_zero(&s) {
        return Ok((v, s));
    }
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

/// The reverse of [`matrix`].
///
/// # Errors
/// [`Error::Invalid`] with the defect.
pub(super) fn read<const K: usize>(m: &DMatrix<f64>) -> Result<Motion<K>, Error> {
    let turn = m.fixed_view::<3, 3>(0, 0).into_owned();
    let vector = |a: usize| m.fixed_view::<3, 1>(0, 3 + a).into_owned();
    Ok((rotation::from_matrix(&turn, TOLERANCE)?, std::array::from_fn(vector)))
}

/// The entries of [`matrix`], column by column.
pub(super) fn entries<const K: usize>((r, t): Motion<K>, entries: &mut Vec<f64>) {
    entries.clear();
    for column in rotation::matrix(&r).column_iter() {
        entries.extend(column.iter().chain(&[0.0; K]));
    }
    for (a, t) in t.iter().enumerate() {
        entries.extend(t.iter());
        entries.extend((0..K).map(|row| f64::from(row == a)));
    }
}

/// The `k`-th of the coordinates of the quaternion, `w` first, then of the `t_a`.
pub(super) fn named<const K: usize>((q, t): Motion<K>, k: usize) -> f64 {
    match k {
        0..4 => [q.w, q.i, q.j, q.k][k],
        _ => t[(k - 4) / 3][(k - 4) % 3],
    }
}

/// The matrices of the basis.
pub(super) fn generators<const K: usize>() -> Vec<DMatrix<f64>> {
    let translations = (0..K).flat_map(|a| (0..3).map(move |row| (row, 3 + a, 1.0)));
    spins(3 + K).chain(translations.map(|entry| sparse(3 + K, &[entry]))).collect()
}

/// The quaternion `x, y, z, w` of `R`, then the `t_a`.
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

/// The rate of `R`, then `R u_a` with the projected rotation: only then does the path fit the momentum.
#[inline(always)]
pub(super) fn rate<const N: usize, const K: usize>(
    (r, _): Motion<K>,
    (projected, _): Motion<K>,
    (w, u): Screw<K>,
) -> SVector<f64, N> {
    let r_rate = So3.rate(&r, &w);
    let t_rate = u.map(|u| projected * u);
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
