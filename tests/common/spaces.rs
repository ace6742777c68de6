//! Spaces as users name them: definition files and catalogue names.

use affinor::Geometry;
use affinor_documents::Coefficient;
use affinor_documents::space::{Request, Space};
use affinor_tensors::{Rational, Symbolic, Tolerance};

fn open<S: Coefficient>(space: String, metric: Option<&str>, set: Option<&str>) -> Geometry<S> {
    let [metric, set] = [metric, set].map(|text| text.map(str::to_string));
    let request = Request { space: Some(space), metric, set, ..Request::default() };
    let space = Space::open(&request).unwrap();
    space.definition.geometry(Tolerance::default()).unwrap()
}

/// The path of a definition in `examples/definitions`.
fn path(file: &str) -> String {
    let folder = super::root().join("examples/definitions");
    folder.join(file).to_str().unwrap().to_string()
}

/// A file of `examples/definitions` without values for its parameters.
pub fn symbolic(file: &str) -> Geometry<Symbolic> {
    open(path(file), None, None)
}

/// A file of `examples/definitions` with values for its parameters.
pub fn rational(file: &str, set: &str) -> Geometry<Rational> {
    let set = Some(set).filter(|set| !set.is_empty());
    open(path(file), None, set)
}

/// A catalogue name with a metric and its Levi-Civita connection.
pub fn named(name: &str, metric: &str) -> Geometry<Rational> {
    open(name.to_string(), Some(metric), None)
}
