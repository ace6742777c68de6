//! `affinor table`: the tensors of one space.

use super::code::{self, CodeOptions};
use super::failure::Failure;
use super::note::{note, note_default_connection};
use super::options::{OutputFormat, Shared, SpaceOptions};
use super::output::deliver;
use super::stages::Stages;
use affinor::Geometry;
use affinor_documents::definition::{Definition, InputError, Reading, Work};
use affinor_documents::report::{Program, Quantity, Report, Table, tensors_as_code};
use affinor_tensors::Notation;
use clap::{Args, ValueEnum};

#[derive(Args)]
pub struct Arguments {
    /// The space; see `affinor --help`
    pub space: Option<String>,
    #[command(flatten)]
    pub options: SpaceOptions,
    #[command(flatten)]
    pub selection: Selection,
    #[command(flatten)]
    pub code: CodeOptions,
    #[command(flatten)]
    pub shared: Shared,
}

/// The tensors shown, and their components.
#[derive(Args)]
pub struct Selection {
    /// Tensors to show, separated by commas: structure, affinities, torsion, curvature, ricci,
    /// scalar_curvature, metric, inverse_metric, nonmetricity, killing, or all for these;
    /// nabla_torsion, nabla_curvature, ricci_symmetric, ricci_antisymmetric, einstein, schouten,
    /// weyl, cotton, kretschmann, or derived for these
    #[arg(long, value_name = "TENSORS", value_parser = quantities)]
    pub show: Option<Quantities>,
    /// Show one component of each set that is equal by symmetry
    #[arg(long)]
    pub independent: bool,
    /// The invariant frame of the components
    #[arg(long, value_enum, default_value_t = Frame::Left)]
    pub frame: Frame,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Frame {
    Left,
    Right,
}

/// A list of different tensors.
#[derive(Clone)]
pub struct Quantities(pub Vec<Quantity>);

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let stages = self.shared.start()?;
        let space = self.shared.open(self.space.as_deref(), &self.options)?;
        let quantities = self.selection.quantities();
        if let OutputFormat::Program(program) = self.shared.output.format
            && quantities == [Quantity::Structure]
        {
            let code = self.shared.run(&stages, &space, Export(program))?;
            let file = self.shared.output.file.as_deref();
            return deliver(file, space.file.as_slice(), |out| out.write_all(code.as_bytes()));
        }
        note_default_connection(&space.definition);
        if let Some(language) = self.code.language(&self.shared)? {
            if self.selection.independent {
                let message = "--code assigns all components, and computes equal ones once";
                return Err(InputError::usage(message).help("leave --independent away").into());
            }
            let by = self.code.derivatives(&space.definition)?;
            let code = space.record(|definition, reading| {
                let geometry = self.selection.geometry(definition, reading, &stages)?;
                stages.begin("program");
                tensors_as_code(&geometry, &quantities, language, &by)
            })?;
            return code::print(&code, &space, &self.shared, &stages);
        }
        let build = Build { selection: &self.selection, quantities, stages: &stages };
        let table = self.shared.run(&stages, &space, build)?;
        self.shared.print(&stages, space.file.as_slice(), &*table)
    }
}

impl Selection {
    /// The tensors chosen; by default all basic ones but the inverse metric and the Killing form.
    pub fn quantities(&self) -> Vec<Quantity> {
        match &self.show {
            Some(Quantities(chosen)) => chosen.clone(),
            None => Quantity::shown(),
        }
    }

    /// The geometry of a definition, in the frame chosen.
    fn geometry<S: Notation>(
        &self,
        definition: &Definition,
        reading: &Reading<S>,
        stages: &Stages,
    ) -> Result<Geometry<S>, InputError> {
        stages.begin("jacobi");
        let ground = definition.ground(reading)?;
        stages.begin("connection");
        let geometry = definition.geometry_over(ground, reading)?;
        Ok(if self.frame == Frame::Right { geometry.in_right_frame()? } else { geometry })
    }

    /// The table of a definition.
    pub fn table<S: Notation>(
        &self,
        definition: &Definition,
        reading: &Reading<S>,
        quantities: &[Quantity],
        stages: &Stages,
    ) -> Result<Table<S>, InputError> {
        let geometry = self.geometry(definition, reading, stages)?;
        let mut table = Table::in_stages(&geometry, quantities, &|name| stages.begin(name))?;
        table.independent = self.independent;
        table.finite()?;
        Ok(table)
    }
}

/// The structure constants as input of a program.
struct Export(Program);

impl Work for Export {
    type Output = String;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<String, InputError> {
        let algebra = definition.algebra(reading)?;
        Ok(self.0.structure(&definition.name, algebra.labels(), algebra.structure()))
    }
}

struct Build<'a> {
    selection: &'a Selection,
    quantities: Vec<Quantity>,
    stages: &'a Stages,
}

impl Work for Build<'_> {
    type Output = Box<dyn Report>;

    fn run<S: Notation>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        let selection = self.selection;
        let table = selection.table(definition, reading, &self.quantities, self.stages)?;
        let absent = |quantity: &&Quantity| table.tensors.iter().all(|e| e.quantity != **quantity);
        let absent: Vec<&str> = self.quantities.iter().filter(absent).map(|q| q.key()).collect();
        if !absent.is_empty() && selection.frame == Frame::Right && definition.has_metric() {
            let why = "the metric has no constant components in the right-invariant frame";
            note(&format!("not shown: {}; {why}", absent.join(", ")));
        } else if !absent.is_empty() && selection.show.is_some() {
            note(&format!("not defined for this space: {}", absent.join(", ")));
        }
        Ok(Box::new(table))
    }
}

fn quantities(text: &str) -> Result<Quantities, String> {
    Quantity::list(text).map(Quantities)
}
