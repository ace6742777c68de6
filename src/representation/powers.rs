//! Symmetric and exterior powers, and all other Schur functors.

use super::decomposition::Sum;
use super::{Character, Decomposition, HighestWeight, RepresentationError};
use affinor_tensors::stop::{checkpoint, stage};
use std::collections::HashMap;

/// The maximum degree of a power.
const MAX_DEGREE: usize = 64;

impl Decomposition {
    /// The symmetric power of a degree.
    ///
    /// # Errors
    /// As [`Decomposition::schur`].
    ///
    /// ```
    /// use affinor::representation::{Decomposition, HighestWeight, ReductiveAlgebra};
    /// let su3: ReductiveAlgebra = "SU(3)".parse()?;
    /// let v = Decomposition::irreducible(&HighestWeight::new(&su3, [1, 0])?);
    /// assert_eq!(v.symmetric_power(3)?.to_string(), "10");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn symmetric_power(&self, degree: usize) -> Result<Self, RepresentationError> {
        self.schur(&[degree])
    }

    /// The exterior power of a degree.
    ///
    /// # Errors
    /// As [`Decomposition::schur`].
    ///
    /// ```
    /// use affinor::representation::{Decomposition, HighestWeight, ReductiveAlgebra};
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// let v = Decomposition::irreducible(&HighestWeight::parse(&e8, "248")?);
    /// assert_eq!(v.exterior_power(2)?.to_string(), "248 + 30380");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn exterior_power(&self, degree: usize) -> Result<Self, RepresentationError> {
        limit_of_degree(degree)?;
        self.schur(&vec![1; degree])
    }

    /// The Schur functor of a partition `μ` of `k`, the plethysm with the Schur function `s_μ`:
    ///
    /// ```text
    /// k s_μ = sum over rim hooks of μ of (-1)^(rows - 1) p_r s_(μ without the hook)
    /// ```
    ///
    /// with the length `r` of the hook and the Adams operation `p_r`, which multiplies all weights
    /// by `r`. For one row or one column these are Newton's identities.
    ///
    /// # Errors
    /// [`RepresentationError::NotACharacter`] if the rows of the partition increase or the
    /// representation is virtual; [`RepresentationError::TooLarge`] if the degree or the result
    /// exceeds the limits.
    ///
    /// ```
    /// use affinor::representation::{Decomposition, HighestWeight, ReductiveAlgebra};
    /// let su3: ReductiveAlgebra = "SU(3)".parse()?;
    /// let v = Decomposition::irreducible(&HighestWeight::new(&su3, [1, 0])?);
    /// assert_eq!(v.schur(&[2, 1])?.to_string(), "8");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn schur(&self, partition: &[usize]) -> Result<Self, RepresentationError> {
        let _stage = stage("power");
        if partition.windows(2).any(|rows| rows[0] < rows[1]) {
            let reason = format!("the rows of the partition {partition:?} increase");
            return Err(RepresentationError::NotACharacter { reason });
        }
        limit_of_degree(partition.iter().fold(0, |sum, row| sum.saturating_add(*row)))?;
        let partition = partition.iter().copied().filter(|row| *row > 0).collect();
        let mut schur = Schur { character: self.character()?, known: HashMap::new() };
        schur.find(&partition)?;
        match schur.known.remove(&partition) {
            Some(power) => power.effective(),
            None => Ok(Self::irreducible(&HighestWeight::trivial(self.algebra()))),
        }
    }
}

fn limit_of_degree(degree: usize) -> Result<(), RepresentationError> {
    if degree > MAX_DEGREE {
        let (what, limit) = (format!("the degree {degree}"), MAX_DEGREE.to_string());
        return Err(RepresentationError::TooLarge { what, limit });
    }
    Ok(())
}

/// The Schur functors of one representation.
struct Schur {
    character: Character,
    known: HashMap<Vec<usize>, Decomposition>,
}

impl Schur {
    /// Finds the functor of a partition and of all partitions that remain without rim hooks.
    fn find(&mut self, partition: &Vec<usize>) -> Result<(), RepresentationError> {
        checkpoint();
        if self.known.contains_key(partition) {
            return Ok(());
        }
        let algebra = self.character.algebra().clone();
        let degree = partition.iter().sum::<usize>();
        if degree == 0 {
            let trivial = Decomposition::irreducible(&HighestWeight::trivial(&algebra));
            self.known.insert(vec![], trivial);
            return Ok(());
        }
        let mut sum = Sum::new(&algebra);
        for (rest, length, sign) in rim_hooks(partition) {
            self.find(&rest)?;
            let adams = self.character.adams(length as i64);
            for (weight, multiplicity) in self.known[&rest].components() {
                sum.add_product(weight, sign * multiplicity, &adams, None)?;
            }
        }
        self.known.insert(partition.clone(), sum.divided(degree as i128)?);
        Ok(())
    }
}

/// The partitions that remain when a rim hook is removed, with the length and the sign of the hook.
///
/// In the set of the numbers `μ_i + n - i`, removing a hook of length `r` lowers one number by `r`
/// to a number outside the set. The sign is `(-1)^m`, with `m` numbers in between.
fn rim_hooks(partition: &[usize]) -> Vec<(Vec<usize>, usize, i128)> {
    let n = partition.len();
    let beads: Vec<usize> = partition.iter().enumerate().map(|(i, row)| row + n - 1 - i).collect();
    let mut hooks = vec![];
    for (i, &bead) in beads.iter().enumerate() {
        for lower in (0..bead).filter(|lower| !beads.contains(lower)) {
            let between = beads.iter().filter(|&&other| lower < other && other < bead).count();
            let mut moved = beads.clone();
            moved[i] = lower;
            moved.sort_by(|a, b| b.cmp(a));
            let rows = moved.iter().enumerate().map(|(i, bead)| bead + i + 1 - n);
            let rest = rows.filter(|row| *row > 0).collect();
            hooks.push((rest, bead - lower, if between % 2 == 0 { 1 } else { -1 }));
        }
    }
    hooks
}
