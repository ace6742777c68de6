//! Each factor is in its group, the product is the element, and the coordinates are in the Weyl
//! chamber, also for equal, zero and right angles and for permutations.

mod two_qubit;

use affinor::group::kak::{Kak, SymmetricPair};
use nalgebra::{Complex, DMatrix};
use std::f64::consts::PI;

pub type Matrix = DMatrix<Complex<f64>>;

/// A generator of random numbers (xorshift), the same in every run.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number between -1 and 1.
    pub fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() >> 33) as usize % n
    }

    pub fn matrix(&mut self, n: usize) -> Matrix {
        Matrix::from_fn(n, n, |_, _| Complex::new(self.uniform(), self.uniform()))
    }
}

/// The exponential by a Taylor series of `x/2^5`.
pub fn exp(x: &Matrix) -> Matrix {
    let x = x.scale(1.0 / 32.0);
    let one = Matrix::identity(x.nrows(), x.nrows());
    let mut sum = one.clone();
    for k in (1..=24).rev() {
        sum = &one + (&x * sum).scale(1.0 / f64::from(k));
    }
    (0..5).fold(sum, |power, _| &power * &power)
}

/// The field of the entries of G, and the Hermitian form or the symplectic form.
struct Group {
    pair: SymmetricPair,
    is_real: bool,
    is_quaternionic: bool,
    is_special: bool,
    signs: Option<Vec<f64>>,
}

fn pair(name: &str) -> SymmetricPair {
    name.parse().unwrap_or_else(|error| panic!("{name}: {error}"))
}

impl Group {
    fn new(name: &str) -> Self {
        let pair = pair(name);
        assert_eq!(pair.to_string(), name);
        let (group, arguments) =
            name.split_once('/').unwrap_or((name, "")).0.split_once('(').unwrap();
        let is_real = matches!(group, "O" | "SO") || arguments.contains('R');
        let is_quaternionic = group == "Sp" && !arguments.contains('R') || arguments.contains('H');
        let numbers: Vec<usize> =
            arguments.trim_end_matches(')').split(',').filter_map(|n| n.parse().ok()).collect();
        let signs = match (&numbers[..], group) {
            ([p, q], _) => {
                let width = if is_quaternionic { 2 } else { 1 };
                Some([vec![1.0; p * width], vec![-1.0; q * width]].concat())
            }
            _ => None,
        };
        Group {
            pair,
            is_real,
            is_quaternionic,
            is_special: group.starts_with('S') && group != "Sp",
            signs,
        }
    }

    /// The part of a matrix with real or quaternionic entries.
    fn over_field(&self, m: &Matrix) -> Matrix {
        if self.is_real {
            return m.map(|value| Complex::new(value.re, 0.0));
        }
        if !self.is_quaternionic {
            return m.clone();
        }
        quaternionic(m)
    }

    /// The form that G preserves; `None` for the general linear group.
    fn form(&self) -> Option<Matrix> {
        let n = self.pair.size();
        if let Some(signs) = &self.signs {
            return Some(Matrix::from_fn(n, n, |i, j| {
                Complex::new(if i == j { signs[i] } else { 0.0 }, 0.0)
            }));
        }
        if self.pair.is_compact() {
            return Some(Matrix::identity(n, n));
        }
        self.pair.to_string().starts_with("Sp").then(|| j(n))
    }

    /// A random element of the Lie algebra of K, or of G.
    fn algebra(&self, random: &mut Random, is_compact: bool) -> Matrix {
        let n = self.pair.size();
        let x = self.over_field(&random.matrix(n));
        let x = match self.form() {
            // the inverse of a form is its adjoint
            Some(form) => (&x - form.adjoint() * x.adjoint() * &form).scale(0.5),
            None => x,
        };
        let mut x = if !is_compact {
            x
        } else if self.pair.is_compact() {
            // the involution of the group is linear
            (&x + self.pair.involution(&x).unwrap()).scale(0.5)
        } else {
            (&x - x.adjoint()).scale(0.5)
        };
        if self.is_special {
            let trace = x.trace().unscale(n as f64);
            (0..n).for_each(|i| x[(i, i)] -= trace);
        }
        x
    }

    /// A random element of K or of G without the rounding errors of the exponential.
    fn element(&self, random: &mut Random, is_compact: bool, scale: f64) -> Matrix {
        self.polished(exp(&self.algebra(random, is_compact).scale(scale)))
    }

    /// Two steps of Newton's method for the equations of G.
    fn polished(&self, g: Matrix) -> Matrix {
        let (mut g, n) = (g, self.pair.size());
        // large elements lose accuracy in the residual of the equations
        let is_small = self.pair.is_compact() || g.norm() < 10.0;
        for _ in 0..2 {
            if let Some(form) = self.form().filter(|_| is_small) {
                let three = Matrix::identity(n, n).scale(3.0);
                g = &g * (three - form.adjoint() * g.adjoint() * &form * &g).scale(0.5);
            }
            if self.is_special {
                let determinant = g.clone().determinant();
                g *= (-determinant.ln().unscale(n as f64)).exp();
            }
        }
        self.over_field(&g)
    }

    /// Checks that a matrix is in G, up to a multiple of the square of its size.
    fn check(&self, g: &Matrix, tolerance: f64, what: &str) {
        let name = &self.pair;
        assert_near(g, &self.over_field(g), tolerance, &format!("{what} of {name}: entries"));
        if let Some(form) = self.form() {
            let image = g.adjoint() * &form * g;
            assert_near(&image, &form, tolerance, &format!("{what} of {name}: form"));
        }
        if self.is_special {
            let determinant = g.clone().determinant();
            let off = (determinant - Complex::new(1.0, 0.0)).norm();
            assert!(off <= 10.0 * tolerance, "{what} of {name}: determinant {determinant}");
        }
    }
}

fn quaternionic(m: &Matrix) -> Matrix {
    Matrix::from_fn(m.nrows(), m.ncols(), |i, j| {
        let other = m[(i ^ 1, j ^ 1)].conj();
        (m[(i, j)] + if i % 2 == j % 2 { other } else { -other }).scale(0.5)
    })
}

fn j(n: usize) -> Matrix {
    let entry = |i, j| {
        if i + n / 2 == j {
            1.0
        } else if j + n / 2 == i {
            -1.0
        } else {
            0.0
        }
    };
    Matrix::from_fn(n, n, |i, j| Complex::new(entry(i, j), 0.0))
}

pub fn assert_near(a: &Matrix, b: &Matrix, tolerance: f64, what: &str) {
    let off = (a - b).norm();
    assert!(off <= tolerance, "{what}: {off:e} is more than {tolerance:e}\n{a}{b}");
}

/// Factors an element and checks all claims. Returns the residual relative to the norm.
fn factor(group: &Group, g: &Matrix) -> Kak {
    let (pair, n) = (&group.pair, group.pair.size() as f64);
    let kak = Kak::new(pair, g).unwrap_or_else(|error| panic!("{pair}: {error}\n{g}"));
    let tolerance = 6e-15 * n;
    for (k, what) in [(kak.k1(), "k1"), (kak.k2(), "k2")] {
        group.check(k, tolerance, what);
        let image = pair.involution(k).unwrap();
        assert_near(k, &image, tolerance, &format!("{pair}: {what} is fixed"));
        assert_near(&(k.adjoint() * k), &Matrix::identity(g.nrows(), g.nrows()), tolerance, what);
    }
    let x = pair.abelian_element(kak.coordinates()).unwrap();
    let size = kak.a().norm();
    assert_near(kak.a(), &exp(&x), 4e-13 * size.max(1.0), &format!("{pair}: a = exp(X)"));
    assert_near(&pair.abelian_exponential(kak.coordinates()).unwrap(), kak.a(), 0.0, "a");
    let product = kak.k1() * kak.a() * kak.k2();
    let defect = group.form().map_or(0.0, |form| (g.adjoint() * &form * g - form).norm());
    let allowed = tolerance * g.norm() + defect / g.norm();
    assert_near(&product, g, allowed, &format!("{pair}: product of {:?}", kak.coordinates()));
    assert!((kak.residual() - (product - g).norm()).abs() <= tolerance * g.norm());
    chamber(&group.pair, kak.coordinates());
    kak
}

/// The inequalities of the Weyl chamber.
fn chamber(pair: &SymmetricPair, x: &[f64]) {
    let name = pair.to_string();
    let tolerance = 1e-13;
    assert_eq!(x.len(), pair.coordinate_count(), "{name}");
    let is_even = match name.split_once(['/', '(']) {
        Some((letters, rest)) if letters.starts_with("SO") => {
            let numbers: Vec<&str> =
                rest.split(|c: char| !c.is_ascii_digit()).filter(|s| !s.is_empty()).collect();
            numbers.len() >= 2
                && numbers[numbers.len() - 1] == numbers[numbers.len() - 2]
                && !rest.contains('U')
        }
        _ => false,
    };
    let linear = name.contains("L(");
    let conjugation = pair.is_compact()
        && (name.starts_with('U') || name.starts_with("SU"))
        && !name.contains('x');
    let mut positive = x.to_vec();
    if is_even && let Some(last) = positive.last_mut() {
        *last = last.abs();
    }
    assert!(positive.windows(2).all(|w| w[0] >= w[1] - tolerance), "{name}: {x:?}");
    let (first, last) =
        (positive.first().copied().unwrap_or(0.0), positive.last().copied().unwrap_or(0.0));
    if conjugation {
        assert!(first - last <= PI + tolerance, "{name}: {x:?}");
        let range = first <= PI / 2.0 && last >= -PI / 2.0;
        assert!(name.starts_with("SU") || range, "{name}: {x:?}");
    } else if !linear {
        assert!(last >= -tolerance, "{name}: {x:?}");
        assert!(!pair.is_compact() || first <= PI / 2.0 + tolerance, "{name}: {x:?}");
    }
    if name.starts_with("SL") || (conjugation && name.starts_with("SU")) {
        assert!(x.iter().sum::<f64>().abs() < tolerance * x.len() as f64, "{name}: {x:?}");
    }
}

/// The names of all pairs whose matrices have at most 8 rows.
fn names() -> Vec<String> {
    let mut names = vec![];
    for n in 1..=8 {
        names.extend([format!("U({n})/O({n})"), format!("SU({n})/SO({n})")]);
        names.extend(["GL", "SL"].iter().flat_map(|g| ["R", "C"].map(|f| format!("{g}({n},{f})"))));
        for p in 0..=n {
            let q = n - p;
            names.push(format!("U({n})/U({p})xU({q})"));
            names.push(format!("SU({n})/S(U({p})xU({q}))"));
            names.push(format!("O({n})/O({p})xO({q})"));
            names.push(format!("SO({n})/S(O({p})xO({q}))"));
            names.extend(["O", "SO", "U", "SU"].map(|g| format!("{g}({p},{q})")));
            if n <= 4 {
                names.push(format!("Sp({n})/Sp({p})xSp({q})"));
                names.push(format!("Sp({p},{q})"));
            }
        }
        if n <= 4 {
            let m = 2 * n;
            names.extend([format!("U({m})/Sp({n})"), format!("SU({m})/Sp({n})")]);
            names.extend([format!("SO({m})/U({n})"), format!("Sp({n})/U({n})")]);
            names.extend([format!("GL({n},H)"), format!("SL({n},H)"), format!("Sp({m},R)")]);
        }
    }
    names
}

#[test]
fn random_elements_of_all_pairs() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for name in names() {
        let group = Group::new(&name);
        for scale in [1e-9, 1.0, 3.0] {
            let g = group.element(&mut random, false, scale);
            let kak = factor(&group, &g);
            // the coordinates do not change under K
            let k = group.element(&mut random, true, 1.0);
            let other = factor(&group, &(k * &g));
            // a small singular value has a large relative error
            let condition = g.norm() * g.clone().try_inverse().unwrap().norm();
            let tolerance = 1e-14 * condition;
            for (x, y) in kak.coordinates().iter().zip(other.coordinates()) {
                assert!((x - y).abs() < tolerance, "{name}: {x} {y}");
            }
        }
    }
}

/// Angles at and near zero, right angles, the limits of the split, and each other.
const SPECIAL: [f64; 22] = [
    0.0,
    1e-300,
    1e-17,
    3e-16,
    1e-14,
    1e-12,
    1e-9,
    1e-8,
    3e-8,
    1e-5,
    0.3,
    0.3 + 1e-15,
    0.3 + 1e-9,
    PI / 6.0,
    PI / 4.0,
    PI / 4.0 - 1e-9,
    PI / 4.0 + 1e-15,
    PI / 3.0,
    PI / 3.0 + 1e-10,
    PI / 2.0 - 1e-8,
    PI / 2.0 - 1e-15,
    PI / 2.0,
];

#[test]
fn degenerate_coordinates_of_all_pairs() {
    let mut random = Random(0x1234_5678_9abc_def1);
    for name in names() {
        let group = Group::new(&name);
        let count = group.pair.coordinate_count();
        for trial in 0_u8..8 {
            let mut x: Vec<f64> =
                (0..count).map(|_| SPECIAL[random.below(SPECIAL.len())]).collect();
            let mut scale = 0.0;
            match trial {
                0 => x.fill(0.0),
                1 => x.fill(PI / 2.0),
                2 => x.fill(PI / 4.0),
                // condition numbers up to 1e13
                4 | 5 if !group.pair.is_compact() => {
                    x.iter_mut().for_each(|x| *x = random.uniform());
                    scale = f64::from(8 * trial - 24);
                }
                3 => x.iter_mut().enumerate().for_each(|(i, x)| *x = 1.0 + 1e-10 * i as f64),
                _ => {}
            }
            if name.starts_with('S') && group.pair.rank() < count {
                let others: f64 = x.iter().skip(1).sum();
                x[0] = -others;
            }
            if scale > 0.0 {
                let largest = x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
                x.iter_mut().for_each(|x| *x *= scale / largest.max(1e-9));
            }
            let a = group.pair.abelian_exponential(&x).unwrap();
            let sides = if trial % 2 == 0 { [1.0, 1.0] } else { [0.0, 1.0] };
            let [k1, k2] = sides.map(|size| group.element(&mut random, true, size));
            factor(&group, &(k1 * a * k2));
        }
    }
}

/// Permutations with signs: all coordinates are multiples of a right angle, or its half.
#[test]
fn signed_permutations() {
    let mut random = Random(5);
    for name in names().iter().filter(|name| name.contains('/')) {
        let group = Group::new(name);
        let n = group.pair.size();
        for _ in 0..20 {
            let mut images: Vec<usize> = (0..n).collect();
            (1..n).for_each(|i| images.swap(i, random.below(i + 1)));
            if group.is_quaternionic {
                // permutes quaternions
                let of: Vec<usize> = images.iter().copied().filter(|i| i % 2 == 0).collect();
                images = of.iter().flat_map(|&i| [i, i + 1]).collect();
            }
            let sign = |random: &mut Random| if random.uniform() < 0.0 { -1.0 } else { 1.0 };
            let mut g = Matrix::zeros(n, n);
            for (j, &i) in images.iter().enumerate() {
                let previous = g[(images[j ^ (j & 1)], j ^ (j & 1))];
                let repeated = group.is_quaternionic && j % 2 == 1;
                g[(i, j)] = if repeated { previous } else { Complex::new(sign(&mut random), 0.0) };
            }
            if group.is_special && g.clone().determinant().re < 0.0 {
                g.column_mut(0).neg_mut();
            }
            let kak = factor(&group, &g);
            for x in kak.coordinates() {
                let share = x / (PI / 4.0);
                let is_multiple = (share - share.round()).abs() < 1e-14;
                let conjugation = kak.pair().to_string();
                // for the sum zero, any multiple of a part of pi may occur
                assert!(is_multiple || !conjugation.contains('x'), "{name}: {x}\n{g}");
            }
        }
    }
}

/// Angles of a rotation between two planes, singular values, and the factorization of Takagi.
#[test]
fn known_coordinates() {
    // the principal angles between two subspaces have the cosines of the singular values of a block
    let group = Group::new("SO(5)/S(O(3)xO(2))");
    let g = group.element(&mut Random(8), false, 1.0);
    let kak = factor(&group, &g);
    let block = g.view((3, 3), (2, 2)).map(|value| value.re);
    let mut cosines: Vec<f64> = kak.coordinates().iter().map(|x| x.cos()).collect();
    cosines.reverse();
    let expected = block.singular_values();
    assert!(
        cosines.iter().zip(&expected).all(|(x, y)| (x - y).abs() < 1e-14),
        "{cosines:?} {expected}"
    );

    let g = Matrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 1.0].map(|x| Complex::new(x, 0.0)));
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    for (name, second) in
        [("SL(2,R)", -1.0), ("GL(2,R)", -1.0), ("GL(2,C)", -1.0), ("Sp(2,R)", 0.0)]
    {
        let x = factor(&Group::new(name), &g).coordinates().to_vec();
        assert!((x[0] - 2.0 * golden.ln()).abs() < 1e-15, "{name}: {x:?}");
        assert!(x.len() == 1 || (x[1] - second * 2.0 * golden.ln()).abs() < 1e-15, "{name}: {x:?}");
    }

    // squares of the entries are not floats
    for scale in [1e200, 1e-200] {
        let kak = Kak::new(&pair("GL(2,C)"), &g.scale(scale)).unwrap();
        assert!((kak.coordinates()[0] - 2.0 * golden.ln() - scale.ln()).abs() < 1e-12);
        assert!((0.0..1e-12 * scale).contains(&kak.residual()));
    }

    // a boost of Lorentz with the velocity 3/5 has the rapidity ln 2
    let boost = |v: f64| {
        let gamma = 1.0 / (1.0 - v * v).sqrt();
        let mut g = Matrix::identity(4, 4);
        (g[(2, 2)], g[(3, 3)]) = (Complex::new(gamma, 0.0), Complex::new(gamma, 0.0));
        (g[(2, 3)], g[(3, 2)]) = (Complex::new(gamma * v, 0.0), Complex::new(gamma * v, 0.0));
        g
    };
    let kak = factor(&Group::new("SO(3,1)"), &boost(-0.6));
    assert!((kak.coordinates()[0] - 2.0_f64.ln()).abs() < 1e-15);
}

#[test]
fn matrices_outside_the_group() {
    let message = |name: &str, g: &Matrix| Kak::new(&pair(name), g).unwrap_err().to_string();
    let one = |n| Matrix::identity(n, n);
    let i = Complex::new(0.0, 1.0);
    let cases: [(&str, Matrix, &str); 11] = [
        ("SU(3)/SO(3)", one(2), "3 rows and 3 columns, not 2 rows"),
        ("SU(2)/SO(2)", one(2) * i, "determinant"),
        ("U(2)/O(2)", one(2).scale(1.1), "g^* g = 1 is off by"),
        ("SO(2)/S(O(1)xO(1))", one(2) * i, "not real"),
        ("Sp(1)/U(1)", Matrix::from_diagonal(&vec![i, i].into()), "not quaternionic"),
        ("GL(2,R)", Matrix::zeros(2, 2), "singular"),
        ("SL(2,R)", one(2).scale(2.0), "determinant is 4"),
        ("U(2)/O(2)", one(2).scale(1e200), "g^* g = 1 is off by"),
        ("SO(2,1)", one(3).scale(-1.0), "determinant is -1"),
        ("SU(1,1)", one(2).scale(2.0), "g^* I g = I is off by"),
        ("Sp(2,R)", one(2).scale(2.0), "g^T J g = J is off by"),
    ];
    for (name, g, expected) in cases {
        let found = message(name, &g);
        assert!(found.contains(expected), "{name}: {found}");
    }
    let mut bad = one(2);
    bad[(0, 1)] = Complex::new(0.0, f64::INFINITY);
    assert!(message("U(2)/O(2)", &bad).contains("component 1,2"));
    // an element with the accuracy of printed numbers: the factors are exact, the residual is not
    let group = Group::new("SU(3)/SO(3)");
    let g = group
        .element(&mut Random(2), false, 1.0)
        .map(|z| Complex::new((z.re * 1e8).round(), (z.im * 1e8).round()).unscale(1e8));
    let kak = Kak::new(&group.pair, &g).unwrap();
    assert!((1e-10..1e-7).contains(&kak.residual()), "{}", kak.residual());
    group.check(kak.k1(), 1e-14, "k1");
    group.check(kak.k2(), 1e-14, "k2");
}

#[test]
fn names_of_pairs() {
    for name in [
        "",
        "SU(4)",
        "SU(4)/SO(3)",
        "SU(4)/U(2)xU(2)",
        "SU(5)/Sp(2)",
        "SO(6)/U(2)",
        "SO(5)/SO(3)xSO(2)",
        "Sp(3)/Sp(1)xSp(1)",
        "SL(2,Q)",
        "Sp(3,R)",
        "SO(0)/S(O(0)xO(0))",
        "SL(9999,R)",
        "SU(-1,2)",
        "U(18446744073709551615)/U(18446744073709551615)xU(1)",
        "SL(2,R)/SO(2)",
    ] {
        let error = name.parse::<SymmetricPair>().unwrap_err().to_string();
        assert!(error.contains(&format!("`{name}` is not the name")), "{name}: {error}");
    }
    assert_eq!(pair(" SU( 4 ) / S(U(2) x U(2))").to_string(), "SU(4)/S(U(2)xU(2))");
    // ranks of the symmetric spaces (Helgason, ch. X, table V)
    for (name, rank) in [
        ("SU(4)/SO(4)", 3),
        ("SU(6)/Sp(3)", 2),
        ("SU(5)/S(U(3)xU(2))", 2),
        ("SO(7)/S(O(6)xO(1))", 1),
        ("SO(10)/U(5)", 2),
        ("Sp(3)/U(3)", 3),
        ("Sp(3)/Sp(2)xSp(1)", 1),
        ("SL(3,C)", 2),
        ("U(1)/O(1)", 1),
        ("SO(2)/U(1)", 0),
    ] {
        assert_eq!(pair(name).rank(), rank, "{name}");
    }
    let one = Matrix::identity(2, 2);
    assert!(pair("SL(2,R)").involution(&Matrix::zeros(2, 2)).is_err());
    assert!(pair("SL(3,R)").involution(&one).is_err());
    assert!(
        pair("SL(3,R)")
            .abelian_element(&[1.0])
            .unwrap_err()
            .to_string()
            .contains("3 coordinates, not 1")
    );
}

/// A singular matrix of rounding errors remains after the coordinates that are not zero.
#[test]
fn coordinates_of_rounding_errors() {
    let mut random = Random(11);
    for name in ["SO(4,2)", "SU(3,3)", "Sp(2,2)", "SO(8)/U(4)", "U(5)/U(3)xU(2)", "Sp(4,R)"] {
        let group = Group::new(name);
        for trial in 0..100 {
            let mut x = vec![0.0; group.pair.coordinate_count()];
            x[0] = if trial % 2 == 0 { 1.3 } else { 1e-15 };
            let a = group.pair.abelian_exponential(&x).unwrap();
            let [k1, k2] = [0, 1].map(|_| group.element(&mut random, true, 1.0));
            factor(&group, &(k1 * a * k2));
        }
    }
}
