//! One task of structure theory in this process: the peer of a call inside another program.
//!
//! `cargo bench -p affinor-benches --bench structure_calls -- TASK SPACE`, where SPACE is a name of
//! the catalogue or a file `{"dimension": n, "structure_constants": [[i, j, k, "v"], ..]}`. It
//! prints the minimum of the seconds that the task took, from the algebra in memory to the answer,
//! and the answer. The task is repeated for a second, at most 50 times.

use affinor::algebra::catalogue;
use affinor::algebra::structure::StructureTheory;
use affinor::{Bracket, Error, LieAlgebra, Rational};
use serde_json::Value;
use std::time::Instant;

type Algebra = LieAlgebra<Rational>;

fn rational(text: &str) -> Rational {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    Rational::new(above.parse().unwrap(), below.parse().unwrap()).unwrap()
}

fn read(space: &str) -> Algebra {
    if !space.ends_with(".json") {
        return catalogue::algebra(space).unwrap();
    }
    let table: Value = serde_json::from_str(&std::fs::read_to_string(space).unwrap()).unwrap();
    let index = |value: &Value| value.as_u64().unwrap() as usize - 1;
    let rows = table["structure_constants"].as_array().unwrap().iter().map(|row| {
        (index(&row[0]), index(&row[1]), index(&row[2]), rational(row[3].as_str().unwrap()))
    });
    let n = table["dimension"].as_u64().unwrap();
    let labels = (1..=n).map(|at| format!("e{at}"));
    LieAlgebra::try_from(Bracket::from_constants(labels, rows).unwrap()).unwrap()
}

/// The bracket of a name of the catalogue; the identity of Jacobi is another task.
fn constants(name: &str) -> Bracket<Rational> {
    let entry = catalogue::find(name).unwrap();
    entry.bracket::<_, Error>(|value| Ok(value.as_constant().unwrap().clone())).unwrap()
}

/// The least seconds of a task after its preparation, and the answer.
fn least<T>(prepare: impl Fn() -> T, run: impl Fn(T) -> String) -> (f64, String) {
    let (mut least, mut answer, begin) = (f64::INFINITY, String::new(), Instant::now());
    for _ in 0..50 {
        let prepared = prepare();
        let start = Instant::now();
        answer = run(prepared);
        least = least.min(start.elapsed().as_secs_f64());
        if begin.elapsed().as_secs_f64() > 1.0 {
            break;
        }
    }
    (least, answer)
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let [task, space] = &words[..] else {
        println!("structure_calls TASK SPACE");
        return;
    };
    let of_algebra = |run: fn(Algebra) -> String| {
        let algebra = read(space);
        least(|| algebra.clone(), run)
    };
    let (seconds, answer) = match task.as_str() {
        "constants" => least(|| (), |()| constants(space).structure_constants().len().to_string()),
        "Jacobi" => of_algebra(|algebra| {
            let bracket =
                Bracket::new(algebra.labels(), algebra.structure_constants().clone()).unwrap();
            bracket.jacobi_violation().is_none().to_string()
        }),
        "Killing" => {
            of_algebra(|algebra| StructureTheory::new(algebra).killing().determinant().to_string())
        }
        "centre" => of_algebra(|algebra| {
            let structure = StructureTheory::new(algebra);
            let series: Vec<usize> =
                structure.derived_series().iter().map(|term| term.dimension()).collect();
            format!(
                "[{}, {series:?}, {}]",
                structure.centre().dimension(),
                structure.radical().dimension()
            )
        }),
        "Levi" => of_algebra(|algebra| {
            StructureTheory::new(algebra).levi().unwrap().dimension().to_string()
        }),
        "type" => of_algebra(|algebra| {
            let types = StructureTheory::new(algebra).dynkin_type().unwrap();
            types.iter().map(ToString::to_string).collect::<Vec<_>>().join(" + ")
        }),
        _ => panic!("no task {task}"),
    };
    println!("{seconds:.9} {answer}");
}
