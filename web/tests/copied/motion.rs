use affinor_documents::problem::Problem;

const TEXT: &str = r#"
space = "so3"
metric = "diag(0.6, 0.8, 1)"
initial.momentum = [1.8, 0.4, -0.9]
output = { end = 1, every = 0.5 }
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = Problem::parse("problem.toml", TEXT)?;
    let ready = problem.motion(0)?;
    let columns = ready.columns.clone();
    let (mut integration, mut last) = (problem.integrate(ready), vec![]);
    loop {
        let step = integration.step()?;
        last = step.rows.last().cloned().unwrap_or(last);
        if step.done {
            break;
        }
    }
    for (column, value) in columns.iter().zip(last) {
        println!("{} {value}", column.name);
    }
    Ok(())
}
