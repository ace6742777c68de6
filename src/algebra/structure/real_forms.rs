//! The real forms of the simple complex algebras, by type and signature of the Killing form.
//!
//! The number of negative squares of the Killing form is the dimension of a maximal compact
//! subalgebra. Type and signature determine the real form, except for su(p,q) and su*(p+q) with
//! `(p-q)^2 = p+q+2`, and so(p,q) and so*(p+q) with `(p-q)^2 = 2(p+q)`. S. Helgason, *Differential
//! Geometry, Lie Groups, and Symmetric Spaces*, ch. X, table V.

use crate::algebra::roots::{CartanType, Series};

/// The names of the real forms of a type whose maximal compact subalgebra has the dimension
/// `compact`: one name, or two in the exceptional cases.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
/// use affinor::algebra::structure::real_forms::real_forms;
/// let b2 = CartanType::new(Series::B, 2)?;
/// assert_eq!(real_forms(b2, 6), ["so(4,1)"]);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn real_forms(cartan_type: CartanType, compact: usize) -> Vec<String> {
    candidates(cartan_type, compact).into_iter().map(|candidate| candidate.name).collect()
}

/// A name of a real form.
pub(super) struct Candidate {
    pub name: String,
    /// Whether it is a form `su*` or `so*` over the quaternions.
    pub is_quaternionic: bool,
}

/// The candidates for the real form with the dimension `compact`, as in [`real_forms`].
pub(super) fn candidates(cartan_type: CartanType, compact: usize) -> Vec<Candidate> {
    let (r, series) = (cartan_type.rank(), cartan_type.series());
    let plain = |(dimension, name)| (dimension, Candidate { name, is_quaternionic: false });
    let all: Vec<(usize, String)> = match series {
        Series::A => special_linear(r + 1),
        Series::B => orthogonal(2 * r + 1).collect(),
        Series::C => symplectic(r),
        Series::D => orthogonal(2 * r).collect(),
        _ => exceptional(cartan_type),
    };
    // omits su*(2), which is isomorphic to su(2), and so*(8), which is isomorphic to so(6,2)
    let quaternionic = match series {
        Series::A if r > 1 && r % 2 == 1 => {
            Some((r.div_ceil(2) * (r + 2), format!("su*({})", r + 1)))
        }
        Series::D if r != 4 => Some((r * r, format!("so*({})", 2 * r))),
        _ => None,
    };
    let starred = quaternionic
        .map(|(dimension, name)| (dimension, Candidate { name, is_quaternionic: true }));
    let all = all.into_iter().map(plain).chain(starred);
    all.filter(|(dimension, _)| *dimension == compact).map(|(_, candidate)| candidate).collect()
}

/// The name of the complex algebra of a type, regarded as real.
pub fn complex_form(cartan_type: CartanType) -> String {
    let r = cartan_type.rank();
    match cartan_type.series() {
        Series::A => format!("sl({},C)", r + 1),
        Series::B => format!("so({},C)", 2 * r + 1),
        Series::C => format!("sp({},C)", 2 * r),
        Series::D => format!("so({},C)", 2 * r),
        _ => format!("{cartan_type}(C)"),
    }
}

/// The name of a form with the arguments `p`, `q`, or with one argument if the form is compact.
fn two(head: &str, p: usize, q: usize) -> String {
    if q == 0 { format!("{head}({p})") } else { format!("{head}({p},{q})") }
}

fn special_linear(n: usize) -> Vec<(usize, String)> {
    let split = (n * (n - 1) / 2, format!("sl({n},R)"));
    // omits su(1,1), which is isomorphic to sl(2,R)
    let unitary = (0..=n / 2).filter(|q| (n, *q) != (2, 1));
    let unitary = unitary.map(|q| (q * q + (n - q) * (n - q) - 1, two("su", n - q, q)));
    [split].into_iter().chain(unitary).collect()
}

fn orthogonal(n: usize) -> impl Iterator<Item = (usize, String)> {
    let pairs = |n: usize| n * n.saturating_sub(1) / 2;
    (0..=n / 2).map(move |q| (pairs(q) + pairs(n - q), two("so", n - q, q)))
}

/// The real forms of C_r. The arguments of sp(p,q) count quaternions, the argument of sp(2r,R) is a
/// number of real coordinates, and usp(2r) is the compact form.
fn symplectic(r: usize) -> Vec<(usize, String)> {
    let compact = |n: usize| n * (2 * n + 1);
    let split = (r * r, format!("sp({},R)", 2 * r));
    // names the compact form usp, because the catalogue uses sp(r) with another meaning
    let name = |q: usize| match q {
        0 => format!("usp({})", 2 * r),
        q => format!("sp({},{q})", r - q),
    };
    let others = (0..=r / 2).map(|q| (compact(q) + compact(r - q), name(q)));
    [split].into_iter().chain(others).collect()
}

/// The real forms of an exceptional type. Their names contain the character `dim p - dim k` in
/// parentheses.
fn exceptional(cartan_type: CartanType) -> Vec<(usize, String)> {
    let compact: &[usize] = match (cartan_type.series(), cartan_type.rank()) {
        (Series::G, _) => &[6, 14],
        (Series::F, _) => &[24, 36, 52],
        (_, 6) => &[36, 38, 46, 52, 78],
        (_, 7) => &[63, 69, 79, 133],
        _ => &[120, 136, 248],
    };
    let n = cartan_type.dimension() as i64;
    let letter = cartan_type.to_string().to_lowercase();
    let name = |&k: &usize| (k, format!("{letter}({})", n - 2 * k as i64));
    compact.iter().map(name).collect()
}
