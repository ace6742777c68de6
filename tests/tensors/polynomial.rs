//! Real solutions of polynomial systems, against systems whose solutions are known by construction.

use affinor_tensors::polynomial::{RealNumber, SolutionSet, System, distinct_factors};
use affinor_tensors::stop::{StopReason, StopToken};
use affinor_tensors::{Rational, Ring, Symbolic};
use std::cmp::Ordering;
use std::collections::BTreeSet;

fn parse(text: &str) -> Symbolic {
    text.parse().unwrap()
}

fn names(letters: &str) -> Vec<String> {
    letters.split_whitespace().map(String::from).collect()
}

fn system(letters: &str, equations: &[&str], nonzero: &[&str]) -> System {
    let all = |texts: &[&str]| texts.iter().map(|text| parse(text)).collect::<Vec<_>>();
    System::new(&names(letters), &all(equations), &all(nonzero)).unwrap()
}

fn solve(letters: &str, equations: &[&str], nonzero: &[&str]) -> SolutionSet {
    system(letters, equations, nonzero).solve().unwrap()
}

/// The points as text.
fn points(found: &SolutionSet) -> BTreeSet<String> {
    let text = |values: &[RealNumber]| {
        values.iter().map(RealNumber::to_string).collect::<Vec<_>>().join(",")
    };
    let all: BTreeSet<String> = found.points.iter().map(|point| text(point.values())).collect();
    assert_eq!(all.len(), found.points.len(), "points occur twice");
    all
}

fn families(found: &SolutionSet) -> BTreeSet<String> {
    let text = |equations: &[Symbolic]| {
        equations.iter().map(Symbolic::to_string).collect::<Vec<_>>().join(", ")
    };
    found.families.iter().map(|family| text(&family.equations)).collect()
}

fn set<const N: usize>(texts: [&str; N]) -> BTreeSet<String> {
    texts.map(String::from).into()
}

/// Small pseudo-random integers, the same in every run.
struct Draw(u64);

impl Draw {
    fn next(&mut self, low: i64, high: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + ((self.0 >> 33) % (high - low + 1) as u64) as i64
    }
}

#[test]
fn known_systems() {
    assert_eq!(
        points(&solve("x y", &["x^2 + y^2 - 5", "x*y - 2"], &[])),
        set(["1,2", "2,1", "-1,-2", "-2,-1"])
    );
    assert_eq!(points(&solve("x", &["(x - 1)^3*(x^2 + 1)^2*(x + 2)"], &[])), set(["1", "-2"]));
    // the real points of cyclic 5: A. Bjoerck, R. Froeberg, *J. Symb. Comp.* 12 (1991) 329-336
    let cyclic = [
        "a+b+c+d+e",
        "a*b+b*c+c*d+d*e+e*a",
        "a*b*c+b*c*d+c*d*e+d*e*a+e*a*b",
        "a*b*c*d+b*c*d*e+c*d*e*a+d*e*a*b+e*a*b*c",
        "a*b*c*d*e-1",
    ];
    let found = solve("a b c d e", &cyclic, &[]);
    assert_eq!((found.points.len(), found.families.len()), (10, 0));
    // Katsura 3 has 6 real solutions, 8 complex ones: checked with sympy
    let katsura =
        ["u+2*x+2*y+2*z-1", "u^2+2*x^2+2*y^2+2*z^2-u", "2*u*x+2*x*y+2*y*z-x", "x^2+2*u*y+2*x*z-y"];
    assert_eq!(solve("u x y z", &katsura, &[]).points.len(), 6);
}

#[test]
fn families_are_told_by_equations() {
    let found = solve("x y", &["(x - y)*(x^2 + y^2 - 1)", "(x - y)*(x + y - 1)"], &[]);
    assert_eq!((points(&found), families(&found)), (set(["0,1", "1,0"]), set(["x - y"])));
    // three lines; the origin belongs to two of them
    let found = solve("x y z", &["x*y", "y*z", "x*z - x"], &[]);
    assert_eq!((points(&found), found.families.len()), (set([]), 3));
    let found = solve("x y z", &["x^2 - y*z", "y^2 - x*z", "z^2 - x*y"], &["z"]);
    assert_eq!(families(&found), set(["y - z, x - z"]));
    assert_eq!((found.families[0].free.clone(), found.points.len()), (names("z"), 0));
    // all values, and the complement of a hypersurface
    assert_eq!(families(&solve("x y", &[], &["x"])), set([""]));
    assert_eq!(families(&solve("x y", &["x*y"], &["x"])), set(["y"]));
    // embedded components are not separate solutions
    assert_eq!(families(&solve("x y", &["x^2", "x*y"], &[])), set(["x"]));
    let cyclic = ["a+b+c+d", "a*b+b*c+c*d+d*a", "a*b*c+b*c*d+c*d*a+d*a*b", "a*b*c*d-1"];
    assert_eq!(solve("a b c d", &cyclic, &[]).families.len(), 2);
}

#[test]
fn sums_of_squares_vanish_together() {
    assert_eq!(points(&solve("x y", &["x^2 + y^2"], &[])), set(["0,0"]));
    assert_eq!(points(&solve("x y", &["x^2 + x*y + y^2"], &[])), set(["0,0"]));
    assert_eq!(points(&solve("x y", &["x^4 + x^2*y^2 + y^4"], &[])), set(["0,0"]));
    assert_eq!(families(&solve("x y z", &["x^2 + y^2 + z^2 - x*y - y*z - z*x"], &[])).len(), 1);
    assert_eq!(points(&solve("x y", &["x^2 - 2*x + y^2 + 1"], &[])), set(["1,0"]));
    for equation in ["x^2 + y^2 + 1", "x^4 + 1", "x^2 + x*y + y^2 + 1", "-x^2 - y^4 - 3"] {
        let found = solve("x y", &[equation], &[]);
        assert!(found.points.is_empty() && found.families.is_empty(), "{equation}");
    }
    assert!(solve("x y", &["x^2 + y^2"], &["x"]).points.is_empty());
}

/// Pairs of lines: their points of intersection, by Cramer's rule, and common lines.
#[test]
fn random_pairs_of_lines() {
    let mut draw = Draw(7);
    for _ in 0..60 {
        let mut line = || loop {
            let line = [draw.next(-3, 3), draw.next(-3, 3), draw.next(-3, 3)];
            if line[0] != 0 || line[1] != 0 {
                return line;
            }
        };
        let [f, g] = [[line(), line()], [line(), line()]];
        let text = |[a, b, c]: [i64; 3]| format!("({a}*x + {b}*y + {c})");
        let product = |pair: [[i64; 3]; 2]| format!("{}*{}", text(pair[0]), text(pair[1]));
        let found = solve("x y", &[&product(f), &product(g)], &[]);
        let (mut expected, mut common) = (BTreeSet::new(), BTreeSet::new());
        let parallel = |p: [i64; 3], q: [i64; 3]| p[0] * q[1] == p[1] * q[0];
        let same = |p: [i64; 3], q: [i64; 3]| {
            parallel(p, q) && p[0] * q[2] == p[2] * q[0] && p[1] * q[2] == p[2] * q[1]
        };
        for p in f {
            for q in g {
                if same(p, q) {
                    let place = f.iter().position(|other| same(*other, p)).unwrap();
                    common.insert(place);
                }
            }
        }
        for p in f {
            for q in g {
                let determinant = p[0] * q[1] - p[1] * q[0];
                if determinant == 0 {
                    continue;
                }
                let x = Rational::new(p[1] * q[2] - p[2] * q[1], determinant).unwrap();
                let y = Rational::new(p[2] * q[0] - p[0] * q[2], determinant).unwrap();
                let on = |line: [i64; 3]| {
                    let [a, b, c] = line.map(Rational::from);
                    (a * &x + &(b * &y) + &c).vanishes()
                };
                if !common.iter().any(|place| on(f[*place])) {
                    expected.insert(format!("{x},{y}"));
                }
            }
        }
        assert_eq!(points(&found), expected, "{f:?} {g:?}");
        assert_eq!(found.families.len(), common.len(), "{f:?} {g:?}");
    }
}

/// A line meets a circle in two points, in one or in none, as the discriminant says.
#[test]
fn random_circles_and_lines() {
    let mut draw = Draw(11);
    let mut seen = [0; 3];
    for _ in 0..60 {
        let [a, b, r, m, n] =
            [(-3, 3), (-3, 3), (1, 20), (-3, 3), (-6, 6)].map(|(low, high)| draw.next(low, high));
        let circle = format!("(x - ({a}))^2 + (y - ({b}))^2 - {r}");
        let line = format!("y - ({m})*x - ({n})");
        let found = solve("x y", &[&circle, &line], &[]);
        // (1 + m^2) x^2 + 2 (m (n - b) - a) x + a^2 + (n - b)^2 - r
        let half = m * (n - b) - a;
        let discriminant = half * half - (1 + m * m) * (a * a + (n - b) * (n - b) - r);
        let expected = match discriminant.cmp(&0) {
            Ordering::Less => 0,
            Ordering::Equal => 1,
            Ordering::Greater => 2,
        };
        assert_eq!(points(&found).len(), expected, "{circle} {line}");
        seen[expected] += 1;
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}

/// Random rational points, hidden by a change of the letters and by multiples of the equations.
#[test]
fn random_points() {
    let mut draw = Draw(3);
    for round in 0..12 {
        let count = 2 + round % 3;
        let mut xs: Vec<i64> = vec![];
        while xs.len() < count {
            let x = draw.next(-4, 4);
            if !xs.contains(&x) {
                xs.push(x);
            }
        }
        let values: Vec<[i64; 2]> =
            xs.iter().map(|_| [draw.next(-3, 3), draw.next(-3, 3)]).collect();
        let x = parse("x");
        let number = |n: i64| Symbolic::from_i64(n);
        // interpolation by Lagrange
        let through = |at: usize| {
            (0..count).fold(number(0), |sum, i| {
                let others = (0..count).filter(|j| *j != i);
                let term = others.fold(number(values[i][at]), |product, j| {
                    let factor = (x.clone() - &number(xs[j])) / &number(xs[i] - xs[j]);
                    product * &factor
                });
                sum + &term
            })
        };
        let first = xs.iter().fold(number(1), |p, root| p * &(x.clone() - &number(*root)));
        let equations = [first, parse("y") - &through(0), parse("z") - &through(1)];
        // x -> x + y, y -> y - z is invertible
        let moved =
            [("x", "x + y"), ("y", "y - z")].map(|(name, by)| (name.to_string(), parse(by)));
        let hidden: Vec<Symbolic> =
            equations.iter().map(|f| f.substitute(&moved.clone().into()).unwrap()).collect();
        let mixed = [
            hidden[0].clone() + &(hidden[1].clone() * &parse("z")),
            hidden[1].clone() - &(hidden[2].clone() * &number(2)),
            hidden[2].clone() * &number(3) + &hidden[1],
        ];
        let found = System::new(&names("x y z"), &mixed, &[]).unwrap().solve().unwrap();
        let expected = xs.iter().zip(&values).map(|(x, [y, z])| {
            // the inverse: y = Y + z, x = X - y
            let y = y + z;
            format!("{},{y},{z}", x - y)
        });
        assert_eq!(points(&found), expected.collect(), "{xs:?} {values:?}");
    }
}

#[test]
fn order_and_scale_of_letters_do_not_matter() {
    let equations = ["x^2 + y*z - 3", "y^2 + x*z - 3", "z^2 + x*y - 2*x"];
    let reference = solve("x y z", &equations, &[]);
    let permuted = solve("z x y", &equations, &[]);
    let reordered = |found: &SolutionSet, order: [usize; 3]| {
        let all = found.points.iter().map(|p| order.map(|at| p.values()[at].decimal(9)));
        all.collect::<BTreeSet<_>>()
    };
    assert!(!reference.points.is_empty());
    assert_eq!(reordered(&reference, [0, 1, 2]), reordered(&permuted, [1, 2, 0]));
    let doubled = equations.map(|text| {
        let values = ["x", "y", "z"].map(|x| (x.to_string(), parse(&format!("{x}/2"))));
        parse(text).substitute(&values.into()).unwrap()
    });
    let doubled = System::new(&names("x y z"), &doubled, &[]).unwrap().solve().unwrap();
    assert_eq!(doubled.points.len(), reference.points.len());
    for (p, q) in reference.points.iter().zip(&doubled.points) {
        for (x, y) in p.values().iter().zip(q.values()) {
            assert!((2.0 * x.to_f64() - y.to_f64()).abs() < 1e-12);
        }
    }
}

/// The polynomials of Mignotte have two roots at a distance of about `a^-(n+2)/2`.
#[test]
fn close_roots_are_separated() {
    for (n, a, count) in [(6, 1000, 4), (9, 100, 3), (12, 50, 4)] {
        let text = format!("x^{n} - 2*({a}*x - 1)^2");
        let found = solve("x", &[&text], &[]);
        assert_eq!(found.points.len(), count, "{text}");
        let values: Vec<RealNumber> =
            found.points.iter().map(|point| point.values()[0].clone()).collect();
        for pair in values.windows(2) {
            assert_eq!(pair[0].compare(&pair[1]), Ordering::Less);
        }
        let close = values.iter().filter(|x| (x.to_f64() * a as f64 - 1.0).abs() < 1e-3);
        assert_eq!(close.count(), 2, "{text}");
    }
}

#[test]
fn real_numbers() {
    let roots = RealNumber::roots(&[-1, -1, 0, 1].map(Rational::from));
    assert_eq!((roots.len(), roots[0].degree()), (1, 3));
    // the plastic number
    assert_eq!(roots[0].decimal(20), "1.3247179572447460259");
    assert!((roots[0].to_f64() - 1.324717957244746).abs() < 1e-15);
    let [low, high] = roots[0].interval(&Rational::new(1, 1000).unwrap());
    assert!(low < high && low.to_f64() < 1.3248 && high.to_f64() > 1.3247);
    let golden = RealNumber::roots(&[-1, -1, 1].map(Rational::from));
    let text: Vec<String> = golden.iter().map(RealNumber::to_string).collect();
    assert_eq!(text, ["1/2 - sqrt(5)/2", "1/2 + sqrt(5)/2"]);
    // the same number as a root of different polynomials
    let two = RealNumber::roots(&[-2, 0, 1].map(Rational::from));
    let four = RealNumber::roots(&[-4, 0, 0, 0, 1].map(Rational::from));
    assert_eq!((four.len(), four[1] == two[1], four[1] == two[0]), (2, true, false));
    assert_eq!(two[0].sign(), Ordering::Less);
    let half = RealNumber::from_rational(Rational::new(1, 2).unwrap());
    assert_eq!((half.to_string(), half.decimal(5)), ("1/2".into(), "0.5".into()));
    assert_eq!(half.polynomial(), [-1, 2].map(Rational::from));
    assert!(RealNumber::roots(&[]).is_empty());
    assert!(RealNumber::roots(&[Rational::from(3)]).is_empty());
    let zero = RealNumber::roots(&[0, 0, 0, 1].map(Rational::from));
    assert_eq!((zero.len(), zero[0].sign()), (1, Ordering::Equal));
}

/// Signs, values and signatures at irrational points are exact.
#[test]
fn signs_at_points_are_exact() {
    let system = system("x y", &["x^2 - 2", "y^2 - 3"], &[]);
    let found = system.solve().unwrap();
    assert_eq!(found.points.len(), 4);
    for point in &found.points {
        let [x, y] = [0, 1].map(|at| point.values()[at].to_f64());
        assert_eq!(system.sign(point, &parse("x^2*y^2 - 6")), Some(Ordering::Equal));
        let sign = if x * y > 0.0 { Ordering::Greater } else { Ordering::Less };
        assert_eq!(system.sign(point, &parse("x*y")), Some(sign));
        // x y and sqrt(6) differ by less than 1e-9
        let near = parse("x*y - 24494897427/10000000000");
        let expected = (x * y).partial_cmp(&2.4494897427).unwrap();
        assert_eq!(system.sign(point, &near), Some(expected));
        let quotient = system.value(point, &parse("1/(x + y)")).unwrap();
        assert!((quotient.to_f64() - 1.0 / (x + y)).abs() < 1e-12);
        assert_eq!(quotient.degree(), 4);
        let matrix =
            [["1", "x", "0"], ["x", "2", "0"], ["0", "0", "y"]].map(|row| row.map(parse).to_vec());
        // the block [[1, x], [x, 2]] has the determinant 0
        let expected = if y > 0.0 { [2, 0, 1] } else { [1, 1, 1] };
        assert_eq!(system.inertia(point, &matrix), Some(expected));
    }
    assert_eq!(system.sign(&found.points[0], &parse("t")), None);
    assert!(system.value(&found.points[0], &parse("1/(x^2 - 2)")).is_none());
}

#[test]
fn factors_of_values() {
    let factors = |text: &str| {
        let found = distinct_factors(&parse(text));
        found.iter().map(Symbolic::to_string).collect::<BTreeSet<_>>()
    };
    assert_eq!(factors("2*a*(a^2 - b^2)^2/c"), set(["a", "a - b", "a + b"]));
    assert_eq!(factors("x^6 - 1"), set(["x - 1", "x + 1", "x^2 + x + 1", "x^2 - x + 1"]));
    assert_eq!(factors("x^3 - y^3"), set(["x - y", "x^2 + x*y + y^2"]));
    // a product of cubics in two letters
    let product = factors("(x^3 + y^2 + 1)*(y^3 + x*y - 2)");
    assert_eq!(product.len(), 2, "{product:?}");
    assert_eq!((factors("0"), factors("3/2")), (set([]), set([])));
}

#[test]
fn limits_and_stops() {
    let equations =
        ["a^5 + b^4*c - d^3 + 1", "b^5 + c^4*d - a^2 + 3", "c^5 + a*d^4 - 7", "d^5 - a*b*c*d + 2"];
    let large = system("a b c d", &equations, &[]).with_effort(100_000);
    let message = large.solve().unwrap_err().to_string();
    assert!(message.starts_with("the system of equations is too large"), "{message}");
    let token = StopToken::new();
    token.request(StopReason::Timeout);
    let stopped = token.run(|| system("x y", &["x^2 - y", "y^3 - x"], &[]).solve().is_ok());
    assert_eq!(stopped.unwrap_err().reason, StopReason::Timeout);
    // functions are not letters
    assert!(System::new(&names("x"), &[parse("sin(x)")], &[]).is_none());
    assert!(System::new(&names("x"), &[parse("x + y")], &[]).is_none());
    let letters: Vec<String> = (0..20).map(|at| format!("x{at}")).collect();
    assert!(System::new(&letters, &[], &[]).unwrap().solve().is_err());
}
