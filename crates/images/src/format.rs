//! The format of a file: by its name for writing, by its first bytes for reading.

use std::path::Path;

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::{file, nifti, nrrd, png, tiff};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Png,
    Tiff,
    Nifti { is_packed: bool },
    Nrrd,
    Npy,
}

impl Format {
    /// What the end of the name says.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_string_lossy().to_lowercase();
        let endings = [
            (".png", Self::Png),
            (".tif", Self::Tiff),
            (".tiff", Self::Tiff),
            (".nii", Self::Nifti { is_packed: false }),
            (".nii.gz", Self::Nifti { is_packed: true }),
            (".nrrd", Self::Nrrd),
            (".npy", Self::Npy),
        ];
        endings.into_iter().find(|(ending, _)| name.ends_with(ending)).map(|(_, format)| format)
    }
}

/// Reads a file of a format that its name says.
pub(crate) fn decode(path: &Path) -> Result<Contents, ImagesError> {
    let format = readable(path)?;
    decode_as(format, path, &file::read(path)?)
}

/// Reads the content of a file; its name says the format.
pub(crate) fn decode_content(name: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    decode_as(readable(name)?, name, content)
}

fn readable(path: &Path) -> Result<Format, ImagesError> {
    Format::of(path).filter(|format| *format != Format::Npy).ok_or_else(|| {
        let (purpose, valid) = ("reading an image", ".png, .tif, .tiff, .nii, .nii.gz or .nrrd");
        ImagesError::UnknownFormat { path: path.into(), purpose, valid }
    })
}

fn decode_as(format: Format, path: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    match format {
        Format::Png => png::decode(path, content),
        Format::Tiff => tiff::decode(path, content),
        Format::Nifti { .. } => nifti::decode(path, content),
        Format::Nrrd | Format::Npy => nrrd::decode(path, content),
    }
}

/// The file of these contents.
pub(crate) fn encode(path: &Path, contents: &Contents) -> Result<Vec<u8>, ImagesError> {
    match Format::of(path) {
        Some(Format::Png) => png::encode(path, contents),
        Some(Format::Tiff) => tiff::encode(path, contents),
        Some(Format::Nifti { is_packed }) => {
            let content = nifti::encode(path, contents)?;
            if is_packed { file::deflate(path, &content) } else { Ok(content) }
        }
        Some(Format::Nrrd) => nrrd::encode(path, contents),
        Some(Format::Npy) | None => {
            let (purpose, valid) = ("writing an image", ".png, .tif, .tiff, .nii, .nii.gz or .nrrd");
            Err(ImagesError::UnknownFormat { path: path.into(), purpose, valid })
        }
    }
}
