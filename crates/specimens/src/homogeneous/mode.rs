//! The modes of homogeneous tests.

use piola_numerics::Real;

/// A mode of a homogeneous test of an incompressible body.
///
/// | mode | stretch | principal stretches | first Piola–Kirchhoff stress |
/// |---|---|---|---|
/// | `Uniaxial` | λ along 1 | λ, λ^(−½), λ^(−½) | P₁₁ |
/// | `Equibiaxial` | λ along 1 and 2 | λ, λ, λ⁻² | P₁₁ |
/// | `Planar` (pure shear) | λ along 1, none along 2 | λ, 1, λ⁻¹ | P₁₁ |
/// | `SimpleShear` | the amount of shear k = F₂₁ | λ, 1, λ⁻¹ with λ − λ⁻¹ = k | P₂₁ |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Mode {
    /// A bar pulled or pressed along 1, its sides free.
    Uniaxial,
    /// A sheet pulled equally along 1 and 2, its faces free.
    Equibiaxial,
    /// A wide sheet pulled along 1 and held along 2, its faces free: also called pure shear.
    Planar,
    /// A block sheared along 2 by planes normal to 1, its third faces free.
    SimpleShear,
}

impl Mode {
    /// All modes.
    pub const ALL: [Self; 4] = [Self::Uniaxial, Self::Equibiaxial, Self::Planar, Self::SimpleShear];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniaxial => "uniaxial",
            Self::Equibiaxial => "equibiaxial",
            Self::Planar => "planar",
            Self::SimpleShear => "simple shear",
        }
    }

    /// The stretch at which nothing is deformed: 1, or 0 for the amount of shear.
    #[must_use]
    pub const fn rest(self) -> f64 {
        match self {
            Self::SimpleShear => 0.0,
            _ => 1.0,
        }
    }

    /// λₖ − 1 of the principal stretches λₖ, whose product is 1; descending only where λ is above 1.
    ///
    /// # Accuracy
    /// 2 ulp each, for small elongations too: λ − 1 is exact for λ ∈ [½, 2].
    ///
    /// # Example
    /// ```
    /// use piola_specimens::homogeneous::Mode;
    /// assert_eq!(Mode::Uniaxial.elongations(4.0), [3.0, -0.5, -0.5]);
    /// assert_eq!(Mode::SimpleShear.elongations(1.5), [1.0, 0.0, -0.5]); // 2 − 1/2 = 1.5
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn elongations<T: Real>(self, stretch: T) -> [T; 3] {
        let (one, two) = (T::one(), T::lit(2.0));
        match self {
            Self::Uniaxial => {
                let elongation = stretch - one;
                let root = stretch.sqrt();
                let across = -elongation / (root * (one + root));
                [elongation, across, across]
            }
            Self::Equibiaxial => {
                let elongation = stretch - one;
                [elongation, elongation, -elongation * (two + elongation) / (stretch * stretch)]
            }
            Self::Planar => {
                let elongation = stretch - one;
                [elongation, T::zero(), -elongation / stretch]
            }
            Self::SimpleShear => {
                // λ = √(1 + k²/4) + k/2; λ − 1 from √(1 + x) − 1 = x/(1 + √(1 + x)).
                let half = T::lit(0.5) * stretch;
                let square = half * half;
                let root = (one + square).sqrt();
                let beyond = square / (one + root);
                let elongation = half + beyond;
                [elongation, T::zero(), beyond - half]
            }
        }
    }
}
