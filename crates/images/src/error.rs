//! Violated conditions of image files: each variant names one, the file and the numbers.

use std::path::{Path, PathBuf};

use piola_registration::RegistrationError;

/// A file that cannot be read or written, or a picture that its format cannot hold.
///
/// # Example
/// ```
/// use piola_images::{ImagesError, Picture};
/// let refused = Picture::<2>::read("no-such-file.png");
/// assert!(matches!(refused, Err(ImagesError::Unreadable { .. })));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImagesError {
    /// The operating system does not let the file be read.
    #[error("cannot read `{}`: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The reason that the system gives.
        cause: String,
    },
    /// The file cannot be written: no such folder, no permission, no space. No part of it is left.
    #[error("cannot write `{}`: {cause}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The reason that the system gives.
        cause: String,
    },
    /// The end of the file's name stands for no format that can do this.
    #[error("`{}`: {purpose} needs a name that ends in {valid}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// What was to be read or written.
        purpose: &'static str,
        /// The valid endings.
        valid: &'static str,
    },
    /// The content contradicts the format.
    #[error("`{}` is no valid {format} file: {cause}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The format.
        format: &'static str,
        /// What is wrong.
        cause: String,
    },
    /// The file ends before its last sample.
    #[error("`{}` is truncated: its header announces {expected} bytes of samples, at most {found} are there", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// The bytes that the header announces.
        expected: u64,
        /// The bytes that are there, or that compressed data of this length can hold.
        found: u64,
    },
    /// The format is known, but not this use of it.
    #[error("`{}` has {found}; valid: {valid}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What the file has.
        found: String,
        /// What is valid.
        valid: &'static str,
    },
    /// The header announces more than is read; nothing was allocated.
    #[error("`{}` has {quantity} {found}; at most {most} are read", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What is too large.
        quantity: &'static str,
        /// Its size.
        found: u128,
        /// The largest size that is read.
        most: u64,
    },
    /// The picture has the wrong number of axes.
    #[error("`{}` has {found} axes of more than one sample; {valid}", path.display())]
    Dimension {
        /// The file.
        path: PathBuf,
        /// The number of axes.
        found: usize,
        /// What is valid.
        valid: &'static str,
    },
    /// A size is zero or one.
    #[error("`{}` has size {found} along axis {axis} of the file; at least 2 samples are needed along every axis", path.display())]
    TooFewSamples {
        /// The file.
        path: PathBuf,
        /// The axis, counted from 0 in the order of the file.
        axis: usize,
        /// The size.
        found: usize,
    },
    /// 0 < spacing < ∞ is violated.
    #[error("`{}`: spacing {value} along axis {axis} of the file; it must be positive and finite", path.display())]
    Spacing {
        /// The file.
        path: PathBuf,
        /// The axis, counted from 0 in the order of the file.
        axis: usize,
        /// The spacing, mm.
        value: f64,
    },
    /// A number is infinite or NaN.
    #[error("`{}`: {quantity}[{index}] = {value} is not finite; every value must be a finite number", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// What the number is.
        quantity: &'static str,
        /// Its position, in row-major order.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// The axes of a picture are not perpendicular to each other, so that its samples fill no box.
    #[error("axes {} and {} enclose an angle with cosine {cosine:.3e}; registration needs perpendicular axes", axes[0], axes[1])]
    NotPerpendicular {
        /// The two axes, of the picture.
        axes: [usize; 2],
        /// The cosine of their angle.
        cosine: f64,
    },
    /// The map of a displacement field does not have the sizes of the picture that places it.
    #[error("axis {axis}: the map has {found} samples, the picture {expected}; both must have the same")]
    UnequalSizes {
        /// The axis.
        axis: usize,
        /// The size of the map.
        found: usize,
        /// The size of the picture.
        expected: usize,
    },
    /// A condition of grids, images and maps.
    #[error(transparent)]
    Registration(#[from] RegistrationError),
}

impl ImagesError {
    pub(crate) fn unreadable(path: &Path, cause: &std::io::Error) -> Self {
        Self::Unreadable { path: path.into(), cause: cause.to_string() }
    }

    pub(crate) fn unwritable(path: &Path, cause: &dyn std::error::Error) -> Self {
        Self::Unwritable { path: path.into(), cause: cause.to_string() }
    }

    pub(crate) fn malformed(path: &Path, format: &'static str, cause: impl Into<String>) -> Self {
        Self::Malformed { path: path.into(), format, cause: cause.into() }
    }

    pub(crate) fn unsupported(path: &Path, found: impl Into<String>, valid: &'static str) -> Self {
        Self::Unsupported { path: path.into(), found: found.into(), valid }
    }
}
