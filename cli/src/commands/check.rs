//! `affinor check`: a certificate, or a witness for each failed identity.

use super::failure::Failure;
use super::options::{Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use affinor_documents::certificate::{Check, certify};
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{Format, Grid};
use affinor_tensors::Notation;
use clap::Args;
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let stages = self.shared.start()?;
        let space = self.shared.open(self.space.as_deref(), &self.options)?;
        let certificate = Certificate { stages: &stages };
        let checks = self.shared.run(&space, certificate)?;
        stages.begin_output();
        let output = &self.shared.output;
        let inputs: Vec<&Path> = space.file.as_deref().into_iter().collect();
        let name = &space.definition.name;
        deliver(output.file.as_deref(), &inputs, |out| write(name, &checks, output.format, out))?;
        let ok = checks.iter().all(|check| check.ok);
        Ok(if ok { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}

struct Certificate<'a> {
    stages: &'a Stages,
}

impl Work for Certificate<'_> {
    type Output = Vec<Check>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Vec<Check>, InputError> {
        certify(definition, reading, &|name| self.stages.begin(name))
    }
}

fn write(name: &str, checks: &[Check], format: Format, out: &mut dyn Write) -> io::Result<()> {
    if format == Format::Json {
        let ok = checks.iter().all(|check| check.ok);
        let checks: Vec<Value> = checks.iter().map(object).collect();
        let schema = "affinor.check/1";
        let all = json!({ "schema": schema, "name": name, "ok": ok, "checks": checks });
        serde_json::to_writer_pretty(&mut *out, &all)?;
        return writeln!(out);
    }
    let rows = checks.iter().map(|check| {
        let verdict = if check.ok { "ok" } else { "FAILS" };
        vec![check.name.into(), verdict.into(), check.detail.as_str().into()]
    });
    let header = ["check", "verdict", "detail"].map(String::from).to_vec();
    let name: String = name.chars().flat_map(char::escape_debug).collect();
    Grid { title: format!("Certificate of {name}"), header, rows: rows.collect() }
        .write(format, out)
}

fn object(check: &Check) -> Value {
    let mut object = json!({ "name": check.name, "ok": check.ok, "detail": check.detail });
    if let Some(witness) = &check.witness {
        object["witness"] = json!({ "indices": witness.indices, "residual": witness.residual });
    }
    object
}
