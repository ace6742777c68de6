//! Projections of weights for subalgebras of the exceptional algebras, from the restriction of the
//! smallest representation.

use super::regular::solved;
use super::{Decomposition, HighestWeight, ReductiveAlgebra};
use affinor_tensors::stop::checkpoint;
use std::collections::{BTreeMap, HashMap};

/// The projection that maps the weights of a representation of the algebra to the weights of a
/// representation of the subalgebra, as multisets. `None` if there is none.
///
/// The weights of the subalgebra are ordered lexicographically. Some conjugate of the subalgebra maps
/// no simple root below 0. The images of the weights then descend along simple roots. So the largest
/// image that remains belongs to a weight directly below a mapped weight. Each choice of this weight
/// determines the image of a simple root.
pub(super) fn projection(
    ambient: &ReductiveAlgebra,
    smallest: &HighestWeight,
    restricted: &Decomposition,
) -> Option<Vec<Vec<i64>>> {
    let mut images: BTreeMap<Vec<i64>, i128> = BTreeMap::new();
    restricted.character().ok()?.for_each_weight(|weight, multiplicity| {
        *images.entry(weight.to_vec()).or_default() += multiplicity;
    });
    let mut multiplicities = HashMap::new();
    smallest.character().ok()?.for_each_weight(|weight, multiplicity| {
        multiplicities.insert(weight.to_vec(), multiplicity);
    });
    let (top, _) = images.last_key_value()?;
    let mut search = Search {
        ambient,
        multiplicities,
        mapped: HashMap::new(),
        order: vec![],
        roots: vec![None; ambient.semisimple_rank()],
        images: images.clone(),
    };
    search.map(smallest.labels().to_vec(), top.clone())?;
    search.run()
}

/// A partial projection. The weights of the subalgebra are compared lexicographically.
#[derive(Clone)]
struct Search<'a> {
    ambient: &'a ReductiveAlgebra,
    /// The weights of the representation that are not mapped.
    multiplicities: HashMap<Vec<i64>, i128>,
    mapped: HashMap<Vec<i64>, Vec<i64>>,
    /// The mapped weights in order.
    order: Vec<Vec<i64>>,
    /// The images of the simple roots.
    roots: Vec<Option<Vec<i64>>>,
    /// The images that remain.
    images: BTreeMap<Vec<i64>, i128>,
}

impl Search<'_> {
    /// Maps a weight. `None` if the image does not remain often enough.
    fn map(&mut self, weight: Vec<i64>, image: Vec<i64>) -> Option<()> {
        let multiplicity = self.multiplicities.remove(&weight)?;
        let remaining = self.images.get_mut(&image)?;
        *remaining -= multiplicity;
        match *remaining {
            0 => {
                self.images.remove(&image);
            }
            1.. => {}
            _ => return None,
        }
        self.mapped.insert(weight.clone(), image);
        self.order.push(weight);
        Some(())
    }

    fn run(mut self) -> Option<Vec<Vec<i64>>> {
        loop {
            checkpoint();
            let Some((largest, _)) = self.images.last_key_value() else { break };
            let largest = largest.clone();
            // the weights below the mapped ones, with the simple root
            let mut unknown = vec![];
            let mut known = None;
            for weight in &self.order {
                for i in 0..self.roots.len() {
                    let lower = self.below(weight, i);
                    if !self.multiplicities.contains_key(&lower) {
                        continue;
                    }
                    match &self.roots[i] {
                        Some(root) => {
                            let image = difference(&self.mapped[weight], root);
                            if image > largest {
                                return None;
                            }
                            if image == largest {
                                known = Some(lower);
                            }
                        }
                        None => {
                            unknown.push((i, difference(&self.mapped[weight], &largest), lower))
                        }
                    }
                }
            }
            if let Some(lower) = known {
                self.map(lower, largest)?;
                continue;
            }
            unknown.sort();
            unknown.dedup_by_key(|(i, root, _)| (*i, root.clone()));
            return unknown.into_iter().find_map(|(i, root, lower)| {
                let mut branch = self.clone();
                branch.roots[i] = Some(root);
                branch.map(lower, largest.clone())?;
                branch.run()
            });
        }
        // the images of the simple roots determine the projection
        let root = |i: usize| {
            let images = self.order.iter().map(|weight| (weight, self.below(weight, i)));
            let mut pairs = images.filter_map(|(weight, lower)| {
                Some(difference(self.mapped.get(weight)?, self.mapped.get(&lower)?))
            });
            pairs.next()
        };
        let roots: Vec<Vec<i64>> = (0..self.roots.len()).map(root).collect::<Option<_>>()?;
        let labels = roots.first().map_or(0, Vec::len);
        let rows = (0..labels).map(|k| {
            let values: Vec<i64> = roots.iter().map(|root| root[k]).collect();
            solved(self.ambient, &values)
        });
        let rows: Vec<Vec<i64>> = rows.collect::<Option<_>>()?;
        let fits = self.mapped.iter().all(|(weight, image)| {
            rows.iter().zip(image).all(|(row, label)| {
                row.iter().zip(weight).map(|(r, w)| r * w).sum::<i64>() == *label
            })
        });
        fits.then_some(rows)
    }

    /// The weight minus a simple root.
    fn below(&self, weight: &[i64], i: usize) -> Vec<i64> {
        let mut lower = weight.to_vec();
        lower[i] -= 2;
        for &(j, entry) in self.ambient.neighbours(i) {
            lower[j] -= entry;
        }
        lower
    }
}

fn difference(left: &[i64], right: &[i64]) -> Vec<i64> {
    left.iter().zip(right).map(|(l, r)| l - r).collect()
}
