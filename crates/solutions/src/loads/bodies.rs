//! Bodies in their reference configuration, and conditions on their ends.

use crate::SolutionsError;
use crate::error::check_bound;

/// A tube, or a solid cylinder where the inner radius is zero.
///
/// # Example
/// ```
/// use piola_solutions::loads::Tube;
/// assert!(Tube::new(1.0, 2.0)?.inner() < 2.0);
/// assert!(Tube::solid(2.0)?.is_solid());
/// assert!(Tube::new(2.0, 1.0).is_err());
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    inner: f64,
    outer: f64,
}

impl Tube {
    /// From the radii, m.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < inner < outer.
    pub fn new(inner: f64, outer: f64) -> Result<Self, SolutionsError> {
        check_bound("inner radius", inner, "0 < R_i", 0.0 < inner)?;
        check_bound("outer radius", outer, "R_i < R_o", inner < outer)?;
        Ok(Self { inner, outer })
    }

    /// A solid cylinder, from its radius, m.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < radius.
    pub fn solid(radius: f64) -> Result<Self, SolutionsError> {
        check_bound("radius", radius, "0 < R", 0.0 < radius)?;
        Ok(Self { inner: 0.0, outer: radius })
    }

    /// The inner radius, m.
    #[must_use]
    pub const fn inner(&self) -> f64 {
        self.inner
    }

    /// The outer radius, m.
    #[must_use]
    pub const fn outer(&self) -> f64 {
        self.outer
    }

    /// Whether there is no hole.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.inner <= 0.0
    }
}

/// A spherical shell.
///
/// # Example
/// ```
/// use piola_solutions::loads::Shell;
/// assert_eq!(Shell::new(1.0, 1.5)?.outer(), 1.5);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    inner: f64,
    outer: f64,
}

impl Shell {
    /// From the radii, m.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < inner < outer.
    pub fn new(inner: f64, outer: f64) -> Result<Self, SolutionsError> {
        check_bound("inner radius", inner, "0 < R_i", 0.0 < inner)?;
        check_bound("outer radius", outer, "R_i < R_o", inner < outer)?;
        Ok(Self { inner, outer })
    }

    /// The inner radius, m.
    #[must_use]
    pub const fn inner(&self) -> f64 {
        self.inner
    }

    /// The outer radius, m.
    #[must_use]
    pub const fn outer(&self) -> f64 {
        self.outer
    }
}

/// A rectangular block: its extents along X, Y and Z.
///
/// # Example
/// ```
/// use piola_solutions::loads::Block;
/// let block = Block::new(0.1, 2.0, 0.5)?;
/// assert_eq!((block.thickness(), block.length(), block.height()), (0.1, 2.0, 0.5));
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    extents: [f64; 3],
}

impl Block {
    /// From thickness, length and height, m.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless all are positive.
    pub fn new(thickness: f64, length: f64, height: f64) -> Result<Self, SolutionsError> {
        check_bound("thickness", thickness, "0 < thickness", 0.0 < thickness)?;
        check_bound("length", length, "0 < length", 0.0 < length)?;
        check_bound("height", height, "0 < height", 0.0 < height)?;
        Ok(Self { extents: [thickness, length, height] })
    }

    /// The extent along X, m.
    #[must_use]
    pub const fn thickness(&self) -> f64 {
        self.extents[0]
    }

    /// The extent along Y, m.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.extents[1]
    }

    /// The extent along Z, m.
    #[must_use]
    pub const fn height(&self) -> f64 {
        self.extents[2]
    }
}

/// A sector of a tube: its radii and the ends of its range of Θ.
///
/// # Example
/// ```
/// use piola_solutions::loads::Sector;
/// let sector = Sector::new([1.0, 2.0], [0.0, 0.5])?;
/// assert_eq!(sector.angle(), 0.5);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    radii: [f64; 2],
    angles: [f64; 2],
}

impl Sector {
    /// From the radii, m, and the angles, rad.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < R₁ < R₂ and Θ₁ < Θ₂ ≤ Θ₁ + 2π.
    pub fn new(radii: [f64; 2], angles: [f64; 2]) -> Result<Self, SolutionsError> {
        check_bound("inner radius", radii[0], "0 < R₁", 0.0 < radii[0])?;
        check_bound("outer radius", radii[1], "R₁ < R₂", radii[0] < radii[1])?;
        let angle = angles[1] - angles[0];
        check_bound("angle", angle, "0 < Θ₂ − Θ₁ ≤ 2π", 0.0 < angle && angle <= core::f64::consts::TAU)?;
        Ok(Self { radii, angles })
    }

    /// The radii, m.
    #[must_use]
    pub const fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// The ends of the range of Θ, rad.
    #[must_use]
    pub const fn angles(&self) -> [f64; 2] {
        self.angles
    }

    /// Θ₂ − Θ₁, rad.
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angles[1] - self.angles[0]
    }
}

/// What holds the ends of a tube.
///
/// # Example
/// See [`TubeInflation`](super::TubeInflation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// The axial stretch F is prescribed.
    Stretch(f64),
    /// The resultant of the axial stress, N, is prescribed.
    Force(f64),
    /// Caps close the tube: the pressure inside pulls them apart.
    Closed,
}

impl Ends {
    /// Refuses what no end is.
    pub(crate) fn check(self) -> Result<Self, SolutionsError> {
        match self {
            Self::Stretch(stretch) => check_bound("axial stretch", stretch, "0 < λ", 0.0 < stretch)?,
            Self::Force(force) => check_bound("axial force", force, "finite", force.is_finite())?,
            Self::Closed => (),
        }
        Ok(self)
    }
}
