//! `affinor geodesic`: the geodesics between two points, and curves of distributions.

use super::failure::Failure;
use super::note::note_default_connection;
use super::options::{Output, Settings, SpaceOptions};
use affinor_documents::problem::{
    Connecting, HorizontalCurve, HorizontalRequest, geodesics, horizontal,
};
use affinor_documents::report::{Geodesics, HorizontalReport};
use affinor_documents::space::Space;
use clap::Args;

#[derive(Args)]
pub struct Arguments {
    /// The space: a chart, a group or a homogeneous space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    /// The start. On a chart: coordinates, as in "theta=pi/2, phi=0" or a list. On a group:
    /// coordinates x of exp(x). On a homogeneous space: the components of x in the complement. An
    /// element may also be a matrix, row by row. With --covector: by default the identity
    #[arg(
        long,
        value_name = "POINT",
        allow_hyphen_values = true,
        required_unless_present = "covector"
    )]
    pub from: Option<String>,
    /// The end, in the same form
    #[arg(
        long,
        value_name = "POINT",
        allow_hyphen_values = true,
        required_unless_present = "covector",
        conflicts_with = "covector"
    )]
    pub to: Option<String>,
    /// Search from N initial velocities, and print all geodesics that are found. By default, the
    /// search ends at the first one; with --distribution, it prints the shortest of 32 starts
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..),
        conflicts_with = "covector"
    )]
    pub starts: Option<u16>,
    /// On a group: compute curves whose velocity is in the span of these vectors, as in
    /// "e1, e2 + e3". They are orthonormal unless a metric is given
    #[arg(long, value_name = "VECTORS", allow_hyphen_values = true)]
    pub distribution: Option<String>,
    /// With --distribution: follow the normal extremal of this covector
    #[arg(
        long,
        value_name = "COMPONENTS",
        allow_hyphen_values = true,
        requires = "distribution",
        requires = "time"
    )]
    pub covector: Option<String>,
    /// With --covector: the times of the points, as in "1, 2, pi"
    #[arg(long, value_name = "TIMES", allow_hyphen_values = true, requires = "covector")]
    pub time: Option<String>,
    /// With --covector: follow the abnormal extremal, for distributions of rank 2
    #[arg(long, requires = "covector")]
    pub abnormal: bool,
    /// Values of parameters, as in "J1=1/2,h=-1"; may be repeated
    #[arg(long, value_name = "NAME=VALUE,...")]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let settings = Settings { set: self.set.clone(), tolerance: None, threads: None };
        let space = settings.open(self.space.as_deref(), &self.options)?;
        if let Some(distribution) = &self.distribution {
            return self.horizontal(&space, distribution);
        }
        note_default_connection(&space.definition);
        let [from, to] = [&self.from, &self.to].map(|point| point.as_deref().unwrap_or_default());
        let found = geodesics(&space, from, to, self.starts())?;
        let Connecting { space: name, connection, names, points, measure, geodesics } = &found;
        let report = Geodesics::new(name, connection, names, points, measure, geodesics);
        self.output.print(space.file.as_slice(), &report)
    }

    fn starts(&self) -> Option<usize> {
        self.starts.map(usize::from)
    }

    fn horizontal(&self, space: &Space, distribution: &str) -> Result<(), Failure> {
        let curve = match &self.covector {
            Some(covector) => HorizontalCurve::Extremal {
                covector,
                times: self.time.as_deref().unwrap_or_default(),
                is_abnormal: self.abnormal,
            },
            None => HorizontalCurve::Between {
                to: self.to.as_deref().unwrap_or_default(),
                starts: self.starts(),
            },
        };
        let request = HorizontalRequest { distribution, from: self.from.as_deref(), curve };
        let found = horizontal(space, &request)?;
        self.output.print(space.file.as_slice(), &HorizontalReport::new(&found))
    }
}
