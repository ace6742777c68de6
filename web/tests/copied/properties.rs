use affinor_documents::definition::Definition;
use affinor_documents::report::{Format, Report, Properties};

const TEXT: &str = r#"
name  = "so(3)"
basis = ["e1", "e2", "e3"]
# [i, j, k, v]: [e_i, e_j] = v e_k + ..
structure_constants = [
  [2, 3, 1, "1"],
  [1, 3, 2, "-1"],
  [1, 2, 3, "1"],
]
metric = [
  ["1", "0", "0"],
  ["0", "2", "0"],
  ["0", "0", "3"],
]
connection = "zero"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let definition = Definition::parse("space.toml", TEXT)?;
    let report = Properties::of(&definition)?;
    report.write(Format::Text, &mut std::io::stdout())?;
    Ok(())
}
