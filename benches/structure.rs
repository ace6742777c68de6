//! Run times of structure theory: types of algebras in dense bases, Levi subalgebras, large
//! nilpotent algebras.
//!
//! `cargo bench -p affinor-benches --bench structure` prints one line per task. A dense basis is
//! the result of random elementary changes of the basis, three for each basis vector.

use affinor::algebra::catalogue;
use affinor::algebra::structure::StructureTheory;
use affinor::{BasisChange, Bracket, LieAlgebra, Rational, Tensor};
use affinor_tensors::{Down, Ring, Up};
use std::time::Instant;

type Algebra = LieAlgebra<Rational>;

fn timed<R>(task: &str, run: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = run();
    println!("{task:52} {:9.3} s", start.elapsed().as_secs_f64());
    result
}

fn named(name: &str) -> Algebra {
    catalogue::algebra(name).unwrap()
}

/// The algebra in the basis after the elementary changes `e_a += e_b` or `e_a -= e_b`.
fn scrambled(algebra: &Algebra, changes: usize) -> Algebra {
    let n = algebra.dimension();
    let mut seed = 1u64;
    let mut draw = |below: usize| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as usize % below
    };
    let mut columns: Vec<Vec<i64>> =
        (0..n).map(|a| (0..n).map(|i| i64::from(i == a)).collect()).collect();
    for _ in 0..changes {
        let (a, b) = (draw(n), draw(n));
        let sign = if draw(2) == 0 { 1 } else { -1 };
        if a != b {
            let other = columns[b].clone();
            columns[a].iter_mut().zip(other).for_each(|(v, w)| *v += sign * w);
        }
    }
    let matrix =
        Tensor::from_fn(n, [Up, Down], |[i, a]| Rational::from_i64(columns[a][i])).unwrap();
    algebra.change_basis(&BasisChange::new(matrix).unwrap()).unwrap()
}

fn main() {
    for name in ["F4", "E6", "E7", "E8"] {
        let plain = named(name);
        let n = plain.dimension();
        let table = scrambled(&plain, if n > 200 { n } else { 3 * n });
        let size = table.structure_constants().len();
        let task = format!("type of scrambled {name}, {size} constants");
        let types = timed(&task, || StructureTheory::new(table).dynkin_type().unwrap());
        assert_eq!(types[0].to_string(), name);
    }
    let parabolic = named("parabolic(E7,7)");
    let task = format!("Levi subalgebra of parabolic(E7,7), dimension {}", parabolic.dimension());
    let levi = timed(&task, || StructureTheory::new(parabolic).levi().unwrap().dimension());
    assert_eq!(levi, 78);
    for name in ["parabolic(E7,1,3,6)", "borel(E7)"] {
        let algebra = named(name);
        let task = format!("radical, nilradical, Levi of {name}");
        timed(&task, || {
            let structure = StructureTheory::new(algebra);
            (structure.nilradical().dimension(), structure.levi().unwrap().dimension())
        });
    }
    let e8 = named("E8");
    timed("E8: Killing form and its determinant", || {
        StructureTheory::new(e8).killing().determinant()
    });
    for name in ["filiform(200)", "n(20)", "free_nilpotent(3,6)"] {
        let algebra = named(name);
        let task =
            format!("series, centre, nilradical of {name}, dimension {}", algebra.dimension());
        timed(&task, || {
            let structure = StructureTheory::new(algebra);
            let series =
                structure.lower_central_series().len() + structure.upper_central_series().len();
            (series, structure.centre().dimension(), structure.nilradical().dimension())
        });
    }
    let sl40 = timed("sl(40), constants from matrices", || named("sl(40)"));
    timed("sl(40), Jacobi identity", || {
        let bracket = Bracket::new(sl40.labels(), sl40.structure_constants().clone()).unwrap();
        assert!(bracket.jacobi_violation().is_none());
    });
    let free = timed("free_nilpotent(3,8), dimension 1318", || named("free_nilpotent(3,8)"));
    timed("free_nilpotent(3,8), Jacobi identity", || {
        let bracket = Bracket::new(free.labels(), free.structure_constants().clone()).unwrap();
        assert!(bracket.jacobi_violation().is_none());
    });
    for (name, task) in [("so(20)", "so(20) from matrices"), ("sl(20)", "sl(20) from matrices")] {
        timed(task, || named(name));
    }
}
