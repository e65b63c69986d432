//! Maps x ↦ x − u(x) of a box onto itself.

use piola_numerics::Real;

use crate::error::{RegistrationError, check_finite};
use crate::field::{compose, largest, sample, target};
use crate::grid::ImageGrid;
use crate::image::Image;
use crate::inverse::invert;
use crate::jacobian::{least_jacobian, nodal_jacobian};
use crate::parallel::each;
use crate::sampler::{ImageSampler, Interpolant};

/// The map h(x) = x − u(x) from the box of the fixed image to that of the moving image.
///
/// ```text
/// warped(x) = moving(h(x)),   ∇h = 1 − ∇u
/// ```
/// | symbol | method | shape | unit |
/// |---|---|---|---|
/// | u | `displacements` | one vector for each sample, row-major | m |
/// | det(1 − ∇u) | `jacobian` | one for each sample | – |
///
/// u is Eulerian: the material now at x came from h(x). Between samples u is multilinear. Beyond the outermost samples u continues by
/// reflection, the component normal to the wall odd and the others even, so that walls slide along themselves (the boundary conditions
/// B(4.87–4.88)). Points outside the box are taken to the nearest point of its wall.
///
/// # Example
/// ```
/// use piola_registration::{DisplacementMap, ImageGrid};
/// use std::f64::consts::PI;
/// // A box of side 1 that is compressed towards its middle.
/// let grid = ImageGrid::new([32, 32], [1.0 / 32.0; 2])?;
/// let map = DisplacementMap::from_fn(grid, |[y, x]| [0.0 * y, 0.05 * (2.0 * PI * x).sin()])?;
/// assert!(map.least_jacobian() > 1.0 - 0.1 * PI);
/// let inverse = map.inverse()?;
/// assert!(map.after(&inverse)?.largest_displacement() < 1e-12);
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DisplacementMap<const D: usize, T> {
    pub(crate) grid: ImageGrid<D>,
    pub(crate) displacements: Vec<[T; D]>,
}

impl<const D: usize, T: Real> DisplacementMap<D, T> {
    /// The map with these `displacements` u, in m, row-major.
    ///
    /// # Errors
    /// [`RegistrationError::WrongLength`] unless there is a displacement for each sample; `NotFinite` for an infinite or NaN component.
    pub fn new(grid: ImageGrid<D>, displacements: Vec<[T; D]>) -> Result<Self, RegistrationError> {
        if displacements.len() != grid.len() {
            let (quantity, found, expected) = ("displacements", displacements.len(), grid.len());
            return Err(RegistrationError::WrongLength { quantity, found, expected });
        }
        check_finite("displacements", displacements.as_flattened())?;
        Ok(Self { grid, displacements })
    }

    /// The map with the displacements of a function of the place, both in m.
    ///
    /// # Errors
    /// [`RegistrationError::NotFinite`] for an infinite or NaN component.
    pub fn from_fn(
        grid: ImageGrid<D>,
        mut displacement: impl FnMut([f64; D]) -> [T; D],
    ) -> Result<Self, RegistrationError> {
        Self::new(grid, (0..grid.len()).map(|position| displacement(grid.place(position))).collect())
    }

    /// The map that moves nothing.
    #[must_use]
    pub fn identity(grid: ImageGrid<D>) -> Self {
        Self { grid, displacements: vec![[T::zero(); D]; grid.len()] }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &ImageGrid<D> {
        &self.grid
    }

    /// u at the samples, m, row-major.
    #[must_use]
    pub fn displacements(&self) -> &[[T; D]] {
        &self.displacements
    }

    /// u at any place of the box, m.
    #[must_use]
    #[inline]
    pub fn displacement(&self, place: [T; D]) -> [T; D] {
        sample(&self.grid, &self.displacements, place)
    }

    /// h at any place of the box, m.
    #[must_use]
    #[inline]
    pub fn at(&self, place: [T; D]) -> [T; D] {
        let displacement = self.displacement(place);
        std::array::from_fn(|axis| place[axis] - displacement[axis])
    }

    /// The image x ↦ `moving`(h(x)).
    ///
    /// # Errors
    /// [`RegistrationError::UnequalSizes`] or `UnequalSpacings` where the grids differ.
    pub fn warp(&self, moving: &Image<D, T>, interpolant: Interpolant) -> Result<Image<D, T>, RegistrationError> {
        self.grid.check_same(moving.grid())?;
        let sampler = ImageSampler::new(moving, interpolant);
        let mut values = vec![T::zero(); self.grid.len()];
        each(&mut values[..], &|start, part: &mut [T]| {
            for (position, value) in (start..).zip(part) {
                *value = sampler.value(target(&self.grid, position, &self.displacements[position], T::one()));
            }
        });
        Ok(Image::computed(self.grid, values))
    }

    /// det(1 − ∇u) at the samples, by central differences.
    #[must_use]
    pub fn jacobian(&self) -> Image<D, T> {
        Image::computed(self.grid, nodal_jacobian(&self.grid, &self.displacements))
    }

    /// The least det(1 − ∇u) over all triangles (tetrahedra) with corners at the samples: the certificate of invertibility.
    ///
    /// Each cell is divided along each of its diagonals: into four triangles in two dimensions, twenty-four tetrahedra in three. On each of
    /// them the linear interpolant of h has one determinant. In two dimensions the least of them is also the least determinant of the
    /// bilinear interpolant, because this is linear in the cell.
    ///
    /// If it is positive, the piecewise linear interpolant of h is one-to-one and onto: continued by reflection, it is a map of a torus to
    /// itself of degree one without folds.
    #[must_use]
    pub fn least_jacobian(&self) -> f64 {
        least_jacobian(&self.grid, &self.displacements, 1.0)
    }

    /// The composition x ↦ h(g(x)) for g = `first`.
    ///
    /// # Errors
    /// [`RegistrationError::UnequalSizes`] or `UnequalSpacings` where the grids differ.
    pub fn after(&self, first: &Self) -> Result<Self, RegistrationError> {
        self.grid.check_same(&first.grid)?;
        let mut displacements = first.displacements.clone();
        compose(&self.grid, &self.displacements, &first.displacements, &mut displacements);
        Ok(Self { grid: self.grid, displacements })
    }

    /// The inverse g, with h(g(y)) = y at every sample y.
    ///
    /// The samples are located in the images of the triangles (tetrahedra) of h; then Newton's method solves h(x) = y for the multilinear
    /// interpolant. Error of h(g(y)) at samples: some 10 ulp of the side of the box. Between samples g is interpolated, so g(h(x)) − x is of
    /// the second order in the spacing.
    ///
    /// # Errors
    /// [`RegistrationError::Folded`] unless 0 < [`least_jacobian`](Self::least_jacobian).
    pub fn inverse(&self) -> Result<Self, RegistrationError> {
        let least = self.least_jacobian();
        if least <= 0.0 {
            return Err(RegistrationError::Folded { least });
        }
        Ok(Self { grid: self.grid, displacements: invert(&self.grid, &self.displacements) })
    }

    /// The largest |u|, m.
    #[must_use]
    pub fn largest_displacement(&self) -> f64 {
        largest(&self.displacements)
    }

    /// The same map on another grid of the same box.
    pub(crate) fn resampled(&self, grid: ImageGrid<D>) -> Self {
        let mut displacements = vec![[T::zero(); D]; grid.len()];
        each(&mut displacements[..], &|start, part: &mut [[T; D]]| {
            for (position, u) in (start..).zip(part) {
                *u = self.displacement(grid.place(position).map(T::lit));
            }
        });
        Self { grid, displacements }
    }
}
