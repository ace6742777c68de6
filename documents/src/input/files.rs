//! Cache of files: each file that a definition names is read once.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The contents of files, by their paths.
#[derive(Clone, Debug, Default)]
pub struct Files(Arc<Mutex<BTreeMap<String, Arc<str>>>>);

impl Files {
    /// A cache with these contents.
    pub fn new(contents: BTreeMap<String, Arc<str>>) -> Self {
        Files(Arc::new(Mutex::new(contents)))
    }

    /// The contents of all files that were given or read.
    pub fn contents(&self) -> BTreeMap<String, Arc<str>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The content of a file, if it was already given or read.
    pub(crate) fn content(&self, path: &str) -> Option<Arc<str>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(path).cloned()
    }

    /// Stores the content of a file that was read.
    pub(crate) fn keep(&self, path: &str, content: &Arc<str>) {
        let mut contents = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        contents.insert(path.into(), content.clone());
    }
}
