//! Nilpotent families, free and filiform, and the solvable algebras of Damek and Ricci.

use super::{Entry, Family, MAX_DIMENSION, Reader, numbered};
use affinor_tensors::{Rational, Symbolic};
use std::collections::BTreeMap;

/// The family free_nilpotent(g,s).
pub(super) const FREE: Family = Family {
    pattern: "free_nilpotent(g,s)",
    needs: "from 2 to 9 generators, and a step >= 1",
    summary: "free nilpotent algebra of g generators and step s; the basis are the Lyndon words by length, \
              x1, x2, x12, x112, ..: a word is the bracket of its standard factors",
    example: "free_nilpotent(2,3)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| ((2..10).contains(&n[0]) && n[1] >= 1).then(|| free_dimension(n[0], n[1])),
        build: |name, n| free(name, n[0], n[1]),
    },
};

/// The family filiform(n).
pub(super) const FILIFORM: Family = Family {
    pattern: "filiform(n)",
    needs: "n >= 3",
    summary: "standard filiform, of step n - 1; basis e1..en: [e1,e_i] = e_i+1",
    example: "filiform(5)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 3).then_some(n[0]),
        build: |name, n| {
            let constants = (1..n[0] - 1).map(|i| (0, i, i + 1, 1));
            Entry::of_integers(name, numbered("e", n[0]), constants)
        },
    },
};

/// The family filiform_q(n).
pub(super) const FILIFORM_Q: Family = Family {
    pattern: "filiform_q(n)",
    needs: "an even number, at least 6",
    summary: "filiform, of step n - 1; basis e1..en: [e1,e_i] = e_i+1 for i < n - 1, \
              [e_i,e_n+1-i] = (-1)^i e_n for 1 < i <= n/2",
    example: "filiform_q(6)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 6 && n[0].is_multiple_of(2)).then_some(n[0]),
        build: |name, n| {
            let n = n[0];
            let chain = (1..n - 2).map(|i| (0, i, i + 1, 1));
            let crossed =
                (1..n / 2).map(|i| (i, n - 1 - i, n - 1, if i % 2 == 1 { 1 } else { -1 }));
            Entry::of_integers(name, numbered("e", n), chain.chain(crossed))
        },
    },
};

/// The family damek_ricci(m,k).
pub(super) const DAMEK_RICCI: Family = Family {
    pattern: "damek_ricci(m,k)",
    needs: "m >= 1 and k = 1, 2, 3",
    summary: "solvable extension of the algebra of type H on H^m with centre spanned by k of the units \
              i, j, k; basis a, v1..v4m, z1..zk: [a,v] = v/2, [a,z] = z, <[v,w],z_q> = <q v, w>",
    example: "damek_ricci(1,2)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| {
            (n[0] >= 1 && (1..=3).contains(&n[1]))
                .then(|| n[0].saturating_mul(4).saturating_add(n[1] + 1))
        },
        build: |name, n| damek_ricci(name, n[0], n[1]),
    },
};

/// The dimension of the free nilpotent algebra by Witt's formula. There are
/// `1/l sum over d of mu(d) g^(l/d)` Lyndon words of length `l`; the dimension is the sum over the
/// lengths `l`.
fn free_dimension(generators: usize, step: usize) -> usize {
    let mut total = 0usize;
    for length in 1..=step.min(64) {
        let divisors = (1..=length).filter(|d| length.is_multiple_of(*d));
        let sum = divisors.fold(0i128, |sum, d| {
            let power = (0..length / d).fold(1i128, |p, _| p.saturating_mul(generators as i128));
            sum.saturating_add(power.saturating_mul(moebius(d)))
        });
        total = total.saturating_add(usize::try_from(sum / length as i128).unwrap_or(usize::MAX));
        if total > MAX_DIMENSION {
            return usize::MAX;
        }
    }
    total
}

fn moebius(n: usize) -> i128 {
    let mut rest = n;
    let mut sign = 1;
    for prime in 2..=n {
        if rest.is_multiple_of(prime) {
            rest /= prime;
            sign = -sign;
            if rest.is_multiple_of(prime) {
                return 0;
            }
        }
    }
    sign
}

type Word = Vec<u8>;
/// A linear combination of words.
type Polynomial = BTreeMap<Word, i64>;

/// The Lyndon words up to a length, by length and then in alphabetical order (J.-P. Duval's
/// algorithm).
fn lyndon(generators: usize, step: usize) -> Vec<Word> {
    let mut words = vec![];
    let mut word: Word = vec![0];
    while !word.is_empty() {
        words.push(word.clone());
        let period = word.len();
        while word.len() < step {
            word.push(word[word.len() - period]);
        }
        while word.last().is_some_and(|&letter| usize::from(letter) + 1 == generators) {
            word.pop();
        }
        if let Some(letter) = word.last_mut() {
            *letter += 1;
        }
    }
    words.sort_by_key(|word| (word.len(), word.clone()));
    words
}

/// The commutator of two combinations of words.
fn commutator(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut result = Polynomial::new();
    for (u, x) in a {
        for (v, y) in b {
            *result.entry([&u[..], v].concat()).or_default() += x * y;
            *result.entry([&v[..], u].concat()).or_default() -= x * y;
        }
    }
    result.retain(|_, value| *value != 0);
    result
}

/// The algebra free_nilpotent(g,s) in the basis of the polynomials of the Lyndon words. The
/// polynomial of a Lyndon word is the word plus larger words. The coefficients of a Lie polynomial
/// in this basis are therefore found word by word (C. Reutenauer, *Free Lie Algebras*, theorem
/// 5.1).
fn free(name: String, generators: usize, step: usize) -> Entry {
    let words = lyndon(generators, step);
    let places: BTreeMap<&Word, usize> = words.iter().zip(0..).collect();
    let mut polynomials: Vec<Polynomial> = vec![];
    for word in &words {
        let polynomial = match word.len() {
            1 => Polynomial::from([(word.clone(), 1)]),
            _ => {
                // finds the longest proper suffix that is a Lyndon word
                let cut = (1..word.len()).find(|&cut| places.contains_key(&word[cut..].to_vec()));
                let cut = cut.unwrap_or(1);
                let (left, right) = (places[&word[..cut].to_vec()], places[&word[cut..].to_vec()]);
                commutator(&polynomials[left], &polynomials[right])
            }
        };
        polynomials.push(polynomial);
    }
    let mut constants = vec![];
    for j in 0..words.len() {
        for k in j + 1..words.len() {
            if words[j].len() + words[k].len() > step {
                break;
            }
            let mut rest = commutator(&polynomials[j], &polynomials[k]);
            while let Some((word, value)) = rest.pop_first() {
                let i = places[&word];
                for (other, factor) in &polynomials[i] {
                    if *other != word {
                        *rest.entry(other.clone()).or_default() -= value * factor;
                    }
                }
                rest.retain(|_, value| *value != 0);
                constants.push((j, k, i, value));
            }
        }
    }
    let letters =
        |word: &Word| word.iter().map(|letter| char::from(b'1' + letter)).collect::<String>();
    let labels = words.iter().map(|word| format!("x{}", letters(word))).collect();
    Entry::of_integers(name, labels, constants)
}

fn damek_ricci(name: String, m: usize, k: usize) -> Entry {
    let labels = [vec!["a".into()], numbered("v", 4 * m), numbered("z", k)].concat();
    let constant = |n: i64, d: i64| Rational::new(n, d).map(Symbolic::constant).unwrap_or_default();
    let scaled = (1..=4 * m).map(|v| (0, v, v, constant(1, 2)));
    let scaled = scaled.chain((1..=k).map(|z| (0, 4 * m + z, 4 * m + z, constant(1, 1))));
    // multiplication by the unit quaternion q maps 1 to q, and the next unit to the unit after that
    let products = |q: usize| {
        let (next, after) = (q % 3 + 1, (q + 1) % 3 + 1);
        [(0, q, 1), (next, after, 1)]
    };
    let brackets = (0..m).flat_map(move |block| {
        (1..=k).flat_map(move |q| {
            products(q).map(move |(x, y, sign)| {
                let (x, y) = (1 + 4 * block + x, 1 + 4 * block + y);
                let (j, k, sign) = if x < y { (x, y, sign) } else { (y, x, -sign) };
                (j, k, 4 * m + q, constant(sign, 1))
            })
        })
    });
    Entry::new(name, labels, scaled.chain(brackets))
}
