//! The text of a file.

use std::io::Read as _;
use std::path::Path;

use crate::MeasuredError;

/// A table with more bytes than this is refused (64 MiB).
const LARGEST: u64 = 64 << 20;

/// The text of a file: UTF-8, UTF-16 with its mark, or letters and signs of Windows-1252, as spreadsheets write them.
///
/// # Errors
/// Files that cannot be read, are too large, or are no text.
pub fn read(path: &Path) -> Result<String, MeasuredError> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        .map_err(|cause| MeasuredError::Unreadable { path: path.to_path_buf(), cause: cause.to_string() })?;
    if LARGEST < bytes.len() as u64 {
        return Err(MeasuredError::TooLarge { path: path.to_path_buf(), bytes: bytes.len() as u64, most: LARGEST });
    }
    if let Some(text) = of_two_bytes(&bytes) {
        return Ok(text);
    }
    String::from_utf8(bytes).or_else(|error| {
        let good = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        if let Some(text) = of_one_byte(bytes) {
            return Ok(text);
        }
        let before = &bytes[..good];
        let line = before.split(|byte| *byte == b'\n').count();
        let column = 1 + before.iter().rev().take_while(|byte| **byte != b'\n').count();
        Err(MeasuredError::NotText { path: path.to_path_buf(), line, column, byte: bytes[good] })
    })
}

/// UTF-16 after its byte-order mark.
fn of_two_bytes(bytes: &[u8]) -> Option<String> {
    let (mark, units) = bytes.split_at_checked(2)?;
    let unit: fn([u8; 2]) -> u16 = match mark {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let units: Vec<u16> = units.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
    String::from_utf16(&units).ok()
}

/// Windows-1252 whose bytes beyond ASCII are the signs ° ² ³ µ · or letters with accents.
fn of_one_byte(bytes: &[u8]) -> Option<String> {
    let is_sign = |byte: &u8| matches!(byte, 0xb0 | 0xb2 | 0xb3 | 0xb5 | 0xb7 | 0xc0..=0xfe);
    bytes.iter().all(|byte| byte.is_ascii() || is_sign(byte)).then(|| bytes.iter().copied().map(char::from).collect())
}
