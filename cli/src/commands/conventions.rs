//! `affinor conventions`: the conventions of signs and indices.

use super::failure::Failure;
use super::options::Output;
use super::output::deliver;
use affinor::conventions::ALL;
use affinor_documents::report::{Format, Grid};
use clap::Args;
use serde_json::{Map, Value, json};
use std::io::Write;
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let write = |out: &mut dyn Write| match self.output.format {
            Format::Json => {
                let lines: Map<String, Value> =
                    ALL.iter().map(|(object, lines)| (object.to_string(), json!(lines))).collect();
                let all = json!({ "schema": "affinor.conventions/1", "conventions": lines });
                serde_json::to_writer_pretty(&mut *out, &all)?;
                writeln!(out)
            }
            format => {
                let rows = ALL
                    .iter()
                    .map(|(object, lines)| vec![(*object).into(), lines.join("\n").into()]);
                let header = ["object", "convention"].map(String::from).to_vec();
                Grid { title: "Conventions".into(), header, rows: rows.collect() }
                    .write(format, out)
            }
        };
        deliver(self.output.file.as_deref(), &[], write)?;
        Ok(ExitCode::SUCCESS)
    }
}
