//! The stress at a place of a viscometric flow.

/// The components of the stress T, Pa, along the directions of the velocity gradient (1), the flow (2) and the neutral one (3).
///
/// T₁₃ = T₂₃ = 0.
///
/// # Example
/// ```
/// use piola_viscometry::Stresses;
/// let stresses = Stresses { shear: 2.0, gradient: -1.0, flow: 5.0, neutral: -3.0, error: 0.0 };
/// assert_eq!(stresses.first_normal_stress_difference(), 6.0);
/// assert_eq!(stresses.second_normal_stress_difference(), 2.0);
/// assert_eq!(stresses.pressure(), 3.0);
/// ```
///
/// # Source
/// W(23.13)–W(23.24).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stresses {
    /// T₁₂, Pa.
    pub shear: f64,
    /// T₁₁, Pa.
    pub gradient: f64,
    /// T₂₂, Pa.
    pub flow: f64,
    /// T₃₃, Pa.
    pub neutral: f64,
    /// A bound of the error that quadrature leaves in the normal stresses, Pa.
    pub error: f64,
}

impl Stresses {
    /// N₁ = T₂₂ − T₁₁, Pa.
    #[must_use]
    pub const fn first_normal_stress_difference(&self) -> f64 {
        self.flow - self.gradient
    }

    /// N₂ = T₁₁ − T₃₃, Pa.
    #[must_use]
    pub const fn second_normal_stress_difference(&self) -> f64 {
        self.gradient - self.neutral
    }

    /// −T₃₃, Pa: the pressure beside which the extra stress has no component along the neutral direction.
    #[must_use]
    pub const fn pressure(&self) -> f64 {
        -self.neutral
    }

    /// −(T₁₁ + T₂₂ + T₃₃)/3, Pa.
    #[must_use]
    pub const fn mean_pressure(&self) -> f64 {
        -(self.gradient + self.flow + self.neutral) / 3.0
    }

    /// From T₁₂, one of the normal stresses and the functions σ₁, σ₂.
    pub(crate) const fn from_gradient(shear: f64, gradient: f64, sigma: [f64; 2], error: f64) -> Self {
        let neutral = gradient - sigma[0];
        Self { shear, gradient, flow: neutral + sigma[1], neutral, error }
    }
}
