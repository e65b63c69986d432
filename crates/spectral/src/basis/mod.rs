//! The eigenfunctions of linear elasticity between sliding walls.

mod point_force;
mod series;

pub use series::ModalSeries;
pub(crate) use series::is_same_box;

use std::f64::consts::PI;

use crate::error::{SpectralError, check_bound, check_finite};
use crate::grid::in_space;
use crate::operator::LameParameters;

/// The direction of the displacement of an eigenfunction against its wave vector. Axis 3 of a box is called vertical.
///
/// # Example
/// ```
/// use piola_spectral::Polarisation;
/// assert_eq!(Polarisation::Longitudinal.family(), 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Polarisation {
    /// φ₁: along the wave vector, without rotation.
    #[doc(alias = "P wave")]
    Longitudinal,
    /// φ₂: across the wave vector and normal to axis 3, without change of volume.
    #[doc(alias = "SH wave")]
    Horizontal,
    /// φ₃, of boxes only: across the wave vector in the plane of axis 3, without change of volume.
    #[doc(alias = "SV wave")]
    Vertical,
}

impl Polarisation {
    /// The number of the family: 1, 2 or 3.
    #[must_use]
    pub fn family(self) -> usize {
        match self {
            Self::Longitudinal => 1,
            Self::Horizontal => 2,
            Self::Vertical => 3,
        }
    }
}

/// The eigenfunctions of μΔu + (λ + μ)∇(∇·u) on a box with sides L₁, L₂, L₃ between sliding walls, orthonormal.
///
/// ```text
/// φ₁ = α₁ ( n₁ scc,  n₂ csc,  n₃ ccs)
/// φ₂ = α₂ (−n₂ scc,  n₁ csc,  0)
/// φ₃ = α₃ ( n₁n₃ scc, n₂n₃ csc, −(n₁² + n₂²) ccs)
/// n_a = i_a/L_a,   scc = sin(π n₁ x₁) cos(π n₂ x₂) cos(π n₃ x₃), …
/// κ₁ = −π²(λ + 2μ) n²,   κ₂ = κ₃ = −π²μ n²,   n² = n₁² + n₂² + n₃²
/// α₁⁻² = E n²,  α₂⁻² = E (n₁² + n₂²),  α₃⁻² = E (n₁² + n₂²) n²,  E = V times ½ for each index that is not zero
/// ```
/// In a rectangle there are φ₁ and φ₂ alone, without the third factors.
///
/// Some functions vanish identically: φ₁ when all indices are zero; φ₂ when i₁ = 0 or i₂ = 0; φ₃ when i₃ = 0 or
/// i₁ = i₂ = 0. They have no normalisation.
///
/// # Example
/// ```
/// use piola_spectral::{Eigenbasis, LameParameters, Polarisation};
/// use std::f64::consts::PI;
/// let basis = Eigenbasis::new([1.0, 1.0], LameParameters::new(1.5, 0.75)?)?;
/// let kappa = basis.eigenvalue(Polarisation::Longitudinal, [1, 2])?;
/// assert!((kappa + 15.0 * PI * PI).abs() < 1e-12);
/// // The wave (0, 1) has no transverse part.
/// assert!(basis.normalisation(Polarisation::Horizontal, [0, 1]).is_err());
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.90), B(4.91), B(4.93), B(4.94) for the unit cube, B(4.102–4.108) for the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenbasis<const D: usize> {
    sides: [f64; D],
    lame: LameParameters,
}

impl<const D: usize> Eigenbasis<D> {
    /// The basis on a box with these sides, m.
    ///
    /// # Errors
    /// A side that is not finite and positive.
    pub fn new(sides: [f64; D], lame: LameParameters) -> Result<Self, SpectralError> {
        const { assert!(D == 2 || D == 3, "a rectangle or a box") };
        check_sides(&sides)?;
        Ok(Self { sides, lame })
    }

    /// The sides, m.
    #[must_use]
    pub fn sides(&self) -> [f64; D] {
        self.sides
    }

    /// Lamé's parameters.
    #[must_use]
    pub fn lame(&self) -> LameParameters {
        self.lame
    }

    /// Whether the function is zero everywhere.
    #[must_use]
    pub fn vanishes(&self, polarisation: Polarisation, indices: [usize; D]) -> bool {
        match polarisation {
            Polarisation::Longitudinal => indices == [0; D],
            Polarisation::Horizontal => indices[0] == 0 || indices[1] == 0,
            Polarisation::Vertical => D == 2 || indices[D - 1] == 0 || (indices[0] == 0 && indices[1] == 0),
        }
    }

    /// The eigenvalue κ, N/m⁴.
    ///
    /// # Errors
    /// A function that vanishes identically.
    pub fn eigenvalue(&self, polarisation: Polarisation, indices: [usize; D]) -> Result<f64, SpectralError> {
        self.check(polarisation, indices)?;
        let n = self.numbers(indices);
        let stiffness = match polarisation {
            Polarisation::Longitudinal => self.lame.longitudinal_modulus(),
            Polarisation::Horizontal | Polarisation::Vertical => self.lame.shear_modulus(),
        };
        Ok(-PI * PI * stiffness * squared(&n))
    }

    /// The factor α that makes the norm one.
    ///
    /// # Errors
    /// A function that vanishes identically.
    pub fn normalisation(&self, polarisation: Polarisation, indices: [usize; D]) -> Result<f64, SpectralError> {
        self.check(polarisation, indices)?;
        let direction = self.direction(polarisation, indices);
        Ok((self.weight(indices) * squared(&direction)).sqrt().recip())
    }

    /// The amplitudes of the products of sines and cosines in the components of φ.
    ///
    /// # Errors
    /// A function that vanishes identically.
    pub fn amplitudes(&self, polarisation: Polarisation, indices: [usize; D]) -> Result<[f64; D], SpectralError> {
        let factor = self.normalisation(polarisation, indices)?;
        Ok(self.direction(polarisation, indices).map(|component| factor * component))
    }

    /// φ at a place, m^(−D/2).
    ///
    /// # Errors
    /// A function that vanishes identically; a place that is not finite.
    pub fn value(
        &self,
        polarisation: Polarisation,
        indices: [usize; D],
        place: [f64; D],
    ) -> Result<[f64; D], SpectralError> {
        check_finite("place", &place)?;
        let amplitudes = self.amplitudes(polarisation, indices)?;
        let n = self.numbers(indices);
        Ok(std::array::from_fn(|component| {
            (0..D).fold(amplitudes[component], |product, axis| {
                let (sin, cos) = (PI * n[axis] * place[axis]).sin_cos();
                product * if axis == component { sin } else { cos }
            })
        }))
    }

    /// i/L.
    fn numbers(&self, indices: [usize; D]) -> [f64; D] {
        std::array::from_fn(|axis| indices[axis] as f64 / self.sides[axis])
    }

    /// φ without its normalisation.
    fn direction(&self, polarisation: Polarisation, indices: [usize; D]) -> [f64; D] {
        let n = self.numbers(indices);
        let mut direction = [0.0; D];
        match polarisation {
            Polarisation::Longitudinal => direction = n,
            Polarisation::Horizontal => (direction[0], direction[1]) = (-n[1], n[0]),
            Polarisation::Vertical => {
                for axis in 0..2 {
                    direction[axis] = n[axis] * n[D - 1];
                }
                direction[D - 1] = -(n[0] * n[0] + n[1] * n[1]);
            }
        }
        direction
    }

    /// V times ½ for each index that is not zero: the integral of the square of a product of sines and cosines.
    fn weight(&self, indices: [usize; D]) -> f64 {
        weight(&self.sides, indices)
    }

    fn check(&self, polarisation: Polarisation, indices: [usize; D]) -> Result<(), SpectralError> {
        if self.vanishes(polarisation, indices) {
            return Err(SpectralError::VanishingMode { indices: in_space(indices, 0), family: polarisation.family() });
        }
        Ok(())
    }
}

/// The integral of the square of a product of sines and cosines that does not vanish.
fn weight<const D: usize>(sides: &[f64; D], indices: [usize; D]) -> f64 {
    sides.iter().zip(indices).map(|(side, index)| if index == 0 { *side } else { 0.5 * side }).product()
}

fn squared(vector: &[f64]) -> f64 {
    vector.iter().map(|component| component * component).sum()
}

fn check_sides(sides: &[f64]) -> Result<(), SpectralError> {
    sides.iter().try_for_each(|&side| check_bound("side", side, "1e-70 < L < 1e70", 1e-70 < side && side < 1e70))
}
