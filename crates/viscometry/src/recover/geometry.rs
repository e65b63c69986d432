//! Geometries of measurements.

use crate::ViscometryError;
use crate::error::check_bound;

/// A pipe.
///
/// # Example
/// See [`FlowTable`](super::FlowTable).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::PipeGeometry"))]
pub struct PipeGeometry {
    pub(super) radius: f64,
}

/// A channel between parallel walls.
///
/// # Example
/// See [`functions::channel`](super::functions::channel).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::ChannelGeometry"))]
pub struct ChannelGeometry {
    pub(super) half_width: f64,
}

/// The gap between coaxial cylinders.
///
/// # Example
/// See [`functions::couette`](super::functions::couette).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::CouetteGeometry"))]
pub struct CouetteGeometry {
    pub(super) inner_radius: f64,
    pub(super) outer_radius: f64,
}

/// Parallel discs.
///
/// # Example
/// See [`functions::parallel_plates`](super::functions::parallel_plates).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::PlatesGeometry"))]
pub struct PlatesGeometry {
    pub(super) radius: f64,
    pub(super) gap: f64,
}

/// A cone of small angle on a plate.
///
/// # Example
/// See [`cone_and_plate`](super::cone_and_plate).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::ConeGeometry"))]
pub struct ConeGeometry {
    pub(super) radius: f64,
    pub(super) angle: f64,
}

impl PipeGeometry {
    /// R, m.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
    pub fn new(radius: f64) -> Result<Self, ViscometryError> {
        check_bound("pipe", "radius", radius, "0 < R", 0.0 < radius)?;
        Ok(Self { radius })
    }

    /// R, m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }
}

impl ChannelGeometry {
    /// d, half the distance of the walls, m.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
    pub fn new(half_width: f64) -> Result<Self, ViscometryError> {
        check_bound("channel", "half width", half_width, "0 < d", 0.0 < half_width)?;
        Ok(Self { half_width })
    }

    /// d, m.
    #[must_use]
    pub const fn half_width(&self) -> f64 {
        self.half_width
    }
}

impl CouetteGeometry {
    /// R₁ and R₂, m.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`] unless 0 < R₁ < R₂.
    pub fn new(inner_radius: f64, outer_radius: f64) -> Result<Self, ViscometryError> {
        check_bound("coaxial cylinders", "inner radius", inner_radius, "0 < R1", 0.0 < inner_radius)?;
        check_bound("coaxial cylinders", "outer radius", outer_radius, "R1 < R2", inner_radius < outer_radius)?;
        Ok(Self { inner_radius, outer_radius })
    }

    /// R₁ and R₂, m.
    #[must_use]
    pub const fn radii(&self) -> [f64; 2] {
        [self.inner_radius, self.outer_radius]
    }

    /// δ = 2 ln(R₂/R₁), without cancellation in a narrow gap.
    #[must_use]
    pub fn step(self) -> f64 {
        2.0 * ((self.outer_radius - self.inner_radius) / self.inner_radius).ln_1p()
    }

    /// T at the inner cylinder over the torque per length: 1/(2 π R₁²), 1/m².
    #[must_use]
    pub fn stress_per_torque(self) -> f64 {
        1.0 / (core::f64::consts::TAU * self.inner_radius * self.inner_radius)
    }
}

impl PlatesGeometry {
    /// R and the gap h, m.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
    pub fn new(radius: f64, gap: f64) -> Result<Self, ViscometryError> {
        check_bound("parallel plates", "radius", radius, "0 < R", 0.0 < radius)?;
        check_bound("parallel plates", "gap", gap, "0 < h", 0.0 < gap)?;
        Ok(Self { radius, gap })
    }

    /// R, m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// h, m.
    #[must_use]
    pub const fn gap(&self) -> f64 {
        self.gap
    }
}

impl ConeGeometry {
    /// R, m, and the angle α between cone and plate, rad.
    ///
    /// # Errors
    /// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
    pub fn new(radius: f64, angle: f64) -> Result<Self, ViscometryError> {
        check_bound("cone and plate", "radius", radius, "0 < R", 0.0 < radius)?;
        let within = 0.0 < angle && angle < core::f64::consts::FRAC_PI_2;
        check_bound("cone and plate", "angle", angle, "0 < alpha < pi/2", within)?;
        Ok(Self { radius, angle })
    }

    /// R, m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// α, rad.
    #[must_use]
    pub const fn angle(&self) -> f64 {
        self.angle
    }
}

/// Geometries as they are written.
#[cfg(feature = "serde")]
mod written {
    use crate::ViscometryError;

    macro_rules! written {
        ($($name:ident { $($field:ident),+ })+) => {
            $(
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                pub(super) struct $name {
                    $($field: f64),+
                }

                impl TryFrom<$name> for super::$name {
                    type Error = ViscometryError;

                    fn try_from(written: $name) -> Result<Self, ViscometryError> {
                        Self::new($(written.$field),+)
                    }
                }
            )+
        };
    }

    written! {
        PipeGeometry { radius }
        ChannelGeometry { half_width }
        CouetteGeometry { inner_radius, outer_radius }
        PlatesGeometry { radius, gap }
        ConeGeometry { radius, angle }
    }
}
