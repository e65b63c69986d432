//! Pictures: samples with their places in the world.

use std::path::Path;

use piola_numerics::Real;
use piola_registration::{Image, ImageGrid};

use crate::contents::{Contents, usual_directions};
use crate::error::ImagesError;
use crate::file;
use crate::format::{decode, decode_content, encode};
use crate::sample_type::SampleType;

/// The largest cosine of two axes that count as perpendicular: headers hold single precision.
const PERPENDICULAR: f64 = 1e-4;

/// Where the axes of a picture lie in the world.
///
/// ```text
/// x = origin + Σ_a i_a h_a d_a        i_a: index along axis a,  h_a: spacing
/// ```
/// | symbol | field | unit |
/// |---|---|---|
/// | x | – | mm, in the axes left, posterior, superior of a patient (LPS), as in ITK and DICOM |
/// | – | `origin`: centre of the first sample | mm |
/// | d | `directions`: unit vectors | – |
///
/// Axes are in the order of the memory: the last one varies fastest. A picture without a place in the world has its origin at zero, x along the
/// last axis and y along the one before.
///
/// # Example
/// ```
/// use piola_images::{Picture, SampleType};
/// let picture = Picture::new([2, 3], [0.5, 0.25], vec![0.0; 6], SampleType::U8)?;
/// assert_eq!(picture.placement().directions, [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
/// assert_eq!(picture.point([1.0, 2.0]), [0.5, 0.5, 0.0]);
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PicturePlacement<const D: usize> {
    /// The centre of the first sample, mm.
    pub origin: [f64; 3],
    /// Unit vectors along the axes.
    pub directions: [[f64; 3]; D],
}

/// A scalar picture in two or three dimensions, from a file or for one.
///
/// | symbol | method | shape | unit |
/// |---|---|---|---|
/// | – | `values` | n₀ n₁ (n₂), row-major: the last axis varies fastest | that of the intensity |
/// | h | `spacing` | D | mm where the file says a unit of length, else that of the file |
///
/// Files store their fastest axis first. The axes of a picture are therefore those of its file in reverse: `[z, y, x]`.
///
/// # Example
/// ```
/// use piola_images::{Picture, SampleType};
/// let path = std::env::temp_dir().join(format!("piola-picture-{}.nii.gz", std::process::id()));
/// let picture = Picture::new([2, 2, 3], [4.0, 2.0, 1.0], (0..12).map(f64::from).collect(), SampleType::I16)?;
/// picture.write(&path)?;
/// let again = Picture::<3>::read(&path)?;
/// assert_eq!((again.spacing(), again.values()), ([4.0, 2.0, 1.0], picture.values()));
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Picture<const D: usize> {
    contents: Contents,
}

/// A picture of as many dimensions as its file says.
///
/// # Example
/// ```
/// use piola_images::{AnyPicture, Picture, SampleType};
/// let path = std::env::temp_dir().join(format!("piola-any-{}.png", std::process::id()));
/// Picture::new([2, 2], [1.0; 2], vec![0.0, 50.0, 100.0, 150.0], SampleType::U8)?.write(&path)?;
/// assert!(matches!(AnyPicture::read(&path)?, AnyPicture::Plane(_)));
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum AnyPicture {
    /// Two dimensions.
    Plane(Picture<2>),
    /// Three dimensions.
    Space(Picture<3>),
}

impl AnyPicture {
    /// Reads a PNG, TIFF, NIfTI or NRRD file.
    ///
    /// # Errors
    /// [`ImagesError`], as [`Picture::read`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ImagesError> {
        let path = path.as_ref();
        Ok(Self::of_contents(scalar(path, decode(path)?)?))
    }

    /// Reads the content of a PNG, TIFF, NIfTI or NRRD file that is in memory. The end of `name` says the format, and errors name it.
    ///
    /// # Errors
    /// Those of [`read`](Self::read), but for [`ImagesError::Unreadable`].
    ///
    /// # Example
    /// ```
    /// use piola_images::AnyPicture;
    /// let content = b"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 2\nencoding: ascii\n\n1 2 3 4";
    /// let AnyPicture::Plane(picture) = AnyPicture::from_content("four.nrrd", content)? else { panic!("two dimensions") };
    /// assert_eq!(picture.values(), [1.0, 2.0, 3.0, 4.0]);
    /// # Ok::<(), piola_images::ImagesError>(())
    /// ```
    pub fn from_content(name: impl AsRef<Path>, content: &[u8]) -> Result<Self, ImagesError> {
        let name = name.as_ref();
        Ok(Self::of_contents(scalar(name, decode_content(name, content)?)?))
    }

    fn of_contents(contents: Contents) -> Self {
        if contents.sizes.len() == 2 { Self::Plane(Picture { contents }) } else { Self::Space(Picture { contents }) }
    }
}

/// Refuses vectors and what no picture has.
fn scalar(path: &Path, contents: Contents) -> Result<Contents, ImagesError> {
    if contents.components != 1 {
        let found = format!("{} numbers at each sample", contents.components);
        return Err(ImagesError::unsupported(path, found, "one number at each sample"));
    }
    contents.check(path)?;
    Ok(contents)
}

impl<const D: usize> Picture<D> {
    /// A picture of `values` in row-major order, with `spacing` in mm, that is stored as `sample_type`. Its origin is zero.
    ///
    /// # Errors
    /// [`ImagesError::Registration`] with the condition: D is 2 or 3, every size at least 2, every spacing positive and finite, one finite
    /// value for each sample.
    pub fn new(
        sizes: [usize; D],
        spacing: [f64; D],
        values: Vec<f64>,
        sample_type: SampleType,
    ) -> Result<Self, ImagesError> {
        let grid = ImageGrid::new(sizes, spacing)?;
        let values = Image::new(grid, values)?.into_values();
        let mut contents = Contents::plain(sizes.to_vec(), values, sample_type);
        contents.spacing = spacing.to_vec();
        Ok(Self { contents })
    }

    /// Reads a PNG, TIFF, NIfTI or NRRD file with this number of dimensions.
    ///
    /// # Errors
    /// [`ImagesError::Unreadable`], `UnknownFormat`, `Malformed`, `Truncated`, `Unsupported`, `TooLarge`, `Dimension`, `TooFewSamples`,
    /// `Spacing` or `NotFinite`, each with the path.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ImagesError> {
        let path = path.as_ref();
        let contents = scalar(path, decode(path)?)?;
        if contents.sizes.len() != D {
            let valid = if D == 2 { "2 are asked for" } else { "3 are asked for" };
            return Err(ImagesError::Dimension { path: path.into(), found: contents.sizes.len(), valid });
        }
        Ok(Self { contents })
    }

    /// Writes a PNG, TIFF, NIfTI or NRRD file, as the end of the name says, in one piece.
    ///
    /// Values are rounded to [`sample_type`](Self::sample_type), and clamped to its range. PNG holds only `U8` and `U16`; PNG and TIFF hold
    /// neither spacing nor placement.
    ///
    /// # Errors
    /// [`ImagesError::UnknownFormat`], `Unsupported`, `Dimension` or `Unwritable`.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ImagesError> {
        let path = path.as_ref();
        file::write(path, &encode(path, &self.contents)?)
    }

    /// The picture of other `values` on the same samples, with the same placement and sample type.
    ///
    /// # Errors
    /// [`ImagesError::Registration`] unless there is one finite value for each sample.
    pub fn with_values(&self, values: Vec<f64>) -> Result<Self, ImagesError> {
        let grid = ImageGrid::new(self.sizes(), self.spacing())?;
        let values = Image::new(grid, values)?.into_values();
        Ok(Self { contents: Contents { values, ..self.without_values() } })
    }

    /// The picture with another type of the stored samples, and without a scaling of them.
    #[must_use]
    pub fn with_sample_type(mut self, sample_type: SampleType) -> Self {
        self.contents.sample_type = sample_type;
        self.contents.scaling = None;
        self
    }

    /// The picture with another spacing, mm, for files that hold none.
    ///
    /// # Errors
    /// [`ImagesError::Registration`] unless every spacing is positive and finite.
    pub fn with_spacing(mut self, spacing: [f64; D]) -> Result<Self, ImagesError> {
        ImageGrid::new(self.sizes(), spacing)?;
        self.contents.spacing = spacing.to_vec();
        self.contents.forms = None;
        Ok(self)
    }

    /// The picture placed elsewhere. Directions become unit vectors.
    ///
    /// # Errors
    /// [`ImagesError::Registration`] where a number is not finite, or a direction has no length.
    pub fn with_placement(mut self, placement: PicturePlacement<D>) -> Result<Self, ImagesError> {
        let mut directions = placement.directions;
        for direction in &mut directions {
            let length = norm(*direction);
            // Refuses zero, infinity and NaN with the condition of a spacing.
            ImageGrid::new([2, 2], [length, length])?;
            *direction = direction.map(|component| component / length);
        }
        if let Some(index) = placement.origin.iter().position(|component| !component.is_finite()) {
            let value = placement.origin[index];
            return Err(piola_registration::RegistrationError::NotFinite { quantity: "origin", index, value }.into());
        }
        self.contents.origin = placement.origin;
        self.contents.directions = directions.to_vec();
        self.contents.forms = None;
        Ok(self)
    }

    /// The number of samples along each axis.
    #[must_use]
    pub fn sizes(&self) -> [usize; D] {
        std::array::from_fn(|axis| self.contents.sizes[axis])
    }

    /// The distance of neighbours along each axis, mm.
    #[must_use]
    pub fn spacing(&self) -> [f64; D] {
        std::array::from_fn(|axis| self.contents.spacing[axis])
    }

    /// The values in row-major order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.contents.values
    }

    /// The type of the samples in the file.
    #[must_use]
    pub fn sample_type(&self) -> SampleType {
        self.contents.sample_type
    }

    /// The file has colours; the values are their luminance, 0.2126 R + 0.7152 G + 0.0722 B of the stored numbers.
    #[must_use]
    pub fn is_luminance(&self) -> bool {
        self.contents.is_luminance
    }

    /// Where the picture lies.
    #[must_use]
    pub fn placement(&self) -> PicturePlacement<D> {
        PicturePlacement {
            origin: self.contents.origin,
            directions: std::array::from_fn(|axis| self.contents.directions[axis]),
        }
    }

    /// The point of the world at these indices, which may lie between samples, mm.
    #[must_use]
    pub fn point(&self, index: [f64; D]) -> [f64; 3] {
        let PicturePlacement { origin, directions } = self.placement();
        let spacing = self.spacing();
        std::array::from_fn(|component| {
            origin[component]
                + (0..D).map(|axis| index[axis] * spacing[axis] * directions[axis][component]).sum::<f64>()
        })
    }

    /// The largest distance between corresponding corners of two pictures, mm: zero where they lie in the same place.
    #[must_use]
    pub fn distance_of_corners(&self, other: &Self) -> f64 {
        let corner = |picture: &Self, corner: usize| {
            let sizes = picture.sizes();
            picture
                .point(std::array::from_fn(|axis| if corner >> axis & 1 == 1 { (sizes[axis] - 1) as f64 } else { 0.0 }))
        };
        (0..1 << D)
            .map(|number| {
                let (one, two) = (corner(self, number), corner(other, number));
                norm(std::array::from_fn(|component| one[component] - two[component]))
            })
            .fold(0.0, f64::max)
    }

    /// The image for a registration: the same samples on a grid whose coordinates begin at a corner of the box.
    ///
    /// # Errors
    /// [`ImagesError::NotPerpendicular`] where the axes are not perpendicular.
    ///
    /// # Example
    /// ```
    /// use piola_images::{Picture, SampleType};
    /// let picture = Picture::new([2, 3], [0.5, 0.25], vec![1.0; 6], SampleType::U8)?;
    /// let image = picture.to_image::<f32>()?;
    /// assert_eq!(image.grid().sides(), [1.0, 0.75]);
    /// # Ok::<(), piola_images::ImagesError>(())
    /// ```
    pub fn to_image<T: Real>(&self) -> Result<Image<D, T>, ImagesError> {
        self.check_perpendicular()?;
        let grid = ImageGrid::new(self.sizes(), self.spacing())?;
        Ok(Image::new(grid, self.contents.values.iter().map(|value| T::lit(*value)).collect())?)
    }

    /// The picture of the values of `image` on the samples of this one.
    ///
    /// # Errors
    /// [`ImagesError::UnequalSizes`] where the sizes differ.
    pub fn with_image<T: Real>(&self, image: &Image<D, T>) -> Result<Self, ImagesError> {
        self.check_sizes(image.grid())?;
        self.with_values(image.values().iter().map(|value| value.primal(0)).collect())
    }

    /// This picture on the samples of `other`: at each of them the value at the same point of the world, multilinear between samples.
    ///
    /// Outside this picture the values are those of its nearest point.
    ///
    /// # Errors
    /// [`ImagesError::NotPerpendicular`] where the axes of this picture are not perpendicular.
    pub fn resampled(&self, other: &Self) -> Result<Self, ImagesError> {
        use piola_registration::{ImageSampler, Interpolant};
        let image = self.to_image::<f64>()?;
        let sampler = ImageSampler::new(&image, Interpolant::Linear);
        let (own, spacing, sizes) = (self.placement(), self.spacing(), other.sizes());
        let mut values = Vec::with_capacity(other.values().len());
        for position in 0..other.values().len() {
            let mut rest = position;
            let mut index = [0.0; D];
            for axis in (0..D).rev() {
                index[axis] = (rest % sizes[axis]) as f64;
                rest /= sizes[axis];
            }
            let point = other.point(index);
            values.push(sampler.value(std::array::from_fn(|axis| {
                let along: f64 = (0..3)
                    .map(|component| (point[component] - own.origin[component]) * own.directions[axis][component])
                    .sum();
                along + 0.5 * spacing[axis]
            })));
        }
        let kept = Self { contents: Contents { sample_type: self.contents.sample_type, ..other.without_values() } };
        let mut picture = kept.with_values(values)?;
        picture.contents.scaling = self.contents.scaling;
        Ok(picture)
    }

    pub(crate) fn check_perpendicular(&self) -> Result<(), ImagesError> {
        let directions = &self.contents.directions;
        for (a, b) in [(0, 1), (0, 2), (1, 2)].into_iter().filter(|&(_, b)| b < D) {
            let cosine: f64 = (0..3).map(|component| directions[a][component] * directions[b][component]).sum();
            if PERPENDICULAR < cosine.abs() {
                return Err(ImagesError::NotPerpendicular { axes: [a, b], cosine });
            }
        }
        Ok(())
    }

    pub(crate) fn check_sizes(&self, grid: &ImageGrid<D>) -> Result<(), ImagesError> {
        let (found, expected) = (grid.sizes(), self.sizes());
        match (0..D).find(|&axis| found[axis] != expected[axis]) {
            Some(axis) => Err(ImagesError::UnequalSizes { axis, found: found[axis], expected: expected[axis] }),
            None => Ok(()),
        }
    }

    /// Everything but the values.
    pub(crate) fn without_values(&self) -> Contents {
        let Contents {
            sizes,
            components,
            values: _,
            spacing,
            origin,
            directions,
            sample_type,
            scaling,
            forms,
            is_luminance,
        } = &self.contents;
        Contents {
            sizes: sizes.clone(),
            components: *components,
            values: Vec::new(),
            spacing: spacing.clone(),
            origin: *origin,
            directions: directions.clone(),
            sample_type: *sample_type,
            scaling: *scaling,
            forms: *forms,
            is_luminance: *is_luminance,
        }
    }

    /// A picture of checked contents, which have D axes.
    pub(crate) fn of_contents(contents: Contents) -> Self {
        Self { contents }
    }
}

impl<const D: usize> Default for PicturePlacement<D> {
    fn default() -> Self {
        let directions = usual_directions(D);
        Self { origin: [0.0; 3], directions: std::array::from_fn(|axis| directions[axis]) }
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
