//! The folder of the results.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::SceneError;

/// A folder that has been written to once, to see that it can be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Makes the folder, with those above it, and tries to write a file in it.
    ///
    /// # Errors
    /// [`SceneError::UnwritableFolder`].
    pub fn prepare(path: &Path) -> Result<Self, SceneError> {
        let unwritable =
            |cause: std::io::Error| SceneError::UnwritableFolder { path: path.to_path_buf(), cause: cause.to_string() };
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
    /// [`SceneError::Unwritable`].
    pub fn write(&self, name: &str, text: &str) -> Result<PathBuf, SceneError> {
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
            SceneError::Unwritable { path: path.clone(), cause: cause.to_string() }
        })?;
        Ok(path)
    }
}

/// A name that no other process uses.
fn temporary(name: &str) -> String {
    format!(".{name}.{}.tmp", std::process::id())
}
