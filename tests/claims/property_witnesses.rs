//! Witnesses of properties that fail, multiplied out from the definitions with vectors alone.
//!
//! Guards the witnesses in `geometry::properties` and its files.

use crate::common::spaces::named;
use crate::common::{Space, fraction, integer, property::properties, spaces};
use affinor::geometry::properties::Witness;
use affinor::{Connection, Geometry, LieAlgebra, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Rational, Ring, Tensor, Up};

type Vector = Vec<Rational>;

fn unit(n: usize, at: usize) -> Vector {
    (0..n).map(|i| integer(i64::from(i == at))).collect()
}

fn minus(x: Vector, y: &[Rational]) -> Vector {
    x.into_iter().zip(y).map(|(x, y)| x - y).collect()
}

/// A connection with left-invariant affinities, on left-invariant fields.
struct Nabla<'a> {
    algebra: &'a LieAlgebra<Rational>,
    gamma: &'a Tensor<Rational>,
}

impl Nabla<'_> {
    /// `nabla_x y`
    fn along(&self, x: &[Rational], y: &[Rational]) -> Vector {
        let mut image = vec![integer(0); x.len()];
        for (at, value) in self.gamma.components() {
            let term = value.clone() * &x[at[1]] * &y[at[2]];
            image[at[0]] = image[at[0]].clone() + &term;
        }
        image
    }

    /// `tau(x, y) = nabla_x y - nabla_y x - [x, y]`
    fn torsion(&self, x: &[Rational], y: &[Rational]) -> Vector {
        let difference = minus(self.along(x, y), &self.along(y, x));
        minus(difference, &self.algebra.bracket(x, y).unwrap())
    }

    /// `R(x, y) z`
    fn curvature(&self, x: &[Rational], y: &[Rational], z: &[Rational]) -> Vector {
        let first = self.along(x, &self.along(y, z));
        let commutator = minus(first, &self.along(y, &self.along(x, z)));
        minus(commutator, &self.along(&self.algebra.bracket(x, y).unwrap(), z))
    }

    /// The component that a witness names, by the Leibniz rule.
    fn component(&self, witness: &Witness<Rational>) -> Rational {
        let n = self.algebra.dimension();
        let e = |position: usize| unit(n, witness.indices[position]);
        let image = match witness.letters {
            "ijk" => self.torsion(&e(1), &e(2)),
            "ijkl" => self.curvature(&e(2), &e(3), &e(1)),
            "imjk" => {
                let (m, j, k) = (e(1), e(2), e(3));
                let whole = self.along(&m, &self.torsion(&j, &k));
                let first = self.torsion(&self.along(&m, &j), &k);
                minus(minus(whole, &first), &self.torsion(&j, &self.along(&m, &k)))
            }
            "imjkl" => {
                let (m, j, k, l) = (e(1), e(2), e(3), e(4));
                let whole = self.along(&m, &self.curvature(&k, &l, &j));
                let parts = [
                    self.curvature(&self.along(&m, &k), &l, &j),
                    self.curvature(&k, &self.along(&m, &l), &j),
                    self.curvature(&k, &l, &self.along(&m, &j)),
                ];
                parts.iter().fold(whole, |rest, part| minus(rest, part))
            }
            other => panic!("letters {other}"),
        };
        image[witness.indices[0]].clone()
    }

    /// Checks the witness of each property that fails. Returns the number of witnesses.
    fn multiply_out(&self, connection: &Connection<Rational>) -> usize {
        let found = [
            connection.torsion_free(),
            connection.flat(),
            connection.parallel_torsion(),
            connection.parallel_curvature(),
            connection.locally_symmetric(),
        ];
        let witnesses: Vec<_> =
            found.into_iter().filter_map(|property| property.witness()).collect();
        for witness in &witnesses {
            assert!(!witness.residual.vanishes());
            assert_eq!(self.component(witness), witness.residual, "{witness}");
        }
        witnesses.len()
    }
}

fn of_space(space: &Geometry<Rational>) -> usize {
    let (algebra, connection) = (space.algebra().unwrap(), space.connection());
    Nabla { algebra, gamma: connection.affinities() }.multiply_out(connection)
}

#[test]
fn of_metrics_that_are_not_symmetric() {
    // flat and parallel curvature, and local symmetry
    for (name, metric, count) in [
        ("heisenberg(3)", "identity", 3),
        ("so3", "diag(1,2,3)", 3),
        ("bianchi(IV)", "identity", 3),
        ("heisenberg(5)", "diag(1,2,3,4,5)", 3),
        ("so3", "identity", 1),
    ] {
        assert_eq!(of_space(&named(name, metric)), count, "{name} {metric}");
    }
}

properties! {
    #![cases(16)]

    /// Random affinities, including torsion and its derivative.
    #[test]
    fn of_random_connections(space in spaces(4)) {
        let Space { algebra, affinities, .. } = &space;
        Nabla { algebra, gamma: affinities }.multiply_out(&space.connection());
    }
}

/// The rows `(equation, constant)` of the conditions on `phi^i_j`, unknown `i n + j`, in the order of the search: first
/// `phi([a,x]) = [a, phi x]` and `phi` in `k`, then `g([x,y],z) + .. = 0` for `x`, `y`, `z` in order.
fn conditions(space: &Geometry<Rational>) -> [Vec<(Vector, Rational)>; 2] {
    let (algebra, metric) = (space.algebra().unwrap(), space.metric().unwrap());
    let n = algebra.dimension();
    let g = |x: &[Rational], y: &[Rational]| {
        let lowered = metric.lower(x).unwrap();
        lowered.iter().zip(y).fold(integer(0), |sum, (a, b)| sum + &(a.clone() * b))
    };
    let fields = metric.killing_fields(algebra).unwrap();
    let bracket = |x: &[Rational], y: &[Rational]| algebra.bracket(x, y).unwrap();
    // the images of the matrix units phi = E^i_j: e_j -> e_i
    let (mut linear, mut others) = (vec![], vec![]);
    for a in &fields {
        for (x, component) in (0..n).flat_map(|x| (0..n).map(move |q| (x, q))) {
            let mut row = vec![integer(0); n * n];
            let moved = bracket(a, &unit(n, x));
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let first = if i == component { moved[j].clone() } else { integer(0) };
                let second = bracket(a, &unit(n, i))[component].clone();
                row[i * n + j] = if j == x { first - &second } else { first };
            }
            linear.push((row, integer(0)));
        }
    }
    // phi x in k: forms that vanish on k vanish on phi x
    let forms = match fields.is_empty() {
        true => Matrix::identity(n),
        false => Matrix::from_dense(&fields).unwrap().nullspace().unwrap(),
    };
    for (at, x) in (0..forms.rows()).flat_map(|at| (0..n).map(move |x| (at, x))) {
        let mut row = vec![integer(0); n * n];
        forms.row(at).iter().for_each(|(i, value)| row[i * n + x] = value.clone());
        linear.push((row, integer(0)));
    }
    for [x, y, z] in (0..n.pow(3)).map(|key| [key / n / n, key / n % n, key % n]) {
        let (ex, ey, ez) = (unit(n, x), unit(n, y), unit(n, z));
        let mut row = vec![integer(0); n * n];
        for i in 0..n {
            let image = bracket(&ex, &unit(n, i));
            row[i * n + y] = row[i * n + y].clone() + &g(&image, &ez);
            row[i * n + z] = row[i * n + z].clone() + &g(&ey, &image);
        }
        others.push((row, g(&bracket(&ex, &ey), &ez) + &g(&ey, &bracket(&ex, &ez))));
    }
    [linear, others]
}

fn solvable(equations: &[&(Vector, Rational)]) -> bool {
    let rows: Vec<Vector> = equations.iter().map(|(row, _)| row.clone()).collect();
    let right: Vector = equations.iter().map(|(_, constant)| -constant.clone()).collect();
    Matrix::from_dense(&rows).unwrap().solve(&right).unwrap().is_some()
}

/// The equations before the witness have a solution; together with the witness they have none.
#[test]
fn of_metrics_that_are_not_naturally_reductive() {
    let mut failures = 0;
    for (name, diagonal) in [
        ("so3", vec![1, 2, 3]),
        ("heisenberg(3)", vec![1, 1, 1]),
        ("bianchi(IV)", vec![1, 1, 1]),
        ("se(2)", vec![1, 2, 1]),
        ("so4", vec![1, 1, 2, 1, 1, 1]),
        ("sl2", vec![1, 2, 5]),
    ] {
        let written: Vec<String> = diagonal.iter().map(i64::to_string).collect();
        let space = named(name, &format!("diag({})", written.join(",")));
        let (algebra, metric) = (space.algebra().unwrap(), space.metric().unwrap());
        let n = algebra.dimension();
        let [linear, others] = conditions(&space);
        let Some(witness) = metric.naturally_reductive(algebra).unwrap().witness() else {
            let all: Vec<_> = linear.iter().chain(&others).collect();
            assert!(solvable(&all), "{name}");
            continue;
        };
        failures += 1;
        assert_eq!(witness.letters, "kij");
        let place = witness.indices.iter().fold(0, |place, at| place * n + at);
        let before: Vec<_> = linear.iter().chain(&others[..place]).collect();
        let with: Vec<_> = linear.iter().chain(&others[..=place]).collect();
        assert!(solvable(&before) && !solvable(&with), "{name}: {witness}");
    }
    assert!(failures >= 3, "{failures}");
    // a solution that the search finds satisfies these equations too
    let space = named("so3", "diag(1,1,2)");
    let (algebra, metric) = (space.algebra().unwrap(), space.metric().unwrap());
    let phi = metric.naturally_reductive(algebra).unwrap().holds().unwrap();
    let [linear, others] = conditions(&space);
    for (row, constant) in linear.iter().chain(&others) {
        let terms = row.iter().enumerate().map(|(at, v)| v.clone() * &phi.get(&[at / 3, at % 3]));
        assert!(terms.fold(constant.clone(), |sum, term| sum + &term).vanishes());
    }
}

/// `g([e_k, e_i], e_j) + g(e_i, [e_k, e_j])` at the witness.
#[test]
fn of_metrics_that_are_not_bi_invariant() {
    let space = named("so4", "diag(1,1,2,1,1,1/3)");
    let (algebra, metric) = (space.algebra().unwrap(), space.metric().unwrap());
    let witness = metric.bi_invariant(algebra).unwrap().witness().unwrap();
    let [k, i, j] = [0, 1, 2].map(|position| unit(6, witness.indices[position]));
    let product = |metric: &Metric<Rational>, x: &[Rational], y: &[Rational]| {
        let lowered = metric.lower(x).unwrap();
        lowered.iter().zip(y).fold(integer(0), |sum, (a, b)| sum + &(a.clone() * b))
    };
    let first = product(metric, &algebra.bracket(&k, &i).unwrap(), &j);
    let second = product(metric, &i, &algebra.bracket(&k, &j).unwrap());
    assert_eq!(first + &second, witness.residual);
    assert_ne!(witness.residual, fraction(0, 1));
    assert_eq!(metric.components().slots(), [Down, Down]);
    assert_eq!(space.connection().affinities().slots(), [Up, Down, Down]);
}
