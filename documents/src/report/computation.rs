//! Reports of a space, with the scalar type that the space needs.
//!
//! The formulas are generic over the scalar type, but a report is not. In this module each formula
//! is compiled once for every scalar type; the command line, the web page and Python use the
//! results.

use super::{
    ComparedSide, Convention, Differences, EquationReport, Language, Program, Programmed, Quantity,
    Report, Statements, StoredTable, Table, Verdicts, tensors_as_code,
};
use crate::certificate::{Check, certify};
use crate::input::InputError;
use crate::space::{Point, ScalarChoice, Space};
use crate::{Coefficient, over_kind};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{Error, Geometry};
use affinor_tensors::{Effort, Kind, Recorded, Symbolic, Tolerance};

/// A space, and the settings of a computation with it.
///
/// ```
/// use affinor_documents::space::{Request, Space};
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
    /// The choice of scalars.
    pub scalar: ScalarChoice,
    /// The tolerance below which a float counts as zero.
    pub tolerance: Tolerance,
    /// Called with the name of each stage before it begins.
    pub stage: &'a dyn Fn(&str),
}

/// The tensors of a table, and options for their components.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The tensors.
    pub quantities: Vec<Quantity>,
    /// Whether the components refer to the right-invariant frame.
    pub right_frame: bool,
    /// Whether only one of the components that are equal by symmetry is shown.
    pub independent: bool,
    /// Whether JSON writes common factors by name; see [`Table::common_factors`].
    pub common_factors: bool,
    /// Whether indices are written as names of coordinates or basis vectors; see
    /// [`Table::index_names`].
    pub named_indices: bool,
}

/// A table, and the selected tensors that it does not contain.
pub struct TableReport {
    /// The table.
    pub report: Box<dyn Report>,
    /// The selected tensors that are not defined for this space and frame.
    pub absent: Vec<Quantity>,
}

/// Stored tables, compared with a space.
pub struct Compared {
    /// For each table, its differences from the space, and remarks on the comparison; an error for
    /// a table that does not fit the space.
    pub tables: Vec<Result<(Differences, Vec<String>), InputError>>,
    /// Remarks on all comparisons, about conventions that no table uses.
    pub remarks: Vec<String>,
}

impl TableReport {
    fn new<S: Coefficient>(table: Table<S>, selection: &Selection) -> Self {
        let shown = |q: &Quantity| table.tensors.iter().any(|entry| entry.quantity == *q);
        let absent = selection.quantities.iter().filter(|q| !shown(q)).copied().collect();
        TableReport { report: Box::new(table), absent }
    }
}

/// The number of terms that the simplification of a program may form. Above this number, the
/// program computes by the formulas without simplification.
const SIMPLIFIED: u64 = 3_000_000;

/// Like `SIMPLIFIED`, for values at points. The limit is lower, because an unsimplified program
/// computes a few points sooner than a simplification takes.
pub const SIMPLIFIED_AT_POINTS: u64 = 100_000;

impl<'a> Computation<'a> {
    /// An exact computation with this space.
    #[must_use]
    pub fn of(space: &'a Space) -> Self {
        Computation {
            space,
            scalar: ScalarChoice::Exact,
            tolerance: Tolerance::default(),
            stage: &|_| (),
        }
    }

    /// Computes the table of tensors.
    ///
    /// # Errors
    /// An error for an invalid space, and for floats beyond their range.
    pub fn table(&self, selection: &Selection) -> Result<TableReport, InputError> {
        over_kind!(self.kind()?, S => {
            let table = self.tensors::<S>(&self.geometry(selection)?, selection)?;
            Ok(TableReport::new(table, selection))
        })
    }

    /// Computes the table of tensors in floats at a point.
    ///
    /// # Errors
    /// Those of [`table`](Self::table); an error for a tensor that depends on a name without a
    /// value, or that is not defined at the point.
    pub fn table_at(
        &self,
        selection: &Selection,
        point: &Point,
    ) -> Result<TableReport, InputError> {
        let table = self.simplified(
            SIMPLIFIED_AT_POINTS,
            || self.tensors::<Symbolic>(&self.geometry(selection)?, selection)?.at(point),
            || self.tensors::<Recorded>(&self.geometry(selection)?, selection)?.at(point),
        )?;
        Ok(TableReport::new(table, selection))
    }

    /// The values of programs. On a chart, the expressions are simplified first, so that terms that
    /// cancel are not computed. If the simplification forms more than `terms` terms, or if the
    /// space is not a chart, the programs compute by the formulas.
    fn simplified<T>(
        &self,
        terms: u64,
        symbolic: impl FnOnce() -> T,
        recorded: impl FnOnce() -> T,
    ) -> T {
        if self.space.definition.is_on_chart()
            && let Ok(values) = Effort::new(terms).bound(symbolic)
        {
            return values;
        }
        recorded()
    }

    /// Writes the components of tensors as source code, with their partial derivatives with respect
    /// to these parameters or coordinates.
    ///
    /// # Errors
    /// Those of [`table`](Self::table).
    pub fn table_as_code(
        &self,
        selection: &Selection,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        self.simplified(
            SIMPLIFIED,
            || self.code::<Symbolic>(selection, language, by),
            || self.code::<Recorded>(selection, language, by),
        )
    }

    fn code<S: Programmed>(
        &self,
        selection: &Selection,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        let geometry = self.geometry::<S>(selection)?;
        (self.stage)("program");
        tensors_as_code(&geometry, &selection.quantities, language, by)
    }

    /// Writes the structure constants as input of another program.
    ///
    /// # Errors
    /// An error for an invalid space.
    pub fn structure(&self, program: Program) -> Result<String, InputError> {
        let definition = &self.space.definition;
        over_kind!(self.kind()?, S => {
            let algebra = definition.algebra::<S>(self.tolerance)?;
            Ok(program.structure(&definition.name, algebra.labels(), algebra.structure_constants()))
        })
    }

    /// Computes the checks of a certificate, with [`certify`].
    ///
    /// # Errors
    /// Those of [`certify`].
    pub fn checks(&self) -> Result<Vec<Check>, InputError> {
        over_kind!(self.kind()?, S => certify::<S>(&self.space.definition, self.tolerance, self.stage))
    }

    /// Computes equations of motion; if `solved` is set, they are solved for the time derivatives.
    ///
    /// # Errors
    /// An error for an invalid space, for a missing metric that the equations need, and for floats
    /// beyond their range.
    pub fn equations(
        &self,
        kind: EquationKind,
        solved: bool,
    ) -> Result<Box<dyn Report>, InputError> {
        over_kind!(self.kind()?, S => Ok(Box::new(self.motion::<S>(kind, solved)?)))
    }

    /// Writes equations of motion as source code, with partial derivatives with respect to these
    /// parameters or coordinates.
    ///
    /// # Errors
    /// Those of [`equations`](Self::equations).
    pub fn equations_as_code(
        &self,
        kind: EquationKind,
        language: Language,
        by: &[String],
    ) -> Result<String, InputError> {
        self.motion::<Recorded>(kind, false)?.code(language, by)
    }

    /// Computes one side of a comparison.
    ///
    /// # Errors
    /// An error for an invalid space.
    pub fn side(&self) -> Result<ComparedSide, InputError> {
        over_kind!(self.kind()?, S => {
            Ok(ComparedSide::new(&self.space.definition.geometry::<S>(self.tolerance)?)?)
        })
    }

    /// Computes the differences between stored tables and the space, and remarks on the
    /// comparisons. The components of the stored tables follow the given conventions.
    ///
    /// # Errors
    /// Those of [`table`](Self::table); an error for a convention that cannot be parsed.
    pub fn differences(
        &self,
        stored: &[StoredTable],
        selection: &Selection,
        conventions: &[Convention],
    ) -> Result<Compared, InputError> {
        over_kind!(self.kind()?, S => {
            let geometry = self.geometry::<S>(selection)?;
            let mut table = self.tensors(&geometry, selection)?;
            let scalars = self.space.definition.known_parameters();
            let (mut stated, mut remarks) = (vec![], vec![]);
            for convention in conventions {
                let (quantity, used) = convention.apply(&mut table, &geometry, &scalars, &self.space.values)?;
                if stated.contains(&quantity) {
                    return Err(convention.refused(format!("two conventions are given for the {}", quantity.title().to_lowercase())));
                }
                stated.push(quantity);
                if !used {
                    remarks.push(convention.unused(quantity));
                }
            }
            (self.stage)("comparison");
            let outcome = |stored: &StoredTable| {
                let mut remarks = stored.remarks(&table);
                let stored = stored.or_vanishing(&table)?;
                let found = stored.differences(&table)?;
                if !found.is_empty() && stored.lists_independent(&table) {
                    remarks.push("only independent components are stored: see --independent".into());
                }
                Ok((found, remarks))
            };
            let tables = stored.iter().map(outcome).collect();
            Ok(Compared { tables, remarks })
        })
    }

    /// Tests statements about the space. Returns their outcomes, and the errors of those that
    /// cannot be tested.
    ///
    /// # Errors
    /// An error for an invalid space.
    pub fn test(&self, statements: &Statements) -> Result<Verdicts, InputError> {
        let (space, scalars) = (self.space, self.space.definition.known_parameters());
        let kind = match self.kind()? {
            // chooses symbolic scalars if a statement may contain a parameter, pi, or a root of a
            // number
            Kind::Exact
                if !scalars.is_empty()
                    || !space.values.is_empty()
                    || statements.may_be_irrational() =>
            {
                Kind::Symbolic
            }
            kind => kind,
        };
        over_kind!(kind, S => {
            let geometry = self.geometry::<S>(&Selection::default())?;
            (self.stage)("claims");
            Ok(statements.test(&geometry, &scalars, &space.values))
        })
    }

    pub(super) fn kind(&self) -> Result<Kind, InputError> {
        self.space.kind(self.scalar)
    }

    /// The geometry of the space, in the selected frame.
    pub(super) fn geometry<S: Coefficient>(
        &self,
        selection: &Selection,
    ) -> Result<Geometry<S>, InputError> {
        let definition = &self.space.definition;
        (self.stage)("jacobi");
        let ground = definition.ground(self.tolerance)?;
        (self.stage)("connection");
        let geometry = definition.geometry_over(ground, self.tolerance)?;
        Ok(if selection.right_frame { geometry.in_right_frame()? } else { geometry })
    }

    /// Computes the selected tensors of a geometry as a table.
    fn tensors<S: Coefficient>(
        &self,
        geometry: &Geometry<S>,
        selection: &Selection,
    ) -> Result<Table<S>, InputError> {
        let mut table = Table::in_stages(geometry, &selection.quantities, self.stage)?;
        table.independent = selection.independent;
        table.common_factors = selection.common_factors;
        table.index_names = selection.named_indices.then(|| table.frame_names().to_vec());
        table.finite()?;
        Ok(table)
    }

    /// Computes the equations over one scalar type.
    fn motion<S: Coefficient>(
        &self,
        kind: EquationKind,
        solved: bool,
    ) -> Result<EquationReport<S>, InputError> {
        (self.stage)("geometry");
        let geometry = self.space.definition.geometry(self.tolerance)?;
        (self.stage)("equations");
        let equations = Equations::new(kind, geometry.connection(), geometry.metric());
        let equations = equations.map_err(|error| match error {
            Error::NoMetric => InputError::usage("Euler-Poincare equations need a metric")
                .help("give one, as in --metric \"diag(J1,J2,J3)\", or choose another --kind"),
            other => other.into(),
        })?;
        let equations = if solved { equations.solved() } else { equations };
        let report = EquationReport::new(equations, &geometry);
        report.finite()?;
        Ok(report)
    }
}
