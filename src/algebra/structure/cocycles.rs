//! Closed left-invariant forms of degree 1 and 2: representatives of cohomology with trivial
//! coefficients.
//!
//! The differentials are `d a(x, y) = -a([x, y])` and
//! `d b(x, y, z) = -b([x, y], z) - b([y, z], x) - b([z, x], y)`.

use super::subspace::collected;
use super::{GroundField, StructureTheory, Subspace};
use affinor_tensors::linear::Row;
use affinor_tensors::stop::stage;

/// The largest dimension at which closed 2-forms are computed.
pub const MAX_DIMENSION: usize = 60;
/// The largest dimension at which 2-forms are computed for all structure constants. In larger
/// dimensions, the structure constants must be rational and few.
pub const MAX_ANY: usize = 12;
const MAX_CONSTANTS: usize = 4000;

/// The left-invariant 2-forms. The component `b(e_i, e_j)` with `i < j` has the index `i n + j`.
#[derive(Clone, Debug)]
pub struct TwoForms<S> {
    /// The closed forms.
    pub closed: Subspace<S>,
    /// The exact forms `d a`, for the 1-forms `a` of the coframe in order.
    pub exact: Subspace<S>,
}

impl<S: GroundField> TwoForms<S> {
    /// Closed forms that represent a basis of the second cohomology.
    pub fn cohomology(&self) -> Vec<Row<S>> {
        let mut span = self.exact.clone();
        self.closed.basis().iter().filter(|row| span.add((*row).clone())).cloned().collect()
    }
}

impl<S: GroundField> StructureTheory<S> {
    /// The closed 1-forms. They vanish on the derived algebra, and are a basis of the first
    /// cohomology.
    pub fn closed_one_forms(&self) -> Subspace<S> {
        Subspace::kernel(self.dimension(), self.derived().basis().iter().cloned())
    }

    /// The differential `d a` of a 1-form.
    pub fn differential(&self, form: &[(usize, S)]) -> Row<S> {
        let n = self.dimension();
        let value = |i: usize| form.iter().find(|(at, _)| *at == i).map(|(_, v)| v);
        let terms = (0..n).flat_map(|j| {
            let line = self.products.of(j).iter().filter(move |(k, ..)| j < *k);
            line.filter_map(move |(k, i, c)| Some((j * n + k, -(c.clone() * value(*i)?))))
        });
        collected(terms.collect())
    }

    /// The closed and the exact 2-forms. Returns `None` beyond [`MAX_DIMENSION`]. Beyond dimension
    /// 12, also returns `None` if there are parameters or more than 4000 structure constants
    /// `c^i_jk`.
    pub fn two_forms(&self) -> Option<TwoForms<S>> {
        let _stage = stage("forms");
        let n = self.dimension();
        let constants = self.algebra().structure_constants();
        let few = constants.len() <= MAX_CONSTANTS;
        let low = few && constants.components().all(|(_, value)| value.rational().is_some());
        if n > MAX_DIMENSION || n > MAX_ANY && !low {
            return None;
        }
        let mut equations = vec![];
        for i in 0..n {
            for j in i + 1..n {
                for k in j + 1..n {
                    let cyclic = [(i, j, k), (j, k, i), (k, i, j)];
                    let terms = cyclic.into_iter().flat_map(|(a, b, c)| {
                        let line = self.products.of(a).iter().filter(move |(to, ..)| *to == b);
                        line.filter(move |(_, m, _)| *m != c).map(move |(_, m, value)| {
                            match *m < c {
                                true => (m * n + c, value.clone()),
                                false => (c * n + m, -value.clone()),
                            }
                        })
                    });
                    equations.push(collected(terms.collect()));
                }
            }
        }
        // sets the components on and below the diagonal to zero, because they are not unknowns
        equations.extend((0..n).flat_map(|i| (0..=i).map(move |j| vec![(i * n + j, S::one())])));
        equations.retain(|row| !row.is_empty());
        let closed = Subspace::kernel_of_long(n * n, equations);
        let exact = (0..n).map(|i| self.differential(&[(i, S::one())]));
        Some(TwoForms { closed, exact: Subspace::span(n * n, exact) })
    }
}
