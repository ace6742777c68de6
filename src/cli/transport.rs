//! `affinor transport`: parallel translation along arcs of a group.

use super::failure::Failure;
use super::note::note_default_connection;
use super::on_group::Angles;
use super::options::{Shared, SpaceOptions};
use super::rows::{Expected, map_rows, read, vector, write_rows};
use clap::Args;
use nalgebra::DVector;
use std::process::ExitCode;

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: String,
    /// Vectors at the start, in left components, each one argument; `-` for lines of standard
    /// input; without any, the matrix that carries them
    #[arg(value_name = "VECTOR", allow_negative_numbers = true)]
    pub vectors: Vec<String>,
    /// An arc exp(s x), 0 <= s <= 1, given by x; repeat it for a curve of arcs, one after the other
    #[arg(long, value_name = "X", allow_negative_numbers = true, required = true)]
    pub along: Vec<String>,
    /// Angles of the arcs in degrees
    #[arg(long)]
    pub degrees: bool,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub shared: Shared,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        self.shared.start()?;
        let space = self.shared.open(Some(&self.space), &self.options)?;
        note_default_connection(&space.definition);
        let (group, connection) =
            space.in_floats(self.shared.tolerance()?, |definition, reading| {
                let geometry = definition.geometry(reading)?;
                Ok((definition.group(reading)?, geometry.connection().clone()))
            })?;
        let n = group.dimension();
        let what = format!("a vector of this algebra of dimension {n}");
        let expected = Expected { numbers: n, what };
        let angles = Angles::new(self.degrees, group.as_ref());
        let arcs = self.along.iter().map(|x| Ok(angles.read(&read("--along", x, &expected)?)));
        let arcs = arcs.collect::<Result<Vec<_>, Failure>>()?;
        let carried = group.transport(&connection, &arcs)?;
        let output = &self.shared.output;
        if self.vectors.is_empty() {
            write_rows(output, |write| write(carried))?;
            return Ok(ExitCode::SUCCESS);
        }
        let given: &[String] = if self.vectors == ["-"] { &[] } else { &self.vectors };
        map_rows(given, &expected, output, |u| {
            Ok(vector((&carried * DVector::from_column_slice(u)).as_slice()))
        })?;
        Ok(ExitCode::SUCCESS)
    }
}
