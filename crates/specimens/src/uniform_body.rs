//! A body of one hyperelastic material, for the integrals over bodies.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{Deformation, DeformationGradient, FirstPiola};
use piola_fields::integral::StoredEnergy;
use piola_numerics::Real;
use piola_solids::Hyperelastic;

/// A body that is the same hyperelastic solid everywhere: its total strain energy ∫ W dV by
/// [`strain_energy`](piola_fields::integral::strain_energy), its balance of energy by
/// [`EnergyBalance`](piola_fields::integral::EnergyBalance).
///
/// # Example
/// A block of 2 m³ stretched to double length.
/// ```
/// use nalgebra::Vector3;
/// use piola_solids::SaintVenantKirchhoff;
/// use piola_specimens::UniformBody;
/// use piola_fields::Motion;
/// use piola_fields::integral::{Cuboid, Quadrature, strain_energy};
/// use piola_numerics::Real;
/// struct Pull;
/// impl Motion for Pull {
///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
///         Vector3::new(reference.x * (T::lit(1.0) + time), reference.y, reference.z)
///     }
/// }
/// let solid = UniformBody(SaintVenantKirchhoff::new(1.0, 0.5)?);
/// let block = Cuboid::new(Vector3::zeros(), Vector3::new(2.0, 1.0, 1.0))?;
/// let energy = strain_energy(&Quadrature::of_degree(2)?, &block, &Pull, &solid, 1.0)?;
/// assert!((energy - 2.0 * 2.25_f64).abs() < 1e-14); // W = ½ (λ + 2 μ) E₁₁², E₁₁ = 3/2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.61).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct UniformBody<L>(
    /// The material.
    pub L,
);

impl<L: Hyperelastic> StoredEnergy for UniformBody<L> {
    // F as it is: the motion has checked it.
    fn density<T: Real>(&self, _reference: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
        let reference = DeformationGradient::<f64>::identity();
        self.0.energy(&reference.lifted(|i, j, _| gradient[(i, j)]))
    }

    fn stress<T: Real>(&self, _reference: &Vector3<f64>, gradient: &Matrix3<T>) -> FirstPiola<T> {
        let reference = DeformationGradient::<f64>::identity();
        self.0.first_piola(&reference.lifted(|i, j, _| gradient[(i, j)]))
    }
}
