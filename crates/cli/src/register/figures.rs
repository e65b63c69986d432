//! Figures: the images before and after, their differences, the deformed grid, the Jacobian.

use piola_images::{Bitmap, ImagesError, Picture};
use piola_registration::{DisplacementMap, Image, Precision};

use super::drawing::{Slice, Svg, between, enlarged};

const BLUE_TO_RED: [[u8; 3]; 3] = [[24, 79, 163], [255, 255, 255], [176, 24, 40]];
const LIGHT_TO_DARK: [[u8; 3]; 4] = [[252, 244, 205], [238, 120, 88], [128, 42, 130], [20, 12, 70]];

/// Width of a panel in the drawing, and of a figure in pixels.
const PANEL: f64 = 250.0;
const PIXELS: u32 = 480;
const GAP: f64 = 18.0;
/// Room for the title above a panel, and for the colours below it.
const TITLE: f64 = 20.0;
const LEGEND: f64 = 34.0;
/// Lines of the grid along the longer side.
const LINES: f64 = 24.0;

/// Values at the samples, by what is shown.
pub(super) struct Figures<'r, const D: usize> {
    picture: &'r Picture<D>,
    /// Fixed, moving and warped, as shares of the range of their intensities.
    shares: [Vec<f64>; 3],
    jacobian: Vec<f64>,
    displacement: Vec<[f64; D]>,
    /// From a point of the moving image to where it appears.
    inverse: Option<Vec<[f64; D]>>,
}

/// A bitmap with its title and, where colours mean numbers, their legend.
struct Panel {
    title: &'static str,
    bitmap: Bitmap,
    legend: Option<(Bitmap, [String; 3])>,
}

impl<'r, const D: usize> Figures<'r, D> {
    pub(super) fn of<T: Precision>(
        pictures: &'r [Picture<D>; 2],
        warped: &Image<D, T>,
        map: &DisplacementMap<D, T>,
        inverse: Option<&DisplacementMap<D, T>>,
    ) -> Self {
        let numbers = |image: &Image<D, T>| image.values().iter().map(|value| value.primal(0)).collect::<Vec<_>>();
        let vectors =
            |map: &DisplacementMap<D, T>| map.displacements().iter().map(|u| u.map(|part| part.primal(0))).collect();
        let moving_range = range(pictures[1].values());
        let share = |values: &[f64], [least, greatest]: [f64; 2]| {
            values.iter().map(|value| (value - least) / (greatest - least)).collect()
        };
        let shares = [
            share(pictures[0].values(), range(pictures[0].values())),
            share(pictures[1].values(), moving_range),
            share(&numbers(warped), moving_range),
        ];
        let jacobian = numbers(&map.jacobian());
        Self { picture: &pictures[0], shares, jacobian, displacement: vectors(map), inverse: inverse.map(vectors) }
    }

    /// The files by their names: the whole drawing, and single figures.
    pub(super) fn files(&self) -> Vec<(String, Result<Vec<u8>, ImagesError>)> {
        let slices = Slice::all(self.picture);
        let mut files = vec![("registration.svg".to_owned(), self.drawing(&slices).map(String::into_bytes))];
        for (number, name) in [(1, "before"), (5, "after"), (6, "difference"), (3, "jacobian")] {
            let shown: Vec<_> =
                slices.iter().map(|slice| enlarged(&self.panels(slice)[number].bitmap, slice.extent, PIXELS)).collect();
            files.push((format!("{name}.png"), beside(&shown).to_png()));
        }
        files
    }

    /// Two rows of four panels for each slice.
    fn panels(&self, slice: &Slice<D>) -> [Panel; 8] {
        let [fixed, moving, warped] = &self.shares;
        let grey = |title, shares: &[f64]| {
            let bitmap = slice.bitmap(|position| between(&[[0; 3], [255; 3]], shares[position]));
            Panel { title, bitmap, legend: None }
        };
        let difference = |title, other: &[f64]| {
            let bitmap =
                slice.bitmap(|position| between(&BLUE_TO_RED, 0.5 + 0.5 * (fixed[position] - other[position])));
            let ends = ["-100 %".into(), "0".into(), "+100 %".into()];
            Panel { title, bitmap, legend: Some((bar(&BLUE_TO_RED), ends)) }
        };
        let logarithm = |value: f64| value.max(1e-6).log2();
        let widest = self.jacobian.iter().map(|value| logarithm(*value).abs()).fold(0.1, f64::max).min(4.0);
        let jacobian =
            slice.bitmap(|position| between(&BLUE_TO_RED, 0.5 + 0.5 * logarithm(self.jacobian[position]) / widest));
        let ends = [format!("{:.2}", (-widest).exp2()), "1".into(), format!("{:.2}", widest.exp2())];
        let length = |vector: &[f64; D]| vector.iter().map(|part| part * part).sum::<f64>().sqrt();
        let longest = self.displacement.iter().map(length).fold(f64::MIN_POSITIVE, f64::max);
        let lengths = slice.bitmap(|position| between(&LIGHT_TO_DARK, length(&self.displacement[position]) / longest));
        let bounds = ["0".into(), String::new(), format!("{longest:.2} mm")];
        let pale = slice.bitmap(|position| between(&[[190; 3], [255; 3]], warped[position]));
        [
            grey("fixed", fixed),
            grey("moving", moving),
            difference("fixed - moving, of the range", moving),
            Panel { title: "Jacobian of the map", bitmap: jacobian, legend: Some((bar(&BLUE_TO_RED), ends)) },
            Panel { title: "grid of the moving image, deformed", bitmap: pale, legend: None },
            grey("moving, warped", warped),
            difference("fixed - warped, of the range", warped),
            Panel { title: "displacement", bitmap: lengths, legend: Some((bar(&LIGHT_TO_DARK), bounds)) },
        ]
    }

    fn drawing(&self, slices: &[Slice<D>]) -> Result<String, ImagesError> {
        let mut svg = Svg::new();
        let mut top = GAP;
        for slice in slices {
            let size = [PANEL, (PANEL * slice.extent[0] / slice.extent[1]).clamp(20.0, 3.0 * PANEL)];
            if !slice.title.is_empty() {
                svg.text([GAP, top + 6.0], 15.0, "start", &slice.title);
                top += TITLE;
            }
            for (number, panel) in self.panels(slice).iter().enumerate() {
                let column = (number % 4) as f64;
                let row = (number / 4) as f64;
                let corner = [GAP + column * (PANEL + GAP), top + TITLE + row * (TITLE + size[1] + LEGEND)];
                svg.text([corner[0], corner[1] - 6.0], 13.0, "start", panel.title);
                svg.bitmap(corner, size, &panel.bitmap)?;
                if number == 4 {
                    self.grid(&mut svg, slice, corner, size);
                }
                if let Some((bar, [least, middle, greatest])) = &panel.legend {
                    let below = corner[1] + size[1];
                    svg.bitmap([corner[0], below + 4.0], [PANEL, 8.0], bar)?;
                    svg.text([corner[0], below + 24.0], 11.0, "start", least);
                    svg.text([corner[0] + 0.5 * PANEL, below + 24.0], 11.0, "middle", middle);
                    svg.text([corner[0] + PANEL, below + 24.0], 11.0, "end", greatest);
                }
            }
            top += 2.0 * (TITLE + size[1] + LEGEND) + GAP;
        }
        Ok(svg.finish(GAP + 4.0 * (PANEL + GAP), top))
    }

    /// Where the lines of a square grid on the moving image appear; without an inverse, where those of the fixed image come from.
    fn grid(&self, svg: &mut Svg, slice: &Slice<D>, corner: [f64; 2], size: [f64; 2]) {
        let vectors = self.inverse.as_ref().unwrap_or(&self.displacement);
        let shape = slice.shape();
        let signs = slice.signs();
        let point = |shown: [usize; 2]| {
            let u = vectors[slice.position(shown)];
            let at = [0, 1].map(|side| {
                let share = (shown[side] as f64 + 0.5) / shape[side] as f64;
                let moved = share - signs[side] * u[slice.axes[side]] / slice.extent[side];
                corner[1 - side] + size[1 - side] * moved
            });
            [at[1], at[0]]
        };
        let distance = slice.extent[0].max(slice.extent[1]) / LINES;
        for side in 0..2 {
            let other = 1 - side;
            let spacing = slice.extent[side] / shape[side] as f64;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some samples")]
            let step = (distance / spacing).round().max(1.0) as usize;
            for line in (step / 2..shape[side]).step_by(step) {
                let points: Vec<_> = (0..shape[other])
                    .map(|along| if side == 0 { point([line, along]) } else { point([along, line]) })
                    .collect();
                svg.line(&points);
            }
        }
    }
}

/// The intensities between which all but one in two hundred lie, at each end.
fn range(values: &[f64]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    let [least, greatest] = [sorted[last / 200], sorted[last - last / 200]];
    // Where nearly all samples are equal, the whole range counts.
    if least < greatest { [least, greatest] } else { [sorted[0], sorted[last]] }
}

fn bar(stops: &[[u8; 3]]) -> Bitmap {
    Bitmap::from_fn(128, 1, |_, column| between(stops, f64::from(column) / 127.0))
}

/// Bitmaps of equal width beside each other, on white.
fn beside(bitmaps: &[Bitmap]) -> Bitmap {
    let height = bitmaps.iter().map(|bitmap| bitmap.height).max().unwrap_or(1);
    let count = u32::try_from(bitmaps.len()).unwrap_or(1);
    let pace = PIXELS + 8;
    Bitmap::from_fn(count * pace - 8, height, |row, column| {
        let bitmap = &bitmaps[(column / pace) as usize];
        let within = column % pace;
        if row < bitmap.height && within < bitmap.width {
            bitmap.pixels[(row * bitmap.width + within) as usize]
        } else {
            [255; 3]
        }
    })
}
