//! Slices of pictures, colours and a drawing in SVG.

use core::fmt::Write as _;

use piola_images::{Bitmap, ImagesError, Picture};

/// A plane of samples as it is shown: which axes run down and to the right.
pub(super) struct Slice<const D: usize> {
    sizes: [usize; D],
    /// The axes that run down and to the right.
    pub(super) axes: [usize; 2],
    is_mirrored: [bool; 2],
    /// The indices of the middle of the picture.
    middle: [usize; D],
    /// The extent down and to the right, mm.
    pub(super) extent: [f64; 2],
    pub(super) title: String,
}

impl<const D: usize> Slice<D> {
    /// The plane of a picture, or its three middle planes.
    pub(super) fn all(picture: &Picture<D>) -> Vec<Self> {
        let (sizes, spacing) = (picture.sizes(), picture.spacing());
        let directions = picture.placement().directions;
        let pairs = [[D - 2, D - 1], [0, D - 1], [0, 1]];
        let planes = if D == 2 { 1 } else { 3 };
        let middle = sizes.map(|size| size / 2);
        let slice = |axes: [usize; 2]| {
            let dominant = axes.map(|axis| {
                let direction = directions[axis];
                (0..3).fold(0, |best, next| if direction[best].abs() < direction[next].abs() { next } else { best })
            });
            let is_negative = [0, 1].map(|side| directions[axes[side]][dominant[side]] < 0.0);
            // Shown as radiologists do: superior or anterior up, the patient's left on the right.
            let is_mirrored = [if dominant[0] == 2 { !is_negative[0] } else { is_negative[0] }, is_negative[1]];
            let normal = (0..D).find(|axis| !axes.contains(axis));
            let title = normal.map_or(String::new(), |axis| {
                format!("middle slice {} of {} along axis {axis}", middle[axis] + 1, sizes[axis])
            });
            let extent = axes.map(|axis| sizes[axis] as f64 * spacing[axis]);
            Self { sizes, axes, is_mirrored, middle, extent, title }
        };
        pairs[..planes].iter().map(|axes| slice(*axes)).collect()
    }

    /// Samples down and to the right.
    pub(super) fn shape(&self) -> [usize; 2] {
        self.axes.map(|axis| self.sizes[axis])
    }

    /// Where the sample of this row and column is stored.
    pub(super) fn position(&self, shown: [usize; 2]) -> usize {
        let mut index = self.middle;
        for side in 0..2 {
            let size = self.sizes[self.axes[side]];
            index[self.axes[side]] = if self.is_mirrored[side] { size - 1 - shown[side] } else { shown[side] };
        }
        index.iter().zip(self.sizes).fold(0, |position, (index, size)| position * size + index)
    }

    /// The signs of displacements down and to the right.
    pub(super) fn signs(&self) -> [f64; 2] {
        self.is_mirrored.map(|is_mirrored| if is_mirrored { -1.0 } else { 1.0 })
    }

    /// The bitmap of a colour for each stored sample.
    pub(super) fn bitmap(&self, colour: impl Fn(usize) -> [u8; 3]) -> Bitmap {
        let [height, width] = self.shape();
        let side = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
        Bitmap::from_fn(side(width), side(height), |row, column| colour(self.position([row as usize, column as usize])))
    }
}

/// A bitmap enlarged to about `width` pixels, with the proportions of the extent.
pub(super) fn enlarged(bitmap: &Bitmap, extent: [f64; 2], width: u32) -> Bitmap {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to some pixels")]
    let height = (f64::from(width) * extent[0] / extent[1]).clamp(1.0, 4.0 * f64::from(width)).round() as u32;
    Bitmap::from_fn(width, height, |row, column| {
        let source = |at: u32, of: u32, size: u32| at as usize * size as usize / of as usize;
        let (row, column) = (source(row, height, bitmap.height), source(column, width, bitmap.width));
        bitmap.pixels[row * bitmap.width as usize + column]
    })
}

/// A colour between those of the stops, for 0 ≤ share ≤ 1.
pub(super) fn between(stops: &[[u8; 3]], share: f64) -> [u8; 3] {
    let last = stops.len() - 1;
    let at = share.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the number of stops")]
    let cell = (at as usize).min(last.saturating_sub(1));
    let part = at - cell as f64;
    let next = stops[(cell + 1).min(last)];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
    std::array::from_fn(|channel| {
        (f64::from(stops[cell][channel]) * (1.0 - part) + f64::from(next[channel]) * part).round() as u8
    })
}

/// Elements of a drawing.
pub(super) struct Svg {
    body: String,
}

impl Svg {
    pub(super) fn new() -> Self {
        Self { body: String::new() }
    }

    /// Text whose anchor is `start`, `middle` or `end`.
    pub(super) fn text(&mut self, at: [f64; 2], size: f64, anchor: &str, text: &str) {
        let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(
            self.body,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\">{escaped}</text>",
            at[0], at[1]
        );
    }

    /// A bitmap in a frame.
    pub(super) fn bitmap(&mut self, corner: [f64; 2], size: [f64; 2], bitmap: &Bitmap) -> Result<(), ImagesError> {
        let data = base64(&bitmap.to_png()?);
        let place =
            format!("x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"", corner[0], corner[1], size[0], size[1]);
        let _ = writeln!(
            self.body,
            "<image {place} preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{data}\"/>\n<rect {place} fill=\"none\" stroke=\"#999\" stroke-width=\"0.5\"/>"
        );
        Ok(())
    }

    pub(super) fn line(&mut self, points: &[[f64; 2]]) {
        let texts: Vec<_> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
        let _ = writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#0b5394\" stroke-width=\"0.7\"/>",
            texts.join(" ")
        );
    }

    pub(super) fn finish(self, width: f64, height: f64) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" fill=\"#222\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{}</svg>\n",
            self.body
        )
    }
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let number = (0..3).fold(0_u32, |number, at| number << 8 | u32::from(group.get(at).copied().unwrap_or(0)));
        for letter in 0..4 {
            let index = (number >> (18 - 6 * letter) & 63) as usize;
            text.push(if letter <= group.len() { char::from(LETTERS[index]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{base64, between};

    #[test]
    fn base64_of_the_standard_examples() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn colours_between_stops() {
        let stops = [[0, 0, 0], [100, 200, 50], [255; 3]];
        assert_eq!(
            [0.0, 0.25, 0.5, 2.0].map(|share| between(&stops, share)),
            [[0; 3], [50, 100, 25], stops[1], [255; 3]]
        );
    }
}
