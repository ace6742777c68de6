//! The folder of a problem, and which files beside its own it is read from.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// Where the files lie that a problem names.
pub(super) struct Folder {
    path: PathBuf,
    named: RefCell<Vec<String>>,
}

impl Folder {
    pub fn new(path: &Path) -> Self {
        Folder { path: path.to_path_buf(), named: RefCell::default() }
    }

    /// The path of a file, which belongs to the problem from now on.
    pub fn join(&self, name: &str) -> String {
        let path = self.path.join(name).to_string_lossy().into_owned();
        self.named.borrow_mut().push(path.clone());
        path
    }

    /// All paths so far.
    pub fn named(&self) -> Vec<String> {
        self.named.borrow().clone()
    }
}
