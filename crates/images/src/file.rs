//! Whole files: read within limits, written beside their place and then moved there.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;

use crate::error::ImagesError;

/// The most samples of a picture that are read: 645 along each side of a cube; 2 GiB in double precision.
pub const MOST_SAMPLES: u64 = 1 << 28;

/// The most bytes of a file: eight for each of the most samples and three components, with room for a header.
const MOST_BYTES: u64 = 24 * MOST_SAMPLES + (1 << 20);

/// The most bytes that one byte of deflated data can stand for.
const DEFLATE_RATIO: u64 = 1032;

/// The content of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, ImagesError> {
    let unreadable = |cause| ImagesError::unreadable(path, &cause);
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let about = file.metadata().map_err(unreadable)?;
    if !about.is_file() {
        return Err(ImagesError::Unreadable { path: path.into(), cause: "not a file".into() });
    }
    if MOST_BYTES < about.len() {
        let (quantity, found) = ("a length in bytes of", u128::from(about.len()));
        return Err(ImagesError::TooLarge { path: path.into(), quantity, found, most: MOST_BYTES });
    }
    let mut content = Vec::new();
    // A file that grows meanwhile is read only so far.
    file.take(MOST_BYTES).read_to_end(&mut content).map_err(unreadable)?;
    Ok(content)
}

/// Writes a file in one piece: another program sees the old one or the new one, and an error leaves nothing behind.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<(), ImagesError> {
    let temporary = beside(path);
    let write = || {
        let mut file = std::fs::File::create(&temporary)?;
        file.write_all(content)?;
        file.sync_all()?;
        drop(file);
        std::fs::rename(&temporary, path)
    };
    write().map_err(|cause: std::io::Error| {
        // Nothing more can be done about a temporary file that cannot be removed.
        let _ = std::fs::remove_file(&temporary);
        ImagesError::unwritable(path, &cause)
    })
}

/// Writes a file in one piece: another program sees the old one or the new one, and an error leaves nothing behind.
///
/// # Errors
/// [`ImagesError::Unwritable`].
///
/// # Example
/// ```
/// let path = std::env::temp_dir().join(format!("piola-whole-{}.txt", std::process::id()));
/// piola_images::write_whole(&path, b"text")?;
/// assert_eq!(std::fs::read(&path).unwrap_or_default(), b"text");
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
pub fn write_whole(path: impl AsRef<Path>, content: &[u8]) -> Result<(), ImagesError> {
    write(path.as_ref(), content)
}

/// A name in the same folder that no other write uses.
fn beside(path: &Path) -> PathBuf {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    path.with_file_name(format!(".{name}.{}.{count}.tmp", std::process::id()))
}

pub(crate) fn is_gzip(content: &[u8]) -> bool {
    content.starts_with(&[0x1f, 0x8b])
}

/// The first `length` bytes that compressed data stand for, or fewer where they end before.
///
/// Memory grows with what is decoded, not with `length`.
pub(crate) fn inflate(path: &Path, packed: &[u8], length: u64) -> Result<Vec<u8>, ImagesError> {
    let mut content = Vec::new();
    match MultiGzDecoder::new(packed).take(length).read_to_end(&mut content) {
        Ok(_) => Ok(content),
        // What was decoded before the end is judged by its length.
        Err(cause) if cause.kind() == std::io::ErrorKind::UnexpectedEof => Ok(content),
        Err(cause) => Err(ImagesError::malformed(path, "gzip", cause.to_string())),
    }
}

pub(crate) fn deflate(path: &Path, content: &[u8]) -> Result<Vec<u8>, ImagesError> {
    let unwritable = |cause: std::io::Error| ImagesError::unwritable(path, &cause);
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content).map_err(unwritable)?;
    encoder.finish().map_err(unwritable)
}

/// The number of samples of sizes from a header.
pub(crate) fn samples(path: &Path, sizes: &[u64]) -> Result<usize, ImagesError> {
    let mut total = 1_u128;
    for &size in sizes {
        total = total.saturating_mul(u128::from(size));
    }
    // Sizes may be zero beside huge ones: each is bounded too.
    let largest = sizes.iter().copied().max().unwrap_or(0);
    let found = total.max(u128::from(largest));
    match usize::try_from(found) {
        Ok(_) if found <= u128::from(MOST_SAMPLES) => Ok(usize::try_from(total).unwrap_or(0)),
        _ => Err(ImagesError::TooLarge { path: path.into(), quantity: "samples:", found, most: MOST_SAMPLES }),
    }
}

/// Refuses a header that announces more bytes than the file can hold, before anything is allocated for them.
pub(crate) fn check_announced(path: &Path, expected: u64, held: usize, is_packed: bool) -> Result<(), ImagesError> {
    let held = held as u64;
    let found = if is_packed { held.saturating_mul(DEFLATE_RATIO) } else { held };
    if expected <= found { Ok(()) } else { Err(ImagesError::Truncated { path: path.into(), expected, found }) }
}
