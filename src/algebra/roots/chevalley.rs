//! The structure constants of a Chevalley basis.

use super::RootSystem;

/// The structure constants of a Chevalley basis, as sorted entries `(i, j, k, v)`, from 0, with `i
/// < j`: `[e_i, e_j] = ... + v e_k`.
///
/// The basis consists of `e_α` for the positive roots in the order of
/// [`RootSystem::positive_roots`], then `f_α = e_{-α}` in the same order, then `h_1 ... h_r`. It
/// satisfies
///
/// - `[e_α, f_α] = h_α`, where `h_α` is the coroot as a combination of the `h_i`;
/// - `[h_i, e_α] = <α, α_i^∨> e_α` for every root α, positive or negative;
/// - `[e_α, e_β] = N_αβ e_{α+β}` if `α + β` is a root: `N_αβ = ±(p + 1)` with `p` the largest
///   number such that `β - pα` is a root, and `N_{-α,-β} = -N_αβ`.
///
/// The signs are fixed by `N_αβ > 0` for the extraspecial pairs. The extraspecial pair of a
/// positive root is the decomposition `α + β`, with `α` before `β`, whose `α` comes first. Carter,
/// *Simple Groups of Lie Type*, 4.1-4.2.
///
/// ```
/// use affinor::algebra::roots::{CartanType, RootSystem, Series, chevalley_constants};
///
/// let sl2 = RootSystem::new(CartanType::new(Series::A, 1)?);
/// // [e, f] = h, [e, h] = -2e, [f, h] = 2f
/// assert_eq!(chevalley_constants(&sl2), [(0, 1, 2, 1), (0, 2, 0, -2), (1, 2, 1, 2)]);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn chevalley_constants(roots: &RootSystem) -> Vec<(usize, usize, usize, i64)> {
    let count = roots.positive.len();
    let f = |a: usize| count + a;
    let h = |i: usize| 2 * count + i;
    let mut constants = Vec::new();
    for (r, s, t, n) in positive_constants(roots) {
        // if r + s + t = 0, then N_rs/(t,t) = N_st/(r,r) = N_tr/(s,s).
        let turned =
            |x: usize| n * roots.positive[x].squared_length / roots.positive[t].squared_length;
        constants.extend([
            (r, s, t, n),
            (f(r), f(s), f(t), -n),
            (t, f(r), s, -turned(s)),
            (t, f(s), r, turned(r)),
            (r, f(t), f(s), -turned(s)),
            (s, f(t), f(r), turned(r)),
        ]);
    }
    for (a, root) in roots.positive.iter().enumerate() {
        for (i, &v) in root.coroot.iter().enumerate().filter(|&(_, &v)| v != 0) {
            constants.push((a, f(a), h(i), v));
        }
        for (i, &v) in root.weight.iter().enumerate().filter(|&(_, &v)| v != 0) {
            constants.extend([(a, h(i), a, -v), (f(a), h(i), f(a), v)]);
        }
    }
    constants.sort_unstable();
    constants
}

/// The names of the basis of [`chevalley_constants`]: `e1 ...`, `f1 ...`, `h1 ...`.
pub fn basis_names(roots: &RootSystem) -> Vec<String> {
    let (count, rank) = (roots.positive.len(), roots.cartan_type.rank());
    [("e", count), ("f", count), ("h", rank)]
        .into_iter()
        .flat_map(|(letter, number)| (1..=number).map(move |i| format!("{letter}{i}")))
        .collect()
}

/// All `(r, s, t, N_rs)` for positive roots with `r < s` and `r + s = t`, in ascending order of
/// `t`.
fn positive_constants(roots: &RootSystem) -> Vec<(usize, usize, usize, i64)> {
    let count = roots.positive.len();
    let mut known = vec![vec![0; count]; count];
    let mut constants = Vec::new();
    for t in 0..count {
        for (r, s, n) in constants_of_sum(roots, &known, t) {
            known[r][s] = n;
            known[s][r] = -n;
            constants.push((r, s, t, n));
        }
    }
    constants
}

/// All `(r, s, N_rs)` with `r + s = t` and `r < s`, from the constants for smaller sums.
///
/// The recursion is as follows. Let `f` be the root vector of `-α_i`, `(α_i, t - α_i)` the
/// extraspecial pair, and `[f, e_x] = d(x) e_{x - α_i}`. The derivation `[f, ·]` applied to
/// `[e_r, e_s] = N_rs e_t` gives `N_rs d(t) = d(r) N_{r-α_i, s} + d(s) N_{r, s-α_i}`.
fn constants_of_sum(roots: &RootSystem, known: &[Vec<i64>], t: usize) -> Vec<(usize, usize, i64)> {
    let mut pairs = decompositions(roots, t);
    // the first summand of the extraspecial pair is simple, because every positive root that is not
    // simple is some α_i + β
    let Some((i, rest)) = pairs.next() else {
        return Vec::new();
    };
    let length = |x: usize| roots.positive[x].squared_length;
    let lowered = |n: i64, below: usize, x: usize| n * length(below) / length(x);
    // the product d(x) N_{x - α_i, y}
    let term = |x: usize, y: usize| {
        roots
            .difference(x, i)
            .map_or(0, |below| lowered(known[i][below], below, x) * known[below][y])
    };
    let extraspecial = roots.steps_down(rest, i) + 1;
    let d_t = lowered(extraspecial, rest, t);
    // uses N_{r, s - α_i} = -N_{s - α_i, r}
    let others = pairs.map(|(r, s)| (r, s, (term(r, s) - term(s, r)) / d_t));
    std::iter::once((i, rest, extraspecial)).chain(others).collect()
}

/// All pairs `r < s` of positive roots with sum `t`, in ascending order of `r`.
fn decompositions(roots: &RootSystem, t: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..t)
        .map_while(move |r| {
            // stops where r becomes the larger summand: roots are sorted by height, so the height
            // of r then exceeds half the height of t
            (2 * roots.positive[r].height() <= roots.positive[t].height()).then_some(r)
        })
        .filter_map(move |r| roots.difference(t, r).filter(|&s| r < s).map(|s| (r, s)))
}
