//! The folder of the results, and files that are written whole.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::ChartsError;

/// A folder that has been written to once, to see that it can be.
///
/// # Example
/// ```
/// use piola_charts::{Folder, Written};
/// let folder = Folder::prepare(&std::env::temp_dir().join("piola-charts-example"))?;
/// let written = Written::of(&folder, [("one.csv", "1\n".to_owned())]);
/// assert!(written.failures.is_empty() && written.files[0].ends_with("one.csv"));
/// # std::fs::remove_dir_all(folder.path()).ok();
/// # Ok::<(), piola_charts::ChartsError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Makes the folder, with those above it, and tries to write a file in it.
    ///
    /// # Errors
    /// [`ChartsError::UnwritableFolder`].
    pub fn prepare(path: &Path) -> Result<Self, ChartsError> {
        let unwritable = |cause: std::io::Error| ChartsError::UnwritableFolder {
            path: path.to_path_buf(),
            cause: cause.to_string(),
        };
        std::fs::create_dir_all(path).map_err(unwritable)?;
        let trial = path.join(temporary("trial"));
        std::fs::write(&trial, b"trial").map_err(unwritable)?;
        std::fs::remove_file(&trial).map_err(unwritable)?;
        Ok(Self { path: path.to_path_buf() })
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file in one piece: another program sees the old one or the new one.
    ///
    /// # Errors
    /// [`ChartsError::Unwritable`].
    pub fn write(&self, name: &str, text: &str) -> Result<PathBuf, ChartsError> {
        let path = self.path.join(name);
        let temporary = self.path.join(temporary(name));
        let write = || {
            let mut file = std::fs::File::create(&temporary)?;
            file.write_all(text.as_bytes())?;
            file.sync_all()?;
            std::fs::rename(&temporary, &path)
        };
        write().map_err(|cause| {
            // Nothing more can be done about a temporary file that cannot be removed.
            let _ = std::fs::remove_file(&temporary);
            ChartsError::Unwritable { path: path.clone(), cause: cause.to_string() }
        })?;
        Ok(path)
    }
}

/// The files that were written, and those that could not be.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct Written {
    /// Files in the order of writing.
    pub files: Vec<PathBuf>,
    /// The error of each file that could not be written.
    pub failures: Vec<ChartsError>,
}

impl Written {
    /// Writes files into a folder.
    #[must_use]
    pub fn of<'n>(folder: &Folder, files: impl IntoIterator<Item = (&'n str, String)>) -> Self {
        let mut written = Self::default();
        for (name, text) in files {
            match folder.write(name, &text) {
                Ok(path) => written.files.push(path),
                Err(error) => written.failures.push(error),
            }
        }
        written
    }
}

/// A name that no other process uses.
fn temporary(name: &str) -> String {
    format!(".{name}.{}.tmp", std::process::id())
}
