//! The Weyl group, acting on weights by reflections in place.

use super::ReductiveAlgebra;
use affinor_tensors::stop::checkpoint;
use num_bigint::BigUint;
use num_traits::One;

impl ReductiveAlgebra {
    /// The simple reflection `s_i(ν) = ν - ν_i α_i`, in place.
    #[inline]
    pub(super) fn reflect(&self, weight: &mut [i64], i: usize) {
        let label = weight[i];
        weight[i] = -label;
        for &(j, entry) in self.neighbours(i) {
            weight[j] -= label * entry;
        }
    }

    /// The labels of a simple root, and charges 0.
    pub(super) fn simple_root(&self, i: usize) -> Vec<i64> {
        let mut labels = vec![0; self.rank()];
        labels[i] = 2;
        self.neighbours(i).iter().for_each(|&(j, entry)| labels[j] = entry);
        labels
    }

    /// The largest `|<w ν, α_i^∨>|` over the Weyl group elements `w`, and the largest charge, for
    /// labels that are not negative.
    pub(super) fn largest_label(&self, dominant: &[i64]) -> i64 {
        let roots = self.positive_roots().iter();
        let values = roots.map(|root| {
            let terms = root.coroot.iter().zip(dominant).map(|(c, label)| c.saturating_mul(*label));
            terms.fold(0, i64::saturating_add)
        });
        let charges = dominant[self.semisimple_rank()..].iter().map(|charge| charge.abs());
        values.chain(charges).max().unwrap_or(0)
    }

    /// Reflects a weight into the dominant chamber.
    pub(super) fn make_dominant(&self, weight: &mut [i64]) {
        let mut i = 0;
        while i < self.semisimple_rank() {
            if weight[i] < 0 {
                self.reflect(weight, i);
                // the reflection lowers the labels of the neighbours
                i = self.first_neighbour(i).min(i + 1);
            } else {
                i += 1;
            }
        }
    }

    /// Reflects a weight into the dominant chamber if no reflection fixes it. Returns the sign of
    /// the Weyl group element, or 0 if a reflection fixes the weight.
    #[inline]
    pub(super) fn straighten(&self, weight: &mut [i64]) -> i128 {
        let mut sign = 1;
        let mut i = 0;
        while i < self.semisimple_rank() {
            match weight[i] {
                0 => return 0,
                1.. => i += 1,
                _ => {
                    self.reflect(weight, i);
                    sign = -sign;
                    i = self.first_neighbour(i).min(i + 1);
                }
            }
        }
        sign
    }

    /// Visits each weight of the orbit of a dominant weight once, without storing the orbit.
    ///
    /// The parent of a weight is its reflection at its first negative label, so the orbit is a
    /// tree. Only the reflections on the path from the root of the tree are stored.
    pub(super) fn for_each_in_orbit(&self, dominant: &[i64], mut visit: impl FnMut(&[i64])) {
        let rank = self.semisimple_rank();
        let mut weight = dominant.to_vec();
        let mut path = vec![];
        visit(&weight);
        let mut i = 0;
        loop {
            if i == rank {
                let Some(last) = path.pop() else { return };
                self.reflect(&mut weight, last);
                i = last + 1;
            } else if weight[i] > 0 {
                self.reflect(&mut weight, i);
                if weight[..i].iter().all(|&label| label >= 0) {
                    checkpoint();
                    visit(&weight);
                    path.push(i);
                    i = 0;
                } else {
                    self.reflect(&mut weight, i);
                    i += 1;
                }
            } else {
                i += 1;
            }
        }
    }

    /// The number of weights in the orbit of a dominant weight.
    ///
    /// The order of a Weyl group is the product of `(h + 1)/h` over the heights `h` of its positive
    /// roots (Macdonald). The reflections with label 0 generate the stabilizer.
    ///
    /// ```
    /// use affinor::representation::ReductiveAlgebra;
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// assert_eq!(e8.orbit_size(&[1; 8]), 696_729_600u32.into());
    /// assert_eq!(e8.orbit_size(&[0, 0, 0, 0, 0, 0, 0, 1]), 240u32.into());
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn orbit_size(&self, dominant: &[i64]) -> BigUint {
        let moved = self.positive_roots().iter().filter(|root| {
            root.coefficients.iter().zip(dominant).any(|(&c, &label)| c != 0 && label != 0)
        });
        let (mut above, mut below) = (BigUint::one(), BigUint::one());
        for root in moved {
            let height: i64 = root.coefficients.iter().sum();
            above *= height.unsigned_abs() + 1;
            below *= height.unsigned_abs();
        }
        above / below
    }
}
