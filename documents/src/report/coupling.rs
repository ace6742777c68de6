//! Coupling coefficients of spins: Clebsch-Gordan coefficients, 3j and 6j symbols.

use super::grid::{Cell, Grid};
use super::representation::failure;
use super::{Format, Report};
use crate::input::InputError;
use affinor::representation::{
    Coupling, RepresentationError, SignedRoot, Spin, real_coupling, wigner_6j,
};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest number of coefficients of a report.
pub const MAX_COEFFICIENTS: u64 = 1 << 20;

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
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::ClebschGordan, Self::ThreeJ, Self::SixJ, Self::Real];

    /// The kind with a [name](Self::name).
    ///
    /// ```
    /// use affinor_documents::report::CouplingKind;
    /// assert_eq!(CouplingKind::from_name("6j"), Some(CouplingKind::SixJ));
    /// assert_eq!(CouplingKind::from_name("9j"), None);
    /// ```
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The name in commands and in JSON: `clebsch-gordan`, `3j`, `6j` or `real`.
    pub fn name(self) -> &'static str {
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
    kind: CouplingKind,
    spins: Vec<Spin>,
    coefficients: Vec<CouplingCoefficient>,
}

/// A coefficient: the third spin and the three magnetic quantum numbers, in the order of the columns
/// of the report, and the value. A 6j symbol has no numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CouplingCoefficient {
    /// `[j, m1, m2, m]`, or no numbers.
    pub numbers: Vec<Spin>,
    /// The value.
    pub value: SignedRoot,
}

impl CouplingReport {
    /// Computes the coefficients for spins that are given as text: two spins, and optionally a third
    /// one, or six spins for a 6j symbol.
    ///
    /// # Errors
    /// An error of usage for a text that is not a spin, for a wrong number of spins, and for more
    /// than [`MAX_COEFFICIENTS`] coefficients.
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
        let spins = parsed.map_err(failure)?;
        if let Some(negative) = spins.iter().find(|spin| spin.twice() < 0) {
            return Err(InputError::usage(format!("the spin {negative} is negative")));
        }
        let coefficients = match (kind, &spins[..]) {
            (CouplingKind::SixJ, &[a, b, c, d, e, f]) => {
                vec![CouplingCoefficient {
                    numbers: vec![],
                    value: wigner_6j([a, b, c], [d, e, f]),
                }]
            }
            (CouplingKind::SixJ, _) => {
                let message = format!("a 6j symbol has 6 spins, but {} are given", spins.len());
                return Err(InputError::usage(message));
            }
            (_, &[a, b]) => coefficients(kind, a, b, &a.coupled(b).collect::<Vec<_>>())?,
            (_, &[a, b, c]) => coefficients(kind, a, b, &[c])?,
            _ => {
                let message = format!("write two or three spins, but {} are given", spins.len());
                return Err(InputError::usage(message));
            }
        };
        Ok(CouplingReport { kind, spins, coefficients })
    }

    /// The given spins.
    pub fn spins(&self) -> &[Spin] {
        &self.spins
    }

    /// The coefficients that are not zero.
    pub fn coefficients(&self) -> &[CouplingCoefficient] {
        &self.coefficients
    }

    /// The names of the columns before the value.
    fn columns(&self) -> &'static [&'static str] {
        match self.kind {
            CouplingKind::SixJ => &[],
            CouplingKind::ClebschGordan => &["j", "m1", "m2", "m"],
            _ => &["j3", "m1", "m2", "m3"],
        }
    }

    fn texts(&self) -> Vec<String> {
        self.spins.iter().map(Spin::to_string).collect()
    }

    fn grid(&self) -> Grid {
        let header = [self.columns(), &["value", "decimal"]].concat();
        let cells = self.coefficients.iter().map(|CouplingCoefficient { numbers, value }| {
            let numbers = numbers.iter().map(|number| Cell::from(number.to_string()));
            let decimal = format!("{:.12}", value.to_f64());
            numbers.chain([value.to_string().into(), decimal.into()]).collect()
        });
        let (spins, name) = (self.texts().join(", "), self.kind.name());
        let title = format!("Coupling of the spins {spins}: {name}");
        Grid::new(title, &header, cells.collect(), Value::Null)
            .with_head(vec![("convention", self.kind.convention().into())])
    }

    fn json(&self) -> Value {
        let objects = self.coefficients.iter().map(|CouplingCoefficient { numbers, value }| {
            let mut object = json!({
                "value": value.to_string(),
                "signed_square": value.signed_square().to_string(),
                "decimal": value.to_f64(),
            });
            for (name, number) in self.columns().iter().zip(numbers) {
                object[*name] = json!(number.to_string());
            }
            object
        });
        json!({
            "schema": "affinor.coupling/1",
            "kind": self.kind.name(),
            "convention": self.kind.convention(),
            "spins": self.texts(),
            "coefficients": objects.collect::<Vec<Value>>(),
        })
    }
}

impl Report for CouplingReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Json => super::grid::pretty(&self.json(), out),
            _ => self.grid().write(format, out),
        }
    }
}

/// The nonzero coefficients for each third spin.
fn coefficients(
    kind: CouplingKind,
    first: Spin,
    second: Spin,
    thirds: &[Spin],
) -> Result<Vec<CouplingCoefficient>, InputError> {
    let count = thirds.iter().map(|third| candidates(kind, [first, second, *third])).sum::<u64>();
    if count > MAX_COEFFICIENTS {
        let error = RepresentationError::TooLarge {
            what: format!("the number of coefficients, {count},"),
            limit: MAX_COEFFICIENTS.to_string(),
        };
        return Err(failure(error).help("give a third spin, or smaller spins"));
    }
    let mut found = vec![];
    for &third in thirds {
        let Some(coupling) = Coupling::new(first, second, third) else {
            let message = format!("the spins {first} and {second} do not couple to {third}");
            return Err(InputError::usage(message));
        };
        if kind == CouplingKind::Real {
            let tensor = real_coupling(first, second, third).map_err(failure)?;
            let numbers = first.projections().flat_map(|m1| {
                let pairs = second.projections().map(move |m2| (m1, m2));
                pairs.flat_map(|(m1, m2)| third.projections().map(move |m| vec![third, m1, m2, m]))
            });
            let all = numbers.zip(tensor).filter(|(_, value)| !value.is_zero());
            found.extend(all.map(|(numbers, value)| CouplingCoefficient { numbers, value }));
            continue;
        }
        for (m1, m2) in coupling.pairs() {
            let (sign, value) = match kind {
                CouplingKind::ThreeJ => (-1, coupling.three_j(m1, m2)),
                _ => (1, coupling.coefficient(m1, m2)),
            };
            if !value.is_zero() {
                let m = Spin::from_twice(sign * (m1.twice() + m2.twice()));
                let numbers = [third, m1, m2].into_iter().chain(m).collect();
                found.push(CouplingCoefficient { numbers, value });
            }
        }
    }
    Ok(found)
}

/// The number of coefficients that the selection rules allow; for a real tensor the number of its
/// entries.
fn candidates(kind: CouplingKind, spins: [Spin; 3]) -> u64 {
    let [a, b, c] = spins.map(Spin::twice);
    let pairs = |m: i64| {
        // the pairs with `m1 + m2 = m`, given twice
        let (low, high) = ((-a).max(m - b), a.min(m + b));
        if low > high { 0 } else { (high - low) as u64 / 2 + 1 }
    };
    match kind {
        CouplingKind::Real => [a, b, c].into_iter().map(|j| j as u64 + 1).product(),
        _ => spins[2].projections().map(|m| pairs(m.twice())).sum(),
    }
}
