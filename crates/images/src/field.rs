//! Displacement fields in files.

use std::path::Path;

use piola_numerics::Real;
use piola_registration::{DisplacementMap, ImageGrid};

use crate::contents::Contents;
use crate::error::ImagesError;
use crate::file;
use crate::format::{Format, decode, decode_content, encode};
use crate::picture::{Picture, PicturePlacement};
use crate::{npy, sample_type::SampleType};

/// A displacement field with its place in the world: the map of a registration and the picture that it belongs to.
///
/// NIfTI and NRRD hold the vectors that ITK's `DisplacementFieldTransform` expects:
///
/// ```text
/// T(x) = x + d(x),   d = −Σ_a u_a d_a,   in LPS, mm
/// ```
/// x is a point of the fixed picture and T(x) the point of the moving picture that shows the same. u is the displacement of
/// [`DisplacementMap`], h(x) = x − u(x), whose components are along the axes of the picture; `d_a` are the directions of these axes.
///
/// | file | vectors | axes of the components |
/// |---|---|---|
/// | `.nii`, `.nii.gz` | d, five dimensions (nx, ny, nz, 1, 3), intent code 1007 (vector) | LPS, as ITK and ANTs write and read them |
/// | `.nrrd` | d, kinds `vector domain domain domain` | LPS |
/// | `.npy` | u, shape (n₀, n₁, n₂, 3), as in memory | those of the picture |
///
/// A NIfTI file with intent code 1006 (displacement vector) has components in RAS, by the standard; they are turned when it is read. Pictures
/// of two dimensions whose axes lie in the plane of x and y have vectors of two components, others of three.
///
/// # Example
/// ```
/// use piola_images::{DisplacementField, Picture, SampleType};
/// use piola_registration::{DisplacementMap, ImageGrid};
/// let path = std::env::temp_dir().join(format!("piola-field-{}.nii", std::process::id()));
/// let picture = Picture::new([2, 3], [0.5, 0.5], vec![0.0; 6], SampleType::U8)?;
/// let map = DisplacementMap::new(ImageGrid::new([2, 3], [0.5, 0.5])?, vec![[0.25, 0.0_f64]; 6])?;
/// DisplacementField::of(&map, &picture)?.write(&path)?;
/// assert_eq!(DisplacementField::<2>::read(&path)?.map, map);
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), piola_images::ImagesError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DisplacementField<const D: usize> {
    /// The map, in mm.
    pub map: DisplacementMap<D, f64>,
    /// Where its samples lie.
    pub placement: PicturePlacement<D>,
    like: Picture<D>,
}

impl<const D: usize> DisplacementField<D> {
    /// The field of a map on the samples of `picture`.
    ///
    /// # Errors
    /// [`ImagesError::UnequalSizes`] where the sizes differ; `NotPerpendicular`.
    pub fn of<T: Real>(map: &DisplacementMap<D, T>, picture: &Picture<D>) -> Result<Self, ImagesError> {
        picture.check_sizes(map.grid())?;
        picture.check_perpendicular()?;
        let vectors = map.displacements().iter().map(|u| u.map(|component| component.primal(0))).collect();
        let grid = ImageGrid::new(picture.sizes(), picture.spacing())?;
        let like = Picture::of_contents(picture.without_values());
        Ok(Self { map: DisplacementMap::new(grid, vectors)?, placement: picture.placement(), like })
    }

    /// Reads a NIfTI or NRRD file of vectors.
    ///
    /// # Errors
    /// Those of [`Picture::read`]; [`ImagesError::Unsupported`] where the samples are not vectors of D or three components;
    /// `NotPerpendicular`.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ImagesError> {
        let path = path.as_ref();
        Self::of_contents(path, decode(path)?)
    }

    /// Reads the content of a NIfTI or NRRD file of vectors that is in memory. The end of `name` says the format, and errors name it.
    ///
    /// # Errors
    /// Those of [`read`](Self::read), but for [`ImagesError::Unreadable`].
    pub fn from_content(name: impl AsRef<Path>, content: &[u8]) -> Result<Self, ImagesError> {
        let name = name.as_ref();
        Self::of_contents(name, decode_content(name, content)?)
    }

    fn of_contents(path: &Path, mut contents: Contents) -> Result<Self, ImagesError> {
        contents.check(path)?;
        if contents.sizes.len() != D {
            let valid = if D == 2 { "2 are asked for" } else { "3 are asked for" };
            return Err(ImagesError::Dimension { path: path.into(), found: contents.sizes.len(), valid });
        }
        let components = contents.components;
        if components != D && components != 3 {
            let found = format!("{components} numbers at each sample");
            return Err(ImagesError::unsupported(
                path,
                found,
                "vectors of as many components as dimensions, or of three",
            ));
        }
        let vectors = std::mem::take(&mut contents.values);
        contents.components = 1;
        let like = Picture::<D>::of_contents(contents);
        like.check_perpendicular()?;
        let placement = like.placement();
        let vectors = vectors
            .chunks_exact(components)
            .map(|d| {
                placement.directions.map(|direction| {
                    let along: f64 = d.iter().zip(direction).map(|(d, direction)| d * direction).sum();
                    0.0 - along
                })
            })
            .collect();
        let map = DisplacementMap::new(ImageGrid::new(like.sizes(), like.spacing())?, vectors)?;
        Ok(Self { map, placement, like })
    }

    /// Writes a NIfTI, NRRD or NPY file, as the end of the name says, in one piece and in double precision.
    ///
    /// # Errors
    /// [`ImagesError::UnknownFormat`] or `Unwritable`.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ImagesError> {
        let path = path.as_ref();
        let sizes = self.map.grid().sizes();
        if Format::of(path) == Some(Format::Npy) {
            let shape: Vec<_> = sizes.into_iter().chain([D]).collect();
            return npy::write(path, &shape, self.map.displacements().as_flattened());
        }
        if !matches!(Format::of(path), Some(Format::Nifti { .. } | Format::Nrrd)) {
            let (purpose, valid) = ("writing a displacement field", ".nii, .nii.gz, .nrrd or .npy");
            return Err(ImagesError::UnknownFormat { path: path.into(), purpose, valid });
        }
        let directions = self.placement.directions;
        let is_in_plane = directions.iter().all(|direction| direction[2].abs() <= 0.0);
        let components = if D == 2 && is_in_plane { 2 } else { 3 };
        let mut values = Vec::with_capacity(components * self.map.grid().len());
        for u in self.map.displacements() {
            let vector: [f64; 3] = std::array::from_fn(|component| {
                // 0 − x, so that no displacement is written as −0.
                0.0 - (0..D).map(|axis| u[axis] * directions[axis][component]).sum::<f64>()
            });
            values.extend_from_slice(&vector[..components]);
        }
        let like = self.like.without_values();
        let contents = Contents { components, values, sample_type: SampleType::F64, scaling: None, ..like };
        file::write(path, &encode(path, &contents)?)
    }
}
