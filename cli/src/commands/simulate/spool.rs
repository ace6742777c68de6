//! Rows of a running simulation, stored as binary numbers until they are written in the chosen
//! format.

use super::super::failure::Failure;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// A file of rows of equal width: doubles in little-endian order.
pub struct Spool {
    file: BufWriter<File>,
    width: usize,
    count: u64,
}

const BYTES: usize = size_of::<f64>();

impl Spool {
    /// Creates a spool in an unnamed temporary file, which the system deletes when the program
    /// ends.
    pub fn temporary(width: usize) -> io::Result<Self> {
        Self::over(tempfile::tempfile()?, width, 0, 0)
    }

    /// Opens a spool in a named file, and truncates the file to its first `kept` rows; `None` if
    /// the file has fewer rows.
    pub fn named(path: &Path, width: usize, kept: u64) -> io::Result<Option<Self>> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(kept == 0).truncate(false);
        let file = match options.open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound && kept > 0 => return Ok(None),
            opened => opened?,
        };
        let length = file.metadata()?.len();
        let end = kept.checked_mul((width * BYTES) as u64).filter(|end| *end <= length);
        end.map(|end| Self::over(file, width, kept, end)).transpose()
    }

    /// Creates a spool on an open file, truncated to `end` bytes, that contains `count` rows.
    fn over(mut file: File, width: usize, count: u64, end: u64) -> io::Result<Self> {
        file.set_len(end)?;
        file.seek(SeekFrom::Start(end))?;
        Ok(Spool { file: BufWriter::with_capacity(1 << 16, file), width, count })
    }

    pub fn push(&mut self, row: &[f64]) -> io::Result<()> {
        for value in row {
            self.file.write_all(&value.to_le_bytes())?;
        }
        self.count += 1;
        Ok(())
    }

    /// Flushes all rows to the disk.
    pub fn sync(&mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_data()
    }

    pub fn count(&self) -> u64 {
        self.count
    }

    /// Reads all rows from the first one.
    pub fn rows(&mut self) -> io::Result<impl Iterator<Item = io::Result<Vec<f64>>>> {
        self.file.flush()?;
        let mut file = self.file.get_ref().try_clone()?;
        file.seek(SeekFrom::Start(0))?;
        let mut reader = BufReader::with_capacity(1 << 16, file);
        let mut bytes = vec![0; self.width * BYTES];
        Ok((0..self.count).map(move |_| {
            reader.read_exact(&mut bytes)?;
            let numbers = bytes.as_chunks::<BYTES>().0;
            Ok(numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
        }))
    }
}

/// The failure for an error of reading or writing stored rows.
pub fn failed(error: io::Error) -> Failure {
    Failure::Output(error, "the rows of the run".into())
}
