//! Prescribed components of a homogeneous test: some of F, the others of the stress.

use piola_continuum::ContinuumError;

use crate::SpecimensError;
use crate::error::check_bound;

/// The prescribed value of one component ij.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Control {
    /// ∂uᵢ/∂Xⱼ = Fᵢⱼ − δᵢⱼ.
    Displacement(f64),
    /// Pᵢⱼ, Pa: zero for a face free of traction.
    #[doc(alias = "nominal")]
    #[cfg_attr(feature = "serde", serde(alias = "nominal"))]
    FirstPiola(f64),
    /// Tᵢⱼ, Pa. T is symmetric: of ij and ji at most one can be prescribed.
    Cauchy(f64),
}

impl Control {
    /// A component of the traction is zero.
    pub const FREE: Self = Self::FirstPiola(0.0);
    /// The component of F is that of the reference.
    pub const HELD: Self = Self::Displacement(0.0);

    pub(super) const fn value(self) -> f64 {
        match self {
            Self::Displacement(value) | Self::FirstPiola(value) | Self::Cauchy(value) => value,
        }
    }
}

/// Prescribed values of all nine components, by rows.
///
/// To fix the rotation of the body, of each pair ij and ji at least one should be a displacement; the constructors
/// prescribe both, as zero.
///
/// # Example
/// A bar pulled by a force instead of a stretch.
/// ```
/// use piola_specimens::homogeneous::{Control, Controls, equilibrium};
/// use piola_solids::MooneyRivlin;
/// use piola_continuum::DisplacementGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let controls = Controls::axial([Control::FirstPiola(1.0), Control::FREE, Control::FREE])?;
/// let state = equilibrium(&rubber, &controls, &DisplacementGradient::zero())?;
/// assert!((state.first_piola.0[(0, 0)] - 1.0).abs() < 1e-14);
/// assert!(state.first_piola.0[(1, 1)].abs() < 1e-14);
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[[Control; 3]; 3]", into = "[[Control; 3]; 3]"))]
pub struct Controls {
    components: [[Control; 3]; 3],
}

impl Controls {
    /// From all nine.
    ///
    /// # Errors
    /// [`SpecimensError::Continuum`] for a value that is not finite; [`SpecimensError::PrescribedTwice`] where both
    /// Tᵢⱼ and Tⱼᵢ are prescribed.
    pub fn new(components: [[Control; 3]; 3]) -> Result<Self, SpecimensError> {
        for (index, control) in components.as_flattened().iter().enumerate() {
            let value = control.value();
            if !value.is_finite() {
                return Err(ContinuumError::NotFinite { quantity: "controls", index, value }.into());
            }
        }
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let both = [components[row][column], components[column][row]];
            if both.iter().all(|control| matches!(control, Control::Cauchy(_))) {
                return Err(SpecimensError::PrescribedTwice { row, column });
            }
        }
        Ok(Self { components })
    }

    /// Along the axes; nothing is sheared.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn axial([a, b, c]: [Control; 3]) -> Result<Self, SpecimensError> {
        let o = Control::HELD;
        Self::new([[a, o, o], [o, b, o], [o, o, c]])
    }

    /// A bar of stretch λ along 1, its sides free.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn uniaxial(stretch: f64) -> Result<Self, SpecimensError> {
        Self::axial([Control::Displacement(stretch - 1.0), Control::FREE, Control::FREE])
    }

    /// A sheet of stretches λ along 1 and 2, its faces free.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn equibiaxial(stretch: f64) -> Result<Self, SpecimensError> {
        let pulled = Control::Displacement(stretch - 1.0);
        Self::axial([pulled, pulled, Control::FREE])
    }

    /// A sheet of stretch λ along 1, held along 2, its faces free.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn planar(stretch: f64) -> Result<Self, SpecimensError> {
        Self::axial([Control::Displacement(stretch - 1.0), Control::HELD, Control::FREE])
    }

    /// The shear k = F₂₁; the other faces are held or, where `free` says so, 33 is free of traction.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn simple_shear(amount: f64, free: bool) -> Result<Self, SpecimensError> {
        let o = Control::HELD;
        let third = if free { Control::FREE } else { o };
        Self::new([[o, o, o], [Control::Displacement(amount), o, o], [o, o, third]])
    }

    /// F = J^(⅓) 1.
    ///
    /// # Errors
    /// [`SpecimensError::NotFinite`]; [`SpecimensError::OutOfBounds`] unless 0 < J.
    pub fn volumetric(jacobian: f64) -> Result<Self, SpecimensError> {
        check_bound("homogeneous test", "J", jacobian, "0 < J", 0.0 < jacobian)?;
        // ∛(1 + x) − 1 without cancellation.
        let pulled = Control::Displacement(((jacobian - 1.0).ln_1p() / 3.0).exp_m1());
        Self::axial([pulled; 3])
    }

    /// Places of the prescribed stresses, by rows, and their number.
    pub(super) fn free(&self) -> ([(usize, usize); 9], usize) {
        let (mut places, mut count) = ([(0, 0); 9], 0);
        for (i, row) in self.components.iter().enumerate() {
            for (j, control) in row.iter().enumerate() {
                if !matches!(control, Control::Displacement(_)) {
                    places[count] = (i, j);
                    count += 1;
                }
            }
        }
        (places, count)
    }

    /// The components, by rows.
    #[must_use]
    pub const fn components(&self) -> &[[Control; 3]; 3] {
        &self.components
    }
}

impl TryFrom<[[Control; 3]; 3]> for Controls {
    type Error = SpecimensError;

    fn try_from(components: [[Control; 3]; 3]) -> Result<Self, SpecimensError> {
        Self::new(components)
    }
}

impl From<Controls> for [[Control; 3]; 3] {
    fn from(controls: Controls) -> Self {
        controls.components
    }
}
