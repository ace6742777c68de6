//! Subalgebras of exceptional algebras, by their roots.

use super::Embedded;
use super::name::{Factor, Name};
use crate::Error;
use crate::algebra::catalogue;
use crate::algebra::roots::{CartanType, Root, RootSystem, Series};
use affinor_tensors::Rational;

/// The rule by which the positive roots of a subsystem are chosen.
enum Subsystem {
    /// The long roots.
    Long,
    /// The roots whose coefficient of this simple root, from 0, is even: fixed by an involution.
    Even(usize),
    /// A simple root, long or short.
    One { long: bool },
    /// No roots: the torus.
    None,
}

/// The isotropy groups of maximal rank: the group, its factors, and their roots. Symmetric spaces by a simple root whose
/// coefficient in the highest root is 1 or 2: S. Helgason, *Differential Geometry, Lie Groups, and Symmetric Spaces* (1978),
/// X.5; the numbers of simple roots are those of Bourbaki.
fn of_maximal_rank(group: &str, isotropy: &[Factor]) -> Option<Subsystem> {
    use Factor::{Exceptional, Orthogonal, SpecialUnitary, Symplectic, Unitary};
    let subsystem = match (group, isotropy) {
        ("G2", [SpecialUnitary(3)]) | ("F4", [Orthogonal(8)]) => Subsystem::Long,
        ("G2", [Orthogonal(4)]) => Subsystem::Even(1),
        ("F4", [Orthogonal(9)]) => Subsystem::Even(3),
        ("F4", [Symplectic(3), SpecialUnitary(2) | Symplectic(1)]) => Subsystem::Even(0),
        ("E6", [Orthogonal(10), Unitary(1) | Orthogonal(2)]) => Subsystem::Even(0),
        ("E6", [SpecialUnitary(6), SpecialUnitary(2) | Symplectic(1)]) => Subsystem::Even(1),
        ("E7", [Orthogonal(12), SpecialUnitary(2) | Symplectic(1)]) => Subsystem::Even(0),
        ("E7", [SpecialUnitary(8)]) => Subsystem::Even(1),
        ("E7", [Exceptional("E6"), Unitary(1) | Orthogonal(2)]) => Subsystem::Even(6),
        ("E8", [Orthogonal(16)]) => Subsystem::Even(0),
        ("E8", [Exceptional("E7"), SpecialUnitary(2) | Symplectic(1)]) => Subsystem::Even(7),
        _ => return None,
    };
    Some(subsystem)
}

/// A subalgebra of a compact exceptional algebra that is spanned by root vectors and the torus, or a part of it.
pub(super) fn embed(
    group: &'static str,
    isotropy: &[Factor],
    name: &Name,
) -> Result<Embedded, Error> {
    let (subsystem, full_torus) = match (group, isotropy) {
        (_, [Factor::Torus]) => (Subsystem::None, true),
        ("G2", [Factor::OfRoot { torus, long }]) => (Subsystem::One { long: *long }, *torus),
        _ => (of_maximal_rank(group, isotropy).ok_or_else(|| name.without_embedding())?, true),
    };
    let unknown = || name.without_embedding();
    let cartan_type = cartan_type(group).ok_or_else(unknown)?;
    let roots = RootSystem::new(cartan_type);
    let (positive, rank) = (roots.positive_roots(), cartan_type.rank());
    let longest = positive.iter().map(Root::squared_length).max();
    let is_long = |root: &Root| Some(root.squared_length()) == longest;
    let is_simple = |root: &Root| root.coefficients().iter().sum::<i64>() == 1;
    let chosen = |root: &Root| match subsystem {
        Subsystem::Long => is_long(root),
        Subsystem::One { long } => is_simple(root) && is_long(root) == long,
        Subsystem::Even(at) => root.coefficients()[at] % 2 == 0,
        Subsystem::None => false,
    };
    // the basis of the compact form: u and v for each positive root, then w for each simple root
    let n = 2 * positive.len() + rank;
    let of_roots = (0..2 * positive.len()).filter(|at| chosen(&positive[at % positive.len()]));
    let coroots = (0..rank).filter(|at| {
        full_torus
            || positive
                .iter()
                .any(|root| chosen(root) && is_simple(root) && root.coefficients()[*at] == 1)
    });
    let places: Vec<usize> = of_roots.chain(coroots.map(|at| 2 * positive.len() + at)).collect();
    let unit = |at: usize| (0..n).map(|i| Rational::from((i == at) as i64)).collect();
    let sentence = match subsystem {
        Subsystem::None => format!("the maximal torus of {group}"),
        Subsystem::Long => format!("the maximal torus of {group} and the long roots"),
        Subsystem::Even(at) => format!(
            "the maximal torus of {group} and the roots with an even coefficient of the simple root {}",
            at + 1
        ),
        Subsystem::One { long } => format!(
            "{}the {} simple root of {group}",
            if full_torus { "the maximal torus and " } else { "" },
            if long { "long" } else { "short" },
        ),
    };
    Ok(Embedded {
        algebra: catalogue::algebra(&Factor::Exceptional(group).algebra())?,
        vectors: places.into_iter().map(unit).collect(),
        sentence,
    })
}

/// The type of a group, such as `G2`.
fn cartan_type(group: &str) -> Option<CartanType> {
    let series = match group.chars().next()? {
        'E' => Series::E,
        'F' => Series::F,
        _ => Series::G,
    };
    CartanType::new(series, group[1..].parse().ok()?).ok()
}
