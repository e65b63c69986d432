//! The bytes of a NIfTI-1 file.

use std::path::Path;

use super::{HEADER, TYPES, VECTOR};
use crate::contents::Contents;
use crate::error::ImagesError;
use crate::forms::Forms;
use crate::sample_type::{Order, single};

/// The header, the four bytes that announce no extension, the samples; the least significant byte first.
pub(crate) fn encode(path: &Path, contents: &Contents) -> Result<Vec<u8>, ImagesError> {
    let mut header = [0; HEADER];
    let mut put = |at: usize, bytes: &[u8]| header[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, &348_i32.to_le_bytes());
    put(38, b"r");
    let mut dim = [1_i16; 8];
    let axes = contents.sizes.len();
    dim[0] = if axes == 2 { 2 } else { 3 };
    for (axis, &size) in contents.sizes.iter().rev().enumerate() {
        dim[axis + 1] = i16::try_from(size).map_err(|_| {
            let (quantity, found, most) = ("a side of", size as u128, 32_767);
            ImagesError::TooLarge { path: path.into(), quantity, found, most }
        })?;
    }
    if 1 < contents.components {
        dim[0] = 5;
        dim[5] = i16::try_from(contents.components).unwrap_or(i16::MAX);
        put(68, &VECTOR.to_le_bytes());
    }
    for (number, size) in dim.into_iter().enumerate() {
        put(40 + 2 * number, &size.to_le_bytes());
    }
    let code =
        TYPES.into_iter().find(|(_, sample_type)| *sample_type == contents.sample_type).map_or(0, |(code, _)| code);
    put(70, &code.to_le_bytes());
    let bits = i16::try_from(8 * contents.sample_type.bytes()).unwrap_or(0);
    put(72, &bits.to_le_bytes());
    let forms = contents.forms.unwrap_or_else(|| Forms::placing(contents));
    let pixdim = forms.pixdim.into_iter().chain([1.0; 4]);
    for (number, spacing) in pixdim.enumerate() {
        put(76 + 4 * number, &spacing.to_le_bytes());
    }
    put(108, &352_f32.to_le_bytes());
    let [slope, offset] = contents.scaling.unwrap_or([1.0, 0.0]).map(single);
    put(112, &slope.to_le_bytes());
    put(116, &offset.to_le_bytes());
    // Millimetres.
    put(123, &[2]);
    put(148, b"piola");
    put(252, &forms.qform_code.to_le_bytes());
    put(254, &forms.sform_code.to_le_bytes());
    let numbers = forms.quaternion.iter().chain(forms.rows.as_flattened());
    for (number, value) in numbers.enumerate() {
        put(256 + 4 * number, &value.to_le_bytes());
    }
    put(344, b"n+1\0");

    let mut content = header.to_vec();
    content.extend_from_slice(&[0; 4]);
    let (count, components) = (contents.sizes.iter().product::<usize>(), contents.components);
    let stored: Vec<f64> = contents.stored().collect();
    // One component after the other.
    let ordered = (0..stored.len()).map(|position| stored[position % count * components + position / count]);
    content.extend(contents.sample_type.encode(ordered, Order::Little));
    Ok(content)
}
