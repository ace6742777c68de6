//! The option `--restore`: replaces matrices that are given with few digits by the nearest elements
//! of the group.

use super::failure::Failure;
use super::note::{counted, note};
use affinor::Error;
use affinor::group::{MatrixNotation, restored};
use affinor_documents::input::InputError;
use clap::Args;
use nalgebra::DMatrix;

/// Advice for a matrix that is not an element of the group.
const ADVICE: &str = "use --restore to replace the matrix by the nearest element of the group";

/// The option that decides whether matrices outside the group are replaced.
#[derive(Args)]
pub struct Restore {
    /// Replace each matrix by the nearest element of the group, and report the largest change. A
    /// change above 0.1 in an entry is an error (in an entry above 1: a change by more than a tenth
    /// of the entry)
    #[arg(long)]
    restore: bool,
}

/// Statistics of the restored matrices.
#[derive(Default)]
pub struct Restored {
    rows: u64,
    /// The largest change of an entry.
    distance: f64,
}

impl Restored {
    /// Converts a matrix to an element of the group. With `--restore`, returns the nearest element;
    /// otherwise the result of `strict`.
    pub fn read<G: MatrixNotation>(
        &mut self,
        option: &Restore,
        group: &G,
        matrix: &DMatrix<f64>,
        strict: impl FnOnce(&DMatrix<f64>) -> Result<G::Element, Error>,
    ) -> Result<G::Element, Failure> {
        if option.restore {
            let (g, distance) = restored(group, matrix)?;
            self.rows += 1;
            self.distance = self.distance.max(distance);
            return Ok(g);
        }
        strict(matrix).map_err(|error| {
            let is_off = matches!(error, Error::Invalid { .. });
            let error = InputError::from(error);
            match is_off {
                true => error.help(ADVICE).into(),
                false => error.into(),
            }
        })
    }

    /// The error of a logarithm, with advice to use `--restore` if the nearest element has a
    /// logarithm.
    pub fn refused<G: MatrixNotation>(
        &self,
        option: &Restore,
        group: &G,
        matrix: &DMatrix<f64>,
        error: Error,
    ) -> Failure {
        let has_log = |(g, _): (G::Element, f64)| group.log(&g).is_ok();
        match !option.restore && restored(group, matrix).is_ok_and(has_log) {
            true => InputError::from(error).help(ADVICE).into(),
            false => error.into(),
        }
    }

    /// Prints a note on the largest change of an entry.
    pub fn note(&self) {
        if self.rows > 0 {
            let (rows, distance) = (counted(self.rows, "row"), self.distance);
            note(&format!(
                "{rows} restored: the nearest elements differ by at most {distance:.1e} in an entry"
            ));
        }
    }
}
