//! Displays of tensors as text, LaTeX and HTML.

use crate::components::each;
use crate::tensor::{LETTERS, PyTensor, written};
use affinor_documents::Coefficient;
use affinor_documents::report::{labelled_in_latex, labelled_in_text};
use affinor_tensors::Tensor;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The largest number of components that a notebook shows.
const SHOWN: usize = 50;

/// The largest number of components that `str` lists.
const LISTED: usize = 2000;

impl PyTensor {
    /// The index letters.
    pub fn letters(&self) -> String {
        let letters = || LETTERS.chars().take(self.rank()).collect();
        self.names.letters.clone().unwrap_or_else(letters)
    }

    /// The symbol with its index letters, such as `R^i_jkl`.
    fn general(&self) -> String {
        format!("{}{}", self.names.symbol, written(&self.letters(), &self.slots(), true))
    }

    fn count(&self) -> String {
        let nnz = self.nnz();
        format!("{nnz} nonzero component{}", if nnz == 1 { "" } else { "s" })
    }

    /// The components as text; at most [`LISTED`] components are listed.
    fn listed(&self, labels: Option<&[String]>) -> String {
        let nnz = self.nnz();
        if nnz == 0 {
            return format!("{}\n  {} = 0", self.heading(), self.general());
        }
        let symbol = &self.names.symbol;
        let mut text = each!(&self.values, tensor => {
            labelled_in_text(symbol, &first(tensor, LISTED), labels)
        });
        if nnz > LISTED {
            text += &format!("  and {} more\n", nnz - LISTED);
        } else if self.dimension().checked_pow(self.rank() as u32) != Some(nnz) {
            text += "  all others are zero\n";
        }
        format!("{}\n{text}", self.heading()).trim_end_matches('\n').into()
    }

    /// The components in LaTeX.
    fn in_latex(&self, limit: Option<usize>, labels: Option<&[String]>) -> String {
        let (nnz, latex, slots) = (self.nnz(), &self.names.latex, self.slots());
        if nnz == 0 {
            let marked: Vec<(char, char)> = slots.chars().zip(self.letters().chars()).collect();
            let runs = marked.chunk_by(|a, b| a.0 == b.0).map(|run| {
                let letters: String = run.iter().map(|(_, letter)| *letter).collect();
                format!("{}{{{letters}}}", run[0].0)
            });
            return format!("{latex}{} = 0", runs.collect::<Vec<_>>().join("{}"));
        }
        let limit = limit.unwrap_or(nnz);
        let lines =
            each!(&self.values, tensor => labelled_in_latex(latex, &first(tensor, limit), labels));
        let mut lines: Vec<String> =
            lines.into_iter().map(|line| line.replace(r"\\*", r"\\")).collect();
        if nnz > limit {
            lines.push(format!("&\\text{{and {} more components}}", nnz - limit));
        }
        format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"))
    }

    fn expect_labels(&self, labels: Option<&[String]>) -> PyResult<()> {
        let n = self.dimension();
        match labels.map(<[String]>::len) {
            Some(found) if found != n => {
                Err(PyValueError::new_err(format!("{found} labels, but the dimension is {n}")))
            }
            _ => Ok(()),
        }
    }

    fn heading(&self) -> String {
        let title = self.names.title.clone().unwrap_or_else(|| self.general());
        if self.nnz() == 0 { title } else { format!("{title}: {}", self.count()) }
    }
}

#[pymethods]
impl PyTensor {
    fn __repr__(&self) -> String {
        let (general, count, scalar) = (self.general(), self.count(), self.scalar());
        format!("<Tensor {general}, dimension {}, {count}, {scalar}>", self.dimension())
    }

    fn __str__(&self) -> String {
        self.listed(None)
    }

    /// Components as text, as ``str`` writes them.
    ///
    /// Parameters
    /// ----------
    /// labels : list of str, optional
    ///     Names of the index values, such as the names of coordinates; by default numbers from 1.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Examples
    /// --------
    /// >>> print(Tensor([[1, 0], [0, "r^2"]], "__", symbol="g").to_text(["r", "phi"]))
    /// g_ij: 2 nonzero components
    ///   g_rr = 1
    ///   g_phi,phi = r^2
    ///   all others are zero
    #[pyo3(signature = (labels=None))]
    fn to_text(&self, labels: Option<Vec<String>>) -> PyResult<String> {
        self.expect_labels(labels.as_deref())?;
        Ok(self.listed(labels.as_deref()))
    }

    /// Components in LaTeX, as lines of an ``aligned`` environment.
    ///
    /// Parameters
    /// ----------
    /// limit : int, optional
    ///     Largest number of components that are written.
    /// labels : list of str, optional
    ///     Names of the index values, such as the names of coordinates; by default numbers from 1.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Examples
    /// --------
    /// >>> print(Tensor([[0, 1], [0, 0]], "__", symbol="g").to_latex())
    /// \begin{aligned}
    /// g_{12} &= 1
    /// \end{aligned}
    #[pyo3(signature = (limit=None, labels=None))]
    fn to_latex(&self, limit: Option<usize>, labels: Option<Vec<String>>) -> PyResult<String> {
        self.expect_labels(labels.as_deref())?;
        Ok(self.in_latex(limit, labels.as_deref()))
    }

    pub fn _repr_latex_(&self) -> String {
        format!("$$\n{}\n$$", self.in_latex(Some(SHOWN), None))
    }
    /// Shows the first components of a large tensor as a table; smaller tensors are shown in LaTeX.
    fn _repr_html_(&self) -> Option<String> {
        let more = self.nnz().checked_sub(SHOWN).filter(|more| *more > 0)?;
        let escaped = |text: &str| {
            let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
            text.replace('"', "&quot;").replace('\'', "&#x27;")
        };
        let head: String = self.letters().chars().map(|i| format!("<th>{i}</th>")).collect();
        let row = |at: Vec<usize>, value: String| {
            let cells: String = at.iter().map(|index| format!("<td>{}</td>", index + 1)).collect();
            format!("<tr>{cells}<td>{}</td></tr>", escaped(&value))
        };
        let rows: String = each!(&self.values, tensor => {
            let shown = tensor.components().take(SHOWN);
            shown.map(|(at, value)| row(at.to_vec(), value.to_string())).collect()
        });
        let heading = escaped(&self.heading());
        Some(format!(
            "<p>{heading}; the first {SHOWN} are shown, indices from 1, {more} are not</p>\
             <table><tr>{head}<th>value</th></tr>{rows}</table>"
        ))
    }
}

/// A tensor with only the first components.
fn first<S: Coefficient>(tensor: &Tensor<S>, limit: usize) -> Tensor<S> {
    if tensor.len() <= limit {
        return tensor.clone();
    }
    let some = tensor.components().take(limit).map(|(at, value)| (at, value.clone()));
    Tensor::from_components(tensor.dimension(), tensor.slots(), some)
        .unwrap_or_else(|_| tensor.clone())
}
