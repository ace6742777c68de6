//! The kernel at the sizes where it takes another path: large dimensions with few components.

use crate::common::oracle;
use affinor_tensors::{Down, Rational, Tensor, TensorError, Up, Variance, contract};
use oracle::{oracle, stored};
use std::collections::BTreeMap;

type Test = Result<(), TensorError>;

/// Ranks with the largest dimension whose leading indices, all but two, take at most 2^22 values.
const EDGES: [(usize, usize); 5] = [(4, 2048), (5, 161), (6, 45), (7, 21), (8, 12)];

/// Numbers without a pattern: the generator of D. E. Knuth's MMIX.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % bound as u64) as usize
    }
}

/// Few components anywhere, some of them at the first and the last indices.
fn sparse(n: usize, slots: &[Variance], count: usize, seed: u64) -> Tensor<Rational> {
    let mut numbers = Numbers(seed);
    let components: Vec<_> = (0..count)
        .map(|_| {
            let index = |numbers: &mut Numbers| match numbers.below(6) {
                0 => 0,
                1 => n - 1,
                _ => numbers.below(n),
            };
            let at: Vec<usize> = slots.iter().map(|_| index(&mut numbers)).collect();
            let value = Rational::new(numbers.below(19) as i64 - 9, 1 + numbers.below(3) as i64);
            (at, value.unwrap())
        })
        .collect();
    Tensor::from_components(n, slots, components).unwrap()
}

fn agrees(text: &str, operands: &[(&str, &Tensor<Rational>)]) {
    let expected: Vec<_> = oracle(text, operands).into_iter().collect();
    let result = contract(text, operands).unwrap();
    assert_eq!(result.len(), expected.len(), "{text} in dimension {}", result.dimension());
    assert_eq!(stored(&result), expected, "{text} in dimension {}", result.dimension());
}

/// Orders of so many letters: backwards, turned round, two exchanged.
fn orders(letters: &str) -> Vec<String> {
    let (first, rest) = letters.split_at(1);
    let (head, tail) = letters.split_at(letters.len() - 2);
    let exchanged: String = tail.chars().rev().collect();
    vec![
        letters.chars().rev().collect(),
        format!("{rest}{first}"),
        format!("{head}{exchanged}"),
        format!("{rest}{first}").chars().rev().collect(),
    ]
}

#[test]
fn slots_in_another_order() {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let letters = &"abcdefgh"[..rank];
            let t = sparse(n, &[Down; 8][..rank], 200, rank as u64);
            for order in orders(letters) {
                agrees(&format!("T_{order} -> _{letters}"), &[("T", &t)]);
                agrees(&format!("2 T_{order} - T_{letters} -> _{letters}"), &[("T", &t)]);
            }
        }
    }
}

/// The means over the orders of some slots, against the same by `permute`.
#[test]
fn symmetrisers() -> Test {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let t = sparse(n, &[Down; 8][..rank], 60, 100 + rank as u64);
            for slots in [[0, rank - 1, 1], [rank - 3, rank - 2, rank - 1]] {
                let mut means = [BTreeMap::new(), BTreeMap::new()];
                for (sign, order) in [
                    (1, [0, 1, 2]),
                    (-1, [1, 0, 2]),
                    (-1, [0, 2, 1]),
                    (-1, [2, 1, 0]),
                    (1, [1, 2, 0]),
                    (1, [2, 0, 1]),
                ] {
                    let mut moved: Vec<usize> = (0..rank).collect();
                    (0..3).for_each(|at| moved[slots[at]] = slots[order[at]]);
                    for (at, value) in stored(&t.permute(&moved)?) {
                        for (mean, sign) in means.iter_mut().zip([1, sign]) {
                            let part = value.clone() * &Rational::new(sign, 6).unwrap();
                            let sum: &mut Rational =
                                mean.entry(at.clone()).or_insert(Rational::from(0));
                            *sum = sum.clone() + &part;
                        }
                    }
                }
                let [symmetric, antisymmetric] = means.map(|mean| {
                    let zero = Rational::from(0);
                    mean.into_iter().filter(|(_, value)| *value != zero).collect::<Vec<_>>()
                });
                assert_eq!(stored(&t.symmetrise(&slots)?), symmetric, "{rank} {n} {slots:?}");
                assert_eq!(stored(&t.antisymmetrise(&slots)?), antisymmetric, "{rank} {n}");
            }
        }
    }
    Ok(())
}

/// A declared antisymmetry, of two and of three letters, at the end and in the loops.
#[test]
fn declared_antisymmetries() -> Test {
    for (rank, edge) in EDGES {
        for n in [edge, edge + 1] {
            let letters = &"abcdefgh"[..rank];
            let (head, tail) = letters.split_at(rank - 3);
            let t = sparse(n, &[Down; 8][..rank], 60, 200 + rank as u64);
            let last = t.antisymmetrise(&[rank - 3, rank - 2, rank - 1])?;
            let first = t.antisymmetrise(&[0, 1])?;
            for (text, tensor) in [
                (format!("T_{letters} -> _{head}[{tail}]"), &last),
                (format!("T_{tail}{head} -> _{tail}{head}"), &last),
                (format!("T_{head}{tail} -> _[{tail}]{head}"), &last),
                (format!("T_{letters} -> _[ab]{}", &letters[2..]), &first),
            ] {
                let plain = text.replace(['[', ']'], "");
                let expected: Vec<_> = oracle(&plain, &[("T", tensor)]).into_iter().collect();
                assert!(!expected.is_empty());
                let result = contract(&text, &[("T", tensor)])?;
                assert_eq!(stored(&result), expected, "{text} in dimension {n}");
            }
        }
    }
    Ok(())
}

/// Two factors: the tables of all rows and of nonempty rows at the edge, in either factor.
#[test]
fn products() {
    for (edge, a, b, texts) in [
        // n^3 rows in a table up to 161; n^2 ceil(n/64) words of bits up to 640
        (161, "^--", "^--", ["A^i_jp B^p_kl -> ^i_jkl", "A^p_il B^j_pk -> _i^j_kl"]),
        (640, "^--", "^--", ["A^i_jp B^p_kl -> ^i_jkl", "A^p_il B^j_pk -> _i^j_kl"]),
        (161, "^---", "^--", ["A^p_ijk B^l_pm -> ^l_kjim", "A^i_jkp B^p_lm -> _jkl^i_m"]),
        (45, "^---", "^---", ["A^i_jkp B^p_lmn -> ^i_jklmn", "A^p_ijk B^l_mnp -> _nmkji^l"]),
        (45, "^^--", "^---", ["A^pq_ij B^k_lpq -> _ijl^k", "A^pi_qj B^q_klp -> _klj^i"]),
        (21, "^----", "^---", ["A^p_ijkl B^m_pno -> ^m_ijklno", "A^i_jklp B^p_mno -> _lnmkjo^i"]),
        (
            12,
            "^----",
            "^----",
            ["A^p_ijkl B^m_pnor -> ^m_ijklnor", "A^q_ijkl B^m_nrsq -> _srnlkji^m"],
        ),
    ] {
        for n in [edge, edge + 1] {
            let slots = |marks: &str| -> Vec<Variance> {
                marks.chars().map(|mark| if mark == '^' { Up } else { Down }).collect()
            };
            let (a, b) = (sparse(n, &slots(a), 150, 7), sparse(n, &slots(b), 150, 8));
            for text in texts {
                agrees(text, &[("A", &a), ("B", &b)]);
            }
        }
    }
}

/// Results of rank 0 to 2 in dimensions whose tables and bits would not fit a memory.
#[test]
fn low_ranks_in_high_dimensions() -> Test {
    let components = |n: usize, slots: &[Variance], seed| sparse(n, slots, 120, seed);
    for n in [1 << 20, 1 << 31, (1 << 32) - 1] {
        let (s, t) = (components(n, &[Up, Up], 1), components(n, &[Down, Down], 2));
        let (m, v) = (components(n, &[Up, Down], 3), components(n, &[Down], 4));
        let operands = [("S", &s), ("T", &t), ("M", &m), ("v", &v)];
        for text in
            ["S^pq T_pq ->", "S^pq T_qp ->", "M^p_p ->", "M^p_q M^q_p ->", "S^pq T_pq - M^p_p ->"]
        {
            agrees(text, &operands);
        }
    }
    for n in [1 << 40, usize::MAX - 1] {
        let (v, w) = (components(n, &[Down], 5), components(n, &[Up], 6));
        agrees("v_p w^p ->", &[("v", &v), ("w", &w)]);
    }
    for n in [2_642_245, (1 << 16) - 1] {
        let (c, d) = (components(n, &[Up, Down, Down], 7), components(n, &[Up, Up, Down], 8));
        let operands = [("c", &c), ("d", &d)];
        for text in
            ["c^p_pi d^iq_q ->", "c^i_pq d^pq_i ->", "c^p_pi -> _i", "d^pi_p - d^ip_p -> ^i"]
        {
            agrees(text, &operands);
        }
        let refused = TensorError::TooLarge { dimension: n, rank: 2 };
        assert_eq!(contract("c^p_qi d^qr_p -> _i^r", &operands).unwrap_err(), refused);
    }
    Ok(())
}

/// The largest dimensions of a result: 4096 with two indices, 2^24 with one.
#[test]
fn the_largest_results() -> Test {
    for n in [2049, 4096] {
        let (c, m) = (sparse(n, &[Up, Down, Down], 150, 1), sparse(n, &[Up, Down], 150, 2));
        let operands = [("c", &c), ("m", &m)];
        for text in [
            "m^i_p m^p_j -> ^i_j",
            "c^p_qi c^q_pj -> _ij",
            "c^i_pk m^p_j -> ^i_jk",
            "c^i_jp m^p_k - c^i_pj m^p_k -> _k^i_j",
        ] {
            agrees(text, &operands);
        }
    }
    for n in [(1 << 24) - 1, 1 << 24] {
        let (m, v) = (sparse(n, &[Up, Down], 150, 3), sparse(n, &[Up], 150, 4));
        let operands = [("m", &m), ("v", &v)];
        agrees("m^i_p v^p -> ^i", &operands);
        agrees("2 v^i - m^i_p v^p -> ^i", &operands);
    }
    let past = sparse((1 << 24) + 1, &[Up], 3, 5);
    let refused = |dimension, rank| Err(TensorError::TooLarge { dimension, rank });
    assert_eq!(contract("v^i -> ^i", &[("v", &past)]), refused((1 << 24) + 1, 1));
    let past = sparse(4097, &[Up, Down], 3, 6);
    assert_eq!(contract("m^i_j -> ^i_j", &[("m", &past)]), refused(4097, 2));
    Ok(())
}

/// Keys up to the last one below 2^64.
#[test]
fn keys_near_64_bits() -> Test {
    for (rank, n) in [(5, 4096), (6, 1625), (7, 565), (8, 255)] {
        let letters = &"abcdefgh"[..rank];
        let t = sparse(n, &[Down; 8][..rank], 80, rank as u64);
        let last = Tensor::from_components(n, t.slots(), [(vec![n - 1; rank], Rational::from(3))])?;
        let operands = [("T", &t), ("L", &last)];
        for order in orders(letters) {
            agrees(&format!("T_{order} + L_{letters} -> _{letters}"), &operands);
        }
        let vector = sparse(n, &[Up], 40, 9);
        let first = &letters[..rank - 1];
        agrees(&format!("T_{first}p v^p -> _{first}"), &[("T", &t), ("v", &vector)]);
        agrees(&format!("L_p{first} v^p -> _{first}"), &[("L", &last), ("v", &vector)]);
    }
    for (rank, n) in [(6, 1626), (7, 566), (8, 256)] {
        let refused = TensorError::TooLarge { dimension: n, rank };
        assert_eq!(Tensor::<Rational>::zero(n, &[Down; 8][..rank]).unwrap_err(), refused);
    }
    Ok(())
}
