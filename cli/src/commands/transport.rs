//! `affinor transport`: parallel transport along arcs of a group.

use super::columns::Expected;
use super::failure::Failure;
use super::note::note_default_connection;
use super::on_group::Angles;
use super::options::{GeometryOptions, Settings, SpaceOptions};
use super::rows::{RowOutput, map_rows, read, vector, write_rows};
use affinor::group::LieGroup;
use affinor::group::transport::ParallelTranslation;
use clap::Args;
use nalgebra::DVector;

#[derive(Args)]
pub struct Arguments {
    /// The space that defines the group; see `affinor --help`
    pub space: String,
    /// Vectors at the start of the path, in the left-invariant frame, one argument per vector, or -
    /// for the lines of standard input. Without vectors, print the matrix of the transport
    #[arg(value_name = "VECTOR", allow_negative_numbers = true)]
    pub vectors: Vec<String>,
    /// The coordinates x of an arc exp(s x), 0 <= s <= 1, of the path; repeat the option for
    /// consecutive arcs
    #[arg(long, value_name = "X", allow_negative_numbers = true, required = true)]
    pub along: Vec<String>,
    /// Read angles in degrees, among the coordinates of the arcs
    #[arg(long)]
    pub degrees: bool,
    #[command(flatten)]
    pub geometry: GeometryOptions,
    #[command(flatten)]
    pub settings: Settings,
    #[command(flatten)]
    pub output: RowOutput,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.settings.start_threads()?;
        let options = SpaceOptions { geometry: self.geometry.clone(), ..SpaceOptions::default() };
        let space = self.settings.open(Some(&self.space), &options)?;
        note_default_connection(&space.definition);
        let (definition, tolerance) = (space.in_floats()?, self.settings.tolerance()?);
        let connection = definition.geometry(tolerance)?.connection().clone();
        let group = definition.group(tolerance)?;
        let n = group.dimension();
        let what = format!("a vector of this algebra of dimension {n}");
        let expected = Expected::vector(n, what).or(&definition.labels).or(&["x", "y", "z"]);
        let angles = Angles::new(self.degrees, &group);
        let arcs = self.along.iter().map(|x| Ok(angles.read(&read("--along", x, &expected)?)));
        let arcs = arcs.collect::<Result<Vec<_>, Failure>>()?;
        let translation = ParallelTranslation::new(group, connection)?;
        let carried = translation.along_arcs(&arcs)?;
        if self.vectors.is_empty() {
            return write_rows(&self.output, "P", |write| write(carried));
        }
        let given: &[String] = if self.vectors == ["-"] { &[] } else { &self.vectors };
        map_rows(given, &expected, "u", &self.output, |u| {
            Ok(vector(translation.carry(&carried, &DVector::from_column_slice(u))?.as_slice()))
        })
    }
}
