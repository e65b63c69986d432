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
        remove_abandoned(path);
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
        self.write_content(name, text.as_bytes())
    }

    fn write_content(&self, name: &str, content: &[u8]) -> Result<PathBuf, ChartsError> {
        self.stage(name, content)?;
        self.publish(name)
    }

    /// Writes a file beside its place.
    fn stage(&self, name: &str, content: &[u8]) -> Result<(), ChartsError> {
        let temporary = self.path.join(temporary(name));
        let write = || {
            let mut file = std::fs::File::create(&temporary)?;
            file.write_all(content)?;
            file.sync_all()
        };
        write().map_err(|cause| self.unwritable(name, &cause))
    }

    /// Moves a file that was written beside its place to its place.
    fn publish(&self, name: &str) -> Result<PathBuf, ChartsError> {
        let path = self.path.join(name);
        std::fs::rename(self.path.join(temporary(name)), &path).map_err(|cause| self.unwritable(name, &cause))?;
        Ok(path)
    }

    fn unwritable(&self, name: &str, cause: &std::io::Error) -> ChartsError {
        // Nothing more can be done about a temporary file that cannot be removed.
        let _ = std::fs::remove_file(self.path.join(temporary(name)));
        ChartsError::Unwritable { path: self.path.join(name), cause: cause.to_string() }
    }

    /// The names of the files that stand here from the run before.
    fn listed(&self) -> Vec<String> {
        let list = std::fs::read_to_string(self.path.join(LIST)).unwrap_or_default();
        // A name with a separator would lead elsewhere: nobody here has written it.
        list.lines().filter(|name| !name.is_empty() && !name.contains(['/', '\\'])).map(str::to_owned).collect()
    }
}

/// The summary of a set of results: it is removed before the first file of a new set is moved to its place, and comes last.
const SUMMARY: &str = "summary.json";
/// The list of the files of a set.
const LIST: &str = ".piola-results";

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
    /// Adds files to the set that was just written.
    pub fn add<'n, T: AsRef<[u8]>>(&mut self, folder: &Folder, files: impl IntoIterator<Item = (&'n str, T)>) {
        let mut list = folder.listed();
        for (name, content) in files {
            match folder.write_content(name, content.as_ref()) {
                Ok(path) => {
                    self.files.push(path);
                    list.retain(|other| other != name);
                    list.push(name.to_owned());
                }
                Err(error) => self.failures.push(error),
            }
        }
        let list = list.into_iter().fold(String::new(), |text, name| text + &name + "\n");
        if let Err(error) = folder.write(LIST, &list) {
            self.failures.push(error);
        }
    }

    /// Writes a set of files into a folder, in place of the set that was written there before.
    ///
    /// All files are first written beside their places. Then the old `summary.json` is removed, the files are moved to their
    /// places, `summary.json` last, and files of the old set that the new one lacks are removed. So a folder with a
    /// `summary.json` holds one whole set, whenever the program is killed.
    #[must_use]
    pub fn of<'n, T: AsRef<[u8]>>(folder: &Folder, files: impl IntoIterator<Item = (&'n str, T)>) -> Self {
        let mut written = Self::default();
        let mut staged = Vec::new();
        for (name, content) in files {
            match folder.stage(name, content.as_ref()) {
                Ok(()) => staged.push(name),
                Err(error) => written.failures.push(error),
            }
        }
        if staged.is_empty() {
            return written;
        }
        let before = folder.listed();
        // What is not there needs no removing; what cannot be removed is replaced below.
        let remove = |name: &str| drop(std::fs::remove_file(folder.path.join(name)));
        if staged.contains(&SUMMARY) {
            remove(SUMMARY);
        }
        let (last, first): (Vec<_>, Vec<_>) = staged.iter().partition(|name| **name == SUMMARY);
        before.iter().filter(|name| !staged.contains(&name.as_str())).for_each(|name| remove(name));
        let mut list = staged.join("\n");
        list.push('\n');
        if let Err(error) = folder.write(LIST, &list) {
            written.failures.push(error);
        }
        for name in first.into_iter().chain(last) {
            match folder.publish(name) {
                Ok(path) => written.files.push(path),
                Err(error) => written.failures.push(error),
            }
        }
        // In the order of the caller.
        written.files.sort_by_key(|path| staged.iter().position(|name| path.ends_with(name)));
        written
    }
}

/// Removes the temporary files of programs that were killed: of processes that no longer run, where that can be told.
fn remove_abandoned(folder: &Path) {
    let processes = Path::new("/proc");
    let (true, Ok(entries)) = (processes.join("self").exists(), std::fs::read_dir(folder)) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let process = name.to_str().and_then(|name| name.strip_prefix('.')?.strip_suffix(".tmp")?.rsplit_once('.'));
        if let Some((_, number)) = process
            && number.parse::<u32>().is_ok()
            && !processes.join(number).exists()
        {
            // Somebody else may have removed it.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// A name that no other process uses.
fn temporary(name: &str) -> String {
    format!(".{name}.{}.tmp", std::process::id())
}
