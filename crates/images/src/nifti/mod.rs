//! NIfTI-1 in one file: `.nii` and `.nii.gz`.
//!
//! Its world is RAS (right, anterior, superior), ours is LPS: x and y change their signs. Extensions and the description are not kept.

mod forms;
mod write;

pub(crate) use write::encode;

use std::path::Path;

use ::nifti::{Endianness, NiftiHeader};

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::file;
use crate::forms::Forms;
use crate::sample_type::{Order, SampleType};

/// A header, without what follows it.
const HEADER: usize = 348;

/// Intent code of vectors, whose components ITK and ANTs take to be in LPS.
const VECTOR: i16 = 1007;

/// Intent code of displacement vectors, whose components are in RAS.
const DISPLACEMENT: i16 = 1006;

const TYPES: [(i16, SampleType); 8] = [
    (2, SampleType::U8),
    (4, SampleType::I16),
    (8, SampleType::I32),
    (16, SampleType::F32),
    (64, SampleType::F64),
    (256, SampleType::I8),
    (512, SampleType::U16),
    (768, SampleType::U32),
];

pub(crate) fn decode(path: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    let is_packed = file::is_gzip(content);
    let start = if is_packed { file::inflate(path, content, HEADER as u64)? } else { content.to_vec() };
    let header = header(path, &start)?;
    let [sizes, components] = sizes(path, &header)?;
    let samples = file::samples(path, &sizes.iter().chain(&components).copied().collect::<Vec<_>>())?;
    let Some((_, sample_type)) = TYPES.into_iter().find(|(code, _)| *code == header.datatype) else {
        let found = format!("samples of datatype {}", header.datatype);
        return Err(ImagesError::unsupported(
            path,
            found,
            "2 (u8), 4 (i16), 8 (i32), 16 (f32), 64 (f64), 256 (i8), 512 (u16), 768 (u32)",
        ));
    };
    let offset = offset(path, &header)?;
    let length = (samples * sample_type.bytes()) as u64;
    file::check_announced(path, offset + length, content.len(), is_packed)?;
    let unpacked = if is_packed { &file::inflate(path, content, offset + length)?[..] } else { content };
    file::check_announced(path, offset + length, unpacked.len(), false)?;
    let order = match header.endianness {
        Endianness::Little => Order::Little,
        Endianness::Big => Order::Big,
    };
    let bytes = usize::try_from(offset).ok().and_then(|offset| unpacked.get(offset..)).unwrap_or_default();
    let stored = sample_type.decode(&bytes[..samples * sample_type.bytes()], order);
    contents(path, &header, &sizes, stored, sample_type)
}

fn header(path: &Path, start: &[u8]) -> Result<NiftiHeader, ImagesError> {
    let malformed = |cause: String| ImagesError::malformed(path, "NIfTI", cause);
    let size: Option<[u8; 4]> = start.get(..4).and_then(|bytes| bytes.try_into().ok());
    if let Some(bytes) = size
        && (i32::from_le_bytes(bytes) == 540 || i32::from_be_bytes(bytes) == 540)
    {
        return Err(ImagesError::unsupported(path, "a header of NIfTI-2", "NIfTI-1"));
    }
    if start.len() < HEADER {
        let (expected, found) = (HEADER as u64, start.len() as u64);
        return Err(ImagesError::Truncated { path: path.into(), expected, found });
    }
    let header = NiftiHeader::from_reader(start).map_err(|cause| malformed(cause.to_string()))?;
    if header.sizeof_hdr != 348 {
        return Err(malformed(format!("the header says that it has {} bytes, not 348", header.sizeof_hdr)));
    }
    if &header.magic == b"ni1\0" {
        return Err(ImagesError::unsupported(path, "its samples in another file (.hdr and .img)", "one file (.nii)"));
    }
    Ok(header)
}

/// The sizes in the order of the file, without those of one at the end, and the number of components where it is a vector.
fn sizes(path: &Path, header: &NiftiHeader) -> Result<[Vec<u64>; 2], ImagesError> {
    let axes = usize::from(header.dim[0]);
    if !(1..=7).contains(&axes) {
        return Err(ImagesError::malformed(path, "NIfTI", format!("dim[0] = {axes}; 1 to 7 are valid")));
    }
    let mut sizes: Vec<u64> = header.dim[1..=axes].iter().map(|size| u64::from(*size)).collect();
    let mut components = Vec::new();
    if axes == 5 && sizes[3] == 1 && matches!(header.intent_code, VECTOR | DISPLACEMENT) {
        components.extend(sizes.pop());
    }
    while 2 < sizes.len() && sizes.last() == Some(&1) {
        sizes.pop();
    }
    if 3 < sizes.len() {
        return Err(ImagesError::Dimension { path: path.into(), found: sizes.len(), valid: "2 and 3 are valid" });
    }
    Ok([sizes, components])
}

fn offset(path: &Path, header: &NiftiHeader) -> Result<u64, ImagesError> {
    let offset = header.vox_offset;
    // Sixteen megabytes of extensions are more than any program writes; single precision is exact up to there.
    if !(348.0..=16_777_216.0).contains(&offset) || offset.fract() != 0.0 {
        let cause = format!("vox_offset = {offset}; a whole number from 348 to 16777216 is valid");
        return Err(ImagesError::malformed(path, "NIfTI", cause));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within bounds")]
    Ok(offset as u64)
}

fn contents(
    path: &Path,
    header: &NiftiHeader,
    sizes: &[u64],
    stored: Vec<f64>,
    sample_type: SampleType,
) -> Result<Contents, ImagesError> {
    let [slope, offset] = [header.scl_slope, header.scl_inter].map(f64::from);
    if !slope.is_finite() || !offset.is_finite() {
        let cause = format!("scl_slope = {slope}, scl_inter = {offset}; both must be finite");
        return Err(ImagesError::malformed(path, "NIfTI", cause));
    }
    let is_plain = slope == 0.0 || (slope.to_bits() == 1.0_f64.to_bits() && offset == 0.0);
    let scaling = (!is_plain).then_some([slope, offset]);
    let sizes: Vec<_> = sizes.iter().rev().map(|size| usize::try_from(*size).unwrap_or(usize::MAX)).collect();
    let count: usize = sizes.iter().product();
    let components = stored.len().checked_div(count).unwrap_or(1);
    let mut values = interleaved(stored, components);
    if let Some([slope, offset]) = scaling {
        for value in &mut values {
            *value = slope * *value + offset;
        }
    }
    if header.intent_code == DISPLACEMENT && 1 < components {
        for vector in values.chunks_exact_mut(components) {
            vector[0] = -vector[0];
            vector[1] = -vector[1];
        }
    }
    let contents = Contents::plain(sizes, values, sample_type);
    let axes = contents.sizes.len();
    let forms = Forms::of(header);
    let (origin, directions, spacing) = forms.placement(axes);
    Ok(Contents { components, origin, directions, spacing, scaling, forms: Some(forms), ..contents })
}

/// Numbers of a sample next to each other, from one component after the other.
fn interleaved(stored: Vec<f64>, components: usize) -> Vec<f64> {
    if components == 1 {
        return stored;
    }
    let count = stored.len() / components;
    (0..stored.len()).map(|position| stored[position % components * count + position / components]).collect()
}
