//! One tensor of Levi-Civita in this process: the peer of a call inside another program.
//!
//! `cargo bench -p affinor-benches --bench table_calls -- SPACE METRIC TENSOR`, where SPACE is a name of the catalogue or
//! a definition file with its own metric; then METRIC is empty. It prints the mean of the seconds that a call takes, from
//! the algebra in memory to the exact components, on one thread. The call is repeated for a second, each time in a new
//! thread, which remembers no sum of the call before.

use affinor_documents::report::{Computation, Quantity, Selection};
use affinor_documents::space::{Request, Space};
use std::cell::Cell;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let [space, metric, tensor] = &words[..] else {
        println!("table_calls SPACE METRIC TENSOR");
        return;
    };
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().unwrap();
    let metric = Some(metric.clone()).filter(|metric| !metric.is_empty());
    let request = Request { space: Some(space.clone()), metric, ..Request::default() };
    let space = Space::open(&request).unwrap();
    let selection = Selection {
        quantities: vec![Quantity::ALL.into_iter().find(|q| q.key() == *tensor).unwrap()],
        ..Selection::default()
    };
    let call = || {
        let start = Cell::new(None);
        let stage = |name: &str| {
            if name == "connection" {
                start.set(Some(Instant::now()));
            }
        };
        let table = Computation { stage: &stage, ..Computation::of(&space) }.table(&selection);
        let seconds = start.get().unwrap().elapsed().as_secs_f64();
        drop(table.unwrap());
        seconds
    };
    let (mut total, mut calls, begin) = (0.0, 0, Instant::now());
    while calls == 0 || begin.elapsed().as_secs_f64() < 1.0 {
        total += std::thread::scope(|scope| scope.spawn(call).join().unwrap());
        calls += 1;
    }
    println!("{}", total / f64::from(calls));
}
