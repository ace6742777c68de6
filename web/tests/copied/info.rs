use affinor_documents::definition::Definition;
use affinor_documents::report::{Format, Report, Info};

const TEXT: &str = r#"
name  = "sl(2)"
basis = ["E12", "E21", "H1"]
# [i, j, k, v]: [e_i, e_j] = v e_k + ..
structure_constants = [
  [1, 3, 1, "-2"],
  [2, 3, 2, "2"],
  [1, 2, 3, "1"],
]
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let definition = Definition::parse("space.toml", TEXT)?;
    let report = Info::of(&definition, &|_| ())?;
    report.write(Format::Text, &mut std::io::stdout())?;
    Ok(())
}
