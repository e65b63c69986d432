//! What a file holds, before its number of axes is a type.

use std::path::Path;

use crate::error::ImagesError;
use crate::forms::Forms;
use crate::sample_type::SampleType;

/// Samples with their places. Axes are in the order of the memory, the last one fastest: the reverse of the order of the files.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contents {
    pub(crate) sizes: Vec<usize>,
    /// Numbers at each sample, next to each other.
    pub(crate) components: usize,
    /// Intensities: any scaling of the file is applied.
    pub(crate) values: Vec<f64>,
    /// mm.
    pub(crate) spacing: Vec<f64>,
    /// The centre of the first sample, in LPS, mm.
    pub(crate) origin: [f64; 3],
    /// Unit vectors along the axes, in LPS.
    pub(crate) directions: Vec<[f64; 3]>,
    pub(crate) sample_type: SampleType,
    /// Slope and offset: value = slope × stored + offset.
    pub(crate) scaling: Option<[f64; 2]>,
    /// The two placements of a NIfTI header, as they stood there.
    pub(crate) forms: Option<Forms>,
    pub(crate) is_luminance: bool,
}

/// Rows downwards, columns to the right: x along the last axis, y along the one before.
pub(crate) fn usual_directions(axes: usize) -> Vec<[f64; 3]> {
    (0..axes).rev().map(|axis| std::array::from_fn(|component| if component == axis { 1.0 } else { 0.0 })).collect()
}

impl Contents {
    /// Samples without a stated place: spacing 1.
    pub(crate) fn plain(sizes: Vec<usize>, values: Vec<f64>, sample_type: SampleType) -> Self {
        let axes = sizes.len();
        Self {
            sizes,
            components: 1,
            values,
            spacing: vec![1.0; axes],
            origin: [0.0; 3],
            directions: usual_directions(axes),
            sample_type,
            scaling: None,
            forms: None,
            is_luminance: false,
        }
    }

    /// Refuses what no picture has.
    pub(crate) fn check(&self, path: &Path) -> Result<(), ImagesError> {
        let path = || path.to_path_buf();
        let axes = self.sizes.len();
        if axes != 2 && axes != 3 {
            return Err(ImagesError::Dimension { path: path(), found: axes, valid: "2 and 3 are valid" });
        }
        for (axis, (&found, &value)) in self.sizes.iter().zip(&self.spacing).rev().enumerate() {
            if found < 2 {
                return Err(ImagesError::TooFewSamples { path: path(), axis, found });
            }
            if !(value.is_finite() && 0.0 < value) {
                return Err(ImagesError::Spacing { path: path(), axis, value });
            }
        }
        let places = [("origin", &self.origin[..]), ("direction", self.directions.as_flattened())];
        for (quantity, numbers) in places.into_iter().chain([("value", &self.values[..])]) {
            if let Some(index) = numbers.iter().position(|number| !number.is_finite()) {
                return Err(ImagesError::NotFinite { path: path(), quantity, index, value: numbers[index] });
            }
        }
        Ok(())
    }

    /// The numbers as they are stored.
    pub(crate) fn stored(&self) -> impl Iterator<Item = f64> {
        self.values.iter().map(|value| match self.scaling {
            None => *value,
            Some([slope, offset]) => (value - offset) / slope,
        })
    }

    /// The same for formats that have no scaling: scaled whole numbers become single precision.
    pub(crate) fn unscaled(&self) -> Self {
        let mut plain = self.clone();
        if plain.scaling.take().is_some() && self.sample_type != SampleType::F64 {
            plain.sample_type = SampleType::F32;
        }
        plain
    }
}
