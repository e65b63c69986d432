//! TIFF: grey samples of any type; whole-number colours become their luminance.

use std::io::Cursor;
use std::path::Path;

use ::tiff::decoder::{Decoder, DecodingResult, Limits};
use ::tiff::encoder::{TiffEncoder, colortype};
use ::tiff::{ColorType, TiffError};

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::file;
use crate::luminance::grey;
use crate::png::plane;
use crate::sample_type::{SampleType, single};

/// Bytes of lists in the directory of a file: the offsets of its strips.
const MOST_OF_A_LIST: usize = 16 << 20;

pub(crate) fn decode(path: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    let malformed = |cause: TiffError| match cause {
        TiffError::UnsupportedError(what) => ImagesError::unsupported(
            path,
            what.to_string(),
            "grey or RGB samples, stored plainly or packed by LZW or Deflate",
        ),
        other => ImagesError::malformed(path, "TIFF", other.to_string()),
    };
    let mut decoder = Decoder::new(Cursor::new(content)).map_err(malformed)?;
    let (width, height) = decoder.dimensions().map_err(malformed)?;
    let samples = file::samples(path, &[u64::from(width), u64::from(height)])?;
    let colour = decoder.colortype().map_err(malformed)?;
    let channels = match colour {
        ColorType::Gray(_) => 1,
        ColorType::GrayA(_) => 2,
        ColorType::RGB(8 | 16) => 3,
        ColorType::RGBA(8 | 16) => 4,
        other => {
            return Err(ImagesError::unsupported(
                path,
                format!("samples of kind {other:?}"),
                "grey, or RGB of 8 or 16 bits",
            ));
        }
    };
    if decoder.more_images() {
        return Err(ImagesError::unsupported(path, "several pages", "TIFF files of one page; stacks as NIfTI or NRRD"));
    }
    let length = samples * channels * usize::from(colour.bit_depth()).div_ceil(8);
    file::check_announced(path, length as u64, content.len(), true)?;
    let mut limits = Limits::unlimited();
    limits.decoding_buffer_size = length;
    limits.ifd_value_size = MOST_OF_A_LIST;
    limits.intermediate_buffer_size = length.max(1 << 16);
    let mut decoder = decoder.with_limits(limits);
    let (stored, sample_type): (Vec<f64>, _) = match decoder.read_image().map_err(malformed)? {
        DecodingResult::U8(stored) if 8 <= colour.bit_depth() => {
            (stored.into_iter().map(f64::from).collect(), SampleType::U8)
        }
        DecodingResult::U16(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::U16),
        DecodingResult::U32(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::U32),
        DecodingResult::I8(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::I8),
        DecodingResult::I16(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::I16),
        DecodingResult::I32(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::I32),
        DecodingResult::F32(stored) => (stored.into_iter().map(f64::from).collect(), SampleType::F32),
        DecodingResult::F64(stored) => (stored, SampleType::F64),
        _ => {
            let found = format!("samples of kind {colour:?}");
            return Err(ImagesError::unsupported(path, found, "whole numbers of 8, 16 or 32 bits, floats of 32 or 64"));
        }
    };
    if stored.len() < samples * channels {
        let (expected, found) = ((samples * channels) as u64, stored.len() as u64);
        return Err(ImagesError::Truncated { path: path.into(), expected, found });
    }
    let (values, is_luminance) = grey(&stored[..samples * channels], channels);
    let contents = Contents::plain(vec![height as usize, width as usize], values, sample_type);
    Ok(Contents { is_luminance, ..contents })
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`nearest` lies in the range of the type")]
pub(crate) fn encode(path: &Path, contents: &Contents) -> Result<Vec<u8>, ImagesError> {
    let contents = contents.unscaled();
    let [height, width] = plane(path, &contents)?;
    let unwritable = |cause: TiffError| ImagesError::unwritable(path, &cause);
    let mut content = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut content).map_err(unwritable)?;
    let numbers = contents.values.iter().map(|value| contents.sample_type.nearest(*value));
    macro_rules! of {
        ($kind:ty, $numbers:expr) => {
            encoder.write_image::<$kind>(width, height, &$numbers.collect::<Vec<_>>())
        };
    }
    match contents.sample_type {
        SampleType::U8 => of!(colortype::Gray8, numbers.map(|number| number as u8)),
        SampleType::I8 => of!(colortype::GrayI8, numbers.map(|number| number as i8)),
        SampleType::U16 => of!(colortype::Gray16, numbers.map(|number| number as u16)),
        SampleType::I16 => of!(colortype::GrayI16, numbers.map(|number| number as i16)),
        SampleType::U32 => of!(colortype::Gray32, numbers.map(|number| number as u32)),
        SampleType::I32 => of!(colortype::GrayI32, numbers.map(|number| number as i32)),
        SampleType::F32 => of!(colortype::Gray32Float, numbers.map(single)),
        SampleType::F64 => of!(colortype::Gray64Float, numbers),
    }
    .map_err(unwritable)?;
    Ok(content.into_inner())
}
