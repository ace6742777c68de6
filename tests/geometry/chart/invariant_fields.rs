//! The canonical connections by brackets with invariant fields, exactly: equations (28)-(39),
//! (101), (105), (A8) and (B6) of the paper for general fields. The rows of the document use
//! parallel transport in floats instead.
//!
//! The fields are those of canonical coordinates of the second kind, `exp(x1 e1) exp(x2 e2) ...`, in which any of these
//! algebras has a closed form.

use crate::common::algebras::{catalogued, symbolic};
use crate::common::charts::{constant, sum, value};
use crate::common::labels;
use affinor::geometry::chart::{CanonicalCoordinates as Kind, Chart, Fields, Side};
use affinor::{BasisChange, CanonicalConnection, Connection, Frame, LieAlgebra};
use affinor_tensors::{Down, Symbolic, Tensor, Up, contract};

struct Group {
    name: &'static str,
    algebra: LieAlgebra<Symbolic>,
    left: Fields<Symbolic>,
    right: Fields<Symbolic>,
}

fn groups() -> impl Iterator<Item = Group> {
    ["so(3)", "sl(2)", "heisenberg(3)", "aff(1)", "se(2)"].into_iter().map(|name| {
        let algebra = symbolic(&catalogued(name));
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

    /// The left-invariant `e_j`, in left-invariant components as all fields here.
    fn e(&self, j: usize) -> Vec<Symbolic> {
        (0..self.n()).map(|i| constant(i64::from(i == j))).collect()
    }

    /// The right-invariant field through `e_j` at the identity.
    fn right(&self, j: usize) -> Vec<Symbolic> {
        let column = (0..self.n()).map(|a| self.right.components().get(&[a, j]));
        let field = Tensor::vector(&column.collect::<Vec<_>>(), Up);
        self.left.change().apply(&field).unwrap().to_vector().unwrap()
    }

    /// A field without symmetries.
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
    fn nabla(&self, which: CanonicalConnection, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        let gamma = Connection::canonical(&self.algebra, which).affinities().clone();
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

    /// `1/2 [e_j, Y] + 1/2 a^m [R_m, Y]` with the constants `a`.
    fn half(&self, j: usize, a: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        let left = self.bracket(&self.e(j), y);
        let right: Vec<_> = (0..self.n()).map(|m| self.bracket(&self.right(m), y)).collect();
        let of_right = |i: usize| sum(a.iter().zip(&right).map(|(a, b)| a.clone() * &b[i]));
        (0..self.n()).map(|i| (left[i].clone() + &of_right(i)) * &value("1/2")).collect()
    }
}

/// (28): the bracket of the algebra is the bracket of left-invariant extensions.
#[test]
fn left_extensions_have_the_structure_constants_and_right_extensions_their_negatives() {
    for group in groups() {
        let c = group.algebra.structure_constants();
        assert_eq!(group.left.frame().structure_functions(), c, "{}", group.name);
        assert_eq!(
            group.right.frame().structure_functions(),
            &c.map(|v| -v.clone()),
            "{}",
            group.name
        );
    }
}

/// (29): `nabla_X Y = [X^L, Y]`.
#[test]
fn plus_is_the_bracket_with_left_invariant_fields() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let nabla = group.nabla(CanonicalConnection::Plus, &group.e(j), &y);
            assert_eq!(nabla, group.bracket(&group.e(j), &y), "{} {j}", group.name);
        }
        let other = group.nabla(CanonicalConnection::Minus, &group.e(0), &y);
        assert_ne!(other, group.bracket(&group.e(0), &y), "{}", group.name);
    }
}

/// (30): `nabla_X Y = [X^R, Y]`.
#[test]
fn minus_is_the_bracket_with_right_invariant_fields() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let right = group.right(j);
            let nabla = group.nabla(CanonicalConnection::Minus, &right, &y);
            assert_eq!(nabla, group.bracket(&right, &y), "{} {j}", group.name);
        }
        let other = group.nabla(CanonicalConnection::Plus, &group.right(0), &y);
        assert_ne!(other, group.bracket(&group.right(0), &y), "{}", group.name);
    }
}

/// (31): `nabla_X Y = 1/2 [X^L + X^R, Y]`, both fields through `X(p)`.
#[test]
fn zero_is_half_the_bracket_with_both_fields_through_the_same_vector() {
    for group in groups() {
        let y = group.wild();
        for j in 0..group.n() {
            let nabla = group.nabla(CanonicalConnection::Zero, &group.e(j), &y);
            assert_eq!(group.half(j, &group.frozen(j), &y), nabla, "{} {j}", group.name);
        }
    }
}

/// Text before (39): `X^R` is the field through `X(p)`, not through `X(e)`.
#[test]
fn right_invariant_fields_through_the_identity_give_another_connection() {
    for group in groups() {
        let different = |j: &usize| group.frozen(*j) != group.e(*j);
        let j = (0..group.n()).find(different).unwrap();
        // with the fields through e_j(e), as in the text, a general field is differentiated
        // wrongly,
        let (y, through_identity) = (group.wild(), group.e(j));
        let nabla = group.nabla(CanonicalConnection::Zero, &group.e(j), &y);
        assert_ne!(group.half(j, &through_identity, &y), nabla, "{}", group.name);
        // but the frame is not, because [R, L] = 0 (35)
        for k in 0..group.n() {
            let nabla = group.nabla(CanonicalConnection::Zero, &group.e(j), &group.e(k));
            assert_eq!(group.half(j, &through_identity, &group.e(k)), nabla, "{}", group.name);
        }
    }
}

/// (33)-(36): left- and right-invariant fields commute, and are parallel.
#[test]
fn left_and_right_invariant_fields_commute_and_are_parallel() {
    for group in groups() {
        let n = group.n();
        let zero = vec![constant(0); n];
        for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
            // (33), (34): c does not depend on the point
            let c = (0..n)
                .map(|i| group.algebra.structure_constants().get(&[i, j, k]))
                .collect::<Vec<_>>();
            assert_eq!(group.bracket(&group.e(j), &group.e(k)), c, "{}", group.name);
            assert_eq!(group.bracket(&group.e(j), &group.right(k)), zero, "{}", group.name);
            let plus = group.nabla(CanonicalConnection::Plus, &group.e(j), &group.right(k));
            assert_eq!(plus, zero, "{}", group.name);
            let minus = group.nabla(CanonicalConnection::Minus, &group.e(j), &group.e(k));
            assert_eq!(minus, zero, "{}", group.name);
        }
        // but not the other way round
        let all = |which, right: bool| {
            let field = |k| if right { group.right(k) } else { group.e(k) };
            let pairs = (0..n).flat_map(|j| (0..n).map(move |k| (j, k)));
            pairs.map(|(j, k)| group.nabla(which, &group.e(j), &field(k))).any(|v| v != zero)
        };
        assert!(
            all(CanonicalConnection::Plus, false) && all(CanonicalConnection::Minus, true),
            "{}",
            group.name
        );
        assert!(
            all(CanonicalConnection::Zero, false) && all(CanonicalConnection::Zero, true),
            "{}",
            group.name
        );
    }
}

/// (A8): the structure functions are constant in invariant frames.
#[test]
fn structure_functions_are_constant_in_invariant_frames() {
    for group in groups() {
        let coordinates = group.left.chart().coordinate_frame::<Symbolic>().unwrap();
        let field = |j: usize| -> Vec<Symbolic> {
            (0..group.n()).map(|a| group.left.components().get(&[a, j])).collect()
        };
        // [e_j, e_k] = c^i_jk e_i with both sides in coordinates
        for (j, k) in (0..group.n()).flat_map(|j| (0..group.n()).map(move |k| (j, k))) {
            let found = coordinates.bracket(&field(j), &field(k)).unwrap();
            for (a, found) in found.iter().enumerate() {
                let terms = (0..group.n())
                    .map(|i| group.algebra.structure_constants().get(&[i, j, k]) * &field(i)[a]);
                assert_eq!(*found, sum(terms), "{} {j} {k}", group.name);
            }
        }
    }
    // in another frame they are functions: e_1, x1 e_2 with [e_1, e_2] = e_2 on Aff(1)
    let group = groups().find(|group| group.name == "aff(1)").unwrap();
    let scaled = [([0, 0], value("1")), ([1, 1], value("x1"))];
    let scaled = Tensor::from_components(2, &[Up, Down], scaled).unwrap();
    let moved = group.frame().moved(labels(2), &BasisChange::new(scaled).unwrap()).unwrap();
    assert_eq!(moved.structure_functions().get(&[1, 0, 1]), value("1 + 1/x1"));
}

/// (B6): invariant fields are parallel along themselves.
#[test]
fn invariant_fields_are_parallel_along_themselves() {
    for group in groups() {
        let n: Vec<_> = (0..group.n()).map(|i| constant(2 * i as i64 - 1)).collect();
        let through_identity = |side: Side| match side {
            Side::Left => n.clone(),
            Side::Right => {
                let fields: Vec<_> = (0..group.n()).map(|m| group.right(m)).collect();
                (0..group.n())
                    .map(|i| sum(n.iter().zip(&fields).map(|(n, f)| n.clone() * &f[i])))
                    .collect()
            }
        };
        let zero = vec![constant(0); group.n()];
        for side in [Side::Left, Side::Right] {
            let x = through_identity(side);
            for which in
                [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
            {
                assert_eq!(group.nabla(which, &x, &x), zero, "{} {which:?}", group.name);
            }
        }
        // a random field is not
        assert_ne!(group.nabla(CanonicalConnection::Zero, &group.wild(), &group.wild()), zero);
    }
}

/// A dense symmetric matrix of constants.
fn inertia(n: usize) -> Tensor<Symbolic> {
    let entry = |i: usize, j: usize| if i == j { 3 + i as i64 } else { (i + j) as i64 % 2 };
    Tensor::from_fn(n, [Down, Down], |[i, j]| constant(entry(i, j))).unwrap()
}

/// (101): left translations preserve a metric with constant components.
#[test]
fn left_translations_preserve_a_metric_of_constant_components() {
    for group in groups() {
        let j = inertia(group.n());
        // left translations preserve it: they are the flows of right-invariant fields
        let along = |field: Vec<Symbolic>| {
            group.frame().lie_derivative(&Tensor::vector(&field, Up), &j).unwrap()
        };
        assert!((0..group.n()).all(|k| along(group.right(k)).is_empty()), "{}", group.name);
        // right translations do not preserve it
        assert!((0..group.n()).any(|k| !along(group.e(k)).is_empty()), "{}", group.name);
        assert!(group.frame().derivative(&j).unwrap().is_empty());
    }
}

/// (105): the derivative of a covector includes the derivative of the dual frame.
#[test]
fn covariant_derivatives_of_covectors_include_the_dual_frame() {
    for group in groups() {
        let (n, omega, h) = (group.n(), group.e(0), group.wild());
        let gamma =
            Connection::canonical(&group.algebra, CanonicalConnection::Plus).affinities().clone();
        let plus = Connection::new(group.frame().clone(), gamma).unwrap();
        let of = |covector: &[Symbolic], i: usize| {
            let nabla = plus.nabla(&Tensor::vector(covector, Down)).unwrap();
            sum((0..n).map(|k| nabla.get(&[k, i]) * &omega[k]))
        };
        for i in 0..n {
            // Hdot_i + H_j (nabla_k e^j)_i Omega^k
            let rate = sum((0..n).map(|k| group.frame().derive(k, &h[i]) * &omega[k]));
            let turned = sum((0..n).map(|j| h[j].clone() * &of(&group.e(j), i)));
            assert_eq!(of(&h, i), rate + &turned, "{} {i}", group.name);
        }
    }
}
