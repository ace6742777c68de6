//! Weights packed into one integer: a reflection is one multiplication, an equality one comparison.

use super::ReductiveAlgebra;

/// The bits of a packed weight.
const BITS: usize = u128::BITS as usize;

/// The layout of packed weights. Each label has a lane of equal width, which holds the label plus
/// half of the range of the lane; so the top bit of a lane is 0 if the label is negative. Sums and
/// multiples of packed vectors are those of integers, because no label leaves its lane.
pub(super) struct Packing {
    /// The number of labels with charges, and without them.
    rank: usize,
    semisimple: usize,
    width: usize,
    /// The weight 0.
    zero: u128,
    /// The top bits, and the lowest bits, of the lanes of simple roots.
    signs: u128,
    ones: u128,
    /// The simple roots, as vectors.
    roots: Vec<u128>,
    /// The lane of each bit.
    lanes: [u8; BITS],
}

impl Packing {
    /// A layout for labels up to `bound` in absolute value; `None` if they are too many or too large.
    pub fn new(algebra: &ReductiveAlgebra, bound: i64) -> Option<Self> {
        let (rank, semisimple) = (algebra.rank(), algebra.semisimple_rank());
        let width = (BITS / rank.max(1)).min(62);
        // the 1 is for the subtraction that finds labels 0
        if rank == 0 || width < 2 || bound.checked_add(1)? >= 1 << (width - 1) {
            return None;
        }
        let lane = |i: usize, value: u128| value << (i * width);
        let half = 1 << (width - 1);
        let mut packing = Packing {
            rank,
            semisimple,
            width,
            zero: (0..rank).map(|i| lane(i, half)).sum(),
            signs: (0..semisimple).map(|i| lane(i, half)).sum(),
            ones: (0..semisimple).map(|i| lane(i, 1)).sum(),
            roots: vec![],
            lanes: std::array::from_fn(|bit| (bit / width) as u8),
        };
        let root = |i: usize| {
            let mut labels = vec![0; rank];
            labels[i] = 2;
            algebra.neighbours(i).iter().for_each(|&(j, entry)| labels[j] = entry);
            labels
        };
        packing.roots = (0..semisimple).map(|i| packing.vector(&root(i))).collect();
        Some(packing)
    }

    /// A difference of weights, which can be added to a weight.
    pub fn vector(&self, labels: &[i64]) -> u128 {
        let lanes = labels.iter().enumerate();
        let terms = lanes.map(|(i, label)| (i128::from(*label) as u128) << (i * self.width));
        terms.fold(0, u128::wrapping_add)
    }

    /// A weight.
    pub fn weight(&self, labels: &[i64]) -> u128 {
        self.zero.wrapping_add(self.vector(labels))
    }

    /// The labels of a weight.
    pub fn labels(&self, weight: u128) -> Vec<i64> {
        (0..self.rank).map(|i| self.label(weight, i)).collect()
    }

    #[inline]
    fn label(&self, weight: u128, i: usize) -> i64 {
        let lane = (weight >> (i * self.width)) as u64 & ((1 << self.width) - 1);
        lane as i64 - (1 << (self.width - 1))
    }

    /// The first negative label of a simple root.
    #[inline]
    fn first_negative(&self, weight: u128) -> Option<usize> {
        let negative = !weight & self.signs;
        (negative != 0).then(|| self.lanes[negative.trailing_zeros() as usize].into())
    }

    /// Reflects a weight into the dominant chamber if no reflection fixes it. Returns the image,
    /// and whether the Weyl group element is odd.
    #[inline]
    pub fn straighten(&self, mut weight: u128) -> Option<(u128, bool)> {
        let mut odd = false;
        while let Some(i) = self.first_negative(weight) {
            weight = minus(weight, self.label(weight, i), self.roots[i]);
            odd = !odd;
        }
        // a dominant weight is fixed by the reflections whose label is 0
        let regular = !(weight - self.ones) & self.signs == 0;
        regular.then_some((weight, odd))
    }

    /// Visits the images of an orbit under an affine map: `image` is the image of the dominant
    /// weight, and `steps` are the images of the simple roots, as vectors.
    ///
    /// The parent of a weight is its reflection at its first negative label, so the orbit is a tree.
    pub fn for_each_image(
        &self,
        dominant: u128,
        image: u128,
        steps: &[u128],
        mut visit: impl FnMut(u128),
    ) {
        let mut open = vec![(dominant, image)];
        while let Some((weight, image)) = open.pop() {
            visit(image);
            for i in 0..self.semisimple {
                let label = self.label(weight, i);
                if label > 0 {
                    let child = minus(weight, label, self.roots[i]);
                    if self.first_negative(child) == Some(i) {
                        open.push((child, minus(image, label, steps[i])));
                    }
                }
            }
        }
    }
}

/// `weight - label * vector`.
#[inline]
fn minus(weight: u128, label: i64, vector: u128) -> u128 {
    weight.wrapping_sub((i128::from(label) as u128).wrapping_mul(vector))
}
