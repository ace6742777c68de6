//! Differential forms: `dd = 0`, products, Cartan's formula, and his structure equations.

use crate::common::algebras::{algebras, catalogued};
use crate::common::charts::{Moved, affine, constant, heisenberg, special_linear};
use crate::common::{integer, property::properties, rationals, spaces, stored};
use affinor::{Bracket, Error, Form, Frame, LieAlgebra};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Rational, Scalar, Symbolic, Tensor, Up};
use proptest::collection::vec;
use proptest::prelude::*;

/// The form with independent components in the order of their indices.
fn form<S: Scalar>(n: usize, degree: usize, values: &[S]) -> Form<S> {
    let increasing = increasing(n, degree);
    let components = increasing.iter().zip(values.iter().cycle()).flat_map(|(at, value)| {
        permutations(at).into_iter().map(move |(at, sign)| (at, value.clone() * &S::from_i64(sign)))
    });
    Form::new(Tensor::from_components(n, &vec![Down; degree], components).unwrap()).unwrap()
}

fn increasing(n: usize, degree: usize) -> Vec<Vec<usize>> {
    (0..1u32 << n)
        .filter(|set| set.count_ones() as usize == degree)
        .map(|set| (0..n).filter(|i| set >> i & 1 == 1).collect())
        .collect()
}

fn permutations(at: &[usize]) -> Vec<(Vec<usize>, i64)> {
    if at.is_empty() {
        return vec![(vec![], 1)];
    }
    let shortened = |first: usize| {
        let rest: Vec<_> = at.iter().copied().filter(|i| *i != at[first]).collect();
        let sign = if first.is_multiple_of(2) { 1 } else { -1 };
        permutations(&rest)
            .into_iter()
            .map(move |(rest, parity)| ([&[at[first]], &rest[..]].concat(), sign * parity))
    };
    (0..at.len()).flat_map(shortened).collect()
}

fn add<S: Scalar>(a: &Form<S>, b: &Form<S>, factor: i64) -> Form<S> {
    let scaled = b.components().scale(&S::from_i64(factor));
    let both = stored(a.components()).into_iter().chain(stored(&scaled));
    let (n, slots) = (a.components().dimension(), a.components().slots());
    Form::new(Tensor::from_components(n, slots, both).unwrap()).unwrap()
}

fn sign(degree: usize) -> i64 {
    if degree.is_multiple_of(2) { 1 } else { -1 }
}

/// Laws for two forms and a field in any frame of a manifold.
fn laws<S: Scalar>(frame: &Frame<S>, a: &Form<S>, b: &Form<S>, x: &Tensor<S>) {
    let d = |form: &Form<S>| frame.exterior_derivative(form).unwrap();
    let lie =
        |form: &Form<S>| Form::new(frame.lie_derivative(x, form.components()).unwrap()).unwrap();
    let wedge = |a: &Form<S>, b: &Form<S>| a.wedge(b).unwrap();
    let (p, q) = (a.degree(), b.degree());
    assert!(d(&d(a)).is_zero());
    let checked = Form::new(d(a).components().clone()).unwrap();
    assert_eq!(checked, d(a));
    // d(a ^ b) = da ^ b + (-1)^p a ^ db, a ^ b = (-1)^(pq) b ^ a
    let product = wedge(a, b);
    assert_eq!(Form::new(product.components().clone()).unwrap(), product);
    assert_eq!(d(&product), add(&wedge(&d(a), b), &wedge(a, &d(b)), sign(p)));
    let zero = add(&product, &product, -1);
    assert_eq!(product, add(&zero, &wedge(b, a), sign(p * q)));
    // i(a ^ b) = ia ^ b + (-1)^p a ^ ib, ii = 0
    let i = |form: &Form<S>| form.interior(x).unwrap();
    if p > 0 && q > 0 {
        assert_eq!(i(&product), add(&wedge(&i(a), b), &wedge(a, &i(b)), sign(p)));
        assert!(i(&i(a)).is_zero());
        // Cartan: L = d i + i d
        assert_eq!(lie(a), add(&d(&i(a)), &i(&d(a)), 1));
    } else if p == 0 {
        assert!(i(a).is_zero());
        assert_eq!(lie(a), i(&d(a)));
    }
    assert_eq!(lie(&d(a)), d(&lie(a)));
    assert_eq!(lie(&product), add(&wedge(&lie(a), b), &wedge(a, &lie(b)), 1));
}

properties! {
    #![cases(24)]

    #[test]
    fn left_invariant_forms(
        (algebra, p, q) in (algebras(5), 0..=2usize, 0..=2usize),
        values in vec(rationals(), 37),
    ) {
        let n = algebra.dimension();
        let (a, b) = (form(n, p, &values), form(n, q, &values[3..]));
        let x = Tensor::vector(&values[values.len() - n..], Up);
        laws(algebra.left_frame(), &a, &b, &x);
    }

    /// `dw(x,y) = -w([x,y])`. `dd = 0` holds for Lie brackets only: `dd e^i` is the Jacobi
    /// residual.
    #[test]
    fn maurer_cartan(n in 3..=5usize, values in vec(rationals(), 60)) {
        let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k)));
        let places = pairs.flat_map(|(j, k)| (0..n).map(move |i| (j, k, i)));
        let constants = places.zip(values).map(|((j, k, i), value)| (j, k, i, value));
        let bracket = Bracket::from_constants(crate::common::labels(n), constants).unwrap();
        let frame = Frame::invariant(crate::common::labels(n), bracket.structure_constants().clone()).unwrap();
        let jacobi = bracket.jacobi();
        for (i, e) in frame.coframe().iter().enumerate() {
            let de = frame.exterior_derivative(e).unwrap();
            for [j, k] in (0..n * n).map(|key| [key / n, key % n]) {
                prop_assert_eq!(de.components().get(&[j, k]), -bracket.structure_constants().get(&[i, j, k]));
            }
            let dde = frame.exterior_derivative(&de).unwrap();
            for at in increasing(n, 3) {
                let residual = jacobi.get(&[i, at[0], at[1], at[2]]);
                prop_assert_eq!(dde.components().get(&at), residual);
            }
        }
        prop_assert_eq!(LieAlgebra::try_from(bracket).is_ok(), jacobi.is_empty());
    }

    /// Cartan's structure equations are (B10) and (B14).
    #[test]
    fn structure_equations(space in spaces(4)) {
        let n = space.dimension();
        for connection in space.connections() {
            let (torsion, curvature) = (connection.torsion(), connection.curvature());
            let forms = connection.torsion_forms().unwrap();
            let curvatures = connection.curvature_forms().unwrap();
            for [i, j, k, l] in (0..n.pow(4)).map(|key| [3, 2, 1, 0].map(|p| key / n.pow(p) % n)) {
                prop_assert_eq!(forms[i].components().get(&[j, k]), torsion.get(&[i, j, k]));
                let form = curvatures[i][j].components();
                prop_assert_eq!(form.get(&[k, l]), curvature.get(&[i, j, k, l]));
            }
        }
    }

    /// By the definition, `(a ^ b)(x_1, ..)` as a sum over all permutations.
    #[test]
    fn products((p, q) in (0..=3usize, 0..=2usize), values in vec(rationals(), 23)) {
        let n = 4;
        let (a, b) = (form(n, p, &values), form(n, q, &values[5..]));
        let product = a.wedge(&b).unwrap();
        let factorial = |k: usize| (1..=k as i64).product::<i64>();
        for at in increasing(n, p + q) {
            let terms = permutations(&at).into_iter().map(|(at, sign)| {
                let (mine, theirs) = (a.components().get(&at[..p]), b.components().get(&at[p..]));
                mine * &theirs * &integer(sign)
            });
            let sum = terms.fold(integer(0), |sum, term| sum + &term);
            let weight = integer(factorial(p) * factorial(q));
            prop_assert_eq!(product.components().get(&at) * &weight, sum);
        }
    }
}

/// Components that are functions, in coordinates and in moving frames.
#[test]
fn any_frame() {
    for chart in [heisenberg(), affine(), special_linear()] {
        let (n, names) = (chart.dimension(), chart.names);
        let values: Vec<_> = (1..6)
            .map(|k| {
                let [a, b] = [k, 2 * k + 1].map(|at| Symbolic::parameter(names[at % n]));
                a * &b + &constant(k as i64 - 2)
            })
            .collect();
        let b = Symbolic::parameter(names[0]);
        let scales: Vec<_> = (0..n).map(|i| b.clone() + &constant(i as i64 + 1)).collect();
        let moving = Moved::scaled(&chart, &scales, b).frame();
        for frame in [Frame::coordinates(names).unwrap(), moving] {
            let x = Tensor::vector(&values[..n], Up);
            for (p, q) in [(0, 1), (1, 0), (1, 1), (2, 1), (0, 0), (2, 0)] {
                laws(&frame, &form(n, p, &values), &form(n, q, &values[1..]), &x);
            }
        }
        // d does not depend on the frame
        let left = Moved::new(&chart, Tensor::identity(n));
        let forms = crate::common::inverse(&chart.fields);
        let here = form(n, 1, &values);
        let there =
            Form::new(crate::common::transform(here.components(), &chart.fields, &forms)).unwrap();
        let d = Frame::coordinates(names).unwrap().exterior_derivative(&here).unwrap();
        let moved = crate::common::transform(d.components(), &chart.fields, &forms);
        assert_eq!(left.frame().exterior_derivative(&there).unwrap().components(), &moved);
    }
}

/// The structure equations in frames with derivatives of the affinities.
#[test]
fn structure_equations_in_a_moving_frame() {
    let chart = affine();
    let b = Symbolic::parameter("b");
    let scales = [b.clone() + &constant(2), b.clone()];
    let moved = Moved::scaled(&chart, &scales, Symbolic::parameter("a"));
    let gamma = Tensor::from_fn(2, [Up, Down, Down], |[i, j, k]| {
        b.clone() * &constant((i + 2 * j) as i64) + &constant(k as i64)
    });
    let connection = affinor::Connection::new(moved.frame(), gamma.unwrap()).unwrap();
    let curvature = connection.curvature();
    let forms = connection.curvature_forms().unwrap();
    let torsions = connection.torsion_forms().unwrap();
    for [i, j] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
        assert_eq!(forms[i][j].components().get(&[0, 1]), curvature.get(&[i, j, 0, 1]));
        assert_eq!(torsions[i].components().get(&[0, 1]), connection.torsion().get(&[i, 0, 1]));
    }
}

/// The rank of `d` on left-invariant forms of a degree.
fn rank(algebra: &LieAlgebra<Rational>, degree: usize) -> usize {
    let n = algebra.dimension();
    let places = increasing(n, degree + 1);
    let rows = increasing(n, degree).into_iter().map(|at| {
        let components = permutations(&at).into_iter().map(|(at, sign)| (at, integer(sign)));
        let unit = Tensor::from_components(n, &vec![Down; degree], components).unwrap();
        let d = algebra.left_frame().exterior_derivative(&Form::new(unit).unwrap()).unwrap();
        let entries = places.iter().map(|at| d.components().get(at)).enumerate();
        entries.collect::<Vec<_>>()
    });
    Matrix::from_rows(places.len(), rows).unwrap().rank().unwrap()
}

/// Betti numbers of C. Chevalley and S. Eilenberg's complex: a product of spheres of dimension 3
/// and 5 for su(3), of 3 for so(3); Heisenberg algebras by L. J. Santharoubane, *Proc. Amer. Math.
/// Soc.* 87 (1983) 23-28: `C(2m,p) - C(2m,p-2)` for `p <= m`.
#[test]
fn betti_numbers() {
    for (name, most, expected) in [
        ("so(3)", 3, vec![1, 0, 0, 1]),
        ("su(3)", 3, vec![1, 0, 0, 1]),
        ("R^3", 3, vec![1, 3, 3, 1]),
        ("heisenberg(3)", 3, vec![1, 2, 2, 1]),
        ("heisenberg(5)", 5, vec![1, 4, 5, 5, 4, 1]),
        ("aff(1)", 2, vec![1, 1, 0]),
        ("se(2)", 3, vec![1, 1, 1, 1]),
    ] {
        let algebra = catalogued(name);
        let n = algebra.dimension();
        let betti = (0..=most).map(|p| {
            let closed = increasing(n, p).len() - if p < n { rank(&algebra, p) } else { 0 };
            closed - if p > 0 { rank(&algebra, p - 1) } else { 0 }
        });
        assert_eq!(betti.collect::<Vec<_>>(), expected, "{name}");
    }
}

#[test]
fn what_is_no_form_is_refused() {
    let g = Tensor::<Rational>::from_fn(3, [Down, Down], |[i, j]| integer((i + j) as i64)).unwrap();
    let refused = Form::new(g).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the form is not antisymmetric in the slots 1 and 2: component 1,2 is off by 2"
    );
    assert!(matches!(Form::new(Tensor::<Rational>::identity(2)), Err(Error::Shape { .. })));
    // the degree of a form is limited
    let line = form(9, 8, &[integer(1)]);
    let frame =
        Frame::invariant(crate::common::labels(9), Tensor::zero(9, &[Up, Down, Down]).unwrap());
    assert!(matches!(frame.unwrap().exterior_derivative(&line), Err(Error::Tensor(_))));
    assert!(matches!(line.wedge(&form(9, 1, &[integer(1)])), Err(Error::Tensor(_))));
    let x = Tensor::vector(&vec![integer(1); 9], Up);
    assert_eq!(line.interior(&x).unwrap().degree(), 7);
    assert!(line.interior(&Tensor::vector(&[integer(1)], Up)).is_err());
    assert!(line.wedge(&form(8, 0, &[integer(1)])).is_err());
}
