//! Weights packed into one integer: a reflection is one multiplication, an equality one comparison.

use super::ReductiveAlgebra;
use num_traits::{AsPrimitive, PrimInt, WrappingAdd, WrappingMul, WrappingSub};
use std::hash::Hash;

/// An integer for a packed weight: `u64` or `u128`.
pub(super) trait Word:
    PrimInt + WrappingAdd + WrappingSub + WrappingMul + AsPrimitive<u64> + Hash
{
    /// The number of bits.
    const BITS: usize;

    /// The integer modulo the range of the word.
    fn wrapped(value: i64) -> Self;
}

impl Word for u64 {
    const BITS: usize = u64::BITS as usize;

    #[inline]
    fn wrapped(value: i64) -> Self {
        value as u64
    }
}

impl Word for u128 {
    const BITS: usize = u128::BITS as usize;

    #[inline]
    fn wrapped(value: i64) -> Self {
        i128::from(value) as u128
    }
}

/// The layout of packed weights. Each label has a lane of equal width, which contains the label plus
/// half of the range of the lane. So the top bit of a lane is 0 if the label is negative. Sums and
/// multiples of packed vectors are those of integers, because no label leaves its lane.
pub(super) struct Packing<W> {
    /// The number of labels with charges, and without them.
    rank: usize,
    semisimple: usize,
    width: usize,
    /// The weight 0.
    zero: W,
    /// The top bits, and the lowest bits, of the lanes of simple roots.
    signs: W,
    ones: W,
    /// The simple roots, as vectors.
    roots: Vec<W>,
    /// The neighbours of each node of the Dynkin diagram that have larger numbers.
    later: Vec<Vec<usize>>,
    /// The lane of each bit.
    lane_of: Vec<u8>,
}

impl<W: Word> Packing<W> {
    /// A layout for labels up to `bound` in absolute value; `None` if they are too many or too large.
    pub fn new(algebra: &ReductiveAlgebra, bound: i64) -> Option<Self> {
        let (rank, semisimple) = (algebra.rank(), algebra.semisimple_rank());
        let width = (W::BITS / rank.max(1)).min(62);
        // the 1 is for the subtraction that finds labels 0
        if rank == 0 || width < 2 || bound.checked_add(1)? >= 1 << (width - 1) {
            return None;
        }
        let filled = |count: usize, value: W| {
            (0..count).fold(W::zero(), |sum, i| sum | value << (i * width))
        };
        let half = W::one() << (width - 1);
        let mut packing = Packing {
            rank,
            semisimple,
            width,
            zero: filled(rank, half),
            signs: filled(semisimple, half),
            ones: filled(semisimple, W::one()),
            roots: vec![],
            later: vec![],
            lane_of: (0..W::BITS).map(|bit| (bit / width) as u8).collect(),
        };
        for i in 0..semisimple {
            let neighbours = algebra.neighbours(i).iter().map(|(j, _)| *j);
            packing.later.push(neighbours.filter(|j| *j > i).collect());
            packing.roots.push(packing.vector(&algebra.simple_root(i)));
        }
        Some(packing)
    }

    /// A difference of weights, which can be added to a weight.
    pub fn vector(&self, labels: &[i64]) -> W {
        let terms = labels.iter().enumerate();
        let terms = terms.map(|(i, label)| W::wrapped(*label) << (i * self.width));
        terms.fold(W::zero(), |sum, term| sum.wrapping_add(&term))
    }

    /// A weight.
    pub fn weight(&self, labels: &[i64]) -> W {
        self.zero.wrapping_add(&self.vector(labels))
    }

    /// The labels of a weight.
    pub fn labels(&self, weight: W) -> Vec<i64> {
        (0..self.rank).map(|i| self.label(weight, i)).collect()
    }

    /// The top bits of the lanes of some nodes.
    pub fn signs(&self, nodes: impl Iterator<Item = usize>) -> W {
        nodes.fold(W::zero(), |all, i| all | W::one() << (i * self.width + self.width - 1))
    }

    /// All bits of the lanes of some nodes.
    pub fn lanes(&self, nodes: impl Iterator<Item = usize>) -> W {
        let lane = (W::one() << self.width) - W::one();
        nodes.fold(W::zero(), |all, i| all | lane << (i * self.width))
    }

    /// A simple root, as a vector.
    pub fn root(&self, i: usize) -> W {
        self.roots[i]
    }

    /// A label of a weight.
    #[inline]
    pub fn label(&self, weight: W, i: usize) -> i64 {
        let lane: u64 = (weight >> (i * self.width)).as_();
        (lane & ((1 << self.width) - 1)) as i64 - (1 << (self.width - 1))
    }

    /// The first negative label of a simple root, or the number of simple roots.
    #[inline]
    fn first_negative(&self, weight: W) -> usize {
        let negative = !weight & self.signs;
        match negative.is_zero() {
            true => self.semisimple,
            false => self.lane_of[negative.trailing_zeros() as usize].into(),
        }
    }

    /// The top bits of the lanes of the simple roots whose label is below 1.
    #[inline]
    pub fn below_one(&self, weight: W) -> W {
        !(weight - self.ones) & self.signs
    }

    /// Reflects a weight until no label at the top bits is negative.
    #[inline]
    pub fn dominant_at(&self, mut weight: W, signs: W) -> W {
        loop {
            let negative = !weight & signs;
            if negative.is_zero() {
                return weight;
            }
            let i: usize = self.lane_of[negative.trailing_zeros() as usize].into();
            weight = minus(weight, self.label(weight, i), self.roots[i]);
        }
    }

    /// Reflects a weight into the dominant chamber if no reflection fixes it. Returns the image,
    /// and whether the Weyl group element is odd.
    #[inline]
    pub fn straighten(&self, mut weight: W) -> Option<(W, bool)> {
        let mut odd = false;
        loop {
            let i = self.first_negative(weight);
            if i == self.semisimple {
                break;
            }
            weight = minus(weight, self.label(weight, i), self.roots[i]);
            odd = !odd;
        }
        // a dominant weight is fixed by the reflections whose label is 0
        self.below_one(weight).is_zero().then_some((weight, odd))
    }

    /// Visits the images of an orbit under an affine map: `image` is the image of the dominant
    /// weight, and `steps` are the images of the simple roots, as vectors.
    ///
    /// The parent of a weight is its reflection at its first negative label, so the orbit is a tree.
    /// A reflection at a positive label changes only the labels of its neighbours, and raises them.
    /// So the child at node `i` has its first negative label there if `i` precedes the first
    /// negative label `f` of the weight. Otherwise `i` must be a neighbour of `f`.
    pub fn for_each_image(&self, dominant: W, image: W, steps: &[W], mut visit: impl FnMut(W)) {
        let mut open = vec![(dominant, image)];
        while let Some((weight, image)) = open.pop() {
            visit(image);
            let first = self.first_negative(weight);
            for (i, step) in steps.iter().enumerate().take(first) {
                let label = self.label(weight, i);
                if label > 0 {
                    let child = minus(weight, label, self.roots[i]);
                    open.push((child, minus(image, label, *step)));
                }
            }
            for &i in self.later.get(first).into_iter().flatten() {
                let label = self.label(weight, i);
                if label > 0 {
                    let child = minus(weight, label, self.roots[i]);
                    if self.first_negative(child) == i {
                        open.push((child, minus(image, label, steps[i])));
                    }
                }
            }
        }
    }
}

/// `weight - label * vector`.
#[inline]
pub(super) fn minus<W: Word>(weight: W, label: i64, vector: W) -> W {
    weight.wrapping_sub(&W::wrapped(label).wrapping_mul(&vector))
}
