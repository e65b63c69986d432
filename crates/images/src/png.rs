//! PNG: one or two bytes a sample; colours become their luminance.

use std::io::Cursor;
use std::path::Path;

use ::png::{BitDepth, ColorType, Decoder, Encoder, Limits, Transformations};

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::file;
use crate::luminance::grey;
use crate::sample_type::{Order, SampleType};

pub(crate) fn decode(path: &Path, content: &[u8]) -> Result<Contents, ImagesError> {
    let malformed = |cause: ::png::DecodingError| ImagesError::malformed(path, "PNG", cause.to_string());
    let mut decoder = Decoder::new_with_limits(Cursor::new(content), Limits { bytes: 64 << 20 });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info().map_err(malformed)?;
    let (width, height) = (header.width, header.height);
    let samples = file::samples(path, &[u64::from(width), u64::from(height)])?;
    let announced = header.raw_bytes().saturating_sub(height as usize) as u64;
    file::check_announced(path, announced, content.len(), true)?;
    let mut reader = decoder.read_info().map_err(malformed)?;
    let (colour, depth) = reader.output_color_type();
    let (channels, sample_type) =
        (colour.samples(), if depth == BitDepth::Sixteen { SampleType::U16 } else { SampleType::U8 });
    let mut buffer = vec![0; samples * channels * sample_type.bytes()];
    reader.next_frame(&mut buffer).map_err(malformed)?;
    let stored = sample_type.decode(&buffer, Order::Big);
    let (values, is_luminance) = grey(&stored, channels);
    let contents = Contents::plain(vec![height as usize, width as usize], values, sample_type);
    Ok(Contents { is_luminance, ..contents })
}

pub(crate) fn encode(path: &Path, contents: &Contents) -> Result<Vec<u8>, ImagesError> {
    let contents = contents.unscaled();
    let depth = match contents.sample_type {
        SampleType::U8 => BitDepth::Eight,
        SampleType::U16 => BitDepth::Sixteen,
        other => {
            return Err(ImagesError::unsupported(
                path,
                format!("samples of type {other:?}"),
                "U8 and U16 in PNG files",
            ));
        }
    };
    let [height, width] = plane(path, &contents)?;
    let samples = contents.sample_type.encode(contents.values.iter().copied(), Order::Big);
    pack(width, height, ColorType::Grayscale, depth, &samples).map_err(|cause| ImagesError::unwritable(path, &cause))
}

/// Height and width of a picture in two dimensions.
pub(crate) fn plane(path: &Path, contents: &Contents) -> Result<[u32; 2], ImagesError> {
    let [height, width] = contents.sizes[..] else {
        let valid = "files of this format hold 2";
        return Err(ImagesError::Dimension { path: path.into(), found: contents.sizes.len(), valid });
    };
    let side = |size: usize| {
        u32::try_from(size).map_err(|_| {
            let (quantity, found) = ("a side of", size as u128);
            ImagesError::TooLarge { path: path.into(), quantity, found, most: u64::from(u32::MAX) }
        })
    };
    Ok([side(height)?, side(width)?])
}

fn pack(
    width: u32,
    height: u32,
    colour: ColorType,
    depth: BitDepth,
    samples: &[u8],
) -> Result<Vec<u8>, ::png::EncodingError> {
    let mut content = Vec::new();
    let mut encoder = Encoder::new(&mut content, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()?;
    Ok(content)
}

/// A drawing in colours: rows of red, green and blue.
///
/// # Example
/// ```
/// use piola_images::Bitmap;
/// let bitmap = Bitmap::from_fn(4, 2, |row, column| if row == column { [255, 0, 0] } else { [255; 3] });
/// assert_eq!(bitmap.pixels[5], [255, 0, 0]);
/// assert!(bitmap.to_png()?.starts_with(b"\x89PNG"));
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bitmap {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue, row by row.
    pub pixels: Vec<[u8; 3]>,
}

impl Bitmap {
    /// The bitmap of a function of row and column.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 3]) -> Self {
        let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
        Self { width, height, pixels: pixels.map(|(row, column)| colour(row, column)).collect() }
    }

    /// The content of a PNG file.
    ///
    /// # Errors
    /// [`ImagesError::Unwritable`] unless there are width × height > 0 pixels.
    pub fn to_png(&self) -> Result<Vec<u8>, ImagesError> {
        pack(self.width, self.height, ColorType::Rgb, BitDepth::Eight, self.pixels.as_flattened())
            .map_err(|cause| ImagesError::unwritable(Path::new("bitmap.png"), &cause))
    }

    /// Writes a PNG file in one piece.
    ///
    /// # Errors
    /// [`ImagesError::Unwritable`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ImagesError> {
        file::write(path.as_ref(), &self.to_png()?)
    }
}
