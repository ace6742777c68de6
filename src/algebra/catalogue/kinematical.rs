//! Algebras of kinematics: Poincare, Galilei, conformal, similarities, homotheties, Schroedinger,
//! oscillator.

use super::orthogonal::rotations;
use super::{Entry, Family, Reader, numbered, pair_count};
use affinor_tensors::{Ring, Symbolic};

/// The family iso(p,q).
pub(super) const POINCARE: Family = Family {
    pattern: "iso(p,q)",
    needs: "p, q >= 1",
    summary: "motions of R^p,q, iso(3,1) is the Poincare algebra; basis e1.. as in so(p,q), then the \
              translations p1..pn = E_i,n+1",
    example: "iso(3,1)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| {
            let m = n[0].saturating_add(n[1]);
            (n[0] >= 1 && n[1] >= 1).then(|| pair_count(m.saturating_add(1)))
        },
        build: |name, n| poincare(name, &[vec![1; n[0]], vec![-1; n[1]]].concat()),
    },
};

/// The family galilei(n).
pub(super) const GALILEI: Family = Family {
    pattern: "galilei(n)",
    needs: "n >= 1",
    summary: "Galilei algebra of space R^n and time; basis e1.. as in so(n), boosts v1..vn, translations \
              p1..pn, time t: [v_i,t] = p_i",
    example: "galilei(3)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| {
            (n[0] >= 1)
                .then(|| pair_count(n[0]).saturating_add(n[0].saturating_mul(2)).saturating_add(1))
        },
        build: |name, n| galilei(name, n[0]),
    },
};

/// The family sim(n).
pub(super) const SIMILARITIES: Family = Family {
    pattern: "sim(n)",
    needs: "n >= 1",
    summary: "similarities of R^n; basis e1.. as in so(n), dilation d, translations p1..pn: [d,p_i] = p_i",
    example: "sim(2)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| pair_count(n[0].saturating_add(1)).saturating_add(1)),
        build: |name, n| similarities(name, n[0]),
    },
};

/// The family hom(n).
pub(super) const HOMOTHETIES: Family = Family {
    pattern: "hom(n)",
    needs: "n >= 1",
    summary: "translations and dilations of R^n, a frame of hyperbolic space; basis d, translations p1..pn: \
              [d,p_i] = p_i",
    example: "hom(2)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 1).then(|| n[0].saturating_add(1)),
        build: |name, n| homotheties(name, n[0]),
    },
};

/// The family conformal(p,q).
pub(super) const CONFORMAL: Family = Family {
    pattern: "conformal(p,q)",
    needs: "p, q >= 1",
    summary: "conformal algebra of R^p,q, isomorphic to so(p+1,q+1); basis e1.. as in so(p,q), translations \
              p1..pn, dilation d, special conformal k1..kn: [d,p_i] = p_i, [d,k_i] = -k_i",
    example: "conformal(3,1)",
    reader: Reader::Integers {
        count: 2,
        dimension: |n| {
            let m = n[0].saturating_add(n[1]);
            (n[0] >= 1 && n[1] >= 1).then(|| pair_count(m.saturating_add(2)))
        },
        build: |name, n| conformal(name, &[vec![1; n[0]], vec![-1; n[1]]].concat()),
    },
};

/// The family oscillator(2m+2).
pub(super) const OSCILLATOR: Family = Family {
    pattern: "oscillator(2m+2)",
    needs: "an even number, at least 4",
    summary: "solvable, with invariant Lorentz metric; basis h, x1..xm, y1..ym, z: [h,x_i] = y_i, \
              [h,y_i] = -x_i, [x_i,y_i] = z",
    example: "oscillator(4)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| (n[0] >= 4 && n[0].is_multiple_of(2)).then_some(n[0]),
        build: |name, n| oscillator(name, n[0] / 2 - 1),
    },
};

/// The family schroedinger(n).
pub(super) const SCHROEDINGER: Family = Family {
    pattern: "schroedinger(n)",
    needs: "n >= 1",
    summary: "symmetries of the free Schroedinger equation on R^n; basis e1.. as in so(n), h, a, b, x1..xn, \
              y1..yn, z: [h,a] = 2a, [h,b] = -2b, [a,b] = h, [h,x_i] = x_i, [h,y_i] = -y_i, [a,y_i] = x_i, \
              [b,x_i] = y_i, [x_i,y_i] = z",
    example: "schroedinger(1)",
    reader: Reader::Integers {
        count: 1,
        dimension: |n| {
            (n[0] >= 1)
                .then(|| pair_count(n[0]).saturating_add(n[0].saturating_mul(2)).saturating_add(4))
        },
        build: |name, n| schroedinger(name, n[0]),
    },
};

fn poincare(name: String, signs: &[i64]) -> Entry {
    let n = signs.len();
    let labels = [numbered("e", pair_count(n)), numbered("p", n)].concat();
    let translations = (0..n).map(|i| vec![(i, n, 1)]);
    Entry::of_integer_matrices(name, labels, n + 1, rotations(signs).chain(translations))
}

fn galilei(name: String, n: usize) -> Entry {
    let time = vec!["t".to_string()];
    let labels = [numbered("e", pair_count(n)), numbered("v", n), numbered("p", n), time].concat();
    let columns = (n..n + 2).flat_map(|column| (0..n).map(move |i| vec![(i, column, 1)]));
    let signs = vec![1; n];
    let matrices = rotations(&signs).chain(columns).chain([vec![(n, n + 1, 1)]]);
    Entry::of_integer_matrices(name, labels, n + 2, matrices)
}

fn similarities(name: String, n: usize) -> Entry {
    let labels = [numbered("e", pair_count(n)), vec!["d".into()], numbered("p", n)].concat();
    let dilation = (0..n).map(|i| (i, i, 1)).collect();
    let translations = (0..n).map(|i| vec![(i, n, 1)]);
    let signs = vec![1; n];
    let matrices = rotations(&signs).chain([dilation]).chain(translations);
    Entry::of_integer_matrices(name, labels, n + 1, matrices)
}

fn homotheties(name: String, n: usize) -> Entry {
    let labels = [vec!["d".into()], numbered("p", n)].concat();
    let dilation = (0..n).map(|i| (i, i, 1)).collect();
    let translations = (0..n).map(|i| vec![(i, n, 1)]);
    Entry::of_integer_matrices(name, labels, n + 1, [dilation].into_iter().chain(translations))
}

/// The algebra of the matrices that preserve the quadratic form `eta + 2 x_n x_(n+1)`.
fn conformal(name: String, signs: &[i64]) -> Entry {
    let n = signs.len();
    let names = [numbered("p", n), vec!["d".into()], numbered("k", n)].concat();
    let labels = [numbered("e", pair_count(n)), names].concat();
    let (zero, infinity) = (n, n + 1);
    let moved = |from, to| {
        let images = signs.iter().enumerate();
        images.map(move |(i, sign)| vec![(i, from, 1), (to, i, -sign)]).collect::<Vec<_>>()
    };
    let (translations, special) = (moved(infinity, zero), moved(zero, infinity));
    let dilation = vec![(zero, zero, 1), (infinity, infinity, -1)];
    let matrices = rotations(signs).chain(translations).chain([dilation]).chain(special);
    Entry::of_integer_matrices(name, labels, n + 2, matrices)
}

fn oscillator(name: String, m: usize) -> Entry {
    let names = [vec!["h".into()], numbered("x", m), numbered("y", m), vec!["z".into()]];
    let constants = (1..=m).flat_map(|x| {
        let y = x + m;
        [(0, x, y, 1), (0, y, x, -1), (x, y, 2 * m + 1, 1)]
    });
    Entry::of_integers(name, names.concat(), constants)
}

fn schroedinger(name: String, n: usize) -> Entry {
    let r = pair_count(n);
    let sl2 = ["h", "a", "b"].map(String::from).to_vec();
    let names = [numbered("e", r), sl2, numbered("x", n), numbered("y", n), vec!["z".into()]];
    let (h, a, b) = (r, r + 1, r + 2);
    let (x, y, z) = (r + 3, r + 3 + n, r + 3 + 2 * n);
    let turning =
        poincare(String::new(), &vec![1; n]).constants.into_iter().flat_map(|(j, k, i, v)| {
            let value = v.clone();
            match (k < r, i < r) {
                (true, _) => vec![(j, k, i, value)],
                _ => vec![(j, k - r + x, i - r + x, value), (j, k - r + y, i - r + y, v)],
            }
        });
    let rest = (0..n).flat_map(move |i| {
        [
            (h, x + i, x + i, 1),
            (h, y + i, y + i, -1),
            (a, y + i, x + i, 1),
            (b, x + i, y + i, 1),
            (x + i, y + i, z, 1),
        ]
    });
    let rest = [(h, a, a, 2), (h, b, b, -2), (a, b, h, 1)].into_iter().chain(rest);
    let rest = rest.map(|(j, k, i, value)| (j, k, i, Symbolic::from_i64(value)));
    Entry::new(name, names.concat(), turning.chain(rest))
}
