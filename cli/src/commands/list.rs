//! `affinor list`: the catalogue of spaces.

use super::failure::Failure;
use super::options::Output;
use super::output::deliver;
use affinor::algebra::catalogue::families;
use affinor_documents::definition::InputError;
use affinor_documents::report::{Format, Grid};
use clap::Args;
use serde_json::json;
use std::io::Write;
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    /// Only entries that contain this text, in upper or lower case
    pub pattern: Option<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let pattern = self.pattern.clone().unwrap_or_default().to_lowercase();
        let mut rows = vec![
            ["M(3)", "the paper's rotations: plus, metric J", "M3"],
            ["SO(3)", "the paper's other reading: zero, metric 2 delta", "SO3"],
        ];
        rows.extend(
            families().iter().map(|family| [family.pattern, family.summary, family.example]),
        );
        rows.retain(|row| row.iter().any(|cell| cell.to_lowercase().contains(&pattern)));
        if rows.is_empty() {
            let message =
                format!("no entry of the catalogue contains `{}`", pattern.escape_debug());
            return Err(InputError::usage(message).help("`affinor list` shows all entries").into());
        }
        let write = |out: &mut dyn Write| match self.output.format {
            Format::Json => {
                let entry = |[name, summary, example]: &[&str; 3]| json!({ "name": name, "summary": summary, "example": example });
                let entries: Vec<_> = rows.iter().map(entry).collect();
                let all = json!({ "schema": "affinor.list/1", "spaces": entries });
                serde_json::to_writer_pretty(&mut *out, &all)?;
                writeln!(out)
            }
            format => {
                let rows = rows.iter().map(|row| row.map(Into::into).to_vec()).collect();
                let header = ["name", "space and basis", "example"];
                let header = header.map(String::from).to_vec();
                Grid { title: "Catalogue; + forms direct sums".into(), header, rows }
                    .write(format, out)
            }
        };
        deliver(self.output.file.as_deref(), &[], write)?;
        Ok(ExitCode::SUCCESS)
    }
}
