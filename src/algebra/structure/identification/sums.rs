//! Names of direct sums, composed of the names of the summands.

use super::super::StructureTheory;
use super::super::decomposition::MAX_DIMENSION;
use super::Identification;
use affinor_tensors::Rational;

impl StructureTheory<Rational> {
    /// The name of a direct sum, such as `sl(2,C) + heisenberg(3) + R^2`. Returns `None` if a
    /// summand has no unique name.
    pub(super) fn as_sum(&self) -> Option<Identification> {
        let mut names = vec![];
        let mut proved = true;
        let mut lines = 0;
        if self.is_reductive() {
            let levi = self.levi().ok()?;
            lines = self.centre().dimension();
            if !levi.is_zero() {
                names = self.subalgebra(levi).ok()?.simple_names()?;
            }
        } else {
            if self.dimension() > MAX_DIMENSION {
                return None;
            }
            let ideals = self.indecomposable_ideals().ok()??;
            let mut solvable = vec![];
            for part in &ideals {
                let inside = self.subalgebra(&part.ideal).ok()?;
                if inside.is_abelian() {
                    lines += inside.dimension();
                } else if inside.is_semisimple() {
                    names.extend(inside.simple_names()?);
                } else if inside.is_heisenberg() {
                    solvable.push(format!("heisenberg({})", inside.dimension()));
                } else {
                    // does not try a single summand again: it is the whole algebra
                    let found = (ideals.len() > 1).then(|| inside.identify()).flatten()?;
                    let [name] = &found.names[..] else { return None };
                    if found.parameter.is_some() {
                        return None;
                    }
                    proved &= found.proved;
                    solvable.push(name.clone());
                }
            }
            names.extend(solvable);
        }
        if lines > 0 {
            names.push(format!("R^{lines}"));
        }
        (!names.is_empty())
            .then(|| Identification { proved, ..Identification::by_name(vec![names.join(" + ")]) })
    }

    /// The names of the simple ideals of a semisimple algebra over the reals.
    fn simple_names(&self) -> Option<Vec<String>> {
        let ideals = self.simple_ideals().ok()??;
        let name = |names: &Vec<String>| match &names[..] {
            [name] => Some(name.clone()),
            _ => None,
        };
        ideals.real.iter().map(|ideal| name(&ideal.names)).collect()
    }

    /// Whether the algebra is a Heisenberg algebra: its derived algebra equals the centre, and has
    /// dimension 1.
    fn is_heisenberg(&self) -> bool {
        let (derived, centre) = (self.derived(), self.centre());
        derived.dimension() == 1 && derived == &centre
    }
}
