//! Pictures and a folder for files.

use std::path::{Path, PathBuf};

use piola_images::{ImagesError, Picture, PicturePlacement, SampleType};

/// A folder of its own for each test, removed at its end.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-images-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn with(&self, name: &str, content: &[u8]) -> PathBuf {
        let path = self.file(name);
        std::fs::write(&path, content).unwrap_or_else(|error| panic!("{error}"));
        path
    }

    /// The names of the files, in order.
    pub(crate) fn names(&self) -> Vec<String> {
        let files = std::fs::read_dir(&self.0).into_iter().flatten().flatten();
        let mut names: Vec<_> = files.map(|file| file.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub(crate) fn content(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The folder of data in the repository.
pub(crate) fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/images").join(name)
}

/// Whole numbers from 0 to 250, all different from their neighbours.
fn values(count: usize) -> Vec<f64> {
    (0..count).map(|position| ((position * 37) % 251) as f64).collect()
}

pub(crate) fn plane(sample_type: SampleType) -> Result<Picture<2>, ImagesError> {
    Picture::new([4, 5], [1.0; 2], values(20), sample_type)
}

/// Oblique axes, turned about two axes, with an origin.
pub(crate) fn oblique() -> PicturePlacement<3> {
    let (s, c) = (0.6, 0.8);
    PicturePlacement { origin: [-12.5, 3.25, 40.0], directions: [[0.0, -s, c], [-s, c * c, s * c], [c, s * c, s * s]] }
}

pub(crate) fn space(sample_type: SampleType) -> Result<Picture<3>, ImagesError> {
    Picture::new([3, 4, 5], [2.5, 0.5, 1.25], values(60), sample_type)?.with_placement(oblique())
}
