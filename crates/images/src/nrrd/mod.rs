//! NRRD: a header of text lines, an empty line, the samples (raw, gzip or text) in the same file.

mod header;
mod write;

pub(crate) use write::encode;

use std::path::Path;

use crate::contents::{Contents, usual_directions};
use crate::error::ImagesError;
use crate::file;
use crate::sample_type::{Order, SampleType};
use header::Header;

/// How the samples are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Raw,
    Gzip,
    Text,
}

pub(crate) fn decode(path: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    let (header, rest) = Header::parse(path, content)?;
    let sizes = header.sizes()?;
    let samples = file::samples(path, &sizes)?;
    let (sample_type, encoding) = (header.sample_type()?, header.encoding()?);
    let order = header.order(sample_type, encoding)?;
    header.check_skips()?;
    let components = header.components(&sizes)?;
    let geometry = header.geometry(usize::from(components.is_some()), sizes.len())?;
    let values = match encoding {
        Encoding::Text => text(path, rest, samples)?,
        Encoding::Raw => binary(path, rest, samples, sample_type, order)?,
        Encoding::Gzip => {
            let length = (samples * sample_type.bytes()) as u64;
            file::check_announced(path, length, rest.len(), true)?;
            binary(path, &file::inflate(path, rest, length)?, samples, sample_type, order)?
        }
    };
    let axes: Vec<_> = sizes[usize::from(components.is_some())..]
        .iter()
        .rev()
        .map(|size| usize::try_from(*size).unwrap_or(usize::MAX))
        .collect();
    let directions = geometry.directions.unwrap_or_else(|| usual_directions(axes.len()));
    let contents = Contents::plain(axes, values, sample_type);
    let (spacing, origin) = (geometry.spacing, geometry.origin);
    Ok(Contents { components: components.unwrap_or(1), spacing, origin, directions, ..contents })
}

fn binary(
    path: &Path,
    bytes: &[u8],
    samples: usize,
    sample_type: SampleType,
    order: Order,
) -> Result<Vec<f64>, ImagesError> {
    let length = samples * sample_type.bytes();
    file::check_announced(path, length as u64, bytes.len(), false)?;
    Ok(sample_type.decode(&bytes[..length], order))
}

fn text(path: &Path, bytes: &[u8], samples: usize) -> Result<Vec<f64>, ImagesError> {
    let text = String::from_utf8_lossy(bytes);
    // A number and the space after it take two bytes.
    file::check_announced(path, 2 * samples as u64, bytes.len() + 1, false)?;
    let mut values = Vec::with_capacity(samples);
    for word in text.split_ascii_whitespace().take(samples) {
        let value = word.parse::<f64>().map_err(|_| {
            let cause =
                format!("sample {} is `{}`, not a number", values.len(), word.chars().take(20).collect::<String>());
            ImagesError::malformed(path, "NRRD", cause)
        })?;
        values.push(value);
    }
    if values.len() < samples {
        let cause = format!("{} samples are there, the sizes announce {samples}", values.len());
        return Err(ImagesError::malformed(path, "NRRD", cause));
    }
    Ok(values)
}
