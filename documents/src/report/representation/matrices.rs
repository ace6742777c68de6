//! The matrices of an irreducible representation.

use super::super::grid::{Cell, Grid};
use super::super::{Format, Report};
use super::{LENGTHS, ROOTS, algebra_in_json, described, failure, title, with_name};
use crate::formula::tex;
use crate::input::InputError;
use crate::rows::failed;
use affinor::algebra::roots::{RootSystem, basis_names};
use affinor::representation::diagram::labelled;
use affinor::representation::{HighestWeight, Indicator, MatrixRepresentation, ReductiveAlgebra};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest dimension at which matrices are written with all their entries. Larger matrices are
/// lists of nonzero entries.
const DENSE: usize = 9;
/// The largest number of nonzero entries for formats other than CSV and JSON.
const MAX_ENTRIES: usize = 20_000;

/// The matrices of a representation: those of the generators `e_i`, `f_i`, `h_i`, or of a whole
/// Chevalley basis. JSON has the schema `affinor.matrices/1`.
#[derive(Clone, Debug)]
pub struct MatrixReport {
    weight: HighestWeight,
    /// The names of the matrices, and the matrices.
    matrices: Vec<(String, Matrix<Rational>)>,
    form: Option<Matrix<Rational>>,
    hermitian: Matrix<Rational>,
    /// The monomials and weights of the basis vectors.
    basis: Vec<(String, Vec<i64>)>,
}

const BASIS: &str = "monomials f_i^(a) f_j^(b) ... v, where f^(a) = f^a/a! and v is a highest weight \
     vector";
const COLUMNS: &str = "column j is the image of basis vector j";
const RELATIONS: &str = "[e_i,f_j] = delta_ij h_i and [h_i,e_j] = a_ji e_j, multiplied out";

impl MatrixReport {
    /// Computes the matrices of the representation of a reductive algebra whose highest weight is
    /// given as text. If `all` is set, the matrices of all root vectors are included.
    ///
    /// # Errors
    /// An error of usage for a text that is not a representation; a mathematical error for
    /// dimensions beyond the limit.
    ///
    /// ```
    /// use affinor_documents::report::{Format, MatrixReport, Report};
    /// let report = MatrixReport::new(&"SU(2)".parse()?, "2", false)?;
    /// let mut csv = vec![];
    /// report.write(Format::Csv, &mut csv)?;
    /// assert!(csv.starts_with(b"matrix,row,column,value\ne1,1,2,1\nf1,2,1,1\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(algebra: &ReductiveAlgebra, weight: &str, all: bool) -> Result<Self, InputError> {
        let weight = HighestWeight::parse(algebra, weight).map_err(failure)?;
        let module = MatrixRepresentation::new(&weight).map_err(failure)?;
        let named = |letter: &'static str, count| (1..=count).map(move |i| format!("{letter}{i}"));
        let (rank, centre) = (algebra.semisimple_rank(), algebra.abelian_dimension());
        let matrices = if all {
            names(algebra).into_iter().zip(module.chevalley_basis()).collect()
        } else {
            let diagonal = (0..algebra.rank()).map(|i| module.diagonal(i));
            let names = named("e", rank).chain(named("f", rank)).chain(named("h", rank));
            let matrices = module.raising().iter().chain(module.lowering()).cloned();
            names.chain(named("t", centre)).zip(matrices.chain(diagonal)).collect()
        };
        let basis = module.basis().iter();
        Ok(MatrixReport {
            matrices,
            form: module.invariant_form(),
            hermitian: module.contravariant_form(),
            basis: basis.map(|v| (v.to_string(), v.weight().to_vec())).collect(),
            weight,
        })
    }

    /// The symmetry of the invariant bilinear form.
    fn symmetry(&self) -> Option<&'static str> {
        match self.weight.indicator() {
            Indicator::Real => Some("symmetric"),
            Indicator::Quaternionic => Some("antisymmetric"),
            Indicator::Complex => None,
        }
    }

    /// All matrices, then the forms.
    fn written(&self) -> impl Iterator<Item = (&str, &Matrix<Rational>)> {
        let matrices = self.matrices.iter().map(|(name, matrix)| (&name[..], matrix));
        let forms = self.form.iter().map(|form| ("bilinear form", form));
        matrices.chain(forms).chain([("Hermitian form", &self.hermitian)])
    }

    fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(["matrix", "row", "column", "value"]).map_err(failed)?;
        for (name, matrix) in self.written() {
            for (i, j, value) in matrix.entries() {
                let [row, column] = [i, j].map(|at| (at + 1).to_string());
                writer.write_record([name, &row, &column, &value.to_string()]).map_err(failed)?;
            }
        }
        writer.flush()
    }

    fn json(&self) -> Value {
        let matrices = self
            .matrices
            .iter()
            .map(|(name, matrix)| json!({ "name": name, "entries": entries(matrix) }));
        let basis = self
            .basis
            .iter()
            .map(|(monomial, weight)| json!({ "monomial": monomial, "weight": weight }));
        let form = self
            .form
            .as_ref()
            .zip(self.symmetry())
            .map(|(form, symmetry)| json!({ "symmetry": symmetry, "entries": entries(form) }));
        json!({
            "schema": "affinor.matrices/1",
            "algebra": algebra_in_json(self.weight.algebra()),
            "conventions": {
                "roots": ROOTS, "casimir": LENGTHS, "basis": BASIS, "matrices": COLUMNS,
            },
            "representation": described(&self.weight),
            "basis": basis.collect::<Vec<_>>(),
            "matrices": matrices.collect::<Vec<_>>(),
            "bilinear_form": form,
            "hermitian_form": { "entries": entries(&self.hermitian) },
            "certificate": { "relations": RELATIONS, "ok": true },
        })
    }

    fn grid(&self) -> Grid {
        let n = self.basis.len();
        let mut head: Vec<(&'static str, Cell)> = vec![("weight", with_name(&self.weight).into())];
        for (at, line) in labelled(&self.weight).lines().enumerate() {
            head.push((if at == 0 { "diagram" } else { "" }, Cell::drawn(line)));
        }
        let symmetry = match self.symmetry() {
            Some(symmetry) => {
                format!("{}: the bilinear form is {symmetry}", self.weight.indicator())
            }
            None => "complex: there is no invariant bilinear form".into(),
        };
        head.push(("dimension", n.to_string().into()));
        head.push(("reality", symmetry.into()));
        head.push(("basis", BASIS.into()));
        if n <= DENSE {
            let monomials = self.basis.iter().enumerate();
            let list = monomials.map(|(at, (monomial, weight))| {
                format!("{}: {monomial} {}", at + 1, super::list(weight))
            });
            head.push(("", list.collect::<Vec<_>>().join("; ").into()));
        }
        head.push(("columns", COLUMNS.into()));
        head.push(("certificate", format!("ok: {RELATIONS}").into()));
        let title = title(&self.weight, &[("matrices", String::new())]);
        if n <= DENSE {
            let rows = self.written().map(|(name, matrix)| vec![name.into(), drawn(matrix)]);
            return Grid::new(title, &["matrix", "entries"], rows.collect(), Value::Null)
                .with_head(head);
        }
        let rows = self.written().flat_map(|(name, matrix)| {
            matrix.entries().map(move |(i, j, value)| {
                let cell = |at: usize| Cell::from((at + 1).to_string());
                vec![name.into(), cell(i), cell(j), value.to_string().into()]
            })
        });
        let header = ["matrix", "row", "column", "value"];
        Grid::new(title, &header, rows.collect(), Value::Null).with_head(head)
    }
}

impl Report for MatrixReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Csv => self.csv(out),
            Format::Json => {
                // one line, because most of the numbers are entries of matrices
                serde_json::to_writer(&mut *out, &self.json())?;
                writeln!(out)
            }
            _ => {
                let count =
                    self.written().map(|(_, matrix)| matrix.entries().count()).sum::<usize>();
                if count > MAX_ENTRIES {
                    let message = format!(
                        "the matrices have {count} nonzero entries, but {} lists at most \
                         {MAX_ENTRIES}; write --format csv or --format json",
                        format.name()
                    );
                    return Err(io::Error::other(message));
                }
                self.grid().write(format, out)
            }
        }
    }
}

/// The names of the Chevalley basis: `e1`, `f1`, `h1`; for several factors `e1_2` in the second.
fn names(algebra: &ReductiveAlgebra) -> Vec<String> {
    let factors = algebra.simple_factors();
    let names = factors.iter().enumerate().flat_map(|(at, factor)| {
        let names = basis_names(&RootSystem::new(*factor)).into_iter();
        let single = factors.len() == 1;
        names.map(move |name| if single { name } else { format!("{name}_{}", at + 1) })
    });
    names.chain((1..=algebra.abelian_dimension()).map(|i| format!("t{i}"))).collect()
}

/// The nonzero entries `[row, column, value]`, from 1.
fn entries(matrix: &Matrix<Rational>) -> Vec<Value> {
    matrix.entries().map(|(i, j, value)| json!([i + 1, j + 1, value.to_string()])).collect()
}

/// A small matrix with aligned columns.
fn drawn(matrix: &Matrix<Rational>) -> Cell {
    let rows: Vec<Vec<String>> =
        matrix.to_dense().iter().map(|row| row.iter().map(ToString::to_string).collect()).collect();
    let widths: Vec<usize> = (0..matrix.columns())
        .map(|j| rows.iter().map(|row| row[j].len()).max().unwrap_or(0))
        .collect();
    let line = |row: &Vec<String>| {
        let entries = row.iter().zip(&widths).map(|(entry, width)| format!("{entry:>width$}"));
        format!("[{}]", entries.collect::<Vec<_>>().join(" "))
    };
    let text: Vec<String> = rows.iter().map(line).collect();
    let in_tex = |row: &Vec<String>| {
        row.iter().map(|entry| tex::escaped(entry)).collect::<Vec<_>>().join(" & ")
    };
    let body = rows.iter().map(in_tex).collect::<Vec<_>>().join(" \\\\ ");
    let latex = Some(vec![format!("$\\begin{{pmatrix}} {body} \\end{{pmatrix}}$")]);
    Cell { latex, ..Cell::drawn(&text.join("\n")) }
}
