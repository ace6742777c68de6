//! Section 3 by the library's own invariant fields, exactly: (28)-(36).
//!
//! They are those of canonical coordinates of the second kind, `exp(x1 e1) exp(x2 e2) ..`, in which any
//! of these algebras has a closed form.

use crate::common::charts::{constant, sum};
use crate::matrices::Basis;
use crate::on_groups::{commutator, differ, equal, on_every_group, vectors};
use crate::{algebras, assert_tensors, symbolic, value};
use affinor::chart::{Canonical as Kind, Chart, Fields, Side};
use affinor::group::LieGroup;
use affinor::{Canonical, Connection, Frame, LieAlgebra};
use affinor_tensors::{Symbolic, Tensor, Up, contract};

struct Group {
    name: &'static str,
    algebra: LieAlgebra<Symbolic>,
    left: Fields<Symbolic>,
    right: Fields<Symbolic>,
}

/// SE(3) is left to floats: its six coordinates make long functions.
fn groups() -> impl Iterator<Item = Group> {
    algebras().into_iter().filter(|(name, _)| *name != "se(3)").map(|(name, algebra)| {
        let algebra = symbolic(&algebra);
        let names: Vec<_> = (1..=algebra.dimension()).map(|a| format!("x{a}")).collect();
        let chart = Chart::new(&names).unwrap();
        let fields = |side| chart.invariant_fields(&algebra, Kind::Second, side).unwrap();
        let (left, right) = (fields(Side::Left), fields(Side::Right));
        Group { name, algebra, left, right }
    })
}

impl Group {
    fn n(&self) -> usize {
        self.algebra.dimension()
    }

    /// The left-invariant `e_j`, in left components as all fields here.
    fn e(&self, j: usize) -> Vec<Symbolic> {
        (0..self.n()).map(|i| constant(i64::from(i == j))).collect()
    }

    /// The right-invariant field through `e_j` at the identity.
    fn right(&self, j: usize) -> Vec<Symbolic> {
        let column = (0..self.n()).map(|a| self.right.components().get(&[a, j]));
        let field = Tensor::vector(&column.collect::<Vec<_>>(), Up);
        self.left.change().apply(&field).unwrap().to_vector().unwrap()
    }

    /// A field without a pattern.
    fn wild(&self) -> Vec<Symbolic> {
        let x = |a: usize| Symbolic::parameter(&format!("x{}", a % self.n() + 1));
        (0..self.n()).map(|i| x(i) * &x(i + 1) + &constant(i as i64 + 1)).collect()
    }

    fn frame(&self) -> &Frame<Symbolic> {
        self.left.frame()
    }

    fn bracket(&self, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        self.frame().bracket(x, y).unwrap()
    }

    /// `nabla_X Y` of a canonical connection over the left frame.
    fn nabla(&self, which: Canonical, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        let gamma = Connection::canonical(&self.algebra, which).gamma().clone();
        let connection = Connection::new(self.frame().clone(), gamma).unwrap();
        let nabla = connection.nabla(&Tensor::vector(y, Up)).unwrap();
        let operands = [("D", &nabla), ("X", &Tensor::vector(x, Up))];
        contract("D^i_m X^m -> ^i", &operands).unwrap().to_vector().unwrap()
    }

    /// The coefficients of `e_j` in the right-invariant fields: frozen at a point, they give the
    /// right-invariant field through `e_j` there.
    fn frozen(&self, j: usize) -> Vec<Symbolic> {
        let column = (0..self.n()).map(|a| self.left.components().get(&[a, j]));
        let field = Tensor::vector(&column.collect::<Vec<_>>(), Up);
        self.right.change().apply(&field).unwrap().to_vector().unwrap()
    }

    /// `1/2 [e_j, Y] + 1/2 a^m [R_m, Y]` with the numbers `a`.
    fn half(&self, j: usize, a: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        let left = self.bracket(&self.e(j), y);
        let right: Vec<_> = (0..self.n()).map(|m| self.bracket(&self.right(m), y)).collect();
        let of_right = |i: usize| sum(a.iter().zip(&right).map(|(a, b)| a.clone() * &b[i]));
        (0..self.n()).map(|i| (left[i].clone() + &of_right(i)) * &value("1/2")).collect()
    }
}

#[test]
fn eq_28_bracket_of_the_algebra_is_that_of_left_extensions() {
    for group in groups() {
        let c = group.algebra.structure();
        assert_tensors(group.left.frame().structure(), c, group.name);
        let minus = c.map(|v| -v.clone());
        assert_tensors(group.right.frame().structure(), &minus, group.name);
    }
    // of matrices the commutator, and not its negative
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [x, y, _] = vectors(group);
        let bracket = group.bracket(&x, &y);
        let bracket = crate::on_groups::column(&bracket);
        equal(&bracket, &commutator(basis, &x, &y), name);
        differ(&bracket, &commutator(basis, &y, &x), name);
    }
    on_every_group!(law);
}

#[test]
fn eq_29_plus_by_left_invariant_fields() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let nabla = group.nabla(Canonical::Plus, &group.e(j), &y);
            assert_eq!(nabla, group.bracket(&group.e(j), &y), "{} {j}", group.name);
        }
        let other = group.nabla(Canonical::Minus, &group.e(0), &y);
        assert_ne!(other, group.bracket(&group.e(0), &y), "{}", group.name);
    }
}

#[test]
fn eq_30_minus_by_right_invariant_fields() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let right = group.right(j);
            let nabla = group.nabla(Canonical::Minus, &right, &y);
            assert_eq!(nabla, group.bracket(&right, &y), "{} {j}", group.name);
        }
        let other = group.nabla(Canonical::Plus, &group.right(0), &y);
        assert_ne!(other, group.bracket(&group.right(0), &y), "{}", group.name);
    }
}

#[test]
fn eq_31_zero_by_half_of_both_through_the_same_vector() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let nabla = group.nabla(Canonical::Zero, &group.e(j), &y);
            assert_eq!(group.half(j, &group.frozen(j), &y), nabla, "{} {j}", group.name);
        }
    }
}

#[test]
fn before_39_right_invariant_fields_go_through_the_vector_at_p() {
    for group in groups() {
        let different = |j: &usize| group.frozen(*j) != group.e(*j);
        let j = (0..group.n()).find(different).unwrap();
        // through e_j(e), as the text builds them, a general field is differentiated wrongly ..
        let (y, through_identity) = (group.wild(), group.e(j));
        let nabla = group.nabla(Canonical::Zero, &group.e(j), &y);
        assert_ne!(group.half(j, &through_identity, &y), nabla, "{}", group.name);
        // .. and the frame is not, because [R, L] = 0 (35)
        for k in 0..group.n() {
            let nabla = group.nabla(Canonical::Zero, &group.e(j), &group.e(k));
            assert_eq!(group.half(j, &through_identity, &group.e(k)), nabla, "{}", group.name);
        }
    }
}

#[test]
fn eq_33_to_36_invariant_fields_commute_and_are_parallel() {
    for group in groups() {
        let n = group.n();
        let zero = vec![constant(0); n];
        for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
            // (33), (34): c does not depend on the point
            let c = (0..n).map(|i| group.algebra.structure().get(&[i, j, k])).collect::<Vec<_>>();
            assert_eq!(group.bracket(&group.e(j), &group.e(k)), c, "{}", group.name);
            assert_eq!(group.bracket(&group.e(j), &group.right(k)), zero, "{}", group.name);
            let plus = group.nabla(Canonical::Plus, &group.e(j), &group.right(k));
            assert_eq!(plus, zero, "{}", group.name);
            let minus = group.nabla(Canonical::Minus, &group.e(j), &group.e(k));
            assert_eq!(minus, zero, "{}", group.name);
        }
        // and crosswise they are not
        let all = |which, right: bool| {
            let field = |k| if right { group.right(k) } else { group.e(k) };
            let pairs = (0..n).flat_map(|j| (0..n).map(move |k| (j, k)));
            pairs.map(|(j, k)| group.nabla(which, &group.e(j), &field(k))).any(|v| v != zero)
        };
        assert!(all(Canonical::Plus, false) && all(Canonical::Minus, true), "{}", group.name);
        assert!(all(Canonical::Zero, false) && all(Canonical::Zero, true), "{}", group.name);
    }
}
