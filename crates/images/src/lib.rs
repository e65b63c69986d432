//! Files of images and displacement fields.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![expect(clippy::doc_markdown, reason = "NIfTI is the name of a format")]

mod contents;
mod error;
mod field;
mod file;
mod format;
mod forms;
mod luminance;
mod nifti;
mod npy;
mod nrrd;
mod picture;
mod png;
mod sample_type;
mod tiff;

pub use error::ImagesError;
pub use field::DisplacementField;
pub use file::{MOST_SAMPLES, write_whole};
pub use npy::write_npy;
pub use picture::{AnyPicture, Picture, PicturePlacement};
pub use png::Bitmap;
pub use sample_type::SampleType;
