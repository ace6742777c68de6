//! The positions of the components of a factor: their rows, and their places in the accumulator.

use super::Role;
use super::shape::Place;

/// The position of a component.
#[derive(Clone, Copy, Default)]
pub(super) struct Position {
    pub group: u64,
    pub link: u64,
    pub place: Place,
    /// The index of the component in the tensor.
    pub at: u32,
}

/// The contributions of an index of value 1 to the group, the link and the place.
pub(super) type Weight = (u64, u64, Place);

/// Computes the groups, links and places of the components of a factor.
pub(super) struct Digits<'d> {
    n: u64,
    weights: &'d [Weight],
    /// The pairs of slots that are summed with each other.
    inside: Vec<(usize, usize)>,
    digits: Vec<u64>,
    /// The last key, with its last index set to 0. Neighbouring keys usually have this value in
    /// common.
    base: u64,
    /// The contribution of all indices except the last index. Neighbouring keys usually have this
    /// contribution in common too.
    front: Option<Weight>,
}

impl<'d> Digits<'d> {
    pub fn new(n: u64, roles: &[Role], weights: &'d [Weight]) -> Self {
        let twin = |a: usize| (a + 1..roles.len()).find(|&b| roles[b] == roles[a]);
        let inside = (0..roles.len()).filter_map(|a| twin(a).map(|b| (a, b))).collect();
        Digits { n, weights, inside, digits: vec![0; roles.len()], base: u64::MAX, front: None }
    }

    /// The weight of the component with this key. Returns `None` if the component is off the
    /// diagonal of a pair of slots that is summed.
    #[inline(always)]
    pub fn read(&mut self, key: u64) -> Option<Weight> {
        let (Some((&weight, weights)), Some((last, digits))) =
            (self.weights.split_last(), self.digits.split_last_mut())
        else {
            return Some((0, 0, 0));
        };
        if key < self.base || key - self.base >= self.n {
            let mut rest = key / self.n;
            self.base = rest * self.n;
            self.front = None;
            for digit in digits.iter_mut().rev() {
                (*digit, rest) = (rest % self.n, rest / self.n);
            }
        }
        *last = key - self.base;
        let add = |sum: Weight, (&digit, weight): (&u64, &Weight)| {
            let place = sum.2 + digit as Place * weight.2;
            (sum.0 + digit * weight.0, sum.1 + digit * weight.1, place)
        };
        let front = || digits.iter().zip(weights).fold((0, 0, 0), add);
        if self.inside.is_empty() {
            return Some(add(*self.front.get_or_insert_with(front), (last, &weight)));
        }
        let on = |&(a, b): &(usize, usize)| self.digits[a] == self.digits[b];
        let all = || self.digits.iter().zip(self.weights).fold((0, 0, 0), add);
        self.inside.iter().all(on).then(all)
    }
}

/// For each of `count` keys, the number of items with smaller keys. The last entry is the number of
/// all items. The keys of the items must be ascending.
pub(super) fn beginnings(keys: impl Iterator<Item = u64>, count: u64) -> Vec<u32> {
    let mut starts = vec![0; count as usize + 1];
    keys.for_each(|key| starts[key as usize + 1] += 1);
    for at in 1..starts.len() {
        starts[at] += starts[at - 1];
    }
    starts
}

/// Sorts the items stably by a key that is below `count`.
pub(super) fn sort_by_counting(
    items: &mut Vec<Position>,
    count: u64,
    key: impl Fn(&Position) -> u64,
) {
    if count <= 1 {
        return;
    }
    let mut next = beginnings(items.iter().map(&key), count);
    let mut sorted = vec![Position::default(); items.len()];
    for item in items.iter() {
        let slot = &mut next[key(item) as usize];
        sorted[*slot as usize] = *item;
        *slot += 1;
    }
    *items = sorted;
}
