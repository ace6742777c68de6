//! Reports of a space over the scalar that it needs.
//!
//! The formulas are generic over the scalar, and a report is not: here each is compiled once for every scalar, and the
//! command line, the page and Python share it.

use super::{
    ComparedSide, Differences, EquationReport, Language, Program, Programmed, Quantity, Report,
    StoredTable, Table, tensors_as_code,
};
use crate::Coefficient;
use crate::certificate::{Check, certify};
use crate::definition::{Definition, InputError, Reading, ScalarChoice, Space, Work};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{Error, Geometry};
use affinor_tensors::{Effort, Symbolic, Tolerance};

/// A space to be computed with, and how.
///
/// ```
/// use affinor_documents::definition::{Request, Space};
/// use affinor_documents::report::{Computation, Format, Quantity, Selection};
/// let space = Space::open(&Request { space: Some("so(3)@zero".into()), ..Request::default() })?;
/// let ricci = Selection { quantities: vec![Quantity::Ricci], ..Selection::default() };
/// let mut csv = Vec::new();
/// Computation::of(&space).table(&ricci)?.report.write(Format::Csv, &mut csv)?;
/// assert!(csv.starts_with(b"tensor,i,j,k,l,value\nricci,1,1,,,1/2\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct Computation<'a> {
    /// The space.
    pub space: &'a Space,
    /// Its scalars.
    pub scalar: ScalarChoice,
    /// The tolerance below which a float counts as zero.
    pub tolerance: Tolerance,
    /// Called with the name of each stage before it begins.
    pub stage: &'a dyn Fn(&str),
}

/// What a table shows.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The tensors.
    pub quantities: Vec<Quantity>,
    /// Whether the components are those in the right-invariant frame.
    pub right_frame: bool,
    /// Whether one component of each set that is equal by symmetry is shown.
    pub independent: bool,
    /// Whether JSON too has names for common factors; see [`Table::common_factors`].
    pub common_factors: bool,
}

/// A table, and what it lacks.
pub struct Tabulated {
    /// The table.
    pub report: Box<dyn Report>,
    /// The tensors selected that are not defined for this space and frame.
    pub absent: Vec<Quantity>,
}

/// The terms that the simplification of the components of a program may form. Beyond, the program computes as the formulas
/// do.
const SIMPLIFIED: u64 = 3_000_000;

impl<'a> Computation<'a> {
    /// An exact computation.
    #[must_use]
    pub fn of(space: &'a Space) -> Self {
        Computation {
            space,
            scalar: ScalarChoice::Exact,
            tolerance: Tolerance::default(),
            stage: &|_| (),
        }
    }

    fn run<W: Work>(&self, work: W) -> Result<W::Output, InputError> {
        self.space.run(self.scalar, self.tolerance, work)
    }

    /// The table of tensors.
    ///
    /// # Errors
    /// A space that is refused; floats beyond their range.
    pub fn table(&self, selection: &Selection) -> Result<Tabulated, InputError> {
        self.run(Tabulate { selection, stage: self.stage })
    }

    /// The components of tensors as source code, with their partial derivatives by these parameters or coordinates.
    ///
    /// # Errors
    /// As [`table`](Self::table).
    pub fn table_as_code(
        &self,
        selection: &Selection,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        // on a chart the components are simplified first, so that terms that cancel are not computed
        if self.space.definition.is_on_chart() {
            let convert = |value: &Symbolic| Some(value.clone());
            let reading = Reading { convert: &convert, tolerance: self.tolerance };
            let simplified = Effort::new(SIMPLIFIED)
                .bound(|| self.code(&self.space.definition, &reading, selection, language, by));
            if let Ok(code) = simplified {
                return code;
            }
        }
        self.space
            .record(|definition, reading| self.code(definition, reading, selection, language, by))
    }

    fn code<S: Programmed>(
        &self,
        definition: &Definition,
        reading: &Reading<S>,
        selection: &Selection,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        let geometry = geometry(definition, reading, selection, self.stage)?;
        (self.stage)("program");
        tensors_as_code(&geometry, &selection.quantities, language, by)
    }

    /// The structure constants as input of another program.
    ///
    /// # Errors
    /// A space that is refused.
    pub fn structure(&self, program: Program) -> Result<String, InputError> {
        self.run(Export(program))
    }

    /// The checks of a certificate, as [`certify`] makes them.
    ///
    /// # Errors
    /// As [`certify`].
    pub fn checks(&self) -> Result<Vec<Check>, InputError> {
        self.run(Certify { stage: self.stage })
    }

    /// Equations of motion; `solved` for the time derivatives.
    ///
    /// # Errors
    /// A space that is refused, or without the metric that the equations need; floats beyond their range.
    pub fn equations(
        &self,
        kind: EquationKind,
        solved: bool,
    ) -> Result<Box<dyn Report>, InputError> {
        self.run(Move { kind, solved, stage: self.stage })
    }

    /// Equations of motion as source code, with partial derivatives by these parameters or coordinates.
    ///
    /// # Errors
    /// As [`equations`](Self::equations).
    pub fn equations_as_code(
        &self,
        kind: EquationKind,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        self.space.record(|definition, reading| {
            equations(definition, reading, kind, false, self.stage)?.code(language, by)
        })
    }

    /// One side of a comparison.
    ///
    /// # Errors
    /// A space that is refused.
    pub fn side(&self) -> Result<ComparedSide, InputError> {
        self.run(Compare)
    }

    /// The differences between a stored table and the space, and remarks on what is compared.
    ///
    /// # Errors
    /// As [`table`](Self::table); a stored table that does not fit the space.
    pub fn differences(
        &self,
        stored: &StoredTable,
        selection: &Selection,
    ) -> Result<(Differences, Vec<String>), InputError> {
        self.run(Verify { stored, selection, stage: self.stage })
    }
}

/// The geometry of a definition, in the frame selected.
fn geometry<S: Coefficient>(
    definition: &Definition,
    reading: &Reading<S>,
    selection: &Selection,
    stage: &dyn Fn(&str),
) -> Result<Geometry<S>, InputError> {
    stage("jacobi");
    let ground = definition.ground(reading)?;
    stage("connection");
    let geometry = definition.geometry_over(ground, reading)?;
    Ok(if selection.right_frame { geometry.in_right_frame()? } else { geometry })
}

/// The table of a definition.
fn table<S: Coefficient>(
    definition: &Definition,
    reading: &Reading<S>,
    selection: &Selection,
    stage: &dyn Fn(&str),
) -> Result<Table<S>, InputError> {
    let geometry = geometry(definition, reading, selection, stage)?;
    let mut table = Table::in_stages(&geometry, &selection.quantities, stage)?;
    table.independent = selection.independent;
    table.common_factors = selection.common_factors;
    table.finite()?;
    Ok(table)
}

/// The equations of a definition.
fn equations<S: Coefficient>(
    definition: &Definition,
    reading: &Reading<S>,
    kind: EquationKind,
    solved: bool,
    stage: &dyn Fn(&str),
) -> Result<EquationReport<S>, InputError> {
    stage("geometry");
    let geometry = definition.geometry(reading)?;
    stage("equations");
    let equations = Equations::new(kind, geometry.connection(), geometry.metric());
    let equations = equations.map_err(|error| match error {
        Error::NoMetric => InputError::usage("Euler-Poincare equations need a metric")
            .help("give one, as in --metric \"diag(J1,J2,J3)\", or choose another --motion"),
        other => other.into(),
    })?;
    let equations = if solved { equations.solved() } else { equations };
    let report = EquationReport::new(equations, &geometry);
    report.finite()?;
    Ok(report)
}

struct Tabulate<'a> {
    selection: &'a Selection,
    stage: &'a dyn Fn(&str),
}

impl Work for Tabulate<'_> {
    type Output = Tabulated;

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Tabulated, InputError> {
        let table = table(definition, reading, self.selection, self.stage)?;
        let absent = |quantity: &&Quantity| table.tensors.iter().all(|e| e.quantity != **quantity);
        let absent = self.selection.quantities.iter().filter(absent).copied().collect();
        Ok(Tabulated { report: Box::new(table), absent })
    }
}

struct Export(Program);

impl Work for Export {
    type Output = String;

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<String, InputError> {
        let algebra = definition.algebra(reading)?;
        Ok(self.0.structure(&definition.name, algebra.labels(), algebra.structure()))
    }
}

struct Certify<'a> {
    stage: &'a dyn Fn(&str),
}

impl Work for Certify<'_> {
    type Output = Vec<Check>;

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Vec<Check>, InputError> {
        certify(definition, reading, self.stage)
    }
}

struct Move<'a> {
    kind: EquationKind,
    solved: bool,
    stage: &'a dyn Fn(&str),
}

impl Work for Move<'_> {
    type Output = Box<dyn Report>;

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        Ok(Box::new(equations(definition, reading, self.kind, self.solved, self.stage)?))
    }
}

struct Compare;

impl Work for Compare {
    type Output = ComparedSide;

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<ComparedSide, InputError> {
        Ok(ComparedSide::new(&definition.geometry(reading)?)?)
    }
}

struct Verify<'a> {
    stored: &'a StoredTable,
    selection: &'a Selection,
    stage: &'a dyn Fn(&str),
}

impl Work for Verify<'_> {
    type Output = (Differences, Vec<String>);

    fn run<S: Coefficient>(
        self,
        definition: &Definition,
        reading: &Reading<S>,
    ) -> Result<Self::Output, InputError> {
        let table = table(definition, reading, self.selection, self.stage)?;
        let remarks = self.stored.remarks(&table);
        (self.stage)("comparison");
        Ok((self.stored.or_vanishing(&table)?.differences(&table)?, remarks))
    }
}
