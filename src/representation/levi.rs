//! Restrictions of characters to Levi subalgebras, for products with singular weights.
//!
//! Let `L` be the Levi subalgebra of the nodes at which `λ` is 0. Then `λ` is a character of `L`. So
//! the formula of Brauer and Klimyk needs one term for each component `σ` of the restriction of `V`
//! to `L`, and not one for each weight of `V`:
//!
//! ```text
//! V_λ ⊗ V = sum over σ of ±V_(w(λ + σ + ρ) - ρ),    V|L = sum over σ of L_σ
//! ```
//!
//! The Weyl group element `w` makes its argument dominant, with its sign; a term that a reflection
//! fixes is 0. The terms of a `W_L`-orbit of weights are Weyl's character formula of `L`.

use super::packed::{Packing, Word, minus};
use super::{Character, HighestWeight, ReductiveAlgebra};
use crate::algebra::roots::identify;
use affinor_tensors::stop::checkpoint;
use num_traits::ToPrimitive;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::hash_map::Entry;

/// Highest weights of components, as packed weights of the algebra, with multiplicities.
pub(super) type Components = Vec<(u128, i128)>;

/// The Levi subalgebra of some nodes, with packed weights of the algebra.
pub(super) struct Levi<'p> {
    packing: &'p Packing<u128>,
    /// The semisimple part, and the node of the algebra of each of its nodes.
    algebra: ReductiveAlgebra,
    nodes: Vec<usize>,
    /// The top bits, and all bits, of the lanes of the nodes.
    signs: u128,
    lanes: u128,
    /// The coefficients of the labels in the height: each simple root of the subalgebra has 2.
    heights: Vec<(usize, i64)>,
    /// The positive roots in which the other simple roots have the sum 1 of coefficients.
    steps: Vec<Step>,
}

/// A positive root outside the subalgebra.
struct Step {
    root: u128,
    coroot: Vec<(usize, i64)>,
    /// The top bits of the lanes of the nodes whose label is negative.
    negative: u128,
}

impl<'p> Levi<'p> {
    /// The Levi subalgebra of the nodes at which a weight is 0.
    pub fn stabilizing(weight: &HighestWeight, packing: &'p Packing<u128>) -> Option<Self> {
        let ambient = weight.algebra();
        let rank = ambient.semisimple_rank();
        let kept: Vec<usize> = (0..rank).filter(|&i| weight.labels()[i] == 0).collect();
        let cartan: Vec<Vec<i64>> = kept
            .iter()
            .map(|&i| {
                let root = ambient.simple_root(i);
                kept.iter().map(|&j| root[j]).collect()
            })
            .collect();
        let factors = identify(&cartan)?;
        let nodes: Vec<usize> =
            factors.iter().flat_map(|(_, own)| own).map(|&at| kept[at]).collect();
        let algebra = ReductiveAlgebra::new(factors.iter().map(|(factor, _)| *factor), 0);
        let mut heights = vec![0; nodes.len()];
        for root in algebra.positive_roots() {
            heights.iter_mut().zip(&root.coroot).for_each(|(sum, c)| *sum += c);
        }
        let outside = ambient.positive_roots().iter().filter(|root| {
            let inside: i64 = nodes.iter().map(|&i| root.coefficients[i]).sum();
            root.coefficients.iter().sum::<i64>() - inside == 1
        });
        let steps = outside.map(|root| Step {
            root: packing.vector(&root.labels),
            coroot: (0..rank).map(|i| (i, root.coroot[i])).filter(|(_, c)| *c != 0).collect(),
            negative: packing.signs(nodes.iter().copied().filter(|&i| root.labels[i] < 0)),
        });
        let steps = steps.collect();
        let heights = nodes.iter().copied().zip(heights).collect();
        let signs = packing.signs(nodes.iter().copied());
        let lanes = packing.lanes(nodes.iter().copied());
        Some(Levi { packing, algebra, nodes, signs, lanes, heights, steps })
    }

    /// The order of the Weyl group of the subalgebra.
    pub fn order(&self) -> f64 {
        let regular = vec![1; self.algebra.rank()];
        self.algebra.orbit_size(&regular).to_f64().unwrap_or(f64::INFINITY)
    }

    /// The highest weights of the components of the restriction of a character, with their
    /// multiplicities. `None` if the weights of the character are not saturated, or if the
    /// multiplicities of a component are too large.
    pub fn components(&self, character: &Character) -> Option<Components> {
        let mut rest = self.dominant_weights(character);
        let mut order: Vec<u128> = rest.keys().copied().collect();
        order.sort_unstable_by_key(|&weight| Reverse(self.height(weight)));
        let mut lowered: FxHashMap<u128, Vec<(u128, i128)>> = FxHashMap::default();
        let mut components = vec![];
        for weight in order {
            let multiplicity = rest[&weight];
            if multiplicity == 0 {
                continue;
            }
            components.push((weight, multiplicity));
            let kind = weight & self.lanes;
            let below = match lowered.entry(kind) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(place) => place.insert(self.below(weight)?),
            };
            for &(difference, m) in &*below {
                *rest.get_mut(&weight.wrapping_sub(difference))? -= m * multiplicity;
            }
        }
        Some(components)
    }

    /// The weights of a character that are dominant for the subalgebra, with their multiplicities.
    ///
    /// They are reached from the dominant weights of the algebra by reflections at the roots of
    /// the steps. For let `ν` be one of them with a negative label at `i`, and let `u` map
    /// `s_i ν` to the dominant weight `ν'` of its orbit under `W_L`. Then `u α_i` is such a root,
    /// and `u ν = s_(u α_i) ν'`. Roots that the stabilizer of `ν'` in `W_L` permutes lead to the
    /// same weight, so the dominant one of them suffices.
    fn dominant_weights(&self, character: &Character) -> FxHashMap<u128, i128> {
        let mut found = FxHashMap::default();
        let mut open = vec![];
        for (weight, multiplicity) in character.dominant_weights() {
            checkpoint();
            let weight = self.packing.weight(weight);
            found.insert(weight, multiplicity);
            open.push(weight);
            while let Some(weight) = open.pop() {
                let zeros = self.packing.below_one(weight) & self.signs;
                for step in self.steps.iter().filter(|step| step.negative & zeros == 0) {
                    let value = |&(i, c): &(usize, i64)| c * self.packing.label(weight, i);
                    let product: i64 = step.coroot.iter().map(value).sum();
                    if product > 0 {
                        let image = minus(weight, product, step.root);
                        let image = self.packing.dominant_at(image, self.signs);
                        if found.insert(image, multiplicity).is_none() {
                            open.push(image);
                        }
                    }
                }
            }
        }
        found
    }

    fn height(&self, weight: u128) -> i64 {
        self.heights.iter().map(|&(i, t)| t * self.packing.label(weight, i)).sum()
    }

    /// The differences of a weight and the dominant weights of the representation of the subalgebra
    /// with this highest weight, with their multiplicities; the weight itself is the first.
    fn below(&self, weight: u128) -> Option<Vec<(u128, i128)>> {
        let labels = self.nodes.iter().map(|&i| self.packing.label(weight, i)).collect();
        let highest = HighestWeight::of(&self.algebra, labels);
        let lowered = highest.lowered_weights().ok()?;
        let packed = lowered.into_iter().map(|(_, coefficients, multiplicity)| {
            let terms = self.nodes.iter().zip(coefficients);
            let difference = terms.fold(0u128, |sum, (&i, c)| {
                sum.wrapping_add(u128::wrapped(c).wrapping_mul(self.packing.root(i)))
            });
            (difference, multiplicity)
        });
        Some(packed.collect())
    }
}
