use affinor_documents::definition::{Definition, Reading};
use affinor_documents::report::{Format, Report, Quantity, Table};
use affinor_tensors::{Symbolic, Tolerance};

const TEXT: &str = r#"
name  = "so(3)"
basis = ["e1", "e2", "e3"]
parameters = ["a"]
# [i, j, k, v]: [e_i, e_j] = v e_k + ..
structure_constants = [
  [2, 3, 1, "1"],
  [1, 3, 2, "-1"],
  [1, 2, 3, "1"],
]
metric = [
  ["a", "0", "0"],
  ["0", "2", "0"],
  ["0", "0", "3"],
]
connection = "levi-civita"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let definition = Definition::parse("space.toml", TEXT)?;
    let exact = |value: &Symbolic| Some(value.clone());
    let reading = Reading { convert: &exact, tolerance: Tolerance::default() };
    let report = Table::new(&definition.geometry(&reading)?, &Quantity::list("ricci, scalar_curvature")?)?;
    report.write(Format::Text, &mut std::io::stdout())?;
    Ok(())
}
