//! Reports of the page other than readings and cards: pages, copies, structure and motions.

use super::source::{self, Copy};
use super::tables::computation;
use super::{Answer, Refusal, Request, motion, transport};
use affinor::algebra::roots::CartanType;
use affinor::geometry::equations::EquationKind;
use affinor_documents::input::InputError;
use affinor_documents::over_kind;
use affinor_documents::picture::{self, Picture};
use affinor_documents::problem::Problem;
use affinor_documents::report::{
    ComparedSide, Comparison, Format, Info, Properties, Quantity, Report, Selection, Table,
    TableEntry, catalogue, certificate, conventions, dynkin_type,
};
use affinor_documents::space::{self, ScalarChoice, Space};
use affinor_tensors::Tolerance;

/// The names of reports.
const REPORTS: &str =
    "compare, table, check, info, properties, equations, transport, motion, list, conventions";
/// The largest dimension of tensors that are shown as heat maps.
const HEAT: usize = 32;

impl Request {
    /// The report, in its format.
    ///
    /// # Errors
    /// Any error of the request.
    pub(super) fn report(&self) -> Result<Answer, Refusal> {
        if let Some(copy) = Copy::from_name(&self.format) {
            return self.copied(copy);
        }
        let format = self.format()?;
        let (report, notes): (Box<dyn Report>, Vec<String>) = match self.report.as_str() {
            "compare" => (Box::new(self.comparison()?), vec![]),
            "list" => match catalogue(&self.space) {
                Some(list) => (Box::new(list), vec![]),
                None => return Err(Refusal::new("no name of the catalogue contains this text")),
            },
            "conventions" => (Box::new(conventions()), vec![]),
            "transport" => (transport::transport(&self.path, &self.vector, &self.metric)?, vec![]),
            "motion" | "simulate" => (motion::motion(&self.problem, &self.methods)?, vec![]),
            "table" => {
                let (space, quantities) = (self.open()?, self.quantities()?);
                let selection = Selection { quantities, ..Selection::default() };
                (computation(&space).table(&selection)?.report, notes(&space))
            }
            "check" => {
                let space = self.open()?;
                let checks = computation(&space).checks()?;
                (Box::new(certificate(&space.definition.name, &checks, None)), notes(&space))
            }
            "equations" => self.equations()?,
            "info" => {
                let space = self.open()?;
                (Box::new(Info::of(&space.definition, &crate::stage)?), notes(&space))
            }
            "properties" => {
                let space = self.open()?;
                (Box::new(Properties::of(&space.definition)?), notes(&space))
            }
            other => {
                let fault = match other {
                    "" => "no report is named".to_string(),
                    other => format!("unknown report {other}"),
                };
                return Err(Refusal::new(format!("{fault}: name one of {REPORTS}")));
            }
        };
        let answer = Answer::new(&*report, format, notes)?;
        Ok(match format {
            Format::Html => {
                let types = self.types();
                answer.with(self.pictures(&types), &types)
            }
            _ => answer,
        })
    }

    fn format(&self) -> Result<Format, Refusal> {
        match self.format.as_str() {
            "" => Ok(Format::Html),
            name => Format::from_name(name)
                .ok_or_else(|| Refusal::new(format!("`{name}` is not a format"))),
        }
    }

    /// The types of the simple factors, for the structure of an algebra.
    fn types(&self) -> Vec<CartanType> {
        let found = || Ok::<_, Refusal>(dynkin_type(&self.open()?.definition)?);
        // errors are ignored, because the report is complete without the types
        if self.report == "info" { found().unwrap_or_default() } else { vec![] }
    }

    /// Heat maps of a table; the diagrams of an algebra with roots.
    fn pictures(&self, types: &[CartanType]) -> Vec<Picture> {
        let drawn = || -> Result<Vec<Picture>, Refusal> {
            match self.report.as_str() {
                "table" => Ok(heat_maps(&self.open()?, &self.quantities()?)?),
                "info" => {
                    // the diagrams of A1 are a point and a line
                    if types.iter().all(|one| one.rank() == 1) {
                        return Ok(vec![]);
                    }
                    let name = self.open()?.definition.name;
                    let made = [picture::dynkin, picture::roots];
                    Ok(made.map(|make| make(&name, types)).into())
                }
                _ => Ok(vec![]),
            }
        };
        // errors of pictures are ignored, because the report is complete without them
        drawn().unwrap_or_default()
    }

    /// The file of the report, or the lines that load it.
    fn copied(&self, copy: Copy) -> Result<Answer, Refusal> {
        let (toml, notes) = match self.report.as_str() {
            "motion" => {
                Problem::parse("problem.toml", &self.problem)?;
                (self.problem.clone(), vec![])
            }
            report @ ("table" | "check" | "info" | "properties" | "equations") => {
                // reads the tensors and the equations to check them: the copy quotes both texts
                self.quantities()?;
                self.kind()?;
                let space = self.open()?;
                (source::definition(&space, report != "info")?, notes(&space))
            }
            other => return Err(Refusal::new(format!("`{other}` cannot be copied as a file"))),
        };
        let text = copy.write(&self.report, toml, self.show.trim(), self.kind()?.name());
        Answer::written(notes, |out| out.write_all(text.as_bytes()))
    }

    fn quantities(&self) -> Result<Vec<Quantity>, Refusal> {
        match self.show.trim() {
            "" => Ok(Quantity::shown()),
            list => Quantity::list(list).map_err(Refusal::new),
        }
    }

    fn equations(&self) -> Result<(Box<dyn Report>, Vec<String>), Refusal> {
        let kind = self.kind()?;
        let space = self.open()?;
        Ok((computation(&space).equations(kind, false)?, notes(&space)))
    }

    /// The kind of equations.
    fn kind(&self) -> Result<EquationKind, Refusal> {
        match self.motion.as_str() {
            "" => Ok(EquationKind::EulerPoincare),
            name => EquationKind::from_name(name)
                .ok_or_else(|| Refusal::new(format!("`{name}` is not a motion"))),
        }
    }

    fn comparison(&self) -> Result<Comparison, Refusal> {
        let side = |name: &str, default: &str| -> Result<ComparedSide, Refusal> {
            let name = if name.trim().is_empty() { default } else { name };
            let request = space::Request { space: Some(name.into()), ..space::Request::default() };
            Ok(computation(&Space::open(&request)?).side()?)
        };
        Ok(Comparison::new(side(&self.space, "M(3)")?, side(&self.other, "SO(3)")?))
    }
}

/// The parameters that the input introduced.
fn notes(space: &Space) -> Vec<String> {
    match space.introduced.as_slice() {
        [] => vec![],
        names => vec![format!("taken as parameters: {}", names.join(", "))],
    }
}

/// Heat maps of tensors.
fn heat_maps(space: &Space, quantities: &[Quantity]) -> Result<Vec<Picture>, InputError> {
    let definition = &space.definition;
    if definition.dimension() > HEAT {
        return Ok(vec![]);
    }
    over_kind!(space.kind(ScalarChoice::Exact)?, S => {
        let geometry = definition.geometry::<S>(Tolerance::default())?;
        let table = Table::new(&geometry, quantities)?;
        let drawn = |entry: &TableEntry<S>| {
            picture::heat(entry.quantity.title(), entry.quantity.symbol(), &entry.tensor)
        };
        Ok(table.tensors.iter().filter_map(drawn).collect())
    })
}
