//! NPY: arrays for numpy.

use std::path::Path;

use crate::error::ImagesError;
use crate::file;
use crate::format::Format;
use crate::sample_type::{Order, SampleType};

/// Writes an array in row-major order for `numpy.load`, in double precision and one piece.
///
/// # Errors
/// [`ImagesError::UnknownFormat`] unless the name ends in `.npy`; `Malformed` where the number of values is not the product of the shape;
/// `Unwritable`.
///
/// # Example
/// ```
/// let path = std::env::temp_dir().join(format!("piola-array-{}.npy", std::process::id()));
/// piola_images::write_npy(&path, &[2, 3], &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0])?;
/// let content = std::fs::read(&path).unwrap_or_default();
/// assert_eq!(content.len(), 128 + 6 * 8);
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
pub fn write_npy(path: impl AsRef<Path>, shape: &[usize], values: &[f64]) -> Result<(), ImagesError> {
    let path = path.as_ref();
    if Format::of(path) != Some(Format::Npy) {
        let (purpose, valid) = ("writing an array", ".npy");
        return Err(ImagesError::UnknownFormat { path: path.into(), purpose, valid });
    }
    if shape.iter().try_fold(1_usize, |product, size| product.checked_mul(*size)) != Some(values.len()) {
        return Err(ImagesError::malformed(path, "NPY", format!("{} values for the shape {shape:?}", values.len())));
    }
    write(path, shape, values)
}

pub(crate) fn write(path: &Path, shape: &[usize], values: &[f64]) -> Result<(), ImagesError> {
    let sizes: Vec<_> = shape.iter().map(|size| format!("{size},")).collect();
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", sizes.join(" "));
    // Magic, version and length take ten bytes; the samples begin at a multiple of 64; the header ends with a new line.
    while !(10 + header.len() + 1).is_multiple_of(64) {
        header.push(' ');
    }
    header.push('\n');
    let length = u16::try_from(header.len())
        .map_err(|_| ImagesError::malformed(path, "NPY", "a shape with too many axes for version 1.0"))?;
    let mut content = b"\x93NUMPY\x01\x00".to_vec();
    content.extend_from_slice(&length.to_le_bytes());
    content.extend_from_slice(header.as_bytes());
    content.extend(SampleType::F64.encode(values.iter().copied(), Order::Little));
    file::write(path, &content)
}
