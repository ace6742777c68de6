//! Coupling coefficients of spins: Clebsch-Gordan coefficients, 3j and 6j symbols.

use super::grid::{Cell, Grid};
use super::{Format, Report};
use crate::input::InputError;
use affinor::representation::{
    RepresentationError, SignedRoot, Spin, clebsch_gordan, real_coupling, wigner_3j, wigner_6j,
};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The kind of coupling coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CouplingKind {
    /// `<j1 m1 j2 m2 | j m>` for two spins and all or one total spin.
    ClebschGordan,
    /// 3j symbols for two spins and all or one third spin.
    ThreeJ,
    /// The 6j symbol of six spins.
    SixJ,
    /// The invariant tensor of three integer spins in a real basis.
    Real,
}

impl CouplingKind {
    fn name(self) -> &'static str {
        match self {
            CouplingKind::ClebschGordan => "clebsch-gordan",
            CouplingKind::ThreeJ => "3j",
            CouplingKind::SixJ => "6j",
            CouplingKind::Real => "real",
        }
    }

    fn convention(self) -> &'static str {
        match self {
            CouplingKind::ClebschGordan => {
                "<j1 m1 j2 m2 | j m> of Condon and Shortley: <j1 j1 j2 j-j1 | j j> > 0"
            }
            CouplingKind::ThreeJ => {
                "(j1 j2 j3; m1 m2 m3) = (-1)^(j1-j2-m3) <j1 m1 j2 m2 | j3 -m3>/sqrt(2 j3 + 1)"
            }
            CouplingKind::SixJ => "{j1 j2 j3; j4 j5 j6} of Wigner and Racah",
            CouplingKind::Real => {
                "invariant tensor of norm 1, as in e3nn. For m > 0: \
                 r_m = (-i)^l (e_-m + (-1)^m e_m)/sqrt(2). Also: r_0 = (-i)^l e_0. Also: \
                 r_-m = (-i)^(l+1) (e_-m - (-1)^m e_m)/sqrt(2)."
            }
        }
    }
}

/// The coefficients of a coupling of spins that are not zero. JSON has the schema
/// `affinor.coupling/1`.
#[derive(Clone, Debug)]
pub struct CouplingReport {
    grid: Grid,
}

impl CouplingReport {
    /// Computes the coefficients for spins that are given as text: two spins, and optionally a third
    /// one, or six spins for a 6j symbol.
    ///
    /// # Errors
    /// An error of usage for a text that is not a spin, and for a wrong number of spins.
    ///
    /// ```
    /// use affinor_documents::report::{CouplingKind, CouplingReport, Format, Report};
    /// let spins = ["1/2".to_string(), "1/2".to_string(), "0".to_string()];
    /// let report = CouplingReport::new(&spins, CouplingKind::ClebschGordan)?;
    /// let mut csv = vec![];
    /// report.write(Format::Csv, &mut csv)?;
    /// assert!(String::from_utf8(csv)?.contains("\n0,1/2,-1/2,0,sqrt(1/2),"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(spins: &[String], kind: CouplingKind) -> Result<Self, InputError> {
        let parsed = spins.iter().map(|text| text.parse::<Spin>()).collect::<Result<Vec<_>, _>>();
        let j = parsed.map_err(failure)?;
        if let Some(negative) = j.iter().find(|spin| spin.twice() < 0) {
            return Err(InputError::usage(format!("the spin {negative} is negative")));
        }
        let rows = match (kind, &j[..]) {
            (CouplingKind::SixJ, &[a, b, c, d, e, f]) => {
                vec![(vec![], wigner_6j([a, b, c], [d, e, f]))]
            }
            (CouplingKind::SixJ, _) => {
                let message = format!("a 6j symbol has 6 spins, but {} are given", j.len());
                return Err(InputError::usage(message));
            }
            (_, &[a, b]) => rows(kind, a, b, a.coupled(b))?,
            (_, &[a, b, c]) => rows(kind, a, b, [c].into_iter())?,
            _ => {
                let message = format!("write two or three spins, but {} are given", j.len());
                return Err(InputError::usage(message));
            }
        };
        let names: &[&str] = match kind {
            CouplingKind::SixJ => &[],
            CouplingKind::ClebschGordan => &["j", "m1", "m2", "m"],
            _ => &["j3", "m1", "m2", "m3"],
        };
        let header = [names, &["value", "decimal"]].concat();
        let cells = rows.iter().map(|(numbers, value)| {
            let numbers = numbers.iter().map(|number| Cell::from(number.to_string()));
            let decimal = format!("{:.12}", value.to_f64());
            numbers.chain([value.to_string().into(), decimal.into()]).collect()
        });
        let objects = rows.iter().map(|(numbers, value)| {
            let mut object = json!({
                "value": value.to_string(),
                "signed_square": value.signed_square().to_string(),
                "decimal": value.to_f64(),
            });
            for (name, number) in names.iter().zip(numbers) {
                object[*name] = json!(number.to_string());
            }
            object
        });
        let objects: Vec<Value> = objects.collect();
        let all = j.iter().map(Spin::to_string).collect::<Vec<_>>();
        let json = json!({
            "schema": "affinor.coupling/1",
            "kind": kind.name(),
            "convention": kind.convention(),
            "spins": all,
            "coefficients": objects,
        });
        let title = format!("Coupling of the spins {}: {}", all.join(", "), kind.name());
        let grid = Grid::new(title, &header, cells.collect(), json)
            .with_head(vec![("convention", kind.convention().into())]);
        Ok(CouplingReport { grid })
    }
}

impl Report for CouplingReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.grid.write(format, out)
    }
}

type Coefficient = (Vec<Spin>, SignedRoot);

/// The nonzero coefficients for each third spin.
fn rows(
    kind: CouplingKind,
    first: Spin,
    second: Spin,
    thirds: impl Iterator<Item = Spin>,
) -> Result<Vec<Coefficient>, InputError> {
    let mut found = vec![];
    for third in thirds {
        if !first.coupled(second).any(|coupled| coupled == third) {
            let message = format!("the spins {first} and {second} do not couple to {third}");
            return Err(InputError::usage(message));
        }
        let mut tensor = match kind {
            CouplingKind::Real => real_coupling(first, second, third).map_err(failure)?,
            _ => vec![],
        }
        .into_iter();
        for m1 in first.projections() {
            for m2 in second.projections() {
                for m in third.projections() {
                    let spins = ([first, m1], [second, m2], [third, m]);
                    let value = match kind {
                        CouplingKind::Real => tensor.next(),
                        CouplingKind::ThreeJ => Some(wigner_3j(spins.0, spins.1, spins.2)),
                        _ => Some(clebsch_gordan(spins.0, spins.1, spins.2)),
                    };
                    let value = value.filter(|value| !value.is_zero());
                    found.extend(value.map(|value| (vec![third, m1, m2, m], value)));
                }
            }
        }
    }
    Ok(found)
}

fn failure(error: RepresentationError) -> InputError {
    InputError::usage(error.to_string())
}
