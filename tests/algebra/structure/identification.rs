//! Names of algebras of low dimension; their isomorphisms are checked by multiplication.

mod polynomials;

use crate::algebra::structure::{scrambled, stored};
use crate::common::algebras::catalogued;
use affinor::algebra::structure::{Identification, StructureTheory};
use affinor::{BasisChange, LieAlgebra, Rational, Tensor};
use affinor_tensors::{Down, Field, Up};

/// Checks that the algebra in the basis of the images has the brackets of the named algebra.
fn multiply_out(algebra: &LieAlgebra<Rational>, found: &Identification, name: &str) {
    let Some(images) = &found.isomorphism else { panic!("no isomorphism with {name}") };
    assert_eq!(found.under_root, None, "{name}");
    respects(algebra, images, &catalogued(name));
}

fn respects(
    algebra: &LieAlgebra<Rational>,
    images: &[Vec<Rational>],
    named: &LieAlgebra<Rational>,
) {
    let change = Tensor::from_fn(images.len(), [Up, Down], |[i, a]| images[a][i].clone()).unwrap();
    let moved = algebra.change_basis(&BasisChange::new(change).unwrap()).unwrap();
    assert_eq!(moved.structure_constants(), named.structure_constants());
}

#[test]
fn real_algebras_up_to_dimension_three() {
    let names = [
        "R^1",
        "R^2",
        "aff(1)",
        "bianchi(I)",
        "bianchi(II)",
        "bianchi(III)",
        "bianchi(IV)",
        "bianchi(V)",
        "bianchi(VI,h=-1)",
        "bianchi(VI,h=-1/2)",
        "bianchi(VI,h=1/3)",
        "bianchi(VII,h=0)",
        "bianchi(VII,h=2)",
        "bianchi(VII,h=1/2)",
        "bianchi(VIII)",
        "bianchi(IX)",
    ];
    for name in names {
        for seed in 0..4 {
            let algebra = scrambled(&catalogued(name), seed);
            let found = StructureTheory::new(algebra.clone()).identify().unwrap();
            assert_eq!(found.names, [name]);
            multiply_out(&algebra, &found, name);
        }
    }
}

#[test]
fn parameters_have_their_normal_form() {
    let named = |name: &str| StructureTheory::new(catalogued(name)).identify().unwrap();
    // h and 1/h give the same algebra; h = 1 and h = 0 are other types
    assert_eq!(named("bianchi(VI,h=2)").names, ["bianchi(VI,h=1/2)"]);
    assert_eq!(named("bianchi(VI,h=1)").names, ["bianchi(V)"]);
    assert_eq!(named("bianchi(VI,h=0)").names, ["bianchi(III)"]);
    assert_eq!(named("bianchi(VII,h=-2)").names, ["bianchi(VII,h=2)"]);
    assert_eq!(named("so(2,1)").names, ["bianchi(VIII)"]);
    assert_eq!(named("su(2)").names, ["bianchi(IX)"]);
    assert_eq!(named("se(2)").names, ["bianchi(VII,h=0)"]);
    // the eigenvalues 1 + sqrt 2 and 1 - sqrt 2, and 1/2 +- i sqrt 7/2
    let plane = |a: [i64; 4]| {
        let table = [(1, 3, 1, a[0]), (1, 3, 2, a[1]), (2, 3, 1, a[2]), (2, 3, 2, a[3])];
        StructureTheory::new(crate::common::algebras::by_table(3, &table)).identify().unwrap()
    };
    let real = plane([1, 1, 2, 1]);
    assert_eq!(
        (real.names[0].as_str(), real.parameter.unwrap().as_str()),
        ("bianchi(VI)", "h + 1/h = -6")
    );
    let complex = plane([0, 1, -2, 1]);
    assert_eq!(complex.names, ["bianchi(VII)"]);
    assert_eq!(complex.parameter.unwrap(), "h^2 = 1/7");
    assert_eq!(complex.isomorphism, None::<Vec<Vec<Rational>>>);
}

#[test]
fn real_algebras_of_dimension_four() {
    let names = [
        "bianchi(VIII)+R^1",
        "bianchi(IX)+R^1",
        "aff(1)+aff(1)",
        "aff(1)+R^2",
        "bianchi(IV)+R^1",
        "bianchi(V)+R^1",
        "bianchi(VI,h=-1/2)+R^1",
        "bianchi(VII,h=2)+R^1",
        "patera(4,2,a=1)",
        "patera(4,2,a=-2)",
        "patera(4,2,a=3)",
        "patera(4,3)",
        "patera(4,4)",
        "patera(4,5,a=1,b=1)",
        "patera(4,5,a=1/2,b=1)",
        "patera(4,5,a=-1/2,b=1/3)",
        "patera(4,6,a=1,b=0)",
        "patera(4,6,a=-2,b=1)",
        "patera(4,6,a=4/3,b=1/3)",
        "patera(4,7)",
        "patera(4,8)",
        "patera(4,9,b=1)",
        "patera(4,9,b=0)",
        "patera(4,9,b=-1/2)",
        "patera(4,10)",
        "patera(4,11,a=1)",
        "patera(4,11,a=1/2)",
        "patera(4,12)",
    ];
    for name in names {
        for seed in 0..3 {
            let algebra = scrambled(&catalogued(name), seed);
            let found = StructureTheory::new(algebra.clone()).identify().unwrap();
            assert_eq!((&found.names, &found.parameter), (&vec![name.to_string()], &None));
            multiply_out(&algebra, &found, name);
        }
    }
    let named =
        |name: &str| StructureTheory::new(catalogued(name)).identify().unwrap().names.remove(0);
    assert_eq!(named("oscillator(4)"), "patera(4,10)");
    assert_eq!(named("sim(2)"), "patera(4,12)");
    assert_eq!(named("gl(2)"), "bianchi(VIII)+R^1");
    assert_eq!(named("u(2)"), "bianchi(IX)+R^1");
    assert_eq!(named("patera(4,5,a=2,b=2)"), "patera(4,5,a=1/2,b=1)");
    // eigenvalues 1, sqrt 2, -sqrt 2
    let table = [(4, 1, 1, 1), (4, 2, 3, 1), (4, 3, 2, 2)];
    let open =
        StructureTheory::new(crate::common::algebras::by_table(4, &table)).identify().unwrap();
    assert!(open.names == ["patera(4,5)"] && open.parameter.is_some());
}

/// so(x^2 + y^2 + 3 z^2) and so(x^2 + y^2 - 3 z^2) are so(3) and so(2,1) over the real numbers
/// only. The vectors `v_i sqrt(r_i)` have the brackets of the named algebra: `[v_i, v_j] = c^k_ij
/// sqrt(r_k / (r_i r_j)) v_k`.
#[test]
fn isomorphisms_with_square_roots() {
    let rows =
        [(3, 1, "bianchi(IX)", 3), (-3, -3, "bianchi(VIII)", 3), (-3, -3, "bianchi(VIII)+R^1", 4)];
    for (alpha, beta, name, line) in rows {
        let table = [(1, 2, 3, 1), (2, 3, 1, alpha), (3, 1, 2, beta)];
        let algebra = crate::common::algebras::by_table(line, &table);
        let found = StructureTheory::new(algebra.clone()).identify().unwrap();
        assert_eq!(found.names, [name]);
        let (Some(images), Some(roots)) = (&found.isomorphism, &found.under_root) else {
            panic!("{name}: {found:?}")
        };
        respects_under_roots(&algebra, images, roots, &catalogued(name));
    }
}

/// Checks the brackets of the images, each times the square root of its number.
pub fn respects_under_roots(
    algebra: &LieAlgebra<Rational>,
    images: &[Vec<Rational>],
    roots: &[Rational],
    named: &LieAlgebra<Rational>,
) {
    let n = images.len();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let mut expected = vec![Rational::from(0); n];
        for (at, c) in named.structure_constants().components().filter(|(at, _)| at[1..] == [i, j])
        {
            let below = (roots[i].clone() * &roots[j]).recip().unwrap();
            let root = (roots[at[0]].clone() * &below).sqrt().expect("a square");
            for (sum, v) in expected.iter_mut().zip(&images[at[0]]) {
                *sum = sum.clone() + &(c.clone() * &root * v);
            }
        }
        assert_eq!(algebra.bracket(&images[i], &images[j]).unwrap(), expected);
    }
}

/// Nilpotent algebras of dimension 4 with their isomorphisms.
#[test]
fn nilpotent_algebras_of_dimension_four() {
    for name in ["R^4", "heisenberg(3)+R^1", "filiform(4)"] {
        for seed in 0..3 {
            let algebra = scrambled(&catalogued(name), seed);
            let found = StructureTheory::new(algebra.clone()).identify().unwrap();
            let [named] = &found.names[..] else { panic!("{found:?}") };
            multiply_out(&algebra, &found, named);
        }
    }
}

/// Nilpotent algebras of dimension 5 and 6, including sums, with their isomorphisms; the parameter
/// `e` may differ from the named one by a square.
#[test]
fn isomorphisms_of_nilpotent_algebras() {
    let families = ["6,19)", "6,21)", "6,22)", "6,24)"];
    let mut names = vec![];
    for name in affinor::algebra::catalogue::names(5)
        .into_iter()
        .chain(affinor::algebra::catalogue::names(6))
    {
        if families.iter().any(|family| name.ends_with(family)) {
            for e in ["0", "1", "-1", "4", "-9/4"] {
                names.push(name.replace(')', &format!(",e={e})")));
            }
        } else if name.starts_with("degraaf") {
            names.push(name);
        }
    }
    assert_eq!(names.len(), 6 + 13 + 4 * 5);
    let sums = ["degraaf(5,4)+R^1", "degraaf(5,6)+R^1", "degraaf(5,8)+R^1", "degraaf(5,9)+R^1"];
    names.extend(sums.map(String::from));
    let sums = ["degraaf(4,3)+R^1", "degraaf(4,3)+R^2", "degraaf(3,2)+R^2", "degraaf(3,2)+R^3"];
    names.extend(sums.map(String::from));
    for name in &names {
        // a normal form gives the isomorphisms of one family, a search the others
        for seed in 0..if name.starts_with("degraaf(6,24,") { 20 } else { 3 } {
            let algebra = scrambled(&summed(name), seed);
            let found = StructureTheory::new(algebra.clone()).identify().unwrap();
            let [named] = &found.names[..] else { panic!("{name}: {found:?}") };
            let Some(images) = &found.isomorphism else { panic!("{name} in basis {seed}") };
            respects(&algebra, images, &summed(named));
        }
    }
    // 3 is not a square: an isomorphism with e = 1 needs its root
    for family in [19, 21, 22, 24] {
        let found =
            StructureTheory::new(summed(&format!("degraaf(6,{family},e=3)"))).identify().unwrap();
        assert_eq!(found.names, [format!("degraaf(6,{family},e=1)")]);
        assert_eq!(found.isomorphism, None);
    }
}

fn summed(names: &str) -> LieAlgebra<Rational> {
    let sum = |a: LieAlgebra<Rational>, b| a.direct_sum(&b).unwrap();
    names.split('+').map(catalogued).reduce(sum).unwrap()
}

/// Each nilpotent algebra is identified with itself, including the sign of a parameter.
#[test]
fn nilpotent_algebras_up_to_dimension_six() {
    for (at, name) in affinor::algebra::catalogue::names(6).into_iter().enumerate() {
        let Some(number) = name.strip_prefix("degraaf(6,") else { continue };
        let number = number.trim_end_matches(')');
        let open = ["19", "21", "22", "24"].contains(&number);
        for e in if open { vec!["0", "1", "-1"] } else { vec![""] } {
            let full = if open { format!("degraaf(6,{number},e={e})") } else { name.clone() };
            let algebra = scrambled(&catalogued(&full), at as i64);
            let found = StructureTheory::new(algebra).identify().unwrap().names;
            assert_eq!(found, std::slice::from_ref(&full));
        }
    }
    let named = |name: &str| StructureTheory::new(catalogued(name)).identify().unwrap().names;
    assert_eq!(named("n(4)"), ["degraaf(6,19,e=-1)"]);
    assert_eq!(named("heisenberg(3)+heisenberg(3)"), ["degraaf(6,22,e=1)"]);
    for family in [19, 21, 22, 24] {
        for (e, sign) in [("3", "1"), ("1/2", "1"), ("-5", "-1")] {
            let found = named(&format!("degraaf(6,{family},e={e})"));
            assert_eq!(found, [format!("degraaf(6,{family},e={sign})")]);
        }
    }
    for (algebra, entry) in stored().into_iter().filter(|(_, entry)| entry["nilpotent"] == true) {
        if algebra.dimension() < 6 {
            let found = StructureTheory::new(algebra).identify().unwrap();
            assert_eq!(found.names.len(), 1, "{}", entry["name"]);
        }
    }
}

/// sl(2) over the rationals has a vector with Killing square 0, which gives a rational isomorphism.
#[test]
fn split_algebras_have_rational_isomorphisms() {
    for scale in [2, 3, 5, 7, -7, 11, 13, 30, 97, -101, 1009] {
        let table = [(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, scale)];
        for (n, name) in [(3, "bianchi(VIII)"), (4, "bianchi(VIII)+R^1")] {
            let plain = crate::common::algebras::by_table(n, &table);
            for algebra in [plain.clone(), scrambled(&plain, scale)] {
                let found = StructureTheory::new(algebra.clone()).identify().unwrap();
                assert_eq!(found.names, [name]);
                multiply_out(&algebra, &found, name);
            }
        }
    }
}
