use affinor::geometry::equations::{EquationKind, Equations};
use affinor_documents::definition::{Definition, Reading};
use affinor_documents::report::{Format, Report, EquationReport};
use affinor_tensors::{Symbolic, Tolerance};

const TEXT: &str = r#"
name  = "so(3)"
basis = ["e1", "e2", "e3"]
parameters = ["a", "b", "c"]
# [i, j, k, v]: [e_i, e_j] = v e_k + ..
structure_constants = [
  [2, 3, 1, "1"],
  [1, 3, 2, "-1"],
  [1, 2, 3, "1"],
]
metric = [
  ["a", "0", "0"],
  ["0", "b", "0"],
  ["0", "0", "c"],
]
connection = "plus"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let definition = Definition::parse("space.toml", TEXT)?;
    let exact = |value: &Symbolic| Some(value.clone());
    let reading = Reading { convert: &exact, tolerance: Tolerance::default() };
    let geometry = definition.geometry(&reading)?;
    let kind = EquationKind::from_name("euler-poincare").ok_or("no such equations")?;
    let equations = Equations::new(kind, geometry.connection(), geometry.metric())?;
    let report = EquationReport::new(equations, &geometry);
    report.write(Format::Text, &mut std::io::stdout())?;
    Ok(())
}
