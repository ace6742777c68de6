//! The root systems agree with Bourbaki's plates, and the Chevalley bases satisfy their axioms and
//! agree with GAP's tables.

use affinor::algebra::roots::{
    CartanType, MAX_DIMENSION, RootError, RootSystem, Series, basis_names, chevalley_constants,
};
use std::collections::{HashMap, HashSet};

type Constants = Vec<(usize, usize, usize, i64)>;

/// A1-A8, B2-B8, C2-C8, D3-D8 and the exceptional types.
fn types() -> Vec<CartanType> {
    [
        (Series::A, 1..=8),
        (Series::B, 2..=8),
        (Series::C, 2..=8),
        (Series::D, 3..=8),
        (Series::E, 6..=8),
        (Series::F, 4..=4),
        (Series::G, 2..=2),
    ]
    .into_iter()
    .flat_map(|(series, ranks)| ranks.map(move |rank| (series, rank)))
    .map(|(series, rank)| CartanType::new(series, rank).expect("a type that exists"))
    .collect()
}

fn coefficients(roots: &RootSystem) -> Vec<Vec<i64>> {
    roots.positive_roots().iter().map(|root| root.coefficients().to_vec()).collect()
}

fn negative(root: &[i64]) -> Vec<i64> {
    root.iter().map(|c| -c).collect()
}

/// `a + n b`
fn combine(a: &[i64], n: i64, b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(a, b)| a + n * b).collect()
}

/// The bracket of the basis as a full table: `table[i][j]` lists the `(k, v)` of `[e_i, e_j]`.
fn table(dimension: usize, constants: &Constants) -> Vec<Vec<Vec<(usize, i64)>>> {
    let mut table = vec![vec![Vec::new(); dimension]; dimension];
    for &(i, j, k, v) in constants {
        table[i][j].push((k, v));
        table[j][i].push((k, -v));
    }
    table
}

#[test]
fn the_names_that_exist() {
    for rank in 0..12 {
        let exists = |series| CartanType::new(series, rank).is_ok();
        assert_eq!(exists(Series::A), rank >= 1);
        assert_eq!(exists(Series::B), rank >= 2);
        assert_eq!(exists(Series::C), rank >= 2);
        assert_eq!(exists(Series::D), rank >= 3);
        assert_eq!(exists(Series::E), [6, 7, 8].contains(&rank));
        assert_eq!(exists(Series::F), rank == 4);
        assert_eq!(exists(Series::G), rank == 2);
    }
    let largest = [(Series::A, 44), (Series::B, 31), (Series::C, 31), (Series::D, 32)];
    for (series, rank) in largest {
        let roots = RootSystem::new(CartanType::new(series, rank).expect("within the limit"));
        assert_eq!(
            2 * roots.positive_roots().len() + rank,
            roots.cartan_type().dimension(),
            "{series}{rank}"
        );
        for rank in [rank + 1, MAX_DIMENSION, usize::MAX] {
            assert_eq!(CartanType::new(series, rank), Err(RootError::TooLarge { series, rank }));
        }
    }
    let none = CartanType::new(Series::E, 9).map_err(|error| error.to_string());
    assert_eq!(none, Err("there is no simple Lie algebra E9: En needs n = 6, 7, 8".into()));
}

#[test]
fn numbers_of_roots() {
    for cartan_type in types() {
        let n = cartan_type.rank();
        let (positive, dimension) = match cartan_type.series() {
            Series::A => (n * (n + 1) / 2, (n + 1) * (n + 1) - 1),
            Series::B | Series::C => (n * n, n * (2 * n + 1)),
            Series::D => (n * (n - 1), n * (2 * n - 1)),
            Series::E => [(36, 78), (63, 133), (120, 248)][n - 6],
            Series::F => (24, 52),
            Series::G => (6, 14),
        };
        let roots = RootSystem::new(cartan_type);
        assert_eq!(roots.positive_roots().len(), positive, "{cartan_type}");
        assert_eq!(cartan_type.dimension(), dimension, "{cartan_type}");
        assert_eq!(basis_names(&roots).len(), dimension, "{cartan_type}");
    }
    let a2 = RootSystem::new(CartanType::new(Series::A, 2).expect("a type that exists"));
    assert_eq!(basis_names(&a2).join(" "), "e1 e2 e3 f1 f2 f3 h1 h2");
}

/// Bourbaki, ch. VI, plates I-IX, (IV).
#[test]
fn highest_roots() {
    for cartan_type in types() {
        let n = cartan_type.rank();
        let highest = match cartan_type.series() {
            Series::A => vec![1; n],
            Series::B => (1..=n).map(|i| if i == 1 { 1 } else { 2 }).collect(),
            Series::C => (1..=n).map(|i| if i == n { 1 } else { 2 }).collect(),
            Series::D => (1..=n).map(|i| if i == 1 || i + 1 >= n { 1 } else { 2 }).collect(),
            Series::E => match n {
                6 => vec![1, 2, 2, 3, 2, 1],
                7 => vec![2, 2, 3, 4, 3, 2, 1],
                _ => vec![2, 3, 4, 6, 5, 4, 3, 2],
            },
            Series::F => vec![2, 3, 4, 2],
            Series::G => vec![3, 2],
        };
        let roots = coefficients(&RootSystem::new(cartan_type));
        assert_eq!(roots.last(), Some(&highest), "{cartan_type}");
        let height = |root: &Vec<i64>| root.iter().sum::<i64>();
        assert_eq!(roots.iter().filter(|r| height(r) == height(&highest)).count(), 1);
    }
}

/// Twice the simple roots in the orthonormal basis of Bourbaki's plates, (II).
fn simple_in_space(cartan_type: CartanType) -> Vec<Vec<i64>> {
    let n = cartan_type.rank();
    let size = match cartan_type.series() {
        Series::A => n + 1,
        Series::E => 8,
        Series::G => 3,
        _ => n,
    };
    // 2 (a ε_i + b ε_j), from 1
    let two = |i: usize, a: i64, j: usize, b: i64| {
        let mut v = vec![0; size];
        v[i - 1] += 2 * a;
        v[j - 1] += 2 * b;
        v
    };
    let steps = |to: usize| (1..to).map(|i| two(i, 1, i + 1, -1)).collect::<Vec<_>>();
    match cartan_type.series() {
        Series::A => steps(n + 1),
        Series::B => [steps(n), vec![two(n, 1, n, 0)]].concat(),
        Series::C => [steps(n), vec![two(n, 1, n, 1)]].concat(),
        Series::D => [steps(n), vec![two(n - 1, 1, n, 1)]].concat(),
        Series::E => {
            let first = vec![vec![1, -1, -1, -1, -1, -1, -1, 1], two(1, 1, 2, 1)];
            [first, (1..n - 1).map(|i| two(i, -1, i + 1, 1)).collect()].concat()
        }
        Series::F => vec![two(2, 1, 3, -1), two(3, 1, 4, -1), two(4, 1, 4, 0), vec![1, -1, -1, -1]],
        Series::G => vec![two(1, 1, 2, -1), vec![-4, 2, 2]],
    }
}

/// All roots in that basis, plates (I). The roots of E6 and E7 are the roots of E8 that are
/// orthogonal to the vectors in the plates.
fn all_in_space(cartan_type: CartanType) -> HashSet<Vec<i64>> {
    let size = simple_in_space(cartan_type)[0].len();
    let vectors = |values: &[i64]| {
        let mut all = vec![Vec::new()];
        for _ in 0..size {
            all =
                all.iter().flat_map(|v| values.iter().map(|&x| [&v[..], &[x]].concat())).collect();
        }
        all
    };
    let square = |v: &[i64]| v.iter().map(|x| x * x).sum::<i64>();
    let sum = |v: &[i64]| v.iter().sum::<i64>();
    let even = || vectors(&[-2, 0, 2]).into_iter();
    let halves = || vectors(&[-1, 1]).into_iter();
    match cartan_type.series() {
        Series::A => even().filter(|v| square(v) == 8 && sum(v) == 0).collect(),
        Series::B => even().filter(|v| [4, 8].contains(&square(v))).collect(),
        Series::C => {
            let long = (0..size).flat_map(|i| {
                [4, -4].map(|x| (0..size).map(|j| if i == j { x } else { 0 }).collect())
            });
            even().filter(|v| square(v) == 8).chain(long).collect()
        }
        Series::D => even().filter(|v| square(v) == 8).collect(),
        Series::E => even()
            .filter(|v| square(v) == 8)
            .chain(halves().filter(|v| v.iter().filter(|&&x| x < 0).count() % 2 == 0))
            .filter(|v| cartan_type.rank() > 7 || v[6] == -v[7])
            .filter(|v| cartan_type.rank() > 6 || v[5] == v[6])
            .collect(),
        Series::F => even().filter(|v| [4, 8].contains(&square(v))).chain(halves()).collect(),
        Series::G => vectors(&[-4, -2, 0, 2, 4])
            .into_iter()
            .filter(|v| sum(v) == 0 && [8, 24].contains(&square(v)))
            .collect(),
    }
}

#[test]
fn the_roots_are_those_of_the_plates() {
    for cartan_type in types() {
        let simple = simple_in_space(cartan_type);
        let product = |a: &[i64], b: &[i64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<i64>();
        let roots = RootSystem::new(cartan_type);
        let mut found = HashSet::new();
        let short = simple.iter().map(|v| product(v, v)).min().expect("a simple root");
        for root in roots.positive_roots() {
            let zero = vec![0; simple[0].len()];
            let v =
                root.coefficients().iter().zip(&simple).fold(zero, |v, (&c, a)| combine(&v, c, a));
            assert_eq!(root.squared_length() * short, 2 * product(&v, &v), "{cartan_type}");
            for (i, a) in simple.iter().enumerate() {
                // <α, α_i^∨> and <α_i, α^∨>
                assert_eq!(root.weight()[i] * product(a, a), 2 * product(&v, a), "{cartan_type}");
                let row = &cartan_type.cartan_matrix()[i];
                let dual = root.coroot().iter().zip(row).map(|(c, a)| c * a).sum::<i64>();
                assert_eq!(dual * product(&v, &v), 2 * product(&v, a), "{cartan_type}");
            }
            found.insert(negative(&v));
            found.insert(v);
        }
        for (i, a) in simple.iter().enumerate() {
            for (j, b) in simple.iter().enumerate() {
                let entry = cartan_type.cartan_matrix()[i][j];
                assert_eq!(entry * product(b, b), 2 * product(a, b), "{cartan_type}");
            }
        }
        assert_eq!(found, all_in_space(cartan_type), "{cartan_type}");
    }
}

/// `s_i` permutes the positive roots other than `α_i`.
#[test]
fn simple_reflections_keep_the_positive_roots() {
    for cartan_type in types() {
        let (n, matrix) = (cartan_type.rank(), cartan_type.cartan_matrix());
        let roots = RootSystem::new(cartan_type);
        for i in 0..n {
            let simple: Vec<i64> = (0..n).map(|j| i64::from(i == j)).collect();
            assert_eq!(roots.index(&simple), Some(i), "{cartan_type}");
            let mut images = HashSet::new();
            for root in coefficients(&roots) {
                let pairing: i64 = root.iter().zip(&matrix).map(|(c, row)| c * row[i]).sum();
                let image = combine(&root, -pairing, &simple);
                assert!(roots.is_root(&image), "{cartan_type}");
                images.extend(roots.index(&image));
            }
            assert_eq!(images.len(), roots.positive_roots().len() - 1, "{cartan_type}");
            assert!(!images.contains(&i), "{cartan_type}");
        }
    }
}

#[test]
fn the_order_and_the_index() {
    for cartan_type in types() {
        let roots = RootSystem::new(cartan_type);
        let mut sorted = coefficients(&roots);
        sorted.sort_by_key(|root| (root.iter().sum::<i64>(), negative(root)));
        assert_eq!(coefficients(&roots), sorted, "{cartan_type}");
        for (k, root) in roots.positive_roots().iter().enumerate() {
            assert_eq!(root.height(), root.coefficients().iter().sum::<i64>());
            assert_eq!(roots.index(root.coefficients()), Some(k), "{cartan_type}");
            assert_eq!(roots.index(&negative(root.coefficients())), None, "{cartan_type}");
            assert!(roots.is_root(&negative(root.coefficients())), "{cartan_type}");
        }
        let n = cartan_type.rank();
        for strange in [vec![], vec![0; n], vec![1; n + 1], vec![i64::MIN; n], vec![i64::MAX; n]] {
            assert!(!roots.is_root(&strange), "{cartan_type}: {strange:?}");
        }
        // A last coefficient as large as the radix of the keys must not be mistaken for a 1 in the
        // position before.
        for radix in [5, 13] {
            let mut carried = vec![0; n];
            carried[n - 1] = radix;
            assert!(!roots.is_root(&carried), "{cartan_type}");
        }
    }
}

/// Carter, *Simple Groups of Lie Type*, theorem 4.2.1, with `p` counted on the set of all roots.
#[test]
fn chevalley_relations() {
    for cartan_type in types() {
        let roots = RootSystem::new(cartan_type);
        let (n, matrix) = (cartan_type.rank(), cartan_type.cartan_matrix());
        let constants = chevalley_constants(&roots);
        assert!(constants.windows(2).all(|w| (w[0].0, w[0].1, w[0].2) < (w[1].0, w[1].1, w[1].2)));
        assert!(constants.iter().all(|&(i, j, _, v)| i < j && v != 0), "{cartan_type}");

        let positive = coefficients(&roots);
        let count = positive.len();
        let vectors: Vec<Vec<i64>> =
            positive.iter().cloned().chain(positive.iter().map(|r| negative(r))).collect();
        let place: HashMap<&[i64], usize> =
            vectors.iter().enumerate().map(|(at, root)| (&root[..], at)).collect();
        let table = table(cartan_type.dimension(), &constants);

        for (a, alpha) in vectors.iter().enumerate() {
            for i in 0..n {
                let eigenvalue: i64 = alpha.iter().zip(&matrix).map(|(c, row)| c * row[i]).sum();
                let expected = Vec::from_iter((eigenvalue != 0).then_some((a, eigenvalue)));
                assert_eq!(table[2 * count + i][a], expected, "{cartan_type}");
            }
            for (b, beta) in vectors.iter().enumerate() {
                let bracket = &table[a][b];
                let sum = combine(alpha, 1, beta);
                if sum.iter().all(|&c| c == 0) {
                    // h_{-α} = -h_α, and h_α must act as α^∨: h_α e_α = 2 e_α.
                    assert!(bracket.iter().all(|&(k, _)| k >= 2 * count), "{cartan_type}");
                    let twice: i64 = bracket.iter().map(|&(k, v)| v * weight(&table[k][a])).sum();
                    assert_eq!(twice, 2, "{cartan_type}");
                } else if let Some(&c) = place.get(&sum[..]) {
                    let below = |k: i64| place.contains_key(&combine(beta, -k, alpha)[..]);
                    let p = (1..).take_while(|&k| below(k)).count() as i64;
                    assert!(matches!(bracket[..], [(k, v)] if k == c && v.abs() == p + 1));
                    let opposite = &table[(a + count) % (2 * count)][(b + count) % (2 * count)];
                    assert_eq!(opposite[0].1, -bracket[0].1, "{cartan_type}");
                } else {
                    assert!(bracket.is_empty(), "{cartan_type}");
                }
            }
        }
        // [e_α, f_α] of a simple root is its h, and the h commute.
        for i in 0..n {
            assert_eq!(table[i][count + i], [(2 * count + i, 1)], "{cartan_type}");
            assert!((0..n).all(|j| table[2 * count + i][2 * count + j].is_empty()));
        }
    }
}

/// The eigenvalue in `[h, e] = v e`.
fn weight(bracket: &[(usize, i64)]) -> i64 {
    bracket.iter().map(|&(_, v)| v).sum()
}

/// Among all `α + β` with one sum and `α` before `β`, the earliest has `N > 0`.
#[test]
fn extraspecial_pairs_are_positive() {
    for cartan_type in types() {
        let roots = RootSystem::new(cartan_type);
        let count = roots.positive_roots().len();
        let mut first = HashMap::new();
        for (i, j, k, v) in chevalley_constants(&roots) {
            if j < count {
                first.entry(k).or_insert((i, v));
            }
        }
        assert_eq!(first.len(), count - cartan_type.rank(), "{cartan_type}");
        assert!(first.values().all(|&(i, v)| i < cartan_type.rank() && v > 0), "{cartan_type}");
    }
}

#[test]
fn jacobi_for_all_triples() {
    for cartan_type in types() {
        let n = cartan_type.dimension();
        let table = table(n, &chevalley_constants(&RootSystem::new(cartan_type)));
        let (mut residual, mut touched) = (vec![0; n], Vec::new());
        for i in 0..n {
            for j in i + 1..n {
                for k in j + 1..n {
                    for (x, y, z) in [(i, j, k), (j, k, i), (k, i, j)] {
                        for &(m, v) in &table[x][y] {
                            for &(l, w) in &table[m][z] {
                                residual[l] += v * w;
                                touched.push(l);
                            }
                        }
                    }
                    for l in touched.drain(..) {
                        assert_eq!(residual[l], 0, "{cartan_type}: {:?}", (i, j, k));
                    }
                }
            }
        }
    }
}

/// `K = 2 h^∨ (·,·)` with the long roots of squared length 2: on the Cartan elements
/// `(h_i, h_j) = (α_i^∨, α_j^∨)`, and `(e_α, f_α) = 2/(α, α)`; all else is zero.
/// For E8 this is 60 times the Cartan matrix.
#[test]
fn the_killing_form_and_the_dual_coxeter_number() {
    for cartan_type in types() {
        let (n, r) = (cartan_type.dimension(), cartan_type.rank());
        let rank = r as i64;
        let dual_coxeter = match cartan_type.series() {
            Series::A => rank + 1,
            Series::B => 2 * rank - 1,
            Series::C => rank + 1,
            Series::D => 2 * rank - 2,
            Series::E => [12, 18, 30][r - 6],
            Series::F => 9,
            Series::G => 4,
        };
        let roots = RootSystem::new(cartan_type);
        let table = table(n, &chevalley_constants(&roots));
        let positive = roots.positive_roots();
        let count = positive.len();
        let matrix = cartan_type.cartan_matrix();
        let long = positive.iter().map(|root| root.squared_length()).max().expect("a root");
        for i in 0..n {
            for j in i..n {
                let mut trace = 0;
                for (l, bracket) in table[j].iter().enumerate() {
                    for &(m, v) in bracket {
                        let back = table[i][m].iter().filter(|&&(k, _)| k == l);
                        trace += back.map(|(_, w)| v * w).sum::<i64>();
                    }
                }
                let expected = if i >= 2 * count {
                    let (a, b) = (i - 2 * count, j - 2 * count);
                    2 * dual_coxeter * matrix[a][b] * long / positive[a].squared_length()
                } else if i < count && j == i + count {
                    2 * dual_coxeter * long / positive[i].squared_length()
                } else {
                    0
                };
                assert_eq!(trace, expected, "{cartan_type}: {:?}", (i, j));
            }
        }
    }
}

/// The contents of a file written by GAP: Cartan matrix, positive roots, constants with indices
/// from 0.
fn gap(text: &str) -> (Vec<Vec<i64>>, Vec<Vec<i64>>, Constants) {
    let numbers = |text: &str| -> Vec<i64> {
        text.split(|c: char| !c.is_ascii_digit() && c != '-')
            .filter(|word| !word.is_empty())
            .map(|word| word.parse().expect("a number"))
            .collect()
    };
    let (mut matrix, mut roots, mut constants) = (Vec::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(rows) = line.strip_prefix("# Cartan matrix rows:") {
            matrix = rows.split(']').map(numbers).filter(|row| !row.is_empty()).collect();
        } else if let Some(comment) = line.strip_prefix("# ") {
            if let Some((place, root)) = comment.split_once(": ")
                && place.parse() == Ok(roots.len() + 1)
            {
                roots.push(numbers(root));
            }
        } else {
            let row = numbers(line);
            let at = |n: usize| usize::try_from(row[n] - 1).expect("counted from 1");
            assert_eq!(row.len(), 4, "{line}");
            constants.push((at(0), at(1), at(2), row[3]));
        }
    }
    (matrix, roots, constants)
}

/// After `e_i -> s_i e_i` with signs `s_i`, our table is GAP's, entry by entry.
#[test]
fn agreement_with_gap() {
    let files = [
        (Series::E, 8, 8347, include_str!("../../examples/data/E8.txt")),
        (Series::G, 2, 60, include_str!("../data/G2.txt")),
    ];
    for (series, rank, lines, text) in files {
        let cartan_type = CartanType::new(series, rank).expect("a type that exists");
        let roots = RootSystem::new(cartan_type);
        let (matrix, positive, mut theirs) = gap(text);
        assert_eq!(cartan_type.cartan_matrix(), matrix, "{cartan_type}");
        assert_eq!(coefficients(&roots), positive, "{cartan_type}");
        assert_eq!(theirs.len(), lines, "{cartan_type}");

        let ours = chevalley_constants(&roots);
        let value: HashMap<_, i64> = theirs.iter().map(|&(i, j, k, v)| ((i, j, k), v)).collect();
        // Simple root vectors and Cartan elements keep their sign; the rest follows, because two
        // signs of an entry fix the third.
        let count = positive.len();
        let mut signs: Vec<i64> = (0..cartan_type.dimension())
            .map(|at| i64::from(at < rank || at >= 2 * count))
            .collect();
        while signs.contains(&0) {
            let before = signs.clone();
            for &(i, j, k, v) in &ours {
                let ratio = v.signum() * value.get(&(i, j, k)).map_or(0, |v| v.signum());
                match [i, j, k].map(|at| signs[at]) {
                    [a, b, 0] => signs[k] = ratio * a * b,
                    [a, 0, c] => signs[j] = ratio * a * c,
                    [0, b, c] => signs[i] = ratio * b * c,
                    _ => {}
                }
            }
            assert_ne!(signs, before, "{cartan_type}: the signs do not settle");
        }
        let mut signed: Constants = ours
            .iter()
            .map(|&(i, j, k, v)| (i, j, k, signs[i] * signs[j] * signs[k] * v))
            .collect();
        signed.sort_unstable();
        theirs.sort_unstable();
        for (ours, theirs) in signed.iter().zip(&theirs) {
            assert_eq!(ours, theirs, "{cartan_type}");
        }
        assert_eq!(signed.len(), theirs.len(), "{cartan_type}");
    }
}
