//! Symmetries of the components of a tensor, and one component for each set that they relate.
//!
//! Unlike [`Tensor::pair_symmetry`], these compare upper with lower indices too: they are symmetries
//! of the numbers in this basis, as when the basis is orthonormal.

use crate::Coefficient;
use crate::formula::{formula, mathml};
use affinor_tensors::Tensor;

/// A permutation of the slots, and the sign by which it changes the components.
type Symmetry = (Vec<usize>, bool);

/// The largest number of components whose symmetries are found.
const LARGEST: usize = 20_000;

/// The symmetries of a tensor.
pub(super) struct Symmetries {
    /// The group that the found symmetries generate.
    group: Vec<Symmetry>,
    /// The found exchanges of two slots, and whether the sign changes.
    pairs: Vec<(usize, usize, bool)>,
    /// Whether the exchange of the first and the last pair of slots changes nothing.
    exchange: bool,
    rank: usize,
}

impl Symmetries {
    pub fn of<S: Coefficient>(tensor: &Tensor<S>) -> Self {
        let rank = tensor.rank();
        let (mut pairs, mut found): (Vec<_>, Vec<Symmetry>) = (vec![], vec![]);
        if (2..=4).contains(&rank) && tensor.len() <= LARGEST {
            for a in 0..rank {
                for b in a + 1..rank {
                    let mut slots: Vec<usize> = (0..rank).collect();
                    slots.swap(a, b);
                    if let Some(negative) = sign(tensor, &slots) {
                        pairs.push((a, b, negative));
                        found.push((slots, negative));
                    }
                }
            }
        }
        let whole = rank == 4 && pairs.len() < 6 && tensor.len() <= LARGEST;
        let exchange = whole && sign(tensor, &[2, 3, 0, 1]) == Some(false);
        if exchange {
            found.push((vec![2, 3, 0, 1], false));
        }
        Symmetries { group: generated(found, rank), pairs, exchange, rank }
    }

    /// Whether the component represents the set of those that the symmetries relate to it: the one
    /// with the first indices.
    pub fn represents(&self, at: &[usize]) -> bool {
        self.group.iter().all(|(slots, _)| at.iter().le(slots.iter().map(|slot| &at[*slot])))
    }

    /// The symmetries in words and letters of indices; `None` if there are none.
    pub fn words(&self, letters: &str) -> Option<String> {
        let letters: Vec<char> = letters.chars().collect();
        let letter = |slot: usize| {
            letters.get(slot).map(|c| mathml::inline(&formula(&c.to_string()))).unwrap_or_default()
        };
        let all = self.rank * (self.rank.max(1) - 1) / 2;
        let signs = |negative: bool| self.pairs.iter().filter(|pair| pair.2 == negative).count();
        if self.rank > 2 && signs(true) == all {
            return Some("totally antisymmetric".into());
        }
        if self.rank > 2 && signs(false) == all {
            return Some("totally symmetric".into());
        }
        let pair = |(a, b, negative): &(usize, usize, bool)| {
            let word = if *negative { "antisymmetric" } else { "symmetric" };
            format!("{word} in {}, {}", letter(*a), letter(*b))
        };
        let mut words: Vec<String> = self.pairs.iter().map(pair).collect();
        if self.exchange {
            let pairs = [(0, 1), (2, 3)].map(|(a, b)| letter(a) + &letter(b));
            words.push(format!("unchanged by the exchange of {} and {}", pairs[0], pairs[1]));
        }
        (!words.is_empty()).then(|| words.join(", "))
    }
}

/// The sign by which a permutation of the slots changes all components; `None` if there is none.
fn sign<S: Coefficient>(tensor: &Tensor<S>, slots: &[usize]) -> Option<bool> {
    let holds = |negative: bool| {
        tensor.components().all(|(at, value)| {
            let moved: Vec<usize> = slots.iter().map(|slot| at[*slot]).collect();
            let other = tensor.get(&moved);
            if negative { -other == *value } else { other == *value }
        })
    };
    [true, false].into_iter().find(|negative| !tensor.is_empty() && holds(*negative))
}

/// The group that symmetries generate.
fn generated(generators: Vec<Symmetry>, rank: usize) -> Vec<Symmetry> {
    let mut group: Vec<Symmetry> = vec![((0..rank).collect(), false)];
    let mut at = 0;
    while at < group.len() {
        let (slots, negative) = group[at].clone();
        for (generator, sign) in &generators {
            let product: Vec<usize> = generator.iter().map(|slot| slots[*slot]).collect();
            if !group.iter().any(|(known, _)| *known == product) {
                group.push((product, negative != *sign));
            }
        }
        at += 1;
    }
    group
}
